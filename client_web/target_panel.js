// SPDX-License-Identifier: Apache-2.0
// When the server may stop: an error, a time, or never; and when that will be.

import {byId, showValue} from './elements.js';
import {percent} from './format.js';

/** @typedef {import('./app.js').RaybundleApp} RaybundleApp */
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

    /** @param {import('./protocol.js').Solution} solution */
    #predict({secondsToTarget: seconds}) {
        if (this.#kind === 'none') {
            return;
        }
        if (seconds === undefined) {
            showValue('prediction', 'No prediction yet.');
        } else if (seconds <= 0) {
            showValue('prediction', 'Reached. The server rests until something changes.');
        } else {
            showValue('prediction', `About ${duration(seconds)} to go.`);
        }
    }
}

/**
 * What an effect of the plan costs and brings.
 *
 * @param {import('./protocol.js').Effect} effect
 * @returns {string} empty where nothing is to be said
 */
export function effectCost({active, pathClass, shareBound, bytesPerPatch, msPerIteration}) {
    if (!active) {
        return '';
    }
    const share = shareBound !== undefined && shareBound < 1 ? `at most ${percent(shareBound)} of the light` : '';
    const memory = bytesPerPatch ? `${bytesPerPatch} bytes a patch` : '';
    const time = msPerIteration === undefined ? '' : `${msPerIteration.toFixed(1)} ms an iteration`;
    return [time, pathClass ? `paths ${pathClass}` : '', memory, share].filter(Boolean).join(' · ');
}

/**
 * @param {import('./protocol.js').Effect} effect
 * @returns {HTMLLIElement}
 */
function effectRow(effect) {
    const {name, active, reason} = effect;
    const item = document.createElement('li');
    item.className = active ? 'on' : 'off';
    const title = document.createElement('b');
    title.textContent = name.replaceAll('-', ' ');
    const state = document.createElement('span');
    state.className = 'tag';
    state.textContent = active ? 'on' : 'off';
    const why = document.createElement('p');
    why.textContent = reason;
    item.append(title, state, why);
    const cost = effectCost(effect);
    if (cost) {
        const figures = document.createElement('p');
        figures.className = 'cost';
        figures.textContent = cost;
        item.append(figures);
    }
    return item;
}

/**
 * Lists the effects plan: what the scene calls for, and why; folded, what it does not, and why not.
 *
 * @param {import('./protocol.js').Effect[]} effects
 */
export function showEffects(effects) {
    const on = effects.filter(({active}) => active);
    const off = effects.filter(({active}) => !active);
    byId('effects', HTMLElement).replaceChildren(...on.map(effectRow));
    byId('effects-off', HTMLElement).replaceChildren(...off.map(effectRow));
    byId('effects-off-count', HTMLElement).textContent = `Not needed here: ${off.length}`;
    byId('effects-off-details', HTMLElement).hidden = off.length === 0;
}

/**
 * The effects plan, and what each effect costs where somebody has it measured.
 *
 * @param {RaybundleApp} app
 */
export function addEffects(app) {
    const button = byId('measure-effects', HTMLButtonElement);
    const state = byId('effects-state', HTMLElement);
    app.on('welcome', (welcome) => {
        showEffects(welcome.scene.effects ?? []);
        button.hidden = !app.mayEdit;
        button.disabled = false;
        state.textContent = '';
    });
    button.addEventListener('click', async () => {
        button.disabled = true;
        state.textContent = 'Being measured, for some seconds; pictures come more slowly meanwhile.';
        const effects = (await app.ask({measureEffects: {}}))?.effectCosts?.effects;
        button.disabled = false;
        state.textContent = effects
            ? 'Measured beside all that the server does for everybody, so that a quiet one is faster.'
            : 'The costs could not be measured.';
        if (effects) {
            showEffects(effects);
        }
    });
}
