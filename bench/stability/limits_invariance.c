/* Invariance: scenes that are scaled, mirrored, rotated or renumbered must give the same result. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "limits_scenes.h"
#include "probes/diagnostics.h"

/* A transformation of the plate: x' = scale (x, y), with exchanged axes if `turned` and reversed x if `mirrored`.
 * listed: the particles are from a list, in the order of the lattice (1) or permuted (2); 0: from a box. */
struct twin {
    double scale;
    bool mirrored, turned;
    int listed;
};

static void put_vector(FILE *to, const struct twin *t, double scale, double x, double y)
{
    if (t->mirrored) x = -x;
    fprintf(to, "[%.17g, %.17g]", scale * (t->turned ? y : x), scale * (t->turned ? x : y));
}

static void limits_invariance_put_box(FILE *to, const struct twin *t, double x0, double y0, double x1, double y1)
{
    const double mm = 1e-3 * t->scale;
    fputs("{box: {from: ", to);
    put_vector(to, t, mm, t->mirrored ? x1 : x0, y0);
    fputs(", to: ", to);
    put_vector(to, t, mm, t->mirrored ? x0 : x1, y1);
    fputs("}}", to);
}

/* Numbers of particles of the plate along x and y, 1 mm apart; and whether the point (x, y) [mm] is in its hole. */
enum { PLATE_X = 38, PLATE_Y = 26 };
static bool in_hole(double x, double y) { return hypot(x - 9, y - 5) <= 3.3; }

/* Writes the particles of the transformed plate t as a list, without those in the hole. If t->listed is 2, their
 * order is permuted in a manner unrelated to positions. */
static void put_list(FILE *to, const struct twin *t)
{
    const double mm = 1e-3 * t->scale;
    fputs("x,y,volume\n", to);
    for (int k = 0; k < PLATE_X * PLATE_Y; k++) {
        const int at = t->listed == 2 ? k * 383 % (PLATE_X * PLATE_Y) : k;
        const double x = -17.5 + at % PLATE_X, y = -11.5 + at / PLATE_X;
        if (!in_hole(x, y)) fprintf(to, "%.17g,%.17g,%.17g\n", mm * x, mm * y, mm * mm * mm);
    }
}

static status list_write(const struct twin *t, char *path)
{
    TRY(bench_create_results_folder());
    strcpy(path, BENCH_FOLDER "/twin-XXXXXX.csv");
    const int file = mkstemps(path, 4);
    FILE *to = file >= 0 ? fdopen(file, "w") : NULL;
    if (!to) return status_set(FAILED, "cannot write %s", path);
    put_list(to, t);
    return fclose(to) == 0 ? OK : status_set(FAILED, "cannot write %s", path);
}

static void put_body(FILE *to, const struct twin *t, const char *list)
{
    if (t->listed) {
        fprintf(to, "bodies: [{name: plate, particles: %s}]\n", list);
        return;
    }
    fputs("body:\n  - ", to);
    limits_invariance_put_box(to, t, -18, -12, 20, 14);
    fputs("\n  - subtract: {disc: {centre: ", to);
    put_vector(to, t, 1e-3 * t->scale, 9, 5);
    fprintf(to, ", radius: %.17g}}\n", 3.3e-3 * t->scale);
}

static void put_loads(FILE *to, const struct twin *t)
{
    const double mm = 1e-3 * t->scale;
    fputs("cracks:\n  - {from: ", to);
    put_vector(to, t, mm, -18, 1);
    fputs(", to: ", to);
    put_vector(to, t, mm, -4, 1);
    fputs("}\nboundary:\n", to);
    for (int side = -1; side <= 1; side += 2) {
        fputs("  - {traction: ", to);
        put_vector(to, t, 1, 0, side * 4e6);
        fprintf(to, ", face: %c%c}\n", t->turned ? 'x' : 'y', side > 0 ? '+' : '-');
    }
    fputs("initial:\n  - {pulse: {at: ", to);
    put_vector(to, t, mm, 4, -3);
    fputs(", direction: ", to);
    put_vector(to, t, 1, 1, 0.4);
    fprintf(to, ", width: %.17g, velocity: 3}}\n", 12 * mm);
}

