// Draws the particles of one frame into an array of pixels: squares that deform with the body, or cubes in space. Each
// pixel also keeps the number of its particle, for the readout.

const CRACK = 0.35;  // damage from which a particle is drawn as part of a crack, as in cleave plot
const CRACK_CODE = CRACK * 254;
const LOOSE_CODE = 0.6 * 254, LONGEST = 4;  // of rubble, from this damage; of drawn particles [spacings], as there
const TURNED = 1.5;  // edge of the squares below particles that are on no lattice [spacings]; a turned cell has gaps
const WIDER = 0.04;  // cubes are drawn wider by this to close the gaps of a strained lattice [spacings]
const INK = 0xff201a18, GHOST = 0xffe9e6e4;  // alpha, blue, green, red

// Reads the reference state of a particle set once: positions, sizes, neighbours on the lattice.
function particlesOf(film, set) {
    if (set.ready) return set.ready;
    const X = set.X.map((axis) => {
        const of = arrayOf(axis.of);
        return Float64Array.from(of, (v) => axis.low + (axis.high - axis.low) * v / 65535);
    });
    const size = set.size ? arrayOf(set.size) : new Float32Array(set.n).fill(film.spacing);
    set.ready = {
        n: set.n,
        X,
        size,
        beside: film.dim > 1 ? neighbours(X, size, film.dim === 2 && page.cracks || []) : null,
        scattered: film.dim === 2 && isScattered(X, size)
    };
    return set.ready;
}

// Are the particles in the plane on no lattice along the axes? As in cleave plot: of a sample of the smallest ones,
// more than 10 % have their nearest neighbour more than 8 degrees off an axis.
function isScattered(X, size) {
    const least = size.reduce((a, b) => Math.min(a, b), Infinity), small = [];
    size.forEach((s, i) => s < 1.01 * least && small.push(i));
    const every = Math.ceil(small.length / 100), sample = small.filter((_, k) => k % every === 0);
    const off = sample.filter((i) => {
        let [best, turned] = [Infinity, false];
        for (let j = 0; j < size.length; j++) {
            const a = Math.abs(X[0][j] - X[0][i]), b = Math.abs(X[1][j] - X[1][i]), distance = a * a + b * b;
            if (j !== i && distance < best) best = distance, turned = Math.min(a, b) > 0.14 * Math.max(a, b);
        }
        return turned;
    });
    return off.length > 0.1 * sample.length;
}

// Returns, for each axis, two arrays: the next particle of the same size in its direction, and against it; -1: none, or
// a pre-crack lies between.
function neighbours(X, size, cracks) {
    const n = size.length, dim = X.length, at = new Map(), beside = [];
    const low = X.map((axis) => axis.reduce((a, b) => Math.min(a, b), Infinity));
    const key = (i, axis, step) => {
        let cell = Math.round(Math.log2(size[i] / size[0]) + 4);
        for (let d = 0; d < dim; d++)
            cell = cell * 65536 + Math.floor((X[d][i] - low[d]) / size[i] + 0.25) + (d === axis ? step : 0) + 1;
        return cell;
    };
    for (let i = 0; i < n; i++) at.set(key(i, 0, 0), i);
    for (let side = 0; side < 2 * dim; side++) {
        const axis = side >> 1, step = side % 2 ? -1 : 1, next = new Int32Array(n).fill(-1);
        for (let i = 0; i < n; i++) {
            const j = at.get(key(i, axis, step));
            if (j === undefined) continue;
            let near = true;
            for (let d = 0; d < dim; d++)
                near = near && Math.abs(X[d][j] - X[d][i] - (d === axis ? step * size[i] : 0)) < 0.3 * size[i];
            if (near && !parted(X, i, j, cracks)) next[i] = j;
        }
        beside.push(next);
    }
    return beside;
}

// Does a pre-crack, a line of corners, lie between the particles i and j?
function parted(X, i, j, cracks) {
    const side = (p, q, x, y) => (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]);
    const a = [X[0][i], X[1][i]], b = [X[0][j], X[1][j]];
    return cracks.some(
        (line) => line.some((q, k) => k > 0 && side(line[k - 1], q, ...a) * side(line[k - 1], q, ...b) < 0 &&
                side(a, b, ...line[k - 1]) * side(a, b, ...q) <= 0));
}

// Positions of the particles of a frame: x = X + magnify u.
function positionsOf(film, frame, magnify) {
    const set = particlesOf(film, film.sets[frame.set]);
    return set.X.map((X, d) => {
        const u = arrayOf(frame.u[d]), scale = magnify * film.reach[d] / 32767, x = new Float64Array(set.n);
        for (let i = 0; i < set.n; i++) x[i] = X[i] + scale * u[i];
        return x;
    });
}

