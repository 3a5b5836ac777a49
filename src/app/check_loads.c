/* Prints for each load and support the number of its particles, its area, force and moment. In input files with planes
 * of symmetry, these belong to the part of the body that is computed. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "check_parts.h"

#define NOTHING 1e-10 /* largest sum that counts as round-off, as a share of the sum of absolute values */
enum { SAID = 20 };   /* largest number of loads and supports that are printed */

/* ---- when -------------------------------------------------------------------------------------------------------- */

/* Time at which a load is evaluated [s], and the reason for this time. */
struct instant {
    real t;
    const char *why;
};

/* If the time t [s] is between 0 and `duration` [s], and |f(t)| of the function of time f is larger than *most, stores
 * t in *best and |f(t)| in *most. */
static void instant_try(const struct time_function *f, real t, real duration, real *best, real *most)
{
    if (t < 0 || t > duration || !(fabs(time_function_value(f, t)) > *most)) return;
    *best = t, *most = fabs(time_function_value(f, t));
}

/* Returns the time between 0 and `duration` at which the absolute value of the time function f is largest, the earliest
 * of several [s]. *most: receives this absolute value. */
static real largest_factor_at(const struct time_function *f, real duration, real *most)
{
    real best = *most = 0;
    const real middle = 0.5 * (f->from + f->until);
    instant_try(f, 0, duration, &best, most);
    for (int k = 0; k < f->n; k++) instant_try(f, f->t[k], duration, &best, most);
    if (f->kind == TIME_STEP || f->kind == TIME_PULSE || f->kind == TIME_RAMP)
        instant_try(f,
                    f->kind == TIME_STEP    ? f->from
                    : f->kind == TIME_PULSE ? middle
                                            : f->until,
                    duration, &best, most);
    instant_try(f, duration, duration, &best, most);
    return best;
}

enum { MOMENTS = 200, PLACES = 64 }; /* numbers of times, and of particles of a load, at which formulas are evaluated */

/* Type of functions that compute a vector of the k-th particle of load l (an index in p) at time t [s], its force [N]
 * or its displacement [m], and store it in vector[dim]. */
typedef void vector_fn(const struct load *l, const struct particles *p, int64_t k, real t, real *vector);

/* Returns the sum of |a|^2 over a sample of the particles of load l (indices in p) at time t [s], in the squared unit
 * of a. vector: function that computes a, the force [N] or displacement [m] of one particle. */
static real square_sum(const struct load *l, const struct particles *p, vector_fn *vector, real t)
{
    real sum = 0, a[DIM_MAX];
    for (int64_t k = 0; k < l->n; k += 1 + l->n / PLACES) vector(l, p, k, t, a), sum += dot(a, a, p->dim);
    return sum;
}

/* Returns the time between 0 and `duration` at which the vectors of load l on its particles (indices in p) are largest
 * [s]. Tests evenly spaced times and the times of the load's table. Returns `duration` unless they are larger at an
 * earlier time. vector: function that computes the force or displacement of one particle. */
static real largest_at(const struct load *l, const struct particles *p, vector_fn *vector, real duration)
{
    const struct time_function *f = &l->boundary->time;
    const real last = square_sum(l, p, vector, duration) * (1 + NOTHING);
    real best = duration, most = isfinite(last) ? last : -1;
    for (int k = 0; k < MOMENTS + f->n; k++) {
        const real t = k < MOMENTS ? duration * k / MOMENTS : f->t[k - MOMENTS];
        const real now = t >= 0 && t < duration ? square_sum(l, p, vector, t) : 0;
        if (now > most && isfinite(now)) best = t, most = now;
    }
    return best;
}

/* Returns the time at which the force of load l on its particles p is reported, with a text that gives the reason: the
 * time at which the force is largest, or `duration`, the end of the run [s], as in static problems. */
