/* Selects the particles of an output frame that a map shows, and computes their drawn positions. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "plot/plot.h"

/* Numbers of particles that are sampled to estimate the spacing: at most SAMPLES, and at least SAMPLES_MIN if more
 * would require over COMPARISONS comparisons of distances. */
enum { SAMPLES = 200, SAMPLES_MIN = 9 };
static const double COMPARISONS = 2e7;
/* Tolerance for distances from a plane [spacings]: two layers of particles whose distances differ by less count as
 * equally near. */
static const double TIE = 1e-3;

/* ---- spacing ----------------------------------------------------------------------------------------------------- */

/* Returns how many of n particles are sampled to estimate the spacing: so few that the number of distance comparisons,
 * samples times n, is at most about COMPARISONS, but between SAMPLES_MIN and SAMPLES, and at most n. */
static int64_t sample_count(int64_t n)
{
    int64_t samples = (int64_t)(COMPARISONS / (double)(n + 1));
    samples = samples > SAMPLES ? SAMPLES : samples < SAMPLES_MIN ? SAMPLES_MIN : samples;
    return samples < n ? samples : n;
}

/* Returns the mean distance [m] of particle i of output frame f from its f->dim nearest neighbours. On a lattice this
 * is the spacing, because even a particle at a corner has as many neighbours at this distance. */
static double near_distance(const struct output_frame *f, int64_t i)
{
    double nearest[DIM_MAX];
    for (int k = 0; k < f->dim; k++) nearest[k] = INFINITY;
    for (int64_t j = 0; j < f->n; j++) {
        double r2 = j == i ? INFINITY : 0;
        for (int d = 0; d < f->dim; d++) r2 += square(f->X[d][j] - f->X[d][i]);
        for (int k = 0; k < f->dim; k++) { /* insert in ascending order */
            if (r2 >= nearest[k]) continue;
            double passed = nearest[k];
            nearest[k] = r2;
            r2 = passed;
        }
    }
    double sum = 0;
    for (int k = 0; k < f->dim; k++) sum += sqrt(nearest[k]);
    return sum / f->dim;
}

static double least_spacing(const struct output_frame *f)
{
    double least = INFINITY;
    for (int64_t i = 0; i < f->n; i++) least = fmin(least, f->spacing[i]);
    return least;
}

double frame_particle_spacing(const struct output_frame *f)
{
    double distance[SAMPLES];
    int64_t samples = sample_count(f->n), known = 0;
    if (f->spacing && f->n > 0) return least_spacing(f);
    for (int64_t k = 0; k < samples; k++) {
        double r = near_distance(f, k * f->n / samples);
        if (isfinite(r)) distance[known++] = r;
    }
    if (known == 0) return 0;
    return median_by_sorting(distance, known);
}

/* Returns true if the direction from particle i to its nearest neighbour is within 8 degrees of one of the dim axes.
 * X[dim][n]: reference positions of n particles along the axes [m]. */
static bool lies_along(double *const *X, int dim, int64_t n, int64_t i)
{
    double best = INFINITY, along = 0, across = 1;
    for (int64_t j = 0; j < n; j++) {
        double largest = 0, r2 = 0;
        for (int d = 0; d < dim; d++) {
            const double a = fabs(X[d][j] - X[d][i]);
            largest = fmax(largest, a), r2 += a * a;
        }
        if (j == i || r2 >= best) continue;
        best = r2;
        along = largest;
        across = sqrt(r2 - largest * largest);
    }
    return across < 0.14 * along; /* tan 8 degrees */
}

bool particles_are_on_lattice(double *const *X, int dim, int64_t n)
{
    int64_t samples = sample_count(n), along = 0;
    for (int64_t k = 0; k < samples; k++) along += lies_along(X, dim, n, k * n / samples);
    return 10 * along >= 9 * samples;
}

/* ---- slices ------------------------------------------------------------------------------------------------------ */

/* Computes the smallest and the largest coordinate along axis d of the reference positions of all particles of the
 * output frame f, and stores them in *from and *to [m]. */
static void frame_extent(const struct output_frame *f, int d, double *from, double *to)
{
    *from = INFINITY, *to = -INFINITY;
    for (int64_t i = 0; i < f->n; i++) {
        *from = fmin(*from, f->X[d][i]);
        *to = fmax(*to, f->X[d][i]);
    }
}

/* Returns the coordinate axis (0 .. 2) along which the particles of output frame f have the smallest extent; the last
 * one of equal axes. */
