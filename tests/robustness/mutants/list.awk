# Reads a list of faults for run.sh: one per line, `file @ old @ new @ tests`; blank lines and lines after # are ignored. Prints a line for
# every fault that cannot be used, e.g. because its old text does not occur exactly once in the file or a test does not exist.
# Environment: TESTS: paths of all tests, one per line; JOBS: a folder in which each fault is stored as a folder JOBS/0001/ with the files
# file, place (file:line), old, new, tests (paths) and, if the fault cannot be used, wrong; if JOBS is empty, nothing is stored.

BEGIN {
    n = split(ENVIRON["TESTS"], path, "\n")
    for (k = 1; k <= n; k++) {
        name = path[k]; sub(/.*\//, "", name); sub(/\.c$/, "", name)
        known[name] = known[path[k]] = path[k]
        if (name ~ /\.sh$/) { sub(/\.sh$/, "", name); script[name] = path[k] }
    }
    jobs = ENVIRON["JOBS"]
}

function trim(text) { sub(/^[ \t]+/, "", text); sub(/[ \t]+$/, "", text); return text }

# Returns the contents of a file as one text; reads each file once.
function text_of(file, all, line) {
    if (!(file in text)) {
        all = ""
        while ((getline line < file) > 0) all = all line "\n"
        close(file)
        text[file] = all
    }
    return text[file]
}

# Returns the number of occurrences of `old` in the text `all`; sets `row` to the line number of the first.
function places(all, old, count, at, before) {
    count = 0
    while ((at = index(all, old)) > 0) {
        if (++count == 1) { before = substr(all, 1, at); row = gsub(/\n/, "", before) + 1 }
        all = substr(all, at + length(old))
    }
    return count
}

# Returns the reason why a fault cannot be used, or nothing; sets `paths` to the paths of its tests, one per line.
function wrong(fields, file, old, new, tests, count, n, k, name) {
    if (fields != 4) return fields " fields where `file @ old @ new @ tests` has 4"
    if (text_of(file) == "") return "no such file"
    if (old == "" || old == new) return "the new text is the old one"
    count = places(text[file], old)
    if (count != 1) return count ? "text occurs " count " times" : "text not found"
    n = split(tests, name, /[ \t]+/)
    for (k = 1; k <= n; k++) {
        sub(/^\.\//, "", name[k]); if (name[k] !~ /\//) sub(/\.c$/, "", name[k])
        if (name[k] in known) paths = paths known[name[k]] "\n"
        else if (name[k] in script) paths = paths script[name[k]] "\n"
        else return "no such test: " name[k]
    }
    if (n == 0) return "no test is named"
}

/^[ \t]*(#|$)/ { next }

{
    n = split($0, field, / @ /)
    for (k = 1; k <= n; k++) field[k] = trim(field[k])
    row = 0; paths = ""
    says = wrong(n, field[1], field[2], field[3], field[4])
    if (says != "") print FILENAME ":" FNR ": " field[1] ": " says ": " field[2]
    if (jobs == "") next
    job = sprintf("%s/%04d", jobs, ++number)
    system("mkdir -p '" job "'")
    printf "%s\n", field[1] > (job "/file"); printf "%s%s\n", field[1], row ? ":" row : "" > (job "/place")
    printf "%s\n", field[2] > (job "/old"); printf "%s\n", field[3] > (job "/new"); printf "%s", paths > (job "/tests")
    if (says != "") printf "%s\n", says > (job "/wrong")
    close(job "/file"); close(job "/place"); close(job "/old"); close(job "/new"); close(job "/tests"); close(job "/wrong")
}
