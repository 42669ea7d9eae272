// SPDX-License-Identifier: Apache-2.0
// Where the last picture belongs on the screen while the camera has already moved on: the picture is
// taken for a flat one, at the target's distance, and seen from the new camera. Turning is exact.

import {axes} from '../camera/camera.js';
import {add, dot, length, scale, sub} from '../ui/vector.js';

/**
 * @typedef {import('../net/scene_types.js').Vec3} Vec3
 * @typedef {import('../net/scene_types.js').View} View
 * @typedef {number[]} Matrix3  row by row
 */

/** Points of the picture nearer to the new eye than this share of the distance are not drawn. */
const NEAREST = 0.02;
/**
 * What is smaller is rounding. Left in, it makes a perspective of what only shifts and grows, as walking does,
 * and that takes a browser without a GPU three times as long.
 */
const ROUNDING = 1e-9;

/**
 * Homography from the old picture to the new one, both in normalised coordinates, (0, 0) top left.
 *
 * @param {View} shown  that the picture was made for
 * @param {number} shownAspect  width over height
 * @param {View} view  wanted now
 * @param {number} aspect
 * @returns {Matrix3 | null}  null: the picture lies behind the eye, or partly so
 */
export function homography(shown, shownAspect, view, aspect) {
    const from = axes(shown);
    const to = axes(view);
    const depth = length(sub(shown.target, shown.eye));
    const halfHeight = Math.tan(shown.verticalFov / 2);
    // A point of the plane is centre + x across + y down, x and y from 0 to 1 from its corner.
    const across = scale(from.right, 2 * halfHeight * shownAspect * depth);
    const down = scale(from.up, -2 * halfHeight * depth);
    const middle = add(shown.eye, scale(from.forward, depth));
    const corner = sub(middle, scale(add(across, down), 0.5));
    const offset = sub(corner, view.eye);
    const reach = Math.tan(view.verticalFov / 2);
    const row = (/** @type {Vec3} */ axis, /** @type {number} */ factor) =>
        [across, down, offset].map((v) => dot(v, axis) * factor);
    const x = row(to.right, 0.5 / (reach * aspect));
    const y = row(to.up, -0.5 / reach);
    const w = row(to.forward, 1);
    const corners = [
        [0, 0],
        [1, 0],
        [0, 1],
        [1, 1],
    ];
    if (corners.some(([u, v]) => w[0] * u + w[1] * v + w[2] < NEAREST * depth)) {
        return null;
    }
    const halved = (/** @type {number[]} */ r) => r.map((value, i) => value + 0.5 * w[i]);
    return [...halved(x), ...halved(y), ...w];
}

/**
 * The same as CSS wants it, for an element of a size.
 *
 * @param {Matrix3} h
 * @param {number} width  CSS pixels
 * @param {number} height
 * @returns {string} value of `transform`, with its origin at the top left
 */
export function cssMatrix(h, width, height) {
    const n = h.map((value) => (Math.abs(value) < ROUNDING * Math.abs(h[8]) ? 0 : value / h[8]));
    const m = [
        [n[0], (n[1] * width) / height, n[2] * width],
        [(n[3] * height) / width, n[4], n[5] * height],
        [n[6] / width, n[7] / height, 1],
    ];
    const columns = [
        [m[0][0], m[1][0], 0, m[2][0]],
        [m[0][1], m[1][1], 0, m[2][1]],
        [0, 0, 1, 0],
        [m[0][2], m[1][2], 0, m[2][2]],
    ];
    return `matrix3d(${columns.flat().join(',')})`;
}
