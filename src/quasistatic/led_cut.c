/* Advances of led cracks: the bonds that the next stretches of their tips cut, and the loads at which they come. */
#include <math.h>

#include "led.h"
#include "balance.h"
#include "load_size.h"
#include "overload.h"
#include "touch.h"
#include "trial.h"

#include "base/memory.h"
#include "kernels/kernels.h"
#include "kernels/pd/bond_last.h"

#define STRESSED 0.5  /* overload below which nothing is tried */
#define AGAIN 1.25    /* growth of loads after which what is not due is tried anew */
#define TOGETHER 0.02 /* tips whose loads differ by less come together */
#define BEYOND 0.01   /* of a stretch that is cut: bonds through its very end count as cut on either side [spacings] */
enum { CLAIMS_MOST = 4 };

/* ---- bonds that a stretch cuts ----------------------------------------------------------------------------------- */

/* Adds the bonds of a row that one of the ways cuts. */
static void cut_row(const struct led *l, const struct bonds *b, const struct particles *p, int64_t r,
                    const struct crack_list *ways, struct break_list *list)
{
    real X[DIM_MAX] = {0}, Y[DIM_MAX] = {0};
    bool close = false;
    led_project_particle(&l->plane, p, b->particle[r], X);
    for (int w = 0; w < ways->n; w++) close |= crack_near(&ways->crack[w], X, l->source->family.cutoff, 2);
    for (struct bond_iterator it = bonds_of_row(b, r); close && bond_next(&it);) {
        bool cut = false;
        if (it.bond.w == 0) continue;
        led_project_particle(&l->plane, p, it.bond.nbr, Y);
        for (int w = 0; w < ways->n; w++) cut |= crack_cuts(&ways->crack[w], X, Y, 2);
        if (!cut) continue;
        const struct broken_bond record = statics_bond_record(b, p, &l->source->limit, &it.bond, r);
        break_list_add(list, &record);
    }
}

/* A stretch of a tip's way, and its images in planes of symmetry. */
static void ways_of(const struct led *l, const struct led_tip *tip, const real from[2], const real to[2],
                    struct crack_list *ways)
{
    real corner[2][DIM_MAX] = {{0}};
    const real beyond = BEYOND * l->plane.spacing;
    for (int d = 0; d < 2; d++)
        corner[tip->reversed][d] = from[d], corner[!tip->reversed][d] = to[d] + beyond * tip->heading[d];
    const struct crack path = {.n = 2, .corner = corner};
    cracks_mirrored(ways, &path, 1, l->plane.mirror, l->plane.mirrors, l->source->family.cutoff,
                    ON_SURFACE * l->plane.spacing);
}

/* What the bonds of a stretch cost is that of its area [J]: state-based bonds have no energy of their own, and in space
 * those of the sides of a body have weights of faces, and some at the tip of a pre-crack have been cut with it. */
static void stretch_price(const struct led *l, const struct particles *p, const struct led_tip *tip,
                          struct break_list *list)
{
    const bool state_based = l->scene->model != MODEL_BOND;
    real to[2], sum = 0;
    led_next_place(l, p, tip, to);
    const real whole = led_face_area(&l->plane, p, tip->place, to) * led_toughness(l, p, tip);
    for (int64_t k = 0; k < list->n; k++) sum += list->bond[k].held;
    for (int64_t k = 0; k < list->n; k++)
        list->bond[k].held = state_based ? whole / (real)list->n : list->bond[k].held * whole / sum;
}

/* All of what the next stretch of a tip cuts; returns what it costs [J]. */
static real stretch_list(const struct led *l, const struct bonds *b, const struct particles *p,
                         const struct led_tip *tip, struct break_list *list)
{
    struct crack_list ways;
    real cost = 0, to[2];
    led_next_place(l, p, tip, to);
    ways_of(l, tip, tip->place, to, &ways);
    for (int64_t r = 0; r < b->rows; r++) cut_row(l, b, p, r, &ways, list);
    crack_list_free(&ways);
    if (l->scene->model != MODEL_BOND || p->dim == 3) stretch_price(l, p, tip, list);
    for (int64_t k = 0; k < list->n; k++) cost += list->bond[k].held;
    return cost;
}

