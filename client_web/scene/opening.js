// SPDX-License-Identifier: Apache-2.0
// What is said while a scene is opened or made ready: which step it is at, for how long, and how long still.

import {byId} from '../ui/elements.js';
import {duration} from '../measure/target_panel.js';

/**
 * @typedef {import('../net/protocol.js').SceneOpening} SceneOpening
 * @typedef {'READING' | 'PREPARING' | 'COMPILING'} Step
 */

const FIRST_PICTURE = 'Drawing the first picture';

/** @type {Record<string, string>} */
const STEPS = {
    READING: '1 of 3: reading',
    PREPARING: '2 of 3: preparing surfaces',
    COMPILING: '3 of 3: preparing light',
    // Connections are closed and come back; its light is still being prepared.
    READY: '3 of 3: preparing light',
};

/**
 * How far a scene is that is being opened, or made ready.
 *
 * @param {{name: string, byName: string, stage: string}} opening
 * @param {boolean} mine
 * @returns {string} empty where it is over
 */
export function progressText({name, byName, stage}, mine) {
    const who = mine ? 'Opening' : byName ? `${byName} opens` : 'The server is preparing';
    // A server that has just started has shown no picture yet.
    const pauses = STEPS[stage] === STEPS.COMPILING && (mine || byName !== '');
    return STEPS[stage] ? `${who} ${name} (${STEPS[stage]}).${pauses ? ' The picture pauses.' : ''}` : '';
}

/**
 * @param {number} elapsed  seconds since it has begun
 * @param {number | null} left  seconds foreseen from now on; null: not known
 * @returns {string}
 */
export function timeText(elapsed, left) {
    const begun = elapsed < 1 ? '' : `${duration(elapsed)} so far`;
    if (left === null) {
        return begun;
    }
    const more = left > 0.5 ? `about ${duration(left)} left` : 'longer than foreseen';
    return [begun, more].filter(Boolean).join(', ');
}

/** The card over the picture. */
export class OpeningCard {
    #card = byId('preparing', HTMLElement);
    #steps = byId('preparing-steps', HTMLElement);
    #time = byId('preparing-time', HTMLElement);
    /** @type {SceneOpening | null} */
    #opening = null;
    #began = 0;
    /** When it is foreseen to end, clock of performance.now(); null: not known. @type {number | null} */
    #end = null;

    /** Scene that is being opened; empty: none. */
    get name() {
        return this.#opening?.name ?? '';
    }

    /**
     * @param {SceneOpening | null} opening  null: none any more
     * @param {boolean} mine
     */
    show(opening, mine) {
        const now = performance.now();
        if (opening && this.#opening?.name !== opening.name) {
            this.#began = now;
            this.#end = null;
        }
        this.#opening = opening;
        const {secondsLeft} = opening ?? {};
        this.#end = secondsLeft === undefined ? this.#end : now + 1000 * secondsLeft;
        // Until the server lets the picture stand still everybody goes on with it.
        const paused = opening !== null && !['READING', 'PREPARING'].includes(opening.stage);
        this.#card.classList.toggle('opening', opening !== null);
        this.#card.classList.toggle('paused', paused || opening?.by === 0);
        byId('picture', HTMLElement).classList.toggle('giving-way', paused);
        byId('preparing-text', HTMLElement).textContent = opening ? progressText(opening, mine) : FIRST_PICTURE;
        this.#steps.hidden = opening === null;
        const items = [...this.#steps.children].map((item) => /** @type {HTMLElement} */ (item));
        const step = opening?.stage === 'READY' ? 'COMPILING' : opening?.stage;
        const at = items.findIndex((item) => item.dataset.stage === step);
        items.forEach((item, i) => {
            item.dataset.state = at < 0 || i < at ? 'done' : i === at ? 'now' : 'next';
        });
        this.tick();
    }

    /** @param {boolean} shown */
    set visible(shown) {
        this.#card.hidden = !shown;
    }

    /** Moves the time on. */
    tick() {
        const now = performance.now();
        const left = this.#end === null ? null : (this.#end - now) / 1000;
        this.#time.hidden = this.#opening === null;
        this.#time.textContent = this.#opening ? timeText((now - this.#began) / 1000, left) : '';
    }
}
