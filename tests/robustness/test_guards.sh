#!/bin/sh
# Protection of folders: which folders a run may use or replace, what happens to an older run and to other files in them, and closed
# standard descriptors.
# Takes 25 s: some 300 starts of the program, two thirds of them refusals, and runs that hold a folder while others request it.
test_name=test_guards
. tests/support/summary.sh
. tests/support/trust.sh
small="inputs/kalthoff_winkler.yaml -s particles.spacing=4mm -s output.frames=4 -s output.samples=40"

# ---- an older run -----------------------------------------------------------------------------------------------

calm "$work/once" $small -t 1
cp -r "$work/once" "$work/kept"
refused "the same command again" "$work/kept" "contains a finished run of this scene; continue with --resume, replace it with --overwrite" $small
same "left alone" "$work/once" "$work/kept"
calm "$work/kept" $small --overwrite
same "replaced" "$work/once" "$work/kept"
refused "both" "$work/kept" "one of the two" $small --resume --overwrite
sed -i 's/"done"/"failed"/' "$work/kept/summary.json"
refused "a failed run" "$work/kept" "contains a failed run of this scene" $small
rm "$work/kept/summary.json"
refused "an interrupted run" "$work/kept" "contains an interrupted run of this scene" $small
rm "$work/kept"/checkpoint*.h5
refused "without its checkpoints" "$work/kept" "has no checkpoint left; start again with --overwrite" $small --resume
"$cleave" run -q -o "$work/new" $small --resume 2>"$work/err"
is "nothing to resume: exit status" $? 0
holds "nothing to resume: said" grep -q "^warning: $work/new has no checkpoint" "$work/err"
same "nothing to resume" "$work/once" "$work/new"

# ---- two runs at a time ------------------------------------------------------------------------------------------

"$cleave" run -q -o "$work/live" $flat -s particles.spacing=1mm -t 1 2>/dev/null &
first=$!
await "$work/live" 3 $first
kill -STOP $first                        # holds the folder, however fast the machine is
for how in --resume --overwrite ""; do
    refused "a second run $how" "$work/live" "live: this folder is in use by a run, process $first on" $flat -s particles.spacing=1mm $how
done
kill -KILL $first
wait $first 2>/dev/null
holds "the lock of a dead process" test -e "$work/live/.running"
refused "a dead run of another scene" "$work/live" "another scene, with .*--overwrite" $small
calm "$work/live" $flat -s particles.spacing=1mm --resume        # locks of ended processes have no effect
holds "the lock goes with the run" test ! -e "$work/live/.running"

calm "$work/live" $small --overwrite
same "another scene, replaced" "$work/once" "$work/live"

# A folder that is removed during a run: the next run there has it for itself.
"$cleave" run -q -o "$work/gone" $flat -s particles.spacing=1mm -s output.checkpoint=0 2>"$work/err_gone" &
first=$!
await "$work/gone" 3 $first
kill -STOP $first
mv "$work/gone" "$work/moved"
calm "$work/gone" $small
kill -CONT $first
wait $first
is "a folder that is moved: exit status" $? 1
holds "a folder that is moved: said" grep -q "gone was moved, removed or replaced" "$work/err_gone"
same "a folder that is moved: the next run" "$work/once" "$work/gone"

# A lock file that is also a link to another user's file.
echo mine >"$work/mine"
ln "$work/mine" "$work/once/.running"
refused "a lock with another name" "$work/once" "running is a hard link" $small --overwrite
is "and what is in it" "$(cat "$work/mine")" mine
rm "$work/once/.running"

# ---- files of others ---------------------------------------------------------------------------------------------

mkdir -p "$work/desk" "$work/elsewhere"
echo mine >"$work/desk/thesis.tmp"
ln -s "$work/elsewhere/made" "$work/desk/scene.yaml.cleave.tmp"
ln -s "$work/elsewhere/made" "$work/desk/along_000000.csv.cleave.tmp"
sed 's/^probes: .tip./probes: [tip, {line: {name: along, from: [0, 10 mm], to: [50 mm, 10 mm]}}]/' inputs/kalthoff_winkler.yaml >"$work/along.yaml"
holds "the scene has the probe" grep -q along "$work/along.yaml"
calm "$work/desk" $(echo "$small" | sed "s#inputs/kalthoff_winkler.yaml#$work/along.yaml#")
is "somebody's file" "$(cat "$work/desk/thesis.tmp")" mine
holds "a link is not written through" test ! -e "$work/elsewhere/made"
mkdir "$work/linked"
touch "$work/elsewhere/000000.hdf"
ln -s "$work/elsewhere" "$work/linked/frames"
refused "a folder of frames that is a symbolic link" "$work/linked" "frames is a symbolic link" $small
holds "what it leads to stays" test -e "$work/elsewhere/000000.hdf"

