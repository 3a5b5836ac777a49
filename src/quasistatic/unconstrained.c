/* Finds fragments of a body that are not fully constrained in load steps, and their free rigid motions.
 *
 * Such a fragment has no equilibrium under unbalanced loads, and no unique one under balanced loads. Its free rigid
 * motions are kept constant: components of the forces along them are removed (as inertia would balance them), and so
 * are components of the displacements that the preconditioner proposes. The deformation of the fragment remains. */
#include <math.h>
#include <string.h>

#include "unconstrained.h"
#include "unknowns.h"

#include "base/memory.h"
#include "contact/contact.h"
#include "mesh/mesh_part.h"

#define HELD_LEAST 1e-9    /* smallest resistance of a constrained motion, relative to the largest */
#define RESISTS_LEAST 1e-8 /* smallest rate of a gap under a unit motion that is not round-off [1] */
#define SLIDES_MOST 1e-3   /* see sliding_update: the square of a slope of faces of 2 degrees; a judgement */
#define DROPPED 1e-6       /* relative norm of the rest of a motion below which it depends linearly on previous ones */
#define ROUND_OFF 1e-9     /* coordinate of a centre divided by the radius of the fragment, below which it is 0 [1] */

/* ---- connected components ---------------------------------------------------------------------------------------- */

/* Returns the root of node k in the union-find forest parent[nodes], and shortens the path to it. */
static int32_t root_node(int32_t *parent, int32_t k)
{
    while (parent[k] != k) k = parent[k] = parent[parent[k]];
    return k;
}

/* Joins the components of nodes a and b in the forest parent[nodes]. The smaller root becomes the root of both, so that
 * the result does not depend on the order of joins. */
static void nodes_join(int32_t *parent, int32_t a, int32_t b)
{
    const int32_t x = root_node(parent, a), y = root_node(parent, b);
    if (x < y) parent[y] = x;
    if (y < x) parent[x] = y;
}

/* The search for unconstrained fragments: the parts of the run that it reads (borrowed), and its results. */
struct search {
    const struct statics *statics;
    const struct particles *part;
    const struct mesh *mesh;
    const struct loads *loads;
    int32_t *particle, *node;    /* unknown of each particle and of each node of the mesh, -1: none */
    struct field x;              /* [unknowns] present positions [m] */
    int32_t *parent, *fragment;  /* [unknowns] parent in the forest of joined unknowns; number of the fragment */
    int64_t n;                   /* number of fragments */
    struct candidate *candidate; /* [n] the fragments */
};

/* Joins the unknowns (nodes) at the corners of each cell of the mesh of s to one connected component, in the
 * union-find forest s->parent. */
static void cells_join(const struct search *s)
{
    const struct mesh *mesh = s->mesh;
    for (int64_t I = 0; I < mesh->grid.n && mesh->points > 0; I++) {
        int32_t first = -1;
        if (!mesh_cell_contains_material(mesh, I)) continue;
        for (int c = 0; c < 1 << s->part->dim; c++) {
            const int32_t k = s->node[mesh_cell_corner_node(mesh, I, c)];
            if (k < 0) continue;
            if (first < 0) first = k;
            nodes_join(s->parent, first, k);
        }
    }
}

/* Returns the index of the unknown that moves particle i of the search s: its own, or for a point of the mesh that of
 * one corner of its cell; -1 if the particle moves with no unknown. */
static int32_t unknown_of(const struct search *s, int64_t i)
{
    const struct mesh *mesh = s->mesh;
    const int dim = s->part->dim;
    if (s->particle[i] >= 0 || mesh->points == 0 || mesh->place[i] < 0) return s->particle[i];
    for (int c = 0; c < 1 << dim; c++) {
        const int32_t k = s->node[mesh_cell_corner_node(mesh, mesh->place[i] >> dim, c)];
        if (k >= 0) return k;
    }
    return -1;
}

/* Joins the connected components, in the union-find forest s->parent, of the two particles of each intact bond in
 * `bonds`. */
