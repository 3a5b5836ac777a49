#!/bin/sh
# Data races: small scenes of every kind on 3 threads under ThreadSanitizer, with clang's OpenMP library and Archer, which reports the
# ordering by barriers to the sanitizer. RACES_CC: another name of clang.
test_name=long_races
. tests/support/summary.sh
. tests/support/small_scenes.sh

cc=${RACES_CC:-$(command -v clang-14 || command -v clang)}
[ -n "$cc" ] || { echo "clang is missing: no races looked for"; exit 77; }
archer=$("$cc" -print-resource-dir)/../../libarcher.so
[ -e "$archer" ] || { echo "libarcher.so (clang's OpenMP library) is missing: no races looked for"; exit 77; }

export OMP_TOOL_LIBRARIES="$archer" KMP_BLOCKTIME=0
export TSAN_OPTIONS="ignore_noninstrumented_modules=1 report_signal_unsafe=1 exitcode=66"

# ---- check of the tool ---------------------------------------------------------------------------------------------------

cat >"$work/race.c" <<'END'
int main(void)
{
    int sum = 0, apart[64] = {0};
#pragma omp parallel for
    for (int i = 0; i < 64; i++) apart[i] = i;
#pragma omp parallel for
    for (int i = 0; i < 64; i++) apart[63 - i] += i;
#ifdef RACE
#pragma omp parallel for
    for (int i = 0; i < 64; i++) sum += apart[i];
#endif
    return sum < 0;
}
END
for race in "" -DRACE; do
    "$cc" -g -O1 -fopenmp -fsanitize=thread $race -o "$work/race$race" "$work/race.c" >"$work/said" 2>&1 ||
        { echo "$cc builds nothing with ThreadSanitizer: no races looked for"; exit 77; }
done
OMP_NUM_THREADS=2 "$work/race" >"$work/said" 2>&1
is "loops without a race: exit status ($(cat "$work/said"))" $? 0
OMP_NUM_THREADS=2 "$work/race-DRACE" >"$work/said" 2>&1
is "loops with a race: exit status" $? 66

# ---- the program ---------------------------------------------------------------------------------------------------------

instrumented build-races "-fsanitize=thread -fno-omit-frame-pointer" CC="$cc" OPTIMISE=-O1 SETS=portable
holds "Archer is on" sh -c 'ARCHER_OPTIONS=verbose=1 "$1" info 2>&1 | grep -q -i "archer detected.* with tsan"' sh "$cleave"

# clean NAME ARGUMENTS: checks that a run on three threads, an odd number that divides work unevenly, succeeds without a data race.
clean()
{
    scene=$1; shift
    "$cleave" run -q -t 3 -o "$work/run" "$@" >"$work/out" 2>"$work/err"
    is "$scene: exit status" $? 0
    holds "$scene: $(grep -A 12 'WARNING: ThreadSanitizer' "$work/err" | head -n 40)" sh -c '! grep -q ThreadSanitizer "$1"' sh "$work/err"
    rm -rf "$work/run"
}
each_scene "${SCENES:-.}" clean
finish
