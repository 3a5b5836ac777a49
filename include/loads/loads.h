/* Room `loads`: boundary conditions on particles, grids and meshes, and the account of what they put in. It knows
 * `data`, `bonds` and `kernels`, but neither scenes nor the step; mesh, solver and engine call it.
 *
 * Prescribed velocities, forces, walls and mirrors as functions of time; and the account of what they
 * put in: impulse and work. */
#ifndef CLEAVE_LOADS
#define CLEAVE_LOADS

#include "base/archive.h"
#include "bonds/bonds.h"
#include "data/grid.h"
#include "kernels/kernels.h"
#include "data/particles.h"
#include "data/expression.h"
#include "data/region.h"
#include "absorbing.h"

enum boundary_kind {
    BOUNDARY_VELOCITY,   /* drives components: velocity, displacement, rotation (`fixed` is a velocity of 0) */
    BOUNDARY_TRACTION,   /* surface force on the face that a body shows along an axis [Pa] */
    BOUNDARY_BODY_FORCE, /* [N/m^3] */
    BOUNDARY_MIRROR,     /* plane of symmetry (roller) or of antisymmetry (fixed end) */
    BOUNDARY_ABSORBING,  /* dashpots on the face that a body shows along an axis (absorbing.h) */
    BOUNDARY_PRESSURE    /* on every free face, against its outward normal (loads_pressure.c) [Pa] */
};

/* Factor on a body force over the reference position: sin(2 pi (X - origin) . direction/wavelength). */
enum profile_kind { PROFILE_UNIFORM, PROFILE_SINE };
struct profile {
    enum profile_kind kind;
    real wavelength;         /* [m] */
    real origin[DIM_MAX];    /* where it is 0 and rises along `direction` [m] */
    real direction[DIM_MAX]; /* of any length [1] */
};

/* One boundary condition, as the scene says it. */
struct boundary {
    char name[NAME_MAX_LENGTH];
    char place[PLACE_LENGTH]; /* in the scene */
    enum boundary_kind kind;
    struct region region;               /* of reference positions; empty: everywhere */
    int body;                           /* -1: any */
    uint8_t components;                 /* bit d: component d is held (VELOCITY) */
    real value[DIM_MAX];                /* [m/s], [m], [Pa] or [N/m^3]; PRESSURE: the same in all; 1 beside a
                                           formula */
    struct expression formula[DIM_MAX]; /* of a component in X and t, PRESSURE: the first for all; none: value */
    real end;                           /* formulas have their values then at later times; 0: no end is known [s] */
    bool frozen;                        /* static: formulas have their value at `frozen_at` [s] */
    real frozen_at;
    bool displaces; /* VELOCITY: value, factor and formula are displacements; the value in [m] */
    bool rotates;   /* VELOCITY: all components, on circles about an axis through `centre` */
    real centre[DIM_MAX], axis_of[DIM_MAX], rate; /* [m], of any length, z in the plane; times the factor [1/s] */
    bool follow;                                  /* PRESSURE: normals and areas are those of the deformed body */
    struct time_function time;                    /* factor on value */
    char *time_file;                              /* it came from this CSV file; NULL: it stands in the scene */
    char time_column[NAME_MAX_LENGTH];            /* of it; "": the only one beside the time */
    uint64_t time_contents;                       /* hash of that file; 0: not read */
    bool time_unit;         /* the column has the unit of the value, which then says the direction alone */
    struct profile profile; /* BODY_FORCE: factor on value */
    bool by_mass;           /* BODY_FORCE: gravity; value is an acceleration [m/s^2] */
    int face;               /* TRACTION, ABSORBING, VELOCITY: axis of the face's normal */
    int side;               /* +1 upper face, -1 lower face; VELOCITY: 0, no face */
    real depth;             /* VELOCITY: of the layer behind its face [m] */
    real section;           /* beside a face: of all bodies, in line [m^2], in the plane [m], 1 in
                               space; 0: a particle's area is its volume over the spacing */
    int axis;               /* MIRROR: normal of the plane ... */
    real at;                /*         ... and where it is [m] */
    bool hold_tangential;   /* MIRROR: displacement odd in all components, not only normal */
};

