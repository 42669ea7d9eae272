// SPDX-License-Identifier: Apache-2.0
// Measuring by clicking: values with their error that stay at their points, and grids on a surface.

import {onScale, turbo} from './colour.js';
import {announce, byId, fileName, saveFile, showValue, smallButton} from './elements.js';
import {csvCell, gridCsv, gridOn, pointsOf, summaryOf, typicalError} from './grid.js';
import {SETTLED} from './readouts.js';
import {illuminance as inLux, inUnit, plusMinus, threeDigits} from './units.js';
import {length, sub} from './vector.js';

/**
 * @typedef {import('./app.js').RaybundleApp} RaybundleApp
 * @typedef {import('./marks.js').Marks} Marks
 * @typedef {import('./display_panel.js').DisplayPanel} DisplayPanel
 * @typedef {import('./pointer_control.js').Point} Point
 * @typedef {import('./protocol.js').ProbeResult} ProbeResult
 * @typedef {import('./protocol.js').Vec3} Vec3
 * @typedef {import('./units.js').IlluminanceUnit} IlluminanceUnit
 * @typedef {{number: number, probe: ProbeResult, position: Vec3, mark: HTMLElement, row: HTMLTableRowElement}} MeasuredPoint
 */

const MAX_POINTS = 40;
const REFRESH_MS = 1000;
/** Of the newest points, so many are measured again each time. */
const MAX_REFRESHED = 8;
/** A probe further from the point than this has met something else, metres. */
const SAME_PLACE = 0.05;
const SVG = 'http://www.w3.org/2000/svg';

/** Event: `unit`, when illuminance is shown in another one. */
export class Measuring extends EventTarget {
    /** @type {MeasuredPoint[]} */
    points = [];
    /** @type {{grid: import('./grid.js').Grid, result: import('./protocol.js').ProbeGridResult, object: string, settled: boolean} | null} */
    grid = null;
    /** @type {IlluminanceUnit} */
    unit = 'lx';
    #next = 1;
    #refreshing = false;
    #table = byId('points', HTMLTableElement);
    #gridButton = byId('measure-grid', HTMLButtonElement);

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
        this.#addGridDots(display);
        setInterval(() => this.#refresh(), REFRESH_MS);
    }

