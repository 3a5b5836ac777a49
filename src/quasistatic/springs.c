/* Assembles the linear stiffness of bonds, cells and contact as a sparse block matrix, and builds the preconditioner of
 * load steps from it. State-based models are stiffer than the springs of their bonds; the equilibrium is that of their
 * actual forces, and the matrix affects only the rate of convergence. */
#include <math.h>
#include <string.h>

#include "springs.h"
#include "unconstrained.h"
#include "unknowns.h"

#include "base/memory.h"
#include "contact/contact.h"
#include "mesh/mesh_part.h"
#include "solver/multigrid.h"

#define TINY 1e-30 /* a stretch in tension below all others [1] */

/* State of the assembly of the stiffness matrix a: a first pass counts the entries of each row, a second one stores
 * them. */
struct springs {
    const struct run *e;
    const int32_t *particle_at, *node_at; /* unknown of each particle and mesh node, -1: none */
    const int8_t (*sign)[DIM_MAX];        /* [nodes of the mesh] signs of mirror nodes; NULL: there are none */
    struct block_matrix *a;
    int64_t *next; /* [n] next entry of each row to be stored; NULL in the first pass */
};

/* Adds the block K[dim][dim] at the position `row`, `column` to the matrix s->a. In the first pass of the assembly, in
 * which s->next is NULL, the entry is only counted. */
static void entry_add(struct springs *s, int64_t row, int64_t column, const real K[DIM_MAX][DIM_MAX])
{
    const int dim = s->a->dim;
    if (!s->next) {
        s->a->first[row + 1]++;
        return;
    }
    const int64_t q = s->next[row]++;
    s->a->column[q] = (int32_t)column;
    for (int a = 0; a < dim; a++)
        for (int c = 0; c < dim; c++) s->a->block[q * dim * dim + a * dim + c] = (float)K[a][c];
}

/* ---- bonds ------------------------------------------------------------------------------------------------------- */

/* The unknowns on which the displacement of one particle depends, with their weights [1]. A peridynamic particle has an
 * unknown of its own, with the weight 1; a material point of the mesh has the nodes of its cell. */
struct movers {
    int n;
    int64_t node[CORNERS_MAX]; /* [n] unknowns */
    real share[CORNERS_MAX];   /* [n] weights [1] */
};

/* Returns the unknowns that determine the displacement of particle i of the body, with their weights: the unknown of
 * the particle itself, or for a point of the mesh those of the corners of its cell. The list is empty for a particle
 * whose displacement depends on no unknown. s: assembly of the stiffness matrix. */
static struct movers movers_list(const struct springs *s, int64_t i)
{
    struct movers m = {0};
    const struct mesh *mesh = &s->e->frame->mesh;
    if (s->particle_at[i] >= 0) return (struct movers){1, {s->particle_at[i]}, {1}};
    if (mesh->points == 0 || mesh->place[i] < 0) return m;
    const int dim = s->a->dim, place = mesh->place[i] & ((1 << dim) - 1);
    for (int c = 0; c < 1 << dim; c++) {
        const int32_t at = s->node_at[mesh_cell_corner_node(mesh, mesh->place[i] >> dim, c)];
        if (at >= 0) m.node[m.n] = at, m.share[m.n++] = mesh_shape_function_value(dim, c, place);
    }
    return m;
}

/* Returns the unknowns that determine the displacement of particle or mirror image i, with their weights. sign[d]:
 * receives -1 if component d of an image moves opposite to that of the particle that it mirrors, else 1. s: assembly of
 * the stiffness matrix. */
static struct movers movers_of_end(const struct springs *s, int64_t i, real sign[DIM_MAX])
{
    mirror_image_compute_displacement_signs(&s->e->part, &s->e->loads, i, sign);
    return movers_list(s, mirror_image_source_particle(&s->e->part, s->e->loads.image, i));
}

/* Adds the stiffness of `bond`, a bond of particle i, to the matrix s->a, in the rows of the unknowns that determine
 * the displacement of i. The bond counts as a spring along its reference direction, with its stiffness in tension. The
 * row of the other particle of the bond adds the other half. */
