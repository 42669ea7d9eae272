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
 * What lights a zone, types with their number and Ra, the strongest first. A glowing material is one light on
 * however many luminaires: it has no number.
 *
 * @param {Measured} zone
 * @param {(light: number) => boolean} [isMaterial]  whether the light of this number is one
 * @returns {string[]} e.g. ["12 × panel, Ra 80 to 89", "all surfaces of LED, Ra not stated"]
 */
export function luminaireLines({luminaires = []}, isMaterial = () => false) {
    /** @type {Map<string, number>} */
    const types = new Map();
    for (const luminaire of luminaires) {
        const material = isMaterial(luminaire.light);
        const name = luminaire.name || (material ? 'a material without a name' : 'a lamp without a name');
        const type = `${material ? `all surfaces of ${name}` : name}, Ra ${renderingText(luminaire)}`;
        types.set(type, (types.get(type) ?? 0) + (material ? 0 : 1));
    }
    return [...types].map(([type, count]) => count > 0 ? `${count} × ${type}` : type);
}

/**
 * @param {Measured} zone
 * @param {(light: number) => boolean} [isMaterial]  as above
 * @returns {string} e.g. "Lit by 2 luminaires and 1 glowing material"
 */
export function litBy({luminaires = []}, isMaterial = () => false) {
    const materials = luminaires.filter(({light}) => isMaterial(light)).length;
    const count = (/** @type {number} */ number, /** @type {string} */ what) => number > 0 ? [`${number} ${what}${number === 1 ? '' : 's'}`] : [];
    return `Lit by ${[...count(luminaires.length - materials, 'luminaire'), ...count(materials, 'glowing material')].join(' and ')}`;
}
