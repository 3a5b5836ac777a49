/* Computes forces and stresses of bulk viscosity in bonds, points on the grid and cells of the reference frame. */
#include "step/viscosity.h"

#include <math.h>

#include "base/memory.h"
#include "base/team.h"
#include "coupling/coupling_part.h"
#include "mesh/mesh_part.h"
#include "run/energies.h"
#include "run/part.h"

/* Allocates the arrays of v on the first call, if a material of the scene s is viscous. n: number of particles; nodes:
 * number of nodes of the mesh. Returns true if the arrays exist. */
static bool viscosity_made(struct viscosity *v, const struct scene *s, int64_t n, int64_t nodes)
{
    if (v->work || !scene_any_material_has_bulk_viscosity(s)) return v->work != NULL;
    v->material = s->material, v->cell = s->cell * s->spacing, v->small_strain = s->small_strain;
    for (int d = 0; d < s->dim; d++) {
        v->bonds[d] = NEW("viscosity.bonds", n, real), v->stress[d] = NEW("viscosity.stress", n, real);
        v->nodes[d] = NEW("viscosity.nodes", nodes, real);
    }
    v->pressure = NEW("viscosity.pressure", n, real), v->volume = NEW("viscosity.volume", n, real);
    v->work = NEW("viscosity.work", n, real);
    return true;
}

/* Returns the viscous pressure, divided by rho c^2 [1]: linear x + quadratic x^2, with x = crossing * rate. linear,
 * quadratic: coefficients of the material [1]; crossing: time h/c in which a wave of speed c crosses the resolved
 * length h [s]; rate: rate of compression [1/s]. */
static real viscous_strain(real linear, real quadratic, real crossing, real rate)
{
    const real x = crossing * rate;
    return (linear + quadratic * x) * x;
}

/* Returns the viscous pressure of material m [Pa], 0 in expansion. h: resolved length, such as a spacing or the edge of
 * a cell [m]; rate: growth rate of the volume, divided by the volume, negative in compression [1/s]. */
static real viscous_pressure(const struct material *m, real h, real rate)
{
    if (!(rate < 0)) return 0;
    return m->density * square(m->wave_speed) *
           viscous_strain(m->viscosity.linear, m->viscosity.quadratic, h / m->wave_speed, -rate);
}

static real taken_by(const void *work, int64_t i) { return ((const real *)work)[i]; }

/* ---- bonds ------------------------------------------------------------------------------------------------------- */

/* Adds the viscous force of `bond` to f[dim], the force on its particle i [N]. It acts in compression only. A bond
 * between two materials has the mean of their coefficients. material: all materials; stiffness: member of struct
 * bonds. p: all particles. */
static void bond_push(const struct material *material, const struct particles *p, int64_t i, const struct bond *bond,
                      real stiffness, real *f)
{
    const struct material *a = &material[p->material[i]], *b = &material[p->material[bond->nbr]];
    real span[DIM_MAX], length2 = 0, rate = 0;
    for (int d = 0; d < p->dim; d++) {
        span[d] = p->x[d][bond->nbr] - p->x[d][i];
        length2 += square(span[d]);
        rate += span[d] * (p->v[d][bond->nbr] - p->v[d][i]);
    }
    if (!(rate < 0)) return;
    const real length = sqrt(length2), crossing = 2 / bond->inverse_length / (a->wave_speed + b->wave_speed);
    const real strain = viscous_strain(0.5 * (a->viscosity.linear + b->viscosity.linear),
                                       0.5 * (a->viscosity.quadratic + b->viscosity.quadratic), crossing,
                                       -rate / length * bond->inverse_length);
    for (int d = 0; d < p->dim; d++) f[d] -= stiffness * bond->w * strain * span[d] / length;
}

/* Adds the viscous forces of the bonds b to the forces on particles p, and the energy that they have dissipated since
 * the previous step to v->taken. half: half of the time step, 0 in the first step [s]. */
static void bonds_push(struct viscosity *v, const struct bonds *b, struct particles *p, real half)
{
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < p->n; i++) {
        real f[DIM_MAX] = {0};
        for (struct bond_iterator it = bond_iterator_of_row(b, b->row_of[i]); bond_iterator_advance(&it);)
            if (it.bond.w != 0) bond_push(v->material, p, i, &it.bond, b->stiffness, f);
        v->work[i] = 0;
        for (int d = 0; d < p->dim; d++) {
            v->work[i] -= half * p->v[d][i] * (v->bonds[d][i] + f[d]);
            v->bonds[d][i] = f[d];
            p->f[d][i] += f[d];
        }
    }
    v->taken += reproducible_sum(p->n, taken_by, v->work);
}

