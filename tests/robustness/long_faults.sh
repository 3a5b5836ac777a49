#!/bin/sh
# Makes each call of the whole process fail once, libraries included, and tests file systems that are full, without inodes, read-only or
# removed during a run. Saved data stay unchanged, and runs resume from them once writing is possible.
test_name=long_faults
[ ! -w /dev/shm ] || export TMPDIR=/dev/shm       # in memory, to avoid waiting for a disk
. tests/support/summary.sh
. tests/support/trust.sh
small="inputs/kalthoff_winkler.yaml $current -s particles.spacing=4mm -s time.step=0.2us -s output.frames=10 -s output.samples=100 -s output.checkpoint=10ms"

# ---- every call ------------------------------------------------------------------------------------------------------

if "${BUILD:-build}/tests/robustness/test_faults" whole >"$work/whole" 2>&1; then pass
else
    [ $? -ne 77 ] || echo "no linker that wraps calls: not tested"
    grep -q 'not tested' "$work/whole" || fail "$(cat "$work/whole")"
fi
cat "$work/whole"

# ---- file systems ----------------------------------------------------------------------------------------------------

calm "$work/calm" $small -t 1
interrupted "$work/part" 40 $small

# refusing WHAT TEXT: checks that the run, whose exit status is $result, failed with one line (in $work/err) that contains TEXT.
refusing()
{
    holds "$1: exit status $result" test $result -eq 1 -o $result -eq 2
    is "$1: lines" "$(grep -c -v '^warning: ' "$work/err")" 1
    holds "$1: says $(cat "$work/err")" grep -q "$2" "$work/err"
}

# goes_on WHAT FOLDER: checks that both checkpoints in FOLDER are those before the disturbance, and that the run resumes and ends with the
# results of an undisturbed run.
goes_on()
{
    for file in checkpoint.h5 checkpoint.previous.h5; do holds "$1: $file" cmp "$work/part/$file" "$2/$file"; done
    calm "$2" --resume $small
    same "$1" "$work/calm" "$2"
}

# mounted OPTIONS: resumes the interrupted run in a new tmpfs file system remounted with these options. Copies the result to $work/after;
# $result: exit status, 77 if nothing could be mounted.
mounted()
{
    rm -rf "$work/after"; mkdir -p "$work/mounted"
    unshare -rm sh -c 'mount -t tmpfs small "$1/mounted" && cp -r "$1/part" "$1/mounted/run" && mount -o remount,"$2" "$1/mounted" || exit 77
        "$1/cleave" run -q -o "$1/mounted/run" -t 2 --resume $3 2>"$1/err"
        result=$?
        cp -r "$1/mounted/run" "$1/after"
        exit $result' sh "$work" "$1" "$small"
    result=$?
}
if unshare -rm true 2>/dev/null; then
    mounted ro
    refusing "a read-only file system" "Read-only file system"
    goes_on "a read-only file system" "$work/after"
    entries=$(find "$work/part" | wc -l)
    mounted nr_inodes=$((entries + 2))
    refusing "no inodes" "No space left"
    goes_on "no inodes" "$work/after"
    room=$(du -sk "$work/part" | cut -f1)
    for more in 4 40 200; do
        mounted size=$((room + more))k
        refusing "a file system with $more kB left" "No space left"
        goes_on "a file system with $more kB left" "$work/after"
    done
else
    echo "this user may mount nothing: no file systems tested"
fi

# A folder that is removed during a run: the run ends with a message.
for what in run run/frames; do
    rm -rf "$work/gone"; mkdir "$work/gone"
    "$cleave" run -q -o "$work/gone/run" -t 2 $flat -s particles.spacing=1mm 2>"$work/err" &
    process=$!
    await "$work/gone/run" 5 $process
    mv "$work/gone/$what" "$work/gone/moved"
    wait $process
    result=$?
    refusing "$what goes" "cannot write .*No such file\|was moved, removed or replaced"
done
result=0
"$cleave" run -q -o "$work/$(awk 'BEGIN { for (k = 0; k < 300; k++) printf "n" }')" $small 2>"$work/err" || result=$?
refusing "a name of 300 letters" "name too long"

finish
