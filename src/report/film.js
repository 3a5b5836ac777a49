// The frames: slider, field, colours, view, cut, readout.

const film = page.film;
const view = {
    frame: 0,
    field: null,
    low: 0,
    high: 1,
    lut: null,
    codes: null,
    scale: 1,
    x: 0,
    y: 0,
    centre: null,
    turn: null,
    x_of: null,
    cells: null,
    faces: null
};
const BAR = 104;         // room for the colour bar [CSS pixel]
const FOOT = [0, 0, 34, 66];  // strip below a body of so many dimensions, for its time, scale and axes [CSS pixel]
const kindNames = ["material points", "peridynamic"];

const rgba = ([red, green, blue]) => (0xff000000 | blue << 16 | green << 8 | red) >>> 0;

// ---- fields ---------------------------------------------------------------------------------------------------------

// Fields that follow from the displacements, which have no arrays of their own.
function displacementFields() {
    const most = Math.hypot(...film.reach), axes = ["x", "y", "z"].slice(0, film.dim);
    if (!(most > 0)) return [];
    const of = (name, scale, low, high, axis) => ({name, unit: "m", scale, low, high, least: low, most: high, axis});
    return (film.dim > 1 ? [of("displacement", "zero", 0, most, -1)] : []).concat(
        axes.map((a, d) => of("displacement_" + a, "signs", -film.reach[d], film.reach[d], d))
            .filter((f) => f.high > 0));
}

// Returns the codes 0 .. 254 of a field at the particles of a frame; 255: none.
function codesOf(field, frame) {
    const set = film.sets[frame.set];
    if (set.fixed[field.name]) return arrayOf(set.fixed[field.name]);
    if (frame.values[field.name]) return arrayOf(frame.values[field.name]);
    const codes = new Uint8Array(set.n);
    if (field.axis === undefined) return codes;
    const u = frame.u.map(arrayOf), factor = film.reach.map((r) => r / 32767);
    for (let i = 0; i < set.n; i++) {
        let value = 0;
        if (field.axis >= 0)
            value = u[field.axis][i] * factor[field.axis];
        else
            for (let d = 0; d < film.dim; d++) value += (u[d][i] * factor[d]) ** 2;
        if (field.axis < 0) value = Math.sqrt(value);
        codes[i] = Math.round(254 * (value - field.low) / (field.high - field.low));
    }
    return codes;
}

// Do the colours of a field show by themselves where cracks are?
const showsCracks = (field) => field.name === "damage" || field.name === "fragment";
const damageOf = (frame) => (frame.values.damage ? arrayOf(frame.values.damage) : null);
const valueOf = (field, code) => field.low + (field.high - field.low) * code / 254;

function nameOf(field, code) {
    if (field.name === "kind") return kindNames[code] || String(code);
    if (field.name === "fragment")
        return code === 65535 ? "no bond left" : code === 0 ? "the heaviest" : "fragment " + code;
    return ((page.names || {})[field.name] || [])[code] || field.name + " " + code;
}

function categoryColour(field, code) {
    if (field.name === "fragment")
        return code === 65535 ? [40, 40, 44] : code === 0 ? fragmentColours[0] : fragmentColours[1 + (code - 1) % 9];
    if (field.name === "kind") return code === 1 ? [44, 110, 180] : [226, 223, 216];
    return partColours[code % partColours.length];
}

// Makes the table of colours by code, for the limits of the view.
function makeLut() {
    const field = view.field, n = field.name === "fragment" ? 65536 : 256, lut = new Uint32Array(n);
    const stops = field.name === "damage" ? scales.damage : scales[field.scale === "signs" ? "signs" : "zero"];
    for (let code = 0; code < n; code++)
        lut[code] = rgba(field.scale === "category" ?
                categoryColour(field, code) :
                scaleColour(stops, (valueOf(field, code) - view.low) / (view.high - view.low)));
    if (field.scale !== "category") lut[255] = rgba([150, 150, 150]);
    view.lut = lut;
}

// ---- drawing --------------------------------------------------------------------------------------------------------

const buffer = {
    image: null,
    owner: null,
    depth: null,
    pixel: null,
    width: 0,
    height: 0
};

