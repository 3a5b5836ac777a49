/* Starts the softening of bonds where the stress of a particle reaches a strength surface (failure criterion
 * in stress). All bonds of the particle that have not begun to soften then soften from their present stretch
 * on, so that forces and energy do not jump. The stress follows from the strain of the particle, averaged n
 * times over the intact bonds of its neighbourhood; the averages extend over a radius of about delta sqrt(n +
 * 0.3), with the horizon delta.
 *
 * Strain of a particle, with the reference vectors xi and present vectors y of its bonds, their weight omega
 * V, omega = 1/r, and the share 1 - d of its stiffness that a bond keeps (0 once it is broken):
 *
 *     E = sym[(R^T sum omega V (1 - d) y xi - sum omega V (1 - d) xi xi) K^-1],   K = sum omega V xi xi
 *
 * K is that of the first neighbourhood, after pre-cracks: exact for uniform strain beside faces, too, and
 * smaller where bonds have softened. R is the rotation of (sum omega V (1 - d) y xi) (sum omega V (1 - d) xi
 * xi)^-1.
 *
 * Averages are computed only for particles whose own strain is on the surface or beyond, as at a crack, where
 * strains differ from particle to particle. Own strains are computed only in blocks of eight bond rows with a
 * stretch near the least one on the surface, which force loops flag (soft.near). */
#include <math.h>

#include "base/memory.h"
#include "base/polar.h"
#include "bonds/strength_surfaces.h"
#include "bonds_parts.h"

#define LEAST_ONSET 0.3 /* least stretch at which a bond may begin to soften, divided by sigma_t/E [1] */
#define SUDDEN 1e-4     /* relative difference of onset and end of a bond that begins beyond its critical stretch [1] */
#define NEAR_LEAST 0.5  /* least ratio of stress to strength of particles among which the largest is sought [1] */
/* Smallest determinant of a moment matrix of bonds, divided by that of an isotropic matrix with equal trace [1]. Below
 * it the bonds have too few directions, and the matrix counts as singular. */
#define SPANS 1e-6

/* Working data of one evaluation of the strength surfaces (failure criteria in stress) of all particles; exists during
 * the evaluation. A row is the list of the bonds of one particle. Strains are averaged over the neighbourhood as many
 * times as the material requires. */
struct evaluation {
    const struct bonds *b;
    const struct particles *p;
    const struct bond_source *source;
    int means;          /* largest number of averages over the neighbourhood that a material requires */
    uint16_t *distance; /* [rows] number of neighbourhoods between the row and the nearest row to be evaluated, plus 1;
                           0: the row is not needed */
    real (*strain[2])[SYM_MAX]; /* [rows] strain after the last average and after the average being computed [1] */
    real *share;                /* [rows] ratio of stress to strength in rows to be evaluated [1] */
};

/* ---- strain of a particle ---------------------------------------------------------------------------------------- */

/* A matrix of dim rows, row major. */
typedef real matrix[DIM_MAX * DIM_MAX];

/* Computes the inverse of the matrix a of dim rows (2 or 3; known at compile time). Returns false, with `inverse`
 * undefined, if a is singular: if |determinant| is at most SPANS times the mean of the absolute diagonal to the power
 * dim. */
static ALWAYS_INLINE bool square_matrix_invert(const matrix a, matrix inverse, const int dim)
{
    real mean = 0, determinant;
    for (int k = 0; k < dim; k++) mean += fabs(a[k * dim + k]) / dim;
    if (dim == 2) {
        determinant = a[0] * a[3] - a[1] * a[2];
        inverse[0] = a[3], inverse[3] = a[0], inverse[1] = -a[1], inverse[2] = -a[2];
    } else {
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) {
                const int r = (j + 1) % 3, s = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
                inverse[i * 3 + j] = a[r * 3 + c] * a[s * 3 + d] - a[r * 3 + d] * a[s * 3 + c];
            }
        determinant = a[0] * inverse[0] + a[1] * inverse[3] + a[2] * inverse[6];
    }
    if (!(fabs(determinant) > SPANS * (dim == 3 ? mean * mean * mean : mean * mean))) return false;
    for (int k = 0; k < dim * dim; k++) inverse[k] /= determinant;
    return true;
}

