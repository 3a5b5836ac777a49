/* Tips of pre-cracks that load steps lead: which there are, and where they begin. */
#include <math.h>
#include <string.h>

#include "led.h"

#include "fracture/fracture_part.h"

#define HERE 1e-6      /* from the end of a pre-crack to the tip there [spacings] */
#define ON_ROW 0.05    /* from a row of the lattice to a crack along it [spacings] */
#define ROW_SEEN 8.0   /* length of a row that is looked at [spacings] */
#define ROWS_APART 0.9 /* rows along an axis of the lattice; cracks along its diagonals do as they are [spacings] */
enum { ROW_LEAST = 4 };

/* Length of the longest pre-crack that ends at the tip, and whether one begins there. */
static void cracks_behind(const struct led *l, struct led_tip *tip)
{
    const struct scene *s = l->scene;
    for (int k = 0; k < s->cracks; k++) {
        real at[2][DIM_MAX] = {{0}};
        led_segment(&l->plane, &s->crack[k], at);
        for (int end = 0; end < 2; end++) {
            if (led_distance(at[end], tip->place) > HERE * s->spacing) continue;
            tip->sees = real_max(tip->sees, led_distance(at[0], at[1]));
            tip->reversed |= end == 0;
        }
    }
}

/* Rows of a lattice lie on one face of a crack that goes along them, as crack_cuts counts them. The tip begins halfway
 * to the next row, where bonds have been cut, and stays clear of what round-off would say of the row. */
static bool leave_row(const struct led_plane *plane, const struct particles *p, struct led_tip *tip)
{
    const real h = plane->spacing, *along = tip->along;
    real next = h;
    int64_t on = 0;
    for (int64_t i = 0; i < p->n; i++) {
        real X[2];
        led_project_particle(plane, p, i, X);
        for (int d = 0; d < 2; d++) X[d] -= tip->place[d];
        const real ahead = dot(along, X, 2), aside = fabs(along[0] * X[1] - along[1] * X[0]);
        if (p->body[i] != tip->body || !(ahead > 0 && ahead < ROW_SEEN * h)) continue;
        on += aside < ON_ROW * h;
        next = aside < ON_ROW * h ? next : real_min(next, aside);
    }
    const real below = (tip->reversed ? 0.5 : -0.5) * next;
    if (on < ROW_LEAST || next < ROWS_APART * h || led_along_mirror(plane, tip)) return false;
    tip->place[0] -= below * along[1], tip->place[1] += below * along[0];
    memcpy(tip->start, tip->place, sizeof tip->start);
    return true;
}

static void led_start(struct run *e)
{
    struct led *l = &e->statics->led;
    const struct tips *t = &e->fracture->tips;
    l->known = true;
    for (int k = 0; k < t->n; k++) {
        const struct tip *from = &t->tip[k];
        real place[2], along[2];
        if (!from->from_crack) continue;
        struct led_tip *tip = &l->tip[l->n++];
        *tip = (struct led_tip){.body = from->body};
        led_project(&l->plane, from->origin, place);
        led_project(&l->plane, from->along, along);
        for (int d = 0; d < 2; d++) {
            tip->start[d] = tip->place[d] = place[d];
            tip->along[d] = tip->heading[d] = tip->last[d] = along[d];
        }
        cracks_behind(l, tip);
        if (leave_row(&l->plane, &e->part, tip)) led_free_behind(e, tip);
    }
}

const char *led_fault(const struct run *e, struct led_plane *plane)
{
    const struct scene *s = e->scene;
    struct led_plane unused;
    const bool one = s->bodies == 1 && s->materials == 1; /* hoop stress knows no toughness */
    if (!plane) plane = &unused;
    *plane = (struct led_plane){.made = true,
                                .dim = e->part.dim,
                                .spacing = s->spacing,
                                .section = scene_section(s),
                                .body_mirrors = e->source.mirrors,
                                .body_mirror = e->source.mirror};
    if (s->steps.path == PATH_BONDS) return "steps.path is bonds";
    if (s->steps.path == PATH_AUTO && !one) return "there are several bodies or materials";
    return led_plane_find(plane, &e->fracture->tips, &e->tables.cracks, &e->part);
}

status led_check(const struct run *e)
{
    if (!scene_in_steps(e->scene) || e->scene->steps.path != PATH_HOOP || e->scene->dim != 3) return OK;
    const char *fault = led_fault(e, NULL);
    return fault ? status_set(REFUSED,
                              "steps.path: hoop leads straight fronts that go through the body, and %s; bonds, or "
                              "auto, is expected",
                              fault)
                 : OK;
}

bool led_leads(struct run *e)
{
    struct led *l = &e->statics->led;
    l->scene = e->scene, l->source = &e->source;
    if (!l->plane.made) l->fault = led_fault(e, &l->plane);
    if (l->fault) return false;
    if (!l->known) led_start(e);
    for (int k = 0; k < l->n; k++)
        if (!l->tip[k].ended) return true;
    return false;
}
