/* Tracks crack tips: assigns damaged particles to cracks, and computes growth and speed of the cracks. */
#include "fracture/tips.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "tips_parts.h"

#define JOIN_JUMP 3.0 /* growth in a sample above which it is due to joining another crack [spacings] */
#define GROWN 3.0     /* growth above which a crack is more than a cluster of damage beside another one [spacings] */

void tips_free(struct crack_tips *t)
{
    memory_free(t->label);
    memory_free(t->time);
    memory_free(t->growth);
    memset(t, 0, sizeof *t);
}

/* ---- particles of each crack ------------------------------------------------------------------------------------- */

/* State of one sample of crack tips, in which newly damaged particles are assigned to cracks from neighbour to
 * neighbour. */
struct flood {
    struct crack_tips *t;
    struct tip_search search;
    /* newly damaged particles in ascending order; labelled particles whose neighbours are not yet visited */
    int32_t *fresh, *queue;
    int64_t n_fresh, queued;
    int into[TIPS_MAX];      /* crack that each crack has become a part of; itself: none */
    bool grown_by[TIPS_MAX]; /* another crack has become a part of the crack in this sample */
};

/* Returns true if particle i of p can be assigned to a crack of t: its damage exceeds TIP_DAMAGE, it is not yet
 * assigned to a crack of t, and its motion is not prescribed. */
static bool can_belong(const struct crack_tips *t, const struct particles *p, int64_t i)
{
    return t->label[i] == 0 && p->damage[i] > TIP_DAMAGE && !(p->flag[i] & FLAG_DRIVEN);
}

static uint64_t damage_bits(const struct particles *p, int64_t i)
{
    uint64_t bits;
    memcpy(&bits, p->damage + i, sizeof bits);
    return bits;
}

/* Returns true if one of n particles of p, at[n], has damage above 0. The bits of their damages are combined instead of
 * comparing numbers, which is faster. */
static bool any_damage(const struct particles *p, const int32_t *at, int64_t n)
{
    uint64_t any = 0;
    if (particles_have_consecutive_numbers(at, n))
        for (int64_t k = 0; k < n; k++) any |= damage_bits(p, at[0] + k);
    else
        for (int64_t k = 0; k < n; k++) any |= damage_bits(p, at[k]);
    return any != 0;
}

/* Finds the next damaged particles in the list of peridynamic particles, p->list[KIND_PD], which is searched in pieces
 * of TIP_PIECE entries. first: entry at which the search starts, the first of a piece. Returns the first entry of the
 * first piece that contains a particle with damage above TIP_DAMAGE; the length of the list if there is none. */
static int64_t next_damaged(const struct particles *p, int64_t first)
{
    for (; first < p->n_of[KIND_PD]; first += TIP_PIECE) {
        const int32_t *at = p->list[KIND_PD] + first;
        const int64_t n = peridynamic_particle_list_chunk_end_index(p, first) - first;
        real most = 0;
        if (!any_damage(p, at, n)) continue;
        for (int64_t k = 0; k < n; k++) most = real_max(most, p->damage[at[k]]);
        if (most > TIP_DAMAGE) return first;
    }
    return p->n_of[KIND_PD];
}

/* Assigns particle i to crack number `tip`, from 0, and appends it to f->queue, the particles whose neighbours must be
 * visited. f: assignment of newly damaged particles to cracks, which spreads from neighbour to neighbour. */
static void flood_label(struct flood *f, int32_t i, int tip)
{
    f->t->label[i] = (uint8_t)(tip + 1);
    f->queue[f->queued++] = i;
}

/* Returns the number of the crack of f of which crack number `tip` has become a part in this sample (present set of tip
 * positions), or `tip` itself if it has not been merged. */
static int tips_root_of(const struct flood *f, int tip)
{
    while (f->into[tip] != tip) tip = f->into[tip];
    return tip;
}

/* Returns true if particle i (of f->search.p) is behind the tip of `crack` as it was in the previous sample (set of tip
 * positions), by more than TIP_TOUCH spacings. */
