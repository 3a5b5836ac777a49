/* Coarse cells of the mesh (levels 1, 2, ... of doubled cell edges): set-up, interpolation of nodal motion to material
 * points, sums of energy and momentum, checkpoints. */
#include "levels_parts.h"

#include <stdio.h>
#include <string.h>

#include "base/memory.h"

/* ---- set-up ------------------------------------------------------------------------------------------------------ */

/* Stores in l->offset[0] the indices of the cell of level 0 (the finest) at the lower corner of the box around all
 * particles p. */
static void corner_find(struct mesh_levels *l, const struct particles *p)
{
    const struct grid *g = &l->fine->grid;
    real low, high;
    for (int d = 0; d < g->dim; d++) {
        particles_coordinate_range(p, p->n, d, &low, &high);
        l->offset[0][d] = grid_cell_index_at(g, d, low) - g->first[d];
    }
}

/* Makes l->at[level].mesh, the mesh of a level (cells with the edge of 2^level finest cells), with all nodes that its
 * cells may have; which cells exist is determined later. source: has the number of materials; density: density of each
 * material [kg/m^3]. Returns FAILED, with a message, if the mesh has too many nodes. */
static status level_make(struct mesh_levels *l, int level, const struct mesh_source *source, const real *density)
{
    struct mesh *mesh = &l->at[level].mesh;
    const struct grid *fine = &l->fine->grid;
    struct grid like = {.dim = fine->dim, .h = fine->h * (real)(1 << level)};
    real to[DIM_MAX];
    for (int d = 0; d < fine->dim; d++) {
        like.anchor[d] = grid_node_position(fine, d, l->offset[0][d]);
        to[d] = grid_node_position(fine, d, fine->count[d]);
    }
    TRY(mesh_allocate_arrays_for_box(mesh, &like, like.anchor, to, NULL, NULL));
    for (int d = 0; d < fine->dim; d++) l->offset[level][d] = -mesh->grid.first[d];
    mesh->volume = l->fine->volume * (real)(1 << fine->dim * level);
    mesh->material = NEW("levels.material", mesh->grid.n, uint8_t);
    mesh->matched = NEW("levels.matched", mesh->grid.n + LANES, uint8_t);
    mesh->cell_mass = NEW("levels.cell_mass", source->materials, real);
    for (int m = 0; m < source->materials; m++) mesh->cell_mass[m] = density[m] * mesh->volume * (real)(1 << fine->dim);
    return OK;
}

status mesh_levels_make_over_finest_mesh(struct mesh_levels *l, int coarse_level_count, struct mesh *finest_mesh,
                                         const struct particles *p, const struct mesh_source *source,
                                         const real *density)
{
    memset(l, 0, sizeof *l);
    if (coarse_level_count == 0 || finest_mesh->points == 0) return OK;
    l->n = coarse_level_count, l->fine = finest_mesh;
    corner_find(l, p);
    l->level = NEW("levels.level", finest_mesh->grid.n + LANES,
                   uint8_t); /* with room for marks: mesh_rebuild_cells_after_level_change */
    l->calm = NEW("levels.calm", finest_mesh->grid.n, uint8_t);
    l->wanted = NEW("levels.wanted", finest_mesh->grid.n, uint8_t);
    l->safe = NEW("levels.safe", finest_mesh->grid.n, uint8_t);
    finest_mesh->level = l->level;
    for (int level = 1; level <= coarse_level_count; level++) TRY(level_make(l, level, source, density));
    mesh_levels_classify_cells_by_distance_to_coarse(l);
    return OK;
}

void mesh_levels_free(struct mesh_levels *l)
{
    for (int level = 1; level <= l->n; level++) {
        mesh_free(&l->at[level].mesh);
        memory_free(l->at[level].held.held);
        memory_free(l->at[level].ghost);
        memory_free(l->at[level].hanging);
    }
    if (l->fine) l->fine->level = NULL;
    memory_free(l->level);
    memory_free(l->calm);
    memory_free(l->wanted);
    memory_free(l->safe);
    memset(l, 0, sizeof *l);
}

/* ---- points of coarse cells -------------------------------------------------------------------------------------- */

/* Copies displacement and velocity to all ghosts of the coarse levels of l. A ghost is a node of a coarser mesh at
 * which the next finer mesh has a node, too; it moves with that finer node. */
void mesh_levels_copy_motion_to_ghost_nodes(struct mesh_levels *l)
{
    for (int level = 1; level <= l->n; level++) mesh_levels_copy_motion_to_ghosts_of_one_level(l, level);
}

