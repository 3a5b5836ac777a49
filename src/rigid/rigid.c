/* Moves single rigid bodies, and computes the signed distance of points from their surface. */
#include "rigid/rigid.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "rigid_moments.h"

/* ---- rotations --------------------------------------------------------------------------------------------------- */

/* Computes the product to = A b, or A^T b if `back` is true, of a 3 x 3 matrix A and a vector b[3]. to[3] must not be
 * b. */
static void turn_vector(real A[DIM_MAX][DIM_MAX], const real *b, bool back, real *to)
{
    for (int r = 0; r < DIM_MAX; r++) {
        to[r] = 0;
        for (int c = 0; c < DIM_MAX; c++) to[r] += (back ? A[c][r] : A[r][c]) * b[c];
    }
}

/* Rotates the columns of the 3 x 3 matrix A in place by the rotation vector w[3] [rad] (Rodrigues' formula). */
static void rotate_further(real A[DIM_MAX][DIM_MAX], const real *w)
{
    const real angle = sqrt(dot(w, w, DIM_MAX));
    const real a = angle > 1e-8 ? sin(angle) / angle : 1, b = angle > 1e-4 ? (1 - cos(angle)) / square(angle) : 0.5;
    for (int c = 0; c < DIM_MAX; c++) {
        const real v[DIM_MAX] = {A[0][c], A[1][c], A[2][c]};
        const real once[] = {w[1] * v[2] - w[2] * v[1], w[2] * v[0] - w[0] * v[2], w[0] * v[1] - w[1] * v[0]};
        const real twice[] = {w[1] * once[2] - w[2] * once[1], w[2] * once[0] - w[0] * once[2],
                              w[0] * once[1] - w[1] * once[0]};
        for (int r = 0; r < DIM_MAX; r++) A[r][c] = v[r] + a * once[r] + b * twice[r];
    }
}

/* Solves A x = b for x[3], by cofactors. A: symmetric positive definite 3 x 3 matrix; b[3]: right-hand side. */
static void solve_three(real A[DIM_MAX][DIM_MAX], const real *b, real *x)
{
    real cofactor[DIM_MAX][DIM_MAX], determinant = 0;
    for (int r = 0; r < DIM_MAX; r++)
        for (int c = 0; c < DIM_MAX; c++) {
            const int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
            cofactor[r][c] = A[r1][c1] * A[r2][c2] - A[r1][c2] * A[r2][c1];
        }
    for (int c = 0; c < DIM_MAX; c++) determinant += A[0][c] * cofactor[0][c];
    turn_vector(cofactor, b, true, x);
    for (int r = 0; r < DIM_MAX; r++) x[r] /= determinant;
}

/* Computes the angular velocity spin[3] [1/s] of rigid body r from its angular momentum, for the orientation given by
 * the rotation matrix `turn`. */
static void spin_of(struct rigid_body *r, real turn[DIM_MAX][DIM_MAX], real *spin)
{
    real own[DIM_MAX], own_spin[DIM_MAX];
    if (r->dim < 3) {
        spin[0] = spin[1] = 0, spin[2] = r->angular[2] / r->inertia[2][2];
        return;
    }
    turn_vector(turn, r->angular, true, own);
    solve_three(r->inertia, own, own_spin);
    turn_vector(turn, own_spin, false, spin);
}

/* ---- at t = 0 ---------------------------------------------------------------------------------------------------- */

/* Largest admissible relative error of volume and moments of inertia of a rigid body that moves freely [1]; it is
 * estimated by refinement. */
#define MOMENTS_UNCERTAIN 0.01

/* Computes the tensor of inertia of rigid body r about its centre [kg m^2] from the second moments per volume `second`
 * [m^2]. */
static void inertia_make(struct rigid_body *r, real second[DIM_MAX][DIM_MAX])
{
    const real trace = second[0][0] + second[1][1] + second[2][2];
    for (int a = 0; a < DIM_MAX; a++)
        for (int b = 0; b < DIM_MAX; b++) r->inertia[a][b] = r->mass * ((a == b ? trace : 0) - second[a][b]);
}

