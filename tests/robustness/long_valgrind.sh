#!/bin/sh
# Values that are used before they are set, and memory that is lost: tiny scenes under valgrind, which knows no AVX-512, with
# the portable kernels.
test_name=long_valgrind
. tests/support/summary.sh
. tests/support/small_scenes.sh

command -v valgrind >/dev/null || { echo "valgrind is missing: values that are not set not looked for"; exit 77; }
export CLEAVE_SIMD=portable GOMP_SPINCOUNT=0
memcheck="valgrind -q --error-exitcode=9 --leak-check=full --show-leak-kinds=definite --errors-for-leak-kinds=definite"

# A program that uses what is not set is found out.
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

clean()
{
    scene=$1; shift
    $memcheck "$cleave" run -q -t 2 -o "$work/run" "$@" >"$work/out" 2>"$work/err"
    is "$scene: exit status" $? 0
    holds "$scene: $(grep '^==' "$work/err" | head -n 30)" sh -c '! grep -q "^==" "$1"' sh "$work/err"
    rm -rf "$work/run"
}

# few particles and few steps: everything takes 30 times as long here
tiny="-s particles.spacing=8mm -s time.step=0.8us -s duration=24us -s output.samples=4"
for way in method=adaptive method=pd method=mpm mpm.frame=reference model=ospd model=mospd coupling=handshake mpm.shape=cubic; do
    clean "plate, $way" $kalthoff $tiny -s $way
done
clean "solid" $wedge -s particles.spacing=10mm -s time.step=0.4us -s duration=4us
clean "meet" "$work/meet.yaml" -s duration=4us
clean "grow" "$work/grow.yaml" -s duration=6us
clean "list" "$work/list.yaml" -s duration=2us
each_scene "relaxed|spin|bar_return" clean
finish
