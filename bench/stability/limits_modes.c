/* Zero-energy modes of free bodies of bonds, and their lowest elastic frequency. */
#include <math.h>

#include "limits_scenes.h"
#include "base/memory.h"

/* The matrix M^(-1/2) K M^(-1/2) of a free body, n x n, with stiffness K and masses M. */
struct matrix {
    int64_t n;
    real *at;
};

/* Returns the matrix M^(-1/2) K M^(-1/2) of the body of the run, which consists of bonds, with stiffness K and masses
 * M. It is computed column by column from finite differences of the forces and made symmetric. The caller releases its
 * member `at` with memory_free. */
static struct matrix matrix_of(struct run *run)
{
    struct bond_stiffness_operator body =
        bond_stiffness_operator_make(&run->bonds, &run->part, run->kernels.bond_force, NULL, run->scene->spacing);
    struct matrix m = {.n = run->part.dim * run->part.n};
    real *unit = NEW("modes.unit", m.n, real);
    m.at = NEW("modes.matrix", m.n * m.n, real);
    for (int64_t k = 0; k < m.n; k++) {
        unit[k] = 1;
        bond_stiffness_operator_apply(&body, unit, &m.at[k * m.n]);
        unit[k] = 0;
    }
    for (int64_t k = 0; k < m.n; k++)
        for (int64_t j = 0; j < k; j++)
            m.at[k * m.n + j] = m.at[j * m.n + k] = 0.5 * (m.at[k * m.n + j] + m.at[j * m.n + k]);
    memory_free(unit);
    bond_stiffness_operator_free(&body);
    return m;
}

/* Returns the number of eigenvalues of the symmetric matrix m below x: the number of negative pivots in the elimination
 * of m - x I (Sylvester 1852). */
static int64_t limits_modes_below(const struct matrix *m, real x)
{
    const int64_t n = m->n;
    int64_t count = 0;
    real *a = NEW("modes.pivots", n * n, real);
    for (int64_t k = 0; k < n * n; k++) a[k] = m->at[k] - (k % (n + 1) == 0 ? x : 0);
    for (int64_t k = 0; k < n; k++) {
        count += a[k * n + k] < 0;
        for (int64_t i = k + 1; i < n; i++) {
            const real share = a[i * n + k] / a[k * n + k];
            for (int64_t j = k + 1; share != 0 && j < n; j++) a[i * n + j] -= share * a[k * n + j];
        }
    }
    memory_free(a);
    return count;
}

/* Returns the eigenvalue of the matrix m that has `lower` smaller ones, by bisection between 0 and `high` to a relative
 * error of 1e-4. high: an upper bound of the eigenvalues. */
static real eigenvalue(const struct matrix *m, int64_t lower, real high)
{
    real low = 0;
    while (high - low > 1e-4 * high) {
        const real middle = 0.5 * (low + high);
        if (limits_modes_below(m, middle) > lower)
            high = middle;
        else
            low = middle;
    }
    return high;
}

/* Returns an upper bound of the eigenvalues of the matrix m: its largest absolute row sum (Gershgorin). */
static real bound(const struct matrix *m)
{
    real most = 0;
    for (int64_t i = 0; i < m->n; i++) {
        real sum = 0;
        for (int64_t k = 0; k < m->n; k++) sum += fabs(m->at[i * m->n + k]);
        most = fmax(most, sum);
    }
    return most;
}

#define SIDE 12      /* particles along an edge of the square, 1 mm apart */
#define NOTHING 1e-6 /* relative to the stiffest mode: differences leave 1e-7, the softest elastic mode has 1e-2 */
enum { RIGID = 3 };  /* rigid motions in the plane */

static status square_make(struct run *run, struct scene *s, const struct limits_row *r, double poisson)
{
    return limits_make_run_of_scene(run, s, r,
                                    "space: plane stress\nthickness: 1e-3\nduration: 1e-6\nmethod: pd\n"
                                    "material: {young: 72e9, density: 2440, poisson: %.17g}\n"
                                    "body: {box: {from: [0, 0], to: [%de-3, %de-3]}}\nparticles: {spacing: 1e-3}\n"
                                    "output: {frames: 0, samples: 1}\n",
                                    poisson, SIDE, SIDE);
}

/* ---- zero-energy modes ------------------------------------------------------------------------------------------- */

/* Counts the zero-energy modes of a free square beyond its three rigid motions, with the method of row r, and stores
 * their number in *to. Returns REFUSED or FAILED if the run cannot be created. */
