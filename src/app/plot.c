/* Implements `cleave plot`: reads the arguments of the command. The functions in src/plot draw the pictures. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "arguments.h"
#include "base/memory.h"
#include "commands.h"
#include "output/output_files.h"
#include "plot/plot.h"
#include "plot/scene_picture.h"
#include "scene/words.h"

static const char usage[] = "plot " PLOT_WORDS;

/* Arguments of `cleave plot`. */
struct plot_words {
    struct plot_request request;
    struct run_arguments scene;          /* words of --scene, with its overrides */
    const char *times, *frames, *format; /* as on the command line */
    struct picture_size size;            /* size of pictures */
    char *range;                         /* allocated copy of the value of --range, cut in two */
};

/* Largest number of frames of a film; still images have PANELS_MAX. */
enum { FILM_FRAMES_MAX = 100000 };

enum { TITLE_MOST = TITLE_LENGTH - 64 }; /* longest title; other words may follow it in a picture */

/* ---- values ------------------------------------------------------------------------------------------------------ */

/* Reads `text`, the value of --frames, to w: `all`, `last`, or the number of frames. Returns REFUSED, with a message,
 * for other texts. */
static status read_frames_option(struct plot_words *w, const char *text)
{
    struct plot_request *r = &w->request;
    w->frames = text;
    r->every = strcmp(text, "all") == 0;
    r->panels = strcmp(text, "last") == 0 ? 1 : 0;
    if (r->every || r->panels) return OK;
    return option_read_count(&r->panels, "plot: --frames", text, 1, FILM_FRAMES_MAX);
}

/* Reads `text`, the value of --times, to w: numbers with units and `last`, separated by commas, or `all`. Returns
 * REFUSED, with a message, if the text contains anything that is no time, or more than PANELS_MAX times. */
static status read_times(struct plot_words *w, const char *text)
{
    struct plot_request *r = &w->request;
    if (strcmp(text, "all") == 0 || strcmp(text, "last") == 0) return read_frames_option(w, text);
    w->times = text;
    char *copy = NEW("plot.times", strlen(text) + 1, char), *rest = copy, *word, what[256];
    status s = OK;
    strcpy(copy, text);
    while (s == OK && (word = strsep(&rest, ",")) != NULL) {
        real time = 0;
        if (r->times == PANELS_MAX)
            s = status_set(REFUSED,
                           "plot: --times has too many times; give at most %d, or make a film (--format mp4), which "
                           "shows all frames",
                           PANELS_MAX);
        else if (strcmp(word, "last") == 0)
            r->time[r->times++] = INFINITY;
        else if (!time_parse_with_unit(&time, word, what, sizeof what))
            s = status_set(REFUSED, "plot: --times %s: %s; give times, or last, or the single word all",
                           printable_name(word).text, what);
        else
            r->bare[r->times] = !word[strspn(word, "0123456789")], r->time[r->times++] = time;
    }
    memory_free(copy);
    return s;
}

/* Reads `text`, the value of --slice, to w: `z=4mm`, or `z` for the slice normal to z with the most damage. Returns
 * REFUSED, with a message, for other texts. */
static status read_slice(struct plot_words *w, const char *text)
{
    struct projection *projection = &w->request.projection;
    char what[256];
    const char *wrong = "give an axis and a position, such as z=4mm, or the axis only";
    if (text[0] < 'x' || text[0] > 'z' || (text[1] && text[1] != '='))
        return status_set(REFUSED, "plot: --slice %s: %s", printable_name(text).text, wrong);
    projection->normal = text[0] - 'x';
    projection->placed = text[1] == '=';
    if (!projection->placed || length_parse_with_unit(&projection->layer, text + 2, what, sizeof what)) return OK;
    return status_set(REFUSED, "plot: --slice %s: %s %s", printable_name(text).text, printable_name(text + 2).text,
                      what);
}

static status read_view(struct plot_words *w, const char *text)
{
    struct projection *projection = &w->request.projection;
    projection->outside = true;
    projection->camera = camera_isometric;
    if (strcmp(text, "iso") == 0) return OK;
    if (strlen(text) != 2 || text[0] < 'x' || text[0] > 'z' || (text[1] != '+' && text[1] != '-'))
        return status_set(REFUSED, "plot: --view %s: give iso, x+, x-, y+, y-, z+ or z-", printable_name(text).text);
    projection->camera = camera_along_axis(text[0] - 'x', text[1] == '+' ? 1 : -1);
    return OK;
}