/* ---- points on the grid ------------------------------------------------------------------------------------------ */

/* Computes v->pressure, the viscous pressure of the material points of p on the grid, from the growth of their volumes
 * in the previous step. Adds the energy that the pressure dissipated in that step to v->taken. partial: shares of the
 * stress of points that bonds carry instead of the points (PD-MPM bonds); dt: duration of that step [s]. */
static void points_pressure(struct viscosity *v, const struct particles *p, const struct partial_stress *partial,
                            real dt)
{
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < p->n; i++) {
        const real before = v->pressure[i], volume = v->volume[i];
        const bool on_grid = p->kind[i] == KIND_MPM && !(p->flag[i] & FLAG_MESHED);
        v->pressure[i] = v->work[i] = 0, v->volume[i] = on_grid ? p->volume[i] : 0;
        if (!on_grid || volume == 0) continue;
        const real growth = p->volume[i] - volume, rate = growth / (0.5 * (p->volume[i] + volume) * dt);
        v->pressure[i] = viscous_pressure(&v->material[p->material[i]], v->cell, rate);
        v->work[i] =
            -0.5 * point_energy_fraction_not_carried_by_bonds(partial, p->dim, i) * (before + v->pressure[i]) * growth;
    }
    v->taken += reproducible_sum(p->n, taken_by, v->work);
}

/* Returns half of the time step of `clock` [s], the weight of the forces at both ends of a step in the work over this
 * step (trapezoidal rule); 0 in the first step, which has no previous forces. */
static real half_step(const struct run_clock *clock) { return clock->step > 0 ? 0.5 * clock->dt : 0; }

void bulk_viscosity_add_bond_forces_and_pressure(struct run *run)
{
    if (!viscosity_made(run->viscosity, run->scene, run->part.n, run->frame->mesh.grid.n)) return;
    bonds_push(run->viscosity, &run->bonds, &run->part, half_step(&run->clock));
    points_pressure(run->viscosity, &run->part, &run->coupling->partial, run->clock.dt);
}

void bulk_viscosity_change_or_restore_point_stress(struct viscosity *v, const struct particles *p,
                                                   bool subtract_pressure)
{
    for (int d = 0; d < p->dim && v->work; d++) {
#pragma omp parallel for schedule(static)
        for (int64_t k = 0; k < p->n_free; k++) {
            const int32_t i = p->list_free[k];
            if (subtract_pressure)
                v->stress[d][i] = p->stress[d][i], p->stress[d][i] -= v->pressure[i];
            else
                p->stress[d][i] = v->stress[d][i];
        }
    }
}

/* ---- cells of the reference frame -------------------------------------------------------------------------------- */

/* Computes the inverse of the matrix F[dim dim] into `inverse`, row by row, and returns the determinant of F, which
 * must not be 0. */
static real invert_gradient(const real *F, int dim, real *inverse)
{
    if (dim == 1) {
        inverse[0] = 1 / F[0];
        return F[0];
    }
    if (dim == 2) {
        const real J = F[0] * F[3] - F[1] * F[2];
        inverse[0] = F[3] / J, inverse[1] = -F[1] / J, inverse[2] = -F[2] / J, inverse[3] = F[0] / J;
        return J;
    }
    real J = 0;
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) {
            const int c = (a + 1) % 3, d = (a + 2) % 3, k = (b + 1) % 3, l = (b + 2) % 3;
            inverse[b * 3 + a] = F[c * 3 + k] * F[d * 3 + l] - F[c * 3 + l] * F[d * 3 + k];
            if (a == 0) J += F[b] * inverse[b * 3];
        }
    for (int k = 0; k < 9; k++) inverse[k] /= J;
    return J;
}

/* Replaces the displacement gradient H[dim dim][i] of point i of p, in a mesh, by volume0 J q F^-T [N m], where q is
 * the viscous pressure, F = 1 + H and J = det F. Multiplied by the gradients of the shape functions, this tensor gives
 * the viscous forces on nodes. v: materials and cell edge; partial: shares of the stress of points that bonds carry;
 * G: velocity gradients, [dim dim][points] [1/s]. */
