"""Frames: the particles of a run at one time."""

from __future__ import annotations

import builtins
import collections.abc
import os
import re
import sys
from typing import TYPE_CHECKING, Any, Dict, List, Optional, Tuple, Union

import numpy as np

from ._errors import Error, need, number_of
from ._fields import DERIVED, UNITS, components

if TYPE_CHECKING:
    import matplotlib.axes
    import pandas
    import pyvista
    import vtkmodules.vtkCommonDataModel

_particles_read: Dict[str, Tuple[Any, ...]] = {}         # by path of a particles file: its state, and what _particles_mark returned


def _particles_mark(path: str) -> Tuple[str, Optional[int]]:
    """Returns the fault of a particles file as words that complete "FILE ..." ("" if whole), and the hash of its contents. The program's
    mark at the end of the file, CLEAVEOK, gives the length that the file was written with; the bytes are not compared."""
    import h5py
    try:
        with builtins.open(path, "rb") as file:
            size = file.seek(0, os.SEEK_END)
            file.seek(max(size - 24, 0))
            mark = file.read()
        if mark[:8] != b"CLEAVEOK" or int.from_bytes(mark[8:16], sys.byteorder) != size - 24:
            return "is cut short or damaged", None
        with h5py.File(path, "r") as file:
            if getattr(file.get("VTKHDF/Types", getlink=True), "filename", ""):
                return "is a frame", None
            return "", int(file["Cleave"].attrs["content"])
    except (OSError, KeyError, RuntimeError):
        return "cannot be read as a particles file", None


def _particles_fault(frame: Any, path: str) -> str:
    """Says why the particles file to which an open frame links cannot be used; "" if it can, or if the frame is complete by itself. A
    particles file is read once, and again once it has changed."""
    beside = getattr(frame.get("VTKHDF/Types", getlink=True), "filename", "")
    if not beside:
        return ""
    file = os.path.abspath(os.path.join(os.path.dirname(path), beside))
    told = "%s in the same folder, to which it links, " % beside
    try:
        state = os.stat(file)
    except OSError:
        return told + "is missing"
    sign = (state.st_mtime_ns, state.st_size, state.st_ino)
    if _particles_read.get(file, (None,))[0] != sign:
        _particles_read[file] = (sign, _particles_mark(file))
    fault, content = _particles_read[file][1]
    if not fault and frame["Cleave"].attrs.get("content") != content:
        fault = "is of another run"
    return told + fault if fault else ""


def _text(stored: Any) -> str:
    return stored.decode() if isinstance(stored, bytes) else str(stored)


def _unit(field: Any, name: str) -> str:
    """Returns the unit of a stored field, "" without."""
    told = _text(field.attrs.get("unit", field.attrs.get("units", UNITS.get(name, ""))))
    return "" if told == "1" else told


