// SPDX-License-Identifier: Apache-2.0
// Pins: notes at points of the scene that keep the light measured there, and say when it has changed.

import {byId, replaceRows, smallButton} from '../ui/elements.js';
import {measured} from '../ui/units.js';
import {add, matrixPoint, transformPoint} from '../ui/vector.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('../picture/marks.js').Marks} Marks
 * @typedef {import('./people.js').People} People
 * @typedef {import('../measure/measure.js').Measuring} Measuring
 * @typedef {import('../camera/pointer_control.js').Point} Point
 * @typedef {import('../net/protocol.js').Pin} Pin
 * @typedef {import('../net/scene_types.js').Vec3} Vec3
 */

/** The light at a pin counts as changed from here on. */
export const CHANGED = 0.1;
const MAX_TEXT = 500;
/** Looked at from so far, metres. */
const LOOK_FROM = 2.5;

/**
 * How much the light at a pin has changed.
 *
 * @param {{change?: number}} pin
 * @returns {string} e.g. "−24 %"; empty: about as it was, or not known
 */
const percentOf = ({change}) =>
    change === undefined || Math.abs(change) <= CHANGED ? '' : `${change > 0 ? '+' : '−'}${Math.abs(100 * change).toFixed(0)} %`;

/**
 * What has become of the light at a pin.
 *
 * @param {{change?: number}} pin
 * @returns {string} e.g. "−24 % since then"; empty: about the same, or not known
 */
export function changeOf(pin) {
    const percent = percentOf(pin);
    return percent && `${percent} since then`;
}

export class Pins {
    /** @type {Map<number, Pin>} */
    pins = new Map();
    /** @type {Map<number, HTMLElement>} */
    #marks = new Map();
    /** @type {HTMLElement | null} */
    #editor = null;

