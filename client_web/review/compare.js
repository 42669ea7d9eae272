// SPDX-License-Identifier: Apache-2.0
// Before and after: a picture that is kept, or one that the server renders of the light before a change,
// wiped against the light now from the same camera.

import {sameView} from '../camera/camera.js';
import {byId, showValue} from '../ui/elements.js';
import {snapshotSize} from './snapshot_panel.js';
import {requestSnapshot} from './snapshot_request.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('../measure/display_panel.js').DisplayPanel} DisplayPanel
 * @typedef {import('./change_list.js').ChangeList} ChangeList
 * @typedef {import('./change_list.js').LogEntry} LogEntry
 * @typedef {import('../net/scene_types.js').View} View
 * @typedef {{view: View, epoch: number, exposure: number, name: string}} KeptPicture
 */

/** Changes that can be chosen, the newest ones. */
const MOST_CHOICES = 30;
/** A side of the wiped picture that is narrower than this has no room for its name, CSS pixels. */
const NARROWEST_SIDE = 72;
/** Errors to ask an earlier picture for: that of the one on screen, within these. */
const ERRORS = {least: 0.03, most: 0.15};

/**
 * What can be compared with: the scene before each change, and as it was loaded.
 *
 * @param {LogEntry[]} entries  oldest first
 * @param {number} epoch  now
 * @returns {{epoch: number, name: string}[]}
 */
export function choicesOf(entries, epoch) {
    const newest = entries
        .slice(-MOST_CHOICES)
        .reverse()
        .map(({before, by, mine, text}) => ({epoch: before, name: `before ${mine ? 'you' : by} ${text}`}));
    const loaded = newest.some((choice) => choice.epoch === 0);
    return epoch > 0 && !loaded ? [...newest, {epoch: 0, name: 'as it was loaded'}] : newest;
}

export class Compare {
    /** @type {KeptPicture | null} */
    kept = null;
    #canvas = byId('compare-canvas', HTMLCanvasElement);
    #wipe = byId('wipe', HTMLElement);
    #at = byId('wipe-at', HTMLInputElement);
    #button = byId('compare', HTMLButtonElement);
    #choice = byId('earlier-epoch', HTMLSelectElement);
    #earlier = byId('earlier', HTMLButtonElement);
    /** Whether the server is computing an earlier light. */
    #asking = false;
    /** Whether exposure was automatic before the comparison. */
    #automatic = false;

