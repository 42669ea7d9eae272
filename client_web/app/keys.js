// SPDX-License-Identifier: Apache-2.0
// The keyboard: what each key does while the picture has the focus, or nothing has. Undo and redo work
// everywhere but in fields of text.

import {byId} from '../ui/elements.js';

/**
 * @typedef {import('./app.js').RaybundleApp} RaybundleApp
 * @typedef {object} KeyTargets
 * @property {RaybundleApp} app
 * @property {import('../camera/walking.js').Walking} walking
 * @property {import('../camera/collisions.js').Collisions} collisions
 * @property {import('../scene/gizmo.js').Gizmo} gizmo
 * @property {import('../scene/grabbing.js').Grabbing} grabbing
 * @property {import('../measure/display_panel.js').DisplayPanel} display
 * @property {import('../scene/history.js').History} history
 * @property {import('../scene/things.js').Things} things
 * @property {(tool: string) => void} setTool
 * @property {() => boolean} removeLastPoint  the newest measured one; whether there was one
 * @property {() => void} clickMiddle  as a click on the middle of the picture
 * @property {() => boolean} cancel  ends what is going on; whether there was anything
 * @property {() => void} showKeys  the list of them
 * @property {() => void} leave  the focus goes from a control back to the picture
 */

const NUDGE_KEYS = new Map([
    ['ArrowLeft', [-1, 0]],
    ['ArrowRight', [1, 0]],
    ['ArrowUp', [0, 1]],
    ['ArrowDown', [0, -1]],
]);

/** What Enter does in the middle of the picture, by tool. @type {Record<string, string>} */
const AIMS = {
    select: 'Enter selects this',
    measure: 'Enter measures here',
    pin: 'Enter leaves a note here',
    aim: 'Enter aims the light here',
};

/** @type {Map<string, (targets: KeyTargets) => void>} */
const COMMANDS = new Map([
    ['Home', ({app}) => app.flyTo(0)],
    ['KeyM', ({walking}) => walking.switchMode()],
    ['KeyL', ({walking}) => walking.lookWithMouse()],
    ['KeyH', ({walking}) => walking.stand()],
    ['KeyF', ({app}) => app.frameSelected()],
    ['KeyC', ({collisions}) => collisions.toggle()],
    ['KeyV', ({display}) => display.nextMode()],
    ['KeyG', ({gizmo}) => gizmo.setMode('move')],
    ['KeyR', ({gizmo}) => gizmo.setMode('turn')],
    ['KeyT', ({gizmo}) => gizmo.setMode('size')],
    ['Enter', pressMiddle],
    ['Digit1', ({setTool}) => setTool('select')],
    ['Digit2', ({setTool}) => setTool('measure')],
    ['Digit3', ({setTool}) => setTool('pin')],
]);

/** @param {KeyTargets} targets */
function pressMiddle({app, clickMiddle}) {
    app.picture.element.classList.add('by-keys');
    clickMiddle();
}

/**
 * Marks where Enter clicks, for those who have come to the picture by the keyboard.
 *
 * @param {RaybundleApp} app
 */
function addAim(app) {
    const {element} = app.picture;
    element.addEventListener('focus', () => {
        element.classList.toggle('by-keys', element.matches(':focus-visible'));
    });
    for (const type of ['pointerdown', 'pointermove']) {
        element.addEventListener(type, () => element.classList.remove('by-keys'));
    }
    app.on('tool', (tool) => {
        byId('aim', HTMLElement).textContent = AIMS[tool];
    });
}

/**
 * @param {KeyTargets} targets
 * @param {KeyboardEvent} event
 * @returns {boolean} whether the key means anything
 */
function press(targets, event) {
    const {app} = targets;
    const nudge = event.shiftKey && app.selected?.loose ? NUDGE_KEYS.get(event.code) : undefined;
    if (nudge) {
        targets.grabbing.nudge(nudge[0], nudge[1]);
        return true;
    }
    if (event.key === 'Escape') {
        if (!targets.cancel()) {
            app.select(null);
        }
        return true;
    }
    if (event.key === '?') {
        targets.showKeys();
        return true;
    }
    if (event.key === '+' || event.key === '-') {
        app.camera.zoom(event.key === '+' ? 0.9 : 1 / 0.9);
        return true;
    }
    if (event.key === 'Delete' || event.key === 'Backspace') {
        remove(targets);
        return true;
    }
    const command = COMMANDS.get(event.code);
    if (command && !event.repeat) {
        command(targets);
        return true;
    }
    return app.camera.keyDown(event.code, event.shiftKey);
}

/**
 * Takes a measured point away, or else the selected object.
 *
 * @param {KeyTargets} targets
 */
function remove({app, things, removeLastPoint}) {
    if (app.tool === 'measure' && removeLastPoint()) {
        return;
    }
    if (app.selected) {
        things.removeSelected();
    } else {
        app.status.notify('Nothing to delete: Del takes away the selected object, or the newest point while Measure is on.');
    }
}

/**
 * Undo, redo and copies.
 *
 * @param {KeyTargets} targets
 * @param {KeyboardEvent} event
 * @returns {boolean}
 */
function pressModified({things, history}, event) {
    if (event.code === 'KeyD' && !event.shiftKey) {
        things.duplicateSelected();
        return true;
    }
    if (event.code === 'KeyZ' && !event.shiftKey) {
        history.undo();
        return true;
    }
    if (event.code === 'KeyY' || event.code === 'KeyZ') {
        history.redo();
        return true;
    }
    return false;
}

/**
 * Whether somebody writes there, so that undo is the field's own.
 *
 * @param {EventTarget | null} target
 */
const isText = (target) =>
    target instanceof HTMLTextAreaElement ||
    (target instanceof HTMLInputElement && !['range', 'checkbox', 'color'].includes(target.type));

/**
 * Whether a key means nothing to the control that has the focus, as letters to a tab that has been clicked.
 *
 * @param {KeyboardEvent} event
 */
const isFree = ({target, key}) =>
    key.length === 1 && key !== ' ' && !isText(target) && target instanceof HTMLElement &&
    !target.isContentEditable && !target.closest('select, dialog, [role="dialog"]');

/** @param {KeyTargets} targets */
export function addKeys(targets) {
    const {app} = targets;
    addAim(app);
    document.addEventListener('keydown', (event) => {
        const here = event.target === document.body || event.target === app.picture.element || isFree(event);
        const modified = event.ctrlKey || event.metaKey;
        if (event.key === 'Escape' && !here && !event.defaultPrevented) {
            if (!targets.cancel()) {
                targets.leave();
            }
            event.preventDefault();
            return;
        }
        if (event.altKey || (modified ? isText(event.target) : !here)) {
            return;
        }
        if (modified ? pressModified(targets, event) : press(targets, event)) {
            event.preventDefault();
        }
    });
    document.addEventListener('keyup', (event) => app.camera.keyUp(event.code));
    addEventListener('blur', () => app.camera.releaseKeys());
    document.addEventListener('focusout', () => app.camera.releaseKeys());
}
