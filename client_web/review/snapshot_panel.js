// SPDX-License-Identifier: Apache-2.0
// A picture that the server renders beside what viewers watch: of any size, as accurate as asked,
// as PNG or as linear radiance in an EXR.

import {byId, fileName} from '../ui/elements.js';
import {percent} from '../ui/format.js';
import {requestSnapshot} from './snapshot_request.js';

/** @typedef {import('../app/app.js').RaybundleApp} RaybundleApp */

/**
 * Size of a snapshot with the shape of the picture on screen.
 *
 * @param {number} width  pixels to have; 0: as on screen
 * @param {{width: number, height: number}} screen  pixels
 * @param {import('../net/protocol.js').Limits} limits  of the server
 * @returns {{width: number, height: number}}
 */
export function snapshotSize(width, screen, limits) {
    const wanted = width || screen.width;
    const most = {width: limits.maxSnapshotEdge || limits.maxWidth, height: limits.maxSnapshotEdge || limits.maxHeight};
    const scale = Math.min(wanted / screen.width, most.width / screen.width, most.height / screen.height);
    const side = (/** @type {number} */ pixels, /** @type {number} */ most) =>
        Math.min(Math.max(Math.round(pixels * scale), 1), most);
    return {
        width: side(screen.width, most.width),
        height: side(screen.height, most.height),
    };
}

export class SnapshotPanel {
    #button = byId('snapshot', HTMLButtonElement);
    #cancel = byId('snapshot-cancel', HTMLButtonElement);
    #width = byId('snapshot-width', HTMLSelectElement);
    #error = byId('snapshot-error', HTMLSelectElement);
    #format = byId('snapshot-format', HTMLSelectElement);
    #state = byId('snapshot-state', HTMLElement);

    /** @param {RaybundleApp} app */
    constructor(app) {
        this.app = app;
        this.#button.addEventListener('click', () => this.#render());
    }

    async #render() {
        const {canvas, limits} = this.app.picture;
        const snapshot = {
            ...snapshotSize(Number(this.#width.value), canvas, limits),
            relativeError: Number(this.#error.value),
            format: this.#format.value,
        };
        const size = `${snapshot.width} × ${snapshot.height}`;
        this.#button.disabled = true;
        const tell = (/** @type {string} */ how) => {
            this.#state.textContent = `${size} pixels are being rendered: ${how}. Go on meanwhile.`;
        };
        tell('it has just begun');
        const ready = await requestSnapshot(this.app, snapshot, this.#cancel, tell);
        this.#button.disabled = false;
        if (!ready) {
            this.#state.textContent = 'It was not rendered.';
            return;
        }
        const link = document.createElement('a');
        link.href = new URL(ready.url.replace(/^\//, ''), location.href).href;
        const name = fileName(this.app.scene?.title ?? 'picture');
        link.download = `${name}_epoch_${ready.epoch}.${snapshot.format.toLowerCase()}`;
        link.textContent = `Save ${size} ${snapshot.format}`;
        const note = ` (error below ${percent(ready.relativeError)}; kept for 15 minutes)`;
        this.#state.replaceChildren(link, note);
    }
}