static status read_format(struct plot_words *w, const char *text)
{
    w->format = text;
    if (picture_format_find_by_ending(&w->request.format, text)) return OK;
    return status_set(REFUSED, "plot: --format %s: give png, svg, pdf, mp4 or gif", printable_name(text).text);
}

/* Reads `text`, the value of --range, LOW:HIGH, into w as two texts, whose units are checked later, when the field is
 * known. Returns REFUSED unless there are two texts. */
static status read_range(struct plot_words *w, const char *text)
{
    const char *colon = strchr(text, ':');
    if (!colon || colon == text || !colon[1])
        return status_set(REFUSED, "plot: --range %s: give LOW:HIGH, such as 0:200MPa", printable_name(text).text);
    memory_free(w->range);
    w->range = NEW("plot.range", strlen(text) + 1, char);
    strcpy(w->range, text);
    w->range[colon - text] = '\0';
    w->request.range[0] = w->range, w->request.range[1] = w->range + (colon - text) + 1;
    return OK;
}

/* Reads `text`, the value of --crop, to w: the rectangle X:X,Y:Y of lengths, lower end first. Returns REFUSED, with a
 * message, for other texts or another order. */
static status read_crop(struct plot_words *w, const char *text)
{
    char *copy = NEW("plot.crop", strlen(text) + 1, char), *rest = copy, what[256] = "give X:X,Y:Y as lengths";
    char *end[4] = {0}, joined[128];
    bool read = true;
    strcpy(copy, text);
    for (int k = 0; k < 4; k++) end[k] = strsep(&rest, k % 2 ? "," : ":");
    for (int k = 0; k < 4 && read; k++) {
        real value = 0;
        read = end[3] && length_parse_with_unit(
                             &value, number_text_append_unit_if_missing(joined, sizeof joined, end[k], end[k ^ 1]),
                             what, sizeof what);
        w->request.crop[k / 2][k % 2] = value;
    }
    memory_free(copy);
    w->request.cropped = true;
    for (int a = 0; a < 2 && read; a++)
        if (!(w->request.crop[a][1] > w->request.crop[a][0]))
            return status_set(REFUSED, "plot: --crop %s: give the lower end of each axis first, then the upper end",
                              printable_name(text).text);
    return read && !rest ? OK
                         : status_set(REFUSED, "plot: --crop %s: give X:X,Y:Y, such as 10mm:30mm,-5mm:5mm; %s",
                                      printable_name(text).text, what);
}

/* Reads `text`, the value of --magnify, a number above 0, into w. Returns REFUSED for other texts. */
static status read_magnify(struct plot_words *w, const char *text)
{
    char *end;
    double *value = &w->request.projection.magnify;
    *value = strtod(text, &end);
    if (end != text && !*end && *value > 0 && *value <= 1e12) return OK;
    return status_set(REFUSED, "plot: --magnify %s: give a number above 0, up to 1e12", printable_name(text).text);
}

static status read_dpi(struct plot_words *w, const char *text)
{
    return option_read_dpi(&w->size, "plot: --dpi", text);
}

static status read_fps(struct plot_words *w, const char *text)
{
    return option_read_count(&w->request.fps, "plot: --fps", text, 1, 240);
}

/* Reads `text`, the value of --size, to w: width and height as 1200x800 [pixel] or as 90mmx60mm. Returns REFUSED, with
 * a message, unless the width is from 300 (53 mm) and the height from 226 (40 mm) to 10000 pixels, since a smaller
 * picture has no space beside its letters. */
static status read_picture_size(struct plot_words *w, const char *text)
{
    return option_read_picture_size(&w->size, "plot: --size", text);
}

static status read_colours(struct plot_words *w, const char *text)
{
    const int table = word_index_in_list(COLOUR_TABLE_WORDS, text);
    if (table < 0)
        return status_set(REFUSED, "plot: --colours %s: give %s", printable_name(text).text, COLOUR_TABLE_WORDS);
    w->request.table = (enum colour_table)table;
    return OK;
}

