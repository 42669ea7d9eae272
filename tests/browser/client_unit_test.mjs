// SPDX-License-Identifier: Apache-2.0
// The client's maths and bookkeeping, without a browser.

import assert from 'node:assert/strict';
import {describe, it} from 'node:test';

import * as camera from '../../client_web/camera/camera.js';
import {CameraControl, motionOf, walkingSpeed} from '../../client_web/camera/camera_control.js';
import {carried, grip, keptInside} from '../../client_web/scene/drag.js';
import {layOut} from '../../client_web/measure/error_plot.js';
import * as format from '../../client_web/ui/format.js';
import {ErrorHistory, RateMeter, Samples} from '../../client_web/measure/meters.js';
import {outlinePath, visibleEdges} from '../../client_web/picture/overlay.js';
import {pickByBounds} from '../../client_web/scene/picking.js';
import {fitViewport} from '../../client_web/picture/picture.js';
import {loadedLight, sameLight} from '../../client_web/lights/light_values.js';
import {snapshotSize} from '../../client_web/review/snapshot_panel.js';
import {progressText} from '../../client_web/review/snapshot_request.js';
import {retryDelay} from '../../client_web/net/raybundle_client.js';
import {SceneModel, movedBounds, shifted} from '../../client_web/scene/scene_model.js';
import * as vector from '../../client_web/ui/vector.js';

const {vec3} = vector;

const FRONT = {
    eye: vec3(2.75, 2.75, -7.5),
    target: vec3(2.75, 2.75, 2.75),
    up: vec3(0, 1, 0),
    verticalFov: 0.7,
};
const ROOM = {min: vec3(0, 0, 0), max: vec3(5.5, 5.5, 5.5)};
const BOX = {min: vec3(1, 0, 1), max: vec3(2, 1, 2)};
const STILL = {
    translation: vec3(0, 0, 0),
    rotation: {x: 0, y: 0, z: 0, w: 1},
    scale: vec3(1, 1, 1),
};

/** Asserts that two points are the same but for rounding. */
function near(actual, expected, tolerance = 1e-9) {
    const distance = vector.length(vector.sub(actual, expected));
    const text = `${JSON.stringify(actual)} is not ${JSON.stringify(expected)}`;
    assert.ok(distance <= tolerance, text);
}

function close(actual, expected, tolerance = 1e-9) {
    assert.ok(Math.abs(actual - expected) <= tolerance, `${actual} is not ${expected}`);
}

describe('a transform of a node', () => {
    const turned = {translation: vec3(1, 2, 3), rotation: {x: 0, y: Math.SQRT1_2, z: 0, w: Math.SQRT1_2}};

    it('is undone by its inverse', () => {
        const transform = {...turned, scale: vec3(2, 0.5, -3)};
        near(vector.inverseTransformPoint(transform, vector.transformPoint(transform, vec3(4, 5, 6))), vec3(4, 5, 6));
    });

    it('that flattens has what is nearest for an inverse, and nothing infinite', () => {
        const flat = {...turned, scale: vec3(2, 0, 3)};
        near(vector.inverseTransformPoint(flat, vector.transformPoint(flat, vec3(4, 5, 6))), vec3(4, 0, 6));
        near(vector.inverseTransformPoint({scale: vec3(0, 0, 0)}, vec3(1, 1, 1)), vec3(0, 0, 0));
        const moved = movedBounds(BOX, flat, {...flat, translation: vec3(1, 2, 4)});
        assert.ok([moved.min, moved.max].every(({x, y, z}) => [x, y, z].every(Number.isFinite)), JSON.stringify(moved));
    });
});

