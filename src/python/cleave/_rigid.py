"""Outlines of rigid bodies, which are in a file beside each frame."""

from __future__ import annotations

import builtins
import os
import re
from typing import Any, Optional, Tuple

import numpy as np


def _array(text: str, name: str) -> np.ndarray:
    """Returns the numbers of a data array of VTK by its name; none if it is not there."""
    found = re.search(r'Name="%s"[^>]*>([^<]*)<' % name, text)
    return np.array(found.group(1).split() if found else [], dtype=float)


def _cut(corners: np.ndarray, axis: int, at: float) -> np.ndarray:
    """Returns the segments in which convex faces [n, corners, 3] cross a plane: ends [m], k x 2 x 3."""
    other = np.roll(corners, -1, axis=1)
    before, behind = corners[:, :, axis] - at, other[:, :, axis] - at
    crosses = (before < 0) != (behind < 0)
    crosses &= crosses.sum(axis=1, keepdims=True) == 2
    share = before[crosses] / (before[crosses] - behind[crosses])
    return (corners[crosses] + share[:, None] * (other[crosses] - corners[crosses])).reshape(-1, 2, 3)


def _beside(frame: Any, faces: np.ndarray) -> np.ndarray:
    """Returns the displacement of the particle nearest to a rigid body [m], 3 components. faces: of the body [n, corners, 3], sampled
    at 11 positions along each edge and from each corner to the centre of the face; n <= 400 are used."""
    faces = faces[::len(faces) // 400 + 1, :, :frame.dimension]
    share = np.linspace(0, 1, 11)[:, None, None, None]
    ends = np.stack([np.roll(faces, -1, axis=1), np.broadcast_to(faces.mean(axis=1, keepdims=True), faces.shape)])
    samples = (faces + share[:, None] * (ends - faces)).reshape(-1, frame.dimension)
    places, least, nearest = frame.moved(1.0)[:, :frame.dimension], np.inf, 0
    for sample in samples:
        apart = ((places - sample) ** 2).sum(axis=1)
        if apart.min(initial=np.inf) < least:
            least, nearest = apart.min(), int(apart.argmin())
    motion = np.zeros(3)
    if len(places):
        motion[:frame.dimension] = frame["displacement"][nearest, :frame.dimension]
    return motion


def outlines_of(frame: Any, magnify: float, axes: Tuple[int, int], at: Optional[float]) -> np.ndarray:
    """Returns the outlines of the rigid bodies of a frame as segments along two axes [m], k x 2 x 2; none without a file of them.

    magnify  factor on displacements [1]; a body keeps its distance from the nearest particle
    at       of a solid the position of the section along the third axis [m]; None in the plane
    """
    folder, name = os.path.split(frame.path)
    number = re.fullmatch(r"(\d{6})\.\w+", name)
    path = os.path.join(folder, "rigid_%s.vtp" % number.group(1)) if number else ""
    if not os.path.exists(path):
        return np.zeros((0, 2, 2))
    with builtins.open(path, encoding="utf-8", errors="replace") as file:
        text = file.read()
    points, motion = _array(text, "Points").reshape(-1, 3), _array(text, "motion").reshape(-1, 15)
    connected, ends, body = (_array(text, name).astype(int) for name in ("connectivity", "offsets", "rigid_body"))
    sizes, parts, shift = np.diff(ends, prepend=0), [np.zeros((0, 2, 3))], np.zeros((len(motion), 3))
    for number in np.unique(body) if magnify != 1 else ():
        size = sizes[body == number][0]
        faces = np.flatnonzero((body == number) & (sizes == size))
        shift[number] = (magnify - 1) * _beside(frame, points[connected[(ends[faces] - size)[:, None] + np.arange(size)]])
    for size in np.unique(sizes):
        faces = np.flatnonzero(sizes == size)
        corners = points[connected[(ends[faces] - size)[:, None] + np.arange(size)]] + shift[body[faces]][:, None]
        parts.append(corners if at is None else _cut(corners, 3 - sum(axes), at))
    return np.concatenate(parts)[:, :, list(axes)]
