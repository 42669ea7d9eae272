// SPDX-License-Identifier: Apache-2.0
// The page draws by itself while something moves, and gives way to the server's picture at rest.

import assert from 'node:assert/strict';
import {mkdtemp, rm, writeFile} from 'node:fs/promises';
import {tmpdir} from 'node:os';
import path from 'node:path';
import {after, before, describe, it} from 'node:test';

import {inverse, matrixOf, product} from '../../client_web/drawing/object_places.js';
import {blockValues} from '../../client_web/walkthrough/light_blocks.js';
import {PATIENCE_MS, SOFTWARE_GL, keepScreenshot, launchBrowser, openClient} from './browser.mjs';
import {Daemon, ROOT} from './daemon.mjs';

const OPTIONS = {viewport: {width: 900, height: 640}};
/** No two display frames may differ more in their mean luminance. */
const MOST_STEP = 0.03;

describe('places of objects', () => {
    it('are undone by their inverse', () => {
        const m = matrixOf({
            translation: {x: 1, y: -2, z: 3},
            rotation: {x: 0.1, y: 0.7, z: -0.2, w: 0.6},
            scale: {x: 2, y: 0.5, z: -1.5},
        });
        product(m, inverse(m)).forEach((value, i) => {
            assert.ok(Math.abs(value - (i % 5 === 0 ? 1 : 0)) < 1e-12, `${i}: ${value}`);
        });
    });
});

describe('a block of light', () => {
    it('is refused where it has another size', () => {
        assert.throws(() => blockValues(new Uint8Array(7), 2), /block of 7 bytes/);
    });

    it('holds differences, folded to small numbers', () => {
        // Exponent 16 and red 2, then red 1 less and green 3.
        const planes = new Uint8Array([(16 * 2 - 32 + 31) << 3, 0, 4, 1, 0, 6, 0, 0]);
        const [first, second] = blockValues(planes, 2);
        assert.deepEqual([first >>> 27, first & 511], [16, 2]);
        assert.deepEqual([second >>> 27, second & 511, (second >>> 9) & 511], [16, 1, 3]);
    });
});

/** Radiance of panels side by side, cd/m²: from the shadows to beyond white. */
const PANELS = [0.5, 2, 8, 20, 60, 300];

/** A scene of nothing but shining panels, a metre each, along x. */
function panelScene() {
    const corners = new Float32Array([0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0]);
    const indices = new Uint16Array([0, 1, 2, 0, 2, 3]);
    const bytes = Buffer.concat([Buffer.from(corners.buffer), Buffer.from(indices.buffer)]);
    const uri = `data:application/octet-stream;base64,${bytes.toString('base64')}`;
    return {
        asset: {version: '2.0'},
        scene: 0,
        scenes: [{nodes: [...PANELS.keys(), PANELS.length]}],
        nodes: [
            ...PANELS.map((_, i) => ({name: `panel ${i}`, mesh: i, translation: [i, 0, 0]})),
            {camera: 0, translation: [PANELS.length / 2, 0.5, 6]},
        ],
        cameras: [{type: 'perspective', perspective: {yfov: 0.9, znear: 0.1}}],
        meshes: PANELS.map((_, material) => ({primitives: [{attributes: {POSITION: 0}, indices: 1, material}]})),
        materials: PANELS.map((strength) => ({
            pbrMetallicRoughness: {baseColorFactor: [0, 0, 0, 1], metallicFactor: 0, roughnessFactor: 1},
            emissiveFactor: [1, 1, 1],
            extensions: {KHR_materials_emissive_strength: {emissiveStrength: strength}},
        })),
        extensionsUsed: ['KHR_materials_emissive_strength'],
        buffers: [{byteLength: bytes.length, uri}],
        bufferViews: [
            {buffer: 0, byteOffset: 0, byteLength: 48},
            {buffer: 0, byteOffset: 48, byteLength: 12},
        ],
        accessors: [
            {bufferView: 0, componentType: 5126, count: 4, type: 'VEC3', min: [0, 0, 0], max: [1, 1, 0]},
            {bufferView: 1, componentType: 5123, count: 6, type: 'SCALAR'},
        ],
    };
}

