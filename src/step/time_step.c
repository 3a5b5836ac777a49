/* Computes the critical time step of an input file (scene), and chooses the time step.
 *
 * `bench stability` measures the limits independently, from the growth of the largest mode under the step itself. */
#include <math.h>

#include "step/stability.h"
#include "grid/grid_part.h"
#include "contact/contact.h"
#include "run/critical_step.h"
#include "mesh/mesh_part.h"
#include "step/viscosity.h"

/* ---- material points --------------------------------------------------------------------------------------------- */

/* Returns true if cells of the grid have about two points per direction (s->cell from 1.7 to 2.3). */
static bool two_per_cell(const struct scene *s) { return fabs(s->cell - 2) < 0.3; }

/* Returns the critical time step of material points on a grid, divided by h/(c + |v|) [1], with the node distance h,
 * the wave speed c and the speed v of the points. s: scene, for shape functions, transfer scheme and points per cell.
 * The values are slightly below the smallest limits that were measured over all positions of points within their cells,
 * because a moving body passes through all of them. With FLIP the limit hardly depends on n, the number of points per
 * cell and direction; with APIC it does. With linear shape functions the smallest limit is that of points exactly on
 * nodes, where round-off decides to which cell they belong; elsewhere it is three times as large. */
static real points_share(const struct scene *s)
{
    const real n = s->cell;
    const bool apic = s->transfer == TRANSFER_APIC;
    switch (s->shape) {
    case SHAPE_LINEAR:
        if (n < 1.5) return s->dim == 1 ? 0.48 : 0.42;
        return (two_per_cell(s) ? 0.52 : 0.62) * (1 + 0.4 * (s->dim - 1));
    case SHAPE_QUADRATIC:
        return apic ? 0.75 : 1.8;
    case SHAPE_CUBIC:
        return apic ? 1.15 : 2.1;
    default:
        return apic ? (s->dim == 1 ? 0.89 : 0.84) / (1 + 0.16 * n) : 1.52;
    }
}

/* Returns a factor on the critical time step of material points that accounts for nearly incompressible materials [1].
 * tables: elastic constants of the materials of the scene s. The stiffness c11 + (dim - 1) c12 acts on neighbouring
 * nodes that move against each other in all directions, only c11 on a plane wave; r is the ratio of the first to the
 * second. The limits of points_share were measured for r up to 5/3, so the factor is sqrt((5/3)/r), at most 1.
 * (Measured in 3D from nu = 0.25 to 0.499: limits fall to 0.76 to 0.80, the factor to 0.75.) The factor is 1 for linear
 * shape functions with two points per cell and direction, whose limit does not depend on r. */
static real volume_share(const struct scene *s, const struct material_tables *tables)
{
    const real observed = 5.0 / 3;
    real most = observed;
    if (two_per_cell(s) && s->shape == SHAPE_LINEAR) return 1;
    for (int m = 0; m < s->materials; m++)
        most = real_max(most, 1 + (s->dim - 1) * tables->elastic[m].c12 / tables->elastic[m].c11);
    return sqrt(observed / most);
}

/* Returns the largest speed expected in the run [m/s]: the maximum of `speed`, the largest speed of the particles p at
 * the start, and of the speeds that boundary conditions (loads l) prescribe. */
static real fastest_driven(const struct scene *s, const struct loads *l, const struct particles *p, real speed)
{
    for (int b = 0; b < s->boundaries; b++)
        if (s->boundary[b].displaces && s->solver == SOLVER_EXPLICIT)
            speed = real_max(speed, load_largest_speed_of_prescribed_displacement(&l->load[b], p, s->duration));
        else if (s->boundary[b].kind == BOUNDARY_VELOCITY && !s->boundary[b].displaces)
            speed = real_max(speed, sqrt(dot(s->boundary[b].value, s->boundary[b].value, s->dim)));
    return speed;
}

/* Returns the critical time step of material points on a grid [s]. tables: wave speed and elastic constants; h: node
 * distance [m]; speed: largest speed of the points [m/s]. */
static real critical_of_points(const struct scene *s, const struct material_tables *tables, real h, real speed)
{
    return points_share(s) * volume_share(s, tables) * h / (tables->wave_speed + speed);
}

/* ---- bonds ------------------------------------------------------------------------------------------------------- */

/* Factors on the critical time step of bonds if a grid moves all particles (couplings pmg, pgg) and does not resolve
 * the shortest waves of the bonds: [0][dim] for cells of one spacing, [1][dim] for two. Limits measured by `bench
 * stability`. */
static const real moved_by_grid[2][DIM_MAX + 1] = {{1, 1, 1, 1.5}, {1, 1.4, 1.4, 2.5}};
/* Factors on the critical time step of bonds if a grid moves particles near material points (couplings pm, pg) and FLIP
 * retains motion that the grid does not resolve: [0][dim] for cells of one spacing, [1][dim] for two. Measured where
 * few particles share a node, the worst case. */
static const real met_by_grid[2][DIM_MAX + 1] = {{1, 1, 1, 0.62}, {1, 0.86, 0.81, 1}};

