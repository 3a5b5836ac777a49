/* Finds the pairs of particles that LAMMPS would bond, because they are within its cutoff, although they have no bond
 * in the exported input file; LAMMPS has to exclude these. */
#include <math.h>

#include "base/memory.h"
#include "export_parts.h"

/* Relative tolerance of weights of bonds: shares of volume are rounded, and so are weights (family.c). Weights by other
 * rules differ by more. */
static const real WEIGHT_NEAR = 1e-6;

/* Returns the share beta(r) of the volume of a neighbour at distance r [m] that counts in the LAMMPS styles peri/pmb
 * and peri/lps [1]: beta = 1/2 + (x->cutoff - r)/x->lattice within half a lattice constant of the cutoff, and 1 closer
 * to the particle. x: the export, with cutoff and lattice constant of LAMMPS. */
static real lammps_share(const struct lammps_export *x, real r)
{
    return fabs(r - x->cutoff) <= 0.5 * x->lattice ? 0.5 + (x->cutoff - r) / x->lattice : 1;
}

/* Returns the squared reference distance of the particles i and j of p [m^2], with the same rounding as in LAMMPS,
 * which has z = 0 for all particles in 2D. */
static real distance2(const struct particles *p, int64_t i, int64_t j)
{
    real sum = 0;
    for (int d = 0; d < p->dim; d++) sum += square(p->X[d][i] - p->X[d][j]);
    return sum;
}

/* Returns the ratio c/c_0 of the micro-modulus c of a bond between the materials number a and b to the micro-modulus
 * c_0 of material 0 in the exported scene of x [1]. The two halves of the bond act as springs in series: c = 2 c_a
 * c_b/(c_a + c_b). */
static real modulus_ratio(const struct lammps_export *x, int a, int b)
{
    const struct family *f = &x->e->source.family;
    const struct material *m = x->s->material;
    if (a == b && a == 0) return 1;
    const real first = family_micro_modulus(f, &m[a]), second = family_micro_modulus(f, &m[b]);
    return 2 * first * second / (first + second) / family_micro_modulus(f, &m[0]);
}

/* Returns true if the weight of `bond`, a bond of particle i in the export x, equals the weight that LAMMPS would use,
 * to within the relative tolerance WEIGHT_NEAR. */
static bool weight_alike(const struct lammps_export *x, int64_t i, const struct bond *bond)
{
    const struct particles *p = &x->e->part;
    const struct family *f = &x->e->source.family;
    const int64_t j = bond->nbr;
    const real r = 1 / bond->inverse_length, V2 = p->volume0[i] * p->volume0[j] / square(f->cell_volume);
    const real law = x->e->source.modulus ? f->horizon / r : modulus_ratio(x, p->material[i], p->material[j]);
    return fabs(bond->w - lammps_share(x, r) * V2 * law) <= WEIGHT_NEAR * bond->w;
}

static status bond_refuse(const struct lammps_export *x, int64_t i, const char *what)
{
    const struct particles *p = &x->e->part;
    return status_set(REFUSED, "%s: a bond of the particle at (%.6g, %.6g, %.6g) m %s", printable_name(x->s->path).text,
                      p->X[0][i], p->X[1][i], p->dim > 2 ? p->X[2][i] : 0, what);
}

/* Sets bonded[j] = i + 1 for each neighbour j of particle i to which the scene of the export x has a bond, and stores
 * the number of these bonds in *n. bonded[particles]: 0 before the first call. Returns REFUSED, with a message, if
 * LAMMPS would give a bond another weight, or if a bond is longer than the cutoff of LAMMPS by round-off. The latter
 * can occur for bonds as long as the horizon. */
static status row_mark(const struct lammps_export *x, int64_t i, int64_t *bonded, int *n)
{
    const struct run *run = x->e;
    *n = 0;
    for (struct bond_iterator it = bond_iterator_of_row(&run->bonds, run->bonds.row_of[i]);
         bond_iterator_advance(&it);) {
        if (it.bond.w == 0) continue;
        bonded[it.bond.nbr] = i + 1;
        ++*n;
        if (!(distance2(&run->part, i, it.bond.nbr) <= square(x->cutoff)))
            return bond_refuse(x, i,
                               "is as long as the horizon, so in LAMMPS round-off decides whether it exists; set a "
                               "horizon between two distances of the lattice, such as -s particles.horizon=3.015");
        if (!weight_alike(x, i, &it.bond))
            return bond_refuse(
                x, i, "has a weight that LAMMPS does not support; use particles on a regular lattice and one material");
    }
    return OK;
}

/* Finds the particles to which LAMMPS would bond particle i: those within the cutoff of the export x. found[capacity]:
 * receives their indices; it must have capacity for all of them. Returns their number. */
static int lammps_near(const struct lammps_export *x, int64_t i, int32_t *found, int capacity)
{
    const struct run *run = x->e;
    real X[DIM_MAX];
    int kept = 0;
    particle_reference_position(&run->part, i, X);
    const int n = cells_list_particles_near_point(&run->cells, &run->part, X, run->source.family.cutoff, (int32_t)i,
                                                  found, capacity);
    for (int k = 0; k < n; k++)
        if (distance2(&run->part, i, found[k]) <= square(x->cutoff)) found[kept++] = found[k];
    return kept;
}

/* ---- keys -------------------------------------------------------------------------------------------------------- */

/* Returns the hash of a sequence of numbers with one more number at its end. hash: hash of the sequence so far; word:
 * the number at its end. */
static uint64_t mix(uint64_t hash, int64_t word)
{
    hash = (hash ^ (uint64_t)word) * 0x9E3779B97F4A7C15u;
    return hash ^ hash >> 29;
}

