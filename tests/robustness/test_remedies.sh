#!/bin/sh
# Checks that the changes which a refusal recommends are possible: for each combination that a method or model does not support, the message
# has the expected words, and the scene passes `cleave check` with each of the recommended changes.
# Takes 10 s: 60 small scenes are read and set up.
test_name=test_remedies
. tests/support/summary.sh

# A plate that bonds can do. Each case adds what they cannot, or what excludes it.
cat >"$work/plate.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 10 us
method: pd
material: {name: m, young: 70 GPa, density: 2700}
bodies:
  - {name: plate, shape: {box: {from: [0, 0], to: [20 mm, 10 mm]}}}
particles: {spacing: 1 mm}
boundary:
  - {name: foot, fixed: all, face: x-}
  - {name: end, displacement: [1 um, free], face: x+, time: {ramp: {until: 10 us}}}
output: {frames: 0, samples: 1}
END
plate=$work/plate.yaml
# The same with a rigid wall below, and what takes its place: a plane of symmetry, and a body of a stiff material.
sed 's/^particles:/  - {name: wall, rigid: true, shape: {box: {from: [0, -5 mm], to: [20 mm, 0]}}}\n&/' "$plate" >"$work/wall.yaml"
sed 's/^boundary:/&\n  - {name: wall, mirror: {axis: y, at: 0}}/' "$plate" >"$work/mirror.yaml"
sed 's/^particles:/  - {name: wall, material: stiff, shape: {box: {from: [0, -5 mm], to: [20 mm, 0]}}}\n&/
    s/^material: \(.*\)/materials:\n  - \1\n  - {name: stiff, young: 700 GPa, density: 7800}/; s/- {name: plate,/& material: m,/' "$plate" >"$work/stiff.yaml"
wall=$work/wall.yaml

# refused PATTERN SCENE ARGUMENT...: checks that the scene with these arguments is refused with this text; stores both for `remedied`.
refused()
{
    pattern=$1 scene=$2; shift 2
    keep "$@"
    "$cleave" check "$scene" --no-trial "$@" >"$work/said" 2>&1
    is "refused: $pattern" $? 2
    holds "refused: $pattern: $(cat "$work/said")" grep -qF "$pattern" "$work/said"
}
keep() { printf '%s\n' "$@" >"$work/kept"; }

# remedied ARGUMENT...: checks that the scene refused last passes `cleave check` if these arguments follow the earlier ones. other SCENE
# ARGUMENT...: checks the same for another scene.
other() { scene=$1; shift; remedied "$@"; }
remedied()
{
    more=$# how=$*
    while IFS= read -r argument; do set -- "$@" "$argument"; done <"$work/kept"
    while [ $more -gt 0 ]; do first=$1; shift; set -- "$@" "$first"; more=$((more - 1)); done
    "$cleave" check "$scene" --no-trial "$@" >"$work/said" 2>&1
    holds "remedied: $pattern, by $scene $how: $(cat "$work/said")" grep -q ' is sound$\| can be run[;,]' "$work/said"
}
cook='-s material.johnson_cook.A=100MPa -s material.johnson_cook.B=100MPa -s material.johnson_cook.n=0.3 -s material.johnson_cook.C=0.01
    -s material.johnson_cook.T_melt=900'
yields='-s material.yield_stress=100MPa' soft='-s material.energy_release_rate=100 -s material.tensile_strength=10MPa'
steps='-s solver=static -s duration=1s'

# ---- Poisson's ratios --------------------------------------------------------------------------------------------------

refused 'which have 1/3 in space plane stress; use `model: ospd` for any ratio' "$plate" -s material.poisson=0.2
remedied -s model=ospd
refused 'use `model: ospd` for any ratio' "$plate" -s material.poisson=0.2 -s method=adaptive
remedied -s model=ospd
refused 'use `method: mpm` for any ratio' "$plate" -s material.poisson=0.2 $yields
remedied -s method=mpm
refused 'use `method: mpm` for any ratio' "$plate" -s material.poisson=0.2 $cook
remedied -s method=mpm
refused 'use the ratio of bonds, because no method allows another one together with rigid bodies and yield_stress' "$wall" -s material.poisson=0.2 $yields
remedied -s material.poisson=1/3
refused 'which have 1/3 in space plane stress; use `model: ospd` for any ratio' "$plate" -s material.poisson=0.2 $soft
remedied -s model=ospd
refused 'which have 1/4 in space plane strain; use `method: mpm` for any ratio' "$plate" -s material.poisson=0.2 -s 'space=plane strain' -s 'material.viscosity={}'
remedied -s method=mpm

# ---- rigid bodies ------------------------------------------------------------------------------------------------------

refused 'only: use `method: pd` or `method: adaptive`; a smooth wall at rest can be a boundary `mirror`' "$wall" -s method=mpm
remedied -s method=pd
remedied -s method=adaptive
other "$work/mirror.yaml"
refused 'only: use `method: pd` with `model: ospd` or `method: adaptive` with `model: ospd`' "$wall" -s method=mpm -s material.poisson=0.2
remedied -s method=pd -s model=ospd
remedied -s method=adaptive -s model=ospd
refused 'which do not allow a law of plasticity other than linear hardening; use a boundary `mirror` for' "$wall" -s method=mpm $cook
other "$work/mirror.yaml"
keep -s method=mpm -s 'materials.m.johnson_cook={A: 100 MPa, B: 100 MPa, n: 0.3, C: 0.01, T_melt: 900}'
other "$work/stiff.yaml"
refused "which do not allow a Poisson's ratio that bonds do not have and yield_stress; use a boundary" "$wall" -s method=mpm -s material.poisson=0.2 $yields
other "$work/mirror.yaml"
refused 'set `solver: explicit`; a smooth wall at rest can be a boundary `mirror`' "$wall" -s solver=cg
remedied -s solver=explicit
other "$work/mirror.yaml"

# ---- plasticity --------------------------------------------------------------------------------------------------------

refused 'the model ospd cannot yield; set `model: bond`' "$plate" -s model=ospd $yields
remedied -s model=bond
refused 'the model ospd cannot yield; set no key model' "$plate" -s method=mpm -s model=ospd $cook
remedied -s model=
refused 'the model mospd cannot yield; set `method: mpm` without the key model' "$plate" -s model=mospd -s material.poisson=0.2 $yields
remedied -s method=mpm -s model=
refused "no method has all of rigid bodies and a Poisson's ratio that bonds do not have and yield_stress; remove one" "$wall" -s model=ospd \
    -s material.poisson=0.2 $yields
remedied -s material.yield_stress=
remedied -s material.poisson= -s model=
refused 'works for material points only; use `method: mpm`, or yield_stress with linear hardening by yield_hardening, which bonds have' "$plate" $cook
remedied -s method=mpm
remedied -s material.johnson_cook= $yields -s material.yield_hardening=1GPa
refused '`method: mpm` without the key model, or yield_stress with linear hardening by yield_hardening, which bonds (`model: bond`) have at' \
    "$plate" -s model=ospd -s material.poisson=0.2 -s material.yield_stress=100MPa -s material.hardening.voce.saturation=1MPa -s material.hardening.voce.rate=1
remedied -s method=mpm -s model=
remedied -s material.hardening= -s model=bond -s material.poisson=1/3 -s material.yield_hardening=1GPa
refused 'works for material points only; use yield_stress with linear hardening by yield_hardening, which bonds have' "$wall" $cook
remedied -s material.johnson_cook= $yields -s material.yield_hardening=1GPa
refused 'material m yields; set solver: static (load steps), or explicit' "$plate" $yields -s solver=cg
remedied -s solver=explicit
refused 'material m yields; set solver: static (load steps), or explicit' "$plate" $yields -s solver=cg -s method=mpm
remedied -s solver=explicit
remedied -s solver=static

# ---- strength ----------------------------------------------------------------------------------------------------------

refused 'needs bonds that can soften; set `method: pd` or `method: adaptive`' "$plate" $soft -s method=mpm
remedied -s method=pd
remedied -s method=adaptive
refused 'set solver: explicit or static' "$plate" $soft -s solver=cg
remedied -s solver=explicit
remedied $steps
refused 'set solver: explicit or static' "$plate" $soft -s material.compressive_strength=300MPa -s solver=cg
remedied -s solver=explicit
remedied $steps
refused 'need method: pd; set it, or remove tensile_strength' "$plate" $soft $steps -s method=adaptive
remedied -s method=pd
remedied -s method=pd -s model=ospd
refused 'cannot be combined with yield_stress' "$plate" $soft $yields
remedied -s material.yield_stress=
remedied -s material.tensile_strength=

# ---- solvers, faces, interfaces ----------------------------------------------------------------------------------------

refused 'with material points set solver: relaxation' "$plate" -s solver=cg -s method=mpm
remedied -s solver=relaxation
refused 'so friction has no effect' "$plate" -s contact.friction=0.3
remedied -s contact.friction=0
remedied -s contact.between=all
refused 'the correction `moments` needs a regular lattice in 2D or 3D; set pd.surface: volume or none' "$plate" -s pd.surface=moments -s particles.irregularity=0.1
remedied -s pd.surface=volume
remedied -s pd.surface=none
refused 'the correction `moments` needs a regular lattice in 2D or 3D; set pd.surface: none' "$plate" -s pd.surface=moments -s particles.irregularity=0.1 -s model=ospd
remedied -s pd.surface=none
refused 'cannot be used in space plane stress' "$plate" -s 'material.viscosity={}'
remedied -s 'space=plane strain'
refused 'a static equilibrium has no velocities to damp; remove damping, or set solver: explicit' "$plate" -s damping=1e3 -s solver=cg
remedied -s solver=explicit
sed 's/^particles:/interfaces: [{bodies: [plate, wall]}]\n&/' "$work/stiff.yaml" >"$work/joined.yaml"
refused 'by their grid (method: mpm) only; set `method: pd` or `method: mpm`' "$work/joined.yaml" -s method=adaptive
remedied -s method=pd
remedied -s method=mpm
refused 'space plane stress; use `method: pd` with `model: ospd` or `method: mpm` for any ratio' "$work/joined.yaml" -s method=adaptive -s materials.m.poisson=0.2
remedied -s method=pd -s model=ospd
remedied -s method=mpm

finish
