#!/bin/sh
# Advice of `cleave check` on shapes and lists of particles: isolated particles, curves of meshes, inclined faces, lists that are lattices,
# sections that spacings do not divide. Each case has a control without advice.
# Takes 12 s: 50 scenes are set up, a few run.
test_name=test_meant_shapes
. tests/support/summary.sh
. tests/support/scenes.sh
. tests/support/advice.sh

# ---- isolated particles ------------------------------------------------------------------------------------------------

# 10 x 4 particles, and one 20 spacings away from them.
awk 'BEGIN { print "x [mm], y [mm]"; for (i = 0; i < 10; i++) for (j = 0; j < 4; j++) print i + 0.5 ", " j + 0.5; print "30.5, 0.5" }' \
    >"$work/lone.csv"
cat >"$work/lone.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 1 us
method: pd
material: {young: 70 GPa, density: 2700}
bodies: [{name: p, particles: lone.csv}]
particles: {spacing: 1 mm}
output: {frames: 0, samples: 1}
END
lone="body p: 1 of its particles has no neighbour, the first at (0.0305, 0.0005) m, so nothing holds it"
says "alone" "warning: $lone; check the shape or list there (" "$work/lone.yaml"
says "alone, of material points" "warning: $lone; check the shape or list there (" "$work/lone.yaml" -s method=mpm
says "alone, and an equilibrium" "warning: $lone; remove such particles, because no equilibrium exists" "$work/lone.yaml" -s solver=cg \
    -s 'boundary=[{fixed: all, face: x-, depth: 1 mm}]'
"$cleave" run "$work/lone.yaml" -q -o "$work/lone" >/dev/null 2>"$work/said"
holds "alone: the run says it: $(cat "$work/said")" grep -qF "$lone" "$work/said"
printf '31.5, 0.5\n31.5, 1.5\n' >>"$work/lone.csv"
says "an island" 'pieces  *body p consists of 2 parts without bonds between them; all parts but the heaviest have 3 particles together, and the second heaviest is at (0.03117, 0.0008333) m; parts that touch pass through each other; set contact.between: all to prevent this$' \
    "$work/lone.yaml"
says "an island, and an equilibrium" 'pieces .*; some parts have no support, so no equilibrium exists' "$work/lone.yaml" -s solver=cg \
    -s 'boundary=[{fixed: all, face: x-, depth: 1 mm}]'
sed -i '/^3[01]/d' "$work/lone.csv"
silent "none alone" 'no neighbour\|^pieces' "$work/lone.yaml"

# ---- curves ------------------------------------------------------------------------------------------------------------

# A quarter ring of one element with 8 nodes, 1 m to 2 m: parabolas through 0, 45 and 90 degrees bound 2.356 m^2 minus 0.9 %: circle and
# parabola over a chord of 2 r sin 45 with a sagitta of r (1 - cos 45) enclose (pi/4 - 1/2) r^2 and 2/3 of the product, 3 (0.2854 - 0.2761).
awk 'BEGIN { pi = atan2(0, -1); print "*NODE"; n = 0
    split("1 2 2 1 1.5 2 1.5 1", r); split("0 0 90 90 0 45 90 45", a)
    for (k = 1; k <= 8; k++) printf "%d, %.12f, %.12f\n", k, r[k] * cos(a[k] * pi / 180), r[k] * sin(a[k] * pi / 180)
    print "*ELEMENT, TYPE=CPS8\n1, 1, 2, 3, 4, 5, 6, 7, 8" }' >"$work/arc.inp"
cat >"$work/arc.yaml" <<'END'
space: plane stress
thickness: 0.1 m
duration: 1 ms
method: mpm
material: {young: 210 GPa, density: 7800}
body: {mesh: {file: arc.inp, unit: m}}
particles: {spacing: 20 mm}
END
says "a ring of one element" 'encloses 2.328 m^2' "$work/arc.yaml"
between "its particles, of 4e-4 m^2" "$(awk '/^particles/ { print $2 + 0 }' "$work/said")" 5790 5850

# ---- faces -------------------------------------------------------------------------------------------------------------

