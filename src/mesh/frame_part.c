/* Bodies in the reference frame, i.e. with a mesh of the undeformed body whose nodes move with the material: chooses
 * which bodies, makes their mesh, and advances it in a step. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "mesh/active_nodes.h"
#include "base/memory.h"
#include "grid/grid_part.h"
#include "mesh/mesh_part.h"
#include "loads/mirrors.h"

/* Largest accepted deviation of the distance of a layer of particles from a plane of symmetry from an odd number of
 * half spacings [spacings]. Allows for round-off of positions and of lengths in input files. */
#define PLANE_SHIFT_MOST 1e-3

/* ---- choice of the frame ----------------------------------------------------------------------------------------- */

/* Position of a body relative to a plane of symmetry. PLANE_FITS: its mesh has nodes on the plane. PLANE_MISFIT: its
 * layers of particles are not an odd number of half spacings away, so that the mesh has no nodes on the plane.
 * PLANE_APART: its nearest layer is farther than half a spacing away. */
enum plane_fit { PLANE_FITS, PLANE_MISFIT, PLANE_APART };

/* Returns whether the nodes of the mesh of body `body` of p fit the plane of symmetry of boundary b: PLANE_MISFIT if
 * the distance of a layer of particles from the plane is not a whole number of spacings plus a half; PLANE_APART if the
 * nearest layer is farther than half a spacing, so that the body does not reach the plane; else PLANE_FITS. spacing:
 * lattice spacing [m]; any_absent: true if not all particles of the bodies exist, so that the nearest layer is not
 * known. */
static enum plane_fit plane_fit_of(const struct particles *p, int body, const struct boundary *b, real spacing,
                                   bool any_absent)
{
    real nearest = INFINITY, shift = 0;
    for (int64_t i = 0; i < p->n; i++) {
        if (p->body[i] != body) continue;
        const real layers = fabs(p->X[b->axis][i] - b->at) / spacing - 0.5;
        nearest = real_min(nearest, layers), shift = real_max(shift, fabs(layers - nearbyint(layers)));
    }
    if (shift > PLANE_SHIFT_MOST) return PLANE_MISFIT;
    return nearest > 0.5 && nearest < INFINITY && !any_absent ? PLANE_APART : PLANE_FITS;
}

/* Returns the first boundary of scene s that is a plane of symmetry for which plane_fit_of returns `fit` for body
 * `body` of p; NULL if there is none. any_absent: true if not all particles of the bodies exist. */
static const struct boundary *plane_with_fit(const struct particles *p, const struct scene *s, int body,
                                             bool any_absent, enum plane_fit fit)
{
    for (int b = 0; b < s->boundaries; b++)
        if (s->boundary[b].kind == BOUNDARY_MIRROR &&
            plane_fit_of(p, body, &s->boundary[b], s->spacing, any_absent) == fit)
            return &s->boundary[b];
    return NULL;
}

/* Returns the reason, as a part of a message, why body number 0 of p cannot be in the reference frame (points whose
 * nodes belong to a mesh of the undeformed body); NULL if it can. Only for scenes s that do not choose the frame
 * themselves. The body must be a single piece on one lattice, with two particles per grid cell along each axis. mpm:
 * has the grid with whose nodes those of the mesh must coincide; hollow: cells whose particles were not created. The
 * text is not to be freed. */
static const char *frame_obstacle(const struct particles *p, const struct scene *s, const struct grid_method *mpm,
                                  const struct cells_without_particles *hollow)
{
    if (plane_with_fit(p, s, 0, hollow->absent, PLANE_MISFIT))
        return "a plane of symmetry is not half a spacing away from the outermost layer of particles";
    if (scene_is_dynamic(s) && plane_with_fit(p, s, 0, hollow->absent, PLANE_APART))
        return "at the start it does not touch a plane of symmetry, but may reach it later";
    const int64_t pieces = mesh_count_connected_parts(p, &mpm->field[0].grid, hollow);
    if (pieces == 0)
        return "mpm.origin or a mirror shifts the grid nodes, so that grid cells do not contain two particles in each "
               "direction";
    return pieces > 1 ? "it is in separate parts, which have contact only in the current frame" : NULL;
}

