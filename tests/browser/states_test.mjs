// SPDX-License-Identifier: Apache-2.0
// What the page says while it has no server, or not the one it wants; lights and materials; and that
// it can be used by everybody.

import assert from 'node:assert/strict';
import {describe, it} from 'node:test';

import {keepScreenshot} from './browser.mjs';
import {fakePages} from './fake_page.mjs';
import {WELCOME} from './fake_server.mjs';

const openPage = fakePages();

/** Refuses the first hello, welcomes later ones. */
const refuseOnce = (code, message, closeCode) => {
    let refused = false;
    return (request, send, close) => {
        if (!request.hello) {
            send({ok: {}});
        } else if (refused) {
            send({welcome: WELCOME});
        } else {
            refused = true;
            send({error: {code, message}});
            if (closeCode) {
                close(closeCode);
            }
        }
    };
};

/** Two frames of the server's encoder, 161x121: left (200, 60, 30) and right (40, 180, 90); then left (200, 60, 40). */
const VIDEO = [
    'gkmDQkAKAAeEBjgkHBhAAAGQSDEP3/e0e8YUpndfBhXPDKG305hsHXtAAGs8D7g9UxORgadqbVVeZxrcd5tvqmzk6iz5yWcqIZF65+dp3Pe6S/z+38F5ln8ugkg8d+99QDUMQpisIT9tS4wonSs208j7RbTrzKPrLEn/6QR7T1Do+tyqxIpbwTUQoqHtY2tjU+AA',
    'hgBAkpgwUSNAcBgGAwGqwGAwUyK7AAAAAANwAAADleVhGOVbJE3s6ZfIxxE9dZk3tcBfIxxaRjiICT6JvZx5WRjiINf/kj/4r/+K//iv/4r+sHzd+K//iv6wfN34r/+K/rB83fivlCZTCq4furkUrYU/IqvgAA==',
];

describe('video', () => {
    it('is decoded by the browser, in the right colours, and goes on with a key frame after a fault', async () => {
        const {page} = await openPage((request, send) => send(request.hello ? {welcome: WELCOME} : {ok: {}}));
        const seen = await page.evaluate(async (frames) => {
            const {VideoStream, decodesVideo} = await import(String(new URL('net/video_stream.js', location.href)));
            if (!(await decodesVideo())) {
                return null;
            }
            const stream = new VideoStream();
            const bytes = frames.map((text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)));
            const show = async (/** @type {number} */ frame) => {
                const image = await stream.decode(bytes[frame], frame === 0);
                const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
                context.drawImage(image, 0, 0);
                const at = (/** @type {number} */ x) => [...context.getImageData(x, 60, 1, 1).data].slice(0, 3);
                return [image.width, image.height, ...at(20), ...at(140)];
            };
            const pictures = [await show(0), await show(1)];
            const refused = await stream.decode(new Uint8Array([1, 2, 3]), false).then(() => false, () => true);
            const broken = refused && !stream.whole && !stream.failed;
            return {pictures, broken, again: await show(0)};
        }, VIDEO);
        assert.ok(seen, 'Chromium decodes VP9');
        const near = (/** @type {number[]} */ picture, /** @type {number[]} */ expected) =>
            picture.forEach((value, i) => assert.ok(Math.abs(value - expected[i]) <= (i < 2 ? 0 : 5), `${picture}`));
        near(seen.pictures[0], [161, 121, 200, 60, 30, 40, 180, 90]);
        near(seen.pictures[1], [161, 121, 200, 60, 40, 40, 180, 90]);
        near(seen.again, [161, 121, 200, 60, 30, 40, 180, 90]);
        assert.ok(seen.broken);
    });
});

