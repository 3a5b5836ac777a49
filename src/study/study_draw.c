/* Pictures of a study: figures over each key that varies, and over two as maps. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "output/output_files.h"
#include "plot/gnuplot.h"
#include "study/study.h"

enum { PANELS_MOST = 6, LINES_MOST = CURVE_COLOURS, WIDE = 3 };

/* One picture: the study, the figures that it shows, the key along its axis. */
struct study_picture {
    const struct study_table *table;
    const struct study *study;
    const struct varied_key *key;
    int across, lines; /* the key along the axis; the key with a line each, -1: one line */
    int figure[PANELS_MOST], panels;
    bool numbers; /* places along the axis are the values; else 0, 1, 2 */
    const char *unit;
};

/* ---- what is shown ----------------------------------------------------------------------------------------------- */

static bool figure_varies(const struct study_table *t, int f)
{
    double least = INFINITY, most = -INFINITY;
    int known = 0;
    for (int c = 0; c < t->cases; c++) {
        if (isnan(t->value[f][c])) continue;
        least = fmin(least, t->value[f][c]), most = fmax(most, t->value[f][c]);
        known++;
    }
    return known > 1 && most - least > 1e-9 * fmax(fabs(most), fabs(least));
}

static void panel_add(struct study_picture *p, int f)
{
    if (f < 0 || p->panels == PANELS_MOST || !figure_varies(p->table, f)) return;
    for (int k = 0; k < p->panels; k++)
        if (p->figure[k] == f) return;
    p->figure[p->panels++] = f;
}

/* What one looks at first: the crack, what probes measure, energies, the time taken. */
static void panels_choose(struct study_picture *p)
{
    static const char *const first[] = {"crack.start_time", "crack.length_end", "crack.angle_deg",
                                        "crack.tip_speed_mean"};
    const struct study_table *t = p->table;
    for (size_t k = 0; k < COUNT_OF(first); k++) panel_add(p, study_figure(t, first[k]));
    if (p->panels == PANELS_MOST) return;
    for (int f = 0; f < t->figures && p->panels < PANELS_MOST - 1; f++)
        if (strncmp(t->figure[f], "probes.", 7) == 0) panel_add(p, f);
    for (int f = 0; f < t->figures && p->panels < PANELS_MOST - 1; f++)
        if (strncmp(t->figure[f], "energy.", 7) == 0 && !study_figure_is_technical(t->figure[f])) panel_add(p, f);
    panel_add(p, study_figure(t, "loop_seconds"));
}

/* Number of a key's value in a run, -1: another one. */
static int value_index(const struct varied_key *key, const struct study_case *c)
{
    const char *own = study_value(c, key->key);
    for (int v = 0; v < key->values; v++)
        if (strcmp(key->value[v], own) == 0) return v;
    return -1;
}

/* Are a key's values numbers of one unit? */
static bool key_is_number(const struct varied_key *key, const char **unit)
{
    for (int v = 0; v < key->values; v++) {
        const char *own;
        if (isnan(value_number(key->value[v], &own)) || (v > 0 && strcmp(own, *unit) != 0)) return false;
        *unit = own;
    }
    return true;
}

/* Keys that change nothing physical: their runs are one point with a bar. */
static bool key_is_chance(const char *key)
{
    return !strcmp(key, "particles.seed") || !strcmp(key, "time.step") || !strcmp(key, "time.safety");
}

/* The key that has a line for each of its values: the next one that varies and has few. */
static int lines_choose(const struct varied_key *key, int keys, int across)
{
    for (int k = 0; k < keys; k++)
        if (k != across && key[k].values > 1 && key[k].values <= LINES_MOST && !key_is_chance(key[k].key)) return k;
    return -1;
}

/* ---- lines with bars --------------------------------------------------------------------------------------------- */

/* Mean over the runs in which the key across has value v and the key of lines has value l, and how far they scatter. */
struct point_of {
    double mean, scatter;
    int runs;
};

