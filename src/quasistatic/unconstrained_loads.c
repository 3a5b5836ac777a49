/* Checks in load steps whether the loads on unconstrained fragments are balanced. */
#include <math.h>

#include "unconstrained.h"

/* Largest tolerated fraction of the loads on an unconstrained fragment that is not balanced [1]. It is not 0, because
 * loaded faces of a lattice are uneven; empirical. */
#define UNHELD_MOST 0.05
#define UNHELD_SMALL 0.01 /* share of all loads below which unbalanced loads do not end a run (empirical) */

/* Returns how far the applied forces on fragment f (a piece of the body that can move rigidly without
 * resistance) are from balance [1], 0 to 1. It is the largest ratio, over the free motions, of the |sum| of
 * the force components along a motion to the sum of their absolute values. *size: receives the latter sum of
 * the motion with this ratio [N], 0 if there is none. Motions whose sum of absolute values is at most
 * UNHELD_SMALL times *size so far are ignored. s: applied forces; part: particles. */
static real unbalanced_share(const struct statics *s, const struct particles *part,
                             const struct unconstrained_fragment *f, real *size)
{
    real most = 0;
    *size = 0;
    for (int a = 0; a < f->motions; a++) {
        real sum = 0, all = 0;
        for (int64_t k = 0; k < f->n && f->node[k] < s->particles; k++)
            for (int d = 0; d < part->dim; d++) {
                const real along = f->motion[(k * part->dim + d) * MODES_MOST + a] *
                                   s->applied[d][s->node[f->node[k]]] * s->weight[f->node[k]];
                sum += along, all += fabs(along);
            }
        if (all > 0 && fabs(sum) / all * (all > *size * UNHELD_SMALL) > most) most = fabs(sum) / all, *size = all;
    }
    return most;
}

/* Returns the size of all applied forces, for comparison with *size of unbalanced_share of one fragment: the sum of
 * the absolute values of all components of the forces (from `statics`) on particles `part`, divided by the square root
 * of `nodes`, the number of nodes of the fragment [N]. */
static real applied_sum(const struct particles *part, const struct statics *statics, int64_t nodes)
{
    real sum = 0;
    for (int d = 0; d < part->dim; d++)
        for (int64_t i = 0; i < part->n; i++) sum += fabs(statics->applied[d][i]);
    return sum / sqrt((real)nodes);
}

/* Returns how far the forces on fragment f (a piece of the body that can move rigidly without resistance) are from
 * balance if it contains nodes of the mesh: the largest component of its forces along a free motion, divided by
 * applied_sum; internal forces in equilibrium have no such component. s: unknowns and forces; p: particles with
 * forces. Returns 0 for a fragment without such nodes and without applied forces. */
static real unbalanced_share_of_nodes(const struct statics *s, const struct particles *p,
                                      const struct unconstrained_fragment *f)
{
    real most = 0, nodes = 0, applied = applied_sum(p, s, f->n);
    for (int a = 0; a < f->motions; a++) {
        real sum = 0;
        for (int64_t k = 0; k < f->n; k++)
            for (int d = 0; d < p->dim; d++) {
                const int64_t at = f->node[k], own = s->node[at];
                const real force = at < s->particles ? s->weight[at] * p->f[d][own] : s->mesh->grid.force[d][own];
                sum += f->motion[(k * p->dim + d) * MODES_MOST + a] * force;
                nodes += at >= s->particles;
            }
        most = real_max(most, fabs(sum));
    }
    return nodes > 0 && applied > 0 ? most / applied : 0;
}

status unconstrained_fragments_check_force_balance(const struct statics *s, const struct particles *p,
                                                   bool nodes_are_in_equilibrium, int64_t step)
{
    for (int64_t q = 0; q < s->fragments && s->applied[0]; q++) {
        const struct unconstrained_fragment *f = &s->fragment[q];
        real size;
        real share = unbalanced_share(s, p, f, &size);
        if (size <= UNHELD_SMALL * applied_sum(p, s, f->n)) share = 0;
        if (nodes_are_in_equilibrium) share = real_max(share, unbalanced_share_of_nodes(s, p, f));
        if (share <= UNHELD_MOST) continue;
        return status_set(FAILED,
                          "load step %lld, t = %.6g s: nothing holds %s (%.3g %% of it, around x = %.6g, y = %.6g, z = "
                          "%.6g m): %.0f %% of the loads on it are not balanced; hold it there, balance its loads, or "
                          "use steps.control: energy, which reduces the loads while a crack grows",
                          (long long)step, s->t, f->n == s->balance.n ? "the body" : "a separate part of the body",
                          100 * (real)f->n / (real)s->balance.n, f->middle[0], f->middle[1], f->middle[2], 100 * share);
    }
    return OK;
}