cp -r "$work/once" "$work/|touch PWNED;echo "
(cd "$work" && "$cleave" plot '|touch PWNED;echo ' --size 90mmx70mm >"$work/out" 2>&1)
is "a folder that looks like a command: exit status" $? 0
for name in damage energy; do
    echo thesis >"$work/thesis"
    ln -sf "$work/thesis" "$work/once/pictures/$name.png.cleave.tmp" 2>/dev/null ||
        { mkdir "$work/once/pictures"; ln -s "$work/thesis" "$work/once/pictures/$name.png.cleave.tmp"; }
done
"$cleave" plot "$work/once" --size 90mmx70mm >"$work/out" 2>&1
is "a picture writes through no link" "$(cat "$work/thesis")" thesis
rm -r "$work/once/pictures"
ln -s "$work" "$work/once/pictures"
"$cleave" plot "$work/once" --size 90mmx70mm >"$work/out" 2>"$work/err"
is "a folder of pictures that is a symbolic link" $? 2
rm "$work/once/pictures"
tabbed=$(printf '%s/a\tb' "$work")
cp -r "$work/once" "$tabbed"
"$cleave" plot "$tabbed" --size 90mmx70mm >"$work/out" 2>"$work/err"
is "a folder with a tab: exit status" $? 2
is "a folder with a tab: lines" "$(wc -l <"$work/err")" 1
rm -r "$tabbed"
holds "no command runs" test ! -e "$work/PWNED"
holds "its pictures" test -e "$work/|touch PWNED;echo /pictures/energy.png"

# ---- a small stack -----------------------------------------------------------------------------------------------

if (ulimit -s 64) 2>/dev/null; then
    (ulimit -s 64 && exec "$cleave" run -q -o "$work/narrow" $small) 2>"$work/err"
    case $? in
    0) is "a stack of 64 kB, enough: said" "$(cat "$work/err")" "" ;;
    1) is "a stack of 64 kB, too small: said" "$(wc -l <"$work/err") $(grep -c 'ulimit -s' "$work/err")" "1 1" ;;
    *) fail "a stack of 64 kB: a crash without a word: $(cat "$work/err")" ;;
    esac
else
    echo "a small stack: not tested, since ulimit -s cannot be set here"
fi

# ---- particle lists ----------------------------------------------------------------------------------------------

mkdir "$work/lists"
awk 'BEGIN { print "x,y,volume"; for (k = 0; k < 400; k++) print (k % 20 + 0.5) * 1e-3 "," (int(k / 20) + 0.5) * 1e-3 ",1e-9" }' >"$work/lists/grains.csv"
cat >"$work/lists/grains.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 20 us
method: pd
material: {young: 200 GPa, poisson: 1/3, density: 7800}
particles: {spacing: 1 mm}
bodies: [{particles: grains.csv}]
boundary: [{name: pull, traction: [1 MPa, 0], face: x+}]
END
(cd "$work/lists" && "$cleave" run -q -o ran grains.yaml) || fail "a particle list"
mv "$work/lists/grains.yaml" "$work/lists/moved.yaml"
calm "$work/again" "$work/lists/ran/scene.yaml"
is "its echo, run from elsewhere" "$(cat "$work/again/history.csv")" "$(cat "$work/lists/ran/history.csv")"
calm "$work/again" "$work/lists/ran/scene.yaml" --resume
mkdir "$work/lists/deeper"
cp "$work/lists/grains.csv" "$work/lists/deeper"
cp "$work/lists/moved.yaml" "$work/lists/deeper/grains.yaml"
calm "$work/again" "$work/lists/deeper/grains.yaml" --resume     # the same contents in another folder
sed -i '7s/1e-9/1.1e-9/' "$work/lists/grains.csv"
refused "a list that changed" "$work/again" "particles: .*grains.csv.*contents .* in place of .particles: .*grains.csv.*contents " "$work/lists/ran/scene.yaml" --resume
calm "$work/again" "$work/lists/ran/scene.yaml" --overwrite

# ---- lost or damaged frames ---------------------------------------------------------------------------------------

