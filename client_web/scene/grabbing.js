// SPDX-License-Identifier: Apache-2.0
// Objects under the pointer: what it rests on, taking hold of what is selected, and carrying it.

import {intersectBounds} from '../ui/vector.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('../camera/pointer_control.js').Point} Point
 * @typedef {import('./scene_model.js').PlacedObject} PlacedObject
 */

/** A pointer that stands still so long marks what is under it, ms. */
const REST_MS = 90;
/** Step of a keyboard move, metres. */
const NUDGE_M = 0.1;

export class Grabbing {
    /** @type {PlacedObject | null} */
    #hovered = null;
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    #resting;

    /** @param {RaybundleApp} app */
    constructor(app) {
        this.app = app;
        app.overlay.add((frame) => {
            frame.box('selected', app.selected);
            const other = this.#hovered && this.#hovered !== app.selected;
            frame.box('hovered', other ? this.#hovered : null);
        });
        app.on('tool', () => this.hover(null));
        app.on('welcome', () => this.hover(null));
    }

    /**
     * Shifts the selected object over the floor.
     *
     * @param {number} right  steps of 10 cm, as seen from the camera
     * @param {number} forwards  steps of 10 cm
     */
    nudge(right, forwards) {
        if (this.app.selected?.loose && this.app.mayEdit && this.app.scene) {
            const step = [right * NUDGE_M, forwards * NUDGE_M];
            this.app.mover.nudge(this.app.selected, this.app.view, step[0], step[1], this.app.scene.bounds);
        }
    }

    /**
     * Whether a press here takes hold of the selected object.
     *
     * @param {Point} at
     */
    canGrab(at) {
        const object = this.app.selected;
        const movable = object?.loose && this.app.mayEdit && this.app.tool === 'select';
        return movable ? intersectBounds(this.app.rayAt(at), object.bounds) !== null : false;
    }

    /**
     * Takes hold of the selected object, if it is there.
     *
     * @param {Point} at
     * @returns {boolean}
     */
    grab(at) {
        return this.app.selected && this.canGrab(at)
            ? this.app.mover.begin(this.app.selected, this.app.rayAt(at))
            : false;
    }

    /**
     * Moves what is in the user's hand.
     *
     * @param {Point} at
     */
    drag(at) {
        if (this.app.scene) {
            this.app.picture.element.classList.add('dragging');
            this.app.mover.drag(this.app.rayAt(at), this.app.view, this.app.scene.bounds);
        }
    }

    /**
     * Lets go of it.
     *
     * @param {boolean} keep  false: it goes back
     */
    release(keep) {
        this.app.picture.element.classList.remove('dragging');
        this.app.mover.end(keep);
    }

    /**
     * Marks what the pointer rests on.
     *
     * @param {Point | null} at
     */
    hover(at) {
        clearTimeout(this.#resting);
        this.app.picture.element.classList.toggle('can-grab', at !== null && this.canGrab(at));
        if (at && this.app.tool === 'select') {
            this.#resting = setTimeout(() => this.#restOn(at), REST_MS);
        } else {
            this.#markHovered(null);
        }
    }

    /** @param {Point} at */
    async #restOn(at) {
        if (this.app.client.state === 'connected' && !this.app.camera.moving) {
            const object = await this.app.pickAt(at.x, at.y);
            this.#markHovered(object?.loose ? object : null);
        }
    }

    /** @param {PlacedObject | null} object */
    #markHovered(object) {
        if (object !== this.#hovered) {
            this.#hovered = object;
            this.app.drawOverlay();
        }
    }
}
