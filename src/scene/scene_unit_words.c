/* Explains names of units that scenes do not have, from other systems of units or spellings, for messages. */
#include <string.h>

#include "scene_internal.h"

/* Table of names of units that scenes do not have. word: the name, also recognised with a plural s; meant: the unit to
 * write instead, as text of a message. */
static const struct {
    const char *word, *meant;
} unit_words[] = {
    {"sec", "s?"},
    {"second", "s?"},
    {"msec", "ms?"},
    {"millisecond", "ms?"},
    {"usec", "us?"},
    {"microsec", "us?"},
    {"microsecond", "us?"},
    {"nsec", "ns?"},
    {"minute", "min?"},
    {"hour", "h?"},
    {"hr", "h?"},
    {"meter", "m?"},
    {"metre", "m?"},
    {"micron", "um?"},
    {"in", "1 in is 25.4 mm"},
    {"inch", "1 inch is 25.4 mm"},
    {"ft", "1 ft is 304.8 mm"},
    {"psi", "1 psi is 6.895e3 Pa"},
    {"ksi", "1 ksi is 6.895e6 Pa"},
    {"Mpsi", "1 Mpsi is 6.895e9 Pa"},
    {"bar", "1 bar is 1e5 Pa"},
    {"atm", "1 atm is 101325 Pa"},
    {"kgf", "1 kgf is 9.80665 N"},
    {"lbf", "1 lbf is 4.448 N"},
    {"lb", "1 lb is 0.4536 kg"},
    {"t", "1 t is 1e3 kg"},
    {"tonne", "1 t is 1e3 kg"},
    {"g/cc", "g/cm^3?"},
    {"kg/cum", "kg/m^3?"},
    {"erg", "1 erg is 1e-7 J"},
    {"fps", "1 ft/s is 0.3048 m/s"},
    {"mph", "1 mph is 0.447 m/s"},
    {"km/h", "1 km/h is 0.2778 m/s"},
};

const char *unknown_unit_name_suggest_known_unit(const char *unknown_name)
{
    for (size_t k = 0; k < COUNT_OF(unit_words); k++) {
        const size_t length = strlen(unit_words[k].word);
        if (strncmp(unknown_name, unit_words[k].word, length) != 0) continue;
        if (!unknown_name[length] || !strcmp(unknown_name + length, "s")) return unit_words[k].meant;
    }
    return NULL;
}

const char *unit_text_remove_kelvin(const char *text, enum unit kind_of_unit, char *shortened, size_t capacity)
{
    const size_t length = strlen(text);
    const char *bracket = strstr(text, "/(");
    if (kind_of_unit == UNIT_TEMPERATURE) return strcmp(text, "K") == 0 ? "" : text;
    if (kind_of_unit != UNIT_SPECIFIC_HEAT || length >= capacity) return text;
    if (length > 2 && strcmp(text + length - 2, "/K") == 0)
        return snprintf(shortened, capacity, "%.*s", (int)length - 2, text), shortened;
    if (!bracket || length < 6 || (strcmp(text + length - 3, " K)") != 0 && strcmp(text + length - 3, "*K)") != 0))
        return text;
    snprintf(shortened, capacity, "%.*s%.*s", (int)(bracket - text) + 1, text,
             (int)length - 3 - (int)(bracket + 2 - text), bracket + 2);
    return shortened;
}
