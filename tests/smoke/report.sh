#!/usr/bin/env bash
# `arenite report` on runs made here: tests/smoke/check_report.py says what is checked. Skipped where the report's Python is not.
# Usage: report.sh PROGRAM SCENES PYTHON
set -u
program=$1 scenes=$2
python=${ARENITE_PYTHON:-$3}
[ -x "$python" ] || python=python3
if ! "$python" -c 'import matplotlib, pyvista' 2>/dev/null; then
    echo "skipped: $python has no matplotlib and PyVista; cmake/fetch_deps.sh --report installs them"
    exit 77
fi
export ARENITE_PYTHON=$python OMP_NUM_THREADS=1 OMP_PROC_BIND=false
unset DISPLAY # pictures are drawn without one
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
exec "$python" -B "$here/check_report.py" "$program" "$scenes" "$here/../../apps/report"
