/* Creates probes: binds them to particles and adds their columns to the history. */
#include "probes/probes.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "data/extent.h"
#include "probes_parts.h"

/* ---- columns ----------------------------------------------------------------------------------------------------- */

/* Appends a column to the history `probes`, named `<probe>.<quantity>`, with the unit `unit`. It belongs to probe (a
 * requested measurement). */
static void column_add(struct probes *probes, struct probe *probe, const char *quantity, const char *unit)
{
    GROW("probes.column", probes->column, probes->columns + 1);
    struct column *c = &probes->column[probes->columns++];
    snprintf(c->name, sizeof c->name, "%.63s.%.63s", probe->request.name, quantity);
    snprintf(c->unit, sizeof c->unit, "%s", unit);
    probe->columns++;
}

/* Appends dim columns of the probe (a requested measurement) to the history `probes`, one for each component of a
 * vector. The name of a column consists of `prefix` and the axis x, y or z; unit: unit of all columns. */
static void columns_by_axis(struct probes *probes, struct probe *probe, const char *prefix, int dim, const char *unit)
{
    for (int d = 0; d < dim; d++) {
        char name[NAME_MAX_LENGTH];
        snprintf(name, sizeof name, "%s%s", prefix, axis_name[d]);
        column_add(probes, probe, name, unit);
    }
}

/* Appends the columns of the probe (a requested measurement), which depend on its kind and on the quantities that
 * particles p have, to the history `probes`, and stores the index of the first column in probe->first. Some kinds of
 * probe have no columns, only values in the summary. */
static void columns_add(struct probes *probes, struct probe *probe, const struct particles *p)
{
    const int dim = p->dim;
    probe->first = probes->columns;
    switch (probe->request.kind) {
    case PROBE_TIP:
        columns_by_axis(probes, probe, "", dim, "m");
        column_add(probes, probe, "growth", "m");
        break;
    case PROBE_REACTION:
        columns_by_axis(probes, probe, "force_", dim, "N");
        if (!probe->rests) columns_by_axis(probes, probe, "displacement_", dim, "m");
        break;
    case PROBE_POINT:
        for (int k = 0; k < particle_probe_value_count(p); k++) {
            struct column c = particle_probe_value_column(p, k);
            column_add(probes, probe, c.name, c.unit);
        }
        break;
    case PROBE_ENERGY:
        column_add(probes, probe, "kinetic", "J");
        column_add(probes, probe, "strain", "J");
        column_add(probes, probe, "fracture", "J");
        break;
    case PROBE_MOMENTUM:
        columns_by_axis(probes, probe, "", dim, "kg m/s");
        break;
    case PROBE_EXACT:
        for (int k = 0; k < bar_probe_value_count(probe->request.form); k++) {
            struct column c = bar_probe_value_column(probe->request.form, k);
            column_add(probes, probe, c.name, c.unit);
        }
        break;
    case PROBE_SIF:
        for (int k = 0; k < SIF_FIGURES; k++) column_add(probes, probe, sif_figure[k].name, sif_figure[k].unit);
        break;
    case PROBE_GROWTH:
        for (int k = 0; k < GROWTH_FIGURES; k++)
            column_add(probes, probe, growth_figure[k].name, growth_figure[k].unit);
        break;
    case PROBE_RIGID:
        for (int k = 0; k < RIGID_FIGURES; k++) column_add(probes, probe, rigid_figure[k].name, rigid_figure[k].unit);
        break;
    default:
        break; /* all other kinds have results only */
    }
}

/* ---- binding to particles ---------------------------------------------------------------------------------------- */

/* Makes the particle of the run o nearest to the point of the probe of kind POINT (one particle) its only particle, in
 * probe->list, which probes_free releases. Returns REFUSED, with a message, if the point is outside the bodies. */
static status bind_point(struct probe *probe, const struct observed_run *o)
{
    probe->list = NEW("probes.list", 1, int32_t);
    probe->list[probe->n++] = probe_find_nearest_particle(o, probe->request.at);
    if (probe->list[0] >= 0) return OK;
    return status_set(REFUSED,
                      "probe \"%s\": the point (%s) m is outside the bodies (%s); check its coordinates and their unit "
                      "(m if none is written)",
                      probe->request.name, position_text(probe->request.at, o->part->dim, 6).text,
                      particles_describe_bounding_box(o->part).text);
}

