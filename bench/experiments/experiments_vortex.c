/* The vortex at several spacings: order of the displacement error for rotations up to a radian.
 *
 * At 1 rad the shear reaches 0.84 and bonds are compressed to 0.67 of their length. The error of bonds then stops
 * decreasing at a spacing of 12.5 mm for any time step: an error that depends on neither. At 0.5 rad it decreases with
 * order 2. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "experiments.h"
#include "vortex.h"
#include "step/step.h"
#include "step/report.h"
#include "step/stability.h"
#include "step/checks.h"

#define VORTEX_PERIOD 0.06 /* twice the time in which waves travel the radius [s] */
#define VORTEX_HALF 1.2    /* half edge of the body: nothing moves beyond R = 1 [m] */
#define VORTEX_REACH 3.015
#define KAMOJJALA "order 2; Kamojjala et al. 2015"

struct vortex_case {
    const char *name, *lines;
    enum vortex_law law;
    double turn; /* rotation of the centre at the end [rad] */
};
#define VORTEX_BONDED "method: pd\npd: {weights: uniform, surface: none}\ncontact: {between: none}\n"
static const struct vortex_case vortex_cases[VORTEX_METHODS] = {
    [VORTEX_MESH] = {"mesh, 1 rad", "method: mpm\nmpm: {frame: reference, levels: 0}\n", VORTEX_BIOT, 1},
    [VORTEX_PD] = {"pd, 0.5 rad", VORTEX_BONDED, VORTEX_BONDS, 0.5},
    [VORTEX_PD_FAR] = {"pd, 1 rad", VORTEX_BONDED, VORTEX_BONDS, 1},
};
static const double vortex_spacings[] = {0.1, 0.05, 0.025, 0.0125}; /* [m] */
enum { VORTEX_SPACINGS = COUNT_OF(vortex_spacings) };

/* Replaces the uniform body force of the scene by the body force of the vortex v at the current time of the run. Sets
 * the forces `share` of its first load, one per particle [N], which the load multiplies by its time function. */
static void vortex_load(struct run *run, const struct vortex *v)
{
    struct load *load = &run->loads.load[0];
    const struct particles *p = &run->part;
    if (load->share[1] == load->share[0]) load->share[1] = NEW("bench.vortex", load->n, real);
#pragma omp parallel for
    for (int64_t k = 0; k < load->n; k++) {
        const int32_t i = load->particle[k];
        const double X[2] = {p->X[0][i], p->X[1][i]};
        double b[2] = {0};
        if (X[0] * X[0] + X[1] * X[1] < 1.02) vortex_compute_body_force(v, X, run->clock.t, b);
        for (int d = 0; d < 2; d++) load->share[d][k] = b[d] * p->volume0[i];
    }
}

/* Returns the root-mean-square error of the displacements in the run over the root mean square of the displacements
 * of the vortex v [1]. */
static double vortex_error(struct run *run, const struct vortex *v)
{
    const struct particles *p = &run->part;
    double wrong = 0, size = 0;
    run_update_particle_motion_and_stress(run);
    for (int64_t i = 0; i < p->n; i++) {
        const double X[2] = {p->X[0][i], p->X[1][i]};
        double x[2];
        vortex_compute_present_position(v, X, run->clock.t, x);
        for (int d = 0; d < 2; d++) wrong += square(p->x[d][i] - x[d]), size += square(x[d] - X[d]);
    }
    return sqrt(wrong / size);
}

static status vortex_go(struct run *run, const struct vortex *v)
{
    TRY(report_open_history_and_write_first_frame(run));
    while (run->clock.step < run->clock.steps) {
        vortex_load(run, v);
        TRY(run_adapt_mesh_and_advance_one_step(run));
        TRY(run_check_stability_after_step(run));
    }
    return OK;
}

status vortex_run_and_measure_error(enum vortex_method method, double spacing, double *error)
{
    const struct vortex_case *c = &vortex_cases[method];
    char text[1024];
    struct run e;
    struct scene scene;
    snprintf(text, sizeof text,
             "name: vortex\nspace: plane stress\nthickness: 1 m\nduration: %g\n%s"
             "material: {young: 1 MPa, density: 1000, critical_stretch: inf}\nparticles: {spacing: %g}\n"
             "body: {box: {from: [%g, %g], to: [%g, %g]}}\nboundary: [{body_force: [1, 1]}]\n"
             "time: {active_set: false, safety: 0.5}\noutput: {frames: 0, samples: 1}\n",
             VORTEX_PERIOD, c->lines, spacing, -VORTEX_HALF, -VORTEX_HALF, VORTEX_HALF, VORTEX_HALF);
    TRY(bench_engine_make(&e, &scene, "vortex", text, NULL, 0));
    const struct material *m = &scene.material[0];
    struct vortex v = {.law = c->law,
                       .turn = c->turn,
                       .period = VORTEX_PERIOD,
                       .density = m->density,
                       .c11 = m->c12 + 2 * m->shear,
                       .c12 = m->c12,
                       .shear = m->shear};
    vortex_fill_bonds_of_lattice(&v, VORTEX_REACH);
    const status ran = vortex_go(&e, &v);
    if (ran == OK) *error = vortex_error(&e, &v);
    bench_engine_free(&e, &scene);
    return ran;
}

static void vortex_add(struct experiments *x, const char *variant, const char *figure, const char *unit, double value,
                       double low, double high)
{
    struct experiment_row row = {.experiment = "vortex",
                                 .unit = unit,
                                 .verdict = "",
                                 .source = KAMOJJALA,
                                 .value = value,
                                 .deviation = NAN,
                                 .interval = NAN,
                                 .low = low,
                                 .high = high,
                                 .runs = 1};
    snprintf(row.variant, sizeof row.variant, "%s", variant);
    snprintf(row.figure, sizeof row.figure, "%s", figure);
    experiment_add_and_print_result(x, row);
}

status experiments_run_vortex(struct experiments *x)
{
    for (enum vortex_method k = 0; k < VORTEX_METHODS; k++) {
        const struct vortex_case *c = &vortex_cases[k];
        struct experiment_curve *curve = experiment_add_empty_curve(x, "vortex", "%s", c->name);
        double error[VORTEX_SPACINGS];
        const int n = x->quick ? VORTEX_SPACINGS - 1 : VORTEX_SPACINGS;
        for (int h = 0; h < n; h++) {
            char figure[48];
            TRY(vortex_run_and_measure_error(k, vortex_spacings[h], &error[h]));
            snprintf(figure, sizeof figure, "error at %g mm", 1e3 * vortex_spacings[h]);
            vortex_add(x, c->name, figure, "%", 100 * error[h], NAN, NAN);
            experiment_curve_append_point(curve, vortex_spacings[h], error[h], NAN);
        }
        vortex_add(x, c->name, "order of displacements", "", log2(error[n - 2] / error[n - 1]), 1.8, 2.3);
    }
    return OK;
}
