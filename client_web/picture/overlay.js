// SPDX-License-Identifier: Apache-2.0
// The outline of the selected object and of the one under the pointer, drawn over the picture.

import {project} from '../camera/camera.js';
import {corners, mix} from '../ui/vector.js';

/**
 * @typedef {import('../net/scene_types.js').Vec3} Vec3
 * @typedef {import('../net/scene_types.js').View} View
 * @typedef {import('../net/scene_types.js').Bounds} Bounds
 * @typedef {import('../scene/scene_model.js').PlacedObject} PlacedObject
 */

/** Points nearer to the eye's plane are not drawn, metres. */
const NEAR = 1e-3;

const AXES = /** @type {const} */ (['x', 'y', 'z']);

/**
 * Edges of a box that no face of it hides from the eye.
 *
 * @param {Bounds} bounds
 * @param {Vec3} eye
 * @returns {[Vec3, Vec3][]}
 */
export function visibleEdges(bounds, eye) {
    const inside = AXES.every((a) => eye[a] >= bounds.min[a] && eye[a] <= bounds.max[a]);
    /** @type {(axis: number, high: boolean) => boolean} */
    const faces = (axis, high) =>
        high ? eye[AXES[axis]] > bounds.max[AXES[axis]] : eye[AXES[axis]] < bounds.min[AXES[axis]];
    const points = corners(bounds);
    /** @type {[Vec3, Vec3][]} */
    const edges = [];
    for (let axis = 0; axis < 3; ++axis) {
        const [other, another] = [(axis + 1) % 3, (axis + 2) % 3];
        for (let i = 0; i < 8; ++i) {
            const isStart = (i & (1 << axis)) === 0;
            const seen =
                faces(other, (i & (1 << other)) !== 0) ||
                faces(another, (i & (1 << another)) !== 0);
            if (isStart && (inside || seen)) {
                edges.push([points[i], points[i | (1 << axis)]]);
            }
        }
    }
    return edges;
}

/**
 * SVG path of a box's visible edges.
 *
 * @param {Bounds} bounds
 * @param {View} view
 * @param {number} width  of the picture
 * @param {number} height  of the picture
 * @returns {string} empty: nothing of it lies before the eye
 */
export function outlinePath(bounds, view, width, height) {
    return edgesPath(visibleEdges(bounds, view.eye), view, width, height);
}

/**
 * SVG path of edges in space.
 *
 * @param {[Vec3, Vec3][]} edges
 * @param {View} view
 * @param {number} width  of the picture
 * @param {number} height  of the picture
 * @returns {string} empty: nothing of them lies before the eye
 */
export function edgesPath(edges, view, width, height) {
    const aspect = width / height;
    let path = '';
    for (const [start, end] of edges) {
        const a = project(view, aspect, start);
        const b = project(view, aspect, end);
        if (a.depth < NEAR && b.depth < NEAR) {
            continue;
        }
        // Cut off what lies behind the eye.
        const cut = (NEAR - a.depth) / (b.depth - a.depth);
        const from = a.depth < NEAR ? project(view, aspect, mix(start, end, cut)) : a;
        const to = b.depth < NEAR ? project(view, aspect, mix(start, end, cut)) : b;
        for (const [command, p] of /** @type {const} */ ([
            ['M', from],
            ['L', to],
        ])) {
            path += `${command}${(p.x * width).toFixed(1)} ${(p.y * height).toFixed(1)}`;
        }
    }
    return path;
}

/**
 * What a layer draws with: the picture's view and size, CSS pixels.
 *
 * @typedef {object} OverlayFrame
 * @property {View} view
 * @property {number} width
 * @property {number} height
 * @property {(point: Vec3) => {x: number, y: number, depth: number}} place
 * @property {(name: string, object: PlacedObject | null) => void} box  its outline into a group
 */

/** Layers over the picture, drawn together at most once in an animation frame. */
export class Overlay {
    /** @type {((frame: OverlayFrame) => void)[]} */
    #layers = [];
    #scheduled = false;
    /** @type {{view: View, aspect: number} | null} */
    #wanted = null;

    /** @param {SVGSVGElement} svg  with groups of class `selected` and `hovered`, each of paths */
    constructor(svg) {
        this.svg = svg;
    }

    /** @param {(frame: OverlayFrame) => void} layer */
    add(layer) {
        this.#layers.push(layer);
    }

    /**
     * @param {string} name  class of a group
     * @returns {SVGGElement}
     */
    group(name) {
        const found = this.svg.querySelector(`.${name}`);
        if (!(found instanceof SVGGElement)) {
            throw new Error(`The page lacks the group ${name} over the picture.`);
        }
        return found;
    }

    /**
     * @param {View} view
     * @param {number} aspect  of the element, width over height
     */
    draw(view, aspect) {
        this.#wanted = {view, aspect};
        if (!this.#scheduled) {
            this.#scheduled = true;
            requestAnimationFrame(() => this.#drawNow());
        }
    }

    #drawNow() {
        this.#scheduled = false;
        const {clientWidth: width, clientHeight: height} = this.svg;
        if (width === 0 || height === 0 || !this.#wanted) {
            return;
        }
        const {view, aspect} = this.#wanted;
        this.svg.setAttribute('viewBox', `0 0 ${width} ${height}`);
        /** @type {OverlayFrame} */
        const frame = {
            view,
            width,
            height,
            place: (point) => {
                const {x, y, depth} = project(view, aspect, point);
                return {x: x * width, y: y * height, depth};
            },
            box: (name, object) => {
                const edges = object?.boxEdges(view.eye) ?? [];
                const path = edgesPath(edges, view, width, height);
                for (const element of this.svg.querySelectorAll(`.${name} path`)) {
                    element.setAttribute('d', path);
                }
            },
        };
        this.#layers.forEach((layer) => layer(frame));
    }
}
