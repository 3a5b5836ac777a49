#!/bin/sh
# Extreme input: numbers beyond the range of doubles, inverted cells, diverging energies, names with control characters of terminals.
test_name=test_bounds
. tests/support/summary.sh
. tests/support/trust.sh
small="inputs/kalthoff_winkler.yaml -s particles.spacing=4mm -s duration=5us -s output.frames=2"

# block TEXT...: writes the scene of a small block that ends with these lines.
block()
{
    cat <<'END'
space: plane stress
thickness: 1 mm
duration: 5 us
material: {young: 200 GPa, poisson: 1/3, density: 7800}
particles: {spacing: 1 mm}
body: {box: {from: [0, 0], to: [20 mm, 20 mm]}}
END
    printf '%s\n' "$@"
}

# ---- numbers ---------------------------------------------------------------------------------------------------

refused "nothing thick" "$work/r" "thickness: 1e-300 is not 0 but below 1e-30 in SI units, too small to be meant" $small -s thickness=1e-300
refused "nothing stiff" "$work/r" "young: 1e-300 is not 0 but below 1e-30" $small -s material.young=1e-300 -s material.density=1e30
refused "too dense" "$work/r" "density: 1e31 is above 1e30" $small -s material.density=1e31
stopped "as stiff as can be read" "$work/a" "unstable" $small -s material.young=1e-30 -s material.density=1e30 --overwrite
refused "a grid far away" "$work/r" "1e+20 m is more than 1e7 spacings from the origin" $small -s mpm.origin=[1e20,0]
refused "a grid where stresses are 3 % off" "$work/r" "more than 1e7 spacings" $small -s mpm.origin=[1e12,0]
calm "$work/far" $small -s mpm.origin=[30000,0]
for method in pd mpm adaptive; do
    for gradient in 1e10,0,0,0 0,1e29,0,0 -2,0,0,0; do
        block "method: $method" "initial: [{displacement_gradient: [$gradient]}]" >"$work/block.yaml"
        refused "$method, strained by $gradient" "$work/r" "initial" "$work/block.yaml"
    done
    block "method: $method" "initial: [{displacement_gradient: [0, 1000, 0, 0]}]" >"$work/block.yaml"
    stopped "$method, strained by 1000" "$work/b" "a smaller time step does not help: the scene starts with a strain of 1e+03" "$work/block.yaml" --overwrite
done

# ---- energies ----------------------------------------------------------------------------------------------------

# A few steps far above the critical one: displacements are small, velocities change sign in every step, and the balance closes.
for method in pd mpm; do
    for step in time.step=3us time.safety=1.2; do
        block "method: $method" "boundary: [{traction: [0, 12 MPa], face: y+}, {fixed: all, region: {box: {from: [-inf, -inf], to: [inf, 2 mm]}}}]" >"$work/block.yaml"
        stopped "$method, $step" "$work/swing" "velocities change sign in every step; choose a smaller ${step%=*} " "$work/block.yaml" -s $step --overwrite
    done
done

# Families that lose bonds under pressure: the energy balance includes the change of the remaining bonds.
for method in pd adaptive; do
    cat >"$work/pressed.yaml" <<END
space: plane strain
thickness: 1 mm
duration: 65 us
method: $method
model: ospd
pd: {normalisation: local}
material: {young: 1 GPa, poisson: 0.3, density: 2000, critical_stretch: 0.01}
body: {box: {from: [0, 0], to: [20 mm, 10 mm]}}
particles: {spacing: 0.5 mm}
boundary:
  - {region: {box: {from: [-inf, -inf], to: [1 mm, inf]}}, velocity: [60, 0], time: {ramp: {until: 50 us}}}
  - {region: {box: {from: [19 mm, -inf], to: [inf, inf]}}, velocity: [-60, 0], time: {ramp: {until: 50 us}}}
END
    stopped "$method, pressed" "$work/pressed" "of its energy gained without work of loads" "$work/pressed.yaml" --overwrite
done

# ---- speeds ------------------------------------------------------------------------------------------------------

block "initial: [{velocity_gradient: [1e29, 0, 0, 0]}]" >"$work/block.yaml"
stopped "started beyond all speeds" "$work/b" "the scene starts with" "$work/block.yaml" --overwrite
block | sed 's/body: .*/body: {box: {from: [1e6, 0], to: [1000000.02, 0.02]}}/' >"$work/block.yaml"
refused "a body far away" "$work/r" "beyond 1e7 spacings from the origin" "$work/block.yaml"

# ---- inverted cells ------------------------------------------------------------------------------------------------

block "method: mpm" "mpm: {frame: reference}" "boundary:" \
    "  - {name: base, velocity: [0, 0], region: {box: {from: [0, 0], to: [2 mm, 20 mm]}}}" \
    "  - {name: push, velocity: [-190, 0], region: {box: {from: [18 mm, 0], to: [20 mm, 20 mm]}}}" |
    sed 's/duration.*/duration: 100 us/' >"$work/fold.yaml"
stopped "pushed through itself" "$work/fold" "inverted at step .* at particle .*mpm.frame: current" "$work/fold.yaml"
calm "$work/fold" "$work/fold.yaml" -s duration=20us --overwrite

