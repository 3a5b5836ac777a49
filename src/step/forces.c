/* Internal forces at fixed positions. */

#include "mesh/mesh_part.h"

void run_forces(struct run *e)
{
    const bool has_mesh = e->frame->mesh.points > 0;
    if (has_mesh) frame_exposed_follow(e->frame, &e->part);
    loads_mirror(&e->loads, &e->part);
    loads_clear(&e->loads, &e->part);
    bond_forces(e->kernels.bond_force, &e->bonds, &e->part, &e->source.limit, NULL);
    if (has_mesh) frame_force(e->frame, &e->part, e->clock.step);
}
