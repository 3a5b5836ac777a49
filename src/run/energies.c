/* Computes kinetic energy, momentum, strain energy and plastic work of particles. */
#include "run/energies.h"

#include <math.h>

#include "base/memory.h"
#include "base/team.h"
#include "kernels/mpm/stress.h"

/* ---- sums over particles ----------------------------------------------------------------------------------------- */

/* Masses [kg] and velocities v[dim] [m/s] of particles or nodes. flag: flags of the particles, of which those with
 * FLAG_MESHED (moved by the nodes of a mesh) are skipped; NULL: no entry is skipped. */
struct movers {
    int dim;
    const real *mass;
    real *const *v;
    const uint8_t *flag;
};

/* Number of particles in a piece of the sums. Pieces whose particles are all moved by the nodes of a mesh are skipped
 * as a whole. */
enum { MOTION_PIECE = 64 };

/* Returns true if particles first .. end - 1 are all moved by the nodes of a mesh (FLAG_MESHED). flag: flags of all
 * particles. */
static bool all_meshed(const uint8_t *flag, int64_t first, int64_t end)
{
    uint8_t all = FLAG_MESHED;
    for (int64_t i = first; i < end; i++) all &= flag[i];
    return all != 0;
}

/* Selection of the sums that are computed: SUM_ENERGY: the kinetic energy; SUM_MOMENTUM: the momentum as well;
 * SUM_SIZES: also the sum of |m v|, which takes square roots. */
enum motion_sums { SUM_ENERGY, SUM_MOMENTUM, SUM_SIZES };

/* Sums over particles or nodes: kinetic energy [J], momentum of each axis, and sum of |m v| [kg m/s]. */
struct motion {
    real kinetic, momentum[DIM_MAX], size;
};

/* Adds sums over the particles or nodes first .. end - 1 of m to *to: the kinetic energy and, depending on `wanted`,
 * the momentum and the sum of |m v|. meshed: true to skip particles with FLAG_MESHED, which the nodes of a mesh move.
 * dim, meshed and wanted must be known at compile time. */
static ALWAYS_INLINE void add_motion(const struct movers *m, int64_t first, int64_t end, struct motion *to,
                                     const int dim, const bool meshed, const enum motion_sums wanted)
{
    const real *mass = m->mass, *v0 = m->v[0], *v1 = m->v[dim > 1], *v2 = m->v[dim > 2 ? 2 : 0];
    const uint8_t *flag = m->flag;
    real kinetic = 0, p0 = 0, p1 = 0, p2 = 0, size = 0;
#pragma omp simd reduction(+ : kinetic, p0, p1, p2, size)
    for (int64_t i = first; i < end; i++) {
        const real own = meshed && flag[i] & FLAG_MESHED ? 0 : mass[i];
        const real speed2 = square(v0[i]) + (dim > 1 ? square(v1[i]) : 0) + (dim > 2 ? square(v2[i]) : 0);
        kinetic += own * speed2;
        if (wanted == SUM_ENERGY) continue;
        p0 += own * v0[i];
        if (dim > 1) p1 += own * v1[i];
        if (dim > 2) p2 += own * v2[i];
        if (wanted == SUM_SIZES) size += own * sqrt(speed2);
    }
    to->kinetic += 0.5 * kinetic, to->size += size;
    to->momentum[0] += p0, to->momentum[1] += p1, to->momentum[2] += p2;
}

/* Adds sums over the particles or nodes first .. end - 1 of m to *to, by add_motion with the dimension of m as a
 * constant. wanted: selects the sums. Adds nothing if all of them are particles that the nodes of a mesh move. */
static ALWAYS_INLINE void motion_piece(const struct movers *m, int64_t first, int64_t end, struct motion *to,
                                       const enum motion_sums wanted)
{
    const bool meshed = m->flag != NULL;
    if (meshed && all_meshed(m->flag, first, end)) return;
    switch (m->dim) {
    case 1:
        meshed ? add_motion(m, first, end, to, 1, true, wanted) : add_motion(m, first, end, to, 1, false, wanted);
        break;
    case 2:
        meshed ? add_motion(m, first, end, to, 2, true, wanted) : add_motion(m, first, end, to, 2, false, wanted);
        break;
    default:
        meshed ? add_motion(m, first, end, to, 3, true, wanted) : add_motion(m, first, end, to, 3, false, wanted);
        break;
    }
}

