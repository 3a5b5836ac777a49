/* Room `loads`: boundary conditions on particles, grids and meshes, and their impulse and work. It uses `data`, `bonds`
 * and `kernels`, but neither scenes nor the step; mesh, solver and engine call it.
 *
 * Prescribed velocities, forces, walls and mirrors as functions of time, and the accounts of their impulse and work. */
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
    BOUNDARY_VELOCITY,   /* prescribes components: velocity, displacement, rotation (`fixed` is a velocity of 0) */
    BOUNDARY_TRACTION,   /* surface force on the exposed face of a body along an axis [Pa] */
    BOUNDARY_BODY_FORCE, /* force per volume [N/m^3] */
    BOUNDARY_MIRROR,     /* plane of symmetry (roller) or of antisymmetry (fixed end) */
    BOUNDARY_ABSORBING,  /* dashpots on the exposed face of a body along an axis (absorbing.h) */
    BOUNDARY_PRESSURE    /* on every free face, against its outward normal (loads_pressure.c) [Pa] */
};

/* Factor on a body force over the reference position: sin(2 pi (X - origin) . direction/wavelength). */
enum profile_kind { PROFILE_UNIFORM, PROFILE_SINE };
struct profile {
    enum profile_kind kind;
    real wavelength;         /* [m] */
    real origin[DIM_MAX];    /* zero of the sine, which increases along `direction` [m] */
    real direction[DIM_MAX]; /* of any length [1] */
};

/* One boundary condition as given in the scene. */
struct boundary {
    char name[NAME_MAX_LENGTH];
    char place[PLACE_LENGTH]; /* position in the scene file */
    enum boundary_kind kind;
    struct region region; /* selects particles by reference position; empty: everywhere */
    int body;             /* index of the body, -1: any */
    uint8_t components;   /* VELOCITY: bit d: component d is prescribed */
    real value[DIM_MAX];  /* [m/s], [m], [Pa] or [N/m^3]; PRESSURE: equal in all components; 1 if there is a formula */
    /* formula of each component in X and t; PRESSURE: the first is used for all; empty: value only */
    struct expression formula[DIM_MAX];
    real end;    /* time after which formulas keep their values, 0: unknown [s] */
    bool frozen; /* static problem: formulas have their value at `frozen_at` [s] */
    real frozen_at;
    bool displaces; /* VELOCITY: value, factor and formula are displacements; value in [m] */
    bool rotates;   /* VELOCITY: all components, on circles about an axis through `centre` */
    real centre[DIM_MAX], axis_of[DIM_MAX],
        rate;                          /* [m]; axis of any length, z in 2D; angular velocity, times the factor [1/s] */
    bool follow;                       /* PRESSURE: normals and areas are those of the deformed body */
    struct time_function time;         /* factor on value */
    char *time_file;                   /* CSV file of the factor; NULL: given in the scene */
    char time_column[NAME_MAX_LENGTH]; /* column of the file; "": the only one beside the time */
    uint64_t time_contents;            /* hash of the file; 0: not read */
    bool time_unit;                    /* the column has the unit of the value, and `value` is only the direction */
    struct profile profile;            /* BODY_FORCE: factor on value */
    bool by_mass;                      /* BODY_FORCE: gravity; value is an acceleration [m/s^2] */
    int face;                          /* TRACTION, ABSORBING, VELOCITY: axis of the face's normal */
    int side;                          /* +1 upper face, -1 lower face; VELOCITY: 0, no face */
    real depth;                        /* VELOCITY: depth of the layer behind its face [m] */
    real section; /* with a face: section of all bodies, in 1D [m^2], in 2D [m], 1 in 3D; 0: a particle's area is its
                     volume over the spacing */
    int axis;     /* MIRROR: axis of the plane's normal */
    real at;      /* MIRROR: position of the plane [m] */
    bool hold_tangential; /* MIRROR: displacement odd in all components, not only the normal one */
};