static int thinnest_direction(const struct output_frame *f)
{
    double thinnest = INFINITY;
    int normal = 2;
    for (int d = 0; d < 3; d++) {
        double from, to;
        frame_extent(f, d, &from, &to);
        if (to - from > thinnest * (1 + 1e-5)) continue; /* tolerance: round-off */
        thinnest = to - from;
        normal = d;
    }
    return normal;
}

/* Returns the coordinate along the axis `normal` [m] of the particle of output frame f whose coordinate is nearest to
 * `wanted` [m], the lower one of two whose distances differ by less than TIE spacings. */
static double nearest_coordinate(const struct output_frame *f, int normal, double wanted)
{
    const double tie = TIE * frame_particle_spacing(f);
    double best = INFINITY, at = wanted;
    for (int64_t i = 0; i < f->n; i++) {
        const double place = f->X[normal][i], off = fabs(place - wanted);
        if (off >= best + tie || (off > best - tie && place >= at)) continue;
        best = off;
        at = place;
    }
    return at;
}

/* Computes weight[layers], by which the layer that a slice shows is chosen, for each layer of particles of output frame
 * f along the axis `normal`: the sum of damage. If no particle is damaged, it is the largest magnitude of value[f->n]
 * instead (0 if value is NULL). weight: 0 before; from: coordinate of the first layer [m]; spacing: distance of layers
 * [m]. Returns the largest weight. */
static double layers_weigh(double *weight, int layers, const struct output_frame *f, int normal, const float *value,
                           double from, double spacing)
{
    double most = 0;
    for (int pass = 0; pass < 1 + (value != NULL) && !(most > 0); pass++)
        for (int64_t i = 0; i < f->n; i++) {
            const int layer = layers > 1 ? (int)lround((f->X[normal][i] - from) / spacing) : 0;
            const double own = pass == 0 ? f->damage[i] : fabs(value[i]);
            if (isfinite(own)) weight[layer] = pass == 0 ? weight[layer] + own : fmax(weight[layer], own);
            most = fmax(most, weight[layer]);
        }
    return most;
}

/* Returns the coordinate along the axis `normal` [m] of the particle layer of output frame f that a slice shows. It is
 * the layer nearest to the middle among those whose sum of damage is at least 0.98 of the largest sum; in an undamaged
 * body, among those whose largest magnitude of value[f->n] is at least 0.98 of the largest one; without values (NULL),
 * the layer nearest to the middle. Of two such layers it is the lower one. */
static double telling_layer(const struct output_frame *f, int normal, const float *value)
{
    enum { LAYERS_MAX = 100000 };
    static const double NEARLY = 0.98;
    double from, to, best = INFINITY, spacing = frame_particle_spacing(f);
    frame_extent(f, normal, &from, &to);
    const double middle = 0.5 * (from + to);
    const int layers = spacing > 0 && (to - from) / spacing < LAYERS_MAX ? (int)((to - from) / spacing) + 2 : 1;
    double *weight = NEW("plot.layers", layers, double), at = middle;
    const double most = layers_weigh(weight, layers, f, normal, value, from, spacing);
    for (int k = 0; k < layers && most > 0; k++) {
        const double place = from + k * spacing, off = fabs(place - middle);
        if (weight[k] < NEARLY * most || off >= best - TIE * spacing) continue;
        best = off, at = place;
    }
    memory_free(weight);
    return nearest_coordinate(f, normal, at);
}

status projection_choose_slice_normal_and_position(struct projection *projection, const struct output_frame *f,
                                                   const char *path)
{
    float *value = NULL;
    if (f->dim < 3 || projection->outside) return OK;
    if (projection->normal < 0) projection->normal = thinnest_direction(f);
    if (!projection->placed) {
        if (projection->field && colour_map_kind_for_field(projection->field) == MAP_FIELD)
            TRY(plot_field_read(&value, projection->field, f, path));
        projection->layer = telling_layer(f, projection->normal, value);
        projection->placed = true;
        memory_free(value);
        return OK;
    }
    double from, to;
    const double near = nearest_coordinate(f, projection->normal, projection->layer);
    frame_extent(f, projection->normal, &from, &to);
    if (fabs(near - projection->layer) > frame_particle_spacing(f)) {
        const struct unit metre = unit_for_length(fmax(fabs(from), fabs(to)));
        return status_set(REFUSED,
                          "plot: --slice %c=%.4g %s: no particle is at this position; give one from %.4g to %.4g %s",
                          'x' + projection->normal, projection->layer / metre.factor, metre.name, from / metre.factor,
                          to / metre.factor, metre.name);
    }
    projection->layer = near;
    return OK;
}

