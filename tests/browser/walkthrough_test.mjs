// SPDX-License-Identifier: Apache-2.0
// What `raybundle export` writes: the page that draws a solved scene by itself, from static files.

import assert from 'node:assert/strict';
import {spawnSync} from 'node:child_process';
import {cp, mkdtemp, readFile, readdir, rm, writeFile} from 'node:fs/promises';
import {tmpdir} from 'node:os';
import path from 'node:path';
import {after, before, describe, it} from 'node:test';

import {onScale, scaleColour, turboColour} from '../../client_web/measure/colour.js';
import {distanceOf, exposureOf} from '../../client_web/walkthrough/off_screen.js';
import {depthRange, projectionOf} from '../../client_web/walkthrough/projection.js';
import {problemOf} from '../../client_web/walkthrough/scene_data.js';
import {PATIENCE_MS, SOFTWARE_GL, heavy, keepScreenshot, launchBrowser, openClient} from './browser.mjs';
import {ROOT} from './daemon.mjs';
import {readExr} from './exr.mjs';
import {serveFolder} from './static_server.mjs';

const EXECUTABLE = process.env.RAYBUNDLE ?? path.join(ROOT, 'build/raybundle');
const SCENES = ['cornell_box', 'living_room'];
const SOLVE = ['--iterations', '16', '--seed', '5', '--patch-size', '0.3'];
const SIZE = {width: 160, height: 120};
const OPTIONS = {viewport: {width: 900, height: 700}};

/** @param {string[]} args */
function raybundle(args) {
    return spawnSync(EXECUTABLE, args, {encoding: 'utf8', timeout: PATIENCE_MS});
}

/** @param {ArrayLike<number>} p @param {number} i */
const luminance = (p, i) => 0.2126 * p[i] + 0.7152 * p[i + 1] + 0.0722 * p[i + 2];

/**
 * Pixels whose neighbours are about as bright: away from edges.
 *
 * @param {{width: number, height: number, rgb: Float32Array}} picture
 * @returns {[number, number][]}
 */
function evenPixels({width, height, rgb}) {
    /** @type {[number, number][]} */
    const even = [];
    for (let y = 1; y < height - 1; ++y) {
        for (let x = 1; x < width - 1; ++x) {
            const around = [-1, 0, 1].flatMap((j) =>
                [-1, 0, 1].map((i) => luminance(rgb, 3 * ((y + j) * width + x + i))));
            if (Math.max(...around) <= 1.15 * Math.min(...around) + 1e-6) {
                even.push([x, y]);
            }
        }
    }
    return even;
}

/**
 * As the server displays it: Reinhard's shoulder, and sRGB by square roots (I. Chilliant 2012).
 *
 * @param {number} radiance  cd/m²
 * @param {number} exposure  EV
 */
function displayed(radiance, exposure) {
    const x = radiance * 0.18 * 2 ** exposure;
    const y = Math.min((x * (1 + x / 36)) / (1 + x), 1);
    const encoded = 0.662002687 * y ** 0.5 + 0.68412206 * y ** 0.25 - 0.323583601 * y ** 0.125 - 0.0225411470 * y;
    return 255 * Math.max(encoded, 0);
}

