// SPDX-License-Identifier: Apache-2.0
// Checks the JSDoc types of client_web.

import {spawnSync} from 'node:child_process';
import {createRequire} from 'node:module';
import {fileURLToPath} from 'node:url';

const project = fileURLToPath(new URL('tsconfig.json', import.meta.url));
let compiler;
try {
    compiler = createRequire(import.meta.url).resolve('typescript/bin/tsc');
} catch {
    console.error('typescript is missing: run `npm ci` in tests/browser');
    process.exit(1);
}
const {status} = spawnSync(process.execPath, [compiler, '-p', project], {stdio: 'inherit'});
process.exit(status ?? 1);
