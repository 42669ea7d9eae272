// SPDX-License-Identifier: Apache-2.0
// The user's camera: held keys, flights to named cameras, and the two ways to move, orbit and walk.

import {between, dolly, look, orbit, pan, sameView, walk} from './camera.js';
import {clamp, diagonal} from './vector.js';

/**
 * @typedef {import('./protocol.js').View} View
 * @typedef {import('./protocol.js').Bounds} Bounds
 * @typedef {'orbit' | 'walk'} Mode
 */

/** Of turning with keys, radians per second. */
const TURN_SPEED = 1.2;
const FLIGHT_MS = 700;
/** Motion that a key press is worth at once, seconds. */
const FIRST_STEP_S = 0.05;

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
};

/**
 * Sum of what held keys ask for, each -1..1.
 *
 * @param {Iterable<string>} codes  KeyboardEvent.code
 * @param {Mode} mode
 */
export function motionOf(codes, mode) {
    const motion = {forwards: 0, rightwards: 0, upwards: 0, left: 0, tilt: 0};
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
 * Walking speed that suits a scene: a stroll in a building, slower around a small object.
 *
 * @param {Bounds} bounds
 * @returns {number} metres per second
 */
export function walkingSpeed(bounds) {
    return clamp(diagonal(bounds) / 6, 0.01, 2);
}

/** Event: `change`, after the view has changed. */
export class CameraControl extends EventTarget {
    /** @type {Set<string>} */
    #keys = new Set();
    #hurry = false;
    #lastTick = 0;
    #ticking = 0;
    /** @type {{from: View, to: View, start: number} | null} */
    #flight = null;

    /** @param {View} view */
    constructor(view) {
        super();
        this.view = view;
        /** @type {Mode} */
        this.mode = 'orbit';
        this.speed = 1.5;
        this.farthest = 1000;
    }

    /**
     * Suits speeds and limits to a scene.
     *
     * @param {Bounds} bounds
     */
    fit(bounds) {
        this.speed = walkingSpeed(bounds);
        this.farthest = Math.max(diagonal(bounds) * 10, 1);
    }

    /**
     * Shows a view at once.
     *
     * @param {View} view
     */
    set(view) {
        this.#flight = null;
        this.#show(view);
    }

    /**
     * Flies to a view, or is there at once if the user prefers reduced motion.
     *
     * @param {View} view
     */
    flyTo(view) {
        if (matchMedia('(prefers-reduced-motion: reduce)').matches) {
            this.set(view);
            return;
        }
        this.#flight = {from: this.view, to: view, start: performance.now()};
        this.#tickSoon();
    }

    /**
     * Turns by a way of the pointer: around the target, or the head.
     *
     * @param {number} x  heights of the picture to the right
     * @param {number} y  heights of the picture downwards
     */
    turn(x, y) {
        const angle = Math.PI;
        if (this.mode === 'orbit') {
            this.set(orbit(this.view, -x * angle, -y * angle));
        } else {
            const scale = this.view.verticalFov;
            this.set(look(this.view, x * scale, y * scale));
        }
    }

    /**
     * Shifts the picture with the pointer.
     *
     * @param {number} x  heights of the picture to the right
     * @param {number} y  heights of the picture downwards
     */
    pan(x, y) {
        this.set(pan(this.view, -x, y));
    }

    /**
     * Comes nearer or goes back.
     *
     * @param {number} factor  below 1 comes nearer
     */
    zoom(factor) {
        if (this.mode === 'orbit') {
            this.set(dolly(this.view, factor, this.farthest));
        } else {
            this.set(walk(this.view, -Math.log(factor) * 2 * this.speed, 0, 0));
        }
    }

    /**
     * @param {string} code  KeyboardEvent.code
     * @param {boolean} hurry  three times the speed
     * @returns {boolean} whether the key means anything here
     */
    keyDown(code, hurry) {
        if (!WALK_KEYS.has(code) && !ARROW_KEYS[this.mode].has(code)) {
            return false;
        }
        this.#hurry = hurry;
        this.#flight = null;
        if (!this.#keys.has(code)) {
            this.#keys.add(code);
            // However short the press, it shows.
            this.#moveByKeys(FIRST_STEP_S);
        }
        this.#tickSoon();
        return true;
    }

    /** @param {string} code  KeyboardEvent.code */
    keyUp(code) {
        this.#keys.delete(code);
    }

    /** Lets go of all keys, as when the page loses the focus. */
    releaseKeys() {
        this.#keys.clear();
    }

    #tickSoon() {
        if (!this.#ticking) {
            this.#lastTick = performance.now();
            this.#ticking = requestAnimationFrame((now) => this.#tick(now));
        }
    }

    /** @param {number} now */
    #tick(now) {
        // A page that stood still must not leap.
        const seconds = clamp((now - this.#lastTick) / 1000, 0.001, 0.1);
        this.#lastTick = now;
        if (this.#flight) {
            const {from, to, start} = this.#flight;
            const time = (now - start) / FLIGHT_MS;
            this.#show(between(from, to, Math.max(time, 0)));
            this.#flight = time >= 1 ? null : this.#flight;
        } else {
            this.#moveByKeys(seconds);
        }
        const busy = this.#flight || this.#keys.size > 0;
        this.#ticking = busy ? requestAnimationFrame((next) => this.#tick(next)) : 0;
    }

    /** @param {number} seconds */
    #moveByKeys(seconds) {
        const motion = motionOf(this.#keys, this.mode);
        const metres = seconds * this.speed * (this.#hurry ? 3 : 1);
        let view = walk(
            this.view,
            motion.forwards * metres,
            motion.rightwards * metres,
            motion.upwards * metres,
        );
        if (motion.left || motion.tilt) {
            const turnBy = this.mode === 'orbit' ? orbit : look;
            view = turnBy(
                view,
                motion.left * TURN_SPEED * seconds,
                motion.tilt * TURN_SPEED * seconds,
            );
        }
        this.#show(view);
    }

    /** @param {View} view */
    #show(view) {
        if (!sameView(view, this.view)) {
            this.view = view;
            this.dispatchEvent(new Event('change'));
        }
    }
}
