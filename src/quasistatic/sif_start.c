/* Starts SIF-driven cracks: selects the pre-cracks whose tips stress-intensity factors direct, and sets the initial
 * positions of these tips. */
#include <math.h>
#include <string.h>

#include "sif_cracks.h"
#include "quasistatic/statics.h"

#include "fracture/fracture_part.h"

#define HERE 1e-6    /* largest distance of the tip from the end of its pre-crack [spacings] */
#define ON_ROW 0.05  /* largest distance of a row of particles from a crack along it [spacings] */
#define ROW_SEEN 8.0 /* length ahead of the tip in which particles are examined [spacings] */
/* Least distance of the crack from the next row of particles, for a tip that lies on a row to be moved [spacings]. Rows
 * along a lattice axis are 1 apart, rows along a diagonal less. */
#define ROWS_APART 0.9
enum { ROW_LEAST = 4 }; /* particles of a row along the crack */

/* Compares the tip with both ends of every pre-crack of the scene of `cracks`; an end within HERE spacings of the tip
 * coincides with it. Stores in tip->length_behind the largest length of the pre-cracks that end there [m], and sets
 * tip->reversed to true if such an end is the first corner of its pre-crack. */
static void crack_behind_tip(const struct sif_cracks *cracks, struct sif_crack_tip *tip)
{
    const struct scene *s = cracks->scene;
    for (int k = 0; k < s->cracks; k++) {
        real at[2][DIM_MAX] = {{0}};
        crack_tip_plane_intersect_crack(&cracks->plane, &s->crack[k], at);
        for (int end = 0; end < 2; end++) {
            if (crack_tip_plane_point_distance(at[end], tip->position) > HERE * s->spacing) continue;
            tip->length_behind = real_max(tip->length_behind, crack_tip_plane_point_distance(at[0], at[1]));
            tip->reversed |= end == 0;
        }
    }
}

/* Moves a crack tip that lies on a row of at least ROW_LEAST particles of p sideways to half the distance to the next
 * row, so that round-off does not decide further growth. A crack along a row assigns the particles of the row to one of
 * its faces (crack_cuts_bond); the tip is moved to the side on which bonds are then cut. plane: plane in which tips
 * move. Returns true if the tip has been moved. Does nothing, and returns false, for a tip on a plane of symmetry. */
static bool tip_off_row(const struct crack_tip_plane *plane, const struct particles *p, struct sif_crack_tip *tip)
{
    const real h = plane->spacing, *along = tip->along;
    real next = h;
    int64_t on = 0;
    for (int64_t i = 0; i < p->n; i++) {
        real X[2];
        crack_tip_plane_project_particle(plane, p, i, X);
        for (int d = 0; d < 2; d++) X[d] -= tip->position[d];
        const real ahead = dot(along, X, 2), aside = fabs(along[0] * X[1] - along[1] * X[0]);
        if (p->body[i] != tip->body || !(ahead > 0 && ahead < ROW_SEEN * h)) continue;
        on += aside < ON_ROW * h;
        next = aside < ON_ROW * h ? next : real_min(next, aside);
    }
    const real below = (tip->reversed ? 0.5 : -0.5) * next;
    if (on < ROW_LEAST || next < ROWS_APART * h || sif_tip_path_end_is_on_symmetry_plane(plane, tip)) return false;
    tip->position[0] -= below * along[1], tip->position[1] += below * along[0];
    memcpy(tip->start, tip->position, sizeof tip->start);
    return true;
}

/* Creates in run->statics->sif the SIF-driven tips (directed by stress-intensity factors) of the pre-cracks of the run
 * that end in the body. */
static void sif_tips_start(struct run *run)
{
    struct sif_cracks *cracks = &run->statics->sif;
    const struct crack_tips *t = &run->fracture->tips;
    cracks->known = true;
    for (int k = 0; k < t->n; k++) {
        const struct crack_tip *from = &t->tip[k];
        real position[2], along[2];
        if (!from->from_crack) continue;
        struct sif_crack_tip *tip = &cracks->tip[cracks->n++];
        *tip = (struct sif_crack_tip){.body = from->body};
        crack_tip_plane_project_point(&cracks->plane, from->origin, position);
        crack_tip_plane_project_point(&cracks->plane, from->along, along);
        for (int d = 0; d < 2; d++) {
            tip->start[d] = tip->position[d] = position[d];
            tip->along[d] = tip->heading[d] = tip->last[d] = along[d];
        }
        crack_behind_tip(cracks, tip);
        if (tip_off_row(&cracks->plane, &run->part, tip)) sif_tip_break_bonds_across_precrack_behind(run, tip);
    }
}

const char *sif_growth_reason_direction_is_undetermined(const struct run *run, struct crack_tip_plane *plane)
{
    const struct scene *s = run->scene;
    struct crack_tip_plane unused;
    const bool one =
        s->bodies == 1 && s->materials == 1; /* the hoop-stress criterion ignores differences in toughness */
    if (!plane) plane = &unused;
    *plane = (struct crack_tip_plane){.made = true,
                                      .dim = run->part.dim,
                                      .spacing = s->spacing,
                                      .section = scene_cross_section_or_thickness(s),
                                      .body_mirrors = run->source.mirrors,
                                      .body_mirror = run->source.mirror};
    if (s->steps.path == PATH_BONDS) return "steps.path is bonds";
    if (s->steps.path == PATH_AUTO && !one) return "the scene has several bodies or materials";
    return crack_tip_plane_find_or_return_reason(plane, &run->fracture->tips, &run->tables.cracks, &run->part);
}

status sif_growth_check_direction_is_determinable(const struct run *run)
{
    if (!scene_has_load_steps(run->scene) || run->scene->steps.path != PATH_HOOP || run->scene->dim != 3) return OK;
    const char *fault = sif_growth_reason_direction_is_undetermined(run, NULL);
    return fault ? status_set(REFUSED,
                              "steps.path: hoop (crack growth by the hoop stress) needs straight, parallel crack "
                              "fronts through the whole body, but %s; set steps.path: bonds or auto",
                              fault)
                 : OK;
}

bool sif_cracks_find_tips_and_test_if_any_can_grow(struct run *run)
{
    struct sif_cracks *cracks = &run->statics->sif;
    cracks->scene = run->scene, cracks->source = &run->source;
    if (!cracks->plane.made) cracks->fault = sif_growth_reason_direction_is_undetermined(run, &cracks->plane);
    if (cracks->fault) return false;
    if (!cracks->known) sif_tips_start(run);
    for (int k = 0; k < cracks->n; k++)
        if (!cracks->tip[k].ended) return true;
    return false;
}
