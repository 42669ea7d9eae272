// SPDX-License-Identifier: Apache-2.0
// Days and minutes at a place, as the server wants its times. Knows no page.

import {CITIES} from './cities.js';

/** Minutes that a zone is ahead of UTC at a moment. @type {(zone: string, moment: number) => number} */
function aheadOfUtc(zone, moment) {
    const format = new Intl.DateTimeFormat('en-US', {
        timeZone: zone, hourCycle: 'h23', year: 'numeric', month: 'numeric', day: 'numeric', hour: 'numeric', minute: 'numeric',
    });
    const part = Object.fromEntries(format.formatToParts(moment).map(({type, value}) => [type, Number(value)]));
    const local = Date.UTC(part.year, part.month - 1, part.day, part.hour, part.minute);
    return Math.round((local - moment) / 60000);
}

const twoDigits = (/** @type {number} */ value) => String(value).padStart(2, '0');

/** Hours and minutes of a minute of the day. */
export const clock = (/** @type {number} */ minute) => `${twoDigits(Math.floor(minute / 60))}:${twoDigits(minute % 60)}`;

/**
 * @param {string} date  2026-06-21
 * @param {number} minute  of that day, 0..1439, by the clocks of the zone
 * @param {string} zone  IANA's name
 * @returns {string} as setDaylight.time wants it
 */
export function timeAt(date, minute, zone) {
    const local = Date.parse(`${date}T${clock(minute)}:00Z`);
    // Twice: the difference at the moment meant, not at that of UTC.
    const ahead = aheadOfUtc(zone, local - 60000 * aheadOfUtc(zone, local));
    const size = Math.abs(ahead);
    return `${date}T${clock(minute)}:00${ahead < 0 ? '-' : '+'}${clock(size)}`;
}

/**
 * Date and minute of a time as the server tells it.
 *
 * @param {string | undefined} time
 * @returns {{date: string, minute: number} | null}
 */
export function partsOf(time) {
    const match = /^(\d{4}-\d\d-\d\d)T(\d\d):(\d\d)/.exec(time ?? '');
    return match ? {date: match[1], minute: 60 * Number(match[2]) + Number(match[3])} : null;
}

/**
 * Zone of a place: that of a city of the list that it is, else one of whole hours by its longitude.
 *
 * @param {{latitude: number, longitude: number}} place
 */
export function zoneOf({latitude, longitude}) {
    const near = CITIES.find(([, north, east]) => Math.abs(north - latitude) < 0.1 && Math.abs(east - longitude) < 0.1);
    const hours = Math.round(longitude / 15);
    return near?.[3] ?? (hours === 0 ? 'Etc/GMT' : `Etc/GMT${hours > 0 ? '-' : '+'}${Math.abs(hours)}`);
}
