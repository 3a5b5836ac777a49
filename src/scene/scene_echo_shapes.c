/* Writes solids from files with absolute paths, so that the echo runs from any folder, and with the hash of the
 * contents; the echo is refused if the file has changed. */
#include <inttypes.h>
#include <stdlib.h>

#include "scene/shape_file.h"
#include "scene_echo.h"

/* Returns the file of the scene s from which the surface or the voxels of a solid were read, or NULL if they are from
 * no file. *set: receives the name of the part of a mesh that forms the solid, or NULL if the whole mesh does. */
static const struct shape_file *shape_of(const struct scene *s, const struct solid *solid, const char **set)
{
    *set = NULL;
    for (const struct shape_file *f = s->shapes; f; f = f->next) {
        if (solid->kind == SOLID_VOXELS && solid->voxels->of == &f->voxels) return f;
        if (solid->hull && solid->hull == &f->geometry.whole) return f;
        for (int k = 0; k < f->geometry.sets && solid->hull; k++)
            if (solid->hull == &f->geometry.set[k].hull) {
                *set = f->geometry.set[k].name;
                return f;
            }
    }
    return NULL;
}

static void write_paths(struct yaml_writer *w, const struct shape_file *f)
{
    fputs(f->files > 1 ? "file: [" : "file: ", w->out);
    for (int k = 0; k < f->files; k++) {
        char *whole = realpath(f->path[k], NULL);
        if (k > 0) fputs(", ", w->out);
        yaml_write_quoted_text(w, whole ? whole : f->path[k]);
        free(whole);
    }
    fprintf(w->out, "%s, contents: \"%016" PRIx64 "\"", f->files > 1 ? "]" : "", f->contents);
}

static void write_image(struct yaml_writer *w, const struct shape_file *f, const struct voxel_solid *voxels)
{
    fputs(", pixel: ", w->out);
    yaml_write_real(w, f->size[0]);
    if (f->dim == 3) {
        fputs(", slice: ", w->out);
        yaml_write_real(w, f->size[2]);
    }
    fputs(", origin: ", w->out);
    yaml_write_number_list(w, f->from, f->dim);
    fputs(", values: [", w->out);
    for (int k = 0; k < voxels->ranges; k++)
        fprintf(w->out, "%s\"%d-%d\"", k ? ", " : "", voxels->range[k].low, voxels->range[k].high);
    fputc(']', w->out);
}

void yaml_write_solid_from_file(struct yaml_writer *w, const struct solid *solid)
{
    static const char *const words[] = {[SHAPE_STL] = "stl", [SHAPE_MESH] = "mesh", [SHAPE_IMAGE] = "image"};
    const char *set;
    const struct shape_file *f = shape_of(w->scene, solid, &set);
    if (!f) return;
    fprintf(w->out, "%s: {", words[f->kind]);
    write_paths(w, f);
    if (f->kind == SHAPE_IMAGE)
        write_image(w, f, solid->voxels);
    else {
        fputs(", scale: ", w->out);
        yaml_write_real(w, f->scale);
    }
    if (set) {
        fputs(", set: ", w->out);
        yaml_write_quoted_text(w, set);
    }
    if (solid->kind == SOLID_HULL && solid->hull->open) {
        fputs(", within: ", w->out);
        yaml_write_real(w, solid->radius);
    }
    fputc('}', w->out);
}
