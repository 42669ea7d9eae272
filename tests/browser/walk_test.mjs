// SPDX-License-Identifier: Apache-2.0
// Walking through a running server's scene: what is on screen before the server's next picture is there.

import assert from 'node:assert/strict';
import {after, before, describe, it} from 'node:test';

import {frameWith, keepScreenshot, launchBrowser, openClient} from './browser.mjs';
import {Daemon} from './daemon.mjs';

const SCENE = 'scenes/cornell_box.gltf';
const OPTIONS = {viewport: {width: 1024, height: 700}};

/** What moves the camera, and how much better than the picture that stands still the warped one is at least. */
const MOVES = [
    {name: 'turned', left: 0.09, upwards: -0.03, forwards: 0, rightwards: 0},
    {name: 'walked_aside', left: 0, upwards: 0, forwards: 0, rightwards: 0.7},
    {name: 'walked_on', left: 0, upwards: 0, forwards: 1.2, rightwards: 0},
];

describe('between two pictures of the server', () => {
    /** @type {Daemon} */
    let daemon;
    /** @type {import('playwright-core').Browser} */
    let browser;

    before(async () => {
        browser = await launchBrowser();
        daemon = await Daemon.start(SCENE);
    });

    after(async () => {
        await browser?.close();
        await daemon?.stop();
    });

    it('who has walked through a wall is told so, and the way back', async () => {
        const {page, context} = await openClient(browser, daemon.url, OPTIONS);
        await page.waitForFunction(() => window.raybundle?.frame?.iterations >= 4);
        await page.evaluate(() => {
            const {view} = window.raybundle;
            window.raybundle.view = {...view, eye: {...view.eye, z: 8}, target: {...view.target, z: 20}};
        });
        const notice = '.notice:has-text("nothing to see from here")';
        await page.click(`${notice} button:has-text("Back")`);
        await page.waitForFunction(() => Math.abs(window.raybundle.view.eye.z + 7.5) < 1e-6);
        // Each time anew, and no longer than it is so.
        await page.evaluate(() => {
            const {view} = window.raybundle;
            window.raybundle.view = {...view, eye: {...view.eye, z: 9}, target: {...view.target, z: 20}};
        });
        await page.waitForSelector(notice);
        await page.keyboard.press('Home');
        await page.waitForSelector(notice, {state: 'detached'});
        await context.close();
    });

    it('the last one is drawn by its depths, and agrees with the next', async (t) => {
        const {page, faults, context} = await openDrawing(browser, daemon.url);
        await frameWith(page, {settled: 0.9});
        await page.waitForFunction(() => window.raybundle.frame.depthBytes > 0);
        for (const move of MOVES) {
            const seen = await page.evaluate(moveAndCompare, move);
            const {name, stale, warped, covered, redrawMs, depthBytes} = seen;
            t.diagnostic(
                `${name}: stale ${stale.toFixed(2)}, warped ${warped.toFixed(2)} of 255, ` +
                    `${(100 * covered).toFixed(0)} % covered, ${redrawMs.toFixed(1)} ms a redraw, ` +
                    `${depthBytes} bytes of depths`,
            );
            assert.ok(stale > 2, `${name}: the picture hardly changes, by ${stale.toFixed(2)}`);
            assert.ok(warped < 0.4 * stale, `${name}: ${warped.toFixed(2)}, stale ${stale.toFixed(2)}`);
            assert.ok(covered > 0.75, `${name}: only ${(100 * covered).toFixed(0)} % is covered`);
            assert.ok(depthBytes < 20000, `${depthBytes} bytes of depths`);
        }
        assert.deepEqual(faults, []);
        await context.close();
    });

    it('it is shown in its place, and the true picture again as soon as it is there', async () => {
        const {page, context} = await openDrawing(browser, daemon.url);
        await frameWith(page, {settled: 0.5});
        await page.waitForFunction(() => window.raybundle.frame.depthBytes > 0);
        await page.waitForFunction(() => window.raybundle.link.shown !== null);
        assert.equal(await page.evaluate(() => window.raybundle.picture.warped), null);
        await page.evaluate(() => {
            window.raybundle.client.paused = true;
            window.raybundle.camera.turn(0.05, 0.02);
        });
        await page.waitForSelector('canvas.warped', {state: 'visible'});
        assert.equal(await page.evaluate(() => window.raybundle.picture.canvas.style.visibility), 'hidden');
        await keepScreenshot(page, 'warped');
        await page.evaluate(() => (window.raybundle.client.paused = false));
        await page.waitForSelector('canvas.warped', {state: 'hidden'});
        assert.equal(await page.evaluate(() => window.raybundle.picture.canvas.style.visibility), '');
        await context.close();
    });

    it('pictures are flat ones where drawing by depths takes too long', async () => {
        const {page, context} = await openDrawing(browser, daemon.url);
        await page.waitForFunction(() => window.raybundle?.link.shown && window.raybundle.frame.depthBytes > 0);
        await page.evaluate(async () => {
            const {picture, camera, client} = window.raybundle;
            client.paused = true;
            picture.slowestRedrawMs = 0;
            while (picture.redrawMs.count < 3) {
                camera.turn(0.0005, 0);
                picture.redraw();
                await new Promise((resolve) => requestAnimationFrame(resolve));
            }
            camera.turn(0.02, 0);
        });
        await page.waitForSelector('canvas.warped', {state: 'hidden'});
        assert.notEqual(await page.evaluate(() => window.raybundle.picture.canvas.style.transform), '');
        await page.evaluate(() => (window.raybundle.client.paused = false));
        await page.waitForFunction(() => window.raybundle.frame.depthBytes === undefined);
        await context.close();
    });

    it('a browser whose WebGL no GPU draws, as this one, asks for no depths and gets none', async () => {
        const {page, context} = await openClient(browser, daemon.url, OPTIONS);
        await frameWith(page, {settled: 0.5});
        await page.waitForFunction(() => window.raybundle.link.shown !== null);
        assert.equal(await page.evaluate(() => window.raybundle.frame.depthBytes), undefined);
        await page.evaluate(() => {
            window.raybundle.client.paused = true;
            window.raybundle.camera.turn(0.05, 0.02);
        });
        await page.waitForFunction(() => window.raybundle.picture.canvas.style.transform !== '');
        await context.close();
    });
});

