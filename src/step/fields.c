/* Computes the fields of output frames that particles do not store: displacement gradients, plastic work and strain,
 * ratios of stress to strength, levels of cells. */
#include <math.h>

#include "base/memory.h"
#include "mesh/mesh_part.h"
#include "output/output.h"

/* Radius of the neighbours of a material point [spacings]: nearest lattice neighbours, diagonal ones included. */
#define NEAR_REACH 1.5
/* Determinant of K divided by (tr K/3)^3, with K completed to 3 x 3 by its mean eigenvalue, up to which neighbours do
 * not span the space [1]; it is 1 if they are isotropic. */
#define SHAPE_LEAST 1e-6

/* ---- displacement gradients -------------------------------------------------------------------------------------- */

/* Sums over the neighbours of a particle: K = sum xi xi^T and M = sum u xi^T, with the reference vector xi [m] and the
 * relative displacement u [m] of a neighbour. H = M K^-1 is the least-squares fit of u = H xi; K and I + H are the
 * shape tensor and the deformation gradient of Silling et al. 2007 with unit weights. */
struct gradient_sum {
    real K[3][3], M[3][3];
};

/* Adds neighbour j of particle i to the sums s over its neighbours: xi xi^T to K and u xi^T to M, with the reference
 * vector xi from i to j and the relative displacement u. p: all particles. */
static void gradient_add(struct gradient_sum *s, const struct particles *p, int64_t i, int64_t j)
{
    real xi[DIM_MAX], u[DIM_MAX];
    for (int d = 0; d < p->dim; d++) {
        xi[d] = p->X[d][j] - p->X[d][i];
        u[d] = (p->x[d][j] - p->x[d][i]) - xi[d];
    }
    for (int a = 0; a < p->dim; a++)
        for (int b = 0; b < p->dim; b++) s->K[a][b] += xi[a] * xi[b], s->M[a][b] += u[a] * xi[b];
}

/* Computes the displacement gradient of particle i, H = M K^-1, from the sums s over its neighbours, and stores it in
 * H[dim dim][i]. H becomes 0 if the neighbours do not span the space: if the determinant of K is at most SHAPE_LEAST
 * times the cube of its mean eigenvalue. s->K is overwritten in the axes beyond dim. */
static void gradient_fit(struct gradient_sum *s, int dim, int64_t i, real *const *H)
{
    real mean = 0, C[3][3];
    for (int d = 0; d < dim; d++) mean += s->K[d][d] / dim;
    for (int d = dim; d < 3; d++) s->K[d][d] = mean;
    for (int a = 0; a < 3; a++) /* cofactors of the symmetric K */
        for (int b = 0; b < 3; b++) {
            const int c = (a + 1) % 3, d = (a + 2) % 3, e = (b + 1) % 3, f = (b + 2) % 3;
            C[a][b] = s->K[c][e] * s->K[d][f] - s->K[c][f] * s->K[d][e];
        }
    const real determinant = s->K[0][0] * C[0][0] + s->K[0][1] * C[0][1] + s->K[0][2] * C[0][2];
    const bool spans = determinant > SHAPE_LEAST * mean * mean * mean;
    for (int a = 0; a < dim; a++)
        for (int b = 0; b < dim; b++) {
            real sum = 0;
            for (int k = 0; k < dim; k++) sum += s->M[a][k] * C[k][b];
            H[a * dim + b][i] = spans ? sum / determinant : 0;
        }
}

/* Computes the displacement gradient of peridynamic particle i of `part` from its intact bonds, and stores it in H[dim
 * dim][i]. */
static void gradient_of_bonds(const struct bonds *bonds, const struct particles *part, int64_t i, real *const *H)
{
    struct gradient_sum sum = {{{0}}, {{0}}};
    for (struct bond_iterator it = bond_iterator_of_row(bonds, bonds->row_of[i]); bond_iterator_advance(&it);)
        if (it.bond.w != 0) gradient_add(&sum, part, i, it.bond.nbr);
    gradient_fit(&sum, part->dim, i, H);
}

/* Computes the displacement gradient of material point i of p on the grid, H[dim dim][i], by a fit to the neighbouring
 * points in `near` that belong to its body and are not separated from it by pre-cracks or voids. Peridynamic neighbours
 * with broken bonds are left out, because a crack may separate them from the point. source: pre-cracks and voids. */