/* A boundary condition applied to particles. Arrays are owned, except shares that loads have in common. */
struct load {
    const struct boundary *boundary; /* borrowed from the scene */
    int64_t n;
    int32_t *particle;    /* [n] ascending */
    real *share[DIM_MAX]; /* [n] by component. TRACTION: area [m^2], for tangential components 3/2 of it on the first
                             particle of a column and -1/2 on the next; BODY_FORCE: volume times profile [m^3], or mass
                             [kg]. Equal shares of several components or loads are one array */
    /* [n] ABSORBING: area on the first particle of each column; for grid nodes 3/2 of it there and -1/2 on the next
     * particle, because first particles transfer part of it behind the face [m^2] */
    real *outer, *edge;
    /* the shares change in time and are not shared; `base`: shares without function of time and formula */
    bool moving;
    real *base[DIM_MAX];
    struct surface *surface; /* surface of a pressure that follows the deformation; NULL: none */
    /* TRACTION, BODY_FORCE: first load on an equal list of particles, which has the arrays of both; -1: not combined */
    int leader;
    /* [n] components with a value, only if the load leads its list: positions at the start of this step [m] */
    real *before[DIM_MAX];
    real reaction[DIM_MAX]; /* VELOCITY: force of the support on the body in the last step, without the inertia of the
                               driven particles; load steps: forces too [N] */
    real displacement[DIM_MAX]; /* mean displacement of the driven particles; for velocities accumulated [m] */
    real held_work;             /* static, prescribed by position: sum of support forces times displacements [J] */
    int outside;                /* MIRROR: side of the plane without body, -1 or +1 */
};

/* Returns true if a formula of a boundary depends on time. */
static inline bool boundary_in_time(const struct boundary *b)
{
    bool in_time = false;
    for (int d = 0; d < DIM_MAX; d++) in_time |= b->formula[d].in_time;
    return in_time;
}

/* Returns the time at which the formulas of a boundary are evaluated at time t [s]. */
static inline real boundary_time(const struct boundary *b, real t)
{
    return b->frozen ? b->frozen_at : b->end > 0 ? real_min(t, b->end) : t;
}

/* Returns true if the boundary applies forces to particles. */
static inline bool boundary_is_force(const struct boundary *b)
{
    return b->kind == BOUNDARY_TRACTION || b->kind == BOUNDARY_BODY_FORCE || b->kind == BOUNDARY_PRESSURE;
}

/* A constrained component of a node, valid as long as the grid keeps its box. */
struct held {
    int32_t node;
    uint8_t component, load;
};

/* Constrained components of nodes; found once for each box of nodes. */
struct constrained_set {
    int64_t n, lasting; /* length of `held`; the first `lasting` do not depend on nodal masses */
    struct held *held;
    int64_t first[DIM_MAX], count[DIM_MAX]; /* box of nodes for which they were found */
};

/* All boundary conditions of a run with their accounts. */
struct loads {
    int n;
    struct load *load;
    uint8_t *loaded; /* [particles + LANES] sum of LOADED, MOVES_LATER, TOUCHES; NULL: all 0 */
    int64_t listed;
    int32_t *list; /* [listed] particles for which `loaded` is not 0, ascending */
    int64_t images;
    struct image *image;
    real impulse[DIM_MAX];    /* impulse of loads and supports since the start [N s] */
    real work;                /* work of applied forces, up to the present positions [J] */
    real constraint_work;     /* work of supports, up to the velocities, half a step behind [J] */
    real spacing, reach;      /* lattice spacing; reach of bonds [m] */
    real centre[2], turn;     /* static, free in 2D: centre of mass [m]; angular acceleration by the moment of the loads
                                 [1/s^2], 0: none */
    real place_step[DIM_MAX]; /* positions across mirrors are rounded to multiples of this, 0: not rounded [m] */
    struct absorbing absorbing;
    bool ended;  /* forces are computed that no step follows */
    real *share; /* working memory: driven mass of the grid's nodes [kg] */
    struct constrained_set
        constrained_mesh; /* nodes of the mesh in driven regions, on mirrors, and with mostly driven points */
};

