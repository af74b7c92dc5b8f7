#!/usr/bin/env bash
# Fills deps/ with the sources of what arenite is built from, in fixed versions with checked sums:
#   cmake/fetch_deps.sh          Kokkos and Kokkos Kernels
#   cmake/fetch_deps.sh --all    and the header libraries, GoogleTest and Google Benchmark, so that the
#                                tree can be copied to a machine without a network and be built there
#   cmake/fetch_deps.sh --report a Python of its own for `arenite report`, with matplotlib and PyVista, in deps/python
# What is there already is left alone. Needs Python 3.10 or newer with pip; --all also needs apt-get and dpkg-deb.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
deps=${ARENITE_DEPS_DIR:-$root/deps}

work=
trap 'rm -rf "${work:-}"' EXIT

fail() {
    printf '%s: %s\n' "cmake/fetch_deps.sh" "$1" >&2
    exit 1
}

# The source archive of this Python package carries Kokkos and Kokkos Kernels 4.5.1 unmodified.
kokkos_package=pycompadre
kokkos_package_version=1.7.6
kokkos_package_sha256=c766ec4d445ce076069be4b8c51a23ffac4ee79ea949ca86446bfd8c299b154c

fetch_kokkos() {
    local stamp=$deps/fetched-kokkos
    [ "$(cat "$stamp" 2>/dev/null)" = "$kokkos_package_sha256" ] && return
    rm -f "$stamp"
    mkdir -p "$deps"
    work=$(mktemp -d "$deps/fetch.XXXXXX")

    local archive=$work/$kokkos_package-$kokkos_package_version.tar.gz
    if [ -n "${ARENITE_KOKKOS_ARCHIVE:-}" ]; then
        cp "$ARENITE_KOKKOS_ARCHIVE" "$archive"
    else
        python3 -m pip --version >/dev/null 2>&1 ||
            fail "python3 has no pip. Debian: apt-get install python3-pip. Or name the archive
  $kokkos_package-$kokkos_package_version.tar.gz, fetched elsewhere, in ARENITE_KOKKOS_ARCHIVE."
        # With the sum in the requirement, pip checks it before it looks into the archive.
        printf '%s==%s --hash=sha256:%s\n' "$kokkos_package" "$kokkos_package_version" "$kokkos_package_sha256" \
            >"$work/requirements.txt"
        echo "Fetching Kokkos 4.5.1 and Kokkos Kernels 4.5.1 ($kokkos_package $kokkos_package_version)"
        python3 -m pip download --quiet --disable-pip-version-check --no-deps --no-binary "$kokkos_package" \
            --dest "$work" --requirement "$work/requirements.txt" ||
            fail "pip download failed (see above). Python must be 3.10 or newer and reach its package index; or name the
  archive $kokkos_package-$kokkos_package_version.tar.gz, fetched elsewhere, in ARENITE_KOKKOS_ARCHIVE."
    fi
    echo "$kokkos_package_sha256  $archive" | sha256sum --check --status ||
        fail "$archive has not the sum $kokkos_package_sha256: a damaged or a different archive."

    # Without their tests, which are half of it.
    tar -xzf "$archive" -C "$work" \
        --exclude='unit_test*' --exclude='perf_test' --exclude='*/docs' --exclude='*/doc' \
        "$kokkos_package-$kokkos_package_version/kokkos" "$kokkos_package-$kokkos_package_version/kokkos-kernels"
    rm -rf "$deps/kokkos" "$deps/kokkos-kernels"
    mv "$work/$kokkos_package-$kokkos_package_version"/kokkos{,-kernels} "$deps/"
    echo "$kokkos_package_sha256" >"$stamp"
    rm -rf "$work"
}

# Debian's packages of the small libraries: apt checks their signed sums itself.
fetch_small_libraries() {
    [ -e "$deps/fetched-small-libraries" ] && return
    for tool in apt-get dpkg-deb; do
        command -v "$tool" >/dev/null ||
            fail "--all takes the small libraries from Debian packages and needs $tool: run it on a Debian or Ubuntu
  machine and copy $deps here."
    done
    mkdir -p "$deps"
    work=$(mktemp -d "$deps/fetch.XXXXXX")
    echo "Fetching fmt, toml++, CLI11, nlohmann-json, GoogleTest and Google Benchmark"
    local benchmark
    benchmark=$(apt-cache depends libbenchmark-dev | sed -n 's/.*Depends: \(libbenchmark1[a-z0-9]*\).*/\1/p' | head -n 1)
    # _apt, the user that apt fetches as, cannot write here; that is only a notice.
    (cd "$work" && apt-get -qq download libfmt-dev libtomlplusplus-dev libcli11-dev nlohmann-json3-dev \
        googletest libgtest-dev libbenchmark-dev ${benchmark:+"$benchmark"} 2>apt.log) ||
        fail "apt-get download failed; run apt-get update first. $(tail -n 3 "$work/apt.log")"
    local package
    for package in "$work"/*.deb; do
        case ${package##*/} in
            libbenchmark*) dpkg-deb -x "$package" "$work/benchmark" ;;
            *) dpkg-deb -x "$package" "$work/root" ;;
        esac
    done
    rm -rf "$deps/include" "$deps/googletest" "$deps/benchmark"
    mkdir -p "$deps/include" "$deps/googletest/include"
    cp -r "$work"/root/usr/include/{fmt,toml++,CLI,nlohmann} "$deps/include/"
    cp -r "$work/root/usr/include/gtest" "$deps/googletest/include/"
    cp -r "$work/root/usr/src/googletest/googletest/src" "$deps/googletest/"
    mv "$work/benchmark/usr" "$deps/benchmark" # compiled: for the architecture of the machine that fetched it
    (cd "$work" && ls -- *.deb) >"$deps/fetched-small-libraries"
    rm -rf "$work"
}

# A virtual environment, so that neither Debian's Python nor the user's own is touched. Its packages are wheels in fixed
# versions; pip's own sums, from the index, are what checks them.
fetch_report_python() {
    local requirements=$root/cmake/report_requirements.txt stamp=$deps/fetched-report-python
    cmp -s "$requirements" "$stamp" && [ -x "$deps/python/bin/python3" ] && return
    python3 -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null || fail "the report needs Python 3.11 or newer."
    rm -rf "$stamp" "$deps/python"
    mkdir -p "$deps"
    echo "Fetching matplotlib and PyVista for the report (150 MB)"
    python3 -m venv "$deps/python" >/dev/null ||
        fail "python3 cannot make a virtual environment. Debian: apt-get install python3-venv"
    "$deps/python/bin/python3" -m pip install --quiet --disable-pip-version-check --no-deps --only-binary :all: \
        --requirement "$requirements" ||
        fail "pip install failed (see above). Any Python 3.11 with matplotlib and PyVista will do: name it in ARENITE_PYTHON."
    "$deps/python/bin/python3" -c 'import matplotlib, pyvista' ||
        fail "the packages in $deps/python do not load (see above)."
    cp "$requirements" "$stamp"
}

case ${1:-} in
    '') fetch_kokkos ;;
    --report) fetch_report_python ;;
    --all)
        fetch_kokkos
        fetch_small_libraries
        ;;
    *) fail "unknown argument '$1' (none, --all or --report)" ;;
esac
