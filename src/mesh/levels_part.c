/* Coarse cells during a simulation: chooses initial coarsening levels, and changes the levels as cracks grow and
 * stresses change. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "mesh/mesh_part.h"

/* Ranges around cells that must be of level 0 (the finest) beyond those that conversion requires; empirical [cells of
 * level 0]. ZONE_MORE: around peridynamic particles, a margin for crack growth between two changes of levels.
 * ZONE_LATE: further range within which cells are not merged. AROUND_STRESS: around stressed cells. AROUND_RING: around
 * the rings (integration paths) of sif probes [spacings], since crack tips move between two checks. */
enum { ZONE_MORE = 5, ZONE_LATE = 4, AROUND_STRESS = 10, AROUND_RING = 10 };
/* Additional range of level 0 (the finest) between slits and coarse cells [cells]. It is empirical: with coarse cells
 * nearer, two slits 5 to 18 spacings apart with faces in contact gained energy without bound, a single slit did not;
 * the cause is not known. */
enum { FLANK_MORE = 2 };
#define SPLITS 0.5  /* stress at which cells split, divided by the stress at which points convert [1] */
#define MERGES 0.25 /* stress below which cells may merge, divided by the stress at which points convert [1] */
/* Largest kinetic and strain energy per mass that may be lost where cells become coarser, divided by the mean energy
 * per mass of the body [1]. */
#define ROUGH 0.01
/* CHECK_STEPS: number of steps between checks whether cells may merge to coarser cells. CALM_CHECKS: number of
 * consecutive checks in which no finest cells are required nearby before a cell may merge. */
enum { CHECK_STEPS = 256, CALM_CHECKS = 2 };

/* ---- set-up ------------------------------------------------------------------------------------------------------ */

/* Returns the edge h of a cell with lumped mass whose waves along an axis have the same dispersion as those in a
 * lattice of bonds [m]: h^2 = (sum xi^6/r^3)/(sum xi^4/r^3) over the bonds of length r, with their component xi along
 * the axis. Without bonds, returns the edge of cells of level 0 (the finest). s: scene. */
static real dispersion_edge(const struct scene *s)
{
    const int reach = (int)s->horizon, planes = s->dim > 1 ? reach : 0, layers = s->dim > 2 ? reach : 0;
    real above = 0, below = 0;
    if (s->method == METHOD_MPM) return 2 * s->spacing;
    for (int k = -layers; k <= layers; k++)
        for (int j = -planes; j <= planes; j++)
            for (int i = -reach; i <= reach; i++) {
                const real r2 = i * i + j * j + k * k;
                if (r2 == 0 || r2 > square(s->horizon)) continue;
                above += pow(i, 6) / (r2 * sqrt(r2));
                below += pow(i, 4) / (r2 * sqrt(r2));
            }
    return s->spacing * sqrt(above / below);
}

/* Returns the index of the cell of level 0 (the finest) of the mesh that contains particle i of p in the reference
 * configuration. It is always a cell of the grid, while mesh->place may refer to an extra cell, into which a slit (a
 * gap for a pre-crack) has divided it. */
static int64_t cell_of(const struct mesh *mesh, const struct particles *p, int64_t i)
{
    int64_t I = 0;
    for (int d = 0; d < p->dim; d++)
        I += (grid_cell_index_at(&mesh->grid, d, p->X[d][i]) - mesh->grid.first[d]) * mesh->grid.stride[d];
    return I;
}

/* Sets demand[I] = 1, which requires level 0 (the finest), for the mesh cells I of the reference frame `frame` beside
 * those planes of symmetry in `loads` that do not pass through nodes of all levels. */
static void demand_mirrors(const struct lagrangian_mesh *frame, const struct loads *loads, uint8_t *demand)
{
    const struct mesh_levels *l = &frame->levels;
    const struct grid *g = &l->fine->grid;
    for (int b = 0; b < loads->n; b++) {
        const struct boundary *mirror = loads->load[b].boundary;
        const int a = mirror->axis;
        if (mirror->kind != BOUNDARY_MIRROR) continue;
        const real at = (mirror->at - grid_node_position(g, a, l->offset[0][a])) /
                        (g->h * (real)mesh_levels_time_steps_per_cycle(l));
        if (fabs(at - nearbyint(at)) < 1e-6) continue;
        for (int64_t I = 0; I < g->n; I++) {
            const real x = grid_node_position(g, a, I / g->stride[a] % g->count[a]);
            if (fabs(x + 0.5 * g->h - mirror->at) < 1.6 * g->h) demand[I] = 1;
        }
    }
}

