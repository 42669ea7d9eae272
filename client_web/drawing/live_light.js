// SPDX-License-Identifier: Apache-2.0
// The scene that the server serves, drawn here: its geometry, loaded once, and its light as it comes.

import {readBlocks} from '../walkthrough/light_blocks.js';
import {Renderer} from '../walkthrough/renderer.js';
import {loadScene} from '../walkthrough/scene_data.js';

/**
 * @typedef {import('../net/protocol.js').ServerMessage} ServerMessage
 * @typedef {import('../net/protocol.js').LightScene} LightScene
 * @typedef {import('../net/protocol.js').LightSky} LightSky
 * @typedef {import('../net/scene_types.js').Vec3} Vec3
 * @typedef {import('../net/raybundle_client.js').RaybundleClient} RaybundleClient
 */

/** @type {(v: Vec3 | undefined) => [number, number, number]} */
const triple = (v) => [v?.x ?? 0, v?.y ?? 0, v?.z ?? 0];

/** Where the server has a file, also behind a proxy that puts it into a folder. @param {string} path */
const beside = (path) => new URL(path.replace(/^\//, ''), location.href).href;

/**
 * Events: `complete`, all light is there for the first time; `changed`, another picture is to be drawn; `forgotten`, what was
 * drawn is not there any more.
 */
export class LiveLight extends EventTarget {
    /** @type {Renderer | null} */
    renderer = null;
    /** Number and address of the geometry that is drawn, or loaded. @type {LightScene | null} */
    #scene = null;
    /** The server has said that this is the geometry of its scene. */
    #confirmed = false;
    /** What comes is taken in one after the other. */
    #queue = Promise.resolve();
    /** Blocks that have come. @type {Set<number>} */
    #blocks = new Set();
    /** Changes of the scene that the light shows. */
    epoch = 0;
    /** Why there is nothing to draw, for people. */
    problem = '';
    /** Nothing is taken in, nor acknowledged: the server sends no more. */
    ignored = false;
    /** Bytes of light so far. */
    bytes = 0;

    /**
     * @param {RaybundleClient} client
     * @param {WebGL2RenderingContext} gl
     */
    constructor(client, gl) {
        super();
        this.client = client;
        this.gl = gl;
        client.addEventListener('message', (event) => this.#told(/** @type {CustomEvent} */ (event).detail));
        client.addEventListener('light', (event) => {
            const {header, body} = /** @type {CustomEvent} */ (event).detail;
            this.#next(() => this.#arrived(header, body));
        });
    }

    /** Whether all of the scene and of its light is there. */
    get complete() {
        return this.#confirmed && this.renderer !== null && this.#scene !== null && this.#blocks.size >= this.#blockCount;
    }

    get #blockCount() {
        const {values = 0, blockValues = 1} = this.#scene ?? {};
        return Math.ceil(values / Math.max(blockValues, 1));
    }

    /** Another scene is there, or none. */
    forget() {
        this.#scene = null;
        this.#dropGeometry();
    }

    /** What is there is drawn again once the server says that it is of the scene that it has now. */
    doubt() {
        this.#confirmed = false;
    }

    #dropGeometry() {
        const {renderer} = this;
        this.renderer = null;
        this.#blocks.clear();
        if (renderer) {
            renderer.dispose();
            this.dispatchEvent(new Event('forgotten'));
        }
    }

    /** @param {() => Promise<void>} work */
    #next(work) {
        this.#queue = this.#queue.then(work).catch((/** @type {unknown} */ error) => {
            this.problem = error instanceof Error ? error.message : String(error);
        });
    }

    /** @param {ServerMessage} message */
    #told({lightScene, lightMaterial, lightSky}) {
        if (lightScene) {
            this.#next(() => this.#open(lightScene));
        } else if (lightMaterial) {
            this.#next(async () => {
                this.renderer?.setMaterial(lightMaterial.material - 1, lightMaterial);
                this.#changed();
            });
        } else if (lightSky) {
            this.#next(() => this.#setSky(lightSky));
        }
    }

    /** Loads another geometry; the same one stays, with its light until there is newer. @param {LightScene} scene */
    async #open(scene) {
        const same = this.renderer !== null && this.#scene?.url === scene.url;
        const wasComplete = this.complete;
        this.#scene = scene;
        this.#confirmed = true;
        if (same) {
            if (!wasComplete && this.complete) {
                this.dispatchEvent(new Event('complete'));
            }
            return;
        }
        this.#dropGeometry();
        if (this.ignored) {
            return;
        }
        const data = await loadScene(() => {}, beside(scene.url));
        if (4 * scene.values !== data.manifest.light.bytes) {
            throw new Error('light: there are not as many values as scene.json says');
        }
        // It may have been forgotten while it was loaded.
        if (this.#scene === scene && !this.gl.isContextLost()) {
            this.renderer = new Renderer(this.gl, data);
            this.problem = '';
        }
    }

    /** @param {LightSky} sky */
    async #setSky({uniform, url, width, height, unit, sun}) {
        const {renderer} = this;
        if (!renderer) {
            return;
        }
        const texels = url ? new Uint32Array(await (await fetch(beside(url))).arrayBuffer()) : null;
        if (texels && texels.length !== width * height) {
            throw new Error('light: the sky has not as many texels as it says');
        }
        const disc = sun ? {direction: triple(sun.direction), cosine: sun.cosine, radiance: triple(sun.radiance)} : null;
        if (this.renderer !== renderer) {
            return;
        }
        renderer.setSky({uniform: triple(uniform), texels: null, width, height, sun: disc}, unit, texels);
        this.#changed();
    }

    /**
     * @param {{light: number, scene: number, epoch: number}} header
     * @param {Uint8Array<ArrayBuffer>} body
     */
    async #arrived(header, body) {
        if (this.ignored) {
            return;
        }
        const scene = this.#scene;
        const {renderer} = this;
        const ours = scene && scene.scene === header.scene && renderer;
        const blocks = ours ? await readBlocks(body, scene) : [];
        if (ours && this.renderer === renderer) {
            const wasComplete = this.complete;
            this.bytes += body.length;
            for (const {first, words} of blocks) {
                renderer.setLight(first, words);
                this.#blocks.add(first);
            }
            this.epoch = header.epoch;
            this.#changed();
            if (!wasComplete && this.complete) {
                this.dispatchEvent(new Event('complete'));
            }
        }
        this.client.send({ackLight: {light: header.light}});
    }

    #changed() {
        this.dispatchEvent(new Event('changed'));
    }
}
