// SPDX-License-Identifier: Apache-2.0
// The page draws the scene by itself while the camera or an object moves, and gives way to the server's picture once
// that shows what is at rest.

import {sameView} from '../camera/camera.js';
import {Samples} from '../measure/meters.js';
import {drawer} from '../picture/drawer.js';
import {FrameThrottle} from '../picture/frame_throttle.js';
import {DrawnExposure} from './drawn_exposure.js';
import {LiveLight} from './live_light.js';
import {Openings, PlateFades, platesOf} from './luminaire_plates.js';
import {placeObjects} from './object_places.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('../net/protocol.js').FrameHeader} FrameHeader
 * @typedef {'auto' | 'here' | 'pictures'} DrawingChoice
 */

/** The server's picture fades in within this time, milliseconds; picture.css has the same. */
const FADE_MS = 180;
/** Slower drawing than this is left to the server, whose pictures come 20 times a second, milliseconds. */
const SLOWEST_MS = 50;
/** So many drawings are measured at first, and then one in so many: the page waits for it. */
const TRIALS = 3;
const MEASURED = 16;
const KEPT = 9;
/** Pictures at rest are looked at for their brightness so often at most, milliseconds. */
const FOLLOW_MS = 400;

/** Events: `state`, what is said of it has changed. */
export class LocalDrawing extends EventTarget {
    /** @type {LiveLight | null} */
    light = null;
    /** Made when it is first needed. @type {WebGL2RenderingContext | null | undefined} */
    #gl;
    #exposure = new DrawnExposure();
    #throttle = new FrameThrottle(() => this.#draw());
    /** @type {DrawingChoice} */
    #choice;
    /** What a drawing takes until it is done. */
    drawMs = new Samples(KEPT);
    #drawings = 0;
    #visible = false;
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    #fading;
    /** Changes of the scene that a picture has to show before it takes over. */
    #epoch = 0;
    #followed = -Infinity;
    /** Frame that the drawing is as bright as. @type {FrameHeader | null} */
    #like = null;
    /** What the server has been told. */
    #told = false;
    #openings = new Openings();
    #fades = new PlateFades();
    /** Ids of objects that are not shown. @type {Iterable<number>} */
    hidden = [];

    /**
     * @param {RaybundleApp} app
     * @param {{autoExposure: boolean}} display
     * @param {DrawingChoice} choice
     */
    constructor(app, display, choice) {
        super();
        this.app = app;
        this.display = display;
        this.#choice = choice;
        this.canvas = document.createElement('canvas');
        this.canvas.className = 'drawn';
        this.canvas.hidden = true;
        app.picture.canvas.after(this.canvas);
        app.client.settings.light = () => this.wanted && this.possible;
        this.#start();
    }