static void bonded_join(const struct search *s, const struct bonds *bonds)
{
    for (int64_t r = 0; r < bonds->rows; r++) {
        const int32_t a = unknown_of(s, bonds->particle[r]);
        for (struct bond_iterator it = bond_iterator_of_row(bonds, r); bond_iterator_advance(&it);) {
            if (it.bond.w == 0 || it.bond.nbr >= s->part->n || it.bond.nbr < bonds->particle[r]) continue;
            const int32_t b = unknown_of(s, it.bond.nbr);
            if (a >= 0 && b >= 0) nodes_join(s->parent, a, b);
        }
    }
}

/* Stores in s the index of the unknown of each particle and mesh node; a mirror node (a node beyond a plane of
 * symmetry) has that of the node of which it is the image. */
static void unknowns_number(struct search *s)
{
    const struct statics *statics = s->statics;
    const struct mesh *mesh = s->mesh;
    const int64_t places = mesh->points > 0 ? mesh->grid.n : 0, n = s->part->n;
    s->particle = BARE("pieces.particle", n, int32_t), s->node = BARE("pieces.node", places, int32_t);
    array_fill_bytes(s->particle, -1, n, sizeof *s->particle);
    array_fill_bytes(s->node, -1, places, sizeof *s->node);
    for (int64_t k = 0; k < statics->balance.n; k++)
        (k < statics->particles ? s->particle : s->node)[statics->node[k]] = (int32_t)k;
    for (int64_t k = 0; k < places && k < mesh->grid.mirror_nodes; k++)
        s->node[mesh->grid.mirror_node[k].node] = s->node[mesh->grid.mirror_node[k].image];
}

/* Allocates the arrays of s, a search for unconstrained fragments, and stores the present positions of the nodes.
 * Release them with unconstrained_search_end. */
static void unconstrained_search_begin(struct search *s)
{
    const int64_t n = s->statics->balance.n;
    unknowns_number(s);
    s->parent = BARE("pieces.parent", n, int32_t);
    s->fragment = BARE("pieces.fragment", n, int32_t);
    for (int d = 0; d < s->part->dim; d++) s->x.of[d] = BARE("pieces.x", n, real);
    for (int64_t k = 0; k < n; k++) {
        real X[DIM_MAX];
        unknown_compute_reference_position(s->statics, s->part, s->mesh, k, X);
        for (int d = 0; d < s->part->dim; d++) s->x.of[d][k] = X[d] + s->statics->balance.u.of[d][k];
        s->parent[k] = (int32_t)k;
    }
}

/* Frees the storage of a search. */
static void unconstrained_search_end(struct search *s)
{
    for (int d = 0; d < s->part->dim; d++) memory_free(s->x.of[d]);
    memory_free(s->candidate);
    memory_free(s->parent);
    memory_free(s->fragment);
    memory_free(s->particle);
    memory_free(s->node);
}

/* ---- constraints ------------------------------------------------------------------------------------------------- */

/* A connected fragment of the body during the search for unconstrained ones: its geometry, and the resistance of
 * supports, bonds and contact to its rigid motions. It is owned by struct search. */
struct candidate {
    real centre[DIM_MAX];                    /* mean position of its nodes [m] */
    real moved[DIM_MAX];                     /* mean displacement of its nodes [m] */
    real radius;                             /* root mean square distance of its nodes from the centre [m] */
    real resistance[MODES_MOST][MODES_MOST]; /* sum over constraints of the product of two motions along them [1] */
    bool touches;                            /* it is in contact with another fragment or a rigid body */
    int64_t n;                               /* number of its nodes */
};

/* Returns the number of rigid motions in a body of dimension dim. */
static int motions(int dim) { return dim * (dim + 1) / 2; }

/* Computes u[dim], the displacement at the point x[dim] [m] by rigid motion number k (0 .. motions(dim) - 1) of
 * fragment c: unit translations first, then rotations about its centre, scaled such that the nodes of the fragment move
 * by about 1, or 0 for a fragment of one point. */
static void motion_at(const struct candidate *c, int dim, int k, const real *x, real *u)
{
    for (int d = 0; d < dim; d++) u[d] = d == k;
    if (k < dim || c->radius == 0) return;
    const int a = dim == 2 ? 0 : (k - dim + 1) % 3, b = dim == 2 ? 1 : (k - dim + 2) % 3;
    u[a] = -(x[b] - c->centre[b]) / c->radius;
    u[b] = (x[a] - c->centre[a]) / c->radius;
}

