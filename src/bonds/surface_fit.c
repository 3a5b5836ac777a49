/* Computes the factors of bonds near faces by a bounded linear least-squares problem, solved by Newton's
 * method on its dual.
 *
 * With the moments M4 = sum f w r nnnn and M3 = sum f w nnn of a class of particles (w, r, n: weight, length
 * and direction of a bond), the factors f minimise
 *
 *     sum_classes members [ |M4 - (1 + tau) M|^2 + |M3 + M A/2|^2 ] + PRIOR sum_bonds (f - 1)^2,
 *     LEAST <= f <= MOST
 *
 * with the fourth moment M of a full neighbourhood, the area vector A of the faces of the particle, the
 * increase tau of M4 that faces require, and the number of particles (`members`) of a class. |T|^2 = sum_k
 * (T:B_k) P (T:B_k) over a basis B of strains, and P = (1 + STIFF Q)^-1 reduces the weight of strains by the
 * traction that they cause on faces nearby, Q(e, e') = (M:e) : N (x) N : (M:e'), N: face normal. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "bonds_parts.h"
#include "surface_parts.h"

#define STIFF 1000.0   /* weight of a strain that loads a face: 1/STIFF; empirical */
#define ROTATIONS -0.2 /* alpha of models with rotations: fitted to bending */
/* Weight of the term (f - 1)^2 of a bond with the factor f, relative to the mean square of a bond in its moments [1].
 * Empirical: with a twentieth of it, frequencies of beams of 10 layers are more accurate by 0.1 %, and time steps
 * shorter by a fifth. Wider limits LEAST and MOST of the factors have the same effect. */
#define PRIOR 2e-2
#define LEAST 0.2     /* smallest factor of a bond [1] */
#define MOST 3.0      /* largest factor of a bond [1] */
enum { STRAINS = 6 }; /* number of independent strain tensors in 3D */

/* The independent components of symmetric tensors of rank `rank` in ascending order: component k has the axes
 * axis[k][rank], each >= the one before. */
struct components {
    int n, rank, axis[FOURTHS][4];
};

/* Lists in c the independent components of symmetric tensors of rank `rank` (up to 4) in dim dimensions: all ascending
 * sequences of axes. */
static void components_make(struct components *c, int rank, int dim)
{
    int axis[4] = {0};
    c->n = 0, c->rank = rank;
    for (;;) {
        memcpy(c->axis[c->n++], axis, sizeof axis);
        int k = rank - 1;
        while (k >= 0 && axis[k] == dim - 1) k--;
        if (k < 0) return;
        for (int next = axis[k] + 1; k < rank; k++) axis[k] = next;
    }
}

/* Returns the index in c of the tensor component with the axes any[rank], in any order; -1 if c does not contain it. */
static int component_of(const struct components *c, const int *any)
{
    int axis[4];
    array_copy(axis, any, c->rank, sizeof *axis);
    for (int a = 1; a < c->rank; a++)
        for (int b = a; b > 0 && axis[b - 1] > axis[b]; b--) {
            const int swap = axis[b];
            axis[b] = axis[b - 1], axis[b - 1] = swap;
        }
    for (int k = 0; k < c->n; k++)
        if (arrays_equal(c->axis[k], axis, c->rank, sizeof *axis)) return k;
    return -1;
}

/* Returns component k of c of the tensor product n (x) n (x) .. of a unit vector n[dim], with as many factors as the
 * rank. */
static real component_value(const struct components *c, int k, const real *n)
{
    real value = 1;
    for (int a = 0; a < c->rank; a++) value *= n[c->axis[k][a]];
    return value;
}

/* Moments of the bonds at each lattice offset (direction n, weight w, length r): third moment w nnn, fourth moment w r
 * nnnn; the fourth moment M of a full neighbourhood; and a basis B_k of symmetric strain tensors. They are equal for
 * all classes of particles. */
