/* Reference implementation of the transfer kernels, written from the formulas of the material point method and not from
 * the kernels: every particle interacts with every node, one node at a time, full tensors, no threads. */
#ifndef CLEAVE_TESTS_REFERENCE_POINTS
#define CLEAVE_TESTS_REFERENCE_POINTS

#include "data/grid.h"
#include "kernels/kernels.h"
#include "reference.h"

/* ==== shape functions ==================================================== */

/* Value N of a shape function at a point [1], and its slope dN/dx [1/m]. */
struct reference_shape {
    real value, slope;
};

/* Returns the linear shape function at the signed distance r from its node [m]: 1 at r = 0, 0 for |r| >= h. h: edge of
 * a cell [m]. */
static inline real reference_tent(real r, real h) { return fmax(0, 1 - fabs(r) / h); }

/* Returns the integral of the linear shape function from -h to r [m]. h: edge of a cell [m]. */
static inline real reference_tent_integral(real r, real h)
{
    if (r <= -h) return 0;
    if (r >= h) return h;
    return r < 0 ? 0.5 * (h + r) * (h + r) / h : h - 0.5 * (h - r) * (h - r) / h;
}

/* Returns value and slope of the shape function `shape` of a node in one direction, at a point whose signed distance
 * from the node is r [m]. h: edge of a cell [m]; l: half the width of the point [m], over which GIMP averages the
 * linear function. */
static inline struct reference_shape reference_shape(enum shape shape, real r, real h, real l)
{
    real s = fabs(r) / h, sign = r < 0 ? -1 : 1;
    switch (shape) {
    case SHAPE_LINEAR:
        return (struct reference_shape){reference_tent(r, h), s < 1 ? -sign / h : 0};
    case SHAPE_GIMP:
    case SHAPE_CPGIMP:
        return (struct reference_shape){(reference_tent_integral(r + l, h) - reference_tent_integral(r - l, h)) /
                                            (2 * l),
                                        (reference_tent(r + l, h) - reference_tent(r - l, h)) / (2 * l)};
    case SHAPE_QUADRATIC:
        if (s < 0.5) return (struct reference_shape){0.75 - s * s, -2 * s * sign / h};
        if (s < 1.5) return (struct reference_shape){0.5 * (1.5 - s) * (1.5 - s), -(1.5 - s) * sign / h};
        return (struct reference_shape){0, 0};
    case SHAPE_CUBIC:
        if (s < 1)
            return (struct reference_shape){2.0 / 3 - s * s + 0.5 * s * s * s, (-2 * s + 1.5 * s * s) * sign / h};
        if (s < 2) return (struct reference_shape){pow(2 - s, 3) / 6, -0.5 * (2 - s) * (2 - s) * sign / h};
        return (struct reference_shape){0, 0};
    default:
        return (struct reference_shape){NAN, NAN};
    }
}

/* ==== one step of the material point method  =================================== */

/* State of one step. The caller sets the members above `value`; the others are allocated by reference_step_make.
 * half_width: half the width of an undeformed point [m]; dt, dt_velocity: time steps for positions and strains, and for
 * velocities [s]; smallest_mass: mass below which a node does not move [kg]. mass to `change` are nodal values;
 * `momentum` is overwritten by the velocity of the second map of FLIP, `change` is the increment of the velocity in the
 * step. */
struct reference_step {
    enum shape shape;
    enum transfer transfer;
    real half_width, dt, dt_velocity, smallest_mass;
    const struct elastic *elastic;
    const struct partial_stress *partial;
    const uint8_t *bonded;        /* nonzero: bonds end at the point; NULL: none */
    struct particles *p;          /* updated step by step */
    const struct grid *g;         /* positions of nodes; its values are not used */
    real *value, *slope[DIM_MAX]; /* N and grad N, [n][nodes], at the old positions */
    real *mass, *momentum[DIM_MAX], *force[DIM_MAX], *velocity[DIM_MAX], *change[DIM_MAX];
    real *more; /* [n] change of mean stress or rate of dilatation by the mean of the cell */
};

/* Computes the position x[dim] [m] of the node with the index `node` of the grid g. */
static inline void reference_node_position(const struct grid *g, int64_t node, real *x)
{
    for (int d = 0; d < g->dim; d++) {
        x[d] = grid_node_position(g, d, node % g->count[d]);
        node /= g->count[d];
    }
}

