/* Computes the work of supports and applied forces between two equilibria (account.h). */
#include "account.h"

#include <math.h>

#include "base/memory.h"

void applied_forces_allocate_and_copy(real **applied, const struct statics *s, const struct particles *particles)
{
    for (int d = 0; d < particles->dim; d++) {
        applied[d] = NEW("statics.account", particles->n, real);
        if (s->applied[d]) array_copy(applied[d], s->applied[d], particles->n, sizeof(real));
    }
}

void work_account_store_initial_equilibrium(struct work_account *account, const struct statics *s,
                                            const struct particles *particles)
{
    *account = (struct work_account){0};
    applied_forces_allocate_and_copy(account->applied, s, particles);
    for (int d = 0; d < particles->dim; d++) {
        account->u.of[d] = BARE("statics.account", s->balance.n, real);
        account->f.of[d] = BARE("statics.account", s->balance.n, real);
        account->x[d] = BARE("statics.before", particles->n, real);
        array_copy(account->u.of[d], s->balance.u.of[d], s->balance.n, sizeof(real));
        array_copy(account->f.of[d], s->balance.f.of[d], s->balance.n, sizeof(real));
        array_copy(account->x[d], particles->x[d], particles->n, sizeof(real));
    }
}

void work_account_free(struct work_account *account)
{
    for (int d = 0; d < DIM_MAX; d++) {
        memory_free(account->u.of[d]);
        memory_free(account->f.of[d]);
        memory_free(account->applied[d]);
        memory_free(account->x[d]);
    }
    *account = (struct work_account){0};
}

real work_account_add_work_and_estimate_error(struct work_account *account, const struct statics *s,
                                              const struct particles *p, struct loads *loads, real curved_path_work)
{
    real range[2] = {0}, moved = 0;
    loads->work += curved_path_work;
    for (int d = 0; d < p->dim; d++) {
        for (int64_t k = 0; k < s->balance.n; k++) {
            const real shift = s->balance.u.of[d][k] - account->u.of[d][k], now = s->balance.f.of[d][k],
                       initial = account->f.of[d][k];
            moved += square(shift);
            if (!(s->balance.held[k] >> d & 1)) continue;
            loads->constraint_work -= 0.5 * (initial + now) * shift;
            range[0] += 0.5 * (now - initial) * shift;
        }
        for (int64_t i = 0; i < p->n; i++) {
            const real shift = p->x[d][i] - account->x[d][i], now = s->applied[d][i], initial = account->applied[d][i];
            loads->work += 0.5 * (initial + now) * shift;
            range[1] += 0.5 * (now - initial) * shift;
        }
    }
    work_account_free(account);
    return fabs(range[0]) + fabs(range[1]) + s->balance.noise * sqrt(moved);
}
