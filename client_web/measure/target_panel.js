// SPDX-License-Identifier: Apache-2.0
// When the server may stop: an error, a time, or never; and when that will be.

import {byId, showValue} from '../ui/elements.js';
import {percent} from '../ui/format.js';

/** @typedef {import('../app/app.js').RaybundleApp} RaybundleApp */
/** @typedef {'none' | 'error' | 'seconds'} TargetKind */

/** Ends of the sliders, which are logarithmic: relative error and seconds. */
const RANGES = {error: {from: 0.2, to: 0.005}, seconds: {from: 2, to: 600}};

/**
 * Value of a slider.
 *
 * @param {'error' | 'seconds'} kind
 * @param {number} position  0..1
 * @returns {number} with two significant digits
 */
export function targetAt(kind, position) {
    const {from, to} = RANGES[kind];
    return Number((from * (to / from) ** position).toPrecision(2));
}

/**
 * A time for people.
 *
 * @param {number} seconds
 * @returns {string}
 */
export function duration(seconds) {
    if (seconds < 1) {
        return 'less than a second';
    }
    if (seconds < 100) {
        return `${Math.round(seconds)} s`;
    }
    return seconds < 6000 ? `${Math.round(seconds / 60)} min` : `${Math.round(seconds / 3600)} h`;
}

export class TargetPanel {
    /** @type {TargetKind} */
    #kind = 'none';
    #field = byId('target-field', HTMLElement);
    #slider = byId('target-slider', HTMLInputElement);

    /** @param {RaybundleApp} app */
    constructor(app) {
        this.app = app;
        for (const button of this.#buttons()) {
            button.addEventListener('click', () => {
                this.#choose(/** @type {TargetKind} */ (button.dataset.target));
            });
        }
        this.#slider.addEventListener('input', () => this.#show());
        this.#slider.addEventListener('change', () => this.#send());
        app.on('welcome', () => this.#send());
        app.on('solution', (solution) => this.#predict(solution));
        this.#show();
    }

    /** @returns {HTMLButtonElement[]} */
    #buttons() {
        return [...document.querySelectorAll('button[data-target]')].map(
            (button) => /** @type {HTMLButtonElement} */ (button),
        );
    }

    /** @param {TargetKind} kind */
    #choose(kind) {
        this.#kind = kind;
        for (const button of this.#buttons()) {
            button.setAttribute('aria-pressed', String(button.dataset.target === kind));
        }
        this.#field.hidden = kind === 'none';
        this.#show();
        this.#send();
    }

    #show() {
        const kind = this.#kind;
        if (kind === 'none') {
            this.app.readouts.target = null;
            showValue('prediction', 'The picture keeps getting better while somebody looks.');
            return;
        }
        const value = targetAt(kind, Number(this.#slider.value));
        const text = kind === 'error' ? percent(value) : duration(value);
        byId('target-label', HTMLElement).textContent = kind === 'error' ? 'Error' : 'Time';
        byId('target-value', HTMLElement).textContent = text;
        this.#slider.setAttribute('aria-valuetext', text);
        this.app.readouts.target = kind === 'error' ? value : null;
    }

    #send() {
        const kind = this.#kind;
        const value = kind === 'none' ? 0 : targetAt(kind, Number(this.#slider.value));
        const goals = {none: {}, error: {relativeError: value}, seconds: {seconds: value}};
        this.app.client.send({setTarget: goals[kind]});
    }

    /** @param {import('../net/protocol.js').Solution} solution */
    #predict({secondsToTarget: seconds, targetOutOfReach}) {
        if (this.#kind === 'none') {
            return;
        }
        if (targetOutOfReach) {
            showValue('prediction', 'As accurate as its pixels allow. The server rests until something changes.');
        } else if (seconds === undefined) {
            showValue('prediction', 'No prediction yet.');
        } else if (seconds <= 0) {
            showValue('prediction', 'Reached. The server rests until something changes.');
        } else {
            showValue('prediction', `About ${duration(seconds)} to go.`);
        }
    }
}
