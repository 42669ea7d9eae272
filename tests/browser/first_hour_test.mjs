// SPDX-License-Identifier: Apache-2.0
// What somebody stumbles over in his first hour: where one stands, what is awaited, and whose numbers these are.

import assert from 'node:assert/strict';
import {describe, it} from 'node:test';

import {keepScreenshot} from './browser.mjs';
import {fakePages} from './fake_page.mjs';
import {WELCOME} from './fake_server.mjs';

const openPage = fakePages();
const CONNECTED = () => window.raybundle.client.state === 'connected';
const HISTORY = {changeHistory: {changes: []}};

/** Answers as a server does, a few of its requests otherwise. */
const server = (special = {}, welcome = WELCOME) => (request, send, close) => {
    const name = Object.keys(request).find((key) => key !== 'id') ?? '';
    const answers = {hello: {welcome}, listChanges: HISTORY, ...special};
    const answer = answers[name] ?? {ok: {}};
    const body = typeof answer === 'function' ? answer(request, send, close) : answer;
    if (body) {
        send(body);
    }
};

/** Nothing is anywhere near, but a floor straight below. */
const mapWith = (floor) => ({
    walkMap: {
        origin: {x: -1, y: 4, z: 5}, cell: 0.1, layer: 0.05, columns: 64, layers: 64, floor,
        occupied: Buffer.alloc(8 * 64 * 64).toString('base64'),
    },
});

describe('a floor', () => {
    const text = (page) => page.textContent('[data-value="eyeHeight"]');

    it('on which one stands is that below the eye, not that of the cellar', async () => {
        const scene = {...WELCOME.scene, cameras: [{...WELCOME.scene.cameras[0], eye: {x: 2, y: 6.4, z: 8}}]};
        const {page} = await openPage(server({getWalkMap: mapWith(3.2)}, {...WELCOME, scene}));
        await page.waitForFunction(CONNECTED);
        await page.click('[data-mode="walk"]');
        await page.waitForFunction(() => document.querySelector('[data-value="eyeHeight"]').textContent === '3.20 m');
        await page.keyboard.press('KeyH');
        await page.waitForFunction(() => Math.abs(window.raybundle.view.eye.y - 4.8) < 1e-6);
        assert.equal(await text(page), '1.60 m');
    });

    it('is where the plan is cut 1.2 m above', async () => {
        const bounds = {min: {x: 0, y: -3, z: 0}, max: {x: 9, y: 9, z: 9}};
        const scene = {...WELCOME.scene, bounds};
        scene.cameras = [{...WELCOME.scene.cameras[0], eye: {x: 2, y: 3.5, z: 8}}];
        const {page} = await openPage(server({getWalkMap: mapWith(3.2)}, {...WELCOME, scene}));
        await page.waitForFunction(CONNECTED);
        await page.waitForFunction(() => window.raybundleParts.collisions.floorUnder(window.raybundle.view.eye) === 3.2);
        await page.click('#plans-details summary');
        await page.click('#plans button');
        await page.waitForFunction(() => {
            const {eye, near} = window.raybundle.view;
            return near > 0 && Math.abs(eye.y - near - 4.4) < 1e-3;
        });
    });
});

describe('who walks', () => {
    it('has no height in a plan, and has it again behind it', async () => {
        const {page} = await openPage(server({getWalkMap: mapWith(0)}), {hasTouch: true, isMobile: true});
        await page.waitForFunction(CONNECTED);
        await page.click('[data-mode="walk"]');
        assert.ok(await page.isVisible('#eye') && await page.isVisible('#stick'));
        await page.click('#plans-details summary');
        await page.click('#plans button');
        await page.waitForFunction(() => window.raybundle.view.near > 0);
        assert.ok(await page.isHidden('#eye') && await page.isHidden('#stick'));
        await page.keyboard.press('KeyH');
        assert.ok(await page.evaluate(() => window.raybundle.view.near > 0), 'nobody stands in a plan');
        await page.click('#leave-plan');
        await page.waitForSelector('#eye', {state: 'visible'});
    });

    it('and stands up from high above looks ahead, who bends looks on', async () => {
        const [camera] = WELCOME.scene.cameras;
        const high = {...camera, eye: {x: 2, y: 9, z: 8}, target: {x: 2, y: 3, z: 0}};
        const scene = {...WELCOME.scene, cameras: [high, camera]};
        const {page} = await openPage(server({getWalkMap: mapWith(0)}, {...WELCOME, scene}));
        await page.waitForFunction(CONNECTED);
        await page.waitForFunction(() => window.raybundleParts.collisions.floorUnder(window.raybundle.view.eye) === 0);
        await page.keyboard.press('KeyH');
        await page.waitForFunction(() => Math.abs(window.raybundle.view.eye.y - 1.6) < 1e-6);
        assert.ok(await page.evaluate(() => Math.abs(window.raybundle.view.target.y - 1.6) < 1e-6));
        await page.evaluate(() => {
            const {view, camera: control} = window.raybundle;
            control.set({...view, eye: {...view.eye, y: 1}, target: {...view.target, y: 0}});
        });
        await page.keyboard.press('KeyH');
        await page.waitForFunction(() => Math.abs(window.raybundle.view.eye.y - 1.6) < 1e-6);
        assert.ok(await page.evaluate(() => window.raybundle.view.target.y < 1));
    });
});