/* Copies the present position of the unknown k of s (a particle or a mesh node) to x[dim] [m]. */
static void node_now(const struct search *s, int64_t k, real *x)
{
    for (int d = 0; d < s->part->dim; d++) x[d] = s->x.of[d][k];
}

/* Adds a constrained displacement component of a node to fragment c, by adding a a^T to the matrix
 * c->resistance[m][m]. along[m]: the vector a, the component in the constrained direction of each of the m rigid
 * motions of the fragment. Rigid motions in the null space of the final matrix are unconstrained. */
static void resist(struct candidate *c, int m, const real *along)
{
    for (int a = 0; a < m; a++)
        for (int b = 0; b < m; b++) c->resistance[a][b] += along[a] * along[b];
}

/* Adds the constraints by supports and planes of symmetry to the resistance matrices of the fragments in s on which
 * they act. */
static void supports_resist(const struct search *s)
{
    const struct newton_solver *newton = &s->statics->balance;
    const int dim = s->part->dim, m = motions(dim);
    for (int64_t k = 0; k < newton->n; k++) {
        real x[DIM_MAX], u[MODES_MOST][DIM_MAX], along[MODES_MOST];
        struct candidate *c = &s->candidate[s->fragment[k]];
        if (!newton->held[k]) continue;
        node_now(s, k, x);
        for (int a = 0; a < m; a++) motion_at(c, dim, a, x, u[a]);
        for (int d = 0; d < dim; d++) {
            if (!(newton->held[k] >> d & 1)) continue;
            for (int a = 0; a < m; a++) along[a] = u[a][d];
            resist(c, m, along);
        }
    }
}

/* Adds to the resistance matrix of fragment c the constraint of a bond between its particle i and the mirror image
 * `image`: the bond resists a change of its length. s: search for unconstrained fragments. */
static void image_resists(const struct search *s, struct candidate *c, int64_t i, int64_t image)
{
    const struct particles *p = s->part;
    const int dim = p->dim, m = motions(dim);
    const int64_t j = mirror_image_source_particle(p, s->loads->image, image);
    real sign[DIM_MAX], x[DIM_MAX], y[DIM_MAX], u[DIM_MAX], v[DIM_MAX], along[MODES_MOST] = {0}, length2 = 0;
    for (int d = 0; d < dim; d++) x[d] = p->x[d][i], y[d] = p->x[d][j], length2 += square(p->x[d][image] - p->x[d][i]);
    mirror_image_compute_displacement_signs(p, s->loads, image, sign);
    for (int a = 0; a < m; a++) {
        motion_at(c, dim, a, x, u);
        motion_at(c, dim, a, y, v);
        for (int d = 0; d < dim; d++)
            along[a] += (p->x[d][image] - p->x[d][i]) / sqrt(length2) * (u[d] - sign[d] * v[d]);
    }
    resist(c, m, along);
}

/* Adds the constraints by all `bonds` between particles and mirror images to the fragments of these particles in s. */
static void images_resist(const struct search *s, const struct bonds *bonds)
{
    for (int64_t r = 0; r < bonds->rows && s->loads->images > 0; r++) {
        const int32_t i = bonds->particle[r], k = unknown_of(s, i);
        for (struct bond_iterator it = bond_iterator_of_row(bonds, r); bond_iterator_advance(&it) && k >= 0;)
            if (it.bond.w != 0 && it.bond.nbr >= s->part->n)
                image_resists(s, &s->candidate[s->fragment[k]], i, it.bond.nbr);
    }
}

/* Adds the constraints of mirror nodes of the mesh (nodes beyond a plane of symmetry) to the resistance matrices of
 * their fragments in s: such a node is a corner of cells of the body, but moves as the mirror image of another node. */
