/* Reads external geometry files. Their content is not trusted: malformed values and truncated files are refused. */
#include "source.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/input.h"
#include "base/memory.h"
#include "base/team.h"

enum { FILE_SHARE = 8 }; /* a file may take up to an eighth of the memory, because its data need more */

status geometry_file_read_whole(struct geometry_file *source, const char *path)
{
    FILE *file;
    *source = (struct geometry_file){.path = path};
    TRY(input_file_open(&file, path, NULL));
    const bool sized = fseeko(file, 0, SEEK_END) == 0;
    const int64_t length = sized ? (int64_t)ftello(file) : -1, memory = machine_memory_size();
    const bool fits = memory <= 0 || length <= memory / FILE_SHARE;
    if (length > 0 && fits && length < INT64_MAX) {
        rewind(file);
        source->text = memory_new_uninitialised("file", length + 1, 1);
        source->length = (int64_t)fread(source->text, 1, (size_t)length, file);
        source->text[source->length] = '\0';
    }
    fclose(file);
    if (source->length == length && length > 0) return OK;
    geometry_file_close(source);
    if (!fits)
        return status_set(REFUSED,
                          "%s: its %.3g GB do not fit into the memory of this machine; use a smaller file or a machine "
                          "with more memory",
                          path, 1e-9 * (real)length);
    return status_set(REFUSED, length == 0 ? "%s: empty" : "%s: cannot be read", path);
}

void geometry_file_close(struct geometry_file *file)
{
    memory_free(file->text);
    *file = (struct geometry_file){0};
}

status geometry_file_report_fault(const struct geometry_file *file, const char *format, ...)
{
    char what[256];
    int64_t line = 1;
    va_list more;
    va_start(more, format);
    vsnprintf(what, sizeof what, format, more);
    va_end(more);
    text_replace_control_characters(what);
    if (file->binary) return status_set(REFUSED, "%s: %s", file->path, what);
    for (int64_t k = 0; k < file->at && k < file->length; k++) line += file->text[k] == '\n';
    return status_set(REFUSED, "%s:%lld: %s", file->path, (long long)line, what);
}

static bool blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

bool geometry_file_skip_blanks(struct geometry_file *file)
{
    while (file->at < file->length && blank(file->text[file->at])) file->at++;
    return file->at < file->length;
}

void geometry_file_read_word(struct geometry_file *file, char *word, size_t capacity)
{
    size_t n = 0;
    geometry_file_skip_blanks(file);
    for (; file->at < file->length && !blank(file->text[file->at]); file->at++)
        if (n + 1 < capacity) word[n++] = file->text[file->at];
    word[n] = '\0';
}

/* Parses the next word of the text file as a number *value. what: name of the number, for messages. Returns REFUSED,
 * with a message, if it is no finite number. Words are limited to 63 characters, so that a long file without blanks is
 * refused at once. */
static status text_real(struct geometry_file *file, const char *what, real *value)
{
    char word[64], *end;
    if (!geometry_file_skip_blanks(file)) return geometry_file_report_fault(file, "ends where %s is expected", what);
    const int64_t from = file->at;
    geometry_file_read_word(file, word, sizeof word);
    *value = strtod(word, &end);
    if (end != word && *end == '\0' && isfinite(*value)) return OK;
    file->at = from;
    return geometry_file_report_fault(file, "%.40s is not a %s; write a number", word, what);
}

/* Copies the next `size` bytes of the binary file to `value`. what: name of the value, for messages. Returns REFUSED,
 * with a message, if the file ends before. */
static status bytes_take(struct geometry_file *file, const char *what, void *value, int64_t size)
{
    if (file->length - file->at < size)
        return geometry_file_report_fault(file, "the file ends where %s is expected, so it is cut off; write it again",
                                          what);
    array_copy(value, file->text + file->at, size, 1);
    file->at += size;
    return OK;
}

status geometry_file_read_real(struct geometry_file *file, const char *quantity, real *value)
{
    if (!file->binary) return text_real(file, quantity, value);
    TRY(bytes_take(file, quantity, value, sizeof *value));
    return isfinite(*value) ? OK : geometry_file_report_fault(file, "%s is not finite", quantity);
}

status geometry_file_read_integer(struct geometry_file *file, const char *quantity, int64_t *value)
{
    real number = 0;
    TRY(text_real(file, quantity, &number));
    if (number != floor(number) || fabs(number) > 9e15)
        return geometry_file_report_fault(file, "%s is %.17g; write a whole number", quantity, number);
    *value = (int64_t)number;
    return OK;
}

status geometry_file_read_int32(struct geometry_file *file, const char *quantity, int64_t *value)
{
    int32_t number = 0;
    if (!file->binary) return geometry_file_read_integer(file, quantity, value);
    TRY(bytes_take(file, quantity, &number, sizeof number));
    *value = number;
    return OK;
}

status geometry_file_read_int64(struct geometry_file *file, const char *quantity, int64_t *value)
{
    return file->binary ? bytes_take(file, quantity, value, sizeof *value)
                        : geometry_file_read_integer(file, quantity, value);
}

status geometry_file_check_count_fits_size(const struct geometry_file *file, const char *item_name, int64_t count,
                                           int64_t bytes_per_item)
{
    if (count >= 0 && count <= (file->length - file->at) / bytes_per_item) return OK;
    return geometry_file_report_fault(
        file,
        "the header gives %lld %s, more than the rest of the file can contain, so it is cut off "
        "or damaged; write it again",
        (long long)count, item_name);
}

void geometry_file_skip_to_next_line(struct geometry_file *file)
{
    const char *end = memchr(file->text + file->at, '\n', (size_t)(file->length - file->at));
    file->at = end ? end - file->text + 1 : file->length;
}
