/* Pressure that follows the surface of a body of lattice cubes.
 *
 * The free faces of the cubes meet in corners. A corner moves with the particles around it: x = sum w x_i, with sum w =
 * 1 and sum w X_i = X, so that it is exact in every uniform deformation. The faces between corners (in 2D segments; in
 * 3D quadrilaterals, divided along either diagonal, the mean of both) enclose a volume V. A pressure p does the work -p
 * dV: the force on a corner is -p dV/dx, half of each of its segments, a third of each of its triangles, and the force
 * on a particle follows from the weights. So the forces of a closed surface have the energy p V, no resultant and no
 * moment, whatever the deformation, and rotate with the body; on part of a surface each face contributes its own share.
 * Near a mirror a corner also moves with images, whose displacement is that of their sources with some components
 * reversed. V is that of the part on this side; its derivative by a source is the force of the whole surface on it. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "loads_surface.h"
#include "base/memory.h"
#include "base/team.h"

#define OFF_LATTICE 1e-4  /* tolerance for particles on the lattice [spacings] */
#define SECOND_LAYER 0.25 /* weight of particles behind those at a corner; empirical */
#define SINGULAR 1e-10    /* smallest variance that counts as extent [spacings^2] */
#define BESIDE 3.0        /* distance from a mirror beyond which a corner has no images [spacings] */
#define TORN 3.0          /* edge length of a face beyond which it counts as torn [spacings] */
enum { FACE_CORNERS = 4, STENCIL_MOST = 32, SITE_BITS = 18 }; /* in 3D; particles of a corner; bits of a site index */

/* The surface of one load: its faces, their corners, and the particles that move the corners. All arrays are owned. */
struct surface {
    int dim;
    real section, longest; /* thickness in 2D [m], 1 in 3D; a face with a longer edge is torn: it has no area [m] */
    int64_t faces, corners, particles; /* numbers of faces, of their corners, and of particles of the load */
    int32_t *corner; /* [faces][4] corners of each face, in order around the positive direction of its axis */
    int8_t *sign;    /* [faces] 1 or -1: factor by which area vectors in this order point outwards */
    uint8_t *turned; /* [first[corners]] bit d: component d of the displacement is reversed (image at a mirror) */
    int64_t *first, *face_first,
        *share_first;           /* ranges: [corners + 1] in particle, in `part`; [particles + 1] in share_corner */
    int32_t *particle;          /* [first[corners]] particles with which each corner moves */
    real *weight;               /* [first[corners]] weights of these particles [1] */
    int32_t *part;              /* [4 faces] faces that meet in each corner: 4 face + position of the corner in it */
    int32_t *share_corner;      /* [first[corners]] corners that move with each particle of the load */
    real *share_weight;         /* [first[corners]] weight of the particle for this corner [1] */
    uint8_t *share_turned;      /* [first[corners]] bits as in `turned` */
    real *place;                /* [corners][dim] reference positions [m] */
    real *x, *face_area, *area; /* working memory: [corners][dim], [faces][4][dim], [corners][dim] */
};

/* ---- sites ------------------------------------------------------------------------------------------------------- */

/* A lattice site of a body, or the corner below it: its key (site_key), and index of the particle or corner there. */
struct site {
    int64_t key;
    int32_t value;
};

/* The sites of the lattices of all bodies with faces, and where mirrors are. */
struct sites {
    const struct particles *p;
    const struct boundary *all; /* boundaries of the scene, including mirrors */
    int boundaries;
    real spacing;
    int32_t first[UINT8_MAX + 1]; /* first particle of each body, -1: none */
    int64_t n;
    struct site *site; /* [n] sites with a particle, ascending by key */
};

static int by_key(const void *a, const void *b)
{
    const struct site *p = a, *q = b;
    return p->key != q->key ? (p->key > q->key) - (p->key < q->key) : (p->value > q->value) - (p->value < q->value);
}

