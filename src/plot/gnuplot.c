/* Starts gnuplot without a shell, sets the common style of pictures and waits for the picture. */
#define _GNU_SOURCE /* asprintf */
#include "plot/gnuplot.h"

#include <ctype.h>
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/interrupt_cleanup.h"
#include "output/output_files.h"
#include "output/picture_file.h"

/* NOT_FOUND: exit status of a child process whose program does not exist, as in shells. TITLE_ROOM: capacity of the
 * text of a heading [byte]. */
enum { NOT_FOUND = 127, TITLE_ROOM = 1024 };

const char *const curve_colour[CURVE_COLOURS] = {
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#3d3d3d",
};

const char *const picture_ending[PICTURE_FORMATS] = {"png", "svg", "pdf", "mp4", "gif"};

bool picture_format_find_by_ending(enum picture_format *format, const char *ending)
{
    for (int k = 0; k < PICTURE_FORMATS; k++)
        if (strcmp(ending, picture_ending[k]) == 0) return *format = (enum picture_format)k, true;
    return false;
}

void gnuplot_write_quoted_string(FILE *file, const char *text)
{
    putc('\'', file);
    for (; *text != '\0'; text++) {
        if (*text == '\'') putc('\'', file); /* a quote is written twice */
        putc(iscntrl((unsigned char)*text) ? ' ' : *text, file);
    }
    putc('\'', file);
}

/* Replaces the child process by gnuplot, with standard input from the pipe pipe_ends[2]. complaints: descriptor of the
 * file for its output and errors. Does not return. */
static _Noreturn void become_gnuplot(const int *pipe_ends, int complaints)
{
    child_process_set_group_and_unblock_signals();
    signal(SIGPIPE, SIG_DFL);
    dup2(pipe_ends[0], STDIN_FILENO);
    dup2(complaints, STDOUT_FILENO);
    dup2(complaints, STDERR_FILENO);
    close(pipe_ends[0]);
    close(pipe_ends[1]);
    setenv("GNUTERM", "unknown", 1);                  /* opens no window */
    execlp("gnuplot", "gnuplot", "-d", (char *)NULL); /* -d: ignores the user's settings */
    _exit(NOT_FOUND);
}

/* Starts gnuplot for the picture g->path. Opens a pipe to its standard input, g->to, and a file for its messages,
 * g->complaints. Returns FAILED, with a message, if gnuplot cannot be started. */
