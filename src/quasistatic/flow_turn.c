/* Monitors material points that yield in load steps: by which angle the direction of plastic flow turns within a load
 * step, and by how much the yield stress decreases. Both cause errors that depend on the number of load steps. */
#include "flow_turn.h"

#include <math.h>
#include <stdio.h>

#include "base/memory.h"
#include "kernels/laws/flows.h"
#include "kernels/laws/law_update.h"

/* TURN_MOST: largest turn of the direction of plastic flow in a load step without a warning [degrees];
 * ERROR_PER_DEGREE, ERROR_MOST: error of the stress per degree of turn, and its largest value [%]. Measured against
 * solutions with 4000 steps along two straight strain segments, 20 to 150 degrees apart, the second of 0.7 to 10 yield
 * strains in 1 to 64 load steps, with and without hardening and back stress. The deviatoric stress at the end then has
 * an error of 0.2 to 0.5 % for each degree, at most 22 %, and half of it with twice as many steps. */
#define TURN_MOST 10.0
#define ERROR_PER_DEGREE 0.5
#define ERROR_MOST 22.0

#define SOFTENING_MOST 1e-3 /* largest fall of the yield stress in a load step without a warning, relative [1] */

#define DEGREE (M_PI / 180)

/* Returns the scalar product x:y of two symmetric tensors, each with the components xx yy zz xy yz zx. */
static real tensor_scalar_product(const real *x, const real *y)
{
    real sum = 0;
    for (int c = 0; c < SYM_MAX; c++) sum += (c < 3 ? 1 : 2) * x[c] * y[c];
    return sum;
}

/* Makes a symmetric tensor x (components xx yy zz xy yz zx) deviatoric in place: subtracts the mean of its normal
 * components. */
static void deviator(real *x)
{
    const real mean = (x[0] + x[1] + x[2]) / 3;
    for (int c = 0; c < 3; c++) x[c] -= mean;
}

/* Returns the elastic stress zz [Pa] by Hooke's law for the total strain of a body in plane stress, including its
 * change of thickness by plastic flow; 0 without plastic flow. Without this stress, the direction of flow would seem to
 * turn in a bar that yields in tension and compression alternately. poisson: Poisson's ratio; corrections: sum of the
 * normal components xx and yy of the plastic stress correction [Pa]. */
static real elastic_stress_of_plastic_thickness(real poisson, real corrections)
{
    return -(1 - 2 * poisson) / (1 + poisson) * corrections;
}

/* Returns the present state of material point i of p: deviators of stress less back stress and of the elastic stress
 * [Pa], yield stress [Pa] and accumulated plastic strain. m: constants of its material, which must have a hardening law
 * (m->law). */
static struct flow_start point_state(const struct particles *p, const struct elastic *m, int64_t i)
{
    struct flow_start state = {.strain = p->plastic_strain[i]};
    const real T = p->temperature ? p->temperature[i] : m->law->johnson_cook.T_room;
    real back[SYM_MAX] = {0};
    lanes slope;
    for (int k = 0; k < symmetric_tensor_component_count(p->dim); k++) {
        const int c = law_place[p->dim][k];
        state.relative[c] = p->mesh_stress[k][i];
        state.elastic[c] = p->mesh_stress[k][i] + p->plastic_correction[k][i];
        if (p->back_stress[0]) back[c] = p->back_stress[k][i];
    }
    if (p->dim == 2) back[2] = -back[0] - back[1];
    if (m->space == SPACE_PLANE_STRAIN) {
        state.relative[2] = m->law->poisson * (state.relative[0] + state.relative[1]) + p->out_of_plane[i];
        state.elastic[2] = m->law->poisson * (state.elastic[0] + state.elastic[1]);
    }
    if (m->space == SPACE_PLANE_STRESS)
        state.elastic[2] = elastic_stress_of_plastic_thickness(m->law->poisson, p->plastic_correction[0][i] +
                                                                                    p->plastic_correction[1][i]);
    deviator(state.relative), deviator(state.elastic);
    for (int c = 0; c < SYM_MAX; c++) state.relative[c] -= back[c];
    state.bound = law_flow_stress(m->law, lanes_broadcast(state.strain), lanes_broadcast(T), &slope)[0];
    return state;
}

