#!/bin/sh
# Functions for test_trust.sh, long_trust.sh and other scripts: small scenes, checks of one run, and runs that are stopped or killed and
# resumed, which must not change results. Sourced after summary.sh.

# A small plate with cracking notches, a spalling bar, a solid plate: name, scene and the arguments that make it small. All in the current
# frame; test_frame.sh has them in the reference frame.
current="-s mpm.frame=current -s mpm.transfer=apic"
flat="inputs/kalthoff_winkler.yaml $current -s duration=36us -s particles.spacing=2mm -s time.step=0.1us -s output.frames=10
    -s output.samples=100"
line="inputs/hopkinson_bar.yaml -s duration=1.2ms -s time.step=1us -s output.frames=10 -s output.samples=200"
solid="inputs/kalthoff_winkler_3d.yaml $current -s duration=24us -s output.frames=4 -s output.samples=50"

# calm FOLDER ARGUMENTS: checks that a run succeeds, prints nothing but warnings, and writes finite numbers only.
calm()
{
    to=$1; shift
    "$cleave" run -q -o "$to" "$@" >"$work/out" 2>"$work/err" || { fail "$to: status $?: $(cat "$work/err")"; return; }
    if [ -s "$work/out" ] || { [ -s "$work/err" ] && grep -q -v '^warning: ' "$work/err"; }; then
        fail "$to: says $(cat "$work/err" "$work/out")"
    else pass; fi
    numbers "$to"
}

# ended STATUS WHAT FOLDER TEXT ARGUMENT...: checks that a run ends with this exit status and one line, besides warnings, that contains
# TEXT.
ended()
{
    wanted=$1 what=$2 folder=$3 text=$4; shift 4
    "$cleave" run -q -o "$folder" "$@" >"$work/out" 2>"$work/err"
    is "$what: exit status" $? "$wanted"
    is "$what: lines" "$(grep -c -v '^warning: ' "$work/err")" 1
    holds "$what: $(cat "$work/err")" grep -q "$text" "$work/err"
}
refused() { ended 2 "$@"; }
stopped() { ended 1 "$@"; }

# warned WHAT FOLDER TEXT ARGUMENT...: checks that a run completes with this text on standard error and in its summary.
warned()
{
    what=$1 folder=$2 text=$3; shift 3
    "$cleave" run -q -o "$folder" "$@" >"$work/out" 2>"$work/err"
    is "$what: exit status" $? 0
    holds "$what: said" grep -q "^warning: .*$text" "$work/err"
    holds "$what: in the summary" grep -q "$text" "$folder/summary.json"
}

# physical FOLDER: prints the lines of summary.json that do not depend on the machine.
physical() { sed '/"threads"/,$d' "$1/summary.json"; }

# same WHAT A B: checks that two folders have equal frames, samples, scenes and figures, byte for byte, and that B has no temporary files.
same()
{
    physical "$2" >"$work/figures_a"
    physical "$3" >"$work/figures_b"
    if cmp "$work/figures_a" "$work/figures_b" && diff -r -q "$2/frames" "$3/frames" && cmp "$2/history.csv" "$3/history.csv" &&
        cmp "$2/scene.yaml" "$3/scene.yaml" && cmp "$2/frames.xdmf" "$3/frames.xdmf" &&
        cmp "$2/frames.hdf.series" "$3/frames.hdf.series"; then pass
    else fail "$1: $2 and $3 differ"; fi
    bare "$1" "$3"
}

# bare WHAT FOLDER: checks that no temporary file is left.
bare() { is "$1: temporary files" "$(find "$2" -name '*.tmp')" ""; }

# random LOW HIGH: prints a random number between LOW and HIGH [s]; $seed is the seed of the script.
draw=0
random() { draw=$((draw + 1)); awk -v s="$seed" -v k=$draw -v low="$1" -v high="$2" 'BEGIN {
    srand(s * 1000 + k); rand(); printf "%.3f", low + (high - low) * rand() }'; }

# await FOLDER LINES PID: waits until history.csv has at least LINES lines or the process PID has ended.
await()
{
    while kill -0 "$3" 2>/dev/null; do
        held=$(grep -c '' "$1/history.csv" 2>/dev/null)
        [ "${held:-0}" -lt "$2" ] || return 0
        sleep 0.01
    done
}

# Background processes of a shell ignore SIGINT; env restores the default. If env cannot, SIGTERM is used instead of SIGINT.
hearing="env --default-signal=INT"
$hearing true 2>/dev/null || hearing=

