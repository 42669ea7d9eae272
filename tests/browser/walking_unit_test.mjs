// SPDX-License-Identifier: Apache-2.0
// Walking among cells, plans and sections, doors and hinges, lists of big models, materials: their maths.

import assert from 'node:assert/strict';
import {describe, it} from 'node:test';

import {project} from '../../client_web/camera/camera.js';
import {luminance} from '../../client_web/measure/colour.js';
import {swung} from '../../client_web/scene/doors.js';
import {byName, glossWord, reflecting} from '../../client_web/scene/material_card.js';
import {DarkViews} from '../../client_web/camera/lost.js';
import {byStorey, matches} from '../../client_web/scene/object_list.js';
import {isHinge} from '../../client_web/scene/placement.js';
import {planOf, sectionOf} from '../../client_web/camera/plans.js';
import {PlacedObject, SceneModel} from '../../client_web/scene/scene_model.js';
import {length, sub, vec3} from '../../client_web/ui/vector.js';
import {WalkGrid, Walker} from '../../client_web/camera/walk_grid.js';

const CELL = 0.1;
const LAYER = 0.05;

/** Cells about (0, 1.6, 0), of what a function says is solid. */
function gridOf(solid, floor = undefined) {
    const origin = vec3(-3.2, -0.8, -3.2);
    const bytes = new Uint8Array(8 * 64 * 64);
    for (let z = 0; z < 64; ++z) {
        for (let x = 0; x < 64; ++x) {
            for (let k = 0; k < 64; ++k) {
                const at = vec3(origin.x + (x + 0.5) * CELL, origin.y + (k + 0.5) * LAYER, origin.z + (z + 0.5) * CELL);
                if (solid(at)) {
                    bytes[8 * (z * 64 + x) + (k >> 3)] |= 1 << (k & 7);
                }
            }
        }
    }
    return new WalkGrid({origin, cell: CELL, layer: LAYER, columns: 64, layers: 64, floor, occupied: btoa(String.fromCharCode(...bytes))});
}

const floor = ({y}) => y < 0;
const start = vec3(0, 1.6, 0);

function walked(grid, ...ways) {
    const walker = new Walker();
    walker.stand(grid, start);
    return ways.reduce((eye, [x, z]) => walker.walk(grid, eye, {x, z}), start);
}

describe('who walks', () => {
    it('is stopped by a wall, and slides along it', () => {
        const grid = gridOf((at) => floor(at) || (at.x > 1 && at.x < 1.1));
        const straight = walked(grid, [2, 0]);
        assert.ok(straight.x > 0.7 && straight.x < 0.85, `${straight.x}`);
        const along = walked(grid, [1.5, 1.5]);
        assert.ok(along.x < 0.85 && along.z > 1.2, JSON.stringify(along));
    });

    it('is stopped by a table, but not by a rug or a lintel', () => {
        const table = gridOf((at) => floor(at) || (at.x > 1 && at.x < 2 && at.y > 0.7 && at.y < 0.75));
        assert.ok(walked(table, [2.5, 0]).x < 0.85);
        const rug = gridOf((at) => at.y < (at.x > 1 ? 0.05 : 0) || (at.x > 1 && at.y > 2.1));
        assert.ok(walked(rug, [2.5, 0]).x > 2.4);
    });

    it('goes through a doorway 80 cm wide, and not through a gap of 30 cm', () => {
        const wall = (half) => gridOf((at) => floor(at) || (at.x > 1 && at.x < 1.2 && Math.abs(at.z) > half));
        assert.ok(walked(wall(0.4), [2.5, 0]).x > 2.4);
        assert.ok(walked(wall(0.12), [2.5, 0]).x < 0.9);
    });

    it('climbs stairs and comes down again, eyes as high above the floor as before', () => {
        const stairs = gridOf(({x, y}) => y < (x > 0.5 ? Math.min(0.175 * Math.ceil((x - 0.5) / 0.28), 0.7) : 0));
        const up = walked(stairs, [2.8, 0]);
        assert.ok(Math.abs(up.y - 2.3) < 0.06, `${up.y}`);
        const down = walked(stairs, [2.8, 0], [-2.8, 0]);
        assert.ok(Math.abs(down.y - 1.6) < 0.06 && Math.abs(down.x) < 0.1, JSON.stringify(down));
    });

    it('is not stopped where he stands in something already', () => {
        const grid = gridOf((at) => floor(at) || at.x > -0.5);
        assert.ok(walked(grid, [-2, 0]).x < -1.5);
    });

    it('goes along a wall or off it, but not through, when cells made anew have it nearer than he may come', () => {
        const grid = gridOf((at) => floor(at) || (at.x > 0.1 && at.x < 0.3));
        assert.ok(walked(grid, [1, 0], [1, 0]).x < 0.01);
        assert.ok(walked(grid, [0.5, 0.5]).x < 0.01);
        assert.ok(walked(grid, [0, 1]).z > 0.99);
        assert.ok(walked(grid, [-1, 0]).x < -0.99);
        assert.ok(grid.reached(start, vec3(2, 1.6, 0)).x < 0.01, 'the wheel');
        assert.deepEqual(grid.reached(start, vec3(-2, 1.6, 0)), vec3(-2, 1.6, 0));
    });

    it('flies through no wall with the wheel either', () => {
        const grid = gridOf((at) => floor(at) || (at.x > 1 && at.x < 1.1));
        assert.ok(grid.reached(start, vec3(2.5, 1.6, 0)).x < 0.9);
        assert.deepEqual(grid.reached(start, vec3(-2, 1.6, 0)), vec3(-2, 1.6, 0));
    });
});

