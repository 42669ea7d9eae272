// SPDX-License-Identifier: Apache-2.0
// Tells the server where the camera is, at most once per animation frame, and knows for every frame
// that comes back which view it shows and how long it took.

import {sameView} from '../camera/camera.js';
import {DEPTH_COLUMNS} from '../picture/depth_warp.js';
import {FrameThrottle} from '../picture/frame_throttle.js';

/**
 * @typedef {import('./scene_types.js').View} View
 * @typedef {import('./raybundle_client.js').RaybundleClient} RaybundleClient
 */

/** Views on their way; more than this are not answered any more. */
const MAX_PENDING = 256;

/**
 * Asks for frames with depths, or without where they are of no use: they cost the server and this page time.
 * A server that knows of none goes on without.
 *
 * @param {RaybundleClient} client
 * @param {import('../picture/picture.js').Picture} picture
 */
export function askForDepths(client, picture) {
    const columns = picture.takesDepths ? DEPTH_COLUMNS : 0;
    client.request({setDepths: {columns}}).answer.catch(() => {});
}

export class CameraLink {
    /** @type {Map<number, {view: View, sent: number}>} by id of the setCamera, in order */
    #pending = new Map();
    /** @type {View | null} */
    #wanted = null;
    /** @type {View | null} */
    #sent = null;
    #throttle = new FrameThrottle(() => this.#send());

    /** @param {RaybundleClient} client */
    constructor(client) {
        this.client = client;
        /**
         * View of the newest frame.
         *
         * @type {View | null}
         */
        this.shown = null;
        /** Whether another viewer leads, so that the server knows the view before this page. */
        this.led = false;
    }

    /**
     * Takes over a view that the server shows already, since another viewer leads.
     *
     * @param {View} view
     */
    adopt(view) {
        this.led = true;
        this.#wanted = this.#sent = this.shown = view;
        this.#pending.clear();
    }

    /** Starts anew, with a new connection. */
    reset() {
        this.#pending.clear();
        this.#sent = null;
        this.shown = null;
        this.led = false;
    }

    /** @param {View} view */
    show(view) {
        this.#wanted = view;
        this.#throttle.run();
    }

    /**
     * Takes note of a frame.
     *
     * @param {number} cameraId  FrameHeader.cameraId
     * @returns {number | null} milliseconds from sending the view to now; null if the frame is not
     *     the first that shows it
     */
    answered(cameraId) {
        const entry = this.#pending.get(cameraId);
        for (const id of this.#pending.keys()) {
            if (id <= cameraId) {
                this.#pending.delete(id);
            }
        }
        if (!entry) {
            return null;
        }
        this.shown = entry.view;
        return performance.now() - entry.sent;
    }

    #send() {
        const view = this.#wanted;
        const known = view && this.#sent && sameView(view, this.#sent);
        if (!view || known || this.client.state !== 'connected') {
            return;
        }
        this.#sent = view;
        this.led = false;
        const {eye, target, up, verticalFov, near} = view;
        const {id, answer} = this.client.request({setCamera: {eye, target, up, verticalFov, ...(near && {near})}});
        this.#pending.set(id, {view, sent: performance.now()});
        if (this.#pending.size > MAX_PENDING) {
            this.#pending.delete(this.#pending.keys().next().value ?? 0);
        }
        answer.catch((error) => {
            this.#pending.delete(id);
            this.client.dispatchEvent(new CustomEvent('problem', {detail: error}));
        });
    }
}
