/* Creates probes: binds them to particles and adds their columns to the history. */
#include "probes/probes.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "data/extent.h"
#include "probes_parts.h"

/* ---- columns ----------------------------------------------------------------------------------------------------- */

/* Appends a column to the history s, named `<probe>.<quantity>`, with the unit `unit`. It belongs to probe q (a
 * requested measurement). */
static void column_add(struct probes *s, struct probe *q, const char *quantity, const char *unit)
{
    GROW("probes.column", s->column, s->columns + 1);
    struct column *c = &s->column[s->columns++];
    snprintf(c->name, sizeof c->name, "%.63s.%.63s", q->request.name, quantity);
    snprintf(c->unit, sizeof c->unit, "%s", unit);
    q->columns++;
}

/* Appends dim columns of probe q (a requested measurement) to the history s, one for each component of a vector. The
 * name of a column consists of `prefix` and the axis x, y or z; unit: unit of all columns. */
static void columns_by_axis(struct probes *s, struct probe *q, const char *prefix, int dim, const char *unit)
{
    for (int d = 0; d < dim; d++) {
        char name[NAME_MAX_LENGTH];
        snprintf(name, sizeof name, "%s%s", prefix, axis_name[d]);
        column_add(s, q, name, unit);
    }
}

/* Appends the columns of probe q (a requested measurement), which depend on its kind and on the quantities that
 * particles p have, to the history s, and stores the index of the first column in q->first. Some kinds of probe have
 * no columns, only values in the summary. */
static void columns_add(struct probes *s, struct probe *q, const struct particles *p)
{
    const int dim = p->dim;
    q->first = s->columns;
    switch (q->request.kind) {
    case PROBE_TIP:
        columns_by_axis(s, q, "", dim, "m");
        column_add(s, q, "growth", "m");
        break;
    case PROBE_REACTION:
        columns_by_axis(s, q, "force_", dim, "N");
        if (!q->rests) columns_by_axis(s, q, "displacement_", dim, "m");
        break;
    case PROBE_POINT:
        for (int k = 0; k < particle_probe_value_count(p); k++) {
            struct column c = particle_probe_value_column(p, k);
            column_add(s, q, c.name, c.unit);
        }
        break;
    case PROBE_ENERGY:
        column_add(s, q, "kinetic", "J");
        column_add(s, q, "strain", "J");
        column_add(s, q, "fracture", "J");
        break;
    case PROBE_MOMENTUM:
        columns_by_axis(s, q, "", dim, "kg m/s");
        break;
    case PROBE_EXACT:
        for (int k = 0; k < bar_probe_value_count(q->request.form); k++) {
            struct column c = bar_probe_value_column(q->request.form, k);
            column_add(s, q, c.name, c.unit);
        }
        break;
    case PROBE_SIF:
        for (int k = 0; k < SIF_FIGURES; k++) column_add(s, q, sif_figure[k].name, sif_figure[k].unit);
        break;
    case PROBE_GROWTH:
        for (int k = 0; k < GROWTH_FIGURES; k++) column_add(s, q, growth_figure[k].name, growth_figure[k].unit);
        break;
    case PROBE_RIGID:
        for (int k = 0; k < RIGID_FIGURES; k++) column_add(s, q, rigid_figure[k].name, rigid_figure[k].unit);
        break;
    default:
        break; /* all other kinds have results only */
    }
}

/* ---- binding to particles ---------------------------------------------------------------------------------------- */

/* Makes the particle of run o nearest to the point of probe q of kind POINT (one particle) its only particle, in
 * q->list, which probes_free releases. Returns REFUSED, with a message, if the point is outside the bodies. */
static status bind_point(struct probe *q, const struct observed_run *o)
{
    q->list = NEW("probes.list", 1, int32_t);
    q->list[q->n++] = probe_find_nearest_particle(o, q->request.at);
    if (q->list[0] >= 0) return OK;
    return status_set(REFUSED,
                      "probe \"%s\": the point (%s) m is outside the bodies (%s); check its coordinates and their unit "
                      "(m if none is written)",
                      q->request.name, position_text(q->request.at, o->part->dim, 6).text,
                      particles_describe_bounding_box(o->part).text);
}

