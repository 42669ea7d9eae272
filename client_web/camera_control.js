// SPDX-License-Identifier: Apache-2.0
// The user's camera: held keys, flights to named cameras, and the two ways to move, orbit and walk.
//
// To orbit is to circle around what is looked at from outside. Whoever is inside, with walls around, looks around
// instead, since the eye would go through them; but around what he has chosen to look at (a double click, F) he
// circles there too, as far as the walls let him.

import {between, dolly, look, orbit, orbitIn, pan, roomAround, sameView, spaceIn, walk} from './camera.js';
import {clamp, diagonal, length, sub} from './vector.js';

/**
 * @typedef {import('./protocol.js').View} View
 * @typedef {import('./protocol.js').Bounds} Bounds
 * @typedef {import('./protocol.js').Vec3} Vec3
 * @typedef {'orbit' | 'walk'} Mode
 */

/** Of turning with keys, radians per second. */
const TURN_SPEED = 1.2;
const FLIGHT_MS = 700;
/** How soon walking reaches its speed, and ends, seconds. */
const EASING_S = 0.07;
/** Slower than this share of the full speed is standing. */
const STANDING = 0.004;
/** Targets nearer to one another are the same, metres. */
const SAME_TARGET = 1e-6;
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
const strength = (motion) => Math.max(...Object.values(motion).map(Math.abs));

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
 * Walking speed that suits a scene: a stroll in a building, slower around a small object.
 *
 * @param {Bounds} bounds
 * @returns {number} metres per second
 */
export function walkingSpeed(bounds) {
    return clamp(diagonal(bounds) / 6, 0.01, 2);
}

/** @type {(view: View) => number} */
const away = ({eye, target}) => length(sub(eye, target));

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
    /**
     * What is circled around: within which space, how far away where it lets the eye, and the view that came of it.
     *
     * @type {{target: Vec3, space: Bounds | null, reach: number, view: View} | null}
     */
    #circle = null;
    /** Where an eye may circle. @type {(eye: Vec3) => Bounds | null} */
    #space = () => null;
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
     * @param {{bounds: Bounds, objects?: {movable: boolean, bounds: Bounds}[]}} scene
     */
    fit({bounds, objects = []}) {
        const parts = objects.filter(({movable}) => !movable).map((object) => object.bounds);
        this.#circle = null;
        this.#space = (eye) => {
            const room = roomAround(eye, bounds, parts);
            return room && spaceIn(room, eye);
        };
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

    /** Where the eye may circle, with walls around it; null: it looks at the scene from outside. */
    get space() {
        return this.#space(this.view.eye);
    }

    /** Whether turning goes around what is looked at; otherwise the head turns. */
    get circles() {
        return this.mode === 'orbit' && (this.#circleOf(this.view) !== null || this.space === null);
    }

    /**
     * What is circled around, if that is what a view looks at.
     *
     * @param {View} view
     */
    #circleOf({target}) {
        const circle = this.#circle;
        return circle && length(sub(circle.target, target)) < SAME_TARGET ? circle : null;
    }

    /**
     * Flies to a view of something that is to be circled around, also inside a room.
     *
     * @param {View} view
     */
    flyAround(view) {
        this.#circle = {target: view.target, space: this.#space(view.eye), reach: away(view), view};
        this.flyTo(view);
    }

    /**
     * Circles around the target, as far as the walls let it.
     *
     * @param {View} view
     * @param {number} left  radians
     * @param {number} upwards  radians
     * @returns {View}
     */
    #orbit(view, left, upwards) {
        const circle = this.#circleOf(view);
        const space = circle ? circle.space : this.#space(view.eye);
        const reach = circle && sameView(circle.view, view) ? circle.reach : away(view);
        const now = space ? orbitIn(view, left, upwards, reach, space) : orbit(view, left, upwards);
        this.#circle = {target: view.target, space, reach, view: now};
        return now;
    }

    /**
     * Turns by a way of the pointer: around the target, or the head.
     *
     * @param {number} x  heights of the picture to the right
     * @param {number} y  heights of the picture downwards
     */
    turn(x, y) {
        const angle = Math.PI;
        if (this.circles) {
            this.set(this.#orbit(this.view, -x * angle, -y * angle));
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
            if (this.#circle?.space === null && this.space) {
                this.#circle = null;  // who has come in looks around
            }
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

    get #keyMode() {
        return this.mode === 'orbit' && !this.circles ? 'look' : this.mode;
    }

    /** @returns {Motion} sum of keys and sticks */
    #asked() {
        const sum = motionOf(this.#keys, this.#keyMode);
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
        this.#moveBy(motionOf(this.#keys, this.#keyMode), seconds);
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
            const left = motion.left * TURN_SPEED * seconds;
            const upwards = motion.tilt * TURN_SPEED * seconds;
            view = this.circles ? this.#orbit(view, left, upwards) : look(view, left, upwards);
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
