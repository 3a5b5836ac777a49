// Test code that long_report.sh appends to a copy of a page: operates its controls as a reader would, and replaces the
// page by the measured values.
const wait = (ms) => new Promise((done) => setTimeout(done, ms));
const send = (id, event, value) => (byId(id).value = value, byId(id).dispatchEvent(new Event(event)));
const screen = () => {
    const c = byId("view");
    return c.getContext("2d").getImageData(0, 0, c.width, c.height);
};

// Returns the colour on the canvas at the position (x, y) of a plane body [m].
function colourAt(x, y) {
    const c = byId("view"), ratio = c.width / c.clientWidth, image = screen();
    const px = Math.round(((c.clientWidth - BAR) / 2 + (x - view.x) * view.scale) * ratio),
          py = Math.round((view.height / 2 - (y - view.y) * view.scale) * ratio);
    return Array.from(image.data.slice(4 * (py * c.width + px), 4 * (py * c.width + px) + 3));
}

// Returns the number of pixels that are not white, without the colour bar.
function painted() {
    const image = screen(), edge = image.width * (1 - BAR / byId("view").clientWidth) - 1;
    let n = 0;
    for (let k = 0; k < image.data.length; k += 4)
        if ((k / 4) % image.width < edge && image.data[k] + image.data[k + 1] + image.data[k + 2] < 740) n++;
    return n;
}

// Returns the number of pixels without a particle that are between two particles of their row, at most 4 pixels from
// either.
function slits() {
    const {owner} = buffer, near = (at, step) => [1, 2, 3, 4].some((k) => owner[at + k * step] >= 0);
    return owner.reduce((n, i, at) => n + (i < 0 && near(at, 1) && near(at, -1)), 0);
}

// Returns true if a particle is at the border of the canvas, where a body that does not fit is cut off.
function cutOff() {
    const {owner, width, height} = buffer;
    return owner.some((i, at) => i >= 0 && (at < width || at >= width * (height - 1) || (at + 1) % width < 2));
}

// Returns the number of points of rigid bodies that are outside the canvas.
function rigidOutside() {
    let n = 0;
    forRigids(film.frames[view.frame], view.magnify, (body, x) => {
        const along = (row, k) => row.reduce((sum, c, d) => sum + c * (x[d][k] - view.centre[d]), 0) * view.scale;
        for (let k = 0; k < x[0].length; k++)
            n += Math.abs(along(view.turn[0], k)) > (byId("view").clientWidth - BAR) / 2 ||
                Math.abs(along(view.turn[1], k)) > view.height / 2;
    });
    return n;
}

// Draws four cells of two spacings below sixteen of one, rotated by 0.5 rad. Returns the largest error of their edges
// relative to their sizes, and the number of faces between cells of different size.
function resized() {
    const X = [[], [], []], size = [], [c, s] = [Math.cos(0.5), Math.sin(0.5)];
    const turn = [[c, 0, s], [0, 1, 0], [-s, 0, c]];
    for (const [cells, edge, z] of [[2, 2, 1], [4, 1, 2.5]])
        for (let k = 0; k < cells * cells; k++) {
            const place = [(k % cells + 0.5) * edge, (Math.floor(k / cells) + 0.5) * edge, z];
            place.forEach((v, d) => X[d].push(v)), size.push(edge);
        }
    const set = {n: size.length, X, size, beside: neighbours(X, size, []), other: otherNeighbours(X, size, [])};
    const x = turn.map((row) => size.map((_, i) => row.reduce((sum, e, d) => sum + e * X[d][i], 0)));
    const {edges, joins} = cellShapes(set, x, null, () => true);
    const off = edges.map((e, at) => Math.abs(e / size[Math.floor(at / 9)] - turn[at % 3][Math.floor(at / 3) % 3]));
    return [Math.max(...off), joins.filter((j) => j === RESIZED).length];
}

