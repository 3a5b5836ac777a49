/* Declares the types and functions that the files of probes (measurements during a run) share: a probe, the particles
 * that it observes, and its state. */
#ifndef CLEAVE_PROBES_PARTS
#define CLEAVE_PROBES_PARTS

#include "bonds/bonds.h"
#include "probes/probes.h"

/* Number of quantities that a RIGID probe reports. */
enum { RIGID_FIGURES = 5 };

/* State of a RIGID probe, which observes a rotating body: values at the start, and in `most` the largest absolute value
 * so far of each reported quantity, for the angle its last value. */
struct rigid_memory {
    /* at the start: angular momentum, sum of |m r x v| [kg m^2/s]; kinetic energy [J] */
    real spin, spin_scale, kinetic;
    real angle; /* accumulated angle [rad] */
    real most[RIGID_FIGURES];
};

/* State of a probe that checkpoints contain. It has no padding, since checkpoints store its bytes. */
struct probe_memory {
    real first_time;                    /* BREAK: time of the first cut; SPALL: of separation; NAN if none [s] */
    real position[DIM_MAX];             /* BREAK: position of the cut; SPALL: [0] of the plane [m] */
    int64_t ends;                       /* BREAK: number of separate cuts in that step */
    real incident;                      /* PULSE: largest speed at the start [m/s] */
    real force_max, force_square;       /* REACTION: largest |F| [N]; sum of F^2 over steps [N^2] */
    int64_t steps;                      /* REACTION: number of steps in that sum */
    real force_max_displacement;        /* REACTION: displacement at the largest |F| [m] */
    int64_t force_max_step, first_step; /* load steps of the largest |F| (REACTION) and of the first cut (BREAK) */
    int64_t body;                       /* SPALL: number of the broken bar */
    real trail[2][2];                   /* SIF: previous positions of the tip, for its direction [m] */
    real factors[4];    /* SIF: K_I, K_II [Pa m^(1/2)], J [J/m^2], contour_spread [1] at the last sample */
    real along[2];      /* SIF: direction of the tip at the last sample */
    real time;          /* SIF: time of the factors [s] */
    int64_t grew, said; /* SIF: bonds have broken at the tip; the warning of factors without meaning is printed */
    struct rigid_memory rigid; /* RIGID */
};

/* Positions and velocities of the particles of one probe at the time of a sample (line of history.csv). They are copied
 * before a time step and interpolated to the time of the sample after it (probes_motion.c). Owned by the probe. */
struct sampled_motion {
    bool kept;                     /* x and v are those of t and t_velocity */
    bool complete;                 /* v is interpolated to t */
    real t, t_velocity;            /* of positions, of velocities [s] */
    real *x[DIM_MAX], *v[DIM_MAX]; /* [probe.n] in the order of probe.list [m], [m/s] */
};

/* A probe of a run: its request from the input file, the particles that it observes, and its state. Capitals in
 * comments: the kinds of probes that use a member. */
struct probe {
    struct probe_request request; /* its region is kept by reference */
    bool of_history;              /* REACTION: added for a support that no probe of the scene measures; no results */
    bool rests;                   /* REACTION: of a support at rest, without columns of displacement */
    int first, columns;           /* index of its first column in the history; number of its columns */
    int64_t n;
    /* [n] particles of the region, the particle of the point, or those of stations, -1 outside the body */
    int32_t *list;
    struct probe_memory memory;
    struct sampled_motion motion; /* POINT, ENERGY, MOMENTUM, RIGID */
    struct bar *bar;              /* EXACT (probes_bar.c) */
    struct sif_tracked *sif;      /* SIF (probes_sif.c) */
    int growth;                   /* GROWTH: index of the growth in the run */
};

/* ---- readings of a single particle: POINT and LINE --------------------------------------------------------------- */

/* Largest number of values that a POINT or LINE probe reports of a particle: components of displacement, velocity and
 * stress (in plane strain also zz), damage, plastic strain and temperature. */
enum { READINGS_MAX = 2 * DIM_MAX + SYM_MAX + 3 };

