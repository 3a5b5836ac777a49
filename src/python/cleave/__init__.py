"""Cleave from Python: runs scenes and reads their results.

    import cleave
    run = cleave.run("plate.yaml", {"particles.spacing": "1 mm"}, output="results/plate", threads=2)
    run = cleave.open("results/plate")            # also while the run goes on
    run.history["time"], run.history["kinetic"]   # columns of history.csv as arrays
    run.summary["crack.tips.0.growth"]            # figures of summary.json
    run.frames[-1]["stress"]                      # fields, a row for each particle, in the order of ids
    run.plot("damage", 20e-6)                     # axes of matplotlib
    cleave.Scene({"space": "plane stress", ...}).check()    # warnings; SceneError with line and key

All numbers are in SI units. Needs numpy; frames need h5py, plots matplotlib, to_pandas pandas, to_vtk vtk, to_pyvista
pyvista, which are imported at the first call. Files are read when they are requested, and again once they have changed.
"""

try:
    import numpy  # noqa: F401: the only package that every function needs
except ImportError:
    import sys

    raise ImportError(
        f"cleave: {sys.executable} has no package numpy (for it: pip install numpy; for /usr/bin/python3 of Debian: apt-get install python3-numpy)"
    ) from None

from ._errors import Error, SceneError
from ._frame import Frame, Frames
from ._program import Progress, call, program
from ._run import Figure, Probe, Run, open
from ._scene import Check, Scene, converge, run, sweep
from ._tables import Record, Table

__version__ = "0.2.0"
__all__ = ["Check", "Error", "Figure", "Frame", "Frames", "Probe", "Progress", "Record", "Run", "Scene", "SceneError", "Table", "call",
           "converge", "open", "program", "run", "sweep"]

for _name in __all__:                    # tracebacks and help name the module, not its files
    globals()[_name].__module__ = __name__
del _name
