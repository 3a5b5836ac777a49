/* Warnings before a run, with the numbers they rest on. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "engine_internal.h"
#include "quasistatic/load_steps.h"
#include "grid/grid_part.h"
#include "mesh/mesh_part.h"
#include "solver/solver.h"
#include "coupling/coupling_part.h"
#include "output/output.h"

/* True if pre-cracks have cut a bond. */
static bool bonds_are_cut(const struct bonds *b)
{
    for (int64_t row = 0; row < b->rows; row++)
        for (struct bond_iterator it = bonds_of_row(b, row); bond_next(&it);)
            if (it.bond.inverse_length < 0) return true;
    return false;
}

static const char *const coupling_name[] = {
    [COUPLING_PM] = "pm", [COUPLING_PG] = "pg", [COUPLING_PMG] = "pmg", [COUPLING_PGG] = "pgg"};

/* Does a scene set a body turning? */
static bool spins(const struct scene *s)
{
    bool any = false;
    for (int b = 0; b < s->boundaries; b++) any |= s->boundary[b].rotates;
    for (int k = 0; k < s->initials; k++)
        for (int a = 0; a < s->dim; a++)
            for (int b = 0; b < a; b++) {
                const real *gradient = s->initial[k].velocity_gradient;
                any |= gradient[a * s->dim + b] != gradient[b * s->dim + a];
            }
    return any;
}

/* Measured with a plate that turns freely, edges at 30 m/s, cells of two spacings. */
static void warn_of_spin(const struct run *e, struct warnings *to)
{
    const struct scene *s = e->scene;
    if (scene_moves(s) && s->transfer == TRANSFER_FLIP && e->part.n_free > 0 && spins(s) &&
        e->grid->turning.groups == 0)
        warnings_add(to, "mpm.transfer flip does not keep the spin of bodies in mpm.frame current: a plate of 20 x 10 "
                     "points loses 7 %% of its angular momentum in 0.3 rad, 28 %% in half a turn, under stresses 100 "
                     "times too large; apic loses 2e-5");
}

/* Method, coupling, transfer and time step. */
static void warn_of_method(const struct run *e, struct warnings *to)
{
    const struct scene *s = e->scene;
    if (scene_moves(s) && e->clock.dt > e->clock.dt_critical)
        warnings_add(to, "the time step is above the critical one: expect a run that blows up");
    if (s->method == METHOD_MPM && s->cracks > 0)
        warnings_add(to, "method mpm has one velocity field and ignores the pre-cracks; pd or adaptive represent them");
    if ((e->coupling_kind == COUPLING_PM || e->coupling_kind == COUPLING_PMG) && s->shape != SHAPE_LINEAR)
        warnings_add(to,
                     "coupling pm and pmg are defined with mpm.shape linear; with other shapes they are pg and pgg");
    if (coupling_moves_by_grid(e->coupling_kind))
        warnings_add(
            to,
            "coupling %s is as published: no energy stands behind its forces, and a long run may gain some; watch "
            "energy.balance_error, or use partial stress",
            coupling_name[e->coupling_kind]);
    bool driven = false;
    for (int b = 0; b < s->boundaries; b++) driven |= s->boundary[b].kind == BOUNDARY_VELOCITY;
    if (driven && e->part.n_free > 0 && (s->shape == SHAPE_QUADRATIC || s->shape == SHAPE_CUBIC))
        warnings_add(to, "mpm.shape %s beside fixed and driven particles: stress there comes out up to a third too "
                     "large, displacements 2 to 3 %%; with a mirror in place of what holds the face, or shapes linear "
                     "and gimp, they do not", s->shape == SHAPE_CUBIC ? "cubic" : "quadratic");
    if (s->method != METHOD_PD && s->cell < 1.5)
        warnings_add(
            to, "one point a cell (mpm.cell %.3g) leaves a zig-zag of 0.8 %% behind coupling interfaces; 2 is usual",
            s->cell);
}

