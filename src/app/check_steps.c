/* Prints the lines of `cleave check` about load steps: how cracks grow, how well they are resolved, and the run
 * time. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "check_parts.h"
#include "fracture/fracture_part.h"
#include "fracture/tips.h"
#include "quasistatic/load_steps.h"

#define AT_ONCE 1e-3     /* share of the largest loads above which loads count as present before the first load step */
#define FALLS 1e-6       /* least relative decrease of a load that is not round-off */
#define LOADS_LOOKS 64   /* number of times at which loads are evaluated */
#define PEAK_LOOKS 240   /* number of times at which peaks between load steps are looked for */
#define PEAK_MISSED 0.01 /* least height of a peak above the load steps beside it, divided by the largest loads */
#define FEW 20.0         /* length of a crack, or of the material ahead, below which loads deviate [spacings] */
#define NOTHING_BREAKS 0.8 /* tip stretch divided by critical stretch without an increment; 0.9 at Griffith's load */
#define SLOWER 2.0         /* factor on the number of iterations of the first equilibrium for those with a long crack */
#define LEAST_SHARE 0.03   /* least run time divided by the largest: early separation, fewer equilibria */
#define SPACINGS 2.0       /* length of a crack increment [spacings] */
/* LED_EQUILIBRIA: estimated number of equilibria for one crack increment whose direction follows from stress-intensity
 * factors. PAIRS_AT_ONCE: number of pairs of particles whose bonds break in one equilibrium in 2D. */
enum { LED_EQUILIBRIA = 3, PAIRS_AT_ONCE = 2 };
enum { PIN_MOST = 2, GRIP_LEAST = 12 }; /* widths of supports on which bodies rotate, and of grips [spacings] */

/* ---- cracks ------------------------------------------------------------------------------------------------------ */

/* Returns the number of crack tips in `fracture` that belong to pre-cracks, which are in the scene from the start. */
static int tips_of_cracks(const struct fracture_state *fracture)
{
    int n = 0;
    for (int k = 0; k < fracture->tips.n; k++) n += fracture->tips.tip[k].from_crack;
    return n;
}

static bool is_sif_driven(const struct run *run)
{
    return tips_of_cracks(run->fracture) > 0 && sif_growth_reason_direction_is_undetermined(run, NULL) == NULL;
}

/* Returns the distance from a crack tip to the end of the body in a straight line [m]. side: 1 for the distance ahead
 * of the tip, -1 for the distance back along the crack. s: shapes of the bodies; bodies from particle lists are
 * ignored; part: particles, for the size of the bodies. */
static real way_within(const struct scene *s, const struct particles *part, const struct crack_tip *tip, int side)
{
    const real most = 2 * (particles_bounding_box_longest_edge(part) + s->spacing), step = 0.5 * s->spacing;
    real way = 0;
    for (bool within = true; within && way < most; way += within ? step : 0) {
        real X[DIM_MAX] = {0};
        for (int d = 0; d < s->dim; d++) X[d] = tip->origin[d] + side * (way + 0.5 * step) * tip->along[d];
        within = false;
        for (int b = 0; b < s->bodies && !within; b++)
            within = !s->body[b].file && region_contains(&s->body[b].shape, X, s->dim, 0);
    }
    return way;
}

/* Returns the length of that part of the pre-crack behind a crack tip that is inside bodies of scene s (the input file)
 * [m]; INFINITY if the pre-crack is bent, in 3D, or if none is found. */
static real crack_behind(const struct scene *s, const struct particles *part, const struct crack_tip *tip)
{
    for (int k = 0; k < s->cracks && s->dim == 2; k++)
        for (int end = 0; end < 2; end++) {
            const real *here = s->crack[k].corner[end], *there = s->crack[k].corner[1 - end];
            if (hypot(here[0] - tip->origin[0], here[1] - tip->origin[1]) > ON_SURFACE * s->spacing) continue;
            const real way = way_within(s, part, tip, -1);
            return s->crack[k].n == 2 && way > 0 ? real_min(way, hypot(here[0] - there[0], here[1] - there[1]))
                                                 : INFINITY;
        }
    return INFINITY;
}

