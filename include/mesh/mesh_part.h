/* Bodies in the reference frame in a run. */
#ifndef CLEAVE_MESH_PART
#define CLEAVE_MESH_PART

#include "data/hollow.h"
#include "mesh/levels.h"
#include "mesh/mesh_make.h"
#include "run/run.h"

/* Frame of a body, and the reason unless the scene chooses the current frame. */
struct frame_choice {
    bool reference;
    const char *reason;
};

/* A disc in which cells stay the smallest, the ring of a sif probe [m]. */
struct frame_ring {
    real place[2], radius;
};

/* Points in coarse cells without particles, for the last frame. */
struct hollow_points {
    struct particles part;
    real *spacing;                     /* spacing of the points [m] */
    real *gradient[DIM_MAX * DIM_MAX]; /* gradient of the displacement, if a frame contains strains [1] */
};

/* Bodies in the reference frame: a mesh of cells fixed to the material. */
struct reference_frame {
    int bodies;
    struct frame_choice *choice; /* [bodies] */
    real spacing;                /* of particles [m] */
    bool finite;                 /* strains are finite, else small */
    bool converts;               /* points with a large stress become peridynamic (method adaptive) */
    bool active_set;             /* nodes still at rest are skipped */
    bool room_limits;            /* `room` limits the levels, which are automatic */
    struct mesh mesh;
    struct mesh_source source;
    struct elastic *elastic;   /* [materials] constants of the cells */
    struct mesh_levels levels; /* coarse cells */
    uint8_t *room;             /* [mesh.grid.n] largest level by the thickness of the body; NULL: not computed */
    int room_most;             /* largest value of `room` */
    struct hollow hollow;      /* cells whose particles are not made */
    bool lacks;                /* particles needed at the start are missing: the run must be set up again */
    struct elastic *coarse;    /* [materials] constants of coarse cells, with a smaller trigger */
    int rings;
    /* [scene->probes] discs in which cells stay the smallest at present; the first `rings` */
    struct frame_ring *ring;
    struct hollow_points shown;
    real speed; /* largest component of a nodal velocity [m/s] */
};

/* Chooses the frame of each body with a reason, marks the particles in the reference frame, and makes the grids, which
 * the choice requires. REFUSED if a body cannot be in the frame that the scene requires. */
status frames_choose(struct reference_frame *r, struct grid_method *mpm, struct particles *p, const struct scene *s);

/* Returns true if a body is in the reference frame. */
bool frame_any(const struct reference_frame *r);

/* Returns true if the reference frame is possible: the particles are one piece on a lattice that fits the cells of the
 * grid. */
bool frame_allowed(const struct reference_frame *r, const struct particles *p, const struct grid_method *mpm);

/* Makes the mesh with the partial stresses and slits of `cuts`. still: the caller sets the motion of the nodes. */
status frame_make(struct run *e, const struct mesh_source *cuts, bool still);

/* Returns the smallest critical time step of the cells, whichever particles convert [s]; INFINITY: no cells. */
real frame_critical_step(const struct reference_frame *r, const struct scene *s, enum coupling coupling);

/* Updates exposed points and loaded nodes after points or levels have changed. */
void frame_follow_points(struct reference_frame *r, const struct particles *p, const struct bonds *bonds,
                         struct loads *loads);

/* Updates positions of the exposed points (mesh_find_exposed), and the strain of points of state-based PD-MPM bonds. */
void frame_exposed_follow(struct reference_frame *r, struct particles *p);

/* Computes the forces of the nodes in step number `step`: of bonds, stored in p->f before, and of cells. */
void frame_force(struct reference_frame *r, struct particles *p, int64_t step);

/* Moves the nodes under the forces by frame_force, and the exposed points with the nodes. middle: time in the middle of
 * the step; dt_velocity: time by which velocities advance [s]. */
void frame_move(struct reference_frame *r, struct particles *p, struct loads *loads, const struct run_clock *clock,
                real middle, real dt_velocity);

/* Updates positions, velocities and stresses of all points of the mesh, and images. */
void frame_sync(struct reference_frame *r, struct particles *p, const struct loads *loads);

/* Updates positions and velocities of all points of the mesh, and images. */
void frame_sync_motion(struct reference_frame *r, struct particles *p, const struct loads *loads);

/* Updates positions and velocities of n listed points of the mesh, except in coarse cells, and images. */
void frame_sync_listed(struct reference_frame *r, struct particles *p, const struct loads *loads, const int32_t *list,
                       int64_t n);

/* Updates the mesh after `converted` particles have converted and the partial stresses of the `touched` points of
 * `partial` have changed. Adds the energy lost to *damped [J]. Returns false if only the stiffness of cells has
 * changed; otherwise frame_follow_points must be called. */