static struct point_of point_find(const struct study_picture *p, int figure, int v, int l)
{
    const double *value = p->table->value[figure];
    struct point_of point = {0};
    for (int pass = 0; pass < 2; pass++)
        for (int c = 0; c < p->study->n; c++) {
            const struct study_case *run = &p->study->at[c];
            if (isnan(value[c]) || value_index(&p->key[p->across], run) != v) continue;
            if (p->lines >= 0 && value_index(&p->key[p->lines], run) != l) continue;
            if (pass == 0)
                point.mean += value[c], point.runs++;
            else
                point.scatter += square(value[c] - point.mean / point.runs);
        }
    if (point.runs == 0) return (struct point_of){NAN, NAN, 0};
    point.mean /= point.runs;
    point.scatter = point.runs > 1 ? sqrt(point.scatter / (point.runs - 1)) : 0;
    return point;
}

static void send_points(FILE *to, const struct study_picture *p, int panel)
{
    const struct varied_key *across = &p->key[p->across];
    const int lines = p->lines >= 0 ? p->key[p->lines].values : 1;
    const char *unit;
    for (int l = 0; l < lines; l++) {
        fprintf(to, "$p%d_%d << EOD\n", panel, l);
        for (int v = 0; v < across->values; v++) {
            const struct point_of point = point_find(p, p->figure[panel], v, l);
            const double x = p->numbers ? value_number(across->value[v], &unit) : v;
            if (point.runs > 0) fprintf(to, "%.10g %.10g %.10g\n", x, point.mean, point.scatter);
        }
        fputs("NaN NaN NaN\nEOD\n", to); /* no line has no points: gnuplot would not plot it */
    }
}

/* Places of the values along the axis as tics, where they are words. */
static void send_tics(FILE *to, const char *axis, const struct varied_key *key)
{
    fprintf(to, "set %stics (", axis);
    for (int v = 0; v < key->values; v++) {
        if (v > 0) putc(',', to);
        gnuplot_quote(to, key->value[v]);
        fprintf(to, " %d", v);
    }
    fputs(")\n", to);
}

static void plot_panel(FILE *to, const struct study_picture *p, int panel)
{
    const int lines = p->lines >= 0 ? p->key[p->lines].values : 1;
    fputs("set title ", to);
    gnuplot_quote(to, p->table->figure[p->figure[panel]]);
    fputs("\nplot ", to);
    for (int l = 0; l < lines; l++) {
        fprintf(to,
                "%s$p%d_%d using 1:2 smooth unique with lines lw 1.6 lc rgb '%s' notitle, "
                "$p%d_%d using 1:2:3 with yerrorbars pt 7 ps 0.7 lw 1.4 lc rgb '%s' ",
                l > 0 ? ", " : "", panel, l, curve_colour[l], panel, l, curve_colour[l]);
        if (p->lines < 0 || panel > 0) {
            fputs("notitle", to);
            continue;
        }
        fputs("title ", to);
        gnuplot_quote(to, p->key[p->lines].value[l]);
    }
    putc('\n', to);
}

/* Room of the panels in rows of three; the key of lines above them. */
static int panel_rows(const struct study_picture *p) { return (p->panels + WIDE - 1) / WIDE; }

/* `beside`: room to the right of each panel [characters]. */
static status picture_open(struct gnuplot *g, const struct study_picture *p, const char *name, int beside)
{
    const struct path folder = path_join(p->study->folder, "pictures");
    const int columns = p->panels < WIDE ? p->panels : WIDE;
    TRY(folder_make(folder.text));
    TRY(gnuplot_open(g, path_join(folder.text, name).text, PICTURE_PNG, 80 + 420 * columns, 60 + 340 * panel_rows(p)));
    fprintf(g->to,
            "set multiplot layout %d,%d margins char 10, char %d, char 4, char 5 spacing char %d, char 6\n"
            "set format y '%%.4g'\nset offsets graph 0.04, graph 0.04, graph 0.08, graph 0.08\n",
            panel_rows(p), columns, 3 + beside, 11 + beside);
    return OK;
}

