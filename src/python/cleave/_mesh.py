"""Frames as grids of VTK."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._errors import need, number_of
from ._shape import corners_of

_VERTEX = 1
_BOXES = {1: (3, 2), 2: (9, 4), 3: (12, 8)}     # by dimension: type of VTK's cell, its corners


def grid_of(frame: Any, cells: str, magnify: float) -> Any:
    """Returns a frame as vtkUnstructuredGrid. Arguments: Frame.to_vtk. Arrays of fields and points are shared with numpy and kept
    alive by VTK; that of the cells is copied, as VTK takes its memory without a reference."""
    model = need("vtkmodules.vtkCommonDataModel", "to_vtk")
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonCore import vtkPoints
    if cells not in ("points", "boxes"):
        raise ValueError('cells: "points" or "boxes", not %r' % (cells,))
    number_of(magnify, "magnify", "a number from 0", 0.0)
    count, dim = len(frame), frame.dimension
    if cells == "points":
        kind, corners = _VERTEX, 1
        places = frame.moved(magnify)
    else:
        kind, corners = _BOXES[dim]
        places = np.zeros((count * corners, 3))
        places[:, :dim] = corners_of(frame, magnify).reshape(-1, dim)

    grid, points, lists = model.vtkUnstructuredGrid(), vtkPoints(), model.vtkCellArray()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(places)))
    grid.SetPoints(points)
    lists.SetData(corners, numpy_to_vtkIdTypeArray(np.arange(count * corners, dtype=np.int64), deep=True))
    grid.SetCells(kind, lists)
    data = grid.GetPointData() if cells == "points" else grid.GetCellData()
    fields = {name: frame[name] for name in frame.names}
    fields.setdefault("spacing", frame.spacing)
    for name, values in fields.items():
        array = numpy_to_vtk(np.ascontiguousarray(values))
        array.SetName(name)
        data.AddArray(array)
    return grid