describe('the state of the light', () => {
    it('is green when the number is good, and no sooner', async () => {
        const {page} = await openPage((request, send) => send(request.hello ? {welcome: WELCOME} : {ok: {}}));
        await page.waitForFunction(() => window.raybundle?.client.state === 'connected');
        const shown = async (/** @type {number} */ error, /** @type {number} */ errorHigh, /** @type {string} */ end) => {
            const figures = {relativeError: error, errorLow: error / 2, errorHigh};
            const solution = {epoch: 0, iterations: 8, iterationsPerSecond: 8, settled: 1, ...figures};
            await page.evaluate((detail) => window.raybundle.client.dispatchEvent(new CustomEvent('solution', {detail})), solution);
            await page.waitForFunction(
                (text) => document.querySelector('[data-value="errorInterval"]').textContent.endsWith(text),
                end,
            );
            const state = page.locator('#summary-state');
            return [await state.getAttribute('data-settled'), await state.textContent(),
                await page.locator('#settled').evaluate((bar) => bar.classList.contains('done'))];
        };
        assert.deepEqual(await shown(0.2, 0.31, '31 %'), ['rough', 'First result, still noisy: error up to 31 %', false]);
        assert.deepEqual(await shown(0.08, 0.12, '12 %'), ['rough', 'First result, still noisy: error up to 12 %', false]);
        assert.deepEqual(await shown(0.012, 0.02, '2.0 %'), ['yes', 'Light has settled', true]);
    });
});

describe('the page without its server', () => {
    it('asks for a token where its own is refused, and comes in with it', async () => {
        const answer = refuseOnce('UNAUTHENTICATED', 'hello.token: wrong');
        const {page, sent} = await openPage(answer);
        await page.waitForSelector('#token-form', {state: 'visible'});
        assert.match(await page.textContent('#banner-title'), /access token/);
        await keepScreenshot(page, 'token');
        await page.fill('#token', 'secret');
        await page.click('#token-form button');
        await page.waitForSelector('#banner', {state: 'hidden'});
        assert.equal(sent.filter(({hello}) => hello).at(-1).hello.token, 'secret');
        assert.ok(!page.url().includes('secret'), 'the token is in the address');
    });

    it('says that the server is full, and comes in by itself when there is room', async () => {
        const answer = refuseOnce('RESOURCE_EXHAUSTED', 'the server is full', 1013);
        const {page} = await openPage(answer);
        await page.waitForFunction(() => {
            const [title, text] = ['banner-title', 'banner-text'].map(
                (id) => document.getElementById(id).textContent,
            );
            return title === 'The server is full' && /You will be let in when there is room\. (Next attempt|Trying)/.test(text);
        });
        await page.waitForFunction(() => window.raybundle.client.state === 'connected');
    });

    it('comes back to a server that has started anew, and says so', async () => {
        let starts = 0;
        const {page} = await openPage((request, send, close) => {
            if (request.hello) {
                send({welcome: {...WELCOME, epoch: ++starts === 1 ? 3 : 0}});
            } else {
                send({ok: {}});
                if (request.probe) {
                    close(1001);
                }
            }
        });
        await page.waitForFunction(() => window.raybundle.client.state === 'connected');
        const x = await page.evaluate(() => {
            const app = window.raybundle;
            app.select(1);
            app.view = {...app.view, eye: {...app.view.eye, x: 3}};
            app.ask({probe: {pixel: {x: 0, y: 0}}});
            return app.view.eye.x;
        });
        await page.waitForFunction(() => window.raybundle.client.state === 'reconnecting');
        await page.waitForFunction(() => window.raybundle.client.state === 'connected');
        const after = await page.evaluate(() => [window.raybundle.view.eye.x, window.raybundle.selected?.name]);
        assert.deepEqual(after, [x, 'table']);
        assert.match(await page.textContent('#notices'), /The server restarted\. Unsaved changes and pins were lost\./);
    });

    it('says that the versions differ', async () => {
        const text = 'hello.protocol: client speaks 1.0, server speaks 2.0';
        const {page} = await openPage(refuseOnce('UNIMPLEMENTED', text, 1002));
        await page.waitForSelector('#banner', {state: 'visible'});
        await page.waitForFunction(() => window.raybundle.client.state === 'refused');
        assert.match(await page.textContent('#banner-title'), /different versions/);
        assert.equal(await page.textContent('#banner-retry'), 'Load the page again');
    });

    it('says that the server gets ready, where that takes its time', async () => {
        const {page} = await openPage(() => {});
        await page.waitForFunction(
            () => document.getElementById('banner-text').textContent.includes('is preparing the scene'),
        );
        assert.equal(await page.textContent('#banner-title'), 'Connecting to the server');
    });

    it('says how far the server is with the scene, before the welcome', async () => {
        const sceneOpening = {name: 'a.glb', by: 0, byName: '', stage: 'COMPILING', reason: ''};
        const {page} = await openPage((request, send) => {
            if (request.hello) {
                send({replyTo: undefined, sceneOpening});
            }
        });
        await page.waitForFunction(() =>
            document.getElementById('preparing-text').textContent === 'The server is preparing a.glb (3 of 3: preparing light).',
        );
        await page.waitForSelector('#banner', {state: 'hidden'});
    });

    it('says that it waits for the first picture, and what draws it', async () => {
        const {page} = await openPage((request, send) =>
            send(request.hello ? {welcome: WELCOME} : {ok: {}}),
        );
        await page.waitForSelector('#preparing', {state: 'visible'});
        assert.equal(await page.textContent('#scene-name'), 'Test room');
        await page.click('#tab-accuracy');
        assert.match(await page.textContent('#renderer'), /without a graphics card.*llvmpipe/);
        const rows = (list) => page.$$eval(`${list} li`, (all) => all.map((row) => row.textContent));
        const way = 'lamp or sky → matt or glossy, 0 or more → eye';
        const cost = 'at most 50 % of the light · 56 bytes a patch';
        assert.deepEqual(await rows('#effects'), [`Blurred reflectionsonglossy: one material is glossy${way}${cost}`]);
        assert.match(await page.getAttribute('#effects .way', 'title'), /L\(D\|G\)\*E/);
        assert.ok(await page.isHidden('#effects-off li'));
        await page.focus('#effects-off-count');
        await page.keyboard.press('Enter');
        await page.waitForSelector('#effects-off li', {state: 'visible'});
        assert.equal(await page.textContent('#effects-off-count'), 'Not needed here: 1');
        assert.deepEqual(await rows('#effects-off'), ['Light of the skyoffsky: no sky is set']);
    });
});