/* Returns the number of values that a POINT or LINE probe (values at a point or along a line) reports of a particle:
 * components of displacement, velocity and stress, the damage, and plastic strain and temperature if p has these
 * arrays. */
int particle_probe_value_count(const struct particles *p);

/* Returns the name and unit of value `value_number` of those that a POINT or LINE probe (values at a point or along a
 * line) reports of a particle, 0 <= value_number < particle_probe_value_count(p). */
struct column particle_probe_value_column(const struct particles *p, int value_number);

/* Returns the damage of `particle` of the run o: the share of its bonds that are broken or have softened, by volume
 * [1]. */
static inline real probe_damage_of_particle(const struct observed_run *o, int64_t particle)
{
    const struct bonds *b = o->bonds;
    return o->part->damage[particle] + (b ? bonds_row_softening_damage(b, o->part, b->row_of[particle]) : 0);
}

/* Computes the values that a POINT or LINE probe (values at a point or along a line) reports of `particle` of the run o
 * and stores them in value[particle_probe_value_count(o->part)], in the order of particle_probe_value_column. */
void particle_compute_probe_values(const struct observed_run *o, int64_t particle, real *value);

/* ---- motion at the time of a sample (probes_motion.c) ------------------------------------------------------------ */

/* Copies the positions (at time o->t) and velocities (at time o->t_velocity) of the particles that probe observes in
 * the run o to probe->motion. Must be called before the time step. */
void probe_motion_store_before_step(struct probe *probe, const struct observed_run *o);

/* Computes the velocities of the particles of the probe in the run o at the time of the sample (line of history.csv).
 * Call it after the time step. Interpolates between the velocities that probe_motion_store_before_step has copied and
 * the present ones; after the last step, extrapolates them and uses the present positions. present_velocity_time: time
 * of the present velocities, and a factor on the result that removes half a step of damping. Does nothing if no
 * velocities were copied, as for equilibria; probe_particle_velocity_component then returns the present velocities. */
void probe_motion_interpolate_to_sample_time(struct probe *probe, const struct observed_run *o,
                                             const struct velocity_time *present_velocity_time);

/* Discards the positions and velocities of the probe that are interpolated to the time of a sample (line of
 * history.csv), so that probe_particle_position_component and probe_particle_velocity_component return the present
 * values again. */
void probe_motion_discard_interpolation(struct probe *probe);

/* Frees the copies of positions and velocities that probe_motion_store_before_step has made in the probe. */
void probe_motion_free(struct probe *probe);

/* Returns component `axis` of the position of particle probe->list[list_index] of p, which the probe observes [m].
 * After probe_motion_interpolate_to_sample_time it is the position at the time of the sample (line of history.csv),
 * until probe_motion_discard_interpolation; otherwise it is the present position. */
static inline real probe_particle_position_component(const struct probe *probe, const struct particles *p, int axis,
                                                     int64_t list_index)
{
    return probe->motion.complete ? probe->motion.x[axis][list_index] : p->x[axis][probe->list[list_index]];
}

/* Returns component `axis` of the velocity of particle probe->list[list_index] of p, which the probe observes [m/s].
 * After probe_motion_interpolate_to_sample_time it is the velocity at the time of the sample (line of history.csv),
 * until probe_motion_discard_interpolation; otherwise it is the present velocity. */
static inline real probe_particle_velocity_component(const struct probe *probe, const struct particles *p, int axis,
                                                     int64_t list_index)
{
    return probe->motion.complete ? probe->motion.v[axis][list_index] : p->v[axis][probe->list[list_index]];
}

/* ---- other kinds ------------------------------------------------------------------------------------------------- */

/* Names of the axes: x, y, z. */
extern const char *const axis_name[DIM_MAX];

/* Returns the index of the particle nearest to the reference position `position`, dim components [m]. Returns -1 if
 * `position` is outside the bodies, i.e. if no particle is within 3/4 of the diagonal of a lattice cell. o: the run as
 * probes see it (particles, bonds, time). */
int32_t probe_find_nearest_particle(const struct observed_run *o, const real *position);

