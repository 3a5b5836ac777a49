/* Checks that the internal forces of bonds, states, cells of the reference frame and supports are the gradient of one
 * non-negative energy. The linearised operator K must be symmetric, without negative eigenvalues, and with no more zero
 * eigenvalues than rigid motions and the zero-energy modes of bonds or cells alone. The energy must be the one of the
 * energy balance. Prints a line for each case.
 *
 *     build/tests/test_operator [part of a case's name] ...
 *
 * runs the cases whose names contain one of the parts. OPERATOR_DUMP=folder writes every K to the folder
 * (operator_dump), OPERATOR_FLUTTER=1 also computes complex eigenvalues, OPERATOR_SHOW=1 updates the stress of points
 * before each evaluation, as a sample does. */
#include <stdarg.h>
#include <setjmp.h>
#include <omp.h>
#include <stdlib.h>
#include <cmocka.h>

#include "tests/support/near.h"
#include "tests/support/operator.h"
#include "mesh/mesh_part.h"
#include "step/step.h"

#define SYMMETRIC 1e-8   /* relative to the largest entry: differences leave 1e-11 */
#define LEDGER 1e-6      /* terms of third order at displacements of 1e-6 spacings */
#define NEGATIVE (-1e-8) /* relative to the highest eigenvalue: differences leave 1e-11 */

/* A named case. loose: number of zero-energy modes of the bonds or cells alone, besides rigid motions. */
struct body {
    const char *name;
    struct stability_case c;
    int loose;
};

static char **asked; /* parts of names on the command line */
static int asks, done, wrong;

/* ---- one case ---------------------------------------------------------------------------------------------------- */

/* Returns the number of rigid motions that the supports of the case c allow for `bodies` separate bodies. */
static int rigid_of(const struct stability_case *c, int bodies)
{
    static const int rigid[][DIM_MAX + 1] = {[FREE] = {0, 1, 3, 6},
                                             [MIRROR] = {0, 0, 1, 3},
                                             [MIRROR_ACROSS] = {0, 0, 1, 3},
                                             [MIRRORS] = {0, 0, 0, 1},
                                             [FIXED] = {0}};
    return rigid[c->support][c->dim] * bodies;
}

static bool is_asked(const char *name)
{
    for (int k = 0; k < asks; k++)
        if (strstr(name, asked[k])) return true;
    return asks == 0;
}

static void dump(const struct operator* o, const char *name)
{
    char path[512];
    if (!getenv("OPERATOR_DUMP")) return;
    snprintf(path, sizeof path, "%s/%s.txt", getenv("OPERATOR_DUMP"), name);
    for (char *c = strrchr(path, '/') + 1; *c; c++)
        if (*c == ' ' || *c == '/' || *c == ',') *c = '_';
    operator_dump(o, path);
}

static void check(const char *name, const struct stability_case *c, int loose)
{
    struct operator o;
    if (!is_asked(name)) return;
    done++;
    const status made = operator_make(&o, c);
    if (made != OK) {
        wrong++;
        printf("  %-62s %s\n", name, status_message());
        return;
    }
    const struct spectrum s = operator_spectrum(&o, getenv("OPERATOR_FLUTTER") != NULL);
    const int rigid = rigid_of(c, o.s.bodies);
    const bool good =
        s.asymmetry <= SYMMETRIC && s.lowest >= NEGATIVE * s.highest && s.zeros <= rigid + loose && s.energy <= LEDGER;
    wrong += !good;
    printf("%s %-62s %4lld %9.1e %10.1e  %2lld of %d %9.1e", good ? "  " : "! ", name, (long long)o.n, s.asymmetry,
           s.lowest / s.highest, (long long)s.zeros, rigid + loose, s.energy);
    if (getenv("OPERATOR_FLUTTER")) printf("  %8.1e", s.imaginary);
    putchar('\n');
    fflush(stdout);
    dump(&o, name);
    operator_free(&o);
}

static void check_all(const struct body *b, int n)
{
    for (int k = 0; k < n; k++) check(b[k].name, &b[k].c, b[k].loose);
}

/* Begins a test: sets the number of failures to zero and uses one thread. A test ends by checking that there were
 * none. */