function bufferOf(context, width, height) {
    if (buffer.width !== width || buffer.height !== height) {
        Object.assign(buffer, {
            width,
            height,
            image: context.createImageData(width, height),
            owner: new Int32Array(width * height),
            depth: new Float32Array(width * height)
        });
        buffer.pixel = new Uint32Array(buffer.image.data.buffer);
    }
    buffer.pixel.fill(0xffffffff);
    buffer.owner.fill(-1);
    return buffer;
}

function drawFilm() {
    const frame = film.frames[view.frame], foot = FOOT[film.dim];
    const {context, width, height, ratio} = canvasOf(byId("view"), view.height + foot);
    context.fillStyle = "#fff";
    context.fillRect(0, 0, width, height);
    view.codes = codesOf(view.field, frame);
    view.x_of = positionsOf(film, frame, view.magnify);
    if (film.dim === 1)
        drawProfile(context, width, height, frame);
    else {
        const to = bufferOf(context, Math.round((width - BAR) * ratio), Math.round(view.height * ratio));
        paintFrame(to, frame, ratio);
        context.putImageData(to.image, 0, 0);
        if (film.dim === 2) {
            drawRigids(context, to, frame, ratio);
            drawPreCracks(context, to, ratio);
        } else
            drawTriad(context, [width - BAR - 60, height - foot / 2]);
        drawScaleBar(context, width - BAR, height - foot / 2);
        context.fillStyle = "#dde1e8"; // where the picture of the body ends
        context.fillRect(0, view.height, width - BAR, 1);
        context.fillRect(width - BAR, 0, 1, view.height);
        drawColourBar(context, width, height);
    }
    context.fillStyle = "#1d2330";
    if (film.dim === 1)
        context.fillText(timeText(frame), width - 120, 20);
    else
        context.fillText(timeText(frame), 12, height - foot / 2 + 5);
}

function paintFrame(to, frame, ratio) {
    const set = particlesOf(film, film.sets[frame.set]), {lut, codes} = view, damage = damageOf(frame);
    const dark = byId("cracks").checked && !showsCracks(view.field) && damage;
    const colour = (i) => (dark && damage[i] > CRACK_CODE ? INK : lut[codes[i]]);
    if (film.dim === 2) {
        view.cells = cellShapes(set, view.x_of, damage, () => true);
        const plane = {x: view.x, y: view.y, scale: view.scale * ratio};
        paintPlane(to, plane, set, view.x_of, view.cells, colour);
        view.faces = facesOf(set).map((face) => faceLine(set, face, damage));
        trimFaces(to, plane, set);
        return;
    }
    const axis = Number(byId("cut").value), ghost = byId("ghost").checked && damage;
    const place = axis < 0 ? 0 : film.box.low[axis] + byId("cut_at").value * (film.box.high[axis] - film.box.low[axis]);
    const shown = (i) => axis < 0 || set.X[axis][i] <= place;
    const see = {centre: view.centre, scale: view.scale * ratio, turn: view.turn};
    paintSpace(to, see, set, view.x_of, ghost ? () => GHOST : colour, shown, damage);
    paintRigids(to, see, frame, (x) => axis < 0 || x[axis] <= place);
    if (ghost)
        paintSpace(to, see, set, view.x_of, (i) => lut[codes[i]], (i) => damage[i] > CRACK_CODE && shown(i), damage);
}

// How a run goes: "static" in load steps, "cg" or "relaxation" to one equilibrium, else in time.
const solver = ((page.scene || "").match(/^solver: *(\w+)/m) || [])[1], inSteps = solver === "static";
const oneEquilibrium = solver === "cg" || solver === "relaxation";

const timeText = (frame) => {
    if (inSteps) return "load step " + frame.step;
    if (oneEquilibrium) return frame.t > 0 ? "equilibrium" : "without loads";
    const last = film.frames[film.frames.length - 1].t;
    const t = unitFor(last, "s");
    return "t = " + number(frame.t / t.factor) + " " + t.name;
};

// The axes as the body is turned. at: their origin on the canvas.
function drawTriad(context, at) {
    const length = 18;
    context.lineWidth = 1.6;
    ["x", "y", "z"].forEach((name, k) => {
        const tip = [at[0] + length * view.turn[0][k], at[1] - length * view.turn[1][k]];
        context.strokeStyle = context.fillStyle = ["#b2182b", "#2c8a3d", "#2166ac"][k];
        context.beginPath();
        context.moveTo(...at);
        context.lineTo(...tip);
        context.stroke();
        context.fillText(name, tip[0] + 5 * view.turn[0][k] - 3, tip[1] - 7 * view.turn[1][k] + 4);
    });
    context.lineWidth = 1;
}

