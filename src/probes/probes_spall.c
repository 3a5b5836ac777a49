/* Finds, for SPALL probes, the first plane across a body that neither bonds nor material points connect. */
#include <math.h>

#include "base/memory.h"
#include "probes_parts.h"

/* A body divided into columns (slices along x that are one spacing wide), and the connections between them while
 * separation is searched. Plane k is between columns k and k + 1. Owns its arrays. */
struct columns {
    int64_t n;
    real low, spacing;     /* centre of column 0, width of a column [m] */
    int32_t *intact, *cut; /* [n] numbers of bonds across plane k */
    real *last, *next;     /* [n] largest x of material points left of plane k, smallest x right of it [m] */
    real longest;          /* length of the longest bond [m] */
};

/* Returns the column, a slice of width c->spacing along x, that contains reference coordinate X [m]; limited to 0 .. n
 * - 1. */
static int64_t probes_spall_column_of(const struct columns *c, real X)
{
    int64_t k = (int64_t)floor((X - c->low) / c->spacing + 0.5);
    return k < 0 ? 0 : k >= c->n ? c->n - 1 : k;
}

/* Allocates in *c the columns of body number `body` of the run o: slices along x, one spacing wide. Returns false if
 * there are fewer than two. Release with probes_spall_columns_free in both cases. */
static bool probes_spall_columns_make(struct columns *c, const struct observed_run *o, int body)
{
    const struct particles *p = o->part;
    real low = INFINITY, high = -INFINITY;
    for (int64_t i = 0; i < p->n; i++) {
        if (p->body[i] != body) continue;
        low = real_min(low, p->X[0][i]), high = real_max(high, p->X[0][i]);
    }
    *c = (struct columns){.low = low, .spacing = o->spacing};
    if (!(high > low)) return false;
    c->n = (int64_t)floor((high - low) / o->spacing + 0.5) + 1;
    c->intact = NEW("spall.intact", c->n, int32_t);
    c->cut = NEW("spall.cut", c->n, int32_t);
    c->last = NEW("spall.last", c->n, real);
    c->next = NEW("spall.next", c->n, real);
    return c->n > 1;
}

static void probes_spall_columns_free(struct columns *c)
{
    memory_free(c->intact);
    memory_free(c->cut);
    memory_free(c->last);
    memory_free(c->next);
}

/* Counts a bond between particles in the slices a and b of the body (along x, numbered from 0): adds 1 to count[] at
 * the lower and subtracts 1 at the higher slice, so that prefix sums of count[] are the numbers of bonds across the
 * planes between slices. */
static void count_across(int32_t *count, int64_t a, int64_t b)
{
    count[a < b ? a : b]++;
    count[a < b ? b : a]--;
}

/* Counts the intact and the broken bonds of body number `body` of the run o across each plane between columns (slices
 * along x), in c->intact and c->cut. Each bond counts once for each of its two particles. Stores the length of the
 * longest bond in c->longest [m]. */
static void columns_bonds(struct columns *c, const struct observed_run *o, int body)
{
    const struct bonds *b = o->bonds;
    const struct particles *p = o->part;
    for (int64_t row = 0; row < b->rows; row++) {
        int32_t i = b->particle[row];
        if (p->body[i] != body) continue;
        const int64_t from = probes_spall_column_of(c, p->X[0][i]);
        for (struct bond_iterator it = bond_iterator_of_row(b, row); bond_iterator_advance(&it);) {
            const int64_t to = probes_spall_column_of(c, p->X[0][it.bond.nbr]);
            c->longest = real_max(c->longest, fabs(1 / it.bond.inverse_length));
            if (it.bond.w != 0)
                count_across(c->intact, from, to);
            else if (b->broken[row] > 0)
                count_across(c->cut, from, to);
        }
    }
    for (int64_t k = 1; k < c->n; k++) c->intact[k] += c->intact[k - 1], c->cut[k] += c->cut[k - 1];
}

