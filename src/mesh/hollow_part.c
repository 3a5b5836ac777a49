/* Cells inside coarse cells for which no particles are created, to save memory and time (edge of a cell: two spacings).
 * Determines which particles are needed at the start, and again when the coarsening levels of cells change. New
 * particles are then created on the lattice, with displacement and velocity interpolated from the nodes. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "mesh/mesh_part.h"
#include "scene/fill.h"
#include "output/output.h"
#include "grid/grid_part.h"

enum { PAYS = 400000 }; /* number of particles that are not created, above which this saves time; measured */
/* Distances from cells of level 0 (the finest) within which particles are created, as a margin for crack growth
 * [cells]. MARGIN: around all cells of level 0; AHEAD: around those that had no particles before, where level 0 is
 * extending. Measured on half of Kalthoff's plate in 3D, spacing 0.5 mm, compared with a single distance of 8: the
 * simulation is set up anew 3 times instead of 4, with 381,504 particles instead of 517,760. */
enum { MARGIN = 4, AHEAD = 16 };

/* ---- the start --------------------------------------------------------------------------------------------------- */

/* Returns the reason in words why scene s needs all particles; NULL if those inside coarse cells need not be created.
 * The text is not to be freed. */
const char *scene_reason_all_particles_must_be_created(const struct scene *s)
{
    if (s->fill == FILL_ALL) return "the scene sets this";
    if (s->method == METHOD_PD || scene_is_single_equilibrium(s) || s->levels == 0) return "there are no coarse cells";
    if (s->bodies != 1 || s->rigids > 0) return "bodies may touch";
    if (s->body[0].file) return "the particles come from a list";
    if (scene_has_random_strength(s)) return "the strength varies in space (scatter)";
    if (s->body[0].parts > 0) return "the body has parts of another material";
    if (s->body[0].frame == FRAME_CURRENT || scene_reason_auto_rejects_total_lagrangian_mpm(s, 0))
        return "the body is in the current frame";
    if (s->initials > 0 || dot(s->body[0].velocity, s->body[0].velocity, s->dim) > 0)
        return "the body moves at the start";
    if (s->growths > 0) return "cracks grow by the key growth";
    if (s->method == METHOD_ADAPTIVE && s->conversion.reverts)
        return "peridynamic particles may become material points again";
    if (s->method == METHOD_ADAPTIVE && s->surface == SURFACE_MOMENTS)
        return "pd.surface: moments needs all particles near the faces of the body";
    if (s->contact_friction > 0) return "faces slide with friction";
    for (int b = 0; b < s->boundaries; b++)
        if (s->boundary[b].kind == BOUNDARY_PRESSURE)
            return "a boundary with a pressure needs all particles near the faces of the body";
    for (int k = 0; k < s->probes; k++) {
        const enum probe_kind kind = s->probe[k].kind;
        const bool moves = kind == PROBE_SIF && isfinite(s->material[0].critical_stretch);
        if (moves) return "the ring of a sif probe may move with the crack tip to cells without particles";
        if (kind != PROBE_SIF && kind != PROBE_TIP && kind != PROBE_BREAK && kind != PROBE_REACTION &&
            kind != PROBE_POINT)
            return "a probe measures many particles";
    }
    return NULL;
}

/* Stores in *box the grid of cells that covers the bounding box of the first body of scene s, which must be finite. The
 * nodes coincide with those that the mesh of the undeformed body will have. Returns REFUSED, with a message, if the
 * grid has too many nodes for 32-bit indices; REFUSED or FAILED if the lattice of the body cannot be determined. */
static status box_find(struct grid *box, const struct scene *s)
{
    real from[DIM_MAX], to[DIM_MAX], site[DIM_MAX];
    TRY(body_lattice_compute_first_site_position(s, 0, site));
    region_compute_bounding_box_if_finite(&s->body[0].shape, s->dim, from, to);
    box->dim = s->dim, box->h = s->cell * s->spacing;
    grid_choose_reference_node_position(s, from, site, true, box->anchor);
    return grid_set_box_if_not_too_large(box, from, to, INT32_MAX)
               ? OK
               : status_set(REFUSED,
                            "body %s: it needs more than 2e9 cells at this spacing; use a larger particles.spacing",
                            s->body[0].name);
}

/* Returns true if particles are needed at the position X[dim] [m] because of a pre-crack of scene s: if X is within the
 * cutoff of bonds plus two cells of the crack. At an end (edge in 3D) of the crack the distance is larger by the cutoff
 * plus the radius of the zone that is peridynamic from the start. source: has cutoff and horizon; h: edge of a cell
 * [m]. */
