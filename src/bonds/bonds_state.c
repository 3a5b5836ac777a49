/* Allocates the arrays of state-based models in the bond storage (per bond row, particle and mirror image), and
 * computes the weighted volumes of the neighbourhoods. */
#include "bonds_parts.h"

#include "base/memory.h"
#include "bonds/surface.h"

real state_based_weighted_volume_of_intact_bonds(const struct bonds *b, int64_t row)
{
    real Q = 0;
    for (struct bond_iterator it = bond_iterator_of_row(b, row); bond_iterator_advance(&it);)
        if (it.bond.w != 0) Q += it.bond.w / square(it.bond.inverse_length);
    return Q;
}

/* Computes the weighted volume Q = sum w r^2 over the bonds of each row of block g of eight rows of b (the bonds of
 * eight particles of p) [m^2], in b->state.weighted. With b->state.local the sum is over the bonds that exist, if all
 * lattice sites within the horizon of the particle are occupied; bonds that soften, or that broke by softening, count
 * with the weight before. Otherwise Q is that of an undamaged full neighbourhood on the lattice. For particles near
 * faces it is that of their surface class (surface.h) in both cases. */
static void row_block_weigh(struct bonds *b, const struct particles *p, const struct bond_source *s, int64_t g)
{
    const struct family *f = &s->family;
    real *Q = b->state.weighted + g * LANES;
    struct column_copy column;
    for (int l = 0; l < LANES; l++) Q[l] = 0;
    for (int64_t k = 0; b->state.local && k < b->column_count[g]; k++) {
        bond_column_read_eight_bonds(&column, b, g, k);
        for (int l = 0; l < LANES; l++) {
            const real w = bond_weight_before_softening(b, g, (b->column[g] + k) * LANES + l, column.w[l]);
            if (w != 0) Q[l] += w / square(column.inverse_length[l]);
        }
    }
    for (int l = 0; l < LANES && g * LANES + l < b->rows; l++)
        if (!b->state.local || !b->whole[g * LANES + l])
            Q[l] = f->weighted * p->volume0[b->particle[g * LANES + l]] / f->cell_volume;
    for (int l = 0; s->surface && l < LANES && g * LANES + l < b->rows; l++) {
        const int32_t i = b->particle[g * LANES + l], class = s->surface->class_of[i];
        if (class > 0) Q[l] = s->surface->weighted[class] * p->volume0[i] / f->cell_volume;
    }
}

void state_based_update_weighted_volumes(struct bonds *b, const struct particles *p, const struct bond_source *s)
{
    if (!b->state.modulus) return;
#pragma omp parallel for schedule(static)
    for (int64_t g = 0; g < b->row_blocks; g++) row_block_weigh(b, p, s, g);
}

/* Computes the weighted volume Q (sum over the bonds of a row) of those blocks of eight rows of b (the bonds of eight
 * particles) that are rebuilt: those in which Q is still 0. Blocks that were copied from the previous bonds already
 * have their Q. s: inputs of the bonds; p: particles. */
static void state_weigh_new(struct bonds *b, const struct particles *p, const struct bond_source *s)
{
#pragma omp parallel for schedule(static)
    for (int64_t g = 0; g < b->row_blocks; g++)
        if (b->state.weighted[g * LANES] == 0) row_block_weigh(b, p, s, g);
}

void bonds_initialise_state_based_moduli(struct bonds *b, const struct bond_source *s)
{
    if (!s->modulus) return;
    b->state.modulus = s->modulus;
    b->state.local = s->local;
    b->state.share = s->surface ? s->family.cell_volume / s->family.weighted : 0;
    b->state.weighted = NEW("state.weighted", b->row_blocks * LANES, real);
}

void bonds_make_state_based_arrays(struct bonds *b, const struct particles *p, const struct bond_source *s)
{
    if (!s->modulus) return;
    const int64_t room = p->n_all + LANES;
    b->state.past = NEW("state.past", b->row_blocks, uint8_t);
    b->state.pressed = NEW("state.pressed", b->row_blocks, uint8_t);
    b->state.pressure = NEW("state.pressure", room, real);
    b->state.spring = NEW("state.spring", room, real);
    for (int c = 0; s->rotates && c < ROTATION; c++) b->state.rotation[c] = NEW("state.turn", room, real);
    for (int c = 0; c < (s->rotates ? STATE_NUMBERS : 2); c++) b->state.before[c] = NEW("state.before", room, real);
    b->state.image = NEW("state.image", p->n_all - p->n, struct state_image);
    for (int64_t k = 0; k < p->n_all - p->n; k++)
        b->state.image[k] = (struct state_image){s->image[k].source, s->mirror_axis[s->image[k].load]};
    state_weigh_new(b, p, s);
}

void bonds_free_state_based_arrays(struct bonds *b)
{
    memory_free(b->state.weighted);
    memory_free(b->state.past);
    memory_free(b->state.pressed);
    memory_free(b->state.pressure);
    memory_free(b->state.spring);
    for (int c = 0; c < ROTATION; c++) memory_free(b->state.rotation[c]);
    for (int c = 0; c < STATE_NUMBERS; c++) memory_free(b->state.before[c]);
    memory_free(b->state.image);
}
