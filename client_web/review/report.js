// SPDX-License-Identifier: Apache-2.0
// The review report: one HTML file that needs nothing else, with the picture, the pins and what was
// measured, and who changed what.

import {darkerThan, pictureError} from '../ui/format.js';
import {intervalsOf, summaryOf, typicalError, uniformityText} from '../measure/grid.js';
import {changeOf} from './pins.js';
import {estimated, inUnit, measured, plusMinus} from '../ui/units.js';

/**
 * @typedef {import('../net/protocol.js').Pin} Pin
 * @typedef {import('../ui/units.js').IlluminanceUnit} IlluminanceUnit
 * @typedef {object} ReportScale
 * @property {string} title  quantity and unit
 * @property {string[]} colours  from the lower end to the upper one, evenly
 * @property {{text: string, at: number}[]} marks  at shares of the way
 *
 * @typedef {object} ReportContent
 * @property {string} title  of the scene
 * @property {string} server
 * @property {Date} time
 * @property {number} epoch
 * @property {number | null} error  relative, of the picture
 * @property {number | null} [darkerThan]  cd/m², where next to no light arrives in it
 * @property {string} picture  data URL
 * @property {ReportScale | null} [scale]  of a picture in false colour
 * @property {string} address  link to the view
 * @property {IlluminanceUnit} unit
 * @property {Pin[]} pins
 * @property {{number: number, probe: import('../net/measure_types.js').ProbeResult}[]} points
 * @property {{object: string, columns: number, rows: number, illuminance: number[], relativeError: number[]} | null} grid
 * @property {import('./change_list.js').LogEntry[]} changes
 * @property {{pin: number, x: number, y: number}[]} pinsInPicture  shares of its width and height
 */

const STYLE = `
body{font:14px/1.5 system-ui,sans-serif;color:#1a1c1e;max-width:900px;margin:32px auto;padding:0 16px}
h1{font-size:24px;margin:0}h2{font-size:16px;margin:28px 0 8px}
.quiet{color:#54595f}figure{position:relative;margin:20px 0}img{width:100%;display:block}
.pin{position:absolute;transform:translate(-50%,-50%);min-width:20px;padding:0 4px;border-radius:10px;
background:#8a5200;color:#fff;font-size:12px;line-height:20px;text-align:center;border:1px solid #fff}
table{border-collapse:collapse;width:100%}th,td{text-align:left;padding:5px 12px 5px 0;
border-bottom:1px solid #d2d5d8;vertical-align:top}td.n{white-space:nowrap;font-variant-numeric:tabular-nums}
figure:has(+.scale){margin-bottom:8px}.scale{max-width:440px;font-size:12px}.scale p{margin:0 0 4px;position:relative;height:18px}
.scale div{height:14px;border-radius:2px;print-color-adjust:exact}.scale span{position:absolute;transform:translateX(-50%)}
.flag{color:#b3261e;font-weight:600}@media print{body{margin:0}}`;

/** @type {(text: unknown) => string} */
export const escaped = (text) =>
    String(text).replaceAll(
        /[&<>"']/g,
        (c) => ({'&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;', "'": '&#39;'})[c] ?? c,
    );

/**
 * @param {string} title
 * @param {string[]} heads
 * @param {string[][]} rows  HTML of the cells
 */
function section(title, heads, rows) {
    if (rows.length === 0) {
        return '';
    }
    const head = heads.map((text) => `<th scope="col">${escaped(text)}</th>`).join('');
    const body = rows.map((cells) => `<tr>${cells.map((c) => `<td class="n">${c}</td>`).join('')}</tr>`);
    return `<h2>${escaped(title)}</h2><table><thead><tr>${head}</tr></thead><tbody>${body.join('')}</tbody></table>`;
}

/**
 * Legend of a picture in false colour.
 *
 * @param {ReportScale} scale
 */
function scaleHtml({title, colours, marks}) {
    const labels = marks.map(
        ({text, at}) => `<span style="left:${(100 * at).toFixed(2)}%">${escaped(text)}</span>`,
    );
    return `<div class="scale"><p>${escaped(title)}</p>
<div style="background:linear-gradient(to right,${colours.join()})"></div><p>${labels.join('')}</p></div>`;
}

/**
 * @param {ReportContent} content
 * @returns {string} a whole HTML document
 */
export function reportHtml(content) {
    const {title, server, time, epoch, error, picture, address, unit} = content;
    const known = content.darkerThan
        ? `next to no light arrives in the picture, ${darkerThan(content.darkerThan)}`
        : `estimated error of the picture ${pictureError(error)}`;
    const pins = content.pins.map((pin) => [
        String(pin.pin),
        `<div style="white-space:normal">${escaped(pin.text)}</div>`,
        escaped(measured(pin.illuminance, unit, pin.relativeError)),
        String(pin.epoch),
        `<span class="flag">${escaped(changeOf(pin))}</span>`,
        escaped(`${pin.byName || `Viewer ${pin.by}`}, ${new Date(pin.setAtMs).toLocaleString()}`),
    ]);
    const points = content.points.map(({number, probe}) => [
        String(number),
        escaped(estimated(inUnit(probe.illuminance ?? 0, unit), unit, probe.relativeError)),
        escaped(estimated(probe.luminance ?? 0, 'cd/m²', probe.relativeError)),
        escaped(plusMinus(probe.relativeError)),
        String(probe.epoch),
    ]);
    const gridError = typicalError(content.grid?.relativeError ?? []);
    const value = (/** @type {number} */ lux) => escaped(estimated(inUnit(lux, unit), unit, gridError));
    const summary = content.grid ? summaryOf(content.grid.illuminance) : null;
    const grid = summary
        ? [
              [
                  escaped(content.grid?.object),
                  `${summary.measured} of ${content.grid?.illuminance.length}`,
                  value(summary.minimum),
                  value(summary.mean),
                  value(summary.maximum),
                  uniformityText(summary, intervalsOf(content.grid?.illuminance ?? [], content.grid?.relativeError ?? [])),
                  escaped(plusMinus(gridError)),
              ],
          ]
        : [];
    const changes = content.changes.map((entry) => [
        String(entry.epoch),
        escaped(entry.time.toLocaleString()),
        escaped(entry.by),
        `<div style="white-space:normal">${escaped(entry.text)}</div>`,
    ]);
    const marks = content.pinsInPicture.map(
        ({pin, x, y}) =>
            `<span class="pin" style="left:${(100 * x).toFixed(2)}%;top:${(100 * y).toFixed(2)}%">${pin}</span>`,
    );
    return `<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>${escaped(title)}: lighting review</title>
<style>${STYLE}</style></head><body>
<h1>${escaped(title)}</h1>
<p class="quiet">Lighting review, ${escaped(time.toLocaleString())}. After change ${epoch}, ${escaped(known)}.
${escaped(server)}. <a href="${escaped(address)}">Open this view</a></p>
<figure><img alt="The scene as seen during the review" src="${escaped(picture)}">${marks.join('')}</figure>
${content.scale ? scaleHtml(content.scale) : ''}
${section('Pins', ['#', 'Note', 'Illuminance then', 'After change', 'Light', 'By'], pins)}
${section('Measured points', ['#', 'Illuminance', 'Luminance', 'Error (95 %)', 'After change'], points)}
${section('Grid', ['Surface', 'Points', 'Minimum', 'Mean', 'Maximum', 'Uniformity Uo (minimum / mean)', 'Typical error (95 %)'], grid)}
${section('Changes', ['Change', 'Time', 'By', 'What'], changes)}
</body></html>
`;
}
