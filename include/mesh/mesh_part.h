/* Bodies in the reference frame, as a part of a run. */
#ifndef CLEAVE_MESH_PART
#define CLEAVE_MESH_PART

#include "data/hollow.h"
#include "mesh/levels.h"
#include "mesh/mesh_make.h"
#include "run/run.h"

/* Frame of a body, and why where the scene does not say current. */
struct frame_choice {
    bool reference;
    const char *reason;
};

/* A disc that keeps the smallest cells: the ring of a sif probe [m]. */
struct frame_ring {
    real place[2], radius;
};

/* Points of hollow coarse cells in the last frame. */
struct hollow_points {
    struct particles part;
    real *spacing;                     /* [m] */
    real *gradient[DIM_MAX * DIM_MAX]; /* of their displacement, where frames are asked for strain [1] */
};

/* Bodies in the reference frame: a mesh of cells fixed to the material. */
struct reference_frame {
    int bodies;
    struct frame_choice *choice; /* [bodies] */
    real spacing;                /* of particles [m] */
    bool finite;                 /* strains are finite, not small */
    bool converts;               /* points whose stress is large become peridynamic */
    bool active_set;             /* nodes that no wave has reached are left out */
    bool room_limits;            /* `room` bounds the levels, which the scene does not give */
    struct mesh mesh;
    struct mesh_source source;
    struct elastic *elastic;   /* [materials] constants of its cells */
    struct mesh_levels levels; /* coarse cells */
    uint8_t *room;             /* [mesh.grid.n] level that the body is thick enough for; NULL: not asked */
    int room_most;             /* the largest of these */
    struct hollow hollow;      /* cells whose particles are not made */
    bool lacks;                /* particles that the start needs are not made: it must be made again */
    struct elastic *coarse;    /* [materials] of coarse cells, which split at less than the trigger */
    int rings;
    struct frame_ring *ring; /* [scene->probes] discs of the smallest cells, now */
    struct hollow_points shown;
    real speed; /* largest component of a nodal velocity [m/s] */
};

/* Chooses the frame of each body, with the reason, and marks the particles of those in the reference frame; makes the
 * grid, which the choice needs. REFUSED where the scene asks for what cannot be. */
status frames_choose(struct reference_frame *r, struct grid_method *mpm, struct particles *p, const struct scene *s);
/* Is any body in the reference frame? */
bool frame_any(const struct reference_frame *r);
/* Are the particles one piece of lattice that fits the cells of the grid, as the reference frame requires? */
bool frame_allowed(const struct reference_frame *r, const struct particles *p, const struct grid_method *mpm);
/* Makes the mesh; `cuts`: its partial stresses and slits; still: the caller sets the motion of its nodes. */
status frame_make(struct run *e, const struct mesh_source *cuts, bool still);
/* The smallest critical step of its cells, whatever converts; INFINITY: there are none [s]. */
real frame_critical_step(const struct reference_frame *r, const struct scene *s, enum coupling coupling);
/* Finds exposed points and loaded nodes anew, after points or levels have changed. */
void frame_follow_points(struct reference_frame *r, const struct particles *p, const struct bonds *bonds,
                         struct loads *loads);
/* Updates the exposed points, to which bonds reach, from their nodes. */
void frame_exposed_follow(struct reference_frame *r, struct particles *p);

/* Computes the forces of the nodes in step number `step`: of bonds, already in p->f, and of cells. */
void frame_force(struct reference_frame *r, struct particles *p, int64_t step);
/* Moves the nodes under these forces and the exposed points with them. middle: time in the middle of the step;
 * velocities move on by dt_velocity [s]. */
void frame_move(struct reference_frame *r, struct particles *p, struct loads *loads, const struct run_clock *clock,
                real middle, real dt_velocity);
/* Brings positions, velocities and stresses of all points up to date. */
void frame_sync(struct reference_frame *r, struct particles *p, const struct loads *loads);
/* Brings positions and velocities of all points up to date. */
void frame_sync_motion(struct reference_frame *r, struct particles *p, const struct loads *loads);
/* Brings positions and velocities of n listed points up to date, but for those in coarse cells. */
void frame_sync_listed(struct reference_frame *r, struct particles *p, const struct loads *loads, const int32_t *list,
                       int64_t n);
/* Rebuilds the mesh after `converted` particles have converted and the partial stresses of the `touched` points of
 * `partial` have changed. Adds the energy that this takes to *damped [J]. Returns false where only the stiffness of
 * cells has changed; else frame_follow_points is to be called. */
