// SPDX-License-Identifier: Apache-2.0
// What the page knows of the scene: objects, where they stand, and where the server last said they
// stand. The two differ while a move is on its way.

import {visibleEdges} from '../picture/overlay.js';
import {basePoint, isHinge} from './placement.js';
import {
    IDENTITY,
    add,
    boundsOf,
    centre,
    completeTransform,
    corners,
    inverseMatrixPoint,
    inverseMatrixVector,
    inverseTransformPoint,
    matrixPoint,
    matrixVector,
    sub,
    transformPoint,
    vec3,
} from '../ui/vector.js';

/**
 * @typedef {import('../net/scene_types.js').Vec3} Vec3
 * @typedef {import('../net/scene_types.js').Bounds} Bounds
 * @typedef {import('../net/scene_types.js').Transform} Transform
 * @typedef {import('../net/scene_types.js').Scene} Scene
 * @typedef {import('../net/scene_types.js').SceneObject} SceneObject
 * @typedef {import('../net/scene_types.js').SceneChanged} SceneChanged
 */

/**
 * World bounds after a change of the local transform. Exact for a shift, a box around the turned or
 * scaled box otherwise.
 *
 * @param {Bounds} bounds  world bounds at `before`
 * @param {Transform} before
 * @param {Transform} after
 * @param {readonly number[]} [worldFromParent]
 * @returns {Bounds}
 */
export function movedBounds(bounds, before, after, worldFromParent = IDENTITY) {
    return boundsOf(
        corners(bounds).map((corner) => {
            const inParent = inverseMatrixPoint(worldFromParent, corner);
            const moved = transformPoint(after, inverseTransformPoint(before, inParent));
            return matrixPoint(worldFromParent, moved);
        }),
    );
}

/**
 * A transform shifted along the world's axes.
 *
 * @param {Transform} transform
 * @param {Vec3} shift  metres, world space
 * @param {readonly number[]} [worldFromParent]
 * @returns {Required<Transform>}
 */
export function shifted(transform, shift, worldFromParent = IDENTITY) {
    const complete = completeTransform(transform);
    const inParent = inverseMatrixVector(worldFromParent, shift);
    return {...complete, translation: add(complete.translation, inParent)};
}

/**
 * For JSON: numbers as far as 32 bits carry them.
 *
 * @param {string} _
 * @param {unknown} value
 */
const roundedNumbers = (_, value) => (typeof value === 'number' ? Number(value.toPrecision(5)) : value);

/**
 * Where a leaf without a hinge of its own is hung: at one end, in the middle of its thickness.
 *
 * @param {Bounds} bounds
 * @returns {Vec3}
 */
function hingeOf({min, max}) {
    const along = max.x - min.x >= max.z - min.z;
    return along ? vec3(min.x, min.y, (min.z + max.z) / 2) : vec3((min.x + max.x) / 2, min.y, min.z);
}

/** One object, with its place now and its place as the server last told. */
export class PlacedObject {
    /** @type {Bounds} */
    #originalBounds;
    /** @type {Transform} */
    #originalTransform;

    /** @param {SceneObject} object */
    constructor({id, name, movable, bounds, transform, worldFromParent, kind, storey}) {
        this.id = id;
        this.name = name || `Object ${id}`;
        this.movable = movable;
        this.kind = kind ?? 'THING';
        this.storey = storey ?? '';
        /** Affine 4x4 matrix, column by column. */
        this.worldFromParent = worldFromParent?.length === 16 ? worldFromParent : IDENTITY;
        this.#originalBounds = bounds;
        this.#originalTransform = transform;
        /** Local transform, shown now. */
        this.transform = completeTransform(transform);
        /** Local transform that the server has confirmed. */
        this.confirmed = this.transform;
        /** The one that it has confirmed before that. */
        this.earlier = this.transform;
        /** World bounds at `transform`. */
        this.bounds = bounds;
        /** Local transform before all changes, where somebody has moved it before this page came. @type {Transform | null} */
        this.loaded = null;
        /** Somebody has said that this part of the building may be moved. */
        this.unlocked = false;
        /** What it turns about, in its own space, where somebody has said so. @type {Vec3 | null} */
        this.ownPivot = null;
        const origin = matrixPoint(this.worldFromParent, this.transform.translation);
        if (isHinge(bounds, origin)) {
            this.ownPivot = vec3(0, 0, 0);
        } else if (this.kind === 'DOOR') {
            this.pivot = hingeOf(bounds);
        }
    }

    /** Whether it can be moved as it is: parts of the building have to be unlocked. */
    get loose() {
        return this.movable && (this.kind !== 'STRUCTURE' || this.unlocked);
    }

