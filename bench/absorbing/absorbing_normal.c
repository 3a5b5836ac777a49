/* Plane pulses at normal incidence on an absorbing face. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "absorbing_bench.h"
#include "base/memory.h"
#include "probes/diagnostics.h"
#include "step/report.h"
#include "mesh/mesh_part.h"

/* Length of the strip between two mirrors [spacings]; a pulse starts in its middle. The wave reflected by the absorbing
 * face is the difference from a strip of twice the length. */
enum { NORMAL_LENGTH = 384 };
#define NORMAL_VELOCITY 1e-3 /* peak velocity of the pulse */

/* Writes the scene of a strip with a pulse and an absorbing face into text[room] and returns the length of the text. m:
 * numerical method; dim: number of dimensions; width: of the pulse, length: of the strip [spacings]. The density is 1
 * and C11 = ABSORBING_SPEED^2; in plane strain and in 3D C11 = 6/5 E at Poisson's ratio 1/4, and G = C11/3. */
static int normal_scene(char *text, size_t room, const struct absorbing_method *m, int dim, int width, int length)
{
    static const char *const spaces[DIM_MAX + 1] = {"", "line\nsection: 1 m^2", "plane strain\nthickness: 1 m",
                                                    "solid"};
    static const char *const sides[DIM_MAX + 1] = {"", "", ", 8 mm", ", 8 mm, 8 mm"};
    static const char *const zeros[DIM_MAX + 1] = {"", "", ", 0", ", 0, 0"};
    static const char *const mirrors[DIM_MAX + 1] = {
        "", "", "  - {mirror: {axis: y, at: 0}}\n  - {mirror: {axis: y, at: 8 mm}}\n",
        "  - {mirror: {axis: y, at: 0}}\n  - {mirror: {axis: y, at: 8 mm}}\n"
        "  - {mirror: {axis: z, at: 0}}\n  - {mirror: {axis: z, at: 8 mm}}\n"};
    return snprintf(text, room,
                    "name: normal\nspace: %s\nduration: %.9g\n%s\nconversion: {criteria: none}\n"
                    "material: {young: %.9g, poisson: %s, density: 1}\nbody: {box: {from: [0%s], to: [%.9g%s]}}\n"
                    "particles: {spacing: %.9g}\n"
                    "initial:\n  - pulse: {at: [%.9g%s], direction: [1%s], width: %.9g, velocity: %.9g}\n"
                    "boundary:\n  - {absorbing: true, face: x+}\n%soutput: {frames: 0, samples: 200}\n",
                    spaces[dim], NORMAL_LENGTH * ABSORBING_SPACING / ABSORBING_SPEED, m->keys,
                    ABSORBING_SPEED * ABSORBING_SPEED / (dim > 1 ? 1.2 : 1), dim > 1 ? "1/4" : "0", zeros[dim],
                    length * ABSORBING_SPACING, sides[dim], ABSORBING_SPACING, 0.5 * NORMAL_LENGTH * ABSORBING_SPACING,
                    zeros[dim], zeros[dim], width * ABSORBING_SPACING, NORMAL_VELOCITY, mirrors[dim]);
}

/* Runs a strip of `length` spacings with a pulse of `width` spacings in `dim` dimensions and an absorbing face at its
 * end, with the method m. Stores in *v an allocated array of the final velocities along x, one per particle [m/s],
 * which the caller releases with memory_free. Raises figure->back to the largest energy that the face released in one
 * step over the initial energy, and figure->balance to the largest error of the energy balance [1]. Returns FAILED if a
 * step fails. */
static status normal_run(const struct absorbing_method *m, int dim, int width, int length, real **v,
                         struct absorbing_pulse *figure)
{
    struct run e;
    struct scene s;
    char text[2048];
    double before = 0;
    normal_scene(text, sizeof text, m, dim, width, length);
    TRY(bench_engine_make(&e, &s, "absorbing", text, NULL, 0));
    status ran = report_open_history_and_write_first_frame(&e);
    while (ran == OK && e.clock.step < e.clock.steps) {
        ran = run_adapt_mesh_and_advance_one_step(&e);
        figure->back = fmax(figure->back, before - e.loads.absorbing.energy);
        before = e.loads.absorbing.energy;
        figure->balance = fmax(figure->balance, fabs(e.diagnostics->now.balance_error));
    }
    figure->back /= e.diagnostics->energy_start;
    lagrangian_mesh_update_point_motion_and_stress(e.frame, &e.part, &e.loads);
    *v = BARE("bench.v", e.part.n, real);
    array_copy(*v, e.part.v[0], e.part.n, sizeof(real));
    bench_engine_free(&e, &s);
    return ran;
}

status absorbing_measure_pulse_reflection(const struct absorbing_method *m, int dim, int width,
                                          struct absorbing_pulse *result)
{
    struct absorbing_pulse twin = {0, 0, 0};
    const int64_t L = NORMAL_LENGTH, rows = dim == 1 ? 1 : dim == 2 ? 8 : 64;
    real *with = NULL, *without = NULL;
    *result = twin;
    status ran = normal_run(m, dim, width, 2 * NORMAL_LENGTH, &without, &twin);
    if (ran == OK) ran = normal_run(m, dim, width, NORMAL_LENGTH, &with, result);
    for (int64_t i = 0; i < L * rows && ran == OK; i++) /* row by row, x varies fastest */
        result->reflected = fmax(result->reflected, fabs(with[i] - without[i / L * 2 * L + i % L]) / NORMAL_VELOCITY);
    memory_free(with), memory_free(without);
    return ran;
}
