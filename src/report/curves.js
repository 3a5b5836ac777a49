// Curves: axes, and the columns of history.csv, one panel for each unit.

const TIC_ROOM = 42;  // height that a tic of a vertical axis takes [CSS pixel]

// Returns a plot area with the maps x(value) and y(value) to pixels, and back. log: {x, y}, true for a logarithmic
// axis.
function axesOf(area, [x0, x1], [y0, y1], log = {}) {
    const along = (v, low, high, logarithmic) =>
        (logarithmic ? Math.log(v / low) / Math.log(high / low) : (v - low) / (high - low));
    const x = (v) => area.left + along(v, x0, x1, log.x) * (area.right - area.left);
    const y = (v) => area.bottom - along(v, y0, y1, log.y) * (area.bottom - area.top);
    const back = (px) => x0 + (px - area.left) / (area.right - area.left) * (x1 - x0);
    return {...area, x, y, x0, x1, y0, y1, log, back};
}

function padded(low, high, logarithmic) {
    if (logarithmic) return padded(Math.log10(low), Math.log10(high)).map((power) => 10 ** power);
    if (!(high > low)) return [low - (Math.abs(low) || 1) * 0.5, high + (Math.abs(high) || 1) * 0.5];
    return [low - 0.05 * (high - low), high + 0.05 * (high - low)];
}

// Returns {list, text}: the tics of an axis from low to high, at most about `most`, and the text of a number at it.
function ticsOf(low, high, most, logarithmic) {
    const list = (logarithmic ? decades : ticks)(low, high, most);
    return {list, text: logarithmic ? decadeText : (v) => tickText(v, list)};
}

// Returns the left end of a plot area, beside which the numbers at its vertical axis from low to high have room. tall:
// height of the area [CSS pixel].
function leftBeside(context, [low, high], unit, tall, logarithmic) {
    const {list, text} = ticsOf(low / unit.factor, high / unit.factor, tall / TIC_ROOM, logarithmic);
    return Math.max(76, 12 + Math.ceil(Math.max(0, ...list.map((v) => context.measureText(text(v)).width))));
}

function drawAxes(context, a, xUnit, yUnit, xLabel, yLabel) {
    const xs = a.tics || ticsOf(a.x0 / xUnit.factor, a.x1 / xUnit.factor, (a.right - a.left) / 90, a.log.x),
          ys = ticsOf(a.y0 / yUnit.factor, a.y1 / yUnit.factor, (a.bottom - a.top) / TIC_ROOM, a.log.y);
    context.lineWidth = 1;
    context.strokeStyle = "#e8eaee";
    context.fillStyle = "#5d6675";
    context.textAlign = "right";
    for (const v of ys.list) {
        const y = a.y(v * yUnit.factor);
        context.beginPath(), context.moveTo(a.left, y), context.lineTo(a.right, y), context.stroke();
        context.fillText(ys.text(v), a.left - 7, y + 4);
    }
    context.textAlign = "center";
    for (const v of xs.list) {
        const x = a.x(v * xUnit.factor);
        context.beginPath(), context.moveTo(x, a.top), context.lineTo(x, a.bottom), context.stroke();
        if (xLabel) context.fillText(xs.text(v), x, a.bottom + 16);
    }
    context.strokeStyle = "#8a93a2";
    context.beginPath(), context.moveTo(a.left, a.top), context.lineTo(a.left, a.bottom),
        context.lineTo(a.right, a.bottom), context.stroke();
    context.fillStyle = "#1d2330";
    if (xLabel) context.fillText(xLabel, (a.left + a.right) / 2, a.bottom + 35);
    context.textAlign = "left";
    context.fillText(yLabel, 6, a.top - 9);
}

// ---- history --------------------------------------------------------------------------------------------------------

// What a column is called in pictures: the crack length of the file is what has grown beyond the pre-cracks.
const labels = {crack_length: "crack growth"};
const labelOf = (c) => (c.name === "step" && inSteps ? "load step" : labels[c.name] || c.name.replace(/_/g, " "));

const hasCurves = page.history !== undefined && page.history.rows > 1;
const history_ = {
    columns: [],
    shown: [],
    over: 0,
    zoom: null,
    panels: [],
    at: null
};

