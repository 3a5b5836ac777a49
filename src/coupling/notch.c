/* Decides which pre-cracks become slits, along which nodes of the mesh are doubled; makes the particles around their
 * ends peridynamic; and finds slits and voids whose faces approach each other. */
#include "bonds/sites.h"
#include "coupling/notch.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"

#define AHEAD_REACH 1.2   /* range of the search for particles ahead of an end [spacings] */
#define FACE_REACH 1.01   /* largest distance of particles that face each other across a slit [spacings] */
#define MEET_REACH 1.5    /* range of the search for faces that approach each other [spacings] */
#define REACH_SLACK 1e-9  /* relative round-off of distances */
#define VOID_AHEAD 0.1    /* gap of the faces of a void at which they become peridynamic [spacings] */
enum { EDGE_PARTS = 16 }; /* sampling points along an edge */

/* ---- edges of cracks --------------------------------------------------------------------------------------------- */

/* Stores pointers to the end points of edge e of crack c, from which the crack may grow, in *from and *to. In 3D they
 * are two corners of the crack's polygon; in 2D both are end e of its segment. The points [m] belong to c. */
static void crack_end_of(const struct crack *c, int e, int dim, const real **from, const real **to)
{
    *from = c->corner[e];
    *to = dim == 3 ? c->corner[(e + 1) % c->n] : c->corner[e];
}

/* Returns true if the body continues beyond edge e of crack c (in 2D: end e), away from the middle of the crack. At the
 * mouth of a notch the body does not continue. p, s: particles, with the cells of the neighbour search and planes of
 * symmetry. */
static bool edge_inside(const struct crack *c, int e, const struct particles *p, const struct bond_source *s)
{
    real middle[DIM_MAX] = {0};
    const real *from, *to;
    crack_end_of(c, e, p->dim, &from, &to);
    for (int k = 0; k < c->n; k++)
        for (int d = 0; d < p->dim; d++) middle[d] += c->corner[k][d] / c->n;
    for (int part = 0; part < (p->dim == 3 ? EDGE_PARTS : 1); part++) {
        real X[DIM_MAX], away[DIM_MAX], length2 = 0;
        for (int d = 0; d < p->dim; d++) {
            X[d] = from[d] + (part + 0.5) / EDGE_PARTS * (to[d] - from[d]);
            away[d] = 0.5 * (from[d] + to[d]) - middle[d];
            length2 += square(away[d]);
        }
        if (crack_end_is_continued_by_mirrors(s->mirror, s->mirrors, c, X, ON_SURFACE * s->family.spacing)) continue;
        for (int d = 0; d < p->dim && length2 > 0; d++) X[d] += s->family.spacing * away[d] / sqrt(length2);
        if (cells_list_particles_near_point(s->cells, p, X, AHEAD_REACH * s->family.spacing, -1, NULL, 0) >= 2)
            return true;
    }
    return false;
}

/* A crack with the peridynamic zones around its edges. edges: bit e is set if edge e is inside the body; radius: of the
 * zones [m]. */
struct crack_edges {
    const struct crack *crack;
    uint64_t edges;
    real radius;
};

enum { EDGES_MAX = 64 }; /* largest number of edges of a crack: one bit each in crack_edges.edges */

/* Returns crack c with the set of its edges (in 2D ends) beyond which the body continues. Around these edges the body
 * is peridynamic. radius: radius of these peridynamic zones [m]; p, s: particles and the cells of the neighbour
 * search. */
static struct crack_edges crack_edges_of(const struct crack *c, const struct particles *p, const struct bond_source *s,
                                         real radius)
{
    struct crack_edges zone = {c, 0, radius};
    for (int e = 0; e < c->n && e < EDGES_MAX; e++) zone.edges |= (uint64_t)edge_inside(c, e, p, s) << e;
    return zone;
}

/* Returns true if the reference position of particle i of p is in one of the peridynamic zones of a crack: within
 * zone->radius of an edge (in 2D end) of the crack that is inside the body. */
static bool in_zone(const struct crack_edges *zone, const struct particles *p, int64_t i)
{
    real X[DIM_MAX];
    particle_reference_position(p, i, X);
    for (int e = 0; e < zone->crack->n && e < EDGES_MAX; e++) {
        const real *from, *to;
        crack_end_of(zone->crack, e, p->dim, &from, &to);
        if (zone->edges >> e & 1 && segment_distance_from_point(from, to, X, p->dim) <= zone->radius) return true;
    }
    return false;
}

/* ---- choice ------------------------------------------------------------------------------------------------------ */

