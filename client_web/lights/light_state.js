// SPDX-License-Identifier: Apache-2.0
// What the page says of the light: whether it has settled, and whether the picture is good.

import {percent, progress} from '../ui/format.js';

/** From here on the light counts as settled. */
export const SETTLED = 0.85;

/** From this error on, at the upper end of its 95 % interval, a picture is rough, however far its light has settled. */
export const ROUGH = 0.1;

/**
 * The same of photo and false colour, which show the same light.
 *
 * @param {{settled: number, relativeError: number | null, errorHigh: number | null, darkerThan?: number | null}} stats
 * @param {boolean} known  whether the server has said anything yet
 * @returns {{mark: 'no' | 'rough' | 'yes', text: string}} mark: green for `yes` alone
 */
export function lightState({settled, relativeError, errorHigh, darkerThan = null}, known) {
    if (!known) {
        return {mark: 'no', text: 'Waiting for light'};
    }
    if (darkerThan !== null) {
        return {mark: settled < SETTLED ? 'no' : 'yes', text: 'Next to no light arrives here'};
    }
    if (settled < SETTLED) {
        return {mark: 'no', text: `Light is settling, ${progress(settled)}`};
    }
    const most = errorHigh ?? relativeError;
    if (relativeError === null || most === null) {
        return {mark: 'rough', text: 'First result, still noisy'};
    }
    return most < ROUGH
        ? {mark: 'yes', text: 'Light has settled'}
        : {mark: 'rough', text: `First result, still noisy: error up to ${most < 1 ? percent(most) : '100 %'}`};
}