static bool is_behind(const struct flood *f, const struct crack_tip *crack, int32_t i)
{
    real X[DIM_MAX], offset[DIM_MAX];
    particle_reference_position(f->search.p, i, X);
    return segment_distance_and_offset_to_point(crack->origin, crack->edge, X, f->t->dim, offset) <
           crack->growth - TIP_TOUCH * f->t->spacing;
}

/* Returns true if the cracks a and b run side by side, as two cracks that leave a hole in the same direction. They
 * touch at the particles i of a and j of b. They run side by side if three conditions were true at the previous sample
 * (set of tip positions): both had grown by more than GROWN spacings, the directions from their starts to their tips
 * were less than 90 degrees apart, and i and j were behind the tips. f: assignment of damaged particles to cracks, with
 * all tips. */
static bool are_side_by_side(const struct flood *f, const struct crack_tip *a, const struct crack_tip *b, int32_t i,
                             int32_t j)
{
    real both = 0;
    for (int d = 0; d < f->t->dim; d++) both += (a->place[d] - a->origin[d]) * (b->place[d] - b->origin[d]);
    return both > 0 && real_min(a->growth, b->growth) > GROWN * f->t->spacing && is_behind(f, a, i) &&
           is_behind(f, b, j);
}

/* Returns true if a crack would become shorter by merging crack number `gone`, with all cracks merged into it in this
 * sample, into crack number `keep`. This is so if one of the former is longer than `keep` and has both its ends nearer
 * to the start of `keep` than to one another. f: assignment of damaged particles to cracks. */
static bool merging_would_shorten(const struct flood *f, int keep, int gone)
{
    const struct crack_tip *whole = &f->t->tip[keep];
    real offset[DIM_MAX];
    for (int k = 0; k < f->t->n; k++) {
        const struct crack_tip *part = &f->t->tip[k];
        if (tips_root_of(f, k) != gone) continue;
        real length = whole->growth;
        for (int end = 0; end < 2; end++)
            length =
                real_max(length, segment_distance_and_offset_to_point(
                                     whole->origin, whole->edge, end ? part->place : part->origin, f->t->dim, offset));
        if (length < part->growth - TIP_EQUAL * f->t->spacing) return true;
    }
    return false;
}

/* Merges the cracks to which the touching particles i and j belong, in f, the assignment of damaged particles to
 * cracks. Two cracks that both start at ends of pre-cracks, that the run side by side, or of which the longer one would
 * become shorter, stay separate. Otherwise a crack that starts at no pre-crack is merged into one that does, or, if
 * neither starts at a pre-crack, the later crack into the earlier one. */
static void flood_join(struct flood *f, int32_t i, int32_t j)
{
    const struct crack_tip *tip = f->t->tip;
    const int a = tips_root_of(f, f->t->label[i] - 1), b = tips_root_of(f, f->t->label[j] - 1);
    const bool a_fixed = tip[a].from_crack, b_fixed = tip[b].from_crack;
    if (a == b || (a_fixed && b_fixed) || are_side_by_side(f, &tip[a], &tip[b], i, j)) return;
    const int keep = a_fixed || (!b_fixed && a < b) ? a : b, gone = keep == a ? b : a;
    if (merging_would_shorten(f, keep, gone)) return;
    f->into[gone] = keep;
    f->grown_by[keep] = true;
}

/* Takes the particles of the queue f->queue one after the other, and assigns all damaged particles that are connected
 * with them, from neighbour to neighbour, to the same crack. Cracks that touch are merged. The queue is empty
 * afterwards. */
