/* Tests whether an input file equals its mirror image, by its particles: matter, cracks, initial velocities and loads.
 * Also tests whether one half of the body can be run alone. Rigid bodies and growing cracks must have mirror images,
 * and no rigid body may be free, since planes of symmetry do not act on it. No layer of particles may be in the plane,
 * and no integration domain of stress-intensity factors may cross it, since the body must contain these domains. */
#include <math.h>
#include <string.h>

#include "check_parts.h"
#include "base/memory.h"
#include "probes/probes.h"
#include "probes/probes_part.h"
#include "step/step.h"

#define NEAR_ENOUGH 1e-6 /* tolerance of positions [spacings], of vectors as a share of the largest component [1] */

/* Returns the index of the particle of the run at the position X[dim] [m]; -1 if there is none or more than one. */
static int64_t particle_at(const struct run *run, const real *X)
{
    int32_t found[4];
    const int n = cells_list_particles_near_point(&run->cells, &run->part, X, NEAR_ENOUGH * run->scene->spacing, -1,
                                                  found, COUNT_OF(found));
    return n == 1 && found[0] < run->part.n ? found[0] : -1;
}

static real largest(const real *a, int64_t n)
{
    real most = 0;
    for (int64_t i = 0; i < n; i++) most = real_max(most, fabs(a[i]));
    return most;
}

/* Returns true if the values a[n] of all particles are symmetric to within a tolerance of NEAR_ENOUGH times the largest
 * |a|: a[i] equals a[twin[i]], or -a[twin[i]] if `odd` is true, with the mirror image twin[i] of particle i. */
static bool agree(const real *a, const int32_t *twin, int64_t n, bool odd)
{
    const real most = NEAR_ENOUGH * largest(a, n);
    for (int64_t i = 0; i < n; i++)
        if (fabs(a[i] - (odd ? -a[twin[i]] : a[twin[i]])) > most) return false;
    return true;
}

/* Returns true if material, body, kind, strength, volume and initial damage of each particle equal those of its mirror
 * image. twin[i]: index of the mirror image of particle i of p. */
static bool matter_agrees(const struct particles *p, const int32_t *twin)
{
    for (int64_t i = 0; i < p->n; i++)
        if (p->material[i] != p->material[twin[i]] || p->body[i] != p->body[twin[i]] || p->kind[i] != p->kind[twin[i]])
            return false;
    if (p->strength && !agree(p->strength, twin, p->n, false)) return false;
    return agree(p->damage, twin, p->n, false) && agree(p->volume0, twin, p->n, false);
}

/* Returns true if narrow voids, which separate particles without removing any, are symmetric: particle i is beside a
 * void if and only if its mirror image twin[i] is. Also returns true if v is NULL. v: voids of the input file, or NULL
 * without voids; n: number of particles. */
static bool voids_agree(const struct voids *v, const int32_t *twin, int64_t n)
{
    for (int64_t i = 0; i < n && v; i++)
        if (v->near[i] != v->near[twin[i]]) return false;
    return true;
}

/* Returns a number that identifies the boundary condition b, computed from its kind and its function of time. Different
 * loads have different numbers, and sums of such numbers are rarely equal by chance. */
static real load_mark(const struct boundary *b)
{
    const struct time_function *t = &b->time;
    real mark = 1 + b->kind + 10.0 * t->kind + (b->displaces ? 0.377 : 0);
    if (t->kind != TIME_CONSTANT && t->kind != TIME_TABLE)
        mark += 0.1234 * t->from / (t->from + t->until + 1e-300) + 1e6 * t->until;
    for (int k = 0; k < t->n; k++) mark += (k + 1.618) * (t->t[k] * 1e6 + t->value[k]);
    return mark;
}

/* Computes two numbers for component d of the motion of each particle of part, by which the loads of mirror images are
 * compared. The number of a boundary is that of load_mark. ask[n]: sum of the loads and prescribed velocities of the
 * particle, each times the number of its boundary. held[n]: sum of the numbers of its prescribed velocities and
 * absorbing boundaries. In a symmetric input file the numbers of mirror images are equal except for signs. */