static void spring_add(struct springs *s, int64_t i, const struct bond *bond)
{
    const struct particles *p = &s->e->part;
    real n[DIM_MAX] = {0}, K[DIM_MAX][DIM_MAX], sign[DIM_MAX];
    const struct movers own = movers_list(s, i), other = movers_of_end(s, bond->nbr, sign);
    const real kept = bond_remaining_stiffness_fraction(&s->e->bonds, s->e->bonds.row_of[i] / LANES, bond->entry, TINY);
    for (int d = 0; d < p->dim; d++) n[d] = (p->X[d][bond->nbr] - p->X[d][i]) * bond->inverse_length;
    for (int k = 0; k < own.n; k++) {
        const real stiffness = s->e->bonds.stiffness * bond->w * kept * bond->inverse_length * own.share[k] *
                               s->e->statics->weight[own.node[k]];
        for (int m = 0; m < own.n + other.n; m++) {
            const bool here = m < own.n;
            const real share = here ? own.share[m] : -other.share[m - own.n];
            for (int a = 0; a < p->dim; a++)
                for (int c = 0; c < p->dim; c++) K[a][c] = stiffness * share * n[a] * n[c] * (here ? 1 : sign[c]);
            entry_add(s, own.node[k], here ? own.node[m] : other.node[m - own.n], K);
        }
    }
}

/* Adds the stiffness of the intact bonds in row r of bonds (all bonds of one particle) to the matrix s->a. */
static void springs_row_add(struct springs *s, int64_t r)
{
    for (struct bond_iterator it = bond_iterator_of_row(&s->e->bonds, r); bond_iterator_advance(&it);)
        if (it.bond.w != 0) spring_add(s, s->e->bonds.particle[r], &it.bond);
}

/* ---- contact ----------------------------------------------------------------------------------------------------- */

/* Adds the stiffness of contact t to the matrix: the stiffness of the contact times the products of the derivatives of
 * its gap by the displacements. Called for each active contact. context: the assembly of the matrix (struct springs).
 */
static void contact_add_spring(void *context, const struct contact_term *t)
{
    struct springs *s = context;
    const int dim = s->a->dim;
    real K[DIM_MAX][DIM_MAX], sign[DIM_MAX], back[DIM_MAX];
    for (int i = 0; i < t->n; i++) {
        const struct movers own = movers_of_end(s, t->particle[i], sign);
        for (int j = 0; j < t->n; j++) {
            const struct movers other = movers_of_end(s, t->particle[j], back);
            for (int k = 0; k < own.n; k++)
                for (int m = 0; m < other.n; m++) {
                    const real share = own.share[k] * other.share[m] * s->e->statics->weight[own.node[k]];
                    for (int a = 0; a < dim; a++)
                        for (int c = 0; c < dim; c++)
                            K[a][c] = t->stiffness * share * sign[a] * t->along[i][a] * back[c] * t->along[j][c];
                    entry_add(s, own.node[k], other.node[m], K);
                }
        }
    }
}

/* ---- cells ------------------------------------------------------------------------------------------------------- */

/* Adds the stiffness of cell I of the mesh to the matrix s->a. */
static void cell_add(struct springs *s, int64_t I)
{
    const struct mesh *mesh = &s->e->frame->mesh;
    const int dim = s->a->dim, corners = 1 << dim, n = corners * dim;
    real K[CELL_UNKNOWNS_MAX * CELL_UNKNOWNS_MAX];
    if (!mesh_compute_cell_stiffness(mesh, s->e->frame->elastic, &s->e->part, I, K)) return;
    for (int c = 0; c < corners; c++)
        for (int b = 0; b < corners; b++) {
            const int64_t row = mesh_cell_corner_node(mesh, I, c), column = mesh_cell_corner_node(mesh, I, b);
            real block[DIM_MAX][DIM_MAX];
            if (s->node_at[row] < 0 || s->node_at[column] < 0) continue;
            for (int a = 0; a < dim; a++)
                for (int d = 0; d < dim; d++) {
                    block[a][d] = K[(b * dim + d) * n + c * dim + a];
                    if (s->sign) block[a][d] *= s->sign[row][a] * s->sign[column][d];
                }
            entry_add(s, s->node_at[row], s->node_at[column], block);
        }
}

/* ---- the matrix -------------------------------------------------------------------------------------------------- */

