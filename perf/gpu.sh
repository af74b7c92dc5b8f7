#!/usr/bin/env bash
# perf/gpu.sh: builds on a machine with a GPU, times grains, fluid and coupling, and checks that the physics is the same:
# `arenite verify` and the tests of the device's kernels. Needs nvcc, CMake, ninja and the folder with deps/ as
# cmake/fetch_deps.sh --all fills it; neither a network nor Python. Writes perf/results/<card>/*.csv.
#
# Eight minutes with the build on 16 cores; what no time is left for is said. From the environment:
#   ARENITE_PRESET   bare-cuda                 bare stands in for it where there is no GPU
#   ARENITE_PROGRAMS (build/<preset>)          a folder with the programs below, built elsewhere: nothing is built
#   ARENITE_SECONDS  480                       for everything; nothing new begins after it
#   ARENITE_GRAINS   "34000 270000 1000000 8000000"
#   ARENITE_CELLS    "128 256"                 along an edge of the fluid's cube
#   ARENITE_MEMORY   (what the card has free)  bytes, for the largest lattice that fits; where there is no card, of a process
#   ARENITE_RESULTS  perf/results/<card>
# grains.csv: a lattice; pack33752.csv: the shared pack; largest.csv: lattices around the largest that fits.
# launches.csv: of tests/scenes/small.toml.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset=${ARENITE_PRESET:-bare-cuda}
build=build/$preset
limit=${ARENITE_SECONDS:-480}
tests="test_grains test_walls test_fluid test_coupling launch_ahead count_launches hash_flow hash_coupling"

# program NAME: where it is.
program() {
    if [ -n "${ARENITE_PROGRAMS:-}" ]; then echo "$ARENITE_PROGRAMS/$1"
    else find "$build" -name "$1" -type f -perm -u+x -print -quit; fi
}

left() { echo $((limit - SECONDS)); }
say() { printf '\n== %s (%d s left)\n' "$1" "$(left)"; }
# run WHAT COMMAND...: within the time that is left.
run() {
    local what=$1
    shift
    if [ "$(left)" -le 0 ]; then
        echo "left out, no time: $what" >&2
        return 1
    fi
    timeout "$(left)" "$@" || {
        local status=$?
        [ $status -ne 124 ] || echo "cut off, no time: $what" >&2
        return $status
    }
}
# field NAME <JSON: the value of a number or a string.
field() { sed -nE "s/.*\"$1\": \"?([^\",}]*)\"?.*/\1/p"; }

mkdir -p "$build"
if [ -z "${ARENITE_PROGRAMS:-}" ]; then
    say "Building (preset $preset)"
    # Four sources at a time, so that 16 cores have enough beside each other and none is long alone at the end.
    cmake --preset "$preset" -DARENITE_ENABLE_PERF=ON -DARENITE_CUDA_SOURCES_TOGETHER=4 >"$build/configure.log" ||
        { tail -n 20 "$build/configure.log" >&2; exit 1; }
    # All programs at once, so that they compile beside each other.
    run "building" cmake --build "$build" --target arenite bench_projection bench_coupling $tests >"$build/build.log" 2>&1 ||
        { tail -n 20 "$build/build.log" >&2; exit 1; }
    say "Built"
fi
arenite=$(program arenite)
projection=$(program bench_projection)
coupling=$(program bench_coupling)

card=$(nvidia-smi --query-gpu=name --format=csv,noheader 2>/dev/null | head -n 1 || true)
card=${card:-$(sed -n 's/^model name[^:]*: *//p' /proc/cpuinfo | head -n 1) $(nproc)core}
results=${ARENITE_RESULTS:-perf/results/$(tr '[:upper:] ' '[:lower:]-' <<<"${card#NVIDIA }" | tr -cd 'a-z0-9-')}
mkdir -p "$results"
"$arenite" info | tee "$build/info.txt"
# head_of FILE COLUMNS: begins a table.
head_of() {
    echo "# $(date +%F); $card; $(head -n 1 "$build/info.txt"); perf/gpu.sh" >"$results/$1"
    echo "$2" >>"$results/$1"
}

say "Grains"
numbers="contacts_per_grain bytes_per_particle_step share_of_copy share_of_copy_beyond_caches memory_bytes_per_grain peak_memory_bytes_per_grain one_search_s state_hash"
# bench FILE LAW STEPS PACK...: a row of the table.
bench() {
    local lines speeds last name
    lines=$(run "${*:4}, $2" "$arenite" bench "${@:4}" --law "$2" --steps "$3" --repeats 3 --limits) || return 0
    speeds=$(field particle_steps_per_s <<<"$lines" | sort -g)
    last=$(tail -n 1 <<<"$lines")
    {
        printf '%s,%s,%s' "$2" "$(field grains <<<"$last")" "$3"
        for name in 2 1 3; do printf ',%s' "$(sed -n ${name}p <<<"$speeds")"; done
        for name in $numbers; do printf ',%s' "$(field "$name" <<<"$last")"; done
        echo
    } | tee -a "$results/$1"
}
columns="law,grains,steps,particle_steps_per_s,least,most,${numbers// /,}"
head_of grains.csv "$columns"
head_of pack33752.csv "$columns"
gzip -dc perf/packs/pack33752.txt.gz >"$build/pack33752.txt"
for law in jkr hertz; do
    bench pack33752.csv $law 2000 --pack "$build/pack33752.txt"
    for grains in ${ARENITE_GRAINS:-34000 270000 1000000 8000000}; do
        steps=$((500000000 / grains))
        bench grains.csv $law $((steps < 50 ? 50 : steps > 2000 ? 2000 : steps)) --grains "$grains"
    done
