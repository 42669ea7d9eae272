// SPDX-License-Identifier: Apache-2.0
// The maths behind the page's tools: reprojection, grids, placing, colours, links, reports.

import assert from 'node:assert/strict';
import {describe, it} from 'node:test';

import {goTo, look, project, walk} from '../../client_web/camera/camera.js';
import * as colour from '../../client_web/measure/colour.js';
import {choicesOf} from '../../client_web/review/compare.js';
import {effectCost, pathInWords} from '../../client_web/scene/effects.js';
import {
    carriedGrid, csvCell, gridCsv, gridOn, intervalsOf, mainFace, measuredAgain, pointsOf, spreadOver, standardStep,
    summaryOf,
    typicalError,
} from '../../client_web/measure/grid.js';
import {stateOf} from '../../client_web/measure/grid_panel.js';
import {History, subjectOf} from '../../client_web/scene/history.js';
import {layOutStrip} from '../../client_web/measure/legend.js';
import {partsOf, timeAt, zoneOf} from '../../client_web/scene/day_time.js';
import {PREPARING} from '../../client_web/net/raybundle_client.js';
import {ceilingAbove, floorBelow, lowestFloor} from '../../client_web/scene/floors.js';
import {likelyPlace} from '../../client_web/scene/luminaires.js';
import {sunText} from '../../client_web/scene/daylight_panel.js';
import {groupState, groupsOf} from '../../client_web/lights/light_groups.js';
import {areaOver, outlineOver, planeCsv, planeState, valueText, withInterval} from '../../client_web/measure/work_plane.js';
import {checkText, litBy, luminaireLines, verdictSign, zoneValues} from '../../client_web/measure/zones.js';
import {aimAt, aimOf, anglesOf} from '../../client_web/lights/light_place.js';
import {dimmerPosition, dimmerShare, intensityProblem, lightFigures} from '../../client_web/lights/light_values.js';
import {lightState} from '../../client_web/lights/light_state.js';
import {DarkViews} from '../../client_web/camera/lost.js';
import {avatarTexts, frustumOf} from '../../client_web/review/people.js';
import {changeOf} from '../../client_web/review/pins.js';
import * as placement from '../../client_web/scene/placement.js';
import {escaped, reportHtml} from '../../client_web/review/report.js';
import {progressText, timeText} from '../../client_web/scene/opening.js';
import {savedText} from '../../client_web/scene/scene_saving.js';
import {listTag, namesText, openingQuestion, refusalOf, sizeText, uploadProblem} from '../../client_web/scene/scene_files.js';
import {Anchor} from '../../client_web/scene/anchor.js';
import {PlacedObject, SceneModel} from '../../client_web/scene/scene_model.js';
import {NewestOnly} from '../../client_web/scene/surface_change.js';
import {isOutside, placeOf, placeProblem, placedAt} from '../../client_web/scene/scene_panel.js';
import {fromHash, toHash} from '../../client_web/review/share.js';
import {adviceOf, bannerOf, sentence} from '../../client_web/ui/status.js';
import {duration, targetAt} from '../../client_web/measure/target_panel.js';
import * as units from '../../client_web/ui/units.js';
import {centre, length, sub, vec3} from '../../client_web/ui/vector.js';
import {cssMatrix, homography} from '../../client_web/picture/view_warp.js';
import {hintText, outsideDeadZone} from '../../client_web/camera/walking.js';

const VIEW = {eye: vec3(1, 1.6, 4), target: vec3(0, 1, 0), up: vec3(0, 1, 0), verticalFov: 0.8};
const close = (actual, expected, bound, what) =>
    assert.ok(Math.abs(actual - expected) <= bound, `${what ?? ''} ${actual}, not ${expected}`);

describe('files of scenes', () => {
    it('are refused before they are sent where the server would not take them', () => {
        assert.equal(uploadProblem({name: 'a.GLB', size: 10}, 10), '');
        assert.match(uploadProblem({name: 'a.obj', size: 10}, 10), /not a \.glb file/);
        assert.match(uploadProblem({name: 'a.glb', size: 2e6}, 1e6), /2\.0 MB.*1\.0 MB/);
        assert.equal(savedText(2.5e6, null), 'Saved, 2.5 MB.');
        assert.match(savedText(1, 'T%C3%BCr stays; 100%25'), /lacks something: Tür stays; 100%\./);
        assert.equal(sizeText(1), '1 kB');
    });

    it('are rejected in words for people, with the parser’s own behind them', () => {
        const {text, details} = refusalOf('Rejected: not glTF: parse error at line 1');
        assert.equal(text, 'This is not a glTF file.');
        assert.equal(details, 'not glTF: parse error at line 1');
        assert.deepEqual(refusalOf('scenes: must be a list'), {
            text: 'This scene cannot be used.', details: 'scenes: must be a list',
        });
    });
});

describe('a scene that somebody opens', () => {
    const opening = {name: 'a.glb', by: 2, byName: 'Ann', stage: 'PREPARING', reason: ''};

    it('tells everybody how far it is, and nothing once it is over', () => {
        assert.equal(progressText(opening, false), 'Ann opens a.glb (2 of 3: preparing surfaces).');
        assert.match(progressText({...opening, stage: 'READING'}, true), /^Opening a.glb \(1 of 3/);
        assert.match(progressText({...opening, byName: ''}, false), /^The server is preparing a.glb/);
        const last = {...opening, stage: 'COMPILING'};
        assert.match(progressText(last, false), /preparing light\)\. The picture pauses\.$/);
        assert.match(progressText({...last, byName: ''}, false), /preparing light\)\.$/, 'a server that starts has shown none');
        assert.equal(progressText({...opening, stage: 'REJECTED'}, false), '');
    });

    it('says how long it has taken and will take', () => {
        assert.equal(timeText(0.2, null), '');
        assert.equal(timeText(12, null), '12 s so far');
        assert.equal(timeText(12, 20), '12 s so far, about 20 s left');
        assert.equal(timeText(12, -3), '12 s so far, longer than foreseen');
    });

    it('is said to be shown only once it is, in the list too', () => {
        assert.equal(listTag('b.glb', 'b.glb', ''), 'shown');
        assert.equal(listTag('b.glb', 'b.glb', 'a.glb'), 'still shown');
        assert.equal(listTag('a.glb', 'b.glb', 'a.glb'), 'being opened');
        assert.equal(listTag('c.glb', 'b.glb', 'a.glb'), '');
    });

    it('is asked about where it replaces what others see, or leaves changes behind', () => {
        const now = {others: [], changes: 0, pins: 0, forgets: false};
        assert.equal(openingQuestion('a.glb', now), '');
        assert.equal(
            openingQuestion('a.glb', {...now, others: ['Ann', 'Ben']}),
            'Open a.glb? It replaces the scene for Ann and Ben, too.',
        );
        assert.match(openingQuestion('a.glb', {...now, changes: 3, pins: 1}), /The 3 changes and 1 pin .* are saved/);
        assert.match(openingQuestion('a.glb', {...now, pins: 1, forgets: true}), /The 1 pin .* will be lost\.$/);
        assert.equal(namesText(['A', 'B', 'C', 'D', 'E', 'F']), 'A, B, C, D and 2 others');
        assert.equal(namesText(['A', 'B', 'C', 'D', 'E']), 'A, B, C, D and E');
    });

    it('is no lost connection', () => {
        const away = {state: 'reconnecting', reason: '', code: '', retryAt: 0};
        assert.equal(bannerOf(away, true, 'a.glb').title, 'Opening a.glb');
        const silent = {...away, reason: 'The server has not answered for a while.'};
        assert.doesNotMatch(adviceOf(silent, true, 'a.glb'), /not answered/);
        assert.equal(bannerOf(away, true, 'a.glb').retry, '', 'nothing is gained by trying again');
        assert.match(bannerOf(away, true).title, /lost/);
    });

    it('loses no connection where a new one waits for the server', () => {
        const named = {state: /** @type {const} */ ('reconnecting'), code: '', reason: PREPARING, retryAt: 0};
        assert.deepEqual(bannerOf(named, true), {title: 'Waiting for the server', retry: '', asksForToken: false});
    });
});

