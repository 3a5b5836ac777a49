/* Cases of the stability map: methods, dimensions, shape functions, points per cell, horizons and couplings. */
#include <string.h>

#include "stability.h"

const char *const stability_group_name[STABILITY_GROUP] = {[GROUP_PD] = "peridynamics",
                                                           [GROUP_SHEET] = "as published",
                                                           [GROUP_POINTS] = "material points",
                                                           [GROUP_COUPLED] = "coupled",
                                                           [GROUP_REFERENCE] = "reference frame"};

struct taker {
    bool quick;
    stability_take *take;
    void *context;
};

static status stability_cases_give(const struct taker *t, struct stability_case c) { return t->take(t->context, &c); }

static const char *const model[] = {"bond", "ospd", "mospd"};
static const char *const transfer[] = {"flip", "apic"};

/* ---- peridynamics ------------------------------------------------------------------------------------------------ */

/* Passes to the callback t->take each peridynamic case: several horizons for each dimension and model. Returns the
 * first status that is not OK. */
static status horizons(const struct taker *t)
{
    static const double horizon[] = {3.015, 1, 2.015, 1.5, 4.015, 5.015, 6.015};
    for (int dim = 1; dim <= DIM_MAX; dim++)
        for (int m = 0; m < (dim == 1 ? 1 : 3); m++)
            for (int h = 0; h < (dim == 3 ? t->quick ? 1 : 5 : t->quick && m > 0 ? 3 : 7); h++)
                TRY(stability_cases_give(
                    t, (struct stability_case){
                           .group = GROUP_PD, .dim = dim, .method = "pd", .model = model[m], .horizon = horizon[h]}));
    return OK;
}

static status variants(const struct taker *t)
{
    static const struct stability_case variant[] = {
        {.note = "irregular 0.5", .irregularity = 0.5},
        {.note = "no surface correction", .surface = "none"},
        {.note = "isotropic weights", .weights = "isotropic"},
        {.note = "two materials 8:1", .heavier = 8},
        {.note = "continuum", .calibration = "continuum"},
        {.note = "bulk", .normalisation = "bulk", .model = "state"},
        {.note = "nearly incompressible", .poisson = 0.49, .space = "plane strain", .model = "state"},
    };
    for (int dim = 2; dim <= (t->quick ? 2 : 3); dim++)
        for (int m = 0; m < 3; m++)
            for (size_t v = 0; v < COUNT_OF(variant); v++) {
                struct stability_case c = variant[v];
                if ((c.model && m == 0) || (c.calibration && m > 0) || (c.weights && m > 0)) continue;
                c.group = GROUP_PD, c.dim = dim, c.method = "pd", c.model = model[m];
                if (dim == 3) c.space = NULL, c.horizon = 2.015;
                TRY(stability_cases_give(t, c));
            }
    return OK;
}

/* Passes to the callback t->take each case with a published stability limit: large lattices of complete neighbourhoods,
 * without surface correction. Returns the first status that is not OK. */
static status stability_cases_published(const struct taker *t)
{
    static const struct stability_case row[] = {
        {.dim = 1, .model = "bond", .calibration = "continuum", .edge = 96, .quoted_low = 1.85},
        {.dim = 2, .model = "bond", .calibration = "continuum", .edge = 30, .quoted_low = 2.00},
        {.dim = 3, .model = "bond", .calibration = "continuum", .edge = 14, .quoted_low = 1.92},
        {.dim = 1, .model = "bond", .edge = 96, .quoted_low = 2.12, .note = "lattice"},
        {.dim = 2, .model = "bond", .edge = 30, .quoted_low = 2.03, .note = "lattice"},
        {.dim = 2, .model = "ospd", .edge = 30, .poisson = 0.3, .quoted_low = 1.79},
        {.dim = 2, .model = "mospd", .edge = 30, .poisson = 0.3, .normalisation = "local", .quoted_low = 1.94},
    };
    for (size_t k = 0; k < COUNT_OF(row); k++) {
        struct stability_case c = row[k];
        if (t->quick && c.dim == 3) c.edge = 9;
        c.group = GROUP_SHEET, c.method = "pd", c.surface = "none", c.horizon = 3.015;
        TRY(stability_cases_give(t, c));
    }
    return OK;
}

