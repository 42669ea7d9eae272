// SPDX-License-Identifier: Apache-2.0
// Pure maths of a measuring grid: where its points lie on a surface, and what they say together.

import {NOT_YET, inUnit, noteOf, plusMinusCell} from '../ui/units.js';
import {add, clamp, cross, dot, normalise, scale, sub, vec3} from '../ui/vector.js';

/**
 * @typedef {import('../net/scene_types.js').Vec3} Vec3
 * @typedef {import('../net/scene_types.js').Bounds} Bounds
 * @typedef {import('../net/measure_types.js').ProbeGridResult} ProbeGridResult
 * @typedef {object} Grid
 * @property {Vec3} origin  first point, world space, metres
 * @property {Vec3} stepX
 * @property {Vec3} stepY
 * @property {number} columns
 * @property {number} rows
 * @typedef {object} GridSummary
 * @property {number} measured  points that were
 * @property {number} minimum  lx
 * @property {number} mean
 * @property {number} maximum
 * @property {number} uniformity  minimum over mean
 */

/** As many points does the server measure at once. */
export const MAX_POINTS = 1024;
/** Patches of a surface of this reach around the point are measured at most, metres. */
const REACH = 10;

/**
 * Largest step that EN 12464-1 allows for a surface, 0.2 * 5^log10(d), at most 10 m.
 *
 * @param {number} side  d, the longer one of the surface, metres
 * @returns {number} metres
 */
export const standardStep = (side) => Math.min(0.2 * 5 ** Math.log10(Math.max(side, 1e-3)), 10);

/**
 * A grid on the surface under a point, as far as the object's bounds reach. Points lie in the middle
 * of equal cells, at most `step` apart.
 *
 * @param {Vec3} point
 * @param {Vec3} normal  of the surface, of length 1
 * @param {Bounds} bounds  of the object, world space
 * @param {number} step  metres; 0: as EN 12464-1 has it
 * @returns {Grid}
 */
export function gridOn(point, normal, bounds, step) {
    const upright = Math.abs(normal.y) > 0.9;
    const across = normalise(cross(upright ? vec3(0, 0, 1) : vec3(0, 1, 0), normal));
    const along = cross(normal, across);
    const reach = (/** @type {Vec3} */ axis) => {
        // How far from the point the bounds go, along an axis.
        let [low, high] = [0, 0];
        for (let i = 0; i < 8; ++i) {
            const corner = vec3(
                i & 1 ? bounds.max.x : bounds.min.x,
                i & 2 ? bounds.max.y : bounds.min.y,
                i & 4 ? bounds.max.z : bounds.min.z,
            );
            const at = dot(sub(corner, point), axis);
            low = Math.min(low, at);
            high = Math.max(high, at);
        }
        return [clamp(low, -REACH, 0), clamp(high, 0, REACH)];
    };
    const [left, right] = reach(across);
    const [near, far] = reach(along);
    const [width, height] = [Math.max(right - left, 0.01), Math.max(far - near, 0.01)];
    let wanted = step > 0 ? step : standardStep(Math.max(width, height));
    const cells = (/** @type {number} */ side) => Math.max(Math.ceil(side / wanted - 1e-6), 1);
    while (cells(width) * cells(height) > MAX_POINTS) {
        wanted *= 1.1;
    }
    const [columns, rows] = [cells(width), cells(height)];
    const stepX = scale(across, width / columns);
    const stepY = scale(along, height / rows);
    const corner = add(point, add(scale(across, left), scale(along, near)));
    const origin = add(corner, scale(add(stepX, stepY), 0.5));
    return {origin, stepX, stepY, columns, rows};
}

/**
 * @param {Grid} grid
 * @returns {Vec3[]} row by row
 */
export function pointsOf({origin, stepX, stepY, columns, rows}) {
    return Array.from({length: columns * rows}, (_, i) =>
        add(origin, add(scale(stepX, i % columns), scale(stepY, Math.floor(i / columns)))),
    );
}

/**
 * A grid that lies on something that has moved.
 *
 * @param {Grid} grid
 * @param {(point: Vec3) => Vec3} carry  affine
 * @returns {Grid}
 */
