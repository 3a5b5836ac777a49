/* Bodies in the reference frame: their choice, their mesh, and its part of a step. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "mesh/active_nodes.h"
#include "engine/engine.h"
#include "engine_report.h"
#include "base/memory.h"

/* ---- choice of the frame ----------------------------------------------------------------------------------------- */

/* Obstacle to the reference frame of a body at auto whose scene allows it; NULL: none. The body must be one piece on
 * one lattice, with particles midway in the halves of cells. */
static const char *doubt(const struct particles *p, const struct grid_method *mpm, const struct hollow *hollow)
{
    const int64_t pieces = mesh_pieces(p, &mpm->field[0].grid, hollow);
    if (pieces == 0)
        return "its particles do not lie two a cell and direction; mpm.origin or a mirror puts the nodes elsewhere";
    return pieces > 1 ? "it is in pieces, which meet on the grid of frame current only" : NULL;
}

static void take_frame(struct frame_choice *f, bool reference, const char *reason)
{
    *f = (struct frame_choice){reference, reason};
}

static void engine_mesh_mark(struct engine *e)
{
    for (int64_t i = 0; i < e->part.n; i++)
        if (e->reference.choice[e->part.body[i]].reference) e->part.flag[i] |= FLAG_MESHED;
}

status engine_frames(struct engine *e)
{
    const struct scene *s = e->scene;
    e->reference.choice = NEW("engine.frame", s->bodies, struct frame_choice);
    for (int b = 0; b < s->bodies && s->method != METHOD_PD; b++) {
        const enum grid_frame said = s->body[b].frame;
        const char *why = scene_frame_unsupported(s, b);
        if (why && said == FRAME_REFERENCE)
            return status_set(REFUSED, "mpm.frame: body %s cannot be in the reference frame: %s", s->body[b].name, why);
        take_frame(&e->reference.choice[b], said != FRAME_CURRENT,
                   said == FRAME_REFERENCE ? "the scene says so" : s->body[b].frame_reason);
    }
    engine_grid_make(e);
    if (s->bodies == 1 && s->body[0].frame == FRAME_AUTO && s->method != METHOD_PD) {
        const char *why = doubt(&e->part, &e->mpm, &e->reference.hollow);
        take_frame(&e->reference.choice[0], !why, why ? why : "it keeps its neighbours and meets no other body");
        if (why) engine_grid_make(e);
    }
    engine_mesh_mark(e);
    return OK;
}

bool engine_frame_allowed(const struct engine *e, int body)
{
    return !scene_frame_not_default(e->scene, body) &&
           mesh_pieces(&e->part, &e->mpm.field[0].grid, &e->reference.hollow) == 1;
}

bool engine_has_mesh(const struct engine *e)
{
    for (int b = 0; b < e->scene->bodies; b++)
        if (e->reference.choice[b].reference) return true;
    return false;
}

/* ---- the mesh ---------------------------------------------------------------------------------------------------- */

static void lattice_constants(const struct particles *p, const struct bond_source *source, const struct material *m,
                              struct elastic *to)
{
    real c12;
    family_constants(&source->family, m, &to->c11, &c12);
    if (p->dim > 1) to->c12 = to->shear = c12;
}

/* Elastic constants of the cells: of the material, or of its bonds on the lattice (mpm.constants). */
static void make_constants(struct engine *e)
{
    const struct scene *s = e->scene;
    e->reference.elastic = NEW("engine.cell_elastic", s->materials, struct elastic);
    for (int m = 0; m < s->materials; m++) {
        e->reference.elastic[m] = e->tables.elastic[m];
        if (s->lattice_constants) lattice_constants(&e->part, &e->source, &s->material[m], &e->reference.elastic[m]);
    }
    e->reference.source = (struct mesh_source){.elastic = e->reference.elastic,
                                          .isotropic = e->tables.elastic,
                                          .materials = s->materials,
                                          .partial = e->coupling.uses_partial ? &e->coupling.partial : NULL,
                                          .hollow = &e->reference.hollow,
                                          .slit = e->coupling.notches.slit,
                                          .slits = e->coupling.notches.slits,
                                          .voids = engine_mirror_between(e) ? NULL : e->source.voids,
                                          .mirror = e->source.mirror,
                                          .mirrors = e->source.mirrors};
}

