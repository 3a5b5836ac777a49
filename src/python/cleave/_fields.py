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

_PREFIXES = ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n"))
_SCALED = ("m", "Pa", "s", "N", "J", "m/s")


def scale_of(largest: float, unit: str) -> Tuple[float, str]:
    """Returns the factor and the unit in which values up to `largest` are shown: 1e-6 and MPa for 3e8 Pa."""
    if unit not in _SCALED or not np.isfinite(largest) or largest <= 0 or (unit == "m/s" and largest < 1e4):
        return 1.0, unit
    for size, prefix in _PREFIXES:
        if unit == "m" and size > 1:
            continue
        if largest >= size:
            return 1 / size, prefix + unit
    return 1e9, "n" + unit