export function carriedGrid(grid, carry) {
    const origin = carry(grid.origin);
    const step = (/** @type {Vec3} */ way) => sub(carry(add(grid.origin, way)), origin);
    return {...grid, origin, stepX: step(grid.stepX), stepY: step(grid.stepY)};
}

/**
 * A grid measured again: what only the measurement before has seen, is kept while nothing has changed.
 *
 * @param {ProbeGridResult} before
 * @param {ProbeGridResult} now
 * @returns {ProbeGridResult | null}  null: it is out of sight
 */
export function measuredAgain(before, now) {
    if (now.illuminance.every((value) => value < 0)) {
        return null;
    }
    if (now.epoch !== before.epoch) {
        return now;
    }
    const seen = now.illuminance.map((value) => value >= 0);
    const kept = (/** @type {number[]} */ values, /** @type {number[]} */ others) =>
        values.map((value, i) => (seen[i] ? value : others[i]));
    return {
        illuminance: kept(now.illuminance, before.illuminance),
        relativeError: kept(now.relativeError, before.relativeError),
        epoch: now.epoch,
    };
}

/**
 * @param {number[]} illuminance  lx; negative: not measured
 * @returns {GridSummary | null}  null: nothing was measured
 */
export function summaryOf(illuminance) {
    const values = illuminance.filter((value) => value >= 0);
    if (values.length === 0) {
        return null;
    }
    const mean = values.reduce((sum, value) => sum + value, 0) / values.length;
    const minimum = Math.min(...values);
    const maximum = Math.max(...values);
    const uniformity = mean > 0 ? minimum / mean : 1;
    return {measured: values.length, minimum, mean, maximum, uniformity};
}

/**
 * @typedef {object} Interval
 * @property {number} low
 * @property {number} high
 * @typedef {object} GridIntervals
 * @property {number} meanError  relative standard error of the mean
 * @property {Interval} mean  lx
 * @property {Interval} uniformity
 */

/**
 * 95 % intervals of what the points of a grid say together. Their errors are taken to be common, so that the
 * mean is not known better than its points. The smallest of many values that each are off by chance lies
 * below the smallest true one: the minimum is at least what all points together exceed in 95 % of cases, by
 * P(Z > z) <= exp(-z^2 / 2) / 2, and at most what the lowest point can have.
 *
 * @param {number[]} illuminance  lx; negative: not measured
 * @param {number[]} relativeError  standard errors; negative: not known
 * @returns {GridIntervals | null}  null: some point's error is not known, or nothing is lit
 */
export function intervalsOf(illuminance, relativeError) {
    const points = illuminance
        .map((value, i) => ({value, error: relativeError[i] * value}))
        .filter(({value}) => value >= 0);
    const sum = points.reduce((all, {value}) => all + value, 0);
    if (!(sum > 0) || points.some(({value, error}) => !(error >= 0) && value > 0)) {
        return null;
    }
    const alone = 1.96;
    const together = Math.max(alone, Math.sqrt(2 * Math.log((0.5 * points.length) / 0.025)));
    const errors = points.reduce((all, {error}) => all + Math.max(error, 0), 0);
    const mean = sum / points.length;
    const half = (alone * errors) / points.length;
    const least = (/** @type {number} */ deviations) =>
        Math.max(Math.min(...points.map(({value, error}) => value + deviations * Math.max(error, 0))), 0);
    return {
        meanError: errors / sum,
        mean: {low: Math.max(mean - half, 0), high: mean + half},
        uniformity: {low: least(-together) / mean, high: Math.min(least(alone) / mean, 1)},
    };
}

/**
 * @param {Grid} grid
 * @param {ProbeGridResult} result
 * @param {import('../ui/units.js').IlluminanceUnit} unit
 * @returns {string} table with a head, points that were not measured left empty
 */
