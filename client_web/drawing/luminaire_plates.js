// SPDX-License-Identifier: Apache-2.0
// What shines of luminaires, as the page draws it: a flat plate each, as bright everywhere as where its file sends most.

import {add, cross, dot, length, mix, normalise, scale, vec3} from '../ui/vector.js';

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

/** The server reads some files of a large folder for each list. */
const NOT_READ = 'not read yet: ask again';
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

/**
 * What a light sends, in its unit; linear RGB.
 *
 * @param {{intensity?: number, dim?: number, on?: boolean, colour?: Vec3}} light
 * @returns {Vec3}
 */
const outputOf = ({intensity = 0, dim = 1, on = true, colour = vec3(1, 1, 1)}) => scale(colour, on ? intensity * dim : 0);

/** Lights on their way to what they are set to, as the server shows them: linearly in RGB. */
export class PlateFades {
    /** By Light.id. Times in ms. @type {Map<number, {from: Vec3, begun: number, until: number}>} */
    #fades = new Map();

    /** Whether any light is on its way. @param {number} now */
    running(now) {
        return [...this.#fades.values()].some(({until}) => now < until);
    }

    /**
     * The newest setting of a light wins; it begins where the light is shown.
     *
     * @param {import('../net/scene_types.js').SceneChanged} change
     * @param {Light | undefined} light  that it changes, before or after
     * @param {number} now
     */
    take({setLight, lightBefore}, light, now) {
        if (!setLight) {
            return;
        }
        const {light: id, fadeSeconds = 0} = setLight;
        const shown = this.#fades.get(id);
        this.#fades.delete(id);
        if (fadeSeconds > 0 && light && lightBefore) {
            const before = outputOf({...light, ...lightBefore});
            const from = shown && now < shown.until ? mix(shown.from, before, (now - shown.begun) / (shown.until - shown.begun)) : before;
            this.#fades.set(id, {from, begun: now, until: now + 1000 * fadeSeconds});
        }
    }

    /**
     * Lights as they are shown now.
     *
     * @param {Light[]} lights
     * @param {number} now
     */
    shown(lights, now) {
        return lights.map((light) => {
            const fade = this.#fades.get(light.id);
            return fade && now < fade.until
                ? {...light, on: true, dim: 1, intensity: 1, colour: mix(fade.from, outputOf(light), (now - fade.begun) / (fade.until - fade.begun))}
                : light;
        });
    }
}

/** Sizes of what shines, by names of photometric files; the server is asked for each name that is new until it knows it. */
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
            /** @type {{name: string, opening?: Opening, problems?: string[]}[]} */
            const files = answer.ok ? await answer.json() : [];
            for (const {name, opening, problems = []} of files) {
                if (opening) {
                    this.known.set(name, opening);
                } else if (problems.includes(NOT_READ)) {
                    this.#asked.delete(name);
                }
            }
            return true;
        } catch {
            return false;  // they are not drawn
        }
    }
}
