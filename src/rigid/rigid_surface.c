/* Computes surfaces of rigid bodies by dual contouring (Ju et al. 2002) on a grid, and writes them to VTK files. Each
 * cell that the surface crosses gets the point nearest to the tangential planes at the crossings of its edges; each
 * edge that the surface crosses gets a face between the cells around it. */
#include "rigid/rigid_surface.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arrays.h"
#include "base/memory.h"
#include "base/memory_stream.h"
#include "output/output_files.h"
#include "rigid/rigid_part.h"

/* Distance by which the shown part of an unbounded rigid body extends beyond the particles, over the longest edge of
 * the bounding box of the particles [1]. */
#define RIGID_BESIDE 0.08

/* Sizes of the grid on which a surface is computed. CELLS_PLANE, CELLS_SPACE: cells along the longest edge of the box
 * in 2D and 3D; THICKNESS_CELLS: least number along its shortest edge; NODES_MOST: largest number of nodes, which takes
 * precedence. */
enum { CELLS_PLANE = 200, CELLS_SPACE = 24, THICKNESS_CELLS = 6, NODES_MOST = 200000 };
/* CELL_EDGES: number of edges of a cell in 3D. CROSSING_STEPS: largest number of steps of the search for the crossing
 * of the surface with an edge. CROSSING_PRECISION: level set, in cells, at which this search ends. FIT_STEPS: steps of
 * the fit of the surface point of a cell. */
enum { CELL_EDGES = 12, CROSSING_STEPS = 30, FIT_STEPS = 60 };
#define CROSSING_PRECISION 1e-9

/* Crossing of the surface with an edge of the grid. share: distance from the lower node of the edge [cells]; normal:
 * normal of the surface at the crossing. */
struct crossing {
    real share, normal[DIM_MAX];
};

/* Crossing on an edge of one cell. at: position from the lowest node of the cell [cells]; normal: borrowed. */
struct cell_crossing {
    real at[DIM_MAX];
    const real *normal;
};

/* Grid over a region, one cell larger than it on all sides, and the values of its level set at the nodes. */
struct net {
    int dim;
    int64_t count[DIM_MAX], nodes; /* number of nodes along each axis; in all */
    real from[DIM_MAX], step;      /* position of node 0; distance of nodes [m] */
    real *value;                   /* [nodes] level set, negative inside [m] */
    int32_t *point;                /* [nodes] index of the point of the cell above a node; -1: none */
    struct crossing *crossing;     /* [nodes][dim] crossing on the edge along each axis from a node; 0: none */
    const struct region *shape;    /* borrowed */
    const real *low, *high;        /* box to which the shape is cut [m]; borrowed */
};

/* Returns the level set [m] of the region of g at X[dim] [m], cut to the box of g: negative inside both, 0 on the
 * surface. */
static real net_level_set(const struct net *g, const real *X)
{
    real value = region_level_set_value(g->shape, X, g->dim);
    for (int d = 0; d < g->dim; d++) value = real_max(value, real_max(g->low[d] - X[d], X[d] - g->high[d]));
    return value;
}

/* Returns the difference between the indices of neighbouring nodes along axis d (0 .. 2) in the arrays of g. */
static int64_t stride(const struct net *g, int d)
{
    return d == 0 ? 1 : d == 1 ? g->count[0] : g->count[0] * g->count[1];
}

/* Computes the position X[dim] of node k of the grid g [m]. */
static void node_position(const struct net *g, int64_t k, real *X)
{
    for (int d = 0; d < g->dim; k /= g->count[d], d++) X[d] = g->from[d] + (real)(k % g->count[d]) * g->step;
}

/* Makes a grid of nodes over the box low[dim] .. high[dim] [m], and computes the level set of the region `shape`, cut
 * to this box, at its nodes. The edge of a cell is chosen such that the length of the box along its longest or, for
 * thin boxes, its shortest edge is a whole number of cells plus half a cell (unless there would be more than NODES_MOST
 * nodes). This keeps nodes off the faces of the box, where round-off would decide on which side they are. The caller
 * frees g->value, g->point and g->crossing. */
