#!/bin/sh
# Absorbing faces in runs of a plate: absorbed energy with every method, bitwise equality on any number of threads and after a stop, a
# face in two parts, the scene as written out, the help.
test_name=test_absorbing
. tests/support/summary.sh
. tests/support/trust.sh
plate=inputs/absorbing_plate.yaml

# share FOLDER: prints the absorbed energy divided by the work of the loads.
share() { awk -v a="$(figure "$1" energy.absorbed)" -v w="$(figure "$1" energy.external_work)" 'BEGIN { print a / w }'; }
# within WHAT VALUE LOW HIGH: checks LOW <= VALUE <= HIGH.
within() { holds "$1: $2 is not within $3 .. $4" awk -v x="$2" -v a="$3" -v b="$4" 'BEGIN { exit !(x >= a && x <= b) }'; }

# Bonds and cells conserve energy; APIC dissipates some on its grid, with and without absorbing faces.
for way in pd reference apic; do
    case $way in
    pd) more="-s method=pd" ;;
    reference) more="-s method=mpm -s mpm.frame=reference" ;;
    apic) more="-s method=mpm -s mpm.frame=current -s mpm.transfer=apic" ;;
    esac
    for threads in 1 2 3; do calm "$work/$way$threads" $plate $more -t $threads; done
    same "$way on 2 threads" "$work/${way}1" "$work/${way}2"
    same "$way on 3 threads" "$work/${way}1" "$work/${way}3"
    within "$way: absorbed" "$(share "$work/${way}1")" 0.9 1
    within "$way: momentum error" "$(figure "$work/${way}1" momentum_error)" 0 1e-13
    [ $way = apic ] || within "$way: balance error" "$(figure "$work/${way}1" energy.balance_error)" -1e-6 1e-6
    interrupted "$work/stopped" 40 $plate $more
    calm "$work/stopped" -t 3 --resume $plate $more
    same "$way, stopped" "$work/${way}1" "$work/stopped"
    rm -r "$work/${way}2" "$work/${way}3" "$work/stopped"
done

# Points convert up to the face during the motion.
adaptive="$plate -s method=adaptive -s mpm.frame=reference -s conversion.stress=0.2MPa -s material.energy_release_rate=100"
for threads in 1 2; do calm "$work/adaptive$threads" $adaptive -t $threads; done
same "adaptive on 2 threads" "$work/adaptive1" "$work/adaptive2"
# Conversion in motion dissipates 5 % here, also without the faces.
within "adaptive: absorbed" "$(share "$work/adaptive1")" 0.85 1
within "adaptive: balance error" "$(figure "$work/adaptive1" energy.balance_error)" -0.06 0.001
holds "adaptive: nothing converted" test -n "$(figure "$work/adaptive1" conversion.first_time)"

# A face in two parts is equivalent to the whole face; overlapping parts would have two dashpots.
part() { sed "s/{name: right, absorbing: true, face: x+}/{name: right, absorbing: true, face: x+, region: {box: {from: [0, 0], to: [80 mm, 30 mm]}}}\n  - {absorbing: true, face: x+, region: {box: {from: [0, $1 mm], to: [80 mm, 60 mm]}}}/" $plate; }
part 30 >"$work/parts.yaml"
part 28 >"$work/overlap.yaml"
calm "$work/parts" "$work/parts.yaml" -s method=pd
within "in parts" "$(awk -v a="$(share "$work/parts")" -v b="$(share "$work/pd1")" 'BEGIN { print a / b - 1 }')" -1e-12 1e-12
sed "s/^boundary:/boundary:\n  - {name: middle, mirror: {axis: x, at: 80 mm}}/" $plate >"$work/behind.yaml"
refused "a face in a mirror" "$work/not" "mirror middle is a plane of symmetry at this face" "$work/behind.yaml"
refused "parts that overlap" "$work/not" "boundary boundary4: boundary right already absorbs at this face" "$work/overlap.yaml"

# The echo is an equivalent scene, the key is documented, check accepts the scene.
calm "$work/echo" "$work/pd1/scene.yaml"
same "the echo" "$work/pd1" "$work/echo"
holds "help" sh -c '"$1" help boundary.absorbing | grep -q rho' - "$cleave"
holds "check" sh -c '"$1" check "$2" >/dev/null' - "$cleave" $plate

finish
