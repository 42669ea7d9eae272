// SPDX-License-Identifier: Apache-2.0
// Documents that the server makes: the report, and pins for BIM tools.

import {byId, fileName, saveFile} from '../ui/elements.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('../measure/measure.js').Measuring} Measuring
 */

export class Documents {
    #state = byId('documents-state', HTMLElement);

    /**
     * @param {RaybundleApp} app
     * @param {Measuring} measuring
     */
    constructor(app, measuring) {
        this.app = app;
        this.measuring = measuring;
        for (const button of document.querySelectorAll('[data-document]')) {
            if (button instanceof HTMLButtonElement) {
                button.addEventListener('click', () => this.#get(button.dataset.document ?? '', button));
            }
        }
        byId('bcf-file', HTMLInputElement).addEventListener('change', () => this.#import());
        app.on('welcome', () => {
            byId('bcf-import', HTMLElement).hidden = !app.mayReview;
        });
    }

    /** @param {string} text */
    #say(text) {
        this.#state.textContent = text;
        this.#state.hidden = text === '';
    }

    /**
     * @param {string} name  of the document
     * @param {HTMLButtonElement} button
     */
    async #get(name, button) {
        const query = new URLSearchParams({lang: byId('report-language', HTMLSelectElement).value, unit: this.measuring.unit});
        const since = byId('report-since', HTMLInputElement).value;
        if (since) {
            query.set('since', since);
        }
        button.disabled = true;
        this.#say('Being written …');
        try {
            const answer = await fetch(new URL(`${name}?${query}`, location.href), {headers: this.app.client.httpHeaders});
            if (answer.ok) {
                saveFile(await answer.blob(), `${fileName(this.app.scene?.title ?? '')}_${name}`);
                this.#say('');
            } else {
                this.#say((await answer.text()).trim());
            }
        } catch {
            this.#say('The connection was lost.');
        }
        button.disabled = false;
    }

    async #import() {
        const input = byId('bcf-file', HTMLInputElement);
        const file = input.files?.[0];
        input.value = '';
        if (!file) {
            return;
        }
        try {
            const answer = await fetch(new URL('pins.bcf', location.href), {method: 'PUT', body: file, headers: this.app.client.httpHeaders});
            this.#say((await answer.text()).trim());
        } catch {
            this.#say('The connection was lost.');
        }
    }
}
