// SPDX-License-Identifier: Apache-2.0
// Numbers at the isolines of a picture in false colour: values are read back from its colours, and each number
// stands where its value is passed.

import {sameView} from '../camera/camera.js';
import {turboColour, valueOnScale} from './colour.js';
import {levelsOf} from './display_panel.js';
import {svgElement} from '../ui/svg.js';
import {LUX_PER_FOOTCANDLE, oneDigit} from '../ui/units.js';

/** Pixels that are looked at in a row. */
const COLUMNS = 96;
const COLOURS = Array.from({length: 129}, (_, i) => turboColour(i / 128));
/** A pixel that is darker lies on a line or below the scale; one this far from all colours on an edge, of 255. */
const DARK = 60;
const STRANGE = 30;
/** Between neighbours a value jumps at an edge, where there is no line. */
const JUMP = 2;
/** Numbers are so far from one another, and the same ones, CSS pixels. */
const APART = {any: 44, same: 220};
/** Numbers for one value at most. */
const MOST_EACH = 3;
const LOOK_MS = 500;

/**
 * Where a colour lies on the scale.
 *
 * @param {number} red  0..255
 * @param {number} green
 * @param {number} blue
 * @returns {number | null} 0..1; null: it is none of the scale
 */
export function placeOf(red, green, blue) {
    if (Math.max(red, green, blue) < DARK) {
        return null;
    }
    let [best, least] = [0, Infinity];
    COLOURS.forEach(([r, g, b], i) => {
        const distance = (r - red) ** 2 + (g - green) ** 2 + (b - blue) ** 2;
        if (distance < least) {
            [best, least] = [i, distance];
        }
    });
    return least < STRANGE ** 2 ? best / (COLOURS.length - 1) : null;
}

/**
 * Where levels are passed along the rows of a grid of values.
 *
 * @param {(number | null)[]} values  row by row; null: not known
 * @param {number} columns
 * @param {number[]} levels
 * @returns {{level: number, column: number, row: number}[]} columns and rows from 0, between two points
 */
export function crossingsOf(values, columns, levels) {
    const found = [];
    for (let row = 0; row < values.length / columns; ++row) {
        // The line itself is dark, so that the value beside it is two points away.
        for (let column = 0; column + 2 < columns; ++column) {
            const [a, b, c] = [0, 1, 2].map((i) => values[row * columns + column + i]);
            const [from, to, gap] = b === null ? [a, c, 2] : [a, b, 1];
            if (from === null || to === null || Math.max(from, to) > JUMP * Math.min(from, to)) {
                continue;
            }
            for (const level of levels) {
                if (Math.min(from, to) < level && level <= Math.max(from, to)) {
                    found.push({level, column: column + gap / 2, row});
                }
            }
        }
    }
    return found;
}

/**
 * A few places for each level, apart from one another, those in the middle first.
 *
 * @param {{level: number, x: number, y: number}[]} candidates  CSS pixels
 * @param {{x: number, y: number}} middle
 */
export function chosenLabels(candidates, middle) {
    const off = (/** @type {{x: number, y: number}} */ a, /** @type {{x: number, y: number}} */ b) =>
        Math.hypot(a.x - b.x, a.y - b.y);
    /** @type {{level: number, x: number, y: number}[]} */
    const chosen = [];
    for (const candidate of [...candidates].sort((a, b) => off(a, middle) - off(b, middle))) {
        const same = chosen.filter(({level}) => level === candidate.level);
        const free =
            same.length < MOST_EACH &&
            chosen.every((other) => off(other, candidate) >= APART.any) &&
            same.every((other) => off(other, candidate) >= APART.same);
        if (free) {
            chosen.push(candidate);
        }
    }
    return chosen;
}

export class IsolineNumbers {
    #looked = -Infinity;
    #sample = document.createElement('canvas');

    /**
     * @param {import('../app/app.js').RaybundleApp} app
     * @param {import('./display_panel.js').DisplayPanel} display
     */
    constructor(app, display) {
        this.app = app;
        this.display = display;
        this.group = app.overlay.group('isoline-values');
        app.on('picture', () => this.#look());
        app.on('view', () => this.group.replaceChildren());
        app.on('anew', () => this.group.replaceChildren());
    }

    #look() {
        const {frame, link, view, camera} = this.app;
        const maximum = frame?.scaleMaximum;
        if (!this.display.isolines || maximum === undefined) {
            this.group.replaceChildren();
            return;
        }
        const now = performance.now();
        const here = link.shown && sameView(link.shown, view) && !camera.moving;
        if (!here || now - this.#looked < LOOK_MS) {
            return;
        }
        this.#looked = now;
        const unit = this.display.legendUnit === 'fc' ? LUX_PER_FOOTCANDLE : 1;
        this.#show(maximum / unit, frame?.scaleLinear ?? false);
    }

    /**
     * @param {number} top  of the scale, in the unit that is shown
     * @param {boolean} linear
     */
    #show(top, linear) {
        const {canvas, element} = this.app.picture;
        const {clientWidth, clientHeight} = element;
        const rows = Math.max(Math.round((COLUMNS * clientHeight) / Math.max(clientWidth, 1)), 1);
        Object.assign(this.#sample, {width: COLUMNS, height: rows});
        const context = this.#sample.getContext('2d', {alpha: false, willReadFrequently: true});
        if (!context) {
            return;
        }
        context.imageSmoothingEnabled = false;
        context.drawImage(canvas, 0, 0, COLUMNS, rows);
        const {data} = context.getImageData(0, 0, COLUMNS, rows);
        const values = Array.from({length: COLUMNS * rows}, (_, i) => {
            const at = placeOf(data[4 * i], data[4 * i + 1], data[4 * i + 2]);
            return at === null ? null : valueOnScale(at, top, linear);
        });
        const candidates = crossingsOf(values, COLUMNS, levelsOf(top)).map(({level, column, row}) => ({
            level,
            x: ((column + 0.5) * clientWidth) / COLUMNS,
            y: ((row + 0.5) * clientHeight) / rows,
        }));
        const middle = {x: clientWidth / 2, y: clientHeight / 2};
        const texts = chosenLabels(candidates, middle).map(({level, x, y}) => {
            const text = svgElement('text');
            text.setAttribute('class', 'isoline-value');
            text.setAttribute('x', x.toFixed(1));
            text.setAttribute('y', y.toFixed(1));
            text.textContent = oneDigit(level);
            return text;
        });
        this.group.replaceChildren(...texts);
    }
}
