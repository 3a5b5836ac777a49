/* Determines the increments of SIF-driven cracks (growth direction from stress-intensity factors): the bonds that cross
 * the next segments of their paths, and the load size at which each increment is made. */
#include <math.h>

#include "sif_cracks.h"
#include "balance.h"
#include "load_size.h"
#include "stretch_ratio.h"
#include "contact_set.h"
#include "trial.h"

#include "base/memory.h"
#include "kernels/kernels.h"

#define STRESSED 0.5  /* ratio of stretch to critical stretch below which no increment is computed [1] */
#define AGAIN 1.25    /* growth of the load size after which an increment that is not due is recomputed */
#define TOGETHER 0.02 /* relative difference of load sizes below which tips grow together */
#define BEYOND 0.01   /* extension of a segment, so that bonds through its end are cut on both sides [spacings] */
enum { CONVERSIONS_MOST = 4 }; /* largest number of conversions of material points for one increment */

/* ---- bonds across a segment -------------------------------------------------------------------------------------- */

/* Appends to `list` a record (row, index and energy of the bond) for each intact bond in row r of b, the bonds of one
 * particle of p, that crosses one of `segments`. Bonds and segments are projected onto the plane in which the crack
 * tips of `cracks` move. */
static void row_bonds_cut(const struct sif_cracks *cracks, const struct bonds *b, const struct particles *p, int64_t r,
                          const struct crack_list *segments, struct break_list *list)
{
    real X[DIM_MAX] = {0}, Y[DIM_MAX] = {0};
    bool close = false;
    crack_tip_plane_project_particle(&cracks->plane, p, b->particle[r], X);
    for (int w = 0; w < segments->n; w++)
        close |= crack_may_cut_bonds_near(&segments->crack[w], X, cracks->source->family.cutoff, 2);
    for (struct bond_iterator it = bond_iterator_of_row(b, r); close && bond_iterator_advance(&it);) {
        bool cut = false;
        if (it.bond.w == 0) continue;
        crack_tip_plane_project_particle(&cracks->plane, p, it.bond.nbr, Y);
        for (int w = 0; w < segments->n; w++) cut |= crack_cuts_bond(&segments->crack[w], X, Y, 2);
        if (!cut) continue;
        const struct broken_bond record = broken_bond_make_record(b, p, &cracks->source->limit, &it.bond, r);
        break_list_add(list, &record);
    }
}

/* Lists in `segments` the segment from[2] .. to[2] of the crack path of `tip`, extended by BEYOND spacings ahead, and
 * its mirror images. Coordinates are those in the plane in which the tips of `cracks` move [m]. Release the list with
 * crack_list_free. */
static void segment_images(const struct sif_cracks *cracks, const struct sif_crack_tip *tip, const real from[2],
                           const real to[2], struct crack_list *segments)
{
    real corner[2][DIM_MAX] = {{0}};
    const real beyond = BEYOND * cracks->plane.spacing;
    for (int d = 0; d < 2; d++)
        corner[tip->reversed][d] = from[d], corner[!tip->reversed][d] = to[d] + beyond * tip->heading[d];
    const struct crack path = {.n = 2, .corner = corner};
    cracks_make_mirror_images(segments, &path, 1, cracks->plane.mirror, cracks->plane.mirrors,
                              cracks->source->family.cutoff, ON_SURFACE * cracks->plane.spacing);
}

/* Sets the energy cost [J] of each bond in `list`, the bonds that the next segment of the crack path of `tip` (a tip of
 * `cracks`) crosses; it is the member `held` of the record of the bond. The costs are scaled such that their sum is the
 * area of the segment times the crack energy per area of the material: in 3D, energies of bonds at the sides of the
 * body contain surface weights, and some bonds at a pre-crack are already broken. In state-based models, where bonds
 * have no energy of their own, all costs are equal. p: particles. */
