/* `cleave plot DIR`: pictures of a finished or running run. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "auto/scene_read.h"
#include "base/memory.h"
#include "output/output_files.h"
#include "output/pictures.h"
#include "plot/plot.h"
#include "output/summary_read.h"

enum { PANELS = 6, PANELS_MAX = 24, PATH_LENGTH = 4096, TITLE_LENGTH = 256 };

struct request {
    const char *folder;
    int panels;
    bool every;                          /* also one picture a frame */
};

struct run_frames {
    int listed;
    struct listed_frame *list;           /* [listed] */
    int shown;
    struct listed_frame *show;           /* [shown] frames of the panels */
};

/* ---- units ------------------------------------------------------------------------------------------------------- */

struct unit unit_for(double largest, const char *name)
{
    static const struct { double factor; const char *prefix; } si[] = {
        {1e9, "G"}, {1e6, "M"}, {1e3, "k"}, {1, ""}, {1e-3, "m"}, {1e-6, "µ"}, {1e-9, "n"}, {1e-12, "p"}};
    struct unit u = {1, ""};
    int k = 0;
    while (k + 1 < (int)COUNT_OF(si) && fabs(largest) < si[k].factor * 0.9995) k++;
    if (!(fabs(largest) > 1e-15)) k = 3;             /* zero or not finite: no prefix */
    u.factor = si[k].factor;
    snprintf(u.name, sizeof u.name, "%s%s", si[k].prefix, name);
    return u;
}

struct unit unit_for_length(double largest)
{
    return largest > 5e-4 && largest < 10 ? (struct unit){1e-3, "mm"} : unit_for(largest, "m");
}

/* ---- command line ------------------------------------------------------------------------------------------------ */

/* Reads the value of --frames: all, last, or a number of panels. */
static status read_frames_option(struct request *r, const char *text)
{
    char *end;
    r->every = strcmp(text, "all") == 0;
    if (r->every) return OK;
    r->panels = strcmp(text, "last") == 0 ? 1 : 0;
    if (r->panels == 1) return OK;
    long n = strtol(text, &end, 10);
    if (end == text || *end != '\0' || n < 1 || n > PANELS_MAX)
        return status_set(REFUSED, "plot: --frames %s: all, last, or a number from 1 to %d is expected", text,
                          PANELS_MAX);
    r->panels = (int)n;
    return OK;
}

static status read_request(struct request *r, int argc, char **argv)
{
    *r = (struct request){.panels = PANELS};
    for (int k = 1; k < argc; k++) {
        if (strcmp(argv[k], "--frames") == 0) {
            if (k + 1 == argc) return status_set(REFUSED, "plot: --frames needs all, last, or a number");
            TRY(read_frames_option(r, argv[++k]));
        } else if (argv[k][0] == '-') {
            return status_set(REFUSED, "plot: unknown option %s; usage: cleave plot DIR [--frames all|last|N]",
                              argv[k]);
        } else if (r->folder != NULL) {
            return status_set(REFUSED, "plot: one folder at a time; %s is one too many", argv[k]);
        } else {
            r->folder = argv[k];
        }
    }
    if (r->folder == NULL) return status_set(REFUSED, "plot: which run? usage: cleave plot DIR [--frames all|last|N]");
    return OK;
}

/* ---- frames ------------------------------------------------------------------------------------------------------ */

bool run_holds(const char *folder, const char *name)
{
    char path[PATH_LENGTH];
    struct stat found;
    return snprintf(path, sizeof path, "%s/%s", folder, name) < (int)sizeof path && stat(path, &found) == 0;
}

status run_frame(struct frame *f, const char *folder, int number)
{
    char path[PATH_LENGTH];
    if (snprintf(path, sizeof path, "%s/frames/%06d.hdf", folder, number) >= (int)sizeof path)
        return status_set(FAILED, "%s: the name is too long", folder);
    return frame_read(f, path);
}

/* Frames evenly spread from the first to the last; a single one is the last. */
static void spread_frames(struct run_frames *r, int panels)
{
    r->shown = r->listed < panels ? r->listed : panels;
    r->show = NEW("plot.show", r->shown, struct listed_frame);
    for (int k = 0; k < r->shown; k++)
        r->show[k] = r->list[r->shown == 1 ? r->listed - 1 : (int)lround((double)k * (r->listed - 1) / (r->shown - 1))];
}

