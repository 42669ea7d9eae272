// SPDX-License-Identifier: Apache-2.0
// Lights and materials: what each is set to, and how to set it. While a slider moves, one change at a
// time is on its way, and the newest follows it.

import {blackBody, fromHex, temperatureOf, toHex} from './colour.js';
import {LiveField, byId, fieldNote} from './elements.js';
import {subjectOf} from './history.js';
import {ServerError} from './protocol.js';
import {sentence} from './status.js';
import {threeDigits} from './units.js';

/**
 * @typedef {import('./app.js').RaybundleApp} RaybundleApp
 * @typedef {import('./history.js').History} History
 * @typedef {import('./protocol.js').Light} Light
 * @typedef {import('./protocol.js').Material} Material
 */

const UNITS = {CD_PER_M2: 'cd/m²', CD: 'cd', LX: 'lx', LM: 'lm'};
/** A dimmer's lowest step, as a share of the light as loaded; below it, it is off. */
const DIMMEST = 0.01;
/** A dimmer's highest step. */
const BRIGHTEST = 4;
const WARMEST_K = 1800;
const COLDEST_K = 10000;

/**
 * Position of a logarithmic dimmer.
 *
 * @param {number} share  of the light as loaded
 * @returns {number} 0..1
 */
export function dimmerPosition(share) {
    const position = Math.log(Math.max(share, DIMMEST) / DIMMEST) / Math.log(BRIGHTEST / DIMMEST);
    return Math.min(Math.max(position, 0), 1);
}

/**
 * What people know a light by, beside the intensity that can be set.
 *
 * @param {Light} light
 * @returns {string} empty where nothing is known
 */
export function lightFigures(light) {
    const share = light.loadedIntensity ? light.intensity / light.loadedIntensity : 1;
    const parts = [];
    if (light.flux && light.unit !== 'LM') {
        parts.push(`${threeDigits(share * light.flux)} lm`);
    }
    if (light.peak && light.unit !== 'CD') {
        parts.push(`at most ${threeDigits(share * light.peak)} cd`);
    }
    if (light.watts) {
        parts.push(`${Number(light.watts.toPrecision(3))} W`);
    }
    return parts.join(' · ');
}

/** @type {(position: number) => number} */
export const dimmerShare = (position) => DIMMEST * (BRIGHTEST / DIMMEST) ** position;

/**
 * What is wrong with an intensity that somebody has typed.
 *
 * @param {number} value  not a number: nothing, or no number
 * @returns {string} empty: nothing
 */
export function intensityProblem(value) {
    if (!Number.isFinite(value)) {
        return 'That is no number.';
    }
    return value < 0 ? 'A light cannot have less than 0.' : '';
}

/** @typedef {{intensity: number, colour: import('./protocol.js').Vec3}} LoadedLight */

/**
 * What the scene file gives a light; of servers that do not tell, what it has now.
 *
 * @param {Light} light
 * @returns {LoadedLight}
 */
export const loadedLight = ({intensity, colour, loadedIntensity, loadedColour}) => ({
    intensity: loadedIntensity ?? intensity,
    colour: loadedColour ?? colour,
});

/** Relative difference that numbers may have that went through texts. */
const SAME = 1e-3;

/**
 * Whether a light is on, and as the file has it.
 *
 * @param {Light} light
 * @param {LoadedLight} loaded
 */
export function sameLight(light, loaded) {
    const near = (/** @type {number} */ a, /** @type {number} */ b) => Math.abs(a - b) <= SAME * Math.max(a, b);
    const {colour} = light;
    return (
        light.on &&
        near(light.intensity, loaded.intensity) &&
        near(colour.x, loaded.colour.x) &&
        near(colour.y, loaded.colour.y) &&
        near(colour.z, loaded.colour.z)
    );
}

/** Sends the newest of many changes, one at a time. */
export class NewestOnly {
    /** @type {object | null} */
    #next = null;
    #busy = false;

    /** @param {(body: object) => Promise<unknown>} send */
    constructor(send) {
        this.send = send;
    }

    /** @param {object} body  replaces one that still waits */
    async push(body) {
        this.#next = body;
        if (this.#busy) {
            return;
        }
        this.#busy = true;
        while (this.#next) {
            const now = this.#next;
            this.#next = null;
            await this.send(now);
        }
        this.#busy = false;
    }
}

/**
 * @param {string} kind  of the element
 * @param {Record<string, string>} attributes
 * @returns {HTMLInputElement}
 */
function input(kind, attributes) {
    const element = document.createElement('input');
    element.type = kind;
    for (const [name, value] of Object.entries(attributes)) {
        element.setAttribute(name, value);
    }
    return element;
}

/**
 * @param {string} text
 * @param {...HTMLElement} parts
 */
function field(text, ...parts) {
    const label = document.createElement('label');
    label.className = 'field';
    const name = document.createElement('span');
    name.textContent = text;
    label.append(name, ...parts);
    return label;
}

export class LightPanel {
    /** Lights as the file has them, or as this page was told first, by id. @type {Map<number, LoadedLight>} */
    #loaded = new Map();
    /** Refreshes the controls of a light or material. @type {(() => void)[]} */
    #refresh = [];
    #scene = '';

