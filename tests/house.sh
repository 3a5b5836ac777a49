#!/bin/sh
# Checks the rules of src/README.md that a machine can check. Files of a room (a folder of the program, such as src/grid with include/grid)
# include and call only files of lower rooms; lines, functions and files keep their limits; names of functions are unique; files that
# comments and src/README.md name exist.
test_name=house
. tests/support/summary.sh

sources=$(find src include kernels bench tests -name '*.[ch]' | sort)
program=$(find src include kernels bench -name '*.[ch]' | sort)

# Rooms from the lowest to the highest; rooms on one line may use each other in this order.
rooms="base data bonds kernels simd loads output geometry scene run grid mesh rigid contact coupling fracture solver probes step quasistatic engine export plot study report bench app"

# nothing WHAT: the check WHAT passes if the file $found is empty, else it fails and prints the file.
found=$work/found
nothing()
{
    if [ -s "$found" ]; then fail "$1: $(wc -l <"$found")
$(head -n 20 "$found")"; else pass; fi
}

# ---- rooms -----------------------------------------------------------------------------------------------------------

# Room of a path: the folder below src and include, else the top folder.
room_of='function room_of(path, part, n) { n = split(path, part, "/"); return part[1] == "src" || part[1] == "include" ? part[2] : part[1] }
         function floors(list, k, n, name) { n = split(list, name, " "); for (k = 1; k <= n; k++) floor[name[k]] = k }'

