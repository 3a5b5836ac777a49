/* Failing scenes of bonds: single particles torn off, inversion, crack faces that close. */
#include <math.h>

#include "limits_scenes.h"
#include "probes/diagnostics.h"
#include "mesh/mesh_part.h"

/* ---- single particles -------------------------------------------------------------------------------------------- */

/* Runs a plate from which a corner particle is torn off, with the method of row r. Stores in to[0] 1 if the particle
 * does not fly away, else 0; in to[1] the momentum error and in to[2] the energy error [1]. With a time step of 0.2
 * times the critical one, breaking bonds leave an energy error of some percent. Returns FAILED if a step fails. */
static status single(const struct limits_row *r, double *to)
{
    struct run e;
    struct scene s;
    TRY(limits_make_run_of_scene(
        &e, &s, r,
        "space: plane stress\nthickness: 1e-3\nduration: 2e-5\ntime: {safety: 0.2}\n"
        "material: {young: 72e9, density: 2440, critical_stretch: 0.01, poisson: 1/3}\n"
        "body: {box: {from: [0, 0], to: [12e-3, 12e-3]}}\n"
        "particles: {spacing: 1e-3}\n"
        "initial:\n  - {velocity: [400, 300], region: {box: {from: [11e-3, 11e-3], to: [inf, inf]}}}\n"
        "output: {frames: 0, samples: 20}\n"));
    const status ran = run_advance_to_end_time(&e);
    const int64_t i = e.part.n - 1;
    to[0] = isfinite(e.part.x[0][i]) && e.part.v[0][i] > 100 ? 0 : 1;
    to[1] = e.diagnostics->now.momentum_error;
    to[2] = fabs(e.diagnostics->now.balance_error);
    bench_engine_free(&e, &s);
    return ran;
}

#define LAW(law, kind, ...) NAMED_LAW(law " " kind, law, kind, __VA_ARGS__)
#define NAMED_LAW(name_, law, kind, ...) .method = name_, .set = {"model", law, "method", kind, __VA_ARGS__}
/* A row for a peridynamic model (law) and a method (kind) with the particle that comes off (see single). At its speed a
 * bond gains 1.7 times its critical stretch in a step. The energy of whole neighbourhoods that lose most of their bonds
 * in one step is then at best first order: errors of 0.066 at a safety factor of 0.2, 0.031 at 0.1, 0.014 at 0.025. */
#define SINGLE(law, kind)                                                                                              \
    {                                                                                                                  \
        LAW(law, kind, NULL), .known = { {0, 0}, {0, 1e-13}, {0, 0.05} }                                               \
    }
static const struct limits_row singles[] = {
    SINGLE("bond", "pd"),
    SINGLE("ospd", "pd"),
    SINGLE("mospd", "pd"),
    SINGLE("bond", "adaptive"),
    SINGLE("mospd", "adaptive"),
    {LAW("ospd", "adaptive", NULL), .known = {{0, 0}, {0, 1e-13}, {0.05, 0.08}}, .remedy = "time.safety: 0.1"},
};
const struct limits_scene limits_single = {
    "a single particle comes off",
    NULL,
    {{"particles lost", 0}, {"error of momentum", 1e-12}, {"error of energy", 0.05}},
    ROWS(singles),
    single};

/* ---- compression beyond inversion -------------------------------------------------------------------------------- */

/* Returns the number of pairs of consecutive particles along x whose order has reversed between reference and current
 * positions. */
static int inverted(const struct particles *p)
{
    int pairs = 0;
    for (int64_t i = 0; i + 1 < p->n; i++) pairs += p->X[0][i + 1] > p->X[0][i] && p->x[0][i + 1] < p->x[0][i];
    return pairs;
}

/* Runs two halves of a plate that collide at +-r->given times the wave speed of a bar. Stores in to[0] the number of
 * pairs of neighbours whose order has reversed, in to[1] the energy error [1]. Returns FAILED if a step fails. */
static status inversion(const struct limits_row *r, double *to)
{
    struct run e;
    struct scene s;
    TRY(limits_make_run_of_scene(
        &e, &s, r,
        "space: plane stress\nthickness: 1\nduration: 0.3\ntime: {safety: 0.2}\nmethod: pd\n"
        "material: {young: 1e4, density: 1}\nbody: {box: {from: [0, 0], to: [40, 6]}}\nparticles: {spacing: 1}\n"
        "initial:\n  - {velocity: [%g, 0]}\n"
        "  - {velocity: [%g, 0], region: {box: {from: [20, -inf], to: [inf, inf]}}}\n"
        "output: {frames: 0, samples: 10}\n",
        100 * r->given, -100 * r->given));
    const status ran = run_advance_to_end_time(&e);
    if (e.frame->mesh.points > 0) lagrangian_mesh_update_point_motion_and_stress(e.frame, &e.part, &e.loads);
    to[0] = inverted(&e.part);
    to[1] = fabs(e.diagnostics->now.balance_error);
    bench_engine_free(&e, &s);
    return ran;
}

/* Rows for a peridynamic model (law) with the colliding halves (see inversion). A linear bond has a finite force at
 * zero length. Below 0.7 of their length bonds have an additional repulsion (kernels/pd/bond_core.h): at 0.5 c
 * neighbours keep their order, which they would not without. Faster bodies eject particles from their free ends faster
 * than waves, and the run stops. */