describe('a field of luminaires', () => {
    it('is refused with its reason where the server has no folder for photometric files', async () => {
        const {page} = await openPage(server());
        await page.waitForFunction(CONNECTED);
        await page.click('#tab-light');
        await page.click('#add-luminaire summary');
        assert.match(await page.innerText('#add-luminaire'), /--scenes FOLDER/);
        assert.ok(await page.isHidden('#upload-photometry') && await page.isHidden('#luminaire-none'));
    });

    it('has room for its numbers beside their words', async () => {
        const {page} = await openPage(server({}, {...WELCOME, canOpenScenes: true}), {viewport: {width: 1100, height: 900}});
        await page.waitForFunction(CONNECTED);
        await page.click('#tab-light');
        await page.evaluate(() => {
            document.getElementById('add-luminaire').open = true;
            document.getElementById('luminaire-fields').hidden = false;
            document.getElementById('luminaire-spacing').value = '2.125';
        });
        await keepScreenshot(page, 'luminaire_field');
        for (const id of ['columns', 'rows', 'spacing']) {
            const room = await page.locator(`#luminaire-${id}`).evaluate((input) => input.clientWidth);
            assert.ok(room >= 60, `${id}: ${room} pixels`);
        }
    });
});

describe('what is awaited', () => {
    it('after a click is marked where it was, until the answer is there', async () => {
        const answers = [];
        const {page} = await openPage(server({
            probe: (_, send) => {
                answers.push(() => send({probeResult: {hit: true, object: 1, material: 1}}));
            },
        }));
        await page.waitForFunction(CONNECTED);
        await page.click('#picture', {position: {x: 300, y: 200}});
        await page.waitForSelector('.asked-at');
        const {x, y, width} = await page.locator('.asked-at').boundingBox();
        const picture = await page.locator('#picture').boundingBox();
        assert.ok(Math.abs(x + width / 2 - picture.x - 300) < 2 && Math.abs(y + width / 2 - picture.y - 200) < 2);
        await keepScreenshot(page, 'asked_at');
        answers.forEach((answer) => answer());
        await page.waitForSelector('.asked-at', {state: 'detached'});
        assert.equal(await page.textContent('#picked-material'), 'paint');
        await page.click('#deselect');
        assert.ok(await page.isHidden('#picked'), 'of what is selected no more');
    });

    it('of the folder of scenes is not told to be empty before the server has said so', async () => {
        let answer = () => {};
        const {page} = await openPage(server({
            listScenes: (_, send) => {
                answer = () => send({sceneList: {scenes: [], current: '', maxUploadBytes: 0}});
            },
        }, {...WELCOME, canOpenScenes: true}));
        await page.waitForSelector('#scene-files', {state: 'visible'});
        assert.ok(await page.isHidden('#scene-files-none'));
        answer();
        await page.waitForSelector('#scene-files-none', {state: 'visible'});
    });
});