describe('the last picture under another camera', () => {
    /** Where a homography takes a point of the picture. */
    const taken = (h, x, y) => {
        const [a, b, w] = [0, 3, 6].map((i) => h[i] * x + h[i + 1] * y + h[i + 2]);
        return {x: a / w, y: b / w};
    };

    it('stays where it is while the camera does', () => {
        const {x, y} = taken(homography(VIEW, 1.5, VIEW, 1.5), 0.3, 0.8);
        close(x, 0.3, 1e-9);
        close(y, 0.8, 1e-9);
    });

    it('follows a turn of the head exactly, whatever the distance', () => {
        const turned = look(VIEW, 0.2, -0.1);
        const h = homography(VIEW, 1.5, turned, 1.2);
        for (const point of [vec3(0.3, 0.9, 0), vec3(0.6, 1.2, -8), vec3(0.9, 1.4, 2)]) {
            const before = project(VIEW, 1.5, point);
            const after = project(turned, 1.2, point);
            const {x, y} = taken(h, before.x, before.y);
            close(x, after.x, 1e-9);
            close(y, after.y, 1e-9);
        }
    });

    it('follows a step exactly for what lies at the distance of the target', () => {
        const moved = walk(VIEW, 0.5, 0.3, 0);
        const before = project(VIEW, 1.5, VIEW.target);
        const after = project(moved, 1.5, VIEW.target);
        const {x, y} = taken(homography(VIEW, 1.5, moved, 1.5), before.x, before.y);
        close(x, after.x, 1e-9);
        close(y, after.y, 1e-9);
    });

    it('is not drawn from behind', () => {
        assert.equal(homography(VIEW, 1.5, look(VIEW, Math.PI, 0), 1.5), null);
    });

    it('is a matrix that CSS reads', () => {
        const css = cssMatrix(homography(VIEW, 1.5, VIEW, 1.5), 300, 200);
        const numbers = css.slice('matrix3d('.length, -1).split(',').map(Number);
        assert.equal(numbers.length, 16);
        [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1].forEach((v, i) => close(numbers[i], v, 1e-9));
    });

    it('only shifts and grows where somebody walks, without a trace of perspective', () => {
        let view = {...VIEW, eye: vec3(0.6, 1.6, 4.1), target: vec3(2.6, 1.1, 0.3)};
        for (let i = 0; i < 10; ++i) {
            const next = walk(view, 0.013 * (i % 3), 0.021, 0);
            const css = cssMatrix(homography(view, 1.402, next, 1.402), 868, 619);
            const numbers = css.slice('matrix3d('.length, -1).split(',').map(Number);
            assert.deepEqual([1, 3, 4, 7].map((at) => numbers[at]), [0, 0, 0, 0], css);
            assert.ok(Math.abs(numbers[12]) > 1, css);
            view = next;
        }
    });
});

describe('a double click', () => {
    it('on the floor stands there, looking the same way', () => {
        const there = goTo(VIEW, vec3(2, 0.2, -3), vec3(0, 1, 0), true);
        assert.deepEqual(there.eye, vec3(2, 1.8, -3));
        close(there.target.y, there.eye.y, 1e-9);
        const heading = (v) => Math.atan2(v.target.x - v.eye.x, v.target.z - v.eye.z);
        close(heading(there), heading(VIEW), 1e-9);
    });

    it('on a wall comes near and looks at it', () => {
        const there = goTo(VIEW, vec3(0, 1, -10), vec3(0, 0, 1), true);
        assert.deepEqual(there.target, vec3(0, 1, -10));
        assert.ok(length(sub(there.eye, there.target)) < length(sub(VIEW.eye, there.target)) / 2);
    });
});

describe('a measuring grid', () => {
    const TABLE = {min: vec3(-1, 0, 2), max: vec3(1, 0.75, 3)};

    it('has equal cells over the surface, no wider than asked', () => {
        const grid = gridOn(vec3(0.3, 0.75, 2.4), vec3(0, 1, 0), TABLE, 0.3);
        assert.equal(grid.columns * grid.rows, 7 * 4);
        const points = pointsOf(grid);
        for (const {x, y, z} of points) {
            assert.ok(x > -1 && x < 1 && z > 2 && z < 3);
            close(y, 0.75, 1e-9);
        }
        const mean = points.reduce((sum, {x}) => sum + x, 0) / points.length;
        close(mean, 0, 1e-9);
    });

    it('stands upright on a wall', () => {
        const wall = {min: vec3(0, 0, 0), max: vec3(4, 3, 5)};
        for (const {x} of pointsOf(gridOn(vec3(4, 1, 2), vec3(-1, 0, 0), wall, 0.5))) {
            close(x, 4, 1e-9);
        }
    });

    it('has the step of EN 12464-1, and no more points than the server measures', () => {
        close(standardStep(1), 0.2, 1e-12);
        close(standardStep(10), 1, 1e-12);
        const hall = {min: vec3(-60, 0, -60), max: vec3(60, 5, 60)};
        const grid = gridOn(vec3(0, 0, 0), vec3(0, 1, 0), hall, 0.1);
        assert.ok(grid.columns * grid.rows <= 1024);
    });

    it('sums up what was measured and leaves out what was not', () => {
        const summary = summaryOf([100, -1, 300, 200]);
        assert.deepEqual(summary, {measured: 3, minimum: 100, mean: 200, maximum: 300, uniformity: 0.5});
        assert.equal(summaryOf([-1, -1]), null);
    });

    it('says how well mean and uniformity are known', () => {
        const {meanError, mean, uniformity} = intervalsOf([100, -1, 300, 200], [0.01, -1, 0.01, 0.01]);
        close(meanError, 0.01, 1e-12);
        close(mean.low, 200 * (1 - 0.0196), 1e-9);
        close(mean.high, 200 * (1 + 0.0196), 1e-9);
        close(uniformity.high, 0.5 * (1 + 0.0196), 1e-9);
        assert.ok(uniformity.low < 0.5 * (1 - 0.0196) && uniformity.low > 0.48);
        const many = intervalsOf(Array(100).fill(200), Array(100).fill(0.01));
        assert.ok(many.uniformity.low < 0.97 && many.uniformity.high === 1);
        assert.equal(intervalsOf([100, 200], [0.01, -1]), null, 'not known');
        assert.equal(intervalsOf([0, -1], [-1, -1]), null, 'dark');
        assert.deepEqual(intervalsOf([0, 200], [-1, 0.01]).uniformity, {low: 0, high: 0}, 'what is black is known');
    });

    it('becomes a table', () => {
        const grid = {origin: vec3(0, 0, 0), stepX: vec3(1, 0, 0), stepY: vec3(0, 0, 2), columns: 4, rows: 1};
        const result = {illuminance: [123.4567, -1, 5, 5], relativeError: [0.02, -1, 0.7, -1], epoch: 7};
        const lines = gridCsv(grid, result).trim().split('\r\n');
        assert.equal(lines[1], '1,1,0.0000,0.0000,0.0000,123.457,3.92,7,');
        assert.equal(lines[2], '1,2,1.0000,0.0000,0.0000,,,7,not in view');
        assert.match(lines[3], /,5\.00000,137,7,still uncertain$/);
        assert.match(lines[4], /,5\.00000,,7,error not yet known$/);
        assert.equal(csvCell('=1+1'), "'=1+1");
        assert.equal(csvCell('a "b", c'), '"a ""b"", c"');
    });
});