status rigid_make(struct rigid_body *r, const struct region *shape, int dim, real mass, const real *velocity,
                  real spacing)
{
    struct region_moments moments = {0};
    real from[DIM_MAX] = {0}, to[DIM_MAX] = {0};
    const bool bounded = region_compute_bounding_box_if_finite(shape, dim, from, to);
    r->shape = shape, r->dim = dim, r->mass = mass;
    r->motion = mass > 0 ? RIGID_FREE : dot(velocity, velocity, dim) > 0 ? RIGID_DRIVEN : RIGID_FIXED;
    array_copy(r->motion == RIGID_DRIVEN ? r->speed : r->v, velocity, dim, sizeof *velocity);
    for (int d = 0; d < DIM_MAX; d++) r->turn[d][d] = 1;
    if (!bounded && r->motion != RIGID_FIXED)
        return status_set(
            REFUSED, "rigid body %s moves, but has an infinite shape; build it from boxes, balls, discs or cylinders",
            r->name);
    if (bounded) region_compute_moments(shape, dim, from, to, &moments);
    if (bounded && !(moments.volume > 0))
        return status_set(REFUSED, "rigid body %s has no volume; check its shape", r->name);
    if (r->motion == RIGID_FREE && moments.change > MOMENTS_UNCERTAIN)
        return status_set(REFUSED,
                          "rigid body %s moves freely, but its shape is so thin that its centre and inertia are known "
                          "only to %.2g %%; make it thicker, or remove its thin parts",
                          r->name, 100 * moments.change);
    memcpy(r->centre, moments.centre, sizeof r->centre);
    for (int d = 0; d < dim && bounded; d++) r->radius += square(0.5 * (to[d] - from[d]));
    r->radius = bounded ? 2 * sqrt(r->radius) : spacing;
    r->face = dim == 1 ? 1 : 0;
    for (int d = 0; d < dim && dim > 1 && bounded; d++)
        r->face = real_max(r->face, (to[d] - from[d]) * (dim < 3 ? 1 : to[(d + 1) % 3] - from[(d + 1) % 3]));
    memcpy(r->x, r->centre, sizeof r->x);
    inertia_make(r, moments.second);
    r->turns = r->motion == RIGID_FREE && dim > 1;
    return OK;
}

/* ---- surface ----------------------------------------------------------------------------------------------------- */

/* Returns the distance of point x[DIM_MAX] [m] from the surface of rigid body r [m], negative inside. normal[DIM_MAX]:
 * receives the outward unit normal at the nearest point of the surface. */
real rigid_signed_distance(const struct rigid_body *r, const real *x, real *normal)
{
    real arm[DIM_MAX] = {0}, X[DIM_MAX], own[DIM_MAX] = {0}, turn[DIM_MAX][DIM_MAX];
    memcpy(turn, r->turn, sizeof turn);
    for (int d = 0; d < r->dim; d++) arm[d] = x[d] - r->x[d];
    turn_vector(turn, arm, true, X);
    for (int d = 0; d < r->dim; d++) X[d] += r->centre[d];
    const real distance = region_signed_distance(r->shape, X, r->dim, own);
    turn_vector(turn, own, false, normal);
    return distance;
}

void rigid_compute_current_position_of_point(const struct rigid_body *r, const real *X, real *x)
{
    real arm[DIM_MAX] = {0}, turn[DIM_MAX][DIM_MAX], turned[DIM_MAX];
    memcpy(turn, r->turn, sizeof turn);
    for (int d = 0; d < r->dim; d++) arm[d] = X[d] - r->centre[d];
    turn_vector(turn, arm, false, turned);
    for (int d = 0; d < r->dim; d++) x[d] = r->x[d] + turned[d];
}

void rigid_compute_velocity_at_point(const struct rigid_body *r, const real *x, real *velocity)
{
    const real *w = r->spin;
    real arm[DIM_MAX] = {0};
    for (int d = 0; d < r->dim; d++) arm[d] = x[d] - r->x[d];
    const real turning[] = {w[1] * arm[2] - w[2] * arm[1], w[2] * arm[0] - w[0] * arm[2],
                            w[0] * arm[1] - w[1] * arm[0]};
    for (int d = 0; d < DIM_MAX; d++) velocity[d] = r->v[d] + turning[d];
}

/* ---- motion ------------------------------------------------------------------------------------------------------ */

/* Rotates rigid body r by the angle of one time step dt [s]. The angular velocity in the middle of the step follows
 * from the angular momentum and the orientation at that time, which in turn depends on this angular velocity. Both are
 * found by fixed-point iteration, whose third iterate is exact to round-off for any time step that is stable for
 * contact. */
static void turn_on(struct rigid_body *r, real dt)
{
    real middle[DIM_MAX][DIM_MAX], half[DIM_MAX];
    spin_of(r, r->turn, r->spin);
    for (int k = 0; k < 3 && r->dim > 2; k++) {
        memcpy(middle, r->turn, sizeof middle);
        for (int d = 0; d < DIM_MAX; d++) half[d] = 0.5 * dt * r->spin[d];
        rotate_further(middle, half);
        spin_of(r, middle, r->spin);
    }
    for (int d = 0; d < DIM_MAX; d++) half[d] = dt * r->spin[d];
    rotate_further(r->turn, half);
}

