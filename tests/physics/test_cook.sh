#!/bin/sh
# Cook's membrane at Poisson's ratio 0.4999 in one load step, in plane strain and in 3D: the cells of the reference frame do not lock.
# Reference: with quadratic finite elements the upper corner moves by 27.4 to 27.6 um. At 16 to 48 cells it moves less, by up to 6 %.
test_name=test_cook
. tests/support/summary.sh
. tests/support/scenes.sh
. tests/support/trust.sh
. tests/support/physics.sh

scene cook <<'END'
variables: {h: 0.5 mm}
space: plane strain
thickness: 5 mm
duration: 1 s
method: mpm
solver: static
steps: {number: 1}
material: {young: 70 MPa, poisson: 0.4999, density: 1000}
body: {polygon: {corners: [[0, 0], [48 mm, 44 mm], [48 mm, 60 mm], [0, 44 mm]]}}
particles: {spacing: h}
boundary:
  - {name: wall, fixed: all, region: {box: {from: [-inf, -inf], to: [h, inf]}}}
  - {name: end, traction: [0, 6.25 kPa], face: x+, region: {box: {from: [47 mm, -inf], to: [inf, inf]}}, time: {ramp: {until: 1 s}}}
probes: [{point: {name: corner, at: [48 mm, 60 mm]}}, {reaction: {name: wall, boundary: wall}}]
output: {frames: 0}
END

# The steps of the lattice make the loaded face longer than 16 mm: the displacement is that under the reaction of 0.5 N. The layer that is
# held shortens the membrane by a quarter of a cell, 0.5 % at 0.5 mm; the rest is the error of the cells.
for h in 1.5 0.75 0.5; do
    calm "$work/cook$h" "$work/cook.yaml" -s "variables.h=$h mm"
    moved=$(compute "1e6 * $(f cook$h probes.corner.displacement_y) * 0.5 / $(f cook$h probes.wall.force_max)")
    case $h in
        1.5) between "16 cells: corner [um]" "$moved" 25.8 27.6 ;;
        0.75) between "32 cells: corner [um]" "$moved" 26.6 27.6 ;;
        *) between "48 cells: corner [um]" "$moved" 26.9 27.6 ;;
    esac
done

# A slab of two points across that does not move along z, so that supports hold a component of all loaded points. Its cells spread a change of
# dilatation over three strains, those of the plane over two: 0.2 %.
scene slab <<'END'
variables: {h: 1.5 mm}
space: solid
duration: 1 s
method: mpm
solver: static
steps: {number: 1}
material: {young: 70 MPa, poisson: 0.4999, density: 1000}
body: {extrude: {shape: {polygon: {corners: [[0, 0], [48 mm, 44 mm], [48 mm, 60 mm], [0, 44 mm]]}}, from: 0, to: 2*h}}
particles: {spacing: h}
boundary:
  - {name: wall, fixed: all, region: {box: {from: [-inf, -inf, -inf], to: [h, inf, inf]}}}
  - {name: end, traction: [0, 6.25 kPa, 0], face: x+, region: {box: {from: [47 mm, -inf, -inf], to: [inf, inf, inf]}}, time: {ramp: {until: 1 s}}}
  - {name: sides, fixed: [z], region: {box: {from: [-inf, -inf, -inf], to: [inf, inf, inf]}}}
probes: [{point: {name: corner, at: [48 mm, 60 mm, 0]}}, {reaction: {name: wall, boundary: wall}}]
output: {frames: 0}
END
calm "$work/slab" "$work/slab.yaml"
near "in space as in plane strain, 16 cells: corner" "$(f slab probes.corner.displacement_y)" "$(f cook1.5 probes.corner.displacement_y)" 4e-3
near "in space as in plane strain, 16 cells: force over depth" "$(compute "$(f slab probes.wall.force_max)/3")" "$(compute "$(f cook1.5 probes.wall.force_max)/5")" 1e-4
finish