/* ---- clouds ------------------------------------------------------------------------------------------------------ */

const struct camera camera_isometric = {
    {0.86602540378, 0.5, 0}, {-0.25, 0.43301270189, 0.86602540378}, {0.43301270189, -0.75, 0.5}};

struct camera camera_along_axis(int axis, int side)
{
    struct camera c = {{0}, {0}, {0}};
    const int right = axis == 0 ? 1 : 0, up = axis == 2 ? 1 : 2;
    c.towards[axis] = side;
    c.up[up] = 1;
    c.right[right] = (axis == 1 ? -1 : 1) * side; /* right, up and towards are right-handed */
    return c;
}

/* Computes the drawn position x[3] = X + magnify u of particle i of output frame f [m]; components that the run lacks
 * are 0. magnify: factor on displacements [1]. */
static void place_now(const struct output_frame *f, int64_t i, double magnify, double *x)
{
    for (int d = 0; d < 3; d++) x[d] = d < f->dim ? f->X[d][i] + magnify * f->u[d][i] : 0;
}

static double along(const double *direction, const double *x)
{
    return direction[0] * x[0] + direction[1] * x[1] + direction[2] * x[2];
}

/* Appends particle i of the output frame f to `plotted`, the drawn particles: its drawn position and its reference
 * position along the axes of the map. Extends the bounding box of the cloud by the reference position. */
static void cloud_place(struct plotted_particles *plotted, const struct output_frame *f, int64_t i)
{
    const int64_t k = plotted->n;
    double x[3], X[3];
    place_now(f, i, plotted->magnify, x);
    for (int d = 0; d < 3; d++) X[d] = d < f->dim ? f->X[d][i] : 0;
    const double *axis[3] = {plotted->camera.right, plotted->camera.up, plotted->camera.towards};
    for (int a = 0; a < 3; a++)
        if (plotted->position[a]) plotted->position[a][k] = along(axis[a], x);
    for (int a = 0; a < 2; a++) {
        plotted->reference[a][k] = along(axis[a], X);
        plotted->from[a] = fmin(plotted->from[a], along(axis[a], X));
        plotted->to[a] = fmax(plotted->to[a], along(axis[a], X));
    }
}

/* Copies the planes of symmetry of the scene s to `plotted`, the drawn particles; s may be NULL: there are none. */
static void cloud_copy_mirrors(struct plotted_particles *plotted, const struct scene *s)
{
    for (int b = 0; s && b < s->boundaries && plotted->mirrors < MIRRORS_SHOWN_MOST; b++)
        if (s->boundary[b].kind == BOUNDARY_MIRROR)
            plotted->mirror[plotted->mirrors++] = (struct shown_mirror){s->boundary[b].axis, s->boundary[b].at};
}

static void cloud_allocate(struct plotted_particles *plotted, const struct output_frame *f,
                           const struct projection *projection)
{
    for (int k = 0; k < (f->dim == 3 && projection->outside ? 3 : 2); k++)
        plotted->position[k] = NEW("plot.position", f->n, double);
    plotted->damage = NEW("plot.damage", f->n, float);
    plotted->kind = NEW("plot.kind", f->n, uint8_t);
    if (f->fragment) plotted->fragment = NEW("plot.fragment", f->n, int32_t);
    if (f->spacing) plotted->size = NEW("plot.size", f->n, float);
    if (projection->value) plotted->value = NEW("plot.value", f->n, float);
}

/* Sets the axes of the map in `plotted`, the drawn particles of output frame f (output of one time): x and y in 2D; in
 * 3D, as `projection` requests, the axes in the plane of the slice or the directions of the camera. */
static void cloud_axes(struct plotted_particles *plotted, const struct output_frame *f,
                       const struct projection *projection)
{
    plotted->camera = f->dim == 3 && projection->outside ? projection->camera : camera_along_axis(2, 1);
    if (f->dim < 3 || projection->outside) return;
    plotted->normal = projection->normal, plotted->layer = projection->layer;
    plotted->axis[0] = plotted->normal == 0 ? 1 : 0;
    plotted->axis[1] = plotted->normal == 2 ? 1 : 2;
    plotted->camera = camera_along_axis(plotted->normal, plotted->normal == 1 ? -1 : 1);
}

/* Selects in `plotted` the particles of output frame f that a map with the given projection shows, with their drawn
 * positions, deformation and fields (plotted_particles_select_from_frame). projection: NULL for a default slice. The
 * sizes of particles must be in f->spacing, unless all particles have one size. */
