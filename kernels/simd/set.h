/* List of the functions and tables in a set of kernels (kernel.h): all that kernels.h, law_update.h and microbench.h
 * declare. */
#ifndef CLEAVE_KERNELS_SET
#define CLEAVE_KERNELS_SET

#include "kernels/kernels.h"
#include "kernels/laws/law_update.h"
#include "kernels/microbench/microbench.h"

/* clang-format off */
#define KERNELS(X)                                                                                                     \
    X(bond_force_table) X(bond_energy_table) X(bond_stress_table) X(state_force_table) X(state_energy_table)           \
    X(state_stress_table) X(state_precompute_table) X(bond_forces) X(bond_break_row_block) X(bond_fade)                \
    X(bonds_begin_to_soften) X(bonds_update_softening) X(bonds_open_beyond_onset) X(bonds_end_softened)                \
    X(state_soften) X(bond_end)                                                                                        \
    X(bond_restore_entry) X(bond_break_entry) X(bond_row_block_stretch) X(state_row_energy)                            \
    X(bond_plastic_work) X(pd_move_table) X(kernels_choose) X(particles_diverged)                                      \
    X(p2g_table) X(remap_table) X(turn_gather_table) X(turn_scatter_table) X(g2p_table) X(spread_table)                \
    X(corotating_groups_compute_spins) X(corotating_groups_restore_angular_momentum)                                   \
    X(law_update) X(grid_clear) X(points_add_mean_dilatation)                                                          \
    X(grid_advance) X(grid_constrain) X(grid_remapped) X(mesh_clear) X(mesh_force) X(mesh_move) X(mesh_points_move)    \
    X(mesh_exposed_move) X(mesh_listed_move)                                                                           \
    X(mesh_exposed_force) X(mesh_points_stress) X(mesh_points_mark) X(mesh_kinetic) X(mesh_kick) X(mesh_strain)        \
    X(mesh_points_flow)                                                                                                \
    X(mesh_ends_update) X(mesh_cells_mark) X(mesh_velocity) X(mesh_points_gradient) X(bond_row_plastic_work)           \
    X(bond_row_plastic_path)                                                                                           \
    X(microbench_lattice_make) X(microbench_lattice_run) X(microbench_lattice_free) X(microbench_triad_make)           \
    X(microbench_triad_run) X(microbench_triad_free) X(microbench_points_make) X(microbench_points_run)                \
    X(microbench_points_free)
/* clang-format on */

/* Member of struct kernel_set: pointer to a function, or to the first row of a table. */
#define KERNEL_POINTER(name) __typeof__(&*name) name;
struct kernel_set {
    KERNELS(KERNEL_POINTER)
};

#endif
