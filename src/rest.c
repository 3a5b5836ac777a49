/* floor 3: who sleeps and who wakes. */
#include "rest.h"

#include <string.h>

#include "bonds.h"
#include "loads.h"
#include "memory.h"

void rest_make(struct rest *r, int64_t blocks)
{
    *r = (struct rest){.blocks = blocks};
    r->level = NEW("rest.level", blocks, uint8_t);
    r->moved = NEW("rest.moved", blocks, uint8_t);
    r->list = NEW("rest.list", blocks, int32_t);
    memset(r->level, 1, (size_t)blocks);
    rest_list(r);
}

void rest_free(struct rest *r)
{
    memory_free(r->level);
    memory_free(r->moved);
    memory_free(r->list);
}

void rest_list(struct rest *r)
{
    r->awake = 0;
    for (int64_t k = 0; k < r->blocks; k++)
        if (r->level[k] > 0) r->list[r->awake++] = (int32_t)k;
}

/* ---- rows of bonds ----------------------------------------------------------------------------------------- */

/* What knows its family by places and tells it to its bonds is felt at two horizons. */
static int most_of(const struct bonds *b) { return b->state.modulus ? 3 : 2; }

static bool same(real a, real b) { return memcmp(&a, &b, sizeof a) == 0; }

static bool has_moved(const struct bonds *b, const struct particles *p, int64_t block)
{
    for (int64_t row = block * REST_ROWS; row < b->rows && row < (block + 1) * REST_ROWS; row++)
        for (int d = 0; d < p->dim; d++)
            if (!same(p->x[d][b->particle[row]], p->X[d][b->particle[row]])) return true;
    return false;
}

/* Neither places, velocities nor forces differ from nothing, and nothing but bonds will move its particles. */
static bool is_quiet(const struct bonds *b, const struct particles *p, const uint8_t *loaded, int64_t block)
{
    for (int64_t row = block * REST_ROWS; row < b->rows && row < (block + 1) * REST_ROWS; row++) {
        const int32_t i = b->particle[row];
        if (loaded[i] || particle_on_grid(p, i)) return false;
        for (int d = 0; d < p->dim; d++)
            if (!same(p->v[d][i], 0) || p->f[d][i] != 0) return false;
    }
    return !has_moved(b, p, block);
}

/* Gives a block a level, and who is next to it one less, and so on. */
static void wake(struct bonds *b, const struct particles *p, const struct loads *l, int64_t block, int level)
{
    if (b->rest.level[block] >= level) return;
    b->rest.level[block] = (uint8_t)level;
    const int64_t first = block * (REST_ROWS / LANES), end = first + REST_ROWS / LANES;
    if (level == 1) return;
    for (int64_t q = b->slot[first] * LANES; q < b->slot[end < b->groups ? end : b->groups] * LANES; q++) {
        const int32_t row = b->row_of[image_root(p, l->image, b->nbr[q])];
        if (row >= 0) wake(b, p, l, row / REST_ROWS, level - 1);
    }
}

static void settle(struct bonds *b, const struct particles *p, const struct loads *l)
{
    uint8_t *loaded = NEW("rest.loaded", p->n, uint8_t), *quiet = NEW("rest.quiet", b->rest.blocks, uint8_t);
    for (int c = 0; c < l->n; c++)
        for (int64_t k = 0; k < l->load[c].n; k++) loaded[l->load[c].particle[k]] = 1;
#pragma omp parallel for schedule(static)
    for (int64_t k = 0; k < b->rest.blocks; k++) quiet[k] = is_quiet(b, p, loaded, k);
    memset(b->rest.level, memchr(quiet, 1, (size_t)b->rest.blocks) ? 0 : most_of(b), (size_t)b->rest.blocks);
    for (int64_t k = 0; k < b->rest.blocks; k++)
        if (!quiet[k]) wake(b, p, l, k, most_of(b));
    b->rest.settled = true;
    memory_free(loaded);
    memory_free(quiet);
}

/* Only who is awake but has not moved can have done so now. */
static void follow(struct bonds *b, const struct particles *p, const struct loads *l)
{
    struct rest *r = &b->rest;
    const int most = most_of(b);
    int64_t moved = 0;
#pragma omp parallel for schedule(static) reduction(+ : moved)
    for (int64_t k = 0; k < r->awake; k++) {
        if (r->level[r->list[k]] >= most) continue;
        r->moved[r->list[k]] = has_moved(b, p, r->list[k]);
        moved += r->moved[r->list[k]];
    }
    if (moved == 0) return;
    for (int64_t k = 0; k < r->awake; k++)
        if (r->moved[r->list[k]]) wake(b, p, l, r->list[k], most);
    rest_list(r);
}

void rest_rows(struct bonds *b, const struct particles *p, const struct loads *l)
{
    if (b->rest.settled) {
        follow(b, p, l);
        return;
    }
    settle(b, p, l);
    rest_list(&b->rest);
}