static void gradient_of_points(const struct particles *p, const struct bond_source *source,
                               const struct neighbour_list *near, int64_t i, real *const *H)
{
    struct gradient_sum sum = {{{0}}, {{0}}};
    for (int k = 0; k < near->n; k++) {
        const int64_t j = near->at[k];
        const bool torn = p->kind[j] == KIND_PD && p->damage[j] > 0;
        if (p->body[j] != p->body[i] || torn || precracks_cut_bond_between(source->crack, source->cracks, p, i, j) ||
            void_separates_particles(source->voids, p, i, j))
            continue;
        gradient_add(&sum, p, i, j);
    }
    gradient_fit(&sum, p->dim, i, H);
}

/* Returns true if particle i is a point of the mesh of the reference frame, with a cell. */
static bool in_mesh(const struct lagrangian_mesh *frame, int64_t i)
{
    return frame->mesh.points > 0 && frame->mesh.place[i] >= 0;
}

/* Computes the displacement gradients of all particles of the run, H[dim dim][n] [1], from mesh nodes, bonds or near
 * points. Allocates the arrays H[k], which the caller frees with memory_free. */
static void gradients_make(const struct run *run, real **H)
{
    const struct particles *p = &run->part;
    for (int k = 0; k < p->dim * p->dim; k++) H[k] = NEW("report.gradient", p->n, real);
    if (run->frame->mesh.points > 0) mesh_points_gradient(&run->frame->mesh, H);
#pragma omp parallel
    {
        struct neighbour_list near = {0};
#pragma omp for schedule(static)
        for (int64_t i = 0; i < p->n; i++)
            if (p->kind[i] == KIND_PD)
                gradient_of_bonds(&run->bonds, p, i, H);
            else if (!in_mesh(run->frame, i)) {
                particles_list_neighbours_within_radius(&near, &run->cells, p, i, NEAR_REACH * run->scene->spacing,
                                                        false);
                gradient_of_points(p, &run->source, &near, i, H);
            }
        memory_free(near.at);
    }
}

/* ---- plastic work and levels ------------------------------------------------------------------------------------- */

/* Returns the plastic work per volume of every particle, an array of p->n values [J/m^3]: the stored work of material
 * points, and for peridynamic particles the plastic work of their bonds, divided by the volume of the particle.
 * Returns NULL if nothing yields. The caller frees the array with memory_free. b: all bonds. */
static real *plastic_work_make(const struct particles *p, const struct bonds *b)
{
    if (!p->plastic_strain && !b->plastic_path) return NULL;
    real *work = NEW("report.plastic_work", p->n, real);
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < p->n; i++) {
        const bool bonds = p->kind[i] == KIND_PD && b->plastic_path && b->row_of[i] >= 0;
        if (bonds)
            work[i] = bond_row_plastic_work(b, b->row_of[i]) / p->volume0[i];
        else if (p->plastic_work)
            work[i] = p->plastic_work[i];
    }
    return work;
}

/* Returns the equivalent plastic strain of every particle, an array of p->n values [1]: that of material points, and
 * the mean plastic path of the bonds of peridynamic particles. Returns NULL if no bond can yield; frames then have the
 * stored strain. The caller frees the array with memory_free. */
static real *plastic_strain_make(const struct particles *p, const struct bonds *bonds)
{
    if (!bonds->plastic_path) return NULL;
    real *strain = NEW("report.plastic_strain", p->n, real);
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < p->n; i++)
        if (p->kind[i] == KIND_PD && bonds->row_of[i] >= 0)
            strain[i] = bond_row_plastic_path(bonds, bonds->row_of[i]);
        else if (p->plastic_strain)
            strain[i] = p->plastic_strain[i];
    return strain;
}

/* Returns the damage of every particle, an array of p->n values [1]: the volume fraction of its broken bonds, plus for
 * softening bonds the fraction of stiffness that they have lost. Returns NULL if no bond can soften; frames then have
 * the stored damage. The caller frees the array with memory_free. */
static real *damage_make(const struct particles *p, const struct bonds *bonds)
{
    if (!bonds->soft.curve) return NULL;
    real *damage = NEW("report.damage", p->n, real);
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < p->n; i++)
        damage[i] = p->damage[i] + bonds_row_softening_damage(bonds, p, bonds->row_of[i]);
    return damage;
}

