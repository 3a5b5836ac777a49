"""Prints how many blank pixels a PNG has at its left, right, upper and lower edge: picture_margins.py FILE. Text that is cut off
leaves 0."""
import struct, sys, zlib

raw, at, packed, palette = open(sys.argv[1], "rb").read(), 8, b"", b""
while at < len(raw):
    length, kind = struct.unpack(">I4s", raw[at:at + 8])
    body = raw[at + 8:at + 8 + length]
    if kind == b"IHDR":
        width, height, depth, colour = struct.unpack(">IIBB", body[:10])
    elif kind == b"PLTE":
        palette = body
    elif kind == b"IDAT":
        packed += body
    at += length + 12
channels = {0: 1, 2: 3, 3: 1, 6: 4}[colour]
stride, data, last, ink = (width * channels * depth + 7) // 8, zlib.decompress(packed), None, []
step = max(channels * depth // 8, 1)
for y in range(height):
    kind, line = data[y * (stride + 1)], bytearray(data[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
    for k in range(stride):
        a, b = line[k - step] if k >= step else 0, last[k] if last else 0
        c = last[k - step] if last and k >= step else 0
        p = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))[2]
        line[k] = line[k] + (0, a, b, (a + b) // 2, p)[kind] & 255
    last = line
    if colour == 3:
        bits = [line[x * depth // 8] >> (8 - depth - x * depth % 8) & (1 << depth) - 1 for x in range(width)]
        dark = [min(palette[3 * v:3 * v + 3]) < 235 for v in bits]
    else:
        dark = [min(line[x * channels:x * channels + min(channels, 3)]) < 235 for x in range(width)]
    ink.append(dark)
columns, rows = [any(line[x] for line in ink) for x in range(width)], [any(line) for line in ink]
print(columns.index(True), columns[::-1].index(True), rows.index(True), rows[::-1].index(True))
