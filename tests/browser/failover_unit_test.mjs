// SPDX-License-Identifier: Apache-2.0
// A client with several servers goes on with the next one where one is lost.

import assert from 'node:assert/strict';
import {mock, test} from 'node:test';

import {RaybundleClient} from '../../client_web/net/raybundle_client.js';

/** A socket that the test opens and closes. */
class FakeSocket {
    static OPEN = 1;
    /** @type {FakeSocket[]} */
    static made = [];

    /** @param {string} url */
    constructor(url) {
        this.url = url;
        this.readyState = FakeSocket.OPEN;
        FakeSocket.made.push(this);
    }

    send() {}
    close() {}
}

test('the next server is tried where one is lost, and the first again after the last', () => {
    mock.timers.enable({apis: ['setTimeout', 'setInterval']});
    globalThis.WebSocket = /** @type {any} */ (FakeSocket);
    const client = new RaybundleClient({url: ['ws://a/ws', 'ws://b/ws'], viewport: () => ({width: 8, height: 6})});
    client.connect();
    for (let i = 0; i < 3; ++i) {
        FakeSocket.made.at(-1).onclose({reason: ''});
        mock.timers.tick(20000);  // longer than any wait
    }
    assert.deepEqual(FakeSocket.made.map(({url}) => url), ['ws://a/ws', 'ws://b/ws', 'ws://a/ws', 'ws://b/ws']);
    assert.equal(client.address, 'ws://b/ws');
    client.close();
    mock.timers.reset();
});
