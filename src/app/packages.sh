#!/bin/sh
# Installs what the build and the pictures need (with the argument `tests`: the tests, too) and the machine lacks, by the system's
# package manager, saying so first. Prints nothing and touches nothing where all is there.
set -eu

have() { command -v "$1" >/dev/null 2>&1; }
library() { have pkg-config && pkg-config --exists "$1"; }
reads_frames() { python3 -c "import h5py" 2>/dev/null || /usr/bin/python3 -c "import h5py" 2>/dev/null; }
reads_schemas() { python3 -c "import jsonschema, yaml" 2>/dev/null || /usr/bin/python3 -c "import jsonschema, yaml" 2>/dev/null; }
lays_out() { have clang-format-14 || ! is_bookworm; }
is_bookworm() { grep -qs '^VERSION_CODENAME=bookworm' /etc/os-release; }

# What is missing, by the names a person knows it by.
missing()
{
    have gcc || have cc || echo "a C compiler"
    have pkg-config || echo "pkg-config"
    have gnuplot || echo "gnuplot"
    library hdf5 || echo "HDF5"
    library hwloc || echo "hwloc"
    library yaml-0.1 || echo "libyaml"
    library libpng || echo "libpng"
    library libtiff-4 || echo "libtiff"
    [ "${1:-}" != tests ] || library cmocka || echo "cmocka (for the tests)"
    [ "${1:-}" != tests ] || library netcdf || echo "netCDF (for the tests)"
    [ "${1:-}" != tests ] || ! have apt-get || reads_frames || echo "h5py of Python (for a test)"
    [ "${1:-}" != tests ] || lays_out || echo "clang-format 14 (for a test)"
    [ "${1:-}" != tests ] || ! have apt-get || reads_schemas || echo "jsonschema and yaml of Python (for a test)"
}
lacking=$(missing "$@" | paste -s -d, - | sed 's/,/, /g')
[ -n "$lacking" ] || exit 0

as_root() {
    if [ "$(id -u)" = 0 ]; then "$@"
    elif have sudo; then sudo "$@"
    else echo "neither root nor sudo is at hand; whoever is root may install: $packages" >&2; exit 1
    fi
}

if have apt-get; then
    packages="gcc libc6-dev pkg-config libhdf5-dev libhwloc-dev libyaml-dev libpng-dev libtiff-dev gnuplot-nox"
    tests="libcmocka-dev libnetcdf-dev python3-h5py python3-jsonschema python3-yaml"
    ! is_bookworm || tests="$tests clang-format-14"
    install() { as_root apt-get update -q && as_root env DEBIAN_FRONTEND=noninteractive apt-get install -qy --no-install-recommends $packages; }
elif have dnf; then
    packages="gcc pkgconf-pkg-config hdf5-devel hwloc-devel libyaml-devel libpng-devel libtiff-devel gnuplot"
    tests="libcmocka-devel netcdf-devel"
    install() { as_root dnf install -qy $packages; }
elif have brew; then
    packages="gcc pkg-config hdf5 hwloc libyaml libpng libtiff gnuplot"
    tests="cmocka netcdf"
    install() { brew install -q $packages; }
else
    echo "Cleave needs what this machine lacks: $lacking; no apt-get, dnf or brew here: install it by hand" >&2
    exit 1
fi
[ "${1:-}" != tests ] || packages="$packages $tests"

echo "Cleave needs what this machine lacks: $lacking. About to install: $packages" >&2
install
lacking=$(missing "$@")
[ -z "$lacking" ] || { echo "still missing:" $lacking >&2; exit 1; }