/* Makes the particles of the run o nearest to the stations of the probe of kind LINE (points along a line) its
 * particles, in probe->list (probes_free releases it), -1 for stations outside the bodies. Stations are equidistant
 * points from one end of the line to the other. Returns REFUSED, with a message, if all are outside. */
static status bind_line(struct probe *probe, const struct observed_run *o)
{
    int dim = o->part->dim, inside = 0;
    real X[DIM_MAX];
    if (probe->request.points < 1)
        return status_set(REFUSED, "probe \"%s\": stations is 0, so its line has no position; give at least 1",
                          probe->request.name);
    probe->list = NEW("probes.list", probe->request.points, int32_t);
    for (; probe->n < probe->request.points; probe->n++) {
        line_probe_compute_station_position(probe, dim, (int)probe->n, X);
        probe->list[probe->n] = probe_find_nearest_particle(o, X);
        inside += probe->list[probe->n] >= 0;
    }
    if (inside > 0) return OK;
    return status_set(
        REFUSED,
        "probe \"%s\": the whole line is outside the bodies (%s); check its ends and their unit (m if none is written)",
        probe->request.name, particles_describe_bounding_box(o->part).text);
}

/* Makes the particles of the run o in the region of the probe (a requested measurement) its particles, in probe->list
 * (probes_free releases it); those on the surface of the region, up to round-off, are included. Returns REFUSED, with a
 * message, if there is none. */
static status bind_region(struct probe *probe, const struct observed_run *o)
{
    const struct particles *p = o->part;
    real X[DIM_MAX];
    probe->list = NEW("probes.list", p->n, int32_t);
    for (int64_t i = 0; i < p->n; i++) {
        particle_reference_position(p, i, X);
        if (region_contains(&probe->request.region, X, p->dim, ON_SURFACE * o->spacing))
            probe->list[probe->n++] = (int32_t)i;
    }
    if (probe->n > 0) return OK;
    return status_set(
        REFUSED,
        "probe \"%s\": its region contains no particle; check its coordinates and their unit (m if none is written)",
        probe->request.name);
}

/* Returns REFUSED, with a message, unless the boundary of the run o that REACTION probe names prescribes a motion or,
 * in load steps, a force; else OK. If no boundary has this name, the message lists those that a probe can name. */
static status bind_support(const struct probe *probe, const struct observed_run *o)
{
    char known[512] = "";
    size_t used = 0;
    for (int k = 0; k < o->loads->n; k++) {
        const struct boundary *b = o->loads->load[k].boundary;
        bool has_reaction = b->kind == BOUNDARY_VELOCITY || (o->in_steps && boundary_applies_force(b));
        if (strcmp(b->name, probe->request.boundary) == 0 && has_reaction) return OK;
        if (strcmp(b->name, probe->request.boundary) == 0)
            return status_set(REFUSED,
                              "probe \"%s\": boundary \"%s\" prescribes no motion%s, so it has no reaction; name a "
                              "boundary that does",
                              probe->request.name, b->name,
                              o->in_steps                 ? " and no force"
                              : boundary_applies_force(b) ? " (its force is given in the scene)"
                                                          : "");
        if (has_reaction && used < sizeof known)
            used += (size_t)snprintf(known + used, sizeof known - used, "%s\"%s\"", used > 0 ? ", " : "", b->name);
    }
    return status_set(REFUSED, "probe \"%s\": no boundary is named \"%s\"; give one of these names: %s",
                      probe->request.name, probe->request.boundary, used > 0 ? known : "none");
}

/* Sets probe->growth to the index of the growing crack of the run o that GROWTH probe measures: the crack that the
 * probe names, or the first one if it names none. Always returns OK. */
static status bind_growth(struct probe *probe, const struct observed_run *o)
{
    for (int k = o->growths - 1; k >= 0; k--)
        if (!probe->request.of[0] || strcmp(o->growth[k].rule->name, probe->request.of) == 0) probe->growth = k;
    return OK; /* the scene reader has checked that the boundary exists */
}

/* Binds probe (a requested measurement) to the particles, supports or cracks of the run o that it measures, by its
 * kind. Returns REFUSED, with a message, if there are none or the probe does not fit the scene. */