static struct instant instant_of(const struct load *l, const struct particles *p, real duration)
{
    const struct boundary *b = l->boundary;
    real most;
    if (b->frozen) return (struct instant){duration, "at the end"};
    if (boundary_formula_depends_on_time(b)) {
        const real worst = largest_at(l, p, load_force_on_particle, duration);
        return (struct instant){worst, worst < duration ? "when it is largest" : "at the end"};
    }
    const real t = largest_factor_at(&b->time, duration, &most);
    if (b->time.kind == TIME_CONSTANT) return (struct instant){0, "at all times"};
    return (struct instant){t, most > 0 ? "when it is largest" : "because it begins after the end of the run"};
}

/* ---- how much ---------------------------------------------------------------------------------------------------- */

/* Total force and moment of a load. */
struct resultant {
    real force[DIM_MAX], moment[DIM_MAX];
}; /* [N], about the origin [N m] */

/* Returns the total force and the moment about the origin of load l at time t [s], summed over its particles p. Sums
 * that are only round-off of the summed terms are set to 0. */
static struct resultant resultant_at(const struct load *l, const struct particles *p, real t)
{
    struct resultant r = {{0}, {0}};
    real all = 0, turning = 0;
    for (int64_t k = 0; k < l->n; k++) {
        real f[DIM_MAX] = {0}, X[DIM_MAX] = {0};
        load_force_on_particle(l, p, k, t, f);
        particle_reference_position(p, l->particle[k], X);
        for (int d = 0; d < DIM_MAX; d++) {
            const int u = (d + 1) % DIM_MAX, v = (d + 2) % DIM_MAX;
            r.force[d] += f[d], r.moment[d] += X[u] * f[v] - X[v] * f[u];
            all += fabs(f[d]), turning += fabs(X[u] * f[v]) + fabs(X[v] * f[u]);
        }
    }
    for (int d = 0; d < DIM_MAX; d++) {
        if (fabs(r.force[d]) < NOTHING * all) r.force[d] = 0;
        if (fabs(r.moment[d]) < NOTHING * turning) r.moment[d] = 0;
    }
    return r;
}

static void say_vector(const real *a, int n) { printf(n > 1 ? "(%s)" : "%s", position_text(a, n, 4).text); }

/* ---- areas ------------------------------------------------------------------------------------------------------- */

/* Faces on which a pressure acts, compared with the shapes of their bodies. */
struct faced {
    const struct run *e;
    real area;       /* sum of the areas of the faces [m^2] */
    real along, off; /* sum of the areas projected to the surfaces of the shapes [m^2]; sum of area times distance from
                        the surface, outside positive [m^3] */
    bool unknown;    /* the distance from the shape of at least one body is not known */
};

/* Returns true if distances from the surface of body number `body` of scene s (the input file) can be computed: its
 * shape is not infinite, not from a particle list, a voxel image or a surface file, and not shared with joined
 * bodies. */
static bool has_distance(const struct scene *s, int body)
{
    const struct region *shape = &s->body[body].shape;
    bool has = !s->body[body].file && shape->n > 0 && !region_has_box_with_infinite_side(shape, s->dim);
    for (int b = 0; b < s->bodies; b++) has &= b == body || s->body[b].joined != body;
    for (int k = 0; k < shape->n; k++)
        has &= shape->solid[k].kind != SOLID_VOXELS && shape->solid[k].kind != SOLID_HULL &&
               shape->solid[k].kind != SOLID_ALL;
    return has;
}

/* Adds one exposed face of particle i to three sums in *context, a struct faced: the area of the face, the area
 * projected on the surface of the body's shape [m^2], and the projected area times the signed distance of the face from
 * this surface [m^3]. The face is normal to `axis`, outwards in the direction `side` (1 or -1). area: area of the face
 * [m^2]. pressure_boundary_visit_free_faces calls it for each face. */