# interrupt FOLDER SIGNAL LINES ARGUMENTS: starts or resumes a run, which receives the signal when history.csv has LINES lines, at least one
# of them new (a resumed run finds lines before it handles signals). $result: exit status. On a busy machine the run may end before the
# lines are counted. It is therefore paused while they are counted, and repeated from its previous state if all lines but the last were
# there, since the run no longer handles signals before the last. A run that had more steps and ignored the signal has status 0.
interrupt()
{
    to=$1 signal=$2 length=$3 tries=0; shift 3
    [ "$signal" != INT ] || [ -n "$hearing" ] || signal=TERM
    rm -rf "$work/before"
    [ ! -e "$to" ] || cp -r "$to" "$work/before"
    there=$(cat "$to/history.csv" 2>/dev/null | wc -l)
    [ "$there" -lt "$length" ] || length=$((there + 1))
    while [ $tries -lt 10 ]; do
        tries=$((tries + 1))
        $hearing "$cleave" run -q -o "$to" -t 2 "$@" 2>"$work/err" &
        process=$!
        await "$to" "$length" $process
        kill -STOP $process 2>/dev/null
        held=$(wc -l <"$to/history.csv")
        kill -"$signal" $process 2>/dev/null
        kill -CONT $process 2>/dev/null
        wait $process
        result=$?
        [ $result -eq 0 ] && [ "$held" -ge $(($(wc -l <"$to/history.csv") - 1)) ] || return
        rm -rf "$to"
        [ ! -e "$work/before" ] || cp -r "$work/before" "$to"
    done
}

# interrupted FOLDER LINES ARGUMENTS: starts a new run and stops it by SIGINT when history.csv has LINES lines; checks its exit status.
interrupted()
{
    rm -rf "$1"
    to=$1 length=$2; shift 2
    interrupt "$to" INT "$length" "$@"
    is "$to: interrupted" $result 130
}

# twice_interrupted FOLDER LINES LATER ARGUMENTS: starts a new run on 2 threads, stops it by SIGINT when history.csv has LINES lines,
# resumes it and stops it again at LATER lines. When the caller resumes it, threads and both stops are tested at once.
twice_interrupted()
{
    twice=$1 first=$2 later=$3; shift 3
    interrupted "$twice" "$first" "$@"
    interrupt "$twice" INT "$later" --resume "$@"
    is "$twice: interrupted again" $result 130
}

# piecewise FOLDER ARGUMENTS: performs a run in load steps on one thread that stops after each load step and is resumed, up to its end.
# $parts: number of its parts.
piecewise()
{
    to=$1 parts=0 status=130; shift
    while [ $status -eq 130 ] && [ $parts -lt 40 ]; do
        "$cleave" run -q -o "$to" -t 1 "$@" -s time.wall=1us --resume 2>"$work/err"
        status=$?
        parts=$((parts + 1))
    done
    is "$to: status, $(cat "$work/err")" $status 0
}

# coarser SCENE FACTOR: prints the arguments that multiply the spacing of a scene of inputs/ by FACTOR.
coarser()
{
    h=$(sed -n 's/^variables: .*[{ ]h: \([0-9.]*\) mm.*/\1/p' "$1")
    [ -z "$h" ] || { echo "-s variables.h=$(compute "$2 * $h")mm"; return; }
    echo "-s particles.spacing=$(compute "$2 * $(sed -n 's/^particles: {spacing: \([0-9.]*\) mm.*/\1/p' "$1")")mm"
}

# disturbances SIGNAL NUMBER REFERENCE ARGUMENTS: starts a run on a varying number of threads and sends it the signal at a random moment,
# then resumes it, NUMBER times. Whenever the run reaches its end, its results must equal those in the folder REFERENCE, and it begins anew.
disturbances()
{
    deed=$1 wanted=$2 reference=$3 ended_early=0 ended=0; shift 3
    longest=$(compute "0.9 * $(figure "$reference" wall_seconds)")
    rm -rf "$work/disturbed"
    while [ $ended_early -lt "$wanted" ] || [ $ended -eq 0 ]; do
        threads=$((1 + (ended_early + ended) % 3))
        "$cleave" run -q -o "$work/disturbed" -t $threads --resume "$@" >"$work/out" 2>"$work/err" &
        process=$!
        if [ $ended_early -lt "$wanted" ]; then
            sleep "$(random 0.01 "$longest")"
            kill -"$deed" $process 2>/dev/null
        fi
        wait $process 2>/dev/null
        result=$?
        case $deed$result in
        KILL137 | TERM130 | TERM143) ended_early=$((ended_early + 1)); continue ;;    # 143: before it handled the signal
        "$deed"0) ;;
        *) fail "after $ended_early times SIG$deed: status $result: $(cat "$work/err")"; return ;;
        esac
        ended=$((ended + 1))
        longest=$(compute "0.8 * $longest")      # the machine is less busy than during the reference: earlier
        same "after $ended_early times SIG$deed" "$reference" "$work/disturbed"
        rm -rf "$work/disturbed"
    done
    echo "$ended_early times SIG$deed, $ended runs to the end"
}
kills() { disturbances KILL "$@"; }
stops() { disturbances TERM "$@"; }