/* Computes the reference position, position[dim] [m], of measuring point number `station` (0 .. probe->request.points -
 * 1) of a LINE probe. These points are equidistant from one end of the line to the other. */
void line_probe_compute_station_position(const struct probe *probe, int dim, int station, real *position);

/* Returns the crack tip that the TIP probe (position and growth of a crack tip) follows at present, or NULL if there is
 * none. The tip belongs to *tips. */
const struct crack_tip *probe_find_followed_crack_tip(const struct probe *probe, const struct crack_tips *tips);

/* Computes the reaction at the boundary that probe (a measurement during the run) observes, force[dim] [N]: the sum of
 * the members `reaction` of all entries of `loads` with the name of this boundary, i.e. of its supports, in load steps
 * (static equilibria) also of its forces. mean_displacement[dim]: receives the mean displacement of the particles that
 * they act on, each counted alike [m]. */
void probe_compute_reaction_of_supports(const struct probe *probe, const struct loads *loads, int dim, real *force,
                                        real *mean_displacement);

/* Energies of the particles of an ENERGY probe. */
struct energies {
    real kinetic, strain, fracture; /* [J] */
};

/* Returns the kinetic, strain and fracture energy [J] of the particles of the probe (a measurement during the run). o:
 * the current state of the run. */
struct energies probe_compute_energies_of_particles(const struct probe *probe, const struct observed_run *o);

/* Returns the kinetic energy [J] of those particles of p that probe (a measurement during the run) observes, with the
 * velocities of probe_particle_velocity_component. */
real probe_kinetic_energy(const struct probe *probe, const struct particles *p);

/* Computes the momentum, momentum[dim] [kg m/s], of those particles of p that probe (a measurement during the run)
 * observes, with the velocities of probe_particle_velocity_component. */
void probe_compute_momentum_of_particles(const struct probe *probe, const struct particles *p, real *momentum);

/* Results of a PULSE probe [1]: amplitudes of the reflected packet (difference from the baseline, a run on material
 * points alone) and of the transmitted packet, both divided by the incident amplitude; relative energy change in excess
 * of that of the baseline. */
struct pulse_amplitudes {
    real reflected, transmitted, energy_change;
};

/* Stores the largest initial speed of the body of the run o as the incident amplitude of the PULSE probe (amplitudes of
 * a wave packet). Returns REFUSED, with a message, if nothing moves at the start. */
status pulse_probe_store_incident_amplitude(struct probe *probe, const struct observed_run *o);

/* Returns the results of the PULSE probe (amplitudes of a wave packet): the amplitudes of the reflected and the
 * transmitted wave divided by the incident amplitude, and the relative energy change of the run o minus that of the
 * baseline, the same run with material points alone (subtracted only if o->baseline is not NULL). */
struct pulse_amplitudes pulse_probe_compute_amplitudes(const struct probe *probe, const struct observed_run *o);

/* Tests whether broken bonds separate the bar of the SPALL probe (place and time at which a bar spalls) into two parts
 * along x. If so, stores the position of the plane of separation and the time in probe->memory; else changes nothing.
 * o: the run as probes see it (particles, bonds, time). */
void spall_probe_detect_separation(struct probe *probe, const struct observed_run *o);

/* Computes the mean velocities along x of the two parts of the bar of the SPALL probe (place and time at which a bar
 * spalls), which broken bonds have separated: *lighter_part_speed and *remaining_part_speed [m/s]. p: particles. NAN
 * for a part without particles. */
void spall_probe_compute_part_speeds(const struct probe *probe, const struct particles *p, real *lighter_part_speed,
                                     real *remaining_part_speed);

/* Number of quantities that a GROWTH probe reports of a growing crack: tip position, length, speed, equivalent
 * stress-intensity factor K_eq. */
enum { GROWTH_FIGURES = 5 };

/* Names and units of the quantities that a GROWTH probe reports: x, y, length, speed, K_eq. */
extern const struct column growth_figure[GROWTH_FIGURES];

