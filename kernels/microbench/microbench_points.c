/* Implements a plain material point method in 2D as a reference for timing: linear shape functions, MUSL, FLIP, elastic
 * points with Jaumann's stress rate.
 *
 * Points are stored sorted by cell, four in each cell, and stay in their cells (sorting is not timed). Each of the
 * three transfers between points and nodes is a loop over cells. Sums for the four nodes of a cell are local variables,
 * added to the nodes once. Rows of cells of one parity (even or odd) share no node, so that threads can process them in
 * parallel. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "microbench.h"
#include "base/team.h"

/* Numbers of cells along both axes, of corners of a cell, and of nodes. */
enum { CELLS_X = 100, CELLS_Y = 200, CORNERS = 4, NODES_X = CELLS_X + 1, NODES = NODES_X * (CELLS_Y + 1) };

/* Points and nodes of the plain material point method, for one measurement. n: number of points; h: edge of a cell [m];
 * dt: time step [s]; c11, c12, shear: elastic constants [Pa]; start: cells + 1 entries. x .. sxy belong to points
 * (position, velocity, mass, volume, stress), m .. uy to nodes. */
struct microbench_points {
    int64_t n;
    real h, dt, c11, c12, shear;
    int32_t *start; /* points of cell c: start[c] .. start[c+1]-1 */
    real *x, *y, *vx, *vy, *mass, *volume, *sxx, *syy, *sxy;
    real *m, *px, *py, *fx, *fy, *ux, *uy; /* nodes: mass, momentum, force, velocity */
};

/* Weights N of the linear shape functions of one point at the four corners of its cell [1], and their derivatives gx,
 * gy by x and y [1/m]. */
struct corner {
    real N[CORNERS], gx[CORNERS], gy[CORNERS];
};

/* Returns the shape functions of point i of p at the four corners of its cell, and their derivatives. cx, cy: indices
 * of the cell along x and y. */
static ALWAYS_INLINE struct corner corner_make(const struct microbench_points *p, int64_t i, int cx, int cy)
{
    const real inverse = 1 / p->h, r = p->x[i] * inverse - cx, s = p->y[i] * inverse - cy;
    return (struct corner){.N = {(1 - r) * (1 - s), r * (1 - s), (1 - r) * s, r * s},
                           .gx = {-(1 - s) * inverse, (1 - s) * inverse, -s * inverse, s * inverse},
                           .gy = {-(1 - r) * inverse, -r * inverse, (1 - r) * inverse, r * inverse}};
}

/* Returns the index of the node at a corner of a cell. k: number of the corner, 0 to 3, x fastest; cx, cy: indices of
 * the cell along x and y. */
static ALWAYS_INLINE int64_t corner_node(int cx, int cy, int k) { return (int64_t)(cy + k / 2) * NODES_X + cx + k % 2; }

/* Adds the four values sum[k] to the nodal array `field`, one at each corner k of a cell. cx, cy: indices of the cell
 * along x and y. */
static void add_corners(real *field, int cx, int cy, const real *sum)
{
    for (int k = 0; k < CORNERS; k++) field[corner_node(cx, cy, k)] += sum[k];
}

/* Transfer from points to nodes at the beginning of a step: adds mass, momentum and internal force of the points of one
 * cell to its four nodes. p: all points and nodes. cx, cy: indices of the cell along x and y. */
static void cell_scatter(struct microbench_points *p, int cx, int cy)
{
    const int c = cy * CELLS_X + cx;
    real m[CORNERS] = {0}, px[CORNERS] = {0}, py[CORNERS] = {0}, fx[CORNERS] = {0}, fy[CORNERS] = {0};
    for (int32_t i = p->start[c]; i < p->start[c + 1]; i++) {
        const struct corner w = corner_make(p, i, cx, cy);
        const real mass = p->mass[i], mx = mass * p->vx[i], my = mass * p->vy[i], V = p->volume[i];
        const real sxx = V * p->sxx[i], syy = V * p->syy[i], sxy = V * p->sxy[i];
        for (int k = 0; k < CORNERS; k++) {
            m[k] += mass * w.N[k];
            px[k] += mx * w.N[k], py[k] += my * w.N[k];
            fx[k] -= sxx * w.gx[k] + sxy * w.gy[k], fy[k] -= sxy * w.gx[k] + syy * w.gy[k];
        }
    }
    add_corners(p->m, cx, cy, m);
    add_corners(p->px, cx, cy, px), add_corners(p->py, cx, cy, py);
    add_corners(p->fx, cx, cy, fx), add_corners(p->fy, cx, cy, fy);
}