// A bar of a round length below the body, at the height y of the canvas.
function drawScaleBar(context, width, y) {
    const metre = unitFor(width / view.scale / 5, "m"), raw = width / view.scale / 5 / metre.factor,
          power = 10 ** Math.floor(Math.log10(raw));
    const length = [5, 2, 1].map((f) => f * power).find((l) => l <= raw) || power,
          pixels = length * metre.factor * view.scale;
    context.fillStyle = "#1d2330";
    context.fillRect(130, y - 1, pixels, 3);
    context.fillText(number(length) + " " + metre.name, 138 + pixels, y + 5);
}

function drawColourBar(context, width, height) {
    const field = view.field, left = width - BAR + 12;
    const unit = unitFor(Math.max(Math.abs(view.low), Math.abs(view.high)), field.unit), words = field.name.split("_");
    if (unit.name && field.scale !== "category") words.push("[" + unit.name + "]");
    const top = 20 + 16 * words.length, tall = Math.min(height - top - 30, 360);
    context.fillStyle = "#1d2330";
    words.forEach((word, k) => context.fillText(word, left, 20 + 16 * k));
    if (field.scale === "category") return drawCategories(context, left, top, height);
    if (!(field.most > field.least))
        return [quantity(field.low, field.unit), "everywhere"].forEach(
            (text, k) => context.fillText(text, left, top + 6 + 16 * k));
    const stops = field.name === "damage" ? scales.damage : scales[field.scale === "signs" ? "signs" : "zero"];
    for (let k = 0; k < tall; k++) {
        context.fillStyle = "rgb(" + scaleColour(stops, 1 - k / tall).join() + ")";
        context.fillRect(left, top + 6 + k, 15, 1.5);
    }
    const list = ticks(view.low / unit.factor, view.high / unit.factor, 6);
    context.fillStyle = "#1d2330";
    for (const value of list) {
        const y = top + 6 + tall * (1 - (value * unit.factor - view.low) / (view.high - view.low));
        context.fillRect(left + 15, y - 0.5, 4, 1);
        context.fillText(tickText(value, list), left + 22, y + 4, BAR - 36);
    }
}

// The key of a field with named values: of fragments those without bonds first, then the heaviest ones, up to where the
// colours repeat.
function drawCategories(context, left, top, height) {
    const fragments = view.field.name === "fragment", first = (code) => (fragments && code === 65535 ? -1 : code);
    const list = [...new Set(view.codes)].sort((a, b) => first(a) - first(b));
    const most = Math.min(Math.floor((height - top - 20) / 19), fragments ? fragmentColours.length + 1 : Infinity);
    list.slice(0, most).forEach((code, k) => {
        context.fillStyle = "rgb(" + categoryColour(view.field, code).join() + ")";
        context.fillRect(left, top + 19 * k, 12, 12);
        context.fillStyle = "#1d2330";
        context.fillText(nameOf(view.field, code), left + 17, top + 11 + 19 * k, BAR - 32);
    });
    context.fillStyle = "#1d2330";
    if (list.length > most) context.fillText("and " + (list.length - most) + " more", left, top + 11 + 19 * most);
}

// ---- controls -------------------------------------------------------------------------------------------------------

function setFrame(k) {
    view.frame = Math.min(Math.max(k, 0), film.frames.length - 1);
    const frame = film.frames[view.frame];
    byId("frame").value = view.frame;
    byId("when").textContent = "frame " + frame.number + ", " + timeText(frame) +
        (inSteps || oneEquilibrium ? "" : ", step " + number(frame.step));
    drawFilm();
    if (hasCurves) drawCurves();
}

function setField(name) {
    view.field = film.fields.find((f) => f.name === name) || film.fields[0];
    byId("field").value = view.field.name;
    setLimits(view.field.low, usualEnd(view.field));
}

