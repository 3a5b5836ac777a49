#!/bin/sh
# The Python module (src/python/cleave) with optional packages: pictures by matplotlib, tables of pandas, grids of VTK, installation by
# pip, the examples of inputs/python.md, the notebooks. A line names each part that cannot run here; the script is skipped if none can.
# Takes a minute.
test_name=long_python
. tests/support/summary.sh

python=$(for python in /usr/bin/python3 python3; do "$python" -c 'import numpy, h5py' 2>/dev/null && echo "$python" && break; done)
[ -n "$python" ] || { echo "no python3 with numpy and h5py (Debian: python3-numpy python3-h5py)"; exit 77; }
export CLEAVE="$cleave" PYTHONDONTWRITEBYTECODE=1 MPLBACKEND=Agg MPLCONFIGDIR="$work"
has() { "$python" -c "import $1" 2>/dev/null || { echo "$test_name: no $1 of Python: not tried"; false; }; }
run() { PYTHONPATH=$root/src/python "$python" "$@"; }

cat >"$work/plate.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 6 us
method: pd
material: {young: 72 GPa, density: 2440 kg/m^3, energy_release_rate: 135 J/m^2}
body: {box: {from: [0, -10 mm], to: [20 mm, 10 mm]}}
particles: {spacing: 1 mm}
cracks: [{from: [0, 0], to: [9.9 mm, 0]}]
boundary: [{traction: [0, 24 MPa], face: y+}, {traction: [0, -24 MPa], face: y-}]
output: {frames: 2, samples: 10}
END
cat >"$work/bar.yaml" <<'END'
space: line
duration: 2 us
method: pd
material: {young: 70 GPa, density: 2700}
body: {box: {from: [0], to: [20 mm]}}
particles: {spacing: 1 mm}
initial: [{velocity: [1 m/s], region: {box: {from: [0], to: [10 mm]}}}]
output: {frames: 1, samples: 4}
END
cat >"$work/block.yaml" <<'END'
space: solid
duration: 4 us
method: mpm
material: {young: 70 GPa, poisson: 0.3, density: 2700}
body: {box: {from: [0, 0, 0], to: [10 mm, 8 mm, 4 mm]}}
particles: {spacing: 1 mm}
initial: [{velocity_gradient: [1e4, 0, 0, 0, 0, 0, 0, 0, 0]}]
output: {frames: 1, samples: 4}
END
cat >"$work/pull.yaml" <<'END'
space: plane stress
thickness: 3 mm
duration: 2 s
method: pd
solver: static
steps: {number: 2}
material: {young: 70 GPa, density: 2700}
body: {box: {from: [0, 0], to: [20 mm, 8 mm]}}
particles: {spacing: 1 mm}
boundary:
  - {name: wall, fixed: all, face: x-}
  - {name: grip, displacement: [0.01 mm, free], time: {ramp: {until: 2 s}}, face: x+}
output: {frames: 2}
END
for scene in plate bar block pull; do "$cleave" run "$work/$scene.yaml" -q -o "$work/$scene" || fail "the run of $scene"; done

# ---- matplotlib --------------------------------------------------------------------------------------------------------

cat >"$work/draw.py" <<'END'
import sys
import numpy as np
import matplotlib.pyplot as plt
import cleave
plate, bar, block = (cleave.open(sys.argv[1] + "/" + name) for name in ("plate", "bar", "block"))
frame = plate.frames[-1]

ax = plate.plot()
squares, = ax.collections
assert len(squares.get_paths()) == 400 and np.allclose(squares.get_array(), frame["damage"]), "damage, the last frame"
assert ax.get_xlabel() == "x [mm]" and ax.get_ylabel() == "y [mm]" and ax.get_title() == "6 µs" and ax.get_aspect() == 1
assert [a.get_ylabel() for a in ax.figure.axes] == ["y [mm]", "damage"], "a colour bar"