describe('camera', () => {
    it('projects the target to the middle of the picture', () => {
        const {x, y, depth} = camera.project(FRONT, 1.5, FRONT.target);
        close(x, 0.5);
        close(y, 0.5);
        close(depth, 10.25);
    });

    it('sends rays through the points it projects', () => {
        for (const point of [vec3(0, 0, 0), vec3(5.5, 1, 5), vec3(3, 5, 1)]) {
            const {x, y} = camera.project(FRONT, 1.5, point);
            const ray = camera.rayThrough(FRONT, 1.5, x, y);
            near(ray.direction, vector.normalise(vector.sub(point, FRONT.eye)));
        }
    });

    it('shows +x on the left when it looks along +z', () => {
        assert.ok(camera.project(FRONT, 1, vec3(3, 2.75, 0)).x < 0.5);
    });

    it('reports what lies behind the eye by its depth', () => {
        assert.ok(camera.project(FRONT, 1, vec3(2.75, 2.75, -9)).depth < 0);
    });

    it('keeps distance and target in orbit, and stops short of the vertical', () => {
        const turned = camera.orbit(FRONT, 0.4, -9);
        near(turned.target, FRONT.target);
        close(vector.length(vector.sub(turned.eye, turned.target)), 10.25, 1e-6);
        assert.ok(camera.angles(turned).elevation > -Math.PI / 2);
        const {right} = camera.axes(turned);
        close(right.y, 0, 1e-9);
    });

    it('keeps the eye while looking around', () => {
        const turned = camera.look(FRONT, 0.3, 0.2);
        near(turned.eye, FRONT.eye);
        const [before, after] = [camera.angles(FRONT), camera.angles(turned)];
        const turn = after.heading - before.heading;
        close(Math.cos(turn), Math.cos(0.3));
        close(Math.sin(turn), Math.sin(0.3));
        close(after.elevation, 0.2);
    });

    it('walks on the level wherever it looks', () => {
        const down = camera.look(FRONT, 0, -0.8);
        const walked = camera.walk(down, 2, 0, 0);
        near(vector.sub(walked.eye, down.eye), vec3(0, 0, 2));
        const aside = camera.walk(FRONT, 0, 1, 0);
        near(vector.sub(aside.eye, FRONT.eye), vec3(-1, 0, 0));
    });

    it('takes the heading of a plan view from its up vector', () => {
        const plan = {...FRONT, eye: vec3(0, 9, 0), target: vec3(0, 0, 0), up: vec3(0, 0, 1)};
        near(vector.sub(camera.walk(plan, 1, 0, 0).eye, plan.eye), vec3(0, 0, 1));
    });

    it('comes no nearer than the target and goes no further than the limit', () => {
        const distance = (view) => vector.length(vector.sub(view.eye, view.target));
        assert.ok(distance(camera.dolly(FRONT, 1e-9, 50)) > 0);
        close(distance(camera.dolly(FRONT, 1e9, 50)), 50, 1e-6);
    });

    it('pans by heights of the picture', () => {
        const moved = camera.pan(FRONT, 0, 1);
        close(moved.eye.y - FRONT.eye.y, 2 * Math.tan(0.35) * 10.25);
    });

    it('flies from one view to another the short way round', () => {
        const away = {...camera.look(FRONT, 0.5, 0.1), verticalFov: 1};
        assert.equal(camera.between(FRONT, away, 1), away);
        assert.ok(camera.sameView(camera.between(FRONT, away, 1), away));
        near(camera.between(FRONT, away, 0).target, FRONT.target, 1e-6);
        const middle = camera.angles(camera.between(FRONT, away, 0.5)).heading;
        const turn = middle - camera.angles(FRONT).heading;
        close(Math.sin(turn), Math.sin(0.25), 1e-6);
    });

    it('widens the field of view on upright screens only', () => {
        close(camera.framedFov(0.7, 1.6), 0.7);
        close(camera.framedFov(0.7, 0.5), 2 * Math.atan(2 * Math.tan(0.35)));
        assert.ok(camera.framedFov(1.5, 0.1) < Math.PI);
    });

    it('reads held keys as motion, opposite keys cancelling', () => {
        assert.equal(motionOf(['KeyW', 'KeyS'], 'walk').forwards, 0);
        assert.equal(motionOf(['KeyW', 'ArrowUp'], 'walk').forwards, 1);
        assert.equal(motionOf(['ArrowUp'], 'orbit').tilt, -1);
        assert.equal(motionOf(['KeyX'], 'orbit').forwards, 0);
        assert.equal(walkingSpeed({min: vec3(0, 0, 0), max: vec3(900, 9, 900)}), 2);
    });
});

