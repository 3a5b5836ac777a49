"""What runs and studies leave in their folders."""

from __future__ import annotations

import builtins
import dataclasses
import json
import os
import re
from typing import TYPE_CHECKING, Any, Callable, Dict, List, Optional, Union

import numpy as np

from ._errors import Error
from ._frame import Frame, Frames
from ._tables import Named, Record, Table

if TYPE_CHECKING:
    import matplotlib.axes


class Probe:
    """What one probe has measured, in SI units.

    figures   its part of the summary, a Record; empty before the summary is written
    history   its columns of history.csv, arrays by their names without the probe's
    profiles  of line probes a Table for each frame
    """

    def __init__(self, name: str, figures: Record, history: Dict[str, np.ndarray], profiles: List[Table]):
        self.name, self.figures, self.history, self.profiles = name, figures, history, profiles

    def __getitem__(self, name: str) -> Any:
        """A column of the history; else a figure."""
        return self.history[name] if name in self.history else self.figures[name]

    def __repr__(self) -> str:
        return "<Probe %s: %s>" % (self.name, ", ".join([*self.history, *(n for n in self.figures if n not in self.history)]))


@dataclasses.dataclass(frozen=True)
class Figure:
    """A figure of a convergence study with its error bar, in `unit`.

    value, uncertainty  at the finest spacing; half of the 95 % interval of the true value
    scatter             half of the 95 % interval that comes from the scatter of runs
    discretisation      the same from the spacing
    verdict             what the means do as the spacing decreases: "converges", "scatters", ...
    extrapolated        limit for spacing 0; nan if there is none
    spacings            [m], from fine to coarse, as the arrays that follow
    means, uncertainties, runs  mean of the runs at each spacing, its uncertainty, the number of runs
    """

    name: str
    unit: str
    value: float
    uncertainty: float
    scatter: float
    discretisation: float
    verdict: str
    extrapolated: float
    spacings: np.ndarray
    means: np.ndarray
    uncertainties: np.ndarray
    runs: np.ndarray

    def plot(self, ax: Any = None) -> matplotlib.axes.Axes:
        """Draws the means with their error bars over the spacing, by matplotlib, and returns the axes."""
        from ._draw import draw_figure
        return draw_figure(self, ax)

    def __str__(self) -> str:
        return "%s = %.4g +- %.2g%s" % (self.name, self.value, self.uncertainty, " " + self.unit if self.unit else "")


def _figure_of(table: Table, row: int) -> Figure:
    """Returns a row of converge.csv as a Figure."""
    def number(name: str) -> float:
        return float(table[name][row]) if name in table else float("nan")

    levels = [k for k in range(6) if "spacing_%d" % k in table and np.isfinite(number("spacing_%d" % k))]
    series = [np.array([number("%s_%d" % (name, k)) for k in levels]) for name in ("spacing", "mean", "uncertainty", "runs")]
    return Figure(str(table["figure"][row]), str(table["unit"][row]).replace("nan", ""), number("value"), number("uncertainty"),
                  number("scatter"), number("discretisation"), str(table["verdict"][row]), number("extrapolated"), *series)