static status probe_bind(struct probe *probe, const struct observed_run *o)
{
    switch (probe->request.kind) {
    case PROBE_POINT:
        return bind_point(probe, o);
    case PROBE_LINE:
        return bind_line(probe, o);
    case PROBE_REACTION:
        return bind_support(probe, o);
    case PROBE_PULSE:
        return pulse_probe_store_incident_amplitude(probe, o);
    case PROBE_BREAK:
    case PROBE_ENERGY:
    case PROBE_MOMENTUM:
        return bind_region(probe, o);
    case PROBE_EXACT:
        return bar_probe_find_bar_and_load(probe, o);
    case PROBE_SIF:
        return sif_probe_find_tip_and_contours(probe, o);
    case PROBE_GROWTH:
        return bind_growth(probe, o);
    case PROBE_RIGID:
        TRY(bind_region(probe, o));
        return rigid_probe_store_initial_motion(probe, o);
    default:
        return OK;
    }
}

/* Returns true if a probe of kind REACTION (force on a support) of `probes` measures the boundary called `boundary`. */
static bool reaction_is_measured(const struct probes *probes, const char *boundary)
{
    bool measured = false;
    for (int k = 0; k < probes->n; k++)
        measured |=
            probes->probe[k].request.kind == PROBE_REACTION && !strcmp(probes->probe[k].request.boundary, boundary);
    return measured;
}

/* Writes the name that the columns of a support have in history.csv to name[NAME_MAX_LENGTH]: that of its boundary,
 * preceded by `reaction_` if a probe (a requested measurement) of `probes` has that name. */
static void support_name(const struct probes *probes, const char *boundary, char name[NAME_MAX_LENGTH])
{
    bool taken = false;
    for (int k = 0; k < probes->n; k++) taken |= strcmp(probes->probe[k].request.name, boundary) == 0;
    snprintf(name, NAME_MAX_LENGTH, "%s%.54s", taken ? "reaction_" : "", boundary);
}

/* Appends to `probes` a probe of kind REACTION (force on a support) for each boundary of the run o that prescribes a
 * motion and that no probe of the scene measures, so that history.csv has the force of every support, and its
 * displacement unless it is at rest. These probes have no values in the summary. */
static void supports_observe(struct probes *probes, const struct observed_run *o)
{
    for (int k = 0; o->loads && k < o->loads->n; k++) {
        const struct boundary *b = o->loads->load[k].boundary;
        if (b->kind != BOUNDARY_VELOCITY || reaction_is_measured(probes, b->name)) continue;
        GROW("probes.probe", probes->probe, probes->n + 1);
        struct probe *probe = &probes->probe[probes->n];
        *probe = (struct probe){.of_history = true, .rests = boundary_is_support_at_rest(b, o->part->dim)};
        probe->request.kind = PROBE_REACTION;
        snprintf(probe->request.boundary, NAME_MAX_LENGTH, "%s", b->name);
        support_name(probes, b->name, probe->request.name);
        probes->n++;
        columns_add(probes, probe, o->part);
    }
}

status probes_make(struct probes *probes, const struct probe_request *requests, int request_count,
                   const struct observed_run *o)
{
    *probes = (struct probes){.n = request_count};
    probes->probe = NEW("probes.probe", request_count, struct probe);
    for (int k = 0; k < request_count; k++) {
        struct probe *probe = &probes->probe[k];
        probe->request = requests[k];
        probe->memory = (struct probe_memory){
            .first_time = NAN, .position = {NAN, NAN, NAN}, .body = -1, .factors = {NAN, NAN, NAN, NAN}};
        status fault = status_message_prepend_location(probe->request.place, probe_bind(probe, o));
        if (fault != OK) {
            probes_free(probes);
            return fault;
        }
        columns_add(probes, probe, o->part);
    }
    supports_observe(probes, o);
    probes->value = NEW("probes.value", probes->columns, real);
    probes->sampled = NAN;
    return OK;
}

void probes_free(struct probes *probes)
{
    for (int k = 0; probes->probe && k < probes->n; k++) {
        memory_free(probes->probe[k].list);
        probe_motion_free(&probes->probe[k]);
        bar_probe_free_bar(probes->probe[k].bar);
        sif_probe_free(probes->probe[k].sif);
    }
    memory_free(probes->probe);
    memory_free(probes->column);
    memory_free(probes->value);
    *probes = (struct probes){0};
}
