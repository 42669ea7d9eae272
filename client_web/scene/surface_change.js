// SPDX-License-Identifier: Apache-2.0
// Changes to a light or a material: while a slider moves, one is on its way, and the newest follows it.

import {subjectOf} from './history.js';
import {withOwnChanges} from './own_changes.js';

/**
 * @typedef {import('./history.js').History} History
 * @typedef {import('../net/raybundle_client.js').RaybundleClient} RaybundleClient
 * @typedef {Record<string, unknown>} Values
 * @typedef {(why: string) => void} Refused
 */

/** Sends the newest of many changes, one at a time. */
export class NewestOnly {
    /** @type {object | null} */
    #next = null;
    #busy = false;

    /** @param {(body: object) => Promise<unknown>} send */
    constructor(send) {
        this.send = send;
    }

    /** @param {object} body  replaces one that still waits */
    async push(body) {
        this.#next = body;
        if (this.#busy) {
            return;
        }
        this.#busy = true;
        while (this.#next) {
            const now = this.#next;
            this.#next = null;
            await this.send(now);
        }
        this.#busy = false;
    }
}

/** Changes to one light or material, or to several that change together. */
export class SurfaceChange {
    /** What it was when the user took hold of it. @type {Values | null} */
    #before = null;

    /**
     * @param {{client: RaybundleClient, history: History, refused: (error: unknown, say?: Refused) => void}} page
     *     refused: tells the user, by `say` where that is given
     * @param {'setLight' | 'setMaterial'} kind
     * @param {object[]} subjects
     * @param {string} name  for people
     * @param {() => Values} state  what it is set to now
     */
    constructor(page, kind, subjects, name, state) {
        this.page = page;
        this.kind = kind;
        this.subjects = subjects;
        this.name = name;
        this.state = state;
        this.newest = new NewestOnly((values) => this.#send(values));
    }

    /** @param {object} values  while a slider moves */
    going(values) {
        this.#before ??= this.state();
        this.newest.push(values);
    }

    /**
     * When it is let go.
     *
     * @param {object} values
     * @param {Refused} [refused]  says so, instead of a notice
     * @param {object} [how]  fields of the request that are no state, such as how long it takes
     */
    async done(values, refused, how = {}) {
        const from = this.#before ?? this.state();
        this.#before = null;
        const {result: sent, changes} = await withOwnChanges(this.page.client, () => this.#send({...values, ...how}, refused));
        if (sent && 'photometry' in values) {
            this.#addExchange(values, changes);
        } else if (sent) {
            // Of the rest the server may refuse what it has.
            const touched = Object.keys(values).map((key) => [key, from[key]]);
            this.page.history.add({
                label: `set ${this.name}`,
                subject: this.subjects.map((one) => subjectOf({[this.kind]: one})),
                undo: () => this.#send(Object.fromEntries(touched)),
                redo: () => this.#send({...values, ...how}),
            });
        }
    }

    /**
     * Lights shine by another file, with its flux. They get back what each had before; also where that was the scene's own
     * file, which the server has under no name.
     *
     * @param {object} values
     * @param {import('../net/scene_types.js').SceneChanged[]} changes
     */
    #addExchange(values, changes) {
        const before = changes.flatMap(({setLight, lightBefore}) =>
            setLight?.photometry !== undefined && lightBefore
                ? [{light: setLight.light, photometry: lightBefore.photometry ?? '', intensity: lightBefore.intensity}]
                : []);
        this.page.history.add({
            label: `set ${this.name}`,
            subject: before.map(({light}) => subjectOf({setLight: {light}})),
            undo: () => this.#request(before),
            redo: () => this.#send(values),
        });
    }

    /**
     * @param {object} values
     * @param {Refused} [refused]
     * @returns {Promise<boolean>} whether it has been changed
     */
    #send(values, refused) {
        return this.#request(this.subjects.map((one) => ({...one, ...values})), refused);
    }

    /**
     * @param {object[]} bodies
     * @param {Refused} [refused]
     * @returns {Promise<boolean>}
     */
    async #request(bodies, refused) {
        try {
            const {client} = this.page;
            const sent = bodies.map((body) => client.request({[this.kind]: body}).answer);
            await Promise.all(sent);
            return true;
        } catch (error) {
            this.page.refused(error, refused);
            return false;
        }
    }
}
