/* Draws a scene in its initial state, for `cleave plot --scene SCENE`. Particles, loads and mesh cells are created by
 * run_set_up_from_scene, as in a run, so that the picture shows what will be computed. */
#include "plot/scene_picture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/memory_stream.h"
#include "maps_parts.h"
#include "output/output_files.h"
#include "scene/scene_read.h"
#include "scene_marks.h"
#include "step/report.h"
#include "mesh/mesh_part.h"

/* Layout of the picture of a scene [pixel]: margins of the panel, largest and smallest size of the panel, width of the
 * key (legend) and height of its lines. *_NARROW: in narrow pictures, which have the key below the panel;
 * ABOVE_UNTITLED: upper margin without a title. */
enum { PICTURE_LEFT = 100, PICTURE_KEY = 400, PICTURE_ABOVE = 66, PICTURE_BELOW = 66, KEY_LINE = 23 };
enum { LEFT_NARROW = 74, RIGHT_NARROW = 18, ABOVE_NARROW = 44, BELOW_NARROW = 82, KEY_LINE_NARROW = 18 };
enum { PANEL_WIDEST = 860, PANEL_HIGHEST = 760, PANEL_LOWEST = 90, ABOVE_UNTITLED = 18 };

/* Constants of the key (legend). KEY_LETTERS: largest size of its letters [point]; SAMPLE: width of an entry without
 * its text [pixel]; KEY_BESIDE: blank beside the key of a narrow picture [pixel]. In a narrow picture with several
 * columns of entries, SAMPLE_NARROW is the width of an entry without its text, and GNUPLOT_LETTER the width that
 * gnuplot assumes for a letter [pixel]. */
static const double KEY_LETTERS = 12, SAMPLE = 50, KEY_BESIDE = 6;
static const double SAMPLE_NARROW = 44, GNUPLOT_LETTER = 7.06;
enum { TEXT_ROOM = 200 };

/* Brightness of peridynamic particles relative to material points of the same body [1]. */
static const double PERIDYNAMIC = 0.72;

/* Half height with which the particles of a bar are drawn, relative to the length of the bar. */
static const double BAR_HALF = 0.02;

/* ---- particles --------------------------------------------------------------------------------------------------- */

/* Returns the number that determines the colour of particle i of p: that of its material in the file of scene s, or of
 * its body if all bodies have the same material. */
static int part_number(const struct scene *s, const struct particles *p, int64_t i)
{
    return s->materials > 1 ? s->material_number[p->material[i]] : p->body[i];
}

/* Appends a square to `plotted`, the particles of the picture, at the position x[dim] [m] projected on the picture
 * plane. size: edge of the square [m]; colour: its colour. */
static void cloud_add(struct plotted_particles *plotted, const real *x, int dim, double size, struct colour colour)
{
    const double *axis[3] = {plotted->camera.right, plotted->camera.up, plotted->camera.towards};
    for (int a = 0; a < 3; a++) {
        double sum = 0;
        for (int d = 0; d < dim; d++) sum += axis[a][d] * x[d];
        if (plotted->position[a]) plotted->position[a][plotted->n] = sum;
        if (a < 2) plotted->from[a] = fmin(plotted->from[a], sum), plotted->to[a] = fmax(plotted->to[a], sum);
    }
    plotted->size[plotted->n] = (float)size;
    plotted->colour[plotted->n++] = colour;
}

/* Returns the edge of the square or cube by which particle i of p is drawn [m]. For a particle that was read from a
 * file it follows from its volume, which may vary in a list; for others it is the spacing of the scene s. */
static real particle_size(const struct scene *s, const struct particles *p, int64_t i)
{
    if (!s->body[p->body[i]].file || s->dim < 2) return s->spacing;
    const real whole = lattice_particle_volume(scene_cross_section_or_thickness(s), s->spacing, s->dim);
    return s->spacing * pow(p->volume0[i] / whole, 1.0 / s->dim);
}

/* Appends the squares of n = p->n particles p to `plotted`, the particles of the picture, coloured by material or body.
 * With `spacing` NULL, p are the particles of the run, with sizes by particle_size; if the run has material points and
 * peridynamic particles, the latter are darker. Otherwise p are points that represent coarse cells, and spacing[n] are
 * the edges of their squares [m]. part: all particles of the run. */
