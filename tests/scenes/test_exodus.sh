#!/bin/sh
# Exodus II from the command line. The particles of a scene are exported, read back as a list, and must yield equal results; frames of a
# run become time steps, which VTK's reader must read if it is installed. Damaged files and invalid arguments must be refused in one line.
test_name=test_exodus
. tests/support/summary.sh
cd "$work" || exit 1

cat >plate.yaml <<END
space: plane stress
thickness: 2 mm
duration: 6 us
method: pd
materials: [{name: glass, young: 72 GPa, density: 2440}, {name: resin, young: 4 GPa, density: 1200, critical_stretch: 0.002}]
bodies:
  - {name: plate, material: glass, shape: {box: {from: [0, 0], to: [20 mm, 10 mm]}},
     parts: [{material: resin, region: {box: {from: [8 mm, 0], to: [12 mm, 10 mm]}}}]}
particles: {spacing: 0.5 mm}
boundary:
  - {name: grip, fixed: all, region: {box: {from: [0, 0], to: [1 mm, 10 mm]}}}
  - {name: pull, velocity: [25 m/s, free], region: {box: {from: [19 mm, 0], to: [20 mm, 10 mm]}}}
output: {frames: 3}
END
refused()
{
    wanted=$1; shift
    said=$("$cleave" "$@" 2>&1); code=$?
    [ $code -eq 2 ] && [ "$(echo "$said" | wc -l)" -eq 1 ] || fail "$*: exit $code: $said"
    case $said in *"$wanted"*) pass ;; *) fail "$*: '$said' has no '$wanted'" ;; esac
}
# column FOLDER NAME: prints the last value of a column in history.csv of a run.
column() { awk -F, -v name="$2" 'NR == 1 { for (k = 1; k <= NF; k++) { split($k, word, " "); if (word[1] == name) at = k } } END { print $at }' "$1/history.csv"; }

# Warnings name what the file lacks: rigid bodies and pre-cracks.
said=$("$cleave" export exodus plate.yaml -o less.g -s 'cracks=[{from: [15 mm, 0], to: [15 mm, 4 mm]}]' -s 'bodies=[
    {name: plate, material: glass, shape: {box: {from: [0, 0], to: [20 mm, 10 mm]}}},
    {name: ball, rigid: true, mass: 5 g, shape: {ball: {centre: [10 mm, 20 mm], radius: 6 mm}}},
    {name: stamp, rigid: true, mass: 7 g, shape: {ball: {centre: [10 mm, -20 mm], radius: 6 mm}}}]' 2>&1)
holds "what is left out: $said" test "$(echo "$said" | sed -n 2p)" = "left out: 2 rigid bodies, 1 pre-crack (Peridigm and PeriLab: Bond Filters)"

# The same particles by a list: the energies at the end agree to the digits of history.csv, although the order of particles is another.
said=$("$cleave" export exodus plate.yaml -o plate.g 2>&1) || fail "export: $said"
holds "what is exported: $said" test "$said" = "plate.g: 800 particles in 2 blocks, 2 node sets"
"$cleave" run plate.yaml -q -o shape >/dev/null 2>&1 || fail "plate.yaml does not run"
"$cleave" run plate.yaml -q -o list -s 'bodies=[{name: plate, particles: plate.g}]' >said 2>&1 || fail "the list does not run: $(cat said)"
for name in kinetic strain; do
    holds "$name energy of the list: $(column list $name), of the shape: $(column shape $name)" \
        awk -v a="$(column shape $name)" -v b="$(column list $name)" 'BEGIN { exit !(a > 0 && a - b < 1e-7 * a && b - a < 1e-7 * a) }'
