// SPDX-License-Identifier: Apache-2.0
// What people read and press: who is here and may do what, keys while the server has not answered, dark and light,
// narrow screens. The server says what a test wants.

import assert from 'node:assert/strict';
import {describe, it} from 'node:test';

import {keepScreenshot} from './browser.mjs';
import {fakePages} from './fake_page.mjs';
import {WELCOME} from './fake_server.mjs';

const openAny = fakePages();
const CAMERA = WELCOME.scene.cameras[0];
const person = (viewer, name, role = 'EDITOR') => ({...CAMERA, viewer, name, role, aspect: 1, following: 0});

/** A server that welcomes; `more` answers other requests, `extra` is in the welcome, `after` comes behind it. */
const welcomes =
    ({extra = {}, after = [], more = () => null} = {}) =>
    (request, send) => {
        if (request.hello) {
            send({welcome: {...WELCOME, ...extra}});
            after.forEach((message) => send({replyTo: undefined, ...message}));
        } else {
            more(request, send) ?? send({ok: {}});
        }
    };

async function openPage(server = {}, options = {}) {
    const opened = await openAny(welcomes(server), options);
    await opened.page.waitForFunction(() => window.raybundle?.client.state === 'connected');
    return opened;
}

const noticed = (page, text) => page.waitForSelector(`.notice:has-text("${text}")`);

describe('a note', () => {
    it('gets the letters that are typed before the server has answered where it lies', async () => {
        let answer = () => {};
        const more = (request, send) => {
            if (!request.probe) {
                return null;
            }
            answer = () =>
                send({probeResult: {hit: true, position: {x: 2, y: 1, z: 0}, normal: {x: 0, y: 0, z: 1}, object: 1, patch: 7, illuminance: 100, relativeError: 0.7, epoch: 0}});
            return true;
        };
        const {page, sent, faults} = await openPage({more});
        const before = await page.evaluate(() => JSON.stringify(window.raybundle.view));
        await page.click('[data-tool="pin"]');
        await page.mouse.click(500, 350);
        await page.keyboard.type('was dark');
        await page.keyboard.press('Enter');
        assert.equal(await page.inputValue('.pin-editor textarea'), 'was dark');
        assert.equal(await page.evaluate(() => JSON.stringify(window.raybundle.view)), before, 'the camera stays');
        assert.ok(!sent.some(({addPin}) => addPin));
        answer();
        await page.waitForSelector('.pin-editor', {state: 'detached'});
        const {addPin} = sent.find((message) => message.addPin);
        assert.equal(addPin.text, 'was dark');
        assert.equal(addPin.patch, 7);
        assert.deepEqual(faults, []);
    });

    it('says what is hardly known in words that are read once', async () => {
        const probe = {hit: true, position: {x: 2, y: 1, z: 0}, normal: {x: 0, y: 0, z: 1}, object: 1, illuminance: 912, relativeError: 0.7, epoch: 0};
        const {page} = await openPage({more: (request, send) => (request.probe ? (send({probeResult: probe}), true) : null)});
        await page.click('[data-tool="pin"]');
        await page.mouse.click(500, 350);
        await page.waitForFunction(() => document.querySelector('.pin-editor p')?.textContent === '≈ 900 lx, still uncertain');
    });
});

describe('keys that remove and duplicate', () => {
    it('say why where they cannot', async () => {
        const {page} = await openPage({extra: {role: 'VIEWER'}});
        await page.focus('#picture');
        await page.keyboard.press('Control+KeyD');
        await noticed(page, 'Nothing is selected.');
        await page.click('#objects li:first-child button');
        await page.focus('#picture');
        await page.keyboard.press('Delete');
        await noticed(page, 'View only. Ask for editor access to change the scene.');
        assert.ok(await page.isHidden('#remove-object'));
    });
});

describe('who may only look', () => {
    it('sees no Pin, and reads how to get it', async () => {
        const {page} = await openPage({extra: {role: 'VIEWER'}});
        assert.ok(await page.isHidden('[data-tool="pin"]'));
        await page.focus('#picture');
        await page.keyboard.press('Digit3');
        await noticed(page, 'View only. Ask for reviewer access to add pins.');
        assert.equal(await page.evaluate(() => window.raybundle.tool), 'select');
        await page.click('#tab-review');
        assert.match(await page.locator('#pins-none').innerText(), /View only: ask for reviewer access/);
    });
});

describe('names', () => {
    it('of tokens are names, and cannot be changed by the page', async () => {
        const {page} = await openPage({extra: {name: 'Ann Lee'}, after: [{presence: {viewers: [person(1, 'Ann Lee')]}}]});
        await page.click('#tab-review');
        assert.equal(await page.inputValue('#own-name'), 'Ann Lee');
        assert.ok(await page.isDisabled('#own-name'));
        assert.ok(await page.isVisible('#name-note'));
    });

    it('of who comes are told once', async () => {
        const viewers = [person(1, ''), person(2, 'Ben')];
        const again = [person(1, ''), person(5, 'Ben')];
        const {page} = await openPage({
            after: [[person(1, '')], viewers, [person(1, '')], again].map((list) => ({presence: {viewers: list}})),
        });
        await noticed(page, 'Ben has joined.');
        assert.equal(await page.locator('.notice').count(), 1);
    });
});