/* Returns the factor on the critical time step of bonds for a coupling method [1]. It differs from 1 if the grid moves
 * peridynamic particles: it is larger where the grid does not resolve the shortest waves of the bonds, and smaller
 * where FLIP retains motion that the grid does not resolve. s: scene, with cell size and dimension. */
static real share_of_coupling(const struct scene *s, enum coupling coupling)
{
    const bool two = s->cell >= 2;
    if (coupling_moves_all_particles_by_one_grid(coupling)) return moved_by_grid[two][s->dim];
    return coupling_moves_pd_particles_by_grid(coupling) && s->transfer == TRANSFER_FLIP ? met_by_grid[two][s->dim] : 1;
}

/* Returns the force function of elastic bonds, with which the critical time step of the bonds of the scene s is
 * computed. It serves yielding bonds, too, which are not stiffer than elastic ones. kernels: function of the scene's
 * model, used for state-based ones. */
static bond_force_fn *elastic_force(const struct scene *s, const struct kernels *kernels)
{
    return s->model == MODEL_BOND ? bond_force_table[s->dim][PD_BOND] : kernels->bond_force;
}

/* Returns the smallest critical time step [s] of infinite lattices, one for each material, with the neighbourhood
 * (neighbours of a particle) and materials of the bond source `all`. p: particles, for the extent of the body; force:
 * force function of the bonds. *bound: receives the smallest of the lower bounds of these time steps [s], which follow
 * from the row sums of the stiffness matrices. */
static real critical_of_lattices(const struct bond_source *all, const struct particles *p, bond_force_fn *force,
                                 real *bound)
{
    real step = INFINITY, longest[DIM_MAX], low, high;
    *bound = INFINITY;
    for (int d = 0; d < p->dim; d++) {
        particles_coordinate_range(p, p->n, d, &low, &high);
        longest[d] = high - low;
    }
    for (int m = 0; m < all->materials; m++) {
        real its_bound;
        struct bond_source one = *all; /* all particles of the lattice are of material 0 */
        one.material = &all->material[m], one.materials = 1;
        if (all->modulus) one.modulus = &all->modulus[m];
        one.yield = (struct bond_yield){0};
        step = real_min(step, lattice_critical_time_step(&one, force, all->material[m].density, longest, &its_bound));
        *bound = real_min(*bound, its_bound);
    }
    return step;
}

/* Largest number of particles for which the highest frequency of the whole body is found by iteration, because of its
 * cost: about 30 rounds, each as expensive as a few time steps. */
enum { ITERATED_MOST = 15000 };

/* Returns the critical time step of the bonds of the run [s]. Returns INFINITY for the method mpm, which has no
 * bonds, and the time in which a wave crosses one spacing for a peridynamic body without bonds. With method pd, for a
 * body of at most ITERATED_MOST particles or with randomly shifted positions, the step follows from the highest
 * frequency of the body, found by iteration. Otherwise it follows from the highest frequency of an infinite lattice.
 * Scattered particles, bonds near surfaces and heavy neighbours can make the body stiffer than this lattice. Therefore
 * the step is multiplied by the ratio of two bounds from row sums of stiffness matrices, that of the body to that of
 * the lattice, if this is below 1. */
static real critical_of_bonds(struct run *run)
{
    const struct scene *s = run->scene;
    bond_force_fn *const force = elastic_force(s, &run->kernels);
    real bound;
    if (s->method == METHOD_MPM) return INFINITY;
    if (s->method == METHOD_PD && (s->irregularity > 0 || run->part.n <= ITERATED_MOST)) {
        const real step =
            bonds_critical_time_step_by_iteration(&run->bonds, &run->part, force, &run->loads, s->spacing);
        /* without bonds the wave speed limits the step */
        return isfinite(step) ? step : s->spacing / run->tables.wave_speed;
    }
    const real step = critical_of_lattices(&run->source, &run->part, force, &bound);
    const real share = real_min(1, bonds_critical_time_step_if_all_peridynamic(&run->part, &run->source) / bound);
    return share * step * share_of_coupling(run->scene, run->coupling_kind);
}

/* ---- the step ---------------------------------------------------------------------------------------------------- */

#define STEPS_MOST 1e12 /* limit of scene_check.c */

/* Sets the number of steps, clock->steps, and the time step clock->dt, at most `dt` [s], so that whole steps fill the
 * duration of the scene s; their number is a multiple of clock->stride. Returns REFUSED, with a message, for more than
 * STEPS_MOST steps. */
static status make_steps(const struct scene *s, struct run_clock *clock, real dt)
{
    if (!(s->duration / dt <= STEPS_MOST))
        return status_set(
            REFUSED,
            "duration: %.4g s needs %.1e steps of %.4g s, more than the limit of 1e12; check the duration and its unit",
            s->duration, s->duration / dt, dt);
    clock->steps = (int64_t)ceil(s->duration / dt * (1 - 1e-12)); /* the factor keeps round-off from adding a step */
    if (clock->steps < 1) clock->steps = 1;
    clock->steps += (clock->stride - clock->steps % clock->stride) % clock->stride;
    clock->dt = s->duration / (real)clock->steps;
    return OK;
}