rm -rf "$work/part"
interrupted "$work/part" 30 $small -s output.frames=6
rm "$work/part/frames/000001.hdf"
printf 'short' >"$work/part/frames/000003.hdf"
warned "frames that are lost" "$work/part" "frames/000001.hdf is missing, and 1 more frames are lost" $small -s output.frames=6 --resume
is "the index leaves them out" "$(grep -c '"time"' "$work/part/frames.hdf.series")" 5
is "and so does the other" "$(grep -c '<Time ' "$work/part/frames.xdmf")" 5
holds "plots go on" "$cleave" plot "$work/part" --frames all --size 90mmx70mm >/dev/null
holds "a picture of the frame behind the gap" test -e "$work/part/pictures/damage_000004.png"
calm "$work/whole" $small -s output.frames=6
for frame in 000000 000002 000006; do holds "frame $frame" cmp "$work/part/frames/$frame.hdf" "$work/whole/frames/$frame.hdf"; done
# What frames share is lost: those frames are left out, and the next ones have a file of their own.
rm -rf "$work/lone"
interrupted "$work/lone" 30 $small -s output.frames=6
cp -r "$work/lone" "$work/bent"
rm "$work/lone/frames/particles_000000.h5"
"$cleave" plot "$work/lone" --size 90mmx70mm >"$work/out" 2>"$work/err"
is "frames without what they share: exit status" $? 1
is "frames without what they share: lines" "$(wc -l <"$work/err")" 1
holds "frames without what they share: $(cat "$work/err")" grep -q "particles_000000.h5 in the same folder, to which it links, is missing" "$work/err"
printf 'x' | dd of="$work/bent/frames/particles_000000.h5" bs=1 seek=4000 conv=notrunc 2>/dev/null
cp -r "$work/lone" "$work/alien"
calm "$work/other" $small -s particles.spacing=5mm -s output.frames=6
cp "$work/other/frames/particles_000000.h5" "$work/alien/frames/"
for lost in lone bent alien; do
    warned "$lost: frames that lost what they share" "$work/$lost" "frames/000000.hdf links to frames/particles_000000.h5, which \(is\|belongs to\) " $small -s output.frames=6 --resume
    holds "$lost: another one" test "$(ls "$work/$lost/frames" | grep -c '^particles_00000[1-6].h5$')" -eq 1
    holds "$lost: the last frame is that of a whole run" "$cleave" compare "$work/$lost" "$work/whole" >/dev/null
done
# A resumed run leaves pictures that are being drawn.
touch "$work/part/pictures/damage.png.cleave.tmp"
calm "$work/part" $small -s output.frames=6 --resume
holds "a picture half drawn" test -e "$work/part/pictures/damage.png.cleave.tmp"
# A replaced run loses its pictures, finished or not; pictures of others stay.
touch "$work/part/pictures/mine.png" "$work/part/pictures/damage_mine.png"
rm "$work/part/frames/000003.hdf"
calm "$work/part" $small --overwrite
is "pictures of the run before" "$(cd "$work/part/pictures" && echo *)" "damage_mine.png mine.png"
# Profiles of probes: lost ones are reported, and those of a longer run are removed with it.
cat >"$work/lined.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 20 us
material: {young: 200 GPa, density: 8000}
body: {box: {from: [0, 0], to: [80 mm, 10 mm]}}
particles: {spacing: 0.5 mm}
initial: [{pulse: {at: [40 mm, 0], width: 32 mm, velocity: -10 m/s, direction: [1, 0]}}]
output: {frames: 4, samples: 60}
probes: [{line: {name: axis, from: [0, 5 mm], to: [80 mm, 5 mm]}}]
END
calm "$work/lined" "$work/lined.yaml"
interrupted "$work/profiles" 30 "$work/lined.yaml"
rm "$work/profiles/axis_000000.csv" "$work/profiles/axis_000001.csv"
warned "profiles that are lost" "$work/profiles" "axis_000000.csv is missing, and 1 more profiles are" "$work/lined.yaml" --resume
for k in 2 3 4; do holds "profile $k" cmp "$work/profiles/axis_00000$k.csv" "$work/lined/axis_00000$k.csv"; done
calm "$work/lined" "$work/lined.yaml" -s output.frames=2 --overwrite
is "profiles of fewer frames" "$(ls "$work/lined" | grep -c '^axis_')" 3
size=$(wc -c <"$work/whole/frames/000006.hdf")
for k in 1 2 3 4 5 6 7 8 9 10 11 12; do
    cp "$work/whole/frames/000006.hdf" "$work/frame"
    at=$((size * k / 13))
    byte=$(od -An -tu1 -j "$at" -N 1 "$work/frame" | tr -d ' ')
    printf "\\$(printf %o $((byte ^ 4)))" | dd of="$work/whole/frames/000006.hdf" bs=1 seek="$at" conv=notrunc 2>/dev/null
    "$cleave" compare "$work/part" "$work/whole" >"$work/out" 2>"$work/err"
    is "byte $at of a frame: exit status" $? 1
    holds "byte $at of a frame: $(cat "$work/err")" grep -q "000006.hdf: it is" "$work/err"
    cp "$work/frame" "$work/whole/frames/000006.hdf"
