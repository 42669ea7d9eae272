// SPDX-License-Identifier: Apache-2.0
// What people know of a light, and what the controls of its card make of it. Knows no page.

import {threeDigits} from '../ui/units.js';

/** @typedef {import('../net/scene_types.js').Light} Light */

/** A dimmer's lowest step, as a share of the light as loaded; below it, it is off. */
const DIMMEST = 0.01;
/** A dimmer's highest step. */
const BRIGHTEST = 4;
/** Kinds of lights that are no lamps: the sky and its suns. */
const OUTSIDE = ['SKY', 'ENVIRONMENT', 'DIRECTIONAL'];

/**
 * Whether a light is a lamp, which the sky and its suns are not.
 *
 * @param {{kind: string}} light
 */
export const isLamp = ({kind}) => !OUTSIDE.includes(kind);

/**
 * Position of a logarithmic dimmer.
 *
 * @param {number} share  of the light as loaded
 * @returns {number} 0..1
 */
export function dimmerPosition(share) {
    const position = Math.log(Math.max(share, DIMMEST) / DIMMEST) / Math.log(BRIGHTEST / DIMMEST);
    return Math.min(Math.max(position, 0), 1);
}

/**
 * What people know a light by, beside the intensity that can be set.
 *
 * @param {Light} light
 * @returns {string} empty where nothing is known
 */
export function lightFigures(light) {
    const share = (light.dim ?? 1) * (light.loadedIntensity ? light.intensity / light.loadedIntensity : 1);
    const parts = [];
    if (light.flux && light.unit !== 'LM') {
        parts.push(`${threeDigits(share * light.flux)} lm`);
    }
    if (light.peak && light.unit !== 'CD') {
        parts.push(`at most ${threeDigits(share * light.peak)} cd`);
    }
    if (light.watts) {
        parts.push(`${Number(light.watts.toPrecision(3))} W`);
    }
    return parts.join(' · ');
}

/** @type {(position: number) => number} */
export const dimmerShare = (position) => DIMMEST * (BRIGHTEST / DIMMEST) ** position;

/**
 * What is wrong with an intensity that somebody has typed.
 *
 * @param {number} value  not a number: nothing, or no number
 * @returns {string} empty: nothing
 */
export function intensityProblem(value) {
    if (!Number.isFinite(value)) {
        return 'Enter a number.';
    }
    return value < 0 ? 'Enter 0 or more.' : '';
}

/** @typedef {{intensity: number, colour: import('../net/scene_types.js').Vec3}} LoadedLight */

/**
 * What the scene file gives a light; of servers that do not tell, what it has now.
 *
 * @param {Light} light
 * @returns {LoadedLight}
 */
export const loadedLight = ({intensity, colour, loadedIntensity, loadedColour}) => ({
    intensity: loadedIntensity ?? intensity,
    colour: loadedColour ?? colour,
});

/** Relative difference that numbers may have that went through texts. */
const SAME = 1e-3;

/**
 * Whether a light is on, and as the file has it.
 *
 * @param {Light} light
 * @param {LoadedLight} loaded
 */
export function sameLight(light, loaded) {
    const near = (/** @type {number} */ a, /** @type {number} */ b) => Math.abs(a - b) <= SAME * Math.max(a, b);
    const {colour} = light;
    return (
        light.on &&
        (light.dim ?? 1) === 1 &&
        near(light.intensity, loaded.intensity) &&
        near(colour.x, loaded.colour.x) &&
        near(colour.y, loaded.colour.y) &&
        near(colour.z, loaded.colour.z)
    );
}

/**
 * What is to be known of a scene without a lamp of its own.
 *
 * @param {Light[]} lights
 * @returns {string} empty: it has some
 */
export function lampless(lights) {
    if (lights.some(isLamp)) {
        return '';
    }
    return lights.length === 0
        ? 'Nothing in the file emits light, and there is no sky: all is dark.'
        : 'The file has no lamps: the scene has daylight alone. Where nothing else is said, the server adds a uniform sky.';
}