/* Computes the product a b, or a^T b if `turned`, of two matrices of dim rows. product: receives the result; must be
 * neither a nor b. */
static ALWAYS_INLINE void matrix_multiply(const matrix a, bool turned, const matrix b, matrix product, const int dim)
{
    for (int i = 0; i < dim; i++)
        for (int j = 0; j < dim; j++) {
            real sum = 0;
            for (int k = 0; k < dim; k++) sum += a[turned ? k * dim + i : i * dim + k] * b[k * dim + j];
            product[i * dim + j] = sum;
        }
}

/* Sums over the bonds of a row, with reference vectors xi, present vectors y, weights omega V (omega = 1/r) and
 * damage d: M = sum omega V (1 - d) xi xi^T, L = sum omega V d xi xi^T, Y = sum omega V (1 - d) y xi^T. */
struct moments {
    matrix M, L, Y;
};

/* Adds weight a b^T to the matrix m of dim rows. a[dim], b[dim]: vectors. */
static ALWAYS_INLINE void moment_add(matrix m, real weight, const real *a, const real *b, const int dim)
{
    for (int i = 0; i < dim; i++)
        for (int j = 0; j < dim; j++) m[i * dim + j] += weight * a[i] * b[j];
}

/* Computes *sum, the moment matrices of the bonds of row `row` (bonds of one particle), from which the strain of the
 * particle follows (struct moments). Bonds that a pre-crack cuts are left out; bonds broken by load count as lost
 * stiffness. e: bonds and particles; dim: number of dimensions, known at compile time. */
static ALWAYS_INLINE void row_moments(const struct evaluation *e, int64_t row, struct moments *sum, const int dim)
{
    const struct particles *p = e->p;
    const int32_t i = e->b->particle[row];
    const bool begun = e->b->soft.begun[row / LANES];
    *sum = (struct moments){.M = {0}};
    for (struct bond_iterator it = bond_iterator_of_row(e->b, row); bond_iterator_advance(&it);) {
        const int32_t j = it.bond.nbr;
        const real inverse = fabs(it.bond.inverse_length);
        real xi[DIM_MAX], y[DIM_MAX];
        for (int d = 0; d < dim; d++) xi[d] = p->X[d][j] - p->X[d][i], y[d] = p->x[d][j] - p->x[d][i];
        const real weight = p->volume0[j] * inverse;
        if (it.bond.w == 0) {
            const bool cut = precracks_cut_bond_between(e->source->crack, e->source->cracks, p, i, j);
            if (!cut) moment_add(sum->L, weight, xi, xi, dim);
            continue;
        }
        const real stretch = begun ? sqrt(dot(y, y, dim)) * inverse - 1 : 0;
        const real kept = begun ? bond_remaining_stiffness_fraction(e->b, row / LANES, it.bond.entry, stretch) : 1;
        moment_add(sum->M, weight * kept, xi, xi, dim);
        moment_add(sum->Y, weight * kept, y, xi, dim);
        if (kept < 1) moment_add(sum->L, weight * (1 - kept), xi, xi, dim);
    }
}

/* Computes sum[8], the moment matrices (struct moments) of the bonds of each particle of block g of eight rows (the
 * bonds of eight particles), from which the strains of the particles follow. The block must have a stencil. Its bonds
 * are then intact and have not begun to soften, and the k-th bonds of the eight particles have one index distance
 * (neighbour minus particle). e: bonds and particles; dim: number of dimensions, known at compile time. */