/* Computes the shape function N and its gradient of every node at every particle, as products of the functions in each
 * direction, and stores them in s->value and s->slope. */
static inline void reference_weights(struct reference_step *s)
{
    const struct particles *p = s->p;
    for (int64_t i = 0; i < p->n; i++)
        for (int64_t I = 0; I < s->g->n; I++) {
            real x[DIM_MAX], *value = &s->value[i * s->g->n + I];
            struct reference_shape one[DIM_MAX];
            reference_node_position(s->g, I, x);
            *value = 1;
            for (int d = 0; d < p->dim; d++) {
                real l = s->half_width * (s->shape == SHAPE_CPGIMP ? p->stretch[d][i] : 1);
                one[d] = reference_shape(s->shape, p->x[d][i] - x[d], s->g->h, l);
                *value *= one[d].value;
            }
            for (int d = 0; d < p->dim; d++) {
                real slope = one[d].slope;
                for (int e = 0; e < p->dim; e++) slope *= e == d ? 1 : one[e].value;
                s->slope[d][i * s->g->n + I] = slope;
            }
        }
}

/* Allocates the nodal values of a step, all 0, and computes N and grad N. Release with reference_step_free. */
static inline void reference_step_make(struct reference_step *s)
{
    int64_t nodes = s->g->n;
    s->value = NEW("reference.value", s->p->n * nodes, real);
    s->mass = NEW("reference.mass", nodes, real);
    s->more = NEW("reference.more", s->p->n, real);
    for (int d = 0; d < s->p->dim; d++) {
        s->slope[d] = NEW("reference.slope", s->p->n * nodes, real);
        s->momentum[d] = NEW("reference.momentum", nodes, real);
        s->force[d] = NEW("reference.force", nodes, real);
        s->velocity[d] = NEW("reference.velocity", nodes, real);
        s->change[d] = NEW("reference.change", nodes, real);
    }
    reference_weights(s);
}

/* Frees the arrays that reference_step_make has allocated. */
static inline void reference_step_free(struct reference_step *s)
{
    memory_free(s->value);
    memory_free(s->mass);
    memory_free(s->more);
    for (int d = 0; d < s->p->dim; d++) {
        memory_free(s->slope[d]);
        memory_free(s->momentum[d]);
        memory_free(s->force[d]);
        memory_free(s->velocity[d]);
        memory_free(s->change[d]);
    }
}

/* Computes the stress that point i transmits to the grid, and stores it in `tensor`, dim x dim [Pa]: its stress minus
 * the part that bonds between peridynamic particles and material points carry. */
static inline void reference_given(const struct reference_step *s, int64_t i, real tensor[DIM_MAX][DIM_MAX])
{
    int n = symmetric_tensor_component_count(s->p->dim);
    real sigma[SYM_MAX], given[SYM_MAX];
    for (int a = 0; a < n; a++) given[a] = sigma[a] = s->p->stress[a][i];
    if (s->partial->index && s->partial->index[i] >= 0)
        for (int a = 0; a < n; a++)
            for (int b = 0; b < n; b++)
                given[a] -= s->partial->matrix[(s->partial->index[i] * n + a) * n + b] * sigma[b];
    reference_tensor(given, s->p->dim, tensor);
}

/* Sums the momentum of the material points of the step s to the nodes (s->momentum) and, if with_mass is true, their
 * mass too (s->mass). With FLIP the velocity of a point is uniform; with APIC it varies linearly round the point. */
static inline void reference_map(struct reference_step *s, bool with_mass)
{
    const struct particles *p = s->p;
    for (int64_t I = 0; I < s->g->n; I++) {
        real x[DIM_MAX];
        reference_node_position(s->g, I, x);
        if (with_mass) s->mass[I] = 0;
        for (int d = 0; d < p->dim; d++) s->momentum[d][I] = 0;
        for (int64_t i = 0; i < p->n; i++) {
            if (p->kind[i] != KIND_MPM) continue;
            real share = p->mass[i] * s->value[i * s->g->n + I];
            if (with_mass) s->mass[I] += share;
            for (int a = 0; a < p->dim; a++) {
                real v = p->v[a][i];
                for (int b = 0; b < p->dim && s->transfer == TRANSFER_APIC; b++)
                    v += p->gradient[a * p->dim + b][i] * (x[b] - p->x[b][i]);
                s->momentum[a][I] += share * v;
            }
        }
    }
}

