#!/bin/sh
# Particles are created only where they are needed (mpm.fill): results must be equal to those with all particles, on any number of threads
# and after interruptions.
test_name=test_fill
. tests/support/summary.sh
. tests/support/trust.sh
. tests/support/scenes.sh
. tests/support/physics.sh

alike() { between "$1" "$(awk -v a="$2" -v b="$3" 'BEGIN { print (a - b) / a }')" "-$4" "$4"; }

# Kalthoff's plate at 0.5 mm: cracks run into cells that had no particles. Forces are equal; sums over particles have another grouping,
# which changes round-off.
plate="inputs/kalthoff_winkler.yaml -s particles.spacing=0.5mm -s time.step=0.05us -s duration=40us -s mpm.levels=3 -s output.frames=4"
calm "$work/all" $plate -s mpm.fill=all
calm "$work/needed" $plate -s mpm.fill=needed -t 1
sound needed 0.005
between "particles made" "$(f needed particles_made)" 20000 60000
between "particles of the body" "$(f needed particles)" 80600 80600
for figure in crack.start_time crack.length_end energy.kinetic energy.strain energy.fracture conversion.pd_share_end; do
    alike "$figure" "$(f all $figure)" "$(f needed $figure)" 1e-9
done
between "momentum" "$(f needed momentum_error)" 0 1e-13

twice_interrupted "$work/stopped" 30 60 $plate -s mpm.fill=needed
calm "$work/stopped" -t 2 --resume $plate -s mpm.fill=needed
same "on 2 threads, interrupted after 30 and 60 lines" "$work/needed" "$work/stopped"

# Contact of broken faces continues where particles are added, and its forces are in frames afterwards.
rubs="inputs/kalthoff_winkler.yaml -s particles.spacing=1mm -s duration=44us -s mpm.levels=2 -s conversion.criteria=[bond,stress] -s output.frames=2"
for fill in all needed; do calm "$work/rubs_$fill" $rubs -s mpm.fill=$fill; done
between "rubs: particles made" "$(f rubs_needed particles_made)" 15000 19000         # of 20150
between "rubs: pairs in contact" "$(f rubs_needed contact.pairs_max)" 1 20
for figure in contact.began contact.ended contact.overlap_max energy.kinetic; do
    alike "rubs: $figure" "$(f rubs_all $figure)" "$(f rubs_needed $figure)" 1e-9
done
holds "rubs: contact forces in the last frame" grep -q contact_force "$work/rubs_needed/frames/000002.hdf"

# Tractions on faces, a state-based family, a mirror midway between nodes of coarse cells: the particles that loads and mirrors need are
# created.
cat >"$work/pulled.yaml" <<EOF2
space: plane strain
thickness: 1 mm
duration: 8 us
method: adaptive
material: {young: 72 GPa, poisson: 0.2, density: 2440 kg/m^3, energy_release_rate: 20}
body: [{box: {from: [-40 mm, 0], to: [40 mm, 61 mm]}}]
particles: {spacing: 0.25 mm}
model: mospd
mpm: {levels: 3}
cracks: [{from: [-3.1 mm, 20.2 mm], to: [5.3 mm, 22.1 mm]}]
boundary:
  - {traction: [0, 12 MPa], face: y+, time: {ramp: {until: 4 us}}}
  - {mirror: {axis: y, at: 0, tangential: free}}
output: {frames: 1, samples: 40}
EOF2
calm "$work/pulled" "$work/pulled.yaml" -s mpm.fill=all
calm "$work/pulled_needed" "$work/pulled.yaml" -s mpm.fill=needed
between "particles made" "$(f pulled_needed particles_made)" 1000 15000
for figure in energy.kinetic energy.strain energy.external_work conversion.pd_share_end; do
    alike "pulled, $figure" "$(f pulled $figure)" "$(f pulled_needed $figure)" 1e-9
done

# Half of Kalthoff's plate behind a mirror: images of particles that are created later, and states of families.
cat >"$work/half.yaml" <<EOF2
space: plane stress
thickness: 10 mm
duration: 40 us
method: adaptive
model: ospd
material: {young: 190 GPa, poisson: 1/3, density: 7800 kg/m^3, energy_release_rate: 69 kJ/m^2}
body: [{box: {from: [0, 0], to: [100 mm, 100 mm]}}, {add: {box: {from: [-3 mm, 0], to: [0, 25 mm]}}}]
particles: {spacing: 0.5 mm}
pd: {normalisation: bulk, influence: one}
time: {step: 0.05 us}
mpm: {levels: 3}
cracks: [{from: [-4 mm, 25 mm], to: [50 mm, 25 mm], width: 0.3 mm}]
boundary:
  - {velocity: [22 m/s, free], region: {box: {from: [-3 mm, 0], to: [0, 25 mm]}}}
  - {mirror: {axis: y, at: 0, tangential: free}}
