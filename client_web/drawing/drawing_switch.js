// SPDX-License-Identifier: Apache-2.0
// Who draws while something moves: the user's choice, and what has become of it.

import {remember, remembered} from '../camera/walking.js';
import {byId} from '../ui/elements.js';
import {LocalDrawing} from './local_drawing.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('./local_drawing.js').DrawingChoice} DrawingChoice
 */

/** @param {string | null} text @returns {DrawingChoice} */
const choiceOf = (text) => (text === 'here' || text === 'pictures' ? text : 'auto');

/**
 * @param {RaybundleApp} app
 * @param {{autoExposure: boolean}} display
 * @param {string | null} asked  in the page's address
 * @returns {LocalDrawing}
 */
export function addDrawing(app, display, asked) {
    const drawing = new LocalDrawing(app, display, choiceOf(asked ?? remembered('drawing')));
    const select = byId('drawing', HTMLSelectElement);
    const state = byId('drawing-state', HTMLElement);
    const show = () => {
        state.textContent = drawing.state;
    };
    select.value = drawing.choice;
    select.disabled = !drawing.possible;
    select.addEventListener('change', () => {
        drawing.choice = choiceOf(select.value);
        remember('drawing', drawing.choice);
    });
    drawing.addEventListener('state', show);
    app.on('welcome', show);
    show();
    return drawing;
}
