// SPDX-License-Identifier: Apache-2.0
// A work plane: points in the air that the server measures by themselves, whatever the picture shows, and measures
// again when the light changes.

import {ServerError} from '../net/protocol.js';
import {byId, fileName, saveFile, showValue} from '../ui/elements.js';
import {floorBelow} from '../scene/floors.js';
import {sentence} from '../ui/status.js';
import {areaOver, outlineOver, planeCsv, planeState, valueText, withInterval} from './work_plane.js';
import {svgElement} from '../ui/svg.js';
import {boundsOf} from '../ui/vector.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('./measure.js').Measuring} Measuring
 * @typedef {import('../net/measure_types.js').Measured} Measured
 */

/** Strip along walls that EN 12464-1 leaves out of a room's area, metres. */
const MARGIN = 0.5;
/** Points nearer to the eye's plane are not drawn, metres. */
const NEAR = 0.02;
/** Of more points the picture shows dots, not numbers. */
const MOST_NUMBERS = 150;
/** Corners of an outline. */
const LEAST_CORNERS = 3;

export class WorkPlanePanel {
    /** @type {Measured | null} */
    #result = null;
    #over = byId('plane-over', HTMLSelectElement);
    #state = byId('plane-state', HTMLElement);
    #button = byId('measure-plane', HTMLButtonElement);