void engine_mesh_follow_points(struct engine *e)
{
    mesh_find_exposed(&e->reference.mesh, &e->part, &e->bonds, &e->loads);
    loads_mesh_find(&e->loads, &e->reference.mesh, &e->part);
    e->coupling.partial.touches = 0;
}

status engine_mesh_make(struct engine *e, bool still)
{
    make_constants(e);
    e->reference.source.still = still;
    TRY(mesh_make(&e->reference.mesh, &e->part, &e->mpm.field[0].grid, &e->reference.source));
    /* a mesh made anew after a restart has no mirrors, though its box is unchanged */
    e->loads.constrained_mesh.count[0] = 0;
    engine_levels_room(e);
    engine_mesh_follow_points(e);
    return OK;
}

/* Conversion may leave any number of points in a cell. With partial stress no such cell has a smaller critical step
 * than the cells of the start; with hand-shake a cell with a single point has. */
real engine_mesh_critical_step(const struct engine *e)
{
    const struct scene *s = e->scene;
    real density[UINT8_MAX], step = INFINITY;
    for (int m = 0; m < s->materials; m++) density[m] = s->material[m].density;
    if (e->reference.mesh.points > 0)
        step = mesh_critical_step(&e->reference.mesh, &e->reference.source, density,
                                  s->method == METHOD_ADAPTIVE && e->coupling.kind != COUPLING_PARTIAL_STRESS);
    return step;
}

/* ---- in a step --------------------------------------------------------------------------------------------------- */

/* Updates the exposed points, which bonds use, from their nodes. */
static void exposed_follow(const struct scene *s, struct particles *p, struct reference_frame *reference)
{
    mesh_exposed_move(&reference->mesh, p);
    mesh_ends_update(&reference->mesh, p, !s->small_strain);
}

void engine_ends_update(struct engine *e)
{
    if (!e->part.end_strain) return;
    partial_ends_update(&e->coupling.partial, &e->part, e->scene->material);
    if (e->reference.mesh.points > 0) mesh_ends_update(&e->reference.mesh, &e->part, !e->scene->small_strain);
}

void engine_nodes_force(struct engine *e)
{
    const bool finite = !e->scene->small_strain;
    struct mesh_levels *levels = &e->reference.levels;
    mesh_clear(&e->reference.mesh);
    mesh_exposed_force(&e->reference.mesh, &e->part);
    mesh_force(&e->reference.mesh, &e->part, e->reference.elastic, finite);
    levels_force(levels, &e->part, e->reference.coarse, finite, levels_due(levels, e->clock.step));
}

/* Walls of the mesh and of the coarse cells that move in this step, these by longer ones. */
static void nodes_walls(struct engine *e, real middle, int due)
{
    struct mesh_levels *levels = &e->reference.levels;
    loads_mesh_walls(&e->loads, &e->reference.mesh, middle, e->clock.dt);
    for (int level = 1; level <= due; level++) {
        const real dt = (real)(1 << level) * e->clock.dt;
        loads_level_walls(&e->loads, &levels->at[level].held, &levels->at[level].mesh.grid,
                          middle + 0.5 * (dt - e->clock.dt), dt);
    }
}

static void nodes_react(struct engine *e, real dt_velocity, int due)
{
    loads_react(&e->loads, &e->reference.mesh.grid, dt_velocity);
    for (int level = 1; level <= due; level++)
        loads_react(&e->loads, &e->reference.levels.at[level].mesh.grid, dt_velocity * (real)(1 << level));
}

