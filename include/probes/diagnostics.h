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

/* Energy, momentum and angular momentum of a run at the last sample (line of history.csv), and the errors of their
 * balances. */
struct energy_balance {
    real time;              /* of the sample [s] */
    struct energy energy;   /* energies by kind [J] */
    real external_work;     /* work of loads and supports since the start [J] */
    real balance_error;     /* (E - E_0 - work) divided by the largest |E| or |work| so far [1] */
    real momentum[DIM_MAX]; /* of all bodies [kg m/s] */
    real momentum_error;    /* largest |p - p_0 - impulse| so far, divided by the largest sum |m v| so far [1] */
    real spin[DIM_MAX];     /* L: angular momentum of free bodies about their common centre of mass [kg m^2/s] */
    real spin_error;        /* largest |L - L_0| so far, divided by the largest sum |L_body| [1]; NAN: not measured */
};

/* Balances of a run, the values from which their errors are computed, and the first bonds broken. */
struct diagnostics {
    struct energy_balance now;       /* energies at the last sample */
    real energy_start, energy_scale; /* energy minus work at the start; largest energy or work so far [J] */
    real mass;                       /* mass of all particles, set by the caller; 0: unknown [kg] */
    real internal_scale;             /* largest energy so far without that of the common motion of all particles [J] */
    real momentum_start[DIM_MAX], momentum_scale; /* momentum at the start; largest sum |m v| so far [kg m/s] */
    real spin_start[DIM_MAX], spin_scale; /* angular momentum at the start; largest sum |L_body| so far [kg m^2/s] */
    bool turns;                           /* spin_start is set, which requires free bodies */
    bool started;                         /* the values at the start are set */
    real break_time; /* time of the first bond broken by load, except bonds of driven particles; NAN if none [s] */
    real break_position[DIM_MAX]; /* reference position of a cut of that step (fracture/places.h) [m] */
    int64_t break_ends;           /* number of separate cuts in that step */
    real driven_time;             /* time of the first bond of a driven particle broken by load; NAN if none [s] */
    int64_t bonds_broken;         /* number of directed bonds broken by load so far */
};

/* Initialises the diagnostics *diagnostics before the first time step: sums are 0; times and positions of breaks are
 * NAN, since no bond has broken yet. */
void diagnostics_initialise(struct diagnostics *diagnostics);

/* Computes the total momentum of the particles p and of the mesh nodes, stores it in diagnostics->now.momentum, and
 * updates diagnostics->now.momentum_error, the largest error so far. nodes[grid_count]: grids whose nodes carry the
 * mass of their points. impulse: impulse of loads and supports from the start to the time of the velocities, dim
 * components [N s]. */
void diagnostics_update_momentum(struct diagnostics *diagnostics, const struct particles *p,
                                 const struct grid *const *nodes, int grid_count, const real *impulse);

/* Computes the angular momentum of the free bodies of particles p about their common centre of mass, stores it in
 * diagnostics->now.spin, and updates diagnostics->now.spin_error, the largest error so far. mesh: mesh by which
 * material points move, NULL if none of its nodes carries mass. body_count: number of bodies of the scene. Call this
 * function only if no load, support or mirror acts on the bodies, since angular momentum is conserved only then. */
void diagnostics_update_angular_momentum(struct diagnostics *diagnostics, const struct particles *p,
                                         const struct mesh *mesh, int body_count);

/* Stores the energies *energy of the run at time t [s] and the work of loads and supports since the start, `work` [J],
 * in diagnostics->now, and computes the error of the energy balance, diagnostics->now.balance_error. Call this function
 * after diagnostics_update_momentum; its first call defines the energy and momentum at the start. */
void diagnostics_update_energy_balance(struct diagnostics *diagnostics, real t, const struct energy *energy, real work);

/* Returns the relative energy change (E - E_0 - work)/E_0 [1] at the last sample of w. E is the sum of all energies
 * except the energy taken by damping, E_0 that sum at the start, and `work` the work of loads and supports. Returns NAN
 * if E_0 is not positive. */
real diagnostics_relative_energy_balance_error(const struct diagnostics *diagnostics);

/* Finds the groups of bonds that broke in this time step: clusters of particles of p whose flag FLAG_CRACKED (bond lost
 * in this step) is set and that are at most `horizon` apart. searched_particles[particle_count]: numbers of the
 * particles that are searched; NULL for particles 0 .. particle_count - 1. horizon: length of the longest bond [m].
 * cluster_centre: receives the reference position of the middle of one cluster, dim components [m]. Returns the number
 * of clusters; if it is 0, `cluster_centre` is unchanged. */
int64_t diagnostics_count_clusters_of_new_bond_breaks(const struct particles *p, const int32_t *searched_particles,
                                                      int64_t particle_count, real horizon, real *cluster_centre);

/* Adds the bonds that broke in the step at time t [s], `broken_bond_count` (each counted for both of its particles), to
 * the number of broken bonds in w. If they are the first ones of the run, stores t and the position of the break: the
 * middle of a cluster of particles of p that lost bonds and are at most `horizon`, the length of the longest bond [m],
 * apart. Returns true if driven particles (particles with prescribed motion) lost bonds in this step for the first time
 * in the run. */
bool diagnostics_count_broken_bonds_and_record_first(struct diagnostics *diagnostics, const struct particles *p,
                                                     real horizon, int64_t broken_bond_count, real t);

/* Searches for particles of p whose position or velocity is not finite or whose speed exceeds `max_speed`, the fastest
 * wave speed of the scene [m/s]. check_peridynamic: search the peridynamic particles too; check_mesh_points: search the
 * material points of a mesh too. Both are false in most steps, since the functions that move these particles detect
 * divergence. step, t: number and time [s] of the step, for the message. Returns FAILED if there is such a particle,
 * with its position and the cause in the message. */
status diagnostics_check_particles_for_divergence(const struct particles *p, bool check_peridynamic,
                                                  bool check_mesh_points, real max_speed, int64_t step, real t);

/* Saves the diagnostics to the archive `a` (checkpoint file or memory) if a->saving is set, else restores them from it.
 * Returns FAILED if an entry is missing or has another size. */
status diagnostics_save_or_load(struct diagnostics *diagnostics, struct archive *a);

/* Returns true if the energies `diagnostics` of the run so far are mere round-off, so that relative energy errors mean
 * nothing: they are below 1e-24 of the kinetic energy of the whole body at the wave speed. mass: mass of the body [kg];
 * wave_speed: speed of the fastest wave [m/s]. */
bool diagnostics_energies_are_only_round_off(const struct diagnostics *diagnostics, real mass, real wave_speed);

/* Returns the energy [J] that breaking bonds have released in excess of the energy that they had stored: minus the
 * fracture energy of the last sample of the diagnostics if that is negative, else 0. Only bonds of state-based models
 * can have such an excess. */
real diagnostics_bond_energy_release_beyond_stored(const struct diagnostics *diagnostics);

#endif
