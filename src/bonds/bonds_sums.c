/* Computes sums over bonds: volumes of the neighbours of each particle, bounds of frequencies from which the critical
 * time step follows, and the fracture energy. Volumes and time step are computed as if all particles were peridynamic,
 * or from the stored bonds. */
#include "bonds/surface.h"
#include "bonds_parts.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"

/* Relative difference up to which two volumes count as equal [1]: they are sums of some hundred terms in different
 * orders, and differ by round-off. */
#define WHOLE 1e-12

/* Returns the sum of the volumes of the neighbours of particle i of p, each times the weight of the bond to it in the
 * neighbourhood f [m^3]. s: cutoff and cells of the search; map: map from lattice sites to particles; found[capacity]:
 * working memory. */
static real volume_near(const struct particles *p, const struct bond_source *s, const struct family *f,
                        const struct lattice_site_map *map, int64_t i, int32_t *found, int capacity)
{
    const int n = particle_find_neighbours_within_cutoff(map, s, p, (int32_t)i, found, capacity);
    real volume = 0;
    for (int k = 0; k < n; k++) {
        real xi[DIM_MAX];
        for (int d = 0; d < p->dim; d++) xi[d] = p->X[d][found[k]] - p->X[d][i];
        volume += p->volume0[found[k]] * family_bond_weight(f, xi, sqrt(dot(xi, xi, p->dim)));
    }
    return volume;
}

/* Computes volume[i .. i + 7]: for each of these eight particles of p the sum of the volumes of its neighbours, each
 * times `weight` [m^3]. bonds: the neighbours, from the map of lattice sites. */
static void volumes_near(real *volume, const struct particles *p, const struct lattice_bonds *bonds, real weight,
                         int64_t i)
{
    real sum[LANES] = {0};
    for (int k = 0; k < bonds->n; k++)
        for (int l = 0; l < LANES; l++)
            sum[l] += l >= bonds->from[k] && l <= bonds->to[k] ? p->volume0[i + bonds->offset[k] + l] * weight : 0;
    for (int l = 0; l < LANES; l++) volume[i + l] = sum[l];
}

/* Sets those of n neighbourhood volumes, volume[n] [m^3], that equal the volume `full` of a full neighbourhood up to a
 * relative difference of WHOLE (round-off) exactly to `full`. Bonds inside a body then have weight 1, which need not be
 * stored (kernels/pd/bond_column.h). */
static void whole_volumes(real *volume, int64_t n, real full)
{
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < n; i++)
        if (fabs(volume[i] - full) <= WHOLE * full) volume[i] = full;
}

void bonds_compute_family_volumes(real *volume, const struct particles *p, const struct bond_source *s)
{
    const int most = bonds_neighbour_count_upper_bound(s);
    struct family plain = s->family; /* shell weights are left out: the surface correction counts volumes */
    struct lattice_site_map map = {0};
    plain.shell_weight[0] = plain.shell_weight[1] = 1;
    plain.influence = INFLUENCE_ONE;
    if (family_bonds_have_equal_weights(&plain)) lattice_site_map_make_if_particles_fit_lattice(&map, s, p);
#pragma omp parallel
    {
        int32_t *found = NEW("bonds.found", most, int32_t);
        struct lattice_bonds bonds;
        lattice_bonds_allocate_for_eight_particles(&bonds, &map);
#pragma omp for schedule(static)
        for (int64_t first = 0; first < p->n_all; first += LANES) {
            if (lattice_bonds_list_neighbours_ignoring_cracks(&map, s, p, first, &bonds)) {
                const int64_t cached = stencil_cache_find_or_add_lattice_bonds(&bonds, NULL, first);
                if (cached >= 0)
                    memcpy(volume + first, volume + cached, LANES * sizeof *volume);
                else
                    volumes_near(volume, p, &bonds, plain.shell_weight[0], first);
                continue;
            }
            for (int64_t i = first; i < first + LANES && i < p->n_all; i++)
                volume[i] = volume_near(p, s, &plain, &map, i, found, most);
        }
        lattice_bonds_free(&bonds);
        memory_free(found);
    }
    lattice_site_map_free(&map);
    whole_volumes(volume, p->n, s->family.full);
    for (int64_t k = p->n; k < p->n_all; k++) volume[k] = volume[s->image[k - p->n].source];
}

