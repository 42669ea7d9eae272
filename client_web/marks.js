// SPDX-License-Identifier: Apache-2.0
// Marks over the picture that stay at points of the scene: measured values, pins, other people.

import {byId} from './elements.js';

/**
 * @typedef {import('./app.js').RaybundleApp} RaybundleApp
 * @typedef {import('./protocol.js').Vec3} Vec3
 */

/** Marks of points nearer to the eye's plane are hidden, metres. */
const NEAR = 0.02;

export class Marks {
    #layer = byId('marks', HTMLElement);
    /** @type {Map<HTMLElement, () => Vec3>} */
    #marks = new Map();

    /** @param {RaybundleApp} app */
    constructor(app) {
        this.app = app;
        app.overlay.add(({place, width, height}) => {
            for (const [element, where] of this.#marks) {
                const {x, y, depth} = place(where());
                const seen = depth > NEAR && x > -50 && y > -50 && x < width + 50 && y < height + 50;
                element.hidden = !seen;
                if (seen) {
                    element.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
                }
            }
        });
    }

    /**
     * Adds a mark.
     *
     * @param {HTMLElement} element
     * @param {() => Vec3} where  world space
     * @returns {HTMLElement} the element
     */
    add(element, where) {
        element.classList.add('mark');
        this.#marks.set(element, where);
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
