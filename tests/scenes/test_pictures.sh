#!/bin/sh
# Pictures of fields, sections, films and of scenes before they run, checked by the input of gnuplot, of which a stand-in keeps a copy.
# Takes 35 s: each picture is a process of gnuplot.
test_name=test_pictures
. tests/support/summary.sh
margins=$(cd "${BUILD:-build}" && pwd)/tests/scenes/test_margins         # built by `make test`
. tests/support/pictures.sh

# ---- a scene before it runs ---------------------------------------------------------------------------------------------

"$cleave" plot --scene strip.yaml >out 2>err
is "plot --scene: exit status" $? 0
made results/strip_scene.png
holds "no run has begun" test ! -e results/strip
drawn "particles of the material" "title 'glass: 200 particles'"
drawn "the rigid body" "title 'anvil: rigid'"
drawn "the load and how many bear it" "title 'pull: traction 20 MPa, y+ (20)'"
drawn "the support" "title 'grip: held x y (20)'"
drawn "the pre-crack" "title '1 pre-crack'"
drawn "the probe" "title 'probe gauge'"
is "what it counts" "$(cut -d : -f 2 out)" " 200 particles, 1 rigid body, 2 boundary conditions, 1 pre-crack, 1 probe"
"$cleave" plot --scene strip.yaml -o loads.png -s 'boundary=[
    {name: wave, traction: [0, "-20 MPa*pulse(t/us)"], face: y+}, {name: press, pressure: 3 MPa},
    {name: hub, rotation: {centre: [0, 0], rate: 1000 1/s}, time: {ramp: {until: 1 us}}}]' -s cracks=[] -s probes=[tip] >out 2>err
is "plot --scene of other loads: $(cat err)" $? 0
drawn "a formula of time at its largest" "title 'wave: traction up to 20 MPa, y+ (20)'"
drawn "a pressure" "title 'press: pressure 3 MPa ("
drawn "a probe without a place has the symbol of probes" "with points pt 1 [^,]* title 'probe tip: everywhere'"
drawn "a rotation" "title 'hub: turning up to [0-9.]* m/s (200)'"
"$cleave" plot --scene strip.yaml -s particles.spacing=2mm -o new/folder/coarse.svg --size 150mmx80mm >out 2>err
is "plot --scene -s: exit status" $? 0
made new/folder/coarse.svg
drawn "with the override" "title 'glass: 50 particles'"
sed -i 's/20 MPa/20 mm/' strip.yaml
refused "strip.yaml:1[0-9]:.*traction" --scene strip.yaml -o none.png
sed -i 's/20 mm\], face/20 MPa], face/' strip.yaml
holds "nothing is left of it" test ! -e none.png

# ---- fields -------------------------------------------------------------------------------------------------------------

"$cleave" run strip.yaml -q >out 2>err
is "run: exit status" $? 0
"$cleave" plot results/strip --field von_mises --times 1us,2us $small >out 2>err
is "plot --field: exit status" $? 0
made results/strip/pictures/field_von_mises.png
holds "two panels of all particles" grep -q "von_mises of 2 frames, 200 particles, colours from 0 to" out
drawn "its name and unit stand at the colours" "von Mises stress \[.*Pa\]"
"$cleave" plot results/strip --field velocity_y --times last -o v.pdf $small >out 2>err
is "plot -o v.pdf: exit status" $? 0
holds "v.pdf is a PDF" sh -c "head -c 5 v.pdf | grep -q %PDF-"
"$cleave" plot results/strip --field body >out 2>err
is "a field that is the same everywhere: exit status" $? 0
holds "it is not drawn" test ! -e results/strip/pictures/field_body.png
holds "a line says why" grep -q "field_body.png is not drawn: body is 0 everywhere" out
"$cleave" run strip.yaml -q -o both -s method=adaptive -s duration=0.1us -s output.frames=1 >out 2>err
"$cleave" plot both --field kind $small >out 2>err
holds "categories are named" grep -q "kind of 2 frames, 200 particles: material points, peridynamics" out
drawn "and have a key" "set label 'peridynamics' at screen"
if command -v ffmpeg >/dev/null; then
    "$cleave" plot results/strip --field speed -o speed.mp4 $small >out 2>err
    is "plot -o speed.mp4: exit status" $? 0
    holds "speed.mp4 is a film" sh -c "head -c 12 speed.mp4 | tail -c 8 | grep -q ftyp"
    holds "its pictures are gone" test "$(echo speed.mp4*)" = speed.mp4
    "$cleave" plot results/strip --field speed --frames 2 -o speed.gif $small >out 2>err
    holds "a film of as many frames as are asked for" grep -q "speed of 2 frames" out