struct moments {
    int dim, strains;                /* dimension; number of tensors B_k */
    struct components third, fourth; /* independent components of both moments */
    int thirds, width;               /* number of third moments, and of all moments of a bond, padding included */
    real *of;                        /* [offsets][width] moments of the bonds divided by M_1111 */
    real full[FOURTHS];              /* components of M divided by M_1111 */
    real strain[STRAINS][DIM_MAX][DIM_MAX], stress[STRAINS][DIM_MAX][DIM_MAX]; /* B_k; stress M:B_k */
    real fourth_by[STRAINS][STRAINS][FOURTHS]; /* coefficients of B_k:T:B_l by component of T */
    real third_by[DIM_MAX][STRAINS][THIRDS];   /* coefficients of n_p.T:B_l by component of T */
};

/* Returns component abcd of the fourth moment M of a full neighbourhood, divided by M_1111 [1]. M is the sum of w r
 * nnnn over the bonds, with weight w, length r and direction n. m: has M; a, b, c, d: axes, from 0. */
static real full_of(const struct moments *m, int a, int b, int c, int d)
{
    return m->full[component_of(&m->fourth, (const int[]){a, b, c, d})];
}

/* Computes in m the basis of strains in which deviations of moment tensors are measured: orthonormal symmetric strain
 * tensors B_k, the stresses M:B_k, with the fourth moment M of a full neighbourhood (m->full), and the coefficients by
 * which products of B_k with a moment tensor follow from the components of this tensor. */
static void strains_make(struct moments *m)
{
    const int dim = m->dim;
    for (int a = 0; a < dim; a++) m->strain[m->strains++][a][a] = 1;
    for (int a = 0; a < dim; a++)
        for (int c = a + 1; c < dim; c++, m->strains++)
            m->strain[m->strains][a][c] = m->strain[m->strains][c][a] = sqrt(0.5);
    for (int k = 0; k < m->strains; k++)
        for (int a = 0; a < dim; a++)
            for (int b = 0; b < dim; b++)
                for (int c = 0; c < dim; c++)
                    for (int d = 0; d < dim; d++) {
                        const real e = m->strain[k][c][d];
                        m->stress[k][a][b] += e != 0 ? full_of(m, a, b, c, d) * e : 0;
                        for (int l = 0; l < m->strains && e != 0; l++)
                            m->fourth_by[l][k][component_of(&m->fourth, (const int[]){a, b, c, d})] +=
                                m->strain[l][a][b] * e;
                        if (b == 0 && e != 0) m->third_by[a][k][component_of(&m->third, (const int[]){a, c, d})] += e;
                    }
}

/* Computes in m, all divided by M_1111: for the bond at each lattice offset of o the third moment w nnn and the fourth
 * moment w r nnnn (direction n, weight w, length r), and the fourth moment M of a full neighbourhood. Then computes the
 * basis of strains. */
static void moments_make(struct moments *m, const struct offsets *o)
{
    real sum[FOURTHS] = {0};
    *m = (struct moments){.dim = o->dim};
    components_make(&m->third, 3, o->dim);
    components_make(&m->fourth, 4, o->dim);
    for (int k = 0; k < o->n; k++)
        for (int c = 0; c < m->fourth.n; c++)
            sum[c] += o->weight[k] * o->length[k] * component_value(&m->fourth, c, o->direction[k]);
    for (int c = 0; c < m->fourth.n; c++) m->full[c] = sum[c] / sum[0];
    m->thirds = o->dim < 3 ? THIRDS_2D : THIRDS;
    m->width = o->dim < 3 ? THIRDS_2D + FOURTHS_2D : THIRDS + FOURTHS;
    m->of = NEW("surface.moments", (int64_t)o->n * m->width, real);
    for (int k = 0; k < o->n; k++) {
        real *third = m->of + (int64_t)k * m->width, *fourth = third + m->thirds;
        for (int c = 0; c < m->third.n; c++)
            third[c] = o->weight[k] * component_value(&m->third, c, o->direction[k]) / sum[0];
        for (int c = 0; c < m->fourth.n; c++)
            fourth[c] = o->weight[k] * o->length[k] * component_value(&m->fourth, c, o->direction[k]) / sum[0];
    }
    strains_make(m);
}

