/* Writes an estimate of the run times of an export in LAMMPS and in Cleave, and which features of Cleave LAMMPS
 * lacks. */
#include <math.h>

#include "export_parts.h"

/* Time per directed bond and step on one core of the same machine [ns], from `cleave bench peers` (bench/README.md).
 * here: Cleave; there: LAMMPS of 29 September 2021 with pair_style peri; there_bonds: LAMMPS with bond_style bpm/peri.
 * In examples/bpm/peri of LAMMPS with 4096 particles, bpm/peri is 3.6 times (bond-based) and 5.4 times (state-based) as
 * fast as pair_style peri. */
struct bond_time {
    real here, there, there_bonds;
};
static struct bond_time bond_time_of(const struct scene *s)
{
    if (s->model == MODEL_BOND)
        return s->dim == 2 ? (struct bond_time){0.67, 15.4, 15.4 / 3.6} : (struct bond_time){0.77, 15.8, 15.8 / 3.6};
    return s->dim == 2 ? (struct bond_time){1.13, 40.6, 40.6 / 5.4} : (struct bond_time){1.39, 44.7, 44.7 / 5.4};
}

/* A duration as text with its unit, returned by value. */
struct duration {
    char text[40];
};
static struct duration duration_of(real seconds)
{
    struct duration d;
    if (seconds < 120)
        snprintf(d.text, sizeof d.text, "%.3g s", seconds);
    else if (seconds < 7200)
        snprintf(d.text, sizeof d.text, "%.3g min", seconds / 60);
    else
        snprintf(d.text, sizeof d.text, "%.3g h", seconds / 3600);
    return d;
}

void lammps_write_run_time_estimate(FILE *file, const struct lammps_export *x)
{
    const struct bond_time t = bond_time_of(x->s);
    const real there = x->bond_style ? t.there_bonds : t.there, work = 2e-9 * (real)x->bonds * (real)x->e->clock.steps;
    const int cores = machine_physical_core_count();
    fprintf(file,
            "%lld particles, %lld bonds, %lld steps of %.4g s: about %s on one core with LAMMPS, %s with Cleave\n",
            (long long)x->e->part.n, (long long)x->bonds, (long long)x->e->clock.steps, x->e->clock.dt,
            duration_of(work * there).text, duration_of(work * t.here).text);
    fprintf(file, "(%.3g ns with LAMMPS and %.2g ns with Cleave per directed bond and step, %s).\n", there, t.here,
            x->bond_style ? "the first by LAMMPS' own benchmark" : "measured on one machine");
    fprintf(file,
            "Break-even: %.0f ranks of LAMMPS with perfect parallel efficiency are as fast as Cleave on %d core%s.\n",
            ceil(cores * there / t.here), cores, cores == 1 ? "" : "s");
    fputs("Not in LAMMPS: material points and conversion (all particles have bonds from start to end), the balance "
          "of\nenergy, stress, crack tips and their speed, stress-intensity factors, probes, fragments, bitwise "
          "identical\nresults on any number of ranks.\n",
          file);
}