/* Adds all bonds, cells and contacts to the matrix s->a. Rows of peridynamic particles are filled in parallel, as each
 * belongs to one row of bonds; rows of mesh nodes in sequence. */
static void springs_visit(struct springs *s)
{
    const struct bonds *b = &s->e->bonds;
    const struct mesh *mesh = &s->e->frame->mesh;
#pragma omp parallel for schedule(static)
    for (int64_t r = 0; r < b->rows; r++)
        if (s->particle_at[b->particle[r]] >= 0) springs_row_add(s, r);
    for (int64_t r = 0; r < b->rows; r++)
        if (s->particle_at[b->particle[r]] < 0) springs_row_add(s, r);
    for (int64_t I = 0; mesh->points > 0 && I < mesh->grid.n; I++)
        if (mesh_cell_contains_material(mesh, I)) cell_add(s, I);
    contact_visit_linear_springs(s->e->contact, &s->e->part, contact_add_spring, s);
}

/* Sorts the entries first .. end - 1 of a row of the matrix a by column and adds up entries of one column. Returns the
 * number of entries that remain. */
static int64_t row_sort(struct block_matrix *a, int64_t first, int64_t end)
{
    const int size = a->dim * a->dim;
    int64_t kept = first;
    for (int64_t q = first; q < end; q++) {
        const int32_t column = a->column[q];
        float block[DIM_MAX * DIM_MAX];
        int64_t at = kept;
        array_copy(block, a->block + q * size, size, sizeof(float));
        while (at > first && a->column[at - 1] >= column) at--;
        if (at < kept && a->column[at] == column) {
            for (int k = 0; k < size; k++) a->block[at * size + k] += block[k];
            continue;
        }
        array_copy(a->column + at + 1, a->column + at, kept - at, sizeof *a->column);
        array_copy(a->block + (at + 1) * size, a->block + at * size, (kept - at) * size, sizeof(float));
        a->column[at] = column;
        array_copy(a->block + at * size, block, size, sizeof(float));
        kept++;
    }
    return kept - first;
}

/* Closes the gaps between the rows of the matrix a that remain after entries of one column have been added up, and
 * updates a->first. kept[a->n]: number of remaining entries of each row. */
static void rows_close(struct block_matrix *a, const int64_t *kept)
{
    const int size = a->dim * a->dim;
    int64_t to = 0;
    for (int64_t row = 0; row < a->n; row++) {
        const int64_t from = a->first[row];
        array_copy(a->column + to, a->column + from, kept[row], sizeof *a->column);
        array_copy(a->block + to * size, a->block + from * size, kept[row] * size, sizeof(float));
        a->first[row] = to;
        to += kept[row];
    }
    a->first[a->n] = to;
}

/* Assembles the matrix s->a in two passes: the first one counts the entries of each row, the second one stores them.
 * Allocates the arrays of the matrix. */
static void matrix_fill(struct springs *s)
{
    struct block_matrix *a = s->a;
    const real none[DIM_MAX][DIM_MAX] = {{0}};
    a->first = NEW("springs.first", a->n + 1, int64_t);
    for (int64_t k = 0; k < a->n; k++) entry_add(s, k, k, none); /* a diagonal entry also for unconstrained nodes */
    springs_visit(s);
    for (int64_t k = 0; k < a->n; k++) a->first[k + 1] += a->first[k];
    a->column = BARE("springs.column", a->first[a->n], int32_t);
    a->block = BARE("springs.block", a->first[a->n] * a->dim * a->dim, float);
    s->next = BARE("springs.next", a->n, int64_t);
    array_copy(s->next, a->first, a->n, sizeof *s->next);
    for (int64_t k = 0; k < a->n; k++) entry_add(s, k, k, none);
    springs_visit(s);
#pragma omp parallel for schedule(static)
    for (int64_t k = 0; k < a->n; k++) s->next[k] = row_sort(a, a->first[k], a->first[k + 1]);
    rows_close(a, s->next);
    memory_free(s->next);
}

/* Divides all entries of the matrix a by the largest absolute entry, since single precision overflows with products of
 * large stiffnesses. The conjugate gradient method does not depend on the scale of its preconditioner. */