// The usual upper end of the colours of a field. For damage it is a multiple of 0.1 from 0.5, as in cleave plot.
function usualEnd(field) {
    return field.name === "damage" ? Math.min(Math.max(Math.ceil(10 * field.most - 1e-3) / 10, 0.5), 1) : field.high;
}

function setLimits(low, high) {
    const field = view.field, unit = unitFor(Math.max(Math.abs(field.low), Math.abs(field.high)), field.unit);
    view.low = low;
    view.high = high > low ? high : low + Math.abs(low) * 1e-6 + 1e-30;
    for (const id of ["limits", "auto"])
        byId(id).style.display = field.scale === "category" || !(field.most > field.least) ? "none" : "";
    byId("cracks").disabled = showsCracks(field);
    byId("low").value = Number((low / unit.factor).toPrecision(4));
    byId("high").value = Number((high / unit.factor).toPrecision(4));
    byId("unit").textContent = unit.name;
    makeLut();
    drawFilm();
}

function readLimits() {
    const field = view.field, unit = unitFor(Math.max(Math.abs(field.low), Math.abs(field.high)), field.unit);
    setLimits(byId("low").value * unit.factor, byId("high").value * unit.factor);
}

function play() {
    if (view.playing) return stop();
    if (view.frame === film.frames.length - 1) setFrame(0);
    byId("play").textContent = "❚❚ pause";
    view.playing = setInterval(() => (view.frame < film.frames.length - 1 ? setFrame(view.frame + 1) : stop()), 120);
}

function stop() {
    clearInterval(view.playing);
    view.playing = 0;
    byId("play").textContent = "▶ play";
}

// The box of the body from the start to a frame, apart from what flies off.
function boxOf(frame, magnify) {
    const set = particlesOf(film, film.sets[frame.set]), low = [], high = [];
    const last = positionsOf(film, frame, magnify);
    for (let d = 0; d < film.dim; d++) {
        const range = (values) => {
            const sorted = Float64Array.from(values).sort();
            const beyond = film.dim === 1 ? 0 : Math.floor((magnify === 1 ? 0.01 : 0.001) * sorted.length);
            return [sorted[beyond], sorted[sorted.length - 1 - beyond]];
        };
        let [a, b] = [Infinity, -Infinity];
        for (let i = 0; i < set.n; i++)
            a = Math.min(a, set.X[d][i] - set.size[i] / 2), b = Math.max(b, set.X[d][i] + set.size[i] / 2);
        const [from, to] = range(last[d]), room = (magnify > 1 ? 2 : 0.5) * (b - a);
        low.push(Math.max(Math.min(a, from), a - room));
        high.push(Math.min(Math.max(b, to), b + room));
    }
    return {low, high};
}

// The box of the magnified body in the present frame and five others.
function boxOfFrames(magnify) {
    const last = film.frames.length - 1, shown = [0, 1, 2, 3, 4].map((k) => film.frames[Math.round(k * last / 4)]);
    const boxes = [...new Set([film.frames[view.frame], ...shown])].map((frame) => boxOf(frame, magnify));
    const over = (end, most) => boxes[0][end].map((_, d) => most(...boxes.map((box) => box[end][d])));
    return {low: over("low", Math.min), high: over("high", Math.max)};
}

// Shows the whole body: from the front in the plane, obliquely in space.
function resetView() {
    const box = view.magnify === 1 ? film.box : boxOfFrames(view.magnify);
    view.chosen = view.zoomed = false;
    const {low, high} = boxWithRigids(box, film.frames[view.frame]),
                size = high.map((h, d) => h - low[d]), width = byId("view").clientWidth - BAR;
    if (film.dim === 2) {
        view.height = Math.round(Math.min(Math.max(width * size[1] / size[0] * 1.04, 180), 620));
        view.scale = Math.min(width / size[0], view.height / size[1]) / 1.06;
        [view.x, view.y] = [0, 1].map((d) => (low[d] + high[d]) / 2);
    } else if (film.dim === 3) {
        view.height = 560;
        view.centre = low.map((l, d) => (l + high[d]) / 2);
        view.turn = [[0.8, 0.6, 0], [-0.3, 0.4, 0.866], [0.52, -0.693, 0.5]].map(unitVector);
        view.size = size;
        view.scale = turnedScale();
    } else
        view.height = 380, view.box = box;
    drawFilm();
}