static void flood_run(struct flood *f)
{
    const struct particles *p = f->search.p;
    real X[DIM_MAX];
    for (int64_t head = 0; head < f->queued; head++) {
        int32_t i = f->queue[head];
        particle_reference_position(p, i, X);
        int tip = f->t->label[i] - 1,
            n = tip_search_find_particles_near_position(&f->search, X, (TIP_TOUCH + TIP_EQUAL) * f->t->spacing);
        for (int k = 0; k < n; k++) {
            int32_t j = f->search.found[k];
            if (j >= p->n || p->body[j] != p->body[i]) continue;
            if (can_belong(f->t, p, j))
                flood_label(f, j, tip);
            else if (f->t->label[j] != 0 && f->t->label[j] != TIP_BEFORE)
                flood_join(f, i, j);
        }
    }
    f->queued = 0;
}

/* Returns the number of the crack of t whose start is nearest to the reference position of particle i of p, among
 * cracks that start at the end of a pre-crack in the body of i; -1 if none starts within TIP_START_REACH spacings. */
static int start_near(const struct crack_tips *t, const struct particles *p, int64_t i)
{
    int nearest = -1;
    real X[DIM_MAX], offset[DIM_MAX], least = (TIP_START_REACH + TIP_EQUAL) * t->spacing;
    particle_reference_position(p, i, X);
    for (int k = 0; k < t->n; k++) {
        const struct crack_tip *tip = &t->tip[k];
        if (!tip->from_crack || tip->body != p->body[i]) continue;
        real distance = segment_distance_and_offset_to_point(tip->origin, tip->edge, X, t->dim, offset);
        if (distance > least || (nearest >= 0 && distance == least)) continue;
        nearest = k, least = distance;
    }
    return nearest;
}

/* Returns the lowest number of a crack that has a particle within TIP_TOUCH spacings of particle i, in the same body;
 * -1 if there is none. f: its search memory is used. */
static int crack_touched(struct flood *f, int64_t i)
{
    const struct particles *p = f->search.p;
    real X[DIM_MAX];
    particle_reference_position(p, i, X);
    int lowest = -1,
        n = tip_search_find_particles_near_position(&f->search, X, (TIP_TOUCH + TIP_EQUAL) * f->t->spacing);
    for (int k = 0; k < n; k++) {
        int32_t j = f->search.found[k];
        if (j >= p->n || p->body[j] != p->body[i]) continue;
        int label = f->t->label[j];
        if (label != 0 && label != TIP_BEFORE && (lowest < 0 || label - 1 < lowest)) lowest = label - 1;
    }
    return lowest;
}

/* Returns the number of the crack of t whose tip is nearest to the reference position of particle i of p. It is used if
 * t cannot store more tips. */
static int tip_nearest(const struct crack_tips *t, const struct particles *p, int64_t i)
{
    int nearest = 0;
    real least = INFINITY;
    for (int k = 0; k < t->n; k++) {
        real distance2 = 0;
        for (int d = 0; d < t->dim; d++) distance2 += square(p->X[d][i] - t->tip[k].place[d]);
        if (distance2 < least) nearest = k, least = distance2;
    }
    return nearest;
}

/* Starts a new crack at the most damaged of the newly damaged particles of f that belong to no crack, and assigns the
 * damaged particles connected with it. If the list of tips is full (TIPS_MAX), assigns them to the crack with the
 * nearest tip instead. Returns true if it has assigned particles; false if all newly damaged particles belong to a
 * crack already. */
static bool flood_nucleate(struct flood *f)
{
    const struct particles *p = f->search.p;
    int32_t best = -1;
    for (int64_t k = 0; k < f->n_fresh; k++) {
        int32_t i = f->fresh[k];
        if (f->t->label[i] == 0 && (best < 0 || p->damage[i] > p->damage[best])) best = i;
    }
    if (best < 0) return false;
    int tip = f->t->n;
    if (tip < TIPS_MAX) {
        real X[DIM_MAX];
        particle_reference_position(p, best, X);
        crack_tips_append_tip_without_growth(f->t, p->body[best], X, NULL);
        f->into[tip] = tip, f->grown_by[tip] = false;
    } else {
        tip = tip_nearest(f->t, p, best);
        f->grown_by[tips_root_of(f, tip)] = true;
    }
    flood_label(f, best, tip);
    flood_run(f);
    return true;
}