fi
drawn "rigid bodies have their entry in the key" "set label 'rigid' at screen"
for frame in 0 1 2 3 4; do made results/strip/frames/rigid_00000$frame.vtp; done
is "their index lists every frame" "$(grep -c 'rigid_00000[0-4].vtp","time"' results/strip/rigid.vtp.series)" 5
if command -v xmllint >/dev/null; then holds "their file is XML" xmllint --noout results/strip/frames/rigid_000004.vtp; fi
# Options: ends of the colours, what is beyond them, magnified displacements, a rectangle, size, resolution, title.
"$cleave" plot results/strip --field stress_yy --times last --range -1MPa:3MPa --magnify 50 --crop 4mm:12mm,2mm:8mm \
    --size 90mmx70mm --dpi 288 --title "It's a strip" --colours magma -o options.png >out 2>err
is "plot with options: $(cat err)" $? 0
holds "the range is that of the option" grep -q "colours from -1e+06 to 3e+06 Pa, some values beyond" out
drawn "a size of a journal at twice the resolution" "pngcairo size 1020,792 .*fontscale 1.6 linewidth 2 pointscale 2"
holds "no entry of a rigid body that is not in the picture" sh -c "! grep -a -q \"set label 'rigid'\" drawn"
drawn "the rectangle" "set xrange \[4:12\]"
drawn "and its height" "set yrange \[2:8\]"
drawn "the ends of the colours" "set yrange \[-1:3\]"
drawn "numbers at the colours that differ also in a narrow range" "set y2tics out [0-9.]* format '%.9g'"
drawn "what is beyond them" "set label '[0-9.]* % above' at screen"
drawn "the title, and that displacements are not as they are" "'It''s a strip, displacements x 50'"
# Beside a low panel the bar is as long as its label, which has 16 letters of 8 pixels, and begins 84 pixels below the upper edge.
"$cleave" plot results/strip --field von_mises --times last --crop 0:20mm,4mm:5mm -o low.png >out 2>err
high=$(sed -n 's/.*pngcairo size 1000,\([0-9]*\) .*/\1/p' drawn)
at=$(sed -n "s/^set label 'von Mises stress' at screen [0-9.]*,\([0-9.]*\) .*/\1/p" drawn)
between "the label of a low colour bar begins below what is above the bar" "$(compute "(1 - $at) * $high - 64 - 84")" 0 40
"$cleave" plot results/strip --field speed --times last --size 90mmx70mm -o size.pdf >out 2>err
drawn "a PDF of 90 x 70 mm" "pdfcairo size 3.541[0-9]*in,2.75in"
"$cleave" plot results/strip --field speed --times last --magnify 3e4 --title '' $small -o untitled.png >out 2>err
drawn "no title: the magnification alone" "set label 1 'displacements x 30 000' at"
"$cleave" plot results/strip --field stress_yx --times last $small -o order.png >out 2>err
holds "a component by either order of its axes: $(cat err)" grep -q "stress_xy" out
# A letter that no font has would be drawn in any size.
if fc-list :charset=10900 2>/dev/null | grep -q .; then pass; else
    "$cleave" plot results/strip --field speed --times last --title 'x 𐤀' $small -o phoenician.png >out 2>err
    is "a letter without a font" $? 2
    holds "it is named" grep -q "no font of this machine has the letter 𐤀" err
    "$cleave" plot results/strip --field speed --times last --title 'x² – ω' $small -o greek.png >out 2>err
    is "Greek is drawn: $(cat err)" $? 0
