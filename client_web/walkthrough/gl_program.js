// SPDX-License-Identifier: Apache-2.0

/**
 * A linked program and the places of its uniforms.
 *
 * @typedef {{program: WebGLProgram, at: (name: string) => WebGLUniformLocation | null}} GlProgram
 */

/**
 * @param {WebGL2RenderingContext} gl
 * @param {number} type
 * @param {string} text
 */
function compile(gl, type, text) {
    const shader = gl.createShader(type);
    if (!shader) {
        throw new Error('WebGL has been lost');
    }
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    return shader;
}

/**
 * Throws with the compiler's words where it refuses.
 *
 * @param {WebGL2RenderingContext} gl
 * @param {string} vertex
 * @param {string} fragment
 * @returns {GlProgram}
 */
export function linkProgram(gl, vertex, fragment) {
    const program = gl.createProgram();
    const shaders = [compile(gl, gl.VERTEX_SHADER, vertex), compile(gl, gl.FRAGMENT_SHADER, fragment)];
    for (const shader of shaders) {
        gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
        const words = [...shaders.map((shader) => gl.getShaderInfoLog(shader)), gl.getProgramInfoLog(program)];
        throw new Error(`shaders cannot be used: ${words.join(' ')}`);
    }
    shaders.forEach((shader) => gl.deleteShader(shader));  // it goes with the program
    /** @type {Map<string, WebGLUniformLocation | null>} */
    const places = new Map();
    const at = (/** @type {string} */ name) => {
        let place = places.get(name);
        if (place === undefined) {
            place = gl.getUniformLocation(program, name);
            places.set(name, place);
        }
        return place;
    };
    return {program, at};
}
