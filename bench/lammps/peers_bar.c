/* `cleave bench peers=bar`: times a copper Taylor bar of material points in the current frame beside MPM3D-F90, whose
 * time is a record of measurements on another machine. */
#include <math.h>
#include <stdio.h>

#include "bench/common/bench.h"
#include "base/team.h"

/* ROUNDS: repetitions of a run; BARS: number of bars, one that yields and an elastic one. */
enum { ROUNDS = 3, BARS = 2 };

/* Times of MPM3D-F90 [ns per point and step]: fastest and slowest run of this bar with linear shape functions, MUSL,
 * von Mises, on one core of a machine with two cores and AVX-512, gfortran 12, alternating with Cleave on that
 * machine. */
#define MPM3D_FASTEST 253.0
#define MPM3D_SLOWEST 296.0
#define MPM3D_DATE "November 2026"

/* Name, size and time of one bar. */
struct bar_result {
    const char *name;
    double particles, steps, seconds; /* processor time of the fastest run [s] */
};

/* Runs a cylinder of copper that hits a plane of symmetry for 80 us and lowers r->seconds to its processor time [s] if
 * that is shorter than in earlier runs, since other programs disturb the shortest time least. yields: true for 190 m/s
 * and von Mises plasticity with linear hardening; false for an elastic bar and 19 m/s, since 190 m/s would stretch it
 * by 8 %, beyond what the current frame allows. quick: coarse particles and 8 us. Returns FAILED or REFUSED if the run
 * does. */
static status bar_run(struct bar_result *r, bool yields, bool quick)
{
    struct scene s;
    struct run e;
    char text[1024];
    snprintf(text, sizeof text,
             "name: bar\nspace: solid\nduration: %s\nmethod: mpm\n"
             "material: {young: 117 GPa, poisson: 0.35, density: 8930%s}\n"
             "particles: {spacing: %s}\n"
             "body: {cylinder: {from: [0, 0, 0], to: [0, 0, 25.4 mm], radius: 3.8 mm}}\n"
             "boundary: [{mirror: {axis: z, at: 0}}]\ninitial: [{velocity: [0, 0, %d]}]\n"
             "mpm: {shape: linear, transfer: flip}\noutput: {frames: 0}\n",
             quick ? "8 us" : "80 us", yields ? ", yield_stress: 157 MPa, yield_hardening: 425 MPa" : "",
             quick ? "0.76 mm" : "0.38 mm", yields ? -190 : -19);
    TRY(bench_engine_make(&e, &s, "bar", text, NULL, 0));
    const double start = thread_cpu_clock_seconds();
    const status ran = run_advance_to_end_time(&e);
    r->seconds = fmin(r->seconds, thread_cpu_clock_seconds() - start);
    r->particles = (double)e.part.n, r->steps = (double)e.clock.steps;
    bench_engine_free(&e, &s);
    return ran;
}

status bench_taylor_bar(bool quick)
{
    struct bar_result bar[BARS] = {{"yields", 0, 0, INFINITY}, {"elastic", 0, 0, INFINITY}};
    struct bench_table t;
    printf("peers=bar\n");
    bench_print_machine(threads_set_count_and_bind_to_cores(1));
    for (int r = 0; r < (quick ? 1 : ROUNDS); r++)
        for (int k = 0; k < BARS; k++) TRY(bar_run(&bar[k], k == 0, quick));
    bench_table_make(&t, "", "bar,particles,steps,ns_per_particle_step");
    printf("  copper Taylor bar, points of the current frame, linear shapes, one core, processor time\n"
           "  %-10s %9s %6s %17s\n",
           "", "particles", "steps", "ns/particle/step");
    for (int k = 0; k < BARS; k++) {
        const double each = 1e9 * bar[k].seconds / bar[k].particles / bar[k].steps;
        printf("  %-10s %9.0f %6.0f %17.1f\n", bar[k].name, bar[k].particles, bar[k].steps, each);
        bench_table_append_text(&t, bar[k].name);
        bench_table_append_number(&t, bar[k].particles), bench_table_append_number(&t, bar[k].steps),
            bench_table_append_number(&t, each);
    }
    printf(
        "  MPM3D-F90, the bar that yields: %.0f to %.0f, not measured here but on two cores with AVX-512 in " MPM3D_DATE
        "\n\n",
        MPM3D_FASTEST, MPM3D_SLOWEST);
    const status s = bench_write_result_tables("peers_bar", &t, 1);
    bench_table_free(&t);
    threads_set_count_and_bind_to_cores(0);
    return s;
}
