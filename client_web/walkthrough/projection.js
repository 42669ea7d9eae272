// SPDX-License-Identifier: Apache-2.0
// From the world to the picture, for WebGL.

import {axes} from '../camera/camera.js';
import {diagonal, dot, length, scale, sub, vec3} from '../ui/vector.js';

/**
 * @typedef {import('../net/scene_types.js').View} View
 * @typedef {import('../net/scene_types.js').Vec3} Vec3
 * @typedef {import('../net/scene_types.js').Bounds} Bounds
 */

/** What is nearer to the eye is not drawn: metres, or this share of a smaller scene. */
const NEAR = {metres: 0.01, share: 0.002};

/**
 * Where drawing begins and ends along the line of sight, metres: all of the scene that is not very near.
 *
 * @param {Vec3} eye
 * @param {Bounds} bounds
 * @param {number} section  what is nearer is cut away, metres
 */
export function depthRange(eye, bounds, section = 0) {
    const {min, max} = bounds;
    const far = (/** @type {'x' | 'y' | 'z'} */ axis) => Math.max(eye[axis] - min[axis], max[axis] - eye[axis]);
    const near = Math.max(Math.min(NEAR.metres, NEAR.share * diagonal(bounds)), section);
    return {near, far: Math.max(1.01 * length(vec3(far('x'), far('y'), far('z'))), 2 * near)};
}

/**
 * @param {View} view
 * @param {number} aspect  width over height
 * @param {Bounds} bounds  of the scene
 * @returns {{clipFromWorld: Float32Array, eye: Vec3, forward: Vec3, right: Vec3, up: Vec3}}  right, up: to the edges of
 *     the picture at a distance of 1
 */
export function projectionOf(view, aspect, bounds) {
    const {eye} = view;
    const {right, up, forward} = axes(view);
    const half = Math.tan(view.verticalFov / 2);
    const {near, far} = depthRange(eye, bounds, view.near ?? 0);
    const row = (/** @type {Vec3} */ v, /** @type {number} */ more) => [v.x, v.y, v.z, more - dot(v, eye)];
    const depth = (far + near) / (far - near);
    const rows = [
        row(scale(right, 1 / (half * aspect)), 0),
        row(scale(up, 1 / half), 0),
        row(scale(forward, depth), (-2 * far * near) / (far - near)),
        row(forward, 0),
    ];
    const columns = [0, 1, 2, 3].flatMap((column) => rows.map((values) => values[column]));
    return {
        clipFromWorld: new Float32Array(columns),
        eye,
        forward,
        right: scale(right, half * aspect),
        up: scale(up, half),
    };
}

/** @type {(triple: [number, number, number]) => Vec3} */
export const vectorOf = ([x, y, z]) => vec3(x, y, z);

/**
 * A camera of scene.json.
 *
 * @param {{eye: [number, number, number], target: [number, number, number], up: [number, number, number],
 *     verticalFov: number}} camera
 * @returns {View}
 */
export function viewOf({eye, target, up, verticalFov}) {
    const view = {eye: vectorOf(eye), target: vectorOf(target), up: vectorOf(up), verticalFov};
    return length(sub(view.eye, view.target)) > 0 ? view : {...view, target: sub(view.eye, vec3(0, 0, 1))};
}
