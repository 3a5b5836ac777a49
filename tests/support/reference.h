/* Reference implementation of the bond kernels, written from the formulas and not from the kernels: all pairs, one
 * particle at a time, full tensors, no vectors, no threads. */
#ifndef CLEAVE_TESTS_REFERENCE
#define CLEAVE_TESTS_REFERENCE

#include <math.h>
#include <string.h>

#include "bonds/bonds.h"
#include "base/memory.h"

/* ==== neighbourhoods ===================================================== */

/* Computes the vector from particle i to particle j, with the positions x[dim][..] [m], and stores it in relative[dim].
 * Returns the length of the vector [m]. */
static inline real reference_relative(real *const *x, int dim, int64_t i, int64_t j, real *relative)
{
    real r2 = 0;
    for (int d = 0; d < dim; d++) relative[d] = x[d][j] - x[d][i], r2 += relative[d] * relative[d];
    return sqrt(r2);
}

/* Returns true if particle j is in the neighbourhood f of particle i: another particle of the same body whose distance
 * in the reference configuration is at most the cutoff. */
static inline bool reference_bonded(const struct particles *p, const struct family *f, int64_t i, int64_t j)
{
    real xi[DIM_MAX], cutoff = f->horizon + (f->volume == VOLUME_RAMP ? 0.5 * f->spacing : 0);
    if (i == j || p->body[i] != p->body[j]) return false;
    return reference_relative(p->X, p->dim, i, j, xi) <= cutoff * (1 + 1e-9);
}

/* Returns beta, the fraction of the volume of a neighbour at distance r [m] that counts as within the horizon; 1 if the
 * neighbourhood f counts whole volumes. */
static inline real reference_beta(const struct family *f, real r)
{
    if (f->volume == VOLUME_WHOLE) return 1;
    return fmax(0, fmin(1, (f->horizon + 0.5 * f->spacing - r) / f->spacing));
}

/* Returns the shell weight of a bond of reference vector xi and length r [m], which makes a lattice isotropic [1]: one
 * weight for bonds near the axes, one for those near the diagonals. With the direction n, the former have sum n_d^4 >
 * 3/(D + 2). */
static inline real reference_shell(const struct family *f, const real *xi, real r, int dim)
{
    real fourth = 0;
    for (int d = 0; d < dim; d++) fourth += pow(xi[d] / r, 4);
    return f->shell_weight[fourth > 3.0 / (dim + 2) + 1e-9 ? 0 : 1];
}

/* Returns the sum [m^4] of r V beta times the shell weight over all neighbours of a particle in the middle of the
 * lattice. r: length of the bond; V: volume of the neighbour; beta: fraction of V within the horizon. The micro-modulus
 * of bonds follows from this sum. */
static inline real reference_sigma(const struct family *f)
{
    int dim = space_dim(f->space), reach = (int)ceil(f->horizon / f->spacing) + 1;
    real V = pow(f->spacing, dim) * f->section, sum = 0;
    real cutoff = f->horizon + (f->volume == VOLUME_RAMP ? 0.5 * f->spacing : 0);
    for (int a = -reach; a <= reach; a++)
        for (int b = dim > 1 ? -reach : 0; b <= (dim > 1 ? reach : 0); b++)
            for (int c = dim > 2 ? -reach : 0; c <= (dim > 2 ? reach : 0); c++) {
                real xi[DIM_MAX] = {a * f->spacing, b * f->spacing, c * f->spacing};
                real r = sqrt(xi[0] * xi[0] + xi[1] * xi[1] + xi[2] * xi[2]);
                if (r == 0 || r > cutoff * (1 + 1e-9)) continue;
                sum += r * V * reference_beta(f, r) * reference_shell(f, xi, r, dim);
            }
    return sum;
}

/* Returns the micro-modulus c [N/m^6] of the bonds of material m, with which a uniform dilatation of a full
 * neighbourhood (all neighbours within the horizon exist) stores the energy of the elastic material. */