/* Returns the constant alpha of models without particle rotations [1]: near a face the fourth moments of the bonds are
 * to be (1 + alpha dipole) M, where M is the fourth moment of a full neighbourhood and the dipole is 1 in the first
 * layer of particles and -1 in the second. alpha is the value for a plane face along which the body is stretched; in an
 * isotropic neighbourhood the value for shear along the face is equal. m: has M; o: lattice offsets with their
 * weights. */
static real face_moment(const struct moments *m, const struct offsets *o)
{
    const real c11 = m->full[0], c12 = full_of(m, 0, 0, 1, 1), across = c12 / (c11 + (m->dim - 2) * c12);
    real sum = 0, weight = 0;
    for (int k = 0; k < o->n; k++) {
        real strain = square(o->direction[k][0]);
        for (int d = 1; d < m->dim; d++) strain -= across * square(o->direction[k][d]);
        const real w = o->weight[k] * o->length[k] * square(strain);
        sum += w * square((real)o->at[k][1]), weight += w;
    }
    return 1.0 / 24 + sum / weight / 8;
}

/* ---- a class ----------------------------------------------------------------------------------------------------- */

/* Inverts the symmetric positive definite matrix a with n rows in place by Gauss-Jordan elimination. capacity: distance
 * from the start of one row in memory to that of the next [numbers]. */
static void invert(real *a, int n, int capacity)
{
    for (int k = 0; k < n; k++) {
        real *row = a + k * capacity;
        const real pivot = 1 / row[k];
        row[k] = 1;
        for (int c = 0; c < n; c++) row[c] *= pivot;
        for (int r = 0; r < n; r++) {
            if (r == k) continue;
            real *other = a + r * capacity;
            const real factor = other[k];
            other[k] = 0;
            for (int c = 0; c < n; c++) other[c] -= factor * row[c];
        }
    }
}

/* Computes the weights P = (1 + STIFF Q)^-1 of the basis strains B_k in the least-squares fit of bonds near faces,
 * P[k][l] over the strains of m. Q_kl = (M:B_k) : N (x) N : (M:B_l) is the product of the tractions that two strains
 * cause on faces nearby; strains without such tractions have the weight 1. M: fourth moment of a full neighbourhood;
 * STIFF: a constant; normal2: mean of N (x) N over the faces nearby, with unit normals N. */
static void strain_weights(const struct moments *m, real (*normal2)[DIM_MAX], real (*P)[STRAINS])
{
    const int dim = m->dim;
    for (int k = 0; k < m->strains; k++)
        for (int l = 0; l < m->strains; l++) {
            real traction = 0;
            for (int a = 0; a < dim; a++)
                for (int b = 0; b < dim; b++)
                    for (int c = 0; c < dim; c++) traction += m->stress[k][a][b] * normal2[b][c] * m->stress[l][a][c];
            P[k][l] = (k == l) + STIFF * traction;
        }
    invert(&P[0][0], m->strains, STRAINS);
}

/* Adds sum_k A_k^T P A_k to the matrix `to` with n rows. by: the matrices A_k, k = 0 .. rows - 1, each of STRAINS rows,
 * of which the first `strains` are used, and n columns; capacity: distance from the start of one row to that of the
 * next in A_k and `to` [numbers]; P: symmetric matrix. */
