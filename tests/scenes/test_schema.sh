#!/bin/sh
# The schema for editors: every shipped scene must refer to it and conform to it; it must reject typical typing errors.
test_name=schema
. tests/support/summary.sh

line='# yaml-language-server: $schema=../build/cleave.schema.json'
for scene in inputs/*.yaml; do
    is "$scene: its first line" "$(head -n 1 "$scene")" "$line"
done
"$cleave" help --schema >"$work/schema.json" || fail "no schema"

for python in python3 /usr/bin/python3 none; do $python -c "import jsonschema, yaml" 2>/dev/null && break; done
[ $python != none ] || { echo "jsonschema and yaml of Python are missing: only first lines tested"; exit 77; }

cat >"$work/judge.py" <<'END'
import glob, json, sys
import jsonschema, yaml

schema = json.load(open(sys.argv[1]))
jsonschema.Draft7Validator.check_schema(schema)
judge = jsonschema.Draft7Validator(schema)
wrong = 0

def expect(name, scene, accepted):
    global wrong
    faults = [f for f in judge.iter_errors(scene)]
    if accepted == (not faults): return
    wrong += 1
    print(name, "is refused: " + faults[0].message[:200] if faults else "is accepted")

for path in sorted(glob.glob("inputs/*.yaml") + sys.argv[2:]):
    expect(path, yaml.safe_load(open(path)), True)

good = """
variables: {a: 3 mm, n: 4}
space: plane stress
thickness: a
duration: 2*a/(3 km/s)
method: mpm
material: {young: 190 GPa, density: 7800, critical_stretch: inf}
body: {box: {from: [0, 0], to: [a, "max(a, 2 mm)"]}}
particles: {spacing: a/n, seed: 2*n}
parts: [{region: {box: {from: [0, 0], to: [a, 1 mm]}}, material: glass}]
mpm: {levels: 2}
boundary:
  - {fixed: [x], region: {half-space: {point: [0, 0], normal: [1, 0]}}}
  - {velocity: [1 m/s, free], time: {ramp: {until: 1 us}}}
output: {frames: 3, compress: true}
probes: [tip, point: {at: [0, 0]}, energy:]
"""
mistakes = ["duration:|duraton:", "plane stress|plain stress", "method: mpm|method: fem", "young|yuong", "7800|-7800", "190 GPa|[1]",
            "spacing|spacin", "box|bix", "from:|form:", "to: [a|too: [a", "[0, 0], to|[], to", "levels: 2|levels: 9", "ramp|rampp",
            "until|untill", "normal: [1, 0]|normall: [1, 0]", "frames: 3|frames: -1", "frames: 3|frames: 3.5", "true|maybe", "tip|tips",
            "point: {at|point: {att", "probes: [|probes: {a: ", "fixed: [x]|fixd: [x]", "space: plane stress|", "variables: {a: 3 mm|variables: {a: {}",
            "seed: 2*n|seed: -1", ", normal: [1, 0]|", "a/n|\"a/n!\"", "material: glass|stuff: glass"]
expect("the good scene", yaml.safe_load(good), True)
expect("a scene with an include alone", {"include": "base.yaml"}, True)
expect("an include that takes keys away", {"include": ["a", "b"], "cracks": None, "material": {"toughness": None}}, True)
expect("an include of nothing", {"include": {"a": 1}}, False)
for mistake in mistakes:
    old, new = mistake.split("|")
    assert good.count(old), old
    try: expect(mistake, yaml.safe_load(good.replace(old, new, 1)), False)
    except yaml.YAMLError: pass
sys.exit(wrong > 0)
END
holds "scenes and mistakes" "$python" "$work/judge.py" "$work/schema.json"
finish
