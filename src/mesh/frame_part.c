/* Bodies in the reference frame: their choice, their mesh, and its part of a step. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "mesh/active_nodes.h"
#include "base/memory.h"
#include "grid/grid_part.h"
#include "mesh/mesh_part.h"

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

static void frames_mark(struct particles *part, struct reference_frame *frame)
{
    for (int64_t i = 0; i < part->n; i++)
        if (frame->choice[part->body[i]].reference) part->flag[i] |= FLAG_MESHED;
}

status frames_choose(struct run *e)
{
    const struct scene *s = e->scene;
    e->frame->choice = NEW("engine.frame", s->bodies, struct frame_choice);
    for (int b = 0; b < s->bodies && s->method != METHOD_PD; b++) {
        const enum grid_frame said = s->body[b].frame;
        const char *why = scene_frame_unsupported(s, b);
        if (why && said == FRAME_REFERENCE)
            return status_set(REFUSED, "mpm.frame: body %s cannot be in the reference frame: %s", s->body[b].name, why);
        take_frame(&e->frame->choice[b], said != FRAME_CURRENT,
                   said == FRAME_REFERENCE ? "the scene says so" : s->body[b].frame_reason);
    }
    grid_part_make(e, frame_any(e));
    if (s->bodies == 1 && s->body[0].frame == FRAME_AUTO && s->method != METHOD_PD) {
        const char *why = doubt(&e->part, e->grid, &e->frame->hollow);
        take_frame(&e->frame->choice[0], !why, why ? why : "it keeps its neighbours and meets no other body");
        if (why) grid_part_make(e, frame_any(e));
    }
    frames_mark(&e->part, e->frame);
    return OK;
}

bool frame_allowed(const struct run *e, int body)
{
    return !scene_frame_not_default(e->scene, body) &&
           mesh_pieces(&e->part, &e->grid->field[0].grid, &e->frame->hollow) == 1;
}

bool frame_any(const struct run *e)
{
    for (int b = 0; b < e->scene->bodies; b++)
        if (e->frame->choice[b].reference) return true;
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
static void make_constants(struct run *e, const struct mesh_source *cuts)
{
    const struct scene *s = e->scene;
    e->frame->elastic = NEW("engine.cell_elastic", s->materials, struct elastic);
    for (int m = 0; m < s->materials; m++) {
        e->frame->elastic[m] = e->tables.elastic[m];
        if (s->lattice_constants) lattice_constants(&e->part, &e->source, &s->material[m], &e->frame->elastic[m]);
    }
    e->frame->source = (struct mesh_source){.elastic = e->frame->elastic,
                                            .isotropic = e->tables.elastic,
                                            .materials = s->materials,
                                            .partial = cuts->partial,
                                            .hollow = &e->frame->hollow,
                                            .slit = cuts->slit,
                                            .slits = cuts->slits,
                                            .voids = grid_mirror_between(e) ? NULL : e->source.voids,
                                            .mirror = e->source.mirror,
                                            .mirrors = e->source.mirrors};
}

void frame_follow_points(struct run *e)
{
    mesh_find_exposed(&e->frame->mesh, &e->part, &e->bonds, &e->loads);
    loads_mesh_find(&e->loads, &e->frame->mesh, &e->part);
}

status frame_make(struct run *e, const struct mesh_source *cuts, bool still)
{
    make_constants(e, cuts);
    e->frame->source.still = still;
    TRY(mesh_make(&e->frame->mesh, &e->part, &e->grid->field[0].grid, &e->frame->source));
    /* a mesh made anew after a restart has no mirrors, though its box is unchanged */
    e->loads.constrained_mesh.count[0] = 0;
    frame_levels_room(e);
    frame_follow_points(e);
    return OK;
}

/* Conversion may leave any number of points in a cell. With partial stress no such cell has a smaller critical step
 * than the cells of the start; with hand-shake a cell with a single point has. */
real frame_critical_step(const struct run *e)
{
    const struct scene *s = e->scene;
    real density[UINT8_MAX], step = INFINITY;
    for (int m = 0; m < s->materials; m++) density[m] = s->material[m].density;
    if (e->frame->mesh.points > 0)
        step = mesh_critical_step(&e->frame->mesh, &e->frame->source, density,
                                  s->method == METHOD_ADAPTIVE && e->coupling_kind != COUPLING_PARTIAL_STRESS);
    return step;
}

/* ---- in a step --------------------------------------------------------------------------------------------------- */

