/* Draws the standard pictures of a simulation, which may still be running, from its results folder. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "output/output_files.h"
#include "output/pictures.h"
#include "curves_parts.h"
#include "scene/scene_read.h"

/* ---- maps -------------------------------------------------------------------------------------------------------- */

/* Returns the path of the standard picture `which` in the folder r->pictures, with the ending of the format that the
 * request r gives. */
static struct path sheet_path(const struct plot_request *r, enum picture which)
{
    return picture_path(r->pictures, which, picture_ending[r->format]);
}

static status draw_map(const struct plot_request *r, const char *path, enum map map, const struct view *view,
                       const struct plotted_particles *cloud, int clouds)
{
    char title[TITLE_LENGTH], what[64] = "damage";
    if (map == MAP_KIND) snprintf(what, sizeof what, "method and damage");
    if (map == MAP_FRAGMENT) snprintf(what, sizeof what, "%d fragments", (int)cloud[0].fragments);
    if (map == MAP_CRACKS) snprintf(what, sizeof what, "cracks, where damage is above %.2f", CRACK_DAMAGE);
    if (map == MAP_FIELD) plot_field_write_label(what, sizeof what, view->field);
    picture_compose_title(title, r, what, &cloud[0], view);
    return picture_draw_panels_of_frames((struct output_picture){path, r->format}, title, map, view, cloud, clouds);
}

/* Quantities that occur in the selected output frames of a run, by which it is decided which maps are drawn. */
struct contents {
    bool damage, cracks, kinds; /* a particle is damaged; one is on a crack; there are two kinds of particles */
    double cracked;             /* share of particles on cracks in the last frame [1] */
};

static struct contents contents_of(const struct plotted_particles *cloud, int clouds)
{
    struct contents has = {0};
    for (int c = 0; c < clouds; c++)
        for (int64_t i = 0; i < cloud[c].n; i++) {
            has.damage |= cloud[c].damage[i] > 0;
            has.cracks |= cloud[c].damage[i] >= CRACK_DAMAGE;
            has.cracked += c == clouds - 1 && cloud[c].damage[i] >= CRACK_DAMAGE;
            has.kinds |= cloud[c].kind[i] != cloud[0].kind[0];
        }
    has.cracked /= fmax((double)cloud[clouds - 1].n, 1);
    return has;
}

/* Draws, for every output frame of a run, a picture of each of the maps of damage, kinds of particles and the chosen
 * field. A map is omitted if the selected frames do not contain its quantity. r: request; frames: frames of the run;
 * view: shown rectangle and colours; has: quantities that the selected frames contain. Returns FAILED, with a message,
 * if a frame cannot be read or gnuplot fails. */
static status draw_every(const struct plot_request *r, const struct run_frames *frames, const struct view *view,
                         const struct contents *has)
{
    char field[NAME_MAX_LENGTH];
    const enum map map = colour_map_kind_for_field(view->field);
    for (int k = 0; k < frames->listed; k++) {
        struct plotted_particles c;
        const int number = frames->list[k].number;
        status s = plotted_particles_read(&c, r->folder, &frames->list[k], &r->projection);
        if (s != OK) return s;
        if (has->damage)
            s = draw_map(r, picture_path_of_frame(r->pictures, DRAWN_DAMAGE, number).text, MAP_DAMAGE, view, &c, 1);
        if (s == OK && has->kinds)
            s = draw_map(r, picture_path_of_frame(r->pictures, DRAWN_KIND, number).text, MAP_KIND, view, &c, 1);
        snprintf(field, sizeof field, "%.40s_%06d", view->field->name, number);
        if (s == OK && map == MAP_FIELD)
            s = draw_map(r, picture_path_of_field(r->pictures, field, "png").text, map, view, &c, 1);
        plotted_particles_free(&c);
        TRY(s);
    }
    return OK;
}

/* Draws for request r the maps of damage, of the chosen field, of the kinds of particles and of fragments of a plane
 * body or a slice. A map is omitted if the output frames do not contain its quantity. cloud[frames->shown]: drawn
 * particles of the selected frames. If r->every is set, also draws these maps for every frame of the run. Returns
 * REFUSED if the colour range or the crop of the request is not valid, FAILED if a frame cannot be read or gnuplot
 * fails, with a message. */
