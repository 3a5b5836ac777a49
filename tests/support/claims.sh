# Compares the figures of bench/claims.csv, numbers that documents state, with those that scenes and benches yield when they are run; for
# test_claims.sh, long_claims.sh and tests that run such scenes anyway. Sourced after summary.sh, whose functions it uses.
claims=$root/bench/claims.csv
compare() { awk -v results="$1" -v fresh="$2" -v tables="${3:-}" -f "$root/tests/support/claims.awk" "$claims"; }

# scene_of NAME: prints the path of the scene that a command names. A name without a folder is that of a scene printed in README.md below a
# line with `NAME`, or in a page of the manual below `# NAME`, which is written to a file.
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

# each FILE FORMULA: prints the value of a formula for every line of a CSV table. The formula contains names of columns in brackets; a
# condition after ` if ` selects lines. A single name needs no brackets.
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

# count FILE CONDITION: prints the number of lines of a table for which the condition is true.
count() { each "$1" "1 if $2" | wc -l | tr -d ' '; }

# over FOLDER WHAT FORMULA: prints the `largest`, `smallest`, `first`, `last` or `mean` value of a formula over the lines of history.csv.
over()
{
    each "$1/history.csv" "$3" | awk -v OFMT=%.12g -v what="$2" '
        { sum += $1 }
        value == "" || what == "last" || (what == "largest" && $1 - value > 0) || (what == "smallest" && $1 - value < 0) { value = $1 }
        END { print what == "mean" && NR ? sum / NR : value }'
}

# value_at RUN PATH: prints a figure of the run in the folder RUN1; N|PATH: in the folder RUNN. PATH: a path in summary.json; `column NAME
# TIME`: a column of history.csv at the last sample not after TIME [s]; `passes NAME VALUE`: the first time at which a column is at least
# VALUE; `largest FORMULA` and the like, as in over(); `fragments CONDITION`: the number of such lines of fragments.csv.
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

# value_of RUN SOURCE: prints the figure that SOURCE describes of the runs RUN1, RUN2, ...: a path of value_at() followed by a formula after
# a blank, or a formula with paths in braces; nothing if a path is missing.
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

# runs TO COMMAND: runs the scenes of a command, `cleave run SCENE [OPTION...]` joined by &&, into the folders TO1, TO2, ...
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

# formulas: checks the value of each row whose source is a formula against this formula.
formulas()
{
    awk -F, '$6 ~ /^formula: / { print $2 "," $3 "," substr($6, 10) "," $1 }' "$claims" >"$work/rows"
    while IFS=, read -r value tolerance formula figure; do apart "$figure" "$(compute "$formula")" "$value" "$tolerance"; done <"$work/rows"
}

# Rows of the table that a run of a scene gives: not those of files, publications, formulas, or without a source.
of_runs='$5 ~ /^cleave run / && $6 !~ /^([A-Za-z0-9_.\/]+[.][a-z]+: |paper: |formula: |-$)/'

# compare_rows WHEN COMMAND RUN: checks the rows of this kind and command: their values against the figures of the runs RUN1, RUN2, ...,
# within the tolerances of the rows.
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

# claimed FOLDER COMMAND: checks the `quick` rows of a command with a run of it that the calling test has made anyway; test_claims.sh leaves
# such commands out. The command must be in double quotes, as in the table, since test_claims.sh searches for it.
claimed()
{
    ln -s "$work/$1" "$work/claimed1"
    compare_rows quick "$2" "$work/claimed"
    rm "$work/claimed1"
}

# measure WHEN: runs each command of the rows of this kind once and checks the figures of its runs with compare_rows().
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
