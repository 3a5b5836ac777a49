#!/bin/sh
# Load steps of bodies whose bonds soften: loads of notched strips against a separate program, snap-back, energy balance, bitwise equality
# on any number of threads and after a checkpoint, prescribed loads, a crack that closes, a solid, refusals.
# Takes 30 s: a crack grows, closes and is pressed in 80 load steps, four times.
test_name=test_softening_steps
. tests/support/summary.sh
. tests/support/scenes.sh
. tests/support/trust.sh

cp inputs/strength_notch.yaml "$work/notch.yaml"
coarse='-s particles.spacing=0.2mm -s steps.number=8'
start one "$work/notch.yaml" $coarse
{ "$cleave" run "$work/notch.yaml" -o "$work/two" -t 2 -q $coarse 2>"$work/two.err" || fail "two: $(cat "$work/two.err")"; } &
wait
start fine "$work/notch.yaml" -s steps.number=9
start longer "$work/notch.yaml" -s steps.number=9 -s variables.notch=1.5mm; wait

# The largest traction against that of a separate program of the same law (inputs/strength_notch.yaml), within 5 %: the loads of states
# 0.015 mm of crack apart, another surface layer. The coarse lattice, at kappa 1.1, traps the crack: 4 % more below.
load() { awk -F, 'NR == 1 { for (k = 1; k <= NF; k++) if ($k ~ /^load_time/) at = k } $at + 0 > most { most = $at } END { print 40 * most }' "$work/$1/history.csv"; }
between "notch of 1 mm: load" "$(load fine)" 9.36 10.34
between "notch of 1.5 mm: load" "$(load longer)" 6.37 7.04
between "coarse lattice: load" "$(load one)" 8.96 10.8

# Behind the peak loads fall, grips come back, and the balance stays closed: the work over a step is that of the forces at both its ends.
between "snap-back" "$(compute "$(last longer load_time) * 40 / $(load longer)")" 0.9 0.97
for run in fine longer; do between "$run: energy" "$(figure "$work/$run" energy.balance_error)" -2e-3 2e-3; done
between "dissipated energy: a thousandth of a step and eight steps" "$(last fine fracture)" 6e-7 6.002e-7

# Equal bits.
same() { if cmp "$work/$1/history.csv" "$work/$2/history.csv"; then pass; else fail "$1 and $2 differ"; fi; }
same one two
part=$(compute "0.2 * $(figure "$work/two" wall_seconds)")
"$cleave" run "$work/notch.yaml" -o "$work/cut" -t 2 -q -s output.checkpoint=0 $coarse -s time.wall="$part" 2>/dev/null
is "cut" $? 130
"$cleave" run "$work/notch.yaml" -o "$work/cut" -t 1 -q -s output.checkpoint=0 $coarse --resume 2>"$work/cut.err" || fail "cut: $(cat "$work/cut.err")"
same one cut

# Given loads: the same state as under control by energy at that load, and beyond the peak no state. Before the peak little has softened.
start given "$work/notch.yaml" -s steps.control=load -s steps.number=6 -s duration=0.23s; wait
between "given loads: dissipated" "$(last given fracture)" 1e-8 2.6e-7
between "given loads: energy" "$(figure "$work/given" energy.balance_error)" -2e-3 2e-3
"$cleave" run "$work/notch.yaml" -o "$work/over" -q $coarse -s steps.control=load -s steps.number=1 -s duration=0.4s 2>"$work/said"
is "over: status" $? 1
holds "over" grep -q 'use steps.control: energy' "$work/said"

# Loads that are zero over a step, or pass through zero, differ little from loads of a ten thousandth: a strip that is loaded, let go,
# pressed (its bonds have their whole stiffness) and loaded again.
cat >"$work/cycle.yaml" <<'END'
space: plane stress
thickness: 0.7 mm
duration: 1 s
method: pd
solver: static
steps: {number: 20, control: load}
material: {young: 30 GPa, density: 2400, energy_release_rate: 100, tensile_strength: 4 MPa, softening: bilinear}
body: {box: {from: [0, -10 mm], to: [20 mm, 10 mm]}}
cracks: [{from: [-1 mm, 0], to: [5 mm, 0]}]
particles: {spacing: 1 mm}
contact: {between: none}
variables: {rest: 0}
boundary:
  - {name: top, displacement: [free, 10 um], face: y+, depth: 1 mm, time: {table: [[0, 0], [0.1, rest], [0.25, 0.8], [0.5, rest], [0.6, -0.4], [0.7, 0], [1, 1]]}}
  - {name: bottom, fixed: [y], face: y-, depth: 1 mm}
  - {name: pin, fixed: [x], region: {box: {from: [19 mm, -10 mm], to: [20 mm, -9 mm]}}}
