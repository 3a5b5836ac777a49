/* The methods of `cleave bench accuracy`: names, and the scene keys that make them. */
#include <string.h>

#include "accuracy.h"

#define PD(...) {{"method", "pd"}, __VA_ARGS__}
#define MPM(...) {{"method", "mpm"}, __VA_ARGS__}
#define CURRENT {"mpm.frame", "current"}
#define POINTS(shape, transfer) {{"method", "mpm"}, CURRENT, {"mpm.shape", shape}, {"mpm.transfer", transfer}}
#define COUPLED(coupling) {{"method", "adaptive"}, CURRENT, {"coupling", coupling}}
#define LEVELS(n) {"mpm.frame", "reference"}, {"mpm.levels", n}
#define REFERENCE LEVELS("0")
#define UNIFORM {"pd.weights", "uniform"}

/* Colours by family: blue bonds, green states, orange and red material points, black reference, purple coupled, dark
 * red, violet and teal adaptive. */
const struct accuracy_method accuracy_method[] = {
    {"pd bond", ACCURACY_BONDS, true, "#0072b2", 7, {{"method", "pd"}}},
    {"pd bond uniform", ACCURACY_BONDS, false, "#0072b2", 6, PD(UNIFORM)},
    {"pd bond vmpd", ACCURACY_BONDS, false, "#56b4e9", 5, PD({"pd.calibration", "vmpd"}, {"pd.surface", "none"})},
    {"pd ospd", ACCURACY_STATES, true, "#009e73", 9, PD({"model", "ospd"})},
    {"pd mospd", ACCURACY_STATES, true, "#009e73", 8, PD({"model", "mospd"})},
    {"mpm linear flip", ACCURACY_POINTS, false, "#e69f00", 5, POINTS("linear", "flip")},
    {"mpm gimp flip", ACCURACY_POINTS, true, "#d55e00", 7, POINTS("gimp", "flip")},
    {"mpm gimp apic", ACCURACY_POINTS, true, "#d55e00", 6, POINTS("gimp", "apic")},
    {"mpm quadratic flip", ACCURACY_POINTS, false, "#e69f00", 9, POINTS("quadratic", "flip")},
    {"mpm quadratic apic", ACCURACY_POINTS, false, "#e69f00", 8, POINTS("quadratic", "apic")},
    {"mpm cubic flip", ACCURACY_POINTS, false, "#a0522d", 11, POINTS("cubic", "flip")},
    {"mpm cubic apic", ACCURACY_POINTS, true, "#a0522d", 10, POINTS("cubic", "apic")},
    {"mpm reference", ACCURACY_REFERENCE, true, "#111111", 7, MPM(REFERENCE)},
    {"mpm reference small", ACCURACY_REFERENCE, false, "#111111", 6, MPM(REFERENCE, {"mpm.strain", "small"})},
    {"mpm levels 1", ACCURACY_REFERENCE, true, "#888888", 7, MPM(LEVELS("1"))},
    {"mpm levels 2", ACCURACY_REFERENCE, true, "#888888", 6, MPM(LEVELS("2"))},
    {"coupled partial stress", ACCURACY_COUPLED, true, "#cc79a7", 7, COUPLED("partial stress")},
    {"coupled reference", ACCURACY_COUPLED, true, "#7b3294", 5, {{"method", "adaptive"}, REFERENCE}},
    {"coupled reference uniform",
     ACCURACY_COUPLED,
     true,
     "#7b3294",
     4,
     {{"method", "adaptive"}, REFERENCE, UNIFORM}},
    {"coupled handshake", ACCURACY_COUPLED, false, "#cc79a7", 6, COUPLED("handshake")},
    {"coupled pm", ACCURACY_COUPLED, false, "#9970ab", 9, COUPLED("pm")},
    {"coupled pg", ACCURACY_COUPLED, false, "#9970ab", 8, COUPLED("pg")},
    {"coupled pmg", ACCURACY_COUPLED, false, "#9970ab", 11, COUPLED("pmg")},
    {"coupled pgg", ACCURACY_COUPLED, false, "#9970ab", 10, COUPLED("pgg")},
    {"adaptive partial stress", ACCURACY_ADAPTIVE, true, "#c51b7d", 13, COUPLED("partial stress")},
    {"adaptive reference", ACCURACY_ADAPTIVE, true, "#40004b", 13, {{"method", "adaptive"}, REFERENCE}},
    {"adaptive reference uniform",
     ACCURACY_ADAPTIVE,
     true,
     "#40004b",
     12,
     {{"method", "adaptive"}, REFERENCE, UNIFORM}},
    {"adaptive levels 1", ACCURACY_ADAPTIVE, true, "#e7298a", 11, {{"method", "adaptive"}, LEVELS("1")}},
    {"adaptive levels 2", ACCURACY_ADAPTIVE, true, "#e7298a", 9, {{"method", "adaptive"}, LEVELS("2")}},
    {"adaptive levels 2 uniform",
     ACCURACY_ADAPTIVE,
     true,
     "#e7298a",
     8,
     {{"method", "adaptive"}, LEVELS("2"), UNIFORM}},
    {"adaptive handshake", ACCURACY_ADAPTIVE, false, "#c51b7d", 12, COUPLED("handshake")},
    {"adaptive pm", ACCURACY_ADAPTIVE, false, "#35978f", 9, COUPLED("pm")},
    {"adaptive pg", ACCURACY_ADAPTIVE, false, "#35978f", 8, COUPLED("pg")},
    {"adaptive pmg", ACCURACY_ADAPTIVE, false, "#35978f", 11, COUPLED("pmg")},
    {"adaptive pgg", ACCURACY_ADAPTIVE, false, "#35978f", 10, COUPLED("pgg")},
};
const int accuracy_methods = COUNT_OF(accuracy_method);

static bool sets(const struct accuracy_method *m, const char *key, const char *value)
{
    for (int k = 0; k < ACCURACY_SETTINGS && m->set[k].key; k++)
        if (strcmp(m->set[k].key, key) == 0 && strcmp(m->set[k].value, value) == 0) return true;
    return false;
}

bool accuracy_is_reference(const struct accuracy_point *p) { return sets(p->method, "mpm.frame", "reference"); }

bool accuracy_is_coarse(const struct accuracy_method *method)
{
    return sets(method, "mpm.levels", "1") || sets(method, "mpm.levels", "2");
}

const char *accuracy_solver(const struct accuracy_point *p)
{
    return accuracy_is_reference(p) ? "explicit" : p->method->family & ACCURACY_PD ? "cg" : "relaxation";
}

/* With flip they creep, and linear shapes, which couplings pm and pmg take, know no apic. */
bool accuracy_relaxes(const struct accuracy_point *p)
{
    return !sets(p->method, "mpm.transfer", "flip") && !sets(p->method, "coupling", "pm") &&
           !sets(p->method, "coupling", "pmg");
}
