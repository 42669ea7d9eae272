// SPDX-License-Identifier: Apache-2.0
// Starts and ends the executable under test.

import {spawn} from 'node:child_process';
import {once} from 'node:events';
import {existsSync} from 'node:fs';
import path from 'node:path';
import {fileURLToPath} from 'node:url';

/** Root of the repository. */
export const ROOT = path.resolve(path.dirname(fileURLToPath(import.meta.url)), '../..');

const EXECUTABLE = process.env.RAYBUNDLE ?? path.join(ROOT, 'build/raybundle');
const START_TIMEOUT_MS = 180000;
const ADDRESS = /http:\/\/127\.0\.0\.1:(\d+)/;

/** A running `raybundle serve`. */
export class Daemon {
    /**
     * @param {import('node:child_process').ChildProcess} child
     * @param {number} port
     */
    constructor(child, port) {
        this.child = child;
        this.port = port;
    }

    get url() {
        return `http://127.0.0.1:${this.port}/`;
    }

    /**
     * Serves a scene.
     *
     * @param {string} scene  file, relative to the root of the repository
     * @param {number} port  0: any free one
     * @param {string[]} more  options
     * @param {string} state  folder in which the server keeps its journals; empty: it keeps none
     * @returns {Promise<Daemon>} once it listens
     */
    static async start(scene, port = 0, more = [], state = '') {
        if (!existsSync(EXECUTABLE)) {
            throw new Error(`${EXECUTABLE} is missing: build first, or name it in RAYBUNDLE`);
        }
        const options = ['serve', path.join(ROOT, scene), '--listen', `127.0.0.1:${port}`, ...more];
        if (!state && !more.includes('--journal')) {
            options.push('--journal', 'none');
        }
        const env = state ? {...process.env, XDG_STATE_HOME: state} : process.env;
        const child = spawn(EXECUTABLE, options, {env, stdio: ['ignore', 'pipe', 'pipe']});
        return new Daemon(child, await listeningPort(child));
    }

    /**
     * Sends SIGTERM and waits for the end.
     *
     * @returns {Promise<number | null>} exit status
     */
    async stop() {
        if (this.child.exitCode !== null || this.child.signalCode !== null) {
            return this.child.exitCode;
        }
        const ended = once(this.child, 'exit');
        this.child.kill('SIGTERM');
        const patience = setTimeout(() => this.child.kill('SIGKILL'), 30000);
        const [status] = await ended;
        clearTimeout(patience);
        return status;
    }
}

/**
 * @param {import('node:child_process').ChildProcess} child
 * @returns {Promise<number>}
 */
function listeningPort(child) {
    return new Promise((resolve, reject) => {
        let output = '';
        const timer = setTimeout(() => {
            child.kill('SIGKILL');
            reject(new Error(`the server names no address:\n${output}`));
        }, START_TIMEOUT_MS);
        const read = (/** @type {Buffer} */ chunk) => {
            // Only the end is of interest; a long run must not fill the memory.
            output = (output + chunk).slice(-8192);
            const match = ADDRESS.exec(output);
            if (match) {
                clearTimeout(timer);
                resolve(Number(match[1]));
            }
        };
        child.stdout?.on('data', read);
        child.stderr?.on('data', read);
        child.on('error', reject);
        child.on('exit', (status, signal) => {
            clearTimeout(timer);
            reject(new Error(`the server ended with ${status ?? signal}:\n${output}`));
        });
    });
}
