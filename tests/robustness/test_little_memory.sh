#!/bin/sh
# Runs under memory limits: scenes that need more memory are refused, and an allocation that fails in the program or a library causes one
# line on standard error.
test_name=test_little_memory
. tests/support/summary.sh
. tests/support/trust.sh
# Without surface weights, whose fit would take most of so short a run.
solid="inputs/kalthoff_winkler_3d.yaml -s pd.surface=none -s particles.spacing=2mm -s duration=1us -s accept=[steps,particles,reach] -s output.frames=2 -s output.samples=4 -s output.checkpoint=0"
(ulimit -v 4000000 && "$cleave" info >/dev/null 2>&1) || { echo "ulimit -v is not to be had here"; exit 77; }

# within MEGABYTES THREADS: runs the scene with this limit of address space; $result: its exit status.
within()
{
    (ulimit -v $(($1 * 1024)); exec "$cleave" run -q -t "$2" -o "$work/r" --overwrite $solid) >"$work/out" 2>"$work/err"
    result=$?
}

# The least memory that the loader needs, which is outside the program's control.
least=24
until (ulimit -v $((least * 1024)); "$cleave" --help) >/dev/null 2>&1; do least=$((least + 4)); done
# Limits increase until eight in a row were sufficient: larger ones would repeat the same run.
for threads in 1 2; do
    megabytes=$((least + 4)) failed=0 enough=0
    while [ $megabytes -lt 400 ] && [ $enough -lt 8 ]; do
        within $megabytes $threads
        enough=$((result == 0 ? enough + 1 : 0))
        case $result in
            0) pass ;;
            1) is "$megabytes MB, $threads threads: lines: $(cat "$work/err")" "$(wc -l <"$work/err")" 1; failed=$((failed + 1)) ;;
            2) is "$megabytes MB, $threads threads: refused: $(cat "$work/err")" "$(grep -c 'GB are available (ulimit -v)' "$work/err")" "$(wc -l <"$work/err")"
               failed=$((failed + 1)) ;;
            *) fail "$megabytes MB, $threads threads: status $result: $(cat "$work/err")" ;;
        esac
        megabytes=$((megabytes + 1 + megabytes / 16))
    done
    holds "with $threads threads, some limits were too small and the largest was not" test $failed -gt 2 -a $result -eq 0
done
(ulimit -v 1500000; exec "$cleave" run -q -o "$work/large" $solid -s method=pd -s particles.spacing=0.3mm) 2>"$work/err"
is "a scene beyond the limit: exit status" $? 2
holds "a scene beyond the limit: $(cat "$work/err")" grep -q 'GB of memory, but 1.[0-9] GB are available (ulimit -v)' "$work/err"
finish