/* ---- material points --------------------------------------------------------------------------------------------- */

/* Sets quoted_low and quoted_high of case c to the published range of its stability limit, if there is one. In one
 * dimension ranges are published for whole numbers of points per cell. */
static void quote(struct stability_case *c)
{
    static const struct {
        const char *shape, *transfer;
        double low[3], high[3];
    } sheet[] = {
        {"linear", "flip", {1.03, 1.43, 1.54}, {2.0, 1.73, 1.68}},
        {"gimp", "flip", {2.0, 1.73, 1.68}, {2.5, 1.97, 1.85}},
        {"gimp", "apic", {0.87, 0.80, 0.73}, {0}},
    };
    if (c->dim > 1 || c->cell > 3 || c->cell != (int)c->cell) return;
    for (size_t k = 0; k < COUNT_OF(sheet); k++)
        if (!strcmp(c->shape, sheet[k].shape) && !strcmp(c->transfer, sheet[k].transfer))
            c->quoted_low = sheet[k].low[(int)c->cell - 1], c->quoted_high = sheet[k].high[(int)c->cell - 1];
}

/* Returns the number of positions of the grid relative to the points that are tried with `cell` points per cell and
 * direction. The positions differ by an eighth of a cell, or by a twelfth with 1.5, 3 or 6 points per cell, so that in
 * some of them points are on nodes, the worst case for linear shape functions. t->quick: true for fewer positions; dim:
 * dimension. */
static int offsets_of(const struct taker *t, double cell, int dim)
{
    const bool thirds = cell == 3 || cell == 1.5 || cell == 6;
    if (t->quick) return thirds ? 6 : dim == 1 ? 8 : 4;
    return thirds ? 12 : 8;
}

static status stability_cases_points(const struct taker *t)
{
    static const char *const shape[] = {"linear", "gimp", "cpgimp", "quadratic", "cubic"};
    static const double cell[] = {2, 1, 3, 4, 1.5, 6};
    for (int dim = 1; dim <= DIM_MAX; dim++)
        for (int a = 0; a < 2; a++)
            for (int k = 0; k < 5; k++) {
                if (dim == 3 && t->quick && (k == 2 || k == 3)) continue;
                for (int n = 0; n < (dim == 3 ? t->quick ? 1 : 3 : t->quick ? (dim == 1 ? 4 : 3) : 6); n++) {
                    struct stability_case c = {.group = GROUP_POINTS,
                                               .dim = dim,
                                               .method = "mpm",
                                               .shape = shape[k],
                                               .transfer = transfer[a],
                                               .cell = cell[n]};
                    c.offsets = dim == 3 && cell[n] < 3 ? 4 : offsets_of(t, cell[n], dim);
                    quote(&c);
                    TRY(stability_cases_give(t, c));
                }
                if (dim != 2 || k == 2) continue;
                TRY(stability_cases_give(t, (struct stability_case){.group = GROUP_POINTS,
                                                                    .dim = 2,
                                                                    .method = "mpm",
                                                                    .shape = shape[k],
                                                                    .transfer = transfer[a],
                                                                    .cell = 2,
                                                                    .space = "plane strain",
                                                                    .poisson = 0.49,
                                                                    .offsets = 4}));
            }
    return OK;
}

/* ---- coupled bodies ---------------------------------------------------------------------------------------------- */

/* Passes to the callback t->take each coupled case in the current frame: bodies of which one half is peridynamic, with
 * all couplings, transfers and cell sizes. Returns the first status that is not OK. */
