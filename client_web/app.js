// SPDX-License-Identifier: Apache-2.0
// The page's application: holds the parts together. `window.raybundle` is the one instance.

import {framedFov, project, rayThrough} from './camera.js';
import {CameraControl} from './camera_control.js';
import {CameraLink} from './camera_link.js';
import {ObjectMover} from './drag.js';
import {byId} from './elements.js';
import {Overlay} from './overlay.js';
import {Picker, pickByBounds} from './picking.js';
import {Picture} from './picture.js';
import {ServerError} from './protocol.js';
import {RaybundleClient} from './raybundle_client.js';
import {Readouts} from './readouts.js';
import {SceneModel} from './scene_model.js';
import {ScenePanel} from './scene_panel.js';
import {Status} from './status.js';
import {intersectBounds} from './vector.js';

/**
 * @typedef {import('./protocol.js').Vec3} Vec3
 * @typedef {import('./protocol.js').View} View
 * @typedef {import('./protocol.js').Transform} Transform
 * @typedef {import('./protocol.js').Welcome} Welcome
 * @typedef {import('./protocol.js').FrameHeader} FrameHeader
 * @typedef {import('./frame_receiver.js').Frame} Frame
 * @typedef {import('./pointer_control.js').Point} Point
 * @typedef {import('./scene_model.js').PlacedObject} PlacedObject
 */

/** Step of a keyboard move, metres. */
const NUDGE_M = 0.1;

/** @type {View} */
const NO_VIEW = {
    eye: {x: 0, y: 1.6, z: 4},
    target: {x: 0, y: 1.6, z: 0},
    up: {x: 0, y: 1, z: 0},
    verticalFov: 0.7,
};

export class RaybundleApp {
    /**
     * Header of the newest frame.
     *
     * @type {FrameHeader | null}
     */
    frame = null;
    /** @type {SceneModel | null} */
    scene = null;
    /** @type {PlacedObject | null} */
    selected = null;
    /** @type {PlacedObject | null} */
    #hovered = null;
    /** Size of the pictures that the server has been asked for. */
    #viewport = {width: 1, height: 1};
    /** Vertical field of view of the chosen camera, before it is fitted to the screen. */
    #authorFov = NO_VIEW.verticalFov;

