/* Computes what one bond contributes to the cell of a material point that it crosses: the share of its length inside
 * the cell, its response to strain, and the stiffness that it replaces there (partial_stress.c). Also computes the
 * reflections at mirrors by which bonds of images are found. */
#include <math.h>

#include "partial_parts.h"

/* Returns the fraction of a segment that is inside a cube with edges along the axes [1], 0 to 1. segment_start[dim],
 * segment_end[dim]: ends of the segment [m]; cube_centre[dim], half_edge: centre and half of the edge of the cube
 * [m]. */
real segment_fraction_in_cube(const real *segment_start, const real *segment_end, const real *cube_centre,
                              real half_edge, int dim)
{
    real in = 0, out = 1;
    for (int d = 0; d < dim; d++) {
        real from = segment_start[d] - cube_centre[d], along = segment_end[d] - segment_start[d];
        if (fabs(along) < 1e-14 * half_edge) {
            if (fabs(from) >= half_edge) return 0;
            continue;
        }
        real t0 = (-half_edge - from) / along, t1 = (half_edge - from) / along;
        in = real_max(in, real_min(t0, t1));
        out = real_min(out, real_max(t0, t1));
    }
    return out > in ? out - in : 0;
}

struct reflection mirror_image_reflection_from_source_particle(const struct bond_source *s, const struct particles *p,
                                                               int64_t image)
{
    struct reflection r = {.sign = {1, 1, 1}, .root = image};
    while (r.root >= p->n) { /* X of this mirror image: reflection of X of its source along one axis */
        int64_t source = s->image[r.root - p->n].source;
        for (int d = 0; d < p->dim; d++) {
            if (p->X[d][source] == p->X[d][r.root]) continue;
            r.offset[d] += r.sign[d] * (p->X[d][source] + p->X[d][r.root]);
            r.sign[d] = -r.sign[d];
        }
        r.root = source;
    }
    return r;
}

/* Returns 1 for equal indices a and b, else 0 (Kronecker's delta). */
static bool same(int a, int b) { return a == b; }

void cell_stiffness_reduction_add_bond_contribution(real *tensor, const real *point_position,
                                                    const real *other_position, const real *centre, real half_edge,
                                                    struct bond_strain_response k, int dim)
{
    real share = segment_fraction_in_cube(point_position, other_position, centre, half_edge, dim), e[DIM_MAX],
         length = 0;
    if (share == 0) return;
    for (int d = 0; d < dim; d++) e[d] = other_position[d] - point_position[d], length += square(e[d]);
    length = sqrt(length);
    for (int d = 0; d < dim; d++) e[d] /= length;
    const int n = symmetric_tensor_component_count(dim);
    for (int s = 0; s < n; s++)
        for (int t = 0; t < n; t++) {
            int a, b, c, d;
            symmetric_tensor_component_axes(dim, s, &a, &b);
            symmetric_tensor_component_axes(dim, t, &c, &d);
            real turned = e[b] * e[d] * same(a, c) + e[b] * e[c] * same(a, d) + e[a] * e[d] * same(b, c) +
                          e[a] * e[c] * same(b, d);
            tensor[s * n + t] += share * (k.central * e[a] * e[b] * e[c] * e[d] +
                                          k.pressure * e[a] * e[b] * same(c, d) + 0.25 * k.vector * turned);
        }
}

/* Returns V/Q of a particle of p [m^-2]: its volume V divided by Q, the weighted volume of its neighbourhood (sum of w
 * xi^2 V over its bonds). Without bonds in b, V and Q are those of a complete neighbourhood on the lattice. s: the
 * neighbourhood on the lattice and the list of images; i: index of the particle or of a mirror image of it. */
static real family_share(const struct particles *p, const struct bonds *b, const struct bond_source *s, int64_t i)
{
    const int32_t row = b->row_of[mirror_image_source_particle(p, s->image, i)];
    return row >= 0 ? p->volume0[i] / b->state.weighted[row] : s->family.cell_volume / s->family.weighted;
}

struct bond_strain_response bond_force_derivative_by_strain(const struct particles *p, const struct bonds *b,
                                                            const struct bond_source *s, int32_t i,
                                                            const struct bond *bond)
{
    const int32_t j = bond->nbr;
    const real r = fabs(1 / bond->inverse_length), D = p->dim;
    if (!s->modulus) return (struct bond_strain_response){.central = b->stiffness * bond->w * r};
    const struct state_modulus *m = &s->modulus[p->material[i]], *n = &s->modulus[p->material[j]];
    const real first = family_share(p, b, s, i), second = family_share(p, b, s, j), scale = bond->w * r * r;
    const real spring = scale * (m->B * first + n->B * second);
    return (struct bond_strain_response){.pressure = scale * (m->A * first + n->A * second) / D,
                                         .central = s->rotates ? 0 : spring,
                                         .vector = s->rotates ? spring : 0};
}
