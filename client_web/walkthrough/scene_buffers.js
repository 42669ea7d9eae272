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
 */

/**
 * @param {WebGL2RenderingContext} gl
 * @param {number} target
 * @param {ArrayBuffer} file
 * @param {number} at
 * @param {number} bytes
 */
function bufferOf(gl, target, file, at, bytes) {
    gl.bindBuffer(target, gl.createBuffer());
    gl.bufferData(target, new Uint8Array(file, at, bytes), gl.STATIC_DRAW);
}

/**
 * @param {WebGL2RenderingContext} gl
 * @param {SceneData} scene
 * @param {Chunk} chunk
 * @returns {DrawnChunk}
 */
function upload(gl, {geometry, light}, chunk) {
    const count = chunk.vertexCount;
    const vertexArray = gl.createVertexArray();
    gl.bindVertexArray(vertexArray);
    bufferOf(gl, gl.ELEMENT_ARRAY_BUFFER, geometry, chunk.indices, 2 * chunk.indexCount);
    const integers = (/** @type {number} */ place, /** @type {ArrayBuffer} */ file, /** @type {number} */ at, /** @type {number} */ words) => {
        bufferOf(gl, gl.ARRAY_BUFFER, file, at, 4 * words * count);
        gl.enableVertexAttribArray(place);
        gl.vertexAttribIPointer(place, words, gl.UNSIGNED_INT, 0, 0);
    };
    integers(ATTRIBUTES.vertex, geometry, chunk.vertices, 3);
    for (const name of /** @type {const} */ (['front', 'back'])) {
        const at = chunk[name];
        if (at !== null) {
            integers(ATTRIBUTES[name], light, at, 1);
        }
    }
    if (chunk.emissions !== null) {
        integers(ATTRIBUTES.emission, light, chunk.emissions, 1);
    }
    if (chunk.uvs !== null) {
        bufferOf(gl, gl.ARRAY_BUFFER, geometry, chunk.uvs, 8 * count);
        gl.enableVertexAttribArray(ATTRIBUTES.uv);
        gl.vertexAttribPointer(ATTRIBUTES.uv, 2, gl.FLOAT, false, 0, 0);
    }
    if (chunk.colours !== null) {
        bufferOf(gl, gl.ARRAY_BUFFER, geometry, chunk.colours, 4 * count);
        gl.enableVertexAttribArray(ATTRIBUTES.colour);
        gl.vertexAttribPointer(ATTRIBUTES.colour, 4, gl.UNSIGNED_BYTE, true, 0, 0);
    }
    gl.bindVertexArray(null);
    return {chunk, vertexArray};
}

/**
 * @param {WebGL2RenderingContext} gl
 * @param {SceneData} scene
 * @returns {DrawnChunk[]}
 */
export function uploadChunks(gl, scene) {
    // What an array that is absent stands for.
    for (const name of /** @type {const} */ (['front', 'back', 'emission'])) {
        gl.vertexAttribI4ui(ATTRIBUTES[name], 0, 0, 0, 0);
    }
    gl.vertexAttrib4f(ATTRIBUTES.colour, 1, 1, 1, 1);
    return scene.manifest.chunks.map((chunk) => upload(gl, scene, chunk));
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
 * A row of texels for each material whose albedo follows the angle.
 *
 * @param {WebGL2RenderingContext} gl
 * @param {SceneData} scene
 * @returns {{texture: WebGLTexture, rows: number[]}}  rows: of materials, -1: none
 */
export function uploadAlbedos(gl, {manifest, geometry}) {
    const places = manifest.materials.map(({albedo}) => albedo).filter((at) => at !== null);
    const texels = new Float32Array(4 * ALBEDO_NODES * Math.max(places.length, 1));
    places.forEach((at, i) => texels.set(new Float32Array(geometry, at, 4 * ALBEDO_NODES), 4 * ALBEDO_NODES * i));
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    const rows = Math.max(places.length, 1);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, ALBEDO_NODES, rows, 0, gl.RGBA, gl.FLOAT, texels);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    let next = 0;
    return {texture, rows: manifest.materials.map(({albedo}) => (albedo === null ? -1 : next++))};
}

/**
 * @param {WebGL2RenderingContext} gl
 * @param {SceneData} scene
 * @returns {WebGLTexture | null}  null: the sky is uniform
 */
export function uploadSky(gl, {manifest, light}) {
    const {texels, width, height} = manifest.sky;
    if (texels === null) {
        return null;
    }
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    const words = new Uint32Array(light, texels, width * height);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB9_E5, width, height, 0, gl.RGB, gl.UNSIGNED_INT_5_9_9_9_REV, words);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
    return texture;
}
