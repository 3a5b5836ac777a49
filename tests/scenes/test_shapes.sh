#!/bin/sh
# Bodies from files: the three scenes of inputs/files.md, with their volumes, materials and scenes as written out; changed files.
test_name=test_shapes
. tests/support/summary.sh

cp inputs/blade.stl inputs/gear.inp inputs/fibres.png "$work"
# The scenes of the section, by the names in their first lines.
awk -v work="$work" '/^```yaml/ { getline; if ($2 ~ /^(blade|gear|fibres)\.yaml:$/) { name = $2; sub(":", "", name); file = work "/" name } }
    /^```$/ { file = "" } file { print > file }' inputs/files.md
cd "$work" || exit 1

# said NAME PATTERN ARGUMENTS: checks that the output of check for the scene NAME contains the pattern.
said()
{
    name=$1 pattern=$2; shift 2
    said=$("$cleave" check "$name" "$@" 2>&1)
    case $said in *$pattern*) pass ;; *) fail "$name: no '$pattern' in: $said" ;; esac
}
# refused: as said, for a scene that is refused in one line with exit status 2.
refused()
{
    wanted=$1; shift
    said=$("$cleave" "$@" 2>&1); code=$?
    [ $code -eq 2 ] && [ "$(echo "$said" | wc -l)" -eq 1 ] || fail "$*: exit $code: $said"
    case $said in *"$wanted"*) pass ;; *) fail "$*: '$said' has no '$wanted'" ;; esac
}

# The gear: 2 rings of 48 chords and 12 teeth enclose 7.9018e-4 m^2; cracks start, and the echo gives equal results from another folder.
said gear.yaml "144 edges, 2 shells, closed, encloses 0.0007902 m^2; sets wheel, teeth, bore" -s duration=1us
"$cleave" run gear.yaml -q -s duration=15us -s output.frames=1 >/dev/null 2>&1 || fail "gear.yaml does not run"
[ -n "$(sed -n 's/.*"start_time": *\([0-9.e-]*\).*/\1/p' results/gear/summary.json)" ] && pass || fail "the gear does not crack"
mkdir -p elsewhere
(cd elsewhere && "$cleave" run ../results/gear/scene.yaml -q -o again >/dev/null 2>&1) || fail "the echo of gear.yaml does not run"
cmp -s results/gear/history.csv elsewhere/again/history.csv && pass || fail "the echo of gear.yaml is another run"
sed -i 's/^1, 6.0000/1, 6.1000/' gear.inp
refused "the file has changed" check results/gear/scene.yaml
refused "" run gear.yaml -q -s duration=15us -s output.frames=1 --resume
refused "the file has no set tooth; give one of its sets (" check gear.yaml -s regions.teeth.mesh.set=tooth
refused "spacing: 1 MPa is a stress; give a length" check gear.yaml -s particles.spacing='1 MPa'
refused "unit is missing" check gear.yaml -s body='{mesh: {file: gear.inp}}'
refused "is not a unit of length" check gear.yaml -s body='{mesh: {file: gear.inp, unit: inch}}'

# Fibres: as many particles as the image has pixels that are not void; another grey value is refused.
"$cleave" run fibres.yaml -q -s duration=1ns -s output.frames=1 >/dev/null 2>&1 || fail "fibres.yaml does not run"
grep -q 'values: \["1-200", "201-255"\]' results/fibres/scene.yaml && pass || fail "the echo of fibres.yaml"
refused "have grey values without a material, for instance" check fibres.yaml -s body='{image: {file: fibres.png, pixel: 1 um, materials: {0: void, 255: fibre}}}'
refused "in two ranges" check fibres.yaml -s body='{image: {file: fibres.png, pixel: 1 um, materials: {0-128: matrix, 128-255: fibre}}}'
refused "the scene has no material glass" check fibres.yaml -s body='{image: {file: fibres.png, pixel: 1 um, materials: {0-128: matrix, 129-255: glass}}}'

# The blade: a closed surface; half of it is refused.
said blade.yaml "248 triangles, 1 shell, closed" -s particles.spacing=2mm -s duration=1us
head -c 6084 blade.stl >half.stl
refused "is cut off" check blade.yaml -s bodies='[{shape: {stl: {file: half.stl, unit: mm}}}]'
refused "cannot be used in space plane stress" check gear.yaml -s body='{stl: {file: blade.stl, unit: mm}}'

cd "$root" || exit 1
finish