static ALWAYS_INLINE void stencil_moments(const struct evaluation *e, int64_t g, struct moments *sum, const int dim)
{
    const struct particles *p = e->p;
    const struct stencil *stencil = e->b->stencil[g];
    const int64_t i = e->b->particle[g * LANES];
    real M[DIM_MAX * DIM_MAX][LANES] = {{0}}, Y[DIM_MAX * DIM_MAX][LANES] = {{0}};
    for (int k = 0; k < stencil->columns; k++) {
        const int64_t j = i + stencil->column[k].offset;
        const real inverse = stencil->column[k].inverse_length;
        real weight[LANES], xi[DIM_MAX][LANES], y[DIM_MAX][LANES];
        for (int l = 0; l < LANES; l++) weight[l] = stencil->w[k][l] == 0 ? 0 : p->volume0[j + l] * inverse;
        for (int d = 0; d < dim; d++)
            for (int l = 0; l < LANES; l++)
                xi[d][l] = p->X[d][j + l] - p->X[d][i + l], y[d][l] = p->x[d][j + l] - p->x[d][i + l];
        for (int a = 0; a < dim; a++)
            for (int c = 0; c < dim; c++)
                for (int l = 0; l < LANES; l++) {
                    M[a * dim + c][l] += weight[l] * xi[a][l] * xi[c][l];
                    Y[a * dim + c][l] += weight[l] * y[a][l] * xi[c][l];
                }
    }
    for (int l = 0; l < LANES; l++) {
        sum[l] = (struct moments){.M = {0}};
        for (int k = 0; k < dim * dim; k++) sum[l].M[k] = M[k][l], sum[l].Y[k] = Y[k][l];
    }
}

/* Computes the strain of a particle in symmetric components, strain[SYM_MAX] [1], from *sum, the moment matrices over
 * the bonds of its row, which are overwritten. The strain is 0 if the bonds do not span the space. dim: number of
 * dimensions, known at compile time. */
static ALWAYS_INLINE void moments_strain(struct moments *sum, real *strain, const int dim)
{
    matrix inverse, F, R, back, E;
    for (int s = 0; s < SYM_MAX; s++) strain[s] = 0;
    if (!square_matrix_invert(sum->M, inverse, dim)) return;
    matrix_multiply(sum->Y, false, inverse, F, dim);
    polar_rotation(F, R, dim);
    matrix_multiply(R, true, sum->Y, back, dim);
    for (int k = 0; k < dim * dim; k++) back[k] -= sum->M[k], sum->L[k] += sum->M[k];
    if (!square_matrix_invert(sum->L, inverse, dim)) return;
    matrix_multiply(back, false, inverse, E, dim);
    for (int s = 0; s < symmetric_tensor_component_count(dim); s++) {
        int a, c;
        symmetric_tensor_component_axes(dim, s, &a, &c);
        strain[s] = 0.5 * (E[a * dim + c] + E[c * dim + a]);
    }
}

/* Computes the strains of those particles of block g of eight rows (the bonds of eight particles) for which wanted[8]
 * is true, and stores them in e->strain[0]. dim: number of dimensions, known at compile time. */
static ALWAYS_INLINE void row_block_strain_of(struct evaluation *e, int64_t g, const bool *wanted, const int dim)
{
    struct moments sum[LANES];
    const bool common = e->b->stencil[g] != NULL;
    if (common) stencil_moments(e, g, sum, dim);
    for (int l = 0; l < LANES; l++) {
        if (!wanted[l]) continue;
        if (!common) row_moments(e, g * LANES + l, &sum[l], dim);
        moments_strain(&sum[l], e->strain[0][g * LANES + l], dim);
    }
}

/* Computes, for dim 2 or 3, the strains of those particles of block g of eight rows (the bonds of eight particles) for
 * which wanted[8] is true, and stores them in e->strain[0]. */
static void row_block_strain(struct evaluation *e, int64_t g, const bool *wanted)
{
    bool any = false;
    for (int l = 0; l < LANES; l++) any |= wanted[l];
    if (any && e->p->dim == 2) row_block_strain_of(e, g, wanted, 2);
    if (any && e->p->dim == 3) row_block_strain_of(e, g, wanted, 3);
}

/* ---- means ------------------------------------------------------------------------------------------------------- */

/* Returns the row (bonds of one particle) in which the strain of particle or image j is stored: the row of j, or for an
 * image the row of the particle that it mirrors, whose strain is still to be reflected. sign[dim]: receives -1 for the
 * axes to be reflected, else 1. e: bonds and strains. Returns -1 if that row does not have bonds to all neighbours, or
 * if a mirror is clamped. */
