// SPDX-License-Identifier: Apache-2.0
// Reads what `raybundle render -o picture.exr` writes: scan lines of floats, zip-compressed.

import {readFile} from 'node:fs/promises';
import {inflateSync} from 'node:zlib';

const ZIP = 3;
const ROWS_OF_A_BLOCK = 16;

/** @param {Buffer} bytes */
function readHeader(bytes) {
    /** @type {Map<string, Buffer>} */
    const attributes = new Map();
    let at = 8;
    const text = () => {
        const end = bytes.indexOf(0, at);
        const result = bytes.toString('latin1', at, end);
        at = end + 1;
        return result;
    };
    for (let name = text(); name; name = text()) {
        text();
        const size = bytes.readInt32LE(at);
        attributes.set(name, bytes.subarray(at + 4, at + 4 + size));
        at += 4 + size;
    }
    return {attributes, end: at};
}

/** Undoes the predictor and the interleaving of OpenEXR's zip compression. @param {Buffer} packed */
function unzip(packed, size) {
    if (packed.length === size) {
        return packed;
    }
    const bytes = inflateSync(packed);
    for (let i = 1; i < bytes.length; ++i) {
        bytes[i] = (bytes[i - 1] + bytes[i] - 128) & 255;
    }
    const half = Math.ceil(bytes.length / 2);
    return Buffer.from(bytes.map((_, i) => bytes[i % 2 ? half + (i - 1) / 2 : i / 2]));
}

/**
 * @param {string} file
 * @returns {Promise<{width: number, height: number, rgb: Float32Array}>} row 0 at the top
 */
export async function readExr(file) {
    const bytes = await readFile(file);
    const {attributes, end} = readHeader(bytes);
    const [x0, y0, x1, y1] = [0, 4, 8, 12].map((i) => attributes.get('dataWindow').readInt32LE(i));
    if (attributes.get('compression')[0] !== ZIP) {
        throw new Error(`${file}: not zip-compressed`);
    }
    const [width, height] = [x1 - x0 + 1, y1 - y0 + 1];
    const rgb = new Float32Array(3 * width * height);
    const channels = ['B', 'G', 'R'];  // in the file's order
    for (let row = 0, block = 0; row < height; row += ROWS_OF_A_BLOCK, ++block) {
        const at = Number(bytes.readBigUInt64LE(end + 8 * block));
        const size = bytes.readInt32LE(at + 4);
        const rows = Math.min(ROWS_OF_A_BLOCK, height - row);
        const raw = unzip(bytes.subarray(at + 8, at + 8 + size), 12 * width * rows);
        for (let y = 0; y < rows; ++y) {
            channels.forEach((_, c) => {
                for (let x = 0; x < width; ++x) {
                    const value = raw.readFloatLE(4 * ((3 * y + c) * width + x));
                    rgb[3 * ((row + y) * width + x) + 2 - c] = value;
                }
            });
        }
    }
    return {width, height, rgb};
}
