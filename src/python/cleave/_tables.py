"""Tables (CSV) and records (JSON) that runs and studies leave."""

from __future__ import annotations

import builtins
import collections.abc
import csv
import json
import os
import re
from typing import TYPE_CHECKING, Any, Dict, Iterator, List, Mapping

import numpy as np

from ._errors import Error, need

if TYPE_CHECKING:
    import pandas

# Earlier and present names of columns of history.csv and of entries of summary.json: both name the same (the list of the program:
# src/output/renamed_results.c).
_RENAMED = (("rest_share", "inactive_share"), ("overload", "stretch_ratio"), ("directions", "search_directions"),
            ("returned", "reverted"), ("returns_most", "reversions_most"), ("return_energy", "reversion_energy"))
_OTHER = {**dict(_RENAMED), **{now: old for old, now in _RENAMED}}


def entry_of(entries: Mapping[str, Any], name: str, what: str) -> Any:
    """Returns entries[name]; the KeyError of a name that is not there lists those that are. what: where they are, for it."""
    if name not in entries and _OTHER.get(name) in entries:
        return entries[_OTHER[name]]
    if name not in entries:
        there = [str(entry) for entry in entries]
        listed = ", ".join(there[:40] + ["..."] * (len(there) > 40))
        raise KeyError("%s; %s has %s" % (name, what, listed or "nothing"))
    return entries[name]


class Named(Dict[str, Any]):
    """Entries by name; the KeyError of a name that is not there lists those that are."""

    def __init__(self, entries: Mapping[str, Any], what: str):
        super().__init__(entries)
        self._what = what

    def __missing__(self, name: str) -> Any:
        return entry_of({**self}, name, self._what)


def _column(cells: List[str]) -> np.ndarray:
    """Returns numbers if all cells are numbers or empty (nan), else text."""
    try:
        return np.array([float(cell) if cell else float("nan") for cell in cells], dtype=float)
    except ValueError:
        return np.array(cells, dtype=str)


class Table(collections.abc.Mapping):
    """Columns of a CSV file by name: table["kinetic"] is an array of `rows` numbers (nan: none), or of text if a cell is no
    number. A last line that is still being written is left out.

    rows   number of rows
    units  unit of each column, "" without
    path   path of the file
    """

    def __init__(self, path: str):
        with builtins.open(path, newline="", encoding="utf-8", errors="replace") as file:
            text = file.read()
        lines = list(csv.reader(text[:text.rfind("\n") + 1].splitlines()))
        if not lines:
            raise Error("%s: no header yet" % path)
        heads: List[Any] = [re.fullmatch(r"(.*?)(?: \[(.*)\])?", head) for head in lines[0]]
        whole = [line for line in lines[1:] if len(line) == len(heads)]
        self.path = path
        self.rows: int = len(whole)
        self.units: Dict[str, str] = {head.group(1): head.group(2) or "" for head in heads}
        self._columns = {head.group(1): _column([line[k] for line in whole]) for k, head in enumerate(heads)}

    def to_pandas(self) -> pandas.DataFrame:
        """Returns the table as a DataFrame of pandas; its attrs["units"] are the units."""
        table = need("pandas", "to_pandas").DataFrame(dict(self))
        table.attrs["units"] = dict(self.units)
        return table

    def __getitem__(self, name: str) -> np.ndarray:
        return entry_of(self._columns, name, os.path.basename(self.path))

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def __repr__(self) -> str:
        return "<Table %s: %d rows of %s>" % (self.path, self.rows, ", ".join(self._columns))


class Record(collections.abc.Mapping):
    """Figures by name or path: summary["crack"]["tips"][0]["x"], summary["crack.tips.0.x"], summary.crack.tips[0].x.
    A name that contains dots itself is found before a path. Numbers are in SI units."""

    def __init__(self, entries: Dict[str, Any]):
        self._entries = entries

    @staticmethod
    def _shown(value: Any) -> Any:
        if isinstance(value, dict):
            return Record(value)
        return [Record._shown(entry) for entry in value] if isinstance(value, list) else value

    @staticmethod
    def _walk(value: Any, path: str) -> Any:
        """Returns the entry of a dictionary or list with this path, whose names may have dots themselves. Raises KeyError."""
        if isinstance(value, list):
            head, _, rest = path.partition(".")
            found = entry_of({str(k): entry for k, entry in enumerate(value)}, head, "the list")
            return Record._walk(found, rest) if rest else found
        if not isinstance(value, dict):
            raise KeyError("%s; there is a single figure: %r" % (path, value))
        for name in value:
            if path.startswith(name + ".") and path not in value:
                return Record._walk(value[name], path[len(name) + 1:])
        return entry_of(value, path, "this record")

    def __getitem__(self, path: str) -> Any:
        return Record._shown(Record._walk(self._entries, path))

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or name not in self._entries:
            raise AttributeError(name)
        return Record._shown(self._entries[name])

    def __iter__(self) -> Iterator[str]:
        return iter(self._entries)

    def __len__(self) -> int:
        return len(self._entries)

    def __repr__(self) -> str:
        return "Record(%s)" % json.dumps(self._entries, indent=2)