fi
# A unit that one end has holds for both; damage has the colours and the ends that are asked for, categories have no scale.
: >drawn
"$cleave" plot results/strip --field damage --times last --range -0.1:0.6 --colours grey --crop 4:12mm,2mm:8 $small -o grey.pdf >out 2>err
holds "damage by the ends of the option: $(cat err)" grep -q "colours from -0.1 to 0.6" out
drawn "a rectangle with one unit for both ends" "set xrange \[4:12\]"
drawn "of the other end" "set yrange \[2:8\]"
"$cleave" plot results/strip --field stress_yy --times last --range -1:3MPa $small -o unit.png >out 2>err
holds "one unit for both ends" grep -q "colours from -1e+06 to 3e+06 Pa" out
refused "fragment has one colour for each value and no scale" results/strip --field fragment --colours magma
refused "range.* fragment has one colour for each value" results/strip --field fragment --range 0:2
refused "a picture has space for 192" results/strip --title "$(printf '%0200d' 0)"
"$cleave" plot results/strip --field speed --times last --title "a title of $(printf '%0150d' 0)" --size 60mm -o long.png >out 2>err
drawn "what has no space of a title" "0[.][.][.]' at screen"
refused "LOW:HIGH" results/strip --field speed --range 3
refused "--range 0:5m: 5m: " results/strip --field speed --range 0:5m
refused "--range a:b: b: " results/strip --field speed --range a:b
refused "give the lower end first" results/strip --field speed --range 5m/s:1m/s
refused "X:X,Y:Y" results/strip --crop 1mm:2mm
refused "lower end" results/strip --crop 2mm:1mm,0:1mm
refused "no particle is in this rectangle; give a part of -0.5mm:20.5mm,-3mm:10.5" results/strip --crop 100mm:120mm,0mm:5mm -o beside.png
holds "no empty picture" test ! -e beside.png
refused "above 0" results/strip --magnify -3
refused "or a size, such as 1200x800" results/strip --size 100
refused "a width in pixels or mm, such as 1200 or 85mm" results/strip --size 8.5cm
refused "between the option and its value: --range 0:5" results/strip --field speed --range=0:5
refused "from 53mmx40mm" results/strip --size 52mmx60mm
refused "from 53mmx40mm" results/strip --size 85mmx39mm
refused "viridis" results/strip --colours rainbow
refused "for films" results/strip --fps 10
refused "a width in pixels or mm" results/strip --size 52mm
refused "a width in pixels or mm" results/strip --size 85mmx300
refused "crop and --magnify" --scene strip.yaml --magnify 3
# Half a body: the face of a pre-crack in the plane of symmetry is drawn, and the crack that grows in it has no angle.
"$cleave" run strip.yaml -q -o half -s duration=16us -s output.frames=1 -s 'bodies=[{shape: {box: {from: [0, 0], to: [20 mm, 10 mm]}}}]' \
    -s 'cracks=[{from: [0, 0], to: [5 mm, 0]}]' -s 'boundary=[{traction: [0, 3 MPa], face: y+}, {mirror: {axis: y, at: 0}}]' >out 2>err
"$cleave" plot half --field damage --times last $small -o half.png >out 2>err
holds "the face of a pre-crack in a plane of symmetry: $(cat err)" env LC_ALL=C grep -a -q -P '(\x7a\x10\x20){3}' drawn
between "the crack grows" "$(figure half crack.length_end)" 1e-3 15e-3
is "in the plane" "$(figure half crack.angle_deg)" 0
# What happens in the run is drawn: damage where bonds break, else plastic strain or stress, also with a slit that does
# not grow.
"$cleave" plot results/strip -o default.png $small >out 2>err
holds "where bonds break: damage" grep -q "damage of 5 frames" out
"$cleave" run strip.yaml -q -o calm -s 'boundary=[{name: pull, traction: [0, 1 kPa], face: y+}]' >out 2>err
"$cleave" plot calm $small >out 2>err
made calm/pictures/field_von_mises.png
holds "a slit that does not grow: no map of damage" grep -q "damage.png is not drawn: no bond breaks" out
"$cleave" plot calm --field von_mises --times last -o one.png $small >out 2>err
holds "last.png has the colours of its frame: $(cat err)" cmp -s one.png calm/pictures/last.png
"$cleave" plot calm -o default.png $small >out 2>err
holds "where none breaks: the stress" grep -q "von_mises of 5 frames" out
"$cleave" run strip.yaml -q -o still -s solver=cg -s 'bodies=[{name: plate, shape: {box: {from: [0, 0], to: [20 mm, 10 mm]}}}]' -s 'boundary=[{name: pull, traction: [0, 1 kPa], face: y+}, {name: grip, fixed: all, face: y-}]' >out 2>err
"$cleave" plot still $small >out 2>err
holds "one equilibrium: no energies over time: $(cat err)" grep -q "energy.png is not drawn: a single equilibrium has no curves over time" out
"$cleave" run strip.yaml -q -o bent -s method=mpm -s 'cracks=[]' -s 'bodies=[{name: plate, shape: {box: {from: [0, 0], to: [20 mm, 10 mm]}}}]' \
    -s 'materials=[{name: lead, young: 16 GPa, poisson: 0.4, density: 11000 kg/m^3, yield_stress: 5 MPa}]' >out 2>err
