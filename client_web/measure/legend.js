// SPDX-License-Identifier: Apache-2.0
// The legend of a picture in false colour, drawn below it, for pictures that leave the page.

/** @typedef {import('../review/report.js').ReportScale} ReportScale */

/** Sizes in the strip, CSS pixels of the picture on screen. */
const SIZES = {margin: 12, text: 13, line: 18, bar: 12, longestBar: 560, tick: 4, gap: 8};
const PAPER = '#ffffff';
const INK = '#1a1c1e';

/**
 * @typedef {object} LegendStrip  in pixels of the picture, from the strip's top left corner
 * @property {number} height
 * @property {number} textSize
 * @property {{x: number, y: number}} title  left end and middle of its line
 * @property {{x: number, y: number, width: number, height: number}} bar
 * @property {{text: string, x: number, tick: number, y: number}[]} labels  their middles, and their ticks'
 */

/**
 * Lays the legend out in a strip as wide as the picture. Labels that would run into one another are left
 * out, lower ones first.
 *
 * @param {number} width  of the picture, pixels
 * @param {number} ratio  pixels of the picture to a CSS pixel
 * @param {ReportScale['marks']} marks  downwards
 * @param {(text: string, size: number) => number} widthOf  a text of that size, pixels
 * @returns {LegendStrip}
 */
export function layOutStrip(width, ratio, marks, widthOf) {
    const size = (/** @type {keyof typeof SIZES} */ name) => Math.round(SIZES[name] * ratio);
    const [margin, line, textSize] = [size('margin'), size('line'), size('text')];
    const bar = {
        x: margin,
        y: Math.round(margin / 2) + line,
        width: Math.min(width - 2 * margin, size('longestBar')),
        height: size('bar'),
    };
    const tickEnd = bar.y + bar.height + size('tick');
    const labels = [];
    let free = width;  // left end of the last label
    for (const {text, at} of marks) {
        const tick = bar.x + at * bar.width;
        const half = widthOf(text, textSize) / 2;
        const x = Math.min(Math.max(tick, half), width - half);
        if (x + half <= free) {
            labels.push({text, x, tick, y: tickEnd + line / 2});
            free = x - half - size('gap');
        }
    }
    const title = {x: margin, y: Math.round(margin / 2) + line / 2};
    return {height: tickEnd + line + Math.round(margin / 2), textSize, title, bar, labels};
}

/**
 * The picture with its legend below.
 *
 * @param {HTMLCanvasElement} picture
 * @param {ReportScale} scale
 * @param {number} ratio  pixels of the picture to a CSS pixel
 * @returns {HTMLCanvasElement}
 */
export function withLegend(picture, scale, ratio) {
    const canvas = document.createElement('canvas');
    const context = canvas.getContext('2d', {alpha: false});
    if (!context) {
        return picture;
    }
    const font = (/** @type {number} */ size) => `${size}px system-ui, sans-serif`;
    const strip = layOutStrip(picture.width, ratio, scale.marks, (text, size) => {
        context.font = font(size);
        return context.measureText(text).width;
    });
    canvas.width = picture.width;
    canvas.height = picture.height + strip.height;
    context.drawImage(picture, 0, 0);
    context.translate(0, picture.height);
    context.fillStyle = PAPER;
    context.fillRect(0, 0, canvas.width, strip.height);
    const {bar, title, labels} = strip;
    const colours = context.createLinearGradient(bar.x, 0, bar.x + bar.width, 0);
    scale.colours.forEach((colour, i) => colours.addColorStop(i / (scale.colours.length - 1), colour));
    context.fillStyle = colours;
    context.fillRect(bar.x, bar.y, bar.width, bar.height);
    context.fillStyle = INK;
    context.font = font(strip.textSize);
    context.textBaseline = 'middle';
    context.fillText(scale.title, title.x, title.y);
    context.textAlign = 'center';
    const tickWidth = Math.max(Math.round(ratio), 1);
    for (const {text, x, tick, y} of labels) {
        const left = Math.round(tick - tickWidth / 2);
        context.fillRect(left, bar.y + bar.height, tickWidth, Math.round(SIZES.tick * ratio));
        context.fillText(text, x, y);
    }
    return canvas;
}
