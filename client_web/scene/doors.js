// SPDX-License-Identifier: Apache-2.0
// Doors: a double click opens them about their hinge, away from who looks, and closes them again.

import {turnBetween, turnedAbout} from './placement.js';
import {length, sub} from '../ui/vector.js';

/**
 * @typedef {import('../net/scene_types.js').Vec3} Vec3
 * @typedef {import('../net/scene_types.js').Transform} Transform
 * @typedef {import('./scene_model.js').PlacedObject} PlacedObject
 */

/** How far doors open, radians. */
const OPEN = Math.PI / 2;
/** A door that is turned by less is closed, radians. */
const AJAR = 0.05;

/**
 * Where a door goes that somebody opens or closes.
 *
 * @param {PlacedObject} door
 * @param {Vec3} eye  of who does it
 * @returns {Required<Transform>}
 */
export function swung(door, eye) {
    const {transform, original, pivot, worldFromParent} = door;
    if (Math.abs(turnBetween(original.rotation, transform.rotation)) > AJAR) {
        return original;
    }
    const opened = [OPEN, -OPEN].map((angle) => turnedAbout(transform, pivot, angle, worldFromParent));
    const [left, right] = opened.map((place) => length(sub(door.centreAt(place), eye)));
    return opened[left >= right ? 0 : 1];
}