function readColumns() {
    history_.columns = page.history.header.split(",").map((cell, k) => {
        const [, name, unit] = cell.match(/^(.*?)(?: \[(.*)\])?$/), values = arrayOf(page.history.columns[k]);
        let [low, high] = [Infinity, -Infinity];
        for (const v of values)
            if (Number.isFinite(v)) low = Math.min(low, v), high = Math.max(high, v);
        return {name, unit: unit && unit !== "1" ? unit : "", values, low, high, shift: 0};
    });
    if (isBar) history_.columns = history_.columns.filter((c) => c.name !== "crack_length"); // which a bar has not
    const kinetic = history_.columns.find((c) => c.name === "kinetic");
    if (kinetic) kinetic.shift = flatteningEnergy(kinetic);
}

// The largest magnitude of a column in pictures, where its shift is subtracted from its values.
const largestOf = (c) => Math.max(Math.abs(c.low - c.shift), Math.abs(c.high - c.shift));
const varies = (c) => c.high > c.low;

// Returns the kinetic energy at the start [J] if it would flatten the curves of all other energies, as that of a heavy
// hammer, else 0; by the rule of cleave plot.
function flatteningEnergy(kinetic) {
    const start = kinetic.values[0], changes = {...kinetic, shift: start};
    const most = Math.max(...history_.columns.map((c) => (c === kinetic ? changes : c))
                              .filter((c) => c.unit === "J").map(largestOf).filter(Number.isFinite));
    return start > 10 * most && most > 1e-6 * start ? start : 0;
}

// The name of a column beside its curve, with what is subtracted from it.
const curveName = (c) => labelOf(c) + (c.shift ? " - " + quantity(c.shift, c.unit, 4) : "");

// Columns of the history by what matters: energies, forces, the length of the crack, then the others; of one unit the
// largest values first, so that a column of zeros is last.
function columnsByWeight() {
    const kind = (c) => (c.unit === "J" ? 0 : c.unit === "N" ? 1 : c.name === "crack_length" ? 2 : 3);
    const size = (c) => (Number.isFinite(largestOf(c)) ? largestOf(c) : 0);
    const first = new Map(), order = history_.columns.map((c, k) => ({c, k}));
    for (const {c, k} of order)
        if (!first.has(c.unit)) first.set(c.unit, k); // units in the order of the file
    return order
        .sort((a, b) => kind(a.c) - kind(b.c) || first.get(a.c.unit) - first.get(b.c.unit) || size(b.c) - size(a.c) ||
                  a.k - b.k)
        .map(({c}) => c);
}

// Columns to begin with: energies and up to three forces, those that are more than a line above zero, and the length of
// the crack if one grows.
function columnsToBegin() {
    const seen = (unit) => {
        const own = columnsByWeight().filter((c) => varies(c) && c.unit === unit);
        return own.filter((c) => largestOf(c) > 5e-4 * largestOf(own[0]));
    };
    return [...seen("J"), ...seen("N").slice(0, 3),
        ...history_.columns.filter((c) => varies(c) && c.name === "crack_length")];
}

// Is a constant round-off beside the other values of its unit?
function isRoundOff(c) {
    const alike = history_.columns.filter((o) => o.unit === c.unit);
    const ends = alike.flatMap((o) => [o.low, o.high]).filter(Number.isFinite);
    return Math.abs(c.low) < 1e-15 * Math.max(...ends.map(Math.abs));
}

function showColumns() {
    const groups = new Map(), constant = [];
    columnsByWeight().forEach((c) => {
        if (history_.columns.indexOf(c) < 2 && /^(time|step|load_step)$/.test(c.name)) return;
        if (!(c.high >= c.low)) return; // no values
        if (!varies(c)) return constant.push(labelOf(c) + " = " + quantity(isRoundOff(c) ? 0 : c.low, c.unit));
        if (!groups.has(c.unit)) groups.set(c.unit, []);
        groups.get(c.unit).push(c);
    });
    for (const [unit, list] of groups)
        byId("columns").append(element("div", {className: "chips"},
            element("span", {className: "unit"}, unit ? "[" + unitText(unit) + "]" : "[1]"), ...list.map((c) => {
                const box = element("input", {
                    type: "checkbox",
                    checked: history_.shown.includes(c),
                    onchange: () => {
                        history_.shown =
                            columnsByWeight().filter((o) => (o === c ? box.checked : history_.shown.includes(o)));
                        drawCurves();
                    }
                });
                c.mark = element("i");
                return element("label", {title: c.name}, box, c.mark, labelOf(c));
            })));
    const said = [
        page.history.rows < page.history.listed ?
            number(page.history.rows) + " of " + number(page.history.listed) + " lines of history.csv." :
            "",
        constant.length ? "Constant: " + constant.join(", ") + "." : "",
        groups.size ? "" : "Nothing but the time changes."
    ];
    byId("rows").textContent = said.join(" ");
}

