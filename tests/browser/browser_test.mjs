// SPDX-License-Identifier: Apache-2.0
// The main job as a person sees it: the page of a running server, in Chromium. The tests build on one
// another and run in order.

import assert from 'node:assert/strict';
import {after, before, describe, it} from 'node:test';

import {
    PATIENCE_MS,
    brightnessAt,
    difference,
    frameWith,
    keepScreenshot,
    launchBrowser,
    onPage,
    openClient,
    thumbnail,
} from './browser.mjs';
import {Daemon} from './daemon.mjs';

const SCENE = 'scenes/cornell_box.gltf';
const SHORT_BOX = 'short box';

/** Floor in the shadow of the short box where it stands at first, metres. */
const FIRST_SHADOW = {x: 0.6, y: 0, z: 0.55};
/** Floor in its shadow once it has been dragged to the left of the picture. */
const SECOND_SHADOW = {x: 3.6, y: 0, z: 0.55};
/** A shadow is at least so much darker than the floor beside it, as encoded. */
const VISIBLE = 1.05;
/** The way of the drag, metres along x. */
const DRAG_M = 1;

describe('the page of a running server', () => {
    /** @type {Daemon} */
    let daemon;
    /** @type {import('playwright-core').Browser} */
    let browser;
    /** @type {Awaited<ReturnType<typeof openClient>>} */
    let desktop;

    before(async () => {
        browser = await launchBrowser();
        daemon = await Daemon.start(SCENE);
    });

    after(async () => {
        await browser?.close();
        await daemon?.stop();
    });

    it('shows a picture that is not black', async () => {
        const options = {viewport: {width: 1280, height: 800}, colorScheme: 'dark'};
        desktop = await openClient(browser, daemon.url, options);
        await frameWith(desktop.page, {settled: 0.5});
        const pixels = await thumbnail(desktop.page);
        const lit = pixels.filter((value) => value > 30).length / pixels.length;
        assert.ok(lit > 0.3, `only ${(100 * lit).toFixed(1)} % of the picture is lit`);
        assert.equal(await desktop.page.textContent('#connection-text'), 'Connected');
        await keepScreenshot(desktop.page, 'desktop');
    });

    it('shows another picture after a camera key', async () => {
        const {page} = desktop;
        const firstPicture = await thumbnail(page);
        const cameraId = await page.evaluate(() => window.raybundle.frame.cameraId);
        await page.focus('#picture');
        await page.keyboard.down('KeyA');
        await page.waitForTimeout(700);
        await page.keyboard.up('KeyA');
        await frameWith(page, {cameraId: cameraId + 1});
        await page.waitForFunction(() => {
            const {link, view} = window.raybundle;
            return link.shown && JSON.stringify(link.shown) === JSON.stringify(view);
        });
        const moved = difference(firstPicture, await thumbnail(page));
        assert.ok(moved > 2, `the picture differs by ${moved.toFixed(2)} of 255`);
        await keepScreenshot(page, 'after_camera_key');

        await page.keyboard.press('Home');
        await page.waitForFunction(() => {
            const {link, scene} = window.raybundle;
            return link.shown && Math.abs(link.shown.eye.x - scene.cameras[0].eye.x) < 1e-6;
        });
    });

    it('selects the object that is clicked', async () => {
        const {page} = desktop;
        const at = await onPage(page, await middleOf(page));
        await page.mouse.click(at.x, at.y);
        await page.waitForFunction((name) => window.raybundle.selected?.name === name, SHORT_BOX);
        await page.click('#tab-scene');
        assert.equal(await page.textContent('[data-value="selectionName"]'), SHORT_BOX);
        assert.notEqual(await page.getAttribute('#overlay .selected .stroke', 'd'), '');
    });

    it('moves the shadow with the object that is dragged', async (t) => {
        const {page} = desktop;
        const start = await shadowsWhere(page, 0, ({first, second}) => second > VISIBLE * first);
        const middle = await middleOf(page);
        await dragBy(page, middle, DRAG_M);
        // What can be undone the server has answered: the epoch is that of the last step of the drag.
        await page.waitForFunction(() => !document.querySelector('#undo:disabled'));
        await keepScreenshot(page, 'after_drag');
        const epoch = await page.evaluate(() => window.raybundle.scene.epoch);
        // The same server shows the first place the darker one until the shadow has moved.
        const end = await shadowsWhere(page, epoch, ({first, second}) => first > VISIBLE * second);
        t.diagnostic(`shadow: ${start}, afterwards: ${end}`);
        const moved = (await middleOf(page)).x - middle.x;
        assert.ok(Math.abs(moved - DRAG_M) < 0.2, `moved by ${moved.toFixed(2)} m`);
        await keepScreenshot(page, 'after_settling');
    });

    it('shows one viewer what another moves, at phone width', async () => {
        const phone = await openClient(browser, daemon.url, {
            viewport: {width: 360, height: 740},
            deviceScaleFactor: 2,
            hasTouch: true,
            isMobile: true,
            colorScheme: 'light',
        });
        const {page} = phone;
        await frameWith(page, {settled: 0.5});
        await keepScreenshot(page, 'phone');
        const width = await page.evaluate(() => document.documentElement.scrollWidth);
        assert.ok(width <= 360, `the page is ${width} pixels wide`);
        const start = await middleOf(page);
        await desktop.page.click('[data-nudge="1,0"]');
        await page.waitForFunction(([name, x]) => {
            const {objects} = window.raybundle.scene;
            const {min, max} = objects.find((object) => object.name === name).bounds;
            return Math.abs((min.x + max.x) / 2 - x) > 0.05;
        }, /** @type {[string, number]} */ ([SHORT_BOX, start.x]));
        const at = await onPage(page, await middleOf(page));
        await page.touchscreen.tap(at.x, at.y);
        await page.waitForFunction(() => window.raybundle.selected !== null);
        await page.click('#panel-toggle');
        await page.waitForSelector('#panel', {state: 'visible'});
        await page.waitForFunction(() => {
            const {aspect, shownAspect} = window.raybundle.picture;
            return Math.abs(aspect / shownAspect - 1) < 0.05;
        });
        await keepScreenshot(page, 'phone_panel');
        assert.deepEqual(phone.faults, []);
        await phone.context.close();
    });

    it('has caused no error in the page', () => {
        assert.deepEqual(desktop.faults, []);
    });

    it('reconnects by itself after the server has been away', async () => {
        const {page} = desktop;
        assert.equal(await daemon.stop(), 0);
        await page.waitForFunction(() => window.raybundle.client.state === 'reconnecting');
        await page.waitForSelector('#banner', {state: 'visible'});
        const pixels = await thumbnail(page);
        assert.ok(Math.max(...pixels) > 30, 'the last picture is gone');
        await keepScreenshot(page, 'reconnecting');

        const lastFrame = await page.evaluate(() => window.raybundle.frame);
        daemon = await Daemon.start(SCENE, daemon.port);
        await page.waitForFunction(() => window.raybundle.client.state === 'connected');
        await page.waitForFunction(
            (last) => window.raybundle.frame.serverTimeMs !== last.serverTimeMs,
            lastFrame,
        );
        await page.waitForSelector('#banner', {state: 'hidden'});
        assert.equal(await page.textContent('#connection-text'), 'Connected');
    });
});

