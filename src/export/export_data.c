/* Writes plate.data: particles at rest, their initial velocities, per-particle values of loads, and bonds of
 * bpm/peri. */
#include <math.h>

#include "export_parts.h"

/* Returns the number of the LAMMPS bond type for bonds between the materials a and b, from 0, of `materials` materials.
 * Types are numbered from 1; each unordered pair of materials has one. */
static int bond_type(int materials, int a, int b)
{
    const int low = a < b ? a : b, high = a < b ? b : a;
    return low * materials - low * (low - 1) / 2 + high - low + 1;
}

static void box_write(FILE *to, const struct lammps_export *x)
{
    static const char *const name[DIM_MAX] = {"xlo xhi", "ylo yhi", "zlo zhi"};
    const real margin = 4 * x->s->spacing;
    for (int d = 0; d < DIM_MAX; d++) {
        real low = 0, high = 0;
        if (d < x->s->dim) particles_coordinate_range(&x->e->part, x->e->part.n, d, &low, &high);
        fprintf(to, "%.17g %.17g %s\n", low - margin, high + margin, name[d]);
    }
}

static void atoms_write(FILE *to, const struct lammps_export *x, const struct lammps_types *t)
{
    const struct particles *p = &x->e->part;
    fprintf(to, "\nAtoms # %s\n\n", x->bond_style ? "bond" : "peri");
    for (int64_t i = 0; i < p->n; i++) {
        if (x->bond_style)
            fprintf(to, "%d 1 %d", p->id[i] + 1, t->of[i]);
        else
            fprintf(to, "%d %d %.17g %.17g", p->id[i] + 1, t->of[i], p->volume0[i], p->mass[i] / p->volume0[i]);
        for (int d = 0; d < DIM_MAX; d++) fprintf(to, " %.17g", d < p->dim ? p->X[d][i] : 0.0);
        fputc('\n', to);
    }
}

static void velocities_write(FILE *to, const struct lammps_export *x)
{
    real v[DIM_MAX];
    fputs("\nVelocities\n\n", to);
    for (int64_t i = 0; i < x->e->part.n; i++) {
        lammps_compute_initial_velocity_of_particle(x, i, v);
        fprintf(to, "%d %.17g %.17g %.17g\n", x->e->part.id[i] + 1, v[0], v[1], v[2]);
    }
}

/* Writes the section of the LAMMPS file plate.data with the per-particle columns of loads and displacements of the
 * export x to the stream `to`. It must be the last section, since LAMMPS of 2021 reads no section after one of `fix
 * property/atom`. */
static void columns_write(FILE *to, const struct lammps_export *x)
{
    fputs("\nColumns\n\n", to);
    for (int64_t i = 0; i < x->e->part.n; i++) {
        fprintf(to, "%d", x->e->part.id[i] + 1);
        if (x->bond_style) fprintf(to, " %.17g 0", x->e->part.volume0[i]);
        for (int c = 0; c < x->columns; c++) fprintf(to, " %.17g", lammps_data_file_column_value(x, c, i));
        fputc('\n', to);
    }
}

static void bonds_write(FILE *to, const struct lammps_export *x)
{
    const struct run *run = x->e;
    const uint8_t *material = run->part.material;
    int64_t k = 0;
    fputs("\nBonds\n\n", to);
    for (int64_t i = 0; i < run->part.n; i++)
        for (struct bond_iterator it = bond_iterator_of_row(&run->bonds, run->bonds.row_of[i]);
             bond_iterator_advance(&it);)
            if (it.bond.w != 0 && it.bond.nbr > i)
                fprintf(to, "%lld %d %d %d\n", (long long)++k,
                        bond_type(x->s->materials, material[i], material[it.bond.nbr]), run->part.id[i] + 1,
                        run->part.id[it.bond.nbr] + 1);
}

void lammps_data_write(FILE *file, const struct lammps_export *x, const struct lammps_types *types)
{
    const struct particles *p = &x->e->part;
    fprintf(file, "%s, by Cleave\n\n%lld atoms\n%d atom types\n", x->s->name, (long long)p->n, types->n);
    if (x->bond_style)
        fprintf(file, "%lld bonds\n%d bond types\n", (long long)x->bonds,
                bond_type(x->s->materials, x->s->materials - 1, x->s->materials - 1));
    fputc('\n', file);
    box_write(file, x);
    if (x->bond_style) fputs("\nMasses\n\n", file);
    for (int k = 1; x->bond_style && k <= types->n; k++) fprintf(file, "%d %.17g\n", k, p->mass[types->any[k]]);
    atoms_write(file, x, types);
    velocities_write(file, x);
    if (x->bond_style) bonds_write(file, x);
    if (x->columns > 0 || x->bond_style) columns_write(file, x);
}
