// SPDX-License-Identifier: Apache-2.0
// Connection to a Raybundle server: greeting, requests and their answers, frames, round trips,
// and reconnecting by itself. Knows nothing of the page around it.

import {FrameReceiver, splitMessage} from './frame_receiver.js';
import {PROTOCOL_VERSION, SUBPROTOCOL, ServerError, majorVersion} from './protocol.js';
import {decodesVideo, isOnThisMachine} from './video_stream.js';

/**
 * @typedef {import('./protocol.js').ServerMessage} ServerMessage
 * @typedef {import('./protocol.js').Welcome} Welcome
 * @typedef {import('./protocol.js').Viewport} Viewport
 * @typedef {'idle' | 'connecting' | 'connected' | 'reconnecting' | 'refused'} ConnectionState
 * @typedef {object} ClientSettings
 * @property {string | string[]} url  of the WebSocket, e.g. "ws://127.0.0.1:8080/ws"; several: of servers of one project,
 *     of which the next one is tried where one is lost
 * @property {string} [name]  shown to other viewers
 * @property {string} [token]
 * @property {() => boolean} [light]  whether the page draws by itself, too, asked at each connection
 * @property {boolean} [video]  whether moving pictures come as video where the browser decodes it; absent: unless the
 *     server is on this machine
 * @property {() => Viewport} viewport  size of the pictures wanted, asked at each connection
 */

/** Silence after which a connection counts as dead, although its socket is still open. */
const SILENCE_LIMIT_MS = 20000;
/** Before the welcome, since a server may compile its shaders first. */
const WELCOME_LIMIT_MS = 120000;
/** Why the server has not answered yet although it is there. */
export const PREPARING = 'The server is preparing the scene.';
/** Requests that change the scene. Pins, viewpoints, zones, requirements and names of lighting scenes are none of it. */
const CHANGES = [
    'moveObject', 'setLight', 'setMaterial', 'setGroup', 'setDaylight', 'applyLightingScene',
    'addObject', 'removeObject', 'addLuminaire', 'removeLight', 'playAnimation', 'undo',
];
const PING_INTERVAL_MS = 2000;
const FIRST_RETRY_MS = 500;
const LAST_RETRY_MS = 10000;

/** Errors in answer to `hello` that trying again will not mend. */
const FINAL_CODES = new Set([
    'UNAUTHENTICATED',
    'PERMISSION_DENIED',
    'UNIMPLEMENTED',
    'INVALID_ARGUMENT',
]);

/**
 * Waiting time before a connection attempt: doubles from attempt to attempt, and varies so that
 * viewers of a restarted server do not return all at once.
 *
 * @param {number} attempt  0 for the first retry
 * @param {number} random  0..1
 * @returns {number} milliseconds
 */
export function retryDelay(attempt, random) {
    return Math.min(FIRST_RETRY_MS * 2 ** attempt, LAST_RETRY_MS) * (0.75 + 0.5 * random);
}

/**
 * Events: `state` (detail {state, reason, code, retryAt}), `welcome`, `frame` (detail {header, image,
 * decodeMs}), `light` (detail {header, body}), `solution`, `sceneChanged`, `roundTrip` (detail milliseconds), `problem` (detail
 * ServerError, of a message that expects no answer), `asked` (a change has been asked for, or answered), `message`
 * (every text message).
 */
