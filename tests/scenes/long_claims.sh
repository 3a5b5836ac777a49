#!/bin/sh
# Numbers stated in documents (bench/claims.csv): scenes and benches that run for minutes must still yield them, each within the tolerance
# of its row. test_claims.sh measures the quick ones. Takes half an hour on two cores.
test_name=long_claims
. tests/support/summary.sh
. tests/support/claims.sh

measure long

# Benches, from the top of a tree of their own.
mkdir "$work/tree" "$work/tree/bench"
cp -r inputs "$work/tree"
for bench in $(awk -F, 'NR > 1 && $4 == "long" && $5 ~ /^cleave bench / && !seen[$5]++ { print substr($5, 14) }' "$claims"); do
    if [ "$bench" = peers ] && ! command -v lmp >/dev/null; then lammps=missing; continue; fi
    (cd "$work/tree" && "$cleave" bench "$bench" --readme) >"$work/log" 2>&1 || fail "bench $bench: $(tail -n 1 "$work/log")"
done
[ "${lammps:-}" != missing ] || cp bench/results/peers.txt "$work/tree/bench/results"

# Scripts whose measurements documents state.
for script in $(awk -F, 'NR > 1 && $4 == "long" && $6 ~ /^test_[a-z_]+: / { sub(/:.*/, "", $6); if (!seen[$6]++) print $6 }' "$claims"); do
    FIGURES=$work/tree/bench/results/$script.txt sh tests/*/"$script.sh" >"$work/log" 2>&1 || fail "$script: $(tail -n 1 "$work/log")"
done
said=$(compare "$work/tree/bench/results" 1) || fail "$said"
holds "benches are compared" [ "${said%% *}" -gt 100 ]
finish
