// SPDX-License-Identifier: Apache-2.0
// The page by keyboard, by ear and on a phone: where the focus goes, what Escape closes, what is said,
// what fits; and what becomes of files that are dropped on it.

import assert from 'node:assert/strict';
import {describe, it} from 'node:test';

import {keepScreenshot} from './browser.mjs';
import {fakePages} from './fake_page.mjs';
import {WELCOME} from './fake_server.mjs';

const openAny = fakePages();

const PROBE = {
    hit: true,
    position: {x: 2, y: 1, z: 2},
    normal: {x: 0, y: 1, z: 0},
    object: 1,
    patch: 7,
    illuminance: 200,
    luminance: 20,
    relativeError: 0.02,
    epoch: 0,
};
const PIN = {
    pin: 1,
    by: 2,
    byName: 'Eva',
    text: 'glare',
    position: PROBE.position,
    illuminance: 107.639,
    epoch: 0,
    removed: false,
    setAtMs: 0,
    object: 0,
    localPosition: PROBE.position,
};
const SCENES = {scenes: [{name: 'a.glb', bytes: 1, changedAtMs: 0}], current: 'a.glb', maxUploadBytes: 1e6};

/** A server that does what it is asked, as far as the page sees it. */
const obeys =
    (welcome = {}) =>
    (request, send) => {
        const effects = WELCOME.scene.effects.map((effect) => ({...effect, msPerIteration: effect.active ? 2.5 : undefined}));
        const answers = {
            hello: {welcome: {...WELCOME, ...welcome}},
            probe: {probeResult: {...PROBE, position: {...PROBE.position, y: 1 + Math.random() / 1000}}},
            listScenes: {sceneList: SCENES},
            measureEffects: {effectCosts: {effects}},
            removePin: {pinChanged: {...PIN, removed: true}},
        };
        send(answers[Object.keys(request).find((key) => key in answers)] ?? {ok: {}});
    };

/** A page that is connected. */
async function openPage(answer = obeys(), options = {}) {
    const opened = await openAny(answer, options);
    await opened.page.waitForFunction(() => window.raybundle?.client.state === 'connected');
    return opened;
}

/** What has the focus, for people who read a failure. */
const focused = (page) =>
    page.evaluate(() => {
        const {id, ariaLabel, textContent} = document.activeElement;
        return id || ariaLabel || textContent.trim();
    });

const PHONE = {viewport: {width: 360, height: 740}, hasTouch: true, isMobile: true};

/** Everybody in a review; the first is the page's own viewer. */
const crowd = (count) =>
    Array.from({length: count}, (_, i) => ({
        ...WELCOME.scene.cameras[0],
        viewer: i + 1,
        name: `Person ${i + 1}`,
        role: 'EDITOR',
        aspect: 1,
        following: 0,
    }));

/** The same server with so many people. */
const crowded = (count) => (request, send) => {
    obeys()(request, send);
    if (request.hello) {
        send({replyTo: undefined, presence: {viewers: crowd(count)}});
    }
};