    /** What it turns about, at its lower edge: its hinge, or its middle. @returns {Vec3} */
    get pivot() {
        if (!this.ownPivot) {
            return basePoint(this.bounds);
        }
        const point = matrixPoint(this.worldFromParent, transformPoint(this.transform, this.ownPivot));
        return {...point, y: this.bounds.min.y};
    }

    set pivot(point) {
        this.ownPivot = inverseTransformPoint(this.transform, inverseMatrixPoint(this.worldFromParent, point));
    }

    /** @param {Transform} transform */
    place(transform) {
        this.transform = completeTransform(transform);
        this.bounds = movedBounds(
            this.#originalBounds,
            this.#originalTransform,
            this.transform,
            this.worldFromParent,
        );
    }

    /** @param {Transform} transform */
    confirm(transform) {
        this.earlier = this.confirmed;
        this.confirmed = completeTransform(transform);
    }

    /**
     * Edges of the box around the object, turned with it, that no face of the box hides.
     *
     * @param {Vec3} eye
     * @returns {[Vec3, Vec3][]}
     */
    boxEdges(eye) {
        const now = this.carriedSince(this.#originalTransform);
        const eyeThen = this.#carried(this.transform, this.#originalTransform)(eye);
        const edges = visibleEdges(this.#originalBounds, eyeThen);
        return edges.map(([start, end]) => [now(start), now(end)]);
    }

    /**
     * Where the object has carried its points since it stood elsewhere, world space.
     *
     * @param {Transform} since  local transform at that time
     * @returns {(point: Vec3) => Vec3}
     */
    carriedSince(since) {
        return this.#carried(since, this.transform);
    }

    /**
     * @param {Transform} from
     * @param {Transform} to
     * @returns {(point: Vec3) => Vec3}
     */
    #carried(from, to) {
        const parent = this.worldFromParent;
        return (point) => {
            const inNode = inverseTransformPoint(from, inverseMatrixPoint(parent, point));
            return matrixPoint(parent, transformPoint(to, inNode));
        };
    }

    /**
     * Middle of the object, were it placed otherwise.
     *
     * @param {Transform} transform  local
     * @returns {Vec3}
     */
    centreAt(transform) {
        return centre(movedBounds(this.#originalBounds, this.#originalTransform, transform, this.worldFromParent));
    }

    /**
     * Where the object stands on its base, as the panel tells it, were it placed otherwise.
     *
     * @param {Transform} transform  local
     * @returns {Vec3}
     */
    baseAt(transform) {
        return basePoint(movedBounds(this.#originalBounds, this.#originalTransform, transform, this.worldFromParent));
    }

    /** Local transform in the file, as far as it is known; else as this page was told first. */
    get original() {
        return completeTransform(this.loaded ?? this.#originalTransform);
    }

    /** Where it has been moved to since the scene was loaded, metres. */
    get shift() {
        return matrixVector(this.worldFromParent, sub(this.transform.translation, this.original.translation));
    }
}

/** The scene of one connection. */
export class SceneModel {
    /**
     * @param {Scene} scene
     * @param {number} epoch
     */
    constructor(scene, epoch) {
        this.name = scene.name;
        /** The name as people would write it. */
        this.title = scene.name.replaceAll(/[_-]+/g, ' ').replace(/^./, (c) => c.toUpperCase());
        this.bounds = scene.bounds;
        this.cameras = scene.cameras ?? [];
        this.effects = scene.effects ?? [];
        this.epoch = epoch;
        this.lights = (scene.lights ?? []).map((light) => ({...light}));
        this.materials = (scene.materials ?? []).map((material) => ({...material}));
        this.daylight = scene.daylight;
        this.lightingScenes = scene.lightingScenes ?? [];
        this.animations = (scene.animations ?? []).map((one) => ({...one, state: {...one.state}}));
        this.objects = (scene.objects ?? []).map((object) => new PlacedObject(object));
        /** What is gone is spoken of, too. @type {Map<string, string>} */
        this.goneNames = new Map();
    }

    /**
     * Storeys by name, each with the bounds of what is on it, the lowest first.
     *
     * @returns {Map<string, Bounds>}
     */
    get storeys() {
        /** @type {Map<string, Bounds>} */
        const storeys = new Map();
        for (const {storey, bounds} of this.objects) {
            if (storey) {
                const known = storeys.get(storey);
                storeys.set(storey, known ? boundsOf([known.min, known.max, bounds.min, bounds.max]) : bounds);
            }
        }
        return new Map([...storeys].sort(([, a], [, b]) => a.min.y - b.min.y));
    }

    /**
     * @param {number | null | undefined} id
     * @returns {PlacedObject | null}
     */
    object(id) {
        return this.objects.find((object) => object.id === id) ?? null;
    }

    /** @param {string} name */
    animation(name) {
        return this.animations.find((animation) => animation.name === name) ?? null;
    }

    /**
     * Whether this scene has come of an earlier one, so that its changes are still known here: on the same run of the
     * server by more changes or none; of another run, which may have a journal, if it is just the same.
     *
     * @param {SceneModel} before
     * @param {boolean} sameRun
     */
    goesOnFrom(before, sameRun) {
        return sameRun
            ? this.epoch > before.epoch || (this.epoch === before.epoch && this.#state === before.#state)
            : this.epoch === before.epoch && this.#state === before.#state;
    }

    /**
     * What is not as it was: objects, lights and materials.
     *
     * @param {SceneModel} before
     * @returns {import('./history.js').Subject[]}
     */
    differencesFrom(before) {
        const text = (/** @type {unknown} */ value) => JSON.stringify(value, roundedNumbers);
        const places = new Map(before.objects.map(({id, confirmed}) => [id, text(confirmed)]));
        const lights = new Map(before.lights.map((light) => [light.id, text(light)]));
        const materials = new Map(before.materials.map((material) => [material.id, text(material)]));
        return [
            ...this.objects
                .filter(({id, confirmed}) => places.get(id) !== text(confirmed))
                .map(({id}) => ({moveObject: {object: id}})),
            ...this.lights.filter((light) => lights.get(light.id) !== text(light)).map(({id}) => ({setLight: {light: id}})),
            ...this.materials
                .filter((material) => materials.get(material.id) !== text(material))
                .map(({id}) => ({setMaterial: {material: id}})),
        ];
    }

    /** All that can be changed, as the server has told it. */
    get #state() {
        const objects = this.objects.map(({id, confirmed}) => [id, confirmed]);
        return JSON.stringify([objects, this.lights, this.materials], roundedNumbers);
    }

    /**
     * Takes in a change that the server announces.
     *
     * @param {SceneChanged} change
     * @param {number | null} held  object in the user's hand, which stays there
     */
    apply(change, held) {
        this.epoch = change.epoch;
        this.#applyLight(change.setLight);
        this.#applyDaylight(change.setDaylight);
        this.#applyMaterial(change.setMaterial);
        this.#applyAdded(change);
        const move = change.moveObject;
        const object = move ? this.object(move.object) : null;
        if (!move || !object) {
            return;
        }
        object.confirm(move.transform);
        if (object.id !== held) {
            object.place(move.transform);
        }
    }

    /** @param {import('../net/scene_types.js').SetLight | undefined} change */
    #applyLight(change) {
        const light = this.lights.find(({id}) => id === change?.light);
        if (light && change) {
            const {light: _, fadeSeconds: __, ...told} = change;
            Object.assign(light, Object.fromEntries(Object.entries(told).filter(([, value]) => value !== undefined)));
        }
    }

    /**
     * What is there now, or is not any more.
     *
     * @param {SceneChanged} change
     */
    #applyAdded({objects = [], lights = [], materials = [], removeObject, removeLight}) {
        const known = new Set(this.materials.map(({id}) => id));
        this.materials.push(...materials.filter(({id}) => !known.has(id)).map((one) => ({...one})));
        for (const object of objects) {
            this.objects = [...this.objects.filter(({id}) => id !== object.id), new PlacedObject(object)];
        }
        for (const light of lights) {
            const old = this.lights.find(({id}) => id === light.id);
            if (old) {
                // Where nothing is known of it any more, the message does not have it.
                delete old.colourRendering;
                delete old.colourRenderingMost;
                Object.assign(old, light);
            } else {
                this.lights.push({...light});
            }
        }
        if (removeObject) {
            this.goneNames.set(`object ${removeObject.object}`, this.object(removeObject.object)?.name ?? '');
            this.objects = this.objects.filter(({id}) => id !== removeObject.object);
        }
        if (removeLight) {
            const light = this.lights.find(({id}) => id === removeLight.light);
            this.goneNames.set(`light ${removeLight.light}`, light?.name ?? '');
            this.lights = this.lights.filter(({id}) => id !== removeLight.light);
        }
    }

    /** @param {import('../net/scene_types.js').SetDaylight | undefined} change */
    #applyDaylight(change) {
        if (change) {
            const {lights = [], ...daylight} = change;
            const first = lights[0]?.id ?? Infinity;
            this.daylight = daylight;
            this.lights = [...this.lights.filter(({id}) => id < first), ...lights.map((light) => ({...light}))];
        }
    }

    /** @param {import('../net/scene_types.js').SetMaterial | undefined} change */
    #applyMaterial(change) {
        const material = this.materials.find(({id}) => id === change?.material);
        if (material && change) {
            material.baseColour = change.baseColour ?? material.baseColour;
            material.roughness = change.roughness ?? material.roughness;
            material.metallic = change.metallic ?? material.metallic;
        }
    }
}
