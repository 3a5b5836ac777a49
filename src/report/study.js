// Table and curves of a sweep or a convergence study.

const study = {
    columns: [],
    rows: [],
    keys: [],
    figures: [],
    units: {},
    x: 0,
    y: 0,
    points: []
};
const ofComputation = new RegExp("^(laps\\.|threads|wall_|setup_|loop_|output_|memory_|ns_per_|inactive_share|steps|" +
    "time_|particles_|particles$|bonds_|contact\\.pairs|momentum_error|levels\\.|solver\\.|crack\\.tips\\.)");

// Splits CSV with quoted cells into rows.
function csv(text) {
    const rows = [[]];
    for (const [, quoted, plain, end] of text.matchAll(/(?:"((?:[^"]|"")*)"|([^,\r\n]*))(,|\r?\n|$)/g)) {
        rows[rows.length - 1].push(quoted === undefined ? plain : quoted.replace(/""/g, '"'));
        if (end === "") break;
        if (end !== ",") rows.push([]);
    }
    return rows.filter((row) => row.length > 1 || row[0]);
}

const cellValue = (text) => (text === "" || text === undefined ? NaN : Number.parseFloat(text));

function readStudy() {
    const [header, ...rows] = csv(page.table);
    study.columns = header.map((name) => name.replace(/ \[.*\]$/, ""));
    study.rows = rows;
    if (page.kind === "sweep") {
        const end = study.columns.indexOf("steps"), first = end < 0 ? study.columns.length : end;
        study.keys = study.columns.slice(2, first);
        study.figures = study.columns.slice(first).filter(
            (name, k) => new Set(rows.map((row) => row[first + k])).size > 1 || !ofComputation.test(name));
        study.units = page.units || {};
    }
}

const at = (row, name) => row[study.columns.indexOf(name)];

// Returns the unit of the numbers of a varied key: the one that they are given with, else that of numbers without one.
function unitOfKey(key) {
    const cells = study.rows.map((row) => at(row, key)),
          plain = cells.every((c) => c !== "" && Number.isFinite(Number(c)));
    return unitText(plain ? study.units[key] || "" : (cells[0].match(/[^0-9.eE+-]+.*$/) || [""])[0].trim());
}

// Returns the name of a varied key with its unit if its values are numbers without one.
function keyWithUnit(key) {
    const plain = study.rows.every((row) => Number.isFinite(Number(at(row, key)))), unit = unitOfKey(key);
    return key + (plain && unit ? " [" + unit + "]" : "");
}

// ---- table ----------------------------------------------------------------------------------------------------------

function shownFigures() {
    const wanted = byId("wanted").value.toLowerCase().split(/[ ,]+/).filter(Boolean), all = byId("technical").checked;
    return study.figures.filter((name) => (all || !ofComputation.test(name)) &&
            (wanted.length === 0 || wanted.some((word) => name.toLowerCase().includes(word))));
}

function tableOf(header, rows) {
    let order = rows, by = -1, down = 1;
    const table = byId("table"), fill = () => {
        const heads = header.map((name, k) => element("th", {
            onclick: () => {
                down = by === k ? -down : 1, by = k;
                const value = (row) => (Number.isNaN(row[k].value) ? row[k].text : row[k].value);
                order = [...rows].sort((a, b) => (value(a) > value(b) ? down : value(a) < value(b) ? -down : 0));
                fill();
            }
        },
                                     name));
        table.replaceChildren(element("thead", {}, element("tr", {}, ...heads)),
            element("tbody", {},
                ...order.map((row) => element("tr", {},
                                 ...row.map((cell) => element("td", {title: cell.title || ""}, cell.text))))));
    };
    fill();
}

function showSweepTable() {
    const figures = shownFigures().map((name) => {
        const values = study.rows.map((row) => cellValue(at(row, name))).filter(Number.isFinite);
        return {name, unit: unitFor(Math.max(0, ...values.map(Math.abs)), study.units[name] || "")};
    });
    const heads = figures.map(({name, unit}) => name + (unit.name ? " [" + unit.name + "]" : ""));
    tableOf(["run", "state", ...study.keys.map(keyWithUnit), ...heads],
        study.rows.map((row) => [...["run", "state", ...study.keys].map(
                                     (name) => ({text: at(row, name) || "", value: cellValue(at(row, name))})),
                           ...figures.map(({name, unit}) => ({
                               text: number(cellValue(at(row, name)) / unit.factor),
                               value: cellValue(at(row, name)),
                               title: at(row, name)
                           }))]));
}

