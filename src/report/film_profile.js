// Frames of a bar: the field over the position, in place of the body.

// Returns whether the bar has separated between particles i and j of a frame, as in cleave plot: they are 1.5 spacings
// apart, belong to different fragments, or one has no bond left. now: positions.
function areParted(frame, now, i, j) {
    const size = particlesOf(film, film.sets[frame.set]).size, damage = damageOf(frame);
    const fragment = frame.values.fragment ? arrayOf(frame.values.fragment) : null;
    return Math.abs(now[i] - now[j]) > 1.5 * Math.max(size[i], size[j]) ||
        Boolean(damage && Math.max(damage[i], damage[j]) === 254) || Boolean(fragment && fragment[i] !== fragment[j]);
}

// Draws the field of a frame over the position, with gaps where the bar has separated.
function drawProfile(context, width, height, frame) {
    const x = view.x_of[0], order = Array.from(x.keys()).sort((a, b) => x[a] - x[b]), field = view.field;
    const metre = unitFor(film.box.high[0] - film.box.low[0], "m"),
          unit = unitFor(Math.max(Math.abs(view.low), Math.abs(view.high)), field.unit);
    const area = {right: width - 20, top: 34, bottom: height - 44}, range = padded(view.low, view.high);
    area.left = leftBeside(context, range, unit, area.bottom - area.top);
    const axes = axesOf(area, [view.box.low[0], view.box.high[0]], range);
    drawAxes(context, axes, metre, unit, "x [" + metre.name + "]",
        field.name.replace(/_/g, " ") + (unit.name ? " [" + unit.name + "]" : ""));
    context.fillStyle = curveColours[0];
    context.strokeStyle = curveColours[0];
    context.beginPath();
    const now = positionsOf(film, frame, 1)[0];
    const joined = (k) => k > 0 && k < order.length && !areParted(frame, now, order[k], order[k - 1]);
    order.forEach((i, k) => {
        const at = [axes.x(x[i]), axes.y(valueOf(field, view.codes[i]))];
        context[joined(k) ? "lineTo" : "moveTo"](...at);
        if (!joined(k) && !joined(k + 1)) context.fillRect(at[0] - 2, at[1] - 2, 4, 4);
    });
    context.stroke();
    const damage = damageOf(frame);
    for (const i of order)
        if (damage && damage[i] > CRACK_CODE)
            context.fillStyle = "#b2182b",
            context.fillRect(axes.x(x[i]) - 2, axes.y(valueOf(field, view.codes[i])) - 2, 4, 4);
    view.axes = axes;
}