static int64_t row_of_strain(const struct evaluation *e, int32_t j, real *sign)
{
    const struct particles *p = e->p;
    for (int d = 0; d < p->dim; d++) sign[d] = 1;
    for (; j >= p->n; j = e->source->image[j - p->n].source) {
        const int axis = e->source->mirror_axis[e->source->image[j - p->n].load];
        if (axis < 0) return -1;
        sign[axis] = -sign[axis];
    }
    const int64_t row = e->b->row_of[j];
    return row >= 0 && e->b->whole[row] ? row : -1;
}

/* Marks the rows of the neighbours to which the intact bonds of row `row` lead, because the mean over a neighbourhood
 * includes their strains: sets e->distance of each to `distance` if it is still 0. e->distance is 1 for a row whose
 * strength surface (failure criterion in stress) is evaluated, and one more for each bond further away. Several threads
 * may mark one row. */
static void mark_family_rows(struct evaluation *e, int64_t row, uint16_t distance)
{
    for (struct bond_iterator it = bond_iterator_of_row(e->b, row); bond_iterator_advance(&it);) {
        real sign[DIM_MAX];
        const int64_t other = it.bond.w == 0 ? -1 : row_of_strain(e, it.bond.nbr, sign);
        if (other >= 0 && __atomic_load_n(&e->distance[other], __ATOMIC_RELAXED) == 0)
            __atomic_store_n(&e->distance[other], distance, __ATOMIC_RELAXED);
    }
}

/* Computes the mean of the strains e->strain[0] of the particle of row `row` and of the neighbours to which its intact
 * bonds lead, and stores it in e->strain[1]. Neighbours without bonds to all of their own neighbours are left out, and
 * images beyond clamped planes. */
static void row_average(struct evaluation *e, int64_t row)
{
    const int dim = e->p->dim, count = symmetric_tensor_component_count(dim);
    real sum[SYM_MAX], sign[DIM_MAX];
    int terms = 1;
    for (int s = 0; s < count; s++) sum[s] = e->strain[0][row][s];
    for (struct bond_iterator it = bond_iterator_of_row(e->b, row); bond_iterator_advance(&it);) {
        const int64_t other = it.bond.w == 0 ? -1 : row_of_strain(e, it.bond.nbr, sign);
        if (other < 0) continue;
        for (int s = 0; s < count; s++) {
            int a, c;
            symmetric_tensor_component_axes(dim, s, &a, &c);
            sum[s] += sign[a] * sign[c] * e->strain[0][other][s];
        }
        terms++;
    }
    for (int s = 0; s < count; s++) e->strain[1][row][s] = sum[s] / terms;
}

/* Returns the stress of the particle of row `row`, divided by the stress in the same direction on its strength surface
 * (failure criterion in stress) [1]: 1 on the surface. The stress follows from the strain e->strain[0] by linear
 * elasticity. */
static real row_share(const struct evaluation *e, int64_t row)
{
    const struct material *m = &e->source->material[e->p->material[e->b->particle[row]]];
    const int dim = e->p->dim;
    const real *strain = e->strain[0][row];
    real stress[SYM_MAX], trace = 0;
    for (int d = 0; d < dim; d++) trace += strain[d];
    for (int s = 0; s < symmetric_tensor_component_count(dim); s++)
        stress[s] = s < dim ? (m->c11 - m->c12) * strain[s] + m->c12 * trace : 2 * m->shear * strain[s];
    return material_stress_to_strength_ratio(m, e->source->family.space, stress);
}

/* Returns the material of the particle of row `row` of e if it has a strength surface (failure criterion in stress),
 * else NULL. */
static const struct material *row_material(const struct evaluation *e, int64_t row)
{
    const struct material *m = &e->source->material[e->p->material[e->b->particle[row]]];
    return material_has_strength_surface(m) ? m : NULL;
}

/* Returns the relative strength of the particle of row `row` of e [1]: its bonds begin to soften at this multiple of
 * the stress on the strength surface. Returns 1 if particles have no such factors (p->strength is NULL). */
static real row_strength(const struct evaluation *e, int64_t row)
{
    return e->p->strength ? e->p->strength[e->b->particle[row]] : 1;
}

/* ---- evaluation -------------------------------------------------------------------------------------------------- */

/* Returns an evaluation of the strength surfaces (failure criteria in stress) of particles for the bonds b, with its
 * arrays allocated. b, p and source are kept by reference. Release it with evaluation_free. */