static void begin(void)
{
    omp_set_num_threads(1); /* bodies are small */
    wrong = 0;
}

/* ---- eigenvalue routines ----------------------------------------------------------------------------------------- */

/* Checks the eigenvalue routines against closed forms: 2 - 2 cos(k pi/n) for a free chain of n springs, n and 2n for
 * ones plus n on the diagonal, and the n-th roots of 1 for a cyclic shift. */
static void test_tools(void **state)
{
    (void)state;
    enum { N = 12 };
    real A[N * N] = {0}, d[N], scratch[N], least;
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) A[i * N + j] = i == j ? (i == 0 || i == N - 1 ? 1 : 2) : abs(i - j) == 1 ? -1 : 0;
    eigen_symmetric(A, N, d, scratch);
    for (int k = 0; k < N; k++) assert_near(d[k], 2 - 2 * cos(k * M_PI / N), 1e-14);
    for (int i = 0; i < N; i++) /* a dense matrix: 1 + n on the diagonal, else 1 */
        for (int j = 0; j < N; j++) A[i * N + j] = 1 + (i == j) * N;
    eigen_symmetric(A, N, d, scratch);
    for (int k = 0; k < N; k++) assert_near(d[k], k < N - 1 ? N : 2 * N, 1e-12);
    memset(A, 0, sizeof A);
    for (int i = 0; i < N; i++) A[i * N + (i + 1) % N] = 1;
    assert_near(eigen_imaginary(A, N, &least), 1, 1e-13);
    assert_near(least, -1, 1e-13);
}

/* ---- bonds and states -------------------------------------------------------------------------------------------- */

#define PLANE .dim = 2, .edge = 10
#define BONDS PLANE, .method = "pd", .model = "bond"
#define STATES(m, nu) PLANE, .method = "pd", .model = m, .poisson = nu
static const struct body alone[] = {
    {"pd line", {.dim = 1, .edge = 24, .method = "pd"}, 0},
    {"pd bond", {BONDS}, 0},
    {"pd bond, plane strain", {BONDS, .space = "plane strain"}, 0},
    {"pd bond, isotropic, horizon 2.015", {BONDS, .weights = "isotropic", .horizon = 2.015}, 0},
    {"pd bond, continuum, no surface correction", {BONDS, .calibration = "continuum", .surface = "none"}, 0},
    {"pd bond, irregular", {BONDS, .irregularity = 0.5}, 0},
    {"pd bond, notch", {BONDS, .region = NOTCH}, 0},
    {"pd bond, two materials", {BONDS, .heavier = 8}, 0},
    {"pd ospd nu 0.2", {STATES("ospd", 0.2)}, 0},
    {"pd ospd nu 0.49, plane strain", {STATES("ospd", 0.49), .space = "plane strain"}, 0},
    {"pd ospd nu 0.45, irregular, notch", {STATES("ospd", 0.45), .irregularity = 0.5, .region = NOTCH}, 0},
    {"pd ospd nu 0.3, two materials", {STATES("ospd", 0.3), .heavier = 8}, 0},
    {"pd mospd nu 0.2", {STATES("mospd", 0.2)}, 0},
    {"pd mospd nu 0.49, plane strain", {STATES("mospd", 0.49), .space = "plane strain"}, 0},
    {"pd mospd nu 0.45, irregular, notch", {STATES("mospd", 0.45), .irregularity = 0.5, .region = NOTCH}, 0},
    {"pd mospd nu 0.3, local", {STATES("mospd", 0.3), .normalisation = "local"}, 0},
    {"pd solid bond", {.dim = 3, .edge = 5, .method = "pd", .horizon = 2.015}, 0},
    {"pd solid ospd nu 0.3",
     {.dim = 3, .edge = 5, .method = "pd", .model = "ospd", .poisson = 0.3, .horizon = 2.015},
     0},
    {"pd solid mospd nu 0.45",
     {.dim = 3, .edge = 5, .method = "pd", .model = "mospd", .poisson = 0.45, .horizon = 2.015},
     0},
};

static void test_alone(void **state)
{
    (void)state;
    begin();
    check_all(alone, COUNT_OF(alone));
    assert_int_equal(wrong, 0);
}

/* ---- cells ------------------------------------------------------------------------------------------------------- */

