/* Cases of the long map: couplings, shapes of the peridynamic region, supports, models and Poisson's ratios. */
#include <stdio.h>
#include <string.h>

#include "energy_drift.h"

const char *const drift_group_name[LASTING_GROUP] = {
    [LASTING_NAMED] = "scenes that grew once",           [LASTING_BODIES] = "one method",
    [LASTING_REFERENCE] = "coupled, reference frame",    [LASTING_CURRENT] = "coupled, current frame",
    [LASTING_POINTS] = "material points, current frame", [LASTING_SUPPORTS] = "supports",
    [LASTING_PUBLISHED] = "couplings by others"};

/* Receiver of cases: each case is passed to take(context, case). quick: true to pass only every QUICK_EACH-th case
 * of a group; given: number of cases of the group so far. */
struct taker {
    bool quick;
    int given;
    drift_take *take;
    void *context;
};
enum { QUICK_EACH = 4 }; /* stride of the cases of --quick */

static status energy_drift_cases_give(struct taker *t, enum drift_group group, struct stability_case c)
{
    if (t->quick && t->given++ % QUICK_EACH) return OK;
    return t->take(t->context, &(struct drift_case){.group = group, .c = c});
}

/* ---- laws -------------------------------------------------------------------------------------------------------- */

#define NONE 1e-9 /* 0 would select the value of the scene */
/* clang-format off */
static const struct { const char *model, *space; double poisson; } laws[] = {
    {"bond", NULL, 0},         {"bond", "plane strain", 0}, {"ospd", NULL, NONE},
    {"ospd", NULL, 0.2},       {"ospd", NULL, 0.25},        {"ospd", NULL, 1.0 / 3},
    {"ospd", NULL, 0.45},      {"ospd", "plane strain", 0.35}, {"ospd", "plane strain", 0.49},
    {"mospd", NULL, NONE},     {"mospd", NULL, 0.2},        {"mospd", NULL, 0.25},
    {"mospd", NULL, 1.0 / 3},  {"mospd", NULL, 0.45},       {"mospd", "plane strain", 0.35},
    {"mospd", "plane strain", 0.49}};
/* clang-format on */
enum { LAWS = COUNT_OF(laws) };

static struct stability_case with_law(struct stability_case c, int l)
{
    c.model = laws[l].model, c.space = laws[l].space, c.poisson = laws[l].poisson;
    return c;
}

static const char *const model[] = {"bond", "ospd", "mospd"};
enum { MODELS = COUNT_OF(model) };
static struct stability_case with_model(struct stability_case c, int m)
{
    c.model = model[m], c.poisson = m > 0 ? 0.3 : 0;
    return c;
}

static const char *const coupling[] = {"partial stress", "handshake"};
static const enum stability_region region[] = {HALF, SQUARE, DISC, CORNER, NOTCH};

/* ---- groups ------------------------------------------------------------------------------------------------------ */

/* Passes to the callback t->take each case of bodies with one method: with bonds only, for all laws and models, and
 * with cells of the reference frame only, for several Poisson's ratios. Returns the first status that is not OK. */
static status bodies(struct taker *t)
{
    const struct stability_case plate = {.dim = 2, .edge = 14, .method = "pd"},
                                cells = {.dim = 2, .edge = 14, .method = "mpm", .frame = "reference"};
    for (int l = 0; l < LAWS; l++) TRY(energy_drift_cases_give(t, LASTING_BODIES, with_law(plate, l)));
    for (int m = 0; m < MODELS; m++) {
        struct stability_case c = with_model(plate, m);
        c.irregularity = 0.5, c.region = NOTCH;
        TRY(energy_drift_cases_give(t, LASTING_BODIES, c));
        c = with_model((struct stability_case){.dim = 3, .edge = 6, .method = "pd", .horizon = 2.015}, m);
        TRY(energy_drift_cases_give(t, LASTING_BODIES, c));
    }
    TRY(energy_drift_cases_give(t, LASTING_BODIES, (struct stability_case){.dim = 1, .edge = 64, .method = "pd"}));
    for (int l = 2; l < 9; l++) { /* Poisson's ratios of ospd */
        struct stability_case c = with_law(cells, l);
        c.model = NULL;
        TRY(energy_drift_cases_give(t, LASTING_BODIES, c));
    }
    TRY(energy_drift_cases_give(
        t, LASTING_BODIES,
        (struct stability_case){.dim = 3, .edge = 6, .method = "mpm", .frame = "reference", .poisson = 0.45}));
    return OK;
}

