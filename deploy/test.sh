#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Sets up with the test tools, then runs every check and test.
set -euo pipefail
# shellcheck source=deploy/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

usage() {
    cat <<'TEXT'
usage: deploy/test.sh [--tidy | --heavy]
Installs and builds what is missing, then runs all checks and tests except those labelled heavy.
  --tidy    with clang-tidy: a third more time
  --heavy   run only the tests labelled heavy, and clang-tidy with its slow, deep analysis
Ends with one line: raybundle tests: N passed, N failed
TEXT
}

packages=(
    clang-format clang-tidy chromium git libgtest-dev openssl python3 shellcheck
    # the Python client and its test
    python3-matplotlib python3-numpy python3-pil python3-pip python3-protobuf python3-setuptools python3-venv
    python3-websockets python3-wheel
    haproxy python3-yaml redis-server # of tests/cluster
)
min_node_version=18
passed=0
failed=0
failed_checks=()
check_log=""

install_tools() {
    local version
    version=$(node --version 2>/dev/null | sed -n 's/^v\([0-9]*\).*/\1/p' || true)
    ((${version:-0} >= min_node_version)) || packages+=(nodejs)
    command -v npm >/dev/null || packages+=(npm)
    install_packages "${packages[@]}"
}

# Packages of the browser tests, as locked; again only when the lock file has changed.
install_browser_tools() {
    local folder="$root/tests/browser"
    local lock="$folder/package-lock.json" installed="$folder/node_modules/.installed-lock.json"
    [[ -f $lock ]] || return 0
    if cmp -s "$lock" "$installed"; then
        return 0
    fi
    npm ci --prefix "$folder" --no-audit --no-fund && cp "$lock" "$installed"
}

# Runs one check, counts it, and says how it went. The end of what a failed one printed is kept for
# the last lines of the run: a thousand tests later nobody finds it.
check() {
    local name=$1 start=$SECONDS
    shift
    say "$name"
    if "$@" 2>&1 | tee "$check_log"; then
        passed=$((passed + 1))
        printf 'ok: %s (%d s)\n' "$name" $((SECONDS - start))
    else
        failed=$((failed + 1))
        printf 'FAILED: %s (%d s)\n' "$name" $((SECONDS - start))
        failed_checks+=("FAILED: $name"$'\n'"$(tail -n 40 "$check_log")")
    fi
}

tracked() { git -c safe.directory="$root" -C "$root" ls-files -z -- "$@"; }

check_format() {
    tracked '*.cpp' '*.h' | (cd "$root" && xargs -0 -r clang-format --dry-run -Werror)
}

check_scripts() {
    tracked 'deploy/*.sh' .ci/run | (cd "$root" && xargs -0 -r shellcheck -x)
}

run_ctest() {
    local report="$build_dir/ctest.xml" count failures skipped status=0
    say "tests"
    rm -f "$report"
    ctest --test-dir "$build_dir" --parallel 2 --output-on-failure --no-tests=error --timeout 600 \
        --output-junit "$report" "$@" || status=$?
    count=$(junit_attribute "$report" tests)
    failures=$(junit_attribute "$report" failures)
    skipped=$(($(junit_attribute "$report" skipped) + $(junit_attribute "$report" disabled)))
    count_cases "$build_dir/Testing/Temporary/LastTest.log"
    if ((status != 0 && failures == 0)); then
        failures=1 count=$((count + 1)) # ctest itself failed
    fi
    ((skipped == 0)) || echo "$skipped tests were skipped"
    passed=$((passed + count - failures - skipped))
    failed=$((failed + failures))
}

# Counts the tests within the programs of GoogleTest, each of which is one test of ctest: their numbers take the place
# of the programs' in count, failures and skipped. $1: ctest's log with what all of them have printed.
count_cases() {
    local cases programs failed_cases failed_programs skipped_cases
    read -r cases programs failed_cases failed_programs skipped_cases < <(awk '
        /^\[==========\] [0-9]+ tests? from .* ran\./ { cases += $2; ++programs }
        /^ *[0-9]+ FAILED TESTS?$/ { failed += $1; ++failed_programs }
        /^\[  SKIPPED \] [0-9]+ tests?, listed below:/ { skipped += $4 }
        END { print cases + 0, programs + 0, failed + 0, failed_programs + 0, skipped + 0 }' "$1")
    count=$((count + cases - programs))
    failures=$((failures + failed_cases - failed_programs))
    skipped=$((skipped + skipped_cases))
}

# Integer attribute of a JUnit report's <testsuite>; 0 where the report or the attribute is missing.
junit_attribute() {
    local value=""
    [[ ! -f $1 ]] || value=$(grep -oPm1 "^\s*$2=\"\K[0-9]+" "$1" || true)
    echo "${value:-0}"
}

# Everything that comes after the build; $1: usual, tidy or heavy.
run_checks() {
    check "browser test packages" install_browser_tools
    if [[ $1 == heavy ]]; then
        check "clang-tidy, deep" "$root/deploy/tidy.sh" --deep
        run_ctest --label-regex '^heavy$'
        return
    fi
    check "clang-format" check_format
    check "shellcheck" check_scripts
    check "shipped scenes" python3 "$root/scenes/generate.py" --check
    [[ $1 == usual ]] || check "clang-tidy" "$root/deploy/tidy.sh"
    run_ctest --label-exclude '^heavy$'
}

main() {
    local mode=usual with=--with-tests
    case "${1:-}" in
        "" | --quick) ;; # the usual run left nothing out once, and --quick clang-tidy
        --tidy) mode=tidy ;;
        --heavy) mode=heavy with=--with-heavy-tests ;;
        -h | --help) usage && exit 0 ;;
        *) usage >&2 && exit 2 ;;
    esac
    check_log=$(mktemp)
    trap 'rm -f "$check_log"' EXIT
    install_tools
    check "build" "$root/deploy/setup.sh" "$with"
    ((failed > 0)) || run_checks "$mode"
    ((${#failed_checks[@]} == 0)) || printf '%s\n' "${failed_checks[@]}"
    echo "raybundle tests: $passed passed, $failed failed"
    ((failed == 0))
}

main "$@"
