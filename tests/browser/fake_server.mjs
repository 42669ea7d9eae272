// SPDX-License-Identifier: Apache-2.0
// A server that says what a test wants: the page's files from disk, and a WebSocket that Playwright
// answers. For what a real server cannot be brought to do in a moment.

import {existsSync, readFileSync} from 'node:fs';
import http from 'node:http';
import path from 'node:path';

import {ROOT} from './daemon.mjs';

const FOLDER = path.join(ROOT, 'client_web');
const TYPES = {'.js': 'text/javascript', '.html': 'text/html; charset=utf-8', '.css': 'text/css'};

/** The page's files over HTTP. */
export class FileServer {
    /** @returns {Promise<FileServer>} */
    static async start() {
        const server = http.createServer((request, response) => {
            const {pathname} = new URL(request.url ?? '/', 'http://localhost');
            const file = path.join(FOLDER, pathname === '/' ? 'index.html' : pathname);
            const type = TYPES[path.extname(file)];
            if (!file.startsWith(FOLDER) || !type || !existsSync(file)) {
                response.writeHead(404).end();
                return;
            }
            response.writeHead(200, {'content-type': type}).end(readFileSync(file));
        });
        await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
        return new FileServer(server);
    }

    /** @param {http.Server} server */
    constructor(server) {
        this.server = server;
        this.url = `http://127.0.0.1:${server.address().port}/`;
    }

    stop() {
        this.server.closeAllConnections();
        this.server.close();
    }
}

const BOX = {min: {x: 0, y: 0, z: 0}, max: {x: 4, y: 3, z: 5}};

/** A welcome as a server sends it. */
export const WELCOME = {
    protocol: '1.0',
    server: 'raybundle test',
    viewer: 1,
    role: 'EDITOR',
    epoch: 0,
    renderer: 'llvmpipe',
    softwareRendering: true,
    scene: {
        name: 'test_room',
        bounds: BOX,
        objects: [{id: 1, name: 'table', movable: true, bounds: BOX, transform: {}}],
        lights: [
            {
                id: 1,
                name: 'lamp',
                kind: 'AREA',
                intensity: 1000,
                unit: 'LM',
                colour: {x: 1, y: 1, z: 1},
                on: true,
            },
        ],
        cameras: [
            {
                name: 'door',
                eye: {x: 2, y: 1.6, z: 8},
                target: {x: 2, y: 1, z: 2},
                up: {x: 0, y: 1, z: 0},
                verticalFov: 0.8,
            },
        ],
        materials: [
            {id: 1, name: 'paint', baseColour: {x: 0.5, y: 0.2, z: 0.1}, roughness: 0.6, metallic: 0},
        ],
        effects: [
            {name: 'sky', active: false, reason: 'no sky is set'},
            {
                name: 'glossy',
                active: true,
                reason: 'one material is glossy',
                pathClass: 'L(D|G)*E',
                shareBound: 0.5,
                bytesPerPatch: 56,
            },
        ],
    },
    limits: {maxWidth: 3840, maxHeight: 2160, maxMessageBytes: 65536},
};

/**
 * Answers the page's WebSocket.
 *
 * @param {import('playwright-core').Page} page
 * @param {(message: any, send: (answer: object, isAnswer?: boolean) => void, close: (code: number) => void) => void} answer
 * @returns {Promise<any[]>} what the page has sent, growing
 */
export async function fakeSocket(page, answer) {
    const sent = [];
    await page.routeWebSocket(/\/ws$/, (socket) => {
        socket.onMessage((text) => {
            const message = JSON.parse(String(text));
            sent.push(message);
            const send = (/** @type {object} */ body, isAnswer = true) => {
                socket.send(JSON.stringify(isAnswer ? {replyTo: message.id, ...body} : body));
            };
            answer(message, send, (code) => socket.close({code, reason: ''}));
        });
    });
    return sent;
}