// Returns the number of cube faces that are painted although a neighbour still covers them, which would look like a
// dotted lattice.
function bareFaces() {
    const frame = film.frames[view.frame], set = particlesOf(film, film.sets[frame.set]), sides = [0, 1, 2, 3, 4, 5];
    const cubes = cellShapes(set, view.x_of, damageOf(frame), () => true);
    const bare = (i, s) => set.beside[s][i] >= 0 && !covered(set, view.x_of, cubes, i, s >> 1, s & 1);
    return Array.from(set.X[0]).reduce((n, _, i) => n + sides.filter((s) => bare(i, s)).length, 0);
}

// Magnifies the displacements of a plane body. Returns the share of its particles on the canvas and, at 4 mm along the
// first pre-crack, the distance of its faces [m] and the darkest red on the canvas.
function magnified(factor) {
    send("magnify", "input", factor);
    const frame = film.frames[view.frame], set = particlesOf(film, film.sets[frame.set]), [x, y] = view.x_of;
    const shown = (i) => Math.abs(x[i] - view.x) * view.scale < (byId("view").clientWidth - BAR) / 2 &&
        Math.abs(y[i] - view.y) * view.scale < view.height / 2;
    const share = Array.from(x.keys()).filter(shown).length / set.n;
    const faces = facesOf(set).slice(0, 2).map((face) => {
        return facePoint(set, face.find((p) => p[0] > 0.004 && p[2] >= 0));
    });
    const red = faces.map(([px, py]) => Math.min(...[-1, 0, 1].map((k) => colourAt(px, py + k / view.scale)[0])));
    return {share, apart: faces.length ? Math.abs(faces[0][1] - faces[1][1]) : 0, red: Math.max(...red)};
}

// Of the points between the faces of the first pre-crack that are more than three pixels apart: returns the number on
// a particle, and the number of all.
function facesShut() {
    const ratio = buffer.height / view.height, shown = [0, 0], [a, b] = view.faces;
    a.forEach((p, k) => {
        if (!p || !b[k] || Math.hypot(p[0] - b[k][0], p[1] - b[k][1]) * view.scale * ratio < 3) return;
        const px = Math.floor(buffer.width / 2 + ((p[0] + b[k][0]) / 2 - view.x) * view.scale * ratio),
              py = Math.floor(buffer.height / 2 - ((p[1] + b[k][1]) / 2 - view.y) * view.scale * ratio);
        shown[0] += buffer.owner[py * buffer.width + px] >= 0, shown[1]++;
    });
    return shown;
}

async function probeFilm(seen) {
    seen.frames = film.frames.length;
    seen.shown_at_first = view.frame;
    seen.limits = [view.low, view.high];
    if (film.dim === 2)
        seen.faces_from = Math.min(...particlesOf(film, film.sets[0]).faces.flat().map((p) => (p[2] < 0 ? 1 : p[0])));
    seen.bare = film.dim === 3 ? bareFaces() : 0;
    seen.slits = film.dim > 1 ? slits() : 0;
    seen.first_field = view.field.name;
    if (film.dim === 2)
        seen.crack_last = colourAt(0.01, 0.0102), seen.ahead_last = colourAt(0.025, 0.0102),
        seen.whole_last = colourAt(0.035, 0.004);
    send("frame", "input", 0);
    seen.when_first = byId("when").textContent;
    if (film.dim === 2) {
        const pixel = 1 / view.scale, near = (x) => [-pixel, 0, pixel].map((dy) => colourAt(x, 0.01 + dy)[0]);
        seen.ahead_first = colourAt(0.025, 0.0102);
        seen.pre_crack = Math.max(...Array.from({length: 50}, (_, k) => Math.min(...near(0.004 + k * 1e-4))));
    }
    byId("play").click();
    for (let k = 0; k < 100 && view.frame < seen.frames - 1; k++) await wait(100);
    seen.played_to = view.frame;
    seen.painted = painted();
    send("field", "change", "von_mises");
    seen.field = view.field.name;
    seen.painted_again = painted();
    if (film.dim === 2) seen.crack_von_mises = colourAt(0.01, 0.0102), seen.whole_von_mises = colourAt(0.035, 0.004);
    if (film.dim === 2) {
        seen.magnified = magnified(200);
        seen.faces_shut = (page.cracks || []).length ? facesShut() : [0, 0];
        send("field", "change", "fragment");
        seen.dark_fragments = view.field.name === "fragment" && !byId("cracks").disabled;
    }
    if (film.dim === 3) {
        const rows = JSON.stringify(view.turn), canvas = byId("view");
        for (const [type, x] of [["pointerdown", 300], ["pointermove", 380], ["pointerup", 380]])
            canvas.dispatchEvent(new PointerEvent(type, {clientX: x, clientY: 300, pointerId: 1}));
        seen.turned = JSON.stringify(view.turn) !== rows;
        turnBy(1, 1.2);
        drawFilm();
        seen.cut_off = cutOff();
        seen.rigid_outside = rigidOutside();
        seen.resized = resized();
        seen.painted_turned = painted();
        send("cut", "input", "1");
        send("cut_at", "input", "0.3");
        seen.painted_cut = painted();
    }
}

