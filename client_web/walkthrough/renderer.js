// SPDX-License-Identifier: Apache-2.0
// Draws a walkthrough with WebGL 2.

import {linkProgram} from './gl_program.js';
import {projectionOf, vectorOf} from './projection.js';
import {IDENTITY, dot, sub} from '../ui/vector.js';
import {skyTexture, uploadAlbedos, uploadChunks, uploadSky, uploadTextures} from './scene_buffers.js';
import {
    ALBEDO_NODES, MODES, PLATE_VERTEX, SKY_VERTEX, SURFACE_VERTEX, plateFragment, skyFragment, surfaceFragment,
} from './shaders.js';

/**
 * @typedef {import('../net/scene_types.js').View} View
 * @typedef {import('../net/scene_types.js').Vec3} Vec3
 * @typedef {import('./scene_data.js').SceneData} SceneData
 * @typedef {import('./scene_buffers.js').DrawnChunk} DrawnChunk
 * @typedef {import('./gl_program.js').GlProgram} GlProgram
 * @typedef {import('../drawing/luminaire_plates.js').Plate} Plate
 * @typedef {ReturnType<typeof projectionOf>} Projection
 *
 * @typedef {object} Look  how radiance becomes a picture
 * @property {keyof typeof MODES} mode
 * @property {number} exposure  of photographs, EV
 * @property {number} maximum  of false colour, cd/m² or lx
 * @property {boolean} [linear]  false colour begins at 0
 */

/** Input of the tone curve at an exposure of 0, of 1 cd/m²: mid-grey, as the server has it. */
const MID_GREY = 0.18;
/** Decades of a logarithmic scale, as the server has it. */
const SCALE_BEGIN = 1e-3;
const NO_SUN = {direction: /** @type {[number, number, number]} */ ([0, 1, 0]), cosine: 2, radiance: [0, 0, 0]};

/**
 * @param {number} word
 * @param {number} unit  cd/m²
 * @returns {[number, number, number]}
 */
export function fromRgb9e5(word, unit) {
    const step = unit * 2 ** ((word >>> 27) - 24);
    return [step * (word & 511), step * ((word >>> 9) & 511), step * ((word >>> 18) & 511)];
}

/** Of the part that turns and scales. @param {ArrayLike<number>} m  4x4, column by column */
const determinant = (m) =>
    m[0] * (m[5] * m[10] - m[6] * m[9]) - m[4] * (m[1] * m[10] - m[2] * m[9]) + m[8] * (m[1] * m[6] - m[2] * m[5]);

export class Renderer {
    /** @type {Record<'oneSided' | 'twoSided' | 'glass', DrawnChunk[]>} */
    #chunks = {oneSided: [], twoSided: [], glass: []};
    /** Chunks whose emission comes with the light, by its place there. @type {Map<number, DrawnChunk>} */
    #lamps = new Map();
    /** Where objects have gone. @type {{matrix: Float32Array, mirrored: boolean}[]} */
    #places;
    /** Objects that are not drawn, by index. @type {Set<number>} */
    hidden = new Set();
    /** Of luminaires. @type {Plate[]} */
    plates = [];
    /** Once there are any. @type {GlProgram | null} */
    #plate = null;

    /**
     * @param {WebGL2RenderingContext} gl
     * @param {SceneData} scene
     */
    constructor(gl, scene) {
        this.gl = gl;
        this.manifest = scene.manifest;
        this.shaders = scene.shaders;
        const {min, max} = scene.manifest.bounds;
        this.bounds = {min: vectorOf(min), max: vectorOf(max)};
        this.surface = linkProgram(gl, SURFACE_VERTEX, surfaceFragment(scene.shaders));
        this.sky = linkProgram(gl, SKY_VERTEX, skyFragment(scene.shaders));
        this.textures = uploadTextures(gl, scene);
        this.albedos = uploadAlbedos(gl, scene);
        this.skyTexture = uploadSky(gl, scene);
        this.background = scene.manifest.sky;
        /** Of the sky's texels, cd/m². */
        this.skyUnit = scene.manifest.light.unit;
        this.#places = (scene.manifest.objects ?? [{}]).map(() => ({matrix: new Float32Array(IDENTITY), mirrored: false}));
        const {chunks, light} = uploadChunks(gl, scene);
        this.light = light;
        for (const drawn of chunks) {
            const clear = this.manifest.materials[drawn.chunk.material].transparency.some((share) => share > 0);
            this.#chunks[clear ? 'glass' : drawn.chunk.back === null ? 'oneSided' : 'twoSided'].push(drawn);
            const at = drawn.chunk.emissionAt ?? null;
            if (at !== null) {
                this.#lamps.set(at / 4, drawn);
            }
        }
        gl.enable(gl.DEPTH_TEST);
        gl.depthFunc(gl.LEQUAL);
    }

