#!/bin/sh
# Columns of history.csv with the share of each method and of particles at rest. The shares of the methods must add up to 1. The share at
# rest must decrease as a wave spreads and never include particles that the wave has reached. All other columns must be equal without the
# active set, and all lines after a restart.
test_name=test_active_set
. tests/support/summary.sh
. tests/support/trust.sh

# The middle 20 mm of a strip have an initial velocity; waves travel in both directions at sqrt(C11/rho) = 100 m/s and reach its ends after
# 2.46 ms. Beyond 300 mm it is peridynamic in the adaptive run.
cat >"$work/strip.yaml" <<'END_OF_SCENE'
space: plane stress
thickness: 1 mm
duration: 3 ms
material: {young: 80000/9, density: 1}
body: {box: {from: [0, 0], to: [512 mm, 8 mm]}}
particles: {spacing: 1 mm, horizon: 3.015}
conversion: {criteria: none}
mpm: {frame: reference}
initial:
  - {velocity: [1 mm/s, 0], region: {box: {from: [246 mm, 0], to: [266 mm, 8 mm]}}}
time: {step: 2 us}
output: {frames: 1, samples: 1500}
END_OF_SCENE

# series DIR PROGRAM: runs the awk program over the samples of history.csv, with the variables time, steps, pd, mpm (shares of methods)
# and rest (share at rest).
series()
{
    awk -F, "NR == 1 { for (k = 1; k <= NF; k++) { sub(/ \\[.*/, \"\", \$k); at[\$k] = k } next }
        { time = \$1; steps = \$2; pd = \$at[\"pd_share\"]; mpm = \$at[\"mpm_share\"]; rest = \$at[\"inactive_share\"] } $2" "$1/history.csv"
}

# without DIR: prints history.csv without the column of the share at rest.
without() { awk -F, 'NR == 1 { for (k = 1; k <= NF; k++) if ($k == "inactive_share") at = k } { $at = ""; print }' "$1/history.csv"; }

right="pd.region=[{box: {from: [300 mm, 0], to: [512 mm, 8 mm]}}]"
for name in pd mpm adaptive; do
    case $name in
        pd) points=0; set -- ;;
        mpm) points=1; set -- ;;
        adaptive) points=0.5859375; set -- -s "$right" ;;          # 300 of 512 columns
    esac
    # A sample in every step, so that the mesh takes time and is interrupted during the run; a busy machine may check too late.
    calm "$work/$name" "$work/strip.yaml" -s method=$name "$@"
    calm "$work/never" "$work/strip.yaml" -s method=$name "$@" -s time.active_set=false
    is "$name: all is either" "$(series "$work/$name" 'pd + mpm < 1 - 1e-8 || pd + mpm > 1 + 1e-8')" ""
    between "$name: share of points" "$(series "$work/$name" 'END { print mpm }')" $points $points
    is "$name: without rest nobody rests" "$(series "$work/never" 'rest != 0')" ""
    without "$work/$name" >"$work/rests"; without "$work/never" >"$work/never.csv"
    holds "$name: the other columns" cmp "$work/rests" "$work/never.csv"
    # The initial 20 mm and the region passed by the wave are never at rest, evaluated in the middle of the steps between two samples.
    is "$name: what the wave has reached is awake" "$(series "$work/$name" \
        'NR > 2 && rest > 0 && rest > 1 - (0.02 + 200 * (time + last) / 2) / 0.512 + 1e-8 { print time, rest } { last = time }')" ""
    is "$name: falls" "$(series "$work/$name" 'NR > 3 && rest > last { print time, rest, last } { last = rest }')" ""
    between "$name: at the start" "$(column "$work/$name" inactive_share 0.1e-3)" 0.6 0.96
    between "$name: on the way" "$(column "$work/$name" inactive_share 1e-3)" 0.2 0.56
    between "$name: at the end" "$(column "$work/$name" inactive_share 3e-3)" 0 0
    mean=$(series "$work/$name" 'NR > 1 { sum += rest * (steps - last); last = steps } END { printf "%.9g", sum / last }')
    near "$name: the mean of all steps" "$mean" "$(figure "$work/$name" inactive_share)" 1e-8      # nine digits are printed
    for try in 1 2 3 4 5 6; do
        interrupted "$work/resumed" 200 "$work/strip.yaml" -s method=$name "$@"
        resting=$(series "$work/resumed" 'END { print rest }')
        ! awk -v rest="$resting" 'BEGIN { exit !(rest > 0.01) }' || break
    done
    between "$name: interrupted while some rest" "$resting" 0.01 1
    calm "$work/resumed" --resume "$work/strip.yaml" -s method=$name "$@"
    same "$name: after a restart" "$work/$name" "$work/resumed"
    rm -r "$work/never" "$work/resumed"
done
finish