/* Sets demand[I] = 1, which requires level 0 (the finest), for the cells I of the mesh beside slits (gaps for
 * pre-cracks). A slit doubles the nodes of level 0 that it passes; nodes of coarse cells cannot be doubled. */
static void demand_slits(const struct mesh *mesh, uint8_t *demand)
{
    for (int64_t I = 0; I < mesh->slits.first && mesh->slits.split; I++)
        for (int c = 0; c < 1 << mesh->grid.dim && mesh->slits.split[I]; c++) demand[I - mesh->corner[c]] = 1;
}

/* Finds the cells I of level 0 (the finest) of the mesh of `frame` inside the circle `ring`, a contour of a probe of
 * stress-intensity factors, and up to AROUND_RING spacings outside it. Returns true if one of them is part of a coarse
 * cell at present. demand[I]: set to 1 for these cells, which requires level 0; NULL if it is not needed. */
static bool ring_cells(const struct lagrangian_mesh *frame, const struct finest_cells_disc *ring, uint8_t *demand)
{
    const struct mesh_levels *l = &frame->levels;
    const struct grid *g = &l->fine->grid;
    const real radius = ring->radius + AROUND_RING * frame->spacing;
    int64_t from[2], to[2];
    bool coarse = false;
    for (int d = 0; d < 2; d++) {
        from[d] = grid_cell_index_at(g, d, ring->place[d] - radius) - g->first[d];
        to[d] = grid_cell_index_at(g, d, ring->place[d] + radius) - g->first[d];
        from[d] = from[d] > 0 ? from[d] : 0, to[d] = to[d] < g->count[d] - 2 ? to[d] : g->count[d] - 2;
    }
    for (int64_t j = from[1]; j <= to[1]; j++)
        for (int64_t i = from[0]; i <= to[0]; i++) {
            const real x = grid_node_position(g, 0, i) + 0.5 * g->h, y = grid_node_position(g, 1, j) + 0.5 * g->h;
            const int64_t I = i * g->stride[0] + j * g->stride[1];
            if (square(x - ring->place[0]) + square(y - ring->place[1]) > square(radius)) continue;
            coarse |= l->level[I] > 0;
            if (demand) demand[I] = 1;
        }
    return coarse;
}

/* Finds the cells I of level 0 (the finest) of the mesh of `frame` inside and around the contours of all probes of
 * stress-intensity factors. Returns true if one of them is part of a coarse cell at present. demand[I]: set to 1 for
 * these cells, which requires level 0; NULL if it is not needed. The probes need accelerations in every step, and nodes
 * of coarse cells have them in some steps only. */
static bool rings_cells(const struct lagrangian_mesh *frame, uint8_t *demand)
{
    bool coarse = false;
    for (int k = 0; k < frame->rings; k++) coarse |= ring_cells(frame, &frame->ring[k], demand);
    return coarse;
}

/* Sets bits of mark[I] for all cells I of level 0 (the finest) of l that are marked in more[I]; does nothing if `more`
 * is NULL. */
static void marks_add(const struct mesh_levels *l, const uint8_t *more, uint8_t *mark)
{
    for (int64_t I = 0; I < l->fine->grid.n && more; I++) mark[I] |= more[I];
}

/* Returns flags [fine->grid.n] that are 1 for the cells of `reference` that must be of level 0 (the finest). With l =
 * reference->levels and R = l.roomy_cells + more, these are the cells within R cells of peridynamic particles of p and
 * of the cells requested in l.wanted; within R + FLANK_MORE cells of slits if there are several, within one cell of a
 * single slit; and within one cell of particles on which `loads` act, of probes of stress-intensity factors and of
 * planes of symmetry that are not on nodes. Release the flags with memory_free. */