/* Returns the angle by which the direction of plastic flow of a point turns in a load step [rad], between the onset of
 * flow and the end of the step. Flow begins where the trial stress, which grows in proportion from the start of the
 * step, reaches the yield surface. start, end: states of the point at the start and the end of the step, in which the
 * point must flow. */
static real turn_between(const struct flow_start *start, const struct flow_start *end)
{
    real trial[SYM_MAX], first[SYM_MAX];
    for (int c = 0; c < SYM_MAX; c++) trial[c] = end->elastic[c] - start->elastic[c];
    const real A = tensor_scalar_product(trial, trial), B = tensor_scalar_product(start->relative, trial);
    const real C = real_min(tensor_scalar_product(start->relative, start->relative) - square(start->bound) / 1.5, 0);
    const real share = A > 0 ? real_min((sqrt(B * B - A * C) - B) / A, 1) : 0;
    for (int c = 0; c < SYM_MAX; c++) first[c] = start->relative[c] + share * trial[c];
    const real size = sqrt(tensor_scalar_product(first, first) * tensor_scalar_product(end->relative, end->relative));
    return size > 0 ? acos(real_max(-1, real_min(1, tensor_scalar_product(first, end->relative) / size))) : 0;
}

/* Updates the largest turn of the direction of flow and the largest fall of the yield stress in *s by those of particle
 * i of p, which flows in the load step number `load_step` from the state *start to the state *end. */
static void record_point(struct statics *s, const struct particles *p, int64_t i, const struct flow_start *start,
                         const struct flow_start *end, int64_t load_step)
{
    const real angle = p->dim > 1 ? turn_between(start, end) : 0;
    const real share = 1 - end->bound / real_max(start->bound, 1e-300);
    if (angle > s->turn.angle) {
        s->turn = (struct plastic_flow_direction_change){.angle = angle, .step = load_step};
        particle_reference_position(p, i, s->turn.position);
    }
    if (share > s->softening.share) {
        s->softening = (struct plastic_flow_thermal_softening){.share = share, .step = load_step};
        particle_reference_position(p, i, s->softening.position);
    }
}

void plastic_flow_measure_direction_change(struct statics *s, const struct particles *p,
                                           const struct elastic *elastic_constants, int64_t load_step)
{
    if (!p->mesh_stress[0]) return;
    const bool known = s->flow_start != NULL;
    if (!known) s->flow_start = NEW("statics.flow_start", p->n, struct flow_start);
    for (int64_t i = 0; i < p->n; i++) {
        const struct elastic *own = &elastic_constants[p->material[i]];
        if (!own->law) continue;
        const struct flow_start now = point_state(p, own, i);
        if (known && now.strain > s->flow_start[i].strain) record_point(s, p, i, &s->flow_start[i], &now, load_step);
        s->flow_start[i] = now;
    }
}

void plastic_flow_warn_of_inexact_stress(const struct plastic_flow_direction_change *turn, int dim,
                                         struct warnings *warnings)
{
    const real angle = turn->angle / DEGREE;
    char text[320];
    snprintf(
        text, sizeof text,
        "the direction of plastic flow turns by %.0f degrees within load step %lld, near (%s) m, so stresses there "
        "may be off by %.0f %%: use more load steps (steps.number; twice as many halve the error)",
        angle, (long long)turn->step, position_text(turn->position, dim, 4).text,
        real_min(ERROR_PER_DEGREE * angle, ERROR_MOST));
    if (angle > TURN_MOST) warnings_add_and_print(warnings, text);
}

void plastic_flow_warn_of_thermal_softening(const struct plastic_flow_thermal_softening *softening, int dim,
                                            struct warnings *warnings)
{
    char text[400];
    snprintf(text, sizeof text,
             "heat of plastic work lowers the yield stress by %.3g %% within load step %lld near (%s) m, so plastic "
             "flow localises in one row of cells, and plastic strains depend on the spacing. Under slow loads heat "
             "would spread: remove specific_heat; for fast loads use solver: explicit",
             100 * softening->share, (long long)softening->step, position_text(softening->position, dim, 4).text);
    if (softening->share > SOFTENING_MOST) warnings_add_and_print(warnings, text);
}
