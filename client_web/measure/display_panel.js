// SPDX-License-Identifier: Apache-2.0
// How radiance becomes a picture: photograph or false colour, exposure, the legend, saving it.

import {SCALE_DECADES, onScale, turbo} from './colour.js';
import {byId, fileName, returnFocus, saveFile} from '../ui/elements.js';
import {FrameThrottle} from '../picture/frame_throttle.js';
import {withLegend} from './legend.js';
import {LUX_PER_FOOTCANDLE, oneDigit, threeDigits} from '../ui/units.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('../ui/units.js').IlluminanceUnit} IlluminanceUnit
 * @typedef {'PHOTO' | 'FALSE_LUMINANCE' | 'FALSE_ILLUMINANCE'} DisplayMode
 */

const MODES = /** @type {const} */ (['PHOTO', 'FALSE_LUMINANCE', 'FALSE_ILLUMINANCE']);

/**
 * Marks of a scale: 1, 2 and 5 times the powers of ten.
 *
 * @param {number} maximum  upper end, in the unit that is shown
 * @returns {number[]} downwards
 */
export function scaleTicks(maximum) {
    const ticks = [];
    const top = Math.floor(Math.log10(maximum) + 1e-9);
    for (let power = top; power >= top - SCALE_DECADES; --power) {
        for (const lead of [5, 2, 1]) {
            const value = lead * 10 ** power;
            const least = maximum * 10 ** -SCALE_DECADES;
            if (value <= maximum * 1.0001 && value >= least * 0.9999) {
                ticks.push(value);
            }
        }
    }
    return ticks;
}

/** Values that isolines are drawn at, in the unit that is shown. @type {(maximum: number) => number[]} */
export const levelsOf = (maximum) => scaleTicks(maximum).filter((value) => value < maximum * 0.9999);

/** A linear scale has so many marks at least. */
const LINEAR_MARKS = 5;

/**
 * Marks of a scale that begins at 0: its end, and even steps of 1, 2 or 5 times a power of ten.
 *
 * @param {number} maximum
 * @returns {number[]} downwards
 */
export function linearTicks(maximum) {
    const widest = maximum / LINEAR_MARKS;
    const power = 10 ** Math.floor(Math.log10(widest) + 1e-9);
    const step = power * (widest >= 5 * power * 0.9999 ? 5 : widest >= 2 * power * 0.9999 ? 2 : 1);
    return Array.from({length: Math.floor(maximum / step + 1e-6) + 1}, (_, i) => i * step).reverse();
}

/** @type {(value: number) => string} */
const wholeDigits = (value) => (value < 1000 ? String(Number(value.toPrecision(3))) : threeDigits(value));

export class DisplayPanel {
    /** @type {DisplayMode} */
    mode = 'PHOTO';
    exposure = 0;
    autoExposure = true;
    scaleMaximum = 0;
    isolines = false;
    linear = false;
    /** @type {IlluminanceUnit} */
    #unit = 'lx';
    #drawn = '';
    /** Whether the server has been asked for a linear scale. */
    #saidLinear = false;
    /** @type {{text: string, at: number}[]} */
    #marks = [];
    #select = byId('display-mode', HTMLSelectElement);
    #slider = byId('exposure', HTMLInputElement);
    #auto = byId('auto-exposure', HTMLButtonElement);
    #sending = new FrameThrottle(() => this.#send());

