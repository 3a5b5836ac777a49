/* Writes the table of keys as a JSON schema (draft 7), with which editors complete and check scenes. The schema
 * refuses unknown keys and words, and numbers out of range; formulas and values of keys that functions read are
 * checked only by the program. */
#include "scene_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- pieces ------------------------------------------------------------------------------------------------------ */

/* Writes the first `length` characters of `text` to `out` as a JSON string, with escapes for quotes and backslashes. */
static void write_string(FILE *out, const char *text, size_t length)
{
    fputc('"', out);
    for (const char *c = text; c < text + length; c++) {
        if (*c == '"' || *c == '\\') fputc('\\', out);
        fputc(*c, out);
    }
    fputc('"', out);
}

/* Writes the words of `words`, a text a|b|c, to `out` as a JSON enumeration. A word of digits is written twice, as a
 * text and as a number, and `true` as a text and as a boolean, since YAML may read either. */
static void write_words(FILE *out, const char *words)
{
    const char *between = "";
    fputs("{\"enum\": [", out);
    for (const char *c = words; *c; c += *c == '|') {
        const size_t length = strcspn(c, "|");
        fputs(between, out);
        write_string(out, c, length);
        if (strspn(c, "0123456789") >= length) fprintf(out, ", %.*s", (int)length, c);
        if (length == 4 && strncmp(c, "true", 4) == 0) fputs(", true", out);
        between = ", ", c += length;
    }
    fputs("]}", out);
}

/* Writes the JSON types of key k (of input files) to `out`: a number of the JSON type `type` ("number" or "integer")
 * within the range of k, or a text, since formulas and numbers with units are texts. */
static void write_numbers(FILE *out, const struct key *k, const char *type)
{
    char least[32], most[32];
    const bool bounded = k->range.given && k->type < KEY_MAP;
    fprintf(out, "{\"type\": \"%s\"", type);
    if (bounded)
        fprintf(out, ", \"%s\": %s", k->range.open ? "exclusiveMinimum" : "minimum",
                number_write_shortest_exact_decimal(least, k->range.least));
    if (k->type == KEY_SEED) fputs(", \"minimum\": 0", out);
    if (bounded && isfinite(k->range.most))
        fprintf(out, ", \"maximum\": %s", number_write_shortest_exact_decimal(most, k->range.most));
    fputs("}, {\"$ref\": \"#/definitions/formula\"}", out);
}

static void write_list_of(FILE *out, const char *definition)
{
    fprintf(out, "{\"type\": \"array\", \"items\": {\"$ref\": \"#/definitions/%s\"}}", definition);
}

/* Writes the list of required keys of a group to `out`; nothing if there are none. group: path of the group; begin:
 * text before the first key. */
static void write_required(FILE *out, const char *group, const char *begin)
{
    const char *between = begin;
    for (int k = 0; k < keys_count; k++) {
        if (!key_is_directly_below(&keys[k], group) || strcmp(keys[k].fallback, "required") != 0) continue;
        fprintf(out, "%s\"%s\"", between, key_get_last_name_of_path(&keys[k]));
        between = ", ";
    }
    if (between != begin) fputc(']', out);
}

static void write_object(FILE *out, const char *group);

/* ---- values ------------------------------------------------------------------------------------------------------ */

/* Returns true if the table of keys has keys directly below the path `group`. */
static bool has_children(const char *group)
{
    bool any = false;
    for (int k = 0; k < keys_count; k++) any |= key_is_directly_below(&keys[k], group);
    return any;
}

/* Writes the JSON type of key k (of input files), whose value is read by a function of its own, to `out`, as derived
 * from the description of its form in the table of keys. Writes {}, any value, if the description is not recognised. */
