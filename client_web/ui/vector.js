// SPDX-License-Identifier: Apache-2.0
// Vectors, quaternions and axis-aligned boxes. Nothing here changes its arguments.

/**
 * @typedef {import('../net/scene_types.js').Vec3} Vec3
 * @typedef {import('../net/scene_types.js').Quaternion} Quaternion
 * @typedef {import('../net/scene_types.js').Bounds} Bounds
 * @typedef {import('../net/scene_types.js').Transform} Transform
 * @typedef {{origin: Vec3, direction: Vec3}} Ray
 */

/** @type {(x: number, y: number, z: number) => Vec3} */
export const vec3 = (x, y, z) => ({x, y, z});
/** @type {(a: Vec3, b: Vec3) => Vec3} */
export const add = (a, b) => vec3(a.x + b.x, a.y + b.y, a.z + b.z);
/** @type {(a: Vec3, b: Vec3) => Vec3} */
export const sub = (a, b) => vec3(a.x - b.x, a.y - b.y, a.z - b.z);
/** @type {(a: Vec3, s: number) => Vec3} */
export const scale = (a, s) => vec3(a.x * s, a.y * s, a.z * s);
/** @type {(a: Vec3, b: Vec3) => number} */
export const dot = (a, b) => a.x * b.x + a.y * b.y + a.z * b.z;
/** @type {(a: Vec3, b: Vec3) => Vec3} */
export const cross = (a, b) =>
    vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
/** @type {(a: Vec3) => number} */
export const length = (a) => Math.hypot(a.x, a.y, a.z);
/** @type {(a: Vec3, b: Vec3, t: number) => Vec3} */
export const mix = (a, b, t) => add(scale(a, 1 - t), scale(b, t));
/** @type {(a: Vec3, b: Vec3) => Vec3} */
const times = (a, b) => vec3(a.x * b.x, a.y * b.y, a.z * b.z);

/** Upwards in every scene. */
export const UP = Object.freeze(vec3(0, 1, 0));

/**
 * Vector of length 1 with the direction of `a`; the zero vector stays.
 *
 * @param {Vec3} a
 * @returns {Vec3}
 */
export function normalise(a) {
    const size = length(a);
    return size > 0 ? scale(a, 1 / size) : a;
}

/**
 * Limits a number to a range.
 *
 * @param {number} value
 * @param {number} low
 * @param {number} high
 * @returns {number}
 */
export function clamp(value, low, high) {
    return Math.min(Math.max(value, low), high);
}

/**
 * Rotates a vector by a unit quaternion.
 *
 * @param {Quaternion} q
 * @param {Vec3} v
 * @returns {Vec3}
 */
export function rotate(q, v) {
    const axis = vec3(q.x, q.y, q.z);
    const t = scale(cross(axis, v), 2);
    return add(add(v, scale(t, q.w)), cross(axis, t));
}

/**
 * A transform with glTF's defaults for absent parts and its rotation of length 1.
 *
 * @param {Transform} transform
 * @returns {Required<Transform>}
 */
export function completeTransform(transform) {
    const q = transform.rotation ?? {x: 0, y: 0, z: 0, w: 1};
    const size = Math.hypot(q.x, q.y, q.z, q.w) || 1;
    return {
        translation: transform.translation ?? vec3(0, 0, 0),
        rotation: {x: q.x / size, y: q.y / size, z: q.z / size, w: q.w / size},
        scale: transform.scale ?? vec3(1, 1, 1),
    };
}

/**
 * Takes a point from node space to the parent's.
 *
 * @param {Transform} transform
 * @param {Vec3} point
 * @returns {Vec3}
 */
export function transformPoint(transform, point) {
    const t = completeTransform(transform);
    return add(rotate(t.rotation, times(t.scale, point)), t.translation);
}

/**
 * Takes a point from the parent's space to node space; along an axis whose scale is 0, to the node's zero.
 *
 * @param {Transform} transform
 * @param {Vec3} point
 * @returns {Vec3}
 */
export function inverseTransformPoint(transform, point) {
    const t = completeTransform(transform);
    const conjugate = {x: -t.rotation.x, y: -t.rotation.y, z: -t.rotation.z, w: t.rotation.w};
    const inverse = (/** @type {number} */ factor) => (factor === 0 ? 0 : 1 / factor);
    const inverseScale = vec3(inverse(t.scale.x), inverse(t.scale.y), inverse(t.scale.z));
    return times(inverseScale, rotate(conjugate, sub(point, t.translation)));
}

