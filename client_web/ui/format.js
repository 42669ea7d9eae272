// SPDX-License-Identifier: Apache-2.0
// Numbers for people. What is not known reads as a dash.

const DASH = '–';

/** @type {(value: number | null | undefined) => value is number} */
const known = (value) => typeof value === 'number' && Number.isFinite(value);

/**
 * Share with two significant digits.
 *
 * @param {number | null | undefined} share  0.018 for 1.8 %
 * @returns {string}
 */
export function percent(share) {
    if (!known(share)) {
        return DASH;
    }
    const value = share * 100;
    const digits = value >= 9.95 ? 0 : value >= 0.0995 ? 1 : 2;
    return `${value.toFixed(digits)} %`;
}

/**
 * Error of the picture.
 *
 * @param {number | null | undefined} share
 * @returns {string} says so where it is not known, or as large as what it is the error of
 */
export const pictureError = (share) => (known(share) && share < 1 ? percent(share) : 'not yet known');

/**
 * What is said of the light where next to none arrives, in place of an error.
 *
 * @param {number} luminance  cd/m², upper bound
 * @returns {string}
 */
export const darkerThan = (luminance) => `below ${Number(luminance.toPrecision(1))} cd/m²`;

/**
 * 95 % interval of the picture's error.
 *
 * @param {number | null | undefined} low
 * @param {number | null | undefined} high
 * @returns {string}
 */
export function interval(low, high) {
    if (!known(low) || !known(high)) {
        return DASH;
    }
    const end = high < 1 ? percent(high) : 'more than 100 %';
    return low < 1 ? `${percent(low)} to ${end}` : end;
}

/**
 * Progress that says 100 only when it is done.
 *
 * @param {number | null | undefined} share  0..1
 * @returns {string}
 */
export function progress(share) {
    return known(share) ? `${Math.floor(Math.min(Math.max(share, 0), 1) * 100)} %` : DASH;
}

/**
 * @param {number | null | undefined} value
 * @returns {string} whole number, thousands set apart
 */
export function count(value) {
    return known(value)
        ? Math.round(value)
              .toString()
              .replace(/\B(?=(\d{3})+$)/g, '\u202f')
        : DASH;
}

/**
 * @param {number | null | undefined} value  per second
 * @returns {string}
 */
export function rate(value) {
    return known(value) ? `${value.toFixed(value < 9.95 ? 1 : 0)} /s` : DASH;
}

/**
 * @param {number | null | undefined} ms
 * @returns {string}
 */
export function milliseconds(ms) {
    return known(ms) ? `${ms.toFixed(ms < 9.95 ? 1 : 0)} ms` : DASH;
}

/**
 * @param {number | null | undefined} value  metres
 * @returns {string} to the centimetre
 */
export function metres(value) {
    return known(value) ? `${value.toFixed(2).replace('-', '−')} m` : DASH;
}
