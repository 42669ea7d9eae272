#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# clang-tidy over the tracked sources of a configured and built build/. Sources that are compiled
# together (a unity build) are checked together, as one file that holds their text: the analyser leaves
# out what it takes for headers. A source is checked again only when it, a file of the project that it
# includes, or .clang-tidy has changed.
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
joined="$build_dir/tidy/joined" # sources put together, and how to compile them
export root joined stamps analyser_mode checks

# Lines "source<TAB>dependency..." of the project's own files, from ninja's dependency log. The source
# is one that CMake has made where it compiles some of them together.
project_dependencies() {
    ninja -C "$build_dir" -t deps | awk -v root="$root/" -v build="$build_dir/" '
        function flush() { if (line != "") print line; line = "" }
        /^[^ ]/ { flush(); first = 1; next }
        NF {
            file = $0; sub(/^ +/, "", file)
            if (file !~ /^\//) file = build file  # ccache may write paths so
            while (sub(/[^\/]+\/\.\.\//, "", file)) {}
            own = index(file, root) == 1 && index(file, build) != 1
            unity = index(file, build) == 1 && file ~ /\/Unity\/unity_[0-9]+_cxx\.cxx$/
            if (first) { if (own || unity) line = file; first = 0 }
            else if (own && line != "") line = line "\t" file
        }
        END { flush() }'
}

# Whether CMake has made a source of others; join_sources.py has put the text of those together.
is_unity() { [[ $1 == "$build_dir"/*/Unity/unity_*_cxx.cxx ]]; }

# Where the text of a source is.
text_of() {
    if is_unity "$1"; then
        local name=${1#"$build_dir"/}
        printf '%s/%s\n' "$joined" "${name//\//_}"
    else
        printf '%s\n' "$1"
    fi
}

# Names places in joined text ($1) as those of the sources.
original_places() {
    awk -v joined="$1" '
        BEGIN {
            while ((getline line < joined) > 0) {
                ++count
                if (line ~ /^#line 1 "/) { split(line, part, "\""); file = part[2]; start = count }
                if (file != "") { name[count] = file; offset[count] = start }
            }
        }
        index($0, joined ":") == 1 && (substr($0, length(joined) + 2) + 0) in name {
            rest = substr($0, length(joined) + 2); at = rest + 0; sub(/^[0-9]+/, "", rest)
            $0 = name[at] ":" at - offset[at] rest
        }
        { print }'
}

# Checks one source; $1 is its stamp, $2 the source. The build's own warnings are GCC's, some of
# which clang does not know.
tidy_one() {
    local log own="$checks" text
    text=$(text_of "$2")
    case $2 in
        "$root"/tests/* | "$build_dir"/tests/*)
            own+=",-clang-analyzer-*" # 20 s a file, all in gtest's macros
            ;;
    esac
    if log=$(clang-tidy -p "$joined" --quiet --checks="${own#,}" \
        --extra-arg=-Wno-unknown-warning-option \
        --extra-arg={-Xclang,-analyzer-config,-Xclang,mode="$analyser_mode"} "$text" 2>&1); then
        touch "$stamps/$1"
        printf 'tidy: %s\n' "${2#"$root"/}"
    else
        original_places "$text" <<<"$log"
        printf '%s\n' "tidy: FAILED ${2#"$root"/}"
        return 1
    fi
}
export -f is_unity text_of original_places tidy_one

cd "$root"
mkdir -p "$stamps"
declare -A tracked=()
while IFS= read -r -d '' file; do
    tracked["$root/$file"]=1
done < <(git -c safe.directory="$root" ls-files -z -- "${sources[@]}")

# Whether one of the files is to be checked.
any_tracked() {
    local file
    for file in "$@"; do
        [[ -z ${tracked[$file]:-} ]] || return 0
    done
    return 1
}

[[ -f $build_dir/compile_commands.json ]] ||
    die "clang-tidy: nothing is built; run deploy/setup.sh --with-tests"
python3 "$root/deploy/join_sources.py" "$build_dir"
work=()
declare -A seen=()
while IFS=$'\t' read -r -a files; do
    source_file=${files[0]}
    [[ -z ${seen[$source_file]:-} ]] || continue
    any_tracked "${files[@]}" || continue
    seen[$source_file]=1
    stamp=$(cat .clang-tidy "${files[@]}" | sha256sum | cut -c1-32)
    [[ -e $stamps/$stamp ]] || work+=("$stamp" "$source_file")
done < <(project_dependencies)

# An empty list would pass without having looked at anything.
((${#seen[@]} > 0)) || die "clang-tidy: no compiled sources found; run deploy/setup.sh --with-tests"
echo "${#seen[@]} sources, $((${#work[@]} / 2)) to check"
((${#work[@]} == 0)) ||
    printf '%s\0' "${work[@]}" | xargs -0 -n 2 -P "$(nproc)" bash -c 'tidy_one "$@"' tidy
