// Rigid bodies in the frames: outlines in the plane, shaded surfaces in space.

const RIGID = [120, 120, 126];  // colour
// Shares of the longest edge of the body: a rigid body is shown whole where it extends at most RIGID_WHOLE beyond the
// body in space, and else up to RIGID_BESIDE beyond it.
const RIGID_WHOLE = 1, RIGID_BESIDE = 0.3;

// Reads points, relative to the centre, and faces of a rigid body once.
function rigidOf(body) {
    if (!body.ready) body.ready = {X: arrayOf(body.X), corner: arrayOf(body.corner)};
    return body.ready;
}

// Present positions of the points of a rigid body, one array for each axis. With magnified displacements the body keeps
// its distance from the nearest particle.
function rigidPoints(body, at, magnify) {
    const {X} = rigidOf(body), dim = film.dim, n = X.length / dim, x = at.x.map(() => new Float64Array(n));
    for (let k = 0; k < n; k++)
        for (let d = 0; d < dim; d++) {
            let sum = at.x[d] + (magnify - 1) * at.beside[d];
            for (let e = 0; e < dim; e++) sum += at.turn[d][e] * X[k * dim + e];
            x[d][k] = sum;
        }
    return x;
}

// Calls draw(body, x) for every rigid body of a frame.
function forRigids(frame, magnify, draw) {
    (film.rigid || []).forEach((body, b) => frame.rigid && draw(body, rigidPoints(body, frame.rigid[b], magnify)));
}

// The closed lines of an outline, as lists of points.
function outlinesOf(body) {
    if (body.lines) return body.lines;
    const {corner} = rigidOf(body), next = new Map();
    for (let k = 0; k < corner.length; k += 2) next.set(corner[k], corner[k + 1]);
    body.lines = [];
    while (next.size) {
        const line = [];
        for (let at = next.keys().next().value; next.has(at);) {
            line.push(at);
            const to = next.get(at);
            next.delete(at);
            at = to;
        }
        body.lines.push(line);
    }
    return body.lines;
}

// Fills rigid bodies in the plane. to: size of the picture [pixel]; ratio: pixels per CSS pixel.
function drawRigids(context, to, frame, ratio) {
    context.save();
    context.beginPath();
    context.rect(0, 0, to.width / ratio, to.height / ratio);
    context.clip();
    context.fillStyle = "rgb(" + RIGID.join() + ")";
    forRigids(frame, view.magnify, (body, x) => {
        context.beginPath();
        for (const line of outlinesOf(body)) {
            line.forEach(
                (k, i) => context[i ? "lineTo" : "moveTo"](to.width / ratio / 2 + (x[0][k] - view.x) * view.scale,
                    to.height / ratio / 2 - (x[1][k] - view.y) * view.scale));
            context.closePath();
        }
        context.fill("evenodd");
    });
    context.restore();
}

// Paints rigid bodies in space over what is farther away. see: {centre, scale, turn}; shown(x): is a point drawn?
function paintRigids(to, see, frame, shown) {
    forRigids(frame, view.magnify, (body, x) => {
        const {corner} = rigidOf(body), step = body.corners, n = x[0].length;
        const [px, py, pz] = see.turn.map((row, d) => Float32Array.from({length: n}, (_, k) => {
            const along = row.reduce((sum, c, e) => sum + c * (x[e][k] - see.centre[e]), 0) * see.scale;
            return d === 0 ? to.width / 2 + along : d === 1 ? to.height / 2 - along : along;
        }));
        const point = (k) => [px[k], py[k], pz[k]];
        for (let f = 0; f < corner.length; f += step) {
            if (!shown([0, 1, 2].map((d) => x[d][corner[f]]))) continue;
            for (let c = 2; c < step; c++)
                paintTriangle(to, point(corner[f]), point(corner[f + c - 1]), point(corner[f + c]));
        }
    });
}

// Paints a triangle between points (x, y, depth) [pixel], brighter where it faces the viewer.
function paintTriangle(to, a, b, c) {
    const [u, v] = [b, c].map((p) => p.map((value, d) => value - a[d])), det = u[0] * v[1] - u[1] * v[0];
    if (Math.abs(det) < 1e-9) return;
    const normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], det];
    const bright = 0.55 + 0.5 * Math.abs(det) / Math.hypot(...normal), colour = rgba(RIGID.map((v) => v * bright));
    const limits = (d, end) => [0, 1].map(
        (most) => Math.min(
            Math.max(most ? Math.ceil(Math.max(a[d], b[d], c[d])) : Math.floor(Math.min(a[d], b[d], c[d])), 0), end));
    const [left, right] = limits(0, to.width), [top, bottom] = limits(1, to.height);
    for (let y = top; y < bottom; y++)
        for (let x = left; x < right; x++) {
            const dx = x + 0.5 - a[0], dy = y + 0.5 - a[1];
            const s = (dx * v[1] - dy * v[0]) / det, t = (u[0] * dy - u[1] * dx) / det, at = y * to.width + x;
            const depth = a[2] + s * u[2] + t * v[2];
            if (s < -1e-3 || t < -1e-3 || s + t > 1.001 || to.depth[at] >= depth) continue;
            to.depth[at] = depth;
            to.pixel[at] = colour;
            to.owner[at] = -1;
        }
}

// Extends a box by the rigid bodies of a frame: by the whole of each or, of a large one, by 0.3 of its longest edge.
function boxWithRigids({low, high}, frame) {
    const longest = Math.max(...high.map((h, d) => h - low[d])), from = low.slice(), to = high.slice();
    forRigids(frame, view.magnify, (body, x) => {
        const over = (values, most) => values.reduce((a, v) => most(a, v)), ends = x.map(
            (values) => [over(values, Math.min), over(values, Math.max)]);
        const beyond = Math.max(...ends.map(([a, b], d) => Math.max(low[d] - a, b - high[d])));
        const room = (film.dim === 3 && beyond <= RIGID_WHOLE * longest ? RIGID_WHOLE : RIGID_BESIDE) * longest;
        ends.forEach(([a, b], d) => {
            from[d] = Math.min(from[d], Math.max(a, low[d] - room));
            to[d] = Math.max(to[d], Math.min(b, high[d] + room));
        });
    });
    return {low: from, high: to};
}
