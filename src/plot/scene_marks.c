/* Draws pre-cracks, probes, regions and the outlines of coarse mesh cells over the particles of a scene. */
#include "scene_marks.h"
#include "fracture/tips.h"
#include "probes/probes.h"
#include "mesh/levels.h"
#include "fracture/fracture_part.h"
#include "probes/probes_part.h"
#include "mesh/mesh_part.h"
#include "step/step.h"

#include <math.h>
#include <string.h>

/* ---- marks ------------------------------------------------------------------------------------------------------- */

/* Returns the component of the vector x[dim] along axis[dim], an axis of the picture as a unit vector. */
static double marks_across(const double *axis, const double *x, int dim)
{
    double sum = 0;
    for (int d = 0; d < dim; d++) sum += axis[d] * x[d];
    return sum;
}

void scene_overlay_begin_data_block(struct scene_overlay *overlay)
{
    fprintf(overlay->to, "$m%d << EOD\n", overlay->blocks);
}

void scene_overlay_add_point(struct scene_overlay *overlay, const real *position, const double *arrow)
{
    const int dim = overlay->engine->part.dim;
    fprintf(overlay->to, "%.9g %.9g", marks_across(overlay->camera.right, position, dim) / overlay->metre,
            marks_across(overlay->camera.up, position, dim) / overlay->metre);
    if (arrow)
        fprintf(overlay->to, " %.9g %.9g", marks_across(overlay->camera.right, arrow, dim) / overlay->metre,
                marks_across(overlay->camera.up, arrow, dim) / overlay->metre);
    putc('\n', overlay->to);
}

/* Interrupts the line in the current data block of overlay: positions that follow are not connected with those before.
 */
static void mark_break(struct scene_overlay *overlay) { putc('\n', overlay->to); }

/* Adds an entry `text` to the key (legend) of the picture of m. The entry belongs to the element (line, points or
 * arrows) that was added last to the plot command. */
static void key_line_add(struct scene_overlay *overlay, const char *text)
{
    fputs("title ", overlay->plot);
    gnuplot_write_quoted_string(overlay->plot, text);
    overlay->keys++;
    if ((int)strlen(text) > overlay->letters) overlay->letters = (int)strlen(text);
    overlay->widest = fmax(overlay->widest, text_estimate_width_in_pixels_per_font_point(text, strlen(text)));
}

void scene_overlay_end_data_block(struct scene_overlay *overlay, const char *plot_style, const char *key_entry)
{
    fputs("NaN NaN NaN NaN\nEOD\n", overlay->to); /* a data block must not be empty */
    fprintf(overlay->plot, ", $m%d %s ", overlay->blocks++, plot_style);
    if (!*key_entry) {
        fputs("notitle", overlay->plot);
        return;
    }
    key_line_add(overlay, key_entry);
}

void scene_overlay_add_colour_to_key(struct scene_overlay *overlay, struct colour colour, const char *text)
{
    fprintf(overlay->plot, ", NaN with points pt 5 ps 2 lc rgb '#%02x%02x%02x' ", colour.red, colour.green,
            colour.blue);
    key_line_add(overlay, text);
}

/* ---- cracks ------------------------------------------------------------------------------------------------------ */

/* Cuts the ends of a straight crack in the plane, end[2][DIM_MAX] [m], to the part that has particles of p within a
 * spacing: a crack is often given longer than the body. Leaves a crack without such particles as it is. spacing:
 * lattice spacing [m]. */
static void crack_cut(const struct particles *p, double spacing, real end[2][DIM_MAX])
{
    const real along[2] = {end[1][0] - end[0][0], end[1][1] - end[0][1]}, length = hypot(along[0], along[1]);
    real from = INFINITY, to = -INFINITY;
    for (int64_t i = 0; i < p->n; i++) {
        const real x = p->X[0][i] - end[0][0], y = p->X[1][i] - end[0][1];
        const real s = (x * along[0] + y * along[1]) / length, off = (x * along[1] - y * along[0]) / length;
        if (fabs(off) > spacing || s < -0.5 * spacing || s > length + 0.5 * spacing) continue;
        from = fmin(from, s - 0.5 * spacing), to = fmax(to, s + 0.5 * spacing);
    }
    from = fmax(from, 0), to = fmin(to, length);
    for (int d = 0; d < 2 && from < to; d++)
        end[1][d] = end[0][d] + along[d] * to / length, end[0][d] += along[d] * from / length;
}

/* Sends the outline of the crack c to the current data block of `overlay` as a line, which is closed for a polygon in
 * 3D. */
static void crack_line(struct scene_overlay *overlay, const struct crack *c)
{
    real end[2][DIM_MAX];
    const bool straight = overlay->engine->part.dim == 2 && c->n == 2;
    if (straight) {
        memcpy(end, c->corner, sizeof end);
        crack_cut(&overlay->engine->part, overlay->engine->scene->spacing, end);
    }
    for (int k = 0; k < c->n; k++) scene_overlay_add_point(overlay, straight ? end[k] : c->corner[k], NULL);
    if (c->n > 2) scene_overlay_add_point(overlay, c->corner[0], NULL);
    mark_break(overlay);
}