void mesh_levels_prolong_motion_to_all_finest_nodes(struct mesh_levels *l)
{
    mesh_levels_copy_motion_to_ghost_nodes(l);
    if (l->n > 0) mesh_levels_interpolate_motion_into_coarse_cells(l, true);
}

void mesh_levels_prolong_motion_near_particles_only(struct mesh_levels *l)
{
    mesh_levels_copy_motion_to_ghost_nodes(l);
    if (l->n > 0) mesh_levels_interpolate_motion_into_coarse_cells(l, false);
}

bool mesh_levels_find_inverted_coarse_cell(const struct mesh_levels *l, real *X)
{
    for (int level = 1; level <= l->n; level++) {
        const struct mesh *mesh = &l->at[level].mesh;
        for (int64_t I = 0; I < mesh->grid.n; I++) {
            if (mesh->kind[I] != CELL_WHOLE || !mesh_cell_is_inverted(mesh, I)) continue;
            for (int d = 0; d < mesh->grid.dim; d++) X[d] = grid_cell_quadrature_point_coordinate(&mesh->grid, I, 0, d);
            return true;
        }
    }
    return false;
}

int64_t mesh_levels_list_cells_without_particles(const struct mesh_levels *l, int level, int64_t *cell_index)
{
    const struct mesh *mesh = &l->at[level].mesh;
    int64_t n = 0, k[DIM_MAX] = {0};
    for (int64_t I = 0; I < mesh->grid.n && l->fine->absent; I++, grid_advance_to_next_node_indices(&mesh->grid, k)) {
        bool absent = false;
        if (mesh->kind[I] != CELL_WHOLE) continue;
        for (int part = 0; part < mesh_levels_fine_cells_per_coarse_cell(l, level) && !absent; part++)
            absent = l->fine->absent[mesh_levels_nth_fine_cell_in_coarse_cell(
                l, level, mesh_levels_fine_node_of_coarse_node(l, level, k), part)];
        if (absent && cell_index) cell_index[n] = I;
        n += absent;
    }
    return n;
}

int64_t mesh_levels_count_cells_of_level(const struct mesh_levels *l, int level)
{
    int64_t cells = 0;
    if (level > 0) return l->at[level].cells;
    for (int64_t I = 0; I < l->fine->grid.n; I++) cells += mesh_cell_contributes_forces_to_nodes(l->fine, I);
    return cells;
}

/* ---- sums -------------------------------------------------------------------------------------------------------- */

/* Returns the kinetic energy of the nodes of all coarse levels of l [J], without that of level 0, the finest. */
real mesh_levels_kinetic_energy_of_coarse_levels(const struct mesh_levels *l)
{
    real sum = 0;
    for (int level = 1; level <= l->n; level++) sum += mesh_kinetic(&l->at[level].mesh);
    return sum;
}

real mesh_levels_strain_energy_of_coarse_cells(struct mesh_levels *l, const struct particles *p,
                                               const struct elastic *m, bool finite_strain)
{
    real sum = 0;
    mesh_levels_copy_motion_to_ghost_nodes(l);
    for (int level = 1; level <= l->n; level++) sum += mesh_strain(&l->at[level].mesh, p, m, finite_strain);
    return sum;
}

real mesh_levels_leapfrog_kinetic_energy_correction(const struct mesh_levels *l, real dt)
{
    real sum = 0;
    for (int level = 1; level <= l->n; level++) sum += mesh_kick(&l->at[level].mesh, dt * (real)(1 << level));
    return sum;
}

real mesh_levels_power_of_coarse_nodal_forces(const struct mesh_levels *l)
{
    real power = 0;
    for (int level = 1; level <= l->n; level++) {
        const struct grid *g = &l->at[level].mesh.grid;
        for (int64_t I = 0; I < g->n; I++)
            for (int d = 0; d < g->dim; d++) power += (real)(1 << level) * g->velocity[d][I] * g->force[d][I];
    }
    return power;
}

/* ---- checkpoints ------------------------------------------------------------------------------------------------- */

/* Copies the flags `stressed` of the rows of cells of a mesh to marks[runs]. A flag is 1 if, in the last computation of
 * forces, a point of the row may have exceeded the stress at which coarse cells are split. */
static void stressed_get(const struct mesh *mesh, uint8_t *marks)
{
    for (int64_t r = 0; r < mesh->runs; r++) marks[r] = mesh->run[r].stressed;
}
/* Sets the flags `stressed` of the rows of cells of a mesh from marks[runs], the reverse of stressed_get. */
static void stressed_put(struct mesh *mesh, const uint8_t *marks)
{
    for (int64_t r = 0; r < mesh->runs; r++) mesh->run[r].stressed = marks[r] != 0;
}