/* A boundary condition at work on particles. */
struct load {
    const struct boundary *boundary; /* borrowed from the scene */
    int64_t n;
    int32_t *particle;    /* ascending */
    real *share[DIM_MAX]; /* [n] by component, TRACTION: area [m^2], in the face's plane 3/2 of it on a
                             column's first particle, -1/2 on the next; BODY_FORCE: volume times
                             profile [m^3], or mass [kg]. Equal ones are one array, of several components
                             or loads */
    /* [n] ABSORBING: area on first particles alone; 3/2 of it on these and -1/2 on the next, for nodes of a grid, to
     * which first particles give some of it behind the face [m^2] */
    real *outer, *edge;
    /* of a load whose shares change, which has them for itself: shares without function of time and formula */
    bool moving;
    real *base[DIM_MAX];
    struct surface *surface; /* of pressure that follows; NULL: none */
    /* TRACTION, BODY_FORCE: first load on the same particles, which keeps the arrays of both; -1: itself */
    int leader;
    /* [n] of a load without leader, components with a value: positions before this step [m] */
    real *before[DIM_MAX];
    real reaction[DIM_MAX];     /* VELOCITY: force of the support on the body in the last step, without what
                                   moves the driven particles themselves; load steps: forces, too [N] */
    real displacement[DIM_MAX]; /* of the driven particles, their mean; of velocities accumulated [m] */
    real held_work;             /* static, drives by place: forces of the support times displacements [J] */
    int outside;                /* MIRROR: side of the plane without body, -1 or +1 */
};

/* Does a formula of a boundary depend on time? */
static inline bool boundary_in_time(const struct boundary *b)
{
    bool in_time = false;
    for (int d = 0; d < DIM_MAX; d++) in_time |= b->formula[d].in_time;
    return in_time;
}

/* Returns the time of which a formula of a boundary is asked at time t [s]. */
static inline real boundary_time(const struct boundary *b, real t)
{
    return b->frozen ? b->frozen_at : b->end > 0 ? real_min(t, b->end) : t;
}

/* Does it put forces on particles? */
static inline bool boundary_is_force(const struct boundary *b)
{
    return b->kind == BOUNDARY_TRACTION || b->kind == BOUNDARY_BODY_FORCE || b->kind == BOUNDARY_PRESSURE;
}

/* A component of a node that is held as long as the grid keeps its box. */
struct held {
    int32_t node;
    uint8_t component, load;
};

struct constrained_set {
    int64_t n, lasting; /* the first `lasting` do not depend on the masses of nodes */
    struct held *held;
    int64_t first[DIM_MAX], count[DIM_MAX]; /* of the box of nodes they were found in */
};

struct loads {
    int n;
    struct load *load;
    uint8_t *loaded; /* [n] LOADED, MOVES_LATER, TOUCHES; NULL: no particle is */
    int64_t listed;
    int32_t *list; /* [listed] those that are not 0, ascending */
    int64_t images;
    struct image *image;
    real impulse[DIM_MAX];    /* given by loads and supports since the start [N s] */
    real work;                /* done by applied forces, up to where particles are [J] */
    real constraint_work;     /* done by supports, up to the velocities, half a step behind [J] */
    real spacing, reach;      /* [m]; of bonds */
    real centre[2], turn;     /* static, free in the plane: centre of mass [m], angular acceleration by the
                                 loads' moment [1/s^2], 0: none */
    real place_step[DIM_MAX]; /* positions across mirrors are rounded to multiples of it; 0: not [m] */
    struct absorbing absorbing;
    bool ended;                              /* forces are asked for that no step follows */
    real *share;                             /* scratch: driven mass of the grid's nodes [kg] */
    struct constrained_set constrained_mesh; /* nodes of the mesh in driven regions, on mirrors, and driven ones */
};

/* LOADED: something else than bonds and the grid may move a particle. MOVES_LATER: bonds across a clamped plane nearby
 * act on it after the sweep of its own. TOUCHES: so does contact. */
enum { LOADED = 1, MOVES_LATER = 2, TOUCHES = 4 };
static inline bool is_loaded(const struct loads *l, int64_t i)
{
    return l->loaded && l->loaded[i] & (LOADED | TOUCHES);
}
/* Is it a mirror that holds motion along its plane, too? Along a line there is none: it is one of symmetry. */
static inline bool is_clamp(const struct boundary *b, int dim)
{
    return b->kind == BOUNDARY_MIRROR && b->hold_tangential && dim > 1;
}

/* Finds the particles of one boundary (of a mirror those in its plane, if it is clamped), ascending, and their
 * shares; marks FLAG_DRIVEN. Refuses a force on a region without particles, a traction on one without a free face. */
