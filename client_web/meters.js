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

/**
 * @typedef {object} ErrorSample
 * @property {number} time  milliseconds
 * @property {number} error
 * @property {number} low
 * @property {number} high
 * @property {number} epoch
 */

/** The estimated error over the last minute. */
export class ErrorHistory {
    /** @type {ErrorSample[]} */
    samples = [];

    /**
     * @param {number} spanMs
     * @param {number} intervalMs  samples that follow sooner are left out
     */
    constructor(spanMs = 60000, intervalMs = 250) {
        this.spanMs = spanMs;
        this.intervalMs = intervalMs;
    }

    /**
     * @param {number} now  milliseconds
     * @param {{epoch: number, relativeError?: number, errorLow?: number, errorHigh?: number}} state
     * @returns {boolean} whether it was taken
     */
    add(now, {epoch, relativeError: error, errorLow, errorHigh}) {
        const last = this.samples.at(-1);
        const soon = last && now - last.time < this.intervalMs && last.epoch === epoch;
        if (error === undefined || !(error > 0) || !Number.isFinite(error) || soon) {
            return false;
        }
        const sample = {time: now, error, low: errorLow ?? error, high: errorHigh ?? error, epoch};
        this.samples.push(sample);
        while (now - this.samples[0].time > this.spanMs) {
            this.samples.shift();
        }
        return true;
    }

    /** Forgets everything. */
    clear() {
        this.samples = [];
    }
}
