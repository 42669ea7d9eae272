// SPDX-License-Identifier: Apache-2.0
// The picture: shows frames, and says how large they should be.

import {cssMatrix, homography} from './view_warp.js';

/** @typedef {import('./protocol.js').Viewport} Viewport */
/** @typedef {import('./protocol.js').View} View */

/** Side of the small copy that fills what a warped picture leaves open, pixels. */
const BACKDROP_SIDE = 24;

/** Pixels asked for at most, by choice of the user. */
export const PICTURE_SIZES = Object.freeze({
    economy: 640 * 480,
    standard: 1280 * 960,
    full: Infinity,
});

/** @typedef {keyof typeof PICTURE_SIZES} PictureSize */

const MIN_SIDE = 16;
const SETTLE_MS = 150;

/**
 * Size of frames to ask for: the element's device pixels, made smaller in proportion to respect the
 * limits.
 *
 * @param {number} cssWidth
 * @param {number} cssHeight
 * @param {number} pixelRatio
 * @param {number} maxPixels
 * @param {{maxWidth: number, maxHeight: number}} limits
 * @returns {Viewport}
 */
export function fitViewport(cssWidth, cssHeight, pixelRatio, maxPixels, limits) {
    const width = Math.max(cssWidth * pixelRatio, 1);
    const height = Math.max(cssHeight * pixelRatio, 1);
    const factor = Math.min(
        1,
        Math.sqrt(maxPixels / (width * height)),
        limits.maxWidth / width,
        limits.maxHeight / height,
    );
    const side = (/** @type {number} */ length, /** @type {number} */ limit) =>
        Math.min(Math.max(Math.floor(length * factor), MIN_SIDE), limit);
    return {width: side(width, limits.maxWidth), height: side(height, limits.maxHeight)};
}

/** Event: `viewport`, when other frames should be asked for; `resize`, at once. */
export class Picture extends EventTarget {
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    #timer;
    /** @type {PictureSize} */
    #size = 'standard';
    /** @type {HTMLCanvasElement} */
    #backdrop;

    /**
     * @param {HTMLElement} element
     * @param {HTMLCanvasElement} canvas  within it
     */
    constructor(element, canvas) {
        super();
        this.element = element;
        this.canvas = canvas;
        this.limits = {maxWidth: 3840, maxHeight: 2160};
        const context = canvas.getContext('2d', {alpha: false});
        if (!context) {
            throw new Error('This browser offers no 2D canvas.');
        }
        this.context = context;
        this.#backdrop = document.createElement('canvas');
        this.#backdrop.className = 'backdrop';
        this.#backdrop.width = this.#backdrop.height = BACKDROP_SIDE;
        element.prepend(this.#backdrop);
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

    /**
     * Shows a frame. Setting a canvas's size clears it, but nothing is painted before the drawing
     * that follows, so the old picture stays until the new one is there.
     *
     * @param {ImageBitmap} image
     */
    draw(image) {
        if (this.canvas.width !== image.width || this.canvas.height !== image.height) {
            this.canvas.width = image.width;
            this.canvas.height = image.height;
        }
        this.context.drawImage(image, 0, 0);
        const small = this.#backdrop.getContext('2d', {alpha: false});
        small?.drawImage(image, 0, 0, BACKDROP_SIDE, BACKDROP_SIDE);
        this.element.classList.add('has-picture');
    }

    /**
     * Puts the picture where it belongs in a view, until the server's picture of it is there.
     *
     * @param {View} shown  that the picture was made for
     * @param {View} view  wanted now
     */
    warp(shown, view) {
        const {clientWidth, clientHeight} = this.element;
        const matrix = homography(shown, this.shownAspect, view, this.aspect);
        this.canvas.style.transform = matrix ? cssMatrix(matrix, clientWidth, clientHeight) : '';
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