static status coupled(const struct taker *t)
{
    static const char *const couplings[] = {"partial stress", "handshake", "pm", "pg", "pmg", "pgg"};
    for (int dim = 1; dim <= (t->quick ? 2 : 3); dim++)
        for (int a = 0; a < 2; a++)
            for (int w = 0; w < 6; w++)
                for (double cell = 2; cell >= 1; cell--) {
                    if (t->quick && (cell == 1 || (dim == 2 && w > 1 && w < 4))) continue;
                    TRY(stability_cases_give(t, (struct stability_case){.group = GROUP_COUPLED,
                                                                        .dim = dim,
                                                                        .method = "adaptive",
                                                                        .coupling = couplings[w],
                                                                        .transfer = transfer[a],
                                                                        .cell = cell,
                                                                        .shape = w == 2 || w == 4 ? "linear" : "gimp",
                                                                        .horizon = dim == 3 ? 2.015 : 0,
                                                                        .edge = dim == 3 ? 12 : 0,
                                                                        .offsets = dim == 3 ? 2 : 4}));
                }
    for (int m = 1; m < 3; m++)
        TRY(stability_cases_give(t, (struct stability_case){.group = GROUP_COUPLED,
                                                            .dim = 2,
                                                            .method = "adaptive",
                                                            .model = model[m],
                                                            .coupling = couplings[0],
                                                            .transfer = "flip",
                                                            .offsets = t->quick ? 1 : 4}));
    for (int m = 0; m < 3; m++)
        TRY(stability_cases_give(t, (struct stability_case){.group = GROUP_COUPLED,
                                                            .dim = 2,
                                                            .method = "adaptive",
                                                            .model = model[m],
                                                            .coupling = couplings[0],
                                                            .transfer = "flip",
                                                            .irregularity = 0.5,
                                                            .note = "irregular 0.5"}));
    TRY(stability_cases_give(t, (struct stability_case){.group = GROUP_COUPLED,
                                                        .dim = 2,
                                                        .method = "adaptive",
                                                        .coupling = couplings[0],
                                                        .transfer = "flip",
                                                        .heavier = 8,
                                                        .note = "two materials 8:1"}));
    return stability_cases_give(t, (struct stability_case){.group = GROUP_COUPLED,
                                                           .dim = 2,
                                                           .method = "adaptive",
                                                           .coupling = couplings[0],
                                                           .transfer = "flip",
                                                           .surface = "volume",
                                                           .note = "surface correction"});
}

/* Passes to the callback t->take each coupled case in the reference frame: borders of the peridynamic region inside
 * cells, and scattered peridynamic particles and material points, as conversion can leave them. Returns the first
 * status that is not OK. */
static status stability_cases_reference(const struct taker *t)
{
    static const struct stability_case row[] = {
        {.method = "mpm", .note = "nodes on the border"},
        {.method = "mpm", .note = "border inside cells", .offset = 0.5},
        {.method = "adaptive", .note = "half peridynamic"},
        {.method = "adaptive", .note = "half peridynamic, border inside cells", .offset = 0.5},
        {.method = "adaptive", .note = "points left in bonds", .region = ISLANDS},
        {.method = "adaptive", .note = "bonds among points", .region = SPOTS},
        {.method = "adaptive", .note = "points left in bonds, handshake", .coupling = "handshake", .region = ISLANDS},
    };
    for (int dim = 1; dim <= DIM_MAX; dim++)
        for (size_t k = 0; k < COUNT_OF(row); k++) {
            struct stability_case c = row[k];

            c.group = GROUP_REFERENCE, c.dim = dim, c.frame = "reference";
            if (dim == 3 && k > 3) c.edge = 10;
            TRY(stability_cases_give(t, c));
        }
    return OK;
}

status stability_call_for_all_cases(bool quick, stability_take *callback, void *context)
{
    const struct taker t = {quick, callback, context};
    TRY(stability_cases_published(&t));
    TRY(horizons(&t));
    TRY(variants(&t));
    TRY(stability_cases_points(&t));
    TRY(coupled(&t));
    return stability_cases_reference(&t);
}
