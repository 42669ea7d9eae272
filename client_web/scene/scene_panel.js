// SPDX-License-Identifier: Apache-2.0
// Cameras, objects, and the selected object with its place in numbers.

import {LiveField, announce, byId, fieldNote, listRow, showValue} from '../ui/elements.js';
import {ObjectList} from './object_list.js';
import {basePoint, limitedSize, resizedAbout, turnBetween, turnedAbout} from './placement.js';
import {shifted} from './scene_model.js';
import {threeDigits} from '../ui/units.js';
import {centre, completeTransform, sub} from '../ui/vector.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('./scene_model.js').SceneModel} SceneModel
 * @typedef {import('./scene_model.js').PlacedObject} PlacedObject
 * @typedef {import('./history.js').History} History
 * @typedef {import('../net/scene_types.js').Bounds} Bounds
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
        return turnedAbout(object.transform, object.pivot, angle, parent);
    }
    if (name === 'size') {
        const factor = limitedSize(value / before.size);
        return resizedAbout(object.transform, pivot, factor, parent);
    }
    const wanted = {x: before.x, y: before.y, z: before.z, [name]: value};
    return shifted(object.transform, sub(wanted, pivot), parent);
}

/**
 * What is wrong with a number that somebody has typed.
 *
 * @param {string} name  of placeOf()
 * @param {number} value  not a number: nothing, or no number
 * @returns {string} empty: nothing
 */
export function placeProblem(name, value) {
    if (!Number.isFinite(value)) {
        return 'Enter a number. Nothing has been changed.';
    }
    return name === 'size' && value <= 0 ? 'A size is more than 0 %: nothing has been changed.' : '';
}

/**
 * Whether nothing of an object is in the scene any more.
 *
 * @param {Bounds} object
 * @param {Bounds} scene
 */
export function isOutside(object, scene) {
    return /** @type {const} */ (['x', 'y', 'z']).some(
        (axis) => object.min[axis] > scene.max[axis] || object.max[axis] < scene.min[axis],
    );
}

/** What is larger or higher than that is no building, metres; as the server's log has it. */
const LARGEST = {scene: 1000, height: 100};

/** Smaller units of `--unit`, metres, and how large a building is in its true one. */
const UNITS = /** @type {const} */ ([['ft', 0.3048], ['in', 0.0254], ['cm', 0.01], ['mm', 0.001]]);
const BUILDING = {least: 2, most: 100};

/**
 * Units in which a scene would be as large as a building.
 *
 * @param {number} size  metres, as it was read
 * @returns {string} as "--unit cm: 100 m, --unit mm: 10 m"
 */
function likelyUnits(size) {
    const fitting = UNITS.filter(([, metres]) => size * metres >= BUILDING.least && size * metres <= BUILDING.most);
    return (fitting.length ? fitting : UNITS.slice(-1))
        .map(([name, metres]) => `-\u2060-\u2060unit\u00a0${name}: ${threeDigits(size * metres)}\u00a0m`)
        .join(', ');
}

/**
 * What makes another unit likely.
 *
 * @param {Bounds} bounds  of a scene
 * @returns {string} empty: nothing
 */
export function sizeHint({min, max}) {
    const height = max.y - min.y;
    const size = Math.max(max.x - min.x, height, max.z - min.z);
    return size > LARGEST.scene || height > LARGEST.height
        ? `This scene is ${threeDigits(size)} m large and ${threeDigits(height)} m high. If it was drawn in another unit, whoever runs the server can say so (${likelyUnits(size)}).`
        : '';
}

export class ScenePanel {
    #cameras = byId('cameras', HTMLUListElement);
    #unlock = byId('unlock', HTMLButtonElement);
    #selection = byId('selection', HTMLElement);
    #placement = byId('placement', HTMLElement);
    #note = byId('place-note', HTMLElement);
    /** Object whose place the fields show. @type {number | null} */
    #shown = null;
    /** By name of placeOf(). @type {Map<string, LiveField>} */
    #fields = new Map();

