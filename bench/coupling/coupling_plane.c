/* A plane longitudinal pulse between roller supports hits an interface of material points and bonds, which is flat or
 * inclined at 45 degrees. An inclined interface reflects sideways: the incident pulse and the reflected one, both
 * plane, move along the interface together. The run ends before they reach the lower rollers, which would return the
 * reflected pulse. */
#include <math.h>
#include <string.h>

#include "coupling.h"
#include "base/memory.h"
#include "probes/probes.h"
#include "step/step.h"

enum { BLOCK = 4, AWAY = 12 }; /* size of blocks; least distance from the interface [spacings] */
enum { WEIGHTS = 2 };

/* Geometry of the strip, in spacings of 1 mm. length, height: its size. */
struct strip {
    double length, height, start; /* centre of the pulse at t = 0 */
    double at, normal[2];         /* the interface: point (at, 0) and normal */
    double path, step;            /* distance that the pulse travels; per time step */
};

static const char *const interface_name[] = {"flat", "45 degrees"};
/* Directions of the interface; names in interface_name. */
enum { FLAT, OBLIQUE, INTERFACES };

/* Returns the geometry of the strip for a pulse of `width` spacings. interface: FLAT or OBLIQUE. FLAT: distances as in
 * the bar, so that results are comparable. OBLIQUE: the strip is high enough for the reflected wave to become plane,
 * and the interface is half a spacing from the particles. (For a pulse of 32 spacings, heights of 3 to 6 widths change
 * the measured reflection by at most 1/7.) */
static struct strip strip_of(int interface, double width)
{
    if (interface == FLAT) return (struct strip){1024, 4, 256, 512, {1, 0}, 512, 0.2};
    const double diagonal = sqrt(0.5), height = 64 + 2 * width, at = 3 * width + height + 0.5;
    return (struct strip){at - 0.5 + 1.5 * width, height, 1.5 * width, at, {diagonal, diagonal},
                          at - 2.75 * width,      0.4};
}

/* Creates the run of the strip s and stores its scene in *scene. row: coupling, weights, transfer and width of the
 * pulse; row->variant < 0 for material points only, without interface. Returns FAILED or REFUSED if the scene cannot be
 * read. Release with bench_engine_free. */
static status strip_make(struct run *run, struct scene *scene, const struct strip *s, const struct plane_row *row)
{
    struct bench_overrides o = {0};
    if (row->variant >= 0)
        coupling_variant_append_overrides(&o, row->variant);
    else
        bench_overrides_append(&o, "method", "mpm");
    bench_overrides_append(&o, "pd.weights", "%s", row->weights);
    bench_overrides_append(&o, "mpm.transfer", "%s", row->transfer);
    bench_overrides_append(&o, "body", "{box: {from: [0, 0], to: [%g mm, %g mm]}}", s->length, s->height);
    bench_overrides_append(&o, "pd.region", "{half-space: {point: [%g mm, 0], normal: [%g, %g]}}", s->at, -s->normal[0],
                           -s->normal[1]);
    bench_overrides_append(&o, "boundary[1].mirror.at", "%g mm", s->height);
    bench_overrides_append(&o, "initial[0].pulse.at", "[%g mm, 0]", s->start);
    bench_overrides_append(&o, "initial[0].pulse.width", "%g mm", row->width);
    bench_overrides_append(&o, "duration", "%.9g ms", s->path / 100); /* wave speed 100 m/s */
    bench_overrides_append(&o, "time.step", "%g ms", s->step / 100);
    bench_overrides_append(&o, "output.samples", "1");
    return bench_engine_make(run, scene, COUPLING_PLATE, NULL, bench_overrides_as_array(&o), o.n);
}

/* ---- the run without interface ----------------------------------------------------------------------------------- */

/* State of a strip without interface at its end: velocities v[2][particles] [m/s], and change of energy over the
 * incident energy [1]. */
struct plain {
    real *v[2], energy_change;
};

/* Runs the strip s without interface and stores its final velocities and energy change in *b. All runs of a strip
 * number the particles alike, so that they can be compared particle by particle. row: weights, transfer and width of
 * the pulse. Returns FAILED if a step fails. Release b with plain_free. */
