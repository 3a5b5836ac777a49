/* JSON, entry by entry. */
#include "output/json.h"

#include <math.h>

static void json_string(struct json *j, const char *text)
{
    fputc('"', j->file);
    for (const unsigned char *c = (const unsigned char *)text; *c; c++) {
        if (*c == '"' || *c == '\\')
            fprintf(j->file, "\\%c", *c);
        else if (*c < 0x20)
            fprintf(j->file, "\\u%04x", *c);
        else
            fputc(*c, j->file);
    }
    fputc('"', j->file);
}

/* Begins an entry of a JSON object or list in j: writes a comma after the previous entry if there is one, a line feed,
 * the indent and the key. key: NULL for an entry of a list. */
static void json_key(struct json *j, const char *key)
{
    fprintf(j->file, "%s\n%*s", j->filled ? "," : "", 2 * j->depth, "");
    j->filled = true;
    if (!key) return;
    json_string(j, key);
    fputs(": ", j->file);
}

void json_begin_object_or_list(struct json *j, const char *key, char bracket)
{
    json_key(j, key);
    fputc(bracket, j->file);
    j->depth++;
    j->filled = false;
}

void json_end_object_or_list(struct json *j, char bracket)
{
    j->depth--;
    if (j->filled) fprintf(j->file, "\n%*s", 2 * j->depth, "");
    fputc(bracket, j->file);
    j->filled = true;
}

void json_write_text(struct json *j, const char *key, const char *text)
{
    json_key(j, key);
    json_string(j, text);
}

void json_write_integer(struct json *j, const char *key, int64_t value)
{
    json_key(j, key);
    fprintf(j->file, "%lld", (long long)value);
}

void json_write_rounded(struct json *j, const char *key, real value, int digits)
{
    if (!isfinite(value)) return;
    json_key(j, key);
    fprintf(j->file, "%.*g", digits, value);
}

void json_write_real(struct json *j, const char *key, real value) { json_write_rounded(j, key, value, JSON_EXACT); }

void json_write_point(struct json *j, const char *prefix, const real *x, int dim)
{
    for (int d = 0; d < dim; d++) {
        char key[NAME_MAX_LENGTH];
        snprintf(key, sizeof key, "%s%c", prefix, "xyz"[d]);
        json_write_real(j, key, x[d]);
    }
}
