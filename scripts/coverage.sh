#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-2-Clause
# Line coverage of src/ by all tests: builds the coverage preset, runs the tests, prints a table of the files and the
# total. Arguments go to ctest: `scripts/coverage.sh -L fast` measures the fast tests alone.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
mkdir -p build
# shellcheck source=setup.sh
. scripts/setup.sh
install_packages check
build_preset coverage --
find build/coverage -name '*.gcda' -delete
ctest --test-dir build/coverage -j "$(nproc)" --output-on-failure "$@"
gcovr --root . --object-directory build/coverage --filter 'src/' --exclude-throw-branches --sort-uncovered --print-summary
