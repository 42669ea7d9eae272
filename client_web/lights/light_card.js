// SPDX-License-Identifier: Apache-2.0
// A card of a light: whether it is on, how bright it is, and its colour.

import {blackBody, temperatureOf} from '../measure/colour.js';
import {LiveField, field, fieldNote, input} from '../ui/elements.js';
import {threeDigits} from '../ui/units.js';
import {LightDetails, hasDetails} from './light_details.js';
import {dimmerPosition, dimmerShare, intensityProblem, isLamp, lightFigures, sameLight} from './light_values.js';

/**
 * @typedef {import('../net/scene_types.js').Light} Light
 * @typedef {import('./light_values.js').LoadedLight} LoadedLight
 * @typedef {import('../scene/surface_change.js').SurfaceChange} SurfaceChange
 */

const UNITS = {CD_PER_M2: 'cd/m²', CD: 'cd', LX: 'lx', LM: 'lm'};
const WARMEST_K = 1800;
const COLDEST_K = 10000;

/**
 * Name of a light for people.
 *
 * @param {Light} light
 */
export const lightName = (light) => light.name || `Light ${light.id}`;

/** @param {string} className */
function paragraph(className) {
    const element = document.createElement('p');
    element.className = className;
    return element;
}

/**
 * @param {string} name
 * @param {HTMLInputElement} on
 */
function cardHead(name, on) {
    const head = document.createElement('div');
    head.className = 'card-head';
    const title = document.createElement('b');
    title.textContent = name;
    const lit = document.createElement('label');
    lit.className = 'switch';
    lit.append(on);
    head.append(title, lit);
    return head;
}

/** A light's card. `show()` brings its controls up to date. */
export class LightCard {
    /**
     * @param {Light} light  changes as the server says
     * @param {LoadedLight} loaded
     * @param {SurfaceChange} change
     * @param {() => boolean} mayEdit
     * @param {import('./light_details.js').Deeds} deeds
     * @param {import('./fade.js').Fade} fade
     */
    constructor(light, loaded, change, mayEdit, deeds, fade) {
        this.light = light;
        this.loaded = loaded;
        this.change = change;
        this.mayEdit = mayEdit;
        this.fade = fade;
        this.unit = UNITS[/** @type {keyof typeof UNITS} */ (light.unit)] ?? light.unit;
        const name = lightName(light);
        this.on = input('checkbox', {role: 'switch', 'aria-label': `${name} on`});
        this.dimmer = input('range', {min: '0', max: '1', step: '0.01', 'aria-label': `${name}, dimmer`});
        this.value = input('number', {min: '0', step: 'any', 'aria-label': `${name}, ${this.unit}`});
        this.kelvin = input('range', {
            min: String(WARMEST_K),
            max: String(COLDEST_K),
            step: '50',
            'aria-label': `${name}, colour temperature`,
        });
        this.kelvinText = document.createElement('output');
        this.note = paragraph('field-note');
        this.note.setAttribute('role', 'status');
        this.note.hidden = true;
        this.figures = paragraph('figures');
        this.reset = document.createElement('button');
        this.reset.type = 'button';
        this.reset.textContent = 'Reset';
        const {dimmer, value, kelvin} = this;
        this.fields = {dimmer: new LiveField(dimmer), value: new LiveField(value), kelvin: new LiveField(kelvin)};
        this.details = hasDetails(light) ? new LightDetails(light, name, change, deeds) : null;
        this.#listen();
        this.element = this.#layOut(name);
    }

    /** @param {string} name */
    #layOut(name) {
        const unitText = document.createElement('span');
        unitText.className = 'unit';
        unitText.textContent = this.unit;
        const card = document.createElement('li');
        card.append(
            cardHead(name, this.on),
            field('Dimmer', this.dimmer, this.value, unitText),
            this.figures,
            this.note,
            field('Colour', this.kelvin, this.kelvinText),
            this.reset,
        );
        if (this.details) {
            card.append(this.details.element);
        }
        return card;
    }

    /** What it is reset to; its place and its group stay. */
    get #original() {
        return {...this.loaded, on: true, ...(this.light.dim === undefined ? {} : {dim: 1})};
    }

    /** Intensity as loaded; 1 of a light that was off. */
    get #full() {
        return this.loaded.intensity || 1;
    }

    /** Of daylight a server changes nothing slowly. @returns {{fadeSeconds?: number}} */
    get #slowly() {
        return isLamp(this.light) ? this.fade.slowly : {};
    }

    /** @param {object} values  while a slider moves; a fade would begin anew at every step */
    #going(values) {
        if (!this.#slowly.fadeSeconds) {
            this.change.going(values);
        }
    }

    /**
     * @param {object} values
     * @param {import('../scene/surface_change.js').Refused} [refused]
     */
    #done(values, refused) {
        this.change.done(values, refused, this.#slowly);
    }

    #listen() {
        const {on, dimmer, kelvin} = this;
        on.addEventListener('change', () => this.#done({on: on.checked}));
        const dimmed = () => ({intensity: this.#full * dimmerShare(Number(dimmer.value))});
        dimmer.addEventListener('input', () => this.#going(dimmed()));
        dimmer.addEventListener('change', () => this.#done(dimmed()));
        this.value.addEventListener('change', () => this.#typed());
        const tinted = () => ({colour: blackBody(Number(kelvin.value))});
        kelvin.addEventListener('input', () => this.#going(tinted()));
        kelvin.addEventListener('change', () => this.#done(tinted()));
        this.reset.addEventListener('click', () => this.#done(this.#original));
    }

    /** Somebody has typed an intensity. */
    #typed() {
        const {value, note} = this;
        const stays = () => `It stays at ${this.#shown()} ${this.unit}.`;
        const wrong = intensityProblem(value.valueAsNumber);
        fieldNote(note, wrong && `${wrong} ${stays()}`, value);
        if (wrong) {
            this.fields.value.reset();
        } else {
            this.#done({intensity: value.valueAsNumber}, (why) => fieldNote(note, `${why} ${stays()}`, value));
        }
    }

    #shown() {
        return String(Number(this.light.intensity.toPrecision(4)));
    }

    show() {
        const {light, fields} = this;
        this.reset.hidden = !this.mayEdit() || sameLight(light, this.loaded);
        this.on.checked = light.on;
        fields.dimmer.show(String(dimmerPosition(light.intensity / this.#full)));
        this.dimmer.setAttribute('aria-valuetext', `${threeDigits(light.intensity)} ${this.unit}`);
        fields.value.show(this.#shown());
        this.figures.textContent = lightFigures(light);
        this.figures.hidden = this.figures.textContent === '';
        this.details?.show();
        const temperature = temperatureOf(light.colour);
        fields.kelvin.show(String(temperature));
        this.kelvinText.textContent = `${temperature} K`;
        this.kelvin.setAttribute('aria-valuetext', `${temperature} kelvin`);
    }
}
