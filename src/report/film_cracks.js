// Pre-cracks in the plane: both faces, as lines that move with the particles beside them.

const ALONG = 0.55;  // a face ends so far beyond the last particle beside it [spacings]

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
                if (dx * normal[0] + dy * normal[1] > 0 && distance < least && along < ALONG * set.size[i])
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

// Draws the faces of the pre-cracks of a frame over the body. to: size of the picture [pixel]; ratio: pixels per CSS
// pixel.
function drawPreCracks(context, to, frame, ratio) {
    const set = particlesOf(film, film.sets[frame.set]);
    context.save();
    context.beginPath();
    context.rect(0, 0, to.width / ratio, to.height / ratio);
    context.clip();
    context.strokeStyle = "#18202a";
    context.lineWidth = 1.4;
    for (const face of facesOf(set)) {
        let pen = false;
        context.beginPath();
        for (const point of face) {
            if (point[2] >= 0) {
                const [x, y] = facePoint(set, point);
                context[pen ? "lineTo" : "moveTo"](to.width / ratio / 2 + (x - view.x) * view.scale,
                    to.height / ratio / 2 - (y - view.y) * view.scale);
            }
            pen = point[2] >= 0;
        }
        context.stroke();
    }
    context.restore();
    context.lineWidth = 1;
}