"$cleave" plot bent --frames all $small >out 2>err
made bent/pictures/field_plastic_strain.png
made bent/pictures/last.png
made bent/pictures/field_plastic_strain_000002.png
holds "no empty map of damage" test ! -e bent/pictures/damage.png
PATH=/nowhere "$cleave" plot results/strip --field speed --format gif >out 2>err
is "a film without ffmpeg: exit status" $? 2
holds "a film without ffmpeg: one line names it" grep -q "the package ffmpeg" err

refused "von_mises" results/strip --field van_mises
refused "this field has several components; draw one of strain_xx, strain_yy" results/strip --field strain
refused "there are damage, kind, material" results/strip --field nonsense
"$cleave" plot results/strip --field principal_stress $small >out 2>err
holds "principal_stress: which one is drawn" grep -q "principal_stress is the largest of the three; draw the others by --field principal_stress_2" err
refused "a run with space: solid" results/strip --slice z=1mm
refused "did you mean --field" results/strip --feild speed
refused "give a time" results/strip --times 5kg
refused "the body would be a point in this rectangle" results/strip --crop 0:6,0:6
"$cleave" plot results/strip --field damage --range 0.1:0.2 --times 0,last $small -o beyond.png >out 2>err
holds "a list of times may end with last: $(cat err)" grep -q "damage of 2 frames.*some values beyond" out
drawn "the share of damage beyond the range" "% above' at screen"
refused "png, svg, pdf, mp4 or gif" results/strip --format bmp
refused "does not fit --format pdf" results/strip --field speed --format pdf -o x.png
refused "a file that ends in .png" results/strip --field speed -o x.bmp
refused "one of the two" results/strip --times 1us --frames 2
refused "at most 24 panels" results/strip --frames 30
refused "cleave plot --scene strip.yaml" strip.yaml
refused "before it runs" results/strip --scene strip.yaml
refused "needs a scene with space: solid" --scene strip.yaml --view x+
refused "use it with --scene" results/strip -s method=pd
"$cleave" plot results/strip --field strain_xx >out 2>err
is "a field that the run has not written: exit status" $? 1
holds "the remedy is named" grep -q "output: {fields: \[strain\]}" err

# ---- solids -------------------------------------------------------------------------------------------------------------

cat >block.yaml <<'END'
name: block
space: solid
duration: 1 us
method: pd
material: {young: 72 GPa, poisson: 1/4, density: 2440 kg/m^3, energy_release_rate: 10 J/m^2}
body: {box: {from: [0, 0, 0], to: [12 mm, 8 mm, 6 mm]}}
particles: {spacing: 1 mm}
cracks: [{polygon: [[6 mm, -1 mm, 2.9 mm], [13 mm, -1 mm, 2.9 mm], [13 mm, 9 mm, 2.9 mm], [6 mm, 9 mm, 2.9 mm]]}]
output: {frames: 1}
END
"$cleave" plot --scene block.yaml --view x+ -o block.png $small >out 2>err
is "plot --scene --view: exit status" $? 0
"$cleave" run block.yaml -q >out 2>err
is "run block: exit status" $? 0
"$cleave" plot results/block $small >out 2>err
is "plot block: exit status" $? 0
made results/block/pictures/surface.png
made results/block/pictures/cracks.png
drawn "the last picture has its axes" "set ylabel"
"$cleave" plot results/block --slice y=3mm $small >out 2>err
is "plot --slice: exit status" $? 0
holds "a slice has the particles of a layer" grep -q "of 2 frames, 72 particles" out
"$cleave" plot results/block --field speed --view x+ --times last >out 2>err
holds "what is the same everywhere is not drawn" grep -q "speed is 0 m/s everywhere" out
"$cleave" plot results/block --slice z=0.5mm --field damage --times last $small -o slice.png >out 2>err
drawn "a slice is in the unit of the axes" "set label 1 'block, pd: damage, z = 0.5 mm'"
refused "no particle is at this position; give one from 0.5 to 5.5 mm" results/block --slice z=9mm
refused "one of the two" results/block --slice z=3mm --view iso
# Without damage the section goes through the largest stress: of a block that is struck from above, the top layer.
"$cleave" run block.yaml -q -o struck -s duration=0.2us -s cracks=[] -s 'boundary=[{traction: [0, 0, -3 MPa], face: z+}]' >out 2>err
keep_commands sections -a
"$cleave" plot struck -o struck/ $small >out 2>err
holds "the section through the largest stress: $(cat err)" grep -a -q "set label 1 'block, pd: von Mises stress, z = 5.5 mm'" sections
keep_commands drawn
# Panels of a slender body stand side by side, with space for numbers below them.
"$cleave" run strip.yaml -q -o slender -s duration=0.5us -s output.frames=3 -s cracks=[] -s probes=[] \
    -s 'bodies=[{name: plate, shape: {box: {from: [0, 0], to: [2 mm, 60 mm]}}}]' -s 'boundary=[{traction: [0, 3 MPa], face: y+}]' >out 2>err
