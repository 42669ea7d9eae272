// SPDX-License-Identifier: Apache-2.0
// What stays of somebody's work: over other scenes, a killed server and for who comes later. One server, whose
// tests build on one another.

import assert from 'node:assert/strict';
import {once} from 'node:events';
import {mkdtemp, readFile, rm, writeFile} from 'node:fs/promises';
import {tmpdir} from 'node:os';
import path from 'node:path';
import {after, before, describe, it} from 'node:test';

import {frameWith, keepScreenshot, launchBrowser, openClient} from './browser.mjs';
import {Daemon} from './daemon.mjs';
import {toGlb} from './glb.mjs';

const SCENE = 'scenes/cornell_box.gltf';
const OPTIONS = {viewport: {width: 1000, height: 700}, acceptDownloads: true};

describe('work on a server that nobody has told to save it', () => {
    let folder, state, daemon, browser, ann, ben;

    const start = (port = 0) => Daemon.start(SCENE, port, ['--scenes', folder], state);

    before(async () => {
        folder = await mkdtemp(path.join(tmpdir(), 'raybundle_desk_'));
        state = await mkdtemp(path.join(tmpdir(), 'raybundle_state_'));
        await writeFile(path.join(folder, 'attic.glb'), await toGlb(SCENE));
        browser = await launchBrowser();
        daemon = await start();
        ann = await openClient(browser, `${daemon.url}#name=Ann`, OPTIONS);
        await frameWith(ann.page, {});
    });

    after(async () => {
        await browser?.close();
        await daemon?.stop();
        await rm(folder, {recursive: true, force: true});
        await rm(state, {recursive: true, force: true});
    });

    const history = (page) => page.locator('#changes li').allTextContents();

    it('is saved, and the page says so', async () => {
        const {page} = ann;
        assert.equal(await page.textContent('#saving'), 'Saved');
        await page.click('#tab-light');
        const light = page.locator('#lights input[type="number"]').first();
        const full = Number(await light.inputValue());
        await light.fill(String(full / 2));
        await page.keyboard.press('Enter');
        await page.waitForFunction(() => window.raybundle.scene.epoch === 1);
        await page.click('#tab-review');
        const [entry] = await history(page);
        assert.match(entry, /You dimmed .*: 100 → 50\s%/);
        await page.waitForFunction(() => document.getElementById('saving').textContent === 'Saved');
    });

    it('is known to who comes later, by name', async () => {
        // Notices go by themselves.
        const noticed = ann.page.waitForSelector('.notice:has-text("Ben has joined.")');
        ben = await openClient(browser, `${daemon.url}#name=Ben`, OPTIONS);
        await frameWith(ben.page, {});
        await noticed;
        await ben.page.click('#tab-review');
        await ben.page.waitForSelector('#changes li');
        assert.match((await history(ben.page))[0], /Ann dimmed .*: 100 → 50\s%/);
    });

    it('is asked about before another scene replaces it, with who sees it', async () => {
        const {page} = ann;
        await page.click('#tab-scene');
        await page.click('#scene-file-list button[title="attic.glb"]');
        const asked = await page.textContent('#scene-file-asked');
        assert.match(asked, /replaces the scene for Ben, too\. The 1 change in the present scene is saved/);
        await keepScreenshot(page, 'opening_question');
    });

    it('gives way to the picture of the other scene, whose title is above no other picture', async () => {
        for (const {page} of [ann, ben]) {
            await page.evaluate(() => {
                window.seen = [];
                const title = document.getElementById('scene-name');
                new MutationObserver(() => {
                    const {frame, picture, stats} = window.raybundle;
                    const shown = picture.element.classList.contains('has-picture');
                    window.seen.push({title: title.textContent, shown, frame: frame !== null, iterations: stats.iterations});
                }).observe(title, {childList: true, characterData: true, subtree: true});
            });
        }
        await ann.page.click('#scene-file-open');
        await ben.page.waitForSelector('#preparing:not([hidden])');
        await ben.page.waitForFunction(() => /\(3 of 3|is ready/.test(document.getElementById('preparing-text').textContent));
        await keepScreenshot(ben.page, 'opening_card');
        for (const {page} of [ann, ben]) {
            await page.waitForFunction(() => window.seen.some(({title}) => title === 'Attic'));
            const [first] = await page.evaluate(() => window.seen.filter(({title}) => title === 'Attic'));
            assert.deepEqual(first, {title: 'Attic', shown: false, frame: false, iterations: null});
            await frameWith(page, {});
            await page.waitForSelector('#preparing', {state: 'hidden'});
            assert.equal(await page.locator('.notice:has-text("has joined")').count() > 1, false, 'nobody has just come');
        }
    });

    it('is there again after the server has been killed, as is the scene that was open', async () => {
        const {page} = ann;
        await page.click('#tab-scene');
        await page.click('#objects li:first-child button');
        await page.click('[data-nudge="1,0"]');
        await page.waitForFunction(() => window.raybundle.scene.epoch === 1);
        const {port} = daemon;
        const ended = once(daemon.child, 'exit');
        daemon.child.kill('SIGKILL');
        await ended;
        daemon = await start(port);
        await page.waitForFunction(() => window.raybundle.client.state === 'connected');
        await frameWith(page, {});
        assert.equal(await page.textContent('#scene-name'), 'Attic');
        await page.click('#tab-review');
        await page.waitForSelector('#changes li');
        assert.match((await history(page))[0], /Ann moved|You moved/);
        const lost = page.locator('.notice:has-text("were lost")');
        assert.equal(await lost.count(), 0);
    });

    it('is in the report by names, never as You', async () => {
        const {page} = ann;
        const [download] = await Promise.all([page.waitForEvent('download'), page.click('#report')]);
        const html = await readFile(await download.path(), 'utf8');
        assert.match(html, /<td class="n">Ann<\/td>/);
        assert.ok(!/>You</.test(html));
    });

    it('has false colour with its values at the lines, logarithmic or linear', async () => {
        const {page} = ann;
        await page.click('#tab-measure');
        await page.selectOption('#display-mode', 'FALSE_ILLUMINANCE');
        await page.check('#isolines');
        await page.waitForSelector('.isoline-value', {state: 'attached'});
        const values = await page.locator('.isoline-value').allTextContents();
        assert.ok(values.every((text) => /^[125]/.test(text)), values.join());
        assert.match(await page.textContent('#legend-above'), /^above \d/);
        assert.match(await page.textContent('#legend-below'), /^below \d/);
        await keepScreenshot(page, 'false_colour_numbers');
        await page.click('[data-scale="linear"]');
        await page.waitForFunction(() => window.raybundle.frame?.scaleLinear === true);
        await page.waitForFunction(() => document.querySelector('#legend-ticks li:last-child').textContent === '0');
        assert.ok(await page.isHidden('#legend-below-row'));
        await keepScreenshot(page, 'false_colour_linear');
        assert.deepEqual(ann.faults.filter((fault) => !/WebSocket/.test(fault)), []);
    });
});
