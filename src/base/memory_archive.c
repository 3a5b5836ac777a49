/* An archive in memory. */
#include "base/memory_archive.h"

#include "base/arrays.h"
#include "base/memory.h"

static status exchange(struct archive *a, const char *name, void *data, size_t size)
{
    struct memory_archive *m = (struct memory_archive *)a;
    if (a->saving) {
        GROW("archive.entries", m->entry, m->n + 1);
        struct memory_entry *to = &m->entry[m->n++];
        *to = (struct memory_entry){memory_new_uninitialised("archive.entry", (int64_t)size, 1), size};
        array_copy(to->data, data, (int64_t)size, 1);
        return OK;
    }
    if (m->next >= m->n || m->entry[m->next].size != size)
        return status_set(FAILED,
                          "%s: the state saved in memory has another size than this run needs; this is a fault of the "
                          "program: please report it with the scene",
                          name);
    array_copy(data, m->entry[m->next++].data, (int64_t)size, 1);
    return OK;
}

static int64_t stored_size(struct archive *a, const char *name)
{
    const struct memory_archive *m = (const struct memory_archive *)a;
    (void)name;
    return m->next < m->n ? (int64_t)m->entry[m->next].size : -1;
}

void memory_archive_open_for_saving(struct memory_archive *m, enum archive_scope scope)
{
    *m = (struct memory_archive){
        .archive = {.saving = true, .exchange = exchange, .stored_size = stored_size, .scope = scope}};
}

void memory_archive_rewind_for_loading(struct memory_archive *m) { m->archive.saving = false, m->next = 0; }

void memory_archive_free(struct memory_archive *m)
{
    for (int64_t k = 0; k < m->n; k++) memory_free(m->entry[k].data);
    memory_free(m->entry);
    *m = (struct memory_archive){0};
}
