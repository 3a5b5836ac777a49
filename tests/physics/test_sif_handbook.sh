#!/bin/sh
# Stress-intensity factors of cracks that are not in inputs/, compared with handbooks and boundary collocation: 100 particles across, mospd
# with families of eight and their own constants, as in inclined_crack.yaml.
test_name=test_sif_handbook
. tests/support/summary.sh
. tests/support/scenes.sh

# plate FILE WIDTH HEIGHT STRESS POISSON SPACE: writes a plate with STRESS xx yy xy [MPa] on its four edges [mm]; cracks and probes follow
# on standard input.
plate()
{
    set -- "$1" "$2" "$3" "$4" "$5" "$6" $4
    cat >"$work/$1.yaml" <<END
space: $6
thickness: 1 mm
duration: 1 s
method: pd
model: mospd
pd: {normalisation: local}
solver: cg
material: {young: 70 GPa, poisson: $5, density: 2700 kg/m^3}
body: {box: {from: [0, 0], to: [$2 mm, $3 mm]}}
particles: {spacing: 0.1 mm, horizon: 1.5}
boundary:
  - {traction: [$7 MPa, $9 MPa], face: x+}
  - {traction: [$(compute "-($7)") MPa, $(compute "-($9)") MPa], face: x-}
  - {traction: [$9 MPa, $8 MPa], face: y+}
  - {traction: [$(compute "-($9)") MPa, $(compute "-($8)") MPa], face: y-}
output: {frames: 0}
$(cat)
END
}
plate centre 10 20 "0 1 0" 0.45 "plane strain" <<'END'
cracks: [{from: [3 mm, 10 mm], to: [7 mm, 10 mm]}]
probes: [sif: {at: [3 mm, 10 mm], outer: 1.5 mm}]
END
# Its left half, and a mirror.
sed -i 's/to: \[10 mm, 20 mm\]/to: [5 mm, 20 mm]/; s/^  - {.*face: x+}/  - {mirror: {axis: x, at: 5 mm, tangential: free}}/; s/^  - {.*face: x-}//' "$work/centre.yaml"
plate square 10 10 "1 0 0" 0.1 "plane stress" <<'END'
cracks: [{from: [5 mm, 2.5 mm], to: [5 mm, 7.5 mm]}]
probes: [sif: {at: [5 mm, 7.5 mm], outer: 1.5 mm}]
END
plate edge 10 20 "0 1 0" 0.3 "plane stress" <<'END'
cracks: [{from: [11 mm, 10 mm], to: [7 mm, 10 mm]}]
probes: [sif: {outer: 2 mm}]
END
plate shear 10 10 "0 0 1" 0.3 "plane stress" <<'END'
cracks: [{from: [3 mm, 5 mm], to: [7 mm, 5 mm]}]
probes: [sif: {at: [7 mm, 5 mm], outer: 1.5 mm}, sif: {name: other, at: [3 mm, 5 mm], outer: 1.5 mm}]
END
plate whole 10 10 "0 0 1" 0.3 "plane stress" <<'END'
probes: [point: {at: [3.1 mm, 6.1 mm]}]
END
sed -e 's/horizon: 1.5/horizon: 3.015, irregularity: 0.6/' -e '/^pd:/d' "$work/square.yaml" >"$work/shaken.yaml"
start edge "$work/edge.yaml"; start square "$work/square.yaml"; wait
start centre "$work/centre.yaml"; start shear "$work/shear.yaml"; wait
start whole "$work/whole.yaml" -s particles.spacing=0.2mm; start shaken "$work/shaken.yaml"; wait

# off RUN PROBE MODE F A: prints the relative error of a stress-intensity factor. Exact: F sigma sqrt(pi A) with sigma = 1 MPa and A in mm.
off() { compute "$(f "$1" "probes.$2.K_$3") / (($4) * 1e6 * sqrt(3.14159265358979e-3 * ($5))) - 1"; }

# Tada's correction of the secant formula: (1 - 0.025 w^2 + 0.06 w^4) sqrt(sec(pi w/2)), w = 2a/W = 0.4 (0.1 %); by collocation, H = 2 W:
# 1.110.
between "centre: K_I" "$(off centre sif I 1.110 2)" -0.01 0.01
# A square plate, whose height matters: 1.334 (Isida 1971), by collocation 1.3337; the secant formula has 1.186.
between "square: K_I" "$(off square sif I 1.334 2.5)" -0.01 0.01
# Tada's tangent formula, w = 0.3: 1.655 (0.5 %); collocation, H = 2 W: 1.659.
between "edge: K_I" "$(off edge sif I 1.659 3)" -0.01 0.01
# By collocation; an infinite plate has 1.
for probe in sif other; do between "shear: $probe" "$(off shear $probe II 1.130 2)" -0.01 0.01; done
# A plate without crack has the stress of its edges: exactly if tractions act on the edges, 2.6 % more if they act on the outermost of 50
# particles.
between "uniform shear" "$(compute "$(f whole probes.point.stress_xy) / 1e6")" 0.999 1.001
# Irregular families: 1.4 % measured.
between "shaken: K_I" "$(off shaken sif I 1.334 2.5)" -0.03 0.03
finish