/* Reads `text`, the value of --title, into w. Returns REFUSED for a title of more than TITLE_MOST bytes, for which a
 * picture has no space. */
static status read_title(struct plot_words *w, const char *text)
{
    w->request.title = text;
    return strlen(text) <= TITLE_MOST
               ? OK
               : status_set(REFUSED, "plot: --title is %d bytes long, but a picture has space for %d; shorten it",
                            (int)strlen(text), TITLE_MOST);
}
static status read_field(struct plot_words *w, const char *text) { return w->request.field = text, OK; }
static status read_out(struct plot_words *w, const char *text) { return w->request.out = text, OK; }
static status read_scene_option(struct plot_words *w, const char *text) { return w->scene.scene = text, OK; }
static status read_override(struct plot_words *w, const char *text) { return arguments_add_override(&w->scene, text); }

/* ---- words ------------------------------------------------------------------------------------------------------- */

/* Options of `cleave plot` that are followed by a value, and the functions that read the value. A function returns
 * REFUSED if the value is invalid. */
static const struct {
    const char *name;
    status (*read)(struct plot_words *w, const char *text);
} options[] = {
    {"--field", read_field},
    {"--times", read_times},
    {"--frames", read_frames_option},
    {"--slice", read_slice},
    {"--view", read_view},
    {"--format", read_format},
    {"--scene", read_scene_option},
    {"-s", read_override},
    {"-o", read_out},
    {"--range", read_range},
    {"--crop", read_crop},
    {"--magnify", read_magnify},
    {"--dpi", read_dpi},
    {"--fps", read_fps},
    {"--size", read_picture_size},
    {"--colours", read_colours},
    {"--title", read_title},
};

static status read_option(struct plot_words *w, const char *word, const char *value)
{
    const char *name[COUNT_OF(options)];
    for (size_t k = 0; k < COUNT_OF(options); k++) {
        name[k] = options[k].name;
        if (strcmp(word, name[k]) != 0) continue;
        TRY(option_check_has_value(word, value != NULL, usage));
        return options[k].read(w, value);
    }
    return status_set(REFUSED, "plot: unknown option %s%s usage: cleave %s", printable_name(word).text,
                      word_propose_similar(word, name, COUNT_OF(name)).text, usage);
}

/* Sets the format of the picture from the file name extension of -o in w, unless --format is given. Changes nothing if
 * -o has no extension or names a folder. Returns REFUSED, with a message, if the extension is unknown, or differs from
 * --format. */
static status settle_format(struct plot_words *w)
{
    const char *out = w->request.out, *dot = out ? strrchr(out, '.') : NULL;
    if (!dot || strchr(dot, '/') || path_is_folder(out)) return OK;
    if (!w->format && picture_format_find_by_ending(&w->request.format, dot + 1)) return OK;
    if (w->format && strcmp(w->format, dot + 1) == 0) return OK;
    return status_set(
        REFUSED,
        w->format
            ? "plot: -o %s: its ending does not fit --format %s; change the ending, or remove --format"
            : "plot: -o %s: give a file that ends in .png, .svg, .pdf, .mp4 or .gif, or a folder with / at its end",
        printable_name(out).text, w->format);
}

/* Checks the options of `cleave plot` in w together. Returns REFUSED, with a message, if two of them exclude each
 * other, or if neither a folder nor --scene is given. */