void print_load_step_settings(const struct run *run)
{
    static const char *const by[] = {[CONTROL_LOAD] = "of equal length",
                                     [CONTROL_ENERGY] = "at most, by energy",
                                     [CONTROL_OPENING] = "by an opening"};
    const struct scene *s = run->scene;
    const int tips = tips_of_cracks(run->fracture);
    printf(
        "solver         static: %d load steps %s, pseudo-time from 0 to %.4g s, each in equilibrium to a residual of "
        "%.3g of the load\n",
        s->steps.number, by[s->steps.control], s->duration, s->solver_tolerance);
    if (!scene_bonds_can_break(s) || s->method == METHOD_MPM) return;
    if (run->bonds.soft.curve) {
        printf("cracks         grow where bonds soften; %s\n",
               s->steps.control != CONTROL_ENERGY
                   ? "the run ends at the first load step whose loads the body cannot carry"
               : s->steps.energy > 0 ? "in each load step they dissipate steps.energy"
               : s->dim == 1         ? "in each load step they dissipate a hundredth of the energy that parts the bar"
                                     : "in each load step they dissipate the energy of a quarter spacing "
                                       "of crack");
        return;
    }
    if (is_sif_driven(run))
        printf("cracks         %d crack %s%s extended in the direction of the largest hoop stress around %s, 2 "
               "spacings in each increment%s\n",
               tips, s->dim == 3 ? "front" : "tip", tips > 1 ? "s are" : " is", tips > 1 ? "them" : "it",
               s->dim == 3 ? ", straight through the body" : "");
    else
        printf(
            "cracks         grow where bonds exceed their critical stretch, about 2 spacings in each increment%s%s\n",
            tips == 0 ? "; the scene has no pre-crack that could be extended by the hoop stress"
                      : "; they are not extended by the hoop stress, because ",
            tips == 0 ? "" : sif_growth_reason_direction_is_undetermined(run, NULL));
}

/* ---- advice ------------------------------------------------------------------------------------------------------ */

/* Writes a remark to `out` that the loads have a peak between two load steps of the scene s. The remark states the time
 * t of the peak [s], and the smallest larger number of load steps with which a step ends at this time. */
static void print_missed_peak(const struct scene *s, real t, FILE *out)
{
    int number = s->steps.number + 1;
    for (; number < s->steps.number + PEAK_LOOKS; number++) {
        const real step = t / s->duration * number;
        if (fabs(step - round(step)) < 1e-6 * number) break;
    }
    fprintf(out,
            "accuracy       the loads peak at t = %.4g s, between two of the %d load steps, so no load step reaches "
            "the peak; set steps.number: %d, so that a load step ends at the peak\n",
            t, s->steps.number, number);
}

/* Writes a remark to `out` if loads of the run act before the first load step. Writes another one if loads decrease
 * although the control of the load steps requires growing loads. In load control, also writes one on a peak of the
 * loads between two load steps, the one that is farthest above the loads of the nearest steps. */