    /**
     * @param {RaybundleApp} app
     * @param {History} history
     */
    constructor(app, history) {
        this.app = app;
        this.history = history;
        app.on('anew', () => {
            this.#scene = '';
        });
        app.on('welcome', () => this.#showScene());
        app.on('sceneChanged', () => this.#refresh.forEach((show) => show()));
    }

    #showScene() {
        const {scene} = this.app;
        if (!scene) {
            return;
        }
        if (scene.name !== this.#scene) {
            this.#scene = scene.name;
            this.#loaded = new Map();
        }
        for (const light of scene.lights) {
            // A server that tells knows best: the file may be another one.
            if (light.loadedIntensity !== undefined || !this.#loaded.has(light.id)) {
                this.#loaded.set(light.id, loadedLight(light));
            }
        }
        this.#refresh = [];
        byId('lights-note', HTMLElement).hidden = true;
        byId('materials-note', HTMLElement).hidden = true;
        const lights = scene.lights.map((light) => this.#lightCard(light));
        byId('lights', HTMLElement).replaceChildren(...lights);
        const materials = scene.materials.map((material) => this.#materialCard(material));
        byId('materials', HTMLElement).replaceChildren(...materials);
        this.#allow(document.body, this.app.mayEdit);
        this.#refresh.forEach((show) => show());
    }

    /**
     * @param {HTMLElement} within
     * @param {boolean} allowed
     */
    #allow(within, allowed) {
        for (const control of within.querySelectorAll('.cards input')) {
            /** @type {HTMLInputElement} */ (control).disabled = !allowed;
        }
    }

    /** @param {Light} light */
    #lightCard(light) {
        const unit = UNITS[/** @type {keyof typeof UNITS} */ (light.unit)] ?? light.unit;
        const name = light.name || `Light ${light.id}`;
        const on = input('checkbox', {role: 'switch', 'aria-label': `${name} on`});
        const attributes = {min: '0', max: '1', step: '0.01', 'aria-label': `${name}, dimmer`};
        const dimmer = input('range', attributes);
        const value = input('number', {min: '0', step: 'any', 'aria-label': `${name}, ${unit}`});
        const kelvin = input('range', {
            min: String(WARMEST_K),
            max: String(COLDEST_K),
            step: '50',
            'aria-label': `${name}, colour temperature`,
        });
        const kelvinText = document.createElement('output');
        const unitText = document.createElement('span');
        unitText.className = 'unit';
        unitText.textContent = unit;
        const fields = {dimmer: new LiveField(dimmer), value: new LiveField(value), kelvin: new LiveField(kelvin)};
        const shown = () => String(Number(light.intensity.toPrecision(4)));
        const asLoaded = this.#loaded.get(light.id) ?? loadedLight(light);
        const loaded = () => asLoaded.intensity || 1;
        const change = this.#changes('setLight', {light: light.id}, name, () => {
            const {intensity, on: lit, colour} = light;
            return {intensity, on: lit, colour};
        });
        on.addEventListener('change', () => change.done({on: on.checked}));
        const dimmed = () => ({intensity: loaded() * dimmerShare(Number(dimmer.value))});
        dimmer.addEventListener('input', () => change.going(dimmed()));
        dimmer.addEventListener('change', () => change.done(dimmed()));
        const note = document.createElement('p');
        note.className = 'field-note';
        note.setAttribute('role', 'status');
        note.hidden = true;
        value.addEventListener('change', () => {
            const wrong = intensityProblem(value.valueAsNumber);
            fieldNote(note, wrong && `${wrong} It stays at ${shown()} ${unit}.`, value);
            if (wrong) {
                fields.value.reset();
            } else {
                change.done({intensity: value.valueAsNumber}, (why) => {
                    fieldNote(note, `${why} It stays at ${shown()} ${unit}.`, value);
                });
            }
        });
        const figures = document.createElement('p');
        figures.className = 'figures';
        const tinted = () => ({colour: blackBody(Number(kelvin.value))});
        kelvin.addEventListener('input', () => change.going(tinted()));
        kelvin.addEventListener('change', () => change.done(tinted()));
        const reset = document.createElement('button');
        reset.type = 'button';
        reset.textContent = 'As in the file';
        reset.addEventListener('click', () => change.done({...asLoaded, on: true}));
        this.#refresh.push(() => {
            reset.hidden = !this.app.mayEdit || sameLight(light, asLoaded);
            on.checked = light.on;
            fields.dimmer.show(String(dimmerPosition(light.intensity / loaded())));
            dimmer.setAttribute('aria-valuetext', `${threeDigits(light.intensity)} ${unit}`);
            fields.value.show(shown());
            figures.textContent = lightFigures(light);
            figures.hidden = figures.textContent === '';
            const temperature = temperatureOf(light.colour);
            fields.kelvin.show(String(temperature));
            kelvinText.textContent = `${temperature} K`;
            kelvin.setAttribute('aria-valuetext', `${temperature} kelvin`);
        });
        const head = document.createElement('div');
        head.className = 'card-head';
        const title = document.createElement('b');
        title.textContent = name;
        const lit = document.createElement('label');
        lit.className = 'switch';
        lit.append(on);
        head.append(title, lit);
        const card = document.createElement('li');
        const dimming = field('Dimmer', dimmer, value, unitText);
        card.append(head, dimming, figures, note, field('Colour', kelvin, kelvinText), reset);
        return card;
    }

    /** @param {Material} material */
    #materialCard(material) {
        const name = material.name || `Material ${material.id}`;
        const colour = input('color', {'aria-label': `${name}, colour`});
        const attributes = {min: '0', max: '1', step: '0.01', 'aria-label': `${name}, roughness`};
        const roughness = input('range', attributes);
        const roughnessField = new LiveField(roughness);
        const known = document.createElement('output');
        const metallic = input('range', {...attributes, 'aria-label': `${name}, metallic`});
        const metallicField = new LiveField(metallic);
        const metallicKnown = document.createElement('output');
        const change = this.#changes('setMaterial', {material: material.id}, name, () => {
            const {baseColour, roughness: rough, metallic: metal} = material;
            return {baseColour, roughness: rough, metallic: metal};
        });
        const metal = () => ({metallic: Number(metallic.value)});
        metallic.addEventListener('input', () => change.going(metal()));
        metallic.addEventListener('change', () => change.done(metal()));
        const painted = () => ({baseColour: fromHex(colour.value)});
        colour.addEventListener('input', () => change.going(painted()));
        colour.addEventListener('change', () => change.done(painted()));
        const rough = () => ({roughness: Number(roughness.value)});
        roughness.addEventListener('input', () => change.going(rough()));
        roughness.addEventListener('change', () => change.done(rough()));
        this.#refresh.push(() => {
            colour.value = toHex(material.baseColour ?? {x: 0.5, y: 0.5, z: 0.5});
            roughnessField.show(String(material.roughness ?? 1));
            known.textContent = material.roughness?.toFixed(2) ?? '–';
            // What is not told cannot be changed with sense.
            colour.hidden = material.baseColour === undefined;
            // Nor can what has no effect.
            const matt = material.matt === true && !((material.metallic ?? 0) > 0);
            roughness.disabled = !this.app.mayEdit || material.roughness === undefined || matt;
            roughness.title = matt ? 'The file makes this material matt: without metallic it has no gloss' : '';
            metallicField.show(String(material.metallic ?? 0));
            metallicKnown.textContent = material.metallic?.toFixed(2) ?? '–';
            metallic.disabled = !this.app.mayEdit || material.metallic === undefined;
        });
        const title = document.createElement('b');
        title.textContent = name;
        const head = document.createElement('div');
        head.className = 'card-head';
        head.append(title, colour);
        const card = document.createElement('li');
        card.append(head, field('Roughness', roughness, known), field('Metallic', metallic, metallicKnown));
        return card;
    }

    /**
     * Changes to one light or material.
     *
     * @param {'setLight' | 'setMaterial'} kind
     * @param {object} subject
     * @param {string} name
     * @param {() => Record<string, unknown>} state  what it is set to now
     */
    #changes(kind, subject, name, state) {
        /** What it was when the user took hold of it. @type {Record<string, unknown> | null} */
        let before = null;
        /**
         * @param {object} values
         * @param {(why: string) => void} [refused]
         */
        const send = async (values, refused) => {
            try {
                await this.app.client.request({[kind]: {...subject, ...values}}).answer;
                return true;
            } catch (error) {
                this.#refused(kind, error, refused);
                return false;
            }
        };
        const newest = new NewestOnly((values) => send(values));
        return {
            /** @param {object} values  while a slider moves */
            going: (values) => {
                before ??= state();
                newest.push(values);
            },
            /**
             * When it is let go.
             *
             * @param {object} values
             * @param {(why: string) => void} [refused]  says so, instead of a notice
             */
            done: async (values, refused) => {
                const from = before ?? state();
                before = null;
                if (await send(values, refused)) {
                    // Of the rest the server may refuse what it has.
                    const touched = Object.keys(values).map((key) => [key, from[key]]);
                    this.history.add({
                        label: `set ${name}`,
                        subject: subjectOf({[kind]: subject}),
                        undo: () => send(Object.fromEntries(touched)),
                        redo: () => send(values),
                    });
                }
            },
        };
    }

    /**
     * @param {'setLight' | 'setMaterial'} kind
     * @param {unknown} error
     * @param {(why: string) => void} say
     */
    #refused(kind, error, say = (why) => this.app.status.notify(why, 'problem')) {
        this.#refresh.forEach((show) => show());
        if (!(error instanceof ServerError)) {
            return;
        }
        const what = kind === 'setLight' ? 'lights' : 'materials';
        if (error.code === 'UNIMPLEMENTED') {
            const note = byId(`${what}-note`, HTMLElement);
            note.textContent = `This server shows its ${what} but cannot change them.`;
            note.hidden = false;
            for (const control of byId(what, HTMLElement).querySelectorAll('input')) {
                control.disabled = true;
            }
        } else {
            say(sentence(error.message));
        }
    }
}
