// SPDX-License-Identifier: Apache-2.0
// Colours: sRGB and linear Rec. 709, colour temperature, the false-colour map.

import {clamp, vec3} from '../ui/vector.js';

/** @typedef {import('../net/scene_types.js').Vec3} Vec3 */

/** @type {(c: Vec3) => number} */
export const luminance = (c) => 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z;

/** @type {(value: number) => number} */
const encode = (value) =>
    value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055;
/** @type {(value: number) => number} */
const decode = (value) => (value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4);

/**
 * @param {string} hex  "#rrggbb", sRGB
 * @returns {Vec3} linear
 */
export function fromHex(hex) {
    const at = (/** @type {number} */ i) => decode(parseInt(hex.slice(i, i + 2), 16) / 255);
    return vec3(at(1), at(3), at(5));
}

/**
 * @param {Vec3} colour  linear; brought to at most 1
 * @returns {string} "#rrggbb", sRGB
 */
export function toHex(colour) {
    const top = Math.max(colour.x, colour.y, colour.z, 1);
    const digits = [colour.x, colour.y, colour.z].map((value) =>
        Math.round(255 * encode(clamp(value / top, 0, 1)))
            .toString(16)
            .padStart(2, '0'),
    );
    return `#${digits.join('')}`;
}

/**
 * Colour of a black body (Kim et al. 2002, cubic fit of the Planckian locus in CIE 1931 x, y; 1667 to
 * 25000 K), as linear Rec. 709 of luminance 1.
 *
 * @param {number} kelvin
 * @returns {Vec3}
 */
export function blackBody(kelvin) {
    const t = 1000 / clamp(kelvin, 1667, 25000);
    const x =
        kelvin <= 4000
            ? ((-0.2661239 * t - 0.234358) * t + 0.8776956) * t + 0.17991
            : ((-3.0258469 * t + 2.1070379) * t + 0.2226347) * t + 0.24039;
    const y =
        kelvin <= 2222
            ? ((-1.1063814 * x - 1.3481102) * x + 2.18555832) * x - 0.20219683
            : kelvin <= 4000
              ? ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867
              : ((3.081758 * x - 5.8733867) * x + 3.75112997) * x - 0.37001483;
    const [X, Z] = [x / y, (1 - x - y) / y];
    const rgb = vec3(
        3.2404542 * X - 1.5371385 - 0.4985314 * Z,
        -0.969266 * X + 1.8760108 + 0.041556 * Z,
        0.0556434 * X - 0.2040259 + 1.0572252 * Z,
    );
    const inside = vec3(Math.max(rgb.x, 0), Math.max(rgb.y, 0), Math.max(rgb.z, 0));
    const level = luminance(inside);
    return vec3(inside.x / level, inside.y / level, inside.z / level);
}

/**
 * Colour temperature nearest to a colour, by the ratio of blue to red.
 *
 * @param {Vec3} colour  linear
 * @returns {number} kelvin, to 50
 */
export function temperatureOf(colour) {
    const wanted = colour.z / Math.max(colour.x, 1e-6);
    let [low, high] = [1700, 12000];
    for (let i = 0; i < 24; ++i) {
        const middle = (low + high) / 2;
        const {x, z} = blackBody(middle);
        if (z / x < wanted) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return Math.round(low / 50) * 50;
}

/** Decades that the colour scale covers below its upper end. */
export const SCALE_DECADES = 3;

const TURBO = [
    [0.13572138, 4.6153926, -42.66032258, 132.13108234, -152.94239396, 59.28637943],
    [0.09140261, 2.19418839, 4.84296658, -14.18503333, 4.27729857, 2.82956604],
    [0.1066733, 12.64194608, -60.58204836, 110.36276771, -89.90310912, 27.34824973],
];

/**
 * Polynomial fit of the map "turbo" (A. Mikhailov 2019), as the server draws it.
 *
 * @param {number} x  0..1
 * @returns {number[]} red, green, blue, 0..255
 */
export const turboColour = (x) =>
    TURBO.map((c) => {
        const value = c.reduceRight((sum, factor) => sum * x + factor, 0);
        return Math.round(255 * clamp(value, 0, 1));
    });

/**
 * @param {number} x  0..1
 * @returns {string} CSS colour
 */
export const turbo = (x) => `rgb(${turboColour(x).join(' ')})`;

/**
 * Where a value lies on the scale.
 *
 * @param {number} value
 * @param {number} maximum  upper end
 * @param {boolean} linear  the scale begins at 0
 * @returns {number} 0..1
 */
export function onScale(value, maximum, linear = false) {
    const at = linear ? value / maximum : 1 + Math.log10(Math.max(value, 1e-20) / maximum) / SCALE_DECADES;
    return clamp(at, 0, 1);
}

/**
 * The value at a place of the scale.
 *
 * @param {number} at  0..1
 * @param {number} maximum  upper end
 * @param {boolean} linear  the scale begins at 0
 */
export const valueOnScale = (at, maximum, linear) =>
    linear ? at * maximum : maximum * 10 ** (SCALE_DECADES * (at - 1));

/**
 * Colour of a value as the server draws it: white above the scale, black below.
 *
 * @param {number} value
 * @param {number} maximum  upper end
 * @param {boolean} linear
 * @returns {string} CSS colour
 */
export function scaleColour(value, maximum, linear) {
    const begin = linear ? 0 : maximum * 10 ** -SCALE_DECADES;
    return value > maximum ? '#fff' : value < begin ? '#000' : turbo(onScale(value, maximum, linear));
}