void rigid_compute_prescribed_velocity(const struct rigid_body *r, real t, real *velocity)
{
    const real share = r->ramp > 0 ? real_min(1, t / r->ramp) : 1;
    for (int d = 0; d < r->dim; d++) velocity[d] = r->speed[d] * share;
}

void rigid_advance_one_step(struct rigid_body *r, real t_middle, real dt, real dt_velocity)
{
    real kinetic = 0, driven[DIM_MAX] = {0};
    rigid_compute_prescribed_velocity(r, t_middle, driven);
    for (int d = 0; d < r->dim; d++) {
        const real before = r->v[d];
        if (r->motion == RIGID_DRIVEN) r->v[d] = driven[d];
        if (r->motion == RIGID_FREE) r->v[d] += (r->force[d] + r->weight[d]) / r->mass * dt_velocity;
        kinetic += 0.5 * r->mass * before * r->v[d];
        r->increment[d] = r->v[d] * dt;
        r->x[d] += r->increment[d];
    }
    if (r->turns) {
        const real before[] = {r->angular[0], r->angular[1], r->angular[2]};
        for (int d = 0; d < DIM_MAX; d++) r->angular[d] += r->moment[d] * dt_velocity;
        turn_on(r, dt);
        kinetic += 0.5 * dot(before, r->spin, DIM_MAX);
    }
    r->kinetic = kinetic;
}

real rigid_compute_prescribed_displacement(const struct rigid_body *r, real t, real *displacement)
{
    const real full = t < r->ramp ? 0.5 * square(t) / r->ramp : t - 0.5 * real_max(0, r->ramp);
    for (int d = 0; d < DIM_MAX; d++) displacement[d] = r->motion == RIGID_DRIVEN ? r->speed[d] * full : 0;
    return sqrt(dot(displacement, displacement, r->dim));
}

void rigid_move_to_prescribed_position(struct rigid_body *r, real t)
{
    real u[DIM_MAX];
    rigid_compute_prescribed_displacement(r, t, u);
    for (int d = 0; d < r->dim && r->motion == RIGID_DRIVEN; d++) {
        const real x = r->centre[d] + u[d];
        r->increment[d] += x - r->x[d];
        r->x[d] = x;
    }
}

/* ---- energies ---------------------------------------------------------------------------------------------------- */

/* Returns the work of the drive that moves the rigid body r against the contact forces in the last time step [J]: the
 * mean of the contact forces at the beginning and the end of the step times the displacement. Returns 0 for bodies that
 * are not driven. */
static real work_of_step(const struct rigid_body *r)
{
    real work = 0;
    for (int d = 0; d < r->dim && r->motion == RIGID_DRIVEN; d++)
        work -= 0.5 * (r->force_previous[d] + r->force[d]) * r->increment[d];
    return work;
}

real rigid_work_of_prescribed_motion_and_weight(const struct rigid_body *r)
{
    real fallen = 0;
    for (int d = 0; d < r->dim; d++) fallen += r->weight[d] * (r->x[d] - r->centre[d]);
    return r->work + work_of_step(r) + fallen;
}

void rigid_update_largest_contact_force(struct rigid_body *r)
{
    r->force_most = real_max(r->force_most, sqrt(dot(r->force, r->force, r->dim)));
}

void rigid_add_work_of_prescribed_motion(struct rigid_body *r)
{
    r->work += work_of_step(r);
    memcpy(r->force_previous, r->force, sizeof r->force_previous);
    memset(r->increment, 0, sizeof r->increment);
}

real rigid_kinetic_energy(const struct rigid_body *r)
{
    return 0.5 * r->mass * dot(r->v, r->v, r->dim) + 0.5 * dot(r->angular, r->spin, DIM_MAX);
}

real rigid_half_step_kinetic_energy_change(const struct rigid_body *r, real dt)
{
    if (r->motion != RIGID_FREE) return 0;
    const real turning = r->turns ? dot(r->moment, r->spin, DIM_MAX) : 0;
    return 0.5 * dt * (dot(r->force, r->v, r->dim) + dot(r->weight, r->v, r->dim) + turning);
}

/* ---- state ------------------------------------------------------------------------------------------------------- */

/* Saves the state of rigid body r to the archive a if it is saving, else restores it. The state consists of the members
 * of the structure from `x` to the end, which change in each time step. body_number: index of the body, which names its
 * entry in the archive. Returns the status of the archive: FAILED, with a message, if the entry cannot be written or is
 * missing. */
status rigid_save_or_load(struct rigid_body *r, int body_number, struct archive *a)
{
    char name[64];
    snprintf(name, sizeof name, "rigid/%d", body_number);
    return a->exchange(a, name, r->x, sizeof *r - offsetof(struct rigid_body, x));
}