// The kinetic energy as it would be beside a hammer of 1 kJ: its name in the key, and how large its curve is against
// what it was.
function besideHammer() {
    const kinetic = history_.columns.find((c) => c.name === "kinetic"), light = kinetic.values;
    const largest = kinetic.high, heavy = (v) => 1000 + v;
    Object.assign(kinetic, {values: light.map(heavy), low: heavy(kinetic.low), high: heavy(kinetic.high)});
    kinetic.shift = flatteningEnergy(kinetic);
    return [curveName(kinetic), largestOf(kinetic) / largest];
}

async function probe() {
    const seen = {
        title: document.title,
        heading: byId("title").textContent,
        cards: byId("cards").textContent,
        tags: document.querySelectorAll("main b").length
    };
    // Pointer capture needs a pointer that the browser knows.
    HTMLCanvasElement.prototype.setPointerCapture = () => {};
    if (film) await probeFilm(seen);
    if (page.history) {
        seen.curves_first = history_.shown.map((c) => [c.name, c.unit, largestOf(c)]);
        seen.over = byId("over").selectedOptions[0].textContent;
        seen.lengths = [quantity(4.17, "m"), quantity(0.417, "m"), quantity(2e4, "m"), unitFor(5, "J/m^2").name,
            quantity(1.67e17, "J"), quantity(9e-16, "J")];
        // Long numbers at an axis have room beside it; of a hundred million only the digits that differ are written.
        seen.room = leftBeside(byId("plot").getContext("2d"), [7e10, 7e10 + 2e3], {factor: 1}, 2 * TIC_ROOM);
        seen.powers = tickText(1.5e8, [5e7, 1e8, 1.5e8]);
        seen.origin = byId("origin").textContent;
        seen.constant = byId("rows").textContent;
        seen.chips = [...document.querySelectorAll("#columns label")].map((l) => l.textContent);
        const sum = () => byId("plot").toDataURL().length, before = sum();
        document.querySelector("#columns input:not(:checked)").click();
        seen.column_added = sum() !== before;
        seen.heavy = besideHammer();
    }
    if (page.table) {
        seen.rows = document.querySelectorAll("#table tbody tr").length;
        seen.series = byId("series").childElementCount;
        seen.axes = study.area && study.area.log;
        const whole = study.points, part = whole.filter((p) => p.x < Math.max(...whole.map((q) => q.x)));
        seen.gap = axesOfStudy(byId("scatter").getContext("2d"), part, whole, 600, 340, {factor: 1}).log.x;
        seen.tics = [0, 1, 2].map((k, at, all) => tickText(7e10 + 1e3 * k, all.map((m) => 7e10 + 1e3 * m)));
        send("wanted", "input", "energy");
        seen.columns = document.querySelectorAll("#table th").length;
    }
    seen.problems = problems;
    document.body.textContent = "SEEN " + JSON.stringify(seen) + " END";
}
probe().catch((fault) => (document.body.textContent =
                              "SEEN " + JSON.stringify({problems: [String(fault), fault.stack]}) + " END"));