function showConvergenceTable() {
    const wanted = byId("wanted").value.toLowerCase().split(/[ ,]+/).filter(Boolean), all = byId("technical").checked;
    const rows = study.rows.filter((row) => (all || !ofComputation.test(row[0])) &&
            (wanted.length === 0 || wanted.some((word) => row[0].toLowerCase().includes(word))));
    const finest = rows.length > 0 ? cellValue(at(rows[0], "spacing_0")) : NaN;
    tableOf(
        [
            "figure", "value" + (Number.isFinite(finest) ? " at a spacing of " + quantity(finest, "m") : ""),
            "± (95 %)", "of it scatter", "of it spacing", "behaviour", "order", "limit"
        ],
        rows.map((row) => {
            const unit = at(row, "unit"), cell = (name) => ({
                text: at(row, name) === "" ? "" : quantity(cellValue(at(row, name)), unit),
                value: cellValue(at(row, name)),
                title: at(row, name) + " " + unit
            });
            const plain = (name) => ({
                text: Number.isNaN(cellValue(at(row, name))) ? at(row, name) : number(cellValue(at(row, name)), 3),
                value: cellValue(at(row, name))
            });
            return [
                {text: row[0], value: NaN}, cell("value"), cell("uncertainty"), cell("scatter"), cell("discretisation"),
                {text: at(row, "verdict"), value: NaN}, plain("order"), cell("extrapolated")
            ];
        }));
}

const showTable = () => (page.kind === "sweep" ? showSweepTable() : showConvergenceTable());

// ---- curves ---------------------------------------------------------------------------------------------------------

