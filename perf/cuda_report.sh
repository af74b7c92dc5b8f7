#!/usr/bin/env bash
# perf/cuda_report.sh [OBJECT...]: what the CUDA compiler says of every kernel of the step: registers, spills, shared memory,
# and the occupancy that they leave on sm_90. Needs nvcc, CMake, ninja and Python 3; no GPU. Writes
# perf/results/cuda_sm90/kernels.csv. OBJECT: only these (contact_forces, deposit, ...), for a quick look at one file.
# ARENITE_CUDA_BUILD names another build folder, ARENITE_CUDA_JOBS how many compilers run at once.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=${ARENITE_CUDA_BUILD:-$root/build/cuda-report}

# ptxas writes its report to the compiler's output, and ninja shows that once: it is kept beside the object.
mkdir -p "$build"
cat >"$build/keep_report.sh" <<'LAUNCHER'
#!/usr/bin/env bash
object=
previous=
for argument in "$@"; do
    [ "$previous" != -o ] || object=$argument
    previous=$argument
done
"$@" 2>"$object.ptxas" || { status=$?; cat "$object.ptxas" >&2; exit $status; }
LAUNCHER
chmod +x "$build/keep_report.sh"

cmake -S "$root" -B "$build" --preset bare-cuda -DARENITE_ENABLE_TESTS=OFF \
    -DARENITE_CUDA_SOURCES_TOGETHER=1 -DCMAKE_CUDA_FLAGS=-Xptxas=-v \
    -DCMAKE_CUDA_COMPILER_LAUNCHER="$build/keep_report.sh" >"$build/configure.log" ||
    { cat "$build/configure.log" >&2; exit 1; }
# The libraries of the step, and the one file of apps that has kernels for every contact law (powers and energies).
step='(core|kernels|fluid)\/.*\.cpp\.o|apps\/.*\/stage_forces\.cpp\.o'
objects=$(ninja -C "$build" -t targets all | sed -nE "s/^($step):.*/\1/p")
if [ $# -gt 0 ]; then
    objects=$(for name in "$@"; do grep "/$name\.cpp\.o$" <<<"$objects"; done)
fi
# shellcheck disable=SC2086 # a list
ninja -C "$build" ${ARENITE_CUDA_JOBS:+-j$ARENITE_CUDA_JOBS} $objects
mkdir -p "$root/perf/results/cuda_sm90"
changed=$(git -C "$root" status --porcelain -- ':!perf/results' 2>/dev/null | sed -n '1s/.*/-modified/p')
nvcc=$(sed -n 's/^CMAKE_CUDA_COMPILER:[A-Z]*=//p' "$build/CMakeCache.txt")
# shellcheck disable=SC2086
(cd "$build" && python3 "$root/perf/cuda_report.py" $objects) >"$build/kernels.csv"
{
    echo "# perf/cuda_report.sh: $("$nvcc" --version | sed -n 's/.*release \([0-9.]*\).*/nvcc \1/p'), sm_90, -O3;" \
        "commit $(git -C "$root" describe --always 2>/dev/null || echo unknown)$changed"
    cat "$build/kernels.csv"
} >"$root/perf/results/cuda_sm90/kernels.csv"
echo "perf/results/cuda_sm90/kernels.csv: $(($(wc -l <"$build/kernels.csv") - 1)) kernels"
