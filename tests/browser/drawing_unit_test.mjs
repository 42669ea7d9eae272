// SPDX-License-Identifier: Apache-2.0
// What the page draws by itself, on a WebGL that only counts.

import assert from 'node:assert/strict';
import {afterEach, describe, it, mock} from 'node:test';

import {LiveLight} from '../../client_web/drawing/live_light.js';
import {inverse, placeObjects, placeOf} from '../../client_web/drawing/object_places.js';
import {Openings, PlateFades, platesOf} from '../../client_web/drawing/luminaire_plates.js';
import {IDENTITY, length} from '../../client_web/ui/vector.js';
import {Renderer} from '../../client_web/walkthrough/renderer.js';

const AT_ZERO = {translation: {x: 0, y: 0, z: 0}, rotation: {x: 0, y: 0, z: 0, w: 1}, scale: {x: 1, y: 1, z: 1}};
const object = (id, transform) => ({id, worldFromParent: IDENTITY, transform: {...AT_ZERO, ...transform}});

/** A context whose calls do nothing; `alive` has what has been made and not deleted. */
function countingGl() {
    const alive = new Set();
    const gl = new Proxy({}, {
        get: (_, name) => {
            if (/^create/.test(name)) {
                return () => {
                    const thing = {name};
                    alive.add(thing);
                    return thing;
                };
            }
            if (/^delete/.test(name)) {
                return (thing) => alive.delete(thing);
            }
            return () => (name === 'getProgramParameter' ? true : name === 'isContextLost' ? false : null);
        },
    });
    return {gl, alive};
}

const CHUNK = {
    material: 0, vertexCount: 3, indexCount: 3, emission: [0, 0, 0], vertices: 0, indices: 36, uvs: 44, colours: 68,
    front: 0, back: null, emissions: null, object: 0,
};
const MANIFEST = {
    format: 'raybundle-walkthrough', version: 1, name: 'triangle', geometry: {file: 'geometry.bin', bytes: 80},
    light: {file: null, bytes: 12, unit: 1}, grid: {origin: [0, 0, 0], step: [1, 1, 1]},
    bounds: {min: [0, 0, 0], max: [1, 1, 1]}, cameras: [],
    sky: {uniform: [0, 0, 0], texels: null, width: 0, height: 0, sun: null},
    materials: [{name: '', baseColour: [1, 1, 1], texture: null, alphaCutoff: null, albedo: null,
        transmittance: [0, 0, 0], transparency: [0, 0, 0], unlit: false}],
    textures: [], chunks: [CHUNK], objects: [{worldFromObject: IDENTITY}],
};
const SCENE_DATA = {manifest: MANIFEST, geometry: new ArrayBuffer(80), light: new ArrayBuffer(12), textures: [],
    shaders: {toneCurve: '', falseColour: ''}};

describe('a place that cannot be inverted', () => {
    const flat = [1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 2, 0, 0, 1];

    it('has no inverse', () => {
        assert.equal(inverse(flat), null);
        assert.equal(inverse(new Array(16).fill(NaN)), null);
    });

    it('stays where it is, and can be shifted', () => {
        const stays = object(1, {translation: {x: 2, y: 0, z: 0}, scale: {x: 1, y: 0, z: 1}});
        assert.deepEqual([...placeOf(stays, flat)], [...IDENTITY]);
        const shifted = object(1, {translation: {x: 5, y: 1, z: 0}, scale: {x: 1, y: 0, z: 1}});
        assert.deepEqual([...placeOf(shifted, flat)].slice(12, 15), [3, 1, 0]);
    });

    it('says nothing of what it looks like in another size', () => {
        assert.equal(placeOf(object(1, {}), flat), null);
    });

    it('spoils no other object', () => {
        const places = new Map();
        const renderer = {manifest: {objects: [{worldFromObject: flat}, {worldFromObject: IDENTITY}]},
            setPlace: (i, place) => places.set(i, place), hidden: new Set()};
        const scene = {object: (id) => object(id, {})};
        placeObjects(renderer, scene, []);
        assert.deepEqual([...renderer.hidden], [0]);
        assert.deepEqual([...places.get(1)], [...IDENTITY]);
    });
});