describe('the surface that a grid is laid on', () => {
    const hit = (x, y, z, normal) => ({position: vec3(x, y, z), normal});
    const up = vec3(0, 1, 0);
    const front = vec3(0, 0, 1);

    it('is the largest one that looks upwards, or the largest one', () => {
        const sides = [hit(0, 0.2, 1, front), hit(0.1, 0.3, 1, front), hit(0.2, 0.4, 1, front)];
        const top = [hit(0, 0.8, 0, up), hit(0.5, 0.8, 0.5, up)];
        const shelf = hit(0, 0.3, 0, up);
        assert.equal(mainFace([...sides, shelf, ...top]).position.y, 0.8);
        assert.equal(mainFace([...sides, hit(1, 1, 0, vec3(1, 0, 0))]).normal, front);
        assert.equal(mainFace([]), null);
    });

    it('is looked for where the picture may show it', () => {
        const corner = (x, y, depth = 1) => ({x, y, depth});
        for (const {x, y} of spreadOver([corner(-50, 20), corner(100, 60)], 300, 200, 4)) {
            assert.ok(x > 0 && x < 100 && y > 20 && y < 60, `${x}, ${y}`);
        }
        assert.deepEqual(spreadOver([corner(400, 20), corner(500, 60)], 300, 200, 4), []);
        const all = spreadOver([corner(10, 10, -1), corner(20, 20)], 300, 200, 2);
        assert.deepEqual(all, [{x: 75, y: 50}, {x: 225, y: 50}, {x: 75, y: 150}, {x: 225, y: 150}]);
    });

    it('is named, with what the grid is worth', () => {
        const grid = {origin: vec3(0, 0, 0), stepX: vec3(0.2, 0, 0), stepY: vec3(0, 0, 0.2), columns: 2, rows: 1};
        const state = (illuminance, error, settled = true, outdated = false) => {
            const result = {illuminance, relativeError: [error, error], epoch: 0};
            return stateOf({grid, result, surface: 'desk, upper side', settled, outdated});
        };
        const size = 'desk, upper side: 2 × 1 points, 0.20 m apart.';
        assert.equal(state([100, -1], 0.02), `${size} 1 of 2 are in view. Typical error ± 3.9 %.`);
        assert.match(state([100, 90], 0.6), /Most values are still uncertain: Uo is not yet known\. Better values come by themselves\.$/);
        assert.match(state([100, 90], 0.02, false), /still settling\. Better values come by themselves\.$/);
        assert.match(state([-1, -1], -1), /None of them is in view: turn/);
        assert.match(state([100, 90], 0.02, true, true), /changed since: new values come/);
    });
});

describe('a grid on something that moves', () => {
    const bounds = {min: vec3(0, 0, 0), max: vec3(2, 1, 1)};
    const grid = {origin: vec3(1, 1, 0), stepX: vec3(0.5, 0, 0), stepY: vec3(0, 0, 0.5), columns: 2, rows: 2};

    it('goes with it, turned and resized as it is', () => {
        const scene = new SceneModel({name: 'a', bounds, objects: [
            {id: 3, name: 'desk', movable: true, bounds, transform: {}},
        ]}, 0);
        const anchor = new Anchor(scene.object(3));
        const half = Math.SQRT1_2;  // a quarter turn about y
        scene.object(3).place({
            translation: vec3(0, 0, 4), rotation: {x: 0, y: half, z: 0, w: half}, scale: vec3(2, 2, 2),
        });
        const moved = carriedGrid(grid, anchor.carry(scene));
        close(length(sub(moved.origin, vec3(0, 2, 2))), 0, 1e-9);
        close(length(sub(moved.stepX, vec3(0, 0, -1))), 0, 1e-9);
        close(length(sub(moved.stepY, vec3(1, 0, 0))), 0, 1e-9);
        assert.deepEqual(carriedGrid(grid, new Anchor(null).carry(scene)), grid);
    });

    it('keeps what was in view before, as long as nothing has changed', () => {
        const before = {illuminance: [100, 80], relativeError: [0.1, 0.1], epoch: 4};
        const again = (illuminance, epoch) => measuredAgain(before, {illuminance, relativeError: [0.02, -1], epoch});
        assert.deepEqual(again([101, -1], 4), {illuminance: [101, 80], relativeError: [0.02, 0.1], epoch: 4});
        assert.deepEqual(again([50, -1], 5).illuminance, [50, -1]);
        assert.equal(again([-1, -1], 5), null);
    });
});

describe('the error of a grid', () => {
    it('is the median of what is known', () => {
        assert.equal(typicalError([-1, 0.3, 0.1, -1, 0.2]), 0.2);
        assert.equal(typicalError([-1]), null);
    });
});