static void cloud_add_particles(struct plotted_particles *plotted, const struct scene *s, const struct particles *part,
                                const struct particles *p, const real *spacing)
{
    const bool both = part->n_of[KIND_PD] > 0 && part->n_of[KIND_MPM] > 0;
    for (int64_t i = 0; i < p->n; i++) {
        struct colour colour = colour_of_material_or_body(part_number(s, p, i));
        real x[DIM_MAX];
        for (int d = 0; d < p->dim; d++) x[d] = spacing ? p->X[d][i] : p->x[d][i];
        if (both && !spacing && p->kind[i] == KIND_PD) colour = colour_mixed_with_black(colour, PERIDYNAMIC);
        cloud_add(plotted, x, p->dim, spacing ? spacing[i] : particle_size(s, p, i), colour);
    }
}

/* Adds the rigid bodies of the scene s in their initial positions to `plotted`, the particles of the picture. In 1D
 * each rigid body is drawn as one particle of the length of the body. part: particles of the run. */
static void cloud_add_rigids(struct plotted_particles *plotted, const struct scene *s, const struct particles *part)
{
    struct rigid_placement *at = NEW("plot.rigid", s->rigids, struct rigid_placement);
    real low[DIM_MAX], high[DIM_MAX];
    for (int d = 0; d < s->dim; d++) particles_coordinate_range(part, part->n, d, &low[d], &high[d]);
    for (int b = 0; b < s->rigids; b++)
        for (int d = 0; d < DIM_MAX; d++) at[b].turn[d][d] = 1;
    plotted_particles_add_placed_rigid_bodies(plotted, s, at, low, high);
    for (int b = 0; b < plotted->rigids && s->dim == 1; b++) {
        const struct plotted_rigid_body *r = &plotted->rigid[b];
        const real middle[DIM_MAX] = {0.5 * (r->low[0] + r->high[0])};
        cloud_add(plotted, middle, 1, r->high[0] - r->low[0], rigid_body_colour(MAP_CATEGORY));
    }
    memory_free(at);
}

/* Collects everything in the run that the picture shows as squares, cubes or bodies in `plotted`, the particles of the
 * picture: the particles, the points of coarse mesh cells, and the rigid bodies. camera: direction of the view of a
 * body in 3D. Release `plotted` with plotted_particles_free. */
static void scene_cloud(struct plotted_particles *plotted, struct run *run, const struct camera *camera)
{
    const struct scene *s = run->scene;
    const bool hollow = coarse_cell_points_interpolate_for_output(run->frame, &run->part, s->material, false);
    const int64_t room = run->part.n + (hollow ? run->frame->shown.part.n : 0) + s->rigids;
    *plotted = (struct plotted_particles){.axis = {0, 1},
                                          .normal = -1,
                                          .spacing = s->spacing,
                                          .aligned = true,
                                          .camera = s->dim == 3 ? *camera : camera_along_axis(2, 1),
                                          .from = {INFINITY, INFINITY},
                                          .to = {-INFINITY, -INFINITY}};
    for (int a = 0; a < (s->dim == 3 ? 3 : 2); a++) plotted->position[a] = NEW("plot.position", room, double);
    plotted->damage = NEW("plot.damage", room, float);
    plotted->size = NEW("plot.size", room, float);
    plotted->colour = NEW("plot.colour", room, struct colour);
    cloud_add_particles(plotted, run->scene, &run->part, &run->part, NULL);
    if (hollow)
        cloud_add_particles(plotted, run->scene, &run->part, &run->frame->shown.part, run->frame->shown.spacing);
    cloud_add_rigids(plotted, s, &run->part);
    if (s->dim == 1) plotted->tall = BAR_HALF * (plotted->to[0] - plotted->from[0]);
}

/* ---- key --------------------------------------------------------------------------------------------------------- */

/* Returns the number of particles of the material with the number `number` in the scene file, or of the body with this
 * index if all bodies have the same material. Particles in coarse cells are not counted. part: all particles. */
static int64_t count_part(const struct particles *part, const struct scene *scene, int number)
{
    int64_t n = 0;
    for (int64_t i = 0; i < part->n; i++) n += part_number(scene, part, i) == number;
    return n;
}

