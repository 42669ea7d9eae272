// SPDX-License-Identifier: Apache-2.0
// Scenes that the server can open for everybody: a list, and uploads by button or by dropping a
// file on the page. For editors; everybody is told when a scene is being opened.

import {byId, listRow, replaceRows} from './elements.js';

/**
 * @typedef {import('./app.js').RaybundleApp} RaybundleApp
 * @typedef {import('./protocol.js').SceneFile} SceneFile
 * @typedef {import('./protocol.js').SceneOpening} SceneOpening
 */

/** What the stages of opening a scene are called. */
const STAGES = /** @type {Record<string, string>} */ ({
    READING: 'is being read',
    PREPARING: 'is being cut into patches',
    COMPILING: 'is being made ready',
    READY: 'is about to be shown',
});

/**
 * One line about a scene that somebody opens.
 *
 * @param {SceneOpening} opening
 */
export function openingText({name, stage, reason}) {
    return stage === 'REJECTED'
        ? `${name} cannot be opened: ${reason}`
        : `${name} ${STAGES[stage] ?? 'is being opened'}.`;
}

/** The same as steps, for everybody who watches. */
const STEPS = /** @type {Record<string, string>} */ ({
    READING: 'step 1 of 3, reading',
    PREPARING: 'step 2 of 3, cutting into patches',
    COMPILING: 'step 3 of 3, the picture stands still for it',
    READY: 'about to be shown',
});

/**
 * How far a scene is that somebody opens, for everybody; empty where it is over.
 *
 * @param {SceneOpening} opening
 * @param {boolean} mine
 */
export function progressText({name, byName, stage}, mine) {
    const who = mine ? 'You open' : `${byName || 'Somebody'} opens`;
    return STEPS[stage] ? `${who} ${name}: ${STEPS[stage]}` : '';
}

/**
 * What the list of scenes says of one.
 *
 * @param {string} name
 * @param {string} current  scene that is shown
 * @param {string} coming  scene that somebody opens; empty: none
 * @returns {string} empty: nothing
 */
export function listTag(name, current, coming) {
    if (name === coming) {
        return 'being opened';
    }
    return name === current ? (coming ? 'still shown' : 'shown') : '';
}

/**
 * @param {string} name  of a scene
 * @param {number} others  who are here
 */
export function openingQuestion(name, others) {
    const who = others === 1 ? 'somebody else is' : `${others} others are`;
    return `Open ${name}? It replaces the scene for everybody, and ${who} here.`;
}

/**
 * Size for people.
 *
 * @param {number} bytes
 */
export function sizeText(bytes) {
    return bytes < 1e6 ? `${Math.ceil(bytes / 1000)} kB` : `${(bytes / 1e6).toFixed(1)} MB`;
}

/**
 * Why a file is not even sent; empty where it is.
 *
 * @param {{name: string, size: number}} file
 * @param {number} maxBytes  that the server takes
 */
export function uploadProblem({name, size}, maxBytes) {
    if (!name.toLowerCase().endsWith('.glb')) {
        return `${name} is no .glb file. Export the scene as binary glTF, one file that holds everything.`;
    }
    return size > maxBytes
        ? `${name} has ${sizeText(size)}; this server takes up to ${sizeText(maxBytes)}.`
        : '';
}

export class SceneFiles {
    #section = byId('scene-files', HTMLElement);
    #list = byId('scene-file-list', HTMLElement);
    #state = byId('scene-file-state', HTMLElement);
    #progress = byId('scene-file-progress', HTMLProgressElement);
    #chooser = byId('scene-file', HTMLInputElement);
    #add = byId('add-scene', HTMLButtonElement);
    #maxBytes = 0;
    /** What the server said last of its folder. @type {import('./protocol.js').SceneList | null} */
    #known = null;
    /** Scene that somebody opens; empty: none. */
    #coming = '';
    /** How many others are here. */
    #others = 0;
    /** Scene that the user is asked about. */
    #asked = '';
    #question = byId('scene-file-question', HTMLElement);

    /** @param {RaybundleApp} app */
    constructor(app) {
        this.app = app;
        app.on('welcome', () => this.#welcomed());
        app.on('message', (/** @type {import('./protocol.js').ServerMessage} */ {sceneOpening, presence}) => {
            if (sceneOpening?.by) {
                this.#opening(sceneOpening);
            }
            if (presence) {
                const own = app.client.welcome?.viewer;
                this.#others = presence.viewers.filter(({viewer}) => viewer !== own).length;
            }
        });
        byId('scene-file-cancel', HTMLElement).addEventListener('click', () => this.#ask(''));
        byId('scene-file-open', HTMLElement).addEventListener('click', () => this.#open(this.#asked));
        this.#add.addEventListener('click', () => this.#chooser.click());
        this.#chooser.addEventListener('change', () => {
            this.#upload(this.#chooser.files?.[0]);
            this.#chooser.value = '';
        });
        this.#takeDrops();
    }

    /** Files that are dropped on the page; otherwise the browser would leave it for them. */
    #takeDrops() {
        const target = byId('drop-target', HTMLElement);
        const over = (/** @type {DragEvent} */ event) => {
            if (event.dataTransfer?.types.includes('Files')) {
                event.preventDefault();
                event.dataTransfer.dropEffect = this.#mayUpload ? 'copy' : 'none';
                target.hidden = !this.#mayUpload;
            }
        };
        document.addEventListener('dragenter', over);
        document.addEventListener('dragover', over);
        document.addEventListener('dragleave', (event) => {
            target.hidden ||= event.relatedTarget === null;
        });
        document.addEventListener('drop', (event) => {
            target.hidden = true;
            const file = event.dataTransfer?.files[0];
            if (file) {
                event.preventDefault();
                this.#dropped(file);
            }
        });
    }