/* Returns true if all nodes first .. end - 1 have no mass, like most nodes of the finest cells in the region of coarse
 * cells. mass: of all nodes. */
static bool none_has_mass(const real *mass, int64_t first, int64_t end)
{
    real most = 0;
#pragma omp simd reduction(max : most)
    for (int64_t I = first; I < end; I++) most = mass[I] > most ? mass[I] : most;
    return most == 0;
}

/* Returns sums over the particles or nodes first .. end - 1 of m: kinetic energy, momentum and sum of |m v| as far as
 * `wanted` selects them; the other members are 0. */
static ALWAYS_INLINE struct motion motion_of(const struct movers *m, int64_t first, int64_t end,
                                             const enum motion_sums wanted)
{
    struct motion sum = {0};
    if (m->flag ? all_meshed(m->flag, first, end) : none_has_mass(m->mass, first, end)) return sum;
    for (int64_t to; first < end; first = to) {
        to = first + MOTION_PIECE < end ? first + MOTION_PIECE : end;
        motion_piece(m, first, to, &sum, wanted);
    }
    return sum;
}

/* Adds the kinetic energy of the particles or nodes first .. end - 1 [J] to sum[0]. context: their masses and
 * velocities (struct movers). Called by reproducible_sums for each block. */
static void kinetic_block(const void *context, int64_t first, int64_t end, real *sum)
{
    sum[0] += motion_of(context, first, end, SUM_ENERGY).kinetic;
}

static struct movers movers_of(const struct particles *p) { return (struct movers){p->dim, p->mass, p->v, p->flag}; }

real particles_kinetic_energy(const struct particles *p)
{
    const struct movers m = movers_of(p);
    real kinetic;
    reproducible_sums(p->n, 1, kinetic_block, &m, &kinetic);
    return kinetic;
}

/* Argument of the sums over the velocity update of a step, of which they compute the energy m dv^2/4. before: [dim]
 * velocities before the update [m/s]; NULL: the change of velocity dv is computed from the forces; dt: duration of the
 * update [s]. */
struct kick {
    const struct particles *p;
    real *const *before;
    real dt;
};

/* Returns `sum` plus the sum of m dv^2/4 over particles first .. end - 1 of k->p [J], where dv is the change of
 * velocity in the step (from k->before or from the forces). This is the difference between two energies: the mean of
 * the kinetic energies before and after the step, and m v_before . v_after/2, the kinetic part of the energy that
 * leap-frog conserves. Particles with prescribed motion do not contribute, since their work is computed with their
 * motion. */
static real kick_piece(const struct kick *k, int64_t first, int64_t end, real sum)
{
    const struct particles *p = k->p;
    for (int64_t i = first; i < end; i++) {
        if (p->flag[i] & FLAG_DRIVEN ||
            (k->before ? p->flag[i] & FLAG_MESHED : particle_is_moved_by_grid_or_mesh_nodes(p, i)))
            continue;
        real change2 = 0;
        for (int d = 0; d < p->dim; d++)
            change2 += square(k->before ? p->v[d][i] - k->before[d][i] : k->dt * p->f[d][i] / p->mass[i]);
        sum += 0.25 * p->mass[i] * change2;
    }
    return sum;
}

/* Adds the sum of m dv^2/4 over particles first .. end - 1 to sum[0] [J], where dv is the change of velocity in the
 * step. Particles that the nodes of a mesh move do not contribute. context: particles, and velocities before the step
 * or the duration of the update (struct kick). Called by reproducible_sums for each block. */
static void kick_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct kick *k = context;
    if (all_meshed(k->p->flag, first, end)) return;
    for (int64_t to; first < end; first = to) {
        to = first + MOTION_PIECE < end ? first + MOTION_PIECE : end;
        if (!all_meshed(k->p->flag, first, to)) sum[0] = kick_piece(k, first, to, sum[0]);
    }
}

