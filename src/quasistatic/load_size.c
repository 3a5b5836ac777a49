/* Computes the load size, a scalar measure of the loads (norm of prescribed displacements or of applied forces). Also
 * computes the load size at which crack increments release as much energy as they cost. */
#include <math.h>

#include "load_size.h"

#include "rigid/rigid_part.h"

/* ---- load size --------------------------------------------------------------------------------------------------- */

/* Returns the sum of the squared displacements [m^2] of the first n rigid bodies of r from the start to pseudo-time t
 * [s]. */
static real rigid_displacement2(const struct rigid_set *r, int n, real t)
{
    real sum = 0, shift[DIM_MAX];
    for (int k = 0; k < n; k++) sum += square(rigid_compute_prescribed_displacement(&r->body[k], t, shift));
    return sum;
}

/* Returns the load size of the run at pseudo-time t [s], a measure proportional to the loads: the norm of the
 * prescribed displacements of supports and rigid bodies [m], or, if these do not move, the norm of the applied forces
 * [N]. */
real statics_norm_of_prescribed_loads(const struct run *run, real t)
{
    real sum = 0, forces = 0;
    for (int b = 0; b < run->loads.n; b++) {
        const struct load *l = &run->loads.load[b];
        const struct prescribed_displacement by =
            boundary_prescribed_displacement_at_time(l->boundary, run->part.dim, t);
        for (int64_t k = 0; k < l->n; k++) {
            real X[DIM_MAX], f[DIM_MAX];
            particle_reference_position(&run->part, l->particle[k], X);
            for (int d = 0; d < run->part.dim && l->boundary->kind == BOUNDARY_VELOCITY; d++)
                if (l->prescribes[k] >> d & 1) sum += square(prescribed_displacement_component_at_position(&by, X, d));
            if (!boundary_applies_force(l->boundary)) continue;
            load_force_on_particle(l, &run->part, k, t, f);
            forces += dot(f, f, run->part.dim);
        }
    }
    sum += rigid_displacement2(run->rigid, run->scene->rigids, t);
    return sqrt(sum > 0 ? sum : forces);
}

enum { SECANTS_MOST = 30 }; /* largest number of secant steps */

real statics_find_pseudo_time_at_load_size(const struct run *run, real load_size)
{
    real from = run->statics->t, at_from = statics_norm_of_prescribed_loads(run, from);
    real t = at_from > 0 ? from * load_size / at_from : from;
    for (int k = 0; k < SECANTS_MOST; k++) {
        const real at = statics_norm_of_prescribed_loads(run, t), slope = (at - at_from) / (t - from);
        if (fabs(at - load_size) <= 1e-9 * load_size || !(slope != 0) || t == from) return t;
        from = t, at_from = at;
        t = real_max(0, from + (load_size - at) / slope);
    }
    return t;
}

/* ---- crack increments -------------------------------------------------------------------------------------------- */

/* Returns the energy released since the start [J]: the fracture energy of the broken bonds of b plus s->balance.lost,
 * the energy lost in solutions. */
real statics_energy_released_since_start(const struct statics *s, const struct bonds *b)
{
    return bonds_fracture_energy(b) + s->balance.lost;
}

real two_crack_increments_load_size_at_energy_balance(const struct crack_increment *increment,
                                                      const struct crack_increment *other_increment)
{
    const real release = increment->release + other_increment->release;
    return increment->cost > 0 && release > 0 ? sqrt((increment->cost + other_increment->cost) / release) : INFINITY;
}

real crack_increment_load_size_at_energy_balance(const struct crack_increment *increment)
{
    return two_crack_increments_load_size_at_energy_balance(increment, &(struct crack_increment){0});
}

struct crack_increment crack_increment_extrapolate_predecessor_of_first(const struct crack_increment *first,
                                                                        const struct crack_increment *second)
{
    const real rate = first->release / first->cost, growth = second->release / second->cost - rate;
    const real release = first->release - 2 * growth * square(first->cost) / (first->cost + second->cost);
    return (struct crack_increment){first->cost, real_max(0, release)};
}
