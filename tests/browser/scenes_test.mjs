// SPDX-License-Identifier: Apache-2.0
// Adding scenes to the server and opening them, as editors do in the page, while another looks on.

import assert from 'node:assert/strict';
import {mkdtemp, rm, writeFile} from 'node:fs/promises';
import {tmpdir} from 'node:os';
import path from 'node:path';
import {after, before, describe, it} from 'node:test';

import {frameWith, keepScreenshot, launchBrowser, openClient} from './browser.mjs';
import {Daemon} from './daemon.mjs';
import {toGlb} from './glb.mjs';

const SCENE = 'scenes/cornell_box.gltf';

describe('the list of scenes', () => {
    let folder, daemon, browser, ann, ben;

    before(async () => {
        folder = await mkdtemp(path.join(tmpdir(), 'raybundle_scenes_'));
        await writeFile(path.join(folder, 'broken.gltf'), '{"asset":{"version":"2.0"},"scenes":7}');
        browser = await launchBrowser();
        daemon = await Daemon.start(SCENE, 0, ['--scenes', folder, '--max-upload-megabytes', '1']);
        const options = {viewport: {width: 900, height: 640}};
        ann = await openClient(browser, `${daemon.url}#name=Ann`, options);
        ben = await openClient(browser, `${daemon.url}#name=Ben`, options);
        await frameWith(ann.page, {});
        await frameWith(ben.page, {});
    });

    after(async () => {
        await browser?.close();
        await daemon?.stop();
        await rm(folder, {recursive: true, force: true});
    });

    const stateIs = (text) =>
        ann.page.waitForFunction(
            (part) => document.getElementById('scene-file-state').textContent.includes(part),
            text,
        );
    const listed = (name) => ann.page.waitForSelector(`#scene-file-list button[title="${name}"]`);

    it('takes a file by the button, and says what is wrong with another', async () => {
        const file = (name, buffer) => ({name, mimeType: 'model/gltf-binary', buffer});
        await ann.page.setInputFiles('#scene-file', file('Atelier Süd.glb', await toGlb(SCENE)));
        await listed('Atelier Süd.glb');
        await ann.page.setInputFiles('#scene-file', file('no.glb', Buffer.from('glTF, it says')));
        await stateIs('This file is damaged, or not whole.');
        await ann.page.click('#scene-file-details summary');
        assert.notEqual(await ann.page.textContent('#scene-file-reason'), '');
        await ann.page.setInputFiles('#scene-file', file('big.glb', Buffer.alloc(1_000_001)));
        await stateIs('this server takes up to 1.0 MB');
        await ann.page.setInputFiles('#scene-file', file('scene.obj', Buffer.from('o box')));
        await stateIs('is not a .glb file');
    });

    it('takes a file that is dropped on the page', async () => {
        const bytes = [...(await toGlb(SCENE))];
        await ann.page.evaluate((data) => {
            const transfer = new DataTransfer();
            transfer.items.add(new File([new Uint8Array(data)], 'dropped.glb'));
            for (const type of ['dragover', 'drop']) {
                const event = new DragEvent(type, {dataTransfer: transfer, bubbles: true, cancelable: true});
                document.getElementById('picture').dispatchEvent(event);
            }
        }, bytes);
        await listed('dropped.glb');
        await keepScreenshot(ann.page, 'scene_files');
    });

    it('says why a scene cannot be opened, and keeps the one that is shown', async () => {
        await ann.page.click('#scene-file-list button[title="broken.gltf"]');
        await ann.page.click('#scene-file-open');
        await stateIs('Could not open broken.gltf. This scene cannot be used.');
        await ben.page.waitForSelector('.notice:has-text("Ann could not open broken.gltf")');
        assert.equal(await ann.page.textContent('#connection-text'), 'Connected');
        assert.notEqual(await ann.page.textContent('#scene-name'), 'broken');
    });

    it('opens a scene for everybody, who see how far it is', async () => {
        await ben.page.evaluate(() => {
            window.seen = [];
            const [pill, text, title] = ['preparing', 'preparing-text', 'banner-title'].map((id) =>
                document.getElementById(id),
            );
            const note = () => {
                window.seen.push(pill.hidden ? '' : text.textContent, title.textContent);
            };
            for (const element of [pill, text, title]) {
                const what = {attributes: true, childList: true, characterData: true, subtree: true};
                new MutationObserver(note).observe(element, what);
            }
        });
        await ann.page.click('#scene-file-list button[title="Atelier Süd.glb"]');
        await ann.page.click('#scene-file-open');
        for (const {page} of [ann, ben]) {
            await page.waitForFunction(() =>
                document.getElementById('scene-name').textContent.includes('Atelier'),
            );
            await frameWith(page, {});
        }
        await ann.page.waitForSelector('#scene-file-list button[title="Atelier Süd.glb"][aria-pressed="true"]');
        const seen = await ben.page.evaluate(() => window.seen);
        for (const part of ['Ann opens Atelier Süd.glb (1 of 3', '(2 of 3', '(3 of 3']) {
            assert.ok(seen.some((text) => text.includes(part)), `${part}: ${seen.join(' | ')}`);
        }
        assert.ok(!seen.some((text) => text.includes('is lost')), seen.join(' | '));
        await ben.page.waitForSelector('#preparing', {state: 'hidden'});
    });
});
