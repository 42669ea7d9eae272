// SPDX-License-Identifier: Apache-2.0
// The picture of a walkthrough: as fine as the display, drawn when something has changed.

import {automaticExposure} from './off_screen.js';
import {Renderer} from './renderer.js';

/**
 * @typedef {import('../camera/camera_control.js').CameraControl} CameraControl
 * @typedef {import('./scene_data.js').SceneData} SceneData
 * @typedef {import('./renderer.js').Look} Look
 */

/** How long the automatic exposure is kept, milliseconds: reading it back holds the GPU up. */
const EXPOSURE_MS = 200;
/** How soon it follows, seconds. */
const ADAPTATION_S = 0.25;
/** Nearer is the same, EV. */
const SAME_EXPOSURE = 0.005;

export class Picture {
    #wanted = 0;
    #found = -Infinity;
    #last = 0;
    /** Automatic exposure, EV: shown, and on its way to. */
    #exposure = {shown: NaN, found: 0};
    /** What the user adds, EV. */
    compensation = 0;
    /** @type {'photo' | 'luminance' | 'illuminance'} */
    mode = 'photo';
    /** Upper ends of the colour scales, cd/m² and lx. */
    maximum = {luminance: 1000, illuminance: 1000};
    /** Called after each frame. @type {() => void} */
    drawn = () => {};
    frames = 0;

    /**
     * @param {HTMLCanvasElement} canvas
     * @param {WebGL2RenderingContext} gl
     * @param {SceneData} scene
     * @param {CameraControl} camera
     */
    constructor(canvas, gl, scene, camera) {
        this.canvas = canvas;
        this.gl = gl;
        this.camera = camera;
        this.renderer = new Renderer(gl, scene);
        new ResizeObserver(() => this.changed()).observe(canvas);
        camera.addEventListener('change', () => this.changed());
    }

    /** @returns {number} width over height */
    get aspect() {
        return this.canvas.clientWidth / Math.max(this.canvas.clientHeight, 1);
    }

    /** Of the tone curve, EV. */
    get exposure() {
        return (Number.isNaN(this.#exposure.shown) ? this.#exposure.found : this.#exposure.shown) + this.compensation;
    }

    /** The picture is no longer what it should be. */
    changed() {
        this.#wanted ||= requestAnimationFrame((now) => this.#frame(now));
    }

    /** @returns {Look} */
    get look() {
        const maximum = this.mode === 'photo' ? 1 : this.maximum[this.mode];
        return {mode: this.mode, exposure: this.exposure, maximum};
    }

    #fit() {
        const {canvas} = this;
        const most = this.gl.getParameter(this.gl.MAX_RENDERBUFFER_SIZE);
        const pixels = (/** @type {number} */ length) =>
            Math.min(Math.max(Math.round(length * devicePixelRatio), 1), most);
        const [width, height] = [pixels(canvas.clientWidth), pixels(canvas.clientHeight)];
        if (canvas.width !== width || canvas.height !== height) {
            canvas.width = width;
            canvas.height = height;
        }
    }

    /** @param {number} now */
    #frame(now) {
        this.#wanted = 0;
        this.#fit();
        this.#expose(now);
        const {canvas} = this;
        this.renderer.draw(this.camera.view, this.look, canvas.width, canvas.height);
        ++this.frames;
        this.drawn();
    }

    /** @param {number} now */
    #expose(now) {
        const {shown, found} = this.#exposure;
        if (now - this.#found >= EXPOSURE_MS) {
            this.#found = now;
            this.#exposure.found = automaticExposure(this.renderer, this.camera.view, this.aspect) ?? found;
        }
        const seconds = Math.min((now - this.#last) / 1000, 0.1);
        this.#last = now;
        const step = (this.#exposure.found - shown) * (1 - Math.exp(-seconds / ADAPTATION_S));
        const near = !(Math.abs(this.#exposure.found - shown) > SAME_EXPOSURE);
        this.#exposure.shown = near ? this.#exposure.found : shown + step;
        if (!near || this.camera.moving) {
            this.changed();
        }
    }
}
