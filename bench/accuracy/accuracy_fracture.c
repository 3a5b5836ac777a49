/* Problem 8 of the cost-accuracy table: plates of inputs/kalthoff_winkler.yaml and inputs/plate_crack.yaml. Compares
 * path, start time and speed of their cracks with peridynamics at a quarter of the scenes' spacing
 * (accuracy_reference.h). */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "accuracy.h"
#include "accuracy_reference.h"
#include "fracture/tips.h"
#include "fracture/fracture_part.h"

/* Cases of the problem: Kalthoff's plate, and a plate under tension. */
enum { KALTHOFF, PULLED };

/* Crack growth that is observed on the two plates [m]. start: growth at which a crack counts as started; until: growth
 * up to which its speed is measured; ring, width: radii and half-width of the rings around the end of the pre-crack in
 * which the angle of its path is measured. */
static const struct {
    double start, until, ring[FRACTURE_RINGS], width;
} watched[2] = {[KALTHOFF] = {5e-3, 20e-3, {7.5e-3, 12.5e-3, 17.5e-3, 22.5e-3}, 2.5e-3},
                [PULLED] = {1e-3, 3e-3, {1.5e-3, 2e-3, 2.5e-3, 3e-3}, 0.5e-3}};
/* Number of samples of a run. */
enum { SAMPLES = 200 };

/* ---- scenes ------------------------------------------------------------------------------------------------------ */

/* Writes the scene of point p, with `resolution` particles across the width of a plate: Kalthoff's impact test, 100 mm
 * wide, or a plate under tension, 50 mm wide. The velocity of the load is prescribed in three layers of particles, or
 * in a layer as thick as that of the scene files in inputs/ if this is thicker. Edges, notches and ends of cracks are
 * midway between particles. */
static void accuracy_fracture_make_scene(const struct accuracy_point *p, struct accuracy_scene *s)
{
    const double h = (p->at == KALTHOFF ? 100.0 : 50.0) / p->resolution;
    if (p->at == KALTHOFF) {
        const double layer = fmax(3, 3 * h);
        snprintf(
            s->text, sizeof s->text,
            "space: plane stress\nthickness: 10 mm\nduration: 50 us\n"
            "material: {young: 190 GPa, poisson: 1/3, density: 7800 kg/m^3, energy_release_rate: 69 kJ/m^2}\n"
            "body: [{box: {from: [0, -100 mm], to: [100 mm, 100 mm]}}, {add: {box: {from: [-%g mm, -25 mm], to: [0, "
            "25 mm]}}}]\nparticles: {spacing: 1 mm}\n"
            "cracks: [{from: [-%g mm, -25 mm], to: [50 mm, -25 mm]}, {from: [-%g mm, 25 mm], to: [50 mm, 25 mm]}]\n"
            "boundary: [{velocity: [22 m/s, free], region: {box: {from: [-%g mm, -25 mm], to: [0, 25 mm]}}}]\n",
            layer, layer + 1, layer + 1, layer);
    } else {
        const double edge = 25 + fmax(1.5, 3 * h);
        snprintf(s->text, sizeof s->text,
                 "space: plane stress\nthickness: 0.1 mm\nduration: 15 us\n"
                 "material: {young: 192 GPa, poisson: 1/3, density: 8000 kg/m^3, energy_release_rate: 82907 J/m^2}\n"
                 "body: {box: {from: [-25 mm, -%g mm], to: [25 mm, %g mm]}}\nparticles: {spacing: 0.5 mm}\n"
                 "cracks: [{from: [-5 mm, 0], to: [5 mm, 0]}]\nboundary:\n"
                 "  - {velocity: [free, 18 m/s], region: {box: {from: [-25 mm, 25 mm], to: [25 mm, 100 mm]}}, time: "
                 "{step: {until: "
                 "4.5 us}}}\n"
                 "  - {velocity: [free, -18 m/s], region: {box: {from: [-25 mm, -100 mm], to: [25 mm, -25 mm]}}, time: "
                 "{step: "
                 "{until: 4.5 us}}}\n",
                 edge, edge);
    }
    bench_overrides_append(&s->set, "particles.spacing", "%d/%d mm", p->at == KALTHOFF ? 100 : 50, p->resolution);
    if (p->at == KALTHOFF) bench_overrides_append(&s->set, "pd.influence", "one");
    if (p->method->family & ACCURACY_STATES) bench_overrides_append(&s->set, "pd.normalisation", "bulk");
    if (p->at == KALTHOFF && accuracy_point_can_use_relaxation(p))
        bench_overrides_append(&s->set, "mpm.transfer", "apic");
}

