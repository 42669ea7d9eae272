// SPDX-License-Identifier: Apache-2.0
// One's own changes are taken back, and nobody else's; what counts as a change under way.

import assert from 'node:assert/strict';
import {describe, it} from 'node:test';

import {RaybundleClient} from '../../client_web/net/raybundle_client.js';
import {History} from '../../client_web/scene/history.js';
import {SurfaceChange} from '../../client_web/scene/surface_change.js';
import {Things} from '../../client_web/scene/things.js';

/** A client to which a server announces changes before it answers. */
function clientOf(changesOf) {
    const sent = [];
    const client = Object.assign(new EventTarget(), {
        welcome: {viewer: 1},
        request: (body) => {
            sent.push(body);
            for (const detail of changesOf(body)) {
                client.dispatchEvent(new CustomEvent('sceneChanged', {detail}));
            }
            return {answer: Promise.resolve({ok: {}})};
        },
    });
    return {client, sent};
}

describe('an exchanged photometric file', () => {
    it('is taken back as it was for each light, with the flux that it had', async () => {
        const {client, sent} = clientOf(({setLight}) => (setLight.sameType
            ? [
                {by: 1, setLight: {light: 4, photometry: 'b.ies'}, lightBefore: {light: 4, photometry: '', intensity: 800}},
                {by: 1, setLight: {light: 5, photometry: 'b.ies'}, lightBefore: {light: 5, photometry: 'a.ies', intensity: 900}},
                {by: 2, setLight: {light: 6, photometry: 'c.ies'}, lightBefore: {light: 6, photometry: '', intensity: 7}},
            ]
            : []));
        const history = new History();
        const change = new SurfaceChange({client, history, refused: assert.fail}, 'setLight', [{light: 4}], 'desk', () => ({
            photometry: 'own.ldt', sameType: true,
        }));
        await change.done({photometry: 'b.ies', sameType: true});
        await history.undo();
        assert.deepEqual(sent.slice(1), [
            {setLight: {light: 4, photometry: '', intensity: 800}},
            {setLight: {light: 5, photometry: 'a.ies', intensity: 900}},
        ]);
        await history.redo();
        assert.deepEqual(sent.at(-1), {setLight: {light: 4, photometry: 'b.ies', sameType: true}});
    });
});

describe('luminaires that have been added', () => {
    const added = (by, light) => ({by, addLuminaire: {light}});
    const make = async () => {
        const {client, sent} = clientOf(({addLuminaire}) => (addLuminaire?.photometry ? [added(1, 11), added(2, 12), added(1, 13)] : []));
        const history = new History();
        const things = Object.create(Things.prototype);
        Object.assign(things, {history, app: {client, ask: (body) => client.request(body).answer}});
        assert.ok(await things.addLuminaires({photometry: 'a.ies', columns: 2}, 'two'));
        return {history, sent};
    };

    it('are taken away without those that somebody else has added meanwhile', async () => {
        const {history, sent} = await make();
        await history.undo();
        assert.deepEqual(sent.slice(1), [{removeLight: {light: 11}}, {removeLight: {light: 13}}]);
    });

    it('are not taken away unasked where somebody else has changed any of them', async () => {
        const {history, sent} = await make();
        history.noteOther('light 13', 'Ann');
        let asked = 0;
        history.addEventListener('hesitate', () => ++asked);
        await history.undo();
        assert.deepEqual([asked, sent.length], [1, 1]);
    });
});

describe('a change under way', () => {
    it('is one of the scene; pins, replies, zones, requirements and viewpoints are none', () => {
        globalThis.WebSocket = class {
            static OPEN = 1;
            readyState = 1;
            send() {}
            close() {}
        };
        const client = new RaybundleClient({url: 'ws://a/ws', token: 'abc', viewport: () => ({width: 8, height: 6})});
        client.connect();
        const under = (body) => {
            client.request(body).answer.catch(() => {});
            return client.changing;
        };
        try {
            for (const name of ['addPin', 'removePin', 'setPin', 'replyToPin', 'measure', 'setZone', 'setRequirement',
                'removeRequirement', 'saveViewpoint', 'removeViewpoint', 'saveLightingScene', 'removeLightingScene']) {
                assert.equal(under({[name]: {}}), false, name);
            }
            assert.equal(under({moveObject: {}}), true);
            assert.deepEqual(client.httpHeaders, {Authorization: 'Bearer abc'});
        } finally {
            client.close();  // its timers would keep a failed test from its end
        }
    });
});