output: {frames: 1, samples: 40}
probes: [tip]
EOF2
calm "$work/half" "$work/half.yaml" -s mpm.fill=all
calm "$work/half_needed" "$work/half.yaml" -s mpm.fill=needed
between "half: a crack runs" "$(f half_needed crack.length_end)" 0.0125 0.05         # 14.5 mm at 40 us
for figure in crack.length_end energy.kinetic energy.strain energy.fracture; do
    alike "half: $figure" "$(f half $figure)" "$(f half_needed $figure)" 1e-9
done

# A sif ring in cells of eight spacings, crossed by a plane pulse: its particles are created, and stay when cells change.
cat >"$work/field.yaml" <<EOF2
space: plane strain
thickness: 1 mm
duration: 15 us
method: adaptive
material: {young: 72 GPa, poisson: 1/4, density: 2440}
body: {box: {from: [0, -50 mm], to: [50 mm, 50 mm]}}
particles: {spacing: 0.5 mm}
mpm: {levels: 2}
cracks: [{from: [-1 mm, 0], to: [10 mm, 0]}]
boundary:
  - {mirror: {axis: x, at: 0}}
  - {traction: [0, -1 MPa], face: y-, time: {pulse: {until: 10 us}}}
output: {frames: 0, samples: 30}
probes: [sif: {contours: [6 mm, 8 mm]}]
EOF2
calm "$work/ring" "$work/field.yaml" -s mpm.fill=all
calm "$work/ring_needed" "$work/field.yaml" -s mpm.fill=needed
between "ring: particles made" "$(f ring_needed particles_made)" 1000 4000
for figure in K_I K_II J contour_spread; do
    alike "ring: $figure" "$(f ring probes.sif.$figure)" "$(f ring_needed probes.sif.$figure)" 1e-9
done
calm "$work/ring_moves" "$work/field.yaml" -s material.energy_release_rate=1e9 -s mpm.fill=needed -s output.samples=2
between "a ring that may move: all are made" "$(f ring_moves particles_made)" 20000 20000

# A slit oblique to the lattice whose flanks convert before cells change, and a driven band that becomes coarse and breaks: points divided
# by slits and driven points are those of the start, and cells taken by bonds stay.
cat >"$work/slanted.yaml" <<EOF2
space: plane stress
thickness: 1 mm
duration: 15 us
material: {young: 72 GPa, density: 2440 kg/m^3, energy_release_rate: 135 J/m^2}
body: {box: {from: [0, 0], to: [80 mm, 50 mm]}}
particles: {spacing: 0.5 mm}
mpm: {levels: 2}
cracks: [{from: [-1 mm, 12 mm], to: [32 mm, 17 mm]}]
boundary:
  - {traction: [0, 5 MPa], face: y+, time: {ramp: {from: 0, until: 5 us}}}
  - {traction: [0, -5 MPa], face: y-, time: {ramp: {from: 0, until: 5 us}}}
output: {frames: 0}
EOF2
cat >"$work/band.yaml" <<EOF2
space: plane stress
thickness: 1 mm
duration: 15 us
method: adaptive
material: {young: 72 GPa, density: 2440 kg/m^3, energy_release_rate: 135 J/m^2}
body: {box: {from: [-16 mm, 0], to: [64 mm, 40 mm]}}
particles: {spacing: 0.4 mm, horizon: 3.015}
pd: {surface: none}
mpm: {levels: 2}
boundary:
  - {velocity: [free, 7.5 m/s], region: {box: {from: [-24 mm, 37.2 mm], to: [72 mm, 44 mm]}}, time: {pulse: {until: 8 us}}}
  - {fixed: [y], region: {box: {from: [-24 mm, -4 mm], to: [72 mm, 2.4 mm]}}}
output: {frames: 0}
EOF2
for scene in slanted band; do
    calm "$work/$scene" "$work/$scene.yaml" -s mpm.fill=all
    calm "$work/${scene}_needed" "$work/$scene.yaml" -s mpm.fill=needed
    for figure in energy.kinetic energy.strain particles_pd_end; do
        alike "$scene: $figure" "$(f $scene $figure)" "$(f ${scene}_needed $figure)" 1e-9
    done
    between "$scene: momentum" "$(f ${scene}_needed momentum_error)" 0 1e-13
done

finish
