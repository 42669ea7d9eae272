// SPDX-License-Identifier: Apache-2.0
// Frames of VP9 to pictures, by the browser's VideoDecoder (WebCodecs). One frame in, one picture out.

/** Profile 0, 8 bits; level 5.1, which 3840x2160 needs. */
const CODEC = 'vp09.00.51.08';
/**
 * BT.709 in limited range, as the server makes it of sRGB.
 *
 * @type {VideoColorSpaceInit}
 */
const COLOURS = {primaries: 'bt709', transfer: 'iec61966-2-1', matrix: 'bt709', fullRange: false};
/** A decoder that keeps a frame back for so long is none for live pictures, ms. */
const LONGEST_MS = 2000;
/** Failures one after the other, without a picture between them, after which there is no video. */
const MOST_FAILURES = 2;

/** @returns {VideoDecoderConfig} */
const config = () => ({codec: CODEC, optimizeForLatency: true, colorSpace: COLOURS});

/**
 * Whether this browser decodes the server's video. Browsers do only in secure contexts: https, or this machine.
 *
 * @returns {Promise<boolean>}
 */
export async function decodesVideo() {
    try {
        return (await VideoDecoder.isConfigSupported(config())).supported === true;
    } catch {
        return false;
    }
}

/**
 * Whether the server runs on this machine: then bytes cost nothing, and JPEG less of its processor.
 *
 * @param {string} address  of the server
 * @returns {boolean}
 */
export function isOnThisMachine(address) {
    const {hostname} = new URL(address, globalThis.location?.href);
    return hostname === 'localhost' || hostname === '[::1]' || hostname.startsWith('127.');
}

export class VideoStream {
    /** @type {VideoDecoder | null} */
    #decoder = null;
    /** @type {{resolve: (frame: VideoFrame) => void, reject: (error: Error) => void} | null} */
    #waiting = null;
    #failures = 0;
    #time = 0;

    /** Whether the next frame can be decoded without a key frame. */
    get whole() {
        return this.#decoder !== null;
    }

    /** Whether it has failed so often that there should be no video. */
    get failed() {
        return this.#failures >= MOST_FAILURES;
    }

    /**
     * @param {Uint8Array<ArrayBuffer>} bytes
     * @param {boolean} key
     * @returns {Promise<ImageBitmap>} rejects where it cannot be decoded: a key frame has to follow
     */
    async decode(bytes, key) {
        try {
            const frame = await this.#picture(bytes, key);
            try {
                const image = await createImageBitmap(frame);
                this.#failures = 0;
                return image;
            } finally {
                frame.close();
            }
        } catch (error) {
            ++this.#failures;
            this.end();
            throw error;
        }
    }

    /** Lets go of the decoder. The next frame has to be a key frame. */
    end() {
        const decoder = this.#decoder;
        this.#decoder = null;
        this.#waiting?.reject(new Error('video: the stream has ended'));
        this.#waiting = null;
        if (decoder && decoder.state !== 'closed') {
            decoder.close();
        }
    }

    /**
     * @param {Uint8Array<ArrayBuffer>} bytes
     * @param {boolean} key
     * @returns {Promise<VideoFrame>}
     */
    #picture(bytes, key) {
        return new Promise((resolve, reject) => {
            const timer = setTimeout(() => reject(new Error('video: the decoder does not answer')), LONGEST_MS);
            this.#waiting = {
                resolve: (frame) => (clearTimeout(timer), resolve(frame)),
                reject: (error) => (clearTimeout(timer), reject(error)),
            };
            this.#decoder ??= this.#begin();
            const type = key ? 'key' : 'delta';
            this.#decoder.decode(new EncodedVideoChunk({type, timestamp: this.#time++, data: bytes}));
        });
    }

    #begin() {
        const decoder = new VideoDecoder({
            output: (frame) => {
                if (this.#decoder === decoder && this.#waiting) {
                    this.#waiting.resolve(frame);
                    this.#waiting = null;
                } else {
                    frame.close();
                }
            },
            error: (error) => {
                if (this.#decoder === decoder) {
                    this.#waiting?.reject(error);
                    this.#waiting = null;
                    this.#decoder = null;
                }
            },
        });
        decoder.configure(config());
        return decoder;
    }
}
