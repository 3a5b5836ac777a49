/* Tests tractions. On a body of any shape the resultant is the traction times the projected area of the body along the
 * normal of the face. Also checks which particles are loaded, and the momentum that a traction causes in a run. */
#include <string.h>
#include <unistd.h>

#include "tests/support/cloud.h"
#include "engine/engine.h"
#include "scene/fill.h"
#include "base/memory.h"
#include "scene/scene_read.h"
#include "tests/support/near.h"
#include "step/report.h"
#include "mesh/mesh_part.h"
#include "probes/probes.h"
#include "probes/diagnostics.h"
#include "step/step.h"

#define H 1e-3 /* spacing [m] */
#define T 2e-3 /* thickness of plates [m] */
enum { TEXT = 4096 };

struct sample {
    struct scene s;
    struct particles p;
    struct loads l;
};

/* Creates in *a a body with one traction; the loads must be valid or, if `refusal` is not NULL, refused with this
 * message. space, body, more, traction: texts of the keys of the scene. */
static void sample_try(struct sample *a, const char *space, const char *body, const char *more, const char *traction,
                       const char *refusal)
{
    char text[TEXT];
    memset(a, 0, sizeof *a);
    snprintf(text, sizeof text,
             "space: %s\n%sduration: 1 us\nmethod: pd\nmaterial: {young: 72 GPa, poisson: %s, density: 2440}\n"
             "%sparticles: {spacing: 1 mm, horizon: 3.015%s}\nboundary: [{name: pull, %s}]\n",
             space,
             strncmp(space, "plane", 5) == 0 ? "thickness: 2 mm\n"
             : strcmp(space, "line") == 0    ? "section: 3 mm^2\n"
                                             : "",
             strcmp(space, "plane stress") == 0 ? "1/3"
             : strcmp(space, "line") == 0       ? "0"
                                                : "1/4",
             body, more, traction);
    if (scene_read_text(&a->s, text, strlen(text), "faces.yaml", NULL, 0) != OK) fail_msg("%s", status_message());
    assert_ok(bodies_fill_with_particles(&a->p, &a->s, NULL, 0));
    const status made =
        loads_make_from_boundaries(&a->l, a->s.boundary, a->s.boundaries, &a->p, a->s.spacing, 3 * H, 0);
    if (refusal)
        status_check(made, REFUSED, refusal, __FILE__, __LINE__);
    else if (made != OK)
        fail_msg("%s", status_message());
}

static void sample_make(struct sample *a, const char *space, const char *body, const char *more, const char *traction)
{
    sample_try(a, space, body, more, traction, NULL);
}

static void sample_free(struct sample *a)
{
    loads_free(&a->l);
    particles_free(&a->p);
    scene_free(&a->s);
}

/* Returns the loaded area along axis d: the sum of the area shares of all particles under the load of a [m^2]. */
static real area(const struct sample *a, int d)
{
    real sum = 0;
    for (int64_t k = 0; k < a->l.load[0].n; k++) sum += a->l.load[0].share[d][k];
    return sum;
}

/* Returns the area share along axis d of the particle of a that is nearest to the position (x, y) [m^2]. */
static real share_at(const struct sample *a, int d, real x, real y)
{
    for (int64_t k = 0; k < a->l.load[0].n; k++) {
        const int32_t i = a->l.load[0].particle[k];
        if (fabs(a->p.X[0][i] - x) < 0.1 * H && fabs(a->p.X[1][i] - y) < 0.1 * H) return a->l.load[0].share[d][k];
    }
    return 0;
}

/* Returns the number of columns of a lattice along the axis `face`, i.e. the number of particles of p without another
 * particle in front of them. */
static int64_t lattice_columns(const struct particles *p, int face)
{
    int64_t n = 0;
    for (int64_t i = 0; i < p->n; i++) {
        bool first = true;
        for (int64_t j = 0; j < i && first; j++) {
            bool same = true;
            for (int d = 0; d < p->dim && same; d++) same = d == face || fabs(p->X[d][i] - p->X[d][j]) < 0.25 * H;
            first = !same;
        }
        n += first;
    }
    return n;
}

/* ---- lattices ---------------------------------------------------------------------------------------------------- */

