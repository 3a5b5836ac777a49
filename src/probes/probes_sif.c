/* Sets up and samples SIF probes (stress-intensity factors): finds the crack tip, which may move, the integration
 * contours around it, and the fields from which the factors are computed. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "probes_parts.h"

#define OUTER 20.0               /* default outer radius of a contour [spacings] */
#define OUTER_LEAST 10.0         /* smallest outer radius where the body or another tip is nearer [spacings] */
#define CORE 1.5                 /* default radius left out of the inertial integral (sif.h) [horizons] */
#define NARROWEST 3.0            /* least width of the ring of a contour [spacings] */
#define STEP_BACK 8.0            /* the direction of a moving tip is that of its last 8 to 16 spacings */
#define SAME_TIP 1.0             /* distance within which two tips are the same [spacings] */
#define FASTEST 0.95             /* largest speed of a tip [Rayleigh speeds] */
#define SPREAD_MOST 0.2          /* largest contour_spread with which factors are results [1] */
#define OPEN_ANGLE (170.0 / 180) /* share of the ring that must be in the body: crack faces may be open */

static const real pi = 3.14159265358979323846;

const struct column sif_figure[SIF_FIGURES] = {
    {"K_I", "Pa m^(1/2)"}, {"K_II", "Pa m^(1/2)"}, {"J", "J/m^2"}, {"contour_spread", ""}};

/* Crack tip of one SIF probe, its integration contours, and the fields from which the stress-intensity factors are
 * computed. Owned by the probe, and owns its arrays; released by sif_probe_free. */
struct sif_tracked {
    struct sif_tip tip;
    struct gradient_rule rule; /* how displacement gradients are computed */
    int follows;               /* index of the tip in the run; -1: none */
    int growth;                /* index of the crack with prescribed or SIF-controlled growth; -1: none */
    real reach;                /* outer radius of the largest contour [m] */
    int contours;
    /* [contours] contour 0 gives the results, the others are compared with contour 0 */
    struct contour contour[SIF_CONTOURS_MAX + 1];
    struct crack *crack;             /* pre-cracks of the scene, and a straight crack behind a tip without one */
    real behind[2][DIM_MAX];         /* ends of this straight crack [m] */
    bool kept;                       /* displacement and velocity are those of t and t_velocity */
    real t, t_velocity;              /* times of the displacement and of the velocity [s] */
    real *u[2], *v[2], *stress[3];   /* [n_all] displacement [m], velocity [m/s], stress [Pa] */
    real *mean[2], *acceleration[2]; /* [n_all] velocity [m/s] and acceleration [m/s^2] at the time of a sample */
    real *body[2];                   /* [n_all] forces of loads divided by masses [m/s^2] */
};

/* Returns true if the input file (scene) gives `value` for a key of the probe: it is then positive, else NAN. */
static bool given(real value) { return value > 0; }

/* ---- binding ----------------------------------------------------------------------------------------------------- */

/* Returns the index of the crack tip of the run o that request r refers to: the tip whose origin is nearest to its
 * position `at`, within SAME_TIP spacings, or the first tip if r has no `at`. Returns -1 if there is none. */
static int tip_meant(const struct probe_request *r, const struct observed_run *o)
{
    int nearest = -1;
    real least = SAME_TIP * o->spacing;
    const int tips = o->tips ? o->tips->n : 0;
    if (!r->has_at) return tips > 0 ? 0 : -1;
    for (int k = 0; k < tips; k++) {
        const real distance = hypot(o->tips->tip[k].origin[0] - r->at[0], o->tips->tip[k].origin[1] - r->at[1]);
        if (distance <= least) nearest = k, least = distance;
    }
    return nearest;
}

/* Returns the index of the growing crack of the run o that starts at most SAME_TIP spacings from the tip of the probe
 * `tracked` (a requested measurement), or -1 if there is none. */
static int growth_meant(const struct sif_tracked *tracked, const struct observed_run *o)
{
    for (int k = 0; k < o->growths; k++) {
        const real *at = o->growth[k].rule->at;
        if (hypot(at[0] - tracked->tip.place[0], at[1] - tracked->tip.place[1]) <= SAME_TIP * o->spacing) return k;
    }
    return -1;
}