describe('objects that have been removed', () => {
    it('are not drawn, and are drawn again when they are back', () => {
        const renderer = {manifest: {objects: [1, 2, 3].map(() => ({worldFromObject: IDENTITY}))}, setPlace: () => {},
            hidden: new Set()};
        placeObjects(renderer, {object: (id) => (id === 2 ? null : object(id, {}))}, [3]);
        assert.deepEqual([...renderer.hidden].sort(), [1, 2]);
        placeObjects(renderer, {object: (id) => object(id, {})}, []);
        assert.equal(renderer.hidden.size, 0);
    });
});

describe('a renderer', () => {
    it('lets go of all that it has on the GPU', () => {
        const {gl, alive} = countingGl();
        const renderer = new Renderer(gl, SCENE_DATA);
        assert.ok(alive.size >= 8, `${alive.size} things`);
        renderer.dispose();
        assert.deepEqual([...alive], []);
    });
});

describe('plates of luminaires', () => {
    const openings = new Map([['panel.ldt', {x: 0.6, y: 0.3, round: false}], ['disc.ies', {x: 0.4, y: 0.4, round: true}]]);
    const light = {photometry: 'panel.ldt', position: {x: 1, y: 2, z: 3}, aim: {x: 0, y: -2, z: 0}, rotation: 0, peak: 360,
        loadedIntensity: 1000, intensity: 500, dim: 0.5, on: true, colour: {x: 1, y: 0.8, z: 0.6}};
    const near = (a, b) => assert.ok(['x', 'y', 'z'].every((k) => Math.abs(a[k] - b[k]) < 1e-9), JSON.stringify([a, b]));

    it('have the luminance of the file\'s largest intensity as it is dimmed', () => {
        const [plate] = platesOf([light], openings);
        plate.radiance.forEach((value, i) => assert.ok(Math.abs(value - 500 * [1, 0.8, 0.6][i]) < 1e-9));
        assert.deepEqual(platesOf([{...light, on: false}], openings)[0].radiance, [0, 0, 0]);
        const [disc] = platesOf([{...light, photometry: 'disc.ies'}], openings);
        assert.ok(Math.abs(disc.radiance[0] - 90 / (0.04 * Math.PI)) < 1e-9);
    });

    it('lie as the server places them', () => {
        const [down] = platesOf([light], openings);
        near(down.halfX, {x: 0.3, y: 0, z: 0});
        near(down.halfY, {x: 0, y: 0, z: -0.15});
        const [turned] = platesOf([{...light, rotation: 90}], openings);
        near(turned.halfX, {x: 0, y: 0, z: 0.3});
        // Aimed at +x, what was +x looks up.
        const [aside] = platesOf([{...light, aim: {x: 1, y: 0, z: 0}}], openings);
        near(aside.halfX, {x: 0, y: 0.3, z: 0});
    });

    it('fade as the light does, evenly in RGB, and the newest setting wins', () => {
        const fades = new PlateFades();
        const set = {...light, id: 7, dim: 0, colour: {x: 1, y: 1, z: 1}};  // what it goes to
        const red = (now) => platesOf(fades.shown([set], now), openings)[0].radiance[0];
        const full = platesOf([{...light, id: 7}], openings)[0].radiance[0];
        fades.take({setLight: {light: 7, dim: 0, fadeSeconds: 2}, lightBefore: {light: 7, dim: 0.5, on: true, intensity: 500, colour: light.colour}}, set, 1000);
        assert.ok(Math.abs(red(1000) - full) < 1e-9);
        assert.ok(Math.abs(red(1500) - 0.75 * full) < 1e-9);
        assert.ok(fades.running(2999));
        assert.equal(red(3000), 0);
        assert.ok(!fades.running(3000));
        // Switched on again on its way, at once.
        fades.take({setLight: {light: 7, dim: 0, fadeSeconds: 2}, lightBefore: {light: 7, dim: 0.5}}, set, 4000);
        fades.take({setLight: {light: 7, dim: 0.5}, lightBefore: {light: 7, dim: 0}}, set, 4500);
        assert.ok(!fades.running(4600));
        assert.deepEqual(fades.shown([set], 4600), [set]);
    });

    it('follow exchanges and removals, and ask again for files that the server has not read', async () => {
        assert.equal(platesOf([], openings).length, 0);
        const [exchanged] = platesOf([{...light, photometry: 'disc.ies'}], openings);
        assert.ok(exchanged.round && Math.abs(length(exchanged.halfX) - 0.2) < 1e-9);
        globalThis.location = {href: 'http://server/'};
        const lists = [
            [{name: 'panel.ldt', problems: ['not read yet: ask again']}],
            [{name: 'panel.ldt', problems: [], opening: {x: 0.6, y: 0.3, round: false}}],
        ];
        let asked = 0;
        const fetched = mock.method(globalThis, 'fetch', async () => ({ok: true, json: async () => lists[asked++]}));
        const known = new Openings();
        assert.equal(platesOf([light], known.known).length, 0);
        await known.lookUp([light], () => ({}));
        assert.equal(known.known.size, 0);
        await known.lookUp([light], () => ({}));
        assert.equal(platesOf([light], known.known).length, 1);
        await known.lookUp([light], () => ({}));
        assert.equal(asked, 2);
        fetched.mock.restore();
    });

    it('are those of known files that have a place', () => {
        assert.deepEqual(platesOf([{...light, photometry: 'other.ies'}, {...light, position: undefined}], openings), []);
    });
});

