#!/bin/sh
# Voids narrower than a bond or a cell, by a slot in a shape or duplicate nodes of a mesh. They must be equivalent to pre-cracks at the
# same position in every method and frame, with a mirror, and in 3D; their faces have contact; a run reports faces that stay closed.
test_name=test_voids
. tests/support/summary.sh
. tests/support/scenes.sh

# scene NAME SLOT [LINES]: writes the scene NAME.yaml of a glass strip under tension with a notch 8 mm deep, to which SLOT (keys of
# solids) and LINES are added.
scene()
{
    cat >"$work/$1.yaml" <<END
space: plane stress
thickness: 0.7 mm
duration: 14 us
method: pd
material: {young: 72 GPa, poisson: 1/3, density: 2440 kg/m^3, energy_release_rate: 135 J/m^2}
body:
  - box: {from: [0, -6 mm], to: [20 mm, 6 mm]}
$2
particles: {spacing: 0.5 mm}
boundary:
  - {traction: [0, 12 MPa], face: y+, region: {box: {from: [-inf, 5 mm], to: [inf, inf]}}}
  - {traction: [0, -12 MPa], face: y-, region: {box: {from: [-inf, -inf], to: [inf, -5 mm]}}}
output: {frames: 0, samples: 10}
${3:-}
END
}
slot() { echo "  - subtract: {box: {from: [-1 mm, -$1 mm], to: [8 mm, $1 mm]}}"; }
scene crack '' 'cracks: [{from: [-1 mm, 0], to: [8 mm, 0]}]'
scene thin "$(slot 0.05)"
scene narrow "$(slot 0.5)"
scene wide "$(slot 1)"

# A slot a fifth of a spacing wide cuts the same bonds as a crack in its middle: equal start to the last digit. Then the crack branches, at
# a position that faces which close later change by a spacing or two.
start crack "$work/crack.yaml"
start thin "$work/thin.yaml"
start narrow "$work/narrow.yaml" -s method=adaptive
start wide "$work/wide.yaml" -s method=adaptive
wait
is "thin slot: first break" "$(f thin crack.start_time)" "$(f crack crack.start_time)"
differ() { awk -v a="$(f $1 $3)" -v b="$(f $2 $3)" 'BEGIN { print a - b }'; }
between "thin slot: length" "$(differ thin crack crack.length_end)" -1e-3 1e-3
# In a grid with cells of two spacings a slot of two would be closed: nothing would break. Compared with a slot of four its arms are wider
# by a spacing: 5 % of the start at 5 us. Lengths differ by at most three rows of crack.
between "narrow slot beside a wide one: start" "$(differ narrow wide crack.start_time)" -2.5e-7 2.5e-7
between "narrow slot beside a wide one: length" "$(differ narrow wide crack.length_end)" -1.5e-3 1.5e-3

# Cells of the reference frame, points of the current one, half of the strip: opened by equal loads, in equilibrium.
end='boundary: [{fixed: all, face: x+, depth: 0.5 mm}, {traction: [0, 1 MPa], face: y+}, {traction: [0, -1 MPa], face: y-}]
probes: [{point: {name: lip, at: [0.25 mm, 1.75 mm]}}]'
for name in thin narrow wide; do
    sed '/^boundary/,$d; s/^method.*/method: mpm/; s/, energy_release_rate[^}]*//' "$work/$name.yaml" >"$work/$name.end.yaml"
    printf 'output: {frames: 0}\nsolver: static\n%s\n' "$end" >>"$work/$name.end.yaml"
    start "$name.end" "$work/$name.end.yaml"
done
wait
lip() { awk -F, 'NR == 1 { for (k = 1; k <= NF; k++) if ($k ~ /^lip.displacement_y/) at = k } END { print $at }' "$work/$1/history.csv"; }
# Arms of 5.5 and 5.95 mm bend less than one of 5 mm: as beams of these heights on an elastic foundation, by (5/5.5)^3 and (5/5.95)^3, up to
# shear and foundation, which scale with the first power.
between "mpm: narrow slot opens" "$(awk -v a="$(lip narrow.end)" -v b="$(lip wide.end)" 'BEGIN { print a / b }')" 0.75 0.91
between "mpm: thin slot opens" "$(awk -v a="$(lip thin.end)" -v b="$(lip wide.end)" 'BEGIN { print a / b }')" 0.59 0.84

# ---- doubled nodes of a mesh -----------------------------------------------------------------------------------------------

