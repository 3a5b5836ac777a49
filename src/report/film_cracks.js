// Pre-cracks in the plane: both faces, as lines that move with the particles beside them.

// A face ends ALONG beyond the last particle beside it; particles up to ON_LINE beside the line are on either side by
// round-off [spacings].
const ALONG = 0.55, ON_LINE = 0.02;

// Returns the faces of all pre-cracks, each a list of points [x, y, particle beside it on this side of the line, or -1
// where there is none within 1.2 spacings, and within ALONG along the line, dx, dy of the line].
function facesOf(set) {
    if (set.faces) return set.faces;
    const [X, Y] = set.X, wide = set.size.reduce((a, b) => Math.max(a, b), 0),
                 fine = set.size.reduce((a, b) => Math.min(a, b), wide);
    const cells = new Map(), cell = (x, y) => Math.floor(x / wide) + "," + Math.floor(y / wide);
    for (let i = 0; i < set.n; i++) {
        const key = cell(X[i], Y[i]);
        if (!cells.has(key)) cells.set(key, []);
        cells.get(key).push(i);
    }
    // The nearest particle to (x, y) on the side of the line to which the normal points.
    const beside = (x, y, normal) => {
        let [least, found] = [1.2, -1];
        const length = Math.hypot(...normal);
        for (let k = 0; k < 9; k++)
            for (const i of cells.get(cell(x + (k % 3 - 1) * wide, y + (Math.floor(k / 3) - 1) * wide)) || []) {
                const [dx, dy] = [X[i] - x, Y[i] - y], distance = Math.hypot(dx, dy) / set.size[i];
                const along = Math.abs(dx * normal[1] - dy * normal[0]) / length;
                const off = (dx * normal[0] + dy * normal[1]) / length;
                if (off > ON_LINE * set.size[i] && distance < least && along < ALONG * set.size[i])
                    [least, found] = [distance, i];
            }
        return found;
    };
    set.faces = [];
    for (const line of page.cracks || [])
        for (const side of [1, -1]) {
            const face = [];
            for (let k = 1; k < line.length; k++) {
                const [a, b] = [line[k - 1], line[k]], [dx, dy] = [b[0] - a[0], b[1] - a[1]];
                const steps = Math.min(Math.ceil(8 * Math.hypot(dx, dy) / fine), 8000) || 1;
                for (let s = 0; s <= steps; s++) {
                    const [x, y] = [a[0] + dx * s / steps, a[1] + dy * s / steps];
                    face.push([x, y, beside(x, y, [-side * dy, side * dx]), dx, dy]);
                }
            }
            set.faces.push(face);
        }
    return set.faces;
}

// Returns where the point [x, y, i] of a face is drawn: on the side of particle i, as it is drawn, if the line [dx, dy]
// of the pre-crack is along an axis.
function facePoint(set, [x, y, i, dx, dy]) {
    const {edges, shift} = view.cells, share = [(x - set.X[0][i]) / set.size[i], (y - set.X[1][i]) / set.size[i]];
    if (dx === 0) share[0] = 0.5 * Math.sign(share[0]);
    if (dy === 0) share[1] = 0.5 * Math.sign(share[1]);
    return [0, 1].map((d) => view.x_of[d][i] + shift[2 * i + d] + share[0] * edges[4 * i + d] +
                share[1] * edges[4 * i + 2 + d]);
}

// As in cleave plot: oblique from this product of direction cosines; depth of what is trimmed [spacings]; damage above
// which a particle has no part of a face. SMOOTH: points on either side over which an oblique face is a mean; GAP: so
// far apart, points without a particle between them belong to the face.
const OBLIQUE = 0.02, TRIMMED = 0.9, RUBBLE_CODE = 0.65 * 254, SMOOTH = 12, GAP = 6;

// Is the part of a face that ends in this point oblique to the lattice?
const isOblique = ([, , , dx, dy]) => Math.abs(dx * dy) >= OBLIQUE * (dx * dx + dy * dy);

// Returns where the points of a face are drawn, null for those without a particle. Displacements of an oblique face are
// means over its neighbourhood, as its particles are at various distances from it. damage: codes, or null.
function faceLine(set, face, damage) {
    const raw = face.map((p) => (p[2] < 0 || damage && damage[p[2]] > RUBBLE_CODE ? null : facePoint(set, p)));
    const first = raw.findIndex(Boolean), last = raw.length - 1 - [...raw].reverse().findIndex(Boolean);
    return face.map((p, k) => {
        const near = [raw.slice(Math.max(k - GAP, 0), k), raw.slice(k, k + GAP)];
        const beside = raw[k] || near.every((part) => part.some(Boolean));
        if (!isOblique(p) || !beside) return raw[k];
        const wide = Math.min(SMOOTH, k - first, last - k), sum = [0, 0];
        let n = 0;
        for (let m = k - wide; m <= k + wide; m++)
            if (raw[m]) n++, sum[0] += raw[m][0] - face[m][0], sum[1] += raw[m][1] - face[m][1];
        return n > 0 ? [p[0] + sum[0] / n, p[1] + sum[1] / n] : null;
    });
}

