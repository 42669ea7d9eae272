#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# clang-tidy over the tracked sources of a configured and built build/. A file is checked again only
# when it, a header of the project that it includes, or .clang-tidy has changed.
# usage: deploy/tidy.sh [--deep]   --deep: all checks of .clang-tidy, and the static analyser follows calls
# further, and the tests are checked too: four times as slow. Without it only the checks that have found
# real defects here.
set -euo pipefail
# shellcheck source=deploy/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

analyser_mode=shallow
sources=('server/*.cpp')
checks="-*,clang-analyzer-*,-clang-analyzer-optin.cplusplus.VirtualCall"
checks+=",-clang-analyzer-optin.performance.Padding,bugprone-use-after-move"
checks+=",bugprone-integer-division,bugprone-misplaced-widening-cast,bugprone-dangling-handle"
if [[ ${1:-} == --deep ]]; then
    analyser_mode=deep
    sources+=('tests/*.cpp')
    checks="" # what .clang-tidy says
fi
stamps="$build_dir/tidy/$analyser_mode"
export root stamps analyser_mode checks

# Lines "source<TAB>dependency..." of the project's own files, from ninja's dependency log.
project_dependencies() {
    ninja -C "$build_dir" -t deps | awk -v root="$root/" -v build="$build_dir/" '
        function flush() { if (line != "") print line; line = "" }
        /^[^ ]/ { flush(); first = 1; next }
        NF {
            file = $0; sub(/^ +/, "", file)
            if (file !~ /^\//) file = build file  # ccache may write paths so
            while (sub(/[^\/]+\/\.\.\//, "", file)) {}
            own = index(file, root) == 1 && index(file, build) != 1
            if (first) { if (own) line = file; first = 0 }
            else if (own && line != "") line = line "\t" file
        }
        END { flush() }'
}

# Checks one source; $1 is its stamp, $2 the source. The build's own warnings are GCC's, some of
# which clang does not know.
tidy_one() {
    local log own="$checks"
    [[ $2 != "$root"/tests/* ]] || own+=",-clang-analyzer-*" # 20 s a file, all in gtest's macros
    if log=$(clang-tidy -p "$build_dir" --quiet --checks="${own#,}" \
        --extra-arg=-Wno-unknown-warning-option \
        --extra-arg={-Xclang,-analyzer-config,-Xclang,mode="$analyser_mode"} "$2" 2>&1); then
        touch "$stamps/$1"
        printf 'tidy: %s\n' "${2#"$PWD"/}"
    else
        printf '%s\n' "$log" "tidy: FAILED ${2#"$PWD"/}"
        return 1
    fi
}
export -f tidy_one

cd "$root"
mkdir -p "$stamps"
declare -A tracked=()
while IFS= read -r -d '' file; do
    tracked["$root/$file"]=1
done < <(git -c safe.directory="$root" ls-files -z -- "${sources[@]}")

work=()
declare -A seen=()
while IFS=$'\t' read -r -a files; do
    source_file=${files[0]}
    [[ -n ${tracked[$source_file]:-} && -z ${seen[$source_file]:-} ]] || continue
    seen[$source_file]=1
    stamp=$(cat .clang-tidy "${files[@]}" | sha256sum | cut -c1-32)
    [[ -e $stamps/$stamp ]] || work+=("$stamp" "$source_file")
done < <(project_dependencies)

# An empty list would pass without having looked at anything.
((${#seen[@]} > 0)) || die "clang-tidy: no compiled sources found; run deploy/setup.sh --with-tests"
echo "${#seen[@]} sources, $((${#work[@]} / 2)) to check"
((${#work[@]} == 0)) ||
    printf '%s\0' "${work[@]}" | xargs -0 -n 2 -P "$(nproc)" bash -c 'tidy_one "$@"' tidy