    /** @param {{url: string, name: string, token: string}} settings */
    constructor(settings) {
        this.picture = new Picture(byId('picture', HTMLElement), byId('canvas', HTMLCanvasElement));
        this.client = new RaybundleClient({...settings, viewport: () => this.#askViewport()});
        this.camera = new CameraControl(NO_VIEW);
        this.link = new CameraLink(this.client);
        this.picker = new Picker(this.client);
        this.mover = new ObjectMover(this.client);
        this.overlay = new Overlay(byId('overlay', SVGSVGElement));
        this.readouts = new Readouts();
        this.panel = new ScenePanel();
        this.status = new Status(() => this.client.connect());
        this.#listenToServer();
        this.#listenToUser();
    }

    /** Connects to the server. */
    start() {
        this.client.connect();
    }

    /** The user's camera. */
    get view() {
        return this.camera.view;
    }

    set view(view) {
        this.camera.set(view);
    }

    /** Rates, delays and accuracy. */
    get stats() {
        return this.readouts.stats;
    }

    /** Whether this viewer may change the scene. */
    get mayEdit() {
        return this.client.welcome?.role === 'EDITOR';
    }

    /**
     * Where a point of the world appears, CSS pixels from the picture's top left corner.
     *
     * @param {Vec3} point  metres
     */
    project(point) {
        const {clientWidth, clientHeight} = this.picture.element;
        const {x, y, depth} = project(this.view, this.picture.aspect, point);
        return {x: x * clientWidth, y: y * clientHeight, depth};
    }

    /**
     * Ray through a point of the picture.
     *
     * @param {Point} at  CSS pixels
     */
    rayAt({x, y}) {
        const {clientWidth, clientHeight} = this.picture.element;
        return rayThrough(this.view, this.picture.aspect, x / clientWidth, y / clientHeight);
    }

    /**
     * Object under a point of the picture.
     *
     * @param {number} x  CSS pixels from the left
     * @param {number} y  CSS pixels from the top
     * @returns {Promise<PlacedObject | null>}
     */
    async pickAt(x, y) {
        const {clientWidth, clientHeight} = this.picture.element;
        const {width, height} = this.#viewport;
        const pixel = {x: (x / clientWidth) * width, y: (y / clientHeight) * height};
        return this.scene ? this.picker.pick(this.scene, this.rayAt({x, y}), pixel) : null;
    }

    /**
     * Selects an object.
     *
     * @param {number | null} id
     */
    select(id) {
        this.selected = this.scene?.object(id) ?? null;
        this.panel.showSelection(this.selected, this.mayEdit);
        this.drawOverlay();
    }

    /**
     * Flies to a camera of the scene.
     *
     * @param {string | number} which  name or index
     */
    flyTo(which) {
        const cameras = this.scene?.cameras ?? [];
        const camera =
            typeof which === 'number' ? cameras[which] : cameras.find(({name}) => name === which);
        if (camera) {
            this.camera.flyTo(this.#framed(camera));
        }
    }

    /**
     * Moves an object.
     *
     * @param {number} id
     * @param {Transform} transform  local
     */
    async moveObject(id, transform) {
        const object = this.scene?.object(id);
        if (object) {
            await this.mover.move(object, transform);
        }
    }

    /**
     * Shifts the selected object over the floor.
     *
     * @param {number} right  steps of 10 cm, as seen from the camera
     * @param {number} forwards  steps of 10 cm
     */
    nudge(right, forwards) {
        if (this.selected?.movable && this.mayEdit && this.scene) {
            const step = [right * NUDGE_M, forwards * NUDGE_M];
            this.mover.nudge(this.selected, this.view, step[0], step[1], this.scene.bounds);
        }
    }

    /** Draws the outlines for the picture that is on screen. */
    drawOverlay() {
        const {shown} = this.link;
        const aspect = shown ? this.picture.shownAspect : this.picture.aspect;
        this.overlay.draw(shown ?? this.view, aspect, {
            selected: this.selected?.bounds ?? null,
            hovered: this.#hovered && this.#hovered !== this.selected ? this.#hovered.bounds : null,
        });
    }

    /**
     * Whether a press here takes hold of the selected object.
     *
     * @param {Point} at
     */
    canGrab(at) {
        const object = this.selected;
        const movable = object?.movable && this.mayEdit;
        return movable ? intersectBounds(this.rayAt(at), object.bounds) !== null : false;
    }

    /**
     * Takes hold of the selected object, if it is there.
     *
     * @param {Point} at
     * @returns {boolean}
     */
    grab(at) {
        return this.selected && this.canGrab(at)
            ? this.mover.begin(this.selected, this.rayAt(at))
            : false;
    }

    /**
     * Moves what is in the user's hand.
     *
     * @param {Point} at
     */
    drag(at) {
        if (this.scene) {
            this.picture.element.classList.add('dragging');
            this.mover.drag(this.rayAt(at), this.view, this.scene.bounds);
        }
    }

    /**
     * Lets go of it.
     *
     * @param {boolean} keep  false: it goes back
     */
    release(keep) {
        this.picture.element.classList.remove('dragging');
        this.mover.end(keep);
    }

    /**
     * Marks what the pointer is over.
     *
     * @param {Point | null} at
     */
    hover(at) {
        const over = at && this.scene ? pickByBounds(this.scene.objects, this.rayAt(at)) : null;
        const before = this.#hovered;
        this.#hovered = over?.movable ? over : null;
        this.picture.element.classList.toggle('can-grab', at !== null && this.canGrab(at));
        if (this.#hovered !== before) {
            this.drawOverlay();
        }
    }

    #listenToServer() {
        const {client} = this;
        /** @type {(type: string, listener: (detail: any) => void) => void} */
        const on = (type, listener) =>
            client.addEventListener(type, (event) => {
                listener(/** @type {CustomEvent} */ (event).detail);
            });
        on('state', (change) => this.status.show(change, this.frame !== null));
        on('welcome', (welcome) => this.#welcomed(welcome));
        on('frame', (frame) => this.#arrived(frame));
        on('solution', (solution) => this.readouts.solution(solution));
        on('roundTrip', (ms) => this.readouts.roundTrip(ms));
        on('problem', (error) => this.#problem(error));
        on('sceneChanged', (change) => {
            this.scene?.apply(change, this.mover.held);
            this.#objectsMoved();
        });
    }

    #listenToUser() {
        this.camera.addEventListener('change', () => this.link.show(this.view));
        this.picture.addEventListener('resize', () => this.#resized());
        this.picture.addEventListener('viewport', () => this.#viewportChanged());
        this.mover.addEventListener('moved', () => this.#objectsMoved());
        this.mover.addEventListener('rejected', (event) =>
            this.#problem(/** @type {CustomEvent} */ (event).detail),
        );
        /** @type {(type: string, listener: (detail: any) => void) => void} */
        const on = (type, listener) =>
            this.panel.addEventListener(type, (event) => {
                listener(/** @type {CustomEvent} */ (event).detail);
            });
        on('camera', (index) => this.flyTo(index));
        on('select', (id) => this.select(id));
        on('nudge', ({right, forwards}) => this.nudge(right, forwards));
    }

    /** @param {Welcome} welcome */
    #welcomed(welcome) {
        const sameScene = this.scene?.name === welcome.scene.name;
        this.scene = new SceneModel(welcome.scene, welcome.epoch);
        this.picture.limits = welcome.limits ?? this.picture.limits;
        this.#viewportChanged();
        this.mover.forget();
        this.link.reset();
        this.readouts.reset();
        this.camera.fit(welcome.scene.bounds);
        this.panel.showScene(this.scene);
        this.status.showServer(welcome.server);
        document.title = `${welcome.scene.name} – Raybundle`;
        byId('scene-name', HTMLElement).textContent = welcome.scene.name;
        this.#hovered = null;
        this.select(sameScene ? (this.selected?.id ?? null) : null);
        if (!sameScene && this.scene.cameras.length > 0) {
            this.camera.set(this.#framed(this.scene.cameras[0]));
        }
        this.link.show(this.view);
    }

    /** @param {Frame} frame */
    #arrived({header, image, decodeMs}) {
        this.picture.draw(image);
        this.frame = header;
        this.readouts.frame(header, decodeMs, this.link.answered(header.cameraId));
        this.drawOverlay();
    }

    /**
     * View of a camera of the scene on this screen.
     *
     * @param {View} camera
     * @returns {View}
     */
    #framed({eye, target, up, verticalFov}) {
        this.#authorFov = verticalFov;
        return {eye, target, up, verticalFov: framedFov(verticalFov, this.picture.aspect)};
    }

    #askViewport() {
        this.#viewport = this.picture.viewport;
        return this.#viewport;
    }

    #viewportChanged() {
        const {width, height} = this.#viewport;
        const wanted = this.#askViewport();
        if (wanted.width !== width || wanted.height !== height) {
            this.client.send({setViewport: wanted});
        }
    }

    #resized() {
        const verticalFov = framedFov(this.#authorFov, this.picture.aspect);
        if (verticalFov !== this.view.verticalFov) {
            this.camera.set({...this.view, verticalFov});
        }
        this.drawOverlay();
    }

    #objectsMoved() {
        if (this.selected) {
            this.panel.showPlace(this.selected);
        }
        this.drawOverlay();
    }

    /** @param {unknown} error */
    #problem(error) {
        if (error instanceof ServerError) {
            this.status.notify(error.message, 'problem');
        }
    }
}
