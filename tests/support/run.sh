#!/bin/sh
# Runs test programs and scripts, as many at a time as OMP_NUM_THREADS states, on one thread each, those first whose heads state the most
# seconds. Then runs those whose source contains `Runs alone`, one after another on all threads. Prints a line for each, the output of those
# that fail, and a count. A script that cannot run here exits with status 77 after a line with the reason: SKIPPED.
lanes=${OMP_NUM_THREADS:-$(getconf _NPROCESSORS_ONLN)}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
trap 'trap "" TERM; kill 0; exit 1' INT TERM HUP

# Files of tests are in memory if there is space (a test needs at most 0.3 GB), to avoid waiting for a disk at every frame and checkpoint.
[ ! -w /dev/shm ] || [ "$(df -Pk /dev/shm | awk 'END { print $4 }')" -lt 2000000 ] || export TMPDIR="${TMPDIR:-/dev/shm}"

# Background processes of a shell ignore SIGINT, which tests raise; env restores the default.
hearing="env --default-signal=INT,QUIT"
$hearing true 2>/dev/null || hearing=

# source_of TEST: prints the path of a script itself, or of the source of a test program.
source_of()
{
    path=${1#"${BUILD:-build}/"}
    case $path in *.sh) echo "$path" ;; *) echo "$path.c" ;; esac
}

# alone TEST: returns 0 if the test must run alone.
alone()
{
    case $1 in
        */long_*) return 0 ;;
        *) grep -q 'Runs alone' "$(source_of "$1")" ;;
    esac
}

# seconds_stated TEST: prints the number in `Takes 30 s` in the head of a test; 0 if there is none.
seconds_stated() { head -n 12 "$(source_of "$1")" | sed -n 's/.*Takes \([0-9]*\) s.*/\1/p' | grep . || echo 0; }

# try TEST LANE: runs a test and prints a line with its result, and its output if it fails. LANE: number of the background process.
try()
{
    log=$folder/log$2 said=$folder/said$2 start=$(date +%s)
    case $1 in
        *.sh) $hearing sh "$1" >"$log" 2>&1 ;;
        *) $hearing "$1" >"$log" 2>&1 ;;
    esac
    result=$?
    seconds=$(($(date +%s) - start))
    name=$(basename "$1")
    case $result in
        0) echo "ok       $name (${seconds} s)" ;;
        77) echo "SKIPPED  $name: $(tail -n 1 "$log")" ;;
        *) echo "FAILED   $name (${seconds} s, status $result)"; cat "$log" ;;
    esac >"$said"
    cat "$said"
    head -n 1 "$said" >>"$folder/results"
}

# lane NUMBER: one of the background processes: runs the tests of the list `beside`, in order, that no other lane has started. Threads of a
# test do not spin while they wait, since other lanes need the processors. Freed memory is kept (glibc): bodies that are made repeatedly
# would else fetch their pages from the system each time, half of the time of such tests.
lane()
{
    export OMP_NUM_THREADS=1 GOMP_SPINCOUNT=0 KMP_BLOCKTIME=0 MALLOC_TRIM_THRESHOLD_=200000000 MALLOC_MMAP_THRESHOLD_=30000000
    while read -r test; do
        ! mkdir "$folder/begun_$(echo "$test" | tr / _)" 2>/dev/null || try "$test" "$1" </dev/null
    done <"$folder/beside"
}

: >"$folder/results"
for test in "$@"; do
    if [ "$lanes" -eq 1 ] || alone "$test"; then echo "$test" >>"$folder/alone"
    else echo "$(seconds_stated "$test") $test" >>"$folder/unsorted"; fi
done
if [ -f "$folder/unsorted" ]; then
    sort -s -k 1,1nr "$folder/unsorted" | cut -d ' ' -f 2 >"$folder/beside"      # no lane begins a long test last
    for number in $(seq "$lanes"); do lane "$number" & done
    wait
fi

# Waiting threads must not block other programs on a busy machine: spin count of gcc's library, milliseconds of clang's.
export GOMP_SPINCOUNT=2000 KMP_BLOCKTIME=1
[ ! -f "$folder/alone" ] || while read -r test; do try "$test" 0 </dev/null; done <"$folder/alone"

# A test of more than 20 s has to state why: `Takes` in its head.
for test in "$@"; do
    seconds=$(sed -n "s/^[a-zA-Z]* *$(basename "$test") (\([0-9]*\) s.*/\1/p" "$folder/results" | sort -n | tail -n 1)
    [ "${seconds:-0}" -le 20 ] || head -n 12 "$(source_of "$test")" | grep -q 'Takes' ||
        echo "over 20 s, and its head does not say why: $(basename "$test") ($seconds s)"
done

count() { grep -c "^$1" "$folder/results"; }
echo "$(count ok) passed, $(count FAILED) failed, $(count SKIPPED) skipped"
[ "$(count FAILED)" = 0 ]
