/* Softens bonds of state-based models (data/softening.h). A bond of damage d has the fraction 1 - d of its
 * weight w in the sums of both neighbourhoods, in extension and pressure alike. The weighted volumes Q remain
 * those of the intact neighbourhoods:
 *
 *     W_i = share_i/2 [A Q S_i^2 + B sum w (1 - d) e^2],   S_i = sum w (1 - d) r e/Q,   share = V/Q
 *
 * W_i is the energy of particle i, V its volume, r the length and e the extension of a bond. The weight w (1
 * - d) is stored in place of w, so that forces, energies and stresses (state_laws.h) are the exact gradient
 * of W. The damage d(k) follows the largest stretch k. It grows only where this releases energy:
 *
 *     Y = - dW/dd = w [r e (P_i + P_j) + (g_i |e_i|^2 + g_j |e_j|^2)/2] > 0,   P = A S share,  g = B share
 *
 * with e_i the extension, or the effective displacement Y - R_i xi. Without this condition a neighbourhood
 * under pressure would gain energy. The energy that a row loses in a step is added to the fracture energy at
 * once. A leap-frog step from weights w_0 at x_0 to w_1 at x_1 takes x_0 x_1 (w_0 - w_1)/2 from the energy of
 * a spring. A quadratic energy W has this product in 2 W((x_0 + x_1)/2) - (W(x_0) + W(x_1))/2. */
#include <math.h>

#include "bond_last.h"
#include "kernels/kernels.h"
#include "state_driving.h"

/* Sets the largest stretch so far of the softening bond q of row `row` (bonds of one particle) to `most` [1] and
 * reduces its weight accordingly. Breaks the bond if `most` is at the end of its softening. Returns 1 if the bond is
 * broken, else 0. b, p: all bonds and particles. */
static int64_t bond_damage(struct bonds *b, struct particles *p, int64_t row, int64_t q, real most)
{
    const struct softened *soft = &b->soft;
    soft->most[q] = (float)most;
    if (soft->most[q] >= soft->end[q]) {
        bond_end(b, p, row, q);
        return 1;
    }
    b->w[q] = soft->whole[q] *
              softening_remaining_stiffness_fraction(soft->curve, soft->onset[q], soft->end[q], soft->most[q]);
    bond_update_cached_data_after_modification(b, row, q);
    return 0;
}

/* Returns a mean of the elastic energy of the bonds of one particle over the last time step dt [s]: the energy with
 * the squares of displacements replaced by products of the displacements before and after the step [J]. When bonds are
 * damaged, this mean falls by the energy that the leap-frog step loses. row: row of b with these bonds. p: all
 * particles. */
static real row_energy_of_step(const struct bonds *b, const struct particles *p, int64_t row, real dt)
{
    return 2 * state_row_energy(b, p, row, 0.5 * dt) -
           0.5 * (state_row_energy(b, p, row, dt) + state_row_energy(b, p, row, 0));
}

/* Increases the damage of the softening bonds of one particle to that of their present stretches, where this releases
 * energy and both particles of the bond are peridynamic. (A material point whose bond begins to soften becomes
 * peridynamic in this step.) row: row of b with these bonds; limit: limits of stretch, and the time step. Sets
 * *changed to true if the damage of a bond has changed. Returns the number of bonds that break, at the end of their
 * softening. p: all particles. */
static int64_t row_soften(struct bonds *b, struct particles *p, const struct bond_limit *limit, int64_t row,
                          bool *changed)
{
    const int32_t i = b->particle[row];
    int64_t ended = 0;
    real before = NAN;
    for (int64_t k = 0; k < b->column_count[row / LANES]; k++) {
        const struct bond bond = bond_read(b, row / LANES, k, (int)(row % LANES));
        if (bond.w == 0) continue;
        const real stretch = bond_stretch_at_earlier_time(p, bond.inverse_length, i, bond.nbr, 0);
        if (!bond_is_softening(b, row / LANES, bond.entry)) {
            if (stretch > b->soft.end[bond.entry]) bond_row_block_request_softening_check(b, row / LANES);
            continue;
        }
        if (p->kind[i] != KIND_PD || p->kind[bond.nbr] != KIND_PD) continue;
        if (!(stretch > b->soft.most[bond.entry]) || !(bond_energy_release_rate_by_damage(b, p, &bond, i) > 0))
            continue;
        if (isnan(before)) before = row_energy_of_step(b, p, row, limit->dt);
        ended += bond_damage(b, p, row, bond.entry, stretch);
    }
    if (isnan(before)) return 0;
    b->fracture_energy[row] += before - row_energy_of_step(b, p, row, limit->dt);
    *changed = true;
    return ended;
}

int64_t state_soften(struct bonds *b, struct particles *p, const struct bond_limit *limit, bool *changed)
{
    int64_t ended = 0;
    bool any = false;
#pragma omp parallel for schedule(dynamic, 8) reduction(+ : ended) reduction(| : any)
    for (int64_t g = 0; g < b->row_blocks; g++)
        for (int64_t row = g * LANES; b->soft.begun[g] && row < b->rows && row < (g + 1) * LANES; row++)
            ended += row_soften(b, p, limit, row, &any);
    *changed = any;
    return ended;
}
