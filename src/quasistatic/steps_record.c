/* Writes the columns that load steps add to history.csv, and computes the crack area and the energy release rate for
 * them. */
#include <math.h>
#include <string.h>

#include "steps_record.h"
#include "crack_increment.h"
#include "sif_cracks.h"
#include "load_size.h"
#include "contact_set.h"

#include "fracture/fracture_part.h"
#include "probes/diagnostics.h"

/* Growth of the cracks over which the energy release rate is computed [spacings], since crack lengths from damage
 * change in steps of one spacing. */
#define GROWTH 4

enum { STATICS_COLUMNS = 13 }; /* number of columns of load steps in history.csv; one less in 2D */

int statics_list_history_columns(const struct run *run, struct column *column)
{
    static const struct column own[STATICS_COLUMNS] = {{"load_time", "s"},
                                                       {"stretch_ratio", ""},
                                                       {"released", "J"},
                                                       {"crack_area", "m^2"},
                                                       {"release_rate", "J/m^2"},
                                                       {"bonds_broken", ""},
                                                       {"search_directions", ""},
                                                       {"equilibria", ""},
                                                       {"K_I", "Pa m^(1/2)"},
                                                       {"K_II", "Pa m^(1/2)"},
                                                       {"path_x", "m"},
                                                       {"path_y", "m"},
                                                       {"path_z", "m"}};
    if (!scene_has_load_steps(run->scene)) return 0;
    const int n = STATICS_COLUMNS - (run->part.dim < 3);
    if (column) array_copy(column, own, n, sizeof *own);
    return n;
}

/* Returns the area by which the cracks grow if each grows by one spacing [m^2]: the spacing times the total length of
 * the fronts of all pre-cracks t, or times one spacing if there are none. For a bar it is its section. section: section
 * of a bar [m^2] or thickness of a plane body [m]. */
static real growth_by_spacing(const struct crack_tips *t, real section)
{
    real wide = 0;
    if (t->dim == 1) return section;
    for (int k = 0; k < t->n; k++)
        if (t->tip[k].from_crack) wide += t->dim == 2 ? section : 2 * sqrt(dot(t->tip[k].edge, t->tip[k].edge, t->dim));
    if (wide == 0) wide = t->dim == 2 ? section : t->spacing;
    return t->spacing * wide;
}

/* Returns the damage (0 to 1, share of broken bonds) of the particles next to a cut that separates two neighbouring
 * planes of the lattice of scene s: half of the fraction of bonds that are not parallel to the cut. */
static real damage_beside_cut(const struct scene *s)
{
    const int reach = (int)s->horizon, wide = s->dim > 1 ? reach : 0, deep = s->dim > 2 ? reach : 0;
    int64_t all = -1, along = -1;
    for (int x = -reach; x <= reach; x++)
        for (int y = -wide; y <= wide; y++)
            for (int z = -deep; z <= deep; z++) {
                const bool near = (real)(x * x + y * y + z * z) <= s->horizon * s->horizon;
                all += near, along += near && x == 0;
            }
    return 0.5 * (real)(all - along) / (real)all;
}

/* Returns the crack area along the paths of the SIF-driven tips `cracks` (directed by stress-intensity factors), summed
 * over the segments [m^2]. Of the result, `own` is the area in the modelled body, `face` the area of the whole crack
 * faces, twice as large for segments on planes of symmetry, which cut off half. p: particles, for the width of the
 * body. */
static struct crack_area sif_paths_area(const struct sif_cracks *cracks, const struct particles *p)
{
    struct crack_area area = {0};
    for (int64_t k = 0; k < cracks->segments; k++) {
        const real *from = cracks->path[k].at[0], *to = cracks->path[k].at[1];
        const real own = crack_tip_plane_crack_area(&cracks->plane, p, from, to);
        area.own += own,
            area.face += own * (crack_tip_plane_segment_is_on_symmetry_plane(&cracks->plane, from, to) ? 2 : 1);
    }
    return area;
}

/* Updates in run->statics->record the crack area, the released energy and the energy release rate, a quotient of
 * differences over the last one to two growths of the crack. The area follows from the paths of SIF-driven tips
 * (directed by stress-intensity factors), unless damaged particles indicate more than 1.5 spacings of further growth.
 * Without such tips it follows from damaged particles, in 3D from broken bonds, in a bar from its cuts. Areas from
 * damaged particles change in steps of one spacing, so that a growth then has GROWTH spacings. A load step without
 * growth leaves the rate unchanged. */
static void measure(struct run *run)
{
    const struct statics *s = run->statics;
    struct steps_record *r = &run->statics->record;
    const real section = scene_cross_section_or_thickness(run->scene);
    const struct tip_surroundings around = {run->source.mirror, run->source.mirrors, section,
                                            0.5 * damage_beside_cut(run->scene)};
    const struct crack_area path = sif_paths_area(&s->sif, &run->part);
    const real spacing = growth_by_spacing(&run->fracture->tips, section);
    const bool solid = run->part.dim == 3 && path.own == 0;
    const struct crack_area bonds = {r->broken / crack_area_fraction_inside_modelled_body(&run->fracture->tips,
                                                                                          &run->source, -1),
                                     r->broken},
                            damaged = solid ? bonds
                                      : run->part.dim == 1
                                          ? bar_total_crack_area(&run->bonds, &run->part, section)
                                          : tips_total_crack_area(&run->fracture->tips, &run->part, &around);
    const bool by_path = path.own > 0 && damaged.own <= path.own + 1.5 * spacing;
    const real area = by_path ? path.own : damaged.own, growth = by_path || solid ? 0 : GROWTH * spacing;
    r->released = statics_energy_released_since_start(s, &run->bonds);
    if (!(area > r->area)) return;
    r->area = area, r->face = by_path ? path.face : damaged.face;
    r->rate = (r->released - r->mark[0].released) / (area - r->mark[0].area);
    if (area - r->mark[1].area < growth * (1 - 1e-9)) return;
    r->mark[0] = r->mark[1];
    r->mark[1] = (struct release_mark){area, r->released};
}

void statics_compute_history_values(struct run *run, real *record)
{
    const struct statics *s = run->statics;
    real place[DIM_MAX];
    if (!scene_has_load_steps(run->scene)) return;
    measure(run);
    const real rate = s->record.area > 0 ? s->record.rate : NAN, bonds = 0.5 * (real)run->diagnostics->bonds_broken;
    const real own[STATICS_COLUMNS - MODES - DIM_MAX] = {s->t,
                                                         s->stretch_ratio,
                                                         s->record.released,
                                                         s->record.face,
                                                         rate,
                                                         bonds,
                                                         (real)(s->balance.directions - s->record.directions),
                                                         (real)(s->solutions - s->record.solutions)};
    memcpy(record, own, sizeof own);
    sif_leading_tip_compute_intensity_factors(&s->sif, &run->part, crack_faces_are_in_contact(run->contact),
                                              record + COUNT_OF(own));
    sif_leading_tip_compute_position(&s->sif, place);
    array_copy(record + COUNT_OF(own) + MODES, place, run->part.dim < 3 ? 2 : 3, sizeof *place);
}

void statics_reset_solver_counts_for_history(struct statics *s)
{
    s->record.directions = s->balance.directions, s->record.solutions = s->solutions;
}