/* Returns REFUSED, with a message, if scene s has a plane of symmetry at which a body of p in the reference frame (on a
 * mesh of the undeformed body) has no nodes; else OK. */
static status planes_check(const struct lagrangian_mesh *reference, const struct particles *p, const struct scene *s)
{
    for (int body = 0; body < s->bodies; body++) {
        const struct boundary *b = reference->choice[body].reference
                                       ? plane_with_fit(p, s, body, reference->hollow.absent, PLANE_MISFIT)
                                       : NULL;
        if (b)
            return status_set(REFUSED,
                              "boundary %s: body %s has no layer of particles at half a spacing from this plane of "
                              "symmetry, so the reference frame has no nodes there; choose particles.spacing so that "
                              "the body is a whole number of spacings wide, or mpm.frame: current",
                              b->name, s->body[body].name);
    }
    return OK;
}

/* Adds a warning to *to if body `body` of p, which is in the reference frame (on a mesh of the undeformed body), does
 * not reach a plane of symmetry of scene s at the start. In this frame only nodes of the undeformed body on the plane
 * are constrained, so that the plane never acts on such a body, even if the body later moves through it. */
static void warn_of_plane_apart(const struct lagrangian_mesh *reference, const struct particles *p,
                                const struct scene *s, int body, struct warnings *to)
{
    const struct boundary *b = plane_with_fit(p, s, body, reference->hollow.absent, PLANE_APART);
    if (b)
        warnings_add_if_new(
            to,
            "boundary %s: body %s does not touch this plane of symmetry at the start, and in the reference frame would "
            "later pass through it; if the body can reach the plane, set mpm.frame: current",
            b->name, s->body[body].name);
}

/* Adds warnings to warning_list of planes of symmetry of the run that do not fit the nodes. On a background grid these
 * planes are neither on a node nor midway between two; with a mesh of the undeformed body, the body does not reach them
 * at the start of a dynamic run. Measured with inputs/bar_converge.yaml: displacements are 11 to 24 % off if mirrors
 * are 0.15 and 0.25 of a cell from a node, with 50 to 200 points per metre; half the spacing reduces the error by at
 * most a third. */
void mirror_planes_warn_if_not_fitting_grid_or_mesh(const struct run *run, struct warnings *warning_list)
{
    const struct scene *s = run->scene;
    for (int b = 0; b < s->boundaries; b++)
        if (s->method != METHOD_PD && s->boundary[b].kind == BOUNDARY_MIRROR &&
            !mirror_plane_is_at_or_midway_between_nodes(&s->boundary[b], &run->grid->field[0].grid, s->spacing))
            warnings_add_if_new(
                warning_list,
                "boundary %s: the mirror plane is neither on a grid node nor midway between two nodes: displacements "
                "are 15 to 20 %% off, and refinement hardly helps; move the nodes by mpm.origin or mpm.cell",
                s->boundary[b].name);
    for (int body = 0; body < s->bodies && s->method != METHOD_PD && scene_is_dynamic(s); body++)
        if (run->frame->choice[body].reference) warn_of_plane_apart(run->frame, &run->part, s, body, warning_list);
}

static void take_frame(struct frame_choice *f, bool reference, const char *reason)
{
    *f = (struct frame_choice){reference, reason};
}

/* Sets FLAG_MESHED, the mark of points of the mesh, for all particles of `part` in those bodies that are in the
 * reference frame (on a mesh of the undeformed body) according to frame->choice. */
static void frames_mark(struct particles *part, struct lagrangian_mesh *frame)
{
    for (int64_t i = 0; i < part->n; i++)
        if (frame->choice[part->body[i]].reference) part->flag[i] |= FLAG_MESHED;
}

