// SPDX-License-Identifier: Apache-2.0
// Walls, furniture and stairs for who walks: keeps cells of the surroundings at hand, which it asks the server for well
// before they are needed, so that no step waits for an answer. Off by the key C.

import {byId} from '../ui/elements.js';
import {ServerError} from '../net/protocol.js';
import {lowestFloor} from '../scene/floors.js';
import {add, contains, length, sub, vec3} from '../ui/vector.js';
import {WalkGrid, Walker} from './walk_grid.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('../net/scene_types.js').Vec3} Vec3
 * @typedef {import('../net/scene_types.js').View} View
 */

/** So far from the middle of its cells somebody asks for others, metres. */
const ASK_AFTER_M = 1.2;
/** Likewise upwards and downwards. */
const ASK_AFTER_HEIGHT_M = 0.5;
const PAUSE_MS = 1000;
/** Nobody stands in what is lower, metres. */
const LOWEST_SCENE = 2;

export class Collisions {
    on = true;
    /** @type {WalkGrid | null} */
    #grid = null;
    /** The server knows of none. */
    #unknown = false;
    #asking = false;
    #stale = false;
    #walker = new Walker();
    /** Where the walker stands; elsewhere somebody has put the eye. @type {Vec3 | null} */
    #at = null;

    /** Whether the eye has come to where it is past walls, or has been flown there. */
    honest = true;
    /** @type {Vec3 | null} */
    #before = null;
    #flights = 0;

    /** @param {RaybundleApp} app */
    constructor(app) {
        this.app = app;
        this.button = byId('collide', HTMLButtonElement);
        this.button.addEventListener('click', () => this.toggle());
        app.camera.obstacles = this;
        app.on('welcome', () => {
            this.#grid = null;
            this.#unknown = false;
            this.#before = null;
            this.honest = true;
            this.#ask();
        });
        app.on('view', () => {
            this.#follow();
            this.#ask();
        });
        app.on('picture', () => this.#ask());
        app.on('sceneChanged', (change) => {
            const comesOrGoes = change.addObject ?? change.removeObject;
            if (comesOrGoes || (change.moveObject && change.moveObject.final !== false)) {
                this.#stale = true;
                this.#ask();
            }
        });
    }

    /** Through walls, or not any more. */
    toggle() {
        this.on = !this.on;
        this.button.setAttribute('aria-pressed', String(this.on));
        this.app.status.notify(this.on ? 'Walls stop you again (C).' : 'You go through walls now (C).');
    }

    /** The surroundings, if they are known and count. @returns {WalkGrid | null} */
    get grid() {
        const {scene, view} = this.app;
        const high = scene ? scene.bounds.max.y - scene.bounds.min.y : 0;
        const counts = this.on && high >= LOWEST_SCENE && !view.near;
        return counts && this.#grid?.covers(view.eye) ? this.#grid : null;
    }

    /**
     * Height of what is straight below an eye, metres: of the floor of the storey, of the ground, not of the whole scene.
     *
     * @param {Vec3} eye
     */
    floorUnder(eye) {
        return this.#grid?.under(eye) ?? this.app.scene?.bounds.min.y ?? 0;
    }

    /**
     * Height of the floor of a storey, metres: of its slabs; where no object is one, of what is below an eye that is there.
     *
     * @param {string} storey  empty: of the whole scene
     * @param {Vec3} [eye]
     */
    floorOf(storey, eye = this.app.view.eye) {
        const {scene} = this.app;
        if (!scene) {
            return 0;
        }
        const bounds = scene.storeys.get(storey) ?? scene.bounds;
        const foot = bounds.min.y;
        const floor = lowestFloor(storey ? scene.objects.filter((object) => object.storey === storey) : scene.objects, bounds);
        return floor ?? (contains(bounds, eye) ? Math.max(this.floorUnder(eye), foot) : foot);
    }

    /**
     * A view after a step, as far as there is room.
     *
     * @param {View} view  after the step, if nothing were in the way
     * @param {View} before
     * @returns {View}
     */
    walked(view, before) {
        const {grid} = this;
        if (!grid) {
            return view;
        }
        const step = sub(view.eye, before.eye);
        const own = this.#at && length(sub(this.#at, before.eye)) < 1e-6;
        if (!own) {
            this.#walker.stand(grid, before.eye);
        }
        let eye = this.#walker.walk(grid, before.eye, step);
        if (step.y !== 0) {
            eye = grid.reached(eye, vec3(eye.x, eye.y + step.y, eye.z));
            this.#walker.stand(grid, eye);
        }
        this.#at = eye;
        return {...view, eye, target: add(view.target, sub(eye, view.eye))};
    }

    /**
     * A view whose eye has come straight from another one, as far as there is room.
     *
     * @param {View} view
     * @param {View} before
     * @returns {View}
     */
    flown(view, before) {
        const {grid} = this;
        return grid ? {...view, eye: grid.reached(before.eye, view.eye)} : view;
    }

    /** Takes note of how the eye has come to where it is. */
    #follow() {
        const {camera, link, view} = this.app;
        const before = this.#before ?? view.eye;
        const grid = this.#grid;
        if (camera.flights !== this.#flights || camera.flying || link.led) {
            this.honest = true;
        } else if (grid?.covers(before) && length(sub(grid.reached(before, view.eye), view.eye)) > 1e-6) {
            this.honest &&= this.#at !== null && length(sub(this.#at, view.eye)) < 1e-6;
        }
        this.#flights = camera.flights;
        this.#before = view.eye;
    }

    /** Asks for cells of the surroundings, where those at hand will not do for long. */
    async #ask() {
        const {app} = this;
        const {eye} = app.view;
        const off = this.#grid && sub(eye, this.#grid.middle);
        const near = off && Math.hypot(off.x, off.z) < ASK_AFTER_M && Math.abs(off.y - this.#middleEye) < ASK_AFTER_HEIGHT_M;
        if (this.#asking || this.#unknown || app.view.near || (near && !this.#stale) || app.client.state !== 'connected') {
            return;
        }
        this.#asking = true;
        this.#stale = false;
        try {
            const {walkMap} = await app.client.request({getWalkMap: {eye}}).answer;
            if (walkMap) {
                this.#grid = new WalkGrid(walkMap);
                this.#middleEye = eye.y - this.#grid.middle.y;
                app.dispatchEvent(new CustomEvent('surroundings'));
            } else {
                this.#unknown = true;
            }
        } catch (error) {
            this.#unknown = error instanceof ServerError && error.code === 'UNIMPLEMENTED';
            // A server that has too much to do is not asked at each step.
            await new Promise((resolve) => setTimeout(resolve, PAUSE_MS));
        }
        this.#asking = false;
    }

    /** Of the eye that the cells were asked for, above their middle, metres. */
    #middleEye = 0;
}