describe('placing an object', () => {
    const object = () =>
        new PlacedObject({
            id: 1,
            name: 'box',
            movable: true,
            bounds: {min: vec3(1, 0, 2), max: vec3(2, 1, 4)},
            transform: {translation: vec3(0.5, 0, 0)},
            worldFromParent: [0, 0, -2, 0, 0, 2, 0, 0, 2, 0, 0, 0, 3, 0, 1, 1],
        });

    it('turns it about its own middle, also below a turned and scaled parent', () => {
        const box = object();
        const before = centre(box.bounds);
        box.place(placedAt(box, 'turn', 90));
        const after = centre(box.bounds);
        assert.ok(length(sub(after, before)) < 1e-6, JSON.stringify(after));
        const size = sub(box.bounds.max, box.bounds.min);
        close(size.x, 2, 1e-6);
        close(size.z, 1, 1e-6);
        close(placeOf(box).turn, 90, 1e-6);
    });

    it('outlines it with a box that turns with it', () => {
        const box = object();
        box.place(placedAt(box, 'turn', 30));
        const edges = box.boxEdges(vec3(0, 9, 9));
        const lengths = edges.map(([a, b]) => length(sub(a, b)));
        assert.equal(edges.length, 9);
        assert.ok(lengths.every((size) => Math.min(Math.abs(size - 1), Math.abs(size - 2)) < 1e-6));
    });

    it('resizes it on its base', () => {
        const box = object();
        box.place(placedAt(box, 'size', 50));
        close(box.bounds.min.y, 0, 1e-9);
        close(box.bounds.max.y, 0.5, 1e-9);
        close(placeOf(box).size, 50, 1e-9);
    });

    it('puts it where a number says', () => {
        const box = object();
        box.place(placedAt(box, 'x', 7));
        close(placeOf(box).x, 7, 1e-9);
        close(placeOf(box).z, 3, 1e-9);
    });

    it('moves it as far along an axis as the pointer went', () => {
        const picture = {width: 900, height: 600};
        const at = (p) => {
            const {x, y} = project(VIEW, 1.5, p);
            return {x: x * 900, y: y * 600};
        };
        const from = at(vec3(0, 1, 0));
        const to = at(vec3(0.05, 1, 0));
        const way = {x: to.x - from.x, y: to.y - from.y};
        const metres = placement.alongAxis(VIEW, picture, vec3(0, 1, 0), vec3(1, 0, 0), way);
        close(metres, 0.05, 0.001);
        close(placement.snapped(0.26, 0.1), 0.3, 1e-12);
    });
});

describe('colours and units', () => {
    it('tell a temperature from a colour and back', () => {
        for (const kelvin of [2700, 4000, 6500]) {
            const light = colour.blackBody(kelvin);
            close(colour.luminance(light), 1, 1e-9);
            close(colour.temperatureOf(light), kelvin, 50);
        }
        const white = colour.blackBody(6504);
        close(white.x, white.z, 0.1, 'daylight is nearly white:');
    });

    it('go through sRGB unchanged', () => {
        assert.equal(colour.toHex(colour.fromHex('#3b7fd0')), '#3b7fd0');
    });

    it('dim by ratios', () => {
        close(dimmerShare(dimmerPosition(1)), 1, 1e-9);
        close(dimmerShare(0), 0.01, 1e-12);
    });

    it('say what people know lights by, as they are dimmed', () => {
        const light = {id: 1, name: 'lamp', kind: 'POINT', unit: 'LM', colour: {x: 1, y: 1, z: 1}, on: true};
        const ies = {...light, intensity: 4800, loadedIntensity: 9600, flux: 9600, peak: 3000, watts: 80};
        assert.equal(lightFigures(ies), 'at most 1\u202f500 cd · 80 W');
        const point = {...light, unit: 'CD', intensity: 100, loadedIntensity: 100, flux: 1256.6, peak: 100};
        assert.equal(lightFigures(point), '1\u202f257 lm');
        const area = {...light, unit: 'CD_PER_M2', intensity: 0, loadedIntensity: 0, flux: undefined};
        assert.equal(lightFigures(area), '');
    });

    it('say no more digits than there are', () => {
        assert.equal(units.illuminance(482.1, 'lx'), '482 lx');
        assert.equal(units.illuminance(107.639, 'fc'), '10.0 fc');
        assert.equal(units.illuminance(12345, 'lx'), '12\u202f345 lx');
        assert.equal(units.plusMinus(0.012), '± 2.4 %');
    });

    it('say plainly what is not yet known', () => {
        assert.equal(units.plusMinus(undefined), 'not yet known');
        assert.equal(units.plusMinus(0.6), 'still uncertain');
        assert.equal(units.measured(482.1, 'lx', 0.012), '482 lx ± 2.4 %');
        assert.equal(units.measured(482.1, 'lx', 0.6), '≈ 500 lx, still uncertain');
        assert.equal(units.measured(107.639, 'fc', undefined), '≈ 10 fc, error not yet known');
        assert.equal(units.estimated(38.2, '', 0.6), '≈ 40');
        assert.equal(units.estimated(38.2, '', 0.1), '38.2');
        assert.equal(units.estimated(38.2, '', undefined), '≈ 40', 'no more digits than anybody knows of');
        assert.deepEqual([0.1, 0.6, -1].map(units.noteOf), ['', 'still uncertain', 'error not yet known']);
    });
});

describe('changes', () => {
    it('are undone and done again, the newest first', async () => {
        const log = [];
        const history = new History();
        const step = (name) => ({
            label: name,
            undo: async () => log.push(`-${name}`),
            redo: async () => log.push(`+${name}`),
        });
        history.add(step('a'));
        history.add(step('b'));
        await history.undo();
        await history.undo();
        await history.undo();
        await history.redo();
        assert.deepEqual(log, ['-b', '-a', '+a']);
        history.add(step('c'));
        assert.equal(history.next, null);
    });

    it('that somebody else has built upon are taken back only when asked', async () => {
        const log = [];
        const history = new History();
        const step = (name, subject) => ({
            label: name,
            subject,
            undo: async () => log.push(`-${name}`),
            redo: async () => log.push(`+${name}`),
        });
        history.add(step('chair', subjectOf({moveObject: {object: 2}})));
        history.add(step('lamp', subjectOf({setLight: {light: 2}})));
        history.noteOther(subjectOf({moveObject: {object: 2}}), 'Bob');
        let asked = null;
        history.addEventListener('hesitate', (event) => {
            asked = event.detail;
        });
        await history.undo();
        assert.deepEqual(log, ['-lamp'], 'nobody else has touched the lamp');
        await history.undo();
        assert.deepEqual(log, ['-lamp']);
        assert.equal(asked.by, 'Bob');
        assert.equal(history.last.label, 'chair', 'it stays to be undone');
        await asked.goOn();
        assert.deepEqual(log, ['-lamp', '-chair']);
    });

    it('of a slider are sent one at a time, the newest last', async () => {
        const sent = [];
        let finish = () => {};
        const newest = new NewestOnly((body) => {
            sent.push(body.n);
            return new Promise((resolve) => {
                finish = resolve;
            });
        });
        newest.push({n: 1});
        newest.push({n: 2});
        newest.push({n: 3});
        assert.deepEqual(sent, [1]);
        finish();
        await new Promise((resolve) => setTimeout(resolve));
        assert.deepEqual(sent, [1, 3]);
    });

    it('of the light at a pin are told above ten per cent', () => {
        assert.equal(changeOf({change: 0.09}), '');
        assert.equal(changeOf({}), '');
        assert.equal(changeOf({change: -0.24}), '−24 % since then');
    });
});