/* Writes the scene of the transformed plate t with the method of row r: a notched plate with a hole and without
 * symmetry, under tension at two faces while a pulse crosses it. list: file with the list of its particles, used if
 * t->listed. */
static void put_plate(FILE *to, const struct twin *t, const struct limits_row *r, const char *list)
{
    const double mm = 1e-3 * t->scale;
    fprintf(to, "name: plate\nspace: plane stress\nthickness: %.17g\nduration: %.17g\ntime: {step: %.17g}\n", mm,
            2e-5 * t->scale, 1e-7 * t->scale);
    fprintf(to, "material: {young: 72e9, density: 2440, energy_release_rate: %.17g}\nparticles: {spacing: %.17g}\n",
            2000 * t->scale, mm);
    put_body(to, t, list);
    put_loads(to, t);
    fputs("output: {frames: 0, samples: 1}\nmpm: {origin: ", to);
    put_vector(to, t, mm, 0, 0);
    fputs("}\npd: {region: ", to);
    limits_invariance_put_box(to, t, -10, -5, 4, 7);
    if (strcmp(r->set[1], "pd") == 0) fputs(", surface: moments", to); /* not the default for bodies from lists */
    fputs("}\nconversion: {criteria: none}\n", to);
}

static status plate_run(struct run *run, struct scene *s, const struct twin *t, const struct limits_row *r)
{
    char text[4096], list[64] = "";
    if (t->listed) TRY(list_write(t, list));
    FILE *to = fmemopen(text, sizeof text, "w");
    put_plate(to, t, r, list);
    fclose(to);
    const status made = limits_make_run_of_scene(run, s, r, "%s", text);
    if (t->listed) remove(list);
    TRY(made);
    return run_advance_to_end_time(run);
}

/* Returns the index of that particle of q, the particles of the plate transformed by t, which corresponds to particle i
 * of p, the particles of the original plate; -1 if there is none. */
static int64_t twin_of(const struct particles *p, int64_t i, const struct particles *q, const struct twin *t)
{
    const double x = t->scale * (t->mirrored ? -p->X[0][i] : p->X[0][i]), y = t->scale * p->X[1][i];
    for (int64_t k = 0; k < q->n; k++)
        if (fabs(q->X[t->turned][k] - x) + fabs(q->X[!t->turned][k] - y) < 1e-6 * t->scale) return k;
    return -1;
}

/* Returns the largest difference of velocities and of displacements between the run a of the original plate and the run
 * b of the plate transformed by t, each relative to its largest value [1]. Returns INFINITY if bonds broke, particles
 * are missing or nothing moves. */
static double difference(const struct run *a, const struct run *b, const struct twin *t)
{
    double speed = 0, shift = 0, most_speed = 0, most_shift = 0;
    if (a->part.n != b->part.n || a->diagnostics->bonds_broken || b->diagnostics->bonds_broken) return INFINITY;
    for (int64_t i = 0; i < a->part.n; i++) {
        const int64_t k = twin_of(&a->part, i, &b->part, t);
        if (k < 0) return INFINITY;
        for (int d = 0; d < 2; d++) {
            const double sign = d == 0 && t->mirrored ? -1 : 1;
            const int axis = t->turned ? !d : d;
            const double v = a->part.v[d][i], u = a->part.x[d][i] - a->part.X[d][i];
            speed = fmax(speed, fabs(sign * b->part.v[axis][k] - v));
            shift = fmax(shift, fabs(sign * (b->part.x[axis][k] - b->part.X[axis][k]) / t->scale - u));
            most_speed = fmax(most_speed, fabs(v)), most_shift = fmax(most_shift, fabs(u));
        }
    }
    return most_speed > 1 && most_shift > 1e-6 ? fmax(speed / most_speed, shift / most_shift) : INFINITY;
}