describe('a walkthrough', () => {
    /** @type {import('playwright-core').Browser} */
    let browser;
    /** @type {string} */
    let folder;
    /** @type {Awaited<ReturnType<typeof serveFolder>>[]} */
    const servers = [];

    /** @param {string} name */
    async function open(name, options = OPTIONS) {
        const server = await serveFolder(path.join(folder, name));
        servers.push(server);
        const opened = await openClient(browser, server.url, options);
        await opened.page.waitForFunction(() => window.raybundleWalkthrough?.picture.frames > 0 ||
            !/^(Loading.*)?$/.test(document.getElementById('state').textContent.trim()), null, {polling: 100});
        return {...opened, server};
    }

    before(async () => {
        folder = await mkdtemp(path.join(tmpdir(), 'walkthrough-'));
        for (const scene of SCENES) {
            const file = path.join(ROOT, `scenes/${scene}.gltf`);
            const {status, stderr} = raybundle(['export', file, '-o', path.join(folder, scene), ...SOLVE]);
            assert.equal(status, 0, stderr);
        }
        browser = await launchBrowser(SOFTWARE_GL);
    });

    after(async () => {
        await browser?.close();
        await Promise.all(servers.map((server) => server.stop()));
        await rm(folder, {recursive: true, force: true});
    });

    it('goes into no folder that has files in it, and leaves nothing half written', async () => {
        const taken = raybundle(['export', path.join(ROOT, 'scenes/cornell_box.gltf'), '-o', path.join(folder, 'cornell_box')]);
        assert.equal(taken.status, 1);
        assert.match(taken.stderr, /cornell_box: cannot be written: the folder is not empty/);
        const lost = raybundle(['export', path.join(ROOT, 'scenes/absent.gltf'), '-o', path.join(folder, 'absent')]);
        assert.equal(lost.status, 3);
        assert.deepEqual((await readdir(folder)).sort(), SCENES);
    });

    for (const scene of SCENES) {
        (scene === SCENES[0] ? it : heavy)(`shows the light of the patches, as the server does: ${scene}`, async (t) => {
            const exr = path.join(folder, '..', `${path.basename(folder)}-${scene}.exr`);
            t.after(() => rm(exr, {force: true}));
            const {status, stderr} = raybundle(['render', path.join(ROOT, `scenes/${scene}.gltf`), '-o', exr, '--patches',
                '--size', `${SIZE.width}x${SIZE.height}`, ...SOLVE]);
            assert.equal(status, 0, stderr);
            const server = await readExr(exr);
            const {page, faults, context} = await open(scene);
            const shown = await page.evaluate(({width, height}) => {
                const {manifest, camera, readRadiance} = window.raybundleWalkthrough;
                const [first] = manifest.cameras;
                const vector = ([x, y, z]) => ({x, y, z});
                camera.set({eye: vector(first.eye), target: vector(first.target), up: vector(first.up), verticalFov: first.verticalFov});
                return [...readRadiance(width, height)];
            }, SIZE);
            const even = evenPixels(server);
            assert.ok(even.length > 0.1 * SIZE.width * SIZE.height, `${even.length} pixels away from edges`);
            let [error, light] = [0, 0];
            for (const [x, y] of even) {
                const own = luminance(server.rgb, 3 * (y * SIZE.width + x));
                error += (own - luminance(shown, 4 * ((SIZE.height - 1 - y) * SIZE.width + x))) ** 2;
                light += own ** 2;
            }
            const relative = Math.sqrt(error / light);
            t.diagnostic(`relRMSE ${(100 * relative).toFixed(2)} % over ${even.length} pixels`);
            assert.ok(relative < 0.03, `relRMSE ${relative}`);
            await keepScreenshot(page, `walkthrough_${scene}`);
            assert.deepEqual(faults, []);
            await context.close();
        });
    }

    it('has the tone curve and the false colour of the server', async () => {
        const {page, context} = await open('cornell_box');
        const looks = [
            {mode: 'photo', compensation: 0}, {mode: 'photo', compensation: 6}, {mode: 'photo', compensation: -5},
            {mode: 'luminance', compensation: 0},
        ];
        for (const look of looks) {
            const {radiance, display, exposure} = await page.evaluate(({mode, compensation}) => {
                const {picture, readRadiance, readDisplay} = window.raybundleWalkthrough;
                Object.assign(picture, {mode, compensation});
                picture.maximum.luminance = 30;
                return {radiance: [...readRadiance(96, 72)], display: [...readDisplay(96, 72)], exposure: picture.look.exposure};
            }, look);
            let most = 0;
            for (let i = 0; i < radiance.length; i += 4) {
                const value = luminance(radiance, i);
                const wanted = look.mode === 'photo'
                    ? [0, 1, 2].map((c) => displayed(radiance[i + c], exposure))
                    : value > 30 ? [255, 255, 255] : value < 0.03 ? [0, 0, 0] : turboColour(onScale(value, 30));
                wanted.forEach((colour, c) => {
                    most = Math.max(most, Math.abs(display[i + c] - colour));
                });
            }
            assert.ok(most <= 2, `${look.mode} at ${look.compensation} EV: ${most} of 255`);
        }
        assert.equal(scaleColour(31, 30, false), '#fff');
        await context.close();
    });

    heavy('is walked through by the keys of the live page, as fine as the display', async () => {
        const {page, faults, context} = await open('living_room', {viewport: {width: 360, height: 320}, deviceScaleFactor: 1.5, colorScheme: 'dark'});
        const eye = () => page.evaluate(() => window.raybundleWalkthrough.camera.view.eye);
        const start = await eye();
        await page.focus('#picture');
        await page.keyboard.down('KeyW');
        await page.waitForFunction((z) => Math.abs(window.raybundleWalkthrough.camera.view.eye.z - z) > 0.05 ||
            Math.abs(window.raybundleWalkthrough.camera.view.eye.x) > 100, start.z);
        await page.keyboard.up('KeyW');
        await page.keyboard.press('KeyM');
        assert.equal(await page.getAttribute('[data-mode=walk]', 'aria-pressed'), 'true');
        const before = await page.evaluate(() => window.raybundleWalkthrough.camera.view.target);
        await page.mouse.move(100, 140);
        await page.mouse.down();
        await page.mouse.move(200, 160, {steps: 4});
        await page.mouse.up();
        await page.waitForFunction(({x}) => window.raybundleWalkthrough.camera.view.target.x !== x, before);
        await page.selectOption('#cameras', {index: 1});
        await page.waitForFunction(() => !window.raybundleWalkthrough.camera.moving);
        const second = await page.evaluate(() => window.raybundleWalkthrough.manifest.cameras[1].eye[0]);
        assert.ok(Math.abs((await eye()).x - second) < 1e-4);
        await page.focus('#picture');
        await page.keyboard.press('KeyV');
        await page.keyboard.press('KeyV');
        assert.equal(await page.inputValue('#display'), 'illuminance');
        await page.click('#scale-less');
        assert.match(await page.textContent('#scale-high'), /330 lx/);
        const fits = () => page.evaluate(() => {
            const {canvas} = window.raybundleWalkthrough.picture;
            return canvas.width === Math.round(1.5 * canvas.clientWidth) && document.documentElement.scrollWidth <= innerWidth;
        });
        assert.ok(await fits());
        await page.waitForFunction(() => !window.raybundleWalkthrough.camera.moving);
        await keepScreenshot(page, 'walkthrough_narrow_dark');
        assert.deepEqual(faults, []);
        await context.close();
    });

    it('goes where a double click points, and stands on the floor', async () => {
        const {page, faults, context} = await open('cornell_box');
        const view = () => page.evaluate(() => window.raybundleWalkthrough.camera.view);
        const still = () => page.waitForFunction(() => !window.raybundleWalkthrough.camera.moving);
        await page.focus('#picture');
        await page.keyboard.press('KeyM');
        // Within the box, above its floor, looking down at it.
        await page.evaluate(() => window.raybundleWalkthrough.camera.set({
            eye: {x: 4.6, y: 3, z: 0.3}, target: {x: 4.6, y: 1.6, z: 0.7}, up: {x: 0, y: 1, z: 0}, verticalFov: 0.9,
        }));
        const box = await page.locator('#picture').boundingBox();
        await page.mouse.dblclick(box.x + box.width / 2, box.y + box.height / 2);
        await page.waitForFunction(() => Math.abs(window.raybundleWalkthrough.camera.view.eye.y - 1.6) < 0.01);
        await still();
        const there = await view();
        assert.ok(Math.abs(there.eye.x - 4.6) < 0.01 && there.eye.z < 2, JSON.stringify(there.eye));
        await page.evaluate(() => {
            const {camera} = window.raybundleWalkthrough;
            camera.set({...camera.view, eye: {x: 0.5, y: 4, z: 0.5}, target: {x: 3, y: 4, z: 3}});
        });
        await page.keyboard.press('KeyH');
        await page.waitForFunction(() => Math.abs(window.raybundleWalkthrough.camera.view.eye.y - 1.6) < 0.001);
        assert.deepEqual(faults, []);
        await context.close();
    });

    it('says in plain words why it cannot be drawn', async () => {
        const server = await serveFolder(path.join(folder, 'cornell_box'));
        servers.push(server);
        const context = await browser.newContext(OPTIONS);
        const page = await context.newPage();
        await page.addInitScript(() => {
            HTMLCanvasElement.prototype.getContext = () => null;
        });
        await page.goto(server.url);
        await page.waitForFunction(() => document.getElementById('state').textContent.includes('WebGL 2 is absent'));
        await keepScreenshot(page, 'walkthrough_without_webgl');
        await context.close();

        const broken = path.join(folder, 'broken');
        await cp(path.join(folder, 'cornell_box'), broken, {recursive: true});
        const light = await readFile(path.join(broken, 'light.bin'));
        await writeFile(path.join(broken, 'light.bin'), light.subarray(0, 100));
        const other = await serveFolder(broken);
        servers.push(other);
        const late = await (await browser.newContext(OPTIONS)).newPage();
        const failed = () => late.waitForFunction(
            () => document.getElementById('state').textContent === 'light.bin is shorter than scene.json says.', null, {polling: 50});
        // What arrives after the failure says nothing more.
        const arrived = new Promise((resolve) => {
            void late.route('**/geometry.bin', async (route) => {
                await failed();
                resolve(await route.continue().catch(() => {}));
            });
        });
        await late.goto(other.url);
        await arrived;
        await late.waitForTimeout(200);
        await failed();
        await late.context().close();
    });
});