static inline real reference_modulus(const struct family *f, const struct material *m)
{
    real E = m->young, nu = m->poisson, sigma = reference_sigma(f);
    switch (f->space) {
    case SPACE_LINE:
        return 2 * E / sigma;
    case SPACE_PLANE_STRESS:
        return 8 * E / (2 * (1 - nu)) / sigma;
    case SPACE_PLANE_STRAIN:
        return 8 * E / (2 * (1 + nu) * (1 - 2 * nu)) / sigma;
    default:
        return 18 * E / (3 * (1 - 2 * nu)) / sigma;
    }
}

/* Returns the sum [m^3] of the volumes of all neighbours of particle i, each multiplied by the fraction within the
 * horizon. */
static inline real reference_neighbour_volume(const struct particles *p, const struct family *f, int64_t i)
{
    real xi[DIM_MAX], sum = 0;
    for (int64_t j = 0; j < p->n; j++)
        if (reference_bonded(p, f, i, j))
            sum += p->volume0[j] * reference_beta(f, reference_relative(p->X, p->dim, i, j, xi));
    return sum;
}

/* Returns the weight of the bond between particles i and j: c beta lambda V_i V_j, divided by c_0 V_0^2, with the
 * micro-modulus c_0 of material 0 and the volume V_0 of a lattice cell. c: micro-modulus, between two materials the
 * harmonic mean of both (two half bonds in series); beta: fraction of the volume within the horizon, times the shell
 * weight; lambda: surface correction; V_i, V_j: volumes of the particles. volume: reference_neighbour_volume of all
 * particles, for the surface correction; NULL: lambda = 1. */
static inline real reference_weight(const struct particles *p, const struct bond_source *s, const real *volume,
                                    int64_t i, int64_t j)
{
    const struct family *f = &s->family;
    real xi[DIM_MAX], r = reference_relative(p->X, p->dim, i, j, xi), cell = pow(f->spacing, p->dim) * f->section;
    real a = reference_modulus(f, &s->material[p->material[i]]), b = reference_modulus(f, &s->material[p->material[j]]);
    real w = reference_beta(f, r) * reference_shell(f, xi, r, p->dim) * p->volume0[i] * p->volume0[j] / (cell * cell);
    w *= 2 * a * b / (a + b) / reference_modulus(f, &s->material[0]);
    return volume ? w * 2 * f->full / (volume[i] + volume[j]) : w;
}

/* ==== cracks, in general position only =========================================================================== */

/* Returns twice the signed area of the triangle with the corners a, b and c in the plane: positive if their order is
 * anticlockwise. */