/* Returns for every particle the ratio of its stress to its strength in the same direction of stress [1], according to
 * the strength surface of its material; 1 on the surface. The array has p->n values; the caller frees it with
 * memory_free. Returns NULL if no material has a strength surface. source: materials of the bonds b. */
static real *shares_make(const struct particles *p, const struct bonds *b, const struct bond_source *source)
{
    if (!b->soft.near) return NULL;
    real *share = NEW("report.share", p->n, real);
    bonds_compute_stress_to_strength_ratios(b, p, source, share);
    return share;
}

/* Returns for the points `shown`, which represent coarse cells in frames, the ratio of stress to strength [1],
 * according to the strength surface of the material (of scene s); 1 on the surface. The array has shown->n values; the
 * caller frees it with memory_free. */
static real *point_shares_make(const struct particles *shown, const struct scene *s)
{
    real *share = NEW("report.share", shown->n, real);
    for (int64_t i = 0; i < shown->n; i++)
        share[i] = particle_stress_to_strength_ratio(shown, s->material, s->space, i);
    return share;
}

/* Returns the coarsening level (0: finest) of the cell in the mesh of `frame` of every particle, an array [part->n]; 0
 * for particles outside meshes. The caller frees it with memory_free. */
static uint8_t *cell_levels_make(const struct lagrangian_mesh *frame, const struct particles *part)
{
    const struct mesh *mesh = &frame->mesh;
    uint8_t *level = NEW("report.level", part->n, uint8_t);
    for (int64_t i = 0; i < part->n && mesh->level; i++)
        if (in_mesh(frame, i)) level[i] = mesh->level[mesh->place[i] >> part->dim];
    return level;
}

/* Returns the coarsening level of every point that represents a coarse cell of `frame` in output, one entry per point.
 * The spacing doubles from level to level; level 0 has the spacing that the input file (scene) gives. The caller frees
 * the array with memory_free. */
static uint8_t *point_levels_make(const struct lagrangian_mesh *frame, const struct scene *scene)
{
    uint8_t *level = NEW("report.level", frame->shown.part.n, uint8_t);
    for (int64_t i = 0; i < frame->shown.part.n; i++)
        level[i] = (uint8_t)lround(log2(frame->shown.spacing[i] / scene->spacing));
    return level;
}

/* ---- a frame ----------------------------------------------------------------------------------------------------- */

/* Computes the fields of an output frame of the run that particles do not store (strain, density, plastic work, level
 * of cells) and stores pointers to them in *extra, from which the frame is written. requested_field_bits: set of these
 * fields, as bits ASK_... (output/output.h). Release them with frame_fields_free. */
void frame_fields_compute_requested(struct run *run, unsigned requested_field_bits, struct frame_extra *extra)
{
    extra->asked = requested_field_bits, extra->material = run->scene->material, extra->space = run->scene->space;
    if (requested_field_bits & (ASK_STRAIN | ASK_DENSITY)) gradients_make(run, extra->state.gradient);
    if (requested_field_bits & ASK_PLASTIC_WORK) extra->state.plastic_work = plastic_work_make(&run->part, &run->bonds);
    extra->state.plastic_strain = plastic_strain_make(&run->part, &run->bonds);
    extra->state.damage = damage_make(&run->part, &run->bonds);
    if (requested_field_bits & ASK_SHARE) extra->state.share = shares_make(&run->part, &run->bonds, &run->source);
    if (requested_field_bits & ASK_LEVEL) extra->state.level = cell_levels_make(run->frame, &run->part);
    if (!extra->more) return;
    for (int k = 0; k < DIM_MAX * DIM_MAX; k++) extra->more_state.gradient[k] = run->frame->shown.gradient[k];
    if (requested_field_bits & ASK_SHARE && run->bonds.soft.near)
        extra->more_state.share = point_shares_make(&run->frame->shown.part, run->scene);
    if (requested_field_bits & ASK_LEVEL) extra->more_state.level = point_levels_make(run->frame, run->scene);
}

void frame_fields_free(struct frame_extra *extra)
{
    for (int k = 0; k < DIM_MAX * DIM_MAX; k++) memory_free(extra->state.gradient[k]);
    memory_free(extra->state.plastic_work);
    memory_free(extra->state.plastic_strain);
    memory_free(extra->state.damage);
    memory_free(extra->state.share);
    memory_free(extra->more_state.share);
    memory_free(extra->state.level);
    memory_free(extra->more_state.level);
}
