/* Makes one row of bonds (all bonds of one particle): search for neighbours, weights, and the state of its bonds from
 * the previous row of the particle. */
#include "bonds_parts.h"

#include <math.h>

#include "base/memory.h"
#include "bonds/surface.h"

/* Relative reduction of the stretch above which the vector test reports a bond [1]. It makes sure that round-off
 * hides no broken bond; the scalar test of the reported bonds is exact. */
#define TRIGGER_MARGIN 1e-9

void bond_row_buffer_make(struct bond_row *row, int capacity)
{
    row->nbr = BARE("bonds.row", capacity + 1, int32_t); /* room for one more: row_copy may write it */
    row->inverse_length = BARE("bonds.row", capacity + 1, real);
    row->w = BARE("bonds.row", capacity + 1, real);
    row->plastic = BARE("bonds.row", capacity + 1, struct bond_plasticity);
    row->soft = BARE("bonds.row", capacity + 1, struct bond_softening_state);
}

void bond_row_buffer_free(struct bond_row *row)
{
    memory_free(row->nbr);
    memory_free(row->inverse_length);
    memory_free(row->w);
    memory_free(row->plastic);
    memory_free(row->soft);
}

/* ---- neighbours -------------------------------------------------------------------------------------------------- */

/* Lists the particles and mirror images of the body of particle i of p within its cutoff in found[capacity], in
 * ascending order, without i. Returns their number. A number above `capacity` means that the list is incomplete. s:
 * cutoff and cells of the search. */
static int family_search(const struct bond_source *s, const struct particles *p, int32_t i, int32_t *found,
                         int capacity)
{
    real X[DIM_MAX];
    particle_reference_position(p, i, X);
    int n = cells_list_particles_near_point(s->cells, p, X, s->family.cutoff, i, found, capacity), kept = 0;
    if (n > capacity) return n;
    for (int k = 0; k < n; k++)
        if (p->body[found[k]] == p->body[i]) found[kept++] = found[k];
    return kept;
}

/* Removes from found[n] those neighbours of particle i of p for which the line to i passes through a void (a hole of
 * the body without particles). s: has the voids. The others keep their order. Returns the number of remaining
 * neighbours. */
static int family_seen(const struct bond_source *s, const struct particles *p, int32_t i, int32_t *found, int n)
{
    int kept = 0;
    if (!particle_is_beside_void(s->voids, i)) return n;
    for (int k = 0; k < n; k++)
        if (!void_separates_particles(s->voids, p, i, found[k])) found[kept++] = found[k];
    return kept;
}

int particle_find_neighbours_within_cutoff(const struct lattice_site_map *map, const struct bond_source *s,
                                           const struct particles *p, int32_t particle, int32_t *neighbour,
                                           int capacity)
{
    int n = map && map->at && particle < p->n
                ? lattice_site_map_list_neighbours_of_particle(map, p, particle, neighbour)
                : -1;
    if (n < 0) n = family_search(s, p, particle, neighbour, capacity);
    return n > capacity ? n : family_seen(s, p, particle, neighbour, n);
}

int bonds_neighbour_count_upper_bound(const struct bond_source *source)
{
    if (source->room > 0) return source->room;
    return cells_neighbour_count_upper_bound(source->cells, source->family.cutoff);
}

bool precracks_cut_bond_between(const struct crack *precrack, int precrack_count, const struct particles *p,
                                int64_t particle, int64_t other_particle)
{
    real a[DIM_MAX], b[DIM_MAX];
    particle_reference_position(p, particle, a);
    particle_reference_position(p, other_particle, b);
    for (int c = 0; c < precrack_count; c++)
        if (crack_cuts_bond(&precrack[c], a, b, p->dim)) return true;
    return false;
}

bool particle_is_near_precrack(const struct bond_source *source, const struct particles *p, int64_t particle)
{
    real X[DIM_MAX];
    particle_reference_position(p, particle, X);
    for (int c = 0; c < source->cracks; c++)
        if (crack_may_cut_bonds_near(&source->crack[c], X, source->family.cutoff, p->dim)) return true;
    return false;
}

