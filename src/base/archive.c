/* Saves and restores arrays that have one element per particle, by an archive (base/archive.h). */
#include "base/archive.h"

#include "base/arrays.h"
#include "base/memory.h"

status archive_save_or_load_particle_array(struct archive *a, const char *name, void *array, int64_t element_count,
                                           size_t element_size)
{
    if (a->saving || !a->now) return a->exchange(a, name, array, (size_t)element_count * element_size);
    const int64_t bytes = a->stored_size(a, name);
    char *stored = NEW("archive.stored", bytes, char), *to = array;
    const status s = a->exchange(a, name, stored, (size_t)bytes);
    for (int64_t j = 0; s == OK && j < bytes / (int64_t)element_size; j++)
        if (a->now[j] >= 0)
            array_copy(to + (size_t)a->now[j] * element_size, stored + (size_t)j * element_size, 1,
                       (int64_t)element_size);
    memory_free(stored);
    return s;
}

void archive_renumber_restored_particle_indices(const struct archive *a, int32_t *particle_index, int64_t index_count)
{
    for (int64_t k = 0; k < index_count && !a->saving && a->now; k++) particle_index[k] = a->now[particle_index[k]];
}
