/* Internal forces at fixed positions. */

#include "mesh/mesh_part.h"

void run_compute_forces(struct run *e)
{
    const bool has_mesh = e->frame->mesh.points > 0;
    if (has_mesh) reference_frame_update_exposed_points(e->frame, &e->part);
    loads_update_mirror_images(&e->loads, &e->part);
    loads_clear_forces(&e->loads, &e->part);
    bond_forces(e->kernels.bond_force, &e->bonds, &e->part, &e->source.limit, NULL);
    if (has_mesh) reference_frame_compute_forces(e->frame, &e->part, e->clock.step);
}