probes: [{reaction: {boundary: top}}]
output: {frames: 0}
END
start cycle "$work/cycle.yaml"
start nearly "$work/cycle.yaml" -s variables.rest=1e-4
start elastic "$work/cycle.yaml" -s material.tensile_strength= -s material.softening= -s material.energy_release_rate=1e9; wait
for name in strain fracture reaction.force_y; do near "cycle: $name" "$(last cycle $name)" "$(last nearly $name)" 1e-3; done
near "cycle: pressed" "$(column "$work/cycle" reaction.force_y 0.6)" "$(column "$work/elastic" reaction.force_y 0.6)" 1e-3

# A crack that closes: a notched strip is torn apart until bonds end, let go and pressed. Where its bonds press it is as stiff as the same
# strip without softening, within 1e-3: the solutions have residuals of 1e-5, and bonds at the notch have softened. The faces of the notch
# have no contact, of which the run warns.
cat >"$work/close.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 1 s
method: pd
solver: static
steps: {number: 80, control: load}
materials:
  - {name: stone, young: 30 GPa, density: 2400, energy_release_rate: 100, tensile_strength: 4 MPa}
  - {name: grip, young: 30 GPa, density: 2400}
body: {box: {from: [0, -10 mm], to: [20 mm, 10 mm]}}
parts:
  - {region: {box: {from: [0, 6 mm], to: [20 mm, 10 mm]}}, material: grip}
  - {region: {box: {from: [0, -10 mm], to: [20 mm, -6 mm]}}, material: grip}
cracks: [{from: [-1 mm, 0], to: [5 mm, 0]}]
particles: {spacing: 1 mm}
contact: {between: none}
boundary:
  - {name: top, displacement: [free, 80 um], face: y+, depth: 1 mm, time: {table: [[0, 0], [0.5, 1], [0.75, 0], [1, -0.1]]}}
  - {name: bottom, fixed: [y], face: y-, depth: 1 mm}
  - {name: pin, fixed: [x], region: {box: {from: [19 mm, -10 mm], to: [20 mm, -9 mm]}}}
probes: [{reaction: {boundary: top}}]
output: {frames: 0}
END
unsoftened='-s materials.0.tensile_strength= -s materials.0.energy_release_rate=1e9 -s accept=[energy,stretch,stress]'
start close "$work/close.yaml"
start unsoftened "$work/close.yaml" $unsoftened
{ "$cleave" run "$work/close.yaml" -o "$work/close_two" -t 2 -q 2>"$work/said" || fail "close_two: $(cat "$work/said")"; } &
wait
holds "notch overlap" grep -q 'crack faces overlap: at t = 0.763 s [0-9]* pairs of particles .* pre-crack .* set solver: explicit with contact.between: all' "$work/said"
same close close_two
between "open: force" "$(column "$work/close" reaction.force_y 0.5)" 0.1 0.13
for t in 0.7625 0.775; do near "closed: force" "$(column "$work/close" reaction.force_y $t)" "$(column "$work/unsoftened" reaction.force_y $t)" 1e-3; done
near "closed: force at last" "$(column "$work/close" reaction.force_y 1)" "$(column "$work/unsoftened" reaction.force_y 1)" 1e-2
near "closing costs nothing" "$(column "$work/close" fracture 0.8)" "$(column "$work/close" fracture 0.5)" 1e-9
"$cleave" run "$work/close.yaml" -o "$work/close_cut" -q -s output.checkpoint=0 -s time.wall="$(compute "0.9 * $(figure "$work/close" wall_seconds)")" 2>/dev/null
"$cleave" run "$work/close.yaml" -o "$work/close_cut" -q -s output.checkpoint=0 --resume 2>/dev/null
same close close_cut

# A strip driven by displacements, whose notch runs through in one load step: the crack of 4 mm, half of it in the body, dissipates
# 1 to 1.06 G_c (bonds soften beside it, too), whatever the bonds; the rest is damped. Along straight paths, in parts that no bond softens
# through at once; state-based bonds dissipated 31 G_c in one part.
sed -e 's/number: 12, control: energy, energy: 0.075 uJ/number: 4, control: load/' -e 's/traction: .*/displacement: [free, 1.2 um], face: y+, depth: 0.1 mm, time: {ramp: {until: 1 s}}}/' \
    "$work/notch.yaml" >"$work/jump.yaml"
start jump_bond "$work/jump.yaml"
start jump_ospd "$work/jump.yaml" -s model=ospd -s materials.0.poisson=0.22 -s materials.1.poisson=0.22; wait
for run in jump_bond jump_ospd; do
    between "$run: area" "$(last $run crack_area)" 3.9e-6 4.1e-6
    between "$run: fracture over G_c" "$(compute "$(last $run fracture) / 2e-5")" 0.99 1.065
    between "$run: energy" "$(figure "$work/$run" energy.balance_error)" -2e-3 2e-3
done