static void viscous_stress(const struct viscosity *v, const struct particles *p, const struct partial_stress *partial,
                           int64_t i, real *const *H, real *const *G)
{
    const int dim = p->dim;
    real F[DIM_MAX * DIM_MAX], inverse[DIM_MAX * DIM_MAX], rate = 0;
    for (int a = 0; a < dim; a++)
        for (int b = 0; b < dim; b++) F[a * dim + b] = (a == b) + (v->small_strain ? 0 : H[a * dim + b][i]);
    const real J = invert_gradient(F, dim, inverse);
    for (int a = 0; a < dim; a++)
        for (int b = 0; b < dim; b++) rate += G[a * dim + b][i] * inverse[b * dim + a];
    const real q = viscous_pressure(&v->material[p->material[i]], v->cell, rate) *
                   point_energy_fraction_not_carried_by_bonds(partial, dim, i);
    for (int a = 0; a < dim; a++)
        for (int b = 0; b < dim; b++) H[a * dim + b][i] = p->volume0[i] * J * q * inverse[b * dim + a];
}

/* Adds the viscous forces of the points of mesh cell I to the forces f[dim][nodes] on its nodes [N]. P: tensors of the
 * points computed by viscous_stress, [dim dim][points] [N m]. */
static void cell_push(const struct mesh *mesh, int64_t I, real *const *P, real *const *f)
{
    const int dim = mesh->grid.dim;
    for (int slot = 0; slot < 1 << dim; slot++) {
        const int32_t i = mesh->point[(I << dim) + slot];
        for (int c = 0; c < 1 << dim && i >= 0; c++) {
            const int64_t node = mesh_cell_corner_node(mesh, I, c);
            for (int a = 0; a < dim; a++)
                for (int b = 0; b < dim; b++)
                    f[a][node] += P[a * dim + b][i] * mesh_shape_function_derivative(dim, c, slot, b) / mesh->grid.h;
        }
    }
}

/* Returns the colour of mesh cell I: cells of one colour share no node, so that threads can add to nodes. Cells beside
 * slits (pre-cracks with nodes on both sides) have a common extra colour, 2^dim, and are processed serially. */
static int cell_colour(const struct mesh *mesh, int64_t I)
{
    const struct grid *g = &mesh->grid;
    int colour = 0;
    if (mesh->slits.cell && (I >= mesh->slits.first || mesh->slits.cell[I] >= 0)) return 1 << g->dim;
    for (int d = 0; d < g->dim; d++) colour |= (int)(I / g->stride[d] % g->count[d] & 1) << d;
    return colour;
}

/* Adds the viscous forces of all mesh cells to the nodal forces f[dim][grid.n] [N]: in parallel for cells of one colour
 * (which share no node), colour by colour; serially for cells beside slits (pre-cracks). P: tensors of the points
 * computed by viscous_stress, [dim dim][points] [N m]. */
static void cells_push(const struct mesh *mesh, real *const *P, real *const *f)
{
    const int colours = 1 << mesh->grid.dim;
    for (int colour = 0; colour < colours; colour++) {
#pragma omp parallel for schedule(static)
        for (int64_t I = 0; I < mesh->grid.n; I++)
            if (mesh->kind[I] && cell_colour(mesh, I) == colour) cell_push(mesh, I, P, f);
    }
    for (int64_t I = 0; I < mesh->grid.n && mesh->slits.cell; I++)
        if (mesh->kind[I] && cell_colour(mesh, I) == colours) cell_push(mesh, I, P, f);
}

/* Adds the viscous forces f[dim][g->n] [N] of this step to the forces on the nodes of g, and adds the energy that they
 * have dissipated since the previous step to v->taken, by the trapezoidal rule with the stored forces of the previous
 * step. half: half of the time step, 0 in the first step [s]. */
static void nodes_book(struct viscosity *v, const struct grid *g, real half, real *const *f)
{
    real *work = NEW("viscosity.node_work", g->n, real);
#pragma omp parallel for schedule(static)
    for (int64_t I = 0; I < g->n; I++)
        for (int d = 0; d < g->dim; d++) {
            work[I] -= half * g->velocity[d][I] * (v->nodes[d][I] + f[d][I]);
            v->nodes[d][I] = f[d][I];
            g->force[d][I] += f[d][I];
        }
    v->taken += reproducible_sum(g->n, taken_by, work);
    memory_free(work);
}

