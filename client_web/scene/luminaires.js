// SPDX-License-Identifier: Apache-2.0
// Luminaires: photometric files of the server, uploads, and fields of luminaires that are added.

import {byId, fieldNote} from '../ui/elements.js';
import {threeDigits} from '../ui/units.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('./things.js').Things} Things
 * @typedef {{name: string, flux?: number, power?: number, size?: {length: number, width: number, height: number},
 *     problems: string[]}} PhotometricFile
 */

/** From one luminaire to the next of a field as long as nobody says otherwise, metres. */
const SPACING = 2;
/** Below the top of the scene, so that no ceiling is above it, metres. */
const BELOW_CEILING = 0.1;

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

export class Luminaires extends EventTarget {
    /** Of the server's folder. @type {PhotometricFile[]} */
    files = [];
    #section = byId('add-luminaire', HTMLDetailsElement);
    #form = byId('luminaire-form', HTMLFormElement);
    #file = byId('luminaire-file', HTMLSelectElement);
    #note = byId('luminaire-note', HTMLElement);
    #chooser = byId('photometry-file', HTMLInputElement);

    /**
     * @param {RaybundleApp} app
     * @param {Things} things
     */
    constructor(app, things) {
        super();
        this.app = app;
        this.things = things;
        app.on('welcome', () => this.#welcomed());
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
        const may = this.app.mayEdit && this.app.client.welcome?.canOpenScenes === true;
        this.#section.hidden = !may;
        const {scene} = this.app;
        if (!may || !scene) {
            return;
        }
        const {min, max} = scene.bounds;
        this.#number('x').value = ((min.x + max.x) / 2).toFixed(2);
        this.#number('y').value = (max.y - BELOW_CEILING).toFixed(2);
        this.#number('z').value = ((min.z + max.z) / 2).toFixed(2);
        this.#number('spacing').value = String(SPACING);
        await this.#load();
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
        fieldNote(this.#note, '');
        const photometry = this.#file.value;
        const group = this.#number('group').value.trim();
        const request = luminaireRequest({photometry, position: {x, y, z}, columns, rows, spacing, group});
        const count = columns * rows;
        const name = count > 1 ? `${count} × ${photometry}` : photometry;
        if (await this.things.addLuminaires(request, name)) {
            fieldNote(this.#note, `Added ${name}.`);
        }
    }

    /** @param {File} file */
    async #upload(file) {
        if (!/\.(ies|ldt)$/i.test(file.name)) {
            fieldNote(this.#note, `${file.name} is neither an .ies nor an .ldt file.`);
            return;
        }
        fieldNote(this.#note, `Sending ${file.name}.`);
        try {
            const address = new URL(`photometry/${encodeURIComponent(file.name)}`, location.href);
            const answer = await fetch(address, {method: 'PUT', headers: this.app.client.httpHeaders, body: file});
            fieldNote(this.#note, (await answer.text()).trim());
            await this.#load(answer.ok ? file.name : undefined);
        } catch {
            fieldNote(this.#note, `Could not send ${file.name}.`);
        }
    }
}
