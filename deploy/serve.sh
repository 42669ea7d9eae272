#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Sets up if needed, then serves a scene; the daemon prints the address.
set -euo pipefail
# shellcheck source=deploy/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

usage() {
    cat <<'TEXT'
usage: deploy/serve.sh [SCENE.gltf] [options of "raybundle serve"]
Installs and builds what is missing, then serves the scene over HTTP and WebSocket.
Default scene: scenes/living_room.gltf; default address: http://127.0.0.1:8080.
Options: --listen ADDRESS:PORT, --config FILE.json, ... ("build/raybundle serve --help" has all)
TEXT
}

# A configuration file is expected to name the scene.
names_a_scene() {
    local argument
    [[ $# -gt 0 && $1 != -* ]] && return 0
    for argument in "$@"; do
        [[ ${argument,,} == *.gltf || ${argument,,} == *.glb || $argument == --config* ]] && return 0
    done
    return 1
}

case "${1:-}" in
    -h | --help) usage && exit 0 ;;
esac
"$root/deploy/setup.sh"
names_a_scene "$@" || set -- "$root/scenes/living_room.gltf" "$@"
exec "$build_dir/raybundle" serve "$@"