static struct evaluation evaluation_make(const struct bonds *b, const struct particles *p,
                                         const struct bond_source *source)
{
    struct evaluation e = {b, p, source, 0, NULL, {NULL, NULL}, NULL};
    for (int m = 0; m < source->materials; m++)
        if (material_has_strength_surface(&source->material[m]) && source->material[m].surface_means > e.means)
            e.means = source->material[m].surface_means;
    e.distance = NEW("bonds.distance", b->rows, uint16_t);
    e.share = NEW("bonds.share", b->rows, real);
    for (int k = 0; k < 2; k++) e.strain[k] = memory_new_uninitialised("bonds.strain", b->rows, sizeof *e.strain[k]);
    return e;
}

static void evaluation_free(struct evaluation *e)
{
    memory_free(e->distance), memory_free(e->share);
    memory_free(e->strain[0]), memory_free(e->strain[1]);
}

/* Returns true if a particle of block g of eight rows of b (the bonds of eight particles) may be near its strength
 * surface (failure criterion in stress), as sweeps of forces have marked in b->soft.near, or if a bond of the block has
 * begun to soften. */
static bool is_near_surface(const struct bonds *b, int64_t g) { return b->soft.near[g] || b->soft.begun[g]; }

/* Returns true if row `row` of e (bonds of one particle) has an intact bond that can break and has not begun to
 * soften. */
static bool row_can_start(const struct evaluation *e, int64_t row)
{
    const int32_t i = e->b->particle[row];
    for (struct bond_iterator it = bond_iterator_of_row(e->b, row); bond_iterator_advance(&it);)
        if (it.bond.w != 0 && !bond_is_softening(e->b, row / LANES, it.bond.entry) &&
            isfinite(bond_breaking_stretch(e->p, &e->source->limit, i, it.bond.nbr)))
            return true;
    return false;
}

/* Computes the stress of particles in block g of eight rows (the bonds of eight particles), divided by the stress on
 * their strength surface (failure criterion in stress), and stores this ratio in e->share. Only particles with such a
 * surface and with bonds to all their neighbours count, if one of these bonds can still begin to soften. Sets
 * e->distance to 1 where the ratio is at least `least` [1] times the relative strength of the particle. Returns true if
 * there is such a particle. */
static bool row_block_find(struct evaluation *e, int64_t g, real least)
{
    const struct bonds *b = e->b;
    bool wanted[LANES] = {false}, any = false;
    for (int64_t row = g * LANES; row < b->rows && row < (g + 1) * LANES; row++)
        wanted[row % LANES] = b->whole[row] && row_material(e, row) && row_can_start(e, row);
    row_block_strain(e, g, wanted);
    for (int64_t row = g * LANES; row < b->rows && row < (g + 1) * LANES; row++) {
        if (!wanted[row % LANES]) continue;
        e->share[row] = row_share(e, row);
        if (!(e->share[row] >= least * row_strength(e, row))) continue;
        e->distance[row] = 1;
        any = true;
    }
    return any;
}

/* Finds the particles whose stress, divided by the stress on their strength surface (failure criterion in stress), is
 * at least `least` [1] times their relative strength, and of which a bond can still begin to soften. For their rows
 * (bonds of one particle), sets e->distance to 1 and e->share to the ratio of both stresses. The stress follows from
 * the particle's own strain, not averaged over neighbours. Returns true if there is such a row. */
static bool find_candidates(struct evaluation *e, real least)
{
    bool any = false;
#pragma omp parallel for schedule(dynamic, 16) reduction(| : any)
    for (int64_t g = 0; g < e->b->row_blocks; g++)
        if (is_near_surface(e->b, g)) any |= row_block_find(e, g, least);
    return any;
}

/* Reduces e->share for all rows (bonds of one particle) with e->distance 1 to the ratio of the averaged stress to the
 * stress on the strength surface (failure criterion in stress), if this is smaller. The averaged stress follows from
 * strains that are averaged over the neighbourhoods as many times as the material requires, at most e->means times. For
 * these averages the strains of all rows at most e->means bonds away are computed. Call it after find_candidates. */
