// SPDX-License-Identifier: Apache-2.0
// A building of many parts: walking against its walls, plans and sections, doors, search, storeys, hidden and locked
// parts, materials by a click. The server says what the test wants.

import assert from 'node:assert/strict';
import {describe, it} from 'node:test';

import {keepScreenshot} from './browser.mjs';
import {fakePages} from './fake_page.mjs';
import {WELCOME} from './fake_server.mjs';

const openPage = fakePages();

const box = (x, y, z, w, h, d) => ({min: {x, y, z}, max: {x: x + w, y: y + h, z: z + d}});
const part = (id, name, bounds, more = {}) => ({id, name, movable: true, kind: 'THING', storey: '', bounds, transform: {}, ...more});

const OBJECTS = [
    part(1, 'Wall, EG, 2O2Fr$t4', box(0, 0, 0, 8, 3, 0.2), {kind: 'STRUCTURE', storey: 'EG'}),
    part(2, 'Haustür', box(3, 0, 3, 0.9, 2, 0.05), {kind: 'DOOR', storey: 'EG', transform: {translation: {x: 3, y: 0, z: 3}}}),
    part(3, 'Sofa', box(5, 0, 2, 2, 0.8, 1), {storey: 'EG'}),
    part(4, 'Roof', box(0, 6, 0, 8, 0.3, 6), {kind: 'STRUCTURE', storey: 'OG'}),
    ...Array.from({length: 8}, (_, i) => part(5 + i, `Chair ${i + 1}`, box(i % 4, 3, 1, 0.5, 0.9, 0.5), {storey: 'OG'})),
];
const HOUSE = {
    ...WELCOME,
    scene: {
        ...WELCOME.scene,
        name: 'house',
        bounds: box(0, 0, 0, 8, 6.3, 6),
        objects: OBJECTS,
        cameras: [{name: 'inside', eye: {x: 4, y: 1.6, z: 5}, target: {x: 4, y: 1.6, z: 0}, up: {x: 0, y: 1, z: 0}, verticalFov: 1}],
        materials: [
            {id: 1, name: 'plaster', baseColour: {x: 0.8, y: 0.8, z: 0.8}, roughness: 1, metallic: 0, matt: true},
            {id: 2, name: 'oak', baseColour: {x: 0.4, y: 0.25, z: 0.1}, roughness: 0.3, metallic: 0},
            {id: 3, name: 'plaster', baseColour: {x: 0.8, y: 0.8, z: 0.8}, roughness: 1, metallic: 0, matt: true},
        ],
        lights: [...WELCOME.scene.lights, {id: 2, name: 'sky', kind: 'SKY', intensity: 12000, unit: 'LX', colour: {x: 1, y: 1, z: 1}, on: true, loadedIntensity: 12000}],
    },
};

/** Cells about an eye: a floor at 0 and a wall behind z = 3. */
function cellsAbout({x, y, z}) {
    const origin = {x: x - 3.2, y: y - 2.4, z: z - 3.2};
    const bytes = Buffer.alloc(8 * 64 * 64);
    for (let row = 0; row < 64; ++row) {
        for (let column = 0; column < 64; ++column) {
            for (let k = 0; k < 64; ++k) {
                const solid = origin.y + k * 0.05 + 0.025 < 0 || origin.z + row * 0.1 + 0.05 < 3;
                bytes[8 * (row * 64 + column) + (k >> 3)] |= (solid ? 1 : 0) << (k & 7);
            }
        }
    }
    return {origin, cell: 0.1, layer: 0.05, columns: 64, layers: 64, occupied: bytes.toString('base64'), epoch: 0};
}

/** @param {{object: number, material: number}} under  what lies under the pointer */
function house(under = {object: 0, material: 1}) {
    let epoch = 0;
    return (request, send) => {
        const {hello, getWalkMap, moveObject, setMaterial, setLight, probe} = request;
        const change = moveObject ? {moveObject} : setMaterial ? {setMaterial} : setLight ? {setLight} : null;
        if (change) {
            send({sceneChanged: {epoch: ++epoch, by: 1, ...change}});
        } else if (getWalkMap) {
            send({walkMap: cellsAbout(getWalkMap.eye)});
        } else if (probe) {
            const at = {position: {x: 3.4, y: 1, z: 3}, normal: {x: 0, y: 0, z: 1}, illuminance: 1, luminance: 1};
            send({probeResult: {hit: true, epoch, ...at, ...under}});
        } else {
            send(hello ? {welcome: HOUSE} : {ok: {}});
        }
    };
}

