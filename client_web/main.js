// SPDX-License-Identifier: Apache-2.0
// Starts the page: the application, its keys, buttons and gestures.

import {RaybundleApp} from './app.js';
import {byId, returnFocus} from './elements.js';
import {PICTURE_SIZES} from './picture.js';
import {PointerControl} from './pointer_control.js';

/** Below this width the panel starts closed, CSS pixels. */
const PHONE_WIDTH = 700;

/** The WebSocket beside this page. */
function socketUrl() {
    const url = new URL('ws', location.href);
    url.protocol = location.protocol === 'https:' ? 'wss:' : 'ws:';
    url.search = url.hash = '';
    return url.href;
}

/**
 * What the address says after `#`, which is never sent over the network: name and token.
 *
 * @returns {{name: string, token: string}}
 */
function settingsFromAddress() {
    const parameters = new URLSearchParams(location.hash.slice(1));
    return {name: parameters.get('name') ?? '', token: parameters.get('token') ?? ''};
}

/**
 * Selects what can be moved; a click on the building deselects.
 *
 * @param {RaybundleApp} app
 * @param {import('./pointer_control.js').Point} at
 */
async function clickAt(app, at) {
    const object = await app.pickAt(at.x, at.y);
    app.select(object?.movable ? object.id : null);
}

/** @param {RaybundleApp} app */
function addGestures(app) {
    return new PointerControl(app.picture.element, {
        grab: (at) => app.grab(at),
        drag: (at) => app.drag(at),
        release: (keep) => app.release(keep),
        hover: (at) => app.hover(at),
        click: (at) => clickAt(app, at),
        turn: (x, y) => app.camera.turn(x, y),
        pan: (x, y) => app.camera.pan(x, y),
        zoom: (factor) => app.camera.zoom(factor),
    });
}

/**
 * Orbit or walk.
 *
 * @param {RaybundleApp} app
 * @param {import('./camera_control.js').Mode} mode
 */
function setMode(app, mode) {
    app.camera.mode = mode;
    for (const button of document.querySelectorAll('[data-mode]')) {
        const pressed = /** @type {HTMLElement} */ (button).dataset.mode === mode;
        button.setAttribute('aria-pressed', String(pressed));
    }
}

const NUDGE_KEYS = new Map([
    ['ArrowLeft', [-1, 0]],
    ['ArrowRight', [1, 0]],
    ['ArrowUp', [0, 1]],
    ['ArrowDown', [0, -1]],
]);

/**
 * @param {RaybundleApp} app
 * @param {PointerControl} pointers
 * @param {KeyboardEvent} event
 * @returns {boolean} whether the key means anything
 */
function pressKey(app, pointers, event) {
    const nudge = event.shiftKey && app.selected?.movable ? NUDGE_KEYS.get(event.code) : undefined;
    if (nudge) {
        app.nudge(nudge[0], nudge[1]);
    } else if (event.key === 'Escape') {
        if (!pointers.cancel()) {
            app.select(null);
        }
    } else if (event.key === '+' || event.key === '-') {
        app.camera.zoom(event.key === '+' ? 0.9 : 1 / 0.9);
    } else if (event.key === 'Home') {
        app.flyTo(0);
    } else if (event.code === 'KeyM') {
        setMode(app, app.camera.mode === 'orbit' ? 'walk' : 'orbit');
    } else {
        return app.camera.keyDown(event.code, event.shiftKey);
    }
    return true;
}

/**
 * Keys work while the picture has the focus, or nothing has.
 *
 * @param {RaybundleApp} app
 * @param {PointerControl} pointers
 */
function addKeys(app, pointers) {
    document.addEventListener('keydown', (event) => {
        const here = event.target === document.body || event.target === app.picture.element;
        const modified = event.ctrlKey || event.metaKey || event.altKey;
        if (here && !modified && pressKey(app, pointers, event)) {
            event.preventDefault();
        }
    });
    document.addEventListener('keyup', (event) => app.camera.keyUp(event.code));
    addEventListener('blur', () => app.camera.releaseKeys());
    document.addEventListener('focusout', () => app.camera.releaseKeys());
}

/** @param {RaybundleApp} app */
function addButtons(app) {
    for (const button of document.querySelectorAll('[data-mode]')) {
        button.addEventListener('click', (event) => {
            setMode(
                app,
                /** @type {HTMLElement} */ (button).dataset.mode === 'walk' ? 'walk' : 'orbit',
            );
            returnFocus(/** @type {MouseEvent} */ (event));
        });
    }
    const size = byId('picture-size', HTMLSelectElement);
    size.addEventListener('change', () => {
        if (size.value in PICTURE_SIZES) {
            app.picture.size = /** @type {import('./picture.js').PictureSize} */ (size.value);
        }
    });
    const toggle = byId('panel-toggle', HTMLButtonElement);
    const setPanel = (/** @type {boolean} */ open) => {
        byId('app', HTMLElement).classList.toggle('panel-closed', !open);
        toggle.setAttribute('aria-expanded', String(open));
    };
    toggle.addEventListener('click', () => {
        setPanel(toggle.getAttribute('aria-expanded') !== 'true');
    });
    setPanel(innerWidth > PHONE_WIDTH);
}

const app = new RaybundleApp({url: socketUrl(), ...settingsFromAddress()});
addButtons(app);
addKeys(app, addGestures(app));
document.addEventListener('visibilitychange', () => {
    app.client.paused = document.hidden;
});
Object.assign(window, {raybundle: app});
app.start();
