/* Columns of history.csv that load steps have beside those of all runs; what is asked of them before they begin. */
#include <math.h>
#include <string.h>

#include "steps_record.h"
#include "led.h"
#include "load_size.h"
#include "touch.h"

#include "fracture/fracture_part.h"
#include "probes/diagnostics.h"

#define GROWTH 4 /* spacings of growth over which a release rate is taken: a length comes in steps of one */

enum { STATICS_COLUMNS = 13 }; /* in the plane one less */

int statics_columns(const struct run *e, struct column *column)
{
    static const struct column own[STATICS_COLUMNS] = {
        {"load_time", "s"},   {"overload", ""},   {"released", "J"},  {"crack_area", "m^2"}, {"release_rate", "J/m^2"},
        {"bonds_broken", ""}, {"directions", ""}, {"equilibria", ""}, {"K_I", "Pa m^(1/2)"}, {"K_II", "Pa m^(1/2)"},
        {"path_x", "m"},      {"path_y", "m"},    {"path_z", "m"}};
    if (!scene_in_steps(e->scene)) return 0;
    const int n = STATICS_COLUMNS - (e->part.dim < 3);
    if (column) array_copy(column, own, n, sizeof *own);
    return n;
}

/* Area by which the cracks grow over a spacing: as wide as all fronts of pre-cracks, else as one spacing [m^2]; in line
 * the section. */
static real growth_by_spacing(const struct tips *t, real section)
{
    real wide = 0;
    if (t->dim == 1) return section;
    for (int k = 0; k < t->n; k++)
        if (t->tip[k].from_crack) wide += t->dim == 2 ? section : 2 * sqrt(dot(t->tip[k].edge, t->tip[k].edge, t->dim));
    if (wide == 0) wide = t->dim == 2 ? section : t->spacing;
    return t->spacing * wide;
}

/* Damage of particles of a lattice beside a cut between two of its planes: half of their bonds but those along it. */
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

/* Area of the paths of tips that are led [m^2]. */
static real led_paths_area(const struct led *l, const struct particles *p)
{
    real area = 0;
    for (int64_t k = 0; k < l->stretches; k++) area += led_face_area(&l->plane, p, l->path[k].at[0], l->path[k].at[1]);
    return area;
}

/* Area so far, of what tips have been led along, or where damaged particles say that more than another spacing has
 * come, of these; in space, where no front is led, of the bonds that have broken, each by its share of the area that it
 * crosses; and the release rate over the last two growths. Of damaged particles, whose lengths come in steps of a
 * spacing, a growth is some spacings. A load step without growth changes no rate. */
static void measure(struct run *e)
{
    const struct statics *s = e->statics;
    struct steps_record *r = &e->statics->record;
    const struct tip_surroundings around = {e->source.mirror, e->source.mirrors, scene_section(e->scene),
                                            0.5 * damage_beside_cut(e->scene)};
    const real led = led_paths_area(&s->led, &e->part),
               spacing = growth_by_spacing(&e->fracture->tips, scene_section(e->scene));
    const bool solid = e->part.dim == 3 && led == 0;
    const real damaged = solid ? r->broken : tips_area(&e->fracture->tips, &e->part, &around);
    const bool by_paths = led > 0 && damaged <= led + 1.5 * spacing;
    const real area = by_paths ? led : damaged, growth = by_paths || solid ? 0 : GROWTH * spacing;
    r->released = statics_released(s, &e->bonds);
    if (!(area > r->area)) return;
    r->area = area;
    r->rate = (r->released - r->mark[0].released) / (area - r->mark[0].area);
    if (area - r->mark[1].area < growth * (1 - 1e-9)) return;
    r->mark[0] = r->mark[1];
    r->mark[1] = (struct release_mark){area, r->released};
}

void statics_record(struct run *e, real *record)
{
    const struct statics *s = e->statics;
    real place[DIM_MAX];
    if (!scene_in_steps(e->scene)) return;
    measure(e);
    const real rate = s->record.area > 0 ? s->record.rate : NAN, bonds = 0.5 * (real)e->diagnostics->bonds_broken;
    const real own[STATICS_COLUMNS - MODES - DIM_MAX] = {s->t,
                                                         s->overload,
                                                         s->record.released,
                                                         s->record.area,
                                                         rate,
                                                         bonds,
                                                         (real)(s->balance.directions - s->record.directions),
                                                         (real)(s->solutions - s->record.solutions)};
    memcpy(record, own, sizeof own);
    led_factors(&s->led, &e->part, statics_faces_closed(e->contact), record + COUNT_OF(own));
    led_place(&s->led, place);
    array_copy(record + COUNT_OF(own) + MODES, place, e->part.dim < 3 ? 2 : 3, sizeof *place);
}

void statics_record_keep(struct statics *s)
{
    s->record.directions = s->balance.directions, s->record.solutions = s->solutions;
}
