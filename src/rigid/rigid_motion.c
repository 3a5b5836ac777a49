/* Manages all rigid bodies of a run: set-up, work of contact forces, motion, energies, and columns of history.csv. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "rigid/rigid_part.h"

status rigids_make(struct rigid_set *rigid, const struct scene *s)
{
    rigid->n = s->rigids, rigid->dim = s->dim, rigid->moves = scene_is_dynamic(s);
    rigid->shape = NEW("engine.shape", s->bodies, const struct region *);
    for (int b = 0; b < s->bodies; b++) rigid->shape[b] = s->body[b].file ? NULL : &s->body[b].shape;
    for (int b = 0; b < s->bodies; b++) /* the common surface of several joined solids is not known */
        if (s->body[b].joined != b) rigid->shape[s->body[b].joined] = NULL;
    rigid->body = NEW("engine.rigid", s->rigids, struct rigid_body);
    for (int k = 0; k < s->rigids; k++) {
        const struct scene_body *b = &s->body[s->bodies + k];
        struct rigid_body *r = &rigid->body[k];
        memcpy(r->name, b->name, sizeof b->name);
        TRY(status_message_prepend_location(b->place,
                                            rigid_make(r, &b->shape, s->dim, b->mass, b->velocity, s->spacing)));
        r->ramp = b->ramp;
        for (int d = 0; d < s->dim; d++) r->weight[d] = b->force[d] + b->mass * s->gravity[d];
    }
    return OK;
}

void rigids_move_to_prescribed_positions(struct rigid_set *rigid, real t)
{
    for (int k = 0; k < rigid->n; k++) rigid_move_to_prescribed_position(&rigid->body[k], t);
}

void rigids_update_drive_work_and_contact_impulse(struct rigid_set *rigid, real dt_velocity,
                                                  real particle_impulse[DIM_MAX])
{
    for (int k = 0; k < rigid->n; k++) {
        rigid_add_work_of_prescribed_motion(&rigid->body[k]);
        rigid_update_largest_contact_force(&rigid->body[k]);
        for (int d = 0; d < rigid->dim; d++) particle_impulse[d] -= rigid->body[k].force[d] * dt_velocity;
    }
}

void rigids_advance_one_step(struct rigid_set *rigid, real t_middle, real dt, real dt_velocity)
{
    for (int k = 0; k < rigid->n; k++) rigid_advance_one_step(&rigid->body[k], t_middle, dt, dt_velocity);
}

struct rigid_energy rigids_compute_energy(const struct rigid_set *rigid, real dt)
{
    struct rigid_energy sum = {0};
    for (int k = 0; k < rigid->n; k++) {
        const struct rigid_body *r = &rigid->body[k];
        sum.before += rigid_kinetic_energy(r);
        sum.step += r->kinetic;
        sum.last += rigid_kinetic_energy(r) + rigid_half_step_kinetic_energy_change(r, dt);
        sum.work += rigid_work_of_prescribed_motion_and_weight(r);
    }
    return sum;
}

/* ---- columns ----------------------------------------------------------------------------------------------------- */

/* Writes the name `<body>_<what>` and the unit `unit` of a column of history.csv to column[at]. If column is NULL,
 * writes nothing, so that columns can be counted. Returns at + 1, the index of the next column. */
static int add_column(struct column *column, int at, const char *body, const char *what, const char *unit)
{
    if (!column) return at + 1;
    snprintf(column[at].name, sizeof column[at].name, "%s_%s", body, what);
    snprintf(column[at].unit, sizeof column[at].unit, "%s", unit);
    return at + 1;
}

int rigids_list_history_columns(const struct run *run, struct column *column)
{
    static const char *const force[] = {"force_x", "force_y", "force_z"}, *const place[] = {"x", "y", "z"};
    static const char *const moment[] = {"moment_x", "moment_y", "moment_z"};
    static const char *const velocity[] = {"velocity_x", "velocity_y", "velocity_z"};
    const int dim = run->rigid->dim;
    int n = 0;
    for (int k = 0; k < run->rigid->n; k++) {
        const char *name = run->rigid->body[k].name;
        for (int d = 0; d < dim; d++) n = add_column(column, n, name, force[d], "N");
        for (int d = dim == 2 ? 2 : 0; d < 3 && dim > 1; d++) n = add_column(column, n, name, moment[d], "N m");
        for (int d = 0; d < dim; d++) n = add_column(column, n, name, place[d], "m");
        for (int d = 0; d < dim; d++) n = add_column(column, n, name, velocity[d], "m/s");
    }
    return n;
}

void rigids_store_motion_before_step(struct rigid_set *rigid, real t)
{
    if (!rigid->motion) rigid->motion = NEW("rigid.motion", 2 * DIM_MAX * rigid->n, real);
    for (int k = 0; k < rigid->n; k++) {
        const struct rigid_body *r = &rigid->body[k];
        real *x = rigid->motion + 2 * DIM_MAX * k, *v = x + DIM_MAX;
        array_copy(x, r->x, DIM_MAX, sizeof *x);
        array_copy(v, r->v, DIM_MAX, sizeof *v);
        if (r->motion == RIGID_DRIVEN && rigid->moves) rigid_compute_prescribed_velocity(r, t, v);
    }
}

void rigids_average_stored_and_current_velocities(struct rigid_set *rigid)
{
    for (int k = 0; k < rigid->n; k++) {
        real *v = rigid->motion + 2 * DIM_MAX * k + DIM_MAX;
        for (int d = 0; d < DIM_MAX && rigid->body[k].motion == RIGID_FREE; d++)
            v[d] = 0.5 * (v[d] + rigid->body[k].v[d]);
    }
}

void rigids_compute_velocity_of_body_at_time(const struct rigid_set *rigid, int k, real t, real dt, real *v)
{
    const struct rigid_body *r = &rigid->body[k];
    array_copy(v, r->v, DIM_MAX, sizeof *v);
    if (r->motion == RIGID_DRIVEN && rigid->moves) rigid_compute_prescribed_velocity(r, t, v);
    for (int d = 0; d < DIM_MAX && r->motion == RIGID_FREE && rigid->moves; d++)
        v[d] += 0.5 * dt * (r->force[d] + r->weight[d]) / r->mass;
}

void rigids_extrapolate_stored_velocities_to_time(struct rigid_set *rigid, real t, real dt)
{
    for (int k = 0; k < rigid->n; k++)
        rigids_compute_velocity_of_body_at_time(rigid, k, t, dt, rigid->motion + 2 * DIM_MAX * k + DIM_MAX);
}

void rigids_write_history_values(struct run *run, real *record)
{
    const int dim = run->rigid->dim;
    for (int k = 0; k < run->rigid->n; k++) {
        const struct rigid_body *r = &run->rigid->body[k];
        const real *x = run->rigid->motion + 2 * DIM_MAX * k, *v = x + DIM_MAX;
        for (int d = 0; d < dim; d++) *record++ = r->force[d];
        for (int d = dim == 2 ? 2 : 0; d < 3 && dim > 1; d++) *record++ = r->moment[d];
        for (int d = 0; d < dim; d++) *record++ = x[d];
        for (int d = 0; d < dim; d++) *record++ = v[d];
    }
}
