/* Reads one value of summary.json, or all its numbers, with a strict JSON parser.
 *
 * The document is checked from its first to its last byte. The functions pass the remaining part of the dotted key as
 * `rest`: NULL if the value is not on the path, "" at the wanted value. */
#include "output/summary_read.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "output/output_files.h"
#include "output/renamed_results.h"

/* DEPTH_MAX: largest depth of nested values; SIZE_MAX_BYTES: largest file that is read [byte]; KEY_ROOM: capacity of a
 * dotted key [byte]. */
enum { DEPTH_MAX = 64, SIZE_MAX_BYTES = 64 << 20, KEY_ROOM = 512 };

/* State of the parser while it reads one summary.json: position in the text, and the wanted value once it is found. */
struct reader {
    const char *at;                 /* next byte; the text ends with a 0 byte */
    const char *found;              /* first byte of the wanted value; NULL: not found so far */
    summary_number_visit_fn *visit; /* receives every number; NULL if there is none */
    void *context;
    char key[KEY_ROOM]; /* dotted key of the value that is being read */
    size_t length;      /* length of `key` [byte] */
};

static bool value(struct reader *r, const char *rest, int depth);

static void skip_space(struct reader *r)
{
    while (*r->at == ' ' || *r->at == '\t' || *r->at == '\n' || *r->at == '\r') r->at++;
}

static bool summary_read_take(struct reader *r, char c)
{
    skip_space(r);
    if (*r->at != c) return false;
    r->at++;
    return true;
}

static bool escape(struct reader *r)
{
    if (*r->at != 'u') return *r->at != '\0' && strchr("\"\\/bfnrt", *r->at++) != NULL;
    r->at++;
    for (int k = 0; k < 4; k++)
        if (!isxdigit((unsigned char)*r->at++)) return false;
    return true;
}

/* Parses a JSON string at the reading position of r. Stores pointers to its beginning and its end in the text, without
 * the quotes, in *from and *to. Escapes are not replaced. Returns false if the string is malformed. */
static bool string(struct reader *r, const char **from, const char **to)
{
    if (!summary_read_take(r, '"')) return false;
    *from = r->at;
    while (*r->at != '"') {
        if ((unsigned char)*r->at < 0x20) return false; /* also the end of the text */
        if (*r->at++ == '\\' && !escape(r)) return false;
    }
    *to = r->at++;
    return true;
}

static bool digits(struct reader *r)
{
    const char *from = r->at;
    while (isdigit((unsigned char)*r->at)) r->at++;
    return r->at > from;
}

static bool number(struct reader *r)
{
    if (*r->at == '-') r->at++;
    bool zero = *r->at == '0';
    const char *from = r->at;
    if (!digits(r) || (zero && r->at - from > 1)) return false;
    if (*r->at == '.') {
        r->at++;
        if (!digits(r)) return false;
    }
    if (*r->at == 'e' || *r->at == 'E') {
        r->at++;
        if (*r->at == '+' || *r->at == '-') r->at++;
        if (!digits(r)) return false;
    }
    return true;
}

static bool word(struct reader *r, const char *text)
{
    size_t length = strlen(text);
    if (strncmp(r->at, text, length) != 0) return false;
    r->at += length;
    return true;
}

/* Compares the first part of the dotted key `rest` with `name`, a text of `length` characters. Returns the part of
 * `rest` after it if they are equal. Returns NULL if they differ, or if rest is NULL. */
static const char *summary_read_below(const char *rest, const char *name, size_t length)
{
    if (rest == NULL || strncmp(rest, name, length) != 0) return NULL;
    if (rest[length] == '\0') return rest + length;
    return rest[length] == '.' ? rest + length + 1 : NULL;
}

/* Parses the value of the member `name` (of `length` characters) of an object. During the call r->key is the dotted key
 * of the value, truncated if it is too long. rest: the part of the wanted key that begins with this member, or NULL if
 * the value is not on the path of the wanted key; depth: levels of nesting. Returns false if the text is malformed. */
static bool member(struct reader *r, const char *rest, const char *name, size_t length, int depth)
{
    const size_t above = r->length;
    const int whole = snprintf(r->key + above, KEY_ROOM - above, "%s%.*s", above > 0 ? "." : "", (int)length, name);
    r->length = above + (size_t)whole < KEY_ROOM ? above + (size_t)whole : KEY_ROOM - 1;
    const bool sound = value(r, summary_read_below(rest, name, length), depth);
    r->length = above;
    r->key[above] = '\0';
    return sound;
}

static bool object(struct reader *r, const char *rest, int depth)
{
    if (summary_read_take(r, '}')) return true;
    do {
        const char *from, *to;
        if (!string(r, &from, &to) || !summary_read_take(r, ':')) return false;
        if (!member(r, rest, from, (size_t)(to - from), depth)) return false;
    } while (summary_read_take(r, ','));
    return summary_read_take(r, '}');
}

static bool list(struct reader *r, const char *rest, int depth)
{
    char name[24];
    if (summary_read_take(r, ']')) return true;
    int k = 0;
    do {
        int length = snprintf(name, sizeof name, "%d", k++);
        if (!member(r, rest, name, (size_t)length, depth)) return false;
    } while (summary_read_take(r, ','));
    return summary_read_take(r, ']');
}

static bool value(struct reader *r, const char *rest, int depth)

