"""Shapes of particles: squares, or cubes, deformed as the neighbourhood is."""

from __future__ import annotations

import re
from typing import Any, Iterator, List, Tuple

import numpy as np

_REACH = 1.6                             # distance of neighbours over the spacing
_PARTED, _OVERLAPPING = 2.0, 0.3         # factors on the distance of two particles beyond which they are no longer neighbours
_SURVIVED = 1.5                          # the same of damaged particles, over the largest stretch of undamaged ones


def _pairs(reference: np.ndarray, spacing: float) -> Iterator[Tuple[np.ndarray, np.ndarray]]:
    """Yields arrays of pairs (i, j) of particles within _REACH spacings of each other in the reference configuration [n, dim], by a grid
    with cells of one spacing. Each i occurs at most once in an array. Particles closer than 0.1 spacings are no pair."""
    dim, width = reference.shape[1], int(np.ceil(_REACH))
    cell = np.floor((reference - reference.min(axis=0)) / spacing + 0.5).astype(np.int64) + width
    size = cell.max(axis=0) + 1 + width
    stride = np.cumprod(np.concatenate([[1], size[:-1]]))
    key = cell @ stride
    order = np.argsort(key, kind="stable")
    ordered = key[order]
    starts = np.concatenate([[0], np.flatnonzero(np.diff(ordered)) + 1, [len(ordered)]])
    most = int(np.diff(starts).max())
    for offset in np.ndindex(*(2 * width + 1,) * dim):
        wanted = key + (np.array(offset) - width) @ stride
        first = np.searchsorted(ordered, wanted)
        for slot in range(most):
            at = np.minimum(first + slot, len(ordered) - 1)
            i = np.flatnonzero((first + slot < len(ordered)) & (ordered[at] == wanted))
            j = order[at[i]]
            distance = np.sqrt(((reference[j] - reference[i]) ** 2).sum(axis=1))
            near = (distance < _REACH * spacing) & (distance > 0.1 * spacing)
            yield i[near], j[near]


def precracks(scene: str) -> List[np.ndarray]:
    """Returns the segments of the pre-cracks of a plane scene, at most 100: ends [m], 2 x 2. scene: text of the scene as run."""
    block = re.search(r"^cracks:\n((?: .*\n)*)", scene, re.M)
    ends = re.findall(r"from: \[([^\]]*)\], to: \[([^\]]*)\]", block.group(1)) if block else []
    segments = [np.array([[float(number) for number in end.split(",")] for end in pair]) for pair in ends[:100]]
    return [segment for segment in segments if segment.shape == (2, 2)]


def crack_faces(frame: Any, magnify: float = 1.0) -> List[np.ndarray]:
    """Returns the faces of the pre-cracks of a plane frame as lines [m], each n x 2: the positions along a pre-crack, moved as the particles
    beside it are. magnify: factor on displacements."""
    reference, spacing, lines = frame.reference[:, :2], float(frame.spacing.min(initial=np.inf)), []
    motion = magnify * (frame.positions[:, :2] - reference)
    for start, end in precracks(frame.scene) if frame.dimension == 2 else []:
        length = float(np.linalg.norm(end - start))
        along = (end - start) / max(length, 1e-300)
        place, off = (reference - start) @ along, (reference - start) @ np.array([-along[1], along[0]])
        for side in (off > 0, off <= 0):
            near = side & (np.abs(off) < 1.05 * spacing) & (place > -0.5 * spacing) & (place < length + 0.5 * spacing)
            if not near.any():
                continue
            section = np.floor(place[near] / (2 * spacing)).astype(int)
            ends = np.clip([place[near].min() - spacing / 2, place[near].max() + spacing / 2], 0, length)
            at, moved = [], []
            for one in np.unique(section):
                at.append(place[near][section == one].mean())
                moved.append(motion[near][section == one].mean(axis=0))
            if len(at) > 1:
                places = np.concatenate([ends[:1], at, ends[1:]])
                lines.append(start + places[:, None] * along + np.array([moved[0], *moved, moved[-1]]))
    return lines


