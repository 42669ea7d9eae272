// SPDX-License-Identifier: Apache-2.0
// Over the picture: the outlines of zones, each with its name and whether it meets what is required, that of the work
// plane, and grids of UGR as heat maps.

import {GLARE_LIMITS, glareColour, gridCells, nameSpot, partBeforeEye, pathOf, zoneLabel} from './outlines.js';
import {byId} from '../ui/elements.js';
import {svgElement} from '../ui/svg.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('../net/measure_types.js').Measured} Measured
 * @typedef {import('../picture/overlay.js').OverlayFrame} OverlayFrame
 * @typedef {import('./work_plane_panel.js').WorkPlanePanel} WorkPlanePanel
 * @typedef {import('./zones_panel.js').ZonesPanel} ZonesPanel
 */

export class OutlinesLayer {
    #wanted = byId('zones-in-picture', HTMLInputElement);

    /**
     * @param {RaybundleApp} app
     * @param {WorkPlanePanel} plane
     * @param {ZonesPanel} zones
     */
    constructor(app, plane, zones) {
        this.plane = plane;
        this.zones = zones;
        this.outlines = app.overlay.group('zone-outlines');
        this.map = app.overlay.group('glare-map');
        this.#wanted.addEventListener('change', () => app.drawOverlay());
        app.overlay.add((frame) => this.#draw(frame));
        this.#fillLegend();
    }

    #fillLegend() {
        const steps = GLARE_LIMITS.map((limit) => ({text: `${limit}`, colour: glareColour(limit), title: `at most ${limit}`}));
        const beyond = {text: 'more', colour: glareColour(Infinity), title: `above ${GLARE_LIMITS.at(-1)}`};
        byId('glare-legend', HTMLElement).replaceChildren(...[...steps, beyond].map(({text, colour, title}) => {
            const item = document.createElement('li');
            item.textContent = text;
            item.title = title;
            item.style.setProperty('--step', colour);
            return item;
        }));
    }

    /** @param {OverlayFrame} frame */
    #draw(frame) {
        const zones = this.#wanted.checked ? this.zones.list : [];
        const plane = this.plane.result;
        const rated = [...zones, ...(plane ? [plane] : [])].filter(({quantity}) => quantity === 'UGR');
        byId('glare-legend', HTMLElement).hidden = !rated.some((result) => gridCells(result).length > 0);
        this.map.replaceChildren(...rated.flatMap((result) => this.#cells(result, frame)));
        this.outlines.replaceChildren(
            ...(plane ? this.#outline(plane, 'plane', '', frame) : []),
            ...zones.flatMap((zone) => this.#outline(zone, (zone.verdict ?? '').toLowerCase(), zoneLabel(zone), frame)),
        );
    }

    /**
     * @param {Measured} area
     * @param {string} kind  class
     * @param {string} label
     * @param {OverlayFrame} frame
     */
    #outline({outline = []}, kind, label, {place, width, height}) {
        const corners = partBeforeEye(outline, place);
        const spot = nameSpot(corners, width, height);
        if (!spot) {
            return [];
        }
        const path = pathOf(corners);
        const group = svgElement('g', {class: kind});
        group.append(svgElement('path', {class: 'halo', d: path}), svgElement('path', {class: 'stroke', d: path}));
        if (label) {
            group.append(svgElement('text', {x: spot.x.toFixed(1), y: spot.y.toFixed(1)}, label));
        }
        return [group];
    }

    /**
     * @param {Measured} result  of UGR
     * @param {OverlayFrame} frame
     */
    #cells(result, {place}) {
        return gridCells(result).flatMap((corners, i) => {
            const {inside, value, glare} = result.points[i];
            const path = inside ? '' : pathOf(partBeforeEye(corners, place));
            if (path === '') {
                return [];
            }
            // Where nothing glares, any limit is kept; outside of the method nothing is known.
            const rating = glare?.state === 'NO_SOURCE' ? 0 : value;
            return [svgElement('path', rating === undefined
                ? {d: path, class: 'unrated'}
                : {d: path, fill: glareColour(rating)})];
        });
    }
}
