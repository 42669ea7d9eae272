// SPDX-License-Identifier: Apache-2.0
// Zones with requirements, glare from where one stands, threads of pins, documents.

import assert from 'node:assert/strict';
import {describe, it} from 'node:test';

import {keepScreenshot} from './browser.mjs';
import {fakePages} from './fake_page.mjs';
import {WELCOME as PLAIN_WELCOME} from './fake_server.mjs';

const openPage = fakePages();

/** @type {(y: number) => {x: number, y: number, z: number}[]} */
const square = (y) => [{x: 1, y, z: 1}, {x: 3, y, z: 1}, {x: 3, y, z: 4}, {x: 1, y, z: 4}];
const office = {name: 'Office', mean: 500, uniformity: 0.6, glare: 19, vertical: 150, colourRendering: 80};
const desk = {
    measurement: 4, quantity: 'HORIZONTAL', epoch: 0, settled: 1, columns: 1, rows: 1, factor: 1, points: [],
    mean: 512, meanLow: 490, meanHigh: 534, uniformity: 0.71, uniformityLow: 0.69, uniformityHigh: 0.73,
    outline: square(0.75), name: 'Desk by the window', requirement: 'Office', verdict: 'NOT_YET_KNOWN',
    checks: [
        {what: 'Em', required: 500, atMost: false, verdict: 'NOT_YET_KNOWN'},
        {what: 'Uo', required: 0.6, atMost: false, verdict: 'MET'},
        {what: 'Ra', required: 80, atMost: false, verdict: 'NOT_YET_KNOWN', words: 'not stated by spot'},
    ],
    luminaires: [
        {light: 2, name: 'panel', share: 0.6, colourRendering: 80, colourRenderingMost: 89},
        {light: 3, name: 'panel', share: 0.3, colourRendering: 80, colourRenderingMost: 89},
        {light: 4, name: 'spot', share: 0.1},
    ],
};
const seats = {
    measurement: 7, quantity: 'UGR', epoch: 0, settled: 1, columns: 3, rows: 1, factor: 1, outline: square(1.2), maximum: 21.3,
    points: [
        {position: {x: 1.3, y: 1.2, z: 2.5}, value: 17.2, low: 17, high: 17.4, inside: false, glare: {state: 'RATED', sources: []}},
        {position: {x: 2, y: 1.2, z: 2.5}, value: 21.3, low: 21, high: 21.6, inside: false, glare: {state: 'RATED', sources: []}},
        {position: {x: 2.7, y: 1.2, z: 2.5}, inside: false, glare: {state: 'OUTSIDE', sources: [], words: 'too large'}},
    ],
};
const pin = {
    pin: 1, by: 2, byName: 'Ada', text: 'Glare here', position: {x: 0, y: 0, z: 0}, illuminance: 300, epoch: 0, removed: false,
    setAtMs: 1780000000000, object: 0, localPosition: {x: 0, y: 0, z: 0}, replies: [{byName: 'Bo', text: 'Turn it', atMs: 0}],
};
const WELCOME = {...PLAIN_WELCOME, zones: [desk], requirements: [office], pins: [pin]};
const rating = {
    measurement: 9, quantity: 'UGR', epoch: 0, settled: 1, columns: 0, rows: 0, factor: 1,
    points: [{
        position: {x: 0, y: 1.2, z: 0}, value: 21.26, low: 21.1, high: 21.4, inside: false,
        glare: {
            state: 'RATED', direction: {x: 0, y: 0, z: -1}, background: 40, words: '2 luminaires below the line of sight are left out',
            sources: [
                {name: 'panel 3', light: 1, position: {x: 0, y: 2, z: -2}, share: 0.71, luminance: 5000, solidAngle: 0.01, positionIndex: 2.1},
                {name: 'panel 4', light: 1, position: {x: 1, y: 2, z: -3}, share: 0.29, luminance: 4000, solidAngle: 0.01, positionIndex: 3},
            ],
            luminances: [],
        },
    }],
};

/** @param {import('playwright-core').BrowserContextOptions} options */
async function open(options = {}) {
    /** @type {(body: object) => void} */
    let say = () => {};
    const opened = await openPage((request, send) => {
        say = send;
        const {hello, measure} = request;
        if (hello) {
            send({welcome: WELCOME});
        } else if (measure?.quantity === 'NORMAL') {
            const points = measure.points.map((point) => ({position: point.position, inside: false, value: 100 + 50 * point.normal.y}));
            send({measured: {...desk, name: '', measurement: 11, quantity: 'NORMAL', points}});
        } else if (measure) {
            send({measured: measure.quantity === 'UGR' ? (measure.points ? rating : seats) : {...desk, measurement: 5, name: measure.name}});
        } else {
            send({ok: {}});
        }
    }, options);
    await opened.page.waitForFunction(() => window.raybundle.client.state === 'connected');
    return {...opened, say: (/** @type {object} */ body) => say(body)};
}

/**
 * Waits until the server has heard something.
 *
 * @param {import('playwright-core').Page} page
 * @param {() => boolean} fits
 */