static void segment_cost_set(const struct sif_cracks *cracks, const struct particles *p,
                             const struct sif_crack_tip *tip, struct break_list *list)
{
    const bool state_based = cracks->scene->model != MODEL_BOND;
    real to[2], sum = 0;
    sif_tip_compute_end_of_next_increment(cracks, p, tip, to);
    const real whole =
        crack_tip_plane_crack_area(&cracks->plane, p, tip->position, to) * sif_tip_toughness(cracks, p, tip);
    for (int64_t k = 0; k < list->n; k++) sum += list->bond[k].held;
    for (int64_t k = 0; k < list->n; k++)
        list->bond[k].held = state_based ? whole / (real)list->n : list->bond[k].held * whole / sum;
}

/* Appends to `list` the bonds of b that cross the next segment of the path of `tip`, one of the tips of l. Returns
 * their total energy cost [J]. p: particles. */
static real segment_bonds(const struct sif_cracks *cracks, const struct bonds *b, const struct particles *p,
                          const struct sif_crack_tip *tip, struct break_list *list)
{
    struct crack_list segments;
    real cost = 0, to[2];
    sif_tip_compute_end_of_next_increment(cracks, p, tip, to);
    segment_images(cracks, tip, tip->position, to, &segments);
    for (int64_t r = 0; r < b->rows; r++) row_bonds_cut(cracks, b, p, r, &segments, list);
    crack_list_free(&segments);
    if (cracks->scene->model != MODEL_BOND || p->dim == 3) segment_cost_set(cracks, p, tip, list);
    for (int64_t k = 0; k < list->n; k++) cost += list->bond[k].held;
    return cost;
}

void sif_tip_break_bonds_across_precrack_behind(struct run *run, const struct sif_crack_tip *tip)
{
    const struct sif_cracks *cracks = &run->statics->sif;
    const real length = real_min(tip->length_behind, run->source.family.cutoff + 2 * run->scene->spacing);
    struct break_list list = {0};
    struct crack_list segments;
    real from[2];
    for (int d = 0; d < 2; d++) from[d] = tip->position[d] - length * tip->along[d];
    segment_images(cracks, tip, from, tip->position, &segments);
    for (int64_t r = 0; r < run->bonds.rows; r++) row_bonds_cut(cracks, &run->bonds, &run->part, r, &segments, &list);
    crack_list_free(&segments);
    for (int64_t k = 0; k < list.n; k++) list.bond[k].held = 0;
    bonds_break_listed(run, &list);
    memory_free(list.bond);
}

/* ---- trials ------------------------------------------------------------------------------------------------------ */

/* Marks the material points of p within a horizon of the next segment of the path of `tip` (a tip of `cracks`) for
 * conversion to peridynamic particles, since only bonds can break. Returns the number of points marked. */
static int64_t segment_convert(const struct sif_cracks *cracks, struct particles *p, const struct sif_crack_tip *tip)
{
    real to[DIM_MAX] = {0}, from[DIM_MAX] = {tip->position[0], tip->position[1]};
    int64_t marked = 0;
    sif_tip_compute_end_of_next_increment(cracks, p, tip, to);
    for (int64_t i = 0; i < p->n; i++) {
        real X[DIM_MAX] = {0};
        if (p->kind[i] != KIND_MPM || p->body[i] != tip->body) continue;
        crack_tip_plane_project_particle(&cracks->plane, p, i, X);
        if (segment_distance_from_point(from, to, X, 2) > cracks->source->family.cutoff) continue;
        p->flag[i] |= FLAG_LOST_BOND;
        marked++;
    }
    return marked;
}

/* Determines the direction of growth of all SIF-driven tips of the run that can grow, and converts the material points
 * within a horizon of their next path segments to peridynamic particles. Since converted points change the equilibrium,
 * both are repeated until none is converted, at most CONVERSIONS_MOST times. Returns FAILED, with a message, if an
 * equilibrium is not found. */
static status tips_turn_all(struct run *run)
{
    struct sif_cracks *cracks = &run->statics->sif;
    int64_t marked = 1;
    for (int round = 0; round < CONVERSIONS_MOST && marked > 0; round++) {
        const bool closed = crack_faces_are_in_contact(run->contact);
        marked = 0;
        for (int k = 0; k < cracks->n; k++)
            if (!cracks->tip[k].ended)
                sif_tip_compute_growth_direction(cracks, &run->part, closed, &cracks->tip[k]),
                    marked += segment_convert(cracks, &run->part, &cracks->tip[k]);
        if (marked > 0) TRY(equilibrium_convert_points_to_pd_and_solve_again(run, 0));
    }
    return OK;
}

