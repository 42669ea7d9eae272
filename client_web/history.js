// SPDX-License-Identifier: Apache-2.0
// Undo and redo of this viewer's own changes, and the log of everybody's.

import {byId, showValue} from './elements.js';

/**
 * @typedef {import('./app.js').RaybundleApp} RaybundleApp
 * @typedef {object} Step
 * @property {string} label  what was done, e.g. "move short box"
 * @property {() => Promise<unknown>} undo
 * @property {() => Promise<unknown>} redo
 */

const MAX_STEPS = 200;

/** Two stacks. Event: `change`. */
export class History extends EventTarget {
    /** @type {Step[]} */
    #done = [];
    /** @type {Step[]} */
    #undone = [];
    /** What is under way; steps follow one another. @type {Promise<void>} */
    #under = Promise.resolve();

    /** The step that undo() takes back. */
    get last() {
        return this.#done.at(-1) ?? null;
    }

    /** The step that redo() does again. */
    get next() {
        return this.#undone.at(-1) ?? null;
    }

    /** @param {Step} step  that has been done */
    add(step) {
        this.#done.push(step);
        this.#done.splice(0, this.#done.length - MAX_STEPS);
        this.#undone.length = 0;
        this.dispatchEvent(new Event('change'));
    }

    /** Takes the last step back. */
    undo() {
        return this.#shift(this.#done, this.#undone, 'undo');
    }

    /** Does the step again that was taken back last. */
    redo() {
        return this.#shift(this.#undone, this.#done, 'redo');
    }

    /** Forgets everything, as for another scene. */
    clear() {
        this.#done.length = 0;
        this.#undone.length = 0;
        this.dispatchEvent(new Event('change'));
    }

    /**
     * @param {Step[]} from
     * @param {Step[]} to
     * @param {'undo' | 'redo'} way
     */
    #shift(from, to, way) {
        this.#under = this.#under.then(async () => {
            const step = from.pop();
            if (step) {
                to.push(step);
                this.dispatchEvent(new Event('change'));
                // What is refused has been told to the user by whoever was asked.
                await step[way]().catch(() => {});
            }
        });
        return this.#under;
    }
}

/**
 * What has changed in the scene since this page came to it.
 *
 * @typedef {object} LogEntry
 * @property {Date} time
 * @property {number} epoch
 * @property {number} before  epoch of the scene before it, and before the steps of a drag
 * @property {string} by
 * @property {string} text
 */
const MAX_ENTRIES = 1000;

export class ChangeList {
    /** @type {LogEntry[]} */
    entries = [];
    /** Epochs before the drags that are under way, by object. @type {Map<number, number>} */
    #dragged = new Map();

    /**
     * @param {RaybundleApp} app
     * @param {(viewer: number) => string} nameOf
     */
    constructor(app, nameOf) {
        app.on('sceneChanged', (/** @type {import('./protocol.js').SceneChanged} */ change) => {
            const before = this.#before(change);
            if (before === null) {
                return;
            }
            const text = describeChange(app, change);
            const by = nameOf(change.by);
            this.entries.push({time: new Date(), epoch: change.epoch, before, by, text});
            this.entries.splice(0, this.entries.length - MAX_ENTRIES);
            showValue('lastChange', `${by}: ${text}`);
        });
    }

    /**
     * @param {import('./protocol.js').SceneChanged} change
     * @returns {number | null} epoch before it; null: a step of a drag that goes on
     */
    #before({epoch, moveObject}) {
        if (!moveObject) {
            return epoch - 1;
        }
        const before = this.#dragged.get(moveObject.object) ?? epoch - 1;
        if (moveObject.final === false) {
            this.#dragged.set(moveObject.object, before);
            return null;
        }
        this.#dragged.delete(moveObject.object);
        return before;
    }
}

/**
 * @param {RaybundleApp} app
 * @param {import('./protocol.js').SceneChanged} change
 * @returns {string} e.g. "moved short box"
 */
function describeChange({scene}, {moveObject, setLight, setMaterial}) {
    if (moveObject) {
        return `moved ${scene?.object(moveObject.object)?.name ?? 'an object'}`;
    }
    if (setLight) {
        const name = scene?.lights.find(({id}) => id === setLight.light)?.name ?? 'a light';
        const state = setLight.on === undefined ? 'set' : setLight.on ? 'switched on' : 'switched off';
        return `${state} ${name}`;
    }
    const id = setMaterial?.material;
    return `set ${scene?.materials.find((material) => material.id === id)?.name ?? 'a material'}`;
}

/**
 * Buttons and keys of a history, and the moves of objects in it.
 *
 * @param {RaybundleApp} app
 * @param {History} history
 */
export function addHistory(app, history) {
    const undo = byId('undo', HTMLButtonElement);
    const redo = byId('redo', HTMLButtonElement);
    history.addEventListener('change', () => {
        undo.disabled = history.last === null;
        redo.disabled = history.next === null;
        undo.title = history.last ? `Undo: ${history.last.label} (Ctrl+Z)` : 'Undo (Ctrl+Z)';
        redo.title = history.next ? `Redo: ${history.next.label} (Ctrl+Y)` : 'Redo (Ctrl+Y)';
    });
    undo.addEventListener('click', () => history.undo());
    redo.addEventListener('click', () => history.redo());
    app.mover.addEventListener('done', (event) => {
        const {object, from, to} = /** @type {CustomEvent} */ (event).detail;
        const move = (/** @type {import('./protocol.js').Transform} */ transform) => () => {
            const now = app.scene?.object(object.id);
            return now ? app.mover.move(now, transform, null) : Promise.resolve();
        };
        history.add({label: `move ${object.name}`, undo: move(from), redo: move(to)});
    });
    let scene = '';
    app.on('welcome', () => {
        byId('history', HTMLElement).hidden = !app.mayEdit;
        if (app.scene && app.scene.name !== scene) {
            scene = app.scene.name;
            history.clear();
        }
    });
}
