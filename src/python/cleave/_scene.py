"""Scenes, and the commands that compute them: run, sweep, converge."""

from __future__ import annotations

import builtins
import collections.abc
import contextlib
import os
import re
import tempfile
from typing import Any, Callable, Dict, Iterable, Iterator, List, Mapping, Optional, Tuple, Union

import numpy as np

from ._errors import MISSING, PLACE, Error, SceneError, count_of, in_python, number_of
from ._program import Progress, call_fully, value_text
from ._run import Run
from ._yaml import override_text, scene_text

Path = Union[str, "os.PathLike[str]"]
Callback = Optional[Callable[[Progress], Any]]


class Check(list):
    """The warnings of `cleave check`, a list of texts; empty for a scene without any.

    rows  what the program prints about the scene: lists of lines by heading: "particles", "time step", "run time", ...
    text  all of it as printed; its last line is the verdict
    """

    def __init__(self, text: str, told: List[str]):
        super().__init__(line[len("warning: "):] for line in told if line.startswith("warning: "))
        self.text = text
        self.rows: Dict[str, List[str]] = {}
        heading = ""
        for line in text.splitlines():
            heading = line[:15].strip() or heading
            if line[14:15] == " ":
                self.rows.setdefault(heading, []).append(line[15:])

    @property
    def hints(self) -> List[str]:
        """Remarks on what would save time or be more exact."""
        return self.rows.get("hints", [])


class Scene:
    """A scene: a file, or a dictionary with the keys of a scene file, and changes to it.

    entries  path of a scene file; or a dictionary, whose values are text with units ("0.5 mm", "2*a + 1 mm"), numbers in SI
             units, booleans, lists and dictionaries
    changes  keys and values that replace those of the scene, as `-s` does: {"particles.spacing": "1 mm",
             "boundary.0.velocity": [0, 20.0]}; None removes a key
    name     name of a scene that is a dictionary, unless the dictionary has a `name`

    Files that a dictionary names are sought in the current folder.
    """

    def __init__(self, entries: Union[Path, Mapping[str, Any]], changes: Optional[Mapping[str, Any]] = None, name: str = "scene"):
        self.changes: Dict[str, Any] = dict(changes or {})
        self._keys: List[str] = []
        self._text = ""
        self.path: Optional[str] = None
        if isinstance(entries, collections.abc.Mapping):
            entries = dict(entries)
            self.name = str(entries.get("name", name))
            if "include" in entries:     # the program seeks it beside the scene file, which is a temporary one
                named = entries["include"]
                entries["include"] = [os.path.abspath(n) for n in ([named] if isinstance(named, (str, os.PathLike)) else named)]
            self._text, self._keys = scene_text(entries)
        else:
            self.path = os.fspath(entries)
            self.name = os.path.splitext(os.path.basename(self.path))[0]

    def changed(self, changes: Mapping[str, Any]) -> Scene:
        """Returns a scene with further changes; this one stays as it is."""
        scene = Scene.__new__(Scene)
        scene.__dict__.update(self.__dict__, changes={**self.changes, **changes})
        return scene

    @property
    def text(self) -> str:
        """The scene as YAML, without changes."""
        if self.path is None:
            return self._text
        with builtins.open(self.path, encoding="utf-8", errors="replace") as file:
            return file.read()

    def save(self, path: Path) -> None:
        """Writes the scene as YAML, without changes. Raises FileExistsError rather than replace a file."""
        with builtins.open(path, "x", encoding="utf-8") as file:
            file.write(self.text)

    @contextlib.contextmanager
    def _words(self) -> Iterator[List[str]]:
        """Yields the words of the command line that stand for this scene; of a dictionary there is a file meanwhile. A
        SceneError gets its key and the text of its line."""
        changes = [word for key, value in self.changes.items() for word in ("-s", "%s=%s" % (key, override_text(value)))]
        with tempfile.TemporaryDirectory(prefix="cleave-") as folder:
            path = self.path
            if path is None:
                path = os.path.join(folder, re.sub(r"[^\w.-]+", "_", self.name) + ".yaml")
                with builtins.open(path, "x", encoding="utf-8") as file:
                    file.write(self._text)
            try:
                yield [path, *changes]
            except Error as fault:
                raise self._placed(fault, path) from None

    def _placed(self, fault: Error, path: str) -> Error:
        """Returns an exception with this scene in place of its temporary file, and arguments in place of options."""
        line = str(fault)
        if self.path is None and path in line:
            line = line.replace(path, "<%s>" % self.name)
            place = PLACE.fullmatch(line)
            fault = SceneError(line, fault.status, place) if place and fault.status == 2 else Error(line, fault.status)
        if isinstance(fault, SceneError) and fault.line and fault.file in (path, "<%s>" % self.name):
            fault.source = (self.text.splitlines()[fault.line - 1:fault.line] or [""])[0]
            fault.key = self._key_of(fault) if fault.line <= len(self._keys) else None
        fault.args, fault.message = (in_python(str(fault)),), in_python(fault.message)
        return fault

    def _key_of(self, fault: SceneError) -> str:
        """Returns the key of the line of a fault; if a key is missing, that one: the line is that of the dictionary which lacks it."""
        key = self._keys[(fault.line or 1) - 1]
        missing = MISSING.match(fault.message)
        if not missing:
            return key
        if " in " not in missing.group():
            return missing.group("key")
        if fault.source.lstrip().startswith("- "):       # the first line of an item is that of its first key
            key = key.rpartition(".")[0]
        return "%s.%s" % (key, missing.group("key"))

    def check(self, threads: Optional[int] = None, trial: bool = True) -> Check:
        """Checks the scene without running it and returns its warnings.

        threads  number of threads for which the run time is estimated
        trial    False: leaves out the trial steps from which run time and memory are estimated

        Raises SceneError for a scene that cannot be run.
        """
        with self._words() as words:
            text, told = call_fully(("check", *words, *_threads(threads), *["--no-trial"] * (not trial)), True, None)
        if self.path is None:
            text, told = (part.replace(words[0], "<%s>" % self.name) for part in (text, "\n".join(told)))
            return Check(text, told.split("\n"))
        return Check(text, told)

    def run(self, output: Optional[Path] = None, **options: Any) -> Run:
        """Runs the scene to its end; options: those of cleave.run."""
        return run(self, output=output, **options)

    def __repr__(self) -> str:
        return "<Scene %s%s>" % (self.path or self.name, ", changed: " + ", ".join(self.changes) if self.changes else "")