static void mirror_nodes_resist(const struct search *s)
{
    const struct mesh *mesh = s->mesh;
    const int dim = s->part->dim, m = motions(dim);
    for (int64_t q = 0; mesh->points > 0 && q < mesh->grid.mirror_nodes; q++) {
        const struct mirror_node *node = &mesh->grid.mirror_node[q];
        const int32_t k = s->node[node->image];
        real x[DIM_MAX], y[DIM_MAX], u[DIM_MAX], v[DIM_MAX], along[DIM_MAX][MODES_MOST];
        if (k < 0 || !(mesh->grid.mass[node->node] > 0)) continue;
        for (int d = 0; d < dim; d++) {
            const int64_t stride = mesh->grid.stride[d], count = mesh->grid.count[d];
            x[d] = grid_node_position(&mesh->grid, d, node->node / stride % count) + mesh->displacement[d][node->node];
            y[d] =
                grid_node_position(&mesh->grid, d, node->image / stride % count) + mesh->displacement[d][node->image];
        }
        for (int a = 0; a < m; a++) {
            motion_at(&s->candidate[s->fragment[k]], dim, a, x, u);
            motion_at(&s->candidate[s->fragment[k]], dim, a, y, v);
            for (int d = 0; d < dim; d++) along[d][a] = u[d] - node->sign[d] * v[d];
        }
        for (int d = 0; d < dim; d++) resist(&s->candidate[s->fragment[k]], m, along[d]);
    }
}

/* Returns the number (from 0) of the fragment of a particle or mirror image in the search s, -1 if it has no
 * unknown. */
static int32_t fragment_of(const struct search *s, int32_t particle)
{
    const int32_t k = unknown_of(s, mirror_image_source_particle(s->part, s->loads->image, particle));
    return k < 0 ? -1 : s->fragment[k];
}

/* Returns the rate at which rigid motion number a of fragment `which` changes the gap of contact t: change of the gap
 * divided by the size of the motion [1]. s: search for unconstrained fragments. */
static real gap_rate(const struct search *s, const struct contact_term *t, int32_t which, int a)
{
    const struct particles *p = s->part;
    real rate = 0;
    for (int q = 0; q < t->n; q++) {
        const int64_t i = mirror_image_source_particle(p, s->loads->image, t->particle[q]);
        real sign[DIM_MAX], x[DIM_MAX], u[DIM_MAX];
        if (fragment_of(s, t->particle[q]) != which) continue;
        for (int d = 0; d < p->dim; d++) x[d] = p->x[d][i];
        mirror_image_compute_displacement_signs(p, s->loads, t->particle[q], sign);
        motion_at(&s->candidate[which], p->dim, a, x, u);
        for (int d = 0; d < p->dim; d++) rate += sign[d] * t->along[q][d] * u[d];
    }
    return rate;
}

/* Adds contact t, which resists a change of its gap, as a constraint to the resistance matrix of each fragment that it
 * touches, as if the other body were fixed. context: the search for unconstrained fragments (struct search). Called
 * for each active contact. */
static void contact_resists(void *context, const struct contact_term *t)
{
    const struct search *s = context;
    const int dim = s->part->dim, m = motions(dim);
    real length2 = 0, along[MODES_MOST];
    for (int q = 0; q < t->n; q++) length2 += dot(t->along[q], t->along[q], dim);
    for (int q = 0; q < t->n && length2 > 0; q++) {
        const int32_t which = fragment_of(s, t->particle[q]);
        bool seen = which < 0;
        for (int b = 0; b < q && !seen; b++) seen = fragment_of(s, t->particle[b]) == which;
        if (seen) continue;
        for (int a = 0; a < m; a++) {
            along[a] = gap_rate(s, t, which, a) / sqrt(length2);
            if (fabs(along[a]) < RESISTS_LEAST) along[a] = 0; /* both faces belong to the same fragment */
            s->candidate[which].touches |= along[a] != 0;
        }
        resist(&s->candidate[which], m, along);
    }
}

/* Finds the rigid motions of fragment c that no constraint resists: the null space of c->resistance[m][m], by
 * elimination with full pivoting. free[][m]: receives each of them as coefficients of the m rigid motions. Returns
 * their number. */
