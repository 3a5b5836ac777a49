/* Computes the results of PULSE probes: the reflected and the transmitted part of a wave packet at an interface. */
#include <math.h>

#include "base/memory.h"
#include "probes_parts.h"

/* Returns how far the reference position of particle i of p is beyond the interface of the probe of kind PULSE (wave at
 * an interface), along the direction of its wave [m]; negative before the interface. */
static real ahead(const struct probe *probe, const struct particles *p, int64_t i)
{
    real distance = 0;
    for (int d = 0; d < p->dim; d++) distance += (p->X[d][i] - probe->request.at[d]) * probe->request.direction[d];
    return distance;
}

/* Returns the speed of particle i of p relative to `baseline` (velocities stored at the start), |v - v_baseline| [m/s];
 * |v| if `baseline` is NULL. */
static real speed(const struct particles *p, const struct baseline *baseline, int64_t i)
{
    real speed2 = 0;
    for (int d = 0; d < p->dim; d++) speed2 += square(p->v[d][i] - (baseline ? baseline->v[d][i] : 0));
    return sqrt(speed2);
}

/* Returns the largest speed of the particles of p on one side of the interface of the probe of kind PULSE (wave at an
 * interface) [m/s]: before it (side -1), beyond it (1), or on both sides (0). baseline: velocities that are subtracted
 * first; NULL: none. */
static real probes_pulse_fastest(const struct probe *probe, const struct particles *p, const struct baseline *baseline,
                                 int side)
{
    real most = 0;
    for (int64_t i = 0; i < p->n; i++)
        if (side * ahead(probe, p, i) >= 0) most = real_max(most, speed(p, baseline, i));
    return most;
}

status pulse_probe_store_incident_amplitude(struct probe *probe, const struct observed_run *o)
{
    real *direction = probe->request.direction, length = sqrt(dot(direction, direction, o->part->dim));
    for (int d = 0; d < DIM_MAX; d++) direction[d] = length > 0 ? direction[d] / length : d == 0;
    probe->memory.incident = probes_pulse_fastest(probe, o->part, NULL, 0);
    if (probe->memory.incident > 0) return OK;
    return status_set(REFUSED, "probe \"%s\": nothing moves at the start; add a pulse to initial", probe->request.name);
}

struct pulse_amplitudes pulse_probe_compute_amplitudes(const struct probe *probe, const struct observed_run *o)
{
    return (struct pulse_amplitudes){
        .reflected = probes_pulse_fastest(probe, o->part, o->baseline, -1) / probe->memory.incident,
        .transmitted = probes_pulse_fastest(probe, o->part, NULL, 1) / probe->memory.incident,
        .energy_change = o->energy_change - (o->baseline ? o->baseline->energy_change : 0),
    };
}