static void net_make(struct net *g, const struct region *shape, int dim, const real *low, const real *high)
{
    real thinnest = INFINITY, longest = 0, nodes;
    *g = (struct net){.dim = dim, .count = {1, 1, 1}, .shape = shape, .low = low, .high = high};
    for (int d = 0; d < dim; d++) {
        thinnest = real_min(thinnest, high[d] - low[d]);
        longest = real_max(longest, high[d] - low[d]);
    }
    g->step = real_min(longest / (0.5 + (dim == 2 ? CELLS_PLANE : CELLS_SPACE)), thinnest / (0.5 + THICKNESS_CELLS));
    for (;; g->step *= 1.2) {
        nodes = 1;
        for (int d = 0; d < dim; d++) nodes *= ceil((high[d] - low[d]) / g->step) + 3;
        if (nodes <= NODES_MOST) break;
    }
    g->nodes = 1;
    for (int d = 0; d < dim; d++) {
        g->count[d] = (int64_t)ceil((high[d] - low[d]) / g->step) + 3;
        g->from[d] = 0.5 * (low[d] + high[d]) - 0.5 * (real)(g->count[d] - 1) * g->step;
        g->nodes *= g->count[d];
    }
    g->value = NEW("rigid.value", g->nodes, real);
    g->point = NEW("rigid.point", g->nodes, int32_t);
    g->crossing = NEW("rigid.crossing", g->nodes * dim, struct crossing);
    for (int64_t k = 0; k < g->nodes; k++) {
        real X[DIM_MAX];
        node_position(g, k, X);
        g->value[k] = net_level_set(g, X);
    }
}

/* Finds where the surface crosses the edge of the grid g that begins at node k and extends along axis d, by false
 * position in turn with bisection, and stores the crossing and the normal there in g->crossing. The level set must
 * change its sign along the edge. */
static void crossing_find(struct net *g, int64_t k, int d)
{
    const real end = g->value[k + stride(g, d)], start = g->value[k], h = 1e-4 * g->step;
    real X[DIM_MAX] = {0}, from = 0, to = g->step, before = start, behind = end, at = 0, value = start, length = 0;
    struct crossing *found = &g->crossing[k * g->dim + d];
    node_position(g, k, X);
    const real corner = X[d];
    for (int n = 0; n < CROSSING_STEPS && fabs(value) > CROSSING_PRECISION * g->step; n++) {
        at = n % 3 == 2 ? 0.5 * (from + to) : from + (to - from) * before / (before - behind);
        X[d] = corner + at;
        value = net_level_set(g, X);
        if ((value < 0) == (start < 0))
            from = at, before = value;
        else
            to = at, behind = value;
    }
    for (int e = 0; e < g->dim; e++) {
        const real middle = X[e];
        X[e] = middle + h;
        found->normal[e] = net_level_set(g, X);
        X[e] = middle - h;
        found->normal[e] -= net_level_set(g, X);
        X[e] = middle;
        length += square(found->normal[e]);
    }
    for (int e = 0; e < g->dim; e++) found->normal[e] = length > 0 ? found->normal[e] / sqrt(length) : 0;
    found->share = at / g->step;
}

/* Lists in c[CELL_EDGES] the crossings of the surface with the edges of the cell of grid g above node k, at positions
 * relative to the node in cells. Returns their number. */
static int cell_crossings_list(const struct net *g, int64_t k, struct cell_crossing c[CELL_EDGES])
{
    int n = 0;
    for (int bits = 0; bits < 1 << g->dim; bits++)
        for (int d = 0; d < g->dim; d++) {
            int64_t a = k;
            for (int e = 0; e < g->dim; e++) a += (bits >> e & 1) * stride(g, e);
            if ((bits >> d & 1) || (g->value[a] < 0) == (g->value[a + stride(g, d)] < 0)) continue;
            for (int e = 0; e < g->dim; e++)
                c[n].at[e] = e == d ? g->crossing[a * g->dim + d].share : (real)(bits >> e & 1);
            c[n++].normal = g->crossing[a * g->dim + d].normal;
        }
    return n;
}

