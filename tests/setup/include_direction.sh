#!/usr/bin/env bash
# include_direction.sh SOURCE_DIR: core includes core alone, kernels and fluid also core but not each other,
# io all three, apps everything; and every include in quotes is written from the repository root. And no header holds a
# KOKKOS_LAMBDA: nvcc keeps part of an extended lambda's type to each source file, so that a function that several of them
# share calls what another one made. A struct does there.
set -euo pipefail
cd "$1"

declare -A may_include=(
    [core]="core"
    [kernels]="core kernels"
    [fluid]="core fluid"
    [io]="core kernels fluid io"
    [apps]="core kernels fluid io apps"
)
wrong=0 seen=0
while IFS=: read -r file line text; do
    seen=$((seen + 1))
    included=${text#*\"}
    included=${included%%\"*}
    folder=${file%%/*}
    if [ "$included" = build_config.hpp ]; then
        continue # made by CMake
    elif [ ! -e "$included" ]; then
        echo "$file:$line: \"$included\" is not a path from the repository root"
        wrong=$((wrong + 1))
    elif [[ " ${may_include[$folder]} " != *" ${included%%/*} "* ]]; then
        echo "$file:$line: $folder must not include ${included%%/*} (\"$included\")"
        wrong=$((wrong + 1))
    fi
done < <(grep -rnE '^[[:space:]]*#[[:space:]]*include[[:space:]]*"' --include='*.hpp' --include='*.cpp' "${!may_include[@]}")
echo "$seen includes, $wrong against the direction core < kernels, fluid < io < apps"
if grep -rn KOKKOS_LAMBDA --include='*.hpp' "${!may_include[@]}" perf tests; then
    echo "kernels in headers are structs, not lambdas (nvcc; see the top of this test)"
    wrong=$((wrong + 1))
fi
[ "$wrong" -eq 0 ] && [ "$seen" -gt 0 ]