real particles_mean_minus_leapfrog_kinetic_energy(const struct particles *p, real *const *old_velocity, real dt)
{
    real sum;
    reproducible_sums(p->n, 1, kick_block, &(struct kick){p, old_velocity, dt}, &sum);
    return sum;
}

/* Adds the momentum of the particles or nodes first .. end - 1 to sum[0 .. dim - 1] [kg m/s]. context: their masses and
 * velocities (struct movers). Called by reproducible_sums for each block. */
static void momentum_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct movers *m = context;
    const struct motion motion = motion_of(m, first, end, SUM_MOMENTUM);
    for (int d = 0; d < m->dim; d++) sum[d] += motion.momentum[d];
}

/* Adds the momentum of the particles or nodes first .. end - 1 to sum[0 .. dim - 1], one per axis, and the sum of |m v|
 * to sum[dim] [kg m/s]. context: their masses and velocities (struct movers). Called by reproducible_sums for each
 * block. */
static void momentum_and_size_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct movers *m = context;
    const struct motion motion = motion_of(m, first, end, SUM_SIZES);
    for (int d = 0; d < m->dim; d++) sum[d] += motion.momentum[d];
    sum[m->dim] += motion.size;
}

/* ---- strain energy and plastic work of material points ----------------------------------------------------------- */

/* Parameters of sums over the material points in `list`: particles, materials, and the shares of stress that bonds
 * carry (partial). */
struct strain_sum {
    const struct particles *p;
    const struct material *m;
    const struct partial_stress *partial;
    const int32_t *list;
    real (*compliance)[SYM_MAX * SYM_MAX]; /* [materials] C^-1 in symmetric components */
};

real point_energy_fraction_not_carried_by_bonds(const struct partial_stress *partial, int dim, int64_t i)
{
    if (!partial || !partial->index || partial->index[i] < 0) return 1;
    const int n = symmetric_tensor_component_count(dim);
    const real *M = partial->matrix + (int64_t)partial->index[i] * n * n;
    real trace = 0;
    for (int a = 0; a < n; a++) trace += M[a * n + a];
    return 1 - trace / n;
}

/* Returns the additional strain energy of point i of s in plane strain after plastic flow [J]: for sigma_zz = nu
 * (sigma_xx + sigma_yy) + delta the energy density has the additional term delta^2/(2 E). Returns 0 if nothing has
 * flowed. */
static real out_of_plane_energy(const struct strain_sum *s, int64_t i)
{
    if (!s->p->out_of_plane) return 0;
    return point_energy_fraction_not_carried_by_bonds(s->partial, s->p->dim, i) * square(s->p->out_of_plane[i]) /
           (2 * s->m[s->p->material[i]].young) * s->p->volume[i];
}

/* Returns twice the strain energy density of point i of s [J/m^3]: the product of the stress that it transmits to the
 * grid and the elastic strain C^-1 stress. The material is isotropic, so that normal stresses cause only normal
 * strains. dim: number of dimensions, known at compile time. */
static ALWAYS_INLINE real strain_density(const struct strain_sum *s, int64_t i, const int dim)
{
    const int n = dim * (dim + 1) / 2;
    const real *compliance = s->compliance[s->p->material[i]];
    real stress[SYM_MAX], given[SYM_MAX], sum = 0;
    for (int a = 0; a < n; a++) stress[a] = s->p->stress[a][i];
    point_compute_stress_transmitted_to_grid(s->p, s->partial, i, given, dim);
    for (int a = 0; a < dim; a++) {
        real strain = 0;
        for (int b = 0; b < dim; b++) strain += compliance[a * n + b] * stress[b];
        sum += given[a] * strain;
    }
    for (int a = dim; a < n; a++) sum += 2 * given[a] * (compliance[a * n + a] * stress[a]); /* twice in the tensor */
    return sum;
}

/* Adds the strain energies of the entries first .. end - 1 of s->list to *sum [J], as far as they are material points.
 * dim: a compile-time constant. */
static ALWAYS_INLINE void strain_block_in(const struct strain_sum *s, int64_t first, int64_t end, real *sum,
                                          const int dim)
{
    const struct particles *p = s->p;
    for (int64_t k = first; k < end; k++) {
        const int64_t i = s->list[k];
        if (p->kind[i] == KIND_MPM) *sum += 0.5 * strain_density(s, i, dim) * p->volume[i] + out_of_plane_energy(s, i);
    }
}