describe('by keyboard', () => {
    it('the focus goes through bar, picture, tools and panel, and is seen everywhere', async () => {
        const {page} = await openPage();
        await page.evaluate(() => document.activeElement?.blur());
        const seen = [];
        for (let i = 0; i < 60; ++i) {
            await page.keyboard.press('Tab');
            const stop = await page.evaluate(() => {
                const element = document.activeElement;
                const {outlineStyle, outlineWidth} = getComputedStyle(element);
                const part = element.closest('header, .view, .toolbar, .panel');
                return {
                    what: element.id || element.outerHTML.slice(0, 80),
                    part: part?.className.split(' ')[0] ?? '',
                    ring: outlineStyle !== 'none' && parseFloat(outlineWidth) >= 1,
                };
            });
            if (seen.length > 0 && stop.what === seen[0].what) {
                break;
            }
            seen.push(stop);
        }
        const parts = seen.map(({part}) => part).filter((part, i, all) => part && part !== all[i - 1]);
        assert.deepEqual(parts, ['bar', 'view', 'toolbar', 'panel']);
        assert.deepEqual(seen.filter(({part, ring}) => part && !ring), []);
    });

    it('a measured point is removed though it is measured again each second', async () => {
        const {page} = await openPage();
        await page.focus('#picture');
        await page.keyboard.press('Digit2');
        for (let i = 1; i <= 2; ++i) {
            await page.keyboard.press('Enter');
            await page.waitForFunction((rows) => document.querySelectorAll('#points tbody tr').length === rows, i);
        }
        assert.match(await page.textContent('#announcement'), /^Point 2: 200 lx ± 3\.9 %$/);
        const remove = page.getByRole('button', {name: 'Remove point 1'});
        await remove.focus();
        const {y} = await page.evaluate(() => window.raybundleParts.measuring.points[0].probe.position);
        await page.waitForFunction(
            (before) => window.raybundleParts.measuring.points[0].probe.position.y !== before,
            y,
        );
        assert.equal(await focused(page), 'Remove point 1');
        await page.keyboard.press('Enter');
        assert.equal(await focused(page), 'Remove point 2');
        await page.keyboard.press('Enter');
        assert.equal(await focused(page), 'picture');
    });

    it('rows that come anew keep the focus where it was', async () => {
        const {page} = await openPage(crowded(3));
        await page.click('#tab-review');
        await page.focus('#people [data-follow="3"]');
        await page.keyboard.press('Enter');
        await page.waitForFunction(() => window.raybundleParts.people.following === 3);
        assert.equal(await focused(page), 'Stop following Person 3');
    });

    it('Escape closes what is open, and ends at the picture', async () => {
        const {page} = await openPage();
        await page.focus('#picture');
        await page.keyboard.press('Digit3');
        await page.keyboard.press('Enter');
        await page.waitForSelector('.pin-editor');
        await page.keyboard.press('Tab');
        await page.keyboard.press('Escape');
        await page.waitForSelector('.pin-editor', {state: 'detached'});
        assert.equal(await focused(page), 'picture');
        await page.focus('#tab-review');
        await page.keyboard.press('Escape');
        assert.equal(await focused(page), 'picture');
    });

    it('undo is in reach whatever the panel shows, for who may change things', async () => {
        const {page} = await openPage();
        for (const id of ['light', 'measure', 'review', 'accuracy']) {
            await page.click(`#tab-${id}`);
            assert.ok(await page.isVisible('#undo'), id);
        }
        await page.context().close();
        const looking = await openPage(obeys({role: 'VIEWER'}));
        assert.ok(await looking.page.isHidden('#undo'));
    });
});

describe('the mark in the middle of the picture', () => {
    it('is there for who has come by the keyboard, and says what Enter does', async () => {
        const {page} = await openPage();
        await page.focus('#panel-toggle');
        await page.keyboard.press('Tab');
        assert.equal(await focused(page), 'picture');
        assert.equal(await page.innerText('#aim'), 'Enter selects this');
        await page.keyboard.press('Digit2');
        assert.equal(await page.innerText('#aim'), 'Enter measures here');
        await keepScreenshot(page, 'aim');
        await page.locator('#picture').click({position: {x: 100, y: 300}});
        await page.keyboard.down('KeyW');
        assert.ok(await page.isHidden('#aim'), 'it lies in the way of who walks');
        await page.keyboard.up('KeyW');
        await page.keyboard.press('Enter');
        assert.ok(await page.isVisible('#aim'));
    });
});

