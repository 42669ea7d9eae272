// SPDX-License-Identifier: Apache-2.0
// Pure maths of a work plane: where it lies, and how its numbers read.

import {inUnit, threeDigits} from '../ui/units.js';
import {vec3} from '../ui/vector.js';

/**
 * @typedef {import('../net/scene_types.js').Bounds} Bounds
 * @typedef {import('../net/measure_types.js').Measured} Measured
 * @typedef {import('../net/scene_types.js').Vec3} Vec3
 */

/** Direct light of lamps without extent is known but for rounding. */
const EXACT = 1e-6;

/**
 * A horizontal area over some bounds.
 *
 * @param {Bounds} bounds  world space
 * @param {number} floor  height that `height` counts from, metres
 * @param {number} height  metres
 * @returns {{origin: Vec3, u: Vec3, v: Vec3}}
 */
export const areaOver = ({min, max}, floor, height) => ({
    origin: vec3(min.x, floor + height, min.z),
    u: vec3(max.x - min.x, 0, 0),
    v: vec3(0, 0, max.z - min.z),
});

/**
 * Corners of a level outline above places on a floor.
 *
 * @param {readonly Vec3[]} corners
 * @param {number} floor  metres
 * @param {number} height  above it, metres
 */
export const outlineOver = (corners, floor, height) => corners.map(({x, z}) => vec3(x, floor + height, z));

/**
 * A number with its 95 % interval.
 *
 * @param {number | undefined} value
 * @param {number | undefined} low
 * @param {number | undefined} high
 * @param {(number: number) => string} text
 */
export function withInterval(value, low, high, text) {
    if (value === undefined) {
        return {value: '–', interval: ''};
    }
    const known = low !== undefined && high !== undefined;
    return {value: text(value), interval: known ? `${text(low)} to ${text(high)}` : ''};
}

/**
 * Text of a value of a quantity.
 *
 * @param {string} quantity
 * @param {'lx' | 'fc'} unit  that illuminances are shown in
 * @returns {(value: number) => string}
 */
export function valueText(quantity, unit) {
    if (quantity === 'UGR' || quantity === 'DGP') {
        return (value) => value.toFixed(quantity === 'UGR' ? 1 : 2);
    }
    return quantity === 'DAYLIGHT_FACTOR'
        ? (value) => `${threeDigits(value)} %`
        : (value) => `${threeDigits(inUnit(value, unit))} ${unit}`;
}

/** @param {number} inside  points in solids */
const leftOut = (inside) => (inside === 1 ? ' 1 lies in a solid and is left out.' : inside > 0 ? ` ${inside} lie in solids and are left out.` : '');

/**
 * Of light that has been reflected something comes everywhere in a building: what is black is mostly outside.
 *
 * @param {number} dark  points
 */
const inTheDark = (dark) =>
    dark > 0 ? ` ${dark} ${dark === 1 ? 'is' : 'are'} dark and counted: if ${dark === 1 ? 'it lies' : 'they lie'} outside of the rooms, measure within points on the floor.` : '';

/**
 * What the numbers stand for.
 *
 * @param {Measured} result
 */
export function planeState({points, columns, rows, spacing, factor, maintained, direct, relativeError, quantity, mean}) {
    const count = points.length === columns * rows ? `${columns} × ${rows}` : String(points.length);
    const parts = [`${count} points`];
    if (spacing) {
        parts.push(`at most ${spacing.toFixed(2)} m apart, as EN 12464-1 asks for`);
    }
    if (points.length > 0) {
        parts.push(`at y = ${points[0].position.y.toFixed(2)} m`);
    }
    const lit = !direct && quantity !== 'UGR' && mean !== undefined && mean > 0;
    const left = leftOut(points.filter((point) => point.inside).length) +
        inTheDark(lit ? points.filter(({inside, value}) => !inside && value === 0).length : 0);
    const own = maintained ? ' Maintained, by the factor of each lamp.' : '';
    const kept = factor === 1 ? own : ` Maintained: times ${factor}.`;
    const error = relativeError === undefined || relativeError > 1
        ? ' The values are still uncertain.'
        : relativeError < EXACT
          ? ' The values are exact.'
          : ` Values are known within ${threeDigits(100 * relativeError)} % of the mean.`;
    return `${parts.join(', ')}.${left}${direct ? ' Direct light only.' : ''}${kept}${error}`;
}

/** @param {Measured} result @param {string} unit  of the values @returns {string} */
export function planeCsv({points}, unit) {
    const cell = (/** @type {number | undefined} */ value) => (value === undefined ? '' : String(Number(value.toPrecision(6))));
    const rows = points.map(({position: {x, y, z}, value, low, high, inside}) =>
        [x.toFixed(4), y.toFixed(4), z.toFixed(4), cell(value), cell(low), cell(high), inside ? 'in a solid' : ''].join(','));
    return `x (m),y (m),z (m),value (${unit}),95 % from (${unit}),95 % to (${unit}),note\n${rows.join('\n')}\n`;
}
