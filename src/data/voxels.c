/* Reads grey values of a voxel image at points, and computes signed distances from the surface of the voxels with
 * certain grey values. */
#include "data/voxels.h"

#include <math.h>

#include "base/memory.h"

/* Share of a voxel by which coordinates are increased before they are assigned to voxels, so that round-off does not
 * decide for points on the border of two voxels. */
#define BORDER 1e-6

void voxels_free(struct voxels *v)
{
    memory_free(v->grey);
    *v = (struct voxels){0};
}

/* Returns the index along axis d of the voxel of v that contains X[dim] [m], limited to -1 .. n, where n is the number
 * of voxels, so that it fits an integer. */
static int64_t voxel_along(const struct voxels *v, const real *X, int d)
{
    const real at = floor((X[d] - v->from[d]) / v->size[d] + BORDER);
    return at < -1 ? -1 : at > (real)v->n[d] ? v->n[d] : (int64_t)at;
}

int voxels_grey_value(const struct voxels *v, const real *X)
{
    int64_t at = 0;
    for (int d = v->dim - 1; d >= 0; d--) {
        const int64_t k = voxel_along(v, X, d);
        if (k < 0 || k >= v->n[d]) return -1;
        at = at * v->n[d] + k;
    }
    return v->grey[at];
}

/* ---- distances --------------------------------------------------------------------------------------------------- */

/* Replaces n entries of f along one line, `stride` apart, by squared distances [m^2]: f[p] = min over q of (size (p -
 * q))^2 + f[q]. This is the lower envelope of parabolas (Felzenszwalb & Huttenlocher 2012). size: edge of a voxel along
 * the line [m]; room[3 n + 1]: working memory. */
static void line_distances(float *f, int64_t n, int64_t stride, real size, real *room)
{
    real *border = room, *value = room + n + 1, *foot = value + n;
    int64_t last = -1;
    for (int64_t q = 0; q < n; q++) value[q] = f[q * stride];
    for (int64_t q = 0; q < n; q++) {
        real meet = -INFINITY;
        if (!isfinite(value[q])) continue;
        for (; last >= 0; last--) {
            const real v = foot[last];
            meet = ((value[q] + square(size * (real)q)) - (value[(int64_t)v] + square(size * v))) /
                   (2 * square(size) * ((real)q - v));
            if (meet > border[last]) break;
        }
        last++;
        foot[last] = (real)q, border[last] = last > 0 ? meet : -INFINITY;
    }
    if (last < 0) return;
    for (int64_t p = 0, k = 0; p < n; p++) {
        while (k < last && border[k + 1] < (real)p) k++;
        f[p * stride] = (float)(square(size * ((real)p - foot[k])) + value[(int64_t)foot[k]]);
    }
}

/* Stores in n[3] the numbers of voxels along each axis of the padded grid of v: the image with one more voxel on each
 * side. Returns their product, the number of voxels of this grid. */
static int64_t padded(const struct voxels *v, int64_t n[DIM_MAX])
{
    int64_t all = 1;
    for (int d = 0; d < DIM_MAX; d++) n[d] = d < v->dim ? v->n[d] + 2 : 1, all *= n[d];
    return all;
}

/* Replaces f, a value for each voxel of the padded grid (the image v with one more voxel on each side), by the squared
 * distance of the voxel from the nearest voxel with f = 0 [m^2]. On entry f is 0 or infinite. The distances are
 * computed axis by axis. */
static void grid_distances(const struct voxels *v, float *f)
{
    int64_t n[DIM_MAX], stride = 1, all = padded(v, n);
    for (int d = 0; d < v->dim; d++, stride *= n[d - 1]) {
        const int64_t lines = all / n[d], step = stride, length = n[d];
        const real size = v->size[d];
#pragma omp parallel
        {
            real *room = BARE("voxels.line", 3 * length + 1, real);
#pragma omp for schedule(static)
            for (int64_t k = 0; k < lines; k++)
                line_distances(f + k / step * step * length + k % step, length, step, size, room);
            memory_free(room);
        }
    }
}