void engine_forces(struct engine *e)
{
    const bool has_mesh = e->reference.mesh.points > 0;
    if (has_mesh) exposed_follow(e->scene, &e->part, &e->reference);
    loads_mirror(&e->loads, &e->part);
    loads_clear(&e->loads, &e->part);
    bond_forces(e->kernels.bond_force, &e->bonds, &e->part, &e->source.limit, NULL);
    if (has_mesh) engine_nodes_force(e);
}

void engine_mesh_move(struct engine *e, real middle, real dt_velocity)
{
    struct mesh *mesh = &e->reference.mesh;
    struct mesh_levels *levels = &e->reference.levels;
    const bool finite = !e->scene->small_strain;
    const int due = levels_due(levels, e->clock.step);
    if (mesh->points == 0) return;
    engine_nodes_force(e);
    engine_residual_of(e, &mesh->grid);
    if (e->scene->method == METHOD_ADAPTIVE) mesh_points_mark(mesh, &e->part, e->reference.elastic, finite);
    nodes_walls(e, middle, due);
    e->reference.speed =
        levels->n > 0
            ? levels_move(levels, e->clock.dt, dt_velocity, due, e->loads.impulse, &e->loads.constraint_work)
            : mesh_move(mesh, e->clock.dt, dt_velocity, e->loads.impulse, &e->loads.constraint_work);
    nodes_react(e, dt_velocity, due);
    exposed_follow(e->scene, &e->part, &e->reference);
    if (e->scene->active_set && levels->n == 0) active_nodes_update(mesh, &e->loads);
}

void engine_mesh_sync(struct engine *e)
{
    if (e->reference.mesh.points == 0) return;
    levels_prolong_points(&e->reference.levels);
    mesh_points_move(&e->reference.mesh, &e->part);
    mesh_points_stress(&e->reference.mesh, &e->part, e->reference.elastic, !e->scene->small_strain);
    loads_mirror(&e->loads, &e->part);
}

void engine_mesh_sync_points(void *engine, const int32_t *list, int64_t n)
{
    struct engine *e = engine;
    if (e->reference.mesh.points == 0) return;
    if (list) mesh_listed_move(&e->reference.mesh, &e->part, list, n);
    else levels_prolong_points(&e->reference.levels), mesh_points_move(&e->reference.mesh, &e->part);
    loads_mirror(&e->loads, &e->part);
}

/* Where no particle converts and only bonds break, the same cells stay partial: their stiffness is made anew in
 * place. */
static bool refresh(struct particles *p, struct reference_frame *reference, struct coupling_state *coupling,
                    int64_t converted)
{
    return converted == 0 && mesh_refresh(&reference->mesh, p, &reference->source,
                                          coupling->partial.touched, coupling->partial.touches);
}

void engine_mesh_follow(struct engine *e, int64_t converted)
{
    if (e->reference.mesh.points > 0 && (converted > 0 || e->coupling.partial.touches > 0) &&
        !refresh(&e->part, &e->reference, &e->coupling, converted)) {
        e->coupling.damped += mesh_follow(&e->reference.mesh, &e->part, &e->reference.source,
                                          e->coupling.partial.touched, e->coupling.partial.touches);
        engine_mesh_follow_points(e);
    }
    if (converted > 0 || e->coupling.partial.touches > 0) engine_ends_update(e);
    e->coupling.partial.touches = 0;
}

void engine_mesh_insert(struct engine *e, const int32_t *list, int64_t n)
{
    int32_t *own = NEW("engine.own", n, int32_t);
    int64_t m = 0;
    for (int64_t k = 0; k < n; k++)
        if (e->reference.mesh.place && e->reference.choice[e->part.body[list[k]]].reference) own[m++] = list[k];
    if (m > 0) {
        e->coupling.damped += mesh_insert(&e->reference.mesh, &e->part, own, m);
        active_nodes_all(&e->reference.mesh);
    }
    memory_free(own);
    engine_mesh_follow(e, n);
    engine_mesh_sync_points(e, NULL, e->part.n);
}
