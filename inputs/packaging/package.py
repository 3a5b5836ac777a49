"""Spack recipe of Cleave. In a repository of your own: packages/cleave/package.py; the tarball is that of `make dist`."""
from spack.package import *


class Cleave(MakefilePackage):
    """Dynamic fracture by peridynamics and the material point method, on one multicore workstation."""

    url = "file:///path/to/cleave-0.1.0.tar.gz"

    version("0.1.0")  # spack checksum fills in the digest

    variant("gnuplot", default=True, description="pictures of cleave plot")

    depends_on("c", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("hdf5@1.10: ~mpi")
    depends_on("hwloc@2:")
    depends_on("libyaml")
    depends_on("libpng")
    depends_on("libtiff")
    depends_on("gnuplot", type="run", when="+gnuplot")

    def build(self, spec, prefix):
        make("all")

    def install(self, spec, prefix):
        make("install", "PREFIX={0}".format(prefix))
