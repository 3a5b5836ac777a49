#!/bin/sh
# Memory errors, undefined behaviour and leaks: small scenes of every kind, the other commands and refusals under the address and
# undefined-behaviour sanitizers. SETS: kernel sets; by default only the portable one, since each takes minutes to build.
test_name=long_sanitizers
. tests/support/summary.sh
. tests/support/small_scenes.sh

flags="-fsanitize=address,undefined,float-cast-overflow"
echo 'int main(void) { return 0; }' >"$work/none.c"
${CC:-cc} $flags -o "$work/none" "$work/none.c" >"$work/said" 2>&1 && "$work/none" >"$work/said" 2>&1 ||
    { echo "${CC:-cc} builds nothing with the sanitizers: memory not looked at"; exit 77; }

export ASAN_OPTIONS="detect_leaks=1 exitcode=99" LSAN_OPTIONS=exitcode=98 UBSAN_OPTIONS="print_stacktrace=1 halt_on_error=1 exitcode=97"

# ---- check of the tools ----------------------------------------------------------------------------------------------------

cat >"$work/faults.c" <<'END'
#include <stdlib.h>
int main(int argc, char **argv)
{
    (void)argv;
    volatile int *place = malloc(sizeof(int)), large = 1 << 30;
    if (argc == 2) place[1] = 0;                     /* beyond its end */
    if (argc == 3) large *= 4;                       /* beyond the largest int */
    if (argc == 4) place = NULL;                     /* lost */
    if (argc != 4) free((void *)place);
    return 0;
}
END
${CC:-cc} -g $flags -fno-sanitize-recover=all -o "$work/faults" "$work/faults.c" || fail "faults.c is not built"
for arguments in "" 1 "1 2" "1 2 3"; do
    "$work/faults" $arguments >"$work/said" 2>&1
    result=$?
    if [ -z "$arguments" ]; then is "no fault: exit status ($(head -n 3 "$work/said"))" $result 0
    else holds "fault $arguments is seen" test $result -ge 97; fi
done

# ---- the program -----------------------------------------------------------------------------------------------------------

instrumented build-sanitizers "$flags -fno-sanitize-recover=undefined -fno-omit-frame-pointer" OPTIMISE=-O0 SETS="${SETS:-portable}"

# ends STATUS WHAT COMMAND...: checks that the command ends with this exit status and that no sanitizer reports a fault.
ends()
{
    wanted=$1 what=$2; shift 2
    "$@" >"$work/out" 2>"$work/err"
    is "$what: exit status" $? "$wanted"
    holds "$what: $(grep -E -A 12 'runtime error|ERROR:' "$work/err" | head -n 40)" \
        sh -c '! grep -q -E "runtime error|Sanitizer" "$1"' sh "$work/err"
}

clean()
{
    scene=$1; shift
    for set in ${SETS:-portable}; do
        CLEAVE_SIMD=$set ends 0 "$scene, $set" "$cleave" run -q -t 2 -o "$work/run" "$@"
        rm -rf "$work/run"
    done
}
each_scene "${SCENES:-.}" clean

# calls STATUS WHAT ARGUMENT...: checks as ends() a call of cleave with these arguments, for the lines of small_commands.txt.
calls()
{
    wanted=$1 what=$2; shift 2
    ends "$wanted" "$what" "$cleave" "$@"
}
each_command calls
printf 'body: [{box: {from: [0, 0]' >"$work/torn.yaml"
ends 2 "half a file" "$cleave" check "$work/torn.yaml"
finish
