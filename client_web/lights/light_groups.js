// SPDX-License-Identifier: Apache-2.0
// Groups of lights that are dimmed as one, and lighting scenes: how all lights are set, under a name.

import {LiveField, byId, field, input, listRow, replaceRows, smallButton} from '../ui/elements.js';
import {ServerError} from '../net/protocol.js';
import {sentence} from '../ui/status.js';
import {LampsChange} from './lamps_change.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('../net/scene_types.js').Light} Light
 * @typedef {import('../scene/history.js').History} History
 * @typedef {{name: string, lights: Light[]}} Group
 */

/**
 * Lights by their groups, in the order of names.
 *
 * @param {Light[]} lights
 * @returns {Group[]}
 */
export function groupsOf(lights) {
    /** @type {Map<string, Light[]>} */
    const groups = new Map();
    for (const light of lights) {
        if (light.group) {
            groups.set(light.group, [...(groups.get(light.group) ?? []), light]);
        }
    }
    return [...groups].sort(([a], [b]) => a.localeCompare(b)).map(([name, members]) => ({name, lights: members}));
}

/**
 * What a group is set to.
 *
 * @param {Group} group
 * @returns {{on: boolean, mixed: boolean, dim: number | null}} dim: null where its lights differ
 */
export function groupState({lights}) {
    const on = lights.filter((light) => light.on).length;
    const dims = new Set(lights.map(({dim}) => dim ?? 1));
    return {on: on > 0, mixed: on > 0 && on < lights.length, dim: dims.size === 1 ? [...dims][0] : null};
}

export class LightGroups {
    /** @type {(() => void)[]} */
    #refresh = [];
    #names = '';

    /**
     * @param {RaybundleApp} app
     * @param {History} history
     * @param {import('./fade.js').Fade} fade
     */
    constructor(app, history, fade) {
        this.app = app;
        this.history = history;
        this.fade = fade;
        app.on('welcome', () => this.#showAll());
        app.on('sceneChanged', () => this.#show());
        app.on('message', ({lightingSceneChanged}) => lightingSceneChanged && this.#sceneSaved(lightingSceneChanged));
        const form = byId('save-lighting', HTMLFormElement);
        form.addEventListener('submit', (event) => {
            event.preventDefault();
            this.#save(byId('lighting-name', HTMLInputElement));
        });
    }

    /** @param {string} label  for people */
    #change(label) {
        return new LampsChange(
            {client: this.app.client, history: this.history, ask: (body) => this.#ask(body)}, label);
    }

    /** @param {HTMLInputElement} text */
    async #save(text) {
        const name = text.value.trim();
        if (name && (await this.#ask({saveLightingScene: {name}}))) {
            text.value = '';
        }
    }

    /** @param {{name: string, byName?: string, removed?: boolean}} change */
    #sceneSaved({name, byName, removed}) {
        const {scene} = this.app;
        if (scene) {
            const others = scene.lightingScenes.filter((one) => one.name !== name);
            scene.lightingScenes = removed ? others : [...others, {name, byName: byName ?? ''}];
            this.#showScenes();
        }
    }

    /**
     * @param {object} body
     * @returns {Promise<boolean>} whether it has been done
     */
    async #ask(body) {
        try {
            await this.app.client.request(body).answer;
            return true;
        } catch (error) {
            if (error instanceof ServerError) {
                this.app.status.notify(sentence(error.message), 'problem');
            }
            return false;
        }
    }

    #showAll() {
        this.#names = '';
        this.#show();
        this.#showScenes();
    }

    #show() {
        const groups = groupsOf(this.app.scene?.lights ?? []);
        const names = JSON.stringify([this.app.scene?.lights.length, groups.map(({name, lights}) => [name, lights.map(({id}) => id)])]);
        if (names !== this.#names) {
            this.#names = names;
            this.#refresh = [];
            byId('light-groups', HTMLElement).replaceChildren(...groups.map((group) => this.#card(group)));
            byId('light-groups-none', HTMLElement).hidden = groups.length > 0;
            // The sky and its suns have none.
            byId('light-groups-part', HTMLElement).hidden = !(this.app.scene?.lights ?? []).some(({group}) => group !== undefined);
            const options = groups.map(({name}) => {
                const option = document.createElement('option');
                option.value = name;
                return option;
            });
            byId('light-group-names', HTMLElement).replaceChildren(...options);
        }
        this.#refresh.forEach((show) => show());
    }

    /** @param {Group} group */
    #card(group) {
        const {name} = group;
        const change = this.#change(`set group ${name}`);
        const on = input('checkbox', {role: 'switch', 'aria-label': `Group ${name} on`});
        const dim = input('range', {min: '0', max: '1', step: '0.01', 'aria-label': `Group ${name}, dimmer`});
        const text = document.createElement('output');
        const live = new LiveField(dim);
        const set = (/** @type {{on?: boolean, dim?: number}} */ values) =>
            change.done({setGroup: {group: name, ...values, ...this.fade.slowly}});
        on.addEventListener('change', () => set({on: on.checked}));
        dim.addEventListener('input', () => {
            if (!this.fade.slowly.fadeSeconds) {  // else it would begin anew at every step
                change.going({setGroup: {group: name, dim: Number(dim.value)}});
            }
        });
        dim.addEventListener('change', () => set({dim: Number(dim.value)}));
        const title = document.createElement('b');
        title.textContent = `${name} (${group.lights.length})`;
        const lit = document.createElement('label');
        lit.className = 'switch';
        lit.append(on);
        const head = document.createElement('div');
        head.className = 'card-head';
        head.append(title, lit);
        const card = document.createElement('li');
        card.append(head, field('Dimmer', dim, text));
        this.#refresh.push(() => {
            const state = groupState(group);
            for (const control of [on, dim]) {
                control.disabled = !this.app.mayEdit;
            }
            on.checked = state.on;
            on.indeterminate = state.mixed;
            live.show(String(state.dim ?? Math.max(...group.lights.map((light) => light.dim ?? 1))));
            text.textContent = state.dim === null ? 'mixed' : `${Math.round(100 * state.dim)} %`;
        });
        return card;
    }

    /** @param {string} name  of a lighting scene */
    #apply(name) {
        return this.#change(`set lighting scene ${name}`).done({applyLightingScene: {name, ...this.fade.slowly}});
    }

    #showScenes() {
        const may = this.app.mayEdit;
        const scenes = [...(this.app.scene?.lightingScenes ?? [])].sort((a, b) => a.name.localeCompare(b.name));
        byId('save-lighting', HTMLFormElement).hidden = !may;
        byId('lighting-part', HTMLElement).hidden = !may && scenes.length === 0;
        const rows = scenes.map(({name, byName}) => {
            const row = listRow(name, () => may && this.#apply(name), byName);
            if (may) {
                const remove = smallButton('×', `Remove lighting scene ${name}`, () =>
                    this.#ask({removeLightingScene: {name}}),
                );
                row.append(remove);
            }
            return row;
        });
        replaceRows(byId('lighting-scenes', HTMLElement), rows);
    }
}
