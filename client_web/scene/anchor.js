// SPDX-License-Identifier: Apache-2.0
// What lies on an object goes where that goes.

/**
 * @typedef {import('../net/scene_types.js').Vec3} Vec3
 * @typedef {import('./scene_model.js').PlacedObject} PlacedObject
 * @typedef {import('./scene_model.js').SceneModel} SceneModel
 */

/** Holds what has been laid on an object, which carries it along. */
export class Anchor {
    /** @param {PlacedObject | null | undefined} object  null: what stays where it is */
    constructor(object) {
        this.object = object?.id ?? 0;
        this.since = object?.transform ?? null;
    }

    /**
     * How points that were laid then have moved.
     *
     * @param {SceneModel | null} scene  now
     * @returns {(point: Vec3) => Vec3}
     */
    carry(scene) {
        const object = scene?.object(this.object);
        return object && this.since ? object.carriedSince(this.since) : (point) => point;
    }
}