void led_free_behind(struct run *e, const struct led_tip *tip)
{
    const struct led *l = &e->statics->led;
    const real length = real_min(tip->sees, e->source.family.cutoff + 2 * e->scene->spacing);
    struct break_list list = {0};
    struct crack_list ways;
    real from[2];
    for (int d = 0; d < 2; d++) from[d] = tip->place[d] - length * tip->along[d];
    ways_of(l, tip, from, tip->place, &ways);
    for (int64_t r = 0; r < e->bonds.rows; r++) cut_row(l, &e->bonds, &e->part, r, &ways, &list);
    crack_list_free(&ways);
    for (int64_t k = 0; k < list.n; k++) list.bond[k].held = 0;
    statics_break_listed(e, &list);
    memory_free(list.bond);
}

/* ---- trials ------------------------------------------------------------------------------------------------------ */

/* Marks material points round the next stretch for conversion, since cracks need bonds. Returns their number. */
static int64_t stretch_claim(const struct led *l, struct particles *p, const struct led_tip *tip)
{
    real to[DIM_MAX] = {0}, from[DIM_MAX] = {tip->place[0], tip->place[1]};
    int64_t claimed = 0;
    led_next_place(l, p, tip, to);
    for (int64_t i = 0; i < p->n; i++) {
        real X[DIM_MAX] = {0};
        if (p->kind[i] != KIND_MPM || p->body[i] != tip->body) continue;
        led_project_particle(&l->plane, p, i, X);
        if (segment_distance(from, to, X, 2) > l->source->family.cutoff) continue;
        p->flag[i] |= FLAG_LOST_BOND;
        claimed++;
    }
    return claimed;
}

/* Tips turn to where they go; what they are to cut becomes peridynamic. */
static status tips_turn(struct run *e)
{
    struct led *l = &e->statics->led;
    int64_t claimed = 1;
    for (int round = 0; round < CLAIMS_MOST && claimed > 0; round++) {
        const bool closed = statics_faces_closed(e->contact);
        claimed = 0;
        for (int k = 0; k < l->n; k++)
            if (!l->tip[k].ended)
                led_turn(l, &e->part, closed, &l->tip[k]), claimed += stretch_claim(l, &e->part, &l->tip[k]);
        if (claimed > 0) TRY(statics_convert(e, 0));
    }
    return OK;
}

/* Breaks bonds, and says what the body releases by it. */
static status list_try(struct run *e, const struct break_list *l, struct advance *a)
{
    const real before = statics_released(e->statics, &e->bonds);
    statics_break_listed(e, l);
    const status tried = statics_go(e, e->statics->t);
    a->release = (statics_released(e->statics, &e->bonds) - before) / square(statics_load_size(e, e->statics->t));
    return tried;
}

/* The stretch behind the tip of a pre-crack that has not grown, by the next one and the one after it, straight on. The
 * next one is broken. */
static status behind_first_find(struct run *e, struct led_tip *tip)
{
    struct led_tip beyond = *tip;
    struct break_list list = {0};
    struct advance second = {0};
    status tried = OK;
    led_next_place(&e->statics->led, &e->part, tip, beyond.place);
    second.cost = stretch_list(&e->statics->led, &e->bonds, &e->part, &beyond, &list);
    if (list.n > 0) {
        tried = list_try(e, &list, &second);
        statics_mend(e->statics, &e->bonds, &e->part, &list);
        tip->behind = advance_before(&tip->ahead, &second);
    }
    memory_free(list.bond);
    return tried;
}

/* Breaks the bonds of a tip's next stretch on trial. */
static status stretch_try(struct run *e, struct led_tip *tip, const struct break_list *l)
{
    struct memory_archive saved;
    trial_begin(e, &saved);
    status tried = list_try(e, l, &tip->ahead);
    if (tried == OK && tip->grown == 0) tried = behind_first_find(e, tip);
    trial_undo(e, &saved, l);
    return tried;
}