static bool near_cracks(const struct scene *s, const struct bond_source *source, const real *X, real h)
{
    const real flank = source->family.cutoff + 2 * h;
    const real end =
        flank + source->family.cutoff + real_max(s->conversion.tips * source->family.horizon, NOTCH_ZONE * s->spacing);
    for (int k = 0; k < s->cracks; k++) {
        const struct crack *c = &s->crack[k];
        if (crack_may_cut_bonds_near(c, X, flank, s->dim)) return true;
        for (int a = 0; a < c->n; a++) {
            const real *from = c->corner[a], *to = s->dim == 3 ? c->corner[(a + 1) % c->n] : from;
            if (segment_distance_from_point(from, to, X, s->dim) <= end) return true;
        }
    }
    return false;
}

/* Returns true if X[dim] [m] is inside the region of a load of scene s, extended by `tolerance` [m]. Loads that act on
 * a face of their region are not considered. */
static bool loads_reach(const struct scene *s, const real *X, real tolerance)
{
    for (int b = 0; b < s->boundaries; b++) {
        const struct boundary *load = &s->boundary[b];
        if (load->kind != BOUNDARY_MIRROR && load->side == 0 && region_contains(&load->region, X, s->dim, tolerance))
            return true;
    }
    return false;
}

/* Returns true if a load of scene s on a face of the body acts at cell I. For a traction or pressure, cell I is at the
 * face if the next cell along the axis of the load is not completely inside the body; for a prescribed displacement, if
 * the face is within its depth. hollow: grid of cells; X[dim]: a point of cell I, which must be in the region of the
 * load [m]. */
static bool face_loaded(const struct scene *s, const struct cells_without_particles *hollow, int64_t I, const real *X)
{
    for (int b = 0; b < s->boundaries; b++) {
        const struct boundary *load = &s->boundary[b];
        if (load->side == 0) continue;
        const int64_t deep = load->kind == BOUNDARY_VELOCITY ? (int64_t)ceil(load->depth / hollow->box.h) : 1;
        for (int64_t k = 1; k <= deep; k++) {
            const int64_t beside = I + k * load->side * hollow->box.stride[load->face];
            if ((beside < 0 || beside >= hollow->box.n || !hollow->whole[beside]) &&
                region_contains(&load->region, X, s->dim, hollow->box.h))
                return true;
        }
    }
    return false;
}

/* Returns true if X[dim] [m] is nearer than r [m] to the position of `probe` or, for a probe without position, to an
 * end of a pre-crack of scene s. */
static bool near_probe(const struct scene *s, const struct probe_request *probe, const real *X, real r)
{
    if (probe->has_at) return segment_distance_from_point(probe->at, probe->at, X, s->dim) < r;
    for (int k = 0; k < s->cracks; k++)
        for (int a = 0; a < s->crack[k].n; a++)
            if (segment_distance_from_point(s->crack[k].corner[a], s->crack[k].corner[a], X, s->dim) < r) return true;
    return false;
}

/* Returns true if X[dim] [m] is so near a POINT or SIF probe of the scene s that particles are needed there: within
 * three cells of the point, or of the largest contour around the crack tip. h: edge of a cell [m]. */
static bool probed(const struct scene *s, const real *X, real h)
{
    for (int k = 0; k < s->probes; k++) {
        const struct probe_request *probe = &s->probe[k];
        const struct number_list *ring = &probe->contours;
        const real outer = probe->outer > 0 ? probe->outer : 20 * s->spacing;
        const real reach = ring->n > 0 ? real_max(outer, ring->value[ring->n - 1]) : outer;
        if (probe->kind == PROBE_POINT && near_probe(s, probe, X, 3 * h)) return true;
        if (probe->kind == PROBE_SIF && near_probe(s, probe, X, reach + 3 * h)) return true;
    }
    return false;
}

/* Returns true if particles must be created in cell I of `hollow` because it is near a pre-crack or a probe, in the
 * region of a load, on a loaded face, or near the region that is peridynamic from the start of scene s. source: has the
 * cutoff of bonds. */
static bool cell_needed(const struct scene *s, const struct bond_source *source,
                        const struct cells_without_particles *hollow, int64_t I)
{
    for (int c = 0; c < 1 << s->dim; c++) {
        real X[DIM_MAX] = {0};
        for (int d = 0; d < s->dim; d++) X[d] = grid_cell_quadrature_point_coordinate(&hollow->box, I, c, d);
        if (c == 0 && (near_cracks(s, source, X, hollow->box.h) || probed(s, X, hollow->box.h))) return true;
        if (loads_reach(s, X, s->spacing) || face_loaded(s, hollow, I, X)) return true;
        if (s->has_pd_region && region_contains(&s->pd_region, X, s->dim, 2 * source->family.cutoff)) return true;
    }
    return false;
}

