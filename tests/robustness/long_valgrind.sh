#!/bin/sh
# Uninitialised values and lost memory: tiny scenes under valgrind, which does not support AVX-512, with the portable kernels.
test_name=long_valgrind
. tests/support/summary.sh
. tests/support/small_scenes.sh

command -v valgrind >/dev/null || { echo "valgrind is missing: values that are not set not looked for"; exit 77; }
export CLEAVE_SIMD=portable GOMP_SPINCOUNT=0
memcheck="valgrind -q --error-exitcode=9 --leak-check=full --show-leak-kinds=definite --errors-for-leak-kinds=definite"

# Check of the tool: a program that uses uninitialised memory is detected.
cat >"$work/unset.c" <<'END'
#include <stdlib.h>
int main(void)
{
    int *value = malloc(sizeof *value), result = *(volatile int *)value > 0 ? 3 : 4;
    free(value);
    return result;
}
END
${CC:-cc} -g -O0 -o "$work/unset" "$work/unset.c" || fail "unset.c is not built"
$memcheck "$work/unset" >"$work/out" 2>"$work/err"
is "a value that is not set: exit status" $? 9

# clean NAME ARGUMENTS: checks that a run succeeds and that valgrind reports no fault.
clean()
{
    scene=$1; shift
    $memcheck "$cleave" run -q -t 2 -o "$work/run" "$@" >"$work/out" 2>"$work/err"
    is "$scene: exit status" $? 0
    holds "$scene: $(grep '^==' "$work/err" | head -n 30)" sh -c '! grep -q "^==" "$1"' sh "$work/err"
    rm -rf "$work/run"
}

# Few particles and steps: everything is 30 times slower here.
coarse() { clean "$@" -s particles.spacing=8mm -s time.step=0.8us -s duration=24us -s output.samples=4; }
short() { clean "$@" -s duration=2us; }
each_scene "${SCENES:-plate$|plate_(bonds|reference|current|ordinary|turning|handshake)|points_cubic|cells}" coarse
each_scene "${SCENES:-meet|grow|list|block$|driven|rigid$|led$|bore|weak$|shapes$|absorbing$|grids$|joined}" short
each_scene "${SCENES:-relaxed|spin|bar_return|steps$|steps_(yield$|contact$|adaptive|solid$)}" clean
finish
