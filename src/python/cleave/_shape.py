"""Shapes of particles: squares, or cubes, deformed as the neighbourhood is."""

from __future__ import annotations

import re
from typing import Any, Iterator, List, Tuple

import numpy as np

_REACH = 1.6                             # distance of neighbours over the spacing
# What parts neighbours is that of `cleave plot` (src/plot/plot_extent.c): two that have both lost bonds beyond an elongation of _PARTED, or
# _SURVIVED times that of 99 % of sure pairs; any pair beyond a length of _LONGEST, or _JUMP plus _JUMPS times the median of its particle.
_PARTED, _SURVIVED, _LONGEST, _JUMP, _JUMPS = 0.1, 1.5, 4.0, 0.75, 4.0
_LOOSE = 0.6                             # share of lost bonds above which a particle is rubble, whose shape is its own
_TURNED = 1.5                            # edge of the squares below particles that are on no lattice; a turned cell has gaps
_OPEN = 1e-6                             # weight of the undeformed shape, for directions without neighbours


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
    motion = magnify * frame["displacement"][:, :2].astype(float)
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


def _held_pairs(reference: np.ndarray, current: np.ndarray, spacing: float, damage: np.ndarray, body: np.ndarray,
                cuts: List[np.ndarray], magnify: float) -> Tuple[np.ndarray, np.ndarray]:
    """Returns the pairs (i, j) of neighbours that are drawn as connected. Arguments: deformation_gradients."""
    parts = [(i[keep], j[keep]) for i, j in _pairs(reference, spacing)
             for keep in [(body[i] == body[j]) & (np.maximum(damage[i], damage[j]) <= _LOOSE) & _beside(reference[i], reference[j], cuts)]]
    i, j = (np.concatenate(part) for part in zip(*parts))
    longer = np.linalg.norm(current[j] - current[i], axis=1) / np.linalg.norm(reference[j] - reference[i], axis=1) - 1
    whole = np.minimum(damage[i], damage[j]) <= 0
    limit = max(_PARTED / max(magnify, 1e-30), _SURVIVED * float(np.quantile(longer[whole], 0.99)) if whole.any() else 0.0)
    order = np.lexsort((longer, i))
    count = np.bincount(i, minlength=len(reference))
    middle = np.cumsum(count) - count + count // 2
    median = np.zeros(len(reference))
    median[count > 0] = longer[order[middle[count > 0]]]
    held = longer <= np.minimum(_LONGEST - 1, _JUMP + _JUMPS * np.maximum(median[i], 0))
    held &= whole | (longer <= limit)
    return i[held], j[held]


def deformation_gradients(reference: np.ndarray, current: np.ndarray, spacing: float, damage: np.ndarray, body: np.ndarray,
                          cuts: List[np.ndarray] = [], magnify: float = 1.0) -> np.ndarray:
    """Returns the deformation gradient at each particle [n, dim, dim], by least squares over the neighbours that are drawn as connected to
    it, with displacements times `magnify`; the unit matrix for a particle without any.

    reference, current  positions [m], n x dim
    spacing             [m]
    damage, body        share of broken bonds [1], number of the body, n
    cuts                segments that part neighbours as well, in the plane (precracks)
    magnify             factor on displacements [1]
    """
    count, dim = reference.shape
    unit = np.broadcast_to(np.eye(dim), (count, dim, dim))
    if count == 0:
        return unit.copy()
    i, j = _held_pairs(reference, current, spacing, damage, body, cuts, magnify)
    before = (reference[j] - reference[i]) / spacing
    moved = (current[j] - current[i]) / spacing - before
    shape, moment = np.zeros((2, count, dim, dim))
    for a in range(dim):
        for b in range(dim):
            shape[:, a, b] = np.bincount(i, before[:, a] * before[:, b], count) + _OPEN * (a == b)
            moment[:, a, b] = np.bincount(i, moved[:, a] * before[:, b], count)
    gradients = unit + magnify * (moment @ np.linalg.inv(shape))
    sound = np.linalg.det(gradients) > 0.05
    return np.where(sound[:, None, None], gradients, unit)


def is_scattered(reference: np.ndarray, spacing: np.ndarray) -> bool:
    """Returns true if particles in the plane are on no lattice along the axes, as `cleave plot` decides (src/plot/plot_cloud.c): of a
    sample of the smallest ones more than 10 % have their nearest neighbour more than 8 degrees off an axis.

    reference, spacing  positions [m], n x 2, and spacings [m], n
    """
    small = np.flatnonzero(spacing < 1.01 * spacing.min(initial=np.inf))
    sample, off = small[::max(1, -(-len(small) // 100))], 0
    for i in sample:
        apart = np.abs(reference - reference[i])
        distance = np.einsum("nd,nd->n", apart, apart)
        distance[i] = np.inf
        across, along = np.sort(apart[np.argmin(distance)])
        off += bool(across > 0.14 * along)
    return off > 0.1 * len(sample)


def without_gaps(frame: Any, axes: Tuple[int, ...], corners: np.ndarray, values: np.ndarray) -> Tuple[np.ndarray, np.ndarray]:
    """Returns corners and values of the squares to draw, in this order: where particles are on no lattice, wider squares precede their
    own, which fill the gaps. corners, values: of the particles (corners_of), n x 4 x 2 [m] and n; axes: those of the picture."""
    if not is_scattered(frame.reference[:, list(axes)], frame.spacing):
        return corners, values
    middle = corners.mean(axis=1, keepdims=True)
    return np.concatenate([middle + _TURNED * (corners - middle), corners]), np.concatenate([values, values])


def corners_of(frame: Any, magnify: float = 1.0, axes: Tuple[int, ...] = (0, 1, 2)) -> np.ndarray:
    """Returns the corners of the deformed particles of a frame [m], n x 2^a x a along a axes, in the order of VTK's elements.

    magnify  factor on displacements [1]
    axes     axes that are kept, of those that the frame has; of a section of a solid the two in its plane
    """
    kept = list(axes[:frame.dimension])
    reference, spacing = frame.reference[:, kept], frame.spacing
    motion = frame["displacement"][:, kept].astype(float)
    names, none = frame.names, np.zeros(len(frame), dtype=int)
    damage = frame["damage"] if "damage" in names else none
    body = frame["body"] if "body" in names else none
    edge = float(spacing.min(initial=np.inf))
    cuts = precracks(frame.scene) if frame.dimension == 2 else []
    gradients = deformation_gradients(reference, reference + motion, edge, damage, body, cuts, magnify)
    halves = np.array([[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]]) / 2
    edges = halves[:2 ** len(kept), :len(kept)] * spacing[:, None, None]
    return (reference + magnify * motion)[:, None] + np.einsum("nij,nkj->nki", gradients, edges)
