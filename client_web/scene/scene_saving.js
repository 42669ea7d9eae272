// SPDX-License-Identifier: Apache-2.0
// "Save as …": the scene as it has been edited, in one GLB file.

import {byId, fileName, saveFile} from '../ui/elements.js';
import {sizeText} from './scene_files.js';

/**
 * What is said once the file is there.
 *
 * @param {number} bytes
 * @param {string | null} notes  the answer's header: what the file lacks, escaped as in a URI
 */
export function savedText(bytes, notes) {
    const lacks = notes ? ` It lacks something: ${decodeURIComponent(notes)}.` : '';
    return `Saved, ${sizeText(bytes)}.${lacks}`;
}

export class SceneSaving {
    #button = byId('scene-save', HTMLButtonElement);
    #state = byId('scene-save-state', HTMLElement);

    /** @param {import('../app/app.js').RaybundleApp} app */
    constructor(app) {
        this.app = app;
        this.#button.addEventListener('click', () => this.#save());
        app.on('welcome', () => {
            this.#state.textContent = '';
        });
    }

    async #save() {
        this.#button.disabled = true;
        this.#state.textContent = 'Being written …';
        try {
            const answer = await fetch(new URL('scene.glb', location.href), {headers: this.app.client.httpHeaders});
            if (answer.ok) {
                const file = await answer.blob();
                saveFile(file, `${fileName(this.app.scene?.title ?? '') || 'scene'}.glb`);
                this.#state.textContent = savedText(file.size, answer.headers.get('x-raybundle-notes'));
            } else {
                this.#state.textContent = (await answer.text()).trim();
            }
        } catch {
            this.#state.textContent = 'The connection was lost.';
        }
        this.#button.disabled = false;
    }
}
