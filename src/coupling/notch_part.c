/* Sets up the pre-cracks of a run as slits of the mesh or as cut bonds, describes the decision as text, and flags
 * points for conversion where the faces of slits approach each other. */
#include <math.h>
#include <stdio.h>

#include "grid/grid_part.h"
#include "coupling/coupling_part.h"
#include "mesh/mesh_part.h"

/* ---- choice ------------------------------------------------------------------------------------------------------ */

/* Returns the reason in scene s why pre-cracks may not be slits, along which nodes of the mesh are doubled, as a
 * constant text; NULL if nothing in the scene prevents slits. */
static const char *scene_obstacle(const struct scene *s)
{
    if (s->conversion.notch == NOTCH_BONDS) return "the scene sets this";
    if (s->growths > 0) return "the key growth weakens bonds along cracks, and a slit has no bonds";
    for (int k = 0; k < s->probes; k++)
        if (s->probe[k].kind == PROBE_SIF) return "a sif probe needs bonds along its crack, and a slit has no bonds";
    if (s->contact_between == CONTACT_ALL && !s->contact_convert)
        return "with contact.convert: false the faces of a slit would pass through each other";
    return NULL;
}

/* Returns the reason why pre-cracks may not be slits, along which nodes of the mesh are doubled, as a constant text: in
 * the scene s, the reference frame (mesh of the undeformed body) or the background grid g. Returns NULL if nothing
 * prevents slits. */
static const char *obstacle_of(const struct scene *s, const struct lagrangian_mesh *reference, const struct grid *g)
{
    const char *why = scene_obstacle(s);
    if (!why && !lagrangian_mesh_is_used_by_any_body(reference))
        why = "the scene has no material points in the reference frame";
    if (!why && grid_has_mirror_plane_between_nodes(g, s)) why = "a mirror plane is between two nodes of the mesh";
    return why;
}

/* Checks that all pre-cracks of n are slits, along which nodes of the mesh are doubled, if scene s requires this.
 * Returns REFUSED, with the reason in the message, if one of them is not; OK otherwise. */
static status notches_check(const struct scene *s, const struct notches *n)
{
    for (int k = 0; k < n->n && s->conversion.notch == NOTCH_SLIT; k++)
        if (!n->notch[k].slit)
            return status_set(REFUSED,
                              "conversion.notch: crack %d cannot be a slit of the mesh (a row of doubled nodes): %s; "
                              "set conversion.notch: auto or bonds",
                              k + 1, n->notch[k].reason);
    return OK;
}

status precracks_apply_as_slits_or_cut_bonds(struct run *run)
{
    const struct scene *s = run->scene;
    const struct grid *g = &run->grid->field[0].grid;
    struct notches *n = &run->coupling->notches;
    const real tips = s->conversion.tips * run->source.family.horizon;
    const real radius = tips > 0 ? real_max(tips, NOTCH_ZONE_LEAST * s->spacing) : NOTCH_ZONE * s->spacing;
    notches_choose_slits_or_cut_bonds(n, &run->part, &run->source, radius, obstacle_of(s, run->frame, g));
    TRY(notches_check(s, n));
    struct bond_source cut = run->source;
    cut.crack = n->cut, cut.cracks = n->cuts;
    initial_pd_region_make(&run->coupling->start_region, s->has_pd_region ? &s->pd_region : NULL, &run->part,
                           &run->source, tips);
    notches_make_slit_ends_peridynamic(n, &run->part, &run->source);
    convert_particles_beside_voids_to_peridynamic(&run->part, run->source.voids,
                                                  mesh_cannot_have_free_surfaces_at_voids(g, s));
    convert_particles_at_precracks_to_peridynamic(
        &run->part, &cut, run->coupling->start_region.n > 0 ? &run->coupling->start_region : NULL);
    return OK;
}

void notch_describe_as_slit_or_cut_bonds(const struct notches *n, int crack_number, real spacing, char *text,
                                         size_t capacity)
{
    if (n->notch[crack_number].slit)
        snprintf(text, capacity, "slit of the mesh, with bonds within %.3g spacings of its ends", n->radius / spacing);
    else
        snprintf(text, capacity, "cut bonds: %s", n->notch[crack_number].reason);
}

/* ---- in a run ---------------------------------------------------------------------------------------------------- */

/* Marks (FLAG_NEAR) the points beside the slits and voids n whose faces approach each other, so that they convert
 * before the faces touch: moves these points of p with the mesh of the reference frame `reference` first. loads: with
 * the mirror images of the points; spacing: of the particles [m]; time_ahead: time until the next call [s]. Returns
 * true if n has faces. */
bool mark_points_at_closing_slits_to_become_peridynamic(const struct notches *n, struct lagrangian_mesh *reference,
                                                        struct particles *p, const struct loads *loads, real spacing,
                                                        real time_ahead)
{
    if (n->faces == 0) return false;
    lagrangian_mesh_update_motion_of_listed_points(reference, p, loads, n->face, n->faces);
    notches_flag_closing_face_points_for_conversion(n, p, spacing, time_ahead);
    return true;
}