describe('a drag in Orbit', () => {
    const HOUSE = {min: vec3(0, 0, 0), max: vec3(20, 6, 12)};
    const STUDY = {min: vec3(4, 0, 4), max: vec3(9, 3, 8)};
    const SHELF = {min: vec3(5, 0, 5), max: vec3(6, 2, 7)};
    const INSIDE = {...FRONT, eye: vec3(8, 1.6, 7), target: vec3(5, 1, 5)};
    const scene = {
        bounds: HOUSE,
        objects: [
            {movable: false, bounds: STUDY},
            {movable: true, bounds: SHELF},
        ],
    };
    /** A camera that is where it flies to at once. */
    const controlAt = (view) => {
        globalThis.matchMedia = () => ({matches: true});
        const control = new CameraControl(view);
        control.fit(scene);
        return control;
    };
    const isIn = ({min, max}, {x, y, z}) =>
        x > min.x && x < max.x && y > min.y && y < max.y && z > min.z && z < max.z;

    it('knows the room that the eye is in, and furniture from rooms', () => {
        assert.equal(camera.roomAround(INSIDE.eye, HOUSE, [STUDY, SHELF]), STUDY);
        assert.equal(camera.roomAround(vec3(5.5, 1, 6), HOUSE, [STUDY, SHELF]), STUDY);
        assert.equal(camera.roomAround(vec3(15, 2, 6), HOUSE, [STUDY]), HOUSE);
        assert.equal(camera.roomAround(vec3(15, 2, -6), HOUSE, [STUDY]), null);
    });

    it('circles around what is looked at from outside', () => {
        const control = controlAt({...FRONT, eye: vec3(10, 4, -20), target: vec3(10, 2, 6)});
        assert.ok(control.circles);
        control.turn(0.3, 0.1);
        near(control.view.target, vec3(10, 2, 6));
        close(vector.length(vector.sub(control.view.eye, control.view.target)), Math.hypot(2, 26));
        // Also once the eye has come within the scene's bounds, and out again.
        control.turn(-0.3, 0.2);
        control.turn(0, -0.3);
        near(control.view.target, vec3(10, 2, 6));
    });

    it('looks around from inside a room: the eye stays', () => {
        const control = controlAt(INSIDE);
        assert.ok(!control.circles);
        for (const [x, y] of [[0.5, 0], [-2, 0.3], [0, -1]]) {
            control.turn(x, y);
            near(control.view.eye, INSIDE.eye);
        }
        control.set(INSIDE);
        control.turn(0.1, 0);
        const {heading} = camera.angles(INSIDE);
        close(camera.angles(control.view).heading - heading, 0.1 * INSIDE.verticalFov);
    });

    it('circles inside around what has been chosen, and never through a wall', () => {
        const control = controlAt(INSIDE);
        control.flyAround({...INSIDE, target: vec3(6.5, 0.8, 6)});
        assert.ok(control.circles);
        const first = vector.length(vector.sub(INSIDE.eye, vec3(6.5, 0.8, 6)));
        for (let i = 0; i < 60; ++i) {
            control.turn(0.05, i % 2 ? 0.1 : -0.1);
            const {eye, target} = control.view;
            near(target, vec3(6.5, 0.8, 6));
            assert.ok(isIn(STUDY, eye), JSON.stringify(eye));
            const away = vector.length(vector.sub(eye, target));
            assert.ok(away > 0.59 * first && away < 1.001 * first, `${away} of ${first}`);
        }
        control.set({...control.view, target: vec3(6, 1, 6)});
        assert.ok(!control.circles, 'another target has not been chosen');
    });

    it('looks around once the wheel has brought the eye inside', () => {
        const control = controlAt({...FRONT, eye: vec3(10, 4, -20), target: vec3(10, 2, 6)});
        control.turn(0.1, 0);
        assert.ok(control.circles);
        control.zoom(0.1);
        assert.ok(!control.circles);
        control.zoom(20);
        assert.ok(control.circles);
    });

    it('goes on from where another view has the same target', () => {
        const control = controlAt({...FRONT, eye: vec3(10, 4, -20), target: vec3(10, 2, 6)});
        control.turn(0.1, 0);
        control.set({...FRONT, eye: vec3(10, 4, -8), target: vec3(10, 2, 6)});
        control.turn(0.1, 0);
        close(vector.length(vector.sub(control.view.eye, control.view.target)), Math.hypot(2, 14));
    });

    it('frames a thing as far back as the walls let it', () => {
        const free = camera.framing(INSIDE, SHELF, 1.5, null);
        near(free.target, vector.centre(SHELF));
        for (const corner of vector.corners(SHELF)) {
            const {x, y, depth} = camera.project(free, 1.5, corner);
            assert.ok(depth > 0 && x > 0 && x < 1 && y > 0 && y < 1, JSON.stringify({x, y, depth}));
        }
        const kept = camera.framing(INSIDE, STUDY, 1.5, camera.spaceIn(STUDY, INSIDE.eye));
        assert.ok(isIn(STUDY, kept.eye), JSON.stringify(kept.eye));
    });

    it('has arrow keys that turn the head where it does', () => {
        assert.equal(motionOf(['ArrowUp'], 'look').tilt, 1);
        assert.equal(motionOf(['ArrowLeft'], 'look').left, 1);
        assert.equal(motionOf(['ArrowLeft'], 'orbit').left, -1);
    });
});

