#!/usr/bin/env bash
# ./run.sh [SCENE.toml] [more arguments of `arenite run`]: installs what is missing, builds, runs the scene
# (scenes/demo.toml unless named) into runs/<its name> and says where to look.
set -euo pipefail

scene=
if [ $# -gt 0 ]; then
    case $1 in
        -h | --help)
            sed -n '2,3s/^# //p' "$0"
            exit 0
            ;;
    esac
    [ -r "$1" ] || {
        echo "run.sh: no scene file '$1'" >&2
        exit 2
    }
    scene=$(cd "$(dirname "$1")" && pwd)/$(basename "$1")
    shift
fi

. "$(dirname "${BASH_SOURCE[0]}")/cmake/setup.sh"
arenite_set_up arenite # not the tests: they are most of the build
scene=${scene:-$arenite_root/scenes/demo.toml}
name=$(basename "$scene" .toml)
output=$arenite_root/runs/$name

# One thread per core and left to the scheduler: bound threads would share a core with a second run.
export OMP_PROC_BIND=${OMP_PROC_BIND:-false}
say "Running $name"
step "The message above says what stopped it; $output holds what was written until then." \
    "$arenite_build/apps/arenite" run "$scene" -o "$output" "$@"

say "Writing the report"
"$arenite_build/apps/arenite" report "$output" ||
    echo "run.sh: the report could not be written (see above); the run itself is complete"

say "Done: $output"
[ ! -e "$output/report.html" ] || echo "  report.html    the pictures and tables of this run, in any browser"
[ ! -e "$output/view.py" ] || echo "  view.py        opens the series in ParaView: paraview --script=$output/view.py"
for view in particles.pvd fluid.pvd streamlines.pvd; do
    [ ! -e "$output/$view" ] || echo "  $view    open in ParaView (File > Open, then Apply)"
done
[ ! -e "$output/history.csv" ] || echo "  history.csv    one row per interval: porosity, wall forces, produced mass, ..."
[ ! -e "$output/produced.csv" ] || echo "  produced.csv   $(($(wc -l <"$output/produced.csv") - 1)) grains that left through the outlet"
[ ! -e "$output/summary.json" ] || echo "  summary.json   end state and timing of each stage"
