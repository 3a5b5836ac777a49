/* Methods of `cleave bench accuracy`: names, and the scene keys that select them. */
#include <string.h>

#include "accuracy.h"

#define PD(...)                                                                                                        \
    {                                                                                                                  \
        {"method", "pd"}, __VA_ARGS__                                                                                  \
    }
#define MPM(...)                                                                                                       \
    {                                                                                                                  \
        {"method", "mpm"}, __VA_ARGS__                                                                                 \
    }
#define CURRENT                                                                                                        \
    {                                                                                                                  \
        "mpm.frame", "current"                                                                                         \
    }
#define POINTS(shape, transfer)                                                                                        \
    {                                                                                                                  \
        {"method", "mpm"}, CURRENT, {"mpm.shape", shape}, { "mpm.transfer", transfer }                                 \
    }
#define COUPLED(coupling)                                                                                              \
    {                                                                                                                  \
        {"method", "adaptive"}, CURRENT, { "coupling", coupling }                                                      \
    }
#define LEVELS(n)                                                                                                      \
    {"mpm.frame", "reference"}, { "mpm.levels", n }
#define REFERENCE LEVELS("0")
#define UNIFORM                                                                                                        \
    {                                                                                                                  \
        "pd.weights", "uniform"                                                                                        \
    }

const struct accuracy_method accuracy_method[] = {
    {"pd bond", ACCURACY_BONDS, true, {{"method", "pd"}}},
    {"pd bond uniform", ACCURACY_BONDS, false, PD(UNIFORM)},
    {"pd bond vmpd", ACCURACY_BONDS, false, PD({"pd.calibration", "vmpd"}, {"pd.surface", "none"})},
    {"pd ospd", ACCURACY_STATES, true, PD({"model", "ospd"})},
    {"pd mospd", ACCURACY_STATES, true, PD({"model", "mospd"})},
    {"mpm linear flip", ACCURACY_POINTS, false, POINTS("linear", "flip")},
    {"mpm gimp flip", ACCURACY_POINTS, true, POINTS("gimp", "flip")},
    {"mpm gimp apic", ACCURACY_POINTS, true, POINTS("gimp", "apic")},
    {"mpm quadratic flip", ACCURACY_POINTS, false, POINTS("quadratic", "flip")},
    {"mpm quadratic apic", ACCURACY_POINTS, false, POINTS("quadratic", "apic")},
    {"mpm cubic flip", ACCURACY_POINTS, false, POINTS("cubic", "flip")},
    {"mpm cubic apic", ACCURACY_POINTS, true, POINTS("cubic", "apic")},
    {"mpm reference", ACCURACY_REFERENCE, true, MPM(REFERENCE)},
    {"mpm reference small", ACCURACY_REFERENCE, false, MPM(REFERENCE, {"mpm.strain", "small"})},
    {"mpm levels 1", ACCURACY_REFERENCE, true, MPM(LEVELS("1"))},
    {"mpm levels 2", ACCURACY_REFERENCE, true, MPM(LEVELS("2"))},
    {"coupled partial stress", ACCURACY_COUPLED, true, COUPLED("partial stress")},
    {"coupled reference", ACCURACY_COUPLED, true, {{"method", "adaptive"}, REFERENCE}},
    {"coupled reference uniform", ACCURACY_COUPLED, true, {{"method", "adaptive"}, REFERENCE, UNIFORM}},
    {"coupled handshake", ACCURACY_COUPLED, false, COUPLED("handshake")},
    {"coupled pm", ACCURACY_COUPLED, false, COUPLED("pm")},
    {"coupled pg", ACCURACY_COUPLED, false, COUPLED("pg")},
    {"coupled pmg", ACCURACY_COUPLED, false, COUPLED("pmg")},
    {"coupled pgg", ACCURACY_COUPLED, false, COUPLED("pgg")},
    {"adaptive partial stress", ACCURACY_ADAPTIVE, true, COUPLED("partial stress")},
    {"adaptive reference", ACCURACY_ADAPTIVE, true, {{"method", "adaptive"}, REFERENCE}},
    {"adaptive reference uniform", ACCURACY_ADAPTIVE, true, {{"method", "adaptive"}, REFERENCE, UNIFORM}},
    {"adaptive levels 1", ACCURACY_ADAPTIVE, true, {{"method", "adaptive"}, LEVELS("1")}},
    {"adaptive levels 2", ACCURACY_ADAPTIVE, true, {{"method", "adaptive"}, LEVELS("2")}},
    {"adaptive levels 2 uniform", ACCURACY_ADAPTIVE, true, {{"method", "adaptive"}, LEVELS("2"), UNIFORM}},
    {"adaptive handshake", ACCURACY_ADAPTIVE, false, COUPLED("handshake")},
    {"adaptive pm", ACCURACY_ADAPTIVE, false, COUPLED("pm")},
    {"adaptive pg", ACCURACY_ADAPTIVE, false, COUPLED("pg")},
    {"adaptive pmg", ACCURACY_ADAPTIVE, false, COUPLED("pmg")},
    {"adaptive pgg", ACCURACY_ADAPTIVE, false, COUPLED("pgg")},
};
const int accuracy_methods = COUNT_OF(accuracy_method);

static bool sets(const struct accuracy_method *m, const char *key, const char *value)
{
    for (int k = 0; k < ACCURACY_SETTINGS && m->set[k].key; k++)
        if (strcmp(m->set[k].key, key) == 0 && strcmp(m->set[k].value, value) == 0) return true;
    return false;
}

bool accuracy_point_uses_reference_frame(const struct accuracy_point *point)
{
    return sets(point->method, "mpm.frame", "reference");
}

bool accuracy_method_has_coarse_cells(const struct accuracy_method *method)
{
    return sets(method, "mpm.levels", "1") || sets(method, "mpm.levels", "2");
}

const char *accuracy_solver_of_point(const struct accuracy_point *point)
{
    return accuracy_point_uses_reference_frame(point) ? "explicit"
           : point->method->family & ACCURACY_PD      ? "cg"
                                                      : "relaxation";
}

/* Returns true if the method of `point` can be used with relaxation. With the transfer flip relaxation converges too
 * slowly. The couplings pm and pmg have linear shape functions, for which the transfer apic does not exist. */
bool accuracy_point_can_use_relaxation(const struct accuracy_point *point)
{
    return !sets(point->method, "mpm.transfer", "flip") && !sets(point->method, "coupling", "pm") &&
           !sets(point->method, "coupling", "pmg");
}
