/* Splits Abaqus .inp files into lines, fields and keywords. */
#include "abaqus_lines.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LABEL_MAX = 999999999 }; /* largest number of a node or element in a deck */

/* ---- lines and fields ------------------------------------------------------------------------------------------ */

/* Returns true if the reading position of `file` is at the end of a line or of the file. */
static bool at_end_of_line(const struct geometry_file *file)
{
    return file->at >= file->length || file->text[file->at] == '\n';
}

bool abaqus_read_field(struct geometry_file *file, char field[FIELD])
{
    size_t n = 0;
    while (!at_end_of_line(file) && isspace((unsigned char)file->text[file->at])) file->at++;
    if (at_end_of_line(file)) return false;
    for (; !at_end_of_line(file) && file->text[file->at] != ','; file->at++)
        if (n + 1 < FIELD) field[n++] = file->text[file->at];
    while (n > 0 && isspace((unsigned char)field[n - 1])) n--;
    field[n] = '\0';
    if (!at_end_of_line(file)) file->at++;
    return true;
}

bool abaqus_skip_blank_lines_and_test_for_data_line(struct geometry_file *file)
{
    while (file->at < file->length) {
        int64_t at = file->at;
        while (at < file->length && (file->text[at] == ' ' || file->text[at] == '\t' || file->text[at] == '\r')) at++;
        const bool empty = at >= file->length || file->text[at] == '\n';
        const bool comment = at + 1 < file->length && file->text[at] == '*' && file->text[at + 1] == '*';
        if (!empty && !comment) return file->text[at] != '*';
        geometry_file_skip_to_next_line(file);
    }
    return false;
}

status abaqus_parse_real(const struct geometry_file *file, const char *field, real *value)
{
    char text[FIELD], *end;
    snprintf(text, sizeof text, "%s", field);
    for (char *c = text; *c; c++)
        if (*c == 'd' || *c == 'D') *c = 'e';
    *value = strtod(text, &end);
    if (field[0] == '\0') *value = 0; /* the deck's default for an empty field */
    if (*end == '\0' && isfinite(*value) && !strpbrk(text, "xX")) return OK;
    return geometry_file_report_fault(file, "%.40s is not a number; correct this entry", field);
}

bool abaqus_field_is_label(const char *field) { return isdigit((unsigned char)field[0]); }

status abaqus_parse_label(const struct geometry_file *file, const char *field, int32_t *label)
{
    real value;
    *label = 0;
    TRY(abaqus_parse_real(file, field, &value));
    if (!(value >= 0 && value <= LABEL_MAX && value == floor(value)))
        return geometry_file_report_fault(file, "%.40s is not the number of a node or an element; correct this entry",
                                          field);
    *label = (int32_t)value;
    return OK;
}

/* ---- keywords ------------------------------------------------------------------------------------------------- */

/* Copies the word `from` to to[FIELD] in capitals and without blanks; a longer word is cut. */
void abaqus_copy_word_in_capitals(char *to, const char *from)
{
    size_t n = 0;
    for (; *from && n + 1 < FIELD; from++)
        if (!isspace((unsigned char)*from)) to[n++] = (char)toupper((unsigned char)*from);
    to[n] = '\0';
}

/* Appends the parameter in `field`, NAME or NAME=VALUE, to the keyword k; modifies the field. Parameters beyond
 * PARAMETERS_MAX are ignored. */
static void parameter_add(struct abaqus_keyword *k, char *field)
{
    char *equals = strchr(field, '=');
    if (k->n == PARAMETERS_MAX) return;
    struct parameter *p = &k->of[k->n++];
    p->value[0] = '\0';
    if (equals) {
        *equals++ = '\0';
        equals += strspn(equals, " \t\"");
        snprintf(p->value, sizeof p->value, "%.*s", (int)strcspn(equals, "\""), equals);
    }
    abaqus_copy_word_in_capitals(p->name, field);
}

void abaqus_read_keyword(struct geometry_file *file, struct abaqus_keyword *keyword)
{
    char field[FIELD];
    bool more;
    *keyword = (struct abaqus_keyword){0};
    abaqus_read_field(file, field);
    abaqus_copy_word_in_capitals(keyword->name, field + (field[0] == '*'));
    do {
        while (abaqus_read_field(file, field)) parameter_add(keyword, field);
        int64_t last = file->at - 1;
        while (last > 0 && (file->text[last] == ' ' || file->text[last] == '\r')) last--;
        more = file->at < file->length && last >= 0 && file->text[last] == ',' &&
               abaqus_skip_blank_lines_and_test_for_data_line(file);
    } while (more);
}

const char *abaqus_keyword_parameter_value(const struct abaqus_keyword *keyword, const char *name)
{
    for (int k = 0; k < keyword->n; k++)
        if (strcmp(keyword->of[k].name, name) == 0) return keyword->of[k].value;
    return NULL;
}