describe('by ear', () => {
    it('every control has a name in the accessibility tree, and the countdown is not said each second', async () => {
        const {page} = await openPage(obeys({pins: [PIN]}));
        const session = await page.context().newCDPSession(page);
        const roles = ['button', 'textbox', 'slider', 'checkbox', 'switch', 'combobox', 'spinbutton', 'tab', 'link'];
        for (const id of ['scene', 'light', 'measure', 'review', 'accuracy']) {
            await page.click(`#tab-${id}`);
            const {nodes} = await session.send('Accessibility.getFullAXTree');
            const nameless = nodes.filter(
                ({ignored, role, name}) => !ignored && roles.includes(role?.value) && !name?.value?.trim(),
            );
            assert.deepEqual(nameless.map(({role, description}) => [role, description]), [], id);
        }
        assert.equal(await page.getAttribute('#banner-next', 'aria-live'), 'off');
    });
});

describe('by eye', () => {
    for (const colorScheme of /** @type {const} */ (['dark', 'light'])) {
        it(`fields say what belongs in them as readably as all other text, ${colorScheme}`, async () => {
            const {page} = await openPage(obeys(), {colorScheme});
            const colours = await page.evaluate(() => {
                const hint = getComputedStyle(document.querySelector('.hint')).color;
                const fields = [...document.querySelectorAll('[placeholder]')];
                return [hint, ...fields.map((field) => getComputedStyle(field, '::placeholder').color)];
            });
            assert.equal(new Set(colours).size, 1, colours.join());
        });
    }
});

