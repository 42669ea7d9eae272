// SPDX-License-Identifier: Apache-2.0
// Objects and lights that come and go: removed, duplicated, added from the server's folder; each with its way back.

import {byId} from '../ui/elements.js';
import {subjectOf} from './history.js';
import {withOwnChanges} from './own_changes.js';
import {shifted} from './scene_model.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('./history.js').History} History
 * @typedef {import('../net/scene_types.js').Light} Light
 */

/** Space between an object and its copy, metres. */
const GAP = 0.1;

export class Things {
    /**
     * @param {RaybundleApp} app
     * @param {History} history
     */
    constructor(app, history) {
        this.app = app;
        this.history = history;
        byId('remove-object', HTMLButtonElement).addEventListener('click', () => this.removeSelected());
        byId('duplicate-object', HTMLButtonElement).addEventListener('click', () => this.duplicateSelected());
        app.on('selection', () => {
            byId('object-presence', HTMLElement).hidden = !app.selected || !app.mayEdit;
            byId('remove-object', HTMLButtonElement).disabled = !app.selected?.loose;
        });
        app.on('sceneChanged', ({removeObject}) => {
            if (removeObject && app.selected?.id === removeObject.object) {
                app.select(null);
            }
        });
    }

    /** Takes the selected object away, if it may be moved. */
    async removeSelected() {
        const {selected} = this.app;
        const problem = this.#problem('remove');
        if (!selected || problem) {
            this.app.status.notify(problem);
            return;
        }
        const {id, name} = selected;
        if (await this.app.ask({removeObject: {object: id}})) {
            this.#note(`remove ${name}`, {removeObject: {object: id}}, {addObject: {object: id}});
        }
    }

    /** Puts a copy of the selected object beside it, and selects that. */
    async duplicateSelected() {
        const {app} = this;
        const {selected} = app;
        const problem = this.#problem('copy');
        if (!selected || problem) {
            app.status.notify(problem);
            return;
        }
        const {min, max} = selected.bounds;
        const aside = {x: max.x - min.x + GAP, y: 0, z: 0};
        const transform = shifted(selected.transform, aside, selected.worldFromParent);
        const answer = await app.ask({addObject: {copyOf: selected.id, transform}});
        const id = answer?.sceneChanged?.addObject?.object;
        if (id) {
            this.#note(`copy ${selected.name}`, {addObject: {object: id}}, {removeObject: {object: id}});
            app.select(id);
        }
    }

    /** @param {Light} light */
    async removeLight({id, name}) {
        if (await this.app.ask({removeLight: {light: id}})) {
            this.#note(`remove ${name}`, {removeLight: {light: id}}, {addLuminaire: {light: id}});
        }
    }

    /**
     * Adds luminaires: one, or a field of them.
     *
     * @param {Record<string, unknown>} addLuminaire
     * @param {string} name  for people
     * @returns {Promise<boolean>} whether they are there
     */
    async addLuminaires(addLuminaire, name) {
        // Others may add some meanwhile: only this viewer's own are taken back.
        const {result, changes} = await withOwnChanges(this.app.client, () => this.app.ask({addLuminaire}));
        if (!result) {
            return false;
        }
        const ids = changes.flatMap((change) => (change.addLuminaire ? [change.addLuminaire.light] : []));
        const each = (/** @type {(id: number) => object} */ body) => () =>
            Promise.all(ids.map((id) => this.app.ask(body(id))));
        this.history.add({
            label: `add ${name}`,
            subject: ids.flatMap((light) => [subjectOf({addLuminaire: {light}}), subjectOf({setLight: {light}})]),
            undo: each((light) => ({removeLight: {light}})),
            redo: each((light) => ({addLuminaire: {light}})),
        });
        return true;
    }

    /**
     * Why nothing can be done to what is selected; empty where it can.
     *
     * @param {'remove' | 'copy'} deed
     */
    #problem(deed) {
        const {selected} = this.app;
        if (!selected) {
            return 'Nothing is selected.';
        }
        if (!this.app.mayEdit) {
            return 'View only. Ask for editor access to change the scene.';
        }
        return deed === 'remove' && !selected.loose
            ? `${selected.name} stays: ${selected.movable ? 'unlock it first' : 'it is fixed'}.`
            : '';
    }

    /**
     * @param {string} label
     * @param {import('./history.js').Subject} redo
     * @param {object} undo
     */
    #note(label, redo, undo) {
        this.history.add({
            label,
            subject: redo.addObject ? [subjectOf(redo), subjectOf({moveObject: {object: redo.addObject.object ?? 0}})] : subjectOf(redo),
            undo: () => this.app.ask(undo),
            redo: () => this.app.ask(redo),
        });
    }
}
