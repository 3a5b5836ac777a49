/* Selects the kernels (inner loops of forces and transfers) of a run by dimension, model, shape function and transfer
 * scheme, once at set-up. Defines the table of all kernels that are compiled for one set of machine instructions. */
#include "kernels/simd/set.h"

void kernels_choose(struct kernels *k, int dim, enum pd_model model, enum shape shape, enum transfer transfer)
{
    const bool states = state_force_table[dim][model];
    k->bond_force = states ? state_force_table[dim][model] : bond_force_table[dim][model];
    k->bond_energy = states ? state_energy_table[dim][model] : bond_energy_table[dim][model];
    k->bond_stress = states ? state_stress_table[dim][model] : bond_stress_table[dim][model];
    k->pd_move = pd_move_table[dim];
    k->p2g = p2g_table[dim][shape][transfer];
    k->remap = remap_table[dim][shape];
    k->turn_gather = turn_gather_table[dim][shape];
    k->turn_scatter = turn_scatter_table[dim][shape];
    k->g2p = g2p_table[dim][shape][transfer];
    k->spread = spread_table[dim][shape];
    INVARIANT(k->bond_force && k->bond_energy && k->bond_stress && k->pd_move && k->p2g && k->remap && k->g2p &&
              k->spread);
}

#define ENTRY(name) .name = name,
extern const struct kernel_set kernel_set __asm__("kernel_set_" SIMD_SET);
const struct kernel_set kernel_set = {KERNELS(ENTRY)};
