// SPDX-License-Identifier: Apache-2.0
// Moving through the scene by other means than keys and dragging: mouse look, a stick for the thumb,
// a game controller, a double click, and standing up at eye height.

import {EYE_HEIGHT, atHeight, goTo, levelled} from './camera.js';
import {noMotion} from './camera_control.js';
import {byId, returnFocus, showValue, whileAsked} from '../ui/elements.js';
import {metres} from '../ui/format.js';
import {clamp} from '../ui/vector.js';

/**
 * @typedef {import('../app/app.js').RaybundleApp} RaybundleApp
 * @typedef {import('./camera_control.js').Mode} Mode
 * @typedef {import('./pointer_control.js').Point} Point
 */

/** Of mouse look, radians per CSS pixel. */
const LOOK_SPEED = 0.0025;
/** A controller's stick rests within this. */
const DEAD_ZONE = 0.15;
/** Way of the thumb that means full speed, CSS pixels. */
const STICK_REACH = 40;

/**
 * What a controller's axis asks for: nothing within its dead zone, then evenly more.
 *
 * @param {number | undefined} value  -1..1
 * @returns {number}
 */
export function outsideDeadZone(value = 0) {
    const size = (Math.abs(value) - DEAD_ZONE) / (1 - DEAD_ZONE);
    return size > 0 ? Math.sign(value) * Math.min(size, 1) : 0;
}

export class Walking {
    #eye = byId('eye', HTMLElement);
    #stick = byId('stick', HTMLElement);
    #touch = matchMedia('(pointer: coarse)').matches;
    #polling = 0;

    /**
     * @param {RaybundleApp} app
     * @param {import('./collisions.js').Collisions} collisions
     */
    constructor(app, collisions) {
        this.app = app;
        this.collisions = collisions;
        this.#addButtons();
        this.#addMouseLook();
        this.#addStick();
        addEventListener('gamepadconnected', () => this.#poll());
        app.on('view', () => this.#showEye());
        app.on('welcome', () => this.#showEye());
        app.on('surroundings', () => this.#showEye());
    }

    /** @param {Mode} mode */
    setMode(mode) {
        this.app.camera.mode = mode;
        for (const button of document.querySelectorAll('[data-mode]')) {
            const pressed = /** @type {HTMLElement} */ (button).dataset.mode === mode;
            button.setAttribute('aria-pressed', String(pressed));
        }
        this.#showEye();
    }

    /** Orbit becomes walk and the other way round. */
    switchMode() {
        this.setMode(this.app.camera.mode === 'orbit' ? 'walk' : 'orbit');
    }

    /** Stands on the floor. Who comes from far above or below looks straight ahead there, not at the ground; nobody stands in a plan. */
    stand() {
        const {view} = this.app;
        if (view.near) {
            return;
        }
        const height = this.collisions.floorUnder(view.eye) + EYE_HEIGHT;
        const there = atHeight(view, height);
        this.app.camera.flyTo(Math.abs(height - view.eye.y) > EYE_HEIGHT ? levelled(there) : there);
    }

    /** Looks with the mouse until Esc. */
    lookWithMouse() {
        this.setMode('walk');
        this.app.picture.element.focus({preventScroll: true});
        Promise.resolve(this.app.picture.element.requestPointerLock()).catch(() => {
            this.app.status.notify('The browser does not let the page hold the mouse now.');
        });
    }

    /**
     * Goes to what the picture shows.
     *
     * @param {Point} at
     */
    async goTo(at) {
        const probe = await whileAsked(this.app.picture.element, at, this.app.probeAt(at));
        if (probe?.position && probe.normal) {
            const walking = this.app.camera.mode === 'walk';
            const there = goTo(this.app.view, probe.position, probe.normal, walking);
            if (walking) {
                this.app.camera.flyTo(there);
            } else {
                this.app.camera.flyAround(there);
            }
        }
    }

    #addButtons() {
        for (const button of document.querySelectorAll('[data-mode]')) {
            const {mode} = /** @type {HTMLElement} */ (button).dataset;
            button.addEventListener('click', (event) => {
                this.setMode(mode === 'walk' ? 'walk' : 'orbit');
                returnFocus(/** @type {MouseEvent} */ (event));
            });
        }
        byId('stand', HTMLButtonElement).addEventListener('click', (event) => {
            this.stand();
            returnFocus(event);
        });
        const look = byId('mouse-look', HTMLButtonElement);
        look.hidden = this.#touch;
        look.addEventListener('click', () => this.lookWithMouse());
    }

    #addMouseLook() {
        const {element} = this.app.picture;
        document.addEventListener('pointerlockchange', () => {
            const locked = document.pointerLockElement === element;
            element.classList.toggle('locked', locked);
            byId('mouse-look', HTMLElement).setAttribute('aria-pressed', String(locked));
        });
        document.addEventListener('mousemove', (event) => {
            if (document.pointerLockElement === element) {
                this.app.camera.look(
                    -event.movementX * LOOK_SPEED,
                    -event.movementY * LOOK_SPEED,
                );
            }
        });
    }

    #addStick() {
        const knob = /** @type {HTMLElement} */ (this.#stick.firstElementChild);
        const show = (/** @type {number} */ x, /** @type {number} */ y) => {
            knob.style.transform = `translate(${x * STICK_REACH}px, ${y * STICK_REACH}px)`;
            this.app.camera.stick('touch', {...noMotion(), forwards: -y, rightwards: x});
        };
        const follow = (/** @type {PointerEvent} */ event) => {
            event.stopPropagation();
            const box = this.#stick.getBoundingClientRect();
            const x = (event.clientX - box.left - box.width / 2) / STICK_REACH;
            const y = (event.clientY - box.top - box.height / 2) / STICK_REACH;
            const far = Math.max(Math.hypot(x, y), 1);
            show(x / far, y / far);
        };
        this.#stick.addEventListener('pointerdown', (event) => {
            this.#stick.setPointerCapture(event.pointerId);
            follow(event);
        });
        this.#stick.addEventListener('pointermove', (event) => {
            if (this.#stick.hasPointerCapture(event.pointerId)) {
                follow(event);
            }
        });
        for (const type of /** @type {const} */ (['pointerup', 'pointercancel'])) {
            this.#stick.addEventListener(type, (event) => {
                event.stopPropagation();
                show(0, 0);
            });
        }
    }

    /** Reads the game controllers while there are any. */
    #poll() {
        cancelAnimationFrame(this.#polling);
        const pads = navigator.getGamepads().filter((pad) => pad !== null);
        const pad = pads.find(({mapping}) => mapping === 'standard') ?? pads[0];
        if (!pad) {
            this.app.camera.stick('pad', noMotion());
            return;
        }
        const [x, y, turn, tilt] = [0, 1, 2, 3].map((i) => outsideDeadZone(pad.axes[i]));
        const pressed = (/** @type {number} */ i) => pad.buttons[i]?.value ?? 0;
        this.app.camera.stick('pad', {
            forwards: -y,
            rightwards: x,
            upwards: clamp(pressed(7) - pressed(6), -1, 1),
            left: -turn,
            tilt: -tilt,
        });
        this.#polling = requestAnimationFrame(() => this.#poll());
    }

    /** In a plan nobody stands. */
    #showEye() {
        const {eye, near} = this.app.view;
        const walks = this.app.camera.mode === 'walk' && !near;
        this.#eye.hidden = !walks;
        this.#stick.hidden = !walks || !this.#touch;
        showValue('eyeHeight', metres(eye.y - this.collisions.floorUnder(eye)));
    }
}