/* Returns REFUSED, with a message, if the probe with request r controls the growth of a crack of the run o but measures
 * (w) the tip of another one. The input file (scene) must then give the key `at`, which selects the tip. */
static status own_growth(const struct sif_tracked *tracked, const struct probe_request *r, const struct observed_run *o)
{
    for (int k = 0; k < o->growths; k++) {
        const struct growth_rule *g = o->growth[k].rule;
        if (strcmp(g->probe, r->name) == 0 && k != tracked->growth)
            return status_set(REFUSED,
                              "probe \"%s\" controls the growth rule %s, but measures another tip, at (%.6g, %.6g) m; "
                              "set at: [%.6g m, %.6g m]",
                              r->name, g->name, tracked->tip.place[0], tracked->tip.place[1], g->at[0], g->at[1]);
    }
    return OK;
}

/* Finds for `tracked` position and direction of the crack tip of a probe of kind SIF (stress-intensity factors), from
 * the request r or from a pre-crack of the run o, and the growing crack that starts there. Returns REFUSED, with a
 * message, if position or direction is unknown, or if the probe controls the growth of a crack at another tip. */
static status find_tip(struct sif_tracked *tracked, const struct probe_request *r, const struct observed_run *o)
{
    tracked->follows = tip_meant(r, o);
    const struct crack_tip *tip = tracked->follows >= 0 ? &o->tips->tip[tracked->follows] : NULL;
    if (!tip && !r->has_at)
        return status_set(
            REFUSED,
            "probe \"%s\": no pre-crack ends inside a body; give the crack tip by the keys `at` and `direction`",
            r->name);
    if (!tip && !r->has_direction)
        return status_set(
            REFUSED,
            "probe \"%s\": no pre-crack ends at (%.6g, %.6g) m; give `direction`, the direction of crack growth",
            r->name, r->at[0], r->at[1]);
    const real *position = r->has_at ? r->at : tip->origin, *along = r->has_direction ? r->direction : tip->along;
    const real length = hypot(along[0], along[1]);
    for (int d = 0; d < 2; d++) tracked->tip.place[d] = position[d], tracked->tip.along[d] = along[d] / length;
    tracked->growth = growth_meant(tracked, o);
    return own_growth(tracked, r, o);
}

/* Lists in tracked->crack the cracks across which particles must not contribute to each other's gradients: the
 * pre-cracks of the run o and, unless one of them ends at the tip, a straight crack behind the tip. Sets
 * tracked->tip.face, the crack face to which particles exactly on the crack belong. sif_probe_free releases the list.
 */
static void make_cracks(struct sif_tracked *tracked, const struct observed_run *o)
{
    const struct sif_tip *t = &tracked->tip;
    bool ends = false;
    tracked->tip.face = 1;
    tracked->crack = NEW("sif.crack", o->cracks + 1, struct crack);
    for (int k = 0; k < o->cracks; k++) {
        tracked->crack[k] = o->crack[k];
        for (int e = 0; e < 2; e++) {
            const real *here = o->crack[k].corner[e], *there = o->crack[k].corner[1 - e];
            if (hypot(here[0] - t->place[0], here[1] - t->place[1]) > SAME_TIP * o->spacing) continue;
            const real onward = (here[0] - there[0]) * t->along[0] + (here[1] - there[1]) * t->along[1];
            tracked->tip.face = (onward > 0) == (e == 1) ? 1 : -1;
            ends = true;
        }
    }
    for (int d = 0; d < 2; d++) {
        tracked->behind[0][d] = t->place[d] - 2 * tracked->reach * t->along[d];
        tracked->behind[1][d] = t->place[d];
    }
    tracked->crack[o->cracks] = (struct crack){.n = 2, .corner = tracked->behind};
    tracked->rule.sight = (struct sight){.crack = tracked->crack, .cracks = o->cracks + !ends, .bonds = o->bonds};
}

/* Returns true if a circle of radius `radius` [m] around tip t is not completely inside the body of the run o. The part
 * near the crack faces, which may be open, more than OPEN_ANGLE pi from the direction ahead, is not tested. position:
 * receives a point of the circle without a particle nearby, if there is one [m]. */
