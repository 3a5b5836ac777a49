#!/bin/sh
# Contact and rigid bodies in load steps: a beam on rollers compared with ASTM E399, a disc between jaws, a crack under compression compared
# with closed forms and with one without contact, bodies on bodies; bitwise equality on any number of threads and after stops.
test_name=test_steps_contact
. tests/support/summary.sh
. tests/support/scenes.sh
. tests/support/trust.sh
seed=7
export OMP_WAIT_POLICY=passive

pmma='material: {name: PMMA, young: 3 GPa, poisson: 1/3, density: 1180 kg/m^3, energy_release_rate: 300 J/m^2}'
head='space: plane stress
thickness: 10 mm
duration: 1 s
method: pd
solver: static'

# A beam of span 160 mm and height 40 mm on two rigid blocks, loaded by a third; a/W = 0.4.
cat >"$work/bend.yaml" <<END
$head
variables: {h: 2 mm}
steps: {number: 16, control: energy}
$pmma
bodies:
  - {name: beam, shape: {box: {from: [-90 mm, 0], to: [90 mm, 40 mm]}}}
  - {name: left, rigid: true, shape: {box: {from: [-80 mm - h, -5 mm], to: [-80 mm + h, 0]}}}
  - {name: right, rigid: true, shape: {box: {from: [80 mm - h, -5 mm], to: [80 mm + h, 0]}}}
  - {name: roller, rigid: true, velocity: [0, -1 mm/s], shape: {box: {from: [-h, 40 mm], to: [h, 45 mm]}}}
particles: {spacing: h}
cracks: [{from: [0, -1 mm], to: [0, 16 mm]}]
boundary: [{name: middle, fixed: [x], region: {box: {from: [-h, 38 mm], to: [h, 40 mm]}}}]
END
sed 's/^variables: .*/variables: {h: 1 mm}/; s/box: {from: \[\([0-9-]*\) mm - h, -5 mm\], to: [^}]*/disc: {centre: [\1 mm, -5 mm], radius: 5 mm/' "$work/bend.yaml" |
    sed 's/box: {from: \[-h, 40 mm\], to: \[h, 45 mm\]}/disc: {centre: [0, 45 mm], radius: 5 mm}/' >"$work/rollers.yaml"

# An unbreakable disc between jaws of 1.5 times its radius: 2 P/(pi D t) across its middle.
cat >"$work/disc.yaml" <<END
$head
steps: {number: 4}
material: {name: rock, young: 50 GPa, poisson: 1/3, density: 2600 kg/m^3}
bodies:
  - {name: disc, shape: {disc: {centre: [0, 0], radius: 25 mm}}}
  - {name: upper, rigid: true, velocity: [0, -50 um/s],
     shape: [{box: {from: [-16 mm, 18 mm], to: [16 mm, 35 mm]}}, {subtract: {disc: {centre: [0, -12.5 mm], radius: 37.5 mm}}}]}
  - {name: lower, rigid: true, velocity: [0, 50 um/s],
     shape: [{box: {from: [-16 mm, -35 mm], to: [16 mm, -18 mm]}}, {subtract: {disc: {centre: [0, 12.5 mm], radius: 37.5 mm}}}]}
particles: {spacing: 1 mm}
probes: [{point: {name: centre, at: [0, 0]}}]
END

# A crack of 2 a = 40 mm at 45 degrees in a plate of 160 mm under compression.
cat >"$work/shut.yaml" <<END
$head
steps: {number: 1}
material: {young: 3 GPa, poisson: 1/3, density: 1180 kg/m^3, energy_release_rate: 1e9 J/m^2}
body: {box: {from: [-80 mm, -80 mm], to: [80 mm, 80 mm]}}
particles: {spacing: 1 mm}
cracks: [{from: [-14.142 mm, -14.142 mm], to: [14.142 mm, 14.142 mm]}]
boundary:
  - {name: top, traction: [0, -1 MPa], face: y+, time: {ramp: {until: 1 s}}}
  - {name: bottom, traction: [0, 1 MPa], face: y-, time: {ramp: {until: 1 s}}}
