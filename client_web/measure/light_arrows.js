// SPDX-License-Identifier: Apache-2.0
// Maths of the light vector at calculation points: where light comes from on balance, and how much more comes from there
// than from the other side. Its component along an axis is the difference of the illuminances of two planes that face
// along it and against it.

import {add, length, scale, sub, vec3} from '../ui/vector.js';

/**
 * @typedef {import('../net/scene_types.js').Vec3} Vec3
 * @typedef {import('../net/measure_types.js').Measured} Measured
 * @typedef {{from: Vec3, to: Vec3, lux: number}} Arrow  to: the calculation point, which light flows to; world space
 */

/** Planes that face along each axis and against it. */
const NORMALS = [vec3(1, 0, 0), vec3(-1, 0, 0), vec3(0, 1, 0), vec3(0, -1, 0), vec3(0, 0, 1), vec3(0, 0, -1)];
/** Of a measurement, over six planes. */
const MOST_POINTS = Math.floor(4096 / NORMALS.length);
/** The longest arrow, in distances of neighbouring points. */
const LONGEST = 1.2;

/**
 * Calculation points of areas, without those in solids; evenly fewer where there are too many.
 *
 * @param {Measured[]} areas
 * @returns {Vec3[]}
 */
export function arrowPoints(areas) {
    const all = areas.flatMap(({points}) => points.filter(({inside}) => !inside).map(({position}) => position));
    const step = Math.max(all.length / MOST_POINTS, 1);
    return all.filter((_, i) => Math.floor(i / step) !== Math.floor((i - 1) / step));
}

/**
 * What asks for the light vectors at points.
 *
 * @param {Vec3[]} points
 */
export const arrowRequest = (points) => ({
    quantity: 'NORMAL',
    points: points.flatMap((position) => NORMALS.map((normal) => ({position, normal}))),
    relativeError: 0.1,
    keep: true,
});

/**
 * Light vectors of the answer, lx: they point to where light comes from.
 *
 * @param {Measured} measured
 * @returns {{position: Vec3, vector: Vec3}[]}
 */
export function lightVectors({points}) {
    const vectors = [];
    for (let i = 0; i + NORMALS.length <= points.length; i += NORMALS.length) {
        const six = points.slice(i, i + NORMALS.length);
        if (six.every(({value}) => value !== undefined)) {
            const vector = six.reduce((sum, {value}, k) => add(sum, scale(NORMALS[k], value ?? 0)), vec3(0, 0, 0));
            vectors.push({position: six[0].position, vector});
        }
    }
    return vectors;
}

/** Median distance of points to the next one. @param {Vec3[]} points */
function spacingOf(points) {
    const nearest = points.map((point) => points.reduce((least, other) => {
        const distance = length(sub(point, other));
        return distance > 1e-6 ? Math.min(least, distance) : least;
    }, Infinity)).sort((a, b) => a - b);
    const middle = nearest[Math.floor(nearest.length / 2)] ?? Infinity;
    return Number.isFinite(middle) ? middle : 0.5;
}

/**
 * Arrows whose lengths are in proportion to the vectors.
 *
 * @param {Measured} measured
 * @returns {{arrows: Arrow[], most: number}}  most: lx of the longest one
 */
export function lightArrows(measured) {
    const vectors = lightVectors(measured);
    const most = Math.max(0, ...vectors.map(({vector}) => length(vector)));
    const metres = LONGEST * spacingOf(vectors.map(({position}) => position)) / (most || 1);
    const arrows = vectors.map(({position, vector}) => ({from: add(position, scale(vector, metres)), to: position, lux: length(vector)}));
    return {arrows, most};
}

/**
 * An arrow in the picture: its shaft and its head.
 *
 * @param {{x: number, y: number}} from  CSS pixels
 * @param {{x: number, y: number}} to
 * @returns {string} SVG path; empty: too short to have a direction
 */
export function arrowPath(from, to) {
    const [dx, dy] = [to.x - from.x, to.y - from.y];
    const size = Math.hypot(dx, dy);
    if (size < 2) {
        return '';
    }
    const head = Math.min(7, 0.4 * size);
    const [ux, uy] = [dx / size, dy / size];
    const side = (/** @type {number} */ way) =>
        `${(to.x - head * ux - way * 0.45 * head * uy).toFixed(1)} ${(to.y - head * uy + way * 0.45 * head * ux).toFixed(1)}`;
    const tip = `${to.x.toFixed(1)} ${to.y.toFixed(1)}`;
    return `M${from.x.toFixed(1)} ${from.y.toFixed(1)}L${tip}M${side(1)}L${tip}L${side(-1)}`;
}