/* Returns true if points i and j have the mean dilatation of a cell in common: both are material points of one body and
 * of one material, which uses mean dilatations, and both are in the same cell. Also true for i = j. */
static inline bool reference_together(const struct reference_step *s, int64_t i, int64_t j)
{
    const struct particles *p = s->p;
    bool same = p->kind[i] == KIND_MPM && p->kind[j] == KIND_MPM && p->material[i] == p->material[j] &&
                p->body[i] == p->body[j] && s->elastic[p->material[i]].mean_dilatation;
    for (int d = 0; d < p->dim && same; d++)
        same = floor((p->x[d][i] - s->g->anchor[d]) / s->g->h) == floor((p->x[d][j] - s->g->anchor[d]) / s->g->h);
    return same;
}

/* Computes change[i], the difference between the mean of `value` and value[i]. The mean is weighted by volume, over all
 * points that have the dilatation in common with point i (reference_together); change[i] is 0 if there are none. */
static inline void reference_means(const struct reference_step *s, const real *value, real *change)
{
    for (int64_t i = 0; i < s->p->n; i++) {
        real volume = 0, sum = 0;
        for (int64_t j = 0; j < s->p->n; j++)
            if (reference_together(s, i, j)) volume += s->p->volume[j], sum += s->p->volume[j] * value[j];
        change[i] = volume > 0 ? sum / volume - value[i] : 0;
    }
}

/* Returns the trace of a tensor of dim x dim. */
static inline real reference_trace(real tensor[DIM_MAX][DIM_MAX], int dim)
{
    real sum = 0;
    for (int d = 0; d < dim; d++) sum += tensor[d][d];
    return sum;
}

/* Computes the change of the mean stress of each point by averaging over the points of its cell that have their
 * dilatation in common (reference_together), and stores it in s->more [Pa]. */
static inline void reference_pressures(struct reference_step *s)
{
    real *mean = NEW("reference.mean", s->p->n, real);
    for (int64_t i = 0; i < s->p->n; i++) {
        real sigma[DIM_MAX][DIM_MAX];
        reference_given(s, i, sigma);
        mean[i] = reference_trace(sigma, s->p->dim) / s->p->dim;
    }
    reference_means(s, mean, s->more);
    memory_free(mean);
}

/* Adds the forces of all material points to the nodal forces s->force: -V sigma . grad N, with volume V and transmitted
 * stress sigma of the point (reference_given), and N f, with the external force f on the point. */
static inline void reference_forces(struct reference_step *s)
{
    const struct particles *p = s->p;
    reference_pressures(s);
    for (int64_t i = 0; i < p->n; i++) {
        real sigma[DIM_MAX][DIM_MAX];
        if (p->kind[i] != KIND_MPM) continue;
        reference_given(s, i, sigma);
        for (int d = 0; d < p->dim; d++) sigma[d][d] += s->more[i];
        for (int64_t I = 0; I < s->g->n; I++)
            for (int a = 0; a < p->dim; a++) {
                s->force[a][I] += s->value[i * s->g->n + I] * p->f[a][i];
                for (int b = 0; b < p->dim; b++)
                    s->force[a][I] -= p->volume[i] * sigma[a][b] * s->slope[b][i * s->g->n + I];
            }
    }
}

/* Computes the nodal velocities at the end of the step and their increments by the nodal forces; both are 0 at nodes
 * lighter than the smallest mass. */
static inline void reference_move(struct reference_step *s)
{
    for (int64_t I = 0; I < s->g->n; I++)
        for (int d = 0; d < s->p->dim; d++) {
            bool light = s->mass[I] < s->smallest_mass;
            s->change[d][I] = light ? 0 : s->dt_velocity * s->force[d][I] / s->mass[I];
            s->velocity[d][I] = light ? 0 : s->momentum[d][I] / s->mass[I] + s->change[d][I];
        }
}

/* Returns the sum of the nodal field `field` over all nodes, with the weights of point i: the value of the field at
 * point i if `weight` is s->value, component d of its gradient if `weight` is s->slope[d]. */
static inline real reference_at(const struct reference_step *s, const real *weight, const real *field, int64_t i)
{
    real sum = 0;
    for (int64_t I = 0; I < s->g->n; I++) sum += weight[i * s->g->n + I] * field[I];
    return sum;
}

/* Updates the velocities of the points (FLIP) by the increments s->change at the nodes, and maps the new momentum of
 * the points to the nodes with the old weights. Stores the nodal velocities of this second map in s->momentum, 0 at
 * nodes below the smallest mass. */
