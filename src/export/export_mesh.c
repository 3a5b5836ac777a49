/* Makes the particles of a scene and sorts them as meshes of other programs list them. */
#define _GNU_SOURCE /* memmem */
#include "export_mesh.h"

#include <errno.h>
#include <stdio.h>
#include <unistd.h>

#include "base/memory.h"
#include "output/output_files.h"
#include "scene/scene_read.h"

/* Reads the scene of the request r, with its overrides, into m->scene. For methods with material points, also sets
 * mpm.fill=all, so that all particles of the bodies are created. Release m->scene with scene_free. Returns REFUSED or
 * FAILED, with a message, if the scene cannot be read. */
static status scene_make_whole(struct export_mesh *m, const struct export_request *r)
{
    struct scene_override *all = NEW("export.overrides", r->overrides + 1, struct scene_override);
    for (int k = 0; k < r->overrides; k++) all[k] = r->override[k];
    status s = scene_read(&m->scene, r->scene, all, r->overrides);
    if (s == OK && m->scene.method != METHOD_PD) {
        scene_free(&m->scene);
        all[r->overrides] = (struct scene_override){"mpm.fill", "all"};
        s = scene_read(&m->scene, r->scene, all, r->overrides + 1);
    }
    memory_free(all);
    return s;
}

/* Compares two keys a and b for qsort, each an int64_t[3] of material number, id and index of a particle: first by
 * material, then by id, in ascending order. */
static int mesh_key_order(const void *a, const void *b)
{
    const int64_t *p = a, *q = b;
    return p[0] != q[0] ? (p[0] > q[0]) - (p[0] < q[0]) : (p[1] > q[1]) - (p[1] < q[1]);
}

status export_mesh_create_from_input_file(struct export_mesh *m, const struct export_request *r)
{
    *m = (struct export_mesh){.e = NEW("export.engine", 1, struct run)};
    TRY(scene_make_whole(m, r));
    TRY(run_set_up_from_scene(m->e, &m->scene, NULL));
    const struct particles *p = &m->e->part;
    int64_t(*key)[3] = memory_new("export.order", p->n, sizeof *key);
    for (int64_t i = 0; i < p->n; i++)
        key[i][0] = m->scene.material_number[p->material[i]], key[i][1] = p->id[i], key[i][2] = i;
    array_sort(key, p->n, sizeof *key, mesh_key_order);
    m->n = p->n;
    m->particle = NEW("export.particles", p->n, int32_t), m->place = NEW("export.places", p->n, int32_t);
    for (int64_t k = 0; k < p->n; k++) {
        m->particle[k] = (int32_t)key[k][2], m->place[key[k][2]] = (int32_t)k;
        m->first[key[k][0] + 1]++;
    }
    m->materials = m->scene.materials + m->scene.unused_materials;
    for (int material = 0; material < m->materials; material++) m->first[material + 1] += m->first[material];
    memory_free(key);
    return OK;
}

void export_mesh_free(struct export_mesh *m)
{
    if (m->e) run_free_memory(m->e);
    scene_free(&m->scene);
    memory_free(m->e);
    memory_free(m->particle);
    memory_free(m->place);
    *m = (struct export_mesh){0};
}

/* ---- sets -------------------------------------------------------------------------------------------------------- */

/* Returns the name of the node set of load number load_number, from 0, of m: the name of its boundary, or nodelist_N
 * with N = load_number + 1 if the boundary has no name or an earlier load has the same one. */
struct set_name export_node_set_name_of_load(const struct export_mesh *m, int load_number)
{
    const struct load *load = m->e->loads.load;
    const char *name = load[load_number].boundary->name;
    struct set_name set;
    bool taken = !name[0];
    for (int j = 0; j < load_number; j++) taken = taken || strcmp(load[j].boundary->name, name) == 0;
    if (taken)
        snprintf(set.text, sizeof set.text, "nodelist_%d", load_number + 1);
    else
        snprintf(set.text, sizeof set.text, "%s", name);
    return set;
}

/* Compares the numbers (int32_t) *a and *b for qsort, in ascending order. */
static int int32_order(const void *a, const void *b)
{
    const int32_t *p = a, *q = b;
    return (*p > *q) - (*p < *q);
}

int32_t *export_node_set_particles_of_load(const struct export_mesh *m, int load_number)
{
    const struct load *load = &m->e->loads.load[load_number];
    int32_t *node = NEW("export.set", load->n, int32_t);
    for (int64_t i = 0; i < load->n; i++) node[i] = m->place[load->particle[i]] + 1;
    array_sort(node, load->n, sizeof *node, int32_order);
    return node;
}

/* ---- files ------------------------------------------------------------------------------------------------------- */

status export_check_file_may_be_written(const char *path, const char *format_signature, bool overwrite)
{
    char begin[1024] = "";
    size_t n = 0;
    if (path_is_folder(path)) return status_set(REFUSED, "%s is a folder; give the name of a file: -o FILE", path);
    if (!path_exists(path)) return folder_create_parents_of_file(path);
    FILE *file = fopen(path, "rb");
    if (file) n = fread(begin, 1, sizeof begin, file), fclose(file);
    if (!memmem(begin, n, format_signature, strlen(format_signature)))
        return status_set(REFUSED, "%s exists and is not an export of Cleave; choose another -o FILE", path);
    if (!overwrite) return status_set(REFUSED, "%s exists; choose another -o, or replace it with --overwrite", path);
    return file_check_replaceable(path);
}

status export_write_file_and_rename(const char *path, status (*write_contents)(FILE *to, void *context), void *context)
{
    const struct path aside = file_register_temporary_and_return_path(path);
    unlink(aside.text); /* a link of this name is not followed */
    FILE *to = fopen(aside.text, "wx");
    if (!to) return file_report_write_failure(path, errno);
    status s = write_contents(to, context);
    const bool whole = !ferror(to);
    const bool closed = fclose(to) == 0;
    if (s == OK && !(whole && closed)) s = file_report_write_failure(path, errno);
    if (s == OK) s = file_append_and_sync(path, NULL, 0);
    if (s == OK) s = file_replace_by_temporary(path);
    if (s != OK) file_discard_temporary(path);
    return s;
}
