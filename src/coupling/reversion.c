/* Converts peridynamic particles without broken bonds back to material points (reversion) once waves have passed. Each
 * particle is written by one thread. */
#include "coupling/reversion.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "partial_parts.h"
#include "kernels/mpm/stress.h"

#define BROKEN_HORIZONS 2 /* distance from broken bonds within which particles stay peridynamic [horizons] */

/* ---- selection --------------------------------------------------------------------------------------------------- */

/* Search for the neighbours of a particle, for one thread. */
struct search {
    const struct particles *p;
    const struct bond_source *source;
    struct neighbour_list near;
};

/* Finds the particles of the body of particle i whose reference position is within `radius` [m] of that of i, i
 * included, and stores them in s->near. A mirror image is replaced by the particle that it mirrors. */
static void search_near(struct search *s, int64_t i, real radius)
{
    int kept = 0;
    particles_list_neighbours_within_radius(&s->near, s->source->cells, s->p, i, radius, true);
    for (int k = 0; k < s->near.n; k++) {
        const int64_t j = mirror_image_source_particle(s->p, s->source->image, s->near.at[k]);
        if (s->p->body[j] == s->p->body[i]) s->near.at[kept++] = (int32_t)j;
    }
    s->near.n = kept;
}

/* Returns true if mark[j] is not 0 for particle i itself or for a particle j of the same body within `radius` [m] of i.
 * s: neighbour search; mark[particles]. */
static bool meets(struct search *s, int64_t i, real radius, const uint8_t *mark)
{
    if (mark[i]) return true;
    search_near(s, i, radius);
    for (int k = 0; k < s->near.n; k++)
        if (mark[s->near.at[k]]) return true;
    return false;
}

/* Returns true if the stress of peridynamic particle i of p is low enough for reversion to a material point: its
 * largest principal value is less than rule->low_stress times the stress at which a point is converted. In bond-based
 * models the stress of a particle near a surface is too small because neighbours are missing, and is divided by the
 * volume share of those that exist. b: bonds, with these volumes. */
static bool low_stress(const struct reversion_rule *rule, const struct particles *p, const struct bonds *b, int64_t i)
{
    const struct family *f = &rule->source->family;
    real stress[SYM_MAX], share = b->family_volume[b->row_of[i]] / f->full;
    if (rule->source->modulus || !(share < 1)) share = 1;
    for (int s = 0; s < symmetric_tensor_component_count(p->dim); s++) stress[s] = p->stress[s][i] / share;
    const real limit =
        rule->low_stress * point_stress_threshold_for_conversion_to_pd(&rule->elastic[p->material[i]], p, i);
    return stress_largest_principal(stress, p->dim) < limit;
}

/* Finds the peridynamic particles that may not revert to material points because of their own state. cut[i] is set to 1
 * for a particle i with a broken or softened bond, else to 0. held[i] is set to 1 if cut[i] is 1, if the particle is in
 * the region rule->kept, or if its stress has not been low (low_stress) for the hold time of `rule`; else to 0. Updates
 * p->low_since, the time at which the stress of a particle became low [s]. t: present time [s]. Returns the number of
 * peridynamic particles with held[i] = 0. */
static int64_t mark_constrained(const struct reversion_rule *rule, struct particles *p, const struct bonds *b, real t,
                                uint8_t *held, uint8_t *cut)
{
    int64_t rested = 0;
#pragma omp parallel for schedule(static) reduction(+ : rested)
    for (int64_t k = 0; k < p->n_of[KIND_PD]; k++) {
        const int32_t i = p->list[KIND_PD][k];
        real X[DIM_MAX];
        particle_reference_position(p, i, X);
        if (!low_stress(rule, p, b, i))
            p->low_since[i] = INFINITY;
        else if (!(p->low_since[i] < INFINITY))
            p->low_since[i] = t;
        cut[i] = p->damage[i] > 0 || bonds_row_has_begun_softening(b, b->row_of[i]);
        held[i] = cut[i] || !(t - p->low_since[i] >= rule->hold_time) ||
                  (rule->kept && region_contains(rule->kept, X, p->dim, ON_SURFACE * rule->source->family.spacing));
        rested += !held[i];
    }
    return rested;
}