describe('a drawing', () => {
    it('has the pixel values of the server, as a photograph and in false colour', async (t) => {
        const folder = await mkdtemp(path.join(tmpdir(), 'drawing-'));
        t.after(() => rm(folder, {recursive: true, force: true}));
        const file = path.join(folder, 'panels.gltf');
        await writeFile(file, JSON.stringify(panelScene()));
        const daemon = await Daemon.start(path.relative(ROOT, file));
        t.after(() => daemon.stop());
        const browser = await launchBrowser(SOFTWARE_GL);
        t.after(() => browser.close());
        const {page} = await openClient(browser, `${daemon.url}#draw=here`, OPTIONS);
        for (const mode of ['PHOTO', 'FALSE_LUMINANCE']) {
            await page.waitForFunction(
                (wanted) => {
                    const {frame} = window.raybundle ?? {};
                    const {drawing, display} = window.raybundleParts ?? {};
                    if (display && display.mode !== wanted && frame) {
                        display.setMode(wanted);
                    }
                    return frame?.codec === 'PNG' && drawing.light?.complete &&
                        (frame.scaleMaximum !== undefined) === (wanted !== 'PHOTO');
                },
                mode, {timeout: PATIENCE_MS, polling: 200});
            const values = await page.evaluate(async (count) => {
                const {readDisplay} = await import('/walkthrough/off_screen.js');
                const {lookOf} = await import('/drawing/drawn_exposure.js');
                const app = window.raybundle;
                const {canvas, context, element} = app.picture;
                const {width, height} = canvas;
                const own = readDisplay(window.raybundleParts.drawing.light.renderer, app.view, lookOf(app.frame), width, height);
                const {data} = context.getImageData(0, 0, width, height);
                return Array.from({length: count}, (_, i) => {
                    const at = app.project({x: i + 0.5, y: 0.5, z: 0});
                    const [x, y] = [Math.floor((at.x / element.clientWidth) * width), Math.floor((at.y / element.clientHeight) * height)];
                    const pixel = (pixels, row) => [...pixels.slice(4 * (row * width + x), 4 * (row * width + x) + 3)];
                    return {own: pixel(own, height - 1 - y), server: pixel(data, y)};
                });
            }, PANELS.length);
            t.diagnostic(`${mode}: ${values.map(({own, server}) => `${own}/${server}`).join(' ')}`);
            for (const {own, server} of values) {
                own.forEach((value, k) => assert.ok(Math.abs(value - server[k]) <= 2, `${mode}: ${own} is not ${server}`));
            }
            assert.ok(new Set(values.map(({server}) => String(server))).size >= 4, 'panels differ');
        }
    });
});

