#!/bin/sh
# Numbers stated in documents (bench/claims.csv). Documents and stored results of benches must have the numbers of the table, every number
# in the tables of results must be in it, and scenes that run in seconds must still yield them.
# Takes 40 s: 60 scenes are run.
test_name=test_claims
. tests/support/summary.sh
. tests/support/claims.sh

tables="bench/README.md README.md=How_far_to_trust_it inputs/slow_results.md inputs/elasticity.md=Plates inputs/elasticity.md=Solids
inputs/elasticity.md=What_moves_it inputs/elasticity.md=First_frequencies"
said=$(compare bench/results 0 "$tables") || fail "$said"
holds "claims.csv is compared" [ "$(echo "$said" | sed -n 's/ comparisons$//p')" -gt 1000 ]

is "rows of claims.csv that say the same" "$(sed 's/^[^,]*,//' bench/claims.csv | sort | uniq -d)" ""
holds "bench/README.md has at most 3000 words" [ "$(wc -w <bench/README.md)" -le 3000 ]

# Negative control: another number in a document, in a head, in a kept result, in a file that is a source or in the table itself is seen, and
# so is a row that loses its source.
mkdir -p "$work/copy"
cp -r --parents README.md inputs/*.md inputs/*.yaml bench/README.md bench/results bench/accuracy/*.csv bench/claims.csv \
    $(awk -F, 'match($6, /^[A-Za-z0-9_.\/]+[.][a-z]+: /) && $6 !~ /^(bench\/results|bench\/accuracy|inputs)/ { file = substr($6, 1, RLENGTH - 2); if (file ~ /\//) print file }' \
        bench/claims.csv | sort -u) "$work/copy"
copied() { (cd "$work/copy" && awk -v results=bench/results -v tables="bench/README.md" -f "$root/tests/support/claims.awk" bench/claims.csv) >/dev/null; }
holds "the copy is the original" copied
altered()
{
    cp "$work/copy/$1" "$work/kept"
    sed "$2" "$work/kept" >"$work/copy/$1"
    cmp -s "$work/kept" "$work/copy/$1" && fail "negative control: $1 has no place for $2"
    if copied; then fail "$1 with $2 is not seen"; else pass; fi
    cp "$work/kept" "$work/copy/$1"
}
altered bench/README.md 's/0\.408 ns/0.480 ns/'
altered bench/results/kernels.txt 's/ 0\.408 / 0.508 /'
altered bench/claims.csv 's/,0\.408,/,0.409,/'
altered bench/claims.csv '$s/^\(\([^,]*,\)\{5\}\)[^,]*/\1-/'
altered README.md 's/ leave at 68 degrees/ leave at 67 degrees/'
altered inputs/loads.md 's/expands by 3\.5 %/expands by 3.6 %/'
altered inputs/bar_plastic.yaml 's/0\.260 /0.261 /'
altered tests/scenes/test_scenes.sh 's/1\.07e-3/1.08e-3/'

formulas
measure quick
finish