export class RaybundleClient extends EventTarget {
    /** @type {WebSocket | null} */
    #socket = null;
    /** @type {Map<number, {resolve: (m: ServerMessage) => void, reject: (e: Error) => void, changes: boolean}>} */
    #waiting = new Map();
    #nextId = 1;
    #attempt = 0;
    /** Counts the servers that have been lost. */
    #server = 0;
    #lastHeard = 0;
    #pinging = false;
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    #retryTimer;
    /** @type {ReturnType<typeof setInterval> | undefined} */
    #pingTimer;
    #frames = new FrameReceiver({
        show: (frame) => this.#emit('frame', frame),
        acknowledge: (frame, decodeMs, wantsKey) => this.send({ack: {frame, decodeMs, ...(wantsKey && {wantsKey})}}),
        videoFailed: () => this.#giveUpVideo(),
        fail: (error) => this.#emit('problem', new ServerError('INTERNAL', error.message)),
    });

    /** Whether video has failed in this page: moving pictures are JPEG from then on. */
    #withoutVideo = false;

    /** @param {ClientSettings} settings */
    constructor(settings) {
        super();
        this.settings = settings;
        /** @type {ConnectionState} */
        this.state = 'idle';
        /** Why the state is what it is, for people. */
        this.reason = '';
        /** When the next attempt begins, clock of performance.now(). */
        this.retryAt = 0;
        /** @type {Welcome | null} */
        this.welcome = null;
    }

    /** The server that it is connected to, or tries. */
    get address() {
        const addresses = [this.settings.url].flat();
        return addresses[this.#server % addresses.length];
    }

    /** Connects, or tries again at once. */
    connect() {
        clearTimeout(this.#retryTimer);
        this.#drop();
        this.#become(this.welcome ? 'reconnecting' : 'connecting', '');
        const socket = new WebSocket(this.address, SUBPROTOCOL);
        socket.binaryType = 'arraybuffer';
        this.#socket = socket;
        this.#lastHeard = performance.now();
        socket.onopen = () => {
            this.#become(this.state, PREPARING);
            this.#greet();
        };
        socket.onmessage = (event) => this.#receive(event.data);
        socket.onclose = (event) => this.#lost(event.reason);
        this.#pingTimer = setInterval(() => this.#watch(), PING_INTERVAL_MS);
    }

    /** Ends the connection and stays away. */
    close() {
        clearTimeout(this.#retryTimer);
        this.#drop();
        this.#become('idle', '');
    }

    /** While paused, frames are neither decoded nor acknowledged, so the server stops sending. */
    set paused(/** @type {boolean} */ paused) {
        this.#frames.paused = paused;
    }

    get paused() {
        return this.#frames.paused;
    }

    /**
     * Sends a message that expects no answer.
     *
     * @param {object} body  e.g. {setViewport: {width, height}}
     * @returns {boolean} false: not connected
     */
    send(body) {
        if (!this.#socket || this.#socket.readyState !== WebSocket.OPEN) {
            return false;
        }
        this.#socket.send(JSON.stringify(body));
        return true;
    }

    /**
     * Sends a request.
     *
     * @param {object} body  e.g. {probe: {ray}}
     * @returns {{id: number, answer: Promise<ServerMessage>}} `answer` rejects with a ServerError,
     *     or an Error if the connection is lost
     */
    request(body) {
        const id = this.#nextId++;
        const answer = new Promise((resolve, reject) => {
            if (this.send({id, ...body})) {
                const changes = CHANGES.some((name) => name in body);
                this.#waiting.set(id, {resolve, reject, changes});
                this.#tellChanging(changes);
            } else {
                reject(new Error('not connected'));
            }
        });
        return {id, answer};
    }

    /** What HTTP requests to the server show its token by. @returns {Record<string, string>} */
    get httpHeaders() {
        const {token} = this.settings;
        return token ? {Authorization: `Bearer ${token}`} : {};
    }

    /** Whether a change of the scene that this page has asked for waits for its answer. */
    get changing() {
        return [...this.#waiting.values()].some(({changes}) => changes);
    }

    /** @param {boolean} changes  whether it was about a change that something has been sent or answered */
    #tellChanging(changes) {
        if (changes) {
            this.dispatchEvent(new Event('asked'));
        }
    }

    /** Comes back without video: which codecs a client decodes it says in its greeting. */
    #giveUpVideo() {
        this.#withoutVideo = true;
        queueMicrotask(() => this.#socket && this.connect());
    }

    get #wantsVideo() {
        return !this.#withoutVideo && (this.settings.video ?? !isOnThisMachine(this.address));
    }

    async #greet() {
        const socket = this.#socket;
        const video = this.#wantsVideo && (await decodesVideo());
        if (socket !== this.#socket) {
            return; // another connection has been begun meanwhile
        }
        const hello = {
            protocol: PROTOCOL_VERSION,
            name: this.settings.name ?? '',
            token: this.settings.token ?? '',
            codecs: video ? ['VP9', 'JPEG', 'PNG'] : ['JPEG', 'PNG'],
            viewport: this.settings.viewport(),
            ...(video && {lenient: true}), // a server that does not know VP9 takes JPEG
            ...(this.settings.light?.() && {light: true}),
        };
        try {
            const {welcome} = await this.request({hello}).answer;
            if (!welcome) {
                throw new ServerError(
                    'INVALID_ARGUMENT',
                    'The server did not answer the greeting.',
                );
            }
            this.#welcomed(welcome);
        } catch (error) {
            if (error instanceof ServerError) {
                this.#refused(error);
            }
        }
    }

    /** @param {Welcome} welcome */
    #welcomed(welcome) {
        if (majorVersion(welcome.protocol) !== majorVersion(PROTOCOL_VERSION)) {
            const versions = `${welcome.protocol}, this page ${PROTOCOL_VERSION}`;
            this.#refused(
                new ServerError('UNIMPLEMENTED', `The server speaks protocol ${versions}.`),
            );
            return;
        }
        this.#attempt = 0;
        this.welcome = welcome;
        this.#become('connected', '');
        this.#emit('welcome', welcome);
        this.#ping();
    }

    /** @param {ServerError} error */
    #refused(error) {
        this.#drop();
        if (FINAL_CODES.has(error.code)) {
            this.#become('refused', error.message, error.code);
        } else {
            this.#retryLater(error.message, error.code);
        }
    }

    /** @param {string} reason */
    #lost(reason) {
        this.#drop();
        this.#retryLater(reason);
    }

    /**
     * @param {string} reason
     * @param {string} code  of the server's error, if it was one
     */
    #retryLater(reason, code = '') {
        this.#server++;
        const delay = retryDelay(this.#attempt++, Math.random());
        this.retryAt = performance.now() + delay;
        this.#retryTimer = setTimeout(() => this.connect(), delay);
        this.#become('reconnecting', reason, code);
    }

    /** Lets go of the socket and of everything that waits for it. */
    #drop() {
        clearInterval(this.#pingTimer);
        const socket = this.#socket;
        this.#socket = null;
        if (socket) {
            socket.onopen = socket.onmessage = socket.onclose = null;
            socket.close();
        }
        this.#frames.reset();
        const waiting = [...this.#waiting.values()];
        this.#waiting.clear();
        waiting.forEach(({reject}) => reject(new Error('connection lost')));
    }

    #watch() {
        const limit = this.state === 'connected' ? SILENCE_LIMIT_MS : WELCOME_LIMIT_MS;
        if (performance.now() - this.#lastHeard > limit) {
            this.#lost('The server has not answered for a while.');
        } else if (this.state === 'connected') {
            this.#ping();
        }
    }

    async #ping() {
        if (this.#pinging) {
            return;
        }
        this.#pinging = true;
        const start = performance.now();
        try {
            await this.request({ping: {}}).answer;
            this.#emit('roundTrip', performance.now() - start);
        } catch {
            // A lost connection tells its own story, by its state.
        }
        this.#pinging = false;
    }

    /** @param {ArrayBuffer} data  a frame, or light */
    #receiveBinary(data) {
        let message;
        try {
            message = splitMessage(data);
        } catch {
            // The receiver of frames says what is wrong.
        }
        if (message && Number.isInteger(message.header.light)) {
            this.#emit('light', message);
        } else {
            this.#frames.push(data);
        }
    }

    /** @param {ArrayBuffer | string} data */
    #receive(data) {
        this.#lastHeard = performance.now();
        if (data instanceof ArrayBuffer) {
            this.#receiveBinary(data);
            return;
        }
        /** @type {ServerMessage} */
        let message;
        try {
            message = JSON.parse(data);
        } catch {
            this.#emit('problem', new ServerError('INTERNAL', 'The server sent unreadable text.'));
            return;
        }
        this.#dispatch(message);
    }

    /** @param {ServerMessage} message */
    #dispatch(message) {
        this.#emit('message', message);
        if (message.solution) {
            this.#emit('solution', message.solution);
        }
        if (message.sceneChanged) {
            this.#emit('sceneChanged', message.sceneChanged);
        }
        const {replyTo, error} = message;
        const waiting = replyTo === undefined ? undefined : this.#waiting.get(replyTo);
        if (replyTo !== undefined) {
            this.#waiting.delete(replyTo);
            this.#tellChanging(waiting?.changes ?? false);
        }
        if (error) {
            const failure = new ServerError(error.code, error.message);
            if (waiting) {
                waiting.reject(failure);
            } else if (this.state === 'connected') {
                this.#emit('problem', failure);
            } else {
                this.#refused(failure);
            }
        } else {
            waiting?.resolve(message);
        }
    }

    /**
     * @param {ConnectionState} state
     * @param {string} reason
     * @param {string} code
     */
    #become(state, reason, code = '') {
        this.state = state;
        this.reason = reason;
        this.#emit('state', {state, reason, code, retryAt: this.retryAt});
    }

    /**
     * @param {string} type
     * @param {unknown} detail
     */
    #emit(type, detail) {
        this.dispatchEvent(new CustomEvent(type, {detail}));
    }
}