/* Makes the particles of run o nearest to the stations of probe q of kind LINE (points along a line) its particles, in
 * q->list (probes_free releases it), -1 for stations outside the bodies. Stations are equidistant points from one end
 * of the line to the other. Returns REFUSED, with a message, if all are outside. */
static status bind_line(struct probe *q, const struct observed_run *o)
{
    int dim = o->part->dim, inside = 0;
    real X[DIM_MAX];
    if (q->request.points < 1)
        return status_set(REFUSED, "probe \"%s\": stations is 0, so its line has no position; give at least 1",
                          q->request.name);
    q->list = NEW("probes.list", q->request.points, int32_t);
    for (; q->n < q->request.points; q->n++) {
        line_probe_compute_station_position(q, dim, (int)q->n, X);
        q->list[q->n] = probe_find_nearest_particle(o, X);
        inside += q->list[q->n] >= 0;
    }
    if (inside > 0) return OK;
    return status_set(
        REFUSED,
        "probe \"%s\": the whole line is outside the bodies (%s); check its ends and their unit (m if none is written)",
        q->request.name, particles_describe_bounding_box(o->part).text);
}

/* Makes the particles of run o in the region of probe q (a requested measurement) its particles, in q->list
 * (probes_free releases it); those on the surface of the region, up to round-off, are included. Returns REFUSED, with a
 * message, if there is none. */
static status bind_region(struct probe *q, const struct observed_run *o)
{
    const struct particles *p = o->part;
    real X[DIM_MAX];
    q->list = NEW("probes.list", p->n, int32_t);
    for (int64_t i = 0; i < p->n; i++) {
        particle_reference_position(p, i, X);
        if (region_contains(&q->request.region, X, p->dim, ON_SURFACE * o->spacing)) q->list[q->n++] = (int32_t)i;
    }
    if (q->n > 0) return OK;
    return status_set(
        REFUSED,
        "probe \"%s\": its region contains no particle; check its coordinates and their unit (m if none is written)",
        q->request.name);
}

/* Returns REFUSED, with a message, unless the boundary of run o that REACTION probe q names prescribes a motion or, in
 * load steps, a force; else OK. If no boundary has this name, the message lists those that a probe can name. */
static status bind_support(const struct probe *q, const struct observed_run *o)
{
    char known[512] = "";
    size_t used = 0;
    for (int k = 0; k < o->loads->n; k++) {
        const struct boundary *b = o->loads->load[k].boundary;
        bool has_reaction = b->kind == BOUNDARY_VELOCITY || (o->in_steps && boundary_applies_force(b));
        if (strcmp(b->name, q->request.boundary) == 0 && has_reaction) return OK;
        if (strcmp(b->name, q->request.boundary) == 0)
            return status_set(REFUSED,
                              "probe \"%s\": boundary \"%s\" prescribes no motion%s, so it has no reaction; name a "
                              "boundary that does",
                              q->request.name, b->name,
                              o->in_steps                 ? " and no force"
                              : boundary_applies_force(b) ? " (its force is given in the scene)"
                                                          : "");
        if (has_reaction && used < sizeof known)
            used += (size_t)snprintf(known + used, sizeof known - used, "%s\"%s\"", used > 0 ? ", " : "", b->name);
    }
    return status_set(REFUSED, "probe \"%s\": no boundary is named \"%s\"; give one of these names: %s",
                      q->request.name, q->request.boundary, used > 0 ? known : "none");
}

/* Sets q->growth to the index of the growing crack of run o that GROWTH probe q measures: the crack that the probe
 * names, or the first one if it names none. Always returns OK. */
static status bind_growth(struct probe *q, const struct observed_run *o)
{
    for (int k = o->growths - 1; k >= 0; k--)
        if (!q->request.of[0] || strcmp(o->growth[k].rule->name, q->request.of) == 0) q->growth = k;
    return OK; /* the scene reader has checked that the boundary exists */
}

/* Binds probe q (a requested measurement) to the particles, supports or cracks of run o that it measures, by its kind.
 * Returns REFUSED, with a message, if there are none or the probe does not fit the scene. */