bool particle_is_near_precrack_or_void(const struct bond_source *source, const struct particles *p, int64_t particle)
{
    return particle_is_beside_void(source->voids, particle) || particle_is_near_precrack(source, p, particle);
}

/* ---- one row ----------------------------------------------------------------------------------------------------- */

/* Returns the weight [1] of the bond between particles i and j of p: product of partial volume, influence, volumes and
 * materials of both particles, and the surface correction. xi[dim], r: reference vector from i to j and its length [m];
 * s: neighbourhood and surface correction; pairs: stiffness by pair of materials, divided by that of material 0.
 * Exchanging i and j changes no bit. */
static real bond_weight(const struct bond_source *s, const struct particles *p, const struct material_pair_table *pairs,
                        int32_t i, int32_t j, const real *xi, real r)
{
    /* written such that exchanging i and j changes no bit */
    real weight =
        family_bond_weight(&s->family, xi, r) * ((p->volume0[i] * p->volume0[j]) / square(s->family.cell_volume));
    weight *= pairs->ratio[p->material[i] * pairs->materials + p->material[j]];
    if (s->neighbour_volume) /* volume method, Le & Bobaru 2018 */
        weight *= 2 * s->family.full / (s->neighbour_volume[i] + s->neighbour_volume[j]);
    if (s->surface) weight *= surface_correction_bond_weight_factor(s->surface, i, xi);
    return weight;
}

real bond_weight_of_pair(const struct bond_source *source, const struct particles *p,
                         const struct material_pair_table *pairs, int32_t particle, int32_t other_particle)
{
    real xi[DIM_MAX], r2 = 0;
    for (int d = 0; d < p->dim; d++) xi[d] = p->X[d][other_particle] - p->X[d][particle], r2 += square(xi[d]);
    return bond_weight(source, p, pairs, particle, other_particle, xi, sqrt(r2));
}

/* Lists the neighbours with which particle i of p has bonds in row->nbr[capacity], ascending: all within the cutoff if
 * it is peridynamic, only the peridynamic ones if it is a material point. Sets row->n, their number, and
 * row->family_volume, the volume of all neighbours within the cutoff [m^3]. s: cutoff and cells of the search; map: map
 * from lattice sites to particles. */
static void row_search(struct bond_row *row, const struct lattice_site_map *map, const struct bond_source *s,
                       const struct particles *p, int32_t i, int capacity)
{
    int n = particle_find_neighbours_within_cutoff(map, s, p, i, row->nbr, capacity), kept = 0;
    row->family_volume = 0;
    for (int k = 0; k < n; k++) {
        row->family_volume += p->volume0[row->nbr[k]];
        if (p->kind[i] == KIND_PD || p->kind[row->nbr[k]] == KIND_PD) row->nbr[kept++] = row->nbr[k];
    }
    row->n = kept;
}

/* Returns the elastic strain e . (C^-1 sigma) e of material point i of p along the unit vector e[dim] [1], with the
 * stress sigma of the point and its elastic tensor C. m: array of materials. */
static real elastic_strain_along(const struct particles *p, const struct material *m, int64_t i, const real *e)
{
    const int dim = p->dim, n = symmetric_tensor_component_count(dim);
    real compliance[SYM_MAX * SYM_MAX], sum = 0;
    material_compliance_matrix(&m[p->material[i]], dim, compliance);
    for (int s = 0; s < n; s++) {
        int a, b;
        real strain = 0;
        symmetric_tensor_component_axes(dim, s, &a, &b);
        for (int t = 0; t < n; t++) strain += compliance[s * n + t] * p->stress[t][i];
        sum += (s < dim ? 1 : 2) * e[a] * e[b] * strain;
    }
    return sum;
}

