#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Writes the TypeScript declarations of client_web/raybundle.js, from the types in its comments.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

usage() {
    cat <<'TEXT'
usage: deploy/client_types.sh FOLDER
Writes raybundle.d.ts, and those of the files that it uses, into FOLDER: put them beside the .js files.
Needs the packages of tests/browser (npm ci).
TEXT
}

[[ $# == 1 && $1 != -h && $1 != --help ]] || { usage; exit 2; }
mkdir -p "$1"
node "$root/tests/browser/node_modules/typescript/bin/tsc" --allowJs --declaration --emitDeclarationOnly --strict \
    --target es2022 --module esnext --moduleResolution bundler --lib es2023,dom,dom.iterable \
    --rootDir "$root/client_web" --outDir "$1" "$root/client_web/raybundle.js"
