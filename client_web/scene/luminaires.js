// SPDX-License-Identifier: Apache-2.0
// Luminaires: photometric files of the server, uploads, and fields of luminaires that are added.

import {ceilingAbove} from './floors.js';
import {byId, fieldNews, fieldNote} from '../ui/elements.js';
import {threeDigits} from '../ui/units.js';
import {add, centre, contains, length, scale, vec3} from '../ui/vector.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('../net/scene_types.js').Vec3} Vec3
 * @typedef {import('./things.js').Things} Things
 * @typedef {{name: string, flux?: number, power?: number, size?: {length: number, width: number, height: number},
 *     problems: string[]}} PhotometricFile
 */

/** From one luminaire to the next of a field as long as nobody says otherwise, metres. */
const SPACING = 2;
/** Below the ceiling, or the top of the scene, metres. */
const BELOW_CEILING = 0.1;
/** Before who adds it, so that he sees it, metres. */
const AHEAD = 1.5;

/**
 * What a file is known by.
 *
 * @param {PhotometricFile} file
 */
export function fileText({name, flux, power, problems}) {
    const watts = power ? `, ${Number(power.toPrecision(3))} W` : '';
    return flux ? `${name} (${threeDigits(flux)} lm${watts})` : `${name}: ${problems[0] ?? 'cannot be read'}`;
}

/**
 * What a field of luminaires is asked for by.
 *
 * @param {{photometry: string, position: {x: number, y: number, z: number}, columns: number, rows: number,
 *     spacing: number, group: string}} field  spacing: metres, along x and z
 */
export function luminaireRequest({photometry, position, columns, rows, spacing, group}) {
    const many = columns * rows > 1;
    return {
        photometry,
        position,
        ...(group ? {group} : {}),
        ...(many ? {columns, rows, columnStep: {x: spacing, y: 0, z: 0}, rowStep: {x: 0, y: 0, z: spacing}} : {}),
    };
}

/**
 * Where a luminaire is likely to be wanted: below the ceiling of the room that somebody is in, a little ahead; seen from
 * outside, below the top of the scene's middle.
 *
 * @param {import('./scene_model.js').SceneModel} scene
 * @param {import('../net/scene_types.js').View} view
 * @param {(from: Vec3, to: Vec3) => Vec3} reached  how far one comes before a wall is in the way
 * @returns {Vec3}
 */
export function likelyPlace({bounds, objects}, {eye, target}, reached) {
    const top = bounds.max.y;
    if (!contains(bounds, eye)) {
        return {...centre(bounds), y: top - BELOW_CEILING};
    }
    const ahead = vec3(target.x - eye.x, 0, target.z - eye.z);
    const distance = length(ahead);
    const {x, z} = distance > 0 ? reached(eye, add(eye, scale(ahead, AHEAD / distance))) : eye;
    return vec3(x, (ceilingAbove(objects, vec3(x, eye.y, z)) ?? top) - BELOW_CEILING, z);
}

export class Luminaires extends EventTarget {
    /** Of the server's folder. @type {PhotometricFile[]} */
    files = [];
    /** Somebody has said where the next one shall be. */
    #placed = false;
    #section = byId('add-luminaire', HTMLDetailsElement);
    #form = byId('luminaire-form', HTMLFormElement);
    #file = byId('luminaire-file', HTMLSelectElement);
    #note = byId('luminaire-note', HTMLElement);
    #chooser = byId('photometry-file', HTMLInputElement);