describe('lights and materials', () => {
    /** Carries out every change, as a server does. */
    const obeys = () => {
        let epoch = 0;
        return (request, send) => {
            const {hello, setLight, setMaterial} = request;
            if (setLight || setMaterial) {
                const change = setLight ? {setLight} : {setMaterial};
                send({sceneChanged: {epoch: ++epoch, by: 1, ...change}});
            } else {
                send(hello ? {welcome: WELCOME} : {ok: {}});
            }
        };
    };

    it('are switched, dimmed in the unit of the light, tinted and painted, and undone', async () => {
        const {page, sent, faults} = await openPage(obeys(), {colorScheme: 'light'});
        await page.waitForFunction(() => window.raybundle.client.state === 'connected');
        await page.click('#tab-light');
        const lights = () => sent.flatMap(({setLight}) => (setLight ? [setLight] : []));
        const state = () => page.evaluate(() => window.raybundle.scene.lights[0]);
        await page.click('#lights [role="switch"]');
        await page.waitForFunction(() => !window.raybundle.scene.lights[0].on);
        assert.deepEqual(lights().at(-1), {light: 1, on: false});
        await page.fill('#lights input[type="number"]', '650');
        await page.keyboard.press('Enter');
        await page.waitForFunction(() => window.raybundle.scene.lights[0].intensity === 650);
        assert.equal(await page.textContent('#lights .unit'), 'lm');
        await page.locator('#lights input[type="range"]').nth(1).fill('2700');
        await page.waitForFunction(() => window.raybundle.scene.lights[0].colour.x > 1.2);
        const {colour} = await state();
        assert.ok(colour.x > colour.y && colour.y > colour.z, JSON.stringify(colour));
        const level = 0.2126 * colour.x + 0.7152 * colour.y + 0.0722 * colour.z;
        assert.ok(Math.abs(level - 1) < 1e-6, `luminance ${level}`);
        await page.fill('#materials input[type="color"]', '#ff0000');
        await page.waitForFunction(() => window.raybundle.scene.materials[0].baseColour.x === 1);
        await page.locator('#materials input[type="range"]').first().fill('0.25');
        await page.waitForFunction(() => window.raybundle.scene.materials[0].roughness === 0.25);
        await keepScreenshot(page, 'lights');
        await page.keyboard.press('Control+KeyZ');
        await page.waitForFunction(() => window.raybundle.scene.materials[0].roughness === 0.6);
        await page.click('#tab-scene');
        for (let i = 0; i < 4; ++i) {
            await page.click('#undo');
        }
        await page.waitForFunction(() => {
            const [light] = window.raybundle.scene.lights;
            const [material] = window.raybundle.scene.materials;
            return light.on && light.intensity === 1000 && material.roughness === 0.6;
        });
        assert.deepEqual(faults, []);
    });

    it('stay as they are where the server cannot change them, and the page says so', async () => {
        const {page} = await openPage((request, send) => {
            const {hello, setLight} = request;
            const error = {code: 'UNIMPLEMENTED', message: 'not here'};
            send(setLight ? {error} : hello ? {welcome: WELCOME} : {ok: {}});
        });
        await page.waitForFunction(() => window.raybundle.client.state === 'connected');
        await page.click('#tab-light');
        await page.click('#lights [role="switch"]');
        await page.waitForSelector('#lights-note', {state: 'visible'});
        assert.ok(await page.isChecked('#lights [role="switch"]'));
        assert.ok(await page.isDisabled('#lights [role="switch"]'));
    });

    it('are not offered to who may only look', async () => {
        const welcome = {...WELCOME, role: 'VIEWER'};
        const {page} = await openPage((request, send) => {
            send(request.hello ? {welcome} : {ok: {}});
        });
        await page.waitForFunction(() => window.raybundle.client.state === 'connected');
        await page.click('#tab-light');
        assert.ok(await page.isDisabled('#lights [role="switch"]'));
        await page.click('#tab-scene');
        assert.ok(await page.isHidden('#viewpoint-form'));
    });
});