/* Keys of coarse cells and slits where there are none. */
static void warn_of_idle_keys(const struct run *e, struct warnings *to)
{
    const struct scene *s = e->scene;
    const char *why = s->method == METHOD_PD              ? "method pd has no cells"
                      : !scene_moves(s)      ? "a static solver has no use for coarse cells"
                      : e->frame->mesh.points == 0     ? "no material points are in the reference frame"
                                                          : NULL;
    const char *all = frame_hollow_obstacle(s);
    if (s->levels != LEVELS_AUTO && s->levels > 0 && why)
        warnings_add(to, "mpm.levels: %d has no effect, as %s; auto or 0 is expected", s->levels, why);
    if (s->fill == FILL_NEEDED && (why || all || e->frame->levels.n == 0))
        warnings_add(to, "mpm.fill: needed has no effect, all particles are made, as %s; auto or all is expected",
                     why ? why : all ? all : "there are no coarse cells");
    if (s->conversion.notch == NOTCH_SLIT && s->cracks > 0 && s->method != METHOD_ADAPTIVE)
        warnings_add(to, "conversion.notch: slit has no effect with method %s%s; auto is expected",
                     s->method == METHOD_PD ? "pd" : "mpm",
                     s->method == METHOD_PD ? ", whose pre-cracks are cut bonds" : "");
}

static void warn_of_materials(const struct scene *s, const struct material_tables *tables, struct warnings *to)
{
    for (int m = 0; m < s->materials; m++) {
        const struct material *a = &s->material[m];
        if (isfinite(tables->elastic[m].trigger) && tables->elastic[m].trigger_mean > a->young * a->critical_stretch)
            warnings_add(to,
                         "material %s converts at %.4g Pa, above E s_c = %.4g Pa: material points may pass the "
                         "strain at which bonds break",
                         a->name, tables->elastic[m].trigger_mean, a->young * a->critical_stretch);
    }
}

static void warn_of_solver(const struct run *e, struct warnings *to)
{
    const struct scene *s = e->scene;
    for (int m = 0; m < s->materials && scene_in_steps(s); m++)
        if (s->model == MODEL_BOND && material_yields(&s->material[m]) && isfinite(s->material[m].critical_stretch))
            warnings_add(to, "bonds of %s yield before they break: the work that separates it is %.3g J/m^2; elastic "
                         "ones would take %.3g", s->material[m].name, toughness_of(e, &s->material[m]),
                         family_crossing_energy(&e->source.family, &s->material[m]));
    if (!scene_at_rest(s)) return;
    for (int k = 0; k < s->initials; k++)
        if (s->initial[k].sets_velocity || s->initial[k].sets_pulse)
            warnings_add(to, "a static equilibrium has no velocities: those of `initial` are left out");
    for (int b = 0; b < s->bodies; b++)
        if (dot(s->body[b].velocity, s->body[b].velocity, s->dim) > 0)
            warnings_add(to, "a static equilibrium has no velocities: that of body %s is left out", s->body[b].name);
    if (s->bodies > 1 || s->cracks > 0)
        warnings_add(to, "bodies and faces of cracks do not meet in a static equilibrium: they pass through each other "
                     "where they close");
    if (e->solver->applied == 0 && solver_largest(&e->solver->driven, s->dim, e->part.n) == 0)
        warnings_add(to, "nothing loads the body at t = %.4g s: forces have their value at the end of the duration "
                     "there (a step that ends before has none)", s->duration);
}

/* Does a region hold a particle? Where some are not made it may hold points of coarse cells alone: true. */
static bool region_is_met(const struct run *e, const struct region *region)
{
    bool any = e->frame->hollow.absent != NULL;
    for (int64_t i = 0; i < e->part.n && !any; i++) {
        real X[DIM_MAX];
        particle_place(&e->part, i, X);
        any = region_contains(region, X, e->part.dim, 0);
    }
    return any;
}

/* Probes that assume what the scene does not keep to. */
static void warn_of_probes(const struct scene *s, struct warnings *to)
{
    bool yields = false;
    for (int m = 0; m < s->materials; m++) yields |= material_yields(&s->material[m]);
    for (int k = 0; k < s->probes && yields; k++)
        if (s->probe[k].kind == PROBE_SIF)
            warnings_add(to, "probe %s: K_I, K_II and J are those of an elastic body; where a material yields within "
                         "its ring they mean nothing, and rings of other radii differ: contour_spread",
                         s->probe[k].name);
}

