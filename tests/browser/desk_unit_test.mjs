// SPDX-License-Identifier: Apache-2.0
// What the page says of changes, people and numbers, without a browser.

import assert from 'node:assert/strict';
import {readFileSync, readdirSync} from 'node:fs';
import path from 'node:path';
import {describe, it} from 'node:test';

import {Arrivals} from '../../client_web/review/arrivals.js';
import {describeChange} from '../../client_web/review/change_list.js';
import {onScale, scaleColour, turboColour, valueOnScale} from '../../client_web/measure/colour.js';
import {linearTicks} from '../../client_web/measure/display_panel.js';
import {gridCsv, intervalsOf, summaryOf, uniformityText} from '../../client_web/measure/grid.js';
import {chosenLabels, crossingsOf, placeOf} from '../../client_web/measure/isolines.js';
import {SceneModel} from '../../client_web/scene/scene_model.js';
import {measured, plusMinus, plusMinusCell} from '../../client_web/ui/units.js';
import {vec3} from '../../client_web/ui/vector.js';
import {ROOT} from './daemon.mjs';

const WHITE = vec3(1, 1, 1);
const BOUNDS = {min: vec3(0, 0, 0), max: vec3(1, 1, 1)};
const SCENE = new SceneModel(
    {
        name: 'room',
        bounds: BOUNDS,
        objects: [{id: 1, name: 'table', movable: true, bounds: BOUNDS, transform: {}}],
        lights: [
            {id: 1, name: 'LED panel', kind: 'AREA', intensity: 500, unit: 'LM', colour: WHITE, on: true, loadedIntensity: 1000, loadedColour: WHITE},
        ],
        materials: [{id: 1, name: 'paint', baseColour: WHITE, roughness: 1, metallic: 0}],
        cameras: [],
        effects: [],
    },
    3,
);
const says = (change) => describeChange(SCENE, {epoch: 1, by: 1, ...change});