// Makes the faces of open pre-cracks straight that are oblique to the lattice, as the squares of particles reach beyond
// their lines: blanks the pixels between the faces, and fills those between a face and the particles of its side. to,
// see: as of paintPlane.
function trimFaces(to, see, set) {
    const faces = facesOf(set), reach = TRIMMED * see.scale * set.size.reduce((a, b) => Math.min(a, b), Infinity);
    const onScreen = (point) => point &&
        [to.width / 2 + (point[0] - see.x) * see.scale, to.height / 2 - (point[1] - see.y) * see.scale];
    for (const fill of [false, true])
        for (let m = 0; m + 1 < faces.length; m += 2) {
            const at = [view.faces[m], view.faces[m + 1]].map((line) => line.map(onScreen));
            for (let k = 1; k < faces[m].length; k++) {
                if (!isOblique(faces[m][k]) || at.some((points) => !points[k] || !points[k - 1])) continue;
                for (const side of [0, 1]) trimPart(to, at[side], at[1 - side], k, side ? -1 : 1, reach, fill);
            }
        }
}

// Blanks or fills the pixels beside the part of a face between its points k - 1 and k. own, other: points of this face
// and of the other one [pixel]; left: 1 for the face whose body is on the left of the line, else -1.
function trimPart(to, own, other, k, left, reach, fill) {
    const near = (step) => {
        let at = k;
        while (Math.abs(at + step - k) < 12 && own[at + step]) at += step;
        return own[at];
    };
    const [a, b] = [near(-1), near(1)], length = Math.hypot(b[0] - a[0], b[1] - a[1]) || 1;
    const n = [left * (b[1] - a[1]) / length, -left * (b[0] - a[0]) / length]; // into the body
    const pixel = (x, far) => {
        const [px, py] = [0, 1].map((d) => Math.floor(x[d] + far * n[d]));
        return px >= 0 && py >= 0 && px < to.width && py < to.height ? py * to.width + px : -1;
    };
    const parts = Math.ceil(4 * Math.hypot(own[k][0] - own[k - 1][0], own[k][1] - own[k - 1][1])) || 1;
    for (let part = 0; part < parts; part++) {
        const between = ({[k - 1]: p, [k]: q}) => [0, 1].map((d) => p[d] + (q[d] - p[d]) * part / parts);
        const x = between(own), y = between(other), open = (x[0] - y[0]) * n[0] + (x[1] - y[1]) * n[1];
        if (!(open > 1)) continue;
        for (let far = -1.5; far < Math.min(open, reach) && !fill; far += 0.5) {
            const at = pixel(x, -far);
            if (at >= 0) to.owner[at] = -1, to.pixel[at] = 0xffffffff;
        }
        let last = -1;
        for (let far = 0; far <= reach && fill; far += 0.5) {
            const at = pixel(x, far);
            if (at >= 0 && to.owner[at] < 0) last = far;
        }
        const body = last < 0 ? -1 : pixel(x, last + 1.5);
        for (let far = 0; far <= last && body >= 0 && to.owner[body] >= 0; far += 0.5) {
            const at = pixel(x, far);
            if (at >= 0 && to.owner[at] < 0) to.owner[at] = to.owner[body], to.pixel[at] = to.pixel[body];
        }
    }
}

// Draws the faces of the pre-cracks, view.faces, over the body. to: size of the picture [pixel]; ratio: pixels per CSS
// pixel.
function drawPreCracks(context, to, ratio) {
    context.save();
    context.beginPath();
    context.rect(0, 0, to.width / ratio, to.height / ratio);
    context.clip();
    context.strokeStyle = "#18202a";
    context.lineWidth = 1.4;
    for (const line of view.faces) {
        let pen = false;
        context.beginPath();
        for (const point of line) {
            if (point)
                context[pen ? "lineTo" : "moveTo"](to.width / ratio / 2 + (point[0] - view.x) * view.scale,
                    to.height / ratio / 2 - (point[1] - view.y) * view.scale);
            pen = Boolean(point);
        }
        context.stroke();
    }
    context.restore();
    context.lineWidth = 1;
}