bool frame_follow(struct reference_frame *r, struct particles *p, int64_t converted,
                  const struct partial_stress *partial, real *damped);

/* Inserts n listed particles that have become material points again. Adds the energy lost to *damped [J]. */
void frame_insert(struct reference_frame *r, struct particles *p, const int32_t *list, int64_t n, real *damped);

/* Returns the kinetic energy of all nodes [J]. */
real frame_kinetic(const struct reference_frame *reference);

/* Returns the strain energy of all cells [J]. */
real frame_strain(struct reference_frame *r, const struct particles *p);

/* Kind of the load that requires the smallest cells. */
enum rise_kind { RISE_NONE, RISE_BOUNDARY, RISE_INITIAL, RISE_BODY };

/* A load and its rise time. */
struct load_rise {
    enum rise_kind kind;
    int number;          /* its number in the scene */
    bool pulse;          /* a pulse; its rise time is a quarter of its length */
    real seconds, waves; /* rise time [s]; distance that waves travel in it [spacings] */
};

/* Reason for the number of levels by `mpm.levels: auto`. */
enum levels_why {
    LEVELS_BY_LOADS,
    LEVELS_AT_REST,
    LEVELS_NO_MESH,
    LEVELS_FEW,
    LEVELS_DAMPED,
    LEVELS_LONG_STEP,
    LEVELS_THIN
};

/* Number of levels of coarse cells, with reasons. */
struct levels_choice {
    int levels, automatic; /* levels of this run; levels by auto */
    bool given;            /* the scene gives the levels */
    enum levels_why why;
    real across;       /* thickness of the body [spacings] */
    int64_t particles; /* particles of the body, made or not */
    real step_share;   /* time.step over the critical step [1] */
    struct load_rise rise;
};

/* Computes r->room, if the run may have coarse cells. particles: number of the body. */
void frame_levels_room(struct reference_frame *r, const struct scene *s, int64_t particles);

/* Chooses the number of levels. dt_critical: critical time step [s]. */
struct levels_choice frame_levels_choice(const struct reference_frame *r, const struct particles *p,
                                         const struct scene *s, real dt_critical);

/* Writes the choice in words to text [room]. */
void frame_levels_text(const struct levels_choice *c, const struct scene *s, char *text, size_t room);

/* Returns true if the levels given by the scene are too coarse for its loads, and writes the reason to text [room]. */
bool frame_levels_coarse(const struct levels_choice *c, const struct reference_frame *r, const struct scene *s,
                         char *text, size_t room);

/* Makes the coarse cells, once the time step is known, with initial levels unless `restored`. */
status frame_levels_make(struct run *e, bool restored);

/* Returns true if levels may change before step number `step`. */
bool frame_levels_due(const struct mesh_levels *l, int64_t step);

/* Computes the levels of the cells for the next steps [mesh.grid.n]. step: number of the next step; mass: of the body
 * [kg]. Returns the levels, which the caller frees, or NULL if they do not change. */
uint8_t *frame_levels_plan(struct reference_frame *r, const struct particles *p, const struct loads *loads,
                           int64_t step, real mass);

/* Changes the levels; all cells of level 0 must have particles. */
void frame_levels_apply(struct run *e, const uint8_t *level);

/* Postpones the conversion of points near coarse cells until these are finer, before conversion. */
void frame_levels_guard(struct mesh_levels *l, struct particles *p);

/* Updates walls of coarse cells, exposed points and loaded nodes after levels have changed. */
void frame_levels_found(struct reference_frame *r, const struct particles *p, const struct bonds *bonds,
                        struct loads *loads);

/* Returns the reason why all particles are made; NULL: some may be left out. */
const char *frame_hollow_obstacle(const struct scene *s);

/* Finds the cells whose particles are not needed, before particles are made. */
status frame_hollow_plan(struct hollow *h, const struct scene *s, const struct bond_source *source);

/* Compares the initial levels (NULL: no coarse cells) with the particles that are made. Returns false if particles are
 * missing; the run must be set up again then. */
bool frame_hollow_start(struct reference_frame *r, const uint8_t *level);

/* Returns true if a cell of level 0, by these levels, has no particles. */
bool frame_hollow_lacks(const struct mesh *mesh, const uint8_t *level);

/* Chooses the cells without particles for these levels; takes effect when the run is set up again. */
void frame_hollow_change(struct reference_frame *r, const uint8_t *level);

/* Makes points for coarse cells without particles, for a frame, in r->shown. body: the particles that are made; m:
 * [materials]; gradients: also the gradient of the displacement. Returns false if there are no such cells. */
bool frame_hollow_points(struct reference_frame *r, const struct particles *body, const struct material *m,
                         bool gradients);

/* Releases the points of the last frame. */
void frame_hollow_points_free(struct hollow_points *h);

#endif
