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
static const char *doubt(const struct engine *e)
{
    const int64_t pieces = mesh_pieces(&e->part, &e->grid);
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
        if (e->frame[e->part.body[i]].reference) e->part.flag[i] |= FLAG_MESHED;
}

status engine_frames(struct engine *e)
{
    const struct scene *s = e->scene;
    e->frame = NEW("engine.frame", s->bodies, struct frame_choice);
    for (int b = 0; b < s->bodies && s->method != METHOD_PD; b++) {
        const enum grid_frame said = s->body[b].frame;
        const char *why = scene_frame_unsupported(s, b);
        if (why && said == FRAME_REFERENCE)
            return status_set(REFUSED, "mpm.frame: body %s cannot be in the reference frame: %s", s->body[b].name, why);
        take_frame(&e->frame[b], said != FRAME_CURRENT,
                   said == FRAME_REFERENCE ? "the scene says so" : s->body[b].frame_reason);
    }
    engine_grid_make(e);
    if (s->bodies == 1 && s->body[0].frame == FRAME_AUTO && s->method != METHOD_PD) {
        const char *why = doubt(e);
        take_frame(&e->frame[0], !why, why ? why : "it keeps its neighbours and meets no other body");
        if (why) engine_grid_make(e);
    }
    engine_mesh_mark(e);
    return OK;
}

bool engine_frame_allowed(const struct engine *e, int body)
{
    return !scene_frame_not_default(e->scene, body) && mesh_pieces(&e->part, &e->grid) == 1;
}

bool engine_has_mesh(const struct engine *e)
{
    for (int b = 0; b < e->scene->bodies; b++)
        if (e->frame[b].reference) return true;
    return false;
}

/* ---- the mesh ---------------------------------------------------------------------------------------------------- */

static void lattice_constants(const struct engine *e, const struct material *m, struct elastic *to)
{
    real c12;
    family_constants(&e->source.family, m, &to->c11, &c12);
    if (e->part.dim > 1) to->c12 = to->shear = c12;
}

/* Elastic constants of the cells: of the material, or of its bonds on the lattice (mpm.constants). */
static void make_constants(struct engine *e)
{
    const struct scene *s = e->scene;
    e->cell_elastic = NEW("engine.cell_elastic", s->materials, struct elastic);
    for (int m = 0; m < s->materials; m++) {
        e->cell_elastic[m] = e->elastic[m];
        if (s->lattice_constants) lattice_constants(e, &s->material[m], &e->cell_elastic[m]);
    }
    e->mesh_source = (struct mesh_source){.elastic = e->cell_elastic,
                                          .isotropic = e->elastic,
                                          .materials = s->materials,
                                          .partial = e->uses_partial ? &e->partial : NULL};
}

/* Updates exposed points and loads after the points of the mesh have changed. */
static void engine_mesh_follow_points(struct engine *e)
{
    mesh_find_exposed(&e->mesh, &e->part, &e->bonds, &e->loads);
    loads_mesh_find(&e->loads, &e->mesh, &e->part);
    e->partial.touches = 0;
}

status engine_mesh_make(struct engine *e)
{
    make_constants(e);
    TRY(mesh_make(&e->mesh, &e->part, &e->grid, &e->mesh_source));
    /* a mesh made anew after a restart has no mirrors, though its box is unchanged */
    e->loads.constrained_mesh.count[0] = 0;
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
    if (e->mesh.points > 0)
        step = mesh_critical_step(&e->mesh, &e->mesh_source, density,
                                  s->method == METHOD_ADAPTIVE && e->coupling != COUPLING_PARTIAL_STRESS);
    return step;
}

/* ---- in a step --------------------------------------------------------------------------------------------------- */

/* Updates the exposed points, which bonds use, from their nodes. */
static void exposed_follow(struct engine *e)
{
    mesh_exposed_move(&e->mesh, &e->part);
    mesh_ends_update(&e->mesh, &e->part, !e->scene->small_strain);
}

