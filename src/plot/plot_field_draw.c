/* Draws one field of a run as a picture or a film, for `cleave plot DIR --field NAME`. */
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "output/output_files.h"
#include "output/pictures.h"
#include "plot/film.h"
#include "curves_parts.h"
#include "scene/scene_read.h"

/* Determines *path, the path of the picture of a field: the option -o of the request r, or a file in DIR/pictures, a
 * folder that is created. field: name of the field. Returns REFUSED if the file may not be replaced, FAILED if the
 * folder cannot be created, both with a message. */
static status field_path(struct path *path, const struct plot_request *r, const char *field)
{
    const char *ending = picture_ending[r->format];
    const struct path pictures = pictures_folder(r->folder),
                      usual = picture_path_of_field(pictures.text, field, ending);
    if (!r->out) {
        *path = usual;
        return pictures_folder_create(pictures.text, r->overwrite);
    }
    return picture_choose_path_by_output_option(path, r->out, strrchr(usual.text, '/') + 1, r->overwrite);
}

static bool same_everywhere(const struct plotted_particles *cloud, int clouds)
{
    for (int c = 0; c < clouds; c++)
        for (int64_t i = 0; i < cloud[c].n; i++)
            if (cloud[c].value[i] != cloud[0].value[0]) return false;
    return true;
}

static void field_title(char *title, const struct plot_request *r, const struct plotted_particles *plotted,
                        const struct view *view)
{
    char name[TITLE_LENGTH];
    plot_field_write_label(name, sizeof name, r->projection.field);
    picture_compose_title(title, r, name, plotted, view);
}

/* Prints the named values `categories` of a field, such as the names of materials, to standard output: the first ones
 * by name, then the number of further ones. */
static void say_categories(const struct categories *categories)
{
    for (int i = 0; i < categories->n; i++) printf("%s%s", i ? ", " : ": ", categories->of[i].name);
    if (categories->more > 0) printf(" and %d more", categories->more);
    putchar('\n');
}

/* Prints which field the request r has drawn to the file `path`, with the number `frames` of the `listed` frames, the
 * number of particles and the range of the colours of `view` in SI units. Returns FAILED if standard output cannot be
 * written. */
static status say_field(const char *path, const struct view *view, const struct plot_request *r, int frames, int listed,
                        int64_t particles)
{
    char of_all[32] = "";
    const bool damage = colour_map_kind_for_field(r->projection.field) == MAP_DAMAGE;
    if (r->every && frames < listed) snprintf(of_all, sizeof of_all, " of %d", listed);
    printf("%s: %s of %d%s frame%s, %lld particles", printable_name(path).text, r->projection.field->name, frames,
           of_all, frames > 1 ? "s" : "", (long long)particles);
    if (view->categories)
        say_categories(view->categories);
    else
        printf(", colours from %.4g to %.4g%s%s%s\n", damage ? view->bottom : view->low,
               damage ? view->top : view->high, *r->projection.field->unit ? " " : "", r->projection.field->unit,
               view->beyond[0] + view->beyond[1] > 0 ? ", some values beyond" : "");
    return ferror(stdout) || fflush(stdout) != 0 ? status_set(FAILED, "cannot write to standard output") : OK;
}

static status draw_field_clouds(const struct plot_request *r, const char *path, const struct plotted_particles *cloud,
                                int clouds, int listed)
{
    char title[TITLE_LENGTH];
    struct view view;
    TRY(view_make_for_request(&view, r, cloud, clouds));
    if (same_everywhere(cloud, clouds)) {
        char why[96];
        snprintf(why, sizeof why, "%s is %.4g%s%s everywhere", r->projection.field->name, cloud[0].value[0],
                 *r->projection.field->unit ? " " : "", r->projection.field->unit);
        return picture_report_not_drawn_and_remove_old(path, why);
    }
    field_title(title, r, &cloud[0], &view);
    const enum map map = colour_map_kind_for_field(r->projection.field);
    struct categories categories;
    if (map == MAP_CATEGORY) {
        categories_list_values_present_in_frames(&categories, r->projection.field, r->folder, cloud, clouds);
        view.categories = &categories;
    }
    const struct output_picture sheet = {path, r->format};
    TRY(picture_format_is_video(r->format)
            ? video_draw_and_encode_frames(sheet, r->fps, title, map, &view, cloud, clouds)
            : picture_draw_panels_of_frames(sheet, title, map, &view, cloud, clouds));
    return say_field(path, &view, r, clouds, listed, cloud[clouds - 1].n);
}

static status draw_field_map(const struct plot_request *r, const char *path, const struct run_frames *frames)
{
    struct plotted_particles *cloud = NEW("plot.clouds", frames->shown, struct plotted_particles);
    status s = OK;
    for (int k = 0; s == OK && k < frames->shown; k++)
        s = plotted_particles_read(&cloud[k], r->folder, &frames->show[k], &r->projection);
    if (s == OK) s = draw_field_clouds(r, path, cloud, frames->shown, frames->listed);
    for (int k = 0; k < frames->shown; k++) plotted_particles_free(&cloud[k]);
    memory_free(cloud);
    return s;
}

