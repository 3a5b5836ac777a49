// Draws the particles of one frame into an array of pixels: squares that deform with the body, or cubes in space. Each
// pixel also keeps the number of its particle, for the readout.

const CRACK = 0.35;  // damage from which a particle is drawn as part of a crack, as in cleave plot
const CRACK_CODE = CRACK * 254;
const TURNED = 1.5;  // edge of the squares below particles that are on no lattice [spacings]; a turned cell has gaps
const WIDER = 0.04;  // cubes are drawn wider by this to close the gaps of a strained lattice [spacings]
const DEEPER = 2;    // faces towards cells of another size lie deeper, so that their edges do not show [pixel]
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
        other: film.dim > 1 ? otherNeighbours(X, size, film.dim === 2 && page.cracks || []) : null,
        scattered: Boolean(set.scattered)
    };
    return set.ready;
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

// Paints particles in the plane, those on no lattice with wider squares below them, which fill the gaps. to: {pixel,
// owner, width, height}; see: {x, y, scale}: the position at the centre and pixels per metre. cells: of cellShapes.
// colour(i): of particle i.
function paintPlane(to, see, set, x, cells, colour) {
    const {edges, shift} = cells;
    const paint = (i, wide) => {
        const [ax, ay, bx, by] = edges.subarray(4 * i, 4 * i + 4);
        const cx = to.width / 2 + (x[0][i] + shift[2 * i] - see.x) * see.scale,
              cy = to.height / 2 - (x[1][i] + shift[2 * i + 1] - see.y) * see.scale;
        const own = colour(i);
        paintCells(to, cx, cy, ax * wide, -ay * wide, bx * wide, -by * wide, (at) => {
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

// Paints the deformed cubes of particles in space. see: {centre, scale, turn}; shown(i): is particle i drawn?
// colour(i): its colour; damage: codes, or null.
function paintSpace(to, see, set, x, colour, shown, damage) {
    const cubes = cellShapes(set, x, damage, shown), edge = [0, 1, 2].map(() => [0, 0, 0]), middle = [0, 0, 0];
    to.depth.fill(-Infinity);
    // A vector of the body as x, y and depth on the screen, with `zoom` pixels per metre.
    const turned = (v, zoom, out) => {
        for (let r = 0; r < 3; r++)
            out[r] = zoom * (see.turn[r][0] * v[0] + see.turn[r][1] * v[1] + see.turn[r][2] * v[2]);
        out[1] = -out[1];
    };
    for (let i = 0; i < set.n; i++) {
        if (!shown(i)) continue;
        turned([0, 1, 2].map((d) => x[d][i] + cubes.shift[3 * i + d] - see.centre[d]), see.scale, middle);
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
            if (cubes.joins[6 * i + 2 * k + side] === RESIZED) centre[2] -= DEEPER;
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