status bodies_choose_lagrangian_mesh_or_background_grid(struct lagrangian_mesh *reference, struct grid_method *mpm,
                                                        struct particles *p, const struct scene *s)
{
    reference->bodies = s->bodies;
    reference->spacing = s->spacing;
    reference->finite = !s->small_strain;
    reference->converts = s->method == METHOD_ADAPTIVE;
    reference->active_set = s->active_set;
    reference->room_limits = s->levels == LEVELS_AUTO;
    reference->choice = NEW("engine.frame", s->bodies, struct frame_choice);
    for (int b = 0; b < s->bodies && s->method != METHOD_PD; b++) {
        const enum grid_frame said = s->body[b].frame;
        const char *why = scene_reason_total_lagrangian_mpm_unsupported(s, b);
        if (why && said == FRAME_REFERENCE)
            return status_set(REFUSED,
                              "mpm.frame: body %s cannot be in the reference frame: %s; set mpm.frame: current, or "
                              "remove this obstacle",
                              s->body[b].name, why);
        take_frame(&reference->choice[b], said != FRAME_CURRENT,
                   said == FRAME_REFERENCE ? "the scene sets this" : s->body[b].frame_reason);
    }
    background_grids_make(mpm, s, p, lagrangian_mesh_is_used_by_any_body(reference));
    if (s->bodies == 1 && s->body[0].frame == FRAME_AUTO && s->method != METHOD_PD) {
        const char *why = frame_obstacle(p, s, mpm, &reference->hollow);
        take_frame(&reference->choice[0], !why,
                   why             ? why
                   : s->rigids > 0 ? "its points keep their neighbours and have contact with rigid bodies only"
                                   : "its points keep their neighbours and have no contact with other bodies");
        if (why) background_grids_make(mpm, s, p, lagrangian_mesh_is_used_by_any_body(reference));
    }
    if (s->method != METHOD_PD) TRY(planes_check(reference, p, s));
    frames_mark(p, reference);
    return OK;
}

bool lagrangian_mesh_can_be_made_for_scene(const struct lagrangian_mesh *reference, const struct particles *p,
                                           const struct scene *s, const struct grid_method *mpm)
{
    return frame_obstacle(p, s, mpm, &reference->hollow) == NULL;
}

bool lagrangian_mesh_is_used_by_any_body(const struct lagrangian_mesh *reference)
{
    for (int b = 0; b < reference->bodies; b++)
        if (reference->choice[b].reference) return true;
    return false;
}

/* ---- the mesh ---------------------------------------------------------------------------------------------------- */

/* Returns an array with the elastic constants of the mesh cells, one entry for each material of scene s. They are those
 * of the material, own[materials], or, if the scene requests it by mpm.constants, those of a full lattice of
 * peridynamic bonds. family: neighbours in this lattice. Release the array with memory_free. */
static struct elastic *cell_constants(const struct scene *s, const struct elastic *own, const struct family *family)
{
    struct elastic *cell = NEW("engine.cell_elastic", s->materials, struct elastic);
    for (int m = 0; m < s->materials; m++) {
        real c12;
        cell[m] = own[m];
        if (!s->lattice_constants) continue;
        family_compute_cubic_elastic_constants(family, &s->material[m], &cell[m].c11, &c12);
        if (s->dim > 1) cell[m].c12 = cell[m].shear = c12;
    }
    return cell;
}

void lagrangian_mesh_list_bonded_or_loaded_points(struct lagrangian_mesh *reference, const struct particles *p,
                                                  const struct bonds *bonds, struct loads *loads)
{
    mesh_list_bonded_or_loaded_points(&reference->mesh, p, bonds, loads);
    loads_find_driven_mesh_nodes(loads, &reference->mesh, p);
}

status lagrangian_mesh_make_for_run(struct run *run, const struct mesh_source *source, bool caller_sets_motion)
{
    struct lagrangian_mesh *reference = run->frame;
    const struct grid *g = &run->grid->field[0].grid;
    reference->elastic = cell_constants(run->scene, run->tables.elastic, &run->source.family);
    reference->source =
        (struct mesh_source){.elastic = reference->elastic,
                             .isotropic = run->tables.elastic,
                             .materials = run->scene->materials,
                             .partial = source->partial,
                             .hollow = &reference->hollow,
                             .slit = source->slit,
                             .slits = source->slits,
                             .voids = grid_has_mirror_plane_between_nodes(g, run->scene) ? NULL : run->source.voids,
                             .mirror = run->source.mirror,
                             .mirrors = run->source.mirrors,
                             .still = caller_sets_motion};
    TRY(mesh_make(&reference->mesh, &run->part, g, &reference->source));
    /* a mesh rebuilt after a restart has no mirrors, though its box is unchanged */
    run->loads.constrained_mesh.count[0] = 0;
    mesh_levels_store_coarsest_levels_for_thickness(reference, run->scene, run->part.n_body);
    lagrangian_mesh_list_bonded_or_loaded_points(reference, &run->part, &run->bonds, &run->loads);
    return OK;
}