#define CELLS .method = "mpm", .frame = "reference"
static const struct body cells[] = {
    {"mpm line", {.dim = 1, .edge = 24, CELLS}, 0},
    {"mpm nu 0", {PLANE, CELLS}, 0},
    {"mpm nu 0.49, plane strain", {PLANE, CELLS, .poisson = 0.49, .space = "plane strain"}, 0},
    {"mpm nu 0.3, half cells at its edges", {PLANE, CELLS, .poisson = 0.3, .offset = 0.5}, 0},
    {"mpm nu 0.3, small strain, lattice", {PLANE, CELLS, .poisson = 0.3, .strain = "small", .constants = "lattice"}, 0},
    {"mpm nu 0.3, mirror", {PLANE, CELLS, .poisson = 0.3, .support = MIRROR}, 0},
    {"mpm nu 0.3, clamp", {PLANE, CELLS, .poisson = 0.3, .support = CLAMP}, 0},
    {"mpm nu 0.3, clamp between nodes", {PLANE, CELLS, .poisson = 0.3, .support = CLAMP, .offset = 0.5}, 0},
    {"mpm nu 0.3, clamp and mirror", {PLANE, CELLS, .poisson = 0.3, .support = CLAMP_MIRROR}, 0},
    {"mpm nu 0.3, fixed", {PLANE, CELLS, .poisson = 0.3, .support = FIXED}, 0},
    {"mpm solid nu 0.45", {.dim = 3, .edge = 6, CELLS, .poisson = 0.45}, 0},
};

static void test_cells(void **state)
{
    (void)state;
    begin();
    check_all(cells, COUNT_OF(cells));
    assert_int_equal(wrong, 0);
}

/* A block with a slit from its edge, between cells, inside them (at 5 spacings) or oblique; in 3D through its depth. */
#define SLIT(height, end, more)                                                                                        \
    "space: plane stress\nthickness: 1e-3\nduration: 1\nmethod: adaptive\n"                                            \
    "material: {young: 72e9, density: 2440}\nbody: {box: {from: [0, 0], to: [14e-3, 10e-3]}}\n"                        \
    "particles: {spacing: 1e-3, horizon: 2.015}\ncracks: [{from: [-1e-3, " height "], to: [9.3e-3, " end "]}]\n"       \
    "conversion: {notch: slit, tips: 1}\ncontact: {between: none}\noutput: {frames: 0, samples: 1}\n" more
static const struct body slits[] = {
    {"slit between cells", {.dim = 2, .text = SLIT("4e-3", "4e-3", "")}, 0},
    {"slit inside cells", {.dim = 2, .text = SLIT("5e-3", "5e-3", "")}, 0},
    {"slit oblique", {.dim = 2, .text = SLIT("4.2e-3", "7.4e-3", "")}, 0},
    {"slit inside cells, small strain", {.dim = 2, .text = SLIT("5e-3", "5e-3", "mpm: {strain: small}\n")}, 0},
    {"slit inside cells, ospd", {.dim = 2, .text = SLIT("5e-3", "5e-3", "model: ospd\n")}, 0},
    {"slit in space",
     {.dim = 3,
      .text = "space: solid\nduration: 1\nmethod: adaptive\nmaterial: {young: 72e9, density: 2440}\n"
              "body: {box: {from: [0, 0, 0], to: [10e-3, 6e-3, 3e-3]}}\nparticles: {spacing: 1e-3, horizon: 1.5}\n"
              "cracks: [{polygon: [[-1e-3, 3e-3, -1e-3], [7.3e-3, 3e-3, -1e-3], [7.3e-3, 3e-3, 4e-3], [-1e-3, 3e-3, "
              "4e-3]]}]\n"
              "conversion: {notch: slit, tips: 1}\ncontact: {between: none}\noutput: {frames: 0, samples: 1}\n"},
     0},
};

static void test_slits(void **state)
{
    (void)state;
    begin();
    check_all(slits, COUNT_OF(slits));
    assert_int_equal(wrong, 0);
}