cat >"$work/slit.msh" <<'END'
$MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
11
1 0 0 0
2 7 0 0
3 15 0 0
4 0 5 0
5 7 5 0
6 15 5 0
7 0 5 0
8 0 11 0
9 7 11 0
10 15 11 0
11 7 11 0
$EndNodes
$Elements
4
1 3 2 1 1 1 2 5 4
2 3 2 1 1 7 5 9 8
3 3 2 1 1 2 3 6 5
4 3 2 1 1 5 6 10 9
$EndElements
END
box='space: plane strain
thickness: 1.3 mm
duration: 3 us
material: {young: 70 GPa, density: 2700, energy_release_rate: 20 J/m^2}
particles: {spacing: 0.5 mm}
boundary: [{traction: [0, 9 MPa], face: y+}, {traction: [0, -9 MPa], face: y-}]
output: {frames: 0, samples: 6}'
{ echo "$box"; echo 'body: {mesh: {file: slit.msh, unit: mm}}'; } >"$work/mesh.yaml"
{ echo "$box"; echo 'body: {box: {from: [0, 0], to: [15 mm, 11 mm]}}
cracks: [{from: [0, 5 mm], to: [7 mm, 5 mm]}]'; } >"$work/box.yaml"
for method in pd adaptive; do
    start mesh "$work/mesh.yaml" -s method=$method --overwrite
    start box "$work/box.yaml" -s method=$method --overwrite
    wait
    for figure in crack.start_time crack.length_end; do is "$method: slit of a mesh: $figure" "$(f mesh $figure)" "$(f box $figure)"; done
done
"$cleave" check "$work/mesh.yaml" >"$work/said" 2>&1
is "the slit is said" "$(grep -c 'pairs of nodes at one position along 1 surface inside the body: a pre-crack' "$work/said")" 1

# ---- contact of faces, and slots that stay closed --------------------------------------------------------------------------

# A slot in the middle of a block under compression: without contact its faces would overlap by 5 spacings.
cat >"$work/press.yaml" <<'END'
space: plane stress
thickness: 2 mm
duration: 40 us
material: {young: 72 GPa, poisson: 1/3, density: 2440, energy_release_rate: 1e9 J/m^2}
body:
  - box: {from: [0, -10 mm], to: [13 mm, 10 mm]}
  - subtract: {box: {from: [3 mm, -0.1 mm], to: [10 mm, 0.1 mm]}}
particles: {spacing: 0.5 mm}
boundary:
  - {traction: [0, -5 GPa], face: y+, time: {ramp: {until: 15 us}}}
  - {traction: [0, 5 GPa], face: y-, time: {ramp: {until: 15 us}}}
output: {frames: 0, samples: 40}
probes: [{point: {name: up, at: [6.25 mm, 0.25 mm]}}, {point: {name: low, at: [6.25 mm, -0.25 mm]}}]
END
for method in pd adaptive; do start "press.$method" "$work/press.yaml" -s method=$method; done
start press.none "$work/press.yaml" -s method=pd -s contact.between=none
wait
nearest()
{
    awk -F, 'NR == 1 { for (k = 1; k <= NF; k++) { if ($k ~ /^up.displacement_y/) a = k; if ($k ~ /^low.displacement_y/) b = k } next }
        { d = 5e-4 + $a - $b; if (NR == 2 || d < least) least = d } END { print least }' "$work/$1/history.csv"
}
for method in pd adaptive; do between "$method: faces stay apart" "$(nearest press.$method)" 1e-4 5e-4; done
between "without contact they do not" "$(nearest press.none)" -1e-2 0

says() { "$cleave" check "$@" >"$work/said" 2>&1; grep -c 'has a void' "$work/said"; }
is "points of the current frame share nodes" "$(says "$work/narrow.yaml" -s method=mpm -s mpm.frame=current)" 1
is "nothing is said of what is cut" "$(says "$work/narrow.yaml" -s method=mpm)" 0
awk 'BEGIN { print "x,y"; for (j = 0; j < 12; j++) for (i = 0; i < 20; i++) if (i != 9 || j > 5) print (i + 0.5) / 1e3 "," (j + 0.5) / 1e3 }' \
    >"$work/list.csv"
printf 'space: plane stress\nthickness: 1 mm\nduration: 1 us\nmethod: pd\nmaterial: {young: 72 GPa, density: 2440}
bodies: [{name: a, particles: list.csv}]\nparticles: {spacing: 1 mm}\n' >"$work/list.yaml"
is "nor can a list say what is between particles" "$(says "$work/list.yaml")" 1

finish
