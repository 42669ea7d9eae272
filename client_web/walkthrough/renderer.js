// SPDX-License-Identifier: Apache-2.0
// Draws a walkthrough with WebGL 2.

import {linkProgram} from './gl_program.js';
import {projectionOf, vectorOf} from './projection.js';
import {uploadAlbedos, uploadChunks, uploadSky, uploadTextures} from './scene_buffers.js';
import {MODES, SKY_VERTEX, SURFACE_VERTEX, skyFragment, surfaceFragment} from './shaders.js';

/**
 * @typedef {import('../net/protocol.js').View} View
 * @typedef {import('../net/protocol.js').Vec3} Vec3
 * @typedef {import('./scene_data.js').SceneData} SceneData
 * @typedef {import('./scene_buffers.js').DrawnChunk} DrawnChunk
 * @typedef {import('./gl_program.js').GlProgram} GlProgram
 * @typedef {ReturnType<typeof projectionOf>} Projection
 *
 * @typedef {object} Look  how radiance becomes a picture
 * @property {keyof typeof MODES} mode
 * @property {number} exposure  of photographs, EV
 * @property {number} maximum  of false colour, cd/m² or lx
 */

/** Input of the tone curve at an exposure of 0, of 1 cd/m²: mid-grey, as the server has it. */
const MID_GREY = 0.18;
const NO_SUN = {direction: /** @type {[number, number, number]} */ ([0, 1, 0]), cosine: 2, radiance: [0, 0, 0]};

export class Renderer {
    /** @type {Record<'oneSided' | 'twoSided' | 'glass', DrawnChunk[]>} */
    #chunks = {oneSided: [], twoSided: [], glass: []};

    /**
     * @param {WebGL2RenderingContext} gl
     * @param {SceneData} scene
     */
    constructor(gl, scene) {
        this.gl = gl;
        this.manifest = scene.manifest;
        const {min, max} = scene.manifest.bounds;
        this.bounds = {min: vectorOf(min), max: vectorOf(max)};
        this.surface = linkProgram(gl, SURFACE_VERTEX, surfaceFragment(scene.shaders));
        this.sky = linkProgram(gl, SKY_VERTEX, skyFragment(scene.shaders));
        this.textures = uploadTextures(gl, scene);
        this.albedos = uploadAlbedos(gl, scene);
        this.skyTexture = uploadSky(gl, scene);
        for (const drawn of uploadChunks(gl, scene)) {
            const clear = this.manifest.materials[drawn.chunk.material].transparency.some((share) => share > 0);
            this.#chunks[clear ? 'glass' : drawn.chunk.back === null ? 'oneSided' : 'twoSided'].push(drawn);
        }
        gl.enable(gl.DEPTH_TEST);
        gl.depthFunc(gl.LEQUAL);
    }

    /**
     * Draws into what is bound as the frame buffer.
     *
     * @param {View} view
     * @param {Look} look
     * @param {number} width  pixels
     * @param {number} height  pixels
     */
    draw(view, look, width, height) {
        const {gl} = this;
        const projection = projectionOf(view, width / height, this.bounds);
        gl.viewport(0, 0, width, height);
        gl.depthMask(true);
        gl.disable(gl.BLEND);
        const probed = look.mode === 'distance' || look.mode === 'normal';
        gl.clearColor(0, 0, 0, probed ? 0 : 1);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        this.#begin(this.surface, look);
        this.#setSurfaces(projection);
        this.#drawChunks(this.#chunks.twoSided);
        this.#drawOneSided();
        if (!probed) {
            this.#drawSky(projection, look);
        }
        if (look.mode === 'photo' && this.#chunks.glass.length > 0) {
            this.#drawGlass(look);
        }
    }

