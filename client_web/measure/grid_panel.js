// SPDX-License-Identifier: Apache-2.0
// A grid of measured points: on which surface, what they say together, and their dots in the picture. It
// goes with the object that it lies on, and is measured again while light settles.

import {scaleColour} from './colour.js';
import {byId, fileName, saveFile, showValue} from '../ui/elements.js';
import {
    carriedGrid, faceName, gridCsv, gridOn, intervalsOf, mainFace, measuredAgain, pointsOf, spreadOver, summaryOf,
    typicalError, uniformityText,
} from './grid.js';
import {SETTLED} from '../lights/light_state.js';
import {Anchor} from '../scene/anchor.js';
import {svgElement} from '../ui/svg.js';
import {NOT_YET, UNCERTAIN, estimated, inUnit, plusMinus} from '../ui/units.js';
import {corners, length, sub} from '../ui/vector.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('./measure.js').Measuring} Measuring
 * @typedef {import('./display_panel.js').DisplayPanel} DisplayPanel
 * @typedef {import('../net/measure_types.js').ProbeResult} ProbeResult
 * @typedef {import('../scene/scene_model.js').PlacedObject} PlacedObject
 * @typedef {object} ShownGrid
 * @property {import('./grid.js').Grid} grid  where it is now
 * @property {import('./grid.js').Grid} laid  where it was laid
 * @property {Anchor} anchor
 * @property {import('../net/measure_types.js').ProbeGridResult} result
 * @property {string} surface  that it lies on, for people
 * @property {boolean} settled  whether the light was
 * @property {boolean} outdated  whether something has changed since
 * @property {number | null} iterations  of the light, when it was measured
 * @property {string} scene
 */

/** Choice of the selected object; those of points are their numbers. */
const SELECTED = 'selected';
/** A selected object is looked for at so many places squared, fewer than the server lets wait. */
const PLACES_PER_SIDE = 6;
const RENEW_MS = 2000;
/** What moves by less has not moved, metres. */
const STILL = 1e-6;
const NOTHING =
    'There is no surface yet: select an object, or choose Measure below the picture and click the surface.';

export class GridPanel {
    /** @type {ShownGrid | null} */
    shown = null;
    #surface = byId('grid-surface', HTMLSelectElement);
    #button = byId('measure-grid', HTMLButtonElement);
    #state = byId('grid-state', HTMLElement);
    #renewing = false;