static void advise_growth(const struct run *run, FILE *out)
{
    const struct scene *s = run->scene;
    real most = 0, before = 0, falls = NAN, peak = NAN, missed = 0;
    for (int k = 0; k <= LOADS_LOOKS; k++) {
        const real t = s->duration * k / LOADS_LOOKS, now = statics_norm_of_prescribed_loads(run, t);
        if (isnan(falls) && now < before - FALLS * most) falls = t;
        most = real_max(most, now), before = now;
    }
    const real first = statics_norm_of_prescribed_loads(run, 0);
    if (most > 0 && first > AT_ONCE * most)
        fprintf(out,
                "accuracy       %.3g %% of the largest loads act before the first load step; let loads grow from 0, by "
                "time: {ramp: {until: %.4g s}} or a formula of t%s\n",
                100 * first / most, s->duration,
                dot(s->gravity, s->gravity, s->dim) > 0 ? " (in place of gravity, which is constant, a body_force)"
                                                        : "");
    if (!isnan(falls) && s->steps.control != CONTROL_LOAD)
        fprintf(out,
                "accuracy       loads fall before t = %.4g s, but steps.control: %s needs loads that always grow, to "
                "find the pseudo-time of each crack increment; use time: ramp, or steps.control: load\n",
                falls, s->steps.control == CONTROL_ENERGY ? "energy" : "opening");
    for (int k = 1; k < PEAK_LOOKS && s->steps.control == CONTROL_LOAD; k++) {
        const real t = s->duration * k / PEAK_LOOKS, step = s->duration / s->steps.number,
                   from = floor(t / step) * step;
        const real above = statics_norm_of_prescribed_loads(run, t) -
                           real_max(statics_norm_of_prescribed_loads(run, from),
                                    statics_norm_of_prescribed_loads(run, real_min(from + step, s->duration)));
        if (above > missed * (1 + 1e-9)) missed = above, peak = t;
        most = real_max(most, above);
    }
    if (missed > PEAK_MISSED * most) print_missed_peak(s, peak, out);
}

/* Writes a remark to `out` for each crack tip of the run with less than FEW spacings of crack behind it, or less than
 * FEW spacings of body ahead of it. */
static void advise_lengths(const struct run *run, FILE *out)
{
    const real h = run->scene->spacing;
    for (int k = 0; k < run->fracture->tips.n; k++) {
        const struct crack_tip *tip = &run->fracture->tips.tip[k];
        const real ahead = way_within(run->scene, &run->part, tip, 1) / h,
                   behind = crack_behind(run->scene, &run->part, tip) / h;
        const bool short_crack = behind<FEW, short_way = ahead> 0 && ahead < FEW;
        if (!tip->from_crack || (!short_crack && !short_way)) continue;
        fprintf(out,
                "accuracy       crack tip at (%.4g, %.4g) m: there are only %.0f spacings of %s, but the load at which "
                "the crack grows is 0.5 %% off with 40 spacings, 2 %% with 20, and more below; use a smaller "
                "particles.spacing\n",
                tip->origin[0], tip->origin[1], short_crack ? behind : ahead,
                short_crack ? "crack behind it" : "body ahead of it");
    }
}

/* Returns the extent along `axis` of the particles of `part` on which load l acts [number of particles side by side]; 0
 * if the load extends over the whole width of the body. scene: spacing. */
static int support_width(const struct scene *scene, const struct particles *part, const struct load *l, int axis)
{
    const real h = scene->spacing;
    real low = INFINITY, high = -INFINITY, from, to;
    particles_coordinate_range(part, part->n, axis, &from, &to);
    for (int64_t k = 0; k < l->n; k++) {
        const real X = part->X[axis][l->particle[k]];
        low = real_min(low, X), high = real_max(high, X);
    }
    return high - low > to - from - 0.5 * h ? 0 : (int)lround((high - low) / h) + 1;
}

/* Writes a remark to `out` for each support of the run that holds more than PIN_MOST particles side by side along an
 * axis, so that the body cannot turn as on a pin or roller, but at most GRIP_LEAST, too few for a grip. Supports on
 * whole faces and rotating ones are skipped. */
static void advise_supports(const struct run *run, FILE *out)
{
    for (int b = 0; b < run->loads.n; b++) {
        const struct load *l = &run->loads.load[b];
        const struct boundary *by = l->boundary;
        if (by->kind != BOUNDARY_VELOCITY || by->side != 0 || by->rotates || l->n == 0) continue;
        for (int across = 0; across < run->part.dim; across++) {
            const int columns = support_width(run->scene, &run->part, l, across);
            const bool turns_it = by->components & ~(1 << across); /* another component is held */
            if (!turns_it || columns <= PIN_MOST || columns > GRIP_LEAST) continue;
            fprintf(out,
                    "accuracy       boundary %s holds particles over %d spacings along %c, so the body cannot rotate "
                    "there; make a pin or roller one or two particles wide, and a grip wider than %d particles\n",
                    by->name, columns, "xyz"[across], GRIP_LEAST);
        }
    }
}

