#!/bin/sh
# Scenes with contact: results stated in inputs/, bitwise equality on any number of threads and after an interruption, refusals.
# Takes 30 s: the solids hit by a ball and the plate hit by a projectile need fine spacings.
test_name=test_contact
. tests/support/summary.sh
. tests/support/scenes.sh
. tests/support/trust.sh
. tests/support/claims.sh

# ---- inputs/ ---------------------------------------------------------------------------------------------------------

start spall hopkinson_bar -s method=pd
for scene in bars_collide discs_collide kalthoff_projectile three_point_bend brazilian_disc; do start $scene $scene; done
start ring ring_fragments
# Bonds of concrete that soften: notches at 0.825 and 0.85 of half the span, 101.6 mm.
concrete='-s model=bond -s material.poisson=1/3 -s material.tensile_strength=10.45MPa -s material.softening=bilinear'
start soft_notch three_point_bend $concrete -s "cracks=[{from: [83.82 mm, -1 mm], to: [83.82 mm, 19 mm], width: 2 mm}]"
start soft_middle three_point_bend $concrete -s "cracks=[{from: [86.36 mm, -1 mm], to: [86.36 mm, 19 mm], width: 2 mm}]"
start soft_disc strength_disc
# Beams that do not break, with notches at 0.8 and 0.85 of half the span: factors of the notch, strain of the lower face in the middle.
for at in 81.28 86.36; do
    start stiff_$at three_point_bend -s material.energy_release_rate=1e7 -s duration=1.4ms \
        -s "cracks=[{from: [$at mm, -1 mm], to: [$at mm, 19 mm], width: 2 mm}]" \
        -s "probes=[{sif: {outer: 16 mm, contours: [16 mm, 17 mm]}}, {point: {name: left, at: [-1.27 mm, 1.27 mm]}}, {point: {name: right, at: [1.27 mm, 1.27 mm]}}]"
done
start ring_strength ring_strength
start middle three_point_bend -s "cracks=[{from: [86.36 mm, -1 mm], to: [86.36 mm, 19 mm]}]"
wait
for thickness in 3 4; do
    start ball_$thickness sphere_on_plate_3d -s particles.spacing=1mm \
        -s "bodies=[{name: plate, shape: {box: {from: [-18 mm, -18 mm, -$thickness mm], to: [18 mm, 18 mm, 0]}}}, {name: ball, rigid: true, mass: 4.1 g, velocity: [0, 0, -150 m/s], shape: {ball: {centre: [0, 0, 5.1 mm], radius: 5 mm}}}]"
done
wait
for run in bars_collide discs_collide kalthoff_projectile three_point_bend brazilian_disc ring ball_3 ball_4; do sound $run $pd_balance; done
claimed spall "cleave run inputs/hopkinson_bar.yaml -s method=pd"
claimed bars_collide "cleave run inputs/bars_collide.yaml"
claimed kalthoff_projectile "cleave run inputs/kalthoff_projectile.yaml"
claimed three_point_bend "cleave run inputs/three_point_bend.yaml"

