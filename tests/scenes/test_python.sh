#!/bin/sh
# The Python module (src/python/cleave): runs scenes with overrides, scenes that are dictionaries, and studies; passes on the program's
# message, position and exit status; reads the files of `cleave`: history, summary, frames by id, probes, fragments, tables of studies, a
# run in progress. Functions that need matplotlib, pandas or vtk: long_python.sh. Skipped if numpy or h5py is missing.
test_name=python
. tests/support/summary.sh

for python in python3 /usr/bin/python3 none; do
    "$python" -c 'import numpy, h5py' 2>/dev/null && break
done
[ "$python" != none ] || { echo "test_python: no python3 with numpy and h5py (Debian: python3-numpy python3-h5py)"; exit 77; }

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
probes: [tip, line: {name: middle, from: [0, 0.5 mm], to: [20 mm, 0.5 mm]}]
output:
  frames: 2
  samples: 10
  regions: [{name: left, region: {box: {from: [0, -10 mm], to: [5 mm, 10 mm]}}, every: 3 us}]
END

cat >"$work/test.py" <<'END'
import os
import shutil
import sys

import numpy as np

import cleave

work = sys.argv[1]
scene = work + "/plate.yaml"
checks = 0


def holds(what, claim):
    global checks
    checks += 1
    if not claim:
        sys.exit("test_python: " + what)


def refused(what, status, call, *words, **more):
    try:
        call(*words, **more)
    except cleave.Error as fault:
        holds(what + ": its line", "\n" not in str(fault) and str(fault))
        holds(what + ": its status %s" % fault.status, fault.status == status)
        return str(fault)
    sys.exit("test_python: not refused: " + what)


run = cleave.run(scene, {"boundary.0.traction": [0, 12e6], "boundary.1.traction": [0, np.float64(-12e6)],
                         "time.active_set": False, "output.frames": 3, "name": "from_python"},
                 output=work + "/run", threads=2)
history, summary = run.history, run.summary

# the overrides arrived, numbers as numbers
holds("traction", "traction: [0, 12000000]" in run.scene and "traction: [0, -12000000]" in run.scene)
holds("flag and number", "active_set: false" in run.scene and len(run.frames) == 4)
holds("text", summary["name"] == "from_python" and run.status == "done")

# tables: columns by name, with units
holds("rows", history.rows == len(history["time"]) == 11 and history["time"][0] == 0)
holds("time", np.isclose(history["time"][-1], 6e-6) and history.units["time"] == "s" and history.units["step"] == "")
holds("a column by its earlier name", np.array_equal(history["rest_share"], history["inactive_share"]))
holds("a figure by its earlier name", summary["rest_share"] == summary["inactive_share"])
holds("energy", np.isclose(history["kinetic"][-1], summary["energy.kinetic"], rtol=1e-8))
holds("pieces", run.fragments["mass"].sum() > 0 and run.fragments.units["mass"] == "kg")

# records: by path, by name, by attribute
holds("path", summary["crack.tips.0.x"] == summary["crack"]["tips"][0]["x"] == summary.crack.tips[0].x)
for path in ("crack.tips.99.x", "crack.nothing", "name.nothing"):
    holds(path, path not in summary)

