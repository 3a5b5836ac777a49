/* Scenes of `cleave bench efficiency`, which `cleave bench sensitivity` runs with other time steps. */
#ifndef CLEAVE_BENCH_EFFICIENCY
#define CLEAVE_BENCH_EFFICIENCY

#include "bench/common/bench.h"
#include "fracture/tips.h"

/* Share of peridynamic particles that the paper states for a time. */
struct mark {
    double time, share;
}; /* [s], [1] */

/* A scene with its model, spacing and goals. */
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

/* A variant: full peridynamics first, then adaptive runs with different levers (values of scene keys). */
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

/* Creates scene and run of a variant. dt: time step [s]; 0: that of the scene. Surface correction is used for
 * bond-based models only: state-based ones normalise with the existing family. */
status efficiency_make(struct run *e, struct scene *s, const struct scene_case *c, int variant, double dt);

/* Returns true if the model of a scene is bond-based. */
bool efficiency_of_bonds(const struct scene_case *c);

/* Returns true if a variant is run for a scene: finer scenes take long and are run with one lever only. */
bool efficiency_is_run(const struct scene_case *c, int variant);

/* Returns the smallest of the own time steps of all variants that are run for a scene [s]. */
status efficiency_step(const struct scene_case *c, double *dt);

/* Writes a title such as `kalthoff_winkler` or `kalthoff_winkler at 0.5 mm` and returns `text`, capacity `room`
 * [byte]. */
const char *efficiency_title(const struct scene_case *c, char *text, size_t room);

/* Writes the title, model and spacing as a quoted label of gnuplot with one word per line. */
void efficiency_tic(FILE *to, const struct scene_case *scene);

/* Crack tips at the end of a run. */
struct crack_ends {
    struct crack_tip tip[TIPS_MAX];
    int tips, longest; /* number of tips; index of the longest crack, -1: none grew */
    double start;      /* time of the first broken bond [s] */
};

/* Stores the crack tips of a run. */
void crack_ends_keep(struct crack_ends *c, const struct run *e);

/* Returns the crack tip of another run that ended nearest to the end of `tip`; NULL if no crack grew there. (The
 * nearest start may belong to a crack of one spacing that arrested beside the one that ran.) */
const struct crack_tip *crack_partner(const struct crack_ends *other, const struct crack_tip *tip);

/* Returns the distance of two positions [m]. */
double place_distance(const real *a, const real *b);

#endif
