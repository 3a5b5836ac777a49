/* Problems 10 and 11 of the cost-accuracy table: first eigenmodes of free bodies that are a few spacings thick. A plate
 * of aspect ratio 10 in plane stress bends; a square bar of aspect ratio 4 bends and twists. Reference frequencies are
 * from the Ritz method with products of Legendre polynomials up to degree 16 along and 9 across the body, converged to
 * the digits given. The body starts with the velocities of the mode (a Ritz solution of lower degree); the second zero
 * of the motion is at three quarters of its period. */
#include <math.h>
#include <stdio.h>

#include "accuracy.h"
#include "probes/probes.h"
#include "step/step.h"

/* A term of an eigenmode: it adds `of` times a product of Legendre polynomials of degree[d] along each axis d, on [-1,
 * 1] over the body, to the component `axis` of the velocity. */
struct term {
    int axis, degree[DIM_MAX];
    double of;
};

static const struct term plate[] = {{0, {1, 1, 0}, 0.261615},  {0, {1, 3, 0}, 0.000908},  {0, {3, 1, 0}, -0.068864},
                                    {0, {3, 3, 0}, -0.000940}, {0, {5, 1, 0}, 0.010693},  {0, {7, 1, 0}, -0.000296},
                                    {1, {0, 2, 0}, -0.002257}, {1, {2, 0, 0}, -1.000000}, {1, {2, 2, 0}, 0.003191},
                                    {1, {4, 0, 0}, 0.117755},  {1, {4, 2, 0}, -0.001035}, {1, {6, 0, 0}, -0.010324},
                                    {1, {8, 0, 0}, 0.000190}};
static const struct term bent[] = {
    {0, {1, 1, 0}, -0.5874}, {0, {1, 1, 2}, 0.0047},  {0, {1, 3, 0}, -0.0108}, {0, {1, 3, 2}, -0.0013},
    {0, {3, 1, 0}, 0.1477},  {0, {3, 1, 2}, -0.0027}, {0, {3, 3, 0}, 0.0094},  {0, {5, 1, 0}, -0.0216},
    {0, {5, 3, 0}, -0.0020}, {1, {0, 0, 2}, -0.0098}, {1, {0, 2, 0}, 0.0096},  {1, {2, 0, 0}, 1.0000},
    {1, {2, 0, 2}, 0.0121},  {1, {2, 2, 0}, -0.0105}, {1, {2, 4, 0}, -0.0011}, {1, {4, 0, 0}, -0.1357},
    {1, {4, 0, 2}, -0.0041}, {1, {4, 2, 0}, 0.0038},  {1, {6, 0, 0}, 0.0103},  {2, {0, 1, 1}, 0.0292},
    {2, {2, 1, 1}, -0.0398}, {2, {4, 1, 1}, 0.0117},  {2, {6, 1, 1}, -0.0011}};
static const struct term twisted[] = {{0, {0, 1, 3}, 0.0325}, {0, {0, 3, 1}, -0.0314}, {0, {2, 1, 3}, -0.0327},
                                      {0, {2, 3, 1}, 0.0308}, {0, {4, 1, 3}, 0.0049},  {0, {4, 3, 1}, -0.0051},
                                      {1, {1, 0, 1}, 1.0000}, {1, {1, 2, 1}, 0.0055},  {1, {3, 0, 1}, -0.1843},
                                      {1, {5, 0, 1}, 0.0081}, {2, {1, 1, 0}, -1.0000}, {2, {1, 1, 2}, -0.0056},
                                      {2, {3, 1, 0}, 0.1843}, {2, {5, 1, 0}, -0.0081}};

/* Eigenmodes of a plate and of a bar. term[terms]: terms of the sum of products of Legendre polynomials; size: lengths
 * of the body along the axes; frequency: angular frequency for thickness, Young's modulus and density 1. */
static const struct mode {
    const struct term *term;
    int terms;
    double size[DIM_MAX], frequency;
} mode[] = {{plate, COUNT_OF(plate), {10, 1, 1}, 0.0623947}, /* nu = 1/3 */
            {bent, COUNT_OF(bent), {4, 1, 1}, 0.3399424},    /* nu = 1/4 */
            {twisted, COUNT_OF(twisted), {4, 1, 1}, 0.4561018}};

static const struct mode *mode_of(const struct accuracy_point *p)
{
    return &mode[p->problem->dim == 2 ? 0 : 1 + p->at];
}

static const double speed = 1e-7;

static double measured; /* frequency measured in the last run [1/s] */

static void accuracy_beam_make_scene(const struct accuracy_point *p, struct accuracy_scene *s)
{
    const struct mode *m = mode_of(p);
    snprintf(s->text, sizeof s->text,
             "%sduration: %.9g\nmaterial: {young: 1, poisson: %s, density: 1, critical_stretch: inf}\n"
             "body: {box: {from: [0, 0%s], to: [%g, 1%s]}}\nparticles: {spacing: 1/%d}\nconversion: {criteria: none}\n",
             p->problem->dim == 2 ? "space: plane stress\nthickness: 1\n" : "space: solid\n", 6 / m->frequency,
             p->problem->dim == 2 ? "1/3" : "1/4", p->problem->dim == 2 ? "" : ", 0", m->size[0],
             p->problem->dim == 2 ? "" : ", 1", p->resolution);
}