# the faces of the crack are apart, undamaged neighbours are not: white pixels within the body
def pixels(magnify):
    ax = plate.plot(magnify=magnify, colour_bar=False)
    ax.axis("off")
    ax.set_title("")
    ax.figure.canvas.draw()
    picture = np.asarray(ax.figure.canvas.buffer_rgba())[..., :3].astype(int)
    white = picture.sum(axis=2) > 750
    inside = ~white
    rows, columns = np.flatnonzero(inside.any(axis=1)), np.flatnonzero(inside.any(axis=0))
    high, wide = (rows[-1] - rows[0]) // 8, (columns[-1] - columns[0]) // 8     # the outline bends when it is magnified
    return white[rows[0] + high:rows[-1] - high, columns[0] + wide:columns[-1] - wide]
still, opened = pixels(1), pixels(40)
assert still.mean() < 0.002, "no gap without magnification: %g" % still.mean()
assert opened.mean() > 0.01, "a gap: %g" % opened.mean()
middle = opened[opened.shape[0] // 3:2 * opened.shape[0] // 3]
assert middle.sum() > 0.95 * opened.sum(), "at the crack alone"

ax = plate.plot("velocity_y", 3e-6, colours="PuOr")
low, high = ax.collections[0].get_clim()
assert low == -high and np.isclose(high, np.quantile(np.abs(plate.frames.at(3e-6)["velocity_y"]), 0.998), rtol=0.2), "both signs: %g, %g" % (low, high)
ax = plate.plot("von_mises", limits=(0, 50e6))
assert ax.collections[0].get_clim() == (0, 50) and ax.figure.axes[1].get_ylabel() == "von Mises stress [MPa]"
for field in ("displacement", "speed", "pressure", "principal_stress_1", "kind"):
    plate.plot(field)
ax = plate.plot("fragment")
assert len(ax.figure.axes) == 1 and ax.get_legend().get_texts()[0].get_text() == "the heaviest", "a name for each value"
assert np.allclose(ax.collections[0].get_facecolor()[0, :3], np.array([212, 214, 217]) / 255), "and a colour"
_, panel = plt.subplots()
assert plate.plot(ax=panel) is panel and frame.slice(y=0.5e-3).plot("damage", colour_bar=False) is not panel

pull = cleave.open(sys.argv[1] + "/pull")
assert pull.plot(magnify=10).get_title() == "load step 2, displacements times 10" and pull.probes["grip"]["force_x"][-1] > 0, "load steps"
low, high = plate.plot("damage").collections[0].get_clim()
assert low == 0 < high, "colours from 0: %g, %g" % (low, high)

curve, = bar.plot("velocity_x", 0.0).lines
assert curve.get_xdata().max() < 20.001 and set(np.round(curve.get_ydata(), 6)) == {0.0, 1.0}, "a bar, in mm"
ax = block.plot("von_mises")
assert len(ax.collections[0].get_paths()) == 80 and "z = 1.5 mm" in ax.get_title() and ax.get_ylabel() == "y [mm]", ax.get_title()
ax = block.plot("von_mises", slice={"x": 1e-3})
assert len(ax.collections[0].get_paths()) == 32 and ax.get_xlabel() == "y [mm]"

def refused(kind, call, *words, **more):
    try:
        call(*words, **more)
    except kind:
        return
    sys.exit("not refused: %r %r" % (words, more))
refused(KeyError, block.plot, "no field")
refused(KeyError, plate.plot, "stress")
refused(ValueError, plate.plot, "damage", 10)
refused(ValueError, plate.plot, limits=5e6)
refused(ValueError, plate.plot, limits=("0 MPa", "5 MPa"))
refused(TypeError, frame.plot, "damage", 1e-6)
refused(ValueError, block.plot, slice={"z": 1.0})
refused(ValueError, block.frames[-1].slice, z=1.0)
refused(ValueError, block.frames[-1].slice, z=2e-3, thickness=-1)

# a bar that has separated: a gap in the curve, a point for a particle alone; rubble keeps its size
from cleave._draw import draw_frame
from cleave._shape import deformation_gradients
class Broken:
    dimension, time, scene, spacing = 1, 0.0, "", np.full(6, 1e-3)
    reference = np.arange(6.0)[:, None] * 1e-3 * [1, 0, 0]
    positions = reference + np.array([0, 0, 0, 1, 1, 2])[:, None] * 1e-3 * [1, 0, 0]
    __len__ = lambda self: 6
    moved = lambda self, magnify: self.reference + magnify * (self.positions - self.reference)
    unit = lambda self, name: ""
    __getitem__ = lambda self, name: np.arange(6.0)
curve, alone = draw_frame(Broken(), "damage").lines
assert np.isnan(curve.get_ydata()).sum() == 2 and list(alone.get_ydata()) == [5], "gaps of a bar"
grid = np.stack(np.meshgrid(np.arange(6.0), np.arange(6.0)), -1).reshape(-1, 2)
spread = deformation_gradients(grid, 1.3 * grid, 1.0, np.full(36, 0.9), np.zeros(36), magnify=20.0)
assert np.allclose(spread, np.eye(2)), "rubble"
assert np.allclose(deformation_gradients(grid, 1.01 * grid, 1.0, np.zeros(36), np.zeros(36), magnify=20.0), 1.2 * np.eye(2), atol=0.01), "magnified"
figure = cleave.Figure("crack.start_time", "s", 2e-6, 1e-7, 0.0, 0.0, "", 2e-6, np.array([1e-3, 2e-3]), np.array([2e-6, 3e-6]), np.array([1e-7, 2e-7]), np.ones(2))
ax = figure.plot()
assert ax.get_ylabel() == "crack.start_time [µs]" and ax.get_xlabel() == "spacing [mm]"
END
tried=
if has matplotlib; then holds "pictures by matplotlib" run -W error::RuntimeWarning "$work/draw.py" "$work"; tried=1; fi

# ---- pandas ------------------------------------------------------------------------------------------------------------

cat >"$work/tables.py" <<'END'
import sys
import cleave
run = cleave.open(sys.argv[1] + "/plate")
frame = run.frames[-1]
table = frame.to_pandas()
assert table.index.name == "id" and len(table) == 400 and table.attrs["units"]["stress_xx"] == "Pa" and table.attrs["time"] == frame.time
assert (table["stress_xy"] == frame["stress"][:, 3]).all() and (table["x_ref"] == frame.reference[:, 0]).all() and table["damage"].max() > 0.3
assert len(frame[frame["damage"] > 0].to_pandas()) == (table["damage"] > 0).sum()
history = run.history.to_pandas()
assert list(history) == list(run.history) and history.attrs["units"]["time"] == "s" and len(history) == 11
END
if has pandas; then holds "tables of pandas" run "$work/tables.py" "$work"; tried=1; fi

# ---- VTK ---------------------------------------------------------------------------------------------------------------

cat >"$work/grids.py" <<'END'
import gc
import sys
import types
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
import cleave
for name, kind, volume in (("plate", 9, 4e-4), ("bar", 3, 0.02), ("block", 12, 3.2e-7)):
    frame = cleave.open(sys.argv[1] + "/" + name).frames[-1]
    points, boxes = frame.to_vtk(), frame.to_vtk("boxes")
    gc.collect()                         # arrays are alive though numpy's are gone
    assert points.GetNumberOfPoints() == points.GetNumberOfCells() == boxes.GetNumberOfCells() == len(frame), name
    assert np.allclose(vtk_to_numpy(points.GetPoints().GetData()), frame.positions) and boxes.GetCellType(0) == kind, name
    assert (vtk_to_numpy(points.GetPointData().GetArray("stress")) == frame["stress"]).all(), name
    assert (vtk_to_numpy(boxes.GetCellData().GetArray("id")) == frame["id"]).all() and boxes.GetCellData().HasArray("spacing"), name
    size = vtkCellSizeFilter()
    size.SetInputData(boxes)
    size.Update()
    sizes = [vtk_to_numpy(size.GetOutput().GetCellData().GetArray(what)) for what in ("Length", "Area", "Volume")]
    total = sizes[frame.dimension - 1]
    strain = 0.04 if name == "block" else 0.0
    assert (total > 0).all() and np.isclose(total.sum(), volume * (1 + strain), rtol=0.01), "%s: size %g" % (name, total.sum())
large = frame.to_vtk(magnify=10.0).GetBounds()
assert np.isclose(large[1] - large[0], np.ptp(frame.reference[:, 0] + 10 * (frame.positions - frame.reference)[:, 0])), large
sys.modules["pyvista"] = types.SimpleNamespace(wrap=lambda grid: ("wrapped", grid.GetNumberOfCells()))
assert frame.to_pyvista("boxes") == ("wrapped", len(frame)), "a stand-in for PyVista"
END
if has vtkmodules; then holds "grids of VTK" run "$work/grids.py" "$work"; tried=1; fi

# ---- pip ---------------------------------------------------------------------------------------------------------------

# A virtual environment with the packages of the system, without network; the module finds the program that was installed with it.
if has venv && has ensurepip && has pip && [ -x build/cleave ]; then
    tried=1
    "$python" -m venv --system-site-packages "$work/env" >"$work/log" 2>&1 || fail "venv: $(cat "$work/log")"
    "$work/env/bin/pip" install --no-index ./src/python >"$work/log" 2>&1 || fail "pip install ./src/python: $(cat "$work/log")"
    is "the program that pip installed" "$(cd / && unset CLEAVE && "$work/env/bin/python" -c 'import cleave; print(cleave.program())')" "$work/env/bin/cleave"
    is "version" "$("$work/env/bin/pip" show cleave 2>/dev/null | sed -n 's/^Version: //p')" "$(sed -n 's/^VERSION *:= *//p' Makefile)"
    holds "it runs" "$work/env/bin/cleave" info >/dev/null
    holds "hints for type checkers" test -e "$("$work/env/bin/python" -c 'import cleave, os; print(os.path.dirname(cleave.__file__))')/py.typed"
    "$work/env/bin/pip" uninstall -y cleave >"$work/log" 2>&1
    is "files that pip leaves" "$(find "$work/env" -name '*cleave*')" ""
    is "files that pip leaves in the checkout" "$(find src/python -name build -o -name '*.egg-info' -o -name __pycache__)" ""
    "$work/env/bin/pip" install --no-index -e ./src/python >"$work/log" 2>&1 || fail "pip install -e ./src/python: $(cat "$work/log")"
    is "the module of the checkout" "$(cd / && "$work/env/bin/python" -c 'import cleave; print(cleave.__file__)')" "$root/src/python/cleave/__init__.py"
fi

# ---- the manual --------------------------------------------------------------------------------------------------------

# The examples of inputs/python.md, one after the other.
mkdir "$work/examples" && cp -r inputs "$work/examples"
awk '/^```python$/ { on = 1; next } /^```$/ { on = 0 } on' inputs/python.md >"$work/examples/all.py"
if has matplotlib; then
    (cd "$work/examples" && run all.py) >"$work/log" 2>&1 || fail "examples of inputs/python.md: $(tail -n 5 "$work/log")"
    is "the key that an example names" "$(grep -c '^boundary.0.traction traction\[1\]: 24 mm is a length' "$work/log")" 1
    for file in damage.pdf pull.pdf; do holds "examples draw $file" test -s "$work/examples/results/$file"; done
fi

# ---- notebooks ---------------------------------------------------------------------------------------------------------

# By nbconvert if it is there, else cell by cell.
cat >"$work/cells.py" <<'END'
import json
import sys
scope = {}
for cell in json.load(open(sys.argv[1]))["cells"]:
    if cell["cell_type"] == "code":
        exec("".join(cell["source"]), scope)
END
if has matplotlib; then
    has nbconvert && has ipykernel && convert=1 || convert=
    mkdir "$work/books"
    for book in inputs/*.ipynb; do
        name=$(basename "$book" .ipynb)
        cp "$book" "$work/books" && holds "$book has no stored outputs" "$python" -c \
            'import json, sys; sys.exit(any(cell.get("outputs") for cell in json.load(open(sys.argv[1]))["cells"]))' "$book"
        if [ -n "$convert" ]; then
            (cd "$work/books" && unset MPLBACKEND && run -m nbconvert --to notebook --execute --output "$name.done" "$name.ipynb") >"$work/log" 2>&1
        else
            (cd "$work/books" && run "$work/cells.py" "$name.ipynb") >"$work/log" 2>&1
        fi || fail "$book: $(tail -n 20 "$work/log")"
    done
    for file in glass_figure.pdf plate_loads.pdf; do holds "notebooks draw $file" test -s "$work/books/results/$file"; done
    [ -z "$convert" ] || is "pictures in notebooks" "$(cat "$work"/books/*.done.ipynb | grep -c '"image/png"')" 3
fi

[ -n "$tried" ] || { echo "no matplotlib, pandas, vtk or pip of Python"; exit 77; }
finish
