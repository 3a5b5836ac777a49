#!/bin/sh
# Runs the fuzzer on all targets, 40 seconds each or as given by the argument; `make fuzz FUZZ_SECONDS=3600`. SEED repeats a run.
test_name=long_fuzz
seconds=${1:-40} build=${BUILD:-build} seed=${SEED:-$(date +%s)}
program=$(pwd)/$build/fuzz/fuzz inputs=$(pwd)/inputs failures=0
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' INT TERM HUP
echo 'void __sanitizer_cov_trace_pc(void) {}' >"$work/trace.c"
echo 'int main(void) { return 0; }' >"$work/none.c"
${CC:-cc} -c -o "$work/trace.o" "$work/trace.c" && ${CC:-cc} -fsanitize=address,undefined -fsanitize-coverage=trace-pc -o "$work/none" \
    "$work/none.c" "$work/trace.o" 2>"$work/said" && "$work/none" ||
    { echo "the compiler has no sanitizers or traces no branches"; exit 77; }
${MAKE:-make} -s -j"$(getconf _NPROCESSORS_ONLN)" BUILD="$build" ${CC:+CC="$CC"} "$build/fuzz/fuzz" >/dev/null || exit 1

# Words of scenes, from the table of keys; refused scenes, from the tests.
"$build/cleave" help | awk '/^[a-z_]/ { n = split($1, part, "."); for (k = 1; k <= n; k++) print part[k] ": "; print $1 "=" }
    /^[a-z_.]+ +word;/ { sub(/^[^;]*; /, ""); sub(/;.*/, ""); n = split($0, part, ", "); for (k = 1; k <= n; k++) print part[k] }' >"$work/words"
printf '%s\n' nan inf -inf 1e308 1e-308 1/0 2147483648 ' mm' ' GPa' ' us' '[0, 0]' '{' '}' '[' ']' '- ' '&a' '*a' '<<: ' '!!' '---' x,y,volume ,material ,body >>"$work/words"
sort -u -o "$work/words" "$work/words"
awk -F'|' '/^[0-9]+\|.*\|[0-9]+:[0-9]+\|/ { gsub(/\^/, "\n", $2); print $2 > (out "/bad" NR) ; close(out "/bad" NR) }' out="$work" tests/robustness/test_refusals.sh
printf '1x,y,volume\n0.5e-3,0.5e-3,1e-8\n1.5e-3,0.5e-3,1e-8\n' >"$work/list.csv"
printf 'material.young=1 GPa\nparticles.spacing=2 mm\nboundary[0].velocity=[1, 2]\nmethod=pd\n' >"$work/keys"
# An input found by fuzzing: the grid grows at the last step, and with it the arrays of loads.
printf '\155\143\160\141\142\047\163\163\142\157\165\156\144\141\162\160\162\157\142\145\163\056\154\151\000\145' >"$work/grown"

# fuzz TARGET FILE...: runs the fuzzer on a target, with these files as first inputs. Returns 1 if it found a fault; the input is then kept
# in the folder fuzz of the build.
fuzz()
{
    target=$1 leaks=1; shift
    [ "$target" != checkpoint ] || leaks=0       # HDF5 does not free all memory after reading a damaged file
    mkdir -p "$work/$target"
    (cd "$work/$target" && OMP_NUM_THREADS=1 ASAN_OPTIONS=allocator_may_return_null=1:exitcode=99:detect_leaks=$leaks UBSAN_OPTIONS=print_stacktrace=1 \
        "$program" "$target" "$seconds" "$seed" "$work/words" "$@") >"$work/$target.said" 2>&1
    result=$?
    if [ $result -eq 0 ]; then tail -n 1 "$work/$target.said"; return; fi
    # A checksum that matches damaged data is a forgery: the library may crash on it, and the program reports that in one line
    # (src/base/crash_message.c).
    if grep -E '^ +#[0-3] ' "$work/$target.said" | grep -q libhdf5; then echo "$target: HDF5 crashed, seed $seed"; return; fi
    cp "$work/$target/$target.input" "$build/fuzz/$target.$seed"
    echo "$test_name: $target, status $result, input kept as $build/fuzz/$target.$seed:"
    grep -v '^warning: ' "$work/$target.said" | head -n 40
    return 1
}

echo "seed $seed"
fuzz scene "$inputs"/*.yaml "$work"/bad* & first=$!
fuzz override "$work/keys" & second=$!
wait $first || failures=1
wait $second || failures=1
fuzz checkpoint & first=$!
fuzz valid "$work/grown" & second=$!
wait $first || failures=1
wait $second || failures=1
fuzz list "$work/list.csv" & first=$!
fuzz exodus & second=$!
wait $first || failures=1
wait $second || failures=1
exit $failures