static bool ring_leaves(const struct sif_tip *t, real radius, const struct observed_run *o, real position[2])
{
    const int stations = 16 + (int)real_min(1e4, 4 * radius / o->spacing);
    for (int k = 0; k <= stations; k++) {
        const real angle = OPEN_ANGLE * pi * (2.0 * k / stations - 1), c = radius * cos(angle), s = radius * sin(angle);
        position[0] = t->place[0] + c * t->along[0] - s * t->along[1];
        position[1] = t->place[1] + c * t->along[1] + s * t->along[0];
        if (probe_find_nearest_particle(o, (real[DIM_MAX]){position[0], position[1]}) < 0) return true;
    }
    return false;
}

/* Returns a crack tip of the run o, other than that of the probe `tracked` (a requested measurement), whose distance
 * from it is less than `radius` [m], or NULL if there is none. */
static const struct crack_tip *other_tip_within(const struct sif_tracked *tracked, real radius,
                                                const struct observed_run *o)
{
    for (int k = 0; o->tips && k < o->tips->n; k++) {
        const real *other = o->tips->tip[k].origin;
        if (k != tracked->follows && hypot(other[0] - tracked->tip.place[0], other[1] - tracked->tip.place[1]) < radius)
            return &o->tips->tip[k];
    }
    return NULL;
}

/* Returns the outer radius of the contour of the probe `tracked` of kind SIF (stress-intensity factors) of the run o
 * whose request r gives none: OUTER spacings or, if r gives no other radius either, the first of 0.9, 0.8 .. 0.5 times
 * this value that stays in the body and contains no other tip [m]. */
static real default_outer_radius(const struct sif_tracked *tracked, const struct probe_request *r,
                                 const struct observed_run *o)
{
    const real most = OUTER * o->spacing;
    real beyond[2];
    if (given(r->inner) || r->contours.n > 0) return most;
    for (real radius = most; radius >= (OUTER_LEAST - 1e-9) * o->spacing; radius -= 0.1 * most)
        if (!ring_leaves(&tracked->tip, radius, o, beyond) && !other_tip_within(tracked, radius, o)) return radius;
    return most;
}

/* Sets the integration contours of the probe `tracked` of kind SIF (stress-intensity factors) of the run o: contour[0],
 * from which the results are computed, then further ones for comparison, which have the radii of request r, or 0.6, 0.8
 * and 1 times the outer radius of contour[0]. Sets tracked->reach to the largest outer radius. */
static void make_contours(struct sif_tracked *tracked, const struct probe_request *r, const struct observed_run *o)
{
    const real outer = given(r->outer) ? r->outer : default_outer_radius(tracked, r, o),
               inner = given(r->inner) ? r->inner : 0.5 * outer;
    const struct number_list *list = &r->contours;
    tracked->contour[tracked->contours++] = (struct contour){inner, outer};
    for (int k = 0; k < (list->n > 0 ? list->n : 3); k++) {
        const real radius = list->n > 0 ? list->value[k] : (0.6 + 0.2 * k) * outer;
        tracked->contour[tracked->contours++] = (struct contour){radius * inner / outer, radius};
    }
    for (int k = 0; k < tracked->contours; k++) tracked->reach = real_max(tracked->reach, tracked->contour[k].outer);
}

/* Returns REFUSED with a message: the largest contour of `tracked` leaves the body of the run o at position[2] [m]. The
 * message proposes an outer radius that fits: the largest of 0.9, 0.8 .. 0.1 times the present one. name: name of the
 * probe. */
static status refuse_leaving(const struct sif_tracked *tracked, const char *name, const struct observed_run *o,
                             const real position[2])
{
    char fits[80] = "a smaller probes.sif.outer or particles.spacing";
    real beyond[2];
    for (int tenths = 1; tenths < 10 && !ring_leaves(&tracked->tip, 0.1 * tenths * tracked->reach, o, beyond); tenths++)
        snprintf(fits, sizeof fits, "sif: {outer: %.3g m}, or less", 0.1 * tenths * tracked->reach);
    return status_set(REFUSED,
                      "probe \"%s\": the ring of radius %.6g m around the tip (%.6g, %.6g) m leaves the body at (%.6g, "
                      "%.6g) m; use %s",
                      name, tracked->reach, tracked->tip.place[0], tracked->tip.place[1], position[0], position[1],
                      fits);
}