/* Removes the cracks that have been merged into others in this sample from the list of tips of f and from the record of
 * their growth. Renumbers the remaining cracks and the labels of particles. Does nothing if no crack has been
 * merged. */
static void flood_close_ranks(struct flood *f)
{
    struct crack_tips *t = f->t;
    int place[TIPS_MAX], kept = 0;
    uint8_t label[TIP_BEFORE + 1] = {[TIP_BEFORE] = TIP_BEFORE};
    for (int k = 0; k < t->n; k++)
        if (f->into[k] == k) place[k] = kept++;
    if (kept == t->n) return;
    for (int k = 0; k < t->n; k++) label[k + 1] = (uint8_t)(place[tips_root_of(f, k)] + 1);
    for (int64_t i = 0; i < t->count; i++) t->label[i] = label[t->label[i]];
    for (int k = 0; k < t->n; k++) {
        if (f->into[k] != k) continue;
        t->tip[place[k]] = t->tip[k];
        f->grown_by[place[k]] = f->grown_by[k];
        for (int64_t s = 0; s < t->samples; s++) t->growth[s * TIPS_MAX + place[k]] = t->growth[s * TIPS_MAX + k];
    }
    for (int64_t s = 0; s < t->samples; s++)
        for (int k = kept; k < t->n; k++) t->growth[s * TIPS_MAX + k] = 0;
    t->n = kept;
}

/* Prepares the assignment of damaged particles to cracks in one sample: lists in f->fresh the damaged particles of p
 * that belong to no crack of t yet, in the order of the list of peridynamic particles. c: cells of the neighbour
 * search. Release f with flood_free. */
static void flood_make(struct flood *f, struct crack_tips *t, const struct particles *p, const struct cells *c)
{
    const int32_t *list = p->list[KIND_PD];
    const int64_t n = p->n_of[KIND_PD];
    *f = (struct flood){.t = t, .search = {.p = p, .c = c}};
    for (int64_t b = next_damaged(p, 0); b < n; b = next_damaged(p, b + TIP_PIECE))
        for (int64_t k = b; k < peridynamic_particle_list_chunk_end_index(p, b); k++)
            f->n_fresh += can_belong(t, p, list[k]);
    f->fresh = NEW("tips.fresh", f->n_fresh, int32_t);
    f->queue = NEW("tips.queue", f->n_fresh, int32_t);
    int64_t fresh = 0;
    for (int64_t b = next_damaged(p, 0); b < n && fresh < f->n_fresh; b = next_damaged(p, b + TIP_PIECE))
        for (int64_t k = b; k < peridynamic_particle_list_chunk_end_index(p, b); k++)
            if (can_belong(t, p, list[k])) f->fresh[fresh++] = list[k];
    for (int m = 0; m < t->n; m++) f->into[m] = m;
}

static void flood_free(struct flood *f)
{
    memory_free(f->fresh);
    memory_free(f->queue);
    memory_free(f->search.found);
}

/* Assigns every newly damaged particle in f->fresh to a crack, by the first of these rules that applies: (1) the start
 * of the crack, or a particle of the crack, is near the particle (within TIP_START_REACH or TIP_TOUCH spacings); (2) a
 * damaged particle connected with the particle belongs to the crack; (3) a new crack begins at the particle. */
static void flood_all(struct flood *f)
{
    const struct particles *p = f->search.p;
    for (int64_t k = 0; k < f->n_fresh; k++) {
        int32_t i = f->fresh[k];
        if (f->t->label[i] != 0) continue;
        int tip = start_near(f->t, p, i);
        if (tip < 0) tip = crack_touched(f, i);
        if (tip >= 0) flood_label(f, i, tip);
    }
    flood_run(f);
    while (flood_nucleate(f)) continue;
    flood_close_ranks(f);
}

/* ---- length and speed -------------------------------------------------------------------------------------------- */

