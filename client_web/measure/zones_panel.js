// SPDX-License-Identifier: Apache-2.0
// Zones: planes that are kept with the project under a name, what is required of them, and whether they meet it.

import {byId, fieldNote, replaceRows, smallButton} from '../ui/elements.js';
import {checkText, litBy, luminaireLines, verdictSign, verdictWords, zoneValues} from './zones.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('./measure.js').Measuring} Measuring
 * @typedef {import('./work_plane_panel.js').WorkPlanePanel} WorkPlanePanel
 * @typedef {import('../net/measure_types.js').Measured} Measured
 * @typedef {import('../net/measure_types.js').Requirement} Requirement
 */

const NONE = '';
/** Of the table of requirements. */
const COLUMNS = /** @type {const} */ (['mean', 'uniformity', 'glare', 'cylindrical', 'colourRendering']);

export class ZonesPanel {
    /** @type {Map<number, Measured>} */
    #zones = new Map();
    /** @type {Requirement[]} */
    #requirements = [];
    /** Zones whose luminaires are listed. @type {Set<number>} */
    #unfolded = new Set();
    #note = byId('zone-note', HTMLElement);

    /**
     * @param {RaybundleApp} app
     * @param {Measuring} measuring
     * @param {WorkPlanePanel} plane
     */
    constructor(app, measuring, plane) {
        this.app = app;
        this.measuring = measuring;
        this.plane = plane;
        app.on('welcome', (welcome) => {
            this.#zones = new Map((welcome.zones ?? []).map((/** @type {Measured} */ zone) => [zone.measurement, zone]));
            this.#requirements = welcome.requirements ?? [];
            this.#show();
        });
        app.on('message', ({measured, requirementsChanged}) => {
            if (measured?.name) {
                if (measured.removed) {
                    this.#zones.delete(measured.measurement);
                } else {
                    this.#zones.set(measured.measurement, measured);
                }
                this.#show();
            }
            if (requirementsChanged) {
                this.#requirements = requirementsChanged.requirements ?? [];
                this.#show();
            }
        });
        measuring.addEventListener('unit', () => this.#show());
        byId('zone-form', HTMLFormElement).addEventListener('submit', (event) => {
            event.preventDefault();
            this.#keep();
        });
        byId('requirement-form', HTMLFormElement).addEventListener('submit', (event) => {
            event.preventDefault();
            this.#setRequirement();
        });
    }

    /** As the server has measured them last. @returns {Measured[]} */
    get list() {
        return [...this.#zones.values()];
    }

    /** Keeps the plane that the fields describe. */
    async #keep() {
        const name = byId('zone-name', HTMLInputElement);
        const measure = this.plane.request();
        if (!measure) {
            fieldNote(this.#note, 'Enter the height of the work plane as a number.', name);
            return;
        }
        fieldNote(this.#note, 'Measuring …');
        const answer = await this.app.ask({measure: {...measure, name: name.value.trim()}});
        fieldNote(this.#note, '');
        if (answer?.measured) {
            this.#zones.set(answer.measured.measurement, answer.measured);
            name.value = '';
            this.#show();
        }
    }

    async #setRequirement() {
        const field = (/** @type {string} */ id) => byId(`requirement-${id}`, HTMLInputElement);
        /** @type {Record<string, string | number>} */
        const requirement = {name: field('name').value.trim()};
        const known = this.#requirements.find(({name}) => name === requirement.name);
        for (const [key, value] of Object.entries(known ?? {})) {  // what the form has no field for
            if (!(/** @type {readonly string[]} */ (COLUMNS)).includes(key)) {
                requirement[key] = value;
            }
        }
        for (const key of COLUMNS) {
            if (Number.isFinite(field(key).valueAsNumber)) {
                requirement[key] = field(key).valueAsNumber;
            }
        }
        if (await this.app.ask({setRequirement: {requirement}})) {
            byId('requirement-form', HTMLFormElement).reset();
        }
    }

    #show() {
        const zones = this.list;
        replaceRows(byId('zones', HTMLElement), zones.map((zone) => this.#row(zone)));
        byId('zones-none', HTMLElement).hidden = zones.length > 0;
        byId('zones-in-picture-field', HTMLElement).hidden = zones.length === 0;
        byId('zone-form', HTMLElement).hidden = !this.app.mayReview;
        byId('requirement-form', HTMLElement).hidden = !this.app.mayEdit;
        replaceRows(byId('requirement-rows', HTMLElement), this.#requirements.map((row) => this.#requirementRow(row)));
        this.app.drawOverlay();
    }

    /** @param {Measured} zone */
    #row(zone) {
        const item = document.createElement('li');
        const sign = document.createElement('span');
        sign.className = `verdict ${(zone.verdict ?? '').toLowerCase()}`;
        sign.textContent = verdictSign(zone.verdict);
        sign.title = verdictWords(zone.verdict);
        const body = document.createElement('div');
        const title = document.createElement('p');
        title.className = 'zone-name';
        title.textContent = zone.name ?? '';
        const values = document.createElement('p');
        values.className = 'quiet';
        values.textContent = zoneValues(zone, this.measuring.unit);
        body.append(title, values);
        for (const check of zone.checks ?? []) {
            const line = document.createElement('p');
            line.className = `check-line ${check.verdict.toLowerCase()}`;
            line.textContent = `${verdictSign(check.verdict)} ${checkText(check, this.measuring.unit)}`;
            body.append(line);
        }
        const lamps = luminaireLines(zone, this.#isMaterial);
        if (lamps.length > 0) {
            body.append(this.#lampList(zone, lamps));
        }
        if (this.app.mayReview) {
            body.append(this.#requirementChoice(zone));
        }
        item.append(sign, body);
        if (this.app.mayReview) {
            item.append(smallButton('×', `Remove zone ${zone.name}`, () =>
                this.app.ask({removeMeasurement: {measurement: zone.measurement}}),
            ));
        }
        return item;
    }

    #isMaterial = (/** @type {number} */ light) => this.app.scene?.lights.some(({id, kind}) => id === light && kind === 'AREA') ?? false;

    /**
     * @param {Measured} zone
     * @param {string[]} lines
     */
    #lampList(zone, lines) {
        const details = document.createElement('details');
        details.open = this.#unfolded.has(zone.measurement);
        details.addEventListener('toggle', () => this.#unfolded[details.open ? 'add' : 'delete'](zone.measurement));
        const title = document.createElement('summary');
        title.textContent = litBy(zone, this.#isMaterial);
        const list = document.createElement('ul');
        list.className = 'zone-lamps';
        list.append(...lines.map((line) => {
            const item = document.createElement('li');
            item.textContent = line;
            return item;
        }));
        details.append(title, list);
        return details;
    }

    /** @param {Measured} zone */
    #requirementChoice(zone) {
        const select = document.createElement('select');
        select.setAttribute('aria-label', `Requirement of ${zone.name}`);
        select.append(new Option('nothing required', NONE), ...this.#requirements.map(({name}) => new Option(name, name)));
        select.value = zone.requirement ?? NONE;
        select.addEventListener('change', () =>
            this.app.ask({setZone: {measurement: zone.measurement, requirement: select.value}}),
        );
        return select;
    }

    /** @param {Requirement} row */
    #requirementRow(row) {
        const line = document.createElement('tr');
        const head = document.createElement('th');
        head.scope = 'row';
        head.textContent = row.name;
        line.append(head);
        for (const value of COLUMNS.map((key) => row[key])) {
            const cell = document.createElement('td');
            cell.textContent = value === undefined ? '–' : String(Number(value.toPrecision(4)));
            line.append(cell);
        }
        const actions = document.createElement('td');
        if (this.app.mayEdit) {
            actions.append(
                smallButton('✎', `Edit requirement ${row.name}`, () => this.#edit(row)),
                smallButton('×', `Remove requirement ${row.name}`, () => this.app.ask({removeRequirement: {name: row.name}})),
            );
        }
        line.append(actions);
        return line;
    }

    /** @param {Requirement} row */
    #edit(row) {
        for (const [key, value] of Object.entries(row)) {
            const field = document.getElementById(`requirement-${key}`);
            if (field instanceof HTMLInputElement) {
                field.value = typeof value === 'number' ? String(Number(value.toPrecision(4))) : value;
            }
        }
        byId('requirement-name', HTMLInputElement).focus();
    }
}