static status words_together(const struct plot_words *w)
{
    const struct plot_request *r = &w->request;
    if (w->scene.scene && (r->folder || r->field || w->times || w->frames || r->projection.normal >= 0))
        return status_set(
            REFUSED, "plot: --scene draws a scene before it runs; remove the folder, --field, --times and --slice");
    if (w->times && w->frames)
        return status_set(
            REFUSED, "plot: --times %s and %s (from --frames or --times) both select frames: remove one of the two",
            printable_name(w->times).text, printable_name(w->frames).text);
    if (r->panels > PANELS_MAX && !picture_format_is_video(r->format))
        return status_set(REFUSED,
                          "plot: --frames %d: a picture has at most %d panels; give fewer frames, or make a film "
                          "(--format mp4 or gif)",
                          r->panels, PANELS_MAX);
    if (!w->scene.scene && w->scene.overrides)
        return status_set(REFUSED, "plot: -s changes a scene; use it with --scene only");
    if (w->scene.scene && (r->range[0] || r->cropped || r->projection.magnify > 0 || r->table))
        return status_set(
            REFUSED, "plot: --scene draws a scene before it runs; remove --range, --colours, --crop and --magnify");
    if (r->fps && !picture_format_is_video(r->format))
        return status_set(REFUSED, "plot: --fps is for films; add --format mp4 or gif");
    if (r->range[0] && !r->field)
        return status_set(REFUSED, "plot: --range limits the values of a field; give --field too");
    if (r->cropped && r->projection.outside)
        return status_set(REFUSED, "plot: --crop is for plane runs and slices, not for --view; remove one of the two");
    if (r->projection.outside && r->projection.normal >= 0)
        return status_set(REFUSED, "plot: --slice shows the inside, but --view the outside: remove one of the two");
    if (!w->scene.scene && !r->folder)
        return status_set(REFUSED, "plot: no folder of a run is given; usage: cleave %s", usage);
    return r->title && r->format != PICTURE_SVG ? fonts_check_letters_of_title_available(r->title) : OK;
}

static status plot_words_read(struct plot_words *w, int argc, char **argv)
{
    w->request = (struct plot_request){.projection = {.normal = -1, .camera = camera_isometric}};
    for (int k = 1; k < argc; k++) {
        if (strcmp(argv[k], "--overwrite") == 0) {
            w->request.overwrite = true;
        } else if (argv[k][0] == '-') {
            TRY(read_option(w, argv[k], k + 1 < argc ? argv[k + 1] : NULL));
            k++;
        } else if (w->request.folder) {
            return status_set(REFUSED, "plot: %s is a second folder; give only one folder", argv[k]);
        } else
            w->request.folder = argv[k];
    }
    TRY(settle_format(w));
    return words_together(w);
}

static status check_folder(const char *folder)
{
    if (path_exists(folder) && !path_is_folder(folder))
        return status_set(REFUSED,
                          "%s is a file; give the folder of a run; to draw a scene use `cleave plot --scene %s`",
                          printable_name(folder).text, printable_name(folder).text);
    if (folder_contains_study_table(folder))
        return status_set(REFUSED,
                          "%s contains a study, whose pictures are in %s/pictures; give the folder of one of its runs",
                          printable_name(folder).text, printable_name(folder).text);
    if (!run_folder_has_file(folder, "frames.hdf.series") && !run_folder_has_file(folder, "history.csv"))
        return status_set(
            REFUSED,
            "%s contains no run (neither frames nor history.csv); give the folder that cleave run prints at its end",
            folder);
    return strlen(folder) + PATH_NAME_ROOM < PATH_ROOM
               ? OK
               : status_set(FAILED, "%s: the name is too long; choose a shorter one", folder);
}

/* Returns true if `out`, the argument of -o, names a folder: one that exists, or a name that ends in / or has no
 * ending. */
static bool is_folder_name(const char *out)
{
    const size_t length = strlen(out);
    const char *slash = strrchr(out, '/');
    if (path_is_folder(out) || (length > 0 && out[length - 1] == '/')) return true;
    return length > 0 && !path_exists(out) && !strchr(slash ? slash : out, '.');
}

static status draw_words(const struct plot_words *w)
{
    const struct plot_request *r = &w->request;
    if (w->scene.scene) return scene_draw_picture(w->scene.scene, w->scene.override, w->scene.overrides, r);
    INVARIANT(r->folder);
    TRY(check_folder(r->folder));
    const bool one = r->field || r->projection.outside || r->projection.normal >= 0 ||
                     (r->out && !is_folder_name(r->out)) || picture_format_is_video(r->format);
    return one ? field_draw_picture_or_video(r) : run_draw_standard_pictures(r);
}

status command_plot_main(int argc, char **argv)
{
    struct plot_words w = {.scene.override = NEW("arguments.override", argc, struct scene_override),
                           .size.dpi = PICTURE_DPI};
    status s = plot_words_read(&w, argc, argv);
    picture_size_set_process_wide(w.size);
    if (s == OK) s = draw_words(&w);
    arguments_free(&w.scene);
    memory_free(w.range);
    return s;
}