/* Returns true if the grey value `grey` is in one of the ranges of `voxels`, so that its voxels belong to this part of
 * the image. */
static bool grey_in(const struct voxel_solid *voxels, int grey)
{
    bool in = false;
    for (int k = 0; k < voxels->ranges; k++) in = in || (voxels->range[k].low <= grey && grey <= voxels->range[k].high);
    return in;
}

void voxel_solid_make_from_grey_value_ranges(struct voxel_solid *voxels)
{
    const struct voxels *v = voxels->of;
    int64_t n[DIM_MAX], all = padded(v, n), inside = 0;
    float *out = BARE("voxels.level", all, float);
    real half = 0.5 * v->size[0];
    voxels->level = BARE("voxels.level", all, float);
    for (int d = 1; d < v->dim; d++) half = real_min(half, 0.5 * v->size[d]);
#pragma omp parallel for schedule(static) reduction(+ : inside)
    for (int64_t k = 0; k < all; k++) {
        const int64_t i = k % n[0] - 1, j = k / n[0] % n[1] - 1, l = v->dim == 3 ? k / n[0] / n[1] - 1 : 0;
        const bool beyond = i < 0 || j < 0 || l < 0 || i >= v->n[0] || j >= v->n[1] || l >= v->n[2];
        const bool in = !beyond && grey_in(voxels, v->grey[(l * v->n[1] + j) * v->n[0] + i]);
        voxels->level[k] = in ? 0 : INFINITY, out[k] = in ? INFINITY : 0;
        inside += in;
    }
    grid_distances(v, voxels->level);
    grid_distances(v, out);
#pragma omp parallel for schedule(static)
    for (int64_t k = 0; k < all; k++)
        voxels->level[k] = out[k] > 0 ? (float)(half - sqrt(out[k])) : (float)(sqrt(voxels->level[k]) - half);
    voxels->voxels = inside;
    memory_free(out);
}

void voxel_solid_free(struct voxel_solid *voxels)
{
    memory_free(voxels->level);
    voxels->level = NULL;
}

/* Returns the index, in the padded grid (the image v with one more voxel on each side), of the voxel at X[dim], moved
 * by `step` voxels along axis `direction` (-1: not moved). Positions outside the grid count as in its nearest voxel. */
static int64_t level_index(const struct voxels *v, const real *X, int direction, int step)
{
    int64_t n[DIM_MAX], at = 0;
    padded(v, n);
    for (int d = v->dim - 1; d >= 0; d--) {
        int64_t k = voxel_along(v, X, d) + 1 + (d == direction ? step : 0);
        k = k < 0 ? 0 : k >= n[d] ? n[d] - 1 : k;
        at = at * n[d] + k;
    }
    return at;
}

/* Returns the distance of X[dim] from the box of the image v [m]; 0 inside the box. */
static real box_beyond(const struct voxels *v, const real *X)
{
    real sum = 0;
    for (int d = 0; d < v->dim; d++) {
        const real to = v->from[d] + (real)v->n[d] * v->size[d];
        sum += square(real_max(0, real_max(v->from[d] - X[d], X[d] - to)));
    }
    return sqrt(sum);
}

real voxel_solid_signed_distance(const struct voxel_solid *voxels, const real *X, real *normal)
{
    const struct voxels *v = voxels->of;
    real size2 = 0;
    for (int d = 0; d < v->dim && normal; d++) {
        const real up = voxels->level[level_index(v, X, d, 1)], down = voxels->level[level_index(v, X, d, -1)];
        normal[d] = (up - down) / v->size[d];
        size2 += square(normal[d]);
    }
    for (int d = 0; d < v->dim && normal; d++) normal[d] = size2 > 0 ? normal[d] / sqrt(size2) : d == 0;
    const real level = voxels->level[level_index(v, X, -1, 0)];
    return level > 0 ? level + box_beyond(v, X) : level;
}