done

say "Fluid"
head_of fluid.csv "cells_per_edge,backend,concurrency,step_ms,iterations,solve_ms,Mcell_updates_per_s,solve_GB_per_s,copy_GB_per_s,share_of_copy"
for cells in ${ARENITE_CELLS:-128 256}; do
    row=$(run "fluid of $cells^3" "$projection" "$cells" 5) || continue
    echo "$row" | tee -a "$results/fluid.csv"
done

say "Coupling"
head_of coupling.csv "grains,cells,backend,concurrency,grain_step_ms,deposit_ms,interpolate_ms,flow_ms,exchange_in_grain_steps,share_at_100_steps,share_at_50_steps"
while read -r grains cells; do # the paper's grid at k = 2 and k = 1, and a million grains on cells of the same size
    row=$(run "coupling of $grains" "$coupling" "$grains" $cells 7) || continue
    echo "$row" | tee -a "$results/coupling.csv"
done <<<"34000 12 12 6
270000 12 12 6
1000000 28 28 28"

say "Physics"
failed=
for name in $tests; do
    test=$(program "$name") && run "$name" "$test" >"$build/$name.log" 2>&1 || { tail -n 20 "$build/$name.log"; failed+=" $name"; continue; }
    echo "passed: $name"
done
head_of launches.csv stage,steps,searches,launches_per_step,waits_per_step
sed -nE '/in balance/q; s/^([a-z/]+) +([0-9]+) +([0-9]+) +([0-9.]+) +([0-9.]+)$/\1,\2,\3,\4,\5/p' "$build/count_launches.log" | tee -a "$results/launches.csv"
head_of verify.csv group,rows,failed,seconds
for group in contact integrator search coarse_graining friction fluid coupling; do # small cases all: a GPU waits for launches
    began=$SECONDS
    run "arenite verify $group" "$arenite" verify "$group" >"$build/verify_$group.log" || failed+=" verify-$group"
    grep -v ' ok  ' "$build/verify_$group.log" | grep "^$group " || true # rows that failed
    line=$(sed -nE 's/^([0-9]+) checks, ([0-9]+) failed.*/\1,\2/p' "$build/verify_$group.log")
    [ -z "$line" ] || echo "$group,$line,$((SECONDS - began))" | tee -a "$results/verify.csv"
done

say "The largest lattice that fits"
largest=$build/largest
head_of largest.csv "law,grains,fits,memory_bytes,steps,particle_steps_per_s,memory_bytes_per_grain,peak_memory_bytes_per_grain,one_search_s"
memory=${ARENITE_MEMORY:-$(nvidia-smi --query-gpu=memory.free --format=csv,noheader,nounits 2>/dev/null | awk 'NR == 1 { print $1 * 1048576 }' || true)}
# fits GRAINS: steps and searches them, and adds a row. 0: they fit; 1: they do not; 2: that could not be seen.
fits() {
    local answer=yes last='' name status=0
    (
        command -v nvidia-smi >/dev/null || ulimit -v $((memory / 1024))
        run "$1 grains" "$arenite" bench --grains "$1" --law jkr --warm-up 2 --steps 20 --repeats 1
    ) >"$largest.json" 2>"$largest.log" || status=$?
    if [ $status -eq 0 ]; then last=$(<"$largest.json")
    elif grep -q 'failed to allocate\|bad_alloc' "$largest.log"; then answer=no
    else
        tail -n 3 "$largest.log" >&2
        return 2
    fi
    {
        printf 'jkr,%s,%s,%s,20' "$(field grains <<<"${last:-\"grains\": $1}")" $answer "$memory"
        for name in particle_steps_per_s memory_bytes_per_grain peak_memory_bytes_per_grain one_search_s; do
            printf ',%s' "$(field $name <<<"$last")"
        done
        echo
    } | tee -a "$results/largest.csv"
    [ $answer = yes ]
}
# Up from what the account of memory says or down from it, by 3 % at a time, to two neighbours of which one fits. A
# fiftieth is left for what is not in the account: the driver's own and what lies between arrays.
peak=$(awk -F, 'NR == 2 { for (n = 1; n <= NF; ++n) if ($n == "peak_memory_bytes_per_grain") column = n }
                $1 == "jkr" { peak = $column } END { print peak }' "$results/grains.csv")
if [ -z "$memory" ]; then echo "left out: no card, and no ARENITE_MEMORY"
elif [ -z "$peak" ]; then echo "left out: no lattice was timed above"
else
    grains=$(awk -v memory="$memory" -v peak="$peak" 'BEGIN { printf "%d", 0.98 * memory / peak }')
    first=
    while :; do
        status=0
        fits "$grains" || status=$?
        first=${first:-$status}
        [ $status -lt 2 ] && [ $status -eq "$first" ] || break
        grains=$((status == 0 ? grains * 103 / 100 : grains * 97 / 100))
    done
fi

printf '\n== %d s, results in %s\n' "$SECONDS" "$results"
[ -z "$failed" ] || { echo "failed or not reached:$failed"; exit 1; }