static void loads_ask(const struct particles *part, const struct loads *loads, int d, real *ask, real *held)
{
    array_fill_bytes(ask, 0, part->n, sizeof *ask);
    array_fill_bytes(held, 0, part->n, sizeof *held);
    for (int b = 0; b < loads->n; b++) {
        const struct load *l = &loads->load[b];
        const struct boundary *a = l->boundary;
        const bool drives = a->kind == BOUNDARY_VELOCITY;
        for (int64_t k = 0; k < l->n; k++) {
            if (drives && !(l->prescribes[k] >> d & 1)) continue;
            if (a->kind == BOUNDARY_ABSORBING) {
                held[l->particle[k]] += load_mark(a) * l->outer[k] * (d == a->face ? 2 : 1);
                continue;
            }
            ask[l->particle[k]] += load_mark(a) * a->value[d] * (drives ? 1 : l->share[d][k]);
            if (drives) held[l->particle[k]] += load_mark(a);
        }
    }
}

/* Returns true if loads, constraints and initial velocities of the particles p are symmetric about a plane normal to
 * `axis`. twin[p->n]: index of the mirror image of each particle. Returns false if a load is a formula or a rotating
 * support, whose symmetry is unknown. */
static bool loads_agree(const struct particles *p, const struct loads *loads, int axis, const int32_t *twin)
{
    real *ask = NEW("check.ask", p->n, real), *held = NEW("check.held", p->n, real);
    bool same = true;
    for (int b = 0; b < loads->n; b++) {
        const struct boundary *l = loads->load[b].boundary; /* the symmetry of a formula is unknown */
        same &= !l->rotates && l->formula[0].n + l->formula[1].n + l->formula[2].n == 0;
    }
    for (int d = 0; d < p->dim && same; d++) {
        loads_ask(p, loads, d, ask, held);
        same = agree(ask, twin, p->n, d == axis) && agree(held, twin, p->n, false) &&
               agree(p->v[d], twin, p->n, d == axis);
    }
    memory_free(ask);
    memory_free(held);
    return same;
}

/* Finds the mirror image of each particle of the run in the plane normal to `axis` at the coordinate `at` [m].
 * twin[particles]: receives the index of the mirror image of each particle. Returns false if a particle has no image.
 * Also returns false if a particle is on the plane and thus its own image, because an input file of one half would have
 * to cut it. */
static bool mirror_twins_find(const struct run *run, int axis, real at, int32_t *twin)
{
    const struct particles *p = &run->part;
    for (int64_t i = 0; i < p->n; i++) {
        real X[DIM_MAX];
        particle_reference_position(p, i, X);
        X[axis] = 2 * at - X[axis];
        const int64_t j = particle_at(run, X);
        if (j < 0 || j == i) return false;
        twin[i] = (int32_t)j;
    }
    return true;
}

/* Returns true if rigid body b of `scene` is the mirror image of rigid body a in the plane normal to `axis` at `at`
 * [m]: mirrored motion, and distances of a from a sample of the particles p that equal those of b from the mirror
 * images of these positions. */
static bool rigid_twins(const struct particles *p, const struct scene *scene, int axis, real at,
                        const struct scene_body *a, const struct scene_body *b)
{
    enum { PLACES = 1000 };
    const int dim = p->dim;
    const real near = NEAR_ENOUGH * scene->spacing;
    bool same = a->ramp == b->ramp;
    for (int d = 0; d < dim; d++)
        same &= fabs(a->velocity[d] - (d == axis ? -1 : 1) * b->velocity[d]) <= NEAR_ENOUGH * fabs(a->velocity[d]);
    for (int64_t i = 0; i < p->n && same; i += 1 + p->n / PLACES) {
        real X[DIM_MAX], image[DIM_MAX], normal[DIM_MAX];
        particle_reference_position(p, i, X);
        memcpy(image, X, sizeof image);
        image[axis] = 2 * at - X[axis];
        const real far = region_signed_distance(&a->shape, X, dim, normal);
        same = fabs(far - region_signed_distance(&b->shape, image, dim, normal)) <= near;
    }
    return same;
}

