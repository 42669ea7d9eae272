// SPDX-License-Identifier: Apache-2.0
// Binary messages to pictures: header parsing, decoding off the main thread, acknowledgement as soon as it is
// decoded. While one frame is being decoded only the newest of those that arrive is kept; of a video those from its last
// key frame on, since each needs the one before it.

import {decodeDepths} from '../picture/depths.js';
import {VideoStream} from './video_stream.js';

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
 * @property {(frame: number, decodeMs: number, wantsKey: boolean) => void} acknowledge
 * @property {(error: Error) => void} fail
 * @property {() => void} [videoFailed]  this browser does not decode the video after all
 */

/** Larger headers than this are not ours. */
const MAX_HEADER_BYTES = 65536;

const MIME_TYPES = {JPEG: 'image/jpeg', PNG: 'image/png'};
const VIDEO = 'VP9';
/** Frames of a video that may wait. The server has 12 on their way at most (CongestionSettings::max_in_flight). */
const MAX_WAITING = 16;

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
    if (!Number.isInteger(header?.frame) || !(header.codec in MIME_TYPES || header.codec === VIDEO)) {
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
    /** @type {ReturnType<typeof parseFrame>[]}  first the one to be decoded next */
    #waiting = [];
    #video = new VideoStream();
    /** Whether a key frame is to be asked for with the next acknowledgement. */
    #wantsKey = false;
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
        let frame;
        try {
            frame = parseFrame(message);
        } catch (error) {
            this.#fail(error);
            return;
        }
        if (frame.header.codec !== VIDEO || frame.header.key) {
            this.#waiting = [];
        } else if (this.#waiting.length >= MAX_WAITING) {
            this.#waiting = [];
            this.#loseVideo();
        }
        this.#waiting.push(frame);
        this.#decodeNewest();
    }

    /** Forgets what has not been shown, for a new connection. */
    reset() {
        this.#waiting = [];
        this.#video.end();
        this.#wantsKey = false;
        ++this.#generation;
    }

    async #decodeNewest() {
        if (this.#decoding || this.#paused) {
            return;
        }
        this.#decoding = true;
        while (this.#waiting.length > 0 && !this.#paused) {
            const frame = /** @type {ReturnType<typeof parseFrame>} */ (this.#waiting.shift());
            await this.#decode(frame, this.#generation);
        }
        this.#decoding = false;
    }

    /** The video goes on with a key frame. */
    #loseVideo() {
        this.#video.end();
        this.#wantsKey = true;
    }

    /**
     * @param {ReturnType<typeof parseFrame>} parsed
     * @param {number} generation
     */
    async #decode(parsed, generation) {
        const start = performance.now();
        const {header} = parsed;
        let decoded = null;
        try {
            decoded = await this.#picture(parsed);
        } catch (error) {
            if (generation === this.#generation) {
                this.#fail(error);
            }
        }
        const decodeMs = performance.now() - start;
        const known = generation === this.#generation;
        // Before it is shown, so that the next one sets out meanwhile. Also what could not be decoded is
        // acknowledged: the stream must go on.
        if (known) {
            this.sink.acknowledge(header.frame, decodeMs, this.#wantsKey);
            this.#wantsKey = false;
        }
        if (decoded && known) {
            this.#show({header, ...decoded, decodeMs});
        }
        decoded?.image.close();
    }

    /**
     * @param {ReturnType<typeof parseFrame>} frame
     * @returns {Promise<{image: ImageBitmap, depths: Depths | null} | null>}  null: it waits for a key frame
     */
    async #picture({header, image: bytes, depths: depthBytes}) {
        const coming = depthBytes.length > 0 ? decodeDepths(header, depthBytes).catch(() => null) : null;
        let image;
        if (header.codec !== VIDEO) {
            this.#video.end();
            image = createImageBitmap(new Blob([bytes], {type: MIME_TYPES[header.codec]}));
        } else if (header.key || this.#video.whole) {
            image = this.#decodeVideo(bytes, header.key === true);
        } else {
            return null;
        }
        // Without its depths the picture is as good as ever.
        const [picture, depths] = await Promise.all([image, coming]);
        return {image: picture, depths};
    }

    /**
     * @param {Uint8Array<ArrayBuffer>} bytes
     * @param {boolean} key
     */
    async #decodeVideo(bytes, key) {
        const generation = this.#generation;
        try {
            return await this.#video.decode(bytes, key);
        } catch (error) {
            if (generation === this.#generation) {
                this.#loseVideo();
                if (this.#video.failed) {
                    this.sink.videoFailed?.();
                }
            }
            throw error;
        }
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