/* Returns REFUSED, with a message, if a contour of `tracked` is narrower than NARROWEST spacings, leaves the body, or
 * contains another crack tip. r: request of the probe. o: view of the run. */
static status check_ring(const struct sif_tracked *tracked, const struct probe_request *r, const struct observed_run *o)
{
    real position[2], narrowest = INFINITY;
    for (int k = 0; k < tracked->contours; k++)
        narrowest = real_min(narrowest, tracked->contour[k].outer - tracked->contour[k].inner);
    for (int k = 0; k < tracked->contours; k++) {
        const struct contour *c = &tracked->contour[k];
        if (c->outer - c->inner < NARROWEST * o->spacing * (1 - 1e-9))
            return status_set(REFUSED,
                              "probe \"%s\": the ring from %.6g to %.6g m is narrower than %.0f spacings; use sif: "
                              "{outer: %.3g m}, or more",
                              r->name, c->inner, c->outer, NARROWEST,
                              tracked->reach * NARROWEST * o->spacing / narrowest);
    }
    if (ring_leaves(&tracked->tip, tracked->reach, o, position)) return refuse_leaving(tracked, r->name, o, position);
    const struct crack_tip *tip = other_tip_within(tracked, tracked->reach, o);
    if (!tip) return OK;
    const real *other = tip->origin,
               distance = hypot(other[0] - tracked->tip.place[0], other[1] - tracked->tip.place[1]);
    return status_set(REFUSED,
                      "probe \"%s\": another crack's tip at (%.6g, %.6g) m is within its radius %.6g m; use "
                      "sif: {outer: %.3g m}, or less",
                      r->name, other[0], other[1], tracked->reach, 0.99 * distance);
}

/* Stores in `tracked` the body number and the elastic constants of the material around the tip. r: request, for
 * messages; o: run. Returns REFUSED, with a message, if no particle is one spacing ahead of the tip, or if another
 * material or body is within the contours. */
static status find_medium(struct sif_tracked *tracked, const struct probe_request *r, const struct observed_run *o)
{
    const struct particles *p = o->part;
    const real *e = tracked->tip.along, *at = tracked->tip.place;
    const int32_t ahead =
        probe_find_nearest_particle(o, (real[DIM_MAX]){at[0] + o->spacing * e[0], at[1] + o->spacing * e[1]});
    if (ahead < 0)
        return status_set(REFUSED,
                          "probe \"%s\": no particle is ahead of its tip (%.6g, %.6g) m; check `at` and `direction`",
                          r->name, at[0], at[1]);
    tracked->tip.body = p->body[ahead];
    tracked->tip.medium = crack_medium_of_material(&o->material[p->material[ahead]], o->space);
    for (int64_t i = 0; i < p->n; i++) {
        const real distance = hypot(p->X[0][i] - at[0], p->X[1][i] - at[1]);
        if (distance > tracked->reach) continue;
        if (p->material[i] != p->material[ahead] || p->body[i] != tracked->tip.body)
            return status_set(REFUSED,
                              "probe \"%s\": another material or body is within its radius %.6g m, at (%.6g, %.6g) m; "
                              "use sif: {outer: %.3g m}, or less",
                              r->name, tracked->reach, p->X[0][i], p->X[1][i], 0.99 * distance);
    }
    return OK;
}

status sif_probe_find_tip_and_contours(struct probe *probe, const struct observed_run *o)
{
    const struct probe_request *r = &probe->request;
    if (o->part->dim != 2)
        return status_set(
            REFUSED, "probe \"%s\" needs space: plane stress or plane strain; set one of these, or remove the probe",
            r->name);
    struct sif_tracked *tracked = probe->sif = NEW("sif", 1, struct sif_tracked);
    TRY(find_tip(tracked, r, o));
    make_contours(tracked, r, o);
    TRY(find_medium(tracked, r, o));
    TRY(check_ring(tracked, r, o));
    make_cracks(tracked, o);
    tracked->tip.weight = r->weight, tracked->tip.stress = r->stress, tracked->tip.thickness = o->thickness;
    tracked->tip.core = isnan(r->core) ? CORE * o->horizon : r->core;
    tracked->rule.method = r->gradient, tracked->rule.diffraction = r->diffraction;
    tracked->rule.reach = (given(r->reach) ? r->reach : 1.5) * o->spacing;
    for (int d = 0; d < 2; d++) {
        probe->memory.trail[0][d] = tracked->tip.place[d] - STEP_BACK * o->spacing * tracked->tip.along[d];
        probe->memory.trail[1][d] = tracked->tip.place[d];
    }
    return OK;
}