# Cook's membrane: its left side, 44 mm long, and behind it the upper side, which rises by 16 mm over 48 mm, are completely visible along x;
# so are its right side, 16 mm long, and the lower one, which rises by 44 mm. Also as a list of particles.
cat >"$work/cook.yaml" <<'END'
space: plane strain
thickness: 5 mm
duration: 1 s
method: mpm
solver: static
steps: {number: 1}
material: {young: 70 MPa, poisson: 1/3, density: 1000}
body: {polygon: {corners: [[0, 0], [48 mm, 44 mm], [48 mm, 60 mm], [0, 44 mm]]}}
particles: {spacing: 1 mm}
boundary:
  - {name: wall, fixed: all, face: x-, depth: 1 mm}
  - {name: end, traction: [0, 6.25 kPa], face: x+, time: {ramp: {until: 1 s}}}
END
cook=$work/cook.yaml
says "a support on a slope" '^support .*; on 27 % of the area seen from x- the surface is inclined to this direction, by 72 degrees on average: a region with x <= 0.001 m excludes it' "$cook"
says "a load on a slope" '^load .*; on 73 % of the area seen from x+ the surface is inclined to this direction, by 47 degrees on average: a region with x >= 0.047 m excludes it' "$cook"
silent "with regions" "other normals" "$cook" -s 'boundary=[{fixed: all, face: x-, depth: 1 mm, region: {box: {from: [-inf, -inf], to: [0.7 mm, inf]}}},
    {traction: [0, 6.25 kPa], face: x+, region: {box: {from: [47.4 mm, -inf], to: [inf, inf]}}}]'
awk 'BEGIN { print "x [mm], y [mm]"; for (x = 0.5; x < 48; x++) for (y = 0.5; y < 60; y++)
    if (y >= 44 / 48 * x && y <= 44 + 16 / 48 * x) print x ", " y }' >"$work/cook.csv"
says "a list" '^load .*; on 7[0-9] % of the area seen from x+ the surface is inclined to this direction, by 4[3-9] degrees on average: a region with x >= 0.047 m excludes it' \
    "$cook" -s "bodies=[{name: p, particles: $work/cook.csv}]" -s body= -s solver=explicit -s steps= -s method=pd -s material.poisson=1/4 -s duration=1ms \
    -s 'boundary=[{traction: [0, 6.25 kPa], face: x+}]'
silent "a box" "other normals" "$cook" -s 'body={box: {from: [0, 0], to: [48 mm, 20 mm]}}'

# ---- lists ---------------------------------------------------------------------------------------------------------------

# A bar of 30 x 5 x 5 particles, written with all digits and with six, shifted by a third of a spacing along x, is equivalent to the box:
# moments, equal stiffness. With an irregularity of a thousandth of a spacing it is not a lattice, and check reports the error of thin
# parts.
awk -v work="$work" 'BEGIN { srand(1); print "x [mm], y [mm], z [mm], volume [mm^3]" >work "/bar.csv"; print "x y z" >work "/decimals.csv"
    for (k = 0; k < 5; k++) for (j = 0; j < 5; j++) for (i = 0; i < 30; i++) {
        print i + 0.5 "," j + 0.5 "," k + 0.5 ",1" >work "/bar.csv"
        printf "%.6g %.6g %.6g\n", (i + 5 / 6) / 1000, (j + 5 / 6) / 1000, (k + 5 / 6) / 1000 >work "/decimals.csv" } }'
