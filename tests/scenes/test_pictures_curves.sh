#!/bin/sh
# Pictures of curves: histories, sweeps, load over displacement, profiles along a bar, checked by the input of gnuplot, of which a
# stand-in keeps a copy; pictures in a folder given by -o.
# Takes 20 s: each picture is a process of gnuplot.
test_name=test_pictures_curves
. tests/support/summary.sh
. tests/support/pictures.sh
keep_commands all -a

# Numbers of a history in the units of their axes.
mkdir curves
cat >curves/history.csv <<'END'
time [s],step,load_time [s],kinetic [J],strain [J],external_work [J],crack_length [m],pd_share [1],pull.force_x [N],pull.force_y [N],pull.displacement_x [m],pull.displacement_y [m]
0,0,0,0,0,0,0,0.02,0,0,0,0
1,1,1,0,0.0037,0.0041,0,0.03,500,1200,0,2.3e-05
2,2,2,0,0.0052,0.0099,0.0042,0.055,0,900,0,5.7e-05
END
"$cleave" plot curves >out 2>err
is "plot of a history: $(cat err)" $? 0
for line in "2 4.2 5.5" "2 5.2 9.9" "23 1.2" "57 0.9"; do holds "numbers of a curve: $line" grep -a -q "^$line$" all; done
holds "their sum leaves work out" grep -a -q 'using 1:(0+$2) with' all
for label in "crack growth \[mm\]" "force y \[kN\]" "displacement y \[µm\]" "energy \[mJ\]"; do holds "an axis: $label" grep -a -q "$label" all; done

# A crack that turns downwards by 60 degrees from (50 mm, 0), 20 mm long: the line of an experiment goes down, too, at 70 degrees: it ends
# at 50 + 20 cos 70 = 56.840403 mm, -20 sin 70 = -18.793852 mm.
mkdir turned
cat >turned/history.csv <<'END'
time [s],step,growth.K_eq [Pa m^0.5],growth.x [m],growth.y [m],growth.length [m]
0,0,1e6,0.05,0,0
1e-5,1,1e6,0.06,-0.0173205081,0.02
END
echo '{"probes": {"growth": {"angle_deg": 60, "experiment_deg": 70, "direction_deg": 0}}}' >turned/summary.json
: >all
"$cleave" plot turned -o turned/ $small >out 2>err
holds "the line of an experiment is on the side of the crack: $(cat err)" grep -a -q "^56[.]84040[0-9]* -18[.]79385[0-9]*$" all

# Figures of a sweep are those of --of, in units with a prefix.
: >all
"$cleave" sweep strip.yaml -s particles.spacing=1mm,2mm --of crack.start_time --of energy.kinetic -o varied >out 2>err
for title in "crack: start time .[µnm]s." "energy: kinetic .[mµn]J."; do holds "a figure of a sweep: $title: $(cat err)" grep -a -q "set title '$title'" all; done
is "no other" "$(grep -a -c "set title '[a-z]" all)" 2
"$cleave" sweep strip.yaml -s particles.spacing=1mm,2mm --of crack.strat_time -o unvaried >out 2>err
is "sweep --of an unknown figure: exit status" $? 2
holds "it names the nearest" grep -q "summary.json has no such figure; did you mean crack\." err
absent "an unknown figure is refused before any run" "$(ls -d unvaried 2>/dev/null)"

# Numbers of a key without a unit are in SI, which the axis says, and so does the page.
: >all
"$cleave" sweep strip.yaml -s materials.0.energy_release_rate=10,20 --of energy.kinetic -o tough >out 2>err
holds "the unit of a key: $(cat err)" grep -a -q "set label 'energy release rate of glass \[J/m²\]'" all
"$cleave" report tough -o new/page/tough.html >out 2>err
is "report into a folder that is not there: $(cat err)" $? 0
holds "the page has the unit of the key" grep -q '"materials.0.energy_release_rate": "J/m^2"' new/page/tough.html

