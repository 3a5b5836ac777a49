/* Chooses the units in which pictures show values. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "plot/plot.h"

/* SI prefixes with their factors, from yotta to yocto. src/python/cleave/_fields.py has a copy of the table, which
 * test_python compares. */
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

/* Writes the unit `unit_name` of a file, such as J/m^2, to text[capacity] as pictures show it: J/m². A longer text is
 * cut off. */
static void unit_name_write_for_picture(char *text, size_t capacity, const char *unit_name)
{
    static const char *const sign[][2] = {{" m^(1/2)", "√m"}, {" m^0.5", "√m"}, {"^2", "²"}, {"^3", "³"}};
    size_t used = 0;
    *text = '\0';
    while (*unit_name && used + 1 < capacity) {
        size_t k = 0;
        while (k < COUNT_OF(sign) && strncmp(unit_name, sign[k][0], strlen(sign[k][0])) != 0) k++;
        const bool found = k < COUNT_OF(sign);
        used += (size_t)snprintf(text + used, capacity - used, "%.*s", found ? 4 : 1, found ? sign[k][1] : unit_name);
        unit_name += found ? strlen(sign[k][0]) : 1;
    }
}

struct unit unit_with_si_prefix_if_unit_allows_it(const char *unit_name, double largest_value)
{
    static const char *const prefixed[] = {"s", "m/s", "N", "N/m", "J", "Pa", "W", "J/m²", "J/m³", "Pa√m"};
    struct unit u = {1, ""};
    if (strcmp(unit_name, "degree") == 0) return (struct unit){1, "°"};
    unit_name_write_for_picture(u.name, sizeof u.name, unit_name);
    if (strcmp(u.name, "m") == 0) return unit_for_length(largest_value);
    if (strcmp(u.name, "m²") == 0) return unit_for_area(largest_value);
    for (size_t k = 0; k < COUNT_OF(prefixed); k++)
        if (strcmp(u.name, prefixed[k]) == 0) return unit_with_si_prefix_for_largest_value(largest_value, prefixed[k]);
    return u;
}