async function heard(page, fits) {
    while (!fits()) {
        await page.evaluate(() => 0);
    }
}

describe('zones', () => {
    it('list what they have against what is required, and follow', async () => {
        const {page, sent, faults, say} = await open({colorScheme: 'light'});
        await page.click('#tab-measure');
        const first = page.locator('#zones > li').first();
        assert.match(await first.innerText(), /Desk by the window/);
        assert.match(await first.innerText(), /Em 512 lx \(490 lx to 534 lx\), Uo 0\.71/);
        assert.match(await first.innerText(), /\? Em ≥ 500 lx: not yet known/);
        assert.match(await first.innerText(), /✓ Uo ≥ 0\.6: met/);
        assert.match(await first.innerText(), /\? Ra ≥ 80: not known, not stated by spot/);
        await first.locator('summary').click();
        assert.deepEqual(await first.locator('.zone-lamps li').allInnerTexts(), ['2 × panel, Ra 80 to 89', '1 × spot, Ra not stated']);
        await page.locator('#zones-title').scrollIntoViewIfNeeded();
        await page.click('#requirements summary');
        await keepScreenshot(page, 'zones_light');
        say({measured: {...desk, mean: 400, meanLow: 390, meanHigh: 410, verdict: 'MISSED'}});
        await page.waitForFunction(() => document.querySelector('#zones .verdict')?.textContent === '✗');
        assert.ok(await first.locator('.zone-lamps').isVisible());  // what has been unfolded stays so

        await page.fill('#zone-name', 'Board');
        await page.click('#zone-form button');
        await page.waitForFunction(() => document.querySelectorAll('#zones > li').length === 2);
        const kept = sent.find(({measure}) => measure?.name === 'Board').measure;
        assert.ok(kept.keep);
        assert.ok(kept.margin > 0);
        await page.locator('#zones > li').nth(1).locator('select').selectOption('Office');
        await heard(page, () => sent.some(({setZone}) => setZone?.measurement === 5 && setZone.requirement === 'Office'));

        await page.click('[aria-label="Edit requirement Office"]');
        assert.equal(await page.inputValue('#requirement-uniformity'), '0.6');
        await page.fill('#requirement-mean', '750');
        await page.click('#requirement-form button');
        await page.waitForFunction(() => document.querySelector('#requirement-name').value === '');
        const {requirement} = sent.find(({setRequirement}) => setRequirement).setRequirement;
        assert.deepEqual(requirement, {...office, mean: 750});  // with what the form has no field for
        say({requirementsChanged: {requirements: [{...office, mean: 750}]}});
        await page.waitForFunction(() => document.querySelector('#requirement-rows td')?.textContent === '750');
        say({measured: {measurement: 4, name: desk.name, removed: true, points: []}});
        await page.waitForFunction(() => document.querySelectorAll('#zones > li').length === 1);
        assert.deepEqual(faults, []);
    });

    it('have arrows of light direction where somebody wants them', async () => {
        const {page, sent, faults, say} = await open({colorScheme: 'dark'});
        await page.click('#tab-measure');
        const points = [1.5, 2.5].map((x) => ({position: {x, y: 0.75, z: 2.5}, value: 500, low: 490, high: 510, inside: false}));
        say({measured: {...desk, points: [...points, {...points[0], inside: true}]}});
        await page.check('#light-arrows');
        await page.waitForFunction(() => document.querySelectorAll('.light-arrows .stroke').length === 2);
        const asked = sent.filter(({measure}) => measure?.quantity === 'NORMAL');
        assert.equal(asked.length, 1);
        assert.equal(asked[0].measure.points.length, 12);
        assert.match(await page.textContent('#light-arrows-state'), /longest stands for 100 lx/);
        await keepScreenshot(page, 'light_arrows');

        // New values of the same points ask for nothing; other points do, and the old ones are given back.
        say({measured: {...desk, points, mean: 480}});
        say({measured: {...desk, points: points.slice(1)}});
        await page.waitForFunction(() => document.querySelectorAll('.light-arrows .stroke').length === 1);
        assert.equal(sent.filter(({measure}) => measure?.quantity === 'NORMAL').length, 2);
        assert.ok(sent.some(({removeMeasurement}) => removeMeasurement?.measurement === 11));
        await page.uncheck('#light-arrows');
        await page.waitForFunction(() => document.querySelectorAll('.light-arrows path').length === 0);
        assert.deepEqual(faults, []);
    });

    it('are outlined in the picture, each with its sign', async () => {
        const {page, faults, say} = await open({colorScheme: 'dark'});
        const label = () => page.textContent('.zone-outlines text');
        await page.waitForSelector('.zone-outlines .not_yet_known');
        assert.equal(await label(), '? Desk by the window');
        const drawn = await page.getAttribute('.zone-outlines .stroke', 'd');
        assert.equal(drawn?.split('L').length, 4);
        say({measured: {...desk, verdict: 'MET'}});
        await page.waitForSelector('.zone-outlines .met');
        assert.equal(await label(), '✓ Desk by the window');
        await page.click('#tab-measure');
        await page.locator('#zones-title').scrollIntoViewIfNeeded();
        await keepScreenshot(page, 'zone_outlines');
        await page.evaluate(() => { window.raybundle.view = {...window.raybundle.view, eye: {x: 2, y: 1.6, z: 7}}; });
        await page.waitForFunction((before) => document.querySelector('.zone-outlines .stroke')?.getAttribute('d') !== before, drawn);
        await page.uncheck('#zones-in-picture');
        await page.waitForFunction(() => !document.querySelector('.zone-outlines text'));
        assert.deepEqual(faults, []);
    });

    it('fit a narrow page, in the dark', async () => {
        const {page, faults} = await open({colorScheme: 'dark', viewport: {width: 360, height: 740}});
        await page.click('#panel-toggle');
        await page.click('#tab-measure');
        await page.click('#requirements summary');
        await page.locator('#zones-title').scrollIntoViewIfNeeded();
        await keepScreenshot(page, 'zones_dark_360');
        const wide = await page.evaluate(() => document.documentElement.scrollWidth > window.innerWidth);
        assert.ok(!wide);
        assert.deepEqual(faults, []);
    });
});

