#!/bin/sh
# Functions for scripts that run scenes of inputs/: runs use one thread each, two in parallel, which takes as long as one after another on
# two threads and has bitwise equal results. Sourced after summary.sh.

# start FOLDER SCENE [ARGUMENT...]: starts a run in the background; `wait` waits for its end. SCENE: a file, or the name of a scene of
# inputs/.
start()
{
    to=$work/$1; scene=$2; shift 2
    [ -f "$scene" ] || scene=inputs/$scene.yaml
    { "$cleave" run "$scene" -o "$to" -t 1 -q "$@" 2>"$to.err" || fail "$to: $(cat "$to.err")"; } &
}

# f FOLDER PATH...: prints figures of the run in this folder, as figure() does.
f() { folder=$work/$1; shift; figure "$folder" "$@"; }

# last FOLDER COLUMN: prints the value of a column in the last line of history.csv.
last() { awk -F, -v name="$2" 'NR == 1 { for (k = 1; k <= NF; k++) { sub(/ .*/, "", $k); if ($k == name) at = k } } END { print $at }' \
    "$work/$1/history.csv"; }

# sound FOLDER BALANCE: checks that the run is done, that its relative error of momentum is at most 1e-12 (25 times the largest error of
# these runs, 4e-14), and that the relative error of the energy balance is at most BALANCE.
sound()
{
    set -- "$1" "$2" $(f "$1" status momentum_error energy.balance_error)
    is "$1 status" "${3:-}" done
    between "$1 momentum" "${5:-}" 0 1e-12
    between "$1 energy balance" "${4:-}" "-$2" "$2"
}

# Energies of peridynamics are those of the leap-frog scheme: balance error below 0.5 %. An adaptive run dissipates on its grid and leaves
# kinetic energy of short waves: at most 3.4 % in the coarse plate, 5 % allowed.
pd_balance=0.005 adaptive_balance=0.05
