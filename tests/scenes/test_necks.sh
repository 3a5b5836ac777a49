#!/bin/sh
# Advice of `cleave check` on narrow sections whose width is not a multiple of the spacing: ligaments beside holes, notches and slots,
# layers of a material, pieces of a line. Expected widths are those of the drawing; the expected error is the relative difference of the
# rows of particles, counted by hand, from the width.
test_name=test_necks
. tests/support/summary.sh
. tests/support/scenes.sh

cat >"$work/plate.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 1 us
accept: [steps]
method: mpm
material: {young: 70 GPa, density: 2700}
body: {box: {from: [0, 0], to: [40 mm, 10 mm]}}
particles: {spacing: 1 mm}
END
# checked [ARGUMENT...]: stores the output of check for the plate with these settings.
checked() { "$cleave" check "$work/plate.yaml" --no-trial "$@" >"$work/said" 2>&1; }

# named WHAT PART [ARGUMENT...]: checks that check reports the part (width, axis, position, rows, error), and that at the spacings that it
# offers check reports no part of this width.
named()
{
    what=$1 part=$2; shift 2
    checked "$@"
    holds "$what: $(cat "$work/said")" grep -q "^accuracy  *body body: $part; particles.spacing .* divides it" "$work/said"
    width=$(echo "$part" | sed 's/.*\(a part [0-9.]* m\).*/\1/')
    for spacing in $(sed -n "/$width /s/.*particles.spacing \([0-9.]*\) mm\( or \([0-9.]*\) mm\)* divides it/\1 \3/p" "$work/said"); do
        checked "$@" -s particles.spacing="$spacing mm"
        holds "$what at $spacing mm" sh -c "grep -q 'is sound$\|can be run[;,]' '$work/said' && ! grep -q '$width ' '$work/said'"
    done
}
# silent WHAT [ARGUMENT...]: checks that check reports no part.
silent()
{
    what=$1; shift
    checked "$@"
    holds "$what: $(cat "$work/said")" sh -c "grep -q 'is sound$\|can be run[;,]' '$work/said' && ! grep -q 'a part .* of particles\|its section' '$work/said'"
}

# ---- ligaments -----------------------------------------------------------------------------------------------------------

strip='{box: {from: [0, 0], to: [40 mm, 10 mm]}}'
cut() { echo "body=[${2:-$strip}, {subtract: {$1}}]"; }
named "below a hole" 'a part 0.0014 m wide along y, at (0.01, 0.0007) m, is represented by 0.001 m of particles: its sections are 28.6 % too small' \
    -s "$(cut 'disc: {centre: [10 mm, 10 mm], radius: 8.6 mm}')"
named "about a hole" 'a part 0.0024 m wide along [xy], at (.*) m (and 3 more like it), is represented by 0.002 m of particles: its sections are 16.7 % too small' \
    -s "$(cut 'disc: {centre: [20 mm, 20 mm], radius: 17.6 mm}' '{box: {from: [0, 0], to: [40 mm, 40 mm]}}')"
named "a quarter of a plate with a hole" 'a part 0.0024 m wide along x, at (0.0188, .*) m, is represented by 0.002 m of particles: .* 16.7 % too small' \
    -s "$(cut 'disc: {centre: [0, 0], radius: 17.6 mm}' '{box: {from: [0, 0], to: [20 mm, 40 mm]}}')" \
    -s 'boundary=[{mirror: {axis: x, at: 0}}, {mirror: {axis: y, at: 0}}]'
named "below a slot of one spacing" 'a part 0.0014 m wide along y, at (0.0105, 0.0007) m, is represented by 0.001 m of particles: its sections are 28.6 % too small' \
    -s "$(cut 'box: {from: [10 mm, 1.4 mm], to: [11 mm, 11 mm]}')"
named "below a slanted slot" 'a part 0.0016 m wide along y, at (0.021.*, 0.0008) m, is represented by 0.002 m of particles: its sections are 25.0 % too large' \
    -s "$(cut 'polygon: {corners: [[20.3 mm, 1.6 mm], [22.3 mm, 1.6 mm], [15.3 mm, 10.6 mm], [13.3 mm, 10.6 mm]]}')"
