/* Warns of loads in the input file that are probably mistakes of units: their times, the stress that they can cause,
 * and tractions beyond Young's modulus. */
#include <math.h>
#include <stdio.h>

#include "engine_internal.h"
#include "warn_units.h"

enum { MOMENTS_OF_LOADS = 64, PLACES_OF_LOADS = 16 }; /* times, positions at which loads are evaluated */
#define EARLY 0.01 /* end of a function of time divided by the time step, below which the run does not see it */

/* ---- times of loads ---------------------------------------------------------------------------------------------- */

/* Returns the largest absolute value of the function of time f, a factor on a load, between the times 0 and t_end [s]
 * [1]. t_end: INFINITY for all times. */
static real factor_largest_until(const struct time_function *f, real t_end)
{
    real most = fabs(time_function_value(f, t_end));
    if (f->kind == TIME_STEP && t_end >= f->from) most = 1;
    if (f->kind == TIME_PULSE && t_end >= 0.5 * (f->from + f->until)) most = 1;
    if (f->kind == TIME_TABLE) most = real_max(most, fabs(time_function_value(f, 0)));
    for (int k = 0; k < f->n && f->t[k] <= t_end; k++) most = real_max(most, fabs(f->value[k]));
    return most;
}

/* Adds warnings to *to about loads and supports that reach only a small part of their largest value by the end of the
 * run, and, in dynamic runs, about those whose function of time ends before EARLY (a hundredth) of the time step dt
 * [s]. Ramps of rigid bodies are judged in the same way. The limits are in the table of warn_units_ranges.c. */
static void units_of_times(const struct scene *s, real dt, struct warnings *to)
{
    static const char *const early[] = {[TIME_STEP] = "it never acts",
                                        [TIME_PULSE] = "it never acts",
                                        [TIME_RAMP] = "the load acts in full at once",
                                        [TIME_TABLE] = "the load has its last value at once"};
    char subject[NAME_MAX_LENGTH + 16];
    for (int b = 0; b < s->boundaries; b++) {
        const struct time_function *f = &s->boundary[b].time;
        if (f->kind == TIME_CONSTANT) continue;
        const real end = f->kind == TIME_TABLE ? f->t[f->n - 1] : f->until;
        const real most = factor_largest_until(f, INFINITY);
        snprintf(subject, sizeof subject, "boundary %s", s->boundary[b].name);
        if (most > 0) units_judge(s, ACCEPT_TIMES, subject, factor_largest_until(f, s->duration) / most, "", to);
        if (scene_is_dynamic(s) && end < EARLY * dt && !scene_silences_warning(s, ACCEPT_TIMES))
            warnings_add_if_new(
                to,
                "%s: its time function ends at %.3g s, long before the end of the first time step, %.3g s, so %s: "
                "check the units of its times (s if none is written); if this is intended, add accept: [times]",
                subject, end, dt, early[f->kind]);
    }
    for (int b = s->bodies; b < s->bodies + s->rigids; b++) {
        snprintf(subject, sizeof subject, "body %s", s->body[b].name);
        if (s->body[b].ramp > 0)
            units_judge(s, ACCEPT_TIMES, subject, real_min(1, s->duration / s->body[b].ramp), " (by its ramp)", to);
    }
}

/* ---- stress that loads can make -------------------------------------------------------------------------------- */

/* Largest values over all loads. stress: of tractions, pressures and body forces [Pa]; speed: of driven particles
 * relative to undriven ones [m/s]; least, most: range of prescribed displacements along each axis [m]; supports: number
 * of loads that constrain or drive particles. */
struct load_figures {
    real stress, speed, least[DIM_MAX], most[DIM_MAX];
    int supports;
};

/* Returns the stress that the applied load l causes at time t [s] at particle number k of its list (indices in p) [Pa]:
 * the magnitude of a traction or pressure, or that of a body force times the longest edge of the box around all
 * particles. */
static real load_stress_at(const struct scene *s, const struct particles *p, const struct load *l, int64_t k, real t)
{
    real value[DIM_MAX] = {0}, density = 0;
    load_prescribed_value_at_particle(l, p, k, t, value);
    if (l->boundary->kind == BOUNDARY_PRESSURE) return fabs(value[0]);
    if (l->boundary->kind == BOUNDARY_TRACTION) return sqrt(dot(value, value, s->dim));
    for (int m = 0; m < s->materials; m++) density = real_max(density, s->material[m].density);
    return (l->boundary->by_mass ? density : 1) * sqrt(dot(value, value, s->dim)) *
           particles_bounding_box_longest_edge(p);
}

/* Extends the ranges of stress and displacement in *f by the values that the load l of scene s applies or prescribes at
 * time t [s] at particle number k of its list (indices in p). Rotations are left out, and displacements that are not
 * known. */