/* Returns true if crack c separates the reference positions of particles i and j of p. */
static bool parted(const struct crack *c, const struct particles *p, int64_t i, int64_t j)
{
    real a[DIM_MAX], b[DIM_MAX];
    particle_reference_position(p, i, a);
    particle_reference_position(p, j, b);
    return crack_cuts_bond(c, a, b, p->dim);
}

/* Returns true if crack c is within the cutoff (largest bond length, from s) of the reference position of particle i of
 * p, so that it may cut bonds of this particle. */
static bool near_crack(const struct crack *c, const struct particles *p, const struct bond_source *s, int64_t i)
{
    real X[DIM_MAX];
    particle_reference_position(p, i, X);
    return crack_may_cut_bonds_near(c, X, s->family.cutoff, p->dim);
}

static real apart(const struct particles *p, int64_t i, int64_t j)
{
    real r2 = 0;
    for (int d = 0; d < p->dim; d++) r2 += square(p->X[d][i] - p->X[d][j]);
    return sqrt(r2);
}

/* Counts of particles whose bonds a crack cuts outside the peridynamic zones around its ends. particles: number of
 * these particles; elsewhere: number of those among them that are not points of a mesh. */
struct flanks {
    int64_t particles, elsewhere;
};

/* Returns true if crack c cuts a bond between particle i of p and a particle of the same body in `near`, its
 * neighbours. */
static bool loses_by(const struct crack *c, const struct particles *p, int64_t i, const struct neighbour_list *near)
{
    for (int k = 0; k < near->n; k++)
        if (p->body[near->at[k]] == p->body[i] && parted(c, p, i, near->at[k])) return true;
    return false;
}

/* Counts the particles of p that lose bonds by a crack, without those in the peridynamic zones around its edges. zone:
 * the crack and these zones; s: cells of the neighbour search. Returns in `particles` their number, and in `elsewhere`
 * the number of those that are not points of a mesh, so that the crack cannot be a slit (a gap of the mesh) there. */
static struct flanks flanks_of(const struct crack_edges *zone, const struct particles *p, const struct bond_source *s)
{
    int64_t particles = 0, elsewhere = 0;
#pragma omp parallel reduction(+ : particles, elsewhere)
    {
        struct neighbour_list near = {0};
#pragma omp for schedule(static)
        for (int64_t i = 0; i < p->n; i++) {
            if (!near_crack(zone->crack, p, s, i) || in_zone(zone, p, i)) continue;
            particles_list_neighbours_within_radius(&near, s->cells, p, i, s->family.cutoff, false);
            if (!loses_by(zone->crack, p, i, &near)) continue;
            particles++;
            elsewhere += !(p->flag[i] & FLAG_MESHED);
        }
        memory_free(near.at);
    }
    return (struct flanks){particles, elsewhere};
}

/* Returns the reason why pre-crack c cannot be a slit, along which nodes of the mesh are doubled, as a constant text;
 * NULL if c can be a slit. radius: radius of the peridynamic zones around the ends of c [m]; p, s: particles, cells of
 * the neighbour search and planes of symmetry. */
static const char *notch_obstacle(const struct crack *c, const struct particles *p, const struct bond_source *s,
                                  real radius)
{
    const struct crack_edges zone = crack_edges_of(c, p, s, radius);
    if (p->dim == 1) return "in space line any crack divides the body in two";
    if (c->n > EDGES_MAX) return "its polygon has more than 64 corners";
    if (zone.edges == 0) return "neither end of the crack is inside the body, so a slit may cut the body in two";
    const struct flanks f = flanks_of(&zone, p, s);
    if (f.particles == 0) return "the crack is so short that it is inside the peridynamic zones around its ends";
    if (f.elsewhere > 0) return "some particles beside the crack are not material points in the reference frame";
    return NULL;
}

/* Returns true if a slit of n (pre-crack along which nodes of the mesh are doubled), or the mirror image of one, is so
 * near particle i of p that it may cut bonds of this particle. s: cutoff and cells of the neighbour search. */
static bool near_slit(const struct notches *n, const struct particles *p, const struct bond_source *s, int64_t i)
{
    for (int k = 0; k < n->slits + n->images; k++)
        if (near_crack(&n->slit[k], p, s, i)) return true;
    return false;
}

/* Computes n->lost[i], the share of the neighbour volume of particle i of p that slits (pre-cracks along which nodes of
 * the mesh are doubled) separate from the particle [1]. Neighbours are the particles of the same body within the
 * cutoff. Returns true if a slit separates particle i from a nearest neighbour, so that the particle is beside the
 * slit. source: cutoff and cells of the neighbour search; near: working memory. */
