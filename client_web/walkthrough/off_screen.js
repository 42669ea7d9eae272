// SPDX-License-Identifier: Apache-2.0
// Pictures that are read rather than shown: small ones for the exposure, radiance, and what lies in a direction.

import {add, scale, vec3} from '../ui/vector.js';

/**
 * @typedef {import('./renderer.js').Renderer} Renderer
 * @typedef {import('../net/scene_types.js').View} View
 * @typedef {import('../net/scene_types.js').Vec3} Vec3
 */

/** Size of the picture that the exposure is found by, pixels. */
const MEASURED = {width: 64, height: 48};
/** Field of view of what is asked for a single point, radians. */
const POINT_FOV = 0.002;
/** As the server has it. */
const EXPOSURE_LIMIT = 30;

/**
 * Draws into textures of its own; calls `read` while they are bound.
 *
 * @template T
 * @param {WebGL2RenderingContext} gl
 * @param {number} format
 * @param {{width: number, height: number}} size
 * @param {() => T} read
 * @returns {T}
 */
function withTarget(gl, format, {width, height}, read) {
    const framebuffer = gl.createFramebuffer();
    const colour = gl.createTexture();
    const depth = gl.createRenderbuffer();
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, colour);
    gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
    gl.bindRenderbuffer(gl.RENDERBUFFER, depth);
    gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT24, width, height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, colour, 0);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, depth);
    try {
        return read();
    } finally {
        gl.bindFramebuffer(gl.FRAMEBUFFER, null);
        gl.deleteFramebuffer(framebuffer);
        gl.deleteTexture(colour);
        gl.deleteRenderbuffer(depth);
    }
}

/**
 * Exposure that puts the logarithmic mean of what reflects at mid-grey (Reinhard et al. 2002), as the server's
 * automatic exposure does.
 *
 * @param {Renderer} renderer
 * @param {View} view
 * @param {number} aspect  of the picture, width over height
 * @returns {number | null} EV; null: the picture shows lamps and sky alone
 */
export function automaticExposure(renderer, view, aspect) {
    const {gl} = renderer;
    const {height} = MEASURED;
    const width = Math.max(Math.round(height * aspect), 1);
    const pixels = new Uint8Array(4 * width * height);
    withTarget(gl, gl.RGBA8, {width, height}, () => {
        renderer.draw(view, {mode: 'brightness', exposure: 0, maximum: 1}, width, height);
        gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    });
    return exposureOf(pixels);
}

/**
 * @param {Uint8Array} pixels  as the shader's brightness() writes them
 * @returns {number | null} EV
 */
export function exposureOf(pixels) {
    let [sum, count] = [0, 0];
    for (let i = 0; i < pixels.length; i += 4) {
        if (pixels[i + 2] > 127) {
            sum += ((256 * pixels[i] + pixels[i + 1]) / 65535 - 0.5) * 64;
            ++count;
        }
    }
    return count > 0 ? Math.min(Math.max(-sum / count, -EXPOSURE_LIMIT), EXPOSURE_LIMIT) : null;
}

/**
 * Radiance of a picture.
 *
 * @param {Renderer} renderer
 * @param {View} view
 * @param {number} width  pixels
 * @param {number} height  pixels
 * @returns {Float32Array | null} cd/m², four numbers a pixel, lowest row first; null: the browser cannot
 */
export function readRadiance(renderer, view, width, height) {
    const {gl} = renderer;
    if (!gl.getExtension('EXT_color_buffer_float')) {
        return null;
    }
    const pixels = new Float32Array(4 * width * height);
    withTarget(gl, gl.RGBA32F, {width, height}, () => {
        renderer.draw(view, {mode: 'linear', exposure: 0, maximum: 1}, width, height);
        gl.readPixels(0, 0, width, height, gl.RGBA, gl.FLOAT, pixels);
    });
    return pixels;
}

/**
 * A picture as it is displayed, without smooth edges.
 *
 * @param {Renderer} renderer
 * @param {View} view
 * @param {import('./renderer.js').Look} look
 * @param {number} width  pixels
 * @param {number} height  pixels
 * @returns {Uint8Array} RGBA, lowest row first
 */
export function readDisplay(renderer, view, look, width, height) {
    const {gl} = renderer;
    const pixels = new Uint8Array(4 * width * height);
    withTarget(gl, gl.RGBA8, {width, height}, () => {
        renderer.draw(view, look, width, height);
        gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    });
    return pixels;
}

/**
 * Distance that the shader's distance_code() has written.
 *
 * @param {Uint8Array} pixel  RGBA
 * @returns {number | null} metres; null: nothing is there
 */
export function distanceOf([red, green, blue, there]) {
    return there > 0 ? 2 ** (((65536 * red + 256 * green + blue) / 16777215 - 0.5) * 64) : null;
}

/**
 * What lies in a direction.
 *
 * @param {Renderer} renderer
 * @param {import('../ui/vector.js').Ray} ray  its direction of length 1
 * @returns {{position: Vec3, normal: Vec3} | null} normal: of the plane, towards the eye; null: nothing is there
 */
export function pointAlong(renderer, {origin, direction}) {
    const up = Math.abs(direction.y) < 0.9 ? vec3(0, 1, 0) : vec3(1, 0, 0);
    const view = {eye: origin, target: add(origin, direction), up, verticalFov: POINT_FOV};
    const pixel = (/** @type {'distance' | 'normal'} */ mode) =>
        readDisplay(renderer, view, {mode, exposure: 0, maximum: 1}, 1, 1);
    const distance = distanceOf(pixel('distance'));
    if (distance === null) {
        return null;
    }
    const [x, y, z] = [...pixel('normal')].map((byte) => (2 * byte) / 255 - 1);
    return {position: add(origin, scale(direction, distance)), normal: vec3(x, y, z)};
}
