/* Warns of particles without neighbours: they have no internal force, and a static solver finds no equilibrium. */
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
    return !bond_iterator_advance(&it);
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

/* ---- spacing and volumes of lists -------------------------------------------------------------------------------- */

enum { SAMPLED = 128 };  /* number of particles of a list that are tested */
#define APART_MOST 1.25  /* largest median distance of nearest neighbours [spacings]; close packings have 1.12 */
#define CROWDED_MOST 1.6 /* largest number of particles within NEAR, divided by that of a lattice */
#define NEAR 2.5         /* radius in which neighbours are counted [spacings] */
/* relative difference of the distances of nearest neighbours in a lattice, from the digits of lists */
#define ALIKE 0.01
#define LATTICE_OFF 0.02 /* relative difference of the distance of a lattice from the spacing */
#define VOLUME_OFF 1.5   /* largest factor between volumes and cells; close packings have 1.15 in the plane, 1.41 */

/* Medians of a sample of the particles of one list. */
struct list_sample {
    real apart;  /* distance of the nearest neighbour [m] */
    real share;  /* number of particles within NEAR, divided by that of a lattice [1] */
    real filled; /* volume of a particle, divided by that of a cell up to its nearest neighbour [1] */
    bool alike;  /* the nearest neighbours of all are equally far */
    real beside; /* number of neighbours as near as the nearest */
};

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

/* Samples the particles of p that belong to body b of the scene s, which is made from a list, and stores their medians
 * in *sample. cells: of the neighbour search. Returns false, with nothing stored, if the body has at most MASS_POINTS
 * particles. */
static bool sample_list(const struct scene *s, const struct scene_body *b, const struct cells *cells,
                        const struct particles *p, struct list_sample *sample)
{
    static const real ball[] = {0, 2 * NEAR, 3.14159 * NEAR * NEAR, 4.18879 * NEAR * NEAR * NEAR};
    const real section = scene_cross_section_or_thickness(s);
    real apart[SAMPLED], count[SAMPLED], beside[SAMPLED], filled[SAMPLED];
    struct neighbour_list near = {0};
    int64_t own = 0;
    int n = 0;
    for (int64_t i = 0; i < p->n; i++) own += p->body[i] == b->joined;
    if (own <= MASS_POINTS) return false;
    for (int64_t i = 0, k = 0; i < p->n && n < SAMPLED; i++) {
        if (p->body[i] != b->joined || k++ % (own / SAMPLED + 1) != 0) continue;
        particles_list_neighbours_within_radius(&near, cells, p, i, NEAR * s->spacing, false);
        surroundings(p, &near, i, &apart[n], &beside[n]);
        filled[n] = p->volume0[i] / lattice_particle_volume(section, apart[n], p->dim);
        count[n++] = near.n + 1;
    }
    memory_free(near.at);
    sample->apart = median_by_sorting(apart, n), sample->share = median_by_sorting(count, n) / ball[p->dim];
    sample->alike = apart[n - 1] < (1 + ALIKE) * apart[0];
    sample->beside = median_by_sorting(beside, n), sample->filled = median_by_sorting(filled, n);
    return true;
}

/* Adds a warning to *to if particles of a list without volumes are farther apart or more crowded than the spacing from
 * which their volumes are computed implies, beyond the tolerances of this file (APART_MOST, CROWDED_MOST, LATTICE_OFF).
 * b: body made from the list; spacing: lattice spacing [m]; l: medians of the list; dim: number of dimensions. */
static void warn_of_list_spacing(const struct scene_body *b, real spacing, const struct list_sample *l, int dim,
                                 struct warnings *to)
{
    /* a square or cubic lattice has equal distances, and 2 nearest neighbours an axis inside */
    const bool lattice = l->alike && l->beside <= 2 * dim;
    if (l->share > CROWDED_MOST || (isfinite(l->apart) && l->apart > APART_MOST * spacing) ||
        (lattice && fabs(l->apart / spacing - 1) > LATTICE_OFF))
        warnings_add_if_new(
            to,
            "%.200s has no volumes, so each particle gets that of the spacing of %.4g m, but nearest neighbours are "
            "%.4g m apart: masses and forces are wrong; set particles.spacing: %.4g m, or add a column volume",
            b->file, spacing, l->apart, l->apart);
}

/* Adds a warning to *to if volumes of a list whose particles are equally far from their nearest neighbours differ by
 * more than the factor VOLUME_OFF from what these distances and the thickness or section of the scene s imply. b: body
 * made from the list; l: medians of the list. */
static void warn_of_list_volumes(const struct scene *s, const struct scene_body *b, const struct list_sample *l,
                                 struct warnings *to)
{
    static const char *const cell[] = {"", " times the section", "^2 times the thickness", "^3"};
    static const char *const remedy[] = {"", "if the file has lengths, multiply them by the section",
                                         "if the file has areas, multiply them by the thickness", "check their unit"};
    if (!l->alike || !isfinite(l->apart) || (l->filled < VOLUME_OFF && l->filled > 1 / VOLUME_OFF)) return;
    warnings_add_if_new(to,
                        "%.200s: volumes are %.3g times the distance of nearest neighbours (%.4g m)%s, so masses and "
                        "forces are wrong by this factor; %s",
                        b->file, l->filled, l->apart, cell[s->dim], remedy[s->dim]);
}

void run_warn_of_isolated_particles(const struct scene *s, const struct cells *cells, const struct bonds *b,
                                    const struct particles *p, struct warnings *warnings)
{
    struct lone *lone = NEW("warn.lone", s->bodies, struct lone);
    for (int64_t i = 0; i < p->n; i++) lone[p->body[i]].all++;
    lone_bonds_count(b, p, lone);
    lone_points_count(s, cells, p, lone);
    for (int k = 0; k < s->bodies; k++) {
        const struct scene_body *body = &s->body[k];
        struct list_sample l;
        if (!body->file || body->joined != k || !(s->spacing > 0) || !sample_list(s, body, cells, p, &l)) continue;
        if (body->list.volumes)
            warn_of_list_volumes(s, body, &l, warnings);
        else
            warn_of_list_spacing(body, s->spacing, &l, p->dim, warnings);
    }
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
