#!/usr/bin/env bash
# tests/fuzz/run.sh [BUILD] [RUNS] [TARGET...]: fuzzes the readers from the corpus, one after the other; a million runs each
# unless told otherwise. BUILD is build/fuzz, made with: cmake --preset fuzz && cmake --build --preset fuzz
# (clang with libFuzzer and sanitizers); any other build works too, with a driver that only mutates.
# What crashes, hangs (10 s) or asks for more than 1 GB is left in the working folder: fix it, and add it to the corpus.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
build=${1:-$here/../../build/fuzz} runs=${2:-1000000}
shift $(($# > 2 ? 2 : $#))
[ $# -gt 0 ] || set -- scene grain_csv stl checkpoint

export OMP_NUM_THREADS=1
found=$(mktemp -d)
trap 'rm -rf "$found"' EXIT
for target; do
    mkdir "$found/$target"
    echo "== $target"
    "$build/tests/fuzz_$target" -runs="$runs" -seed=1 -timeout=10 -malloc_limit_mb=1024 -rss_limit_mb=4096 -max_len=8192 \
        -print_final_stats=1 "$found/$target" "$here/corpus/$target" 2>&1 |
        grep -v -e ' NEW ' -e ' REDUCE ' -e ' pulse ' -e ' RELOAD '
done