void scene_overlay_draw_precracks(struct scene_overlay *overlay)
{
    const struct scene *s = overlay->engine->scene;
    char text[96];
    if (s->cracks > 0) {
        scene_overlay_begin_data_block(overlay);
        for (int k = 0; k < s->cracks; k++) crack_line(overlay, &s->crack[k]);
        snprintf(text, sizeof text, "%d pre-crack%s", s->cracks, s->cracks > 1 ? "s" : "");
        scene_overlay_end_data_block(
            overlay, s->dim == 1 ? "with points pt 2 ps 2 lw 3 lc rgb '#7a1020'" : "with lines lw 3.2 lc rgb '#7a1020'",
            text);
    }
    for (int k = 0; k < s->growths; k++) {
        double arrow[DIM_MAX];
        for (int d = 0; d < s->dim; d++) arrow[d] = overlay->arrow * s->growth[k].direction[d];
        snprintf(text, sizeof text, "%.40s: a crack grows from here", s->growth[k].name);
        scene_overlay_begin_data_block(overlay);
        scene_overlay_add_point(overlay, s->growth[k].at, arrow);
        scene_overlay_end_data_block(
            overlay, "using 1:2:3:4 with vectors head filled size screen 0.014,20 lw 2 lc rgb '#7a1020'", text);
    }
}

/* ---- probes ------------------------------------------------------------------------------------------------------ */

/* PROBES_NAMED: largest number of probes that have entries of their own in the key; CIRCLE: number of edges of a drawn
 * circle. */
enum { PROBES_NAMED = 10, CIRCLE = 48 };

/* Sends the edges of the box with the corners from[dim] and to[dim] [m] to the current data block of `overlay` as
 * lines: four in 2D, twelve in 3D. */
static void box_lines(struct scene_overlay *overlay, const real *from, const real *to, int dim)
{
    for (int a = 0; a < dim; a++)
        for (int k = 0; k < 1 << dim; k++) {
            real X[2][DIM_MAX] = {{0}};
            if (k >> a & 1) continue;
            for (int d = 0; d < dim; d++) X[0][d] = X[1][d] = k >> d & 1 ? to[d] : from[d];
            X[1][a] = to[a];
            scene_overlay_add_point(overlay, X[0], NULL);
            scene_overlay_add_point(overlay, X[1], NULL);
            mark_break(overlay);
        }
}

static void circle_line(struct scene_overlay *overlay, const real *centre, double radius)
{
    for (int k = 0; k <= CIRCLE; k++) {
        const double angle = 2 * M_PI * k / CIRCLE;
        const real X[DIM_MAX] = {centre[0] + radius * cos(angle), centre[1] + radius * sin(angle), 0};
        scene_overlay_add_point(overlay, X, NULL);
    }
}

/* Adds a point at the initial position of every crack tip of the run to the current data block of m. */
static void tip_marks(struct scene_overlay *overlay)
{
    const struct crack_tips *t = &overlay->engine->fracture->tips;
    for (int k = 0; k < t->n; k++) scene_overlay_add_point(overlay, t->tip[k].origin, NULL);
}

/* Draws the position, line or region of probe number k of the scene of m. text: entry of the probe in the key, "" for
 * none. Of a probe without a position only the symbol in the key (legend) is drawn. */
static void probe_mark(struct scene_overlay *overlay, int k, const char *text)
{
    const struct scene *s = overlay->engine->scene;
    const struct probe_request *p = &s->probe[k];
    const struct observed_run seen = observed_run_make_read_only_view(overlay->engine);
    real from[DIM_MAX] = {0}, to[DIM_MAX] = {0}, radius;
    static const char point[] = "with points pt 1 ps 1.8 lw 2.4 lc rgb '#5b2a86'";
    static const char line[] = "with lines lw 1.6 dt (7,4) lc rgb '#5b2a86'";
    scene_overlay_begin_data_block(overlay);
    if (probes_locate_sif_contour(&overlay->engine->probing->probes, k, &seen, from, &radius)) {
        circle_line(overlay, from, radius);
        scene_overlay_end_data_block(overlay, line, text);
    } else if (p->kind == PROBE_LINE) {
        scene_overlay_add_point(overlay, p->from, NULL);
        scene_overlay_add_point(overlay, p->to, NULL);
        scene_overlay_end_data_block(overlay, line, text);
    } else if (p->has_at) {
        scene_overlay_add_point(overlay, p->at, NULL);
        scene_overlay_end_data_block(overlay, point, text);
    } else if (p->kind == PROBE_TIP && overlay->engine->fracture->tips.n > 0) {
        tip_marks(overlay);
        scene_overlay_end_data_block(overlay, point, text);
    } else if (p->region.n > 0 && region_compute_bounding_box_if_finite(&p->region, s->dim, from, to)) {
        box_lines(overlay, from, to, s->dim);
        scene_overlay_end_data_block(overlay, line, text);
    } else {
        char words[256] = "";
        if (*text && p->kind == PROBE_REACTION)
            snprintf(words, sizeof words, "%.80s: at %.60s", text, p->boundary);
        else if (*text)
            snprintf(words, sizeof words, "%.80s: everywhere", text);
        scene_overlay_end_data_block(overlay, point, words);
    }
}

