"""Cleave from Python: run scenes, read what runs leave.

    import cleave
    run = cleave.run("plate.yaml", {"particles.spacing": "1 mm"}, output="results/plate", threads=2)
    run = cleave.open("results/plate")            # also while it is still running
    run.history["time"], run.history["kinetic"]   # columns of history.csv as arrays
    run.summary["crack.tips.0.growth"]            # figures of summary.json
    run.frames[-1]["stress"]                      # fields, a row for each particle, in the order of ids
    run.regions["tip"].at(20e-6)["strain"]        # frames of a region of output.regions

All numbers are in SI units. Needs numpy; frames need h5py as well. Files are read when they are asked for, and again
once they have changed.
"""

import builtins
import collections.abc
import csv
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

import numpy as np

__all__ = ["Error", "Frame", "Frames", "Probe", "Record", "Run", "Table", "call", "open", "program", "run"]


class Error(Exception):
    """What the program refused or failed at, in its one line. `status`: its exit status: 1 the run failed, 2 the scene
    or the command line is wrong, 130 interrupted after a checkpoint; None: no program has spoken."""

    def __init__(self, message, status=None):
        super().__init__(message)
        self.status = status


# ---- the program --------------------------------------------------------------------------------------------------


def program():
    """Path of the program: $CLEAVE, else the one that was built or installed with this module, else that on PATH.
    Raises Error where there is none."""
    here = os.path.dirname(os.path.abspath(__file__))
    beside = [os.path.join(here, "cleave")]                      # beside the module
    beside.append(os.path.join(here, "..", "..", "build", "cleave"))            # src/python of a checkout
    beside.append(os.path.join(here, "..", "..", "..", "bin", "cleave"))         # PREFIX/lib/python3/dist-packages
    named = os.environ.get("CLEAVE")
    for path in [named] if named else beside + [shutil.which("cleave")]:
        if path and os.path.isfile(path) and os.access(path, os.X_OK):
            return os.path.normpath(path)
    raise Error("CLEAVE=%s is no program" % named if named else
                "no program cleave beside the module or on PATH; set CLEAVE to its path")


def _words_of(value):
    """A value as `-s key=value` takes it."""
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    if isinstance(value, str):
        return value
    if isinstance(value, (list, tuple, np.ndarray)):
        return "[" + ", ".join(_words_of(entry) for entry in value) + "]"
    raise TypeError("a scene takes text, numbers, booleans and lists, not %r" % (value,))


def call(*words, quiet=True):
    """Runs a command of the program, as call("plot", "results/plate"); returns what it printed, as text. Warnings and
    progress go to standard error unless `quiet`. Raises Error with the program's line where it ends with another
    status than 0. Ctrl-C goes to the program, which ends with a checkpoint; then KeyboardInterrupt is raised."""
    command = [program(), *(os.fspath(w) if isinstance(w, os.PathLike) else str(w) for w in words)]
    last = ""
    with tempfile.TemporaryFile("w+", errors="replace") as printed, \
            subprocess.Popen(command, stdout=printed, stderr=subprocess.PIPE, text=True, errors="replace") as child:
        try:
            for line in child.stderr:
                if not quiet:
                    sys.stderr.write(line)
                last = line.strip() or last
        except KeyboardInterrupt:
            child.wait()                 # it has been interrupted as well
            raise
        if child.wait():
            raise Error(last or "cleave ended with status %d" % child.returncode, child.returncode)
        printed.seek(0)
        return printed.read()


def run(scene, overrides=None, output=None, threads=None, resume=False, overwrite=False, quiet=True):
    """Runs a scene to its end and returns its Run.

    scene      path of a scene file
    overrides  keys and values that are laid over it: {"particles.spacing": "1 mm", "boundary.0.velocity": [0, 20.0]};
               numbers are SI
    output     folder of the results; default results/ and the scene's name
    threads    default: as the program chooses; results do not depend on it
    resume     goes on from a checkpoint; does nothing where the run is done
    overwrite  replaces an older run, which is refused otherwise
    quiet      False: warnings and progress go to standard error
    """
    words = ["run", os.fspath(scene)]
    for key, value in (overrides or {}).items():
        words += ["-s", "%s=%s" % (key, _words_of(value))]
    if output is not None:
        words += ["-o", os.fspath(output)]
    if threads is not None:
        words += ["-t", str(int(threads))]
    words += ["--resume"] * bool(resume) + ["--overwrite"] * bool(overwrite)
    printed = call(*words, quiet=quiet)
    if output is None:
        found = re.search(r"^  results in (.*); open \1/", printed, re.M)
        output = found.group(1) if found else None
    if output is None:
        raise Error("the program did not say where its results are; give output")
    return open(output)