# Beside a mirror the crack has the area and the release rate of the whole body, and half of the energy is released; also of brittle bonds.
sed -e 's/from: .0, 0., to: .5 mm, 6 mm./from: [0, -6 mm], to: [5 mm, 6 mm]/' -e 's/  - {mirror: .*/  - {traction: [0, -40 MPa], face: y-, time: {ramp: {until: 1 s}}}/' \
    -e 's/^parts: .\(.*\).$/parts: [\1, {region: {box: {from: [0, -6 mm], to: [5 mm, -4.8 mm]}}, material: grip}]/' "$work/notch.yaml" >"$work/whole.yaml"
brittle="$coarse -s materials.0.tensile_strength= -s steps.energy="
start whole "$work/whole.yaml" $coarse -s steps.energy=0.15uJ
start half_brittle "$work/notch.yaml" $brittle; wait
start whole_brittle "$work/whole.yaml" $brittle; wait
for pair in one:whole half_brittle:whole_brittle; do
    half=${pair%:*} whole=${pair#*:}
    between "$half: area" "$(compute "$(last $half crack_area)/$(last $whole crack_area)")" 0.999999 1.000001
    between "$half: load" "$(compute "$(load $half)/$(load $whole)")" 0.999 1.001
    between "$half: release rate" "$(compute "$(f $half load_steps.release_rate)/$(f $whole load_steps.release_rate)")" 0.999 1.001
    between "$half: energy" "$(compute "$(last $half released)/$(last $whole released)")" 0.4995 0.5005
done
"$cleave" run "$work/notch.yaml" -o "$work/told" $coarse -s steps.number=10 >"$work/said" 2>&1
holds "a half: what is printed" grep -q 'on this side of the mirror over .* J/m^2 on both sides, part of it in bonds that still soften' "$work/said"

# Without steps.energy a step dissipates that of a quarter spacing, here of half of the crack: 0.25 0.2 mm 1 mm 10 J/m^2 / 2,
# of which bonds across a lattice line have 0.987.
start default "$work/notch.yaml" -s particles.spacing=0.2mm -s steps.energy= -s steps.number=3; wait
between "default energy" "$(last default fracture)" "$(compute '0.975 * 0.25e-6 * 2.001')" "$(compute '0.25e-6 * 2.001')"
"$cleave" check "$work/notch.yaml" --no-trial -s steps.energy=1uJ >"$work/said" 2>&1
holds "a large energy" grep -q 'a crack that grows by 2.0[0-9] spacings, so the largest load may be off by 15 %; set steps.energy to at most 2.4[0-9]*e-07 J (the default is less)' "$work/said"
"$cleave" check "$work/notch.yaml" --no-trial -s steps.energy=0.25uJ >"$work/said" 2>&1
holds "half a spacing" sh -c "! grep -q 'spacings of new crack' '$work/said'"

# A bar in a line, which parts at once: by default in a hundred steps. Its largest load is 300 N within 1 %.
cat >"$work/bar.yaml" <<'END'
space: line
section: 1 cm^2
duration: 1 s
method: pd
solver: static
steps: {number: 200, control: energy}
material: {young: 30 GPa, density: 2400, tensile_strength: 3 MPa, energy_release_rate: 100 J/m^2}
body: {box: {from: [0], to: [60 mm]}}
particles: {spacing: 5 mm}
boundary:
  - {name: l, fixed: all, face: x-}
  - {name: r, displacement: [0.2 mm], face: x+, time: {ramp: {until: 1 s}}}
probes: [{reaction: {boundary: r}}]
output: {frames: 0}
END
start bar "$work/bar.yaml"; wait
between "bar: load" "$(figure "$work/bar" probes.reaction.force_max)" 297 303
between "bar: energy" "$(figure "$work/bar" energy.balance_error)" -6e-3 6e-3

# What check prints.
"$cleave" check "$work/notch.yaml" --no-trial >"$work/said" 2>&1
holds "check" grep -q 'cracks  *grow where bonds soften; in each load step they dissipate steps.energy' "$work/said"
holds "check: faces" grep -q 'with pd.surface: volume .* carries 9.5 % more with 10 layers, 3.5 % with 20$' "$work/said"
holds "check: pre-crack" grep -q 'pre-cracks  *the shortest is 0.001 m long, which is 3.3 horizons$' "$work/said"

bad() { what=$1 words=$2; shift 2; refused "$what" "$work/no" "$words" "$work/notch.yaml" "$@"; }
bad "opening" "control: energy or load" -s 'steps={control: opening, from: [0, 0], to: [0, 1mm], opening: 1um}'
bad "hoop" "control: energy or load" -s steps.path=hoop
bad "adaptive" "need method: pd; set it, or remove tensile_strength" -s method=adaptive
bad "contact" "load steps have no contact if bonds soften" -s contact.between=all
bad "a brittle material beside" "material grip breaks without softening while another softens; with load steps" -s materials.1.energy_release_rate=10
finish
