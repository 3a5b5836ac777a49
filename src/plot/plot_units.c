/* Chooses the units in which pictures show values. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "plot/plot.h"

struct unit unit_for_largest_value(double largest_value, const char *unit_name)
{
    static const struct {
        double factor;
        const char *prefix;
    } si[] = {{1e9, "G"}, {1e6, "M"}, {1e3, "k"}, {1, ""}, {1e-3, "m"}, {1e-6, "µ"}, {1e-9, "n"}, {1e-12, "p"}};
    struct unit u = {1, ""};
    int k = 0;
    while (k + 1 < (int)COUNT_OF(si) && fabs(largest_value) < si[k].factor * 0.9995) k++;
    if (!(fabs(largest_value) > 1e-15)) k = 3; /* zero or not finite: no prefix */
    u.factor = si[k].factor;
    snprintf(u.name, sizeof u.name, "%s%s", si[k].prefix, unit_name);
    return u;
}

struct unit unit_for_length(double largest_length)
{
    return largest_length > 5e-4 && largest_length < 0.9995 ? (struct unit){1e-3, "mm"}
                                                            : unit_for_largest_value(largest_length, "m");
}

struct unit unit_for_area(double largest_area)
{
    if (!(largest_area > 0) || !isfinite(largest_area)) return (struct unit){1, "m²"};
    if (largest_area < 1e-14) return (struct unit){1e-18, "nm²"};
    if (largest_area < 1e-8) return (struct unit){1e-12, "µm²"};
    if (largest_area < 0.1) return (struct unit){1e-6, "mm²"};
    return largest_area < 1e5 ? (struct unit){1, "m²"} : (struct unit){1e6, "km²"};
}

struct unit unit_for_largest_value_if_prefixable(const char *unit_name, double largest_value)
{
    static const char *const prefixed[] = {"s", "m/s", "N", "J", "Pa", "W"};
    struct unit u = {1, ""};
    snprintf(u.name, sizeof u.name, "%s", unit_name);
    if (strcmp(unit_name, "m") == 0) return unit_for_length(largest_value);
    if (strcmp(unit_name, "m^2") == 0) return unit_for_area(largest_value);
    for (size_t k = 0; k < COUNT_OF(prefixed); k++)
        if (strcmp(unit_name, prefixed[k]) == 0) return unit_for_largest_value(largest_value, unit_name);
    return u;
}
