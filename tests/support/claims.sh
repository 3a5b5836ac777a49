# What test_claims.sh and long_claims.sh share: figures of bench/claims.csv that runs of scenes and benches give now.
# Sourced after summary.sh, whose functions it uses.
claims=$root/bench/claims.csv
compare() { awk -v results="$1" -v fresh="$2" -v tables="${3:-}" -f "$root/tests/support/claims.awk" "$claims"; }

# scene_of WORDS: the scene that a command names; `NAME.yaml` without a folder is the one that README.md prints, which is written here.
scene_of()
{
    case $1 in
        */*) echo "$root/$1" ;;
        *) awk -v name="$1" 'index($0, "`" name "`") { near = 1 } near && /^```$/ { exit } on { print } near && /^```yaml/ { on = 1 }' \
               "$root/README.md" >"$work/$1"
           echo "$work/$1" ;;
    esac
}

# measure WHEN: runs each scene of the rows of this kind once, and compares what its summary has with value and tolerance.
measure()
{
    awk -F, -v when="$1" 'NR > 1 && $4 == when && $5 ~ /^cleave run / && !($5 in seen) { seen[$5] = 1; print $5 }' "$claims" >"$work/commands"
    run=0
    while read -r command; do
        run=$((run + 1))
        set -- $command
        scene=$(scene_of "$3")
        shift 3
        "$cleave" run "$scene" "$@" -o "$work/claim$run" -q >"$work/log" 2>&1 </dev/null || fail "$command: $(tail -n 1 "$work/log")"
        awk -F, -v command="$command" 'NR > 1 && $5 == command { print $2 "," $3 "," $6 "," $1 }' "$claims" | sort -u >"$work/rows"
        while IFS=, read -r value tolerance source figure; do
            key=${source%% *} formula=
            [ "$key" = "$source" ] || formula=${source#* }
            apart "$figure ($command)" "$(compute "($(figure "$work/claim$run" "$key")) $formula")" "$value" "$tolerance"
        done <"$work/rows"
        rm -rf "$work/claim$run"
    done <"$work/commands"
}