/* Breaks the bonds of list l in the run and finds the equilibrium at the present pseudo-time. Stores in a->release the
 * energy that the body releases, divided by the square of the load size (norm of prescribed displacements [m] or of
 * applied forces [N]). Returns FAILED, with a message, if there is no equilibrium. */
static status list_break_try(struct run *run, const struct break_list *l, struct crack_increment *a)
{
    const real before = statics_energy_released_since_start(run->statics, &run->bonds);
    bonds_break_listed(run, l);
    const status tried = equilibrium_find_at_time(run, run->statics->t);
    a->release = (statics_energy_released_since_start(run->statics, &run->bonds) - before) /
                 square(statics_norm_of_prescribed_loads(run, run->statics->t));
    return tried;
}

/* Estimates tip->behind (cost and energy release of the previous crack increment) for a tip of the run at the end of a
 * pre-crack, which has not grown yet, as if an increment had led there. It is extrapolated backwards from the first
 * increment tip->ahead, whose bonds must be broken already, and from a trial of a second one straight ahead. Returns
 * FAILED, with a message, if an equilibrium is not found. */
static status behind_first_set(struct run *run, struct sif_crack_tip *tip)
{
    struct sif_crack_tip beyond = *tip;
    struct break_list list = {0};
    struct crack_increment second = {0};
    status tried = OK;
    sif_tip_compute_end_of_next_increment(&run->statics->sif, &run->part, tip, beyond.position);
    second.cost = segment_bonds(&run->statics->sif, &run->bonds, &run->part, &beyond, &list);
    if (list.n > 0) {
        tried = list_break_try(run, &list, &second);
        bonds_restore_broken(run->statics, &run->bonds, &run->part, &list);
        tip->behind = crack_increment_extrapolate_predecessor_of_first(&tip->ahead, &second);
    }
    memory_free(list.bond);
    return tried;
}

/* Computes tip->ahead.release, the energy that the next increment of `tip` in the run releases divided by the square of
 * the load size (norm of prescribed displacements or forces), by a trial in which the bonds in list l break and which
 * is then undone. For the first increment of the tip also estimates tip->behind, a fictitious increment before it.
 * Returns FAILED, with a message, if an equilibrium is not found. */
static status segment_try(struct run *run, struct sif_crack_tip *tip, const struct break_list *l)
{
    struct memory_archive saved;
    trial_equilibrium_begin(run, &saved);
    status tried = list_break_try(run, l, &tip->ahead);
    if (tried == OK && tip->grown == 0) tried = behind_first_set(run, tip);
    trial_equilibrium_end(run, &saved, false, l);
    return tried;
}

/* Returns true if list l contains the directed bond of *record: a record with the same row and entry in the bond
 * arrays. */
static bool list_has(const struct break_list *l, const struct broken_bond *record)
{
    for (int64_t k = 0; k < l->n; k++)
        if (l->bond[k].row == record->row && l->bond[k].entry == record->entry) return true;
    return false;
}

/* Selects the tips that grow in the next crack increment: the tip with the smallest load size (norm of prescribed
 * displacements or forces) tip->due at which it grows, and those whose load sizes are larger by at most the fraction
 * TOGETHER. Combines their bonds in s->next, and the costs and energy releases of their increments in s->ahead and
 * s->behind. Computes s->due, the load size of the combined increment. list[k]: bonds of the next segment of tip k. */
static void increment_choose(struct statics *s, struct break_list *list)
{
    struct sif_cracks *cracks = &s->sif;
    real first = INFINITY;
    s->ahead = s->behind = (struct crack_increment){0};
    for (int k = 0; k < cracks->n; k++) first = real_min(first, cracks->tip[k].due);
    for (int k = 0; k < cracks->n; k++) {
        struct sif_crack_tip *tip = &cracks->tip[k];
        tip->selected = isfinite(tip->due) && tip->due <= first * (1 + TOGETHER);
        if (!tip->selected) continue;
        for (int64_t q = 0; q < list[k].n; q++)
            if (!list_has(&s->next, &list[k].bond[q])) break_list_add(&s->next, &list[k].bond[q]);
        s->ahead.cost += tip->ahead.cost, s->ahead.release += tip->ahead.release;
        s->behind.cost += tip->behind.cost, s->behind.release += tip->behind.release;
    }
    s->due = two_crack_increments_load_size_at_energy_balance(&s->ahead, &s->behind);
}

