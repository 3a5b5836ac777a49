"""Pictures by matplotlib."""

from __future__ import annotations

import re
from typing import Any, Dict, List, Optional, Tuple

import numpy as np

from ._errors import need
from ._fields import scale_of
from ._rigid import outlines_of
from ._shape import corners_of

_EXTREME = 0.002                         # share of the values beyond either end of the colour bar
_BESIDE = 0.3                            # share of its longer side by which a picture grows towards rigid bodies


def _axes_of(ax: Any, tall: float = 0.7) -> Any:
    """Returns axes to draw into: those given, or new ones. tall: height of what is drawn over its width."""
    if ax is not None:
        return ax
    height = min(max(5.0 * tall + 0.9, 2.2), 7.5)
    return need("matplotlib.pyplot", "plot").subplots(figsize=(min(6.4, 1.8 + (height - 0.9) / tall), height), layout="constrained")[1]


def _name_of(frame: Any, field: Optional[str]) -> str:
    """Returns the field to draw: the given one, else what happens in the frame."""
    if field is not None:
        return field
    for name in ("damage", "plastic_strain"):
        if name in frame and frame[name].max(initial=0) > 0:
            return name
    return "von_mises"


def _values_of(frame: Any, name: str) -> Tuple[np.ndarray, str, str]:
    """Returns one number for each particle, what it is in words, and its unit. A tensor is shown by its von Mises stress or its largest
    component, a vector by its length."""
    values, words, unit = frame[name], name.replace("_", " "), frame.unit(name)
    if name == "stress":
        return frame["von_mises"], "von Mises stress", unit
    if values.ndim > 1:
        return np.linalg.norm(values[:, :3], axis=1), "|%s|" % words, unit
    return values.astype(float), {"von_mises": "von Mises stress"}.get(name, words), unit


def _limits(values: np.ndarray, given: Any) -> Tuple[float, float]:
    """Returns the ends of the colour bar: those given, else all values but the extremes, from 0 where none is negative, symmetric
    about 0 where both signs matter."""
    if given is not None:
        return float(given[0]), float(given[1])
    finite = values[np.isfinite(values)]
    if len(finite) == 0:
        return 0.0, 1.0
    low, high = np.quantile(finite, [_EXTREME, 1 - _EXTREME])
    if low == high:
        low, high = finite.min(), finite.max()
    if low < 0 < high and min(-low, high) > 0.2 * max(-low, high):
        low, high = -max(-low, high), max(-low, high)
    elif 0 <= finite.min() and low < 0.5 * high:
        low = 0.0
    return float(low), float(high if high > low else low + 1.0)


def _section(frame: Any, plane: Optional[Dict[str, float]]) -> Tuple[Any, Tuple[int, int], float, str]:
    """Returns the particles of a solid to draw, the axes of the picture, the position of the section [m], and it in words."""
    reference = frame.reference
    if plane is None:
        axis = int(np.argmin(np.ptp(reference, axis=0)))
        damaged = "damage" in frame and frame["damage"].max(initial=0) > 0
        at = reference[np.argmax(frame["damage"]), axis] if damaged else reference[:, axis].min() + np.ptp(reference[:, axis]) / 2
        plane = {"xyz"[axis]: float(at)}
    if len(plane) != 1 or next(iter(plane)) not in ("x", "y", "z"):
        raise ValueError('slice: one of x, y, z with its position [m], as {"z": 4e-3}, not %r' % (plane,))
    (name, at), = plane.items()
    axis = "xyz".index(name)
    part = frame.slice(**{name: at})
    if len(part) == 0:
        raise ValueError("no particles at %s = %g m" % (name, at))
    factor, unit = scale_of(float(np.abs(reference).max()), "m")
    kept: List[int] = [k for k in range(3) if k != axis]
    return part, (kept[0], kept[1]), at, "%s = %.4g %s" % (name, at * factor, unit)


def _draw_line(frame: Any, name: str, ax: Any, magnify: float) -> Any:
    """Draws a field of a bar as a curve over the position."""
    values, words, unit = _values_of(frame, name)
    reference = frame.reference[:, 0]
    places = reference + (frame.positions[:, 0] - reference) * magnify
    order = np.argsort(reference)
    long, metres = scale_of(float(np.ptp(places)), "m")
    factor, shown = scale_of(float(np.abs(values).max(initial=0)), unit)
    ax.plot(long * places[order], factor * values[order])
    ax.set_xlabel("x [%s]" % metres)
    ax.set_ylabel(words + (" [%s]" % shown if shown else ""))
    return ax


def _when(frame: Any) -> str:
    """Returns the time of a frame in words, or its load step: time means nothing there."""
    if re.search(r"^solver: *static$", frame.scene, re.MULTILINE):
        return "load step %d" % frame.step
    factor, seconds = scale_of(frame.time, "s")
    return "%.4g %s" % (frame.time * factor, seconds if frame.time > 0 else "s")