awk -F, 'NR == 1 { print; next } { printf "%.9f,%s,%s,%s\n", $1 + 0.004 * (NR % 2), $2, $3, $4 }' "$work/bar.csv" >"$work/shaken.csv"
cat >"$work/bar.yaml" <<'END'
space: solid
duration: 1 s
method: pd
solver: cg
variables: {a: 0}
material: {young: 70 GPa, density: 2700}
bodies: [{name: p, particles: bar.csv}]
particles: {spacing: 1 mm}
boundary: [{mirror: {axis: x, at: a}}, {traction: [1 MPa, 0, 0], face: x+}]
output: {frames: 0, samples: 1}
END
bar=$work/bar.yaml box='body={box: {from: [0, 0, 0], to: [30 mm, 5 mm, 5 mm]}}' third='variables.a=1 mm/3'
strain() { folder=$1; shift; "$cleave" run "$bar" -q -o "$work/$folder" "$@" >/dev/null 2>&1; figure "$work/$folder" energy.strain; }
whole=$(strain whole -s bodies= -s "$box")
near "a lattice as a list" "$(strain list)" "$whole" 1e-9
near "a lattice as a list in decimals" "$(strain decimals -s bodies.p.particles="$work/decimals.csv" -s "$third")" "$whole" 1e-6
says "a lattice as a list" '^accuracy  *body p: a part is 0.005 m thick, which is 1.66 horizons' "$bar"
says "a list that is none" '^accuracy  *body p: parts of it (from a particle list) are only 5 layers of particles thick, so with pd.surface: volume .* 39 % in bending and tension, 50 % in twisting; with pd.surface: moments by about 3 % in bending and tension, 15 %' "$bar" \
    -s bodies.p.particles="$work/shaken.csv"
weights='the particles of its list are not on a lattice along the axes, which pd.weights: isotropic assumes'
says "weights of a list that is no lattice" "^accuracy  *body p: $weights" "$bar" -s bodies.p.particles="$work/shaken.csv"
silent "weights of a lattice" "$weights" "$bar"
silent "equal weights" "$weights" "$bar" -s bodies.p.particles="$work/shaken.csv" -s pd.weights=uniform

# ---- sections ------------------------------------------------------------------------------------------------------------

# A frame whose ribs are 2.5 spacings wide has three rows in the lower and the upper rib, 20 % too many: sections of 1024 positions each
# have an accuracy of 1 %. A spacing offered by check divides them. Oblique or round parts agree with the mean of their sections.
cat >"$work/frame.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 10 us
method: mpm
material: {young: 70 GPa, poisson: 0.3, density: 2700}
body:
  - box: {from: [0, 0], to: [60 mm, 20 mm]}
  - subtract: {box: {from: [10 mm, 2.5 mm], to: [50 mm, 17.5 mm]}}
particles: {spacing: 1 mm}
END
frame=$work/frame.yaml solid="-s space=solid -s thickness="
# ribs WHAT WIDTH AXIS OFF [ARGUMENT...]: checks that check reports a part of this width [m] along the axis with this error in percent, and
# at both spacings that it offers does not.
ribs()
{
    what=$1 width=$2 axis=$3 off=$4; shift 4
    says "$what" "^accuracy  *body body: a part $width m wide along $axis, at .* its sections are .* divides it" "$frame" "$@"
    between "$what" "$(sed -n "s/.* a part $width m .* sections are \([0-9.]*\) %.*/\1/p" "$work/said")" "$(compute "$off - 1")" "$(compute "$off + 1")"
    for spacing in $(sed -n "s/.* a part $width m .*particles.spacing \([0-9.]*\) mm or \([0-9.]*\) mm divides it/\1 \2/p" "$work/said"); do
        silent "$what at $spacing mm" "a part $width m" "$frame" "$@" -s particles.spacing="${spacing}mm"
    done
}
ribs "ribs of a frame" 0.0025 y 20
says "a strip half a spacing beside the lattice" 'a part 0.003 m wide .*: its sections are 33.* % too large; particles.spacing divides its width, but its faces' "$frame" \
    -s 'body=[{box: {from: [0, 0], to: [40 mm, 20 mm]}}, {box: {from: [40 mm, 8.5 mm], to: [60 mm, 11.5 mm]}}]'
silent "a strip on the lattice" 'a part 0.003 m wide' "$frame" \
    -s 'body=[{box: {from: [0, 0], to: [40 mm, 20 mm]}}, {box: {from: [40 mm, 8 mm], to: [60 mm, 11 mm]}}]'
ribs "a web on a flange" 0.0026 x 15.4 -s 'body=[{box: {from: [0, 0], to: [60 mm, 20 mm]}}, {box: {from: [20 mm, 20 mm], to: [22.6 mm, 40 mm]}}]'
ribs "a plate" 0.0033 z 9.1 $solid -s 'body={box: {from: [0, 0, 0], to: [60 mm, 20 mm, 3.3 mm]}}'
ribs "an extruded strip" 0.0033 y 9.1 $solid -s 'body={extrude: {shape: {polygon: {corners: [[0, 0], [20 mm, 0], [20 mm, 3.3 mm], [0, 3.3 mm]]}},
    along: z, from: 0, to: 30 mm}}'