END

# A block on a block under a traction, without other supports.
cat >"$work/stack.yaml" <<END
$head
steps: {number: 3}
material: {young: 3 GPa, poisson: 1/3, density: 1180 kg/m^3}
bodies:
  - {name: low, shape: {box: {from: [0, 0], to: [20 mm, 10 mm]}}}
  - {name: high, shape: {box: {from: [2 mm, 10 mm], to: [18 mm, 20 mm]}}}
particles: {spacing: 1 mm}
boundary:
  - {name: base, fixed: [x, y], region: {box: {from: [-inf, 0], to: [inf, 1 mm]}}}
  - {name: top, body: high, traction: [0, -1 MPa], face: y+, time: {ramp: {until: 1 s}}}
probes: [{reaction: {boundary: base}}]
END

start bend "$work/bend.yaml" -s steps.number=8
start disc "$work/disc.yaml"
start stack "$work/stack.yaml"
start shut "$work/shut.yaml"
wait
start open "$work/shut.yaml" -s contact.between=none
start rollers "$work/rollers.yaml" -s steps.number=8
wait

# most FOLDER COLUMN: prints the largest magnitude of a column of history.csv.
most()
{
    awk -F, -v name="$2" 'NR == 1 { for (k = 1; k <= NF; k++) { sub(/ .*/, "", $k); if ($k == name) at = k } next }
        { v = $at < 0 ? -$at : $at; if (v > most) most = v } END { print most }' "$work/$1/history.csv"
}

# E399: P = K_c B W^1.5/(S f(0.4)) with f(0.4) = 1.9776 (9.8884/5 of the formula with 3 S/W): 239.35 N. The supported beam is 2.7 % lower
# with 20 spacings across, 1.0 % with 40; round rollers penetrate by clearances and are 2.5 % higher with 40.
between "bend: largest load" "$(most bend roller_force_y)" 231 236
between "rollers: largest load" "$(most rollers roller_force_y)" 237 247
for run in bend rollers; do
    between "$run: released over the new area, of 300 J/m^2" "$(f $run load_steps.release_rate)" 291 309
    near "$run: what presses is what carries" "$(last $run roller_force_y)" "$(compute "-($(last $run left_force_y)) - ($(last $run right_force_y))")" 1e-4
done

# 0.2 % with 50 spacings across; both jaws have equal forces. The mean of both ends of a step is 0.4 % more than the work of such a force.
force=$(last disc upper_force_y)
near "disc: stress across the middle" "$(last disc centre.stress_xx)" "$(compute "2 * $force/(3.14159265 * 0.05 * 0.01)")" 1e-2
near "disc: jaws" "$(last disc lower_force_y)" "-$force" 1e-4
between "disc: nothing is lost but that" "$(compute "$(last disc damped)/$(last disc external_work)")" -1e-3 5e-2

# K_II = tau sqrt(pi a) = 0.1253 MPa m^(1/2) in an infinite plate; here it is 10 % larger: sides at 4 lengths add 3 %, the ends of cut bonds
# 0.4 spacings of length, 2 %, and the fit is 4 % too large, as for the open crack (1.49). Contact prevents the mode I half of the crack's
# energy: sigma^2 pi a^2 t/(4 E) = 1.05 mJ.
between "shut: K_II" "$(compute "-($(last shut K_II))")" 1.25e5 1.42e5
is "shut: K_I" "$(last shut K_I)" 0
between "open: K_I" "$(last open K_I)" -1.5e5 -1.2e5
stored() { compute "$(last "$1" strain) + $(last "$1" contact)"; }
between "shut: its energy" "$(compute "$(stored open) - $(stored shut)")" 0.99e-3 1.2e-3

# 16 MPa mm times 10 mm.
near "stack: what carries it" "$(last stack reaction.force_y)" 160 1e-4
between "stack: nothing is lost" "$(compute "$(last stack damped)/$(last stack external_work)")" -1e-5 1e-5

