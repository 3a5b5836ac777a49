"""Fields with named values: a colour and a name for each value, those of `cleave plot` (src/plot/colours.c, plot_categories.c)."""

from __future__ import annotations

import re
from typing import Any, List, Tuple

import numpy as np

CATEGORIES = ("kind", "material", "body", "fragment", "level")
_FRAGMENTS = ((68, 119, 170), (238, 153, 51), (34, 136, 51), (170, 51, 119), (102, 204, 238), (204, 68, 51), (187, 187, 68), (119, 85, 170),
              (17, 119, 119))
_PARTS = ((187, 204, 220), (238, 221, 136), (187, 204, 51), (238, 136, 102), (153, 221, 255), (255, 170, 187), (68, 187, 153), (170, 170, 0),
          (190, 190, 190))
_NAMED = {("kind", 0): "material points", ("kind", 1): "peridynamics", ("fragment", -1): "no bond left", ("fragment", 0): "the heaviest",
          ("level", 0): "none"}
_COLOURED = {("kind", 0): (236, 233, 226), ("kind", 1): (106, 166, 215), ("fragment", -1): (40, 40, 44), ("fragment", 0): (212, 214, 217)}


def _names_in(scene: str, field: str) -> List[str]:
    """Returns the names of the bodies or materials of a scene in their order. scene: text of the scene as run."""
    block = re.search(r"^%s:\n((?: .*\n)*)" % {"body": "bodies", "material": "materials"}[field], scene, re.M)
    return re.findall(r'^  - name: "(.*)"$', block.group(1), re.M) if block else [field]


def _colour_of(field: str, value: int) -> Tuple[float, ...]:
    """Returns the colour of a value of a field as red, green, blue [0..1]."""
    turn = _FRAGMENTS[(value - 1) % 9] if field == "fragment" else _PARTS[value % 9]
    return tuple(part / 255 for part in _COLOURED.get((field, value), turn))


def categories_of(frame: Any, field: str, values: np.ndarray) -> List[Tuple[int, str, Tuple[float, ...]]]:
    """Returns the values of a field that occur, ascending, each with its name and colour."""
    names = _names_in(frame.scene, field) if field in ("body", "material") else []
    found = []
    for value in np.unique(values.astype(int)).tolist():
        name = names[value] if 0 <= value < len(names) else _NAMED.get((field, value), "%s %d" % (field, value))
        found.append((value, name, _colour_of(field, value)))
    return found
