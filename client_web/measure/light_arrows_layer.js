// SPDX-License-Identifier: Apache-2.0
// Over the picture, where somebody wants them: an arrow at each calculation point of the zones and the work plane, along
// which light flows there on balance. One measurement has the points of all; the server sends it again as the light changes.

import {arrowPath, arrowPoints, arrowRequest, lightArrows} from './light_arrows.js';
import {valueText} from './work_plane.js';
import {ServerError} from '../net/protocol.js';
import {byId} from '../ui/elements.js';
import {sentence} from '../ui/status.js';
import {svgElement} from '../ui/svg.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('./measure.js').Measuring} Measuring
 * @typedef {import('../net/measure_types.js').Measured} Measured
 * @typedef {import('../picture/overlay.js').OverlayFrame} OverlayFrame
 * @typedef {import('./work_plane_panel.js').WorkPlanePanel} WorkPlanePanel
 * @typedef {import('./zones_panel.js').ZonesPanel} ZonesPanel
 */

/** Nearer to the eye's plane nothing is drawn, metres. */
const NEAR = 0.02;

export class LightArrowsLayer {
    #wanted = byId('light-arrows', HTMLInputElement);
    #state = byId('light-arrows-state', HTMLElement);
    /** What the server measures for the arrows. @type {Measured | null} */
    #result = null;
    /** The areas that arrows are wanted for, as they were looked at last. @type {Measured[]} */
    #areas = [];
    /** The points that the server measures, or is asked to; empty: none. */
    #asked = '';
    /** Number of those that were made: an answer counts if it is that of the last one. */
    #requests = 0;
    /** @type {ReturnType<typeof lightArrows>} */
    #drawn = {arrows: [], most: 0};

    /**
     * @param {RaybundleApp} app
     * @param {Measuring} measuring
     * @param {WorkPlanePanel} plane
     * @param {ZonesPanel} zones
     */
    constructor(app, measuring, plane, zones) {
        this.app = app;
        this.measuring = measuring;
        this.plane = plane;
        this.zones = zones;
        this.group = app.overlay.group('light-arrows');
        this.#wanted.addEventListener('change', () => this.#follow());
        app.on('welcome', () => {
            this.#take(null);  // it went with the connection
            this.#areas = [];
            this.#asked = '';
            ++this.#requests;
            this.#follow();
        });
        app.on('message', ({measured}) => {
            if (measured && measured.measurement === this.#result?.measurement) {
                this.#take(measured);
            }
        });
        measuring.addEventListener('unit', () => this.#tell());
        app.overlay.add((frame) => this.#draw(frame));
    }

    /** Asks for the points that there are now, where they are others than before. */
    #follow() {
        const {list} = this.zones;
        const all = [...list, ...(this.plane.result ? [this.plane.result] : [])];
        byId('light-arrows-field', HTMLElement).hidden = all.length === 0;
        const areas = this.#wanted.checked ? all : [];
        if (areas.length === this.#areas.length && areas.every((area, i) => area === this.#areas[i])) {
            return;
        }
        this.#areas = areas;
        const points = arrowPoints(areas);
        const wanted = points.length > 0 ? JSON.stringify(points) : '';
        if (wanted === this.#asked) {
            return;
        }
        this.#asked = wanted;
        ++this.#requests;
        const old = this.#result;
        this.#take(null);
        if (old) {
            this.app.client.request({removeMeasurement: {measurement: old.measurement}}).answer.catch(() => null);
        }
        if (wanted) {
            this.#ask(points);
        }
    }

    /**
     * @param {import('../net/scene_types.js').Vec3[]} points
     */
    async #ask(points) {
        const request = this.#requests;
        this.#say('Measuring where light comes from …');
        try {
            const {measured} = await this.app.client.request({measure: arrowRequest(points)}).answer;
            if (request === this.#requests) {
                this.#take(measured ?? null);
            } else if (measured) {  // others are wanted since
                this.app.client.request({removeMeasurement: {measurement: measured.measurement}}).answer.catch(() => null);
            }
        } catch (error) {
            if (request === this.#requests) {
                this.#say(error instanceof ServerError ? sentence(error.message) : 'The connection was lost.');
            }
        }
    }

    /** @param {Measured | null} measured */
    #take(measured) {
        this.#result = measured;
        this.#drawn = measured ? lightArrows(measured) : {arrows: [], most: 0};
        this.#tell();
        this.app.drawOverlay();
    }

    #tell() {
        const {arrows, most} = this.#drawn;
        const text = valueText('HORIZONTAL', this.measuring.unit);
        this.#say(arrows.length === 0 ? '' : most > 0
            ? `Arrows point along the light; the longest stands for ${text(most)} more from its side than from the other.`
            : 'No light arrives there.');
    }

    /** @param {string} words */
    #say(words) {
        this.#state.textContent = words;
        this.#state.hidden = words === '';
    }

    /** @param {OverlayFrame} frame */
    #draw({place}) {
        this.#follow();
        this.group.replaceChildren(...this.#drawn.arrows.flatMap(({from, to}) => {
            const [tail, tip] = [place(from), place(to)];
            const path = Math.min(tail.depth, tip.depth) > NEAR ? arrowPath(tail, tip) : '';
            return path ? [svgElement('path', {class: 'halo', d: path}), svgElement('path', {class: 'stroke', d: path})] : [];
        }));
    }
}