/**
 * How to begin.
 *
 * @param {boolean} touch
 * @param {boolean} circles  a drag circles around the scene; otherwise it turns the head
 * @param {boolean} movable  there is something that this user can move
 */
export function hintText(touch, circles, movable) {
    const parts = [
        circles ? 'Drag to circle around' : 'Drag to look around',
        touch ? 'double-tap to go there' : 'W A S D to walk',
        ...(movable ? [`${touch ? 'tap' : 'click'} an object to move it`] : []),
    ];
    return parts.join(' · ');
}

/** Tells a newcomer how to move, until he has. */
export class FirstHint {
    #pill = byId('hint', HTMLElement);

    /** @param {RaybundleApp} app */
    constructor(app) {
        const touch = matchMedia('(pointer: coarse)').matches;
        if (remembered('moved')) {
            return;
        }
        let first = true;
        app.on('picture', () => {
            if (first) {
                first = false;
                const movable = app.mayEdit && app.scene?.objects.some((object) => object.movable);
                this.#pill.textContent = hintText(touch, app.camera.circles, Boolean(movable));
                this.#pill.hidden = false;
                document.addEventListener('pointerup', () => this.#done());
                document.addEventListener('keyup', () => this.#done());
            }
        });
    }

    #done() {
        this.#pill.hidden = true;
        remember('moved', 'yes');
    }
}

/**
 * What this browser remembers of the user; nothing where it may not.
 *
 * @param {string} key
 * @returns {string | null}
 */
export function remembered(key) {
    try {
        return localStorage.getItem(`raybundle.${key}`);
    } catch {
        return null;
    }
}

/**
 * @param {string} key
 * @param {string} value
 */
export function remember(key, value) {
    try {
        localStorage.setItem(`raybundle.${key}`, value);
    } catch {
        // A browser that keeps nothing still shows everything.
    }
}
