"""The program: where it is, how it is called, what it prints while it runs."""

from __future__ import annotations

import contextlib
import dataclasses
import os
import re
import shutil
import signal
import subprocess
import sys
import sysconfig
import tempfile
from typing import Any, Callable, Iterator, List, Optional, Tuple

import numpy as np

from ._errors import Error, error_of, last_words


def program() -> str:
    """Returns the path of the program: $CLEAVE, else the one that was built or installed with this module, else that on
    PATH. Raises Error if there is none."""
    here = os.path.dirname(os.path.abspath(__file__))
    beside = [os.path.join(here, "..", "..", "..", "build", "cleave"),          # src/python/cleave of a checkout
              os.path.join(here, "..", "..", "..", "..", "bin", "cleave"),      # PREFIX/lib/python3/dist-packages/cleave
              os.path.join(sysconfig.get_path("scripts"), "cleave")]            # by pip, with the module
    named = os.environ.get("CLEAVE")
    for path in [named] if named else [*beside, shutil.which("cleave") or ""]:
        if path and os.path.isfile(path) and os.access(path, os.X_OK):
            return os.path.normpath(path)
    raise Error("CLEAVE=%s is no program" % named if named else
                "no program cleave beside the module or on PATH; set CLEAVE to its path")


def value_text(value: Any) -> str:
    """Returns a value as `-s key=value` takes it. Numbers are in SI units; None removes the key."""
    if value is None:
        return ""
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    if isinstance(value, (str, os.PathLike)):
        return os.fspath(value)
    if isinstance(value, (list, tuple, np.ndarray)):
        return "[" + ", ".join(value_text(entry) for entry in value) + "]"
    raise TypeError("a scene takes text, numbers, booleans and lists, not %r" % (value,))


# ---- progress -----------------------------------------------------------------------------------------------------

_STEP = re.compile(r"(?P<load>load )?step (?P<step>\d+)/(?P<steps>\d+)  (?:t = (?P<time>\S+) s  (?P<rate>\S+) steps/s  )?"
                   r"(?P<note>.*?)(?:at most )?(?P<left>[\d.]+) (?P<unit>s|min|h) left  PD (?P<share>\S+) %  crack (?P<crack>\S+) mm")
_RUN_OF_STUDY = re.compile(r"\[(?P<step>\d+)/(?P<steps>\d+)\] (?P<note>.*)")
_SECONDS = {"s": 1.0, "min": 60.0, "h": 3600.0}


@dataclasses.dataclass(frozen=True)
class Progress:
    """State of a run or study in progress, as a callback receives it. Numbers that the program does not print are nan.

    step, steps   steps done and in all; of a study: runs
    time          simulated time [s]
    rate          steps per second of wall-clock time
    seconds_left  estimate of the wall-clock time left [s]
    pd_share      share of peridynamic particles [1]
    crack_length  growth of the longest crack [m]
    text          the program's line
    """

    step: int
    steps: int
    time: float
    rate: float
    seconds_left: float
    pd_share: float
    crack_length: float
    text: str

    @property
    def share(self) -> float:
        """Share of the steps that are done [1]."""
        return self.step / max(self.steps, 1)

    def __str__(self) -> str:
        return self.text


def progress_of(line: str) -> Optional[Progress]:
    """Returns the progress that a line of the program reports, or None."""
    found = _STEP.fullmatch(line) or _RUN_OF_STUDY.fullmatch(line)
    if not found:
        return None
    part = found.groupdict()

    def number(name: str, factor: float = 1.0) -> float:
        return float(part[name]) * factor if part.get(name) else float("nan")

    return Progress(int(part["step"]), int(part["steps"]), number("time"), number("rate"),
                    number("left", _SECONDS.get(part.get("unit") or "s", 1.0)), number("share", 0.01), number("crack", 1e-3), line)


# ---- calls --------------------------------------------------------------------------------------------------------


def _lines(source: int) -> Iterator[str]:
    """Yields the lines of a descriptor. They end with a line feed, a carriage return or, of progress, "erase line"."""
    rest = b""
    while True:
        try:
            block = os.read(source, 65536)
        except OSError:                  # of a pseudo-terminal that no process writes to any more
            block = b""
        *whole, rest = re.split(rb"\x1b\[K|[\r\n]", rest + block)
        yield from (line.decode(errors="replace").strip() for line in (whole if block else [*whole, rest]))
        if not block:
            return


@contextlib.contextmanager
def _messages(terminal: bool) -> Iterator[Tuple[int, int]]:
    """Opens a pipe, or a pseudo-terminal, on which the program prints its progress twice a second. Yields the descriptors
    to read and to write; the caller closes the second."""
    source, target = os.openpty() if terminal else os.pipe()
    try:
        yield source, target
    finally:
        os.close(source)


def _end(child: subprocess.Popen, source: int, interrupt: bool) -> None:
    """Waits for a program that ends with a checkpoint. interrupt: asks it to; Ctrl-C has reached it already."""
    if interrupt:
        child.send_signal(signal.SIGINT)
    for _ in _lines(source):
        pass
    child.wait()


def call_fully(words: Tuple[Any, ...], quiet: bool, progress: Optional[Callable[[Progress], Any]]) -> Tuple[str, List[str]]:
    """Runs a command of the program; returns its output and the lines of its standard error but progress. Arguments and
    exceptions: call."""
    command = [program(), *(os.fspath(w) if isinstance(w, os.PathLike) else str(w) for w in words)]
    told: List[str] = []
    with tempfile.TemporaryFile("w+", errors="replace") as printed, _messages(progress is not None) as (source, target):
        try:
            child = subprocess.Popen(command, stdout=printed, stderr=target)
        finally:
            os.close(target)
        with child:
            try:
                for line in filter(None, _lines(source)):
                    now = progress_of(line)
                    if progress and now:
                        progress(now)
                    elif not quiet:
                        print(line, file=sys.stderr)
                    if not now or now.text.startswith("["):
                        told.append(line)
            except KeyboardInterrupt:
                _end(child, source, interrupt=False)
                raise
            except BaseException:
                _end(child, source, interrupt=True)
                raise
        if child.returncode:
            raise error_of(last_words(told) or "cleave ended with status %d" % child.returncode, child.returncode)
        printed.seek(0)
        return printed.read(), told


def call(*words: Any, quiet: bool = True, progress: Optional[Callable[[Progress], Any]] = None) -> str:
    """Runs a command of the program, as call("plot", "results/plate"), and returns what it prints.

    quiet     False: prints warnings and progress to standard error
    progress  function that receives a Progress about twice a second; an exception in it interrupts the program, which
              ends with a checkpoint, and is raised

    Raises Error with the program's line if its exit status is not 0, SceneError if the line names a location in a scene.
    Ctrl-C interrupts the program, which ends with a checkpoint; then KeyboardInterrupt is raised.
    """
    return call_fully(words, quiet, progress)[0]