// Has the crack parted the neighbours i and j, or is one of them rubble? damage: codes, or null.
const apart = (damage, i, j) => damage &&
    (Math.min(damage[i], damage[j]) > CRACK_CODE || Math.max(damage[i], damage[j]) > LOOSE_CODE);

// Paints particles in the plane, those on no lattice with wider squares below them, which fill the gaps. to: {pixel,
// owner, width, height}; see: {x, y, scale}: the position at the centre and pixels per metre. colour(i): of particle
// i; damage: codes of damage, or null.
function paintPlane(to, see, set, x, colour, damage) {
    const edge = [0, 0], beside = set.beside;
    // The vector from the middle of one side of a particle to that of the other: half the way between its neighbours.
    const edgeOf = (i, plus, minus, axis) => {
        const p = plus[i] >= 0 && !apart(damage, i, plus[i]) ? plus[i] : i,
              m = minus[i] >= 0 && !apart(damage, i, minus[i]) ? minus[i] : i;
        const share = p !== i && m !== i ? 0.5 : 1;
        edge[0] = (x[0][p] - x[0][m]) * share;
        edge[1] = (x[1][p] - x[1][m]) * share;
        if (p === m || Math.hypot(edge[0], edge[1]) > LONGEST * set.size[i])
            edge[axis] = set.size[i], edge[1 - axis] = 0;
    };
    const paint = (i, wide) => {
        edgeOf(i, beside[0], beside[1], 0);
        const ax = edge[0] * wide, ay = -edge[1] * wide;
        edgeOf(i, beside[2], beside[3], 1);
        const bx = edge[0] * wide, by = -edge[1] * wide;
        const cx = to.width / 2 + (x[0][i] - see.x) * see.scale, cy = to.height / 2 - (x[1][i] - see.y) * see.scale;
        const own = colour(i);
        paintCells(to, cx, cy, ax, ay, bx, by, (at) => {
            to.pixel[at] = own;
            to.owner[at] = i;
        });
    };
    for (const share of set.scattered ? [TURNED, 1] : [1])
        for (let i = 0; i < set.n; i++) paint(i, share * see.scale);
}

// Calls paint(pixel, s, t) for the pixels of a parallelogram with the centre (cx, cy) and the edges a and b [pixel]; s
// and t: place along the edges from the centre, 0.5 and slightly more at the sides.
function paintCells(to, cx, cy, ax, ay, bx, by, paint) {
    const det = ax * by - ay * bx, wide = (Math.abs(ax) + Math.abs(bx)) / 2 + 0.5,
          high = (Math.abs(ay) + Math.abs(by)) / 2 + 0.5;
    const left = Math.max(0, Math.round(cx - wide)), right = Math.min(to.width, Math.round(cx + wide));
    const top = Math.max(0, Math.round(cy - high)), bottom = Math.min(to.height, Math.round(cy + high));
    if (!(Math.abs(det) > 1e-9) || right <= left || bottom <= top) return;
    const along = Math.abs(det) / 2 + 0.6 * Math.hypot(bx, by), across = Math.abs(det) / 2 + 0.6 * Math.hypot(ax, ay);
    for (let py = top; py < bottom; py++)
        for (let px = left; px < right; px++) {
            const dx = px + 0.5 - cx, dy = py + 0.5 - cy, s = dx * by - dy * bx, t = ax * dy - ay * dx;
            if (Math.abs(s) <= along && Math.abs(t) <= across) paint(py * to.width + px, s / det, t / det);
        }
}

// Edges of the cubes of all particles, which deform with the body: the vectors along the axes, edges[9 * i + 3 * k + d]
// [m], and for each side of an axis what is there, joins[6 * i + 2 * k + side]: 0, no cube; JOINED or PARTED, a
// neighbour.
const JOINED = 1, PARTED = 2;
function deformedCubes(set, x, damage, shown) {
    const edges = new Float32Array(9 * set.n), joins = new Uint8Array(6 * set.n), at = [0, 0];
    for (let i = 0; i < set.n; i++)
        for (let k = 0; k < 3; k++) {
            for (const side of [0, 1]) {
                const j = set.beside[2 * k + side][i];
                at[side] = j >= 0 && !apart(damage, i, j) ? j : i;
                joins[6 * i + 2 * k + side] = j < 0 || !shown(j) ? 0 : at[side] === i ? PARTED : JOINED;
            }
            const first = 9 * i + 3 * k, share = at[0] !== i && at[1] !== i ? 0.5 : 1;
            for (let d = 0; d < 3; d++) edges[first + d] = (x[d][at[0]] - x[d][at[1]]) * share;
            const length = Math.hypot(edges[first], edges[first + 1], edges[first + 2]);
            if (!(length > 0) || length > LONGEST * set.size[i])
                for (let d = 0; d < 3; d++) edges[first + d] = d === k ? set.size[i] : 0;
        }
    return {edges, joins};
}