describe('what is under an eye', () => {
    const terrace = gridOf(({x, y}) => y < (x > 1 ? -0.4 : 0.03), 0.03);

    it('is exact where the cells were asked for, and follows them elsewhere', () => {
        assert.equal(terrace.under(start), 0.03);
        assert.ok(Math.abs(terrace.under(vec3(-1, 1.7, 0.5)) - 0.03) < 1e-9, 'the same floor');
        assert.ok(Math.abs(terrace.under(vec3(2, 1.6, 0)) + 0.4) <= LAYER, 'down the step');
    });

    it('is known high above it, and of nothing else', () => {
        const high = gridOf(() => false, -12.5);
        assert.equal(high.under(start), -12.5);
        assert.equal(high.under(vec3(30, 1.6, 0)), null, 'beyond the cells');
        assert.equal(gridOf(() => false).under(start), null, 'nothing is below');
    });
});

describe('the way back', () => {
    const VIEW = {eye: start, target: vec3(1, 1.6, 0), up: vec3(0, 1, 0), verticalFov: 0.8};

    it('never leads behind a wall, and stays until the view is right', () => {
        const views = new DarkViews();
        const behind = {...VIEW, eye: vec3(9, 1.6, 0)};
        assert.equal(views.seen(VIEW, false, true), 'take back');
        assert.equal(views.seen(behind, true, false), 'tell');
        // The sky is bright, but this is still the outside of the room.
        assert.equal(views.seen({...behind, target: vec3(9, 9, 9)}, false, false), 'nothing');
        assert.equal(views.good, VIEW);
        assert.equal(views.seen(VIEW, false, true), 'take back');
    });
});

describe('plans and sections', () => {
    const bounds = {min: vec3(0, 0, 0), max: vec3(10, 3, 6)};

    it('show the whole, without perspective to speak of, from the cut on', () => {
        const plan = planOf(bounds, 1.5);
        const at = (point) => project(plan, 1.5, point);
        const near = at(vec3(10, 1.2, 6));
        const far = at(vec3(10, 0, 6));
        assert.ok(near.x < 1 && near.x > 0.9 && near.y < 1);
        assert.ok(Math.abs(near.x - far.x) < 0.002);
        assert.ok(Math.abs(near.depth - plan.near) < 1e-6 * plan.near, 'cut 1.2 m above the floor');
        assert.ok(at(vec3(5, 2.9, 3)).depth < plan.near, 'the ceiling is cut away');
        const tall = {min: vec3(0, -1.5, 0), max: vec3(10, 7, 6)};
        const upstairs = planOf(tall, 1.5, 3);
        assert.ok(Math.abs(upstairs.eye.y - upstairs.near - 4.2) < 1e-6, 'of the floor on which one stands');
    });

    it('look across at what is chosen', () => {
        const section = sectionOf(bounds, vec3(5, 1, 2), 'z', 1.5);
        assert.ok(Math.abs(project(section, 1.5, vec3(1, 1, 2)).depth - section.near) < 1e-6 * section.near);
        assert.ok(project(section, 1.5, vec3(1, 1, 5)).depth < section.near);
        assert.ok(project(section, 1.5, vec3(1, 2.9, 1)).y < project(section, 1.5, vec3(1, 0.1, 1)).y);
    });
});

const DOOR = {
    id: 3, name: 'Tür', movable: true, kind: 'DOOR', transform: {translation: vec3(1, 0, 2)},
    bounds: {min: vec3(1, 0, 1.98), max: vec3(1.9, 2, 2.02)},
};