static uint8_t *demand_make(const struct lagrangian_mesh *reference, const struct particles *p,
                            const struct loads *loads, int more)
{
    const struct mesh_levels *l = &reference->levels;
    const int64_t n = l->fine->grid.n;
    uint8_t *demand = NEW("levels.demand", n, uint8_t), *fixed = NEW("levels.fixed", n, uint8_t);
    uint8_t *flank = NEW("levels.flank", n, uint8_t);
    for (int64_t I = 0; I < n; I++) demand[I] = l->wanted[I] != WANTED_NOT;
    for (int64_t k = 0; k < p->n_of[KIND_PD]; k++) demand[cell_of(l->fine, p, p->list[KIND_PD][k])] = 1;
    mesh_levels_mark_cells_near_marked_cells(l, demand, l->roomy_cells + more);
    demand_slits(l->fine, flank);
    mesh_levels_mark_cells_near_marked_cells(l, flank,
                                             reference->source.slits > 1 ? l->roomy_cells + more + FLANK_MORE : 1);
    marks_add(l, flank, demand);
    memory_free(flank);
    for (int b = 0; b < loads->n; b++)
        for (int64_t k = 0; k < loads->load[b].n; k++) fixed[cell_of(l->fine, p, loads->load[b].particle[k])] = 1;
    demand_mirrors(reference, loads, fixed);
    rings_cells(reference, fixed);
    mesh_levels_mark_cells_near_marked_cells(l, fixed, 1);
    marks_add(l, fixed, demand);
    memory_free(fixed);
    return demand;
}

/* Sets demand[I] = 1 for the cells I of level 0 (the finest) of l that are part of cells of `level` with a mark, and
 * for those within AROUND_STRESS cells of them. mark: flags of the cells of `level` (cells with the edge of 2^level
 * finest cells). */
static void demand_add(const struct mesh_levels *l, int level, const uint8_t *mark, uint8_t *demand)
{
    const struct grid *fine = &l->fine->grid, *g = &mesh_levels_mesh_of_level_read_only(l, level)->grid;
    uint8_t *own = NEW("levels.stressed", fine->n, uint8_t);
    for (int64_t I = 0; I < fine->n; I++) {
        int64_t J = 0;
        if (l->level[I] != level) continue;
        for (int d = 0; d < g->dim; d++)
            J += (((I / fine->stride[d] % fine->count[d] - l->offset[0][d]) >> level) + l->offset[level][d]) *
                 g->stride[d];
        own[I] = mark[J];
    }
    mesh_levels_mark_cells_near_marked_cells(l, own, AROUND_STRESS);
    for (int64_t I = 0; I < fine->n; I++) demand[I] |= own[I];
    memory_free(own);
}

/* Returns flags [fine->grid.n] that are 1 for the mesh cells of `frame` with a stress above `share` [1] times the
 * stress at which points convert, and for cells around them. Returns NULL if no cell has such a stress. all: true to
 * test all cells, false for coarse cells only. Release the flags with memory_free. */
static uint8_t *stressed_cells(const struct lagrangian_mesh *frame, real share, bool all)
{
    const struct mesh_levels *l = &frame->levels;
    uint8_t *cells = NULL;
    for (int level = all ? 0 : 1; level <= l->n; level++) {
        const struct mesh *mesh = mesh_levels_mesh_of_level_read_only(l, level);
        uint8_t *mark = NEW("levels.mark", mesh->grid.n, uint8_t);
        mesh_cells_mark(mesh, frame->elastic, share, all, mark, frame->finite);
        if (memchr(mark, 1, (size_t)mesh->grid.n)) {
            if (!cells) cells = NEW("levels.cells", l->fine->grid.n, uint8_t);
            demand_add(l, level, mark, cells);
        }
        memory_free(mark);
    }
    return cells;
}

/* Returns true if a cell of level 0 (the finest) of l would have a higher level in level[fine->grid.n] than at present,
 * i.e. become part of a coarser cell. */
static bool any_merges(const struct mesh_levels *l, const uint8_t *level)
{
    bool any = false;
    for (int64_t I = 0; I < l->fine->grid.n; I++) any |= level[I] > l->level[I];
    return any;
}

/* Reduces limit[I], the largest coarsening level (0: finest) allowed for cell I of `reference`, to reference->room[I],
 * the largest level that the thickness of the body allows there. Does nothing if the scene prescribes the number of
 * levels. */