    /**
     * @param {RaybundleApp} app
     * @param {DisplayPanel} display
     * @param {ChangeList} changes
     */
    constructor(app, display, changes) {
        this.app = app;
        this.display = display;
        this.changes = changes;
        byId('keep-picture', HTMLElement).addEventListener('click', () => this.keep());
        this.#button.addEventListener('click', () => this.show(this.#wipe.hidden));
        this.#earlier.addEventListener('click', () => this.showEarlier(Number(this.#choice.value)));
        this.#at.addEventListener('input', () => this.#cut());
        this.#dragLine(byId('wipe-line', HTMLElement));
        app.on('view', (/** @type {View} */ view) => {
            if (!this.#wipe.hidden && this.kept && !sameView(view, this.kept.view)) {
                this.#end('The camera has moved: the comparison is over.');
            }
        });
        app.picture.addEventListener('resize', () => this.#end('The picture has another size: the comparison is over.'));
        changes.addEventListener('change', () => this.#list());
        app.on('welcome', () => this.#list());
        app.on('anew', ({otherScene}) => otherScene && this.#forget());
    }

    /** Keeps the picture that is on screen. */
    keep() {
        const {canvas} = this.app.picture;
        const {frame, link} = this.app;
        if (!frame || !link.shown) {
            return;
        }
        const time = new Date().toLocaleTimeString([], {timeStyle: 'short'});
        const {epoch, exposure} = frame;
        this.#take(canvas, {view: link.shown, epoch, exposure, name: `kept at ${time}`});
        showValue('compareState', `Kept at ${time}. Change something, then compare.`);
    }

    /**
     * Asks the server for the picture of an earlier epoch from this camera, and compares with it.
     *
     * @param {number} epoch
     */
    async showEarlier(epoch) {
        const {app} = this;
        const {view} = app;
        const name = this.#choice.selectedOptions[0]?.textContent ?? `after change ${epoch}`;
        this.#fixExposure();
        this.#asking = true;
        this.#list();
        const tell = (/** @type {string} */ how) =>
            showValue('compareState', `Computing the light ${name}: ${how}. You can go on meanwhile.`);
        tell('it has just begun');
        await this.display.carriedOut();
        const {limits, viewport} = app.picture;
        const error = app.stats.errorHigh ?? ERRORS.most;
        const snapshot = {
            ...snapshotSize(0, viewport, limits),
            relativeError: Math.min(Math.max(error, ERRORS.least), ERRORS.most),
            format: 'PNG',
            epoch,
        };
        const ready = await requestSnapshot(app, snapshot, byId('earlier-cancel', HTMLButtonElement), tell);
        const image = ready ? await imageAt(ready.url) : null;
        this.#asking = false;
        this.#list();
        if (!ready || !image) {
            this.#releaseExposure();
            showValue('compareState', ready ? 'The picture of the earlier light did not arrive. Compare again.' : 'Comparison cancelled.');
            return;
        }
        this.#take(image, {view, epoch: ready.epoch, exposure: ready.exposure, name});
        if (sameView(view, app.view)) {
            showValue('compareState', `Left: ${name}. Right: now.`);
            this.show(true);
        } else {
            this.#releaseExposure();
            showValue('compareState', `The picture ${name} is there: Compare shows it.`);
        }
    }

    /** There is another scene: what was kept is not of it. */
    #forget() {
        this.close();
        this.kept = null;
        this.#button.disabled = true;
        showValue('compareState', 'Compare by wiping: with the light before a change, or with a picture that you keep.');
    }

    /** Ends the comparison. Returns whether there was one. */
    close() {
        const open = !this.#wipe.hidden;
        if (open) {
            const focused = document.activeElement === this.#at;
            this.show(false);
            if (focused) {
                this.app.picture.element.focus({preventScroll: true});
            }
        }
        return open;
    }

    /** @param {boolean} on  from the camera of the kept picture */
    show(on) {
        const kept = this.kept;
        const shown = on && kept !== null;
        if (shown && kept) {
            this.app.view = kept.view;
            this.#fixExposure(kept.exposure);
            byId('wipe-before', HTMLElement).textContent = kept.name;
        } else if (!this.#wipe.hidden) {
            this.#releaseExposure();
        }
        this.#wipe.hidden = !shown;
        this.#canvas.hidden = !shown;
        this.#button.setAttribute('aria-pressed', String(shown));
        this.#cut();
    }

    /**
     * Ends the comparison, and says why.
     *
     * @param {string} why
     */
    #end(why) {
        if (!this.#wipe.hidden) {
            this.show(false);
            this.app.status.notify(why, 'notice', {label: 'Compare again', run: () => this.show(true)});
        }
    }

    /**
     * The line can be taken hold of everywhere.
     *
     * @param {HTMLElement} line
     */
    #dragLine(line) {
        /** From the pointer to the line. @type {number | null} */
        let off = null;
        const place = (/** @type {PointerEvent} */ {clientX}) => {
            const {left, width} = this.#wipe.getBoundingClientRect();
            return (clientX - left) / Math.max(width, 1);
        };
        line.addEventListener('pointerdown', (event) => {
            if (event.button === 0) {
                event.preventDefault();
                line.setPointerCapture(event.pointerId);
                off = Number(this.#at.value) - place(event);
            }
        });
        line.addEventListener('pointermove', (event) => {
            if (off !== null) {
                this.#at.value = String(place(event) + off);
                this.#cut();
            }
        });
        for (const type of /** @type {const} */ (['pointerup', 'pointercancel'])) {
            line.addEventListener(type, () => {
                off = null;
            });
        }
    }

    /**
     * @param {HTMLCanvasElement | ImageBitmap} image
     * @param {KeptPicture} kept
     */
    #take(image, kept) {
        this.#canvas.width = image.width;
        this.#canvas.height = image.height;
        this.#canvas.getContext('2d')?.drawImage(image, 0, 0);
        this.kept = kept;
        this.#button.disabled = false;
    }

    /**
     * The same exposure on both sides, or the comparison would be of exposures.
     *
     * @param {number | undefined} exposure  stops; absent: as on screen
     */
    #fixExposure(exposure = this.app.frame?.exposure) {
        if (this.display.autoExposure) {
            this.#automatic = true;
            this.display.autoExposure = false;
            this.display.setExposure(Math.round((exposure ?? 0) * 4) / 4);
        }
    }

    #releaseExposure() {
        if (this.#automatic) {
            this.#automatic = false;
            this.display.autoExposure = true;
            this.display.setExposure(0);
        }
    }

    /** Offers what can be compared with. */
    #list() {
        const chosen = this.#choice.value;
        const choices = choicesOf(this.changes.entries, this.app.scene?.epoch ?? 0);
        const options = choices.map(({epoch, name}) => new Option(name, String(epoch)));
        this.#choice.replaceChildren(...options);
        this.#choice.disabled = choices.length === 0;
        this.#earlier.disabled = this.#asking || choices.length === 0;
        if (choices.length === 0) {
            this.#choice.replaceChildren(new Option('nothing has changed yet', ''));
        } else if (choices.some(({epoch}) => String(epoch) === chosen)) {
            this.#choice.value = chosen;
        }
    }

    #cut() {
        const share = Number(this.#at.value);
        this.#canvas.style.clipPath = `inset(0 ${(100 * (1 - share)).toFixed(1)}% 0 0)`;
        this.#wipe.style.setProperty('--at', `${(100 * share).toFixed(1)}%`);
        this.#at.setAttribute('aria-valuetext', `${Math.round(100 * share)} % earlier`);
        const width = this.#wipe.clientWidth;
        byId('wipe-before', HTMLElement).hidden = share * width < NARROWEST_SIDE;
        byId('wipe-now', HTMLElement).hidden = (1 - share) * width < NARROWEST_SIDE;
    }
}

/**
 * @param {string} url  path on the server
 * @returns {Promise<ImageBitmap | null>}
 */
async function imageAt(url) {
    try {
        const answer = await fetch(new URL(url.replace(/^\//, ''), location.href));
        return answer.ok ? await createImageBitmap(await answer.blob()) : null;
    } catch {
        return null;
    }
}
