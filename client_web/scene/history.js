// SPDX-License-Identifier: Apache-2.0
// Undo and redo of this viewer's own changes.

import {byId} from '../ui/elements.js';
import {deedOf} from './placement.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('../net/scene_types.js').Transform} Transform
 * @typedef {object} Step
 * @property {string} label  what was done, e.g. "move short box"
 * @property {string | string[]} [subject]  what it was done to, of subjectOf()
 * @property {string} [changedBy]  who has changed that since; empty: nobody else
 * @property {() => Promise<unknown>} undo
 * @property {() => Promise<unknown>} redo
 */

const MAX_STEPS = 200;
/** @typedef {{moveObject?: {object: number}, setLight?: {light: number}, setMaterial?: {material: number},
 *     setDaylight?: object, addObject?: {object?: number}, removeObject?: {object: number},
 *     addLuminaire?: {light?: number}, removeLight?: {light: number}}} Subject */

/**
 * What a change is of.
 *
 * @param {Subject} change
 * @returns {string} e.g. "object 2"
 */
export function subjectOf({moveObject, setLight, setMaterial, setDaylight, addObject, removeObject, addLuminaire, removeLight}) {
    if (setDaylight) {
        return 'daylight';
    }
    if (addObject || removeObject) {
        return `presence of object ${(addObject ?? removeObject)?.object}`;
    }
    if (addLuminaire || removeLight) {
        return `presence of light ${(addLuminaire ?? removeLight)?.light}`;
    }
    return moveObject
        ? `object ${moveObject.object}`
        : setLight
          ? `light ${setLight.light}`
          : `material ${setMaterial?.material}`;
}

/**
 * Two stacks. What others have changed since is not taken back unasked. Events: `change`; `hesitate`, whose
 * detail has the step and how to go on all the same.
 */
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

    /**
     * Somebody else has changed something.
     *
     * @param {string} subject  of subjectOf()
     * @param {string} by
     */
    noteOther(subject, by) {
        for (const step of [...this.#done, ...this.#undone]) {
            if ([step.subject].flat().includes(subject)) {
                step.changedBy = by;
            }
        }
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
            const step = from.at(-1);
            if (step?.changedBy) {
                const {changedBy} = step;
                const goOn = () => {
                    if (from.at(-1) !== step) {
                        return Promise.resolve();
                    }
                    step.changedBy = '';
                    return this.#shift(from, to, way);
                };
                this.dispatchEvent(new CustomEvent('hesitate', {detail: {step, way, by: changedBy, goOn}}));
            } else if (step) {
                from.pop();
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
    history.addEventListener('hesitate', (event) => {
        const {step, way, by, goOn} = /** @type {CustomEvent} */ (event).detail;
        const done = `${by} has changed that since you ${way === 'undo' ? 'did' : 'took back'} “${step.label}”.`;
        app.status.notify(done, 'notice', {label: way === 'undo' ? 'Undo both' : 'Redo all the same', run: goOn});
    });
    undo.addEventListener('click', () => history.undo());
    redo.addEventListener('click', () => history.redo());
    app.mover.addEventListener('done', (event) => {
        const {object, from, to} = /** @type {CustomEvent} */ (event).detail;
        const move = (/** @type {import('../net/scene_types.js').Transform} */ transform) => () => {
            const now = app.scene?.object(object.id);
            return now ? app.mover.move(now, transform, null) : Promise.resolve();
        };
        history.add({
            label: `${deedOf(from, to, object.original)} ${object.name}`,
            subject: subjectOf({moveObject: {object: object.id}}),
            undo: move(from),
            redo: move(to),
        });
    });
    app.on('anew', () => history.clear());
    app.on('welcome', () => {
        byId('history', HTMLElement).hidden = !app.mayEdit;
    });
}
