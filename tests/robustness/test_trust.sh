#!/bin/sh
# Reproducibility: bitwise equal results on any number of threads and after any interruption, and no silent failure.
# Runs alone: it stops and kills runs of several threads at any stage.
# Takes 45 s: runs that are interrupted or killed, and continued.
test_name=test_trust
. tests/support/summary.sh
. tests/support/trust.sh
seed=${SEED:-$(date +%s)}
echo "seed $seed"

# ---- threads -------------------------------------------------------------------------------------------------------

for scene in line flat solid; do
    eval "arguments=\$$scene"
    case $scene in flat) teams="2 3" ;; *) teams=2 ;; esac          # solid on 3 threads: test_frame.sh
    for threads in 1 $teams; do calm "$work/$scene$threads" $arguments -t $threads; done
    for threads in $teams; do same "$scene on $threads threads" "$work/${scene}1" "$work/$scene$threads"; done
    holds "$scene: nothing converted, so nothing was tested" test -n "$(figure "$work/${scene}1" conversion.first_time)"
    holds "$scene: nothing broke, so nothing was tested" test -n "$(figure "$work/${scene}1" crack.start_time)"
    rm -r "$work/$scene"[23]
done

# ---- interrupted ---------------------------------------------------------------------------------------------------

# Stopped once by each signal, and resumed on another number of threads each time.
rm -rf "$work/stopped"
lines=15
# (A shell under nohup passes on that SIGHUP is ignored: the run then rightly continues, and TERM is used instead.)
hangup=HUP
[ -z "$(sh -c 'kill -HUP $$; echo deaf' 2>/dev/null)" ] || hangup=TERM
for signal in INT TERM $hangup XCPU USR1 USR2; do
    interrupt "$work/stopped" $signal $lines --resume $flat
    is "SIG$signal: exit status" $result 130
    is "SIG$signal: lines on standard error" "$(grep -c -v "^warning: " "$work/err")" 1
    holds "SIG$signal: the message" grep -q 'interrupted at step .*--resume' "$work/err"
    is "SIG$signal: summary" "$(figure "$work/stopped" status)" interrupted
    lines=$((lines + 12))
done
calm "$work/stopped" -t 3 --resume $flat
same "after six interruptions" "$work/flat1" "$work/stopped"
(trap '' INT; exec "$cleave" run -q -o "$work/deaf" $flat 2>"$work/err") &
process=$!
await "$work/deaf" 10 $process
kill -INT $process
wait $process
is "SIGINT that is ignored: exit status" $? 0
same "SIGINT that is ignored" "$work/flat1" "$work/deaf"
rm -rf "$work/deaf"
# Repeated notices of a batch system: one stops the run, and further ones never kill it.
rm -rf "$work/noticed"
"$cleave" run -q -o "$work/noticed" $flat 2>"$work/err" &
process=$!
await "$work/noticed" 20 $process
while kill -USR1 $process 2>/dev/null; do :; done
wait $process
is "SIGUSR1 without end: exit status" $? 130
calm "$work/noticed" --resume $flat
same "SIGUSR1 without end" "$work/flat1" "$work/noticed"
# Limits on wall-clock time, of an hour and of almost zero.
calm "$work/wall" $flat -s time.wall=1h
same "an hour of wall clock" "$work/flat1" "$work/wall"
"$cleave" run -q -o "$work/wall" --overwrite $flat -s time.wall=20ms 2>"$work/err"
is "20 ms of wall clock: exit status" $? 130
holds "20 ms of wall clock: said" grep -q 'time.wall is reached at step .*--resume' "$work/err"
calm "$work/wall" --resume $flat
same "20 ms of wall clock, resumed without a limit" "$work/flat1" "$work/wall"

# A finished run is recognised as finished.
cp -r "$work/stopped" "$work/finished"
calm "$work/finished" --resume $flat
same "finished, resumed" "$work/flat1" "$work/finished"

# Another scene in the same folder.
"$cleave" run -q -o "$work/finished" --resume $flat -s material.density=7801 2>"$work/err"
is "resumed with another scene: exit status" $? 2
same "after the refusal" "$work/flat1" "$work/finished"

# Particles that are made during the run: each set of them has a particles file, and an interruption leaves the same ones.
made="inputs/kalthoff_winkler.yaml -s mpm.fill=needed -s mpm.levels=2 -s particles.spacing=0.5mm -s output.frames=8 -s output.samples=500"
calm "$work/made" $made
holds "several particles files" test "$(ls "$work/made/frames" | grep -c '^particles_')" -gt 2
interrupted "$work/made_again" 250 $made
calm "$work/made_again" --resume $made
same "interrupted between particles files" "$work/made" "$work/made_again"

# ---- killed --------------------------------------------------------------------------------------------------------

often="-s output.checkpoint=20ms"
calm "$work/flat_often" $flat $often
kills 10 "$work/flat_often" $flat $often

# ---- a damaged checkpoint ------------------------------------------------------------------------------------------

rm -rf "$work/stopped"
interrupted "$work/stopped" 40 $flat
printf 'X' | dd of="$work/stopped/checkpoint.h5" bs=1 seek=5000 conv=notrunc 2>/dev/null
"$cleave" run -q -o "$work/stopped" --resume $flat 2>"$work/err"
is "newest checkpoint damaged: exit status" $? 0
holds "newest checkpoint damaged: says so" grep -q 'resuming from checkpoint.previous.h5' "$work/err"
same "newest checkpoint damaged" "$work/flat1" "$work/stopped"