static status draw_flat(const struct plot_request *r, const struct run_frames *frames,
                        const struct plotted_particles *cloud)
{
    struct view view, own; /* own: colours of the last frame alone */
    const struct plotted_particles *last = &cloud[frames->shown - 1];
    struct contents has = contents_of(cloud, frames->shown);
    TRY(view_make_for_request(&view, r, cloud, frames->shown));
    TRY(view_make_for_request(&own, r, last, 1));
    const enum map map = colour_map_kind_for_field(view.field);
    has.damage = map == MAP_DAMAGE && (has.damage || view.notches > 0); /* pre-cracks alone are not of interest */
    const struct path damage = sheet_path(r, DRAWN_DAMAGE), kind = sheet_path(r, DRAWN_KIND),
                      latest = sheet_path(r, DRAWN_LAST),
                      field = picture_path_of_field(r->pictures, view.field->name, picture_ending[r->format]);
    const bool something = has.damage || map == MAP_FIELD;
    TRY(has.damage ? draw_map(r, damage.text, MAP_DAMAGE, &view, cloud, frames->shown)
                   : picture_report_not_drawn_and_remove_old(
                         damage.text, "no bond breaks; draw another field with --field von_mises, speed, ..."));
    if (map == MAP_FIELD) TRY(draw_map(r, field.text, map, &view, cloud, frames->shown));
    TRY(has.kinds ? draw_map(r, kind.text, MAP_KIND, &view, cloud, frames->shown)
                  : picture_report_not_drawn_and_remove_old(kind.text, "all particles have the same method"));
    TRY(something || has.kinds ? draw_map(r, latest.text, something ? map : MAP_KIND, &own, last, 1)
                               : picture_report_not_drawn_and_remove_old(latest.text, "nothing happens in this run"));
    if (last->fragments > 1) TRY(draw_map(r, sheet_path(r, DRAWN_FRAGMENTS).text, MAP_FRAGMENT, &view, last, 1));
    return r->every ? draw_every(r, frames, &view, &has) : OK;
}

/* Draws for request r two maps of a three-dimensional run as seen from outside the body: the chosen field and the
 * cracks. cloud[frames->shown]: drawn particles of the selected output frames. Returns REFUSED if the colour range or
 * the crop of the request is not valid, FAILED if gnuplot fails, with a message. */
static status draw_outside(const struct plot_request *r, const struct run_frames *frames,
                           const struct plotted_particles *cloud)
{
    struct view view;
    const struct path cracks = sheet_path(r, DRAWN_CRACKS), surface = sheet_path(r, DRAWN_SURFACE);
    const struct contents has = contents_of(cloud, frames->shown);
    TRY(view_make_for_request(&view, r, cloud, frames->shown));
    const enum map map = colour_map_kind_for_field(view.field);
    TRY(has.damage || map == MAP_FIELD
            ? draw_map(r, surface.text, map, &view, cloud, frames->shown)
            : picture_report_not_drawn_and_remove_old(surface.text, "nothing happens in this run"));
    if (!has.cracks) return picture_report_not_drawn_and_remove_old(cracks.text, "no particle is damaged enough");
    if (has.cracked > 0.5)
        return picture_report_not_drawn_and_remove_old(
            cracks.text, "most particles are damaged, so cracks cannot be distinguished from the rest");
    return draw_map(r, cracks.text, MAP_CRACKS, &view, cloud, frames->shown);
}

/* Type of functions that draw pictures of the selected output frames according to the request r. cloud[frames->shown]:
 * drawn particles of each frame. */
typedef status draw_clouds_fn(const struct plot_request *r, const struct run_frames *frames,
                              const struct plotted_particles *cloud);

/* Reads the drawn particles of all selected output frames and calls draw(r, frames, cloud) with them; frees them
 * afterwards. r: request. Returns FAILED, with a message, if a frame cannot be read, else the status of `draw`. */
static status draw_clouds(const struct plot_request *r, const struct run_frames *frames, draw_clouds_fn *draw)
{
    struct plotted_particles *cloud = NEW("plot.clouds", frames->shown, struct plotted_particles);
    status s = OK;
    for (int k = 0; s == OK && k < frames->shown; k++)
        s = plotted_particles_read(&cloud[k], r->folder, &frames->show[k], &r->projection);
    if (s == OK) s = draw(r, frames, cloud);
    for (int k = 0; k < frames->shown; k++) plotted_particles_free(&cloud[k]);
    memory_free(cloud);
    return s;
}

/* ---- bars -------------------------------------------------------------------------------------------------------- */

/* Draws for request r the profiles of a bar together with its closed-form solution, which the probe of kind EXACT
 * called `probe` has written. Leaves out the frame (output) at t = 0 if there are others among `frames`. Returns
 * FAILED, with a message, if a profile cannot be read or gnuplot fails. */
