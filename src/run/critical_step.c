/* Computes the critical time step of bodies of bonds from the largest frequency of the body or of a block of its
 * lattice. */
#include "run/critical_step.h"

#include <math.h>
#include <string.h>

#include "base/eigenvalue.h"
#include "base/memory.h"
#include "loads/mirrors.h"

#define STRAIN 1e-7 /* strain of the trial motion: its square is negligible, round-off relative to it about 1e-9 */
/* Factor on the critical time step 2/omega_max found by iteration [1], empirical. The iteration ends a few parts in ten
 * thousand below omega_max^2, and omega_max^2 of a block of the lattice is 1 to 2 % below that of larger blocks. */
#define MARGIN 0.98

struct bond_stiffness_operator bond_stiffness_operator_make(struct bonds *b, struct particles *p, bond_force_fn *force,
                                                            const struct loads *loads, real spacing)
{
    struct bond_stiffness_operator body = {b, p, force, loads, spacing, NEW("critical.root", p->n, real)};
    for (int64_t i = 0; i < p->n; i++) body.root[i] = sqrt(p->mass[i]);
    return body;
}

void bond_stiffness_operator_free(struct bond_stiffness_operator *bond_operator) { memory_free(bond_operator->root); }

/* Returns the largest absolute component of the displacement u/sqrt(m) over all particles of `body` [m]. u: [dim][n]
 * displacements times the square root of the mass. */
static real largest_motion(const struct bond_stiffness_operator *body, const real *u)
{
    const struct particles *p = body->p;
    real most = 0;
    for (int a = 0; a < p->dim; a++)
#pragma omp parallel for schedule(static) reduction(max : most)
        for (int64_t i = 0; i < p->n; i++) most = real_max(most, fabs(u[a * p->n + i]) / body->root[i]);
    return most;
}

void bond_stiffness_operator_apply(void *context, const real *displacement, real *result)
{
    const struct bond_stiffness_operator *body = context;
    struct particles *p = body->p;
    const real most = largest_motion(body, displacement), scale = most > 0 ? STRAIN * body->spacing / most : 0;
    for (int a = 0; a < p->dim; a++)
#pragma omp parallel for schedule(static)
        for (int64_t i = 0; i < p->n; i++) p->x[a][i] = p->X[a][i] + scale * displacement[a * p->n + i] / body->root[i];
    if (body->loads) loads_update_mirror_images_of_particles(body->loads, p);
    bond_forces(body->force, body->b, p, &bond_limit_never, NULL);
    for (int a = 0; a < p->dim; a++)
#pragma omp parallel for schedule(static)
        for (int64_t i = 0; i < p->n; i++) result[a * p->n + i] = scale > 0 ? -p->f[a][i] / (scale * body->root[i]) : 0;
}

real bonds_critical_time_step_by_iteration(struct bonds *b, struct particles *p, bond_force_fn *force,
                                           const struct loads *loads, real spacing)
{
    struct bond_stiffness_operator body = bond_stiffness_operator_make(b, p, force, loads, spacing);
    real *x[DIM_MAX];
    for (int a = 0; a < p->dim; a++) {
        x[a] = NEW("critical.x", p->n_all, real);
        array_copy(x[a], p->x[a], p->n_all, sizeof *x[a]);
    }
    const real omega2 = largest_eigenvalue(p->dim * p->n, bond_stiffness_operator_apply, &body);
    for (int a = 0; a < p->dim; a++) {
        array_copy(p->x[a], x[a], p->n_all, sizeof *x[a]);
        memory_free(x[a]);
    }
    bond_stiffness_operator_free(&body);
    return omega2 > 0 ? MARGIN * 2 / sqrt(omega2) : INFINITY;
}

/* Limit of the number of bonds of the block of lattice whose frequency is computed, because of its cost. A larger block
 * is reduced to the size of the body. */
#define BLOCK_BONDS_MOST 1e7

/* Computes the size of a block of the lattice whose largest frequency is used in place of that of the whole body:
 * edge[dim], the numbers of particles along the axes. The block is large enough for particles with full neighbourhoods
 * (all their neighbours) and, if it then has fewer than BLOCK_BONDS_MOST bonds, also for long waves. f: neighbourhood
 * of the bonds; longest[dim]: extent of the body along each axis [m]. Returns the number of particles of the block. */
static int64_t edges_of(const struct family *f, const real *longest, int64_t edge[DIM_MAX])
{
    static const int times[DIM_MAX + 1] = {0, 8, 2, 1};
    const int dim = space_dim(f->space);
    int64_t n = 1;
    for (int d = 0; d < dim; d++) n *= edge[d] = (2 * (int64_t)ceil(f->cutoff / f->spacing) + 4) * times[dim];
    if ((real)n * f->full / f->cell_volume < BLOCK_BONDS_MOST) return n;
    n = 1;
    for (int d = 0; d < dim; d++) {
        if (longest[d] / f->spacing + 2 < (real)edge[d]) edge[d] = (int64_t)(longest[d] / f->spacing) + 2;
        n *= edge[d];
    }
    return n;
}

real lattice_critical_time_step(const struct bond_source *source, bond_force_fn *force, real density,
                                const real *largest_extent, real *lower_bound)
{
    const struct family *f = &source->family;
    const int dim = space_dim(f->space);
    int64_t edge[DIM_MAX];
    const int64_t n = edges_of(f, largest_extent, edge);
    struct bond_source s = *source;
    struct particles p;
    struct cells cells;
    struct bonds b;
    particles_make(&p, dim, n, 0);
    for (int64_t i = 0, k; i < n; i++) {
        k = i;
        for (int d = 0; d < dim; k /= edge[d++]) p.x[d][i] = p.X[d][i] = (real)(k % edge[d]) * f->spacing;
        p.volume[i] = p.volume0[i] = f->cell_volume;
        p.mass[i] = density * f->cell_volume;
        p.kind[i] = KIND_PD;
    }
    particles_rebuild_lists_by_kind(&p);
    cells_make_for_neighbour_search(&cells, &p, f->cutoff * (1 + 1e-9));
    s.family.surface = SURFACE_NONE;
    s.cells = &cells, s.cracks = 0, s.voids = NULL, s.image = NULL;
    s.room = 0, s.neighbour_volume = NULL, s.surface = NULL;
    bonds_make(&b, NULL, &p, &s);
    if (lower_bound) *lower_bound = bonds_critical_time_step_of_existing_bonds(&b, &p);
    real step = bonds_critical_time_step_by_iteration(&b, &p, force, NULL, f->spacing);
    bonds_free(&b);
    cells_free(&cells);
    particles_free(&p);
    return step;
}
