#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Starts Redis, a server or a worker of compose.yaml with the password of the file secret: it is on no command line, and in none of
# the container's settings.  with_password.sh redis CONFIGURATION | with_password.sh serve|work OPTIONS
set -eu
password=$(cat "${PASSWORD_FILE:-/run/secrets/redis_password}")
what=$1
shift
if [ "$what" = redis ]; then
    exec redis-server - <<EOF
$(cat "$1")
requirepass "$password"
EOF
fi
export RAYBUNDLE_REDIS_PASSWORD="$password"
exec raybundle "$what" "$@"