static status plain_make(struct plain *b, const struct strip *s, struct plane_row row)
{
    struct run e;
    struct scene scene;
    row.variant = -1;
    TRY(strip_make(&e, &scene, s, &row));
    status ran = run_advance_to_end_time(&e);
    for (int d = 0; d < 2 && ran == OK; d++) {
        b->v[d] = NEW("bench.plain", e.part.n, real);
        array_copy(b->v[d], e.part.v[d], e.part.n, sizeof(real));
    }
    if (ran == OK) b->energy_change = observed_run_make_read_only_view(&e).energy_change;
    bench_engine_free(&e, &scene);
    return ran;
}

static void plain_free(struct plain *b)
{
    for (int d = 0; d < 2; d++) memory_free(b->v[d]);
}

/* ---- effect of the interface ------------------------------------------------------------------------------------- */

/* Returns the signed distance of particle i from the interface of the strip s [spacings], positive for material beyond
 * it. */
static double beyond(const struct strip *s, const struct particles *p, int64_t i)
{
    return (1e3 * p->X[0][i] - s->at) * s->normal[0] + 1e3 * p->X[1][i] * s->normal[1];
}

/* Returns the largest difference of velocity between a run with an interface and the run b without it, as the mean over
 * a square block of BLOCK x BLOCK particles [m/s]. Counts only blocks in front of the interface and at least AWAY
 * spacings from it. Means are compared because the grid does not resolve single particles: only a mean over two cells
 * can travel as a wave. p: particles of the run with the interface; s: strip. */
static double largest_block(const struct strip *s, const struct particles *p, const struct plain *b)
{
    const int64_t columns = (int64_t)s->length / BLOCK + 1, n = columns * ((int64_t)s->height / BLOCK + 1);
    real *sum[2] = {NEW("bench.block", n, real), NEW("bench.block", n, real)}, largest = 0;
    int32_t *count = NEW("bench.count", n, int32_t);
    for (int64_t i = 0; i < p->n; i++) {
        const int64_t k = (int64_t)(1e3 * p->X[0][i] / BLOCK) + columns * (int64_t)(1e3 * p->X[1][i] / BLOCK);
        count[k] += beyond(s, p, i) < -AWAY;
        for (int d = 0; d < 2; d++) sum[d][k] += p->v[d][i] - b->v[d][i];
    }
    for (int64_t k = 0; k < n; k++)
        if (count[k] == BLOCK * BLOCK) largest = fmax(largest, hypot(sum[0][k], sum[1][k]) / (BLOCK * BLOCK));
    for (int d = 0; d < 2; d++) memory_free(sum[d]);
    memory_free(count);
    return largest;
}

/* Computes reflected and transmitted amplitude and energy change of the run of the strip s, and stores them in *r.
 * The reflection is the difference from the run b without interface. Near the interface only particles behind the pulse
 * are used for it, because inside the pulse both runs differ by their dispersion. */
static void coupling_plane_compare(struct plane_row *r, const struct strip *s, const struct run *run,
                                   const struct plain *b)
{
    const struct particles *p = &run->part;
    const double incident = run->scene->initial[0].pulse.velocity;
    const double passed = s->start + s->path - 1.25 * r->width;
    double back = 0, on = 0;
    for (int64_t i = 0; i < p->n; i++) {
        const double far = beyond(s, p, i);
        if (far >= 0)
            on = fmax(on, hypot(p->v[0][i], p->v[1][i]));
        else if (far < -AWAY || 1e3 * p->X[0][i] < passed)
            back = fmax(back, hypot(p->v[0][i] - b->v[0][i], p->v[1][i] - b->v[1][i]));
    }
    r->result = (struct pulse_result){back / incident, on / incident,
                                      observed_run_make_read_only_view(run).energy_change - b->energy_change};
    r->wave = largest_block(s, p, b) / incident;
}

static status row_measure(struct plane_row *r, const struct strip *s, const struct plain *b)
{
    struct run e;
    struct scene scene;
    TRY(strip_make(&e, &scene, s, r));
    status ran = run_advance_to_end_time(&e);
    if (ran == OK) coupling_plane_compare(r, s, &e, b);
    bench_engine_free(&e, &scene);
    return ran;
}