describe('everybody', () => {
    const welcomes = (request, send) => send(request.hello ? {welcome: WELCOME} : {ok: {}});

    it('reaches everything with the keyboard, and every control has a name', async () => {
        const {page} = await openPage(welcomes);
        await page.waitForFunction(() => window.raybundle.client.state === 'connected');
        await page.focus('#tab-scene');
        for (const id of ['tab-light', 'tab-measure', 'tab-review', 'tab-accuracy']) {
            await page.keyboard.press('ArrowRight');
            assert.equal(await page.evaluate(() => document.activeElement.id), id);
            assert.equal(await page.getAttribute(`#${id}`, 'aria-selected'), 'true');
        }
        const nameless = await page.evaluate(() =>
            [...document.querySelectorAll('button, input, select, textarea, [role="tabpanel"]')]
                .filter((element) => {
                    const labels = [...(element.labels ?? [])].map((label) => label.textContent);
                    const by = element.getAttribute('aria-labelledby');
                    const text = [
                        element.getAttribute('aria-label'),
                        element.tagName === 'BUTTON' ? element.textContent : '',
                        by && document.getElementById(by)?.textContent,
                        ...labels,
                    ];
                    return !text.some((part) => part?.trim());
                })
                .map((element) => element.outerHTML),
        );
        assert.deepEqual(nameless, []);
    });

    for (const colorScheme of /** @type {const} */ (['dark', 'light'])) {
        it(`can read it: contrast of 4.5 at least, ${colorScheme}`, async () => {
            const {page} = await openPage(welcomes, {colorScheme});
            await page.waitForFunction(() => window.raybundle.client.state === 'connected');
            const poor = await page.evaluate(() => {
                const rgb = (/** @type {string} */ text) => text.match(/[\d.]+/g).map(Number);
                const level = ([r, g, b]) => {
                    const [x, y, z] = [r, g, b].map((value) => {
                        const v = value / 255;
                        return v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
                    });
                    return 0.2126 * x + 0.7152 * y + 0.0722 * z;
                };
                const behind = (/** @type {Element | null} */ element) => {
                    for (let e = element; e; e = e.parentElement) {
                        const colour = rgb(getComputedStyle(e).backgroundColor);
                        if ((colour[3] ?? 1) > 0.5) {
                            return colour;
                        }
                    }
                    return [0, 0, 0];
                };
                const found = [];
                for (const tab of document.querySelectorAll('[role="tab"]')) {
                    tab.click();
                    for (const element of document.querySelectorAll('#app *')) {
                        const own = [...element.childNodes].some(
                            (node) => node.nodeType === 3 && node.textContent.trim(),
                        );
                        if (!own || !element.checkVisibility() || element.matches(':disabled, option')) {
                            continue;
                        }
                        const a = level(rgb(getComputedStyle(element).color)) + 0.05;
                        const b = level(behind(element)) + 0.05;
                        const contrast = Math.max(a, b) / Math.min(a, b);
                        if (contrast < 4.5) {
                            found.push(`${contrast.toFixed(2)} ${element.outerHTML.slice(0, 120)}`);
                        }
                    }
                }
                return found;
            });
            assert.deepEqual(poor, []);
        });
    }

    it('who prefers less motion is at the camera at once', async () => {
        const {page} = await openPage(welcomes, {reducedMotion: 'reduce'});
        await page.waitForFunction(() => window.raybundle.client.state === 'connected');
        const eye = await page.evaluate(() => {
            const {scene} = window.raybundle;
            scene.cameras.push({...scene.cameras[0], name: 'up', eye: {x: 2, y: 9, z: 9}});
            window.raybundle.flyTo('up');
            return window.raybundle.view.eye;
        });
        assert.deepEqual(eye, {x: 2, y: 9, z: 9});
    });

    it('fits at 360 pixels, with every tab', async () => {
        const {page} = await openPage(welcomes, {viewport: {width: 360, height: 740}});
        await page.waitForFunction(() => window.raybundle.client.state === 'connected');
        await page.click('#panel-toggle');
        for (const id of ['scene', 'light', 'measure', 'review', 'accuracy']) {
            await page.click(`#tab-${id}`);
            const width = await page.evaluate(() => {
                const {scrollWidth} = document.getElementById('panel');
                return Math.max(document.documentElement.scrollWidth, scrollWidth);
            });
            assert.ok(width <= 360, `${id} is ${width} pixels wide`);
        }
    });
});

