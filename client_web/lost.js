// SPDX-License-Identifier: Apache-2.0
// Walls do not stop who walks here, and behind them all is black: tells so, and offers the way back.

import {sameView} from './camera.js';

const LOOK_MS = 1000;
/** Mean of a picture's pixels below which nothing is seen, 0..255 as encoded. */
const DARK = 2;
/** Before so many iterations a picture may be dark wherever it is taken. */
const FEWEST_ITERATIONS = 4;

export class Lost {
    #told = false;

    /**
     * @param {import('./app.js').RaybundleApp} app
     * @param {import('./display_panel.js').DisplayPanel} display
     */
    constructor(app, display) {
        this.app = app;
        this.display = display;
        setInterval(() => this.#look(), LOOK_MS);
    }

    #look() {
        const {frame, link, view, camera, picture, status} = this.app;
        const here = frame && link.shown && sameView(link.shown, view) && !camera.moving;
        if (!here || (frame.iterations ?? 0) < FEWEST_ITERATIONS || document.hidden) {
            return;
        }
        // Who has chosen an exposure knows why it is dark.
        const exposed = this.display.mode === 'PHOTO' && this.display.autoExposure;
        const lost = exposed && picture.brightness < DARK;
        if (lost && !this.#told) {
            const back = {label: 'Back to the first camera', run: () => this.app.flyTo(0)};
            status.notify('There is nothing to see from here: you may have walked through a wall.', 'notice', back);
        }
        this.#told = lost;
    }
}
