/* Pressure p that follows the surface of a body on a lattice, where each particle is a cube (loads_corners.c: corners
 * of the faces).
 *
 * A corner of the free faces moves with the particles around it: x = sum w x_i, with sum w = 1 and sum w X_i = X, which
 * is exact in every uniform deformation. The faces (in 2D segments; in 3D quadrilaterals, divided along either
 * diagonal, the mean of both) enclose the volume V. The pressure does the work -p dV, so that the force on a corner is
 * -p dV/dx: half the area of each adjacent segment, or a third of each adjacent triangle, times -p. The weights w
 * distribute this force to the particles. The forces of a closed surface thus have the potential energy p V and rotate
 * with the body, with neither resultant nor moment. Near a plane of symmetry a corner also moves with mirror images,
 * whose displacement is that of particles with some components reversed; V is the volume on the side of the
 * particles. */
#include "loads_surface_internal.h"
#include "base/memory.h"
#include "base/team.h"

#define TORN 3.0 /* edge length of a face beyond which it counts as torn [spacings] */

/* ---- the surface of a load --------------------------------------------------------------------------------------- */

/* Makes the list, for each particle of load l, of the corners of surface a that it moves, with their weights
 * (a->share_*): the transpose of the list of particles by corner. particles: number of all particles. */
static void shares_transpose(struct surface *a, const struct load *l, int64_t particles)
{
    int32_t *place = NEW("loads.place", particles, int32_t);
    a->share_first = NEW("loads.share_first", l->n + 2, int64_t);
    a->share_corner = NEW("loads.share_corner", a->first[a->corners], int32_t);
    a->share_weight = NEW("loads.share_weight", a->first[a->corners], real);
    a->share_turned = NEW("loads.share_turned", a->first[a->corners], uint8_t);
    for (int64_t k = 0; k < l->n; k++) place[l->particle[k]] = (int32_t)k;
    for (int64_t q = 0; q < a->first[a->corners]; q++) a->share_first[place[a->particle[q]] + 2]++;
    for (int64_t k = 0; k < l->n; k++) a->share_first[k + 2] += a->share_first[k + 1];
    for (int64_t c = 0; c < a->corners; c++)
        for (int64_t q = a->first[c]; q < a->first[c + 1]; q++) {
            const int64_t at = a->share_first[place[a->particle[q]] + 1]++;
            a->share_corner[at] = (int32_t)c, a->share_weight[at] = a->weight[q], a->share_turned[at] = a->turned[q];
        }
    memory_free(place);
}

/* Fills surface a of load l from its free faces f: corners, weights and working memory. The particles that move the
 * corners become the particles of l, with their inward reference areas [m^2] as shares. s: sorted lattice sites. */
static void surface_fill(struct surface *a, struct load *l, const struct lattice_sites *s,
                         const struct surface_faces *f, struct particles *p)
{
    load_surface_compute_face_corners(a, s, f);
    a->sign = NEW("loads.sign", f->n, int8_t);
    for (int64_t q = 0; q < f->n; q++)
        a->sign[q] = (int8_t)(a->dim == 2 && f->face[q].axis == 1 ? -f->face[q].side : f->face[q].side);
    uint8_t *chosen = NEW("loads.chosen", p->n, uint8_t);
    for (int64_t q = 0; q < a->first[a->corners]; q++) chosen[a->particle[q]] = 1;
    load_set_particle_list_from_selected_flags(l, chosen, p);
    a->particles = l->n;
    shares_transpose(a, l, p->n);
    a->x = NEW("loads.corner_x", a->corners * a->dim, real);
    a->area = NEW("loads.corner_area", a->corners * a->dim, real);
    a->face_area = NEW("loads.face_area", a->faces * FACE_CORNERS * a->dim, real);
    load_surface_compute_area_vectors(a, p, l->share);
    memory_free(chosen);
}

status load_surface_make_from_free_faces(struct load *l, const struct surface_faces *free_faces,
                                         const struct boundary *all_boundaries, int boundary_count, struct particles *p,
                                         real spacing)
{
    struct lattice_sites s = {.p = p, .all = all_boundaries, .boundaries = boundary_count, .spacing = spacing};
    if (free_faces->n == 0)
        return status_set(REFUSED,
                          "boundary %s: no particle in its region has a free face; let the region contain part of the "
                          "surface of the body",
                          l->boundary->name);
    const status made = lattice_sites_list_of_bodies_with_faces(&s, free_faces);
    if (made == OK) {
        l->surface = NEW("loads.surface", 1, struct surface);
        *l->surface = (struct surface){.dim = p->dim,
                                       .section = l->boundary->section > 0 ? l->boundary->section : 1,
                                       .longest = TORN * spacing,
                                       .faces = free_faces->n};
        surface_fill(l->surface, l, &s, free_faces, p);
    }
    memory_free(s.site);
    return made;
}

void load_surface_free(struct surface *s)
{
    if (!s) return;
    memory_free(s->corner), memory_free(s->sign), memory_free(s->first), memory_free(s->face_first);
    memory_free(s->share_first), memory_free(s->particle), memory_free(s->weight), memory_free(s->part);
    memory_free(s->share_corner), memory_free(s->share_weight), memory_free(s->turned), memory_free(s->share_turned);
    memory_free(s->place);
    memory_free(s->x), memory_free(s->face_area), memory_free(s->area);
    memory_free(s);
}

/* ---- a step ------------------------------------------------------------------------------------------------------ */