# Supports that first stay in place: the contact force equals the support force from the first step in which they move.
calm "$work/late" "$work/stack.yaml" -s boundary.1='{name: top, body: high, traction: [0, -1 MPa], face: y+, time: {table: [[0 s, 0], [0.5 s, 0], [1 s, 1]]}}'
near "late: what carries" "$(column "$work/late" reaction.force_y 0.67)" "$(compute 160/3)" 1e-4

calm "$work/two" "$work/bend.yaml" -s steps.number=8 -t 2
same "threads" "$work/bend" "$work/two"
piecewise "$work/pieces" "$work/bend.yaml" -s steps.number=8
same "stopped after every load step" "$work/bend" "$work/pieces"
kills 2 "$work/bend" "$work/bend.yaml" -s steps.number=8
calm "$work/let_go" "$work/bend.yaml" -s 'steps={number: 6, then: explicit}' -t 1
near "let go: the same peak" "$(figure "$work/let_go" rigid.2.force_max)" "$(most bend roller_force_y)" 2e-2
between "let go: balance" "$(figure "$work/let_go" energy.balance_error)" -1e-3 1e-3
refused "a body that moves freely" "$work/no" 'has a mass and moves freely' "$work/bend.yaml" -s bodies.3.mass=1kg

# Flat blocks that touch from the start: points beside them convert before the first step, whose work is half of force times displacement.
# The third block comes from 1 mm above. Without a support along x a beam whose blocks end at columns of particles slides, and a warning says so.
small='steps={number: 2}'
start blocks "$work/bend.yaml" -s method=adaptive -s cracks=[] -s "$small" -s bodies.3.velocity='[0, -0.1 mm/s]' -t 1
start above "$work/bend.yaml" -s cracks=[] -s "$small" -s bodies.3.shape='{box: {from: [-h, 41 mm], to: [h, 45 mm]}}' -s bodies.3.velocity='[0, -1.2 mm/s]' -t 1
sed 's/80 mm - h/80 mm - h\/2/; s/80 mm + h/80 mm + h\/2/' "$work/bend.yaml" >"$work/edges.yaml"
start slides "$work/edges.yaml" -s cracks=[] -s steps.number=4 -s steps.control=load -s bodies.3.velocity='[0, -0.1 mm/s]' -s boundary=[] -t 1
wait
work_of_block() { compute "0.5 * 0.05e-3 * $(column "$work/blocks" roller_force_y 0.5)"; }
near "blocks: work of the first step" "$(column "$work/blocks" external_work 0.5)" "$(work_of_block)" 1e-3
between "blocks: nothing is lost" "$(compute "$(last blocks damped)/$(last blocks external_work)")" -1e-3 1e-3
between "above: carries" "$(last above roller_force_y)" 20 400
says() { grep -c 'where only contact holds it' "$work/$1/summary.json"; }
is "slides: said" "$(says slides)" 1
is "blocks: nothing of that" "$(says blocks)" 0

# ---- contact of the faces of a slender body ------------------------------------------------------------------------------

# A beam of 8 layers with a slit in its middle plane along half of its length, on two supports, loaded in the middle: its faces press and
# slide (mode II). The stored energy is half of force times displacement up to rotations, 1e-3, for one or many load steps; relative to the
# intact beam the load is 2 L^3/(2 L^3 + 3 a^3) = 0.56, with beams of 4 layers that are 10 % too stiff.
cat >"$work/slit.yaml" <<'END'
variables: {h: 0.129 mm}
space: plane stress
thickness: 0.7 mm
duration: 1 s
method: pd
solver: static
steps: {number: 1, control: load}
material: {young: 71.7 GPa, density: 2700, energy_release_rate: 10 kJ/m^2}
body: {box: {from: [0, 0], to: [15.03 mm, 1.032 mm]}}
particles: {spacing: h}
cracks: [{from: [-1 mm, 0.516 mm], to: [6.06 mm, 0.516 mm]}]
boundary:
  - {name: left, fixed: [y], region: {box: {from: [0.06 mm - 1.01*h, -inf], to: [0.06 mm + 1.01*h, h]}}}
  - {name: right, fixed: [y], region: {box: {from: [14.97 mm - 1.01*h, -inf], to: [14.97 mm + 1.01*h, h]}}}
  - {name: top, displacement: [free, -0.02 mm], region: {box: {from: [7.5 mm - 1.01*h, 1.032 mm - h], to: [7.5 mm + 1.01*h, inf]}}, time: {ramp: {until: 1 s}}}
  - {name: mid, fixed: [x], region: {box: {from: [7.5 mm - 1.01*h, 1.032 mm - h], to: [7.5 mm + 1.01*h, inf]}}}
