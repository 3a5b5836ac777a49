# For tests of pictures: sourced after summary.sh, makes $work the working folder. The commands that gnuplot receives for the last picture
# are kept in the file `drawn`. Writes strip.yaml, a plate with a pre-crack and a rigid body.
command -v gnuplot >/dev/null || { echo "gnuplot is missing: files not tested"; exit 77; }

gnuplot=$(command -v gnuplot)
mkdir "$work/bin"
# keep_commands FILE [-a]: from now on keeps the commands that gnuplot receives in FILE: those of the last picture or, with -a, of all
# pictures.
keep_commands() { printf '#!/bin/sh\nexec tee %s "%s/%s" | "%s" "$@"\n' "${2-}" "$work" "$1" "$gnuplot" >"$work/bin/gnuplot"; }
keep_commands drawn
chmod +x "$work/bin/gnuplot"
PATH=$work/bin:$PATH
small="--size 90mmx70mm"                  # a sixth of the usual pixels, where none is looked at
cd "$work" || exit 1

drawn() { holds "$1" grep -a -q -e "$2" drawn; }
made() { holds "$1 is made" test -s "$1"; }
# refused WORD ARGUMENTS: checks that `cleave plot ARGUMENTS` ends with exit status 2 and one line that contains WORD.
refused()
{
    word=$1
    shift
    "$cleave" plot "$@" >out 2>err
    is "plot $*: exit status" $? 2
    is "plot $*: lines" "$(wc -l <err)" 1
    holds "plot $*: says $word" grep -q -e "$word" err
}

cat >strip.yaml <<'END'
name: strip
space: plane stress
thickness: 1 mm
duration: 2 us
method: pd
materials:
  - {name: glass, young: 72 GPa, poisson: 1/3, density: 2440 kg/m^3, energy_release_rate: 10 J/m^2}
bodies:
  - {name: plate, shape: {box: {from: [0, 0], to: [20 mm, 10 mm]}}}
  - {name: anvil, rigid: true, shape: {box: {from: [5 mm, -3 mm], to: [8 mm, 0]}}}
particles: {spacing: 1 mm}
cracks: [{from: [0, 5 mm], to: [5 mm, 5 mm]}]
boundary:
  - {name: pull, traction: [0, 20 MPa], face: y+}
  - {name: grip, fixed: all, region: {box: {from: [18 mm, 0], to: [20 mm, 10 mm]}}}
probes: [{point: {name: gauge, at: [10 mm, 5 mm]}}]
output: {frames: 4}
END
