// What all parts of the page share: data, elements, numbers with units, colours.

const page = JSON.parse(document.getElementById("page").textContent);
const decoded = new Map();

// Returns the typed array that a reference {array, type, length} names; decoded when it is first asked for.
function arrayOf(reference) {
    if (!decoded.has(reference.array)) {
        const text = atob(document.getElementById("array" + reference.array).textContent);
        const bytes = new Uint8Array(text.length);
        for (let k = 0; k < text.length; k++) bytes[k] = text.charCodeAt(k);
        const types = {u8: Uint8Array, u16: Uint16Array, i16: Int16Array, f32: Float32Array};
        decoded.set(reference.array, new types[reference.type](bytes.buffer));
    }
    return decoded.get(reference.array);
}

function pictureOf(reference, name) {
    const format = {png: "png", svg: "svg+xml"}[reference.type];
    const source = "data:image/" + format + ";base64," + document.getElementById("array" + reference.array).textContent;
    return element("img", {src: source, alt: name});
}

const byId = (id) => document.getElementById(id);

// Creates an element; texts become text nodes, so that no text of a scene is markup.
function element(tag, properties, ...children) {
    const made = Object.assign(document.createElement(tag), properties || {});
    made.append(...children);
    return made;
}

// Shows the section with this id, and returns it.
function section(id) {
    byId(id).hidden = false;
    return byId(id);
}

// ---- numbers --------------------------------------------------------------------------------------------------------

const prefixes = page.prefixes; // [factor, name], the largest first

// Returns {factor, name}: the unit in which values up to `largest` have few digits before the point.
function unitFor(largest, unit) {
    const size = Math.abs(largest);
    if (unit === "degree") return {factor: 1, name: "°"};
    if (unit === "m" && size >= 0.9995 && size < 999.5) return {factor: 1, name: "m"};
    if (unit === "m" && size >= 999.5) return {factor: 1e3, name: "km"};
    if (unit === "m" && size > 5e-4) return {factor: 1e-3, name: "mm"};
    if (/^m(\^2|²)$/.test(unit) && size > 0) {
        const squares =
            [[1e5, 1e6, "km²"], [0.1, 1, "m²"], [1e-8, 1e-6, "mm²"], [1e-14, 1e-12, "µm²"], [0, 1e-18, "nm²"]];
        const [, factor, name] = squares.find(([least]) => size >= least);
        return {factor, name};
    }
    if (!/^(s|m|Pa|J|N|m\/s|W|J\/m[²³]|N\/m|Pa√m)$/.test(unitText(unit))) return {factor: 1, name: unitText(unit)};
    const [factor, prefix] = prefixes.find(([f]) => size >= f * 0.9995) || [1, ""]; // 0, or round-off
    return {factor, name: prefix + unitText(unit)};
}

// A unit as it is written: m², not m^2.
const unitText = (unit) => (unit || "").replace(" m^(1/2)", "√m")
                               .replace(/\^([23])(?!\d)/g, (all, power) => " ²³"[power - 1]);

const powerOfTen = (power) =>
    "10" + [...String(power)].map((c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]).join("");

// Writes a number as a multiple of a power of ten, with `digits` significant digits, without zeros at the end.
const exponential = (value, digits) => value.toExponential(digits - 1)
                                           .replace(/\.?0+e/, "e")
                                           .replace(/e\+?(.*)/, (all, power) => "·" + powerOfTen(power));

// Writes a number with `digits` significant digits, without zeros at the end.
function number(value, digits = 4) {
    if (value === null || value === undefined || Number.isNaN(value)) return "–";
    if (Number.isInteger(value) && Math.abs(value) < 1e15) return value.toLocaleString("en").replace(/,/g, "\u202f");
    const size = Math.abs(value);
    if (size >= 1e6 || size < 1e-3) return exponential(value, digits);
    const text = value.toPrecision(digits);
    return text.includes(".") && !text.includes("e") ? text.replace(/\.?0+$/, "") : String(Number(text));
}

// Writes a value in SI units with the unit that suits it.
function quantity(value, unit, digits) {
    const u = unitFor(value, unit);
    return (number(value / u.factor, digits) + (u.name === "°" ? "" : " ") + u.name).trim();
}

// Returns about `most` round numbers from low to high.
function ticks(low, high, most) {
    const raw = (high - low) / Math.max(most, 1), power = 10 ** Math.floor(Math.log10(raw));
    const step = [1, 2, 2.5, 5, 10].map((f) => f * power).find((s) => s >= raw * 0.999) || raw;
    const list = [];
    for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step && list.length < 50; k++)
        list.push(k * step);
    return list;
}