/* Returns true if an edge of a face with corners x[corners] exceeds s->longest: its ends are in different fragments. */
static bool is_torn(const struct surface *s, const real *const *x, int corners)
{
    bool torn = false;
    for (int c = 0; c < corners; c++) {
        real length2 = 0;
        for (int d = 0; d < s->dim; d++) length2 += square(x[c][d] - x[(c + 1) % corners][d]);
        torn |= !(length2 <= square(s->longest));
    }
    return torn;
}

/* Computes to[2][2] [m^2]: for each of the two ends of a 2D face, half of the area vector of the face. x: positions of
 * the ends [m]; sign: orientation, 1 or -1; s: has the thickness. */
static void segment_area(const struct surface *s, const real *const *x, real sign, real *to)
{
    for (int c = 0; c < 2; c++) {
        to[2 * c] = 0.5 * sign * s->section * (x[1][1] - x[0][1]);
        to[2 * c + 1] = -0.5 * sign * s->section * (x[1][0] - x[0][0]);
    }
}

/* Adds 1/6 of the area vector of triangle a, b, c to each of its corners in to[4][3] [m^2]: 1/3, halved because a face
 * is divided along both diagonals. x: corners of the face [m]; sign: orientation, 1 or -1. */
static void triangle_add(const real *const *x, int a, int b, int c, real sign, real *to)
{
    real u[DIM_MAX], v[DIM_MAX];
    for (int d = 0; d < DIM_MAX; d++) u[d] = x[b][d] - x[a][d], v[d] = x[c][d] - x[a][d];
    for (int d = 0; d < DIM_MAX; d++) {
        const int e = (d + 1) % DIM_MAX, f = (d + 2) % DIM_MAX;
        const real share = sign * 0.5 * (u[e] * v[f] - u[f] * v[e]) / 6;
        to[3 * a + d] += share, to[3 * b + d] += share, to[3 * c + d] += share;
    }
}

/* Computes to[4][3], each corner's share of the area vector of a quadrilateral [m^2]: mean of the divisions along both
 * diagonals. to: 0 before; x: corners in order around it [m]; sign: orientation, 1 or -1. */
static void quadrilateral_area(const real *const *x, real sign, real *to)
{
    triangle_add(x, 0, 1, 2, sign, to);
    triangle_add(x, 0, 2, 3, sign, to);
    triangle_add(x, 0, 1, 3, sign, to);
    triangle_add(x, 1, 2, 3, sign, to);
}

/* Computes in s->face_area each corner's share of the present area vector of face q [m^2]; zero for a torn face. */
static void surface_face_area(struct surface *s, int64_t q)
{
    const int corners = s->dim == 2 ? 2 : FACE_CORNERS;
    const real *x[FACE_CORNERS];
    real *to = s->face_area + q * FACE_CORNERS * s->dim;
    for (int c = 0; c < corners; c++) x[c] = s->x + (int64_t)s->corner[q * FACE_CORNERS + c] * s->dim;
    array_fill_bytes(to, 0, FACE_CORNERS * s->dim, sizeof *to);
    if (is_torn(s, x, corners)) return;
    if (s->dim == 2)
        segment_area(s, x, s->sign[q], to);
    else
        quadrilateral_area(x, s->sign[q], to);
}

/* Computes the present position s->x of corner c [m]: its reference position plus the weighted displacements of the
 * particles of p that move it. Displacement components that a mirror reverses (s->turned) are subtracted. */
static void surface_corner_place(struct surface *s, const struct particles *p, int64_t c)
{
    for (int d = 0; d < s->dim; d++) {
        real x = s->place[c * s->dim + d];
        for (int64_t q = s->first[c]; q < s->first[c + 1]; q++) {
            const int32_t i = s->particle[q];
            x += (s->turned[q] >> d & 1 ? -1 : 1) * s->weight[q] * (p->x[d][i] - p->X[d][i]);
        }
        s->x[c * s->dim + d] = x;
    }
}

/* Sums in s->area the area vector of corner c over the faces that meet there [m^2]. */
static void surface_corner_area(struct surface *s, int64_t c)
{
    for (int d = 0; d < s->dim; d++) {
        real area = 0;
        for (int64_t q = s->face_first[c]; q < s->face_first[c + 1]; q++)
            area += s->face_area[(int64_t)s->part[q] * s->dim + d];
        s->area[c * s->dim + d] = area;
    }
}

/* Returns the inward area along axis d of particle number k of the load of s [m^2], summed over corners it moves. */
static real particle_surface_area(const struct surface *s, int64_t k, int d)
{
    real area = 0;
    for (int64_t q = s->share_first[k]; q < s->share_first[k + 1]; q++)
        area -= (s->share_turned[q] >> d & 1 ? -1 : 1) * s->share_weight[q] *
                s->area[(int64_t)s->share_corner[q] * s->dim + d];
    return area;
}

/* Computes area[dim][s->particles], the inward areas of all particles of the load at their present positions [m^2]. */
void load_surface_compute_area_vectors(struct surface *s, const struct particles *p, real *const *area)
{
    const bool many = s->corners > SUM_BLOCK;
    TEAM_LOOP(many, for (int64_t c = 0; c < s->corners; c++) surface_corner_place(s, p, c););
    TEAM_LOOP(many, for (int64_t q = 0; q < s->faces; q++) surface_face_area(s, q););
    TEAM_LOOP(many, for (int64_t c = 0; c < s->corners; c++) surface_corner_area(s, c););
    TEAM_LOOP(many, for (int64_t k = 0; k < s->particles; k++) for (int d = 0; d < s->dim; d++) area[d][k] =
                        particle_surface_area(s, k, d););
}