void print_load_step_accuracy_advice(const struct run *run, FILE *out)
{
    if (!scene_has_load_steps(run->scene)) return;
    advise_growth(run, out);
    advise_supports(run, out);
    if (scene_bonds_can_break(run->scene) && !run->bonds.soft.curve) advise_lengths(run, out);
}

/* ---- cost -------------------------------------------------------------------------------------------------------- */

/* Returns an estimate of the number of equilibria that one crack increment of the run requires. It is LED_EQUILIBRIA if
 * the direction of cracks follows from stress-intensity factors. Otherwise it follows from the number of bonds in an
 * increment and the number of pairs of bonds that break per equilibrium: PAIRS_AT_ONCE in 2D, the number that the scene
 * allows in 3D. */
static double equilibria_of_advance(const struct run *run)
{
    const struct scene *s = run->scene;
    const struct family *f = &run->source.family;
    const double neighbours = f->full / f->cell_volume, reach = 0.4 * f->horizon / s->spacing;
    double wide = 1, at_once = PAIRS_AT_ONCE;
    if (is_sif_driven(run)) return LED_EQUILIBRIA;
    for (int d = 0; d < s->dim && s->dim == 3; d++) {
        real low, high;
        particles_coordinate_range(&run->part, run->part.n, d, &low, &high);
        wide = d == 0 ? (high - low) / s->spacing + 1 : fmin(wide, (high - low) / s->spacing + 1);
        at_once = s->steps.breaks;
    }
    return 1 + SPACINGS * 0.5 * neighbours * reach * wide / at_once;
}

/* Returns an estimate of the number of crack increments in the run: the number of load steps if the steps are
 * controlled by the released energy, else the distance that all crack tips can grow, divided by the length of an
 * increment. Returns 0 if no bond can break. */
static double advances_of(const struct run *run)
{
    const struct scene *s = run->scene;
    double way = 0;
    if (!scene_bonds_can_break(s)) return 0;
    if (s->steps.control == CONTROL_ENERGY) return s->steps.number;
    for (int k = 0; k < run->fracture->tips.n; k++)
        way += way_within(run->scene, &run->part, &run->fracture->tips.tip[k], 1);
    if (way == 0) way = particles_bounding_box_longest_edge(&run->part);
    return way / (SPACINGS * s->spacing);
}

status load_steps_estimate_run_cost(struct cost *c, struct run *run)
{
    const double began = thread_cpu_clock_seconds();
    const real first = run->scene->duration / run->scene->steps.number;
    TRY(run_find_equilibrium_for_cost_estimate(run, first));
    c->step = thread_cpu_clock_seconds() - began;
    c->equilibria = run->scene->steps.number + advances_of(run) * equilibria_of_advance(run);
    if (run_predict_largest_ratio_to_critical_stretch(run, first, &c->overload_at, &c->overload) != OK) c->overload = 0;
    c->most = c->make + SLOWER * c->step * c->equilibria + c->output;
    c->run = c->make + LEAST_SHARE * (c->most - c->make), c->least = c->run, c->basis = COST_FIRST;
    return OK;
}

void print_load_steps_cost(const struct run *run, const struct cost *c, int threads)
{
    printf("run time       %.2g to %.2g s on %d idle core%s: up to %.2g equilibria of %.2g s", c->least, c->most,
           threads, threads > 1 ? "s" : "", c->equilibria, c->step);
    const bool known = c->overload > 0 && run->scene->rigids == 0; /* the forces of rigid bodies are not predicted */
    if (known && c->overload < NOTHING_BREAKS && run->scene->steps.control == CONTROL_LOAD)
        printf("\naccuracy       the most stretched bond reaches only %.2g of its limit, at a pseudo-time of %.4g s, "
               "and nothing breaks below %.1f; use larger loads",
               c->overload, c->overload_at, NOTHING_BREAKS);
}
