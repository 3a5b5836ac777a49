#!/bin/sh
# Small scenes of every kind, for tests that run them all under a tool. Each takes less than a second in a plain build.
# Sourced after summary.sh.

# ---- scenes that no input has ------------------------------------------------------------------------------------------

# Two bodies that meet, on a grid of the current frame; one yields.
cat >"$work/meet.yaml" <<'END'
space: plane strain
thickness: 1 mm
duration: 30 us
method: adaptive
materials:
  - {name: hard, young: 200 GPa, density: 7800, energy_release_rate: 2e4}
  - {name: soft, young: 70 GPa, density: 2700}
bodies:
  - {name: anvil, material: hard, shape: {box: {from: [0, 0], to: [10 mm, 20 mm]}}}
  - {name: disc, material: soft, shape: {disc: {centre: [-6 mm, 10 mm], radius: 5 mm}}, velocity: [300 m/s, 0]}
particles: {spacing: 1 mm}
boundary:
  - {name: back, fixed: [x, y], region: {half-space: {point: [9 mm, 0], normal: [-1, 0]}}}
output: {frames: 2, samples: 10}
probes: [break, momentum, energy, {reaction: {boundary: back}}, {line: {from: [0, 10 mm], to: [10 mm, 10 mm]}}]
END

# A crack that grows as it is told, in peridynamics and among material points, with its factors.
cat >"$work/grow.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 12 us
method: pd
material: {young: 72 GPa, density: 2440}
body: {box: {from: [0, -15 mm], to: [40 mm, 15 mm]}}
particles: {spacing: 1 mm}
cracks:
  - {from: [-1 mm, 0], to: [15 mm, 0]}
growth:
  - {at: [15 mm, 0], direction: [1, 0], speed: 900 m/s, start: 4 us}
boundary:
  - {traction: [0, 10 MPa], face: y+}
  - {traction: [0, -10 MPa], face: y-}
output: {frames: 2, samples: 12}
probes: [tip, {sif: {outer: 11 mm}}, growth]
END

# A list of particles.
awk 'BEGIN { print "x,y,volume"; for (i = 0; i < 20; i++) for (j = 0; j < 10; j++) printf "%.4f,%.4f,1e-9\n", 0.0005 + i * 0.001, 0.0005 + j * 0.001 }' \
    >"$work/points.csv"
cat >"$work/list.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 8 us
method: pd
material: {young: 72 GPa, density: 2440, toughness: 1e6}
bodies:
  - {name: sheet, particles: points.csv}
particles: {spacing: 1 mm}
boundary:
  - {name: pull, velocity: [20 m/s, free], region: {box: {from: [19 mm, -inf], to: [inf, inf]}}, time: {ramp: {until: 4 us}}}
  - {name: hold, fixed: [x, y], region: {box: {from: [-inf, -inf], to: [1 mm, inf]}}}
output: {frames: 2, samples: 10}
probes: [{reaction: {boundary: pull}}, {point: {at: [10 mm, 5 mm]}}]
END

# A solid block with a crack and a cylinder cut out of it.
cat >"$work/block.yaml" <<'END'
space: solid
duration: 8 us
method: adaptive
material: {young: 72 GPa, density: 2440, energy_release_rate: 135}
body:
  - box: {from: [0, -6 mm, 0], to: [12 mm, 6 mm, 6 mm]}
  - subtract: {cylinder: {from: [10 mm, 0, -1 mm], to: [10 mm, 0, 7 mm], radius: 1.5 mm}}
particles: {spacing: 1 mm}
cracks:
  - polygon: [[0, 0, 0], [6 mm, 0, 0], [6 mm, 0, 6 mm], [0, 0, 6 mm]]
boundary:
  - {traction: [0, 8 MPa, 0], face: y+}
  - {traction: [0, -8 MPa, 0], face: y-}
output: {frames: 2, samples: 10}
probes: [tip, break]
END

# A pulse that makes bonds of points on its way through a plate; behind it the last of them return.
cat >"$work/back.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 34 us
material: {young: 200 GPa, density: 8000}
body: {box: {from: [0, 0], to: [160 mm, 20 mm]}}
particles: {spacing: 1 mm}
conversion: {stress: 200 MPa, alpha: 1, reversion: true}
initial: [{pulse: {at: [40 mm, 0], width: 32 mm, velocity: -10 m/s, direction: [1, 0]}}]
output: {frames: 2, samples: 10}
END

# ---- the list ----------------------------------------------------------------------------------------------------------