describe('what a walkthrough reads', () => {
    const chunk = {
        material: 0, vertexCount: 3, indexCount: 3, emission: [0, 0, 0], vertices: 0, indices: 36, uvs: null, colours: null,
        front: 0, back: null, emissions: null,
    };
    const manifest = () => ({
        format: 'raybundle-walkthrough', version: 1, geometry: {file: 'g', bytes: 44}, light: {file: 'l', bytes: 12, unit: 1},
        materials: [{texture: null, albedo: null}], textures: [], sky: {texels: null, width: 1, height: 1}, chunks: [{...chunk}],
    });

    it('is checked before it is used', () => {
        assert.equal(problemOf(manifest()), '');
        for (const [name, value] of [['vertices', 12], ['indices', 40], ['front', 4], ['back', 2], ['material', 1], ['vertexCount', 65536], ['uvs', -4]]) {
            const bad = manifest();
            bad.chunks[0][name] = value;
            assert.match(problemOf(bad), /chunks\[0\]/, name);
        }
        assert.match(problemOf({...manifest(), version: 2}), /version 2/);
        assert.match(problemOf(null), /no walkthrough/);
        assert.match(problemOf({...manifest(), sky: {texels: 0, width: 4, height: 4}}), /sky/);
    });

    it('is exposed for the mean of the logarithms', () => {
        const pixel = (/** @type {number} */ stops, /** @type {number} */ counts) => {
            const bits = Math.round((stops / 64 + 0.5) * 65535);
            return [bits >> 8, bits & 255, counts, 255];
        };
        const found = exposureOf(new Uint8Array([...pixel(3, 255), ...pixel(5, 255), ...pixel(20, 0)]));
        assert.ok(Math.abs(found + 4) < 0.01);
        assert.equal(exposureOf(new Uint8Array(pixel(20, 0))), null);
    });

    it('has distances to a hundred-thousandth', () => {
        for (const metres of [0.01, 1, 12.3456, 1e5]) {
            const code = Math.floor((Math.log2(metres) / 64 + 0.5) * 16777215);
            const found = distanceOf(new Uint8Array([code >> 16, (code >> 8) & 255, code & 255, 255]));
            assert.ok(Math.abs(found / metres - 1) < 1e-5);
        }
        assert.equal(distanceOf(new Uint8Array([1, 2, 3, 0])), null);
    });

    it('is projected as the camera has it', () => {
        const view = {eye: {x: 1, y: 2, z: 3}, target: {x: 1, y: 2, z: -7}, up: {x: 0, y: 1, z: 0}, verticalFov: Math.PI / 2};
        const bounds = {min: {x: -10, y: -10, z: -10}, max: {x: 10, y: 10, z: 10}};
        const {clipFromWorld: m} = projectionOf(view, 2, bounds);
        const at = (/** @type {number[]} */ p) =>
            [0, 1, 2, 3].map((row) => p.reduce((sum, value, column) => sum + m[4 * column + row] * value, m[12 + row]));
        const [x, y, z, w] = at([5, 4, -1]);  // 4 m ahead, 4 to the right, 2 up
        assert.ok(Math.abs(x / w - 0.5) < 1e-6 && Math.abs(y / w - 0.5) < 1e-6);
        assert.ok(Math.abs(w - 4) < 1e-6 && Math.abs(z / w) < 1);
        const {near, far} = depthRange(view.eye, bounds);
        assert.ok(near <= 0.01 && far > Math.hypot(11, 12, 13));
    });
});