/* Saves to the archive a if a->saving, else restores from it, a flag for each row of cells of `mesh`: true if a stress
 * in the row may exceed the value at which coarse cells are split. level: coarsening level of the mesh (cells have the
 * edge of 2^level finest cells), which is part of the name of the flags in the archive. Returns FAILED if the archive
 * does not have these flags. */
static status stressed_archive(struct mesh *mesh, int level, struct archive *a)
{
    char name[48];
    uint8_t *stressed = NEW("levels.stressed", mesh->runs, uint8_t);
    stressed_get(mesh, stressed);
    snprintf(name, sizeof name, "levels/%d_stressed", level);
    const status s = mesh->runs > 0 ? a->exchange(a, name, stressed, (size_t)mesh->runs) : OK;
    stressed_put(mesh, stressed);
    memory_free(stressed);
    return s;
}

/* Rebuilds everything that follows from l->level, the coarsening level of each of the finest cells (0: not coarsened):
 * cells and masses of the meshes of all levels, interfaces between levels, and distances to coarse cells. p: particles;
 * source: materials and other data of which meshes are made. */
static void cells_from_levels(struct mesh_levels *l, const struct particles *p, const struct mesh_source *source)
{
    mesh_rebuild_cells_after_level_change(l->fine, p, source, l->level);
    mesh_levels_rebuild_coarse_cells_and_node_masses(l, p);
    mesh_levels_find_ghost_and_hanging_nodes(l);
    mesh_levels_add_dependent_node_masses_to_masters(l, false);
    mesh_levels_list_cell_runs_and_nodes_with_mass(l);
    mesh_levels_classify_cells_by_distance_to_coarse(l);
}

void mesh_levels_reconnect_coarse_to_finest_mesh(struct mesh_levels *l, const struct particles *p,
                                                 const struct mesh_source *source)
{
    uint8_t *stressed[LEVELS_MAX + 1];
    l->fine->level = l->level;
    for (int level = 1; level <= l->n; level++) {
        stressed[level] = NEW("levels.stressed", l->at[level].mesh.runs, uint8_t);
        stressed_get(&l->at[level].mesh, stressed[level]);
    }
    cells_from_levels(l, p, source);
    for (int level = 1; level <= l->n; level++) {
        stressed_put(&l->at[level].mesh, stressed[level]);
        memory_free(stressed[level]);
    }
}

/* Saves the displacements, velocities and momenta of the nodes of `mesh`, the mesh of coarsening level `level` (0:
 * finest), and the flags of its stressed cells to the archive a if a->saving, else restores them from it. Returns
 * FAILED if the archive does not have them. */
static status level_archive(struct mesh *mesh, int level, struct archive *a)
{
    real *const *field[] = {mesh->displacement, mesh->grid.velocity, mesh->grid.momentum};
    for (size_t f = 0; f < COUNT_OF(field); f++)
        for (int d = 0; d < mesh->grid.dim; d++) {
            char name[48];
            snprintf(name, sizeof name, "levels/%d_%zu_%d", level, f, d);
            TRY(a->exchange(a, name, field[f][d], (size_t)mesh->grid.n * sizeof(real)));
        }
    return stressed_archive(mesh, level, a);
}

status mesh_levels_save_or_load(struct mesh_levels *l, const struct particles *p, const struct mesh_source *source,
                                struct archive *a)
{
    if (l->n == 0) return OK;
    const size_t cells = (size_t)l->fine->grid.n;
    TRY(a->exchange(a, "levels/level", l->level, cells));
    TRY(a->exchange(a, "levels/calm", l->calm, cells));
    TRY(a->exchange(a, "levels/wanted", l->wanted, cells));
    ARCHIVE_VALUE(a, "levels/any_wanted", l->any_wanted);
    ARCHIVE_VALUE(a, "levels/changes", l->changes);
    if (!a->saving) {
        if (!mesh_levels_coarse_cells_are_consistent_and_filled(l))
            return status_set(FAILED, "cannot resume: the refinement levels in the checkpoint do not form a valid "
                                      "mesh; it is damaged, start again with --overwrite");
        cells_from_levels(l, p, source);
    }
    for (int level = 1; level <= l->n; level++) TRY(level_archive(&l->at[level].mesh, level, a));
    return OK;
}