#define BOX(x0, y0, x1, y1) "{box: {from: [" #x0 " mm, " #y0 " mm], to: [" #x1 " mm, " #y1 " mm]}}"
#define CUT(x0, y0, x1, y1) "{subtract: " BOX(x0, y0, x1, y1) "}"
#define DISC(x, y, r) "{disc: {centre: [" #x " mm, " #y " mm], radius: " #r " mm}}"
#define BALL(x, y, z, r) "{ball: {centre: [" #x " mm, " #y " mm, " #z " mm], radius: " #r " mm}}"

static const char staircase[] = "body: [" BOX(0, 0, 10, 30) ", " BOX(10, 0, 20, 20) ", " BOX(20, 0, 30, 10) "]\n";
static const char corner[] = "body: [" BOX(0, 0, 30, 10) ", " BOX(0, 10, 8, 25) "]\n";
static const char overhang[] = "body: [" BOX(0, 0, 30, 30) ", " CUT(10, 10, 31, 20) "]\n";
static const char holed[] = "body: [" BOX(0, 0, 30, 30) ", {subtract: " DISC(15, 15, 6) "}]\n";

/* Solids with their projected areas along x and y (and z), and the change of each area if the solid grows by one
 * spacing on all sides. Lengths in m, areas in m^2. */
static const struct solid_shown {
    const char *name, *space, *body;
    real shows[DIM_MAX], spacing[DIM_MAX];
} shapes[] = {
    {"disc", "plane stress", "body: " DISC(0, 0, 20) "\n", {40e-3, 40e-3}, {H, H}},
    {"disc off its lattice", "plane strain", "body: [" DISC(3.3, -1.7, 12.4) "]\n", {24.8e-3, 24.8e-3}, {H, H}},
    {"ring", "plane stress", "body: [" DISC(0, 0, 20) ", {subtract: " DISC(0, 0, 9) "}]\n", {40e-3, 40e-3}, {H, H}},
    {"staircase", "plane stress", staircase, {30e-3, 30e-3}, {H, H}},
    {"corner", "plane strain", corner, {25e-3, 30e-3}, {H, H}},
    {"overhang", "plane stress", overhang, {30e-3, 30e-3}, {H, H}},
    {"hole", "plane stress", holed, {30e-3, 30e-3}, {H, H}},
    {"two discs", "plane stress", "body: [" DISC(0, 0, 10) ", " DISC(24, 5, 6) "]\n", {21e-3, 32e-3}, {H, 2 * H}},
    {"ball", "solid", "body: " BALL(0, 0, 0, 8) "\n", {201.06e-6, 201.06e-6, 201.06e-6}, {50.3e-6, 50.3e-6, 50.3e-6}},
    {"shell",
     "solid",
     "body: [" BALL(0, 0, 0, 8) ", {subtract: " BALL(0, 0, 0, 5) "}]\n",
     {201.06e-6, 201.06e-6, 201.06e-6},
     {50.3e-6, 50.3e-6, 50.3e-6}},
    {"cylinder",
     "solid",
     "body: {cylinder: {from: [0, 0, 0], to: [0, 0, 12 mm], radius: 7 mm}}\n",
     {168e-6, 168e-6, 153.94e-6},
     {26e-6, 26e-6, 44e-6}},
    {"bar", "line", "body: [{box: {from: [0], to: [20 mm]}}]\n", {1}, {1e-9}},
    {"broken bar",
     "line",
     "body: [{box: {from: [0], to: [20 mm]}}, {subtract: {box: {from: [5 mm], to: [9 mm]}}}]\n",
     {1},
     {1e-9}},
};

/* Compares the loaded area of the solid q on its side `side` (-1 or 1) along the axis `face` with the projected area.
 * Random shifts of less than half a spacing do not change the columns of a lattice. */
static void check_shape(const struct solid_shown *q, int face, int side)
{
    static const char *const shaken[] = {"", ", irregularity: 0.5", ", irregularity: 0.8, seed: 3"};
    int64_t columns = 0;
    for (size_t k = 0; k < COUNT_OF(shaken); k++) {
        struct sample a;
        char traction[80];
        const char name[] = {(char)('x' + face), side > 0 ? '+' : '-', '\0'};
        const bool three = strcmp(q->space, "solid") == 0, one = strcmp(q->space, "line") == 0;
        snprintf(traction, sizeof traction, "traction: [%s], face: %s", one ? "1" : three ? "1, 2, 3" : "1, 2", name);
        sample_make(&a, q->space, q->body, shaken[k], traction);
        const real section = one ? 3e-6 : three ? 1 : T, column = section * pow(H, a.p.dim - 1);
        if (k == 0) columns = lattice_columns(&a.p, face);
        for (int d = 0; d < a.p.dim; d++) {
            if (!(fabs(area(&a, d) - (real)columns * column) <= 1e-12 * (real)columns * column))
                fail_msg("%s%s, face %s: %.15g of %lld columns along %d", q->name, shaken[k], name,
                         area(&a, d) / column, (long long)columns, d);
            assert_near(area(&a, d), q->shows[face] * section, q->spacing[face] * section);
        }
        sample_free(&a);
    }
}