/* Computes the reported quantities of the growing crack g (position of its tip, length, speed, equivalent
 * stress-intensity factor) and stores them in value[GROWTH_FIGURES], in the order of the names in growth_figure[]: x, y
 * [m], length, speed, K_eq. */
void growing_crack_compute_probe_values(const struct growing_crack *g, real *value);

/* ---- stress-intensity factors: SIF ------------------------------------------------------------------------------- */

/* SIF_FIGURES: number of quantities that a SIF probe reports; SIF_CONTOURS_MAX: largest number of its integration
 * contours around a crack tip. */
enum { SIF_FIGURES = 4, SIF_CONTOURS_MAX = 16 };

/* Names and units of the quantities that a SIF probe reports: K_I, K_II, J, contour_spread. */
extern const struct column sif_figure[SIF_FIGURES];

/* Finds in the run o the crack tip of the SIF probe (stress-intensity factors), its integration contours, and the
 * material around the tip, and stores them in probe->sif. Release with sif_probe_free. Returns REFUSED, with a message,
 * if the body is not plane, no pre-crack ends inside a body, or the contours are too narrow, leave the body, or contain
 * another crack tip or material. */
status sif_probe_find_tip_and_contours(struct probe *probe, const struct observed_run *o);

/* Frees `tracked`, the crack tip and the contours of a SIF probe (stress-intensity factors), which
 * sif_probe_find_tip_and_contours has made; `tracked` may be NULL. */
void sif_probe_free(struct sif_tracked *tracked);

/* Copies positions (at time o->t) and velocities (at time o->t_velocity) near the crack tip of the SIF probe
 * (stress-intensity factors), before the time step. */
void sif_probe_store_motion_before_step(struct probe *probe, const struct observed_run *o);

/* Computes K_I, K_II and J of the SIF probe (stress-intensity factors) and their relative differences between its
 * integration contours. The values are those of the run o at the time of the sample (line of history.csv) and are
 * stored in probe->memory.factors. velocity_time: time of the present velocities [s]. */
void sif_probe_compute_intensity_factors(struct probe *probe, const struct observed_run *o, real velocity_time);

/* Returns true if the stress-intensity factors of SIF probe at its last sample (line of history.csv) are reliable: they
 * were computed, and contour_spread, their relative difference between the integration contours, is at most 0.2. */
bool sif_probe_factors_are_meaningful(const struct probe *probe);

/* Returns quantity number `quantity_number` (0 to 3: K_I, K_II, J, contour_spread) of SIF probe (stress-intensity
 * factors) at its last sample (line of history.csv). Returns NAN for K_I, K_II and J if they are not reliable
 * (sif_probe_factors_are_meaningful). */
static inline real sif_probe_last_sample_value_or_nan(const struct probe *probe, int quantity_number)
{
    const bool valid = quantity_number == SIF_FIGURES - 1 || sif_probe_factors_are_meaningful(probe);
    return valid ? probe->memory.factors[quantity_number] : NAN;
}

/* ---- rotating body: RIGID ---------------------------------------------------------------------------------------- */

/* Names and units of the quantities that a RIGID probe reports: angle, stress_max, shear_max, and the relative changes
 * of angular momentum and kinetic energy. */
extern const struct column rigid_figure[RIGID_FIGURES];

/* Stores in the probe the angular momentum and the kinetic energy of the particles of the RIGID probe (conservation in
 * a body that moves rigidly) at the start of the run o. Returns REFUSED, with a message, if the run is not in a
 * plane. */
status rigid_probe_store_initial_motion(struct probe *probe, const struct observed_run *o);

/* Computes the rotation angle value[0] of the body of a RIGID probe (conservation in a body that moves rigidly) [rad],
 * its largest absolute principal stress value[1] and its largest in-plane shear stress value[2] [Pa] at the present
 * positions, and updates probe->memory.rigid. o: the run as probes see it (particles, bonds, time). */
void rigid_probe_compute_rotation_angle_and_stresses(struct probe *probe, const struct observed_run *o, real *value);

/* Computes the change of the angular momentum, value[3], and of the kinetic energy, value[4], of the body of the RIGID
 * probe (conservation in a body that moves rigidly), from the particles p, relative to the values at the start [1];
 * both should be conserved. NAN if the value at the start is 0. Call this function when the velocities at the time of
 * the sample (line of history.csv) are known. */