static void cloud_select(struct plotted_particles *plotted, const struct output_frame *f,
                         const struct projection *projection)
{
    struct projection open = {.normal = -1};
    if (!projection) (void)projection_choose_slice_normal_and_position(&open, f, NULL), projection = &open;
    *plotted = (struct plotted_particles){.axis = {0, 1},
                                          .normal = -1,
                                          .t = f->t,
                                          .spacing = frame_particle_spacing(f),
                                          .magnify = projection->magnify > 0 ? projection->magnify : 1,
                                          .in_steps = projection->in_steps,
                                          .equilibrium = projection_shows_single_equilibrium_run(projection),
                                          .step = f->step,
                                          .from = {INFINITY, INFINITY},
                                          .to = {-INFINITY, -INFINITY}};
    cloud_axes(plotted, f, projection);
    cloud_copy_mirrors(plotted, projection->scene);
    cloud_allocate(plotted, f, projection);
    for (int a = 0; a < 2; a++) plotted->reference[a] = NEW("plot.reference", f->n, double);
    plotted->apart = NEW("plot.apart", f->n, uint8_t);
    plotted->gradient = deformation_gradients_fit_to_displacements(f, plotted->spacing, plotted->magnify,
                                                                   projection->scene, plotted->apart);
    for (int64_t i = 0; i < f->n; i++) {
        const double size = f->spacing ? f->spacing[i] : plotted->spacing;
        if (f->fragment && f->fragment[i] >= plotted->fragments) plotted->fragments = f->fragment[i] + 1;
        if (plotted->normal >= 0 &&
            fabs(f->X[plotted->normal][i] - plotted->layer) > 0.5 * size - 0.01 * plotted->spacing)
            continue;
        if (f->spacing) plotted->size[plotted->n] = (float)size;
        cloud_place(plotted, f, i);
        if (plotted->gradient)
            memmove(plotted->gradient + 9 * plotted->n, plotted->gradient + 9 * i, 9 * sizeof *plotted->gradient);
        plotted->apart[plotted->n] = plotted->apart[i];
        plotted->damage[plotted->n] = f->damage[i];
        if (f->fragment) plotted->fragment[plotted->n] = f->fragment[i];
        if (plotted->value) plotted->value[plotted->n] = projection->value[i];
        plotted->kind[plotted->n++] = f->kind[i];
    }
    plotted->aligned = !plotted->position[2] && particles_are_on_lattice(plotted->reference, 2, plotted->n);
}

static bool has_lists(const struct scene *s)
{
    bool has = false;
    for (int b = 0; s && b < s->bodies; b++) has |= s->body[b].file != NULL;
    return has;
}

void plotted_particles_select_from_frame(struct plotted_particles *plotted, const struct output_frame *f,
                                         const struct projection *projection)
{
    struct output_frame sized = *f;
    float *size = NULL;
    if (projection && has_lists(projection->scene))
        size = frame_estimate_particle_sizes_if_graded(f, frame_particle_spacing(f));
    if (size && particles_are_on_lattice(f->X, f->dim, f->n)) sized.spacing = size;
    cloud_select(plotted, &sized, projection);
    memory_free(size);
}

status plotted_particles_read(struct plotted_particles *plotted, const char *folder, const struct listed_frame *frame,
                              const struct projection *projection)
{
    struct projection own = *projection;
    struct output_frame f;
    float *value = NULL;
    status s = OK;
    TRY(run_read_frame(&f, folder, frame->number));
    if (own.field) s = plot_field_read(&value, own.field, &f, run_frame_path(folder, frame->number).text);
    own.value = value;
    if (s == OK) plotted_particles_select_from_frame(plotted, &f, &own);
    if (s == OK) plotted_particles_add_rigid_bodies(plotted, &f, own.scene, folder, frame->number);
    memory_free(value);
    frame_free(&f);
    return s;
}

void plotted_particles_free(struct plotted_particles *plotted)
{
    for (int k = 0; k < DIM_MAX; k++) memory_free(plotted->position[k]);
    for (int k = 0; k < 2; k++) memory_free(plotted->reference[k]);
    memory_free(plotted->damage);
    memory_free(plotted->kind);
    memory_free(plotted->fragment);
    memory_free(plotted->size);
    memory_free(plotted->value);
    memory_free(plotted->colour);
    memory_free(plotted->gradient);
    memory_free(plotted->apart);
    memory_free(plotted->rigid);
    *plotted = (struct plotted_particles){0};
}
