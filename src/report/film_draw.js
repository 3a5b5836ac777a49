// Draws the particles of one frame into an array of pixels: squares that deform with the body, or cubes in space. Each
// pixel also keeps the number of its particle, for the readout.

const CRACK = 0.35;  // damage from which a particle is drawn as part of a crack, as in cleave plot
const CRACK_CODE = CRACK * 254;
const INK = 0xff201a18, GHOST = 0xffe9e6e4;  // alpha, blue, green, red

// Reads the reference state of a particle set once: positions, sizes, neighbours on the lattice.
function particlesOf(film, set) {
    if (set.ready) return set.ready;
    const X = set.X.map((axis) => {
        const of = arrayOf(axis.of);
        return Float32Array.from(of, (v) => axis.low + (axis.high - axis.low) * v / 65535);
    });
    const size = set.size ? arrayOf(set.size) : new Float32Array(set.n).fill(film.spacing);
    set.ready =
        {n: set.n, X, size, beside: film.dim > 1 ? neighbours(X, size, film.dim === 2 && page.cracks || []) : null};
    return set.ready;
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
        const u = arrayOf(frame.u[d]), scale = magnify * film.reach[d] / 32767, x = new Float32Array(set.n);
        for (let i = 0; i < set.n; i++) x[i] = X[i] + scale * u[i];
        return x;
    });
}

// Paints particles in the plane. to: {pixel, owner, width, height}; see: {x, y, scale}: the position at the centre and
// the pixels per metre. colour(i): of particle i; damage: codes of damage, or null.
function paintPlane(to, see, set, x, colour, damage) {
    const broken = (i, j) => damage && damage[i] > CRACK_CODE && damage[j] > CRACK_CODE;
    const edge = [0, 0], beside = set.beside;
    // The vector from the middle of one side of a particle to that of the other: half the way between its neighbours.
    const edgeOf = (i, plus, minus, axis) => {
        const p = plus[i] >= 0 && !broken(i, plus[i]) ? plus[i] : i,
              m = minus[i] >= 0 && !broken(i, minus[i]) ? minus[i] : i;
        const share = p !== i && m !== i ? 0.5 : 1;
        edge[0] = (x[0][p] - x[0][m]) * share;
        edge[1] = (x[1][p] - x[1][m]) * share;
        if (p === m || Math.hypot(edge[0], edge[1]) > 4 * set.size[i]) edge[axis] = set.size[i], edge[1 - axis] = 0;
    };
    for (let i = 0; i < set.n; i++) {
        edgeOf(i, beside[0], beside[1], 0);
        const ax = edge[0] * see.scale, ay = -edge[1] * see.scale;
        edgeOf(i, beside[2], beside[3], 1);
        const bx = edge[0] * see.scale, by = -edge[1] * see.scale;
        const cx = to.width / 2 + (x[0][i] - see.x) * see.scale, cy = to.height / 2 - (x[1][i] - see.y) * see.scale;
        paintQuad(to, i, cx, cy, ax, ay, bx, by, colour(i));
    }
}

// Paints a parallelogram with the centre (cx, cy) and the edges a and b, all in pixels.
function paintQuad(to, i, cx, cy, ax, ay, bx, by, colour) {
    const det = ax * by - ay * bx, wide = (Math.abs(ax) + Math.abs(bx)) / 2 + 0.5,
          high = (Math.abs(ay) + Math.abs(by)) / 2 + 0.5;
    const left = Math.max(0, Math.round(cx - wide)), right = Math.min(to.width, Math.round(cx + wide));
    const top = Math.max(0, Math.round(cy - high)), bottom = Math.min(to.height, Math.round(cy + high));
    if (!(Math.abs(det) > 1e-9) || right <= left || bottom <= top) return;
    const along = Math.abs(det) / 2 + 0.6 * Math.hypot(bx, by), across = Math.abs(det) / 2 + 0.6 * Math.hypot(ax, ay);
    for (let py = top; py < bottom; py++)
        for (let px = left; px < right; px++) {
            const dx = px + 0.5 - cx, dy = py + 0.5 - cy;
            if (Math.abs(dx * by - dy * bx) > along || Math.abs(ax * dy - ay * dx) > across) continue;
            to.pixel[py * to.width + px] = colour;
            to.owner[py * to.width + px] = i;
        }
}

