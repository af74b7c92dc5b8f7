#!/usr/bin/env bash
# The program as a user meets it: exit codes, messages, and the two-grain scenes against their closed forms.
# Usage: command_line.sh PROGRAM SCENES
set -u
program=$1 scenes=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export OMP_NUM_THREADS=1 OMP_PROC_BIND=false
faults=0

fault() { echo "FAULT: $*"; faults=$((faults + 1)); }

# expect CODE TEXT COMMAND...: the exit code, and a text that stdout or stderr must hold.
expect() {
    local code=$1 text=$2
    shift 2
    "$@" >"$work/out" 2>&1
    local got=$?
    [ $got -eq "$code" ] || fault "$*: exit code $got, not $code: $(head -3 "$work/out")"
    grep -q -- "$text" "$work/out" || fault "$*: does not say '$text' but: $(head -3 "$work/out")"
}

# within VALUE REFERENCE RELATIVE WHAT
within() {
    awk -v v="$1" -v r="$2" -v e="$3" 'BEGIN { d = (v - r) / r; exit !(v != "" && d <= e && d >= -e) }' ||
        fault "$4 is $1, not $2 within $3"
}

# column FILE NAME: the values of a CSV column.
column() { awk -F, -v name="$2" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) c = i; next } { print $c }' "$1"; }

expect 0 "Arenite" "$program" info
expect 2 "" "$program"
expect 2 "none.toml" "$program" run "$work/none.toml"
expect 2 "nothing" "$program" verify nothing
# H18: of several ranks each would write over the others' files.
expect 2 "one of 2 MPI ranks" env OMPI_COMM_WORLD_SIZE=2 "$program" run "$scenes/collision.toml" -o "$work/ranks"
[ ! -e "$work/ranks" ] || fault "a rank of several left a folder"

sed 's/friction = 0.2/frction = 0.2/; s/youngs_modulus = .*/youngs_modulus = "stiff"/' "$scenes/pull_test.toml" >"$work/bad.toml"
expect 2 "did you mean friction" "$program" run "$work/bad.toml" -o "$work/bad"
expect 2 "bad.toml:[0-9]*:[0-9]*: materials.sand.youngs_modulus" "$program" check "$work/bad.toml"
[ ! -e "$work/bad" ] || fault "a scene that cannot run left a folder"

expect 0 "done" "$program" run "$scenes/collision.toml" -o "$work/collision"

# Bad input leaves the folder of an earlier run as it is, to the byte, and says all faults at once.
digest() { (cd "$1" && find . -type f -printf '%P %T@ ' -exec md5sum {} \; | sort | md5sum); }
before=$(digest "$work/collision")
sed -e 's/^poissons_ratio = .*/poissons_ratio = 0.7/; s/^duration = .*/duraton = 1/; s/^type = .*/type = 3/' \
    -e 's/^density = .*/density = "heavy"/; s/^lower = .*/lower = [0, 0]/' "$scenes/column_collapse.toml" >"$work/faults.toml"
for command in run check; do
    expect 2 "faults.toml:[0-9]*:[0-9]*: materials.*poissons_ratio = 0.7: must be in (-1, 0.5)" "$program" $command "$work/faults.toml" \
        $([ $command = check ] || echo -o "$work/collision")
    for fault in 'duraton: unknown key; did you mean duration' 'density = "heavy": must be a number' 'lower = \[0, 0\]: must be a vector'; do
        grep -q -- "faults.toml:[0-9]*:[0-9]*: .*$fault" "$work/out" || fault "$command does not say '$fault' with the others"
    done
done
expect 2 "faults.toml" "$program" run "$work/faults.toml" -o "$work/collision" --resume
[ "$before" = "$(digest "$work/collision")" ] || fault "a scene that cannot run touched the folder of an earlier run"
speed() { column "$work/collision/probe-$1.csv" vx | sed -n "$2"; }
before=$(awk -v a="$(speed left 1p)" -v b="$(speed right 1p)" 'BEGIN { print a - b }')
after=$(awk -v a="$(speed left '$p')" -v b="$(speed right '$p')" 'BEGIN { print b - a }')
within "$(awk -v a="$after" -v b="$before" 'BEGIN { print a / b }')" 0.8 1e-3 "the restitution"

