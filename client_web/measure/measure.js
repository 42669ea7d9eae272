// SPDX-License-Identifier: Apache-2.0
// Measuring by clicking: values with their error that stay at their points.

import {announce, byId, fileName, saveFile, smallButton, whileAsked} from '../ui/elements.js';
import {csvCell} from './grid.js';
import {Anchor} from '../scene/anchor.js';
import {estimated, inUnit, measured, noteOf, plusMinus, plusMinusCell} from '../ui/units.js';
import {length, sub} from '../ui/vector.js';
import {remember, remembered} from '../camera/walking.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('../picture/marks.js').Marks} Marks
 * @typedef {import('./display_panel.js').DisplayPanel} DisplayPanel
 * @typedef {import('../camera/pointer_control.js').Point} Point
 * @typedef {import('../net/measure_types.js').ProbeResult} ProbeResult
 * @typedef {import('../net/scene_types.js').Vec3} Vec3
 * @typedef {import('../ui/units.js').IlluminanceUnit} IlluminanceUnit
 * @typedef {{probe: ProbeResult, laid: Vec3, anchor: Anchor}} KeptPoint
 * @typedef {{number: number, probe: ProbeResult, laid: Vec3, position: Vec3, anchor: Anchor, text: string, mark: HTMLElement, row: HTMLTableRowElement}} MeasuredPoint
 */

const MAX_POINTS = 40;
const REFRESH_MS = 1000;
/** Of the newest points, so many are measured again each time. */
const MAX_REFRESHED = 8;
/** A probe further from the point than this has met something else, metres. */
const SAME_PLACE = 0.05;

/**
 * Where this browser keeps the points of a scene.
 *
 * @param {import('../scene/scene_model.js').SceneModel} scene
 */
const keyOf = ({name, bounds}) => `points of ${name} ${JSON.stringify(bounds)}`;

/**
 * @param {string | null} text  as kept
 * @returns {KeptPoint[]} none where it cannot be read
 */
export function keptPoints(text) {
    try {
        const kept = JSON.parse(text ?? '[]');
        return kept.map((/** @type {any} */ {probe, laid, anchor}) => ({
            probe,
            laid,
            anchor: Object.assign(new Anchor(null), anchor),
        }));
    } catch {
        return [];
    }
}

/**
 * Events: `unit`, when illuminance is shown in another one; `points`, when there are more or fewer; `values`,
 * when one says something else.
 */
export class Measuring extends EventTarget {
    /** @type {MeasuredPoint[]} */
    points = [];
    /** @type {IlluminanceUnit} */
    unit = 'lx';
    #next = 1;
    #refreshing = false;
    #scene = '';
    #table = byId('points', HTMLTableElement);

