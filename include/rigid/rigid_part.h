/* Rigid bodies, as a part of a run. */
#ifndef CLEAVE_RIGID_PART
#define CLEAVE_RIGID_PART

#include "output/column.h"
#include "rigid/rigid.h"
#include "run/run.h"

/* Rigid bodies, and what they and others are shaped like. */
struct rigid_set {
    int n, dim;
    bool moves;                  /* motion is computed by explicit steps: velocities have a meaning */
    struct rigid_body *body;     /* [n] */
    const struct region **shape; /* [scene->bodies] of bodies that are not lists, for contact */
    real *motion;                /* [n, 2 DIM_MAX] centres [m] and velocities [m/s] at the time of a sample */
    bool met;                    /* a warning of two that are inside each other has been given */
};

/* Makes them at the start; REFUSED where one overlaps a body, or flies across a mirror. */
status rigids_make(struct rigid_set *rigid, const struct scene *s);
status rigids_check(const struct rigid_set *rigid, const struct scene *s, const struct particles *p);
/* Books their forces of contact over dt_velocity [s], and subtracts their impulse from that of the loads [N s]. */
void rigids_book(struct rigid_set *rigid, real dt_velocity, real impulse[DIM_MAX]);
/* Moves them by dt. middle: time in the middle of the step; velocities move on by dt_velocity [s]. */
void rigids_move(struct rigid_set *rigid, real middle, real dt, real dt_velocity);
/* FAILED where one moves too far in a step. */
status rigids_speed_check(const struct rigid_set *rigid, const struct scene *s, const struct run_clock *clock);
/* Warns once where two of them are inside each other at time t [s]. */
void rigids_meet(struct rigid_set *rigid, real spacing, real t, struct warnings *to);

/* Kinetic energy before a step, of the step that has been made as leap-frog keeps it, and after the last one; work of
 * what drives them [J]. */
struct rigid_energy {
    real before, step, last, work;
};
struct rigid_energy rigids_energy(const struct rigid_set *rigid, real dt);
/* Their columns of history.csv (column NULL: only how many), and the values. */
int rigids_columns(const struct run *e, struct column *column);
void rigids_record(struct run *e, real *record);
/* Places and velocities at the time of a sample, into `motion`: those of time t [s]. */
void rigids_keep(struct rigid_set *rigid, real t);
/* After the step: velocities half-way to the present ones. */
void rigids_mean(struct rigid_set *rigid);
/* Where no step follows: present velocities and half a kick of the present forces. */
void rigids_kick(struct rigid_set *rigid, real t, real dt);
/* Sets v to the velocity of the k-th one now, half a kick of the last forces beyond leap-frog's, of a driven one that
 * of its own time [m/s]. */
void rigids_velocity(const struct rigid_set *rigid, int k, real t, real dt, real *v);

#endif
