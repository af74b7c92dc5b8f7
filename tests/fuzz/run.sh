#!/usr/bin/env bash
# tests/fuzz/run.sh [-o TABLE] [-k FOLDER] [BUILD] [RUNS] [TARGET...]: fuzzes the readers from the corpus, one after the other;
# a million runs each unless told otherwise, in parts of 50000 with seeds of their own, each from what the ones before found.
# BUILD is build/fuzz, made with: cmake --preset fuzz && cmake --build --preset fuzz (clang with libFuzzer and sanitizers);
# any other build works too, with a driver that only mutates.
#   -o TABLE   appends a line for each target: what was run, how long it took and what it reached (tests/fuzz/results.csv)
#   -k FOLDER  keeps the inputs that reached something new; an earlier run's are the start of this one
# What crashes, leaks, hangs (10 s) or asks for more than 1 GB ends the run with exit code 1 and is left in the working folder:
# fix it, and add it to the corpus.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
table='' found=''
while getopts o:k: option; do
    case $option in
    o) table=$OPTARG ;;
    k) found=$OPTARG ;;
    *) exit 2 ;;
    esac
done
shift $((OPTIND - 1))
build=${1:-$here/../../build/fuzz} runs=${2:-1000000}
shift $(($# > 2 ? 2 : $#))
[ $# -gt 0 ] || set -- scene grain_csv stl checkpoint

export OMP_NUM_THREADS=1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
found=${found:-$scratch/found}
part=50000

# Leaks are looked for at the end of a part, not after single runs, and inputs are not chosen by the rareness of what they reach:
# either takes half of the time.
fuzz() { # TARGET RUNS SEED
    "$build/tests/fuzz_$1" -runs="$2" -seed="$3" -timeout=10 -malloc_limit_mb=1024 -rss_limit_mb=4096 -max_len=8192 \
        -entropic=0 -detect_leaks=0 -print_final_stats=1 "$found/$1" "$here/corpus/$1" >"$scratch/log" 2>&1
}

# last NAME: the number behind the last "NAME: " of the log, 0 where the build measures none.
last() { sed -n "s/.*$1: *\([0-9][0-9]*\).*/\1/p" "$scratch/log" | tail -1 | grep . || echo 0; }

machine=$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1)
commit=$(git -C "$here" rev-parse --short HEAD)
header=machine,date,commit,target,executions,seconds,slowest_s,edges,features,inputs
echo "$header"
[ -z "$table" ] || [ -s "$table" ] || {
    echo "# made by: cmake --preset fuzz && cmake --build --preset fuzz && tests/fuzz/run.sh -o tests/fuzz/results.csv"
    echo "$header"
} >>"$table"
for target; do
    mkdir -p "$found/$target"
    done=0 seconds=0 slowest=0
    while [ "$done" -lt "$runs" ]; do
        count=$((runs - done < part ? runs - done : part)) begin=$(date +%s)
        fuzz "$target" "$count" $((1 + done / part)) || {
            echo "fuzz_$target, runs $done to $((done + count)):" >&2
            grep -v -e ' NEW ' -e ' REDUCE ' -e ' pulse ' -e ' RELOAD ' "$scratch/log" | tail -60 >&2
            exit 1
        }
        done=$((done + count)) seconds=$((seconds + $(date +%s) - begin))
        slow=$(last slowest_unit_time_sec) && slowest=$((slow > slowest ? slow : slowest))
    done
    row="$machine,$(date -u +%F),$commit,$target,$done,$seconds,$slowest,$(last cov),$(last ft),$(find "$found/$target" -type f | wc -l)"
    echo "$row"
    [ -z "$table" ] || echo "$row" >>"$table"
done