# An impactor of 30 m/s, both bodies of bonds; with material points: test_scenes.sh.
sound spall $pd_balance
between "hopkinson_bar of bonds: first break" "$(f spall crack.start_time)" 1.00e-3 1.07e-3
between "hopkinson_bar of bonds: spall" "$(f spall probes.spall.position)" 0.038 0.042
between "hopkinson_bar of bonds: its speed" "$(f spall probes.spall.speed)" 26 30
between "bars: duration" "$(compute "$(f bars_collide contact.ended) - $(f bars_collide contact.began)")" 40e-6 42e-6
# Mass 8e-4 kg at -5 m/s.
between "bars: speed" "$(compute "$(f bars_collide probes.left.x) / -4e-3")" 0.98 1.001
between "projectile: angle, 63.2 where its face drives the plate" "$(f kalthoff_projectile crack.angle_deg)" 60.2 66.2
between "projectile: leaves" "$(f kalthoff_projectile contact.ended)" 40e-6 80e-6
between "beam: off the vertical" "$(f three_point_bend crack.angle_deg)" 33 45
between "beam: from the notch" "$(f three_point_bend crack.tips.0.growth)" 0.05 0.08
between "beam, notch farther out: none there" "$(f middle crack.tips.0.growth)" 0 1e-3
between "beam, notch farther out: in the middle" "$(f middle crack.tips.1.origin_x)" -0.01 0.01
between "softening beam, notch at 0.825: from there" "$(f soft_notch crack.tips.0.growth)" 0.04 0.08
between "softening beam, notch at 0.85: none there" "$(f soft_middle crack.tips.0.growth)" 0 1e-3
between "softening beam, notch at 0.85: in the middle" "$(f soft_middle crack.tips.1.origin_x)" -0.01 0.01
# overload DIR: prints K of the largest hoop stress (Erdogan & Sih 1963) at the notch over sqrt(E G_c) at the time when the stress of the
# lower face in the middle reaches 10.45 MPa. This stress follows from the strain over one spacing, half a spacing above the face.
overload()
{
    awk -F, 'NR == 1 { for (k = 1; k <= NF; k++) { sub(/ .*/, "", $k); at[$k] = k }; next }
        31.37e9 * ($at["right.displacement_x"] - $at["left.displacement_x"]) / 2.54e-3 * 38.1 / 36.83 >= 10.45e6 {
            for (deg = -89; deg < 90; deg++) {
                half = deg * 3.14159265 / 360
                K = cos(half) * ($at["sif.K_I"] * cos(half)^2 - 1.5 * $at["sif.K_II"] * sin(2 * half))
                if (K > most) most = K
            }
            print most / sqrt(31.37e9 * 19.58); exit
        }' "$work/$1/history.csv"
}
# Without softening, by linear elastic fracture mechanics, notch and middle fail at once where the ratio is 1: bonds that soften agree.
near_notch=$(overload stiff_81.28) far_notch=$(overload stiff_86.36)
between "elastic beam, notch at 0.8: fails first, by" "$near_notch" 1.04 1.12
between "elastic beam, notch at 0.85: the middle fails first, by" "$far_notch" 0.94 0.99
between "elastic beam: both at once for a notch at" "$(compute "0.8 + 0.05 * ($near_notch - 1) / ($near_notch - $far_notch)")" 0.825 0.85
# 2 P/(pi D t) of 10 MPa is 7.854 kN; it splits from cushion to cushion.
claimed soft_disc "cleave run inputs/strength_disc.yaml"
between "disc with a strength: load" "$(compute "$(f soft_disc rigid.0.force_max) / 7854")" 0.9 1.1
between "disc with a strength: along the diameter" "$(f soft_disc crack.angle_deg)" 80 100
between "disc with a strength: length" "$(f soft_disc crack.length_end)" 0.03 0.04
between "disc: along the diameter" "$(f brazilian_disc crack.angle_deg)" 80 100
between "disc: both jaws bear the same" "$(compute "$(f brazilian_disc rigid.0.force_max) / $(f brazilian_disc rigid.1.force_max)")" 0.999 1.001
# Stress across the middle, 2 P/(pi D t) for a disc of 50 mm, 10 mm thick, in the sample before the first break.
ratio=$(awk -F, 'NR == 1 { for (k = 1; k <= NF; k++) { sub(/ .*/, "", $k); at[$k] = k } }
    NR > 1 && $at["fracture"] == 0 { r = $at["centre.stress_xx"] * 3.14159265 * 0.05 * 0.01 / 2 / $at["upper_force_y"] }
    END { print r }' "$work/brazilian_disc/history.csv")
between "disc: stress across its middle" "$ratio" 0.97 1.03
# 2 pi R/S = 33 (Grady & Kipp); no mass is lost: pi (51.5^2 - 48.5^2) mm^2 x 3 mm, within 1 % of the lattice.
between "ring: fragments" "$(awk -F, 'NR > 1 && $2 > 20' "$work/ring/fragments.csv" | wc -l)" 26 46
mass=$(awk -F, 'NR > 1 { sum += $3 } END { print sum }' "$work/ring/fragments.csv")
between "ring: its mass in fragments" "$(compute "($mass + $(f ring fragments.mass_alone)) / 7.6341e-3")" 0.99 1.01
# 24 by energy; ten seeds gave 19 to 28.
claimed ring_strength "cleave run inputs/ring_strength.yaml"
sound ring_strength $pd_balance
between "ring with a strength: fragments" "$(count "$work/ring_strength/fragments.csv" '[mass] > 4e-5')" 20 31
mass=$(each "$work/ring_strength/fragments.csv" mass | awk '{ sum += $1 } END { print sum }')
between "ring with a strength: its mass in fragments" "$(compute "($mass + $(f ring_strength fragments.mass_alone)) / 7.6341e-3")" 0.99 1.01
between "ball through 4 mm" "$(f ball_4 rigid.0.velocity_z)" -122 -116
between "ball through 3 mm is faster" "$(f ball_3 rigid.0.velocity_z)" -132 -126
for run in ball_3 ball_4; do
    most=$(awk -F, 'NR > 1 && $8 > most { most = $8 } END { print most + 0 }' "$work/$run/history.csv")
    between "$run: no energy from nowhere" "$most" 0 1e-3
done

# ---- bitwise equality ------------------------------------------------------------------------------------------------

# A rotating ball hits a plate with a crack; frames, samples, checkpoints.
cat >"$work/hit.yaml" <<'E'
space: plane stress
thickness: 10 mm
duration: 100 us
method: pd
material: {young: 190 GPa, density: 7800, energy_release_rate: 500}
bodies:
  - {name: plate, shape: {box: {from: [0, -50 mm], to: [30 mm, 50 mm]}}}
  - {name: loose, shape: {ball: {centre: [38 mm, 4 mm], radius: 7 mm}}, velocity: [-40 m/s, 0]}
  - {name: wedge, rigid: true, mass: 0.3 kg, velocity: [60 m/s, 3 m/s], shape: {box: {from: [-20 mm, -7 mm], to: [-0.4 mm, 9 mm]}}}
cracks: [{from: [10 mm, -60 mm], to: [10 mm, 5 mm]}]
particles: {spacing: 1 mm}
output: {frames: 10, samples: 200}
E
calm "$work/bits1" "$work/hit.yaml" -t 1
calm "$work/bits7" "$work/hit.yaml" -t 7
same "7 threads" "$work/bits1" "$work/bits7"
calm "$work/all" "$work/hit.yaml" -s time.active_set=false
if cmp "$work/bits1/history.csv" "$work/all/history.csv" >/dev/null ||
    [ "$(cut -d , -f 1-21,23- "$work/bits1/history.csv" | cksum)" = "$(cut -d , -f 1-21,23- "$work/all/history.csv" | cksum)" ]; then pass
else fail "the active set changes the run"; fi
calm "$work/echo" "$work/bits1/scene.yaml"
if cmp "$work/bits1/history.csv" "$work/echo/history.csv"; then pass; else fail "scene.yaml is another scene"; fi
twice_interrupted "$work/stopped" 60 120 "$work/hit.yaml"
calm "$work/stopped" -t 3 --resume "$work/hit.yaml"
same "on 2 threads, stopped at lines 60 and 120, then on 3" "$work/bits1" "$work/stopped"
rm -r "$work/stopped"
for friction in 0.3 10; do               # sliding and sticking
    rub="$work/hit.yaml -s contact.friction=$friction"
    calm "$work/rub1" $rub -t 1
    between "friction $friction takes work" "$(figure "$work/rub1" contact.friction_work)" 0.1 1000
    between "friction $friction: energy" "$(figure "$work/rub1" energy.balance_error)" -0.005 0.005
    interrupted "$work/stopped" 120 $rub
    calm "$work/stopped" -t 3 --resume $rub
    same "friction $friction, on 2 threads, stopped, then on 3" "$work/rub1" "$work/stopped"
    rm -r "$work/stopped" "$work/rub1"
done

# ---- width of notches --------------------------------------------------------------------------------------------------

# Two halves of a bar approach at 2 x 1 m/s: a cut of zero width has contact at once, a notch of 0.2 mm after 0.1 ms (waves from the ends
# have not arrived yet).
cat >"$work/notch.yaml" <<'E'
space: plane stress
thickness: 10 mm
duration: 150 us
method: pd
material: {young: 1 GPa, density: 1000}
body: {box: {from: [-100 mm, 0], to: [100 mm, 20 mm]}}
initial: [{velocity: [1 m/s, 0]}, {velocity: [-1 m/s, 0], region: {box: {from: [0, 0], to: [100 mm, 20 mm]}}}]
cracks: [{from: [0, -1 mm], to: [0, 21 mm]}]
particles: {spacing: 1 mm}
E
for law in surface pair; do
    calm "$work/cut" "$work/notch.yaml" --overwrite -s contact.law=$law
    between "cut without width, $law" "$(figure "$work/cut" contact.began)" 0 2e-6
    calm "$work/notch" "$work/notch.yaml" --overwrite -s contact.law=$law -s "cracks=[{from: [0, -1 mm], to: [0, 21 mm], width: 0.2 mm}]"
    between "notch, $law" "$(figure "$work/notch" contact.began)" 98e-6 103e-6
    calm "$work/notch_echo" "$work/notch/scene.yaml" --overwrite
    if cmp "$work/notch/history.csv" "$work/notch_echo/history.csv"; then pass; else fail "scene.yaml has another notch"; fi
done

# ---- refusals and stops ------------------------------------------------------------------------------------------------

refused "a mass without rigid" "$work/no" "is a key of rigid bodies only" "$work/hit.yaml" \
    -s "bodies=[{name: a, mass: 1 kg, shape: {box: {from: [0, 0], to: [9 mm, 9 mm]}}}]"
refused "a material of a rigid body" "$work/no" "has no meaning for a rigid body" "$work/hit.yaml" \
    -s "bodies=[{name: b, shape: {box: {from: [0, 0], to: [9 mm, 9 mm]}}}, {name: a, rigid: true, material: material, shape: {box: {from: [20 mm, 0], to: [29 mm, 9 mm]}}}]"
refused "only rigid bodies" "$work/no" "all bodies are rigid" "$work/hit.yaml" \
    -s "bodies=[{name: a, rigid: true, shape: {box: {from: [0, 0], to: [9 mm, 9 mm]}}}]"
refused "a half-space that flies" "$work/no" "has an infinite shape" "$work/hit.yaml" \
    -s "bodies=[{name: b, shape: {box: {from: [0, 0], to: [9 mm, 9 mm]}}}, {name: a, rigid: true, mass: 1 kg, shape: {half-space: {point: [20 mm, 0], normal: [1, 0]}}}]"
refused "friction of pairs" "$work/no" "contact.law: surface" "$work/hit.yaml" -s contact.friction=0.1 -s contact.law=pair
refused "rigid bodies and material points" "$work/no" "method: pd" "$work/hit.yaml" -s method=mpm
stopped "particles that pass each other" "$work/deep" "overlaps another one by" inputs/bars_collide.yaml \
    -s "bodies=[{name: a, velocity: [2000 m/s], shape: {box: {from: [-100 mm], to: [0]}}}, {name: b, velocity: [-2000 m/s], shape: {box: {from: [1 mm], to: [101 mm]}}}]"

finish