static status plot_draw_bar(const struct plot_request *r, const struct run_frames *frames, const char *probe)
{
    char title[TITLE_LENGTH];
    const int skipped = frames->shown > 1 && frames->show[0].number == 0;
    picture_compose_title(title, r, "beside the exact solution", NULL, NULL);
    return bar_profiles_draw_with_exact_solution((struct output_picture){sheet_path(r, DRAWN_PROFILES).text, r->format},
                                                 title, r->folder, probe, frames->show + skipped,
                                                 frames->shown - skipped);
}

/* Draws for request r profiles of a bar at the selected frames (output times): with the closed-form solution if the
 * run has a probe of kind EXACT, which compares the bar with it, else from the particles. Returns FAILED, with a
 * message, if a frame cannot be read or gnuplot fails. */
static status draw_profiles(const struct plot_request *r, const struct run_frames *frames)
{
    char title[TITLE_LENGTH], probe[NAME_MAX_LENGTH];
    if (run_find_exact_solution_probe(r->folder, probe)) return plot_draw_bar(r, frames, probe);
    struct output_frame *f = NULL;
    TRY(frames_read_selected(&f, r->folder, frames));
    picture_compose_title(title, r, "profiles", NULL, NULL);
    const status s = bar_profiles_draw((struct output_picture){sheet_path(r, DRAWN_PROFILES).text, r->format}, title,
                                       &r->projection, f, frames->shown);
    frames_free(f, frames->shown);
    return s;
}

/* ---- all --------------------------------------------------------------------------------------------------------- */

/* Draws for request r the maps of a run in two or three dimensions: those of a slice and, in 3D, of an outside view.
 * frames: selected output frames; last: the last of them, read. Returns REFUSED if no particle is in the requested
 * slice, or the colour range or the crop of the request is not valid; FAILED if a frame cannot be read or gnuplot
 * fails; with a message. */
static status draw_solid(struct plot_request *r, const struct run_frames *frames, const struct output_frame *last)
{
    r->projection.outside = false;
    TRY(plot_field_choose_default(&r->projection.field, r->folder, frames));
    TRY(projection_choose_slice_normal_and_position(
        &r->projection, last, run_frame_path(r->folder, frames->show[frames->shown - 1].number).text));
    TRY(draw_clouds(r, frames, draw_flat));
    if (last->dim < 3) return OK;
    r->projection.outside = true;
    return draw_clouds(r, frames, draw_outside);
}

static status draw_frames(struct plot_request *r)
{
    struct run_frames frames;
    struct output_frame last;
    TRY(run_frames_list_and_select(&frames, r));
    status s = run_read_frame(&last, r->folder, frames.show[frames.shown - 1].number);
    if (s == OK) {
        s = last.dim == 1 ? draw_profiles(r, &frames) : draw_solid(r, &frames, &last);
        frame_free(&last);
    }
    run_frames_free(&frames);
    return s;
}

static status draw_pictures(struct plot_request *r)
{
    char title[TITLE_LENGTH];
    const bool frames = run_folder_has_file(r->folder, "frames.hdf.series"),
               history = run_folder_has_file(r->folder, "history.csv");
    TRY(pictures_folder_create(r->pictures, r->overwrite));
    if (frames) TRY(draw_frames(r));
    picture_compose_title(title, r, "", NULL, NULL);
    if (history) TRY(history_curves_draw(r, title));
    if (printf("pictures in %s\n", printable_name(r->pictures).text) < 0 || fflush(stdout) != 0)
        return status_set(FAILED, "standard output: %s", strerror(errno));
    return OK;
}

status run_draw_standard_pictures(const struct plot_request *request)
{
    struct plot_request r = *request;
    struct scene scene;
    struct path pictures = pictures_folder(r.folder);
    if (r.out) snprintf(pictures.text, sizeof pictures.text, "%s", r.out);
    for (size_t end = strlen(pictures.text); end > 1 && pictures.text[end - 1] == '/'; end--)
        pictures.text[end - 1] = '\0';
    if (strlen(pictures.text) + PATH_NAME_ROOM >= PATH_ROOM)
        return status_set(REFUSED, "%s: the name is too long; choose a shorter one",
                          printable_name(pictures.text).text);
    r.pictures = pictures.text;
    if (r.panels == 0) r.panels = PANELS;
    r.projection.in_steps = run_has_load_steps(r.folder);
    const bool known = scene_read(&scene, path_join(r.folder, "scene.yaml").text, NULL, 0) == OK;
    r.projection.scene = known ? &scene : NULL;
    const status s = draw_pictures(&r);
    if (known) scene_free(&scene);
    return s;
}
