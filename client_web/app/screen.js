// SPDX-License-Identifier: Apache-2.0
// The picture as it lies on the screen: how large the server's pictures are to be, and which pixel, ray
// or view belongs to what the user sees.

import {framedFov, project, rayThrough} from '../camera/camera.js';

/**
 * @typedef {import('../net/scene_types.js').Vec3} Vec3
 * @typedef {import('../net/scene_types.js').View} View
 * @typedef {import('../picture/picture.js').Picture} Picture
 * @typedef {import('../camera/pointer_control.js').Point} Point
 */

export class Screen {
    /** Size of the pictures that the server has been asked for. */
    #viewport = {width: 1, height: 1};
    /** Vertical field of view of the chosen camera, before it is fitted to the screen. */
    #authorFov;

    /**
     * @param {Picture} picture
     * @param {number} verticalFov  until a camera is chosen, radians
     */
    constructor(picture, verticalFov) {
        this.picture = picture;
        this.#authorFov = verticalFov;
    }

    /** The size to ask the server for, which has been asked for from now on. */
    askViewport() {
        this.#viewport = this.picture.viewport;
        return this.#viewport;
    }

    /**
     * As askViewport(), where that is another size than before.
     *
     * @returns {{width: number, height: number} | null}
     */
    askChangedViewport() {
        const {width, height} = this.#viewport;
        const wanted = this.askViewport();
        return wanted.width !== width || wanted.height !== height ? wanted : null;
    }

    /**
     * View of a camera of the scene on this screen.
     *
     * @param {View} camera
     * @returns {View}
     */
    framed({eye, target, up, verticalFov}) {
        this.#authorFov = verticalFov;
        return {eye, target, up, verticalFov: this.fittedFov};
    }

    /** Vertical field of view of the chosen camera on this screen, radians. */
    get fittedFov() {
        return framedFov(this.#authorFov, this.picture.aspect);
    }

    /**
     * Where a point of the world appears, CSS pixels from the picture's top left corner.
     *
     * @param {View} view
     * @param {Vec3} point  metres
     */
    project(view, point) {
        const {clientWidth, clientHeight} = this.picture.element;
        const {x, y, depth} = project(view, this.picture.aspect, point);
        return {x: x * clientWidth, y: y * clientHeight, depth};
    }

    /**
     * Ray through a point of the picture.
     *
     * @param {View} view
     * @param {Point} at  CSS pixels
     */
    rayAt(view, {x, y}) {
        const {clientWidth, clientHeight} = this.picture.element;
        return rayThrough(view, this.picture.aspect, x / clientWidth, y / clientHeight);
    }

    /**
     * Pixel of the server's picture.
     *
     * @param {Point} at  CSS pixels
     */
    pixelAt({x, y}) {
        const {clientWidth, clientHeight} = this.picture.element;
        const {width, height} = this.#viewport;
        return {x: (x / clientWidth) * width, y: (y / clientHeight) * height};
    }
}
