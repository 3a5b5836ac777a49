#!/bin/sh
# Checks the default number of threads of a run on machines that hwloc simulates: one per physical core within the CPU mask of the process.
set -eu
cleave=$(cd "${BUILD:-build}" && pwd)/cleave
unset OMP_NUM_THREADS OMP_PROC_BIND OMP_PLACES
fail() { echo "test_threads: $1" >&2; exit 1; }

# says MACHINE CORES THREADS: checks what `cleave info` prints for the machine MACHINE (a description for hwloc): CORES cores, the default
# number of threads, and THREADS hardware threads.
says()
{
    HWLOC_SYNTHETIC=$1 "$cleave" info >out || fail "$1: info failed"
    grep -q "^cores  *$2\$" out || fail "$1: $(grep ^cores out), not $2"
    grep -q "^threads of a run  *$2; the hardware allows $3\$" out || fail "$1: $(grep '^threads' out), not $2 of $3"
}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
says "pack:1 core:16 pu:1" 16 16
says "pack:2 core:4 pu:2" 8 16
says "pack:2 numa:2 core:8 pu:2" 32 64

# An explicit number is used on any machine; with explicit binding the number of cores is not used.
HWLOC_SYNTHETIC="pack:2 core:4 pu:2" OMP_NUM_THREADS=3 "$cleave" info | grep -q "^threads of a run  *3;" || fail "OMP_NUM_THREADS"
bound=$(HWLOC_SYNTHETIC="pack:2 core:4 pu:2" OMP_PROC_BIND=true OMP_PLACES="{0}" "$cleave" info | grep "^threads of a run")
case $bound in *" 1;"*) ;; *) fail "one place makes one thread: $bound" ;; esac

# The mask of the process.
if command -v taskset >/dev/null; then
    first=$(taskset -pc $$ | sed 's/.*: *//; s/[-,].*//')
    taskset -c "$first" "$cleave" info | grep -q "^threads of a run  *1; the hardware allows 1\$" || fail "a mask of one"
fi
echo "test_threads: ok"