static void face_beside_shape(void *context, int32_t i, int axis, int side, real area)
{
    struct faced *f = context;
    const struct particles *p = &f->e->part;
    const int body = p->body[i];
    real X[DIM_MAX], normal[DIM_MAX] = {0};
    f->area += area;
    f->unknown |= !has_distance(f->e->scene, body);
    if (f->unknown) return;
    particle_reference_position(p, i, X);
    X[axis] += 0.5 * side * f->e->scene->spacing;
    const real off = region_signed_distance(&f->e->scene->body[body].shape, X, p->dim, normal);
    f->along += area * side * normal[axis];
    f->off += area * side * normal[axis] * off;
}

/* Prints the area on which the pressure load number `which` of the run acts, and how far this area is from the surface
 * of the body's shape. The pressure acts on faces of particles. Along a slanted or curved surface these form steps,
 * whose total area exceeds that of the surface, so each face is projected on the surface. Prints the sum of the
 * projected areas, and the mean distance of the faces from the surface: negative distances are below it. The radius of
 * a bore differs from that of its particles by this distance. Prints the area of the faces if the normals of the shape
 * are not known. */
static void say_pressed(const struct run *run, int which)
{
    const struct load *l = &run->loads.load[which];
    const real spacing = run->scene->spacing;
    struct faced f = {.e = run};
    uint8_t *selected = NEW("check.selected", run->part.n, uint8_t);
    boundary_select_particles_in_region(l->boundary, &run->part, spacing, selected);
    pressure_boundary_visit_free_faces(run->loads.load[0].boundary, run->loads.n, which, &run->part, spacing, selected,
                                       face_beside_shape, &f);
    memory_free(selected);
    if (f.unknown || !(f.along > 0)) {
        printf(", %.4g m^2 of faces of particles", f.area);
        return;
    }
    const real off = f.off / f.along;
    printf(", %.4g m^2", f.along);
    if (fabs(off) > 1e-3 * spacing)
        printf(" %.2g spacings %s the surface of its shape on average", fabs(off) / spacing,
               off < 0 ? "below" : "above");
}

/* Computes *area, the exact area of a face of a body of scene s (the input file) within the region of boundary b [m^2]:
 * the face normal to axis b->face of a body that is a box along the axes. Returns false if the body is no such box, or
 * if no part of the face is in the region. */
static bool face_exact(const struct scene *s, const struct boundary *b, real *area)
{
    const int body = b->body >= 0 ? b->body : 0;
    const struct region *shape = &s->body[body].shape, *region = &b->region;
    if ((b->body < 0 && s->bodies > 1) || s->body[body].file || shape->n != 1 || region->n > 1) return false;
    if (!solid_is_untransformed_and_of_kind(&shape->solid[0], SOLID_BOX) ||
        (region->n == 1 && !solid_is_untransformed_and_of_kind(&region->solid[0], SOLID_BOX)))
        return false;
    *area = b->section > 0 ? b->section : 1;
    for (int d = 0; d < s->dim; d++) {
        real from = shape->solid[0].from[d], to = shape->solid[0].to[d];
        if (region->n) from = real_max(from, region->solid[0].from[d]), to = real_min(to, region->solid[0].to[d]);
        if (d != b->face) *area *= to - from;
    }
    return *area > 0;
}

static void say_traction_area(const struct scene *scene, const struct load *l)
{
    real area = 0, exact;
    for (int64_t k = 0; k < l->n; k++)
        area += l->boundary->kind == BOUNDARY_ABSORBING ? l->outer[k] : l->share[l->boundary->face][k];
    printf(", %.4g m^2", area);
    if (face_exact(scene, l->boundary, &exact) && fabs(area / exact - 1) >= OFF_LEAST)
        printf(" (%.2f %% %s than the face of its box)", 100 * fabs(area / exact - 1), area > exact ? "more" : "less");
}

/* ---- lines ------------------------------------------------------------------------------------------------------- */

/* Prints, as part of a sentence, the total force and moment of load l, the time for which they are computed and the
 * reason for this time. part, scene: particles and scene of the load. */