// Returns true if the texts of values are numbers with one unit or without unit.
function areNumbers(texts) {
    const parts = texts.map((text) => text.match(/^\s*[-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?\s*(.*?)\s*$/i));
    return parts.every((part) => part && part[1] === parts[0][1]);
}

// Points of the sweep: {x, y, series, name}, y NaN where a run does not have the figure; values that are no numbers are
// numbered in their order.
function sweepPoints() {
    const key = study.keys[study.x], figure = study.figures[study.y], others = study.keys.filter((k) => k !== key);
    const words = [...new Set(study.rows.map((row) => at(row, key)))],
          plain = areNumbers(words);
    study.words = plain ? null : words;
    return study.rows
        .map((row) => ({
            x: plain ? cellValue(at(row, key)) : words.indexOf(at(row, key)),
            y: cellValue(at(row, figure)),
            series: others.map((o) => o + " " + at(row, o)).join(", "),
            name: at(row, "run")
        }))
        .sort((a, b) => a.x - b.x);
}

// Returns true if positive values extend over two decades and more.
const overDecades = (values) => Math.min(...values) > 0 && Math.max(...values) >= 99.9999 * Math.min(...values);

// Returns true if the distances of the values, in ascending order, are equal.
function evenlySpaced(values) {
    const own = [...new Set(values)], step = own[1] - own[0];
    return own.every((v, k) => k < 2 || Math.abs(v - own[k - 1] - step) <= 1e-6 * step);
}

// Points of a convergence study: the means at each spacing with their intervals.
function convergencePoints() {
    const row = study.rows[study.y], points = [];
    for (let k = 0; study.columns.includes("mean_" + k); k++) {
        const [x, y, error] = ["spacing_", "mean_", "uncertainty_"].map((name) => cellValue(at(row, name + k)));
        if (Number.isFinite(y)) points.push({x, y, error, series: "", name: at(row, "runs_" + k) + " runs"});
    }
    return points.sort((a, b) => a.x - b.x);
}

// Returns the tics of an axis of words: the words themselves, or their numbers if they are many or long.
function ticsOfWords(words) {
    const short = words.length <= 8 && words.every((word) => word.length <= 16);
    return {short, list: words.map((word, k) => k), text: (k) => (short ? words[k] : String(k))};
}

// Returns the axes of the curves in a canvas of width x height, for the points with a value; all: also those without,
// which a logarithmic axis includes. yUnit: unit of the figure.
function axesOfStudy(context, points, all, width, height, yUnit) {
    const sweep = page.kind === "sweep", spread = (list) => [Math.min(...list), Math.max(...list)];
    const xsOfAll = all.map((p) => p.x), ys = points.flatMap((p) => [p.y - (p.error || 0), p.y + (p.error || 0)]);
    const log = {x: sweep && !study.words && overDecades(xsOfAll) && !evenlySpaced(xsOfAll), y: overDecades(ys)};
    const xs = log.x ? xsOfAll : points.map((p) => p.x);
    const tics = study.words && ticsOfWords(study.words);
    const area = {right: width - 20, top: 40, bottom: height - 50, tics}, range = padded(...spread(ys), log.y);
    area.left = leftBeside(context, range, yUnit, area.bottom - area.top, log.y);
    return axesOf(
        area, sweep ? padded(...spread(tics ? tics.list : xs), log.x) : [0, 1.05 * spread(xs)[1]], range, log);
}

function drawStudy() {
    const sweep = page.kind === "sweep", all = sweep ? sweepPoints() : convergencePoints();
    const points = (study.points = all.filter((p) => Number.isFinite(p.y)));
    const {context, width, height} = canvasOf(byId("scatter"), 340);
    context.fillStyle = "#fff";
    context.fillRect(0, 0, width, height);
    byId("series").replaceChildren();
    if (points.length === 0) return context.fillStyle = "#5d6675", context.fillText("No run has this figure.", 20, 40);
    const unit = sweep ? study.units[study.figures[study.y]] || "" : at(study.rows[study.y], "unit"),
          yUnit = unitFor(Math.max(...points.map((p) => Math.abs(p.y) + (p.error || 0))), unit);
    const area = axesOfStudy(context, points, all, width, height, yUnit), key = sweep ? study.keys[study.x] : "spacing",
          xUnit = sweep ? {factor: 1, name: study.words ? "" : unitOfKey(key)} : unitFor(area.x1, "m");
    const figure = sweep ? study.figures[study.y] : study.rows[study.y][0];
    drawAxes(context, area, xUnit, yUnit,
        study.words && !area.tics.short ? key + ": " + study.words.map((w, k) => k + " is " + w).join(", ") :
                      key + (xUnit.name ? " [" + xUnit.name + "]" : ""),
        figure + (yUnit.name ? " [" + yUnit.name + "]" : ""));
    drawSeries(context, area, all);
    if (!sweep) {
        const words = "means and their 95 % intervals, by scatter and spacing";
        context.fillStyle = "#5d6675";
        context.fillText(words, area.right - context.measureText(words).width, area.top - 14);
    }
    study.area = area, study.xUnit = xUnit, study.yUnit = unit;
}

// Do the points `own` of a series coincide with those of one drawn before, wherever both have values? lists: of points.
function hidesSeries(own, lists, tall) {
    return lists.some((list) => {
        const at = new Map(list.filter((p) => Number.isFinite(p.y)).map((p) => [p.x, p.y]));
        const common = own.filter((p) => Number.isFinite(p.y) && at.has(p.x));
        return common.length > 0 && common.every((p) => Math.abs(p.y - at.get(p.x)) <= 0.004 * tall);
    });
}

// Draws a line through the points of each series, with a gap where a value is missing, and points alone over words. A
// series that coincides with one before is dashed, and its points are rings.
function drawSeries(context, area, points) {
    const drawn = [], tall = Math.abs(area.y1 - area.y0);
    [...new Set(points.map((p) => p.series))].forEach((series, k) => {
        const own = points.filter((p) => p.series === series), over = hidesSeries(own, drawn, tall);
        drawn.push(own);
        context.setLineDash(over ? OVER_CURVE : []);
        context.strokeStyle = context.fillStyle = curveColours[k % curveColours.length];
        context.lineWidth = 1.5;
        context.beginPath();
        let pen = false;
        for (const p of own) {
            const next = Number.isFinite(p.y) && !study.words;
            if (next) context[pen ? "lineTo" : "moveTo"](area.x(p.x), area.y(p.y));
            pen = next;
        }
        context.stroke();
        context.setLineDash([]);
        for (const p of own) {
            if (!Number.isFinite(p.y)) continue;
            context.beginPath(), context.arc(area.x(p.x), area.y(p.y), over ? 7 : 4, 0, 7);
            over ? context.stroke() : context.fill();
            if (p.error)
                context.beginPath(), context.moveTo(area.x(p.x), area.y(p.y - p.error)),
                    context.lineTo(area.x(p.x), area.y(p.y + p.error)), context.stroke();
        }
        if (!series) return;
        const mark = element("i");
        mark.style.background = context.fillStyle;
        byId("series").append(element("span", {}, mark, series));
    });
}

function readPoint(e) {
    const box = byId("scatter").getBoundingClientRect(),
          off = (p) => Math.hypot(study.area.x(p.x) - e.clientX + box.left, study.area.y(p.y) - e.clientY + box.top);
    const near = study.points.reduce((a, b) => (a && off(a) <= off(b) ? a : b), null);
    byId("point").textContent = near && off(near) < 20 ? near.name + ": " + quantity(near.y, study.yUnit, 5) +
            (near.error ? " ± " + quantity(near.error, study.yUnit, 2) : "") :
                                                         "";
}

// Lists the runs of a sweep that have failed, each with its reason.
function showFailures() {
    const failed = study.rows.filter((row) => at(row, "state") === "failed").map((row) => at(row, "run"));
    byId("failures").append(...failed.filter((run) => page.reasons[run]).map(
        (run) => element("li", {}, run + " has failed: " + page.reasons[run])));
}

function showStudy() {
    const sweep = page.kind === "sweep";
    section("study").querySelector("h2").textContent = sweep ? study.rows.length + " runs" : "Figures with error bars";
    const select = (names, chosen, call) => {
        const made = element("select", {onchange: () => (call(Number(made.value)), drawStudy())},
            ...names.map((name, k) => element("option", {value: k, selected: k === chosen}, name)));
        return made;
    };
    const figures = sweep ? study.figures : study.rows.map((row) => row[0]);
    study.y = Math.max(figures.findIndex((name) => /^probes\.|^crack\.(start_time|length_end)/.test(name)), 0);
    byId("axes").append(element("label", {}, "figure ", select(figures, study.y, (k) => (study.y = k))));
    if (sweep && study.keys.length > 1)
        byId("axes").append(element("label", {}, "over ", select(study.keys, 0, (k) => (study.x = k))));
    byId("wanted").addEventListener("input", showTable);
    byId("technical").addEventListener("change", showTable);
    byId("scatter").addEventListener("pointermove", readPoint);
    showFailures();
    showTable();
    if (study.rows.length) drawStudy();
}