static status probe_bind(struct probe *q, const struct observed_run *o)
{
    switch (q->request.kind) {
    case PROBE_POINT:
        return bind_point(q, o);
    case PROBE_LINE:
        return bind_line(q, o);
    case PROBE_REACTION:
        return bind_support(q, o);
    case PROBE_PULSE:
        return pulse_probe_store_incident_amplitude(q, o);
    case PROBE_BREAK:
    case PROBE_ENERGY:
    case PROBE_MOMENTUM:
        return bind_region(q, o);
    case PROBE_EXACT:
        return bar_probe_find_bar_and_load(q, o);
    case PROBE_SIF:
        return sif_probe_find_tip_and_contours(q, o);
    case PROBE_GROWTH:
        return bind_growth(q, o);
    case PROBE_RIGID:
        TRY(bind_region(q, o));
        return rigid_probe_store_initial_motion(q, o);
    default:
        return OK;
    }
}

/* Returns true if a probe of kind REACTION (force on a support) of s measures the boundary called `boundary`. */
static bool reaction_is_measured(const struct probes *s, const char *boundary)
{
    bool measured = false;
    for (int k = 0; k < s->n; k++)
        measured |= s->probe[k].request.kind == PROBE_REACTION && !strcmp(s->probe[k].request.boundary, boundary);
    return measured;
}

/* Writes the name that the columns of a support have in history.csv to name[NAME_MAX_LENGTH]: that of its boundary,
 * preceded by `reaction_` if a probe (a requested measurement) of s has that name. */
static void support_name(const struct probes *s, const char *boundary, char name[NAME_MAX_LENGTH])
{
    bool taken = false;
    for (int k = 0; k < s->n; k++) taken |= strcmp(s->probe[k].request.name, boundary) == 0;
    snprintf(name, NAME_MAX_LENGTH, "%s%.54s", taken ? "reaction_" : "", boundary);
}

/* Appends to s a probe of kind REACTION (force on a support) for each boundary of run o that prescribes a motion and
 * that no probe of the scene measures, so that history.csv has the force of every support, and its displacement unless
 * it is at rest. These probes have no values in the summary. */
static void supports_observe(struct probes *s, const struct observed_run *o)
{
    for (int k = 0; o->loads && k < o->loads->n; k++) {
        const struct boundary *b = o->loads->load[k].boundary;
        if (b->kind != BOUNDARY_VELOCITY || reaction_is_measured(s, b->name)) continue;
        GROW("probes.probe", s->probe, s->n + 1);
        struct probe *q = &s->probe[s->n];
        *q = (struct probe){.of_history = true, .rests = boundary_is_support_at_rest(b, o->part->dim)};
        q->request.kind = PROBE_REACTION;
        snprintf(q->request.boundary, NAME_MAX_LENGTH, "%s", b->name);
        support_name(s, b->name, q->request.name);
        s->n++;
        columns_add(s, q, o->part);
    }
}

status probes_make(struct probes *s, const struct probe_request *requests, int request_count,
                   const struct observed_run *o)
{
    *s = (struct probes){.n = request_count};
    s->probe = NEW("probes.probe", request_count, struct probe);
    for (int k = 0; k < request_count; k++) {
        struct probe *q = &s->probe[k];
        q->request = requests[k];
        q->memory = (struct probe_memory){
            .first_time = NAN, .position = {NAN, NAN, NAN}, .body = -1, .factors = {NAN, NAN, NAN, NAN}};
        status fault = status_message_prepend_location(q->request.place, probe_bind(q, o));
        if (fault != OK) {
            probes_free(s);
            return fault;
        }
        columns_add(s, q, o->part);
    }
    supports_observe(s, o);
    s->value = NEW("probes.value", s->columns, real);
    s->sampled = NAN;
    return OK;
}

void probes_free(struct probes *s)
{
    for (int k = 0; s->probe && k < s->n; k++) {
        memory_free(s->probe[k].list);
        probe_motion_free(&s->probe[k]);
        bar_probe_free_bar(s->probe[k].bar);
        sif_probe_free(s->probe[k].sif);
    }
    memory_free(s->probe);
    memory_free(s->column);
    memory_free(s->value);
    *s = (struct probes){0};
}
