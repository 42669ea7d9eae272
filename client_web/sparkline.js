// SPDX-License-Identifier: Apache-2.0
// A small plot of the estimated error over time, logarithmic, with its 95 % interval as a band and
// a line where the scene changed.

/** @typedef {import('./meters.js').ErrorSample} ErrorSample */

/**
 * @typedef {object} Plot
 * @property {string} line  SVG path of the error
 * @property {string} band  SVG path around the interval
 * @property {string} changes  SVG path of upright lines where the epoch changes
 * @property {{y: number, share: number}[]} decades  heights of 100 %, 10 %, 1 %, …
 */

/**
 * Lays samples out in a box.
 *
 * @param {ErrorSample[]} samples  oldest first
 * @param {number} width
 * @param {number} height
 * @param {number} spanMs  time that the width stands for, ending with the newest sample
 * @returns {Plot}
 */
export function layOut(samples, width, height, spanMs) {
    const last = samples.at(-1);
    if (!last) {
        return {line: '', band: '', changes: '', decades: []};
    }
    const logs = samples.flatMap(({low, high, error}) =>
        [low, high, error].filter((value) => value > 0).map(Math.log10),
    );
    const bottom = Math.floor(Math.min(...logs) * 4 - 0.2) / 4;
    const top = Math.max(Math.ceil(Math.max(...logs) * 4 + 0.2) / 4, bottom + 0.5);
    const x = (/** @type {number} */ time) => width * (1 - (last.time - time) / spanMs);
    const y = (/** @type {number} */ share) => {
        const log = Math.log10(Math.max(share, 1e-9));
        return height * Math.min(1, (top - log) / (top - bottom));
    };
    const point = (/** @type {number} */ time, /** @type {number} */ share) =>
        `${x(time).toFixed(1)} ${y(share).toFixed(1)}`;
    const upper = samples.map(({time, high}) => point(time, high));
    const lower = samples.map(({time, low}) => point(time, low)).reverse();
    const changed = samples.filter((sample, i) => i > 0 && sample.epoch !== samples[i - 1].epoch);
    const decades = [];
    for (let power = Math.ceil(bottom); power <= top; ++power) {
        decades.push({y: y(10 ** power), share: 10 ** power});
    }
    return {
        line: `M${samples.map(({time, error}) => point(time, error)).join('L')}`,
        band: `M${[...upper, ...lower].join('L')}Z`,
        changes: changed.map(({time}) => `M${x(time).toFixed(1)} 0V${height}`).join(''),
        decades,
    };
}

/** Even a short history is not drawn coarser than this, milliseconds. */
const MIN_SPAN_MS = 15000;

/**
 * Draws the plot into an SVG element with paths of class grid, band, changes and line.
 *
 * @param {SVGSVGElement} svg
 * @param {ErrorSample[]} samples  oldest first
 */
export function drawSparkline(svg, samples) {
    const {width, height} = svg.viewBox.baseVal;
    const age = (samples.at(-1)?.time ?? 0) - (samples[0]?.time ?? 0);
    const plot = layOut(samples, width, height, Math.max(age, MIN_SPAN_MS));
    const grid = plot.decades.map(({y}) => `M0 ${y.toFixed(1)}H${width}`).join('');
    const paths = {grid, band: plot.band, changes: plot.changes, line: plot.line};
    for (const [name, path] of Object.entries(paths)) {
        svg.querySelector(`.${name}`)?.setAttribute('d', path);
    }
}
