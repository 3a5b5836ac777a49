/* Checks that lists of particles match the spacing of the scene. A list in another unit reads without an error, but its
 * particles have no neighbours and no forces, or all particles are neighbours of each other and the bonds exceed the
 * memory. */
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "scene/fill.h"
#include "base/memory.h"
#include "base/team.h"

/* Number of particles up to which the list of a body is not checked: such bodies are mass points, placed individually,
 * without neighbours. */
enum { FEW = 7 };
/* Number of particles sampled per body. Each is compared with all particles of the body. Shares that are estimated
 * from the sample are accurate to 4 %, whatever the shape of the body. */
enum { LOOKED_AT = 128 };
/* Largest share of the sampled particles of a list that may have no neighbour [1]; a list with a larger share is
 * refused. In a wrong unit nearly all particles have none. Correct lists have fewer such particles: grains of several
 * particles have neighbours of their own grain, chips of one particle are fewer than the particles of the fragments
 * they broke off, and particles placed at random at the density of the spacing leave 2 % without a neighbour on a line,
 * and one in 1e5 in 2D and 3D. */
#define LONE_MOST 0.5
/* Least median distance of nearest neighbours in a particle list [spacings]; a list with a smaller distance is refused.
 * Units differ by factors of 10 and more, the finest and the coarsest parts of a graded body rarely by more than 4. */
#define CLOSE_LEAST (1.0 / 6)
/* Largest factor between the median particle volume and the volume of a cell whose edge is the distance of the nearest
 * neighbour [1]; a particle list with a larger factor is refused. In another unit the two volumes differ by 1e3 and
 * more; for particles at random positions by 2 on a line, 4 in the plane and 6 in space. */
#define VOLUME_MOST 100.0
#define CROWDED 0.5     /* nearest neighbours closer than this: memory of bonds is estimated first [spacings] */
#define ONE_PLACE 1e-9  /* least distance of two positions [longest edge of the body]; refused in fill.c */
#define REACH_LEAST 1.5 /* least reach of a material point, for cells of at most one spacing [spacings] */

/* The n particles of one body, stored together, while their list is checked. p, s, body: all particles, the scene,
 * index of the body. */
struct crowd {
    const struct particles *p;
    const struct scene *s;
    int body;
    int64_t n;
    real *X[DIM_MAX], *volume; /* [n] positions [m]; volumes [m^3] */
    real reach;                /* distance within which particles are neighbours [m] */
    real one_place;            /* distance below which positions count as one [m] */
};

/* Statistics of a sample of the particles of a body, which show whether the body's list has the right unit. */
struct verdict {
    real lone;   /* share of the particles without a neighbour [1] */
    real apart;  /* median distance of the nearest other position [m] */
    real family; /* mean number of neighbours within reach */
    real filled; /* median of the volume divided by that of a cell up to the nearest neighbour [1] */
};

/* Copies positions and volumes of the particles of body c->body to new arrays c->X and c->volume, which the caller
 * frees. Sets their number c->n, and c->one_place, the distance below which positions count as equal [m]. */
static void crowd_take(struct crowd *c)
{
    const struct particles *p = c->p;
    real longest = 0;
    int64_t own = 0;
    for (int64_t i = 0; i < p->n; i++) c->n += p->body[i] == c->body;
    c->volume = NEW("fill.crowd", c->n, real);
    for (int64_t i = 0; i < p->n; i++)
        if (p->body[i] == c->body) c->volume[own++] = p->volume0[i];
    for (int d = 0; d < p->dim; d++) {
        real low = INFINITY, high = -INFINITY;
        int64_t k = 0;
        c->X[d] = NEW("fill.crowd", c->n, real);
        for (int64_t i = 0; i < p->n; i++) {
            if (p->body[i] != c->body) continue;
            c->X[d][k++] = p->X[d][i];
            low = real_min(low, p->X[d][i]), high = real_max(high, p->X[d][i]);
        }
        longest = real_max(longest, high - low);
    }
    c->one_place = ONE_PLACE * longest;
}

/* Returns the square of the distance from X[dim] [m] to the nearest of n particles that is not at X itself [m^2];
 * INFINITY if there is none. c: distances that count as neighbour and as equal; others[dim][n]: coordinates of the
 * particles [m]. *within: receives the number of these particles within c->reach of X, including one at X. */