/** Affine 4x4 matrix, column by column. */
export const IDENTITY = Object.freeze([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);

/**
 * A direction under an affine matrix.
 *
 * @param {readonly number[]} m
 * @param {Vec3} v
 * @returns {Vec3}
 */
export function matrixVector(m, v) {
    return vec3(
        m[0] * v.x + m[4] * v.y + m[8] * v.z,
        m[1] * v.x + m[5] * v.y + m[9] * v.z,
        m[2] * v.x + m[6] * v.y + m[10] * v.z,
    );
}

/**
 * @param {readonly number[]} m
 * @param {Vec3} p
 * @returns {Vec3}
 */
export function matrixPoint(m, p) {
    return add(matrixVector(m, p), vec3(m[12], m[13], m[14]));
}

/**
 * The direction that matrixVector() takes to `v` (Cramer's rule); `v` itself if there is none.
 *
 * @param {readonly number[]} m
 * @param {Vec3} v
 * @returns {Vec3}
 */
export function inverseMatrixVector(m, v) {
    const x = vec3(m[0], m[1], m[2]);
    const y = vec3(m[4], m[5], m[6]);
    const z = vec3(m[8], m[9], m[10]);
    const determinant = dot(x, cross(y, z));
    if (determinant === 0) {
        return v;
    }
    return scale(
        vec3(dot(v, cross(y, z)), dot(x, cross(v, z)), dot(x, cross(y, v))),
        1 / determinant,
    );
}

/**
 * @param {readonly number[]} m
 * @param {Vec3} p
 * @returns {Vec3}
 */
export function inverseMatrixPoint(m, p) {
    return inverseMatrixVector(m, sub(p, vec3(m[12], m[13], m[14])));
}

/**
 * The eight corners; bit 0, 1, 2 of the index say whether x, y, z is the maximum.
 *
 * @param {Bounds} bounds
 * @returns {Vec3[]}
 */
export function corners({min, max}) {
    const result = [];
    for (let i = 0; i < 8; ++i) {
        result.push(vec3(i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z));
    }
    return result;
}

/**
 * Smallest box around points; at least one point.
 *
 * @param {Vec3[]} points
 * @returns {Bounds}
 */
export function boundsOf(points) {
    const low = (/** @type {'x' | 'y' | 'z'} */ axis) => Math.min(...points.map((p) => p[axis]));
    const high = (/** @type {'x' | 'y' | 'z'} */ axis) => Math.max(...points.map((p) => p[axis]));
    return {min: vec3(low('x'), low('y'), low('z')), max: vec3(high('x'), high('y'), high('z'))};
}

/** @type {(bounds: Bounds) => Vec3} */
export const centre = ({min, max}) => mix(min, max, 0.5);

/** @type {(bounds: Bounds, point: Vec3) => boolean} */
export const contains = ({min, max}, {x, y, z}) =>
    x > min.x && x < max.x && y > min.y && y < max.y && z > min.z && z < max.z;

/** @type {(bounds: Bounds) => number} */
export const diagonal = ({min, max}) => length(sub(max, min));

/**
 * Distances along a ray, in units of its direction, at which it enters and leaves a box.
 *
 * @param {Ray} ray
 * @param {Bounds} bounds
 * @returns {{enter: number, leave: number} | null}  null: not met in front of the origin; `enter`
 *     is negative where the origin lies inside
 */
export function intersectBounds(ray, bounds) {
    let enter = -Infinity;
    let leave = Infinity;
    for (const axis of /** @type {const} */ (['x', 'y', 'z'])) {
        const origin = ray.origin[axis];
        const direction = ray.direction[axis];
        if (direction === 0) {
            if (origin < bounds.min[axis] || origin > bounds.max[axis]) {
                return null;
            }
            continue;
        }
        const a = (bounds.min[axis] - origin) / direction;
        const b = (bounds.max[axis] - origin) / direction;
        enter = Math.max(enter, Math.min(a, b));
        leave = Math.min(leave, Math.max(a, b));
    }
    return leave >= Math.max(enter, 0) ? {enter, leave} : null;
}
