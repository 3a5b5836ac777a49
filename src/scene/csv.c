/* Bounded reading of CSV files, line by line. */
#include "csv.h"

#include <stdarg.h>
#include <string.h>

status csv_open(struct csv_file *c, const char *path, const char *holds)
{
    *c = (struct csv_file){.path = path, .holds = holds, .file = fopen(path, "r"), .separator = ','};
    return c->file ? OK : status_set(REFUSED, "%s: cannot be opened", path);
}

void csv_close(struct csv_file *c)
{
    if (c->file) fclose(c->file);
    c->file = NULL;
}

status csv_line(struct csv_file *c, bool *more)
{
    while ((*more = fgets(c->text, sizeof c->text, c->file) != NULL)) {
        c->line++;
        size_t length = strlen(c->text);
        if (length == 0 || (c->text[length - 1] != '\n' && !feof(c->file)))
            return status_set(REFUSED, "%s:%lld: not a line of text; %s", c->path, (long long)c->line, c->holds);
        if (c->line == 1 && strncmp(c->text, "\xEF\xBB\xBF", 3) == 0) memmove(c->text, c->text + 3, length - 2);
        size_t blank = strspn(c->text, " \t\r\n");
        if (c->text[blank] != '\0' && c->text[blank] != '#') return OK;
    }
    if (ferror(c->file)) return status_set(REFUSED, "%s: cannot be read", c->path);
    return OK;
}

void csv_separate(struct csv_file *c)
{
    c->separator = strchr(c->text, ';') ? ';' : strchr(c->text, '\t') ? '\t' : ',';
}

/* The same where blanks separate: as many as there are. */
static char *csv_word(char *field, char **rest)
{
    field += strspn(field, " \t\r\n");
    char *end = field + strcspn(field, " \t\r\n"), *next = end + strspn(end, " \t\r\n");
    *rest = *next ? next : NULL;
    *end = '\0';
    return field;
}

char *csv_field(const struct csv_file *c, char **rest)
{
    char *field = *rest;
    if (field == NULL) return NULL;
    if (c->separator == ' ') return csv_word(field, rest);
    char *end = strchr(field, c->separator);
    *rest = end != NULL ? end + 1 : NULL;
    if (end != NULL) *end = '\0';
    field += strspn(field, " \t");
    for (size_t n = strlen(field); n > 0 && strchr(" \t\r\n", field[n - 1]) != NULL; n--) field[n - 1] = '\0';
    return field;
}

char *csv_unit(char *name)
{
    char *open = strchr(name, '['), *end = name + strlen(name);
    if (!open || end[-1] != ']') return end;
    end[-1] = '\0';
    *open = '\0';
    for (char *c = open; c > name && strchr(" \t", c[-1]) != NULL; c--) c[-1] = '\0';
    return open + 1;
}

status csv_fault(const struct csv_file *c, const char *field, const char *format, ...)
{
    char what[256];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    return status_set(REFUSED, "%s:%lld:%d: %s", c->path, (long long)c->line, (int)(field - c->text) + 1, what);
}
