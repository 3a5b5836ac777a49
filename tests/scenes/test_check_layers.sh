#!/bin/sh
# Compares the errors of stiffness that `cleave check` states for thin parts with those of runs against closed forms: strips and square
# bars of 5 layers of bonds and of state-based models in bending, on two kinds of supports, in tension and in torsion; cells whose points
# share one dilatation in bending; displaced ends in the middle of a cell.
# Takes 10 s: 16 equilibria of some thousand particles are found.
test_name=test_check_layers
. tests/support/summary.sh
bend=tests/scenes/claims/bar_bend.yaml twist=tests/scenes/claims/bar_twist.yaml

# told SCENE [ARGUMENT...]: sets `bending` and `twisting` to the errors of stiffness that check states [%].
told()
{
    "$cleave" check "$@" --no-trial >"$work/said" 2>&1
    bending=$(sed -n 's/.* off by up to about \([0-9]*\) % in bending and tension.*/\1/p' "$work/said")
    twisting=$(sed -n 's/.* in bending and tension, \([0-9]*\) % in twisting.*/\1/p' "$work/said")
}
# run FOLDER SCENE [ARGUMENT...]: runs a scene. at PROBE AXIS: prints the displacement of a probe in the previous run [m].
run() { folder=$work/$1; shift; "$cleave" run "$@" -q -t 1 -o "$folder" >/dev/null 2>"$work/err" || fail "$folder: $(cat "$work/err")"; }
at() { figure "$folder" "probes.$1.displacement_$2"; }
# as_told WHAT ERROR TOLD: checks that a measured error is at most the error that check states, and not less than a third of it [%].
as_told() { between "$1" "$(compute "$2 < 0 ? -($2) : $2")" "$(compute "$3 / 3")" "$(compute "$3 + 0.1")"; }

# Pure bending by stress q y/(h/2): of 5 rows at the middle of their areas, 1 - 1/25 of the moment of a linear stress; curvature 2 q/(h E)
# of it, and the deflection over 2 h + d/2 from that at d/2.
bent()
{
    compute "-0.5 * 0.96 * 2 * 1e6 / (5e-3 * 70e9) * (10.5e-3 ^ 2 - 0.5e-3 ^ 2) * 2 / \
        ($(at right y) + $(at left y) - ($(at beside_right y)) - ($(at beside_left y))) * 100 - 100"
}
run bend "$bend"
solid=$(bent)
told "$bend"
as_told "a bar of 5 x 5 layers in bending" "$solid" "$bending"
sed 's/space: solid/space: plane stress\nthickness: 5 mm/; s/, 0, 0\]/, 0]/g; s/, -h\/2, -h\/2\]/, -h\/2]/; s/, h\/2, h\/2\]/, h\/2]/' "$bend" >"$work/strip.yaml"
run strip "$work/strip.yaml"
told "$work/strip.yaml"
as_told "a strip of 5 layers in bending" "$(bent)" "$bending"
is "a strip does not twist" "$twisting" ""

# Torsion: T = q h^3/3 of a continuous stress, theta' = T/(0.140577 G h^4) (Saint-Venant), over 4 h + d, at h/2 - d/2 from the axis.
run twist "$twist"
told "$twist"
turned=$(compute "0.96 * 1e6 * 5e-3 ^ 3 / 3 / (0.140577 * 28e9 * 5e-3 ^ 4) * 21e-3 * 2e-3 / ($(at right z) - ($(at left z))) * 100 - 100")
as_told "a bar of 5 x 5 layers in torsion" "$turned" "$twisting"
# The same bar of state-based particles at another ratio, which torsion sees by G alone.
run turned "$twist" -s model=ospd -s material.poisson=0
told "$twist" -s model=ospd -s material.poisson=0
as_told "a bar of ospd in torsion" \
    "$(compute "0.96 * 1e6 * 5e-3 ^ 3 / 3 / (0.140577 * 35e9 * 5e-3 ^ 4) * 21e-3 * 2e-3 / ($(at right z) - ($(at left z))) * 100 - 100")" "$twisting"

# Half the length clamped at a plane where displacements are odd, under a shear force at its end, and free to turn about its middle under a
# uniform load that the ends carry: the error is that of pure bending, less where shear adds to the deflection. Timoshenko's beam with
# Cowper's coefficient 10 (1 + nu)/(12 + 11 nu).
half() { sed "s/from: \[-4\*h,/from: [0,/; s/to: \[4\*h,/to: [10*h,/; /^boundary:/,\$d" "$bend" >"$work/$1.yaml"; cat >>"$work/$1.yaml"; }
half clamped <<'END'
boundary:
  - {mirror: {axis: x, at: 0, tangential: held}}
  - {traction: [0, q, 0], face: x+}
probes: [point: {name: tip, at: [10*h - d/2, 0, 0]}]
output: {frames: 0, samples: 2}
END
half carried <<'END'
boundary:
  - {mirror: {axis: x, at: 0}}
  - {traction: [0, q, 0], face: x+}
  - {body_force: [0, -q/(10*h), 0]}