/* Parses any value at r->at, and stores in r->found where the wanted value begins. rest: remaining part of the wanted
 * key, "" if this is the wanted value, NULL if the value is not on its path. depth: levels of nesting. Returns false if
 * the text is malformed. */
{
    const char *from, *to;
    if (depth == DEPTH_MAX) return false;
    skip_space(r);
    if (rest != NULL && *rest == '\0') {
        if (r->found == NULL) r->found = r->at;
        rest = NULL;
    }
    switch (*r->at) {
    case '{':
        r->at++;
        return object(r, rest, depth + 1);
    case '[':
        r->at++;
        return list(r, rest, depth + 1);
    case '"':
        return string(r, &from, &to);
    case 't':
        return word(r, "true");
    case 'f':
        return word(r, "false");
    case 'n':
        return word(r, "null");
    default:
        break;
    }
    from = r->at;
    if (!number(r)) return false;
    if (r->visit) r->visit(r->context, r->key, strtod(from, NULL));
    return true;
}

/* Reads the whole file `path` into *text, with a final 0; the caller releases it with free. Returns FAILED, with a
 * message, if it cannot be read. */
static status read_text(const char *path, char **text)
{
    if (path_exists(path) && !path_is_file(path))
        return status_set(FAILED, "%s is not a regular file; give the folder of a run", path);
    FILE *from = fopen(path, "rb");
    if (from == NULL) return status_set(FAILED, "%s: %s", path, strerror(errno));
    size_t length = 0, room = 1 << 16, got;
    char *bytes = malloc(room);
    while (bytes != NULL && (got = fread(bytes + length, 1, room - 1 - length, from)) > 0) {
        length += got;
        if (length < room - 1) continue;
        char *grown = room < SIZE_MAX_BYTES ? realloc(bytes, room *= 2) : NULL;
        if (grown == NULL) free(bytes);
        bytes = grown;
    }
    bool bad = ferror(from) != 0;
    fclose(from);
    if (bytes == NULL || bad) {
        free(bytes);
        return status_set(FAILED, "%s: %s", path, bad ? "cannot be read" : "too long for a summary");
    }
    bytes[length] = '\0';
    *text = bytes;
    return OK;
}

/* Parses summary.json in `folder` from the first to the last byte with the reader r, and finds the value of `key`:
 * r->found points to it, or is NULL. *text: receives the contents of the file, which the caller frees with free, also
 * on a fault. Returns FAILED, with file and line in the message, if it is not JSON. */
static status summary_read_document(struct reader *r, const char *folder, const char *key, char **text)
{
    char path[4096];
    *text = NULL;
    if (snprintf(path, sizeof path, "%s/summary.json", folder) >= (int)sizeof path)
        return status_set(FAILED, "%s: the name of the file is too long; choose a shorter one", folder);
    TRY(read_text(path, text));
    r->at = *text;
    const bool sound = value(r, key, 0);
    skip_space(r);
    if (sound && *r->at == '\0') return OK;
    int line = 1;
    for (const char *c = *text; c < r->at; c++) line += *c == '\n';
    return status_set(FAILED, "%s:%d: not JSON", path, line);
}

/* Finds the value of `key`, or of its name in another version of Cleave, in summary.json of `folder`. *text: receives
 * the contents of the file, which the caller frees with free; *found: first byte of the value in it. Returns FAILED,
 * with a message and *text freed, if the file is not JSON or has no such key. */
static status summary_read_find(const char *folder, const char *key, char **text, const char **found)
{
    struct reader r = {0};
    status s = summary_read_document(&r, folder, key, text);
    const char *other = s == OK && r.found == NULL ? renamed_result_swap_former_and_current_name(key) : NULL;
    if (other) { /* the document is sound, as read above */
        r = (struct reader){.at = *text};
        (void)value(&r, other, 0);
    }
    if (s == OK && r.found == NULL) s = status_set(FAILED, "%s/summary.json: no %s", folder, key);
    if (s != OK) free(*text);
    *found = r.found;
    return s;
}

status summary_visit_numbers(const char *folder, summary_number_visit_fn *visit, void *context)
{
    char *text;
    struct reader r = {.visit = visit, .context = context};
    const status s = summary_read_document(&r, folder, NULL, &text);
    free(text);
    return s;
}

status summary_read_number(const char *folder, const char *dotted_key, double *value_out)
{
    char *text;
    const char *found;
    *value_out = NAN;
    TRY(summary_read_find(folder, dotted_key, &text, &found));
    bool is_number = *found == '-' || isdigit((unsigned char)*found);
    if (is_number) *value_out = strtod(found, NULL);
    free(text);
    return is_number
               ? OK
               : status_set(FAILED, "%s/summary.json: %s is not a number, so the file is damaged; run the scene again",
                            folder, dotted_key);
}

status summary_read_string(const char *folder, const char *dotted_key, char *out, size_t size)
{
    char *text;
    const char *found, *from, *to;
    INVARIANT(size > 0);
    out[0] = '\0';
    TRY(summary_read_find(folder, dotted_key, &text, &found));
    struct reader r = {.at = found};
    bool is_string = string(&r, &from, &to);
    size_t length = 0;
    for (const char *c = from; is_string && c < to && length + 1 < size; c++) {
        if (*c == '\\' && (c[1] == '"' || c[1] == '\\')) c++;
        out[length++] = *c;
    }
    out[length] = '\0';
    text_replace_control_characters(out);
    free(text);
    return is_string
               ? OK
               : status_set(FAILED, "%s/summary.json: %s is not a text, so the file is damaged; run the scene again",
                            folder, dotted_key);
}
