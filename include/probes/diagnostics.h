/* Balances of energy, momentum and angular momentum, the first break, and the check for diverged particles. */
#ifndef CLEAVE_DIAGNOSTICS
#define CLEAVE_DIAGNOSTICS

#include "base/archive.h"
#include "bonds/bonds.h"
#include "coupling/conversion.h"
#include "kernels/kernels.h"
#include "loads/loads.h"
#include "data/particles.h"
#include "run/energies.h"
#include "run/ledger.h"

struct energy_balance {
    real time; /* of the sample [s] */
    struct energy energy;
    real external_work;     /* work of loads and supports since the start [J] */
    real balance_error;     /* (E - E_0 - work) over the largest |E| or |work| so far [1] */
    real momentum[DIM_MAX]; /* of all bodies [kg m/s] */
    real momentum_error;    /* largest |p - p_0 - impulse| so far over the largest sum |m v| so far [1] */
    real spin[DIM_MAX];     /* L: angular momentum of free bodies about their common centre of mass [kg m^2/s] */
    real spin_error;        /* largest |L - L_0| so far over the largest sum |L_body| so far; NAN if not measured [1] */
};

struct diagnostics {
    struct energy_balance now;
    real energy_start, energy_scale; /* energy minus work at the start; largest energy or work so far [J] */
    real momentum_start[DIM_MAX], momentum_scale; /* momentum at the start; largest sum |m v| so far [kg m/s] */
    real spin_start[DIM_MAX], spin_scale; /* angular momentum at the start; largest sum |L_body| so far [kg m^2/s] */
    bool turns;                           /* spin_start is set, which requires free bodies */
    bool started;
    real break_time; /* time of the first bond broken by load, except bonds of driven particles; NAN if none [s] */
    real break_position[DIM_MAX]; /* reference position of a cut of that step (fracture/places.h) [m] */
    int64_t break_ends;           /* number of separate cuts in that step */
    real driven_time;             /* time of the first bond of a driven particle broken by load; NAN if none [s] */
    int64_t bonds_broken;         /* directed bonds broken by load */
};

/* Initialises the diagnostics, before step 0. */
void diagnostics_make(struct diagnostics *w);

/* Measures the momentum of particles and of mesh nodes, and the largest momentum error so far. nodes [grids]: grids
 * whose nodes carry the mass of their points; impulse: of loads and supports up to the time of the velocities [dim,
 * N s]. */
void diagnostics_momentum(struct diagnostics *w, const struct particles *p, const struct grid *const *nodes, int grids,
                          const real *impulse);

/* Measures the angular momentum of free bodies about their common centre of mass, and the largest error so far.
 * mesh: NULL if no node of the reference frame carries mass. Call it only if nothing outside the bodies acts on
 * them. */
void diagnostics_spin(struct diagnostics *w, const struct particles *p, const struct mesh *mesh, int bodies);

/* Stores the energies and the work of loads and supports [J] of time t [s], and computes the balance error. Call it
 * after diagnostics_momentum. */
void diagnostics_balance(struct diagnostics *w, real t, const struct energy *energy, real work);

/* Returns the relative energy change (E - E_0 - work)/E_0 at the last sample, with E without damped energy [1]; NAN
 * if E_0 is 0. */
real diagnostics_energy_change(const struct diagnostics *w);

/* Finds the cuts of a step: clusters of particles with FLAG_CRACKED (fracture/places.h). list [n]: particles that
 * are searched, NULL for the first n; horizon: longest bond [m]; middle [dim, m]: reference position of one cut.
 * Returns the number of separate cuts; if 0, middle is unchanged. */
int64_t diagnostics_first_break(const struct particles *p, const int32_t *list, int64_t n, real horizon, real *middle);

/* Records bonds that broke at time t [s], and the first break of the run. broken: number of directed bonds; horizon:
 * longest bond [m]. Returns true if these are the first broken bonds of driven particles. */
bool diagnostics_breaks(struct diagnostics *w, const struct particles *p, real horizon, int64_t broken, real t);

/* Returns the largest speed of n listed particles [m/s]. */
real diagnostics_fastest(const struct particles *p, const int32_t *list, int64_t n);

/* Returns FAILED, with position, step and cause, if a position or velocity is not finite or a particle is faster
 * than `limit`, the fastest wave of the scene [m/s]. peridynamic, meshed: check peridynamic particles, and points of
 * a mesh; the kernels that move them report divergence, so that they need no check in most steps. step, t: for the
 * message. */
status diagnostics_divergence(const struct particles *p, bool peridynamic, bool meshed, real limit, int64_t step,
                              real t);

/* Saves or restores the diagnostics. */
status diagnostics_archive(struct diagnostics *w, struct archive *a);

#endif