export function gridCsv(grid, {illuminance, relativeError, epoch}, unit = 'lx') {
    const lines = [`row,column,x_m,y_m,z_m,illuminance_${unit},plus_minus_95_percent,after_change,note`];
    pointsOf(grid).forEach(({x, y, z}, i) => {
        const at = [Math.floor(i / grid.columns) + 1, (i % grid.columns) + 1];
        const place = [x, y, z].map((value) => value.toFixed(4));
        const value = illuminance[i] >= 0 ? inUnit(illuminance[i], unit).toPrecision(6) : '';
        const error = plusMinusCell(relativeError[i]);
        const note = illuminance[i] >= 0 ? noteOf(relativeError[i]) : 'not in view';
        lines.push([...at, ...place, value, error, epoch, note].join(','));
    });
    return `${lines.join('\r\n')}\r\n`;
}

/**
 * Text that is safe in one cell of a CSV file.
 *
 * @param {string} text
 */
export function csvCell(text) {
    // A spreadsheet must not take what somebody typed for a formula.
    const harmless = /^[=+\-@\t\r]/.test(text) ? `'${text}` : text;
    return /[",\r\n]/.test(harmless) ? `"${harmless.replaceAll('"', '""')}"` : harmless;
}

/** @typedef {{position: Vec3, normal: Vec3}} Hit */

/** Hits are on one plane where they are no further apart, along their normal, metres. */
const SAME_PLANE = 0.02;

/**
 * The largest face of an object, judged by where it was met: one that looks upwards, if there is any.
 *
 * @template {Hit} T
 * @param {T[]} hits
 * @returns {T | null} one of that face
 */
export function mainFace(hits) {
    const sizeOf = (/** @type {Hit} */ {position, normal}) =>
        hits.filter(
            (other) =>
                dot(other.normal, normal) > 0.99 &&
                Math.abs(dot(sub(other.position, position), normal)) < SAME_PLANE,
        ).length;
    const ranked = hits.map((hit) => {
        const upwards = faceName(hit.normal) === 'upper side';
        return {hit, rank: sizeOf(hit) + (upwards ? hits.length : 0)};
    });
    return ranked.sort((a, b) => b.rank - a.rank)[0]?.hit ?? null;
}

/**
 * @param {Vec3} normal
 * @returns {string} for people
 */
export const faceName = ({y}) => (y > 0.9 ? 'upper side' : y < -0.9 ? 'underside' : 'side');

/**
 * Points spread evenly over the part of the picture that an object may cover.
 *
 * @param {{x: number, y: number, depth: number}[]} corners  of the object's bounds, CSS pixels
 * @param {number} width  of the picture, CSS pixels
 * @param {number} height
 * @param {number} perSide
 * @returns {{x: number, y: number}[]} none where it covers nothing
 */
export function spreadOver(corners, width, height, perSide) {
    // Bounds that reach behind the eye may cover all.
    const around = corners.some(({depth}) => depth <= 0);
    const [xs, ys] = [corners.map(({x}) => x), corners.map(({y}) => y)];
    const left = around ? 0 : Math.max(Math.min(...xs), 0);
    const right = around ? width : Math.min(Math.max(...xs), width);
    const top = around ? 0 : Math.max(Math.min(...ys), 0);
    const bottom = around ? height : Math.min(Math.max(...ys), height);
    if (left >= right || top >= bottom) {
        return [];
    }
    return Array.from({length: perSide * perSide}, (_, i) => ({
        x: left + ((right - left) * ((i % perSide) + 0.5)) / perSide,
        y: top + ((bottom - top) * (Math.floor(i / perSide) + 0.5)) / perSide,
    }));
}

/**
 * What the points of a grid are typically known to.
 *
 * @param {number[]} relativeErrors  standard errors; -1: not known
 * @returns {number | null} their median; null: none is known
 */
export function typicalError(relativeErrors) {
    const known = relativeErrors.filter((error) => error >= 0).sort((a, b) => a - b);
    return known.length > 0 ? known[known.length >> 1] : null;
}

/**
 * Uniformity for people.
 *
 * @param {GridSummary} summary
 * @param {GridIntervals | null} intervals
 * @returns {string} says so where it is not known: the minimum may be nothing, or errors are not known
 */
export const uniformityText = (summary, intervals) =>
    intervals && (intervals.uniformity.low > 0 || summary.minimum === 0) ? summary.uniformity.toFixed(2) : NOT_YET;