// The shown columns by their units, one panel each.
function panelsOf() {
    const units = [...new Set(history_.shown.map((c) => c.unit))];
    return units.map((unit) => ({unit, columns: history_.shown.filter((c) => c.unit === unit)}));
}

function drawCurves() {
    const panels = panelsOf();
    byId("plot").style.display = panels.length ? "" : "none";
    const each = panels.length > 2 ? 170 : 220, over = history_.columns[history_.over];
    const {context, width, height} = canvasOf(byId("plot"), Math.max(panels.length, 1) * (each + 34) + 44);
    const zoom = history_.zoom || [over.low, over.high > over.low ? over.high : over.low + 1],
          xUnit = unitFor(Math.max(Math.abs(over.low), Math.abs(over.high)), over.unit);
    context.fillStyle = "#fff";
    context.fillRect(0, 0, width, height);
    for (const c of history_.columns)
        if (c.mark) c.mark.style.background = "";
    for (const panel of panels) measurePanel(panel, over, zoom);
    const left = Math.max(...panels.map((panel) => leftBeside(context, panel.range, panel.shownUnit, each - 12)));
    panels.forEach((panel, k) => drawPanel(context, panel, over, zoom, xUnit,
                       {left, right: width - 18, top: 28 + k * (each + 34), bottom: k * (each + 34) + each + 16},
                       k === panels.length - 1));
    history_.panels = panels;
    drawMarks(context, over);
}

// Sets the ends of the vertical axis of a panel, panel.range, and its unit.
function measurePanel(panel, over, zoom) {
    let [low, high] = [Infinity, -Infinity];
    const inside = (k) => over.values[k] >= zoom[0] && over.values[k] <= zoom[1];
    for (const c of panel.columns)
        for (let k = 0; k < c.values.length; k++)
            if (inside(k) && Number.isFinite(c.values[k]))
                low = Math.min(low, c.values[k] - c.shift), high = Math.max(high, c.values[k] - c.shift);
    if (!(high >= low)) low = 0, high = 1;
    panel.shownUnit = unitFor(Math.max(Math.abs(low), Math.abs(high)), panel.unit);
    panel.range = padded(low, high);
}

// Pattern of a curve that coincides with one drawn before, which is seen between the dashes [CSS pixel].
const OVER_CURVE = [7, 7];

// Does curve k of a panel hide one drawn before? As in cleave plot: away from 0 they differ by less than the width of a
// line, in all samples or in more than a fourth of them.
function hidesAnother(panel, k) {
    const own = panel.columns[k], wide = 0.004 * (panel.range[1] - panel.range[0]), {isFinite} = Number;
    return panel.columns.slice(0, k).some((c) => {
        let [apart, hidden] = [0, 0];
        c.values.forEach((value, i) => {
            const off = Math.abs(value - c.shift - own.values[i] + own.shift);
            if (isFinite(value) !== isFinite(own.values[i]) || off > wide) apart++;
            if (off <= wide && Math.abs(value - c.shift) > 3 * wide) hidden++;
        });
        return hidden > 0 && (apart === 0 || hidden > 0.25 * c.values.length);
    });
}

function drawPanel(context, panel, over, zoom, xUnit, area, lowest) {
    const unit = panel.shownUnit, a = axesOf(area, zoom, panel.range);
    const names = panel.columns.length === 1 ? curveName(panel.columns[0]) : "";
    drawAxes(context, a, xUnit, unit,
        lowest ? labelOf(over) + (xUnit.name ? " [" + xUnit.name + "]" : "") : "",
        (names + (unit.name ? " [" + unit.name + "]" : "")).trim());
    context.save();
    context.beginPath(), context.rect(a.left, a.top - 2, a.right - a.left, a.bottom - a.top + 4), context.clip();
    panel.columns.forEach((c, k) => {
        context.strokeStyle = curveColours[k % curveColours.length];
        if (c.mark) c.mark.style.background = context.strokeStyle;
        context.lineWidth = 1.7;
        context.setLineDash(hidesAnother(panel, k) ? OVER_CURVE : []);
        context.beginPath();
        let pen = false;
        for (let i = 0; i < c.values.length; i++) {
            if (!Number.isFinite(c.values[i]))
                pen = false;
            else
                context[pen ? "lineTo" : "moveTo"](a.x(over.values[i]), a.y(c.values[i] - c.shift)), pen = true;
        }
        context.stroke();
    });
    context.setLineDash([]);
    context.restore();
    if (panel.columns.length > 1) drawKey(context, panel, a);
    panel.axes = a;
}

