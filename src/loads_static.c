/* floor 3: boundary conditions of a static problem: what time makes of them is only where they end. */
#include "loads.h"

#include <math.h>
#include <string.h>

static bool is_force(const struct boundary *b)
{
    return b->kind == BOUNDARY_TRACTION || b->kind == BOUNDARY_BODY_FORCE;
}

void loads_static_boundaries(struct boundary *to, const struct boundary *from, int n, real duration, real ramp)
{
    for (int b = 0; b < n; b++) {
        real factor = 1;
        to[b] = from[b];
        if (is_force(&from[b])) {
            factor = time_function_at(&from[b].time, duration);
            to[b].time = (struct time_function){.kind = TIME_RAMP, .until = ramp};
        } else if (from[b].kind == BOUNDARY_VELOCITY) {
            factor = time_function_integral(&from[b].time, duration) / ramp;
            to[b].time = (struct time_function){.kind = TIME_STEP, .until = ramp};
        }
        for (int d = 0; d < DIM_MAX; d++) to[b].value[d] = factor * from[b].value[d];
    }
}

void loads_static_driven(struct loads *l, const struct particles *p, real ramp, real *const *displacement, uint8_t *held)
{
    for (int c = 0; c < l->n; c++) {
        struct load *load = &l->load[c];
        const struct boundary *b = load->boundary;
        if (b->kind != BOUNDARY_VELOCITY) continue;
        for (int d = 0; d < p->dim; d++) {
            if (!(b->components >> d & 1)) continue;
            load->displacement[d] = ramp * b->value[d];
            for (int64_t k = 0; k < load->n; k++) {
                displacement[d][load->particle[k]] = load->displacement[d];
                held[load->particle[k]] |= (uint8_t)(1 << d);
            }
        }
    }
}

void loads_static_force(const struct loads *l, struct particles *p)
{
    for (int c = 0; c < l->n; c++) {
        const struct load *load = &l->load[c];
        if (!is_force(load->boundary)) continue;
        for (int64_t k = 0; k < load->n; k++)
            for (int d = 0; d < p->dim; d++)
                p->f[d][load->particle[k]] += load->boundary->value[d] * load->share[k];
    }
}

void loads_static_hold(struct loads *l, struct particles *p)
{
    for (int c = 0; c < l->n; c++) {
        struct load *load = &l->load[c];
        memset(load->reaction, 0, sizeof load->reaction);
        if (load->boundary->kind != BOUNDARY_VELOCITY) continue;
        for (int64_t k = 0; k < load->n; k++)
            for (int d = 0; d < p->dim; d++) {
                if (!(load->boundary->components >> d & 1)) continue;
                load->reaction[d] -= p->f[d][load->particle[k]];
                p->f[d][load->particle[k]] = 0;
            }
    }
}

void loads_static_work(struct loads *l, const struct particles *p)
{
    l->work = l->held_work = 0;
    for (int c = 0; c < l->n; c++) {
        const struct load *load = &l->load[c];
        const struct boundary *b = load->boundary;
        for (int d = 0; d < p->dim; d++)
            if (b->kind == BOUNDARY_VELOCITY) l->held_work += 0.5 * load->reaction[d] * load->displacement[d];
        if (!is_force(b)) continue;
        for (int64_t k = 0; k < load->n; k++)
            for (int d = 0; d < p->dim; d++) {
                const int32_t i = load->particle[k];
                l->work += 0.5 * b->value[d] * load->share[k] * (p->x[d][i] - p->X[d][i]);
            }
    }
}
