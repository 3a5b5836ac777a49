"""Pictures by matplotlib."""

from __future__ import annotations

import re
from typing import Any, Dict, List, Optional, Tuple

import numpy as np

from ._categories import CATEGORIES, categories_of
from ._errors import need, number_of
from ._fields import components, scale_of
from ._rigid import outlines_of
from ._shape import corners_of, crack_faces, without_gaps

# The colours and their ends are those of `cleave plot` (src/plot/colours.c, plot_view.c).
_EXTREME, _FEW = 0.002, 3                # share and number of the values beyond the end of the colour bar
_HOT, _HOT_TIMES = 0.01, 1.5             # a hot spot of this share takes the colour bar up to so much beyond the others
_DAMAGE = [(0.0, (226, 228, 231)), (0.12, (246, 220, 190)), (0.35, (240, 160, 110)), (0.6, (214, 80, 62)), (0.8, (158, 24, 42)),
           (1.0, (84, 2, 24))]
_DIVERGING = [(k / 10, colour) for k, colour in enumerate([
    (5, 48, 97), (33, 102, 172), (67, 147, 195), (146, 197, 222), (200, 217, 228), (226, 226, 226), (240, 209, 192), (244, 165, 130),
    (214, 96, 77), (178, 24, 43), (103, 0, 31)])]
_FACE = (122 / 255, 16 / 255, 32 / 255)  # of pre-cracks in pictures of damage
_SIGNED = re.compile(r"(displacement|velocity)_[xyz]$|(stress|strain)_[xyz]{2}$|pressure$|principal_stress|principal_directions|strength_share")
_FROM_LEAST = ("temperature", "density")
_NEARLY = 0.98                           # share of the most damage that makes a layer a candidate for the section
_APART = 1.5                             # distance of neighbours over the spacing above which a bar has separated
_NAMED_MOST = 12                         # largest number of values that the key of a field with named values has
_UPRIGHT_MOST, _FLAT_MOST = 8, 20        # largest height of a picture over its width, and width over its height
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
    """Returns one number for each particle, what it is in words, and its unit. A vector is shown by its length, in a bar by its component
    along it, principal stresses by the largest one. Raises KeyError for a tensor."""
    values, words, unit = frame[name], name.replace("_", " "), frame.unit(name)
    if values.ndim > 1 and values.shape[1] == 6:
        parts = ", ".join("%s_%s" % (name, part) for part in components(name, values))
        raise KeyError("%s: it has several components, draw one of %s" % (name, parts))
    if name == "principal_stress":
        return values[:, 0], "principal stress", unit                # the largest one
    if values.ndim > 1 and frame.dimension == 1:
        return values[:, 0].astype(float), words + " x", unit
    if values.ndim > 1:
        return np.linalg.norm(values[:, :3], axis=1), "|%s|" % words, unit
    return values.astype(float), {"von_mises": "von Mises stress"}.get(name, words), unit


def _colours_of(name: str, asked: Optional[str], low: float, high: float) -> Any:
    """Returns the colour map of a field between the values `low` and `high`: the one asked for, else that of `cleave plot`, whose middle
    colour is that of 0 where both signs matter."""
    if asked is not None:
        return asked
    if name != "damage" and not _SIGNED.match(name):
        return "viridis"
    from matplotlib.colors import LinearSegmentedColormap, ListedColormap
    stops = _DAMAGE if name == "damage" else _DIVERGING
    table = LinearSegmentedColormap.from_list("cleave", [(at, tuple(part / 255 for part in colour)) for at, colour in stops])
    if name == "damage" or low == -high or not low <= 0 <= high:
        return table
    return ListedColormap(table(0.5 + 0.5 * np.linspace(low, high, 256) / max(-low, high)))


