// SPDX-License-Identifier: Apache-2.0
// Says whether changes and pins outlast a restart of the server.

import {byId} from './elements.js';

/** @typedef {import('../net/protocol.js').Saving} Saving */

/** @type {Record<string, {text: string, why: string}>} */
const TEXTS = {
    SAVED: {text: 'Saved', why: 'Changes, pins and views are on the server’s disk: a restart brings them back.'},
    NOT_SAVED: {
        text: 'Not saved',
        why: 'This server keeps no journal: a restart loses changes, pins and views.',
    },
    FAILING: {
        text: 'Cannot save',
        why: 'The server cannot write its journal, so it refuses changes. Whoever runs it finds the reason in its log.',
    },
    BUSY: {text: 'Saving …', why: 'A change is on its way to the server.'},
};

export class SavingState {
    #element = byId('saving', HTMLElement);
    /** @type {Saving | undefined} */
    #state;

    /** @param {import('../app/app.js').RaybundleApp} app */
    constructor(app) {
        this.app = app;
        app.on('welcome', ({saving}) => this.#show(saving));
        app.on('solution', ({saving}) => this.#show(saving));
        app.client.addEventListener('asked', () => this.#show(this.#state));
    }

    /** Whether the server forgets what is changed when it ends. */
    get forgets() {
        return this.#state === 'NOT_SAVED';
    }

    /** @param {Saving | undefined} state  absent: the server does not tell */
    #show(state) {
        this.#state = state;
        const shown = state === 'SAVED' && this.app.client.changing ? 'BUSY' : (state ?? '');
        const said = TEXTS[shown];
        this.#element.hidden = !said;
        this.#element.dataset.state = shown;
        if (said && this.#element.textContent !== said.text) {
            this.#element.textContent = said.text;
            this.#element.title = said.why;
        }
    }
}