status cells_without_particles_predict_from_scene(struct cells_without_particles *hollow, const struct scene *s,
                                                  const struct bond_source *source)
{
    int64_t absent = 0;
    if (hollow->whole || scene_reason_all_particles_must_be_created(s)) return OK;
    TRY(box_find(&hollow->box, s));
    const int64_t least = s->fill == FILL_NEEDED ? 0 : PAYS >> hollow->box.dim;
    if (hollow->box.n <= least) return OK;
    body_flag_cells_with_all_lattice_sites_inside(hollow, s, 0);
    hollow->absent = NEW("hollow.absent", hollow->box.n, uint8_t);
#pragma omp parallel for schedule(dynamic, 4096) reduction(+ : absent)
    for (int64_t I = 0; I < hollow->box.n; I++) {
        hollow->absent[I] = hollow->whole[I] && !cell_needed(s, source, hollow, I);
        absent += hollow->absent[I];
    }
    /* positions of loads, faces of pre-cracks and probes do not change */
    array_copy(hollow->whole, hollow->absent, hollow->box.n, 1);
    if (absent > least) return OK;
    memory_free(hollow->absent);
    hollow->absent = NULL;
    return OK;
}

/* ---- levels ------------------------------------------------------------------------------------------------------ */

/* Returns true if a cell whose particles were not created now has level 0, the finest, so that the run must be set up
 * again with more particles. new_cell_level[mesh->grid.n]: level of each cell of the mesh, 0: finest. */
bool mesh_any_new_finest_cell_lacks_particles(const struct mesh *mesh, const uint8_t *new_cell_level)
{
    for (int64_t I = 0; I < mesh->grid.n && mesh->absent; I++)
        if (mesh->absent[I] && new_cell_level[I] == 0) return true;
    return false;
}

/* Returns an array of flags [box.n] that are 1 for the cells of reference->hollow.box whose particles need not be
 * created. Particles are created near cells of level 0, the finest: within `margin` cells, and within `ahead` cells of
 * those that have no particles at present. A coarse cell has all of its particles or none. level: level of each cell of
 * the mesh of r. Release the flags with memory_free. */
static uint8_t *absent_with(const struct lagrangian_mesh *reference, const uint8_t *level, int margin, int ahead)
{
    const struct cells_without_particles *hollow = &reference->hollow;
    const struct grid *g = &reference->mesh.grid;
    uint8_t *absent = NEW("hollow.absent", hollow->box.n, uint8_t), *keep = NEW("hollow.keep", g->n, uint8_t);
    uint8_t *outgrown = NEW("hollow.outgrown", g->n, uint8_t);
    for (int64_t I = 0; I < g->n; I++) { /* also where bonds have taken all points of a cell */
        const int64_t J = grid_cell_index_in_other_grid(g, I, &hollow->box);
        keep[I] = level[I] == 0 && (mesh_cell_contains_material(&reference->mesh, I) || (J >= 0 && hollow->whole[J]));
        outgrown[I] = keep[I] && reference->mesh.absent && reference->mesh.absent[I];
    }
    mesh_levels_mark_cells_near_marked_cells(&reference->levels, keep, margin);
    mesh_levels_mark_cells_near_marked_cells(&reference->levels, outgrown, ahead);
    for (int64_t I = 0; I < g->n; I++) {
        const int64_t J = grid_cell_index_in_other_grid(g, I, &hollow->box);
        keep[I] = keep[I] || outgrown[I] || J < 0 || !hollow->whole[J];
    }
    mesh_levels_extend_marks_to_whole_coarse_cells(&reference->levels, level, keep);
    for (int64_t I = 0; I < g->n; I++)
        if (!keep[I]) absent[grid_cell_index_in_other_grid(g, I, &hollow->box)] = 1;
    memory_free(outgrown);
    memory_free(keep);
    return absent;
}

bool mesh_check_all_initially_finest_cells_are_filled(struct lagrangian_mesh *reference, const uint8_t *cell_level)
{
    if (!reference->hollow.absent) return true;
    if (reference->hollow.restored) return false; /* the checkpoint contains the levels */
    if (!cell_level) {                            /* no coarse cells */
        memory_free(reference->hollow.absent);
        reference->hollow.absent = NULL, reference->lacks = true;
        return false;
    }
    reference->lacks = mesh_any_new_finest_cell_lacks_particles(&reference->mesh, cell_level);
    if (!reference->lacks) return true;
    uint8_t *absent = absent_with(reference, cell_level, 0, 0);
    for (int64_t J = 0; J < reference->hollow.box.n; J++) reference->hollow.absent[J] &= absent[J];
    memory_free(absent);
    return false;
}

void cells_without_particles_update_from_levels(struct lagrangian_mesh *reference, const uint8_t *cell_level)
{
    uint8_t *absent = absent_with(reference, cell_level, MARGIN, AHEAD);
    memory_free(reference->hollow.absent);
    reference->hollow.absent = absent;
}