/* Title `name, method: what`, with layer c if given; parts that are unknown are left out. */
static void compose_title(char *title, const char *folder, const char *what, const struct cloud *c)
{
    char name[NAME_MAX_LENGTH], method[NAME_MAX_LENGTH], layer[NAME_MAX_LENGTH] = "";
    if (summary_string(folder, "name", name, sizeof name) != OK) {
        size_t length = strlen(folder);
        while (length > 1 && folder[length - 1] == '/') length--;
        size_t from = length;
        while (from > 0 && folder[from - 1] != '/') from--;
        snprintf(name, sizeof name, "%.*s", (int)(length - from), folder + from);
    }
    bool known = summary_string(folder, "method", method, sizeof method) == OK;
    if (c != NULL && c->normal >= 0) {
        struct unit metre = unit_for_length(fmax(fabs(c->layer), c->spacing));
        snprintf(layer, sizeof layer, ", layer %c = %.4g %s", 'x' + c->normal, c->layer / metre.factor, metre.name);
    }
    snprintf(title, TITLE_LENGTH, "%s%s%s: %s%s", name, known ? ", " : "", known ? method : "", what, layer);
}

/* ---- maps -------------------------------------------------------------------------------------------------------- */

/* The rectangle that holds all clouds with a margin of one spacing or a fiftieth, and the range of damage. */
static struct view view_of(const struct cloud *cloud, int clouds)
{
    struct view v = {.from = {INFINITY, INFINITY}, .to = {-INFINITY, -INFINITY}, .top = 0.5};
    for (int c = 0; c < clouds; c++) {
        for (int64_t i = 0; i < cloud[c].n; i++) {
            for (int k = 0; k < 2; k++) {
                v.from[k] = fmin(v.from[k], cloud[c].place[k][i]);
                v.to[k] = fmax(v.to[k], cloud[c].place[k][i]);
            }
            v.top = fmax(v.top, fmin(cloud[c].damage[i], 1));
        }
    }
    v.top = ceil(10 * v.top - 1e-3) / 10;            /* the colour bar ends on a tenth, 0.5 at least */
    double longest = fmax(v.to[0] - v.from[0], v.to[1] - v.from[1]);
    for (int k = 0; k < 2; k++) {
        double margin = fmax(cloud[0].spacing, 0.02 * longest);
        if (!(margin > 0)) margin = 1e-3;            /* a single particle: a millimetre round it [m] */
        v.from[k] -= margin;
        v.to[k] += margin;
    }
    return v;
}

static status draw_map(const struct request *r, const char *path, enum map map, const struct view *view,
                       const struct cloud *cloud, int clouds)
{
    char title[TITLE_LENGTH], what[40] = "damage";
    if (map == MAP_KIND) snprintf(what, sizeof what, "method and damage");
    if (map == MAP_FRAGMENT) snprintf(what, sizeof what, "%d fragments", (int)cloud[0].fragments);
    compose_title(title, r->folder, what, &cloud[0]);
    return maps_draw(path, title, map, view, cloud, clouds);
}

/* Draws one picture of each kind per frame. */
static status draw_every(const struct request *r, const struct run_frames *frames, const struct view *view)
{
    for (int k = 0; k < frames->listed; k++) {
        struct frame f;
        struct cloud c;
        const int number = frames->list[k].number;
        TRY(run_frame(&f, r->folder, number));
        cloud_make(&c, &f);
        frame_free(&f);
        status s = draw_map(r, picture_path_of_frame(r->folder, DRAWN_DAMAGE, number).text, MAP_DAMAGE, view, &c, 1);
        if (s == OK) s = draw_map(r, picture_path_of_frame(r->folder, DRAWN_KIND, number).text, MAP_KIND, view, &c, 1);
        cloud_free(&c);
        TRY(s);
    }
    return OK;
}

static status draw_views(const struct request *r, const struct run_frames *frames, const struct cloud *cloud,
                         const struct scene *scene)
{
    struct view view = view_of(cloud, frames->shown);
    if (scene && scene->dim == 2) view.notches = scene->cracks, view.notch = scene->crack;
    if (!isfinite(view.to[0] - view.from[0]) || !isfinite(view.to[1] - view.from[1]))
        return status_set(FAILED, "%s: the frames hold no particles, or places that are not numbers", r->folder);
    TRY(draw_map(r, picture_path(r->folder, DRAWN_DAMAGE).text, MAP_DAMAGE, &view, cloud, frames->shown));
    TRY(draw_map(r, picture_path(r->folder, DRAWN_KIND).text, MAP_KIND, &view, cloud, frames->shown));
    TRY(draw_map(r, picture_path(r->folder, DRAWN_LAST).text, MAP_DAMAGE, &view, &cloud[frames->shown - 1], 1));
    if (cloud[frames->shown - 1].fragments > 1)
        TRY(draw_map(r, picture_path(r->folder, DRAWN_FRAGMENTS).text, MAP_FRAGMENT, &view, &cloud[frames->shown - 1],
                     1));
    return r->every ? draw_every(r, frames, &view) : OK;
}

