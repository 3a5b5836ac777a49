#!/bin/sh
# Compares the run time that `cleave check` forecasts with the processor time of the run, while another program uses the processor. For
# methods pd and mpm 95 of 100 forecasts must be right within a factor of 2; for adaptive runs and load steps the time must be in the
# forecast range. Takes some minutes.
test_name=long_forecast
. tests/support/summary.sh
calls=${CALLS:-20}

# seconds SCENE [ARGUMENT...]: prints the processor time of a run including its output [s].
seconds()
{
    sh -c '"$@" -q -t 1 --overwrite >/dev/null 2>&1; times' sh "$cleave" run "$@" -o "$work/run" |
        awk 'NR == 2 { gsub(/[ms]/, " "); print 60 * $1 + $2 + 60 * $3 + $4 }'
}

# forecast SCENE [ARGUMENT...]: prints the forecast of check: run time, lower and upper bound [s].
forecast()
{
    "$cleave" check "$@" -t 1 2>/dev/null | sed -n -e 's/^run time [^0-9]*\([0-9.e+-]*\) s (\([0-9.e+-]*\) to \([0-9.e+-]*\) s).*/\1 \2 \3/p' \
        -e 's/^run time [^0-9]*\([0-9.e+-]*\) s (\([0-9.e+-]*\) to any time).*/\1 \2 1e99/p' \
        -e 's/^run time  *\([0-9.e+-]*\) to \([0-9.e+-]*\) s .*/\1 \1 \2/p'
}

awk 'BEGIN { for (;;) x++ }' & # the other program
other=$!
all=0 within=0
while read -r kind scene words; do
    took=$(seconds "inputs/$scene.yaml" $words)
    n=0 good=0 held=0
    while [ $n -lt "$calls" ]; do
        forecast "inputs/$scene.yaml" $words >"$work/forecast"
        n=$((n + 1))
        good=$((good + $(awk -v t="$took" '{ print ($1 < 2 * t && $1 > t / 2) }' "$work/forecast")))
        held=$((held + $(awk -v t="$took" '{ print ($2 <= t && t <= $3) }' "$work/forecast")))
    done
    echo "$scene $words: $took s, forecast at last $(cat "$work/forecast"); within a factor of 2: $good of $n, range holds: $held of $n"
    case $kind in
        rate) all=$((all + n)) within=$((within + good)) ;;
        range) between "$scene: ranges that hold" $held "$(compute "0.95 * $n")" $n ;;
    esac
done <<'END'
rate plate_crack -s method=pd -s particles.spacing=1mm
rate kalthoff_winkler -s method=pd -s particles.spacing=3mm
rate plate_pulse -s method=mpm -s duration=40us
rate bar_spall -s method=pd
rate bars_collide
range plate_crack -s particles.spacing=1mm
range compact_tension -s particles.spacing=2mm
range edge_crack_grips -s particles.spacing=2mm
END
kill $other
between "forecasts within a factor of 2, of $all" $within "$(compute "0.95 * $all")" "$all"

finish
