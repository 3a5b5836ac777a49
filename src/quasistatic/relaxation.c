/* Finds static equilibria of bodies with material points by dynamic relaxation: time steps on the grid in which the
 * loads grow and then stay constant, with velocities damped near the critical damping of the lowest mode of the
 * body. */
#include <math.h>

#include "relaxation.h"
#include "grid/grid_part.h"
#include "coupling/coupling_part.h"
#include "solver/solver.h"
#include "run/energies.h"
#include "step/step.h"
#include "step/checks.h"
#include "loads/mirrors.h"

#define ESTIMATE_STEPS 10 /* steps between estimates of damping and residual */
#define MOTION_SMALL 1e-6 /* ratio of kinetic to strain energy of a body at rest */

real grid_relaxation_load_ramp_time(real body_length, real wave_speed, real time_step)
{
    return ceil(2 * body_length / (wave_speed * time_step)) * time_step;
}

/* Adds the sums of m u^2 [kg m^2] and m v^2 [J] of particles first .. end - 1, with their masses m, displacements u and
 * velocities v, to sum[0] and sum[1]. context: the particles (struct particles). reproducible_sums calls it for each
 * block of particles. */
static void motion_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct particles *p = context;
    for (int d = 0; d < p->dim; d++)
        for (int64_t i = first; i < end; i++) {
            sum[0] += p->mass[i] * square(p->x[d][i] - p->X[d][i]);
            sum[1] += p->mass[i] * square(p->v[d][i]);
        }
}

/* Adds the squares of the forces that accelerate grid nodes first .. end - 1 to sum[0] [N^2], for the residual.
 * context: the grid method (struct grid_method). reproducible_sums calls it for each block of nodes. */
static void node_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct grid_method *mpm = context;
    const struct grid *g = &mpm->field[0].grid;
    for (int d = 0; d < g->dim; d++)
        for (int64_t I = first; I < end; I++) sum[0] += square(g->mass[I] * g->force[d][I] / mpm->transfer.dt_velocity);
}

/* Adds the squared forces on particles first .. end - 1 to sum[0] [N^2], for the residual; particles that move with
 * grid nodes are left out. context: the particles (struct particles). reproducible_sums calls it for each block of
 * particles. */
static void particle_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct particles *p = context;
    for (int64_t i = first; i < end; i++)
        for (int d = 0; d < p->dim && !particle_is_moved_by_grid_or_mesh_nodes(p, i); d++) sum[0] += square(p->f[d][i]);
}

/* Returns the norm of the reactions of all supports in `loads`, each reaction divided evenly among the particles of its
 * support [N]. It scales the residual. dim: number of components. */
static real reactions_norm(const struct loads *loads, int dim)
{
    real sum = 0;
    for (int b = 0; b < loads->n; b++) {
        const struct load *l = &loads->load[b];
        if (l->boundary->kind == BOUNDARY_VELOCITY)
            sum += dot(l->reaction, l->reaction, dim) / (l->n > 0 ? (real)l->n : 1);
    }
    return sqrt(sum);
}

/* Updates damping and residual of the dynamic relaxation of the run. The damping rate is the critical one, 2 omega, of
 * the lowest mode. This mode resembles the displacement u, so that omega^2 = 2 U/sum m u^2 (Rayleigh quotient) with the
 * strain energy U; per time step it is at most 1. *done: set to true at equilibrium, else to false. */
static void estimate(struct run *run, bool *done)
{
    struct static_solver *s = run->solver;
    real nodes = 0, particles, motion[2];
    const real strain = run->kernels.bond_energy(&run->bonds, &run->part, NULL) +
                        points_strain_energy(&run->part, run->scene->material, &run->coupling->partial);
    reproducible_sums(run->part.n, 2, motion_block, &run->part, motion);
    s->damping = motion[0] > 0 ? real_min(2 * sqrt(2 * strain / motion[0]) * run->clock.dt, 1) : 0;
    if (run->part.n_of[KIND_MPM] + run->part.n_grid_coupled > 0)
        reproducible_sums(run->grid->field[0].grid.n, 1, node_block, run->grid, &nodes);
    reproducible_sums(run->part.n, 1, particle_block, &run->part, &particles);
    static_solver_compute_relative_residual(s, reactions_norm(&run->loads, run->part.dim), sqrt(nodes + particles));
    *done = run->clock.t > s->ramp_time * (1 + 1e-9) && s->residual <= run->scene->solver_tolerance &&
            0.5 * motion[1] <= MOTION_SMALL * strain;
}

/* Damps the velocities of particles p, and the velocity gradients that APIC keeps, over a time step by the factor (2 -
 * damping)/(2 + damping). loads: its mirror images are then updated; gradients: number of components of a velocity
 * gradient, 0 without APIC; damping: damping rate times time step, dimensionless. */
static void damp_velocities(struct particles *p, const struct loads *loads, int gradients, real damping)
{
    const real keep = (2 - damping) / (2 + damping);
    for (int d = 0; d < p->dim; d++) {
#pragma omp parallel for schedule(static)
        for (int64_t i = 0; i < p->n; i++) p->v[d][i] *= keep;
    }
    for (int k = 0; k < gradients; k++) {
#pragma omp parallel for schedule(static)
        for (int64_t i = 0; i < p->n; i++) p->gradient[k][i] *= keep;
    }
    loads_update_mirror_images_of_particles(loads, p);
}

status grid_relaxation_step(struct run *run, bool *is_in_equilibrium)
{
    TRY(run_advance_by_one_time_step(run));
    TRY(run_check_stability_after_step(run));
    if (run->clock.step % ESTIMATE_STEPS == 0) estimate(run, is_in_equilibrium);
    damp_velocities(&run->part, &run->loads, run->optional & WITH_GRADIENT ? run->part.dim * run->part.dim : 0,
                    run->solver->damping);
    return OK;
}
