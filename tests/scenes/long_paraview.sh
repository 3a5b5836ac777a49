#!/bin/sh
# Runs the procedure of inputs/results.md in ParaView itself, and opens the XDMF index from another folder.
test_name=long_paraview
. tests/support/summary.sh
command -v pvpython >/dev/null && command -v xvfb-run >/dev/null ||
    { echo "pvpython (package paraview) or xvfb-run is missing: the recipe for ParaView is not tried"; exit 77; }

"$cleave" run inputs/plate_hole.yaml -s output.frames=3 -s 'output.fields=[von_mises]' -q -o "$work/run" || fail "the run"
timeout 200 xvfb-run -a pvpython inputs/draw_paraview.py "$work/run/frames.hdf.series" 0.0005 "$work/picture.png" >"$work/said" 2>&1
is "the recipe" $? 0
holds "a picture" test -s "$work/picture.png"

cat >"$work/index.py" <<'END'
import sys
from paraview.simple import *
frames = OpenDataFile(sys.argv[1])
UpdatePipeline(time=list(frames.TimestepValues)[-1], proxy=frames)
print(frames.GetDataInformation().GetNumberOfPoints(), len(frames.TimestepValues), "von_mises" in frames.PointData.keys())
END
for index in frames.hdf.series frames.xdmf; do
    is "$index" "$(cd "$work" && timeout 100 xvfb-run -a pvpython index.py "run/$index" 2>/dev/null)" "10284 4 True"
done
finish
