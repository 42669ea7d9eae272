// SPDX-License-Identifier: Apache-2.0
// Walls do not stop who walks or flies here, and behind them all is black: tells so while it is so, and offers the
// way back.

import {sameView} from './camera.js';

/** @typedef {import('../net/scene_types.js').View} View */

const LOOK_MS = 1000;
/** Mean of a picture's pixels below which nothing is seen, 0..255 as encoded. */
const DARK = 2;
/** Before so many iterations a picture may be dark wherever it is taken. */
const FEWEST_ITERATIONS = 4;

/** What is to be told of each picture that comes to rest. */
export class DarkViews {
    /** The newest view that showed something, from this side of all walls. @type {View | null} */
    good = null;
    /** The dark one that has been told of. @type {View | null} */
    #told = null;

    /**
     * @param {View} view
     * @param {boolean} dark
     * @param {boolean} [right]  whether the eye has come there past walls, not through them
     * @returns {'tell' | 'take back' | 'nothing'}
     */
    seen(view, dark, right = true) {
        if (!dark && right) {
            this.good = view;
            this.#told = null;
            return 'take back';
        }
        if (!dark || (this.#told && sameView(this.#told, view))) {
            return 'nothing';
        }
        this.#told = view;
        return 'tell';
    }
}

export class Lost {
    #views = new DarkViews();
    /** Takes the notice away; null: there is none. @type {(() => void) | null} */
    #notice = null;

    /**
     * @param {import('../app/app.js').RaybundleApp} app
     * @param {import('../measure/display_panel.js').DisplayPanel} display
     * @param {import('./collisions.js').Collisions} collisions
     */
    constructor(app, display, collisions) {
        this.app = app;
        this.display = display;
        this.collisions = collisions;
        app.on('anew', () => {
            this.#views = new DarkViews();
            this.#takeBack();
        });
        setInterval(() => this.#look(), LOOK_MS);
    }

    #look() {
        const {frame, link, view, camera, picture} = this.app;
        const here = frame && link.shown && sameView(link.shown, view) && !camera.moving;
        if (!here || (frame.iterations ?? 0) < FEWEST_ITERATIONS || document.hidden) {
            return;
        }
        // Who has chosen an exposure knows why it is dark.
        const exposed = this.display.mode === 'PHOTO' && this.display.autoExposure;
        const dark = exposed && picture.brightness < DARK;
        const what = this.#views.seen(view, dark, this.collisions.honest);
        if (what === 'tell') {
            this.#tell();
        } else if (what === 'take back') {
            this.#takeBack();
        }
    }

    #tell() {
        const {app} = this;
        const {good} = this.#views;
        const back = good
            ? {label: 'Back to where I was', run: () => app.camera.flyTo(good)}
            : {label: 'Back to the first camera', run: () => app.flyTo(0)};
        this.#takeBack();
        const text = 'There is nothing to see from here: it is dark, or this is the back of a wall.';
        this.#notice = app.status.notify(text, 'notice', back);
    }

    #takeBack() {
        this.#notice?.();
        this.#notice = null;
    }
}