done
holds "the frame as it was" "$cleave" compare "$work/part" "$work/whole" >/dev/null

# ---- promises ----------------------------------------------------------------------------------------------------

"$cleave" help trust >"$work/promises" || fail "help trust"
for test in $(grep -o '\(test\|long\)_[a-z_]*\.\(sh\|c\)' "$work/promises" | sort -u); do
    holds "$test, which help trust names, is there" test -n "$(find tests -name "$test")"
    holds "$test is explained in tests/README.md" grep -q "${test%.*}" tests/README.md
done

# ---- help of a command ----------------------------------------------------------------------------------------------

for command in run check; do
    "$cleave" $command --help >"$work/out" 2>"$work/err"
    is "$command --help: exit status" $? 0
    is "$command --help: first words" "$(head -n 1 "$work/out" | cut -d ' ' -f 1-2)" "cleave $command"
done

# Exchanged frames, a history of another run, warnings of a finished run.
cp -r "$work/whole" "$work/swapped"
mv "$work/swapped/frames/000001.hdf" "$work/frame"
mv "$work/swapped/frames/000002.hdf" "$work/swapped/frames/000001.hdf"
mv "$work/frame" "$work/swapped/frames/000002.hdf"
warned "frames that changed places" "$work/swapped" "frames/000001.hdf belongs to another time, and 1 more frames" $small -s output.frames=6 --resume
sed -i '5s/1/2/' "$work/swapped/history.csv"
stopped "a history that changed" "$work/swapped" "history.csv is not the file that it was.*--overwrite" $small -s output.frames=6 --resume
holds "no index of all frames is left of the run before" test ! -e "$work/swapped/frames.vtkhdf"
mkfifo "$work/pipe"
mv "$work/pipe" "$work/swapped/history.csv" 2>/dev/null
"$cleave" compare "$work/swapped" "$work/whole" >"$work/out" 2>"$work/err"
is "a history that is a pipe: exit status" $? 1
rm -r "$work/swapped"

# ---- descriptors ---------------------------------------------------------------------------------------------------

"$cleave" run -o "$work/closed" $small 0<&- 1>&- 2>&-
is "no descriptors: exit status" $? 0
same "no descriptors" "$work/once" "$work/closed"

# ---- numbers that are not finite ---------------------------------------------------------------------------------

sed 's/^boundary:/boundary:\n  - {mirror: {axis: y, at: 0}}\n  - {mirror: {axis: y, at: 0, tangential: held}}/' inputs/kalthoff_winkler.yaml >"$work/twice.yaml"
refused "two mirrors in one place" "$work/twice" "its mirror plane is also that of" "$work/twice.yaml"
"$cleave" run -q -o "$work/lost" $small -s material.young=1e-300 2>"$work/err"
holds "a modulus of nothing: exit status" test $? -ne 0
holds "a modulus of nothing: no number that is none" test -z "$(cut -d, -f3-8 "$work/lost/history.csv" 2>/dev/null | grep -i 'nan\|inf')"

# ---- reactions before and after a stop ---------------------------------------------------------------------------

load="inputs/load_displacement.yaml -s particles.spacing=1mm -s duration=50us -s output.samples=500 -s output.checkpoint=10ms"
calm "$work/load" $load
interrupted "$work/load_stopped" 250 $load
calm "$work/load_stopped" $load --resume
same "reactions, interrupted" "$work/load" "$work/load_stopped"


# ---- all commands that write ---------------------------------------------------------------------------------------