/* Returns an upper bound of omega^2 m for particle i of p [N/m], where omega is the largest angular frequency of its
 * motion and m its mass: a bound of the largest eigenvalue of the stiffness matrix of its bonds in `row`, taken as
 * springs. stiffness: force per stretch of a bond of weight 1 [N]. */
static real row_stiffness(const struct bond_row *row, const struct particles *p, int32_t i, real stiffness)
{
    struct gershgorin_bound bound = {{{0}}, 0};
    for (int k = 0; k < row->n; k++) {
        real n[DIM_MAX] = {0};
        for (int d = 0; d < p->dim; d++) n[d] = (p->X[d][row->nbr[k]] - p->X[d][i]) * row->inverse_length[k];
        gershgorin_bound_add_spring(&bound, stiffness * row->w[k] * row->inverse_length[k], n, p->dim);
    }
    return gershgorin_bound_largest_eigenvalue(&bound, p->dim);
}

real bonds_row_stiffness_eigenvalue_upper_bound(const struct bonds *b, const struct particles *p, int64_t row)
{
    const int64_t i = b->particle[row];
    struct gershgorin_bound bound = {{{0}}, 0};
    for (struct bond_iterator it = bond_iterator_of_row(b, row); bond_iterator_advance(&it);) {
        const struct bond bond = it.bond;
        real n[DIM_MAX] = {0};
        if (bond.w == 0) continue;
        for (int d = 0; d < p->dim; d++) n[d] = (p->X[d][bond.nbr] - p->X[d][i]) * bond.inverse_length;
        gershgorin_bound_add_spring(&bound, b->stiffness * bond.w * bond.inverse_length, n, p->dim);
    }
    return gershgorin_bound_largest_eigenvalue(&bound, p->dim);
}

/* Sums over the springs on eight consecutive particles, from which upper bounds of their frequencies follow. block:
 * 3 x 3 stiffness matrix that relates the force on a particle to its own displacement; total: sum of stiffnesses
 * [N/m]. */
struct eight_bounds {
    real block[DIM_MAX][DIM_MAX][LANES], total[LANES];
};

/* Adds the springs from particle i + l to particle j + l, l = 0 .. 7, to the sums *bound for particles i .. i + 7 of p.
 * inverse[8]: inverse lengths of the bonds [1/m]; w[8]: weights of the bonds [1], 0 for no spring; stiffness: force per
 * stretch of a bond of weight 1 [N]; dim: number of dimensions, known at compile time. */
static ALWAYS_INLINE void bounds_add(struct eight_bounds *bound, const struct particles *p, int64_t i, int64_t j,
                                     const real *inverse, const real *w, real stiffness, const int dim)
{
    real n[DIM_MAX][LANES], K[LANES];
    for (int d = 0; d < dim; d++)
        for (int l = 0; l < LANES; l++) n[d][l] = (p->X[d][j + l] - p->X[d][i + l]) * inverse[l];
    for (int l = 0; l < LANES; l++) K[l] = stiffness * w[l] * inverse[l];
    for (int a = 0; a < dim; a++)
        for (int c = 0; c < dim; c++)
            for (int l = 0; l < LANES; l++) bound->block[a][c][l] += K[l] * n[a][l] * n[c][l];
    for (int l = 0; l < LANES; l++) bound->total[l] += K[l];
}

/* Adds the springs from particle i + l to particle j + l, l = 0 .. 7, to the sums *bound for particles i .. i + 7, by
 * the code compiled for the number of dimensions of p. inverse[8]: inverse lengths of the bonds [1/m]; w[8]: weights of
 * the bonds [1], 0 for no spring; stiffness: force per stretch of a bond of weight 1 [N]. */
static void bounds_add_any(struct eight_bounds *bound, const struct particles *p, int64_t i, int64_t j,
                           const real *inverse, const real *w, real stiffness)
{
    switch (p->dim) {
    case 1:
        bounds_add(bound, p, i, j, inverse, w, stiffness, 1);
        break;
    case 2:
        bounds_add(bound, p, i, j, inverse, w, stiffness, 2);
        break;
    default:
        bounds_add(bound, p, i, j, inverse, w, stiffness, 3);
        break;
    }
}

