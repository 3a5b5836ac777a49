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
static void cracks_behind(const struct scene *s, const struct statics *statics, struct led_tip *tip)
{
    for (int k = 0; k < s->cracks; k++) {
        real at[2][DIM_MAX] = {{0}};
        led_segment(&statics->led.plane, &s->crack[k], s->dim, at);
        for (int end = 0; end < 2; end++) {
            if (led_distance(at[end], tip->place) > HERE * s->spacing) continue;
            tip->sees = real_max(tip->sees, led_distance(at[0], at[1]));
            tip->reversed |= end == 0;
        }
    }
}

/* Rows of a lattice lie on one face of a crack that goes along them, as crack_cuts counts them. The tip begins halfway
 * to the next row, where bonds have been cut, and stays clear of what round-off would say of the row. */
static void leave_row(struct run *e, struct led_tip *tip)
{
    const real h = e->scene->spacing, *along = tip->along;
    real next = h;
    int64_t on = 0;
    for (int64_t i = 0; i < e->part.n; i++) {
        real X[2];
        led_project_particle(e, i, X);
        for (int d = 0; d < 2; d++) X[d] -= tip->place[d];
        const real ahead = dot(along, X, 2), aside = fabs(along[0] * X[1] - along[1] * X[0]);
        if (e->part.body[i] != tip->body || !(ahead > 0 && ahead < ROW_SEEN * h)) continue;
        on += aside < ON_ROW * h;
        next = aside < ON_ROW * h ? next : real_min(next, aside);
    }
    const real below = (tip->reversed ? 0.5 : -0.5) * next;
    if (on < ROW_LEAST || next < ROWS_APART * h || led_along_mirror(e, tip)) return;
    tip->place[0] -= below * along[1], tip->place[1] += below * along[0];
    memcpy(tip->start, tip->place, sizeof tip->start);
    led_free_behind(e, tip);
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
        led_project(&l->plane, from->origin, e->part.dim, place);
        led_project(&l->plane, from->along, e->part.dim, along);
        for (int d = 0; d < 2; d++) {
            tip->start[d] = tip->place[d] = place[d];
            tip->along[d] = tip->heading[d] = tip->last[d] = along[d];
        }
        cracks_behind(e->scene, e->statics, tip);
        leave_row(e, tip);
    }
}

/* Why no tip is led, else NULL. */
static const char *led_fault(const struct run *e, struct led_plane *plane)
{
    const struct scene *s = e->scene;
    const bool one = s->bodies == 1 && s->materials == 1; /* hoop stress knows no toughness */
    *plane = (struct led_plane){.made = true};
    if (s->steps.path == PATH_BONDS) return "steps.path is bonds";
    return s->steps.path == PATH_AUTO && !one ? "there are several bodies or materials" : led_plane_find(e, plane);
}

const char *engine_led_fault(const struct run *e) { return led_fault(e, &(struct led_plane){0}); }

status led_check(const struct run *e)
{
    const char *fault = NULL;
    if (!scene_in_steps(e->scene) || e->scene->steps.path != PATH_HOOP || e->scene->dim != 3) return OK;
    fault = engine_led_fault(e);
    return fault ? status_set(REFUSED,
                              "steps.path: hoop leads straight fronts that go through the body, and %s; bonds, or "
                              "auto, is expected",
                              fault)
                 : OK;
}

bool led_leads(struct run *e)
{
    struct led *l = &e->statics->led;
    if (!l->plane.made) l->fault = led_fault(e, &l->plane);
    if (l->fault) return false;
    if (!l->known) led_start(e);
    for (int k = 0; k < l->n; k++)
        if (!l->tip[k].ended) return true;
    return false;
}