static bool list_has(const struct break_list *l, const struct broken_bond *record)
{
    for (int64_t k = 0; k < l->n; k++)
        if (l->bond[k].row == record->row && l->bond[k].entry == record->entry) return true;
    return false;
}

/* The next advance: the tip whose stretch comes first, and those that come with it. */
static void advance_choose(struct statics *s, struct break_list *list)
{
    struct led *l = &s->led;
    real first = INFINITY;
    s->ahead = s->behind = (struct advance){0};
    for (int k = 0; k < l->n; k++) first = real_min(first, l->tip[k].due);
    for (int k = 0; k < l->n; k++) {
        struct led_tip *tip = &l->tip[k];
        tip->comes = isfinite(tip->due) && tip->due <= first * (1 + TOGETHER);
        if (!tip->comes) continue;
        for (int64_t q = 0; q < list[k].n; q++)
            if (!list_has(&s->next, &list[k].bond[q])) break_list_add(&s->next, &list[k].bond[q]);
        s->ahead.cost += tip->ahead.cost, s->ahead.release += tip->ahead.release;
        s->behind.cost += tip->behind.cost, s->behind.release += tip->behind.release;
    }
    s->due = size_of_balance(&s->ahead, &s->behind);
}

/* Tips that come together release more than each of them beside the others as they are. What they release at once is
 * shared among them; the stretches behind them are such shares, too, but before the first advance. */
static status together_try(struct run *e)
{
    struct statics *s = e->statics;
    struct memory_archive saved;
    const real apart = s->ahead.release;
    int comes = 0;
    bool grown = true;
    for (int k = 0; k < s->led.n; k++)
        if (s->led.tip[k].comes) comes++, grown = grown && s->led.tip[k].grown > 0;
    if (comes < 2) return OK;
    trial_begin(e, &saved);
    const status tried = list_try(e, &s->next, &s->ahead);
    trial_undo(e, &saved, &s->next);
    for (int k = 0; k < s->led.n && apart > 0; k++)
        if (s->led.tip[k].comes) s->led.tip[k].ahead.release *= s->ahead.release / apart;
    if (grown) s->due = size_of_balance(&s->ahead, &s->behind);
    return tried;
}

/* Compressed tips do not advance; one that has nothing to cut has arrived. */
static status tip_try(struct run *e, struct led_tip *tip, struct break_list *list)
{
    tip->ahead = (struct advance){0}, tip->due = INFINITY;
    if (tip->ended || !(tip->K[0] >= 0)) return OK;
    tip->ahead.cost = stretch_list(&e->statics->led, &e->bonds, &e->part, tip, list);
    tip->ended = list->n == 0;
    if (tip->ended) return OK;
    TRY(stretch_try(e, tip, list));
    tip->due = size_of_balance(&tip->ahead, &tip->behind);
    return OK;
}

status led_look_ahead(struct run *e)
{
    struct statics *s = e->statics;
    struct break_list list[LED_MAX] = {{0}};
    status tried = OK;
    const real size = statics_load_size(e, s->t);
    if (s->overload < STRESSED || (s->next.n > 0 && (size >= s->due || size < AGAIN * s->led.tried))) return OK;
    s->led.tried = size;
    TRY(tips_turn(e));
    for (int k = 0; k < s->led.n && tried == OK; k++) tried = tip_try(e, &s->led.tip[k], &list[k]);
    s->next.n = 0;
    if (tried == OK) advance_choose(e->statics, list);
    if (tried == OK) tried = together_try(e);
    for (int k = 0; k < s->led.n; k++) memory_free(list[k].bond);
    return tried;
}

void led_advance(struct led *l, const struct particles *p)
{
    for (int k = 0; k < l->n; k++) {
        struct led_tip *tip = &l->tip[k];
        tip->behind = tip->comes ? tip->ahead : (struct advance){0};
        if (tip->comes) led_move(l, p, k);
        tip->comes = false;
    }
}