/* Runs the strip once without interface, then with all couplings and weights of bonds, and adds the results to the
 * table t. interface: FLAT or OBLIQUE; width: of the pulse [spacings]; transfer: value of the scene key mpm.transfer,
 * "flip" or "apic". Returns FAILED or REFUSED if a run does. */
static status group_measure(struct plane_table *t, int interface, double width, const char *transfer)
{
    static const char *const weights[WEIGHTS] = {"uniform", "isotropic"};
    const struct strip strip = strip_of(interface, width);
    const bool flip = !strcmp(transfer, "flip");
    struct plane_row row = {interface_name[interface], "uniform", transfer, 0, width, {0, 0, 0}, 0};
    struct plain plain = {0};
    status s = plain_make(&plain, &strip, row);
    for (int variant = 0; variant <= VARIANT_HANDSHAKE; variant++)
        for (int w = 0; w < WEIGHTS && s == OK; w++) {
            if (variant == VARIANT_UNDAMPED && !flip) continue; /* the interface is damped with FLIP only */
            row.variant = variant, row.weights = weights[w];
            s = row_measure(&row, &strip, &plain);
            INVARIANT(t->n < PLANE_ROWS_MAX);
            if (s == OK) t->row[t->n++] = row;
        }
    plain_free(&plain);
    return s;
}

status plane_wave_measure_reflections(struct plane_table *table, bool quick)
{
    if (quick) return group_measure(table, OBLIQUE, 16, "flip");
    for (int interface = 0; interface < INTERFACES; interface++)
        for (double width = 16; width <= 64; width *= 2) {
            TRY(group_measure(table, interface, width, "flip"));
            TRY(group_measure(table, interface, width, "apic"));
        }
    return OK;
}

/* ---- output ------------------------------------------------------------------------------------------------------ */

/* Prints one line for the rows r[0] and r[1] of a coupling, with uniform and with isotropic weights. */
static void print_pair(const struct plane_row *r)
{
    printf("  %-11s %4.0f D %5s  %-24s", r->interface, r->width, r->transfer, coupling_variant[r->variant].name);
    for (int w = 0; w < WEIGHTS; w++) printf(" %8.2f %%", 100 * r[w].wave);
    for (int w = 0; w < WEIGHTS; w++) printf(" %8.2f %%", 100 * r[w].result.reflected);
    printf(" %8.2f %% %+8.2f %%\n", 100 * r[1].result.transmitted, 100 * r[1].result.energy_change);
}

void plane_print(const struct plane_table *table)
{
    printf(
        "\n  a plane pulse between rollers, bonds with uniform and with isotropic weights: what came back as a wave\n"
        "  (means over %d x %d D, %d D and more from the interface) and on any particle; what went on, energy "
        "(isotropic)\n"
        "  %-11s %6s %5s  %-24s %10s %10s %10s %10s %10s %10s\n",
        BLOCK, BLOCK, AWAY, "interface", "width", "", "coupling", "wave: unif", "isotropic", "any: unif", "isotropic",
        "went on", "energy");
    for (int k = 0; k < table->n; k += WEIGHTS) print_pair(&table->row[k]);
    fflush(stdout);
}

void plane_wave_fill_file_table(const struct plane_table *table, struct bench_table *rows)
{
    bench_table_make(rows, "plane",
                     "interface,width_spacings,transfer,coupling,weights,reflected,reflected_wave,transmitted,"
                     "energy_change");
    for (int k = 0; k < table->n; k++) {
        const struct plane_row *r = &table->row[k];
        bench_table_append_text(rows, r->interface);
        bench_table_append_number(rows, r->width);
        bench_table_append_text(rows, r->transfer);
        bench_table_append_text(rows, coupling_variant[r->variant].name);
        bench_table_append_text(rows, r->weights);
        bench_table_append_number(rows, r->result.reflected);
        bench_table_append_number(rows, r->wave);
        bench_table_append_number(rows, r->result.transmitted);
        bench_table_append_number(rows, r->result.energy_change);
    }
}