describe('boxes', () => {
    it('are entered and left by rays that meet them', () => {
        const ray = {origin: vec3(-1, 0.5, 1.5), direction: vec3(1, 0, 0)};
        assert.deepEqual(vector.intersectBounds(ray, BOX), {enter: 2, leave: 3});
    });

    it('are missed by rays beside them and by rays that point away', () => {
        const beside = {origin: vec3(-1, 3, 1.5), direction: vec3(1, 0, 0)};
        const away = {origin: vec3(-1, 0.5, 1.5), direction: vec3(-1, 0, 0)};
        assert.equal(vector.intersectBounds(beside, BOX), null);
        assert.equal(vector.intersectBounds(away, BOX), null);
    });

    it('enclose the eye with a negative entry', () => {
        const ray = {origin: vec3(1.5, 0.5, 1.5), direction: vec3(0, 0, 1)};
        assert.deepEqual(vector.intersectBounds(ray, BOX), {enter: -0.5, leave: 0.5});
    });

    it('move with a shift exactly, whatever the rotation', () => {
        const before = {...STILL, rotation: {x: 0, y: 0.6, z: 0, w: 0.8}, scale: vec3(2, 3, 4)};
        const after = shifted(before, vec3(1, 0, -2));
        const moved = movedBounds(BOX, before, after);
        near(moved.min, vec3(2, 0, -1));
        near(moved.max, vec3(3, 1, 0));
    });

    it('move along the world under a turned and scaled parent', () => {
        // Z up, in centimetres: the parent turns z to y and scales by 0.01.
        const parent = [0.01, 0, 0, 0, 0, 0, -0.01, 0, 0, 0.01, 0, 0, 5, 6, 7, 1];
        const after = shifted(STILL, vec3(1, 0, -2), parent);
        near(after.translation, vec3(100, 200, 0));
        const moved = movedBounds(BOX, STILL, after, parent);
        near(moved.min, vec3(2, 0, -1));
        near(moved.max, vec3(3, 1, 0));
    });

    it('show three faces, one face or all edges', () => {
        assert.equal(visibleEdges(BOX, vec3(9, 9, 9)).length, 9);
        assert.equal(visibleEdges(BOX, vec3(1.5, 0.5, 9)).length, 4);
        assert.equal(visibleEdges(BOX, vec3(1.5, 0.5, 1.5)).length, 12);
    });

    it('are drawn up to the eye and not behind it', () => {
        const view = {...FRONT, eye: vec3(1.5, 0.5, 1.2), target: vec3(1.5, 0.5, 9)};
        const path = outlinePath(BOX, view, 400, 300);
        assert.ok(path.startsWith('M') && !path.includes('NaN'));
        const behind = {...FRONT, target: vec3(2.75, 2.75, -99)};
        assert.equal(outlinePath(BOX, behind, 400, 300), '');
    });
});

