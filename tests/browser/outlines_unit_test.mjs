// SPDX-License-Identifier: Apache-2.0
// Outlines of zones and cells of grids in the picture.

import assert from 'node:assert/strict';
import {describe, it} from 'node:test';

import {GLARE_LIMITS, glareColour, gridCells, nameSpot, partBeforeEye, pathOf, zoneLabel} from '../../client_web/measure/outlines.js';
import {vec3} from '../../client_web/ui/vector.js';

/** An eye at 0 that looks along -z. */
const place = ({x, y, z}) => ({x: (100 * x) / -z, y: (-100 * y) / -z, depth: -z});
const at = (x, y) => ({x, y, depth: 1});

describe('an outline in the picture', () => {
    const square = [vec3(-1, -1, -2), vec3(1, -1, -2), vec3(1, -1, -4), vec3(-1, -1, -4)];

    it('is whole before the eye', () => {
        assert.deepEqual(partBeforeEye(square, place).map(({x}) => x), [-50, 50, 25, -25]);
    });

    it('is cut where it reaches behind the eye', () => {
        const around = square.map(({x, y, z}) => vec3(x, y, z + 3));
        const corners = partBeforeEye(around, place);
        assert.equal(corners.length, 4);
        for (const {x, y, depth} of corners) {
            assert.ok(depth > 0.019 && Number.isFinite(x) && y > 0, `${x} ${y} ${depth}`);
        }
        assert.equal(corners.filter(({depth}) => depth < 0.0201).length, 2);
        assert.equal(pathOf(partBeforeEye(around.map(({x, y, z}) => vec3(x, y, z + 3)), place)), '');
    });

    it('has its name over its uppermost edge, within the picture', () => {
        const corners = [at(100, 200), at(300, 200), at(280, 100), at(120, 100)];
        assert.deepEqual(nameSpot(corners, 400, 300), {x: 200, y: 94});
        assert.deepEqual(nameSpot(corners.map(({x, y}) => at(x, y - 98)), 400, 300), {x: 200, y: 16});
        assert.equal(nameSpot(corners.map(({x, y}) => at(x + 400, y)), 400, 300), null);
        assert.equal(nameSpot([], 400, 300), null);
    });

    it('is named with a sign that does without colour', () => {
        assert.equal(zoneLabel({name: 'Desk', verdict: 'MET'}), '✓ Desk');
        assert.equal(zoneLabel({name: 'Desk', verdict: 'NOT_YET_KNOWN'}), '? Desk');
        assert.equal(zoneLabel({name: 'Desk'}), 'Desk');
        const long = zoneLabel({name: '🙂'.repeat(64), verdict: 'MISSED'});
        assert.equal(long, `✗ ${'🙂'.repeat(27)}…`);
    });
});

describe('a grid in the picture', () => {
    const outline = [vec3(0, 1, 0), vec3(4, 1, 0), vec3(4, 1, 2), vec3(0, 1, 2)];

    it('has a cell around each point', () => {
        const points = [1, 3].map((x) => ({position: vec3(x, 1, 1)}));
        const cells = gridCells({columns: 2, rows: 1, points, outline});
        assert.deepEqual(cells[1], [vec3(2, 1, 0), vec3(4, 1, 0), vec3(4, 1, 2), vec3(2, 1, 2)]);
        points.forEach(({position}, i) => {
            const middle = (key) => cells[i].reduce((sum, corner) => sum + corner[key] / 4, 0);
            assert.deepEqual(vec3(middle('x'), middle('y'), middle('z')), position);
        });
        assert.deepEqual(gridCells({columns: 0, rows: 0, points, outline}), []);
        assert.deepEqual(gridCells({columns: 2, rows: 1, points}), []);
    });

    it('is darker where it glares more', () => {
        const lightness = (rating) => Number(/(\d+)%\)$/.exec(glareColour(rating))[1]);
        const all = [0, ...GLARE_LIMITS.map((limit) => limit + 0.1)].map(lightness);
        assert.ok(all.every((value, i) => i === 0 || value < all[i - 1]), all.join(' '));
        assert.equal(glareColour(19), glareColour(16.1));
    });
});