/* Passes to the callback t->take each coupled case in the reference frame: every law with every shape of the
 * peridynamic region, every second of these also with the handshake coupling, and variants of weights, constants and
 * strains. Returns the first status that is not OK. */
static status energy_drift_cases_reference(struct taker *t)
{
    for (int l = 0; l < LAWS; l++)
        for (size_t r = 0; r < COUNT_OF(region); r++)
            for (int k = 0; k < 2; k++) {
                struct stability_case c = {.dim = 2,
                                           .edge = 16,
                                           .method = "adaptive",
                                           .frame = "reference",
                                           .coupling = coupling[k],
                                           .region = region[r],
                                           .offset = r % 2 ? 0.5 : 0};
                if (k > 0 && (l + (int)r) % 2) continue;
                TRY(energy_drift_cases_give(t, LASTING_REFERENCE, with_law(c, l)));
            }
    for (int m = 0; m < MODELS; m++)
        for (int r = 0; r < 2; r++) {
            const struct stability_case c = {.dim = 3,
                                             .edge = 8,
                                             .method = "adaptive",
                                             .frame = "reference",
                                             .coupling = coupling[0],
                                             .horizon = 2.015,
                                             .region = r ? CORNER : HALF};
            TRY(energy_drift_cases_give(t, LASTING_REFERENCE, with_model(c, m)));
        }
    static const struct stability_case variant[] = {{.weights = "isotropic", .horizon = 2.015},
                                                    {.constants = "lattice"},
                                                    {.strain = "small"},
                                                    {.calibration = "continuum"},
                                                    {.surface = "volume"}};
    for (size_t v = 0; v < COUNT_OF(variant); v++) {
        struct stability_case c = variant[v];
        c.dim = 2, c.edge = 16, c.method = "adaptive", c.frame = "reference", c.coupling = coupling[0],
        c.model = "bond", c.region = DISC;
        TRY(energy_drift_cases_give(t, LASTING_REFERENCE, c));
    }
    return energy_drift_cases_give(t, LASTING_REFERENCE,
                                   (struct stability_case){.dim = 1,
                                                           .edge = 64,
                                                           .method = "adaptive",
                                                           .frame = "reference",
                                                           .coupling = coupling[0],
                                                           .model = "bond"});
}

static const char *const transfer[] = {"flip", "apic"};
static const char *const shape[] = {"gimp", "linear", "cpgimp", "quadratic", "cubic"};