/* ---- observed cracks --------------------------------------------------------------------------------------------- */

/* Returns the time at which the mean growth of all pre-cracks reaches `length` [m], interpolated linearly between
 * samples at which the growth increased [s]; NAN if it never does. t: crack tips of a run with their history. */
static double time_of(const struct crack_tips *t, double length)
{
    double time[2] = {NAN, NAN}, growth[2] = {0, 0};
    for (int64_t s = 0; s < t->samples; s++) {
        double mean = 0;
        int n = 0;
        for (int k = 0; k < t->n; k++)
            if (t->tip[k].from_crack) mean += t->growth[s * TIPS_MAX + k], n++;
        mean /= n;
        if (mean <= growth[1] + 1e-9) continue;
        time[0] = time[1], growth[0] = growth[1], time[1] = t->time[s], growth[1] = mean;
        if (mean < length || s == 0) continue;
        if (isnan(time[0])) return time[1]; /* reached within one step */
        return time[0] + (time[1] - time[0]) * (length - growth[0]) / (growth[1] - growth[0]);
    }
    return NAN;
}

/* Returns the angle of the crack path in a ring around the end of each pre-crack, positive away from the middle plane
 * of the plate [rad]. It is the direction to the damaged particles of all cracks whose distance from the end of the
 * pre-crack is within radius +- width [m], weighted by their damage. Returns NAN if there are none. */
static double angle_at(const struct run *run, double radius, double width)
{
    const struct crack_tips *t = &run->fracture->tips;
    double along = 0, across = 0;
    for (int64_t i = 0; i < run->part.n; i++) {
        const int k = t->label[i] - 1;
        if (k < 0 || k >= t->n || !t->tip[k].from_crack) continue;
        const struct crack_tip *tip = &t->tip[k];
        const double offset[2] = {run->part.X[0][i] - tip->origin[0], run->part.X[1][i] - tip->origin[1]};
        if (fabs(hypot(offset[0], offset[1]) - radius) > width) continue;
        along += run->part.damage[i] * (offset[0] * tip->along[0] + offset[1] * tip->along[1]);
        across += run->part.damage[i] * (offset[1] * tip->along[0] - offset[0] * tip->along[1]) *
                  (tip->origin[1] < 0 ? -1 : 1);
    }
    return along != 0 || across != 0 ? atan2(across, along) : NAN;
}

struct fracture accuracy_fracture_of(const struct accuracy_point *p, const struct run *run)
{
    const struct crack_tips *t = &run->fracture->tips;
    struct fracture f = {.start = time_of(t, watched[p->at].start), .speed = NAN};
    int n = 0;
    for (int k = 0; k < t->n; k++)
        if (t->tip[k].from_crack) f.length += t->tip[k].growth, n++;
    f.length /= n;
    const double until = fmin(watched[p->at].until, f.length * (1 - 1e-9));
    if (until > watched[p->at].start) f.speed = (until - watched[p->at].start) / (time_of(t, until) - f.start);
    for (int r = 0; r < FRACTURE_RINGS; r++) f.angle[r] = angle_at(run, watched[p->at].ring[r], watched[p->at].width);
    return f;
}

/* ---- errors ------------------------------------------------------------------------------------------------------ */

/* Returns the relative error of a value whose exact value is `wanted`; -1 (100 %) if `value` is NAN, because the crack
 * did not reach the required length. */
static double accuracy_fracture_off(double value, double wanted) { return isfinite(value) ? value / wanted - 1 : -1; }

/* Computes the relative errors of the cracks in the run of point p: part[0] of path angles and length, part[1] of the
 * start time, part[2] of the speed. The reference is bond-based peridynamics at a quarter of the scenes' spacing.
 * *error is the root mean square of the three parts. */
static status accuracy_fracture_measure(const struct accuracy_point *p, struct run *run, double *error, double *part)
{
    const struct fracture f = accuracy_fracture_of(p, run), *wanted = &fracture_reference[p->at][FRACTURE_QUARTER];
    double beside2 = 0;
    for (int r = 0; r < FRACTURE_RINGS; r++)
        beside2 += (isfinite(f.angle[r]) ? pow(f.angle[r] - wanted->angle[r], 2) : 1) / FRACTURE_RINGS;
    part[0] = sqrt(beside2 + pow(accuracy_fracture_off(f.length, wanted->length), 2));
    part[1] = accuracy_fracture_off(f.start, wanted->start);
    part[2] = accuracy_fracture_off(f.speed, wanted->speed);
    *error = sqrt((part[0] * part[0] + part[1] * part[1] + part[2] * part[2]) / 3);
    return OK;
}