bool frame_follow(struct reference_frame *r, struct particles *p, int64_t converted,
                  const struct partial_stress *partial, real *damped);
/* Takes n particles back that have become material points again. Adds the energy that this takes to *damped [J]. */
void frame_insert(struct reference_frame *r, struct particles *p, const int32_t *list, int64_t n, real *damped);
/* Energy of all nodes, of all cells [J]. */
real frame_kinetic(const struct reference_frame *reference);
real frame_strain(struct reference_frame *r, const struct particles *p);

/* The load of a scene that asks for the smallest cells, by how long it takes to rise. */
enum rise_kind { RISE_NONE, RISE_BOUNDARY, RISE_INITIAL, RISE_BODY };
struct load_rise {
    enum rise_kind kind;
    int number;          /* of it in the scene */
    bool pulse;          /* comes and goes: rises in a quarter of its length */
    real seconds, waves; /* [s], in spacings of wave */
};
/* How many levels of coarse cells there are, and why `mpm.levels: auto` takes as many as it does. */
enum levels_why {
    LEVELS_BY_LOADS,
    LEVELS_AT_REST,
    LEVELS_NO_MESH,
    LEVELS_FEW,
    LEVELS_DAMPED,
    LEVELS_LONG_STEP,
    LEVELS_THIN
};
struct levels_choice {
    int levels, automatic; /* in this run; of auto */
    bool given;            /* by the scene */
    enum levels_why why;
    real across;       /* the body [spacings] */
    int64_t particles; /* of the body, made or not */
    real step_share;   /* time.step over the critical step [1] */
    struct load_rise rise;
};

/* Finds which levels of coarse cells the thickness of the body allows, where the scene may have any. */
void frame_levels_room(struct reference_frame *r, const struct scene *s, int64_t particles);
/* Chooses the number of levels once the critical step is known [s]. */
struct levels_choice frame_levels_choice(const struct reference_frame *r, const struct particles *p,
                                         const struct scene *s, real dt_critical);
/* Writes the choice in words to text [room]. */
void frame_levels_text(const struct levels_choice *c, const struct scene *s, char *text, size_t room);
/* Are the levels that the scene gives too coarse for its loads? Then says so in words. */
bool frame_levels_coarse(const struct levels_choice *c, const struct reference_frame *r, const struct scene *s,
                         char *text, size_t room);
/* Makes coarse cells once the time step is known, with the levels of the start unless `restored`. */
status frame_levels_make(struct run *e, bool restored);
/* Are levels looked at before this step? */
bool frame_levels_due(const struct mesh_levels *l, int64_t step);
/* The levels that cells are to have next [mesh.grid.n], for the caller to free; NULL: those that they have. */
uint8_t *frame_levels_plan(struct reference_frame *r, const struct particles *p, const struct loads *loads,
                           int64_t step, real mass);
/* Changes the levels; all cells of level 0 have particles. */
void frame_levels_apply(struct run *e, const uint8_t *level);
/* Before conversion: points near coarse cells wait until those are finer. */
void frame_levels_guard(struct mesh_levels *l, struct particles *p);
/* Finds walls of coarse cells, exposed points and loads, after levels have changed. */
void frame_levels_found(struct reference_frame *r, const struct particles *p, const struct bonds *bonds,
                        struct loads *loads);

/* Why all particles are made; NULL: some need not be. */
const char *frame_hollow_obstacle(const struct scene *s);
/* Finds the cells whose particles need not be made, before any are. */
status frame_hollow_plan(struct hollow *h, const struct scene *s, const struct bond_source *source);
/* With the levels of the start (NULL: none): false where particles are missing, and the run has to be made again. */
bool frame_hollow_start(struct reference_frame *r, const uint8_t *level);
/* Have cells of level 0 no particles, with these levels? */
bool frame_hollow_lacks(const struct mesh *mesh, const uint8_t *level);
/* The cells to be hollow with these levels, once the run is made again. */
void frame_hollow_change(struct reference_frame *r, const uint8_t *level);
/* Points of hollow coarse cells for a frame, into r->shown, with the gradient of their displacement if wanted; false:
 * there are none. body: the particles that are made; m: [materials]. */
bool frame_hollow_points(struct reference_frame *r, const struct particles *body, const struct material *m,
                         bool gradients);
void frame_hollow_points_free(struct hollow_points *h);

#endif
