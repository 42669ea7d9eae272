// SPDX-License-Identifier: Apache-2.0
// The files of a walkthrough: scene.json, two binary ones, textures. Written by server/walkthrough; what they say is
// checked before it is used. Those of a running scene have no light, which comes apart, and objects that can be moved.

/**
 * @typedef {[number, number, number]} Triple
 *
 * @typedef {object} Chunk  triangles of one material; byte offsets of its arrays, null where there is none
 * @property {number} material
 * @property {number} vertexCount
 * @property {number} indexCount
 * @property {Triple} emission  cd/m²
 * @property {number} vertices  geometry, 12 bytes each
 * @property {number} indices  geometry, 2 bytes each
 * @property {number | null} uvs  geometry, 8 bytes each
 * @property {number | null} colours  geometry, 4 bytes each
 * @property {number} front  light, 4 bytes each
 * @property {number | null} back  light, 4 bytes each; null: backs are black
 * @property {number | null} emissions  light, 4 bytes each
 * @property {number} [object]  index, of a running scene
 * @property {number | null} [emissionAt]  light, 4 bytes: instead of `emission`
 *
 * @typedef {object} Material
 * @property {string} name
 * @property {Triple} baseColour
 * @property {number | null} texture
 * @property {number | null} alphaCutoff
 * @property {number | null} albedo  geometry: 32 texels of 16 bytes
 * @property {Triple} transmittance
 * @property {Triple} transparency  of glass: what passes straight on; 0: none
 * @property {boolean} unlit
 *
 * @typedef {object} Sun
 * @property {Triple} direction
 * @property {number} cosine
 * @property {Triple} radiance  cd/m²
 *
 * @typedef {{uniform: Triple, texels: number | null, width: number, height: number, sun: Sun | null}} SkyData
 *
 * @typedef {object} SceneManifest
 * @property {string} format
 * @property {number} version
 * @property {string} name
 * @property {{file: string, bytes: number}} geometry
 * @property {{file: string | null, bytes: number, unit: number}} light  unit: cd/m²; file null: it comes apart
 * @property {{origin: Triple, step: Triple}} grid  metres
 * @property {{min: Triple, max: Triple}} bounds
 * @property {{name: string, eye: Triple, target: Triple, up: Triple, verticalFov: number}[]} cameras
 * @property {SkyData} sky
 * @property {Material[]} materials
 * @property {{file: string, repeatU: boolean, repeatV: boolean}[]} textures
 * @property {Chunk[]} chunks
 * @property {{worldFromObject: number[]}[]} [objects]  of a running scene, as its vertices have them
 *
 * @typedef {object} SceneData
 * @property {SceneManifest} manifest
 * @property {ArrayBuffer} geometry
 * @property {ArrayBuffer} light
 * @property {ImageBitmap[]} textures
 * @property {{toneCurve: string, falseColour: string}} shaders  the server's own texts
 */

const FORMAT = 'raybundle-walkthrough';
const VERSION = 1;

/** Bytes of an albedo row: 32 texels of four floats. */
const ALBEDO_BYTES = 512;

/** A reason that is told to the user as it stands. */
export class SceneDataError extends Error {}

/**
 * @param {string} file
 * @param {AbortSignal} [signal]
 * @returns {Promise<Response>}
 */
async function get(file, signal) {
    let response;
    try {
        response = await fetch(file, {signal});
    } catch {
        throw new SceneDataError(`${file} could not be loaded: the server does not answer.`);
    }
    if (!response.ok) {
        throw new SceneDataError(`${file} could not be loaded: the server says ${response.status}.`);
    }
    return response;
}

/**
 * A binary file, with news of how much is there.
 *
 * @param {{file: string, bytes: number}} description
 * @param {(bytes: number) => void} arrived  so many more
 * @param {AbortSignal} signal
 * @returns {Promise<ArrayBuffer>}
 */
async function getBinary({file, bytes}, arrived, signal) {
    const {body} = await get(file, signal);
    const whole = new Uint8Array(bytes);
    let at = 0;
    const reader = body?.getReader();
    for (let part = await reader?.read(); part && !part.done; part = await reader?.read()) {
        if (at + part.value.length > bytes) {
            throw new SceneDataError(`${file} is longer than scene.json says.`);
        }
        whole.set(part.value, at);
        at += part.value.length;
        arrived(part.value.length);
    }
    if (at !== bytes) {
        throw new SceneDataError(`${file} is shorter than scene.json says.`);
    }
    return whole.buffer;
}