def _beside(a: np.ndarray, b: np.ndarray, cuts: List[np.ndarray]) -> np.ndarray:
    """Returns true for the pairs of points a, b [n, 2] whose connecting line crosses no segment."""
    def side(p: np.ndarray, q: np.ndarray, r: np.ndarray) -> np.ndarray:
        along, to = q - p, r - p
        return along[..., 0] * to[..., 1] - along[..., 1] * to[..., 0]

    free = np.ones(len(a), dtype=bool)
    for p, q in cuts:
        free &= (side(p, q, a) * side(p, q, b) > 0) | (side(a, b, p) * side(a, b, q) > 0)
    return free


def _growth(reference: np.ndarray, current: np.ndarray, i: np.ndarray, j: np.ndarray) -> np.ndarray:
    """Returns the distances of pairs over those in the reference configuration [1]."""
    return np.linalg.norm(current[j] - current[i], axis=1) / np.linalg.norm(reference[j] - reference[i], axis=1)


def deformation_gradients(reference: np.ndarray, current: np.ndarray, spacing: float, damage: np.ndarray, body: np.ndarray,
                          cuts: List[np.ndarray] = []) -> np.ndarray:
    """Returns the deformation gradient at each particle [n, dim, dim], by least squares over its neighbours; the unit matrix for a particle
    with too few. Neighbours are of the same body and have not parted: if one of a pair is damaged, the pair's stretch is at most 1.5 times
    the largest stretch of undamaged pairs, so that the faces of a crack are apart.

    reference, current  positions [m], n x dim
    spacing             [m]
    damage, body        share of broken bonds [1], number of the body, n
    cuts                segments that part neighbours as well, in the plane (precracks)
    """
    count, dim = reference.shape
    unit = np.broadcast_to(np.eye(dim), (count, dim, dim))
    if count == 0:
        return unit.copy()
    largest = 0.0
    if damage.any():
        for i, j in _pairs(reference, spacing):
            whole = (damage[i] == 0) & (damage[j] == 0) & (body[i] == body[j])
            whole[whole] = _beside(reference[i[whole]], reference[j[whole]], cuts)
            largest = max(largest, float(_growth(reference, current, i[whole], j[whole]).max(initial=1.0)) - 1)
    shape, moment = np.zeros((count, dim, dim)), np.zeros((count, dim, dim))
    for i, j in _pairs(reference, spacing):
        growth = _growth(reference, current, i, j)
        limit = np.where((damage[i] > 0) | (damage[j] > 0), min(1 + _SURVIVED * largest, _PARTED), _PARTED)
        held = (growth < limit) & (growth > _OVERLAPPING) & (body[i] == body[j])
        held[held] = _beside(reference[i[held]], reference[j[held]], cuts)
        i, j = i[held], j[held]
        before, now = (reference[j] - reference[i]) / spacing, (current[j] - current[i]) / spacing
        shape[i] += before[:, :, None] * before[:, None, :]
        moment[i] += now[:, :, None] * before[:, None, :]
    enough = np.linalg.det(shape) > 1e-2
    shape[~enough] = np.eye(dim)
    gradients = moment @ np.linalg.inv(shape)
    sound = enough & (np.linalg.det(gradients) > 0.05)
    return np.where(sound[:, None, None], gradients, unit)


def corners_of(frame: Any, magnify: float = 1.0, axes: Tuple[int, ...] = (0, 1, 2)) -> np.ndarray:
    """Returns the corners of the deformed particles of a frame [m], n x 2^a x a along a axes, in the order of VTK's elements.

    magnify  factor on displacements [1]
    axes     axes that are kept, of those that the frame has; of a section of a solid the two in its plane
    """
    kept = list(axes[:frame.dimension])
    reference, spacing = frame.reference[:, kept], frame.spacing
    motion = frame.positions[:, kept] - reference
    names, none = frame.names, np.zeros(len(frame), dtype=int)
    damage = frame["damage"] if "damage" in names else none
    body = frame["body"] if "body" in names else none
    edge = float(spacing.min(initial=np.inf))
    unit = np.eye(len(kept))
    cuts = precracks(frame.scene) if frame.dimension == 2 else []
    gradients = unit + magnify * (deformation_gradients(reference, reference + motion, edge, damage, body, cuts) - unit)
    halves = np.array([[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]]) / 2
    edges = halves[:2 ** len(kept), :len(kept)] * spacing[:, None, None]
    return (reference + magnify * motion)[:, None] + np.einsum("nij,nkj->nki", gradients, edges)