# ---- energies ------------------------------------------------------------------------------------------------------

block "method: mpm" "mpm: {frame: current, transfer: apic}" "initial: [{velocity_gradient: [0, 0, 0, 0]}]" "boundary:" \
    "  - {name: push, velocity: [-20, 0], region: {box: {from: [19 mm, 0], to: [20 mm, 20 mm]}}}" |
    sed 's/duration.*/duration: 100 us/' >"$work/lost.yaml"
warned "APIC beside a jump" "$work/lost" "of the energy is lost.*APIC damps" "$work/lost.yaml"
warned "and again, once it is over" "$work/lost" "of the energy is lost.*APIC damps" "$work/lost.yaml" --resume
block "method: pd" "solver: cg" "boundary:" "  - {name: pull, traction: [1e15, 0], face: x+}" "  - {name: base, mirror: {axis: x, at: 0}}" \
    "  - {name: side, mirror: {axis: y, at: 0}}" >"$work/pulled.yaml"
warned "an equilibrium of 5000 times the modulus" "$work/pulled" "times Young's modulus" "$work/pulled.yaml"
block "initial: [{velocity_gradient: [10, 0, 0, 0]}]" >"$work/block.yaml"
warned "a step 15 times the critical one" "$work/block" "the time step is too large" "$work/block.yaml" -s time.step=5us
"$cleave" check "$work/block.yaml" -s time.step=5us >"$work/out" 2>&1
holds "what one step costs" grep -q 'run time .* [0-9.e-]* s (.*) on' "$work/out"
is "no such time as nan" "$(grep -c 'nan' "$work/out")" 0

# ---- long horizons, many probes ------------------------------------------------------------------------------------

cat >"$work/long.yaml" <<'END'
space: solid
duration: 5 us
material: {young: 200 GPa, poisson: 0.25, density: 7800}
particles: {spacing: 1 mm, horizon: 10.5}
body: {box: {from: [0, 0, 0], to: [3 mm, 3 mm, 3 mm]}}
END
start=$(date +%s)
calm "$work/long" "$work/long.yaml"
between "27 particles and a horizon of 10.5 spacings: seconds" $(($(date +%s) - start)) 0 8
{ block "method: pd" "output: {frames: 4}" "probes:"; for k in $(seq 200); do echo "  - line: {name: l$k, from: [0, $k e-5], to: [20 mm, $k e-5]}"; done; } |
    sed 's/ e-5/e-5/g' >"$work/many.yaml"
"$cleave" check "$work/many.yaml" >"$work/out" 2>&1
holds "what 200 profiles a frame take is said" grep -q 'run time .*, of which [1-9][.0-9]* s for writing' "$work/out"

# ---- long lists in a scene ---------------------------------------------------------------------------------------

{ block "method: pd" "boundary: "; awk 'BEGIN { printf "  - {name: pull, traction: [1 MPa, 0], face: x+, time: {table: ["
    for (k = 0; k < 50000; k++) printf "%s[%d ns, %d]", k ? "," : "", k, k % 7; print "]}}" }'; } >"$work/table.yaml"
calm "$work/table" "$work/table.yaml"
{ block "cracks:"; awk 'BEGIN { for (k = 0; k < 3000; k++) print "  - {from: [" k * 1e-6 ", 0.001], to: [" k * 1e-6 ", 0.002]}" }'; } >"$work/cracks.yaml"
"$cleave" check --no-trial "$work/cracks.yaml" >"$work/out" 2>&1
is "3000 cracks: exit status" $? 0
[ "$(getconf _NPROCESSORS_ONLN)" -gt 15 ] || { "$cleave" run -q -o "$work/team" $small -t 33 2>"$work/err"; holds "33 threads: said" grep -q "^warning: 33 threads share" "$work/err"; }

# ---- names ---------------------------------------------------------------------------------------------------------

refused "a name that looks like an option" "$work/r" "name: -rf is not a name" $small -s name=-rf
escape=$(printf 'a\033[2Jb\302\233c\342\200\256d')
cp "$work/block.yaml" "$work/$escape.yaml"
"$cleave" run -o "$work/$escape" "$work/$escape.yaml" >"$work/out" 2>&1
"$cleave" check "$work/$escape.yaml" >>"$work/out" 2>&1
"$cleave" compare "$work/$escape" "$work/nowhere$escape" >>"$work/out" 2>&1
"$cleave" compare "$work/$escape" "$work/$escape" >>"$work/out" 2>&1
"$cleave" plot "$work/$escape" --size 90mmx70mm >>"$work/out" 2>&1
sed -i "1s/kinetic/$escape/" "$work/$escape/history.csv"
"$cleave" compare "$work/$escape" "$work/block" >>"$work/out" 2>&1
"$cleave" run -o "$work/r" "$work/$escape.yaml" -s "du$escape=1" >>"$work/out" 2>&1
"$cleave" "$escape" >>"$work/out" 2>&1
is "lines with a control character" "$(LC_ALL=C grep -c "$(printf '\033\|\302\233\|\342\200\256')" "$work/out")" 0
holds "the name, harmless" grep -q 'a?\[2Jb??c???d' "$work/out"

finish
