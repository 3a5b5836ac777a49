/* Warnings of particles without neighbours: they have no internal force, and a static solver finds no equilibrium. */
#include <math.h>
#include <stdio.h>

#include "base/memory.h"
#include "engine/engine.h"

enum { MASS_POINTS = 7 }; /* bodies of at most so many particles are mass points, placed one by one */

/* Counts of the particles of one body. all: all particles; n: those without a neighbour; first: index of the first of
 * the latter. */
struct lone {
    int64_t all, n, first; /* numbers of particles; index */
};

/* Counts particle i in *l, the particles of a body that have no neighbours. The first one is stored in l->first for the
 * message. */
static void lone_add(struct lone *l, int64_t i)
{
    if (l->n++ == 0) l->first = i;
}

/* Returns true if the particle to which row `row` of the bonds b belongs has no bond. */
static bool row_empty(const struct bonds *b, int64_t row)
{
    struct bond_iterator it = bond_iterator_of_row(b, row);
    return !bond_next(&it);
}

/* Returns true if body number `body` of scene s is made from a particle list or a shape file, so that its particles may
 * be isolated. */
static bool from_file(const struct scene *s, int body)
{
    bool any = s->body[body].file != NULL;
    for (int k = 0; k < s->body[body].shape.n; k++) {
        const enum solid_kind kind = s->body[body].shape.solid[k].kind;
        any |= kind == SOLID_HULL || kind == SOLID_VOXELS;
    }
    return any;
}

/* Counts in lone[b], an entry for each body b, the peridynamic particles of p without any bond. */
static void lone_bonds_count(const struct bonds *b, const struct particles *p, struct lone *lone)
{
    for (int64_t row = 0; row < b->rows; row++) {
        const int64_t i = b->particle[row];
        if (i >= 0 && i < p->n && p->kind[i] == KIND_PD && row_empty(b, row)) lone_add(&lone[p->body[i]], i);
    }
}

/* Counts the material points that have no neighbour within a cell in lone[b], an entry for each body b of scene s. p:
 * particles. Only bodies from files are examined. cells: cells of the neighbour search. */
static void lone_points_count(const struct scene *s, const struct cells *cells, const struct particles *p,
                              struct lone *lone)
{
    struct neighbour_list near = {0};
    for (int64_t i = 0; i < p->n && s->method != METHOD_PD; i++) {
        if (p->kind[i] == KIND_PD || !from_file(s, p->body[i])) continue;
        particles_list_neighbours_within_radius(&near, cells, p, i, real_max(1.5, s->cell) * s->spacing, false);
        if (near.n == 0) lone_add(&lone[p->body[i]], i);
    }
    memory_free(near.at);
}

/* ---- lists without volumes --------------------------------------------------------------------------------------- */

enum { SAMPLED = 128 };  /* number of particles of a list that are tested */
#define APART_MOST 1.25  /* largest median distance of nearest neighbours [spacings]; close packings have 1.12 */
#define CROWDED_MOST 1.6 /* largest number of particles within NEAR, divided by that of a lattice */
#define NEAR 2.5         /* radius in which neighbours are counted [spacings] */
/* relative difference of the distances of nearest neighbours in a lattice, from the digits of lists */
#define ALIKE 0.01
#define LATTICE_OFF 0.02 /* relative difference of the distance of a lattice from the spacing */

/* Computes the distance of particle i of p from its nearest neighbour and the number of neighbours at that distance.
 * near: neighbours of i; *apart: receives the distance [m], INFINITY if `near` is empty; *beside: receives the number.
 */
static void surroundings(const struct particles *p, const struct neighbour_list *near, int64_t i, real *apart,
                         real *beside)
{
    real least2 = INFINITY;
    *beside = 0;
    for (int k = 0; k < near->n; k++) {
        real distance2 = 0;
        for (int d = 0; d < p->dim; d++) distance2 += square(p->X[d][near->at[k]] - p->X[d][i]);
        *beside = distance2 < square(1 + ALIKE) * least2 ? (distance2 < square(1 - ALIKE) * least2 ? 1 : *beside + 1)
                                                         : *beside;
        least2 = real_min(least2, distance2);
    }
    *apart = sqrt(least2);
}

