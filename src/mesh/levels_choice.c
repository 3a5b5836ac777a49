/* Chooses the number of coarsening levels of cells, so that cells resolve the waves that the loads of the scene excite.
 *
 * Cells of 4, 8, 16 and 32 spacings with matched inertia (kernels/mesh/mesh_inertia.h) disperse a wave front less than
 * bonds do if the wave travels at least 10, 20, 40 and 80 spacings during its rise; a pulse must be four times as long.
 * A sudden front loses its peak over the distance that it travels in coarse cells, but crack initiation times change by
 * only 1 to 3 % in bodies fifty cell edges thick. Measured errors of pulses of 220 spacings: 0.04, 0.2 and 0.8 % with
 * 1, 2 and 3 levels; of 60 spacings with 4 levels: 11 %. */
#include <math.h>
#include <stdio.h>

#include "base/memory.h"
#include "mesh/mesh_part.h"

enum { PAYS = 100000 };      /* particles of a body above which coarse cells save time; measured */
#define RISES 2.5            /* minimum number of cell edges that waves travel during a rise */
#define ACROSS 50            /* minimum number of cell edges across a body with sudden loads */
#define ACROSS_LEAST 25      /* number of cell edges below which a warning is given */
enum { CARRIED_BY_ANY = 1 }; /* coarsening level that resolves all loads except pulses */

/* ---- loads ------------------------------------------------------------------------------------------------------- */

/* Returns the rise time of boundary b [s], in which its value grows from 0 to the largest value: the largest value
 * divided by the largest rate of change, as for a ramp; 0 for a jump, INFINITY for a table whose value does not change.
 * For prescribed displacements it is the rise time of their velocity, which is a pulse or jumps (0). */
static real rise_of(const struct boundary *b)
{
    const struct time_function *f = &b->time;
    real most = 0, steepest = 0;
    if (b->displaces) return f->kind == TIME_PULSE ? 0.125 * (f->until - f->from) : 0;
    if (f->kind == TIME_RAMP) return f->until - f->from;
    if (f->kind == TIME_PULSE) return 0.25 * (f->until - f->from);
    if (f->kind != TIME_TABLE) return 0;
    for (int k = 0; k < f->n; k++) {
        most = real_max(most, fabs(f->value[k]));
        if (k > 0) steepest = real_max(steepest, fabs(f->value[k] - f->value[k - 1]) / (f->t[k] - f->t[k - 1]));
    }
    return steepest > 0 ? most / steepest : INFINITY;
}

/* Returns the largest edge of cells that resolve the waves of the load r in a body of thickness `across`, all lengths
 * in spacings. It is r->waves/RISES, where r->waves is the distance that waves travel while the load rises. If the load
 * is no pulse, it may also be across/edges, if that is larger: then `edges` cells fit across the body. */
static real edge_for(const struct load_rise *r, real across, real edges)
{
    return r->pulse ? r->waves / RISES : real_max(across / edges, r->waves / RISES);
}

/* Replaces *least, the load that requires the smallest cells so far, by *one if that requires smaller cells in a body
 * of thickness `across` [spacings]. */
static void rise_take(struct load_rise *least, const struct load_rise *one, real across)
{
    const real now = edge_for(least, across, ACROSS), next = edge_for(one, across, ACROSS);
    if (least->kind == RISE_NONE || next < now || (next == now && one->waves < least->waves)) *least = *one;
}

/* Returns the wave speed of the slowest material of the scene s [m/s], whose waves the cells must represent, too. */
static real slowest_waves(const struct scene *s)
{
    real slowest = INFINITY;
    for (int m = 0; m < s->materials; m++) slowest = real_min(slowest, s->material[m].wave_speed);
    return slowest;
}

/* Returns true if the initial state i gives any particle a velocity or a strain; false for a rotation at rate 0, for
 * example. */
static bool initial_acts(const struct scene_initial *i)
{
    const int n = DIM_MAX * DIM_MAX;
    bool acts = i->sets_pulse || dot(i->velocity, i->velocity, DIM_MAX) > 0;
    for (int k = 0; k < n; k++) acts |= i->velocity_gradient[k] != 0 || i->displacement_gradient[k] != 0;
    return acts;
}

/* Returns the load of scene s that requires the smallest cells in a body of thickness `across` [spacings], with its
 * rise time. Initial states and moving or rigid bodies count as loads that rise at once, an initial pulse by its width.
 * Returns the kind RISE_NONE if the scene has no load. */
