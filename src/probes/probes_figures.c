/* Computes quantities that probes measure, and reports the results of probes for summary.json. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "kernels/pd/bond_laws.h"
#include "probes_parts.h"
#include "base/memory.h"
#include "base/team.h"
#include "probes/diagnostics.h"

/* ---- single particles -------------------------------------------------------------------------------------------- */

/* Names of the stress components of a probe by dimension; in 2D the last one is reported in plane strain only. */
static const char *const symmetric_name[DIM_MAX + 1][SYM_MAX] = {
    [1] = {"xx"},
    [2] = {"xx", "yy", "xy", "zz"},
    [3] = {"xx", "yy", "zz", "xy", "yz", "zx"},
};

/* Returns the number of stress components that a probe (a requested measurement) reports of a particle of p. In plane
 * strain this includes zz, as the last one. */
static int stresses_count(const struct particles *p)
{
    return symmetric_tensor_component_count(p->dim) + (p->plane_strain != NULL);
}

/* Returns how many values a probe (a requested measurement) reports of a particle of p because materials yield:
 * plastic strain, and temperature if they heat (0 to 2). */
static int law_readings_count(const struct particles *p)
{
    return (p->plastic_work != NULL) + (p->temperature != NULL);
}

int particle_probe_value_count(const struct particles *p)
{
    return 2 * p->dim + stresses_count(p) + 1 + law_readings_count(p);
}

struct column particle_probe_value_column(const struct particles *p, int value_number)
{
    const int dim = p->dim;
    struct column c = {.name = "damage", .unit = "1"};
    int stress = value_number - 2 * dim;
    if (value_number < dim) {
        snprintf(c.name, sizeof c.name, "displacement_%s", axis_name[value_number]);
        snprintf(c.unit, sizeof c.unit, "m");
    } else if (stress < 0) {
        snprintf(c.name, sizeof c.name, "velocity_%s", axis_name[value_number - dim]);
        snprintf(c.unit, sizeof c.unit, "m/s");
    } else if (stress < stresses_count(p)) {
        snprintf(c.name, sizeof c.name, "stress_%s", symmetric_name[dim][stress]);
        snprintf(c.unit, sizeof c.unit, "Pa");
    } else if (stress == stresses_count(p) + 1) {
        snprintf(c.name, sizeof c.name, "plastic_strain");
    } else if (stress == stresses_count(p) + 2) {
        snprintf(c.name, sizeof c.name, "temperature");
        snprintf(c.unit, sizeof c.unit, "K");
    }
    return c;
}

/* Returns the plastic strain of particle i of the run o: for a peridynamic particle with plastic bonds the mean plastic
 * path of its bonds, else the plastic strain of the material point. */
static real plastic_strain_reading(const struct observed_run *o, int64_t i)
{
    const struct bonds *b = o->bonds;
    const bool by_bonds = b && o->part->kind[i] == KIND_PD && b->plastic_path && b->row_of[i] >= 0;
    return by_bonds ? bond_row_plastic_path(b, b->row_of[i]) : o->part->plastic_strain[i];
}

void particle_compute_probe_values(const struct observed_run *o, int64_t particle, real *value)
{
    const struct particles *p = o->part;
    for (int d = 0; d < p->dim; d++) *value++ = p->x[d][particle] - p->X[d][particle];
    for (int d = 0; d < p->dim; d++) *value++ = p->v[d][particle];
    for (int a = 0; a < symmetric_tensor_component_count(p->dim); a++) *value++ = p->stress[a][particle];
    if (p->plane_strain) *value++ = particle_out_of_plane_stress(p, particle);
    *value++ = probe_damage_of_particle(o, particle);
    if (p->plastic_work) *value++ = plastic_strain_reading(o, particle);
    if (p->temperature) *value++ = p->temperature[particle];
}

const struct column growth_figure[GROWTH_FIGURES] = {
    {"x", "m"}, {"y", "m"}, {"length", "m"}, {"speed", "m/s"}, {"K_eq", "Pa m^(1/2)"}};

void growing_crack_compute_probe_values(const struct growing_crack *g, real *value)
{
    const real reading[GROWTH_FIGURES] = {g->place[0], g->place[1], g->grown, g->speed, g->intensity};
    memcpy(value, reading, sizeof reading);
}