static status limits_invariance_compare(const struct twin *one, const struct twin *other, const struct limits_row *r,
                                        double *to)
{
    struct run a, b;
    struct scene of_a, of_b;
    TRY(plate_run(&a, &of_a, one, r));
    const status ran = plate_run(&b, &of_b, other, r);
    if (ran == OK) {
        *to = difference(&a, &b, other);
        bench_engine_free(&b, &of_b);
    }
    bench_engine_free(&a, &of_a);
    return ran;
}

static const struct twin plate[] = {{.scale = 1},
                                    {.scale = 1000},
                                    {.scale = 1, .mirrored = true},
                                    {.scale = 1, .turned = true},
                                    {.scale = 1e-6, .mirrored = true, .turned = true},
                                    {.scale = 1, .listed = 1},
                                    {.scale = 1, .listed = 2}};
/* Indices of the transformations `plate`. */
enum { ITSELF, LARGER, MIRRORED, TURNED, ALL_OF_IT, LISTED, SHUFFLED };

/* Runs the plate and a transformed plate with the method of row r and stores the difference of their results in *to
 * [1]. r->given: index of the transformation in plate[]. Returns REFUSED or FAILED if a run does. */
static status twins(const struct limits_row *r, double *to)
{
    return limits_invariance_compare(&plate[ITSELF], &plate[(int)r->given], r, to);
}

/* A row for a method (kind) and a peridynamic model (law) with the transformation plate[which], called `name` (see
 * twins). Sums in another order and lengths that are not binary fractions cause round-off over 200 steps; bond
 * stretches are stored as multiples of 2^-49, 1e-11 of those here. */
#define TWIN(kind, law, name, which)                                                                                   \
    {                                                                                                                  \
        .method = kind ", " name, .set = {"method", kind, "model", law}, .given = which, .known = { {0, 1e-10} }       \
    }
#define TWINS(kind)                                                                                                    \
    TWIN(kind, "bond", "a thousand times larger", LARGER), TWIN(kind, "bond", "mirrored", MIRRORED),                   \
        TWIN(kind, "bond", "turned", TURNED), TWIN(kind, "bond", "1e-6, mirrored, turned", ALL_OF_IT),                 \
        TWIN(kind, "bond", "from a list", LISTED), TWIN(kind, "bond", "renumbered", SHUFFLED)
#define LAW_TWINS(law)                                                                                                 \
    TWIN("pd", law, law ", 1e-6, mirrored, turned", ALL_OF_IT), TWIN("pd", law, law ", renumbered", SHUFFLED)
static const struct limits_row twin[] = {TWINS("pd"), TWINS("mpm"), TWINS("adaptive"), LAW_TWINS("ospd"),
                                         LAW_TWINS("mospd")};
const struct limits_scene limits_twins = {
    "twins of a plate", NULL, {{"difference before bonds break", 1e-10}}, ROWS(twin), twins};

/* Runs the plate from a list of particles and from its permutation, with the method of row r, and stores the difference
 * of their results in *to [1]. Particles are sorted by position, so that it must be exactly 0. Returns REFUSED or
 * FAILED if a run does. */
static status renumbered(const struct limits_row *r, double *to)
{
    return limits_invariance_compare(&plate[LISTED], &plate[SHUFFLED], r, to);
}

#define SHUFFLE(kind)                                                                                                  \
    {                                                                                                                  \
        .method = kind, .set = {"method", kind}, .known = { {0, 0} }                                                   \
    }
static const struct limits_row shuffled[] = {SHUFFLE("pd"), SHUFFLE("mpm"), SHUFFLE("adaptive")};
const struct limits_scene limits_renumbered = {
    "a list of particles in another order", NULL, {{"difference", 0}}, ROWS(shuffled), renumbered};