void bulk_viscosity_add_nodal_forces(struct run *run)
{
    const struct mesh *mesh = &run->frame->mesh;
    const int dim = run->part.dim;
    real *H[DIM_MAX * DIM_MAX] = {NULL}, *G[DIM_MAX * DIM_MAX] = {NULL}, *f[DIM_MAX] = {NULL};
    struct mesh moving = *mesh;
    if (!run->viscosity->work || mesh->points == 0) return;
    for (int k = 0; k < dim * dim; k++)
        H[k] = NEW("viscosity.H", run->part.n, real), G[k] = NEW("viscosity.G", run->part.n, real);
    for (int d = 0; d < dim; d++) f[d] = NEW("viscosity.f", mesh->grid.n, real);
    for (int d = 0; d < dim; d++) moving.displacement[d] = mesh->grid.velocity[d];
    mesh_points_gradient(mesh, H);
    mesh_points_gradient(&moving, G);
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < run->part.n; i++)
        if (mesh->place[i] >= 0) viscous_stress(run->viscosity, &run->part, &run->coupling->partial, i, H, G);
    cells_push(mesh, H, f);
    nodes_book(run->viscosity, &mesh->grid, half_step(&run->clock), f);
    for (int k = 0; k < dim * dim; k++) memory_free(H[k]), memory_free(G[k]);
    for (int d = 0; d < dim; d++) memory_free(f[d]);
}

/* ---- in a run ---------------------------------------------------------------------------------------------------- */

/* Returns the largest speed [m/s] that load l causes at its particles p within `duration` [s]: the prescribed speed, or
 * for a traction or pressure of size s the speed s/impedance at which the load moves a face. Returns 0 for other loads,
 * and if the speed is not finite. impedance: smallest density times wave speed of the materials [Pa s/m]. */
static real speed_of_load(const struct load *l, const struct particles *p, real duration, real impedance)
{
    const struct boundary *b = l->boundary;
    const real size = sqrt(dot(b->value, b->value, p->dim));
    if (b->kind == BOUNDARY_VELOCITY) {
        const real speed = real_max(load_largest_prescribed_speed(l, p, duration), b->displaces ? 0 : size);
        return isfinite(speed) ? speed : 0;
    }
    real most = b->time.n > 0 ? 0 : 1;
    for (int k = 0; k < b->time.n; k++) most = real_max(most, fabs(time_function_value(&b->time, b->time.t[k])));
    return b->kind == BOUNDARY_TRACTION || b->kind == BOUNDARY_PRESSURE ? most * size / impedance : 0;
}

real bulk_viscosity_time_step_factor(const struct scene *s, const struct loads *l, const struct particles *p,
                                     real initial_speed)
{
    real impedance = INFINITY;
    for (int m = 0; m < s->materials; m++)
        impedance = real_min(impedance, s->material[m].density * s->material[m].wave_speed);
    for (int b = 0; b < l->n && scene_any_material_has_bulk_viscosity(s); b++)
        initial_speed = real_max(initial_speed, speed_of_load(&l->load[b], p, s->duration, impedance));
    for (int b = s->bodies; b < s->bodies + s->rigids; b++)
        initial_speed = real_max(initial_speed, sqrt(dot(s->body[b].velocity, s->body[b].velocity, s->dim)));
    real q = 0;
    for (int m = 0; m < s->materials; m++) {
        const struct material *own = &s->material[m];
        q = real_max(q, own->viscosity.linear + own->viscosity.quadratic * initial_speed / own->wave_speed);
    }
    return sqrt(1 + q * q) - q;
}

static void viscosity_free_all(struct run *run)
{
    struct viscosity *v = run->viscosity;
    for (int d = 0; d < DIM_MAX; d++) memory_free(v->bonds[d]), memory_free(v->nodes[d]), memory_free(v->stress[d]);
    memory_free(v->pressure), memory_free(v->volume), memory_free(v->work);
}

static status viscosity_state(struct run *run, struct archive *a)
{
    struct viscosity *v = run->viscosity;
    const size_t n = (size_t)run->part.n * sizeof(real), nodes = (size_t)run->frame->mesh.grid.n * sizeof(real);
    static const char *const name[] = {"viscosity/bonds_x", "viscosity/bonds_y", "viscosity/bonds_z"};
    static const char *const node[] = {"viscosity/nodes_x", "viscosity/nodes_y", "viscosity/nodes_z"};
    if (!viscosity_made(v, run->scene, run->part.n, run->frame->mesh.grid.n)) return OK;
    for (int d = 0; d < run->part.dim; d++) TRY(a->exchange(a, name[d], v->bonds[d], n));
    for (int d = 0; d < run->part.dim && nodes > 0; d++) TRY(a->exchange(a, node[d], v->nodes[d], nodes));
    TRY(a->exchange(a, "viscosity/pressure", v->pressure, n));
    TRY(a->exchange(a, "viscosity/volume", v->volume, n));
    ARCHIVE_VALUE(a, "viscosity/taken", v->taken);
    return OK;
}

const struct part part_viscosity = {PART(viscosity, viscosity), .free = viscosity_free_all, .state = viscosity_state};