# declined WHAT TEXT COMMAND...: checks for exit status 2 and one line with this text, within seconds.
declined()
{
    what=$1 text=$2; shift 2
    timeout 20 "$cleave" "$@" >"$work/out" 2>"$work/err"
    is "$what: exit status" $? 2
    is "$what: lines" "$(grep -c -v '^warning: ' "$work/err")" 1
    holds "$what: $(cat "$work/err")" grep -q -e "$text" "$work/err"
}
# kept WHAT FOLDER: checks that the folder contains the files that `desk` created, unchanged.
kept() { is "$1: files of others" "$(cat "$2"/* 2>/dev/null)" "$(cat "$work/papers"/*)"; }
cat >"$work/strip.yaml" <<'END'
# comments of the user
space: plane stress
thickness: 1 mm
duration: 1 us
method: pd
material: {young: 72 GPa, density: 2440}
body: {box: {from: [0, 0], to: [10 mm, 5 mm]}}
particles: {spacing: 1 mm}
boundary: [{name: pull, traction: [0, 1 MPa], face: y+}]
probes: [tip]
output: {frames: 1, samples: 4}
END
mkdir "$work/papers"
for name in README.txt plate.data sweep.csv converge.csv study.yaml history.csv; do echo "$name of mine" >"$work/papers/$name"; done
cp "$work/strip.yaml" "$work/papers/scene.yaml"
for command in "export lammps $work/papers/scene.yaml --allow-different" "sweep $work/papers/scene.yaml -s method=pd,mpm" \
    "sweep $work/papers/scene.yaml -s method=pd,mpm --overwrite --collect" "converge $work/papers/scene.yaml" \
    "converge $work/strip.yaml --overwrite" "run $work/papers/scene.yaml" "run $work/strip.yaml --overwrite" \
    "run $work/strip.yaml -s duration=2us --overwrite"; do
    rm -rf "$work/desk"
    cp -r "$work/papers" "$work/desk"
    declined "$command" "contains" $(echo "$command" | sed "s#/papers/#/desk/#") -o "$work/desk"
    kept "$command" "$work/desk"
done

mkdir "$work/album" "$work/album/frames"
for name in frames/holiday.jpg scene.yaml history.csv summary.json; do echo "$name of mine" >"$work/album/$name"; done
declined "an album with frames" "contains files" run -q "$work/strip.yaml" -o "$work/album" --overwrite
is "an album: files of others" "$(cat "$work/album/history.csv")" "history.csv of mine"

# -o itself may be a link to a folder: the run is written there, and what the folder holds is guarded as without a link.
mkdir "$work/disk"
ln -s disk "$work/short"
"$cleave" run -q "$work/strip.yaml" -o "$work/short" 2>"$work/err"
is "a folder by a link: $(cat "$work/err")" $? 0
holds "the run is where the link leads" test -s "$work/disk/summary.json" -a -L "$work/short"
"$cleave" run -q "$work/strip.yaml" -o "$work/short/" --overwrite -s duration=0.9us 2>"$work/err"
is "replaced by a link: $(cat "$work/err")" $? 0
declined "a second run by the folder's name" "strip.yaml:4:1: duration: .* contains the run of another scene" run -q "$work/strip.yaml" -o "$work/disk"
rm -rf "$work/disk"
cp -r "$work/papers" "$work/disk"
declined "files of others behind a link" "contains files" run -q "$work/strip.yaml" -o "$work/short" --overwrite
kept "files of others behind a link" "$work/disk"
rm -rf "$work/disk"
declined "a link to nothing" "is a symbolic link, but not to a folder" run -q "$work/strip.yaml" -o "$work/short"
rm "$work/short"

# Others' files by the names of frames and of particles files are refused, not removed, also in frames of a region.
"$cleave" run -q "$work/strip.yaml" -o "$work/mixed" 2>"$work/err"
is "a run" $? 0
for name in particles_000003.h5 000009.hdf; do
    echo "measured by others, in a file longer than a footer" >"$work/mixed/frames/$name"
    declined "$name of others" "frames/$name was not written by cleave" run -q "$work/strip.yaml" -o "$work/mixed" --overwrite
    is "$name of others" "$(cat "$work/mixed/frames/$name")" "measured by others, in a file longer than a footer"
    holds "$name of others: the older run stays" test -s "$work/mixed/summary.json" -a -s "$work/mixed/frames/000001.hdf"
    rm "$work/mixed/frames/$name"
done
echo cut >"$work/mixed/frames/000001.hdf"
"$cleave" run -q "$work/strip.yaml" -o "$work/mixed" --overwrite 2>"$work/err"
is "without them, with a frame that is cut short: $(cat "$work/err")" $? 0