// Is face `side` of cube i along axis k covered by its neighbour, a cube of nearly the same shape that has not moved
// away?
function covered(set, x, cubes, i, k, side) {
    const joins = cubes.joins[6 * i + 2 * k + side];
    if (!joins) return false;
    const j = set.beside[2 * k + side][i], from = 9 * i, to = 9 * j, limit = 0.1 * set.size[i];
    for (let e = 0; e < 9; e++)
        if (Math.abs(cubes.edges[from + e] - cubes.edges[to + e]) > limit) return false;
    for (let d = 0; d < 3 && joins === PARTED; d++)
        if (Math.abs(x[d][j] - x[d][i] - (side ? -1 : 1) * cubes.edges[from + 3 * k + d]) > limit) return false;
    return true;
}

// Paints the deformed cubes of particles in space. see: {centre, scale, turn}; shown(i): is particle i drawn?
// colour(i): its colour; damage: codes, or null.
function paintSpace(to, see, set, x, colour, shown, damage) {
    const cubes = deformedCubes(set, x, damage, shown), edge = [0, 1, 2].map(() => [0, 0, 0]), middle = [0, 0, 0];
    to.depth.fill(-Infinity);
    // A vector of the body as x, y and depth on the screen, with `zoom` pixels per metre.
    const turned = (v, zoom, out) => {
        for (let r = 0; r < 3; r++)
            out[r] = zoom * (see.turn[r][0] * v[0] + see.turn[r][1] * v[1] + see.turn[r][2] * v[2]);
        out[1] = -out[1];
    };
    for (let i = 0; i < set.n; i++) {
        if (!shown(i)) continue;
        turned([0, 1, 2].map((d) => x[d][i] - see.centre[d]), see.scale, middle);
        const zoom = see.scale * (1 + WIDER * film.spacing / set.size[i]);
        for (let k = 0, at = 9 * i; k < 3; k++, at += 3) turned(cubes.edges.subarray(at, at + 3), zoom, edge[k]);
        for (let k = 0; k < 3; k++) {
            const [a, b] = [edge[(k + 1) % 3], edge[(k + 2) % 3]], towards = a[0] * b[1] - a[1] * b[0];
            const out = edge[k][0] * (a[1] * b[2] - a[2] * b[1]) + edge[k][1] * (a[2] * b[0] - a[0] * b[2]) +
                edge[k][2] * towards;
            const side = towards * out > 0 ? 0 : 1;
            if (towards === 0 || covered(set, x, cubes, i, k, side)) continue;
            const half = side ? -0.5 : 0.5, centre = middle.map((m, r) => m + half * edge[k][r]);
            centre[0] += to.width / 2, centre[1] += to.height / 2;
            paintFace(to, i, centre, a, b, shadesOf(colour(i))[k]);
        }
    }
}

// Paints a parallelogram in space with its centre and the edges a and b, each x, y and depth [pixel]. Pixels beyond its
// sides lie a pixel deeper, so that a face within the body does not show at the edge of the one that hides it.
function paintFace(to, i, centre, a, b, colour) {
    paintCells(to, centre[0], centre[1], a[0], a[1], b[0], b[1], (at, s, t) => {
        const [p, q] = [s, t].map((along) => Math.min(Math.max(along, -0.5), 0.5));
        const depth = centre[2] + p * a[2] + q * b[2] - (p !== s || q !== t ? 1 : 0);
        if (to.depth[at] >= depth) return;
        to.depth[at] = depth;
        to.pixel[at] = colour;
        to.owner[at] = i;
    });
}

// The colour of a cube on its faces along x, y and z.
const shadeCache = new Map();
function shadesOf(colour) {
    if (!shadeCache.has(colour))
        shadeCache.set(colour,
            [0.86, 0.74, 1].map(
                (s) => (0xff000000 | Math.round((colour >> 16 & 255) * s) << 16 |
                           Math.round((colour >> 8 & 255) * s) << 8 | Math.round((colour & 255) * s)) >>>
                    0));
    return shadeCache.get(colour);
}
