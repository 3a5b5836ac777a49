#!/bin/sh
# Pages of `cleave report` in browsers without a network: Chromium opens them, moves the slider and changes fields. Screenshots of
# Chromium, and of Firefox if it is installed, must show the crack at its position.
test_name=long_report
. tests/support/summary.sh
. tests/support/browser.sh
[ -n "$browser" ] || { echo "no Chromium is there: pages are not opened"; exit 77; }
command -v python3 >/dev/null || { echo "python3 is missing: pages not tested"; exit 77; }

cat >"$work/plate.yaml" <<'END'
name: plate
space: plane stress
thickness: 2 mm
duration: 16 us
method: pd
material: {name: glass, young: 72 GPa, poisson: 1/3, density: 2440 kg/m^3, energy_release_rate: 3 J/m^2}
body: [box: {from: [0, 0], to: [40 mm, 20 mm]}]
particles: {spacing: 0.4 mm}
cracks: [{from: [0, 10 mm], to: [15 mm, 10 mm]}]
boundary: [{traction: [0, 8 MPa], face: y+}, {traction: [0, -8 MPa], face: y-}]
output: {frames: 8}
END
"$cleave" run "$work/plate.yaml" -o "$work/plate" -q --report 2>/dev/null
"$cleave" run inputs/sphere_on_plate_3d.yaml -o "$work/solid" -q --report 2>/dev/null
"$cleave" run inputs/bar_pulse.yaml -o "$work/bar" -q --report 2>/dev/null
"$cleave" sweep "$work/plate.yaml" -s particles.spacing=2mm,1mm -s thickness=1mm,2mm -o "$work/sweep" -q 2>/dev/null
"$cleave" report "$work/sweep" -q

for name in plate solid bar sweep; do
    seen $name
    says $name "s['problems'] == []"
done
# Damage is drawn from grey (226, 228, 231) to dark red: red exceeds green on the crack alone.
says plate "s['frames'] == 9 and s['shown_at_first'] == 8 and s['played_to'] == 8"
says plate "'frame 0' in s['when_first'] and s['tags'] == 0"
says plate "s['crack_last'][0] - s['crack_last'][1] > 60 and s['whole_last'] == [226, 228, 231]"
says plate "s['ahead_first'] == [226, 228, 231] and s['ahead_last'][0] - s['ahead_last'][1] > 60"
says plate "s['pre_crack'] < 150"       # a line without gaps, on grey 226
says plate "s['field'] == 'von_mises' and max(s['crack_von_mises']) < 40 and s['whole_von_mises'] != [226, 228, 231]"
says plate "0.98 < s['painted_again'] / s['painted'] < 1.02 and s['column_added']"     # another field covers the same pixels, but for words on them
says solid "s['field'] == 'von_mises' and s['turned'] and 0.05 * s['painted_turned'] < s['painted_cut'] < 0.9 * s['painted_turned']"
says bar "s['column_added']"
says sweep "s['rows'] == 4 and s['columns'] > 6"

# The table of a convergence study says the spacing of its values, that of the finest level.
"$cleave" converge "$work/plate.yaml" -s particles.spacing=2mm --runs 1 --levels 3 -o "$work/levels" -q >/dev/null 2>&1
"$cleave" report "$work/levels" -q
finest=$(awk -F, 'NR == 1 { for (k = 1; k <= NF; k++) at[$k] = k; next } NR == 2 { printf "%.3g", 1e3 * $at["spacing_0 [m]"] }' "$work/levels/converge.csv")
chrome --dump-dom "file://$work/levels/report.html" >"$work/dom"
holds "a spacing of $finest mm is said" grep -q "value at a spacing of $finest[0-9]* mm" "$work/dom"

# A screenshot of the page as it is, at its first and last frame: the crack is red from x = 0 to 15 mm, then farther.
cat >"$work/pixels.py" <<'END'
import struct, sys, zlib
raw, width, height, rows = open(sys.argv[1], "rb").read(), 0, 0, b""
at = 8
while at < len(raw):
    length, kind = struct.unpack(">I4s", raw[at:at + 8])
    if kind == b"IHDR":
        width, height, depth, colour = struct.unpack(">IIBB", raw[at + 8:at + 18])
    if kind == b"IDAT":
        rows += raw[at + 8:at + 8 + length]
    at += length + 12
data, bpp, image, last = zlib.decompress(rows), 4 if colour == 6 else 3, [], None
for y in range(height):
    kind, line = data[y * (width * bpp + 1)], bytearray(data[y * (width * bpp + 1) + 1:(y + 1) * (width * bpp + 1)])
    for k in range(len(line)):
        a = line[k - bpp] if k >= bpp else 0
        b = last[k] if last else 0
        c = last[k - bpp] if last and k >= bpp else 0
        p = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))[2]
        line[k] = line[k] + (0, a, b, (a + b) // 2, p)[kind] & 255
    image.append(line)
    last = line
# The body is as wide as the longest row of the grey of damage 0; the crack is red: from where to where, as shares of that width.
runs = [(0, 0, 0)]
for y in range(height):
    start = None
    for x in range(width + 1):
        grey = x < width and tuple(image[y][x * bpp:x * bpp + 3]) == (226, 228, 231)
        if grey and start is None:
            start = x
        if not grey and start is not None:
            runs.append((x - start, start, x))
            start = None
left, right = max(runs)[1:]
red = [(x - left) / (right - left) for y in range(height) for x in range(left, right) if image[y][x * bpp] - image[y][x * bpp + 1] > 80 and image[y][x * bpp + 2] < 110]
print("%.3f %.3f" % (min(red), max(red)))
END
for frame in 0 8; do
    chrome --screenshot="$work/shot$frame.png" "file://$work/plate/report.html#frame=$frame" >/dev/null
    python3 "$work/pixels.py" "$work/shot$frame.png" >"$work/red$frame" 2>&1
done
# The pre-crack ends at 15 of 40 mm; bonds across it reach a horizon, 1.2 mm, beyond, less those that are damaged too little to be red.
between "screenshot: the crack begins at the edge" "$(cut -d' ' -f1 "$work/red0")" 0 0.02
between "screenshot: and ends at its tip" "$(cut -d' ' -f2 "$work/red0")" 0.36 0.41
between "screenshot: at the end it has grown" "$(cut -d' ' -f2 "$work/red8")" 0.6 1

# Firefox, where it is there, shows the same crack.
browser=
for name in firefox-esr firefox; do [ -n "$browser" ] || browser=$(command -v $name || true); done
for frame in 0 8; do
    [ -n "$browser" ] || break
    mkdir -p "$work/fox"
    HOME=$work/fox timeout 300 "$browser" --headless --no-remote --profile "$work/fox" --window-size=1200,1500 --screenshot "$work/fox$frame.png" \
        "file://$work/plate/report.html#frame=$frame" >/dev/null 2>&1
    python3 "$work/pixels.py" "$work/fox$frame.png" >"$work/fox$frame" 2>&1
done
if [ -n "$browser" ]; then
    between "Firefox: the crack begins at the edge" "$(cut -d' ' -f1 "$work/fox0")" 0 0.02
    between "Firefox: and ends at its tip" "$(cut -d' ' -f2 "$work/fox0")" 0.36 0.41
    between "Firefox: at the end it has grown" "$(cut -d' ' -f2 "$work/fox8")" 0.6 1
fi

finish