// The pixels that a cube of `edge` pixels covers, seen along the third row of `turn`: offsets, depths, and the axis of
// the face that is seen there.
function cubeStamp(turn, edge) {
    const half = edge / 2 + 0.5, reach = Math.ceil(half * 1.75), stamp = {x: [], y: [], depth: [], face: []};
    for (let y = -reach; y <= reach; y++)
        for (let x = -reach; x <= reach; x++) {
            let near = Infinity, far = -Infinity, face = 0;
            for (let k = 0; k < 3; k++) {
                const at = x * turn[0][k] + y * turn[1][k], along = turn[2][k];
                if (Math.abs(along) < 1e-6) {
                    if (Math.abs(at) > half) near = -Infinity;
                    continue;
                }
                const one = (half - at) / along, other = (-half - at) / along;
                if (Math.max(one, other) < near) near = Math.max(one, other), face = k;
                far = Math.max(far, Math.min(one, other));
            }
            if (near < far) continue;
            stamp.x.push(x), stamp.y.push(-y), stamp.depth.push(near), stamp.face.push(face);
        }
    return stamp;
}

// Returns a function that stores in open[3] which of the three faces of cube i that one sees have no neighbour before
// them, and returns the edge of the cube [m], which grows with the distance of its neighbours.
function exposure(set, x, damage, shown, turn, open) {
    const seen = [0, 1, 2].map((k) => set.beside[2 * k + (turn[2][k] > 0 ? 0 : 1)]);
    const joined = (i, j) => j >= 0 && shown(j) && !(damage && damage[i] > CRACK_CODE && damage[j] > CRACK_CODE);
    return (i) => {
        let widest = set.size[i];
        for (let k = 0; k < 3; k++) open[k] = !joined(i, seen[k][i]);
        for (const next of set.beside) {
            const j = next[i];
            if (joined(i, j))
                widest = Math.max(widest, Math.hypot(x[0][j] - x[0][i], x[1][j] - x[1][i], x[2][j] - x[2][i]));
        }
        return Math.min(widest, 2 * set.size[i]);
    };
}

// Paints cubes in space. see: {centre, scale, turn}; shown(i): is particle i drawn? colour(i): its colour; damage:
// codes, or null.
function paintSpace(to, see, set, x, colour, shown, damage) {
    const stamps = new Map(), [r, u, t] = see.turn, depth = to.depth.fill(-Infinity), open = [true, true, true];
    const edgeOf = exposure(set, x, damage, shown, see.turn, open);
    for (let i = 0; i < set.n; i++) {
        if (!shown(i)) continue;
        const edge = Math.round(2 * see.scale * edgeOf(i)) / 2;
        if (!open[0] && !open[1] && !open[2]) continue;
        const dx = x[0][i] - see.centre[0], dy = x[1][i] - see.centre[1], dz = x[2][i] - see.centre[2];
        const px = Math.round(to.width / 2 + see.scale * (r[0] * dx + r[1] * dy + r[2] * dz));
        const py = Math.round(to.height / 2 - see.scale * (u[0] * dx + u[1] * dy + u[2] * dz));
        const pz = see.scale * (t[0] * dx + t[1] * dy + t[2] * dz);
        if (!stamps.has(edge)) stamps.set(edge, cubeStamp(see.turn, edge));
        paintStamp(to, stamps.get(edge), i, px, py, pz, shadesOf(colour(i)), open);
    }
}

function paintStamp(to, stamp, i, px, py, pz, shades, open) {
    for (let k = 0; k < stamp.x.length; k++) {
        const ax = px + stamp.x[k], ay = py + stamp.y[k], face = stamp.face[k];
        if (!open[face] || ax < 0 || ay < 0 || ax >= to.width || ay >= to.height) continue;
        const at = ay * to.width + ax;
        if (to.depth[at] >= pz + stamp.depth[k]) continue;
        to.depth[at] = pz + stamp.depth[k];
        to.pixel[at] = shades[face];
        to.owner[at] = i;
    }
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
