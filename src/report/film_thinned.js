// What the page says below the frames: what it leaves out of them.

// How large the cells are that are drawn as one particle, where the page has such.
function cellsText() {
    const {levels, levels_damaged, levels_all} = film, parts = [];
    const cells = (level) => Array(film.dim).fill(2 ** level).join(" × ") + " particles";
    if (levels > levels_all)
        parts.push("Where nothing breaks or yields, cells of up to " + cells(levels) +
            " are drawn as one, with their mean values.");
    if (levels_damaged > levels_all)
        parts.push("Beside cracks and where the body yields, cells of up to " + cells(levels_damaged) + " are.");
    if (levels_all > 0)
        parts.push((levels > levels_all ? "Elsewhere all cells of " : "All cells of ") + cells(levels_all) +
            " are drawn as one: outlines and cracks are that coarse.");
    return parts;
}

// What the page leaves out of the frames.
function thinnedText() {
    const parts = [], set = film.sets[film.frames[film.frames.length - 1].set];
    if (film.frames.length < film.listed) parts.push(film.frames.length + " of " + film.listed + " frames.");
    if (film.lacks_extra) parts.push("Components of stress and velocity are left out.");
    parts.push(...cellsText());
    if (set.n < set.particles)
        parts.push("In the last frame " + number(set.particles) + " particles are drawn as " + number(set.n) + ".");
    const cut = film.fields.filter((f) => f.scale !== "category" && f.axis === undefined &&
            (f.most > f.high * 1.001 + 1e-12 || f.least < f.low - Math.abs(f.low) * 1e-3));
    if (cut.length)
        parts.push((film.dim === 1 ? "Values beyond the stored range are drawn at its ends (0.05 % at either end): " :
                                     "Colours leave out the most extreme particles (0.05 % at either end): ") +
            cut.map((f) => f.name.replace(/_/g, " ") + " reaches " +
                       quantity(Math.abs(f.most) > Math.abs(f.least) ? f.most : f.least, f.unit, 3))
                .join(", ") +
            ".");
    parts.push("Values have 8 bits, positions 16.");
    return parts.join(" ");
}