named "a ligament without particles" 'a part 0.0004 m wide along y, at (0.02, 0.0002) m, is represented by 0 m of particles: its sections are 100.0 % too small' \
    -s "$(cut 'disc: {centre: [20 mm, 10 mm], radius: 9.6 mm}')"
solid="-s space=solid -s thickness="
named "below a hole through a block" 'a part 0.0014 m wide along y, at (0.02, 0.0007, .*) m, is represented by 0.001 m of particles: its sections are 28.6 % too small' \
    $solid -s 'body=[{box: {from: [0, 0, 0], to: [40 mm, 10 mm, 8 mm]}},
        {subtract: {cylinder: {from: [20 mm, 10 mm, -1 mm], to: [20 mm, 10 mm, 9 mm], radius: 8.6 mm}}}]'

# Ligaments that the rows fit, wide plates, and bent or oblique strips of constant width.
silent "a ligament of two spacings" -s "$(cut 'disc: {centre: [10 mm, 10 mm], radius: 8 mm}')"
silent "a wide plate with a hole" \
    -s "$(cut 'disc: {centre: [50 mm, 30 mm], radius: 7.3 mm}' '{box: {from: [0, 0], to: [100 mm, 60 mm]}}')"
silent "a ring" -s 'body={ring: {centre: [0, 0], radius: 20 mm, inner: 16.7 mm}}'
silent "a slanted strip" -s 'body={box: {from: [0, 0], to: [60 mm, 5.5 mm]}, rotate: {angle: 40 deg}}'
silent "a slit in a plate" -s "$(cut 'box: {from: [10 mm, 9.8 mm], to: [30 mm, 10.4 mm]}' '{box: {from: [0, 0], to: [40 mm, 20 mm]}}')"
silent "a torus" $solid -s 'body={torus: {centre: [0, 0, 0], axis: [0, 0, 1], radius: 20 mm, section: 3.3 mm}}'

# ---- parts of equal width, layers, lines ---------------------------------------------------------------------------------

named "two arms" 'a part 0.0035 m wide along [xy], at (.*) m (and 1 more like it), is represented by 0.004 m of particles: its sections are 1[45].[0-9] % too large' \
    -s 'body={polygon: {corners: [[0, 0], [40 mm, 0], [40 mm, 3.5 mm], [3.5 mm, 3.5 mm], [3.5 mm, 40 mm], [0, 40 mm]]}}'
glued()
{
    how=$1 what=$2; shift 2
    $how "$what" "$@" -s material= -s 'materials=[{name: steel, young: 70 GPa, density: 2700}, {name: glue, young: 7 GPa, density: 2700}]'
}
layer() { echo "parts=[{region: {box: {from: [0, $1 mm], to: [40 mm, $2 mm]}}, material: glue}]"; }
glued named "a layer of glue" 'material glue: a part 0.0015 m wide along y, at (.*, 0.009[56].*) m, is represented by 0.001 m of particles: .* 33.[0-9] % too small' \
    -s 'body={box: {from: [0, 0], to: [40 mm, 20 mm]}}' -s "$(layer 8.8 10.3)"
glued silent "a layer of two spacings" -s "$(layer 4 6)"
line="-s space=line -s thickness= -s section=1e-6"
named "a bar in a line" 'a part 0.0135 m long, at 0.00675 m, is represented by 0.014 m of particles: it is 3.7 % too long' \
    $line -s 'body={box: {from: [0], to: [13.5 mm]}}'
glued named "glue in a line" 'material glue: a part 0.0054 m long, at 0.0227 m, is represented by 0.005 m of particles: it is 7.4 % too short' \
    $line -s 'body={box: {from: [0], to: [60 mm]}}' -s 'parts=[{region: {box: {from: [20 mm], to: [25.4 mm]}}, material: glue}]'
silent "a bar of whole spacings" $line -s 'body={box: {from: [0], to: [13 mm]}}'

finish
