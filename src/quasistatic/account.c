/* The work of supports and applied forces between two equilibria (account.h). */
#include "account.h"

#include <math.h>

#include "base/memory.h"

void applied_forces_copy(real **applied, const struct statics *s, const struct particles *part)
{
    for (int d = 0; d < part->dim; d++) {
        applied[d] = NEW("statics.account", part->n, real);
        if (s->applied[d]) array_copy(applied[d], s->applied[d], part->n, sizeof(real));
    }
}

void work_account_start(struct account *a, const struct statics *s, const struct particles *part)
{
    *a = (struct account){0};
    applied_forces_copy(a->applied, s, part);
    for (int d = 0; d < part->dim; d++) {
        a->u.of[d] = BARE("statics.account", s->balance.n, real);
        a->f.of[d] = BARE("statics.account", s->balance.n, real);
        a->x[d] = BARE("statics.before", part->n, real);
        array_copy(a->u.of[d], s->balance.u.of[d], s->balance.n, sizeof(real));
        array_copy(a->f.of[d], s->balance.f.of[d], s->balance.n, sizeof(real));
        array_copy(a->x[d], part->x[d], part->n, sizeof(real));
    }
}

void work_account_free(struct account *a)
{
    for (int d = 0; d < DIM_MAX; d++) {
        memory_free(a->u.of[d]);
        memory_free(a->f.of[d]);
        memory_free(a->applied[d]);
        memory_free(a->x[d]);
    }
    *a = (struct account){0};
}

real work_account_end(struct account *a, const struct statics *s, const struct particles *p, struct loads *loads,
                      real curved_path_work)
{
    real range[2] = {0};
    loads->work += curved_path_work;
    for (int d = 0; d < p->dim; d++) {
        for (int64_t k = 0; k < s->balance.n; k++) {
            const real shift = s->balance.u.of[d][k] - a->u.of[d][k], now = s->balance.f.of[d][k],
                       initial = a->f.of[d][k];
            if (!(s->balance.held[k] >> d & 1)) continue;
            loads->constraint_work -= 0.5 * (initial + now) * shift;
            range[0] += 0.5 * (now - initial) * shift;
        }
        for (int64_t i = 0; i < p->n; i++) {
            const real shift = p->x[d][i] - a->x[d][i], now = s->applied[d][i], initial = a->applied[d][i];
            loads->work += 0.5 * (initial + now) * shift;
            range[1] += 0.5 * (now - initial) * shift;
        }
    }
    work_account_free(a);
    return fabs(range[0]) + fabs(range[1]);
}
