/* Largest nodal force of the first step, for patch probes. */
#include <math.h>

#include "probes/probes_part.h"
#include "mesh/mesh_part.h"
#include "grid/grid_part.h"

static bool in_patch(const struct scene *s, const real *x)
{
    for (int k = 0; k < s->probes; k++)
        if (s->probe[k].kind == PROBE_PATCH && region_contains(&s->probe[k].region, x, s->dim, 0)) return true;
    return false;
}

static bool wants_residual(const struct scene *s, const struct run_clock *clock)
{
    bool wanted = false;
    for (int k = 0; k < s->probes; k++) wanted |= s->probe[k].kind == PROBE_PATCH;
    return wanted && clock->step == 0;
}

void residual_keep_of(struct run *e, const struct grid *g)
{
    real x[DIM_MAX], *most = &e->probing->residual_step0;
    if (!wants_residual(e->scene, &e->clock)) return;
    for (int64_t I = 0; I < g->n; I++) {
        const int64_t at = g == &e->frame->mesh.grid ? mesh_base(&e->frame->mesh, I) : I;
        for (int d = 0; d < g->dim; d++) x[d] = grid_position(g, d, at / g->stride[d] % g->count[d]);
        for (int d = 0; d < g->dim; d++)
            if (in_patch(e->scene, x)) *most = real_max(*most, fabs(g->force[d][I]));
    }
}

void residual_keep(struct run *e)
{
    const struct particles *p = &e->part;
    real x[DIM_MAX], *most = &e->probing->residual_step0;
    if (!wants_residual(e->scene, &e->clock)) return;
    for (int k = 0; k < e->grid->fields; k++) residual_keep_of(e, &e->grid->field[k].grid);
    for (int64_t k = 0; k < p->n_of[KIND_PD]; k++) {
        int32_t i = p->list[KIND_PD][k];
        if (particle_on_grid(p, i)) continue;
        for (int d = 0; d < p->dim; d++) x[d] = p->X[d][i];
        for (int d = 0; d < p->dim; d++)
            if (in_patch(e->scene, x)) *most = real_max(*most, fabs(p->f[d][i]));
    }
}