static real nearest_of(const struct crowd *c, real *const *others, int64_t n, const real *X, int64_t *within)
{
    const real reach2 = square(c->reach), place2 = square(c->one_place);
    const int dim = c->p->dim;
    real nearest = INFINITY;
    int64_t count = 0;
#pragma omp simd reduction(min : nearest) reduction(+ : count)
    for (int64_t j = 0; j < n; j++) {
        real r2 = 0;
        for (int d = 0; d < dim; d++) r2 += square(others[d][j] - X[d]);
        const real apart = r2 > place2 ? r2 : INFINITY;
        nearest = apart < nearest ? apart : nearest;
        count += r2 <= reach2;
    }
    *within = count;
    return nearest;
}

/* Returns statistics of the body in c (distances of particles and numbers of neighbours) from a sample of at most
 * LOOKED_AT particles, by which its particle list is judged. The sample is spread over the list by a Weyl sequence of
 * the golden ratio, so that a pattern in the order of the list does not matter. Particles of other bodies count as
 * neighbours unless the whole scene is peridynamic, because bonds do not join bodies. */
static struct verdict crowd_look(const struct crowd *c)
{
    const struct particles *p = c->p;
    const int64_t looked = c->n < LOOKED_AT ? c->n : LOOKED_AT;
    const real section = scene_cross_section_or_thickness(c->s);
    real apart[LOOKED_AT], filled[LOOKED_AT], family = 0;
    int64_t lone = 0, within[LOOKED_AT];
#pragma omp parallel for schedule(static)
    for (int64_t k = 0; k < looked; k++) {
        const real turn = 0.6180339887498949 * (real)k;
        const int64_t i = c->n <= LOOKED_AT ? k : (int64_t)((turn - floor(turn)) * (real)c->n);
        real X[DIM_MAX];
        for (int d = 0; d < p->dim; d++) X[d] = c->X[d][i];
        apart[k] = sqrt(nearest_of(c, c->X, c->n, X, &within[k]));
        filled[k] = c->volume[i] / lattice_particle_volume(section, apart[k], p->dim);
        if (within[k] < 2 && c->s->method != METHOD_PD) nearest_of(c, p->X, p->n, X, &within[k]);
    }
    for (int64_t k = 0; k < looked; k++) lone += within[k] < 2, family += (real)(within[k] - 1);
    array_sort(apart, looked, sizeof *apart, compare_doubles);
    array_sort(filled, looked, sizeof *filled, compare_doubles);
    return (struct verdict){(real)lone / (real)looked, apart[looked / 2], family / (real)looked, filled[looked / 2]};
}

/* ---- messages ---------------------------------------------------------------------------------------------------- */

/* Returns a guess of the unit of length of a particle list as text for a message, such as " (is it in mm?)"; "" if
 * there is none. ratio: a length in the list divided by its expected value, such as 1e3 for mm; by_volume: the same
 * ratio computed from the volumes in the list, NAN without volumes. A ratio from the volumes within a factor of 1.5 of
 * a unit decides; else `ratio` alone, which for 30 to 400 may mean mm or cm, so that the text names both. */
static const char *unit_guess(real ratio, real by_volume)
{
    static const struct {
        real ratio;
        const char *guess;
    } unit[] = {{1e2, " (is it in cm?)"}, {1e3, " (is it in mm?)"}, {1e6, " (is it in um?)"}};
    for (size_t k = 0; k < COUNT_OF(unit); k++)
        if (fabs(log(by_volume / unit[k].ratio)) < log(1.5)) return unit[k].guess;
    return ratio > 30 && ratio < 400        ? " (perhaps the list is in mm or cm)"
           : ratio >= 400 && ratio < 3e4    ? " (is it in mm?)"
           : ratio > 1.5e5 && ratio < 1.5e7 ? " (is it in um?)"
                                            : "";
}

static const char *volume_guess(real ratio)
{
    return fabs(log10(ratio) - 9) < 1   ? " (are they in mm^3?)"
           : fabs(log10(ratio) - 6) < 1 ? " (perhaps the volumes are in cm^3, or areas in mm^2)"
                                        : "";
}