describe('scene', () => {
    const scene = () => {
        const box = {id: 2, name: 'box', movable: true, bounds: BOX, transform: STILL};
        const room = {id: 1, name: '', movable: false, bounds: ROOM, transform: {}};
        return new SceneModel({name: 's', bounds: ROOM, objects: [room, box]}, 4);
    };
    const moved = {...STILL, translation: vec3(0.5, 0, 0)};
    const change = {epoch: 5, by: 7, moveObject: {object: 2, transform: moved}};

    it('follows announced moves', () => {
        const model = scene();
        model.apply(change, null);
        assert.equal(model.epoch, 5);
        near(model.object(2).bounds.min, vec3(1.5, 0, 1));
        near(model.object(2).shift, vec3(0.5, 0, 0));
    });

    it('leaves what is in the hand where it is, and remembers the place', () => {
        const model = scene();
        model.apply(change, 2);
        near(model.object(2).bounds.min, vec3(1, 0, 1));
        near(model.object(2).confirmed.translation, vec3(0.5, 0, 0));
    });

    it('takes unknown objects and nameless ones in its stride', () => {
        const model = scene();
        model.apply({epoch: 6, by: 0, moveObject: {object: 99, transform: STILL}}, null);
        assert.equal(model.epoch, 6);
        assert.equal(model.object(1).name, 'Object 1');
        assert.equal(model.object(null), null);
    });

    it('picks movable objects before the room around them', () => {
        const {objects} = scene();
        const through = (x, y, z) => ({origin: vec3(x, y, -9), direction: vec3(0, 0, z)});
        assert.equal(pickByBounds(objects, through(1.5, 0.5, 1))?.id, 2);
        assert.equal(pickByBounds(objects, through(4, 4, 1))?.id, 1);
        assert.equal(pickByBounds(objects, through(4, 4, -1)), null);
    });
});

describe('drag', () => {
    const rayTo = (view, point) => {
        const {x, y} = camera.project(view, 1.5, point);
        return camera.rayThrough(view, 1.5, x, y);
    };

    it('keeps the grabbed point under the pointer', () => {
        const held = grip(BOX, rayTo(FRONT, vec3(1.5, 0.5, 1)));
        near(held.point, vec3(1.5, 0.5, 1), 1e-6);
        const to = vec3(2.6, 0.5, 1.9);
        near(carried(held, rayTo(FRONT, to), FRONT), vec3(1.1, 0, 0.9), 1e-6);
    });

    it('stays put while the pointer is above the horizon', () => {
        const held = grip(BOX, rayTo(FRONT, vec3(1.5, 0.5, 1)));
        assert.equal(carried(held, rayTo(FRONT, vec3(1.5, 4, 1)), FRONT), null);
    });

    it('moves sideways and away where the floor is seen edge-on', () => {
        const low = {...FRONT, eye: vec3(1.5, 0.5, -7), target: vec3(1.5, 0.5, 1)};
        const held = grip(BOX, rayTo(low, vec3(1.5, 0.5, 1)));
        assert.equal(held.level, false);
        near(carried(held, rayTo(low, vec3(2, 0.5, 1)), low), vec3(0.5, 0, 0), 1e-6);
        const away = carried(held, rayTo(low, vec3(1.5, 0.7, 1)), low);
        near(away, vec3(0, 0, 0.2), 1e-6);
    });

    it('does not grab what the ray misses', () => {
        assert.equal(grip(BOX, rayTo(FRONT, vec3(5, 5, 1))), null);
    });

    it('stops at the walls, but leaves what sticks out', () => {
        near(keptInside(vec3(9, 0, -9), BOX, ROOM), vec3(3.5, 0, -1));
        const out = {min: vec3(-1, 0, 1), max: vec3(0, 1, 2)};
        near(keptInside(vec3(-1, 0, 0), out, ROOM), vec3(0, 0, 0));
        near(keptInside(vec3(2, 0, 0), out, ROOM), vec3(2, 0, 0));
    });
});

