/* Prints the lines of `cleave check` about bodies from files: whether their surface is closed, and its volume. */
#include <math.h>

#include "base/memory.h"
#include "check_parts.h"
#include "geometry/geometry.h"
#include "scene/shape_file.h"

/* Returns the number of slits that the file of the surface h contains: free surfaces inside a mesh, at which its nodes
 * are doubled. */
static int hull_slits(const struct hull *h)
{
    struct crack *slit = NULL;
    int n = 0;
    geometry_append_mesh_slits_as_precracks(h, &slit, &n);
    for (int k = 0; k < n; k++) memory_free(slit[k].corner);
    memory_free(slit);
    return n;
}

/* Prints the names of the sets (named parts, such as element sets) of the mesh file f, at most twelve, and ends the
 * line. */
static void say_sets(const struct shape_file *f)
{
    if (f->geometry.sets > 0) printf("; sets");
    for (int k = 0; k < f->geometry.sets && k < 12; k++) printf("%s %s", k ? "," : "", f->geometry.set[k].name);
    printf("%s\n", f->geometry.sets > 12 ? ", .." : "");
}

static void say_hull(const struct shape_file *f)
{
    const struct hull *h = &f->geometry.whole;
    if (h->dim == 0) {
        printf("shape          %s: particles", printable_name(f->path[0]).text);
        say_sets(f);
        return;
    }
    printf("shape          %s: %lld %s, %lld shell%s", printable_name(f->path[0]).text, (long long)h->faces,
           f->dim == 3 ? "triangles" : "edges", (long long)h->shells, h->shells == 1 ? "" : "s");
    if (h->open_edges > 0)
        printf(", open at %lld edges, one at (%.4g, %.4g, %.4g) m, but its inside is still well defined",
               (long long)h->open_edges, h->open_at[0], h->open_at[1], h->open_at[2]);
    else
        printf(", closed");
    if (h->reversed) printf(", with inward normals, which are reversed on reading");
    if (h->dropped > 0 && f->kind == SHAPE_STL) printf(", %lld without area or given twice", (long long)h->dropped);
    const int slits = hull_slits(h);
    if (slits > 0)
        printf(", with pairs of nodes at one position along %d surface%s inside the body: %s", slits,
               slits > 1 ? "s" : "", slits > 1 ? "pre-cracks" : "a pre-crack");
    printf(", encloses %.4g m^%d", h->volume, f->dim);
    say_sets(f);
}

static void say_image(const struct scene *scene, const struct shape_file *f)
{
    const struct voxels *v = &f->voxels;
    printf("shape          %s%s: %lld x %lld", printable_name(f->path[0]).text, f->files > 1 ? " .." : "",
           (long long)v->n[0], (long long)v->n[1]);
    if (f->dim == 3) printf(" x %lld", (long long)v->n[2]);
    printf(" voxels of %.4g m", v->size[0]);
    if (scene->spacing > 1.001 * v->size[0])
        printf("; a particle covers %.3g voxels and takes the grey value at its centre",
               pow(scene->spacing / v->size[0], f->dim));
    putchar('\n');
}

void print_shape_file_volumes(const struct run *run)
{
    for (const struct shape_file *f = run->scene->shapes; f; f = f->next) {
        if (f->kind == SHAPE_IMAGE)
            say_image(run->scene, f);
        else
            say_hull(f);
    }
}
