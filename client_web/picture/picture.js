// SPDX-License-Identifier: Apache-2.0
// The picture: shows frames, and says how large they should be.

import {sameView} from '../camera/camera.js';
import {DepthWarp} from './depth_warp.js';
import {FrameThrottle} from './frame_throttle.js';
import {Samples} from '../measure/meters.js';
import {cssMatrix, homography} from './view_warp.js';

/** @typedef {import('./depths.js').Depths} Depths */
/** @typedef {import('../net/protocol.js').Viewport} Viewport */
/** @typedef {import('../net/scene_types.js').View} View */

/**
 * Side of the small copy that fills what a warped picture leaves open, pixels. So few are soft when they are
 * stretched; a blur of the whole picture took a browser without a GPU half of each frame's time.
 */
const BACKDROP_SIDE = 12;

/** Pixels asked for at most, by choice of the user. */
export const PICTURE_SIZES = Object.freeze({
    economy: 640 * 480,
    standard: 1280 * 960,
    full: Infinity,
});

/** @typedef {keyof typeof PICTURE_SIZES} PictureSize */

const MIN_SIDE = 16;
/** One redraw in so many is measured, and the first ones but one: the page waits for it. */
const MEASURED = 16;
const REDRAWS_KEPT = 9;
const FEWEST_MEASURED = 3;
const SETTLE_MS = 150;

/**
 * Size of frames to ask for: the element's device pixels, made smaller in proportion to respect the
 * limits.
 *
 * @param {number} cssWidth
 * @param {number} cssHeight
 * @param {number} pixelRatio
 * @param {number} maxPixels
 * @param {import('../net/protocol.js').Limits} limits
 * @returns {Viewport}
 */
export function fitViewport(cssWidth, cssHeight, pixelRatio, maxPixels, limits) {
    const width = Math.max(cssWidth * pixelRatio, 1);
    const height = Math.max(cssHeight * pixelRatio, 1);
    const {maxWidth, maxHeight, maxViewportPixels, maxViewportEdge} = limits;
    const most = {width: maxViewportEdge || maxWidth, height: maxViewportEdge || maxHeight};
    const factor = Math.min(
        1,
        Math.sqrt(Math.min(maxPixels, maxViewportPixels || Infinity) / (width * height)),
        most.width / width,
        most.height / height,
    );
    const side = (/** @type {number} */ length, /** @type {number} */ limit) =>
        Math.min(Math.max(Math.floor(length * factor), MIN_SIDE), limit);
    return {width: side(width, most.width), height: side(height, most.height)};
}

/**
 * Events: `viewport`, when other frames should be asked for; `resize`, at once; `flat`, when depths have turned
 * out to be of no use.
 */
export class Picture extends EventTarget {
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    #timer;
    /** @type {PictureSize} */
    #size = 'standard';
    /** @type {HTMLCanvasElement} */
    #backdrop;
    /** @type {CanvasRenderingContext2D | null} */
    #small;
    /** Draws pictures that have depths, where the browser can. @type {DepthWarp | null} */
    #warp = null;
    /** Of the picture on screen. @type {Depths | null} */
    #depths = null;
    /** Whether they and the picture are in #warp. */
    #loaded = false;
    /** @type {{shown: View, view: View} | null} */
    #wanted = null;
    #throttle = new FrameThrottle(() => this.redraw());
    #redraws = 0;
    /** What a redraw takes, as measured now and then, until it is done. */
    redrawMs = new Samples(REDRAWS_KEPT);
    /** Something else is drawn over it: it need not follow the camera. */
    covered = false;
    /** Where redraws take longer, pictures are flat ones: there would be no 60 of them a second, ms. */
    slowestRedrawMs = 12;

