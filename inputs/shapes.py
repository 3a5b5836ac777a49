#!/usr/bin/env python3
"""Writes the shapes that scenes beside it read: blade.stl, gear.inp, fibres.png. Run it in this folder."""
import math
import random
import struct
import zlib


def blade(path, sections=9, sides=14, length=60.0):
    """A twisted aerofoil (NACA 0018 with camber) that narrows to its tip, on a square root; STL in bytes, mm."""
    def section(k):
        along = k / (sections - 1)
        chord, twist = 24 - 10 * along, math.radians(35 * along)
        corners = []
        for i in range(sides):
            angle = 2 * math.pi * i / sides
            x = 0.5 * (1 + math.cos(angle))
            half = 0.9 * (0.2969 * math.sqrt(x) - 0.126 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4)
            y = math.copysign(half, math.sin(angle)) if 0 < i < sides and 2 * i != sides else 0
            u, v = chord * (x - 0.4), chord * (y + 0.12 * 4 * x * (1 - x) * 0.5)
            corners.append((u * math.cos(twist) - v * math.sin(twist), u * math.sin(twist) + v * math.cos(twist),
                            length * along))
        return corners

    rows = [section(k) for k in range(sections)]
    faces = []
    for low, high in zip(rows, rows[1:]):
        for i in range(sides):
            j = (i + 1) % sides
            faces += [(low[i], low[j], high[j]), (low[i], high[j], high[i])]
    for i in range(1, sides - 1):
        faces += [(rows[0][0], rows[0][i + 1], rows[0][i]), (rows[-1][0], rows[-1][i], rows[-1][i + 1])]
    with open(path, "wb") as out:
        out.write(b"blade, mm".ljust(80) + struct.pack("<I", len(faces)))
        for a, b, c in faces:
            out.write(struct.pack("<12fH", 0, 0, 0, *a, *b, *c, 0))


def gear(path, teeth=12, bore=6.0, root=15.0, tip=20.0):
    """A gear of plane elements with the sets bore (nodes), wheel and teeth (elements), mm."""
    around = 4 * teeth
    nodes, wheel, tooth = [], [], []
    for radius in (bore, 0.5 * (bore + root), root):
        for i in range(around):
            angle = 2 * math.pi * i / around
            nodes.append((radius * math.cos(angle), radius * math.sin(angle)))
    for ring in range(2):
        for i in range(around):
            j = (i + 1) % around
            wheel.append([ring * around + k + 1 for k in (i, i + around, j + around, j)])
    for t in range(teeth):
        base, middle = [2 * around + (4 * t + k) % around + 1 for k in range(3)], 4 * t + 1
        for radius, half in ((0.5 * (root + tip), 0.75), (tip, 0.45)):
            first = len(nodes) + 1
            for k in (-half, 0, half):
                angle = 2 * math.pi * (middle + k) / around
                nodes.append((radius * math.cos(angle), radius * math.sin(angle)))
            tooth += [[base[k], first + k, first + k + 1, base[k + 1]] for k in range(2)]
            base = [first, first + 1, first + 2]
    with open(path, "w") as out:
        out.write("*HEADING\nA gear of %d teeth, mm\n*NODE\n" % teeth)
        out.writelines("%d, %.4f, %.4f\n" % (k + 1, *at) for k, at in enumerate(nodes))
        count = 0
        for name, elements in (("wheel", wheel), ("teeth", tooth)):
            out.write("*ELEMENT, TYPE=CPS4, ELSET=%s\n" % name)
            for element in elements:
                count += 1
                out.write("%d, %d, %d, %d, %d\n" % (count, *element))
        out.write("*NSET, NSET=bore, GENERATE\n1, %d, 1\n" % around)


def fibres(path, wide=160, high=120, fibres=26, pores=6, radius=9):
    """Round fibres (255) and pores (0) in a matrix (128) that do not touch; PNG of one grey value a pixel."""
    random.seed(3)
    discs = []
    while len(discs) < fibres + pores:
        x, y, r = random.uniform(0, wide), random.uniform(0, high), radius if len(discs) < fibres else 4
        if all(math.hypot(x - a, y - b) > r + c + 2.5 for a, b, c, _ in discs):
            discs.append((x, y, r, 255 if len(discs) < fibres else 0))

    def grey(i, j):
        return next((g for x, y, r, g in discs if math.hypot(i + 0.5 - x, j + 0.5 - y) < r), 128)

    rows = b"".join(b"\0" + bytes(grey(i, j) for i in range(wide)) for j in range(high))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    with open(path, "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", wide, high, 8, 0, 0, 0, 0)) +
                  chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


if __name__ == "__main__":
    blade("blade.stl")
    gear("gear.inp")
    fibres("fibres.png")
