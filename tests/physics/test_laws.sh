#!/bin/sh
# Flow laws through the whole engine: a bar of copper that hits a wall, with its energy, after a restart, and sheets in other spaces.
test_name=test_laws
. tests/support/summary.sh
. tests/support/scenes.sh
. tests/support/trust.sh
. tests/support/physics.sh

coarse="-s particles.spacing=0.8mm -s output.frames=2 -s output.samples=40"
start bar taylor_bar $coarse
start hot taylor_bar_jc $coarse
wait

# Length after the impact, for the half spacing from the last particle to the end of the bar. At 0.8 mm the bar is a tenth of a spacing
# longer than at 0.4 mm (21.4 to 21.5 mm).
length() { compute "1000 * ($2 + $(f $1 probes.point.displacement_z))"; }
between "bar: length [mm]" "$(length bar 0.0324)" 21.0 22.0
between "hot bar: length [mm]" "$(length hot 0.0254)" 16.4 17.8
for bar in bar hot; do
    is "$bar: status" "$(f $bar status)" done
    # Transfers take energy (FLIP: some tenths of a percent at this spacing); the law itself loses none.
    between "$bar: energy balance" "$(f $bar energy.balance_error)" -0.01 0.01
    between "$bar: momentum" "$(f $bar momentum_error)" 0 1e-12
done
between "hot bar: temperature of its end [K]" "$(f hot probes.point.temperature)" 294 320

# ---- sheets: a kinematic and a hardening law in every space, restart ------------------------------------------------------------

scene sheet <<'END'
space: plane strain
thickness: 1 mm
duration: 12 us
method: mpm
material: {young: 200 GPa, poisson: 0.3, density: 7800, yield_stress: 200 MPa, hardening: {voce: {saturation: 150 MPa, rate: 20}},
    kinematic: {modulus: 10 GPa, recall: 100}}
body: {box: {from: [0, 0], to: [10 mm, 4 mm]}}
particles: {spacing: 0.1 mm}
initial: [{velocity: [-100 m/s, 20 m/s]}]
boundary: [{name: wall, mirror: {axis: x, at: 0}}]
output: {frames: 3, samples: 200}
probes: [{point: {at: [0, 2 mm]}}]
END
law="{A: 200 MPa, B: 300 MPa, n: 0.3, C: 0.02, m: 1.1, T_room: 294 K, T_melt: 1700 K}"
hot="material={young: 200 GPa, poisson: 0.3, density: 7800, johnson_cook: $law, specific_heat: 450 J/(kg K), kinematic: {modulus: 1 GPa}}"
for space in "plane strain" "plane stress"; do
    for material in "material.name=steel" "$hot"; do
        name=sheet$((${sheets:=0} + 1)); sheets=$((sheets + 1))
        calm "$work/$name" "$work/sheet.yaml" -s "space=$space" -s "$material"
        # Kinetic energy becomes plastic work; what FLIP takes stays below 1 %.
        between "$space, $material: energy balance" "$(f $name energy.balance_error)" -0.01 0.01
        between "$space, $material: plastic work" "$(f $name energy.plastic)" 0.1 10
        # The kinetic energy, 40 MJ/m^3, over 300 MPa is a strain of 0.13 in the mean, several times as much at the wall.
        between "$space, $material: plastic strain" "$(f $name probes.point.plastic_strain)" 0.1 3
        # The scene as run reads back, and a restart has the same bits.
        calm "$work/echo$name" "$work/$name/scene.yaml"
        same "$space, $material: scene as run" "$work/$name" "$work/echo$name"
        interrupted "$work/stopped$name" 60 "$work/sheet.yaml" -s "space=$space" -s "$material"
        calm "$work/stopped$name" --resume "$work/sheet.yaml" -s "space=$space" -s "$material"
        same "$space, $material: after a restart" "$work/$name" "$work/stopped$name"
    done
done
finish