    /**
     * @param {HTMLElement} element
     * @param {HTMLCanvasElement} canvas  within it
     */
    constructor(element, canvas) {
        super();
        this.element = element;
        this.canvas = canvas;
        /** @type {import('../net/protocol.js').Limits} */
        this.limits = {maxWidth: 3840, maxHeight: 2160};
        const context = canvas.getContext('2d', {alpha: false});
        if (!context) {
            throw new Error('This browser offers no 2D canvas.');
        }
        this.context = context;
        this.#backdrop = document.createElement('canvas');
        this.#backdrop.className = 'backdrop';
        this.#backdrop.width = this.#backdrop.height = BACKDROP_SIDE;
        // It is read again and again, to know how bright the picture is.
        this.#small = this.#backdrop.getContext('2d', {alpha: false, willReadFrequently: true});
        element.prepend(this.#backdrop);
        this.#addWarp();
        new ResizeObserver(() => this.#resized()).observe(element);
        this.#watchPixelRatio();
    }

    /** Width over height. */
    get aspect() {
        return this.element.clientWidth / Math.max(this.element.clientHeight, 1);
    }

    /** Width over height of the frame on screen. */
    get shownAspect() {
        return this.canvas.width / this.canvas.height;
    }

    get size() {
        return this.#size;
    }

    set size(size) {
        this.#size = size;
        this.dispatchEvent(new Event('viewport'));
    }

    /**
     * Size of frames wanted now.
     *
     * @returns {Viewport}
     */
    get viewport() {
        const {clientWidth, clientHeight} = this.element;
        const maxPixels = PICTURE_SIZES[this.#size];
        return fitViewport(clientWidth, clientHeight, devicePixelRatio, maxPixels, this.limits);
    }

    /** Whether depths are of use to it. */
    get takesDepths() {
        return this.#warp !== null && !this.#slow;
    }

    /** What it draws from other places, while that is on screen. */
    get warped() {
        return this.#warp && !this.#warp.canvas.hidden ? this.#warp.canvas : null;
    }

    /** Mean of the pixels of the frame on screen, 0..255 as encoded. */
    get brightness() {
        const pixels = this.#small?.getImageData(0, 0, BACKDROP_SIDE, BACKDROP_SIDE).data ?? [];
        const colours = [...pixels].filter((_, i) => i % 4 !== 3);
        return colours.reduce((sum, value) => sum + value, 0) / Math.max(colours.length, 1);
    }

    /**
     * Shows a frame. Setting a canvas's size clears it, but nothing is painted before the drawing
     * that follows, so the old picture stays until the new one is there.
     *
     * @param {ImageBitmap} image
     * @param {Depths | null} depths
     */
    draw(image, depths = null) {
        if (this.canvas.width !== image.width || this.canvas.height !== image.height) {
            this.canvas.width = image.width;
            this.canvas.height = image.height;
        }
        this.context.drawImage(image, 0, 0);
        this.#small?.drawImage(image, 0, 0, BACKDROP_SIDE, BACKDROP_SIDE);
        this.#depths = depths;
        this.#loaded = false;
        this.element.classList.add('has-picture');
    }

    /** Takes the picture away, until there is another one. */
    clear() {
        this.context.fillRect(0, 0, this.canvas.width, this.canvas.height);
        this.#small?.fillRect(0, 0, BACKDROP_SIDE, BACKDROP_SIDE);
        this.#depths = null;
        this.#wanted = null;
        this.#throttle.cancel();
        this.#showWarped(false);
        this.element.classList.remove('has-picture');
    }

    /**
     * Puts the picture where it belongs in a view, until the server's picture of it is there: by its
     * depths, where it has any, else as a flat one.
     *
     * @param {View} shown  that the picture was made for
     * @param {View} view  wanted now
     */
    warp(shown, view) {
        if (this.covered) {
            this.#throttle.cancel();
            return;
        }
        const deep = this.warping === 'by depth' && !sameView(shown, view);
        this.#wanted = deep ? {shown, view} : null;
        if (deep) {
            this.#throttle.run();
        } else {
            this.#throttle.cancel();
            const {clientWidth, clientHeight} = this.element;
            const matrix = homography(shown, this.shownAspect, view, this.aspect);
            this.canvas.style.transform = matrix ? cssMatrix(matrix, clientWidth, clientHeight) : '';
            this.#showWarped(false);
        }
    }

    /** How the picture gets to its place: `by depth` or `flat`. */
    get warping() {
        return this.#depths !== null && this.#warp?.usable && !this.#slow ? 'by depth' : 'flat';
    }

    get #slow() {
        const {count} = this.redrawMs;
        return count >= FEWEST_MEASURED && (this.redrawMs.quantile(0.5) ?? 0) > this.slowestRedrawMs;
    }

    /** Draws the picture by its depths as warp() wants it. */
    redraw() {
        const warp = this.#warp;
        if (!this.#wanted || !this.#depths || !warp?.usable) {
            return;
        }
        const start = performance.now();
        const {shown, view} = this.#wanted;
        if (!this.#loaded) {
            const {width, height} = this.canvas;
            Object.assign(warp.canvas, {width, height});
            warp.load(this.canvas, this.#depths);
            this.#loaded = true;
        }
        warp.draw(shown, this.shownAspect, view, this.aspect, this.#depths.nearest);
        this.#showWarped(true);
        const early = ++this.#redraws > 1 && this.#redraws <= 1 + FEWEST_MEASURED;
        if (early || this.#redraws % MEASURED === 0) {
            warp.finish();
            this.redrawMs.add(performance.now() - start);
            if (this.#slow) {
                this.dispatchEvent(new Event('flat'));
            }
        }
    }

    /** @param {boolean} warped */
    #showWarped(warped) {
        if (this.#warp && this.#warp.canvas.hidden === warped) {
            this.#warp.canvas.hidden = !warped;
            this.canvas.style.visibility = warped ? 'hidden' : '';
        }
    }

    #addWarp() {
        const canvas = document.createElement('canvas');
        canvas.hidden = true;
        canvas.className = 'warped';
        try {
            this.#warp = new DepthWarp(canvas);
        } catch {
            return;  // flat, then
        }
        canvas.addEventListener('webglcontextlost', () => this.#showWarped(false));
        canvas.addEventListener('webglcontextrestored', () => (this.#loaded = false));
        this.canvas.after(canvas);
    }

    #resized() {
        this.dispatchEvent(new Event('resize'));
        clearTimeout(this.#timer);
        this.#timer = setTimeout(() => this.dispatchEvent(new Event('viewport')), SETTLE_MS);
    }

    /** Moving the window to another screen, or zooming the page, changes the pixel ratio. */
    #watchPixelRatio() {
        const query = matchMedia(`(resolution: ${devicePixelRatio}dppx)`);
        query.addEventListener(
            'change',
            () => {
                this.#resized();
                this.#watchPixelRatio();
            },
            {once: true},
        );
    }
}