done
# Node sets and blocks of the file are regions of the scene, as loads were in the one that was exported.
sed "s/region: {box: {from: \[0, 0\], to: \[1 mm.*/region: {mesh: {file: plate.g, unit: m, set: grip}}}/
    s/region: {box: {from: \[19 mm.*/region: {mesh: {file: plate.g, unit: m, set: pull}}}/" plate.yaml >sets.yaml
"$cleave" run sets.yaml -q -o sets -s 'bodies=[{name: plate, particles: plate.g}]' >said 2>&1 || fail "sets of a list: $(cat said)"
is "sets of a list are the loaded particles" "$(column sets kinetic)" "$(column list kinetic)"
refused "fill no volume; a body of them is {particles:" check plate.yaml -s 'bodies=[{name: plate, shape: {mesh: {file: plate.g, unit: m}}}]'
# A material of which no body consists keeps its number in the file, read back or from a run, and in frames.
sed 's/^materials: \[/&{name: spare, young: 1 GPa, density: 2440, critical_stretch: 0.1}, /' plate.yaml >spare.yaml
"$cleave" export exodus spare.yaml -o spare.g >said 2>&1
grep -q "800 particles in 3 blocks" said && pass || fail "a spare material: $(cat said)"
"$cleave" run spare.yaml -q -o spare -s 'bodies=[{name: plate, particles: spare.g}]' >said 2>&1 || fail "the spare list does not run: $(cat said)"
is "a spare material changes nothing" "$(column spare kinetic)" "$(column list kinetic)"
"$cleave" run spare.yaml -q -o kept >/dev/null 2>&1
"$cleave" export exodus kept -o kept.g >/dev/null 2>&1
"$cleave" run spare.yaml -q -o again -s 'bodies=[{name: plate, particles: kept.g}]' >said 2>&1 || fail "the spare run does not run: $(cat said)"
is "nor in the export of a run" "$(column again kinetic)" "$(column list kinetic)"
rm -r again
if command -v h5dump >/dev/null; then
    holds "numbers in frames" sh -c "h5dump -d /VTKHDF/PointData/material kept/frames/000003.hdf | grep -A3 DATA | grep -q '(0): 1'"
fi

# A list in mm: the echo of the scene says so and runs alike.
for x in 0.25 0.75 1.25 1.75; do for y in 0.25 0.75 1.25; do echo "$x $y 0 0.5 1"; done; done >bare.txt
{ echo "x y z volume block_id"; cat bare.txt; } >named.txt
list='bodies=[{name: plate, particles: {file: bare.txt, unit: mm, columns: [x, y, z, volume, block]}}]'
refused "or name its unit as in particles: {file: .., unit: mm}" check plate.yaml -s "bodies=[{name: plate, particles: named.txt}]"
"$cleave" run plate.yaml -q -o bare -s "$list" -s boundary= >said 2>&1 || fail "the bare list does not run: $(cat said)"
"$cleave" run bare/scene.yaml -q -o again >said 2>&1 || fail "the echo of the bare list does not run: $(cat said)"
holds "the echo gives the same run" cmp -s bare/history.csv again/history.csv

"$cleave" run plate.yaml -q -o named -s 'bodies=[{name: plate, particles: {file: named.txt, unit: mm}}]' -s boundary= >said 2>&1 ||
    fail "the named list does not run: $(cat said)"
holds "columns of the file and of the scene give the same run" cmp -s bare/history.csv named/history.csv

# Frames of the run.
"$cleave" export exodus shape -o run.exo >said 2>&1 || fail "export of a run: $(cat said)"
grep -q "800 particles in 2 blocks, 2 node sets, 1[0-9] variables at 4 times" said && pass || fail "export of a run: $(cat said)"
"$cleave" export exodus shape -o again.exo >/dev/null && cmp -s run.exo again.exo && pass || fail "two exports differ"
sees() { /usr/bin/python3 -c "import vtk" 2>/dev/null; }
if sees; then
    /usr/bin/python3 - >seen 2>&1 <<'END' || fail "VTK: $(cat seen)"
import vtk
r = vtk.vtkExodusIIReader()
r.SetFileName("run.exo"); r.UpdateInformation()
r.SetAllArrayStatus(r.NODAL, 1); r.SetAllArrayStatus(r.ELEM_BLOCK, 1); r.SetApplyDisplacements(0)
assert r.GetTimeStepRange() == (0, 3), r.GetTimeStepRange()
r.SetTimeStep(3); r.Update()
blocks = [r.GetOutput().GetBlock(0).GetBlock(k) for k in range(2)]
assert [b.GetNumberOfCells() for b in blocks] == [640, 160]
moved = max(b.GetPointData().GetArray("displacement_").GetRange(0)[1] for b in blocks)
assert abs(moved - 25 * 6e-6) < 1e-9, moved
assert blocks[1].GetCellData().GetArray("damage").GetRange()[1] <= 1
END
    pass
fi

# What is refused.
head -c 700 plate.g >cut.g
refused "cut.g: " check plate.yaml -s 'bodies=[{name: plate, particles: cut.g}]'
refused "give a name that ends in .exo, .e or .g" export exodus plate.yaml -o plate.vtk
refused "choose another -o, or replace it with --overwrite" export exodus plate.yaml -o plate.g
refused "is a run, whose scene -s cannot change" export exodus shape -o other.g -s duration=1us
refused "are for lammps" export exodus plate.yaml -o other.g --allow-different
mkdir study && touch study/sweep.csv study/study.yaml
refused "study contains a study; export one of its runs" export exodus study -o other.g
refused "study contains a study; export one of its runs" export lammps study -o other
refused "give lammps or exodus" export cubit plate.yaml -o other.g
refused "use exodus for a mesh that PeriLab reads" export perilab plate.yaml -o other.g
printf 'ITEM: TIMESTEP\n0\nITEM: ATOMS id x y\n1 0 0\n' >dump.txt
refused "this is a dump of LAMMPS: remove its lines" check plate.yaml -s 'bodies=[{name: plate, material: glass, particles: dump.txt}]'
echo 'x,y,volume' >none.csv
refused "check that the list has particles" check plate.yaml -s 'bodies=[{name: plate, material: glass, particles: none.csv}]'
refused "is not a list of columns" check plate.yaml -s 'bodies=[{name: plate, particles: {file: bare.txt, columns: x}}]'
refused "is not a unit of length" check plate.yaml -s 'bodies=[{name: plate, particles: {file: bare.txt, unit: inch}}]'

cd "$root" || exit 1
finish