describe('keys', () => {
    it('mean the same after a tab or a switch has been clicked, and nothing to who writes', async () => {
        const {page} = await openPage(server());
        await page.waitForFunction(CONNECTED);
        const eye = () => page.evaluate(() => ({...window.raybundle.view.eye}));
        // Polled once a display frame, in which the eye makes one step as long as it walks.
        const rests = async () => {
            await page.evaluate(() => delete window.eyeBefore);
            await page.waitForFunction(() => {
                const {x, z} = window.raybundle.view.eye;
                const before = window.eyeBefore;
                window.eyeBefore = {x, z};
                return before?.x === x && before?.z === z;
            });
        };
        const walks = async () => {
            const before = await eye();
            await page.keyboard.down('w');
            await page.waitForFunction(({x, z}) => {
                const now = window.raybundle.view.eye;
                return now.x !== x || now.z !== z;
            }, before);
            await page.keyboard.up('w');
            await rests();
        };
        await page.getByRole('tab', {name: 'Light'}).click();
        await walks();
        await page.keyboard.press('?');
        await page.waitForSelector('#help[open]');
        await page.getByRole('tab', {name: 'Scene'}).click();
        await page.focus('#share');
        await walks();
        await page.focus('#viewpoint-name');
        const before = await eye();
        await page.keyboard.type('wasd?');
        await rests();
        assert.deepEqual(await eye(), before);
        assert.equal(await page.inputValue('#viewpoint-name'), 'wasd?');
        assert.ok(await page.locator('#help[open]').count(), 'typing closes no list');
    });
});