describe('doors and hinges', () => {
    it('turn about their origin where that is at their edge, else about their middle', () => {
        assert.ok(isHinge(DOOR.bounds, vec3(1, 0, 2)));
        assert.ok(!isHinge(DOOR.bounds, vec3(1.45, 0, 2)));
        assert.ok(!isHinge(DOOR.bounds, vec3(0, 0, 0)));
        assert.deepEqual(new PlacedObject(DOOR).pivot, vec3(1, 0, 2));
        const chair = new PlacedObject({...DOOR, kind: 'THING', transform: {}});
        assert.equal(chair.pivot.x, 1.45);
        // The leaf of a file that has all origins at zero hangs at an end.
        assert.equal(new PlacedObject({...DOOR, transform: {}}).pivot.x, 1);
    });

    it('open away from who looks, and close to where they were', () => {
        for (const z of [0, 4]) {
            const door = new PlacedObject(DOOR);
            door.place(swung(door, vec3(1.4, 1.6, z)));
            const middle = (door.bounds.min.z + door.bounds.max.z) / 2;
            assert.ok(z === 0 ? middle > 2.3 : middle < 1.7, `${middle}`);
            assert.ok(length(sub(door.pivot, vec3(1, 0, 2))) < 1e-9);
            door.place(swung(door, vec3(1.4, 1.6, z)));
            assert.ok(length(sub(door.transform.translation, vec3(1, 0, 2))) < 1e-9);
            assert.equal(door.transform.rotation.w, 1);
        }
    });

    it('turn about another place, once somebody has said so, wherever they are', () => {
        const door = new PlacedObject(DOOR);
        door.pivot = vec3(1.9, 0, 2);
        door.place({translation: vec3(2, 0, 2)});
        assert.ok(length(sub(door.pivot, vec3(2.9, 0, 2))) < 1e-9);
    });
});

describe('big models', () => {
    const object = (id, name, storey, kind = 'THING', y = 0) => ({
        id, name, storey, kind, movable: true, transform: {}, bounds: {min: vec3(0, y, 0), max: vec3(1, y + 1, 1)},
    });
    const objects = [object(1, 'Wall, EG', 'EG', 'STRUCTURE'), object(2, 'chair', 'OG', 'THING', 3), object(3, 'sofa', '')];

    it('are searched by words, and grouped by storey from below', () => {
        assert.deepEqual(objects.filter((one) => matches(one, 'eg wall')).map(({id}) => id), [1]);
        assert.deepEqual(objects.filter((one) => matches(one, 'structure')).map(({id}) => id), [1]);
        const {storeys} = new SceneModel({name: 'a', bounds: objects[0].bounds, objects: [...objects].reverse()}, 0);
        assert.deepEqual([...storeys.keys()], ['EG', 'OG']);
        assert.equal(storeys.get('OG').min.y, 3);
        assert.deepEqual(byStorey(objects, storeys.keys()).map(([name, all]) => [name, all.length]), [['EG', 1], ['OG', 1], ['', 1]]);
    });

    it('are not moved by accident', () => {
        const wall = new PlacedObject(objects[0]);
        assert.ok(!wall.loose && new PlacedObject(objects[1]).loose);
        wall.unlocked = true;
        assert.ok(wall.loose);
    });
});

describe('materials', () => {
    it('of one name are one', () => {
        const groups = byName([{id: 1, name: 'oak'}, {id: 2, name: ''}, {id: 3, name: 'oak'}, {id: 4, name: ''}]);
        assert.deepEqual(groups.map((group) => group.map(({id}) => id)), [[1, 3], [2], [4]]);
    });

    it('have a reflectance that can be set, and keep their hue as far as that goes', () => {
        const red = vec3(0.6, 0.2, 0.1);
        for (const share of [0, 0.1, 0.5, 0.9, 1]) {
            const colour = reflecting(red, share);
            assert.ok(Math.abs(luminance(colour) - share) < 1e-9);
            assert.ok(Math.max(colour.x, colour.y, colour.z) <= 1 + 1e-9 && colour.x >= colour.y);
        }
        assert.deepEqual(reflecting(vec3(0, 0, 0), 0.3), vec3(0.3, 0.3, 0.3));
    });

    it('say in words how they shine', () => {
        assert.equal(glossWord(0.1), '0.10 glossy');
        assert.equal(glossWord(1), '1.00 nearly matt');
        assert.equal(glossWord(undefined), '–');
    });
});