few="-s output.frames=2 -s output.samples=10"
kalthoff="inputs/kalthoff_winkler.yaml $few -s particles.spacing=4mm -s duration=36us"
wedge="inputs/kalthoff_winkler_3d.yaml $few -s particles.spacing=5mm -s time.step=0.3us -s duration=15us"

# One scene a line: name, scene and arguments.
scenes="\
plate|$kalthoff
plate_return|$kalthoff -s conversion.reversion=true -s conversion.hold_time=1
plate_handshake|$kalthoff -s coupling=handshake
plate_pm|$kalthoff -s coupling=pm
plate_pg|$kalthoff -s coupling=pg
plate_pmg|$kalthoff -s coupling=pmg
plate_pgg|$kalthoff -s coupling=pgg
plate_current|$kalthoff -s mpm.frame=current
plate_apic|$kalthoff -s mpm.transfer=apic
plate_reference|$kalthoff -s mpm.frame=reference
plate_small_strain|$kalthoff -s mpm.frame=reference -s mpm.strain=small
plate_bonds|$kalthoff -s method=pd
plate_irregular|$kalthoff -s method=pd -s particles.irregularity=0.4
plate_isotropic|$kalthoff -s method=pd -s pd.weights=isotropic -s pd.volume=cut-ramp
plate_ordinary|$kalthoff -s method=pd -s model=ospd
plate_turning|$kalthoff -s method=pd -s model=mospd
plate_ordinary_adaptive|$kalthoff -s model=ospd
plate_turning_adaptive|$kalthoff -s model=mospd
plate_turning_current|$kalthoff -s model=mospd -s mpm.frame=current
points_linear|$kalthoff -s method=mpm -s mpm.shape=linear
points_gimp|$kalthoff -s method=mpm -s mpm.shape=gimp
points_cpgimp|$kalthoff -s method=mpm -s mpm.shape=cpgimp
points_quadratic|$kalthoff -s method=mpm -s mpm.shape=quadratic
points_cubic|$kalthoff -s method=mpm -s mpm.shape=cubic -s mpm.transfer=apic
solid|$wedge
solid_bonds|$wedge -s method=pd
solid_points|$wedge -s method=mpm -s mpm.frame=current
solid_ordinary|$wedge -s model=ospd -s pd.surface=none
solid_turning|$wedge -s model=mospd -s pd.surface=none
block|$work/block.yaml
block_current|$work/block.yaml -s mpm.frame=current -s mpm.shape=cpgimp -s mpm.transfer=apic
meet|$work/meet.yaml
grow|$work/grow.yaml
grow_points|$work/grow.yaml -s method=adaptive -s model=ospd
list|$work/list.yaml
impact|inputs/plate_impact_3d.yaml $few -s particles.spacing=2mm -s duration=80us
bar_step|inputs/bar_step.yaml -s particles.spacing=20mm
bar_spall|inputs/bar_spall.yaml -s particles.spacing=20mm
bar_plastic|inputs/bar_plastic.yaml -s particles.spacing=20mm
bar_return|inputs/bar_return.yaml -s particles.spacing=4mm $few
back|$work/back.yaml
back_current|$work/back.yaml -s mpm.frame=current
bar_pulse|inputs/bar_pulse.yaml -s particles.spacing=8mm -s duration=0.6ms $few
static|inputs/edge_crack_k1.yaml -s particles.spacing=0.5mm -s probes=[tip]
relaxed|inputs/edge_crack_k1.yaml -s particles.spacing=1mm -s solver=relaxation -s probes=[tip]
spin|inputs/rigid_rotation.yaml -s particles.spacing=200mm -s duration=5ms $few"

# each_scene PATTERN COMMAND...: COMMAND NAME ARGUMENTS of every scene whose name has the pattern (grep -E).
each_scene()
{
    pattern=$1; shift
    echo "$scenes" | grep -E "^[a-z_]*($pattern)[a-z_]*\|" >"$work/each_scene"
    while IFS='|' read -r name arguments <&3; do "$@" "$name" $arguments; done 3<"$work/each_scene"
}

# instrumented FOLDER FLAGS SETTING...: a program built for a tool in a folder of its own, with these flags of the compiler and settings
# of make; from here on $cleave.
instrumented()
{
    folder=$1 flags=$2; shift 2
    if ! MAKEFLAGS= CFLAGS="$flags" CPPFLAGS="-DLEAVE=exit -DCLEAVE_ASSERT" make -j2 BUILD=$folder "$@" >"$work/said" 2>&1; then
        fail "no build in $folder: $(cat "$work/said")"
        finish
    fi
    cleave=$root/$folder/cleave
}