static void test_shapes(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(shapes); k++)
        for (int face = 0; face < (strcmp(shapes[k].space, "solid") == 0 ? 3 : *shapes[k].space == 'p' ? 2 : 1); face++)
            for (int side = -1; side <= 1; side += 2) check_shape(&shapes[k], face, side);
}

/* ---- loaded particles -------------------------------------------------------------------------------------------- */

/* Checks that the steps of a stepped face are loaded, whereas surfaces hidden by an overhang and the bottom of a hole
 * are not. If the region of the load excludes the hiding particles, the hidden ones are loaded over their own width
 * only. */
static void test_hidden(void **state)
{
    (void)state;
    struct sample a;
    sample_make(&a, "plane stress", staircase, "", "traction: [0, 1], face: y+");
    for (int step = 0; step < 3; step++)
        for (int k = 0; k < 10; k++)
            assert_close(share_at(&a, 1, (10 * step + k + 0.5) * H, (29.5 - 10 * step) * H), H * T, 1e-12);
    sample_free(&a);

    sample_make(&a, "plane stress", overhang, "", "traction: [0, 1], face: y+");
    assert_int_equal(a.l.load[0].n, 30);
    assert_exact(share_at(&a, 1, 20.5 * H, 9.5 * H), 0);
    sample_free(&a);
    sample_make(&a, "plane stress", overhang, "", "traction: [0, 1], face: y+, region: " BOX(0, 0, 30, 12));
    assert_int_equal(a.l.load[0].n, 20); /* the lower arm; in the columns of the web the outermost particle is higher */
    assert_close(share_at(&a, 1, 20.5 * H, 9.5 * H), H * T, 1e-12);
    sample_free(&a);

    sample_make(&a, "plane stress", holed, "", "traction: [0, 1], face: y+");
    for (int64_t k = 0; k < a.l.load[0].n; k++) assert_true(a.p.X[1][a.l.load[0].particle[k]] > 29 * H);
    sample_free(&a);
    sample_make(&a, "plane stress", holed, "", "traction: [0, 1], face: y+, region: " DISC(15, 15, 8));
    assert_close(area(&a, 1), 12 * H * T, 1e-12); /* the hole has the same width */
    for (int64_t k = 0; k < a.l.load[0].n; k++) {
        const int32_t i = a.l.load[0].particle[k];
        assert_true(a.p.X[1][i] < 15 * H && hypot(a.p.X[0][i] - 15 * H, a.p.X[1][i] - 15 * H) < 7.5 * H);
    }
    sample_free(&a);
    sample_make(&a, "plane stress", holed, ", irregularity: 0.5",
                "traction: [0, 1], face: y+, region: " DISC(15, 15, 8));
    assert_close(area(&a, 1), 12 * H * T, 1e-12);
    sample_free(&a);
}

static void test_refused(void **state)
{
    (void)state;
    struct sample a;
    sample_try(&a, "plane stress", holed, "", "traction: [0, 1], face: y+, region: " BOX(0, 2, 30, 6),
               "boundary pull: seen from y+, other particles of the body are in front of every particle in its region; "
               "choose");
    sample_free(&a);
    sample_try(&a, "plane stress", holed, "", "traction: [0, 1], face: y+, region: " BOX(40, 2, 50, 6),
               "no particle is in its region");
    sample_free(&a);
}

/* Checks that a body hides another one if the traction acts on all bodies, also with different lattices. If the load
 * names its body, other bodies do not hide it. */
