#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds if needed, then loads a server of its own for some minutes and prints figures.
set -euo pipefail
# shellcheck source=deploy/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

usage() {
    cat <<'TEXT'
usage: deploy/soak.sh MINUTES [many|crowd|snapshot|light]
60 % of the time: 16 viewers of 640x360, 8 of them moving. 30 %: 2 viewers, then beside them 100 connections
that read nothing and 50 that come and break off twice a second. 10 %: 2 viewers, then beside them a snapshot.
One of these alone, where chosen. light: 999 viewers who draw by themselves beside one who changes a lamp every 2 s, 20 of
them acknowledge nothing; prints bytes and processor time for each, and how long a change takes to reach them.
Exit status 1 where something is not as expected of two cores that do nothing else: 3 frames a second for each
viewer that moves; at most 10 % lost to the crowd, 20 % to the snapshot; memory that grows by at most 2 % after the
first minute; the light of an undisturbed server within 3 %; nobody lost; nothing that is not finite.
TEXT
}

[[ $# -ge 1 && $# -le 2 && $1 =~ ^[0-9]+(\.[0-9]+)?$ && ${2:-many} =~ ^(many|crowd|snapshot|light)$ ]] ||
    { usage >&2 && exit 2; }
"$root/deploy/setup.sh" --with-tests
cmake --build "$build_dir" --target raybundle_soak raybundle_light_load --parallel "$(build_jobs)"
if [[ ${2:-} == light ]]; then
    ulimit -n 8192
    exec "$build_dir/raybundle_light_load" 999 20 "$(awk "BEGIN {print 60 * $1}")"
fi
exec "$build_dir/raybundle_soak" "$@"