static void evaluate_surfaces(struct evaluation *e)
{
    const struct bonds *b = e->b;
    for (int from = 1; from <= e->means; from++)
#pragma omp parallel for schedule(dynamic, 64)
        for (int64_t row = 0; row < b->rows; row++)
            if (__atomic_load_n(&e->distance[row], __ATOMIC_RELAXED) == from)
                mark_family_rows(e, row, (uint16_t)(from + 1));
#pragma omp parallel for schedule(dynamic, 16)
    for (int64_t g = 0; g < b->row_blocks; g++) {
        bool wanted[LANES] = {false};
        for (int64_t row = g * LANES; row < b->rows && row < (g + 1) * LANES; row++)
            wanted[row % LANES] = e->distance[row] > 0;
        row_block_strain(e, g, wanted);
    }
    for (int mean = 0; mean <= e->means; mean++) {
#pragma omp parallel for schedule(dynamic, 64)
        for (int64_t row = 0; row < b->rows; row++) {
            if (e->distance[row] == 0 || e->distance[row] > e->means - mean + 1) continue;
            const struct material *m = row_material(e, row);
            if (e->distance[row] == 1 && m && m->surface_means == mean)
                e->share[row] = real_min(e->share[row], row_share(e, row));
            if (e->distance[row] <= e->means - mean) row_average(e, row);
        }
        real(*last)[SYM_MAX] = e->strain[0];
        e->strain[0] = e->strain[1], e->strain[1] = last;
    }
}

void bonds_compute_stress_to_strength_ratios(const struct bonds *b, const struct particles *p,
                                             const struct bond_source *s, real *stress_ratio)
{
    struct evaluation e = evaluation_make(b, p, s);
    for (int64_t row = 0; row < b->rows; row++)
        if (b->whole[row]) e.distance[row] = 1, e.share[row] = row_material(&e, row) ? INFINITY : 0;
    evaluate_surfaces(&e);
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < p->n; i++) {
        const bool own = p->kind[i] == KIND_PD && b->row_of[i] >= 0;
        stress_ratio[i] =
            own ? e.share[b->row_of[i]] : particle_stress_to_strength_ratio(p, s->material, s->family.space, i);
    }
    evaluation_free(&e);
}

/* ---- start ------------------------------------------------------------------------------------------------------- */

/* Returns the smallest stretch at which bonds of particle or mirror image j may begin to soften [1]. If the stress of
 * the particle has reached its strength surface (failure criterion in stress), this is LEAST_ONSET times its strain at
 * the tensile strength; otherwise it is INFINITY. e: bonds, particles and their stresses. */
static real start_of(const struct evaluation *e, int32_t j)
{
    const int32_t i = (int32_t)mirror_image_source_particle(e->p, e->source->image, j);
    const int64_t row = e->b->row_of[i];
    if (row < 0 || e->distance[row] != 1 || !(e->share[row] >= row_strength(e, row))) return INFINITY;
    const struct material *m = &e->source->material[e->p->material[i]];
    return LEAST_ONSET * row_strength(e, row) * m->tensile_strength / m->young;
}

/* Returns the softening state of a bond of particle i whose softening begins because the stress has reached a strength
 * surface. The onset is the present stretch of the bond, but at least the smaller of `least` and the stretch at which
 * the bond would begin to soften without the surface. least: lower limit of the onset from start_of [1]; e: materials
 * and critical stretches. */
static struct bond_softening_state bond_started(const struct evaluation *e, const struct bond *bond, int32_t i,
                                                real least)
{
    const struct particles *p = e->p;
    const struct bond_limit *limit = &e->source->limit;
    const real closed = bond_softening_range(p, limit, i, bond->nbr).onset;
    const real critical = bond_breaking_stretch(p, limit, i, bond->nbr);
    real length2 = 0;
    for (int d = 0; d < p->dim; d++) length2 += square(p->x[d][bond->nbr] - p->x[d][i]);
    const real onset = real_max(sqrt(length2) * bond->inverse_length - 1, real_min(least, closed));
    const bool sudden = !(onset < critical * (1 - SUDDEN));
    const real end =
        sudden ? onset * (1 + SUDDEN) : softening_breaking_stretch_of_equal_energy(limit->curve, onset, critical);
    const float most = e->b->soft.settled ? nextafterf((float)onset, INFINITY) : (float)onset;
    return (struct bond_softening_state){most, (float)onset, (float)end, 0};
}