static inline void reference_remap(struct reference_step *s)
{
    for (int64_t i = 0; i < s->p->n; i++)
        for (int d = 0; d < s->p->dim; d++)
            if (s->p->kind[i] == KIND_MPM) s->p->v[d][i] += reference_at(s, s->value, s->change[d], i);
    reference_map(s, false);
    for (int64_t I = 0; I < s->g->n; I++)
        for (int d = 0; d < s->p->dim; d++)
            s->momentum[d][I] = s->mass[I] < s->smallest_mass ? 0 : s->momentum[d][I] / s->mass[I];
}

/* Computes the product c = a b of two tensors of dim x dim. */
static inline void reference_product(real a[DIM_MAX][DIM_MAX], real b[DIM_MAX][DIM_MAX], real c[DIM_MAX][DIM_MAX],
                                     int dim)
{
    for (int i = 0; i < dim; i++)
        for (int j = 0; j < dim; j++) {
            c[i][j] = 0;
            for (int k = 0; k < dim; k++) c[i][j] += a[i][k] * b[k][j];
        }
}

/* Rotates the stress sigma in place by the spin increment W (antisymmetric): up to 3e-5 rad sigma + W sigma - sigma W;
 * up to 1e-3 rad likewise with the half-rotated stress in the last two terms; beyond, R sigma R^T with R = exp W, from
 * its power series. */
static inline void reference_rotate(real sigma[DIM_MAX][DIM_MAX], real W[DIM_MAX][DIM_MAX], int dim)
{
    real a[DIM_MAX][DIM_MAX], b[DIM_MAX][DIM_MAX], R[DIM_MAX][DIM_MAX] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, angle2 = 0;
    real term[DIM_MAX][DIM_MAX] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, turned[DIM_MAX][DIM_MAX];
    for (int i = 0; i < dim; i++)
        for (int j = 0; j < i; j++) angle2 += W[i][j] * W[i][j];
    reference_product(W, sigma, a, dim);
    reference_product(sigma, W, b, dim);
    for (int i = 0; i < dim; i++)
        for (int j = 0; j < dim; j++)
            turned[i][j] = sigma[i][j] + (sqrt(angle2) <= 3e-5 ? 0 : 0.5 * (a[i][j] - b[i][j]));
    reference_product(W, turned, a, dim);
    reference_product(turned, W, b, dim);
    for (int i = 0; i < dim && sqrt(angle2) <= 1e-3; i++)
        for (int j = 0; j < dim; j++) sigma[i][j] += a[i][j] - b[i][j];
    if (sqrt(angle2) <= 1e-3) return;
    for (int n = 1; n < 20; n++) {
        reference_product(term, W, a, dim);
        for (int i = 0; i < dim; i++)
            for (int j = 0; j < dim; j++) R[i][j] += term[i][j] = a[i][j] / n;
    }
    reference_product(R, sigma, turned, dim);
    for (int i = 0; i < dim; i++)
        for (int j = 0; j < dim; j++) a[i][j] = R[j][i];
    reference_product(turned, a, b, dim);
    memcpy(sigma, b, sizeof b);
}

/* Updates the state of point i with the velocity gradient L [1/s]: rotates its stress with the spin (Jaumann), adds the
 * stress increment by Hooke's law for the strain increment sym(L) dt - W W/2, with the spin increment W, and updates
 * the volume of the point and, with CPGIMP, its stretches along the axes. */
static inline void reference_stress(const struct reference_step *s, int64_t i, real L[DIM_MAX][DIM_MAX])
{
    struct particles *p = s->p;
    const struct elastic *c = &s->elastic[p->material[i]];
    real sigma[DIM_MAX][DIM_MAX] = {{0}}, W[DIM_MAX][DIM_MAX] = {{0}}, WW[DIM_MAX][DIM_MAX], old[SYM_MAX], trace = 0;
    for (int a = 0; a < symmetric_tensor_component_count(p->dim); a++) old[a] = p->stress[a][i];
    reference_tensor(old, p->dim, sigma);
    for (int a = 0; a < p->dim; a++)
        for (int b = 0; b < p->dim; b++) W[a][b] = 0.5 * s->dt * (L[a][b] - L[b][a]);
    reference_product(W, W, WW, p->dim);
    for (int a = 0; a < p->dim; a++) trace += L[a][a] * s->dt - 0.5 * WW[a][a];
    reference_rotate(sigma, W, p->dim);
    for (int a = 0; a < p->dim; a++)
        for (int b = 0; b <= a; b++) {
            real strain = 0.5 * s->dt * (L[a][b] + L[b][a]) - 0.5 * WW[a][b];
            sigma[a][b] += a == b ? (c->c11 - c->c12) * strain + c->c12 * trace : 2 * c->shear * strain;
            p->stress[reference_symmetric(p->dim, a, b)][i] = sigma[a][b];
        }
    p->volume[i] *= 1 + trace;
    for (int a = 0; a < p->dim && s->shape == SHAPE_CPGIMP; a++) p->stretch[a][i] *= 1 + s->dt * L[a][a];
}