void frame_exposed_follow(struct run *e)
{
    mesh_exposed_move(&e->frame->mesh, &e->part);
    mesh_ends_update(&e->frame->mesh, &e->part, !e->scene->small_strain);
}

void frame_force(struct run *e)
{
    const bool finite = !e->scene->small_strain;
    struct mesh_levels *levels = &e->frame->levels;
    mesh_clear(&e->frame->mesh);
    mesh_exposed_force(&e->frame->mesh, &e->part);
    mesh_force(&e->frame->mesh, &e->part, e->frame->elastic, finite);
    levels_force(levels, &e->part, e->frame->coarse, finite, levels_due(levels, e->clock.step));
}

/* Walls of the mesh and of the coarse cells that move in this step, these by longer ones. */
static void nodes_walls(struct run *e, real middle, int due)
{
    struct mesh_levels *levels = &e->frame->levels;
    loads_mesh_walls(&e->loads, &e->frame->mesh, middle, e->clock.dt);
    for (int level = 1; level <= due; level++) {
        const real dt = (real)(1 << level) * e->clock.dt;
        loads_level_walls(&e->loads, &levels->at[level].held, &levels->at[level].mesh.grid,
                          middle + 0.5 * (dt - e->clock.dt), dt);
    }
}

static void nodes_react(struct loads *loads, struct reference_frame *frame, real dt_velocity, int due)
{
    loads_react(loads, &frame->mesh.grid, dt_velocity);
    for (int level = 1; level <= due; level++)
        loads_react(loads, &frame->levels.at[level].mesh.grid, dt_velocity * (real)(1 << level));
}

void frame_move(struct run *e, real middle, real dt_velocity)
{
    struct mesh *mesh = &e->frame->mesh;
    struct mesh_levels *levels = &e->frame->levels;
    const bool finite = !e->scene->small_strain;
    const int due = levels_due(levels, e->clock.step);
    if (mesh->points == 0) return;
    if (e->scene->method == METHOD_ADAPTIVE) mesh_points_mark(mesh, &e->part, e->frame->elastic, finite);
    nodes_walls(e, middle, due);
    e->frame->speed =
        levels->n > 0 ? levels_move(levels, e->clock.dt, dt_velocity, due, e->loads.impulse, &e->loads.constraint_work)
                      : mesh_move(mesh, e->clock.dt, dt_velocity, e->loads.impulse, &e->loads.constraint_work);
    nodes_react(&e->loads, e->frame, dt_velocity, due);
    frame_exposed_follow(e);
    if (e->scene->active_set && levels->n == 0) active_nodes_update(mesh, &e->loads);
}

void frame_sync(struct run *e)
{
    if (e->frame->mesh.points == 0) return;
    levels_prolong_points(&e->frame->levels);
    mesh_points_move(&e->frame->mesh, &e->part);
    mesh_points_stress(&e->frame->mesh, &e->part, e->frame->elastic, !e->scene->small_strain);
    loads_mirror(&e->loads, &e->part);
}

void frame_sync_points(void *engine, const int32_t *list, int64_t n)
{
    struct run *e = engine;
    if (e->frame->mesh.points == 0) return;
    if (list)
        mesh_listed_move(&e->frame->mesh, &e->part, list, n);
    else
        levels_prolong_points(&e->frame->levels), mesh_points_move(&e->frame->mesh, &e->part);
    loads_mirror(&e->loads, &e->part);
}

/* Where no particle converts and only bonds break, the same cells stay partial: their stiffness is made anew in
 * place. */
static bool refresh(struct particles *p, struct reference_frame *reference, int64_t converted, const int32_t *touched,
                    int64_t touches)
{
    return converted == 0 && mesh_refresh(&reference->mesh, p, &reference->source, touched, touches);
}

bool frame_follow(struct run *e, int64_t converted, const int32_t *touched, int64_t touches)
{
    if (e->frame->mesh.points == 0 || refresh(&e->part, e->frame, converted, touched, touches)) return false;
    e->damped += mesh_follow(&e->frame->mesh, &e->part, &e->frame->source, touched, touches);
    frame_follow_points(e);
    return true;
}

void frame_insert(struct run *e, const int32_t *list, int64_t n)
{
    int32_t *own = NEW("engine.own", n, int32_t);
    int64_t m = 0;
    for (int64_t k = 0; k < n; k++)
        if (e->frame->mesh.place && e->frame->choice[e->part.body[list[k]]].reference) own[m++] = list[k];
    if (m > 0) {
        e->damped += mesh_insert(&e->frame->mesh, &e->part, own, m);
        active_nodes_all(&e->frame->mesh);
    }
    memory_free(own);
}
