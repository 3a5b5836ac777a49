/* Finds the corners of the free faces of lattice particles (loads_surface.c): which faces have a corner in common, and
 * which particles move it with which weights. The weights are exact for linear fields. Particles, and near planes of
 * symmetry their mirror images, are found by the lattice sites of their bodies. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "loads_surface_internal.h"
#include "base/memory.h"

#define OFF_LATTICE 1e-4                    /* tolerance for particles on the lattice [spacings] */
#define SECOND_LAYER 0.25                   /* weight of particles behind those at a corner; empirical */
#define SINGULAR 1e-10                      /* smallest variance that counts as extent [spacings^2] */
#define BESIDE 3.0                          /* distance from a mirror beyond which a corner has no images [spacings] */
enum { STENCIL_MOST = 32, SITE_BITS = 18 }; /* particles of a corner; bits of a site index */

/* ---- sites ------------------------------------------------------------------------------------------------------- */

/* Entry of a sorted list by which positions on the lattice of a body are found. key: lattice site (site_key); value:
 * index of the particle at the site, or, in a list of face corners, FACE_CORNERS times the number of a face plus that
 * of its corner half a spacing below the site. */
struct site {
    int64_t key;
    int32_t value;
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

/* Computes k[dim], the lattice indices of particle i relative to the first particle of its body. Returns false if the
 * particle is not on a lattice site, to within OFF_LATTICE spacings. */
static bool place_on_lattice(const struct lattice_sites *s, int32_t i, int64_t *k)
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
static int32_t site_find(const struct lattice_sites *s, int64_t key)
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

/* Lists the lattice sites of all particles of those bodies that have faces in f, sorted, in s->site. Returns REFUSED,
 * with a message, if a particle of these bodies is not on the lattice. */
static status sites_make(struct lattice_sites *s, const struct surface_faces *f)
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

/* Returns the distance of the mirror plane m from the first particle of `body` [half spacings]. It is an odd number if
 * the plane is midway between lattice sites. s: has the spacing and the first particles. */
static real mirror_steps(const struct lattice_sites *s, const struct boundary *m, int body)
{
    return 2 * (m->at - s->p->X[m->axis][s->first[body]]) / s->spacing;
}

/* Returns REFUSED, with a message, if a mirror plane within BESIDE spacings of a face of f is not midway between
 * lattice sites of the body. s: lattice sites, with the planes. */
static status mirrors_between(const struct lattice_sites *s, const struct surface_faces *f)
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
static int32_t site_or_image_find(const struct lattice_sites *s, int body, const int64_t *site, uint8_t *turned)
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

/* Computes k[dim], the indices of the lattice site whose cube has corner number c of face f at its lower end along each
 * axis. c: 0 .. 1 in 2D, 0 .. 3 in 3D. */
static void corner_site(const struct lattice_sites *s, const struct surface_face *f, int c, int64_t *k)
{
    const int dim = s->p->dim, u = dim == 2 ? 1 - f->axis : (f->axis + 1) % 3, v = (f->axis + 2) % 3;
    place_on_lattice(s, f->particle, k);
    k[f->axis] += f->side > 0;
    k[u] += c == 1 || c == 2;
    if (dim == 3) k[v] += c >= 2;
}

/* Numbers the corners of the faces f, so that corners at one position have one number: sets a->corners (their count)
 * and a->corner[face][corner]. s: lattice sites. Returns the corners of all faces, sorted by position, with value =
 * FACE_CORNERS face + corner. Release with memory_free. */
static struct site *corners_number(struct surface *a, const struct lattice_sites *s, const struct surface_faces *f)
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

/* Lists the faces that have each corner in common, in a->part; those of corner c begin at a->face_first[c]. all[n]:
 * corners of all faces, from corners_number. */
static void parts_make(struct surface *a, const struct site *all, int64_t n)
{
    a->face_first = NEW("loads.face_first", a->corners + 1, int64_t);
    a->part = NEW("loads.part", n, int32_t);
    for (int64_t q = 0; q < n; q++) {
        a->part[q] = all[q].value;
        a->face_first[a->corner[all[q].value] + 1] = q + 1;
    }
}

/* The n particles (or mirror images of particles) whose motion determines that of one corner of a face. For each:
 * index; bits of the components that a mirror reverses (`turned`); position r relative to the corner [spacings]; weight
 * `counts` [1]. A local variable while the corner is set up. */
struct around {
    int n;
    int32_t particle[STENCIL_MOST];
    uint8_t turned[STENCIL_MOST];
    real r[STENCIL_MOST][DIM_MAX], counts[STENCIL_MOST];
};

/* Adds the particle of body `body` at lattice site `site` to *t with the weight `counts` [1]; beyond a mirror, adds the
 * particle whose image is there. Does nothing if *t has the particle already or is full. off[dim]: indices of `site`
 * relative to the site above the corner. Returns false if `site` is empty. */
static bool corner_reach(struct around *t, const struct lattice_sites *s, int body, const int64_t *site,
                         const int64_t *off, real counts)
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

/* Collects in *t the particles that determine the position of a corner, half a spacing below lattice site `site` of
 * body `body` along each axis: those whose cubes have this corner, with weight 1, and those in the second layer along
 * each axis, with weight SECOND_LAYER. s: lattice sites. */
static void corner_around(struct around *t, const struct lattice_sites *s, int body, const int64_t *site)
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

/* Computes the reference position a->place of corner c [m] as the weighted mean of the reference positions of the
 * particles and images t that move the corner. No other value is used, so that forces on the corner cause no moment of
 * the body. first: first particle of the body; site[dim]: indices of the lattice site above the corner. */
static void corner_place_make(struct surface *a, int64_t c, const struct lattice_sites *s, int32_t first,
                              const int64_t *site, const struct around *t)
{
    for (int d = 0; d < a->dim; d++) {
        const real corner = s->p->X[d][first] + ((real)site[d] - 0.5) * s->spacing;
        for (int q = 0; q < t->n; q++)
            a->place[c * a->dim + d] +=
                a->weight[a->first[c] + q] *
                (t->turned[q] >> d & 1 ? corner + t->r[q][d] * s->spacing : s->p->X[d][t->particle[q]]);
    }
}

/* Finds for each corner of surface a the particles that move it, their weights, and the reference position of the
 * corner. s: lattice sites; f: faces; all: corners of the faces f, sorted, from corners_number. */
static void corners_make(struct surface *a, const struct lattice_sites *s, const struct site *all,
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

status lattice_sites_list_of_bodies_with_faces(struct lattice_sites *s, const struct surface_faces *faces)
{
    const status made = sites_make(s, faces);
    return made == OK ? mirrors_between(s, faces) : made;
}

void load_surface_compute_face_corners(struct surface *a, const struct lattice_sites *s,
                                       const struct surface_faces *faces)
{
    struct site *all = corners_number(a, s, faces);
    parts_make(a, all, faces->n * (a->dim == 2 ? 2 : FACE_CORNERS));
    corners_make(a, s, all, faces);
    memory_free(all);
}
