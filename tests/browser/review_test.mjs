// SPDX-License-Identifier: Apache-2.0
// Measuring, placing and reviewing with a real server, one, two and three pages at once. The tests
// build on one another and run in order.

import assert from 'node:assert/strict';
import {readFile} from 'node:fs/promises';
import {after, before, describe, it} from 'node:test';

import {
    difference,
    frameWith,
    heavy,
    keepScreenshot,
    launchBrowser,
    onPage,
    openClient,
    thumbnail,
} from './browser.mjs';
import {Daemon} from './daemon.mjs';

const SCENE = 'scenes/cornell_box.gltf';
/** Floor beside the boxes, metres. */
const FLOOR = {x: 4.6, y: 0, z: 2.4};
const SMALL = {viewport: {width: 900, height: 640}};

describe('a review', () => {
    /** @type {Daemon} */
    let daemon;
    /** @type {import('playwright-core').Browser} */
    let browser;
    /** @type {Awaited<ReturnType<typeof openClient>>} */
    let ann;
    /** @type {Awaited<ReturnType<typeof openClient>>} */
    let ben;

    before(async () => {
        browser = await launchBrowser();
        daemon = await Daemon.start(SCENE);
        const options = {viewport: {width: 1000, height: 700}, colorScheme: 'dark'};
        ann = await openClient(browser, `${daemon.url}#name=Ann`, options);
        await frameWith(ann.page, {settled: 0.5});
    });

    after(async () => {
        await browser?.close();
        await daemon?.stop();
    });

    /** Has the server make the picture so accurate. */
    const asksFor = (page, relativeError) =>
        page.evaluate((error) => window.raybundle.client.request({setTarget: {relativeError: error}}).answer.then(() => {}), relativeError);

    /** Clicks a point of the scene. */
    const clickAt = async (page, point) => {
        const {x, y} = await onPage(page, point);
        await page.mouse.click(x, y);
    };

    /** Text of the file that a button saves. */
    const saved = async (page, selector) => {
        const [download] = await Promise.all([page.waitForEvent('download'), page.click(selector)]);
        return {name: download.suggestedFilename(), bytes: await readFile(await download.path())};
    };

    it('measures illuminance and luminance with their error where one clicks', async () => {
        const {page} = ann;
        await page.keyboard.press('Digit2');
        await clickAt(page, FLOOR);
        await page.waitForSelector('#points tbody tr');
        const [, lux, , error] = await page.$$eval('#points tbody td', (cells) =>
            cells.map(({textContent}) => textContent),
        );
        assert.match(lux, /^(≈ )?\d[\d\u202f.]* lx$/);
        assert.match(error, /^(not yet known|still uncertain|± [\d.]+ %)$/);  // early it is hardly known
        // Floor: Lambert, so luminance is illuminance * albedo / pi.
        const {illuminance, luminance, relativeError} = await page.evaluate(
            () => window.raybundleParts.measuring.points[0].probe,
        );
        assert.notEqual(relativeError, 0, 'the error of a single sample');
        const share = (luminance / illuminance) * Math.PI;
        assert.ok(share > 0.6 && share < 0.85, `albedo ${share}`);
        const at = await onPage(page, FLOOR);
        const mark = await page.locator('.probe').boundingBox();
        assert.ok(Math.abs(mark.x - 9 - at.x) < 4 && Math.abs(mark.y + 11 - at.y) < 4);
        await page.selectOption('#unit', 'fc');
        assert.match(await page.textContent('#points tbody td:nth-child(2)'), / fc$/);
        await page.selectOption('#unit', 'lx');
    });

    it('measures a grid on the floor and saves it as a table', async () => {
        const {page} = ann;
        await page.selectOption('#grid-step', '0.5');
        await page.click('#measure-grid');
        await page.waitForSelector('#grid-result', {state: 'visible'});
        assert.match(await page.textContent('#grid-state'), /^\w[\w ]*, upper side: 11 × 11 points/);
        const value = (name) => page.textContent(`[data-value="${name}"]`);
        const lux = async (name) => parseFloat((await value(name)).replace('≈ ', '').replace('\u202f', ''));
        const [min, mean, max] = [await lux('gridMin'), await lux('gridMean'), await lux('gridMax')];
        assert.ok(min <= mean && mean <= max, `${min}, ${mean}, ${max}`);  // of one digit while errors are unknown
        const uniformity = await page.evaluate(() => {
            const seen = window.raybundleParts.gridPanel.shown.result.illuminance.filter((lux) => lux >= 0);
            return (Math.min(...seen) * seen.length) / seen.reduce((sum, lux) => sum + lux, 0);
        });
        assert.ok([uniformity.toFixed(2), 'not yet known'].includes(await value('gridUniformity')));
        const {name, bytes} = await saved(page, '#grid-csv');
        assert.match(name, /\.csv$/);
        const rows = String(bytes).trim().split('\r\n').slice(1);
        assert.equal(rows.length, 121);
        const measured = rows.filter((row) => row.split(',')[5] !== '').length;
        assert.ok(measured > 30 && measured < 121, `${measured} points`);
        await keepScreenshot(page, 'grid');
    });

    it('lays a grid on the top of what is selected', async () => {
        const {page} = ann;
        await page.evaluate(() => {
            const {scene} = window.raybundle;
            window.raybundle.select(scene.objects.find(({name}) => name === 'short box').id);
        });
        await page.selectOption('#grid-step', '0.25');
        await page.click('#measure-grid');
        await page.waitForFunction(() =>
            document.getElementById('grid-state').textContent.startsWith('short box, upper side'),
        );
        const {heights, top, measured} = await page.evaluate(() => {
            const {grid, result} = window.raybundleParts.gridPanel.shown;
            return {
                heights: [grid.origin.y, grid.origin.y + grid.stepX.y],
                top: window.raybundle.selected.bounds.max.y,
                measured: result.illuminance.filter((lux) => lux > 0).length,
            };
        });
        heights.forEach((y) => assert.ok(Math.abs(y - top) < 0.01, `${y}, not ${top}`));
        assert.ok(measured >= 10, `${measured} points`);
        const dots = await page.$$eval('.grid-points .measured', (all) => all.filter((dot) => dot.checkVisibility()).length);
        assert.equal(dots, measured);
        await keepScreenshot(page, 'grid_on_box');
    });

    it('takes the grid along with what it lies on, and measures it anew', async () => {
        const {page} = ann;
        const x = () => page.evaluate(() => window.raybundleParts.gridPanel.shown.grid.origin.x);
        const before = await x();
        const measured = () => page.evaluate(() => String(window.raybundleParts.gridPanel.shown.result.illuminance));
        const values = await measured();
        const shift = (by) =>
            page.evaluate((metres) => {
                const {client, selected} = window.raybundle;
                const {translation: t} = selected.transform;
                const transform = {...selected.transform, translation: {...t, x: t.x + metres}};
                const moveObject = {object: selected.id, transform, final: true};
                return client.request({moveObject}).answer.then(() => {});
            }, by);
        await shift(-0.4);
        assert.ok(Math.abs((await x()) - before + 0.4) < 1e-6, 'its dots stay where the box was');
        await page.waitForFunction(() => {
            const {shown} = window.raybundleParts.gridPanel;
            return !shown.outdated && shown.result.epoch === window.raybundle.scene.epoch;
        });
        assert.notEqual(await measured(), values);
        await keepScreenshot(page, 'grid_on_moved_box');
        await shift(0.4);
        await page.click('#clear-grid');
        await page.evaluate(() => window.raybundle.select(null));
    });

    it('shows illuminance by colour, with a legend that fits', async () => {
        const {page} = ann;
        const photo = await thumbnail(page);
        await page.selectOption('#display-mode', 'FALSE_ILLUMINANCE');
        await page.check('#isolines');
        await page.selectOption('#scale-maximum', '2000');
        await page.waitForFunction(() => window.raybundle.frame.scaleMaximum === 2000);
        assert.match(await page.textContent('#legend-title'), /^Illuminance, lx$/);
        assert.equal(await page.evaluate(() => window.raybundle.frame.scaleIlluminance), true, 'says the server');
        const ticks = await page.$$eval('#legend-ticks li', (all) => all.map((t) => t.textContent));
        assert.deepEqual([ticks[0], ticks.at(-1)], ['2\u202f000', '2']);
        assert.ok(difference(photo, await thumbnail(page)) > 20);
        await keepScreenshot(page, 'false_colour');
        const {bytes} = await saved(page, '#save-picture');
        const {wider, ends, wanted} = await page.evaluate(async (base64) => {
            const file = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
            const image = await createImageBitmap(new Blob([file], {type: 'image/png'}));
            const {width, height} = window.raybundle.picture.canvas;
            const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
            context.drawImage(image, 0, 0);
            const {turbo} = await import(new URL('measure/colour.js', location.href).href);
            const rows = Array.from({length: image.height - height}, (_, row) => {
                const {data} = context.getImageData(0, height + row, width, 1);
                return Array.from({length: width}, (__, x) => [...data.slice(4 * x, 4 * x + 3)]);
            });
            const printed = (pixel) => Math.min(...pixel) < 250;
            const bar = rows.map((row) => row.filter(printed)).find((row) => row.length > width / 2) ?? [];
            return {
                wider: image.width - width,
                ends: [bar[0], bar.at(-1)],
                wanted: [turbo(0), turbo(1)].map((colour) => colour.match(/\d+/g).map(Number)),
            };
        }, bytes.toString('base64'));
        assert.equal(wider, 0);
        ends.forEach((pixel, i) => {
            const off = Math.max(...wanted[i].map((value, channel) => Math.abs(value - pixel?.[channel])));
            assert.ok(off <= 6, `the legend ends with ${pixel}, not ${wanted[i]}`);
        });
        await page.selectOption('#display-mode', 'PHOTO');
        await page.waitForFunction(() => window.raybundle.frame.scaleMaximum === undefined);
        assert.ok(await page.isHidden('#legend'));
    });

    it('is brighter with more exposure, and saved as PNG', async () => {
        const {page} = ann;
        const mean = async () => {
            const pixels = await thumbnail(page);
            return pixels.reduce((sum, value) => sum + value, 0) / pixels.length;
        };
        const first = await mean();
        const {exposure} = await page.evaluate(() => window.raybundle.frame);
        await page.locator('#exposure').fill('1.5');
        await page.waitForFunction((ev) => window.raybundle.frame.exposure > ev + 1, exposure);
        assert.ok((await mean()) > first + 15);
        const {name, bytes} = await saved(page, '#save-picture');
        assert.equal(name, 'Cornell_box.png');
        assert.deepEqual([...bytes.subarray(1, 4)], [...Buffer.from('PNG')]);
        await page.locator('#exposure').fill('0');
    });

    it('goes where one double-clicks', async () => {
        const {page} = ann;
        await page.focus('#picture');
        await page.keyboard.press('Digit1');
        const {x, y} = await onPage(page, {x: 2.75, y: 3.5, z: 5.5});
        await page.mouse.dblclick(x, y);
        await page.waitForFunction(() => window.raybundle.view.target.z > 5.4);
        await page.keyboard.press('Home');
        await page.waitForFunction(() => Math.abs(window.raybundle.view.eye.z + 7.5) < 1e-6);
    });

    it('turns what is selected by its ring, and takes that back', async () => {
        const {page} = ann;
        await page.click('#tab-scene');
        await page.click('#objects li:first-child button');
        await page.click('[data-gizmo="turn"]');
        await page.check('#snap');
        const turn = () => page.inputValue('[data-place="turn"]');
        const x = () => page.inputValue('[data-place="x"]');
        const before = await x();
        const ring = await page.waitForFunction(() => {
            const path = document.querySelector('.gizmo .shape.turn');
            if (!path.getAttribute('d')) {
                return null;
            }
            const {x, y} = path.getPointAtLength(path.getTotalLength() / 4);
            const box = document.getElementById('overlay').getBoundingClientRect();
            return {x: x + box.left, y: y + box.top};
        });
        const at = await ring.jsonValue();
        await page.mouse.move(at.x, at.y);
        await page.mouse.down();
        await page.mouse.move(at.x - 10, at.y - 12, {steps: 4});
        await page.mouse.up();
        await page.waitForFunction(() => !document.getElementById('undo').disabled);
        assert.equal(Math.abs(Number(await turn())) % 15, 0);
        assert.notEqual(Number(await turn()), 0);
        assert.equal(await x(), before, 'it turned about its middle');
        await page.focus('#picture');
        await page.keyboard.press('Control+KeyZ');
        await page.waitForFunction(
            () => Number(document.querySelector('[data-place="turn"]').value) === 0,
        );
        await page.fill('[data-place="x"]', '2.2');
        await page.keyboard.press('Enter');
        await page.waitForFunction(() => {
            const {min, max} = window.raybundle.selected.bounds;
            return Math.abs((min.x + max.x) / 2 - 2.2) < 1e-6;
        });
        await keepScreenshot(page, 'gizmo');
        await page.click('#undo');
        await page.waitForFunction(
            (value) => document.querySelector('[data-place="x"]').value === value,
            before,
        );
    });

    it('keeps a picture to compare with', async () => {
        const {page} = ann;
        await page.click('#tab-review');
        await page.click('#keep-picture');
        await page.click('#compare');
        await page.waitForSelector('#compare-canvas', {state: 'visible'});
        await page.locator('#wipe-at').fill('0.25');
        const clip = await page.evaluate(
            () => document.getElementById('compare-canvas').style.clipPath,
        );
        assert.match(clip, /75/);
        await page.click('#compare');
        assert.ok(await page.isHidden('#compare-canvas'));
    });

    it('shows the light before a change beside that of now, equally exposed', async () => {
        // One that has just come asks for no more accuracy than its own picture has; neither asks for more of that
        // of now than is there, so that all the time is left to that of before.
        const newcomer = await openClient(browser, daemon.url, SMALL);
        const {page} = newcomer;
        await Promise.all([ann.page, page].map((one) => asksFor(one, 1)));
        await page.click('#tab-review');
        const dim = (factor) =>
            page.evaluate(async (times) => {
                const {client, scene} = window.raybundle;
                const [{id, intensity}] = scene.lights;
                await client.request({setLight: {light: id, intensity: intensity * times}}).answer;
                return scene.epoch;
            }, factor);
        await page.waitForFunction(() => window.raybundle.link.shown !== null);
        const epoch = await dim(0.25);
        await page.waitForSelector(`#earlier-epoch option[value="${epoch - 1}"]`, {state: 'attached'});
        await page.selectOption('#earlier-epoch', String(epoch - 1));
        const automatic = await page.getAttribute('#auto-exposure', 'aria-pressed');
        await page.click('#earlier');
        await page.waitForSelector('#compare-canvas', {state: 'visible'});
        assert.match(await page.textContent('#wipe-before'), /^before .*dimmed /);
        await frameWith(page, {epoch});
        const brightness = await page.evaluate(() => {
            const mean = (canvas) => {
                const context = new OffscreenCanvas(16, 12).getContext('2d');
                context.drawImage(canvas, 0, 0, 16, 12);
                const {data} = context.getImageData(0, 0, 16, 12);
                return data.filter((_, i) => i % 4 !== 3).reduce((sum, value) => sum + value, 0) / 576;
            };
            const before = document.getElementById('compare-canvas');
            return {before: mean(before), now: mean(window.raybundle.picture.canvas)};
        });
        assert.ok(brightness.before > 1.3 * brightness.now, JSON.stringify(brightness));
        await keepScreenshot(page, 'light_before');
        await page.click('#compare');
        assert.ok(await page.isHidden('#compare-canvas'));
        assert.equal(await page.getAttribute('#auto-exposure', 'aria-pressed'), automatic);
        await frameWith(ann.page, {epoch: await dim(4)});
        await asksFor(ann.page, 0.02);
        assert.deepEqual(newcomer.faults, []);
        await newcomer.context.close();
    });

    it('shows two people each other, and one follows the other', async () => {
        ben = await openClient(browser, `${daemon.url}#name=Ben`, {...SMALL, colorScheme: 'light'});
        await frameWith(ben.page, {});
        await ann.page.waitForFunction(() => document.querySelector('#people').textContent.includes('Ben'));
        await ben.page.click('#tab-review');
        await ben.page.click('[data-follow]');
        await ann.page.focus('#picture');
        await ann.page.keyboard.press('KeyD');
        const {eye} = await ann.page.evaluate(() => window.raybundle.view);
        await ben.page.waitForFunction(
            (x) => Math.abs(window.raybundle.view.eye.x - x) < 0.2 && window.raybundle.view.eye.x !== 2.75,
            eye.x,
        );
        await ben.page.focus('#picture');
        await ben.page.keyboard.press('KeyA');
        await ben.page.waitForFunction(() => window.raybundleParts.people.following === 0);
        await ben.page.keyboard.down('KeyW');
        await ben.page.waitForFunction(() => window.raybundle.view.eye.z > -5.5);
        await ben.page.keyboard.up('KeyW');
        await ann.page.waitForFunction(() =>
            [...document.querySelectorAll('.people path')].some((path) => path.getAttribute('d')),
        );
    });

    it('keeps a pin with the light measured there, for everybody and for who comes later', async () => {
        const {page} = ann;
        await page.keyboard.press('Home');
        await page.waitForFunction(() => Math.abs(window.raybundle.link.shown?.eye.x - 2.75) < 1e-6);
        await page.keyboard.press('Digit3');
        await clickAt(page, FLOOR);
        await page.waitForSelector('.pin-editor textarea');
        await page.keyboard.type('Too dark beside the boxes');
        await page.keyboard.press('Enter');
        await ben.page.waitForSelector('#pins li');
        assert.match(await ben.page.textContent('#pins li'), /Too dark beside the boxes.* lx( ±|\)|, ).*Ann/);
        const {url} = daemon;
        const cara = await openClient(browser, `${url}#name=Cara`, {...SMALL, colorScheme: 'dark'});
        await cara.page.waitForSelector('.marks .pin', {state: 'attached'});
        await frameWith(cara.page, {settled: 0.3});
        await keepScreenshot(page, 'review_three_people');
        await cara.context.close();
    });

    it('shows the others where to look', async () => {
        await clickAt(ann.page, {x: 1, y: 4, z: 5.5});
        await ann.page.click('.pin-editor [aria-label="Show this place to the others"]');
        await ben.page.waitForSelector('.pointed', {state: 'attached'});
        await ben.page.click('.notice:has-text("look here") button:has-text("Look")');
        await ben.page.waitForFunction(() => window.raybundle.view.target.z > 5.4);
    });

    heavy('flags a pin where the light has changed', async () => {
        const {page} = ann;
        await frameWith(page, {settled: 0.8});
        await page.evaluate(({x, z}) => {
            const {scene} = window.raybundle;
            const box = scene.objects.find(({name}) => name === 'tall box');
            const {min, max} = box.bounds;
            const by = {x: x - (min.x + max.x) / 2, y: 0.4, z: z - (min.z + max.z) / 2};
            const {translation: t} = box.transform;
            const translation = {x: t.x + by.x, y: t.y + by.y, z: t.z + by.z};
            return window.raybundle.moveObject(box.id, {...box.transform, translation});
        }, FLOOR);
        await ben.page.waitForSelector('#pins .flag');
        assert.match(await ben.page.textContent('#pins .flag'), /Light −\d+ % since/);
        assert.match(await ben.page.textContent('[data-value="lastChange"]'), /Ann moved tall box by/);
    });

    it('saves a viewpoint that the other can fly to', async () => {
        await ann.page.click('#tab-scene');
        await ann.page.fill('#viewpoint-name', 'Before the boxes');
        await ann.page.keyboard.press('Enter');
        await ben.page.click('#tab-scene');
        await ben.page.click('#viewpoints button:has-text("Before the boxes")');
        await ben.page.waitForFunction(() => Math.abs(window.raybundle.view.eye.z + 7.5) < 1e-3);
    });

    it('goes on from a link, and comes home as a report', async () => {
        const {page} = ann;
        await page.click('#tab-review');
        const {name, bytes} = await saved(page, '#report');
        assert.equal(name, 'Cornell_box_review.html');
        const html = String(bytes);
        assert.ok(html.includes('Too dark beside the boxes') && html.includes('data:image/jpeg'));
        assert.match(html, /Uo|Measured points/);
        await page.evaluate(() => {
            Object.defineProperty(navigator, 'clipboard', {value: undefined});
            window.raybundle.select(2);
        });
        await page.click('#share');
        await page.waitForFunction(() => location.hash.includes('view='));
        const shared = await openClient(browser, page.url(), SMALL);
        await shared.page.waitForFunction(() => window.raybundle.selected?.id === 2);
        const [a, b] = await Promise.all(
            [page, shared.page].map((p) => p.evaluate(() => window.raybundle.view.eye)),
        );
        for (const axis of ['x', 'y', 'z']) {
            assert.ok(Math.abs(a[axis] - b[axis]) < 1e-3, `${JSON.stringify(a)}, ${JSON.stringify(b)}`);
        }
        await shared.context.close();
    });

    it('renders a picture on the server, to save', async () => {
        const {page} = ann;
        await page.click('#tab-review');
        await page.selectOption('#snapshot-format', 'EXR');
        await page.selectOption('#snapshot-error', '0.1');
        // Who needs nothing more leaves all the time to the snapshot.
        await ben.context.close();
        await asksFor(page, 1);
        await page.click('#snapshot');
        await page.waitForSelector('#snapshot-state a');
        await keepScreenshot(page, 'snapshot');
        const {name, bytes} = await saved(page, '#snapshot-state a');
        assert.match(name, /^Cornell_box_epoch_\d+\.exr$/);
        assert.deepEqual([...bytes.subarray(0, 4)], [0x76, 0x2f, 0x31, 0x01]);
        assert.match(await page.textContent('#snapshot-state'), /error below \d/);
    });

    it('can be shown in another page', async () => {
        const example = await openClient(browser, `${daemon.url}example.html`, SMALL);
        await example.page.waitForFunction(() => {
            const view = document.querySelector('raybundle-view');
            const canvas = view.shadowRoot.querySelector('canvas:not(.backdrop)');
            const context = canvas.getContext('2d');
            const {data} = context.getImageData(canvas.width / 2, canvas.height / 2, 1, 1);
            return canvas.width > 100 && data[0] + data[1] + data[2] > 60;
        });
        await keepScreenshot(example.page, 'embedded');
        assert.deepEqual(example.faults, []);
        await example.context.close();
    });

    it('has caused no error in any page', () => {
        assert.deepEqual(ann.faults, []);
        assert.deepEqual(ben.faults, []);
    });
});