describe('glare', () => {
    it('is a heat map over seats, with the limits that are kept', async () => {
        const {page, faults} = await open({colorScheme: 'light'});
        await page.click('#tab-measure');
        await page.selectOption('#plane-quantity', 'UGR');
        assert.ok(await page.isHidden('#glare-legend'));
        await page.click('#measure-plane');
        await page.waitForSelector('#glare-legend', {state: 'visible'});
        const fills = await page.locator('.glare-map path').evaluateAll((cells) => cells.map((cell) => cell.getAttribute('fill')));
        const steps = await page.locator('#glare-legend li').evaluateAll((items) =>
            items.map((item) => [item.textContent, item.style.getPropertyValue('--step')]));
        const limitOf = (fill) => steps.find(([, colour]) => colour === fill)?.[0];
        assert.deepEqual(fills.map(limitOf), ['19', '22', undefined]);
        assert.equal(await page.locator('.glare-map .unrated').count(), 1);
        await page.locator('#plane-title').scrollIntoViewIfNeeded();
        await keepScreenshot(page, 'glare_map');
        await page.click('#clear-plane');
        await page.waitForSelector('#glare-legend', {state: 'hidden'});
        assert.deepEqual(faults, []);
    });

    it('is rated from where one stands, with what glares', async () => {
        const {page, sent, faults} = await open({colorScheme: 'dark'});
        await page.click('#tab-measure');
        await page.click('#glare-ugr');
        await page.waitForFunction(() => document.querySelectorAll('#glare-sources li').length === 2);
        const {measure} = sent.find((request) => request.measure);
        assert.equal(measure.quantity, 'UGR');
        assert.equal(measure.points.length, 1);
        assert.ok(measure.direction);
        assert.equal(await page.textContent('#glare-value'), 'UGR 21.3 (21.1 to 21.4)');
        assert.match(await page.textContent('#glare-words'), /below the line of sight/);
        assert.match(await page.locator('#glare-sources li').first().innerText(), /71 %[\s\S]*panel 3/);
        await page.locator('#glare-title').scrollIntoViewIfNeeded();
        await keepScreenshot(page, 'glare_dark');
        assert.deepEqual(faults, []);
    });
});

describe('threads and documents', () => {
    it('replies, resolves, and hands documents over', async () => {
        const {page, sent, faults, say} = await open({colorScheme: 'light', acceptDownloads: true});
        await page.click('#tab-review');
        assert.match(await page.locator('#pin-1').innerText(), /Bo: Turn it/);
        await page.click('[aria-label="Reply to pin 1"]');
        await page.fill('input[aria-label="Reply to pin 1"]', 'Done so');
        await page.keyboard.press('Enter');
        await heard(page, () => sent.some(({replyToPin}) => replyToPin?.text === 'Done so'));
        await page.click('[aria-label="Resolve pin 1"]');
        await heard(page, () => sent.some(({setPin}) => setPin?.resolved === true));
        say({pinChanged: {...pin, resolved: true}});
        await page.waitForSelector('#pin-1.resolved');
        await keepScreenshot(page, 'documents_light');

        await page.route('**/report.html?*', (route) => route.fulfill({contentType: 'text/html', body: '<h1>report</h1>'}));
        await page.route('**/report.pdf?*', (route) => route.fulfill({status: 501, body: 'There is no PDF: install Chromium\n'}));
        await page.selectOption('#report-language', 'de');
        const [download] = await Promise.all([page.waitForEvent('download'), page.click('[data-document="report.html"]')]);
        assert.match(download.suggestedFilename(), /report\.html$/);
        await page.click('[data-document="report.pdf"]');
        await page.waitForFunction(() => document.getElementById('documents-state')?.textContent?.startsWith('There is no PDF'));
        assert.deepEqual(faults, []);
    });
});
