/* Computes the angular momentum of all bodies about their common centre of mass, which is conserved if no external
 * force acts. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "probes/diagnostics.h"

/* Moments of a body: mass [kg], first moments of mass [kg m], momentum [kg m/s], angular momentum about the origin
 * [kg m^2/s], sums of m x^2 [kg m^2] and m v^2 [J]. */
struct turning {
    real mass, moment[DIM_MAX], momentum[DIM_MAX], spin[DIM_MAX], inertia, twice_kinetic;
};

/* Least value by which errors of the angular momentum are divided, as a fraction of the largest angular momentum that
 * is possible with the kinetic energy and the moment of inertia of the bodies [1]. */
#define LEAST_TURN 0.01

/* Adds one particle or node to the moments *to of its body: mass, first moments, momentum, angular momentum about the
 * origin, m x^2 and m v^2. mass: m [kg]; x[DIM_MAX]: position [m]; v[DIM_MAX]: velocity [m/s]. */
static void turning_add(struct turning *to, real mass, const real *x, const real *v)
{
    to->mass += mass, to->inertia += mass * dot(x, x, DIM_MAX), to->twice_kinetic += mass * dot(v, v, DIM_MAX);
    for (int d = 0; d < DIM_MAX; d++) {
        const int a = (d + 1) % 3, b = (d + 2) % 3;
        to->moment[d] += mass * x[d], to->momentum[d] += mass * v[d];
        to->spin[d] += mass * (x[a] * v[b] - x[b] * v[a]);
    }
}

/* Computes spin[DIM_MAX], the angular momentum of a body about `position` in a frame that moves with `velocity` [kg
 * m^2/s], from its moments t: spin - position x momentum - moment x velocity + mass position x velocity.
 * position[DIM_MAX] [m]; velocity[DIM_MAX] [m/s]. */
static void turning_about(const struct turning *t, const real *position, const real *velocity, real *spin)
{
    for (int d = 0; d < DIM_MAX; d++) {
        const int a = (d + 1) % 3, b = (d + 2) % 3;
        spin[d] = t->spin[d] - (position[a] * t->momentum[b] - position[b] * t->momentum[a]) -
                  (t->moment[a] * velocity[b] - t->moment[b] * velocity[a]) +
                  t->mass * (position[a] * velocity[b] - position[b] * velocity[a]);
    }
}

/* Computes spin[DIM_MAX], the angular momentum of all bodies about their common centre of mass [kg m^2/s], from the
 * particles p and the nodes of the mesh (NULL: none), which count in place of the material points that they move. The
 * velocity gradients that points have with the transfer method APIC are left out. bodies: number of bodies. Returns the
 * value by which errors of the angular momentum are divided: the sum of the magnitudes of the angular momenta of the
 * bodies, but at least LEAST_TURN times the largest angular momentum that is possible with their kinetic energy. */
static real diagnostics_spin_of(const struct particles *p, const struct mesh *mesh, int bodies, real *spin)
{
    struct turning *body = NEW("probes.spin", bodies + 1, struct turning), all = {0};
    for (int64_t i = 0; i < p->n; i++) {
        real x[DIM_MAX] = {0}, v[DIM_MAX] = {0};
        if (p->flag[i] & FLAG_MESHED) continue;
        for (int d = 0; d < p->dim; d++) x[d] = p->x[d][i], v[d] = p->v[d][i];
        turning_add(&body[p->body[i]], p->mass[i], x, v);
    }
    for (int64_t I = 0; mesh && I < mesh->grid.n; I++) {
        const struct grid *g = &mesh->grid;
        real x[DIM_MAX] = {0}, v[DIM_MAX] = {0};
        if (!(g->mass[I] > 0)) continue;
        for (int d = 0; d < g->dim; d++) {
            x[d] = grid_node_position(g, d, mesh_original_node_of_doubled_node(mesh, I) / g->stride[d] % g->count[d]) +
                   mesh->displacement[d][I];
            v[d] = g->velocity[d][I];
        }
        turning_add(&body[bodies], g->mass[I], x, v);
    }
    for (int b = 0; b <= bodies; b++) {
        all.mass += body[b].mass, all.inertia += body[b].inertia, all.twice_kinetic += body[b].twice_kinetic;
        for (int d = 0; d < DIM_MAX; d++) {
            all.moment[d] += body[b].moment[d], all.momentum[d] += body[b].momentum[d];
            all.spin[d] += body[b].spin[d];
        }
    }
    real position[DIM_MAX], velocity[DIM_MAX], size = 0, own[DIM_MAX];
    for (int d = 0; d < DIM_MAX; d++) position[d] = all.moment[d] / all.mass, velocity[d] = all.momentum[d] / all.mass;
    turning_about(&all, position, velocity, spin);
    for (int b = 0; b <= bodies; b++) {
        turning_about(&body[b], position, velocity, own);
        size += sqrt(dot(own, own, DIM_MAX));
    }
    memory_free(body);
    const real inertia = all.inertia - all.mass * dot(position, position, DIM_MAX),
               kinetic = all.twice_kinetic - all.mass * dot(velocity, velocity, DIM_MAX);
    return real_max(size, LEAST_TURN * sqrt(real_max(0, inertia) * real_max(0, kinetic)));
}

void diagnostics_update_angular_momentum(struct diagnostics *diagnostics, const struct particles *p,
                                         const struct mesh *mesh, int body_count)
{
    real spin[DIM_MAX], missing2 = 0;
    const real size = diagnostics_spin_of(p, mesh, body_count, spin);
    for (int d = 0; d < DIM_MAX; d++) {
        if (!diagnostics->turns) diagnostics->spin_start[d] = spin[d];
        diagnostics->now.spin[d] = spin[d];
        missing2 += square(spin[d] - diagnostics->spin_start[d]);
    }
    if (!diagnostics->turns) diagnostics->now.spin_error = 0;
    diagnostics->turns = true;
    diagnostics->spin_scale = real_max(diagnostics->spin_scale, size);
    if (diagnostics->spin_scale > 0)
        diagnostics->now.spin_error = real_max(diagnostics->now.spin_error, sqrt(missing2) / diagnostics->spin_scale);
}
