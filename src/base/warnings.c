/* Implements the list of warnings of a run. */
#include "base/warnings.h"

#include <stdarg.h>
#include <string.h>

#include "base/base.h"
#include "base/memory.h"

enum { WARNING_LONGEST = 1024 }; /* room for the text of a warning [byte]; longer texts are cut */

bool warnings_add_if_new(struct warnings *w, const char *format, ...)
{
    char text[WARNING_LONGEST];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    text_replace_control_characters(text);
    for (int k = 0; k < w->n; k++)
        if (strcmp(w->text[k], text) == 0) return false;
    GROW("warnings", w->text, w->n + 1);
    w->text[w->n] = NEW("warnings.text", strlen(text) + 1, char);
    strcpy(w->text[w->n++], text);
    return true;
}

void warnings_append_missing_from_list(struct warnings *w, const struct warnings *source_list, int first_warning)
{
    for (int k = first_warning; k < source_list->n; k++) warnings_add_if_new(w, "%s", source_list->text[k]);
}

void warnings_print(const struct warnings *w, int first_warning, FILE *out)
{
    for (int k = first_warning; k < w->n; k++) {
        char place[PLACE_LENGTH] = "";
        if (w->locate) w->locate(w->scene, w->text[k], place);
        fprintf(out, *place ? "warning: %s (%s)\n" : "warning: %s\n", w->text[k], place);
    }
}

void warnings_print_to_stderr(const struct warnings *w, int first_warning)
{
    if (!w->silent) warnings_print(w, first_warning, stderr);
}

void warnings_add_and_print(struct warnings *w, const char *text)
{
    if (warnings_add_if_new(w, "%s", text)) warnings_print_to_stderr(w, w->n - 1);
}

/* Saves all warnings of w to the archive a as one text, each with its terminating zero, if a->saving; else adds the
 * saved warnings to w. Returns FAILED, with a message, if the text does not have the saved length, or the archive
 * cannot be read or written. */
status warnings_save_or_load(struct warnings *w, struct archive *a)
{
    int64_t length = 0;
    for (int k = 0; k < w->n; k++) length += (int64_t)strlen(w->text[k]) + 1;
    ARCHIVE_VALUE(a, "warnings/length", length);
    if (length < 0 || (!a->saving && length > 0 && a->stored_size(a, "warnings/text") != length))
        return status_set(FAILED, "cannot resume: the warnings in the checkpoint have a wrong length; it is damaged, "
                                  "start again with --overwrite");
    if (length == 0) return OK;
    char *text = NEW("warnings.all", length + 1, char), *to = text;
    for (int k = 0; k < w->n && a->saving; k++) to = stpcpy(to, w->text[k]) + 1;
    const status s = a->exchange(a, "warnings/text", text, (size_t)length);
    for (const char *from = text; s == OK && !a->saving && from < text + length; from += strlen(from) + 1)
        warnings_add_if_new(w, "%s", from);
    memory_free(text);
    return s;
}

void warnings_free(struct warnings *w)
{
    for (int k = 0; k < w->n; k++) memory_free(w->text[k]);
    memory_free(w->text);
    *w = (struct warnings){0};
}
