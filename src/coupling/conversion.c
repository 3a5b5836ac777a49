/* Conversion of material points to peridynamic particles (Zeng et al. 2022, eqs. 28, 31, 32). */
#include "bonds/sites.h"
#include "coupling/conversion.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "partial_parts.h"

/* A growing list of particle indices. */
struct index_list {
    int32_t *at;
    int64_t n;
};

static void list_add(struct index_list *l, int64_t i)
{
    GROW("convert.list", l->at, l->n + 1);
    l->at[l->n++] = (int32_t)i;
}

/* ---- before the first step --------------------------------------------------------------------------------------- */

/* Returns true if a pre-crack cuts a bond between particle i of p and a particle of the same body in `near`. s: has the
 * pre-cracks; near: neighbours of particle i. */
static bool loses_bond(const struct bond_source *s, const struct particles *p, int64_t i,
                       const struct neighbour_list *near)
{
    for (int k = 0; k < near->n; k++)
        if (p->body[near->at[k]] == p->body[i] && precracks_cut_bond_between(s->crack, s->cracks, p, i, near->at[k]))
            return true;
    return false;
}

void convert_particles_at_precracks_to_peridynamic(struct particles *p, const struct bond_source *source,
                                                   const struct region *region)
{
#pragma omp parallel
    {
        struct neighbour_list near = {0};
#pragma omp for schedule(static)
        for (int64_t i = 0; i < p->n; i++) {
            real X[DIM_MAX];
            particle_reference_position(p, i, X);
            if (region && region_contains(region, X, p->dim, ON_SURFACE * source->family.spacing)) p->kind[i] = KIND_PD;
            if (!particle_is_near_precrack(source, p, i)) continue;
            particle_find_family_members(&near, source, NULL, p, i);
            if (loses_bond(source, p, i, &near)) p->kind[i] = KIND_PD;
        }
        memory_free(near.at);
    }
    mirror_images_copy_particle_kinds(p, source);
    particles_rebuild_lists_by_kind(p);
}

/* ---- one pass ---------------------------------------------------------------------------------------------------- */

/* Conversion flags of particles, which are set during one step and cleared at the end of a conversion
 * (convert_marked). */
#define MARKS (FLAG_LOST_BOND | FLAG_CRACKED | FLAG_STRESSED | FLAG_NEAR)

/* Returns true if particle i of p is a material point whose flags require that it becomes peridynamic: it has lost a
 * bond, is near another body or, if the rule includes conversion by stress, has exceeded the stress at which points
 * convert. */
static bool triggers(const struct conversion_rule *rule, const struct particles *p, int64_t i)
{
    /* whatever the criteria, material points convert that lost a bond, as damage is stored in bonds alone, and that are
     * near another body, as contact needs particles */
    unsigned wanted = FLAG_LOST_BOND | FLAG_NEAR | (rule->criteria & CONVERT_ON_STRESS ? FLAG_STRESSED : 0u);
    return p->kind[i] == KIND_MPM && (p->flag[i] & wanted);
}

/* Returns true if particle i of p has a bond in b, intact or broken, to a material point. */
static bool conversion_meets_points(const struct bonds *b, const struct particles *p, int64_t i)
{
    for (struct bond_iterator it = bond_iterator_of_row(b, b->row_of[i]); bond_iterator_advance(&it);)
        if (p->kind[it.bond.nbr] == KIND_MPM) return true;
    return false;
}

/* Appends to l the peridynamic particles of p that have lost a bond of b in this step and still have bonds to material
 * points. Appends none unless the model is state-based and s->local is set, i.e. the model normalises its forces by the
 * intact bonds of the neighbourhood. The remaining bonds are then stiffer than before, so that the partial stress
 * (stress that bonds replace) of the material points around must be recomputed. */
static void list_stiffened(struct index_list *l, const struct bond_source *s, const struct particles *p,
                           const struct bonds *b)
{
    if (!s->modulus || !s->local) return;
    for (int64_t first = 0; first < p->n; first += LANES) {
        if (!(eight_bytes_as_word(p->flag + first) & EIGHT_TIMES(FLAG_LOST_BOND))) continue;
        for (int64_t i = first; i < first + LANES && i < p->n; i++)
            if (p->kind[i] == KIND_PD && p->flag[i] & FLAG_LOST_BOND && conversion_meets_points(b, p, i))
                list_add(l, i);
    }
}

/* Makes material point i of p peridynamic and appends i to `changed`. Does nothing if i is peridynamic already. */
static void become_peridynamic(struct particles *p, struct index_list *changed, int64_t i)
{
    if (p->kind[i] != KIND_MPM) return;
    p->kind[i] = KIND_PD;
    if (p->low_since) p->low_since[i] = INFINITY;
    list_add(changed, i);
}