static status current(struct taker *t)
{
    static const int law[] = {0, 1, 3, 6, 8, 10, 13, 15};
    for (int q = 0; q < 2; q++)
        for (int m = 0; m < MODELS; m++) {
            const struct stability_case c = {.dim = 2,
                                             .edge = 16,
                                             .method = "adaptive",
                                             .frame = "current",
                                             .transfer = transfer[q],
                                             .shape = "gimp",
                                             .coupling = coupling[0],
                                             .region = SQUARE,
                                             .irregularity = 0.8};
            TRY(energy_drift_cases_give(t, LASTING_CURRENT, with_model(c, m)));
        }
    for (int q = 0; q < 2; q++)
        for (size_t l = 0; l < COUNT_OF(law); l++)
            for (size_t r = 0; r < COUNT_OF(region); r++) {
                struct stability_case c = {.dim = 2,
                                           .edge = 16,
                                           .method = "adaptive",
                                           .frame = "current",
                                           .transfer = transfer[q],
                                           .shape = "gimp",
                                           .coupling = coupling[r % 2 && l < 2],
                                           .region = region[r],
                                           .offset = r % 2 ? 0.25 : 0};
                TRY(energy_drift_cases_give(t, LASTING_CURRENT, with_law(c, law[l])));
            }
    for (int q = 0; q < 2; q++)
        for (size_t k = 0; k < COUNT_OF(shape); k++) {
            const struct stability_case c = {.dim = 2,
                                             .edge = 16,
                                             .method = "adaptive",
                                             .frame = "current",
                                             .transfer = transfer[q],
                                             .shape = shape[k],
                                             .coupling = coupling[0],
                                             .region = SQUARE,
                                             .model = "bond"};
            if (!strcmp(shape[k], "linear") && q == 1) continue; /* refused by the scene reader */
            TRY(energy_drift_cases_give(t, LASTING_CURRENT, c));
        }
    for (int q = 0; q < 2; q++)
        for (int dim = 1; dim <= DIM_MAX; dim += 2)
            for (int k = 0; k < 2; k++) {
                const struct stability_case c = {.dim = dim,
                                                 .edge = dim == 1 ? 64 : 8,
                                                 .method = "adaptive",
                                                 .frame = "current",
                                                 .transfer = transfer[q],
                                                 .shape = "gimp",
                                                 .coupling = coupling[k],
                                                 .model = "bond",
                                                 .horizon = dim == 3 ? 2.015 : 0};
                TRY(energy_drift_cases_give(t, LASTING_CURRENT, c));
            }
    return OK;
}

static status energy_drift_cases_points(struct taker *t)
{
    static const struct {
        int dim;
        const char *space;
        double poisson;
    } body[] = {{1, NULL, 0},    {2, NULL, NONE}, {2, NULL, 0.3}, {2, "plane strain", 0.45}, {2, "plane strain", 0.49},
                {3, NULL, 0.25}, {3, NULL, 0.45}, {3, NULL, 0.49}};
    for (int q = 0; q < 2; q++)
        for (size_t b = 0; b < COUNT_OF(body); b++)
            for (size_t k = 0; k < COUNT_OF(shape); k++) {
                const struct stability_case c = {.dim = body[b].dim,
                                                 .space = body[b].space,
                                                 .poisson = body[b].poisson,
                                                 .method = "mpm",
                                                 .edge = (const int[]){0, 64, 14, 8}[body[b].dim],
                                                 .frame = "current",
                                                 .transfer = transfer[q],
                                                 .shape = shape[k],
                                                 .offset = b % 2 ? 0.25 : 0};
                if ((!strcmp(shape[k], "linear") && q == 1) || (k > 0 && b % 2 == 0)) continue;
                TRY(energy_drift_cases_give(t, LASTING_POINTS, c));
            }
    return OK;
}

static status supports(struct taker *t)
{
    static const struct stability_case method[] = {
        {.method = "pd"},
        {.method = "adaptive", .frame = "reference", .coupling = "partial stress"},
        {.method = "adaptive", .frame = "current", .transfer = "flip", .shape = "gimp", .coupling = "partial stress"},
        {.method = "adaptive", .frame = "current", .transfer = "apic", .shape = "gimp", .coupling = "partial stress"},
    };
    for (int support = MIRROR; support <= DRIVEN; support++)
        for (size_t k = 0; k < COUNT_OF(method); k++)
            for (int m = 0; m < MODELS; m++) {
                struct stability_case c = with_model(method[k], m);
                c.dim = 2, c.edge = 14, c.support = (enum stability_support)support;
                if (support == DRIVEN && k > 1 && m > 0) continue;
                TRY(energy_drift_cases_give(t, LASTING_SUPPORTS, c));
            }
    for (int m = 0; m < MODELS; m++) {
        const struct stability_case c = {.dim = 3, .edge = 6, .method = "pd", .horizon = 2.015, .support = CLAMP};
        TRY(energy_drift_cases_give(t, LASTING_SUPPORTS, with_model(c, m)));
    }
    return OK;
}