/* Starts the softening of bonds in block g of eight rows of b (the bonds of eight particles) that lead from or to a
 * particle on its strength surface (failure criterion in stress). Bonds that are broken or soften already are left
 * unchanged. Material points of p with such bonds are marked for conversion. e: particles that have reached their
 * strength surface. */
static void row_block_start(const struct evaluation *e, struct bonds *b, struct particles *p, int64_t g)
{
    for (int64_t row = g * LANES; row < b->rows && row < (g + 1) * LANES; row++) {
        const int32_t i = b->particle[row];
        const real own = start_of(e, i);
        for (int64_t k = 0; k < b->column_count[g]; k++) {
            const struct bond bond = bond_read(b, g, k, (int)(row % LANES));
            if (bond.w == 0 || bond_is_softening(b, g, bond.entry)) continue;
            const real least = real_min(own, start_of(e, bond.nbr));
            if (isinf(least) || isinf(bond_breaking_stretch(p, &e->source->limit, i, bond.nbr))) continue;
            if (!b->soft.begun[g]) bond_row_block_initialise_softening(b, p, &e->source->limit, g);
            bond_softening_state_write(b, bond.entry, bond_started(e, &bond, i, least));
            softening_flag_material_point_for_conversion(b, p, i);
        }
    }
}

real bonds_largest_stress_to_strength_ratio(const struct bonds *b, const struct particles *p,
                                            const struct bond_source *s)
{
    real most = 0;
    if (!b->soft.near) return 0;
    struct evaluation e = evaluation_make(b, p, s);
    if (find_candidates(&e, NEAR_LEAST)) evaluate_surfaces(&e);
    for (int64_t row = 0; row < b->rows; row++)
        if (e.distance[row] == 1) most = real_max(most, e.share[row] / row_strength(&e, row));
    evaluation_free(&e);
    return most;
}

/* Marks the blocks of eight rows in which bonds may begin to soften because the particle of row `row` (the list of its
 * bonds) has reached its strength surface, a failure criterion in stress. Sets touched[block] to 1 for the block that
 * contains the row, and for those that contain the rows of the neighbours to which its bonds lead, or of their sources
 * if they are mirror images; neighbours without a row are skipped. e: bonds and particles. May be called by several
 * threads at once. */
static void mark_touched(const struct evaluation *e, int64_t row, uint8_t *touched)
{
    __atomic_store_n(&touched[row / LANES], 1, __ATOMIC_RELAXED);
    for (struct bond_iterator it = bond_iterator_of_row(e->b, row); bond_iterator_advance(&it);) {
        const int64_t other = e->b->row_of[mirror_image_source_particle(e->p, e->source->image, it.bond.nbr)];
        if (other >= 0) __atomic_store_n(&touched[other / LANES], 1, __ATOMIC_RELAXED);
    }
}

void bonds_start_softening_at_strength_surface(struct bonds *b, struct particles *p, const struct bond_source *s)
{
    bool any = false;
    if (!b->soft.near) return;
    for (int64_t g = 0; g < b->row_blocks && !any; g++) any = is_near_surface(b, g);
    if (!any) return;
    struct evaluation e = evaluation_make(b, p, s);
    if (find_candidates(&e, 1)) {
        uint8_t *touched = NEW("bonds.touched", b->row_blocks, uint8_t);
        evaluate_surfaces(&e);
#pragma omp parallel for schedule(dynamic, 64)
        for (int64_t row = 0; row < b->rows; row++)
            if (e.distance[row] == 1 && e.share[row] >= row_strength(&e, row)) mark_touched(&e, row, touched);
#pragma omp parallel for schedule(dynamic, 16)
        for (int64_t g = 0; g < b->row_blocks; g++)
            if (touched[g]) row_block_start(&e, b, p, g);
        memory_free(touched);
    }
    array_fill_bytes(b->soft.near, 0, b->row_blocks, 1);
    evaluation_free(&e);
}