static void limit_by_room(const struct lagrangian_mesh *reference, uint8_t *limit)
{
    for (int64_t I = 0; I < reference->mesh.grid.n && reference->room && reference->room_limits; I++)
        if (reference->room[I] < limit[I]) limit[I] = reference->room[I];
}

/* Computes level[I], the coarsening levels (0: finest) of all finest cells I of `reference` for the next steps.
 * demand[I]: not 0 for cells that must be of level 0; limit[I]: largest level allowed, reduced here for cells that
 * would lose more energy per mass by becoming coarser than the share ROUGH (1 %) of the present energy per mass of the
 * body; p: particles; mass: mass of the body [kg]. */
static void next_levels(struct lagrangian_mesh *reference, const struct particles *p, real mass, const uint8_t *demand,
                        uint8_t *limit, uint8_t *level)
{
    struct mesh_levels *l = &reference->levels;
    mesh_levels_compute_coarsest_admissible_levels(l, p, demand, limit, level);
    if (!any_merges(l, level)) return;
    const real most =
        ROUGH * (lagrangian_mesh_kinetic_energy(reference) + lagrangian_mesh_strain_energy(reference, p)) / mass;
    mesh_levels_prolong_motion_to_all_finest_nodes(l);
    while (mesh_levels_limit_coarsening_by_energy_loss(l, level, most, limit))
        mesh_levels_compute_coarsest_admissible_levels(l, p, demand, limit, level);
}

void mesh_levels_update_lists_of_loaded_nodes(struct lagrangian_mesh *reference, const struct particles *p,
                                              const struct bonds *bonds, struct loads *loads)
{
    struct mesh_levels *l = &reference->levels;
    for (int k = 1; k <= l->n; k++)
        loads_find_driven_nodes_of_coarse_cells(loads, &l->at[k].held, &l->at[k].mesh.grid, p);
    lagrangian_mesh_list_bonded_or_loaded_points(reference, p, bonds, loads);
}

/* Changes the coarsening levels of the cells of the run to level[I] (0: finest; I: index of the finest cell). The
 * kinetic and strain energy that the change loses is added to run->damped, so that the energy balance includes it. */
static void change(struct run *run, const uint8_t *level)
{
    struct lagrangian_mesh *reference = run->frame;
    /* before the first step velocities and displacements are at the same time */
    const real dt = run->clock.step > 0 ? run->clock.dt : 0;
    mesh_levels_shift_velocities_half_step(&reference->levels, &run->part, reference->elastic, reference->finite, dt);
    const real before =
        lagrangian_mesh_kinetic_energy(reference) + lagrangian_mesh_strain_energy(reference, &run->part);
    mesh_levels_change_refinement(&reference->levels, &run->part, &reference->source, level);
    mesh_levels_update_lists_of_loaded_nodes(reference, &run->part, &run->bonds, &run->loads);
    run->damped +=
        before - lagrangian_mesh_kinetic_energy(reference) - lagrangian_mesh_strain_energy(reference, &run->part);
    mesh_levels_shift_velocities_half_step(&reference->levels, &run->part, reference->elastic, reference->finite, -dt);
}