/* If several tips of the run are selected for the next crack increment, recomputes its energy release s->ahead.release
 * by a trial in which all their bonds break together, which releases more energy than one tip after the other. Divides
 * the result among the tips in proportion to their separate values, and updates s->due, the load size of the increment.
 * If a tip makes its first increment, s->due is not updated, since the fictitious previous increments were not computed
 * in this way. Returns FAILED, with a message, if an equilibrium is not found. */
static status increment_try_together(struct run *run)
{
    struct statics *s = run->statics;
    struct memory_archive saved;
    const real separate = s->ahead.release;
    int selected = 0;
    bool grown = true;
    for (int k = 0; k < s->sif.n; k++)
        if (s->sif.tip[k].selected) selected++, grown = grown && s->sif.tip[k].grown > 0;
    if (selected < 2) return OK;
    trial_equilibrium_begin(run, &saved);
    const status tried = list_break_try(run, &s->next, &s->ahead);
    trial_equilibrium_end(run, &saved, false, &s->next);
    for (int k = 0; k < s->sif.n && separate > 0; k++)
        if (s->sif.tip[k].selected) s->sif.tip[k].ahead.release *= s->ahead.release / separate;
    if (grown) s->due = two_crack_increments_load_size_at_energy_balance(&s->ahead, &s->behind);
    return tried;
}

/* Computes the next increment of `tip` in the run: its bonds, which are appended to `list`; its cost and energy
 * release, tip->ahead; and tip->due, the load size (norm of prescribed displacements or forces) at which it is made.
 * tip->due is INFINITY if the tip does not grow: under compression (K_I < 0), or if there are no bonds ahead of it, so
 * that it has ended. Returns FAILED, with a message, if an equilibrium is not found. */
static status tip_try(struct run *run, struct sif_crack_tip *tip, struct break_list *list)
{
    tip->ahead = (struct crack_increment){0}, tip->due = INFINITY;
    if (tip->ended || !(tip->K[0] >= 0)) return OK;
    tip->ahead.cost = segment_bonds(&run->statics->sif, &run->bonds, &run->part, tip, list);
    tip->ended = list->n == 0;
    if (tip->ended) return OK;
    TRY(segment_try(run, tip, list));
    tip->due = two_crack_increments_load_size_at_energy_balance(&tip->ahead, &tip->behind);
    return OK;
}

status sif_cracks_find_increment_by_trial_equilibria(struct run *run)
{
    struct statics *s = run->statics;
    struct break_list list[SIF_TIPS_MAX] = {{0}};
    status tried = OK;
    const real size = statics_norm_of_prescribed_loads(run, s->t);
    if (s->stretch_ratio < STRESSED || (s->next.n > 0 && (size >= s->due || size < AGAIN * s->sif.tried))) return OK;
    s->sif.tried = size;
    TRY(tips_turn_all(run));
    for (int k = 0; k < s->sif.n && tried == OK; k++) tried = tip_try(run, &s->sif.tip[k], &list[k]);
    s->next.n = 0;
    if (tried == OK) increment_choose(run->statics, list);
    if (tried == OK) tried = increment_try_together(run);
    for (int k = 0; k < s->sif.n; k++) memory_free(list[k].bond);
    return tried;
}

void sif_tips_move_those_in_crack_increment(struct sif_cracks *cracks, const struct particles *p)
{
    for (int k = 0; k < cracks->n; k++) {
        struct sif_crack_tip *tip = &cracks->tip[k];
        tip->behind = tip->selected ? tip->ahead : (struct crack_increment){0};
        if (tip->selected) sif_tip_move_to_end_of_increment(cracks, p, k);
        tip->selected = false;
    }
}
