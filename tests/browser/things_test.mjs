// SPDX-License-Identifier: Apache-2.0
// What a person adds to a scene and takes away from it: objects, copies, luminaires by files that are uploaded.

import assert from 'node:assert/strict';
import {mkdtemp, rm} from 'node:fs/promises';
import {tmpdir} from 'node:os';
import path from 'node:path';
import {after, before, describe, it} from 'node:test';

import {frameWith, keepScreenshot, launchBrowser, openClient} from './browser.mjs';
import {Daemon} from './daemon.mjs';

const IES = `IESNA:LM-63-2002
TILT=NONE
1 1000 1 4 1 1 2 0.3 0.6 0.05
1 1 10
0 30 60 90
0
1000 900 500 0
`;

describe('things', () => {
    let folder, daemon, browser, ann, ben;

    before(async () => {
        folder = await mkdtemp(path.join(tmpdir(), 'raybundle_things_'));
        browser = await launchBrowser();
        daemon = await Daemon.start('scenes/cornell_box.gltf', 0, ['--scenes', folder]);
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

    const names = (who) => who.page.evaluate(() => window.raybundle.scene.objects.map(({name}) => name));
    const counts = (who, objects) =>
        who.page.waitForFunction((wanted) => window.raybundle.scene.objects.length === wanted, objects);
    const lights = (who, wanted) =>
        who.page.waitForFunction((count) => window.raybundle.scene.lights.length === count, wanted);

    it('are removed by Del, and come back by undo', async () => {
        const all = (await names(ann)).length;
        await ann.page.locator('#objects button', {hasText: 'short box'}).click();
        await ann.page.focus('#picture');
        await ann.page.keyboard.press('Delete');
        await counts(ann, all - 1);
        await counts(ben, all - 1);
        assert.ok(!(await names(ben)).includes('short box'));
        assert.ok(await ann.page.isVisible('#selection-none'));
        await ann.page.click('#undo');
        await counts(ben, all);
        assert.ok((await names(ben)).includes('short box'));
    });

    it('are copied by Ctrl+D, the copy is selected, and goes by undo', async () => {
        const all = (await names(ann)).length;
        await ann.page.locator('#objects button', {hasText: 'short box'}).click();
        await ann.page.focus('#picture');
        await ann.page.keyboard.press('Control+KeyD');
        await counts(ann, all + 1);
        await counts(ben, all + 1);
        await ann.page.waitForFunction(() => window.raybundle.selected?.name === 'short box copy');
        await keepScreenshot(ann.page, 'things_copy');
        await ann.page.click('#undo');
        await counts(ben, all);
        await ann.page.click('#redo');
        await counts(ben, all + 1);
    });

    it('shine: a file is uploaded, a field of luminaires added, exchanged and removed', async () => {
        const before = await ann.page.evaluate(() => window.raybundle.scene.lights.length);
        await ann.page.click('#tab-light');
        await ann.page.click('#add-luminaire summary');
        const file = (name, text) => ({name, mimeType: 'text/plain', buffer: Buffer.from(text)});
        await ann.page.setInputFiles('#photometry-file', file('broken.ies', 'IESNA:LM-63-2002\nTILT=NONE\n1 two'));
        await ann.page.waitForFunction(() => document.getElementById('luminaire-note').textContent.includes('Rejected'));
        await ann.page.setInputFiles('#photometry-file', file('panel.ies', IES));
        await ann.page.waitForSelector('#luminaire-file option[value="panel.ies"]', {state: 'attached'});
        await ann.page.setInputFiles('#photometry-file', file('spot.ies', IES.replace('500 0', '0 0')));
        await ann.page.waitForSelector('#luminaire-file option[value="spot.ies"]', {state: 'attached'});
        await ann.page.selectOption('#luminaire-file', 'panel.ies');
        await ann.page.fill('#luminaire-x', '1.5');
        await ann.page.fill('#luminaire-z', '1.5');
        await ann.page.fill('#luminaire-columns', '2');
        await ann.page.fill('#luminaire-rows', '2');
        await ann.page.fill('#luminaire-group', 'ceiling');
        await ann.page.click('#luminaire-add');
        await lights(ann, before + 4);
        await lights(ben, before + 4);
        await keepScreenshot(ann.page, 'things_field');
        const card = ann.page.locator('#lights > li', {hasText: 'panel 1'});
        await card.locator('summary').click();
        await card.getByLabel('panel 1, all of its type').check();
        await card.getByLabel('panel 1, photometric file').selectOption('spot.ies');
        await ben.page.waitForFunction(
            () => window.raybundle.scene.lights.filter(({photometry}) => photometry === 'spot.ies').length === 4,
        );
        await card.getByText('Remove panel 1').click();
        await lights(ben, before + 3);
        await ann.page.click('#undo');
        await lights(ben, before + 4);
        await keepScreenshot(ann.page, 'things_luminaires');
    });
});