status load_select(struct load *l, const struct boundary *b, struct particles *p, real spacing);
/* Which particles are in the region and body of a boundary [n]; false: none. */
bool load_region(const struct boundary *b, const struct particles *p, real spacing, uint8_t *selected);
/* The load acts on particles with taken[i] > 0: lists them, marks driven ones, makes room for shares. */
void load_take(struct load *l, const uint8_t *taken, struct particles *p);

/* The face of a traction (loads_columns.c): of each column of particles along the normal the first that nothing
 * hides bears its area, and that along the face together with the next where `two` are wanted. */
struct face {
    real *normal, *along; /* [particles] area for the component along the normal, and for the others [m^2] */
};
void face_make(struct face *f, const struct boundary *b, const struct particles *p, const uint8_t *selected,
               real spacing, bool two);
void face_free(struct face *f);
/* Marks the selected particles of the face of b and of the layer of depth b->depth behind it, as far as nothing parts
 * them [particles]. */
void face_layer(const struct boundary *b, const struct particles *p, const uint8_t *selected, real spacing,
                uint8_t *taken);
/* Calls `found` for every free end of a column along the normal of b's face, the walls of holes too, with the area of
 * the column [m^2]. */
typedef void face_found_fn(void *context, int32_t particle, real area);
void face_every(const struct boundary *b, const struct particles *p, const uint8_t *selected, real spacing,
                face_found_fn *found, void *context);
/* The part of loads_make that finds the particles of a pressure, number `which` of n boundaries (loads_pressure.c). */
status load_select_pressure(struct load *l, const struct boundary *boundary, int n, int which, struct particles *p,
                            real spacing);

/* Calls `found` for every free face on which a pressure acts, number `which` of n boundaries: axis and side of its
 * normal, its area [m^2]. */
typedef void pressure_face_fn(void *context, int32_t particle, int axis, int side, real area);
void pressure_faces(const struct boundary *all, int n, int which, const struct particles *p, real spacing,
                    const uint8_t *selected, pressure_face_fn *found, void *context);

/* Loads whose shares change (loads_moving.c): formulas of time, pressure that follows. make: formulas without time
 * become part of the shares; REFUSED where a formula is not finite. push, work: the shares of loads_push and
 * loads_push_work. */
status load_formula_make(struct load *l, const struct particles *p);
/* FAILED where the formula of a load or support has no finite value on one of its particles at time t [s], with the
 * name, the place and the time. */
status loads_finite(const struct loads *l, const struct particles *p, real t);
void loads_moving_push(struct loads *l, const struct particles *p, real t, real dt_velocity);
void loads_moving_work(struct loads *l, const struct particles *p, real t, real dt);
void load_moving_free(struct load *l);
/* Force of a load on its k-th particle at t, at reference places; static: once it has grown [dim, N]. */
void load_force_at(const struct load *l, const struct particles *p, int64_t k, real t, real *force);
/* Sets `reaction` of a load that is a force to all of it at time t, and `displacement` to that of its particles: their
 * mean by what they bear, so that force times displacement is the work; of a load without resultant their mean. */
void load_applied_sum(struct load *l, const struct particles *p, real t);
/* Its value there, without areas and profile [dim, as boundary.value]. Not of what rotates. */
void load_value_at(const struct load *l, const struct particles *p, int64_t k, real t, real *value);

/* Finds the particles of every boundary and marks FLAG_DRIVEN; appends mirror images within `reach` of
 * mirror planes to the particles (so bonds must be made after it). `spacing` [m] is that of the columns that bear
 * tractions. Refuses what load_select does. */
status loads_make(struct loads *l, const struct boundary *boundary, int n, struct particles *p, real spacing,
                  real reach, int optional);
void loads_free(struct loads *l);
/* From now on these n particles, ascending, are those that contact may push. */
void loads_touch(struct loads *l, const struct particles *p, const int32_t *list, int64_t n);

/* ---- applied forces (loads_applied.c) ---------------------------------------------------------------------------- */

/* The part of loads_make that joins loads of the same particles; its end. */
void loads_join(struct loads *l, int dim);
void loads_applied_free(struct loads *l);
/* The parts of loads_apply and loads_hold that add forces and impulse, and book their work. */
void loads_push(struct loads *l, struct particles *p, real t, real dt_velocity);
void loads_push_work(struct loads *l, struct particles *p, real t, real dt);

/* ---- absorbing faces (loads_absorbing.c) ------------------------------------------------------------------------- */