describe('on a phone', () => {
    it('the name of the scene is readable beside six people', async () => {
        const {page} = await openPage(crowded(6), PHONE);
        await page.waitForSelector('#avatars button');
        await keepScreenshot(page, 'phone_people');
        const {name, end, shown} = await page.evaluate(() => ({
            name: document.getElementById('scene-name').getBoundingClientRect().width,
            end: document.getElementById('panel-toggle').getBoundingClientRect().right,
            shown: [...document.querySelectorAll('#avatars li')].filter((item) => item.checkVisibility()).length,
        }));
        assert.ok(name >= 48 && end <= 360 && shown === 3, JSON.stringify({name, end, shown}));
    });

    it('the tools take two rows', async () => {
        const {page} = await openPage(obeys(), PHONE);
        const tops = await page.$$eval('.toolbar > *', (tools) =>
            tools.map((tool) => tool.getBoundingClientRect()).map(({top, height}) => Math.round(top + height / 2)),
        );
        assert.equal(new Set(tops).size, 2, tops.join());
    });

    it('the editor of a pin is whole wherever it is set', async () => {
        const {page} = await openPage(obeys(), PHONE);
        await page.tap('[data-tool="pin"]');
        await page.locator('#picture').tap({position: {x: 350, y: 500}});
        await page.waitForSelector('.pin-editor');
        await keepScreenshot(page, 'phone_pin');
        const {editor, picture} = await page.evaluate(() => {
            window.raybundle.drawOverlay();
            const box = (/** @type {string} */ name) => document.querySelector(name).getBoundingClientRect().toJSON();
            return {editor: box('.pin-editor'), picture: box('#picture')};
        });
        assert.ok(editor.left >= 0 && editor.right <= 360, JSON.stringify(editor));
        assert.ok(editor.top >= picture.top && editor.bottom <= picture.bottom, JSON.stringify({editor, picture}));
    });

    it('what is measured is listed in the picture, with the way to all of it', async () => {
        const {page} = await openPage(obeys(), PHONE);
        await page.tap('[data-tool="measure"]');
        assert.equal(await page.innerText('#measured-hint'), 'Tap a surface to measure its light.');
        for (let i = 0; i < 5; ++i) {
            await page.locator('#picture').tap({position: {x: 60 + 20 * i, y: 200}});
            await page.waitForFunction((count) => window.raybundleParts.measuring.points.length === count, i + 1);
        }
        const rows = await page.$$eval('#measured-list li', (all) => all.map(({textContent}) => textContent));
        assert.deepEqual(rows, [3, 4, 5].map((number) => `${number}200 lx ± 3.9 %`));
        await keepScreenshot(page, 'phone_measured');
        const rough = await page.evaluate(() => {
            window.raybundleParts.measuring.points[0].probe.relativeError = undefined;
            document.getElementById('unit').dispatchEvent(new Event('change'));
            const {innerText, textContent} = document.querySelector('.probe');
            return [innerText, textContent];
        });
        assert.match(rough[0], /≈ 200 lx$/, 'short, where there is little room');
        assert.match(rough[1], /≈ 200 lx, error not yet known$/);
        // Wherever a point is, its value is whole.
        await page.evaluate(() => {
            const app = window.raybundle;
            const [point] = window.raybundleParts.measuring.points;
            const {origin, direction} = app.rayAt({x: 345, y: 300});
            const along = (/** @type {'x' | 'y' | 'z'} */ axis) => origin[axis] + 3 * direction[axis];
            point.position = {x: along('x'), y: along('y'), z: along('z')};
            app.drawOverlay();
        });
        await page.waitForSelector('.probe.leftwards');
        const label = await page.locator('.probe.leftwards').boundingBox();
        assert.ok(label.x > 0 && label.x + label.width < 345, JSON.stringify(label));
        const [strip, picture] = await page.evaluate(() =>
            ['measured', 'picture'].map((id) => document.getElementById(id).getBoundingClientRect().toJSON()),
        );
        const inside = strip.left > 136 && strip.right <= 360 && strip.bottom <= picture.bottom;
        assert.ok(inside, JSON.stringify({strip, picture}));
        await page.tap('#measured-all');
        await page.waitForSelector('#points', {state: 'visible'});
        assert.ok(await page.isHidden('#measured'));
        await page.tap('[data-tool="select"]');
        await page.tap('#panel-toggle');
        assert.ok(await page.isHidden('#measured'));
    });

    it('another page of the panel begins at its beginning', async () => {
        const {page} = await openPage(obeys({pins: Array.from({length: 9}, (_, i) => ({...PIN, pin: i + 1}))}), PHONE);
        await page.tap('#panel-toggle');
        await page.click('#tab-review');
        await page.evaluate(() => document.getElementById('panel').scrollTo({top: 400}));
        await page.click('#tab-measure');
        assert.equal(await page.evaluate(() => document.getElementById('panel').scrollTop), 0);
    });

    it('the legend is whole beside the open panel', async () => {
        const {page} = await openPage(obeys(), PHONE);
        await page.tap('#panel-toggle');
        const {legend, picture} = await page.evaluate(() => {
            const app = window.raybundle;
            app.frame = {scaleMaximum: 2000};
            app.dispatchEvent(new CustomEvent('picture', {detail: app.frame}));
            const bottom = (/** @type {string} */ id) => document.getElementById(id).getBoundingClientRect().bottom;
            return {legend: bottom('legend'), picture: bottom('picture')};
        });
        await keepScreenshot(page, 'phone_legend');
        assert.ok(legend > 0 && legend <= picture, `${legend} of ${picture}`);
    });

    it('Escape closes the panel and goes back to its button', async () => {
        const {page} = await openPage(obeys(), PHONE);
        await page.tap('#panel-toggle');
        await page.focus('#tab-scene');
        await page.keyboard.press('Escape');
        await page.waitForSelector('#panel', {state: 'hidden'});
        assert.equal(await focused(page), 'panel-toggle');
    });
});

describe('a file that is dropped', () => {
    /** Drags a file over the page, and drops it. */
    const drop = (page, name) =>
        page.evaluate((file) => {
            const dataTransfer = new DataTransfer();
            dataTransfer.items.add(new File(['x'], file));
            const fire = (/** @type {string} */ type) => {
                const options = {dataTransfer, bubbles: true, cancelable: true};
                return !document.body.dispatchEvent(new DragEvent(type, options));
            };
            fire('dragenter');
            fire('dragover');
            const shown = !document.getElementById('drop-target').hidden;
            return {shown, stays: fire('drop')};
        }, name);

    it('is told to be welcome, and why it is not taken', async () => {
        const {page} = await openPage(obeys({canOpenScenes: true}));
        await page.waitForSelector('#scene-file-list button');
        await page.click('#tab-review');
        assert.deepEqual(await drop(page, 'room.obj'), {shown: true, stays: true});
        await page.waitForSelector('#scene-file-state', {state: 'visible'});
        assert.match(await page.textContent('#scene-file-state'), /room\.obj is not a \.glb file/);
        assert.ok(await page.isHidden('#drop-target'));
    });

    it('does not make the browser leave the page of who may only look', async () => {
        const {page} = await openPage(obeys({role: 'VIEWER'}));
        assert.deepEqual(await drop(page, 'room.glb'), {shown: false, stays: true});
        assert.match(await page.textContent('#notices'), /View only\. Ask for editor access/);
    });
});

