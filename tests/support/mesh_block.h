/* A block of points in the reference frame for tests of its mesh, and a plain reference implementation of its
 * energy. */
#ifndef CLEAVE_TESTS_MESH_BLOCK
#define CLEAVE_TESTS_MESH_BLOCK

#include "src/mesh/mesh_parts.h"

#include "cloud.h"
#include "near.h"
#include "base/polar.h"
#include "sets.h"

static const enum space spaces[] = {SPACE_LINE, SPACE_PLANE_STRESS, SPACE_SOLID};

/* A block of material points with their mesh in the reference frame (cells of 2^D points each), and the materials to
 * which the mesh refers. It may have a hole in one corner, so that some cells are partial, i.e. lack points. */
struct block {
    struct particle_cloud c;
    struct mesh mesh;
    struct elastic elastic[CLOUD_MATERIALS];
    struct law law[CLOUD_MATERIALS]; /* of materials with a flow law */
    struct mesh_source source;
};

/* Creates the block b and its mesh in the space `space`. hole: true if the points within three spacings of the lowest
 * corner are peridynamic and thus no part of the mesh; cubic: true if the elastic constant c12 is lowered by a fifth,
 * which makes the material anisotropic; optional: sum of WITH_*, further arrays of the particles. Release it with
 * block_free. */
static void block_make_with(struct block *b, enum space space, bool hole, bool cubic, int optional)
{
    static const int size[DIM_MAX + 1][DIM_MAX] = {{0}, {27, 0, 0}, {23, 12, 0}, {21, 6, 6}};
    struct cloud_plan plan = {.space = space, .horizon = 3, .optional = optional};
    const int dim = space_dim(space);
    struct grid like = {.dim = dim, .h = 2 * CLOUD_SPACING};
    memset(b, 0, sizeof *b);
    memcpy(plan.count, size[dim], sizeof plan.count);
    particle_cloud_make(&b->c, &plan);
    struct particles *p = &b->c.p;
    for (int m = 0; m < CLOUD_MATERIALS; m++) {
        const struct material *k = &b->c.material[m];
        b->elastic[m] = (struct elastic){
            .c11 = k->c11, .c12 = (cubic ? 0.8 : 1) * k->c12, .shear = k->shear, .trigger = INFINITY, .space = space};
    }
    b->source = (struct mesh_source){.elastic = b->elastic, .isotropic = b->elastic, .materials = CLOUD_MATERIALS};
    for (int d = 0; d < dim; d++) {
        like.anchor[d] = INFINITY;
        for (int64_t i = 0; i < p->n; i++) like.anchor[d] = real_min(like.anchor[d], p->X[d][i] - 0.5 * CLOUD_SPACING);
    }
    for (int64_t i = 0; i < p->n; i++) {
        bool out = hole;
        for (int d = 0; d < dim; d++) out = out && p->X[d][i] - like.anchor[d] < 3 * CLOUD_SPACING;
        p->kind[i] = out ? KIND_PD : KIND_MPM;
        p->flag[i] |= FLAG_MESHED;
    }
    assert_ok(mesh_make(&b->mesh, p, &like, &b->source));
    assert_true(b->mesh.runs > 0 && b->mesh.own_stiffness_cells > 0);
}

/* Creates the block b of material points as block_make_with does, without further arrays. space, hole, cubic: as there.
 */
static inline void block_make(struct block *b, enum space space, bool hole, bool cubic)
{
    block_make_with(b, space, hole, cubic, 0);
}

/* Selects the mean dilatation for both materials of the block b, by which all points of one material in a cell have the
 * same dilatation (elastic.mean_dilatation; not in 1D), and rebuilds the mesh. mixed: true to assign material 1 to
 * every eleventh point before, so that cells contain several materials. */
static inline void block_average(struct block *b, bool mixed)
{
    for (int m = 0; m < CLOUD_MATERIALS; m++) b->elastic[m].mean_dilatation = b->c.p.dim > 1;
    for (int64_t i = 0; i < b->c.p.n && mixed; i++) b->c.p.material[i] = i * 7 % 11 == 0;
    mesh_remove_points_and_return_lost_energy(&b->mesh, &b->c.p, &b->source, NULL, 0);
}

