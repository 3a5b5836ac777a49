/* Computes constants of flow laws (plasticity) that follow from those given in the input file. */
#include "data/law.h"

#include <math.h>

#define FLOW_PROPERTIES(upper, lower, word, own_yield, steep) [FLOW_##upper] = {word, own_yield, steep},
const struct flow_properties flow_properties[FLOW_LAWS] = {FLOWS(FLOW_PROPERTIES)};

/* Computes the straight line through each segment k of the hardening curve c (yield stress as a function of plastic
 * strain): its value c->start[k] at plastic strain 0 [Pa] and its slope c->slope[k] [Pa]. The stress is constant beyond
 * the last point. */
static void curve_lines(struct flow_curve *c)
{
    const int last = c->points - 1;
    for (int k = 0; k < last; k++) {
        c->slope[k] = (c->stress[k + 1] - c->stress[k]) / (c->strain[k + 1] - c->strain[k]);
        c->start[k] = c->stress[k] - c->slope[k] * c->strain[k];
    }
    c->slope[last] = 0, c->start[last] = c->stress[last];
}

void flow_law_compute_derived_constants(struct law *law, real yield_stress, real young, real poisson, real shear,
                                        real density)
{
    if (!law->given) return;
    law->young = young, law->poisson = poisson, law->shear = shear;
    law->yield = law->flow == FLOW_JOHNSON_COOK ? law->johnson_cook.A : yield_stress;
    if (law->flow == FLOW_TABLE) {
        curve_lines(&law->table);
        law->yield = law->table.stress[0];
    }
    law->heating = law->specific_heat > 0 ? law->taylor_quinney / (density * law->specific_heat) : 0;
    /* Powers of the plastic strain have an infinite slope at 0. With at most 3 G, a first step beyond the elastic range
     * becomes half plastic; it matters below a strain of about 3e-5, where the slope of metals is larger. */
    law->steepest = flow_properties[law->flow].steep ? 1.5 * young / (1 + poisson) : INFINITY;
    law->rate_sensitivity = law->flow == FLOW_JOHNSON_COOK ? law->johnson_cook.C : 0;
    law->reference_rate = law->flow == FLOW_JOHNSON_COOK ? law->johnson_cook.eps0 : 0;
}
