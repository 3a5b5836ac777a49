#!/bin/sh
# Pages of `cleave report`: complete, of the stated precision, without active content whatever the name of a scene is, and never written
# over other files.
# Takes 40 s: runs, pages with pictures, and a convergence study.
test_name=test_report
. tests/support/summary.sh
command -v python3 >/dev/null || { echo "python3 is missing: pages not tested"; exit 77; }
for python in python3 /usr/bin/python3 none; do which=$($python -c 'import h5py, sys; print(sys.executable)' 2>/dev/null) && break; done
python=${which:-python3}
cd "$work" || exit 1

# whole PAGE [FOLDER]: checks that the page is complete and agrees with the files of the run in FOLDER (report_page.py).
whole() { $python "$root/tests/scenes/report_page.py" "$@" >said && pass || fail "$1: $(cat said)"; }
# refused WORD ARGUMENTS: checks that `cleave report ARGUMENTS` ends with status 2 and one line that contains WORD.
refused()
{
    word=$1
    shift
    "$cleave" report "$@" >out 2>err
    is "report $*: exit status" $? 2
    is "report $*: lines" "$(wc -l <err)" 1
    holds "report $*: says $word" grep -q -e "$word" err
}
smaller() { between "$1: bytes" "$(wc -c <"$1")" 20000 "$2"; }

cat >plate.yaml <<'END'
name: plate
space: plane stress
thickness: 2 mm
duration: 6 us
method: pd
material: {name: glass, young: 72 GPa, poisson: 1/3, density: 2440 kg/m^3, energy_release_rate: 3 J/m^2}
body: [box: {from: [0, 0], to: [40 mm, 20 mm]}]
particles: {spacing: 1 mm}
cracks: [{from: [-1 mm, 10 mm], to: [15 mm, 10 mm]}]
boundary: [{traction: [0, 20 MPa], face: y+}, {traction: [0, -20 MPa], face: y-}]
output: {frames: 5}
END

# ---- a run --------------------------------------------------------------------------------------------------------------

"$cleave" run plate.yaml -q --report -t 2 >out 2>err
is "run --report: exit status" $? 0
whole results/plate/report.html results/plate
smaller results/plate/report.html 2e6
holds "nothing is left beside the page" test -z "$(find . -name '*.cleave.tmp*')"
"$cleave" report results/plate -o here/ >out 2>err
is "report -o FOLDER/: exit status" $? 0
holds "says the page" grep -q '^here/report.html: .* MB' out
if command -v gnuplot >/dev/null; then holds "has the scene's picture" grep -q '"picture": {' here/report.html; fi

# A browser, where one is there (more in long_report.sh): no error on its console, the slider moves, the crack shows damage, and not its stress.
. "$root/tests/support/browser.sh"
if [ -n "$browser" ]; then
    mkdir profile
    cp -r results/plate opened
    seen opened
    says opened "s['problems'] == [] and s['frames'] == 6 and s['shown_at_first'] == 5 and s['played_to'] == 5"
    says opened "s['limits'] == [0, 0.7]"       # of damage, as in cleave plot
    says opened "'frame 0' in s['when_first'] and s['column_added']"
    says opened "s['crack_last'][0] - s['crack_last'][1] > 60 and s['whole_last'] == [226, 228, 231]"
    # What matters comes first: energies, the largest one before others, then the crack; what is not an energy is last in the list.
    says opened "[c[1] for c in s['curves_first'][:-1]] == ['J'] * (len(s['curves_first']) - 1) and len(s['curves_first']) > 3"
    says opened "s['curves_first'][-1][0] == 'crack_length' and s['curves_first'][0][0] != 'kinetic'"
    says opened "(lambda size: size == sorted(size, reverse=True))([c[2] for c in s['curves_first'][:-1]])"
    says opened "s['chips'][0] == s['curves_first'][0][0].replace('_', ' ') and s['chips'].index('crack growth') < s['chips'].index('momentum x')"
    says opened "s['over'] == 'time' and s['lengths'] == ['4.17 m', '417 mm', '20 km', 'J/m²', '167 PJ', '900 aJ']"
    says opened "s['room'] > 76 and s['powers'] == '1.5·10⁸'"
    says opened "s['field'] == 'von_mises' and max(s['crack_von_mises']) < 100 and s['whole_von_mises'] != [226, 228, 231]"
    # The energy of a heavy hammer does not flatten the others.
    says opened "s['heavy'][0] == 'kinetic - 1 kJ' and abs(s['heavy'][1] - 1) < 0.01"
    # A magnified body stays on the canvas, and the faces of its pre-crack move with it.
    says opened "s['magnified']['share'] == 1 and abs(s['magnified']['apart'] - 1.909e-4) < 5e-6 and s['magnified']['red'] < 90"
    says opened "abs(s['faces_from']) < 1e-4"     # of the pre-crack, which begins 1 mm outside the body
    says opened "not s['dark_fragments'] and ', critical ' in s['origin']"