def _scene_of(scene: Union[Path, Scene, Mapping[str, Any]], changes: Optional[Mapping[str, Any]]) -> Scene:
    """Returns a scene given as path, dictionary or Scene, with changes."""
    made = scene if isinstance(scene, Scene) else Scene(scene)
    return made.changed(changes) if changes else made


def _threads(threads: Optional[int]) -> List[str]:
    return [] if threads is None else ["-t", count_of(threads, "threads")]


def _finish(command: str, scene: Scene, words: Iterable[Any], output: Optional[Path], said: str, quiet: bool, progress: Callback) -> Run:
    """Runs a command on a scene and returns its results. said: pattern of the line that names the folder."""
    if output is not None:
        words = [*words, "-o", os.fspath(output)]
    with scene._words() as first:
        printed, _ = call_fully((command, *first, *words), quiet, progress)
    found = re.search(said, printed, re.M)
    if output is None and not found:
        raise Error("the program did not say where its results are; give output")
    return Run(output if output is not None else found.group(1) if found else "")


def run(scene: Union[Path, Scene, Mapping[str, Any]], overrides: Optional[Mapping[str, Any]] = None, output: Optional[Path] = None,
        threads: Optional[int] = None, resume: bool = False, overwrite: bool = False, quiet: bool = True,
        progress: Callback = None) -> Run:
    """Runs a scene to its end and returns its Run.

    scene      path of a scene file, a Scene, or a dictionary with the keys of a scene
    overrides  keys and values that replace those of the scene: {"particles.spacing": "1 mm", "boundary.0.velocity": [0, 20.0]};
               numbers are in SI units, None removes a key
    output     folder of the results; default: results/ and the scene's name
    threads    number of threads; default: the program chooses; results do not depend on it
    resume     continues from a checkpoint; does nothing if the run is done
    overwrite  replaces an older run, which is refused otherwise
    quiet      False: prints warnings and progress to standard error
    progress   function that receives a Progress about twice a second, and at the end; an exception in it interrupts the
               run after a checkpoint. progress=print shows the program's lines

    Raises SceneError for a fault of the scene, Error for any other; exceptions of call.
    """
    words = [*_threads(threads), *["--resume"] * bool(resume), *["--overwrite"] * bool(overwrite)]
    return _finish("run", _scene_of(scene, overrides), words, output, r"^  results in (.*); open \1/", quiet, progress)