const opened = async (answer, options) => {
    const all = await openPage(answer, {reducedMotion: 'reduce', ...options});
    await all.page.waitForFunction(() => window.raybundle?.client.state === 'connected');
    return all;
};
const eye = (page) => page.evaluate(() => window.raybundle.view.eye);
const messages = (sent, kind) => sent.flatMap((message) => (message[kind] ? [message[kind]] : []));

describe('walking in a building', () => {
    it('ends at the wall, by keys and by the wheel, unless C says otherwise', async () => {
        const {page, faults} = await opened(house());
        await page.waitForFunction(() => window.raybundleParts.collisions.grid !== null);
        await page.focus('#picture');
        await page.keyboard.down('KeyW');
        await page.waitForFunction(() => window.raybundle.view.eye.z < 3.35);
        await page.waitForTimeout(500);
        const {y, z} = await eye(page);
        assert.ok(z > 3.15 && Math.abs(y - 1.6) < 0.02, `${z} ${y}`);
        await page.keyboard.up('KeyW');
        await page.mouse.move(500, 400);
        for (let i = 0; i < 20; ++i) {
            await page.mouse.wheel(0, -200);
        }
        await page.waitForTimeout(200);
        assert.ok((await eye(page)).z > 3.15);
        await page.keyboard.press('KeyC');
        await page.waitForSelector('.notice:has-text("through walls now")');
        await page.keyboard.down('KeyW');
        await page.waitForFunction(() => window.raybundle.view.eye.z < 2.5);
        await page.keyboard.up('KeyW');
        assert.deepEqual(faults, []);
    });
});

describe('plans and sections', () => {
    it('are cut, shifted by a drag, enlarged by the wheel, and left for where one was', async () => {
        const {page, sent} = await opened(house());
        const before = await eye(page);
        await page.click('#plans-details summary');
        assert.deepEqual(await page.$$eval('#plans button', (all) => all.map((one) => one.textContent)), [
            'Plan of EG', 'Plan of OG', 'Section, looking north (−z)', 'Section, looking east (+x)',
        ]);
        await page.click('#plans button:has-text("Plan of OG")');
        await page.waitForFunction(() => window.raybundle.view.near > 100);
        const plan = messages(sent, 'setCamera').at(-1);
        assert.ok(Math.abs(plan.eye.y - plan.near - 4.2) < 1e-3, '1.2 m above the floor of OG');
        assert.ok(plan.target.y < plan.eye.y && Math.abs(plan.target.x - plan.eye.x) < 1e-9);
        await page.mouse.move(400, 250);
        await page.mouse.down();
        await page.mouse.move(500, 250, {steps: 4});
        await page.mouse.up();
        await page.waitForFunction((x) => window.raybundle.view.eye.x < x - 0.5, plan.eye.x);
        await page.mouse.wheel(0, -300);
        await page.waitForFunction((fov) => window.raybundle.view.verticalFov < fov, plan.verticalFov);
        assert.equal((await eye(page)).y, plan.eye.y);
        await page.click('#leave-plan');
        assert.deepEqual(await eye(page), before);
        assert.ok(await page.isHidden('#leave-plan'));
    });

    it('are whole in a picture of another shape, unless they have been shifted or enlarged', async () => {
        const {page} = await opened(house());
        const width = () => page.evaluate(() => {
            const {view, picture} = window.raybundle;
            return 2 * view.near * Math.tan(view.verticalFov / 2) * picture.aspect;
        });
        await page.click('#plans-details summary');
        await page.click('#plans button:has-text("Plan of EG")');
        await page.waitForFunction(() => window.raybundle.view.near > 100);
        assert.ok(await width() >= 8, 'the house is 8 m wide');
        await page.setViewportSize({width: 1000, height: 1400});
        await page.waitForFunction(() => window.raybundle.picture.aspect < 1);
        await page.waitForFunction(() => {
            const {view, picture} = window.raybundle;
            return 2 * view.near * Math.tan(view.verticalFov / 2) * picture.aspect >= 8;
        });
        await page.mouse.move(400, 250);
        const {verticalFov} = await page.evaluate(() => window.raybundle.view);
        await page.mouse.wheel(0, -300);
        await page.waitForFunction((fov) => window.raybundle.view.verticalFov < fov, verticalFov);
        const enlarged = await page.evaluate(() => window.raybundle.view);
        await page.setViewportSize({width: 1280, height: 800});
        await page.waitForFunction(() => window.raybundle.picture.aspect > 1);
        assert.deepEqual(await page.evaluate(() => window.raybundle.view), enlarged);
    });

    it('leave what lies over the picture where it was, until their own picture is there', async () => {
        const {page} = await opened(house());
        await page.click('#objects button:has-text("Sofa")');
        const outline = () => page.evaluate(async () => {
            await new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)));
            return document.querySelector('#overlay .selected .stroke').getAttribute('d');
        });
        const arrived = () => page.evaluate(() => {
            const app = window.raybundle;
            app.frame = {cameraId: 1};
            app.link.shown = app.view;
            app.drawOverlay();
        });
        await arrived();
        const inside = await outline();
        assert.ok(inside.length > 0);
        await page.click('#plans-details summary');
        await page.click('#plans button:has-text("Plan of EG")');
        await page.waitForFunction(() => window.raybundle.view.near > 100);
        assert.equal(await outline(), inside);
        await arrived();
        const above = await outline();
        assert.notEqual(above, inside);
        await page.click('#leave-plan');
        assert.equal(await outline(), above);
    });
});