fi

# A folder whose name would end the script and begin another: no text of the page is markup.
named="a</script><b>&\"'"
mkdir 'a<'
cp -r results/plate "$named"
"$cleave" report "$named" -o named.html -q
is "a name like markup: exit status" $? 0
whole named.html results/plate
holds "the name is a text" grep -q '"folder": "a.u003c/script>.u003cb>&.*"' named.html
holds "in the title, too" grep -q '<title>script>&lt;b>&amp;"' named.html

# A script that a browser could not read would leave the page empty.
if command -v node >/dev/null; then
    sed -n '/^"use strict";$/,/^<\/script>$/p' here/report.html | sed '$d' >script.js
    holds "the script is sound" node --check script.js
fi

# Without gnuplot, without summary (a run that goes on, or was killed): pages all the same.
mkdir bare
for tool in sh env; do ln -s "$(command -v $tool)" bare; done
rm results/plate/summary.json
PATH=$work/bare "$cleave" report results/plate -o bare.html -q >out 2>err
is "without gnuplot: exit status" $? 0
is "-q: prints" "$(cat out err)" ""
whole bare.html results/plate
holds "says why it has no picture" grep -q '"picture_missing": ".*gnuplot' bare.html

# A run that goes on, and the same run after an interruption.
"$cleave" run plate.yaml -q -t 1 -o going -s duration=5ms -s output.frames= -s output.every=2us >out 2>err &
run=$!
waited=0
until grep -q 000003 going/frames.hdf.series 2>/dev/null || [ $waited -ge 600 ]; do sleep 0.1; waited=$((waited + 1)); done
"$cleave" report going -o going.html -q
is "a run that goes on: exit status" $? 0
whole going.html
kill -TERM $run
wait $run
is "the run is interrupted: exit status" $? 130
"$cleave" report going -q
is "an interrupted run: exit status" $? 0
whole going/report.html
holds "says that it was interrupted" grep -q '"status.": ."interrupted' going/report.html

# ---- files of others ----------------------------------------------------------------------------------------------------

echo "mine" >mine.html
refused "not a page of cleave" results/plate -o mine.html
is "the file of another" "$(cat mine.html)" mine
"$cleave" report results/plate -o mine.html --overwrite -q
is "--overwrite: exit status" $? 0
whole mine.html
"$cleave" report results/plate -o mine.html -q
is "a page replaces a page: exit status" $? 0
cp mine.html before.html
(ulimit -f 8; "$cleave" report results/plate -o mine.html -q) >out 2>err
is "a full disk: exit status" $? 1
holds "the page stays whole" cmp -s mine.html before.html
holds "nothing is left behind" test -z "$(find . -name '*.cleave.tmp*')"
mkdir empty
refused "neither a run" empty
refused "neither a run" nowhere
refused "is a file" plate.yaml
refused "no folder is given"
refused "is a second folder" empty empty
refused "unknown option" results/plate --format pdf
echo "kind: converge" >empty/study.yaml
refused "once a run is done" empty
rm empty/study.yaml
holds "no page in an empty folder" test -z "$(ls empty)"

# A run that is overwritten removes its page, and leaves a file of this name that is none.
"$cleave" run plate.yaml -q --overwrite >out 2>err
holds "the page of the older run is gone" test ! -e results/plate/report.html
echo mine >results/plate/report.html
"$cleave" run plate.yaml -q --overwrite >out 2>err
is "a file that is no page" "$(cat results/plate/report.html)" mine

# ---- bars, solids, studies ----------------------------------------------------------------------------------------------