    /** Makes the context, if the page is to draw. */
    #start() {
        if (!this.wanted || this.#gl !== undefined) {
            return;
        }
        this.#gl = this.canvas.getContext('webgl2', {alpha: false, antialias: true, powerPreference: 'high-performance'});
        if (this.#gl) {
            this.#follow(this.#gl);
        }
    }

    /**
     * Whether the page is to draw, where it can. Without a GPU only if somebody asks for it: to measure how fast the
     * processor draws would stop the page for seconds, and it has the server's pictures to unpack.
     */
    get wanted() {
        return this.#choice === 'here' || (this.#choice === 'auto' && drawer() !== 'processor');
    }

    /** Whether this browser could draw, as far as it is known. */
    get possible() {
        return this.#gl !== null;
    }

    /** What is on screen is drawn here. */
    get visible() {
        return this.#visible;
    }

    get choice() {
        return this.#choice;
    }

    set choice(choice) {
        const comes = this.app.client.settings.light?.() && !this.light?.ignored;
        this.#choice = choice;
        this.#start();
        this.#decide();
        if (!comes && this.possible && this.wanted) {
            this.app.client.connect();  // light is asked for in the greeting
        }
    }

    /** Whether drawing takes too long here. */
    get slow() {
        return this.drawMs.count >= TRIALS && (this.drawMs.quantile(0.5) ?? 0) > SLOWEST_MS;
    }

    /** Whether the page draws when something moves. */
    get draws() {
        return (this.light?.complete ?? false) && this.wanted && (this.#choice === 'here' || !this.slow);
    }

    /** For people: who draws, and why. */
    get state() {
        if (!this.possible) {
            return 'Drawn by the server: this browser has no WebGL 2.';
        }
        if (this.#choice === 'pictures') {
            return 'Drawn by the server.';
        }
        if (!this.wanted) {
            return 'Drawn by the server: this browser has no GPU to draw with.';
        }
        if (this.light?.problem) {
            return `Drawn by the server: ${this.light.problem}`;
        }
        if (!this.light?.complete) {
            return 'Drawn by the server until the scene has been loaded here.';
        }
        const time = `${(this.drawMs.quantile(0.5) ?? 0).toFixed(0)} ms a picture`;
        return this.draws ? `Drawn here while something moves, ${time}.` : `Drawn by the server: here it takes ${time}.`;
    }

    /** @param {WebGL2RenderingContext} gl */
    #follow(gl) {
        const {app} = this;
        const light = new LiveLight(app.client, gl);
        this.light = light;
        light.addEventListener('complete', () => {
            this.#placeAll();
            this.#measure();
            this.#decide();
        });
        light.addEventListener('changed', () => {
            if (this.#visible) {
                this.#throttle.run();
            }
        });
        light.addEventListener('forgotten', () => {
            this.#like = null;
            this.#decide();
        });
        app.on('welcome', () => {
            this.#told = false;
            this.#epoch = app.scene?.epoch ?? 0;
            if (light.complete) {
                this.#placeAll();
                this.#decide();
            }
        });
        app.on('anew', (/** @type {{otherScene: boolean}} */ {otherScene}) => {
            if (otherScene) {
                light.forget();
            }
            light.doubt();  // another file may have the same name
            this.#hide();
        });
        app.on('view', () => this.#moved());
        app.on('moved', () => {
            this.#placeAll();
            this.#epoch = app.scene?.epoch ?? 0;
        });
        app.on('sceneChanged', (/** @type {import('../net/scene_types.js').SceneChanged} */ change) => {
            this.#fades.take(change, app.scene?.lights.find(({id}) => id === change.setLight?.light), performance.now());
            if (change.moveObject) {
                this.#moved();
            }
        });
        app.mover.addEventListener('moved', () => this.#moved());
        app.on('hidden', (/** @type {number[]} */ ids) => {
            this.hidden = ids;
            this.#placeAll();
        });
        app.on('picture', (/** @type {FrameHeader} */ header) => this.#pictureArrived(header));
        this.canvas.addEventListener('webglcontextlost', () => {
            light.forget();
            light.problem = 'the graphics driver has stopped drawing.';
            this.#hide();
            this.#decide();
        });
    }

    /** Tells the server who draws, and the page. */
    #decide() {
        const {draws} = this;
        if (this.light) {
            // Who leaves the drawing to the server needs no light.
            this.light.ignored = this.light.complete && !draws;
        }
        if (draws !== this.#told && this.app.client.state === 'connected') {
            this.#told = draws;
            this.app.client.request({setDrawing: {here: draws}}).answer.catch(() => {});
        }
        if (!draws) {
            this.#hide();
        }
        this.dispatchEvent(new Event('state'));
    }

    #placeAll() {
        const {renderer} = this.light ?? {};
        const {scene} = this.app;
        if (!renderer || !scene) {
            return;
        }
        placeObjects(renderer, scene, this.hidden);
        if (this.#visible) {
            this.#throttle.run();
        }
    }

    /** Luminaires as they are now. @param {import('../walkthrough/renderer.js').Renderer} renderer */
    #placePlates(renderer) {
        const {client, scene} = this.app;
        const now = performance.now();
        const lights = scene?.lights ?? [];
        renderer.plates = platesOf(this.#fades.shown(lights, now), this.#openings.known);
        if (this.#visible && this.#fades.running(now)) {
            requestAnimationFrame(() => this.#visible && this.#throttle.run());
        }
        this.#openings.lookUp(lights, () => client.httpHeaders).then((more) => {
            if (more && this.#visible) {
                this.#throttle.run();
            }
        });
    }

    /** The camera or an object has just moved. */
    #moved() {
        // Until there has been a picture, nothing is known of how bright it is to be.
        if (!this.draws || !this.app.frame) {
            return;
        }
        if (!this.#visible && !this.#isLike(this.app.frame)) {
            this.#followFrame(this.app.frame);
        }
        clearTimeout(this.#fading);
        this.#fading = undefined;
        this.canvas.classList.remove('fading');
        this.#throttle.run();
        this.#show();
    }

    /** Whether the drawing is exposed as a frame of the same scene from the same place. @param {FrameHeader} frame */
    #isLike({epoch, cameraId, exposure, scaleMaximum, scaleLinear, scaleIlluminance}) {
        const like = this.#like;
        return like !== null && like.epoch === epoch && like.cameraId === cameraId && like.exposure === exposure &&
            like.scaleMaximum === scaleMaximum && like.scaleLinear === scaleLinear && like.scaleIlluminance === scaleIlluminance;
    }

    /** @param {FrameHeader} frame  that is on screen */
    #followFrame(frame) {
        const {app} = this;
        const renderer = this.light?.renderer;
        if (renderer) {
            this.#like = frame;
            this.#exposure.follow(renderer, frame, app.link.shown ?? app.view, app.picture.aspect, app.picture.canvas);
        }
    }

    #show() {
        this.#visible = true;
        this.canvas.hidden = false;
        this.app.picture.covered = true;
    }

    #hide() {
        clearTimeout(this.#fading);
        this.#fading = undefined;
        this.#visible = false;
        this.canvas.hidden = true;
        this.canvas.classList.remove('fading');
        if (this.app.picture.covered) {
            this.app.picture.covered = false;
            this.app.drawOverlay();
        }
    }

    /** @param {FrameHeader} header */
    #pictureArrived(header) {
        const {app, light} = this;
        const {shown} = app.link;
        if (!light?.renderer || !light.complete || !shown || !this.draws) {
            return;
        }
        const rests = !app.camera.moving && sameView(shown, app.view) && app.mover.held === null &&
            header.epoch >= this.#epoch;
        if (!rests) {
            return;
        }
        if (this.#visible && this.#fading === undefined) {
            this.#fade();
        }
        const now = performance.now();
        if (now - this.#followed >= FOLLOW_MS && !this.#visible) {
            this.#followed = now;
            this.#followFrame(header);
        }
    }

    /** The server's picture, which lies below, comes to light. */
    #fade() {
        this.app.picture.covered = false;
        this.app.drawOverlay();
        this.canvas.classList.add('fading');
        this.#like = null;
        this.#fading = setTimeout(() => {
            this.#followed = -Infinity;
            this.#hide();
        }, FADE_MS);
    }

    /** Draws at once: for what reads the drawing, which is gone after its display frame. */
    redrawNow() {
        this.#draw();
    }

    /** How long drawing takes, before anybody waits for it. */
    #measure() {
        for (let i = 0; i < TRIALS; ++i) {
            this.#draw();
        }
    }

    #draw() {
        const {app, canvas} = this;
        const gl = this.#gl;
        const renderer = this.light?.renderer;
        if (!gl || !renderer || gl.isContextLost()) {
            return;
        }
        const measured = ++this.#drawings % MEASURED === 0 || this.drawMs.count < TRIALS;
        const start = performance.now();
        const {width, height} = app.picture.viewport;
        if (canvas.width !== width || canvas.height !== height) {
            Object.assign(canvas, {width, height});
        }
        this.#exposure.move(renderer, app.view, app.picture.aspect, this.display.autoExposure);
        this.#placePlates(renderer);
        renderer.draw(app.view, this.#exposure.look, width, height);
        if (measured) {
            gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
            this.drawMs.add(performance.now() - start);
            if (this.drawMs.count >= TRIALS && this.#told !== this.draws && this.#told) {
                this.#decide();
            }
        }
    }
}