// Tics with more characters than this are written with powers of ten where that is shorter.
const LONGEST_TIC = 8;

// Writes a number at an axis whose tics are at the numbers in `list`, with so many digits that they are distinct.
const tickText = (value, list) => {
    const step = list.length > 1 ? Math.abs(list[1] - list[0]) : Math.abs(value) || 1;
    if (Math.abs(value) < 1e-9 * step) return "0";
    const power = (v) => Math.floor(Math.log10(v) + 1e-9), largest = Math.max(...list.map(Math.abs), Math.abs(value));
    const digits = Math.min(Math.max(power(largest) - power(step) + 2, 4), 12);
    const plain = (v) => String(Number(v.toPrecision(digits))), powers = (v) => exponential(v, digits);
    const longest = (write) => Math.max(...list.map((v) => write(v).length));
    if (largest >= 1e5 || step < 1e-4)
        return (longest(plain) > LONGEST_TIC && longest(powers) < longest(plain) ? powers : plain)(value);
    return String(Number(value.toFixed(Math.max(0, Math.ceil(-Math.log10(step)) + 1))));
};

// Returns at most about `most` powers of ten from low to high, and the text of one at an axis.
function decades(low, high, most) {
    const first = Math.ceil(Math.log10(low) - 1e-9), last = Math.floor(Math.log10(high) + 1e-9);
    const step = Math.max(Math.ceil((last - first) / most), 1), list = [];
    for (let k = first; k <= last; k += step) list.push(10 ** k);
    return list;
}

const decadeText = (value) => (value >= 0.9e-3 && value < 2e5 ? String(Number(value.toPrecision(4))) :
                                                              powerOfTen(Math.round(Math.log10(value))));

// ---- colours --------------------------------------------------------------------------------------------------------

// Colours of the pictures of cleave plot: viridis; RdBu with a grey middle; damage.
const scales = {
    zero: [
        [0, 68, 1, 84], [0.125, 71, 45, 123], [0.25, 59, 82, 139], [0.375, 44, 114, 142], [0.5, 33, 145, 140],
        [0.625, 40, 174, 128], [0.75, 94, 201, 98], [0.875, 173, 220, 48], [1, 253, 231, 37]
    ],
    signs: [
        [0, 5, 48, 97], [0.1, 33, 102, 172], [0.2, 67, 147, 195], [0.3, 146, 197, 222], [0.4, 200, 217, 228],
        [0.5, 226, 226, 226], [0.6, 240, 209, 192], [0.7, 244, 165, 130], [0.8, 214, 96, 77], [0.9, 178, 24, 43],
        [1, 103, 0, 31]
    ],
    damage: [
        [0, 226, 228, 231], [0.12, 246, 220, 190], [0.35, 240, 160, 110], [0.6, 214, 80, 62], [0.8, 158, 24, 42],
        [1, 84, 2, 24]
    ],
};
const fragmentColours = [
    [212, 214, 217], [68, 119, 170], [238, 153, 51], [34, 136, 51], [170, 51, 119], [102, 204, 238], [204, 68, 51],
    [187, 187, 68], [119, 85, 170], [17, 119, 119]
];
const partColours = [
    [150, 176, 204], [232, 205, 92], [164, 184, 40], [238, 136, 102], [120, 200, 240], [240, 140, 160], [68, 187, 153],
    [170, 170, 0], [170, 170, 170]
];
const curveColours =
    ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#000000", "#7a5195", "#8c8c8c"];

// Returns [red, green, blue] at a position 0 .. 1 of a scale.
function scaleColour(stops, position) {
    const at = Number.isFinite(position) ? Math.min(Math.max(position, 0), 1) : 1;
    let k = 0;
    while (k + 2 < stops.length && at > stops[k + 1][0]) k++;
    const [a, b] = [stops[k], stops[k + 1]], share = (at - a[0]) / (b[0] - a[0]);
    return [1, 2, 3].map((c) => Math.round(a[c] + share * (b[c] - a[c])));
}

// Makes a canvas as sharp as the screen, `height` CSS pixels high. Returns {context, width, height, ratio}.
function canvasOf(canvas, height) {
    const ratio = Math.min(window.devicePixelRatio || 1, 2), width = Math.max(canvas.clientWidth, 300);
    canvas.style.height = height + "px";
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    const context = canvas.getContext("2d");
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.font = "13px system-ui, 'Liberation Sans', sans-serif";
    return {context, width, height, ratio};
}

// Offers a text or picture as a file.
function download(name, href) { element("a", {href, download: name}).click(); }
