// SPDX-License-Identifier: Apache-2.0

import {readFile} from 'node:fs/promises';
import path from 'node:path';

import {ROOT} from './daemon.mjs';

/**
 * A binary glTF file of a scene that needs no other files.
 *
 * @param {string} scene  relative to the root of the repository
 * @returns {Promise<Buffer>}
 */
export async function toGlb(scene) {
    const json = Buffer.from(await readFile(path.join(ROOT, scene)));
    const padded = Buffer.concat([json, Buffer.alloc(-json.length & 3, ' ')]);
    const head = Buffer.alloc(20);
    head.write('glTF');
    [2, 20 + padded.length, padded.length].forEach((word, i) => head.writeUInt32LE(word, 4 + 4 * i));
    head.write('JSON', 16);
    return Buffer.concat([head, padded]);
}
