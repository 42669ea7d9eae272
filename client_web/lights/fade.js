// SPDX-License-Identifier: Apache-2.0
// How long lamps, groups and lighting scenes take to become what they are set to: one time for all of them.

import {remember, remembered} from '../camera/walking.js';
import {byId} from '../ui/elements.js';

const MAX_FADE_S = 60;

/**
 * What a field of seconds says.
 *
 * @param {string | null} text
 * @returns {number} s, 0 to 60, to a tenth; what is no number is 0
 */
export function fadeSeconds(text) {
    const seconds = Math.round(10 * Number(text)) / 10;
    return seconds > 0 ? Math.min(seconds, MAX_FADE_S) : 0;
}

/** The field, which this browser remembers. */
export class Fade {
    #seconds = byId('fade-seconds', HTMLInputElement);

    constructor() {
        this.#seconds.value = String(fadeSeconds(remembered('fade')));
        this.#seconds.addEventListener('change', () => {
            this.#seconds.value = String(fadeSeconds(this.#seconds.value));
            remember('fade', this.#seconds.value);
        });
    }

    /** What a request says of the time that it takes. @returns {{fadeSeconds?: number}} */
    get slowly() {
        const seconds = fadeSeconds(this.#seconds.value);
        return seconds > 0 ? {fadeSeconds: seconds} : {};
    }

    /** @param {boolean} useful  there is a lamp, and who looks may set it */
    show(useful) {
        byId('fade-field', HTMLElement).hidden = !useful;
    }
}
