/* Draws pictures of maps of damage, particle kind and fields: panels with their axes, and titles. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "curves_parts.h"
#include "maps_parts.h"

/* Writes to gnuplot the panel number `place`, counted row by row from 0: the map of the particles `plotted` of one
 * frame, with axes and title. l: layout; shown: map and view; second: unit of the time in the title; lowest: true if no
 * panel is below this one, so that its horizontal axis has labels. */
static void plot_maps_draw_panel(FILE *to, const struct maps_layout *l, const struct maps_content *shown,
                                 const struct plotted_particles *plotted, const struct unit *second, int place,
                                 bool lowest)
{
    const struct view *view = shown->view;
    int column = place % l->columns, row = place / l->columns;
    double from[2], step[2];
    int size[2] = {l->panel_width, l->panel_height};
    const struct unit metre = panel_choose_length_unit_of_axes(view);
    const double left = l->left + column * (l->panel_width + l->gap),
                 above = l->above + row * (l->panel_height + GAP_Y);
    panel_write_margins(to, l, left, above);
    for (int k = 0; k < 2; k++) {
        from[k] = view->from[k] / metre.factor;
        step[k] = (view->to[k] - view->from[k]) / metre.factor / size[k];
        fprintf(to, "set %crange [%.12g:%.12g]\n", 'x' + k, from[k], view->to[k] / metre.factor);
    }
    char state[NAME_MAX_LENGTH];
    if (frame_compose_label_if_static(state, plotted->in_steps, plotted->equilibrium, plotted->t, plotted->step))
        fprintf(to, "set title '%s'", state);
    else
        fprintf(to, "set title 't = %.3g %s'", plotted->t / second->factor, second->name);
    fputs(" font ',13' offset 0,-0.5\n", to);
    if (plotted->position[2])
        fputs("unset xtics\nunset ytics\nunset xlabel\nunset ylabel\nset border 0\nunset arrow\n", to);
    else
        panel_write_axes(to, l, view, plotted, &metre, column, lowest);
    if (plotted->position[2] && row == l->rows - 1 && column == 0)
        panel_write_axis_arrows(to, l, view, plotted, &metre, left, above);
    const int fines[2] = {gnuplot_image_pixel_count_along_edge(shown->format, size[0]),
                          gnuplot_image_pixel_count_along_edge(shown->format, size[1])};
    for (int k = 0; k < 2; k++) step[k] *= (double)size[k] / fines[k];
    struct colour *pixel = NEW("plot.pixel", (int64_t)fines[0] * fines[1], struct colour);
    image_paint_particles_in_plane(pixel, fines[0], fines[1], view, plotted, shown->map);
    panel_write_image(to, pixel, fines[0], fines[1], from, step, "");
    memory_free(pixel);
}

status picture_draw_panels_of_frames(struct output_picture output, const char *title, enum map map,
                                     const struct view *view, const struct plotted_particles *frame_particles,
                                     int frame_count)
{
    struct gnuplot g;
    char text[TITLE_LENGTH];
    title_append_count_of_particles_outside_view(text, title, view->outside);
    struct maps_content shown = {
        .map = map, .view = view, .title = text, .format = output.format, .outside = frame_particles[0].position[2]};
    bool rigid = false;
    for (int k = 0; k < frame_count; k++) rigid = rigid || view_shows_any_rigid_body(view, &frame_particles[k]);
    map_key_collect_entries(&shown.key, map, view, rigid);
    const double aspect = (view->to[1] - view->from[1]) / (view->to[0] - view->from[0]);
    TRY(maps_layout_check_panels_fit(&shown, frame_count, aspect));
    const struct maps_layout l = maps_layout_choose(&shown, frame_count, aspect);
    TRY(gnuplot_open(&g, output.path, output.format, l.width, l.height));
    fputs("set multiplot\nunset grid\n", g.to);
    gnuplot_write_title(&g, text, l.title);
    map_key_draw(g.to, &l, &shown.key);
    struct unit second = unit_with_si_prefix_for_largest_value(frame_particles[frame_count - 1].t, "s");
    for (int k = 0; k < frame_count; k++) {
        plot_maps_draw_panel(g.to, &l, &shown, &frame_particles[k], &second, k, k + l.columns >= frame_count);
        fputs("unset label\nunset object\n", g.to); /* drawn once for all panels */
    }
    if (map_quantity_has_colour_bar(map)) map_colour_bar_draw(g.to, &l, &shown, frame_particles[frame_count - 1].n);
    fputs("unset multiplot\n", g.to);
    return gnuplot_close(&g);
}
