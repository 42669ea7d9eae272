// SPDX-License-Identifier: Apache-2.0
// The page's application: connection, camera, picture, scene and selection. Everything else in the
// page (tools, panels, review) is built on it by main.js. `window.raybundle` is the one instance.

import {framing} from '../camera/camera.js';
import {CameraControl} from '../camera/camera_control.js';
import {CameraLink, askForDepths} from '../net/camera_link.js';
import {ObjectMover} from '../scene/drag.js';
import {byId} from '../ui/elements.js';
import {Overlay} from '../picture/overlay.js';
import {Picker} from '../scene/picking.js';
import {Picture} from '../picture/picture.js';
import {ServerError} from '../net/protocol.js';
import {RaybundleClient} from '../net/raybundle_client.js';
import {Readouts} from '../measure/readouts.js';
import {SceneModel} from '../scene/scene_model.js';
import {Status, sentence} from '../ui/status.js';
import {Screen} from './screen.js';

/**
 * @typedef {import('../net/scene_types.js').Vec3} Vec3
 * @typedef {import('../net/scene_types.js').View} View
 * @typedef {import('../net/scene_types.js').Transform} Transform
 * @typedef {import('../net/protocol.js').Welcome} Welcome
 * @typedef {import('../net/protocol.js').FrameHeader} FrameHeader
 * @typedef {import('../net/measure_types.js').ProbeResult} ProbeResult
 * @typedef {import('../net/protocol.js').ServerMessage} ServerMessage
 * @typedef {import('../net/frame_receiver.js').Frame} Frame
 * @typedef {import('../camera/pointer_control.js').Point} Point
 * @typedef {import('../scene/scene_model.js').PlacedObject} PlacedObject
 */

/** @type {View} */
const NO_VIEW = {
    eye: {x: 0, y: 1.6, z: 4},
    target: {x: 0, y: 1.6, z: 0},
    up: {x: 0, y: 1, z: 0},
    verticalFov: 0.7,
};

/**
 * Events: `anew`, before `welcome`, when the server knows nothing of the changes seen so far (another scene,
 * another start; detail {otherScene}); `welcome` (detail Welcome), `picture` (detail FrameHeader), `solution`, `sceneChanged`,
 * `hidden` (ids of objects that are not shown), `selection`, `moved` (an object's place here), `view` (the camera), `tool`, `message` (every text
 * message of the server), `upload` (somebody has dropped a scene on the page).
 */
export class RaybundleApp extends EventTarget {
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
    /** What a click does. */
    tool = 'select';
    /** View to start with instead of the first camera, as a shared link has it. */
    #firstView = /** @type {View | null} */ (null);
    /** This viewer's number at the last connection. */
    #number = 0;

    /** @param {{url: string, name: string, token: string, view?: View | null, video?: boolean}} settings */
    constructor(settings) {
        super();
        this.#firstView = settings.view ?? null;
        this.picture = new Picture(byId('picture', HTMLElement), byId('canvas', HTMLCanvasElement));
        this.screen = new Screen(this.picture, NO_VIEW.verticalFov);
        this.client = new RaybundleClient({...settings, viewport: () => this.screen.askViewport()});
        this.camera = new CameraControl(NO_VIEW);
        this.link = new CameraLink(this.client);
        this.picker = new Picker(this.client);
        this.mover = new ObjectMover(this.client);
        this.overlay = new Overlay(byId('overlay', SVGSVGElement));
        this.readouts = new Readouts();
        this.readouts.picture = this.picture;
        this.status = new Status(this.client);
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

    /** Whether this viewer may leave pins and viewpoints. */
    get mayReview() {
        return this.mayEdit || this.client.welcome?.role === 'REVIEWER';
    }

    /**
     * Listens to one of this application's events.
     *
     * @param {string} type
     * @param {(detail: any) => void} listener
     */
    on(type, listener) {
        this.addEventListener(type, (event) => {
            listener(/** @type {CustomEvent} */ (event).detail);
        });
    }

    /**
     * Sends a request; a refusal is shown to the user.
     *
     * @param {object} body
     * @returns {Promise<ServerMessage | null>} null: refused, or the connection is lost
     */
    async ask(body) {
        try {
            return await this.client.request(body).answer;
        } catch (error) {
            this.#problem(error);
            return null;
        }
    }

    /**
     * Where a point of the world appears, CSS pixels from the picture's top left corner.
     *
     * @param {Vec3} point  metres
     */
    project(point) {
        return this.screen.project(this.view, point);
    }

    /**
     * Ray through a point of the picture.
     *
     * @param {Point} at  CSS pixels
     */
    rayAt(at) {
        return this.screen.rayAt(this.view, at);
    }

    /**
     * Object under a point of the picture.
     *
     * @param {number} x  CSS pixels from the left
     * @param {number} y  CSS pixels from the top
     * @returns {Promise<PlacedObject | null>}
     */
    async pickAt(x, y) {
        const pixel = this.screen.pixelAt({x, y});
        return this.scene ? this.picker.pick(this.scene, this.rayAt({x, y}), pixel) : null;
    }

    /**
     * What the picture shows at a point, measured.
     *
     * @param {Point} at  CSS pixels
     * @returns {Promise<ProbeResult | null>} null: nothing is there, or no answer
     */
    async probeAt(at) {
        const answer = await this.ask({probe: {pixel: this.screen.pixelAt(at)}});
        return answer?.probeResult?.hit ? answer.probeResult : null;
    }

    /**
     * Selects an object.
     *
     * @param {number | null} id
     */
    select(id) {
        this.selected = this.scene?.object(id) ?? null;
        this.#emit('selection', this.selected);
        this.drawOverlay();
    }

    /** @param {string} tool  what a click does from now on */
    setTool(tool) {
        this.tool = tool;
        this.picture.element.dataset.tool = tool;
        this.#emit('tool', tool);
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
            this.camera.flyTo(this.framed(camera));
        }
    }