/* Returns an upper bound of the largest squared angular frequency omega^2 of particles i .. i + 7 of p [1/s^2] from
 * *bounds, the sums over their springs. */
static real bounds_frequency(const struct eight_bounds *bounds, const struct particles *p, int64_t i)
{
    real largest = 0;
    for (int l = 0; l < LANES; l++) {
        struct gershgorin_bound one = {.total = bounds->total[l]};
        for (int a = 0; a < p->dim; a++)
            for (int c = 0; c < p->dim; c++) one.block[a][c] = bounds->block[a][c][l];
        largest = real_max(largest, gershgorin_bound_largest_eigenvalue(&one, p->dim) / p->mass[i + l]);
    }
    return largest;
}

/* Returns an upper bound of the largest squared angular frequency omega^2 of particles i .. i + 7 of p [1/s^2]. bonds:
 * their neighbours on the lattice; the weights of the bonds are computed here, and no rows are stored. pairs: stiffness
 * by pair of materials, divided by that of material 0; stiffness: force per stretch of a bond of weight 1 [N]. */
static real row_block_frequency(const struct lattice_bonds *bonds, const struct bond_source *s,
                                const struct particles *p, const struct material_pair_table *pairs, int64_t i,
                                real stiffness)
{
    struct eight_bounds bounds = {0};
    for (int k = 0; k < bonds->n; k++) {
        real inverse[LANES];
        real w[LANES];
        lattice_bonds_compute_eight_lengths_and_weights(s, p, pairs, i, i + bonds->offset[k], inverse, w);
        for (int l = 0; l < LANES; l++) w[l] = l >= bonds->from[k] && l <= bonds->to[k] ? w[l] : 0;
        bounds_add_any(&bounds, p, i, i + bonds->offset[k], inverse, w, stiffness);
    }
    return bounds_frequency(&bounds, p, i);
}

/* Returns an upper bound of the largest squared angular frequency omega^2 [1/s^2] of the particles of p in block g of
 * eight rows (the bonds of eight particles). It follows from the bonds of the block that are stored in b. */
static real row_block_frequency_made(const struct bonds *b, const struct particles *p, int64_t g)
{
    const int64_t columns = b->column_count[g];
    bool regular = b->aligned[g];
    real largest = 0;
    for (int64_t k = 0; k < columns && regular && !b->stencil[g]; k++) regular = b->first[b->column[g] + k] >= 0;
    if (!regular) {
        for (int64_t r = g * LANES; r < g * LANES + bond_row_block_row_count(b, g); r++)
            largest = real_max(largest, bonds_row_stiffness_eigenvalue_upper_bound(b, p, r) / p->mass[b->particle[r]]);
        return largest;
    }
    struct eight_bounds bounds = {0};
    struct column_copy column;
    for (int64_t k = 0; k < columns; k++) {
        bond_column_read_eight_bonds(&column, b, g, k);
        bounds_add_any(&bounds, p, b->particle[g * LANES], column.first, column.inverse_length, column.w, b->stiffness);
    }
    return bounds_frequency(&bounds, p, b->particle[g * LANES]);
}

real bonds_critical_time_step_of_existing_bonds(const struct bonds *b, const struct particles *p)
{
    real largest = 0;
#pragma omp parallel for schedule(static) reduction(max : largest)
    for (int64_t g = 0; g < b->row_blocks; g++) largest = real_max(largest, row_block_frequency_made(b, p, g));
    return largest > 0 ? 2 / sqrt(largest) : INFINITY;
}

/* Returns a table for bounds of frequencies: the stiffness of bonds for each pair of materials, divided by that of
 * material 0 [1]. In state-based models the entry of two materials is the mean of both, since each row of a bond
 * responds with its own modulus. s: materials and model. The caller frees the array `ratio` of the table with
 * memory_free. */
