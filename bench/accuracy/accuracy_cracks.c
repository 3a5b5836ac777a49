/* Problem 5 of the cost-accuracy table: static stress-intensity factors of an edge crack and of an inclined crack. As
 * inputs/edge_crack_k1.yaml and inputs/inclined_crack.yaml. Solvers as for the hole (accuracy_hole.c). Methods with
 * only material points represent cracks as gaps, here of one cell, and an inclined gap does not follow the lattice.
 * They do not apply in the current frame: beside a gap of two cells relaxation (gimp, apic) had not converged after
 * 200,000 steps, and cubic splines interact across the gap (K_I 64 % too low).
 *
 * In the reference frame the load grows over 200 transit times: the slowest motion of the halves beside the edge crack
 * has a period of about 13 transit times, and under a load that grows as sin^2 the response lags by a fraction
 * (period/duration)^2/8 (2.5 % were measured for 30 transit times). */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "accuracy.h"

/* Cases of the problem: an edge crack, and an inclined crack. */
enum { EDGE, INCLINED };

/* Exact K_I and K_II over sigma (pi a)^(1/2), and the crack lengths a [m]. Edge crack: a/W = 0.5, H = W, by boundary
 * collocation: 3.0070, 3.0084, 3.0087 with 60, 90, 130 terms, 3.009 in handbooks. Inclined crack: 45 degrees, as in
 * inputs/inclined_crack.yaml. */
static const double exact[2][2] = {{3.009, 0}, {0.6612, 0.5674}}, length[2] = {5e-3, 3e-3};
static const double pull = 1e6;

static const char text[] =
    "space: plane stress\nthickness: 1 mm\nmaterial: {young: 200 GPa, poisson: 1/3, density: 7850 kg/m^3}\n"
    "particles: {spacing: 0.1 mm}\nconversion: {criteria: none}\n";

static void put_edge(FILE *to, const struct accuracy_point *p, double h, const char *time)
{
    if (p->method->family & ACCURACY_MPM) {
        fprintf(to,
                "body: [{box: {from: [0, 0], to: [10 mm, 10 mm]}}, {subtract: {box: {from: [-1 mm, %.9g mm], to: "
                "[5 mm, %.9g mm]}}}]\nmpm: {origin: [0, %.9g mm]}\n",
                5 - h, 5 + h, 5 - h);
        fputs("probes: [sif: {at: [5 mm, 5 mm], direction: [1, 0], contours: [2 mm]}]\n", to);
    } else
        fputs("body: {box: {from: [0, 0], to: [10 mm, 10 mm]}}\ncracks: [{from: [-1 mm, 5 mm], to: [5 mm, 5 mm]}]\n"
              "pd: {region: {box: {from: [0, 4 mm], to: [6 mm, 6 mm]}}}\nprobes: [sif: {contours: [2 mm]}]\n",
              to);
    fprintf(to, "boundary: [{traction: [0, 1 MPa], face: y+%s}, {traction: [0, -1 MPa], face: y-%s}]\n", time, time);
}

static void put_inclined(FILE *to, const char *time)
{
    fprintf(to,
            "body: {box: {from: [0, 0], to: [20 mm, 10 mm]}}\n"
            "cracks: [{from: [7.878680 mm, 2.878680 mm], to: [12.121320 mm, 7.121320 mm]}]\n"
            "pd: {region: {box: {from: [6.8 mm, 1.8 mm], to: [13.2 mm, 8.2 mm]}}}\n"
            "probes: [sif: {at: [12.121320 mm, 7.121320 mm], contours: [2 mm]}]\n"
            "boundary: [{traction: [1 MPa, 0], face: x+%s}, {traction: [-1 MPa, 0], face: x-%s}]\n",
            time, time);
}