/* Returns the initial plastic state of the bond between material points i and j of p (j may be a mirror image): 0 if
 * neither has yielded. Its plastic stretch is the part of the present stretch that the points' stress does not explain
 * elastically, its plastic path the mean of their plastic strains. A bar then carries the stress of its points to the
 * last digit. s: has the elastic constants; r: reference length of the bond [m]. The value is symmetric in i and j. */
static struct bond_plasticity plasticity_of_points(const struct bond_source *s, const struct particles *p, int32_t i,
                                                   int32_t j, real r)
{
    const int32_t other = j < p->n ? j : i; /* mirror images store no stress */
    real e[DIM_MAX], length2 = 0;
    if (!p->plastic_strain || p->plastic_strain[i] + p->plastic_strain[other] <= 0)
        return (struct bond_plasticity){0, 0};
    for (int d = 0; d < p->dim; d++) e[d] = p->x[d][j] - p->x[d][i], length2 += square(e[d]);
    const real length = sqrt(length2);
    for (int d = 0; d < p->dim; d++) e[d] /= length;
    const real elastic = elastic_strain_along(p, s->material, i, e) + elastic_strain_along(p, s->material, other, e);
    return (struct bond_plasticity){length / r - 1 - 0.5 * elastic,
                                    0.5 * (p->plastic_strain[i] + p->plastic_strain[other])};
}

/* Returns the stretch of a bond above which the vector test reports the bond to the exact test [1]. It is the stretch
 * at which the bond breaks or begins to soften, reduced by TRIGGER_MARGIN. If the strength depends on the strain rate,
 * it is half of that, because the rate is measured from there on. particle, other_particle: indices of both particles
 * in p; source: has the critical stretches. */
real bond_stretch_threshold_of_exact_break_test(const struct bond_source *source, const struct particles *p,
                                                int32_t particle, int32_t other_particle)
{
    const struct bond_limit *limit = &source->limit;
    const real onset = bond_softening_range(p, limit, particle, other_particle).onset * (1 - TRIGGER_MARGIN);
    const int pair = p->material[particle] * limit->materials + p->material[other_particle];
    return limit->softening && limit->softening[pair].rate ? RATE_FROM * onset : onset;
}

/* Computes inverse lengths and weights of the bonds from particle i of p to the row->n neighbours in row->nbr. Also
 * computes row->trigger, the smallest stretch at which one of these bonds must be tested for breaking or softening [1].
 * A bond that a pre-crack cuts gets weight 0 and a negative inverse length. s: data from which bonds are made; pairs:
 * stiffness by pair of materials, divided by that of material 0. */
static void row_weigh(struct bond_row *row, const struct bond_source *s, const struct particles *p,
                      const struct material_pair_table *pairs, int32_t i)
{
    const bool near = particle_is_near_precrack(s, p, i);
    row->trigger = INFINITY, row->cut_volume = 0;
    for (int k = 0; k < row->n; k++) {
        int32_t j = row->nbr[k];
        real xi[DIM_MAX], r2 = 0;
        for (int d = 0; d < p->dim; d++) xi[d] = p->X[d][j] - p->X[d][i], r2 += square(xi[d]);
        bool cut = near && precracks_cut_bond_between(s->crack, s->cracks, p, i, j);
        const real r = sqrt(r2);
        if (cut) row->cut_volume += p->volume0[j];
        row->inverse_length[k] = (cut ? -1 : 1) / r;
        row->w[k] = cut ? 0 : bond_weight(s, p, pairs, i, j, xi, r);
        if (s->yield.stretch) row->plastic[k] = plasticity_of_points(s, p, i, j, r);
        row->trigger = real_min(row->trigger, bond_stretch_threshold_of_exact_break_test(s, p, i, j));
    }
}

/* Returns the plastic state of bond number k (from 0) of one of the eight particles of block `row_block` of eight rows
 * (the bonds of eight particles). lane: number of this particle, 0 to 7. Call it only if bonds may yield
 * (b->plastic_stretch is not NULL). */