static status energy_drift_cases_published(struct taker *t)
{
    static const char *const by[] = {"pm", "pg", "pmg", "pgg"};
    for (size_t k = 0; k < COUNT_OF(by); k++)
        for (int r = 0; r < 2; r++)
            TRY(energy_drift_cases_give(t, LASTING_PUBLISHED,
                                        (struct stability_case){.dim = 2,
                                                                .edge = 16,
                                                                .method = "adaptive",
                                                                .frame = "current",
                                                                .coupling = by[k],
                                                                .model = "bond",
                                                                .transfer = "flip",
                                                                .region = r ? SQUARE : HALF}));
    return OK;
}

status drift_call_for_all_cases(bool quick, drift_take *callback, void *context)
{
    struct taker t = {quick, 0, callback, context};
    for (int k = 0; k < drift_named_count; k++) TRY(callback(context, &drift_named[k]));
    TRY(bodies(&t));
    TRY(energy_drift_cases_reference(&t));
    TRY(current(&t));
    TRY(energy_drift_cases_points(&t));
    TRY(supports(&t));
    return energy_drift_cases_published(&t);
}

/* ---- names ------------------------------------------------------------------------------------------------------- */

/* Names of the peridynamic regions and supports in labels of cases. */
static const char *const region_name[] = {
    [HALF] = "half",     [STRIP] = "strip", [SQUARE] = "square",   [DISC] = "disc",
    [CORNER] = "corner", [NOTCH] = "notch", [ISLANDS] = "islands", [SPOTS] = "spots"};
static const char *const support_name[] = {[MIRROR] = "mirror",
                                           [MIRROR_ACROSS] = "mirror across",
                                           [MIRRORS] = "two mirrors",
                                           [CLAMP] = "clamp",
                                           [CLAMP_ACROSS] = "clamp across",
                                           [CLAMP_MIRROR] = "clamp and mirror",
                                           [FIXED] = "fixed",
                                           [DRIVEN] = "driven"};

void drift_label(const struct drift_case *drift_case, char *text, size_t capacity)
{
    static const char *const space[] = {"", "line", "plate", "solid"};
    const struct stability_case *c = &drift_case->c;
    if (drift_case->name) {
        snprintf(text, capacity, "%s", drift_case->name);
        return;
    }
    FILE *to = fmemopen(text, capacity, "w");
    const bool coupled = !strcmp(c->method, "adaptive");
    fprintf(to, "%s, %s", c->space ? c->space : space[c->dim],
            !coupled                                ? c->method
            : strcmp(c->coupling, "partial stress") ? c->coupling
                                                    : "partial");
    if (c->model) fprintf(to, ", %s", c->model);
    if (c->poisson != 0) fprintf(to, " nu %.2g", c->poisson < 1e-6 ? 0 : c->poisson);
    if (c->frame && !strcmp(c->frame, "reference")) fputs(", reference", to);
    if (c->transfer) fprintf(to, ", %s", c->transfer);
    if (c->shape) fprintf(to, " %s", c->shape);
    if (coupled || c->region == NOTCH) fprintf(to, ", %s", region_name[c->region]);
    if (c->support != FREE) fprintf(to, ", %s", support_name[c->support]);
    if (c->irregularity > 0) fputs(", irregular", to);
    if (c->weights) fprintf(to, ", %s weights", c->weights);
    if (c->constants) fprintf(to, ", %s constants", c->constants);
    if (c->strain) fprintf(to, ", %s strain", c->strain);
    if (c->calibration) fprintf(to, ", %s", c->calibration);
    if (c->surface) fputs(", surface correction", to);
    fputc('\0', to);
    fclose(to);
    text[capacity - 1] = 0;
}
