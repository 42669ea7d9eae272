// SPDX-License-Identifier: Apache-2.0
// Depths that come with a frame: taken apart as protocol/README.md, "Depths", describes them.

/**
 * @typedef {import('../net/protocol.js').FrameHeader} FrameHeader
 * @typedef {object} Depths
 * @property {number} columns  points of the grid, from corner to corner of the picture
 * @property {number} rows
 * @property {Float32Array} inverse  1/m along the line of sight, row by row from the top; 0: nothing
 * @property {number} nearest  metres; 0: there is nothing
 */

/** More points than this are not ours. */
const MAX_POINTS = 512 * 1024;
const STEPS = 65535;

/**
 * Undoes zlib's compression, up to a size.
 *
 * @param {Uint8Array<ArrayBuffer>} bytes
 * @param {number} size  of what comes out
 * @returns {Promise<Uint8Array>}
 * @throws {Error} if it is damaged, or of another size
 */
async function inflate(bytes, size) {
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
    const reader = stream.getReader();
    const result = new Uint8Array(size);
    let length = 0;
    for (;;) {
        const {done, value} = await reader.read();
        if (done) {
            break;
        }
        if (length + value.length > size) {
            reader.cancel().catch(() => {});
            throw new Error('depths: more than their grid has points');
        }
        result.set(value, length);
        length += value.length;
    }
    if (length !== size) {
        throw new Error('depths: fewer than their grid has points');
    }
    return result;
}

/**
 * Values from their differences to what a plane through three neighbours predicts.
 *
 * @param {Uint8Array} bytes  all low bytes, then all high ones
 * @param {number} columns
 * @returns {Uint16Array}
 */
function fromDifferences(bytes, columns) {
    const values = new Uint16Array(bytes.length / 2);
    for (let i = 0; i < values.length; ++i) {
        const zigzag = bytes[i] | (bytes[values.length + i] << 8);
        const difference = (zigzag >>> 1) ^ -(zigzag & 1);
        const first = i % columns === 0;
        const left = first ? 0 : values[i - 1];
        const above = i < columns ? 0 : values[i - columns];
        const corner = first || i < columns ? 0 : values[i - columns - 1];
        values[i] = left + above - corner + difference;
    }
    return values;
}

/**
 * Depths of a frame.
 *
 * @param {FrameHeader} header
 * @param {Uint8Array<ArrayBuffer>} bytes  as they came
 * @returns {Promise<Depths>}
 * @throws {Error} if they are damaged
 */
export async function decodeDepths(header, bytes) {
    const {depthColumns: columns = 0, depthRows: rows = 0, depthNearest: nearest = 0} = header;
    const points = columns * rows;
    if (!(columns >= 2 && rows >= 2 && points <= MAX_POINTS && nearest >= 0)) {
        throw new Error(`depths: a grid of ${columns} × ${rows} points`);
    }
    const values = fromDifferences(await inflate(bytes, 2 * points), columns);
    const unit = nearest > 0 ? 1 / (STEPS * nearest) : 0;
    return {columns, rows, inverse: Float32Array.from(values, (value) => value * unit), nearest};
}
