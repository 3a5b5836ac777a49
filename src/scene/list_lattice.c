/* Recognises particle lists whose positions form a lattice: the positions of a body are whole spacings apart within the
 * rounding of their decimals, and all volumes equal the volume of a cell. The coordinates are then rounded so that all
 * distances equal those of a lattice that fills a shape, bit for bit. */
#include "list_lattice.h"

#include <math.h>

#include "base/memory.h"
#include "data/particles.h"

#define DECIMALS 1e-3        /* largest distance of a position, rounded to decimals, from its site [spacings] */
#define EVEN 1e-3            /* largest relative difference of a volume from the volume of a cell [1] */
#define NEIGHBOURS_LEAST 0.5 /* least share of particles with a neighbour one spacing away along x */
#define FARTHEST 1e6         /* largest distance of a site from the first [spacings] */
enum { BODIES = 256 };       /* largest number of bodies in a list */

/* A lattice site: integer position at[], in spacings from the first particle of the body, and index of its body. Sites
 * are sorted by body, then by the position along the last axis, and along x last. */
struct site {
    int32_t body, at[DIM_MAX];
};

static int site_order(const void *a, const void *b)
{
    const struct site *p = a, *q = b;
    if (p->body != q->body) return p->body < q->body ? -1 : 1;
    for (int d = DIM_MAX - 1; d >= 0; d--)
        if (p->at[d] != q->at[d]) return p->at[d] < q->at[d] ? -1 : 1;
    return 0;
}

static int list_body(const struct particle_list *l, int64_t i) { return l->body ? (int)l->body[i] : 0; }

/* Sorts site[n], the lattice sites of the particles of a list, by body and position. Returns true if at least the share
 * NEIGHBOURS_LEAST of the particles has a neighbour one spacing away along x, so that the sites count as a lattice. */
static bool sites_dense(struct site *site, int64_t n)
{
    int64_t beside = 0;
    array_sort(site, n, sizeof *site, site_order);
    for (int64_t k = 0; k + 1 < n; k++) {
        struct site next = site[k];
        next.at[0]++;
        beside += site_order(&next, &site[k + 1]) == 0;
    }
    return (real)beside >= NEIGHBOURS_LEAST * (real)n;
}

bool particle_list_is_lattice(const struct particle_list *l, real spacing, real cell_volume)
{
    int64_t first[BODIES];
    bool lattice = l->n > 1 && spacing > 0;
    struct site *site = NEW("list.sites", l->n, struct site);
    for (int b = 0; b < BODIES; b++) first[b] = -1;
    for (int64_t i = 0; i < l->n && lattice; i++) {
        const int body = list_body(l, i);
        if (first[body] < 0) first[body] = i;
        site[i].body = body;
        if (l->volume) lattice = fabs(l->volume[i] / cell_volume - 1) <= EVEN;
        for (int d = 0; d < l->dim && lattice; d++) {
            const real at = (l->X[d][i] - l->X[d][first[body]]) / spacing, whole = nearbyint(at);
            lattice = fabs(at - whole) <= DECIMALS && fabs(whole) <= FARTHEST;
            site[i].at[d] = (int32_t)whole;
        }
    }
    lattice = lattice && sites_dense(site, l->n);
    memory_free(site);
    return lattice;
}

/* Returns the power of two 2^(ceil(log2 most) - 53), whose multiples up to `most` are all exact doubles. */
static real lattice_unit(real most) { return exp2(ceil(log2(most)) - 53); }

void coordinates_round_to_lattice(real *coordinate, int64_t count, real spacing, real plane_coordinate)
{
    if (count == 0) return;
    real off = 0, low = coordinate[0], high = coordinate[0], least = 0, most = 0;
    const real start = coordinate[0];
    for (int64_t i = 0; i < count; i++) {
        const real at = (coordinate[i] - start) / spacing, beside = at - nearbyint(at);
        off += beside / (real)count;
        least = real_min(least, beside), most = real_max(most, beside);
        low = real_min(low, coordinate[i]), high = real_max(high, coordinate[i]);
    }
    if (most - least <= 0.5 * LATTICE_NEAR) return; /* to all digits already */
    real first = start + off * spacing;
    const real halves = 2 * (first - plane_coordinate) / spacing;
    if (fabs(halves - nearbyint(halves)) <= 2 * DECIMALS) first = plane_coordinate + 0.5 * nearbyint(halves) * spacing;
    const real unit = lattice_unit(real_max(fabs(low), fabs(high)) + (high - low) + 2 * spacing);
    const real step = nearbyint(spacing / unit) * unit, origin = nearbyint(first / unit) * unit;
    const bool exact = fabs(step - spacing) * (high - low) <= 0.5 * LATTICE_NEAR * square(spacing);
    for (int64_t i = 0; i < count; i++) {
        const real site = nearbyint((coordinate[i] - start) / spacing);
        coordinate[i] = exact ? origin + site * step : first + site * spacing;
    }
}
