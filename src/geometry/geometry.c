/* Selects the reader for a file and checks that its content encloses a volume. */
#include "geometry/geometry.h"

#include <math.h>
#include <strings.h>

#include "base/memory.h"
#include "elements.h"
#include "geometry/exodus_file.h"

#define DOUBT_MOST 0.02 /* share of sample points that may be neither inside nor outside */
#define FARTHEST 1e30   /* largest coordinate, so that squares and triple products stay finite [m] */

/* Functions that read meshes, by the extension of the file name. */
static const struct format {
    const char *ending;
    status (*read)(struct element_mesh *, struct geometry_file *);
} formats[] = {{".stl", stl_read}, {".msh", gmsh_read}, {".inp", abaqus_read}}, exodus = {".exo", exodus_read};

/* Returns the format of the file `path` by the extension of its name, in capital or small letters (a row of a constant
 * table); NULL for an unknown extension. */
static const struct format *format_of(const char *path)
{
    const size_t length = strlen(path);
    for (size_t k = 0; k < COUNT_OF(formats); k++)
        if (length > 4 && strcasecmp(path + length - 4, formats[k].ending) == 0) return &formats[k];
    return path_has_exodus_extension(path) ? &exodus : NULL;
}

/* Returns REFUSED, with a message, if all faces of the surface in 3D lie in one plane x, y or z = const to 1e-6 of
 * their extent, as in a mesh of plane elements. path: file of the surface, for the message. */
static status check_not_plane(const struct hull *hull, const char *path)
{
    const real *low = hull->node[0].low, *high = hull->node[0].high;
    real longest = 0;
    for (int d = 0; d < hull->dim; d++) longest = real_max(longest, high[d] - low[d]);
    for (int d = 0; d < hull->dim && hull->dim == 3; d++)
        if (high[d] - low[d] <= 1e-6 * longest)
            return status_set(REFUSED,
                              "%s: its elements are plane, all at %c = %.6g m, and fill no volume; set space: plane "
                              "stress or plane strain, or use this mesh as the shape of extrude",
                              path, "xyz"[d], low[d]);
    return OK;
}

/* Returns REFUSED, with a message, if the surface has no faces or encloses no volume, has coordinates of FARTHEST or
 * more, lies in a plane, or has holes such that more than the share DOUBT_MOST of sampled positions is neither inside
 * nor outside; else OK. path: file of the surface, for messages. */
static status check_closed(const struct hull *hull, const char *path)
{
    const real *at = hull->open_at;
    if (hull->faces == 0)
        return status_set(
            REFUSED,
            "%s: pairs of its faces coincide and cancel each other, so no body is left; give the surface of a body",
            path);
    for (int d = 0; d < hull->dim; d++)
        if (!(fabs(hull->node[0].low[d]) < FARTHEST && fabs(hull->node[0].high[d]) < FARTHEST))
            return status_set(REFUSED, "%s: coordinates of up to %.3g m are too large; check the unit of the file",
                              path, real_max(fabs(hull->node[0].low[d]), fabs(hull->node[0].high[d])));
    TRY(check_not_plane(hull, path));
    const real doubt = hull->open_edges > 0 ? hull_sample_winding_number_statistics(hull).unclear : 0;
    if (doubt > DOUBT_MOST)
        return status_set(REFUSED,
                          "%s: its surface is open or turned inside out at %lld edges, one at (%.6g, %.6g, %.6g) m, so "
                          "%.0f %% of the positions in it are neither inside nor outside; close it (admesh or MeshLab "
                          "close holes and orient faces)",
                          path, (long long)hull->open_edges, at[0], at[1], at[2], 100 * doubt);
    if (hull->volume > 0) return OK;
    return status_set(REFUSED, "%s: the surface encloses no volume; give the surface of a body", path);
}

/* Reads the mesh or surface file `path` into g. dim: dimensions of the space; scale: length of the file's unit [m];
 * fine: largest distance between a curved edge and the chords that approximate it [m], NAN for the default. Returns
 * REFUSED for an invalid file or a surface that is not closed; g may then be partly filled. */
static status read_elements(struct geometry *g, const char *path, int dim, real scale, real fine)
{
    const struct format *format = format_of(path);
    struct element_mesh m = {0};
    struct geometry_file source;
    if (!format)
        return status_set(REFUSED, "%s: is not a shape file; give one that ends in .stl, .msh, .inp or .exo (.e, .g)",
                          path);
    TRY(geometry_file_read_whole(&source, path));
    status s = format->read(&m, &source);
    geometry_file_close(&source);
    if (s == OK) s = geometry_create_from_element_mesh(g, &m, path, dim, scale, fine);
    element_mesh_free(&m);
    return s == OK && g->whole.dim > 0 ? check_closed(&g->whole, path) : s;
}

status geometry_read(struct geometry *g, const char *path, int dim, real scale, real chord_tolerance)
{
    *g = (struct geometry){0};
    const status s = read_elements(g, path, dim, scale, chord_tolerance);
    if (s != OK) geometry_free(g);
    return s;
}

bool geometry_set_name_matches_after_instance_prefix(const struct geometry_set *set, const char *name)
{
    return set->own > 0 && strcasecmp(set->name + set->own, name) == 0;
}

const struct geometry_set *geometry_find_set_by_name(const struct geometry *g, const char *name)
{
    for (int k = 0; k < g->sets; k++)
        if (strcasecmp(g->set[k].name, name) == 0) return &g->set[k];
    const struct geometry_set *found = NULL;
    for (int k = 0; k < g->sets; k++)
        if (geometry_set_name_matches_after_instance_prefix(&g->set[k], name)) {
            if (found) return NULL;
            found = &g->set[k];
        }
    return found;
}

void geometry_free(struct geometry *g)
{
    hull_free(&g->whole);
    for (int k = 0; k < g->sets; k++) hull_free(&g->set[k].hull);
    memory_free(g->set);
    *g = (struct geometry){0};
}
