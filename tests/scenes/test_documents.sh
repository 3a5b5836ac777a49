#!/bin/sh
# README and manual: lengths of pages, links and their anchors, the page of all keys, keys that other pages name, and scenes that a reader
# would copy.
# Takes 20 s: it checks each scene of the manual and computes two equilibria.
test_name=documents
. tests/support/summary.sh
. tests/support/scenes.sh

pages="README.md $(ls inputs/*.md | tr '\n' ' ')"

# ---- pages -----------------------------------------------------------------------------------------------------------

for page in $pages; do
    case $page in
        README.md) most=1300 ;;
        inputs/keys.md) continue ;;
        *) most=1500 ;;
    esac
    words=$(wc -w <"$page")
    holds "$page: $words words, $most at the most" test "$words" -le $most
done

# anchors PAGE: prints the anchors of the headings of a page: lower case, blanks as hyphens, without other punctuation.
anchors() { sed -n 's/^#\{1,\} //p' "$1" | tr 'A-Z' 'a-z' | sed 's/[^a-z0-9 _-]//g; s/ /-/g'; }
for page in $pages .github/CONTRIBUTING.md .github/SECURITY.md CHANGELOG.md; do
    { grep -o '](\([^)]*\))' "$page" | sed 's/^](//; s/)$//'; grep -o 'src="[^"]*"' "$page" | sed 's/src="//; s/"$//'; } | grep -v '^https:' | sort -u |
        while read -r link; do
            file=${link%%#*} anchor=${link#*#}
            to=$page; [ -z "$file" ] || to=$(dirname "$page")/$file
            if [ ! -e "$to" ]; then echo "$page: $link: no such file"
            elif [ "$anchor" != "$link" ]; then anchors "$to" | grep -qx "$anchor" || echo "$page: $link: no such heading"; fi
        done
done >"$work/links"
is "links that lead nowhere" "$(cat "$work/links")" ""
for page in $(ls inputs/*.md); do
    [ "$page" = inputs/README.md ] || holds "inputs/README.md names $page" grep -q "(${page#inputs/})" inputs/README.md
done

# ---- keys ------------------------------------------------------------------------------------------------------------

"$cleave" help --reference >"$work/keys.md"
holds "inputs/keys.md is that of the program: build/cleave help --reference > inputs/keys.md" cmp -s "$work/keys.md" inputs/keys.md

# Keys with a dot in code of the pages, `particles.spacing` or `time.safety: 0.8`, whose first part is a key.
sed -n 's/^| `\([a-z_.]*\)` .*/\1/p' inputs/keys.md | sort -u >"$work/keys"
grep -oh '`[a-z_]*\.[a-z_.]*[`:=]' $pages | tr -d '`:=' | sort -u | while read -r key; do
    grep -qx "${key%%.*}" "$work/keys" || continue
    case $key in *.md | *.yaml | *.csv | *.py | *.png | crack.* | conversion.first_time | energy.*) continue ;; esac
    grep -qx "$key" "$work/keys" || echo "$key"
done >"$work/unknown"
is "keys of the manual that are none" "$(cat "$work/unknown")" ""

# Every option of a command is described below its usage.
for command in run check plot report compare sweep converge export bench help; do
    "$cleave" help $command >"$work/page" 2>/dev/null || "$cleave" $command --help >"$work/page"
    for option in $(head -n 1 "$work/page" | grep -o -e '--[a-z-]*' | sort -u); do
        holds "help $command describes $option" grep -q -e "^  $option" "$work/page"
    done
done

# ---- scenes ----------------------------------------------------------------------------------------------------------

# blocks PAGE: writes each block of YAML of a page to a file of its own, and prints their names.
blocks() { awk -v to="$work/block" '/^```yaml$/ { on = 1; file = to "." (++n) ".yaml"; printf "" >file; print file; next } /^```$/ { on = 0 } on { print >file }' "$1"; }
cp inputs/*.stl inputs/*.inp inputs/*.png "$work/"
for page in $pages; do
    rm -f "$work"/block.*
    for block in $(blocks "$page"); do
        grep -q '^space:' "$block" && grep -q '^duration:' "$block" || continue
        holds "$page: $(head -n 1 "$block"): is sound" sh -c '"$0" check --no-trial "$1" 2>/dev/null | grep -q "is sound\\|can be run"' "$cleave" "$block"
    done
done

# inputs/elasticity.md: E of its strip in plane stress, error in %; by the page -0.11 with bonds, -0.4 with ospd at a ratio of 0.3.
sed -n '/^# elastic.yaml/,/^```$/p' inputs/elasticity.md | sed '$d' >"$work/elastic.yaml"
modulus_error() { awk -v right="$(figure "$1" probes.right.displacement_x)" -v left="$(figure "$1" probes.left.displacement_x)" \
    'BEGIN { print 100 * (70e6 / ((right - left) / 0.041) / 70e9 - 1) }'; }
"$cleave" run "$work/elastic.yaml" -s output.frames=1 -q -o "$work/bonds" >"$work/said" 2>&1 || fail "elastic.yaml: $(cat "$work/said")"
between "E of bonds" "$(modulus_error "$work/bonds")" -0.16 -0.06
"$cleave" run "$work/elastic.yaml" -s model=ospd -s variables.nu=0.3 -s solver=relaxation -s solver_tolerance=1e-5 -q -o "$work/ospd" >"$work/said" 2>&1 ||
    fail "elastic.yaml, ospd: $(cat "$work/said")"
between "E of ospd" "$(modulus_error "$work/ospd")" -0.45 -0.30

# inputs/results.md: its calls of h5copy make a frame that needs no other file.
if command -v h5copy >"$work/said"; then
    grep '^h5copy ' inputs/results.md >"$work/copy.sh"
    is "calls of h5copy in inputs/results.md" "$(wc -l <"$work/copy.sh")" 2
    (cd "$work/bonds" && sh -e ../copy.sh) >"$work/said" 2>&1 || fail "h5copy: $(cat "$work/said")"
    for name in frames alone; do
        file=$work/bonds/$name.hdf
        [ $name = alone ] || file=$work/bonds/frames/000001.hdf
        h5ls -r "$file" | grep -c . >"$work/entries.$name"
        h5ls -r "$file" | grep -c 'External Link' >"$work/links.$name"
    done
    is "entries of a frame and of its copy" "$(cat "$work/entries.alone")" "$(cat "$work/entries.frames")"
    holds "a frame has links" test "$(cat "$work/links.frames")" -gt 5
    is "links of its copy" "$(cat "$work/links.alone")" 0
fi

# The V-notch of inputs/bodies.md: its root is 8 mm above the lower face; particles of 0.1 mm in the column beside the middle.
sed -n '/^# a V-notched bar/,/^```$/p' inputs/bodies.md | sed '$d' >"$work/notch.yaml"
cat >>"$work/notch.yaml" <<'END'
  - intersect: {box: {from: [0, 0], to: [0.1 mm, 9 mm]}}
space: plane stress
thickness: 1 mm
duration: 1 ns
method: mpm
material: {young: 70 GPa, density: 2700}
particles: {spacing: 0.1 mm}
output: {frames: 0, samples: 1}
END
"$cleave" run "$work/notch.yaml" -q -o "$work/notch" >"$work/said" 2>&1 || fail "the V-notch: $(cat "$work/said")"
is "particles below the root of the V-notch" "$(figure "$work/notch" particles)" 80
finish
