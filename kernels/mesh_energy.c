/* floor 2: energies of the mesh, for the ledger. */
#include "mesh_cut.h"
#include "mesh_law.h"
#include "team.h"

static real kinetic_term(const void *context, int64_t I)
{
    const struct grid *g = context;
    real speed2 = 0;
    for (int d = 0; d < g->dim; d++) speed2 += square(g->velocity[d][I]);
    return 0.5 * g->mass[I] * speed2;
}

real mesh_kinetic(const struct mesh *mesh)
{
    return mesh->points > 0 ? team_sum(mesh->grid.n, kinetic_term, &mesh->grid) : 0;
}

static real kick_term(const void *context, int64_t I)
{
    const struct mesh *mesh = context;
    real force2 = 0;
    for (int d = 0; d < mesh->grid.dim; d++) force2 += square(mesh->grid.force[d][I]);
    return 0.25 * force2 * mesh->inverse_mass[I];
}

real mesh_kick(const struct mesh *mesh, real dt)
{
    return mesh->points > 0 ? dt * dt * team_sum(mesh->grid.n, kick_term, mesh) : 0;
}

/* 1/2 u K u of a cell, u in axes that turn with it. */
static real cell_energy(const struct mesh *mesh, int64_t I, const real *K, bool finite)
{
    const int dim = mesh->grid.dim, n = (1 << dim) * dim;
    real u[CELL_UNKNOWNS_MAX], energy = 0;
    mesh_cell_local(mesh, I, u, NULL, NULL, dim, finite && dim > 1);
    for (int b = 0; b < n; b++)
        for (int a = 0; a < n; a++) energy += 0.5 * u[a] * K[b * n + a] * u[b];
    return energy;
}

struct strain_sum { const struct mesh *mesh; const struct elastic *elastic; bool finite; };

static real cut_term(const void *context, int64_t k)
{
    const struct strain_sum *s = context;
    const int n = (1 << s->mesh->grid.dim) * s->mesh->grid.dim;
    return cell_energy(s->mesh, s->mesh->cut[k], s->mesh->stiffness + k * n * n, s->finite);
}

/* Of a run, eight cells at a time; cells behind its end count nothing. */
static ALWAYS_INLINE real run_energy(const struct strain_sum *s, const struct mesh_run *run, const int dim, const bool finite)
{
    const struct mesh *mesh = s->mesh;
    lanes sum = lanes_of(0);
    real all = 0;
    for (int64_t k = 0; k < run->cells; k += LANES) {
        lanes u[CORNERS_MAX][3], f[CORNERS_MAX][3], tension = lanes_of(0), energy;
        mesh_run_load(mesh, run, k, u, dim);
        mesh_cell_force(&s->elastic[run->material], mesh->grid.h, mesh->volume * (1 << dim), u, f, &tension, &energy, dim, finite);
        sum += energy;
    }
    for (int l = 0; l < LANES; l++) all += sum[l];
    return all;
}

#define TERM(D, FINITE)                                                                                              \
    static real run_term_##D##_##FINITE(const void *context, int64_t r)                                              \
    {                                                                                                                \
        const struct strain_sum *s = context;                                                                        \
        return run_energy(s, &s->mesh->run[r], D, FINITE);                                                           \
    }
TERM(1, 0)
TERM(2, 0)
TERM(2, 1)
TERM(3, 0)
TERM(3, 1)

real mesh_strain(const struct mesh *mesh, const struct elastic *m, bool finite)
{
    static real (*const term[DIM_MAX + 1][2])(const void *, int64_t) = {
        {NULL, NULL}, {run_term_1_0, run_term_1_0}, {run_term_2_0, run_term_2_1}, {run_term_3_0, run_term_3_1}};
    struct strain_sum s = {mesh, m, finite};
    if (mesh->points == 0) return 0;
    return team_sum(mesh->cuts, cut_term, &s) + team_sum(mesh->runs, term[mesh->grid.dim][finite], &s);
}