cat >"$work/strip.inp" <<'END'
*NODE
1, 0, 0
2, 60, 0
3, 60, 3.3
4, 0, 3.3
*ELEMENT, TYPE=CPS4
1, 1, 2, 3, 4
END
ribs "a strip as a mesh" 0.0033 y 9.1 -s "body={mesh: {file: $work/strip.inp, unit: mm}}"
says "a thin rod" '^accuracy  *body body: its section across x at .* m is 2[5-8].[0-9] % too large' "$frame" $solid \
    -s 'body={cylinder: {from: [0, 0, 0], to: [60 mm, 0, 0], radius: 2.3 mm}}'
for shape in 'disc: {centre: [0, 0], radius: 20 mm}' 'box: {from: [0, 0], to: [60 mm, 3.3 mm]}, rotate: {angle: 30 deg}' \
    'box: {from: [0, 0], to: [60 mm, 30.4 mm]}' 'polygon: {corners: [[0, 0], [60 mm, 0], [60 mm, 3 mm], [0, 6 mm]]}'; do
    silent "even: $shape" 'sections are\|its section' "$frame" -s "body={$shape}"
done

# ---- lists without volumes ---------------------------------------------------------------------------------------------

# 20 x 10 particles of a list without volumes, which get the volume of the spacing.
awk 'BEGIN { print "x [mm], y [mm]"; for (i = 0; i < 20; i++) for (j = 0; j < 10; j++) print 2 * i ", " 2 * j }' >"$work/lone.csv"
apart='lone.csv has no volumes, so each particle gets that of the spacing of 0.001 m, but nearest neighbours are 0.002 m apart.*particles.spacing: 0.002 m,'
says "a list wider than its spacing" "warning: .*$apart" "$work/lone.yaml"
says "a list denser than its spacing" 'the spacing of 0.004 m, but nearest neighbours are 0.002 m apart' "$work/lone.yaml" -s particles.spacing=4mm
says "a lattice a little wider" 'the spacing of 0.0018 m, but nearest neighbours are 0.002 m apart' "$work/lone.yaml" -s particles.spacing=1.8mm
says "a lattice a little denser" 'the spacing of 0.0021 m, but nearest neighbours are 0.002 m apart' "$work/lone.yaml" -s particles.spacing=2.1mm
# Equilateral triangles of the same area have sides of 1.0746 spacings.
awk 'BEGIN { print "x [mm], y [mm]"; a = 2 * 1.0745699
    for (i = 0; i < 20; i++) for (j = 0; j < 10; j++) printf "%.7f, %.7f\n", a * (i + 0.5 * (j % 2)), a * j * sqrt(0.75) }' >"$work/hexagons.csv"
silent "triangles of the same area" 'apart: masses' "$work/lone.yaml" -s bodies.p.particles=hexagons.csv -s particles.spacing=2mm
silent "a list at its spacing" 'apart: masses' "$work/lone.yaml" -s particles.spacing=2mm
"$cleave" run "$work/lone.yaml" -q -o "$work/wide" >/dev/null 2>"$work/said"
holds "the run says it: $(cat "$work/said")" grep -q "$apart" "$work/said"
awk -F, 'NR == 1 { print $0 ", volume [mm^3]"; next } { print $0 ", 4" }' "$work/lone.csv" >"$work/wide.csv"
silent "a wide list with volumes" 'apart: masses' "$work/lone.yaml" -s bodies.p.particles=wide.csv
# Areas in place of volumes, as other programs have in the plane: the thickness is 0.003 m.
says "a list of areas" 'wide.csv: volumes are 0.333 times the distance of nearest neighbours (0.002 m)^2 times the thickness, so masses .*areas, multiply' "$work/lone.yaml" -s bodies.p.particles=wide.csv -s thickness=3mm

finish
