# Figures of bench/claims.csv that runs of scenes and benches give now, for test_claims.sh, long_claims.sh and tests that run such scenes.
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

# each FILE FORMULA: prints a formula for every line of a table, with names of its columns in brackets; ` if CONDITION` behind it selects
# lines. A name alone needs no brackets.
each()
{
    awk -F, -v formula="$2" '
        NR == 1 {
            if (formula !~ /\[| if /) formula = "[" formula "]"
            for (k = 1; k <= NF; k++) {
                sub(/ \[.*/, "", $k)
                while ((at = index(formula, "[" $k "]"))) formula = substr(formula, 1, at - 1) "$" k substr(formula, at + length($k) + 2)
            }
            condition = 1
            if ((at = index(formula, " if "))) { condition = substr(formula, at + 4); formula = substr(formula, 1, at - 1) }
            print "NR > 1 && (" condition ") { print " formula " }"
            exit
        }' "$1" >"$work/each.awk"
    awk -F, -v OFMT=%.12g -f "$work/each.awk" "$1"
}

# count FILE CONDITION: the number of lines of a table for which a condition holds.
count() { each "$1" "1 if $2" | wc -l | tr -d ' '; }

# over FOLDER WHAT FORMULA: the `largest`, `smallest`, `first`, `last` or `mean` value of a formula over the lines of history.csv.
over()
{
    each "$1/history.csv" "$3" | awk -v OFMT=%.12g -v what="$2" '
        { sum += $1 }
        value == "" || what == "last" || (what == "largest" && $1 - value > 0) || (what == "smallest" && $1 - value < 0) { value = $1 }
        END { print what == "mean" && NR ? sum / NR : value }'
}

# value_at RUN PATH: a figure of the run RUN1: its path in summary.json; `column NAME TIME`: a column of history.csv at the last sample not
# after a time [s]; `passes NAME VALUE`: the first time at which a column is at least a value; `largest FORMULA` and others: as in over();
# `fragments CONDITION`: lines of fragments.csv. N|PATH: of the N-th run of a command.
value_at()
{
    case $2 in
        [1-9]"|"*) folder=$1${2%%"|"*} path=${2#*"|"} ;;
        *) folder=${1}1 path=$2 ;;
    esac
    case $path in
        "column "* | "passes "*)
            set -- $path
            "$1" "$folder" "$2" "$3" ;;
        "fragments "*) count "$folder/fragments.csv" "${path#* }" ;;
        "largest "* | "smallest "* | "first "* | "last "* | "mean "*) over "$folder" "${path%% *}" "${path#* }" ;;
        *) figure "$folder" "$path" ;;
    esac
}

# value_of RUN SOURCE: the figure that a source gives of a run: a path, with a formula behind it after a blank; or a formula with paths in
# braces.
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
        found=$(value_at "$1" "$path")
        formula="${formula%%"{"*}(${found:-missing})${formula#*"}"}"
    done
    case $formula in *missing* | *null*) ;; *) compute "$formula" ;; esac
}

# runs TO COMMAND: runs its scenes, `cleave run SCENE [OPTION...]` with && between them, and leaves them in folders TO1, TO2, ...
runs()
{
    part=0
    rest="$2 && "
    while [ -n "$rest" ]; do
        part=$((part + 1))
        one=${rest%%" && "*}
        rest=${rest#*" && "}
        to=$1$part
        eval "set -- '$1' x $one"
        base=$1
        scene=$(scene_of "$5")
        shift 5
        "$cleave" run "$scene" "$@" -o "$to" -q >"$work/log" 2>&1 </dev/null || fail "$command: $(tail -n 1 "$work/log")"
        set -- "$base"
    done
}

# formulas: compares rows whose source is a formula with it.
formulas()
{
    awk -F, '$6 ~ /^formula: / { print $2 "," $3 "," substr($6, 10) "," $1 }' "$claims" >"$work/rows"
    while IFS=, read -r value tolerance formula figure; do apart "$figure" "$(compute "$formula")" "$value" "$tolerance"; done <"$work/rows"
}

# Rows of the table that a run of a scene gives: not those of files, publications, formulas, or without a source.
of_runs='$5 ~ /^cleave run / && $6 !~ /^([A-Za-z0-9_.\/]+[.][a-z]+: |paper: |formula: |-$)/'

# compare_rows WHEN COMMAND RUN: compares what RUN1, RUN2, ... give with value and tolerance of the rows of this kind and command.
compare_rows()
{
    awk -F, -v when="$1" -v command="$2" '$4 == when && $5 == command && '"$of_runs"' { print $2 "," $3 "," $6 "," $1 }' "$claims" |
        sort -u >"$work/rows"
    holds "$2 has rows" test -s "$work/rows"
    while IFS=, read -r value tolerance source figure; do
        measured=$(value_of "$3" "$source")
        case $tolerance in
            "<") between "$figure ($2)" "$measured" -1e99 "$value" ;;
            ">") between "$figure ($2)" "$measured" "$value" 1e99 ;;
            *) apart "$figure ($2)" "$measured" "$value" "$tolerance" ;;
        esac
    done <"$work/rows"
}

# claimed FOLDER COMMAND: compares the quick rows of a command with a run of it that a test has made for other reasons; test_claims.sh leaves
# such commands out. The command is written out in quotes, as in the table.
claimed()
{
    ln -s "$work/$1" "$work/claimed1"
    compare_rows quick "$2" "$work/claimed"
    rm "$work/claimed1"
}

# measure WHEN: runs each command of the rows of this kind once, and compares what its runs give with value and tolerance.
measure()
{
    awk -F, -v when="$1" 'NR > 1 && $4 == when && '"$of_runs"' && !($5 in seen) { seen[$5] = 1; print $5 }' "$claims" >"$work/commands"
    grep -rhE '^ *claimed [^ ]+ "' "$root/tests" --include='test_*.sh' | sed 's/^[^"]*"//; s/"[^"]*$//' >"$work/elsewhere"
    while read -r command; do
        [ "$1" != quick ] || ! grep -qxF "$command" "$work/elsewhere" || continue
        runs "$work/claim" "$command"
        compare_rows "$1" "$command" "$work/claim"
        rm -rf "$work"/claim[1-9]
    done <"$work/commands"
}
