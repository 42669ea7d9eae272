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

/**
 * @param {number} lux
 * @param {IlluminanceUnit} unit
 * @returns {string} e.g. "482 lx"
 */
export const illuminance = (lux, unit) => `${threeDigits(inUnit(lux, unit))} ${unit}`;

/**
 * The 95 % interval's half width from a standard error.
 *
 * @param {number | null | undefined} standardError  relative
 * @returns {string} e.g. "± 2.3 %"; says so where it is not known, or hardly
 */
export function plusMinus(standardError) {
    if (typeof standardError !== 'number' || !(standardError >= 0)) {
        return '± ?';
    }
    const share = 196 * standardError;
    if (share >= 100) {
        return '± > 100 %';  // next to nothing is known: no digits
    }
    return `± ${share < 9.95 ? share.toFixed(1) : share.toFixed(0)} %`;
}
