#!/usr/bin/env bash
# ./test.sh [ctest arguments]: installs what is missing, builds, and runs the test suite through ctest,
# for example ./test.sh -L unit.
set -euo pipefail

. "$(dirname "${BASH_SOURCE[0]}")/cmake/setup.sh"
arenite_set_up all
say "Testing (preset openmp)"
step "Run one again, with its output: ctest --preset openmp -V -R <name>" ctest --preset openmp "$@"