static struct load_rise sharpest_rise(const struct scene *s, real across)
{
    const real c = slowest_waves(s), D = s->spacing;
    struct load_rise least = {.waves = INFINITY, .seconds = INFINITY};
    for (int b = 0; b < s->boundaries; b++) {
        const struct boundary *load = &s->boundary[b];
        const bool moves = load->kind != BOUNDARY_MIRROR && load->kind != BOUNDARY_ABSORBING;
        const real rise = rise_of(load);
        const struct load_rise one = {RISE_BOUNDARY, b, load->time.kind == TIME_PULSE, rise, rise * c / D};
        if (moves && dot(load->value, load->value, s->dim) > 0) rise_take(&least, &one, across);
    }
    for (int k = 0; k < s->initials; k++) {
        const struct scene_initial *i = &s->initial[k];
        if (!initial_acts(i)) continue;
        const real width = i->sets_pulse ? i->pulse.width : 0;
        const struct load_rise one = {RISE_INITIAL, k, i->sets_pulse, 0.25 * width / c, 0.25 * width / D};
        rise_take(&least, &one, across);
    }
    for (int b = 0; b < s->bodies + s->rigids; b++) {
        const struct load_rise one = {RISE_BODY, b, false, 0, 0};
        const bool strikes = dot(s->body[b].velocity, s->body[b].velocity, s->dim) > 0;
        if (strikes || b >= s->bodies) rise_take(&least, &one, across);
    }
    return least;
}

/* Returns the thickness of the bodies of p [spacings]: their smallest extent along an axis in 1D and 2D, the middle one
 * of three in 3D. hollow: cells whose particles were not created; if there are any, the extent is that of the shape of
 * the body in scene s. */
static real spacings_across(const struct scene *s, const struct particles *p,
                            const struct cells_without_particles *hollow)
{
    real extent[DIM_MAX] = {0}, low[DIM_MAX], high[DIM_MAX];
    const bool made = !hollow->absent || !region_compute_bounding_box_if_finite(&s->body[0].shape, s->dim, low, high);
    for (int d = 0; d < s->dim; d++) {
        if (made) particles_coordinate_range(p, p->n, d, &low[d], &high[d]), high[d] += s->spacing;
        extent[d] = (high[d] - low[d]) / s->spacing;
    }
    const real longest = real_max(extent[0], real_max(extent[1], extent[2]));
    const real middle =
        extent[0] + extent[1] + extent[2] - longest - real_min(extent[0], real_min(extent[1], extent[2]));
    return s->dim == 1 ? extent[0] : s->dim == 2 ? real_min(extent[0], extent[1]) : middle;
}

/* ---- choice ------------------------------------------------------------------------------------------------------ */

/* Computes reference->room[cell], the highest coarsening level (0: finest) that the thickness of the body allows in
 * each cell, if scene s may have coarse cells: it is dynamic, has a mesh and allows coarse levels, and with automatic
 * levels has at least PAYS particles. Otherwise reference->room remains NULL. particle_count: number of particles of
 * the body, including those not created. */
void mesh_levels_store_coarsest_levels_for_thickness(struct lagrangian_mesh *reference, const struct scene *s,
                                                     int64_t particle_count)
{
    if (!scene_is_dynamic(s) || reference->mesh.points == 0 || s->levels == 0) return;
    if (s->levels == LEVELS_AUTO && particle_count < PAYS) return;
    reference->room = NEW("engine.room", reference->mesh.grid.n, uint8_t);
    reference->room_most = mesh_compute_coarsest_cell_levels_for_thickness(&reference->mesh, reference->source.mirror,
                                                                           reference->source.mirrors, reference->room);
}

