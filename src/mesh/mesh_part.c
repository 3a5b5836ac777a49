/* Registers the mesh of the undeformed body with the engine: defines part_frame, its entry in the table of modules
 * (struct part), with functions that free it, write results and warnings, and save or load its restart data. */
#include "mesh/mesh_part.h"
#include "base/memory.h"
#include "run/part.h"

static void frame_free_all(struct run *run)
{
    struct lagrangian_mesh *f = run->frame;
    memory_free(f->elastic), memory_free(f->coarse), memory_free(f->room), memory_free(f->choice);
    mesh_levels_free(&f->levels), mesh_free(&f->mesh), cells_without_particles_free(&f->hollow), memory_free(f->ring);
    coarse_cell_points_free(&f->shown);
}

/* Writes to the summary j the number of cells of each coarsening level (0: finest) of the run, and how often the levels
 * have changed. Writes nothing if no coarse cells are possible. */
static void put_levels(const struct run *run, struct json *j)
{
    const struct mesh_levels *l = &run->frame->levels;
    if (l->n == 0) return;
    json_begin_object_or_list(j, "levels", '{');
    json_begin_object_or_list(j, "cells", '[');
    for (int level = 0; level <= l->n; level++) json_write_integer(j, NULL, mesh_levels_count_cells_of_level(l, level));
    json_end_object_or_list(j, ']');
    json_write_integer(j, "changes", l->changes);
    json_end_object_or_list(j, '}');
}

static status frame_state(struct run *run, struct archive *a)
{
    struct lagrangian_mesh *f = run->frame;
    if (a->scope == ARCHIVE_REBUILD) return OK;
    TRY(mesh_save_or_load_node_motion(&f->mesh, a));
    TRY(mesh_levels_save_or_load(&f->levels, &run->part, &f->source, a));
    return active_set_save_or_load(&f->mesh.active, "mesh", a);
}

const struct part part_frame = {PART(frame, lagrangian_mesh), .free = frame_free_all, .summary = put_levels,
                                .state = frame_state, .warn = mirror_planes_warn_if_not_fitting_grid_or_mesh};