/* ---- tips and supports ------------------------------------------------------------------------------------------- */

/* Returns the crack tip that probe of kind TIP (crack tip) currently follows: the tip of *tips whose origin is nearest
 * to the position `at` of the probe. Without `at` it is the tip of the longest crack, or the first tip if no crack has
 * grown. Returns NULL if there are no tips. The result points into *tips. */
const struct crack_tip *probe_find_followed_crack_tip(const struct probe *probe, const struct crack_tips *tips)
{
    if (tips->n == 0) return NULL;
    const struct crack_tip *chosen = probe->request.has_at ? NULL : tips_find_tip_with_largest_growth(tips);
    if (chosen || !probe->request.has_at) return chosen ? chosen : &tips->tip[0];
    real least = INFINITY;
    for (int k = 0; k < tips->n; k++) {
        real distance2 = 0;
        for (int d = 0; d < tips->dim; d++) distance2 += square(tips->tip[k].origin[d] - probe->request.at[d]);
        if (distance2 < least) chosen = &tips->tip[k], least = distance2;
    }
    return chosen;
}

void probe_compute_reaction_of_supports(const struct probe *probe, const struct loads *l, int dim, real *force,
                                        real *mean_displacement)
{
    real held = 0;
    for (int d = 0; d < dim; d++) force[d] = mean_displacement[d] = 0;
    for (int k = 0; k < l->n; k++) {
        const struct load *load = &l->load[k];
        if (strcmp(load->boundary->name, probe->request.boundary) != 0) continue;
        real before = held, weight = load->n > 0 ? (real)load->n : 1;
        held += weight;
        for (int d = 0; d < dim; d++) {
            force[d] += load->reaction[d];
            mean_displacement[d] = (mean_displacement[d] * before + load->displacement[d] * weight) / held;
        }
    }
}

/* ---- sums over a region ------------------------------------------------------------------------------------------ */

/* Arguments of the functions that return the contribution of one particle to a sum over the particles of probe q in the
 * run o. component: axis, for momentum; unused otherwise. */
struct region_sum {
    const struct probe *q;
    const struct observed_run *o;
    int component;
    const real *row_energy; /* [bonds->rows] share of each row in the elastic energy of the bonds [J] */
};

/* Returns one component of the momentum of particle number k (from 0) of a probe (a requested measurement) [kg m/s].
 * context: a struct region_sum, with the probe, the run and the component. */
static real momentum_term(const void *context, int64_t k)
{
    const struct region_sum *s = context;
    return s->o->part->mass[s->q->list[k]] * probe_particle_velocity_component(s->q, s->o->part, s->component, k);
}

/* Returns the kinetic energy of particle number k (from 0) of a probe (a requested measurement) [J]. context: a struct
 * region_sum, with the probe and the run. */
static real kinetic_term(const void *context, int64_t k)
{
    const struct region_sum *s = context;
    const struct particles *p = s->o->part;
    real speed2 = 0;
    for (int d = 0; d < p->dim; d++) speed2 += square(probe_particle_velocity_component(s->q, p, d, k));
    return 0.5 * p->mass[s->q->list[k]] * speed2;
}

/* Returns the row of bonds of particle number k (from 0) in the list of the probe s->q (a requested measurement), or
 * -1 if the particle has no bonds. */
static int64_t row_at(const struct region_sum *s, int64_t k)
{
    const struct bonds *b = s->o->bonds;
    return b && b->rows > 0 ? b->row_of[s->q->list[k]] : -1;
}

/* Returns the share of particle number k (from 0) of a probe (a requested measurement) in the elastic energy of the
 * bonds [J]. context: a struct region_sum, with the probe, the run and the energy of each row of bonds. */
static real bond_term(const void *context, int64_t k)
{
    const struct region_sum *s = context;
    int64_t row = row_at(s, k);
    return row >= 0 ? s->row_energy[row] : 0;
}

/* Returns the energy dissipated by the broken or softened bonds of particle number k (from 0) of a probe (a requested
 * measurement) [J]. context: a struct region_sum, with the probe and the run. */
static real fracture_term(const void *context, int64_t k)
{
    const struct region_sum *s = context;
    int64_t row = row_at(s, k);
    return row >= 0 ? bonds_row_dissipated_energy(s->o->bonds, row) : 0;
}