static void quadratic(const real *by, int rows, int strains, int n, int capacity, real (*P)[STRAINS], real *to)
{
    for (int k = 0; k < rows; k++)
        for (int l = 0; l < strains; l++) {
            real half[FOURTHS] = {0};
            for (int q = 0; q < strains; q++)
                for (int y = 0; y < n; y++) half[y] += P[l][q] * by[(k * STRAINS + q) * capacity + y];
            for (int x = 0; x < n; x++)
                for (int y = 0; y < n; y++) to[x * capacity + y] += by[(k * STRAINS + l) * capacity + x] * half[y];
        }
}

/* Averages, over the particles of a class (particles with equal surroundings), of three properties of faces that
 * determine the targets of the bond moments: face area, dipole (difference between the first layers behind a face) and
 * product of face normals N (x) N. A particle counts in all reflections under which its class is unchanged, because
 * particles of one class may differ beyond the surroundings that define the class. */
struct class_goal {
    real area[DIM_MAX], dipole, normal2[DIM_MAX][DIM_MAX];
};

/* Adds three properties of a particle, times `share` [1], to *to, the means over its class (particles with equal
 * surroundings): face area, dipole (difference between the first layers behind a face) and N (x) N (N: unit normal of
 * faces nearby). Area and N are first reflected across the axes in `mirrors` (bit d: axis d). f: the properties of all
 * particles; dim: number of dimensions; t: index of the particle among those near faces. */
static void class_goal_add(struct class_goal *to, int dim, const struct surface_fit_targets *f, int64_t t, int mirrors,
                           real share)
{
    to->dipole += share * f->dipole[t];
    for (int d = 0; d < dim; d++) {
        const real sign = share * mirror_sign_of_vector_component(mirrors, d);
        to->area[d] += sign * f->area[t][d];
        for (int e = 0; e < dim; e++)
            to->normal2[d][e] += sign * mirror_sign_of_vector_component(mirrors, e) * f->normal2[t][d][e];
    }
}

/* Computes goal[classes], the means of three properties over the particles of each class (particles with equal
 * surroundings): face area, dipole (difference between the first layers behind a face) and product of face normals N
 * (x) N. goal must be 0 before. dim: number of dimensions; near_faces: particles near faces; f: values of each
 * particle; a: classes. */
static void class_goals(struct class_goal *goal, int dim, const struct particles_near_faces *near_faces,
                        const struct surface_fit_targets *f, const struct bond_classes *a)
{
    for (int64_t t = 0; t < near_faces->n; t++) {
        const int32_t class = a->class_of[t];
        const int symmetry = a->symmetry[class];
        const real share = 1 / (a->members[class] * __builtin_popcount((unsigned)symmetry));
        for (int m = 0; m < 1 << dim; m++)
            if (symmetry >> m & 1) class_goal_add(&goal[class], dim, f, t, a->mirrors[t] ^ m, share);
    }
}

/* Sets up c, the least-squares fit of the bonds of one class (particles with equal surroundings): the quadratic form
 * that weighs deviations of their third and fourth moments, and the targets of these moments, from which the moments of
 * bonds with fixed factors are subtracted. m: moments of the bonds; near_faces: particles near faces; a: classes; goal:
 * means of the face properties over the class; class: its number, from 1; alpha: relative increase of the target of the
 * fourth moments for a dipole of 1 [1]. */