/* Sets bound[i] to 1 for peridynamic particles i that must not become material points: a particle marked in `held` is
 * within the cutoff (largest bond length), or one marked in `cut` within BROKEN_HORIZONS horizons. Sets near[i] to 1
 * for all particles i within the cutoff of a peridynamic particle that is not bound; only they can be centres of a ball
 * of particles that revert together. rule: cutoff and horizon. Arrays: [p->n]; held, cut: from mark_constrained. */
static void mark_bound(const struct reversion_rule *rule, const struct particles *p, const uint8_t *held,
                       const uint8_t *cut, uint8_t *bound, uint8_t *near)
{
    const struct family *f = &rule->source->family;
#pragma omp parallel
    {
        struct search s = {.p = p, .source = rule->source};
#pragma omp for schedule(dynamic, 64)
        for (int64_t k = 0; k < p->n_of[KIND_PD]; k++) {
            const int32_t i = p->list[KIND_PD][k];
            bound[i] = held[i] || meets(&s, i, f->cutoff, held) || meets(&s, i, BROKEN_HORIZONS * f->horizon, cut);
        }
        memory_free(s.near.at);
    }
    struct search s = {.p = p, .source = rule->source};
    for (int64_t k = 0; k < p->n_of[KIND_PD]; k++) {
        const int32_t i = p->list[KIND_PD][k];
        if (bound[i]) continue;
        search_near(&s, i, f->cutoff);
        for (int q = 0; q < s.near.n; q++) near[s.near.at[q]] = 1;
    }
    memory_free(s.near.at);
}

/* Sets mark[i] to 1 or 0 for all particles i. With `meeting` true, mark[i] is 1 if wanted[i] is 1 and a particle j with
 * other[j] = 1 is within the cutoff (largest bond length). With `meeting` false, mark[i] is 1 if wanted[i] is 1 and
 * there is no such particle. rule: has the cutoff. Arrays: [p->n]. */
static void mark_meeting(const struct reversion_rule *rule, const struct particles *p, const uint8_t *wanted,
                         const uint8_t *other, bool meeting, uint8_t *mark)
{
#pragma omp parallel
    {
        struct search s = {.p = p, .source = rule->source};
#pragma omp for schedule(dynamic, 64)
        for (int64_t i = 0; i < p->n; i++)
            mark[i] = wanted[i] && meets(&s, i, rule->source->family.cutoff, other) == meeting;
        memory_free(s.near.at);
    }
}

int64_t reversion_select_particles_to_become_mpm(const struct reversion_rule *rule, struct particles *p,
                                                 const struct bonds *b, real t, int32_t **selected)
{
    enum { HELD, CUT, BOUND, NEAR, OPEN, FREE, GOES, MARKS };
    uint8_t *mark[MARKS];
    int64_t n = 0;
    for (int k = 0; k < MARKS; k++) mark[k] = NEW("return.mark", p->n, uint8_t);
    *selected = NULL;
    if (mark_constrained(rule, p, b, t, mark[HELD], mark[CUT]) > 0) {
        mark_bound(rule, p, mark[HELD], mark[CUT], mark[BOUND], mark[NEAR]);
        mark_meeting(rule, p, mark[NEAR], mark[BOUND], false, mark[OPEN]);
        for (int64_t i = 0; i < p->n; i++) mark[FREE][i] = p->kind[i] == KIND_PD && !mark[BOUND][i];
        mark_meeting(rule, p, mark[FREE], mark[OPEN], true, mark[GOES]);
        *selected = NEW("return.list", p->n_of[KIND_PD], int32_t);
        for (int64_t i = 0; i < p->n; i++)
            if (mark[GOES][i]) (*selected)[n++] = (int32_t)i;
    }
    for (int k = 0; k < MARKS; k++) memory_free(mark[k]);
    return n;
}

/* ---- state of reverted particles --------------------------------------------------------------------------------- */

