#!/bin/sh
# Static solvers in whole runs: an edge crack with both solvers, a cantilever of points, supports between nodes, bitwise equality on any
# number of threads and after kills, refusals, warnings.
test_name=test_solver
. tests/support/summary.sh
. tests/support/trust.sh
seed=4

crack="inputs/edge_crack_k1.yaml -s particles.spacing=0.2mm -s model=bond -s material.poisson=1/3"

# ---- the edge crack ------------------------------------------------------------------------------------------------

calm "$work/cg" $crack
calm "$work/relaxation" $crack -s solver=relaxation
for solver in cg relaxation; do
    is "$solver: status" "$(figure "$work/$solver" status)" done
    is "$solver: name" "$(figure "$work/$solver" solver.name)" $solver
    is "$solver: steps" "$(figure "$work/$solver" solver.steps)" "$(figure "$work/$solver" steps)"
    is "$solver: end" "$(figure "$work/$solver" time_end)" 1
    between "$solver: residual" "$(figure "$work/$solver" solver.residual)" 0 1e-5
    is "$solver: lines of history" "$(wc -l <"$work/$solver/history.csv")" 3
    is "$solver: frames" "$(ls "$work/$solver/frames" | grep -c 'hdf$')" 2
    # Linear in the load up to rotations of 1e-5 at the crack.
    between "$solver: balance" "$(figure "$work/$solver" energy.balance_error)" -2e-4 2e-4
done
between "steps of cg" "$(figure "$work/cg" solver.steps)" 100 200
between "steps of relaxation" "$(figure "$work/relaxation" solver.steps)" 500 1000
opening() { compute "$(figure "$work/$1" probes.mouth_above.displacement_y) - ($(figure "$work/$1" probes.mouth_below.displacement_y))"; }
between "opening of the mouth" "$(compute "$(opening cg) / ($(opening relaxation))")" 0.999 1.001

# ---- a cantilever of points ------------------------------------------------------------------------------------------

# Plane strain, 200 mm by 20 mm, under a weight of 100 kN/m^3: q L^4/(8 E' I) = 0.1125 mm with E' = E/(1 - nu^2), and 0.2 % more by shear.
# Measured 1.2 % below and above that. Its end moves by a twentieth of a spacing, so that points enter new cells. Four cells across.
cat >"$work/cantilever.yaml" <<'END'
space: plane strain
thickness: 10 mm
duration: 1 s
method: mpm
mpm: {transfer: apic}
solver: relaxation
material: {young: 5 GPa, poisson: 0.25, density: 1000 kg/m^3}
body: {box: {from: [0, 0], to: [200 mm, 20 mm]}}
particles: {spacing: 2.5 mm}
boundary: [{mirror: {axis: x, at: 0, tangential: held}}, {body_force: [0, -100 kN/m^3]}]
output: {frames: 1}
probes: [point: {name: end, at: [200 mm, 10 mm]}]
END
deflection=$(compute "-20 * 0.2^4 / (8 * 5e9/(1 - 0.0625) * 0.01 * 0.02^3 / 12) * 1.0023")
for shape in gimp quadratic; do
    "$cleave" run -q -o "$work/$shape" "$work/cantilever.yaml" -s mpm.shape=$shape 2>"$work/err"
    is "cantilever, $shape: $(cat "$work/err")" $? 0
    near "cantilever, $shape: deflection" "$(figure "$work/$shape" probes.end.displacement_y)" "$deflection" 0.02
    between "cantilever, $shape: balance" "$(figure "$work/$shape" energy.balance_error)" -1e-4 1e-4
done

# Initial velocities and their gradients are ignored: the same equilibrium, which is reached at once without a load.
spun="$work/stub.yaml -s solver_tolerance=1e-2"
sed 's/200 mm/60 mm/g; s/2.5 mm/10 mm/' "$work/cantilever.yaml" >"$work/stub.yaml"
spin='initial=[{velocity: [0, 100 m/s]}, {rotation: {centre: [30 mm, 10 mm], rate: 1e5 1/s}}]'
calm "$work/rested" $spun
calm "$work/spun" $spun -s "$spin"
calm "$work/idle" $spun -s "$spin" -s 'boundary=[{mirror: {axis: x, at: 0, tangential: held}}]'
is "with velocities" "$(figure "$work/spun" probes.end.displacement_y)" "$(figure "$work/rested" probes.end.displacement_y)"
is "with velocities alone" "$(figure "$work/idle" probes.end.displacement_y)" 0

# ---- supports between nodes ------------------------------------------------------------------------------------------