static bool face_find(struct notches *n, const struct particles *p, const struct bond_source *source,
                      struct neighbour_list *near, int64_t i)
{
    real all = 0, lost = 0;
    bool faces = false;
    particles_list_neighbours_within_radius(near, source->cells, p, i, source->family.cutoff, false);
    for (int q = 0; q < near->n; q++) {
        const int32_t j = near->at[q];
        if (p->body[j] != p->body[i]) continue;
        const bool cut = precracks_cut_bond_between(n->slit, n->slits + n->images, p, i, j);
        all += p->volume0[j], lost += cut ? p->volume0[j] : 0;
        faces |= cut && apart(p, i, j) < FACE_REACH * source->family.spacing;
    }
    n->lost[i] = all > 0 ? lost / all : 0;
    return faces;
}

/* Returns true if particle i is beside a void, a narrow gap in the body, that bonds of the particle would cross.
 * source: data of bonds, with the voids. */
static bool beside_void(const struct bond_source *source, int64_t i)
{
    return particle_is_beside_void(source->voids, i) && source->voids->near[i] & VOID_ACROSS;
}

/* Stores in n->lost[p->n] the fraction of the neighbour volume of each particle that slits (pre-cracks along which
 * nodes of the mesh are doubled) separate from the particle [1]. Lists in n->face[n->faces] the particles beside a slit
 * or a narrow void, and in n->depth their depth below the surface of the void [m], 0 at a slit. source: data of bonds,
 * with the voids and the cells of the neighbour search. */
static void faces_find(struct notches *n, const struct particles *p, const struct bond_source *source)
{
    uint8_t *faces = NEW("notch.faces", p->n, uint8_t);
    n->lost = NEW("notch.lost", p->n, real);
#pragma omp parallel
    {
        struct neighbour_list near = {0};
#pragma omp for schedule(static)
        for (int64_t i = 0; i < p->n; i++)
            faces[i] = (near_slit(n, p, source, i) && face_find(n, p, source, &near, i)) || beside_void(source, i);
        memory_free(near.at);
    }
    for (int64_t i = 0; i < p->n; i++) n->faces += faces[i];
    n->face = NEW("notch.face", n->faces, int32_t);
    n->depth = NEW("notch.depth", n->faces, real);
    n->faces = 0;
    for (int64_t i = 0; i < p->n; i++) {
        if (!faces[i]) continue;
        n->depth[n->faces] =
            beside_void(source, i) ? voids_particle_surface_distance_lower_bound(source->voids, p, i) : 0;
        n->face[n->faces++] = (int32_t)i;
    }
    memory_free(faces);
}

void notches_choose_slits_or_cut_bonds(struct notches *n, const struct particles *p, const struct bond_source *source,
                                       real tip_radius, const char *reason_against_slits)
{
    *n = (struct notches){.n = source->givens, .radius = tip_radius, .voids = source->voids};
    n->notch = NEW("notch.notch", n->n, struct notch);
    n->slit = NEW("notch.slit", n->n + source->cracks, struct crack);
    n->cut = NEW("notch.cut", source->cracks, struct crack);
    for (int k = 0; k < n->n; k++) {
        const struct crack *c = &source->given[k];
        const char *why = reason_against_slits ? reason_against_slits : notch_obstacle(c, p, source, tip_radius);
        n->notch[k] = (struct notch){!why, why};
        if (!why) n->slit[n->slits++] = *c;
    }
    for (int k = 0; k < source->cracks; k++)
        if (!n->notch[source->crack_of[k]].slit)
            n->cut[n->cuts++] = source->crack[k];
        else
            n->slit[n->slits + n->images++] = source->crack[k];
    if (n->slits > 0 || n->voids) faces_find(n, p, source);
}

void notches_make_slit_ends_peridynamic(const struct notches *n, struct particles *p, const struct bond_source *source)
{
    for (int k = 0; k < n->slits; k++) {
        const struct crack_edges zone = crack_edges_of(&n->slit[k], p, source, n->radius);
        for (int64_t i = 0; i < p->n; i++)
            if (n->lost[i] > 0 && near_crack(&n->slit[k], p, source, i) && in_zone(&zone, p, i)) p->kind[i] = KIND_PD;
    }
}

void notches_free(struct notches *n)
{
    memory_free(n->notch);
    memory_free(n->slit);
    memory_free(n->cut);
    memory_free(n->lost);
    memory_free(n->face);
    memory_free(n->depth);
    memset(n, 0, sizeof *n);
}

/* ---- approach of faces ------------------------------------------------------------------------------------------- */

/* Returns the distance below which two particles of p on both sides of a void are converted to peridynamic particles
 * [m]; 0 if no void is between them. This distance is reached when the faces of the void are VOID_AHEAD spacings apart,
 * but is at least NOTCH_GAP spacings less than the initial distance of the particles. k, l: indices of the particles in
 * n->face; spacing: lattice spacing [m]. */