/* Columns of particle lists that are not read, or that have a default. */
static void warn_of_lists(const struct scene *s, struct warnings *to)
{
    for (int b = 0; b < s->bodies; b++)
        if (s->body[b].list.note[0])
            warnings_add(to, "%.200s: %s", s->body[b].file, s->body[b].list.note);
}

/* A field that is asked for by name, and that no frame will have. */
static void warn_of_fields(const struct run *e, struct warnings *to)
{
    enum { ASK_PLASTIC_STRAIN = 1 << 4, ASK_OTHERS = ASK_LEVEL | ASK_STRAIN | ASK_PLASTIC_WORK };
    const unsigned asked = e->scene->fields;
    if (asked & ASK_PLASTIC_STRAIN && (asked & ASK_OTHERS) != ASK_OTHERS && !e->part.plastic_strain &&
        !e->bonds.plastic_path)
        warnings_add(to, "output.fields: no material here yields, and frames will have no plastic_strain");
}

static void warn_of_empty(const struct run *e, struct warnings *to)
{
    warn_of_fields(e, to);
    for (int k = 0; k < e->scene->n_series; k++)
        if (!region_is_met(e, &e->scene->series[k].region))
            warnings_add(to, "output.regions: %s holds no particle: its frames will be empty",
                         e->scene->series[k].name);
    for (int b = 0; b < e->loads.n; b++)
        if (e->loads.load[b].n == 0 && e->scene->boundary[b].kind == BOUNDARY_VELOCITY)
            warnings_add(to, "boundary %s holds no particle%s", e->scene->boundary[b].name,
                         e->scene->method == METHOD_PD ? "" : "; it acts on grid nodes in its region only");
    if (e->source.givens > 0 && !bonds_are_cut(&e->bonds))
        warnings_add(to, "the pre-cracks cut no bond: do they lie in the body?");
}

/* Measured in inputs/bar_converge.yaml: with mirrors 0.15 and 0.25 of a cell from a node displacements are 11 to 24 %
 * off with 50 to 200 points per metre; halving the spacing removes at most a third of that. */
static void warn_of_mirrors(const struct scene *s, const struct grid_method *mpm, struct warnings *to)
{
    for (int b = 0; b < s->boundaries; b++)
        if (s->method != METHOD_PD && s->boundary[b].kind == BOUNDARY_MIRROR &&
            !mirror_on_nodes(&s->boundary[b], &mpm->field[0].grid, s->spacing))
            warnings_add(to, "the mirror of boundary %s stands neither on a node of the grid nor half-way between "
                         "two: errors of 15 to 20 %%, and refinement helps little; mpm.origin or mpm.cell can move the "
                         "nodes",
                         s->boundary[b].name);
}

/* ---- several bodies ---------------------------------------------------------------------------------------------- */

/* A list of names in words, `a`, `a and b`, `a, b and c`; names beyond the first few are counted. all: number of names
 * to come. */
struct name_list { int n, all; char text[320]; };

static void name_add(struct name_list *l, const char *name)
{
    enum { NAMED = 4 };
    const size_t used = strlen(l->text);
    const bool last = ++l->n == l->all;
    if (l->n > NAMED && !last) return;
    if (l->n > NAMED && l->all > NAMED + 1)
        snprintf(l->text + used, sizeof l->text - used, " and %d more", l->all - NAMED);
    else snprintf(l->text + used, sizeof l->text - used, "%s%.64s", l->n == 1 ? "" : last ? " and " : ", ", name);
}

/* Several bodies of which some are in the reference frame. */
static void warn_of_reference(const struct scene *s, const struct reference_frame *reference, struct warnings *to)
{
    struct name_list names = {0};
    for (int b = 0; b < s->bodies; b++) names.all += reference->choice[b].reference;
    if (names.all == 0) return;
    for (int b = 0; b < s->bodies; b++)
        if (reference->choice[b].reference) name_add(&names, s->body[b].name);
    warnings_add(
        to,
        "%s %s in the reference frame and meet%s no other body: they pass through each other; in mpm.frame current "
        "bodies meet",
        names.text, names.all > 1 ? "are" : "is", names.all > 1 ? "" : "s");
}

