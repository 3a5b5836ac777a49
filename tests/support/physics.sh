#!/bin/sh
# Functions for test_physics.sh: scenes from standard input, means and fronts of series and profiles. Sourced after summary.sh and
# scenes.sh.

# scene NAME: writes standard input as the scene NAME.
scene() { cat >"$work/$1.yaml"; }

# strip SPACE [MATERIAL]: prints the scene of a strip of steel between rollers, whose end is loaded by a pressure of 100 MPa. MATERIAL:
# further keys of its material.
strip()
{
    to="4 mm" middle="1.5 mm" from=0 depth="thickness: 1 mm" rollers=""
    if [ "$1" = solid ]; then
        to="4 mm, 4 mm" middle="1.5 mm, 1.5 mm" from="0, 0" depth="name: solid"
        rollers="
  - {name: front, mirror: {axis: z, at: 0}}
  - {name: back, mirror: {axis: z, at: 4 mm}}"
    fi
    cat <<END
space: $1
$depth
duration: 50 us
material: {young: 190 GPa, density: 7800${2:+, $2}}
body: {box: {from: [0, $from], to: [250 mm, $to]}}
particles: {spacing: 1 mm}
boundary:
  - {name: push, traction: [100 MPa, $from], face: x-, time: {ramp: {from: 0, until: 12 us}}}
  - {name: low, mirror: {axis: y, at: 0}}
  - {name: high, mirror: {axis: y, at: 4 mm}}$rollers
output: {frames: 1, samples: 400}
probes: [{point: {name: near, at: [50.5 mm, $middle]}}, {point: {name: far, at: [200.5 mm, $middle]}}]
END
}

# go FOLDER NAME [ARGUMENT...]: starts a run of the scene NAME of scene() in the background, at most two at a time; `landed` waits for those
# still running.
going=0
go()
{
    folder=$1 name=$2; shift 2
    start "$folder" "$work/$name.yaml" "$@"
    going=$((going + 1))
    if [ $going -eq 2 ]; then landed; fi
}

landed() { wait; going=0; }

# read_csv: common beginning of the awk programs of this file: sets `at` to the index of the column `name` and x to that of the column x.
# Values to be compared need a "+ 0", since awk reads numbers below 1e-308 as words.
read_csv='FNR == 1 {
    for (k = 1; k <= NF; k++) { sub(/ \[.*/, "", $k); if ($k == name) at = k; if ($k == "x") x = k }
    next
}'

# ---- series: a column of history.csv over time ---------------------------------------------------------------------

# mean FOLDER COLUMN FROM TO: prints the mean of a column between two times [s].
mean()
{
    awk -F, -v name="$2" -v from="$3" -v to="$4" "$read_csv"'
        at && $1 >= from + 0 && $1 <= to + 0 { sum += $at; n++ }
        END { if (n) printf "%.9g", sum / n }' "$work/$1/history.csv"
}

# most FOLDER COLUMN [FROM]: prints the largest magnitude of a column over all samples, or over those from the time FROM on [s].
most()
{
    awk -F, -v name="$2" -v from="${3:-0}" "$read_csv"'
        at && $1 >= from + 0 { size = $at + 0 < 0 ? -$at : $at + 0; if (size >= largest) largest = size; n++ }
        END { if (n) printf "%.9g", largest }' "$work/$1/history.csv"
}

# rises FOLDER COLUMN VALUE: prints the time at which a column first reaches the value [s], interpolated between samples.
rises()
{
    awk -F, -v name="$2" -v value="$3" "$read_csv"'
        at && $at + 0 >= value + 0 && n { printf "%.9g", t + ($1 - t) * (value - v) / ($at - v); exit }
        { t = $1; v = $at; n++ }' "$work/$1/history.csv"
}

# ---- profiles: a line probe called `bar` at the end of the run, with one station per particle ----------------------

# along FOLDER COLUMN FROM TO: prints the mean of a column over the points of the profile between two positions [m].
along()
{
    awk -F, -v name="$2" -v from="$3" -v to="$4" "$read_csv"'
        at && $x >= from + 0 && $x <= to + 0 { sum += $at; n++ }
        END { if (n) printf "%.9g", sum / n }' "$work/$1/bar_000001.csv"
}

# strain FOLDER FROM TO: prints the mean of du/dx between two positions [m].
strain()
{
    awk -F, -v name=displacement_x -v from="$2" -v to="$3" "$read_csv"'
        at && $x >= from + 0 && $x <= to + 0 { if (!n++) { x0 = $x; u0 = $at } x1 = $x; u1 = $at }
        END { if (n > 1) printf "%.9g", (u1 - u0) / (x1 - x0) }' "$work/$1/bar_000001.csv"
}

# front FOLDER VALUE: prints the first position at which du/dx rises to the value with increasing x [m], interpolated between the middles of
# neighbouring points of the profile.
front()
{
    awk -F, -v name=displacement_x -v value="$2" "$read_csv"'
        at && n++ {
            slope = ($at - u) / ($x - place); middle = ($x + place) / 2
            if (n > 2 && slope >= value + 0 && before < value + 0) {
                printf "%.9g", last + (middle - last) * (value - before) / (slope - before); exit }
            before = slope; last = middle
        }
        { place = $x; u = $at }' "$work/$1/bar_000001.csv"
}

# astray FOLDER COLUMN A B C: prints the largest difference of a column of the profile from A + B x + C x^2.
astray()
{
    awk -F, -v name="$2" -v a="$3" -v b="$4" -v c="$5" "$read_csv"'
        at { d = $at - (a + b * $x + c * $x * $x); if (d < 0) d = -d; if (d > largest) largest = d; n++ }
        END { if (n) printf "%.9g", largest }' "$work/$1/bar_000001.csv"
}

# extreme FOLDER COLUMN: prints the largest magnitude of a column in the last profiles of all line probes.
extreme()
{
    awk -F, -v name="$2" "$read_csv"'
        at { size = $at + 0 < 0 ? -$at : $at + 0; if (size > largest) largest = size; n++ }
        END { if (n) printf "%.9g", largest }' "$work/$1"/*_000001.csv
}
