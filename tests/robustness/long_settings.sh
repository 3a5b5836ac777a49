#!/bin/sh
# Bitwise equality under every setting of threads, allocator, locale, limits and environment.
test_name=long_settings
[ ! -w /dev/shm ] || export TMPDIR=/dev/shm       # in memory, to avoid waiting for a disk
. tests/support/summary.sh
. tests/support/trust.sh

# German and Turkish locales, created here unless the machine has them.
for place in de_DE tr_TR; do
    mkdir -p "$work/locales"
    localedef -i $place -f UTF-8 "$work/locales/$place.UTF-8" 2>/dev/null || echo "no locale $place: not tested"
done

# under SETTING... -- ARGUMENT...: checks that a run with these environment variables (words of env) has results bitwise equal to those in
# $work/one.
under()
{
    setting=
    while [ "$1" != -- ]; do setting="$setting $1"; shift; done
    shift
    rm -rf "$work/many"
    env $setting "$cleave" run -q -o "$work/many" "$@" >"$work/out" 2>"$work/err" || { fail "$setting: $(cat "$work/err")"; return; }
    same "$setting, $*" "$work/one" "$work/many"
}

small="-s output.frames=3 -s output.samples=30"
for arguments in "$line $small" "$flat -s particles.spacing=3mm $small" "$flat -s particles.spacing=3mm -s mpm.frame=reference -s mpm.transfer=flip $small" \
    "$flat -s particles.spacing=3mm -s model=mospd $small" "$flat -s particles.spacing=3mm -s coupling=pgg $small" \
    "inputs/bar_return.yaml -s particles.spacing=2mm $small" "inputs/plate_impact_3d.yaml -s particles.spacing=2mm -s duration=60us $small"; do
    rm -rf "$work/one"; calm "$work/one" $arguments -t 1
    for schedule in dynamic,1 guided static,1 dynamic,7; do under OMP_SCHEDULE=$schedule -- $arguments -t 3; done
    under OMP_PROC_BIND=true OMP_PLACES=cores OMP_NUM_THREADS=2 -- $arguments
    under OMP_PROC_BIND=spread OMP_PLACES=threads OMP_NUM_THREADS=3 -- $arguments
    under OMP_MAX_ACTIVE_LEVELS=4 OMP_NUM_THREADS=3,2 -- $arguments
    under OMP_DYNAMIC=true OMP_NUM_THREADS=5 -- $arguments
    under OMP_THREAD_LIMIT=2 OMP_NUM_THREADS=5 -- $arguments
    under OMP_WAIT_POLICY=active OMP_NUM_THREADS=2 -- $arguments
    under OMP_STACKSIZE=64k -- $arguments -t 3
    under MALLOC_PERTURB_=165 MALLOC_ARENA_MAX=1 -- $arguments -t 2
    under GLIBC_TUNABLES=glibc.malloc.tcache_count=0:glibc.malloc.mmap_threshold=4096 -- $arguments -t 3
    for place in de_DE tr_TR; do under LOCPATH="$work/locales" LC_ALL=$place.UTF-8 LANG=$place.UTF-8 -- $arguments -t 2; done
    under TZ=Pacific/Kiritimati -- $arguments -t 2
    under -i PATH="$PATH" -- $arguments -t 2
    (ulimit -s 256 && under A=stack_of_256_kB -- $arguments -t 3; [ $failures -eq 0 ]) || fail "a stack of 256 kB"
    (ulimit -n 24 && under A=24_descriptors -- $arguments -t 2; [ $failures -eq 0 ]) || fail "24 descriptors"
done

finish
