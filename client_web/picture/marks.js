// SPDX-License-Identifier: Apache-2.0
// Marks over the picture that stay at points of the scene: measured values, pins, other people.

import {byId} from '../ui/elements.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('../net/scene_types.js').Vec3} Vec3
 */

/** Marks of points nearer to the eye's plane are hidden, metres. */
const NEAR = 0.02;
/** Room that a measured value takes beside its point, CSS pixels. */
const LABEL = 190;
/** Between what stays whole and the picture's edge, CSS pixels. */
const MARGIN = 8;

export class Marks {
    #layer = byId('marks', HTMLElement);
    /** @type {Map<HTMLElement, {where: () => Vec3, whole: boolean}>} */
    #marks = new Map();

    /** @param {RaybundleApp} app */
    constructor(app) {
        this.app = app;
        app.overlay.add(({place, width, height}) => {
            for (const [element, {where, whole}] of this.#marks) {
                const {x, y, depth} = place(where());
                const seen = depth > NEAR && x > -50 && y > -50 && x < width + 50 && y < height + 50;
                element.hidden = !seen && !whole;
                if (seen || whole) {
                    const at = whole ? within(element, {x, y}, {width, height}) : {x, y};
                    element.classList.toggle('leftwards', x > Math.max(width - LABEL, width / 2));
                    element.style.transform = `translate(${at.x.toFixed(1)}px, ${at.y.toFixed(1)}px)`;
                }
            }
        });
    }

    /**
     * Adds a mark.
     *
     * @param {HTMLElement} element
     * @param {() => Vec3} where  world space
     * @param {boolean} whole  stays within the picture with all that it is, for what somebody writes in
     * @returns {HTMLElement} the element
     */
    add(element, where, whole = false) {
        element.classList.add('mark');
        this.#marks.set(element, {where, whole});
        this.#layer.append(element);
        this.app.drawOverlay();
        return element;
    }

    /** @param {HTMLElement | null} element */
    remove(element) {
        if (element) {
            this.#marks.delete(element);
            element.remove();
        }
    }
}

/**
 * Place at which the whole of an element is in the picture, as far as there is room.
 *
 * @param {HTMLElement} element
 * @param {{x: number, y: number}} at  CSS pixels, wanted
 * @param {{width: number, height: number}} picture  CSS pixels
 */
function within({offsetLeft, offsetTop, offsetWidth, offsetHeight}, at, {width, height}) {
    const fit = (/** @type {number} */ value, /** @type {number} */ start, /** @type {number} */ room) =>
        Math.max(Math.min(value, room - start - MARGIN), MARGIN - start);
    return {
        x: fit(at.x, offsetLeft, width - offsetWidth),
        y: fit(at.y, offsetTop, height - offsetHeight),
    };
}
