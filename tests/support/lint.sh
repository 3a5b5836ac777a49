#!/bin/sh
# lint.sh FILES: searches C files for faults without running them (`make lint`), by cppcheck for all files together and clang-tidy 14 for
# each one with the checks of .clang-tidy. Prints what they report; exit status 1 if they report anything.
# Three checks of cppcheck are switched off. uninitvar regards arrays of fixed length as unset that a loop fills (the compiler and valgrind
# detect real cases); arrayIndexOutOfBoundsCond regards a test of one bound as one of both; compareBoolExpressionWithInt reports loops to
# `dim > 1`, which are intended.
set -u
for tool in cppcheck clang-tidy-14; do
    command -v $tool >/dev/null || { echo "$tool is missing: apt-get install cppcheck clang-tidy-14" >&2; exit 1; }
done
export BUILD="${BUILD:-build}" LIBFLAGS="${LIBFLAGS:-}"
found=$(mktemp)
trap 'rm -f "$found"' EXIT
jobs=${JOBS:-$(getconf _NPROCESSORS_ONLN)}

cppcheck --std=c11 --enable=warning,performance,portability --inline-suppr --quiet -j "$jobs" --template='{file}:{line}: {message} [{id}]' \
    --suppress=uninitvar --suppress=arrayIndexOutOfBoundsCond \
    --suppress=compareBoolExpressionWithInt -I. -Iinclude -I"$BUILD" -D__x86_64__ -D_XOPEN_SOURCE=700 -D_DEFAULT_SOURCE \
    '-DCLEAVE_VERSION=""' '-DSIMD_SET="portable"' "$@" 2>>"$found"

# Kernels alone are compiled for a set of vector instructions.
tidy='for file; do
    case $file in kernels/*) set_of=-DSIMD_SET=\"portable\" ;; *) set_of= ;; esac
    clang-tidy-14 --quiet "$file" -- -std=c11 -fopenmp -I. -Iinclude -I"$BUILD" -D_XOPEN_SOURCE=700 -D_DEFAULT_SOURCE "-DCLEAVE_VERSION=\"\"" $set_of $LIBFLAGS
done 2>/dev/null'
printf '%s\n' "$@" | xargs -P "$jobs" -n 4 sh -c "$tidy" tidy | grep -E '(warning|error): ' | sed "s|^$PWD/||" | sort -u >>"$found"

cat "$found"
[ ! -s "$found" ] || { echo "lint: $(wc -l <"$found") findings"; exit 1; }
echo "lint: nothing found"
