// SPDX-License-Identifier: Apache-2.0
// A scene in the GPU's memory.

import {ALBEDO_NODES, ATTRIBUTES} from './shaders.js';

/**
 * @typedef {import('./scene_data.js').SceneData} SceneData
 * @typedef {import('./scene_data.js').Chunk} Chunk
 *
 * @typedef {object} DrawnChunk
 * @property {Chunk} chunk
 * @property {WebGLVertexArrayObject} vertexArray
 * @property {WebGLBuffer[]} buffers  of its own
 */

/**
 * @param {WebGL2RenderingContext} gl
 * @param {number} target
 * @param {ArrayBuffer} file
 * @param {number} at
 * @param {number} bytes
 * @returns {WebGLBuffer}  bound
 */
function bufferOf(gl, target, file, at, bytes) {
    const buffer = gl.createBuffer();
    gl.bindBuffer(target, buffer);
    gl.bufferData(target, new Uint8Array(file, at, bytes), gl.STATIC_DRAW);
    return buffer;
}

/**
 * @param {WebGL2RenderingContext} gl
 * @param {SceneData} scene
 * @param {WebGLBuffer} light  all of it
 * @param {Chunk} chunk
 * @returns {DrawnChunk}
 */
function upload(gl, {geometry}, light, chunk) {
    const count = chunk.vertexCount;
    const vertexArray = gl.createVertexArray();
    gl.bindVertexArray(vertexArray);
    const buffers = [
        bufferOf(gl, gl.ELEMENT_ARRAY_BUFFER, geometry, chunk.indices, 2 * chunk.indexCount),
        bufferOf(gl, gl.ARRAY_BUFFER, geometry, chunk.vertices, 12 * count),
    ];
    gl.enableVertexAttribArray(ATTRIBUTES.vertex);
    gl.vertexAttribIPointer(ATTRIBUTES.vertex, 3, gl.UNSIGNED_INT, 0, 0);
    const places = {front: chunk.front, back: chunk.back, emission: chunk.emissions};
    for (const name of /** @type {const} */ (['front', 'back', 'emission'])) {
        const at = places[name];
        if (at !== null) {
            gl.bindBuffer(gl.ARRAY_BUFFER, light);
            gl.enableVertexAttribArray(ATTRIBUTES[name]);
            gl.vertexAttribIPointer(ATTRIBUTES[name], 1, gl.UNSIGNED_INT, 0, at);
        }
    }
    if (chunk.uvs !== null) {
        buffers.push(bufferOf(gl, gl.ARRAY_BUFFER, geometry, chunk.uvs, 8 * count));
        gl.enableVertexAttribArray(ATTRIBUTES.uv);
        gl.vertexAttribPointer(ATTRIBUTES.uv, 2, gl.FLOAT, false, 0, 0);
    }
    if (chunk.colours !== null) {
        buffers.push(bufferOf(gl, gl.ARRAY_BUFFER, geometry, chunk.colours, 4 * count));
        gl.enableVertexAttribArray(ATTRIBUTES.colour);
        gl.vertexAttribPointer(ATTRIBUTES.colour, 4, gl.UNSIGNED_BYTE, true, 0, 0);
    }
    gl.bindVertexArray(null);
    return {chunk, vertexArray, buffers};
}

/**
 * @param {WebGL2RenderingContext} gl
 * @param {SceneData} scene
 * @returns {{chunks: DrawnChunk[], light: WebGLBuffer}}
 */
export function uploadChunks(gl, scene) {
    // What an array that is absent stands for.
    for (const name of /** @type {const} */ (['front', 'back', 'emission'])) {
        gl.vertexAttribI4ui(ATTRIBUTES[name], 0, 0, 0, 0);
    }
    gl.vertexAttrib4f(ATTRIBUTES.colour, 1, 1, 1, 1);
    const light = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, light);
    gl.bufferData(gl.ARRAY_BUFFER, scene.light, gl.DYNAMIC_DRAW);
    return {chunks: scene.manifest.chunks.map((chunk) => upload(gl, scene, light, chunk)), light};
}

/**
 * Textures of colours, with levels.
 *
 * @param {WebGL2RenderingContext} gl
 * @param {SceneData} scene
 * @returns {WebGLTexture[]}
 */
export function uploadTextures(gl, {manifest, textures}) {
    const filter = gl.getExtension('EXT_texture_filter_anisotropic');
    return textures.map((image, i) => {
        const texture = gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D, texture);
        gl.texImage2D(gl.TEXTURE_2D, 0, gl.SRGB8_ALPHA8, gl.RGBA, gl.UNSIGNED_BYTE, image);
        gl.generateMipmap(gl.TEXTURE_2D);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
        const {repeatU, repeatV} = manifest.textures[i];
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, repeatU ? gl.REPEAT : gl.CLAMP_TO_EDGE);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, repeatV ? gl.REPEAT : gl.CLAMP_TO_EDGE);
        if (filter) {
            gl.texParameterf(gl.TEXTURE_2D, filter.TEXTURE_MAX_ANISOTROPY_EXT, 8);
        }
        image.close();
        return texture;
    });
}

/**
 * A row of texels for each material, whose albedo may follow the angle.
 *
 * @param {WebGL2RenderingContext} gl
 * @param {SceneData} scene
 * @returns {{texture: WebGLTexture, rows: number[]}}  rows: of materials, -1: it does not
 */
export function uploadAlbedos(gl, {manifest, geometry}) {
    const places = manifest.materials.map(({albedo}) => albedo);
    const texels = new Float32Array(4 * ALBEDO_NODES * Math.max(places.length, 1));
    places.forEach((at, i) => {
        if (at !== null) {
            texels.set(new Float32Array(geometry, at, 4 * ALBEDO_NODES), 4 * ALBEDO_NODES * i);
        }
    });
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    const rows = Math.max(places.length, 1);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, ALBEDO_NODES, rows, 0, gl.RGBA, gl.FLOAT, texels);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    return {texture, rows: places.map((at, i) => (at === null ? -1 : i))};
}

/**
 * @param {WebGL2RenderingContext} gl
 * @param {SceneData} scene
 * @returns {WebGLTexture | null}  null: the sky is uniform
 */
export function uploadSky(gl, {manifest, light}) {
    const {texels, width, height} = manifest.sky;
    return texels === null ? null : skyTexture(gl, new Uint32Array(light, texels, width * height), width, height);
}

/**
 * @param {WebGL2RenderingContext} gl
 * @param {Uint32Array} words
 * @param {number} width
 * @param {number} height
 */
export function skyTexture(gl, words, width, height) {
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB9_E5, width, height, 0, gl.RGB, gl.UNSIGNED_INT_5_9_9_9_REV, words);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
    return texture;
}
