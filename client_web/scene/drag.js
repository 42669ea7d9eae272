// SPDX-License-Identifier: Apache-2.0
// Moving an object over the floor. While it is dragged, at most one unfinished move is sent per
// animation frame; letting go sends the final one.

import {axes} from '../camera/camera.js';
import {FrameThrottle} from '../picture/frame_throttle.js';
import {ServerError} from '../net/protocol.js';
import {shifted} from './scene_model.js';
import {
    UP,
    add,
    clamp,
    dot,
    intersectBounds,
    length,
    normalise,
    scale,
    sub,
    vec3,
} from '../ui/vector.js';

/**
 * @typedef {import('../net/scene_types.js').Vec3} Vec3
 * @typedef {import('../net/scene_types.js').View} View
 * @typedef {import('../net/scene_types.js').Bounds} Bounds
 * @typedef {import('../net/scene_types.js').Transform} Transform
 * @typedef {import('../ui/vector.js').Ray} Ray
 * @typedef {import('./scene_model.js').PlacedObject} PlacedObject
 * @typedef {import('../net/raybundle_client.js').RaybundleClient} RaybundleClient
 * @typedef {object} Grip
 * @property {Vec3} point  grabbed point, world space
 * @property {boolean} level  whether rays are met with the level plane through the point, rather
 *     than the pointer's way read as right and forwards
 * @property {Ray} ray
 */

/** Sine of the angle to the horizon below which a level plane is too much at a slant to drag on. */
const SHALLOWEST = 0.1;

/**
 * Takes hold of an object.
 *
 * @param {Bounds} bounds  of the object, met by the ray
 * @param {Ray} ray
 * @returns {Grip | null}
 */
export function grip(bounds, ray) {
    const hit = intersectBounds(ray, bounds);
    if (!hit) {
        return null;
    }
    const point = add(ray.origin, scale(ray.direction, Math.max(hit.enter, 0)));
    return {point, level: Math.abs(normalise(ray.direction).y) > SHALLOWEST, ray};
}

/**
 * How far over the floor the pointer has carried a grip.
 *
 * @param {Grip} held
 * @param {Ray} ray  through the pointer now
 * @param {View} view
 * @returns {Vec3 | null}  y is 0; null: the pointer points nowhere on the floor
 */
export function carried(held, ray, view) {
    if (held.level) {
        const t = (held.point.y - ray.origin.y) / ray.direction.y;
        if (!(t > 0) || !Number.isFinite(t)) {
            return null;
        }
        const shift = sub(add(ray.origin, scale(ray.direction, t)), held.point);
        return vec3(shift.x, 0, shift.z);
    }
    // The floor is seen almost edge-on: across is across, up is away.
    const {right, up, forward} = axes(view);
    const depth = dot(sub(held.point, ray.origin), forward);
    const turn = sub(perDepth(ray, forward), perDepth(held.ray, forward));
    const ahead = normalise(vec3(forward.x, 0, forward.z));
    const shift = add(scale(right, dot(turn, right) * depth), scale(ahead, dot(turn, up) * depth));
    return vec3(shift.x, 0, shift.z);
}

/**
 * @param {Ray} ray
 * @param {Vec3} forward
 * @returns {Vec3} the ray's direction, one metre deep
 */
function perDepth(ray, forward) {
    return scale(ray.direction, 1 / Math.max(dot(ray.direction, forward), 1e-6));
}

/**
 * A shift shortened so that the object does not leave the scene.
 *
 * @param {Vec3} shift
 * @param {Bounds} object  before the shift
 * @param {Bounds} scene
 * @returns {Vec3}
 */
export function keptInside(shift, object, scene) {
    const along = (/** @type {'x' | 'z'} */ axis) => {
        // What already sticks out may stay as far out.
        const low = Math.min(scene.min[axis] - object.min[axis], 0);
        const high = Math.max(scene.max[axis] - object.max[axis], 0);
        return clamp(shift[axis], low, high);
    };
    return vec3(along('x'), shift.y, along('z'));
}

/**
 * Events: `moved`, after an object's place has changed here; `rejected` (detail Error); `done`
 * (detail {object, from, to}), after the server has carried out a move that begins and ends.
 */