static void class_make(struct class_fit *c, const struct moments *m, const struct particles_near_faces *near_faces,
                       struct class_goal *goal, const struct bond_classes *a, int32_t class, real alpha)
{
    real P[STRAINS][STRAINS];
    strain_weights(m, goal->normal2, P);
    *c = (struct class_fit){{{0}}, {{0}}, {0}};
    quadratic(&m->fourth_by[0][0][0], m->strains, m->strains, m->fourth.n, FOURTHS, P, &c->fourth[0][0]);
    quadratic(&m->third_by[0][0][0], m->dim, m->strains, m->third.n, THIRDS, P, &c->third[0][0]);
    for (int x = 0; x < THIRDS; x++)
        for (int y = 0; y < THIRDS; y++) c->third[x][y] *= a->members[class];
    for (int x = 0; x < FOURTHS; x++)
        for (int y = 0; y < FOURTHS; y++) c->fourth[x][y] *= a->members[class];
    for (int x = 0; x < m->third.n; x++)
        for (int d = 0; d < m->dim; d++) {
            const int *axis = m->third.axis[x];
            c->goal[x] -= 0.5 * full_of(m, axis[0], axis[1], axis[2], d) * goal->area[d];
        }
    for (int x = 0; x < m->fourth.n; x++) c->goal[m->thirds + x] = (1 + alpha * goal->dipole) * m->full[x];
    for (int k = 0; k < near_faces->offset.n; k++) { /* less the bonds that do not change */
        if (bond_class_neighbour_of_first_particle_at_offset(a, near_faces, class, k) < 0 ||
            a->group_of[(int64_t) class * near_faces->offset.n + k] >= 0)
            continue;
        for (int x = 0; x < m->width; x++) c->goal[x] -= m->of[(int64_t)k * m->width + x];
    }
}

/* Returns the sum of x . Q x over those bonds of a class (particles with equal surroundings) whose factors on their
 * weights are fitted. x: moments of a bond, the tensors w nnn and w r nnnn (direction n, weight w, length r), from m;
 * Q: quadratic form that weighs deviations of the moments of the class; class: its number in q, from 1. */
static real class_squares(const struct surface_fit_problem *q, const struct moments *m, int32_t class)
{
    const struct class_fit *c = &q->class[class];
    real sum = 0;
    for (int k = 0; k < q->offsets; k++) {
        const real *third = m->of + (int64_t)k * m->width, *fourth = third + m->thirds;
        if (q->alike->group_of[(int64_t) class * q->offsets + k] < 0) continue;
        for (int x = 0; x < m->third.n; x++)
            for (int y = 0; y < m->third.n; y++) sum += third[x] * c->third[x][y] * third[y];
        for (int x = 0; x < m->fourth.n; x++)
            for (int y = 0; y < m->fourth.n; y++) sum += fourth[x] * c->fourth[x][y] * fourth[y];
    }
    return sum;
}

/* ---- the problem ------------------------------------------------------------------------------------------------- */

/* Lists, for each set of bonds that share one factor, its entries in tables [classes, offsets], in q->first and
 * q->entry. An entry is one bond of each particle of a class (particles with equal surroundings); each bond has two
 * entries, one from each of its particles. bonds[sets]: 0 before the call, receives the number of bonds of each set. */
static void group_entries(struct surface_fit_problem *q, real *bonds)
{
    const struct bond_classes *a = q->alike;
    const int64_t entries = (int64_t)a->classes * q->offsets;
    q->first = NEW("surface.first", a->groups + 1, int64_t);
    for (int64_t k = 0; k < entries; k++)
        if (a->group_of[k] >= 0) q->first[a->group_of[k] + 1]++;
    for (int64_t g = 0; g < a->groups; g++) q->first[g + 1] += q->first[g];
    q->entry = NEW("surface.entry", q->first[a->groups], int64_t);
    int64_t *next = NEW("surface.next", a->groups, int64_t);
    array_copy(next, q->first, a->groups, sizeof *next);
    for (int64_t k = 0; k < entries; k++) {
        const int64_t g = a->group_of[k];
        if (g < 0) continue;
        q->entry[next[g]++] = k, bonds[g] += 0.5 * a->members[k / q->offsets];
    }
    memory_free(next);
}

/* Computes q->prior[sets], the weight of the term prior (f - 1)^2 that keeps the factor f of each set of bonds near 1
 * in the least-squares fit: PRIOR times the mean square of a bond's moments times the number of bonds of the set. Then
 * inverts the quadratic forms of all classes (particles with equal surroundings), which weigh deviations of the
 * moments. m: moments of the bonds. */
