// SPDX-License-Identifier: Apache-2.0
// What shines of luminaires, as the page draws it: a flat plate each, as bright everywhere as where its file sends most.

import {add, cross, dot, length, normalise, scale, vec3} from '../ui/vector.js';

/**
 * @typedef {import('../net/scene_types.js').Light} Light
 * @typedef {import('../net/scene_types.js').Vec3} Vec3
 *
 * @typedef {{x: number, y: number, round: boolean}} Opening  metres along x and y of the luminaire's axes
 *
 * @typedef {object} Plate
 * @property {Vec3} middle  metres
 * @property {Vec3} halfX  half of its sides
 * @property {Vec3} halfY
 * @property {Vec3} aim  unit, to the side that shines
 * @property {boolean} round
 * @property {[number, number, number]} radiance  cd/m²
 */

const DOWN = Object.freeze(vec3(0, -1, 0));
const X = Object.freeze(vec3(1, 0, 0));

/**
 * The x axis of a light at rotation 0, as the server has it: +x, turned the shortest way from straight down to the aim.
 *
 * @param {Vec3} aim  unit
 */
function unrotatedX(aim) {
    const cosine = dot(DOWN, aim);
    const axis = cross(DOWN, aim);
    return cosine > -1 + 1e-6
        ? add(add(scale(X, cosine), cross(axis, X)), scale(axis, dot(axis, X) / (1 + cosine)))
        : X;
}

/**
 * @param {Light[]} lights
 * @param {Map<string, Opening>} openings  by names of photometric files
 * @returns {Plate[]}
 */
export function platesOf(lights, openings) {
    return lights.flatMap((light) => {
        const {photometry = '', position, aim, rotation = 0, peak = 0, loadedIntensity = 0, intensity, dim = 1, on, colour} = light;
        const opening = openings.get(photometry);
        if (!opening || !position || !aim || length(aim) === 0 || !(opening.x * opening.y > 0)) {
            return [];
        }
        const forward = normalise(aim);
        const turn = rotation * Math.PI / 180;
        const x0 = unrotatedX(forward);
        const x = add(scale(x0, Math.cos(turn)), scale(cross(forward, x0), Math.sin(turn)));
        const y = cross(scale(forward, -1), x);
        const area = opening.x * opening.y * (opening.round ? Math.PI / 4 : 1);
        const candela = on && loadedIntensity > 0 ? peak * dim * intensity / loadedIntensity : 0;
        const luminance = candela / area;
        return [{
            middle: position,
            halfX: scale(x, opening.x / 2),
            halfY: scale(y, opening.y / 2),
            aim: forward,
            round: opening.round,
            radiance: /** @type {[number, number, number]} */ ([colour.x * luminance, colour.y * luminance, colour.z * luminance]),
        }];
    });
}

/** Sizes of what shines, by names of photometric files; the server is asked once for each name that is new. */
export class Openings {
    /** @type {Map<string, Opening>} */
    known = new Map();
    /** @type {Set<string>} */
    #asked = new Set();

    /**
     * @param {Light[]} lights
     * @param {() => Record<string, string>} headers  of requests
     * @returns {Promise<boolean>}  whether more is known now
     */
    async lookUp(lights, headers) {
        const names = lights.flatMap(({photometry}) => (photometry && !this.#asked.has(photometry) ? [photometry] : []));
        if (names.length === 0) {
            return false;
        }
        names.forEach((name) => this.#asked.add(name));
        try {
            const answer = await fetch(new URL('photometry', location.href), {headers: headers()});
            /** @type {{name: string, opening?: Opening}[]} */
            const files = answer.ok ? await answer.json() : [];
            for (const {name, opening} of files) {
                if (opening) {
                    this.known.set(name, opening);
                }
            }
        } catch {
            return false;  // they are not drawn
        }
        return true;
    }
}