static void test_bodies(void **state)
{
    (void)state;
    static const char towers[] = "bodies:\n  - {name: a, shape: [" BOX(0, 0, 20, 10) "]}\n  - {name: b, shape: [" BOX(
        22, 0, 30, 5) "]}\n"
                      "  - {name: c, shape: [" BOX(5.5, 10, 12.5, 15) "]}\n";
    static const struct {
        const char *traction;
        int face;
        real shows;
    } row[] = {{"traction: [0, 1], face: y+", 1, 28e-3},          {"traction: [0, 1], face: y-", 1, 28e-3},
               {"traction: [1, 0], face: x+", 0, 15e-3},          {"traction: [1, 0], face: x-", 0, 15e-3},
               {"traction: [0, 1], face: y+, body: a", 1, 20e-3}, {"traction: [0, 1], face: y-, body: c", 1, 7e-3}};
    for (size_t k = 0; k < COUNT_OF(row); k++)
        for (int shaken = 0; shaken < 2; shaken++) {
            struct sample a;
            sample_make(&a, "plane stress", towers, shaken ? ", irregularity: 0.3" : "", row[k].traction);
            /* With irregularity a half-hidden column may or may not be loaded. */
            assert_near(area(&a, row[k].face), row[k].shows * T, shaken ? (1 + 1e-12) * H * T : 1e-12 * H * T);
            sample_free(&a);
        }
}

/* Checks that the tangential component of a traction on a stepped face acts half a spacing outside the first particle
 * of every column, by comparing its moment with that of the steps. In a column of one particle it acts on this
 * particle. */
static void test_along(void **state)
{
    (void)state;
    struct sample a;
    real moment = 0, wanted = 0;
    sample_make(&a, "plane stress", staircase, "", "traction: [1, 0], face: y+");
    for (int64_t k = 0; k < a.l.load[0].n; k++) moment += a.l.load[0].share[0][k] * a.p.X[1][a.l.load[0].particle[k]];
    for (int step = 0; step < 3; step++) wanted += 10 * H * T * (30 - 10 * step) * H;
    assert_close(moment, wanted, 1e-12);
    sample_free(&a);
    sample_make(&a, "plane stress", "body: " BOX(0, 0, 20, 1) "\n", "", "traction: [1, 0], face: y+");
    assert_close(share_at(&a, 0, 3.5 * H, 0.5 * H), H * T, 1e-12);
    sample_free(&a);
}

/* ---- lists ------------------------------------------------------------------------------------------------------- */

/* Name of the file of the list of particles under test. */
static char list_name[64];

/* Arrangements of particles whose volumes fill their solid: rings of a disc of radius 20 mm, a hexagonal lattice,
 * squares of two sizes, nodes on the border with halves and quarters of the volume, a lattice of spacing 1.3 mm. */
enum list { RINGS, HEXAGONS, TWO_SIZES, NODES, WIDE, LISTS };

static void put_list(FILE *out, enum list list)
{
    fputs("x,y,volume\n", out);
    if (list == RINGS)
        for (int ring = 0; ring < 20; ring++) {
            const int n = (int)nearbyint(2 * M_PI * (ring + 0.5));
            for (int k = 0; k < n; k++)
                fprintf(out, "%.9g,%.9g,%.9g\n", (ring + 0.5) * H * cos(2 * M_PI * k / n),
                        (ring + 0.5) * H * sin(2 * M_PI * k / n), M_PI * (2 * ring + 1) / n * H * H * T);
        }
    for (int y = 0; y < 24 && list == HEXAGONS; y++)
        for (int x = 0; x < 30; x++)
            fprintf(out, "%.9g,%.9g,%.9g\n", (x + 0.25 + 0.5 * (y % 2)) * H, (y + 0.5) * sqrt(0.75) * H,
                    sqrt(0.75) * H * H * T);
    for (int y = 0; y < 20 && list == TWO_SIZES; y++)
        for (int x = 0; x < 20; x++) fprintf(out, "%.9g,%.9g,%.9g\n", (x + 0.5) * H, (y + 0.5) * H, H * H * T);
    for (int y = 0; y < 10 && list == TWO_SIZES; y++)
        for (int x = 0; x < 10; x++) fprintf(out, "%.9g,%.9g,%.9g\n", (2 * x + 21) * H, (2 * y + 1) * H, 4 * H * H * T);
    for (int y = 0; y < 21 && list == NODES; y++)
        for (int x = 0; x < 31; x++)
            fprintf(out, "%.9g,%.9g,%.9g\n", x * H, y * H, (x % 30 ? 1 : 0.5) * (y % 20 ? 1 : 0.5) * H * H * T);
    for (int y = 0; y < 10 && list == WIDE; y++)
        for (int x = 0; x < 20; x++)
            fprintf(out, "%.9g,%.9g,%.9g\n", (x + 0.5) * 1.3 * H, (y + 0.5) * 1.3 * H, 1.69 * H * H * T);
}