# frames: in the order of ids, against the lattice of the scene and against the history
frame = run.frames[-1]
holds("particles", len(frame) == summary["particles"] == 400 and (np.diff(frame["id"]) > 0).all())
x, y = 1e-3 * (np.arange(400) % 20 + 0.5), 1e-3 * (np.arange(400) // 20 + 0.5) - 10e-3
holds("places at rest", np.allclose(frame.reference, np.c_[x, y, 0 * x], atol=1e-12))
holds("places now", np.allclose(frame.positions - frame.reference, frame["displacement"], atol=1e-15, rtol=1e-6))
holds("shapes", frame["stress"].shape == (400, 6) and frame["velocity"].shape == (400, 3) and frame["damage"].shape == (400,))
holds("units", frame.units["stress"] == "Pa" and frame.units["damage"] == "")
kinetic = 0.5 * 2440 * 1e-9 * (frame["velocity"].astype(float) ** 2).sum()
holds("kinetic energy %g, %g" % (kinetic, history["kinetic"][-1]), np.isclose(kinetic, history["kinetic"][-1], rtol=0.05))
holds("times", np.allclose(run.frames.times, [0, 2e-6, 4e-6, 6e-6], atol=1e-7) and run.frames.at(6.5e-6).time == run.frames[-1].time)
holds("slice", len(run.frames[1:]) == 3 and run.frames[0].step == 0 and "space: plane stress" in frame.scene)
try:
    frame["no field"]
    sys.exit("test_python: a field that is not there")
except KeyError as fault:
    holds("fields that there are", "displacement" in str(fault))
left = run.regions["left"]
holds("a region", list(run.regions) == ["left"] and len(left) == 3 and len(left[-1]) == 100 and (left[0].reference[:, 0] < 5e-3).all())
for entries, name in ((history, "kinetics"), (summary, "crack.tip")):
    try:
        entries[name]
        sys.exit("test_python: an entry that is not there")
    except KeyError as fault:
        holds("entries that there are", "kinetic, " in str(fault) or "tips" in str(fault))

# probes
tip = run.probes["tip"]
holds("tip", tip["growth"][-1] == history["tip.growth"][-1] and tip.figures["x"] == summary["probes.tip.x"])
holds("profiles", len(run.probes["middle"].profiles) == 4 and run.probes["middle"].profiles[0].rows > 1)

# what is refused keeps the program's line and status; what is not there is said
message = refused("a wrong unit", 2, cleave.run, scene, {"particles.spacing": "1 kg"}, output=work + "/none")
holds("key and remedy in the line: " + message, "particles.spacing" in message)
refused("an older run", 2, cleave.run, scene, output=work + "/run")
refused("no run there", None, cleave.open, work)
refused("no study there", None, lambda: run.sweep)
holds("a command's text", "cleave" in cleave.call("info"))

# a run in progress: the last line is being written, no summary yet; the table is read again once the file has grown
os.mkdir(work + "/half")
with open(work + "/half/history.csv", "w") as file:
    file.write("time [s],kinetic [J]\n0,0\n1e-6,2")
half = cleave.open(work + "/half")
holds("half a line", half.history.rows == 1 and half.status == "no summary yet" and len(half.frames) == 0)
with open(work + "/half/history.csv", "a") as file:
    file.write("5\n")
holds("the line whole", half.history["kinetic"][-1] == 25)

with open(work + "/half/summary.json", "w") as file:
    file.write('{"status": ')
refused("half a summary", None, lambda: half.status)

# fields that follow from stored ones, components, parts of frames
stress = frame["stress"].astype(float)
deviator = stress - np.r_[1, 1, 1, 0, 0, 0] * stress[:, :3].mean(axis=1)[:, None]
holds("von Mises", np.allclose(frame["von_mises"] ** 2, 1.5 * (deviator ** 2 * np.r_[1, 1, 1, 2, 2, 2]).sum(axis=1), rtol=1e-5))
holds("a component by either order of its axes", (frame["stress_zx"] == frame["stress_xz"]).all() and frame.unit("stress_zx") == "Pa")
holds("components", (frame["stress_xy"] == frame["stress"][:, 3]).all() and (frame["velocity_y"] == frame["velocity"][:, 1]).all())
holds("principal stresses", np.allclose(frame["principal_stress"].sum(axis=1), -3 * frame["pressure"], atol=1.0)
      and (np.diff(frame["principal_stress"], axis=1) <= 0).all())
for what, call in (("a unit", lambda: frame.unit("xx")), ("a probe", lambda: run.probes["xx"]), ("a region", lambda: run.regions["xx"])):
    try:
        call()
        holds("%s of nothing is refused" % what, False)
    except KeyError as fault:
        holds("%s of nothing names what is there: %s" % (what, fault), "xx; " in str(fault) and " has " in str(fault))
try:
    cleave.sweep({}, {})
    holds("a sweep without values is refused", False)
except ValueError as fault:
    holds("a sweep without values: %s" % fault, "lists of values by key are expected" in str(fault))
holds("their units", frame.unit("von_mises") == frame.unit("stress_xy") == "Pa" and frame.unit("velocity_y") == "m/s")
for name in ("stress_z", "velocity_xx", "damage_x", "level"):
    try:
        frame[name]
        sys.exit("test_python: a field that is not there: " + name)
    except KeyError:
        pass
layer = frame.slice(y=0.5e-3)
holds("a slice", len(layer) == 20 and np.allclose(layer.reference[:, 1], 0.5e-3) and (layer["id"] == np.arange(200, 220)).all())
holds("a slice midway is one layer", np.allclose(frame.slice(y=0.0).reference[:, 1], 0.5e-3) and len(frame.slice(y=0.0, thickness=1e-3)) == 40)
holds("a slice of a slice", list(layer.slice(x=3.5e-3)["id"]) == [203])
broken = frame[frame["damage"] > 0.3]
holds("a mask", 0 < len(broken) < 400 and broken["damage"].min() > 0.3 and len(broken[:3].positions) == 3)
holds("spacing", np.allclose(frame.spacing, 1e-3) and frame.dimension == 2 and len(layer.spacing) == 20)

# shapes of particles: of a homogeneous deformation, beside a crack that opens, of a lone particle
from cleave._shape import corners_of, deformation_gradients
wanted = np.array([[1.2, 0.3], [-0.1, 0.9]])
places = frame.reference[:, :2]
none, one = np.zeros(400), np.zeros(400, dtype=int)
holds("a homogeneous deformation", np.allclose(deformation_gradients(places, places @ wanted.T, 1e-3, none, one), wanted, rtol=1e-4))
parted = places + np.where(places[:, 1:] > 0, [[0, 1e-4]], [[0, 0]])
flanks = (np.abs(places[:, 1]) < 1e-3).astype(float)
holds("faces of a crack", np.allclose(deformation_gradients(places, parted, 1e-3, flanks, one), np.eye(2)))
slit = cleave._shape.precracks("cracks:\n  - {from: [-1, 0], to: [1, 0]}\nboundary:\n  - {from: [0, 0], to: [1, 1]}\n")
holds("a pre-crack of material points", len(slit) == 1 and np.allclose(deformation_gradients(places, parted, 1e-3, none, one, slit), np.eye(2)))
holds("the bodies", not np.allclose(deformation_gradients(places, parted, 1e-3, none, one), np.eye(2)))
holds("two bodies", np.allclose(deformation_gradients(places, parted, 1e-3, none, (places[:, 1] > 0).astype(int)), np.eye(2)))
holds("a lone particle", np.allclose(deformation_gradients(places[:1], parted[:1], 1e-3, none[:1], one[:1]), np.eye(2)))
square = corners_of(frame)[210]
holds("corners", square.shape == (4, 2) and np.allclose(square.mean(axis=0), frame.positions[210, :2], atol=1e-9)
      and np.allclose(np.ptp(square, axis=0), 1e-3, rtol=0.02))

# colours and their ends are those of the program: its tables, and what `cleave plot` prints
import re
from cleave import _draw
source = open(os.path.join(sys.argv[2], "src/plot/colours.c")).read()
for table, own in (("diverging", _draw._DIVERGING), ("damage_stops", _draw._DAMAGE)):
    rows = re.findall(r"{([^{}]*)}", re.search(r"struct stop %s\[\] = {(.*?)\n};" % table, source, re.S).group(1))
    stops = [[float(number) for number in row.split(",")] for row in rows]
    holds("colours: " + table, [[at, *colour] for at, colour in own] == stops)
from cleave._fields import PREFIXES, scale_of
rows = re.findall(r'{([-0-9e]+), "([^"]*)"}', open(os.path.join(sys.argv[2], "src/plot/plot_units.c")).read().split("};")[0])
holds("prefixes are those of the program", [(float(size), name) for size, name in rows] == list(PREFIXES))
holds("units", [scale_of(*value)[1] for value in ((4e3, "m"), (4, "m"), (0.04, "m"), (4e-5, "m"), (4e-12, "s"), (2e15, "N"), (1500, "m/s"), (0, "J"))]
      == ["km", "m", "mm", "µm", "ps", "PN", "km/s", "J"])
class Layers:    # a column of four particles, of which the third has the largest stress
    reference, spacing, dimension = np.array([[0.0, 0.0, z] for z in range(4)]), np.ones(4), 3
    fields = {"von_mises": np.array([1.0, 2.0, 5.0, 1.0]), "damage": np.zeros(4)}
    def __contains__(self, name): return name in self.fields
    def __getitem__(self, name): return self.fields[name]
    def unit(self, name): return ""
holds("the section through the largest value", [_draw._layer(Layers(), 2, name) for name in ("von_mises", "damage")] == [2, 1])
if shutil.which("gnuplot"):
    for field in ("damage", "von_mises", "stress_yy", "speed", "velocity_y", "pressure", "displacement"):
        said = cleave.call("plot", run.folder, "--field", field, "--times", "last", "--size", "300x226", "-o", work + "/colours.png")
        ends = [float(end) for end in re.search(r"colours from (\S+) to (\S+)", said).groups()]
        values = _draw._values_of(frame, field)[0]
        holds("ends of the colours of " + field, np.allclose(_draw._limits(values, field, None), ends, rtol=2e-4))

# faces of the pre-crack: two lines along it, that move with the particles beside it
from cleave._shape import crack_faces, is_scattered, without_gaps
around = np.linspace(0, 2 * np.pi, 63)[:-1]
ring = np.vstack([radius * np.column_stack([np.cos(around), np.sin(around)]) for radius in (10, 11)])
holds("a ring is on no lattice", is_scattered(ring, np.ones(len(ring))) and not is_scattered(frame.reference[:, :2], frame.spacing))
holds("a lattice needs no wider squares", len(without_gaps(frame, (0, 1), np.zeros((len(frame), 4, 2)), frame["id"])[1]) == len(frame))
faces = crack_faces(frame)
holds("two faces", len(faces) == 2 and all(np.allclose(face[[0, -1], 0], [0, 9.9e-3], atol=2e-5) for face in faces))
opened = crack_faces(frame, magnify=100)
gap = np.interp(1e-3, opened[0][:, 0], opened[0][:, 1]) - np.interp(1e-3, opened[1][:, 0], opened[1][:, 1])
above, below = (frame.slice(y=y) for y in (0.5e-3, -0.5e-3))
wanted = 100 * np.mean([(above.positions - above.reference)[:2, 1] - (below.positions - below.reference)[:2, 1]])
holds("as far apart as the particles: %g, %g" % (gap, wanted), gap > 0 and np.isclose(gap, wanted, rtol=0.1))

# A body far from the origin, whose points in the file are rounded to 0.5 mm, is nowhere else for that.
with open(work + "/far.yaml", "w") as file:
    file.write("space: plane stress\nthickness: 1 mm\nduration: 1 us\nmethod: pd\nmaterial: {young: 72 GPa, density: 2440}\n"
               "body: {box: {from: [5000, 0], to: [5000.02, 20 mm]}}\nparticles: {spacing: 1 mm}\noutput: {frames: 1}\n")
far = cleave.run(work + "/far.yaml", output=work + "/far").frames[-1]
holds("far away, at rest", (far.positions == far.reference).all() and (far.moved(1e6) == far.reference).all())
holds("and squares there", np.allclose(np.ptp(corners_of(far, 1e6), axis=1), 1e-3, atol=1e-8))

# fields with named values: the colours and names of the program
from cleave._categories import _FRAGMENTS, _PARTS, categories_of
rows = [[tuple(int(part) for part in colour.split(",")[:3]) for colour in re.findall(r"{([0-9, ]*)}", body)]
        for body in re.findall(r"struct colour turn\[\] = {(.*?)};", source, re.S)]
holds("colours of fragments and parts", rows == [list(_FRAGMENTS), list(_PARTS)])
holds("names", [entry[1] for entry in categories_of(frame, "fragment", np.array([-1, 0, 3]))] == ["no bond left", "the heaviest", "fragment 3"]
      and categories_of(frame, "kind", frame["kind"])[0][1] == "peridynamics")

# packages that only some functions need: one line says which and how to get it
for name, need in (("matplotlib.pyplot", lambda: run.plot()), ("pandas", frame.to_pandas), ("pandas", history.to_pandas),
                   ("vtkmodules.vtkCommonDataModel", frame.to_vtk), ("pyvista", frame.to_pyvista), ("h5py", lambda: frame["id"])):
    kept, sys.modules[name] = sys.modules.get(name), None
    try:
        need()
        sys.exit("test_python: without " + name)
    except ImportError as fault:
        holds("a missing package: %s" % fault, "pip install" in str(fault) and "\n" not in str(fault))
    sys.modules.pop(name)
    if kept:
        sys.modules[name] = kept

# an empty selection, and arguments of pictures that mean nothing: one plain line each; where pandas or matplotlib is missing, not tested
def plain(what, words, call):
    try:
        call()
    except ValueError as fault:
        holds("%s: %s" % (what, fault), words in str(fault) and "\n" not in str(fault))
        return
    sys.exit("test_python: not refused: " + what)


empty = frame[frame["damage"] > 5]
plain("a time that is no number", "time: ", lambda: run.frames.at(float("nan")))
plain("a time beyond the run", "time: 1 s is not in the run, whose frames are from 0 to 6e-06 s", lambda: run.frames.at(1.0))
plain("a slice beyond the body", "no particle at x = 1 m; they are from 0.0005 to 0.0195 m", lambda: frame.slice(x=1.0))
plain("a negative thickness", "thickness: ", lambda: frame.slice(x=5e-3, thickness=-1e-3))
plain("an axis that a plane frame does not have", "slice: this frame has x and y, no z", lambda: frame.slice(z=0))
plain("text as a position", "x: a number [m], not '5 mm'", lambda: frame.slice(x="5 mm"))
plain("text as a thickness", "thickness: a number from 0 [m], not '1 mm'", lambda: frame.slice(x=5e-3, thickness="1 mm"))
plain("text as a time", "time: a number [s], not '2 us'", lambda: run.frames.at("2 us"))
plain("text as threads", "threads: a whole number, not 'two'", lambda: cleave.run(scene, threads="two"))
plain("a share of a job", "jobs: a whole number, not 1.5", lambda: cleave.sweep(scene, {"method": ["pd", "mpm"]}, jobs=1.5))
plain("a budget that is no time", "budget: a number [s] or text", lambda: cleave.converge(scene, budget=[5]))
try:
    frame[["damage", "body"]]
except IndexError as fault:
    holds("several names: %s" % fault, "the name of a field, or a mask" in str(fault))
try:
    import pandas
    table = empty.to_pandas()
    holds("an empty table", len(table) == 0 and list(table) == list(frame.to_pandas()) and "stress_xy" in table)
except ImportError:
    pass
try:
    import matplotlib
    matplotlib.use("Agg")
except ImportError:
    matplotlib = None
if matplotlib:
    plain("no particles", "no particles to draw", lambda: empty.plot("damage"))
    plain("magnify='ten'", "magnify: a number above 0, not 'ten'", lambda: run.plot(magnify="ten"))
    plain("magnify=0", "magnify: a number above 0, not 0", lambda: run.plot(magnify=0))
    for limits in ((1, 0), (0, 0), (0, np.nan), (0,), 5e6, ("0 MPa", "5 MPa")):
        plain("limits", "limits: two numbers in the SI unit of the field, the lower one first", lambda: run.plot("damage", limits=limits))
    plain("a time that is no number", "time: a number", lambda: run.plot(time=float("nan")))
    plain("colours", "not 'nosuch'", lambda: run.plot(colours="nosuch"))

# scenes that are dictionaries: the bits of the scene in a file; what is refused names line, column and key
plate = {"space": "plane stress", "thickness": "1 mm", "duration": 6e-6, "method": "pd",
         "material": {"young": "72 GPa", "density": "2440 kg/m^3", "energy_release_rate": 135},
         "body": {"box": {"from": [0, "-10 mm"], "to": ["20 mm", np.float64(0.01)]}}, "particles": {"spacing": "1 mm"},
         "cracks": [{"from": [0, 0], "to": ["9.9 mm", 0]}],
         "boundary": [{"traction": [0, "12 MPa"], "face": "y+"}, {"traction": np.array([0, -12e6]), "face": "y-"}],
         "probes": ["tip", {"line": {"name": "middle", "from": [0, 5e-4], "to": ["20 mm", "0.5 mm"]}}],
         "time": {"active_set": False},
         "output": {"frames": 3, "samples": 10, "regions": [{"name": "left", "region": {"box": {"from": [0, -0.01], "to": [5e-3, 0.01]}}, "every": "3 us"}]}}
told = []
same = cleave.run(plate, {"name": "from_dictionary"}, output=work + "/dictionary", progress=told.append)
holds("the bits of the scene in a file", (same.frames[-1]["stress"] == run.frames[-1]["stress"]).all() and same.summary["name"] == "from_dictionary")
holds("progress", told and told[-1].step == told[-1].steps == same.summary["steps"] and told[-1].share == 1 and "step" in str(told[-1])
      and np.isclose(told[-1].time, 6e-6, rtol=1e-3) and np.isclose(told[-1].crack_length, history["crack_length"][-1], rtol=0.01))
holds("progress of load steps", cleave._program.progress_of("load step 3/50  12 equilibria  at most 2 min left  PD 100.0 %  crack 0.5 mm").seconds_left == 120)


def faulty(entries, key, line, words, **more):
    try:
        cleave.Scene(entries, **more).check(trial=False)
    except cleave.SceneError as fault:
        holds("%s: %s" % (fault, vars(fault)), fault.key == key and fault.line == line and fault.status == 2 and words in fault.message)
        holds("its place in the line", str(fault).endswith(fault.message) and (line is None or str(fault).startswith("<scene>:%d:" % line)))
        return fault
    sys.exit("test_python: not refused: " + words)


fault = faulty({**plate, "duratoin": 1}, "duratoin", 41, "did you mean duration?")
both = faulty({**plate, "duratoin": 1, "thikness": 1}, "duratoin", 41, "did you mean duration?")
holds("a second unknown key", "thikness: unknown key; did you mean thickness?" in str(both))
holds("its line", fault.source == "duratoin: 1" and fault.column == 1)
faulty({**plate, "boundary": [plate["boundary"][0], {"traction": [0, "1 kg"], "face": "y-"}]}, "boundary.1.traction", 21, "1 kg is a mass")
faulty(plate, "thickness", 1, "thickness: missing", changes={"thickness": None})
faulty(plate, "material.density", 5, "density: missing", changes={"material.density": None})
faulty({**{k: v for k, v in plate.items() if k != "material"}, "materials": [{"name": "glass", "young": 72e9, "energy_release_rate": 135}]},
       "materials.0.density", 38, "density: missing")
faulty(plate, "particles.spacing", None, "2 s is a time", changes={"particles.spacing": "2 s"})
with open(work + "/faulty.yaml", "w") as file:
    file.write("space: plane stress\nthickness: 1 s\n")
try:
    cleave.run(work + "/faulty.yaml")
    sys.exit("test_python: a faulty file")
except cleave.SceneError as fault:
    holds("of a file: %s" % vars(fault), (fault.file, fault.line, fault.column, fault.source) == (work + "/faulty.yaml", 2, 1, "thickness: 1 s") and fault.key is None)
for value in ({1, 2}, object()):
    try:
        cleave.Scene({"space": value})
        sys.exit("test_python: a value of a type that scenes do not have")
    except TypeError:
        pass

made = cleave.Scene({**plate, "name": "plate-1"})
found = made.check(trial=False)
holds("a sound scene", found == [] and found.rows["particles"][0].startswith("400: 400 peridynamic") and found.text.splitlines()[-1].endswith("is sound"))
holds("hints", any("symmetric" in hint for hint in found.hints))
found = made.changed({"material.young": "72 Pa", "output.regions": None}).check(trial=False)
holds("a warning: %s" % found, any("check the units of young" in line for line in found) and made.changes == {})
held = made.changed({"boundary.1": {"name": "held", "fixed": "all", "face": "x-"}}).check(trial=False)
holds("a dictionary among the changes: %s" % held, "held: x, y held on x-" in held.text)
made.save(work + "/made.yaml")
holds("no temporary file in what check says: %s" % found, not any("/cleave-" in line for line in [*found, found.text]))
holds("saved", cleave.Scene(work + "/made.yaml").check(trial=False) == [] and open(work + "/made.yaml").read() == made.text)
holds("a scene that includes others", cleave.Scene({"include": work + "/made.yaml", "thickness": 2e-3}).check(trial=False) == [])

# an exception of the callback interrupts the run after a checkpoint, from which it continues
try:
    cleave.run(plate, {"duration": 0.1, "output.regions": None}, output=work + "/stopped", progress=lambda now: 1 / 0)
    sys.exit("test_python: a callback that fails")
except ZeroDivisionError:
    holds("interrupted", cleave.open(work + "/stopped").status == "interrupted")

# studies
told = []
study = cleave.sweep(plate, {"particles.spacing": ["2 mm", 4e-3], "boundary.0.traction": [[0, 6e6]]}, output=work + "/sweep", jobs=1, progress=told.append)
holds("a sweep", list(study.sweep["state"]) == ["done"] * 2 and study.status == "study" and [p.step for p in told] == [1, 2] and told[-1].steps == 2)
holds("its runs", list(study.runs) == list(study.sweep["run"]) and list(study.runs.values())[1].summary["particles"] == study.sweep["particles"][1] == 25)
study = cleave.converge(plate, "energy.kinetic", {"output.frames": 0}, output=work + "/converge", levels=3, runs=1, budget=5, jobs=2)
figure = study.figures["energy.kinetic"]
holds("a figure: %s" % figure, figure.unit == "J" and figure.uncertainty > 0 and len(figure.means) == len(figure.spacings) >= 3
      and figure.value == study.converge["value"][0] and (np.diff(figure.spacings) > 0).all() and len(study.runs) >= 3)

# a frame of the earlier form, complete by itself
import h5py
with h5py.File(frame.path, "r") as old, h5py.File(work + "/alone.hdf", "w") as new:
    for name in ("VTKHDF", "Cleave"):
        old.copy(name, new, expand_external=True)
alone = cleave.Frame(work + "/alone.hdf", frame.time)
holds("complete by itself", (alone["id"] == frame["id"]).all() and (alone.reference == frame.reference).all() and alone.scene == frame.scene)

# a frame beside a particles file that is cut short, damaged, of another run or missing; then as it was
beside = work + "/run/frames/particles_000000.h5"
whole = open(beside, "rb").read()
foreign = cleave.run(scene, {"particles.spacing": 0.002}, output=work + "/foreign")
foreign = open(foreign.folder + "/frames/particles_000000.h5", "rb").read()
for words, contents in (("is cut short", whole[:-9]), ("is cut short", whole[:3000]), ("is cut short", whole[:2000] + whole[2001:]),
                        ("is cut short", b""), ("as a particles file", bytes(len(whole) - 24) + whole[-24:]),
                        ("is of another run", foreign), ("is a frame", open(frame.path, "rb").read()), ("is missing", None)):
    os.remove(beside)
    if contents is not None:
        with open(beside, "wb") as file:
            file.write(contents)
    for read in (lambda: frame["id"], lambda: frame["stress"], lambda: frame.reference, lambda: frame.scene, lambda: len(frame)):
        message = refused("a particles file that " + words, None, read)
        holds(message, "particles_000000.h5 in the same folder, to which it links, " in message and words in message)
with open(beside, "wb") as file:
    file.write(whole)
holds("the particles file as it was", (np.diff(frame["id"]) > 0).all() and len(frame) == 400)
os.remove(run.frames[1].path)
refused("a frame that is lost", None, lambda: run.frames[1]["stress"])

# tables of studies: text where cells are words, nan where they are empty
os.mkdir(work + "/study")
with open(work + "/study/sweep.csv", "w") as file:
    file.write('run,state,method,"boundary.0.velocity [m/s]",steps\na,done,pd,"[1, 0]",3\nb,failed,mpm,"[2, 0]",\n')
sweep = cleave.open(work + "/study").sweep
holds("words", list(sweep["method"]) == ["pd", "mpm"] and sweep["boundary.0.velocity"][1] == "[2, 0]")
holds("numbers", sweep["steps"][0] == 3 and np.isnan(sweep["steps"][1]))
with open(work + "/line.yaml", "w") as file:
    file.write("space: line\nsection: 2 mm^2\nduration: 2 us\nmethod: pd\nmaterial: {young: 70 GPa, density: 2700}\n"
               "body: {box: {from: [0], to: [20 mm]}}\nparticles: {spacing: 1 mm}\noutput: {frames: 1, samples: 4}\n")
line = cleave.run(work + "/line.yaml", output=work + "/line")
SOLID = {"space": "solid", "duration": "1 us", "method": "pd", "material": {"young": "70 GPa", "density": 2700},
         "body": {"box": {"from": [0, 0, 0], "to": ["4 mm", "4 mm", "4 mm"]}}, "particles": {"spacing": "1 mm"}, "output": {"frames": 1, "samples": 4}}
cube = cleave.run(SOLID, output=work + "/cube")
for plane in ({"q": 1}, {}, {"x": 1e-3, "y": 1e-3}):
    if matplotlib:
        plain("a plane", "slice: one of x, y, z", lambda: cube.plot(slice=plane))

# rigid bodies are outlined where they are, magnified at their distance from the plate: a box 3 mm x 2 mm that has moved 20 um, a sphere cut at its middle
anvil = {"name": "anvil", "rigid": True, "shape": {"box": {"from": ["4 mm", "11 mm"], "to": ["7 mm", "13 mm"]}}, "velocity": [0, "-10 m/s"]}
pressed = cleave.run({**{k: v for k, v in plate.items() if k not in ("body", "output", "boundary")}, "duration": "2 us",
                      "bodies": [{"name": "plate", "shape": plate["body"]}, anvil], "output": {"frames": 1, "samples": 4}}, output=work + "/pressed")
ball = cleave.run({**{k: v for k, v in SOLID.items() if k != "body"},
                   "bodies": [{"name": "cube", "shape": SOLID["body"]},
                              {"name": "ball", "rigid": True, "shape": {"ball": {"centre": ["2 mm", "2 mm", "6 mm"], "radius": "1.5 mm"}}}]}, output=work + "/ball")
for factor in (1, 100):
    outline = cleave._rigid.outlines_of(pressed.frames[-1], factor, (0, 1), None).reshape(-1, 2)
    holds("the outline of a box", np.allclose([outline.min(axis=0), outline.max(axis=0)], [[4e-3, 11e-3 - 2e-5], [7e-3, 13e-3 - 2e-5]], atol=3e-7))
class Three:    # three particles; a face from (0, 2) to (6, 2), of which the third particle is nearest, to its middle
    dimension, moved = 2, lambda self, magnify: np.array([[0, 0, 0], [6, 0, 0], [3, 1, 0]]) + magnify * self["displacement"]
    def __getitem__(self, name): return np.array([[0, 0, 0], [0, 0, 0], [0.1, -0.2, 0]])
holds("it moves with the nearest particle", (cleave._rigid._beside(Three(), np.array([[[0, 2, 0], [6, 2, 0]]])) == [0.1, -0.2, 0]).all())
outline = cleave._rigid.outlines_of(ball.frames[0], 1, (0, 2), 2e-3).reshape(-1, 2)
holds("the section of a sphere", len(outline) > 20 and np.allclose(np.hypot(outline[:, 0] - 2e-3, outline[:, 1] - 6e-3), 1.5e-3, rtol=0.02))
holds("no rigid body", len(cleave._rigid.outlines_of(frame, 1, (0, 1), None)) == 0)
if matplotlib:
    lines = pressed.plot().collections[1]
    far_away = far.plot("speed")
    holds("a body far away: whole numbers in the unit of its extent", (far_away.get_xlabel(), far_away.xaxis.get_major_formatter().get_useOffset()) == ("x [mm]", False))
    holds("it is drawn", type(lines).__name__ == "LineCollection" and lines.axes.get_ylim()[1] > 12.9)
    holds("the section that is found", "y = 1.5 mm" in ball.plot(slice={"y": 1.2e-3}).get_title())
    holds("the sphere is drawn", len(ball.plot(slice={"y": 2e-3}).collections) == 2 and len(run.plot().collections) == 1)
holds("places at rest of a line", line.frames[-1].reference.shape == (20, 3) and (line.frames[-1].reference[:, 1:] == 0).all())

print(checks)
END

told=$(CLEAVE=$cleave PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=src/python "$python" "$work/test.py" "$work" "$root") || exit 1
checks=$((checks + told))

# Once installed, it finds the program that was installed with it.
holds "make install" make -s install BUILD="${BUILD:-build}" PREFIX="$work/prefix" -o all >"$work/installed"
PYTHONPATH=$(sed -n 's/.*PYTHONPATH=\([^ :]*\).*/\1/p' "$work/installed")
is "where it is" "$PYTHONPATH" "$work/prefix/lib/python3/dist-packages"
is "its program" "$(cd / && unset CLEAVE && PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$PYTHONPATH "$python" -c 'import cleave; print(cleave.program())')" "$work/prefix/bin/cleave"
finish