/* REFUSED where two absorbing faces share a part: it would have two dashpots. */
status loads_absorbing_check(const struct loads *l, const struct particles *p);
/* After loads_make: the dashpots of all absorbing faces, by the impedances of what moves particles [materials], which
 * stay with the caller. */
void loads_absorbing_make(struct loads *l, const struct particles *p, const struct impedance *const *impedance);
void loads_absorbing_free(struct loads *l);
/* The part of loads_apply that acts on particles that bonds move; those of loads_walls and loads_mesh_find that list
 * dashpots of nodes, once walls are known; that of loads_react which books what these took. */
void loads_absorb(struct loads *l, struct particles *p, real dt_velocity);
void loads_dashpots(struct loads *l, struct grid *g, const struct particles *p, const struct kernels *k,
                    real half_width);
void loads_mesh_dashpots(struct loads *l, struct mesh *mesh, const struct particles *p);
void loads_absorbed(struct loads *l, const struct absorbed *by);

/* Where a boundary of kind VELOCITY has its particles at a (pseudo-)time t >= 0: displacements from reference places.
 * That of `displacement` is its value there, of a velocity the integral from 0, of a rotation the rotation by the
 * angle until then; formulas of a static problem are those at `frozen_at`. Made once for a load and a time, cheap to
 * ask for many places; pure. Not of a velocity by a formula of t, of which no integral is known in closed form:
 * load_displacement_known refuses it. */
struct displacing {
    const struct boundary *boundary;
    int dim;
    real t, factor;                 /* of value and formula at t: [1], of a velocity [s] */
    real turned[DIM_MAX * DIM_MAX]; /* rotates: the rotation at t, row major */
};
struct displacing displacing_make(const struct boundary *b, int dim, real t);
/* Component d of the displacement at the reference place X [dim, m]; d is one of boundary->components [m]. */
real displacing_at(const struct displacing *s, const real *X, int d);
/* All components of that of a load's k-th particle at t, 0 where it drives none [dim, m]. */
void load_displacement_at(const struct load *l, const struct particles *p, int64_t k, real t, real *u);
/* REFUSED for a boundary of kind VELOCITY whose displacements are not known ahead. OK for all others. */
status load_displacement_known(const struct boundary *b);

/* What a boundary prescribes in a step from t - dt/2 to t + dt/2 (loads_driving.c). */
struct driving {
    const struct boundary *boundary;
    int dim;
    real t, dt, factor;         /* of its function of time, at t */
    struct displacing from, to; /* displaces, rotates: at the step's ends */
};
struct driving driving_make(const struct boundary *b, int dim, real t, real dt);
/* That of boundary `which` in a step; where none follows, what is displaced goes on as in the step before: how its
 * motion changes after the end is nothing of the run, whose work would have half of it. */
struct driving loads_driving(const struct loads *l, int which, int dim, real t, real dt);
/* Velocity of component d at the reference place X; `placed`: of what is at X when the step begins [m/s]. That of a
 * displacement is its difference over the step. */
real driving_at(const struct driving *s, const real *X, int d, bool placed);
/* Does it depend on the place? */
static inline bool drives_by_place(const struct boundary *b)
{
    return b->rotates || b->formula[0].in_space || b->formula[1].in_space || b->formula[2].in_space;
}
/* Largest speed that a displacement prescribes between the times 0 and t, INFINITY where it jumps: of formulas that at
 * MOMENTS of them, and at some places [m/s]. */
real load_displacing_speed(const struct load *l, const struct particles *p, real t);

/* Largest difference between the velocity that a load prescribes between the times 0 and t, at MOMENTS of them and some
 * places, and that which its particles have in p, the state at t = 0; on circles the difference of speeds; 0 of
 * displacements [m/s]. */
real load_velocity_jump(const struct load *l, const struct particles *p, real t);
/* Computes the largest change of the velocity that a load (velocity or displacement) prescribes within a span of time,
 * between the times 0 and t; before 0 its particles have the velocity in p. Changes are sampled at MOMENTS times, at
 * least one spacing of these apart, and at some places. within: the span [s]. Returns a speed [m/s]. */
real load_velocity_change(const struct load *l, const struct particles *p, real t, real within);
/* Computes by how much the velocities that two loads prescribe, each less that of its particles in p, differ at most
 * between the times 0 and t, in the components that both drive. Returns 0 if there are none, INFINITY if one of them
 * rotates or depends on the place [m/s]. */
real loads_velocity_apart(const struct load *a, const struct load *b, const struct particles *p, real t);