/* Updates position, growth and times of `tip` from r, the extent of its crack at time `time` [s]. If the extent is
 * below the previous growth, position and growth stay as they are. t: all cracks, for the spacing; took_in: true if
 * another crack has been merged into this one in this sample. If the growth then jumps by more than JOIN_JUMP spacings,
 * the jump is added to tip->joined, so that it does not count for the speed, and the crack gets a new number,
 * ++t->begun. */
static void tip_move(struct crack_tip *tip, const struct crack_extent *r, struct crack_tips *t, real time, bool took_in)
{
    real gain = r->farthest - tip->growth;
    tip->particles = r->particles;
    if (r->particles > 0 && isnan(tip->first_time)) tip->first_time = time;
    if (gain < -TIP_EQUAL * t->spacing || r->ends == 0) return;
    array_copy(tip->place, r->place, t->dim, sizeof *tip->place);
    tip->ends = r->ends;
    if (gain <= TIP_EQUAL * t->spacing) return;
    tip->growth = r->farthest;
    if (took_in && gain > JOIN_JUMP * t->spacing) tip->joined += gain, tip->number = ++t->begun;
    if (isnan(tip->start_time) && tip->growth >= (1 - TIP_EQUAL) * t->spacing) tip->start_time = time;
    if (!isnan(tip->start_time)) tip->arrest_time = time;
}

/* Returns the slope of the least-squares line through the growth of tip k of t as a function of time, in the samples
 * first .. last [m/s]; NAN if all these samples have the same time. */
static real regression(const struct crack_tips *t, int k, int64_t first, int64_t last)
{
    real n = (real)(last - first + 1), mean_time = 0, mean_growth = 0, both = 0, spread = 0;
    for (int64_t s = first; s <= last; s++) {
        mean_time += t->time[s] / n;
        mean_growth += t->growth[s * TIPS_MAX + k] / n;
    }
    for (int64_t s = first; s <= last; s++) {
        both += (t->time[s] - mean_time) * (t->growth[s * TIPS_MAX + k] - mean_growth);
        spread += square(t->time[s] - mean_time);
    }
    return spread > 0 ? both / spread : NAN;
}

/* Returns the index of the first sample of t (tip positions at one time) at or after `time` [s], or of the last sample
 * if all are earlier. */
static int64_t sample_at(const struct crack_tips *t, real time)
{
    int64_t s = 0;
    while (s < t->samples - 1 && t->time[s] < time) s++;
    return s;
}

real tips_average_speed(const struct crack_tips *t, int k)
{
    const int64_t last = t->samples - 1;
    if (last < 1) return 0;
    const int64_t first = sample_at(t, t->time[last] - t->window * (1 + 1e-9));
    return regression(t, k, first < last ? first : last - 1, last);
}

/* Updates the largest speed of tip number k, and its mean speed since its start, after a sample has been added to t.
 * The largest speed is that of the slopes of growth over the time window t->window that ends at a sample; it is not
 * updated before the samples cover one whole window. The mean speed is updated if the tip has grown in this sample.
 * Does nothing for a tip that has not started. */
static void tip_speeds(struct crack_tips *t, int k)
{
    struct crack_tip *tip = &t->tip[k];
    int64_t last = t->samples - 1;
    if (isnan(tip->start_time) || last < 1) return;
    real now = t->time[last], slack = 1e-9 * t->window;
    if (now - t->time[0] >= t->window - slack) {
        real slope = tips_average_speed(t, k);
        if (!(slope <= tip->speed_max)) tip->speed_max = slope;
    }
    if (tip->arrest_time == now && tip->start_time < now)
        tip->speed_mean = regression(t, k, sample_at(t, tip->start_time), last);
    /* a crack that has only joined others since its start has no speed, but round-off of either sign */
    if (tip->joined > 0 && !(fabs(tip->speed_mean) * (now - tip->start_time) >= TIP_EQUAL * t->spacing))
        tip->speed_mean = NAN;
}

static void record_grow(struct crack_tips *t, int64_t samples)
{
    GROW("tips.time", t->time, samples);
    GROW("tips.growth", t->growth, samples * TIPS_MAX);
}

