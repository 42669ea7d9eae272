// SPDX-License-Identifier: Apache-2.0
// Dark or light, as the system has it until somebody chooses.

import {byId, returnFocus} from '../ui/elements.js';
import {remember, remembered} from '../camera/walking.js';

const KEY = 'theme';

/** Lets the button of the bar choose, and takes up the last choice. */
export function addTheme() {
    const root = document.documentElement;
    const button = byId('theme', HTMLButtonElement);
    const again = byId('theme-again', HTMLButtonElement);
    const light = matchMedia('(prefers-color-scheme: light)');
    const now = () => root.dataset.theme ?? (light.matches ? 'light' : 'dark');
    const show = () => {
        const other = now() === 'light' ? 'dark' : 'light';
        button.title = `Change to ${other}`;
        button.setAttribute('aria-label', `Change to ${other} colours`);
        again.textContent = `Change to ${other} colours`;
    };
    const last = remembered(KEY);
    if (last === 'dark' || last === 'light') {
        root.dataset.theme = last;
    }
    for (const either of [button, again]) {
        either.addEventListener('click', (event) => {
            root.dataset.theme = now() === 'light' ? 'dark' : 'light';
            remember(KEY, root.dataset.theme);
            show();
            returnFocus(event);
        });
    }
    light.addEventListener('change', show);
    show();
}
