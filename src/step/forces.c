/* Internal forces at fixed positions. */

#include "mesh/mesh_part.h"
#include "loads/mirrors.h"

void run_compute_internal_forces(struct run *run)
{
    const bool has_mesh = run->frame->mesh.points > 0;
    if (has_mesh) lagrangian_mesh_move_bonded_or_loaded_points(run->frame, &run->part);
    loads_update_mirror_images_of_particles(&run->loads, &run->part);
    loads_clear_forces_of_loaded_particles(&run->loads, &run->part);
    bond_forces(run->kernels.bond_force, &run->bonds, &run->part, &run->source.limit, NULL);
    if (has_mesh) lagrangian_mesh_compute_nodal_forces(run->frame, &run->part, run->clock.step);
}