/* Returns the largest admissible ratio of the time step to the critical time step of contact [1]. Contact that begins
 * or ends within a step changes the energy by up to k u^2/2, with the contact stiffness k and the displacement u in the
 * step. The values keep this change to about 0.1 % per collision: bars in 2D changed by 0.3 % at 0.8 and 0.1 % at 0.5;
 * bars in 1D, whose faces meet in a single step, by 1 % at 0.8 and 0.1 % at 0.35. Faces of a crack approach slowly, so
 * their value is 0.7, or INFINITY (no limit) if the safety factor of the scene s is above 1. */
static real contact_safety(const struct scene *s)
{
    if (!scene_bodies_can_come_into_contact(s)) return s->safety > 1 ? INFINITY : 0.7;
    return real_min(s->safety, s->dim == 1 ? 0.35 : 0.5);
}

/* Returns the largest time step [s] for which motion against bulk damping of rate c is within 1 % of c v = f/m
 * (damping.c): c dt <= 0.5. Returns INFINITY without damping. It is a limit of accuracy, not of stability. */
static real damping_step(const struct scene *s) { return s->damping > 0 ? 0.5 / s->damping : INFINITY; }

/* Returns the stiffness of the repulsive cores of bonds that the time step allows, (dt_critical/dt)^2 - 1, from 0 to
 * CORE_STIFFNESS [1]. A core resists strong compression of a bond (kernels/pd/bond_core.h). scene: static ones get
 * CORE_STIFFNESS; clock: time step and critical time step. */
static real core_stiffness(const struct scene *scene, const struct run_clock *clock)
{
    if (!scene_is_dynamic(scene)) return CORE_STIFFNESS;
    return real_max(0, real_min(CORE_STIFFNESS, square(clock->dt_critical / clock->dt) - 1));
}

/* Returns the smallest ratio of a particle's mass to density times volume over all particles p, at most 1 [1]. Only
 * particle lists with a column of masses can make it less than 1. */
static real lightest_share(const struct scene *s, const struct particles *p)
{
    real least = 1;
    bool own = false;
    for (int b = 0; b < s->bodies; b++) own |= s->body[b].list.mass;
    for (int64_t i = 0; i < p->n && own; i++)
        least = real_min(least, p->mass[i] / (s->material[p->material[i]].density * p->volume0[i]));
    return least;
}

/* Computes the critical time step, the time step and the number of steps of the run, in run->clock. In load steps,
 * their number is that of the scene. The limits of all methods of the scene apply from the start, because particles
 * convert later. Returns REFUSED, with a message, if the prescribed step is too large for coarse cells, or the steps
 * are too many. */
status run_choose_time_step_and_step_count(struct run *run)
{
    const struct scene *s = run->scene;
    const bool on_grid = run->part.n_free + run->part.n_grid_coupled > 0;
    real points = INFINITY;
    if (on_grid)
        points = critical_of_points(s, &run->tables, run->grid->field[0].grid.h,
                                    fastest_driven(s, &run->loads, &run->part, run->stability->start_speed));
    run->clock.dt_critical = real_min(real_min(critical_of_bonds(run), points),
                                      lagrangian_mesh_critical_time_step(run->frame, s, run->coupling_kind)) *
                             sqrt(lightest_share(s, &run->part)) *
                             bulk_viscosity_time_step_factor(s, &run->loads, &run->part, run->stability->start_speed);
    const real contact = contact_critical_time_step(run->contact, &run->part, s->material, run->clock.dt_critical);
    const int levels = mesh_levels_choose_level_count(run->frame, &run->part, s, run->clock.dt_critical).levels;
    const real safety = levels > 0 ? real_min(s->safety, LEVELS_STEP_MOST) : s->safety;
    const real automatic =
        real_min(damping_step(s), real_min(safety * run->clock.dt_critical, contact_safety(s) * contact));
    const real dt = s->time_step > 0 ? s->time_step : automatic;
    run->clock.stride = 1 << levels;
    if (run->clock.stride > 1 && dt > LEVELS_STEP_MOST * run->clock.dt_critical * (1 + 1e-9))
        return status_set(REFUSED,
                          "time.step: %.4g s is too large for coarse cells (mpm.levels above 0), which are stable up "
                          "to %.4g s (%.2f of the critical step); use a smaller time.step, or set mpm.levels: 0",
                          dt, LEVELS_STEP_MOST * run->clock.dt_critical, LEVELS_STEP_MOST);
    run->clock.dt_bears = dt;
    if (scene_has_load_steps(s))
        run->clock.steps = s->steps.number, run->clock.dt = s->duration / s->steps.number;
    else if (scene_is_dynamic(s))
        TRY(make_steps(run->scene, &run->clock, dt));
    else
        run->clock.steps = s->solver_steps, run->clock.dt = dt;
    run->source.limit.dt = scene_has_load_steps(s) ? dt : run->clock.dt;
    run->source.core = run->bonds.core = core_stiffness(run->scene, &run->clock);
    return OK;
}