describe('a connection that begins anew', () => {
    const room = {min: vec3(0, 0, 0), max: vec3(4, 3, 5)};
    const sceneOf = (epoch, x, intensity = 100) => {
        const transform = {translation: vec3(x, 0, 0)};
        const objects = [{id: 1, name: 'a', movable: true, bounds: room, transform}];
        return new SceneModel({name: 's', bounds: room, objects, lights: [{id: 1, intensity}]}, epoch);
    };

    it('goes on where the server knows of the changes', () => {
        assert.ok(sceneOf(3, 1).goesOnFrom(sceneOf(3, 1), true));
        assert.ok(sceneOf(5, 2).goesOnFrom(sceneOf(3, 1), true), 'others have changed something meanwhile');
        assert.ok(sceneOf(3, 0.1 + 0.2).goesOnFrom(sceneOf(3, 0.3), false), 'another run with a journal');
    });

    it('knows what others have changed meanwhile', () => {
        assert.deepEqual(sceneOf(5, 2, 50).differencesFrom(sceneOf(3, 1)).map(subjectOf), ['object 1', 'light 1']);
        assert.deepEqual(sceneOf(5, 1).differencesFrom(sceneOf(3, 1)), []);
        assert.ok(!sceneOf(3, 2).goesOnFrom(sceneOf(3, 1), true), 'the same number of other changes');
    });

    it('does not after another start', () => {
        assert.ok(!sceneOf(0, 0).goesOnFrom(sceneOf(3, 1), false));
        assert.ok(!sceneOf(0, 0).goesOnFrom(sceneOf(3, 1), true), 'the scene has been opened anew');
        assert.ok(!sceneOf(3, 0).goesOnFrom(sceneOf(3, 1), false), 'as many changes, but others');
        assert.ok(!sceneOf(3, 1, 50).goesOnFrom(sceneOf(3, 1), false));
        assert.ok(!sceneOf(9, 1).goesOnFrom(sceneOf(3, 1), false));
    });
});

describe('a change of an object', () => {
    const still = {translation: vec3(1, 0, 2), rotation: {x: 0, y: 0, z: 0, w: 1}, scale: vec3(1, 1, 1)};
    const moved = {...still, translation: vec3(2, 0, 2)};
    const turned = placement.turnedAbout(moved, vec3(0, 0, 0), 0.5);
    const larger = placement.resizedAbout(moved, vec3(0, 0, 0), 1.2);

    it('is called what it is', () => {
        assert.equal(placement.deedOf(still, moved, still), 'move');
        assert.equal(placement.deedOf(moved, turned, still), 'turn');
        assert.equal(placement.deedOf(moved, larger, still), 'resize');
        assert.equal(placement.deedOf(turned, still, still), 'put back');
        const {x, y, z, w} = moved.rotation;
        const same = {...turned, rotation: {x: -x, y: -y, z: -z, w: -w}};
        assert.equal(placement.deedOf(moved, same, still), 'move', 'the same rotation');
    });
});

describe('what is typed into a field of numbers', () => {
    it('is refused with a reason', () => {
        assert.equal(intensityProblem(0), '');
        assert.match(intensityProblem(-5), /Enter 0 or more/);
        assert.match(intensityProblem(NaN), /Enter a number/);
        assert.equal(placeProblem('x', -99), '');
        assert.match(placeProblem('x', NaN), /Enter a number/);
        assert.match(placeProblem('size', 0), /more than 0/);
    });

    it('may lead out of the scene, which is told', () => {
        const scene = {min: vec3(0, 0, 0), max: vec3(7, 3, 5)};
        const at = (x) => ({min: vec3(x, 0, 1), max: vec3(x + 1, 1, 2)});
        assert.ok(!isOutside(at(-0.5), scene));
        assert.ok(isOutside(at(99), scene));
        assert.ok(isOutside(at(-1.5), scene));
    });
});

describe('a picture in which nothing is seen', () => {
    it('is told of each time, once, and taken back when there is something again', () => {
        const views = new DarkViews();
        const other = {...VIEW, eye: vec3(9, 9, 9)};
        assert.equal(views.seen(VIEW, false), 'take back');
        assert.equal(views.seen(other, true), 'tell');
        assert.equal(views.seen(other, true), 'nothing');
        assert.equal(views.seen({...other, eye: vec3(9, 9, 8)}, true), 'tell');
        assert.equal(views.good, VIEW);
        assert.equal(views.seen(VIEW, false), 'take back');
        assert.equal(views.seen(other, true), 'tell');
    });
});

describe('the first hint', () => {
    it('says what a drag does here, and nothing of moving where nothing can be moved', () => {
        assert.equal(hintText(false, false, true), 'Drag to look around · W A S D to walk · click an object to move it');
        assert.equal(hintText(true, true, false), 'Drag to circle around · double-tap to go there');
    });
});

describe('avatars', () => {
    it('tell everybody apart', () => {
        const of = (...viewers) => avatarTexts(viewers.map(([viewer, name]) => ({viewer, name})));
        assert.deepEqual(of([14, ''], [15, '']), ['14', '15']);
        assert.deepEqual(of([1, 'Ann Lee'], [2, 'ben'], [3, 'Al Low']), ['1', 'BE', '3']);
    });
});

describe('the effects plan', () => {
    it('says what an effect costs and how much light comes by it, where it is on', () => {
        const glossy = {name: 'glossy', active: true, reason: '', shareBound: 1};
        assert.equal(effectCost({...glossy, bytesPerPatch: 56}), '56 bytes a patch');
        assert.match(effectCost({...glossy, shareBound: 0.25, bytesPerPatch: 0}), /at most 25 % of the light$/);
        assert.equal(effectCost({...glossy, active: false}), '');
        assert.equal(effectCost({name: 'sky', active: true, reason: ''}), '');
    });

    it('tells the ways of light in words', () => {
        assert.equal(pathInWords('LD+E'), 'lamp or sky → matt, 1 or more → eye');
        assert.equal(
            pathInWords('L(D|G)*S+E'),
            'lamp or sky → matt or glossy, 0 or more → mirror or glass, 1 or more → eye',
        );
        assert.equal(pathInWords('L(D|G)*(G|S)E'),
            'lamp or sky → matt or glossy, 0 or more → glossy or mirror or glass → eye');
    });
});

describe('what can be compared with', () => {
    const entry = (epoch, before, text) => ({time: new Date(), epoch, before, by: 'Ann', text});

    it('is the light before each change, newest first, and as it was loaded', () => {
        assert.deepEqual(choicesOf([], 0), []);
        assert.deepEqual(choicesOf([], 4), [{epoch: 0, name: 'as it was loaded'}]);
        const entries = [entry(1, 0, 'set lamp'), entry(9, 1, 'moved box')];
        assert.deepEqual(choicesOf(entries, 9), [
            {epoch: 1, name: 'before Ann moved box'},
            {epoch: 0, name: 'before Ann set lamp'},
        ]);
        const later = choicesOf([entry(9, 8, 'moved box')], 9);
        assert.deepEqual(later.map(({epoch}) => epoch), [8, 0]);
    });
});

describe('a link', () => {
    it('brings back camera, exposure, mode and selection', () => {
        const shared = {view: VIEW, exposure: -1.5, mode: 'FALSE_ILLUMINANCE', selected: 3};
        assert.deepEqual(fromHash(`#${toHash(shared)}`), shared);
    });

    it('that is broken says nothing', () => {
        const nothing = {view: null, exposure: null, mode: 'PHOTO', selected: null};
        for (const hash of ['', '#view=1,2,3', '#view=0,0,0,0,0,0,0,1,0,1&ev=x&show=Y&object=z']) {
            assert.deepEqual(fromHash(hash), nothing);
        }
    });
});