void sif_probe_free(struct sif_tracked *tracked)
{
    if (!tracked) return;
    for (int d = 0; d < 2; d++) {
        memory_free(tracked->u[d]), memory_free(tracked->v[d]);
        memory_free(tracked->mean[d]), memory_free(tracked->acceleration[d]), memory_free(tracked->body[d]);
    }
    for (int k = 0; k < 3; k++) memory_free(tracked->stress[k]);
    memory_free(tracked->crack);
    memory_free(tracked);
}

/* ---- present tip ------------------------------------------------------------------------------------------------- */

/* Updates position, speed and direction of the tip of the probe of kind SIF (stress-intensity factors) from the run o.
 * Returns true if the tip belongs to a crack that grows because bonds break. Returns false for tips at rest, and for
 * cracks that grow at a prescribed or controlled speed, since the position of their tip is known exactly. */
static bool probes_sif_follow(struct probe *probe, const struct observed_run *o)
{
    struct sif_tracked *tracked = probe->sif;
    const struct crack_tip *tip =
        tracked->follows >= 0 && tracked->follows < o->tips->n ? &o->tips->tip[tracked->follows] : NULL;
    real(*trail)[2] = probe->memory.trail;
    tracked->tip.speed = 0;
    if (tracked->growth >= 0) { /* the tip of a growth is known exactly */
        const struct growing_crack *g = &o->growth[tracked->growth];
        for (int d = 0; d < 2; d++) tracked->tip.place[d] = g->place[d], tracked->tip.along[d] = g->along[d];
        tracked->tip.speed = real_min(g->speed, FASTEST * tracked->tip.medium.rayleigh);
        return false;
    }
    if (!tip || !(tip->growth > 0)) return false;
    for (int d = 0; d < 2; d++) tracked->tip.place[d] = tip->place[d];
    const real speed =
        given(probe->request.speed) ? probe->request.speed : tips_average_speed(o->tips, tracked->follows);
    tracked->tip.speed = real_max(0, real_min(speed, FASTEST * tracked->tip.medium.rayleigh));
    if (hypot(tracked->tip.place[0] - trail[1][0], tracked->tip.place[1] - trail[1][1]) >= STEP_BACK * o->spacing)
        for (int d = 0; d < 2; d++) trail[0][d] = trail[1][d], trail[1][d] = tracked->tip.place[d];
    if (probe->request.has_direction) return true;
    const real path[2] = {tracked->tip.place[0] - trail[0][0], tracked->tip.place[1] - trail[0][1]},
               length = hypot(path[0], path[1]);
    for (int d = 0; d < 2; d++) tracked->tip.along[d] = path[d] / length;
    return true;
}

/* ---- samples ----------------------------------------------------------------------------------------------------- */

/* Allocates *array with n zeroed entries if it is NULL. */
static void room(real **array, int64_t n)
{
    if (!*array) *array = NEW("sif.motion", n, real);
}

/* Copies the in-plane displacements of all particles to tracked->u and, if the factors are computed from stresses of
 * particles (SIF_PARTICLE), the in-plane stresses xx yy xy to tracked->stress. p: all particles. */
static void keep_displacement(struct sif_tracked *tracked, const struct particles *p)
{
    for (int d = 0; d < 2; d++) {
        room(&tracked->u[d], p->n_all);
        for (int64_t i = 0; i < p->n_all; i++) tracked->u[d][i] = p->x[d][i] - p->X[d][i];
    }
    for (int k = 0; k < 3 && tracked->tip.stress == SIF_PARTICLE; k++) {
        room(&tracked->stress[k], p->n_all);
        array_copy(tracked->stress[k], p->stress[k], p->n_all, sizeof(real));
    }
}