class Run:
    """What a run, or a study, has left in its folder so far. A request for a file that is not there raises Error.

    folder  path of the folder
    """

    _TABLES = ("history.csv", "fragments.csv", "sweep.csv", "converge.csv")
    _SIGNS = (*_TABLES, "summary.json", "scene.yaml", "frames.hdf.series")

    def __init__(self, folder: Union[str, "os.PathLike[str]"]):
        self.folder: str = os.fspath(folder)
        self._read: Dict[str, Any] = {}
        if not any(os.path.exists(self._path(name)) for name in self._SIGNS):
            raise Error("%s: no run there: no summary.json, history.csv or frames" % self.folder)

    def _path(self, name: str) -> str:
        return os.path.join(self.folder, name)

    def _kept(self, name: str, read: Callable[[str], Any]) -> Any:
        """Returns what `read` makes of a file; calls it again only once the file has changed."""
        path = self._path(name)
        try:
            state = os.stat(path)
            sign = (state.st_mtime_ns, state.st_size, state.st_ino)
            if self._read.get(name, (None,))[0] != sign:
                self._read[name] = (sign, read(path))
        except FileNotFoundError:
            raise Error("%s: there is no such file; check the name and the folder" % path) from None
        return self._read[name][1]

    # ---- tables and figures ---------------------------------------------------------------------------------------

    def table(self, name: str) -> Table:
        """Returns any table of the folder: table("history.csv")."""
        return self._kept(name, Table)

    @property
    def history(self) -> Table:
        """history.csv: a row for each sample so far."""
        return self.table("history.csv")

    @property
    def fragments(self) -> Table:
        """fragments.csv: a row for each fragment at the end."""
        return self.table("fragments.csv")

    @property
    def sweep(self) -> Table:
        """sweep.csv of a study: a row for each run."""
        return self.table("sweep.csv")

    @property
    def converge(self) -> Table:
        """converge.csv of a study: a row for each figure."""
        return self.table("converge.csv")

    @property
    def figures(self) -> Dict[str, Figure]:
        """Figures of a convergence study with their error bars, by name."""
        table = self.converge
        return {str(name): _figure_of(table, row) for row, name in enumerate(table["figure"])}

    @property
    def runs(self) -> Dict[str, Run]:
        """Runs of a study by the names of their folders, as in the column `run` of sweep.csv."""
        listed = [str(name) for name in self.sweep["run"]] if os.path.exists(self._path("sweep.csv")) else sorted(os.listdir(self.folder))
        folders = [name for name in listed if os.path.exists(self._path(os.path.join(name, "scene.yaml")))]
        return {name: Run(self._path(name)) for name in folders}

    @staticmethod
    def _json(path: str) -> Any:
        try:
            with builtins.open(path, encoding="utf-8") as file:
                return json.load(file)
        except ValueError as fault:
            raise Error("%s is not whole: %s" % (path, fault)) from None

    @property
    def summary(self) -> Record:
        """summary.json; written when the run ends."""
        return Record(self._kept("summary.json", self._json))

    @property
    def status(self) -> str:
        """Status by the summary: "done", "interrupted", "failed"; "no summary yet" while the run goes on; of a study
        "study"."""
        if any(os.path.exists(self._path(name)) for name in ("sweep.csv", "converge.csv")):
            return "study"
        return self.summary["status"] if os.path.exists(self._path("summary.json")) else "no summary yet"

    @property
    def warnings(self) -> List[str]:
        """Warnings of the run; empty while it goes on."""
        return list(self.summary["warnings"]) if os.path.exists(self._path("summary.json")) else []

    @property
    def scene(self) -> str:
        """Text of the scene as run, with every default (YAML)."""
        with builtins.open(self._path("scene.yaml"), encoding="utf-8") as file:
            return file.read()

    @property
    def probes(self) -> Dict[str, Probe]:
        """Probes by name."""
        history = self.history if os.path.exists(self._path("history.csv")) else {}
        figures = {}
        if os.path.exists(self._path("summary.json")):
            figures = self.summary._entries.get("probes", {})
        files = sorted(os.listdir(self.folder))
        profiles = [re.fullmatch(r"(.+)_\d{6}\.csv", name) for name in files]
        names = {**dict.fromkeys(figures), **{m.group(1): None for m in profiles if m}}
        names.update((column.rpartition(".")[0], None) for column in history if "." in column)
        return Named({name: Probe(name, Record(figures.get(name, {})),
                                  {c[len(name) + 1:]: history[c] for c in history if c.startswith(name + ".")},
                                  [self.table(m.group()) for m in profiles if m and m.group(1) == name]) for name in names},
                     "the list of probes")

    # ---- frames ---------------------------------------------------------------------------------------------------

    @property
    def frames(self) -> Frames:
        """The frames so far; none without frames.hdf.series."""
        return self._series("frames.hdf.series")

    @property
    def regions(self) -> Dict[str, Frames]:
        """The frames of each region of `output.regions`, by its name."""
        found = [re.fullmatch(r"(.+)\.hdf\.series", name) for name in sorted(os.listdir(self.folder))]
        return Named({m.group(1): self._series(m.group()) for m in found if m and m.group(1) != "frames"}, "the list of regions")

    def _series(self, name: str) -> Frames:
        if not os.path.exists(self._path(name)):
            return Frames([])
        listed = self._kept(name, self._json)["files"]
        return Frames([(self._path(entry["name"]), float(entry["time"])) for entry in listed])

    def plot(self, field: Optional[str] = None, time: Optional[float] = None, ax: Any = None, *, magnify: float = 1.0,
             limits: Any = None, colours: Optional[str] = None, colour_bar: bool = True,
             slice: Optional[Dict[str, float]] = None) -> matplotlib.axes.Axes:
        """Draws a field of a frame by matplotlib and returns the axes. Each particle is drawn with the shape that it has been
        deformed to, solids as a section, bars as a curve; rigid bodies are outlines. Axes are in m, mm or µm.

        field       name as of frame[...]; a vector is drawn by its length, of a bar by its component along it. Default:
                    damage if bonds are broken, else plastic strain if there is any, else von Mises stress
        time        frame nearest to this time [s], within the run; default: the last one
        ax          axes to draw into; default: new ones
        magnify     factor on displacements, above 0 [1]
        limits      lowest and highest value of the colour bar [SI unit of the field]; default: those of `cleave plot`: from 0, or
                    symmetric about 0 for fields with a sign, to all values but the extreme 0.2 %
        colours     name of a colour map of matplotlib; default: that of `cleave plot` for the field
        colour_bar  False: draws none
        slice       plane of the section of a solid: {"z": 4e-3} [m]; default: that of `cleave plot`, normal to the shortest side of
                    the body, through the layer with the most damage, else the middle

        Raises KeyError for a field that is not there or a tensor, IndexError if there are no frames, ValueError for a time beyond
        the run, a section without particles or of a frame that is no solid.
        """
        frames = self.frames
        if not frames:
            raise IndexError("the run has no frames yet")
        frame: Frame = frames[-1] if time is None else frames.at(time)
        return frame.plot(field, ax, magnify=magnify, limits=limits, colours=colours, colour_bar=colour_bar, slice=slice)

    def __repr__(self) -> str:
        return "<Run %s: %s>" % (self.folder, self.status)


def open(folder: Union[str, "os.PathLike[str]"]) -> Run:  # noqa: A001: the name of the module's other verb
    """Returns the Run in a folder, finished or not; also the folder of a study, which has `sweep` or `converge`. Raises
    Error if there is neither."""
    return Run(folder)