/* Frees the mesh and the particles of the block b. */
static void block_free(struct block *b)
{
    mesh_free(&b->mesh);
    particle_cloud_free(&b->c);
}

/* Sets random displacements at every node of the mesh with mass, each component between -by and by [spacings]; 0 at
 * other nodes. seed: start of the random numbers. */
static void shake(struct block *b, real by, uint64_t seed)
{
    for (int64_t I = 0; I < b->mesh.grid.n; I++)
        for (int d = 0; d < b->c.p.dim; d++)
            b->mesh.displacement[d][I] = b->mesh.grid.mass[I] > 0 ? cloud_between(&seed, -by, by) * CLOUD_SPACING : 0;
}

/* Returns coordinate d of node I of the mesh in the reference frame [m]. */
static real node_place(const struct mesh *mesh, int64_t I, int d)
{
    return grid_node_position(&mesh->grid, d,
                              mesh_original_node_of_doubled_node(mesh, I) / mesh->grid.stride[d] % mesh->grid.count[d]);
}

/* Displaces all nodes with mass as a body that is first extended along x by `stretch` [1] and then rotated about z by
 * `angle` [rad]; in 1D it is only extended. */
static inline void rotation(struct block *b, real angle, real stretch)
{
    const int dim = b->c.p.dim;
    for (int64_t I = 0; I < b->mesh.grid.n; I++) {
        real X[DIM_MAX] = {0}, x[DIM_MAX];
        if (b->mesh.grid.mass[I] == 0) continue;
        for (int d = 0; d < dim; d++) X[d] = node_place(&b->mesh, I, d);
        x[0] = (1 + stretch) * X[0], x[1] = X[1], x[2] = X[2];
        const real y[DIM_MAX] = {dim > 1 ? cos(angle) * x[0] - sin(angle) * x[1] : x[0],
                                 sin(angle) * x[0] + cos(angle) * x[1], x[2]};
        for (int d = 0; d < dim; d++) b->mesh.displacement[d][I] = y[d] - X[d];
    }
}

/* ---- reference implementation: energy point by point ------------------------------------------------------------- */

/* Computes the strain R^T F - 1 of point i from the displacements of the nodes and stores it in e[dim * dim], row by
 * row. F: deformation gradient at the point; R: rotation of the mean deformation gradient of its cell if `finite` is
 * true, else the identity. */
static void point_strain(const struct block *b, int64_t i, bool finite, real *e)
{
    const struct mesh *mesh = &b->mesh;
    const int dim = b->c.p.dim, place = mesh->place[i] & ((1 << dim) - 1);
    const int64_t I = mesh->place[i] >> dim;
    real F[9] = {0}, mean[9] = {0}, R[9] = {1};
    for (int a = 0; a < dim; a++)
        for (int k = 0; k < dim; k++) {
            F[a * dim + k] = mean[a * dim + k] = a == k;
            for (int c = 0; c < 1 << dim; c++) {
                real slope = 1, flat = 1; /* derivative of the hat functions at the point, at the cell's centre */
                for (int d = 0; d < dim; d++) {
                    const real xi = place >> d & 1 ? 0.75 : 0.25, sign = c >> d & 1 ? 1 : -1;
                    slope *= d == k ? sign : c >> d & 1 ? xi : 1 - xi;
                    flat *= d == k ? sign : 0.5;
                }
                F[a * dim + k] += slope / mesh->grid.h * mesh->displacement[a][mesh_cell_corner_node(mesh, I, c)];
                mean[a * dim + k] += flat / mesh->grid.h * mesh->displacement[a][mesh_cell_corner_node(mesh, I, c)];
            }
        }
    for (int a = 0; a < dim * dim; a++) R[a] = a % (dim + 1) == 0;
    if (finite && dim > 1) polar_rotation(mean, R, dim);
    for (int a = 0; a < dim; a++)
        for (int k = 0; k < dim; k++) {
            e[a * dim + k] = -(a == k);
            for (int c = 0; c < dim; c++) e[a * dim + k] += R[c * dim + a] * F[c * dim + k];
        }
}

/* Returns the dilatation of point i, the trace of its strain (point_strain) or, if its material has mean_dilatation,
 * the mean over the points of its material in its cell. */
