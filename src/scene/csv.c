/* Reads CSV files line by line, with a bound on the length of a line. */
#include "csv.h"

#include <stdarg.h>
#include <string.h>

#include "base/input.h"

status csv_open(struct csv_file *c, const char *path, const char *line_description)
{
    *c = (struct csv_file){.path = path, .holds = line_description, .separator = ','};
    return input_file_open(&c->file, path, NULL);
}

void csv_close(struct csv_file *c)
{
    if (c->file) fclose(c->file);
    c->file = NULL;
}

/* Replaces the D of Fortran exponents by e in the numbers of the line `text`, as in 5.0D-01. */
static void exponents_rewrite(char *text)
{
    static const char between[] = " \t\r\n,;\"", digits[] = "0123456789";
    for (char *field = text + strspn(text, between); *field; field += strspn(field, between)) {
        char *end = field + strcspn(field, between), *d = field + strspn(field, "+-.0123456789");
        char *power = d + 1;
        if ((*d == 'D' || *d == 'd') && d > field && strchr(".0123456789", d[-1])) {
            power += *power == '+' || *power == '-';
            if (power < end && power + strspn(power, digits) == end) *d = 'e';
        }
        field = end;
    }
}

status csv_read_line(struct csv_file *c, bool *line_was_read, bool *line_is_comment)
{
    while ((*line_was_read = fgets(c->text, sizeof c->text, c->file) != NULL)) {
        c->line++;
        const size_t length = strlen(c->text), first = strcspn(c->text, "\r");
        if (c->text[first] && c->text[first + 1 + strspn(c->text + first + 1, "\r\n")])
            return status_set(REFUSED,
                              "%s:%lld: lines end in carriage returns only; convert the line ends to line feeds",
                              c->path, (long long)c->line);
        if (length == 0 || (c->text[length - 1] != '\n' && !feof(c->file)))
            return status_set(REFUSED, "%s:%lld: this is not a line of text; %s", c->path, (long long)c->line,
                              c->holds);
        if (c->line == 1 && strncmp(c->text, "\xEF\xBB\xBF", 3) == 0) memmove(c->text, c->text + 3, length - 2);
        size_t blank = strspn(c->text, " \t\r\n");
        *line_is_comment = c->text[blank] == '#';
        if (!*line_is_comment) exponents_rewrite(c->text);
        if (c->text[blank] != '\0') return OK;
    }
    *line_is_comment = false;
    return ferror(c->file) ? status_set(REFUSED, "%s: cannot be read", c->path) : OK;
}

status csv_read_data_line(struct csv_file *c, bool *line_was_read)
{
    bool comment = true;
    *line_was_read = true;
    while (comment) TRY(csv_read_line(c, line_was_read, &comment));
    return OK;
}

void csv_detect_separator(struct csv_file *c)
{
    int commas = 0, tabs = 0;
    for (const char *at = c->text; *at; at++) commas += *at == ',', tabs += *at == '\t';
    c->separator = strchr(c->text, ';') ? ';' : tabs > commas ? '\t' : ',';
}

/* Strips blanks and double quotes from both ends of a field of a CSV line, also if they are nested. Overwrites the
 * characters after the stripped field with zeros. Returns a pointer to its first character, inside `field`. */
static char *csv_trim(char *field)
{
    size_t n = strlen(field);
    while (n > 0 && strchr(" \t\r\n", field[n - 1]) != NULL) field[--n] = '\0';
    const size_t blank = strspn(field, " \t");
    field += blank, n -= blank;
    if (n < 2 || field[0] != '"' || field[n - 1] != '"') return field;
    field[n - 1] = '\0';
    return csv_trim(field + 1);
}

/* Returns a pointer to the character of `field` (the rest of a line) from which the separator that ends the field is
 * to be searched: the closing quote if the field is quoted, since quoted text may contain separators; else the
 * beginning of the field. */
static char *csv_behind_quotes(char *field)
{
    char *start = field + strspn(field, " "), *close = *start == '"' ? strchr(start + 1, '"') : NULL;
    return close ? close : field;
}

/* Cuts the next field off a line whose fields are separated by any number of blanks. field: the text that has not been
 * read yet. *rest: receives the text after the field, or NULL if the line ends there. Returns the field without blanks
 * and quotes, terminated in place. */
static char *csv_word(char *field, char **rest)
{
    static const char blanks[] = " \t\r\n";
    field += strspn(field, blanks);
    char *behind = csv_behind_quotes(field), *end = behind + strcspn(behind, blanks), *next = end + strspn(end, blanks);
    *rest = *next ? next : NULL;
    *end = '\0';
    return csv_trim(field);
}

char *csv_split_off_next_field(const struct csv_file *c, char **rest_of_line)
{
    char *field = *rest_of_line;
    if (field == NULL) return NULL;
    if (c->separator == ' ') return csv_word(field, rest_of_line);
    char *end = strchr(csv_behind_quotes(field), c->separator);
    *rest_of_line = end != NULL ? end + 1 : NULL;
    if (end != NULL) *end = '\0';
    return csv_trim(field);
}

char *csv_cut_unit_off_column_name(char *column_name)
{
    char *end = column_name + strlen(column_name), *open = end;
    if (end > column_name && end[-1] == ']') open = strchr(column_name, '[');
    if (end > column_name && end[-1] == ')') open = strchr(column_name, '(');
    if (!open || open == end) return end;
    end[-1] = '\0';
    *open = '\0';
    for (char *c = open; c > column_name && strchr(" \t", c[-1]) != NULL; c--) c[-1] = '\0';
    return open + 1;
}

status csv_report_fault(const struct csv_file *c, const char *field, const char *format, ...)
{
    char what[256];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    return status_set(REFUSED, "%s:%lld:%d: %s", c->path, (long long)c->line, (int)(field - c->text) + 1, what);
}