/* Returns the number of broken bonds of particle number k (from 0) of a probe (a requested measurement); 0 if its
 * motion is prescribed. A bond counts at both of its particles. context: a struct region_sum, with the probe and the
 * run. */
static real broken_term(const void *context, int64_t k)
{
    const struct region_sum *s = context;
    int64_t row = row_at(s, k);
    bool driven = s->o->part->flag[s->q->list[k]] & FLAG_DRIVEN;
    return row >= 0 && !driven ? s->o->bonds->broken[row] : 0;
}

real probe_kinetic_energy(const struct probe *probe, const struct particles *p)
{
    return reproducible_sum(probe->n, kinetic_term,
                            &(struct region_sum){.q = probe, .o = &(struct observed_run){.part = p}});
}

struct energies probe_compute_energies_of_particles(const struct probe *probe, const struct observed_run *o)
{
    const struct bonds *b = o->bonds;
    const bool bonded = b && b->rows > 0;
    real *row_energy = bonded ? NEW("probes.row_energy", b->rows, real) : NULL;
    if (bonded) o->kernels->bond_energy(b, o->part, row_energy);
    struct region_sum s = {.q = probe, .o = o, .row_energy = row_energy};
    const struct energies sums = {
        .kinetic = probe_kinetic_energy(probe, o->part),
        .strain = reproducible_sum(probe->n, bond_term, &s) +
                  points_strain_energy_of_listed_points(o->part, o->material, o->partial, probe->list, probe->n),
        .fracture = reproducible_sum(probe->n, fracture_term, &s),
    };
    memory_free(row_energy);
    return sums;
}

void probe_compute_momentum_of_particles(const struct probe *probe, const struct particles *p, real *momentum)
{
    const struct observed_run o = {.part = p};
    for (int d = 0; d < p->dim; d++)
        momentum[d] =
            reproducible_sum(probe->n, momentum_term, &(struct region_sum){.q = probe, .o = &o, .component = d});
}

/* ---- results ----------------------------------------------------------------------------------------------------- */

/* Function that receives the results of one probe q (a requested measurement) in the run o, and its context. It is
 * called as emit(context, name of the probe, name of the result, value). */
struct emitter {
    void (*emit)(void *context, const char *probe, const char *quantity, real value);
    void *context;
    const struct probe *q;
    const struct observed_run *o;
    const real *sampled; /* columns of the probe at a sample of this time; NULL if there is none */
};

/* Passes `value` to the receiver e->emit as quantity `quantity` of probe e->q (a requested measurement). Values that
 * are not finite are left out. */
static void probes_figures_put(const struct emitter *e, const char *quantity, real value)
{
    if (isfinite(value)) e->emit(e->context, e->q->request.name, quantity, value);
}

/* Passes the components of a position or vector X[dim] to the receiver e->emit as quantities x, y, z of probe e->q (a
 * requested measurement). */
static void put_position(const struct emitter *e, const real *X)
{
    for (int d = 0; d < e->o->part->dim; d++) probes_figures_put(e, axis_name[d], X[d]);
}

/* Reports the crack tip of a probe of kind TIP (crack tip) to e->emit: growth, angle, position, times of start and
 * arrest and speeds (except in load steps), and the number of tips that are equally long. Reports nothing without a
 * tip. */
static void figures_tip(const struct emitter *e)
{
    const struct crack_tip *tip = probe_find_followed_crack_tip(e->q, e->o->tips);
    if (!tip) return;
    const bool moves = e->o->load_step == 0;
    if (moves) probes_figures_put(e, "start_time", tip->start_time);
    if (moves) probes_figures_put(e, "arrest_time", tip->arrest_time);
    probes_figures_put(e, "length_end", tip->growth);
    probes_figures_put(e, "angle_deg", tip_deflection_angle(tip, e->o->part->dim));
    if (moves) probes_figures_put(e, "speed_max", tip->speed_max);
    if (moves) probes_figures_put(e, "speed_mean", tip->speed_mean);
    put_position(e, tip->place);
    probes_figures_put(
        e, "tied", (real)(e->q->request.has_at ? tip->ends : tips_count_crack_ends_with_largest_growth(e->o->tips)));
}