    /**
     * @param {RaybundleApp} app
     * @param {Marks} marks
     * @param {DisplayPanel} display
     */
    constructor(app, marks, display) {
        super();
        this.app = app;
        this.marks = marks;
        this.#addButtons(display);
        app.on('tool', (tool) => {
            byId('points-choose', HTMLElement).hidden = tool === 'measure';
            byId('points-click', HTMLElement).hidden = tool !== 'measure';
        });
        app.on('moved', () => this.#follow());
        app.on('welcome', () => this.#welcomed());
        setInterval(() => this.#refresh(), REFRESH_MS);
        addEventListener('pagehide', () => this.#keep());
    }

    /** Points go with the objects that they have been measured on. */
    #follow() {
        for (const point of this.points) {
            point.position = point.anchor.carry(this.app.scene)(point.laid);
        }
    }

    /** Points of another scene mean nothing in this one; those of this one are there again. */
    #welcomed() {
        const key = this.app.scene ? keyOf(this.app.scene) : '';
        if (key !== this.#scene) {
            this.#scene = '';  // what goes now is not forgotten
            [...this.points].forEach((point) => this.#remove(point));
            keptPoints(remembered(key)).forEach((kept) => this.#add(kept));
            this.#scene = key;
            this.#showLists();
        }
        this.#follow();
    }

    /** Keeps the points in this browser, for when the page or the server begins anew. */
    #keep() {
        if (this.#scene) {
            remember(this.#scene, JSON.stringify(this.points.map(({probe, laid, anchor}) => ({probe, laid, anchor}))));
        }
    }

    /**
     * Measures what the picture shows at a point.
     *
     * @param {Point} at
     */
    async measureAt(at) {
        const probe = await whileAsked(this.app.picture.element, at, this.app.probeAt(at));
        if (!probe?.position) {
            this.app.status.notify('There is no surface at this point of the picture.');
            return;
        }
        while (this.points.length >= MAX_POINTS) {
            this.#remove(this.points[0]);
        }
        const anchor = new Anchor(this.app.scene?.object(probe.object));
        const point = this.#add({probe, laid: probe.position, anchor});
        this.#showLists();
        announce(`Point ${point.number}: ${point.text}`);
    }

    /** @param {KeptPoint} kept */
    #add({probe, laid, anchor}) {
        const number = this.#next++;
        const mark = document.createElement('div');
        mark.className = 'probe';
        const badge = document.createElement('b');
        badge.textContent = String(number);
        mark.append(badge, document.createElement('span'));
        const row = document.createElement('tr');
        const point = {number, probe, laid, position: laid, anchor, text: '', mark, row};
        const cells = Array.from({length: 5}, () => row.insertCell());
        cells[0].textContent = String(number);
        cells[4].append(smallButton('×', `Remove point ${number}`, () => this.#remove(point)));
        this.points.push(point);
        this.marks.add(mark, () => point.position);
        this.#table.tBodies[0].append(row);
        this.#write(point);
        return point;
    }

    /** Takes the newest point away. Returns whether there was one. */
    removeLast() {
        const last = this.points.at(-1);
        if (last) {
            this.#remove(last);
        }
        return last !== undefined;
    }

    /** @param {DisplayPanel} display */
    #addButtons(display) {
        const unit = byId('unit', HTMLSelectElement);
        unit.addEventListener('change', () => {
            this.unit = unit.value === 'fc' ? 'fc' : 'lx';
            display.unit = this.unit;
            this.points.forEach((point) => this.#write(point));
            this.dispatchEvent(new Event('unit'));
        });
        byId('clear-points', HTMLElement).addEventListener('click', () => {
            [...this.points].forEach((point) => this.#remove(point));
        });
        byId('points-csv', HTMLElement).addEventListener('click', () => this.#savePoints());
    }

    /** @param {MeasuredPoint} point */
    #write(point) {
        const {probe, mark, row} = point;
        const {illuminance = 0, luminance = 0, relativeError} = probe;
        point.text = measured(illuminance, this.unit, relativeError);
        const text = mark.lastElementChild;
        if (text) {
            const [value, ...doubt] = point.text.split(',');
            const why = document.createElement('span');
            why.className = 'doubt';
            why.textContent = doubt.map((part) => `,${part}`).join('');
            text.replaceChildren(value, why);
        }
        const cells = [
            estimated(inUnit(illuminance, this.unit), this.unit, relativeError),
            estimated(luminance, '', relativeError),
            plusMinus(relativeError),
        ];
        cells.forEach((content, i) => {
            row.cells[i + 1].textContent = content;
        });
        this.dispatchEvent(new Event('values'));
    }

    /** @param {MeasuredPoint} point */
    #remove(point) {
        const focused = point.row.contains(document.activeElement);
        const next = point.row.nextElementSibling ?? point.row.previousElementSibling;
        this.points = this.points.filter((other) => other !== point);
        this.marks.remove(point.mark);
        point.row.remove();
        this.#showLists();
        if (focused) {
            (next?.querySelector('button') ?? this.app.picture.element).focus({preventScroll: true});
        }
    }

    #showLists() {
        const none = this.points.length === 0;
        this.#table.hidden = none;
        byId('points-none', HTMLElement).hidden = !none;
        byId('clear-points', HTMLButtonElement).disabled = none;
        byId('points-csv', HTMLButtonElement).disabled = none;
        this.#keep();
        this.dispatchEvent(new Event('points'));
        this.dispatchEvent(new Event('values'));
    }

    /** Measures again what is in view, since light settles and objects move. */
    async #refresh() {
        const {client, picture} = this.app;
        if (this.#refreshing || client.state !== 'connected' || document.hidden) {
            return;
        }
        this.#refreshing = true;
        for (const point of this.points.slice(-MAX_REFRESHED)) {
            const {x, y, depth} = this.app.project(point.position);
            const {clientWidth, clientHeight} = picture.element;
            if (depth > 0 && x >= 0 && y >= 0 && x < clientWidth && y < clientHeight) {
                const probe = await this.app.probeAt({x, y});
                const found = probe?.position;
                if (probe && found && length(sub(found, point.position)) < SAME_PLACE) {
                    point.probe = probe;
                    this.#write(point);
                }
            }
        }
        this.#refreshing = false;
    }

    #savePoints() {
        const {unit} = this;
        const head = `point,x_m,y_m,z_m,illuminance_${unit},luminance_cd_m2,plus_minus_95_percent,object,after_change,note`;
        const lines = this.points.map(({number, position, probe}) => {
            const place = [position.x, position.y, position.z].map((value) => value.toFixed(4));
            const object = this.app.scene?.object(probe.object)?.name ?? '';
            const light = [inUnit(probe.illuminance ?? NaN, unit), probe.luminance ?? NaN];
            const values = light.map((value) => (Number.isFinite(value) ? value.toPrecision(6) : ''));
            values.push(plusMinusCell(probe.relativeError));
            const last = [csvCell(object), probe.epoch, noteOf(probe.relativeError)];
            return [number, ...place, ...values, ...last].join(',');
        });
        const text = `${[head, ...lines].join('\r\n')}\r\n`;
        const name = fileName(`${this.app.scene?.title} points`);
        saveFile(new Blob([text], {type: 'text/csv'}), `${name}.csv`);
    }
}