describe('figures', () => {
    it('keeps the shape of a snapshot within the limits', () => {
        const limits = {maxWidth: 3840, maxHeight: 2160};
        const screen = {width: 800, height: 600};
        assert.deepEqual(snapshotSize(0, screen, limits), screen);
        assert.deepEqual(snapshotSize(1920, screen, limits), {width: 1920, height: 1440});
        assert.deepEqual(snapshotSize(3840, screen, limits), {width: 2880, height: 2160});
        const large = snapshotSize(8192, screen, {...limits, maxSnapshotEdge: 8192});
        assert.deepEqual(large, {width: 8192, height: 6144});
        const tall = snapshotSize(3840, {width: 1, height: 900}, limits);
        assert.deepEqual(tall, {width: 2, height: 2160});
    });

    it('ask for device pixels within the limits, in proportion', () => {
        const limits = {maxWidth: 3840, maxHeight: 2160};
        assert.deepEqual(fitViewport(800, 600, 1, 1280 * 960, limits), {width: 800, height: 600});
        const {width, height} = fitViewport(1000, 750, 3, 1280 * 960, limits);
        assert.ok(width * height <= 1280 * 960 && Math.abs(width / height - 4 / 3) < 0.01);
        assert.equal(fitViewport(9000, 100, 1, Infinity, limits).width, 3840);
        const told = {...limits, maxViewportPixels: 3840 * 2160, maxViewportEdge: 8192};
        assert.deepEqual(fitViewport(430, 932, 3, Infinity, told), {width: 1290, height: 2796});
        assert.deepEqual(fitViewport(5120, 2880, 1, Infinity, told), {width: 3840, height: 2160});
        assert.deepEqual(fitViewport(0, 0, 1, Infinity, limits), {width: 16, height: 16});
    });

    it('wait longer from attempt to attempt, up to a limit', () => {
        assert.ok(retryDelay(0, 0.5) < retryDelay(1, 0.5));
        assert.ok(retryDelay(1000, 1) <= 12500);
    });

    it('count events of the last moments only', () => {
        const meter = new RateMeter(1000);
        [0, 900, 1000, 1100].forEach((time) => meter.count(time));
        assert.equal(meter.rate(1200), 3);
        assert.equal(meter.rate(5000), 0);
    });

    it('give quantiles of the last samples', () => {
        const samples = new Samples(3);
        assert.equal(samples.quantile(0.5), null);
        [100, 3, 1, 2].forEach((value) => samples.add(value));
        assert.equal(samples.quantile(0.5), 2);
        assert.equal(samples.quantile(1), 3);
    });

    it('keep the course of the error since the last change, thinned as time goes on', () => {
        const history = new ErrorHistory();
        assert.ok(!history.add(0, {epoch: 0, relativeError: 0.5}));
        assert.ok(history.add(100, {epoch: 0, relativeError: 0.5}));
        assert.ok(!history.add(110, {epoch: 0, relativeError: 0.4}));
        assert.ok(!history.add(400, {epoch: 0}));
        for (let time = 1000; time < 3.6e6; time += 250) {
            history.add(time, {epoch: 0, relativeError: 0.1, errorLow: 0.05, errorHigh: 0.2});
        }
        assert.ok(history.samples.length < 300, `${history.samples.length} samples of an hour`);
        assert.equal(history.samples[1].high, 0.2);
        history.add(3.7e6, {epoch: 1, relativeError: 0.4});
        assert.equal(history.samples.length, 0);
    });

    it('draw an error that halves as time quadruples as one straight line', () => {
        const samples = [1, 4, 16, 64].map((seconds, i) => {
            const error = 0.4 / 2 ** i;
            return {seconds, error, low: error / 2, high: error * 2};
        });
        const plot = layOut(samples, 0.02, 276, 150);
        const points = [...plot.line.matchAll(/[ML]([\d.]+) ([\d.]+)/g)];
        const [x, y] = [1, 2].map((part) => points.map((match) => Number(match[part])));
        for (const i of [1, 2]) {
            assert.ok(Math.abs(x[i + 1] - x[i] - (x[1] - x[0])) < 0.2, `x: ${x}`);
            assert.ok(Math.abs(y[i + 1] - y[i] - (y[1] - y[0])) < 0.2, `y: ${y}`);
        }
        assert.ok(y[1] > y[0] && x[1] > x[0]);
        assert.notEqual(plot.target, '');
        assert.ok(plot.labels.some(({text}) => text === '10 %'));
        const times = layOut([{seconds: 9000, error: 0.1, low: 0.1, high: 0.1}], null, 276, 150).labels.map(({text}) => text);
        assert.deepEqual(times.slice(-4), ['10 s', '100 s', '17 min', '2.8 h'], 'as the decades are');
        assert.equal(layOut([], null, 276, 150).line, '');
    });

    it('read well, and as a dash where nothing is known', () => {
        assert.equal(format.percent(0.0184), '1.8 %');
        assert.equal(format.percent(0.31), '31 %');
        assert.equal(format.percent(undefined), '–');
        assert.equal(format.progress(0.9999), '99 %');
        assert.equal(format.progress(1), '100 %');
        assert.equal(format.pictureError(0.018), '1.8 %');
        assert.deepEqual([null, 1.4].map(format.pictureError), ['not yet known', 'not yet known']);
        assert.deepEqual([0.0937, 12, 0.00012].map(format.darkerThan), ['below 0.09 cd/m²', 'below 10 cd/m²', 'below 0.0001 cd/m²']);
        assert.equal(format.interval(0.4, 1.5), '40 % to more than 100 %');
        assert.equal(format.interval(null, null), '–');
        assert.equal(format.count(1234567), '1\u202f234\u202f567');
        assert.equal(format.metres(-0.5), '−0.50 m');
        assert.equal(format.milliseconds(NaN), '–');
    });
});