describe('a server that many share', () => {
    it('tells everybody why pictures are slower', async () => {
        const presence = {viewers: [person(1, ''), person(2, 'Ben')], crowded: true};
        const {page} = await openPage({after: [{presence}, {presence}]});
        await noticed(page, '2 people share this server: pictures now come less often for everybody.');
        await keepScreenshot(page, 'crowded');
    });
});

describe('points that have been measured', () => {
    it('are there again when the page is loaded again', async () => {
        const probe = {hit: true, position: {x: 2, y: 1, z: 0}, normal: {x: 0, y: 0, z: 1}, object: 1, illuminance: 480, luminance: 60, relativeError: 0.01, epoch: 0};
        const {page} = await openPage({more: (request, send) => (request.probe ? (send({probeResult: probe}), true) : null)});
        await page.click('[data-tool="measure"]');
        await page.mouse.click(500, 350);
        await page.waitForFunction(() => window.raybundleParts.measuring.points.length === 1);
        await page.reload();
        await page.waitForFunction(() => window.raybundleParts?.measuring.points.length === 1);
        await page.click('#tab-measure');
        assert.match(await page.textContent('#points tbody'), /480 lx/);
        await page.focus('#picture');
        await page.keyboard.press('Digit2');
        await page.keyboard.press('Delete');
        await page.waitForFunction(() => window.raybundleParts.measuring.points.length === 0);
    });
});

describe('saving', () => {
    it('is stated where there is none, and where it fails', async () => {
        const solution = {epoch: 0, iterations: 1, iterationsPerSecond: 1, settled: 0, saving: 'FAILING'};
        const {page} = await openPage({extra: {saving: 'NOT_SAVED'}});
        assert.equal(await page.textContent('#saving'), 'Not saved');
        assert.match(await page.getAttribute('#saving', 'title'), /a restart loses changes/);
        await page.evaluate((message) => window.raybundle.client.dispatchEvent(new CustomEvent('solution', {detail: message})), solution);
        assert.equal(await page.textContent('#saving'), 'Cannot save');
    });
});

describe('dark and light', () => {
    it('are chosen by a button, and kept', async () => {
        const {page} = await openPage({}, {colorScheme: 'dark'});
        const shade = () => page.evaluate(() => getComputedStyle(document.querySelector('#panel')).backgroundColor);
        const dark = await shade();
        await page.click('#theme');
        const light = await shade();
        assert.notEqual(light, dark);
        await keepScreenshot(page, 'light_chosen');
        await page.reload();
        await page.waitForFunction(() => window.raybundle?.client.state === 'connected');
        assert.equal(await shade(), light);
        await page.click('#theme');
        assert.equal(await shade(), dark);
    });
});

describe('a narrow screen', () => {
    it('has Share, and no control alone in a row', async () => {
        const presence = {viewers: ['', 'Ann Lee', 'Ben', 'Cleo', 'Dan'].map((name, i) => person(i + 1, name))};
        const phone = {hasTouch: true, isMobile: true, deviceScaleFactor: 2};
        const {page} = await openPage({after: [{presence}]}, {viewport: {width: 360, height: 740}, ...phone});
        await page.waitForSelector('#avatars li');
        const icon = await page.locator('#share svg').boundingBox();
        assert.ok(icon.width > 10 && icon.x + icon.width <= 360);
        const rows = () =>
            page.evaluate(() => {
                const controls = [...document.querySelectorAll('.toolbar :is(.segments, .tool-field, .tool-group > button)')];
                const seen = controls.filter((control) => control.checkVisibility()).map((control) => control.getBoundingClientRect());
                const middles = seen.map(({top, bottom}) => Math.round((top + bottom) / 20));
                return [...new Set(middles)].map((middle) => middles.filter((other) => other === middle).length);
            });
        const inside = () => page.evaluate(() => document.documentElement.scrollWidth <= innerWidth);
        await keepScreenshot(page, 'narrow');
        for (const width of [360, 412, 600, 760, 1000, 1400]) {
            await page.setViewportSize({width, height: 740});
            for (const open of [false, true]) {
                await page.evaluate((on) => document.getElementById('app').classList.toggle('panel-closed', !on), open);
                const counts = await rows();
                assert.ok(counts.length === 1 || counts.every((count) => count > 1), `${width} ${open}: ${counts.join()}`);
                assert.ok(await inside(), `${width} wide`);
            }
        }
        await page.setViewportSize({width: 360, height: 740});
        await keepScreenshot(page, 'narrow_panel');
    });
});
