// SPDX-License-Identifier: Apache-2.0
// Chromium, pages of the client, and what a test wants to know of them.

import {existsSync, mkdirSync} from 'node:fs';
import {createRequire} from 'node:module';
import path from 'node:path';
import {it} from 'node:test';

import {ROOT} from './daemon.mjs';

const CHROMIUM = process.env.CHROMIUM ?? '/usr/bin/chromium';
const SCREENSHOTS = process.env.RAYBUNDLE_SCREENSHOTS ?? path.join(ROOT, 'build/screenshots');

/** Patience with software rendering on a busy machine, milliseconds. */
export const PATIENCE_MS = Number(process.env.RAYBUNDLE_PATIENCE_MS ?? 400000);

/** A test that takes a minute, of what others test in parts: run by ctest's label heavy alone. */
export const heavy = process.env.RAYBUNDLE_HEAVY ? it : it.skip;

/** WebGL on the processor. */
export const SOFTWARE_GL = ['--use-angle=swiftshader', '--enable-unsafe-swiftshader'];

/**
 * Starts Chromium.
 *
 * @param {string[]} more  of its options
 * @returns {Promise<import('playwright-core').Browser>}
 */
export async function launchBrowser(more = []) {
    let playwright;
    try {
        playwright = createRequire(import.meta.url)('playwright-core');
    } catch {
        throw new Error('playwright-core is missing: run `npm ci` in tests/browser');
    }
    if (!existsSync(CHROMIUM)) {
        throw new Error(`${CHROMIUM} is missing: install chromium, or name it in CHROMIUM`);
    }
    // Chromium ends its process that draws when it has not answered for some seconds, as on a slow machine.
    const args = ['--disable-gpu-watchdog', ...(process.getuid?.() === 0 ? ['--no-sandbox'] : []), ...more];
    return playwright.chromium.launch({executablePath: CHROMIUM, args, timeout: PATIENCE_MS});
}

/**
 * Opens the client and collects what goes wrong in it.
 *
 * @param {import('playwright-core').Browser} browser
 * @param {string} url
 * @param {import('playwright-core').BrowserContextOptions} options
 */
export async function openClient(browser, url, options) {
    const context = await browser.newContext(options);
    const page = await context.newPage();
    page.setDefaultTimeout(PATIENCE_MS);
    /** @type {string[]} */
    const faults = [];
    page.on('pageerror', (error) => faults.push(error.message));
    page.on('console', (message) => {
        if (message.type() === 'error') {
            faults.push(message.text());
        }
    });
    await page.goto(url);
    return {context, page, faults};
}

/**
 * Keeps a picture of the page.
 *
 * @param {import('playwright-core').Page} page
 * @param {string} name
 */
export async function keepScreenshot(page, name) {
    mkdirSync(SCREENSHOTS, {recursive: true});
    await page.screenshot({path: path.join(SCREENSHOTS, `${name}.png`)});
}

/**
 * Waits until the newest frame fulfils a condition.
 *
 * @param {import('playwright-core').Page} page
 * @param {{epoch?: number, cameraId?: number, settled?: number}} least
 */
export async function frameWith(page, least) {
    await page.waitForFunction(
        ({epoch, cameraId, settled}) => {
            const header = window.raybundle?.frame;
            return (
                header &&
                header.epoch >= (epoch ?? 0) &&
                header.cameraId >= (cameraId ?? 0) &&
                header.settled >= (settled ?? 0)
            );
        },
        least,
        {timeout: PATIENCE_MS, polling: 100},
    );
}

/**
 * Mean of the picture's pixels around a point, 0..255 as encoded.
 *
 * @param {import('playwright-core').Page} page
 * @param {{x: number, y: number, z: number}} point  world space, metres
 * @returns {Promise<number>}
 */
export async function brightnessAt(page, point) {
    return page.evaluate((at) => {
        const app = window.raybundle;
        const {x, y} = app.project(at);
        const {canvas, context, element} = app.picture;
        const column = Math.round((x / element.clientWidth) * canvas.width);
        const row = Math.round((y / element.clientHeight) * canvas.height);
        const {data} = context.getImageData(column - 3, row - 3, 7, 7);
        const colours = data.filter((_, i) => i % 4 !== 3);
        return colours.reduce((sum, value) => sum + value, 0) / colours.length;
    }, point);
}

/**
 * The picture, shrunk to 64 x 48 pixels.
 *
 * @param {import('playwright-core').Page} page
 * @returns {Promise<number[]>} red, green, blue, …, 0..255 as encoded
 */
export async function thumbnail(page) {
    return page.evaluate(() => {
        const context = new OffscreenCanvas(64, 48).getContext('2d');
        context.drawImage(window.raybundle.picture.canvas, 0, 0, 64, 48);
        return [...context.getImageData(0, 0, 64, 48).data].filter((_, i) => i % 4 !== 3);
    });
}

/**
 * Mean difference of two thumbnails, 0..255.
 *
 * @param {number[]} a
 * @param {number[]} b
 */
export function difference(a, b) {
    return a.reduce((sum, value, i) => sum + Math.abs(value - b[i]), 0) / a.length;
}

/**
 * Where a point of the world appears on the page, CSS pixels.
 *
 * @param {import('playwright-core').Page} page
 * @param {{x: number, y: number, z: number}} point  metres
 */
export async function onPage(page, point) {
    return page.evaluate((at) => {
        const box = window.raybundle.picture.element.getBoundingClientRect();
        const {x, y} = window.raybundle.project(at);
        return {x: x + box.left, y: y + box.top};
    }, point);
}
