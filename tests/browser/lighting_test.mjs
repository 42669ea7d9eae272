// SPDX-License-Identifier: Apache-2.0
// What a lighting designer does: lamps in groups, placed and aimed; daylight by the clock; a work plane.

import assert from 'node:assert/strict';
import {describe, it} from 'node:test';

import {keepScreenshot} from './browser.mjs';
import {fakePages} from './fake_page.mjs';
import {WELCOME} from './fake_server.mjs';

const openPage = fakePages();

describe('lamps', () => {
    it('are grouped, dimmed as one, placed and aimed by a click, and kept as a lighting scene', async () => {
        const [lamp] = WELCOME.scene.lights;
        const placed = {group: '', dim: 1, position: {x: 0, y: 2, z: 0}, aim: {x: 0, y: -1, z: 0}, rotation: 0};
        const lights = [1, 2].map((id) => ({...lamp, id, name: `spot ${id}`, kind: 'POINT', unit: 'LM', ...placed}));
        let [epoch, dim] = [0, 1];
        const {page, sent, faults} = await openPage((request, send) => {
            const {hello, setLight, setGroup, saveLightingScene, probe} = request;
            if (hello) {
                send({welcome: {...WELCOME, scene: {...WELCOME.scene, lights}}});
            } else if (setLight) {
                send({sceneChanged: {epoch: ++epoch, by: 1, setLight}});
            } else if (saveLightingScene) {
                send({lightingSceneChanged: {...saveLightingScene, by: 1, byName: 'me', removed: false}});
            } else if (probe) {
                send({probeResult: {hit: true, position: {x: 3, y: 2, z: 0}}});
            } else {
                for (const light of setGroup ? [1, 2] : []) {
                    const lightBefore = {...placed, light, dim, intensity: lamp.intensity};
                    const setLight = {light, dim: setGroup.dim, fadeSeconds: setGroup.fadeSeconds};
                    send({sceneChanged: {epoch: ++epoch, by: 1, setLight, lightBefore}}, false);
                }
                dim = setGroup?.dim ?? dim;
                send({ok: {}});
            }
        }, {colorScheme: 'light'});
        await page.waitForFunction(() => window.raybundle.client.state === 'connected');
        await page.click('#tab-light');
        for (const name of ['spot 1', 'spot 2']) {
            await page.locator('#lights > li', {hasText: name}).locator('summary').click();
            await page.getByLabel(`${name}, group`).fill('stage');
            await page.keyboard.press('Enter');
        }
        await page.waitForFunction(() => document.querySelector('#light-groups b')?.textContent === 'stage (2)');
        await page.getByLabel('Group stage, dimmer').fill('0.4');
        await page.waitForFunction(() => window.raybundle.scene.lights.every(({dim}) => dim === 0.4));
        assert.equal(await page.textContent('#light-groups output'), '40 %');
        const dimmed = (/** @type {number} */ to) =>
            page.waitForFunction((dim) => window.raybundle.scene.lights.every((light) => light.dim === dim), to);
        await page.getByLabel('Fade of lamps, groups and lighting scenes, seconds').fill('2.5');
        await page.keyboard.press('Tab');
        await page.getByLabel('Group stage, dimmer').fill('0.7');
        await dimmed(0.7);
        assert.deepEqual(sent.flatMap(({setGroup}) => setGroup ?? []).at(-1), {group: 'stage', dim: 0.7, fadeSeconds: 2.5});
        assert.match(await page.textContent('#changes li'), /40 → 70\u00a0% over 2\.5\u00a0s$/);
        assert.equal(await page.evaluate(() => localStorage.getItem('raybundle.fade')), '2.5');
        await page.click('#undo');
        await dimmed(0.4);
        await page.locator('#lights > li', {hasText: 'spot 1'}).getByLabel('spot 1 on').click();
        await page.waitForFunction(() => !window.raybundle.scene.lights[0].on);
        assert.deepEqual(sent.flatMap(({setLight}) => setLight ?? []).at(-1), {light: 1, on: false, fadeSeconds: 2.5});
        await page.click('#undo');
        await page.waitForFunction(() => window.raybundle.scene.lights[0].on);
        assert.deepEqual(sent.flatMap(({setLight}) => setLight ?? []).at(-1), {light: 1, on: true});
        await page.getByLabel('spot 1, Height y').fill('2.6');
        await page.keyboard.press('Enter');
        await page.waitForFunction(() => window.raybundle.scene.lights[0].position.y === 2.6);
        await page.getByLabel('spot 1, Tilt from down').fill('90');
        await page.keyboard.press('Enter');
        await page.waitForFunction(() => Math.abs(window.raybundle.scene.lights[0].aim.z + 1) < 1e-6);
        await page.locator('#lights > li').first().getByText('Aim at a point').click();
        await page.locator('#picture').click({position: {x: 50, y: 50}});
        await page.waitForFunction(() => window.raybundle.scene.lights[0].aim.x > 0);
        assert.deepEqual(sent.flatMap(({setLight}) => (setLight?.aim ? [setLight.aim] : [])).at(-1), {x: 3, y: 2 - 2.6, z: 0});
        assert.equal(await page.evaluate(() => window.raybundle.tool), 'select');
        await page.fill('#lighting-name', 'Presentation');
        await page.keyboard.press('Enter');
        await page.locator('#lighting-scenes button', {hasText: 'Presentation'}).click();
        await keepScreenshot(page, 'light_groups');
        await page.waitForFunction(() => window.raybundle.scene.lightingScenes.length === 1);
        assert.deepEqual(sent.flatMap(({applyLightingScene}) => applyLightingScene ?? []), [{name: 'Presentation', fadeSeconds: 2.5}]);
        assert.deepEqual(faults, []);
    });
});

