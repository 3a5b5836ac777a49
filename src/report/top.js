// Head, warnings, figures, scene and origin of the page; then the parts that draw.

const summary = (() => {
    try {
        return JSON.parse(page.summary);
    } catch {
        return null;
    }
})();
const technical = new RegExp("^(laps\\.|threads$|processor$|commit$|kernels$|wall_|setup_|loop_|output_seconds|" +
    "memory_|ns_per_|inactive_share|warnings|uncertainty\\.|steps$|time_step|particles|bonds_peak|name$|version$|" +
    "method$|status$|message$|time_end$)");

const isBar = page.dim === 1;

// All entries of the summary as [dotted key, value].
function flat(object, prefix = "") {
    return Object.entries(object).flatMap(
        ([key, value]) =>
            (value !== null && typeof value === "object" ? flat(value, prefix + key + ".") : [[prefix + key, value]]));
}

const unitOf = (key) => (page.units || {})[key] || "";

function showHead() {
    const name = (summary && summary.name) || page.name || page.folder.replace(/\/+$/, "").split("/").pop();
    page.title = name;
    document.title = name + " – Cleave";
    byId("title").textContent = name;
    const facts = [{run: "run", sweep: "sweep", converge: "convergence study"}[page.kind]];
    const method = {
        pd: "peridynamics",
        mpm: "material points",
        adaptive: "adaptive: peridynamics where it cracks, material points elsewhere"
    };
    if (summary)
        facts.push(method[summary.method], number(summary.particles) + " particles", number(summary.steps) + " steps",
            summary.status === "done" ? "" : summary.status + (summary.message ? ": " + summary.message : ""));
    else if (page.kind === "run")
        facts.push("running or interrupted: there is no summary.json yet");
    if (summary && summary.wall_seconds)
        facts.push(quantity(summary.wall_seconds, "s", 3) + " on " + summary.threads + " thread" +
            (summary.threads === 1 ? "" : "s"));
    byId("facts").textContent = facts.filter(Boolean).join(" · ");
}

// The figures that one looks for first.
function showCards() {
    const all = new Map(flat(summary)), wanted = [
        ["crack.start_time", "first bond breaks"], ["crack.length_end", "longest crack grows by"],
        ["crack.tip_speed_max", "largest tip speed"], ["energy.fracture", "fracture energy"],
        ["fragments.count", "fragments"], ["energy.balance_error", "error of the energy balance"]
    ];
    for (const [key, meaning] of wanted) {
        if (isBar && /length_end|tip_speed/.test(key)) continue; // a crack of a bar has no length
        if (!all.has(key) || (all.get(key) === 0 && key !== "energy.balance_error")) continue;
        if (key === "fragments.count" && all.get(key) < 2) continue;
        const angle = key === "crack.length_end" && all.has("crack.angle_deg") ?
            " at " + number(all.get("crack.angle_deg"), 3) + "°" :
            "";
        const value = key.endsWith("_error") ? number(100 * all.get(key), 2) + " %" :
                                               quantity(all.get(key), unitOf(key), 4) + angle;
        const bar = (summary.uncertainty || {})[key];
        byId("cards").append(element("div", {className: "card"}, element("b", {}, value),
            element("span", {}, meaning + (bar ? ", ± " + quantity(bar, unitOf(key), 2) : ""))));
    }
}

function showWarnings(list) {
    if (!list || list.length === 0) return;
    const box = section("warnings"), alike = new Map();
    for (const text of list) {
        const form = text.replace(/[-+.\d]+(e[-+]?\d+)?/g, "#");
        alike.set(form, [...(alike.get(form) || []), text]);
    }
    box.querySelector("h2").textContent = alike.size === 1 ? "One warning" : alike.size + " warnings";
    box.querySelector("ul").append(...[...alike.values()].map(
        (texts) => element(
            "li", {}, texts[0] + (texts.length > 1 ? " (" + (texts.length - 1) + " more with other numbers)" : ""))));
}

