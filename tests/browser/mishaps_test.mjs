// SPDX-License-Identifier: Apache-2.0
// What becomes of input that is refused, mistyped or not meant: numbers, clicks on scenes, double clicks, drags
// beside the line of a comparison; and of undo after another start of the server.

import assert from 'node:assert/strict';
import {describe, it} from 'node:test';

import {keepScreenshot} from './browser.mjs';
import {fakePages} from './fake_page.mjs';
import {WELCOME} from './fake_server.mjs';

const openAny = fakePages();

const BOX = {min: {x: 1, y: 0, z: 1}, max: {x: 2, y: 1, z: 2}};
const STILL = {translation: {x: 0, y: 0, z: 0}, rotation: {x: 0, y: 0, z: 0, w: 1}, scale: {x: 1, y: 1, z: 1}};
const SCENE = {
    ...WELCOME.scene,
    objects: [
        {id: 1, name: 'table', movable: true, bounds: BOX, transform: STILL},
        {id: 2, name: 'chair', movable: true, bounds: BOX, transform: STILL},
    ],
};
const CAMERA = WELCOME.scene.cameras[0];
const crowd = (count) =>
    Array.from({length: count}, (_, i) => ({
        ...CAMERA, viewer: i + 1, name: '', role: 'EDITOR', aspect: 1, following: 0,
    }));
const SCENES = {
    scenes: [
        {name: 'a.glb', bytes: 1, changedAtMs: 0},
        {name: 'b.glb', bytes: 1, changedAtMs: 0},
    ],
    current: 'a.glb',
    maxUploadBytes: 0,
};

/** A server that carries out changes, below 1e9 as the real one. */
function obeys({people = 1, hit = 1} = {}) {
    let epoch = 0;
    const tooMuch = {error: {code: 'INVALID_ARGUMENT', message: 'setLight.intensity: must be at most 1e9'}};
    return (request, send) => {
        const {hello, setLight, moveObject, probe, listScenes} = request;
        if (hello) {
            send({welcome: {...WELCOME, scene: SCENE, canOpenScenes: true}});
            send({replyTo: undefined, presence: {viewers: crowd(people)}});
        } else if (setLight || moveObject) {
            const value = setLight?.intensity ?? moveObject?.transform.translation.x;
            send(value > 1e9 ? tooMuch : {sceneChanged: {epoch: ++epoch, by: 1, ...(setLight ? {setLight} : {moveObject})}});
        } else if (probe) {
            const normal = {x: 0, y: 0, z: 1};
            send({probeResult: {hit: true, position: {x: 2, y: 1, z: 0}, normal, object: hit, epoch}});
        } else {
            send(listScenes ? {sceneList: SCENES} : {ok: {}});
        }
    };
}

/** A page that is connected. */
async function openPage(answer = obeys()) {
    const opened = await openAny(answer);
    await opened.page.waitForFunction(() => window.raybundle?.client.state === 'connected');
    return opened;
}

/** Types a number into a field. */
async function type(page, selector, text) {
    await page.fill(selector, text);
    await page.keyboard.press('Enter');
}

const noteIs = (page, selector, pattern) =>
    page.waitForFunction(
        ([where, what]) => {
            const note = document.querySelector(where);
            return !note.hidden && new RegExp(what).test(note.textContent);
        },
        [selector, pattern],
    );