/* Exchanges the n numbers a[] and b[] of two rows of a matrix. */
static void rows_swap(real *a, real *b, int n)
{
    for (int c = 0; c < n; c++) {
        const real kept = a[c];
        a[c] = b[c], b[c] = kept;
    }
}

/* Solves the linear equations A x = b for n unknowns and `columns` right-hand sides by Gauss-Jordan elimination with
 * pivots. A[n][n] is overwritten; x replaces b[n][columns]. Returns false if A is singular, as it is if the bonds of a
 * particle have too few directions; b is then undefined. */
static bool reversion_solve(real *A, real *b, int n, int columns)
{
    real largest = 0;
    for (int k = 0; k < n * n; k++) largest = real_max(largest, fabs(A[k]));
    for (int k = 0; k < n; k++) {
        int pivot = k;
        for (int r = k + 1; r < n; r++)
            if (fabs(A[r * n + k]) > fabs(A[pivot * n + k])) pivot = r;
        if (!(fabs(A[pivot * n + k]) > 1e-9 * largest)) return false;
        rows_swap(A + k * n, A + pivot * n, n);
        rows_swap(b + k * columns, b + pivot * columns, columns);
        for (int r = 0; r < n; r++) {
            const real f = r == k ? 0 : A[r * n + k] / A[k * n + k];
            for (int c = k; c < n && r != k; c++) A[r * n + c] -= f * A[k * n + c];
            for (int c = 0; c < columns && r != k; c++) b[r * columns + c] -= f * b[k * columns + c];
        }
    }
    for (int k = 0; k < n; k++)
        for (int c = 0; c < columns; c++) b[k * columns + c] /= A[k * n + k];
    return true;
}

/* Adds the sums K = sum w e e and G = sum w e y/r over the intact bonds in row `row` of b, the bonds of one particle of
 * p, to K[dim][dim] and G[dim][dim]. w: weight of a bond; e, r: its reference direction and length [m]; y: its present
 * vector [m]. The deformation gradient F of the neighbourhood follows from K F^T = G. */
static void family_moments(const struct bonds *b, const struct particles *p, int64_t row, real *K, real *G)
{
    const int32_t i = b->particle[row];
    const int dim = p->dim;
    for (struct bond_iterator it = bond_iterator_of_row(b, row); bond_iterator_advance(&it);) {
        const struct bond bond = it.bond;
        real e[DIM_MAX], y[DIM_MAX];
        if (bond.w == 0) continue;
        for (int d = 0; d < dim; d++) {
            e[d] = (p->X[d][bond.nbr] - p->X[d][i]) * bond.inverse_length;
            y[d] = (p->x[d][bond.nbr] - p->x[d][i]) * bond.inverse_length;
        }
        for (int a = 0; a < dim; a++)
            for (int c = 0; c < dim; c++)
                K[a * dim + c] += bond.w * e[a] * e[c], G[a * dim + c] += bond.w * e[a] * y[c];
    }
}

/* The cell of a particle. stress: stress that the bonds crossing the cell carry there [Pa]; T: its derivative by a
 * uniform strain [Pa]; both multiplied by the volume of the cell until the sum is complete; X, half: centre of the cell
 * and half of an edge [m]. */
struct crossing {
    real stress[SYM_MAX], T[SYM_MAX * SYM_MAX], X[DIM_MAX], half;
};

/* Adds half of the contribution of one bond to the stress in *to, the cubic cell of a material point, and to the
 * derivative of this stress by a uniform strain, both times the volume of the cell. A bond contributes in proportion to
 * the fraction of its length inside the cell; a bond outside the cell adds nothing. The other half is added when the
 * bond is found in the list of bonds of its other particle. bond: the bond, as stored for the particle r->root of p; b:
 * bonds, of which the stiffness constant is used; j: index of the particle r->root itself, or of one of its mirror
 * images (copies beyond planes of symmetry); r: the reflection that maps this particle, and the bond, to j. */
