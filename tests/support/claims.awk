# Compares bench/claims.csv with documents and with kept results of benches. Prints a line for each figure that differs and, at the end, the
# number of comparisons; fails if a figure differs.
#   results  folder of the printed results of benches
#   fresh    1: these results were measured now: only rows of `long` are compared, each within its own tolerance
#   tables   documents whose tables must be in claims.csv number by number, between blanks: DOCUMENT, or DOCUMENT=SECTION with _ for blanks
#
# A row: figure, value, tolerance, when, command, source, document, place. No field holds a comma.
#   when     quick: measured by test_claims.sh; long: by long_claims.sh; kept: compared with the kept results alone
#   source   of `cleave run`: a path in summary.json, and a formula that follows it after a blank; of `cleave bench`: a regular expression
#            for one line of what the bench prints, with single blanks; `FILE.txt: ` before it names another of the kept results; `-`: not
#            compared
#   place    a regular expression for the text of the document, its lines joined by blanks; `SECTION > ` before it looks below one heading
# In both expressions # stands for the number and @ for any number.
BEGIN { FS = ","; number = "[-+]?[0-9]+([.][0-9]+)?([eE][-+]?[0-9]+)?" }

function bad(text) { print text; failures++ }

# Reads a document: page[name] and the text below each heading, section[name, heading].
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

# Finds the number that # stands for in `place`: "" and a message in `fault` unless it is there exactly once.
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

# Half of the last digit that a number is written with.
function half_digit(value,    digits, exponent)
{
    digits = value
    exponent = 0
    if (match(digits, /[eE]/)) { exponent = substr(digits, RSTART + 1); digits = substr(digits, 1, RSTART - 1) }
    return 0.501 * 10 ^ (exponent - (match(digits, /[.]/) ? length(digits) - RSTART : 0))
}

function apart(a, b) { return a - b > 0 ? a - b : b - a }

# The line of a bench's printed results that `source` matches; benches with = in their name have files with _.
function printed(command, source,    name, words, line, found, value)
{
    split(command, words, " ")
    name = words[3]
    sub(/=/, "_", name)
    name = name ~ /^accuracy_/ ? results "/../accuracy/cost_accuracy.csv" : results "/" name ".txt"
    if (match(source, /^[a-z_]+[.]txt: /)) {
        name = results "/" substr(source, 1, RLENGTH - 2)
        source = substr(source, RLENGTH + 1)
    }
    found = ""
    while ((getline line <name) > 0) {
        if (line ~ /^#/) continue
        gsub(/ +/, " ", line)
        value = find(line, source)
        if (value == "") continue
        if (found != "" && found != value) { close(name); fault = "more than one line matches: " source; return "" }
        found = value
    }
    close(name)
    fault = found == "" ? name " has no such line: " source : ""
    return found
}

# A place in a document, with its section if one is named.
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
fresh && $4 != "long" { next }
$5 ~ /^cleave bench / && $6 != "-" {
    value = printed($5, $6)
    if (fault != "") bad($1 ": " fault)
    else if (apart(value, $2) > (fresh ? $3 : half_digit($2)))
        bad($1 ": " $2 ", but " (fresh ? "measured now: " : "kept results have ") value " (" $5 ")")
    count++
}
!fresh && $7 != "-" {
    value = stated($7, $8)
    if (fault != "") bad($7 ": " $1 ": " fault)
    else if (apart(value, $2) > 1e-9 * ($2 < 0 ? -$2 : $2)) bad($7 ": " $1 ": " value ", but bench/claims.csv has " $2)
    claimed[$7, value + 0]++
    count++
}

# Every number in the tables of a document, but for first columns and columns of limits, references, sizes and commands, is claimed.
function cells(name, only,    k, n, cell, head, heads, j, rest, value)
{
    if (!loaded[name]) load(name)
    for (k = 1; k <= lines[name]; k++) {
        if (text[name, k] !~ /^\|/) { heads = 0; continue }
        n = split(text[name, k], cell, "|")
        if (!heads) { heads = n; for (j = 1; j <= n; j++) head[j] = cell[j]; continue }
        if (cell[2] ~ /^ ?-+ ?$/ || (only != "" && title_of[name, k] != only)) continue
        for (j = 3; j < n; j++) {
            if (head[j] ~ /limit|expected|theory|source|command|minutes|across|contents|answer|Zeng/ || head[j] ~ /^ *(reference|layers|ν) *$/) continue
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