static inline real reference_turn(const real *a, const real *b, const real *c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/* Returns six times the signed volume of the tetrahedron with the corners a, b, c and d. */
static inline real reference_tetrahedron(const real *a, const real *b, const real *c, const real *d)
{
    real u[3], v[3], w[3];
    for (int k = 0; k < 3; k++) u[k] = b[k] - a[k], v[k] = c[k] - a[k], w[k] = d[k] - a[k];
    return u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
}

/* Returns true if the segment from a to b intersects the triangle with the corners t0, t1 and t2: a and b are on
 * different sides of the plane of the triangle, and the line passes all three edges with the same orientation. */
static inline bool reference_pierced(const real *t0, const real *t1, const real *t2, const real *a, const real *b)
{
    if ((reference_tetrahedron(t0, t1, t2, a) > 0) == (reference_tetrahedron(t0, t1, t2, b) > 0)) return false;
    bool first = reference_tetrahedron(a, b, t0, t1) > 0;
    return first == (reference_tetrahedron(a, b, t1, t2) > 0) && first == (reference_tetrahedron(a, b, t2, t0) > 0);
}

/* Returns true if the segment from a to b (dim coordinates each) crosses the crack c, which is a point in 1D, one
 * straight segment in 2D, a convex polygon in 3D. */
static inline bool reference_cut(const struct crack *c, const real *a, const real *b, int dim)
{
    if (dim == 1) return (a[0] < c->corner[0][0]) != (b[0] < c->corner[0][0]);
    if (dim == 2)
        return (reference_turn(c->corner[0], c->corner[1], a) > 0) !=
                   (reference_turn(c->corner[0], c->corner[1], b) > 0) &&
               (reference_turn(a, b, c->corner[0]) > 0) != (reference_turn(a, b, c->corner[1]) > 0);
    for (int k = 1; k + 1 < c->n; k++) /* a convex polygon a fan of triangles */
        if (reference_pierced(c->corner[0], c->corner[k], c->corner[k + 1], a, b)) return true;
    return false;
}

/* ==== bonds ============================================================= */

/* Returns the weights stored in b for all bonds as a full matrix w of p->n x p->n entries, with the bond from particle
 * i to j at w[i n + j]: 0 for a broken bond, NAN if there is no bond. Release it with memory_free. */
static inline real *reference_table(const struct bonds *b, const struct particles *p)
{
    real *w = NEW("reference.w", p->n * p->n, real);
    for (int64_t k = 0; k < p->n * p->n; k++) w[k] = NAN;
    for (int64_t row = 0; row < b->rows; row++)
        for (struct bond_iterator it = bond_iterator_of_row(b, row); bond_iterator_advance(&it);)
            w[b->particle[row] * p->n + it.bond.nbr] = it.bond.w;
    return w;
}

/* Bond from particle i to j: stretch [1], reference length [m], and in the current configuration the unit vector n and
 * the vector y [m]. */
struct reference_bond {
    real stretch, length, n[DIM_MAX], y[DIM_MAX];
};

/* Returns stretch, length and direction of the bond from particle i to particle j of p at their present positions. */
static inline struct reference_bond reference_bond(const struct particles *p, int64_t i, int64_t j)
{
    struct reference_bond q;
    real xi[DIM_MAX], now = reference_relative(p->x, p->dim, i, j, q.y);
    q.length = reference_relative(p->X, p->dim, i, j, xi);
    q.stretch = (now - q.length) / q.length;
    for (int d = 0; d < p->dim; d++) q.n[d] = q.y[d] / now;
    return q;
}

/* Sums over the bonds of one particle: force [N], half the elastic energy of each bond [J], stress [Pa]. */
struct reference_row {
    real force[DIM_MAX], energy, stress[DIM_MAX][DIM_MAX];
};

/* Returns force, energy and stress of particle i from its elastic bonds. w: matrix of reference_table; stiffness: force
 * of a bond of weight 1, divided by its stretch [N]. */
static inline struct reference_row reference_row(const struct particles *p, const real *w, real stiffness, int64_t i)
{
    struct reference_row row = {.energy = 0};
    for (int64_t j = 0; j < p->n; j++) {
        if (!(w[i * p->n + j] > 0)) continue;
        struct reference_bond q = reference_bond(p, i, j);
        real force = stiffness * w[i * p->n + j] * q.stretch;
        row.energy += 0.5 * (0.5 * force * q.stretch * q.length);
        for (int a = 0; a < p->dim; a++) {
            row.force[a] += force * q.n[a];
            for (int b = 0; b < p->dim; b++) row.stress[a][b] += force * q.n[a] * q.y[b] / (2 * p->volume0[i]);
        }
    }
    return row;
}

/* ==== partial stress ===================================================== */

/* Returns the index of the component in row a and column b in a stored symmetric tensor: order xx yy zz xy yz zx in 3D,
 * xx yy xy in 2D. */
static inline int reference_symmetric(int dim, int a, int b)
{
    if (a == b) return a;
    if (dim == 2) return 2;
    return a + b == 1 ? 3 : a + b == 3 ? 4 : 5;
}

/* Expands a stored symmetric tensor (xx yy zz xy yz zx in 3D, xx yy xy in 2D) to the matrix `tensor` of dim x dim. */
static inline void reference_tensor(const real *symmetric, int dim, real tensor[DIM_MAX][DIM_MAX])
{
    for (int a = 0; a < dim; a++)
        for (int b = 0; b < dim; b++) tensor[a][b] = symmetric[reference_symmetric(dim, a, b)];
}

/* Returns the fraction of the segment between the reference positions of particles m and j that is inside the cube
 * (square, interval) of particle q. section: thickness in 2D [m], cross section in 1D [m^2], 1 in 3D. */
static inline real reference_inside(const struct particles *p, real section, int64_t m, int64_t j, int64_t q)
{
    real edge = pow(p->volume0[q] / section, 1.0 / p->dim), from = 0, to = 1;
    for (int d = 0; d < p->dim; d++) {
        real start = p->X[d][m] - p->X[d][q], way = p->X[d][j] - p->X[d][m];
        if (way == 0) {
            if (fabs(start) > 0.5 * edge) return 0;
            continue;
        }
        real one = (-0.5 * edge - start) / way, two = (0.5 * edge - start) / way;
        from = fmax(from, fmin(one, two)), to = fmin(to, fmax(one, two));
    }
    return fmax(0, to - from);
}

/* Computes the stiffness T [Pa] of material point q that is due to the intact bonds between peridynamic particles and
 * material points that cross its cube. w: matrix of reference_table; stiffness: force of a bond of weight 1, divided by
 * its stretch [N]; section: thickness in 2D [m], cross section in 1D [m^2], 1 in 3D. */
static inline void reference_partial(const struct particles *p, const real *w, real stiffness, real section, int64_t q,
                                     real T[DIM_MAX][DIM_MAX][DIM_MAX][DIM_MAX])
{
    memset(T, 0, sizeof(real[DIM_MAX][DIM_MAX][DIM_MAX][DIM_MAX]));
    for (int64_t m = 0; m < p->n; m++)
        for (int64_t j = 0; j < p->n; j++) {
            real xi[DIM_MAX], r;
            if (p->kind[m] != KIND_PD || p->kind[j] != KIND_MPM || !(w[m * p->n + j] > 0)) continue;
            r = reference_relative(p->X, p->dim, m, j, xi);
            real K = stiffness * w[m * p->n + j] / r, share = reference_inside(p, section, m, j, q);
            for (int a = 0; a < p->dim; a++)
                for (int b = 0; b < p->dim; b++)
                    for (int c = 0; c < p->dim; c++)
                        for (int d = 0; d < p->dim; d++)
                            T[a][b][c][d] +=
                                K * r * r * share * xi[a] * xi[b] * xi[c] * xi[d] / pow(r, 4) / p->volume0[q];
        }
}

/* Computes T : C^-1 sigma, the part of the stress `sigma` of a point that bonds with the stiffness T
 * (reference_partial) carry, and stores it in grid_coupled [Pa]. sigma, grid_coupled: stored symmetric tensors (xx yy
 * zz xy yz zx in 3D, xx yy xy in 2D). C: stiffness of the isotropic material m. */
static inline void reference_carried(const struct material *m, int dim, real T[DIM_MAX][DIM_MAX][DIM_MAX][DIM_MAX],
                                     const real *sigma, real *grid_coupled)
{
    real s[DIM_MAX][DIM_MAX], trace = 0;
    reference_tensor(sigma, dim, s);
    for (int a = 0; a < dim; a++) trace += s[a][a];
    for (int a = 0; a < dim; a++)
        for (int b = 0; b < dim; b++) {
            real sum = 0;
            for (int c = 0; c < dim; c++)
                for (int d = 0; d < dim; d++) {
                    real hydrostatic = c == d ? m->c12 / (dim * m->c12 + 2 * m->shear) * trace : 0;
                    real strain = dim == 1 ? s[0][0] / m->young : (s[c][d] - hydrostatic) / (2 * m->shear);
                    sum += T[a][b][c][d] * strain;
                }
            grid_coupled[reference_symmetric(dim, a, b)] = sum;
        }
}

#endif