probes: [point: {name: tip, at: [10*h - d/2, 0, 0]}, point: {name: middle, at: [d/2, 0, 0]}]
output: {frames: 0, samples: 2}
END
beam() # beam LOAD X: deflection at X of the beam of length 50 mm [m] under an end force of 25 N and, if LOAD is 1, minus as much spread
{
    compute "25 * (0.05 * $2 ^ 2 / 2 - $2 ^ 3 / 6) / (70e9 * 5e-3 ^ 4 / 12) + 25 * $2 / (12.5 / 14.75 * 28e9 * 25e-6) - \
        $1 * 500 * ((0.05 ^ 2 * $2 ^ 2 / 4 - 0.05 * $2 ^ 3 / 6 + $2 ^ 4 / 24) / (70e9 * 5e-3 ^ 4 / 12) + \
        (0.05 * $2 - $2 ^ 2 / 2) / (12.5 / 14.75 * 28e9 * 25e-6))"
}
told "$bend"
run clamped "$work/clamped.yaml"
as_told "a clamped bar" "$(compute "$(beam 0 49.5e-3) / $(at tip y) * 100 - 100")" "$bending"
run carried "$work/carried.yaml"
as_told "a bar on two supports" "$(compute "($(beam 1 49.5e-3) - $(beam 1 0.5e-3)) / ($(at tip y) - ($(at middle y))) * 100 - 100")" "$bending"

# Tension of ospd at a ratio of 0, whose error is larger than that of bending.
sed '/^boundary:/,$d' "$work/strip.yaml" >"$work/pulled.yaml"
cat >>"$work/pulled.yaml" <<'END'
model: ospd
boundary:
  - {traction: [q, 0], face: x+}
  - {traction: [-q, 0], face: x-}
probes: [point: {name: right, at: [10.5 mm, 0]}, point: {name: left, at: [-10.5 mm, 0]}]
output: {frames: 0, samples: 2}
END
run pulled "$work/pulled.yaml" -s material.poisson=0
told "$work/pulled.yaml" -s material.poisson=0
as_told "a strip of ospd in tension" "$(compute "1e6 / 70e9 * 21e-3 / ($(at right x) - ($(at left x))) * 100 - 100")" "$bending"

# Cells whose points have one dilatation: a cantilever of 4 layers under an end force in plane strain, whose yield stress is not reached.
# Timoshenko's beam with E/(1 - nu^2), L = 80 mm, h = 8 mm, 3.2 N.
cat >"$work/sheet.yaml" <<'END'
space: plane strain
thickness: 4 mm
duration: 1 s
method: mpm
solver: static
steps: {number: 1}
material: {young: 200 GPa, poisson: 0.3, density: 7850, yield_stress: 500 MPa}
body: {box: {from: [0, 0], to: [80 mm, 8 mm]}}
particles: {spacing: 2 mm}
boundary:
  - {fixed: all, face: x-}
  - {name: push, traction: [0, -0.1 MPa], face: x+, time: {ramp: {until: 1 s}}}
probes: [point: {name: tip, at: [79 mm, 5 mm]}]
output: {frames: 1}
END
soft() { sed -n 's/.*same change of volume, so [0-9]* layers bend up to \([0-9]*\) % too much.*/\1/p' "$work/said"; }
run sheet "$work/sheet.yaml"
told "$work/sheet.yaml"
beam=$(compute "3.2 * (0.08 * 0.079^2 / 2 - 0.079^3 / 6) / (200e9 / 0.91 * 4e-3 * 8e-3^3 / 12) + 3.2 * 0.079 / (5/6 * 200e9 / 2.6 * 32e-6)")
as_told "a sheet of 4 layers that may yield" "$(compute "$(at tip y) / -($beam) * 100 - 100")" "$(soft)"
told "$work/sheet.yaml" -s material.yield_stress=inf
is "a sheet that does not yield" "$(soft)" ""

# A displaced end in the middle of a cell of two spacings: a bar of 21 mm on a plane of symmetry, force E A u/L.
cat >"$work/odd.yaml" <<'END'
variables: {length: 21 mm}
space: plane stress
thickness: 2 mm
duration: 1 s
method: mpm
solver: static
steps: {number: 1}
material: {young: 200 GPa, poisson: 1/3, density: 7850}
body: {box: {from: [0, 0], to: [16 mm, length]}}
particles: {spacing: 1 mm}
boundary:
  - {mirror: {axis: x, at: 0}}
  - {fixed: [y], face: y-}
  - {name: up, displacement: [free, 0.01 mm], face: y+, time: {ramp: {until: 1 s}}}
probes: [reaction: {boundary: up}]
output: {frames: 1}
END
off() { sed -n "s/.*boundary up: .* the $1 spacings of the body were $2. The stiffness is off by \\([-+0-9.]*\\) % in tension.*/\\1/p" "$work/said"; }
pulled() { compute "$(figure "$folder" probes.reaction.force_max) / (200e9 * 32e-6 * 1e-5 / $1) * 100 - 100"; }
run odd "$work/odd.yaml"
told "$work/odd.yaml"
near "a face in the middle of a cell" "$(pulled 0.021)" "$(off 21 24)" 0.05
sed 's/, face: y+/, region: {box: {from: [-inf, 20 mm], to: [inf, inf]}}/' "$work/odd.yaml" >"$work/odd_region.yaml"
run odd_region "$work/odd_region.yaml"
told "$work/odd_region.yaml"
near "a region that ends there" "$(pulled 0.021)" "$(off 21 20)" 0.12
run even "$work/odd.yaml" -s 'variables.length=20 mm'
told "$work/odd.yaml" -s 'variables.length=20 mm'
near "a face at nodes" "$(compute "100 + $(pulled 0.020)")" 100 1e-3
is "a face at nodes: nothing is said" "$(grep -c 'middle of a cell' "$work/said")" 0

finish