void scene_overlay_draw_probe_symbols(struct scene_overlay *overlay)
{
    const struct scene *s = overlay->engine->scene;
    char text[NAME_MAX_LENGTH + 16];
    int more = 0;
    for (int k = 0; k < s->probes; k++) {
        if (k >= PROBES_NAMED) more++;
        snprintf(text, sizeof text, "probe %.60s", s->probe[k].name);
        probe_mark(overlay, k, k < PROBES_NAMED ? text : "");
    }
    if (more == 0) return;
    snprintf(text, sizeof text, "and %d more probes", more);
    scene_overlay_begin_data_block(overlay);
    scene_overlay_end_data_block(overlay, "with points pt 1 ps 1.8 lw 2.4 lc rgb '#5b2a86'", text);
}

/* ---- regions ----------------------------------------------------------------------------------------------------- */

/* Draws the bounding boxes of the named regions of the scene in the picture, and adds their names to the key
 * (legend). */
void scene_overlay_draw_region_boxes(struct scene_overlay *overlay)
{
    const struct scene *s = overlay->engine->scene;
    for (int k = 0; k < s->regions; k++) {
        real from[DIM_MAX] = {0}, to[DIM_MAX] = {0};
        char text[NAME_MAX_LENGTH + 16], how[96];
        if (!region_compute_bounding_box_if_finite(&s->named[k].region, s->dim, from, to)) continue;
        snprintf(text, sizeof text, "region %.60s", s->named[k].name);
        scene_overlay_begin_data_block(overlay);
        box_lines(overlay, from, to, s->dim);
        /* The darker fragment colours; when they repeat, each repetition has another dash pattern. */
        const struct colour c = fragment_colour(1 + k);
        snprintf(how, sizeof how, "with lines lw 2.4 dt (%d,3) lc rgb '#%02x%02x%02x'", 3 + 4 * (k / 9), c.red, c.green,
                 c.blue);
        scene_overlay_end_data_block(overlay, how, text);
    }
}

/* ---- levels ------------------------------------------------------------------------------------------------------ */

/* Returns true if the finest cell number `cell` of l is the cell at the lower corner of the coarse cell that contains
 * it, so that each coarse cell is drawn once. Stores the indices of the finest cell along the axes in k[dim]. */
static bool is_corner_cell(const struct mesh_levels *l, int64_t cell, int64_t *k)
{
    const struct grid *g = &l->fine->grid;
    bool corner = true;
    for (int d = 0; d < g->dim; d++) {
        k[d] = cell / g->stride[d] % g->count[d];
        corner = corner && (k[d] - l->offset[0][d]) % ((int64_t)1 << l->level[cell]) == 0;
    }
    return corner;
}

/* Draws the outlines of all coarse mesh cells of the level `level` >= 1 in the picture of m. Their edge is 2^level
 * times that of the finest cells. Returns the number of these cells. */
static int64_t level_cells_draw(struct scene_overlay *overlay, int level)
{
    const struct mesh_levels *l = &overlay->engine->frame->levels;
    const struct grid *g = &l->fine->grid;
    int64_t n = 0;
    for (int64_t I = 0; I < g->n; I++) {
        int64_t k[DIM_MAX];
        real from[DIM_MAX] = {0}, to[DIM_MAX] = {0};
        if (l->level[I] != level || !is_corner_cell(l, I, k)) continue;
        n++;
        for (int d = 0; d < g->dim; d++)
            from[d] = grid_node_position(g, d, k[d]), to[d] = grid_node_position(g, d, k[d] + ((int64_t)1 << level));
        box_lines(overlay, from, to, g->dim);
    }
    return n;
}

void scene_overlay_draw_coarse_cell_outlines(struct scene_overlay *overlay)
{
    static const char *const colour[LEVELS_MAX + 1] = {"", "#9a9a9a", "#7a7a7a", "#5a5a5a", "#3a3a3a"};
    const struct mesh_levels *l = &overlay->engine->frame->levels;
    for (int level = 1; level <= l->n && overlay->engine->part.dim == 2; level++) {
        char text[96], how[96];
        scene_overlay_begin_data_block(overlay);
        const int64_t n = level_cells_draw(overlay, level);
        snprintf(text, sizeof text, "level %d: %lld cells of %d spacings", level, (long long)n, 2 << level);
        snprintf(how, sizeof how, "with lines lw 0.7 lc rgb '%s'", colour[level]);
        scene_overlay_end_data_block(overlay, how, n > 0 ? text : "");
    }
}