"$cleave" run "$root/inputs/bar_pulse.yaml" -o bar -q >out 2>err
"$cleave" report bar -q
whole bar/report.html
cat >block.yaml <<'END'
name: block
space: solid
duration: 2 us
method: pd
material: {young: 72 GPa, poisson: 1/4, density: 2440 kg/m^3, energy_release_rate: 3 J/m^2}
body: [box: {from: [0, 0, 0], to: [8 mm, 6 mm, 4 mm]}]
particles: {spacing: 1 mm}
boundary: [{traction: [0, 20 MPa, 0], face: y+}, {traction: [0, -20 MPa, 0], face: y-}]
output: {frames: 3}
END
"$cleave" run block.yaml -q --report >out 2>err
is "a solid: exit status" $? 0
whole results/block/report.html results/block
# Rigid bodies: one that turns as it hits a corner, one without bounds.
sed -e 's/^name: .*/name: struck/' -e '/^boundary/d' -e 's/^duration: .*/duration: 30 us/' -e 's/^body: .*/bodies:/' -e '/^bodies:/a\
  - {name: block, shape: {box: {from: [0, 0, 0], to: [8 mm, 6 mm, 4 mm]}}}\
  - {name: bar, rigid: true, mass: 2 g, velocity: [0, -60 m/s, 0], shape: {box: {from: [6 mm, 6.2 mm, 0], to: [18 mm, 8 mm, 4 mm]}}}\
  - {name: floor, rigid: true, shape: {half-space: {point: [0, -0.2 mm, 0], normal: [0, 1, 0]}}}
' block.yaml >struck.yaml
"$cleave" run struck.yaml -q --report >out 2>err
is "rigid bodies: exit status" $? 0
whole results/struck/report.html results/struck
holds "rigid bodies are compared" grep -q '2 rigid bodies' said
holds "the bar turns" awk '/Name="motion"/ { getline; exit !($7 < 0.999) }' results/struck/frames/rigid_000003.vtp
# A metal that flows and cannot break shows no slits; load steps are drawn over their numbers.
cat >metal.yaml <<'END'
space: solid
duration: 30 us
method: mpm
material: {young: 117 GPa, poisson: 0.35, density: 8930, yield_stress: 400 MPa, yield_tangent: 100 MPa}
body: {cylinder: {from: [0, 0, 0], to: [0, 0, 16 mm], radius: 3.2 mm}}
particles: {spacing: 0.8 mm}
initial: [{velocity: [0, 0, -227 m/s]}]
boundary: [{mirror: {axis: z, at: 0}}]
output: {frames: 1}
END
sed -e 's/^name: .*/name: steps/' -e '/^boundary/d' -e 's/^duration: .*/duration: 1 s/' -e 's/rate: 3 J/rate: 3e9 J/' plate.yaml >steps.yaml
cat >>steps.yaml <<'END'
solver: static
steps: {number: 2}
boundary: [{fixed: all, face: y-}, {displacement: [free, 1 um], face: y+, time: {ramp: {until: 1 s}}}]
END
# Particles that a pre-crack has parted and that have not moved apart show no lattice of dots.
sed -e 's/^name: .*/name: notched/' -e '/^boundary/d' block.yaml >notched.yaml
echo 'cracks: [{polygon: [[4 mm, -1 mm, -1 mm], [4 mm, 3 mm, -1 mm], [4 mm, 3 mm, 5 mm], [4 mm, -1 mm, 5 mm]]}]' >>notched.yaml
sed -e 's/^name: .*/name: table/' -e '/^boundary/d' -e 's/^body: .*/bodies:/' -e '/^bodies:/a\
  - {name: block, velocity: [9 m/s, 3 m/s, -30 m/s], shape: {box: {from: [0, 0, 0], to: [8 mm, 6 mm, 4 mm]}}}\
  - {name: table, rigid: true, shape: {box: {from: [-7 mm, -7 mm, -2 mm], to: [15 mm, 13 mm, -0.1 mm]}}}
' block.yaml >table.yaml
# Particles on rings, on no lattice, show no holes.
awk 'BEGIN { print "x [mm],y [mm],volume [mm^3]"; for (r = 5.5; r < 12; r++) for (k = 0; k < (n = int(6.2832 * r + 0.5)); k++)
    printf "%.6f,%.6f,%.6f\n", r * cos(6.283185307 * k / n), r * sin(6.283185307 * k / n), 12.56637 * r / n }' >ring.csv
