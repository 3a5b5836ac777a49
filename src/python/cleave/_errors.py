"""Exceptions of the module, and packages that only some functions need."""

from __future__ import annotations

import importlib
import math
import re
from types import ModuleType
from typing import Any, List, Optional

PLACE = re.compile(r"(?P<file>.+?):(?P<line>\d+):(?P<column>\d+): (?P<message>.*)", re.S)
MISSING = re.compile(r"(?P<key>\w+): missing(?: in [^;]*)?;")
OVERRIDE = re.compile(r"-s (?P<key>[^\s=]+)=.*?: (?P<message>.*)", re.S)

# Name of a package for import: its names for pip and in Debian.
PACKAGES = {"h5py": ("h5py", "python3-h5py"), "matplotlib.pyplot": ("matplotlib", "python3-matplotlib"),
            "pandas": ("pandas", "python3-pandas"), "vtkmodules.vtkCommonDataModel": ("vtk", "python3-vtk9"),
            "pyvista": ("pyvista", "")}


class Error(Exception):
    """Reports what the program refused or why it failed, in one line.

    status   exit status: 1 the run failed, 2 the scene or the command line is wrong, 130 interrupted after a checkpoint;
             None if the module itself found the fault
    message  the line without file, line and column
    """

    def __init__(self, line: str, status: Optional[int] = None):
        super().__init__(line)
        self.status = status
        self.message = line


class SceneError(Error):
    """Reports a fault of a scene and where it is.

    file, line, column  location in the scene file, from 1; of a missing key that of its parent, which for an item of a list and for the
                        scene itself is where the first entry is; None for a fault of an override
    key                 key at this location, or the one that is missing, as "boundary.0.traction": of overrides and of scenes that are
                        dictionaries; else None
    message             the fault and its remedy
    source              text of the line in the scene, "" if unknown
    """

    def __init__(self, line: str, status: Optional[int], place: re.Match):
        super().__init__(line, status)
        found = place.groupdict()
        self.message = found["message"]
        self.file: Optional[str] = found.get("file")
        self.line: Optional[int] = int(found["line"]) if "line" in found else None
        self.column: Optional[int] = int(found["column"]) if "column" in found else None
        self.key: Optional[str] = found.get("key")
        self.source = ""


_OPTIONS = ((r"another -o\b", "another output"), (r"--(overwrite|resume)\b", r"\1=True"), (r"--(levels|runs|budget|of)\b", r"\1"),
            (r"^-s (?=\S+=)", ""))


def number_of(value: Any, name: str, wanted: str = "a number", least: float = -math.inf) -> float:
    """Returns an argument as a number. name, wanted: its name and what it is, for the message. Raises ValueError for what is no finite
    number, as text, or a number below `least`."""
    try:
        number = math.nan if isinstance(value, (str, bytes)) else float(value)
    except (TypeError, ValueError):
        number = math.nan
    if math.isfinite(number) and number >= least:
        return number
    raise ValueError("%s: %s, not %s" % (name, wanted, "%g" % number if isinstance(value, float) else repr(value)))


def count_of(value: Any, name: str) -> str:
    """Returns an argument that is a number of things as text. Raises ValueError, with its name, for what is no whole number."""
    number = number_of(value, name, "a whole number")
    if number != int(number):
        raise ValueError("%s: a whole number, not %g" % (name, number))
    return str(int(number))


def in_python(text: str) -> str:
    """Returns a message of the program with arguments of the module in place of options of the command line."""
    for option, argument in _OPTIONS:
        text = re.sub(option, argument, text)
    return text


def last_words(lines: List[str]) -> str:
    """Returns the last of the lines that the program has told, with those before it that name locations of faults, too: of
    several unknown keys each has a line."""
    first = max(len(lines) - 1, 0)
    while first > 0 and not lines[first - 1].startswith("warning: ") and (OVERRIDE.fullmatch(lines[first - 1])
                                                                          or PLACE.fullmatch(lines[first - 1])):
        first -= 1
    return "\n".join(lines[first:])


def error_of(line: str, status: int) -> Error:
    """Returns the exception for the program's last line: a SceneError if it names a location or an override."""
    place = OVERRIDE.fullmatch(line) or PLACE.fullmatch(line)
    return SceneError(line, status, place) if place and status == 2 else Error(line, status)


def need(name: str, task: str) -> ModuleType:
    """Imports a package that only some functions need. task: what needs it, for the message of the ImportError."""
    try:
        return importlib.import_module(name)
    except ImportError:
        pip, debian = PACKAGES[name]
        remedy = "pip install %s%s" % (pip, "; Debian: apt-get install %s" % debian if debian else "")
        raise ImportError("%s: the package %s is missing (%s)" % (task, pip, remedy)) from None