static status refuse_list(const struct crowd *c, const char *format, ...) __attribute__((format(printf, 2, 3)));
static status refuse_list(const struct crowd *c, const char *format, ...)
{
    const struct scene_body *b = &c->s->body[c->body];
    char why[480];
    va_list more;
    va_start(more, format);
    vsnprintf(why, sizeof why, format, more);
    va_end(more);
    return status_set(REFUSED, "%s%sbody %s: %s", b->place[0] ? b->place : b->file, b->place[0] ? "" : ": ", b->name,
                      why);
}

/* Checks the particle list of body c->body by its statistics v. Returns REFUSED, with a message, if distances or
 * volumes of the particles do not match the spacing, as with a wrong unit, or if bonds of the particles would exceed
 * the memory. Returns OK for a list with all particles at one position, which check_distances refuses. */
static status crowd_judge(const struct crowd *c, const struct verdict *v)
{
    const real spacing = c->s->spacing, bytes = BYTES_PER_BOND * v->family * (real)c->n;
    const real by_volume =
        c->s->body[c->body].list.volumes ? pow(v->filled, -1.0 / (real)c->s->dim) : NAN; /* 1 for a list without gaps */
    if (!isfinite(v->apart)) return OK; /* all at one position: refused by check_distances (fill.c) */
    if (v->lone > LONE_MOST)
        return refuse_list(c,
                           "%s%.0f %% of its particles have no neighbour within %.4g spacings of %.4g m: particles of "
                           "the list are %.4g m apart; give the list in m%s, or name its unit as in particles: {file: "
                           ".., unit: mm}, or set particles.spacing to about %.2g m",
                           c->n > LOOKED_AT ? "about " : "", 100 * v->lone, c->reach / spacing, spacing, v->apart,
                           unit_guess(v->apart / spacing, by_volume), v->apart);
    if (v->apart < CLOSE_LEAST * spacing)
        return refuse_list(c,
                           "neighbours of the list are %.4g m apart, but the spacing is %.4g m; set particles.spacing "
                           "to about %.2g m%s, or give the list in m",
                           v->apart, spacing, v->apart, unit_guess(spacing / v->apart, NAN));
    if (!(v->filled < VOLUME_MOST && v->filled > 1 / VOLUME_MOST))
        return refuse_list(c,
                           "volumes of its particles are %.3g times those expected from the distance of neighbours, "
                           "%.4g m%s; give volumes in m^3%s",
                           v->filled, v->apart,
                           c->s->dim == 1   ? ", times the section"
                           : c->s->dim == 2 ? ", times the thickness"
                                            : "",
                           volume_guess(v->filled));
    if (c->s->method == METHOD_PD && v->apart < CROWDED * spacing && machine_memory_size() > 0 &&
        bytes > (real)machine_memory_size())
        return refuse_list(c,
                           "each of its particles has %.3g neighbours within %.4g spacings of %.4g m; their bonds need "
                           "about %.2g GB of memory, but %.2g GB are available (%s). Particles of the list are %.4g m "
                           "apart: set particles.spacing to this distance",
                           v->family, c->reach / spacing, spacing, bytes * 1e-9, (real)machine_memory_size() * 1e-9,
                           machine_memory_limit_describe_source(), v->apart);
    return OK;
}

/* ---- all lists --------------------------------------------------------------------------------------------------- */

/* Returns the distance [spacings] over which particles of the scene s interact: the larger of the horizon of bonds and
 * one cell of the grid, but at least REACH_LEAST. */
static real fill_lists_reach_of(const struct scene *s)
{
    const real bonds = s->method == METHOD_MPM ? 0 : s->horizon, grid = s->method == METHOD_PD ? 0 : s->cell;
    return real_max(REACH_LEAST, real_max(bonds, grid));
}

status particle_lists_check_distances_fit_spacing(const struct particles *p, const struct scene *s)
{
    status result = OK;
    for (int b = 0; b < s->bodies && result == OK; b++) {
        if (!s->body[b].file || !(s->spacing > 0)) continue;
        struct crowd c = {.p = p, .s = s, .body = b, .reach = fill_lists_reach_of(s) * s->spacing * (1 + 1e-9)};
        crowd_take(&c);
        if (c.n > FEW) {
            const struct verdict v = crowd_look(&c);
            result = crowd_judge(&c, &v);
        }
        for (int d = 0; d < DIM_MAX; d++) memory_free(c.X[d]);
        memory_free(c.volume);
    }
    return result;
}
