// SPDX-License-Identifier: Apache-2.0
// A folder over HTTP, as any web server has it.

import {once} from 'node:events';
import {readFile} from 'node:fs/promises';
import {createServer} from 'node:http';
import path from 'node:path';

const TYPES = {
    '.html': 'text/html; charset=utf-8',
    '.js': 'text/javascript',
    '.css': 'text/css',
    '.json': 'application/json',
    '.jpg': 'image/jpeg',
    '.png': 'image/png',
};

/**
 * Serves a folder on a free port of this machine alone.
 *
 * @param {string} folder
 * @returns {Promise<{url: string, asked: string[], stop: () => Promise<void>}>}  asked: paths, in order
 */
export async function serveFolder(folder) {
    /** @type {string[]} */
    const asked = [];
    const server = createServer(async (request, response) => {
        const {pathname} = new URL(request.url ?? '/', 'http://localhost');
        asked.push(pathname);
        const file = path.join(folder, path.normalize(pathname === '/' ? '/index.html' : pathname));
        const bytes = file.startsWith(folder) ? await readFile(file).catch(() => null) : null;
        const type = TYPES[path.extname(file)] ?? 'application/octet-stream';
        response.writeHead(bytes ? 200 : 404, {'Content-Type': type});
        response.end(bytes ?? 'not here');
    });
    server.listen(0, '127.0.0.1');
    await once(server, 'listening');
    const {port} = /** @type {import('node:net').AddressInfo} */ (server.address());
    return {
        url: `http://127.0.0.1:${port}/`,
        asked,
        stop: async () => {
            server.closeAllConnections();
            server.close();
            await once(server, 'close');
        },
    };
}
