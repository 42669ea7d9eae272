// SPDX-License-Identifier: Apache-2.0
// Pages of a server that says what a test wants, one at a time.

import {after, afterEach, before} from 'node:test';

import {PATIENCE_MS, launchBrowser} from './browser.mjs';
import {FileServer, fakeSocket} from './fake_server.mjs';

/**
 * Has a browser and the page's files for the tests of this file, and closes each test's page behind it.
 *
 * @returns {(answer: Parameters<typeof fakeSocket>[1],
 *     options?: import('playwright-core').BrowserContextOptions) =>
 *     Promise<{page: import('playwright-core').Page, sent: any[], faults: string[]}>} opens a page
 */
export function fakePages() {
    /** @type {import('playwright-core').Browser} */
    let browser;
    /** @type {FileServer} */
    let files;
    /** @type {import('playwright-core').BrowserContext} */
    let context;

    before(async () => {
        browser = await launchBrowser();
        files = await FileServer.start();
    });

    after(async () => {
        await browser?.close();
        files?.stop();
    });

    afterEach(() => context?.close());

    return async (answer, options = {}) => {
        context = await browser.newContext({viewport: {width: 1280, height: 800}, ...options});
        const page = await context.newPage();
        page.setDefaultTimeout(PATIENCE_MS);
        /** @type {string[]} */
        const faults = [];
        page.on('pageerror', (error) => faults.push(error.message));
        const sent = await fakeSocket(page, answer);
        await page.goto(files.url);
        return {page, sent, faults};
    };
}