static real point_trace(const struct block *b, int64_t i, bool finite)
{
    const int dim = b->c.p.dim;
    real sum = 0;
    int n = 0;
    for (int q = 0; q < 1 << dim; q++) {
        const int64_t j = b->mesh.point[(b->mesh.place[i] >> dim << dim) + q];
        real e[9];
        if (j < 0 || b->c.p.material[j] != b->c.p.material[i]) continue;
        if (!b->elastic[b->c.p.material[i]].mean_dilatation && j != i) continue;
        point_strain(b, j, finite, e);
        n++;
        for (int d = 0; d < dim; d++) sum += e[d * (dim + 1)];
    }
    return sum / n;
}

/* Returns the elastic energy of point i [J], from its strain with the dilatation of point_trace. finite: true if the
 * rotation of the cell is removed from the strain. */
static real point_energy(const struct block *b, int64_t i, bool finite)
{
    const int dim = b->c.p.dim;
    const struct elastic *m = &b->elastic[b->c.p.material[i]];
    real e[9], normal = 0, shear = 0, trace = 0, dilatation = point_trace(b, i, finite);
    point_strain(b, i, finite, e);
    for (int d = 0; d < dim; d++) trace += e[d * (dim + 1)];
    for (int d = 0; d < dim; d++) e[d * (dim + 1)] += (dilatation - trace) / dim;
    trace = 0;
    for (int a = 0; a < dim; a++) {
        normal += square(e[a * dim + a]), trace += e[a * dim + a];
        for (int k = 0; k < a; k++) shear += square(e[a * dim + k] + e[k * dim + a]);
    }
    return 0.5 * b->mesh.volume * ((m->c11 - m->c12) * normal + m->c12 * square(trace) + m->shear * shear);
}

/* Returns the elastic energy [J] of all points of the mesh, computed point by point, to be compared with that of the
 * engine. finite: true if the rotations of cells are removed from the strains. */
static inline real plain_energy(const struct block *b, bool finite)
{
    real sum = 0;
    for (int64_t i = 0; i < b->c.p.n; i++)
        if (b->mesh.place[i] >= 0) sum += point_energy(b, i, finite);
    return sum;
}

/* Computes the nodal forces b->mesh.grid.force of the mesh for the present displacements, by the function of the
 * engine. finite: true if the rotations of cells are removed from the strains. */
static void forces(struct block *b, bool finite)
{
    mesh_clear(&b->mesh);
    mesh_force(&b->mesh, &b->c.p, b->elastic, finite);
}

/* Returns the largest magnitude [N] of the components of all nodal forces. */
static real largest_force(const struct block *b)
{
    real most = 0;
    for (int64_t I = 0; I < b->mesh.grid.n; I++)
        for (int d = 0; d < b->c.p.dim; d++) most = real_max(most, fabs(b->mesh.grid.force[d][I]));
    return most;
}

/* Creates partial stresses for all particles of p: a random matrix M = T C^-1 for each particle, where M times its
 * stress is the part of the stress that PD-MPM bonds carry. C: stiffness of the material of the particle; T: symmetric,
 * with entries of at most `most` times Young's modulus of material 0. material: materials by index. Release with
 * partial_stress_free. */
static inline void partial_of(struct partial_stress *partial, const struct particles *p,
                              const struct material *material, real most)
{
    const int n = symmetric_tensor_component_count(p->dim);
    uint64_t seed = 17;
    real compliance[SYM_MAX * SYM_MAX];
    memset(partial, 0, sizeof *partial);
    partial->index = NEW("test.index", p->n, int32_t);
    partial->matrix = NEW("test.matrix", p->n * n * n, real);
    for (int64_t i = 0; i < p->n; i++) {
        real T[SYM_MAX * SYM_MAX];
        partial->index[i] = (int32_t)i;
        material_compliance_matrix(&material[p->material[i]], p->dim, compliance);
        for (int a = 0; a < n; a++)
            for (int c = 0; c <= a; c++)
                T[a * n + c] = T[c * n + a] = most > 0 ? material->young * cloud_between(&seed, -most, most) : 0;
        for (int a = 0; a < n; a++)
            for (int c = 0; c < n; c++)
                for (int k = 0; k < n; k++)
                    partial->matrix[(i * n + a) * n + c] += T[a * n + k] * (k < p->dim ? 1 : 2) * compliance[k * n + c];
    }
}

#endif