# Curves that coincide are both seen: the second one is dashed, in a sweep with rings. Others are not.
mkdir twin
cat >twin/history.csv <<'END'
time [s],step,kinetic [J],strain [J],external_work [J],damped [J],left.K_I [Pa m^(1/2)],left.K_II [Pa m^(1/2)],right.K_I [Pa m^(1/2)],right.K_II [Pa m^(1/2)]
0,0,0,0,0,0,0,0,0,0
1,1,1,1.001,2.4,0.4,1e6,4e5,1.001e6,2e5
2,2,2,2.001,5.1,1.1,2e6,5e5,2.001e6,1e5
END
: >all
"$cleave" plot twin -o twins/ $small >out 2>err
holds "the second of two energies is dashed: $(cat err)" grep -a -q "with lines lw 2.2 dt (7,7) lc rgb '#[0-9a-f]*' title 'strain'" all
is "energies and factors that are dashed" "$(grep -a -o 'dt (7,7)' all | wc -l | tr -d ' ')" 2
holds "the second of two factors is dashed" grep -a -q "dt (7,7) lc rgb '#[0-9a-f]*' title 'right: K_I'" all
: >all
"$cleave" sweep strip.yaml -s materials.0.energy_release_rate=1e9,2e9 -s particles.spacing=1mm,2mm --of energy.kinetic -o alike >out 2>err
holds "a line of a sweep over another one: $(cat err)" grep -a -q '^plot .*pt 7 ps 0.9 .*dt (7,7) .*pt 6 ps 1.6' all

# Load over displacement of a rigid body that moves, from its columns; metres where they are meant; a bar has no length of cracks.
mkdir pressed
cat >pressed/history.csv <<'END'
time [s],step,hammer_force_x [N],hammer_force_y [N],hammer_moment_z [N m],hammer_x [m],hammer_y [m],crack_length [m],pd_share [1]
0,0,0,0,0,0.1,2.5,0,1
1e-3,1,300,400,0,0.1,2.49,1.5,1
2e-3,2,0,1200,0,0.1,2.47,2.5,1
END
: >all
"$cleave" plot pressed $small >out 2>err
for line in "10 0.4" "30 1.2"; do holds "force over the way of a rigid body: $line" grep -a -q "^$line$" all; done
holds "metres" grep -a -q "crack growth \[m\]" all
holds "no axis for a share that stays the same" sh -c "! grep -a -q 'peridynamic share .%' all"
sed -i 's/,0,1$/,0,0.5/' pressed/history.csv
"$cleave" plot pressed -o shares/ $small >out 2>err
holds "a share of all particles: its axis ends at 100 %" grep -a -q "set y2range \[0:104\]" all

# The energy of a heavy hammer does not flatten the others: what it has at the start is subtracted, and the key says so.
mkdir heavy
cat >heavy/history.csv <<'END'
time [s],step,kinetic [J],strain [J],external_work [J]
0,0,600,0,0
1e-3,1,599.98,0.02,0
2e-3,2,599.9,0.1,0
END
: >all
"$cleave" plot heavy $small >out 2>err
holds "the start is subtracted: $(cat err)" grep -a -q "using 1:(\$2-600000) with lines .* title 'kinetic - 600 J'" all
sed -i 's/,60*0*,0,0$/,0.1,0,0/; s/,599.9[8]*,/,0.05,/' heavy/history.csv
: >all
"$cleave" plot heavy -o light/ $small >out 2>err
holds "that of others is not: $(cat err)" grep -a -q "using 1:(\$2) with lines .* title 'kinetic'" all

# A particle that spalls off a bar is a point, and does not stretch the axes of the others.
cat >spall.yaml <<'END'
space: line
section: 4 mm^2
duration: 12 us
method: pd
material: {young: 70 GPa, density: 2700, energy_release_rate: 200 J/m^2}
body: {box: {from: 0, to: 40 mm}}
particles: {spacing: 1 mm}
boundary: [{traction: [300 MPa], face: x+, time: {pulse: {from: 0, until: 8 us}}}]
output: {frames: 3}
END
"$cleave" run spall.yaml -q -o spall >out 2>err
: >all
"$cleave" plot spall $small >out 2>err
holds "no crack.png of a bar, with the reason" grep -q "crack.png is not drawn: a crack of a bar has no length" out
refused "colours is for maps, but a run in one dimension has curves" spall --field stress_xx --colours magma
holds "the profiles say which component: $(cat err)" grep -a -q "set ylabel 'velocity x" all
holds "colours of times are in order" grep -a -q "using 1:2 with lines lw 1.8 lc rgb '#440154' title '0 " all
holds "a lone particle is a point: $(cat err)" grep -a -q '$l3 using 1:2 with points' all
holds "and outside the axis of velocities" grep -a -q "profiles (1 particle is outside the picture)" all
between "whose axis is that of the bar" "$(sed -n 's/^set yrange .*:\([0-9.]*\)\].*/\1/p' all | head -n 1)" 0.5 20

# The names of more curves than fit beside a panel are below it.
"$cleave" run spall.yaml -q -o many -s output.frames=23 >out 2>err
: >all
"$cleave" plot many --field stress_xx --times all -o many.png >out 2>err
holds "24 curves: $(cat err)" grep -q "stress_xx of 24 frames" out
holds "their names are below the panel" grep -a -q "^set key at .* horizontal maxcols 6 maxrows 4$" all

