// SPDX-License-Identifier: Apache-2.0
// The user's camera: held keys, flights to named cameras, and the two ways to move, orbit and walk.
//
// To orbit is to circle around what is looked at from outside. Whoever is inside, with walls around, looks around
// instead, since the eye would go through them; but around what he has chosen to look at (a double click, F) he
// circles there too, as far as the walls let him.

import {between, dolly, look, orbit, orbitIn, pan, roomAround, sameView, spaceIn, walk} from './camera.js';
import {isCameraKey, motionOf, noMotion, strength} from './motion.js';
import {clamp, diagonal, length, sub} from '../ui/vector.js';

export {motionOf, noMotion};

/**
 * @typedef {import('../net/scene_types.js').View} View
 * @typedef {import('../net/scene_types.js').Bounds} Bounds
 * @typedef {import('../net/scene_types.js').Vec3} Vec3
 * @typedef {import('./motion.js').Mode} Mode
 * @typedef {import('./motion.js').Motion} Motion
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
/** The wheel shows less or more of a plan, by its field of view, radians; the server knows none below the first. */
const PLAN_FOVS = /** @type {const} */ ([0.001, 0.1]);
/** Motion that a key press is worth at once, seconds. */
const FIRST_STEP_S = 0.05;

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
    /** What stops who walks, and the wheel; null: nothing. @type {import('./collisions.js').Collisions | null} */
    obstacles = null;
    /** How often somebody has been flown to a view that was chosen. */
    flights = 0;
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

    /** Whether it is being flown to a view that was chosen. */
    get flying() {
        return this.#flight !== null;
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
        ++this.flights;
        // A plan is so far away that nothing is seen on the way.
        if (matchMedia('(prefers-reduced-motion: reduce)').matches || this.view.near || view.near) {
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

    /** Whether walls stop the eye: not of those who look at a model from outside. */
    get #collides() {
        return this.mode === 'walk' || this.space !== null;
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
        if (this.view.near) {
            this.pan(x, y);
        } else if (this.circles) {
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
        if (this.view.near) {
            const verticalFov = clamp(this.view.verticalFov * factor, ...PLAN_FOVS);
            this.set({...this.view, verticalFov});
        } else if (this.mode === 'orbit') {
            const nearer = dolly(this.view, factor, this.farthest);
            this.set(this.obstacles?.flown(nearer, this.view) ?? nearer);
            if (this.#circle?.space === null && this.space) {
                this.#circle = null;  // who has come in looks around
            }
        } else {
            const nearer = walk(this.view, -Math.log(factor) * 2 * this.speed, 0, 0);
            this.set(this.obstacles?.walked(nearer, this.view) ?? nearer);
        }
    }

    /**
     * @param {string} code  KeyboardEvent.code
     * @param {boolean} hurry  three times the speed
     * @returns {boolean} whether the key means anything here
     */
    keyDown(code, hurry) {
        if (!isCameraKey(code, this.mode)) {
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
        if (this.obstacles && this.#collides && !sameView(view, this.view)) {
            view = this.obstacles.walked(view, this.view);
        }
        if (!this.view.near && (motion.left || motion.tilt)) {
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