describe('walking', () => {
    const welcomes = (request, send) => send(request.hello ? {welcome: WELCOME} : {ok: {}});

    it('by keys goes ahead, gets going and ends softly', async () => {
        const {page} = await openPage(welcomes);
        await page.waitForFunction(() => window.raybundle.client.state === 'connected');
        await page.click('[data-mode="walk"]');
        const z = () => page.evaluate(() => window.raybundle.view.eye.z);
        const start = await z();
        await page.keyboard.down('KeyW');
        await page.waitForFunction((from) => window.raybundle.view.eye.z < from - 0.3, start);
        await page.keyboard.up('KeyW');
        const released = await z();
        await page.waitForFunction((from) => window.raybundle.view.eye.z < from, released);
        await page.waitForTimeout(700);
        const rest = await z();
        await page.waitForTimeout(200);
        assert.equal(await z(), rest);
        await page.keyboard.press('KeyH');
        await page.waitForFunction(() => Math.abs(window.raybundle.view.eye.y - 1.6) < 1e-6);
        assert.equal(await page.textContent('[data-value="eyeHeight"]'), '1.60 m');
    });

    it('by mouse look turns the head while the mouse is held', async () => {
        const {page} = await openPage(welcomes);
        await page.waitForFunction(() => window.raybundle.client.state === 'connected');
        await page.focus('#picture');
        await page.mouse.move(500, 400);
        await page.keyboard.press('KeyL');
        await page.waitForFunction(() => document.pointerLockElement?.id === 'picture');
        const before = await page.evaluate(() => window.raybundle.view);
        await page.mouse.move(600, 400, {steps: 4});
        await page.waitForFunction((from) => window.raybundle.view.target.x > from + 0.1, before.target.x);
        const after = await page.evaluate(() => window.raybundle.view);
        assert.deepEqual(after.eye, before.eye);
    });

    it('by a stick under the thumb', async () => {
        const viewport = {width: 360, height: 740};
        const {page} = await openPage(welcomes, {viewport, hasTouch: true, isMobile: true});
        await page.waitForFunction(() => window.raybundle.client.state === 'connected');
        await page.tap('[data-mode="walk"]');
        await page.waitForSelector('#stick', {state: 'visible'});
        const start = await page.evaluate(() => window.raybundle.view.eye.z);
        const box = await page.locator('#stick').boundingBox();
        await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
        await page.mouse.down();
        await page.mouse.move(box.x + box.width / 2, box.y + 5, {steps: 3});
        await page.waitForFunction((from) => window.raybundle.view.eye.z < from - 0.2, start);
        await page.mouse.up();
    });

    it('by a game controller', async () => {
        const {page} = await openPage(welcomes);
        await page.waitForFunction(() => window.raybundle.client.state === 'connected');
        const start = await page.evaluate(() => {
            const pad = {mapping: 'standard', axes: [0, -1, 0, 0], buttons: []};
            navigator.getGamepads = () => [pad];
            dispatchEvent(new Event('gamepadconnected'));
            return window.raybundle.view.eye.z;
        });
        await page.waitForFunction((from) => window.raybundle.view.eye.z < from - 0.3, start);
    });
});
