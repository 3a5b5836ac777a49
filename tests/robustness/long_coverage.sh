#!/bin/sh
# Writes the functions that are called by no small scene (small_scenes.txt) and no other command (small_commands.txt), by file, to
# build-coverage/uncovered.txt, for inspection. No coverage is required, except that half of all functions are called. Benches are left out.
test_name=long_coverage
. tests/support/summary.sh
. tests/support/small_scenes.sh

gcov=${GCOV:-gcov}
command -v "$gcov" >/dev/null || { echo "gcov is missing: coverage not looked at"; exit 77; }
echo 'int main(void) { return 0; }' >"$work/none.c"
(cd "$work" && ${CC:-cc} --coverage -c none.c && ${CC:-cc} --coverage -o none none.o && ./none && "$gcov" -n none.gcda) >"$work/said" 2>&1 && grep -q "Lines executed" "$work/said" ||
    { echo "${CC:-cc} and $gcov do not go together: coverage not looked at"; exit 77; }

build=build-coverage
instrumented $build "--coverage -fprofile-update=atomic" OPTIMISE=-O0 SETS=portable
find $build -name '*.gcda' -exec rm {} +

# ---- runs --------------------------------------------------------------------------------------------------------------------

reach() { shift; "$cleave" run -q -t 2 -o "$work/run" --overwrite "$@" >"$work/out" 2>&1 || fail "$*: $(cat "$work/out")"; }
each_scene "${SCENES:-.}" reach
calls() { shift 2; "$cleave" "$@" >"$work/out" 2>&1; }
each_command calls

# ---- functions not reached ---------------------------------------------------------------------------------------------------

# Every function of an object once, with its share of lines; bodies of parallel regions belong to the enclosing function.
for object in $(find "$build/src" "$build/kernels" -name "*.gcno"); do
    "$gcov" -n -f -o "$(dirname "$object")" "$object" 2>"$work/err" | awk -v file="$(basename "${object%.gcno}" .portable)" '
        /^Function / { name = substr($2, 2, length($2) - 2); next }
        /^Lines executed/ && name != "" { if (name !~ /_omp_fn|^_sub_/) print file, name, $0 ~ /executed:0\.00%/; name = "" }
        /^File / { exit }'
done | sort -u >"$work/functions"
awk '{ all++; if (!$3) next; none++; if ($1 != file) { printf "%s%s:", (file == "" ? "" : "\n"), $1; file = $1 } printf " %s", $2 }
    END { printf "\n%d of %d functions are reached by no small scene\n", none, all }' "$work/functions" >$build/uncovered.txt
tail -n 1 $build/uncovered.txt
holds "functions are counted: $(wc -l <"$work/functions")" test "$(wc -l <"$work/functions")" -gt 1000
holds "most are reached" test "$(awk '$3 { none++ } END { print none + 0 }' "$work/functions")" -lt $(($(wc -l <"$work/functions") / 2))
finish