static void crossing_add(struct crossing *to, const struct bonds *b, const struct particles *p,
                         const struct reflection *r, int64_t j, const struct bond *bond)
{
    const int dim = p->dim, n = symmetric_tensor_component_count(dim);
    real from[DIM_MAX], end[DIM_MAX], y[DIM_MAX], e[DIM_MAX], length2 = 0;
    for (int d = 0; d < dim; d++) {
        from[d] = p->X[d][j], end[d] = r->sign[d] * p->X[d][bond->nbr] + r->offset[d];
        if (real_max(from[d], end[d]) <= to->X[d] - to->half || real_min(from[d], end[d]) >= to->X[d] + to->half)
            return;
    }
    const real share = 0.5 * segment_fraction_in_cube(from, end, to->X, to->half, dim);
    if (share == 0) return;
    for (int d = 0; d < dim; d++) {
        e[d] = (end[d] - from[d]) * bond->inverse_length;
        y[d] = r->sign[d] * p->x[d][bond->nbr] + r->offset[d] - p->x[d][j];
        length2 += square(y[d]);
    }
    const real stiff = share * b->stiffness * bond->w;
    const real force = stiff * (sqrt(length2) * bond->inverse_length - 1) / sqrt(length2);
    for (int s = 0; s < n; s++) {
        int a, c;
        symmetric_tensor_component_axes(dim, s, &a, &c);
        to->stress[s] += force * y[a] * y[c];
        for (int t = 0; t < n; t++) {
            int k, l;
            symmetric_tensor_component_axes(dim, t, &k, &l);
            to->T[s * n + t] += stiff / bond->inverse_length * e[a] * e[c] * e[k] * e[l] * (t < dim ? 1 : 2);
        }
    }
}

/* Computes in *to the stress in the cell of particle i of p from all bonds that cross the cell, sigma = (1/V) sum l F
 * (x) y, and the derivative of this stress by a uniform strain, T = (1/V) sum k r l e e e e [Pa]. V: volume of the
 * cell; l: fraction of a bond inside the cell; F, y: force and present vector of the bond; k, r, e: its stiffness,
 * reference length and direction. In a uniform strain sigma equals the virial stress of the bonds of particle i; in a
 * wave it is an average over only half the distance. source: law of the bonds and cells of the neighbour search; near:
 * working memory. */
static void crossing_of(struct crossing *to, const struct particles *p, const struct bonds *b,
                        const struct bond_source *source, int64_t i, struct neighbour_list *near)
{
    *to = (struct crossing){.half = particle_cell_half_edge(p, source, i)};
    particle_reference_position(p, i, to->X);
    particles_list_neighbours_within_radius(near, source->cells, p, i, source->family.cutoff + to->half * sqrt(p->dim),
                                            true);
    for (int k = 0; k < near->n; k++) {
        const int64_t j = near->at[k];
        const struct reflection r = mirror_image_reflection_from_source_particle(source, p, j);
        const int64_t row = b->row_of[r.root];
        if (row < 0 || p->body[j] != p->body[i]) continue;
        for (struct bond_iterator it = bond_iterator_of_row(b, row); bond_iterator_advance(&it);)
            if (it.bond.w != 0) crossing_add(to, b, p, &r, j, &it.bond);
    }
    for (int c = 0; c < SYM_MAX; c++) to->stress[c] /= p->volume0[i];
    for (int c = 0; c < SYM_MAX * SYM_MAX; c++) to->T[c] /= p->volume0[i];
}

static real determinant(const real *F, int dim)
{
    if (dim == 1) return F[0];
    if (dim == 2) return F[0] * F[3] - F[1] * F[2];
    return F[0] * (F[4] * F[8] - F[5] * F[7]) - F[1] * (F[3] * F[8] - F[5] * F[6]) + F[2] * (F[3] * F[7] - F[4] * F[6]);
}

/* Corrects `stress`, the stress of the bonds that cross the cell of particle i of p [Pa], for missing bonds. The
 * uniform strain that causes this stress is T^-1 stress; the corrected stress is that of a complete neighbourhood under
 * this strain. source: neighbourhood and materials; T[n][n]: derivative of the stress by a uniform strain [Pa],
 * overwritten. Leaves the stress unchanged if T is singular. */