describe('the report', () => {
    it('is one file that shows what people typed as text', () => {
        const html = reportHtml({
            title: 'Room <1>',
            server: 'raybundle',
            time: new Date(0),
            epoch: 2,
            error: 0.02,
            picture: 'data:image/jpeg;base64,AA==',
            address: 'http://a/#view=1',
            unit: 'lx',
            pins: [
                {pin: 1, by: 1, byName: 'Ann', text: '<script>alert(1)</script>', illuminance: 100,
                    epoch: 1, setAtMs: 0, change: 0.5},
            ],
            points: [{number: 1, probe: {illuminance: 50, luminance: 5, epoch: 2}}],
            grid: {object: 'table', columns: 1, rows: 2, illuminance: [10, 30], relativeError: [0.6, 0.7]},
            changes: [{time: new Date(0), epoch: 2, by: 'Ann', text: 'moved chair'}],
            pinsInPicture: [{pin: 1, x: 0.5, y: 0.25}],
        });
        assert.ok(!html.includes('<script'));
        assert.ok(html.includes('&lt;script&gt;'));
        assert.ok(html.includes('+50 % since then') && html.includes('moved chair'));
        assert.ok(html.includes('left:50.00%;top:25.00%'));
        assert.ok(html.includes('100 lx, error not yet known') && html.includes('>still uncertain</td></tr>'));
        assert.ok(!/(src|href)="https?:(?!\/\/a\/)/.test(html), 'needs nothing else');
        assert.ok(!html.includes('linear-gradient'), 'a photograph has no scale');
        assert.equal(escaped(`<a href="x">&'`), '&lt;a href=&quot;x&quot;&gt;&amp;&#39;');
    });
});

describe('the report of a picture in false colour', () => {
    it('says what its colours stand for', () => {
        const html = reportHtml({
            title: 'Room',
            server: 'raybundle',
            time: new Date(0),
            epoch: 0,
            error: null,
            picture: 'data:image/jpeg;base64,AA==',
            scale: {
                title: 'Illuminance, fc',
                colours: ['#000', '#fff'],
                marks: [{text: '20', at: 1}, {text: '2', at: 2 / 3}],
            },
            address: 'http://a/',
            unit: 'fc',
            pins: [],
            points: [],
            grid: null,
            changes: [],
            pinsInPicture: [],
        });
        assert.match(html, /Illuminance, fc.*linear-gradient\(to right,#000,#fff\).*left:66\.67%">2</s);
    });
});

describe('the legend below a saved picture', () => {
    const MARKS = [2000, 1000, 500, 200, 100, 50].map((value, i) => ({text: String(value), at: 1 - i / 9}));
    const widthOf = (text, size) => text.length * size * 0.6;

    it('is as large on every screen, in more pixels', () => {
        const one = layOutStrip(900, 1, MARKS, widthOf);
        const two = layOutStrip(1800, 2, MARKS, widthOf);
        assert.equal(two.height, 2 * one.height);
        assert.equal(two.textSize, 2 * one.textSize);
        close(two.bar.width, 2 * one.bar.width, 1e-9);
        assert.deepEqual(two.labels.map(({text}) => text), MARKS.map(({text}) => text));
    });

    it('has its labels below their values, within the picture and apart', () => {
        for (const width of [120, 300, 900]) {
            const {bar, labels, textSize} = layOutStrip(width, 1, MARKS, widthOf);
            assert.ok(bar.x + bar.width < width);
            assert.equal(labels[0].text, '2000');
            let free = width;
            for (const {text, x, tick} of labels) {
                const half = widthOf(text, textSize) / 2;
                close(tick, bar.x + MARKS.find((mark) => mark.text === text).at * bar.width, 1e-9);
                assert.ok(x - half >= 0 && x + half <= free, `${text} at ${x} of ${width}`);
                free = x - half;
            }
        }
        assert.ok(layOutStrip(120, 1, MARKS, widthOf).labels.length < MARKS.length);
    });
});

describe('what the page says', () => {
    it('of what a server says', () => {
        assert.equal(sentence('hello.token: is not valid'), 'Token is not valid.');
        assert.equal(sentence('moveObject.object: no movable object 99'), 'No movable object 99.');
        assert.equal(sentence('room.gltf: no JSON'), 'Room.gltf: no JSON.');
        assert.equal(sentence('another scene is being opened'), 'Another scene is being opened.');
        assert.equal(sentence('openScene: the file: broken'), 'The file: broken.');
        assert.equal(sentence(''), '');
    });

    it('of a connection that is not', () => {
        const change = (state, code) => ({state, reason: '', code, retryAt: 0});
        assert.ok(bannerOf(change('refused', 'UNAUTHENTICATED'), false).asksForToken);
        assert.match(bannerOf(change('refused', 'UNIMPLEMENTED'), false).title, /versions/);
        assert.match(bannerOf(change('reconnecting', 'RESOURCE_EXHAUSTED'), false).title, /full/);
        assert.match(bannerOf(change('reconnecting', ''), true).title, /lost/);
    });

    it('of what to do meanwhile', () => {
        const advice = (state, code, reason, hasPicture = false, opening = '') =>
            adviceOf({state, code, reason, retryAt: 0}, hasPicture, opening);
        const token = (reason) => advice('refused', 'UNAUTHENTICATED', `hello.token: ${reason}`);
        assert.equal(token('is missing'), 'Whoever runs the server can give you one.');
        assert.match(token('is not valid'), /^Token is not valid\. Check that you copied all of it\./);
        const full = advice('reconnecting', 'RESOURCE_EXHAUSTED', 'the server is full, it takes 16 viewers');
        assert.equal(full, 'It takes 16 viewers. You will be let in when there is room.');
        assert.match(advice('refused', 'UNIMPLEMENTED', 'hello.protocol: client speaks 1.0, server speaks 2.0'),
            /updated\. Client speaks 1\.0, server speaks 2\.0\. If loading/);
        assert.match(advice('reconnecting', '', '', true), /last picture.*by itself/);
        assert.match(advice('reconnecting', '', '', true, 'a.glb'), /comes back by itself/);
        assert.equal(advice('reconnecting', '', 'The server has gone silent.'), 'The server has gone silent.');
    });

    it('of targets', () => {
        close(targetAt('error', 0), 0.2, 1e-9);
        close(targetAt('error', 1), 0.005, 1e-9);
        assert.equal(duration(0.3), 'less than a second');
        assert.equal(duration(42), '42 s');
        assert.equal(duration(300), '5 min');
    });

    it('of others: where they look', () => {
        const {eye, corners} = frustumOf({...VIEW, aspect: 2, viewer: 1, name: '', role: 'VIEWER', following: 0});
        assert.deepEqual(eye, VIEW.eye);
        const width = length(sub(corners[1], corners[0]));
        close(width / length(sub(corners[2], corners[1])), 2, 1e-9);
    });
});

describe('a controller', () => {
    it('rests in its dead zone and reaches full speed', () => {
        assert.equal(outsideDeadZone(0.1), 0);
        assert.equal(outsideDeadZone(-1), -1);
        close(outsideDeadZone(0.575), 0.5, 1e-9);
    });
});

describe('lightState', () => {
    const state = (settled, relativeError, errorHigh, known = true) => lightState({settled, relativeError, errorHigh}, known);

    it('is green for a picture whose error is known to be small alone', () => {
        assert.deepEqual(state(1, 0.05, 0.08), {mark: 'yes', text: 'Light has settled'});
        assert.equal(state(1, 0.05, 0.12).mark, 'rough');
        assert.equal(state(1, 0.05, 0.12).text, 'First result, still noisy: error up to 12 %');
        assert.equal(state(1, 0.6, 1.5).text, 'First result, still noisy: error up to 100 %');
        assert.equal(state(1, null, null).text, 'First result, still noisy');
        assert.equal(state(1, null, null).mark, 'rough');
    });

    it('says where next to no light arrives, settled or not', () => {
        const dark = (settled) => lightState({settled, relativeError: null, errorHigh: null, darkerThan: 0.01}, true);
        assert.deepEqual(dark(1), {mark: 'yes', text: 'Next to no light arrives here'});
        assert.deepEqual(dark(0.5), {mark: 'no', text: 'Next to no light arrives here'});
    });

    it('says first what a change still brings', () => {
        assert.deepEqual(state(0.5, 0.05, 0.08), {mark: 'no', text: 'Light is settling, 50 %'});
        assert.deepEqual(state(0, null, null, false), {mark: 'no', text: 'Waiting for light'});
    });
});

describe('places and aims of lights', () => {
    it('say an aim by tilt and heading, and take it back', () => {
        for (const [tilt, heading] of [[0, 0], [30, 0], [90, 90], [45, 200], [180, 0]]) {
            const angles = anglesOf(aimOf({tilt, heading}));
            close(angles.tilt, tilt, 1e-6);
            close(angles.heading, heading, 1e-6);
        }
        const {x, y, z} = aimOf({tilt: 90, heading: 90});  // level, to the east
        assert.deepEqual([Math.round(x), Math.round(y), Math.round(z)].map(Math.abs), [1, 0, 0]);
        assert.equal(aimAt({x: 1, y: 2, z: 3}, {x: 1, y: 2, z: 3}), null);
        assert.deepEqual(aimAt({x: 1, y: 2, z: 3}, {x: 1, y: 0, z: 3}), {x: 0, y: -2, z: 0});
    });

    it('are sorted into groups, which may be mixed', () => {
        const light = (/** @type {number} */ id, /** @type {string} */ group, /** @type {number} */ dim, on = true) =>
            ({id, name: `l${id}`, kind: 'POINT', unit: 'CD', intensity: 1, colour: {x: 1, y: 1, z: 1}, on, group, dim});
        const groups = groupsOf([light(1, 'wall', 1), light(2, '', 1), light(3, 'desk', 0.5), light(4, 'wall', 0.2, false)]);
        assert.deepEqual(groups.map(({name, lights}) => [name, lights.length]), [['desk', 1], ['wall', 2]]);
        assert.deepEqual(groupState(groups[0]), {on: true, mixed: false, dim: 0.5});
        assert.deepEqual(groupState(groups[1]), {on: true, mixed: true, dim: null});
    });
});

describe('times of daylight', () => {
    it('carry the zone of the place, summer time included', () => {
        assert.equal(timeAt('2026-06-21', 900, 'Europe/Berlin'), '2026-06-21T15:00:00+02:00');
        assert.equal(timeAt('2026-12-21', 905, 'Europe/Berlin'), '2026-12-21T15:05:00+01:00');
        assert.equal(timeAt('2026-01-01', 60, 'Asia/Kolkata'), '2026-01-01T01:00:00+05:30');
        assert.equal(timeAt('2026-07-01', 0, 'America/New_York'), '2026-07-01T00:00:00-04:00');
        // The night when clocks go forward: 12:00 is summer time already.
        assert.equal(timeAt('2026-03-29', 720, 'Europe/Berlin'), '2026-03-29T12:00:00+02:00');
        assert.equal(zoneOf({latitude: 52.52, longitude: 13.41}), 'Europe/Berlin');
        assert.equal(zoneOf({latitude: 0, longitude: -75}), 'Etc/GMT+5');
        assert.deepEqual(partsOf('2026-06-21T15:20:00+02:00'), {date: '2026-06-21', minute: 920});
        assert.equal(partsOf(''), null);
    });

    it('say where the sun stands', () => {
        assert.equal(sunText({sky: 'clear', sunElevation: 35.65, sunAzimuth: -96.2}), 'Sun 35.6° high, at 264° from −z over +x');
        assert.equal(sunText({sky: 'clear', sunElevation: -3}), 'The sun has set: the sky is dark.');
        assert.equal(sunText({sky: 'loaded'}), '');
    });
});

describe('work plane', () => {
    it('lies over bounds at a height above their floor', () => {
        const bounds = {min: {x: 1, y: 2, z: 3}, max: {x: 5, y: 4, z: 9}};
        assert.deepEqual(areaOver(bounds, bounds.min.y, 0.75), {
            origin: {x: 1, y: 2.75, z: 3}, u: {x: 4, y: 0, z: 0}, v: {x: 0, y: 0, z: 6},
        });
    });

    it('says values with intervals, in the unit that is chosen', () => {
        assert.deepEqual(withInterval(500, 490, 510, valueText('HORIZONTAL', 'lx')), {value: '500 lx', interval: '490 lx to 510 lx'});
        assert.equal(valueText('HORIZONTAL', 'fc')(107.639), '10.0 fc');
        assert.equal(valueText('DAYLIGHT_FACTOR', 'fc')(2), '2.00 %');
        assert.deepEqual(withInterval(undefined, undefined, undefined, String), {value: '–', interval: ''});
    });

    it('says what is left out, and what is not known yet', () => {
        const point = (/** @type {boolean} */ inside) => ({position: {x: 0, y: 1, z: 0.5}, value: inside ? undefined : 3, inside});
        const result = {measurement: 1, quantity: 'HORIZONTAL', epoch: 0, settled: 1, columns: 2, rows: 1, factor: 0.8,
            points: [point(false), point(true)]};
        assert.equal(planeState(result),
            '2 × 1 points, at y = 1.00 m. 1 lies in a solid and is left out. Maintained: times 0.8. The values are still uncertain.');
        assert.match(planeState({...result, relativeError: 0.031}), /Values are known within 3\.10 % of the mean\.$/);
        assert.match(planeState({...result, relativeError: 1e-9}), /The values are exact\.$/);
        assert.match(planeState({...result, direct: true}), /left out\. Direct light only\. Maintained/);
        const dark = {...result, mean: 3, points: [point(false), {...point(false), value: 0}]};
        assert.match(planeState(dark), /m\. 1 is dark and counted: if it lies outside of the rooms/);
        assert.doesNotMatch(planeState({...dark, direct: true}), /is dark/);
        assert.match(planeState({...result, columns: 2, rows: 2}), /^2 points, /, 'an outline leaves some of its box out');
        assert.equal(planeCsv(result, 'lx').split('\n')[2], '0.0000,1.0000,0.5000,,,,in a solid');
    });
});

describe('floors', () => {
    const box = (/** @type {number[]} */ [x0, y0, z0, x1, y1, z1]) => ({min: vec3(x0, y0, z0), max: vec3(x1, y1, z1)});
    const part = (/** @type {string} */ name, /** @type {number[]} */ at, kind = 'STRUCTURE') =>
        new PlacedObject({id: 1, name, movable: true, kind, bounds: box(at), transform: {}});
    const storey = [
        part('slab', [0, -0.3, 0, 8, 0, 6]), part('wall', [0, 0, 0, 8, 2.7, 0.2]), part('ceiling', [0, 2.7, 0, 8, 3, 6]),
        part('sill', [0, 0.9, 0, 0.4, 0.95, 6]), part('table', [1, 0, 1, 5, 0.74, 5], 'THING'),
    ];
    const bounds = box([0, -0.3, 0, 8, 3, 6]);

    it('are the tops of slabs, not their undersides, nor tables, sills and ceilings', () => {
        assert.equal(lowestFloor(storey, bounds), 0);
        assert.equal(lowestFloor(storey.slice(1), bounds), null, 'a ceiling is none');
    });

    it('are the tops of what lies on slabs, but not of a platform', () => {
        const screed = part('screed', [0.1, 0, 0.1, 7.9, 0.08, 5.9]);
        assert.equal(lowestFloor([...storey, screed], bounds), 0.08);
        assert.equal(lowestFloor([...storey, part('thin', [0, 0, 0, 8, 0.03, 6])], bounds), 0.03);
        assert.equal(lowestFloor([...storey, part('platform', [0, 0, 0, 4, 0.2, 4])], bounds), 0);
    });

    it('are made of several slabs, as round a stair', () => {
        const parts = [part('a', [-0.2, 2.7, 1.2, 8.2, 3, 6.2]), part('b', [-0.2, 2.7, 0, 1, 3, 1.2]), part('roof', [0, 5.7, 0, 8, 6, 6])];
        assert.equal(lowestFloor(parts, box([-0.2, 2.7, 0, 8.2, 6, 6.2])), 3);
    });

    it('below a thing are where it stands, and of a slab its own top', () => {
        assert.equal(floorBelow(storey, box([1, 0, 1, 5, 0.74, 5])), 0);
        assert.equal(floorBelow(storey, box([1, 0.71, 1, 5, 0.74, 5])), 0, 'of a table top as of the table');
        assert.equal(floorBelow(storey, storey[0].bounds), 0);
        assert.equal(floorBelow([...storey, part('gallery', [0, 3.1, 0, 8, 3.3, 6])], box([1, 3.3, 1, 2, 4, 2])), 3.3);
        assert.equal(floorBelow([part('lamp', [0, 0, 0, 1, 1, 1], 'THING')], box([0, 0, 0, 1, 1, 1])), null);
    });

    it('and ceilings are where luminaires are wanted: ahead, in the room that one is in', () => {
        assert.equal(ceilingAbove(storey, vec3(2, 1.6, 2)), 2.7);
        assert.equal(ceilingAbove(storey, vec3(9, 1.6, 2)), null);
        const scene = /** @type {any} */ ({bounds, objects: storey});
        const view = {...VIEW, eye: vec3(2, 1.6, 2), target: vec3(5, 1.6, 6)};
        const {x, y, z} = likelyPlace(scene, view, (_, to) => to);
        [[x, 2.9], [y, 2.6], [z, 3.2]].forEach(([value, right]) => close(value, right, 1e-9));
        assert.deepEqual(likelyPlace(scene, {...view, eye: vec3(9, 9, 9)}, (_, to) => to), vec3(4, 2.9, 3), 'from outside: the middle');
    });

    it('carry outlines at a height above them', () => {
        assert.deepEqual(outlineOver([vec3(0, 0.02, 0), vec3(1, 0, 0), vec3(1, -0.01, 1)], 0, 0.75),
            [vec3(0, 0.75, 0), vec3(1, 0.75, 0), vec3(1, 0.75, 1)]);
    });
});

describe('zones', () => {
    const zone = {measurement: 1, quantity: 'HORIZONTAL', epoch: 0, settled: 1, columns: 1, rows: 1, factor: 1, points: [],
        mean: 512, meanLow: 505, meanHigh: 519, uniformity: 0.71};

    it('say what they have, in the unit that is chosen', () => {
        assert.equal(zoneValues(zone, 'lx'), 'Em 512 lx (505 lx to 519 lx), Uo 0.71');
        assert.equal(zoneValues({...zone, quantity: 'UGR', maximum: 20.24, maximumLow: 20.1, maximumHigh: 20.4}, 'fc'),
            'UGR 20.2 (20.1 to 20.4) where it is worst');
        assert.match(zoneValues({...zone, direct: true}, 'lx'), /Uo 0\.71, direct light only$/);
        assert.equal(zoneValues({...zone, mean: undefined}, 'lx'), 'Em being measured …');
        const outside = {position: {x: 0, y: 0, z: 0}, inside: false, glare: /** @type {any} */ ({state: 'OUTSIDE'})};
        assert.equal(zoneValues({...zone, quantity: 'UGR', points: [outside]}, 'lx'), 'UGR outside of the method');
    });

    it('say what lights them; a glowing material, on however many luminaires, has no number', () => {
        const lit = {...zone, luminaires: [
            {light: 1, name: 'LED', power: 1, share: 0.6}, {light: 2, name: 'spot', share: 0.3}, {light: 3, name: 'spot', share: 0.1},
        ]};
        const isMaterial = (/** @type {number} */ light) => light === 1;
        assert.deepEqual(luminaireLines(/** @type {any} */ (lit), isMaterial),
            ['all surfaces of LED, Ra not stated', '2 × spot, Ra not stated']);
        assert.equal(litBy(/** @type {any} */ (lit), isMaterial), 'Lit by 2 luminaires and 1 glowing material');
        assert.equal(litBy(/** @type {any} */ (lit)), 'Lit by 3 luminaires');
        assert.equal(litBy(/** @type {any} */ ({...zone, luminaires: lit.luminaires.slice(0, 1)}), isMaterial), 'Lit by 1 glowing material');
    });

    it('say what is required, and whether it is met, without colour', () => {
        assert.equal(checkText({what: 'Em', required: 500, atMost: false, verdict: 'MET'}, 'lx'), 'Em ≥ 500 lx: met');
        assert.equal(checkText({what: 'UGR', required: 19, atMost: true, verdict: 'NOT_YET_KNOWN'}, 'fc'), 'UGR ≤ 19: not yet known');
        assert.deepEqual(['MET', 'MISSED', 'NOT_YET_KNOWN', undefined].map((v) => verdictSign(/** @type {any} */ (v))), ['✓', '✗', '?', '']);
    });
});