describe('a number field', () => {
    const LIGHT = '#lights input[type="number"]';

    it('of a light goes back to what is true, and says why', async () => {
        const {page, sent, faults} = await openPage();
        await page.click('#tab-light');
        for (const [text, why] of [['-5', 'Enter 0 or more.*stays at 1000 lm'], ['', 'Enter a number'], ['1e12', 'at most 1e9.*stays at 1000 lm']]) {
            await type(page, LIGHT, text);
            await noteIs(page, '#lights .field-note', why);
            assert.equal(await page.inputValue(LIGHT), '1000', text);
        }
        assert.equal(sent.filter(({setLight}) => setLight).length, 1);
        await keepScreenshot(page, 'refused_number');
        await type(page, LIGHT, '700');
        await page.waitForFunction(() => window.raybundle.scene.lights[0].intensity === 700);
        assert.ok(await page.isHidden('#lights .field-note'));
        assert.deepEqual(faults, []);
    });

    it('of an object too; out of the scene it is told, with the way back', async () => {
        const {page} = await openPage();
        await page.click('#objects li:first-child button');
        const x = '[data-place="x"]';
        await type(page, x, '');
        await noteIs(page, '#place-note', 'Enter a number');
        assert.equal(await page.inputValue(x), '1.50');
        await type(page, x, '1e12');
        await page.waitForSelector('.notice.problem');
        assert.equal(await page.inputValue(x), '1.50');
        await type(page, x, '99');
        await noteIs(page, '#place-note', 'table is outside the scene');
        await page.click('#place-note button');
        await page.waitForFunction(() => document.querySelector('[data-place="x"]').value === '1.50');
        assert.ok(await page.isHidden('#place-note'));
        assert.equal(await page.textContent('[data-value="lastChange"]'), 'You put back table');
    });

    it('shows what others do while it has the focus, but not over what is being typed', async () => {
        const {page} = await openPage();
        await page.click('#objects li:first-child button');
        await page.focus('[data-place="x"]');
        const moveBy = (x) =>
            page.evaluate((by) => {
                const {selected, client} = window.raybundle;
                const {x: before, y, z} = selected.transform.translation;
                const transform = {...selected.transform, translation: {x: before + by, y, z}};
                return client.request({moveObject: {object: selected.id, transform}}).answer.then(() => {});
            }, x);
        await moveBy(0.25);
        assert.equal(await page.inputValue('[data-place="x"]'), '1.75');
        await page.keyboard.press('ControlOrMeta+KeyA');
        await page.keyboard.type('3');
        await moveBy(0.25);
        assert.equal(await page.inputValue('[data-place="x"]'), '3');
        await page.keyboard.press('Escape');
        assert.equal(await page.inputValue('[data-place="x"]'), '2.00');
    });
});

describe('the list of scenes', () => {
    const opened = (sent) => sent.filter(({openScene}) => openScene).map(({openScene}) => openScene.name);

    it('does nothing at the scene that is shown, and asks before it takes another from others', async () => {
        const {page, sent} = await openPage(obeys({people: 3}));
        await page.click('#scene-file-list button[title="a.glb"]');
        assert.equal(await page.textContent('#scene-file-state'), 'a.glb is already open.');
        await page.click('#scene-file-list button[title="b.glb"]');
        assert.match(await page.textContent('#scene-file-asked'), /^Open b\.glb\? It replaces the scene for Viewer 2 and Viewer 3, too\.$/);
        await keepScreenshot(page, 'scene_question');
        await page.click('#scene-file-cancel');
        assert.ok(await page.isHidden('#scene-file-question'));
        assert.deepEqual(opened(sent), []);
        await page.click('#scene-file-list button[title="b.glb"]');
        await page.click('#scene-file-open');
        await page.waitForFunction(() => document.getElementById('scene-file-state').textContent === 'Opening b.glb.');
        assert.deepEqual(opened(sent), ['b.glb']);
    });

    it('opens at once for who is alone', async () => {
        const {page, sent} = await openPage();
        await page.click('#scene-file-list button[title="b.glb"]');
        await page.waitForFunction(() => document.getElementById('scene-file-state').textContent === 'Opening b.glb.');
        assert.deepEqual(opened(sent), ['b.glb']);
    });
});

describe('undo', () => {
    it('and what can be compared with end where the server knows nothing of the changes', async () => {
        const obey = obeys();
        const {page} = await openPage((request, send, close) => {
            obey(request, send);
            if (request.pointAt) {
                close(1001);
            }
        });
        await page.click('#objects li:first-child button');
        await type(page, '[data-place="x"]', '2');
        await page.waitForFunction(() => !document.getElementById('undo').disabled);
        await page.waitForSelector('#earlier-epoch option[value="0"]', {state: 'attached'});
        await page.evaluate(() => window.raybundle.client.send({pointAt: {position: {x: 0, y: 0, z: 0}}}));
        await page.waitForFunction(() => window.raybundle.client.state === 'reconnecting');
        await page.waitForFunction(() => window.raybundle.client.state === 'connected');
        assert.ok(await page.isDisabled('#undo'));
        assert.equal(await page.textContent('#earlier-epoch'), 'nothing has changed yet');
        assert.equal(await page.textContent('[data-value="lastChange"]'), '');
    });
});