static status gnuplot_start(struct gnuplot *g)
{
    int ends[2];
    remove(g->aside); /* a link of this name is not followed */
    const int own = open(g->aside, O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    g->complaints = own < 0 ? NULL : fdopen(own, "w+"); /* an unlinked file in the folder of the picture */
    if (g->complaints == NULL) return status_set(FAILED, "cannot write %s: %s", g->path, strerror(errno));
    remove(g->aside);
    if (pipe(ends) != 0) return status_set(FAILED, "%s: cannot send commands to gnuplot: %s", g->path, strerror(errno));
    signal(SIGPIPE, SIG_IGN); /* an early end of gnuplot becomes an error instead of a signal */
    g->process = (int)fork();
    if (g->process == 0) become_gnuplot(ends, fileno(g->complaints));
    close(ends[0]);
    if (g->process < 0) {
        close(ends[1]);
        return status_set(FAILED, "%s: gnuplot cannot be started: %s", g->path, strerror(errno));
    }
    g->to = fdopen(ends[1], "w");
    if (g->to != NULL) return OK;
    int cause = errno;
    close(ends[1]); /* an open copy of this end would keep gnuplot waiting for input */
    return status_set(FAILED, "%s: cannot send commands to gnuplot: %s", g->path, strerror(cause));
}

static void set_style(FILE *to)
{
    fputs("set encoding utf8\n"
          "set border 3 lw 0.8 lc rgb '#555555'\n"
          "set tics nomirror out scale 0.5 textcolor rgb '#333333'\n"
          "set format '%g'\n" /* the default format begins with a blank, which shifts the numbers from their tics */
          "set xlabel textcolor rgb '#333333'\nset ylabel textcolor rgb '#333333'\n"
          "set y2label textcolor rgb '#333333'\n"
          "set title textcolor rgb '#222222'\n"
          "set key noautotitle outside right top Left reverse samplen 2 spacing 1.25 textcolor rgb '#222222'\n"
          "set style line 99 lc rgb '#e4e4e4' lw 0.6\n"
          "set grid back ls 99\n",
          to);
    for (int k = 0; k < CURVE_COLOURS; k++)
        fprintf(to, "set linetype %d lc rgb '%s' lw 2.2 pt 7 ps 0.6\n", k + 1, curve_colour[k]);
}

static struct picture_size usual = {.dpi = PICTURE_DPI};
enum { NARROW = 760 }; /* pictures narrower than this have no room beside their panel [pixel] */

void picture_size_set_process_wide(struct picture_size size) { usual = size; }
struct picture_size picture_size_get_process_wide(void) { return usual; }

/* Factors on the size of letters. PDF_LETTERS: in PDF files, whose sizes are in points, so that letters are as large as
 * in PNG files. NARROW_LETTERS: in narrow pictures, whose letters then have 7 points. */
static const double PDF_LETTERS = 0.5, NARROW_LETTERS = 0.8;

/* Writes to gnuplot g the commands that select the terminal for `format`: SVG, PDF, or PNG by pngcairo (antialiased) if
 * gnuplot has it. width, height: size of the picture [pixel]; scale: factor on the size of letters, and in PNG of lines
 * and points. */
static void set_terminal(struct gnuplot *g, enum picture_format format, int width, int height, double scale)
{
    const double letters = picture_size_is_too_narrow_for_side_legend() ? NARROW_LETTERS * scale : scale, lines = scale;
    if (format == PICTURE_SVG)
        fprintf(g->to,
                "set terminal svg size %d,%d font 'Liberation Sans,Helvetica,Arial,sans-serif,14' fontscale %.4g "
                "background rgb 'white' noenhanced\n",
                width, height, letters);
    else if (format == PICTURE_PDF)
        fprintf(g->to,
                "set terminal pdfcairo size %.6gin,%.6gin font 'Liberation Sans,13' fontscale %.4g linewidth "
                "0.5 pointscale 0.5 background rgb 'white' noenhanced\n",
                (double)width / PICTURE_DPI, (double)height / PICTURE_DPI, PDF_LETTERS * letters);
    else {
        const double fine = usual.dpi / PICTURE_DPI;
        const int size[2] = {(int)lround(fine * width), (int)lround(fine * height)};
        fprintf(g->to,
                "if (strstrt(GPVAL_TERMINALS, 'pngcairo') > 0) { set terminal pngcairo size %d,%d "
                "font 'Liberation Sans,13' fontscale %.4g linewidth %.4g pointscale %.4g background rgb 'white' "
                "noenhanced } else { set terminal png size %d,%d noenhanced truecolor }\n",
                size[0], size[1], fine * letters, fine * lines, fine * lines, size[0], size[1]);
    }
    fputs("set output ", g->to);
    gnuplot_write_quoted_string(g->to, g->aside);
    putc('\n', g->to);
}

static void gnuplot_release(struct gnuplot *g)
{
    if (g->to != NULL) fclose(g->to);
    if (g->complaints != NULL) fclose(g->complaints);
    if (g->process > 0) waitpid((pid_t)g->process, NULL, 0);
    free(g->aside);
    free(g->path);
    *g = (struct gnuplot){0};
}

/* Factor on the height of a narrow picture of curves, which has its key (legend) below the panel. */
static const double CURVES_HIGHER = 1.35;

/* Returns the height [pixel] of a picture whose layout is made for width x height [pixel]. It is the height that the
 * user has chosen with picture_size_set_process_wide, if any; else `height`, scaled with the chosen width. A picture of
 * curves so narrow that its key (legend) is below the panel is higher by CURVES_HIGHER. letters: factor on the size of
 * letters, 1 for pictures of curves. */
static int height_for(int width, int height, double letters)
{
    const double scale = usual.width ? (double)usual.width / width : 1;
    if (usual.height) return usual.height;
    return (int)lround(scale * height *
                       (picture_size_is_too_narrow_for_side_legend() && letters == 1 && scale < 1 ? CURVES_HIGHER : 1));
}

/* Opens *g, a process of gnuplot for the picture `path` of the given format. width, height: size of the picture
 * [pixel]; letters: factor on the size of letters. Returns REFUSED if `path` contains control characters, FAILED if
 * gnuplot cannot be started, both with a message. */
static status open_with_letters(struct gnuplot *g, const char *path, enum picture_format format, int width, int height,
                                double letters)
{
    *g = (struct gnuplot){0};
    for (const char *c = path; *c; c++)
        if (iscntrl((unsigned char)*c))
            return status_set(REFUSED,
                              "%s: gnuplot cannot draw into a folder whose name contains a line break or other control "
                              "character; rename it",
                              path);
    g->path = strdup(path);
    /* gnuplot interprets a name that begins with a bar as a command. */
    if (g->path == NULL || asprintf(&g->aside, "%s%s" ASIDE_ENDING, path[0] == '/' ? "" : "./", path) < 0) {
        g->aside = NULL;
        gnuplot_release(g);
        return status_set(FAILED, "%s: out of memory", path);
    }
    g->format = format;
    interrupt_signals_block(true);
    status s = file_check_replaceable(path);
    if (s == OK) s = gnuplot_start(g);
    if (s == OK) interrupt_cleanup_register(LEAVING_PICTURE, g->aside, g->process);
    interrupt_signals_block(false);
    if (s != OK) {
        gnuplot_release(g);
        return s;
    }
    const int high = height_for(width, height, letters);
    set_terminal(g, format, usual.width ? usual.width : width, high, letters);
    set_style(g->to);
    g->width = usual.width && letters == 1 ? usual.width : width;
    g->height = usual.width && letters == 1 ? high : height;
    return OK;
}

status gnuplot_open(struct gnuplot *g, const char *path, enum picture_format format, int width, int height)
{
    return open_with_letters(g, path, format, width, height, 1);
}

status gnuplot_open_scaled_to_process_wide_size(struct gnuplot *g, const char *path, enum picture_format format,
                                                int width, int height)
{
    return open_with_letters(g, path, format, width, height, usual.width ? (double)usual.width / width : 1);
}

/* Least resolution of images in vector formats [pixel/inch]; journals require 300 to 600. */
static const double IMAGE_DPI = 432;

int gnuplot_image_pixel_count_along_edge(enum picture_format format, int layout_pixels)
{
    const bool vector = format == PICTURE_SVG || format == PICTURE_PDF;
    return (int)fmax(lround((vector ? fmax(usual.dpi, IMAGE_DPI) : usual.dpi) / PICTURE_DPI * layout_pixels), 1);
}

bool picture_size_is_too_narrow_for_side_legend(void) { return usual.width > 0 && usual.width < NARROW; }

/* Sizes of letters of titles [point]: in large pictures, in narrow pictures, the smallest one for which a title is not
 * broken into two lines, and the smallest one of all. */
enum { TITLE_LARGE = 16, TITLE_NARROW = 14, TITLE_ONE_LINE = 11, TITLE_SMALL = 7 };

double text_estimate_width_in_pixels_per_font_point(const char *text, size_t byte_count)
{
    static const double PIXELS_PER_POINT = 4.0 / 3, NARROW_LETTER = 0.3, WIDE_LETTER = 0.86, CAPITAL = 0.7,
                        OTHER = 0.56;
    double width = 0;
    for (size_t k = 0; k < byte_count; k++) {
        const unsigned char c = (unsigned char)text[k];
        if ((c & 0xc0) == 0x80) continue;
        width += strchr("ijltfI.,:;'|!()[]/ ", c) ? NARROW_LETTER
                 : strchr("mwMW%@", c)            ? WIDE_LETTER
                 : c >= 0xe3                      ? 1 /* of East Asia */
                 : isupper(c)                     ? CAPITAL
                                                  : OTHER;
    }
    return PIXELS_PER_POINT * (picture_size_is_too_narrow_for_side_legend() ? NARROW_LETTERS : 1) * width;
}

/* Returns the index of the blank nearest to the middle of `text`, at which a title is broken into two lines; the length
 * of the text if it has no blank. */
static size_t break_of(const char *text)
{
    const size_t length = strlen(text);
    size_t best = length;
    for (size_t k = 1; k < length; k++)
        if (text[k] == ' ' && labs(2 * (long)k - (long)length) < labs(2 * (long)best - (long)length)) best = k;
    return best;
}

/* Writes the first `length` bytes of `text`, a line of a title, to part[TITLE_ROOM]. If they are wider than `most`,
 * writes as many as fit, followed by `...`. most: largest width [pixel] divided by the size of the letters in points.
 */
static void write_title_line(char *part, const char *text, size_t length, double most)
{
    const bool cut = text_estimate_width_in_pixels_per_font_point(text, length) > most;
    while (length > 0 && text_estimate_width_in_pixels_per_font_point(text, length) +
                                 (cut ? text_estimate_width_in_pixels_per_font_point("...", 3) : 0) >
                             most)
        length--;
    while (length > 0 && (text[length] & 0xc0) == 0x80) length--; /* no character is cut in two */
    snprintf(part, TITLE_ROOM, "%.*s%s", (int)length, text, cut ? "..." : "");
}

/* Decodes the UTF-8 character at `text` and returns its code point; stores its length in *length [byte]. A byte that
 * begins no character counts as one. */
static unsigned long character_at(const char *text, int *length)
{
    const unsigned char *c = (const unsigned char *)text;
    const int n = *c >= 0xf0 ? 4 : *c >= 0xe0 ? 3 : *c >= 0xc0 ? 2 : 1;
    unsigned long code = n == 1 ? *c : *c & (0xffu >> (n + 1));
    for (*length = 1; *length < n && (c[*length] & 0xc0) == 0x80; ++*length) code = code << 6 | (c[*length] & 0x3fu);
    return code;
}

status fonts_check_letters_of_title_available(const char *text)
{
    enum { IN_ALL_FONTS = 0x250 }; /* first letter after those of Latin script */
    for (int length; *text; text += length) {
        const unsigned long code = character_at(text, &length);
        if (code < IN_ALL_FONTS) continue;
        char command[80];
        snprintf(command, sizeof command, "fc-list :charset=%lx family 2>/dev/null", code);
        FILE *from = popen(command, "r");
        if (!from) return OK;
        const bool found = fgetc(from) != EOF;
        if (pclose(from) == 0 && !found)
            return status_set(REFUSED,
                              "plot: --title: no font of this machine has the letter %.*s; install one (Debian: "
                              "fonts-noto-cjk for East Asia), or write the title with other letters",
                              length, text);
    }
    return OK;
}

void gnuplot_write_title(struct gnuplot *g, const char *text, double left_margin)
{
    g->untitled = !*text;
    const size_t length = strlen(text);
    const double room = g->width - left_margin - 12,
                 most = picture_size_is_too_narrow_for_side_legend() ? TITLE_NARROW : TITLE_LARGE;
    const size_t cut =
        TITLE_ONE_LINE * text_estimate_width_in_pixels_per_font_point(text, length) > room ? break_of(text) : length;
    const double longer = fmax(text_estimate_width_in_pixels_per_font_point(text, cut),
                               text_estimate_width_in_pixels_per_font_point(text + cut, length - cut));
    const double size = fmax(fmin(most, room / fmax(longer, 1)), TITLE_SMALL);
    const double upper = picture_size_is_too_narrow_for_side_legend() ? 20 : 28;
    for (int line = 0; line < 1 + (cut < length); line++) {
        char part[TITLE_ROOM];
        write_title_line(part, line ? text + cut + 1 : text, line ? length - cut - 1 : cut, room / size * (1 + 1e-9));
        fprintf(g->to, "set label %d ", 1 + line);
        gnuplot_write_quoted_string(g->to, part);
        fprintf(g->to, " at screen %.6g,%.6g left font ',%.3g' textcolor rgb '#111111'\n", left_margin / g->width,
                1 - (upper + (cut < length ? 1.25 * size * (line - 0.5) : 0)) / g->height, size);
    }
}

void program_error_output_read_last_line(FILE *file, char *text, size_t size)
{
    char line[256];
    snprintf(text, size, "it gave no reason");
    rewind(file);
    while (fgets(line, sizeof line, file) != NULL) {
        line[strcspn(line, "\n")] = '\0';
        const char *word = line + strspn(line, " \t^");
        if (*word != '\0') snprintf(text, size, "%s", word);
    }
}

status gnuplot_close(struct gnuplot *g)
{
    int ended = 0;
    bool sent = fclose(g->to) == 0;
    g->to = NULL;
    waitpid((pid_t)g->process, &ended, 0);
    g->process = 0;
    status s = OK;
    if (WIFEXITED(ended) && WEXITSTATUS(ended) == NOT_FOUND) {
        s = status_set(FAILED, "gnuplot is missing: install the package gnuplot-nox (Debian, Ubuntu) or gnuplot "
                               "(Fedora, macOS)");
    } else if (!sent || !WIFEXITED(ended) || WEXITSTATUS(ended) != 0) {
        char reason[256];
        program_error_output_read_last_line(g->complaints, reason, sizeof reason);
        s = status_set(FAILED, "%s: gnuplot drew nothing: %s", g->path, reason);
    } else {
        s = picture_complete_and_rename_temporary(g->path, g->format);
    }
    if (s != OK) remove(g->aside);
    interrupt_cleanup_register(LEAVING_PICTURE, NULL, 0);
    gnuplot_release(g);
    return s;
}