static void write_by_hand(FILE *out, const struct key *k)
{
    const char *form = k->words ? k->words : "";
    const bool choice = strchr(form, '|') && !strstr(form, " or ") && !strchr(form, ' ');
    if (choice || strcmp(form, "true") == 0)
        write_words(out, form);
    else if (strcmp(form, "number") == 0)
        write_numbers(out, k, "number");
    else if (strncmp(form, "solid", 5) == 0)
        fputs("{\"$ref\": \"#/definitions/region\"}", out);
    else if (strcmp(form, "file name or mapping") == 0) {
        fputs("{\"$ref\": \"#/definitions/name\"}, ", out);
        write_object(out, k->path);
    } else if (strcmp(form, "list of names") == 0)
        write_list_of(out, "name");
    else if (strncmp(form, "file name or list", 17) == 0)
        fputs("{\"$ref\": \"#/definitions/names\"}", out);
    else if (strncmp(form, "file name", 9) == 0 || strncmp(form, "name", 4) == 0)
        fputs("{\"$ref\": \"#/definitions/name\"}", out);
    else if (strncmp(form, "list of number", 14) == 0) {
        write_list_of(out, "number");
        fputs(", {\"$ref\": \"#/definitions/number\"}", out);
    } else if (strcmp(form, "mapping of names") == 0)
        fputs("{\"type\": \"object\", \"additionalProperties\": {\"$ref\": \"#/definitions/number\"}}", out);
    else if (strcmp(form, "mapping of names to solids") == 0)
        fputs("{\"type\": \"object\", \"additionalProperties\": {\"$ref\": \"#/definitions/region\"}}", out);
    else if (strcmp(form, "list of points") == 0)
        write_list_of(out, "point");
    else if (strstr(form, " or mapping") && has_children(k->path)) {
        fprintf(out, "{\"enum\": [\"%.*s\"]}, ", (int)strcspn(form, " "), form);
        write_object(out, k->path);
    } else
        fputs("{}", out);
}

/* Writes the JSON type of a probe to `out`: the word of its kind, or a mapping with the kind as its only key. */
static void write_probe(FILE *out)
{
    const char *between = "";
    fputs("{\"anyOf\": [{\"enum\": [", out);
    for (int k = 0; k < PROBES; k++, between = ", ") fprintf(out, "%s\"%s\"", between, probe_names[k]);
    fputs("]}, ", out);
    write_object(out, "probes");
    fputs("]}", out);
}

static void write_list_items(FILE *out, const struct key *k)
{
    char least[32], most[32];
    fputs("{\"type\": \"array\"", out);
    if (k->range.given && isfinite(k->range.most))
        fprintf(out, ", \"minItems\": %s, \"maxItems\": %s", number_write_shortest_exact_decimal(least, k->range.least),
                number_write_shortest_exact_decimal(most, k->range.most));
    fputs(", \"items\": ", out);
    if (strcmp(k->path, "probes") == 0)
        write_probe(out);
    else
        write_object(out, key_get_group_path_of_list_items(k));
    fputc('}', out);
}

/* Writes the JSON types that the value of key k (of input files) may have, separated by commas, to `out`. */
static void write_alternatives(FILE *out, const struct key *k)
{
    static const char *const definition[] = {
        [KEY_NAME] = "name",     [KEY_BODY] = "name",     [KEY_MATERIAL] = "name", [KEY_POINT] = "point",
        [KEY_MATRIX] = "matrix", [KEY_REGION] = "region", [KEY_SERIES] = "numbers"};
    const size_t type = k->type;
    if (type < COUNT_OF(definition) && definition[type]) {
        fprintf(out, "{\"$ref\": \"#/definitions/%s\"}", definition[type]);
    } else if (type == KEY_REAL) {
        if (k->words) write_words(out, k->words), fputs(", ", out);
        write_numbers(out, k, "number");
    } else if (type == KEY_INT || type == KEY_SEED) {
        write_numbers(out, k, "integer");
    } else if (type == KEY_FLAG) {
        fputs("{\"type\": \"boolean\"}", out);
    } else if (type == KEY_CHOICE) {
        write_words(out, k->words);
    } else if (type == KEY_SET) {
        fputs("{\"enum\": [\"none\", \"all\"]}, {\"type\": \"array\", \"items\": ", out);
        write_words(out, k->words);
        fputc('}', out);
    } else if (type == KEY_LIST) {
        write_list_items(out, k);
    } else if (type == KEY_MAP || type == KEY_PART) {
        const struct key *form = key_find(k->path, "form"); /* the short form `exact: step bar` */
        if (form && form->type == KEY_CHOICE) write_words(out, form->words), fputs(", ", out);
        write_object(out, k->path);
    } else {
        write_by_hand(out, k);
    }
}

