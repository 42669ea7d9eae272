// SPDX-License-Identifier: Apache-2.0
// Aiming a light by a click on what it shall shine at.

import {lightName} from './light_card.js';
import {aimAt} from './light_place.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('../net/scene_types.js').Light} Light
 * @typedef {import('../scene/surface_change.js').SurfaceChange} SurfaceChange
 */

export class LightAiming {
    /** @type {{light: Light, change: SurfaceChange} | null} */
    #aimed = null;
    /** Takes the notice away that asks for the click. */
    #unsay = () => {};

    /** @param {RaybundleApp} app */
    constructor(app) {
        this.app = app;
        app.on('tool', (tool) => {
            if (tool !== 'aim') {
                this.#aimed = null;
                this.#unsay();
            }
        });
    }

    /**
     * The next click in the picture says where it shall shine.
     *
     * @param {Light} light
     * @param {SurfaceChange} change
     */
    begin(light, change) {
        this.#aimed = {light, change};
        this.app.setTool('aim');
        this.#unsay = this.app.status.notify(`Click what ${lightName(light)} shall shine at. Esc leaves it as it is.`);
        this.app.picture.element.focus({preventScroll: true});
    }

    /** Leaves the light as it is. Returns whether one was to be aimed. */
    cancel() {
        const begun = this.#aimed !== null;
        if (begun) {
            this.app.setTool('select');
        }
        return begun;
    }

    /**
     * @param {import('../camera/pointer_control.js').Point} at  CSS pixels
     * @returns {Promise<void>}
     */
    async clickAt(at) {
        const aimed = this.#aimed;
        const met = (await this.app.probeAt(at))?.position;
        if (!aimed || aimed !== this.#aimed) {
            return;
        }
        const {position} = aimed.light;
        const aim = met && position ? aimAt(position, met) : null;
        if (aim) {
            this.app.setTool('select');
            await aimed.change.done({aim});
        } else {
            this.app.status.notify('Nothing is there to aim at. Click a surface.');
        }
    }
}