static void prior_make(struct surface_fit_problem *q, const struct moments *m)
{
    const struct bond_classes *a = q->alike;
    real *squares = NEW("surface.squares", a->classes, real), sum = 0, all = 0;
    q->prior = NEW("surface.prior", a->groups, real);
    group_entries(q, q->prior);
#pragma omp parallel for schedule(static)
    for (int32_t class = 1; class < a->classes; class ++) {
        squares[class] = class_squares(q, m, class);
        invert(&q->class[class].third[0][0], m->third.n, THIRDS);
        invert(&q->class[class].fourth[0][0], m->fourth.n, FOURTHS);
    }
    for (int32_t class = 1; class < a->classes; class ++) sum += squares[class];
    for (int64_t g = 0; g < a->groups; g++) all += q->prior[g];
    for (int64_t g = 0; g < a->groups; g++) q->prior[g] *= PRIOR * sum / all;
    memory_free(squares);
}

/* Returns true if a particle is at the end of a crack or of a narrow void: a neighbour of one of its neighbours is
 * within its own cutoff, but separated from it by the crack or void. t: index of the particle among `near_faces`, those
 * near faces. */
static bool at_crack_end(const struct particles_near_faces *near_faces, int64_t t)
{
    const struct offsets *o = &near_faces->offset;
    const struct particles *p = near_faces->p;
    const int32_t i = near_faces->particle[t];
    const bool across =
        particle_is_beside_void(near_faces->source->voids, i) && near_faces->source->voids->near[i] & VOID_ACROSS;
    if (!across && !particle_is_near_precrack(near_faces->source, p, i)) return false;
    for (int k = 0; k < o->n; k++) {
        const int32_t j = particles_near_faces_neighbour_at_offset(near_faces, t, k);
        if (j < 0) continue;
        const struct mirrored_particle seen = particle_or_image_find_source_and_reversed_axes(near_faces, j);
        for (int l = 0; l < o->n && near_faces->place[seen.particle] >= 0; l++) {
            int place = 0;
            bool within = mirrored_particle_neighbour_at_offset(near_faces, &seen, l).particle >= 0;
            for (int d = o->dim - 1; d >= 0; d--) {
                const int at = o->at[k][d] + o->at[l][d];
                within = within && abs(at) <= o->reach;
                place = place * (2 * o->reach + 1) + o->reach + at;
            }
            if (within && o->number[place] >= 0 &&
                particles_near_faces_neighbour_at_offset(near_faces, t, o->number[place]) < 0)
                return true;
        }
    }
    return false;
}

/* Returns the number of neighbours of a particle within the cutoff. t: index of the particle among `near_faces`, those
 * near faces. */
static int neighbours(const struct particles_near_faces *near_faces, int64_t t)
{
    int n = 0;
    for (int k = 0; k < near_faces->offset.n; k++) n += particles_near_faces_neighbour_at_offset(near_faces, t, k) >= 0;
    return n;
}

/* Returns true if at least one pair of materials has a finite critical stretch in `limit`, so that bonds between these
 * materials may break. */
static bool may_break(const struct bond_limit *limit)
{
    bool breaks = false;
    for (int k = 0; k < limit->materials * limit->materials; k++) breaks |= isfinite(limit->critical_stretch[k]);
    return breaks;
}

/* Fixes the factors on the weights of the bonds of class number `class` (particles with equal surroundings) in q, by
 * equal lower and upper bounds: at 1 if `one`, else at the factor of the volume method (Le & Bobaru 2018), between
 * LEAST and MOST. near_faces: particles near faces. */