static int motions_free(const struct candidate *c, int m, real free[MODES_MOST][MODES_MOST])
{
    real R[MODES_MOST][MODES_MOST], most = 0;
    int order[MODES_MOST], held = 0;
    memcpy(R, c->resistance, sizeof R);
    for (int a = 0; a < m; a++) order[a] = a, most = real_max(most, R[a][a]);
    for (; held < m; held++) {
        int pivot = held;
        for (int a = held; a < m; a++)
            if (R[order[a]][order[a]] > R[order[pivot]][order[pivot]]) pivot = a;
        const int at = order[pivot];
        if (!(R[at][at] > HELD_LEAST * most)) break;
        order[pivot] = order[held], order[held] = at;
        for (int b = 0; b < m; b++) {
            const real share = R[b][at] / R[at][at];
            for (int k = 0; k < m && b != at; k++) R[b][k] -= share * R[at][k];
        }
    }
    for (int f = held; f < m; f++)
        for (int a = 0; a < m; a++) free[f - held][a] = a == order[f];
    for (int f = held; f < m; f++)
        for (int a = 0; a < held; a++) free[f - held][order[a]] = -R[order[a]][order[f]] / R[order[a]][order[a]];
    return m - held;
}

/* ---- free motions ------------------------------------------------------------------------------------------------ */

/* Returns the scalar product of the free motions number a and b of fragment f, summed over its nodes. dim: number of
 * components. */
static real motion_dot(const struct unconstrained_fragment *f, int dim, int a, int b)
{
    real sum = 0;
    for (int64_t q = 0; q < f->n * dim; q++) sum += f->motion[q * MODES_MOST + a] * f->motion[q * MODES_MOST + b];
    return sum;
}

/* Orthonormalises the free motions of fragment f over its nodes by the Gram-Schmidt method with reorthogonalisation.
 * Drops linearly dependent motions. dim: number of components. */
static void motions_orthonormal(struct unconstrained_fragment *f, int dim)
{
    int kept = 0;
    for (int a = 0; a < f->motions; a++) {
        const real norm = sqrt(motion_dot(f, dim, a, a));
        for (int twice = 0; twice < 2; twice++)
            for (int b = 0; b < kept; b++) {
                const real share = motion_dot(f, dim, a, b);
                for (int64_t q = 0; q < f->n * dim; q++)
                    f->motion[q * MODES_MOST + a] -= share * f->motion[q * MODES_MOST + b];
            }
        const real left = sqrt(motion_dot(f, dim, a, a));
        if (!(left > DROPPED * norm)) continue;
        for (int64_t q = 0; q < f->n * dim; q++)
            f->motion[q * MODES_MOST + kept] = f->motion[q * MODES_MOST + a] / left;
        kept++;
    }
    f->motions = kept;
}

/* Initialises f as fragment number `which` of the search s: lists its nodes and computes their displacements in its
 * free motions, orthonormal. free[count][m]: the free motions (rigid motions that nothing resists) as coefficients of
 * the m rigid motions. */
static void fragment_motions(const struct search *s, struct unconstrained_fragment *f, int64_t which,
                             real free[MODES_MOST][MODES_MOST], int count)
{
    const struct candidate *c = &s->candidate[which];
    const int dim = s->part->dim, m = motions(dim);
    *f = (struct unconstrained_fragment){.n = 0, .motions = count};
    f->node = BARE("pieces.node", c->n, int32_t);
    f->motion = NEW("pieces.motion", c->n * dim * MODES_MOST, real);
    for (int64_t k = 0; k < s->statics->balance.n; k++) {
        real x[DIM_MAX], u[DIM_MAX];
        if (s->fragment[k] != which) continue;
        node_now(s, k, x);
        for (int a = 0; a < m; a++) {
            motion_at(c, dim, a, x, u);
            for (int b = 0; b < count; b++)
                for (int d = 0; d < dim; d++)
                    if (!(s->statics->balance.held[k] >> d & 1))
                        f->motion[(f->n * dim + d) * MODES_MOST + b] += free[b][a] * u[d];
        }
        f->node[f->n++] = (int32_t)k;
    }
    motions_orthonormal(f, dim);
    for (int d = 0; d < dim; d++) {
        const real middle = c->centre[d] - c->moved[d];
        f->middle[d] = fabs(middle) > ROUND_OFF * c->radius ? middle : 0;
    }
}

/* Numbers the connected components of s, the fragments, in the order of their first nodes, stores the number for each
 * node in s->fragment, and computes centres and radii of the fragments in s->candidate, which unconstrained_search_end
 * releases. */