/* Reports time (or load step) and position of the first break in the region of a probe of kind BREAK (first bond
 * break) to e->emit, and the number of broken bonds, each counted once. Reports nothing before the first break. */
static void figures_break(const struct emitter *e)
{
    if (isnan(e->q->memory.first_time)) return;
    if (e->o->load_step > 0)
        probes_figures_put(e, "first_step", (real)e->q->memory.first_step);
    else
        probes_figures_put(e, "first_time", e->q->memory.first_time);
    put_position(e, e->q->memory.position);
    probes_figures_put(e, "tied", (real)e->q->memory.ends);
    probes_figures_put(e, "bonds",
                       0.5 * reproducible_sum(e->q->n, broken_term, &(struct region_sum){.q = e->q, .o = e->o}));
}

/* Reports to e->emit the largest and the root-mean-square reaction force of a probe of kind REACTION (force on a
 * support) [N], in load steps also displacement and number of the step with the largest force, and the magnitude of the
 * present displacement of its boundary [m]. */
static void figures_reaction(const struct emitter *e)
{
    const struct probe_memory *m = &e->q->memory;
    real force[DIM_MAX], displacement[DIM_MAX];
    int dim = e->o->part->dim;
    probe_compute_reaction_of_supports(e->q, e->o->loads, dim, force, displacement);
    probes_figures_put(e, "force_max", m->steps > 0 ? m->force_max : NAN);
    if (e->o->load_step > 0 && m->force_max > 0) {
        probes_figures_put(e, "force_max_displacement", m->force_max_displacement);
        probes_figures_put(e, "force_max_step", (real)m->force_max_step);
    }
    probes_figures_put(e, "force_rms", m->steps > 0 ? sqrt(m->force_square / (real)m->steps) : NAN);
    probes_figures_put(e, "displacement", sqrt(dot(displacement, displacement, dim)));
}

/* Reports residual_max of a probe of kind PATCH (a patch test under uniform initial stress) to e->emit: the largest
 * nodal force in the region of the probe in the first step, divided by the force of the largest initial stress
 * component on one face of a grid cell. */
static void figures_patch(const struct emitter *e)
{
    const struct observed_run *o = e->o;
    real h = o->grid && o->grid->h > 0 ? o->grid->h : o->spacing;
    real reference = o->strain_stress * pow(h, o->part->dim - 1) * o->thickness;
    probes_figures_put(e, "residual_max", reference > 0 ? o->residual_step0 / reference : NAN);
}

/* Reports position and time of the separation that a probe of kind SPALL (separation of a body) has found to e->emit,
 * and the mean speeds of both parts of the body. Reports nothing before separation. */
static void figures_spall(const struct emitter *e)
{
    real speed, rest;
    if (isnan(e->q->memory.first_time)) return;
    spall_probe_compute_part_speeds(e->q, e->o->part, &speed, &rest);
    probes_figures_put(e, "position", e->q->memory.position[0]);
    probes_figures_put(e, "time", e->q->memory.first_time);
    probes_figures_put(e, "speed", speed);
    probes_figures_put(e, "speed_rest", rest);
}

static void figures_point(const struct emitter *e)
{
    const struct particles *p = e->o->part;
    real value[READINGS_MAX];
    particle_compute_probe_values(e->o, e->q->list[0], value);
    for (int k = 0; k < p->dim && e->sampled; k++) value[p->dim + k] = e->sampled[p->dim + k];
    for (int k = 0; k < particle_probe_value_count(p); k++)
        probes_figures_put(e, particle_probe_value_column(p, k).name, value[k]);
}

/* Reports the smallest and the largest value of each quantity of a probe of kind LINE (points along a line) to
 * e->emit, over those of its stations (equidistant points of the line) that are inside the bodies. */