status mesh_levels_make_coarse_cells(struct run *run, bool levels_from_checkpoint)
{
    struct lagrangian_mesh *reference = run->frame;
    const struct scene *s = run->scene;
    real density[UINT8_MAX], fastest = 0;
    for (int m = 0; m < s->materials; m++) density[m] = s->material[m].density;
    const struct levels_choice choice =
        mesh_levels_choose_level_count(reference, &run->part, s, run->clock.dt_critical);
    TRY(mesh_levels_make_over_finest_mesh(&reference->levels, choice.levels, &reference->mesh, &run->part,
                                          &reference->source, density));
    memory_free(reference->coarse);
    reference->coarse = NEW("engine.coarse_elastic", s->materials, struct elastic);
    for (int m = 0; m < s->materials; m++) {
        reference->coarse[m] = reference->elastic[m];
        reference->coarse[m].trigger *= SPLITS;
        fastest = real_max(fastest, s->material[m].wave_speed);
    }
    if (reference->levels.n == 0) {
        mesh_check_all_initially_finest_cells_are_filled(reference, NULL);
        return OK;
    }
    mesh_levels_match_wave_dispersion_of_bonds(&reference->levels, dispersion_edge(s), fastest, run->clock.dt);
    /* a point converts with its neighbours, these get bonds, and the neighbourhoods at their other ends extend one
     * horizon more */
    const real reach = (s->model == MODEL_BOND ? 1.0 : 1.5) * s->horizon;
    const int safe = (int)ceil(reach) + 1;
    mesh_levels_set_conversion_and_refine_distances(&reference->levels, safe, safe + (int)ceil(0.5 * s->horizon));
    for (int k = 1; k <= reference->levels.n; k++)
        loads_find_driven_nodes_of_coarse_cells(&run->loads, &reference->levels.at[k].held,
                                                &reference->levels.at[k].mesh.grid, &run->part);
    if (levels_from_checkpoint) return OK;
    uint8_t *demand = demand_make(reference, &run->part, &run->loads, ZONE_MORE);
    uint8_t *stressed = stressed_cells(reference, SPLITS, true),
            *level = NEW("levels.next", reference->mesh.grid.n, uint8_t);
    marks_add(&reference->levels, stressed, demand);
    uint8_t *limit = NEW("levels.limit", reference->mesh.grid.n, uint8_t);
    array_fill_bytes(limit, reference->levels.n, reference->mesh.grid.n, 1);
    limit_by_room(reference, limit);
    next_levels(reference, &run->part, run->mass, demand, limit, level);
    if (mesh_check_all_initially_finest_cells_are_filled(reference, level)) change(run, level);
    memory_free(limit);
    run->damped = 0; /* the run starts with the energy of the coarse cells */
    memory_free(demand);
    memory_free(stressed);
    memory_free(level);
    return OK;
}

/* ---- in a run ---------------------------------------------------------------------------------------------------- */

/* Returns true if, in the last computation of forces, a point of a coarse cell of l may have exceeded SPLITS times the
 * stress at which points convert. */
static bool any_stressed(const struct mesh_levels *l)
{
    bool any = false;
    for (int level = 1; level <= l->n; level++)
        for (int64_t r = 0; r < l->at[level].mesh.runs; r++) any |= l->at[level].mesh.run[r].stressed;
    return any;
}

/* Computes limit[I], the largest coarsening level (0: finest) that each cell I of `reference` may have after the next
 * change. Cells may always become finer. They may become coarser only in calls with `checks` true, and only after
 * CALM_CHECKS consecutive such calls in which neither cracks and stresses of p nor loads required level 0 nearby. */
static void limits_find(struct lagrangian_mesh *reference, const struct particles *p, const struct loads *loads,
                        bool checks, uint8_t *limit)
{
    struct mesh_levels *l = &reference->levels;
    const int64_t n = l->fine->grid.n;
    array_copy(limit, l->level, n, 1);
    if (!checks) return;
    uint8_t *late = demand_make(reference, p, loads, ZONE_MORE + ZONE_LATE),
            *stressed = stressed_cells(reference, MERGES, true);
    marks_add(l, stressed, late);
    for (int64_t I = 0; I < n; I++) {
        l->calm[I] = late[I] ? 0 : l->calm[I] < CALM_CHECKS ? l->calm[I] + 1 : CALM_CHECKS;
        if (l->calm[I] == CALM_CHECKS) limit[I] = (uint8_t)l->n;
    }
    limit_by_room(reference, limit);
    memory_free(late);
    memory_free(stressed);
}

/* Sets FLAG_LOST_BOND again for material points of p that lost a bond when coarse cells were too near for their
 * conversion to peridynamic particles (cells with WANTED_LOST_BOND in l->wanted). These coarse cells have been split
 * since then. Flags all material points of such a cell, sets l->returned, and clears l->wanted. */
static void lost_bonds_return(struct mesh_levels *l, struct particles *p)
{
    if (!l->any_wanted) return;
    for (int64_t k = 0; k < p->n_of[KIND_MPM]; k++) {
        const int32_t i = p->list[KIND_MPM][k];
        if (l->wanted[cell_of(l->fine, p, i)] == WANTED_LOST_BOND) p->flag[i] |= FLAG_LOST_BOND, l->returned = true;
    }
    array_fill_bytes(l->wanted, WANTED_NOT, l->fine->grid.n, 1);
}

