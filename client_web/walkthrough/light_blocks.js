// SPDX-License-Identifier: Apache-2.0
// Blocks of light as the server sends them (server/walkthrough/live/light_block_code.h). What comes is checked before it
// is used.

/** @typedef {{first: number, words: Uint32Array}} LightBlock  values from `first` on, RGB9_E5 */

/** Sizes of what a value is made of: three mantissas, and the exponent. */
const SIZES = [512, 512, 512, 32];
const EXPONENT = 3;

/**
 * @param {Uint8Array<ArrayBuffer>} bytes  a zlib stream
 * @returns {Promise<Uint8Array>}
 */
async function inflate(bytes) {
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
    return new Uint8Array(await new Response(stream).arrayBuffer());
}

/**
 * Values of a block: four planes of a byte for each, of differences from the value before.
 *
 * @param {Uint8Array} planes
 * @param {number} count
 * @returns {Uint32Array}
 */
export function blockValues(planes, count) {
    if (planes.length !== 4 * count) {
        throw new Error(`light: a block of ${planes.length} bytes instead of ${4 * count}`);
    }
    const words = new Uint32Array(count);
    const parts = [0, 0, 0, 0];
    for (let i = 0; i < count; ++i) {
        const flags = planes[i];
        for (let k = 0; k < 4; ++k) {
            const number = k === EXPONENT ? flags >> 3 : (((flags >> k) & 1) << 8) | planes[(k + 1) * count + i];
            const step = number & 1 ? -((number + 1) >> 1) : number >> 1;
            parts[k] = (parts[k] + step + SIZES[k]) % SIZES[k];
        }
        words[i] = (parts[0] | (parts[1] << 9) | (parts[2] << 18) | (parts[EXPONENT] << 27)) >>> 0;
    }
    return words;
}

/**
 * Takes a message apart: number of blocks, and for each its index, the length of its code and the code.
 *
 * @param {Uint8Array<ArrayBuffer>} body
 * @param {{values: number, blockValues: number}} scene
 * @returns {Promise<LightBlock[]>}  rejects where it is no such message
 */
export async function readBlocks(body, {values, blockValues: size}) {
    const view = new DataView(body.buffer, body.byteOffset, body.byteLength);
    const word = (/** @type {number} */ at) => {
        if (at + 4 > body.length) {
            throw new Error('light: the message is too short');
        }
        return view.getUint32(at, true);
    };
    const coded = [];
    let at = 4;
    for (let i = word(0); i > 0; --i) {
        const [block, length] = [word(at), word(at + 4)];
        const first = block * size;
        if (first >= values || at + 8 + length > body.length) {
            throw new Error(`light: block ${block} does not fit`);
        }
        coded.push({first, count: Math.min(size, values - first), code: body.slice(at + 8, at + 8 + length)});
        at += 8 + length;
    }
    return Promise.all(coded.map(async ({first, count, code}) => ({first, words: blockValues(await inflate(code), count)})));
}
