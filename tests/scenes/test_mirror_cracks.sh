#!/bin/sh
# Cracks near a plane of symmetry: half a body with a mirror must be equivalent to the whole body with each crack and its image, with
# bonds and adaptive, in 2D and 3D; momentum must be conserved to round-off.
# Takes 25 s: each half is run together with the whole body.
test_name=test_mirror_cracks
. tests/support/summary.sh
. tests/support/trust.sh
. tests/support/scenes.sh
. tests/support/physics.sh

# alike NAME SCALE WITHIN COLUMN...: checks that these columns of the history of the half, times SCALE, equal those of the whole body
# within WITHIN of their largest value.
alike()
{
    folder=$1 scale=$2 within=$3; shift 3
    for name in "$@"; do
        off=$(awk -F, -v name="$name" -v scale="$scale" '
            FNR == 1 { file++; for (k = 1; k <= NF; k++) { title = $k; sub(/ \[.*/, "", title); if (title == name) at = k }; next }
            file == 1 { half[FNR] = scale * $at; next }
            { size = $at < 0 ? -$at : $at + 0; if (size > most) most = size
              gap = half[FNR] - $at; if (gap < 0) gap = -gap; if (gap > worst) worst = gap; n++ }
            END { if (n > 5 && most > 0) printf "%.3g", worst / most }' "$work/half_$folder/history.csv" "$work/whole_$folder/history.csv")
        between "$folder: $name of the half and of the whole" "$off" 0 "$within"
    done
}

# energies NAME ENERGY...: checks that these energies of the half at the end are half of those of the whole body, within $round_off.
# Weights of bonds near faces are fitted to a relative gradient of 1e-12, so that both differ by 2e-10 with some kernels. Without weights
# the same bonds are summed in another order over some hundred steps: 1e-12 measured.
round_off=1e-9
energies()
{
    folder=$1; shift
    for energy in "$@"; do
        off=$(awk -v a="$(f "half_$folder" energy.$energy)" -v b="$(f "whole_$folder" energy.$energy)" \
            'BEGIN { if (b > 0) printf "%.3g", 2 * a / b - 1 }')
        between "$folder: $energy of the half and of the whole" "$off" "-$round_off" "$round_off"
    done
}

# both NAME HALF_BODY WHOLE_BODY CRACKS ALL_CRACKS [ARGUMENT...]: runs the scene `all` as half the body with the mirror and as the whole
# body, and compares both.
both()
{
    folder=$1 part="body=$2" all="body=$3" cracks="cracks=[$4]" twice="cracks=[$5]"; shift 5
    sed '/name: below/d' "$work/all.yaml" >"$work/half.yaml"
    sed '/mirror: {axis: y/d' "$work/all.yaml" >"$work/whole.yaml"
    calm "$work/half_$folder" "$work/half.yaml" -s "$part" -s "$cracks" "$@"
    calm "$work/whole_$folder" "$work/whole.yaml" -s "$all" -s "$twice" "$@"
    between "$folder: momentum of the half" "$(f half_$folder momentum_error)" 0 1e-12
    between "$folder: balance of the half" "$(f half_$folder energy.balance_error)" -0.01 0.01
    energies $folder kinetic strain external_work fracture
    alike $folder 1 1e-8 face.displacement_y face.velocity_x sliver.displacement_y sliver.velocity_x beside.displacement_x
    between "$folder: bonds break" "$(f half_$folder energy.fracture)" 1e-9 1e9
}

# ---- 2D ---------------------------------------------------------------------------------------------------------------------

cat >"$work/all.yaml" <<END
space: plane stress
thickness: 1 mm
duration: 9 us
material: {young: 72 GPa, poisson: 1/3, density: 2440 kg/m^3, energy_release_rate: 30 J/m^2}
body: {box: {from: [0, 0], to: [40 mm, 20 mm]}}
particles: {spacing: 0.5 mm, horizon: 3.015}
boundary:
  - {mirror: {axis: y, at: 0}}
  - {traction: [0, 20 MPa], face: y+}
  - {traction: [20 MPa, 0], face: x+}
  - {traction: [-20 MPa, 0], face: x-}
  - {name: below, traction: [0, -20 MPa], face: y-}
time: {step: 0.05 us}
output: {frames: 1, samples: 60}
probes:
  - point: {name: face, at: [17.25 mm, 0.75 mm]}
  - point: {name: sliver, at: [17.25 mm, 0.25 mm]}
  - point: {name: beside, at: [19.75 mm, 2.25 mm]}
END
half="{box: {from: [0, 0], to: [40 mm, 20 mm]}}" whole="{box: {from: [0, -20 mm], to: [40 mm, 20 mm]}}"
along="{from: [10.1 mm, 0.7 mm], to: [25.1 mm, 0.7 mm]}"
slant="{from: [14.6 mm, 0.4 mm], to: [21.4 mm, 8.1 mm]}"
for method in pd adaptive; do
    both along_$method "$half" "$whole" "$along" "$along, {from: [25.1 mm, -0.7 mm], to: [10.1 mm, -0.7 mm]}" -s method=$method
    both slant_$method "$half" "$whole" "$slant" "$slant, {from: [21.4 mm, -8.1 mm], to: [14.6 mm, -0.4 mm]}" -s method=$method
    # Parts beyond the mirror are ignored.
    both into_$method "$half" "$whole" "{from: [20.1 mm, -3 mm], to: [20.1 mm, 8.1 mm]}" \
        "{from: [20.1 mm, -8.1 mm], to: [20.1 mm, 8.1 mm]}" -s method=$method
done

# A crack in the mirror that ends in it.
for method in pd adaptive; do
    in="{from: [-1 mm, 0], to: [17.1 mm, 0]}"
    both within_$method "$half" "$whole" "$in" "$in" -s method=$method
done
round_off=1e-11
both unweighted "$half" "$whole" "$in" "$in" -s method=pd -s pd.surface=none
both unweighted_along "$half" "$whole" "$along" "$along, {from: [25.1 mm, -0.7 mm], to: [10.1 mm, -0.7 mm]}" -s method=pd -s pd.surface=none
round_off=1e-9
is "a slit in the mirror" "$(f half_within_adaptive conversion.notches.0)" "slit of the mesh, with bonds within 8 spacings of its ends"

# Other settings that conserve momentum, although the whole has other damped pairs, or other coarse cells.
for other in mpm.frame=current mpm.levels=1; do
    calm "$work/half_other" "$work/half.yaml" -s "body=$half" -s "cracks=[$along]" -s $other
    between "$other: momentum of the half" "$(f half_other momentum_error)" 0 1e-12
    rm -r "$work/half_other"
done

# Families: the deficit of an image's own family counts in partial stresses. (The recorded fracture energy agrees to 6e-5.)
calm "$work/half_families" "$work/half.yaml" -s "body=$half" -s "cracks=[$along]" -s model=ospd
calm "$work/whole_families" "$work/whole.yaml" -s "body=$whole" -s model=ospd \
    -s "cracks=[$along, {from: [25.1 mm, -0.7 mm], to: [10.1 mm, -0.7 mm]}]"
between "families: momentum of the half" "$(f half_families momentum_error)" 0 1e-12
energies families kinetic strain external_work

# Cracks with prescribed growth, a spacing and a half from the mirror. (The recorded fracture energy agrees to 1e-6.)
grows="growth=[{at: [25.1 mm, 0.7 mm], direction: [1, 0.02], speed: 1000 m/s}"
for method in pd adaptive; do
    calm "$work/half_grows_$method" "$work/half.yaml" -s "body=$half" -s "cracks=[$along]" -s "$grows]" -s method=$method
    calm "$work/whole_grows_$method" "$work/whole.yaml" -s "body=$whole" -s method=$method \
        -s "cracks=[$along, {from: [25.1 mm, -0.7 mm], to: [10.1 mm, -0.7 mm]}]" \
        -s "$grows, {at: [25.1 mm, -0.7 mm], direction: [1, -0.02], speed: 1000 m/s}]"
    between "growth, $method: momentum of the half" "$(f half_grows_$method momentum_error)" 0 1e-12
    energies grows_$method kinetic strain external_work
done

# ---- 3D, two mirrors --------------------------------------------------------------------------------------------------------

cat >"$work/all.yaml" <<END
space: solid
duration: 6 us
material: {young: 72 GPa, poisson: 1/4, density: 2440 kg/m^3, energy_release_rate: 60 J/m^2}
body: {box: {from: [0, 0, 0], to: [16 mm, 8 mm, 8 mm]}}
particles: {spacing: 1 mm, horizon: 2.015}
boundary:
  - {mirror: {axis: z, at: 0}}
  - {mirror: {axis: y, at: 0}}
  - {traction: [0, 80 MPa, 0], face: y+}
  - {traction: [0, 0, 30 MPa], face: z+}
  - {name: below, traction: [0, -80 MPa, 0], face: y-}
time: {step: 0.1 us}
output: {frames: 1, samples: 30}
probes:
  - point: {name: face, at: [4.5 mm, 1.5 mm, 0.5 mm]}
  - point: {name: sliver, at: [4.5 mm, 0.5 mm, 0.5 mm]}
  - point: {name: beside, at: [9.5 mm, 3.5 mm, 0.5 mm]}
END
half="{box: {from: [0, 0, 0], to: [16 mm, 8 mm, 8 mm]}}" whole="{box: {from: [0, -8 mm, 0], to: [16 mm, 8 mm, 8 mm]}}"
up="{polygon: [[2.2 mm, 1.2 mm, -1 mm], [8.3 mm, 0.7 mm, -1 mm], [8.3 mm, 0.7 mm, 5.3 mm], [2.2 mm, 1.2 mm, 5.3 mm]]}"
down="{polygon: [[2.2 mm, -1.2 mm, 5.3 mm], [8.3 mm, -0.7 mm, 5.3 mm], [8.3 mm, -0.7 mm, -1 mm], [2.2 mm, -1.2 mm, -1 mm]]}"
for method in pd adaptive; do both solid_$method "$half" "$whole" "$up" "$up, $down" -s method=$method; done

# ---- crack increments in equilibrium ----------------------------------------------------------------------------------------

# A quarter of a penny crack at an edge in 3D: an increment of the half has half the area, at the same load. Beyond its peak the whole has
# no further equilibrium, so that only the peaks are compared.
cat >"$work/quarter.yaml" <<END
space: solid
duration: 1 s
method: pd
solver: static
steps: {number: 12, control: energy}
material: {young: 70 GPa, density: 2500, energy_release_rate: 20 J/m^2}
body: {box: {from: [0, 0, 0], to: [6 mm, 6 mm, 4 mm]}}
particles: {spacing: 1 mm}
cracks: [{polygon: [[-1 mm, -1 mm, 0], [3 mm, -1 mm, 0], [2.1 mm, 2.1 mm, 0], [-1 mm, 3 mm, 0]]}]
boundary:
  - {mirror: {axis: z, at: 0}}
  - {name: top, traction: [0, 0, 60 MPa], face: z+, time: {ramp: {until: 1 s}}}
output: {frames: 0}
probes: [{reaction: {boundary: top}}]
END
sed 's/  - {mirror.*/  - {traction: [0, 0, -60 MPa], face: z-, time: {ramp: {until: 1 s}}}/; s/from: \[0, 0, 0\]/from: [0, 0, -4 mm]/' \
    "$work/quarter.yaml" >"$work/quarters.yaml"
pull()
{
    "$cleave" run "$work/$1.yaml" -q -o "$work/$1" >/dev/null 2>&1
    awk -F, 'NR == 1 { for (k = 1; k <= NF; k++) if ($k ~ /force_z/) c = k; next }
        { f = $c < 0 ? -$c : $c; if (f > most) most = f } END { print most }' "$work/$1/history.csv"
}
whole=$(pull quarters)
between "advances of the half" "$(compute "$(pull quarter) / $whole - 1")" -1e-6 1e-6

# ---- a ligament of two or three rows between a crack and a face, in bodies that may break -----------------------------------

# Bonds between the end of the crack and the thin ligament have one weight, in whatever order their particles come: a slanted crack and its
# mirror image, and half a body beside the whole, store the same energy (round-off: 1e-12 measured).
cat >"$work/ligament.yaml" <<END
space: plane stress
thickness: 2 mm
duration: 20 us
method: pd
accept: [stretch, stress]
material: {young: 72 GPa, density: 2440, energy_release_rate: 100 kJ/m^2}
body: {box: {from: [-20 mm, 0], to: [20 mm, 20 mm]}}
particles: {spacing: 1 mm}
cracks: [{from: [-5.3 mm, 2.2 mm], to: [9.3 mm, 5.2 mm]}]
time: {step: 0.1 us}
boundary:
  - {traction: [0, 20 MPa], face: y+}
  - {traction: [0, -20 MPa], face: y-}
output: {frames: 0}
END
sed 's/from: \[-20 mm, 0\]/from: [0, 0]/; /^boundary/a\  - {mirror: {axis: x, at: 0}}' "$work/ligament.yaml" >"$work/ligament_half.yaml"
strain() { calm "$work/ligament" "$work/$1.yaml" -s "cracks=[$2]" --overwrite; figure "$work/ligament" energy.strain; }
slanted=$(strain ligament '{from: [-5.3 mm, 2.2 mm], to: [9.3 mm, 5.2 mm]}')
between "a crack and its mirror image" "$(compute "$(strain ligament '{from: [5.3 mm, 2.2 mm], to: [-9.3 mm, 5.2 mm]}') / $slanted - 1")" -1e-10 1e-10
for y in 2.2 3.2; do
    whole=$(strain ligament "{from: [-5.3 mm, $y mm], to: [5.3 mm, $y mm]}")
    half=$(strain ligament_half "{from: [-1 mm, $y mm], to: [5.3 mm, $y mm]}")
    between "crack at $y mm: half and whole" "$(compute "2 * $half / $whole - 1")" -1e-10 1e-10
done

finish