# Load steps of a bar: profiles are named by the step, and a bar at rest has no panel of velocities.
"$cleave" run spall.yaml -q -o slow -s solver=static -s steps.number=2 -s 'boundary=[{fixed: [x], face: x-}, {displacement: [1 um], face: x+, time: {ramp: {until: 12 us}}}]' >out 2>err
: >all
"$cleave" plot slow $small >out 2>err
holds "the key names load steps: $(cat err)" grep -a -q "using 1:3 with lines lw 1.8 lc rgb '#[0-9a-f]*' title 'load step 2'" all
"$cleave" plot slow --field stress_xx --times 1 $small -o step.png >out 2>err
holds "a number without unit is a load step: $(cat err)" grep -a -q "title 'load step 1'" all
refused "load step 3 is not in the run" slow --field stress_xx --times 3
holds "no velocity of a bar at rest" sh -c "! grep -a -q 'velocity x' all"

# A support that a probe measures too: one curve with both names, one peak; others stay apart.
mkdir twice
cat >twice/history.csv <<'END'
time [s],step,load_time [s],probe.force_x [N],probe.displacement_x [m],up.force_x [N],up.displacement_x [m],down.force_x [N],down.displacement_x [m]
0,0,0,0,0,0,0,0,0
1,1,1,470,1e-5,470.001,1e-5,-300,-1e-5
2,2,2,900,2e-5,900.001,2e-5,-700,-2e-5
END
: >all
"$cleave" plot twice $small -o twice/ >out 2>err
holds "two curves that coincide are one: $(cat err)" grep -a -q "title 'probe, up'" all
is "their peak and the other's" "$(grep -a -o "title 'sampled along [^ ]*: [0-9.]* N at 20 µm'" all | tr '\n' ' ')" "title 'sampled along x: 900 N at 20 µm' title 'sampled along −x: 700 N at 20 µm' "

# Signed components along which a body is driven: a loop goes round the origin; the part that moves without force ends the axis.
mkdir signed
cat >signed/history.csv <<'END'
time [s],step,load_time [s],up.force_x [N],up.force_y [N],up.displacement_x [m],up.displacement_y [m],base.force_x [N],base.force_y [N],base.displacement_x [m],base.displacement_y [m]
0,0,0,0,0,0,0,0,0,0,0
1,1,1,3,-400,0,-1e-5,5,1,1e-24,0
2,2,2,-3,300,0,1e-5,-5,1,-1e-24,0
3,3,3,0,0,0,2e-5,0,0,0,0
4,4,4,0,0,0,2e-4,0,0,0,0
END
cp strip.yaml signed/scene.yaml
: >all
"$cleave" plot signed $small -o signed/ >out 2>err
holds "components are named: $(cat err)" grep -a -q "^set ylabel 'force −y \[N\]'" all
holds "motion without force is named" grep -a -q "^set xlabel 'displacement −y \[µm\], without force up to -200 µm'" all
holds "a curve that is signed" grep -a -q "^-10 -300$" all
holds "round-off is no motion" sh -c "! grep -a -q \"title 'base\" all"

# A force that stays 0 is not drawn; the prefixes of units go as far as those of SI.
mkdir flat
cat >flat/history.csv <<'END'
time [s],step,load_time [s],kinetic [J],up.force_x [N],up.force_y [N],up.displacement_x [m],up.displacement_y [m],pin.force_x [N],pin.force_y [N],pin.displacement_x [m],pin.displacement_y [m]
0,0,0,0,0,0,0,0,0,0,0,0
1,1,1,1e17,0,1e15,8e-5,1e-4,1e9,0,1e-4,0
2,2,2,1.67e17,0,2e15,8e-5,2e-4,0,0,2e-4,0
END
: >all
"$cleave" plot flat $small -o flat/ >out 2>err
holds "one curve: $(cat err)" grep -a -q "title 'up', .f0 every" all
holds "no other" sh -c "! grep -a -q 'f1' all"
for label in "energy \[PJ\]" "force y \[PN\]"; do holds "an axis: $label" grep -a -q "$label" all; done

# Nor is a stress-intensity factor that stays 0.
mkdir opened
cat >opened/history.csv <<'END'
time [s],step,tip.K_I [Pa m^0.5],tip.K_II [Pa m^0.5]
0,0,0,0
1e-5,1,1e6,0
END
: >all
"$cleave" plot opened $small -o opened/ >out 2>err
holds "K_I: $(cat err)" grep -a -q "title 'K_I'" all
holds "no K_II" sh -c "! grep -a -q K_II all"

