#!/bin/sh
# Material points and planes of symmetry: the distance at which a plane begins to act on the grid, gaps between a body and a plane, planes
# close to each other.
test_name=test_mirror_points
. tests/support/summary.sh
. tests/support/trust.sh
. tests/support/scenes.sh
seed=3

# A plane of symmetry that a block on the grid meets after a flight of 1 mm acts 1.6 spacings too early: with the plane moved back by
# this length, as `cleave check` says, the momentum changes its sign when it should, 1 mm at 50 m/s after that of a block that starts at the
# plane, within 0.1 spacings (0.5 us); without it 1.4 spacings early at least.
cat >"$work/wall.yaml" <<'END'
space: plane strain
thickness: 10 mm
duration: 30 us
method: mpm
material: {young: 200 GPa, poisson: 0.25, density: 7850}
bodies: [{name: block, shape: {box: {from: [0, 1 mm], to: [5 mm, 11 mm]}}, velocity: [0, -50 m/s]}]
particles: {spacing: 0.25 mm}
boundary: [{name: wall, mirror: {axis: y, at: 0}}]
output: {frames: 0, samples: 600}
END
# turns NAME: prints the time at which the momentum of the block changes its sign in a run [us].
turns()
{
    awk -F, 'NR == 1 { for (k = 1; k <= NF; k++) if ($k ~ /^momentum_y/) at = k; next }
        $at >= 0 && p < 0 { print 1e6 * (t + ($1 - t) * p/(p - $at)); exit } { p = $at; t = $1 }' "$work/$1/history.csv"
}
calm "$work/at_once" "$work/wall.yaml" -s 'bodies=[{name: block, shape: {box: {from: [0, 0], to: [5 mm, 10 mm]}}, velocity: [0, -50 m/s]}]'
calm "$work/back" "$work/wall.yaml" -s boundary.wall.mirror.at=-0.4mm
calm "$work/early" "$work/wall.yaml"
between "wall: moved back" "$(compute "$(turns back) - ($(turns at_once))")" 19.5 20.5
between "wall: acts early" "$(compute "$(turns early) - ($(turns at_once))")" 11 13
is "wall: its distance" "$("$cleave" check --no-trial "$work/wall.yaml" | grep -c 'about 0.0004 m (1.6 spacings) too early')" 1
is "wall: a block that lies there is not warned of" "$("$cleave" check --no-trial "$work/wall.yaml" -s mpm.frame=current -s boundary.wall.mirror.at=1mm | grep -c 'too early')" 0

# A ball below a cylinder has no void beside a plane of symmetry: the gap is between them and the plane, and the reference frame, which is
# refused, is no remedy.
cat >"$work/ball.yaml" <<'END'
space: solid
duration: 20 us
method: mpm
material: {young: 200 GPa, poisson: 0.25, density: 7850}
bodies:
  - name: bolt
    shape: [{ball: {centre: [0, 0, 5.1 mm], radius: 5 mm}}, {cylinder: {from: [0, 0, 5.1 mm], to: [0, 0, 15 mm], radius: 5 mm}}]
    velocity: [0, 0, -50 m/s]
particles: {spacing: 0.5 mm}
boundary: [{name: wall, mirror: {axis: z, at: 0}}]
output: {frames: 0}
END
"$cleave" check --no-trial "$work/ball.yaml" >"$work/ball.txt" 2>&1
is "a ball at a plane: voids" "$(grep -c 'has a void' "$work/ball.txt")" 0
is "a ball at a plane: gap" "$(grep -c 'between this body and a plane of symmetry is too narrow for the grid.*use method: pd, method: adaptive or' "$work/ball.txt")" 1

# Material points between mirrors one, two and four spacings apart carry the same wave, to the last bit; bonds would need more (test_stability).
cat >"$work/strip.yaml" <<'END'
space: plane strain
thickness: 10 mm
duration: 10 us
method: mpm
mpm: {frame: current}
material: {young: 200 GPa, poisson: 0.25, density: 7850}
variables: {w: 4 mm}
body: {box: {from: [0, 0], to: [20 mm, w]}}
particles: {spacing: 1 mm}
boundary:
  - {mirror: {axis: y, at: 0}}
  - {mirror: {axis: y, at: w}}
  - {mirror: {axis: x, at: 0}}
  - {face: x+, traction: [100 MPa, 0]}
output: {frames: 0}
probes: [{point: {name: inside, at: [15.5 mm, 0.5 mm]}}]
END
for w in 1 2 4; do calm "$work/strip$w" "$work/strip.yaml" -s variables.w=${w}mm; done
for w in 1 2; do
    is "mirrors $w spacings apart" "$(column "$work/strip$w" inside.stress_xx 1)" "$(column "$work/strip4" inside.stress_xx 1)"
    refused "mirrors $w spacings apart, with bonds" "$work/no" ", but bonds of" "$work/strip.yaml" -s variables.w=${w}mm -s method=pd
done

# Light nodes on a plane of symmetry (APIC) follow their neighbours as those of the whole body do: half of a block under a traction along the
# plane stores half of its energy, to the digits of history.csv. If such nodes were held, it would store 6 % more.
cat >"$work/light.yaml" <<'END'
space: plane stress
thickness: 2 mm
duration: 6 us
method: mpm
mpm: {frame: current, transfer: apic}
material: {young: 72 GPa, density: 2440 kg/m^3, poisson: 0.3}
body: {box: {from: [0, -8 mm], to: [8 mm, 8 mm]}}
particles: {spacing: 1 mm}
boundary:
  - {traction: [0, 20 MPa], face: y+, time: {ramp: {until: 2 us}}}
  - {mirror: {axis: x, at: 0}}
output: {frames: 0}
END
for shape in gimp cpgimp; do
    holds "run" "$cleave" run "$work/light.yaml" -t 1 -q -s mpm.shape=$shape -o "$work/light_half" --overwrite >"$work/said" 2>&1
    holds "run" "$cleave" run "$work/light.yaml" -t 1 -q -s mpm.shape=$shape -s boundary.1= -s 'body.box.from=[-8 mm, -8 mm]' \
        -o "$work/light_whole" --overwrite >"$work/said" 2>&1
    for name in strain kinetic; do
        near "$shape: $name of half a body" "$(compute "2 * $(column "$work/light_half" $name 1)")" "$(column "$work/light_whole" $name 1)" 1e-7
    done
done
finish