static int64_t lattice_place(const struct lammps_export *x, int64_t i, int d)
{
    return (int64_t)floor((x->e->part.X[d][i] - x->e->part.X[d][0]) / x->s->spacing + 0.5);
}

/* Returns a hash of the material, the loads and the lattice position of particle i of the export x. The position is
 * taken modulo 2 m + 1 spacings along each axis, where m is the reach of bonds [spacings]. Two neighbours are at most m
 * spacings apart along each axis, so that the vector between them follows from both reduced positions. */
static uint64_t key_of(const struct lammps_export *x, int64_t i)
{
    const int64_t period = 2 * (int64_t)floor(x->cutoff / x->s->spacing + 1e-6) + 1;
    uint64_t key = mix(mix(1, x->e->part.material[i]), x->loads[i]);
    for (int d = 0; d < x->s->dim; d++) key = mix(key, (lattice_place(x, i, d) % period + period) % period);
    return key;
}

/* Returns a hash of the lattice vector from particle i to particle j of the export x. */
static uint64_t offset_of(const struct lammps_export *x, int64_t i, int64_t j)
{
    uint64_t offset = 2;
    for (int d = 0; d < x->s->dim; d++) offset = mix(offset, lattice_place(x, j, d) - lattice_place(x, i, d));
    return offset;
}

/* ---- particles at cut bonds -------------------------------------------------------------------------------------- */

/* Work arrays of the search for cut bonds, which are pairs that LAMMPS would bond and the scene does not. found[room]:
 * neighbours of a particle in LAMMPS; bonded[particles]: i + 1 for the neighbours to which particle i has a bond in the
 * scene; number[particles]: 1 for particles at cut bonds, later their index in the list of these particles. */
struct search {
    int32_t *found;
    int64_t *bonded;
    int32_t *number;
    int room;
};

/* Sets a->number[i] to 1 for each particle i of the export x with at least one cut bond, else to 0. Cut bonds are pairs
 * within the cutoff of LAMMPS that have no bond in the exported scene. *bonds, *cut: receive the number of bonds of the
 * scene and of cut bonds. Returns REFUSED, with a message, if LAMMPS cannot represent a bond of the scene. */
static status touched_find(const struct lammps_export *x, struct search *a, int64_t *bonds, int64_t *cut)
{
    int64_t ends = 0, ends_cut = 0;
    for (int64_t i = 0; i < x->e->part.n; i++) {
        int row;
        TRY(row_mark(x, i, a->bonded, &row));
        const int near = lammps_near(x, i, a->found, a->room);
        a->number[i] = near > row;
        ends += row, ends_cut += near - row;
    }
    *bonds = ends / 2, *cut = ends_cut / 2;
    return OK;
}

/* Lists in t the particles of the export x for which a->number is 1, those with a cut bond (a pair that LAMMPS would
 * bond and the scene does not). Allocates t->key, which later holds a sort key for each. Replaces a->number[i] by the
 * index of particle i in the list, or -1 for other particles. Call it after touched_find. */
static void touched_list(struct particles_at_cut_bonds *t, const struct lammps_export *x, struct search *a)
{
    const int64_t n = x->e->part.n;
    for (int64_t i = 0; i < n; i++) t->n += a->number[i];
    t->particle = NEW("touched.particle", t->n, int32_t);
    t->first = NEW("touched.first", t->n + 1, int64_t);
    t->key = NEW("touched.key", t->n, uint64_t);
    for (int64_t i = 0, k = 0; i < n; i++) {
        if (a->number[i]) t->particle[k] = (int32_t)i;
        a->number[i] = a->number[i] ? (int32_t)k++ : -1;
    }
}

/* Lists, for each particle at a cut bond (list t of the export x), those of its neighbours in LAMMPS that are in t as
 * well, and the kind of each pair: bonded or cut in the exported input file. Computes t->key of the particle: the sum
 * of a hash of its material, loads and lattice position and of hashes of the lattice vectors to the neighbours at its
 * cut bonds. a: work arrays, after touched_list. */
static void touched_near(struct particles_at_cut_bonds *t, const struct lammps_export *x, struct search *a)
{
    for (int64_t k = 0; k < t->n; k++) {
        const int64_t i = t->particle[k];
        int row;
        row_mark(x, i, a->bonded, &row);
        const int near = lammps_near(x, i, a->found, a->room);
        GROW("touched.near", t->near, t->first[k] + near);
        GROW("touched.cut", t->cut, t->first[k] + near);
        t->key[k] = key_of(x, i);
        t->first[k + 1] = t->first[k];
        for (int q = 0; q < near; q++) {
            const int32_t j = a->found[q];
            const bool cut = a->bonded[j] != i + 1;
            if (cut) t->key[k] += offset_of(x, i, j);
            if (a->number[j] < 0) continue;
            t->near[t->first[k + 1]] = a->number[j];
            t->cut[t->first[k + 1]++] = cut;
        }
    }
}

status lammps_find_bonds_to_cut(struct particles_at_cut_bonds *touched, struct lammps_export *x)
{
    struct search a = {.room = bonds_neighbour_count_upper_bound(&x->e->source) + 1};
    a.found = NEW("touched.found", a.room, int32_t);
    a.bonded = NEW("touched.bonded", x->e->part.n_all, int64_t);
    a.number = NEW("touched.number", x->e->part.n_all, int32_t);
    *touched = (struct particles_at_cut_bonds){0};
    const status s = touched_find(x, &a, &x->bonds, &x->cut);
    if (s == OK && !x->bond_style) touched_list(touched, x, &a), touched_near(touched, x, &a);
    memory_free(a.found);
    memory_free(a.bonded);
    memory_free(a.number);
    return s;
}
