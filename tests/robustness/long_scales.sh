#!/bin/sh
# Checks that no quantity with a dimension is hidden in the code. Small scenes of every kind are run in units whose lengths, times and
# masses are multiplied by 16, 64 and 1/4 (powers of two); scaled results must agree in all digits that history.csv prints. Takes 600 s: two
# runs of each of 130 scenes.
test_name=long_scales
. tests/support/summary.sh
. tests/support/small_scenes.sh
python3 -c 'import yaml' 2>/dev/null || { echo "python3-yaml is not installed"; exit 77; }
"$cleave" help --reference >"$work/keys"

# Left out: scenes with positions in files (list, stack), those with formulas of place or time (driven, bore, steps_yield, steps_flow,
# steps_hot), and those whose keys `step` and `section` are lengths here and other quantities elsewhere (shapes).
left='^(list|stack|driven.*|bore|steps_yield|steps_flow|steps_hot|shapes.*)$'

while IFS='|' read -r name file settings <&3; do
    echo "$name" | grep -qE "$left" && continue
    call_with "$file" "$settings" "$cleave" run -q -t 1 --overwrite -o "$work/a" 2>/dev/null || { fail "$name does not run"; continue; }
    python3 tests/robustness/scales.py scene "$work/a/scene.yaml" "$work/b.yaml" <"$work/keys"
    "$cleave" run -q -t 1 --overwrite -o "$work/b" "$work/b.yaml" 2>"$work/err" || { fail "$name, scaled: $(tail -n 1 "$work/err")"; continue; }
    set -- $(python3 tests/robustness/scales.py compare "$work/a" "$work/b")
    holds "$name: $*" awk -v off="$1" 'BEGIN { exit !(off <= 3e-8) }' /dev/null
done 3<"$work/small_scenes"

finish
