# Compares bench/claims.csv with documents and with kept results of benches. Prints a line for each figure that differs and, at the end, the
# number of comparisons; fails if a figure differs.
#   results  folder of the printed results of benches
#   fresh    1: these results were measured now: only rows of `long` are compared, each within its own tolerance
#   tables   documents whose tables must be in claims.csv number by number, between blanks: DOCUMENT, or DOCUMENT=SECTION with _ for blanks
#
# A row has the fields figure, value, tolerance, when, command, source, document, place, none of which contains a comma.
#   tolerance  a number; or <: the measured figure is at most the value; or >: it is at least the value
#   when     quick: measured by test_claims.sh or by a test that runs the scene anyway (`claimed` in claims.sh); long: measured by
#            long_claims.sh; kept: compared with files alone
#   source   where the figure is found, one of
#            PATH, PATH FORMULA or a formula with {PATH}: paths in summary.json of `cleave run` (value_of in claims.sh has more)
#            EXPRESSION: matches one line of the printed results of `cleave bench`, with single blanks
#            test_NAME: EXPRESSION: matches one line of the figures that this script of tests/ measures (between, apart and near in summary.sh)
#            FILE: EXPRESSION: matches one line of a file, given by its path in the checkout or its name in bench/results/, such as a table,
#            a bound in a test, a key of a scene, a constant of a source; ` times FACTOR` and ` plus NUMBER` behind it change the unit;
#            `count WITHIN: ` before it counts the lines whose number is at most WITHIN
#            paper: AUTHORS YEAR: a figure of a publication, listed in inputs/references.md
#            formula: FORMULA: a closed form that needs no run
#   place    a regular expression for the text of the document, whose lines are joined by blanks; `SECTION > ` before it limits the search
#            to the text below one heading
# In expressions # stands for the number and @ for any number.
BEGIN { FS = ","; number = "[-+]?[0-9]+([.][0-9]+)?([eE][-+]?[0-9]+)?" }

function bad(text) { print text; failures++ }