/* A body of two materials whose interface crosses cells and bonds. */
#define PARTS(at, more)                                                                                                \
    "space: plane stress\nthickness: 1e-3\nduration: 1\nmaterials: [{name: a, young: 72e9, density: 2440}, "           \
    "{name: b, young: 9e9, density: 1200}]\nbody: {box: {from: [0, 0], to: [12e-3, 10e-3]}}\n"                         \
    "parts: [{region: {box: {from: [0, " at "], to: [12e-3, 10e-3]}}, material: b}]\n"                                 \
    "particles: {spacing: 1e-3, horizon: 2.015}\noutput: {frames: 0, samples: 1}\n" more
#define PART_BONDS "method: adaptive\npd: {region: {box: {from: [7e-3, 0], to: [12e-3, 10e-3]}}}\n"
static const struct body parts[] = {
    {"parts, bonds", {.dim = 2, .text = PARTS("4e-3", "method: pd\n")}, 0},
    {"parts, cells", {.dim = 2, .text = PARTS("4e-3", "method: mpm\n")}, 0},
    {"parts, cells that are cut", {.dim = 2, .text = PARTS("5e-3", "method: mpm\n")}, 0},
    {"parts, partial", {.dim = 2, .text = PARTS("4e-3", PART_BONDS)}, 0},
    {"parts, partial, cells that are cut", {.dim = 2, .text = PARTS("5e-3", PART_BONDS)}, 0},
    {"parts, partial, ospd", {.dim = 2, .text = PARTS("5e-3", PART_BONDS "model: ospd\n")}, 0},
    {"parts, partial, mospd", {.dim = 2, .text = PARTS("5e-3", PART_BONDS "model: mospd\n")}, 0},
};

static void test_parts(void **state)
{
    (void)state;
    begin();
    check_all(parts, COUNT_OF(parts));
    assert_int_equal(wrong, 0);
}

/* ---- coupled ----------------------------------------------------------------------------------------------------- */

static const struct {
    const char *name;
    enum stability_region region;
    double offset;
} shapes[] = {{"half", HALF, 0},
              {"half, cut cells", HALF, 0.5},
              {"strip", STRIP, 0},
              {"square", SQUARE, 0},
              {"square, cut cells", SQUARE, 0.5},
              {"corner", CORNER, 0},
              {"corner, cut cells", CORNER, 0.5},
              {"disc", DISC, 0},
              {"notch", NOTCH, 0},
              {"notch, cut cells", NOTCH, 0.5},
              {"spots", SPOTS, 0}};
static const struct {
    const char *name;
    struct stability_case c;
} laws[] = {
    {"bond", {.model = "bond"}},
    {"bond lattice", {.model = "bond", .constants = "lattice"}},
    {"bond isotropic weights 2.015", {.model = "bond", .weights = "isotropic", .horizon = 2.015}},
    {"bond small strain, plane strain", {.model = "bond", .strain = "small", .space = "plane strain"}},
    {"bond continuum", {.model = "bond", .calibration = "continuum"}},
    {"bond surface correction", {.model = "bond", .surface = "volume"}},
    {"ospd nu 1/3", {.model = "ospd", .poisson = 1.0 / 3}},
    {"ospd nu 0.2", {.model = "ospd", .poisson = 0.2}},
    {"ospd nu 0.49, plane strain", {.model = "ospd", .poisson = 0.49, .space = "plane strain"}},
    {"mospd nu 1/4", {.model = "mospd", .poisson = 0.25}},
    {"mospd nu 0", {.model = "mospd", .poisson = 1e-9}},
    {"mospd nu 0.45", {.model = "mospd", .poisson = 0.45}},
    {"mospd nu 0.49, plane strain", {.model = "mospd", .poisson = 0.49, .space = "plane strain"}},
    {"mospd nu 0.3 local", {.model = "mospd", .poisson = 0.3, .normalisation = "local"}},
    {"mospd nu 0.3 small strain", {.model = "mospd", .poisson = 0.3, .strain = "small"}},
};

static struct stability_case coupled(struct stability_case law)
{
    law.dim = 2, law.edge = 12, law.method = "adaptive", law.frame = "reference";
    return law;
}

/* Checks coupled bodies of every law with every shape of the peridynamic region: all with partial stress, every third
 * combination with handshake coupling. */
