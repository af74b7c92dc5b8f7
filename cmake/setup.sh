# Sourced by run.sh and test.sh: what both do before their own work. Leaves the shell in the repository.
#   arenite_set_up TARGET    installs what is missing (Debian and its kin), fetches deps/, configures, builds TARGET

arenite_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
arenite_build=$arenite_root/build/openmp

arenite_packages=(g++ cmake ninja-build libopenmpi-dev openmpi-bin libhdf5-openmpi-dev libvtk9-dev libgtest-dev
    libtomlplusplus-dev libcli11-dev libfmt-dev nlohmann-json3-dev)
# For the report: Python, and an OpenGL that draws without a display (its PyVista comes by pip, see fetch_deps.sh).
arenite_packages+=(python3 python3-venv libegl1 libgl1 libgl1-mesa-dri libxrender1)

say() { printf '\n== %s\n' "$*"; }

fail() {
    printf '\n%s: %s\n' "$(basename "$0")" "$1" >&2
    exit 1
}

# step WHAT_TO_DO COMMAND...: runs the command; if it fails, says which and what to do.
step() {
    local advice=$1 status=0
    shift
    "$@" || status=$?
    if [ "$status" -ne 0 ]; then
        printf '\n%s: this command failed with status %d (in %s):\n  %s\n%s\n' \
            "$(basename "$0")" "$status" "$PWD" "$*" "$advice" >&2
        exit 1
    fi
}

installed() { [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null || true)" = installed ]; }

# A Kokkos of the user's own is named in one of these; otherwise it is built here.
builds_kokkos() { [ -z "${Kokkos_ROOT:-}${CMAKE_PREFIX_PATH:-}" ]; }
needs_pip() {
    builds_kokkos && [ ! -e "$arenite_root/deps/fetched-kokkos" ] && ! python3 -m pip --version >/dev/null 2>&1
}

install_debian_packages() {
    local missing=() package
    for package in "${arenite_packages[@]}"; do
        installed "$package" || missing+=("$package")
    done
    if needs_pip; then missing+=(python3-pip); fi
    [ ${#missing[@]} -gt 0 ] || return 0

    local as_root=()
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null || fail "these packages are missing, and installing them needs root or sudo:
  apt-get install ${missing[*]}
Or install the same libraries where you may and name them: export CMAKE_PREFIX_PATH=<prefix>:<prefix>"
        as_root=(sudo)
    fi
    say "Installing ${missing[*]}"
    step "Is the network up, and does /etc/apt name a mirror that answers?" \
        "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq update
    step "Try the command by hand; where a package has another name, install its library and set CMAKE_PREFIX_PATH." \
        "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Dpkg::Use-Pty=0 -o APT::Color=0 install --yes \
        --no-install-recommends "${missing[@]}" >"$arenite_root/build/apt.log"
}

# Without apt: CMake finds what there is; only say early what it will miss.
check_tools() {
    local tool missing=()
    for tool in g++ cmake ninja; do
        command -v "$tool" >/dev/null || [ "$tool" = g++ -a -n "${CXX:-}" ] || missing+=("$tool")
    done
    if needs_pip; then missing+=("python3 with pip (or Kokkos_ROOT=<prefix of an installed Kokkos 4.5>)"); fi
    [ ${#missing[@]} -eq 0 ] || fail "this system has no apt-get, so please install yourself: $(printf '%s, ' "${missing[@]}" | sed 's/, $//')
Libraries: fmt, toml++, CLI11, nlohmann-json and GoogleTest; for the full set Open MPI, parallel HDF5 and VTK 9.1.
What is not in a standard place is named by: export CMAKE_PREFIX_PATH=<prefix>:<prefix>   (Kokkos: Kokkos_ROOT)"
}

arenite_set_up() {
    cd "$arenite_root"
    mkdir -p build
    if command -v apt-get >/dev/null && command -v dpkg-query >/dev/null; then
        install_debian_packages
    else
        check_tools
    fi
    if builds_kokkos; then
        step "With a Kokkos 4.5 or newer of your own, set Kokkos_ROOT to its prefix and run this again." cmake/fetch_deps.sh
    fi
    # A run needs no report: without a Python for it everything else works, and it is tried again next time.
    [ -n "${ARENITE_PYTHON:-}" ] || cmake/fetch_deps.sh --report ||
        say "No Python for the report (see above): runs work, arenite report does not"
    if [ ! -e "$arenite_build/build.ninja" ]; then
        say "Configuring (preset openmp)"
        # A configure that stopped half-way may have remembered what it did not find.
        rm -rf "$arenite_build/CMakeCache.txt" "$arenite_build/CMakeFiles"
        step "The message above names what is missing and how to point CMake at it." cmake --preset openmp
    fi
    say "Building (preset openmp)"
    step "The first error above says why; a fresh start: rm -rf '$arenite_build'" \
        cmake --build --preset openmp --target "$1" ${ARENITE_BUILD_JOBS:+--parallel "$ARENITE_BUILD_JOBS"}
}