# Reads a document into page[name] and the text below each of its headings into section[name, heading].
function load(name,    line, title, fenced)
{
    loaded[name] = 1
    page[name] = ""
    while ((getline line <name) > 0) {
        if (name ~ /[.]yaml$/) sub(/^# /, "", line)
        if (line ~ /^```/) fenced = !fenced
        if (line ~ /^#+ / && !fenced) { title = line; sub(/^#+ /, "", title); gsub(/,/, "", title) }
        sub(/^ +/, "", line)
        gsub(/ +/, " ", line)
        page[name] = page[name] line " "
        section[name, title] = section[name, title] line " "
        lines[name]++
        text[name, lines[name]] = line
        title_of[name, lines[name]] = title
    }
    close(name)
    if (page[name] == "") bad(name ": no such document")
}

# Finds in `place` the number at the position of #. Returns "" and sets `fault` to a message unless there is exactly one.
function find(where, place,    half, n, rest, found, piece)
{
    gsub(/@/, "[-+0-9.e]+", place)
    n = split(place, half, "#")
    fault = ""
    if (n != 2) { fault = "one # is expected in: " place; return "" }
    rest = where
    found = ""
    while (match(rest, half[1] number half[2])) {
        piece = substr(rest, RSTART, RLENGTH)
        rest = substr(rest, RSTART + (RLENGTH > 0 ? RLENGTH : 1))
        if (found != "") { fault = "more than one place matches: " place; return "" }
        if (half[1] != "") { match(piece, "^" (half[1])); piece = substr(piece, RLENGTH + 1) }
        match(piece, "^" number)
        found = RLENGTH > 0 ? substr(piece, 1, RLENGTH) : "nothing"
    }
    if (found == "") fault = "not found: " place
    return found
}

# Returns half a unit of the last digit with which a number is written.
function half_digit(value,    digits, exponent)
{
    digits = value
    exponent = 0
    if (match(digits, /[eE]/)) { exponent = substr(digits, RSTART + 1); digits = substr(digits, 1, RSTART - 1) }
    return 0.501 * 10 ^ (exponent - (match(digits, /[.]/) ? length(digits) - RSTART : 0))
}

function apart(a, b) { return a - b > 0 ? a - b : b - a }

# Returns the file that a source names before its expression; "" if it names none.
function file_of(source)
{
    if (match(source, /^test_[a-z_]+: /)) return fresh ? substr(source, 1, RLENGTH - 2) ".txt" : ""
    return match(source, /^[A-Za-z0-9_.\/]+[.][a-z]+: /) ? substr(source, 1, RLENGTH - 2) : ""
}

# Returns the number in the line of a file, or of the printed results of a bench, that `source` matches. Results of benches with = in their
# name are in files with _ instead.
function printed(command, source,    name, words, line, found, value, factor, offset, within)
{
    name = file_of(source)
    if (name != "") {
        sub(/^[^:]*: /, "", source)
        if (name !~ /\//) name = results "/" name
    } else {
        split(command, words, " ")
        name = words[3]
        sub(/=/, "_", name)
        name = name ~ /^accuracy_/ ? results "/../accuracy/cost_accuracy.csv" : results "/" name ".txt"
    }
    factor = 1
    within = ""
    if (match(source, /^count [0-9.]+: /)) {
        within = substr(source, 7, RLENGTH - 8)
        source = substr(source, RLENGTH + 1)
    }
    offset = 0
    if (match(source, / plus [-0-9.e]+$/)) {
        offset = substr(source, RSTART + 6)
        source = substr(source, 1, RSTART - 1)
    }
    if (match(source, / times [-0-9.e]+$/)) {
        factor = substr(source, RSTART + 7)
        source = substr(source, 1, RSTART - 1)
    }
    found = ""
    while ((getline line <name) > 0) {
        if (line ~ /^#/ && name ~ /[.]txt$/) continue
        gsub(/ +/, " ", line)
        value = find(line, source)
        if (value == "") continue
        if (within != "") { found += apart(value, 0) <= within; continue }
        if (found != "" && found != value) { close(name); fault = "more than one line matches: " source; return "" }
        found = value
    }
    close(name)
    fault = found == "" ? name " has no such line: " source : ""
    return found == "" ? "" : found * factor + offset
}

# Returns whether `got` is within the tolerance of a row's value, or on the side of it that < or > states.
function agrees(got, value, tolerance)
{
    if (tolerance == "<") return got <= value + half_digit(value)
    if (tolerance == ">") return got >= value - half_digit(value)
    return apart(got, value) <= tolerance
}

# Returns whether a line of inputs/references.md contains all words of the publication that a source names.
function listed(what,    words, n, k, line, all)
{
    n = split(what, words, " ")
    while ((getline line <"inputs/references.md") > 0) {
        all = 1
        for (k = 1; k <= n; k++) all = all && index(line, words[k])
        if (all) break
    }
    close("inputs/references.md")
    return all
}

# Returns the text of a document in which a place is searched: the section that the place names, else the whole page.
function stated(name, place,    title, at)
{
    if (!loaded[name]) load(name)
    at = index(place, " > ")
    if (!at) return find(page[name], place)
    title = substr(place, 1, at - 1)
    if (!((name, title) in section)) { fault = "no heading " title; return "" }
    return find(section[name, title], substr(place, at + 3))
}

FNR == 1 { next }
NF != 8 { bad("line " FNR ": " NF " fields, 8 are expected"); next }
$4 !~ /^(quick|long|kept)$/ { bad("line " FNR ": quick, long or kept is expected in place of " $4); next }
$3 !~ /^([<>]|[0-9.]+(e-?[0-9]+)?)$/ { bad("line " FNR ": a number, < or > is expected in place of " $3); next }
$6 == "-" { bad($1 ": a row without a source") }
fresh && $4 != "long" { next }
$6 ~ /^paper: / {
    if (!listed(substr($6, 8))) bad($1 ": inputs/references.md has no " substr($6, 8))
    count++
}
file_of($6) != "" || ($5 ~ /^cleave bench / && $6 != "-" && $6 !~ /^(paper|formula): /) {
    value = printed($5, $6)
    if (fault != "") bad($1 ": " fault)
    else if (!agrees(value, $2, fresh || $3 ~ /[<>]/ || file_of($6) ~ /\// ? $3 : half_digit($2)))
        bad($1 ": " $2 ", but " (fresh ? "measured now: " : "kept results have ") value " (" $5 ")")
    count++
}
file_of($6) == "" && $6 !~ /^(-$|paper: |formula: )/ && $5 !~ /^cleave bench / {
    if ($4 == "kept") bad($1 ": nothing measures a source of " $5 " that is kept")
    else if ($5 !~ /^cleave run / && $6 !~ /^test_[a-z_]+: /) bad($1 ": a source of no kind: " $6)
}
!fresh && $7 != "-" {
    value = stated($7, $8)
    if (fault != "") bad($7 ": " $1 ": " fault)
    else if (apart(value, $2) > 1e-9 * ($2 < 0 ? -$2 : $2)) bad($7 ": " $1 ": " value ", but bench/claims.csv has " $2)
    claimed[$7, value + 0]++
    count++
}

# Checks that every number in the tables of a document is claimed, i.e. is in bench/claims.csv; first columns and columns of limits,
# references, sizes and commands are left out.
function cells(name, only,    k, n, cell, head, heads, j, rest, value)
{
    if (!loaded[name]) load(name)
    for (k = 1; k <= lines[name]; k++) {
        if (text[name, k] !~ /^\|/) { heads = 0; continue }
        n = split(text[name, k], cell, "|")
        if (!heads) { heads = n; for (j = 1; j <= n; j++) head[j] = cell[j]; continue }
        if (cell[2] ~ /^ ?-+ ?$/ || (only != "" && title_of[name, k] != only)) continue
        for (j = 3; j < n; j++) {
            if (head[j] ~ /limit|spacings|expected|theory|source|command|minutes|across|contents|answer|Zeng/ || head[j] ~ /^ *(reference|layers|ν) *$/) continue
            rest = cell[j]
            gsub(/\([A-Z][^)]*[12][0-9][0-9][0-9]\)/, "", rest)
            while (match(rest, /[0-9]-[0-9]/)) rest = substr(rest, 1, RSTART) " " substr(rest, RSTART + 2)
            while (match(rest, number)) {
                value = substr(rest, RSTART, RLENGTH)
                rest = substr(rest, RSTART + RLENGTH)
                if (!((name, value + 0) in claimed))
                    bad(name ": bench/claims.csv has no figure " value " of the row" substr(text[name, k], 2, 60))
                count++
            }
        }
    }
}

END {
    documents = fresh ? 0 : split(tables, document, " ")
    for (d = 1; d <= documents; d++) {
        name = only = document[d]
        sub(/=.*/, "", name)
        sub(/^[^=]*=?/, "", only)
        gsub(/_/, " ", only)
        cells(name, only)
    }
    print count + 0 " comparisons"
    exit failures > 0
}
