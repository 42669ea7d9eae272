// SPDX-License-Identifier: Apache-2.0
// How zones and what is required of them read.

import {valueText} from './work_plane.js';

/**
 * @typedef {import('../net/measure_types.js').Check} Check
 * @typedef {import('../net/measure_types.js').Measured} Measured
 * @typedef {import('../net/measure_types.js').Verdict} Verdict
 */

/** Signs that do without colour. */
const SIGNS = {MET: '✓', MISSED: '✗', NOT_YET_KNOWN: '?', VERDICT_UNSPECIFIED: ''};
const WORDS = {MET: 'met', MISSED: 'missed', NOT_YET_KNOWN: 'not yet known', VERDICT_UNSPECIFIED: 'not checked: nothing is required of this quantity'};
/** Those whose worst place counts. */
const RATINGS = new Set(['UGR', 'DGP']);
const ILLUMINANCES = new Set(['Em', 'Ez', 'Ev', 'Esz']);

/** @param {Verdict | undefined} verdict */
export const verdictSign = (verdict) => SIGNS[verdict ?? 'VERDICT_UNSPECIFIED'];
/** @param {Verdict | undefined} verdict */
export const verdictWords = (verdict) => WORDS[verdict ?? 'VERDICT_UNSPECIFIED'];

const SYMBOLS = {
    HORIZONTAL: 'Em',
    VERTICAL: 'Ev',
    NORMAL: 'Em',
    CYLINDRICAL: 'Ez',
    SEMICYLINDRICAL: 'Esz',
    DAYLIGHT_FACTOR: 'D',
    UGR: 'UGR',
    DGP: 'DGP',
};

/**
 * @param {Measured} zone
 * @param {'lx' | 'fc'} unit
 * @returns {string} e.g. "Em 512 lx (505 to 519 lx), Uo 0.71"
 */
export function zoneValues(zone, unit) {
    const text = valueText(zone.quantity, unit);
    const symbol = SYMBOLS[/** @type {keyof typeof SYMBOLS} */ (zone.quantity)] ?? '';
    const worst = RATINGS.has(zone.quantity);
    const value = worst ? zone.maximum : zone.mean;
    if (value === undefined) {
        const outside = zone.points.some(({glare}) => glare?.state === 'OUTSIDE');
        const known = zone.points.length > 0;
        return `${symbol} ${known && worst ? (outside ? 'outside of the method' : 'no source glares') : 'being measured …'}`;
    }
    const [low, high] = worst ? [zone.maximumLow, zone.maximumHigh] : [zone.meanLow, zone.meanHigh];
    const interval = low === undefined || high === undefined ? '' : ` (${text(low)} to ${text(high)})`;
    const uniformity = worst || zone.uniformity === undefined ? '' : `, Uo ${zone.uniformity.toFixed(2)}`;
    const direct = zone.direct ? ', direct light only' : '';
    return `${symbol} ${text(value)}${interval}${worst ? ' where it is worst' : ''}${uniformity}${direct}`;
}

/**
 * @param {Check} check
 * @param {'lx' | 'fc'} unit
 * @returns {string} e.g. "Em ≥ 500 lx: met"
 */
export function checkText({what, required, atMost, verdict, words}, unit) {
    const value = ILLUMINANCES.has(what) ? valueText('HORIZONTAL', unit)(required) : String(Number(required.toPrecision(4)));
    return `${what} ${atMost ? '≤' : '≥'} ${value}: ${words ? `${wordsOf(what, verdict)}, ${words}` : verdictWords(verdict)}`;
}

/**
 * What no measurement goes on to find out is not known, instead of not yet.
 *
 * @param {string} what
 * @param {Verdict} verdict
 */
const wordsOf = (what, verdict) => (what === 'Ra' && verdict === 'NOT_YET_KNOWN' ? 'not known' : verdictWords(verdict));

/**
 * Ra as it is known: "83", "80 to 89", or "not stated".
 *
 * @param {{colourRendering?: number, colourRenderingMost?: number}} lamp
 */
export function renderingText({colourRendering, colourRenderingMost}) {
    const number = (/** @type {number} */ value) => String(Number(value.toFixed(1)));
    if (colourRendering === undefined) {
        return 'not stated';
    }
    return colourRenderingMost === undefined ? number(colourRendering) : `${number(colourRendering)} to ${number(colourRenderingMost)}`;
}

/**
 * The luminaires that light a zone, types with their number and Ra, the strongest first.
 *
 * @param {Measured} zone
 * @returns {string[]} e.g. ["12 × panel, Ra 80 to 89", "1 × spot, Ra not stated"]
 */
export function luminaireLines({luminaires = []}) {
    /** @type {Map<string, number>} */
    const types = new Map();
    for (const luminaire of luminaires) {
        const type = `${luminaire.name || 'a lamp without a name'}, Ra ${renderingText(luminaire)}`;
        types.set(type, (types.get(type) ?? 0) + 1);
    }
    return [...types].map(([type, count]) => `${count} × ${type}`);
}