output: {frames: 0}
probes: [{reaction: {boundary: top}}]
END
for n in 1 4; do start "slit$n" "$work/slit.yaml" -s steps.number=$n; done
start whole "$work/slit.yaml" -s cracks=[]
wait
for n in 1 4; do
    stored=$(compute "$(last slit$n strain) + $(last slit$n contact)")
    between "slit beam, $n steps: energy" "$(compute "$stored/(0.5 * 20e-6 * $(f slit$n probes.reaction.force_max))")" 0.998 1.002
    between "slit beam, $n steps: balance" "$(f slit$n energy.balance_error)" -1e-6 1e-6
    between "slit beam, $n steps: load" "$(compute "$(f slit$n probes.reaction.force_max)/$(f whole probes.reaction.force_max)")" 0.50 0.62
done
near "slit beam: whatever the steps" "$(f slit1 probes.reaction.force_max)" "$(f slit4 probes.reaction.force_max)" 1e-4

# ---- a beam on rollers that first leave a gap ----------------------------------------------------------------------------

# Three-point bending of an uncracked beam of 160 x 20 x 10 mm by rollers of 5 mm. Columns of particles stand beside the lowest point of a
# roller, at 1 mm: rollers touch 0.084 mm late, at 158 mm from each other, and press at atan(1/6) to the vertical. With the thrust of P/12
# along the lower face the deflection is L^3/(48 EI) + L/(4 k G A) - (10 mm/12) L^2/(8 EI) = 4.189e-3 mm/N (k = 5/6). The lattice is 1 %
# too stiff in bending, and material points give way below the rollers by 4 %.
cat >"$work/gap.yaml" <<END
$head
variables: {h: 2 mm, r: 5 mm}
steps: {number: 10}
material: {young: 3 GPa, poisson: 1/3, density: 1180 kg/m^3}
bodies:
  - {name: beam, shape: {box: {from: [-90 mm, 0], to: [90 mm, 20 mm]}}}
  - {name: left, rigid: true, shape: {disc: {centre: [-80 mm, -r], radius: r}}}
  - {name: right, rigid: true, shape: {disc: {centre: [80 mm, -r], radius: r}}}
  - {name: roller, rigid: true, velocity: [0, -1.25 mm/s], shape: {disc: {centre: [0, 20 mm + r], radius: r}}}
particles: {spacing: h}
boundary: [{name: middle, fixed: [x], region: {box: {from: [-h, 18 mm], to: [h, 20 mm]}}}]
output: {frames: 0}
END
start gap "$work/gap.yaml"
start gap_points "$work/gap.yaml" -s method=adaptive
start gap_breaks "$work/gap.yaml" -s material.energy_release_rate=300
wait
for run in gap gap_points; do
    first=$(column "$work/$run" roller_force_y 0.3) second=$(column "$work/$run" roller_force_y 0.5)
    near "$run: stiffness" "$(compute "($second - ($first))/0.25")" 238.7 5e-2
done

# The beam breaks at a stress of its lower face, (L/4 - 10 mm/12) P/W, near the strength of its bonds, 14.4 MPa: a first crack is looked for
# from 0.85 times that on, steps are 0.1 of that apart, and bonds near faces make the beam 13 % too stiff.
stress=$(compute "$(f gap_breaks rigid.2.force_max) * (158/4 - 10/12)/666.7")
between "beam without a crack: stress at the largest load" "$stress" 12.3 16.4
between "beam without a crack: load after that" "$(compute "$(last gap_breaks roller_force_y)/$(f gap_breaks rigid.2.force_max)")" -1e-3 0.1

finish