/* Finds the point of a grid cell with the least sum of squared distances from the tangential planes of the surface at
 * its crossings c[n] with the edges of the cell. It is on an edge or corner of the body if the cell contains one.
 * Starts gradient descent at the mean of the crossings, which determines the position in directions along which the
 * surface is flat. Stores the point in at[dim], in cells from the lowest node of the cell. */
static void cell_point_fit(const struct cell_crossing *c, int n, int dim, real *at)
{
    for (int e = 0; e < dim; e++) {
        at[e] = 0;
        for (int k = 0; k < n; k++) at[e] += c[k].at[e] / n;
    }
    for (int step = 0; step < FIT_STEPS; step++) {
        real move[DIM_MAX] = {0};
        for (int k = 0; k < n; k++) {
            real off = 0;
            for (int e = 0; e < dim; e++) off += c[k].normal[e] * (c[k].at[e] - at[e]);
            for (int e = 0; e < dim; e++) move[e] += off * c[k].normal[e] / n;
        }
        for (int e = 0; e < dim; e++) at[e] = real_min(real_max(at[e] + move[e], 0), 1);
    }
}

/* Creates the points s->X of the surface s, one for each cell of grid g that the surface crosses. Stores the index of
 * the point in g->point. */
static void surface_points_make(struct rigid_surface *s, struct net *g)
{
    for (int64_t k = 0; k < g->nodes; k++) {
        struct cell_crossing c[CELL_EDGES];
        real corner[DIM_MAX] = {0}, at[DIM_MAX];
        bool last = false;
        int64_t rest = k;
        for (int d = 0; d < g->dim; rest /= g->count[d], d++) last |= rest % g->count[d] == g->count[d] - 1;
        const int crossings = last ? 0 : cell_crossings_list(g, k, c);
        g->point[k] = -1;
        if (crossings == 0) continue;
        cell_point_fit(c, crossings, g->dim, at);
        node_position(g, k, corner);
        GROW("rigid.X", s->X, (s->points + 1) * DIM_MAX);
        for (int d = 0; d < DIM_MAX; d++) s->X[s->points * DIM_MAX + d] = d < g->dim ? corner[d] + at[d] * g->step : 0;
        g->point[k] = (int32_t)s->points++;
    }
}

/* Makes a face of the surface s for each edge of grid g that the surface crosses, between the points of the cells
 * around this edge. An edge at the rim of the grid is never crossed. */
static void surface_faces_make(struct rigid_surface *s, const struct net *g)
{
    s->corners = g->dim == 2 ? 2 : 4;
    for (int64_t k = 0; k < g->nodes; k++)
        for (int d = 0; d < g->dim; d++) {
            const int64_t next = k + stride(g, d);
            if (next >= g->nodes || (g->value[k] < 0) == (g->value[next] < 0)) continue;
            const int64_t a = stride(g, (d + 1) % g->dim), b = g->dim == 2 ? 0 : stride(g, (d + 2) % 3);
            const int64_t cell[4] = {k, k - a, k - a - b, k - b};
            const bool outward = (g->value[k] < 0) == (g->dim == 3 || d == 1); /* right-handed about the normal */
            GROW("rigid.corner", s->corner, (s->faces + 1) * s->corners);
            for (int c = 0; c < s->corners; c++)
                s->corner[s->faces * s->corners + c] = g->point[cell[outward ? c : s->corners - 1 - c]];
            s->faces++;
        }
}

void rigid_surface_approximate_by_polygons(struct rigid_surface *s, const struct region *shape, int dim,
                                           const real *low, const real *high)
{
    struct net g;
    *s = (struct rigid_surface){0};
    net_make(&g, shape, dim, low, high);
    for (int64_t k = 0; k < g.nodes; k++)
        for (int d = 0; d < dim; d++)
            if (k + stride(&g, d) < g.nodes && (g.value[k] < 0) != (g.value[k + stride(&g, d)] < 0))
                crossing_find(&g, k, d);
    surface_points_make(s, &g);
    surface_faces_make(s, &g);
    memory_free(g.value), memory_free(g.point), memory_free(g.crossing);
}