    /**
     * @param {RaybundleApp} app
     * @param {Measuring} measuring
     * @param {DisplayPanel} display
     */
    constructor(app, measuring, display) {
        this.app = app;
        this.measuring = measuring;
        this.#addButtons();
        this.#addDots(display);
        app.on('selection', (object) => this.#list(object ? SELECTED : ''));
        measuring.addEventListener('points', () => this.#list(String(measuring.points.at(-1)?.number ?? '')));
        measuring.addEventListener('unit', () => this.#show());
        app.on('moved', () => this.#follow());
        app.on('sceneChanged', () => this.#follow());
        app.on('welcome', () => this.#follow());
        setInterval(() => this.#renew(), RENEW_MS);
        this.#list('');
    }

    /** Measures a grid on the chosen surface. */
    async measure() {
        const {scene} = this.app;
        if (!scene || this.#surface.value === '') {
            this.#state.textContent = NOTHING;
            return;
        }
        this.#button.disabled = true;
        this.#state.setAttribute('aria-live', 'polite');
        this.#state.textContent = 'Measuring …';
        const problem = await this.#measureOn(this.#surface.value, scene);
        this.#button.disabled = false;
        this.#show();
        if (problem) {
            this.#state.textContent = problem;
        }
    }

    /**
     * @param {string} chosen
     * @param {import('../scene/scene_model.js').SceneModel} scene
     * @returns {Promise<string>} what went wrong; empty: nothing
     */
    async #measureOn(chosen, scene) {
        const {selected} = this.app;
        const hit =
            chosen === SELECTED && selected
                ? await this.#faceOf(selected)
                : this.measuring.points.find(({number}) => String(number) === chosen)?.probe;
        if (!hit?.position || !hit.normal) {
            return `The picture does not show ${selected?.name}: turn to it, then measure again.`;
        }
        const object = scene.object(hit.object);
        const step = Number(byId('grid-step', HTMLSelectElement).value);
        const grid = gridOn(hit.position, hit.normal, object?.bounds ?? scene.bounds, step);
        const anchor = new Anchor(object);
        const result = (await this.app.ask({probeGrid: grid}))?.probeGridResult;
        if (!result) {
            return 'The grid could not be measured.';
        }
        const surface = `${object?.name ?? 'Surface'}, ${faceName(hit.normal)}`;
        this.shown = {grid, laid: grid, anchor, result, surface, scene: scene.name, ...this.#light()};
        this.#follow();
        return '';
    }

    /** What is known of the light that a grid is measured in now. */
    #light() {
        const {settled, iterations} = this.app.stats;
        return {settled: settled >= SETTLED, iterations, outdated: false};
    }

    /** Takes the grid to where the object now is that it lies on. */
    #follow() {
        const {shown} = this;
        const {scene} = this.app;
        if (!shown || !scene) {
            return;
        }
        if (shown.scene !== scene.name) {
            this.shown = null;
            this.#show();
            return;
        }
        const grid = carriedGrid(shown.laid, shown.anchor.carry(scene));
        const parts = /** @type {const} */ (['origin', 'stepX', 'stepY']);
        const moved = parts.some((part) => length(sub(grid[part], shown.grid[part])) > STILL);
        if (moved || (!shown.outdated && shown.result.epoch !== scene.epoch)) {
            this.shown = {...shown, grid, outdated: true};
            this.#state.setAttribute('aria-live', 'off');
            this.#show();
        }
    }

    /** Measures again what is in view, where there is news of its light. */
    async #renew() {
        const {shown, app} = this;
        const idle = app.client.state !== 'connected' || document.hidden || this.#renewing;
        if (!shown || idle || app.mover.held !== null || app.camera.moving) {
            return;
        }
        if (!shown.outdated && shown.iterations === app.stats.iterations) {
            return;
        }
        this.#renewing = true;
        const light = this.#light();
        // That it cannot be measured now is nothing to tell: its state says that it is not up to date.
        const answer = await app.client.request({probeGrid: shown.grid}).answer.catch(() => null);
        this.#renewing = false;
        const result = answer?.probeGridResult && measuredAgain(shown.result, answer.probeGridResult);
        if (result && this.shown === shown) {
            this.shown = {...shown, result, ...light, outdated: result.epoch !== app.scene?.epoch};
            this.#state.setAttribute('aria-live', 'off');
            this.#show();
        }
    }

    /**
     * Looks for an object where the picture may show it.
     *
     * @param {PlacedObject} object
     * @returns {Promise<(ProbeResult & import('./grid.js').Hit) | null>} a point of its largest face
     */
    async #faceOf(object) {
        const {app} = this;
        const {clientWidth, clientHeight} = app.picture.element;
        const around = corners(object.bounds).map((corner) => app.project(corner));
        const places = spreadOver(around, clientWidth, clientHeight, PLACES_PER_SIDE);
        const probes = await Promise.all(places.map((at) => app.probeAt(at)));
        const hits = probes.flatMap((probe) => {
            const {position, normal} = probe ?? {};
            return probe && position && normal && probe.object === object.id
                ? [{...probe, position, normal}]
                : [];
        });
        return mainFace(hits);
    }

    #addButtons() {
        this.#button.addEventListener('click', () => this.measure());
        byId('clear-grid', HTMLElement).addEventListener('click', () => {
            this.shown = null;
            this.#show();
            this.#button.focus({preventScroll: true});
        });
        byId('grid-csv', HTMLElement).addEventListener('click', () => {
            if (this.shown) {
                const {grid, result, surface} = this.shown;
                const name = fileName(`${this.app.scene?.title} ${surface} grid`);
                saveFile(new Blob([gridCsv(grid, result, this.measuring.unit)], {type: 'text/csv'}), `${name}.csv`);
            }
        });
    }

    /**
     * Offers the surfaces that have been picked: the selected object, and those under the points.
     *
     * @param {string} newest  taken, where it is offered
     */
    #list(newest) {
        const {selected, scene} = this.app;
        const before = this.#surface.value;
        const options = this.measuring.points.map(({number, probe}) => {
            const name = scene?.object(probe.object)?.name ?? 'surface';
            return new Option(`${name} at point ${number}`, String(number));
        });
        if (selected) {
            options.push(new Option(`${selected.name} (selected)`, SELECTED));
        }
        options.reverse();
        this.#surface.disabled = options.length === 0;
        this.#surface.replaceChildren(...(options.length > 0 ? options : [new Option('nothing picked yet', '')]));
        const wanted = [newest, before].find((value) => value && options.some((o) => o.value === value));
        this.#surface.value = wanted ?? options[0]?.value ?? '';
        if (this.#state.textContent === NOTHING && options.length > 0) {
            this.#state.textContent = '';
        }
    }

    #show() {
        const summary = this.shown ? summaryOf(this.shown.result.illuminance) : null;
        byId('grid-result', HTMLElement).hidden = summary === null;
        byId('grid-actions', HTMLElement).hidden = this.shown === null;
        this.#state.textContent = this.shown ? stateOf(this.shown) : '';
        if (summary) {
            const {unit} = this.measuring;
            const errors = this.shown?.result.relativeError ?? [];
            const error = typicalError(errors);
            const intervals = intervalsOf(this.shown?.result.illuminance ?? [], errors);
            const show = (/** @type {number} */ lux) => estimated(inUnit(lux, unit), unit, error);
            showValue('gridMin', show(summary.minimum));
            showValue('gridMean', show(summary.mean));
            showValue('gridMax', show(summary.maximum));
            showValue('gridMeanInterval', intervals ? plusMinus(intervals.meanError) : NOT_YET);
            showValue('gridUniformity', uniformityText(summary, intervals));
            showValue('gridUniformityInterval', intervals ? between(intervals.uniformity) : '');
        }
        this.app.drawOverlay();
    }