/* Marks in loads.loaded. LOADED: forces other than those of bonds and grid may act on the particle. MOVES_LATER: bonds
 * across a clamped plane nearby act on it after the bond sweep. TOUCHES: contact may act on it. */
enum { LOADED = 1, MOVES_LATER = 2, TOUCHES = 4 };

/* Returns true if contact or loads may act on particle i. */
static inline bool is_loaded(const struct loads *l, int64_t i)
{
    return l->loaded && l->loaded[i] & (LOADED | TOUCHES);
}

/* Returns true for a mirror that also prevents motion along its plane; false in 1D, where it is a plane of symmetry. */
static inline bool is_clamp(const struct boundary *b, int dim)
{
    return b->kind == BOUNDARY_MIRROR && b->hold_tangential && dim > 1;
}

/* Finds the particles of one boundary (of a clamped mirror those in its plane), ascending, with their shares; sets
 * FLAG_DRIVEN. REFUSED for a force on a region without particles, or a traction on one without a free face. */
status load_select(struct load *l, const struct boundary *b, struct particles *p, real spacing);

/* Marks the particles in the region and body of a boundary: selected [n]. Returns false if there are none. */
bool load_region(const struct boundary *b, const struct particles *p, real spacing, uint8_t *selected);

/* Lists the particles with taken[i] > 0 as those of the load, sets FLAG_DRIVEN for prescribed motion, allocates
 * shares. */
void load_take(struct load *l, const uint8_t *taken, struct particles *p);

/* Exposed face for a traction (loads_columns.c): areas of particles. Of each column along the normal, the first
 * particle that no other one hides gets its area; for tangential components together with the next one if `two`. */
struct face {
    real *normal, *along; /* [particles] area for the normal component, and for the tangential ones [m^2] */
};

/* Computes the exposed face of boundary b among the selected particles [n]. two: extrapolate tangential components from
 * two particles. Release with face_free. */
void face_make(struct face *f, const struct boundary *b, const struct particles *p, const uint8_t *selected,
               real spacing, bool two);

/* Releases the areas. */
void face_free(struct face *f);

/* Marks in taken [n] the selected particles in the layer of depth b->depth behind the face of b; a gap in a column of
 * particles normal to the face ends the layer there. */
void face_layer(const struct boundary *b, const struct particles *p, const uint8_t *selected, real spacing,
                uint8_t *taken);

/* Receives a free end of a column: particle and area of the column [m^2]. */
typedef void face_found_fn(void *context, int32_t particle, real area);

/* Calls `found` for every free end of a column along the normal of b's face, including walls of holes. */
void face_every(const struct boundary *b, const struct particles *p, const uint8_t *selected, real spacing,
                face_found_fn *found, void *context);

/* Finds the particles of a pressure, number `which` of n boundaries; part of loads_make (loads_pressure.c). */
status load_select_pressure(struct load *l, const struct boundary *boundary, int n, int which, struct particles *p,
                            real spacing);

/* Receives a free face of a particle: axis and side of its normal, its area [m^2]. */
typedef void pressure_face_fn(void *context, int32_t particle, int axis, int side, real area);

/* Calls `found` for every free face among the selected particles on which pressure number `which` of n boundaries
 * acts. */
void pressure_faces(const struct boundary *all, int n, int which, const struct particles *p, real spacing,
                    const uint8_t *selected, pressure_face_fn *found, void *context);

/* Prepares the shares of a load with formulas or a following pressure (loads_moving.c): formulas without time are
 * multiplied into the shares. REFUSED where a formula is not finite. */
status load_formula_make(struct load *l, const struct particles *p);

/* Checks that the formulas of all loads and supports are finite on their particles at time t [s]. FAILED otherwise,
 * with name, position and time. */
status loads_finite(const struct loads *l, const struct particles *p, real t);

/* Updates the shares of loads that change in time for loads_push: mean over the kick that ends at t [s]. */
void loads_moving_push(struct loads *l, const struct particles *p, real t, real dt_velocity);

/* Updates the shares of loads that change in time for loads_push_work: mean of the kicks before and after the drift. */
void loads_moving_work(struct loads *l, const struct particles *p, real t, real dt);