static void test_lists(void **state)
{
    (void)state;
    static const struct {
        real shows[2], spacing;
    } solid[LISTS] = {[RINGS] = {{40 * H, 40 * H}, H},
                      [HEXAGONS] = {{20.785 * H, 30.5 * H}, H},
                      [TWO_SIZES] = {{20 * H, 40 * H}, H},
                      [NODES] = {{20 * H, 30 * H}, H},
                      [WIDE] = {{13 * H, 26 * H}, 1e-9 * H}};
    for (int list = 0; list < LISTS; list++) {
        FILE *out = fopen(list_name, "w");
        assert_non_null(out);
        put_list(out, list);
        fclose(out);
        for (int face = 0; face < 4; face++) {
            struct sample a;
            char traction[80], body[120];
            snprintf(traction, sizeof traction, "traction: [1, 1], face: %s",
                     (const char *[]){"x+", "x-", "y+", "y-"}[face]);
            snprintf(body, sizeof body, "bodies: [{name: grains, particles: %s}]\n", list_name);
            sample_make(&a, "plane stress", body, "", traction);
            for (int d = 0; d < 2; d++) {
                const real error = area(&a, d) - solid[list].shows[face / 2] * T;
                if (!(fabs(error) <= solid[list].spacing * T))
                    fail_msg("list %d, face %d: %g spacings too much along %d", list, face, error / (H * T), d);
            }
            sample_free(&a);
        }
    }
    remove(list_name);
}

/* Checks loaded areas in 3D: balls of radius 8 spacings cut from an irregular close packing whose volumes vary by a
 * half. */
static void test_packed(void **state)
{
    (void)state;
    static const char *const face[] = {"x+", "x-", "y+", "y-", "z+", "z-"};
    uint64_t seed = 7;
    FILE *out = fopen(list_name, "w");
    assert_non_null(out);
    fputs("x,y,z,volume\n", out);
    for (int z = -11; z <= 11; z++)
        for (int y = -11; y <= 11; y++)
            for (int x = -11; x <= 11; x++) {
                const real edge = H * cbrt(4); /* of the cubic cell of four */
                const real X[3] = {0.5 * edge * x, 0.5 * edge * y, 0.5 * edge * z};
                if ((x + y + z) % 2 != 0 || dot(X, X, 3) > square(8 * H)) continue;
                for (int d = 0; d < 3; d++) fprintf(out, "%.9g,", X[d] + cloud_between(&seed, -0.2, 0.2) * H);
                fprintf(out, "%.9g\n", 0.25 * pow(edge, 3) * cloud_between(&seed, 0.75, 1.25));
            }
    fclose(out);
    for (int f = 0; f < 6; f++) {
        struct sample a;
        char traction[80], body[120];
        snprintf(traction, sizeof traction, "traction: [1, 1, 1], face: %s", face[f]);
        snprintf(body, sizeof body, "bodies: [{name: grains, particles: %s}]\n", list_name);
        sample_make(&a, "solid", body, "", traction);
        for (int d = 0; d < 3; d++) assert_near(area(&a, d), M_PI * square(8 * H), 2 * M_PI * 8 * H * H);
        sample_free(&a);
    }
    remove(list_name);
}

/* ---- in a run ---------------------------------------------------------------------------------------------------- */

/* Checks that a free body q has the momentum t A T after the time T, with the solver `method` and the further keys
 * `more`. t: traction on the area A of `columns` columns. The momentum is summed over particles, independently of the
 * impulse that the loads report. */
