// SPDX-License-Identifier: Apache-2.0
// For other people's pages: <raybundle-view src="https://server:8080"> shows a scene and lets the
// visitor look around. RaybundleClient is the connection alone. See example.html.

import {CameraControl} from './camera/camera_control.js';
import {CameraLink, askForDepths} from './net/camera_link.js';
import {framedFov} from './camera/camera.js';
import {Picture} from './picture/picture.js';
import {PointerControl} from './camera/pointer_control.js';
import {RaybundleClient} from './net/raybundle_client.js';

export {RaybundleClient};

/** @typedef {import('./net/protocol.js').Welcome} Welcome */

/** @type {import('./net/scene_types.js').View} */
const NO_VIEW = {
    eye: {x: 0, y: 1.6, z: 4},
    target: {x: 0, y: 1.6, z: 0},
    up: {x: 0, y: 1, z: 0},
    verticalFov: 0.7,
};

const STYLE = `
:host{display:block;position:relative;aspect-ratio:4/3;background:#121314;overflow:hidden}
div{position:absolute;inset:0;touch-action:none;outline-offset:-2px}
canvas{position:absolute;inset:0;width:100%;height:100%;transform-origin:0 0}
p{position:absolute;left:0;right:0;bottom:0;margin:0;padding:6px 10px;font:13px system-ui,sans-serif;
color:#fff;background:rgb(0 0 0/.6)}p:empty{display:none}`;

/**
 * Address of a server's WebSocket.
 *
 * @param {string} src  address of its page
 * @returns {string}
 */
export function socketOf(src) {
    const url = new URL('ws', new URL(src.endsWith('/') ? src : `${src}/`, location.href));
    url.protocol = url.protocol === 'https:' || url.protocol === 'wss:' ? 'wss:' : 'ws:';
    return url.href;
}

/**
 * Attributes: `src` (address of the server, or several of one project with spaces between; absent: the page's own), `camera` (name of the first
 * view), `token`, `name`, `mode` (orbit or walk). Events: `welcome` (detail Welcome), `frame` (detail
 * FrameHeader). Properties: `client`, `camera`.
 */
export class RaybundleView extends HTMLElement {
    /** @type {RaybundleClient | null} */
    client = null;
    /** @type {CameraControl | null} */
    control = null;

    connectedCallback() {
        const root = this.shadowRoot ?? this.attachShadow({mode: 'open'});
        const sheet = new CSSStyleSheet();
        sheet.replaceSync(STYLE);
        root.adoptedStyleSheets = [sheet];
        const element = document.createElement('div');
        element.tabIndex = 0;
        element.setAttribute('role', 'application');
        element.setAttribute('aria-label', this.getAttribute('aria-label') ?? 'View of a scene');
        const canvas = document.createElement('canvas');
        const note = document.createElement('p');
        note.setAttribute('role', 'status');
        element.append(canvas);
        root.replaceChildren(element, note);
        this.#start(new Picture(element, canvas), note);
    }

    disconnectedCallback() {
        this.client?.close();
        this.client = null;
    }

    /**
     * Flies to a camera of the scene.
     *
     * @param {string} name
     */
    flyTo(name) {
        const camera = this.client?.welcome?.scene.cameras.find((other) => other.name === name);
        if (camera) {
            const {clientWidth, clientHeight} = this;
            const aspect = clientWidth / Math.max(clientHeight, 1);
            const {eye, target, up, verticalFov} = camera;
            this.control?.flyTo({eye, target, up, verticalFov: framedFov(verticalFov, aspect)});
        }
    }

    /**
     * @param {Picture} picture
     * @param {HTMLElement} note
     */
    #start(picture, note) {
        const client = new RaybundleClient({
            url: (this.getAttribute('src')?.trim() || '.').split(/\s+/).map(socketOf),
            name: this.getAttribute('name') ?? '',
            token: this.getAttribute('token') ?? '',
            viewport: () => picture.viewport,
        });
        const control = new CameraControl(NO_VIEW);
        const link = new CameraLink(client);
        control.mode = this.getAttribute('mode') === 'walk' ? 'walk' : 'orbit';
        this.client = client;
        this.control = control;
        let drawn = false;
        const warp = () => link.shown && picture.warp(link.shown, control.view);
        control.addEventListener('change', () => {
            link.show(control.view);
            warp();
        });
        picture.addEventListener('resize', warp);
        picture.addEventListener('viewport', () => client.send({setViewport: picture.viewport}));
        picture.addEventListener('flat', () => askForDepths(client, picture));
        client.addEventListener('state', (event) => {
            const {state, reason} = /** @type {CustomEvent} */ (event).detail;
            note.textContent = state === 'connected' ? '' : [state, reason].filter(Boolean).join(': ');
        });
        client.addEventListener('welcome', (event) => {
            const welcome = /** @type {Welcome} */ (/** @type {CustomEvent} */ (event).detail);
            picture.limits = welcome.limits;
            control.fit(welcome.scene);
            note.textContent = drawn ? '' : 'Drawing the first picture';
            link.reset();
            askForDepths(client, picture);
            this.#firstView(control, picture, welcome);
            link.show(control.view);
            this.dispatchEvent(new CustomEvent('welcome', {detail: welcome}));
        });
        client.addEventListener('frame', (event) => {
            const {header, image, depths} = /** @type {CustomEvent} */ (event).detail;
            picture.draw(image, depths);
            drawn = true;
            note.textContent = '';
            link.answered(header.cameraId);
            warp();
            this.dispatchEvent(new CustomEvent('frame', {detail: header}));
        });
        this.#listenToUser(picture.element, control);
        client.connect();
    }

    /**
     * @param {CameraControl} control
     * @param {Picture} picture
     * @param {Welcome} welcome
     */
    #firstView(control, picture, {scene}) {
        const wanted = this.getAttribute('camera');
        const camera = scene.cameras.find(({name}) => name === wanted) ?? scene.cameras[0];
        if (camera && control.view === NO_VIEW) {
            const {eye, target, up, verticalFov} = camera;
            control.set({eye, target, up, verticalFov: framedFov(verticalFov, picture.aspect)});
        }
    }

    /**
     * @param {HTMLElement} element
     * @param {CameraControl} control
     */
    #listenToUser(element, control) {
        new PointerControl(element, {
            grab: () => false,
            drag: () => {},
            release: () => {},
            click: () => {},
            hover: () => {},
            turn: (x, y) => control.turn(x, y),
            pan: (x, y) => control.pan(x, y),
            zoom: (factor) => control.zoom(factor),
        });
        element.addEventListener('keydown', (event) => {
            const modified = event.ctrlKey || event.metaKey || event.altKey;
            if (!modified && control.keyDown(event.code, event.shiftKey)) {
                event.preventDefault();
            }
        });
        element.addEventListener('keyup', (event) => control.keyUp(event.code));
        element.addEventListener('blur', () => control.releaseKeys());
    }
}

customElements.define('raybundle-view', RaybundleView);
