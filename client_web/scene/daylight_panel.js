// SPDX-License-Identifier: Apache-2.0
// Daylight: which sky, where, when; the slider of the day.

import {LiveField, byId, showValue} from '../ui/elements.js';
import {ServerError} from '../net/protocol.js';
import {sentence} from '../ui/status.js';
import {CITIES} from './cities.js';
import {clock, partsOf, timeAt, zoneOf} from './day_time.js';
import {NewestOnly} from './surface_change.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('./history.js').History} History
 * @typedef {import('../net/scene_types.js').SetDaylight} SetDaylight
 */

const NOON = 720;

/**
 * Where the sun stands, for people.
 *
 * @param {SetDaylight} daylight
 */
export function sunText({sky, sunElevation = 0, sunAzimuth = 0}) {
    if (sky === 'loaded' || sky === 'none') {
        return '';
    }
    const azimuth = (Math.round(sunAzimuth) + 360) % 360;
    return sunElevation > 0
        ? `Sun ${sunElevation.toFixed(1)}° high, at ${azimuth}° from −z over +x`
        : 'The sun has set: the sky is dark.';
}

export class DaylightPanel {
    #sky = byId('day-sky', HTMLSelectElement);
    #city = byId('day-city', HTMLSelectElement);
    #fields = Object.fromEntries(
        ['latitude', 'longitude', 'north', 'date', 'minute'].map((name) => [name, byId(`day-${name}`, HTMLInputElement)]),
    );
    /** @type {Record<string, LiveField>} */
    #live;
    /** What it was when the slider was taken. @type {SetDaylight | null} */
    #before = null;

    /**
     * @param {RaybundleApp} app
     * @param {History} history
     */
    constructor(app, history) {
        this.app = app;
        this.history = history;
        this.newest = new NewestOnly((body) => this.#send(/** @type {SetDaylight} */ (body)));
        this.#live = Object.fromEntries(Object.entries(this.#fields).map(([name, field]) => [name, new LiveField(field)]));
        for (const [name] of CITIES) {
            this.#city.add(new Option(name, name));
        }
        this.#sky.addEventListener('change', () => this.#done());
        this.#city.addEventListener('change', () => this.#cityChosen());
        for (const [name, field] of Object.entries(this.#fields)) {
            field.addEventListener('change', () => this.#done());
            if (name === 'minute') {
                field.addEventListener('input', () => this.#going());
            }
        }
        app.on('welcome', () => this.#show());
        app.on('sceneChanged', () => this.#show());
    }

    #cityChosen() {
        const city = CITIES.find(([name]) => name === this.#city.value);
        if (city) {
            this.#fields.latitude.value = String(city[1]);
            this.#fields.longitude.value = String(city[2]);
            this.#done();
        }
    }

    /** What the fields say. @returns {SetDaylight} */
    #wanted() {
        const sky = this.#sky.value;
        if (sky === 'loaded' || sky === 'none') {
            return {sky};
        }
        const number = (/** @type {string} */ name) => this.#fields[name].valueAsNumber || 0;
        const place = {latitude: number('latitude'), longitude: number('longitude')};
        const time = timeAt(this.#fields.date.value, number('minute'), zoneOf(place));
        return {sky, place, north: number('north'), time};
    }

    #going() {
        this.#before ??= this.#state();
        showValue('dayTime', clock(this.#fields.minute.valueAsNumber));
        this.newest.push(this.#wanted());
    }

    async #done() {
        const before = this.#before ?? this.#state();
        this.#before = null;
        const wanted = this.#wanted();
        if (await this.#send(wanted)) {
            this.history.add({
                label: 'set the daylight',
                subject: 'daylight',
                undo: () => this.#send(before),
                redo: () => this.#send(wanted),
            });
        }
    }

    /** What can be asked for again. @returns {SetDaylight} */
    #state() {
        const {sky = 'loaded', place, north, time, sunElevation, sunAzimuth} = this.app.scene?.daylight ?? {};
        return time && place ? {sky, place, north, time} : {sky, sunElevation, sunAzimuth};
    }

    /**
     * @param {SetDaylight} setDaylight
     * @returns {Promise<boolean>} whether it has been set
     */
    async #send(setDaylight) {
        try {
            await this.app.client.request({setDaylight}).answer;
            return true;
        } catch (error) {
            if (error instanceof ServerError) {
                this.app.status.notify(sentence(error.message), 'problem');
            }
            this.#show();
            return false;
        }
    }

    #show() {
        const daylight = this.app.scene?.daylight;
        byId('daylight', HTMLElement).hidden = !daylight;  // an older server
        if (!daylight) {
            return;
        }
        if (![...this.#sky.options].some(({value}) => value === daylight.sky)) {
            this.#sky.add(new Option(daylight.sky, daylight.sky));
        }
        this.#sky.value = daylight.sky ?? 'loaded';
        const place = daylight.place ?? {latitude: CITIES[3][1], longitude: CITIES[3][2]};
        const {date, minute} = partsOf(daylight.time) ?? {date: new Date().toISOString().slice(0, 10), minute: NOON};
        const shown = {...place, north: daylight.north ?? 0, date, minute};
        for (const [name, live] of Object.entries(this.#live)) {
            const value = shown[/** @type {keyof typeof shown} */ (name)];
            live.show(typeof value === 'number' ? String(Number(value.toFixed(4))) : value);
        }
        const city = CITIES.find(([, north, east]) =>
            Math.abs(north - place.latitude) < 0.005 && Math.abs(east - place.longitude) < 0.005);
        this.#city.value = city?.[0] ?? '';
        const clocked = daylight.sky !== 'loaded' && daylight.sky !== 'none';
        byId('day-clock', HTMLElement).hidden = !clocked;
        showValue('dayTime', clock(this.#fields.minute.valueAsNumber || 0));
        showValue('daySun', sunText(daylight));
        for (const control of byId('daylight', HTMLElement).querySelectorAll('input, select')) {
            /** @type {HTMLInputElement | HTMLSelectElement} */ (control).disabled = !this.app.mayEdit;
        }
    }
}
