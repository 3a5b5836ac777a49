/* Paints a view of a solid body from outside. Each particle is a cube in parallel projection, and each pixel shows the
 * nearest cube. The brightness of a cube depends on the direction of the face that is visible, so that a plane face of
 * the body has one colour. Neither lighting nor surface detection is needed. */
#include <math.h>

#include "base/memory.h"
#include "plot/plot.h"
#include "shading.h"

/* Half edge of a cube divided by the spacing; slightly more than 0.5 to close the gaps of a strained lattice. */
static const double HALF = 0.52;

/* Cosines of the angle between the normal of a face and the direction to the viewer. The brightness of a face is 1 from
 * STRAIGHT on; below OBLIQUE (20 degrees) it is the mean of FACE_BRIGHTNESS over the axes (face_brightness); it is
 * linear between both, as normals on a flat side of a deformed body differ by a few degrees. */
static const double STRAIGHT = 0.999, OBLIQUE = 0.94;

/* Image of a 3D body while it is painted. pixel: [height][width] colours; size: width and height [pixel]; view:
 * rectangle that is shown. */
struct scene_canvas {
    struct colour *pixel;
    float *depth; /* [height][width] depth of the painted surface, towards the viewer [m] */
    int size[2];
    double per_metre[2]; /* pixels per metre */
    const struct view *view;
};

/* Deformed cube that represents one particle in the picture: half edges of the undeformed cube [m], deformation
 * gradient F and its inverse, and the direction to the viewer, transformed to the undeformed cube. The parts of the
 * cube beyond planes of symmetry are not drawn. */
struct cube {
    double half[3], F[3][3], inverse[3][3], towards[3];
    const struct plotted_particles *cloud; /* for its planes of symmetry */
    double beyond[MIRRORS_SHOWN_MOST];     /* coordinate of each plane less that of the centre [m] */
};

/* Shortens the range *enters .. *leaves of depths [m] in which a line of sight is inside the cube b to the part on the
 * centre's side of every plane of symmetry. at[2]: distances of the line from the centre, along eye->right and eye->up
 * [m]. face: axis of the face through which the line leaves the cube. Returns the axis of the plane through which the
 * shortened line leaves towards the viewer, or `face` if it still leaves through that face. A line without such a part
 * gets *leaves < *enters. */
static int clip_line_at_mirrors(const struct camera *eye, const struct cube *b, const double *at, double *enters,
                                double *leaves, int face)
{
    for (int m = 0; m < b->cloud->mirrors; m++) {
        const int n = b->cloud->mirror[m].axis;
        const double side = b->beyond[m] > 0 ? -1 : 1, slope = side * eye->towards[n];
        const double inside = side * (at[0] * eye->right[n] + at[1] * eye->up[n] - b->beyond[m]);
        if (fabs(slope) < 1e-9) {
            if (inside < 0) *leaves = -INFINITY;
        } else if (slope > 0)
            *enters = fmax(*enters, -inside / slope);
        else if (-inside / slope < *leaves)
            *leaves = -inside / slope, face = n;
    }
    return face;
}

/* Intersects a line of sight of the camera `eye` with the deformed cube b. at[2]: distances of the line from the cube's
 * centre in the picture plane, along eye->right and eye->up [m]. Returns the axis of the face through which the line
 * leaves the cube towards the viewer, and stores in *depth the distance of that point from the picture plane [m].
 * Returns -1 if the line misses the cube. */
static int leaves_cube(const struct camera *eye, const struct cube *b, const double *at, double *depth)
{
    double enters = -INFINITY, leaves = INFINITY;
    int face = -1;
    for (int k = 0; k < 3; k++) {
        double place = 0;
        const double slope = b->towards[k];
        for (int d = 0; d < 3; d++) place += b->inverse[k][d] * (at[0] * eye->right[d] + at[1] * eye->up[d]);
        if (fabs(slope) < 1e-9) {
            if (fabs(place) > b->half[k]) return -1;
            continue;
        }
        const double middle = -place / slope, reach = b->half[k] / fabs(slope);
        enters = fmax(enters, middle - reach);
        if (middle + reach < leaves) leaves = middle + reach, face = k;
    }
    face = clip_line_at_mirrors(eye, b, at, &enters, &leaves, face);
    *depth = leaves;
    return enters < leaves ? face : -1;
}

/* Computes the cube by which the picture shows particle i of `plotted`, deformed by the particle's deformation
 * gradient, and stores it in *b. A cube smaller than a pixel of the canvas v is enlarged to one pixel. Without a
 * gradient, or if it cannot be inverted, the cube is undeformed. */
static void cube_of(const struct scene_canvas *v, const struct plotted_particles *plotted, int64_t i, struct cube *b)
{
    const double *axis[3] = {plotted->camera.right, plotted->camera.up, plotted->camera.towards};
    const double least = 0.6 / v->per_metre[0], own = HALF * (plotted->size ? plotted->size[i] : plotted->spacing);
    for (int k = 0; k < 3; k++) b->half[k] = fmax(own, least);
    if (plotted->tall > 0) b->half[1] = plotted->tall;
    for (int k = 0; k < 9; k++)
        b->F[k / 3][k % 3] = plotted->gradient ? (double)plotted->gradient[9 * i + k] : k % 4 == 0;
    if (!matrix_invert_3x3((const double(*)[3])b->F, b->inverse))
        for (int k = 0; k < 9; k++) b->F[k / 3][k % 3] = b->inverse[k / 3][k % 3] = k % 4 == 0;
    b->cloud = plotted;
    for (int m = 0; m < plotted->mirrors; m++) {
        b->beyond[m] = plotted->mirror[m].at;
        for (int a = 0; a < 3; a++)
            if (plotted->position[a]) b->beyond[m] -= plotted->position[a][i] * axis[a][plotted->mirror[m].axis];
    }
    for (int k = 0; k < 3; k++) {
        b->towards[k] = 0;
        for (int d = 0; d < 3; d++) b->towards[k] += b->inverse[k][d] * plotted->camera.towards[d];
    }
}

