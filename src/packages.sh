#!/bin/sh
# Installs what the build, the tests and the pictures need and the machine lacks, by the system's package manager,
# saying so first. Prints nothing and touches nothing where all is there.
set -eu

have() { command -v "$1" >/dev/null 2>&1; }
library() { have pkg-config && pkg-config --exists "$1"; }

complete() { { have gcc || have cc; } && have gnuplot && library hdf5 && library hwloc && library yaml-0.1 && library cmocka; }

complete && exit 0

as_root() {
    if [ "$(id -u)" = 0 ]; then "$@"
    elif have sudo; then sudo "$@"
    else echo "packages are missing and neither root nor sudo is at hand; run as root: $*" >&2; exit 1
    fi
}

if have apt-get; then
    packages="gcc libc6-dev pkg-config libhdf5-dev libhwloc-dev libyaml-dev libcmocka-dev gnuplot-nox"
    install() { as_root apt-get update -q && as_root env DEBIAN_FRONTEND=noninteractive apt-get install -qy --no-install-recommends $packages; }
elif have dnf; then
    packages="gcc pkgconf-pkg-config hdf5-devel hwloc-devel libyaml-devel libcmocka-devel gnuplot"
    install() { as_root dnf install -qy $packages; }
elif have brew; then
    packages="gcc pkg-config hdf5 hwloc libyaml cmocka gnuplot"
    install() { brew install -q $packages; }
else
    echo "no apt-get, dnf or brew here; install by hand: gcc, pkg-config, HDF5, hwloc, libyaml, cmocka, gnuplot" >&2
    exit 1
fi

echo "Cleave needs packages that this machine lacks. About to install: $packages" >&2
install
complete || { echo "some of these are still missing: $packages" >&2; exit 1; }
