// SPDX-License-Identifier: Apache-2.0
// Mouse, pen and touch on the picture: what each gesture means.
//
// One pointer on the selected object drags it; elsewhere it turns the view. Two fingers, the right
// or the middle button, or Shift pan; pinch and wheel come nearer. A short press that does not move
// is a click.

/**
 * @typedef {{x: number, y: number}} Point  CSS pixels from the picture's top left corner
 * @typedef {object} Gestures
 * @property {(at: Point) => boolean} grab  takes hold of what is there, if it can be dragged
 * @property {(at: Point) => void} drag
 * @property {(keep: boolean) => void} release
 * @property {(at: Point) => void} click
 * @property {(at: Point | null) => void} hover
 * @property {(x: number, y: number) => void} turn  in heights of the picture
 * @property {(x: number, y: number) => void} pan  in heights of the picture
 * @property {(factor: number) => void} zoom
 */

/** A press that moves less is a click, CSS pixels. */
const CLICK_SLOP = 5;

export class PointerControl {
    /** @type {Map<number, Point>} */
    #pointers = new Map();
    /** @type {'none' | 'press' | 'turn' | 'pan' | 'drag' | 'pinch'} */
    #gesture = 'none';
    /**
     * What `press` becomes once it moves.
     *
     * @type {'turn' | 'pan' | 'drag'}
     */
    #intent = 'turn';
    /** @type {Point} */
    #start = {x: 0, y: 0};

    /**
     * @param {HTMLElement} element
     * @param {Gestures} gestures
     */
    constructor(element, gestures) {
        this.element = element;
        this.gestures = gestures;
        element.addEventListener('pointerdown', (event) => this.#down(event));
        element.addEventListener('pointermove', (event) => this.#move(event));
        element.addEventListener('pointerup', (event) => this.#up(event));
        element.addEventListener('pointercancel', (event) => this.#cancelled(event));
        element.addEventListener('pointerleave', () => gestures.hover(null));
        element.addEventListener('wheel', (event) => this.#wheel(event), {passive: false});
        element.addEventListener('contextmenu', (event) => event.preventDefault());
    }

    /** Ends a drag, the object going back. Returns whether there was one. */
    cancel() {
        const held = this.#intent === 'drag' && ['press', 'drag'].includes(this.#gesture);
        this.#gesture = 'none';
        if (held) {
            this.gestures.release(false);
        }
        return held;
    }

    /** @param {MouseEvent} event */
    #at(event) {
        const box = this.element.getBoundingClientRect();
        return {x: event.clientX - box.left, y: event.clientY - box.top};
    }

    /** @param {PointerEvent} event */
    #down(event) {
        this.element.focus({preventScroll: true});
        const at = this.#at(event);
        this.#pointers.set(event.pointerId, at);
        this.element.setPointerCapture(event.pointerId);
        if (this.#pointers.size > 1) {
            this.#finish();
            this.#gesture = this.#pointers.size === 2 ? 'pinch' : 'none';
            return;
        }
        this.#gesture = 'press';
        this.#start = at;
        const wantsPan = event.button !== 0 || event.shiftKey;
        this.#intent = wantsPan ? 'pan' : 'turn';
        if (!wantsPan && this.gestures.grab(at)) {
            this.#intent = 'drag';
        }
    }

    /** @param {PointerEvent} event */
    #move(event) {
        const at = this.#at(event);
        const before = this.#pointers.get(event.pointerId);
        if (!before) {
            this.gestures.hover(at);
            return;
        }
        if (this.#gesture === 'pinch') {
            this.#pinch(event.pointerId, before, at);
        } else {
            this.#moveOne(before, at);
        }
        this.#pointers.set(event.pointerId, at);
    }

    /**
     * @param {Point} before
     * @param {Point} at
     */
    #moveOne(before, at) {
        let from = before;
        if (this.#gesture === 'press') {
            if (Math.hypot(at.x - this.#start.x, at.y - this.#start.y) < CLICK_SLOP) {
                return;
            }
            this.#gesture = this.#intent;
            from = this.#start;
        }
        const height = this.element.clientHeight;
        const x = (at.x - from.x) / height;
        const y = (at.y - from.y) / height;
        if (this.#gesture === 'drag') {
            this.gestures.drag(at);
        } else if (this.#gesture === 'turn') {
            this.gestures.turn(x, y);
        } else if (this.#gesture === 'pan') {
            this.gestures.pan(x, y);
        }
    }

    /**
     * @param {number} moved  id of the finger that moved
     * @param {Point} before
     * @param {Point} at
     */
    #pinch(moved, before, at) {
        const other = [...this.#pointers].find(([id]) => id !== moved)?.[1];
        if (!other) {
            return;
        }
        const height = this.element.clientHeight;
        const apart = Math.max(Math.hypot(before.x - other.x, before.y - other.y), 1);
        const nowApart = Math.max(Math.hypot(at.x - other.x, at.y - other.y), 1);
        this.gestures.zoom(apart / nowApart);
        // The middle of two fingers moves half as far as one of them.
        this.gestures.pan((at.x - before.x) / 2 / height, (at.y - before.y) / 2 / height);
    }

    /** @param {PointerEvent} event */
    #up(event) {
        if (!this.#pointers.delete(event.pointerId)) {
            return;
        }
        const clicked = this.#gesture === 'press' && event.button === 0;
        this.#finish();
        this.#gesture = 'none';
        if (clicked) {
            this.gestures.click(this.#at(event));
        }
    }

    /** @param {PointerEvent} event */
    #cancelled(event) {
        this.#pointers.delete(event.pointerId);
        this.cancel();
    }

    /** Ends a gesture of one pointer. */
    #finish() {
        if (this.#gesture === 'drag') {
            this.gestures.release(true);
        } else if (this.#gesture === 'press' && this.#intent === 'drag') {
            this.gestures.release(false);
        }
    }

    /** @param {WheelEvent} event */
    #wheel(event) {
        event.preventDefault();
        const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 : 1;
        const way = Math.max(-200, Math.min(200, event.deltaY * lines));
        this.gestures.zoom(Math.exp(way / 500));
    }
}
