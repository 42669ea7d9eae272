#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds the wheel of protocol/python without a network, by Debian's python3-setuptools, python3-wheel and protoc.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

usage() {
    cat <<'TEXT'
usage: deploy/python_wheel.sh FOLDER
Writes raybundle-VERSION-py3-none-any.whl into FOLDER, and its name to the standard output.
PYTHON names the interpreter (default /usr/bin/python3).
TEXT
}

[[ $# == 1 && $1 != -h && $1 != --help ]] || { usage; exit 2; }
python=${PYTHON:-/usr/bin/python3}
mkdir -p "$1"
folder=$(cd "$1" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# Away from the sources, where builds leave folders of their own.
cp -r "$root/protocol/python/." "$work/"
cp "$root/protocol/raybundle.proto" "$work/"
(cd "$work" && "$python" -W ignore setup.py --quiet bdist_wheel --dist-dir "$folder") >&2
ls "$folder"/raybundle-*-py3-none-any.whl