void tips_update_from_damage(struct crack_tips *t, const struct particles *p, const struct cells *c, real time)
{
    INVARIANT(t->count == p->n && t->dim == p->dim);
    INVARIANT(t->samples == 0 || time >= t->time[t->samples - 1]);
    struct flood f;
    flood_make(&f, t, p, c);
    if (f.n_fresh > 0) flood_all(&f);
    flood_free(&f);

    struct crack_extent reach[TIPS_MAX] = {{0}};
    tips_compute_crack_extents(t, p, reach);
    record_grow(t, t->samples + 1);
    int64_t s = t->samples++;
    t->time[s] = time;
    for (int k = 0; k < t->n; k++) {
        tip_move(&t->tip[k], &reach[k], t, time, f.grown_by[k]);
        t->growth[s * TIPS_MAX + k] = t->tip[k].growth - t->tip[k].joined;
        tip_speeds(t, k);
    }
}

/* ---- queries ----------------------------------------------------------------------------------------------------- */

/* Returns the angle between the direction of the pre-crack and the straight line from the start of the crack to its
 * tip, 0 to 180 [degree]; NAN if the crack has not grown. dim: number of dimensions; in 3D only the part of the line
 * perpendicular to the crack front counts. */
real tip_deflection_angle(const struct crack_tip *tip, int dim)
{
    if (!(tip->growth > 0)) return NAN;
    real chord[DIM_MAX], edge2 = dot(tip->edge, tip->edge, dim), share = 0;
    for (int d = 0; d < dim; d++) chord[d] = tip->place[d] - tip->origin[d];
    /* chord of a front: its component perpendicular to the edge */
    if (edge2 > 0) share = dot(chord, tip->edge, dim) / edge2;
    for (int d = 0; d < dim; d++) chord[d] -= share * tip->edge[d];
    real length = sqrt(dot(chord, chord, dim));
    if (!(length > 0)) return NAN;
    return acos(real_max(-1, real_min(1, dot(chord, tip->along, dim) / length))) * (180 / M_PI);
}

/* Returns the tip of t with the largest growth, owned by t; NULL if no crack has grown. Of several with equal growth,
 * up to round-off, the first is returned: round-off then does not choose between the halves of a symmetric crack. */
const struct crack_tip *tips_find_tip_with_largest_growth(const struct crack_tips *t)
{
    const struct crack_tip *longest = NULL;
    for (int k = 0; k < t->n; k++)
        if (t->tip[k].growth > (longest ? longest->growth : 0) + TIP_EQUAL * t->spacing) longest = &t->tip[k];
    return longest;
}

int64_t tips_count_crack_ends_with_largest_growth(const struct crack_tips *t)
{
    const struct crack_tip *longest = tips_find_tip_with_largest_growth(t);
    int64_t tied = 0;
    for (int k = 0; k < t->n && longest; k++)
        if (t->tip[k].growth > 0 && t->tip[k].growth >= longest->growth - (1 + TIP_EQUAL) * t->spacing)
            tied += t->tip[k].ends;
    return tied;
}

status tips_save_or_load(struct crack_tips *t, struct archive *a)
{
    int64_t samples = t->samples;
    ARCHIVE_VALUE(a, "tips/n", t->n);
    ARCHIVE_VALUE(a, "tips/begun", t->begun);
    ARCHIVE_VALUE(a, "tips/tip", t->tip);
    ARCHIVE_VALUE(a, "tips/samples", samples);
    if (!a->saving) {
        record_grow(t, samples);
        t->samples = samples;
    }
    if (samples > 0) {
        TRY(a->exchange(a, "tips/time", t->time, (size_t)samples * sizeof *t->time));
        TRY(a->exchange(a, "tips/growth", t->growth, (size_t)samples * TIPS_MAX * sizeof *t->growth));
    }
    return archive_save_or_load_particle_array(a, "tips/label", t->label, t->count, sizeof *t->label);
}