describe('light of a scene', () => {
    afterEach(() => mock.restoreAll());

    /** Light of a server, of which all but the light itself is there. values 0: no light is waited for. */
    function liveLight() {
        globalThis.location = {href: 'http://server/'};
        const asked = [];
        mock.method(globalThis, 'fetch', async (file) => {
            asked.push(file);
            const body = file.endsWith('.json') ? JSON.stringify({...MANIFEST, chunks: [], light: {...MANIFEST.light, bytes: 0}})
                : file.endsWith('.bin') ? new Uint8Array(80) : '';
            return new Response(body);
        });
        const {gl, alive} = countingGl();
        const client = Object.assign(new EventTarget(), {send: () => {}});
        const light = new LiveLight(client, gl);
        const tell = (url) => client.dispatchEvent(
            new CustomEvent('message', {detail: {lightScene: {scene: 1, url, values: 0, blockValues: 1}}}));
        /** Loading takes many turns of the event loop, none of which waits for time. */
        const quiet = async () => {
            for (let i = 0; i < 50; ++i) {
                await new Promise((resolve) => setImmediate(resolve));
            }
        };
        return {light, tell, quiet, alive, asked};
    }

    it('is no longer there once the server has another one, also while nothing is taken in', async () => {
        const {light, tell, quiet, alive} = liveLight();
        tell('/light/a/');
        await quiet();
        assert.ok(light.complete, light.problem);
        light.ignored = true;
        let forgotten = 0;
        light.addEventListener('forgotten', () => ++forgotten);
        tell('/light/b/');
        await quiet();
        assert.deepEqual([light.complete, light.renderer, alive.size, forgotten], [false, null, 0, 1]);
    });

    it('does not come back where it is forgotten while it is loaded', async () => {
        const {light, tell, quiet, alive} = liveLight();
        tell('/light/a/');
        await Promise.resolve();
        light.forget();
        tell('/light/b/');
        light.forget();
        await quiet();
        tell('/light/c/');
        light.ignored = true;
        await quiet();
        assert.deepEqual([light.complete, alive.size], [false, 0]);
    });

    it('of a doubtful scene is drawn again once the server has confirmed it', async () => {
        const {light, tell, quiet, asked} = liveLight();
        tell('/light/a/');
        await quiet();
        const loaded = asked.length;
        light.doubt();
        assert.equal(light.complete, false);
        tell('/light/a/');
        await quiet();
        assert.ok(light.complete);
        assert.equal(asked.length, loaded, 'nothing is loaded anew');
    });
});