# A face that only turns has a mean displacement of round-off, over which nothing is drawn.
mkdir turning
cat >turning/history.csv <<'END'
time [s],step,load_time [s],right.force_x [N],right.force_y [N],right.displacement_x [m],right.displacement_y [m]
0,0,0,0,0,0,0
1,1,1,200,0,1.4e-20,0
2,2,2,-290,0,-1.7e-21,0
END
cp strip.yaml turning/scene.yaml
"$cleave" plot turning $small -o turning/ >out 2>err
holds "a face that only turns: $(cat err)" grep -q "load_displacement.png is not drawn: .* only turns" out

# A rigid body at rest that carries the load is named as such.
mkdir anvil
cat >anvil/history.csv <<'END'
time [s],step,anvil_force_x [N],anvil_force_y [N],anvil_moment_z [N m],anvil_x [m],anvil_y [m]
0,0,0,0,0,0.1,2.5
1e-3,1,300,400,0,0.1,2.5
END
cp strip.yaml anvil/scene.yaml
"$cleave" plot anvil $small -o anvil/ >out 2>err
holds "a rigid body at rest: $(cat err)" grep -q "load_displacement.png is not drawn: the rigid body that carries the load does not move" out

# The peak of the load is marked, not a larger force of the other sign after the break.
mkdir broken
cat >broken/history.csv <<'END'
time [s],step,grip.force_x [N],grip.force_y [N],grip.displacement_x [m],grip.displacement_y [m]
0,0,0,0,0,0
1e-5,1,629,0,1e-4,0
2e-5,2,0,0,2e-4,0
3e-5,3,-631,0,3e-4,0
END
: >all
"$cleave" plot broken $small -o broken/ >out 2>err
holds "the peak before the break: $(cat err)" grep -a -q "sampled along x: 629 N at 100 µm" all

# Numbers of five digits below the axis of a column of a journal do not touch: tics every 5000 mm^2.
mkdir grown
cat >grown/history.csv <<'END'
time [s],step,load_time [s],released [J],crack_area [m^2],release_rate [J/m^2]
0,0,0,0,0,nan
1,1,1,1,0.01,100
2,2,2,2,0.019,110
END
: >all
"$cleave" plot grown --size 85mmx70mm -o grown/ >out 2>err
holds "tics of areas: $(cat err)" grep -a -q "^set xtics 5000$" all

# The supports of a scene without probes bear the load; a run without supports, or whose rigid body bears no load, has no such curve.
"$cleave" run strip.yaml -q -o held2 -s 'boundary=[{name: grip, fixed: all, face: y-}, {name: jaw, velocity: [0, 1 m/s], face: y+}]' >out 2>err
: >all
"$cleave" plot held2 $small >out 2>err
made held2/pictures/load_displacement.png
holds "the support that moves" grep -a -q "title .jaw" all
holds "not the one at rest" sh -c "! grep -a -q 'title .grip' all"
"$cleave" run strip.yaml -q -o free -s 'boundary=[{traction: [0, 1 kPa], face: y+}]' >out 2>err
"$cleave" plot free $small >out 2>err
holds "no force on the rigid body: a line says so" grep -q "load_displacement.png is not drawn: the rigid bodies bear no load" out
sed '/anvil/d' strip.yaml >alone.yaml
"$cleave" run alone.yaml -q -o alone -s 'boundary=[{traction: [0, 1 kPa], face: y+}]' >out 2>err
"$cleave" plot alone $small >out 2>err
holds "no support: a line says so" grep -q "load_displacement.png is not drawn: no force to draw" out

# All pictures into a folder of -o, whether it is there or not; one picture into a file.
"$cleave" plot held2 $small -o elsewhere >out 2>err
is "plot -o FOLDER: $(cat err)" $? 0
is "the pictures are those of DIR/pictures" "$(ls elsewhere)" "$(ls held2/pictures)"
"$cleave" plot held2 $small -o else/where/ --format svg >out 2>err
holds "in another format" test -s else/where/energy.svg
holds "says where" grep -q "^pictures in else/where$" out
echo mine >elsewhere/energy.png
refused "energy.png" held2 -o elsewhere
is "a picture of others" "$(cat elsewhere/energy.png)" mine
"$cleave" plot held2 $small -o elsewhere --overwrite >out 2>err
is "plot -o FOLDER --overwrite: $(cat err)" $? 0
holds "it is replaced" sh -c "head -c 4 elsewhere/energy.png | grep -q PNG"
refused "a folder with / at its end" held2 -o a.folder
refused "5 panels do not fit into a picture of this size" held2 --field speed --size 53mmx40mm

finish