static void check_impulse(const struct solid_shown *q, int64_t columns, const char *method, const char *more)
{
    enum { STEPS = 12 };
    struct scene s;
    struct run *run = NEW("test.engine", 1, struct run);
    struct diagnostics w;
    char text[TEXT];
    const bool three = strcmp(q->space, "solid") == 0, one = strcmp(q->space, "line") == 0;
    snprintf(text, sizeof text,
             "space: %s\n%sduration: 1 ms\n%s\nmaterial: {young: 72 GPa, poisson: %s, density: 2440}\n"
             "%sparticles: {spacing: 1 mm, horizon: 3.015%s}\nconversion: {criteria: none}\n"
             "boundary: [{traction: [%s], face: x+}]\n",
             q->space,
             three ? ""
             : one ? "section: 3 mm^2\n"
                   : "thickness: 2 mm\n",
             method,
             strcmp(q->space, "plane stress") == 0 ? "1/3"
             : one                                 ? "0"
                                                   : "1/4",
             q->body, more,
             one     ? "3e5"
             : three ? "3e5, 2e5, -1e5"
                     : "3e5, -2e5");
    if (scene_read_text(&s, text, strlen(text), "faces.yaml", NULL, 0) != OK) fail_msg("%s", status_message());
    if (run_set_up_from_scene(run, &s, NULL) != OK) fail_msg("%s", status_message());
    run->report->quiet = true;
    assert_ok(report_open_history_and_write_first_frame(run));
    for (int step = 0; step < STEPS; step++) assert_ok(run_adapt_mesh_and_advance_one_step(run));
    diagnostics_initialise(&w);
    const struct grid *nodes[] = {&run->frame->mesh.grid};
    diagnostics_update_momentum(&w, &run->part, nodes, 1, (const real[DIM_MAX]){0});
    const real t = observed_run_make_read_only_view(run).t_velocity, shows = (real)columns * pow(H, s.dim - 1) *
                                                                             (one     ? 3e-6
                                                                              : three ? 1
                                                                                      : T);
    for (int d = 0; d < s.dim; d++) {
        const real given = (const real[]){3e5, three || one ? 2e5 : -2e5, -1e5}[d] * shows * t;
        if (!(fabs(w.now.momentum[d] - given) <= 1e-10 * fabs(given))) /* round-off of 12 steps for 3e5 */
            fail_msg("%s, %s: momentum %.12g where %.12g was given", q->name, method, w.now.momentum[d], given);
    }
    run_free_memory(run);
    scene_free(&s);
    memory_free(run);
}

static void test_impulse(void **state)
{
    (void)state;
    static const char *const method[] = {
        "method: pd",
        "method: mpm\nmpm: {frame: current}",
        "method: mpm\nmpm: {frame: current, transfer: apic}",
        "method: mpm\nmpm: {frame: reference}",
        "method: adaptive\nmpm: {frame: current}\npd: {region: {half-space: {point: [%s], normal: [1%s]}}}",
        "method: adaptive\nmpm: {frame: reference}\npd: {region: {half-space: {point: [%s], normal: [1%s]}}}"};
    for (size_t k = 0; k < COUNT_OF(shapes); k++) {
        struct sample a;
        if (strcmp(shapes[k].name, "shell") == 0 || strcmp(shapes[k].name, "cylinder") == 0)
            continue; /* like the
                       * ball */
        sample_make(&a, shapes[k].space, shapes[k].body, "",
                    *shapes[k].space == 'l'   ? "traction: 1, face: x+"
                    : *shapes[k].space == 'p' ? "traction: [1, 0], face: x+"
                                              : "traction: [1, 0, 0], face: x+");
        const int64_t columns = lattice_columns(&a.p, 0);
        const int dim = a.p.dim;
        sample_free(&a);
        for (size_t m = 0; m < COUNT_OF(method); m++) {
            char text[256];
            const char *const point[] = {"5 mm", "5 mm, 0", "5 mm, 0, 0"}, *const normal[] = {"", ", 0", ", 0, 0"};
            snprintf(text, sizeof text, method[m], point[dim - 1], normal[dim - 1]);
            check_impulse(&shapes[k], columns, text, "");
            if (m == 0) check_impulse(&shapes[k], columns, text, ", irregularity: 0.4");
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_shapes),  cmocka_unit_test(test_hidden),
                                       cmocka_unit_test(test_refused), cmocka_unit_test(test_bodies),
                                       cmocka_unit_test(test_along),   cmocka_unit_test(test_lists),
                                       cmocka_unit_test(test_packed),  cmocka_unit_test(test_impulse)};
    snprintf(list_name, sizeof list_name, "faces%ld.csv", (long)getpid());
    return cmocka_run_group_tests(tests, NULL, NULL);
}