static void load_figures_at(const struct scene *s, const struct particles *p, const struct load *l, int64_t k, real t,
                            struct load_figures *f)
{
    const enum boundary_kind kind = l->boundary->kind;
    if (kind == BOUNDARY_TRACTION || kind == BOUNDARY_PRESSURE || kind == BOUNDARY_BODY_FORCE)
        f->stress = real_max(f->stress, load_stress_at(s, p, l, k, t));
    if (kind != BOUNDARY_VELOCITY || l->boundary->rotates ||
        boundary_check_velocity_has_closed_form_integral(l->boundary) != OK)
        return;
    real u[DIM_MAX];
    load_prescribed_displacement_of_particle(l, p, k, l->boundary->frozen ? INFINITY : t,
                                             u); /* frozen: in the pseudo-time of a solver */
    for (int d = 0; d < s->dim; d++) f->least[d] = real_min(f->least[d], u[d]), f->most[d] = real_max(f->most[d], u[d]);
}

/* Raises the largest stress and displacement in *f to those that load l of scene s applies or prescribes, evaluated at
 * sampled times between 0 and the duration and at some of the particles of l (indices in p). Counts supports and planes
 * of symmetry in f->supports. In dynamic scenes also raises the largest prescribed speed. */
static void load_figures_add(const struct scene *s, const struct particles *p, const struct load *l,
                             struct load_figures *f)
{
    const bool drives = l->boundary->kind == BOUNDARY_VELOCITY;
    f->supports += drives || l->boundary->kind == BOUNDARY_MIRROR;
    if (l->n == 0) return;
    for (int m = 0; m <= MOMENTS_OF_LOADS; m++)
        for (int64_t k = 0; k < l->n; k += 1 + l->n / PLACES_OF_LOADS)
            load_figures_at(s, p, l, k, s->duration * m / MOMENTS_OF_LOADS, f);
    if (!drives || !scene_is_dynamic(s)) return;
    const real speed = load_largest_prescribed_speed(l, p, s->duration);
    if (isfinite(speed)) f->speed = real_max(f->speed, speed);
}

/* Returns the largest difference between the initial velocities of the particles p and the rigid bodies of scene s,
 * where a body at rest is included [m/s]. */
static real units_speed_at_start(const struct scene *s, const struct particles *p)
{
    real apart[DIM_MAX] = {0};
    for (int d = 0; d < s->dim; d++) {
        real low = 0, high = 0;
        for (int64_t i = 0; i < p->n; i++) low = real_min(low, p->v[d][i]), high = real_max(high, p->v[d][i]);
        for (int b = s->bodies; b < s->bodies + s->rigids; b++)
            low = real_min(low, s->body[b].velocity[d]), high = real_max(high, s->body[b].velocity[d]);
        apart[d] = high - low;
    }
    return sqrt(dot(apart, apart, s->dim));
}

/* Returns the largest absolute component of the initial stress of the particles p [Pa]; 0 without stress. */
static real units_stress_at_start(const struct particles *p)
{
    real most = 0;
    for (int c = 0; c < symmetric_tensor_component_count(p->dim); c++)
        for (int64_t i = 0; i < p->n && p->stress[c]; i++) most = real_max(most, fabs(p->stress[c][i]));
    return most;
}

/* Returns the smallest strength of the materials and interfaces of scene s that can break [Pa]; INFINITY if none can.
 * The strength is Young's modulus times the critical stretch, or times the onset of softening for bonds that soften. */
static real least_strength(const struct scene *s)
{
    real least = INFINITY, young = INFINITY;
    for (int m = 0; m < s->materials; m++) {
        young = real_min(young, s->material[m].young);
        least = real_min(least, s->material[m].young * s->material[m].onset_stretch);
    }
    for (int k = 0; k < s->interfaces; k++)
        if (s->interface[k].critical_stretch > 0) least = real_min(least, young * s->interface[k].critical_stretch);
    return least;
}

/* Adds a warning to *to if the largest stress of the run is too small to make a crack grow: if the following ratio is
 * below 0.1 (plausible_range[ACCEPT_GROWTH].least). In Griffith's plate (1921) a crack as long as the longest edge a of
 * the body would have the energy release rate pi sigma^2 a/E, which is divided by the smallest one of a material. As
 * bending is not computed, sigma is the stress times the slenderness of the body. Checks nothing if no material has an
 * energy release rate, or with interfaces. p: particles; stress: stress of the loads [Pa]. */
static void units_of_growth(const struct scene *s, const struct particles *p, real stress, struct warnings *to)
{
    real rate = INFINITY, young = INFINITY, longest = 0, least = INFINITY, low, high;
    char note[120];
    for (int m = 0; m < s->materials; m++) {
        rate = real_min(rate, s->material[m].energy_release_rate);
        young = real_min(young, s->material[m].young);
    }
    if (!isfinite(rate) || s->interfaces > 0) return;
    for (int d = 0; d < s->dim; d++) {
        particles_coordinate_range(p, p->n, d, &low, &high);
        longest = real_max(longest, high - low + s->spacing), least = real_min(least, high - low + s->spacing);
    }
    const real most = M_PI * square(stress * longest / least) * longest / young;
    snprintf(note, sizeof note, " (%.3g J/m^2 over %.3g J/m^2)", most, rate);
    units_judge(s, ACCEPT_GROWTH, "loads", most / rate, note, to);
}