static void complete(const struct bond_source *source, const struct particles *p, int64_t i, real *T, real *stress)
{
    const int dim = p->dim, n = symmetric_tensor_component_count(dim);
    real c11, c12, strain[SYM_MAX], trace = 0;
    for (int s = 0; s < n; s++) strain[s] = stress[s];
    if (!reversion_solve(T, strain, n, 1)) return;
    family_compute_cubic_elastic_constants(&source->family, &source->material[p->material[i]], &c11, &c12);
    for (int d = 0; d < dim; d++) trace += strain[d];
    for (int s = 0; s < n; s++) stress[s] = s < dim ? (c11 - c12) * strain[s] + c12 * trace : 2 * c12 * strain[s];
}

/* Computes the stress that peridynamic particle i of p gets as a material point. stress: receives its symmetric
 * components [Pa]. In bond-based models it is the stress of the bonds that cross the cell of the particle. In
 * state-based models it is the virial stress of its own bonds, since a single bond has no force of its own there.
 * source: law of the bonds and cells of the neighbour search; near: working memory. */
static void reversion_stress(real *stress, const struct particles *p, const struct bonds *b,
                             const struct bond_source *source, int64_t i, struct neighbour_list *near)
{
    struct crossing c;
    for (int k = 0; k < symmetric_tensor_component_count(p->dim); k++) stress[k] = p->stress[k][i];
    if (source->modulus) return;
    crossing_of(&c, p, b, source, i, near);
    complete(source, p, i, c.T, c.stress);
    memcpy(stress, c.stress, sizeof c.stress);
}

/* Sets the state that peridynamic particle i of p has as a material point from its bonds b: stress, volume and stretch.
 * The velocity gradient becomes 0. If the bonds have too few directions to determine the deformation, it is taken to be
 * undeformed. source: law of the bonds and cells of the search; near: working memory. */
static void point_from_family(struct particles *p, const struct bonds *b, const struct bond_source *source, int64_t i,
                              struct neighbour_list *near)
{
    const int dim = p->dim, n = symmetric_tensor_component_count(dim);
    real K[DIM_MAX * DIM_MAX] = {0}, G[DIM_MAX * DIM_MAX] = {0}, stress[SYM_MAX], J = 1;
    family_moments(b, p, b->row_of[i], K, G);
    const bool known = reversion_solve(K, G, dim, dim);
    if (known) J = determinant(G, dim);
    reversion_stress(stress, p, b, source, i, near);
    for (int c = 0; c < n; c++) p->stress[c][i] = stress[c] / J;
    p->volume[i] = p->volume0[i] * J;
    for (int c = 0; c < dim * dim && p->gradient[c]; c++) p->gradient[c][i] = 0;
    for (int d = 0; d < dim && p->stretch[d]; d++) p->stretch[d][i] = known ? G[d * dim + d] : 1;
}

void reversion_convert_listed_particles_to_mpm(struct conversion *c, struct particles *p, struct bonds *b,
                                               const struct bond_source *source, struct partial_stress *partial,
                                               const int32_t *particle_list, int64_t particle_count)
{
#pragma omp parallel
    {
        struct neighbour_list near = {0};
#pragma omp for schedule(dynamic, 8)
        for (int64_t k = 0; k < particle_count; k++) point_from_family(p, b, source, particle_list[k], &near);
        memory_free(near.at);
    }
    for (int64_t k = 0; k < particle_count; k++) {
        p->kind[particle_list[k]] = KIND_MPM;
        p->low_since[particle_list[k]] = INFINITY;
        p->reversions[particle_list[k]] += p->reversions[particle_list[k]] < UINT8_MAX;
    }
    bonds_rebuild_after_particle_kind_change(b, p, source);
    if (partial) partial_stress_compute_from_bonds(partial, p, b, source, particle_list, particle_count);
    c->reverted += particle_count;
    c->reversions++;
}