# An export: once, again only with --overwrite, never over the scene that it reads.
"$cleave" export lammps "$work/strip.yaml" -o "$work/there" --allow-different >"$work/out" 2>&1
is "an export: $(cat "$work/out")" $? 0
holds "what it leaves out is said" grep -q "^left out: 1 probe; plate.dump has" "$work/out"
declined "a style by another name" "--style: give peri (pair_style peri) or bpm (bond_style bpm/peri)" \
    export lammps "$work/strip.yaml" -o "$work/bonds" --style bpm-peri
"$cleave" export lammps "$work/strip.yaml" -o "$work/bonds" --allow-different --style bpm >"$work/out" 2>&1
is "an export with bonds: $(cat "$work/out")" $? 0
holds "an untested style is said" grep -q "^bond_style bpm/peri has not been tested with a LAMMPS of that style" "$work/out"
declined "an export that is there" "contains an export; .*--overwrite" export lammps "$work/strip.yaml" -o "$work/there" --allow-different
"$cleave" export lammps "$work/strip.yaml" -o "$work/there" --allow-different --overwrite -s duration=2us >"$work/out" 2>&1
is "an export that is replaced" $? 0
cksum "$work/there"/* >"$work/sums"
declined "an export over its own scene" "scene.yaml is an input of this command" \
    export lammps "$work/there/scene.yaml" -o "$work/there" --allow-different --overwrite -s duration=3us
holds "it stays" sh -c "cksum '$work/there'/* | cmp - '$work/sums'"

# A failing export leaves the older one whole, and the next one accepts its folder.
limited() { (ulimit -f "$1"; shift; trap '' XFSZ; exec "$cleave" "$@") >"$work/out" 2>"$work/err"; }
limited 1 export lammps "$work/strip.yaml" -o "$work/there" --allow-different --overwrite -s particles.spacing=0.5mm
is "an export without room: $(cat "$work/err")" $? 1
holds "the older export stays" sh -c "cksum '$work/there'/* | cmp - '$work/sums'"
"$cleave" export lammps "$work/strip.yaml" -o "$work/there" --allow-different --overwrite >"$work/out" 2>&1
is "the next export: $(cat "$work/out")" $? 0
declined "a name that is too long" "too long" export lammps "$work/strip.yaml" --allow-different -o "$(head -c 4200 /dev/zero | tr '\0' v)"

# A run never overwrites its own scene, its list of particles or its table of loads.
"$cleave" run -q "$work/strip.yaml" -o "$work/own" 2>"$work/err"
declined "a run over its own scene" "scene.yaml is an input of this command" run -q "$work/own/scene.yaml" -o "$work/own" -s duration=2us --overwrite
"$cleave" run -q "$work/own/scene.yaml" -o "$work/own" --overwrite 2>"$work/err"
is "the same scene once more" $? 0
sed "s#face: y+#face: y+, time: {file: own/history.csv, column: step}#" "$work/strip.yaml" >"$work/driven.yaml"
cp "$work/own/history.csv" "$work/before.csv"
declined "a run over its own table" "history.csv is an input of this command" run -q "$work/driven.yaml" -o "$work/own" --overwrite
holds "the table stays" cmp "$work/before.csv" "$work/own/history.csv"

# A refusal precedes the removal of the older run.
sed 's#^output: .*#output: {frames: 1, samples: 4, regions: [{name: side, region: {box: {from: [0, 0], to: [5 mm, 5 mm]}}, every: 0.5 us}]}#' \
    "$work/strip.yaml" >"$work/side.yaml"
"$cleave" run -q "$work/side.yaml" -o "$work/sided" 2>"$work/err"
is "frames of a region: $(cat "$work/err")" $? 0
cp -r "$work/sided/frames_side" "$work/sided/frames_kept"
"$cleave" run -q "$work/side.yaml" -o "$work/sided" --overwrite -s duration=0.9us 2>"$work/err"
holds "a copy of frames stays" test -s "$work/sided/frames_kept/000000.hdf"
rm -rf "$work/sided/frames_kept" "$work/sided/frames_side" "$work/far"
mkdir "$work/far"
ln -s "$work/far" "$work/sided/frames_side"
declined "frames that are a link" "frames_side is a symbolic link" run -q "$work/side.yaml" -o "$work/sided" --overwrite
holds "the older run stays" test -s "$work/sided/summary.json" -a -s "$work/sided/checkpoint.h5"

# Links: folders in a study, a history with a second name.
"$cleave" sweep "$work/strip.yaml" -s material.density=2440,2500 -o "$work/study" -q >"$work/out" 2>&1
is "a study" $? 0
for name in pictures logs; do
    rm -rf "$work/study/$name" "$work/far"
    mkdir "$work/far"
    ln -s "$work/far" "$work/study/$name"
    declined "$name of a study that are a link" "$name is a symbolic link" sweep "$work/strip.yaml" -s material.density=2440,2600 -o "$work/study" -q
    is "$name: nothing is written there" "$(ls "$work/far")" ""
    rm "$work/study/$name"
done
run_of_study=$(dirname "$(ls "$work/study"/*/summary.json | head -n 1)")
rm -rf "$run_of_study" "$work/far"
mkdir "$work/far"
ln -s "$work/far" "$run_of_study"
"$cleave" sweep "$work/strip.yaml" -s material.density=2440,2500 -o "$work/study" -q >"$work/out" 2>&1
holds "a run of a study that is a symbolic link: $(cat "$work/out")" grep -q "is a symbolic link" "$work/out"
is "a run of a study: nothing is written there" "$(ls "$work/far")" ""
interrupted "$work/twin" 20 $small
ln "$work/twin/history.csv" "$work/backup.csv"
cp "$work/backup.csv" "$work/backup_then.csv"
calm "$work/twin" $small --resume
holds "a second name of a history" cmp "$work/backup.csv" "$work/backup_then.csv"
same "a history with a second name" "$work/once" "$work/twin"
mkdir -p "$work/results/bench"
echo mine >"$work/results/bench/threads.csv"
(cd "$work" && timeout 20 "$cleave" bench threads --quick >out 2>err)
is "a table of others beside those of benches: exit status" $? 2
is "and it stays" "$(cat "$work/results/bench/threads.csv")" mine
rm -r "$work/results"
rm -rf "$work/far"
mkdir "$work/far"
for link in results results/bench; do
    mkdir -p "$(dirname "$work/$link")"
    ln -s "$work/far" "$work/$link"
    (cd "$work" && timeout 20 "$cleave" bench threads --quick >out 2>err)
    is "$link that is a symbolic link: exit status" $? 2
    holds "$link that is a symbolic link: $(cat "$work/err")" grep -q "^$link is a symbolic link" "$work/err"
    is "$link: nothing is written there" "$(ls "$work/far")" ""
    rm -r "$work/results"