/* Adds a warning to *to if the particles p of a list without volumes are farther apart or more crowded than the spacing
 * from which their volumes are computed implies, in the median of a sample and beyond the tolerances of this file
 * (APART_MOST, CROWDED_MOST, LATTICE_OFF). b: body made from the list; spacing: lattice spacing [m]; cells: cells of
 * the neighbour search. */
static void warn_of_list_spacing(const struct scene_body *b, real spacing, const struct cells *cells,
                                 const struct particles *p, struct warnings *to)
{
    static const real ball[] = {0, 2 * NEAR, 3.14159 * NEAR * NEAR, 4.18879 * NEAR * NEAR * NEAR};
    real apart[SAMPLED], count[SAMPLED], beside[SAMPLED];
    struct neighbour_list near = {0};
    int64_t own = 0;
    int n = 0;
    for (int64_t i = 0; i < p->n; i++) own += p->body[i] == b->joined;
    for (int64_t i = 0, k = 0; i < p->n && n < SAMPLED; i++) {
        if (p->body[i] != b->joined || k++ % (own / SAMPLED + 1) != 0) continue;
        particles_list_neighbours_within_radius(&near, cells, p, i, NEAR * spacing, false);
        surroundings(p, &near, i, &apart[n], &beside[n]), count[n++] = near.n + 1;
    }
    memory_free(near.at);
    if (own <= MASS_POINTS) return;
    const real distance = median_by_sorting(apart, n), share = median_by_sorting(count, n) / ball[p->dim];
    /* a square or cubic lattice has equal distances, and 2 nearest neighbours an axis inside */
    const bool lattice = apart[n - 1] < (1 + ALIKE) * apart[0] && median_by_sorting(beside, n) <= 2 * p->dim;
    if (share > CROWDED_MOST || (isfinite(distance) && distance > APART_MOST * spacing) ||
        (lattice && fabs(distance / spacing - 1) > LATTICE_OFF))
        warnings_add_if_new(
            to,
            "%.200s has no volumes, so each particle gets that of the spacing of %.4g m, but nearest neighbours are "
            "%.4g m apart: masses and forces are wrong; set particles.spacing: %.4g m, or add a column volume",
            b->file, spacing, distance, distance);
}

void engine_warn_of_isolated_particles(const struct scene *s, const struct cells *cells, const struct bonds *b,
                                       const struct particles *p, struct warnings *warnings)
{
    struct lone *lone = NEW("warn.lone", s->bodies, struct lone);
    for (int64_t i = 0; i < p->n; i++) lone[p->body[i]].all++;
    lone_bonds_count(b, p, lone);
    lone_points_count(s, cells, p, lone);
    for (int k = 0; k < s->bodies; k++)
        if (s->body[k].file && !s->body[k].list.volumes && s->body[k].joined == k && s->spacing > 0)
            warn_of_list_spacing(&s->body[k], s->spacing, cells, p, warnings);
    for (int k = 0; k < s->bodies; k++) {
        if (lone[k].n == 0 || lone[k].all <= MASS_POINTS) continue;
        warnings_add_if_new(
            warnings, "body %s: %lld of its particles ha%s no neighbour, the first at (%s) m, so nothing holds %s; %s",
            s->body[k].name, (long long)lone[k].n, lone[k].n == 1 ? "s" : "ve",
            particle_position_text(p, lone[k].first, 6).text, lone[k].n == 1 ? "it" : "them",
            scene_is_single_equilibrium(s) ? "remove such particles, because no equilibrium exists with them"
                                           : "check the shape or list there");
    }
    memory_free(lone);
}