# One column of points whose region has no node drives the nodes next to it, half a spacing off: a bar of 20 mm whose particles at 11.5 mm
# are displaced by 10 um, on a plane of symmetry: E A u/x within 0.5/11.5, and behind it a free end that moves by 10 um (2 % more, as its
# section does not stay plane).
cat >"$work/column.yaml" <<'END'
space: plane stress
thickness: 2 mm
duration: 1 s
method: mpm
solver: static
solver_tolerance: 1e-6
material: {young: 70 GPa, density: 2700}
body: {box: {from: [0, 0], to: [20 mm, 10 mm]}}
particles: {spacing: 1 mm}
boundary:
  - {mirror: {axis: x, at: 0}}
  - {mirror: {axis: y, at: 0}}
  - {name: grip, displacement: [10 um, free], region: {box: {from: [11.1 mm, 0], to: [11.9 mm, inf]}}, time: {ramp: {until: 1 s}}}
probes: [point: {name: end, at: [19.5 mm, 5.5 mm]}, reaction: {boundary: grip}]
output: {frames: 1}
END
pull=$(compute "70e9 * 0.02e-3 * 10e-6 / 11.5e-3")
for solver in static relaxation; do
    calm "$work/column_$solver" "$work/column.yaml" -s solver=$solver
    near "a column between nodes, $solver: reaction" "$(figure "$work/column_$solver" probes.reaction.force_max)" "$pull" 0.045
    near "a column between nodes, $solver: end" "$(figure "$work/column_$solver" probes.end.displacement_x)" 1e-5 0.03
done
# The wave of a ramp of 2 us passes 8.5 mm in 1.7 us at 5.1 km/s.
calm "$work/column_explicit" "$work/column.yaml" -s solver=explicit -s duration=3us -s 'boundary.grip.time={ramp: {until: 2 us}}'
between "a column between nodes, explicit: end" "$(figure "$work/column_explicit" probes.end.displacement_x)" 4e-6 2e-5

# A beam on three supports of one row of particles; the one in the middle is between nodes. Two spans of 40.5 mm under 0.2 N/mm: it carries
# 1.25 w l of Euler's beam; its width and shear move that by a few per cent.
cat >"$work/three.yaml" <<'END'
space: plane stress
thickness: 2 mm
duration: 1 s
method: mpm
solver: static
material: {young: 70 GPa, density: 2700}
body: {box: {from: [0, 0], to: [82 mm, 8 mm]}}
particles: {spacing: 1 mm}
boundary:
  - {fixed: [x, y], region: {box: {from: [0, 0], to: [1 mm, 1 mm]}}}
  - {fixed: [y], region: {box: {from: [81 mm, 0], to: [82 mm, 1 mm]}}}
  - {name: middle, fixed: [y], region: {box: {from: [40.2 mm, 0], to: [41.8 mm, 1 mm]}}}
  - {traction: [0, -0.1 MPa], face: y+, time: {ramp: {until: 1 s}}}
probes: [reaction: {boundary: middle}]
output: {frames: 1}
END
calm "$work/three" "$work/three.yaml"
near "a beam on three supports" "$(figure "$work/three" probes.reaction.force_max)" "$(compute "1.25 * 0.2 * 40.5")" 0.03

# Nothing holds the height of a bar that only displacements pull, and no load acts along it: u = 10 um x/L.
calm "$work/free" "$work/column.yaml" -s 'boundary=[{mirror: {axis: x, at: 0}}, {name: grip, displacement: [10 um, free], face: x+, depth: 1 mm, time: {ramp: {until: 1 s}}}]'
near "a bar that is free across" "$(figure "$work/free" probes.end.displacement_x)" 9.75e-6 1e-4

# ---- bitwise equality ------------------------------------------------------------------------------------------------

plate="$crack -s output.checkpoint=0.02"
coupled="$plate -s method=adaptive -s solver=relaxation"
for scene in "$plate" "$plate -s solver=relaxation" "$coupled"; do
    rm -rf "$work/one" "$work/three"
    calm "$work/one" -t 1 $scene
    calm "$work/three" -t 3 $scene
    same "threads: $scene" "$work/one" "$work/three"
    kills 2 "$work/one" $scene
done

# ---- refused, and failed ---------------------------------------------------------------------------------------------

"$cleave" run -q -o "$work/short" $crack -s solver_steps=20 2>"$work/err"
is "too few steps: exit status" $? 1
holds "too few steps: message" grep -q 'no equilibrium after 20 steps.*raise solver_steps' "$work/err"
is "too few steps: status" "$(figure "$work/short" status)" failed