class Frame:
    """The particles at one time, or some of them. Arrays have a row for each particle, in the order of ids (behind them, in
    runs with coarse cells, a row for each of their quadrature points). The file is read at each request.

    path  path of the file
    time  [s]
    """

    def __init__(self, path: str, time: float, rows: Optional[np.ndarray] = None):
        self.path, self.time, self._rows = path, time, rows

    def _file(self) -> Any:
        """Opens the file. Raises Error if it, or its particles file, cannot be read."""
        h5py = need("h5py", "reading frames")
        try:
            file = h5py.File(self.path, "r")
        except FileNotFoundError:
            raise Error("%s: there is no such file; check the name and the folder" % self.path) from None
        except OSError as fault:
            raise Error("%s cannot be read: %s" % (self.path, str(fault).split(" (", 1)[0])) from None
        lost = _particles_fault(file, self.path)
        if lost:
            file.close()
            raise Error("%s cannot be read: %s" % (self.path, lost))
        return file

    def _part(self, values: np.ndarray) -> np.ndarray:
        """Returns the rows of this frame."""
        return values if self._rows is None else values[self._rows]

    # ---- what is stored -------------------------------------------------------------------------------------------

    @property
    def names(self) -> List[str]:
        """Names of the stored fields."""
        with self._file() as file:
            return list(file["VTKHDF/PointData"])

    @property
    def units(self) -> Dict[str, str]:
        """Units of the stored fields, "" without."""
        with self._file() as file:
            return {name: _unit(field, name) for name, field in file["VTKHDF/PointData"].items()}

    @property
    def step(self) -> int:
        """Number of time steps until then."""
        with self._file() as file:
            return int(file["Cleave"].attrs["step"])

    @property
    def scene(self) -> str:
        """Text of the scene as run (YAML)."""
        with self._file() as file:
            return _text(file["Cleave/scene"][()])

    @property
    def dimension(self) -> int:
        """1 of a line, 2 in the plane, 3 of solids."""
        with self._file() as file:
            stored = file["Cleave/reference"]
            return int(file["Cleave"].attrs.get("dim", stored.shape[1] if len(stored.shape) > 1 else 1))

    @property
    def positions(self) -> np.ndarray:
        """Current positions [m], n x 3 in double precision; z = 0 in the plane."""
        return self.moved()

    def moved(self, magnify: float = 1.0) -> np.ndarray:
        """Returns the reference positions plus `magnify` times the displacements [m], n x 3: the points of the file have single
        precision, too coarse for small displacements and for bodies far from the origin."""
        return self.reference + magnify * self["displacement"].astype(float)

    @property
    def reference(self) -> np.ndarray:
        """Reference positions [m], n x 3 in double precision; z = 0 in the plane."""
        with self._file() as file:
            stored = file["Cleave/reference"][()]
        stored = stored.reshape(len(stored), -1)         # of a line: one number each
        return self._part(np.pad(stored, ((0, 0), (0, 3 - stored.shape[1]))))

    @property
    def spacing(self) -> np.ndarray:
        """Edge of the square or cube of each particle in the reference configuration [m], n numbers: field `spacing`, else
        `particles.spacing` of the scene, else the distance to the nearest particle (median of 200 of them)."""
        if "spacing" in self.names:
            return self["spacing"].astype(float)
        count = len(self)
        found = re.search(r"^particles:\n(?:  .*\n)*?  spacing: ([0-9.e+-]+)", self.scene, re.M)
        if found:
            return np.full(count, float(found.group(1)))
        places = self.reference
        nearest = [np.partition(np.linalg.norm(places - places[k], axis=1), 1)[1]
                   for k in np.linspace(0, count - 1, min(count, 200)).astype(int)] if count > 1 else [0.0]
        return np.full(count, float(np.median(nearest)))

    def _stored(self, name: str) -> Optional[np.ndarray]:
        """Returns a stored field, or None. Contact forces that a frame leaves out are 0."""
        with self._file() as file:
            fields = file["VTKHDF/PointData"]
            if name in fields:
                return self._part(fields[name][()])
            if name == "contact_force" and "zero" in file["Cleave"].attrs:
                return self._part(np.zeros(file["VTKHDF/Points"].shape, file["VTKHDF/Points"].dtype))
        return None

    def _found(self, name: str) -> Optional[np.ndarray]:
        """Returns a stored field, or one that follows from a stored one, or None."""
        values = self._stored(name)
        if values is None and name in DERIVED:
            values = self._stored(DERIVED[name][0])
            return None if values is None else DERIVED[name][1](values)
        return values

    def __getitem__(self, which: Any) -> Any:
        """A field by name, or the particles of a mask or of indices as a Frame.

        Names: stored fields (n numbers, n x 3 of vectors, n x 6 of tensors: xx yy zz xy yz xz), their components
        ("velocity_y", "stress_xy"), and von_mises, pressure, principal_stress [Pa] and speed [m/s], which follow from
        stress and velocity if they are not stored. Raises KeyError with the names that are there.
        """
        if not isinstance(which, str):
            try:
                rows = np.arange(len(self))[which]
            except IndexError:
                raise IndexError("frame[...]: the name of a field, or a mask or indices of its %d particles" % len(self)) from None
            return Frame(self.path, self.time, np.atleast_1d(rows if self._rows is None else self._rows[rows]))
        values = self._found(which)
        if values is None and "_" in which:
            name, _, suffix = which.rpartition("_")
            whole = self._found(name)
            parts = () if whole is None else components(name, whole)
            suffix = suffix if suffix in parts else suffix[::-1]     # stress_zx is stress_xz
            if whole is not None and suffix in parts:
                values = whole[:, parts.index(suffix)]
        if values is None:
            raise KeyError("%s; this frame has %s" % (which, ", ".join(self.names)))
        return values

    def unit(self, name: str) -> str:
        """Returns the unit of a field or component of a field, "" without. Raises KeyError with the names that are there."""
        units = {**UNITS, "von_mises": "Pa", "pressure": "Pa", "principal_stress": "Pa", "speed": "m/s", **self.units}
        for known in (name, name.rpartition("_")[0]):
            if known in units:
                return units[known]
        raise KeyError("%s; this frame has %s" % (name, ", ".join(self.names)))

    # ---- parts and other forms ------------------------------------------------------------------------------------

    def slice(self, x: Optional[float] = None, y: Optional[float] = None, z: Optional[float] = None,
              thickness: Optional[float] = None) -> Frame:
        """Returns the particles whose reference position is in a layer about a plane, as a Frame: frame.slice(z=4e-3).

        x, y, z    position of the plane along one axis [m]
        thickness  of the layer [m]; default: the layers of particles that the plane cuts; of a plane midway between two
                   layers the upper one

        Raises ValueError for a plane that no particle is at, and along an axis that the frame does not have.
        """
        given = [(k, at) for k, at in enumerate((x, y, z)) if at is not None]
        if len(given) != 1:
            raise ValueError("slice takes one of x, y, z [m]")
        axis, at = given[0][0], number_of(given[0][1], "xyz"[given[0][0]], "a number [m]")
        if axis >= self.dimension:
            raise ValueError("slice: this frame has %s, no %s" % (["x alone", "x and y"][self.dimension - 1], "xyz"[axis]))
        if thickness is not None:
            thickness = number_of(thickness, "thickness", "a number from 0 [m]", 0.0)
        places = self.reference[:, axis]
        distance = places - at
        tiny = 1e-6 * self.spacing
        if thickness is not None:
            inside = np.abs(distance) <= thickness / 2 + tiny
        else:
            inside = (distance > -self.spacing / 2 + tiny) & (distance <= self.spacing / 2 + tiny)
        if len(self) and not inside.any():
            raise ValueError("no particle at %s = %g m; they are from %g to %g m" % ("xyz"[axis], at, places.min(), places.max()))
        return self[inside]

    def to_pandas(self) -> pandas.DataFrame:
        """Returns a DataFrame of pandas with a row for each particle, by id: current positions x, y, z [m], reference
        positions x_ref, y_ref, z_ref [m], fields and components of fields ("stress_xx"). attrs: "units", "time" [s]."""
        pandas = need("pandas", "to_pandas")
        columns: Dict[str, np.ndarray] = {}
        units: Dict[str, str] = {}
        for suffix, values in (("", self.positions), ("_ref", self.reference)):
            columns.update((axis + suffix, values[:, k]) for k, axis in enumerate("xyz"))
        units.update((name, "m") for name in columns)
        for name, unit in self.units.items():
            values = self[name]
            named = [name + "_" + suffix for suffix in components(name, values)] or [name]
            columns.update(zip(named, values.reshape(len(values), int(np.prod(values.shape[1:]))).T))
            units.update((column, unit) for column in named)
        table = pandas.DataFrame(columns)
        table.attrs.update(units=units, time=self.time)
        return table.set_index("id") if "id" in table else table

    def to_vtk(self, cells: str = "points", magnify: float = 1.0) -> vtkmodules.vtkCommonDataModel.vtkUnstructuredGrid:
        """Returns an unstructured grid of VTK with the stored fields, as arrays that are not copied.

        cells    "points": one vertex for each particle, fields and `spacing` [m] as point data; "boxes": one quadrilateral
                 or hexahedron (line: line element) for each, deformed as its neighbours are, fields as cell data
        magnify  factor on displacements [1]
        """
        from ._mesh import grid_of
        return grid_of(self, cells, magnify)

    def to_pyvista(self, cells: str = "points", magnify: float = 1.0) -> pyvista.UnstructuredGrid:
        """Returns the grid of to_vtk for PyVista: frame.to_pyvista("boxes").plot(scalars="damage")."""
        return need("pyvista", "to_pyvista").wrap(self.to_vtk(cells, magnify))

    def plot(self, field: Optional[str] = None, ax: Any = None, **options: Any) -> matplotlib.axes.Axes:
        """Draws a field by matplotlib and returns the axes; options: those of Run.plot."""
        from ._draw import draw_frame
        return draw_frame(self, field, ax, **options)

    def __len__(self) -> int:
        if self._rows is not None:
            return len(self._rows)
        with self._file() as file:
            return file["VTKHDF/Points"].shape[0]

    __iter__ = None                      # neither names nor particles: request them by name

    def __contains__(self, name: str) -> bool:
        return name in self.names

    def __repr__(self) -> str:
        return "<Frame %s at %.6g s%s>" % (self.path, self.time, "" if self._rows is None else ", %d particles of it" % len(self._rows))