/* Adds the strain energies of the entries first .. end - 1 of a list of particles to sum[0] [J], as far as they are
 * material points. context: list and particles (struct strain_sum). Called by reproducible_sums for each block. */
static void strain_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct strain_sum *s = context;
    if (s->p->dim == 1) strain_block_in(s, first, end, sum, 1);
    if (s->p->dim == 2) strain_block_in(s, first, end, sum, 2);
    if (s->p->dim == 3) strain_block_in(s, first, end, sum, 3);
}

real points_strain_energy_of_listed_points(const struct particles *p, const struct material *m,
                                           const struct partial_stress *partial, const int32_t *point_list,
                                           int64_t point_count)
{
    int materials = 0;
    for (int64_t k = 0; k < point_count; k++)
        if (p->material[point_list[k]] >= materials) materials = p->material[point_list[k]] + 1;
    struct strain_sum s = {.p = p, .m = m, .partial = partial, .list = point_list};
    s.compliance = memory_new("diagnostics.compliance", materials, sizeof *s.compliance);
    for (int k = 0; k < materials; k++) material_compliance_matrix(&m[k], p->dim, s.compliance[k]);
    real sum;
    reproducible_sums(point_count, 1, strain_block, &s, &sum);
    memory_free(s.compliance);
    return sum;
}

real points_strain_energy(const struct particles *p, const struct material *m, const struct partial_stress *partial)
{
    return points_strain_energy_of_listed_points(p, m, partial, p->list_free, p->n_free);
}

/* Returns the plastic work [J] of the material point in entry k of a list, without the share that its bonds carry.
 * context: list and particles (struct strain_sum). */
static real plastic_term(const void *context, int64_t k)
{
    const struct strain_sum *s = context;
    const struct particles *p = s->p;
    const int64_t i = s->list[k];
    if (p->plastic_work[i] == 0) return 0;
    return point_energy_fraction_not_carried_by_bonds(s->partial, s->p->dim, i) * p->plastic_work[i] * p->volume0[i];
}

real points_plastic_work(const struct particles *p, const struct material *m, const struct partial_stress *partial)
{
    if (!p->plastic_strain) return 0;
    return reproducible_sum(p->n_of[KIND_MPM], plastic_term,
                            &(struct strain_sum){.p = p, .m = m, .partial = partial, .list = p->list[KIND_MPM]});
}

void particles_linear_momentum(const struct particles *p, const struct grid *const *nodes, int grid_count,
                               real *momentum, real *momentum_scale)
{
    void (*const block)(const void *, int64_t, int64_t, real *) =
        momentum_scale ? momentum_and_size_block : momentum_block;
    const struct movers m = movers_of(p);
    const int sums = p->dim + (momentum_scale != NULL);
    real sum[DIM_MAX + 1], more[DIM_MAX + 1];
    reproducible_sums(p->n, sums, block, &m, sum);
    for (int g = 0; g < grid_count && nodes[g]->n > 0; g++) {
        const struct movers n = {nodes[g]->dim, nodes[g]->mass, nodes[g]->velocity, NULL};
        reproducible_sums(nodes[g]->n, sums, block, &n, more);
        for (int k = 0; k < sums; k++) sum[k] += more[k];
    }
    for (int d = 0; d < p->dim; d++) momentum[d] = sum[d];
    if (momentum_scale) *momentum_scale = sum[p->dim];
}

/* Computes the stresses p->stress of peridynamic particles from the bonds b. In state-based models the weighted volumes
 * and dilatations are recomputed first, at the current positions: a step moves particles after its forces, and the
 * stress in a rotating body would otherwise contain the rotation of a step. s: source of the bonds; kernels: those of
 * the model. */
void bonds_compute_particle_stress(struct bonds *b, struct particles *p, const struct bond_source *s,
                                   const struct kernels *kernels)
{
    families_compute_pressure_rotation_and_stiffness(b, p, s);
    kernels->bond_stress(b, p);
}