"$cleave" plot slender --field speed -o slender.png >out 2>err
is "a slender body: $(cat err)" $? 0
is "lower edges of panels and bar" "$(grep -a 'set bmargin' drawn | sort -u | wc -l)" 2
is "heights over widths of panels" "$(sed -n 's/^set [xy]range .\([-0-9.]*\):\([-0-9.]*\)\]/\1 \2/p' drawn | awk 'NR == 1 { w = $2 - $1 } NR == 2 { print ($2 - $1) / w }')" 8


# ---- files of others, a disk that is full, films that are stopped ----------------------------------------------------

echo mine >photo.png
refused "photo.png exists and was not drawn by cleave" results/strip --field speed -o photo.png
refused "photo.png exists" --scene strip.yaml -o photo.png
is "a picture of others" "$(cat photo.png)" mine
"$cleave" plot results/strip --field body -o photo.png --overwrite >out 2>err
is "nothing is drawn, and nothing removed" "$(cat photo.png)" mine
for format in png svg pdf; do
    echo mine >"photo.$format"
    "$cleave" plot results/strip --field speed --times last -o "photo.$format" --overwrite $small >out 2>err
    "$cleave" plot results/strip --field speed --times last -o "photo.$format" $small >out 2>err
    is "$format: a picture of cleave is replaced: $(cat err)" $? 0
done
"$cleave" plot --scene strip.yaml -o photo.svg $small >out 2>err
is "by any picture of cleave" $? 0
mkfifo pipe.png
refused "is not a regular file" results/strip --field speed -o pipe.png
"$cleave" plot results/strip --field speed --times last -o full.png >out 2>err
cp full.png before.png
# A limit on the file length acts as a full disk: gnuplot's picture is truncated.
(ulimit -f $(($(wc -c <full.png) / 1024)) && exec "$cleave" plot results/strip --field speed --times last -o full.png) >out 2>err
is "a picture that is cut short: exit status" $? 1
is "a picture that is cut short: lines" "$(wc -l <err)" 1
holds "a picture that is cut short: $(cat err)" grep -q "full.png" err
holds "the whole one stays" cmp full.png before.png
is "nothing half drawn" "$(echo full*)" full.png

# ---- pictures for journals --------------------------------------------------------------------------------------------

keep_commands all -a
# At the widths of journals, no label leaves the picture, axes have their labels and every curve is in the key.
if [ -x "$margins" ]; then
    # uncut PICTURE: no text is cut off at an edge, and the label of the vertical axis is there.
    uncut()
    {
        set -- "$1" $("$margins" "$1")
        for edge in "$2" "$3" "$4" "$5"; do between "$1: blank pixels at an edge" "$edge" 2 150; done
        between "$1: blank pixels before the label of the vertical axis" "$2" 2 60
    }
    mkdir tips
    cat >tips/history.csv <<'END'