/* Returns the critical time step of the mesh of `reference` [s]; INFINITY if it has no points. Conversion to
 * peridynamics may later leave any subset of points in a cell. With partial stress, no such cell has a smaller critical
 * step than the initial cells. With hand-shake coupling, a cell with a single point has a smaller one, which is then
 * included. s: scene, with the densities; coupling: how points and particles are coupled. */
real lagrangian_mesh_critical_time_step(const struct lagrangian_mesh *reference, const struct scene *s,
                                        enum coupling coupling)
{
    real density[UINT8_MAX], step = INFINITY;
    for (int m = 0; m < s->materials; m++) density[m] = s->material[m].density;
    if (reference->mesh.points > 0)
        step = mesh_critical_time_step(&reference->mesh, &reference->source, density,
                                       reference->converts && coupling != COUPLING_PARTIAL_STRESS);
    return step;
}

/* ---- in a step --------------------------------------------------------------------------------------------------- */

/* Updates from the mesh nodes of `reference` the positions of the exposed points of p (points with bonds or loads,
 * whose motion is needed in every step), and the strains at points with state-based bonds to peridynamic particles. */
void lagrangian_mesh_move_bonded_or_loaded_points(struct lagrangian_mesh *reference, struct particles *p)
{
    mesh_exposed_move(&reference->mesh, p);
    mesh_ends_update(&reference->mesh, p, reference->finite);
}

void lagrangian_mesh_compute_nodal_forces(struct lagrangian_mesh *reference, struct particles *p, int64_t step)
{
    mesh_clear(&reference->mesh);
    mesh_exposed_force(&reference->mesh, p);
    mesh_force(&reference->mesh, p, reference->elastic, reference->finite);
    mesh_levels_compute_forces_of_coarse_cells(&reference->levels, p, reference->coarse, reference->finite,
                                               mesh_levels_coarsest_level_integrated_in_step(&reference->levels, step));
}

/* Sets the velocities that `loads` prescribe at nodes of the mesh of `reference` and of the levels 1 .. due of coarse
 * cells. A cell of level k has 2^k times the edge of the finest, and its step is 2^k times as long. due: highest level
 * that begins a step now; middle: time in the middle of the step of the mesh [s]; dt: length of that step [s]. */
static void nodes_walls(struct lagrangian_mesh *reference, const struct loads *loads, real middle, real dt, int due)
{
    loads_prescribe_mesh_velocities(loads, &reference->mesh, middle, dt);
    for (int k = 1; k <= due; k++) {
        struct mesh_level *level = &reference->levels.at[k];
        const real longer = (real)(1 << k) * dt;
        loads_prescribe_coarse_node_velocities(loads, &level->held, &level->mesh.grid, middle + 0.5 * (longer - dt),
                                               longer);
    }
}

/* Adds the reactions at nodes with prescribed velocity, of the mesh of `frame` and of the levels 1 .. due of coarse
 * cells, to the loads that prescribe them. A cell of level k has 2^k times the edge of the finest. due: highest level
 * that makes a step now; dt_velocity: time over which the nodes of the mesh were accelerated [s]; for level k it is 2^k
 * times as long. */
static void nodes_react(struct loads *loads, struct lagrangian_mesh *frame, real dt_velocity, int due)
{
    loads_add_reactions_at_grid_nodes(loads, &frame->mesh.grid, dt_velocity);
    for (int level = 1; level <= due; level++)
        loads_add_reactions_at_grid_nodes(loads, &frame->levels.at[level].mesh.grid, dt_velocity * (real)(1 << level));
}

