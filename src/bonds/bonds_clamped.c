/* Lists the bonds to mirror images across clamped planes (planes at which all motion is prevented), and the particles
 * on which their reactions act. */
#include "bonds_parts.h"

#include <string.h>

#include "base/memory.h"

/* Computes sign[DIM_MAX], 1 or -1: component d of the displacement of mirror image j of p is sign[d] times that of the
 * particle that it mirrors, directly or through other images. Returns true if one of these mirrors is clamped
 * (s->mirror_axis < 0), in which all components change their sign. */
static bool image_rotates(const struct bond_source *s, const struct particles *p, int64_t j, int8_t *sign)
{
    bool clamp = false;
    memset(sign, 1, DIM_MAX);
    for (; j >= p->n; j = s->image[j - p->n].source) {
        const int axis = s->mirror_axis[s->image[j - p->n].load];
        clamp = clamp || axis < 0;
        for (int d = 0; d < p->dim; d++)
            if (axis < 0 || axis == d) sign[d] = (int8_t)-sign[d];
    }
    return clamp;
}

/* Returns an array [p->n_all - p->n] with 1 for mirror images across clamped planes (planes at which all motion is
 * prevented) and 0 for others; NULL if no image is in a clamped plane. s: planes to which the images belong. The caller
 * frees the array with memory_free. */
static uint8_t *clamped_images(const struct bond_source *s, const struct particles *p)
{
    bool any = false;
    int8_t sign[DIM_MAX];
    if (!s->mirror_axis || p->n_all == p->n) return NULL;
    uint8_t *is = NEW("clamped.images", p->n_all - p->n, uint8_t);
    for (int64_t k = 0; k < p->n_all - p->n; k++) any |= is[k] = image_rotates(s, p, p->n + k, sign);
    if (any) return is;
    memory_free(is);
    return NULL;
}

/* Counts in c->n the intact bonds to mirror images across clamped planes (planes at which all motion is prevented) in
 * column k, the k-th bonds, of block g of eight rows of b (the bonds of eight particles). If c->entry is not NULL, also
 * stores index, both particles, inverse length and weight of each of these bonds. p: particles; is[images]: 1 for
 * images across clamped planes. */
static void column_note(struct clamped *c, struct bonds *b, const struct particles *p, const uint8_t *is, int64_t g,
                        int64_t k)
{
    for (int l = 0; l < bond_row_block_row_count(b, g); l++) {
        const struct bond bond = bond_read(b, g, k, l);
        if (bond.w == 0 || bond.nbr < p->n || !is[bond.nbr - p->n]) continue;
        if (c->entry) {
            c->entry[c->n] = bond_copy_on_write_and_return_array_index(b, g, k, l);
            c->from[c->n] = b->particle[g * LANES + l], c->to[c->n] = bond.nbr;
            c->inverse_length[c->n] = bond.inverse_length, c->w[c->n] = bond.w;
        }
        c->n++;
    }
}

/* Counts in c->n the intact bonds of b to mirror images across clamped planes (planes at which all motion is
 * prevented), and stores these bonds if c->entry is not NULL. Images have indices behind those of the particles, so
 * that one comparison excludes most columns (each with eight bonds). p: particles; is[images]: 1 for images across
 * clamped planes. */
static void bonds_note(struct clamped *c, struct bonds *b, const struct particles *p, const uint8_t *is)
{
    c->n = 0;
    for (int64_t g = 0; g < b->row_blocks; g++)
        for (int64_t k = 0; k < b->column_count[g]; k++) {
            const struct stencil *stencil = b->stencil[g];
            const int64_t first =
                stencil ? b->particle[g * LANES] + stencil->column[k].offset : b->first[b->column[g] + k];
            if (first < 0 || first + LANES > p->n) column_note(c, b, p, is, g, k);
        }
}

