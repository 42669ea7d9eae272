// SPDX-License-Identifier: Apache-2.0
// Binary messages to pictures: header parsing, decoding off the main thread, acknowledgement after
// decoding. While one frame is being decoded only the newest of those that arrive is kept.

/**
 * @typedef {import('./protocol.js').FrameHeader} FrameHeader
 * @typedef {{header: FrameHeader, image: ImageBitmap, decodeMs: number}} Frame  `image` belongs to
 *     the receiver: draw it at once, it is closed afterwards
 * @typedef {object} FrameSink
 * @property {(frame: Frame) => void} show
 * @property {(frame: number, decodeMs: number) => void} acknowledge
 * @property {(error: Error) => void} fail
 */

/** Larger headers than this are not ours. */
const MAX_HEADER_BYTES = 65536;

const MIME_TYPES = {JPEG: 'image/jpeg', PNG: 'image/png'};

/**
 * Takes a binary message apart: u32 little-endian header length, header as JSON, encoded image.
 *
 * @param {ArrayBuffer} message
 * @returns {{header: FrameHeader, image: Uint8Array<ArrayBuffer>}} `image` shares the message's
 *     memory
 * @throws {Error} if the message is not a frame
 */
export function parseFrame(message) {
    if (message.byteLength < 4) {
        throw new Error('frame: shorter than its length field');
    }
    const headerBytes = new DataView(message).getUint32(0, true);
    if (headerBytes > MAX_HEADER_BYTES || 4 + headerBytes > message.byteLength) {
        throw new Error(`frame: header of ${headerBytes} bytes does not fit`);
    }
    const text = new TextDecoder('utf-8', {fatal: true}).decode(
        new Uint8Array(message, 4, headerBytes),
    );
    /** @type {FrameHeader} */
    const header = JSON.parse(text);
    if (!Number.isInteger(header?.frame) || !(header.codec in MIME_TYPES)) {
        throw new Error('frame: header lacks frame number or a known codec');
    }
    return {header, image: new Uint8Array(message, 4 + headerBytes)};
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
        try {
            parsed = parseFrame(message);
            const blob = new Blob([parsed.image], {type: MIME_TYPES[parsed.header.codec]});
            const image = await createImageBitmap(blob);
            const decodeMs = performance.now() - start;
            if (generation === this.#generation) {
                this.sink.show({header: parsed.header, image, decodeMs});
            }
            image.close();
        } catch (error) {
            this.sink.fail(error instanceof Error ? error : new Error(String(error)));
        }
        // Also what could not be decoded is acknowledged: the stream must go on.
        if (parsed && generation === this.#generation) {
            this.sink.acknowledge(parsed.header.frame, performance.now() - start);
        }
    }
}
