// SPDX-License-Identifier: Apache-2.0
// The file's animations in the page: played, wound and looped for everybody, one step of undo each.

import assert from 'node:assert/strict';
import {describe, it} from 'node:test';

import {keepScreenshot} from './browser.mjs';
import {fakePages} from './fake_page.mjs';
import {WELCOME} from './fake_server.mjs';

const openPage = fakePages();
const [object] = WELCOME.scene.objects;

/** A server that plays "door": it says what it has been asked for, and one step of it. */
function door() {
    const state = {animation: 'door', playing: false, seconds: 0, speed: 1, loop: false};
    const animations = [{name: 'door', seconds: 2, objects: [object.id], lights: [], materials: [], state: {...state}}];
    let epoch = 0;
    let firstEpoch = 1;
    const tell = (/** @type {any} */ send, /** @type {boolean} */ final) => {
        const moveObject = {object: object.id, transform: {translation: {x: state.seconds, y: 0, z: 0}}, final};
        const animation = {animation: 'door', seconds: state.seconds, firstEpoch};
        send({sceneChanged: {epoch: ++epoch, by: 1, byName: 'me', moveObject, animation}}, false);
    };
    const answer = (/** @type {any} */ request, /** @type {any} */ send) => {
        const {hello, playAnimation} = request;
        if (hello) {
            send({welcome: {...WELCOME, scene: {...WELCOME.scene, animations}}});
        } else if (playAnimation) {
            Object.assign(state, playAnimation);
            send({animationChanged: {state: {...state}, by: 1, byName: 'me'}});
            if (state.playing) {
                state.seconds = 0.75;
                tell(send, false);
            } else if (playAnimation.seconds !== undefined) {
                firstEpoch = epoch + 1;
                tell(send, true);
            }
        } else {
            send({ok: {}});
        }
    };
    return {state, answer, tell};
}

const asked = (/** @type {any[]} */ sent) => sent.flatMap(({playAnimation}) => playAnimation ?? []);

describe('animations', () => {
    it('are played, paused, wound and looped', async () => {
        const {state, answer} = door();
        const {page, sent, faults} = await openPage(answer, {colorScheme: 'dark'});
        await page.waitForFunction(() => window.raybundle.client.state === 'connected');
        assert.equal(await page.textContent('#animations b'), 'door');
        assert.equal(await page.textContent('#animations output'), '0.00 of 2.00 s');
        await page.getByRole('button', {name: 'Play door'}).click();
        await page.waitForFunction(() => document.querySelector('#animations output')?.textContent === '0.75 of 2.00 s');
        await page.getByLabel('Loop door').check();
        await page.waitForFunction(() => window.raybundle.scene.animation('door').state.loop);
        await keepScreenshot(page, 'animations_dark');
        await page.getByRole('button', {name: 'Pause door'}).click();
        await page.getByRole('button', {name: 'Play door'}).waitFor();
        await page.getByLabel('door, time').fill('1.5');
        await page.waitForFunction(() => window.raybundle.scene.objects[0].transform.translation.x === 1.5);
        assert.deepEqual(asked(sent), [
            {animation: 'door', playing: true},
            {animation: 'door', loop: true},
            {animation: 'door', playing: false},
            {animation: 'door', playing: false, seconds: 1.5},
        ]);
        await page.click('#undo');
        await page.waitForFunction(() => window.raybundle.scene.objects[0].transform.translation.x === 0.75);
        await page.click('#undo');
        await page.waitForFunction(() => window.raybundle.scene.objects[0].transform.translation.x === 0);
        assert.equal(state.playing, false);
        assert.deepEqual(faults, []);
    });

    it('are one row of what has been changed, and only shown to those who may not edit', async () => {
        const {answer} = door();
        const {page, faults} = await openPage(answer, {colorScheme: 'light', viewport: {width: 360, height: 740}});
        await page.waitForFunction(() => window.raybundle.client.state === 'connected');
        await page.evaluate(() => window.raybundle.ask({playAnimation: {animation: 'door', playing: false, seconds: 2}}));
        await page.waitForFunction(() => document.querySelector('#changes li')?.textContent.includes('played door to 2.00'));
        assert.equal(await page.locator('#changes li').count(), 1);
        await page.click('#panel-toggle');
        await page.locator('#animations').scrollIntoViewIfNeeded();
        await keepScreenshot(page, 'animations_phone');
        assert.deepEqual(faults, []);
        const viewer = await openPage((/** @type {any} */ request, /** @type {any} */ send) =>
            answer(request, (/** @type {any} */ message, /** @type {any} */ reply) =>
                send(message.welcome ? {welcome: {...message.welcome, role: 'VIEWER'}} : message, reply)));
        await viewer.page.waitForFunction(() => window.raybundle.client.state === 'connected');
        assert.ok(await viewer.page.getByLabel('door, time').isDisabled());
        assert.ok(await viewer.page.getByRole('button', {name: 'Play door'}).isDisabled());
    });

    it('are not spoken of where the file has none', async () => {
        const {page} = await openPage(({hello}, send) => send(hello ? {welcome: WELCOME} : {ok: {}}));
        await page.waitForFunction(() => window.raybundle.client.state === 'connected');
        assert.ok(await page.isHidden('#animations-part'));
    });
});