/* Writes a description of the rigid body b for the key (legend) to text[TEXT_ROOM], for example `ball: rigid, 4.1 g,
 * 150 m/s`. dim: dimension of the scene. */
static void rigid_words(char *text, const struct scene_body *b, int dim)
{
    double speed = 0;
    int length = snprintf(text, TEXT_ROOM, "%.48s: rigid", b->name);
    for (int d = 0; d < dim; d++) speed += square(b->velocity[d]);
    const struct unit mass = unit_with_si_prefix_for_largest_value(1e3 * b->mass, "g"),
                      fast = unit_with_si_prefix_for_largest_value(sqrt(speed), "m/s");
    if (b->mass > 0)
        length +=
            snprintf(text + length, (size_t)(TEXT_ROOM - length), ", %.3g %s", 1e3 * b->mass / mass.factor, mass.name);
    if (speed > 0)
        snprintf(text + length, (size_t)(TEXT_ROOM - length), ", %.3g %s", sqrt(speed) / fast.factor, fast.name);
}

static void key_of_parts(struct scene_overlay *overlay)
{
    const struct run *run = overlay->engine;
    const struct scene *s = run->scene;
    const int parts = s->materials > 1 ? s->materials + s->unused_materials : s->bodies;
    char text[TEXT_ROOM];
    for (int k = 0; k < parts; k++) {
        const int64_t n = count_part(&run->part, run->scene, k);
        const char *name = s->materials > 1 ? scene_find_material_by_number(s, k)->name
                           : s->bodies > 1  ? s->body[k].name
                                            : s->material->name;
        if (n == 0) continue;
        if (overlay->plain)
            snprintf(text, sizeof text, "%.48s", name);
        else
            snprintf(text, sizeof text, "%.48s: %lld particles%s", name, (long long)n,
                     run->part.n < run->part.n_body ? " are made" : "");
        scene_overlay_add_colour_to_key(overlay, colour_of_material_or_body(k), text);
    }
    if (run->part.n_of[KIND_PD] > 0 && run->part.n_of[KIND_MPM] > 0) {
        if (overlay->plain)
            snprintf(text, sizeof text, "darker: peridynamic");
        else
            snprintf(text, sizeof text, "darker: %lld peridynamic", (long long)run->part.n_of[KIND_PD]);
        scene_overlay_add_colour_to_key(overlay, colour_mixed_with_black(colour_of_material_or_body(0), PERIDYNAMIC),
                                        text);
    }
    for (int b = s->bodies; b < s->bodies + s->rigids; b++) {
        rigid_words(text, &s->body[b], s->dim);
        scene_overlay_add_colour_to_key(overlay, rigid_body_colour(MAP_CATEGORY), text);
    }
}

/* ---- the picture ------------------------------------------------------------------------------------------------- */

/* Returns a view of the particles `plotted` of a scene whose rectangle has a margin of `arrow` [m], the length of the
 * longest arrow of a load, around the body. */
static struct view scene_view(const struct plotted_particles *plotted, double arrow)
{
    struct view v = view_make_around_particles(plotted, 1);
    for (int a = 0; a < 2; a++) v.from[a] -= arrow, v.to[a] += arrow;
    v.outside = 0;
    return v;
}

static double arrow_length(const struct plotted_particles *plotted)
{
    return 0.07 * fmax(plotted->to[0] - plotted->from[0], plotted->to[1] - plotted->from[1]);
}

/* Returns how many entries of the key (legend) of `overlay` fit into one row below a panel of the width `wide` [pixel],
 * at least 1, from the length of the longest entry. (In several columns, gnuplot makes the key no wider than the
 * panel.) */
static int key_columns(const struct scene_overlay *overlay, double wide)
{
    return (int)fmax(floor(wide / (SAMPLE_NARROW + KEY_LETTERS * overlay->widest)), 1);
}

/* Returns the layout of a picture that shows the view v in one panel, and the key (legend) of m. untitled: the picture
 * has no title; outside: the view is of a body in 3D from outside, so that no axis needs space on the left. If panel
 * and key do not fit into the size that the user chose (picture_size_set_process_wide), the layout is of a larger
 * picture with the same ratio of width and height. */
