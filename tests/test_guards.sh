#!/bin/sh
# floor 5: guards round a run: whose folder it is, what an older run there is worth, and descriptors that are not there.
test_name=test_guards
. tests/summary.sh
. tests/trust.sh
small="inputs/kalthoff_winkler.yaml -s particles.spacing=4mm -s output.frames=4 -s output.samples=40"

# refused WHAT FOLDER TEXT ARGUMENT...: exit status 2 and one line with this text.
refused()
{
    what=$1 folder=$2 text=$3; shift 3
    "$cleave" run -q -o "$folder" "$@" >"$work/out" 2>"$work/err"
    is "$what: exit status" $? 2
    is "$what: lines" "$(wc -l <"$work/err")" 1
    holds "$what: $(cat "$work/err")" grep -q "$text" "$work/err"
}

# ---- an older run -----------------------------------------------------------------------------------------------

calm "$work/once" $small -t 1
cp -r "$work/once" "$work/kept"
refused "the same command again" "$work/kept" "holds a finished run of this scene; go on with --resume, replace it with --overwrite" $small
same "left alone" "$work/once" "$work/kept"
calm "$work/kept" $small --overwrite
same "replaced" "$work/once" "$work/kept"
refused "both" "$work/kept" "one of them" $small --resume --overwrite
rm "$work/kept/summary.json"
refused "an interrupted run" "$work/kept" "holds an interrupted run of this scene" $small
rm "$work/kept"/checkpoint*.h5
refused "without its checkpoints" "$work/kept" "whose checkpoints are gone; replace it with --overwrite" $small --resume
"$cleave" run -q -o "$work/new" $small --resume 2>"$work/err"
is "nothing to resume: exit status" $? 0
holds "nothing to resume: said" grep -q "^warning: nothing to resume in $work/new" "$work/err"
same "nothing to resume" "$work/once" "$work/new"

# ---- two at a time -----------------------------------------------------------------------------------------------

"$cleave" run -q -o "$work/live" $flat -s particles.spacing=1mm -t 1 2>/dev/null &
first=$!
await "$work/live" 3 $first
for how in --resume --overwrite ""; do
    refused "a second run $how" "$work/live" "live: process $first on .* runs in it" $flat -s particles.spacing=1mm $how
done
kill -KILL $first
wait $first 2>/dev/null
holds "the lock of a dead process" test -e "$work/live/.running"
refused "a dead run of another scene" "$work/live" "another scene .*--overwrite" $small
calm "$work/live" $flat -s particles.spacing=1mm --resume        # locks of dead processes do not bind
holds "the lock goes with the run" test ! -e "$work/live/.running"

calm "$work/live" $small --overwrite
same "another scene, replaced" "$work/once" "$work/live"

# ---- files of others ---------------------------------------------------------------------------------------------

mkdir -p "$work/desk" "$work/elsewhere"
echo mine >"$work/desk/thesis.tmp"
ln -s "$work/elsewhere/made" "$work/desk/scene.yaml.tmp"
calm "$work/desk" $small
is "somebody's file" "$(cat "$work/desk/thesis.tmp")" mine
holds "a link is not written through" test ! -e "$work/elsewhere/made"
mkdir "$work/linked"
touch "$work/elsewhere/000000.hdf"
ln -s "$work/elsewhere" "$work/linked/frames"
refused "a folder of frames that is a link" "$work/linked" "frames is a link" $small
holds "what it leads to stays" test -e "$work/elsewhere/000000.hdf"

cp -r "$work/once" "$work/|touch PWNED;echo "
(cd "$work" && "$cleave" plot '|touch PWNED;echo ' >"$work/out" 2>&1)
is "a folder that looks like a command: exit status" $? 0
holds "no command runs" test ! -e "$work/PWNED"
holds "its pictures" test -e "$work/|touch PWNED;echo /pictures/energy.png"

# ---- descriptors ---------------------------------------------------------------------------------------------------

"$cleave" run -o "$work/closed" $small 0<&- 1>&- 2>&-
is "no descriptors: exit status" $? 0
same "no descriptors" "$work/once" "$work/closed"

# ---- what is no number -------------------------------------------------------------------------------------------

sed 's/^boundary:/boundary:\n  - {mirror: {axis: y, at: 0}}\n  - {mirror: {axis: y, at: 0, tangential: held}}/' inputs/kalthoff_winkler.yaml >"$work/twice.yaml"
refused "two mirrors in one place" "$work/twice" "its mirror stands where that of" "$work/twice.yaml"
"$cleave" run -q -o "$work/lost" $small -s material.young=1e-300 2>"$work/err"
holds "a modulus of nothing: exit status" test $? -ne 0
holds "a modulus of nothing: no number that is none" test -z "$(cut -d, -f3-8 "$work/lost/history.csv" 2>/dev/null | grep -i 'nan\|inf')"

# ---- reactions across a stop -------------------------------------------------------------------------------------

load="inputs/load_displacement.yaml -s particles.spacing=1mm -s output.samples=800 -s output.checkpoint=10ms"
calm "$work/load" $load
interrupted "$work/load_stopped" 300 $load
calm "$work/load_stopped" $load --resume
same "reactions, interrupted" "$work/load" "$work/load_stopped"

finish
