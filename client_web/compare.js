// SPDX-License-Identifier: Apache-2.0
// Before and after: a picture that is kept, wiped against the light now from the same camera.

import {sameView} from './camera.js';
import {byId, showValue} from './elements.js';

/**
 * @typedef {import('./app.js').RaybundleApp} RaybundleApp
 * @typedef {import('./display_panel.js').DisplayPanel} DisplayPanel
 * @typedef {import('./protocol.js').View} View
 * @typedef {{view: View, epoch: number, exposure: number, time: Date}} KeptPicture
 */

export class Compare {
    /** @type {KeptPicture | null} */
    kept = null;
    #canvas = byId('compare-canvas', HTMLCanvasElement);
    #wipe = byId('wipe', HTMLElement);
    #at = byId('wipe-at', HTMLInputElement);
    #button = byId('compare', HTMLButtonElement);

    /**
     * @param {RaybundleApp} app
     * @param {DisplayPanel} display
     */
    constructor(app, display) {
        this.app = app;
        this.display = display;
        byId('keep-picture', HTMLElement).addEventListener('click', () => this.keep());
        this.#button.addEventListener('click', () => this.show(this.#wipe.hidden));
        this.#at.addEventListener('input', () => this.#cut());
        app.on('view', (/** @type {View} */ view) => {
            if (!this.#wipe.hidden && this.kept && !sameView(view, this.kept.view)) {
                this.show(false);
            }
        });
        app.picture.addEventListener('resize', () => this.show(false));
    }

    /** Keeps the picture that is on screen. */
    keep() {
        const {canvas} = this.app.picture;
        const {frame, link} = this.app;
        if (!frame || !link.shown) {
            return;
        }
        this.#canvas.width = canvas.width;
        this.#canvas.height = canvas.height;
        this.#canvas.getContext('2d')?.drawImage(canvas, 0, 0);
        const {epoch, exposure} = frame;
        this.kept = {view: link.shown, epoch, exposure, time: new Date()};
        this.#button.disabled = false;
        const time = this.kept.time.toLocaleTimeString([], {timeStyle: 'short'});
        showValue('compareState', `Kept at ${time}, epoch ${epoch}.`);
    }

    /** @param {boolean} on  from the camera of the kept picture */
    show(on) {
        const kept = this.kept;
        const shown = on && kept !== null;
        if (shown && kept) {
            this.app.view = kept.view;
            // The same exposure, or the comparison would be of exposures.
            if (this.display.autoExposure) {
                this.display.autoExposure = false;
                this.display.setExposure(Math.round(kept.exposure * 4) / 4);
            }
        }
        this.#wipe.hidden = !shown;
        this.#canvas.hidden = !shown;
        this.#button.setAttribute('aria-pressed', String(shown));
        this.#cut();
    }

    #cut() {
        const share = Number(this.#at.value);
        this.#canvas.style.clipPath = `inset(0 ${(100 * (1 - share)).toFixed(1)}% 0 0)`;
        this.#wipe.style.setProperty('--at', `${(100 * share).toFixed(1)}%`);
        this.#at.setAttribute('aria-valuetext', `${Math.round(100 * share)} % earlier`);
    }
}
