#!/bin/sh
# Extended version of test_trust.sh: 200 kills, stops at random moments, many threads, a disk that is full at every size.
test_name=long_trust
. tests/support/summary.sh
. tests/support/trust.sh
seed=${SEED:-$(date +%s)}
echo "seed $seed"

# ---- more threads than cores, whole scenes ------------------------------------------------------------------------------

for scene in hopkinson_bar plate_crack plate_hole kalthoff_winkler kalthoff_winkler_3d plate_impact_3d; do
    "$cleave" run -q inputs/$scene.yaml -s output.frames=4 -t 1 -o "$work/one" || fail "$scene"
    for threads in 2 3 5; do
        rm -rf "$work/many"; calm "$work/many" inputs/$scene.yaml -s output.frames=4 -t $threads
        same "$scene on $threads threads" "$work/one" "$work/many"
    done
    rm -rf "$work/one" "$work/many"
done
for arguments in "$line" "$flat" "$flat -s coupling=handshake" "$flat -s method=mpm" "$flat -s method=pd" "$solid"; do
    rm -rf "$work/one"; calm "$work/one" $arguments -t 1
    for threads in 4 7 8 16; do
        rm -rf "$work/many"; calm "$work/many" $arguments -t $threads
        same "$arguments on $threads threads" "$work/one" "$work/many"
    done
    rm -rf "$work/one" "$work/many"
done

# ---- kills ----------------------------------------------------------------------------------------------------------------

often="-s output.checkpoint=20ms"
calm "$work/flat_often" $flat $often
kills 100 "$work/flat_often" $flat $often
# Mostly writing: a checkpoint after every sample, 100 frames.
busy="-s output.checkpoint=0 -s output.frames=100"
calm "$work/flat_busy" $flat $busy
kills 30 "$work/flat_busy" $flat $busy
calm "$work/solid_often" $solid $often
kills 20 "$work/solid_often" $solid $often
# Points that repeatedly convert and revert, with a checkpoint after every step; cells that keep their points.
passing="inputs/bar_return.yaml -s particles.spacing=2mm -s output.frames=10 -s output.samples=1000000 -s output.checkpoint=0"
calm "$work/passing" $passing
kills 30 "$work/passing" $passing
calm "$work/mesh_often" $flat $often -s mpm.frame=reference -s mpm.transfer=flip
kills 20 "$work/mesh_often" $flat $often -s mpm.frame=reference -s mpm.transfer=flip

# ---- stops at random moments ------------------------------------------------------------------------------------------------

for case in line flat solid; do
    eval "arguments=\$$case"
    calm "$work/calm" $arguments
    stops=0 rounds=0
    while [ $rounds -lt 7 ]; do
        "$cleave" run -q -o "$work/stopped" -t $((1 + rounds % 3)) --resume $arguments 2>"$work/err" &
        process=$!
        sleep "$(random 0.05 0.5)"
        kill -TERM $process 2>/dev/null
        wait $process
        case $? in
            0) ;;
            130) stops=$((stops + 1)) ;;
            143) ;;                          # before it handled the signal
            *) fail "$case, stopped: $(cat "$work/err")" ;;
        esac
        rounds=$((rounds + 1))
    done
    calm "$work/stopped" --resume $arguments
    same "$case after $stops stops" "$work/calm" "$work/stopped"
    rm -rf "$work/calm" "$work/stopped"
done

# Closing a terminal ends the run, unless it was started by nohup.
interrupted "$work/hangup" 20 $flat
(trap '' HUP; exec "$cleave" run -q -o "$work/hangup" --resume $flat 2>"$work/err") &
process=$!
await "$work/hangup" 40 $process
kill -HUP $process
wait $process
is "a hang-up that is ignored: exit status" $? 0

# ---- a disk that becomes full, at every size -------------------------------------------------------------------------------

interrupted "$work/part" 50 $flat $often
checkpoint=$(wc -c <"$work/part/checkpoint.h5")
step=$((checkpoint / 25))
for k in 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25; do
    limit=$((k * step))
    rm -rf "$work/full"
    cp -r "$work/part" "$work/full"
    said=$(ulimit -f $((limit / 512)); "$cleave" run -q -o "$work/full" -t 2 --resume $flat $often 2>&1; echo "status $?")
    echo "$said" >"$work/said"
    is "$limit bytes: exit status" "$(tail -n 1 "$work/said")" "status 1"
    is "$limit bytes: lines" "$(wc -l <"$work/said")" 2
    for file in checkpoint.h5 checkpoint.previous.h5; do
        holds "$limit bytes: $file" cmp "$work/part/$file" "$work/full/$file"
    done
    calm "$work/full" --resume $flat $often
    same "after a limit of $limit bytes" "$work/flat_often" "$work/full"
done

# A full file system, if this user may mount one.
if unshare -rm true 2>/dev/null; then
    mkdir -p "$work/small"
    for size in 200k 700k 1500k 3000k 5000k; do
        rm -rf "$work/saved"
        unshare -rm sh -c 'mount -t tmpfs -o size='$size' small "$1/small" || exit 77
            "$1/cleave" run -q -o "$1/small/run" -t 2 $2 2>"$1/err"
            result=$?
            cp -r "$1/small/run" "$1/saved"
            exit $result' sh "$work" "$flat $often"
        result=$?
        [ $result -eq 77 ] && { echo "no file system of $size: not tested"; continue; }
        is "a file system of $size: exit status" $result 1
        is "a file system of $size: lines" "$(wc -l <"$work/err")" 1
        holds "a file system of $size: says $(cat "$work/err")" grep -q 'No space left' "$work/err"
        calm "$work/saved" --resume $flat $often
        same "after a file system of $size" "$work/flat_often" "$work/saved"
    done
else
    echo "this user may mount nothing: no full file system tested"
fi

finish
