// SPDX-License-Identifier: Apache-2.0
// Which object lies under the pointer: asked of the server by a probe, which sees the true
// surfaces, or judged by the objects' bounds where the server does not offer probes.

import {ServerError} from '../net/protocol.js';
import {diagonal, intersectBounds} from '../ui/vector.js';

/**
 * @typedef {import('../ui/vector.js').Ray} Ray
 * @typedef {import('./scene_model.js').SceneModel} SceneModel
 * @typedef {import('./scene_model.js').PlacedObject} PlacedObject
 * @typedef {import('../net/raybundle_client.js').RaybundleClient} RaybundleClient
 */

/**
 * Object whose bounds a ray meets. Movable objects come before the shell around them, the nearest
 * first; of what cannot be moved, the smallest.
 *
 * @param {PlacedObject[]} objects
 * @param {Ray} ray
 * @returns {PlacedObject | null}
 */
export function pickByBounds(objects, ray) {
    /** @type {{object: PlacedObject, rank: number}[]} */
    const met = [];
    for (const object of objects) {
        const hit = intersectBounds(ray, object.bounds);
        if (hit) {
            const rank = object.movable ? Math.max(hit.enter, 0) : diagonal(object.bounds);
            met.push({object, rank});
        }
    }
    met.sort((a, b) => Number(b.object.movable) - Number(a.object.movable) || a.rank - b.rank);
    return met[0]?.object ?? null;
}

/** Picks objects in the scene of a connection. */
export class Picker {
    /** @param {RaybundleClient} client */
    constructor(client) {
        this.client = client;
        this.probes = true;
        /** Of what has been picked last; null: not known. @type {number | null} */
        this.material = null;
        client.addEventListener('welcome', () => {
            this.probes = true;
            this.material = null;
        });
    }

    /**
     * @param {SceneModel} scene
     * @param {Ray} ray
     * @param {{x: number, y: number}} pixel  that the ray goes through, of the viewer's picture
     * @returns {Promise<PlacedObject | null>}
     */
    async pick(scene, ray, pixel) {
        if (this.probes) {
            try {
                const {probeResult} = await this.client.request({probe: {pixel}}).answer;
                this.material = probeResult?.material ?? null;
                return scene.object(probeResult?.object);
            } catch (error) {
                this.probes = !(error instanceof ServerError && error.code === 'UNIMPLEMENTED');
            }
        }
        return pickByBounds(scene.objects, ray);
    }
}
