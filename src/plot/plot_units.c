/* Chooses the units in which pictures show values. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "plot/plot.h"

/* src/python/cleave/_fields.py has the same table; test_python compares them. */
const struct unit unit_prefix[UNIT_PREFIXES] = {
    {1e24, "Y"},  {1e21, "Z"},  {1e18, "E"},  {1e15, "P"},  {1e12, "T"},  {1e9, "G"},
    {1e6, "M"},   {1e3, "k"},   {1, ""},      {1e-3, "m"},  {1e-6, "µ"},  {1e-9, "n"},
    {1e-12, "p"}, {1e-15, "f"}, {1e-18, "a"}, {1e-21, "z"}, {1e-24, "y"},
};

struct unit unit_with_si_prefix_for_largest_value(double largest_value, const char *unit_name)
{
    const double size = fabs(largest_value);
    const bool zero = !(size >= unit_prefix[UNIT_PREFIXES - 1].factor * 0.9995) || !isfinite(size);
    struct unit u = {1, ""};
    int k = 0;
    while (!zero && size < unit_prefix[k].factor * 0.9995) k++;
    if (!zero) u.factor = unit_prefix[k].factor;
    snprintf(u.name, sizeof u.name, "%s%s", zero ? "" : unit_prefix[k].name, unit_name);
    return u;
}

struct unit unit_for_length(double largest_length)
{
    if (largest_length >= 999.5 && isfinite(largest_length)) return (struct unit){1e3, "km"};
    return largest_length > 5e-4 && largest_length < 0.9995
               ? (struct unit){1e-3, "mm"}
               : unit_with_si_prefix_for_largest_value(largest_length, "m");
}

struct unit unit_for_area(double largest_area)
{
    if (!(largest_area > 0) || !isfinite(largest_area)) return (struct unit){1, "m²"};
    if (largest_area < 1e-14) return (struct unit){1e-18, "nm²"};
    if (largest_area < 1e-8) return (struct unit){1e-12, "µm²"};
    if (largest_area < 0.1) return (struct unit){1e-6, "mm²"};
    return largest_area < 1e5 ? (struct unit){1, "m²"} : (struct unit){1e6, "km²"};
}

struct unit unit_with_si_prefix_if_unit_allows_it(const char *unit_name, double largest_value)
{
    static const char *const prefixed[] = {"s", "m/s", "N", "J", "Pa", "W", "J/m²", "J/m³", "Pa√m"};
    struct unit u = {1, ""};
    snprintf(u.name, sizeof u.name, "%s", unit_name);
    if (strcmp(unit_name, "m") == 0) return unit_for_length(largest_value);
    if (strcmp(unit_name, "m^2") == 0) return unit_for_area(largest_value);
    for (size_t k = 0; k < COUNT_OF(prefixed); k++)
        if (strcmp(unit_name, prefixed[k]) == 0) return unit_with_si_prefix_for_largest_value(largest_value, unit_name);
    return u;
}