#define LOADS_TOLERANCE ON_SURFACE /* of a spacing: points on a region's border belong to it    */

/* ---- mirrors (loads_mirror.c) ------------------------------------------------------------------------------------ */

/* The part of loads_make that checks mirrors and appends their images. Refuses a mirror that cuts its body. */
status loads_mirrors_make(struct loads *l, struct particles *p, real reach, int optional);

/* MOVES_LATER of those whose bonds may cross a clamped plane. */
void loads_mirrors_mark(struct loads *l, const struct particles *p);

/* Moves images to the mirror image of their sources (x, v); kind and FLAG_DRIVEN follow. Places of the sources
 * across the mirror go to the nearest multiple of place_step, about the last bit of the farthest place. */
void loads_mirror(const struct loads *l, struct particles *p);

/* Before bonds: f = 0 on every loaded particle (loads_applied.c). After bonds: books what mirror images gave, adds
 * applied forces; for driven peridynamic particles replaces f by what gives them their velocity. t is the middle of
 * the step, where the kick ends that began dt_velocity before. */
void loads_clear(struct loads *l, struct particles *p);
void loads_apply(struct loads *l, struct particles *p, real t, real dt, real dt_velocity);

/* Walls of the grid: nodes in a driven region or on a mirror plane, and nodes at least half of whose mass belongs to
 * driven points; and nodes beyond a mirror plane, which follow their images if the plane stands on a node or half-way
 * between two, else are held as those on it. held: those of the grid, empty at first. Call after the first map. */
void loads_walls(struct loads *l, struct constrained_set *held, struct grid *g, const struct particles *p,
                 const struct kernels *k, real half_width, real t, real dt);

/* The same for the mesh: found once, and again whenever it has lost points; their velocities in every step. */
void loads_mesh_find(struct loads *l, struct mesh *mesh, const struct particles *p);
void loads_mesh_walls(const struct loads *l, struct mesh *mesh, real t, real dt);
/* The same for nodes of coarse cells, by place alone: those in driven regions and on mirrors. */
void loads_level_find(const struct loads *l, struct constrained_set *held, struct grid *g, const struct particles *p);
void loads_level_walls(const struct loads *l, const struct constrained_set *held, struct grid *g, real t, real dt);

/* After the gather: driven material points take their velocity exactly, and displaced particles their place; books the
 * work of applied forces. Returns whether points on a grid are elsewhere than it has moved them. */
bool loads_hold(struct loads *l, struct particles *p, real t, real dt);
/* Reactions of the walls of one grid, or of the mesh. */
void loads_react(struct loads *l, const struct grid *g, real dt_velocity);

/* Does a mirror's plane stand on a node of the grid or half-way between two? */
bool mirror_on_nodes(const struct boundary *b, const struct grid *g, real spacing);

/* ---- static equilibrium (loads_static.c) ------------------------------------------------------------------------- */

/* Boundaries of a static problem in pseudo-time, n of them into `to`: forces have their value at `duration`, and
 * what is driven goes as far as it goes until then. Both grow evenly from 0 to `ramp` [s] and stay. */
void loads_static_boundaries(struct boundary *to, const struct boundary *from, int n, real duration, real ramp);

/* Of such boundaries once they have grown: displacement of every driven component [m], and which are driven (bits of
 * `held` by particle); where two overlap the later one holds, as in a run. */
void loads_static_driven(struct loads *l, const struct particles *p, real ramp, real *const *displacement,
                         uint8_t *held);

/* A body that nothing holds in the plane has no equilibrium under loads that turn it, and those on the scattered
 * particles of a shaken lattice always do a little: from now on the forces of its inertia in that turn belong to the
 * applied ones (inertia relief). Returns the moment over the largest that forces of their size could make there [1]. */
real loads_static_balance(struct loads *l, const struct particles *p);
/* Adds the applied forces to part.f. */
void loads_static_force(const struct loads *l, struct particles *p);

/* Forces on driven components become reactions and leave f. */
void loads_static_hold(struct loads *l, struct particles *p);

/* Half the applied force times the displacement, and half of reactions times theirs: the work of loads that grow in
 * proportion on a linear body, into `work` and `constraint_work`. */
void loads_static_work(struct loads *l, const struct particles *p);

status loads_archive(struct loads *l, struct archive *a);

enum { BOUNDARIES_MAX = 255 }; /* their number fits the byte of struct held and struct image; scene_keys.c */

#endif