/* Second transfer of a step, for the points of one cell: adds the change of the nodal velocities (in p->fx, fy) to the
 * velocities of the points, then adds the momentum of the points to the nodes again. cx, cy: indices of the cell along
 * x and y. */
static void cell_remap(struct microbench_points *p, int cx, int cy)
{
    const int c = cy * CELLS_X + cx;
    real dx[CORNERS], dy[CORNERS], px[CORNERS] = {0}, py[CORNERS] = {0};
    for (int k = 0; k < CORNERS; k++) dx[k] = p->fx[corner_node(cx, cy, k)], dy[k] = p->fy[corner_node(cx, cy, k)];
    for (int32_t i = p->start[c]; i < p->start[c + 1]; i++) {
        const struct corner w = corner_make(p, i, cx, cy);
        for (int k = 0; k < CORNERS; k++) p->vx[i] += w.N[k] * dx[k], p->vy[i] += w.N[k] * dy[k];
        const real mx = p->mass[i] * p->vx[i], my = p->mass[i] * p->vy[i];
        for (int k = 0; k < CORNERS; k++) px[k] += mx * w.N[k], py[k] += my * w.N[k];
    }
    add_corners(p->px, cx, cy, px), add_corners(p->py, cx, cy, py);
}

/* Updates stress and volume of point i of p for one step, with the objective stress rate of Jaumann. xx, yy, xy: strain
 * increments [1]; spin: rotation angle of the step [rad]. */
static ALWAYS_INLINE void microbench_point_stress(struct microbench_points *p, int64_t i, real xx, real yy, real xy,
                                                  real spin)
{
    const real sxx = p->sxx[i], syy = p->syy[i], sxy = p->sxy[i];
    p->sxx[i] = sxx + 2 * sxy * spin + p->c11 * xx + p->c12 * yy;
    p->syy[i] = syy - 2 * sxy * spin + p->c12 * xx + p->c11 * yy;
    p->sxy[i] = sxy + (syy - sxx) * spin + 2 * p->shear * xy;
    p->volume[i] *= 1 + xx + yy;
}

/* Transfer from nodes to points at the end of a step: updates position, stress and volume of the points (of p) in one
 * cell from the nodal velocities. cx, cy: indices of the cell along x and y. */
static void cell_gather(struct microbench_points *p, int cx, int cy)
{
    const int c = cy * CELLS_X + cx;
    real ux[CORNERS], uy[CORNERS], px[CORNERS], py[CORNERS];
    for (int k = 0; k < CORNERS; k++) {
        const int64_t I = corner_node(cx, cy, k);
        ux[k] = p->ux[I], uy[k] = p->uy[I], px[k] = p->px[I], py[k] = p->py[I];
    }
    for (int32_t i = p->start[c]; i < p->start[c + 1]; i++) {
        const struct corner w = corner_make(p, i, cx, cy);
        real vx = 0, vy = 0, xx = 0, xy = 0, yx = 0, yy = 0;
        for (int k = 0; k < CORNERS; k++) {
            vx += w.N[k] * ux[k], vy += w.N[k] * uy[k];
            xx += px[k] * w.gx[k], xy += px[k] * w.gy[k], yx += py[k] * w.gx[k], yy += py[k] * w.gy[k];
        }
        p->x[i] += p->dt * vx, p->y[i] += p->dt * vy;
        microbench_point_stress(p, i, xx * p->dt, yy * p->dt, 0.5 * (xy + yx) * p->dt, 0.5 * (xy - yx) * p->dt);
    }
}

/* Defines map_NAME, which calls cell_NAME, one transfer between points and nodes, for all cells. Even rows of cells are
 * processed first, then odd ones, since rows of one parity share no node. */
#define MAP(NAME)                                                                                                      \
    static void map_##NAME(struct microbench_points *p)                                                                \
    {                                                                                                                  \
        _Pragma("omp parallel") for (int colour = 0; colour < 2; colour++)                                             \
        {                                                                                                              \
            _Pragma("omp for schedule(static)") for (int cy = colour; cy < CELLS_Y; cy += 2) for (int cx = 0;          \
                                                                                                  cx < CELLS_X; cx++)  \
                cell_##NAME(p, cx, cy);                                                                                \
        }                                                                                                              \
    }