void engine_ends_update(struct engine *e)
{
    if (!e->part.end_strain) return;
    partial_ends_update(&e->partial, &e->part, e->scene->material);
    if (e->mesh.points > 0) mesh_ends_update(&e->mesh, &e->part, !e->scene->small_strain);
}

void engine_nodes_force(struct engine *e)
{
    mesh_clear(&e->mesh);
    mesh_exposed_force(&e->mesh, &e->part);
    mesh_force(&e->mesh, &e->part, e->cell_elastic, !e->scene->small_strain);
}

void engine_forces(struct engine *e)
{
    const bool has_mesh = e->mesh.points > 0;
    if (has_mesh) exposed_follow(e);
    loads_mirror(&e->loads, &e->part);
    loads_clear(&e->loads, &e->part);
    bond_forces(e->kernels.bond_force, &e->bonds, &e->part, &e->source.limit, NULL);
    if (has_mesh) engine_nodes_force(e);
}

void engine_mesh_move(struct engine *e, real middle, real dt_velocity)
{
    struct mesh *mesh = &e->mesh;
    const bool finite = !e->scene->small_strain;
    if (mesh->points == 0) return;
    engine_nodes_force(e);
    engine_residual_of(e, &mesh->grid);
    if (e->scene->method == METHOD_ADAPTIVE) mesh_points_mark(mesh, &e->part, e->cell_elastic, finite);
    loads_mesh_walls(&e->loads, mesh, middle, e->dt);
    e->mesh_speed = mesh_move(mesh, e->dt, dt_velocity, e->loads.impulse, &e->loads.constraint_work);
    loads_react(&e->loads, &mesh->grid, dt_velocity);
    exposed_follow(e);
    if (e->scene->rest) active_nodes_update(mesh, &e->loads);
}

void engine_mesh_sync(struct engine *e)
{
    if (e->mesh.points == 0) return;
    mesh_points_move(&e->mesh, &e->part);
    mesh_points_stress(&e->mesh, &e->part, e->cell_elastic, !e->scene->small_strain);
    loads_mirror(&e->loads, &e->part);
}

void engine_mesh_sync_points(void *engine, const int32_t *list, int64_t n)
{
    struct engine *e = engine;
    if (e->mesh.points == 0) return;
    if (list) mesh_listed_move(&e->mesh, &e->part, list, n);
    else mesh_points_move(&e->mesh, &e->part);
    loads_mirror(&e->loads, &e->part);
}

/* Where no particle converts and only bonds break, the same cells stay partial: their stiffness is made anew in
 * place. */
static bool refresh(struct engine *e, int64_t converted)
{
    return converted == 0 && mesh_refresh(&e->mesh, &e->part, &e->mesh_source, e->partial.touched, e->partial.touches);
}

void engine_mesh_follow(struct engine *e, int64_t converted)
{
    if (e->mesh.points > 0 && (converted > 0 || e->partial.touches > 0) && !refresh(e, converted)) {
        e->damped += mesh_follow(&e->mesh, &e->part, &e->mesh_source, e->partial.touched, e->partial.touches);
        engine_mesh_follow_points(e);
    }
    if (converted > 0 || e->partial.touches > 0) engine_ends_update(e);
    e->partial.touches = 0;
}

void engine_mesh_insert(struct engine *e, const int32_t *list, int64_t n)
{
    int32_t *own = NEW("engine.own", n, int32_t);
    int64_t m = 0;
    for (int64_t k = 0; k < n; k++)
        if (e->mesh.place && e->frame[e->part.body[list[k]]].reference) own[m++] = list[k];
    if (m > 0) {
        e->damped += mesh_insert(&e->mesh, &e->part, own, m);
        active_nodes_all(&e->mesh);
    }
    memory_free(own);
    engine_mesh_follow(e, n);
    engine_mesh_sync_points(e, NULL, e->part.n);
}
