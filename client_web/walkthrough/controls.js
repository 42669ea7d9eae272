// SPDX-License-Identifier: Apache-2.0
// Keys, pointer and bars of a walkthrough; the same keys as those of the live page.

import {EYE_HEIGHT, atHeight, framedFov, goTo, rayThrough} from '../camera/camera.js';
import {PointerControl} from '../camera/pointer_control.js';
import {turbo} from '../measure/colour.js';
import {byId} from '../ui/elements.js';
import {normalise, vec3} from '../ui/vector.js';
import {pointAlong} from './off_screen.js';
import {viewOf} from './projection.js';

/**
 * @typedef {import('../camera/camera_control.js').CameraControl} CameraControl
 * @typedef {import('./picture.js').Picture} Picture
 * @typedef {import('./scene_data.js').SceneManifest} SceneManifest
 */

const LOOK_SPEED = 0.0025;
const COLOURS = 16;

export class Controls {
    #element = byId('picture', HTMLElement);
    #cameras = byId('cameras', HTMLSelectElement);
    #display = byId('display', HTMLSelectElement);
    #exposure = byId('exposure', HTMLInputElement);

    /**
     * @param {SceneManifest} manifest
     * @param {CameraControl} camera
     * @param {Picture} picture
     */
    constructor(manifest, camera, picture) {
        this.manifest = manifest;
        this.camera = camera;
        this.picture = picture;
        this.#addPointer();
        this.#addKeys();
        this.#addCameras();
        this.#addDisplay();
        for (const button of document.querySelectorAll('[data-mode]')) {
            const {mode} = /** @type {HTMLElement} */ (button).dataset;
            button.addEventListener('click', () => this.setMode(mode === 'walk' ? 'walk' : 'orbit'));
        }
    }

    /** @param {number} index */
    cameraView(index) {
        const view = viewOf(this.manifest.cameras[index]);
        return {...view, verticalFov: framedFov(view.verticalFov, this.picture.aspect)};
    }

    /** @param {'orbit' | 'walk'} mode */
    setMode(mode) {
        this.camera.mode = mode;
        for (const button of document.querySelectorAll('[data-mode]')) {
            const pressed = /** @type {HTMLElement} */ (button).dataset.mode === mode;
            button.setAttribute('aria-pressed', String(pressed));
        }
        this.#element.focus({preventScroll: true});
    }

