/* Declarations shared by the files of the probes: a probe bound to its particles, and its state. */
#ifndef CLEAVE_PROBES_PARTS
#define CLEAVE_PROBES_PARTS

#include "probes/probes.h"

enum { RIGID_FIGURES = 5 };
/* RIGID: values at the start, and the figures: the angle accumulated so far, the largest |.| of all other figures. */
struct rigid_memory {
    real spin, spin_scale, kinetic; /* angular momentum, sum of |m r x v| [kg m^2/s]; [J] */
    real angle;                     /* [rad] */
    real most[RIGID_FIGURES];
};

/* State of a probe that does not follow from the state of the run. It has no padding: it goes to checkpoints byte by
 * byte. */
struct probe_memory {
    real first_time;                    /* BREAK: first cut; SPALL: separation; NAN before [s] */
    real place[DIM_MAX];                /* BREAK: of the cut (fracture/places.h); SPALL: [0] the plane [m] */
    int64_t ends;                       /* BREAK: places of that first cut that lie apart */
    real incident;                      /* PULSE: largest speed at the start [m/s] */
    real force_max, force_square;       /* REACTION: largest |F|; sum of F^2 [N], [N^2] */
    int64_t steps;                      /* REACTION: in that sum */
    real force_max_displacement;        /* REACTION: then [m] */
    int64_t force_max_step, first_step; /* load steps of these: REACTION, BREAK */
    int64_t body;                       /* SPALL: the bar that broke */
    real trail[2][2];                   /* SIF: earlier places of the tip, for its direction [m] */
    real factors[4];                    /* SIF: K_I, K_II, J, contour_spread at the last sample */
    real along[2];                      /* SIF: direction of the tip at the last sample */
    real time;                          /* SIF: of the factors [s] */
    struct rigid_memory rigid;          /* RIGID */
};

/* Motion of a probe's particles at the time of a sample (probes_motion.c): kept before the step, completed after it. */
struct sampled_motion {
    bool kept;                     /* x and v are those of t and t_velocity */
    bool complete;                 /* v is that of t, too */
    real t, t_velocity;            /* [s] */
    real *x[DIM_MAX], *v[DIM_MAX]; /* [probe.n] by number in probe.list [m], [m/s] */
};

struct probe {
    struct probe_request request; /* its region is borrowed from the scene */
    int first, columns;           /* index of its first column in the history; their number */
    int64_t n;
    int32_t *list; /* particles of the region; the point; stations, -1: outside */
    struct probe_memory memory;
    struct sampled_motion motion; /* POINT, ENERGY, MOMENTUM, RIGID */
    struct bar *bar;              /* EXACT: probes_bar.c */
    struct sif_tracked *sif;      /* SIF: probes_sif.c */
    int growth;                   /* GROWTH: which of the run */
};

/* ---- readings of a single particle: POINT and LINE --------------------------------------------------------------- */

/* displacement, velocity, stress (in plane strain also zz), damage */
enum { READINGS_MAX = 2 * DIM_MAX + SYM_MAX + 1 };
int readings_count(const struct particles *p);
struct column reading_column(const struct particles *p, int k);
void readings_of(const struct particles *p, int64_t i, real *value);

/* ---- motion at the time of a sample (probes_motion.c) ------------------------------------------------------------ */

/* Keeps positions of o->t and velocities of o->t_velocity, before the step. */
void motion_keep(struct probe *q, const struct observed *o);

/* Completes the motion that was kept, after the step: velocities of the sample's time, linear between those kept and
 * the present ones of time `now`. Where positions are of a later time than those kept, there is no step behind the
 * sample: positions are the present ones, and the line is continued. Without a `keep` before, nothing moves. */
void motion_complete(struct probe *q, const struct observed *o, const struct velocity_time *now);

/* Forgets the motion; releases its arrays. */
void motion_end(struct probe *q);
void motion_free(struct probe *q);

/* Returns a component of position [m] or velocity [m/s] of the k-th particle of the probe: of the sample's time where
 * the motion is complete, else the present one. */
static inline real probe_position(const struct probe *q, const struct particles *p, int d, int64_t k)
{
    return q->motion.complete ? q->motion.x[d][k] : p->x[d][q->list[k]];
}
static inline real probe_velocity(const struct probe *q, const struct particles *p, int d, int64_t k)
{
    return q->motion.complete ? q->motion.v[d][k] : p->v[d][q->list[k]];
}

/* ---- other kinds ------------------------------------------------------------------------------------------------- */

