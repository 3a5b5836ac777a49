/* floor 5: curves: crack and share of peridynamics, energies, profiles along a bar. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "history.h"
#include "memory.h"
#include "plot.h"

enum { POINTS_MAX = 4000, PATH_LENGTH = 4096, CURVES_MAX = 8 };

/* What is drawn over time: one row a sample, sent as the gnuplot data block $data. */
struct series {
    const struct history *h;
    int time;                            /* column                            */
    struct unit second;
};

/* Largest |value| of a column; 0 where there is none. */
static double largest_of(const struct history *h, int column)
{
    double largest = 0;
    for (int64_t i = 0; i < h->rows; i++) {
        double a = fabs(history_at(h, i, column));
        if (a > largest && isfinite(a)) largest = a;
    }
    return largest;
}

/* Sends `columns` over time, each divided by its factor; at most POINTS_MAX rows, the last one always. */
static void send_series(FILE *to, const struct series *s, const int *column, const double *factor, int columns)
{
    int64_t stride = s->h->rows / POINTS_MAX + 1;
    fputs("$data << EOD\n", to);
    for (int64_t i = 0; i < s->h->rows; i = i + stride < s->h->rows || i == s->h->rows - 1 ? i + stride : s->h->rows - 1) {
        fprintf(to, "%.9g", history_at(s->h, i, s->time) / s->second.factor);
        for (int k = 0; k < columns; k++) {
            double a = history_at(s->h, i, column[k]) / factor[k];
            if (isfinite(a)) fprintf(to, " %.9g", a);
            else fputs(" NaN", to);
        }
        putc('\n', to);
    }
    fputs("EOD\n", to);
}

static void set_title(FILE *to, const char *title, const char *what)
{
    char text[512];
    snprintf(text, sizeof text, "%s%s", title, what);
    fputs("set title ", to);
    gnuplot_quote(to, text);
    fputs(" font ',16' textcolor rgb '#111111' offset 0,0.4\n", to);
}

static void set_time_axis(FILE *to, const struct series *s)
{
    double end = history_at(s->h, s->h->rows - 1, s->time) / s->second.factor;
    fprintf(to, "set xrange [0:%.9g]\nset xlabel 'time [%s]'\n", end > 0 ? end : 1, s->second.name);
}

/* ---- crack ----------------------------------------------------------------------------------------- */

/* An axis that takes the colour of its curve, from zero to a little above the largest value. */
static void set_axis(FILE *to, const char *axis, const char *label, int colour, double largest)
{
    fprintf(to, "set %slabel '%s' textcolor rgb '%s'\nset %stics nomirror textcolor rgb '%s'\nset %srange [0:%.9g]\n",
            axis, label, curve_colour[colour], axis, curve_colour[colour], axis, largest > 0 ? 1.08 * largest : 1);
}

static status draw_crack(const char *path, const char *title, const struct series *s)
{
    int column[2] = {history_column(s->h, "crack_length"), history_column(s->h, "pd_share")};
    double largest[2] = {largest_of(s->h, column[0]), largest_of(s->h, column[1])};
    struct unit metre = unit_for_length(largest[0]);
    double factor[2] = {metre.factor, 0.01};         /* the share in percent */
    char label[64];
    struct gnuplot g;
    if (column[0] < 0 && column[1] < 0) return OK;
    TRY(gnuplot_open(&g, path, PICTURE_PNG, 1000, 600));
    send_series(g.to, s, column, factor, 2);
    set_title(g.to, title, "crack");
    set_time_axis(g.to, s);
    snprintf(label, sizeof label, "crack length [%s]", metre.name);
    set_axis(g.to, "y", label, 0, largest[0] / factor[0]);
    set_axis(g.to, "y2", "share of peridynamic particles [%]", 1, largest[1] / factor[1]);
    fprintf(g.to, "set border 11\nset key outside center bottom horizontal\n"
                  "plot $data using 1:2 with lines lw 2.4 lc rgb '%s' title 'crack length (left)', "
                  "$data using 1:3 axes x1y2 with lines lw 2.4 dt (12,5) lc rgb '%s' title 'peridynamic share (right)'\n",
            curve_colour[0], curve_colour[1]);
    return gnuplot_close(&g);
}

/* ---- energies -------------------------------------------------------------------------------------- */

struct energies {
    int column[CURVES_MAX];
    const char *label[CURVES_MAX];
    double factor[CURVES_MAX];
    int n;
    struct unit joule;
};