static void say_force(const struct particles *part, const struct scene *scene, const struct load *l)
{
    const int dim = part->dim;
    const struct instant at = instant_of(l, part, scene->duration);
    const struct resultant r = resultant_at(l, part, at.t);
    if (!isfinite(dot(r.force, r.force, DIM_MAX) + dot(r.moment, r.moment, DIM_MAX))) {
        printf("; its force has no finite value at %.4g s", at.t);
        return;
    }
    printf("; force ");
    say_vector(r.force, dim);
    printf(" N");
    if (dim > 1) printf(", moment about the origin ");
    if (dim > 1) say_vector(dim == 2 ? &r.moment[2] : r.moment, dim == 2 ? 1 : DIM_MAX);
    printf("%s %s", dim > 1 ? " N m" : "", at.why);
    if (at.why[0] == 'w') printf(", at %.4g s", at.t);
}

static void say_support(const struct particles *part, const struct load *l)
{
    const struct boundary *b = l->boundary;
    const char *between = "";
    if (b->kind == BOUNDARY_MIRROR) {
        printf("plane of %ssymmetry at %c = %.4g m", b->hold_tangential ? "anti" : "", "xyz"[b->axis], b -> at);
        return;
    }
    for (int d = 0; d < part->dim && !b->rotates; d++) {
        if (!(b->components >> d & 1)) continue;
        printf("%s%c", between, "xyz"[d]);
        between = ", ";
    }
    bool moves = b->rotates;
    for (int d = 0; d < part->dim; d++) moves |= b->value[d] != 0;
    printf(b->rotates ? "on circles" : moves ? " driven" : " held");
}

static void say_mean_displacement(const struct particles *part, const struct load *l, real t)
{
    real mean[DIM_MAX] = {0}, u[DIM_MAX];
    for (int64_t k = 0; k < l->n; k++) {
        load_prescribed_displacement_of_particle(l, part, k, t, u);
        for (int d = 0; d < part->dim; d++) mean[d] += u[d] / (real)l->n;
    }
    if (!isfinite(mean[0] + mean[1] + mean[2])) {
        printf("no finite value");
        return;
    }
    say_vector(mean, part->dim);
    printf(" m%s", boundary_motion_varies_in_space(l->boundary) ? " on average" : "");
}

/* Prints the mean displacement that the support l prescribes for its particles (indices in part), at its maximum and at
 * the end of the run, and its largest speed if the solver of `scene` is explicit. */
static void say_displacement(const struct scene *scene, const struct particles *part, const struct load *l)
{
    const bool explicit = scene->solver == SOLVER_EXPLICIT, frozen = l->boundary->frozen;
    const real end = frozen ? INFINITY : scene->duration;
    const real most = frozen ? end : largest_at(l, part, load_prescribed_displacement_of_particle, end);
    printf("; by ");
    if (most < end) {
        say_mean_displacement(part, l, most);
        printf(" when it is largest, at %.4g s, by ", most);
    }
    say_mean_displacement(part, l, end);
    printf(" at the end");
    const real speed = explicit ? load_largest_speed_of_prescribed_displacement(l, part, scene->duration) : INFINITY;
    if (isfinite(speed)) printf(", at most %.3g m/s", speed);
}