/* Releases the arrays of load_formula_make. */
void load_moving_free(struct load *l);

/* Computes the force of a load on its k-th particle at time t, at reference positions; static: at full load. force
 * [dim] [N]. */
void load_force_at(const struct load *l, const struct particles *p, int64_t k, real t, real *force);

/* Stores the total force of a load at time t in `reaction`, and in `displacement` the mean displacement of its
 * particles, weighted by force so that force times displacement is the work; unweighted if the forces cancel. */
void load_applied_sum(struct load *l, const struct particles *p, real t);

/* Computes the value of a boundary at its k-th particle, without areas and profile: value [dim], unit as
 * boundary.value. Not for rotations. */
void load_value_at(const struct load *l, const struct particles *p, int64_t k, real t, real *value);

/* Finds the particles of every boundary, sets FLAG_DRIVEN, and appends mirror images within `reach` [m] of mirror
 * planes to the particles (so bonds must be made afterwards). spacing [m]: of the columns for tractions. optional: as
 * particles_make. REFUSED as load_select. Release with loads_free. */
status loads_make(struct loads *l, const struct boundary *boundary, int n, struct particles *p, real spacing,
                  real reach, int optional);

/* Releases all loads. */
void loads_free(struct loads *l);

/* Sets the list of particles on which contact forces may act (n indices in ascending order, copied). Their forces are
 * cleared before each step, and their motion is not fused with the bond sweep. */
void loads_touch(struct loads *l, const struct particles *p, const int32_t *list, int64_t n);

/* ---- applied forces (loads_applied.c) ---------------------------------------------------------------------------- */

/* Combines loads on equal lists of particles; last part of loads_make. */
void loads_join(struct loads *l, int dim);

/* Releases the shares of all loads. */
void loads_applied_free(struct loads *l);

/* Adds the applied forces to p->f, and their impulse to l->impulse; part of loads_apply. */
void loads_push(struct loads *l, struct particles *p, real t, real dt_velocity);

/* Adds the work of the applied forces in a step to l->work; part of loads_hold. */
void loads_push_work(struct loads *l, struct particles *p, real t, real dt);

/* ---- absorbing faces (loads_absorbing.c) ------------------------------------------------------------------------- */

/* Checks that no part of a face has two absorbing boundaries, and that none is in a mirror plane; else REFUSED. */
status loads_absorbing_check(const struct loads *l, const struct particles *p);

/* Creates the dashpots of all absorbing faces, after loads_make. impedance: [MOVERS][materials] by the method that
 * moves a particle, borrowed. */
void loads_absorbing_make(struct loads *l, const struct particles *p, const struct impedance *const *impedance);

/* Releases the dashpots. */
void loads_absorbing_free(struct loads *l);

/* Adds the dashpot forces on particles that bonds move; part of loads_apply. */
void loads_absorb(struct loads *l, struct particles *p, real dt_velocity);

/* Lists the dashpots of grid nodes, after the walls; part of loads_walls. half_width: l_p [m]. */
void loads_dashpots(struct loads *l, struct grid *g, const struct particles *p, const struct kernels *k,
                    real half_width);

/* Lists the dashpots of mesh nodes; part of loads_mesh_find. */
void loads_mesh_dashpots(struct loads *l, struct mesh *mesh, const struct particles *p);

/* Books energy and impulse of dashpots. */
void loads_absorbed(struct loads *l, const struct absorbed *by);

/* Displacements that a boundary of kind VELOCITY prescribes at a (pseudo-)time t >= 0, from reference positions. For
 * `displacement` its value, for a velocity its integral from 0, for a rotation the rotation by the accumulated angle;
 * static formulas are evaluated at `frozen_at`. Made once for a load and time, then evaluated at many positions. Not
 * for a velocity by a formula of t, whose integral has no closed form: load_displacement_known refuses it. */