/* Returns true if every rigid body of `scene` has a mirror image among the rigid bodies in the plane normal to `axis`
 * at the coordinate `at` [m], and no rigid body moves freely. part: particles, at which distances of the bodies are
 * compared. */
static bool rigid_bodies_agree(const struct scene *scene, const struct particles *part, int axis, real at)
{
    const struct scene_body *rigid = scene->body + scene->bodies;
    for (int a = 0; a < scene->rigids; a++) {
        bool found = false;
        for (int b = 0; b < scene->rigids && !found; b++)
            found = rigid_twins(part, scene, axis, at, &rigid[a], &rigid[b]);
        if (!found || rigid[a].mass > 0) return false;
    }
    return true;
}

/* Returns true if the numbers a and b are equal or both are NAN, which denotes a number that is not given. */
static bool same_number(real a, real b) { return a == b || (isnan(a) && isnan(b)); }

/* Returns true if the settings for growing cracks in scene s (the input file), with the particles `part`, are symmetric
 * about the plane normal to `axis` at the coordinate `at` [m]: each crack has a mirror image with equal speed and
 * toughness and mirrored start. */
static bool growths_agree(const struct scene *s, const struct particles *part, int axis, real at)
{
    for (int k = 0; k < s->growths; k++) {
        const struct growth_rule *a = &s->growth[k];
        bool found = false;
        for (int m = 0; m < s->growths && !found; m++) {
            const struct growth_rule *b = &s->growth[m];
            found = same_number(a->speed, b->speed) && same_number(a->toughness, b->toughness);
            found &= a->start == b->start;
            for (int d = 0; d < part->dim; d++) {
                const real place = d == axis ? 2 * at - b->at[d] : b->at[d];
                const real direction = d == axis ? -b->direction[d] : b->direction[d];
                found &= fabs(a->at[d] - place) <= NEAR_ENOUGH * s->spacing;
                found &= fabs(a->direction[d] - direction) <= NEAR_ENOUGH;
            }
        }
        if (!found) return false;
    }
    return true;
}

/* Returns true if the plane normal to `axis` at the coordinate `at` [m] crosses no ring (circle around a crack tip)
 * over which a probe of the run integrates stress-intensity factors. */
static bool rings_clear(const struct run *run, int axis, real at)
{
    const struct observed_run seen = observed_run_make_read_only_view(run);
    for (int k = 0; k < run->probing->probes.n; k++) {
        real place[2], radius;
        if (!probes_locate_sif_contour(&run->probing->probes, k, &seen, place, &radius)) continue;
        if (fabs(place[axis] - at) < radius) return false;
    }
    return true;
}

bool run_is_symmetric_about_mid_plane(const struct run *run, int normal_axis, real *plane_position)
{
    const struct particles *p = &run->part;
    real low, high;
    for (int b = 0; b < run->loads.n; b++)
        if (run->loads.load[b].boundary->kind == BOUNDARY_MIRROR && run->loads.load[b].boundary->axis == normal_axis)
            return false;
    particles_coordinate_range(p, p->n, normal_axis, &low, &high);
    *plane_position = 0.5 * (low + high);
    if (high - low < run->scene->spacing || !rings_clear(run, normal_axis, *plane_position)) return false;
    if (!rigid_bodies_agree(run->scene, &run->part, normal_axis, *plane_position) ||
        !growths_agree(run->scene, &run->part, normal_axis, *plane_position))
        return false;
    int32_t *twin = NEW("check.twin", p->n, int32_t);
    const bool same = mirror_twins_find(run, normal_axis, *plane_position, twin) && matter_agrees(&run->part, twin) &&
                      voids_agree(run->source.voids, twin, p->n) &&
                      loads_agree(&run->part, &run->loads, normal_axis, twin);
    memory_free(twin);
    return same;
}