MAP(scatter)
MAP(remap)
MAP(gather)

/* Sets mass, momentum and force of all nodes of p to 0, before a step. */
static void nodes_clear(struct microbench_points *p)
{
#pragma omp parallel for schedule(static)
    for (int I = 0; I < NODES; I++) p->m[I] = p->px[I] = p->py[I] = p->fx[I] = p->fy[I] = 0;
}

/* Computes for all nodes of p the change of velocity (into fx, fy) and the new velocity (ux, uy) from momentum and
 * force, and then sets the momentum to 0. */
static void nodes_move(struct microbench_points *p)
{
#pragma omp parallel for schedule(static)
    for (int I = 0; I < NODES; I++) {
        const real inverse = 1 / p->m[I];
        p->fx[I] *= p->dt * inverse, p->fy[I] *= p->dt * inverse;
        p->ux[I] = p->px[I] * inverse + p->fx[I], p->uy[I] = p->py[I] * inverse + p->fy[I];
        p->px[I] = p->py[I] = 0;
    }
}

/* Divides the momentum of all nodes of p by their mass, after the second transfer: px, py are then velocities. */
static void nodes_remapped(struct microbench_points *p)
{
#pragma omp parallel for schedule(static)
    for (int I = 0; I < NODES; I++) p->px[I] /= p->m[I], p->py[I] /= p->m[I];
}

double microbench_points_run(struct microbench_points *p)
{
    double start = wall_clock_seconds();
    nodes_clear(p);
    map_scatter(p);
    nodes_move(p);
    map_remap(p);
    nodes_remapped(p);
    map_gather(p);
    return (wall_clock_seconds() - start) / (double)p->n;
}

/* Sets positions, velocities, volumes and masses of the points p: steel, spacing 0.5 mm, with a wave so weak that
 * points stay in their cells during the measurement. */
static void place_points(struct microbench_points *p)
{
    for (int c = 0; c < CELLS_X * CELLS_Y; c++) {
        p->start[c + 1] = p->start[c] + 4;
        for (int k = 0; k < 4; k++) {
            const int64_t i = p->start[c] + k;
            p->x[i] = p->h * (c % CELLS_X + 0.25 + 0.5 * (k % 2));
            p->y[i] = p->h * (c / CELLS_X + 0.25 + 0.5 * (k / 2));
            p->vx[i] = 1e-3 * sin(40 * p->x[i]), p->vy[i] = 1e-3 * cos(40 * p->y[i]);
            p->volume[i] = 0.25 * p->h * p->h * 0.01;
            p->mass[i] = 7800 * p->volume[i];
        }
    }
}

struct microbench_points *microbench_points_make(void)
{
    struct microbench_points *p = NEW("bench.points", 1, struct microbench_points);
    p->n = 4 * CELLS_X * CELLS_Y, p->h = 1e-3, p->dt = 5e-8;
    p->c11 = 214e9, p->c12 = 71e9, p->shear = 71e9;
    p->start = NEW("bench.points.start", CELLS_X * CELLS_Y + 1, int32_t);
    real **const particle[] = {&p->x, &p->y, &p->vx, &p->vy, &p->mass, &p->volume, &p->sxx, &p->syy, &p->sxy};
    real **const node[] = {&p->m, &p->px, &p->py, &p->fx, &p->fy, &p->ux, &p->uy};
    for (size_t k = 0; k < COUNT_OF(particle); k++) *particle[k] = NEW("bench.points.particle", p->n, real);
    for (size_t k = 0; k < COUNT_OF(node); k++) *node[k] = NEW("bench.points.node", NODES, real);
    place_points(p);
    return p;
}

void microbench_points_free(struct microbench_points *p)
{
    real *const arrays[] = {p->x,   p->y, p->vx, p->vy, p->mass, p->volume, p->sxx, p->syy,
                            p->sxy, p->m, p->px, p->py, p->fx,   p->fy,     p->ux,  p->uy};
    for (size_t k = 0; k < COUNT_OF(arrays); k++) memory_free(arrays[k]);
    memory_free(p->start);
    memory_free(p);
}