static void accuracy_cracks_make_scene(const struct accuracy_point *p, struct accuracy_scene *s)
{
    const bool waits = accuracy_point_uses_reference_frame(p);
    const double duration = 200 * (p->at == EDGE ? 10e-3 : 20e-3) / sqrt(200e9 * 9 / 8 / 7850);
    char time[64] = "";
    if (waits) snprintf(time, sizeof time, ", time: {pulse: {until: %.9g}}", 2 * duration);
    FILE *to = fmemopen(s->text, sizeof s->text, "w");
    fprintf(to, "%sduration: %.9g\nsolver_steps: 8000\n", text, waits ? duration : 1);
    bench_overrides_append(&s->set, "solver", "%s", accuracy_solver_of_point(p));
    if (p->at == EDGE)
        put_edge(to, p, 10.0 / p->resolution, time);
    else
        put_inclined(to, time);
    fclose(to);
    bench_overrides_append(&s->set, "particles.spacing", "10/%d mm", p->resolution);
    /* The setting that gave the smaller error for each family in inputs/edge_crack_k1.yaml and inclined_crack.yaml. */
    if (p->method->family & ACCURACY_STATES && (p->horizon == 1.5 || strcmp(p->method->name, "pd ospd") == 0))
        bench_overrides_append(&s->set, "pd.normalisation", "local");
}

/* Computes the errors of K_I, part[0], and K_II, part[1], in the run of point p, both relative to the magnitude
 * (K_I^2 + K_II^2)^(1/2) of the exact factors. *error is the root of the sum of the squares of both. */
static status accuracy_cracks_measure(const struct accuracy_point *p, struct run *run, double *error, double *part)
{
    static const char *const factor[2] = {"K_I", "K_II"};
    const double size = pull * sqrt(M_PI * length[p->at]), *wanted = exact[p->at];
    for (int m = 0; m < 2; m++)
        part[m] =
            (fabs(accuracy_probe_value_of_run(run, "sif", factor[m])) / size - wanted[m]) / hypot(wanted[0], wanted[1]);
    *error = hypot(part[0], part[1]);
    return OK;
}

static bool accuracy_cracks_applies(const struct accuracy_point *p)
{
    const bool inclined = p->at == INCLINED;
    if (p->method->family & ACCURACY_MPM && inclined) return false;
    /* Excluded: bonds to eight neighbours are not isotropic. */
    if (p->method->family & ACCURACY_BONDS && p->horizon == 1.5) return false;
    if (p->resolution > (inclined ? 200 : 400)) return false;
    if (p->method->family & (ACCURACY_PD | ACCURACY_REFERENCE)) return true;
    if (accuracy_point_uses_reference_frame(p)) return p->resolution <= (inclined ? 64 : 100);
    return accuracy_point_can_use_relaxation(p) && p->resolution <= (inclined ? 64 : 100);
}

const struct accuracy_problem accuracy_cracks = {
    .name = "cracks",
    .title = "cracks at rest",
    .error = "stress-intensity factors beside collocation, over the size of both",
    .part = {"K_I", "K_II"},
    .cases = {"edge crack", "inclined crack"},
    .counts = "particles per 10 mm",
    .families = ACCURACY_PD | ACCURACY_REFERENCE | ACCURACY_COUPLED,
    .dim = 2,
    .resolution = {32, 64, 100, 200, 400},
    .quick_resolutions = 2,
    .horizon = {1.5, 2.015, 5.015},
    .varied = 3,
    .remark =
        {"The tip is known to no better than a cell: in the reference frame, linear cells of two spacings, K_I "
         "of a gap is 4.6, 2.2 and 1.5 % high at 32, 64 and 100 particles.",
         "mospd: 0.8, 0.2 % of K_I at 32 and 64 particles, but K_II of the inclined crack 7.5 and 4.6 % high; a "
         "horizon of 1.5 with local families remedies that (2.9 and 1.4 %).",
         "Bodies coupled by partial stress or hand-shake in the current frame were not at rest after 8,000 steps of "
         "relaxation with 64 and 100 particles round the edge crack: shown as unstable. pgg holds the crack together."},
    .seconds = 500,
    .quick_seconds = 40,
    .scene = accuracy_cracks_make_scene,
    .measure = accuracy_cracks_measure,
    .applies = accuracy_cracks_applies,
};