/* Returns true if point p is run. With up to 100 particles across the plate all methods are run. With more, only the
 * bond-based and adaptive methods of --quick are, since others do not converge to the reference or take too long; with
 * more than 200, adaptive methods must be in the reference frame. */
static bool accuracy_fracture_applies(const struct accuracy_point *p)
{
    if (p->resolution <= 100) return true;
    if (p->resolution > 200 && p->method->family & ACCURACY_ADAPTIVE && !accuracy_point_uses_reference_frame(p))
        return false;
    return p->method->quick && (p->method->family & (ACCURACY_BONDS | ACCURACY_ADAPTIVE));
}

const struct accuracy_problem accuracy_fracture = {
    .name = "fracture",
    .title = "plates that crack",
    .error = "path (offset over distance, and length), start and speed beside bonds at 1/4 of the scene's spacing, "
             "root mean "
             "square of the three",
    .part = {"path", "start", "speed"},
    .cases = {"Kalthoff", "pulled plate"},
    .counts = "particles across the plate",
    .families = ACCURACY_PD | ACCURACY_ADAPTIVE,
    .levels = true,
    .dim = 2,
    .resolution = {40, 60, 100, 200, 300},
    .quick_resolutions = 3,
    .step = {0.4, 0.2},
    .steps = true,
    .varied = 3,
    .samples = SAMPLES,
    .remark =
        {"The reference is known to 2.5 and 2.7 %: by so much it differs from one at 1/8 of the spacing. Its own "
         "start, speed, length and path at 1, 1/2, 1/4, 1/8 are in bench/accuracy/accuracy_reference.h.",
         "What counts most is the step: at 0.8 of the critical one cracks are 11 to 23 % off with 100, 200 and 300 "
         "particles, at 0.4 bonds come to 10.3, 7.3, 3.6 % (Kalthoff) and 10.1, 8.8, 2.9 %.",
         "Adaptive runs in the reference frame are on the front of Kalthoff's plate: 7.6 % in 0.08 s where bonds have "
         "9.0 % after "
         "0.26 s, 4.0 % in 0.6 s where bonds have 3.6 % after 3.1 s; in the pulled plate 2.7 % in 0.03 s. In the "
         "current "
         "frame they take three to five times the time of bonds. Bonds with 60 particles in the pulled plate (2.8 %) "
         "are "
         "luck: 56, 58, 62, 64, 70 give 10, 13, 7, 12, 11 %. Coarse cells (levels 2) with 300 particles come to 0.9 "
         "% in 0.49 s, cells of two spacings to 1.3 % in 0.42 s: samples and conversion are most of both.",
         "Couplings pm, pg, pmg and pgg do not crack: the grid moves both faces with one velocity field.",
         "mospd cracks at half the speed of bonds in Kalthoff's plate (570 m/s, 14 mm): its critical stretch is "
         "another law, of no error of the method's."},
    .seconds = 300,
    .quick_seconds = 60,
    .scene = accuracy_fracture_make_scene,
    .measure = accuracy_fracture_measure,
    .applies = accuracy_fracture_applies,
};

/* ---- the reference ----------------------------------------------------------------------------------------------- */

/* Runs point p and prints its start time, speed, length and angles as an entry of the table in accuracy_reference.h.
 * Returns FAILED if the run fails. */
static status print_reference(const struct accuracy_point *p)
{
    struct accuracy_scene from;
    struct run e;
    struct scene s;
    accuracy_compose_scene_of_point(p, &from);
    TRY(bench_engine_make(&e, &s, p->problem->name, from.text, bench_overrides_as_array(&from.set), from.set.n));
    const status ran = run_advance_to_end_time(&e);
    const struct fracture f = accuracy_fracture_of(p, &e);
    printf("    {%.7g, %.5g, %.5g, {", f.start, f.speed, f.length);
    for (int r = 0; r < FRACTURE_RINGS; r++) printf("%.5g%s", f.angle[r], r < FRACTURE_RINGS - 1 ? ", " : "}},");
    printf("    /* %s, %d */\n", p->problem->cases[p->at], p->resolution);
    fflush(stdout);
    bench_engine_free(&e, &s);
    return ran;
}

status accuracy_compute_reference_cracks(bool quick)
{
    threads_set_count_and_bind_to_cores(0);
    for (int resolution = 100; resolution <= (quick ? 200 : 800); resolution *= 2)
        for (int at = 0; at < accuracy_case_count(&accuracy_fracture); at++)
            TRY(print_reference(&(struct accuracy_point){&accuracy_fracture, &accuracy_method[0], at, resolution,
                                                         ACCURACY_HORIZON, 0.4}));
    return OK;
}
