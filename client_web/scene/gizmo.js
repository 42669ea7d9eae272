// SPDX-License-Identifier: Apache-2.0
// Handles at the selected object: arrows along the axes, a ring to turn it, a square to resize it.

import {byId} from '../ui/elements.js';
import {
    SNAP,
    alongAxis,
    basePoint,
    limitedSize,
    resizedAbout,
    snapped,
    turnedAbout,
} from './placement.js';
import {shifted} from './scene_model.js';
import {svgElement} from '../ui/svg.js';
import {add, centre, scale, vec3} from '../ui/vector.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('../picture/overlay.js').OverlayFrame} OverlayFrame
 * @typedef {import('./scene_model.js').PlacedObject} PlacedObject
 * @typedef {import('../net/scene_types.js').Vec3} Vec3
 * @typedef {import('../net/scene_types.js').Transform} Transform
 * @typedef {'move' | 'turn' | 'size'} GizmoMode
 * @typedef {{x: number, y: number}} Point
 * @typedef {object} HandleDrag
 * @property {string} handle
 * @property {Point} start  page, CSS pixels
 * @property {Point} at
 * @property {PlacedObject} object
 * @property {Required<Transform>} from
 * @property {Vec3} pivot
 */

/** Length of an arrow and radius of the ring, CSS pixels. */
const REACH = 72;
const RING_POINTS = 48;
/** Way of the pointer that doubles the size, CSS pixels. */
const DOUBLING = 120;
/** Handles of things nearer to the eye are not drawn, metres. */
const NEAR = 0.05;

/** @type {Record<string, Vec3>} */
const AXES = {x: vec3(1, 0, 0), y: vec3(0, 1, 0), z: vec3(0, 0, 1)};

export class Gizmo {
    /** @type {GizmoMode} */
    #mode = 'move';
    /** @type {HandleDrag | null} */
    #drag = null;
    #snap = byId('snap', HTMLInputElement);
    /** @type {Map<string, SVGElement[]>} */
    #handles = new Map();

    /** @param {RaybundleApp} app */
    constructor(app) {
        this.app = app;
        this.group = app.overlay.group('gizmo');
        for (const name of ['x', 'y', 'z', 'turn', 'pivot', 'size']) {
            this.#addHandle(name);
        }
        app.overlay.add((frame) => this.#draw(frame));
        for (const button of document.querySelectorAll('[data-gizmo]')) {
            const {gizmo} = /** @type {HTMLElement} */ (button).dataset;
            button.addEventListener('click', () => this.setMode(/** @type {GizmoMode} */ (gizmo)));
        }
    }

    /** @param {GizmoMode} mode */
    setMode(mode) {
        this.#mode = mode;
        for (const button of document.querySelectorAll('[data-gizmo]')) {
            const pressed = /** @type {HTMLElement} */ (button).dataset.gizmo === mode;
            button.setAttribute('aria-pressed', String(pressed));
        }
        this.app.drawOverlay();
    }

    /** Ends a drag, the object going back. Returns whether there was one. */
    cancel() {
        const held = this.#drag !== null;
        this.#drag = null;
        if (held) {
            this.app.mover.end(false);
        }
        return held;
    }

    /** The selected object, if it can be placed. */
    get #object() {
        const {selected, mayEdit, tool} = this.app;
        return selected?.loose && mayEdit && tool === 'select' ? selected : null;
    }

    /** @param {string} name */
    #addHandle(name) {
        const parts = ['grip', 'shape'].map((kind) => {
            const path = svgElement('path');
            path.setAttribute('class', `${kind} ${name}`);
            path.dataset.handle = name;
            this.group.append(path);
            return path;
        });
        this.#handles.set(name, parts);
        const grip = parts[0];
        grip.addEventListener('pointerdown', (event) => this.#begin(name, grip, event));
        grip.addEventListener('pointermove', (event) => this.#move(event));
        grip.addEventListener('pointerup', (event) => {
            event.stopPropagation();
            if (this.#drag) {
                this.#drag = null;
                this.app.mover.end(true);
            }
        });
        grip.addEventListener('pointercancel', () => this.cancel());
    }

    /**
     * @param {string} handle
     * @param {SVGElement} element
     * @param {PointerEvent} event
     */
    #begin(handle, element, event) {
        const object = this.#object;
        if (!object || event.button !== 0) {
            return;
        }
        event.stopPropagation();
        this.app.picture.element.focus({preventScroll: true});
        element.setPointerCapture(event.pointerId);
        const at = {x: event.clientX, y: event.clientY};
        const from = object.transform;
        const pivot = handle === 'turn' || handle === 'pivot' ? object.pivot : basePoint(object.bounds);
        this.#drag = {handle, start: at, at, object, from, pivot};
        this.app.mover.hold(object);
    }

    /** @param {PointerEvent} event */
    #move(event) {
        if (!this.#drag) {
            return;
        }
        event.stopPropagation();
        this.#drag.at = {x: event.clientX, y: event.clientY};
        if (this.#drag.handle === 'pivot') {
            this.#movePivot(this.#drag);
            return;
        }
        this.app.mover.place(this.#wanted(this.#drag, this.#snap.checked !== event.ctrlKey));
    }