expect 0 "done" "$program" run "$scenes/pull_test.toml" -o "$work/pull"
peak=$(column "$work/pull/probe-held.csv" fz | awk '{ if ($1 > m) m = $1 } END { printf "%.12g", m }')
within "$peak" 1.625774198e-2 1e-6 "the bond's strength" # 3 pi gamma R*
awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) { if ($i == "bonds") b = i; if ($i == "stage") s = i } }
         $s == "push" && $b > 0 { found = 1 } END { exit found }' "$work/pull/history.csv" || fault "the broken bond came back"

if "$program" info | grep -q '^HDF5: [0-9]'; then # checkpoints
# A run goes on under a scene whose later stages have changed, and under no other.
cp "$scenes/pull_test.csv" "$work/"
cp "$scenes/pull_test.toml" "$work/later.toml"
expect 0 "stopped" "$program" run "$work/later.toml" -o "$work/later" --until pull
sed -i '/name = "push"/,$ s/^duration = 5e-4/duration = 1e-5/' "$work/later.toml"
expect 0 "done" "$program" run "$work/later.toml" -o "$work/later" --resume
sed 's/friction = 0.2/friction = 0.3/' "$work/later.toml" >"$work/other.toml"
expect 2 "another scene" "$program" run "$work/other.toml" -o "$work/later" --resume
sed -i "s/2.297667591e-4/2.297667592e-4/" "$work/pull_test.csv"
cmp -s "$scenes/pull_test.csv" "$work/pull_test.csv" && fault "the test does not change the CSV"
expect 2 "another scene" "$program" run "$work/later.toml" -o "$work/later" --resume

# The grains of an earlier run: a checkpoint as source, and a time step that comes from their diameters.
sed -e "s/^source = .*/source = \"checkpoint\"/; s#^file = .*#file = \"$(ls "$work"/pull/checkpoint-*.h5 | tail -1)\"#" \
    -e 's/^time_step = 1e-8 .*/time_step_fraction = 0.1/; s/^time_step = 1e-8$/time_step_fraction = 0.1/; s/^duration = 5e-4.*/duration = 1e-5/' \
    "$scenes/pull_test.toml" >"$work/again.toml"
expect 0 "done" "$program" run "$work/again.toml" -o "$work/again"
sed -i 's#^file = .*#file = "nowhere.h5"#' "$work/again.toml"
expect 2 "nowhere.h5" "$program" run "$work/again.toml" -o "$work/again2"
fi

# A pack's bits do not depend on the threads; one that was tiled and saved is read back as what was measured.
bench() { "$program" bench --repeats 1 --warm-up 1 --steps 3 "$@" | tr ',' '\n'; }
for law in hertz jkr; do
    hash=$(bench --grains 1000 --law $law | grep state_hash)
    [ -n "$hash" ] && [ "$hash" = "$(OMP_NUM_THREADS=2 bench --grains 1000 --law $law | grep state_hash)" ] ||
        fault "bench --law $law: another state on two threads"
done
printf '# x y z radius\n%s\n%s\n' "3e-4 3e-4 2.9e-4 3e-4" "9e-4 3e-4 2.9e-4 3e-4" >"$work/pack.txt"
bench --pack "$work/pack.txt" --tile 2 3 --relax 5 --save "$work/tiled.txt" >"$work/out"
grep -q '"grains": 12$' "$work/out" || fault "bench --tile 2 3 of two grains: $(grep grains "$work/out")"
grep -q '"memory_bytes_per_grain": [1-9]' "$work/out" || fault "bench does not say its memory"
[ "$(grep -c '^[0-9]' "$work/tiled.txt")" -eq 12 ] || fault "bench --save: not a line per grain"
expect 0 '"share_of_copy": [0-9]' "$program" bench --pack "$work/tiled.txt" --steps 1 --warm-up 0 --repeats 1 --limits

[ "$faults" -eq 0 ] && echo "all as it should be"
exit "$((faults > 0))"