describe('progressText', () => {
    it('says what is ahead, what is reached and what is left, as far as it is known', () => {
        assert.equal(progressText({ahead: 2}), '2 pictures are made before it');
        assert.equal(progressText({ahead: 1, relativeError: 0.1}), '1 picture is made before it');
        assert.equal(progressText({ahead: 0}), 'it has just begun');
        assert.equal(progressText({ahead: 0, relativeError: 0.12}), 'error below 12 % so far');
        const near = progressText({ahead: 0, relativeError: 0.062, secondsLeft: 0.2});
        assert.equal(near, 'error below 6.2 % so far, about 1 s left');
        const far = progressText({ahead: 0, relativeError: 0.062, secondsLeft: 400});
        assert.equal(far, 'error below 6.2 % so far, about 7 min left');
    });
});

describe('loadedLight', () => {
    const colour = {x: 1, y: 1, z: 1};
    const light = {id: 1, name: 'lamp', kind: 'AREA', unit: 'CD_PER_M2', intensity: 0, colour, on: true};

    it('is what the file says, whatever the lamp has been set to', () => {
        const warm = {x: 1.4, y: 0.9, z: 0.4};
        const told = {...light, loadedIntensity: 900, loadedColour: warm};
        assert.deepEqual(loadedLight(told), {intensity: 900, colour: warm});
        assert.deepEqual(loadedLight({...light, intensity: 5}), {intensity: 5, colour});
    });

    it('is not what a lamp is that is dimmed, coloured or off', () => {
        const loaded = {intensity: 900, colour};
        assert.ok(sameLight({...light, intensity: 900.01}, loaded));
        assert.ok(!sameLight({...light, intensity: 0}, loaded));
        assert.ok(!sameLight({...light, intensity: 900, on: false}, loaded));
        assert.ok(!sameLight({...light, intensity: 900, colour: {...colour, z: 0.5}}, loaded));
    });
});