static struct maps_layout scene_layout(const struct view *v, const struct scene_overlay *overlay, bool untitled,
                                       bool outside)
{
    const bool narrow = picture_size_is_too_narrow_for_side_legend();
    const struct picture_size given = picture_size_get_process_wide();
    struct maps_layout l = {
        .columns = 1, .rows = 1, .left = PICTURE_LEFT, .above = PICTURE_ABOVE, .right = PICTURE_KEY};
    l.below = PICTURE_BELOW;
    const double aspect = (v->to[1] - v->from[1]) / (v->to[0] - v->from[0]);
    if (narrow) l.left = outside ? RIGHT_NARROW : LEFT_NARROW, l.above = ABOVE_NARROW, l.right = RIGHT_NARROW;
    if (!outside)
        l.left = (int)fmax(
            l.left, panel_vertical_axis_labels_width(v, aspect * (narrow ? given.width - l.left : PANEL_WIDEST)));
    l.key_columns = narrow ? key_columns(overlay, given.width - l.left - l.right) : 1;
    const int lines = (overlay->keys + l.key_columns - 1) / l.key_columns;
    if (narrow) l.below = BELOW_NARROW + KEY_LINE_NARROW * lines;
    if (untitled) l.above = ABOVE_UNTITLED;
    const double widest = given.width ? given.width - l.left - l.right : PANEL_WIDEST;
    const double highest = given.height ? given.height - l.above - l.below : PANEL_HIGHEST;
    const double width = fmin(widest, highest / aspect);
    l.panel_width = (int)fmax(lround(width), PANEL_LOWEST);
    l.panel_height = (int)fmax(lround(width * aspect), PANEL_LOWEST);
    l.width = l.left + l.panel_width + l.right;
    l.height = l.above + l.panel_height + l.below;
    if (!narrow && l.height < 60 + KEY_LINE * lines) l.height = 60 + KEY_LINE * lines;
    if (given.width > 0) {
        const double high = given.height ? (double)l.height / given.height : 0;
        const double scale = fmax(1, fmax((double)l.width / given.width, high));
        l.width = (int)lround(scale * given.width);
        if (given.height) l.height = (int)lround(scale * given.height);
    }
    return l;
}

/* Writes to gnuplot the command that places the key (legend) of a scene: beside the panel, or below it in a narrow
 * picture. Letters are made smaller if the longest line of the key in `overlay` requires it. l: layout of the
 * picture. */
static void set_scene_key(FILE *to, const struct maps_layout *l, const struct scene_overlay *overlay)
{
    const bool narrow = picture_size_is_too_narrow_for_side_legend();
    const double x = narrow ? KEY_BESIDE : l->left + l->panel_width + 14,
                 room = (l->width - x) / l->key_columns - SAMPLE;
    const double size = l->key_columns > 1 ? KEY_LETTERS : fmin(KEY_LETTERS, room / overlay->widest);
    fprintf(to,
            "set key at screen %.6g,%.6g left top Left reverse horizontal maxcols %d maxrows %d samplen 2 spacing 1.15 "
            "width %.3g "
            "font ',%.3g'\n",
            x / l->width, 1 - (narrow ? l->above + l->panel_height + BELOW_NARROW - 4.0 : l->above - 8.0) / l->height,
            l->key_columns, (overlay->keys + l->key_columns - 1) / l->key_columns,
            l->key_columns > 1 ? KEY_LETTERS * overlay->widest / GNUPLOT_LETTER - overlay->letters : 0.0, size);
}

/* Writes the title of the picture of scene s to gnuplot g: `title`, or if it is NULL the name of the scene and the
 * number of its particles `part`. */
static void draw_scene_title(struct gnuplot *g, const struct scene *s, const struct particles *part, const char *title)
{
    const struct unit metre = unit_for_length(s->spacing);
    char text[TEXT_ROOM];
    snprintf(text, sizeof text, "%.60s before it runs: %lld particles, spacing %.4g %s", s->name,
             (long long)part->n_body, s->spacing / metre.factor, metre.name);
    gnuplot_write_title(g, title ? title : text,
                        picture_size_is_too_narrow_for_side_legend() ? LEFT_NARROW : PICTURE_LEFT);
}