/* Finds the material points of body number `body` of p that are next to each plane between columns (slices along x):
 * c->last[k], the largest x left of plane k, and c->next[k], the smallest x right of it [m]. If they are at most a bond
 * length apart, the grid connects them. Points that have just lost a bond are ignored, as they are about to become
 * peridynamic. */
static void columns_points(struct columns *c, const struct particles *p, int body)
{
    for (int64_t k = 0; k < c->n; k++) c->last[k] = -INFINITY, c->next[k] = INFINITY;
    for (int64_t i = 0; i < p->n; i++) {
        if (p->body[i] != body || p->kind[i] != KIND_MPM || p->flag[i] & FLAG_LOST_BOND) continue;
        int64_t k = probes_spall_column_of(c, p->X[0][i]);
        c->last[k] = real_max(c->last[k], p->X[0][i]);
        if (k > 0) c->next[k - 1] = real_min(c->next[k - 1], p->X[0][i]);
    }
    for (int64_t k = 1; k < c->n; k++) c->last[k] = real_max(c->last[k], c->last[k - 1]);
    for (int64_t k = c->n - 2; k >= 0; k--) c->next[k] = real_min(c->next[k], c->next[k + 1]);
}

/* Returns true if the body of c is separated at plane number `plane` (between columns `plane` and plane + 1, slices
 * along x): no bond across the plane is intact, at least one is broken, and the material points on its two sides are
 * more than a bond length apart. */
static bool probes_spall_is_apart(const struct columns *c, int64_t plane)
{
    return c->intact[plane] == 0 && c->cut[plane] > 0 && !(c->next[plane] - c->last[plane] <= c->longest);
}

/* Finds the lowest plane between columns at which the body is separated, and stores its coordinate in *position [m].
 * Adjacent separated planes count as one, at their middle. Returns false if the body is not separated. c: columns,
 * slices of the body along x. */
static bool columns_apart(const struct columns *c, real *position)
{
    for (int64_t k = 0; k < c->n - 1; k++) {
        if (!probes_spall_is_apart(c, k)) continue;
        int64_t end = k;
        while (end + 1 < c->n - 1 && probes_spall_is_apart(c, end + 1)) end++;
        *position = c->low + (0.5 * (real)(k + end) + 0.5) * c->spacing;
        return true;
    }
    return false;
}

void spall_probe_detect_separation(struct probe *probe, const struct observed_run *o)
{
    int bodies = 0;
    if (!o->bonds || o->bonds->rows == 0) return;
    for (int64_t i = 0; i < o->part->n; i++)
        if (o->part->body[i] >= bodies) bodies = o->part->body[i] + 1;
    for (int body = 0; body < bodies && isnan(probe->memory.first_time); body++) {
        struct columns c;
        if (probes_spall_columns_make(&c, o, body)) {
            columns_bonds(&c, o, body);
            columns_points(&c, o->part, body);
            real position;
            if (columns_apart(&c, &position)) {
                probe->memory.first_time = o->t;
                probe->memory.position[0] = position;
                probe->memory.body = body;
            }
        }
        probes_spall_columns_free(&c);
    }
}

void spall_probe_compute_part_speeds(const struct probe *probe, const struct particles *p, real *lighter_part_speed,
                                     real *remaining_part_speed)
{
    real mass[2] = {0}, momentum[2] = {0};
    for (int64_t i = 0; i < p->n; i++) {
        if (p->body[i] != probe->memory.body) continue;
        int side = p->X[0][i] > probe->memory.position[0];
        mass[side] += p->mass[i];
        momentum[side] += p->mass[i] * p->v[0][i];
    }
    int end = mass[1] <= mass[0];
    *lighter_part_speed = mass[end] > 0 ? momentum[end] / mass[end] : NAN;
    *remaining_part_speed = mass[!end] > 0 ? momentum[!end] / mass[!end] : NAN;
}