/* Returns half of the extent of the deformed cube b along `direction`, a unit vector of 3 components [m]. */
static double cube_reach(const struct cube *b, const double *direction)
{
    double reach = 0;
    for (int k = 0; k < 3; k++) {
        double along = 0;
        for (int d = 0; d < 3; d++) along += direction[d] * b->F[d][k];
        reach += b->half[k] * fabs(along);
    }
    return reach;
}

/* Returns the brightness of a face of the deformed cube b, 0 to 1: the mean of FACE_BRIGHTNESS over the three axes,
 * weighted by the squared components of the normal of the face. It increases to 1 if the direction to the viewer is
 * along the normal, within 2.6 degrees. face: axis of the face in the undeformed cube; towards[3]: direction to the
 * viewer (unit vector). */
static double face_brightness(const struct cube *b, int face, const double *towards)
{
    double length = 0, facing = 0, shade = 0;
    for (int d = 0; d < 3; d++) {
        const double n = b->inverse[face][d]; /* the normal is along F^-T e_face */
        length += n * n, shade += FACE_BRIGHTNESS[d] * n * n, facing += n * towards[d];
    }
    const double straight = fmin(fmax((fabs(facing) / sqrt(length) - OBLIQUE) / (STRAIGHT - OBLIQUE), 0), 1);
    return straight + (1 - straight) * shade / length;
}

/* Paints the cube of particle i of `plotted` in the given colour on those pixels of the canvas v on which the cube is
 * nearer to the viewer than the cubes painted before. */
static void paint_cube(struct scene_canvas *v, const struct plotted_particles *plotted, int64_t i, struct colour colour)
{
    struct cube cube;
    double at[2];
    int from[2], to[2];
    cube_of(v, plotted, i, &cube);
    const double reach[2] = {cube_reach(&cube, plotted->camera.right), cube_reach(&cube, plotted->camera.up)};
    for (int a = 0; a < 2; a++) {
        at[a] = plotted->position[a][i] - v->view->from[a];
        const double low = (at[a] - reach[a]) * v->per_metre[a], high = (at[a] + reach[a]) * v->per_metre[a];
        if (!(high > 0 && low < v->size[a])) return; /* outside the picture, or NaN */
        from[a] = (int)fmax(ceil(low - 0.5), 0);
        to[a] = (int)fmin(floor(high - 0.5), v->size[a] - 1);
    }
    double bright[3];
    for (int k = 0; k < 3; k++)
        bright[k] = plotted->position[2] ? face_brightness(&cube, k, plotted->camera.towards) : 1;
    for (int row = from[1]; row <= to[1]; row++)
        for (int column = from[0]; column <= to[0]; column++) {
            const double off[2] = {(column + 0.5) / v->per_metre[0] - at[0], (row + 0.5) / v->per_metre[1] - at[1]};
            double depth = 0;
            const int face = leaves_cube(&plotted->camera, &cube, off, &depth);
            const int64_t q = (int64_t)row * v->size[0] + column;
            if (plotted->position[2]) depth += plotted->position[2][i];
            if (face < 0 || depth <= v->depth[q]) continue;
            v->depth[q] = (float)depth;
            v->pixel[q] = colour_mixed_with_black(colour, bright[face]);
        }
}

static void canvas_clear_depth(struct scene_canvas *v)
{
    for (int64_t q = 0; q < (int64_t)v->size[0] * v->size[1]; q++) v->depth[q] = -INFINITY;
}

void image_paint_particles_as_cubes(struct colour *pixel, int width, int height, const struct view *view,
                                    const struct plotted_particles *plotted, enum map map)
{
    const int64_t pixels = (int64_t)width * height;
    struct scene_canvas v = {
        .pixel = pixel, .depth = NEW("plot.depth", pixels, float), .size = {width, height}, .view = view};
    for (int a = 0; a < 2; a++) v.per_metre[a] = v.size[a] / (view->to[a] - view->from[a]);
    for (int64_t q = 0; q < pixels; q++) pixel[q] = (struct colour){255, 255, 255, 0};
    canvas_clear_depth(&v);
    const struct colour ghost = colour_mixed_with_white(colour_on_damage_scale(0), GHOST);
    for (int64_t i = 0; i < plotted->n; i++)
        paint_cube(&v, plotted, i, map == MAP_CRACKS ? ghost : plotted_particle_colour(view, plotted, i, map));
    if (plotted->position[2])
        image_paint_rigid_bodies_with_depth_test(pixel, v.depth, width, height, view, plotted, map);
    if (map == MAP_CRACKS) {
        canvas_clear_depth(&v);
        for (int64_t i = 0; i < plotted->n; i++)
            if (plotted->damage[i] >= CRACK_DAMAGE)
                paint_cube(&v, plotted, i, plotted_particle_colour(view, plotted, i, map));
    }
    memory_free(v.depth);
}