    /**
     * @param {RaybundleApp} app
     * @param {Things} things
     * @param {import('../camera/collisions.js').Collisions} collisions
     */
    constructor(app, things, collisions) {
        super();
        this.app = app;
        this.things = things;
        this.collisions = collisions;
        app.on('welcome', () => this.#welcomed());
        this.#form.addEventListener('input', ({target}) => {
            this.#placed ||= ['x', 'y', 'z'].some((name) => this.#number(name) === target);
        });
        this.#section.addEventListener('toggle', () => this.#propose());
        this.#form.addEventListener('submit', (event) => {
            event.preventDefault();
            this.#add();
        });
        byId('upload-photometry', HTMLButtonElement).addEventListener('click', () => this.#chooser.click());
        this.#chooser.addEventListener('change', () => {
            const file = this.#chooser.files?.[0];
            this.#chooser.value = '';
            if (file) {
                this.#upload(file);
            }
        });
    }

    async #welcomed() {
        const folder = this.app.client.welcome?.canOpenScenes === true;  // photometric files are in it
        this.#section.hidden = !this.app.mayEdit;
        byId('luminaire-folder', HTMLElement).hidden = folder;
        for (const id of ['luminaire-none', 'luminaire-form', 'luminaire-upload']) {
            byId(id, HTMLElement).hidden = !folder;
        }
        if (!this.app.mayEdit || !folder) {
            return;
        }
        this.#placed = false;
        this.#propose();
        this.#number('spacing').value = String(SPACING);
        await this.#load();
    }

    /** A place for the next one, unless somebody has entered one. */
    #propose() {
        const {scene, view} = this.app;
        if (scene && !this.#placed) {
            const place = likelyPlace(scene, view, (from, to) => this.collisions.grid?.reached(from, to) ?? from);
            for (const [name, value] of Object.entries(place)) {
                this.#number(name).value = value.toFixed(2);
            }
        }
    }

    /** @param {string} name */
    #number(name) {
        return byId(`luminaire-${name}`, HTMLInputElement);
    }

    /** @param {string} [chosen]  file that is chosen then */
    async #load(chosen = this.#file.value) {
        try {
            const answer = await fetch(new URL('photometry', location.href), {headers: this.app.client.httpHeaders});
            this.files = answer.ok ? await answer.json() : [];
        } catch {
            this.files = [];
        }
        const options = this.files.map((file) => {
            const option = document.createElement('option');
            option.value = file.name;
            option.textContent = fileText(file);
            option.disabled = !file.flux;
            return option;
        });
        this.#file.replaceChildren(...options);
        if (this.files.some(({name}) => name === chosen)) {
            this.#file.value = chosen;
        }
        byId('luminaire-none', HTMLElement).hidden = options.length > 0;
        byId('luminaire-fields', HTMLElement).hidden = options.length === 0;
        this.dispatchEvent(new Event('files'));
    }

    async #add() {
        const value = (/** @type {string} */ name) => this.#number(name).valueAsNumber;
        const [x, y, z, columns, rows, spacing] = ['x', 'y', 'z', 'columns', 'rows', 'spacing'].map(value);
        if (![x, y, z, columns, rows, spacing].every(Number.isFinite)) {
            fieldNote(this.#note, 'Enter numbers. Nothing has been added.');
            return;
        }
        const photometry = this.#file.value;
        const group = this.#number('group').value.trim();
        const request = luminaireRequest({photometry, position: {x, y, z}, columns, rows, spacing, group});
        const count = columns * rows;
        const name = count > 1 ? `${count} × ${photometry}` : photometry;
        fieldNews(this.#note, `Adding ${name} …`);
        const added = await this.things.addLuminaires(request, name);
        fieldNews(this.#note, added ? `Added ${name}.` : '');
    }

    /** @param {File} file */
    async #upload(file) {
        if (!/\.(ies|ldt)$/i.test(file.name)) {
            fieldNote(this.#note, `${file.name} is neither an .ies nor an .ldt file.`);
            return;
        }
        fieldNews(this.#note, `Sending ${file.name} …`);
        try {
            const address = new URL(`photometry/${encodeURIComponent(file.name)}`, location.href);
            const answer = await fetch(address, {method: 'PUT', headers: this.app.client.httpHeaders, body: file});
            (answer.ok ? fieldNews : fieldNote)(this.#note, (await answer.text()).trim());
            await this.#load(answer.ok ? file.name : undefined);
        } catch {
            fieldNote(this.#note, `Could not send ${file.name}.`);
        }
    }
}
