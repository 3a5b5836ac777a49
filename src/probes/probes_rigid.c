/* Computes the results of RIGID probes: the rotation angle of a body that moves as a rigid body, and quantities that
 * should remain 0 in this motion. */
#include <math.h>

#include "base/memory.h"
#include "probes_parts.h"
#include "base/team.h"

static const real pi = 3.14159265358979323846;

const struct column rigid_figure[RIGID_FIGURES] = {{"angle", "rad"},
                                                   {"stress_max", "Pa"},
                                                   {"shear_max", "Pa"},
                                                   {"angular_momentum_error", ""},
                                                   {"kinetic_energy_error", ""}};

/* Arguments of sums over the particles of probe q (indices in p): their present and reference centre of mass [m]. */
struct rigid_sum {
    const struct probe *q;
    const struct particles *p;
    real centre[2], centre_reference[2];
};

/* Adds to sum[5], over the particles first .. end - 1 of a probe (a requested measurement): mass [kg], mass times
 * present position (x, y) and mass times reference position (x, y) [kg m]. context: a struct rigid_sum.
 * reproducible_sums calls it for each block of particles. */
static void centre_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct rigid_sum *s = context;
    const struct particles *p = s->p;
    for (int64_t k = first; k < end; k++) {
        const int32_t i = s->q->list[k];
        sum[0] += p->mass[i];
        for (int d = 0; d < 2; d++) {
            sum[1 + d] += p->mass[i] * probe_particle_position_component(s->q, p, d, k);
            sum[3 + d] += p->mass[i] * p->X[d][i];
        }
    }
}

/* Adds to sum[5], over the particles first .. end - 1 of a probe (a requested measurement): m X . x and m X x x (which
 * give the best-fit rotation), angular momentum, |m x x v| and kinetic energy, in this order. X, x: reference and
 * current position relative to the centres of mass. context: a struct rigid_sum. reproducible_sums calls it for each
 * block of particles. */
static void turn_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct rigid_sum *s = context;
    const struct particles *p = s->p;
    for (int64_t k = first; k < end; k++) {
        const int32_t i = s->q->list[k];
        const real m = p->mass[i], v[2] = {probe_particle_velocity_component(s->q, p, 0, k),
                                           probe_particle_velocity_component(s->q, p, 1, k)};
        const real X[2] = {p->X[0][i] - s->centre_reference[0], p->X[1][i] - s->centre_reference[1]};
        const real x[2] = {probe_particle_position_component(s->q, p, 0, k) - s->centre[0],
                           probe_particle_position_component(s->q, p, 1, k) - s->centre[1]};
        sum[0] += m * (X[0] * x[0] + X[1] * x[1]);
        sum[1] += m * (X[0] * x[1] - X[1] * x[0]);
        sum[2] += m * (x[0] * v[1] - x[1] * v[0]);
        sum[3] += m * fabs(x[0] * v[1] - x[1] * v[0]);
        sum[4] += 0.5 * m * (v[0] * v[0] + v[1] * v[1]);
    }
}

/* Returns the angle [rad] of the best-fit rotation R of the particles of the probe (indices in p), which minimises sum
 * m |x - R X|^2 (Kabsch 1976, in the plane), with reference positions X and current positions x relative to the centres
 * of mass. Also computes the angular momentum *spin and its scale *spin_scale = sum |m x x v| [kg m^2/s], and the
 * kinetic energy *kinetic [J]. */
static real probes_rigid_turn(const struct probe *probe, const struct particles *p, real *spin, real *spin_scale,
                              real *kinetic)
{
    struct rigid_sum s = {.q = probe, .p = p};
    real sum[5];
    reproducible_sums(probe->n, 5, centre_block, &s, sum);
    for (int d = 0; d < 2; d++) s.centre[d] = sum[1 + d] / sum[0], s.centre_reference[d] = sum[3 + d] / sum[0];
    reproducible_sums(probe->n, 5, turn_block, &s, sum);
    *spin = sum[2], *spin_scale = sum[3], *kinetic = sum[4];
    return atan2(sum[1], sum[0]);
}

status rigid_probe_store_initial_motion(struct probe *probe, const struct observed_run *o)
{
    struct rigid_memory *m = &probe->memory.rigid;
    if (o->part->dim != 2)
        return status_set(
            REFUSED, "probe \"%s\" needs space: plane stress or plane strain; set one of these, or remove the probe",
            probe->request.name);
    probes_rigid_turn(probe, o->part, &m->spin, &m->spin_scale, &m->kinetic);
    return OK;
}

/* Computes the largest absolute principal stress, *stress, and the largest in-plane shear stress, *shear, of the
 * particles of the probe (indices in p) [Pa]. */
static void stresses(const struct probe *probe, const struct particles *p, real *stress, real *shear)
{
    *stress = *shear = 0;
    for (int64_t k = 0; k < probe->n; k++) {
        const int32_t i = probe->list[k];
        const real mean = 0.5 * (p->stress[0][i] + p->stress[1][i]);
        const real radius = hypot(0.5 * (p->stress[0][i] - p->stress[1][i]), p->stress[2][i]);
        *stress = real_max(*stress, real_max(fabs(mean) + radius, fabs(particle_out_of_plane_stress(p, i))));
        *shear = real_max(*shear, radius);
    }
}

enum { RIGID_PLACES = 3 }; /* number of results that depend on positions only */

/* Raises m->most[k], the largest |value[k]| so far, to the present |value[k]| for k = first .. end - 1. m->most[k]
 * becomes NAN if value[k] is NAN. */
static void rigid_most(struct rigid_memory *m, const real *value, int first, int end)
{
    for (int k = first; k < end; k++) m->most[k] = isnan(value[k]) ? NAN : real_max(m->most[k], fabs(value[k]));
}

/* Computes the results of the probe of kind RIGID (rigid-body motion) of the run o from the positions of its particles:
 * value[0], the rotation angle of the body [rad]; value[1], the largest absolute principal stress of any of its
 * particles [Pa]; value[2], the largest in-plane shear stress [Pa]. The angle continues beyond half a turn if the body
 * rotates by less than half a turn between samples. */
void rigid_probe_compute_rotation_angle_and_stresses(struct probe *probe, const struct observed_run *o, real *value)
{
    struct rigid_memory *m = &probe->memory.rigid;
    real spin, scale, kinetic;
    const real angle = probes_rigid_turn(probe, o->part, &spin, &scale, &kinetic);
    m->angle += remainder(angle - m->angle, 2 * pi);
    m->most[0] = value[0] = m->angle;
    stresses(probe, o->part, &value[1], &value[2]);
    rigid_most(m, value, 1, RIGID_PLACES);
}

void rigid_probe_compute_conservation_errors(struct probe *probe, const struct particles *p, real *value)
{
    struct rigid_memory *m = &probe->memory.rigid;
    real spin, scale, kinetic;
    probes_rigid_turn(probe, p, &spin, &scale, &kinetic);
    value[3] = m->spin_scale > 0 ? (spin - m->spin) / m->spin_scale : NAN;
    value[4] = m->kinetic > 0 ? (kinetic - m->kinetic) / m->kinetic : NAN;
    rigid_most(m, value, RIGID_PLACES, RIGID_FIGURES);
}
