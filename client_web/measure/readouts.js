// SPDX-License-Identifier: Apache-2.0
// The figures in the panel: accuracy, progress and stream. Drawn a few times a second, not for
// every frame.

import {announce, byId, showValue} from '../ui/elements.js';
import {drawErrorPlot} from './error_plot.js';
import {count, darkerThan, interval, milliseconds, percent, pictureError, progress, rate} from '../ui/format.js';
import {lightState} from '../lights/light_state.js';
import {ErrorHistory, RateMeter, Samples} from './meters.js';

/**
 * @typedef {import('../net/protocol.js').FrameHeader} FrameHeader
 * @typedef {import('../net/protocol.js').Solution} Solution
 */

const REFRESH_MS = 250;

export class Readouts {
    #frames = new RateMeter();
    #latency = new Samples();
    #roundTrip = new Samples(10);
    #decode = new Samples();
    #history = new ErrorHistory();
    /** @type {FrameHeader | null} */
    #header = null;
    /** @type {Solution | null} */
    #solution = null;
    #plot = byId('error-plot', SVGSVGElement);
    #state = byId('summary-state', HTMLElement);
    /** Relative error that is wanted, where one is. @type {number | null} */
    target = null;
    #bar = byId('settled', HTMLProgressElement);
    /** Where the last picture is redrawn. @type {import('../picture/picture.js').Picture | null} */
    picture = null;

    constructor() {
        setInterval(() => this.#refresh(), REFRESH_MS);
        this.#refresh();
    }

    /** Starts anew, with a new connection. */
    reset() {
        this.#solution = null;
        this.#latency.clear();
        this.#roundTrip.clear();
        this.#history.clear();
    }

    /** Forgets the picture, too: there is another scene. */
    forget() {
        this.reset();
        this.#header = null;
        this.#refresh();
    }

    /**
     * @param {FrameHeader} header
     * @param {number} decodeMs
     * @param {number | null} latencyMs  where the frame answers a camera
     */
    frame(header, decodeMs, latencyMs) {
        this.#header = header;
        this.#frames.count(performance.now());
        this.#decode.add(decodeMs);
        if (latencyMs !== null) {
            this.#latency.add(latencyMs);
        }
        this.#history.add(performance.now(), header);
    }

    /** @param {Solution} solution */
    solution(solution) {
        this.#solution = solution;
        this.#history.add(performance.now(), solution);
    }

    /** @param {number} ms */
    roundTrip(ms) {
        this.#roundTrip.add(ms);
    }

    /** The figures, for scripts. Delays are medians of the last ones, milliseconds. */
    get stats() {
        // What was said of the scene before its last change holds no more.
        const outdated = (this.#solution?.epoch ?? -1) < (this.#header?.epoch ?? -1);
        const state = outdated ? this.#header : (this.#solution ?? this.#header);
        return {
            framesPerSecond: this.#frames.rate(performance.now()),
            iterations: state?.iterations ?? null,
            iterationsPerSecond: this.#solution?.iterationsPerSecond ?? null,
            settled: state?.settled ?? 0,
            relativeError: state?.relativeError ?? null,
            errorLow: state?.errorLow ?? null,
            errorHigh: state?.errorHigh ?? null,
            errorMeasured: state?.errorMeasured ?? false,
            darkerThan: state?.darkerThan ?? null,
            secondsToTarget: this.#solution?.secondsToTarget ?? null,
            latencyMs: this.#latency.quantile(0.5),
            latencyP95Ms: this.#latency.quantile(0.95),
            roundTripMs: this.#roundTrip.quantile(0.5),
            decodeMs: this.#decode.quantile(0.5),
            redrawMs: this.picture?.redrawMs.quantile(0.5) ?? null,
        };
    }

    #refresh() {
        const stats = this.stats;
        const {errorLow: low, errorHigh: high, settled} = stats;
        const known = this.#header !== null || this.#solution !== null;
        const dark = stats.darkerThan !== null;
        const error = dark ? darkerThan(stats.darkerThan ?? 0) : pictureError(stats.relativeError);
        showValue('error', known ? error : percent(null));
        showValue('errorInterval', dark ? error : interval(low, high));
        showValue('errorBasis', stats.errorMeasured ? 'measured' : 'estimated');
        showValue('iterations', count(stats.iterations));
        showValue('iterationRate', rate(stats.iterationsPerSecond));
        showValue('frameRate', rate(stats.framesPerSecond));
        showValue('latency', milliseconds(stats.latencyMs));
        showValue('latencyP95', milliseconds(stats.latencyP95Ms));
        showValue('roundTrip', milliseconds(stats.roundTripMs));
        showValue('decode', milliseconds(stats.decodeMs));
        const warping = this.picture?.warping ?? 'flat';
        const measured = warping === 'by depth' && stats.redrawMs !== null;
        showValue('redraw', measured ? `${warping}, ${milliseconds(stats.redrawMs)}` : warping);
        showValue('settled', this.#header || this.#solution ? progress(settled) : '–');
        this.#bar.value = settled;
        const {mark, text} = lightState(stats, known);
        this.#bar.classList.toggle('done', mark === 'yes');
        const before = this.#state.dataset.settled;
        this.#state.dataset.settled = mark;
        if (mark === 'yes' && before !== 'yes') {
            announce(dark ? `${text}.` : `The light has settled, error ${error}.`);
        }
        showValue('settledState', text);
        this.#showFormat();
        drawErrorPlot(this.#plot, this.#history.samples, this.target);
    }

    #showFormat() {
        const header = this.#header;
        const quality = header?.codec === 'JPEG' ? ` ${header.quality}` : '';
        const format = header
            ? `${header.width} × ${header.height} ${header.codec}${quality}`
            : '–';
        showValue('format', format);
    }
}
