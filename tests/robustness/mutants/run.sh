#!/bin/sh
# Puts small faults into copies of the program, one at a time, and runs the tests that must detect them:
#     sh tests/robustness/mutants/run.sh [LIST...]                     (make mutants, make mutants MUTANTS=LIST)
# A list has one fault per line, `file @ old @ new @ tests` (list.txt). THREADS: number of faults tested in parallel, each in its own copy
# of the tree, with kernels for this processor only; default: one per processor. Prints a line for each fault: seen (one of its tests fails
# or takes far too long), NOT SEEN, or an error in the list; then the share that was seen.
# Exit status: 0 if 95 % or more were seen, 1 if not, 2 if there is no list or the program does not build.
set -u
[ $# -gt 0 ] || set -- tests/robustness/mutants/list.txt
lanes=${THREADS:-$(getconf _NPROCESSORS_ONLN)}
wanted=95
unset MAKEFLAGS MAKELEVEL MFLAGS

for list in "$@"; do [ -r "$list" ] || { echo "mutants: no such list: $list" >&2; exit 2; }; done

# Copies are in memory if there is space. Copies of a killed run are removed at the start of the next.
room=${TMPDIR:-/tmp}
[ ! -w /dev/shm ] || [ "$(df -Pk /dev/shm | awk 'END { print $4 }')" -lt 4000000 ] || room=/dev/shm
for left in "$room"/cleave-mutants.*; do
    [ ! -d "$left" ] || [ ! -O "$left" ] || kill -0 "${left##*.}" 2>/dev/null || rm -rf "$left"
done
work=$room/cleave-mutants.$$
mkdir "$work" || exit 2
trap 'rm -rf "$work"' EXIT
trap 'trap "" TERM; kill $lane_processes 2>/dev/null; wait; exit 1' INT TERM HUP
lane_processes=

# Background processes of a shell ignore SIGINT, which tests raise (tests/support/run.sh).
hearing="env --default-signal=INT,QUIT"
$hearing true 2>/dev/null || hearing=
export OMP_NUM_THREADS=1 GOMP_SPINCOUNT=0 KMP_BLOCKTIME=0

# ---- the tree, and errors in the list --------------------------------------------------------------------------------

tree=$work/tree
mkdir -p "$tree/build" "$work/jobs" "$work/first"
cp -a Makefile README.md LICENSE CITATION.cff CHANGELOG.md .clang-format .clang-tidy .editorconfig .ci .github \
    src include kernels bench tests inputs "$tree"
# Copies existing objects of the usual build: files that are up to date are not compiled again.
if [ "${BUILD:-build}" = build ] && [ -d build ]; then
    (cd build && find . -name '*.[odh]' ! -path './fuzz/*' -exec cp -a --parents -t "$tree/build" {} +)
fi

TESTS=$(find tests -name 'test_*.c' -o -name 'test_*.sh' -o -name 'house.sh' | sort) JOBS=$work/jobs
export TESTS JOBS
for list in "$@"; do awk 1 "$list"; done | awk -f tests/robustness/mutants/list.awk >/dev/null
[ -n "$(ls "$work/jobs")" ] || { echo "mutants: no fault in $*" >&2; exit 2; }
cat "$work"/jobs/*/tests | sort -u >"$work/tests"

# goals TEST...: prints the make targets that these tests require.
goals()
{
    for goal in "$@"; do
        case $goal in
            *.sh) echo build/cleave; ! grep -q 'schema' "$goal" || echo build/cleave.schema.json ;;
            *.c) echo "build/${goal%.c}" ;;
        esac
    done | sort -u
}

# build TREE LOG GOAL...: makes the goals in a copy of the source tree, with the output in the file LOG; returns the status of make.
build()
{
    there=$1 log=$2; shift 2
    make -C "$there" BUILD=build FIRST=1 BENCHES=yes CC="${CC:-gcc}" "$@" >"$log" 2>&1
}

echo "mutants: $(ls "$work/jobs" | wc -l) faults, $(wc -l <"$work/tests") tests, $lanes at a time"
objects=$(goals $(cat "$work/tests") | sed 's|^build/\(tests/.*\)|build/\1.o|')
build "$tree" "$work/log" -j"$lanes" build/cleave $objects || { tail -n 20 "$work/log"; echo "mutants: no build" >&2; exit 2; }

# ---- lanes -----------------------------------------------------------------------------------------------------------

# attempt LANE FOLDER LIMIT TEST: runs a test in the copy of the source tree in FOLDER for at most LIMIT seconds; returns its exit status.
# LANE: number of the background process.
attempt()
{
    here=$2 limit=$3 test=$4
    case $test in *.sh) program="sh $test" ;; *) program=build/${test%.c} ;; esac
    mkdir -p "$work/tmp$1"
    (cd "$here" && BUILD=build TMPDIR=$work/tmp$1 exec timeout -k 5 "$limit" $hearing $program) >"$work/said$1" 2>&1 </dev/null &
    running=$!
    wait $running
    result=$?
    running=
    rm -rf "$work/tmp$1"
    return $result
}

# put_back LANE: restores the sources and objects of the copy of the tree of this lane (background process) that have changed, with their
# times.
put_back()
{
    (cd "$work/lane$1" && find . -type f -newer "$work/stamp$1") | while read -r path; do
        rm -f "$work/lane$1/$path"
        case $path in
            ./build/*.[odh]) ;;
            ./build/*) continue ;;               # programs: linked again
        esac
        [ ! -f "$tree/$path" ] || cp -p "$tree/$path" "$work/lane$1/$path"
    done
}

# first LANE TEST: runs a test without a fault, once for all lanes. Records its duration in $work/first, or why it cannot be used.
first()
{
    name=$(basename "$2" .c) says=
    if ! mkdir "$work/first/$name.begun" 2>/dev/null; then
        while [ ! -f "$work/first/$name" ]; do [ -d "$work" ] || exit 1; sleep 1; done
        return
    fi
    begin=$(date +%s)
    if ! build "$tree" "$work/said$1" -o build/parts.h $(goals "$2"); then
        says="does not build"
    else
        begin=$(date +%s)
        attempt "$1" "$tree" 900 "$2"
        case $? in
            0) ;;
            77) says="is skipped here" ;;
            *) says="fails without a fault" ;;
        esac
    fi
    if [ -n "$says" ]; then
        echo "$says" >"$work/first/$name.wrong"
        echo "mutants: $name $says"
        tail -n 20 "$work/said$1"
    fi
    case $2 in *.c) rm -f "$tree/build/${2%.c}" ;; esac
    echo $(($(date +%s) - begin)) >"$work/first/$name"
}

# judge LANE JOB: puts the fault of the folder JOB into the copy of the tree of this lane, builds it and runs its tests. Writes the verdict,
# and the test that detected the fault, to JOB.
judge()
{
    job=$2 file=$(cat "$2/file") verdict="NOT SEEN" by= tried=
    if [ -f "$job/wrong" ]; then echo "$(cat "$job/wrong")" >"$job/verdict"; return; fi
    old=$(cat "$job/old") new=$(cat "$job/new") awk 'BEGIN { old = ENVIRON["old"]; new = ENVIRON["new"] }
        !done && (at = index($0, old)) { $0 = substr($0, 1, at - 1) new substr($0, at + length(old)); done = 1 }
        { print }' "$tree/$file" >"$work/lane$1/$file"
    for test in $(cat "$job/tests"); do
        name=$(basename "$test" .c)
        first "$1" "$test"
        if [ -f "$work/first/$name.wrong" ]; then
            [ -n "$tried" ] || verdict="$name $(cat "$work/first/$name.wrong")"
            continue
        fi
        if ! build "$work/lane$1" "$work/said$1" -o build/parts.h $(goals "$test"); then
            verdict="does not build"
            cp "$work/said$1" "$job/said"
            break
        fi
        if ! attempt "$1" "$work/lane$1" $((20 + 4 * $(cat "$work/first/$name"))) "$test"; then
            verdict=seen by=$name
            break
        fi
        verdict="NOT SEEN" tried=yes
    done
    echo "$verdict" >"$job/verdict"
    printf '%s' "$by" >"$job/by"
    put_back "$1"
}

# lane NUMBER: one of the background processes; judges faults that no other lane has started, one after another, and prints a line for each.
lane()
{
    running=
    trap '[ -z "$running" ] || kill "$running" 2>/dev/null; exit 1' TERM INT HUP
    cp -a "$tree" "$work/lane$1"
    touch "$work/stamp$1"
    for task in "$work"/jobs/*; do
        mkdir "$task/begun" 2>/dev/null || continue
        start=$(date +%s)
        judge "$1" "$task"
        printf '%-8s %3d s  %s: %s -> %s (%s)\n' "$(cat "$task/verdict")" $(($(date +%s) - start)) "$(cat "$task/place")" \
            "$(cat "$task/old")" "$(cat "$task/new")" "$(if [ -s "$task/by" ]; then cat "$task/by"; else sed 's|.*/||; s|\.c$||' "$task/tests" | paste -s -d ' '; fi)"
        [ ! -f "$task/said" ] || tail -n 3 "$task/said"
    done
}

for number in $(seq "$lanes"); do lane "$number" & lane_processes="$lane_processes $!"; done
wait

# ---- result ----------------------------------------------------------------------------------------------------------

cat "$work"/jobs/*/verdict | awk -v wanted="$wanted" '
    { all++ }
    $0 == "seen" { seen++ }
    $0 == "NOT SEEN" { missed++ }
    END { share = 100 * seen / all
          printf "mutants: %d of %d faults seen (%.1f %%), %d not seen, %d that are no fault\n", seen, all, share, missed, all - seen - missed
          exit share < wanted }'