static void say_load(const struct run *run, int which)
{
    static const char *const words[] = {[BOUNDARY_TRACTION] = "traction",
                                        [BOUNDARY_BODY_FORCE] = "body force",
                                        [BOUNDARY_ABSORBING] = "absorbing",
                                        [BOUNDARY_PRESSURE] = "pressure"};
    const struct load *l = &run->loads.load[which];
    const struct boundary *b = l->boundary;
    const bool force = boundary_applies_force(b), faces = b->side != 0;
    printf("%-15s%s: ", force ? "load" : "support", b->name);
    if (b->kind == BOUNDARY_VELOCITY || b->kind == BOUNDARY_MIRROR)
        say_support(&run->part, l);
    else
        printf("%s", b->by_mass ? "weight" : words[b->kind]);
    if (faces) printf(" on %c%c", "xyz"[b->face], b -> side > 0 ? '+' : '-');
    if (b->kind != BOUNDARY_MIRROR) printf(", %lld particle%s", (long long)l->n, l->n == 1 ? "" : "s");
    if (faces && b->kind != BOUNDARY_VELOCITY && (b->formula[b->face].n == 0 || l->moving)) /* shares are areas */
        say_traction_area(run->scene, l);
    if (b->kind == BOUNDARY_PRESSURE) say_pressed(run, which);
    if (force) say_force(&run->part, run->scene, l);
    if (b->displaces) say_displacement(run->scene, &run->part, l);
    if (faces) print_fraction_of_loaded_face_not_normal_to_axis(run, b);
    putchar('\n');
}

/* ---- balance ----------------------------------------------------------------------------------------------------- */

#define UNBALANCED 0.01 /* net force divided by the sum of all forces, from which on loads do not balance [1] */
#define LASTING 0.5     /* net force at the end divided by the largest one, from which on the load lasts [1] */
#define CROSSED 2.0     /* passages of waves through the body after which it is faster than the waves in it [1] */
enum { INSTANTS = 64 }; /* times at which the net force is evaluated */

/* Largest net force of the loads on a body along the axes along which no support holds it, and the motion of the body
 * by this force during the run. */
struct drift {
    real force[DIM_MAX], net;               /* largest net force and its magnitude [N] */
    real acceleration, speed, displacement; /* by this force [m/s^2]; at the end of the run [m/s], [m] */
    int axis;                               /* axis of the largest component of the force */
    bool lasts;                             /* the net force acts at the end as well, and waves have crossed the body */
};

/* Returns true if scene s (the input file) has a single body that moves in time and can touch no other body. Returns
 * false if some particles of the body are not created (in coarse cells). p: particles. */
static bool is_single_body(const struct scene *s, const struct particles *p)
{
    bool is_single = scene_is_dynamic(s) && s->rigids == 0 && p->n > 0 && p->n == p->n_body;
    for (int b = 1; b < s->bodies; b++) is_single = is_single && s->body[b].joined == 0;
    return is_single;
}

/* Returns true if a boundary in `loads` resists motion of the body along axis d (0, 1 or 2 for x, y or z): an absorbing
 * face, a plane of symmetry normal to the axis, a clamped plane, or a prescribed motion that rotates the body or has a
 * component along the axis. */
static bool is_held_along(const struct loads *loads, int d)
{
    bool held = false;
    for (int k = 0; k < loads->n; k++) {
        const struct boundary *b = loads->load[k].boundary;
        held |= b->kind == BOUNDARY_ABSORBING || (b->kind == BOUNDARY_MIRROR && (b->axis == d || b->hold_tangential)) ||
                (b->kind == BOUNDARY_VELOCITY && (b->rotates || b->components >> d & 1));
    }
    return held;
}

/* Computes force[DIM_MAX], the net force of all loads on the particles p at time t [s], except those proportional to
 * mass such as gravity [N]. Components along axes without is_free[axis] are 0. Returns the sum of the magnitudes of the
 * forces of the single loads [N]. */
static real net_force(const struct loads *loads, const struct particles *p, const bool *is_free, real t, real *force)
{
    real all = 0;
    for (int d = 0; d < DIM_MAX; d++) force[d] = 0;
    for (int b = 0; b < loads->n; b++) {
        if (loads->load[b].boundary->by_mass || !boundary_applies_force(loads->load[b].boundary)) continue;
        const struct resultant r = resultant_at(&loads->load[b], p, t);
        for (int d = 0; d < DIM_MAX; d++) force[d] += is_free[d] ? r.force[d] : 0;
        all += sqrt(dot(r.force, r.force, DIM_MAX));
    }
    return all;
}