    /** @param {RaybundleApp} app */
    constructor(app) {
        this.app = app;
        this.#addControls();
        app.on('welcome', () => this.#send());
        app.on('picture', () => this.#drawLegend());
    }

    /** @param {IlluminanceUnit} unit */
    set unit(unit) {
        this.#unit = unit;
        this.#sending.run();
        this.#drawLegend();
    }

    /**
     * What the colours on screen stand for; null: it is a photograph.
     *
     * @returns {import('../review/report.js').ReportScale | null}
     */
    get scale() {
        if (this.app.frame?.scaleMaximum === undefined) {
            return null;
        }
        const colours = Array.from({length: 33}, (_, i) => turbo(i / 32));
        const quantity = byId('legend-title', HTMLElement).textContent ?? '';
        const beyond = this.app.frame.scaleLinear ? 'white: above' : 'white: above, black: below';
        return {title: `${quantity} (${beyond})`, colours, marks: this.#marks};
    }

    /** @param {DisplayMode} mode */
    setMode(mode) {
        this.mode = mode;
        this.#select.value = mode;
        this.#sending.run();
    }

    /** Once the server has carried out all that was set here, or the connection is lost. */
    async carriedOut() {
        await this.app.ask({setDisplay: this.#wanted()});
    }

    /** Photo, luminance, illuminance, and again. */
    nextMode() {
        this.setMode(MODES[(MODES.indexOf(this.mode) + 1) % MODES.length]);
    }

    /** @param {number} stops */
    setExposure(stops) {
        this.exposure = stops;
        this.#slider.value = String(stops);
        this.#show();
        this.#sending.run();
    }

    /** Saves the picture, as it is on screen, as PNG; below one in false colour its legend. */
    async savePicture() {
        const {canvas, element} = this.app.picture;
        const {scale} = this;
        // A small picture that is shown larger has a legend of readable size all the same.
        const ratio = Math.max(canvas.width / Math.max(element.clientWidth, 1), 1);
        const whole = scale ? withLegend(canvas, scale, ratio) : canvas;
        /** @type {Blob | null} */
        const blob = await new Promise((resolve) => whole.toBlob(resolve, 'image/png'));
        if (blob) {
            saveFile(blob, `${fileName(this.app.scene?.title ?? 'picture')}.png`);
        }
    }

    #addControls() {
        this.#select.addEventListener('change', () => {
            this.setMode(/** @type {DisplayMode} */ (this.#select.value));
            this.app.picture.element.focus({preventScroll: true});
        });
        this.#slider.addEventListener('input', () => this.setExposure(Number(this.#slider.value)));
        this.#slider.addEventListener('dblclick', () => this.setExposure(0));
        this.#auto.addEventListener('click', (event) => {
            // The brightness on screen stays: what was automatic becomes the user's own.
            const shown = this.app.frame?.exposure ?? 0;
            this.autoExposure = !this.autoExposure;
            const range = Number(this.#slider.max);
            const own = this.autoExposure ? 0 : Math.round(shown * 4) / 4;
            this.#slider.min = String(Math.min(-range, own - 6));
            this.setExposure(own);
            returnFocus(event);
        });
        byId('save-picture', HTMLElement).addEventListener('click', () => this.savePicture());
        const maximum = byId('scale-maximum', HTMLSelectElement);
        maximum.addEventListener('change', () => {
            this.scaleMaximum = Number(maximum.value);
            this.#showColours();
        });
        for (const button of document.querySelectorAll('[data-scale]')) {
            button.addEventListener('click', () => {
                this.linear = /** @type {HTMLElement} */ (button).dataset.scale === 'linear';
                for (const other of document.querySelectorAll('[data-scale]')) {
                    other.setAttribute('aria-pressed', String(other === button));
                }
                this.#showColours();
            });
        }
        const isolines = byId('isolines', HTMLInputElement);
        isolines.addEventListener('change', () => {
            this.isolines = isolines.checked;
            this.#showColours();
        });
        this.#show();
    }

    /** Sends how colours stand for values; a photograph has none, so that it makes way for them. */
    #showColours() {
        this.setMode(this.mode === 'PHOTO' ? 'FALSE_ILLUMINANCE' : this.mode);
    }

    #show() {
        this.#auto.setAttribute('aria-pressed', String(this.autoExposure));
        const sign = this.exposure > 0 ? '+' : this.exposure < 0 ? '−' : '';
        const text = `${sign}${Math.abs(this.exposure).toFixed(1)}`;
        byId('exposure-value', HTMLElement).textContent = text;
        this.#slider.setAttribute('aria-valuetext', `${text} stops`);
    }

    #wanted() {
        const {mode, exposure, autoExposure, scaleMaximum, isolines, linear} = this;
        const scaleUnit = mode === 'FALSE_ILLUMINANCE' && this.#unit === 'fc' ? LUX_PER_FOOTCANDLE : 1;
        return {
            mode,
            exposure,
            autoExposure,
            scaleMaximum: scaleMaximum * scaleUnit,
            isolines,
            scaleUnit,
            // Servers that do not know it have the other scale alone.
            ...(linear || this.#saidLinear ? {linearScale: linear} : {}),
        };
    }

    #send() {
        this.#saidLinear ||= this.linear;
        this.app.client.send({setDisplay: this.#wanted()});
    }

    /** Whether the picture on screen shows illuminance: what has been asked for comes later. */
    get showsIlluminance() {
        const {scaleMaximum, scaleIlluminance} = this.app.frame ?? {};
        // Servers of before do not tell.
        return scaleMaximum !== undefined && (scaleIlluminance ?? this.mode === 'FALSE_ILLUMINANCE');
    }

    /** Unit of the colour scale. */
    get legendUnit() {
        return this.showsIlluminance ? this.#unit : 'cd/m²';
    }

    #drawLegend() {
        const maximum = this.app.frame?.scaleMaximum;
        const linear = this.app.frame?.scaleLinear ?? false;
        const legend = byId('legend', HTMLElement);
        legend.hidden = maximum === undefined;
        if (maximum === undefined) {
            this.#drawn = '';
            return;
        }
        const lux = this.showsIlluminance;
        const unit = this.legendUnit;
        const top = unit === 'fc' ? maximum / LUX_PER_FOOTCANDLE : maximum;
        if (this.#drawn === `${top} ${unit} ${linear}`) {
            return;
        }
        this.#drawn = `${top} ${unit} ${linear}`;
        const bottom = top * 10 ** -SCALE_DECADES;
        byId('legend-above', HTMLElement).textContent = `above ${oneDigit(top)}`;
        byId('legend-below', HTMLElement).textContent = `below ${oneDigit(bottom)}`;
        byId('legend-below-row', HTMLElement).hidden = linear;
        byId('legend-title', HTMLElement).textContent = `${lux ? 'Illuminance' : 'Luminance'}, ${unit}`;
        const bar = byId('legend-bar', HTMLCanvasElement);
        const context = bar.getContext('2d');
        for (let row = 0; row < bar.height && context; ++row) {
            context.fillStyle = turbo(1 - row / (bar.height - 1));
            context.fillRect(0, row, 1, 1);
        }
        this.#marks = (linear ? linearTicks : scaleTicks)(top).map((value) => ({
            text: linear ? wholeDigits(value) : oneDigit(value),
            at: onScale(value, top, linear),
        }));
        const ticks = this.#marks.map(({text, at}) => {
            const item = document.createElement('li');
            item.textContent = text;
            item.style.top = `${100 * (1 - at)}%`;
            return item;
        });
        byId('legend-ticks', HTMLElement).replaceChildren(...ticks);
    }
}
