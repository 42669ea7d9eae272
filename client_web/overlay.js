// SPDX-License-Identifier: Apache-2.0
// The outline of the selected object and of the one under the pointer, drawn over the picture.

import {project} from './camera.js';
import {corners, mix} from './vector.js';

/**
 * @typedef {import('./protocol.js').Vec3} Vec3
 * @typedef {import('./protocol.js').View} View
 * @typedef {import('./protocol.js').Bounds} Bounds
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
    const aspect = width / height;
    let path = '';
    for (const [start, end] of visibleEdges(bounds, view.eye)) {
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

export class Overlay {
    /** @param {SVGSVGElement} svg  with groups of class `selected` and `hovered`, each of paths */
    constructor(svg) {
        this.svg = svg;
    }

    /**
     * @param {View} view  of the picture beneath
     * @param {number} aspect  of the picture beneath, which covers the element as CSS has it
     * @param {{selected: Bounds | null, hovered: Bounds | null}} boxes
     */
    draw(view, aspect, boxes) {
        const {clientWidth, clientHeight} = this.svg;
        if (clientWidth === 0 || clientHeight === 0) {
            return;
        }
        const width = Math.max(clientWidth, clientHeight * aspect);
        const height = width / aspect;
        const [left, top] = [(width - clientWidth) / 2, (height - clientHeight) / 2];
        this.svg.setAttribute('viewBox', `${left} ${top} ${clientWidth} ${clientHeight}`);
        for (const [name, bounds] of Object.entries(boxes)) {
            const path = bounds ? outlinePath(bounds, view, width, height) : '';
            for (const element of this.svg.querySelectorAll(`.${name} path`)) {
                element.setAttribute('d', path);
            }
        }
    }
}
