// SPDX-License-Identifier: Apache-2.0
// A walkthrough: what `raybundle export` writes, drawn by the browser, without a Raybundle server.

import {CameraControl} from '../camera/camera_control.js';
import {byId} from '../ui/elements.js';
import {Controls} from './controls.js';
import {readDisplay, readRadiance} from './off_screen.js';
import {Picture} from './picture.js';
import {SceneDataError, loadScene} from './scene_data.js';

const NO_WEBGL =
    'This browser cannot draw the walkthrough: WebGL 2 is absent or switched off. A current Firefox, Chrome, Edge ' +
    'or Safari has it; hardware acceleration may have to be allowed in the settings.';
const LOST = 'The graphics driver has stopped drawing. Load the page again.';

const state = byId('state', HTMLElement);

/** @param {string} text */
function say(text) {
    if (state.textContent !== text) {
        state.textContent = text;
    }
}

/** @param {HTMLCanvasElement} canvas */
async function start(canvas) {
    const gl = canvas.getContext('webgl2', {alpha: false, antialias: true, powerPreference: 'high-performance'});
    if (!gl) {
        say(NO_WEBGL);
        return;
    }
    canvas.addEventListener('webglcontextlost', () => say(LOST));
    say('Loading');
    const scene = await loadScene((share) => say(`Loading ${Math.floor(100 * share)} %`));
    const {manifest} = scene;
    const camera = new CameraControl({
        eye: {x: 0, y: 0, z: 0}, target: {x: 0, y: 0, z: -1}, up: {x: 0, y: 1, z: 0}, verticalFov: 0.7,
    });
    const picture = new Picture(canvas, gl, scene, camera);
    const controls = new Controls(manifest, camera, picture);
    camera.fit({bounds: picture.renderer.bounds});
    camera.set(controls.cameraView(0));
    byId('scene-name', HTMLElement).textContent = manifest.name;
    document.title = manifest.name;
    picture.drawn = () => say('');
    Object.assign(window, {
        raybundleWalkthrough: {
            manifest,
            camera,
            picture,
            cameraView: (/** @type {number} */ index) => controls.cameraView(index),
            readRadiance: (/** @type {number} */ width, /** @type {number} */ height) =>
                readRadiance(picture.renderer, camera.view, width, height),
            readDisplay: (/** @type {number} */ width, /** @type {number} */ height) =>
                readDisplay(picture.renderer, camera.view, picture.look, width, height),
        },
    });
}

start(byId('canvas', HTMLCanvasElement)).catch((/** @type {unknown} */ error) => {
    const reason = error instanceof Error ? error.message : String(error);
    say(error instanceof SceneDataError ? reason : `The walkthrough cannot be drawn: ${reason}`);
});