describe('daylight', () => {
    it('goes by place, date and the slider of the day, and back', async () => {
        const loaded = {sky: 'loaded', sunElevation: 45, sunAzimuth: 180, north: 0, time: ''};
        let epoch = 0;
        const {page, sent, faults} = await openPage((request, send) => {
            const {hello, setDaylight} = request;
            if (hello) {
                send({welcome: {...WELCOME, scene: {...WELCOME.scene, daylight: loaded}}});
            } else if (setDaylight) {
                const sun = {id: 2, name: 'sun', kind: 'DIRECTIONAL', unit: 'LX', intensity: 50000, colour: {x: 1, y: 1, z: 1}, on: true};
                const told = {sunElevation: 30, sunAzimuth: 270, ...setDaylight, lights: [sun, {...sun, id: 3, name: 'sky', kind: 'SKY'}]};
                send({sceneChanged: {epoch: ++epoch, by: 1, setDaylight: told}});
            } else {
                send({ok: {}});
            }
        }, {colorScheme: 'dark'});
        await page.waitForFunction(() => window.raybundle.client.state === 'connected');
        await page.click('#tab-light');
        assert.ok(await page.isHidden('#day-clock'));
        await page.selectOption('#day-sky', 'clear');
        await page.waitForSelector('#day-clock', {state: 'visible'});
        await page.selectOption('#day-city', 'Sydney');
        await page.fill('#day-date', '2026-12-21');
        await page.keyboard.press('Tab');
        await page.fill('#day-minute', '930');
        await page.waitForFunction(() => window.raybundle.scene.daylight.time === '2026-12-21T15:30:00+11:00');
        assert.deepEqual(sent.flatMap(({setDaylight}) => setDaylight ?? []).at(-1), {
            sky: 'clear', place: {latitude: -33.87, longitude: 151.21}, north: 0, time: '2026-12-21T15:30:00+11:00',
        });
        assert.equal(await page.textContent('#daylight .hint'), 'Sun 30.0° high, at 270° from −z over +x');
        const names = () => page.evaluate(() => window.raybundle.scene.lights.map(({name}) => name));
        assert.deepEqual(await names(), ['lamp', 'sun', 'sky']);
        assert.equal(await page.locator('#lights > li').count(), 3);
        await keepScreenshot(page, 'daylight');
        await page.selectOption('#day-sky', 'loaded');
        await page.waitForFunction(() => window.raybundle.scene.daylight.sky === 'loaded');
        await page.click('#undo');
        await page.waitForFunction(() => window.raybundle.scene.daylight.sky === 'clear');
        assert.deepEqual(faults, []);
    });
});

