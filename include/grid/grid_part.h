/* Room `grid`: material points on the grid of the current frame: their bodies, their contact, and the peridynamic
 * particles that the grid moves. It knows the run; conversion, the step and the engine call it. */
#ifndef CLEAVE_GRID_PART
#define CLEAVE_GRID_PART

#include "data/grid.h"
#include "data/turning.h"
#include "grid/active_points.h"
#include "grid/contact_grid.h"
#include "grid/grid_coupled.h"
#include "run/run.h"

/* A grid and its material points: all of them, or where bodies meet on the grid those of one body, whose velocities it
 * has. */
struct grid_field {
    struct grid grid;
    struct transfer_order order;
    struct constrained_set held; /* its nodes in driven regions and on mirrors */
    int64_t n;
    int32_t *list; /* [n] its points, ascending; NULL: all */
};

/* Material points on the grid of the current frame. */
struct grid_method {
    int fields; /* 1, or one a body */
    struct grid_field *field;
    struct grid_contact contact;   /* between fields */
    struct active_points active;   /* which of them the transfers leave out */
    struct grid_coupled coupled;   /* peridynamic particles that the grid moves (coupling pm .. pgg) */
    struct turning_groups turning; /* groups of them that turn together (FLIP) */
    struct transfer_data transfer;
    bool sort_needed;   /* points moved to other cells or converted */
    real smallest_mass; /* of a node that moves [kg] */
    real spacing;       /* of particles [m] */
};

/* Makes the grids of a run, with their nodes where its bodies want them; `meshed`: there are bodies in the reference
 * frame, whose particles lie midway between nodes. A second call moves the nodes. */
void grid_part_make(struct grid_method *mpm, const struct scene *s, const struct particles *p, bool meshed);
/* Makes the groups of points that turn together, where bodies may turn (FLIP). */
void grid_turning_make(struct grid_method *mpm, const struct particles *p, const struct loads *loads,
                       const struct scene *s, enum coupling coupling);
/* Sets `anchor` to a place of a node [m] where the body begins at `from`; `meshed`: midway between particles of a
 * lattice with a place at `site`. */
void grid_anchor(const struct scene *s, const real *from, const real *site, bool meshed, real *anchor);
/* Number of the body that comes k-th, those that are joined counted as one; -1: there is none. */
int body_apart(const struct scene *s, int k);
/* Does a mirror lie between two nodes? Nodes beyond it follow others one by one, extra nodes of a slit do not. */
bool grid_mirror_between(const struct grid *g, const struct scene *s);

/* Sorts the points on the grid in this step into cells. *lost: a place is not finite, and nothing is sorted. FAILED
 * where the grid would have too many nodes. */
status grid_sort(struct run *e, bool *lost);
/* Steps 1 and 3 of the algorithm: mass, momentum and forces of points to the nodes. */
void grid_map(struct grid_method *mpm, struct particles *p, const struct kernels *kernels, struct laps *laps);
/* Steps 3, 4, 6 and 7: nodes move, points follow, their strain and stress. middle: time in the middle of the step [s].
 */
void grid_step(struct run *e, real middle);
/* Sum of v . f over points on the grid where they are now, without any motion [W]; accounts of loads change. `middle`:
 * half a step later [s]. */
real grid_power(struct run *e, real middle);

#endif