void sif_probe_store_motion_before_step(struct probe *probe, const struct observed_run *o)
{
    struct sif_tracked *tracked = probe->sif;
    const struct particles *p = o->part;
    tracked->kept = true, tracked->t = o->t, tracked->t_velocity = o->t_velocity;
    keep_displacement(tracked, p);
    for (int d = 0; d < 2; d++) {
        room(&tracked->v[d], p->n_all), room(&tracked->mean[d], p->n_all), room(&tracked->acceleration[d], p->n_all);
        array_copy(tracked->v[d], p->v[d], p->n_all, sizeof(real));
    }
}

/* Computes tracked->mean and tracked->acceleration, velocity and acceleration of all particles at the time of the
 * sample from the velocities half a step before and after it. t_velocity: time of the current velocities [s]. After the
 * last sample no step follows, and the velocities of one step earlier are used instead. p: all particles. */
static void find_inertia(struct sif_tracked *tracked, const struct particles *p, real t_velocity)
{
    for (int d = 0; d < 2; d++)
        for (int64_t i = 0; i < p->n_all; i++) {
            tracked->acceleration[d][i] = (p->v[d][i] - tracked->v[d][i]) / (t_velocity - tracked->t_velocity);
            tracked->mean[d][i] = p->v[d][i] + (tracked->t - t_velocity) * tracked->acceleration[d][i];
        }
}

/* Computes the accelerations that the loads of the run o cause, force over mass of each particle, in tracked->body
 * [m/s^2]. In static problems this includes the inertia relief, the inertia forces by which a free body is in
 * equilibrium. Returns true if such forces act within the largest contour. */
static bool find_body_force(struct sif_tracked *tracked, const struct observed_run *o)
{
    const struct particles *p = o->part;
    const struct loads *l = o->loads;
    const real t = tracked->kept ? tracked->t : o->t;
    bool any = false;
    if (!l) return false;
    for (int d = 0; d < 2; d++) {
        room(&tracked->body[d], p->n_all);
        for (int64_t i = 0; i < p->n; i++) /* inertia relief of a static body: the mean acceleration is subtracted */
            tracked->body[d][i] = l->turn * (d == 0 ? p->X[1][i] - l->centre[1] : l->centre[0] - p->X[0][i]);
    }
    for (int b = 0; b < l->n; b++)
        for (int64_t k = 0; k < l->load[b].n && boundary_applies_force(l->load[b].boundary); k++) {
            const int32_t i = l->load[b].particle[k];
            real force[DIM_MAX];
            load_force_on_particle(&l->load[b], p, k, t, force);
            for (int d = 0; d < 2; d++) tracked->body[d][i] += force[d] / p->mass[i];
        }
    for (int64_t i = 0; i < p->n; i++) {
        const bool within =
            hypot(p->X[0][i] - tracked->tip.place[0], p->X[1][i] - tracked->tip.place[1]) < tracked->reach;
        any |= within && (tracked->body[0][i] != 0 || tracked->body[1][i] != 0);
    }
    return any;
}

void sif_probe_compute_intensity_factors(struct probe *probe, const struct observed_run *o, real velocity_time)
{
    struct sif_tracked *tracked = probe->sif;
    const struct particles *p = o->part;
    const bool moves = tracked->kept && velocity_time > tracked->t_velocity;
    struct sif found[SIF_CONTOURS_MAX + 1];
    real position[2];
    const bool grew = probes_sif_follow(probe, o);
    probe->memory.grew = grew;
    const bool loaded = find_body_force(tracked, o);
    if (!moves) keep_displacement(tracked, p), tracked->tip.speed = 0;
    if (moves) find_inertia(tracked, p, velocity_time);
    tracked->kept = false;
    for (int k = 0; k < SIF_FIGURES; k++) probe->memory.factors[k] = NAN;
    if ((tracked->tip.speed > 0 || grew) && ring_leaves(&tracked->tip, tracked->reach, o, position)) return;
    for (int d = 0; d < 2; d++) tracked->rule.tip[d] = tracked->tip.place[d];
    struct sif_motion m = {.displacement = {tracked->u[0], tracked->u[1]},
                           .stress = {tracked->stress[0], tracked->stress[1], tracked->stress[2]}};
    for (int d = 0; d < 2 && loaded; d++) m.body[d] = tracked->body[d];
    for (int d = 0; d < 2 && moves; d++) m.velocity[d] = tracked->mean[d], m.acceleration[d] = tracked->acceleration[d];
    sif_compute_by_interaction_integral(&tracked->tip, tracked->contour, tracked->contours, &m, &tracked->rule, p,
                                        o->cells, found);
    const real factors[SIF_FIGURES] = {found[0].K[MODE_I], found[0].K[MODE_II], found[0].J,
                                       sif_relative_spread_over_contours(found + 1, tracked->contours - 1)};
    memcpy(probe->memory.factors, factors, sizeof factors);
    memcpy(probe->memory.along, tracked->tip.along, sizeof probe->memory.along);
    probe->memory.time = o->t;
}