void rigid_surface_free(struct rigid_surface *s)
{
    memory_free(s->X), memory_free(s->corner);
    *s = (struct rigid_surface){0};
}

/* ---- files ------------------------------------------------------------------------------------------------------- */

/* Finds the point of the box low[dim] .. high[dim] [m] that is nearest to the region `shape`. Candidates are the
 * corners of the box, its centre, and the centres of its edges and faces. Stores the point in X[dim] [m] and returns
 * the level set of the region there [m]. */
static real box_point_nearest(const struct region *shape, int dim, const real *low, const real *high, real *X)
{
    real least = INFINITY;
    for (int k = 0; k < (dim == 2 ? 9 : 27); k++) {
        real at[DIM_MAX];
        int rest = k;
        for (int d = 0; d < dim; d++, rest /= 3) at[d] = low[d] + 0.5 * (rest % 3) * (high[d] - low[d]);
        const real value = region_level_set_value(shape, at, dim);
        if (value >= least) continue;
        least = value;
        array_copy(X, at, dim, sizeof *X);
    }
    return least;
}

/* Extends the box low[dim] .. high[dim] [m] if the region `shape` lies outside it, so that the box contains the nearest
 * part of the region to a depth of about four grid cells. The extension begins at the point of the box that is nearest
 * to the region, and is along the gradient of the level set. longest: longest edge of the box [m]. */
static void box_extend_to_region(const struct region *shape, int dim, real *low, real *high, real longest)
{
    real X[DIM_MAX] = {0}, gradient[DIM_MAX];
    const real least = box_point_nearest(shape, dim, low, high, X), small = 1e-4 * longest;
    const real layer = 4.0 / CELLS_SPACE * (least + longest);
    if (!(least > 0) || !isfinite(least)) return;
    for (int d = 0; d < dim; d++) {
        real ahead[DIM_MAX], back[DIM_MAX];
        array_copy(ahead, X, dim, sizeof *X), array_copy(back, X, dim, sizeof *X);
        ahead[d] += small, back[d] -= small;
        gradient[d] =
            (region_level_set_value(shape, ahead, dim) - region_level_set_value(shape, back, dim)) / (2 * small);
    }
    for (int d = 0; d < dim; d++) {
        const real reached = X[d] - (least + layer) * gradient[d];
        low[d] = real_min(low[d], reached), high[d] = real_max(high[d], reached);
    }
}

bool rigid_compute_plotting_box(const struct region *shape, int dim, real *low, real *high)
{
    real from[DIM_MAX], to[DIM_MAX], longest = 0;
    const bool bounded = region_compute_bounding_box_if_finite(shape, dim, from, to);
    for (int d = 0; d < dim; d++) longest = real_max(longest, high[d] - low[d]);
    for (int d = 0; d < dim; d++) {
        low[d] = bounded ? from[d] : low[d] - RIGID_BESIDE * longest;
        high[d] = bounded ? to[d] : high[d] + RIGID_BESIDE * longest;
    }
    if (!bounded) box_extend_to_region(shape, dim, low, high, longest);
    return bounded;
}

/* Makes the surfaces of all rigid bodies in rigid->surface on the first call; later calls do nothing.
 * rigid_surface_free releases each. Unbounded bodies are cut to a box around the particles `part`. */
static void rigid_surfaces_make(struct rigid_set *rigid, const struct particles *part)
{
    if (rigid->surface) return;
    rigid->surface = NEW("rigid.surface", rigid->n, struct rigid_surface);
    for (int b = 0; b < rigid->n; b++) {
        real low[DIM_MAX], high[DIM_MAX];
        for (int d = 0; d < rigid->dim; d++) particles_coordinate_range(part, part->n, d, &low[d], &high[d]);
        (void)rigid_compute_plotting_box(rigid->body[b].shape, rigid->dim, low, high);
        rigid_surface_approximate_by_polygons(&rigid->surface[b], rigid->body[b].shape, rigid->dim, low, high);
    }
}