describe('a change in the history', () => {
    it('has what was before and what is now', () => {
        const light = {light: 1, on: true, colour: WHITE};
        const dimmed = {lightBefore: {...light, intensity: 1000}, setLight: {light: 1, intensity: 500}};
        assert.equal(says(dimmed), 'dimmed LED panel: 100 → 50\u00a0%');
        const slowly = {...dimmed, setLight: {...dimmed.setLight, fadeSeconds: 1.5}};
        assert.equal(says(slowly), 'dimmed LED panel: 100 → 50\u00a0% over 1.5\u00a0s');
        const off = {lightBefore: {...light, intensity: 1000}, setLight: {light: 1, on: false}};
        assert.equal(says(off), 'switched off LED panel');
        const moved = {objectBefore: {object: 1, transform: {}}, moveObject: {object: 1, transform: {translation: vec3(0.5, 0, 0)}}};
        assert.equal(says(moved), 'moved table by 0.50 m: 0.50 0.00 0.50 → 1.00 0.00 0.50\u00a0m', 'as the panel has it');
        const back = {objectBefore: moved.moveObject, moveObject: {object: 1, transform: {}}};
        assert.equal(says(back), 'put back table');
        const elsewhere = {translation: {x: -4, y: 0, z: 0}, rotation: {x: 0, y: 0, z: 0, w: 1}, scale: {x: 1, y: 1, z: 1}};
        const opened = describeChange(SCENE, {epoch: 1, by: 1, ...back}, elsewhere);
        assert.match(opened, /^moved table/, 'where a page finds an object is not where the file has it');
        const size = (/** @type {number} */ scale) => ({object: 1, transform: {...elsewhere, scale: vec3(scale, scale, scale)}});
        const larger = {epoch: 1, by: 1, objectBefore: size(2), moveObject: size(3)};
        assert.equal(describeChange(SCENE, larger, size(2).transform), 'resized table: 100 → 150 %', 'of the size in the file');
        const rough = {materialBefore: {material: 1, roughness: 1}, setMaterial: {material: 1, roughness: 0.25}};
        assert.equal(says(rough), 'set the roughness of paint: 1.00 → 0.25');
    });

    it('has reflectances, as the card of a material, and colours where the hue changes', () => {
        const grey = (share) => vec3(share, share, share);
        const painted = (before, after) =>
            says({materialBefore: {material: 1, baseColour: before}, setMaterial: {material: 1, baseColour: after}});
        assert.equal(painted(grey(0.42), grey(0.8)), 'painted paint: 42 → 80\u00a0%');
        assert.equal(painted(vec3(0.4, 0.2, 0.1), vec3(0.2, 0.1, 0.05)), 'painted paint: 24 → 12\u00a0%');
        assert.match(painted(grey(0.5), vec3(1, 0, 0)), /^painted paint: #bcbcbc → #ff0000, 50 → 21\u00a0%$/);
    });

    it('of a server that does not tell, or of something unknown, still says what it was', () => {
        assert.equal(says({setLight: {light: 1, on: true}}), 'switched on LED panel');
        assert.equal(says({moveObject: {object: 9, transform: {}}}), 'moved an object');
    });
});

describe('who comes', () => {
    const [ann, ben] = [{viewer: 1, name: 'Ann'}, {viewer: 2, name: 'Ben'}];

    it('is told of once, and not when the scene changes or a page is loaded again', () => {
        const arrivals = new Arrivals();
        assert.deepEqual(arrivals.note([ann], 0), [], 'who is here first has not just come');
        assert.deepEqual(arrivals.note([ann, ben], 1000), ['Ben']);
        assert.deepEqual(arrivals.note([ann, ben, {viewer: 3, name: 'Ben'}], 2000), []);
        assert.deepEqual(arrivals.note([ann], 3000), []);
        assert.deepEqual(arrivals.note([ann, {viewer: 7, name: 'Ben'}], 4000), []);
        arrivals.begin(5000);
        assert.deepEqual(arrivals.note([{viewer: 11, name: ''}, {viewer: 12, name: 'Ann'}], 5001), []);
    });

    it('is told of again after a minute', () => {
        const arrivals = new Arrivals();
        arrivals.note([ann, ben], 0);
        assert.deepEqual(arrivals.note([ann, ben], 70000), ['Ann', 'Ben'], 'nobody was heard of meanwhile');
        assert.deepEqual(arrivals.note([ann, ben, {viewer: 5, name: ''}], 70001), ['Viewer 5']);
    });
});

describe('numbers', () => {
    const grid = {origin: vec3(0, 0, 0), stepX: vec3(1, 0, 0), stepY: vec3(0, 0, 1), columns: 2, rows: 1};

    it('are followed by the same interval on the page and in tables, with units in the head', () => {
        assert.equal(plusMinus(0.0117), '± 2.3 %');
        assert.equal(plusMinusCell(0.0117), '2.29');
        assert.equal(plusMinusCell(-1), '');
        const [head, first, second] = gridCsv(grid, {illuminance: [100, -1], relativeError: [0.0117, -1], epoch: 2}).split('\r\n');
        assert.match(head, /illuminance_lx,plus_minus_95_percent,after_change/);
        assert.match(first, /,100\.000,2\.29,2,$/);
        assert.match(second, /,,,2,not in view$/);
        const feet = gridCsv(grid, {illuminance: [107.63910416709722, 0], relativeError: [0.7, 0], epoch: 2}, 'fc').split('\r\n');
        assert.match(feet[0], /illuminance_fc/);
        assert.match(feet[1], /,10\.0000,137,2,still uncertain$/);
    });

    it('that are hardly known say so, uniformity too', () => {
        assert.equal(measured(912, 'lx', 0.6), '≈ 900 lx, still uncertain');
        const uncertain = [[100, 200], [0.6, 0.1]];
        assert.equal(uniformityText(summaryOf(uncertain[0]), intervalsOf(...uncertain)), 'not yet known');
        assert.equal(uniformityText(summaryOf([100, 200]), intervalsOf([100, 200], [-1, 0.1])), 'not yet known');
        assert.equal(uniformityText(summaryOf([100, 200]), intervalsOf([100, 200], [0.02, 0.02])), '0.67');
    });
});

describe('a scale of colours', () => {
    it('is logarithmic or linear, with white above and black below', () => {
        assert.equal(onScale(250, 1000, true), 0.25);
        assert.ok(Math.abs(valueOnScale(onScale(37, 1000), 1000, false) - 37) < 1e-9);
        assert.equal(valueOnScale(0.25, 1000, true), 250);
        assert.equal(scaleColour(1001, 1000, false), '#fff');
        assert.equal(scaleColour(0.9, 1000, false), '#000');
        assert.match(scaleColour(0.9, 1000, true), /^rgb/);
        assert.deepEqual(linearTicks(1000), [1000, 800, 600, 400, 200, 0]);
        assert.deepEqual(linearTicks(50), [50, 40, 30, 20, 10, 0]);
    });
});

describe('numbers at isolines', () => {
    it('are read from the colours of the picture', () => {
        for (const at of [0.2, 0.5, 0.9]) {
            assert.ok(Math.abs(placeOf(...turboColour(at)) - at) < 0.01);
        }
        assert.equal(placeOf(10, 8, 9), null, 'a line, or below the scale');
        assert.equal(placeOf(255, 255, 255), null, 'above the scale');
    });

    it('stand where their value is passed, not at edges', () => {
        assert.deepEqual(crossingsOf([150, 180, 220, 240], 4, [200]), [{level: 200, column: 1.5, row: 0}]);
        assert.deepEqual(crossingsOf([180, null, 220], 3, [200]), [{level: 200, column: 1, row: 0}], 'the line is dark');
        assert.deepEqual(crossingsOf([50, 400, 400], 3, [200]), []);
    });

    it('are few, and apart', () => {
        const row = Array.from({length: 60}, (_, i) => ({level: 100, x: 10 * i, y: 50}));
        const chosen = chosenLabels(row, {x: 300, y: 50});
        assert.ok(chosen.length >= 2 && chosen.length <= 3);
        assert.equal(chosen[0].x, 300);
    });
});

describe('the executable', () => {
    it('has every file of the page', () => {
        const listed = ['net', 'projects'].flatMap((folder) =>
            readFileSync(path.join(ROOT, 'server', folder, 'CMakeLists.txt'), 'utf8').split(/[\s()]+/));
        const files = readdirSync(path.join(ROOT, 'client_web'), {recursive: true}).filter((file) => /\.(js|css|html)$/.test(file));
        assert.deepEqual(files.filter((file) => !listed.includes(file)), []);
    });
});
