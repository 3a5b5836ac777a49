/* Reads the command line of those commands that read an input file. */
#include "arguments.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

status arguments_add_override(struct run_arguments *a, const char *text)
{
    const char *equals = strchr(text, '=');
    if (!equals || equals == text)
        return status_set(REFUSED, "-s %s: give a key and its value, such as -s particles.spacing=0.5mm", text);
    char *copy = NEW("arguments.text", strlen(text) + 1, char);
    strcpy(copy, text);
    copy[equals - text] = '\0';
    a->override[a->overrides++] = (struct scene_override){copy, copy + (equals - text) + 1};
    return OK;
}

/* Reads a whole number from `text` into *count. Returns true if the text is a whole number from `least` to `most`; else
 * returns false and leaves *count unchanged. */
static bool count_read(int *count, const char *text, int least, int most)
{
    char *end;
    const long n = strtol(text, &end, 10);
    if (*end || end == text || n < least || n > most) return false;
    *count = (int)n;
    return true;
}

status option_read_count(int *count, const char *option, const char *text, int smallest, int largest)
{
    return count_read(count, text, smallest, largest)
               ? OK
               : status_set(REFUSED, "%s %s: give a number from %d to %d", option, text, smallest, largest);
}

/* Reads the width or height of a picture, a number without unit (pixels) or with the unit mm, at the beginning of
 * *text. *pixels: receives the length [pixel]; *factor: receives the number of pixels in one unit of the text:
 * PICTURE_DPI/25.4 for mm, 1 for pixels; *text is advanced behind the length. Returns false if *text does not begin
 * with a number; the results are then meaningless. */
static bool picture_length_read(double *pixels, double *factor, const char **text)
{
    char *end;
    *pixels = strtod(*text, &end);
    const bool number = end != *text;
    *factor = strncmp(end, "mm", 2) == 0 ? PICTURE_DPI / 25.4 : 1;
    *pixels *= *factor;
    *text = *factor != 1 ? end + 2 : end;
    return number;
}

status option_read_picture_size(struct picture_size *size, const char *option, const char *text)
{
    enum { WIDTH_LEAST = 300, HEIGHT_LEAST = 226, MOST = 10000 };
    double width, height = 0, factor, own;
    const char *at = text;
    bool good = picture_length_read(&width, &factor, &at) && width >= WIDTH_LEAST && width <= MOST;
    if (good && *at == 'x') {
        at++;
        good = picture_length_read(&height, &own, &at) && own == factor && height >= HEIGHT_LEAST && height <= MOST;
    }
    if (!good || *at)
        return status_set(REFUSED,
                          "%s %s: give a width in pixels or mm, such as 1200 or 85mm, or a size, such as 1200x800 or "
                          "85mmx60mm: from 53mmx40mm (300x226) to 10000x10000 pixels",
                          option, printable_name(text).text);
    size->width = (int)width, size->height = (int)height;
    return OK;
}

status option_read_dpi(struct picture_size *size, const char *option, const char *text)
{
    char *end;
    const double value = strtod(text, &end);
    if (end == text || *end || !(value >= 30 && value <= 1200))
        return status_set(REFUSED, "%s %s: give a number from 30 to 1200", option, printable_name(text).text);
    size->dpi = value;
    return OK;
}

status option_check_has_value(const char *option, bool has_value, const char *usage)
{
    return has_value ? OK : status_set(REFUSED, "%s needs a value; usage: cleave %s", option, usage);
}

bool option_is_size_dpi_or_format(const char *option)
{
    return !strcmp(option, "--size") || !strcmp(option, "--dpi") || !strcmp(option, "--format");
}

status option_read_size_dpi_or_format(struct picture_size *size, const char *option, const char *option_value,
                                      const char *usage)
{
    TRY(option_check_has_value(option, option_value != NULL, usage));
    if (strcmp(option, "--size") == 0) return option_read_picture_size(size, option, option_value);
    if (strcmp(option, "--dpi") == 0) return option_read_dpi(size, option, option_value);
    if (picture_format_find_by_ending(&size->format, option_value) && !picture_format_is_video(size->format)) return OK;
    return status_set(REFUSED, "%s %s: give png, svg or pdf", option, printable_name(option_value).text);
}

status arguments_refuse_second_scene(const char *scene, const char *word)
{
    if (strchr(word, '='))
        return status_set(REFUSED, "%s: write the option -s before a key and its value: -s %s", word, word);
    return status_set(REFUSED, "two scenes are given, %s and %s; give one", scene, word);
}

static status read_threads(struct run_arguments *a, const char *text)
{
    return count_read(&a->threads, text, 1, THREADS_MOST)
               ? OK
               : status_set(REFUSED, "-t %s: give a number of threads from 1 to %d", text, THREADS_MOST);
}

bool arguments_remove_option(int *argc, char **argv, const char *option)
{
    int kept = 0;
    for (int k = 0; k < *argc; k++)
        if (strcmp(argv[k], option) || (k > 0 && !strcmp(argv[k - 1], "-s"))) argv[kept++] = argv[k];
    const bool taken = kept < *argc;
    *argc = kept;
    return taken;
}

static status arguments_read_all(struct run_arguments *a, int argc, char **argv, const char *usage)
{
    for (int k = 1; k < argc; k++) {
        const char *word = argv[k];
        bool takes = !strcmp(word, "-o") || !strcmp(word, "-s") || !strcmp(word, "-t");
        if (takes) TRY(option_check_has_value(word, k + 1 < argc, usage));
        if (!strcmp(word, "-o"))
            a->folder = argv[++k];
        else if (!strcmp(word, "-s"))
            TRY(arguments_add_override(a, argv[++k]));
        else if (!strcmp(word, "-t"))
            TRY(read_threads(a, argv[++k]));
        else if (!strcmp(word, "--resume"))
            a->resume = true;
        else if (!strcmp(word, "--overwrite"))
            a->overwrite = true;
        else if (!strcmp(word, "-q"))
            a->quiet = true;
        else if (word[0] == '-' && word[1])
            return status_set(REFUSED, "unknown option %s; usage: cleave %s", word, usage);
        else if (a->scene)
            return arguments_refuse_second_scene(a->scene, word);
        else
            a->scene = word;
    }
    if (a->resume && a->overwrite)
        return status_set(REFUSED, "--resume continues a run, but --overwrite replaces it: remove one of the two");
    return a->scene ? OK : status_set(REFUSED, "no scene is given; usage: cleave %s", usage);
}

status arguments_read(struct run_arguments *a, int argc, char **argv, const char *usage)
{
    memset(a, 0, sizeof *a);
    a->override = NEW("arguments.override", argc, struct scene_override);
    status s = arguments_read_all(a, argc, argv, usage);
    if (s != OK) arguments_free(a);
    return s;
}

void arguments_free(struct run_arguments *a)
{
    for (int k = 0; k < a->overrides; k++) memory_free((char *)a->override[k].key);
    memory_free(a->override);
    memset(a, 0, sizeof *a);
}
