// SPDX-License-Identifier: Apache-2.0
// Lights and materials: what each is set to, and how to set it. While a slider moves, one change at a
// time is on its way, and the newest follows it.

import {blackBody, temperatureOf} from '../measure/colour.js';
import {LiveField, byId, field, fieldNote, input} from '../ui/elements.js';
import {subjectOf} from './history.js';
import {byName, materialCard} from './material_card.js';
import {ServerError} from '../net/protocol.js';
import {sentence} from '../ui/status.js';
import {threeDigits} from '../ui/units.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('./history.js').History} History
 * @typedef {import('../net/protocol.js').Light} Light
 * @typedef {import('../net/protocol.js').Material} Material
 */

const UNITS = {CD_PER_M2: 'cd/m²', CD: 'cd', LX: 'lx', LM: 'lm'};
/** A dimmer's lowest step, as a share of the light as loaded; below it, it is off. */
const DIMMEST = 0.01;
/** A dimmer's highest step. */
const BRIGHTEST = 4;
/** Kinds of lights that are no lamps: the sky and its suns. */
const OUTSIDE = ['SKY', 'ENVIRONMENT', 'DIRECTIONAL'];
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
        return 'Enter a number.';
    }
    return value < 0 ? 'Enter 0 or more.' : '';
}

/** @typedef {{intensity: number, colour: import('../net/protocol.js').Vec3}} LoadedLight */

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
 * What is to be known of a scene without a lamp of its own.
 *
 * @param {import('../net/protocol.js').Light[]} lights
 * @returns {string} empty: it has some
 */
export function lampless(lights) {
    if (lights.some(({kind}) => !OUTSIDE.includes(kind))) {
        return '';
    }
    return lights.length === 0
        ? 'Nothing in the file emits light, and there is no sky: all is dark.'
        : 'The file has no lamps: the scene has daylight alone. Where nothing else is said, the server adds a uniform sky.';
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
     * @param {() => void} open  shows this panel
     */
    constructor(app, history, open) {
        this.app = app;
        this.history = history;
        byId('picked-material', HTMLButtonElement).addEventListener('click', () => {
            open();
            this.#showPicked();
        });
        app.on('anew', () => {
            this.#scene = '';
            this.pick(null);
        });
        // Of what has been clicked; not of what is chosen from a list.
        app.on('selection', () => this.pick(null));
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
        const none = byId('lights-none', HTMLElement);
        none.textContent = lampless(scene.lights);
        none.hidden = none.textContent === '';
        byId('lights-note', HTMLElement).hidden = true;
        byId('materials-note', HTMLElement).hidden = true;
        const lights = scene.lights.map((light) => this.#lightCard(light));
        byId('lights', HTMLElement).replaceChildren(...lights);
        const materials = byName(scene.materials).map((group) => this.#addMaterial(group));
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
        reset.textContent = 'Reset';
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

    /**
     * Marks the card of a material, as that of what has been clicked.
     *
     * @param {number | null} id
     */
    pick(id) {
        const material = this.app.scene?.materials.find((one) => one.id === id);
        byId('picked', HTMLElement).hidden = !material;
        byId('picked-material', HTMLElement).textContent = material ? material.name || `Material ${material.id}` : '–';
        for (const card of byId('materials', HTMLElement).children) {
            const ids = (/** @type {HTMLElement} */ (card).dataset.materials ?? '').split(' ');
            card.classList.toggle('picked', material !== undefined && ids.includes(String(id)));
        }
        this.#showPicked();
    }

    #showPicked() {
        const card = document.querySelector('#materials .picked');
        if (card instanceof HTMLElement && card.checkVisibility()) {
            card.scrollIntoView({block: 'nearest'});
        }
    }

    /** @param {Material[]} group  of one name, of which all change together */
    #addMaterial(group) {
        const [material] = group;
        const name = material.name || `Material ${material.id}`;
        const change = this.#changes('setMaterial', group.map(({id}) => ({material: id})), name, () => {
            const {baseColour, roughness, metallic} = material;
            return {baseColour, roughness, metallic};
        });
        const {card, show} = materialCard(group, name, change, () => this.app.mayEdit);
        this.#refresh.push(show);
        return card;
    }

    /**
     * Changes to one light or material.
     *
     * @param {'setLight' | 'setMaterial'} kind
     * @param {object | object[]} subject  or several, which change together
     * @param {string} name
     * @param {() => Record<string, unknown>} state  what it is set to now
     */
    #changes(kind, subject, name, state) {
        const subjects = [subject].flat();
        /** What it was when the user took hold of it. @type {Record<string, unknown> | null} */
        let before = null;
        /**
         * @param {object} values
         * @param {(why: string) => void} [refused]
         */
        const send = async (values, refused) => {
            try {
                const {client} = this.app;
                await Promise.all(subjects.map((one) => client.request({[kind]: {...one, ...values}}).answer));
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
                        subject: subjectOf({[kind]: subjects[0]}),
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