    /**
     * Measures what the picture shows at a point.
     *
     * @param {Point} at
     */
    async measureAt(at) {
        const probe = await this.app.probeAt(at);
        if (!probe?.position) {
            this.app.status.notify('There is no surface at this point of the picture.');
            return;
        }
        while (this.points.length >= MAX_POINTS) {
            this.#remove(this.points[0]);
        }
        const number = this.#next++;
        const mark = document.createElement('div');
        mark.className = 'probe';
        const badge = document.createElement('b');
        badge.textContent = String(number);
        mark.append(badge, document.createElement('span'));
        const row = document.createElement('tr');
        const point = {number, probe, position: probe.position, mark, row};
        const cells = Array.from({length: 5}, () => row.insertCell());
        cells[0].textContent = String(number);
        cells[4].append(smallButton('×', `Remove point ${number}`, () => this.#remove(point)));
        this.points.push(point);
        this.marks.add(mark, () => point.position);
        this.#table.tBodies[0].append(row);
        this.#write(point);
        this.#showLists();
        announce(`Point ${number}: ${mark.lastElementChild?.textContent}`);
    }

    /** Measures a grid on the surface under the last point. */
    async measureGrid() {
        const point = this.points.at(-1);
        const {position, normal, object: id} = point?.probe ?? {};
        const {scene} = this.app;
        if (!position || !normal || !scene) {
            return;
        }
        const object = scene.object(id);
        const step = Number(byId('grid-step', HTMLSelectElement).value);
        const grid = gridOn(position, normal, object?.bounds ?? scene.bounds, step);
        const {origin, stepX, stepY, columns, rows} = grid;
        this.#gridButton.disabled = true;
        byId('grid-state', HTMLElement).textContent = 'Measuring …';
        const answer = await this.app.ask({probeGrid: {origin, stepX, stepY, columns, rows}});
        this.#gridButton.disabled = false;
        const result = answer?.probeGridResult;
        if (!result) {
            byId('grid-state', HTMLElement).textContent = 'This server cannot measure grids.';
            return;
        }
        const settled = this.app.stats.settled >= SETTLED;
        this.grid = {grid, result, object: object?.name ?? 'surface', settled};
        this.#showGrid();
    }

    /** @param {DisplayPanel} display */
    #addButtons(display) {
        const unit = byId('unit', HTMLSelectElement);
        unit.addEventListener('change', () => {
            this.unit = unit.value === 'fc' ? 'fc' : 'lx';
            display.unit = this.unit;
            this.points.forEach((point) => this.#write(point));
            this.#showGrid();
            this.dispatchEvent(new Event('unit'));
        });
        byId('clear-points', HTMLElement).addEventListener('click', () => {
            [...this.points].forEach((point) => this.#remove(point));
        });
        byId('points-csv', HTMLElement).addEventListener('click', () => this.#savePoints());
        this.#gridButton.addEventListener('click', () => this.measureGrid());
        byId('clear-grid', HTMLElement).addEventListener('click', () => {
            this.grid = null;
            this.#showGrid();
        });
        byId('grid-csv', HTMLElement).addEventListener('click', () => {
            if (this.grid) {
                const {grid, result, object} = this.grid;
                const name = fileName(`${this.app.scene?.title} ${object} grid`);
                saveFile(new Blob([gridCsv(grid, result)], {type: 'text/csv'}), `${name}.csv`);
            }
        });
    }

    /** @param {MeasuredPoint} point */
    #write({probe, mark, row}) {
        const value = inLux(probe.illuminance ?? 0, this.unit);
        const error = plusMinus(probe.relativeError);
        const text = mark.lastElementChild;
        if (text) {
            text.textContent = `${value} ${error}`;
        }
        [value, threeDigits(probe.luminance ?? 0), error].forEach((content, i) => {
            row.cells[i + 1].textContent = content;
        });
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
        this.#gridButton.disabled = none;
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
        const head = 'point,x_m,y_m,z_m,illuminance_lx,luminance_cd_m2,relative_standard_error,object,epoch';
        const lines = this.points.map(({number, position, probe}) => {
            const place = [position.x, position.y, position.z].map((value) => value.toFixed(4));
            const object = this.app.scene?.object(probe.object)?.name ?? '';
            const light = [probe.illuminance, probe.luminance, probe.relativeError];
            const values = light.map((value) => value?.toPrecision(6) ?? '');
            return [number, ...place, ...values, csvCell(object), probe.epoch].join(',');
        });
        const text = `${[head, ...lines].join('\r\n')}\r\n`;
        const name = fileName(`${this.app.scene?.title} points`);
        saveFile(new Blob([text], {type: 'text/csv'}), `${name}.csv`);
    }

    #showGrid() {
        const summary = this.grid ? summaryOf(this.grid.result.illuminance) : null;
        byId('grid-result', HTMLElement).hidden = summary === null;
        byId('grid-actions', HTMLElement).hidden = this.grid === null;
        const state = byId('grid-state', HTMLElement);
        state.textContent = '';
        if (this.grid) {
            const {grid, object} = this.grid;
            const total = grid.columns * grid.rows;
            const step = length(grid.stepX).toFixed(2);
            const seen = `${summary?.measured ?? 0} of ${total} points are in view`;
            const error = plusMinus(typicalError(this.grid.result.relativeError));
            const later = this.grid.settled ? '' : ' The light was still settling: measure again later.';
            state.textContent =
                `${object}: ${grid.columns} × ${grid.rows} points, ${step} m apart. ${seen}, ` +
                `typically ${error}.${later}`;
        }
        if (summary) {
            const show = (/** @type {number} */ lux) =>
                `${threeDigits(inUnit(lux, this.unit))} ${this.unit}`;
            showValue('gridMin', show(summary.minimum));
            showValue('gridMean', show(summary.mean));
            showValue('gridMax', show(summary.maximum));
            showValue('gridUniformity', summary.uniformity.toFixed(2));
        }
        this.app.drawOverlay();
    }

    /**
     * Dots of the grid, coloured by their value, on the scale of the picture where it has the same.
     *
     * @param {DisplayPanel} display
     */
    #addGridDots(display) {
        const group = this.app.overlay.group('grid-points');
        this.app.overlay.add(({place}) => {
            if (!this.grid) {
                group.replaceChildren();
                return;
            }
            const {grid, result} = this.grid;
            const scale = display.mode === 'FALSE_ILLUMINANCE' ? this.app.frame?.scaleMaximum : undefined;
            const top = scale ?? Math.max(...result.illuminance, 1e-3);
            const points = pointsOf(grid);
            while (group.childElementCount < points.length) {
                group.append(document.createElementNS(SVG, 'circle'));
            }
            while (group.childElementCount > points.length) {
                group.lastElementChild?.remove();
            }
            points.forEach((point, i) => {
                const {x, y, depth} = place(point);
                const dot = group.children[i];
                const measured = result.illuminance[i] >= 0;
                dot.setAttribute('r', depth > 0.02 ? (measured ? '4.5' : '2') : '0');
                dot.setAttribute('cx', x.toFixed(1));
                dot.setAttribute('cy', y.toFixed(1));
                dot.setAttribute('class', measured ? 'measured' : 'unseen');
                const colour = measured ? turbo(onScale(result.illuminance[i], top)) : 'none';
                dot.setAttribute('fill', colour);
            });
        });
    }
}