    /**
     * @param {RaybundleApp} app
     * @param {Measuring} measuring
     * @param {import('../camera/collisions.js').Collisions} collisions
     */
    constructor(app, measuring, collisions) {
        this.app = app;
        this.measuring = measuring;
        this.collisions = collisions;
        this.#button.addEventListener('click', () => this.measure());
        byId('clear-plane', HTMLElement).addEventListener('click', () => this.#clear());
        byId('plane-csv', HTMLElement).addEventListener('click', () => this.#save());
        app.on('welcome', () => {
            this.#forget();  // a server that was started anew has none
            this.#list();
        });
        app.on('selection', () => this.#list());
        app.on('message', ({measured}) => measured && this.#arrived(measured));
        measuring.addEventListener('unit', () => this.#show());
        measuring.addEventListener('points', () => this.#list());
        this.group = app.overlay.group('plane-points');
        app.overlay.add(({place}) => this.#draw(place));
    }

    /** What has been measured last; null: nothing is shown. */
    get result() {
        return this.#result;
    }

    /** Where a plane may lie: over the selected object, within points on the floor, over a storey, or all there is. */
    #list() {
        const {scene, selected} = this.app;
        const before = this.#over.value;
        const options = [new Option('the whole scene', 'scene')];
        for (const storey of scene?.storeys.keys() ?? []) {
            options.push(new Option(storey, `storey ${storey}`));
        }
        const {points} = this.measuring;
        if (points.length >= LEAST_CORNERS) {
            options.push(new Option(`within points ${points.map(({number}) => number).join(', ')}`, 'points'));
        }
        if (selected) {
            options.unshift(new Option(`${selected.name} (selected)`, 'selected'));
        }
        this.#over.replaceChildren(...options);
        this.#over.value = options.some(({value}) => value === before) && before !== 'scene' ? before : options[0].value;
    }

    /**
     * Where the plane lies that the fields describe, and the height that it is above.
     *
     * @param {import('../scene/scene_model.js').SceneModel} scene
     */
    #place(scene) {
        const over = this.#over.value;
        const {selected} = this.app;
        const corners = this.measuring.points.map(({position}) => position);
        if (over === 'points' && corners.length >= LEAST_CORNERS) {
            const bounds = boundsOf(corners);
            return {bounds, corners, margin: 0, floor: floorBelow(scene.objects, bounds) ?? bounds.min.y};
        }
        if (over === 'selected' && selected) {
            const {bounds} = selected;
            return {bounds, margin: 0, floor: floorBelow(scene.objects, bounds) ?? bounds.min.y};
        }
        const name = over.replace(/^storey /, '');
        const storey = scene.storeys.get(name);
        const bounds = storey ?? scene.bounds;
        const margin = Math.min(MARGIN, 0.2 * (bounds.max.x - bounds.min.x), 0.2 * (bounds.max.z - bounds.min.z));
        return {bounds, margin, floor: this.collisions.floorOf(storey ? name : '')};
    }

    /** What the fields ask for; null: the height is no number. */
    request() {
        const {scene} = this.app;
        const height = byId('plane-height', HTMLInputElement).valueAsNumber;
        if (!scene || !Number.isFinite(height)) {
            return null;
        }
        const {bounds, corners, margin, floor} = this.#place(scene);
        const quantity = byId('plane-quantity', HTMLSelectElement).value;
        return {
            quantity,
            ...(corners ? {outline: outlineOver(corners, floor, height)} : {area: areaOver(bounds, floor, height)}),
            grid: 'EN12464',
            margin,
            relativeError: 0.05,
            keep: true,
            maintained: byId('plane-maintained', HTMLInputElement).checked,
            ...(quantity === 'UGR' ? {directions: 8} : {direct: byId('plane-direct', HTMLInputElement).checked}),
            ...(['VERTICAL', 'SEMICYLINDRICAL'].includes(quantity) ? {direction: this.#heading()} : {}),
        };
    }

    /** Vertical surfaces face who looks at them. */
    #heading() {
        const {eye, target} = this.app.view;
        return {x: eye.x - target.x, y: 0, z: eye.z - target.z};
    }

    /** Measures a plane where the fields say, in place of the one before. */
    async measure() {
        const measure = this.request();
        if (!measure) {
            this.#state.textContent = 'Enter the height as a number.';
            return;
        }
        await this.#remove();
        this.#button.disabled = true;
        this.#state.textContent = 'Measuring …';
        try {
            const {measured} = await this.app.client.request({measure}).answer;
            this.#result = measured ?? null;
            this.#show();
        } catch (error) {
            this.#state.textContent = error instanceof ServerError ? sentence(error.message) : 'The connection was lost.';
        }
        this.#button.disabled = false;
    }

    /** @param {Measured} measured */
    #arrived(measured) {
        if (measured.measurement === this.#result?.measurement) {
            this.#result = measured;
            this.#show();
        }
    }

    async #remove() {
        const old = this.#result;
        this.#forget();
        if (old) {
            await this.app.client.request({removeMeasurement: {measurement: old.measurement}}).answer.catch(() => null);
        }
    }

    #forget() {
        this.#result = null;
        this.#show();
    }

    async #clear() {
        await this.#remove();
        this.#button.focus({preventScroll: true});
    }

    #save() {
        if (this.#result) {
            const unit = {DAYLIGHT_FACTOR: '%', UGR: '1'}[this.#result.quantity] ?? 'lx';
            const blob = new Blob([planeCsv(this.#result, unit)], {type: 'text/csv'});
            saveFile(blob, `${fileName(`${this.app.scene?.title} work plane`)}.csv`);
        }
    }

    #show() {
        const result = this.#result;
        byId('plane-result', HTMLElement).hidden = !result;
        byId('plane-actions', HTMLElement).hidden = !result;
        if (result) {
            const text = valueText(result.quantity, this.measuring.unit);
            const plain = (/** @type {number} */ value) => value.toFixed(2);
            const tiles = {
                Mean: withInterval(result.mean, result.meanLow, result.meanHigh, text),
                Min: withInterval(result.minimum, result.minimumLow, result.minimumHigh, text),
                Max: withInterval(result.maximum, result.maximumLow, result.maximumHigh, text),
                Uniformity: withInterval(result.quantity === 'UGR' ? undefined : result.uniformity, result.uniformityLow, result.uniformityHigh, plain),
            };
            for (const [name, {value, interval}] of Object.entries(tiles)) {
                showValue(`plane${name}`, value);
                showValue(`plane${name}Interval`, interval);
            }
            this.#state.textContent = planeState(result);
        } else {
            this.#state.textContent = '';
        }
        this.app.drawOverlay();
    }

    /** @param {import('../picture/overlay.js').OverlayFrame['place']} place */
    #draw(place) {
        const points = this.#result?.points ?? [];
        const text = valueText(this.#result?.quantity ?? '', this.measuring.unit);
        const numbers = points.length <= MOST_NUMBERS;
        const marks = points.flatMap(({position, value, inside}) => {
            const {x, y, depth} = place(position);
            if (depth <= NEAR || inside || value === undefined) {
                return [];
            }
            const mark = svgElement(numbers ? 'text' : 'circle');
            mark.setAttribute(numbers ? 'x' : 'cx', x.toFixed(1));
            mark.setAttribute(numbers ? 'y' : 'cy', y.toFixed(1));
            if (numbers) {
                mark.textContent = text(value).split(' ')[0];
            } else {
                mark.setAttribute('r', '2.5');
            }
            return [mark];
        });
        this.group.replaceChildren(...marks);
    }
}
