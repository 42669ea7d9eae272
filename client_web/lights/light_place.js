// SPDX-License-Identifier: Apache-2.0
// Where lights are aimed, in the angles that people set. Knows no page.

import {length, sub, vec3} from '../ui/vector.js';

/** @typedef {import('../net/scene_types.js').Vec3} Vec3 */

const DEGREE = Math.PI / 180;

/**
 * Angles of an aim, degrees. tilt: from straight down, 0..180; heading: as on a compass whose north is -z, 0..360, and
 * 0 of what is aimed straight up or down.
 *
 * @param {Vec3} aim  of any length
 */
export function anglesOf(aim) {
    const across = Math.hypot(aim.x, aim.z);
    const steep = across < 1e-6 * length(aim);
    return {
        tilt: Math.atan2(across, -aim.y) / DEGREE,
        heading: steep ? 0 : (Math.atan2(aim.x, -aim.z) / DEGREE + 360) % 360,
    };
}

/**
 * @param {{tilt: number, heading: number}} angles  degrees
 * @returns {Vec3} of length 1
 */
export function aimOf({tilt, heading}) {
    const across = Math.sin(tilt * DEGREE);
    return vec3(
        across * Math.sin(heading * DEGREE),
        -Math.cos(tilt * DEGREE),
        -across * Math.cos(heading * DEGREE),
    );
}

/**
 * From a light to a point that it shall shine at.
 *
 * @param {Vec3} position
 * @param {Vec3} point
 * @returns {Vec3 | null} null: it is there already
 */
export function aimAt(position, point) {
    const way = sub(point, position);
    return length(way) > 1e-3 ? way : null;
}
