// SPDX-License-Identifier: Apache-2.0
// Frames: taken apart, decoded newest first, acknowledged after decoding.

import assert from 'node:assert/strict';
import {beforeEach, describe, it} from 'node:test';

import {FrameReceiver, parseFrame} from '../../client_web/net/frame_receiver.js';

/**
 * A frame on the wire.
 *
 * @param {object} header
 * @param {number[]} image
 */
function message(header, image = [1, 2, 3]) {
    const text = new TextEncoder().encode(JSON.stringify(header));
    const bytes = new Uint8Array(4 + text.length + image.length);
    new DataView(bytes.buffer).setUint32(0, text.length, true);
    bytes.set(text, 4);
    bytes.set(image, 4 + text.length);
    return bytes.buffer;
}

const frame = (number) => message({frame: number, codec: 'JPEG', cameraId: 0});

describe('a binary message', () => {
    it('is taken apart into header and image', () => {
        const {header, image} = parseFrame(message({frame: 7, codec: 'PNG'}, [9, 8]));
        assert.deepEqual(header, {frame: 7, codec: 'PNG'});
        assert.deepEqual([...image], [9, 8]);
    });

    it('may have depths at its end', () => {
        const {image, depths} = parseFrame(message({frame: 7, codec: 'PNG', depthBytes: 2}, [9, 8, 7]));
        assert.deepEqual([[...image], [...depths]], [[9], [8, 7]]);
        assert.equal(parseFrame(frame(1)).depths.length, 0);
        for (const depthBytes of [4, -1]) {
            assert.throws(() => parseFrame(message({frame: 7, codec: 'PNG', depthBytes}, [9, 8, 7])));
        }
    });

    it('is refused where it is no frame', () => {
        const tooLong = message({frame: 1, codec: 'JPEG'});
        new DataView(tooLong).setUint32(0, 4000, true);
        const notJson = frame(1);
        new Uint8Array(notJson)[4] = 0x78;
        const wrong = [new ArrayBuffer(3), tooLong, notJson, message({codec: 'JPEG'})];
        wrong.push(message({frame: 1, codec: 'GIF'}), message([1]));
        for (const bytes of wrong) {
            assert.throws(() => parseFrame(bytes));
        }
    });
});

describe('the receiver of frames', () => {
    /** @type {string[]} */
    let log;
    /** @type {FrameReceiver} */
    let receiver;
    /** @type {((image: object) => void)[]} */
    let decoding;

    const settle = () => new Promise((resolve) => setTimeout(resolve, 0));
    const decodeNext = async () => {
        decoding.shift()({close: () => log.push('close')});
        await settle();
    };

    beforeEach(() => {
        log = [];
        decoding = [];
        globalThis.createImageBitmap = () => new Promise((resolve) => decoding.push(resolve));
        receiver = new FrameReceiver({
            show: ({header}) => log.push(`show ${header.frame}`),
            acknowledge: (number) => log.push(`ack ${number}`),
            fail: () => log.push('fail'),
        });
    });

    it('acknowledges as soon as it is decoded, before it is shown, and closes the image', async () => {
        receiver.push(frame(1));
        await settle();
        assert.deepEqual(log, []);
        await decodeNext();
        assert.deepEqual(log, ['ack 1', 'show 1', 'close']);
    });

    it('decodes only the newest of those that arrive meanwhile', async () => {
        [1, 2, 3, 4].forEach((number) => receiver.push(frame(number)));
        await decodeNext();
        await decodeNext();
        assert.equal(decoding.length, 0);
        assert.deepEqual(
            log.filter((entry) => entry.startsWith('show')),
            ['show 1', 'show 4'],
        );
    });

    it('says nothing of a frame of the last connection', async () => {
        receiver.push(frame(1));
        receiver.reset();
        receiver.push(frame(1));
        await decodeNext();
        assert.deepEqual(log, ['close']);
        await decodeNext();
        assert.deepEqual(log, ['close', 'ack 1', 'show 1', 'close']);
    });

    it('acknowledges what it cannot decode, so that the stream goes on', async () => {
        globalThis.createImageBitmap = () => Promise.reject(new Error('broken'));
        receiver.push(frame(5));
        await settle();
        assert.deepEqual(log, ['fail', 'ack 5']);
    });

    describe('of a video', () => {
        const vp9 = (number, key) => message({frame: number, codec: 'VP9', key, cameraId: 0});
        /** What the decoder does with each chunk: a picture comes out, or it fails. */
        let works;

        beforeEach(() => {
            works = true;
            globalThis.EncodedVideoChunk = class {
                constructor(chunk) {
                    Object.assign(this, chunk);
                }
            };
            globalThis.VideoDecoder = class {
                state = 'configured';
                fresh = true;
                constructor(callbacks) {
                    this.callbacks = callbacks;
                }
                configure() {}
                close() {
                    this.state = 'closed';
                }
                decode(chunk) {
                    assert.ok(!this.fresh || chunk.type === 'key', 'a decoder begins with a key frame');
                    this.fresh = false;
                    log.push(chunk.type);
                    queueMicrotask(() =>
                        works ? this.callbacks.output({close: () => {}}) : this.callbacks.error(new Error('broken')),
                    );
                }
            };
            globalThis.createImageBitmap = async () => ({close: () => {}});
            receiver.sink.acknowledge = (number, ms, wantsKey) => log.push(`ack ${number}${wantsKey ? ' key' : ''}`);
            receiver.sink.videoFailed = () => log.push('no video');
        });

        it('decodes all from the last key frame on, in order', async () => {
            receiver.paused = true;
            [vp9(1, true), vp9(2, false), vp9(3, true), vp9(4, false), vp9(5, false)].forEach((m) => receiver.push(m));
            receiver.paused = false;
            await settle();
            await settle();
            const shown = ['key', 'ack 3', 'show 3', 'delta', 'ack 4', 'show 4', 'delta', 'ack 5', 'show 5'];
            assert.deepEqual(log, shown);
            log = [];
            receiver.push(frame(6));
            receiver.push(vp9(7, true));
            await settle();
            assert.deepEqual(log, ['ack 6', 'show 6', 'key', 'ack 7', 'show 7']);
        });

        it('asks for a key frame once where one cannot be decoded, and gives up where that fails, too', async () => {
            receiver.push(vp9(1, true));
            await settle();
            works = false;
            log = [];
            receiver.push(vp9(2, false));
            await settle();
            receiver.push(vp9(3, false));
            await settle();
            assert.deepEqual(log, ['delta', 'fail', 'ack 2 key', 'ack 3']);
            log = [];
            receiver.push(vp9(4, true));
            await settle();
            assert.deepEqual(log, ['key', 'no video', 'fail', 'ack 4 key']);
        });

        it('keeps no more of them than the server has on their way', async () => {
            receiver.paused = true;
            for (let number = 1; number <= 40; ++number) {
                receiver.push(vp9(number, number === 1));
            }
            receiver.paused = false;
            await settle();
            assert.equal(log.filter((entry) => entry.startsWith('ack')).length, 40 - 2 * 16);
            assert.ok(log[0].endsWith('key') && !log.some((entry) => entry.startsWith('show')), `${log}`);
        });
    });

    it('neither decodes nor acknowledges while paused', async () => {
        receiver.paused = true;
        receiver.push(frame(1));
        receiver.push(frame(2));
        await settle();
        assert.equal(decoding.length, 0);
        receiver.paused = false;
        await decodeNext();
        assert.deepEqual(log, ['ack 2', 'show 2', 'close']);
    });
});
