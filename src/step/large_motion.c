/* Parts of one body that pass through each other, and pressures on surfaces that have turned (large_motion.h). */
#include "step/large_motion.h"

#include <math.h>
#include <stdio.h>

#include "base/memory.h"
#include "data/cells.h"

/* Present distance of two particles below which they count as having moved into each other [spacings]. */
#define INSIDE 0.5
/* Reference distance up to which two particles do not count as parts that pass through each other, since compression
 * brings them near each other [spacings]. */
#define APART 3
enum { PARTS_OF_DURATION = 25 }; /* number of comparisons per run */
/* Rotation of a surface above which a pressure along the undeformed normals is reported [degrees]: it is wrong by sin
 * 10 degrees = 0.17 of its value across the surface. */
#define TURNED_MOST 10
#define DEGREES (180 / 3.14159265358979323846) /* degrees in a radian */

/* ---- parts that pass through each other -------------------------------------------------------------------------- */

/* Returns the largest magnitude over all particles of displacement minus mean displacement [m]. p: all particles. */
static real largest_relative_displacement(const struct particles *p)
{
    real mean[DIM_MAX] = {0}, most2 = 0;
    for (int d = 0; d < p->dim; d++) {
        for (int64_t i = 0; i < p->n; i++) mean[d] += p->x[d][i] - p->X[d][i];
        mean[d] /= (real)p->n;
    }
    for (int64_t i = 0; i < p->n; i++) {
        real sum = 0;
        for (int d = 0; d < p->dim; d++) sum += square(p->x[d][i] - p->X[d][i] - mean[d]);
        most2 = real_max(most2, sum);
    }
    return sqrt(most2);
}

/* Returns true if particle i is a material point on the background grid. p: all particles. */
static bool on_grid(const struct particles *p, int64_t i)
{
    return p->kind[i] == KIND_MPM && !(p->flag[i] & FLAG_MESHED);
}

/* Returns the number of particles of p that have moved into another particle of the same body: their present distance
 * is below `reach` [m] and their reference distance above `horizon` [m]. Pairs of points on the background grid do not
 * count: they move with one velocity field, and come near each other where metal is compressed. s: scene, with the
 * spacing; *first: receives the index of the first such particle. */
static int64_t count_passing_particles(const struct particles *p, const struct scene *s, real reach, real horizon,
                                       int64_t *first)
{
    struct particles now = {.n = p->n, .n_all = p->n, .dim = p->dim};
    struct neighbour_list near = {0};
    struct cells cells;
    int64_t count = 0;
    for (int d = 0; d < p->dim; d++) now.X[d] = p->x[d];
    cells_make_for_neighbour_search(&cells, &now, s->spacing);
    for (int64_t i = 0; i < p->n; i++) {
        bool passes = false;
        particles_list_neighbours_within_radius(&near, &cells, &now, i, reach, false);
        for (int k = 0; k < near.n && !passes; k++) {
            const int32_t j = near.at[k];
            real distance2 = 0;
            for (int d = 0; d < p->dim; d++) distance2 += square(p->X[d][j] - p->X[d][i]);
            passes = s->body[p->body[j]].joined == s->body[p->body[i]].joined && distance2 > square(horizon) &&
                     !(on_grid(p, i) && on_grid(p, j));
        }
        if (passes && count++ == 0) *first = i;
    }
    memory_free(near.at);
    cells_free(&cells);
    return count;
}

void large_motion_warn_of_self_penetration(struct large_motion *m, const struct particles *p, const struct scene *s,
                                           real horizon, real t, struct warnings *warning_list)
{
    const real reach = INSIDE * s->spacing, held = real_max(horizon, APART * s->spacing);
    const int part = scene_duration_interval_index_at_time(s, t, PARTS_OF_DURATION);
    int64_t first = 0;
    char text[480];
    if (m->passed || part == m->checked || !scene_is_dynamic(s) || p->n == 0 || p->n < p->n_body) return;
    if (s->contact_between == CONTACT_ALL || scene_silences_warning(s, ACCEPT_CONTACT)) return;
    m->checked = part;
    if (p->n_free == p->n) return; /* pairs of points on the grid do not count */
    if (2 * largest_relative_displacement(p) < held - reach) return;
    const int64_t count = count_passing_particles(p, s, reach, held, &first);
    if (count == 0) return;
    snprintf(text, sizeof text,
             "parts of body %.60s pass through each other: at t = %.3g s %lld particles are nearer than half a spacing "
             "to a particle to which no bond joins them, the first at (%s) m, because contact is %s; set "
             "contact.between: all; if this is intended, add accept: [contact]",
             s->body[p->body[first]].name, t, (long long)count, particle_position_text(p, first, 4).text,
             s->contact_between == CONTACT_NONE ? "none" : "between bodies only");
    warnings_add_and_print(warning_list, text);
    m->passed = true;
}

/* ---- pressures on surfaces that have turned ---------------------------------------------------------------------- */

/* Returns the rotation angle of the particles of load l about their centre [rad], the largest one among the coordinate
 * planes. In a plane (x_a, x_b) it is the angle of the rotation that fits the present positions to the reference
 * positions best. p: all particles. */
static real rotation_of_loaded_particles(const struct load *l, const struct particles *p)
{
    real X0[DIM_MAX] = {0}, x0[DIM_MAX] = {0}, most = 0;
    for (int d = 0; d < p->dim; d++)
        for (int64_t k = 0; k < l->n; k++)
            X0[d] += p->X[d][l->particle[k]] / (real)l->n, x0[d] += p->x[d][l->particle[k]] / (real)l->n;
    for (int a = 0; a < p->dim; a++)
        for (int b = a + 1; b < p->dim; b++) {
            real across = 0, along = 0;
            for (int64_t k = 0; k < l->n; k++) {
                const int32_t i = l->particle[k];
                const real R[] = {p->X[a][i] - X0[a], p->X[b][i] - X0[b]},
                           r[] = {p->x[a][i] - x0[a], p->x[b][i] - x0[b]};
                across += R[0] * r[1] - R[1] * r[0], along += R[0] * r[0] + R[1] * r[1];
            }
            if (across != 0) most = real_max(most, fabs(atan2(across, along)));
        }
    return most;
}

void large_motion_warn_of_non_follower_pressure(struct large_motion *m, const struct particles *p,
                                                const struct loads *l, real t, struct warnings *warning_list)
{
    char text[400];
    for (int k = 0; k < l->n && !m->turned; k++) {
        const struct boundary *b = l->load[k].boundary;
        if (b->kind != BOUNDARY_PRESSURE || b->follow || l->load[k].n < 2) continue;
        const real degrees = DEGREES * rotation_of_loaded_particles(&l->load[k], p);
        if (!(degrees > TURNED_MOST)) continue;
        snprintf(text, sizeof text,
                 "boundary %.60s: its surface has turned by %.0f degrees at t = %.3g s, but the pressure acts along "
                 "the normals of the undeformed body, so its direction is wrong by this angle; set follow: true",
                 b->name, degrees, t);
        warnings_add_and_print(warning_list, text);
        m->turned = true;
    }
}