void rigid_probe_compute_conservation_errors(struct probe *probe, const struct particles *p, real *value);

/* ---- a bar against a closed form: EXACT -------------------------------------------------------------------------- */

/* The bar that an EXACT probe compares with a closed-form solution, and the measured fields of its particles. */
struct bar {
    struct exact exact;
    int64_t n;
    int32_t *order, *rank;         /* particles from left to right; rank of each particle in that order */
    real *displacement, *velocity; /* [n] by rank [m], [m/s] */
    real *flux, *strain;           /* [n] by rank: stress by bond flux [Pa]; strain du/dx [1] */
};

/* Finds the particles, ends, material and load of the bar of an EXACT probe (comparison of a bar with a closed-form
 * solution) and allocates probe->bar for them. Release with bar_probe_free_bar. Returns REFUSED, with a message, if the
 * bar or its loads differ from what the closed-form solution describes. o: the run as probes see it (particles, bonds,
 * time). */
status bar_probe_find_bar_and_load(struct probe *probe, const struct observed_run *o);

/* Frees the bar of an EXACT probe (comparison of a bar with a closed-form solution), which bar_probe_find_bar_and_load
 * has made, with its arrays; `bar` may be NULL. */
void bar_probe_free_bar(struct bar *bar);

/* Computes displacement [m], velocity [m/s], stress by bond flux (force of all bonds across a section, divided by its
 * area) [Pa] and strain of all particles of the body `bar` of the run o along x. Stores them in the arrays
 * `displacement`, `velocity`, `flux` and `strain` of *bar, in the order of the particles from left to right. */
void bar_probe_measure_fields(struct bar *bar, const struct observed_run *o);

/* Computes the stress by bond flux of each particle of `bar` in the run o, stress[n] by rank from left to right [Pa]:
 * the sum of the forces of all bonds that cross the centre of the particle, divided by the cross section of the bar. A
 * bond counts fully for particles strictly between its two ends and by half for the particles at its ends. Bonds to
 * mirror images (copies of particles beyond planes of symmetry) are included. Material points have their Cauchy stress
 * instead. */
void bar_probe_compute_bond_flux_stress(const struct bar *bar, const struct observed_run *o, real *stress);

/* Largest number of quantities that an EXACT probe (comparison of a bar with a closed-form solution) reports. Each
 * quantity is also a column of history.csv. */
enum { BAR_FIGURES_MAX = 16 };

/* Returns the number of quantities that an EXACT probe (comparison of a bar with a closed-form solution) reports for
 * the closed-form solution `closed_form`. */
int bar_probe_value_count(enum exact_form closed_form);

/* Returns the name and unit of quantity `value_number` that an EXACT probe (comparison of a bar with a closed-form
 * solution) reports for the solution `closed_form`, 0 <= value_number < bar_probe_value_count(closed_form). */
struct column bar_probe_value_column(enum exact_form closed_form, int value_number);

/* Updates the measured fields of a bar (bar_probe_measure_fields), compares them with the closed-form solution, and
 * stores the reported quantities in value[bar_probe_value_count], in the order of bar_probe_value_column. o: the run as
 * probes see it (particles, bonds, time). */
void bar_probe_compute_values(struct bar *bar, const struct observed_run *o, real *value);

/* Number of columns of the profile of a bar, the table of values along the bar that is written with each output frame
 * (state at one time). */
enum { BAR_READINGS = 12 };

/* Names and units of the columns of the profile of a bar. */
extern const struct column bar_reading[BAR_READINGS];

/* Computes one line of the profile (table of values along the bar, beside the closed-form solution) of `bar` in the run
 * o, for one particle, and stores it in value[BAR_READINGS], in the order of bar_reading[]. rank_from_left: position of
 * the particle in the order from left to right, from 0. */
void bar_probe_compute_profile_line(const struct bar *bar, const struct observed_run *o, int64_t rank_from_left,
                                    real *value);

#endif