describe('a scene that is opened', () => {
    const opening = (by, stage) => ({replyTo: undefined, sceneOpening: {name: 'hall.glb', by, byName: by ? 'Ben' : '', stage, reason: ''}});

    it('is told of alike everywhere, also once the connection has come back', async () => {
        let say = (_body) => {};
        let end = (_code) => {};
        let hellos = 0;
        const {page} = await openPage(server({
            hello: (_, send, close) => {
                say = send;
                end = close;
                return ++hellos > 1 ? opening(0, 'COMPILING') : {welcome: {...WELCOME, canOpenScenes: true}};
            },
            listScenes: {sceneList: {scenes: [{name: 'hall.glb', bytes: 1}], current: 'room.glb', maxUploadBytes: 0}},
        }));
        await page.waitForSelector('#scene-files', {state: 'visible'});
        const card = () => page.textContent('#preparing-text');
        for (const stage of ['READING', 'COMPILING', 'READY']) {
            say(opening(7, stage));
        }
        await page.waitForFunction(() => document.getElementById('preparing-text').textContent.includes('3 of 3'));
        assert.equal(await page.textContent('#scene-file-state'), await card());
        end(1012);
        await page.waitForFunction(() => document.getElementById('connection-text').textContent === 'Preparing');
        // The card alone tells it then.
        await page.waitForFunction(() => document.getElementById('scene-file-state').textContent === '');
        assert.match(await card(), /^The server is preparing hall\.glb \(3 of 3/);
        await keepScreenshot(page, 'opening_again');
    });

    it('knows nothing of the material that was clicked in the one before', async () => {
        let say = (_body) => {};
        let scenes = 0;
        const other = {...WELCOME, scene: {...WELCOME.scene, name: 'hall', materials: []}};
        let end = (_code) => {};
        const {page} = await openPage(server({
            hello: (_, send, close) => {
                end = close;
                return {welcome: ++scenes > 1 ? other : WELCOME};
            },
            probe: {probeResult: {hit: true, object: 0, material: 1}},
        }));
        await page.waitForFunction(CONNECTED);
        await page.click('#picture', {position: {x: 300, y: 200}});
        await page.waitForSelector('#picked', {state: 'visible'});
        end(1012);
        await page.waitForFunction(() => document.getElementById('scene-name').textContent === 'Hall');
        assert.ok(await page.isHidden('#picked'));
    });
});

describe('what the page shows', () => {
    it('says where a scene has the size of no building', async () => {
        const bounds = {min: {x: 6792, y: -66, z: -11130}, max: {x: 13275, y: 2131, z: -1135}};
        const {page} = await openPage(server({}, {...WELCOME, scene: {...WELCOME.scene, bounds}}));
        await page.waitForSelector('#size-hint', {state: 'visible'});
        assert.match(await page.textContent('#size-hint'), /^This scene is 9\u202f995 m large and 2\u202f197 m high\. If it was drawn/);
        await keepScreenshot(page, 'size_hint');
    });

    it('says nothing of the size of a house, nor of lamps where it has some', async () => {
        const {page} = await openPage(server());
        await page.waitForFunction(CONNECTED);
        assert.ok(await page.isHidden('#size-hint'));
        await page.click('#tab-light');
        assert.ok(await page.isHidden('#lights-none'));
    });

    it('says that the file has no lamps, and what lights it', async () => {
        const sky = {id: 1, name: 'sky', kind: 'SKY', intensity: 1000, unit: 'CD_PER_M2', colour: {x: 1, y: 1, z: 1}, on: true};
        const {page} = await openPage(server({}, {...WELCOME, scene: {...WELCOME.scene, lights: [sky]}}));
        await page.waitForFunction(CONNECTED);
        await page.click('#tab-light');
        assert.match(await page.textContent('#lights-none'), /^The file has no lamps: the scene has daylight alone\./);
        await keepScreenshot(page, 'no_lamps');
    });

    it('has the legend of the picture that is there, not of the one that is coming', async () => {
        const {page} = await openPage(server());
        await page.waitForFunction(CONNECTED);
        const title = (frame) =>
            page.evaluate((header) => {
                const app = window.raybundle;
                app.frame = header;
                app.dispatchEvent(new CustomEvent('picture', {detail: header}));
                return document.getElementById('legend-title').textContent;
            }, frame);
        await page.selectOption('#display-mode', 'FALSE_LUMINANCE');
        assert.equal(await title({scaleMaximum: 500, scaleIlluminance: true}), 'Illuminance, lx');
        assert.equal(await title({scaleMaximum: 500, scaleIlluminance: false}), 'Luminance, cd/m²');
        await page.selectOption('#display-mode', 'PHOTO');
        assert.equal(await title({scaleMaximum: 200, scaleIlluminance: true}), 'Illuminance, lx', 'it is still there');
    });

    it('puts an object back to where the file has it, whoever has moved it before', async () => {
        const moved = {translation: {x: 0.5, y: 0, z: 0}, rotation: {x: 0, y: 0, z: 0, w: 1}, scale: {x: 1, y: 1, z: 1}};
        const loaded = {...moved, translation: {x: -0.25, y: 0, z: 0}};
        const object = {...WELCOME.scene.objects[0], transform: moved};
        const change = {
            epoch: 1, by: 4, byName: 'Ben', atMs: 1,
            moveObject: {object: 1, transform: moved, final: true}, objectBefore: {object: 1, transform: loaded},
        };
        const {page, sent} = await openPage(server(
            {listChanges: {changeHistory: {changes: [change]}}},
            {...WELCOME, epoch: 1, scene: {...WELCOME.scene, objects: [object]}},
        ));
        await page.waitForFunction(() => window.raybundle.scene?.object(1)?.loaded);
        await page.click('#objects button');
        await page.click('#put-back');
        await page.waitForFunction(() => window.raybundle.selected.transform.translation.x === -0.25);
        assert.equal(sent.findLast(({moveObject}) => moveObject)?.moveObject.transform.translation.x, -0.25);
    });

    it('is told in shares of its size in the file, also where its first change is no longer listed', async () => {
        const sized = (/** @type {number} */ share) =>
            ({object: 1, transform: {translation: {x: 0, y: 0, z: 0}, rotation: {x: 0, y: 0, z: 0, w: 1}, scale: {x: share, y: share, z: share}}});
        const first = {epoch: 1, by: 4, byName: 'Ben', atMs: 1, moveObject: sized(2), objectBefore: sized(1)};
        const later = Array.from({length: 1000}, (_, i) => ({
            epoch: 2 + i, by: 4, byName: 'Ben', atMs: 2 + i, setLight: {light: 1, intensity: 10 + i}, lightBefore: {light: 1, intensity: 9 + i},
        }));
        const changes = [first, ...later];
        const object = {...WELCOME.scene.objects[0], transform: sized(2).transform};
        const {page} = await openPage(server(
            {
                listChanges: {changeHistory: {changes}},
                moveObject: ({moveObject}) => ({sceneChanged: {epoch: 1002, by: 1, moveObject, objectBefore: sized(2)}}),
            },
            {...WELCOME, epoch: 1001, scene: {...WELCOME.scene, objects: [object]}},
        ));
        await page.waitForFunction(() => window.raybundle.scene?.object(1)?.loaded);
        await page.evaluate((moveObject) => window.raybundle.client.request({moveObject}).answer, sized(3));
        await page.waitForFunction(() => document.querySelector('#changes li').textContent.endsWith('resized table: 200 → 300 %'));
    });
});