void lagrangian_mesh_move_nodes(struct lagrangian_mesh *reference, struct particles *p, struct loads *loads,
                                const struct run_clock *clock, real t_middle, real dt_velocity)
{
    const int due = mesh_levels_coarsest_level_integrated_in_step(&reference->levels, clock->step);
    if (reference->mesh.points == 0) return;
    if (reference->converts) mesh_points_mark(&reference->mesh, p, reference->elastic, reference->finite);
    if (p->mesh_stress[0] && clock->step == 0)
        mesh_points_flow(&reference->mesh, p, reference->elastic, 0, reference->finite);
    nodes_walls(reference, loads, t_middle, clock->dt, due);
    reference->speed =
        reference->levels.n > 0
            ? mesh_levels_move_nodes_return_largest_velocity(&reference->levels, clock->dt, dt_velocity, due,
                                                             loads->impulse, &loads->constraint_work)
            : mesh_move(&reference->mesh, clock->dt, dt_velocity, loads->impulse, &loads->constraint_work);
    nodes_react(loads, reference, dt_velocity, due);
    if (p->mesh_stress[0]) mesh_points_flow(&reference->mesh, p, reference->elastic, clock->dt, reference->finite);
    lagrangian_mesh_move_bonded_or_loaded_points(reference, p);
    if (reference->active_set && reference->levels.n == 0)
        active_nodes_update_list_of_active_node_blocks(&reference->mesh, loads);
}

void lagrangian_mesh_update_point_motion(struct lagrangian_mesh *reference, struct particles *p,
                                         const struct loads *loads)
{
    if (reference->mesh.points == 0) return;
    mesh_levels_prolong_motion_near_particles_only(&reference->levels);
    mesh_points_move(&reference->mesh, p);
    loads_update_mirror_images_of_particles(loads, p);
}

void lagrangian_mesh_update_point_motion_and_stress(struct lagrangian_mesh *reference, struct particles *p,
                                                    const struct loads *loads)
{
    if (reference->mesh.points == 0) return;
    lagrangian_mesh_update_point_motion(reference, p, loads);
    mesh_points_stress(&reference->mesh, p, reference->elastic, reference->finite);
}

void lagrangian_mesh_update_motion_of_listed_points(struct lagrangian_mesh *reference, struct particles *p,
                                                    const struct loads *loads, const int32_t *point_list,
                                                    int64_t point_count)
{
    if (reference->mesh.points == 0) return;
    mesh_listed_move(&reference->mesh, p, point_list, point_count);
    loads_update_mirror_images_of_particles(loads, p);
}

bool lagrangian_mesh_update_after_point_conversion(struct lagrangian_mesh *reference, struct particles *p,
                                                   int64_t converted_count, const struct partial_stress *partial,
                                                   real *energy_lost)
{
    if (reference->mesh.points == 0) return false;
    /* if bonds break without conversion, the same cells stay partial: their stiffness is recomputed in place */
    if (converted_count == 0 && mesh_try_update_stiffness_for_partial_stress(&reference->mesh, p, &reference->source,
                                                                             partial->touched, partial->touches))
        return false;
    *energy_lost += mesh_remove_points_and_return_lost_energy(&reference->mesh, p, &reference->source, partial->touched,
                                                              partial->touches);
    return true;
}

void lagrangian_mesh_insert_points(struct lagrangian_mesh *reference, struct particles *p,
                                   const int32_t *inserted_points, int64_t inserted_count, real *energy_lost)
{
    int32_t *own = NEW("engine.own", inserted_count, int32_t);
    int64_t m = 0;
    for (int64_t k = 0; k < inserted_count; k++)
        if (reference->mesh.place && reference->choice[p->body[inserted_points[k]]].reference)
            own[m++] = inserted_points[k];
    if (m > 0) {
        *energy_lost += mesh_insert_points_and_return_lost_energy(&reference->mesh, p, own, m);
        active_nodes_activate_all_node_blocks(&reference->mesh);
    }
    memory_free(own);
}