describe('drawing here', () => {
    /** @type {Daemon} */
    let daemon;
    /** @type {import('playwright-core').Browser} */
    let browser;

    before(async () => {
        daemon = await Daemon.start('scenes/cornell_box.gltf');
        browser = await launchBrowser(SOFTWARE_GL);
    });

    after(async () => {
        await browser?.close();
        await daemon?.stop();
    });

    /** A page that draws here, at rest with a picture of the server's that has settled. */
    async function open(choice = 'here') {
        const opened = await openClient(browser, `${daemon.url}#draw=${choice}`, OPTIONS);
        await opened.page.waitForFunction(
            () => {
                const {frame} = window.raybundle ?? {};
                return frame && frame.iterations >= 200 && window.raybundleParts.drawing.light?.complete;
            },
            null, {timeout: PATIENCE_MS, polling: 100});
        return opened;
    }

    /** Starts to note the mean luminance of what is on screen in each display frame, 0..1. */
    const record = (/** @type {import('playwright-core').Page} */ page) => page.evaluate(() => {
        const {drawing} = window.raybundleParts;
        const app = window.raybundle;
        const context = new OffscreenCanvas(64, 48).getContext('2d', {willReadFrequently: true});
        context.imageSmoothingQuality = 'high';
        const light = (code) => (code / 255) ** 2.2;
        window.recorded = [];
        const note = () => {
            context.globalAlpha = 1;
            context.drawImage(app.picture.canvas, 0, 0, 64, 48);
            if (drawing.visible) {
                // Within the frame in which it was drawn, WebGL still has it.
                drawing.redrawNow();
                context.globalAlpha = Number(getComputedStyle(drawing.canvas).opacity);
                context.drawImage(drawing.canvas, 0, 0, 64, 48);
            }
            const {data} = context.getImageData(0, 0, 64, 48);
            let sum = 0;
            for (let i = 0; i < data.length; i += 4) {
                sum += 0.2126 * light(data[i]) + 0.7152 * light(data[i + 1]) + 0.0722 * light(data[i + 2]);
            }
            window.recorded.push({mean: sum / (64 * 48), here: drawing.visible});
            window.recording = requestAnimationFrame(note);
        };
        note();
    });

    const stopRecording = (/** @type {import('playwright-core').Page} */ page) => page.evaluate(() => {
        cancelAnimationFrame(window.recording);
        return window.recorded;
    });

    /** The server's picture is on screen, of the camera as it is. */
    const atRest = (/** @type {import('playwright-core').Page} */ page) => page.waitForFunction(
        () => !window.raybundleParts.drawing.visible && !window.raybundle.camera.moving,
        null, {timeout: PATIENCE_MS, polling: 50});

    it('takes over at once, and gives way without a jump of brightness', async (t) => {
        const {page, faults, context} = await open();
        await page.waitForTimeout(1000);
        await record(page);
        // Turns by so little that what comes into the picture does not count, however few display frames there are.
        await page.evaluate(async () => {
            for (let i = 0; i < 12; ++i) {
                window.raybundle.camera.turn(0.0001, 0);
                await new Promise(requestAnimationFrame);
            }
        });
        await keepScreenshot(page, 'drawing_here');
        await atRest(page);
        await keepScreenshot(page, 'drawing_at_rest');
        const frames = await stopRecording(page);
        assert.ok(frames.some(({here}) => here), 'the page has drawn');
        assert.equal(frames.at(-1).here, false);
        const steps = frames.slice(1).map(({mean}, i) => Math.abs(mean / frames[i].mean - 1));
        const most = Math.max(...steps);
        t.diagnostic(`${frames.length} frames, largest step ${(100 * most).toFixed(2)} %: ` +
            frames.map(({mean, here}) => `${(1000 * mean).toFixed(0)}${here ? 'h' : ''}`).join(' '));
        assert.ok(most < MOST_STEP, `a step of ${most}`);
        assert.deepEqual(faults, []);
        await context.close();
    });

    it('gets no pictures while the camera moves', async (t) => {
        const {page, context} = await open();
        const {pictures, steady} = await page.evaluate(async () => {
            const app = window.raybundle;
            // A camera that stands still for longer rests, and on a slow machine it may between two turns.
            const rest = 100; // ms
            const underWay = 1000; // ms until what was sent before has come
            let [last, since] = [performance.now(), performance.now()];
            let [turns, pictures, steady] = [0, 0, 0];
            app.on('picture', () => {
                const now = performance.now();
                pictures += now - last < rest && now - since > underWay ? 1 : 0;
            });
            for (const end = last + 4000; last < end;) {
                app.camera.turn(++turns % 2 ? 0.01 : -0.01, 0.001);
                await new Promise((resolve) => setTimeout(resolve, 30));
                const now = performance.now();
                since = now - last > rest ? now : since;
                steady += now - since > underWay ? 1 : 0;
                last = now;
            }
            return {pictures, steady};
        });
        t.diagnostic(`${pictures} pictures while it moved without a rest, ${steady} turns`);
        assert.ok(pictures <= 2, `${pictures} pictures`);
        await atRest(page);
        await context.close();
    });

    it('shows an object where it is dragged, and its light afterwards; others see it, too', async (t) => {
        const {page, faults, context} = await open();
        const other = await open();
        const light = () => other.page.evaluate(() => window.raybundleParts.drawing.light.epoch);
        const before = await light();
        await page.evaluate(async () => {
            const app = window.raybundle;
            const box = app.scene.objects.find(({name}) => /short/.test(name));
            const {translation, ...rest} = box.transform;
            await app.moveObject(box.id, {...rest, translation: {...translation, x: translation.x + 0.4}});
        });
        await other.page.waitForFunction((epoch) => window.raybundleParts.drawing.light.epoch > epoch, before,
            {timeout: PATIENCE_MS, polling: 50});
        await atRest(page);
        await atRest(other.page);
        // Who comes late sees the same, drawn there.
        const late = await open();
        const drawn = (/** @type {import('playwright-core').Page} */ p) => p.evaluate(() => {
            const {drawing} = window.raybundleParts;
            window.raybundle.camera.turn(0.0001, 0);  // it takes over from the picture
            drawing.redrawNow();
            const small = new OffscreenCanvas(64, 48).getContext('2d');
            small.drawImage(drawing.canvas, 0, 0, 64, 48);
            return [...small.getImageData(0, 0, 64, 48).data];
        });
        const [one, two] = [await drawn(other.page), await drawn(late.page)];
        // Each is as bright as its own viewer's picture: what is compared beyond that is where light and box are.
        const mean = (/** @type {number[]} */ values) => values.reduce((sum, value, i) => sum + (i % 4 === 3 ? 0 : value), 0);
        const brightness = mean(one) / mean(two);
        const apart = one.reduce((sum, value, i) => sum + (i % 4 === 3 ? 0 : Math.abs(value - brightness * two[i])), 0) /
            (0.75 * one.length);
        t.diagnostic(`${apart.toFixed(2)} of 255 apart at ${brightness.toFixed(3)} times the brightness`);
        assert.ok(Math.abs(brightness - 1) < MOST_STEP, `${brightness} times as bright`);
        assert.ok(apart < 2, `${apart} of 255 apart`);
        assert.deepEqual([...faults, ...other.faults, ...late.faults], []);
        await Promise.all([context, other.context, late.context].map((c) => c.close()));
    });

    it('goes on without the server, and comes back to it', async () => {
        const {page, context} = await open();
        await page.evaluate(() => {
            const {client} = window.raybundle;
            client.settings.url = client.settings.url.replace('/ws', '/nowhere');
            client.connect();
        });
        await page.waitForFunction(() => window.raybundle.client.state === 'reconnecting');
        await page.evaluate(() => window.raybundle.camera.turn(0.3, 0));
        await page.waitForFunction(() => window.raybundleParts.drawing.visible);
        await page.evaluate(() => {
            const {client} = window.raybundle;
            client.settings.url = client.settings.url.replace('/nowhere', '/ws');
            client.connect();
        });
        await atRest(page);
        await context.close();
    });

    it('is left to the server without a GPU, or where the user wants that, and comes back', async () => {
        const {page, context} = await openClient(browser, `${daemon.url}#draw=auto`, OPTIONS);
        await page.waitForFunction(() => window.raybundle?.frame && window.raybundle.client.state === 'connected');
        assert.match(await page.textContent('#drawing-state'), /by the server: this browser has no GPU/);
        assert.equal(await page.evaluate(() => window.raybundleParts.drawing.light), null, 'a context that nobody needs');
        await page.evaluate(() => window.raybundleParts.drawing.choice = 'here');
        await page.waitForFunction(() => window.raybundleParts.drawing.draws && window.raybundle.client.state === 'connected');
        await page.evaluate(() => window.raybundleParts.drawing.choice = 'pictures');
        await page.evaluate(() => window.raybundle.camera.turn(0.1, 0));
        assert.equal(await page.evaluate(() => window.raybundleParts.drawing.visible), false);
        await page.evaluate(() => window.raybundleParts.drawing.choice = 'here');
        await page.waitForFunction(() => window.raybundleParts.drawing.draws && window.raybundle.client.state === 'connected',
            null, {timeout: PATIENCE_MS});
        await page.evaluate(() => window.raybundle.camera.turn(0.1, 0));
        assert.equal(await page.evaluate(() => window.raybundleParts.drawing.visible), true);
        await atRest(page);
        await context.close();
    });
});
