#!/bin/sh
# floor 5: `cleave bench`: what it refuses, and the table of efficiency on a coarse plate. BUILD: the folder of the program.
set -eu
build=$(cd "${BUILD:-build}" && pwd)
cleave=$build/cleave
inputs=$(pwd)/inputs
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
fail() { echo "test_bench: $1" >&2; exit 1; }

# Refused in one line, exit status 2, nothing written.
for words in coupling accuracy stability threads scale peers nonsense "--slow" "kernels nonsense" efficiency; do
    set +e
    "$cleave" bench $words >out 2>err
    ended=$?
    set -e
    [ $ended -eq 2 ] || fail "bench $words: exit status $ended, not 2"
    [ "$(wc -l <err)" -eq 1 ] || fail "bench $words: $(wc -l <err) lines on standard error"
    [ ! -e results ] || fail "bench $words left files behind"
done
grep -q "inputs" err || fail "efficiency does not say what it misses"

# One scene at a quarter of the particles: the files are there, the columns those of the contract.
command -v gnuplot >/dev/null || { echo "gnuplot is missing: files not tested"; exit 77; }
mkdir inputs
sed 's/spacing: 0.5 mm/spacing: 1 mm/' "$inputs/plate_crack.yaml" >inputs/plate_crack.yaml
OMP_NUM_THREADS=1 "$cleave" bench efficiency --quick >out || fail "efficiency failed"
cd results/bench
[ "$(head -1 efficiency.csv)" = scene,model,t_adaptive,t_pd,t_r,tip_distance,angle_difference_deg,start_difference ] ||
    fail "columns of efficiency.csv"
[ "$(wc -l <efficiency.csv)" -eq 2 ] || fail "one scene gives one line"
# t_r is what the two times before it say, to the nine digits written
awk -F, 'NR == 2 { d = $5 - (1 - $3 / $4); exit !($3 > 0 && $4 > 0 && d < 1e-6 && d > -1e-6) }' efficiency.csv || fail "t_r"
for file in efficiency.json efficiency.png efficiency.svg efficiency_share.csv; do [ -s $file ] || fail "$file is missing"; done
[ "$(wc -l <efficiency_share.csv)" -eq 102 ] || fail "the share is noted at 100 samples and at the start"
echo "test_bench: ok"