function drawKey(context, panel, a) {
    let x = a.left + 44;
    panel.columns.forEach((c, k) => {
        const name = curveName(c);
        context.fillStyle = curveColours[k % curveColours.length];
        context.fillRect(x, a.top - 16, hidesAnother(panel, k) ? 5 : 14, 3);
        context.fillRect(x + 9, a.top - 16, 5, 3);
        context.fillStyle = "#1d2330";
        context.fillText(name, x + 19, a.top - 10);
        x += context.measureText(name).width + 38;
    });
}

// Vertical lines: the time of the frame above, the sample under the pointer, the range that is dragged.
function drawMarks(context, over) {
    const line = (value, colour) => {
        for (const {axes: a} of history_.panels) {
            if (!(value >= a.x0 && value <= a.x1)) continue;
            context.strokeStyle = colour;
            context.beginPath(), context.moveTo(a.x(value), a.top), context.lineTo(a.x(value), a.bottom),
                context.stroke();
        }
    };
    context.lineWidth = 1;
    const clock = frameClock();
    if (film && clock) line(film.frames[view.frame][clock], "#d55e00");
    if (history_.at !== null) line(over.values[history_.at], "#5d6675");
    for (const {axes: a} of history_.panels)
        if (history_.drag)
            context.fillStyle = "#0a5fa522",
            context.fillRect(
                Math.min(...history_.drag), a.top, Math.abs(history_.drag[1] - history_.drag[0]), a.bottom - a.top);
}

// The property of frames that the curves are drawn over, "t" or "step"; null: another column.
const frameClock = () => ({time: "t", step: "step"}[history_.columns[history_.over].name] || null);

function sampleAt(px) {
    const over = history_.columns[history_.over], wanted = history_.panels[0].axes.back(px);
    let best = 0;
    for (let k = 1; k < over.values.length; k++)
        if (Math.abs(over.values[k] - wanted) < Math.abs(over.values[best] - wanted)) best = k;
    return best;
}

function readValues() {
    const k = history_.at, over = history_.columns[history_.over];
    byId("values").textContent = k === null ?
        "" :
        [over].concat(history_.shown).map((c) => labelOf(c) + " " + quantity(c.values[k], c.unit, 5)).join(" · ");
}

function listenToCurves() {
    const canvas = byId("plot"), at = (e) => e.clientX - canvas.getBoundingClientRect().left;
    canvas.addEventListener(
        "pointerdown", (e) => (history_.drag = [at(e), at(e)], canvas.setPointerCapture(e.pointerId)));
    canvas.addEventListener("pointermove", (e) => {
        if (history_.panels.length === 0) return;
        if (history_.drag) history_.drag[1] = at(e);
        history_.at = sampleAt(at(e));
        readValues();
        drawCurves();
    });
    canvas.addEventListener("pointerup", (e) => {
        const [from, to] = history_.drag || [0, 0];
        history_.drag = null;
        if (history_.panels.length === 0) return;
        const a = history_.panels[0].axes;
        if (Math.abs(to - from) > 6)
            history_.zoom = [a.back(Math.min(from, to)), a.back(Math.max(from, to))];
        else if (film && frameClock())
            showFrameOf(a.back(at(e)));
        drawCurves();
    });
    canvas.addEventListener("pointerleave", () => (history_.at = null, readValues(), drawCurves()));
    canvas.addEventListener("dblclick", () => (history_.zoom = null, drawCurves()));
    byId("unzoom").addEventListener("click", () => (history_.zoom = null, drawCurves()));
    byId("over").addEventListener(
        "change", () => (history_.over = Number(byId("over").value), history_.zoom = null, drawCurves()));
}

// Shows the frame nearest to a time, or to a step if the curves are drawn over it.
function showFrameOf(at) {
    const off = film.frames.map((f) => Math.abs(f[frameClock()] - at));
    stop();
    setFrame(off.indexOf(Math.min(...off)));
}

function showCurves() {
    section("curves");
    readColumns();
    history_.shown = columnsToBegin();
    if (inSteps) history_.over = Math.max(history_.columns.findIndex((c) => c.name === "step"), 0);
    byId("over").append(...history_.columns.map((c, k) => element("option", {value: k}, labelOf(c)))
                            .filter((o, k) => varies(history_.columns[k])));
    byId("over").value = history_.over;
    showColumns();
    listenToCurves();
    drawCurves();
}
