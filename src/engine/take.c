/* Transfer of particles and bonds from a run to the one that replaces it. */
#include "base/memory.h"
#include "engine_internal.h"

/* Finds the particles and mirror images of a replaced run in the new run. p, loads: particles and loads of the new run;
 * q, images: particles and loads of the replaced run. In both runs particles are in ascending order of id. Returns an
 * array [q->n_all], first for the particles, then for the mirror images of the replaced run: the index in the new run,
 * -1 if the new run lacks the particle or image. The caller frees it with memory_free. */
static int32_t *numbers_now(const struct particles *p, const struct loads *loads, const struct particles *q,
                            const struct loads *images)
{
    int32_t *now = NEW("replace.now", q->n_all, int32_t);
    int64_t i = 0, k = 0;
    for (int64_t j = 0; j < q->n; j++) {
        while (i < p->n && p->id[i] < q->id[j]) i++;
        now[j] = i < p->n && p->id[i] == q->id[j] ? (int32_t)i : -1;
    }
    for (int64_t j = 0; j < images->images; j++) {
        const struct image *was = &images->image[j];
        const int32_t source = now[was->source];
        int64_t next = k;
        while (source >= 0 && next < loads->images &&
               (loads->image[next].source != source || loads->image[next].load != was->load))
            next++;
        const bool found = source >= 0 && next < loads->images;
        now[q->n + j] = found ? (int32_t)(p->n + next) : -1;
        if (found) k = next + 1;
    }
    return now;
}

void run_transfer_particles_from_predecessor(struct run *run, struct predecessor *predecessor)
{
    predecessor->now = numbers_now(&run->part, &run->loads, &predecessor->run->part, &predecessor->run->loads);
    particles_copy_fields_by_new_index(&run->part, &predecessor->run->part, predecessor->now, run->optional);
    particles_rebuild_lists_by_kind(&run->part);
    mirror_images_copy_particle_kinds(&run->part, &run->source);
}

void run_transfer_broken_bonds_from_predecessor(struct run *run, const struct predecessor *predecessor)
{
    struct run *old = predecessor->run;
    bonds_copy_damage_to_new_particles(&run->bonds, &run->part, &run->source.limit, &old->bonds, &old->part,
                                       predecessor->now);
    state_based_update_weighted_volumes(&run->bonds, &run->part, &run->source);
    bonds_free(&old->bonds);
    particles_free(&old->part);
}