// Scale with which the whole body, as it is turned, is on the canvas [CSS pixel per metre].
function turnedScale() {
    const extent = (row) => view.size.reduce((sum, s, d) => sum + Math.abs(row[d]) * s, 0);
    const width = byId("view").clientWidth - BAR;
    return Math.min(width / extent(view.turn[0]), view.height / extent(view.turn[1])) / 1.12;
}

// Shows the whole body again after a change of its magnification, unless the reader has chosen a view.
function followBody() { view.chosen ? drawFilm() : resetView(); }

const unitVector = (v) => v.map((c) => c / Math.hypot(...v));

// Turns the body by angles about the vertical and the horizontal of the screen. Makes it smaller where it would leave
// the canvas, unless the reader has zoomed.
function turnBy(across, down) {
    const rotate = (a, b, angle) => {
        const [c, s] = [Math.cos(angle), Math.sin(angle)], p = view.turn[a], q = view.turn[b];
        view.turn[a] = p.map((v, k) => c * v + s * q[k]);
        view.turn[b] = q.map((v, k) => c * v - s * p[k]);
    };
    rotate(0, 2, -across);
    rotate(1, 2, down);
    view.turn = view.turn.map(unitVector);
    if (!view.zoomed) view.scale = Math.min(view.scale, turnedScale());
}

function listenToPointer() {
    const canvas = byId("view");
    let from = null;
    canvas.addEventListener(
        "pointerdown", (e) => (from = [e.clientX, e.clientY], canvas.setPointerCapture(e.pointerId)));
    canvas.addEventListener("pointerup", () => (from = null));
    canvas.addEventListener("pointermove", (e) => {
        if (!from) return readParticle(e);
        const [dx, dy] = [e.clientX - from[0], e.clientY - from[1]];
        from = [e.clientX, e.clientY];
        view.chosen = true;
        if (film.dim === 3 && !e.shiftKey)
            turnBy(dx / 150, dy / 150);
        else if (film.dim === 3)
            view.centre = view.centre.map((c, k) => c - (dx * view.turn[0][k] - dy * view.turn[1][k]) / view.scale);
        else
            view.x -= dx / view.scale, view.y += dy / view.scale;
        drawFilm();
    });
    canvas.addEventListener("wheel", (e) => {
        if (film.dim === 1) return;
        e.preventDefault();
        const box = canvas.getBoundingClientRect(), factor = Math.exp(-e.deltaY / 500);
        const off = [e.clientX - box.left - (box.width - BAR) / 2, box.top + view.height / 2 - e.clientY];
        if (film.dim === 2)
            view.x += off[0] / view.scale * (1 - 1 / factor), view.y += off[1] / view.scale * (1 - 1 / factor);
        view.scale *= factor;
        view.chosen = view.zoomed = true;
        drawFilm();
    }, {passive: false});
}

// Says what lies under the pointer.
function readParticle(e) {
    if (film.dim === 1) return;
    const box = byId("view").getBoundingClientRect(), ratio = buffer.height / view.height;
    const px = Math.floor((e.clientX - box.left) * ratio), py = Math.floor((e.clientY - box.top) * ratio);
    const i = px >= 0 && py >= 0 && px < buffer.width && py < buffer.height ? buffer.owner[py * buffer.width + px] : -1;
    byId("readout").textContent = i < 0 ? "" : particleText(i);
}

// Digits of a position that tell apart what is a ten-thousandth of the body apart, wherever the body lies.
function placeDigits({low, high}) {
    const extent = Math.max(...high.map((h, d) => h - low[d])), far = Math.max(...low.concat(high).map(Math.abs));
    return Math.min(Math.max(4 + Math.ceil(Math.log10(far / extent)), 4), 12) || 4;
}

function particleText(i) {
    const frame = film.frames[view.frame], x = positionsOf(film, frame, 1), damage = damageOf(frame);
    const metre = unitFor(Math.max(...film.box.high.map((h, d) => h - film.box.low[d])), "m");
    const code = view.codes[i], field = view.field, value = valueOf(field, code);
    const clipped = field.scale !== "category" && field.axis === undefined &&
        (code === 254 && field.most > field.high * (1 + 1e-6)                      ? "≥ " :
                code === 0 && field.least < field.low - 1e-6 * Math.abs(field.low) ? "≤ " :
                                                                                     "");
    const digits = placeDigits(film.box);
    const parts = ["at (" + x.map((axis) => number(axis[i] / metre.factor, digits)).join(", ") + ") " + metre.name];
    parts.push(field.scale === "category" ?
            field.name + ": " + nameOf(field, code) :
            field.name.replace(/_/g, " ") + " " + (clipped || "") + quantity(value, field.unit, 3));
    if (damage && field.name !== "damage") parts.push("damage " + number(damage[i] / 254, 2));
    return parts.join(" · ");
}