/* The columns that are there and not always zero. */
static void choose_energies(struct energies *e, const struct history *h)
{
    static const struct { const char *name, *label; } known[] = {
        {"kinetic", "kinetic"}, {"strain", "strain"},   {"plastic", "plastic"},
        {"fracture", "fracture"}, {"external_work", "external work"}};
    double largest = 0;
    *e = (struct energies){0};
    for (int k = 0; k < (int)COUNT_OF(known); k++) {
        int column = history_column(h, known[k].name);
        double top = largest_of(h, column);
        if (column < 0 || top == 0) continue;
        e->column[e->n] = column;
        e->label[e->n++] = known[k].label;
        largest = fmax(largest, top);
    }
    e->joule = unit_for(largest, "J");
    for (int k = 0; k < e->n; k++) e->factor[k] = e->joule.factor;
}

/* Every energy, and their sum (external work left out) dashed. */
static void plot_energies(FILE *to, const struct energies *e)
{
    fputs("plot ", to);
    for (int k = 0; k < e->n; k++)
        fprintf(to, "$data using 1:%d with lines lw 2.2 lc rgb '%s' title '%s', ", k + 2, curve_colour[k], e->label[k]);
    fputs("$data using 1:(0", to);
    for (int k = 0; k < e->n; k++)
        if (strcmp(e->label[k], "external work") != 0) fprintf(to, "+$%d", k + 2);
    fprintf(to, ") with lines lw 1.6 dt (6,4) lc rgb '%s' title 'sum without work'\n", curve_colour[6]);
}

static void plot_balance(FILE *to, const struct series *s, double largest)
{
    double top = largest > 0 ? 120 * largest : 1;
    fputs("unset title\nunset key\nset format x '%g'\nset ytics autofreq\n", to);
    set_time_axis(to, s);
    fprintf(to, "set tmargin at screen 0.255\nset bmargin at screen 0.105\nset yrange [%.9g:%.9g]\nset ytics %.3g\n"
                "set format y '%%.2g'\nset ylabel 'balance error [%%]'\n"
                "plot $data using 1:%d with lines lw 1.8 lc rgb '%s'\n",
            -top, top, pow(10, floor(log10(top))) * (top / pow(10, floor(log10(top))) >= 5 ? 5 : top / pow(10, floor(log10(top))) >= 2 ? 2 : 1), 2,
            curve_colour[6]);
}

static status draw_energy(const char *path, const char *title, const struct series *s)
{
    struct energies e;
    struct gnuplot g;
    int balance = history_column(s->h, "balance_error");
    const double percent = 0.01;
    choose_energies(&e, s->h);
    if (e.n == 0) return OK;
    TRY(gnuplot_open(&g, path, PICTURE_PNG, 1000, balance >= 0 ? 760 : 600));
    send_series(g.to, s, e.column, e.factor, e.n);
    set_title(g.to, title, "energy");
    set_time_axis(g.to, s);
    fprintf(g.to, "set lmargin at screen 0.1\nset rmargin at screen 0.79\nset ylabel 'energy [%s]'\n", e.joule.name);
    if (balance >= 0)
        fputs("set multiplot\nset tmargin at screen 0.92\nset bmargin at screen 0.32\nset format x ''\nunset xlabel\n",
              g.to);
    plot_energies(g.to, &e);
    if (balance >= 0) {
        fputs("undefine $data\n", g.to);
        send_series(g.to, s, &balance, &percent, 1);
        plot_balance(g.to, s, largest_of(s->h, balance));
        fputs("unset multiplot\n", g.to);
    }
    return gnuplot_close(&g);
}

status curves_draw(const char *folder, const char *pictures, const char *title)
{
    struct history h;
    char path[PATH_LENGTH];
    TRY(history_read(&h, folder));
    struct series s = {.h = &h, .time = history_column(&h, "time")};
    status result = OK;
    if (s.time >= 0 && h.rows > 1) {
        s.second = unit_for(history_at(&h, h.rows - 1, s.time), "s");
        snprintf(path, sizeof path, "%s/crack.png", pictures);
        result = draw_crack(path, title, &s);
        snprintf(path, sizeof path, "%s/energy.png", pictures);
        if (result == OK) result = draw_energy(path, title, &s);
    }
    history_free(&h);
    return result;
}

/* ---- profiles -------------------------------------------------------------------------------------- */

/* Early frames light, late ones dark. */
static struct colour frame_colour(int k, int frames)
{
    double late = frames > 1 ? (double)k / (frames - 1) : 1;
    const double early[3] = {158, 202, 225}, dark[3] = {8, 48, 107};
    return (struct colour){(uint8_t)(early[0] + late * (dark[0] - early[0])),
                           (uint8_t)(early[1] + late * (dark[1] - early[1])),
                           (uint8_t)(early[2] + late * (dark[2] - early[2])), 255};
}

static const float *by_place;            /* see order_frame */
