// SPDX-License-Identifier: Apache-2.0
// The newest measured points in a corner of the picture, for who measures while the panel is closed, as it
// is on a phone.

import {byId} from '../ui/elements.js';

/** As many points as leave the picture free. */
const SHOWN = 3;

export class MeasuredStrip {
    #strip = byId('measured', HTMLElement);
    #list = byId('measured-list', HTMLOListElement);

    /**
     * @param {import('../app/app.js').RaybundleApp} app
     * @param {import('./measure.js').Measuring} measuring
     * @param {() => void} openList  shows all of them, in the panel
     */
    constructor(app, measuring, openList) {
        this.measuring = measuring;
        const touch = matchMedia('(pointer: coarse)').matches;
        byId('measured-hint', HTMLElement).textContent = `${touch ? 'Tap' : 'Click'} a surface to measure its light.`;
        app.on('tool', (tool) => {
            this.#strip.hidden = tool !== 'measure';
        });
        measuring.addEventListener('values', () => this.#show());
        byId('measured-all', HTMLElement).addEventListener('click', openList);
        this.#show();
    }

    #show() {
        const {points} = this.measuring;
        const rows = points.slice(-SHOWN).map(({number, text}) => {
            const row = document.createElement('li');
            const badge = document.createElement('b');
            badge.textContent = String(number);
            row.append(badge, text);
            return row;
        });
        this.#list.replaceChildren(...rows);
        byId('measured-hint', HTMLElement).hidden = rows.length > 0;
        byId('measured-all', HTMLElement).textContent = points.length > SHOWN ? `Show all ${points.length} points` : 'Show list';
    }
}