static real void_meeting_distance(const struct notches *n, const struct particles *p, int64_t k, int64_t l,
                                  real spacing)
{
    real r2 = 0;
    if (!void_separates_particles(n->voids, p, n->face[k], n->face[l])) return 0;
    for (int d = 0; d < p->dim; d++) r2 += square(p->X[d][n->face[k]] - p->X[d][n->face[l]]);
    return real_min(sqrt(r2) - NOTCH_GAP * spacing, n->depth[k] + n->depth[l] + VOID_AHEAD * spacing);
}

/* Returns the distance below which two particles of p on both sides of a slit (pre-crack along which nodes of the mesh
 * are doubled) or of a void are converted to peridynamic particles [m]; 0 if neither is between them. face, other:
 * indices of the particles in n->face; spacing: lattice spacing [m]. */
static real meeting_distance(const struct notches *n, const struct particles *p, int64_t face, int64_t other,
                             real spacing)
{
    const int32_t i = n->face[face], j = n->face[other];
    real width = -1;
    for (int k = 0; k < n->slits; k++)
        if (parted(&n->slit[k], p, i, j)) width = real_max(width, n->slit[k].width);
    const real gap = NOTCH_GAP * spacing;
    return width < 0 ? void_meeting_distance(n, p, face, other, spacing) : spacing - real_max(gap, width - gap);
}

/* Returns the distance that particles i and j of p will have after the time `ahead` [s] at their present velocities
 * [m], if they approach each other; else their present distance. */
static real distance_ahead(const struct particles *p, int32_t i, int32_t j, real ahead)
{
    real r2 = 0, rate = 0;
    for (int d = 0; d < p->dim; d++) {
        const real away = p->x[d][i] - p->x[d][j];
        r2 += square(away), rate += away * (p->v[d][i] - p->v[d][j]);
    }
    const real r = sqrt(r2);
    return r > 0 ? r + real_min(0, rate / r) * ahead : 0;
}

/* Returns the radius of a search for pairs of particles of p that must be converted because the faces of a slit or void
 * meet [m]: pairs that will be nearer than their meeting_distance after the time `ahead` [s]. Two particles approach
 * each other by at most twice the largest speed of the particles beside slits, n->face. The radius is at most
 * MEET_REACH spacings. spacing: lattice spacing [m]. */
static real meeting_reach(const struct notches *n, const struct particles *p, real spacing, real ahead)
{
    const real gap = NOTCH_GAP * spacing;
    real deepest = 0, speed2 = 0;
    for (int64_t k = 0; k < n->faces; k++) {
        real v2 = 0;
        if (n->voids) deepest = real_max(deepest, n->depth[k]);
        for (int d = 0; d < p->dim; d++) v2 += square(p->v[d][n->face[k]]);
        speed2 = real_max(speed2, v2);
    }
    real most = n->voids ? 2 * deepest + VOID_AHEAD * spacing : 0;
    for (int k = 0; k < n->slits; k++) most = real_max(most, spacing - real_max(gap, n->slit[k].width - gap));
    return real_min(MEET_REACH * spacing, (most + 2 * sqrt(speed2) * ahead) * (1 + REACH_SLACK));
}

void notches_flag_closing_face_points_for_conversion(const struct notches *n, struct particles *p, real spacing,
                                                     real time_ahead)
{
    struct particles places = {.n = n->faces, .n_all = n->faces, .dim = p->dim};
    struct cells cells;
    if (n->faces == 0) return;
    const real reach = meeting_reach(n, p, spacing, time_ahead);
    for (int d = 0; d < p->dim; d++) {
        places.X[d] = BARE("notch.place", n->faces, real);
        for (int64_t k = 0; k < n->faces; k++) places.X[d][k] = p->x[d][n->face[k]];
    }
    cells_make_for_neighbour_search(&cells, &places, MEET_REACH * spacing);
#pragma omp parallel
    {
        struct neighbour_list near = {0};
#pragma omp for schedule(static)
        for (int64_t k = 0; k < n->faces; k++) {
            const int32_t i = n->face[k];
            if (p->kind[i] != KIND_MPM) continue;
            particles_list_neighbours_unordered(&near, &cells, &places, k, reach, false);
            for (int q = 0; q < near.n && !(p->flag[i] & FLAG_NEAR); q++) {
                const int32_t j = n->face[near.at[q]];
                const real after = distance_ahead(p, i, j, time_ahead);
                if (after < MEET_REACH * spacing && after < meeting_distance(n, p, k, near.at[q], spacing))
                    p->flag[i] |= FLAG_NEAR;
            }
        }
        memory_free(near.at);
    }
    cells_free(&cells);
    for (int d = 0; d < p->dim; d++) memory_free(places.X[d]);
}
