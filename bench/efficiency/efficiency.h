/* The scenes of `cleave bench efficiency`, which `cleave bench sensitivity` runs at other time steps. */
#ifndef CLEAVE_BENCH_EFFICIENCY
#define CLEAVE_BENCH_EFFICIENCY

#include "bench/common/bench.h"
#include "fracture/tips.h"

/* What the paper says of the share of peridynamic particles. */
struct mark {
    double time, share;
}; /* [s], [1] */

struct scene_case {
    const char *name, *path, *model;
    const char *tips;    /* conversion.tips of adaptive runs: horizons */
    const char *spacing; /* finer than the scene's own; NULL: that */
    double aim;          /* t_r with all levers; NAN: none */
    bool quick;          /* short enough for --quick, and the paper's model */
    double paper_t_r;    /* NAN: none */
    int marks;
    struct mark mark[2];
};

enum { EFFICIENCY_CASES = 22 };
extern const struct scene_case efficiency_case[EFFICIENCY_CASES];

/* Full peridynamics first, then adaptive runs by what they may save with. */
struct way {
    const char *method, *levers, *frame, *rest, *back, *notch;
    bool coarse;        /* levels of coarse cells: one, two in finer scenes */
    const char *colour; /* of its bars; NULL: it has none */
};
enum { WAY_PD = 0, WAY_FRAME = 2, WAY_SLITS = 3, WAY_LEVELS = 4, WAYS = 8, EFFICIENCY_SAMPLES = 100 };
extern const struct way efficiency_way[WAYS];

/* Scene and engine of a method; time step 0: its own. The correction of surfaces is for bonds alone: state-based
 * families know what they have left. */
status efficiency_make(struct run *e, struct scene *s, const struct scene_case *c, int way, double dt);
bool efficiency_of_bonds(const struct scene_case *c);
/* Finer scenes are long, and one way is enough to see what finer means. */
bool efficiency_is_run(const struct scene_case *c, int way);
/* The smallest of the own steps of all ways that are run [s]. */
status efficiency_step(const struct scene_case *c, double *dt);
/* `kalthoff_winkler`, `kalthoff_winkler at 0.5 mm`. */
const char *efficiency_title(const struct scene_case *c, char *text, size_t room);

/* The same in quotes for a picture: a word a line, model, spacing. */
void efficiency_tic(FILE *to, const struct scene_case *scene);

/* Where cracks are at the end of a run. */
struct crack_ends {
    struct tip tip[TIPS_MAX];
    int tips, longest; /* longest -1: none grew */
    double start;      /* first cut bond [s] */
};
void crack_ends_keep(struct crack_ends *c, const struct run *e);
/* The tip of the other method that started nearest to where this one did; NULL without. */
const struct tip *crack_partner(const struct crack_ends *other, const struct tip *tip);
double place_distance(const real *a, const real *b);

#endif
