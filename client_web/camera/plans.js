// SPDX-License-Identifier: Apache-2.0
// Plans and sections: the scene seen from so far away that parallels stay parallel, cut open by a near plane. Light is
// that of the whole scene.

import {sameView} from './camera.js';
import {byId, listRow} from '../ui/elements.js';
import {UP, add, centre, scale, sub, vec3} from '../ui/vector.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('../net/scene_types.js').Bounds} Bounds
 * @typedef {import('../net/scene_types.js').View} View
 * @typedef {import('../net/scene_types.js').Vec3} Vec3
 * @typedef {import('../scene/scene_model.js').SceneModel} SceneModel
 */

/** Field of view of a plan, radians: what is 3 m nearer than the rest looks by less than 0.2 % larger in a plan of 15 m. */
export const PLAN_FOV = 0.01;
/** Where a plan is cut, above the floor, metres (ISO 7519: through windows and doors). */
const CUT_HEIGHT = 1.2;
/** Room around what a plan shows. */
const MARGIN = 1.08;

/**
 * A view of a box from a direction, cut by a plane across it.
 *
 * @param {Bounds} bounds
 * @param {Vec3} towards  of the line of sight, along an axis, of length 1
 * @param {Vec3} up  of length 1
 * @param {Vec3} cut  a point of the plane
 * @param {number} aspect  width over height
 * @returns {View & {near: number}}
 */
export function planView(bounds, towards, up, cut, aspect) {
    const size = sub(bounds.max, bounds.min);
    const along = (/** @type {Vec3} */ axis) => Math.abs(axis.x * size.x + axis.y * size.y + axis.z * size.z);
    const right = vec3(towards.y * up.z - towards.z * up.y, towards.z * up.x - towards.x * up.z, towards.x * up.y - towards.y * up.x);
    const height = MARGIN * Math.max(along(up), along(right) / aspect, 0.1);
    const away = height / (2 * Math.tan(PLAN_FOV / 2));
    const middle = centre(bounds);
    const toCut = sub(cut, middle);
    const depth = toCut.x * towards.x + toCut.y * towards.y + toCut.z * towards.z;
    const target = add(middle, scale(towards, depth));
    return {eye: sub(target, scale(towards, away)), target, up, verticalFov: PLAN_FOV, near: away};
}

/**
 * Plan of a storey, or of what is around somebody who stands on a floor.
 *
 * @param {Bounds} bounds
 * @param {number} aspect
 * @param {number} [floor]  its height, metres
 * @returns {View & {near: number}}
 */
export function planOf(bounds, aspect, floor = bounds.min.y) {
    const {x, z} = centre(bounds);
    const y = Math.min(floor + CUT_HEIGHT, (floor + bounds.max.y) / 2);
    return planView(bounds, vec3(0, -1, 0), vec3(0, 0, -1), vec3(x, y, z), aspect);
}

/**
 * Section through the middle of something.
 *
 * @param {Bounds} bounds  of the scene
 * @param {Vec3} through
 * @param {'x' | 'z'} axis  along which one looks
 * @param {number} aspect
 * @returns {View & {near: number}}
 */
export function sectionOf(bounds, through, axis, aspect) {
    const towards = axis === 'x' ? vec3(1, 0, 0) : vec3(0, 0, -1);
    return planView(bounds, towards, UP, through, aspect);
}

/** Buttons for them, beside the cameras. */
export class Plans {
    /** The view before the first plan. @type {View | null} */
    #before = null;
    /** The plan as it was opened, and for a picture of another shape. @type {{view: View, fit: (aspect: number) => View & {near: number}} | null} */
    #opened = null;
    #list = byId('plans', HTMLUListElement);

    /**
     * @param {RaybundleApp} app
     * @param {import('./collisions.js').Collisions} collisions
     */
    constructor(app, collisions) {
        this.app = app;
        this.collisions = collisions;
        app.on('welcome', () => this.#showScene());
        app.on('view', () => {
            byId('leave-plan', HTMLElement).hidden = !app.view.near;
            if (!app.view.near) {
                this.#before = null;
            }
        });
        app.picture.addEventListener('resize', () => this.#fitAgain());
        byId('leave-plan', HTMLButtonElement).addEventListener('click', () => this.leave());
    }

    /** Back to the view before. */
    leave() {
        if (this.app.view.near) {
            const [first] = this.app.scene?.cameras ?? [];
            const back = this.#before ?? (first && this.app.framed(first));
            if (back) {
                this.app.camera.flyTo(back);
            }
        }
    }

    /** Of the storey that somebody is in; from outside the lowest. */
    #floor() {
        const {eye} = this.#before ?? this.app.view;
        const {min, max} = this.app.scene?.bounds ?? {min: eye, max: eye};
        const inside = eye.x > min.x && eye.x < max.x && eye.y < max.y && eye.z > min.z && eye.z < max.z;
        return inside ? Math.max(this.collisions.floorUnder(eye), min.y) : min.y;
    }

    /** Shows the whole of a plan in a picture of another shape, as when the panel closes; not of one that was shifted or enlarged. */
    #fitAgain() {
        const {app} = this;
        if (this.#opened && !app.link.led && sameView(app.view, this.#opened.view)) {
            const {fit} = this.#opened;
            const view = fit(app.picture.aspect);
            this.#opened = {view, fit};
            app.camera.set(view);
        }
    }

    /** @param {(aspect: number) => View & {near: number}} fit */
    #open(fit) {
        const view = fit(this.app.picture.aspect);
        this.#opened = {view, fit};
        this.#before = this.app.view.near ? this.#before : this.app.view;
        const before = this.#before;
        this.app.camera.flyTo(view);
        this.#before = before;
    }

    #showScene() {
        const {app} = this;
        const {scene} = app;
        if (!scene) {
            return;
        }
        const through = () => centre((app.selected ?? scene).bounds);
        const rows = [...scene.storeys.entries()].map(([name, bounds]) =>
            listRow(`Plan of ${name}`, () => {
                const floor = this.collisions.floorOf(name, (this.#before ?? app.view).eye);
                this.#open((aspect) => planOf(bounds, aspect, floor));
            }),
        );
        const plan = () => {
            const floor = this.#floor();
            this.#open((aspect) => planOf(scene.bounds, aspect, floor));
        };
        const section = (/** @type {'x' | 'z'} */ axis) => {
            const point = through();
            this.#open((aspect) => sectionOf(scene.bounds, point, axis, aspect));
        };
        this.#list.replaceChildren(
            ...(rows.length > 0 ? rows : [listRow('Plan', plan)]),
            listRow('Section, looking north (−z)', () => section('z')),
            listRow('Section, looking east (+x)', () => section('x')),
        );
    }
}
