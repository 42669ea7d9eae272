#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing on Debian 12 and builds Release into build/.
set -euo pipefail
# shellcheck source=deploy/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

usage() {
    cat <<'TEXT'
usage: deploy/setup.sh [--with-tests | --with-heavy-tests | --install-only]
Installs the packages that are missing (Debian 12) and builds build/raybundle in Release mode.
  --with-tests        build the tests as well
  --with-heavy-tests  and the programs whose tests are all heavy
  --install-only      build nothing
TEXT
}

packages=(
    g++ cmake ninja-build pkg-config ccache
    libcli11-dev libcurl4-openssl-dev libdraco-dev libegl-dev libembree-dev libepoxy-dev libglm-dev
    libhiredis-dev
    libmeshoptimizer-dev libopenimageio-dev libpng-dev libprotobuf-dev libspdlog-dev
    libsqlite3-dev libssl-dev libtbb-dev libtinygltf-dev libturbojpeg0-dev libvpx-dev
    libwebsockets-dev
    nlohmann-json3-dev
    protobuf-compiler
    libegl1 libegl-mesa0 libgl1-mesa-dri
)

# The cache of a checkout that was moved or copied names the old place.
build_dir_is_ours() {
    [[ -f $build_dir/build.ninja ]] &&
        grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$build_dir/CMakeCache.txt"
}

is_on() { grep -qx "$1:BOOL=ON" "$build_dir/CMakeCache.txt"; }

# Configures on the first run and when the presets have changed; later ninja itself re-runs cmake when
# a CMakeLists.txt has. $1: with the tests, $2: with the heavy ones too, ON or OFF.
configure() {
    local tests=$1 heavy=$2
    if ! build_dir_is_ours; then
        say "configuring"
        (cd "$root" && cmake --fresh --preset release -DRAYBUNDLE_TESTS="$tests")
    elif [[ $root/CMakePresets.json -nt $build_dir/CMakeCache.txt ]]; then
        say "configuring again: the presets have changed"
        (cd "$root" && cmake --preset release)
        touch "$build_dir/CMakeCache.txt"
    fi
    if [[ $tests == ON ]] && ! is_on RAYBUNDLE_TESTS || [[ $heavy == ON ]] && ! is_on RAYBUNDLE_HEAVY_TESTS; then
        say "configuring the tests"
        (cd "$root" && cmake --preset release -DRAYBUNDLE_TESTS=ON -DRAYBUNDLE_HEAVY_TESTS="$heavy")
    fi
}

main() {
    local tests=OFF heavy=OFF target=raybundle
    case "${1:-}" in
        "") ;;
        --with-tests) tests=ON target=all ;;
        --with-heavy-tests) tests=ON heavy=ON target=all ;;
        --install-only) install_packages "${packages[@]}" && exit 0 ;;
        -h | --help) usage && exit 0 ;;
        *) usage >&2 && exit 2 ;;
    esac
    install_packages "${packages[@]}"
    mkdir -p "$build_dir"
    exec 9>"$build_dir/.setup.lock"
    flock 9 # two builds in one folder would spoil each other
    configure "$tests" "$heavy" || die "raybundle setup: FAILED to configure (see above)"
    say "building with $(build_jobs) jobs"
    cmake --build "$build_dir" --target "$target" --parallel "$(build_jobs)" ||
        die "raybundle setup: FAILED to build (see above)"
    echo "raybundle setup: build/raybundle is ready"
}

main "$@"
