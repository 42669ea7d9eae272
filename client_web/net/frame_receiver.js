// SPDX-License-Identifier: Apache-2.0
// Binary messages to pictures: header parsing, decoding off the main thread, acknowledgement as soon as it is
// decoded. While one frame is being decoded only the newest of those that arrive is kept.

import {decodeDepths} from '../picture/depths.js';

/**
 * @typedef {import('./protocol.js').FrameHeader} FrameHeader
 * @typedef {import('../picture/depths.js').Depths} Depths
 * @typedef {object} Frame
 * @property {FrameHeader} header
 * @property {ImageBitmap} image  belongs to the receiver: draw it at once, it is closed afterwards
 * @property {Depths | null} depths  where they have been asked for
 * @property {number} decodeMs
 * @typedef {object} FrameSink
 * @property {(frame: Frame) => void} show
 * @property {(frame: number, decodeMs: number) => void} acknowledge
 * @property {(error: Error) => void} fail
 */

/** Larger headers than this are not ours. */
const MAX_HEADER_BYTES = 65536;

const MIME_TYPES = {JPEG: 'image/jpeg', PNG: 'image/png'};

/**
 * Takes a binary message apart: u32 little-endian header length, header as JSON, and what belongs to it.
 *
 * @param {ArrayBuffer} message
 * @returns {{header: any, body: Uint8Array<ArrayBuffer>}}  body: shares the message's memory
 * @throws {Error} if it is no such message
 */
export function splitMessage(message) {
    if (message.byteLength < 4) {
        throw new Error('frame: shorter than its length field');
    }
    const headerBytes = new DataView(message).getUint32(0, true);
    if (headerBytes > MAX_HEADER_BYTES || 4 + headerBytes > message.byteLength) {
        throw new Error(`frame: header of ${headerBytes} bytes does not fit`);
    }
    const text = new TextDecoder('utf-8', {fatal: true}).decode(new Uint8Array(message, 4, headerBytes));
    return {header: JSON.parse(text) ?? {}, body: new Uint8Array(message, 4 + headerBytes)};
}

/**
 * Takes a frame apart: encoded image, and depths if the header says so.
 *
 * @param {ArrayBuffer} message
 * @returns {{header: FrameHeader, image: Uint8Array<ArrayBuffer>, depths: Uint8Array<ArrayBuffer>}}
 *     both share the message's memory
 * @throws {Error} if the message is not a frame
 */
export function parseFrame(message) {
    const {header, body} = splitMessage(message);
    if (!Number.isInteger(header?.frame) || !(header.codec in MIME_TYPES)) {
        throw new Error('frame: header lacks frame number or a known codec');
    }
    const depthBytes = header.depthBytes ?? 0;
    const end = body.length - depthBytes;
    if (!(depthBytes >= 0 && end >= 0)) {
        throw new Error(`frame: depths of ${depthBytes} bytes do not fit`);
    }
    return {header, image: body.subarray(0, end), depths: body.subarray(end)};
}

export class FrameReceiver {
    /** @type {ArrayBuffer | null} */
    #newest = null;
    #decoding = false;
    #paused = false;
    /** Counts connections, so that a frame of the last one is not acknowledged to the next. */
    #generation = 0;

    /** @param {FrameSink} sink */
    constructor(sink) {
        this.sink = sink;
    }

    get paused() {
        return this.#paused;
    }

    set paused(paused) {
        this.#paused = paused;
        this.#decodeNewest();
    }

    /** @param {ArrayBuffer} message */
    push(message) {
        this.#newest = message;
        this.#decodeNewest();
    }

    /** Forgets what has not been shown, for a new connection. */
    reset() {
        this.#newest = null;
        ++this.#generation;
    }

    async #decodeNewest() {
        if (this.#decoding || this.#paused) {
            return;
        }
        this.#decoding = true;
        while (this.#newest && !this.#paused) {
            const message = this.#newest;
            this.#newest = null;
            await this.#decode(message, this.#generation);
        }
        this.#decoding = false;
    }

    /**
     * @param {ArrayBuffer} message
     * @param {number} generation
     */
    async #decode(message, generation) {
        const start = performance.now();
        let parsed;
        let decoded = null;
        try {
            parsed = parseFrame(message);
            decoded = await decode(parsed);
        } catch (error) {
            this.#fail(error);
        }
        const decodeMs = performance.now() - start;
        const known = generation === this.#generation;
        // Before it is shown, so that the next one sets out meanwhile. Also what could not be decoded is
        // acknowledged: the stream must go on.
        if (parsed && known) {
            this.sink.acknowledge(parsed.header.frame, decodeMs);
        }
        if (parsed && decoded && known) {
            this.#show({header: parsed.header, ...decoded, decodeMs});
        }
        decoded?.image.close();
    }

    /** @param {Frame} frame */
    #show(frame) {
        try {
            this.sink.show(frame);
        } catch (error) {
            this.#fail(error);
        }
    }

    /** @param {unknown} error */
    #fail(error) {
        this.sink.fail(error instanceof Error ? error : new Error(String(error)));
    }
}

/**
 * @param {ReturnType<typeof parseFrame>} frame
 * @returns {Promise<{image: ImageBitmap, depths: Depths | null}>}
 */
async function decode({header, image: bytes, depths: depthBytes}) {
    const blob = new Blob([bytes], {type: MIME_TYPES[header.codec]});
    const coming = depthBytes.length > 0 ? decodeDepths(header, depthBytes) : null;
    // Without its depths the picture is as good as ever.
    const [image, depths] = await Promise.all([createImageBitmap(blob), coming?.catch(() => null) ?? null]);
    return {image, depths};
}
