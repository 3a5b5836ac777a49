#!/bin/sh
# Frames are opened by the reader of VTK 9.1, for which they are written, if python3-vtk9 is installed.
test_name=test_paraview
. tests/support/summary.sh
vtk=$(for python in /usr/bin/python3 python3; do "$python" -c 'import vtk; vtk.vtkHDFReader' 2>/dev/null && echo "$python" && break; done)
[ -n "$vtk" ] || { echo "python3 has no vtk (package python3-vtk9): frames not opened by VTK"; exit 77; }

cat >"$work/small.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 4 us
method: pd
material: {young: 190 GPa, density: 7800, energy_release_rate: 69 kJ/m^2}
body: {box: {from: [0, 0], to: [10 mm, 10 mm]}}
particles: {spacing: 0.5 mm}
cracks: [{from: [0, 5 mm], to: [5 mm, 5 mm]}]
initial: [{velocity_gradient: [0, 0, 0, 1000]}]
output:
  every: 2 us
  fields: all
  regions: [{name: tip, region: {disc: {centre: [5 mm, 5 mm], radius: 2 mm}}, every: 1 us}]
END
"$cleave" run "$work/small.yaml" -q -o "$work/run" || fail "the run"

cat >"$work/look.py" <<'END'
import sys, vtk
reader = vtk.vtkHDFReader()
reader.SetFileName(sys.argv[1])
reader.Update()
grid = reader.GetOutput()
at, data = grid.GetPointData(), grid.GetFieldData()
names = [at.GetArrayName(k) for k in range(at.GetNumberOfArrays())]
print(grid.GetNumberOfPoints(), grid.GetNumberOfCells(), *(
    at.GetArray(name).GetNumberOfComponents() if name in names else 0
    for name in ("von_mises", "strain", "principal_directions", "density")),
    "%.3g" % data.GetArray("TimeValue").GetValue(0), "scene" in data.GetAbstractArray("scene").GetName(),
    "stress [Pa]" in data.GetAbstractArray("units").GetValue(0))
END
is "VTK: a frame" "$("$vtk" "$work/look.py" "$work/run/frames/000002.hdf" 2>&1)" "400 400 1 6 9 1 4e-06 True True"
is "VTK: a frame of a region" "$("$vtk" "$work/look.py" "$work/run/frames_tip/000000.hdf" 2>&1 | cut -d' ' -f3-)" "1 6 9 1 0 True True"
is "frames of the region" "$(grep -c '"name"' "$work/run/tip.hdf.series")" 5
# Rigid bodies: the files that their series lists, opened as ParaView opens them: a hammer that falls at 5 m/s, and an anvil.
cat >"$work/fall.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 4 us
method: pd
material: {young: 190 GPa, density: 7800, energy_release_rate: 69 kJ/m^2}
bodies:
  - {name: plate, shape: {box: {from: [0, 0], to: [10 mm, 10 mm]}}}
  - {name: hammer, rigid: true, velocity: [0, -5 m/s], shape: {box: {from: [3 mm, 12 mm], to: [7 mm, 14 mm]}}}
  - {name: anvil, rigid: true, shape: {box: {from: [0, -3 mm], to: [10 mm, -1 mm]}}}
particles: {spacing: 1 mm}
output: {frames: 2}
END
"$cleave" run "$work/fall.yaml" -q -o "$work/fall" || fail "the run with rigid bodies"
cat >"$work/rigid.py" <<'END'
import json, os, sys, vtk
folder = sys.argv[1]
for file in json.load(open(folder + "/rigid.vtp.series"))["files"]:
    reader, hammer = vtk.vtkXMLPolyDataReader(), vtk.vtkThreshold()
    reader.SetFileName(os.path.join(folder, file["name"]))
    reader.Update()
    body = reader.GetOutput().GetCellData().GetArray("rigid_body")
    hammer.SetInputData(reader.GetOutput())
    hammer.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_CELLS, "rigid_body")
    hammer.SetThresholdFunction(vtk.vtkThreshold.THRESHOLD_LOWER)
    hammer.SetLowerThreshold(body.GetRange()[0])
    hammer.Update()
    print("%.3g" % file["time"], *("%.4g" % v for v in hammer.GetOutput().GetBounds()[:4]), "%g" % (body.GetRange()[1] - body.GetRange()[0]))
END
is "VTK: rigid bodies in all frames" "$("$vtk" "$work/rigid.py" "$work/fall" 2>&1)" "0 0.003 0.007 0.012 0.014 1
2e-06 0.003 0.007 0.01199 0.01399 1
4e-06 0.003 0.007 0.01198 0.01398 1"
is "files for later versions" "$(ls "$work/run" | grep -c vtkhdf)" 2
finish