    /** Flies to where all of the selected object is seen, or of the scene: from within a room, as far as it goes. */
    frameSelected() {
        const bounds = (this.selected ?? this.scene)?.bounds;
        if (bounds) {
            this.camera.flyAround(framing(this.view, bounds, this.picture.aspect, this.camera.space));
        }
    }

    /**
     * Shows a view that the server knows of already, because another viewer leads.
     *
     * @param {View} view
     */
    adopt(view) {
        this.link.adopt(view);
        this.camera.set(view);
        this.drawOverlay();
    }

    /**
     * View of a camera of the scene on this screen.
     *
     * @param {View} camera
     * @returns {View}
     */
    framed(camera) {
        return this.screen.framed(camera);
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

    /** Draws what lies over the picture, and puts the picture where the camera has it. */
    drawOverlay() {
        const {shown} = this.link;
        // Between a plan and the eyes of somebody nothing is alike: what lies over the picture stays
        // with it until the other one is there.
        const alike = !shown || !this.frame || (shown.near ?? 0) > 0 === (this.view.near ?? 0) > 0;
        if (shown && this.frame) {
            this.picture.warp(alike ? shown : this.view, this.view);
        }
        this.overlay.draw(alike ? this.view : shown, this.picture.aspect);
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
        on('solution', (solution) => {
            this.readouts.solution(solution);
            this.#emit('solution', solution);
        });
        on('roundTrip', (ms) => this.readouts.roundTrip(ms));
        on('problem', (error) => this.#problem(error));
        on('message', (message) => this.#emit('message', message));
        on('sceneChanged', (change) => {
            this.scene?.apply(change, this.mover.held);
            this.#emit('sceneChanged', change);
            this.#objectsMoved();
        });
    }

    #listenToUser() {
        this.camera.addEventListener('change', () => {
            this.link.show(this.view);
            this.#emit('view', this.view);
            this.drawOverlay();
        });
        this.picture.addEventListener('resize', () => this.#resized());
        this.picture.addEventListener('viewport', () => this.#viewportChanged());
        this.picture.addEventListener('flat', () => askForDepths(this.client, this.picture));
        this.mover.addEventListener('moved', () => this.#objectsMoved());
        this.mover.addEventListener('rejected', (event) =>
            this.#problem(/** @type {CustomEvent} */ (event).detail),
        );
    }

    /** @param {Welcome} welcome */
    #welcomed(welcome) {
        const before = this.scene;
        const sameScene = before?.name === welcome.scene.name;
        this.scene = new SceneModel(welcome.scene, welcome.epoch);
        // Within one run of a server the numbers of viewers only grow.
        const sameRun = welcome.viewer > this.#number;
        this.#number = welcome.viewer;
        const goesOn = before !== null && sameScene && this.scene.goesOnFrom(before, sameRun);
        const anew = before !== null && sameScene && !goesOn && before.epoch > 0;
        this.picture.limits = welcome.limits ?? this.picture.limits;
        this.#viewportChanged();
        this.mover.forget();
        this.link.reset();
        askForDepths(this.client, this.picture);
        this.readouts.reset();
        this.camera.fit(welcome.scene);
        if (!sameScene) {
            this.#forgetPicture();
        }
        this.status.showWelcome(welcome, this.scene.title, this.frame !== null);
        if (!sameScene && this.#firstView) {
            this.camera.set(this.#firstView);
            this.#firstView = null;
        } else if (!sameScene && this.scene.cameras.length > 0) {
            this.camera.set(this.framed(this.scene.cameras[0]));
        }
        if (anew) {
            this.status.notify('The server restarted. Unsaved changes and pins were lost.');
        }
        if (!goesOn) {
            this.#emit('anew', {otherScene: before !== null && !sameScene});
        } else if (before) {
            this.#emit('missed', this.scene.differencesFrom(before));
        }
        this.#emit('welcome', welcome);
        this.select(sameScene ? (this.selected?.id ?? null) : null);
        this.link.show(this.view);
    }

    /** The picture of another scene is not of this one, nor is what was said of it. */
    #forgetPicture() {
        this.frame = null;
        this.picture.clear();
        this.readouts.forget();
    }

    /** @param {Frame} frame */
    #arrived({header, image, depths, decodeMs}) {
        this.picture.draw(image, depths);
        this.frame = header;
        this.readouts.frame(header, decodeMs, this.link.answered(header.cameraId));
        this.status.showPicture();
        this.#emit('picture', header);
        this.drawOverlay();
    }

    #viewportChanged() {
        const wanted = this.screen.askChangedViewport();
        if (wanted) {
            this.client.send({setViewport: wanted});
        }
    }

    #resized() {
        const verticalFov = this.screen.fittedFov;
        if (verticalFov !== this.view.verticalFov && !this.link.led && !this.view.near) {
            this.camera.set({...this.view, verticalFov});
        }
        this.drawOverlay();
    }

    #objectsMoved() {
        this.#emit('moved', null);
        this.drawOverlay();
    }

    /** @param {unknown} error */
    #problem(error) {
        if (error instanceof ServerError) {
            this.status.notify(sentence(error.message), 'problem');
        }
    }

    /**
     * @param {string} type
     * @param {unknown} detail
     */
    #emit(type, detail) {
        this.dispatchEvent(new CustomEvent(type, {detail}));
    }
}