# Includes of headers in higher rooms, as the path from the top; headers of the own room are included without a path.
grep -H '^#include "' $program | awk -v rooms="$rooms" "$room_of"'
    BEGIN { floors(rooms) }
    { split($0, half, ":#include \""); path = half[2]; sub(/".*/, "", path)
      if (path !~ /\//) next
      if (path !~ /^(src|kernels|bench|tests)\//) path = "include/" path
      from = room_of(half[1]); to = room_of(path)
      if (!(from in floor) || !(to in floor)) print half[1] ": no such room: " path
      else if (floor[to] > floor[from]) print half[1] " includes " path }' >"$found"
nothing "includes that lead up"

# Calls of functions in higher rooms, by the symbols of the objects.
build=${BUILD:-build}
for set in portable avx2 avx512; do [ ! -e "$build/kernels/kernels.$set.o" ] || break; done # SETS of make may lack some
objects=$(find src bench -name '*.c' | sed "s|^|$build/|; s|c$|o|"; find kernels -name '*.c' | sed "s|^|$build/|; s|c$|$set.o|")
nm -A -P $objects >"$work/symbols"
awk -v rooms="$rooms" -v build="$build/" "$room_of"'
    BEGIN { floors(rooms) }
    { file = $1; sub(/:$/, "", file); file = substr(file, length(build) + 1)
      if ($3 ~ /^[TDBRC]$/) place[$2] = file
      else if ($3 == "U") used[$2] = used[$2] " " file }
    END { for (name in used) if (name in place) { n = split(used[name], user, " ")
              for (k = 1; k <= n; k++) if (floor[room_of(place[name])] > floor[room_of(user[k])])
                  print user[k] " calls " name " of " place[name] } }' "$work/symbols" | sort >"$found"
nothing "calls that lead up"

# A header in src/ROOM is included only by files of that room, and one included without a path is beside the including file.
grep -H '^#include "' $program | awk '
    { split($0, half, ":#include \""); file = half[1]; path = half[2]; sub(/".*/, "", path)
      folder = file; sub(/\/[^\/]*$/, "", folder)
      if (path !~ /\//) { if (folder ~ /^src/ && (getline line < (folder "/" path)) < 0 && path !~ /^(parts|new_scenes|new_part|commit|report_page)\.h$/) print file " includes " path ", which is not there"
                         close(folder "/" path) }
      else if (path ~ /^src\// && index(path, folder "/") != 1) print file " includes " path }' >"$found"
nothing "private headers of other rooms"
grep -nE '^#[ \t]+include|^#include +<(src|include|kernels|bench|[a-z]+/[a-z_]+_part\.h)' $program >"$found"
nothing "includes of headers of the project in another form than #include \"\""

# The struct of a run, and the part of a run in a room, are used only in files whose names say so; kernels and rooms below the scene do not
# use struct run (include/run/run.h).
grep -l '\bstruct run\b' $program | awk "$room_of"'
    BEGIN { n = split("base data bonds kernels simd loads output geometry scene", low, " "); for (k = 1; k <= n; k++) below[low[k]] = 1
            n = split("grid mesh rigid contact coupling fracture solver probes", mid, " "); for (k = 1; k <= n; k++) part[mid[k]] = 1 }
    { room = room_of($1) }
    room in below { print $1 " knows struct run" }
    room in part && $1 !~ /_(part|make|step|choice|check|motion|warn|points)\.[ch]$/ { print $1 " knows struct run: a name that ends in _part, _make, _step, _choice, _check, _motion, _warn or _points is expected" }' >"$found"
nothing "files that know a run and do not say so"

# Rows of the table of parts are defined in their rooms and used only by the table.
grep -nE '\bpart_[a-z]+\b' $program | grep -E 'extern|const struct part part_|&part_' | grep -v '^src/engine/parts.c' |
    grep -vE '^src/[a-z]+/[a-z_]+_part\.c:[0-9]+:const struct part part_' >"$found"
for row in $(sed -n 's/^const struct part \(part_[a-z_]*\) =.*/\1/p' src/*/*_part.c); do grep -q "&$row\b" src/engine/parts.c || echo "$row is in no table"; done >>"$found"
nothing "rows of the table of parts outside rooms and table"

# Members of stored bonds (include/bonds/bond_storage.h) are used only in src/bonds and kernels/pd.
grep -nE "\\b(b|bonds|old)(->|\.)(nbr|inverse_length|common|stencil|column|column_count|first|implicit|changed|shell_length|made|aligned)\\b" \
    $(find src -name '*.[ch]' ! -path 'src/bonds/*') | grep -E "(b->|bonds(->|\.)|old->)(nbr|inverse_length|common|stencil|column|column_count|first|implicit|changed|shell_length|made|aligned)(\[|\)|;|,| )" >"$found"
nothing "storage of bonds used outside its room"

# Energies whose names have no other meaning are named only in their table (include/run/ledger.h).
grep -nE '"(damped|absorbed|external_work)"' $(echo "$program" | grep -vxE 'include/run/ledger\.h|src/run/ledger\.c') >"$found"
nothing "energies named outside the ledger"

# A violated invariant prints one line for a user: INVARIANT of include/base/base.h, not assert of C.
grep -nE '\bassert *(\(|\.h)' $program >"$found"
nothing "assert in place of INVARIANT"

# Each room has a public header that states its purpose.
for room in $rooms; do
    [ -d "include/$room" ] || continue
    grep -q "^/\* Room \`$room\`" include/$room/*.h || echo "include/$room: no header begins with: Room \`$room\`"
done >"$found"
nothing "rooms that do not say what they are for"

# Counted arrays may be empty and have no memory, which functions of the C library do not allow (include/base/arrays.h).
grep -nE "\\bqsort\(|\\bmem(cpy|move|set|cmp)\(.*(, |\* )\(size_t\)[^,]*\)" $(echo "$program" | grep -v '/base/') >"$found"
nothing "arrays that are copied, filled, compared or sorted without array_copy, array_fill_bytes, arrays_equal or array_sort"

# ---- circles, and what is seen ---------------------------------------------------------------------------------------

# Circles of files that call each other, by the symbols of the objects: only these, of these sizes.
circles="scene/scene_value 7, scene/scene_override 2, contact/contact 7, data/solid 4, scene/scene_echo 4, app/help 4, mesh/mesh 3,
    geometry/image 3, app/check_advice 3, plot/plot_curves 3, data/hull 2,
    geometry/elements_body 2, mesh/levels 2, scene/fill 2, step/report 2"
grep -v "/bench/" "$work/symbols" | awk -v build="$build/" -v known="$circles" '
    { file = $1; sub(/:$/, "", file); file = substr(file, length(build) + 1); sub(/^src\//, "", file); sub(/\.o$/, "", file)
      if ($3 ~ /^[TDBRC]$/) place[$2] = file
      else if ($3 == "U") used[$2] = used[$2] " " file }
    END { n = split(known, list, /,[ \n]*/)
          for (k = 1; k <= n; k++) { split(list[k], one, " "); allowed[one[1]] = one[2] }
          for (name in used) if (name in place) { m = split(used[name], user, " ")
              for (k = 1; k <= m; k++) if (user[k] != place[name]) { calls[user[k], place[name]] = 1; file_[user[k]] = 1; file_[place[name]] = 1; edge[user[k]] = edge[user[k]] " " place[name] } }
          for (from in file_) { delete seen; top = 1; stack[1] = from
              while (top > 0) { f = stack[top--]; m = split(edge[f], next_, " ")
                  for (k = 1; k <= m; k++) if (!(next_[k] in seen)) { seen[next_[k]] = 1; stack[++top] = next_[k] } }
              for (to in seen) reach[from, to] = 1 }
          for (a in file_) if (!(a in done)) { size = 1; members = a; most = 1
              for (b in file_) if (b != a && ((a, b) in reach) && ((b, a) in reach)) { size++; members = members " " b; done[b] = 1 }
              m = split(members, member, " ")
              for (k = 1; k <= m; k++) if (member[k] in allowed) { most = allowed[member[k]]; delete allowed[member[k]] }
              if (size > most) print size " files in a circle: " members
              else if (size < most) print "a circle of " size " files, listed as of " most ": " members }
          for (name in allowed) print "listed as a circle, and is none: " name }' >"$found"
nothing "circles of files that are new, have grown, or are smaller than listed"

# Number of functions with the whole run as argument in the rooms from `run` to `engine`, and of pairs of a file there and a part whose
# members it can see (by included headers): both may only decrease.
most_whole=225 most_seen=170
parts="grid/grid_part mesh/mesh_part rigid/rigid_part contact/contact coupling/coupling_part fracture/fracture_part probes/probes_part
    probes/diagnostics step/report step/stability step/damping quasistatic/statics solver/solver"
rooms_of_run=$(for room in run grid mesh rigid contact coupling fracture solver probes step quasistatic engine; do ls src/$room/*.c; done)
whole=$(cat $rooms_of_run $(echo "$rooms_of_run" | sed 's|/[^/]*$|/*.h|' | sort -u) $(echo "$rooms_of_run" | sed 's|^src|include|; s|/[^/]*$|/*.h|' | sort -u) 2>/dev/null | awk '/^[a-z].*\(/ { head = "" } /^[a-z]/, /\{|;/ { head = head " " $0 } /^\{|\) \{/ { if (head ~ /struct run( const)? *\*|struct run( const)? [a-z_]+\[/) n++; head = "" } END { print n + 0 }')
seen=$(grep -l 'struct run' $rooms_of_run | sed "s|^|$build/|; s|c$|d|" | xargs awk -v list="$parts" '
    BEGIN { n = split(list, part, /[ \n]+/) }
    { for (k = 1; k <= n; k++) if (part[k] != "" && index($0, "include/" part[k] ".h")) seen[FILENAME, k] = 1 }
    END { for (pair in seen) pairs++; print pairs + 0 }')
echo "house: $whole functions take the whole run, $seen pairs of file and part"
holds "functions that take the whole run: $whole, $most_whole at the most" test "$whole" -le $most_whole
holds "pairs of a file and a part that it sees: $seen, $most_seen at the most" test "$seen" -le $most_seen

# ---- size ------------------------------------------------------------------------------------------------------------

width=$(sed -n 's/^ColumnLimit: *//p' .clang-format)
holds "a width in .clang-format" test "${width:-0}" -ge 80
awk -v width="$width" 'length($0) > width { print FILENAME ":" FNR ": " length($0) " characters" }' $sources $(find src tests -name '*.js') >"$found"
nothing "lines over $width characters"
wc -l $sources | awk '$2 != "total" && $1 > 525 { print $2 ": " $1 " lines" }' >"$found"
nothing "files over 525 lines"

# Other versions of clang-format lay out some lines differently.
if command -v clang-format-14 >/dev/null 2>&1; then
    echo "$sources" | xargs clang-format-14 --dry-run 2>&1 | grep 'warning:' | cut -d: -f1 | sort | uniq -c >"$found"
    nothing "files that clang-format 14 lays out in another way"
else
    echo "house: no clang-format-14, the layout of files is not checked"
fi

# Functions begin in the first column, and their closing brace is there too.
awk 'FNR == 1 { start = 0 }
    /^[a-zA-Z].*\)[^;]*$/ && !/^(typedef|struct|enum|union)[^(]*[{;]/ { candidate = FNR }
    /^\{/ { start = candidate ? candidate : FNR }
    /^\}/ { if (start && FNR - start > 60) print FILENAME ":" start ": a function of " FNR - start " lines"; start = 0; candidate = 0 }' $program >"$found"
nothing "functions over 60 lines"

# ---- names -----------------------------------------------------------------------------------------------------------

# Functions of the program defined in more than one file.
awk 'FNR == 1 { name = "" }
    /^[a-zA-Z_].*\(/ && !/^(typedef|return|else|if|for|while|switch)/ && !/;[ \t]*(\/\*.*)?$/ && !/^[A-Z_0-9]+\(/ {
        head = $0; sub(/\(.*/, "", head); n = split(head, word, /[ *]+/); name = word[n]
        if (n > 1 && (FILENAME !~ /h$/ || $0 ~ /^static/) && name ~ /^[a-z_][a-z0-9_]*$/ && !((name, FILENAME) in seen)) { seen[name, FILENAME] = 1; files[name] = files[name] " " FILENAME; count[name]++ }
    }
    END { for (name in count) if (count[name] > 1) print name ":" files[name] }' $(echo "$program" | grep -v '^include/') | sort >"$found"
nothing "names of functions in several files"

# Files named in comments.
find . -path ./.git -prune -o -path './build*' -prune -o -type f -print | sed 's/.*\///' | sort -u >"$work/files"
awk 'function look(text) { while (match(text, /[A-Za-z0-9_]+\.(c|h|sh)([^A-Za-z0-9_]|$)/)) {
        name = substr(text, RSTART, RLENGTH); sub(/[^A-Za-z0-9_]$/, "", name); print name, FILENAME; text = substr(text, RSTART + RLENGTH) } }
    { rest = $0
      while (rest != "") {
          if (inside) { k = index(rest, "*/"); look(k ? substr(rest, 1, k - 1) : rest); rest = k ? substr(rest, k + 2) : ""; inside = !k; continue }
          k = index(rest, "/*"); if (!k) break
          rest = substr(rest, k + 2); inside = 1 } }' $sources | sort -u |
    awk 'NR == FNR { known[$0] = 1; next } !($1 in known) { print $2 ": " $1 }' "$work/files" - >"$found"
nothing "comments that name no file"

# Names that src/README.md sets as code: a word with underscores is an identifier or the stem of a file, X.c or X.sh is a file.
grep -o '`[^`]*`' src/README.md >"$work/set_as_code"
grep -oE '\b[a-z][a-z0-9]*(_[a-z0-9]+)+\b' "$work/set_as_code" | sort -u >"$work/words"
{ grep -ohwF -f "$work/words" -r $sources tests inputs Makefile; sed 's/\.[a-z]*$//' "$work/files"; } | sort -u | comm -23 "$work/words" - >"$found"
grep -oE '\b[a-z][a-z0-9_]*\.(c|h|sh|txt|js|html|css)\b' "$work/set_as_code" | sort -u | comm -23 - "$work/files" >>"$found"
nothing "names in src/README.md that the program does not have"

finish