static struct bond_plasticity stored_plasticity(const struct bonds *b, int64_t row_block, int64_t k, int lane)
{
    const int64_t q = (b->column[row_block] + k) * LANES + lane;
    return (struct bond_plasticity){b->plastic_stretch[q], b->plastic_path[q]};
}

/* Copies the state of broken, yielded and softened bonds of a particle of p to `row` from the previous bonds `old`, in
 * which the particle had row old_row. Both rows may have different neighbours; bonds in only one of them are left out.
 */
static void row_inherit(struct bond_row *row, const struct particles *p, const struct bonds *old, int64_t old_row)
{
    int64_t row_block = old_row / LANES;
    int lane = (int)(old_row % LANES);
    int m = 0; /* neighbours ascend in both rows */
    for (int64_t k = 0; k < old->column_count[row_block]; k++) {
        const struct bond bond = bond_read(old, row_block, k, lane);
        if (bond.inverse_length == 0) continue;
        while (m < row->n && row->nbr[m] < bond.nbr) m++;
        if (m == row->n || row->nbr[m] != bond.nbr || row->w[m] == 0) continue;
        if (old->plastic_stretch) row->plastic[m] = stored_plasticity(old, row_block, k, lane);
        if (old->soft.whole && bond_is_softening(old, row_block, bond.entry)) row->w[m] = bond.w;
        if (bond.w != 0) continue;
        row->w[m] = 0, row->inverse_length[m] = -fabs(row->inverse_length[m]);
        row->cut_volume += p->volume0[row->nbr[m]];
    }
}

/* Copies the neighbours of a particle to `row` and sets row->n, their number. They are those of row old_row of the
 * previous bonds `old`, the row of this particle, which has not changed. */
static void row_copy_neighbours(struct bond_row *row, const struct bonds *old, int64_t old_row)
{
    const int64_t row_block = old_row / LANES, columns = old->column_count[row_block];
    row->n = 0;
    for (int64_t k = 0; k < columns; k++) { /* padding is overwritten */
        const struct bond bond = bond_read(old, row_block, k, (int)(old_row % LANES));
        row->nbr[row->n] = bond.nbr;
        row->n += bond.inverse_length != 0;
    }
}

/* Copies lengths, weights and plastic state of the bonds of a particle to `row`. They are those of row old_row of the
 * previous bonds `old`, the row of this particle, which has not changed. */
static void row_copy(struct bond_row *row, const struct bonds *old, int64_t old_row)
{
    const int64_t row_block = old_row / LANES, columns = old->column_count[row_block];
    int n = 0;
    for (int64_t k = 0; k < columns; k++) {
        const struct bond bond = bond_read(old, row_block, k, (int)(old_row % LANES));
        row->inverse_length[n] = bond.inverse_length;
        row->w[n] = bond.w;
        if (old->plastic_stretch) row->plastic[n] = stored_plasticity(old, row_block, k, (int)(old_row % LANES));
        n += bond.inverse_length != 0;
    }
    row->trigger = old->trigger[old_row];
    row->family_volume = old->family_volume[old_row];
    row->cut_volume = old->broken_volume[old_row];
}

void bond_row_find_neighbours(struct bond_row *row, const struct bond_row_inputs *inputs, int32_t particle)
{
    if (bond_row_previous_neighbours_are_valid(inputs, particle))
        row_copy_neighbours(row, inputs->old, inputs->old->row_of[particle]);
    else
        row_search(row, inputs->map, inputs->source, inputs->p, particle, inputs->room);
}

void bond_row_compute_lengths_and_weights(struct bond_row *row, const struct bond_row_inputs *inputs, int32_t particle)
{
    const int64_t before = inputs->old ? inputs->old->row_of[particle] : -1;
    if (inputs->source->limit.softening) bond_row_set_softening_state(row, inputs, particle);
    if (bond_row_previous_neighbours_are_valid(inputs, particle)) {
        row_copy(row, inputs->old, before);
        return;
    }
    row_weigh(row, inputs->source, inputs->p, inputs->pairs, particle);
    if (before >= 0) row_inherit(row, inputs->p, inputs->old, before);
}