done

# Files of others in folders of Cleave, under names that Cleave uses.
# others_stay WHAT FILE TEXT COMMAND...: checks that the command is refused before anything runs, and that FILE is unchanged.
others_stay()
{
    what=$1 file=$2 text=$3; shift 3
    mkdir -p "$(dirname "$file")"
    mv "$file" "$work/aside" 2>/dev/null
    echo mine >"$file"
    declined "$what" "$text" "$@"
    is "$what: it stays" "$(cat "$file")" mine
    rm "$file"
    if [ -e "$work/aside" ]; then mv "$work/aside" "$file"; fi
}
foreign="exists and was not \(written\|drawn\) by cleave; move or remove it"
others_stay "a picture" "$work/once/pictures/damage.png" "damage.png $foreign" plot "$work/once"
others_stay "a picture of a field" "$work/once/pictures/field_speed.png" "field_speed.png $foreign" plot "$work/once" --field speed
others_stay "a history" "$work/own/history.csv" "history.csv $foreign" run -q "$work/strip.yaml" -s duration=2us -o "$work/own" --overwrite
others_stay "a profile" "$work/lined/axis_000000.csv" "axis_000000.csv $foreign" run -q "$work/lined.yaml" -o "$work/lined" --overwrite
mkdir -p "$work/own/pictures"
echo mine >"$work/own/pictures/damage.png"
"$cleave" run -q "$work/strip.yaml" -s duration=2us -o "$work/own" --overwrite 2>"$work/err"
is "a picture beside a run that is replaced" "$(cat "$work/own/pictures/damage.png")" mine
rm -rf "$work/study"
"$cleave" sweep "$work/strip.yaml" -s material.density=2440,2500 -o "$work/study" -q >"$work/out" 2>&1
sweep="sweep $work/strip.yaml -s material.density=2440,2500,2600 -o $work/study -q"
others_stay "a table of a study" "$work/study/sweep.csv" "sweep.csv $foreign" $sweep
others_stay "a picture of a study" "$work/study/pictures/material.density.png" "density.png $foreign" $sweep
others_stay "a log" "$work/study/logs/density=2600.txt" "density=2600.txt $foreign" $sweep
converge="converge $work/strip.yaml -o $work/study -q --overwrite"
others_stay "a table of convergence" "$work/study/converge.csv" "converge.csv $foreign" $converge
others_stay "a picture of convergence" "$work/study/pictures/path.png" "path.png $foreign" $converge
is "no more has run" "$(ls -d "$work/study"/*=* | wc -l | tr -d ' ')" 2
$cleave $sweep >"$work/out" 2>&1
is "the study goes on: $(cat "$work/out")" $? 0

