// SPDX-License-Identifier: Apache-2.0
// Draws the last picture as it looks from another place, by its depths: a mesh over the picture, each
// vertex as far away as what it shows, drawn by WebGL. What was hidden is stretched over from its edges.

import {axes} from '../camera/camera.js';
import {add, dot, scale, sub} from '../ui/vector.js';
import {noteDrawer} from './drawer.js';

/**
 * @typedef {import('../net/scene_types.js').View} View
 * @typedef {import('../net/scene_types.js').Vec3} Vec3
 * @typedef {import('./depths.js').Depths} Depths
 */

/** Columns of depths to ask the server for: a vertex for some four pixels. */
export const DEPTH_COLUMNS = 256;

/** Nearer to the new eye than this share of the nearest depth nothing is drawn. */
const NEAREST = 0.05;

const VERTEX_SHADER = `#version 300 es
in float inverseDepth;
uniform mat4 clipFromPicture;
uniform ivec2 points;
out vec2 at;
void main() {
    at = vec2(gl_VertexID % points.x, gl_VertexID / points.x) / vec2(points - 1);
    gl_Position = clipFromPicture * vec4(at, 1.0, inverseDepth);
}`;

const FRAGMENT_SHADER = `#version 300 es
precision mediump float;
in vec2 at;
uniform sampler2D picture;
out vec4 colour;
void main() {
    colour = vec4(texture(picture, at).rgb, 1.0);
}`;

/**
 * Matrix from a point of the old picture, (u, v, 1, inverse depth) with (0, 0) top left, to clip space
 * of the new one. Times its depth such a point is eye + direction(u, v) * depth: linear in all four,
 * and true for what is infinitely far away, too.
 *
 * @param {View} shown  that the picture was made for
 * @param {number} shownAspect  width over height
 * @param {View} view  wanted now
 * @param {number} aspect
 * @param {number} near  what is nearer to the new eye is cut off, metres
 * @returns {number[]} 16, column by column
 */
export function clipFromPicture(shown, shownAspect, view, aspect, near) {
    const from = axes(shown);
    const to = axes(view);
    const reach = Math.tan(shown.verticalFov / 2);
    const across = scale(from.right, 2 * reach * shownAspect);
    const down = scale(from.up, -2 * reach);
    const corner = sub(from.forward, scale(add(across, down), 0.5));
    const step = sub(shown.eye, view.eye);
    const newReach = Math.tan(view.verticalFov / 2);
    return [across, down, corner, step].flatMap((v, column) => {
        const w = dot(v, to.forward);
        const x = dot(v, to.right) / (newReach * aspect);
        const y = dot(v, to.up) / newReach;
        return [x, y, column === 3 ? w - 2 * near : w, w];
    });
}

/**
 * Corners of the triangles of a grid.
 *
 * @param {number} columns  points
 * @param {number} rows
 * @returns {Uint32Array}
 */
export function gridTriangles(columns, rows) {
    const indices = new Uint32Array(6 * (columns - 1) * (rows - 1));
    let next = 0;
    for (let row = 0; row + 1 < rows; ++row) {
        for (let column = 0; column + 1 < columns; ++column) {
            const a = row * columns + column;
            const b = a + columns;
            indices.set([a, b, a + 1, a + 1, b, b + 1], next);
            next += 6;
        }
    }
    return indices;
}

/** One canvas that shows warped pictures. Needs WebGL 2, and a GPU. */
export class DepthWarp {
    /** @type {WebGL2RenderingContext} */
    #gl;
    /** @type {WebGLProgram | null} */
    #program = null;
    #grid = '';
    #indices = 0;

    /**
     * @param {HTMLCanvasElement} canvas
     * @throws {Error} if the browser offers none
     */
    constructor(canvas) {
        this.canvas = canvas;
        // A processor would take the time that the next picture needs.
        const gl = canvas.getContext('webgl2', {antialias: false, failIfMajorPerformanceCaveat: true});
        if (!gl || noteDrawer(gl) === 'processor') {
            gl?.getExtension('WEBGL_lose_context')?.loseContext();
            throw new Error('This browser offers no WebGL 2 that a GPU draws.');
        }
        this.#gl = gl;
        canvas.addEventListener('webglcontextlost', (event) => event.preventDefault());
        canvas.addEventListener('webglcontextrestored', () => this.#prepare());
        this.#prepare();
    }

    /** Whether it can draw now: a context may get lost, and come back. */
    get usable() {
        return this.#program !== null && !this.#gl.isContextLost();
    }

    /**
     * Takes another picture with its depths.
     *
     * @param {TexImageSource} image
     * @param {Depths} depths
     */
    load(image, {columns, rows, inverse}) {
        const gl = this.#gl;
        gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, gl.RGBA, gl.UNSIGNED_BYTE, image);
        gl.bufferData(gl.ARRAY_BUFFER, inverse, gl.DYNAMIC_DRAW);
        const grid = `${columns} ${rows}`;
        if (grid !== this.#grid) {
            this.#grid = grid;
            const indices = gridTriangles(columns, rows);
            this.#indices = indices.length;
            gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
            gl.uniform2i(this.#uniform('points'), columns, rows);
        }
    }

    /**
     * Draws the picture as it looks in a view.
     *
     * @param {View} shown  that it was made for
     * @param {number} shownAspect
     * @param {View} view
     * @param {number} aspect
     * @param {number} nearest  of its depths, metres
     */
    draw(shown, shownAspect, view, aspect, nearest) {
        const gl = this.#gl;
        const {width, height} = this.canvas;
        gl.viewport(0, 0, width, height);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        const matrix = clipFromPicture(shown, shownAspect, view, aspect, NEAREST * nearest);
        gl.uniformMatrix4fv(this.#uniform('clipFromPicture'), false, matrix);
        gl.drawElements(gl.TRIANGLES, this.#indices, gl.UNSIGNED_INT, 0);
    }

    /** Waits until everything is drawn, so that a clock can tell what it takes. */
    finish() {
        const gl = this.#gl;
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    }

    #prepare() {
        const gl = this.#gl;
        this.#grid = '';
        this.#program = null;
        const program = gl.createProgram();
        const sources = {[gl.VERTEX_SHADER]: VERTEX_SHADER, [gl.FRAGMENT_SHADER]: FRAGMENT_SHADER};
        for (const [kind, source] of Object.entries(sources)) {
            const shader = gl.createShader(Number(kind));
            if (!shader) {
                return;
            }
            gl.shaderSource(shader, source);
            gl.compileShader(shader);
            gl.attachShader(program, shader);
        }
        gl.bindAttribLocation(program, 0, 'inverseDepth');
        gl.linkProgram(program);
        if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
            return;
        }
        this.#program = program;
        gl.useProgram(program);
        gl.enable(gl.DEPTH_TEST);
        gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
        const clamp = [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T];
        clamp.forEach((side) => gl.texParameteri(gl.TEXTURE_2D, side, gl.CLAMP_TO_EDGE));
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
        gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
        gl.enableVertexAttribArray(0);
        gl.vertexAttribPointer(0, 1, gl.FLOAT, false, 0, 0);
    }

    /** @param {string} name */
    #uniform(name) {
        return this.#program && this.#gl.getUniformLocation(this.#program, name);
    }
}
