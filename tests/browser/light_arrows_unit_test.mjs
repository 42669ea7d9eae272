// SPDX-License-Identifier: Apache-2.0
// Arrows of light direction: vectors from six illuminances, lengths, and paths in the picture.

import assert from 'node:assert/strict';
import {describe, it} from 'node:test';

import {arrowPath, arrowPoints, arrowRequest, lightArrows, lightVectors} from '../../client_web/measure/light_arrows.js';
import {length, sub, vec3} from '../../client_web/ui/vector.js';

/** Illuminances of the six planes at a point under a lamp, of `lux` from a unit direction, in a glow of 50 lx from all sides. */
const answerOf = (points, lux, direction) => ({
    points: arrowRequest(points).points.map(({position, normal}) => ({
        position,
        inside: false,
        value: 50 + lux * Math.max(normal.x * direction.x + normal.y * direction.y + normal.z * direction.z, 0),
    })),
});

describe('arrows of light', () => {
    const points = [vec3(0, 1, 0), vec3(1, 1, 0), vec3(0, 1, 1), vec3(1, 1, 1)];

    it('are light vectors: what comes from all sides alike does not count', () => {
        const direction = vec3(0.6, 0.8, 0);
        const vectors = lightVectors(answerOf(points, 300, direction));
        assert.equal(vectors.length, 4);
        assert.ok(length(sub(vectors[2].vector, vec3(180, 240, 0))) < 1e-9);
        assert.deepEqual(vectors[2].position, points[2]);
    });

    it('end at their points, the longest a little longer than from point to point', () => {
        const answer = answerOf(points, 300, vec3(0, 1, 0));
        for (const point of answer.points.slice(6)) {
            point.value = 50;  // nothing from anywhere on balance
        }
        const {arrows, most} = lightArrows(answer);
        assert.ok(Math.abs(most - 300) < 1e-9);
        assert.deepEqual(arrows[0].to, points[0]);
        assert.ok(length(sub(arrows[0].from, vec3(0, 2.2, 0))) < 1e-9);
        assert.ok(length(sub(arrows[1].from, points[1])) < 1e-9);
        assert.deepEqual(lightArrows({points: []}), {arrows: [], most: 0});
    });

    it('leave out what is not known yet', () => {
        const answer = answerOf(points, 300, vec3(0, 1, 0));
        delete answer.points[7].value;
        assert.equal(lightVectors(answer).length, 3);
    });

    it('are asked for at most as many as a measurement holds, spread evenly', () => {
        const many = Array.from({length: 4096}, (_, i) => ({position: vec3(i, 0, 0), inside: i % 2 === 1}));
        const chosen = arrowPoints([{points: many}]);
        assert.ok(chosen.length > 600 && chosen.length <= 683, `${chosen.length}`);
        assert.ok(arrowRequest(chosen).points.length <= 4096);
        assert.ok(chosen.at(-1).x > 4000);
        assert.ok(chosen.every(({x}) => x % 2 === 0));
        assert.equal(arrowPoints([{points: many.slice(0, 10)}, {points: many.slice(0, 4)}]).length, 7);
    });

    it('have a head in the picture, and none where they point at the eye', () => {
        assert.equal(arrowPath({x: 10, y: 10}, {x: 11, y: 10}), '');
        assert.equal(arrowPath({x: 0, y: 0}, {x: 100, y: 0}), 'M0.0 0.0L100.0 0.0M93.0 3.1L100.0 0.0L93.0 -3.1');
    });
});
