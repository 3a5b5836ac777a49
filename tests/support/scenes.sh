#!/bin/sh
# What test_scenes.sh and long_scenes.sh share: runs of inputs/, two at a time on one thread each: as fast as one after
# the other on two threads, and the bits are the same. Sourced after summary.sh.

# start FOLDER SCENE [ARGUMENT...]: a run in the background; `wait` for it.
start()
{
    to=$work/$1; scene=$2; shift 2
    [ -f "$scene" ] || scene=inputs/$scene.yaml
    { "$cleave" run "$scene" -o "$to" -t 1 -q "$@" 2>"$to.err" || fail "$to: $(cat "$to.err")"; } &
}

# f FOLDER PATH: a figure of such a run.
f() { figure "$work/$1" "$2"; }

# last FOLDER COLUMN: its value in the last line of history.csv.
last() { awk -F, -v name="$2" 'NR == 1 { for (k = 1; k <= NF; k++) { sub(/ .*/, "", $k); if ($k == name) at = k } } END { print $at }' \
    "$work/$1/history.csv"; }

# sound FOLDER BALANCE: what holds for every run: done, momentum to round-off (1e-12 leaves a factor of 25 to the worst of these,
# 4e-14), energies within BALANCE of their largest sum.
sound()
{
    is "$1 status" "$(f "$1" status)" done
    between "$1 momentum" "$(f "$1" momentum_error)" 0 1e-12
    between "$1 energy balance" "$(f "$1" energy.balance_error)" "-$2" "$2"
}

# Energies of peridynamics alone are those of the leap-frog scheme: below 0.5 %. An adaptive run damps on its grid and leaves
# kinetic energy of short waves behind: 3.4 % in the coarse plate at the most, 5 % allowed.
pd_balance=0.005 adaptive_balance=0.05
