/* The balance of energy and momentum, the first break, and the check for diverged particles. */
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
    real time; /* [s] */
    struct energy energy;
    real external_work;     /* of loads and supports since the start [J] */
    real balance_error;     /* (E - E_0 - work) / largest of |E|, |work| so far [1] */
    real momentum[DIM_MAX]; /* [kg m/s] */
    real momentum_error;    /* |p - p_0 - impulse| / largest sum |m v|, most so far [1] */
    real spin[DIM_MAX];     /* L: angular momentum of free bodies about their centre [kg m^2/s] */
    real spin_error;        /* |L - L_0| / largest sum |L| of free bodies, most so far; NAN: unknown [1] */
};

struct diagnostics {
    struct energy_balance now;
    real energy_start, energy_scale;              /* [J] */
    real momentum_start[DIM_MAX], momentum_scale; /* [kg m/s] */
    real spin_start[DIM_MAX], spin_scale;         /* about the centre of mass [kg m^2/s] */
    bool turns;                                   /* spin_start is known: nothing outside acts on the bodies */
    bool started;
    real break_time;           /* first bond broken by load, driven particles' aside; NAN before [s] */
    real break_place[DIM_MAX]; /* reference place of a cut of that step (fracture/places.h) [m] */
    int64_t break_ends;        /* places of that step that lie apart */
    real driven_time;          /* first bond of a driven particle broken by load; NAN before [s] */
    int64_t bonds_broken;      /* directed, by load */
};

/* Nothing seen yet. Call once, before step 0. */
void diagnostics_make(struct diagnostics *w);

/* Momentum of p, and of the nodes of a mesh for its points (NULL: none), beside the impulse [N s] of loads and
 * supports up to the same velocities. */
void diagnostics_momentum(struct diagnostics *w, const struct particles *p, const struct grid *const *nodes, int grids,
                          const real *impulse);

/* Compares that with the start; only where nothing outside the bodies acts on them. */
void diagnostics_spin(struct diagnostics *w, const struct particles *p, const struct mesh *mesh, int bodies);

/* Fills the energies of `now` [J] and the work of loads and supports [J] for time t. After diagnostics_momentum. */
void diagnostics_balance(struct diagnostics *w, real t, const struct energy *energy, real work);

/* (E - E_0 - work)/E_0 at the last sample, what was damped left out of E [1]; NAN without energy at the start. */
real diagnostics_energy_change(const struct diagnostics *w);

/* Sets *middle to the reference place where FLAG_CRACKED says that bonds, of a horizon at most, have broken in this
 * step, among n listed particles (list NULL: the first n) [dim, m]. Returns the number of such places apart from each
 * other, of which it is one (fracture/places.h); 0: there is none. */
int64_t diagnostics_break_place(const struct particles *p, const int32_t *list, int64_t n, real horizon, real *middle);

/* Books `broken` directed bonds that have broken at time t [s], and from FLAG_CRACKED the first break of the run, of
 * bonds of at most a horizon [m]. Returns true where these are the first bonds of driven particles that break. */
bool diagnostics_breaks(struct diagnostics *w, const struct particles *p, real horizon, int64_t broken, real t);

/* Largest speed among `n` listed particles [m/s]. */
real diagnostics_fastest(const struct particles *p, const int32_t *list, int64_t n);

/* FAILED with place, step and cause if a position or velocity is not finite or a particle is faster than `limit`
 * [m/s] (the fastest wave of the scene). Peridynamic particles and points of a mesh are checked only if their flags
 * are set: the kernels that move them check them already. */
status diagnostics_divergence(const struct particles *p, bool peridynamic, bool meshed, real limit, int64_t step,
                              real t);

status diagnostics_archive(struct diagnostics *w, struct archive *a);

#endif