export class ObjectMover extends EventTarget {
    /**
     * @type {{object: PlacedObject, grip: Grip, from: Required<Transform>, bounds: Bounds} | null}
     */
    #drag = null;
    #unfinished = new FrameThrottle(() => this.#sendUnfinished());

    /** @param {RaybundleClient} client */
    constructor(client) {
        super();
        this.client = client;
    }

    /** Object in the user's hand. */
    get held() {
        return this.#drag?.object.id ?? null;
    }

    /**
     * @param {PlacedObject} object
     * @param {Ray} ray
     * @returns {boolean} whether the object has been taken hold of
     */
    begin(object, ray) {
        const held = object.loose ? grip(object.bounds, ray) : null;
        if (held) {
            this.#drag = {object, grip: held, from: object.transform, bounds: object.bounds};
        }
        return held !== null;
    }

    /**
     * @param {Ray} ray  through the pointer now
     * @param {View} view
     * @param {Bounds} scene
     */
    drag(ray, view, scene) {
        if (!this.#drag) {
            return;
        }
        const {object, grip: held, from, bounds} = this.#drag;
        const shift = carried(held, ray, view);
        if (!shift) {
            return;
        }
        object.place(shifted(from, keptInside(shift, bounds, scene), object.worldFromParent));
        this.dispatchEvent(new Event('moved'));
        this.#unfinished.run();
    }

    /** Lets go without a word to the server, as when the connection is new. */
    forget() {
        this.#drag = null;
        this.#unfinished.cancel();
    }

    /**
     * Lets go.
     *
     * @param {boolean} keep  false: the object returns to where it was
     * @returns {Promise<void>} when the server has answered
     */
    async end(keep) {
        const drag = this.#drag;
        this.forget();
        if (drag && drag.object.transform !== drag.from) {
            const {object, from} = drag;
            await this.move(object, keep ? object.transform : from, keep ? from : null);
        }
    }

    /**
     * Moves an object for good.
     *
     * @param {PlacedObject} object
     * @param {Transform} transform
     * @param {Required<Transform> | null} from  where it was before; null: not to be undone
     */
    async move(object, transform, from = object.transform) {
        object.place(transform);
        this.dispatchEvent(new Event('moved'));
        const moveObject = {object: object.id, transform: object.transform, final: true};
        try {
            await this.client.request({moveObject}).answer;
            if (from) {
                const detail = {object, from, to: moveObject.transform};
                this.dispatchEvent(new CustomEvent('done', {detail}));
            }
        } catch (error) {
            if (this.held !== object.id) {
                object.place(object.confirmed);
                this.dispatchEvent(new Event('moved'));
            }
            if (error instanceof ServerError) {
                this.dispatchEvent(new CustomEvent('rejected', {detail: error}));
            }
        }
    }

    /**
     * Shifts an object over the floor, as seen from a view.
     *
     * @param {PlacedObject} object
     * @param {View} view
     * @param {number} rightwards  metres
     * @param {number} forwards  metres
     * @param {Bounds} scene
     */
    async nudge(object, view, rightwards, forwards, scene) {
        const {right, forward, up} = axes(view);
        const flat = vec3(forward.x, 0, forward.z);
        const ahead = normalise(length(flat) > 0.01 ? flat : vec3(up.x, 0, up.z));
        const shift = add(scale(right, rightwards), scale(ahead, forwards));
        const level = keptInside(vec3(shift.x, 0, shift.z), object.bounds, scene);
        await this.move(object, shifted(object.transform, level, object.worldFromParent));
    }

    /**
     * Takes hold of an object by other means than its surface, as by a handle.
     *
     * @param {PlacedObject} object
     */
    hold(object) {
        const grip = {point: vec3(0, 0, 0), level: true, ray: {origin: UP, direction: UP}};
        this.#drag = {object, grip, from: object.transform, bounds: object.bounds};
    }

    /**
     * Places what is held.
     *
     * @param {Transform} transform
     */
    place(transform) {
        if (this.#drag) {
            this.#drag.object.place(transform);
            this.dispatchEvent(new Event('moved'));
            this.#unfinished.run();
        }
    }

    #sendUnfinished() {
        if (this.#drag) {
            const {id, transform} = this.#drag.object;
            this.client.send({moveObject: {object: id, transform, final: false}});
        }
    }
}
