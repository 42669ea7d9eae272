// SPDX-License-Identifier: Apache-2.0
// Cameras, objects, and the selected object with its place in numbers.

import {announce, byId, listRow, showValue} from './elements.js';
import {basePoint, limitedSize, resizedAbout, turnBetween, turnedAbout} from './placement.js';
import {shifted} from './scene_model.js';
import {centre, completeTransform, sub} from './vector.js';

/**
 * @typedef {import('./app.js').RaybundleApp} RaybundleApp
 * @typedef {import('./scene_model.js').SceneModel} SceneModel
 * @typedef {import('./scene_model.js').PlacedObject} PlacedObject
 */

/** Share of the size as loaded. */
const sizeOf = (/** @type {PlacedObject} */ {transform, original}) =>
    transform.scale.x / completeTransform(original).scale.x;

/** Turn since loading, radians. */
const turnOf = (/** @type {PlacedObject} */ {transform, original}) =>
    turnBetween(completeTransform(original).rotation, transform.rotation);

/**
 * What the number fields say of an object: metres, degrees and per cent.
 *
 * @param {PlacedObject} object
 * @returns {Record<string, number>}
 */
export function placeOf(object) {
    const {x, z} = centre(object.bounds);
    return {
        x,
        y: object.bounds.min.y,
        z,
        turn: (turnOf(object) * 180) / Math.PI,
        size: 100 * sizeOf(object),
    };
}

/**
 * Transform of an object with one of its numbers changed.
 *
 * @param {PlacedObject} object
 * @param {string} name  of placeOf()
 * @param {number} value
 */
export function placedAt(object, name, value) {
    const parent = object.worldFromParent;
    const pivot = basePoint(object.bounds);
    const before = placeOf(object);
    if (name === 'turn') {
        const angle = ((value - before.turn) * Math.PI) / 180;
        return turnedAbout(object.transform, pivot, angle, parent);
    }
    if (name === 'size') {
        const factor = limitedSize(value / before.size);
        return resizedAbout(object.transform, pivot, factor, parent);
    }
    const wanted = {x: before.x, y: before.y, z: before.z, [name]: value};
    return shifted(object.transform, sub(wanted, pivot), parent);
}

export class ScenePanel {
    #cameras = byId('cameras', HTMLUListElement);
    #objects = byId('objects', HTMLUListElement);
    #fixed = byId('fixed-objects', HTMLUListElement);
    #selection = byId('selection', HTMLElement);
    #placement = byId('placement', HTMLElement);

    /**
     * @param {RaybundleApp} app
     * @param {import('./grabbing.js').Grabbing} grabbing
     */
    constructor(app, grabbing) {
        this.app = app;
        this.#addButtons(grabbing);
        app.on('welcome', () => this.#showScene());
        app.on('selection', () => this.#showSelection());
        app.on('moved', () => this.#showPlace());
    }

    /** @param {import('./grabbing.js').Grabbing} grabbing */
    #addButtons(grabbing) {
        const {app} = this;
        for (const button of document.querySelectorAll('[data-nudge]')) {
            const {nudge} = /** @type {HTMLElement} */ (button).dataset;
            const [right, forwards] = (nudge ?? '0,0').split(',').map(Number);
            button.addEventListener('click', () => grabbing.nudge(right, forwards));
        }
        byId('deselect', HTMLElement).addEventListener('click', () => app.select(null));
        byId('put-back', HTMLElement).addEventListener('click', () => {
            if (app.selected) {
                app.mover.move(app.selected, app.selected.original);
            }
        });
        for (const input of this.#inputs()) {
            input.addEventListener('change', () => {
                const value = input.valueAsNumber;
                if (app.selected && Number.isFinite(value)) {
                    const name = input.dataset.place ?? '';
                    app.mover.move(app.selected, placedAt(app.selected, name, value));
                } else {
                    this.#showPlace();
                }
            });
        }
    }

    /** @returns {HTMLInputElement[]} */
    #inputs() {
        return [...this.#placement.querySelectorAll('input[data-place]')].map(
            (input) => /** @type {HTMLInputElement} */ (input),
        );
    }

    #showScene() {
        const {scene} = this.app;
        if (!scene) {
            return;
        }
        const cameras = scene.cameras.map(({name}, index) =>
            listRow(name || `Camera ${index + 1}`, () => this.app.flyTo(index)),
        );
        this.#cameras.replaceChildren(...orEmpty(cameras, 'The scene names no camera.'));
        const rowOf = (/** @type {PlacedObject} */ object) => {
            const row = listRow(object.name, () => this.app.select(object.id));
            row.dataset.object = String(object.id);
            return row;
        };
        const movable = scene.objects.filter((object) => object.movable).map(rowOf);
        const fixed = scene.objects.filter((object) => !object.movable).map(rowOf);
        this.#objects.replaceChildren(...orEmpty(movable, 'Nothing here can be moved.'));
        this.#fixed.replaceChildren(...fixed);
        byId('fixed-details', HTMLElement).hidden = fixed.length === 0;
    }

    #showSelection() {
        const object = this.app.selected;
        for (const list of [this.#objects, this.#fixed]) {
            for (const row of list.querySelectorAll('li')) {
                const selected = row.dataset.object === String(object?.id);
                row.querySelector('button')?.setAttribute('aria-pressed', String(selected));
            }
        }
        this.#selection.hidden = object === null;
        byId('selection-none', HTMLElement).hidden = object !== null;
        if (!object) {
            return;
        }
        const canMove = object.movable && this.app.mayEdit;
        const why = object.movable ? 'Your role is to look, not to move.' : 'Part of the building.';
        showValue('selectionName', object.name);
        announce(`${object.name} is selected.`);
        showValue('selectionHint', canMove ? 'Drag it, or its handles, in the picture.' : why);
        this.#placement.hidden = !canMove;
        this.#showPlace();
    }

    #showPlace() {
        const object = this.app.selected;
        if (!object) {
            return;
        }
        const place = placeOf(object);
        for (const input of this.#inputs()) {
            const name = input.dataset.place ?? '';
            const digits = name === 'turn' || name === 'size' ? 0 : 2;
            const text = place[name].toFixed(digits).replace(/^-(0(\.0*)?)$/, '$1');
            if (document.activeElement !== input || this.app.mover.held !== null) {
                input.value = text;
            }
        }
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