static void set_panel(FILE *to, const struct maps_layout *l, const struct view *v,
                      const struct plotted_particles *plotted, const struct unit *metre)
{
    panel_write_margins(to, l, l->left, l->above);
    for (int a = 0; a < 2; a++)
        fprintf(to, "set %crange [%.12g:%.12g]\n", 'x' + a, v->from[a] / metre->factor, v->to[a] / metre->factor);
    if (plotted->position[2]) {
        fputs("unset xtics\nunset ytics\nunset xlabel\nunset ylabel\nset border 0\n", to);
        panel_write_axis_arrows(to, l, v, plotted, metre, l->left, l->above);
    } else
        panel_write_axes(to, l, v, plotted, metre, 0, true);
    if (plotted->tall > 0) fputs("unset ytics\nset ylabel ''\nset border 1\n", to);
}

/* Writes to gnuplot one plot command that draws the image of the particles `plotted` in the view v, and the marks over
 * it. l: layout; metre: unit of the axes; marks: elements of the plot command for the marks; format: format of the
 * picture. */
static void plot_scene(FILE *to, const struct maps_layout *l, const struct view *v,
                       const struct plotted_particles *plotted, const struct unit *metre, const char *marks,
                       enum picture_format format)
{
    double step[2], from[2];
    const int size[2] = {gnuplot_image_pixel_count_along_edge(format, l->panel_width),
                         gnuplot_image_pixel_count_along_edge(format, l->panel_height)};
    struct colour *pixel = NEW("plot.pixel", (int64_t)size[0] * size[1], struct colour);
    for (int a = 0; a < 2; a++)
        from[a] = v->from[a] / metre->factor, step[a] = (v->to[a] - v->from[a]) / metre->factor / size[a];
    image_paint_particles_as_cubes(pixel, size[0], size[1], v, plotted, MAP_DAMAGE);
    if (!plotted->position[2] && plotted->dim > 1)
        image_paint_rigid_bodies_in_plane(pixel, size[0], size[1], v, plotted);
    panel_write_image(to, pixel, size[0], size[1], from, step, marks);
    memory_free(pixel);
}

/* Collects all marks of a scene (loads, supports, velocities, pre-cracks, probes, cells, regions) and their entries in
 * the key (legend) in *m. */
static void draw_marks(struct scene_overlay *overlay)
{
    key_of_parts(overlay);
    scene_overlay_draw_coarse_cell_outlines(overlay);
    scene_overlay_draw_region_boxes(overlay);
    scene_overlay_draw_precracks(overlay);
    scene_overlay_draw_load_symbols(overlay);
    scene_overlay_draw_velocity_arrows(overlay);
    scene_overlay_draw_probe_symbols(overlay);
}

/* Draws the particles `plotted` and the marks `overlay` of a scene in the view v to the picture `sheet` (file and
 * size). metre: unit of the axes; data: gnuplot commands with the data of the marks; elements: arguments of the plot
 * command for the marks. Returns FAILED, with a message, if gnuplot fails. */
static status draw_collected(struct output_picture sheet, const struct scene_overlay *overlay, const struct view *v,
                             const struct plotted_particles *plotted, const struct unit *metre, const char *data,
                             const char *elements)
{
    struct gnuplot g;
    const struct maps_layout l = scene_layout(v, overlay, overlay->title && !overlay->title[0], plotted->position[2]);
    TRY(gnuplot_open_scaled_to_process_wide_size(&g, sheet.path, sheet.format, l.width, l.height));
    fputs("unset grid\n", g.to);
    draw_scene_title(&g, overlay->engine->scene, &overlay->engine->part, overlay->title);
    fputs(data, g.to);
    set_panel(g.to, &l, v, plotted, metre);
    set_scene_key(g.to, &l, overlay);
    plot_scene(g.to, &l, v, plotted, metre, elements, sheet.format);
    return gnuplot_close(&g);
}

/* Draws the run, whose particles are in `plotted`, the particles of the picture, to the picture `sheet` (file and
 * size). title: title of the picture, or NULL for the name of the scene with the number of particles. Returns FAILED,
 * with a message, if gnuplot fails. */