/* Returns an integer that identifies a lattice site. It combines the number `body` of its body with the indices k[dim]
 * along the axes, counted from one particle of the body. Returns -1 if an index needs more than SITE_BITS bits. */
static int64_t site_key(int body, const int64_t *k, int dim)
{
    int64_t key = body;
    for (int d = 0; d < DIM_MAX; d++) {
        const int64_t at = (d < dim ? k[d] : 0) + (1 << (SITE_BITS - 1));
        if (at < 0 || at >= 1 << SITE_BITS) return -1;
        key = key << SITE_BITS | at;
    }
    return key;
}

/* Computes k[dim], lattice indices of particle i from the first of its body. Returns false if it is on no site. */
static bool place_on_lattice(const struct sites *s, int32_t i, int64_t *k)
{
    bool on = true;
    for (int d = 0; d < s->p->dim; d++) {
        const real at = (s->p->X[d][i] - s->p->X[d][s->first[s->p->body[i]]]) / s->spacing;
        k[d] = llround(at);
        on &= fabs(at - (real)k[d]) < OFF_LATTICE;
    }
    return on;
}

/* Returns the particle at the site with key `key`, by binary search in the sorted sites, or -1 if the site is empty. */
static int32_t site_find(const struct sites *s, int64_t key)
{
    const struct site wanted = {key, 0};
    int64_t low = 0, high = s->n;
    while (low < high) {
        const int64_t middle = low + (high - low) / 2;
        if (by_key(&s->site[middle], &wanted) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low < s->n && s->site[low].key == key ? s->site[low].value : -1;
}

/* Lists in s->site, sorted, the lattice sites of bodies with faces in f. Returns REFUSED if one is off the lattice. */
static status sites_make(struct sites *s, const struct surface_faces *f)
{
    bool has[UINT8_MAX + 1] = {false};
    int64_t k[DIM_MAX];
    for (int64_t q = 0; q < f->n; q++) has[s->p->body[f->face[q].particle]] = true;
    for (int64_t i = s->p->n; i-- > 0;) s->first[s->p->body[i]] = (int32_t)i;
    s->site = NEW("loads.sites", s->p->n, struct site);
    for (int64_t i = 0; i < s->p->n; i++) {
        if (!has[s->p->body[i]]) continue;
        const bool on = place_on_lattice(s, (int32_t)i, k);
        s->site[s->n] = (struct site){site_key(s->p->body[i], k, s->p->dim), (int32_t)i};
        if (!on || s->site[s->n++].key < 0)
            return status_set(REFUSED, "follow: true needs particles on a regular lattice; set follow: false, or use a "
                                       "shape in place of a particle list, and particles.irregularity: 0");
    }
    array_sort(s->site, s->n, sizeof *s->site, by_key);
    return OK;
}

/* Returns the distance of mirror m from the first particle of `body` [half spacings]: odd if midway between sites. */
static real mirror_steps(const struct sites *s, const struct boundary *m, int body)
{
    return 2 * (m->at - s->p->X[m->axis][s->first[body]]) / s->spacing;
}

/* Returns REFUSED if a mirror plane within BESIDE spacings of a face of f is not midway between lattice sites. */
static status mirrors_between(const struct sites *s, const struct surface_faces *f)
{
    for (int m = 0; m < s->boundaries; m++)
        for (int64_t q = 0; q < f->n && s->all[m].kind == BOUNDARY_MIRROR; q++) {
            const int32_t i = f->face[q].particle;
            const real twice = mirror_steps(s, &s->all[m], s->p->body[i]);
            if (fabs(s->p->X[s->all[m].axis][i] - s->all[m].at) > BESIDE * s->spacing) continue;
            if (fabs(remainder(twice - 1, 2)) < 2 * OFF_LATTICE) continue;
            return status_message_prepend_location(
                s->all[m].place,
                status_set(REFUSED,
                           "boundary %s: follow: true needs mirror planes midway between particles; move the plane to "
                           "half a spacing from the nearest particles, or set follow: false",
                           s->all[m].name));
        }
    return OK;
}

/* Returns the particle of body `body` at lattice site `site` or, beyond mirrors, the particle whose image is there; -1
 * if the site is empty. *turned: bit d is set if the mirrors reverse component d of the displacement. */
static int32_t site_or_image_find(const struct sites *s, int body, const int64_t *site, uint8_t *turned)
{
    int64_t k[DIM_MAX];
    *turned = 0;
    memcpy(k, site, sizeof k);
    for (int b = 0; b < s->boundaries; b++) {
        const struct boundary *m = &s->all[b];
        if (m->kind != BOUNDARY_MIRROR) continue;
        const int64_t twice = llround(mirror_steps(s, m, body));
        if ((2 * k[m->axis] - twice) * (twice > 0 ? 1 : -1) < 0) continue; /* the first particle is inside, at 0 */
        k[m->axis] = twice - k[m->axis];
        *turned ^= (uint8_t)(m->hold_tangential ? (1 << s->p->dim) - 1 : 1 << m->axis);
    }
    return site_find(s, site_key(body, k, s->p->dim));
}

/* ---- corners ----------------------------------------------------------------------------------------------------- */

/* Computes k[dim], the lattice site with corner c of face f as its lower corner (c = 0 .. 1 in 2D, 0 .. 3 in 3D). */
static void corner_site(const struct sites *s, const struct surface_face *f, int c, int64_t *k)
{
    const int dim = s->p->dim, u = dim == 2 ? 1 - f->axis : (f->axis + 1) % 3, v = (f->axis + 2) % 3;
    place_on_lattice(s, f->particle, k);
    k[f->axis] += f->side > 0;
    k[u] += c == 1 || c == 2;
    if (dim == 3) k[v] += c >= 2;
}

/* Numbers the corners of the faces f, equal positions alike: sets a->corners and a->corner. s: lattice sites. Returns
 * the corners of all faces, sorted by position, with value = 4 face + corner; free it with memory_free. */
static struct site *corners_number(struct surface *a, const struct sites *s, const struct surface_faces *f)
{
    const int each = a->dim == 2 ? 2 : FACE_CORNERS;
    struct site *all = NEW("loads.corners", f->n * each, struct site);
    for (int64_t q = 0; q < f->n; q++)
        for (int c = 0; c < each; c++) {
            int64_t k[DIM_MAX];
            corner_site(s, &f->face[q], c, k);
            all[q * each + c] =
                (struct site){site_key(s->p->body[f->face[q].particle], k, a->dim), (int32_t)(q * FACE_CORNERS + c)};
        }
    array_sort(all, f->n * each, sizeof *all, by_key);
    a->corner = NEW("loads.corner", f->n * FACE_CORNERS, int32_t);
    for (int64_t q = 0; q < f->n * each; q++) {
        if (q == 0 || all[q].key != all[q - 1].key) a->corners++;
        a->corner[all[q].value] = (int32_t)(a->corners - 1);
    }
    return all;
}

/* Lists in a->part, for each corner, the faces that meet there. all[n]: corners of all faces, from corners_number. */
static void parts_make(struct surface *a, const struct site *all, int64_t n)
{
    a->face_first = NEW("loads.face_first", a->corners + 1, int64_t);
    a->part = NEW("loads.part", n, int32_t);
    for (int64_t q = 0; q < n; q++) {
        a->part[q] = all[q].value;
        a->face_first[a->corner[all[q].value] + 1] = q + 1;
    }
}

/* The n particles with which a corner moves: index, mirror bits, position r from the corner [spacings], weight. */
struct around {
    int n;
    int32_t particle[STENCIL_MOST];
    uint8_t turned[STENCIL_MOST];
    real r[STENCIL_MOST][DIM_MAX], counts[STENCIL_MOST];
};

/* Adds to *t with weight `counts` the particle of `body` at `site` (beyond a mirror the source of the image), unless *t
 * has it or is full. off[dim]: `site` minus the site above the corner. Returns false if `site` is empty. */
static bool corner_reach(struct around *t, const struct sites *s, int body, const int64_t *site, const int64_t *off,
                         real counts)
{
    const int dim = s->p->dim;
    uint8_t turned;
    const int32_t i = site_or_image_find(s, body, site, &turned);
    if (i < 0) return false;
    for (int q = 0; q < t->n; q++)
        if (t->particle[q] == i && t->turned[q] == turned) return true;
    if (t->n == STENCIL_MOST) return true;
    t->particle[t->n] = i, t->turned[t->n] = turned, t->counts[t->n] = counts;
    for (int d = 0; d < dim; d++) t->r[t->n][d] = (real)off[d] + 0.5;
    t->n++;
    return true;
}

/* Fills *t with the particles that determine the position of the corner below lattice site `site` of body `body`: those
 * whose cubes meet in the corner, with weight 1, and those behind them along each axis, with weight SECOND_LAYER. */
static void corner_around(struct around *t, const struct sites *s, int body, const int64_t *site)
{
    const int dim = s->p->dim;
    t->n = 0;
    for (int layer = 0; layer < 2; layer++)
        for (int c = 0; c < 1 << dim; c++) {
            int64_t off[DIM_MAX] = {0}, at[DIM_MAX] = {0};
            for (int d = 0; d < dim; d++) off[d] = (c >> d & 1) - 1, at[d] = site[d] + off[d];
            const bool near = corner_reach(t, s, body, at, off, 1);
            for (int d = 0; d < dim && layer == 1 && near; d++) {
                const int64_t away = c >> d & 1 ? 1 : -1;
                off[d] += away, at[d] += away;
                corner_reach(t, s, body, at, off, SECOND_LAYER);
                off[d] -= away, at[d] -= away;
            }
        }
}

/* Solves C y = b for y[n] by elimination, n <= DIM_MAX. C is symmetric, positive definite, and overwritten. */
static void solve_small(real C[DIM_MAX][DIM_MAX], const real *b, int n, real *y)
{
    array_copy(y, b, n, sizeof *y);
    for (int k = 0; k < n; k++)
        for (int m = k + 1; m < n; m++) {
            const real share = C[m][k] / C[k][k];
            for (int d = k; d < n; d++) C[m][d] -= share * C[k][d];
            y[m] -= share * y[k];
        }
    for (int k = n; k-- > 0;) {
        for (int d = k + 1; d < n; d++) y[k] -= C[k][d] * y[d];
        y[k] /= C[k][k];
    }
}

/* Computes weights w[t->n] = counts (1 - (r - mean) . C^-1 mean)/sum counts, which interpolate linear fields exactly
 * from particles to a corner. r: position relative to the corner; mean, C: mean and covariance of r with the weights
 * `counts` in t. SINGULAR is added to the diagonal of C, which for thin bodies has zeros. */
static void corner_weights(const struct around *t, int dim, real *w)
{
    real C[DIM_MAX][DIM_MAX] = {{0}}, mean[DIM_MAX] = {0}, y[DIM_MAX], all = 0;
    for (int q = 0; q < t->n; q++) {
        all += t->counts[q];
        for (int d = 0; d < dim; d++) mean[d] += t->counts[q] * t->r[q][d];
    }
    for (int d = 0; d < dim; d++) mean[d] /= all;
    for (int q = 0; q < t->n; q++)
        for (int d = 0; d < dim; d++)
            for (int c = 0; c < dim; c++)
                C[d][c] += t->counts[q] / all * (t->r[q][d] - mean[d]) * (t->r[q][c] - mean[c]);
    for (int d = 0; d < dim; d++) C[d][d] += SINGULAR;
    solve_small(C, mean, dim, y);
    for (int q = 0; q < t->n; q++) {
        real along = 0;
        for (int d = 0; d < dim; d++) along += (t->r[q][d] - mean[d]) * y[d];
        w[q] = t->counts[q] / all * (1 - along);
    }
}

/* Computes a->place of corner c, its reference position: the weighted mean of the particles and images t that move it,
 * exactly, so that forces have no moment. first: first particle of the body; site[dim]: lattice site above c. */
static void corner_place_make(struct surface *a, int64_t c, const struct sites *s, int32_t first, const int64_t *site,
                              const struct around *t)
{
    for (int d = 0; d < a->dim; d++) {
        const real corner = s->p->X[d][first] + ((real)site[d] - 0.5) * s->spacing;
        for (int q = 0; q < t->n; q++)
            a->place[c * a->dim + d] +=
                a->weight[a->first[c] + q] *
                (t->turned[q] >> d & 1 ? corner + t->r[q][d] * s->spacing : s->p->X[d][t->particle[q]]);
    }
}

/* Finds in a the particles that move each corner, and its position. s: lattice sites; all: sorted corners of f. */
static void corners_make(struct surface *a, const struct sites *s, const struct site *all,
                         const struct surface_faces *f)
{
    const int64_t most = a->corners * STENCIL_MOST;
    a->first = NEW("loads.first", a->corners + 1, int64_t);
    a->particle = NEW("loads.stencil", most, int32_t);
    a->weight = NEW("loads.weight", most, real);
    a->turned = NEW("loads.turned", most, uint8_t);
    a->place = NEW("loads.corner_place", a->corners * a->dim, real);
    for (int64_t c = 0; c < a->corners; c++) {
        const struct site *one = &all[a->face_first[c]];
        const struct surface_face *face = &f->face[one->value / FACE_CORNERS];
        int64_t site[DIM_MAX] = {0};
        struct around t;
        corner_site(s, face, one->value % FACE_CORNERS, site);
        corner_around(&t, s, s->p->body[face->particle], site);
        corner_weights(&t, a->dim, a->weight + a->first[c]);
        array_copy(a->particle + a->first[c], t.particle, t.n, sizeof *t.particle);
        array_copy(a->turned + a->first[c], t.turned, t.n, sizeof *t.turned);
        corner_place_make(a, c, s, s->first[s->p->body[face->particle]], site, &t);
        a->first[c + 1] = a->first[c] + t.n;
    }
}

/* Lists in a, for each particle of load l, the corners that it moves. particles: number of particles in the run. */
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
static void surface_fill(struct surface *a, struct load *l, const struct sites *s, const struct surface_faces *f,
                         struct particles *p)
{
    struct site *all = corners_number(a, s, f);
    parts_make(a, all, f->n * (a->dim == 2 ? 2 : FACE_CORNERS));
    a->sign = NEW("loads.sign", f->n, int8_t);
    for (int64_t q = 0; q < f->n; q++)
        a->sign[q] = (int8_t)(a->dim == 2 && f->face[q].axis == 1 ? -f->face[q].side : f->face[q].side);
    corners_make(a, s, all, f);
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
    memory_free(all);
}

status load_surface_make_from_free_faces(struct load *l, const struct surface_faces *free_faces,
                                         const struct boundary *all_boundaries, int boundary_count, struct particles *p,
                                         real spacing)
{
    struct sites s = {.p = p, .all = all_boundaries, .boundaries = boundary_count, .spacing = spacing};
    if (free_faces->n == 0)
        return status_set(REFUSED,
                          "boundary %s: no particle in its region has a free face; let the region contain part of the "
                          "surface of the body",
                          l->boundary->name);
    status made = sites_make(&s, free_faces);
    if (made == OK) made = mirrors_between(&s, free_faces);
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

/* Computes to[2][2], the halves of the area vector of a 2D face at its ends x [m^2]. sign: orientation, 1 or -1. */
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

/* Computes s->x of corner c: reference position plus displacements of p, times s->weight, reversed where s->turned. */
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
