#!/bin/sh
# Runs test programs and scripts one after the other; prints a line for each, the output of those that fail, and a count.
# A script that cannot run here exits 77 after a line that says why: SKIPPED.
# Threads that wait must not starve the others of a busy machine: rounds of gcc's library, milliseconds of clang's.
export GOMP_SPINCOUNT=2000 KMP_BLOCKTIME=1
passed=0 failed=0 skipped=0
log=$(mktemp)
for test in "$@"; do
    start=$(date +%s)
    case $test in
        *.sh) sh "$test" >"$log" 2>&1 ;;
        *) "$test" >"$log" 2>&1 ;;
    esac
    result=$?
    seconds=$(($(date +%s) - start))
    name=$(basename "$test")
    if [ $result = 0 ]; then
        passed=$((passed + 1)); echo "ok       $name (${seconds} s)"
    elif [ $result = 77 ]; then
        skipped=$((skipped + 1)); echo "SKIPPED  $name: $(tail -n 1 "$log")"
    else
        failed=$((failed + 1)); echo "FAILED   $name (${seconds} s, status $result)"; cat "$log"
    fi
done
rm -f "$log"
echo "$passed passed, $failed failed, $skipped skipped"
[ $failed = 0 ]