describe('a work plane', () => {
    const measured = (/** @type {number} */ mean) => ({
        measurement: 1, quantity: 'HORIZONTAL', epoch: 0, settled: 1, columns: 2, rows: 1, factor: 1, spacing: 0.6,
        points: [
            {position: {x: 1, y: 0.75, z: 2}, value: mean - 100, low: mean - 110, high: mean - 90, inside: false},
            {position: {x: 3, y: 0.75, z: 2}, value: mean + 100, low: mean + 90, high: mean + 110, inside: false},
        ],
        mean, meanLow: mean - 10, meanHigh: mean + 10, minimum: mean - 100, minimumLow: mean - 120, minimumHigh: mean - 80,
        maximum: mean + 100, maximumLow: mean + 80, maximumHigh: mean + 120, uniformity: 0.8, uniformityLow: 0.75,
        uniformityHigh: 0.85, relativeError: 0.03,
    });

    it('is measured with intervals, follows the light, and is one at a time', async () => {
        /** @type {(body: object) => void} */
        let say = () => {};
        const {page, sent, faults} = await openPage((request, send) => {
            say = send;
            const {hello, measure} = request;
            send(hello ? {welcome: WELCOME} : measure ? {measured: measured(500)} : {ok: {}});
        }, {colorScheme: 'light'});
        await page.waitForFunction(() => window.raybundle.client.state === 'connected');
        await page.click('#tab-measure');
        await page.click('#measure-plane');
        await page.waitForSelector('#plane-result', {state: 'visible'});
        const {measure} = sent.find((request) => request.measure);
        assert.equal(measure.quantity, 'HORIZONTAL');
        assert.equal(measure.grid, 'EN12464');
        assert.ok(measure.keep);
        assert.equal(measure.direct, false);
        const tile = (/** @type {string} */ name) => page.textContent(`[data-value="plane${name}"]`);
        assert.equal(await tile('Mean'), '500 lx');
        assert.equal(await tile('MeanInterval'), '490 lx to 510 lx');
        assert.equal(await tile('UniformityInterval'), '0.75 to 0.85');
        assert.match(await page.textContent('#plane-state'), /2 × 1 points, at most 0\.60 m apart/);
        await keepScreenshot(page, 'work_plane');
        say({measured: measured(300)});
        await page.waitForFunction(() => document.querySelector('[data-value="planeMean"]').textContent === '300 lx');
        await page.check('#plane-direct');
        await page.click('#measure-plane');
        await page.waitForFunction(() => document.querySelector('[data-value="planeMean"]').textContent === '500 lx');
        assert.equal(sent.findLast((request) => request.measure).measure.direct, true);
        assert.ok(sent.some(({removeMeasurement}) => removeMeasurement?.measurement === 1));
        await page.click('#clear-plane');
        await page.waitForSelector('#plane-result', {state: 'hidden'});
        assert.deepEqual(faults, []);
    });

    it('lies above floors, not above the undersides of slabs, and within points that are clicked', async () => {
        const bounds = {min: {x: 0, y: -0.2, z: 0}, max: {x: 4, y: 3, z: 5}};
        const slab = {id: 1, name: 'Floor', kind: 'STRUCTURE', movable: false, bounds: {...bounds, max: {x: 4, y: 0, z: 5}}, transform: {}};
        const corners = [{x: 1, y: 0, z: 1}, {x: 3, y: 0, z: 1}, {x: 1, y: 0, z: 4}];
        let clicks = 0;
        const {page, sent, faults} = await openPage((request, send) => {
            const {hello, measure, probe} = request;
            const hit = {hit: true, object: 1, material: 1, illuminance: 100, luminance: 10, relativeError: 0.1, epoch: 0};
            send(hello ? {welcome: {...WELCOME, scene: {...WELCOME.scene, bounds, objects: [slab]}}}
                : measure ? {measured: measured(500)}
                : probe ? {probeResult: {...hit, position: corners[clicks]}} : {ok: {}});
        });
        await page.waitForFunction(() => window.raybundle.client.state === 'connected');
        await page.click('#tab-measure');
        const measuredPlane = async () => {
            const before = sent.length;
            await page.click('#measure-plane');
            await page.waitForFunction(() => !document.getElementById('measure-plane').disabled);
            return sent.slice(before).find(({measure}) => measure).measure;
        };
        assert.equal((await measuredPlane()).area.origin.y, 0.75);
        assert.match(await page.textContent('#plane-state'), /at y = 0\.75 m/);
        await page.click('[data-tool="measure"]');
        for (; clicks < corners.length; ++clicks) {
            await page.click('#picture', {position: {x: 200 + 100 * clicks, y: 300}});
            await page.waitForFunction((count) => document.querySelectorAll('#points tbody tr').length > count, clicks);
        }
        await page.selectOption('#plane-over', 'points');
        const {outline, area, margin} = await measuredPlane();
        assert.deepEqual(outline, corners.map(({x, z}) => ({x, y: 0.75, z})));
        assert.equal(area, undefined);
        assert.equal(margin, 0);
        assert.deepEqual(faults, []);
    });
});
