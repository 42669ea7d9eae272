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
/** How soon walking reaches its speed, and ends, seconds. */
const EASING_S = 0.07;
/** Slower than this share of the full speed is standing. */
const STANDING = 0.004;
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
 * What moves the camera, each -1..1.
 *
 * @typedef {{forwards: number, rightwards: number, upwards: number, left: number, tilt: number}} Motion
 */

/** @type {() => Motion} */
export const noMotion = () => ({forwards: 0, rightwards: 0, upwards: 0, left: 0, tilt: 0});

/** @type {(motion: Motion) => number} */
const strength = (motion) => Math.max(...Object.values(motion).map(Math.abs));

/**
 * Sum of what held keys ask for, each -1..1.
 *
 * @param {Iterable<string>} codes  KeyboardEvent.code
 * @param {Mode} mode
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
    /** What sticks ask for, by the name of the source. @type {Map<string, Motion>} */
    #sticks = new Map();
    /** What moves now, on its way to what is asked for. */
    #motion = noMotion();

    /** @param {View} view */
    constructor(view) {
        super();
        this.view = view;
        /** @type {Mode} */
        this.mode = 'orbit';
        this.speed = 1.5;
        this.farthest = 1000;
    }

    /** Whether the camera is on its way. */
    get moving() {
        return this.#ticking !== 0;
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
     * Turns the head by angles.
     *
     * @param {number} left  radians
     * @param {number} upwards  radians
     */
    look(left, upwards) {
        this.set(look(this.view, left, upwards));
    }

    /**
     * What a stick asks for, of the touch screen or of a game controller.
     *
     * @param {string} source
     * @param {Motion} motion
     */
    stick(source, motion) {
        this.#sticks.set(source, motion);
        if (strength(motion) > 0) {
            this.#flight = null;
            this.#tickSoon();
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
            this.#ease(seconds);
            this.#moveBy(this.#motion, seconds);
        }
        const busy = this.#flight || strength(this.#asked()) > 0 || strength(this.#motion) > 0;
        this.#ticking = busy ? requestAnimationFrame((next) => this.#tick(next)) : 0;
    }

    /** @returns {Motion} sum of keys and sticks */
    #asked() {
        const sum = motionOf(this.#keys, this.mode);
        for (const motion of this.#sticks.values()) {
            for (const name of /** @type {(keyof Motion)[]} */ (Object.keys(sum))) {
                sum[name] = clamp(sum[name] + motion[name], -1, 1);
            }
        }
        return sum;
    }

    /** @param {number} seconds */
    #ease(seconds) {
        const asked = this.#asked();
        const part = 1 - Math.exp(-seconds / EASING_S);
        for (const name of /** @type {(keyof Motion)[]} */ (Object.keys(asked))) {
            this.#motion[name] += part * (asked[name] - this.#motion[name]);
        }
        if (strength(asked) === 0 && strength(this.#motion) < STANDING) {
            this.#motion = noMotion();
        }
    }

    /** @param {number} seconds */
    #moveByKeys(seconds) {
        this.#moveBy(motionOf(this.#keys, this.mode), seconds);
    }

    /**
     * @param {Motion} motion
     * @param {number} seconds
     */
    #moveBy(motion, seconds) {
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