def open(folder):                        # noqa: A001: the name of the module's other verb
    """The Run in a folder, finished or not; also the folder of a study, which has `sweep` or `converge`. Raises Error
    where there is neither."""
    return Run(folder)


# ---- tables -------------------------------------------------------------------------------------------------------


# Earlier and present names of columns of history.csv and of entries of summary.json: both name the same (the list of the program:
# src/output/renamed_results.c).
_RENAMED = (("rest_share", "inactive_share"), ("overload", "stretch_ratio"), ("directions", "search_directions"),
            ("returned", "reverted"), ("returns_most", "reversions_most"), ("return_energy", "reversion_energy"))
_OTHER = {**dict(_RENAMED), **{now: old for old, now in _RENAMED}}


def _entry(entries, name, what):
    """entries[name]; the KeyError of a name that is not there says which are."""
    if name not in entries and _OTHER.get(name) in entries:
        return entries[_OTHER[name]]
    if name not in entries:
        there = [str(entry) for entry in entries]
        listed = ", ".join(there[:40] + ["..."] * (len(there) > 40))
        raise KeyError("%s; %s has %s" % (name, what, listed or "nothing"))
    return entries[name]


def _number(text):
    return float(text) if text else float("nan")


def _column(cells):
    """Numbers where all cells are numbers or empty, else text."""
    try:
        return np.array([_number(cell) for cell in cells], dtype=float)
    except ValueError:
        return np.array(cells, dtype=str)


class Table(collections.abc.Mapping):
    """Columns of a CSV file by name: table["kinetic"] is an array of `rows` numbers (nan: none), or of text where a
    cell is no number. `units` has the unit of each column, "" without. A last line that is still being written is left
    out."""

    def __init__(self, path):
        with builtins.open(path, newline="", encoding="utf-8", errors="replace") as file:
            text = file.read()
        lines = list(csv.reader(text[:text.rfind("\n") + 1].splitlines()))
        if not lines:
            raise Error("%s: no header yet" % path)
        heads = [re.fullmatch(r"(.*?)(?: \[(.*)\])?", head) for head in lines[0]]
        whole = [line for line in lines[1:] if len(line) == len(heads)]
        self.path, self.rows = path, len(whole)
        self.units = {head.group(1): head.group(2) or "" for head in heads}
        self._columns = {head.group(1): _column([line[k] for line in whole]) for k, head in enumerate(heads)}

    def __getitem__(self, name):
        return _entry(self._columns, name, os.path.basename(self.path))

    def __iter__(self):
        return iter(self._columns)

    def __len__(self):
        return len(self._columns)

    def __repr__(self):
        return "<Table %s: %d rows of %s>" % (self.path, self.rows, ", ".join(self._columns))


class Record(collections.abc.Mapping):
    """Figures by name or path: summary["crack"]["tips"][0]["x"], summary["crack.tips.0.x"], summary.crack.tips[0].x.
    A name that is there as it stands comes before a path."""

    def __init__(self, entries):
        self._entries = entries

    @staticmethod
    def _shown(value):
        if isinstance(value, dict):
            return Record(value)
        return [Record._shown(entry) for entry in value] if isinstance(value, list) else value

    @staticmethod
    def _walk(value, path):
        """The entry of a dictionary or list with this path, whose names may have dots themselves; KeyError."""
        if isinstance(value, list):
            head, _, rest = path.partition(".")
            found = _entry({str(k): entry for k, entry in enumerate(value)}, head, "the list")
            return Record._walk(found, rest) if rest else found
        if not isinstance(value, dict):
            raise KeyError("%s; there is a single figure: %r" % (path, value))
        for name in value:
            if path.startswith(name + ".") and path not in value:
                return Record._walk(value[name], path[len(name) + 1:])
        return _entry(value, path, "this record")

    def __getitem__(self, path):
        return Record._shown(Record._walk(self._entries, path))

    def __getattr__(self, name):
        if name.startswith("_") or name not in self._entries:
            raise AttributeError(name)
        return Record._shown(self._entries[name])

    def __iter__(self):
        return iter(self._entries)

    def __len__(self):
        return len(self._entries)

    def __repr__(self):
        return "Record(%s)" % json.dumps(self._entries, indent=2)


# ---- frames -------------------------------------------------------------------------------------------------------

_UNITS = {"displacement": "m", "velocity": "m/s", "stress": "Pa", "contact_force": "N", "spacing": "m"}


_particles_read = {}                     # by path of a particles file: its sign, and what _particles_mark returned