    /** @param {File} file */
    #dropped(file) {
        if (this.#mayUpload) {
            this.app.dispatchEvent(new Event('upload'));
            this.#upload(file);
        } else {
            const looks = 'Your role is to look, not to add scenes.';
            this.app.status.notify(this.app.mayEdit ? 'This server takes no scenes.' : looks);
        }
    }

    get #mayUpload() {
        return !this.#section.hidden && this.#maxBytes > 0;
    }

    async #refresh() {
        this.#section.hidden = !(this.app.mayEdit && this.app.client.welcome?.canOpenScenes);
        if (this.#section.hidden) {
            return;
        }
        const list = (await this.app.ask({listScenes: {}}))?.sceneList;
        if (!list) {
            return;
        }
        this.#maxBytes = list.maxUploadBytes;
        this.#add.hidden = this.#maxBytes === 0;
        this.#known = list;
        this.#showList();
    }

    #showList() {
        const {scenes = [], current = ''} = this.#known ?? {};
        const rows = scenes.map(({name, bytes}) => {
            const tag = listTag(name, current, this.#coming) || sizeText(bytes);
            const row = listRow(name, () => this.#choose(name), tag);
            row.firstElementChild?.setAttribute('aria-pressed', String(name === current));
            return row;
        });
        replaceRows(this.#list, rows);
        byId('scene-files-none', HTMLElement).hidden = rows.length > 0;
    }

    /** A connection begins anew, and what was coming is there. */
    #welcomed() {
        if (this.#coming) {
            this.#say('');
        }
        this.#coming = '';
        this.#ask('');
        this.#refresh();
    }

    /** @param {string} name */
    #choose(name) {
        if (name === this.#known?.current) {
            this.#ask('');
            this.#say(`${name} is shown already.`);
        } else if (this.#others > 0) {
            this.#ask(name);
        } else {
            this.#open(name);
        }
    }

    /**
     * Asks whether to open a scene, since everybody will see it.
     *
     * @param {string} name  empty: not any more
     */
    #ask(name) {
        this.#asked = name;
        this.#question.hidden = name === '';
        if (name) {
            this.#say('');
            byId('scene-file-asked', HTMLElement).textContent = openingQuestion(name, this.#others);
            byId('scene-file-open', HTMLElement).focus();
            this.#question.scrollIntoView({block: 'nearest'});
        }
    }

    /** @param {string} name */
    async #open(name) {
        this.#ask('');
        const text = `${name} is being opened.`;
        this.#say(text);
        const opened = await this.app.ask({openScene: {name}});
        if (!opened && this.#state.textContent === text) {
            this.#say('');
        }
    }

    /** @param {SceneOpening} opening */
    #opening(opening) {
        const text = openingText(opening);
        const mine = opening.by === this.app.client.welcome?.viewer;
        this.#say(text, opening.stage === 'REJECTED');
        this.#coming = opening.stage === 'REJECTED' ? '' : opening.name;
        this.#showList();
        const progress = progressText(opening, mine);
        this.app.status.showOpening(progress ? opening.name : '', progress);
        if (!mine && opening.stage === 'REJECTED') {
            const who = opening.byName ? `${opening.byName}: ` : '';
            this.app.status.notify(who + text);
        }
    }

    /** @param {File | undefined} file */
    #upload(file) {
        if (!file) {
            return;
        }
        const problem = uploadProblem(file, this.#maxBytes);
        if (problem) {
            this.#say(problem, true);
            return;
        }
        const name = file.name.replace(/\.glb$/i, '.glb');
        const request = new XMLHttpRequest();
        request.open('PUT', new URL(`scenes/${encodeURIComponent(name)}`, location.href));
        const {token} = this.app.client.settings;
        if (token) {
            request.setRequestHeader('Authorization', `Bearer ${token}`);
        }
        request.upload.onprogress = ({loaded, total}) => {
            this.#progress.value = loaded / Math.max(total, 1);
        };
        request.upload.onload = () => this.#say(`${name} is being checked.`);
        request.onload = () => {
            const stored = request.status === 200 || request.status === 201;
            this.#ended(stored ? `${name} is in the list now.` : request.responseText.trim(), !stored);
        };
        request.onerror = () => this.#ended(`${name} could not be sent.`, true);
        this.#say(`${name} is being sent.`);
        this.#progress.value = 0;
        this.#progress.hidden = false;
        this.#add.disabled = true;
        request.send(file);
    }

    /**
     * @param {string} text
     * @param {boolean} failed
     */
    #ended(text, failed) {
        this.#progress.hidden = true;
        this.#add.disabled = false;
        this.#say(text, failed);
        this.#refresh();
    }

    /**
     * @param {string} text
     * @param {boolean} failed
     */
    #say(text, failed = false) {
        this.#state.textContent = text;
        this.#state.classList.toggle('problem', failed);
    }
}