static void matrix_scale(struct block_matrix *a)
{
    const int64_t n = a->first[a->n] * a->dim * a->dim;
    float most = 0;
    for (int64_t k = 0; k < n; k++) most = fmaxf(most, fabsf(a->block[k]));
    for (int64_t k = 0; k < n && most > 0; k++) a->block[k] /= most;
}

/* Returns the stiffness matrix of the present bonds, cells and contacts of the run, divided by its largest entry.
 * statics_preconditioner_free frees it. */
static struct block_matrix *matrix_make(const struct run *run)
{
    const struct statics *s = run->statics;
    const struct mesh *mesh = &run->frame->mesh;
    const int64_t nodes = mesh->points > 0 ? mesh->grid.n : 0;
    int32_t *particle_at = BARE("springs.particle_at", run->part.n, int32_t);
    int32_t *node_at = BARE("springs.node_at", nodes, int32_t);
    int8_t(*sign)[DIM_MAX] =
        mesh->points > 0 && mesh->grid.mirror_nodes > 0 ? memory_new("springs.sign", nodes, sizeof *sign) : NULL;
    struct block_matrix *a = NEW("springs.matrix", 1, struct block_matrix);
    a->dim = run->part.dim, a->n = s->balance.n;
    array_fill_bytes(particle_at, -1, run->part.n, sizeof *particle_at);
    array_fill_bytes(node_at, -1, nodes, sizeof *node_at);
    for (int64_t k = 0; k < a->n; k++) (k < s->particles ? particle_at : node_at)[s->node[k]] = (int32_t)k;
    for (int64_t I = 0; sign && I < nodes; I++) memset(sign[I], 1, sizeof sign[I]);
    for (int64_t k = 0; sign && k < mesh->grid.mirror_nodes; k++) {
        const struct mirror_node *m = &mesh->grid.mirror_node[k];
        node_at[m->node] = node_at[m->image];
        memcpy(sign[m->node], m->sign, sizeof m->sign);
    }
    struct springs springs = {run, particle_at, node_at, (const int8_t(*)[DIM_MAX])sign, a, NULL};
    matrix_fill(&springs);
    matrix_scale(a);
    memory_free(particle_at);
    memory_free(node_at);
    memory_free(sign);
    return a;
}

/* ---- the preconditioner ------------------------------------------------------------------------------------------ */

/* Frees the preconditioner of the load steps s, if there is one. */
void statics_preconditioner_free(struct statics *s)
{
    if (s->precondition) multigrid_free(s->precondition);
    s->precondition = NULL;
    if (!s->matrix) return;
    memory_free(s->matrix->first);
    memory_free(s->matrix->column);
    memory_free(s->matrix->block);
    memory_free(s->matrix);
    s->matrix = NULL;
}

void statics_preconditioner_make(struct run *run)
{
    struct statics *s = run->statics;
    real *place[DIM_MAX] = {0};
    s->matrix = matrix_make(run);
    for (int d = 0; d < run->part.dim; d++) place[d] = BARE("springs.place", s->balance.n, real);
    for (int64_t k = 0; k < s->balance.n; k++) {
        real X[DIM_MAX];
        unknown_compute_reference_position(s, &run->part, &run->frame->mesh, k, X);
        for (int d = 0; d < run->part.dim; d++) place[d][k] = X[d];
    }
    multigrid_make(&s->precondition, s->matrix, place, s->balance.held);
    for (int d = 0; d < run->part.dim; d++) memory_free(place[d]);
    s->directions = 0, s->precondition_stale = false;
}

void statics_preconditioner_apply(void *run, const struct field *residual, struct field *result)
{
    struct run *e = run;
    if (!e->statics->precondition) statics_preconditioner_make(e);
    multigrid_apply_v_cycle(e->statics->precondition, residual->of, result->of);
    field_remove_free_rigid_motion(e->statics, result);
}

/* Frees the preconditioner of s, so that it is rebuilt, if the last solution needed far more search directions than the
 * first one with this preconditioner: more than 1.5 times as many plus 8. search_directions: number of directions of
 * the last solution. */
void statics_preconditioner_free_if_inefficient(struct statics *s, int64_t search_directions)
{
    if (!s->precondition) return;
    if (s->directions == 0)
        s->directions = search_directions;
    else if (2 * search_directions > 3 * s->directions + 16)
        statics_preconditioner_free(s);
}