/**
 * Centre of the short box, by what the page knows.
 *
 * @param {import('playwright-core').Page} page
 */
function middleOf(page) {
    return page.evaluate((name) => {
        const {objects} = window.raybundle.scene;
        const {min, max} = objects.find((object) => object.name === name).bounds;
        return {x: (min.x + max.x) / 2, y: (min.y + max.y) / 2, z: (min.z + max.z) / 2};
    }, SHORT_BOX);
}

/**
 * Waits for a picture in which the two places are as bright as they should be. Half settled is enough: what the picture
 * shows is looked at, not how long it takes until the last per cent is known.
 *
 * @param {import('playwright-core').Page} page
 * @param {number} epoch  of the picture, at least
 * @param {(shadows: {first: number, second: number}) => boolean} fits
 * @returns {Promise<string>} what they are
 */
async function shadowsWhere(page, epoch, fits) {
    await frameWith(page, {epoch, settled: 0.5});
    const until = Date.now() + PATIENCE_MS;
    for (;;) {
        const first = await brightnessAt(page, FIRST_SHADOW);
        const found = {first, second: await brightnessAt(page, SECOND_SHADOW)};
        if (fits(found)) {
            return JSON.stringify(found);
        }
        assert.ok(Date.now() < until, `shadows: ${JSON.stringify(found)}`);
        await page.waitForTimeout(100);
    }
}

/**
 * Drags with the mouse.
 *
 * @param {import('playwright-core').Page} page
 * @param {{x: number, y: number, z: number}} from  metres
 * @param {number} metres  along x
 */
async function dragBy(page, from, metres) {
    // What is grabbed lies on the front of the box, nearer to the eye than its middle.
    const point = {...from, z: from.z - 0.9};
    const start = await onPage(page, point);
    const end = await onPage(page, {...point, x: point.x + metres});
    await page.mouse.move(start.x, start.y);
    await page.mouse.down();
    for (let step = 1; step <= 12; ++step) {
        const part = step / 12;
        const x = start.x + part * (end.x - start.x);
        await page.mouse.move(x, start.y + part * (end.y - start.y));
        await page.waitForTimeout(40);
    }
    await page.mouse.up();
}