/* Writes to `to` the opening tag of a VTK data array with the given type, name and number of components (`columns`). */
static void print_array(FILE *to, const char *type, const char *name, int columns)
{
    fprintf(to, "<DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%d\" format=\"ascii\">\n", type, name,
            columns);
}

/* Writes to `to` a VTK data array with centre, present position and rotation matrix of each rigid body, which
 * rigids_read_placements_of_frame reads. */
static void print_motion(FILE *to, const struct rigid_set *rigid)
{
    fprintf(to, "<DataArray type=\"Float64\" Name=\"motion\" NumberOfTuples=\"%d\" format=\"ascii\">\n", 15 * rigid->n);
    for (int b = 0; b < rigid->n; b++) {
        const struct rigid_body *r = &rigid->body[b];
        for (int d = 0; d < DIM_MAX; d++) fprintf(to, "%.17g ", d < rigid->dim ? r->centre[d] : 0);
        for (int d = 0; d < DIM_MAX; d++) fprintf(to, "%.17g ", d < rigid->dim ? r->x[d] : 0);
        for (int k = 0; k < 9; k++) fprintf(to, "%.17g%c", r->turn[k / 3][k % 3], k < 8 ? ' ' : '\n');
    }
    fputs("</DataArray>\n", to);
}

/* Writes to `to` the present positions of the surface points of all rigid bodies as the VTK element Points. */
static void print_points(FILE *to, const struct rigid_set *rigid)
{
    fputs("<Points>\n", to);
    print_array(to, "Float32", "Points", 3);
    for (int b = 0; b < rigid->n; b++)
        for (int64_t k = 0; k < rigid->surface[b].points; k++) {
            real x[DIM_MAX] = {0};
            rigid_compute_current_position_of_point(&rigid->body[b], &rigid->surface[b].X[k * DIM_MAX], x);
            fprintf(to, "%.7g %.7g %.7g\n", x[0], x[1], x[2]);
        }
    fputs("</DataArray>\n</Points>\n", to);
}

/* Writes to `to` the faces of all rigid bodies as VTK lines in the plane, as polygons in space, with the number of the
 * body of each face. */
static void print_faces(FILE *to, const struct rigid_set *rigid)
{
    const char *kind = rigid->dim == 2 ? "Lines" : "Polys";
    int64_t first = 0, end = 0;
    fprintf(to, "<%s>\n", kind);
    print_array(to, "Int32", "connectivity", 1);
    for (int b = 0; b < rigid->n; first += rigid->surface[b].points, b++)
        for (int64_t k = 0; k < rigid->surface[b].faces * rigid->surface[b].corners; k++)
            fprintf(to, "%lld%c", (long long)first + rigid->surface[b].corner[k],
                    (k + 1) % rigid->surface[b].corners ? ' ' : '\n');
    fputs("</DataArray>\n", to);
    print_array(to, "Int32", "offsets", 1);
    for (int b = 0; b < rigid->n; b++)
        for (int64_t k = 0; k < rigid->surface[b].faces; k++)
            fprintf(to, "%lld\n", (long long)(end += rigid->surface[b].corners));
    fprintf(to, "</DataArray>\n</%s>\n<CellData>\n", kind);
    print_array(to, "Int32", "rigid_body", 1);
    for (int b = 0; b < rigid->n; b++)
        for (int64_t k = 0; k < rigid->surface[b].faces; k++) fprintf(to, "%d\n", b);
    fputs("</DataArray>\n</CellData>\n", to);
}

