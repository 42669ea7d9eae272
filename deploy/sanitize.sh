#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds with sanitizers and runs what talks to strangers or shares memory among threads.
set -euo pipefail
# shellcheck source=deploy/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

usage() {
    cat <<'TEXT'
usage: deploy/sanitize.sh asan | tsan | fuzz SECONDS
  asan          the tests of the protocol and the daemon under AddressSanitizer and UBSan, in build-asan/
  tsan          the same under ThreadSanitizer, in build-tsan/
  fuzz SECONDS  libFuzzer, so long on each of the six targets, in build-asan/
Needs what deploy/setup.sh and deploy/test.sh install, and clang for asan and fuzz. The first build takes as long as a
normal one or longer, the tests some ten minutes on two cores. What was found is printed; exit status 1 where anything
was.
TEXT
}

fuzz_targets=(wire_text wire_binary session config ies gltf)
most_seconds=3600 # of one test program: what takes longer hangs
test_programs=(raybundle_scheduling_tests raybundle_protocol_tests raybundle_flow_tests raybundle_daemon_tests)

build() {
    local preset=$1
    shift
    (cd "$root" && cmake --preset "$preset" -DRAYBUNDLE_TESTS=ON >/dev/null)
    cmake --build "$root/build-$preset" --parallel "$(build_jobs)" --target "$@"
}

# A library that keeps drivers loaded: of what a driver that is gone has lost, nobody can tell whose it was, and
# ThreadSanitizer ends where a library of its suppressions goes.
keep_loaded() {
    local library="$1/keep_loaded.so"
    printf 'int dlclose(void *library) { return library == 0; }\n' |
        cc -shared -fPIC -x c -o "$library" -
    printf '%s\n' "$library"
}

# Runs the tests of a build. The servers that they start and kill report into files, too.
run_tests() {
    local folder="$root/build-$1" reports="$root/build-$1/reports" preload program failed=0
    preload=$(keep_loaded "$folder")
    rm -rf "$reports"
    mkdir -p "$reports"
    export LSAN_OPTIONS="suppressions=$root/tests/lsan.supp:print_suppressions=0"
    export ASAN_OPTIONS="log_path=$reports/asan:detect_leaks=1"
    export UBSAN_OPTIONS="log_path=$reports/ubsan:print_stacktrace=1"
    export TSAN_OPTIONS="suppressions=$root/tests/tsan.supp:log_path=$reports/tsan:history_size=4"
    for program in "${test_programs[@]}"; do
        say "$program"
        # Each shader that LLVM has compiled for the software renderer holds a lock while the next one
        # is; where there are 64, the search for deadlocks gives up and takes the program with it.
        [[ $program != raybundle_daemon_tests ]] || TSAN_OPTIONS+=":detect_deadlocks=0"
        (cd "$folder" && LD_PRELOAD="$preload" timeout "$most_seconds" \
            "./$program" --gtest_brief=1 --gtest_filter='-*Heavy*') || failed=1
    done
    if compgen -G "$reports/*" >/dev/null; then
        cat "$reports"/*
        failed=1
    fi
    return "$failed"
}

# Inputs that make a target fail are left in build-asan/fuzz/.
fuzz() {
    local seconds=$1 folder="$root/build-asan/fuzz" target failed=0
    local json="$root/../shared/data/json" malformed="$root/../shared/data/malformed"
    for target in "${fuzz_targets[@]}"; do
        local -a corpora=("$root/tests/fuzz/corpus/$target")
        case $target in
            gltf) corpora+=("$root/scenes" "$malformed") ;;
            wire_text | config) corpora+=("$json") ;;
        esac
        mapfile -t corpora < <(existing "${corpora[@]}")
        mkdir -p "$folder/$target"
        say "fuzz_$target"
        (cd "$folder" && LSAN_OPTIONS="suppressions=$root/tests/lsan.supp:print_suppressions=0" \
            ASAN_OPTIONS=allocator_may_return_null=1 \
            ../fuzz_"$target" -max_total_time="$seconds" -max_len=70000 -rss_limit_mb=4000 -timeout=25 \
            -print_final_stats=1 "$target" "${corpora[@]}") || failed=1
    done
    return "$failed"
}

existing() {
    local path
    for path in "$@"; do
        [[ ! -d $path ]] || printf '%s\n' "$path"
    done
}

case "${1:-}" in
    asan | tsan)
        [[ $# -eq 1 ]] || { usage >&2 && exit 2; }
        build "$1" raybundle "${test_programs[@]}"
        run_tests "$1" || die "sanitize: something was found (see above)"
        ;;
    fuzz)
        [[ $# -eq 2 && $2 =~ ^[0-9]+$ ]] || { usage >&2 && exit 2; }
        build asan "${fuzz_targets[@]/#/fuzz_}"
        fuzz "$2" || die "sanitize: something was found (see above)"
        ;;
    -h | --help) usage && exit 0 ;;
    *) usage >&2 && exit 2 ;;
esac
echo "sanitize: nothing was found"