/* Returns true if key k (of input files) is in a mapping that is merged with that of an included scene. Such a key may
 * have an empty value, which removes the value of the included scene. */
static bool is_in_merged(const struct key *k)
{
    char group[64];
    snprintf(group, sizeof group, "%s", k->path);
    char *dot = strrchr(group, '.');
    *(dot ? dot : group) = '\0';
    return key_is_mapping_merged_with_included_file(group);
}

static void write_property(FILE *out, const struct key *k)
{
    const bool probe = strncmp(k->path, "probes.", 7) == 0;
    char description[1600];
    key_describe_meaning_and_type(k, description, sizeof description);
    write_string(out, key_get_last_name_of_path(k), strlen(key_get_last_name_of_path(k)));
    fputs(": {\"description\": ", out);
    write_string(out, description, strlen(description));
    fputs(", \"anyOf\": [", out);
    write_alternatives(out, k);
    if (is_in_merged(k) || (probe && k->type == KEY_PART)) fputs(", {\"type\": \"null\"}", out);
    fputs("]}", out);
}

/* Writes the members of the JSON type of a mapping with the keys of a group to `out`. group: path of the group. The
 * list of required keys is omitted if scenes that include each other merge this mapping. */
static void write_members(FILE *out, const char *group)
{
    const char *between = "";
    fputs("\"type\": \"object\", \"additionalProperties\": false, \"properties\": {", out);
    for (int k = 0; k < keys_count; k++) {
        if (!key_is_directly_below(&keys[k], group)) continue;
        fprintf(out, "%s\n", between);
        write_property(out, &keys[k]);
        between = ",";
    }
    fputs("}", out);
    if (!key_is_mapping_merged_with_included_file(group)) write_required(out, group, ", \"required\": [");
}

static void write_object(FILE *out, const char *group)
{
    fputc('{', out);
    write_members(out, group);
    fputc('}', out);
}

static const char definitions[] =
    "\"definitions\": {\n"
    "\"formula\": {\"type\": \"string\", \"pattern\": \"^[-+*/^().,%\\\\s\\\\w\\u00b5\\u03bc\\u00b2\\u00b3]+$\"},\n"
    "\"number\": {\"anyOf\": [{\"type\": \"number\"}, {\"$ref\": \"#/definitions/formula\"}]},\n"
    "\"numbers\": {\"type\": \"array\", \"minItems\": 1, \"items\": {\"$ref\": \"#/definitions/number\"}},\n"
    "\"point\": {\"anyOf\": [{\"$ref\": \"#/definitions/number\"}, {\"type\": \"array\", \"minItems\": 1, "
    "\"maxItems\": 3, \"items\": {\"$ref\": \"#/definitions/number\"}}]},\n"
    "\"matrix\": {\"anyOf\": [{\"$ref\": \"#/definitions/number\"}, {\"type\": \"array\", \"items\": {\"$ref\": "
    "\"#/definitions/point\"}}]},\n"
    "\"name\": {\"type\": [\"string\", \"integer\"]},\n"
    "\"names\": {\"anyOf\": [{\"type\": \"string\"}, {\"type\": \"array\", \"items\": {\"type\": \"string\"}}]},\n"
    "\"region\": {\"anyOf\": [{\"type\": \"string\"}, {\"$ref\": \"#/definitions/solid\"}, {\"type\": \"array\", "
    "\"minItems\": 1, \"items\": {\"$ref\": \"#/definitions/solid\"}}]},\n"
    "\"solid\": ";

status scene_print_json_schema(FILE *out)
{
    fputs("{\"$schema\": \"http://json-schema.org/draft-07/schema#\", \"title\": \"scene of cleave\",\n", out);
    fputs(definitions, out);
    write_object(out, "solid");
    fputs("},\n\"if\": {\"not\": {\"required\": [\"include\"]}}, \"then\": {", out);
    write_required(out, "", "\"required\": [");
    fputs("},\n", out);
    write_members(out, "");
    fputs("}\n", out);
    return ferror(out) ? status_set(FAILED, "the schema cannot be written") : OK;
}
