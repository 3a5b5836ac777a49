// Shapes of the particles of a frame: parallelograms or cubes that deform with the body, found from their neighbours.

const LOOSE_CODE = 0.6 * 254, LONGEST = 4;  // as in cleave plot: damage of rubble; length of a particle [spacings]
const STRETCHED = 1.1;  // neighbours on a crack are apart if their distance has grown by more than this factor
const OVER = 0.05;      // cells are drawn so far into neighbours of another size, whose faces differ [spacings]

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

// Returns, for each axis, two arrays like those of neighbours, of the next cell of another size, where there is none of
// the same size: that which contains the point beyond the middle of the face; null if all cells are of one size.
function otherNeighbours(X, size, cracks) {
    const n = size.length, dim = X.length, least = size.reduce((a, b) => Math.min(a, b), Infinity), at = new Map();
    const levels = [...new Set(Array.from(size, (s) => Math.round(Math.log2(s / least))))];
    if (levels.length < 2) return null;
    const low = X.map((axis) => axis.reduce((a, b, i) => Math.min(a, b - size[i] / 2), Infinity));
    const key = (place, level) => low.reduce(
        (cell, l, d) => cell * 65536 + Math.floor((place[d] - l) / (least * 2 ** level)) + 1, level + 1);
    for (let i = 0; i < n; i++) at.set(key(X.map((axis) => axis[i]), Math.round(Math.log2(size[i] / least))), i);
    return Array.from({length: 2 * dim}, (_, side) => {
        const axis = side >> 1, next = new Int32Array(n).fill(-1), step = side % 2 ? -1 : 1;
        for (let i = 0; i < n; i++) {
            const place = X.map((x, d) => x[i] + (d === axis ? step * (size[i] / 2 + least / 4) : 0));
            for (const level of levels) {
                const j = at.get(key(place, level));
                if (j === undefined || Math.abs(size[j] / size[i] - 1) < 0.3 || parted(X, i, j, cracks)) continue;
                if (place.every((p, d) => Math.abs(p - X[d][j]) <= 0.55 * size[j])) next[i] = j;
            }
        }
        return next;
    });
}

// Has the crack parted the neighbours i and j, or is one of them rubble? x: positions; damage: codes, or null.
function apart(set, x, damage, i, j) {
    if (!damage) return false;
    if (Math.max(damage[i], damage[j]) > LOOSE_CODE) return true;
    if (Math.min(damage[i], damage[j]) <= CRACK_CODE) return false;
    let [now, first] = [0, 0];
    for (let d = 0; d < x.length; d++) now += (x[d][j] - x[d][i]) ** 2, first += (set.X[d][j] - set.X[d][i]) ** 2;
    return now > STRETCHED ** 2 * first;
}

// Shapes of all cells of a frame with the positions x, in `dim` dimensions: the vectors along the axes that join the
// middles of opposite sides, edges[(i * dim + k) * dim + d] [m]; what the middle of a cell is moved by to meet its
// neighbours halfway, shift[i * dim + d] [m]; and for each side of an axis what is there, joins[(i * dim + k) * 2 +
// side]: 0, nothing that is shown; JOINED or PARTED, a neighbour; RESIZED, one of another size.
const JOINED = 1, PARTED = 2, RESIZED = 3;
function cellShapes(set, x, damage, shown) {
    const dim = x.length, n = set.n, edges = new Float32Array(n * dim * dim), shift = new Float32Array(n * dim);
    const cells = {edges, shift, joins: new Uint8Array(2 * n * dim)}, at = [0, 0], alone = [];
    for (let i = 0; i < n; i++)
        for (let k = 0; k < dim; k++) {
            for (const side of [0, 1]) {
                const j = set.beside[2 * k + side][i];
                at[side] = j >= 0 && !apart(set, x, damage, i, j) ? j : i;
                cells.joins[2 * (i * dim + k) + side] = j < 0 || !shown(j) ? 0 : at[side] === i ? PARTED : JOINED;
            }
            const first = (i * dim + k) * dim, both = at[0] !== i && at[1] !== i;
            let square = 0;
            for (let d = 0; d < dim; d++) {
                edges[first + d] = (x[d][at[0]] - x[d][at[1]]) * (both ? 0.5 : 1);
                square += edges[first + d] ** 2;
            }
            const sound = square > 0 && square <= (LONGEST * set.size[i]) ** 2;
            if (!sound) alone.push(first);
            for (let d = 0; d < dim; d++)
                if (!sound)
                    edges[first + d] = d === k ? set.size[i] : 0;
                else if (both)
                    shift[i * dim + d] += (x[d][at[0]] + x[d][at[1]] - 2 * x[d][i]) / 4;
        }
    if (set.other) joinOtherSizes(set, x, damage, shown, cells, alone);
    return cells;
}

// Lets cells meet those of another size: turns edges without a neighbour of the same size, whose first numbers in
// cells.edges are in `alone`, towards them, and draws all cells a little into them. Arguments: as of cellShapes.
function joinOtherSizes(set, x, damage, shown, cells, alone) {
    const dim = x.length, {edges, shift} = cells, least = set.size.reduce((a, b) => Math.min(a, b), Infinity);
    const other = (i, k, side) => {
        const j = set.other[2 * k + side][i];
        return j >= 0 && set.beside[2 * k + side][i] < 0 && !apart(set, x, damage, i, j) ? j : -1;
    };
    for (const first of alone) {
        const i = Math.floor(first / (dim * dim)), k = first / dim % dim, size = set.size[i];
        const found = [0, 1].map((side) => other(i, k, side)).filter((j) => j >= 0);
        const edge = x.map((axis, d) => found.reduce((sum, j) => {
            let motion = axis[j] - axis[i]; // less that of the body along the other axes
            for (let m = 0; m < dim; m++)
                if (m !== k) motion -= edges[(i * dim + m) * dim + d] / size * (set.X[m][j] - set.X[m][i]);
            return sum + motion / (set.X[k][j] - set.X[k][i]) * size / found.length;
        }, 0));
        if (found.length > 0 && Math.hypot(...edge) <= LONGEST * size) edge.forEach((e, d) => edges[first + d] = e);
    }
    for (let i = 0; i < set.n; i++)
        for (let k = 0; k < dim; k++) {
            const more = [0, 1].map((side) => {
                const j = other(i, k, side);
                if (j >= 0 && shown(j)) cells.joins[2 * (i * dim + k) + side] = RESIZED;
                return j >= 0 ? OVER * least / set.size[i] : 0;
            });
            for (let d = 0, at = (i * dim + k) * dim; d < dim; d++, at++)
                shift[i * dim + d] += edges[at] * (more[0] - more[1]) / 2, edges[at] *= 1 + more[0] + more[1];
        }
}

// Is face `side` of cube i along axis k covered by its neighbour, a cube of nearly the same shape that has not moved
// away?
function covered(set, x, cubes, i, k, side) {
    const joins = cubes.joins[6 * i + 2 * k + side];
    if (!joins || joins === RESIZED) return false;
    const j = set.beside[2 * k + side][i], from = 9 * i, to = 9 * j, limit = 0.1 * set.size[i];
    for (let e = 0; e < 9; e++)
        if (Math.abs(cubes.edges[from + e] - cubes.edges[to + e]) > limit) return false;
    for (let d = 0; d < 3 && joins === PARTED; d++)
        if (Math.abs(x[d][j] - x[d][i] - (side ? -1 : 1) * cubes.edges[from + 3 * k + d]) > limit) return false;
    return true;
}