static status draw_scene(struct output_picture sheet, struct run *run, struct plotted_particles *plotted,
                         const char *title)
{
    char *elements = NULL, *data = NULL;
    size_t length = 0, bytes = 0;
    const double arrow = arrow_length(plotted);
    const struct view v = scene_view(plotted, arrow);
    const struct unit metre = panel_choose_length_unit_of_axes(&v);
    struct scene_overlay m = {.to = memory_stream_open(&data, &bytes),
                              .plot = memory_stream_open(&elements, &length),
                              .engine = run,
                              .camera = plotted->camera,
                              .metre = metre.factor,
                              .arrow = arrow,
                              .title = title,
                              .plain = picture_size_is_too_narrow_for_side_legend()};
    if (m.to && m.plot) draw_marks(&m);
    bool whole = m.to && fclose(m.to) == 0;
    whole = m.plot && fclose(m.plot) == 0 && whole;
    const status drawn = whole ? draw_collected(sheet, &m, &v, plotted, &metre, data, elements)
                               : status_set(FAILED, "%s: out of memory", sheet.path);
    free(data);
    free(elements);
    return drawn;
}

/* ---- command ----------------------------------------------------------------------------------------------------- */

/* Determines *path, the path of the picture of scene s: the option -o of the request r, or a file in results/. Returns
 * REFUSED, with a message, if the file may not be replaced. */
static status scene_sheet(struct path *path, const struct scene *s, const struct plot_request *r)
{
    char name[sizeof s->name + 16];
    snprintf(name, sizeof name, "%s_scene.%s", s->name, picture_ending[r->format]);
    return picture_choose_path_by_output_option(path, r->out ? r->out : "results/", name, r->overwrite);
}

/* Creates the run of scene s, draws it as the request r says and prints what was drawn. Returns REFUSED for an
 * outside view of a scene that is not three-dimensional; FAILED if the run cannot be created or gnuplot fails, with a
 * message. */
static status draw_made(struct run *run, const struct scene *s, const struct plot_request *r)
{
    struct path path;
    struct plotted_particles c;
    if (r->projection.outside && s->dim < 3)
        return status_set(
            REFUSED, "plot: --view needs a scene with space: solid, but this one has %d dimension%s; remove --view",
            s->dim, s->dim > 1 ? "s" : "");
    TRY(run_set_up_from_scene(run, s, NULL));
    TRY(scene_sheet(&path, s, r));
    scene_cloud(&c, run, &r->projection.camera);
    const int64_t drawn = run->part.n;
    const status drew = draw_scene((struct output_picture){path.text, r->format}, run, &c, r->title);
    plotted_particles_free(&c);
    TRY(drew);
    if (r->quiet) return OK;
    char rigids[48] = "";
    if (s->rigids > 0) snprintf(rigids, sizeof rigids, "%d rigid bod%s, ", s->rigids, s->rigids == 1 ? "y" : "ies");
    const int said =
        printf("%s: %lld particles, %s%d boundary condition%s, %d pre-crack%s, %d probe%s\n",
               printable_name(path.text).text, (long long)drawn, rigids, s->boundaries, s->boundaries == 1 ? "" : "s",
               s->cracks, s->cracks == 1 ? "" : "s", s->probes, s->probes == 1 ? "" : "s");
    return said < 0 || fflush(stdout) != 0 ? status_set(FAILED, "cannot write to standard output") : OK;
}

status scene_draw_picture(const char *path, const struct scene_override *override, int overrides,
                          const struct plot_request *r)
{
    struct scene s = {0};
    struct run e = {0};
    struct pilot_requirements wish;
    if (picture_format_is_video(r->format))
        return status_set(REFUSED, "plot: --scene draws one picture: use png, svg or pdf");
    TRY(scene_read_unless_pilot_runs_are_needed(&s, &wish, path, override, overrides));
    if (wish.wanted) {
        s = wish.provisional;
        printf("%s: with method: auto the scene has no spacing yet, so it is drawn at %.4g m; `cleave run` chooses "
               "method and spacing\n",
               printable_name(path).text, s.spacing);
    }
    const status result = draw_made(&e, &s, r);
    run_free_memory(&e);
    scene_free(&s);
    return result;
}