extern const char *const axis_name[DIM_MAX];

/* Nearest particle of the body to the reference position X, -1 where X lies outside the body. */
int32_t particle_nearest(const struct observed *o, const real *X);
void station_position(const struct probe *q, int dim, int k, real *X);

/* The tip that a TIP probe follows at present; NULL if there is none. */
const struct tip *probe_tip(const struct probe *q, const struct tips *t);

/* Sum of the reactions of all supports of the probe's boundary, and mean displacement of their particles. */
void probe_reaction(const struct probe *q, const struct loads *l, int dim, real *force, real *displacement);

struct energies {
    real kinetic, strain, fracture;
}; /* [J] */
struct energies probe_energies(const struct probe *q, const struct observed *o);
real probe_kinetic(const struct probe *q, const struct particles *p); /* [J] */
void probe_momentum(const struct probe *q, const struct particles *p, real *momentum);

/* PULSE: shares of the incident amplitude, reflected as the difference from the run without interface. */
struct pulse_shares {
    real reflected, transmitted, energy_change;
};
status pulse_bind(struct probe *q, const struct observed *o);
struct pulse_shares pulse_shares(const struct probe *q, const struct observed *o);

/* Tests whether a bar has separated; stores where and when. After that: mean velocity along x of the lighter part and
 * of the rest [m/s]. */
void spall_sample(struct probe *q, const struct observed *o);
void spall_speeds(const struct probe *q, const struct particles *p, real *speed, real *speed_rest);

/* GROWTH: place and length of the tip, its speed, and K_eq of the factors that control it. */
enum { GROWTH_FIGURES = 5 };
extern const struct column growth_figure[GROWTH_FIGURES];
void growth_readings(const struct growth *g, real *value);

/* ---- stress-intensity factors: SIF ------------------------------------------------------------------------------- */

enum { SIF_FIGURES = 4, SIF_CONTOURS_MAX = 16 };
extern const struct column sif_figure[SIF_FIGURES];
/* Finds the tip; refuses bodies without one, and contours that leave the body or reach another tip or material. */
status sif_bind(struct probe *q, const struct observed *o);
void sif_free(struct sif_tracked *w);
/* Stores the motion at o->t and o->t_velocity, before the step (probes_keep). */
void sif_keep(struct probe *q, const struct observed *o);
/* Fills q->memory.factors. */
void sif_sample(struct probe *q, const struct observed *o, real t_velocity);

/* ---- rotating body: RIGID ---------------------------------------------------------------------------------------- */

extern const struct column rigid_figure[RIGID_FIGURES];
status rigid_bind(struct probe *q, const struct observed *o);
/* Fill value[] and q->memory.rigid: angle and stresses; then, once velocities are known, angular momentum and kinetic
 * energy. */
void rigid_sample(struct probe *q, const struct observed *o, real *value);
void rigid_sample_motion(struct probe *q, const struct particles *p, real *value);

/* ---- a bar against a closed form: EXACT -------------------------------------------------------------------------- */

struct bar {
    struct exact exact;
    int64_t n;
    int32_t *order, *rank;         /* particles from left to right; place of a particle among them */
    real *displacement, *velocity; /* [n] by rank, from bar_measure [m], [m/s] */
    real *flux, *strain;           /* [n] the stress by bond flux [Pa]; du/dx [1] */
};

/* Finds the bar, its ends and its load; refuses what the closed form does not describe. */
status bar_make(struct probe *q, const struct observed *o);
void bar_free(struct bar *b);
void bar_measure(struct bar *b, const struct observed *o);

/* Stress `flux` [n] by rank [Pa]: for peridynamic particles the force of all bonds that cross the centre of a particle,
 * over the section. A bond counts in full for particles strictly between its ends and by half for its ends; bonds to
 * mirror images are included. Material points have their Cauchy stress. */
void bar_flux(const struct bar *b, const struct observed *o, real *flux);

/* The figures of a bar's form, in a fixed order; they are columns of the history, too. */
enum { BAR_FIGURES_MAX = 16 };
int bar_figures_count(enum exact_form form);
struct column bar_figure(enum exact_form form, int k);
void bar_figures(struct bar *b, const struct observed *o, real *value);

/* Columns and rows of the bar's profile. */
enum { BAR_READINGS = 12 };
extern const struct column bar_reading[BAR_READINGS];
void bar_readings(const struct bar *b, const struct observed *o, int64_t rank, real *value);

#endif