    /** Fronts, then the backs, which are black: where both meet at an edge the front is seen. */
    #drawOneSided() {
        const {gl} = this;
        gl.enable(gl.CULL_FACE);
        gl.cullFace(gl.BACK);
        this.#drawChunks(this.#chunks.oneSided);
        gl.cullFace(gl.FRONT);
        gl.enable(gl.POLYGON_OFFSET_FILL);
        gl.polygonOffset(1, 1);
        this.#drawChunks(this.#chunks.oneSided);
        gl.disable(gl.POLYGON_OFFSET_FILL);
        gl.disable(gl.CULL_FACE);
    }

    /**
     * What is behind glass times what passes, which sRGB's curve leaves about as it is; then fronts with what they reflect.
     *
     * @param {Look} look
     */
    #drawGlass(look) {
        const {gl} = this;
        gl.enable(gl.BLEND);
        gl.depthMask(false);
        this.#begin(this.surface, {...look, mode: 'glass'});
        gl.blendFunc(gl.ZERO, gl.SRC_COLOR);
        this.#drawChunks(this.#chunks.glass);
        this.#begin(this.surface, look);
        gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
        gl.enable(gl.CULL_FACE);
        gl.cullFace(gl.BACK);
        this.#drawChunks(this.#chunks.glass);
        gl.disable(gl.CULL_FACE);
        gl.depthMask(true);
        gl.disable(gl.BLEND);
    }

    /**
     * @param {GlProgram} program
     * @param {Look} look
     */
    #begin({program, at}, {mode, exposure, maximum}) {
        const {gl} = this;
        gl.useProgram(program);
        gl.uniform1i(at('mode'), MODES[mode]);
        gl.uniform1f(at('display_factor'), MID_GREY * 2 ** exposure);
        gl.uniform1f(at('scale_maximum'), maximum);
        gl.uniform1f(at('light_unit'), this.manifest.light.unit);
    }

    /**
     * @param {WebGLUniformLocation | null} at
     * @param {Vec3} v
     */
    #setVector(at, {x, y, z}) {
        this.gl.uniform3f(at, x, y, z);
    }

    /** @param {Projection} projection */
    #setSurfaces({clipFromWorld, eye}) {
        const {gl} = this;
        const {at} = this.surface;
        gl.uniformMatrix4fv(at('clip_from_world'), false, clipFromWorld);
        gl.uniform3fv(at('grid_origin'), this.manifest.grid.origin);
        gl.uniform3fv(at('grid_step'), this.manifest.grid.step);
        this.#setVector(at('eye'), eye);
        gl.uniform1i(at('base_texture'), 0);
        gl.uniform1i(at('albedo_table'), 1);
        gl.activeTexture(gl.TEXTURE1);
        gl.bindTexture(gl.TEXTURE_2D, this.albedos.texture);
        gl.activeTexture(gl.TEXTURE0);
    }

    /** @param {DrawnChunk[]} chunks */
    #drawChunks(chunks) {
        const {gl} = this;
        let material = -1;
        for (const {chunk, vertexArray} of chunks) {
            if (chunk.material !== material) {
                ({material} = chunk);
                this.#setMaterial(material);
            }
            gl.uniform3fv(this.surface.at('emission'), chunk.emission);
            gl.uniform1i(this.surface.at('two_sided'), Number(chunk.back !== null));
            gl.bindVertexArray(vertexArray);
            gl.drawElements(gl.TRIANGLES, chunk.indexCount, gl.UNSIGNED_SHORT, 0);
        }
        gl.bindVertexArray(null);
    }

    /** @param {number} index */
    #setMaterial(index) {
        const {gl} = this;
        const {at} = this.surface;
        const material = this.manifest.materials[index];
        gl.uniform3fv(at('base_colour'), material.baseColour);
        gl.uniform3fv(at('transmittance'), material.transmittance);
        gl.uniform3fv(at('transparency'), material.transparency);
        gl.uniform1f(at('alpha_cutoff'), material.alphaCutoff ?? 0);
        gl.uniform1i(at('albedo_row'), this.albedos.rows[index]);
        gl.uniform1i(at('unlit'), Number(material.unlit));
        gl.uniform1i(at('textured'), Number(material.texture !== null));
        gl.bindTexture(gl.TEXTURE_2D, material.texture === null ? null : this.textures[material.texture]);
    }

    /**
     * Behind all that has been drawn.
     *
     * @param {Projection} projection
     * @param {Look} look
     */
    #drawSky({forward, right, up}, look) {
        const {gl} = this;
        const {at} = this.sky;
        this.#begin(this.sky, look);
        this.#setVector(at('forward'), forward);
        this.#setVector(at('right'), right);
        this.#setVector(at('up'), up);
        const sun = this.manifest.sky.sun ?? NO_SUN;
        gl.uniform3fv(at('uniform_sky'), this.manifest.sky.uniform);
        gl.uniform3fv(at('sun_direction'), sun.direction);
        gl.uniform3fv(at('sun_radiance'), sun.radiance);
        gl.uniform1f(at('sun_cosine'), sun.cosine);
        gl.uniform1i(at('has_texels'), Number(this.skyTexture !== null));
        gl.uniform1i(at('sky_texels'), 0);
        gl.bindTexture(gl.TEXTURE_2D, this.skyTexture);
        gl.drawArrays(gl.TRIANGLES, 0, 3);
    }
}
