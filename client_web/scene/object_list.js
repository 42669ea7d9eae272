// SPDX-License-Identifier: Apache-2.0
// The list of objects of big models: found by words, grouped by storey, hidden and isolated. What is hidden is hidden
// from this viewer alone, and keeps its light and shadow.

import {byId, listRow, smallButton} from '../ui/elements.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('./scene_model.js').PlacedObject} PlacedObject
 */

/** More rows than these wait for a word that is searched for. */
const MOST_ROWS = 300;
/** Shorter lists need no search. */
const SEARCHED = 8;

/**
 * Whether an object is meant by some words: all of them are in its name, its storey or its kind.
 *
 * @param {{name: string, storey: string, kind: string}} object
 * @param {string} words
 */
export function matches({name, storey, kind}, words) {
    const text = `${name} ${storey} ${kind}`.toLowerCase();
    return words.toLowerCase().split(/\s+/).every((word) => text.includes(word));
}

/**
 * Objects by storey, those of none last.
 *
 * @template {{storey: string}} T
 * @param {T[]} objects
 * @param {Iterable<string>} storeys  in their order
 * @returns {[string, T[]][]} without empty ones
 */
export function byStorey(objects, storeys) {
    /** @type {[string, T[]][]} */
    const groups = [...storeys, ''].map((name) => [name, objects.filter(({storey}) => storey === name)]);
    return groups.filter(([, members]) => members.length > 0);
}

export class ObjectList {
    /** Ids of what this viewer does not see. @type {Set<number>} */
    hidden = new Set();
    #objects = byId('objects', HTMLUListElement);
    #fixed = byId('fixed-objects', HTMLUListElement);
    #search = byId('object-search', HTMLInputElement);
    #all = byId('show-all', HTMLButtonElement);
    #hide = byId('hide', HTMLButtonElement);
    #fixedParts = byId('fixed-details', HTMLDetailsElement);
    /** Unfolded for what has been searched for, not by the user. */
    #openForSearch = false;

    /** @param {RaybundleApp} app */
    constructor(app) {
        this.app = app;
        this.#search.addEventListener('input', () => this.#show());
        this.#fixedParts.querySelector('summary')?.addEventListener('click', () => {
            this.#openForSearch = false;
        });
        this.#all.addEventListener('click', () => this.#setHidden([]));
        this.#hide.addEventListener('click', () => {
            if (app.selected) {
                this.#toggle(app.selected.id);
            }
        });
        byId('isolate', HTMLButtonElement).addEventListener('click', () => {
            if (app.selected) {
                this.isolate([app.selected]);
            }
        });
        app.on('anew', () => {
            this.hidden = new Set();
            app.dispatchEvent(new CustomEvent('hidden', {detail: []}));
        });
        app.on('welcome', () => {
            const known = new Set(app.scene?.objects.map(({id}) => id));
            this.hidden = new Set([...this.hidden].filter((id) => known.has(id)));
            if (this.hidden.size > 0) {
                this.#setHidden([...this.hidden]);
            }
            this.#show();
        });
        app.on('sceneChanged', ({addObject, removeObject}) => {
            if (addObject || removeObject) {
                this.#show();
            }
        });
        app.on('selection', () => this.#markSelected());
    }

    /**
     * Shows nothing else.
     *
     * @param {PlacedObject[]} objects
     */
    isolate(objects) {
        const shown = new Set(objects.map(({id}) => id));
        this.#setHidden((this.app.scene?.objects ?? []).map(({id}) => id).filter((id) => !shown.has(id)));
    }

    /** @param {Iterable<number>} ids */
    async #setHidden(ids) {
        const objects = [...new Set(ids)];
        if (await this.app.ask({setHidden: {objects}})) {
            this.hidden = new Set(objects);
            this.app.dispatchEvent(new CustomEvent('hidden', {detail: objects}));
            this.#show();
        }
    }

    /** @param {number} id  hidden from now on, or shown again */
    #toggle(id) {
        const others = [...this.hidden].filter((other) => other !== id);
        return this.#setHidden(this.hidden.has(id) ? others : [...others, id]);
    }

    /** @param {PlacedObject} object */
    #row(object) {
        const {id, name} = object;
        const hidden = this.hidden.has(id);
        const row = listRow(name, () => this.app.select(id), hidden ? 'hidden' : '');
        row.dataset.object = String(id);
        if (hidden) {
            row.append(smallButton('Show', `Show ${name}`, () => this.#toggle(id)));
        }
        return row;
    }

    /**
     * @param {HTMLUListElement} list
     * @param {PlacedObject[]} objects
     * @param {string} none  what is said instead of an empty list
     */
    #fill(list, objects, none) {
        const {scene} = this.app;
        const rows = [];
        for (const [storey, members] of byStorey(objects.slice(0, MOST_ROWS), scene?.storeys.keys() ?? [])) {
            if (storey) {
                const head = document.createElement('li');
                head.className = 'group';
                const title = document.createElement('b');
                title.textContent = storey;
                const all = (scene?.objects ?? []).filter((object) => object.storey === storey);
                head.append(title, smallButton('Only this', `Show only ${storey}`, () => this.isolate(all)));
                rows.push(head);
            }
            rows.push(...members.map((object) => this.#row(object)));
        }
        const more = objects.length - MOST_ROWS;
        if (rows.length === 0 || more > 0) {
            const note = document.createElement('li');
            note.className = 'empty';
            note.textContent = rows.length === 0 ? none : `and ${more} more: search for them`;
            rows.push(note);
        }
        list.replaceChildren(...rows);
    }

    #show() {
        const {scene} = this.app;
        if (!scene) {
            return;
        }
        const {objects} = scene;
        byId('object-search-field', HTMLElement).hidden = objects.length <= SEARCHED;
        const words = this.#search.value.trim();
        const found = words ? objects.filter((object) => matches(object, words)) : objects;
        const none = words ? 'No object has such a name.' : 'Nothing here can be moved.';
        this.#fill(this.#objects, found.filter(({loose}) => loose), none);
        const fixed = found.filter(({loose}) => !loose);
        this.#fill(this.#fixed, fixed, '');
        this.#fixedParts.hidden = fixed.length === 0;
        this.#unfoldFixed(words !== '' && fixed.length > 0);
        const count = this.hidden.size;
        this.#all.hidden = count === 0;
        this.#all.textContent = count === 1 ? 'Show the hidden one' : `Show all ${count} hidden ones`;
        this.#markSelected();
    }

    /** @param {boolean} wanted  something that is searched for is among the fixed parts */
    #unfoldFixed(wanted) {
        if (wanted && !this.#fixedParts.open) {
            this.#fixedParts.open = true;
            this.#openForSearch = true;
        } else if (!wanted && this.#openForSearch) {
            this.#fixedParts.open = false;
            this.#openForSearch = false;
        }
    }

    #markSelected() {
        this.#hide.textContent = this.hidden.has(this.app.selected?.id ?? 0) ? 'Show' : 'Hide';
        for (const list of [this.#objects, this.#fixed]) {
            for (const row of list.querySelectorAll('li')) {
                const selected = row.dataset.object === String(this.app.selected?.id);
                row.querySelector('button')?.setAttribute('aria-pressed', String(selected));
            }
        }
    }

    /** After an object has been unlocked. */
    refresh() {
        this.#show();
    }
}
