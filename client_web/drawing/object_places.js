// SPDX-License-Identifier: Apache-2.0
// Where objects have gone since their vertices were written down.

import {IDENTITY, completeTransform} from '../ui/vector.js';

/** @typedef {import('../scene/scene_model.js').PlacedObject} PlacedObject */

/** Single precision, in which the server sends transforms: their products differ by a few of its steps. */
const SAME = 8 * 2 ** -24;

/**
 * Product of affine 4x4 matrices, column by column.
 *
 * @param {ArrayLike<number>} a
 * @param {ArrayLike<number>} b
 * @returns {number[]}
 */
export function product(a, b) {
    return Array.from({length: 16}, (_, i) => {
        const [column, row] = [i >> 2, i & 3];
        return [0, 1, 2, 3].reduce((sum, k) => sum + a[4 * k + row] * b[4 * column + k], 0);
    });
}

/**
 * @param {ArrayLike<number>} m  affine 4x4 matrix, column by column
 * @returns {number[] | null}  null: it cannot be inverted
 */
export function inverse(m) {
    const minor = (/** @type {number} */ row, /** @type {number} */ column) => {
        const [r0, r1] = [0, 1, 2].filter((i) => i !== row);
        const [c0, c1] = [0, 1, 2].filter((i) => i !== column);
        const value = m[4 * c0 + r0] * m[4 * c1 + r1] - m[4 * c1 + r0] * m[4 * c0 + r1];
        return (row + column) % 2 ? -value : value;
    };
    const determinant = [0, 1, 2].reduce((sum, column) => sum + m[4 * column] * minor(0, column), 0);
    const turned = Array.from({length: 9}, (_, i) => minor(Math.floor(i / 3), i % 3) / determinant);
    if (!turned.every(Number.isFinite)) {
        return null;
    }
    const shift = [0, 1, 2].map((row) =>
        -[0, 1, 2].reduce((sum, column) => sum + turned[3 * column + row] * m[12 + column], 0));
    return [
        turned[0], turned[1], turned[2], 0,
        turned[3], turned[4], turned[5], 0,
        turned[6], turned[7], turned[8], 0,
        shift[0], shift[1], shift[2], 1,
    ];
}

/**
 * @param {import('../net/scene_types.js').Transform} transform
 * @returns {number[]}  4x4, column by column
 */
export function matrixOf(transform) {
    const {translation: t, rotation: {x, y, z, w}, scale: s} = completeTransform(transform);
    const n = 2 / (x * x + y * y + z * z + w * w);
    return [
        s.x * (1 - n * (y * y + z * z)), s.x * n * (x * y + w * z), s.x * n * (x * z - w * y), 0,
        s.y * n * (x * y - w * z), s.y * (1 - n * (x * x + z * z)), s.y * n * (y * z + w * x), 0,
        s.z * n * (x * z + w * y), s.z * n * (y * z - w * x), s.z * (1 - n * (x * x + y * y)), 0,
        t.x, t.y, t.z, 1,
    ];
}

/**
 * From where an object's vertices are to where it stands now.
 *
 * @param {PlacedObject} object
 * @param {number[]} worldFromObject  that its vertices were placed by
 * @returns {Float32Array | null}  null: there is nothing to draw, or its vertices, which were all in one plane, do not tell
 *     what it looks like there
 */
export function placeOf(object, worldFromObject) {
    const now = product(object.worldFromParent, matrixOf(object.transform));
    if (!now.every(Number.isFinite)) {
        return null;
    }
    const back = inverse(worldFromObject);
    if (back) {
        return new Float32Array(product(now, back));
    }
    const turned = (/** @type {number} */ i) => i % 4 < 3 && i < 12;
    const largest = Math.max(...worldFromObject.filter((_, i) => turned(i)).map(Math.abs));
    if (now.some((value, i) => turned(i) && Math.abs(value - worldFromObject[i]) > SAME * largest)) {
        return null;
    }
    const place = new Float32Array(IDENTITY);
    for (const i of [12, 13, 14]) {
        place[i] = now[i] - worldFromObject[i];
    }
    return place;
}

/**
 * Places all objects of a drawing, and hides those that have been removed.
 *
 * @param {Pick<import('../walkthrough/renderer.js').Renderer, 'manifest' | 'setPlace' | 'hidden'>} renderer
 * @param {import('../scene/scene_model.js').SceneModel} scene
 * @param {Iterable<number>} hidden  ids of objects that are not shown
 */
export function placeObjects(renderer, scene, hidden) {
    const absent = new Set([...hidden].map((id) => id - 1));
    renderer.manifest.objects?.forEach(({worldFromObject}, i) => {
        const object = scene.object(i + 1);
        const place = object && placeOf(object, worldFromObject);
        if (place) {
            renderer.setPlace(i, place);
        } else {
            absent.add(i);
        }
    });
    renderer.hidden = absent;
}
