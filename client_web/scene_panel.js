// SPDX-License-Identifier: Apache-2.0
// The lists of cameras and objects, the selected object, and what the scene has to say.

import {byId, returnFocus, showValue} from './elements.js';
import {metres} from './format.js';
import {centre} from './vector.js';

/**
 * @typedef {import('./scene_model.js').SceneModel} SceneModel
 * @typedef {import('./scene_model.js').PlacedObject} PlacedObject
 */

/**
 * What the effects plan says of effects that are on, for people.
 *
 * @param {{name: string, active: boolean, reason: string}[]} effects
 * @returns {string[]}
 */
export function notesOf(effects) {
    return effects
        .filter(({active, reason}) => active && reason)
        .map(({name, reason}) => `${name}: ${reason}`);
}

/**
 * Events: `camera` (detail index), `select` (detail object id or null), `nudge` (detail {right,
 * forwards}, steps).
 */
export class ScenePanel extends EventTarget {
    #cameras = byId('cameras', HTMLUListElement);
    #objects = byId('objects', HTMLUListElement);
    #selection = byId('selection', HTMLElement);
    #nudge = byId('nudge', HTMLElement);

    constructor() {
        super();
        for (const button of this.#nudge.querySelectorAll('button')) {
            const steps = button.dataset.nudge?.split(',').map(Number);
            button.addEventListener('click', () => {
                if (steps) {
                    this.#emit('nudge', {right: steps[0], forwards: steps[1]});
                } else {
                    this.#emit('select', null);
                }
            });
        }
    }

    /** @param {SceneModel} scene */
    showScene(scene) {
        const cameras = scene.cameras.map(({name}, index) =>
            this.#row(name || `Camera ${index + 1}`, '', () => this.#emit('camera', index)),
        );
        this.#cameras.replaceChildren(...orEmpty(cameras, 'The scene names no camera.'));
        const objects = scene.objects.map((object) => {
            const select = () => this.#emit('select', object.id);
            const row = this.#row(object.name, object.movable ? '' : 'fixed', select);
            row.dataset.object = String(object.id);
            return row;
        });
        this.#objects.replaceChildren(...orEmpty(objects, 'The scene has no objects.'));
        const notes = notesOf(scene.effects).map((text) => {
            const item = document.createElement('li');
            item.textContent = text;
            return item;
        });
        byId('notes', HTMLElement).replaceChildren(...notes);
        byId('notes-section', HTMLElement).hidden = notes.length === 0;
    }

    /**
     * @param {PlacedObject | null} object
     * @param {boolean} mayMove  whether this viewer may change the scene
     */
    showSelection(object, mayMove) {
        for (const row of this.#objects.querySelectorAll('li')) {
            const selected = row.dataset.object === String(object?.id);
            row.querySelector('button')?.setAttribute('aria-pressed', String(selected));
        }
        this.#selection.hidden = object === null;
        byId('selection-none', HTMLElement).hidden = object !== null;
        if (!object) {
            return;
        }
        const canMove = object.movable && mayMove;
        for (const button of this.#nudge.querySelectorAll('button')) {
            button.disabled = button.dataset.nudge !== undefined && !canMove;
        }
        const fixed = object.movable
            ? 'You may look, not move.'
            : 'Part of the building: it stays.';
        showValue('selectionName', object.name);
        showValue('selectionHint', canMove ? 'Drag it in the picture to move it.' : fixed);
        this.showPlace(object);
    }

    /** @param {PlacedObject} object */
    showPlace(object) {
        const middle = centre(object.bounds);
        const {shift} = object;
        showValue('selectionPlace', `${metres(middle.x)}, ${metres(middle.z)}`);
        showValue('selectionShift', `${metres(shift.x)}, ${metres(shift.z)}`);
    }

    /**
     * @param {string} text
     * @param {string} tag
     * @param {() => void} action
     */
    #row(text, tag, action) {
        const item = document.createElement('li');
        const button = document.createElement('button');
        button.type = 'button';
        for (const part of [text, tag]) {
            const span = document.createElement('span');
            span.textContent = part;
            button.append(span);
        }
        button.lastElementChild?.classList.add('tag');
        button.title = text;
        button.addEventListener('click', (event) => {
            action();
            returnFocus(event);
        });
        item.append(button);
        return item;
    }

    /**
     * @param {string} type
     * @param {unknown} detail
     */
    #emit(type, detail) {
        this.dispatchEvent(new CustomEvent(type, {detail}));
    }
}

/**
 * @param {HTMLElement[]} rows
 * @param {string} text  shown instead of none
 * @returns {HTMLElement[]}
 */
function orEmpty(rows, text) {
    if (rows.length > 0) {
        return rows;
    }
    const item = document.createElement('li');
    item.className = 'empty';
    item.textContent = text;
    return [item];
}