static void fragment_candidates_find(struct search *s)
{
    const int64_t nodes = s->statics->balance.n;
    const int dim = s->part->dim;
    for (int64_t k = 0; k < nodes; k++) /* a root has a smaller number than its nodes */
        s->fragment[k] = s->parent[k] == k ? (int32_t)s->n++ : s->fragment[root_node(s->parent, (int32_t)k)];
    s->candidate = NEW("pieces.candidates", s->n, struct candidate);
    for (int64_t k = 0; k < nodes; k++) {
        struct candidate *c = &s->candidate[s->fragment[k]];
        c->n++;
        for (int d = 0; d < dim; d++) c->centre[d] += s->x.of[d][k], c->moved[d] += s->statics->balance.u.of[d][k];
    }
    for (int64_t q = 0; q < s->n; q++)
        for (int d = 0; d < dim; d++)
            s->candidate[q].centre[d] /= (real)s->candidate[q].n, s->candidate[q].moved[d] /= (real)s->candidate[q].n;
    for (int64_t k = 0; k < nodes; k++) {
        struct candidate *c = &s->candidate[s->fragment[k]];
        for (int d = 0; d < dim; d++) c->radius += square(s->x.of[d][k] - c->centre[d]);
    }
    for (int64_t q = 0; q < s->n; q++) s->candidate[q].radius = sqrt(s->candidate[q].radius / (real)s->candidate[q].n);
}

/* Updates slid[d] [m], the largest distance by which fragments in contact have slid along axis d, by the mean
 * displacement of fragment c. Counts only axes along which contact and supports resist a translation of c with less
 * than SLIDES_MOST times the resistance along another axis. dim: number of axes. */
static void sliding_update(const struct candidate *c, int dim, real *slid)
{
    real most = 0;
    for (int a = 0; a < dim && c->touches; a++) most = real_max(most, c->resistance[a][a]);
    for (int a = 0; a < dim; a++)
        if (c->resistance[a][a] < SLIDES_MOST * most) slid[a] = real_max(slid[a], fabs(c->moved[a]));
}

void unconstrained_fragments_find(struct run *run)
{
    struct statics *s = run->statics;
    const int m = motions(run->part.dim);
    struct search search = {.statics = s, .part = &run->part, .mesh = &run->frame->mesh, .loads = &run->loads};
    real free[MODES_MOST][MODES_MOST];
    unconstrained_fragments_free(s);
    s->fragments_stale = false, s->mesh = search.mesh;
    unconstrained_search_begin(&search);
    cells_join(&search);
    bonded_join(&search, &run->bonds);
    fragment_candidates_find(&search);
    supports_resist(&search);
    images_resist(&search, &run->bonds);
    mirror_nodes_resist(&search);
    contact_visit_linear_springs(run->contact, &run->part, contact_resists, &search);
    for (int64_t q = 0; q < search.n; q++) {
        s->fragments += motions_free(&search.candidate[q], m, free) > 0;
        sliding_update(&search.candidate[q], run->part.dim, s->slid);
    }
    s->fragment = NEW("pieces.free", s->fragments, struct unconstrained_fragment);
    s->fragments = 0;
    for (int64_t q = 0; q < search.n; q++) {
        const int count = motions_free(&search.candidate[q], m, free);
        if (count > 0) fragment_motions(&search, &s->fragment[s->fragments++], q, free, count);
    }
    unconstrained_search_end(&search);
}

void unconstrained_fragments_free(struct statics *s)
{
    for (int64_t q = 0; q < s->fragments; q++) memory_free(s->fragment[q].node), memory_free(s->fragment[q].motion);
    memory_free(s->fragment);
    s->fragment = NULL, s->fragments = 0;
}

void field_remove_free_rigid_motion(const struct statics *s, struct field *v)
{
    const int dim = s->balance.dim;
#pragma omp parallel for schedule(dynamic)
    for (int64_t q = 0; q < s->fragments; q++) {
        const struct unconstrained_fragment *f = &s->fragment[q];
        for (int a = 0; a < f->motions; a++) {
            real sum = 0;
            for (int64_t k = 0; k < f->n; k++)
                for (int d = 0; d < dim; d++) sum += f->motion[(k * dim + d) * MODES_MOST + a] * v->of[d][f->node[k]];
            for (int64_t k = 0; k < f->n; k++)
                for (int d = 0; d < dim; d++) v->of[d][f->node[k]] -= sum * f->motion[(k * dim + d) * MODES_MOST + a];
        }
    }
}