sed -e '/^cracks/d' -e '/^boundary/d' -e 's/^name: .*/name: ring/' -e 's/^duration: .*/duration: 1 us/' plate.yaml >ring.yaml
sed -i -e 's/^body: .*/bodies: [{name: ring, particles: ring.csv}]/' -e 's/frames: 5/frames: 1/' ring.yaml
if [ -n "$browser" ]; then
    sed -e 's/^name: .*/name: slanted/' -e 's/rate: 3 J/rate: 3000 J/' -e 's/from: .-1 mm, 10 mm., to: .15 mm, 10 mm./from: [6.1 mm, 7 mm], to: [17 mm, 13.3 mm]/' plate.yaml >slanted.yaml
    for name in metal steps notched ring table slanted; do
        "$cleave" run $name.yaml -o $name -q --report >out 2>err
        seen $name
    done
    says metal "s['problems'] == [] and s['slits'] < 50 and s['first_field'] == 'plastic_strain'"
    says ring "s['problems'] == [] and s['slits'] < 60"
    says notched "s['problems'] == [] and s['bare'] == 0 and s['turned'] and not s['cut_off']"
    # Cells of different size meet, and a table far wider than the body is on the stage as it is turned.
    says notched "s['resized'][0] < 0.06 and s['resized'][1] == 20"
    says table "s['problems'] == [] and s['turned'] and s['rigid_outside'] == 0"
    # No squares of particles are between the faces of an open crack, which here is oblique to the lattice.
    says slanted "s['problems'] == [] and s['faces_shut'][0] == 0 and s['faces_shut'][1] > 40 and s['slits'] < 60"
    says steps "s['problems'] == [] and s['over'] == 'load step' and s['when_first'] == 'frame 0, load step 0' and s['first_field'] == 'von_mises'"
    says steps "', critical ' not in s['origin']"
    # A crack of a bar has no length, and columns without values are not named.
    cat >spalled.yaml <<'END'
space: line
section: 1 cm^2
duration: 80 us
method: pd
material: {young: 210 GPa, density: 7800, tensile_strength: 300 MPa, energy_release_rate: 5000 J/m^2}
bodies:
  - {name: a, velocity: [20 m/s], shape: {box: {from: 0, to: 50 mm}}}
  - {name: b, shape: {box: {from: 50.5 mm, to: 150 mm}}}
particles: {spacing: 1 mm}
END
    "$cleave" run spalled.yaml -q --report -o spalled >out 2>err
    holds "a crack that grows: $(cat err)" grep -q '"length_end": 0.001' spalled/summary.json
    seen spalled
    says spalled "s['problems'] == [] and 'first bond breaks' in s['cards'] and 'crack' not in s['cards'] and 'tip' not in s['cards']"
    says spalled "'crack growth' not in s['chips'] and 'tip y' not in s['constant'] and 'momentum y = 0' in s['constant']"
    # A body at rest: its colours say so, and there is no empty panel.
    "$cleave" run plate.yaml -o rest -q --report -s boundary= -s cracks= >out 2>err
    seen rest
    says rest "s['problems'] == [] and s['limits'][1] < 1e-20 and s['curves_first'] == []"
fi
"$cleave" sweep plate.yaml -s particles.spacing=2mm,1mm -s thickness=1mm,2mm -o sweep -q >out 2>err
"$cleave" report sweep -q
is "a sweep: exit status" $? 0
whole sweep/report.html
# Values over decades have a logarithmic axis, also where the last one has no result; the key is below the curves, one entry for each thickness.
"$cleave" sweep plate.yaml -s material.density=2,40,2e3 -s thickness=1mm,2mm -s particles.spacing=2mm -o decades -q >out 2>err
if [ -n "$browser" ]; then
    "$cleave" report decades -q
    seen decades
    says decades "s['problems'] == [] and s['series'] == 2 and s['axes']['x'] and s['gap'] and s['tics'] == ['70000000000', '70000001000', '70000002000']"