/* Contact between several bodies, by method. */
static void warn_of_contact(const struct scene *s, const struct reference_frame *reference,
                            const struct coupling_state *coupling, struct warnings *to)
{
    bool current = false;
    for (int b = 0; b < s->bodies; b++) current |= !reference->choice[b].reference;
    if (!scene_bodies_meet(s) || coupling->approaches) return;
    if (s->method == METHOD_PD && (s->contact_between != CONTACT_NONE || scene_at_rest(s))) return;
    if (s->method == METHOD_PD)
        warnings_add(to, "peridynamic bodies pass through each other%s without contact.between: bodies or all",
                     s->rigids > 0 ? " (rigid ones they meet)" : "");
    else warn_of_reference(s, reference, to);
    if (s->method == METHOD_ADAPTIVE && current)
        warnings_add(to, "what becomes peridynamic passes through material points of other bodies: that takes "
                         "contact.convert and the coupling partial stress or handshake");
}

/* True if two particles start with one velocity, as parts of joined bodies; bodies about to collide do not. */
static bool engine_warn_at_rest(const struct particles *p, int64_t i, int64_t j)
{
    real apart2 = 0, most2 = 0;
    for (int d = 0; d < p->dim; d++) {
        apart2 += square(p->v[d][i] - p->v[d][j]);
        most2 += square(p->v[d][i]) + square(p->v[d][j]);
    }
    return apart2 <= 1e-6 * most2;
}

/* Sets touch[a * bodies + b], a < b, if particles of bodies a and b are neighbours at the start and move together.
 * Returns the number of such pairs of bodies. */
static int touching(const struct run *e, bool *touch)
{
    const struct particles *p = &e->part;
    const int bodies = e->scene->bodies;
    const real reach = real_min(1.5 * e->scene->spacing, e->source.family.cutoff);
    struct near near = {0};
    int pairs = 0;
    for (int64_t i = 0; i < p->n; i++) {
        near_find(&near, &e->cells, p, i, reach, false);
        for (int k = 0; k < near.n; k++) {
            const int32_t j = near.at[k];
            if (j >= p->n || p->body[j] <= p->body[i] || !engine_warn_at_rest(p, i, j)) continue;
            bool *pair = &touch[p->body[i] * bodies + p->body[j]];
            pairs += !*pair;
            *pair = true;
        }
    }
    memory_free(near.at);
    return pairs;
}

/* Bodies that touch at the start. */
static void warn_of_touch(const struct run *e, struct warnings *to)
{
    const struct scene *s = e->scene;
    char name[2 * NAME_MAX_LENGTH + 8];
    if (s->bodies < 2) return;
    bool *touch = NEW("warn.touch", s->bodies * s->bodies, bool);
    struct name_list names = {.all = touching(e, touch)};
    for (int k = 0; k < s->bodies * s->bodies; k++) {
        if (!touch[k]) continue;
        snprintf(name, sizeof name, "%s with %s", s->body[k / s->bodies].name, s->body[k % s->bodies].name);
        name_add(&names, name);
    }
    memory_free(touch);
    if (names.all > 0)
        warnings_add(to, "bodies touch at the start (%s) and are not joined: no bond goes from one body to another%s",
                     names.text,
                     s->method == METHOD_PD || e->grid->fields > 1
                         ? ""
                         : "; on the grid of mpm.frame current they stick until a gap of two cells opens");
}

void engine_warn(struct run *e)
{
    struct warnings *to = &e->warnings;
    if (e->scene->renamed[0])
        warnings_add(to, "%s; earlier names work in this version, with the same meaning", e->scene->renamed);
    warn_of_method(e, to);
    warn_of_spin(e, to);
    warn_of_idle_keys(e, to);
    warn_of_materials(e->scene, &e->tables, to);
    warn_of_lists(e->scene, to);
    warn_of_probes(e->scene, to);
    engine_warn_of_lone(e, to);
    engine_warn_of_speed(e, to);
    warn_of_solver(e, to);
    warn_of_empty(e, to);
    warn_of_mirrors(e->scene, e->grid, to);
    warn_of_contact(e->scene, e->frame, e->coupling, to);
    warn_of_touch(e, to);
    voids_warn(e, to);
}