/// Where an element is once it stays there: handles follow the picture of a new view.
async function restingBox(locator) {
    let last = await locator.boundingBox();
    for (;;) {
        await locator.evaluate(() => new Promise((done) => {
            requestAnimationFrame(() => requestAnimationFrame(done));
        }));
        const now = await locator.boundingBox();
        if (last && now && now.x === last.x && now.y === last.y) {
            return now;
        }
        last = now;
    }
}

describe('parts of a building', () => {
    it('are found by words, listed by storey, hidden, isolated, and all shown again', async () => {
        const {page, sent} = await opened(house());
        assert.deepEqual(await page.$$eval('#objects .group b', (all) => all.map((one) => one.textContent)), ['EG', 'OG']);
        await keepScreenshot(page, 'storeys');
        await page.fill('#object-search', 'chair 3');
        await page.waitForFunction(() => document.querySelectorAll('#objects li:not(.group)').length === 1);
        await page.click('#objects li[data-object="7"] button');
        await page.click('#hide');
        await page.waitForSelector('#objects li[data-object="7"] .tag:has-text("hidden")');
        assert.deepEqual(messages(sent, 'setHidden').at(-1), {objects: [7]});
        await page.click('#hide:has-text("Show")');  // it is the one that is selected
        await page.waitForSelector('#hide:has-text("Hide")');
        assert.deepEqual(messages(sent, 'setHidden').at(-1), {objects: []});
        await page.fill('#object-search', '');
        await page.click('#objects .group button[aria-label="Show only EG"]');
        await page.waitForFunction(() => document.getElementById('show-all').textContent === 'Show all 9 hidden ones');
        assert.deepEqual(messages(sent, 'setHidden').at(-1).objects.slice(0, 2), [4, 5]);
        await page.click('#show-all');
        await page.waitForSelector('#show-all', {state: 'hidden'});
        assert.deepEqual(messages(sent, 'setHidden').at(-1), {objects: []});
    });

    it('that are fixed are folded again once the words that they were found by are gone', async () => {
        const {page} = await opened(house());
        const open = (/** @type {boolean} */ wanted) =>
            page.waitForFunction((want) => document.getElementById('fixed-details').open === want, wanted);
        await page.fill('#object-search', 'roof');
        await open(true);
        await page.fill('#object-search', 'sofa');
        await open(false);
        await page.fill('#object-search', 'wall');
        await open(true);
        await page.fill('#object-search', '');
        await open(false);
        await page.click('#fixed-details summary');
        await page.fill('#object-search', 'wall');
        await page.fill('#object-search', '');
        await page.waitForSelector('#objects li[data-object="12"]');
        assert.ok(await page.locator('#fixed-details').evaluate((details) => details.open), 'as the user has left it');
    });

    it('that hold it up stay where they are until they are unlocked', async () => {
        const {page, sent} = await opened(house({object: 1, material: 1}));
        await page.mouse.click(500, 300);
        await page.waitForSelector('#unlock', {state: 'visible'});
        assert.match(await page.textContent('[data-value="selectionHint"]'), /by accident/);
        await page.mouse.move(500, 300);
        await page.mouse.down();
        await page.mouse.move(560, 300, {steps: 4});
        await page.mouse.up();
        assert.deepEqual(messages(sent, 'moveObject'), []);
        await page.click('#unlock');
        await page.waitForSelector('#placement', {state: 'visible'});
        await page.click('[data-nudge="1,0"]');
        await page.waitForFunction(() => window.raybundle.scene.epoch === 1);
    });

    it('doors open by a double click about their hinge, close by another, and are undone', async () => {
        const {page, sent} = await opened(house({object: 2, material: 2}));
        await page.mouse.dblclick(500, 300);
        await page.waitForFunction(() => window.raybundle.scene.epoch === 1);
        const {transform} = messages(sent, 'moveObject')[0];
        assert.ok(Math.abs(Math.abs(transform.rotation.y) - Math.SQRT1_2) < 1e-6, JSON.stringify(transform));
        assert.deepEqual(transform.translation, {x: 3, y: 0, z: 3});
        await page.mouse.dblclick(500, 300);
        await page.waitForFunction(() => window.raybundle.scene.epoch === 2);
        assert.equal(messages(sent, 'moveObject')[1].transform.rotation.w, 1);
        await page.click('#undo');
        await page.waitForFunction(() => window.raybundle.scene.epoch === 3);
    });

    it('turn about a handle that can be moved', async () => {
        const {page} = await opened(house());
        await page.evaluate(() => {
            window.raybundle.view = {...window.raybundle.view, eye: {x: 4, y: 2.5, z: 5.5}, target: {x: 5.5, y: 0, z: 2.5}};
            window.raybundle.select(3);
        });
        await page.click('[data-gizmo="turn"]');
        const handle = await restingBox(page.locator('.gizmo .grip.pivot'));
        const at = [handle.x + handle.width / 2, handle.y + handle.height / 2];
        await page.mouse.move(...at);
        await page.mouse.down();
        await page.mouse.move(at[0] + 60, at[1], {steps: 4});
        await page.mouse.up();
        const {pivot, middle} = await page.evaluate(() => {
            const {selected} = window.raybundle;
            return {pivot: selected.pivot, middle: (selected.bounds.min.x + selected.bounds.max.x) / 2};
        });
        assert.ok(Math.abs(pivot.x - middle) > 0.2 && Math.abs(pivot.y) < 1e-9, JSON.stringify(pivot));
        await keepScreenshot(page, 'pivot');
    });
});