def _particles_mark(path):
    """Fault of a particles file as words that complete "FILE ..." ("" if whole), and the hash of its contents. The program's mark at
    the end of the file, CLEAVEOK, gives the length that the file was written with; the bytes are not compared."""
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


def _particles_fault(frame, path):
    """Says why the particles file to which an open frame links cannot be used; "" if it can, or if the frame is complete by itself. A
    particles file is read once, and again once it has changed."""
    beside = getattr(frame.get("VTKHDF/Types", getlink=True), "filename", "")
    if not beside:
        return ""
    file = os.path.abspath(os.path.join(os.path.dirname(path), beside))
    told = "%s beside it, to which it links, " % beside
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


class Frame:
    """The particles at one time. Arrays have a row for each particle, in the order of ids (behind them, in runs with
    coarse cells, a row for each of their quadrature points); nothing is kept.

    time, step   [s]; number of steps until then
    names        of the fields
    units        of each field, "" without
    scene        text of the scene as run (YAML)
    """

    def __init__(self, path, time):
        self.path, self.time = path, time

    def _file(self):
        try:
            import h5py
        except ImportError:
            raise ImportError("frames are read by h5py, which is missing (Debian: apt-get install python3-h5py)") from None
        try:
            file = h5py.File(self.path, "r")
        except FileNotFoundError:
            raise Error("%s: there is no such file" % self.path) from None
        except OSError as fault:
            raise Error("%s cannot be read: %s" % (self.path, str(fault).split(" (", 1)[0])) from None
        fault = _particles_fault(file, self.path)
        if fault:
            file.close()
            raise Error("%s cannot be read: %s" % (self.path, fault))
        return file

    @property
    def names(self):
        with self._file() as file:
            return list(file["VTKHDF/PointData"])

    @property
    def units(self):
        with self._file() as file:
            return {name: _unit(field, name) for name, field in file["VTKHDF/PointData"].items()}

    @property
    def step(self):
        with self._file() as file:
            return int(file["Cleave"].attrs["step"])

    @property
    def scene(self):
        with self._file() as file:
            text = file["Cleave/scene"][()]
        return text.decode() if isinstance(text, bytes) else str(text)

    @property
    def positions(self):
        """Places now [m], n x 3; z = 0 in the plane."""
        with self._file() as file:
            return file["VTKHDF/Points"][()]

    @property
    def reference(self):
        """Places at rest [m], n x 3 in double precision; z = 0 in the plane."""
        with self._file() as file:
            stored = file["Cleave/reference"][()]
        stored = stored.reshape(len(stored), -1)         # of a line: one number each
        return np.pad(stored, ((0, 0), (0, 3 - stored.shape[1])))

    def __getitem__(self, name):
        """A field: n numbers, or n x 3 of vectors, n x 6 (xx yy zz xy yz xz) of tensors; KeyError names those there.
        Contact forces that a frame leaves out are 0."""
        with self._file() as file:
            fields = file["VTKHDF/PointData"]
            if name not in fields and name == "contact_force" and "zero" in file["Cleave"].attrs:
                return np.zeros(file["VTKHDF/Points"].shape, file["VTKHDF/Points"].dtype)
            if name not in fields:
                raise KeyError("%s; this frame has %s" % (name, ", ".join(fields)))
            return fields[name][()]

    def __len__(self):
        with self._file() as file:
            return file["VTKHDF/Points"].shape[0]

    def __repr__(self):
        return "<Frame %s at %.6g s>" % (self.path, self.time)


def _unit(field, name):
    told = field.attrs.get("unit", field.attrs.get("units"))
    if told is None:
        return _UNITS.get(name, "")
    told = told.decode() if isinstance(told, bytes) else str(told)
    return "" if told == "1" else told


class Frames(collections.abc.Sequence):
    """The frames of a run, in order of time: a sequence whose files are opened when a field is asked for."""

    def __init__(self, listed):
        self._listed = listed

    @property
    def times(self):
        """[s] of all frames."""
        return np.array([time for _, time in self._listed])

    def at(self, time):
        """The frame nearest to a time [s]; IndexError where there is none at all."""
        if not self._listed:
            raise IndexError("the run has no frames yet")
        return self[int(np.argmin(np.abs(self.times - time)))]

    def __len__(self):
        return len(self._listed)

    def __getitem__(self, which):
        if isinstance(which, slice):
            return Frames(self._listed[which])
        return Frame(*self._listed[which])

    def __repr__(self):
        return "<%d frames>" % len(self)


# ---- runs ---------------------------------------------------------------------------------------------------------


