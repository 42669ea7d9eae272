// SPDX-License-Identifier: Apache-2.0
// Glare at the eye from which the picture is seen: the rating, and what glares.

import {ServerError} from '../net/protocol.js';
import {byId} from '../ui/elements.js';
import {sentence} from '../ui/status.js';
import {svgElement} from '../ui/svg.js';
import {threeDigits} from '../ui/units.js';
import {valueText} from './work_plane.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('../net/measure_types.js').MeasuredPoint} MeasuredPoint
 */

const NEAR = 0.02;
/**
 * @param {string} quantity  UGR or DGP
 * @param {MeasuredPoint} point
 * @returns {string} what the rating says
 */
export function glareText(quantity, {value, low, high, glare, inside}) {
    if (inside) {
        return 'You are in a solid: nothing is rated there.';
    }
    if (glare?.state === 'NO_SOURCE') {
        return `${quantity}: no luminaire glares from here.`;
    }
    if (value === undefined || low === undefined || high === undefined) {
        return `${quantity}: no number, this is outside of the method.`;
    }
    const text = valueText(quantity, 'lx');
    return `${quantity} ${text(value)} (${text(low)} to ${text(high)})`;
}

export class GlarePanel {
    /** @type {MeasuredPoint | null} */
    #point = null;
    #value = byId('glare-value', HTMLElement);
    #words = byId('glare-words', HTMLElement);

    /** @param {RaybundleApp} app */
    constructor(app) {
        this.app = app;
        for (const quantity of ['UGR', 'DGP']) {
            byId(`glare-${quantity.toLowerCase()}`, HTMLButtonElement).addEventListener('click', () => this.rate(quantity));
        }
        this.group = app.overlay.group('glare-marks');
        app.overlay.add(({place}) => this.#draw(place));
        app.on('welcome', () => this.#show('', null));
    }

    /**
     * Rates what an eye feels where the camera is.
     *
     * @param {string} quantity  UGR or DGP
     */
    async rate(quantity) {
        const {eye, target} = this.app.view;
        const direction = {x: target.x - eye.x, y: target.y - eye.y, z: target.z - eye.z};
        if (Math.hypot(direction.x, direction.z) < 1e-3 * Math.abs(direction.y)) {
            this.#say('Look ahead: there is no rating for a view straight up or down.');
            return;
        }
        this.#say('Measuring …');
        try {
            const {measured} = await this.app.client.request({
                measure: {quantity, points: [{position: eye}], direction, relativeError: quantity === 'DGP' ? 0.1 : 0.05},
            }).answer;
            this.#show(quantity, measured?.points[0] ?? null);
        } catch (error) {
            this.#say(error instanceof ServerError ? sentence(error.message) : 'The connection was lost.');
        }
    }

    /** @param {string} text */
    #say(text) {
        this.#show('', null);
        this.#value.textContent = text;
        this.#value.hidden = false;
    }

    /**
     * @param {string} quantity
     * @param {MeasuredPoint | null} point
     */
    #show(quantity, point) {
        this.#point = point;
        this.#value.hidden = !point;
        this.#value.textContent = point ? glareText(quantity, point) : '';
        const glare = point?.glare;
        const ratios = glare?.luminances?.length === 3
            ? `Mean luminance within 10°, to 30°, to 60°: ${glare.luminances.map(threeDigits).join(', ')} cd/m². `
            : '';
        const words = `${ratios}${glare?.words ? sentence(glare.words) : ''}`;
        this.#words.textContent = words;
        this.#words.hidden = words === '';
        const rows = (glare?.sources ?? []).map(({name, share, luminance}) => {
            const item = document.createElement('li');
            const part = document.createElement('b');
            part.textContent = `${Math.round(100 * share)} %`;
            const what = document.createElement('span');
            what.textContent = name || 'unnamed';
            const bright = document.createElement('span');
            bright.className = 'quiet';
            bright.textContent = luminance > 0 ? `${threeDigits(luminance)} cd/m²` : '';
            item.append(part, what, bright);
            return item;
        });
        byId('glare-sources', HTMLElement).replaceChildren(...rows);
        this.app.drawOverlay();
    }

    /** @param {import('../picture/overlay.js').OverlayFrame['place']} place */
    #draw(place) {
        const marks = (this.#point?.glare?.sources ?? []).flatMap(({position, share}) => {
            const {x, y, depth} = place(position);
            if (depth <= NEAR) {
                return [];
            }
            const mark = svgElement('text');
            mark.setAttribute('x', x.toFixed(1));
            mark.setAttribute('y', y.toFixed(1));
            mark.textContent = `${Math.round(100 * share)} %`;
            return [mark];
        });
        this.group.replaceChildren(...marks);
    }
}
