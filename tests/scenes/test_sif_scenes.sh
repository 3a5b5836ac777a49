#!/bin/sh
# Stress-intensity factors of scenes of inputs/: an edge crack against its closed form, for all models, both solvers and adaptive
# coupling, and an inclined crack in both modes against boundary collocation.
test_name=test_sif_scenes
. tests/support/summary.sh
. tests/support/scenes.sh

# The edge crack with additional probes.
{
    cat inputs/edge_crack_k1.yaml
    echo '  - sif: {name: pddo, gradient: pddo}'
    echo '  - sif: {name: linear, weight: linear}'
    echo '  - sif: {name: near, outer: 1.5 mm}'
    echo '  - sif: {name: far, outer: 3 mm}'
} >"$work/edge.yaml"

# inclined PHI: writes the scene inclined_PHI.yaml of the inclined crack with the angle PHI [degrees].
inclined()
{
    awk -v phi="$1" '
        BEGIN { s = 3 * sin(phi * 3.14159265358979 / 180); c = 3 * cos(phi * 3.14159265358979 / 180)
                low = sprintf("[%.6f mm, %.6f mm]", 10 - s, 5 - c); high = sprintf("[%.6f mm, %.6f mm]", 10 + s, 5 + c) }
        { gsub(/\[7.878680 mm, 2.878680 mm\]/, low); gsub(/\[12.121320 mm, 7.121320 mm\]/, high); print }' \
        inputs/inclined_crack.yaml >"$work/inclined_$1.yaml"
}
for phi in 45 75; do inclined $phi; done

half="-s particles.spacing=0.1mm"
coarse="-s particles.spacing=0.2mm"
start inclined_45 "$work/inclined_45.yaml" $half
(
    start mospd "$work/edge.yaml"; wait
    start ospd "$work/edge.yaml" -s model=ospd; wait
    start ospd_coarse edge_crack_k1 $coarse -s model=ospd; wait
    start local edge_crack_k1 -s pd.normalisation=local; wait
    start bond edge_crack_k1 -s model=bond -s material.poisson=1/3; wait
)
wait
start inclined_75 "$work/inclined_75.yaml" $half
(
    start alone edge_crack_k1 $coarse; wait
    start relaxation edge_crack_k1 $coarse -s solver=relaxation; wait
    start coupled edge_crack_k1 $coarse -s method=adaptive -s solver=relaxation -s mpm.transfer=apic \
        -s 'pd.region={box: {from: [0, 1.6 mm], to: [8.4 mm, 8.4 mm]}}'
    wait
)
wait

# ---- the edge crack: 11.93 MPa mm^0.5 (3.009 sigma sqrt(pi a), boundary collocation) --------------------------------------

# off RUN PROBE: prints the relative error of K_I of a probe.
off() { compute "$(f "$1" "probes.$2.K_I") / (11.93e6 * sqrt(1e-3)) - 1"; }
# With surface correction the remaining error is at the end of the crack: as if it were longer by half a horizon; twice as much with twice
# the spacing (ratio 2.08 measured; it would be 1.5 if K were 2 % too large in both).
between "mospd: K_I" "$(off mospd sif)" -0.01 0.003
between "ospd: K_I" "$(off ospd sif)" 0.012 0.022
between "ospd, 50 particles: K_I, twice as far off" "$(compute "$(off ospd_coarse sif) / $(off ospd sif)")" 1.8 2.3
# Error of families that are incomplete at faces: 2.3 % with their own constants, and 1.6 % for bonds that are soft at surfaces.
between "mospd local: K_I" "$(off local sif)" -0.03 -0.015
between "bonds: K_I" "$(off bond sif)" 0.012 0.022
for run in mospd ospd; do
    between "$run: contours" "$(f $run probes.sif.contour_spread)" 0 0.003
done
# K_II is zero by symmetry; bonds on the crack's line count as above it.
between "mospd: K_II" "$(compute "$(f mospd probes.sif.K_II) / $(f mospd probes.sif.K_I)")" -0.005 0.005
for run in mospd ospd; do
    # Rings of 1.5 and 3 mm, the latter 2 mm from the edges.
    apart "$run: radius" "$(off $run near)" "$(off $run far)" 0.003
    apart "$run: mls and pddo" "$(off $run sif)" "$(off $run pddo)" 0.003
done
# J of the same ring: K_I^2/E in plane stress.
between "mospd: J" "$(compute "$(f mospd probes.sif.J) * 200e9 / $(f mospd probes.sif.K_I)^2")" 0.997 1.003
# The linear ramp has kinks at both ends of rings, which particles sample inaccurately.
between "linear weight: contours" \
    "$(compute "$(f mospd probes.linear.contour_spread) / $(f mospd probes.sif.contour_spread)")" 1.5 1000
apart "cg and relaxation" "$(off alone sif)" "$(off relaxation sif)" 1e-3
# Material points from 1.6 mm from the crack's ends to the edges.
apart "adaptive and pd" "$(off coupled sif)" "$(off alone sif)" 0.01

# ---- the inclined crack, at half the resolution of the scene ----------------------------------------------------------

# deviation RUN PROBE MODE F_I F_II: prints the deviation of the factor of MODE (I or II) from collocation, F_I or F_II, over the root of
# the sum of squares of both.
deviation()
{
    wanted=$4
    [ "$3" = II ] && wanted=$5
    compute "(sqrt(($(f "$1" "probes.$2.K_$3"))^2) / (1e6 * sqrt(3.14159265358979 * 3e-3)) - $wanted) / sqrt($4^2 + $5^2)"
}
# Pure mode I and pure mode II are in test_sif_handbook.sh. Measured: at most 1.3 and 1.4 %; with the scene's own 400 x 200 particles 0.9
# and 0.9 %.
for probe in sif lower; do
    for mode in I II; do
        between "45 $probe $mode" "$(deviation inclined_45 $probe $mode 0.6612 0.5674)" -0.02 0.02
        between "75 $probe $mode" "$(deviation inclined_75 $probe $mode 0.0896 0.2939)" -0.02 0.02
    done
done
finish
