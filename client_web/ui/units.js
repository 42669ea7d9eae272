// SPDX-License-Identifier: Apache-2.0
// Illuminance and luminance for people, in lux or footcandles, with the error that they are known to.

/** @typedef {'lx' | 'fc'} IlluminanceUnit */

/** Lux in a footcandle: square feet in a square metre. */
export const LUX_PER_FOOTCANDLE = 10.763910416709722;

/**
 * @param {number} lux
 * @param {IlluminanceUnit} unit
 */
export const inUnit = (lux, unit) => (unit === 'fc' ? lux / LUX_PER_FOOTCANDLE : lux);

/**
 * Number with three significant digits, no more than the measurement carries.
 *
 * @param {number} value
 * @returns {string}
 */
export function threeDigits(value) {
    if (!Number.isFinite(value)) {
        return '–';
    }
    if (value === 0) {
        return '0';
    }
    const digits = Math.max(0, 2 - Math.floor(Math.log10(Math.abs(value) * 1.0005)));
    const text = value.toFixed(Math.min(digits, 4));
    const whole = Math.round(value).toString();
    return digits > 0 ? text : whole.replace(/\B(?=(\d{3})+$)/g, '\u202f');
}

/** @type {(value: number) => string} */
export const oneDigit = (value) => {
    const rounded = Number(value.toPrecision(1));
    return rounded < 1000 ? String(rounded) : threeDigits(rounded);
};

/**
 * @param {number} lux
 * @param {IlluminanceUnit} unit
 * @returns {string} e.g. "482 lx"
 */
export const illuminance = (lux, unit) => `${threeDigits(inUnit(lux, unit))} ${unit}`;

/** What somebody reads of an error that is not known, and of a value whose 95 % interval reaches down to nothing. */
export const NOT_YET = 'not yet known';
export const UNCERTAIN = 'still uncertain';

/** @typedef {number | null | undefined} StandardError  relative; neither known nor 0 where there is none yet */

/** @type {(standardError: StandardError) => standardError is number} */
const estimatedAtAll = (standardError) => typeof standardError === 'number' && standardError >= 0;

/** @type {(standardError: StandardError) => boolean} */
const hopeless = (standardError) => estimatedAtAll(standardError) && 1.96 * standardError >= 1;

/**
 * The 95 % interval's half width from a standard error.
 *
 * @param {StandardError} standardError
 * @returns {string} e.g. "± 2.3 %"
 */
export function plusMinus(standardError) {
    if (hopeless(standardError)) {
        return UNCERTAIN;
    }
    if (!estimatedAtAll(standardError)) {
        return NOT_YET;
    }
    const share = 196 * standardError;
    return `± ${share < 9.95 ? share.toFixed(1) : share.toFixed(0)} %`;
}

/**
 * What is wrong with a value, for a table.
 *
 * @param {StandardError} standardError
 * @returns {string} empty: nothing
 */
export function noteOf(standardError) {
    if (!estimatedAtAll(standardError)) {
        return `error ${NOT_YET}`;
    }
    return hopeless(standardError) ? UNCERTAIN : '';
}

/**
 * The half width of the 95 % interval for a table, as the page states it.
 *
 * @param {StandardError} standardError
 * @returns {string} per cent; empty: not known
 */
export const plusMinusCell = (standardError) =>
    estimatedAtAll(standardError) ? (196 * standardError).toPrecision(3) : '';

/**
 * A value with as many digits as it is worth.
 *
 * @param {number} value
 * @param {string} unit
 * @param {StandardError} standardError
 * @returns {string} e.g. "482 lx", or "≈ 500 lx" where its error is large, or not known
 */
export function estimated(value, unit, standardError) {
    const number = hopeless(standardError) || !estimatedAtAll(standardError) ? `≈ ${oneDigit(value)}` : threeDigits(value);
    return `${number} ${unit}`.trimEnd();
}

/**
 * Illuminance with its error, in a line.
 *
 * @param {number} lux
 * @param {IlluminanceUnit} unit
 * @param {StandardError} standardError
 * @returns {string} e.g. "482 lx ± 2.3 %", or "≈ 500 lx, still uncertain"
 */
export function measured(lux, unit, standardError) {
    const value = estimated(inUnit(lux, unit), unit, standardError);
    if (hopeless(standardError)) {
        return `${value}, ${UNCERTAIN}`;
    }
    return estimatedAtAll(standardError)
        ? `${value} ${plusMinus(standardError)}`
        : `${value}, error ${NOT_YET}`;
}
