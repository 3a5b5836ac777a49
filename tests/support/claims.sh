# What test_claims.sh and long_claims.sh share: figures of bench/claims.csv that runs of scenes and benches give now.
# Sourced after summary.sh, whose functions it uses.
claims=$root/bench/claims.csv
compare() { awk -v results="$1" -v fresh="$2" -v tables="${3:-}" -f "$root/tests/support/claims.awk" "$claims"; }

# scene_of NAME: the scene that a command names. A name without a folder is that of a scene printed in README.md below a line with `NAME`,
# or in a page of the manual below `# NAME`: it is written to a file of its own.
scene_of()
{
    case $1 in
        */*) echo "$root/$1"; return ;;
    esac
    awk -v name="$1" 'FNR == 1 { on = near = 0 } found { exit } index($0, "`" name "`") { near = 1 }
        /^```$/ && on { found = 1; exit }
        fresh { fresh = 0; on = near || $0 == "# " name; near = 0 }
        on { print }
        /^```yaml/ { fresh = 1 }' "$root/README.md" "$root"/inputs/*.md >"$work/$1"
    echo "$work/$1"
}

# value_of RUN SOURCE: the figure that a source gives of a run: a path in its summary, with a formula behind it after a blank; or a formula
# with paths in braces.
value_of()
{
    formula=$2
    case $formula in
        *"{"*) ;;
        *" "*) formula="{${formula%% *}} ${formula#* }" ;;
        *) formula="{$formula}" ;;
    esac
    while :; do
        case $formula in *"{"*) ;; *) break ;; esac
        path=${formula#*"{"}
        path=${path%%"}"*}
        found=$(figure "$1" "$path")
        formula="${formula%%"{"*}(${found:-missing})${formula#*"}"}"
    done
    case $formula in *missing* | *null*) ;; *) compute "$formula" ;; esac
}

# measure WHEN: runs each scene of the rows of this kind once, and compares what its summary has with value and tolerance.
measure()
{
    awk -F, -v when="$1" 'NR > 1 && $4 == when && $5 ~ /^cleave run / && !($5 in seen) { seen[$5] = 1; print $5 }' "$claims" >"$work/commands"
    run=0
    while read -r command; do
        run=$((run + 1))
        eval "set -- $command"
        scene=$(scene_of "$3")
        shift 3
        "$cleave" run "$scene" "$@" -o "$work/claim$run" -q >"$work/log" 2>&1 </dev/null || fail "$command: $(tail -n 1 "$work/log")"
        awk -F, -v command="$command" 'NR > 1 && $5 == command && $6 != "-" { print $2 "," $3 "," $6 "," $1 }' "$claims" | sort -u >"$work/rows"
        while IFS=, read -r value tolerance source figure; do
            apart "$figure ($command)" "$(value_of "$work/claim$run" "$source")" "$value" "$tolerance"
        done <"$work/rows"
        rm -rf "$work/claim$run"
    done <"$work/commands"
}
