#!/usr/bin/env bash
# perf/measure.sh [PROGRAM]: all that docs/performance.md shows of grains, measured on this machine, and the page made anew. Half an hour
# on two cores; nothing else may run meanwhile. PROGRAM is the arenite to measure, build/openmp's unless named. Parts by hand:
# perf/peers/run.sh, perf/roofline/run.py, perf/scaling/run.py, perf/prediction/run.py, each with --help.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
program=$(realpath "${1:-build/openmp/apps/arenite}")
python=deps/python/bin/python3
[ -x $python ] || python=python3
failed=()
for part in peers/run.sh roofline/run.py scaling/run.py prediction/run.py; do
    echo "== perf/$part"
    "perf/$part" --arenite "$program" || failed+=("perf/$part")
done
$python perf/performance_page.py
[ ${#failed[@]} -eq 0 ] || { echo "measure.sh: not as it should be (see above): ${failed[*]}" >&2; exit 1; }