def sweep(scene: Union[Path, Scene, Mapping[str, Any]], values: Mapping[str, Any], overrides: Optional[Mapping[str, Any]] = None,
          output: Optional[Path] = None, jobs: Optional[int] = None, threads: Optional[int] = None, overwrite: bool = False,
          quiet: bool = True, progress: Callback = None) -> Run:
    """Runs every combination of values of some keys. Returns the study: its `sweep` is the table, its `runs` are the runs.

    values   lists of values by key: {"particles.spacing": ["1 mm", "2 mm"], "method": ["pd", "mpm"]}; a range as text,
             "1mm:3mm:0.5mm"; a list of lists for a key that takes a list
    output   folder of the study; default: results/NAME_sweep. A study that is there is continued
    jobs     number of runs at the same time; default: number of cores
    progress function that receives a Progress after each run

    Other arguments and exceptions: run. Raises Error if runs fail; what the others left is there for cleave.open.
    ValueError without values.
    """
    words: List[str] = []
    if not values:
        raise ValueError('values: lists of values by key are expected, such as {"particles.spacing": ["1 mm", "2 mm"]}')
    for key, listed in values.items():
        many = isinstance(listed, (list, tuple, np.ndarray, range))
        words += ["-s", "%s=%s" % (key, ",".join(value_text(value) for value in listed) if many else value_text(listed))]
    words += _threads(threads) + (["-j", count_of(jobs, "jobs")] if jobs else []) + ["--overwrite"] * bool(overwrite)
    return _finish("sweep", _scene_of(scene, overrides), words, output, r"table: (.*)/sweep\.csv$", quiet, progress)


def converge(scene: Union[Path, Scene, Mapping[str, Any]], of: Union[str, Iterable[str]] = (), overrides: Optional[Mapping[str, Any]] = None,
             output: Optional[Path] = None, budget: Union[None, str, float] = None, levels: Optional[int] = None,
             runs: Optional[int] = None, horizon: bool = False, jobs: Optional[int] = None, threads: Optional[int] = None,
             overwrite: bool = False, quiet: bool = True, progress: Callback = None) -> Run:
    """Finds figures of a scene with their error bars, from runs at several spacings. Returns the study: its `figures` have
    the values, its `converge` is the table, its `runs` are the runs.

    of       figures of summary.json: "crack.start_time", or a list of them; default: all
    output   folder of the study; default: results/NAME_converge. A study that is there is continued
    budget   limit of the time of all runs: "5 min", or a number [s]
    levels   number of spacings, 3 to 6
    runs     number of runs at each spacing
    horizon  True: keeps the length of the horizon while the spacing varies
    jobs     number of runs at the same time; default: number of cores
    progress function that receives a Progress after each run

    Other arguments and exceptions: run.
    """
    words = [word for figure in ([of] if isinstance(of, str) else of) for word in ("--of", figure)]
    for option, name, value in (("--levels", "levels", levels), ("--runs", "runs", runs), ("-j", "jobs", jobs)):
        words += [] if value is None else [option, count_of(value, name)]
    if budget is not None:
        words += ["--budget", budget.replace(" ", "") if isinstance(budget, str) else "%.6gs" % number_of(budget, "budget", 'a number [s] or text, as "5 min"')]
    words += _threads(threads) + ["--horizon"] * bool(horizon) + ["--overwrite"] * bool(overwrite)
    return _finish("converge", _scene_of(scene, overrides), words, output, r"^all figures in (.*)/converge\.csv$", quiet, progress)
