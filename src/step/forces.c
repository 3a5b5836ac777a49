/* Internal forces at fixed positions. */

#include "mesh/mesh_part.h"
#include "loads/mirrors.h"

void run_compute_internal_forces(struct run *e)
{
    const bool has_mesh = e->frame->mesh.points > 0;
    if (has_mesh) lagrangian_mesh_move_bonded_or_loaded_points(e->frame, &e->part);
    loads_update_mirror_images(&e->loads, &e->part);
    loads_clear_forces_of_loaded_particles(&e->loads, &e->part);
    bond_forces(e->kernels.bond_force, &e->bonds, &e->part, &e->source.limit, NULL);
    if (has_mesh) lagrangian_mesh_compute_nodal_forces(e->frame, &e->part, e->clock.step);
}