    /**
     * Dots of the grid, coloured by their value, on the scale of the picture where it has the same.
     *
     * @param {DisplayPanel} display
     */
    #addDots(display) {
        const group = this.app.overlay.group('grid-points');
        this.app.overlay.add(({place}) => {
            if (!this.shown) {
                group.replaceChildren();
                return;
            }
            const {grid, result, outdated} = this.shown;
            group.classList.toggle('outdated', outdated);
            const scale = display.showsIlluminance ? this.app.frame?.scaleMaximum : undefined;
            const linear = scale !== undefined && (this.app.frame?.scaleLinear ?? false);
            const top = scale ?? Math.max(...result.illuminance, 1e-3);
            const points = pointsOf(grid);
            while (group.childElementCount < points.length) {
                group.append(svgElement('circle'));
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
                const colour = measured ? scaleColour(result.illuminance[i], top, linear) : 'none';
                dot.setAttribute('fill', colour);
            });
        });
    }
}

/**
 * @param {import('./grid.js').Interval} interval
 * @returns {string} e.g. "0.58 to 0.64"
 */
const between = ({low, high}) => `${low.toFixed(2)} to ${high.toFixed(2)}`;

/**
 * How far a grid can be relied on.
 *
 * @param {ShownGrid} shown
 * @returns {string}
 */
export function stateOf({grid, result, surface, settled, outdated}) {
    const seen = summaryOf(result.illuminance)?.measured ?? 0;
    const total = grid.columns * grid.rows;
    const size = `${surface}: ${grid.columns} × ${grid.rows} points, ${length(grid.stepX).toFixed(2)} m apart.`;
    if (seen === 0) {
        return `${size} None of them is in view: turn until the picture shows this surface.`;
    }
    if (outdated) {
        return `${size} The light has changed since: new values come as soon as the picture shows this surface.`;
    }
    const error = plusMinus(typicalError(result.relativeError));
    const unknown = [NOT_YET, UNCERTAIN].includes(error);
    const known = unknown ? `Most values are ${UNCERTAIN}: Uo is ${NOT_YET}.` : `Typical error ${error}.`;
    const settling = settled ? '' : ' The light is still settling.';
    const later = unknown || !settled ? ' Better values come by themselves.' : '';
    return `${size} ${seen} of ${total} are in view. ${known}${settling}${later}`;
}