/* Converts the material points of p whose flags require it to peridynamic particles. If rule->block is set, also
 * converts all material points of the same body within the cutoff (largest bond length) of these. Appends the converted
 * points to `changed`, and clears the conversion flags of all particles. source: data of bonds; map: map from lattice
 * sites to particles, or NULL to search for neighbours; t: present time [s]. At the first conversion, stores t and the
 * position of the first converted point in *c. */
static void convert_marked(struct conversion *c, const struct conversion_rule *rule, struct particles *p,
                           const struct bond_source *source, const struct lattice_site_map *map,
                           struct index_list *changed, real t)
{
    struct index_list triggered = {0};
    struct neighbour_list near = {0};
    for (int64_t first = 0; first < p->n; first += LANES) {
        if (!(eight_bytes_as_word(p->flag + first) & EIGHT_TIMES(MARKS))) continue;
        for (int64_t i = first; i < first + LANES && i < p->n; i++) {
            if (triggers(rule, p, i)) list_add(&triggered, i);
            p->flag[i] &= (uint8_t)~MARKS;
        }
    }
    for (int64_t k = 0; k < triggered.n; k++) {
        int64_t i = triggered.at[k];
        if (isnan(c->first_time)) {
            c->first_time = t;
            for (int d = 0; d < p->dim; d++) c->first_place[d] = p->X[d][i];
        }
        become_peridynamic(p, changed, i);
        if (!rule->block) continue;
        particle_find_family_members(&near, source, map, p, i);
        for (int m = 0; m < near.n; m++) {
            const int64_t j = mirror_image_source_particle(p, source->image, near.at[m]);
            if (p->body[j] == p->body[i]) become_peridynamic(p, changed, j);
        }
    }
    memory_free(triggered.at);
    memory_free(near.at);
}

/* Appends particle i of p to the list l and sets its flag FLAG_LISTED. Does nothing if the flag is set already. */
static void list_once(struct index_list *l, struct particles *p, int64_t i)
{
    if (p->flag[i] & FLAG_LISTED) return;
    p->flag[i] |= FLAG_LISTED;
    list_add(l, i);
}

/* Updates positions and velocities of the converted particles `changed` (indices in p) and of all particles within the
 * cutoff (largest bond length) of these. Must be called before bonds between them are made. Each particle is updated
 * once, so that threads write different particles. sync: function that updates listed particles, or NULL if none needs
 * it; source: cutoff and mirror images; map: map from lattice sites to particles, or NULL to search for neighbours. */
static void sync_near(const struct conversion_sync *sync, struct particles *p, const struct bond_source *source,
                      const struct lattice_site_map *map, const struct index_list *changed)
{
    struct index_list exposed = {0};
    struct neighbour_list near = {0};
    if (!sync) return;
    for (int64_t k = 0; k < changed->n; k++) {
        particle_find_family_members(&near, source, map, p, changed->at[k]);
        list_once(&exposed, p, changed->at[k]);
        for (int m = 0; m < near.n; m++)
            list_once(&exposed, p, mirror_image_source_particle(p, source->image, near.at[m]));
    }
    for (int64_t k = 0; k < exposed.n; k++) p->flag[exposed.at[k]] &= (uint8_t)~FLAG_LISTED;
    if (exposed.n > 0) sync->sync(sync->context, exposed.at, exposed.n);
    memory_free(near.at);
    memory_free(exposed.at);
}

int64_t convert_flagged_points_to_peridynamic(struct conversion *c, const struct conversion_rule *rule,
                                              struct particles *p, struct bonds *b, const struct bond_source *source,
                                              struct partial_stress *partial, const struct conversion_sync *sync,
                                              real t)
{
    if (!particles_any_is_flagged_for_conversion(p)) return 0;
    struct index_list changed = {0}, touched = {0};
    list_stiffened(&touched, source, p, b);
    convert_marked(c, rule, p, source, b->site_map, &changed, t);
    if (changed.n > 0) {
        sync_near(sync, p, source, b->site_map, &changed);
        bonds_rebuild_after_particle_kind_change(b, p, source);
        if (sync && sync->converted) sync->converted(sync->context, changed.at, changed.n);
    }
    for (int64_t k = 0; k < changed.n; k++) list_add(&touched, changed.at[k]);
    if (partial && touched.n > 0) partial_stress_compute_from_bonds(partial, p, b, source, touched.at, touched.n);
    if (changed.n > 0) {
        c->converted += changed.n;
        c->events++;
        if (b->n > c->peak_bonds) c->peak_bonds = b->n;
        if (p->n_of[KIND_PD] > c->peak) c->peak = p->n_of[KIND_PD];
    }
    int64_t converted = changed.n;
    memory_free(changed.at);
    memory_free(touched.at);
    return converted;
}

status conversion_save_or_load(struct conversion *c, struct archive *a)
{
    ARCHIVE_VALUE(a, "conversion", *c);
    return OK;
}