#define INVERSION(law)                                                                                                 \
    {LAW(law, "pd", NULL), .given = 0.2, .known = {{0, 0}, {0, 0.05}}},                                                \
    {                                                                                                                  \
        LAW(law, "pd", NULL), .given = 0.5, .known = { {0, 0}, {0, 0.05} }                                             \
    }
static const struct limits_row inversions[] = {
    INVERSION("bond"),
    INVERSION("ospd"),
    INVERSION("mospd"),
    {.method = "gimp apic",
     .set = {"method", "mpm", "mpm.transfer", "apic"},
     .given = 0.6,
     .known = {{0, 0}, {0.1, 0.25}},
     .remedy = "frame: reference"},
    {.method = "reference frame",
     .set = {"method", "mpm", "mpm.frame", "reference"},
     .given = 0.6,
     .known = {{0, 0}, {0, 0.01}}},
};
const struct limits_scene limits_inversion = {"compression past inversion",
                                              "at %g of the wave speed",
                                              {{"pairs that changed sides", 0}, {"error of energy", 0.05}},
                                              ROWS(inversions),
                                              inversion};

/* ---- crack faces that close -------------------------------------------------------------------------------------- */

/* Returns the largest overlap of the two columns of particles beside the crack at x = 12 in the run [spacings]. */
static double overlap(const struct run *run)
{
    const struct particles *p = &run->part;
    double left = -INFINITY, right = INFINITY;
    for (int64_t i = 0; i < p->n; i++)
        if (fabs(p->X[0][i] - 12) < 1) {
            if (p->X[0][i] < 12)
                left = fmax(left, p->x[0][i]);
            else
                right = fmin(right, p->x[0][i]);
        }
    return left - right + 1;
}

/* Runs two halves of a cut plate that collide at +-0.04 of the wave speed, with the method of row r. Stores in to[0]
 * the largest overlap of the crack faces [spacings], in to[1] the share of their momentum that the halves have not
 * exchanged [1]. Returns FAILED if a step fails. */
static status closing(const struct limits_row *r, double *to)
{
    struct run e;
    struct scene s;
    TRY(limits_make_run_of_scene(
        &e, &s, r,
        "space: plane stress\nthickness: 1\nduration: 0.25\nmaterial: {young: 1e4, density: 1}\n"
        "bodies:\n  - {name: left, shape: {box: {from: [0, 0], to: [12, 6]}}, velocity: [4, 0]}\n"
        "  - {name: right, shape: {box: {from: [12, 0], to: [24, 6]}}, velocity: [-4, 0]}\n"
        "particles: {spacing: 1}\noutput: {frames: 0, samples: 1}\n"));
    status ran = bench_engine_run(&e, 1, NULL);
    to[0] = 0, to[1] = 0;
    while (ran == OK && e.clock.step < e.clock.steps - 1) {
        ran = run_adapt_mesh_and_advance_one_step(&e);
        to[0] = fmax(to[0], overlap(&e));
    }
    for (int64_t i = 0; i < e.part.n; i++) to[1] += e.part.v[0][i] * (e.part.body[i] ? -1 : 1) / 4 / (double)e.part.n;
    to[1] = fmax(0, to[1]);
    bench_engine_free(&e, &s);
    return ran;
}

/* Rows for a peridynamic model (law) with the cut plate (see closing). Peridynamic particles interact by contact, in
 * adaptive runs too, and overlap by 6 v/c over the contact stiffness of 5 bonds, 0.15 spacings here. Material points
 * interact on the grids of their bodies. */
#define CRACK "cracks", "[{from: [12, -1], to: [12, 7]}]"
#define BONDS_BESIDE "pd.region", "[{box: {from: [6, 0], to: [18, 6]}}]"
#define CLOSING(law)                                                                                                   \
    {LAW(law, "pd", CRACK), .known = {{0.1, 0.2}, {0, 0.1}}, .remedy = "contact.stiffness: 4"},                        \
    {                                                                                                                  \
        NAMED_LAW(law " pd, stiffer contact", law, "pd", CRACK, "contact.stiffness", "4"), .known = {                  \
            {0, 0.1},                                                                                                  \
            {0, 0.1}                                                                                                   \
        }                                                                                                              \
    }
static const struct limits_row closings[] = {
    CLOSING("bond"),
    CLOSING("ospd"),
    CLOSING("mospd"),
    {.method = "partial stress, bonds beside the crack",
     .set = {"method", "adaptive", CRACK, BONDS_BESIDE},
     .known = {{0.1, 0.2}, {0, 0.1}},
     .remedy = "contact.stiffness: 4"},
    {.method = "partial stress, points beside the crack",
     .set = {"method", "adaptive", CRACK, "conversion.criteria", "none"},
     .known = {{0.1, 0.2}, {0, 0.1}},
     .remedy = "contact.stiffness: 4"},
    {.method = "gimp flip", .set = {"method", "mpm"}, .known = {{0.1, 0.15}, {0, 0.1}}, .remedy = "mpm.transfer: apic"},
    {.method = "gimp apic", .set = {"method", "mpm", "mpm.transfer", "apic"}, .known = {{0, 0.1}, {0, 0.1}}},
};
const struct limits_scene limits_closing = {"faces of a crack close",
                                            NULL,
                                            {{"overlap [spacings]", 0.1}, {"momentum not handed over", 0.1}},
                                            ROWS(closings),
                                            closing};