/* Adds a warning to *to if nothing loads the bodies, or if the largest stress of the run divided by the strength is
 * outside the plausible range 0.01 to 1000 (plausible_range[ACCEPT_STRESS]). Then judges whether a crack can grow
 * (units_of_growth). The stress of `loads` on p is estimated from tractions, as rho c v from speeds v, and as E u/L
 * from displacements u of bodies of length L (rho: density, c: wave speed, E: Young's modulus). Displacements in
 * dynamic runs are not reported as too large, since they may grow after the first bonds have broken. Checks nothing for
 * method mpm, if no bond can break, and with cracks of prescribed growth. */
static void units_of_stress(const struct scene *s, const struct particles *p, const struct loads *loads,
                            struct warnings *to)
{
    struct load_figures f = {0};
    real impedance = 0, young = 0, stretched = 0;
    char note[160];
    const real strength = least_strength(s);
    if (s->method == METHOD_MPM || !isfinite(strength) || s->growths > 0) return;
    for (int b = 0; b < loads->n; b++) load_figures_add(s, p, &loads->load[b], &f);
    for (int m = 0; m < s->materials; m++) {
        impedance = real_max(impedance, s->material[m].density * s->material[m].wave_speed);
        young = real_max(young, s->material[m].young);
    }
    for (int d = 0; d < s->dim && f.supports > 1; d++) {
        real low, high;
        particles_coordinate_range(p, p->n, d, &low, &high);
        stretched = real_max(stretched, young * (f.most[d] - f.least[d]) / (high - low + s->spacing));
    }
    const real enough = units_least_plausible_value(ACCEPT_STRESS) * strength;
    real stress = real_max(f.stress, units_stress_at_start(p));
    stress = real_max(stress, impedance * real_max(f.speed, scene_is_dynamic(s) ? units_speed_at_start(s, p) : 0));
    const real largest = real_max(stress, stretched);
    stress = real_max(stress, scene_is_dynamic(s) ? real_min(stretched, enough) : stretched);
    if (stress == 0 && scene_has_moving_rigid_body(s)) return; /* it loads by contact alone */
    if (stress == 0 && !scene_silences_warning(s, ACCEPT_STRESS)) {
        warnings_add_if_new(to,
                            "nothing loads the body: no load, speed or displacement differs from 0 up to %.3g s; check "
                            "their values and times (s); if this is intended, add accept: [stress]",
                            s->duration);
        return;
    }
    snprintf(note, sizeof note, " (%.3g Pa; E s_c is %.3g Pa)", stress, strength);
    units_judge(s, ACCEPT_STRESS, "loads", stress / strength, note, to);
    if (stress >= enough) units_of_growth(s, p, largest, to);
}

/* Adds a warning to *to if the largest traction or pressure of the boundaries exceeds 0.05
 * (plausible_range[ACCEPT_STRAIN].most) times the smallest Young's modulus of the materials. The warning counts the
 * other boundaries of which this is true. */
static void units_of_tractions(const struct scene *s, struct warnings *to)
{
    char subject[NAME_MAX_LENGTH + 16], note[120];
    real young = INFINITY, largest = 0;
    int others = -1; /* implausible loads but the largest */
    for (int m = 0; m < s->materials; m++) young = real_min(young, s->material[m].young);
    for (int b = 0; b < s->boundaries; b++) {
        const struct boundary *a = &s->boundary[b];
        if (a->kind != BOUNDARY_TRACTION && a->kind != BOUNDARY_PRESSURE) continue;
        const real load = a->kind == BOUNDARY_PRESSURE ? fabs(a->value[0]) : sqrt(dot(a->value, a->value, s->dim));
        others += load > units_largest_plausible_value(ACCEPT_STRAIN) * young;
        if (load <= largest) continue;
        largest = load;
        snprintf(subject, sizeof subject, "boundary %s", a->name);
    }
    if (others < 0) return;
    const int used = snprintf(note, sizeof note, " (%.3g Pa over %.3g Pa", largest, young);
    snprintf(note + used, sizeof note - (size_t)used, others > 0 ? "; also of %d other boundar%s)" : ")", others,
             others == 1 ? "y" : "ies");
    units_judge(s, ACCEPT_STRAIN, subject, largest / young, note, to);
}

void units_of_loads(const struct scene *s, const struct particles *p, const struct loads *loads, real dt,
                    struct warnings *to)
{
    units_of_times(s, dt, to);
    units_of_tractions(s, to);
    units_of_stress(s, p, loads, to);
}