describe('materials and daylight', () => {
    it('a click on a wall shows its material, of which all of one name change together', async () => {
        const {page, sent} = await opened(house({object: 0, material: 3}));
        await page.click('#tab-light');
        await page.mouse.click(500, 300);
        await page.waitForSelector('#materials li.picked');
        assert.equal(await page.textContent('#materials li.picked b'), 'plaster (2)');
        assert.match(await page.textContent('#materials li.picked'), /perfectly matt/);
        await keepScreenshot(page, 'picked_material');
        const percent = page.locator('#materials li.picked input[aria-label*="reflectance"]');
        assert.equal(await percent.inputValue(), '80');
        await percent.fill('50');
        await percent.press('Enter');
        await page.waitForFunction(() => window.raybundle.scene.materials.filter(({baseColour}) => Math.abs(baseColour.y - 0.5) < 1e-6).length === 2);
        assert.deepEqual(messages(sent, 'setMaterial').map(({material}) => material), [1, 3]);
        await page.click('#tab-scene');
        assert.equal(await page.textContent('#picked-material'), 'plaster');
    });

    it('the sky is switched and dimmed like any light, and belongs to no group', async () => {
        const {page, sent} = await opened(house());
        await page.click('#tab-light');
        const card = page.locator('#lights li:has-text("sky")');
        assert.equal(await card.locator('.unit').textContent(), 'lx');
        await card.locator('[role="switch"]').click();
        await page.waitForFunction(() => !window.raybundle.scene.lights[1].on);
        assert.deepEqual(messages(sent, 'setLight').at(-1), {light: 2, on: false});
        assert.ok(await page.isHidden('#light-groups-part'), 'no light of this house can be in one');
    });
});