describe('a double click', () => {
    const dblclick = async (page) => {
        await page.locator('#picture').dblclick({position: {x: 500, y: 400}});
        await page.waitForFunction(() => window.raybundle.view.target.z === 0);
        await page.waitForFunction(() => !window.raybundle.camera.moving);
        return page.evaluate(() => window.raybundle.selected?.name ?? null);
    };

    it('goes there, and leaves selected what was', async () => {
        const {page} = await openPage();
        assert.equal(await dblclick(page), null);
        await page.keyboard.press('Home');
        await page.waitForFunction(() => window.raybundle.view.target.z === 2);
        await page.click('#objects li:nth-child(2) button');
        assert.equal(await dblclick(page), 'chair');
    });
});

describe('a comparison', () => {
    it('is wiped by the whole line, and ends with a word, and the way back', async () => {
        const {page, faults} = await openPage();
        await page.click('#tab-review');
        await page.evaluate(() => {
            const app = window.raybundle;
            app.frame = {epoch: 0, exposure: 0};
            app.link.shown = app.view;
        });
        await page.click('#keep-picture');
        await page.click('#compare');
        const box = await page.locator('#picture').boundingBox();
        const drag = async (x, y, by) => {
            await page.mouse.move(box.x + x, box.y + y);
            await page.mouse.down();
            await page.mouse.move(box.x + x + by, box.y + y, {steps: 5});
            await page.mouse.up();
        };
        await drag(box.width / 2 + 8, 150, -box.width / 4);
        assert.ok(Math.abs(Number(await page.inputValue('#wipe-at')) - 0.25) < 0.01);
        await drag(box.width / 4, 300, -box.width / 4 + 20);
        assert.ok(await page.isVisible('#wipe'), 'the camera has not moved');
        assert.ok(await page.isHidden('#wipe-before'), 'there is no room for its name');
        await drag(box.width / 2, 300, 60);
        assert.ok(await page.isHidden('#wipe'));
        await page.click('.notice:has-text("comparison is over") button:has-text("Compare again")');
        assert.ok(await page.isVisible('#wipe'));
        assert.deepEqual(faults, []);
    });
});

describe('in Orbit', () => {
    it('who is inside looks around, and circles around what F shows', async () => {
        const {page} = await openPage();
        const view = () => page.evaluate(() => window.raybundle.view);
        const drag = async () => {
            await page.mouse.move(600, 600);
            await page.mouse.down();
            await page.mouse.move(700, 620, {steps: 5});
            await page.mouse.up();
        };
        const outside = await view();
        await drag();
        assert.deepEqual((await view()).target, outside.target);
        await page.evaluate(() => {
            const app = window.raybundle;
            app.view = {...app.view, eye: {x: 3, y: 1.6, z: 4}, target: {x: 1, y: 1, z: 1}};
        });
        await drag();
        const {eye, target} = await view();
        assert.deepEqual(eye, {x: 3, y: 1.6, z: 4});
        assert.notEqual(target.x, 1);
        await page.evaluate(() => window.raybundle.select(1));
        await page.keyboard.press('KeyF');
        const middle = {x: 1.5, y: 0.5, z: 1.5};
        await page.waitForFunction(() => window.raybundle.view.target.x === 1.5 && !window.raybundle.camera.moving);
        const there = await view();
        await page.keyboard.press('Escape');
        await drag();
        const after = await view();
        assert.deepEqual(after.target, middle);
        assert.notDeepEqual(after.eye, there.eye);
    });

    it('? shows the keys', async () => {
        const {page} = await openPage();
        await page.click('#panel-toggle');
        await page.focus('#picture');
        await page.keyboard.press('?');
        assert.ok(await page.isVisible('#keys'));
        await page.keyboard.press('?');
        assert.ok(await page.isHidden('#keys'));
    });
});

describe('notices', () => {
    it('cover neither the hint nor what is said of the connection', async () => {
        const {page} = await openPage();
        const apart = (selector) =>
            page.evaluate((other) => {
                const a = document.querySelector('.notice').getBoundingClientRect();
                const b = document.querySelector(other).getBoundingClientRect();
                return b.width > 0 && (a.top >= b.bottom || a.bottom <= b.top || a.left >= b.right);
            }, selector);
        await page.evaluate(() => {
            const app = window.raybundle;
            app.dispatchEvent(new CustomEvent('picture', {detail: {}}));
            app.status.notify('Something has happened that takes a line or two to tell.');
        });
        assert.ok(await apart('#hint'));
        await page.evaluate(() => {
            const change = {state: 'reconnecting', reason: '', code: '', retryAt: 0};
            window.raybundle.status.show(change, true);
        });
        assert.ok(await apart('#banner'));
    });
});