function showFigures() {
    const groups = new Map();
    for (const [key, value] of flat(summary)) {
        if (technical.test(key)) continue;
        const cut = key.includes(".") ? key.lastIndexOf(".") : 0, group = cut ? key.slice(0, cut) : "run";
        if (!groups.has(group)) groups.set(group, []);
        groups.get(group).push([cut ? key.slice(cut + 1) : key, value, key]);
    }
    if (groups.size === 0) return;
    const bars = summary.uncertainty || {};
    section("figures").querySelector("div").append(
        ...[...groups].map(
            ([group, list]) => element("div", {},
                element("h3", {}, group.replace(/\.(\d+)/g, (all, k) => " " + (Number(k) + 1)).replace(/[._]/g, " ")),
                element("table", {},
                    ...list
                        .map(([name, value, key]) =>
                                 element("tr", {}, element("td", {}, name.replace(/_/g, " ")),
                                     element("td", {
                                         className: typeof value === "number" ? "number" : "",
                                         title: key + " = " + value + " " + unitOf(key)
                                     },
                                         (typeof value === "number" ? quantity(value, unitOf(key), 5) : String(value)) +
                                             (bars[key] ? " ± " + quantity(bars[key], unitOf(key), 2) : ""))))))));
    if (Object.keys(bars).length)
        byId("figures").append(element("p", {className: "soft small"},
            "± is the half-width of the 95 % interval, from a convergence study of this scene."));
}

function showOrigin() {
    const rows = [["folder", page.folder]];
    if (summary)
        rows.push(["cleave", summary.version + (summary.commit ? " (commit " + summary.commit + ")" : "")],
            ["threads, kernels", summary.threads + ", " + summary.kernels], ["processor", summary.processor],
            [
                "time",
                quantity(summary.wall_seconds, "s", 3) + ", of it set-up " + quantity(summary.setup_seconds, "s", 3) +
                    ", steps " + quantity(summary.loop_seconds, "s", 3)
            ],
            ["largest memory", number(summary.memory_peak_bytes / 1e6, 3) + " MB"],
            [
                "time step",
                summary.time_step && !inSteps && !oneEquilibrium ? // loads are not applied by time steps there
                    quantity(summary.time_step, "s") + ", critical " + quantity(summary.time_step_critical, "s") :
                    ""
            ],
            [
                "particles",
                number(summary.particles) + ", peridynamic " + number(summary.particles_pd_start) + " at the start, " +
                    number(summary.particles_pd_end) + " at the end"
            ]);
    rows.push(["run ended", page.ended], [
        "page made",
        page.made + " by cleave " + page.version + (page.commit ? " (commit " + page.commit + ")" : "") + " on " +
            page.machine
    ]);
    byId("origin").querySelector("table").append(...rows.filter(([, text]) => text).map(([what,
        text]) => element("tr", {}, element("td", {className: "soft"}, what), element("td", {}, text))));
    if (!page.scene) return;
    const file = page.title.replace(/[^A-Za-z0-9_.-]/g, "_") + ".yaml", save = element("button", {}, "save " + file);
    save.addEventListener(
        "click", () => download(file, URL.createObjectURL(new Blob([page.scene], {type: "text/yaml"}))));
    byId("repeat").append(element("p", {}, "To repeat it, ", save, " and run ", element("code", {}, commandOf(file)),
        page.kind === "run"            ? ". The result is the same to the last bit on any number of threads." :
            page.options === undefined ? ", with the options that it was given." :
            page.kind === "converge"   ? ". A machine of another speed may fit other runs into the budget." :
                                         "."));
}

// The command that repeats what the page shows.
function commandOf(file) {
    if (page.kind === "run") return "cleave run " + file + " -t " + (summary ? summary.threads : 1);
    return "cleave " + page.kind + " " + file + (page.options ? " " + page.options : "");
}

function showScene() {
    if (!page.scene) return;
    const box = section("scene");
    box.querySelector("summary").textContent =
        page.kind === "run" ? "The scene as run, with every default" : "The scene, without what varies";
    box.querySelector("pre").textContent = page.scene;
}

function showPictures() {
    if (page.picture)
        section("picture").append(pictureOf(page.picture, "body, cracks, loads and probes before the run"));
    else if (page.picture_missing)
        section("picture").append(element("p", {className: "soft"}, "There is no picture: " + page.picture_missing));
    for (const {name, of} of page.pictures || [])
        if (of) section("pictures").append(element("h3", {}, name), pictureOf(of, name));
    const left = page.pictures_left_out || [];
    if (left.length > 0)
        section("pictures").append(element("p", {className: "soft"},
            "A page shows at most 12 pictures, as PNG or SVG. Not shown, in the folder pictures of the study: " +
                left.join(", ") + ". For PNG, give the command of the study again with --format png."));
}

function redraw() {
    if (film) drawFilm();
    if (hasCurves) drawCurves();
    if (page.table) drawStudy();
}

if (page.table) readStudy();
showHead();
if (summary) showCards(), showFigures();
showWarnings(summary ? summary.warnings : page.warnings);
showPictures();
showOrigin();
showScene();
if (hasCurves) showCurves();
if (film) showFilm();
if (page.table) showStudy();
window.addEventListener("resize", redraw);
