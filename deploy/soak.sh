#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds if needed, then loads a server of its own for some minutes and prints figures.
set -euo pipefail
# shellcheck source=deploy/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

usage() {
    cat <<'TEXT'
usage: deploy/soak.sh MINUTES [many|crowd]
60 % of the time: 16 viewers of 640x360, 8 of them moving. 40 %: 2 viewers, then beside them 100 connections
that read nothing and 50 that come and break off twice a second.
One of both alone, where chosen.
Exit status 1: memory has grown by more than 2 % after settling, a viewer was lost, or something was not finite.
TEXT
}

[[ $# -ge 1 && $# -le 2 && $1 =~ ^[0-9]+(\.[0-9]+)?$ && ${2:-many} =~ ^(many|crowd)$ ]] || { usage >&2 && exit 2; }
"$root/deploy/setup.sh" --with-tests
exec "$build_dir/raybundle_soak" "$@"