def _bulk(values: np.ndarray) -> Tuple[np.ndarray, int]:
    """Returns values in ascending order, and how many of them are beyond an end of the colour bar."""
    ordered = np.sort(values[np.isfinite(values)])
    return ordered, max(int(_EXTREME * (len(ordered) - 1)), min(_FEW, len(ordered) // 20))


def _limits(values: np.ndarray, name: str, given: Any) -> Tuple[float, float]:
    """Returns the ends of the colour bar: those given, else for damage 0 and at least 0.5, for other fields all values but the extremes,
    from 0 or, where both signs have a meaning, symmetric about 0."""
    if given is not None:
        return float(given[0]), float(given[1])
    if name == "damage":
        return 0.0, float(np.ceil(10 * max(0.5, min(values.max(initial=0), 1)) - 1e-3) / 10)
    low = 0.0
    if name in _FROM_LEAST and len(values):
        ordered, beyond = _bulk(values)
        low = float(ordered[beyond]) if len(ordered) else 0.0
    above = np.abs(values) if _SIGNED.match(name) else values - low
    ordered, beyond = _bulk(above[above > 0])
    high = 1.0
    if len(ordered):
        high = min(float(ordered[-1 - beyond]), _HOT_TIMES * float(ordered[-1 - int(_HOT * (len(ordered) - 1))]))
    return (-high, high) if _SIGNED.match(name) else (low, low + high)


def _layer(frame: Any, axis: int, name: str) -> float:
    """Returns the position [m] of the layer of particles along an axis that has the most damage, without damage that of the largest value
    of the field `name`; of nearly equal ones that nearest to the middle. Of two alike it is the lower one, as in `cleave plot`
    (src/plot/plot_cloud.c)."""
    place, spacing = frame.reference[:, axis], float(frame.spacing.min())
    middle, low = (place.min() + place.max()) / 2, place.min()
    wanted = middle
    layer = np.rint((place - low) / spacing).astype(int)
    weight = np.bincount(layer, np.nan_to_num(frame["damage"])) if "damage" in frame else np.zeros(1)
    if not weight.any() and name != "damage" and name not in CATEGORIES:
        weight = np.zeros(layer.max() + 1)
        np.maximum.at(weight, layer, np.abs(np.nan_to_num(_values_of(frame, name)[0])))
    if weight.any():
        most = np.flatnonzero(weight >= _NEARLY * weight.max())
        wanted = low + spacing * most[np.argmin(np.round(np.abs(low + most * spacing - middle) / spacing, 3))]
    off = np.round(np.abs(place - wanted) / spacing, 3)
    return float(place[off == off.min()].min())


def _section(frame: Any, plane: Optional[Dict[str, float]], name: str) -> Tuple[Any, Tuple[int, int], float, str]:
    """Returns the particles of a solid to draw, the axes of the picture, the mean position of the particles
    [m], and it in words. name: field that is drawn."""
    reference = frame.reference
    if plane is None:
        sides = np.ptp(reference, axis=0)
        axis = int(np.flatnonzero(sides <= sides.min() * (1 + 1e-5))[-1])
        plane = {"xyz"[axis]: _layer(frame, axis, name)}
    if not isinstance(plane, dict) or len(plane) != 1 or next(iter(plane)) not in ("x", "y", "z"):
        raise ValueError('slice: one of x, y, z with its position [m], as {"z": 4e-3}, not %r' % (plane,))
    (name, at), = plane.items()
    axis = "xyz".index(name)
    part = frame.slice(**{name: at})
    if len(part):
        at = float(part.reference[:, axis].mean())
    factor, unit = scale_of(float(np.ptp(reference, axis=0).max()), "m")
    kept: List[int] = [k for k in range(3) if k != axis]
    return part, (kept[0], kept[1]), at, "%s = %.4g %s" % (name, at * factor, unit)


def _draw_line(frame: Any, name: str, ax: Any, magnify: float) -> Any:
    """Draws a field of a bar as a curve over the position, with gaps where it has separated; a particle alone is a point."""
    values, words, unit = _values_of(frame, name)
    reference = frame.reference[:, 0]
    places = frame.moved(magnify)[:, 0]
    order = np.argsort(reference)
    apart = np.flatnonzero(np.diff(frame.positions[order, 0]) > _APART * frame.spacing[order[1:]]) + 1
    long, metres = scale_of(float(np.ptp(places)), "m")
    factor, shown = scale_of(float(np.abs(values).max(initial=0)), unit)
    pieces = np.split(order, apart)
    line = np.concatenate([np.append(piece, -1) for piece in pieces])[:-1]      # -1: the bar has separated there
    curve, = ax.plot(np.where(line < 0, np.nan, long * places[line]), np.where(line < 0, np.nan, factor * values[line]))
    alone = np.array([piece[0] for piece in pieces if len(piece) == 1], dtype=int)
    if len(alone):
        ax.plot(long * places[alone], factor * values[alone], "o", color=curve.get_color(), markersize=4)
    ax.set_xlabel("x [%s]" % metres)
    ax.set_ylabel(words + (" [%s]" % shown if shown else ""))
    _tics(ax)
    return ax


def _when(frame: Any) -> str:
    """Returns the time of a frame in words, or its load step: time means nothing there."""
    if re.search(r"^solver: *static$", frame.scene, re.MULTILINE):
        return "load step %d" % frame.step
    factor, seconds = scale_of(frame.time, "s")
    return "%.4g %s" % (frame.time * factor, seconds)


def _title(ax: Any, words: List[str]) -> None:
    """Writes words above axes, in one line if it is short enough for them, else in lines of their own."""
    letters = 0.75 * 72 * ax.get_window_extent().width / ax.figure.dpi / 6          # the colour bar takes a quarter; 6 points a letter
    line = ", ".join(words)
    ax.set_title(line if len(line) <= letters else "\n".join(words), fontsize="medium")


def _tics(ax: Any) -> None:
    """Makes the numbers of both axes whole ones, without a common factor or offset, and those of the horizontal axis so few that they do not
    touch."""
    from matplotlib.ticker import MaxNLocator, ScalarFormatter
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_major_formatter(ScalarFormatter(useOffset=False))
        axis.get_major_formatter().set_scientific(False)
    box = ax.get_window_extent()
    low, high = np.sort(ax.get_xlim())
    wide = 0.75 * 72 / ax.figure.dpi * box.width           # the colour bar takes a quarter
    if ax.get_aspect() != "auto":
        wide = min(wide, 72 / ax.figure.dpi * box.height * (high - low) / abs(np.diff(ax.get_ylim())[0]))
    for count in range(9, 0, -1):
        tics = [tic for tic in MaxNLocator(count, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high) if low <= tic <= high]
        letters = max([len("%.9g" % tic) for tic in tics], default=1)
        if len(tics) < 2 or (letters + 1.5) * 6 <= wide * (tics[1] - tics[0]) / (high - low):      # 6 points a letter
            break
    ax.xaxis.set_major_locator(MaxNLocator(count, steps=[1, 2, 2.5, 5, 10]))


def _check(frame: Any, magnify: float, limits: Any, colours: Optional[str]) -> None:
    """Raises ValueError for a frame without particles, and for options that mean nothing."""
    if len(frame) == 0:
        raise ValueError("no particles to draw")
    number_of(magnify, "magnify", "a number above 0", 5e-324)
    if limits is not None:
        try:
            low, high = (float(end) for end in limits)
        except (TypeError, ValueError):
            low = high = np.nan
        if not (np.isfinite([low, high]).all() and low < high):
            raise ValueError("limits: two numbers in the SI unit of the field, the lower one first, not %r" % (limits,))
    if isinstance(colours, str) and colours not in need("matplotlib.pyplot", "plot").colormaps():
        raise ValueError("colours: a colour map of matplotlib, as viridis or magma, not %r" % colours)


def _seen(particles: np.ndarray, rigid: np.ndarray) -> np.ndarray:
    """Returns two corners of the rectangle to show [m]: all corners of particles, and of rigid bodies those beside them. Beside a slender
    body there is space for the numbers of the axis across it."""
    low, high = particles.min(axis=0), particles.max(axis=0)
    beside = _BESIDE * float((high - low).max())
    points = np.concatenate([particles, np.clip(rigid, low - beside, high + beside)])
    low, high = points.min(axis=0), points.max(axis=0)
    more = np.maximum((high - low)[::-1] / [_UPRIGHT_MOST, _FLAT_MOST] - (high - low), 0) / 2
    return np.array([low - more, high + more])


def _draw_categories(frame: Any, name: str, values: np.ndarray, squares: Any, ax: Any, key: bool) -> None:
    """Gives each value of a field with named values its colour, and names the first ones in a key beside the picture."""
    from matplotlib.patches import Patch
    found = categories_of(frame, name, values)
    colours = {value: colour for value, _, colour in found}
    squares.set_array(None)
    squares.set_facecolor([colours[value] for value in values.astype(int).tolist()])
    squares.set_edgecolor("face")
    patches = [Patch(color=colour, label=text) for _, text, colour in found[:_NAMED_MOST]]
    if len(found) > _NAMED_MOST:
        patches.append(Patch(color="none", label="and %d more" % (len(found) - _NAMED_MOST)))
    if key:
        ax.legend(handles=patches, title=name, loc="upper left", bbox_to_anchor=(1.02, 1.0), borderaxespad=0.0)


def draw_frame(frame: Any, field: Optional[str], ax: Any = None, *, magnify: float = 1.0, limits: Any = None, colours: Optional[str] = None,
               colour_bar: bool = True, slice: Optional[Dict[str, float]] = None) -> Any:
    """Draws a field of a frame and returns the axes. Arguments: Run.plot."""
    need("matplotlib.pyplot", "plot")
    if ax is not None and not hasattr(ax, "add_collection"):
        raise TypeError("ax: axes of matplotlib, not %r; run.plot(field, time) takes a time [s], a frame has its own" % (ax,))
    from matplotlib.collections import LineCollection, PolyCollection
    _check(frame, magnify, limits, colours)
    name, words, axes, at = _name_of(frame, field), [], (0, 1), None
    if name in CATEGORIES and not (colours is None and limits is None):
        raise ValueError("%s: %s has a colour for each value and no scale" % ("limits" if colours is None else "colours", name))
    words.append(_when(frame))
    if slice is not None and frame.dimension < 3:
        raise ValueError("slice is for solids; this frame has %d dimension%s" % (frame.dimension, "s" * (frame.dimension > 1)))
    if frame.dimension == 1:
        ax = _draw_line(frame, name, _axes_of(ax), magnify)
        _title(ax, words)
        return ax
    if frame.dimension == 3:
        frame, axes, at, where = _section(frame, slice, name)
        words.append(where)
    if magnify != 1:
        words.append("displacements times %g" % magnify)
    values, label, unit = _values_of(frame, name)
    low, high = _limits(values, name, limits)
    factor, shown = scale_of(max(abs(low), abs(high)), unit)
    corners = corners_of(frame, magnify, axes)
    outlines = outlines_of(frame, magnify, axes, at)
    seen = _seen(corners.reshape(-1, 2), outlines.reshape(-1, 2))
    wide, high_up = np.ptp(seen, axis=0)
    ax = _axes_of(ax, high_up / wide)
    long, metres = scale_of(float(max(wide, high_up)), "m")
    corners, values = without_gaps(frame, axes, corners, values)
    squares = PolyCollection(long * corners, array=factor * values, cmap=_colours_of(name, colours, low, high),
                             edgecolors="face", linewidths=0.3, antialiaseds=False, rasterized=len(values) > 5000)
    squares.set_clim(factor * low, factor * high)
    ax.add_collection(squares)
    if len(outlines):
        ax.add_collection(LineCollection(long * outlines, colors="0.35", linewidths=1.0), autolim=False)
    for face in crack_faces(frame, magnify):
        ax.plot(*(long * face.T), color=_FACE if name == "damage" else "white", linewidth=1.0, scalex=False, scaley=False)
    ax.update_datalim(long * seen)
    ax.autoscale_view()
    ax.set_aspect("equal")
    _tics(ax)
    ax.set_xlabel("%s [%s]" % ("xyz"[axes[0]], metres))
    ax.set_ylabel("%s [%s]" % ("xyz"[axes[1]], metres))
    _title(ax, words)
    if name in CATEGORIES:
        _draw_categories(frame, name, values, squares, ax, colour_bar)
    elif colour_bar:
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