/* Copies n reactions to c->end (forces of bonds across clamped planes, at which all motion is prevented), sorted by
 * the particle on which they act. Lists these particles in c->particle and the range of reactions of each in c->first,
 * and counts them in c->held. Reactions on one particle remain in the order of their bonds. end[n]: unsorted reactions;
 * of[n]: particle of each reaction; particles: number of particles of the body. */
static void ends_sort(struct clamped *c, const struct clamp_end *end, const int32_t *of, int64_t n, int64_t particles)
{
    int64_t *next = NEW("clamped.next", particles + 1, int64_t);
    for (int64_t k = 0; k < n; k++) next[of[k] + 1]++;
    for (int64_t i = 0; i < particles; i++) c->held += next[i + 1] > 0;
    c->particle = NEW("clamped.particle", c->held, int32_t);
    c->first = NEW("clamped.first", c->held + 1, int64_t);
    c->held = 0;
    for (int64_t i = 0; i < particles; i++) {
        if (next[i + 1] > 0) c->first[c->held] = next[i], c->particle[c->held++] = (int32_t)i;
        next[i + 1] += next[i];
    }
    c->first[c->held] = n;
    for (int64_t k = 0; k < n; k++) c->end[next[of[k]]++] = end[k];
    memory_free(next);
}

/* Lists in c->end the reactions of bonds across clamped planes (at which all motion is prevented), sorted by the
 * particle on which they act. Such a bond leads from a particle of p to a mirror image. In state-based models the
 * particle already has its half of the bond force; the other half is one reaction, on the particle that the image
 * mirrors. In bond-based models the particle has both halves; two reactions move one half from there to the particle
 * that the image mirrors. The bonds must be in c (bonds_note). s: list of the images. */
static void bonds_clamped_ends_make(struct clamped *c, const struct particles *p, const struct bond_source *s)
{
    const int each = s->modulus ? 1 : 2;
    struct clamp_end *end = NEW("clamped.unsorted", each * c->n, struct clamp_end);
    int32_t *of = NEW("clamped.of", each * c->n, int32_t);
    for (int64_t k = 0; k < c->n; k++) {
        image_rotates(s, p, c->to[k], end[k].sign);
        end[k].bond = (int32_t)k, of[k] = (int32_t)mirror_image_source_particle(p, s->image, c->to[k]);
        if (each == 1) continue;
        end[c->n + k] = (struct clamp_end){(int32_t)k, {1, 1, 1}};
        of[c->n + k] = c->from[k];
    }
    c->end = NEW("clamped.end", each * c->n, struct clamp_end);
    ends_sort(c, end, of, each * c->n, p->n);
    memory_free(end);
    memory_free(of);
}

void clamped_bonds_list_across_clamped_planes(struct bonds *b, const struct particles *p, const struct bond_source *s)
{
    struct clamped *c = &b->clamped;
    uint8_t *is = clamped_images(s, p);
    if (!is) return;
    bonds_note(c, b, p, is);
    if (c->n > 0) {
        const int64_t room = c->n + LANES;
        c->entry = NEW("clamped.entry", c->n, int64_t);
        c->from = NEW("clamped.from", room, int32_t);
        c->to = NEW("clamped.to", room, int32_t);
        c->inverse_length = NEW("clamped.inverse_length", room, real);
        c->w = NEW("clamped.w", room, real);
        for (int d = 0; d < p->dim; d++) c->reaction[d] = NEW("clamped.reaction", room, real);
        bonds_note(c, b, p, is);
        bonds_clamped_ends_make(c, p, s);
    }
    memory_free(is);
}

void clamped_bonds_free(struct bonds *b)
{
    struct clamped *c = &b->clamped;
    memory_free(c->entry);
    memory_free(c->from);
    memory_free(c->to);
    memory_free(c->inverse_length);
    memory_free(c->w);
    for (int d = 0; d < DIM_MAX; d++) memory_free(c->reaction[d]);
    memory_free(c->particle);
    memory_free(c->first);
    memory_free(c->end);
}
