#!/bin/sh
# Kernel sets (kernels compiled for one set of vector instructions): a scene has equal results with each, to round-off, and bitwise equal
# results on any number of threads; `cleave info` lists the sets, and a wrong name is refused.
# Takes 25 s: runs of each set of kernels that the processor has.
test_name=test_sets
. tests/support/summary.sh
. tests/support/trust.sh

# ---- available sets --------------------------------------------------------------------------------------------------

"$cleave" info >"$work/info" || fail "info failed"
sets=$(sed -n '/^kernels /,/^cores /{/^cores /d;/not on this processor/d;s/^kernels//;s/:.*//;p;}' "$work/info")
sed -n 's/^  *\([a-z0-9]*\):.*not on this processor$/skipped: \1, not on this processor/p' "$work/info"
case " $(echo $sets) " in *" portable "*) pass ;; *) fail "there is no portable set: $sets" ;; esac
first=$(echo $sets | cut -d ' ' -f 1)              # the default

# refused NAME WORDS: checks that CLEAVE_SIMD=NAME causes one line with WORDS, and exit status 2.
refused()
{
    CLEAVE_SIMD=$1 "$cleave" info >"$work/out" 2>"$work/error"
    is "CLEAVE_SIMD=$1: exit status" $? 2
    is "CLEAVE_SIMD=$1: lines" "$(wc -l <"$work/error")" 1
    holds "CLEAVE_SIMD=$1: $(cat "$work/error")" grep -q "^CLEAVE_SIMD=$1: .*$2.*portable" "$work/error"
}
refused sse9 "no such set"
refused "" "no such set"
for set in $(sed -n 's/^  *\([a-z0-9]*\):.*not on this processor$/\1/p' "$work/info"); do refused $set "this processor lacks"; done

# ---- one scene with every set ------------------------------------------------------------------------------------------

cat >"$work/strip.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 15 us
method: adaptive
material: {young: 72 GPa, poisson: 1/3, density: 2440 kg/m^3, energy_release_rate: 135 J/m^2}
body:
  - box: {from: [0, -15 mm], to: [47 mm, 15 mm]}
  - subtract: {disc: {centre: [36 mm, 0], radius: 4 mm}}
particles: {spacing: 1 mm, horizon: 3.015}
cracks:
  - {from: [0, 0], to: [24 mm, 0]}
boundary:
  - {traction: [0, 8 MPa], face: y+}
  - {traction: [0, -8 MPa], face: y-}
END
cat >"$work/block.yaml" <<'END'
space: solid
duration: 6 us
method: adaptive
material: {young: 72 GPa, poisson: 1/4, density: 2440 kg/m^3, energy_release_rate: 135 J/m^2}
body:
  - box: {from: [0, -6 mm, 0], to: [13 mm, 6 mm, 7 mm]}
particles: {spacing: 1 mm, horizon: 3.015}
cracks:
  - polygon: [[0, 0, 0], [6 mm, 0, 0], [6 mm, 0, 7 mm], [0, 0, 7 mm]]
boundary:
  - {traction: [0, 6 MPa, 0], face: y+}
  - {traction: [0, -6 MPa, 0], face: y-}
END

# alike A B UNTIL: checks that no column of history.csv in the folders A and B differs by more than 2e-9 of its largest magnitude before the
# time UNTIL [s]. Nine digits are written, and round-off may change the last one in each file. Left out are columns that are round-off or
# small differences (momentum, errors), and differences of energies below the round-off of the largest energy.
alike()
{
    paste -d , "$1/history.csv" "$2/history.csv" | awk -F, -v until="$3" '
        NR == 1 { n = NF / 2; for (k = 1; k <= n; k++) name[k] = $k; next }
        until + 0 > 0 && $1 + 0 >= until + 0 { exit }
        { lines++
          for (k = 1; k <= n; k++) {
              d = $k - $(k + n); if (d < 0) d = -d
              size = $k < 0 ? -$k : $k + 0
              if (size > most[k]) most[k] = size
              if (name[k] ~ /\[J\]/ && size > energy) energy = size
              if (d > apart[k]) apart[k] = d
          } }
        END {
            for (k = 1; k <= n; k++) if (name[k] !~ /momentum|error/ && apart[k] > 2e-9 * most[k] && !(name[k] ~ /\[J\]/ && apart[k] < 1e-16 * energy)) { print name[k], apart[k], most[k]; bad = 1 }
            exit bad || lines < 20
        }'
}

run() { set_=$1; shift; CLEAVE_SIMD=$set_ calm "$@"; }

for scene in "strip" "strip -s mpm.frame=current" "strip -s model=ospd" "strip -s method=pd -s model=mospd" "block" \
             "block -s method=pd -s model=mospd -s material.energy_release_rate=5000 -s pd.surface=none" \
             "block -s mpm.frame=current -s mpm.shape=cpgimp -s mpm.transfer=apic"; do
    for set in $sets; do
        rm -rf "$work/$set" "$work/two"
        run $set "$work/$set" -t 1 "$work/"${scene%% *}.yaml ${scene#"${scene%% *}"}
        run $set "$work/two" -t 2 "$work/"${scene%% *}.yaml ${scene#"${scene%% *}"}
        same "threads: $scene, $set" "$work/$set" "$work/two"
        is "summary: $set" "$(figure "$work/$set" kernels)" $set
        # Bonds break one by one: the order of two equally stretched ones depends on round-off.
        holds "$scene: $set and $first" alike "$work/$set" "$work/$first" "$(figure "$work/$first" crack.start_time)"
    done
done

# ---- restart with another set ------------------------------------------------------------------------------------------

# resumed SET LINES: checks that the strip, stopped with the first kernel set, can be resumed with SET and then prints LINES lines on
# standard error.
resumed()
{
    rm -rf "$work/resumed"
    CLEAVE_SIMD=$first interrupted "$work/resumed" 10 "$work/strip.yaml" -s output.samples=100
    CLEAVE_SIMD=$1 "$cleave" run -q -o "$work/resumed" --resume "$work/strip.yaml" -s output.samples=100 >"$work/out" 2>"$work/err"
    is "$first, then $1: exit status" $? 0
    is "$first, then $1: lines said" "$(wc -l <"$work/err")" "$2"
}
resumed $first 0
resumed portable $([ $first = portable ] && echo 0 || echo 1)
[ $first = portable ] || holds "what is said: $(cat "$work/err")" grep -q "^warning: .*written with $first .*run continues with portable.*CLEAVE_SIMD=$first" "$work/err"
finish
