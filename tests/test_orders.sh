#!/bin/sh
# floor 5: orders of convergence on the known motion of inputs/bar_converge.yaml: spacing and step halved together.
test_name=test_orders
. tests/summary.sh

# errors DIR SOFTENING: relative errors in L2 of displacement, velocity (half a step behind) and stress at the particles.
errors()
{
    awk -F, -v step="$(figure "$1" time_step)" -v softening="$2" '
        BEGIN { pi = atan2(0, -1); U = 1e-7; T = 7e-3; t = 2.8e-3; k = 2 * pi; E = 1e4; back = t - step / 2
                u = U * sin(pi * t / T) ^ 2; v = U * pi / T * sin(2 * pi * back / T); s = softening * E * k * u }
        NR > 1 { du += ($3 - u * sin(k * $2)) ^ 2; dv += ($4 - v * sin(k * $2)) ^ 2; ds += ($5 - s * cos(k * $2)) ^ 2 }
        END { n = (NR - 1) / 2; printf "%.6g %.6g %.6g\n", sqrt(du / n) / u, sqrt(dv / n) / v, sqrt(ds / n) / s }' \
        "$1/line_000001.csv"
}

# bar DIR PARTICLES [SETTING...]: a run with 1.12 steps a particle and stations at the particles.
bar()
{
    to=$work/$1 n=$2; shift 2
    "$cleave" run inputs/bar_converge.yaml -q -t 1 -o "$to" -s particles.spacing=1/$n \
        -s "time.step=$(compute "2.8e-3 / (1.12 * $n)")" \
        -s "probes[0].line={from: [$(compute "0.5 / $n")], to: [$(compute "1 - 0.5 / $n")], points: $n}" "$@" ||
        fail "$to: does not run"
}

compute() { awk "BEGIN { printf \"%.17g\", $1 }" </dev/null; } # more digits than figures need: settings

# order NAME WANTED COARSE FINE RATIO: within a tenth, which is what terms of higher order leave on these grids.
order()
{
    found=$(compute "log($3 / $4) / log($5)")
    between "$1: order" "$found" "$(compute "$2 - 0.1")" "$(compute "$2 + 0.1")"
}

# orders NAME COARSE FINE SOFTENING, and the orders wanted of displacement, velocity and stress
orders()
{
    set -- "$1" "$2" "$3" $(errors "$work/$1.$2" "$4") $(errors "$work/$1.$3" "$4") "$5" "$6" "$7"
    order "$1 displacement" "${10}" "$4" "$7" "$3 / $2"
    order "$1 velocity" "${11}" "$5" "$8" "$3 / $2"
    order "$1 stress" "${12}" "$6" "$9" "$3 / $2"
}

# ---- the grid, and a horizon that shrinks with the spacing --------------------------------------------------------

# Shapes of first degree have one stress in a cell, exact to second order in its middle: points beside it see first order.
for n in 100 200; do
    for shape in linear gimp cpgimp quadratic cubic; do bar $shape.$n $n -s mpm.shape=$shape; done
    bar pd.$n $n -s method=pd
done
for shape in linear gimp cpgimp; do orders $shape 100 200 1 2 2 1; done
for name in quadratic cubic pd; do orders $name 100 200 1 2 2 2; done

# ---- more neighbours in one horizon of 0.1 m ------------------------------------------------------------------------

# The law of the bonds then stays, and the body force is that of its operator, (4E/delta^2) int_0^delta (1 - cos kr)/r dr
# in place of E k^2; the stress is softer by 2 (1 - cos k delta)/(k delta)^2. Whole neighbours overlap the horizon's ends
# by half a spacing: first order. A ramp weighs them by halves, VMPD puts the ends between two: second order.
nonlocal="boundary[3].body_force=[-0.0417335084233727]" softening=0.967531209275079
for n in 40 80; do
    bar whole.$n $n -s method=pd -s pd.calibration=continuum -s particles.horizon=$((n / 10)) -s "$nonlocal"
    bar lattice.$n $n -s method=pd -s particles.horizon=$((n / 10)) -s "$nonlocal"
    bar ramp.$n $n -s method=pd -s pd.calibration=continuum -s pd.volume=ramp -s particles.horizon=$((n / 10)) \
        -s "$nonlocal"
    bar vmpd.$((n + 5)) $((n + 5)) -s method=pd -s pd.calibration=vmpd -s particles.horizon=$((n / 10)) -s "$nonlocal"
done
orders whole 40 80 $softening 1 0.9 0.9      # an error of 8 % still has a second order
orders lattice 40 80 $softening 1 0.95 1     # the same operator, but its long waves right: errors 60 times smaller
orders ramp 40 80 $softening 2 2 2
orders vmpd 45 85 $softening 2 2 2

# ---- where the nodes are ---------------------------------------------------------------------------------------------

# A mirror half-way between two nodes serves as well as on one; elsewhere the program says so.
for n in 100 200; do bar half.$n $n -s mpm.shape=quadratic -s "mpm.origin=[$(compute "1 / $n")]"; done
orders half 100 200 1 2 2 2
while read -r share warnings; do
    "$cleave" check inputs/bar_converge.yaml -s "mpm.origin=[$(compute "$share * 0.04")]" >"$work/said" 2>&1
    is "mirrors $share of a cell from a node: warnings" "$(grep -c '^warning: the mirror' "$work/said")" \
        $warnings
done <<'END'
0 0
0.5 0
0.3 2
END

finish