struct levels_choice mesh_levels_choose_level_count(const struct lagrangian_mesh *reference, const struct particles *p,
                                                    const struct scene *s, real dt_critical)
{
    struct levels_choice c = {.given = s->levels != LEVELS_AUTO,
                              .particles = p->n_body,
                              .step_share = s->time_step / dt_critical,
                              .across = spacings_across(s, p, &reference->hollow)};
    c.rise = sharpest_rise(s, c.across);
    if (!scene_is_dynamic(s))
        c.why = LEVELS_AT_REST;
    else if (reference->mesh.points == 0)
        c.why = LEVELS_NO_MESH;
    else if (c.particles < PAYS)
        c.why = LEVELS_FEW;
    else if (s->damping > 0)
        c.why = LEVELS_DAMPED;
    else if (s->time_step > LEVELS_STEP_MOST * dt_critical)
        c.why = LEVELS_LONG_STEP;
    else {
        const real most = edge_for(&c.rise, c.across, ACROSS);
        while (c.automatic < LEVELS_MAX && (real)(4 << c.automatic) <= most * (1 + 1e-6)) c.automatic++;
        c.why = LEVELS_BY_LOADS;
        if (reference->room && reference->room_most < c.automatic)
            c.automatic = reference->room_most, c.why = LEVELS_THIN;
    }
    c.levels = c.why == LEVELS_AT_REST || c.why == LEVELS_NO_MESH ? 0 : c.given ? s->levels : c.automatic;
    return c;
}

/* ---- in words ---------------------------------------------------------------------------------------------------- */

/* Writes the load r of scene s and its rise time in words to text[capacity], such as "boundary pull is sudden"; a
 * longer text is truncated. */
static void rise_text(const struct scene *s, const struct load_rise *r, char *text, size_t capacity)
{
    char name[NAME_MAX_LENGTH + 32];
    if (r->kind == RISE_BOUNDARY)
        snprintf(name, sizeof name, "boundary %s", s->boundary[r->number].name);
    else if (r->kind == RISE_BODY)
        snprintf(name, sizeof name, "%s %s", r->number < s->bodies ? "the motion of body" : "the impact of",
                 s->body[r->number].name);
    else
        snprintf(name, sizeof name, "initial %s %d", r->pulse ? "pulse" : "state", r->number + 1);
    if (r->kind == RISE_NONE)
        snprintf(text, capacity, "nothing loads the body");
    else if (r->waves == 0)
        snprintf(text, capacity, "%s is sudden", name);
    else if (r->pulse)
        snprintf(text, capacity, "%s makes a wave %.3g spacings long", name, 4 * r->waves);
    else if (isinf(r->waves))
        snprintf(text, capacity, "%s does not change", name);
    else
        snprintf(text, capacity, "%s rises within %.3g s, in which a wave travels %.3g spacings", name, r->seconds,
                 r->waves);
}

/* Writes to text[capacity] the condition under which cells with an edge of `edge` spacings would be used, for a
 * message: pulses of some length, or else loads that rise over some distance or a body of some thickness. c: choice of
 * levels, with the load that determined it; edges: smallest number of cells across the body. */
static void want_text(const struct levels_choice *c, int edge, int edges, char *text, size_t capacity)
{
    if (c->rise.pulse)
        snprintf(text, capacity, "require waves at least %g spacings long", 4 * RISES * edge);
    else
        snprintf(text, capacity,
                 "require loads that rise so slowly that a wave meanwhile travels at least %g spacings, or a body at "
                 "least %d spacings thick (this one: %.3g)",
                 RISES * edge, edges * edge, c->across);
}

/* Writes to text[capacity] the reason for the number of coarsening levels of cells that was chosen automatically for
 * scene s. c: the choice. */