static void class_fix(struct surface_fit_problem *q, const struct particles_near_faces *near_faces, int32_t class,
                      bool one)
{
    const struct bond_classes *a = q->alike;
    const int n = near_faces->offset.n, own = neighbours(near_faces, a->member[class]);
    for (int k = 0; k < n; k++) {
        const int64_t g = a->group_of[(int64_t) class * n + k];
        if (g < 0) continue;
        const int64_t other =
            near_faces->place[particle_or_image_find_source_and_reversed_axes(
                                  near_faces, bond_class_neighbour_of_first_particle_at_offset(a, near_faces, class, k))
                                  .particle];
        const real both = own + neighbours(near_faces, other);
        q->low[g] = q->high[g] = one ? 1 : fmin(fmax(2.0 * n / both, LEAST), MOST);
    }
}

/* Fixes in q the factors of bonds where the fit does not apply: at ends of cracks, and in parts of the body with too
 * few layers of particles (marked in f->thin). The factor is that of the volume method (Le & Bobaru 2018), or 1 if
 * `rotates`, in models with particle rotations. At ends of cracks it is also 1 if bonds may break: they break next, and
 * the critical stretch is calibrated for factor 1 (otherwise Kalthoff's crack turns to 61 degrees at 1 mm). Thin parts
 * are treated last, so that the factor of a bond between both does not depend on the order of its particles.
 * near_faces: particles near faces. */
static void plain_parts(struct surface_fit_problem *q, const struct particles_near_faces *near_faces,
                        const struct surface_fit_targets *f, bool rotates)
{
    const struct bond_classes *a = q->alike;
    const bool breaks = may_break(&near_faces->source->limit);
    for (int32_t class = 1; class < a->classes; class ++)
        if (at_crack_end(near_faces, a->member[class])) class_fix(q, near_faces, class, rotates || breaks);
    for (int32_t class = 1; class < a->classes; class ++)
        if (f->thin[a->member[class]]) class_fix(q, near_faces, class, rotates);
}

/* Allocates and sets the bounds q->low[sets] and q->high[sets] of the factors of all sets of bonds that share one
 * factor: LEAST and MOST, or equal bounds at ends of cracks and in thin parts, where the factor is fixed. near_faces:
 * particles near faces; f: states which particles are in thin parts; rotates: true for a model with particle rotations.
 */
static void bounds_make(struct surface_fit_problem *q, const struct particles_near_faces *near_faces,
                        const struct surface_fit_targets *f, bool rotates)
{
    const int64_t groups = q->alike->groups;
    q->low = NEW("surface.low", groups, real), q->high = NEW("surface.high", groups, real);
    for (int64_t g = 0; g < groups; g++) q->low[g] = LEAST, q->high[g] = MOST;
    plain_parts(q, near_faces, f, rotates);
}

real surface_fit_compute_bond_weight_factors(real *factor, const struct particles_near_faces *near_faces,
                                             const struct surface_fit_targets *f, const struct bond_classes *a,
                                             bool with_rotations, int max_matrix_products)
{
    struct moments m;
    moments_make(&m, &near_faces->offset);
    struct surface_fit_problem q = {
        .alike = a, .offsets = near_faces->offset.n, .thirds = m.thirds, .fourths = m.width - m.thirds, .of = m.of};
    const real alpha = with_rotations ? ROTATIONS : face_moment(&m, &near_faces->offset);
    q.class = BARE("surface.class", a->classes, struct class_fit);
    struct class_goal *goal = NEW("surface.goal", a->classes, struct class_goal);
    class_goals(goal, near_faces->offset.dim, near_faces, f, a);
#pragma omp parallel for schedule(static)
    for (int32_t class = 1; class < a->classes; class ++)
        class_make(&q.class[class], &m, near_faces, &goal[class], a, class, alpha);
    memory_free(goal);
    prior_make(&q, &m);
    bounds_make(&q, near_faces, f, with_rotations);
    const real left = surface_fit_solve_least_squares(&q, factor, max_matrix_products);
    memory_free(m.of);
    memory_free(q.class);
    memory_free(q.first);
    memory_free(q.entry);
    memory_free(q.prior);
    memory_free(q.low);
    memory_free(q.high);
    return left;
}
