// SPDX-License-Identifier: Apache-2.0
// Viewpoints that somebody has saved for everybody, below the scene's own cameras.

import {byId, listRow, replaceRows, smallButton} from '../ui/elements.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('../net/protocol.js').SavedViewpoint} SavedViewpoint
 */

export class Viewpoints {
    /** @type {Map<number, SavedViewpoint>} */
    #viewpoints = new Map();

    /** @param {RaybundleApp} app */
    constructor(app) {
        this.app = app;
        const name = byId('viewpoint-name', HTMLInputElement);
        byId('viewpoint-form', HTMLFormElement).addEventListener('submit', async (event) => {
            event.preventDefault();
            const {eye, target, up, verticalFov} = app.view;
            const saveViewpoint = {name: name.value.trim(), eye, target, up, verticalFov};
            if (saveViewpoint.name && (await app.ask({saveViewpoint}))) {
                name.value = '';
            }
        });
        app.on('welcome', (welcome) => {
            const all = /** @type {SavedViewpoint[]} */ (welcome.viewpoints ?? []);
            this.#viewpoints = new Map(all.map((viewpoint) => [viewpoint.viewpoint, viewpoint]));
            this.#show();
        });
        app.on('message', ({viewpointChanged: changed}) => {
            if (changed?.removed) {
                this.#viewpoints.delete(changed.viewpoint);
            } else if (changed) {
                this.#viewpoints.set(changed.viewpoint, changed);
            }
            if (changed) {
                this.#show();
            }
        });
    }

    #show() {
        const rows = [...this.#viewpoints.values()].map(({viewpoint, camera}) => {
            const name = camera?.name ?? '';
            const row = listRow(name, () => camera && this.app.camera.flyTo(this.app.framed(camera)));
            if (this.app.mayReview) {
                const remove = () => this.app.ask({removeViewpoint: {viewpoint}});
                row.append(smallButton('×', `Remove the viewpoint ${name}`, remove));
            }
            return row;
        });
        replaceRows(byId('viewpoints', HTMLElement), rows);
        byId('viewpoint-form', HTMLElement).hidden = !this.app.mayReview;
    }
}