    /**
     * Shifts what the object turns about, over the floor.
     *
     * @param {HandleDrag} drag
     */
    #movePivot({object, at, pivot}) {
        const box = this.app.picture.element.getBoundingClientRect();
        const {origin, direction} = this.app.rayAt({x: at.x - box.left, y: at.y - box.top});
        const t = (pivot.y - origin.y) / direction.y;
        if (t > 0 && Number.isFinite(t)) {
            object.pivot = add(origin, scale(direction, t));
            this.app.drawOverlay();
        }
    }

    /**
     * @param {HandleDrag} drag
     * @param {boolean} snap
     * @returns {Required<Transform>}
     */
    #wanted({handle, start, at, object, from, pivot}, snap) {
        const parent = object.worldFromParent;
        const way = {x: at.x - start.x, y: at.y - start.y};
        if (handle === 'turn') {
            const box = this.app.picture.element.getBoundingClientRect();
            const middle = this.app.project(pivot);
            const angleOf = (/** @type {Point} */ p) =>
                Math.atan2(p.y - box.top - middle.y, p.x - box.left - middle.x);
            // Seen from above a turn to the left goes against the clock, from below with it.
            const sign = this.app.view.eye.y >= pivot.y ? -1 : 1;
            const angle = sign * (angleOf(at) - angleOf(start));
            const turn = snap ? snapped(angle, SNAP.radians) : angle;
            return turnedAbout(from, pivot, turn, parent);
        }
        if (handle === 'size') {
            const factor = 2 ** ((way.x - way.y) / DOUBLING);
            const size = snap ? Math.max(snapped(factor, SNAP.share), SNAP.share) : factor;
            return resizedAbout(from, pivot, limitedSize(size), parent);
        }
        const {clientWidth: width, clientHeight: height} = this.app.picture.element;
        const axis = AXES[handle];
        const metres = alongAxis(this.app.view, {width, height}, pivot, axis, way);
        const shift = snap ? snapped(metres, SNAP.metres) : metres;
        return shifted(from, scale(axis, shift), parent);
    }

    /** @param {OverlayFrame} frame */
    #draw(frame) {
        const object = this.#object;
        const base = object ? frame.place(basePoint(object.bounds)) : null;
        /** @type {Record<string, string>} */
        const paths = {};
        if (object && base && base.depth > NEAR) {
            // Metres that appear as long as the handles are to be.
            const perPixel = (2 * Math.tan(frame.view.verticalFov / 2) * base.depth) / frame.height;
            Object.assign(paths, this.#shapes(frame, object, REACH * perPixel));
        }
        for (const [name, parts] of this.#handles) {
            parts.forEach((part) => part.setAttribute('d', paths[name] ?? ''));
        }
    }

    /**
     * @param {OverlayFrame} frame
     * @param {PlacedObject} object
     * @param {number} metres  length of a handle
     * @returns {Record<string, string>} SVG paths by name of the handle
     */
    #shapes({place}, object, metres) {
        const base = basePoint(object.bounds);
        const at = (/** @type {Vec3} */ point) => {
            const {x, y} = place(point);
            return `${x.toFixed(1)} ${y.toFixed(1)}`;
        };
        if (this.#mode === 'turn') {
            const {pivot} = object;
            const points = Array.from({length: RING_POINTS}, (_, i) => {
                const angle = (2 * Math.PI * i) / RING_POINTS;
                return at(add(pivot, vec3(metres * Math.sin(angle), 0, metres * Math.cos(angle))));
            });
            const {x, y} = place(pivot);
            return {turn: `M${points.join('L')}Z`, pivot: `M${x - 6} ${y}a6 6 0 1 0 12 0a6 6 0 1 0 -12 0Z`};
        }
        if (this.#mode === 'size') {
            const top = vec3(base.x, object.bounds.max.y, base.z);
            const {x, y} = place(top.y > base.y ? top : centre(object.bounds));
            return {size: `M${x - 9} ${y - 9}h18v18h-18Z`};
        }
        // The upright one begins at the top, so that the object itself stays free to be dragged.
        const top = vec3(base.x, object.bounds.max.y, base.z);
        return Object.fromEntries(
            Object.entries(AXES).map(([name, axis]) => {
                const from = name === 'y' ? top : base;
                return [name, arrow(place(from), place(add(from, scale(axis, metres))))];
            }),
        );
    }
}

/**
 * @param {Point} from
 * @param {Point} to
 * @returns {string} SVG path; empty where the arrow is seen end-on
 */
function arrow(from, to) {
    const length = Math.hypot(to.x - from.x, to.y - from.y);
    if (length < 8) {
        return '';
    }
    const x = (to.x - from.x) / length;
    const y = (to.y - from.y) / length;
    const wing = (/** @type {number} */ side) =>
        `${(to.x - 11 * x + side * 5 * y).toFixed(1)} ${(to.y - 11 * y - side * 5 * x).toFixed(1)}`;
    const tip = `${to.x.toFixed(1)} ${to.y.toFixed(1)}`;
    return `M${from.x.toFixed(1)} ${from.y.toFixed(1)}L${tip}M${wing(1)}L${tip}L${wing(-1)}`;
}