# From the checkpoint of step 0, which every run has.
rm -rf "$work/stopped"
calm "$work/stopped" -t 1 $flat
mv "$work/stopped/checkpoint.previous.h5" "$work/stopped/checkpoint.h5"
calm "$work/stopped" -t 2 --resume $flat
same "from step 0" "$work/flat1" "$work/stopped"

# ---- a disk that becomes full ----------------------------------------------------------------------------------------

# Files may not exceed a limit: first nothing fits, then small files, then all but a frame, all but a checkpoint. Both checkpoints must be
# unchanged, and the run must resume from them once there is space.
rm -rf "$work/stopped"
interrupted "$work/stopped" 50 $flat $often
frame=$(wc -c <"$work/stopped/frames/000000.hdf")
checkpoint=$(wc -c <"$work/stopped/checkpoint.h5")
holds "a checkpoint is larger than a frame" test "$checkpoint" -gt "$frame"
nothing=0
if ! (ulimit -f 0; "$cleave" info 2>&1) | grep -q '^cleave'; then      # clang's OpenMP creates a file when it starts
    echo "the OpenMP library starts no program that may write 0 bytes: not tested"
    nothing=""
fi
for limit in $nothing 4096 $((frame / 2)) $((frame - 600)) $((frame + 2048)) $(((frame + checkpoint) / 2)); do
    rm -rf "$work/full"
    cp -r "$work/stopped" "$work/full"
    # Through a pipe: the limit would also apply to a file.
    said=$(ulimit -f $((limit / 512)); "$cleave" run -q -o "$work/full" -t 2 --resume $flat $often 2>&1; echo "status $?")
    echo "$said" >"$work/said"
    is "$limit bytes: exit status" "$(tail -n 1 "$work/said")" "status 1"
    is "$limit bytes: lines" "$(grep -c -v "^warning: " "$work/said")" 2
    holds "$limit bytes: the message: $said" grep -q '^cannot write .*File too large' "$work/said"
    for file in checkpoint.h5 checkpoint.previous.h5; do
        holds "$limit bytes: $file" cmp "$work/stopped/$file" "$work/full/$file"
    done
    calm "$work/full" --resume $flat $often
    same "after a limit of $limit bytes" "$work/flat_often" "$work/full"
done

# Files left by a killed process.
touch "$work/full/checkpoint.h5.cleave.tmp" "$work/full/frames/000099.hdf.cleave.tmp"
calm "$work/full" --resume $flat $often
bare "stale files" "$work/full"

# Standard output.
for words in "run $line -o $work/loud" "check $line" "help" "help time.step" "info" "--help"; do
    "$cleave" $words >/dev/full 2>"$work/err"
    is "$words >/dev/full: exit status" $? 1
    is "$words >/dev/full: lines on standard error" "$(grep -c -v '^warning: ' "$work/err")" 1
done

# ---- ownership of folders ----------------------------------------------------------------------------------------------

echo text >"$work/plain"
mkdir "$work/foreign"
echo text >"$work/foreign/letter.txt"
calm "$work/other" $line
cp -r "$work/other" "$work/other_before"
for place in plain plain/below foreign other; do
    "$cleave" run -q -o "$work/$place" $flat 2>"$work/err"
    is "-o $place: exit status" $? 2
    is "-o $place: lines on standard error" "$(grep -c -v "^warning: " "$work/err")" 1
done
is "a plain file stays" "$(cat "$work/plain")" text
is "a foreign folder stays" "$(ls "$work/foreign")" letter.txt
holds "another run stays" diff -r "$work/other" "$work/other_before"
calm "$work/other" $line --overwrite
same "the same scene again" "$work/other_before" "$work/other"

# ---- unstable runs -------------------------------------------------------------------------------------------------------

# Steps above the critical one: stopped with step, position and cause, and never a NaN on disk.
unstable()
{
    what=$1; shift
    rm -rf "$work/unstable"
    "$cleave" run -q -o "$work/unstable" $flat "$@" 2>"$work/err"
    is "$what: exit status" $? 1
    is "$what: lines on standard error" "$(grep -c -v '^warning: ' "$work/err")" 1
    holds "$what: step, place and cause in: $(cat "$work/err")" \
        grep -q 'unstable at step [0-9]*, t = .* s: particle [0-9]* at (.*) m .*; .*time' "$work/err"
    is "$what: status" "$(figure "$work/unstable" status)" failed
    holds "$what: message" test -n "$(figure "$work/unstable" message)"
    # tip_z does not exist in 2D, tip_x and tip_y do not before a crack grows: the only columns that may be nan.
    awk -F, 'NR > 1 { for (k = 1; k <= NF; k++) if ($k !~ /^-?[0-9]/ && !(k >= 17 && k <= 19)) exit 1 }' \
        "$work/unstable/history.csv"
    is "$what: numbers in history.csv" $? 0
    holds "$what: samples" test "$(wc -l <"$work/unstable/history.csv")" -ge 2
    "$cleave" compare "$work/unstable" "$work/unstable" >"$work/out" 2>&1
    holds "$what: no frame holds nan" sh -c "! grep -qi nan '$work/out'"
}
unstable "pd, safety 1.9" -s method=pd -s time.step=auto -s time.safety=1.9
unstable "pd, thrice the step" -s method=pd -s time.step=1.5us
unstable "mpm, thrice the step" -s method=mpm -s time.step=1.6us -s duration=500us
unstable "adaptive, thrice the step" -s method=adaptive -s time.step=1.5us -s duration=500us

finish