    #addPointer() {
        new PointerControl(this.#element, {
            grab: () => false,
            drag: () => {},
            release: () => {},
            click: () => {},
            hover: () => {},
            turn: (x, y) => this.camera.turn(x, y),
            pan: (x, y) => this.camera.pan(x, y),
            zoom: (factor) => this.camera.zoom(factor),
        });
        this.#element.addEventListener('dblclick', (event) => {
            const box = this.#element.getBoundingClientRect();
            this.goTo((event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height);
        });
        document.addEventListener('mousemove', (event) => {
            if (document.pointerLockElement === this.#element) {
                this.camera.look(-event.movementX * LOOK_SPEED, -event.movementY * LOOK_SPEED);
            }
        });
    }

    /** @type {Record<string, () => void>} */
    #commands = {
        Home: () => this.#goTo(0),
        KeyM: () => this.setMode(this.camera.mode === 'orbit' ? 'walk' : 'orbit'),
        KeyV: () => this.#nextDisplay(),
        KeyL: () => this.#lookWithMouse(),
        KeyH: () => this.stand(),
    };

    /**
     * Goes to what the picture shows, as a double click on the live page does.
     *
     * @param {number} x  0..1 from the left
     * @param {number} y  0..1 from the top
     */
    goTo(x, y) {
        const {view, mode} = this.camera;
        const found = pointAlong(this.picture.renderer, rayThrough(view, this.picture.aspect, x, y));
        if (found) {
            const there = goTo(view, found.position, normalise(found.normal), mode === 'walk');
            if (mode === 'walk') {
                this.camera.flyTo(there);
            } else {
                this.camera.flyAround(there);
            }
        }
    }

    /** Stands on what is below. */
    stand() {
        const {view} = this.camera;
        const below = pointAlong(this.picture.renderer, {origin: view.eye, direction: vec3(0, -1, 0)});
        if (below) {
            this.camera.flyTo(atHeight(view, below.position.y + EYE_HEIGHT));
        }
    }

    #addKeys() {
        document.addEventListener('keydown', (event) => {
            const here = event.target === document.body || event.target === this.#element;
            if (here && !event.ctrlKey && !event.metaKey && !event.altKey && this.#press(event)) {
                event.preventDefault();
            }
        });
        document.addEventListener('keyup', (event) => this.camera.keyUp(event.code));
        addEventListener('blur', () => this.camera.releaseKeys());
        document.addEventListener('focusout', () => this.camera.releaseKeys());
    }

    /** @param {KeyboardEvent} event */
    #press(event) {
        if (event.key === '+' || event.key === '-') {
            this.camera.zoom(event.key === '+' ? 0.9 : 1 / 0.9);
            return true;
        }
        const command = this.#commands[event.code];
        if (command && !event.repeat) {
            command();
            return true;
        }
        return this.camera.keyDown(event.code, event.shiftKey);
    }

    #lookWithMouse() {
        this.setMode('walk');
        Promise.resolve(this.#element.requestPointerLock()).catch(() => {});
    }

    /** @param {number} index */
    #goTo(index) {
        this.#cameras.value = String(index);
        this.camera.flyTo(this.cameraView(index));
    }

    #addCameras() {
        this.manifest.cameras.forEach(({name}, i) => {
            this.#cameras.add(new Option(name || `Camera ${i + 1}`, String(i)));
        });
        this.#cameras.disabled = false;
        this.#cameras.addEventListener('change', () => this.#goTo(Number(this.#cameras.value)));
    }

    #nextDisplay() {
        this.#display.selectedIndex = (this.#display.selectedIndex + 1) % this.#display.options.length;
        this.#showDisplay();
    }

    #addDisplay() {
        this.#display.disabled = false;
        this.#exposure.disabled = false;
        this.#display.addEventListener('change', () => this.#showDisplay());
        this.#exposure.addEventListener('input', () => {
            this.picture.compensation = Number(this.#exposure.value);
            this.#showDisplay();
        });
        const colours = Array.from({length: COLOURS}, (_, i) => turbo(i / (COLOURS - 1)));
        byId('scale-bar', HTMLElement).style.background = `linear-gradient(to right, ${colours.join(', ')})`;
        byId('scale-less', HTMLButtonElement).addEventListener('click', () => this.#scaleBy(1 / 3));
        byId('scale-more', HTMLButtonElement).addEventListener('click', () => this.#scaleBy(3));
        this.#showDisplay();
    }

    /** @param {number} factor */
    #scaleBy(factor) {
        const {picture} = this;
        if (picture.mode !== 'photo') {
            picture.maximum[picture.mode] *= factor;
        }
        this.#showDisplay();
    }

    #showDisplay() {
        const {picture} = this;
        picture.mode = /** @type {Picture['mode']} */ (this.#display.value);
        byId('exposure-row', HTMLElement).hidden = picture.mode !== 'photo';
        byId('scale-row', HTMLElement).hidden = picture.mode === 'photo';
        byId('exposure-value', HTMLOutputElement).value = signed(picture.compensation);
        if (picture.mode !== 'photo') {
            const unit = picture.mode === 'luminance' ? 'cd/m²' : 'lx';
            const text = (/** @type {number} */ value) => `${Number(value.toPrecision(2))} ${unit}`;
            byId('scale-low', HTMLElement).textContent = text(picture.maximum[picture.mode] / 1000);
            byId('scale-high', HTMLElement).textContent = text(picture.maximum[picture.mode]);
        }
        picture.changed();
    }
}

/** @type {(stops: number) => string} */
const signed = (stops) => `${stops > 0 ? '+' : stops < 0 ? '−' : ''}${Math.abs(stops).toFixed(1)}`;
