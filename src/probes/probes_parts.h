/* Shared declarations of the files of probes: a probe bound to its particles, and its state. */
#ifndef CLEAVE_PROBES_PARTS
#define CLEAVE_PROBES_PARTS

#include "probes/probes.h"

enum { RIGID_FIGURES = 5 };
/* State of a RIGID probe. */
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
    real factors[4];           /* SIF: K_I, K_II [Pa m^(1/2)], J [J/m^2], contour_spread [1] at the last sample */
    real along[2];             /* SIF: direction of the tip at the last sample */
    real time;                 /* SIF: time of the factors [s] */
    struct rigid_memory rigid; /* RIGID */
};

/* Motion of the particles of a probe at the time of a sample (probes_motion.c): stored before the step and
 * interpolated after it. */
struct sampled_motion {
    bool kept;                     /* x and v are those of t and t_velocity */
    bool complete;                 /* v is interpolated to t */
    real t, t_velocity;            /* of positions, of velocities [s] */
    real *x[DIM_MAX], *v[DIM_MAX]; /* [probe.n] in the order of probe.list [m], [m/s] */
};

struct probe {
    struct probe_request request; /* its region is kept by reference */
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

/* Readings of a particle: displacement, velocity, stress (in plane strain also zz), damage. */
enum { READINGS_MAX = 2 * DIM_MAX + SYM_MAX + 1 };

/* Returns the number of readings of a particle of p. */
int readings_count(const struct particles *p);

/* Returns name and unit of reading k of a particle. */
struct column reading_column(const struct particles *p, int k);

/* Computes the readings of particle i into value [readings_count]. */
void readings_of(const struct particles *p, int64_t i, real *value);

/* ---- motion at the time of a sample (probes_motion.c) ------------------------------------------------------------ */

/* Stores positions of o->t and velocities of o->t_velocity, before a step. */
void motion_keep(struct probe *q, const struct observed *o);

/* Interpolates the stored velocities to the time of the sample, after the step. now: time of the present velocities.
 * After the last step, which no step follows, positions are the present ones and velocities are extrapolated.
 * Without stored motion the particles are at rest. */
void motion_complete(struct probe *q, const struct observed *o, const struct velocity_time *now);

/* Ends the motion of a sample: positions and velocities are the present ones again. */
void motion_end(struct probe *q);

/* Frees the arrays of the motion. */
void motion_free(struct probe *q);

/* Returns component d of the position of the k-th particle of a probe [m]: of the sample's time while the motion is
 * complete, else the present one. */
static inline real probe_position(const struct probe *q, const struct particles *p, int d, int64_t k)
{
    return q->motion.complete ? q->motion.x[d][k] : p->x[d][q->list[k]];
}

/* Returns component d of the velocity of the k-th particle of a probe [m/s]: of the time of the sample while the motion
 * is complete, else the present one. */
static inline real probe_velocity(const struct probe *q, const struct particles *p, int d, int64_t k)
{
    return q->motion.complete ? q->motion.v[d][k] : p->v[d][q->list[k]];
}

/* ---- other kinds ------------------------------------------------------------------------------------------------- */

extern const char *const axis_name[DIM_MAX];

/* Returns the nearest particle to reference position X [dim, m], or -1 if X is outside the body. */
int32_t particle_nearest(const struct observed *o, const real *X);

/* Computes the reference position of station k of a LINE probe [dim, m]. */
void station_position(const struct probe *q, int dim, int k, real *X);

/* Returns the tip that a TIP probe follows at present, NULL if there is none. */
const struct tip *probe_tip(const struct probe *q, const struct tips *t);

/* Computes the sum of the reactions of all supports of the probe's boundary [dim, N], and the mean displacement of
 * their particles [dim, m]. */
void probe_reaction(const struct probe *q, const struct loads *l, int dim, real *force, real *displacement);

struct energies {
    real kinetic, strain, fracture; /* [J] */
};

/* Returns the energies of the particles of a probe. */
struct energies probe_energies(const struct probe *q, const struct observed *o);

/* Returns the kinetic energy of the particles of a probe [J]. */
real probe_kinetic(const struct probe *q, const struct particles *p);

/* Computes the momentum of the particles of a probe [dim, kg m/s]. */
void probe_momentum(const struct probe *q, const struct particles *p, real *momentum);

/* Amplitudes of a PULSE probe over the incident amplitude: reflected, as the difference from the baseline, and
 * transmitted; and the energy change beyond that of the baseline [1]. */
struct pulse_shares {
    real reflected, transmitted, energy_change;
};

/* Stores the incident amplitude of a PULSE probe. Returns REFUSED if nothing moves at the start. */
status pulse_bind(struct probe *q, const struct observed *o);

/* Returns reflected and transmitted amplitudes and the energy change of the present state. */
struct pulse_shares pulse_shares(const struct probe *q, const struct observed *o);

/* Tests whether a bar has separated along x; stores the plane of separation and the time in q->memory. */
void spall_sample(struct probe *q, const struct observed *o);

/* Computes the mean velocities along x of the lighter part of a separated bar and of the rest [m/s]. */
void spall_speeds(const struct probe *q, const struct particles *p, real *speed, real *speed_rest);

/* Tip position and length of a growing crack, its speed, and the equivalent factor K_eq that controls it. */
enum { GROWTH_FIGURES = 5 };
extern const struct column growth_figure[GROWTH_FIGURES];

/* Computes the figures of a growing crack into value [GROWTH_FIGURES]. */
void growth_readings(const struct growth *g, real *value);

/* ---- stress-intensity factors: SIF ------------------------------------------------------------------------------- */

enum { SIF_FIGURES = 4, SIF_CONTOURS_MAX = 16 };
extern const struct column sif_figure[SIF_FIGURES];

/* Finds the crack tip of a SIF probe, its contours and material. Returns REFUSED for bodies without a tip, and for
 * contours that leave the body or contain another tip or material. */
status sif_bind(struct probe *q, const struct observed *o);

/* Frees the tip and its contours. */
void sif_free(struct sif_tracked *w);

/* Stores the motion at o->t and o->t_velocity, before the step (probes_keep). */
void sif_keep(struct probe *q, const struct observed *o);

/* Computes the stress-intensity factors at the time of a sample into q->memory.factors. t_velocity: time of the present
 * velocities [s]. */
void sif_sample(struct probe *q, const struct observed *o, real t_velocity);

/* ---- rotating body: RIGID ---------------------------------------------------------------------------------------- */

extern const struct column rigid_figure[RIGID_FIGURES];

/* Stores angular momentum and kinetic energy of a RIGID probe at the start. Returns REFUSED unless the scene is plane.
 */
status rigid_bind(struct probe *q, const struct observed *o);

/* Computes the angle and the largest stresses of a RIGID probe into value[] and q->memory.rigid. */
void rigid_sample(struct probe *q, const struct observed *o, real *value);

/* Computes angular momentum and kinetic energy, once velocities are known. */
void rigid_sample_motion(struct probe *q, const struct particles *p, real *value);

/* ---- a bar against a closed form: EXACT -------------------------------------------------------------------------- */

struct bar {
    struct exact exact;
    int64_t n;
    int32_t *order, *rank;         /* particles from left to right; rank of each particle in that order */
    real *displacement, *velocity; /* [n] by rank [m], [m/s] */
    real *flux, *strain;           /* [n] by rank: stress by bond flux [Pa]; strain du/dx [1] */
};

/* Finds the particles, ends and load of the bar of an EXACT probe. Returns REFUSED for a bar that the closed form does
 * not describe. */
status bar_make(struct probe *q, const struct observed *o);

/* Frees a bar and its arrays. */
void bar_free(struct bar *b);

/* Computes displacement, velocity, flux and strain of all particles of a bar. */
void bar_measure(struct bar *b, const struct observed *o);

/* Computes the stress by bond flux [n, Pa] by rank: the force of all bonds that cross the centre of a particle, over
 * the section. A bond counts in full for particles strictly between its ends and by half for its ends; bonds to
 * mirror images are included. Material points have their Cauchy stress. */
void bar_flux(const struct bar *b, const struct observed *o, real *flux);

/* Figures of a bar in a fixed order; they are columns of the history, too. */
enum { BAR_FIGURES_MAX = 16 };

/* Returns the number of figures of a closed form. */
int bar_figures_count(enum exact_form form);

/* Returns name and unit of figure k of a closed form. */
struct column bar_figure(enum exact_form form, int k);

/* Measures the bar (bar_measure) and computes its figures into value [bar_figures_count]. */
void bar_figures(struct bar *b, const struct observed *o, real *value);

/* Columns of a bar's profile. */
enum { BAR_READINGS = 12 };
extern const struct column bar_reading[BAR_READINGS];

/* Computes the row of a bar profile for the particle with this rank into value [BAR_READINGS]. */
void bar_readings(const struct bar *b, const struct observed *o, int64_t rank, real *value);

#endif
