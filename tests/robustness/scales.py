"""Scales all quantities of a scene, and tells how far a history is from the scaled history of another run.

scales.py scene FROM TO < KEYS   writes the scene TO: that of the file FROM with lengths times 16, times 64 and masses a
                                 quarter; KEYS: what `cleave help --reference` prints, for the units of the keys
scales.py compare A B            prints the largest difference of the history of the folder B from that of A, scaled, in
                                 values of its column, and its place
"""
import csv
import json
import math
import re
import sys

import yaml

# Powers of two by which units are multiplied: results then have the same digits in binary.
POWERS = {"m": 4, "s": 6, "kg": -2, "Pa": -18, "J": -6, "N": -10}
# Columns of tables that are named by words.
WORDS = {"time": "s", "stress": "Pa", "strain rate": "1/s"}


def factor(unit):
    """Returns the factor by which a value with a unit such as `J/m^2` is multiplied; 1 without a unit."""
    power, sign = 0.0, 1
    for slash, name, exponent in re.findall(r"(/?)\s*\(?([A-Za-z]+)(?:\^\(?([-\d./]+)\)?)?", unit or ""):
        sign = -1 if slash else 1
        top, _, bottom = (exponent or "1").partition("/")
        power += sign * POWERS.get(name, 0) * float(top) / float(bottom or 1)
    return 2.0 ** power


def units_of_keys(reference):
    """Returns the units of all keys by their paths, from the tables of the reference of keys."""
    units = {}
    for row in re.finditer(r"^\| `([\w. ]+)` \| ([^|]*)\|", reference, re.M):
        unit = re.search(r"\[([^\]]*)\]", row[2])
        units[row[1]] = unit and unit[1]
    return units


def unit_of(path, units):
    """Returns the unit of the value at a path of names and indices: that of the longest known end of the path."""
    names = [word for word in path if isinstance(word, str)]
    for k in range(len(names)):
        if ".".join(names[k:]) in units:
            unit = units[".".join(names[k:])] or ""
            break
    else:
        unit = "m" if names[-1] in ("from", "to", "step") else \
            next((u for key, u in units.items() if u and key.split(".")[-1] == names[-1]), "")
    columns = unit.split(", ")
    return WORDS.get(columns[path[-1]], "") if len(columns) > 1 and isinstance(path[-1], int) else unit


def scaled(node, path, units):
    """Returns a node of a scene with all numbers scaled by their units."""
    if isinstance(node, dict):
        return {key: scaled(value, path + [key], units) for key, value in node.items()}
    if isinstance(node, list):
        return [scaled(value, path + [k], units) for k, value in enumerate(node)]
    if isinstance(node, bool) or not isinstance(node, (int, float)):
        return node
    by = factor(unit_of(path, units))
    return node if by == 1 else node * by


def text_of(node):
    """Returns a node as text of a scene on one line."""
    if isinstance(node, dict):
        return "{" + ", ".join(f"{key}: {text_of(value)}" for key, value in node.items()) + "}"
    if isinstance(node, list):
        return "[" + ", ".join(map(text_of, node)) + "]"
    if isinstance(node, bool):
        return "true" if node else "false"
    if isinstance(node, str):
        return json.dumps(node) if re.search(r"[^\w. +/-]", node) else node
    return "" if node is None else repr(node)


def write_scaled_scene(source, target):
    units = units_of_keys(sys.stdin.read())
    yaml.SafeLoader.add_implicit_resolver("tag:yaml.org,2002:float",
                                          re.compile(r"^[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?$"), list("-+.0123456789"))
    with open(source, encoding="utf-8") as file:
        scene = scaled(yaml.safe_load(file), [], units)
    with open(target, "w", encoding="utf-8") as file:
        file.writelines(f"{key}: {text_of(value)}\n" for key, value in scene.items())


def history(folder):
    with open(folder + "/history.csv", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    return rows[0], [[float(word) for word in row] for row in rows[1:]]


def compare(a, b):
    names, rows = history(a)
    others, scaled_rows = history(b)
    if names != others or len(rows) != len(scaled_rows):
        return print("9 other columns or lines")
    worst = (0.0, "none")
    for k, name in enumerate(names):
        unit = re.search(r"\[(.*)\]", name)
        by = factor(unit and unit[1])
        largest = max((abs(row[k]) for row in rows if math.isfinite(row[k])), default=0) * by
        if "error" in name or "momentum" in name or largest == 0:
            continue  # round-off
        for line, (row, other) in enumerate(zip(rows, scaled_rows)):
            if not (math.isnan(row[k]) and math.isnan(other[k])):
                off = abs(row[k] * by - other[k]) / largest
                worst = max(worst, (9.0 if math.isnan(off) else off, f"{name}, line {line}"))
    return print(*worst)


if sys.argv[1] == "scene":
    write_scaled_scene(sys.argv[2], sys.argv[3])
else:
    compare(sys.argv[2], sys.argv[3])