    /** Lets go of all that it has on the GPU; nothing can be drawn afterwards. */
    dispose() {
        const {gl} = this;
        for (const {vertexArray, buffers} of Object.values(this.#chunks).flat()) {
            gl.deleteVertexArray(vertexArray);
            buffers.forEach((buffer) => gl.deleteBuffer(buffer));
        }
        this.#chunks = {oneSided: [], twoSided: [], glass: []};
        this.#lamps.clear();
        gl.deleteBuffer(this.light);
        [...this.textures, this.albedos.texture, this.skyTexture].forEach((texture) => gl.deleteTexture(texture));
        gl.deleteProgram(this.surface.program);
        gl.deleteProgram(this.sky.program);
        if (this.#plate) {
            gl.deleteProgram(this.#plate.program);
            this.#plate = null;
        }
    }

    /**
     * Takes in light that has come.
     *
     * @param {number} first  of the values
     * @param {Uint32Array} words  RGB9_E5
     */
    setLight(first, words) {
        const {gl} = this;
        gl.bindVertexArray(null);
        gl.bindBuffer(gl.ARRAY_BUFFER, this.light);
        gl.bufferSubData(gl.ARRAY_BUFFER, 4 * first, words);
        for (let i = 0; i < words.length; ++i) {
            const lamp = this.#lamps.get(first + i);
            if (lamp) {
                lamp.chunk.emission = fromRgb9e5(words[i], this.manifest.light.unit);
            }
        }
    }

    /**
     * Places an object.
     *
     * @param {number} object  index
     * @param {Float32Array} matrix  from where its vertices are to where it is
     */
    setPlace(object, matrix) {
        if (this.#places[object]) {
            this.#places[object] = {matrix, mirrored: determinant(matrix) < 0};
        }
    }

    /**
     * A material is another one.
     *
     * @param {number} index
     * @param {{baseColour: Vec3, albedo?: number[], transparency: Vec3, transmittance: Vec3}} look
     */
    setMaterial(index, {baseColour, albedo, transparency, transmittance}) {
        const {gl} = this;
        const material = this.manifest.materials[index];
        if (!material) {
            return;
        }
        const triple = (/** @type {Vec3} */ {x, y, z}) => /** @type {[number, number, number]} */ ([x, y, z]);
        Object.assign(material, {
            baseColour: triple(baseColour),
            transparency: triple(transparency),
            transmittance: triple(transmittance),
        });
        const follows = albedo?.length === 4 * ALBEDO_NODES;
        this.albedos.rows[index] = follows ? index : -1;
        if (follows) {
            gl.bindTexture(gl.TEXTURE_2D, this.albedos.texture);
            gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, index, ALBEDO_NODES, 1, gl.RGBA, gl.FLOAT, new Float32Array(albedo));
        }
    }

    /**
     * What is behind all is another one.
     *
     * @param {import('./scene_data.js').SkyData} sky
     * @param {number} unit  of the texels, cd/m²
     * @param {Uint32Array | null} texels
     */
    setSky(sky, unit, texels) {
        this.gl.deleteTexture(this.skyTexture);
        this.skyTexture = texels && skyTexture(this.gl, texels, sky.width, sky.height);
        this.background = sky;
        this.skyUnit = unit;
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
            this.#drawPlates(projection, look);
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
    #begin({program, at}, {mode, exposure, maximum, linear = false}) {
        const {gl} = this;
        gl.useProgram(program);
        gl.uniform1i(at('mode'), MODES[mode]);
        gl.uniform1f(at('display_factor'), MID_GREY * 2 ** exposure);
        gl.uniform1f(at('scale_maximum'), maximum);
        gl.uniform1f(at('scale_begin'), linear ? 0 : SCALE_BEGIN * maximum);
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
        let [material, object] = [-1, -1];
        for (const {chunk, vertexArray} of chunks) {
            const own = chunk.object ?? 0;
            if (this.hidden.has(own)) {
                continue;
            }
            if (own !== object) {
                object = own;
                const {matrix, mirrored} = this.#places[own];
                gl.uniformMatrix4fv(this.surface.at('world_from_start'), false, matrix);
                gl.frontFace(mirrored ? gl.CW : gl.CCW);
            }
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
        gl.frontFace(gl.CCW);
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
     * What shines of luminaires, black from behind; those in the plane of a ceiling are seen.
     *
     * @param {Projection} projection
     * @param {Look} look
     */
    #drawPlates({clipFromWorld, eye}, look) {
        if (this.plates.length === 0) {
            return;
        }
        const {gl} = this;
        this.#plate ??= linkProgram(gl, PLATE_VERTEX, plateFragment(this.shaders));
        const {at} = this.#plate;
        this.#begin(this.#plate, look);
        gl.uniformMatrix4fv(at('clip_from_world'), false, clipFromWorld);
        gl.enable(gl.POLYGON_OFFSET_FILL);
        gl.polygonOffset(-1, -1);
        for (const {middle, halfX, halfY, aim, round, radiance} of this.plates) {
            this.#setVector(at('middle'), middle);
            this.#setVector(at('half_x'), halfX);
            this.#setVector(at('half_y'), halfY);
            gl.uniform1i(at('is_round'), Number(round));
            gl.uniform3fv(at('radiance'), dot(sub(eye, middle), aim) > 0 ? radiance : [0, 0, 0]);
            gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
        }
        gl.disable(gl.POLYGON_OFFSET_FILL);
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
        const sun = this.background.sun ?? NO_SUN;
        gl.uniform1f(at('light_unit'), this.skyUnit);
        gl.uniform3fv(at('uniform_sky'), this.background.uniform);
        gl.uniform3fv(at('sun_direction'), sun.direction);
        gl.uniform3fv(at('sun_radiance'), sun.radiance);
        gl.uniform1f(at('sun_cosine'), sun.cosine);
        gl.uniform1i(at('has_texels'), Number(this.skyTexture !== null));
        gl.uniform1i(at('sky_texels'), 0);
        gl.bindTexture(gl.TEXTURE_2D, this.skyTexture);
        gl.drawArrays(gl.TRIANGLES, 0, 3);
    }
}