static void automatic_text(const struct levels_choice *c, const struct scene *s, char *text, size_t capacity)
{
    char load[256], want[160];
    const int edge = 2 << c->automatic;
    rise_text(s, &c->rise, load, sizeof load);
    want_text(c, 4, ACROSS, want, sizeof want);
    if (c->why == LEVELS_AT_REST)
        snprintf(text, capacity, "no coarse cells: they save time only in explicit steps (solver: explicit)");
    else if (c->why == LEVELS_NO_MESH)
        snprintf(text, capacity,
                 "no coarse cells: they need material points in the reference frame, and this scene has none");
    else if (c->why == LEVELS_FEW)
        snprintf(text, capacity,
                 "no coarse cells: the body has only %lld particles, and coarse cells save time only with %d or more",
                 (long long)c->particles, PAYS);
    else if (c->why == LEVELS_DAMPED)
        snprintf(text, capacity,
                 "no coarse cells: they have longer time steps, but damping needs one step for the whole body; remove "
                 "damping to get them");
    else if (c->why == LEVELS_LONG_STEP)
        snprintf(text, capacity,
                 "no coarse cells: time.step is %.2f of the critical time step, but coarse cells are stable only up to "
                 "%.2f of it; use a smaller time.step to get them",
                 c->step_share, LEVELS_STEP_MOST);
    else if (c->why == LEVELS_THIN && c->automatic == 0)
        snprintf(text, capacity,
                 "no coarse cells: they need parts at least %d spacings thick (%d cells of 4 spacings), and the body "
                 "has none",
                 4 * CELLS_ACROSS, CELLS_ACROSS);
    else if (c->why == LEVELS_THIN)
        snprintf(
            text, capacity,
            "coarse cells of up to %d spacings: larger ones need parts thick enough for %d cells of twice that size",
            edge, CELLS_ACROSS);
    else if (c->automatic == 0)
        snprintf(text, capacity, "no coarse cells: %s, but cells of 4 spacings %s", load, want);
    else if (c->rise.pulse || !(c->across / ACROSS > c->rise.waves / RISES))
        snprintf(text, capacity, "coarse cells of up to %d spacings, the largest that resolve the waves (%s)", edge,
                 load);
    else
        snprintf(text, capacity,
                 "coarse cells of up to %d spacings, the largest that resolve the waves (%s) or of which at least %d "
                 "fit into the thickness of the body, %.3g spacings",
                 edge, load, ACROSS, c->across);
}

void mesh_levels_describe_level_count(const struct levels_choice *c, const struct scene *s, char *text, size_t capacity)
{
    char why[600];
    automatic_text(c, s, why, sizeof why);
    if (!c->given)
        snprintf(text, capacity, "%s", why);
    else if (c->levels == 0)
        snprintf(text, capacity, "no coarse cells, because mpm.levels is 0; auto would choose: %s", why);
    else
        snprintf(text, capacity, "coarse cells of up to %d spacings, set by mpm.levels; auto would choose: %s",
                 2 << c->levels, why);
}

/* Writes to text[capacity] where the body of `reference` is too thin for the coarse cells that the scene prescribes:
 * fewer than CELLS_ACROSS of them fit across it. Returns false, without text, if there is no such cell. */
static bool thin_text(const struct lagrangian_mesh *reference, char *text, size_t capacity)
{
    const struct grid *g = &reference->mesh.grid;
    int64_t thin = 0, coarse = 0, first = 0;
    int level = 0;
    for (int64_t I = 0; I < g->n && reference->room && reference->levels.n > 0; I++) {
        coarse += reference->levels.level[I] > 0;
        if (reference->levels.level[I] <= reference->room[I]) continue;
        if (thin++ == 0) first = I, level = reference->levels.level[I];
    }
    if (thin == 0) return false;
    real at[DIM_MAX] = {0};
    for (int d = 0; d < g->dim; d++) at[d] = grid_node_position(g, d, first / g->stride[d] % g->count[d]) + 0.5 * g->h;
    snprintf(text, capacity,
             "mpm.levels: %d makes coarse cells of %d spacings in thin parts, such as at (%.4g, %.4g, %.4g) m, with "
             "fewer than %d cells across (%.0f %% of all coarse cells). Such parts bend too stiffly, with natural "
             "frequencies about 5 %% too high; set mpm.levels: auto, which makes no coarse cells there",
             reference->levels.n, 2 << level, at[0], at[1], at[2], CELLS_ACROSS, 100.0 * (double)thin / (double)coarse);
    return true;
}

bool mesh_levels_given_by_scene_are_too_many(const struct levels_choice *c, const struct lagrangian_mesh *reference,
                                             const struct scene *s, char *reason, size_t capacity)
{
    char load[256], want[160];
    int levels = c->rise.pulse ? 0 : CARRIED_BY_ANY;
    const real most = edge_for(&c->rise, c->across, ACROSS_LEAST);
    while (levels < LEVELS_MAX && (real)(4 << levels) <= most * (1 + 1e-6)) levels++;
    if (!c->given) return false;
    if (c->levels <= levels) return thin_text(reference, reason, capacity);
    rise_text(s, &c->rise, load, sizeof load);
    want_text(c, 2 << c->levels, ACROSS_LEAST, want, sizeof want);
    snprintf(
        reason, capacity,
        "mpm.levels: %d makes coarse cells of %d spacings, but %s: cells of this size %s; set mpm.levels: %d or auto",
        c->levels, 2 << c->levels, load, want, levels);
    return true;
}