fi
holds "a sweep's table" grep -q '"table": "run,state,particles.spacing,thickness,' sweep/report.html
if command -v gnuplot >/dev/null; then
    holds "a sweep's pictures" grep -q '"name": "map.png"' sweep/report.html
    # Of PDF a page says that it does not show it; SVG it shows.
    for format in svg pdf; do
        "$cleave" sweep plate.yaml -s particles.spacing=2mm,1mm -s thickness=1mm,2mm -o sweep -q --collect --format $format >out 2>err
    done
    rm sweep/pictures/*.png
    "$cleave" report sweep -q
    whole sweep/report.html
    holds "a picture in SVG" grep -q '"name": "map.svg"' sweep/report.html
    holds "names pictures in PDF" sh -c "tr -d ' \n' <sweep/report.html | grep -q '\"pictures_left_out\":\[\"map.pdf\",'"
fi
"$cleave" converge plate.yaml -s particles.spacing=2mm --runs 1 --levels 3 -o results/plate_converge -q >out 2>err
"$cleave" report results/plate_converge -o study.html -q
is "a convergence study: exit status" $? 0
whole study.html
holds "the study's table" grep -q '"table": "figure,unit,value,uncertainty,' study.html

# repeated PAGE FOLDER KIND: repeats the study (KIND: sweep or converge) by the options and the scene stored in its page, in another
# folder. All runs must have equal histories, and their number must be equal.
repeated()
{
    rm -rf again && mkdir again
    $python - "$1" again/saved.yaml >again/options <<'END'
import json, re, sys
page = json.loads(re.search(r'<script type="application/json" id="page">(.*?)</script>', open(sys.argv[1]).read(), re.S).group(1))
open(sys.argv[2], "w").write(page["scene"])
print(page["options"])
END
    (cd again && eval "\"$cleave\" $3 saved.yaml $(cat options) -o study -q") >out 2>err
    is "$2: the command of its page: $(cat again/options err)" $? 0
    for run in $(cd "$2" && ls -d */ | grep -v -e pictures -e logs); do
        holds "$2: $run is repeated" cmp -s "$2/$run/history.csv" "again/study/$run/history.csv"
    done
    is "$2: as many runs" "$(ls -d again/study/*/ | wc -l)" "$(ls -d "$2"/*/ | wc -l)"
}
"$cleave" sweep plate.yaml -s thickness=1mm,2mm -s "particles.spacing=1mm:2mm:1mm" -s duration=2us -s 'boundary=[{traction: [0, 20 MPa], face: y+},
    {traction: [0, "-20 MPa*sin(t/us)"], face: y-}]' --of energy.kinetic --of crack.length_end -j 1 -t 2 -o asked -q >out 2>err
"$cleave" report asked -q
whole asked/report.html
repeated asked/report.html asked sweep
holds "its options have the figures of the picture" grep -q '"options": ".*--of energy.kinetic --of crack.length_end' asked/report.html
holds "and nothing else is to be added" sh -c "! grep -q 'add the options' asked/report.html"
is "the columns of its table" "$(head -1 again/study/sweep.csv)" "$(head -1 asked/sweep.csv)"
if command -v gnuplot >/dev/null; then
    holds "pictures of the same figures" cmp -s again/study/pictures/map.png asked/pictures/map.png
fi
"$cleave" converge plate.yaml -s particles.spacing=2mm -s duration=3us --runs 2 --levels 3 --horizon --budget "1 h" --of energy.kinetic -o narrowed -q \
    >out 2>err
is "a study with options: $(cat err)" $? 0
"$cleave" report narrowed -q
repeated narrowed/report.html narrowed converge
is "its figures" "$(cut -d, -f1-4 again/study/converge.csv)" "$(cut -d, -f1-4 narrowed/converge.csv)"
holds "the page prints the options" grep -q '"options": "-s particles.spacing=2mm -s duration=3us --runs 2 --levels 3 --horizon --budget .1 h. --of' narrowed/report.html

# With the study beside it, a run of its scene has error bars, and so has its page.
"$cleave" run plate.yaml -s particles.spacing=2mm -o results/bars -q --report >out 2>err
whole results/bars/report.html results/bars
holds "error bars" grep -q 'uncertainty.": {.u000a *."[a-z_.]*.": [0-9]' results/bars/report.html
is "the processor in the summary" "$(figure results/bars processor)" "$("$cleave" info | sed -n 's/^processor *//p')"

finish
