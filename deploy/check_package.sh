#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs a package on a clean Debian 12 in a folder, starts it there without rights, and asks it how it is.
set -euo pipefail

usage() {
    cat <<'TEXT'
usage: deploy/check_package.sh FILE.deb FOLDER
Needs root and debootstrap. FOLDER gets the Debian, or has one from an earlier run; remove it afterwards.
TEXT
}

[[ $# -eq 2 && -f $1 ]] || { usage >&2 && exit 2; }
package=$1 folder=$2 port=18087
[[ -e $folder/etc/debian_version ]] ||
    debootstrap --variant=minbase bookworm "$folder" http://deb.debian.org/debian
cp "$package" "$folder/tmp/raybundle.deb"
cp /etc/resolv.conf "$folder/etc/resolv.conf"

inside() { chroot "$folder" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive "$@"; }

inside apt-get update -q
inside apt-get install -y -q --no-install-recommends /tmp/raybundle.deb
inside raybundle --version
[[ -f $folder/lib/systemd/system/raybundle.service && -f $folder/usr/share/doc/raybundle/raybundle.json ]]
# As the unit does: with the example configuration, as a user without rights, its own state folder.
inside install -d -o nobody /var/lib/raybundle /etc/raybundle
inside install -m 644 /usr/share/doc/raybundle/raybundle.json /etc/raybundle/raybundle.json
chroot --userspec=nobody:nogroup "$folder" /usr/bin/env -i PATH=/usr/bin:/bin \
    raybundle serve --config /etc/raybundle/raybundle.json --listen "127.0.0.1:$port" &
server=$!
trap 'kill "$server" 2>/dev/null || true' EXIT
for ((i = 0; i < 120; ++i)); do
    if curl -fsS "http://127.0.0.1:$port/healthz" 2>/dev/null; then
        curl -fsS "http://127.0.0.1:$port/" | grep -q '<html'
        curl -fsS "http://127.0.0.1:$port/metrics" | grep raybundle_epoch
        [[ -s $folder/var/lib/raybundle/session.db ]]
        kill "$server"
        wait "$server"
        echo "the package installs, starts and serves"
        exit 0
    fi
    sleep 1
done
echo "the package does not serve" >&2
exit 1
