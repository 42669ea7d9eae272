// SPDX-License-Identifier: Apache-2.0
// The panel of lights and materials: a card for each.

import {ServerError} from '../net/protocol.js';
import {byId} from '../ui/elements.js';
import {sentence} from '../ui/status.js';
import {LightAiming} from './light_aiming.js';
import {LightCard, lightName} from './light_card.js';
import {isLamp, lampless, loadedLight} from './light_values.js';
import {byName, materialCard} from '../scene/material_card.js';
import {SurfaceChange} from '../scene/surface_change.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('../scene/history.js').History} History
 * @typedef {import('../net/scene_types.js').Light} Light
 * @typedef {import('../net/scene_types.js').Material} Material
 * @typedef {import('./light_values.js').LoadedLight} LoadedLight
 */

export class LightPanel {
    /** Lights as the file has them, or as this page was told first, by id. @type {Map<number, LoadedLight>} */
    #loaded = new Map();
    /** Refreshes the controls of a light or material. @type {(() => void)[]} */
    #refresh = [];
    #scene = '';

    /**
     * @param {RaybundleApp} app
     * @param {History} history
     * @param {{things: import('../scene/things.js').Things, luminaires: import('../scene/luminaires.js').Luminaires,
     *     fade: import('./fade.js').Fade}} presence
     * @param {() => void} open  shows this panel
     */
    constructor(app, history, presence, open) {
        this.app = app;
        this.history = history;
        this.presence = presence;
        presence.luminaires.addEventListener('files', () => this.#showScene());
        this.aiming = new LightAiming(app);
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
        app.on('sceneChanged', ({setDaylight, addObject, addLuminaire, removeLight}) => {
            if (setDaylight || addObject || addLuminaire || removeLight) {
                this.#showScene();  // with other lights
            } else {
                this.#refresh.forEach((show) => show());
            }
        });
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
        this.presence.fade.show(this.app.mayEdit && scene.lights.some(isLamp));
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
        for (const control of within.querySelectorAll('.cards input, .cards select, .light-details button')) {
            /** @type {HTMLInputElement | HTMLButtonElement | HTMLSelectElement} */ (control).disabled = !allowed;
        }
    }

    /** @param {Light} light */
    #lightCard(light) {
        const change = this.#change('setLight', [{light: light.id}], lightName(light), () => {
            return {...light, sameType: true};
        });
        const loaded = this.#loaded.get(light.id) ?? loadedLight(light);
        const {things, luminaires, fade} = this.presence;
        const details = {
            aim: () => this.aiming.begin(light, change),
            remove: () => things.removeLight(light),
            files: luminaires.files.filter(({flux}) => flux).map(({name}) => name),
        };
        const card = new LightCard(light, loaded, change, () => this.app.mayEdit, details, fade);
        this.#refresh.push(() => card.show());
        return card.element;
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
        const subjects = group.map(({id}) => ({material: id}));
        const change = this.#change('setMaterial', subjects, name, () => {
            const {baseColour, roughness, metallic} = material;
            return {baseColour, roughness, metallic};
        });
        const {card, show} = materialCard(group, name, change, () => this.app.mayEdit);
        this.#refresh.push(show);
        return card;
    }

    /**
     * @param {'setLight' | 'setMaterial'} kind
     * @param {object[]} subjects
     * @param {string} name
     * @param {() => Record<string, unknown>} state
     */
    #change(kind, subjects, name, state) {
        const page = {
            client: this.app.client,
            history: this.history,
            /** @type {(error: unknown, say?: (why: string) => void) => void} */
            refused: (error, say) => this.#refused(kind, error, say),
        };
        return new SurfaceChange(page, kind, subjects, name, state);
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