class Frames(collections.abc.Sequence):
    """The frames of a run, in order of time: a sequence whose files are opened when a field is requested."""

    def __init__(self, listed: List[Tuple[str, float]]):
        self._listed = listed

    @property
    def times(self) -> np.ndarray:
        """Times of all frames [s]."""
        return np.array([time for _, time in self._listed])

    def at(self, time: float) -> Frame:
        """Returns the frame nearest to a time [s]. Raises IndexError if there is none at all, ValueError for a time that is no number, or
        before the first or after the last frame by more than half an interval between frames."""
        if not self._listed:
            raise IndexError("the run has no frames yet")
        time = number_of(time, "time", "a number [s]")
        times = self.times
        room = 0.5 * float(np.diff(times).max(initial=0.0)) + 1e-9 * float(np.abs(times).max())
        if not times.min() - room <= time <= times.max() + room:
            raise ValueError("time: %g s is not in the run, whose frames are from %g to %g s" % (time, times.min(), times.max()))
        return self[int(np.argmin(np.abs(times - time)))]

    def __len__(self) -> int:
        return len(self._listed)

    def __getitem__(self, which: Union[int, slice]) -> Any:
        if isinstance(which, slice):
            return Frames(self._listed[which])
        return Frame(*self._listed[which])

    def __repr__(self) -> str:
        return "<%d frames>" % len(self)
