// SPDX-License-Identifier: Apache-2.0
// Scenes that the server can open for everybody: a list, and uploads by button or by dropping a
// file on the page. For editors; everybody is told when a scene is being opened.

import {nameOf} from '../review/arrivals.js';
import {byId, listRow, replaceRows} from '../ui/elements.js';
import {progressText} from './opening.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('../net/protocol.js').SceneFile} SceneFile
 * @typedef {import('../net/protocol.js').SceneOpening} SceneOpening
 */

/**
 * What people read first of a reason that a file is refused for, and the rest.
 *
 * @param {string} reason  e.g. "not glTF: parse error at line 1"
 * @returns {{text: string, details: string}}
 */
export function refusalOf(reason) {
    const plain = reason.replace(/^Rejected: /, '');
    const known = REASONS.find(({sign}) => sign.test(plain));
    return known ? {text: known.text, details: plain} : {text: 'This scene cannot be used.', details: plain};
}

const REASONS = [
    {sign: /^not glTF|parse error/i, text: 'This is not a glTF file.'},
    {sign: /cut off|^GLB |bytes are left/, text: 'This file is damaged, or not whole.'},
    {sign: /out of memory/, text: 'This scene is too large for the server’s memory.'},
    {sign: /cannot be read/, text: 'The server could not read this file.'},
    {sign: /extensionsRequired|extension/, text: 'This scene needs a glTF extension that the server does not know.'},
    {sign: /no room/, text: 'The server has no room for this scene.'},
];

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

/** So many are named, the others counted. */
const MAX_NAMED = 4;

/**
 * @param {string[]} names
 * @returns {string} e.g. "Ann, Ben and 3 others"
 */
export function namesText(names) {
    const rest = names.length - MAX_NAMED;
    const said = rest > 1 ? [...names.slice(0, MAX_NAMED), `${rest} others`] : names;
    return said.length < 2 ? said.join('') : `${said.slice(0, -1).join(', ')} and ${said[said.length - 1]}`;
}

/** @type {(count: number, one: string) => string} */
const counted = (count, one) => `${count} ${one}${count === 1 ? '' : 's'}`;

/**
 * What somebody is asked before another scene is opened.
 *
 * @param {string} name  of a scene
 * @param {{others: string[], changes: number, pins: number, forgets: boolean}} now  names of who else is here; what
 *     has been left in the present scene, and whether the server forgets it
 * @returns {string} empty: nobody and nothing is affected
 */
export function openingQuestion(name, {others, changes, pins, forgets}) {
    const left = [changes > 0 ? counted(changes, 'change') : '', pins > 0 ? counted(pins, 'pin') : ''].filter(Boolean);
    if (others.length === 0 && left.length === 0) {
        return '';
    }
    const who = others.length > 0 ? ` It replaces the scene for ${namesText(others)}, too.` : '';
    const what = left.join(' and ');
    const one = changes + pins === 1;
    const fate = forgets
        ? ` The ${what} in the present scene will be lost.`
        : ` The ${what} in the present scene ${one ? 'is' : 'are'} saved, and there when it is opened again.`;
    return `Open ${name}?${who}${what ? fate : ''}`;
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
        return `${name} is not a .glb file. Export the scene as binary glTF, one file that holds everything.`;
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
    /** What the server said last of its folder. @type {import('../net/protocol.js').SceneList | null} */
    #known = null;
    /** Scene that somebody opens; empty: none. */
    #coming = '';
    /** Names of who else is here. @type {string[]} */
    #others = [];
    /** Scene that the user is asked about. */
    #asked = '';
    #question = byId('scene-file-question', HTMLElement);

    /**
     * @param {RaybundleApp} app
     * @param {() => {changes: number, pins: number, forgets: boolean}} leaves  what opening another scene leaves behind
     */
    constructor(app, leaves) {
        this.app = app;
        this.leaves = leaves;
        app.on('welcome', () => this.#welcomed());
        app.on('message', (/** @type {import('../net/protocol.js').ServerMessage} */ {sceneOpening, presence}) => {
            if (sceneOpening?.by) {
                this.#opening(sceneOpening);
            } else if (sceneOpening) {
                if (this.#coming) {
                    this.#say('');  // the card says how far it is
                }
                this.app.status.showOpening(sceneOpening, false);
            }
            if (presence) {
                const own = app.client.welcome?.viewer;
                this.#others = presence.viewers.filter(({viewer}) => viewer !== own).map(nameOf);
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
            const looks = 'View only. Ask for editor access to add scenes.';
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
            this.#say(`${name} is already open.`);
        } else if (this.#questionOf(name)) {
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
            byId('scene-file-asked', HTMLElement).textContent = this.#questionOf(name);
            const everybody = this.#others.length > 0;
            byId('scene-file-open', HTMLElement).textContent = everybody ? 'Open for everybody' : 'Open';
            byId('scene-file-open', HTMLElement).focus();
            this.#question.scrollIntoView({block: 'nearest'});
        }
    }

    /** @param {string} name */
    #questionOf(name) {
        return openingQuestion(name, {others: this.#others, ...this.leaves()});
    }

    /** @param {string} name */
    async #open(name) {
        this.#ask('');
        const text = `Opening ${name}.`;
        this.#say(text);
        const opened = await this.app.ask({openScene: {name}});
        if (!opened && this.#state.textContent === text) {
            this.#say('');
        }
    }

    /** @param {SceneOpening} opening */
    #opening(opening) {
        const mine = opening.by === this.app.client.welcome?.viewer;
        const rejected = opening.stage === 'REJECTED';
        const {text: why, details} = refusalOf(opening.reason);
        const text = rejected ? `Could not open ${opening.name}. ${why}` : progressText(opening, mine);
        this.#say(text, rejected, rejected ? details : '');
        this.#coming = opening.stage === 'REJECTED' ? '' : opening.name;
        this.#showList();
        this.app.status.showOpening(rejected ? null : opening, mine);
        if (!mine && rejected) {
            this.app.status.notify(`${opening.byName || 'Somebody'} could not open ${opening.name}. ${why}`);
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
        for (const [header, value] of Object.entries(this.app.client.httpHeaders)) {
            request.setRequestHeader(header, value);
        }
        request.upload.onprogress = ({loaded, total}) => {
            this.#progress.value = loaded / Math.max(total, 1);
        };
        request.upload.onload = () => this.#say(`Checking ${name}.`);
        request.onload = () => {
            const stored = request.status === 200 || request.status === 201;
            const said = request.responseText.trim();
            const rejected = request.status === 422;
            const {text, details} = rejected ? refusalOf(said) : {text: said, details: ''};
            this.#ended(stored ? `Added ${name} to the list.` : text, !stored, details);
        };
        request.onerror = () => this.#ended(`Could not send ${name}.`, true);
        this.#say(`Sending ${name}.`);
        this.#progress.value = 0;
        this.#progress.hidden = false;
        this.#add.disabled = true;
        request.send(file);
    }

    /**
     * @param {string} text
     * @param {boolean} failed
     * @param {string} details
     */
    #ended(text, failed, details = '') {
        this.#progress.hidden = true;
        this.#add.disabled = false;
        this.#say(text, failed, details);
        this.#refresh();
    }

    /**
     * @param {string} text
     * @param {boolean} failed
     * @param {string} details  behind a click; empty: none
     */
    #say(text, failed = false, details = '') {
        this.#state.textContent = text;
        this.#state.classList.toggle('problem', failed);
        byId('scene-file-details', HTMLElement).hidden = details === '';
        byId('scene-file-reason', HTMLElement).textContent = details;
    }
}