time [s],step,kinetic [J],strain [J],plastic [J],fracture [J],contact [J],damped [J],absorbed [J],viscous [J],external_work [J],balance_error [1],crack_length [m],pd_share [1],left.K_I [Pa m^0.5],left.K_II [Pa m^0.5],left.contour_spread [1],growth.K_eq [Pa m^0.5],growth.x [m],growth.y [m],growth.length [m],pull.force_x [N],pull.force_y [N],pull.displacement_x [m],pull.displacement_y [m]
0,0,0,0,0,0,0,0,0,0,0,0,0,0.02,0,0,0.5,0,0.05,0.025,0,0,0,0,0
1.5e-5,1,1,2,3,4,5,6,7,8,36,1e-4,0.004,0.05,1e6,-2e6,0.03,1e6,0.052,0.027,0.003,120,-1100,0,1e-5
3e-5,2,2,4,6,8,10,12,14,16,72,-3e-4,0.015,0.12,2e6,-3e6,0.02,2e6,0.06,0.06,0.035,300,-2400,0,3e-5
END
    for size in 85mmx60mm 180mmx100mm; do
        : >all
        "$cleave" plot tips --size $size -o "narrow$size/" >out 2>err
        is "plot --size $size: $(cat err)" $? 0
        for picture in energy crack sif path load_displacement; do uncut "narrow$size/$picture.png"; done
        for name in kinetic viscous "external work" sum K_II growth "crack growth (left)" "peridynamic share (right)"; do
            holds "$size: $name is in a key" grep -a -q "title '$name" all
        done
        holds "$size: the external work does not hide the sum" grep -a -q "lines lw 6 lc rgb '#c8c8c8' title 'external work'.*title 'sum'" all
        is "$size: labels of time axes" "$(grep -a -c "xlabel 'time \[µs\]'" all)" 5
        "$cleave" plot tips --size $size --format pdf -o "narrow$size" >out 2>err
        is "pdf --size $size: $(cat err)" $? 0
        for picture in energy crack sif path load_displacement; do
            made "narrow$size/$picture.pdf"
            command -v gs >/dev/null || continue
            gs -q -dNOPAUSE -dBATCH -sDEVICE=png16m -r144 -sOutputFile="narrow$size/$picture.pdf.png" "narrow$size/$picture.pdf" >out 2>&1
            uncut "narrow$size/$picture.pdf.png"
        done
    done
    mkdir digits
    sed 's/-2400,0,3e-5/-241234,0,312.3e-6/' tips/history.csv >digits/history.csv
    "$cleave" plot digits -o digits/ >out 2>err
    uncut digits/load_displacement.png
    "$cleave" plot results/strip --size 85mmx60mm -o maps/ >out 2>err
    "$cleave" plot --scene strip.yaml --size 85mmx90mm -o maps/scene.png >out 2>err
    for picture in damage last scene; do uncut "maps/$picture.png"; done
    "$cleave" plot results/strip --field speed --times last --title "$(printf 'wide_%.0s' 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15)" -o maps/wide.png >out 2>err
    uncut maps/wide.png
    : >all
    "$cleave" plot results/strip --field speed --size 85mmx60mm --crop -19mm:19mm,0mm:10mm -o maps/six.png >out 2>err
    for tics in $(sed -n 's/^set xtics \([0-9.]*\) format.*/\1/p' all | sort -u); do between "small panels have two tics at least: $(cat err)" "$tics" 1 10; done
    mkdir minute
    sed 's/,1e-4,0.004/,2e-6,0.004/; s/,-3e-4,/,-6e-6,/' tips/history.csv >minute/history.csv
    "$cleave" plot minute --size 85mmx60mm -o minute/ >out 2>err
    uncut minute/energy.png
    holds "an axis for an error that is round-off" grep -a -q "set yrange \[-0.0012:0.0012\]" all
    holds "the label of the error has a place beside wide numbers" grep -a -q "set label 'error \[%\]' at screen 0.02" all
    "$cleave" converge strip.yaml --of energy.kinetic --levels 3 --runs 1 -o finer >out 2>err
    set -- $("$margins" finer/pictures/convergence.png)
    between "the key of a convergence study is whole: blank pixels beside it" "$2" 2 150
    # Pictures of studies have the size that is asked for, too.
    : >all
    "$cleave" converge strip.yaml --of energy.kinetic --levels 3 --runs 1 --size 85mmx60mm -o finer >out 2>err
    is "converge --size: $(cat err)" $? 0
    holds "at spacing 0 there is no interval" sh -c "! grep -a -q '[$]e.*yerrorbars' all"
    "$cleave" sweep strip.yaml -s particles.spacing=1mm,2mm --of energy.kinetic --size 85mmx60mm -o sized >out 2>err
    is "sweep --size: $(cat err)" $? 0
    for picture in finer/pictures/convergence.png sized/pictures/particles.spacing.png; do
        is "$picture: its size" "$("$margins" $picture | cut -d ' ' -f 5-)" "481 340"
        uncut $picture
    done
    # Of the width alone: the key is below the panels, and what is written at the axes has space.
    : >all
    "$cleave" sweep strip.yaml -s particles.spacing=1mm,2mm -s boundary.0.traction='[0, 10 MPa],[1 MPa, 20 MPa]' --of energy.kinetic \
        --of crack.length_end --size 60mm -o column >out 2>err
    is "sweep --size 60mm: $(cat err)" $? 0
    for picture in particles.spacing boundary.0.traction map; do uncut column/pictures/$picture.png; done
    holds "a key below, of two columns" grep -a -q "set key at screen 0[.]02.* horizontal maxcols 2 maxrows 1" all
    holds "slanted values" grep -a -q "set xtics rotate by 40 right ('\[0, 10 MPa\]' 0" all
    # A map says what its axes are, in words and one unit, and its colour bar has no more numbers than fit.
    : >all
    "$cleave" sweep strip.yaml -s particles.spacing=2000um,1000um -s boundary.0.traction='[0, 20 MPa],[0, 10 MPa]' --of energy.kinetic \
        --of crack.length_end --of crack.start_time --size 85mm --format pdf -o in_words >out 2>err
    for label in 'traction on y+ \[MPa\]' 'spacing of particles \[µm\]'; do holds "words at an axis: $(cat err)" grep -a -q "set label '$label' at" all; done
    holds "numbers in ascending order" grep -a -q "set ytics norotate ('1000' 0,'2000' 1)" all
    is "a map has its own tics at each colour bar" "$(grep -a -c 'set cbtics' all)" 3
    between "the width of a map" "$(sed -n 's/^set [lr]margin at screen //p' all | tail -n 2 | paste -s -d ' ' - | awk '{ print $2 - $1 }')" 0.5 0.9
    # Also as a PDF of that size; films are no pictures of studies.
    : >all
    "$cleave" converge strip.yaml --of energy.kinetic --levels 3 --runs 1 --size 85mmx60mm --format pdf -o finer >out 2>err
    is "converge --format pdf: $(cat err)" $? 0
    "$cleave" sweep strip.yaml -s particles.spacing=1mm,2mm --of energy.kinetic --size 85mmx60mm --format pdf -o sized >out 2>err
    is "sweep --format pdf: $(cat err)" $? 0
    for picture in finer/pictures/convergence.pdf sized/pictures/particles.spacing.pdf; do
        holds "$picture is a PDF" sh -c "head -c 5 $picture | grep -q %PDF-"
    done
    is "all pictures are 85 x 60 mm" "$(grep -a -c 'terminal pdfcairo size 3.34[0-9]*in,2.36[0-9]*in' all)" \
        "$(find finer/pictures sized/pictures -name '*.pdf' | wc -l)"
    for study in "sweep strip.yaml -s particles.spacing=1mm,2mm" "converge strip.yaml"; do
        "$cleave" $study --format mp4 -o none >out 2>err
        is "$study --format mp4: exit status" $? 2
        is "$study --format mp4" "$(cat err)" "--format mp4: give png, svg or pdf"
    done
    # In a column of a journal the panel takes most of the width: colour bar or names are below it, and the height is what they need.
    "$cleave" run block.yaml -q -o halves -s duration=0.1us -s output.frames=1 -s body= -s 'bodies=[{name: lower, shape: {box: {from: [0, 0, 0], to: [12 mm, 8 mm, 3 mm]}}},
        {name: upper, shape: {box: {from: [0, 0, 3 mm], to: [12 mm, 8 mm, 6 mm]}}}]' >out 2>err
    for case in "results/strip von_mises" "both kind" "results/block damage" "halves body"; do
        : >all
        "$cleave" plot ${case% *} --field ${case#* } --times last --size 85mm -o column.png >out 2>err
        is "$case in a column: $(cat err)" $? 0
        between "$case in a column: width of the panel" "$(grep -a 'set [lr]margin' all | awk 'NR == 1 { l = $5 } NR == 2 { print $5 - l }')" 0.7 0.97
        uncut column.png
        set -- $("$margins" column.png)
        is "$case in a column: width" "$5" 481
        between "$case in a column: blank below" "$4" 2 40
    done
    "$cleave" plot results/block --field damage --times last --size 53mmx40mm -o small.png >out 2>err
    is "the smallest picture: $(cat err)" $? 0
    uncut small.png
    # A figure of a paper: no title, no numbers of particles in the key, which has two columns.
    : >all
    "$cleave" plot --scene strip.yaml --size 85mm --title '' -o figure.png >out 2>err
    is "plot --scene --size 85mm: $(cat err)" $? 0
    holds "no title" grep -a -q "set label 1 '' at" all
    holds "no numbers of particles" grep -a -q "title 'grip: held x y'" all
    holds "two columns" grep -a -q "set key .*maxcols 2" all
    uncut figure.png
    # A body far from the origin has the unit of its extent, and the space that its numbers need.
    : >all
    "$cleave" plot --scene strip.yaml -s cracks=[] -s boundary=[] -s probes=[] --size 85mm -o far.png \
        -s 'bodies=[{name: plate, shape: {box: {from: [105 m, 200 m], to: [105.02 m, 200.01 m]}}}]' >out 2>err
    is "plot --scene far from the origin: $(cat err)" $? 0
    holds "in the unit of its extent" grep -a -q "set ylabel 'y \[mm\]'" all
    uncut far.png
    for size in 85mmx150mm 180mmx250mm; do
        : >all
        "$cleave" plot both --field kind --size $size -o "keys$size.png" >out 2>err
        made "keys$size.png"
        holds "$size: the key of the methods is in the picture" sh -c "grep -a -q 'material points' all && ! grep -a -q 'screen -' all"
    done
fi

# A stand-in for ffmpeg: it reads pictures, writes a film of one box, and can fail or wait.
cat >bin/ffmpeg <<'END'
#!/bin/sh
[ "$1" = -version ] && exit 0
for last; do :; done
case $last in file:*) film=${last#file:} ;; *) echo "$last: no protocol" >&2; exit 1 ;; esac
case $film in *wait*) echo >"$film"; touch waits; exec sleep 20 ;; *fail*) cat >/dev/null; echo "broken: of the test" >&2; exit 1 ;; esac
echo "$*" >film_words
cat >pictures
printf '\000\000\000\010free' >"$film"
END
chmod +x bin/ffmpeg
mkdir 'a:%d'
"$cleave" plot results/strip --field speed $small -o 'a:%d/film.mp4' >out 2>err
is "a film in a folder with a colon: $(cat err)" $? 0
is "the film" "$(echo a:*/*)" "a:%d/film.mp4"
is "it had all pictures" "$(grep -a -c IEND pictures)" 5
holds "8 frames a second: $(cat film_words)" grep -q -e "-framerate 8 " film_words
"$cleave" plot results/strip --field speed --fps 25 --frames 3 $small -o quick.mp4 >out 2>err
is "--fps: $(cat err)" $? 0
holds "as many frames a second as asked for: $(cat film_words)" grep -q -e "-framerate 25 " film_words
is "and as many frames" "$(grep -a -c IEND pictures)" 3
refused "fps 0" results/strip --field speed --fps 0 -o none.mp4
"$cleave" plot results/strip --field speed --frames 2 $small -o fail.mp4 >out 2>err
is "a film that fails: exit status" $? 1
holds "and says why: $(cat err)" grep -q "^fail.mp4: ffmpeg made no film: broken: of the test$" err
for signal in INT TERM HUP; do
    rm -f waits
    env --default-signal=INT,HUP "$cleave" plot results/strip --field speed --frames 2 $small -o wait.mp4 >out 2>err &
    film=$!
    tries=0
    while [ ! -e waits ] && [ $tries -lt 200 ]; do sleep 0.02; tries=$((tries + 1)); done
    kill -$signal $film
    wait $film
    holds "a film that is stopped by $signal: exit status" test $? -gt 128
    is "$signal: what it leaves" "$(echo fail* wait.*)" "fail* wait.*"
done

finish