struct displacing {
    const struct boundary *boundary;
    int dim;
    real t, factor;                 /* time [s]; factor on value and formula at t: [1], for a velocity [s] */
    real turned[DIM_MAX * DIM_MAX]; /* rotates: rotation matrix at t, row major */
};

/* Evaluates time functions and rotation at t [s]. */
struct displacing displacing_make(const struct boundary *b, int dim, real t);

/* Returns component d, one of boundary->components, of the displacement at the reference position X [dim, m] [m]. */
real displacing_at(const struct displacing *s, const real *X, int d);

/* Computes the displacement of a load's k-th particle at t: u [dim] [m], 0 in components that are not prescribed. */
void load_displacement_at(const struct load *l, const struct particles *p, int64_t k, real t, real *u);

/* REFUSED for a boundary of kind VELOCITY whose displacements are not known in closed form. OK for all others. */
status load_displacement_known(const struct boundary *b);

/* Motion that a boundary prescribes in a step from t - dt/2 to t + dt/2 (loads_driving.c). */
struct driving {
    const struct boundary *boundary;
    int dim;
    real t, dt, factor;         /* time, step [s], value of the function of time at t */
    struct displacing from, to; /* displaces, rotates: displacements at the ends of the step */
};

/* Evaluates the motion of boundary b in the step about t. */
struct driving driving_make(const struct boundary *b, int dim, real t, real dt);

/* Evaluates the motion of boundary `which` in the step about t. After the last step (l->ended) a prescribed
 * displacement continues as in the previous step: otherwise half of a change of motion after the end would enter the
 * work of the run. */
struct driving loads_driving(const struct loads *l, int which, int dim, real t, real dt);

/* Returns the velocity of component d at the reference position X [m/s]; placed: of material at X at the start of the
 * step. For a displacement: its difference over the step divided by dt. */
real driving_at(const struct driving *s, const real *X, int d, bool placed);

/* Returns true if the prescribed motion depends on position. */
static inline bool drives_by_place(const struct boundary *b)
{
    return b->rotates || b->formula[0].in_space || b->formula[1].in_space || b->formula[2].in_space;
}

/* Returns the largest speed that a displacement prescribes between the times 0 and t [m/s], INFINITY if it jumps; for
 * formulas sampled at MOMENTS times and some particles. */
real load_displacing_speed(const struct load *l, const struct particles *p, real t);

/* Returns the largest difference between the velocity that a load prescribes between the times 0 and t, sampled at
 * MOMENTS times and some particles, and the velocities of its particles in p, the state at t = 0; for rotations the
 * difference of speeds; 0 for displacements [m/s]. */
real load_velocity_jump(const struct load *l, const struct particles *p, real t);

/* Returns the largest change of the velocity that a load (velocity or displacement) prescribes within a span of time
 * [m/s], between the times 0 and t; before 0 its particles have the velocity in p. Sampled at MOMENTS times and some
 * particles. within: the span [s], at least one sampling interval is used. */
real load_velocity_change(const struct load *l, const struct particles *p, real t, real within);

/* Returns the largest difference between the velocities that two loads prescribe, each less that of its particles in p,
 * between the times 0 and t, in the components that both prescribe [m/s]; 0 if there are none, INFINITY if one of them
 * rotates or depends on position. */
real loads_velocity_apart(const struct load *a, const struct load *b, const struct particles *p, real t);

/* tolerance of region membership, over the spacing: points on the border belong to the region */
#define LOADS_TOLERANCE ON_SURFACE

/* ---- mirrors (loads_mirror.c) ------------------------------------------------------------------------------------ */

/* Checks mirrors and appends their images; part of loads_make. REFUSED for a mirror inside its body. */
status loads_mirrors_make(struct loads *l, struct particles *p, real reach, int optional);

/* Sets MOVES_LATER for particles whose bonds may cross a clamped plane. */
void loads_mirrors_mark(struct loads *l, const struct particles *p);

/* Updates images from their sources: x, v, kind and FLAG_DRIVEN. First rounds the positions of the sources across the
 * mirror to multiples of place_step, about the last bit of the farthest position. */
void loads_mirror(const struct loads *l, struct particles *p);