static status modes(const struct limits_row *r, double *to)
{
    struct run e;
    struct scene s;
    TRY(square_make(&e, &s, r, 1.0 / 3));
    struct matrix m = matrix_of(&e);
    *to = (double)(limits_modes_below(&m, NOTHING * bound(&m)) - RIGID);
    memory_free(m.at);
    bench_engine_free(&e, &s);
    return OK;
}

/* Methods and expected numbers of zero-energy modes (see modes), on a lattice or with irregular positions. law:
 * peridynamic model; reach: horizon [spacings]. Springs between nearest neighbours of a square lattice have no shear
 * stiffness: 2 n^2 coordinates and 2 n (n - 1) independent springs in straight rows leave 2 n modes, three of them
 * rigid. */
#define LATTICE(law, reach) .method = law ", horizon " reach, .set = {"model", law, "particles.horizon", reach}
#define CLOUD(law, reach)                                                                                              \
    .method = law ", horizon " reach ", irregular 0.5",                                                                \
    .set = {"model", law, "particles.horizon", reach, "particles.irregularity", "0.5"}
#define LOOSE 2 * SIDE - RIGID
#define LONGER "a horizon of 1.5 or more, or mospd"
static const struct limits_row costless[] = {
    {LATTICE("bond", "1"), .known = {{LOOSE, LOOSE}}, .remedy = LONGER},
    {LATTICE("ospd", "1"), .known = {{LOOSE, LOOSE}}, .remedy = LONGER},
    {LATTICE("mospd", "1"), .known = {{0, 0}}},
    {LATTICE("bond", "1.5"), .known = {{0, 0}}},
    {LATTICE("ospd", "1.5"), .known = {{0, 0}}},
    {LATTICE("mospd", "1.5"), .known = {{0, 0}}},
    {CLOUD("bond", "1.5"), .known = {{0, 0}}},
    {CLOUD("ospd", "1.5"), .known = {{0, 0}}},
    {CLOUD("mospd", "1.5"), .known = {{0, 0}}},
    {CLOUD("bond", "3.015"), .known = {{0, 0}}},
    {CLOUD("ospd", "3.015"), .known = {{0, 0}}},
    {CLOUD("mospd", "3.015"), .known = {{0, 0}}},
};
const struct limits_scene limits_modes_figure = {
    "motions that cost nothing", NULL, {{"zero-energy modes that are not rigid", 0}}, ROWS(costless), modes};

/* ---- lowest elastic frequency ------------------------------------------------------------------------------------ */

/* Exact omega L/c_p of the lowest in-plane mode of a free square, nu = 0.3 (Bardell, Langley & Dunsdon 1996, table 2);
 * incomplete neighbourhoods at surfaces make it softer or stiffer. */
#define LOWEST 2.321

static status softest(const struct limits_row *r, double *to)
{
    struct run e;
    struct scene s;
    TRY(square_make(&e, &s, r, 0.3));
    struct matrix m = matrix_of(&e);
    const double c = sqrt(72e9 / (1 - 0.3 * 0.3) / 2440);
    *to = fabs(sqrt(eigenvalue(&m, RIGID, bound(&m))) * SIDE * 1e-3 / c / LOWEST - 1);
    memory_free(m.at);
    bench_engine_free(&e, &s);
    return OK;
}

static const struct limits_row soft[] = {
    {LATTICE("ospd", "1.5"), .known = {{0.01, 0.03}}},
    {LATTICE("mospd", "1.5"), .known = {{0.01, 0.03}}},
    {CLOUD("ospd", "1.5"), .known = {{0.12, 0.22}}, .remedy = "a horizon of 3.015, or mospd"},
    {CLOUD("mospd", "1.5"), .known = {{0, 0.015}}},
    {LATTICE("ospd", "3.015"), .known = {{0.01, 0.03}}},
    {LATTICE("mospd", "3.015"), .known = {{0.03, 0.055}}},
    {CLOUD("ospd", "3.015"), .known = {{0.02, 0.045}}},
    {CLOUD("mospd", "3.015"), .known = {{0.06, 0.1}}},
    {.method = "mospd, horizon 3.015, local",
     .set = {"model", "mospd", "pd.normalisation", "local"},
     .known = {{0.07, 0.1}}},
    {.method = "ospd, horizon 3.015, bulk",
     .set = {"model", "ospd", "pd.normalisation", "bulk"},
     .known = {{0.02, 0.06}}},
};
const struct limits_scene limits_softest = {
    "softest mode of a small free body: surfaces", NULL, {{"error of the frequency", 0.1}}, ROWS(soft), softest};
