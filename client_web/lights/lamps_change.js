// SPDX-License-Identifier: Apache-2.0
// A request that sets several lamps: what it changes is taken back as one step.

import {subjectOf} from '../scene/history.js';
import {withOwnChanges} from '../scene/own_changes.js';
import {NewestOnly} from '../scene/surface_change.js';

/**
 * @typedef {import('../scene/history.js').History} History
 * @typedef {import('../net/raybundle_client.js').RaybundleClient} RaybundleClient
 */

export class LampsChange {
    /** What the lamps were set to when the user took hold of them. @type {Map<number, Record<string, unknown>>} */
    #before = new Map();

    /**
     * @param {{client: RaybundleClient, history: History, ask: (body: object) => Promise<boolean>}} page  ask: whether it has
     *     been done; tells the user where not
     * @param {string} label  what is done, e.g. "set group desks"
     */
    constructor(page, label) {
        this.page = page;
        this.label = label;
        this.newest = new NewestOnly((body) => this.#send(body));
    }

    /** @param {object} body  a request, while a slider moves */
    going(body) {
        this.newest.push(body);
    }

    /** @param {object} body  the request, when it is let go */
    async done(body) {
        await this.#send(body);
        const before = [...this.#before].map(([light, fields]) => ({light, ...fields}));
        this.#before.clear();
        if (before.length > 0) {
            this.page.history.add({
                label: this.label,
                subject: before.map((setLight) => subjectOf({setLight})),
                undo: () => Promise.all(before.map((setLight) => this.page.ask({setLight}))),
                redo: () => this.page.ask(body),
            });
        }
    }

    /** @param {object} body */
    async #send(body) {
        const {changes} = await withOwnChanges(this.page.client, () => this.page.ask(body));
        for (const {setLight, lightBefore} of changes) {
            if (setLight && lightBefore) {
                const touched = Object.entries(lightBefore).filter(([key]) => key !== 'light' && key in setLight);
                this.#before.set(setLight.light, {...Object.fromEntries(touched), ...this.#before.get(setLight.light)});
            }
        }
    }
}