/**
 * Opens a page that takes this machine's processor for a GPU, and however slow it is.
 *
 * @param {import('playwright-core').Browser} browser
 * @param {string} url
 */
async function openDrawing(browser, url) {
    const opened = await openClient(browser, 'about:blank', OPTIONS);
    await opened.page.addInitScript(() => {
        const original = HTMLCanvasElement.prototype.getContext;
        HTMLCanvasElement.prototype.getContext = function (kind, options) {
            return original.call(this, kind, {...options, failIfMajorPerformanceCaveat: false});
        };
        WebGL2RenderingContext.prototype.getExtension = () => null;
    });
    await opened.page.goto(url);
    await opened.page.waitForFunction(() => window.raybundle);
    await opened.page.evaluate(() => {
        window.raybundle.picture.slowestRedrawMs = Infinity;
    });
    return opened;
}

/**
 * In the page: moves the camera, draws what would be on screen, waits for the true picture, and compares
 * where the warped one covers anything.
 *
 * @param {typeof MOVES[number]} move
 */
async function moveAndCompare({name, left, upwards, forwards, rightwards}) {
    const app = window.raybundle;
    const {picture, link, client} = app;
    const {look, walk} = await import('./camera/camera.js');
    const small = (canvas) => {
        const context = new OffscreenCanvas(160, 110).getContext('2d');
        context.drawImage(canvas, 0, 0, 160, 110);
        return context.getImageData(0, 0, 160, 110).data;
    };
    const rest = async () => {
        const same = () => link.shown && JSON.stringify(link.shown) === JSON.stringify(app.view);
        while (!same() || app.frame.settled < 0.9 || app.frame.codec !== 'PNG') {
            await new Promise((resolve) => setTimeout(resolve, 100));
        }
    };
    await rest();
    client.paused = true;
    const before = app.view;
    const stale = small(picture.canvas);
    const {depthBytes} = app.frame;
    app.view = look(walk(before, forwards, rightwards, 0), left, upwards);
    picture.redraw();
    const warped = small(picture.warped);
    const gl = picture.warped.getContext('webgl2');
    const start = performance.now();
    const redraws = 20;
    for (let i = 0; i < redraws; ++i) {
        picture.redraw();
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    }
    const redrawMs = (performance.now() - start) / redraws;
    client.paused = false;
    await rest();
    const truth = small(picture.canvas);
    const sums = {stale: 0, warped: 0, covered: 0};
    for (let i = 0; i < truth.length; i += 4) {
        if (warped[i + 3] < 255) {
            continue;
        }
        ++sums.covered;
        for (let channel = 0; channel < 3; ++channel) {
            sums.stale += Math.abs(stale[i + channel] - truth[i + channel]) / 3;
            sums.warped += Math.abs(warped[i + channel] - truth[i + channel]) / 3;
        }
    }
    app.view = before;
    return {
        name,
        stale: sums.stale / sums.covered,
        warped: sums.warped / sums.covered,
        covered: (4 * sums.covered) / truth.length,
        redrawMs,
        depthBytes,
    };
}

describe('a plan', () => {
    it('hatches what it cuts through, whatever light there is', async (t) => {
        const browser = await launchBrowser();
        t.after(() => browser.close());
        const daemon = await Daemon.start('tests/cases/places/pin_point.gltf');
        t.after(() => daemon.stop());
        const {page, faults} = await openClient(browser, daemon.url, OPTIONS);
        await page.waitForFunction(() => window.raybundle?.frame);
        await page.evaluate(async () => {
            const {client, scene} = window.raybundle;
            const board = scene.objects.find(({movable}) => movable);
            const {scale} = board.transform;
            // 0.1 m thick: the plan's cut, 1.2 m above the floor, is in its middle.
            await client.request({moveObject: {object: board.id, transform: {translation: {x: 2.2, y: 1.15, z: 2.2}, scale}}}).answer;
        });
        await page.click('#plans-details summary');
        await page.click('#plans button');
        // Grey of both tones, 0.42 and 0.62, in turn, eight pixels on the same again.
        await page.waitForFunction(() => {
            const canvas = document.getElementById('canvas');
            const {width, height} = canvas;
            const {data} = canvas.getContext('2d').getImageData(0, 0, width, height);
            const isTone = (/** @type {number} */ pixel, /** @type {number} */ tone) =>
                [0, 1, 2].every((k) => Math.abs(data[4 * pixel + k] - tone) < 25);
            let stripes = 0;
            for (let i = 0; i + 8 < width * height; ++i) {
                stripes += isTone(i, 158) && isTone(i + 4, 107) && isTone(i + 8, 158) ? 1 : 0;
            }
            return stripes > 500;
        });
        await keepScreenshot(page, 'plan_cut');
        assert.deepEqual(faults, []);
    });
});