/* The scene, as run, has the pre-cracks; pictures of a folder without one go without. */
static status draw_maps(const struct request *r, const struct run_frames *frames, const struct cloud *cloud)
{
    struct scene scene;
    const bool known = scene_read(&scene, path_join(r->folder, "scene.yaml").text, NULL, 0) == OK;
    const status s = draw_views(r, frames, cloud, known ? &scene : NULL);
    if (known) scene_free(&scene);
    return s;
}

/* Draws the profiles of a bar beside its closed form, without the frame of t = 0. */
static status plot_draw_bar(const struct request *r, const struct run_frames *frames, const char *probe)
{
    char title[TITLE_LENGTH];
    const int skipped = frames->shown > 1 && frames->show[0].number == 0;
    compose_title(title, r->folder, "beside the exact solution", NULL);
    return bar_draw(picture_path(r->folder, DRAWN_PROFILES).text, title, r->folder, probe, frames->show + skipped,
                    frames->shown - skipped);
}

/* Draws profiles of a bar: beside its closed form if a probe has one, else of the particles. */
static status draw_profiles(const struct request *r, const struct run_frames *frames)
{
    char title[TITLE_LENGTH], probe[NAME_MAX_LENGTH];
    if (bar_probe(r->folder, probe)) return plot_draw_bar(r, frames, probe);
    struct frame *f = NEW("plot.frames", frames->shown, struct frame);
    status s = OK;
    int read = 0;
    while (s == OK && read < frames->shown) {
        s = run_frame(&f[read], r->folder, frames->show[read].number);
        if (s == OK) read++;
    }
    compose_title(title, r->folder, "profiles", NULL);
    if (s == OK) s = profiles_draw(picture_path(r->folder, DRAWN_PROFILES).text, title, f, frames->shown);
    for (int k = 0; k < read; k++) frame_free(&f[k]);
    memory_free(f);
    return s;
}

static status draw_clouds(const struct request *r, const struct run_frames *frames)
{
    struct cloud *cloud = NEW("plot.clouds", frames->shown, struct cloud);
    status s = OK;
    for (int k = 0; s == OK && k < frames->shown; k++) {
        struct frame f;
        s = run_frame(&f, r->folder, frames->show[k].number);
        if (s != OK) break;
        cloud_make(&cloud[k], &f);
        frame_free(&f);
    }
    if (s == OK) s = draw_maps(r, frames, cloud);
    for (int k = 0; k < frames->shown; k++) cloud_free(&cloud[k]);
    memory_free(cloud);
    return s;
}

static status draw_frames(const struct request *r)
{
    struct run_frames frames = {0};
    TRY(frames_list(r->folder, &frames.listed, &frames.list));
    if (frames.listed > 0) {
        struct frame last;
        spread_frames(&frames, r->panels);
        status s = run_frame(&last, r->folder, frames.list[frames.listed - 1].number);
        int dim = s == OK ? last.dim : 0;
        if (s == OK) frame_free(&last);
        if (s == OK) s = dim == 1 ? draw_profiles(r, &frames) : draw_clouds(r, &frames);
        memory_free(frames.show);
        memory_free(frames.list);
        return s;
    }
    memory_free(frames.list);
    return OK;
}

status command_plot(int argc, char **argv)
{
    struct request r;
    char title[TITLE_LENGTH];
    TRY(read_request(&r, argc, argv));
    bool frames = run_holds(r.folder, "frames.hdf.series"), history = run_holds(r.folder, "history.csv");
    if (!frames && !history) return status_set(REFUSED, "%s: no run there: neither frames nor history.csv", r.folder);
    if (strlen(r.folder) + PATH_NAME_ROOM >= PATH_ROOM)
        return status_set(FAILED, "%s: the name is too long", r.folder);
    const struct path pictures = pictures_folder(r.folder);
    if (path_is_link(pictures.text))
        return status_set(REFUSED, "%s is a link: pictures would be made somewhere else; remove it", pictures.text);
    if (mkdir(pictures.text, 0777) != 0 && errno != EEXIST)
        return status_set(FAILED, "%s: %s", pictures.text, strerror(errno));
    if (frames) TRY(draw_frames(&r));
    compose_title(title, r.folder, "", NULL);
    if (history) TRY(curves_draw(r.folder, title));
    if (printf("pictures in %s\n", shown_name(pictures.text).text) < 0 || fflush(stdout) != 0)
        return status_set(FAILED, "standard output: %s", strerror(errno));
    return OK;
}
