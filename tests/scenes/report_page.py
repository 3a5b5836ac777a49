"""Checks a page of `cleave report`: report_page.py PAGE [FOLDER]. Every array must have the length that its reference states, every array
must have a reference, texts must contain no markup, and nothing may be loaded from elsewhere. With FOLDER, the run of the page, particles,
fields and history must be those of its files, to the precision that the page states. Prints each fault, and at the end what was compared."""
import base64, csv, json, re, sys

SIZE = {"u8": 1, "u16": 2, "i16": 2, "f32": 4, "png": 1, "svg": 1}
wrong = []


def check(holds, what):
    if not holds:
        wrong.append(what)


text = open(sys.argv[1], encoding="utf-8").read()
elements = dict((int(k), v) for k, v in re.findall(r'<script type="text/plain" id="array(\d+)">([^<]*)</script>', text))
page = json.loads(re.search(r'<script type="application/json" id="page">(.*?)</script>', text, re.S).group(1))
references = []


def collect(at):
    if isinstance(at, dict):
        references.append(at) if "array" in at and "type" in at else [collect(v) for v in at.values()]
    elif isinstance(at, list):
        for v in at:
            collect(v)


collect(page)
bytes_of = {}
for r in references:
    raw = base64.b64decode(elements.get(r["array"], "!"), validate=True)
    bytes_of[r["array"]] = raw
    check(len(raw) == r["length"] * SIZE[r["type"]], "array %d has %d bytes, its reference says %d %s" % (r["array"], len(raw), r["length"], r["type"]))
    check(r["type"] != "svg" or b"<svg" in raw, "array %d is no picture" % r["array"])
    check(r["type"] != "png" or raw[:8] == b"\x89PNG\r\n\x1a\n", "array %d is no picture" % r["array"])
check(sorted(elements) == sorted(r["array"] for r in references), "arrays without reference, or with two")
check(text.count("<script") == len(elements) + 2 == text.count("</script>"), "other scripts than data, JSON and code")
check(not re.search(r'(src|href)="(?!data:)|url\(|@import|fetch\(|https?://|XMLHttp|WebSocket', re.sub(r'<script type="application/json".*?</script>', "", text, flags=re.S)), "something is fetched")
check(text.startswith("<!doctype html>\n<!-- page of cleave report -->\n") and text.rstrip().endswith("</html>"), "begin or end")


def values(reference):
    import array
    a = array.array({"u8": "B", "u16": "H", "i16": "h", "f32": "f"}[reference["type"]])
    a.frombytes(bytes_of[reference["array"]])
    return a


def rigid_points(frame):
    """Returns the points of all rigid bodies in `frame` as coordinates [m], computed as the browser does."""
    points = []
    for body, at in zip(film["rigid"], frame["rigid"]):
        X, dim = values(body["X"]), film["dim"]
        for k in range(0, len(X), dim):
            r = [X[k + d] for d in range(dim)]
            points.append([at["x"][d] + sum(t * v for t, v in zip(at["turn"][d], r)) for d in range(dim)])
    return points


def compare_rigids(folder, frame):
    """Checks that the surfaces of rigid bodies in `frame` are those of its .vtp file, to seven digits."""
    vtp = open("%s/frames/rigid_%06d.vtp" % (folder, frame["number"])).read()
    array = lambda name: [float(v) for v in re.search('Name="%s"[^>]*>([^<]*)<' % name, vtp).group(1).split()]
    there, here, size = array("Points"), rigid_points(frame), 0
    check(len(there) == 3 * len(here), "frame %d: %d points of rigid bodies, %d in its file" % (frame["number"], len(here), len(there) // 3))
    size = max(abs(v) for v in there)
    off = max(abs(v - there[3 * k + d]) for k, x in enumerate(here) for d, v in enumerate(x))
    check(off <= 5e-7 * size, "frame %d: rigid bodies off by %g" % (frame["number"], off))  # single precision, seven digits in the file
    faces = sum(b["corner"]["length"] // b["corners"] for b in film["rigid"])
    check(faces == len(array("rigid_body")), "frame %d: %d faces of rigid bodies" % (frame["number"], faces))


compared = []
film = page.get("film")
for frame in (film or {}).get("frames", []):
    n = film["sets"][frame["set"]]["n"]
    check(all(r["length"] == n for r in frame["u"] + list(frame["values"].values())), "frame %d: arrays of other particles" % frame["number"])
for s in (film or {}).get("sets", []):
    check(all(a["of"]["length"] == s["n"] for a in s["X"]) and all(r["length"] == s["n"] for r in s["fixed"].values()), "set: lengths")

if len(sys.argv) > 2:
    folder = sys.argv[2]
    rows = list(csv.reader(open(folder + "/history.csv")))
    check(",".join(rows[0]) == page["history"]["header"], "header of the history")
    for k, reference in enumerate(page["history"]["columns"]):
        for row, v in zip(rows[1:], values(reference)):
            w = float(row[k])
            check(w != w and v != v or abs(v - w) <= 1e-7 * abs(w) + 1e-37, "history, column %d: %g, not %g" % (k, v, w))  # single precision
    compared.append("%d columns" % len(rows[0]))
    for frame in film["frames"] if film and "rigid" in film else []:
        compare_rigids(folder, frame)
    if film and "rigid" in film:
        compared.append("%d rigid bodies" % len(film["rigid"]))
    try:
        import h5py
    except ImportError:
        film = None
    for frame in film["frames"] if film else []:
        h = h5py.File("%s/frames/%06d.hdf" % (folder, frame["number"]))["VTKHDF"]
        data, s = h["PointData"], film["sets"][frame["set"]]
        check(s["n"] == s["particles"] == len(data["damage"]), "frame %d: %d particles" % (frame["number"], s["n"]))
        for d in range(film["dim"]):
            u = data["displacement"][:, d]
            half = film["reach"][d] / 32767 * 0.5001  # rounding to 16 bits, and of single precision
            off = max(abs(v * film["reach"][d] / 32767 - w) for v, w in zip(values(frame["u"][d]), u))
            check(off <= half, "frame %d: displacement off by %g, at most %g" % (frame["number"], off, half))
            a, now = s["X"][d], h["Points"][:, d]
            step = (a["high"] - a["low"]) / 65535
            off = max(abs(a["low"] + step * X + v * film["reach"][d] / 32767 - w) for X, v, w in zip(values(a["of"]), values(frame["u"][d]), now))
            check(off <= 0.501 * step + half, "frame %d: position off by %g" % (frame["number"], off))
        damage = values(frame["values"]["damage"]) if "damage" in frame["values"] else [0] * s["n"]  # left out where all is whole
        off = max(abs(v / 254 - w) for v, w in zip(damage, data["damage"]))
        check(off <= 0.5001 / 254, "frame %d: damage off by %g" % (frame["number"], off))
    compared.append("%d frames" % (len(film["frames"]) if film else 0))

for line in wrong[:20]:
    print(line)
print("%d arrays%s" % (len(elements), "".join(", " + c for c in compared)))
sys.exit(1 if wrong else 0)