/* Computes the velocity gradient L at point i [1/s], from the velocities of the second map (FLIP) or the nodal
 * velocities at the end of the step (APIC). */
static inline void reference_gradient(const struct reference_step *s, int64_t i, real L[DIM_MAX][DIM_MAX])
{
    real *const *straining = s->transfer == TRANSFER_APIC ? s->velocity : s->momentum;
    for (int a = 0; a < s->p->dim; a++)
        for (int b = 0; b < s->p->dim; b++) L[a][b] = reference_at(s, s->slope[b], straining[a], i);
}

/* Computes the change of the rate of dilatation of each point by averaging over the points of its cell that have their
 * dilatation in common (reference_together), and stores it in s->more [1/s]. */
static inline void reference_dilatations(struct reference_step *s)
{
    real *rate = NEW("reference.rate", s->p->n, real), L[DIM_MAX][DIM_MAX];
    for (int64_t i = 0; i < s->p->n; i++) {
        reference_gradient(s, i, L);
        rate[i] = reference_trace(L, s->p->dim);
    }
    reference_means(s, rate, s->more);
    memory_free(rate);
}

/* Moves all material points and updates their stress and volume (reference_gradient, reference_stress). Points move
 * with the nodal velocities at the end of the step; with FLIP, points at which bonds end (s->bonded) move with the
 * velocities of the second map. With APIC, also sets the velocities and velocity gradients of the points. */
static inline void reference_gather(struct reference_step *s)
{
    struct particles *p = s->p;
    bool affine = s->transfer == TRANSFER_APIC;
    reference_dilatations(s);
    for (int64_t i = 0; i < p->n; i++) {
        real L[DIM_MAX][DIM_MAX];
        if (p->kind[i] != KIND_MPM) continue;
        real *const *straining = affine ? s->velocity : s->momentum;
        real *const *moving = s->bonded && s->bonded[i] ? straining : s->velocity;
        reference_gradient(s, i, L);
        for (int a = 0; a < p->dim && affine; a++)
            for (int b = 0; b < p->dim; b++) p->gradient[a * p->dim + b][i] = L[a][b];
        for (int a = 0; a < p->dim; a++) L[a][a] += s->more[i] / p->dim;
        for (int a = 0; a < p->dim; a++) {
            real v = reference_at(s, s->value, moving[a], i);
            if (affine) p->v[a][i] = v;
            p->x[a][i] += s->dt * v;
        }
        reference_stress(s, i, L);
    }
}

/* Returns the largest eigenvalue (principal stress) [Pa] of a stored symmetric tensor, by Jacobi rotations. symmetric:
 * components xx yy zz xy yz zx in 3D, xx yy xy in 2D. */
static inline real reference_principal(const real *symmetric, int dim)
{
    real t[DIM_MAX][DIM_MAX], largest = -INFINITY;
    reference_tensor(symmetric, dim, t);
    for (int sweep = 0; sweep < 20; sweep++)
        for (int a = 0; a < dim; a++)
            for (int b = a + 1; b < dim; b++) {
                real angle = 0.5 * atan2(2 * t[a][b], t[a][a] - t[b][b]), c = cos(angle), s = sin(angle);
                for (int k = 0; k < dim; k++) {
                    real left = t[a][k], right = t[b][k];
                    t[a][k] = c * left + s * right, t[b][k] = c * right - s * left;
                }
                for (int k = 0; k < dim; k++) {
                    real left = t[k][a], right = t[k][b];
                    t[k][a] = c * left + s * right, t[k][b] = c * right - s * left;
                }
            }
    for (int a = 0; a < dim; a++) largest = fmax(largest, t[a][a]);
    return largest;
}

#endif
