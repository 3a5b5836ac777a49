/* floor 3: power iteration for the largest frequency. */
#include "critical_step.h"

#include <math.h>
#include <string.h>

#include "memory.h"
#include "team.h"

#define STRAIN 1e-7                      /* of the trial motion: its square is not seen, round-off is 1e-9 of it */
#define STATIONARY 1e-3
#define MARGIN 0.98
#define ITERATIONS_MOST 400

struct vectors { const struct particles *p; real *d[DIM_MAX]; real largest; };

/* d . d, d . M^-1 f of a block of particles. */
static void rayleigh_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct vectors *v = context;
    for (int64_t i = first; i < end; i++)
        for (int a = 0; a < v->p->dim; a++) {
            sum[0] += square(v->d[a][i]);
            sum[1] -= v->d[a][i] * v->p->f[a][i] / v->p->mass[i];
        }
}

/* The same start on every machine, with all wave lengths in it. */
static void vectors_make(struct vectors *v, const struct particles *p)
{
    uint64_t seed = 1;
    v->p = p;
    for (int a = 0; a < p->dim; a++) {
        v->d[a] = NEW("critical.d", p->n, real);
        for (int64_t i = 0; i < p->n; i++) {
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            v->d[a][i] = (real)(seed >> 11) * 0x1p-52 - 1;
        }
    }
}

static real largest_of(const struct vectors *v)
{
    real most = 0;
    for (int a = 0; a < v->p->dim; a++)
        for (int64_t i = 0; i < v->p->n; i++) most = real_max(most, fabs(v->d[a][i]));
    return most;
}

/* One iteration; returns the Rayleigh quotient omega^2 of d, and leaves M^-1 K d/omega^2 in its place: without the division
 * it would grow beyond all numbers in a dozen iterations. */
static real iterate(struct vectors *v, struct bonds *b, struct particles *p, bond_force_fn *force,
                    const struct bond_limit *limit, real spacing)
{
    const real scale = STRAIN * spacing / largest_of(v);
    real sum[2];
    for (int a = 0; a < p->dim; a++)
        for (int64_t i = 0; i < p->n; i++) p->x[a][i] = p->X[a][i] + scale * v->d[a][i];
    force(b, p, limit);
    team_sums(p->n, 2, rayleigh_block, v, sum);
    const real omega2 = sum[1] / (sum[0] * scale);
    for (int a = 0; a < p->dim && omega2 > 0; a++)
        for (int64_t i = 0; i < p->n; i++) v->d[a][i] = -p->f[a][i] / (p->mass[i] * scale * omega2);
    return omega2;
}

real critical_step_of(struct bonds *b, struct particles *p, bond_force_fn *force, real spacing)
{
    struct vectors v;
    real never[1] = {INFINITY}, kept = 0, omega2 = 0, before = 0, *x[DIM_MAX];
    const struct bond_limit limit = {never, 0};  /* one entry for all pairs */
    vectors_make(&v, p);
    for (int a = 0; a < p->dim; a++) {
        x[a] = NEW("critical.x", p->n_all, real);
        memcpy(x[a], p->x[a], (size_t)p->n_all * sizeof *x[a]);
    }
    for (int k = 0; k < ITERATIONS_MOST; k++) {
        omega2 = iterate(&v, b, p, force, &limit, spacing);
        if (k >= 20 && k % 10 == 0) {
            if (fabs(omega2 - kept) <= STATIONARY * omega2) break;
            kept = omega2;
        }
        before = real_max(before, omega2);
    }
    for (int a = 0; a < p->dim; a++) {
        memcpy(p->x[a], x[a], (size_t)p->n_all * sizeof *x[a]);
        memory_free(x[a]);
        memory_free(v.d[a]);
    }
    omega2 = real_max(omega2, before);
    return omega2 > 0 ? MARGIN * 2 / sqrt(omega2) : INFINITY;
}

real critical_step_of_lattice(const struct bond_source *source, bond_force_fn *force, real density)
{
    const struct family *f = &source->family;
    const int dim = space_dim(f->space), edge = 2 * (int)ceil(f->cutoff / f->spacing) + 4;
    struct bond_source s = *source;
    struct particles p;
    struct cells cells;
    struct bonds b;
    int64_t n = 1;
    for (int d = 0; d < dim; d++) n *= edge;
    particles_make(&p, dim, n, 0);
    for (int64_t i = 0, k; i < n; i++) {
        k = i;
        for (int d = 0; d < dim; d++, k /= edge) p.x[d][i] = p.X[d][i] = (real)(k % edge) * f->spacing;
        p.volume[i] = p.volume0[i] = f->cell_volume;
        p.mass[i] = density * f->cell_volume;
        p.kind[i] = KIND_PD;
    }
    particles_list(&p);
    cells_make(&cells, &p, f->cutoff * (1 + 1e-9));
    s.cells = &cells, s.cracks = 0, s.image = NULL, s.room = 0, s.neighbour_volume = NULL;
    bonds_make(&b, NULL, &p, &s);
    real step = critical_step_of(&b, &p, force, f->spacing);
    bonds_free(&b);
    cells_free(&cells);
    particles_free(&p);
    return step;
}
