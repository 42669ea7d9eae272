// SPDX-License-Identifier: Apache-2.0
// What held keys ask the camera for.

import {clamp} from '../ui/vector.js';

/** @typedef {'orbit' | 'walk'} Mode */

/** Keys by their place on the keyboard, and what they add to the motion. */
const WALK_KEYS = new Map([
    ['KeyW', {forwards: 1}],
    ['KeyS', {forwards: -1}],
    ['KeyA', {rightwards: -1}],
    ['KeyD', {rightwards: 1}],
    ['KeyQ', {upwards: -1}],
    ['KeyE', {upwards: 1}],
    ['PageUp', {upwards: 1}],
    ['PageDown', {upwards: -1}],
]);
const ARROW_KEYS = {
    walk: new Map([
        ['ArrowUp', {forwards: 1}],
        ['ArrowDown', {forwards: -1}],
        ['ArrowLeft', {left: 1}],
        ['ArrowRight', {left: -1}],
    ]),
    orbit: new Map([
        ['ArrowUp', {tilt: -1}],
        ['ArrowDown', {tilt: 1}],
        ['ArrowLeft', {left: -1}],
        ['ArrowRight', {left: 1}],
    ]),
    look: new Map([
        ['ArrowUp', {tilt: 1}],
        ['ArrowDown', {tilt: -1}],
        ['ArrowLeft', {left: 1}],
        ['ArrowRight', {left: -1}],
    ]),
};

/**
 * What moves the camera, each -1..1.
 *
 * @typedef {{forwards: number, rightwards: number, upwards: number, left: number, tilt: number}} Motion
 */

/** @type {() => Motion} */
export const noMotion = () => ({forwards: 0, rightwards: 0, upwards: 0, left: 0, tilt: 0});

/** @type {(motion: Motion) => number} */
export const strength = (motion) => Math.max(...Object.values(motion).map(Math.abs));

/**
 * Sum of what held keys ask for, each -1..1.
 *
 * @param {Iterable<string>} codes  KeyboardEvent.code
 * @param {Mode | 'look'} mode  look: to orbit from inside, where that is to look around
 */
export function motionOf(codes, mode) {
    const motion = noMotion();
    for (const code of codes) {
        const part = WALK_KEYS.get(code) ?? ARROW_KEYS[mode].get(code) ?? {};
        for (const [name, amount] of Object.entries(part)) {
            const key = /** @type {keyof typeof motion} */ (name);
            motion[key] = clamp(motion[key] + amount, -1, 1);
        }
    }
    return motion;
}

/**
 * @param {string} code  KeyboardEvent.code
 * @param {Mode} mode
 */
export const isCameraKey = (code, mode) => WALK_KEYS.has(code) || ARROW_KEYS[mode].has(code);
