/* Scenes of `cleave bench efficiency`, which `cleave bench sensitivity` runs with other time steps. */
#ifndef CLEAVE_BENCH_EFFICIENCY
#define CLEAVE_BENCH_EFFICIENCY

#include "bench/common/bench.h"
#include "fracture/tips.h"

/* Share of peridynamic particles that Zeng et al. 2022 state for a time. time [s]; share [1]. */
struct mark {
    double time, share;
};

/* A scene with its model, spacing and goals. t_r = 1 - t_adaptive/t_PD: computing time that an adaptive run saves,
 * divided by the computing time of full peridynamics. paper: Zeng et al. 2022. mark[marks]: shares of peridynamic
 * particles in the paper. */
struct scene_case {
    const char *name, *path, *model;
    const char *tips;    /* conversion.tips of adaptive runs [horizons] */
    const char *spacing; /* particles.spacing; NULL: that of the scene */
    double aim;          /* required t_r with all levers; NAN: none */
    bool quick;          /* short enough for --quick; has the paper's model */
    double paper_t_r;    /* t_r in Table 1 of the paper; NAN: none */
    int marks;
    struct mark mark[2];
};

enum { EFFICIENCY_CASES = 21 };
extern const struct scene_case efficiency_case[EFFICIENCY_CASES];

/* A variant: full peridynamics first, then adaptive runs with different levers, the options by which they save time.
 * levers: name of the options. frame, rest, back, notch: values of the scene keys mpm.frame, time.active_set,
 * conversion.reversion and conversion.notch. */
struct variant {
    const char *method, *levers, *frame, *rest, *back, *notch;
    bool coarse;        /* with levels of coarse cells: one, two in finer scenes */
    const char *colour; /* colour of its bars; NULL: not drawn */
};
enum {
    VARIANT_PD = 0,
    VARIANT_FRAME = 2,
    VARIANT_SLITS = 3,
    VARIANT_LEVELS = 4,
    VARIANTS = 8,
    EFFICIENCY_SAMPLES = 100
};
extern const struct variant efficiency_variant[VARIANTS];

/* Reads the scene of the case c with the settings efficiency_variant[variant] into *s and creates its run in *e.
 * time_step: time step [s]; 0: that of the scene. The correction of bonds near faces is used for bond-based models
 * only, since state-based models normalise with the existing neighbours. Returns REFUSED or FAILED if the scene is
 * invalid. Release with bench_engine_free. */
status efficiency_make_run_of_variant(struct run *run, struct scene *s, const struct scene_case *c, int variant,
                                      double time_step);

/* Returns true if the peridynamic model of the scene c is bond-based. */
bool efficiency_scene_is_bond_based(const struct scene_case *c);

/* Returns true if efficiency_variant[variant] is run for the scene c: all variants at the scene's own spacing, and at
 * finer spacings, which take long, only full peridynamics and the variants `frame`, `slits` and `levels`. */
bool efficiency_variant_is_run_for_scene(const struct scene_case *c, int variant);

/* Finds the smallest of the time steps [s] that the variants of the scene c (efficiency_variant_is_run_for_scene) would
 * choose, so that all variants can be run with the same time step, and stores it in *time_step. Returns REFUSED or
 * FAILED if a run cannot be created. */
status efficiency_find_common_time_step(const struct scene_case *c, double *time_step);

/* Writes a title of the scene c such as `kalthoff_winkler` or `kalthoff_winkler at 0.5 mm` into text[capacity], and
 * returns text. */
const char *efficiency_title(const struct scene_case *c, char *text, size_t capacity);

/* Writes name, model and spacing of `scene` to the stream `gnuplot` as a quoted label, with one word per line. */
void efficiency_write_tic_label(FILE *gnuplot, const struct scene_case *scene);

/* Crack tips at the end of a run, by which runs of different methods are compared. */
struct crack_ends {
    struct crack_tip tip[TIPS_MAX];
    int tips, longest; /* number of tips; index of the longest crack, -1: none grew */
    double start;      /* time of the first broken bond [s] */
};

/* Stores the crack tips, the longest crack and the time of the first broken bond of the run in *c. */
void crack_ends_store_from_run(struct crack_ends *c, const struct run *run);

/* Finds the crack tip of `other_run` that corresponds to `tip`: among the tips of cracks that grew, the one whose final
 * position is nearest to that of `tip`. Final positions are compared because the nearest initial position may belong to
 * a crack that grew by only one spacing beside the long one. Returns NULL if no crack of the other run grew. */
const struct crack_tip *crack_tip_nearest_in_other_run(const struct crack_ends *other_run, const struct crack_tip *tip);

/* Returns the distance [m] between the points position[DIM_MAX] and other_position[DIM_MAX] [m]; components that the
 * space lacks must be 0. */
double position_distance(const real *position, const real *other_position);

#endif