class Probe:
    """What one probe has measured: `figures` of the summary (empty before it is written), `history`, its columns of
    history.csv by their names without the probe's, and `profiles`, a Table for each frame of line probes."""

    def __init__(self, name, figures, history, profiles):
        self.name, self.figures, self.history, self.profiles = name, figures, history, profiles

    def __getitem__(self, name):
        """A column of the history; else a figure."""
        return self.history[name] if name in self.history else self.figures[name]

    def __repr__(self):
        return "<Probe %s: %s>" % (self.name, ", ".join([*self.history, *(n for n in self.figures if n not in self.history)]))


class Run:
    """What a run, or a study, has left in its folder so far. A file that is not there raises Error, with its name."""

    _TABLES = {"history": "history.csv", "fragments": "fragments.csv", "sweep": "sweep.csv",
               "converge": "converge.csv"}
    _SIGNS = (*_TABLES.values(), "summary.json", "scene.yaml", "frames.hdf.series")

    def __init__(self, folder):
        self.folder = os.fspath(folder)
        self._read = {}
        if not any(os.path.exists(self._path(name)) for name in self._SIGNS):
            raise Error("%s: no run there: no summary.json, history.csv or frames" % self.folder)

    def _path(self, name):
        return os.path.join(self.folder, name)

    def _kept(self, name, read):
        """What `read` makes of a file, again only once the file has changed."""
        path = self._path(name)
        try:
            state = os.stat(path)
            sign = (state.st_mtime_ns, state.st_size, state.st_ino)
            if self._read.get(name, (None,))[0] != sign:
                self._read[name] = (sign, read(path))
        except FileNotFoundError:
            raise Error("%s: there is no such file" % path) from None
        return self._read[name][1]

    def table(self, name):
        """Any table of the folder, as a Table: table("history.csv")."""
        return self._kept(name, Table)

    history = property(lambda self: self.table("history.csv"), doc="history.csv: a row for each sample so far.")
    fragments = property(lambda self: self.table("fragments.csv"), doc="fragments.csv: a row for each piece at the end.")
    sweep = property(lambda self: self.table("sweep.csv"), doc="sweep.csv of a study: a row for each run.")
    converge = property(lambda self: self.table("converge.csv"), doc="converge.csv of a study: a row for each figure.")

    @staticmethod
    def _json(path):
        try:
            with builtins.open(path, encoding="utf-8") as file:
                return json.load(file)
        except ValueError as fault:
            raise Error("%s is not whole: %s" % (path, fault)) from None

    @property
    def summary(self):
        """summary.json as a Record; written when the run ends."""
        return Record(self._kept("summary.json", self._json))

    @property
    def status(self):
        """`done`, or what the summary says; "no summary yet" while the run goes on."""
        return self.summary["status"] if os.path.exists(self._path("summary.json")) else "no summary yet"

    @property
    def scene(self):
        """Text of the scene as run, with every default (YAML)."""
        with builtins.open(self._path("scene.yaml"), encoding="utf-8") as file:
            return file.read()

    @property
    def frames(self):
        """The frames so far, as Frames; none without frames.hdf.series."""
        return self._series("frames.hdf.series")

    @property
    def regions(self):
        """The frames of each region of `output.regions`, as Frames by its name."""
        found = [re.fullmatch(r"(.+)\.hdf\.series", name) for name in sorted(os.listdir(self.folder))]
        return {m.group(1): self._series(m.group()) for m in found if m and m.group(1) != "frames"}

    def _series(self, name):
        if not os.path.exists(self._path(name)):
            return Frames([])
        listed = self._kept(name, self._json)["files"]
        return Frames([(self._path(entry["name"]), float(entry["time"])) for entry in listed])

    @property
    def probes(self):
        """Probes by name."""
        history = self.history if os.path.exists(self._path("history.csv")) else {}
        figures = {}
        if os.path.exists(self._path("summary.json")):
            figures = self.summary._entries.get("probes", {})
        files = sorted(os.listdir(self.folder))
        profiles = [re.fullmatch(r"(.+)_\d{6}\.csv", name) for name in files]
        names = {**dict.fromkeys(figures), **{m.group(1): None for m in profiles if m}}
        names.update((column.rpartition(".")[0], None) for column in history if "." in column)
        return {name: Probe(name, Record(figures.get(name, {})),
                            {c[len(name) + 1:]: history[c] for c in history if c.startswith(name + ".")},
                            [self.table(m.group()) for m in profiles if m and m.group(1) == name]) for name in names}

    def __repr__(self):
        return "<Run %s: %s>" % (self.folder, self.status)