/**
 * Reasons why a manifest cannot be drawn.
 *
 * @param {SceneManifest} manifest
 * @returns {string} empty: none
 */
export function problemOf(manifest) {
    if (manifest?.format !== FORMAT) {
        return 'it describes no walkthrough';
    }
    if (manifest.version !== VERSION) {
        return `it has version ${manifest.version}, and this page draws version ${VERSION}`;
    }
    const {geometry, light, materials, textures, chunks, sky, objects = [{}]} = manifest;
    const fits = (/** @type {number | null} */ at, /** @type {number} */ size, /** @type {{bytes: number}} */ file) =>
        at === null || (Number.isInteger(at) && at >= 0 && at % 4 === 0 && at + size <= file.bytes);
    const chunkFits = (/** @type {Chunk} */ c) =>
        materials[c.material] !== undefined && c.vertexCount <= 65535 &&
        fits(c.vertices, 12 * c.vertexCount, geometry) && fits(c.indices, 2 * c.indexCount, geometry) &&
        fits(c.uvs, 8 * c.vertexCount, geometry) && fits(c.colours, 4 * c.vertexCount, geometry) &&
        [c.front, c.back, c.emissions].every((at) => fits(at, 4 * c.vertexCount, light)) &&
        fits(c.emissionAt ?? null, 4, light) && objects[c.object ?? 0] !== undefined;
    const bad = chunks.findIndex((chunk) => !chunkFits(chunk));
    if (bad >= 0) {
        return `chunks[${bad}] lies outside of its file`;
    }
    if (!materials.every(({texture, albedo}) =>
        (texture === null || textures[texture]) && fits(albedo, ALBEDO_BYTES, geometry))) {
        return 'a material lies outside of its file';
    }
    return fits(sky.texels, 4 * sky.width * sky.height, light) ? '' : 'the sky lies outside of its file';
}

/**
 * @param {string} file
 * @param {AbortSignal} signal
 * @returns {Promise<ImageBitmap>}
 */
async function getTexture(file, signal) {
    const blob = await (await get(file, signal)).blob();
    return createImageBitmap(blob, {premultiplyAlpha: 'none', colorSpaceConversion: 'none'});
}

/**
 * Loads all that is drawn. Throws SceneDataError.
 *
 * @param {(share: number) => void} progress  of the binary files
 * @param {string} folder  with a slash at its end; empty: beside the page
 * @returns {Promise<SceneData>}
 */
export async function loadScene(progress, folder = '') {
    const response = await get(`${folder}scene.json`);
    /** @type {SceneManifest} */
    const manifest = await response.json().catch(() => null);
    const problem = problemOf(manifest);
    if (problem) {
        throw new SceneDataError(`scene.json cannot be drawn: ${problem}.`);
    }
    let there = 0;
    const {file, bytes} = manifest.light;
    const all = manifest.geometry.bytes + (file === null ? 0 : bytes);
    // Where one of them fails, the others stop and say nothing more.
    const stop = new AbortController();
    const {signal} = stop;
    const arrived = (/** @type {number} */ more) => {
        there += more;
        if (!signal.aborted) {
            progress(there / all);
        }
    };
    const text = async (/** @type {string} */ name) => (await get(`${folder}shaders/${name}.glsl`, signal)).text();
    const binary = (/** @type {{file: string, bytes: number}} */ part) =>
        getBinary({file: folder + part.file, bytes: part.bytes}, arrived, signal);
    try {
        const [geometry, light, textures, toneCurve, falseColour] = await Promise.all([
            binary(manifest.geometry),
            file === null ? new ArrayBuffer(bytes) : binary({file, bytes}),
            Promise.all(manifest.textures.map((texture) => getTexture(folder + texture.file, signal))),
            text('tone_curve'),
            text('false_colour'),
        ]);
        return {manifest, geometry, light, textures, shaders: {toneCurve, falseColour}};
    } finally {
        stop.abort();
    }
}