/* Returns the value at x of the Legendre polynomial P_n, n = degree. */
static double legendre(int degree, double x)
{
    double before = 1, now = x;
    if (degree == 0) return 1;
    for (int k = 2; k <= degree; k++) {
        const double next = ((2 * k - 1) * x * now - (k - 1) * before) / k;
        before = now, now = next;
    }
    return now;
}

/* Computes the velocity v[DIM_MAX] [m/s] of an eigenmode at X [m], as a sum of products of Legendre polynomials.
 * context: a struct mode. */
static void mode_at(const void *context, const real *X, real *v)
{
    const struct mode *m = context;
    for (int d = 0; d < DIM_MAX; d++) v[d] = 0;
    for (int k = 0; k < m->terms; k++) {
        double value = speed * m->term[k].of;
        for (int d = 0; d < DIM_MAX; d++)
            if (m->term[k].degree[d] > 0) value *= legendre(m->term[k].degree[d], 2 * X[d] / m->size[d] - 1);
        v[m->term[k].axis] += value;
    }
}

/* Returns the projection of the motion of all particles in the run on the eigenmode m: the sum of mass times v .
 * v_mode, where v_mode is the velocity of the mode at the particle [J]. */
static double part_in_mode(const struct mode *m, const struct run *run)
{
    const struct particles *p = observed_run_make_read_only_view(run).part;
    double sum = 0;
    for (int64_t i = 0; i < p->n; i++) {
        real X[DIM_MAX] = {0}, v[DIM_MAX];
        for (int d = 0; d < p->dim; d++) X[d] = p->X[d][i];
        mode_at(m, X, v);
        for (int d = 0; d < p->dim; d++) sum += p->mass[i] * v[d] * p->v[d][i];
    }
    return sum;
}

/* Starts the run of point p in an eigenmode and runs it in pieces of 1/300 of its duration until the projection of
 * the motion on the mode is zero for the second time, at three quarters of a period. This time is interpolated linearly
 * between pieces. Sets `measured` to the angular frequency of the mode, or to NAN if the second zero is not reached.
 * Returns FAILED if a step fails. */
static status accuracy_beam_run(const struct accuracy_point *p, struct run *run)
{
    const struct mode *m = mode_of(p);
    double before = 0, t_before = 0;
    int zeros = 0;
    measured = NAN;
    bench_engine_set_velocities(run, mode_at, m);
    for (int k = 1; k <= 300; k++) {
        TRY(bench_engine_run(run, run->clock.steps * k / 300, NULL));
        run_update_particle_motion_and_stress(run);
        const double now = part_in_mode(m, run), t = observed_run_make_read_only_view(run).t_velocity;
        zeros += k > 1 && now * before < 0;
        if (zeros == 2) {
            measured = 1.5 * M_PI / (t_before + (t - t_before) * before / (before - now));
            return OK;
        }
        before = now, t_before = t;
    }
    return OK;
}

static status accuracy_beam_measure(const struct accuracy_point *p, struct run *run, double *error, double *part)
{
    (void)run;
    part[0] = measured / mode_of(p)->frequency - 1;
    *error = fabs(part[0]);
    return OK;
}

const struct accuracy_problem accuracy_beam = {
    .name = "beam",
    .title = "first bending mode of a free plate, 10 to 1",
    .error = "frequency over that by Ritz",
    .part = {"frequency"},
    .draws_parts = true,
    .cases = {"bending"},
    .counts = "particles across the thickness",
    .families = ACCURACY_PD | ACCURACY_MPM,
    .dim = 2,
    .resolution = {5, 10, 20, 40},
    .quick_resolutions = 2,
    .horizon = {2.015, 4.015},
    .step = {0.4},
    .remark = {"Weights of bonds near faces (pd.surface: moments) bring what the volume method misses by 6 to 8 %."},
    .seconds = 120,
    .quick_seconds = 10,
    .scene = accuracy_beam_make_scene,
    .run = accuracy_beam_run,
    .measure = accuracy_beam_measure,
};

const struct accuracy_problem accuracy_rod = {
    .name = "rod",
    .title = "first modes of a free square bar, 4 to 1",
    .error = "frequency over that by Ritz",
    .part = {"frequency"},
    .draws_parts = true,
    .cases = {"bending", "torsion"},
    .counts = "particles across the thickness",
    .families = ACCURACY_PD | ACCURACY_MPM,
    .dim = 3,
    .resolution = {5, 10, 20},
    .quick_resolutions = 2,
    .horizon = {2.015},
    .step = {0.4},
    .remark = {"Uniform weights of bonds leave the lattice's anisotropy: 5 % in the frequency of bending."},
    .seconds = 200,
    .quick_seconds = 20,
    .scene = accuracy_beam_make_scene,
    .run = accuracy_beam_run,
    .measure = accuracy_beam_measure,
};
