// SPDX-License-Identifier: Apache-2.0
// Measurements over the last moments: rates, typical delays, and the course of the error.

/** Events per second over a sliding window. */
export class RateMeter {
    /** @type {number[]} */
    #times = [];

    /** @param {number} windowMs */
    constructor(windowMs = 3000) {
        this.windowMs = windowMs;
    }

    /** @param {number} now  milliseconds */
    count(now) {
        this.#times.push(now);
        this.#forget(now);
    }

    /**
     * @param {number} now  milliseconds
     * @returns {number} events per second
     */
    rate(now) {
        this.#forget(now);
        return (this.#times.length * 1000) / this.windowMs;
    }

    /** @param {number} now */
    #forget(now) {
        while (this.#times.length > 0 && now - this.#times[0] > this.windowMs) {
            this.#times.shift();
        }
    }
}

/** Quantiles of the last samples. */
export class Samples {
    /** @type {number[]} */
    #values = [];

    /** @param {number} capacity */
    constructor(capacity = 30) {
        this.capacity = capacity;
    }

    /** @param {number} value */
    add(value) {
        this.#values.push(value);
        if (this.#values.length > this.capacity) {
            this.#values.shift();
        }
    }

    get count() {
        return this.#values.length;
    }

    /** Forgets everything. */
    clear() {
        this.#values = [];
    }

    /**
     * @param {number} fraction  0.5 for the median
     * @returns {number | null} null: no samples
     */
    quantile(fraction) {
        if (this.#values.length === 0) {
            return null;
        }
        const sorted = [...this.#values].sort((a, b) => a - b);
        return sorted[Math.min(Math.floor(fraction * sorted.length), sorted.length - 1)];
    }
}

/** @typedef {import('./error_plot.js').PlotSample} PlotSample */

/** Samples follow one another in steps of this factor of the time, or they are left out. */
const NEXT_SAMPLE = 1.04;
const LEAST_STEP_S = 0.05;

/** The estimated error since the last change of the scene; bounded, since its time is logarithmic. */
export class ErrorHistory {
    /** @type {PlotSample[]} */
    samples = [];
    #epoch = -1;
    #start = 0;

    /**
     * @param {number} now  milliseconds
     * @param {{epoch: number, relativeError?: number, errorLow?: number, errorHigh?: number}} state
     * @returns {boolean} whether it was taken
     */
    add(now, {epoch, relativeError: error, errorLow, errorHigh}) {
        if (epoch !== this.#epoch) {
            this.#epoch = epoch;
            this.#start = now;
            this.samples = [];
        }
        const seconds = (now - this.#start) / 1000;
        const last = this.samples.at(-1)?.seconds ?? 0;
        const soon = seconds < Math.max(last * NEXT_SAMPLE, last + LEAST_STEP_S);
        if (error === undefined || !(error > 0) || !Number.isFinite(error) || soon) {
            return false;
        }
        this.samples.push({seconds, error, low: errorLow ?? error, high: errorHigh ?? error});
        return true;
    }

    /** Forgets everything. */
    clear() {
        this.samples = [];
        this.#epoch = -1;
    }
}
