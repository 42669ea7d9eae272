// SPDX-License-Identifier: Apache-2.0
// Pure maths of placing an object: turned about an upright axis, resized on its base, moved along an
// axis; with steps to snap to. World space, metres and radians.

import {project} from '../camera/camera.js';
import {
    IDENTITY,
    UP,
    add,
    centre,
    completeTransform,
    inverseMatrixPoint,
    inverseMatrixVector,
    length,
    matrixPoint,
    normalise,
    rotate,
    scale,
    sub,
    vec3,
} from '../ui/vector.js';

/**
 * @typedef {import('../net/scene_types.js').Vec3} Vec3
 * @typedef {import('../net/scene_types.js').View} View
 * @typedef {import('../net/scene_types.js').Bounds} Bounds
 * @typedef {import('../net/scene_types.js').Transform} Transform
 * @typedef {import('../net/scene_types.js').Quaternion} Quaternion
 */

/** What handles snap to. */
export const SNAP = Object.freeze({metres: 0.1, radians: Math.PI / 12, share: 0.1});

/** An object is not made smaller or larger than by these factors at once. */
const SIZE_LIMITS = {least: 0.05, most: 20};

/**
 * Where an object stands on its base: the middle of its bounds, at their lower edge.
 *
 * @param {Bounds} bounds
 * @returns {Vec3}
 */
export function basePoint(bounds) {
    const {x, z} = centre(bounds);
    return vec3(x, bounds.min.y, z);
}

/** From the middle to the edge, what lies further out than this share is at the edge. */
const AT_EDGE = 0.8;
/** And it may be outside of the bounds by so much, metres. */
const BESIDE = 0.1;

/**
 * Whether an object's own origin is at its edge, as that of a door at its hinge is.
 *
 * @param {Bounds} bounds
 * @param {Vec3} origin
 */
export function isHinge(bounds, origin) {
    const middle = centre(bounds);
    const shares = /** @type {const} */ (['x', 'z']).map((axis) => {
        const half = (bounds.max[axis] - bounds.min[axis]) / 2;
        const off = Math.abs(origin[axis] - middle[axis]);
        return {long: half, outside: off > half + BESIDE, share: half > 0 ? off / half : 0};
    });
    const longest = shares[0].long >= shares[1].long ? shares[0] : shares[1];
    return shares.every(({outside}) => !outside) && longest.share >= AT_EDGE;
}

/**
 * Hamilton product: rotates by `b`, then by `a`.
 *
 * @param {Quaternion} a
 * @param {Quaternion} b
 * @returns {Quaternion}
 */
export function multiplied(a, b) {
    return {
        x: a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
        y: a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
        z: a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w,
        w: a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
    };
}

/**
 * @param {Vec3} axis  of length 1
 * @param {number} angle
 * @returns {Quaternion}
 */
export function aboutAxis(axis, angle) {
    const v = scale(axis, Math.sin(angle / 2));
    return {...v, w: Math.cos(angle / 2)};
}

/**
 * A transform turned about the upright axis through a point.
 *
 * @param {Transform} transform  local
 * @param {Vec3} pivot
 * @param {number} angle  to the left as seen from above
 * @param {readonly number[]} [worldFromParent]
 * @returns {Required<Transform>}
 */
export function turnedAbout(transform, pivot, angle, worldFromParent = IDENTITY) {
    const {translation, rotation, scale: size} = completeTransform(transform);
    const world = matrixPoint(worldFromParent, translation);
    const moved = add(rotate(aboutAxis(UP, angle), sub(world, pivot)), pivot);
    // The same turn in the parent's space, which must not shear.
    const axis = normalise(inverseMatrixVector(worldFromParent, UP));
    return {
        translation: inverseMatrixPoint(worldFromParent, moved),
        rotation: multiplied(aboutAxis(axis, angle), rotation),
        scale: size,
    };
}

/**
 * A transform resized evenly about a point.
 *
 * @param {Transform} transform  local
 * @param {Vec3} pivot
 * @param {number} factor
 * @param {readonly number[]} [worldFromParent]
 * @returns {Required<Transform>}
 */
export function resizedAbout(transform, pivot, factor, worldFromParent = IDENTITY) {
    const {translation, rotation, scale: size} = completeTransform(transform);
    const world = matrixPoint(worldFromParent, translation);
    const moved = add(scale(sub(world, pivot), factor), pivot);
    return {
        translation: inverseMatrixPoint(worldFromParent, moved),
        rotation,
        scale: scale(size, factor),
    };
}

/**
 * How far a pointer has moved along an axis through a point, as it appears in the picture.
 *
 * @param {View} view
 * @param {{width: number, height: number}} picture  CSS pixels
 * @param {Vec3} point
 * @param {Vec3} axis  of length 1
 * @param {{x: number, y: number}} way  of the pointer, CSS pixels
 * @returns {number} metres; 0 where the axis is seen end-on
 */
export function alongAxis(view, {width, height}, point, axis, way) {
    const aspect = width / height;
    const step = 0.01 * Math.max(length(sub(point, view.eye)), 0.1);
    const a = project(view, aspect, point);
    const b = project(view, aspect, add(point, scale(axis, step)));
    const x = ((b.x - a.x) * width) / step;
    const y = ((b.y - a.y) * height) / step;
    const square = x * x + y * y;
    return square < 1 ? 0 : (way.x * x + way.y * y) / square;
}

/**
 * @param {number} value
 * @param {number} step
 * @returns {number} the multiple of `step` nearest to `value`
 */
export const snapped = (value, step) => Math.round(value / step) * step;

/** @type {(factor: number) => number} */
export const limitedSize = (factor) =>
    Math.min(Math.max(factor, SIZE_LIMITS.least), SIZE_LIMITS.most);

/**
 * Turn about the upright axis from one rotation to another.
 *
 * @param {Quaternion} from
 * @param {Quaternion} to
 * @returns {number} radians, -pi to pi
 */
export function turnBetween(from, to) {
    const q = multiplied(to, {x: -from.x, y: -from.y, z: -from.z, w: from.w});
    const angle = 2 * Math.atan2(q.y, q.w);
    return Math.atan2(Math.sin(angle), Math.cos(angle));
}

/** Places that are the same but for rounding. */
const SAME = {metres: 1e-4, radians: 1e-4, share: 1e-4};

/**
 * What somebody has done to an object.
 *
 * @param {Required<Transform>} from
 * @param {Required<Transform>} to
 * @param {Required<Transform>} original  as it was loaded
 * @returns {'move' | 'turn' | 'resize' | 'put back'}
 */
export function deedOf(from, to, original) {
    const turned = (/** @type {Required<Transform>} */ a, /** @type {Required<Transform>} */ b) => {
        const {rotation: p} = a;
        const {rotation: q} = b;
        // The sign of a quaternion means nothing.
        return Math.abs(p.x * q.x + p.y * q.y + p.z * q.z + p.w * q.w) < Math.cos(SAME.radians / 2);
    };
    const resized = (/** @type {Required<Transform>} */ a, /** @type {Required<Transform>} */ b) =>
        length(sub(a.scale, b.scale)) > SAME.share * length(a.scale);
    const shifted = length(sub(to.translation, original.translation)) > SAME.metres;
    if (!shifted && !turned(to, original) && !resized(to, original)) {
        return 'put back';
    }
    if (resized(from, to)) {
        return 'resize';
    }
    return turned(from, to) ? 'turn' : 'move';
}