static void figures_line(const struct emitter *e)
{
    const struct particles *p = e->o->part;
    real value[READINGS_MAX], low[READINGS_MAX], high[READINGS_MAX];
    for (int k = 0; k < READINGS_MAX; k++) low[k] = INFINITY, high[k] = -INFINITY;
    for (int64_t m = 0; m < e->q->n; m++) {
        if (e->q->list[m] < 0) continue;
        particle_compute_probe_values(e->o, e->q->list[m], value);
        for (int k = 0; k < particle_probe_value_count(p); k++)
            low[k] = real_min(low[k], value[k]), high[k] = real_max(high[k], value[k]);
    }
    for (int k = 0; k < particle_probe_value_count(p); k++) {
        char name[NAME_MAX_LENGTH];
        struct column c = particle_probe_value_column(p, k);
        snprintf(name, sizeof name, "%.32s_min", c.name);
        probes_figures_put(e, name, low[k]);
        snprintf(name, sizeof name, "%.32s_max", c.name);
        probes_figures_put(e, name, high[k]);
    }
}

static void figures_energy(const struct emitter *e)
{
    const struct energies sum = probe_compute_energies_of_particles(e->q, e->o);
    probes_figures_put(e, "kinetic", e->sampled ? e->sampled[0] : sum.kinetic);
    probes_figures_put(e, "strain", e->sampled ? e->sampled[1] : sum.strain);
    probes_figures_put(e, "fracture", e->sampled ? e->sampled[2] : sum.fracture);
}

static void figures_momentum(const struct emitter *e)
{
    real momentum[DIM_MAX];
    probe_compute_momentum_of_particles(e->q, e->o->part, momentum);
    put_position(e, e->sampled ? e->sampled : momentum);
}

static void figures_pulse(const struct emitter *e)
{
    struct pulse_amplitudes s = pulse_probe_compute_amplitudes(e->q, e->o);
    probes_figures_put(e, "reflected", s.reflected);
    probes_figures_put(e, "transmitted", s.transmitted);
    probes_figures_put(e, "energy_change", s.energy_change);
}

static void figures_exact(const struct emitter *e)
{
    real value[BAR_FIGURES_MAX];
    enum exact_form form = e->q->request.form;
    bar_probe_compute_values(e->q->bar, e->o, value);
    for (int k = 0; k < bar_probe_value_count(form); k++)
        probes_figures_put(e, bar_probe_value_column(form, k).name, value[k]);
}

static void figures_sif(const struct emitter *e)
{
    for (int k = 0; k < SIF_FIGURES; k++)
        probes_figures_put(e, sif_figure[k].name, sif_probe_last_sample_value_or_nan(e->q, k));
}

static void figures_growth(const struct emitter *e)
{
    const struct growing_crack *g = &e->o->growth[e->q->growth];
    probes_figures_put(e, "start_time", g->start_time);
    probes_figures_put(e, "length_end", g->grown);
    probes_figures_put(e, "angle_deg", growing_crack_deflection_angle(g));
    probes_figures_put(e, "direction_deg",
                       atan2(g->rule->direction[1], g->rule->direction[0]) * 180 / 3.14159265358979323846);
    probes_figures_put(e, "experiment_deg", e->q->request.experiment);
    put_position(e, g->place);
}

static void figures_rigid(const struct emitter *e)
{
    for (int k = 0; k < RIGID_FIGURES; k++) probes_figures_put(e, rigid_figure[k].name, e->q->memory.rigid.most[k]);
}

void probes_visit_results(const struct probes *probes, const struct observed_run *o,
                          void (*emit)(void *context, const char *probe, const char *quantity, real value),
                          void *context)
{
    static void (*const figures[PROBES])(const struct emitter *) = {
        [PROBE_TIP] = figures_tip,       [PROBE_BREAK] = figures_break,   [PROBE_REACTION] = figures_reaction,
        [PROBE_PATCH] = figures_patch,   [PROBE_SPALL] = figures_spall,   [PROBE_POINT] = figures_point,
        [PROBE_LINE] = figures_line,     [PROBE_ENERGY] = figures_energy, [PROBE_MOMENTUM] = figures_momentum,
        [PROBE_PULSE] = figures_pulse,   [PROBE_EXACT] = figures_exact,   [PROBE_SIF] = figures_sif,
        [PROBE_GROWTH] = figures_growth, [PROBE_RIGID] = figures_rigid,
    };
    for (int k = 0; k < probes->n; k++) {
        if (probes->probe[k].of_history) continue;
        const real *sampled = probes->sampled == o->t ? probes->value + probes->probe[k].first : NULL;
        figures[probes->probe[k].request.kind](&(struct emitter){emit, context, &probes->probe[k], o, sampled});
    }
}