bool sif_probe_factors_are_meaningful(const struct probe *probe)
{
    const real *factors = probe->memory.factors;
    return !isnan(factors[0]) && !(factors[SIF_FIGURES - 1] > SPREAD_MOST);
}

/* Writes to text[size] the warning that probe (a requested measurement) has no stress-intensity factors at its last
 * sample, and why. t: time of the sample [s]. */
static void describe_meaningless_factors(const struct probe *probe, real t, char *text, size_t size)
{
    char why[200] = "its ring leaves the body";
    if (!isnan(probe->memory.factors[0]))
        snprintf(why, sizeof why,
                 "values on its contours differ by %.3g %% (contour_spread, at most %.3g %%), as happens if the crack "
                 "branches or kinks within them or K is near 0",
                 100 * probe->memory.factors[SIF_FIGURES - 1], 100 * SPREAD_MOST);
    snprintf(text, size,
             "probe %s: K_I, K_II and J have no value at t = %.4g s, nor whenever this recurs: %s; use a smaller "
             "probes.sif.outer (now %.3g m)",
             probe->request.name, t, why, probe->sif->contour[0].outer);
}

void probes_warn_of_meaningless_sif(struct probes *probes, bool single_equilibrium, real t,
                                    struct warnings *warning_list)
{
    for (int k = 0; k < probes->n; k++) {
        struct probe *probe = &probes->probe[k];
        char text[480];
        if (probe->request.kind != PROBE_SIF || probe->memory.said || sif_probe_factors_are_meaningful(probe)) continue;
        if (!probe->memory.grew && !single_equilibrium) continue;
        probe->memory.said = 1;
        describe_meaningless_factors(probe, t, text, sizeof text);
        warnings_add_and_print(warning_list, text);
    }
}

bool probes_locate_sif_contour(const struct probes *probes, int k, const struct observed_run *o, real tip_position[2],
                               real *outer_radius)
{
    const struct sif_tracked *tracked = probes->probe[k].sif;
    if (probes->probe[k].request.kind != PROBE_SIF || !tracked) return false;
    const struct crack_tip *tip =
        tracked->follows >= 0 && tracked->follows < o->tips->n ? &o->tips->tip[tracked->follows] : NULL;
    const real *at = tracked->growth >= 0     ? o->growth[tracked->growth].place
                     : tip && tip->growth > 0 ? tip->place
                                              : tracked->tip.place;
    for (int d = 0; d < 2; d++) tip_position[d] = at[d];
    *outer_radius = tracked->reach;
    return true;
}

bool probes_copy_sif_to_growth_control(const struct probes *probes, const char *probe_name,
                                       struct growth_control *control)
{
    for (int k = 0; k < probes->n; k++) {
        const struct probe *probe = &probes->probe[k];
        if (probe->request.kind != PROBE_SIF || strcmp(probe->request.name, probe_name) != 0 ||
            isnan(probe->memory.factors[0]))
            continue;
        *control = (struct growth_control){
            .factors = {{probe->memory.factors[0], probe->memory.factors[1]}, probe->memory.factors[2]},
            .along = {probe->memory.along[0], probe->memory.along[1]},
            .time = probe->memory.time,
            .medium = probe->sif->tip.medium};
        return true;
    }
    return false;
}
