// SPDX-License-Identifier: Apache-2.0
// Depths that come with frames, and where they put the last picture under another camera.

import assert from 'node:assert/strict';
import {describe, it} from 'node:test';
import {deflateSync} from 'node:zlib';

import {look, project, rayThrough, walk} from '../../client_web/camera/camera.js';
import {clipFromPicture, gridTriangles} from '../../client_web/picture/depth_warp.js';
import {decodeDepths} from '../../client_web/picture/depths.js';
import {add, scale} from '../../client_web/ui/vector.js';

/**
 * Depths as the server packs them (server/stream/depth_code.cpp).
 *
 * @param {number[]} values  0..65535, row by row
 * @param {number} columns
 */
function packed(values, columns) {
    const bytes = new Uint8Array(2 * values.length);
    values.forEach((value, i) => {
        const first = i % columns === 0;
        const left = first ? 0 : values[i - 1];
        const above = i < columns ? 0 : values[i - columns];
        const corner = first || i < columns ? 0 : values[i - columns - 1];
        const difference = ((value - left - above + corner) << 16) >> 16;
        const zigzag = ((difference << 1) ^ (difference >> 15)) & 0xffff;
        bytes[i] = zigzag & 255;
        bytes[values.length + i] = zigzag >> 8;
    });
    return new Uint8Array(deflateSync(bytes));
}

const header = (columns, rows, nearest) => ({
    depthColumns: columns,
    depthRows: rows,
    depthNearest: nearest,
});

describe('depths of a frame', () => {
    it('come out as they went in, up to the last bit', async () => {
        const values = [65535, 0, 1, 40000, 65535, 65535, 0, 32768, 12345, 7, 0, 65534];
        const depths = await decodeDepths(header(4, 3, 0.5), packed(values, 4));
        assert.equal(depths.columns, 4);
        assert.equal(depths.rows, 3);
        values.forEach((value, i) => {
            assert.ok(Math.abs(depths.inverse[i] - value / 65535 / 0.5) < 1e-6, `point ${i}`);
        });
    });

    it('are refused where they are damaged or of another size', async () => {
        const good = packed([1, 2, 3, 4], 2);
        const wrong = [
            [header(2, 3, 1), good],
            [header(2, 2, 1), packed([1, 2, 3, 4, 5, 6], 2)],
            [header(1, 4, 1), good],
            [header(60000, 60000, 1), good],
            [header(2, 2, -1), good],
            [header(2, 2, 1), good.slice(0, 6)],
            [header(2, 2, 1), new Uint8Array([1, 2, 3])],
            [{}, good],
        ];
        for (const [figures, bytes] of wrong) {
            await assert.rejects(decodeDepths(figures, bytes));
        }
    });
});

describe('the last picture by its depths', () => {
    const shown = {
        eye: {x: 1, y: 1.6, z: 5},
        target: {x: 0, y: 1, z: 0},
        up: {x: 0, y: 1, z: 0},
        verticalFov: 0.8,
    };
    const aspect = 1.5;

    /** Where a point of the old picture, at a depth, is drawn: normalised, and its depth buffer's value. */
    const drawn = (view, newAspect, u, v, inverse, near = 0.01) => {
        const m = clipFromPicture(shown, aspect, view, newAspect, near);
        const point = [u, v, 1, inverse];
        const [x, y, z, w] = [0, 1, 2, 3].map((row) =>
            point.reduce((sum, value, column) => sum + value * m[4 * column + row], 0),
        );
        return {x: 0.5 + (0.5 * x) / w, y: 0.5 - (0.5 * y) / w, z: z / w, w};
    };

    it('is the picture itself where the camera has not moved', () => {
        for (const inverse of [0, 0.1, 3]) {
            const {x, y} = drawn(shown, aspect, 0.2, 0.7, inverse);
            assert.ok(Math.abs(x - 0.2) < 1e-9 && Math.abs(y - 0.7) < 1e-9);
        }
    });

    it('is drawn where the camera sees its points', () => {
        const view = {...look(walk(shown, 1.2, -0.4, 0.3), 0.15, -0.1), verticalFov: 0.9};
        for (const [u, v, depth] of [[0.1, 0.2, 3], [0.5, 0.5, 7], [0.9, 0.8, 4], [0.3, 0.9, 40]]) {
            const ray = rayThrough(shown, aspect, u, v);
            const along = project(shown, aspect, add(ray.origin, ray.direction)).depth;
            const point = add(ray.origin, scale(ray.direction, depth / along));
            const wanted = project(view, 1.1, point);
            const {x, y} = drawn(view, 1.1, u, v, 1 / depth);
            assert.ok(Math.hypot(x - wanted.x, y - wanted.y) < 1e-9, `${u}, ${v} at ${depth} m`);
        }
    });

    it('only turns what is infinitely far away', () => {
        const view = walk(shown, 3, 1, 0);
        const {x, y} = drawn(view, aspect, 0.3, 0.4, 0);
        assert.ok(Math.hypot(x - 0.3, y - 0.4) < 1e-9);
    });

    it('puts what is nearer in front, and cuts off what is behind the eye', () => {
        const view = walk(shown, 1, 0, 0);
        const near = drawn(view, aspect, 0.5, 0.5, 1 / 2, 0.1);
        const far = drawn(view, aspect, 0.5, 0.5, 1 / 8, 0.1);
        assert.ok(near.z < far.z && near.z > -1 && far.z < 1);
        const passed = drawn(view, aspect, 0.5, 0.5, 1 / 0.5, 0.1);
        assert.ok(passed.w < 0);
        const atNear = drawn(shown, aspect, 0.5, 0.5, 1 / 0.1, 0.1);
        assert.ok(Math.abs(atNear.z + 1) < 1e-9);
    });

    it('covers its grid with triangles, each cell by two', () => {
        const indices = gridTriangles(3, 2);
        assert.deepEqual([...indices], [0, 3, 1, 1, 3, 4, 1, 4, 2, 2, 4, 5]);
    });
});