/* Sets f = 0 on every loaded particle, before the bond sweep (loads_applied.c). */
void loads_clear(struct loads *l, struct particles *p);

/* Completes the forces after the bond sweep: books the impulse of mirror images, adds applied forces and dashpots, and
 * replaces f of driven peridynamic particles by the force that gives them their velocity. t: middle of the step, where
 * the kick ends that began dt_velocity before [s]. */
void loads_apply(struct loads *l, struct particles *p, real t, real dt, real dt_velocity);

/* Sets the walls of a grid: nodes in a driven region or on a mirror plane, and nodes at least half of whose mass
 * belongs to driven points. Nodes beyond a mirror plane follow their images if the plane is on a node or midway between
 * two, else they are constrained like nodes on the plane. held: set of this grid, zero at first. Call after the first
 * map. */
void loads_walls(struct loads *l, struct constrained_set *held, struct grid *g, const struct particles *p,
                 const struct kernels *k, real half_width, real t, real dt);

/* Finds the constrained nodes and dashpots of the mesh: at the first call, and again after it has lost points. */
void loads_mesh_find(struct loads *l, struct mesh *mesh, const struct particles *p);

/* Sets the walls of the mesh for the step about t. */
void loads_mesh_walls(const struct loads *l, struct mesh *mesh, real t, real dt);

/* Finds the constrained nodes of a mesh of coarse cells by position: in driven regions and on mirrors. */
void loads_level_find(const struct loads *l, struct constrained_set *held, struct grid *g, const struct particles *p);

/* Sets the walls of a mesh of coarse cells for the step about t. */
void loads_level_walls(const struct loads *l, const struct constrained_set *held, struct grid *g, real t, real dt);

/* After the grid-to-particle transfer: sets the velocity of driven material points and the position of displaced
 * particles exactly; books the work of applied forces. Returns true if points on a grid were moved. */
bool loads_hold(struct loads *l, struct particles *p, real t, real dt);

/* Adds the reactions of the walls and dashpots of one grid, or of the mesh, to the loads. */
void loads_react(struct loads *l, const struct grid *g, real dt_velocity);

/* Returns true if a mirror's plane is on a node of the grid or midway between two. */
bool mirror_on_nodes(const struct boundary *b, const struct grid *g, real spacing);

/* ---- static equilibrium (loads_static.c) ------------------------------------------------------------------------- */

/* Makes boundaries of a static problem in pseudo-time: copies n of them into `to`; forces have their value at
 * `duration` [s], and prescribed motion its displacement until then. Both grow linearly from 0 to `ramp` [s] and stay
 * constant. */
void loads_static_boundaries(struct boundary *to, const struct boundary *from, int n, real duration, real ramp);

/* Computes the final displacement of every driven component: displacement [dim][n] [m], and bits of driven components:
 * held [n]. Where loads overlap the later one counts, as in a run. */
void loads_static_driven(struct loads *l, const struct particles *p, real ramp, real *const *displacement,
                         uint8_t *held);

/* Adds the inertia of a rigid rotation to the applied forces of a free body in 2D (inertia relief), so that loads with
 * a moment, e.g. on scattered particles of an irregular lattice, have an equilibrium. Returns the moment over the
 * largest moment that forces of this size could have [1]. */
real loads_static_balance(struct loads *l, const struct particles *p);

/* Adds the applied forces of a static problem to p->f. */
void loads_static_force(const struct loads *l, struct particles *p);

/* Moves the forces on driven components from p->f to the reactions. */
void loads_static_hold(struct loads *l, struct particles *p);

/* Computes the work of loads that grow in proportion on a linear body: half the applied force times displacement, into
 * `work`, and half the reactions times displacement, into `constraint_work`. */
void loads_static_work(struct loads *l, const struct particles *p);

/* Saves or restores accounts, displacements and reactions. */
status loads_archive(struct loads *l, struct archive *a);

/* largest number: indices are stored as bytes in struct held and struct image; scene_keys.c */
enum { BOUNDARIES_MAX = 255 };

#endif