    /**
     * @param {RaybundleApp} app
     * @param {Marks} marks
     * @param {People} people
     * @param {Measuring} measuring
     */
    constructor(app, marks, people, measuring) {
        this.app = app;
        this.marks = marks;
        this.people = people;
        this.measuring = measuring;
        app.on('welcome', (welcome) => {
            this.pins = new Map((welcome.pins ?? []).map((/** @type {Pin} */ pin) => [pin.pin, pin]));
            this.#show();
        });
        measuring.addEventListener('unit', () => this.#show());
        app.on('message', ({pinChanged}) => {
            if (pinChanged) {
                this.#changed(pinChanged);
            }
        });
    }

    /**
     * Where a pin is now: it moves with the object that it is stuck to.
     *
     * @param {Pin} pin
     * @returns {Vec3}
     */
    positionOf(pin) {
        const object = this.app.scene?.object(pin.object);
        if (!object || !pin.localPosition) {
            return pin.position;
        }
        return matrixPoint(object.worldFromParent, transformPoint(object.transform, pin.localPosition));
    }

    /**
     * Asks for the text of a new pin.
     *
     * @param {Point} at
     */
    async askAt(at) {
        if (!this.app.mayReview) {
            this.app.status.notify('View only. Ask for reviewer access to add pins.');
            return;
        }
        // At once, since what is typed while the server measures is the note, not keys of the camera.
        const ray = this.app.rayAt(at);
        const editor = this.#openEditor(add(ray.origin, ray.direction));
        const probe = await this.app.probeAt(at);
        if (this.#editor !== editor.form) {
            return;
        }
        if (probe?.position) {
            editor.found(probe);
        } else {
            this.cancel();
            this.app.status.notify('There is no surface at this point of the picture.');
        }
    }

    /** Closes the editor without a pin. Returns whether it was open. */
    cancel() {
        const open = this.#editor !== null;
        const focused = this.#editor?.contains(document.activeElement);
        this.marks.remove(this.#editor);
        this.#editor = null;
        if (focused) {
            this.app.picture.element.focus({preventScroll: true});
        }
        return open;
    }

    /** @param {number} number */
    lookAt(number) {
        const pin = this.pins.get(number);
        if (!pin) {
            return;
        }
        const target = this.positionOf(pin);
        const {view} = this.app;
        const offset = {
            x: view.eye.x - target.x,
            y: view.eye.y - target.y,
            z: view.eye.z - target.z,
        };
        const away = Math.hypot(offset.x, offset.y, offset.z) || 1;
        const nearer = Math.min(LOOK_FROM / away, 1);
        const eye = {
            x: target.x + offset.x * nearer,
            y: target.y + offset.y * nearer,
            z: target.z + offset.z * nearer,
        };
        this.app.camera.flyAround({...view, eye, target});
    }

    /**
     * @param {Vec3} at  where the picture shows it, until found() is told what is there
     */
    #openEditor(at) {
        this.cancel();
        /** @type {import('../net/measure_types.js').ProbeResult | null} */
        let probe = null;
        let asked = false;
        const form = document.createElement('form');
        form.className = 'pin-editor';
        const value = document.createElement('p');
        value.textContent = 'Measuring …';
        const text = document.createElement('textarea');
        text.rows = 2;
        text.maxLength = MAX_TEXT;
        text.required = true;
        text.setAttribute('aria-label', 'Text of the pin');
        text.placeholder = 'What about this place?';
        const save = document.createElement('button');
        save.type = 'submit';
        save.textContent = 'Pin it';
        const point = smallButton('Look here', 'Show this place to the others', () => {
            const {position} = probe ?? {};
            this.cancel();
            if (position) {
                this.people.pointAt(position);
            }
        });
        point.disabled = true;
        const close = smallButton('Cancel', 'Cancel', () => this.cancel());
        const row = document.createElement('div');
        row.className = 'row';
        row.append(save, point, close);
        form.append(value, text, row);
        const submit = async () => {
            const {position, patch = 0} = probe ?? {};
            asked = probe === null;
            const addPin = {text: text.value.trim(), position, patch};
            if (addPin.text && position && (await this.app.ask({addPin})) && this.#editor === form) {
                this.cancel();
            }
        };
        form.addEventListener('submit', (event) => {
            event.preventDefault();
            submit();
        });
        for (const type of ['pointerdown', 'pointermove', 'pointerup', 'wheel', 'dblclick', 'keydown']) {
            form.addEventListener(type, (event) => {
                event.stopPropagation();
                if (event instanceof KeyboardEvent && event.key === 'Escape') {
                    this.cancel();
                }
                const submits = event instanceof KeyboardEvent && event.key === 'Enter';
                if (submits && !(/** @type {KeyboardEvent} */ (event).shiftKey) && event.target === text) {
                    event.preventDefault();
                    form.requestSubmit();
                }
            });
        }
        this.#editor = this.marks.add(form, () => probe?.position ?? at, true);
        text.focus({preventScroll: true});
        const found = (/** @type {import('../net/measure_types.js').ProbeResult} */ result) => {
            probe = result;
            point.disabled = false;
            value.textContent = measured(result.illuminance ?? 0, this.measuring.unit, result.relativeError);
            this.app.drawOverlay();
            if (asked) {
                submit();  // Enter came before the server's answer
            }
        };
        return {form, found};
    }

    /** @param {Pin} pin */
    #changed(pin) {
        const before = this.pins.get(pin.pin);
        if (pin.removed) {
            this.pins.delete(pin.pin);
        } else {
            this.pins.set(pin.pin, pin);
        }
        const fresh = percentOf(pin);
        if (before && fresh && !percentOf(before)) {
            this.app.status.notify(`The light at pin ${pin.pin} has changed by ${fresh} since it was set.`);
        } else if (!before && !pin.removed && pin.by !== this.people.own) {
            this.app.status.notify(`${pin.byName || this.people.name(pin.by)} added a pin.`);
        }
        this.#show();
    }

