/* Composes labels of values and results in pictures of a study such that they are short and distinct. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "plot/gnuplot.h"
#include "study_internal.h"

/* VALUE_SHOWN: longest value that a label shows in full; CUT_SHOWN: number of characters shown of a value that is cut
 * to fit; LEFT_OUT_LEAST: least number of common characters that labels omit. */
enum { VALUE_SHOWN = LABEL_ROOM - 8, CUT_SHOWN = 20, LEFT_OUT_LEAST = 4 };

/* Computes how many characters all values of a varied key (key of the input file that a study varies) have in common
 * at their beginning (*begin) and at their end (*end), so that labels can omit them. Common characters are counted
 * only up to a blank, comma, colon or bracket, so that no number is cut in two. A count below LEFT_OUT_LEAST becomes
 * 0. */
static void values_common(const struct varied_key *key, size_t *begin, size_t *end)
{
    const char *first = key->value[0];
    *begin = *end = strlen(first);
    for (int v = 1; v < key->values; v++) {
        const char *other = key->value[v];
        const size_t n = strlen(first), m = strlen(other);
        size_t same = 0, tail = 0;
        while (same < *begin && same < m && first[same] == other[same]) same++;
        while (tail < *end && tail < m && first[n - 1 - tail] == other[m - 1 - tail]) tail++;
        *begin = same, *end = tail;
    }
    const char *separators = " ,:[]{}";
    while (*begin > 0 && !strchr(separators, first[*begin - 1])) --*begin;
    while (*end > 0 && !strchr(separators, first[strlen(first) - *end])) --*end;
    if (*begin < LEFT_OUT_LEAST) *begin = 0;
    if (*end < LEFT_OUT_LEAST) *end = 0;
}

/* Reduces the numbers of characters that labels omit at the beginning (*begin) and end (*end) of values, as long as the
 * labels still fit into VALUE_SHOWN characters. longest: length of the longest value. */
static void common_keep(size_t *begin, size_t *end, size_t longest)
{
    const size_t wanted = longest - *begin - *end + 4;
    if (wanted >= VALUE_SHOWN) return;
    const size_t spare = VALUE_SHOWN - wanted, before = *begin < spare / 2 ? *begin : spare / 2;
    *begin -= before;
    *end -= *end < spare - before ? *end : spare - before;
}

void varied_key_compose_label_of_value(char *text, const struct varied_key *key, int value_index)
{
    size_t longest = 0, begin, end;
    for (int k = 0; k < key->values; k++) longest = strlen(key->value[k]) > longest ? strlen(key->value[k]) : longest;
    if (longest <= VALUE_SHOWN) {
        snprintf(text, LABEL_ROOM, "%s", key->value[value_index]);
        return;
    }
    values_common(key, &begin, &end);
    const size_t own = strlen(key->value[value_index]);
    if (begin + end >= own) begin = end = 0;
    common_keep(&begin, &end, longest);
    const size_t left = own - begin - end;
    if (longest - begin - end + 4 <= VALUE_SHOWN)
        snprintf(text, LABEL_ROOM, "%s%.*s%s", begin > 0 ? ".." : "", (int)left, key->value[value_index] + begin,
                 end > 0 ? ".." : "");
    else
        snprintf(text, LABEL_ROOM, "%d: %.*s..", value_index + 1, CUT_SHOWN, key->value[value_index] + begin);
}

int varied_key_longest_value_label_length(const struct varied_key *key)
{
    int longest = 0;
    for (int v = 0; v < key->values; v++) {
        char text[LABEL_ROOM];
        varied_key_compose_label_of_value(text, key, v);
        longest = (int)strlen(text) > longest ? (int)strlen(text) : longest;
    }
    return longest;
}

void study_panel_compose_title(char *text, size_t capacity, const char *result_name, const char *unit)
{
    static const char of_probe[] = "probes.", degrees[] = "_deg", seconds[] = "_seconds";
    char words[LABEL_ROOM + 216];
    if (strncmp(result_name, of_probe, sizeof of_probe - 1) == 0) result_name += sizeof of_probe - 1;
    const char *dot = strrchr(result_name, '.'), *last = dot ? dot + 1 : result_name;
    snprintf(words, sizeof words, "%.*s%s%.100s", dot ? (int)fmin((double)(dot - result_name), 100) : 0, result_name,
             dot ? ": " : "", last);
    const size_t length = strlen(words), begin = dot ? length - strnlen(last, 100) : 0;
    if (length - begin > strlen(degrees) && strcmp(words + length - strlen(degrees), degrees) == 0)
        words[length - strlen(degrees)] = '\0';
    else if (length - begin > strlen(seconds) && strcmp(words + length - strlen(seconds), seconds) == 0)
        strcpy(words + length - strlen(seconds), " time");
    for (char *c = words + begin; *c; c++)
        if (*c == '_') *c = ' ';
    snprintf(text, capacity, *unit ? "%s [%s]" : "%s%s", words, unit);
}

int study_picture_character_width_in_pixels(void) { return picture_size_is_too_narrow_for_side_legend() ? 7 : 9; }

double axis_tick_distance(double range, int max_intervals)
{
    static const double lead[] = {1, 2, 5, 10};
    const double decade = pow(10, floor(log10(range / max_intervals)));
    size_t k = 0;
    while (k + 1 < COUNT_OF(lead) && range / (lead[k] * decade) > max_intervals) k++;
    return lead[k] * decade;
}

void study_picture_compose_file_name(char *name, const char *key)
{
    snprintf(name, PICTURE_NAME_ROOM, "%.*s.%s", CASE_NAME_ROOM, key,
             picture_ending[picture_size_get_process_wide().format]);
    for (char *c = name; *c; c++)
        if (*c == '/') *c = '_';
}

bool varied_key_values_are_numbers_of_one_unit(const struct varied_key *key, const char **unit)
{
    for (int v = 0; v < key->values; v++) {
        const char *own;
        if (isnan(value_text_split_number_and_unit(key->value[v], &own)) || (v > 0 && strcmp(own, *unit) != 0))
            return false;
        *unit = own;
    }
    return true;
}
