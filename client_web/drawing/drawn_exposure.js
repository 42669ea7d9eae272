// SPDX-License-Identifier: Apache-2.0
// How bright the page's own drawing is: as the server's picture, from which it takes over, and from there on as the
// server would have it.

import {automaticExposure, readDisplay} from '../walkthrough/off_screen.js';

/**
 * @typedef {import('../walkthrough/renderer.js').Renderer} Renderer
 * @typedef {import('../walkthrough/renderer.js').Look} Look
 * @typedef {import('../net/scene_types.js').View} View
 * @typedef {import('../net/protocol.js').FrameHeader} FrameHeader
 */

/** How long the automatic exposure is kept, milliseconds: reading it back holds the GPU up. */
const EXPOSURE_MS = 200;
/** How soon it follows, seconds. */
const ADAPTATION_S = 0.25;
/** Height of what brightness is compared in, pixels; its shape is that of the picture. */
const COMPARED_HEIGHT = 48;
/** Display codes go about as this power of light. */
const DISPLAY_GAMMA = 2.2;
/** The drawing is matched to a picture so often, and by so much, EV: what differs more is not its exposure. */
const MATCHES = 2;
const MOST_MATCHED = 0.5;

/** @param {ArrayLike<number>} pixels  RGBA */
function mean(pixels) {
    let sum = 0;
    for (let i = 0; i < pixels.length; i += 4) {
        sum += pixels[i] + pixels[i + 1] + pixels[i + 2];
    }
    return (4 * sum) / (3 * pixels.length);
}

/**
 * How the server has shown a frame.
 *
 * @param {FrameHeader} header
 * @returns {Look}
 */
export function lookOf({exposure, scaleMaximum, scaleLinear = false, scaleIlluminance = false}) {
    return scaleMaximum === undefined
        ? {mode: 'photo', exposure, maximum: 1}
        : {mode: scaleIlluminance ? 'illuminance' : 'luminance', exposure, maximum: scaleMaximum, linear: scaleLinear};
}

export class DrawnExposure {
    /** @type {Look} */
    #look = {mode: 'photo', exposure: 0, maximum: 1};
    /** EV: what the server's exposure is beyond that of the drawing, and what makes both as bright. */
    #beyond = 0;
    #match = 0;
    #shown = 0;
    #wanted = 0;
    #found = -Infinity;
    #last = 0;
    #small = new OffscreenCanvas(1, 1).getContext('2d', {alpha: false, willReadFrequently: true});

    /**
     * The server's picture has come.
     *
     * @param {Renderer} renderer
     * @param {FrameHeader} header
     * @param {View} view  that it shows
     * @param {number} aspect  of the picture, width over height
     * @param {CanvasImageSource} picture
     */
    follow(renderer, header, view, aspect, picture) {
        this.#look = lookOf(header);
        this.#shown = this.#wanted = header.exposure;
        this.#match = 0;
        this.#found = -Infinity;
        this.#last = performance.now();
        if (this.#look.mode !== 'photo' || !this.#small) {
            return;
        }
        this.#beyond = header.exposure - (automaticExposure(renderer, view, aspect) ?? header.exposure);
        const size = {width: Math.max(Math.round(COMPARED_HEIGHT * aspect), 1), height: COMPARED_HEIGHT};
        Object.assign(this.#small.canvas, size);
        this.#small.imageSmoothingQuality = 'high';
        this.#small.drawImage(picture, 0, 0, size.width, size.height);
        const aim = mean(this.#small.getImageData(0, 0, size.width, size.height).data);
        for (let i = 0; i < MATCHES; ++i) {
            const own = mean(readDisplay(renderer, view, this.look, size.width, size.height));
            const step = own > 0 && aim > 0 ? DISPLAY_GAMMA * Math.log2(aim / own) : 0;
            this.#match = Math.min(Math.max(this.#match + step, -MOST_MATCHED), MOST_MATCHED);
        }
    }

    /**
     * The drawing has moved on.
     *
     * @param {Renderer} renderer
     * @param {View} view
     * @param {number} aspect
     * @param {boolean} automatic  whether the server follows the picture
     */
    move(renderer, view, aspect, automatic) {
        const now = performance.now();
        if (automatic && this.#look.mode === 'photo' && now - this.#found >= EXPOSURE_MS) {
            this.#found = now;
            this.#wanted = (automaticExposure(renderer, view, aspect) ?? this.#wanted - this.#beyond) + this.#beyond;
        }
        const seconds = Math.min((now - this.#last) / 1000, 0.1);
        this.#last = now;
        this.#shown += (this.#wanted - this.#shown) * (1 - Math.exp(-seconds / ADAPTATION_S));
    }

    /** @returns {Look} */
    get look() {
        return {...this.#look, exposure: this.#shown + this.#match};
    }
}