/* Prints to `to` a VTK PolyData file with the surfaces of all rigid bodies at the time of `frame`. */
static void print_file(FILE *to, const struct rigid_set *rigid, const struct frame_entry *frame)
{
    int64_t points = 0, faces = 0;
    for (int b = 0; b < rigid->n; b++) points += rigid->surface[b].points, faces += rigid->surface[b].faces;
    fprintf(to,
            RIGID_FILE_BEGIN "<PolyData>\n<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" "
                             "NumberOfTuples=\"1\" format=\"ascii\">\n%.17g\n</DataArray>\n",
            frame->time);
    print_motion(to, rigid);
    fprintf(to, "</FieldData>\n<Piece NumberOfPoints=\"%lld\" NumberOf%s=\"%lld\">\n", (long long)points,
            rigid->dim == 2 ? "Lines" : "Polys", (long long)faces);
    print_points(to, rigid);
    print_faces(to, rigid);
    fputs("</Piece>\n</PolyData>\n</VTKFile>\n", to);
}

static void print_index(FILE *to, const struct frame_series *s)
{
    const char *between = "";
    fputs("{\"file-series-version\":\"1.0\",\"files\":[", to);
    for (int k = 0; k < s->frames; k++) {
        if (s->entry[k].fields & FRAME_LOST) continue;
        fprintf(to, "%s\n{\"name\":\"frames/rigid_%06d.vtp\",\"time\":%.17g}", between, k, s->entry[k].time);
        between = ",";
    }
    fputs("\n]}\n", to);
}

/* Composes a file in memory and writes it to `path`. If `rigid` is NULL, the file is the index of all surface files of
 * the series s. Otherwise it holds the surfaces of the rigid bodies at the last output frame of s. Returns FAILED,
 * with a message, if the file cannot be composed or written. */
static status compose(const char *path, const struct rigid_set *rigid, const struct frame_series *s)
{
    char *text = NULL;
    size_t length = 0;
    FILE *to = memory_stream_open(&text, &length);
    if (!to) return status_set(FAILED, "%s: out of memory", path);
    if (rigid)
        print_file(to, rigid, &s->entry[s->frames - 1]);
    else
        print_index(to, s);
    status done = fclose(to) == 0 ? OK : status_set(FAILED, "%s: out of memory", path);
    if (done == OK) done = file_write_whole(path, text, length);
    free(text);
    return done;
}

static struct path rigid_path(const char *folder, int number)
{
    char name[PATH_NAME_ROOM];
    snprintf(name, sizeof name, "frames/rigid_%06d.vtp", number);
    return path_join(folder, name);
}

status rigids_write_surfaces_of_frame(struct rigid_set *rigid, const struct output *o, const struct particles *p)
{
    const struct frame_series *s = &o->series[0];
    if (rigid->n == 0 || rigid->dim < 2 || s->frames == 0) return OK;
    rigid_surfaces_make(rigid, p);
    TRY(compose(rigid_path(o->folder, s->frames - 1).text, rigid, s));
    return compose(path_join(o->folder, "rigid.vtp.series").text, NULL, s);
}

/* Reads n numbers separated by blanks from text into value[n]. Returns false if there are fewer. */
static bool numbers_read(const char *text, real *value, int n)
{
    for (int k = 0; k < n; k++) {
        char *end;
        value[k] = strtod(text, &end);
        if (end == text) return false;
        text = end;
    }
    return true;
}

bool rigids_read_placements_of_frame(struct rigid_placement *placement, int rigid_body_count, const char *folder,
                                     int frame_number)
{
    const struct path path = rigid_path(folder, frame_number);
    char *text, words[64];
    size_t length;
    if (rigid_body_count == 0 || !path_is_file(path.text) || file_read_whole(path.text, &text, &length) != OK)
        return false;
    snprintf(words, sizeof words, "Name=\"motion\" NumberOfTuples=\"%d\"", 15 * rigid_body_count);
    const char *at = strstr(text, words);
    real *value = NEW("rigid.motion", 15 * rigid_body_count, real);
    const bool read = at && (at = strchr(at, '>')) && numbers_read(at + 1, value, 15 * rigid_body_count);
    for (int b = 0; b < rigid_body_count && read; b++) {
        memcpy(placement[b].centre, value + 15 * b, sizeof placement->centre);
        memcpy(placement[b].x, value + 15 * b + 3, sizeof placement->x);
        memcpy(placement[b].turn, value + 15 * b + 6, sizeof placement->turn);
    }
    memory_free(value);
    memory_free(text);
    return read;
}
