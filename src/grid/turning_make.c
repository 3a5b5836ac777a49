/* Sets up the groups of points with a common rotation that the FLIP transfer uses (data/turning.h). */
#include <math.h>

#include "base/memory.h"
#include "grid/grid_part.h"
#include "data/turning.h"

/* Returns the lowest number of the bodies of the scene that share a grid with body number b. If there are several
 * grids, these are the bodies joined to it, else all bodies. */
static int first_of(const struct grid_method *grid, const struct scene *scene, int b)
{
    return grid->fields > 1 ? scene->body[b].joined : 0;
}

/* Finds the bodies of p on which a boundary condition of `loads` prescribes a motion other than a rotation; the points
 * of such bodies do not rotate in groups. For each such body b sets held[one[b]] to true. one[b]: lowest number of the
 * bodies that share a grid with body b; held: [bodies], false before. */
static void mark_held(const struct loads *loads, const struct particles *p, const int *one, bool *held)
{
    for (int b = 0; b < loads->n; b++) {
        const struct load *l = &loads->load[b];
        if (l->boundary->kind != BOUNDARY_VELOCITY || l->boundary->rotates) continue;
        for (int64_t k = 0; k < l->n; k++) held[one[p->body[l->particle[k]]]] = true;
    }
}

void corotating_groups_make_for_flip_transfer(struct grid_method *mpm, const struct particles *p,
                                              const struct loads *loads, const struct scene *s, enum coupling coupling)
{
    if (p->dim < 2 || s->transfer != TRANSFER_FLIP || !scene_is_dynamic(s) || s->method == METHOD_PD ||
        coupling_moves_pd_particles_by_grid(coupling) || coupling_moves_all_particles_by_one_grid(coupling))
        return;
    bool *held = NEW("engine.held", s->bodies, bool), all = true;
    int *one = NEW("engine.one", s->bodies, int);
    real plane[DIM_MAX] = {NAN, NAN, NAN};
    for (int b = 0; b < s->bodies; b++) one[b] = first_of(mpm, s, b);
    mark_held(loads, p, one, held);
    for (int b = 0; b < s->boundaries; b++)
        if (s->boundary[b].kind == BOUNDARY_MIRROR) plane[s->boundary[b].axis] = s->boundary[b].at;
    for (int b = 0; b < s->bodies; b++) all &= held[one[b]];
    if (!all) corotating_groups_make(&mpm->turning, p, s->spacing, plane, one, held, s->bodies);
    for (int c = 0; c < 3; c++) mpm->transfer.turn[c] = mpm->turning.turn[c];
    /* with the second map the hand-shake coupling gains 1e-7 of its energy a step */
    mpm->transfer.second_map = mpm->turning.groups > 0 && coupling != COUPLING_HANDSHAKE;
    memory_free(held), memory_free(one);
}
