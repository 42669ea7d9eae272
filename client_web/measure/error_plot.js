// SPDX-License-Identifier: Apache-2.0
// The estimated error over the time since the last change, both logarithmic: a straight fall by half
// a decade each decade of time is what sampling promises. With its 95 % band and the target.

import {svgElement} from '../ui/svg.js';

/**
 * @typedef {object} PlotSample
 * @property {number} seconds  since the last change, above 0
 * @property {number} error
 * @property {number} low
 * @property {number} high
 */

/**
 * @typedef {object} ErrorPlot
 * @property {string} line  SVG path of the error
 * @property {string} band  SVG path around the interval
 * @property {string} grid
 * @property {string} target
 * @property {{x: number, y: number, text: string, anchor: 'end' | 'middle'}[]} labels
 */

const MARGIN = {left: 34, right: 6, top: 6, bottom: 18};
const FIRST_SECOND = 0.1;
/** Room at the bottom of the plot for what is to come. */
const LOWEST_DECADE = 0.01;

/** Of a decade: 100 s are no whole minutes. @type {(seconds: number) => string} */
const timeLabel = (seconds) =>
    seconds < 1000 ? `${seconds} s` : seconds < 3600 ? `${Math.round(seconds / 60)} min` : `${Number((seconds / 3600).toPrecision(2))} h`;

/** @type {(share: number) => string} */
const shareLabel = (share) => `${Number((100 * share).toPrecision(1))} %`;

/**
 * Lays samples out in a box.
 *
 * @param {PlotSample[]} samples  oldest first
 * @param {number | null} target  relative error
 * @param {number} width
 * @param {number} height
 * @returns {ErrorPlot}
 */
export function layOut(samples, target, width, height) {
    const errors = samples.flatMap(({error, high}) => [error, high]);
    const least = Math.min(...samples.map(({low}) => low), target ?? LOWEST_DECADE, LOWEST_DECADE);
    const top = Math.min(Math.ceil(Math.log10(Math.max(...errors, 0.1)) - 1e-9), 0);
    const bottom = Math.floor(Math.log10(Math.max(least, 1e-4)) + 1e-9);
    const left = Math.log10(FIRST_SECOND);
    const right = Math.log10(Math.max((samples.at(-1)?.seconds ?? 0) * 1.3, 10));
    const inner = {
        width: width - MARGIN.left - MARGIN.right,
        height: height - MARGIN.top - MARGIN.bottom,
    };
    const x = (/** @type {number} */ seconds) => {
        const part = (Math.log10(Math.max(seconds, FIRST_SECOND)) - left) / (right - left);
        return MARGIN.left + inner.width * Math.min(part, 1);
    };
    const y = (/** @type {number} */ share) => {
        const part = (top - Math.log10(Math.max(share, 1e-9))) / (top - bottom);
        return MARGIN.top + inner.height * Math.min(Math.max(part, 0), 1);
    };
    const point = (/** @type {number} */ seconds, /** @type {number} */ share) =>
        `${x(seconds).toFixed(1)} ${y(share).toFixed(1)}`;
    const upper = samples.map(({seconds, high}) => point(seconds, high));
    const lower = samples.map(({seconds, low}) => point(seconds, low)).reverse();
    const path = (/** @type {string[]} */ points) => (points.length > 0 ? `M${points.join('L')}` : '');
    /** @type {ErrorPlot['labels']} */
    const labels = [];
    let grid = '';
    for (let power = bottom; power <= top; ++power) {
        const at = y(10 ** power);
        grid += `M${MARGIN.left} ${at.toFixed(1)}H${width - MARGIN.right}`;
        labels.push({x: MARGIN.left - 5, y: at + 3.5, text: shareLabel(10 ** power), anchor: 'end'});
    }
    for (let power = Math.ceil(left) + 1; power <= right; ++power) {
        const at = x(10 ** power);
        grid += `M${at.toFixed(1)} ${MARGIN.top}V${height - MARGIN.bottom}`;
        labels.push({x: at, y: height - 5, text: timeLabel(10 ** power), anchor: 'middle'});
    }
    return {
        line: path(samples.map(({seconds, error}) => point(seconds, error))),
        band: upper.length > 0 ? `${path([...upper, ...lower])}Z` : '',
        grid,
        target: target ? `M${MARGIN.left} ${y(target).toFixed(1)}H${width - MARGIN.right}` : '',
        labels,
    };
}

/**
 * Draws the plot into an SVG element with paths of class grid, band, target and line and a group of
 * class labels.
 *
 * @param {SVGSVGElement} svg
 * @param {PlotSample[]} samples  oldest first
 * @param {number | null} target
 */
export function drawErrorPlot(svg, samples, target) {
    const {width, height} = svg.viewBox.baseVal;
    const plot = layOut(samples, target, width, height);
    for (const name of /** @type {const} */ (['grid', 'band', 'target', 'line'])) {
        svg.querySelector(`.${name}`)?.setAttribute('d', plot[name]);
    }
    const texts = plot.labels.map(({x, y, text, anchor}) =>
        svgElement('text', {x: x.toFixed(1), y: y.toFixed(1), 'text-anchor': anchor}, text));
    svg.querySelector('.labels')?.replaceChildren(...texts);
}