describe('a grid', () => {
    it('says what to do where no surface has been picked, and lies on what is selected', async () => {
        const grid = {illuminance: Array(16).fill(100), relativeError: Array(16).fill(0.02), epoch: 0};
        const {page, sent} = await openPage((request, send) =>
            request.probeGrid ? send({probeGridResult: grid}) : obeys()(request, send),
        );
        await page.click('#tab-measure');
        await page.focus('#measure-grid');
        await page.keyboard.press('Enter');
        assert.match(await page.textContent('#grid-state'), /^There is no surface yet: select an object, or/);
        assert.ok(await page.isDisabled('#grid-surface'));
        await page.evaluate(() => window.raybundle.select(1));
        assert.equal(await page.textContent('#grid-state'), '');
        assert.equal(await page.textContent('#grid-surface'), 'table (selected)');
        await page.focus('#measure-grid');
        await page.keyboard.press('Enter');
        await page.waitForSelector('#grid-result', {state: 'visible'});
        assert.match(await page.textContent('#grid-state'), /^table, upper side: .*Typical error ± 3\.9 %/);
        const {origin} = sent.find(({probeGrid}) => probeGrid).probeGrid;
        assert.ok(Math.abs(origin.y - PROBE.position.y) < 0.01, JSON.stringify(origin));
        await page.focus('#picture');
        await page.keyboard.press('Digit2');
        await page.keyboard.press('Enter');
        await page.waitForSelector('#points tbody tr');
        const options = await page.$$eval('#grid-surface option', (all) => all.map((o) => o.textContent));
        assert.deepEqual(options, ['table (selected)', 'table at point 1']);
        assert.equal(await page.inputValue('#grid-surface'), '1');
    });
});

describe('units, lines and costs', () => {
    it('footcandles go for the scale, its lines and the pins', async () => {
        const {page, sent} = await openPage(obeys({pins: [PIN]}));
        await page.click('#tab-measure');
        await page.check('#isolines');
        assert.equal(await page.inputValue('#display-mode'), 'FALSE_ILLUMINANCE');
        await page.selectOption('#unit', 'fc');
        await page.selectOption('#scale-maximum', '100');
        const last = () => sent.flatMap(({setDisplay}) => (setDisplay ? [setDisplay] : [])).at(-1);
        await page.waitForTimeout(100);
        assert.ok(Math.abs(last().scaleUnit - 10.7639) < 1e-3, JSON.stringify(last()));
        assert.ok(Math.abs(last().scaleMaximum - 1076.39) < 0.1 && last().isolines);
        await page.selectOption('#display-mode', 'FALSE_LUMINANCE');
        await page.waitForTimeout(100);
        assert.deepEqual([last().scaleUnit, last().scaleMaximum], [1, 100]);
        await page.click('#tab-review');
        assert.match(await page.textContent('#pins'), /≈ 10 fc/);
    });

    it('what an effect costs is measured where somebody asks', async () => {
        const {page} = await openPage();
        await page.click('#tab-accuracy');
        await page.click('#measure-effects');
        await page.waitForFunction(() =>
            document.getElementById('effects').textContent.includes('2.5 ms an iteration'),
        );
        assert.equal((await page.textContent('#effects')).match(/ms an iteration/g).length, 1);
    });
});