    /**
     * @param {RaybundleApp} app
     * @param {import('./grabbing.js').Grabbing} grabbing
     * @param {History} history
     */
    constructor(app, grabbing, history) {
        this.app = app;
        this.objects = new ObjectList(app);
        this.history = history;
        this.#addButtons(grabbing);
        app.on('welcome', () => this.#showScene());
        app.on('selection', () => this.#showSelection());
        app.on('moved', () => this.#showPlace());
        app.on('history', () => this.#showPlace());
    }

    /** @param {import('./grabbing.js').Grabbing} grabbing */
    #addButtons(grabbing) {
        const {app} = this;
        for (const button of document.querySelectorAll('[data-nudge]')) {
            const {nudge} = /** @type {HTMLElement} */ (button).dataset;
            const [right, forwards] = (nudge ?? '0,0').split(',').map(Number);
            button.addEventListener('click', () => grabbing.nudge(right, forwards));
        }
        this.#unlock.addEventListener('click', () => {
            if (app.selected) {
                app.selected.unlocked = true;
                this.objects.refresh();
                this.#showSelection();
                app.drawOverlay();
            }
        });
        byId('deselect', HTMLElement).addEventListener('click', () => app.select(null));
        byId('put-back', HTMLElement).addEventListener('click', () => {
            if (app.selected) {
                app.mover.move(app.selected, app.selected.original);
            }
        });
        for (const input of this.#inputs()) {
            const name = input.dataset.place ?? '';
            const field = new LiveField(input);
            this.#fields.set(name, field);
            input.addEventListener('change', () => {
                const wrong = placeProblem(name, input.valueAsNumber);
                fieldNote(this.#note, wrong, input);
                if (wrong || !app.selected) {
                    field.reset();
                } else {
                    this.#place(app.selected, name, input);
                }
            });
        }
    }

    /**
     * Puts an object where a number says, and says what has become of that.
     *
     * @param {PlacedObject} object
     * @param {string} name  of placeOf()
     * @param {HTMLInputElement} input
     */
    async #place(object, name, input) {
        const before = this.history.last;
        const wanted = input.valueAsNumber;
        await this.app.mover.move(object, placedAt(object, name, wanted));
        this.#showPlace();
        const step = this.history.last;
        if (this.app.selected !== object || step === before) {
            return;  // refused, as a notice has told
        }
        const {scene} = this.app;
        const action = {
            label: 'Undo',
            run: () => {
                if (this.history.last === step) {
                    this.history.undo();
                }
            },
        };
        if (scene && isOutside(object.bounds, scene.bounds)) {
            fieldNote(this.#note, `${object.name} is outside the scene now.`, input, action);
        } else if (Math.abs(placeOf(object)[name] - wanted) > Math.max(0.01 * Math.abs(wanted), 0.01)) {
            const limit = name === 'size' ? 'A size changes by a factor of 20 at most at once.' : '';
            fieldNote(this.#note, limit, input);
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
        const hint = byId('size-hint', HTMLElement);
        hint.textContent = sizeHint(scene.bounds);
        hint.hidden = hint.textContent === '';
        const cameras = scene.cameras.map(({name}, index) =>
            listRow(name || `Camera ${index + 1}`, () => this.app.flyTo(index)),
        );
        this.#cameras.replaceChildren(...orEmpty(cameras, 'The scene names no camera.'));
    }

    #showSelection() {
        const object = this.app.selected;
        if (this.#shown !== object?.id) {
            this.#shown = object?.id ?? null;
            this.#fields.forEach((field) => field.reset());
            fieldNote(this.#note, '');
        }
        this.#selection.hidden = object === null;
        byId('selection-none', HTMLElement).hidden = object !== null;
        if (!object) {
            return;
        }
        const canMove = object.loose && this.app.mayEdit;
        const locked = object.movable && !object.loose && this.app.mayEdit;
        const why = object.loose ? 'Your role is to look, not to move.' : 'Part of the building: nobody moves it by accident.';
        this.#unlock.hidden = !locked;
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
            const field = this.#fields.get(name);
            if (this.app.mover.held === object.id) {
                field?.reset();  // what is in the hand shows where it is, whatever has been typed
            }
            field?.show(text);
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