# The edge of a plate of 20 mm, 100 m from the origin: 5300 times the distance of 19 mm between its outermost particles.
cat >"$work/far.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 1 s
method: pd
solver: cg
solver_tolerance: 1e-7
material: {young: 70 GPa, density: 2700}
body: {box: {from: [100 m, 0], to: [100.02 m, 20 mm]}}
particles: {spacing: 1 mm}
boundary: [{fixed: all, face: y-}, {traction: [0, 1 MPa], face: y+}]
END
"$cleave" run -q -o "$work/far" "$work/far.yaml" 2>"$work/err"
is "far from the origin: exit status" $? 1
holds "far from the origin: $(cat "$work/err")" grep -q 'the body is 100 m from the origin, 5.3e+03 times its size, .*: move the body to the origin$' "$work/err"
refused()
{
    what=$1 text=$2; shift 2
    "$cleave" run -q -o "$work/refused" "$@" 2>"$work/err"
    is "$what: exit status" $? 2
    holds "$what: message: $(cat "$work/err")" grep -q "$text" "$work/err"
    is "$what: lines" "$(wc -l <"$work/err")" 1
}
# Faces of a crack pass through each other where it is pressed shut, not where it opens (calm above).
warned "a crack that closes" "$work/closes" 'faces of a crack close at (.*, .*) m, by .* of the distance of their particles, .* use solver: static' $crack -s probes= \
    -s boundary.0.traction=[0,-1MPa] -s boundary.1.traction=[0,1MPa]
refused "cg on a grid" 'edge_crack_k1.yaml:.*cg works with method: pd only' $crack -s method=adaptive
refused "flip" 'mpm.transfer: apic' $crack -s method=mpm -s solver=relaxation -s mpm.transfer=flip
refused "yields" 'edge_crack_k1.yaml:.*steel yields; set solver: static (load steps), or explicit' $crack -s material.yield_stress=1GPa
calm "$work/quiet" $crack -s material.critical_stretch=1e-5
holds "bonds past their limit" [ "$(figure "$work/quiet" solver.bonds_past_limit)" -gt 0 ]
# ---- what the results do not show ------------------------------------------------------------------------------------------

# A cantilever of 80 by 8 mm whose end rotates by two degrees, a tenth of that by a tenth of the load: by a^2/2 = 6e-4 the bonds on the
# neutral axis are too long, an eighth of the largest stretch.
cat >"$work/turned.yaml" <<'END'
space: plane stress
thickness: 2 mm
duration: 1 s
method: pd
solver: cg
material: {young: 70 GPa, density: 2700}
body: {box: {from: [0, 0], to: [80 mm, 8 mm]}}
particles: {spacing: 1 mm}
boundary:
  - {name: w, fixed: all, face: x-, depth: 1 mm}
  - {name: t, traction: [0, 4 MPa], face: x+, time: {ramp: {until: 1 s}}}
output: {frames: 0}
END
warned "rotations" "$work/turned" 'rotate by up to 2 degrees, .* by up to 1[0-9] %' "$work/turned.yaml"
calm "$work/turned_less" "$work/turned.yaml" -s 'boundary.1.traction=[0, 0.4 MPa]'

# Of two supports of the same nodes the later one holds in load steps, and the run says so.
cat >"$work/twice.yaml" <<'END'
space: plane stress
thickness: 2 mm
duration: 1 s
method: mpm
solver: static
material: {young: 70 GPa, density: 2700}
body: {box: {from: [0, 0], to: [20 mm, 10 mm]}}
particles: {spacing: 1 mm}
boundary: [{mirror: {axis: x, at: 0}}, {mirror: {axis: y, at: 0}}]
probes: [point: {name: end, at: [19.5 mm, 9.5 mm]}]
output: {frames: 0}
END
pulled='{name: a, displacement: [10 um, free], face: x+, depth: 1 mm}' held='{name: b, fixed: [x], region: {box: {from: [19 mm, 0], to: [20 mm, 10 mm]}}}'
mirrors='{mirror: {axis: x, at: 0}}, {mirror: {axis: y, at: 0}}'
for method in mpm pd; do
    warned "held last, $method" "$work/held_$method" 'prescribe different motions along x' "$work/twice.yaml" -s method=$method -s "boundary=[$mirrors, $pulled, $held]"
    apart "held last, $method: rest" "$(figure "$work/held_$method" probes.end.displacement_x)" 0 1e-12
    warned "pulled last, $method" "$work/pulled_$method" 'prescribe different motions along x' "$work/twice.yaml" -s method=$method -s "boundary=[$mirrors, $held, $pulled]"
    near "pulled last, $method" "$(figure "$work/pulled_$method" probes.end.displacement_x)" 1e-5 0.05
done

finish