static void test_coupled(void **state)
{
    (void)state;
    begin();
    for (size_t l = 0; l < COUNT_OF(laws); l++)
        for (size_t k = 0; k < COUNT_OF(shapes); k++)
            for (int handshake = 0; handshake < 2; handshake++) {
                char name[128];
                struct stability_case c = coupled(laws[l].c);
                if (handshake && (l + k) % 3) continue;
                c.region = shapes[k].region, c.offset = shapes[k].offset;
                c.coupling = handshake ? "handshake" : "partial stress";
                snprintf(name, sizeof name, "%s, %s, %s", handshake ? "handshake" : "partial", laws[l].name,
                         shapes[k].name);
                check(name, &c, 0);
            }
    assert_int_equal(wrong, 0);
}

static void test_coupled_elsewhere(void **state)
{
    (void)state;
    begin();
    static const char *const model[] = {"bond", "ospd", "mospd"};
    for (int m = 0; m < 3; m++)
        for (int k = 0; k < 3; k++) {
            char name[128];
            struct stability_case c = {.dim = 3,
                                       .edge = 6,
                                       .method = "adaptive",
                                       .frame = "reference",
                                       .model = model[m],
                                       .horizon = 2.015,
                                       .poisson = m ? 0.3 : 0,
                                       .region = (const enum stability_region[]){HALF, CORNER, DISC}[k]};
            c.coupling = "partial stress";
            snprintf(name, sizeof name, "solid %s, %s", model[m], (const char *[]){"half", "corner", "ball"}[k]);
            check(name, &c, 0);
        }
    for (int k = 0; k < 2; k++) {
        const struct stability_case c = {.dim = 1,
                                         .edge = 24,
                                         .method = "adaptive",
                                         .frame = "reference",
                                         .coupling = "partial stress",
                                         .region = k ? STRIP : HALF};
        check(k ? "line bond, strip" : "line bond, half", &c, 0);
    }
    assert_int_equal(wrong, 0);
}

/* ---- supports ---------------------------------------------------------------------------------------------------- */

static const struct {
    const char *name;
    enum stability_support support;
} supports[] = {{"mirror", MIRROR}, {"mirror across", MIRROR_ACROSS}, {"two mirrors", MIRRORS},
                {"clamp", CLAMP},   {"clamp across", CLAMP_ACROSS},   {"clamp and mirror", CLAMP_MIRROR},
                {"fixed", FIXED}};

static void test_supports(void **state)
{
    (void)state;
    begin();
    static const char *const model[] = {"bond", "ospd", "mospd"};
    for (int coupled_too = 0; coupled_too < 2; coupled_too++)
        for (int m = 0; m < 3; m++)
            for (size_t k = 0; k < COUNT_OF(supports); k++) {
                char name[128];
                struct stability_case c = {
                    .dim = 2, .edge = 10, .method = "pd", .model = model[m], .poisson = m ? 0.3 : 0};
                if (coupled_too) c = coupled(c), c.coupling = "partial stress";
                c.support = supports[k].support;
                snprintf(name, sizeof name, "%s %s, %s", coupled_too ? "partial" : "pd", model[m], supports[k].name);
                check(name, &c, 0);
            }
    const struct stability_case shaken = {
        .dim = 2, .edge = 10, .method = "pd", .model = "bond", .irregularity = 0.5, .support = CLAMP_MIRROR};
    check("pd bond, irregular, clamp and mirror", &shaken, 0);
    const struct stability_case solid = {
        .dim = 3, .edge = 5, .method = "pd", .model = "mospd", .poisson = 0.3, .horizon = 2.015, .support = CLAMP};
    check("pd solid mospd, clamp", &solid, 0);
    assert_int_equal(wrong, 0);
}

int main(int n, char **words)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_tools),
                                       cmocka_unit_test(test_alone),
                                       cmocka_unit_test(test_cells),
                                       cmocka_unit_test(test_slits),
                                       cmocka_unit_test(test_parts),
                                       cmocka_unit_test(test_coupled),
                                       cmocka_unit_test(test_coupled_elsewhere),
                                       cmocka_unit_test(test_supports)};
    asked = words + 1, asks = n - 1;
    printf("  %-62s    n asymmetry lowest/highest zeros    energy\n", "case");
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    printf("%d cases\n", done);
    return failed;
}