static status draw_lines(const struct study_picture *p)
{
    char name[CASE_NAME_ROOM + 8];
    struct gnuplot g;
    snprintf(name, sizeof name, "%.*s.png", CASE_NAME_ROOM, p->key[p->across].key);
    for (char *c = name; *c; c++)
        if (*c == '/') *c = '_';
    TRY(picture_open(&g, p, name, 0));
    for (int panel = 0; panel < p->panels; panel++) send_points(g.to, p, panel);
    if (p->numbers)
        fputs("set xtics autofreq\n", g.to);
    else
        send_tics(g.to, "x", &p->key[p->across]);
    char label[512];
    snprintf(label, sizeof label, "%s%s%s%s", p->key[p->across].key, *p->unit ? " [" : "", p->unit,
             *p->unit ? "]" : "");
    fputs("set xlabel ", g.to);
    gnuplot_quote(g.to, label);
    fputs("\nset key at screen 0.02,0.99 left top horizontal maxrows 1\n", g.to);
    if (p->lines >= 0) {
        fputs("set label 1 ", g.to);
        gnuplot_quote(g.to, p->key[p->lines].key);
        fputs(" at screen 0.99,0.975 right\n", g.to);
    }
    for (int panel = 0; panel < p->panels; panel++) {
        plot_panel(g.to, p, panel);
        fputs("unset label 1\n", g.to);
    }
    fputs("unset multiplot\n", g.to);
    return gnuplot_close(&g);
}

/* ---- maps -------------------------------------------------------------------------------------------------------- */

static status draw_study_map(const struct study_picture *p)
{
    const struct varied_key *across = &p->key[p->across], *up = &p->key[p->lines];
    struct gnuplot g;
    TRY(picture_open(&g, p, "map.png", 9));
    send_tics(g.to, "x", across);
    send_tics(g.to, "y", up);
    fputs("set format cb '%.4g'\nunset grid\nset palette defined (0 '#fff7bc', 0.5 '#41b6c4', 1 '#081d58')\n"
          "set xlabel ",
          g.to);
    gnuplot_quote(g.to, across->key);
    fputs("\nset ylabel ", g.to);
    gnuplot_quote(g.to, up->key);
    fputs(" offset char -2.5,0\nset offsets\n", g.to);
    fprintf(g.to, "set xrange [-0.5:%g]\nset yrange [-0.5:%g]\n", across->values - 0.5, up->values - 0.5);
    for (int panel = 0; panel < p->panels; panel++) {
        fprintf(g.to, "$m%d << EOD\n", panel);
        for (int l = 0; l < up->values; l++)
            for (int v = 0; v < across->values; v++)
                fprintf(g.to, "%d %d %.10g\n", v, l, point_find(p, p->figure[panel], v, l).mean);
        fputs("EOD\nset title ", g.to);
        gnuplot_quote(g.to, p->table->figure[p->figure[panel]]);
        fprintf(g.to, "\nplot $m%d using 1:2:3 with image notitle\n", panel);
    }
    fputs("unset multiplot\n", g.to);
    return gnuplot_close(&g);
}

/* ---- all --------------------------------------------------------------------------------------------------------- */

status study_draw(const struct study_table *t, const struct study *s, const struct varied_key *key, int keys)
{
    int varied = 0;
    for (int k = 0; k < keys; k++) varied += key[k].values > 1;
    for (int k = 0; k < keys; k++) {
        struct study_picture p = {.table = t, .study = s, .key = key, .across = k, .unit = ""};
        if (key[k].values < 2) continue;
        panels_choose(&p);
        if (p.panels == 0) return OK;
        p.lines = lines_choose(key, keys, k);
        p.numbers = key_is_number(&key[k], &p.unit);
        if (!p.numbers) p.unit = "";
        TRY(draw_lines(&p));
        for (int other = 0; varied == 2 && other < k; other++)
            if (key[other].values > 1) {
                p.lines = other;
                TRY(draw_study_map(&p));
            }
    }
    return OK;
}
