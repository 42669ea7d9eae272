// SPDX-License-Identifier: Apache-2.0
// The declarations of raybundle.js serve a program in TypeScript: what is right compiles, what is wrong does not.

import assert from 'node:assert/strict';
import {spawnSync} from 'node:child_process';
import {mkdtempSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import path from 'node:path';
import {after, test} from 'node:test';
import {fileURLToPath} from 'node:url';

const root = path.resolve(path.dirname(fileURLToPath(import.meta.url)), '../..');
const folder = mkdtempSync(path.join(tmpdir(), 'raybundle_types_'));
after(() => rmSync(folder, {recursive: true}));
const made = spawnSync(path.join(root, 'deploy/client_types.sh'), [folder], {encoding: 'utf8'});

const HEAD = `import {RaybundleClient, RaybundleView, socketOf} from './raybundle.js';
const client = new RaybundleClient({url: ['ws://a/ws', socketOf('http://b/')], viewport: () => ({width: 8, height: 6})});
`;

/** @param {string} text @returns {string} what the compiler says; empty: nothing */
function compile(text) {
    writeFileSync(path.join(folder, 'program.ts'), HEAD + text);
    const compiler = path.join(root, 'tests/browser/node_modules/typescript/bin/tsc');
    const done = spawnSync(process.execPath, [compiler, '--strict', '--noEmit', '--target', 'es2022', '--module', 'esnext',
        '--moduleResolution', 'bundler', '--lib', 'es2023,dom,dom.iterable', 'program.ts'], {cwd: folder, encoding: 'utf8'});
    return done.stdout;
}

test('they are made', () => assert.equal(made.status, 0, made.stdout + made.stderr));

test('a program that uses the client and the element compiles', () => {
    const said = compile(`client.connect();
const name: string | undefined = client.welcome?.scene.objects[0]?.name;
client.request({probe: {}}).answer.then((message) => message.probeResult?.illuminance?.toFixed(1));
const view = document.querySelector('raybundle-view') as RaybundleView;
view.flyTo(name ?? 'front');
`);
    assert.equal(said, '');
});

test('one that misuses them does not', () => {
    assert.match(compile('client.connect(7);\n'), /Expected 0 arguments/);
    assert.match(compile('const id: string = client.welcome!.scene.objects[0].id;\n'), /not assignable to type 'string'/);
    assert.match(compile('new RaybundleClient({url: 5, viewport: () => ({width: 8, height: 6})});\n'), /not assignable/);
});