# ---- input must be files -------------------------------------------------------------------------------------------

mkfifo "$work/pipe.yaml" "$work/pipe.csv" "$work/pipe.stl"
for place in "$work/pipe.yaml" "$work" /dev/zero; do declined "a scene: $place" "is not a regular file\|is a folder" check "$place"; done
"$cleave" check --no-trial /dev/stdin <"$work/strip.yaml" >"$work/out" 2>&1
is "a scene on standard input: $(head -n 1 "$work/out")" $? 0
cat "$work/strip.yaml" | "$cleave" check --no-trial /dev/stdin >"$work/out" 2>&1
is "a scene from a pipe that is open: $(head -n 1 "$work/out")" $? 0
head_of() { sed '/^body\|^boundary/d' "$work/strip.yaml"; }
sed 's/^space:/include: pipe.yaml\nspace:/' "$work/strip.yaml" >"$work/a.yaml"
(head_of; echo 'bodies: [{particles: pipe.csv}]') >"$work/b.yaml"
(head_of; echo 'body: {box: {from: [0, 0], to: [10 mm, 5 mm]}}
boundary: [{traction: [0, 1 MPa], face: y+, time: {file: pipe.csv}}]') >"$work/c.yaml"
(head_of; echo 'body: {stl: {file: pipe.stl, unit: mm}}') >"$work/d.yaml"
(head_of; echo 'body: {image: {file: pipe.stl, pixel: 1 mm, above: 100}}') >"$work/e.yaml"
for scene in a b c d e; do declined "a pipe in scene $scene" "$scene.yaml\|pipe" check "$work/$scene.yaml"; done
declined "a pipe for a run to plot" "is a file" plot "$work/pipe.yaml"
declined "a pipe for a run to compare" "contains no run" compare "$work/pipe.yaml" "$work/once"

# ---- no escape sequences in output ---------------------------------------------------------------------------------

escape=$(printf '\033')
red=$(printf '\033[31mred\302\233')
# silent WHAT COMMAND...: checks that the output of a command contains the word `red`, from a name, but no escape sequence of terminals.
silent()
{
    what=$1; shift
    timeout 20 "$cleave" "$@" >"$work/out" 2>"$work/err"
    holds "$what: is said: $(cat "$work/err")" grep -q "red" "$work/out" "$work/err"
    is "$what: escape sequences" "$(cat "$work/out" "$work/err" | grep -c "$escape\|$(printf '\302\233')")" 0
}
awk -v red="$red" 'BEGIN { print "x,y,volume," red; for (k = 0; k < 400; k++) print (k % 20 + 0.5) * 1e-3 "," (int(k / 20) + 0.5) * 1e-3 ",1e-9,7" }' >"$work/red.csv"
(head_of; echo 'bodies: [{particles: red.csv}]') >"$work/red.yaml"
silent "a column" check "$work/red.yaml"
sed "s/name: pull/name: \"\\\\e[31mred\"/" "$work/strip.yaml" >"$work/named.yaml"
silent "a name" check "$work/named.yaml"
silent "a figure" converge "$work/strip.yaml" --of "$red" -o "$work/none"
silent "a field" plot "$work/once" --field "$red"
silent "a folder" compare "$work/once" "$work/$red"
silent "a command" "$red"
# The list of a sweep is for a shell, which must receive the same bytes.
odd=$(printf '%s/it\047s\033[31mred\342\200\256' "$work")
silent "a list" sweep "$work/strip.yaml" -s method=pd,mpm -o "$odd" --list
folder_listed() { while [ $# -gt 1 ] && [ "$1" != -o ]; do shift; done; echo "$2"; }
is "a folder of a list" "$(eval "folder_listed $(head -n 1 "$work/out")")" "$odd/method=pd"

finish