bool mesh_levels_may_change_before_step(const struct mesh_levels *l, int64_t step)
{
    return l->n > 0 && step > 0 && step % mesh_levels_time_steps_per_cycle(l) == 0;
}

uint8_t *mesh_levels_choose_level_of_each_cell(struct lagrangian_mesh *reference, const struct particles *p,
                                               const struct loads *loads, int64_t step, real mass)
{
    struct mesh_levels *l = &reference->levels;
    const bool checks = step % CHECK_STEPS == 0;
    mesh_levels_copy_motion_to_ghost_nodes(l);
    uint8_t *stressed = any_stressed(l) ? stressed_cells(reference, SPLITS, false) : NULL;
    if (!checks && !stressed && !l->any_wanted && !rings_cells(reference, NULL)) return NULL;
    const int64_t n = l->fine->grid.n;
    uint8_t *demand = demand_make(reference, p, loads, ZONE_MORE), *limit = NEW("levels.limit", n, uint8_t);
    uint8_t *level = NEW("levels.next", n, uint8_t);
    marks_add(l, stressed, demand);
    limits_find(reference, p, loads, checks, limit);
    next_levels(reference, p, mass, demand, limit, level);
    memory_free(demand);
    memory_free(limit);
    memory_free(stressed);
    return level;
}

void mesh_levels_change_cell_levels(struct run *run, const uint8_t *new_cell_level)
{
    struct mesh_levels *l = &run->frame->levels;
    if (!arrays_equal(new_cell_level, l->level, l->fine->grid.n, 1)) change(run, new_cell_level);
    lost_bonds_return(l, &run->part);
    l->any_wanted = false;
}

/* Requests finer cells around particle i of p (in l->wanted) if it is flagged for conversion to a peridynamic particle
 * and coarse cells are too near (l->safe). If they are so near that bonds of the particle would reach them, also
 * removes its flags, which delays the conversion of a material point until the cells have been split. */
static void point_guard(struct mesh_levels *l, struct particles *p, int64_t i)
{
    const unsigned marks = FLAG_STRESSED | FLAG_NEAR | FLAG_LOST_BOND;
    const int64_t cell = cell_of(l->fine, p, i);
    if (!(p->flag[i] & marks) || l->safe[cell] == DISTANCE_ROOMY) return;
    const bool waits = l->safe[cell] == DISTANCE_UNSAFE && p->kind[i] == KIND_MPM;
    const uint8_t wanted = waits && p->flag[i] & FLAG_LOST_BOND ? WANTED_LOST_BOND : WANTED_STRESS;
    if (l->wanted[cell] < wanted) l->wanted[cell] = wanted;
    l->any_wanted = true;
    if (waits) p->flag[i] &= (uint8_t)~marks;
}

void coarse_cells_delay_conversion_of_nearby_points(struct mesh_levels *l, struct particles *p)
{
    l->returned = false;
    if (l->n == 0 || !particles_any_is_flagged_for_conversion(p)) return;
    for (int64_t first = 0; first < p->n; first += LANES) {
        if (!(eight_bytes_as_word(p->flag + first) & EIGHT_TIMES(FLAG_STRESSED | FLAG_NEAR | FLAG_LOST_BOND))) continue;
        for (int64_t i = first; i < first + LANES && i < p->n; i++) point_guard(l, p, i);
    }
}

/* ---- energies ---------------------------------------------------------------------------------------------------- */

/* Returns the kinetic energy of all nodes of the reference frame `reference` [J]: of the mesh of the undeformed body
 * and of the coarse cells of all levels. */
real lagrangian_mesh_kinetic_energy(const struct lagrangian_mesh *reference)
{
    return mesh_kinetic(&reference->mesh) + mesh_levels_kinetic_energy_of_coarse_levels(&reference->levels);
}

real lagrangian_mesh_strain_energy(struct lagrangian_mesh *reference, const struct particles *p)
{
    return mesh_strain(&reference->mesh, p, reference->elastic, reference->finite) +
           mesh_levels_strain_energy_of_coarse_cells(&reference->levels, p, reference->elastic, reference->finite);
}