def _check(frame: Any, magnify: float, limits: Any, colours: Optional[str]) -> None:
    """Raises ValueError for a frame without particles, and for options that mean nothing."""
    if len(frame) == 0:
        raise ValueError("no particles to draw")
    if not (np.isfinite(magnify) and magnify >= 0):
        raise ValueError("magnify: a number from 0, not %g" % magnify)
    if limits is not None and not (len(limits) == 2 and np.isfinite(limits).all() and limits[0] < limits[1]):
        raise ValueError("limits: two numbers, the lower one first, not %r" % (limits,))
    if isinstance(colours, str) and colours not in need("matplotlib.pyplot", "plot").colormaps():
        raise ValueError("colours: a colour map of matplotlib, as viridis or magma, not %r" % colours)


def _seen(particles: np.ndarray, rigid: np.ndarray) -> np.ndarray:
    """Returns two corners of the rectangle to show [m]: all corners of particles, and of rigid bodies those beside them."""
    low, high = particles.min(axis=0), particles.max(axis=0)
    beside = _BESIDE * float((high - low).max())
    points = np.concatenate([particles, np.clip(rigid, low - beside, high + beside)])
    return np.array([points.min(axis=0), points.max(axis=0)])


def draw_frame(frame: Any, field: Optional[str], ax: Any = None, *, magnify: float = 1.0, limits: Any = None, colours: Optional[str] = None,
               colour_bar: bool = True, slice: Optional[Dict[str, float]] = None) -> Any:
    """Draws a field of a frame and returns the axes. Arguments: Run.plot."""
    need("matplotlib.pyplot", "plot")
    from matplotlib.collections import LineCollection, PolyCollection
    _check(frame, magnify, limits, colours)
    name, words, axes, at = _name_of(frame, field), [], (0, 1), None
    words.append(_when(frame))
    if slice is not None and frame.dimension < 3:
        raise ValueError("slice is for solids; this frame has %d dimension%s" % (frame.dimension, "s" * (frame.dimension > 1)))
    if frame.dimension == 1:
        ax = _draw_line(frame, name, _axes_of(ax), magnify)
        ax.set_title(", ".join(words), fontsize="medium")
        return ax
    if frame.dimension == 3:
        frame, axes, at, where = _section(frame, slice)
        words.append(where)
    if magnify != 1:
        words.append("displacements times %g" % magnify)
    values, label, unit = _values_of(frame, name)
    low, high = _limits(values, limits)
    factor, shown = scale_of(max(abs(low), abs(high)), unit)
    corners = corners_of(frame, magnify, axes)
    outlines = outlines_of(frame, magnify, axes, at)
    seen = _seen(corners.reshape(-1, 2), outlines.reshape(-1, 2))
    wide, high_up = np.ptp(seen, axis=0)
    ax = _axes_of(ax, high_up / wide)
    long, metres = scale_of(float(max(wide, high_up)) / 4, "m")
    squares = PolyCollection(long * corners, array=factor * values, cmap=colours or ("coolwarm" if low == -high else "viridis"),
                             edgecolors="face", linewidths=0.3, antialiaseds=False, rasterized=len(values) > 5000)
    squares.set_clim(factor * low, factor * high)
    ax.add_collection(squares)
    if len(outlines):
        ax.add_collection(LineCollection(long * outlines, colors="0.35", linewidths=1.0), autolim=False)
        ax.update_datalim(long * seen)
    ax.autoscale_view()
    ax.set_aspect("equal")
    ax.set_xlabel("%s [%s]" % ("xyz"[axes[0]], metres))
    ax.set_ylabel("%s [%s]" % ("xyz"[axes[1]], metres))
    ax.set_title(", ".join(words), fontsize="medium")
    if colour_bar:
        beyond = (values.min(initial=low) < low, values.max(initial=high) > high)
        ax.figure.colorbar(squares, ax=ax, label=label + (" [%s]" % shown if shown else ""),
                           extend={(True, True): "both", (True, False): "min", (False, True): "max"}.get(beyond, "neither"))
    return ax


def draw_figure(figure: Any, ax: Any = None) -> Any:
    """Draws the means of a figure with their error bars over the spacing, and its value as a band, and returns the axes."""
    ax = _axes_of(ax)
    long, metres = scale_of(float(figure.spacings.max()), "m")
    factor, shown = scale_of(float(np.abs(figure.means).max()), figure.unit)
    ax.axhspan(factor * (figure.value - figure.uncertainty), factor * (figure.value + figure.uncertainty), color="C0", alpha=0.15, linewidth=0)
    ax.errorbar(long * figure.spacings, factor * figure.means, factor * figure.uncertainties, fmt="o", capsize=3)
    ax.set_xlim(0, None)
    ax.set_xlabel("spacing [%s]" % metres)
    ax.set_ylabel(figure.name + (" [%s]" % shown if shown else ""))
    return ax