/* Computes in *a the motion of the body of the run by the net force of its loads, along the axes along which no support
 * holds it, by integration with the midpoint rule. Returns false if the loads balance along these axes, or if the input
 * file is static or has several bodies (is_single_body). */
static bool drift_by_loads(const struct run *run, struct drift *a)
{
    real force[DIM_MAX], v[DIM_MAX] = {0}, u[DIM_MAX] = {0}, mass = 0, all = 0, low, high;
    const real dt = run->scene->duration / INSTANTS;
    bool is_free[DIM_MAX] = {false};
    *a = (struct drift){.axis = 0};
    if (!is_single_body(run->scene, &run->part)) return false;
    for (int d = 0; d < run->part.dim; d++) is_free[d] = !is_held_along(&run->loads, d);
    for (int64_t i = 0; i < run->part.n; i++) mass += run->part.mass[i];
    for (int k = 0; k < INSTANTS; k++) {
        all = real_max(all, net_force(&run->loads, &run->part, is_free, (k + 0.5) * dt, force));
        if (dot(force, force, DIM_MAX) > dot(a->force, a->force, DIM_MAX)) memcpy(a->force, force, sizeof force);
        for (int d = 0; d < DIM_MAX; d++)
            u[d] += dt * (v[d] + 0.5 * dt * force[d] / mass), v[d] += dt * force[d] / mass;
    }
    a->net = sqrt(dot(a->force, a->force, DIM_MAX)), a->acceleration = a->net / mass;
    a->speed = sqrt(dot(v, v, DIM_MAX)), a->displacement = sqrt(dot(u, u, DIM_MAX));
    for (int d = 1; d < run->part.dim; d++)
        if (fabs(a->force[d]) > fabs(a->force[a->axis])) a->axis = d;
    particles_coordinate_range(&run->part, run->part.n, a->axis, &low, &high);
    a->lasts = sqrt(dot(force, force, DIM_MAX)) > LASTING * a->net &&
               run->tables.wave_speed * run->scene->duration > CROSSED * (high - low + run->scene->spacing);
    return a->net > UNBALANCED * all && isfinite(a->net);
}

/* Writes to `out` the largest net force on the body of the run along axis a->axis, along which no support holds the
 * body, and the motion of the body by this force. a: force and motion. */
static void write_drift(const struct run *run, const struct drift *a, FILE *out)
{
    fprintf(out,
            "the loads do not balance, and nothing holds the body along %c: net force up to %s%s%s N, acceleration "
            "%.3g m/s^2; at the end its mean velocity has changed by %.3g m/s and it has drifted %.3g m",
            "xyz"[a->axis], run -> part.dim > 1 ? "(" : "", position_text(a->force, run->part.dim, 4).text,
            run->part.dim > 1 ? ")" : "", a->acceleration, a->speed, a->displacement);
}

void print_advice_on_unbalanced_loads(const struct run *run, FILE *out)
{
    struct drift a;
    if (!drift_by_loads(run, &a) || !a.lasts) return;
    fprintf(out, "accuracy       ");
    write_drift(run, &a, out);
    fprintf(out, ": hold a face along %c, or balance the loads\n", "xyz"[a.axis]);
}

/* Prints the net force of the loads of the run if they do not balance along an axis along which no support holds the
 * body, unless print_advice_on_unbalanced_loads writes about it. */
static void say_balance_of_loads(const struct run *run)
{
    struct drift a;
    if (!drift_by_loads(run, &a) || a.lasts) return;
    printf("balance        ");
    write_drift(run, &a, stdout);
    putchar('\n');
}

void print_loads_and_supports(const struct run *run)
{
    for (int b = 0; b < run->loads.n && b < SAID; b++) say_load(run, b);
    if (run->loads.n > SAID) printf("load           and %d more loads and supports\n", run->loads.n - SAID);
    say_balance_of_loads(run);
}
