"""Names, components and units of the fields of frames."""

from __future__ import annotations

from typing import Callable, Dict, Tuple

import numpy as np

# Units of fields of frames that do not have the attribute themselves.
UNITS = {"displacement": "m", "velocity": "m/s", "stress": "Pa", "contact_force": "N", "spacing": "m"}

COMPONENTS = {3: ("x", "y", "z"), 6: ("xx", "yy", "zz", "xy", "yz", "xz")}
_NAMED_OTHERWISE = {"principal_stress": ("1", "2", "3")}


def components(name: str, values: np.ndarray) -> Tuple[str, ...]:
    """Returns the suffixes of a field's columns: x y z, xx yy zz xy yz xz, else numbers from 1; () of a scalar."""
    if values.ndim == 1:
        return ()
    count = values.shape[1]
    return _NAMED_OTHERWISE.get(name) or COMPONENTS.get(count) or tuple(str(k + 1) for k in range(count))


def von_mises(stress: np.ndarray) -> np.ndarray:
    """Returns the von Mises stress [Pa] of stresses [n, 6], xx yy zz xy yz xz."""
    s = stress.astype(float)
    normal = (s[:, 0] - s[:, 1]) ** 2 + (s[:, 1] - s[:, 2]) ** 2 + (s[:, 2] - s[:, 0]) ** 2
    return np.sqrt(normal / 2 + 3 * (s[:, 3:] ** 2).sum(axis=1))


# Fields that follow from stored ones: name, the field that they follow from, the function.
DERIVED: Dict[str, Tuple[str, Callable[[np.ndarray], np.ndarray]]] = {
    "von_mises": ("stress", von_mises),
    "pressure": ("stress", lambda s: -s[:, :3].mean(axis=1)),
    "principal_stress": ("stress", lambda s: np.linalg.eigvalsh(
        s[:, [0, 3, 5, 3, 1, 4, 5, 4, 2]].astype(float).reshape(-1, 3, 3))[:, ::-1]),
    "speed": ("velocity", lambda v: np.linalg.norm(v, axis=1)),
}

# The units are those of `cleave plot` (src/plot/plot_units.c).
PREFIXES = ((1e24, "Y"), (1e21, "Z"), (1e18, "E"), (1e15, "P"), (1e12, "T"), (1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"),
            (1e-6, "µ"), (1e-9, "n"), (1e-12, "p"), (1e-15, "f"), (1e-18, "a"), (1e-21, "z"), (1e-24, "y"))
_SCALED = ("m", "Pa", "s", "N", "N/m", "J", "m/s", "W", "J/m²", "J/m³", "Pa√m")
_NEARLY_ONE = 0.9995                     # values from this share of a unit on are shown in it: they are rounded to 1


def scale_of(largest: float, unit: str) -> Tuple[float, str]:
    """Returns the factor and the unit in which values up to `largest` are shown: 1e-6 and MPa for 3e8 Pa. Lengths are in millimetres
    between 0.5 mm and 1 m, and in kilometres from 1 km on."""
    if unit not in _SCALED or not np.isfinite(largest):
        return 1.0, unit
    if unit == "m" and largest >= 1e3 * _NEARLY_ONE:
        return 1e-3, "km"
    if unit == "m" and 5e-4 < largest < _NEARLY_ONE:
        return 1e3, "mm"
    for size, prefix in PREFIXES:
        if largest >= size * _NEARLY_ONE:
            return 1 / size, prefix + unit
    return 1.0, unit                     # 0, or round-off