// Share of the particles of the last frame that are part of cracks.
function crackedShare() {
    const damage = damageOf(film.frames[film.frames.length - 1]);
    return damage ? damage.reduce((n, code) => n + (code > CRACK_CODE), 0) / Math.max(damage.length, 1) : 0;
}

// Have particles lost bonds since the first frame?
function bondsBroke() {
    const [first, last] = [film.frames[0], film.frames[film.frames.length - 1]].map(damageOf);
    return last && last.some((code, i) => code > (first && first.length === last.length ? first[i] : 0));
}

// The field to begin with: damage where bonds break, else plastic strain, else von Mises.
function firstField() {
    const asked = new URLSearchParams(location.hash.slice(1)).get("field");
    return [asked, bondsBroke() && "damage", "plastic_strain", "von_mises", "stress_xx", "displacement"].find(
               (name) => film.fields.some((f) => f.name === name)) ||
        film.fields[0].name;
}

function listenToControls() {
    const on = (id, event, call) => byId(id).addEventListener(event, call);
    on("frame", "input", () => (stop(), setFrame(Number(byId("frame").value))));
    on("play", "click", play);
    on("field", "change", () => setField(byId("field").value));
    on("low", "change", readLimits);
    on("high", "change", readLimits);
    on("auto", "click", () => setLimits(view.field.low, view.field.high));
    on("magnify", "input", () => (view.magnify = Math.max(Number(byId("magnify").value), 0), followBody()));
    for (const id of ["cracks", "ghost", "cut", "cut_at"]) on(id, "input", drawFilm);
    on("reset", "click", resetView);
    on("save", "click",
        () => download(page.title + "_" + view.field.name + ".png", byId("view").toDataURL("image/png")));
    on("view", "keydown", (e) => {
        const step = {ArrowRight: 1, ArrowLeft: -1}[e.key];
        if (step) stop(), setFrame(view.frame + step);
        if (e.key === " ") e.preventDefault(), play();
    });
}

function showFilm() {
    section("film");
    film.fields.push(...displacementFields());
    if (film.fields.length === 0)
        film.fields.push(
            {name: "displacement", unit: "m", scale: "zero", low: 0, high: 0, least: 0, most: 0, axis: -1});
    byId("field").append(...film.fields.map((f) => element("option", {value: f.name}, f.name.replace(/_/g, " "))));
    const damaged = film.fields.some((f) => f.name === "damage"),
          hide = (id, gone) => (byId(id).style.display = gone ? "none" : "");
    hide("ghost_label", film.dim < 3 || !damaged), hide("cut_label", film.dim < 3),
        hide("cracks_label", film.dim === 1 || !damaged);
    hide("reset", film.dim === 1);
    byId("cracks").checked = crackedShare() < 0.2;
    byId("cut").append(
        ...["x", "y", "z"].slice(0, film.dim).map((a, d) => element("option", {value: d}, "above " + a)));
    byId("frame").max = film.frames.length - 1;
    byId("hint").textContent = film.dim === 3 ?
        "Drag turns, with Shift it moves; the wheel zooms; the pointer reads values." :
        film.dim === 2 ? "Drag moves; the wheel zooms; the pointer reads values." :
                         "Red: particles with broken bonds.";
    byId("thinned").textContent = thinnedText();
    view.magnify = 1;
    film.box = boxOf(film.frames[film.frames.length - 1], 1);
    view.field = film.fields.find((f) => f.name === firstField());
    view.low = view.field.low, view.high = usualEnd(view.field);
    makeLut();
    resetView();
    setField(view.field.name);
    listenToControls();
    listenToPointer();
    const asked = new URLSearchParams(location.hash.slice(1)).get("frame");
    setFrame(asked === null ? film.frames.length - 1 : Number(asked));
}
