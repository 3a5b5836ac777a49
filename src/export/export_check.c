/* Writes check.csv: positions of particles in Cleave after some steps, and the broken share of their bonds. */
#include <math.h>

#include "base/memory.h"
#include "export_parts.h"
#include "step/report.h"

/* Computes volume[n], the sum of the volumes of the neighbours to which each of the n particles of `part` has an intact
 * bond in `bonds` [m^3]. LAMMPS computes damage as 1 minus the ratio of this sum to its initial value. */
static void joined_volume(real *volume, const struct particles *part, const struct bonds *bonds)
{
    for (int64_t i = 0; i < part->n; i++) {
        volume[i] = 0;
        for (struct bond_iterator it = bond_iterator_of_row(bonds, bonds->row_of[i]); bond_iterator_advance(&it);)
            if (it.bond.w != 0) volume[i] += part->volume0[it.bond.nbr];
    }
}

static void check_rows_write(FILE *to, const struct particles *p, const real *before, const real *after,
                             const real *damage)
{
    fputs("id,X [m],Y [m],Z [m],x [m],y [m],z [m],damage,damage_start\n", to);
    for (int64_t i = 0; i < p->n; i++) {
        fprintf(to, "%d", p->id[i] + 1);
        for (int d = 0; d < DIM_MAX; d++) fprintf(to, ",%.17g", d < p->dim ? p->X[d][i] : 0.0);
        for (int d = 0; d < DIM_MAX; d++) fprintf(to, ",%.17g", d < p->dim ? p->x[d][i] : 0.0);
        fprintf(to, ",%.17g,%.9g\n", before[i] > 0 ? 1 - after[i] / before[i] : 0.0, damage[i]);
    }
}

int64_t lammps_comparison_step_count(const struct lammps_export *exported)
{
    return exported->e->clock.steps < CHECK_STEPS ? exported->e->clock.steps : CHECK_STEPS;
}

status lammps_run_and_write_comparison_positions(FILE *file, struct lammps_export *x)
{
    struct run *run = x->e;
    const int64_t n = run->part.n, steps = run->clock.steps;
    real *before = NEW("check.before", n, real), *after = NEW("check.after", n, real),
         *damage = NEW("check.damage", n, real);
    joined_volume(before, &run->part, &run->bonds);
    array_copy(damage, run->part.damage, n, sizeof *damage);
    run->report->quiet = run->report->excerpt = true;
    run->clock.steps = lammps_comparison_step_count(x);
    const status ran = run_advance_to_end_time(run);
    run->clock.steps = steps;
    if (ran == OK) {
        /* In LAMMPS the new positions have already broken bonds. */
        run->kernels.bond_force(&run->bonds, &run->part, &run->source.limit, NULL);
        joined_volume(after, &run->part, &run->bonds);
        check_rows_write(file, &run->part, before, after, damage);
    }
    memory_free(before);
    memory_free(after);
    memory_free(damage);
    return ran;
}