static status draw_field_bar(const struct plot_request *r, const char *path, const struct run_frames *frames)
{
    char title[TITLE_LENGTH];
    struct output_frame *f = NULL;
    const char *of_maps = r->range[0]                 ? "--range"
                          : r->table                  ? "--colours"
                          : r->cropped                ? "--crop"
                          : r->projection.magnify > 0 ? "--magnify"
                                                      : NULL;
    if (of_maps)
        return status_set(
            REFUSED, "plot: %s is for maps, but a run in one dimension has curves only; remove this option", of_maps);
    if (picture_format_is_video(r->format))
        return status_set(REFUSED, "plot: --format %s: runs in one dimension have no films; use png, svg or pdf",
                          picture_ending[r->format]);
    TRY(frames_read_selected(&f, r->folder, frames));
    float **value = NEW("plot.values", frames->shown, float *);
    status s = OK;
    for (int k = 0; s == OK && k < frames->shown; k++)
        s = plot_field_read(&value[k], r->projection.field, &f[k],
                            run_frame_path(r->folder, frames->show[k].number).text);
    field_title(title, r, NULL, NULL);
    if (s == OK)
        s = field_profiles_draw((struct output_picture){path, r->format}, title, &r->projection, value, f,
                                frames->shown);
    for (int k = 0; k < frames->shown; k++) memory_free(value[k]);
    memory_free(value);
    frames_free(f, frames->shown);
    if (s == OK &&
        printf("%s: %s of %d frames\n", printable_name(path).text, r->projection.field->name, frames->shown) < 0)
        s = status_set(FAILED, "cannot write to standard output");
    return s;
}

/* Checks that the slice or the outside view of the request r suits a run in `dim` dimensions. Returns REFUSED, with a
 * message, if the request has one of them and the run has one or two dimensions, else OK. */
static status projection_check(const struct plot_request *r, int dim)
{
    if (dim == 3 || (!r->projection.placed && r->projection.normal < 0 && !r->projection.outside)) return OK;
    return status_set(REFUSED,
                      "plot: %s needs a run with space: solid, but this one has %d dimension%s; remove this option",
                      r->projection.outside ? "--view" : "--slice", dim, dim > 1 ? "s" : "");
}

/* Returns REFUSED, with a message, if the request r gives the ends or the table of a colour scale although its field
 * consists of named values, such as materials, each of which has a fixed colour. */
static status scale_check(const struct plot_request *r)
{
    if (r->projection.field->scale != CATEGORY || (!r->table && !r->range[0])) return OK;
    return status_set(REFUSED, "plot: %s: the field %s has one colour for each value and no scale; remove this option",
                      r->table ? "--colours" : "--range", r->projection.field->name);
}

static status field_of_frames(struct plot_request *r, const struct run_frames *frames)
{
    struct output_frame last;
    struct path path;
    const int number = frames->show[frames->shown - 1].number;
    TRY(run_read_frame(&last, r->folder, number));
    const int dim = last.dim;
    status s = projection_check(r, dim);
    if (s == OK && r->field) s = plot_field_find_by_name(&r->projection.field, r->field, dim);
    if (s == OK && !r->field) s = plot_field_choose_default(&r->projection.field, r->folder, frames);
    if (s == OK) s = scale_check(r);
    if (s == OK && r->field && strcmp(r->field, "principal_stress") == 0)
        fprintf(stderr, "plot: principal_stress is the largest of the three; draw the others by --field "
                        "principal_stress_2 and principal_stress_3\n");
    if (s == OK && dim == 3 && r->projection.normal < 0) r->projection.outside = true;
    if (s == OK)
        s = projection_choose_slice_normal_and_position(&r->projection, &last, run_frame_path(r->folder, number).text);
    frame_free(&last);
    TRY(s);
    TRY(field_path(&path, r, r->projection.field->name));
    return dim == 1 ? draw_field_bar(r, path.text, frames) : draw_field_map(r, path.text, frames);
}

status field_draw_picture_or_video(const struct plot_request *request)
{
    struct plot_request r = *request;
    struct run_frames frames;
    struct scene scene;
    if (picture_format_is_video(r.format)) TRY(video_check_encoder_is_installed());
    if (r.panels == 0) r.panels = picture_format_is_video(r.format) ? INT_MAX : r.every ? PANELS_MAX : PANELS;
    r.projection.in_steps = run_has_load_steps(r.folder);
    TRY(run_frames_list_and_select(&frames, &r));
    const bool known = scene_read(&scene, path_join(r.folder, "scene.yaml").text, NULL, 0) == OK;
    r.projection.scene = known ? &scene : NULL;
    const status s = field_of_frames(&r, &frames);
    if (known) scene_free(&scene);
    run_frames_free(&frames);
    return s;
}
