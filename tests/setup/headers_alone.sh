#!/usr/bin/env bash
# headers_alone.sh SOURCE_DIR BUILD_DIR: parses every header by itself, with the flags of a source of its
# folder (from compile_commands.json), and lists those that lean on what others include before them.
# A header that is the first include of its own source (grid.hpp in grid.cpp) was proven by the build.
set -euo pipefail
source_dir=$1
commands=$2/compile_commands.json

[ -e "$commands" ] || {
    echo "no compile_commands.json (only Ninja and Make write one): skipped"
    exit 77
}
if grep -q -e nvcc -e kokkos_launch_compiler "$commands"; then
    echo "compiled by nvcc, which cannot only parse: skipped (the CPU build runs this)"
    exit 77
fi

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$source_dir"

# flags_of FOLDER: the options of the folder's first compile command, without its input and outputs, and without the
# precompiled headers, which would hide what a header lacks.
flags_of() {
    local pattern="^ *\"command\": \"\(.*\) -o [^ ]* -c [\\\\\"]*$source_dir/$1/.*"
    sed -n "\|$pattern|{s|$pattern|\1|;s|\\\\\"|\"|g;s| -include [^ ]*cmake_pch\.hxx||g;p;q}" "$commands"
}

for folder in core kernels fluid io apps; do
    command=$(flags_of $folder)
    [ -n "$command" ] || command=$(flags_of core)
    find $folder -name '*.hpp' | sort | while read -r header; do
        source=${header%.hpp}.cpp
        if grep -q "$source" "$commands" && grep -m 1 '^#include' "$source" | grep -q "\"$header\""; then
            continue
        fi
        # The header of an optional part that this build leaves out: its source is there and not compiled.
        if [ -e "$source" ] && ! grep -q "$source" "$commands"; then
            continue
        fi
        # An including file, since a header given as the main file warns about #pragma once.
        name=${header//\//__}
        printf '#include "%s"\n' "$header" >"$scratch/$name.cpp"
        printf '%s -fsyntax-only -w %s >%s.log 2>&1 || touch %s.wrong\n' \
            "$command" "$scratch/$name.cpp" "$scratch/$name" "$scratch/$name"
        # What computes with vectors has to compile for the narrower ones of other processors too.
        [[ $header == *lanes* && $(uname -m) == x86_64 ]] || continue
        for without in avx512f avx; do
            cp "$scratch/$name.cpp" "$scratch/$name,no_$without.cpp"
            printf '%s -mno-%s -fsyntax-only -w %s >%s.log 2>&1 || touch %s.wrong\n' \
                "$command" "$without" "$scratch/$name,no_$without.cpp" "$scratch/$name,no_$without" "$scratch/$name,no_$without"
        done
    done
done >"$scratch/commands"

count=$(wc -l <"$scratch/commands")
tr '\n' '\0' <"$scratch/commands" | xargs -0 -n 1 -P "${OMP_NUM_THREADS:-2}" bash -c
wrong=0
for mark in "$scratch"/*.wrong; do
    [ -e "$mark" ] || continue
    wrong=$((wrong + 1))
    echo "== $(basename "${mark%.wrong}" | sed 's|__|/|g') does not compile alone:"
    grep -m 3 error "${mark%.wrong}.log" || head -n 5 "${mark%.wrong}.log"
done
echo "$count headers parsed, $wrong that do not compile alone"
[ "$wrong" -eq 0 ] && [ "$count" -gt 0 ]