static struct material_pair_table pairs_of_bound(const struct bond_source *s)
{
    struct material_pair_table pairs = material_pair_table_compute_micro_moduli(s);
    const real first = family_micro_modulus(&s->family, &s->material[0]);
    for (int a = 0; a < s->materials && s->modulus; a++)
        for (int b = 0; b < s->materials; b++)
            pairs.ratio[a * s->materials + b] =
                0.5 / first *
                (family_micro_modulus(&s->family, &s->material[a]) + family_micro_modulus(&s->family, &s->material[b]));
    return pairs;
}

/* Returns an array [n] with 1 for the first particle of each class of particles with equal surroundings, else 0. The
 * other particles of a class have rows of equal stiffness and need not be examined. correction: classes, or NULL; map:
 * states whether distances on the lattice are exactly equal. Returns NULL if there are no classes, or if particles of a
 * class may have unequal bonds. The caller frees the array with memory_free. */
static uint8_t *first_of_classes(const struct surface_correction *correction, const struct lattice_site_map *map,
                                 int64_t n)
{
    if (!correction || !map->uniform) return NULL;
    uint8_t *first = NEW("bonds.first", n, uint8_t), *seen = NEW("bonds.seen", correction->classes, uint8_t);
    for (int64_t i = 0; i < n; i++) first[i] = !seen[correction->class_of[i]], seen[correction->class_of[i]] = 1;
    memory_free(seen);
    return first;
}

real bonds_critical_time_step_if_all_peridynamic(const struct particles *p, const struct bond_source *s)
{
    real stiffness = family_micro_modulus(&s->family, &s->material[0]) * square(s->family.cell_volume), largest = 0;
    struct material_pair_table pairs = pairs_of_bound(s);
    uint8_t *kind = NEW("bonds.kind", p->n_all, uint8_t);
    struct particles all = *p;
    array_fill_bytes(kind, KIND_PD, p->n_all, 1);
    all.kind = kind;
    struct lattice_site_map map;
    const struct bond_row_inputs inputs = {
        .source = s, .p = &all, .pairs = &pairs, .map = &map, .room = bonds_neighbour_count_upper_bound(s)};
    lattice_site_map_make_if_particles_fit_lattice(&map, s, p);
    uint8_t *needed = first_of_classes(s->surface, &map, p->n);
#pragma omp parallel reduction(max : largest)
    {
        struct bond_row row = {0};
        struct lattice_bonds regular;
        bond_row_buffer_make(&row, inputs.room);
        lattice_bonds_allocate_for_eight_particles(&regular, &map);
#pragma omp for schedule(static)
        for (int64_t first = 0; first < p->n; first += LANES) {
            bool any = !needed;
            for (int64_t i = first; i < first + LANES && i < p->n && !any; i++) any = needed[i];
            if (!any) continue;
            if (map.at && first + LANES <= p->n &&
                lattice_bonds_compute_unless_near_crack(&map, s, &all, first, &regular)) {
                /* an equal block of eight rows is already in `largest` */
                if (stencil_cache_find_or_add_lattice_bonds(&regular, s, first) < 0)
                    largest = real_max(largest, row_block_frequency(&regular, s, p, &pairs, first, stiffness));
                continue;
            }
            for (int64_t i = first; i < first + LANES && i < p->n; i++) {
                if (needed && !needed[i]) continue;
                bond_row_find_neighbours(&row, &inputs, (int32_t)i);
                bond_row_compute_lengths_and_weights(&row, &inputs, (int32_t)i);
                largest = real_max(largest, row_stiffness(&row, &all, (int32_t)i, stiffness) / p->mass[i]);
            }
        }
        lattice_bonds_free(&regular);
        bond_row_buffer_free(&row);
    }
    lattice_site_map_free(&map);
    memory_free(needed);
    memory_free(kind);
    memory_free(pairs.ratio);
    return largest > 0 ? 2 / sqrt(largest) : INFINITY;
}

real bonds_fracture_energy(const struct bonds *b)
{
    real sum = 0; /* few rows have any; a serial sum is equal on any number of threads */
    for (int64_t r = 0; r < b->rows; r++) sum += b->fracture_energy[r];
    return sum + bonds_dissipated_softening_energy(b);
}