    #show() {
        for (const element of this.#marks.values()) {
            this.marks.remove(element);
        }
        this.#marks.clear();
        const rows = [...this.pins.values()].map((pin) => {
            this.#marks.set(pin.pin, this.#mark(pin));
            return this.#row(pin);
        });
        replaceRows(byId('pins', HTMLElement), rows);
        byId('pins-none', HTMLElement).hidden = rows.length > 0;
    }

    /** @param {Pin} pin */
    #mark(pin) {
        const mark = document.createElement('button');
        mark.type = 'button';
        mark.className = `pin${changeOf(pin) ? ' changed' : ''}`;
        mark.textContent = String(pin.pin);
        const change = changeOf(pin);
        const text = `Pin ${pin.pin}: ${pin.text}${change ? ` (light ${change})` : ''}`;
        mark.title = text;
        mark.setAttribute('aria-label', text);
        mark.addEventListener('pointerdown', (event) => event.stopPropagation());
        mark.addEventListener('click', () => {
            byId('tab-review', HTMLElement).click();
            document.getElementById(`pin-${pin.pin}`)?.scrollIntoView({block: 'nearest'});
        });
        return this.marks.add(mark, () => this.positionOf(this.pins.get(pin.pin) ?? pin));
    }

    /** @param {Pin} pin */
    #row(pin) {
        const item = document.createElement('li');
        item.id = `pin-${pin.pin}`;
        const number = smallButton(String(pin.pin), `Look at pin ${pin.pin}`, () =>
            this.lookAt(pin.pin),
        );
        number.className = 'pin-number';
        const text = document.createElement('p');
        text.className = 'pin-text';
        text.textContent = pin.text;
        const detail = document.createElement('p');
        detail.className = 'quiet';
        const when = new Date(pin.setAtMs).toLocaleString([], {dateStyle: 'short', timeStyle: 'short'});
        const who = pin.byName || `Viewer ${pin.by}`;
        const value = measured(pin.illuminance, this.measuring.unit, pin.relativeError);
        detail.textContent = `${value} · after change ${pin.epoch} · ${who}, ${when}`;
        const body = document.createElement('div');
        body.append(text, detail);
        const change = changeOf(pin);
        if (change) {
            const flag = document.createElement('p');
            flag.className = 'flag';
            flag.textContent = `Light ${change}`;
            body.append(flag);
        }
        for (const reply of pin.replies ?? []) {
            body.append(this.#reply(reply));
        }
        item.classList.toggle('resolved', Boolean(pin.resolved));
        item.append(number, body);
        if (this.app.mayReview) {
            body.append(this.#actions(pin));
            item.append(
                smallButton('×', `Remove pin ${pin.pin}`, () =>
                    this.app.ask({removePin: {pin: pin.pin}}),
                ),
            );
        } else if (pin.resolved) {
            detail.append(' · resolved');
        }
        return item;
    }

    /** @param {{byName: string, text: string}} reply */
    #reply({byName, text}) {
        const line = document.createElement('p');
        line.className = 'pin-reply';
        const who = document.createElement('b');
        who.textContent = byName || 'Somebody';
        line.append(who, `: ${text}`);
        return line;
    }

    /**
     * What a reviewer does with a pin.
     *
     * @param {Pin} pin
     */
    #actions(pin) {
        const row = document.createElement('div');
        row.className = 'pin-actions';
        const form = document.createElement('form');
        form.className = 'inline-form';
        form.hidden = true;
        const text = document.createElement('input');
        text.maxLength = MAX_TEXT;
        text.required = true;
        text.setAttribute('aria-label', `Reply to pin ${pin.pin}`);
        text.placeholder = 'Reply';
        const send = document.createElement('button');
        send.type = 'submit';
        send.textContent = 'Send';
        form.append(text, send);
        form.addEventListener('submit', (event) => {
            event.preventDefault();
            this.app.ask({replyToPin: {pin: pin.pin, text: text.value.trim()}});
        });
        const reply = smallButton('Reply', `Reply to pin ${pin.pin}`, () => {
            form.hidden = !form.hidden;
            text.focus();
        });
        const state = smallButton(pin.resolved ? 'Reopen' : 'Resolve', `${pin.resolved ? 'Reopen' : 'Resolve'} pin ${pin.pin}`, () =>
            this.app.ask({setPin: {pin: pin.pin, resolved: !pin.resolved}}),
        );
        row.append(state, reply, form);
        return row;
    }
}
