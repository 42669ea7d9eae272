// SPDX-License-Identifier: Apache-2.0
// What people are called, and who has just come.

/** @type {(viewer: {viewer: number, name: string}) => string} */
export const nameOf = ({viewer, name}) => name.trim() || `Viewer ${viewer}`;

/** Who comes back within so long has not been away for people, ms: another scene, a page that is loaded again. */
const ABSENCE_MS = 60000;

/** Who comes, without those who only come back or have been told of. */
export class Arrivals {
    /** When each was here last, by name. @type {Map<string, number>} */
    #seen = new Map();
    #first = true;
    #began = -Infinity;

    /**
     * This page has come in again: people without a name have new numbers.
     *
     * @param {number} now  ms
     */
    begin(now) {
        this.#began = now;
    }

    /**
     * @param {{viewer: number, name: string}[]} others  who are here, in the newest message
     * @param {number} now  ms
     * @returns {string[]} names of those who have come
     */
    note(others, now) {
        const settling = now - this.#began < ABSENCE_MS;
        const came = others
            .filter(({name}) => name.trim() || !settling)
            .map(nameOf)
            .filter((name, i, names) => names.indexOf(name) === i)
            .filter((name) => now - (this.#seen.get(name) ?? -Infinity) > ABSENCE_MS);
        others.forEach((other) => this.#seen.set(nameOf(other), now));
        const told = this.#first ? [] : came;
        this.#first = false;
        return told;
    }
}
