/* Boundary conditions as an input file defines them: their kinds, what each prescribes as a function of position and
 * time, and which particles it selects. loads.h applies them to the particles, grids and meshes of a run. */
#ifndef CLEAVE_BOUNDARY
#define CLEAVE_BOUNDARY

#include "base/base.h"
#include "data/expression.h"
#include "data/particles.h"
#include "data/region.h"

/* Kinds of boundary conditions. */
enum boundary_kind {
    BOUNDARY_VELOCITY,   /* prescribes components: velocity, displacement, rotation (`fixed` is a velocity of 0) */
    BOUNDARY_TRACTION,   /* surface force on the exposed face of a body along an axis [Pa] */
    BOUNDARY_BODY_FORCE, /* force per volume [N/m^3] */
    BOUNDARY_MIRROR,     /* plane of symmetry (roller) or of antisymmetry (fixed end) */
    BOUNDARY_ABSORBING,  /* dashpots on the exposed face of a body along an axis (absorbing.h) */
    BOUNDARY_PRESSURE    /* on every free face, against its outward normal (loads_pressure.c) [Pa] */
};

/* Factor on a body force at the reference position X. PROFILE_UNIFORM: 1; PROFILE_SINE: sin(2 pi (X - origin) .
 * direction/(wavelength |direction|)). */
enum profile_kind { PROFILE_UNIFORM, PROFILE_SINE };

/* A factor on a body force as a function of the reference position: its kind, and the constants of the formula given at
 * enum profile_kind. */
struct profile {
    enum profile_kind kind;
    real wavelength;         /* [m] */
    real origin[DIM_MAX];    /* zero of the sine, which increases along `direction` [m] */
    real direction[DIM_MAX]; /* of any length [1] */
};

/* One boundary condition of an input file. Where a comment on a member begins with a kind, such as VELOCITY, only this
 * kind uses the member; else all kinds do. */
struct boundary {
    char name[NAME_MAX_LENGTH];
    char place[PLACE_LENGTH]; /* location in the scene file, for messages */
    enum boundary_kind kind;
    struct region region; /* selects particles by reference position; empty: everywhere */
    int body;             /* index of the body on which it acts, -1: any */
    uint8_t components;   /* VELOCITY: bit d is set if component d is prescribed */
    real value[DIM_MAX];  /* by kind [m/s], [m], [Pa] or [N/m^3]; PRESSURE: all equal; 1 if there is a formula */
    /* formula of each component in X and t; PRESSURE: the first is used for all; empty: value only */
    struct expression formula[DIM_MAX];
    real end;    /* time after which formulas keep their values, 0: unknown [s] */
    bool frozen; /* static problem: formulas have their value at the time `frozen_at` [s] */
    real frozen_at;
    bool displaces; /* VELOCITY: value, times factor and formula, is a displacement [m] */
    bool rotates;   /* VELOCITY: particles rotate about an axis; all components are prescribed */
    real centre[DIM_MAX], axis_of[DIM_MAX], rate; /* point on the axis [m]; its direction; angular velocity [1/s] */
    bool follow;                                  /* PRESSURE: normals and areas are those of the deformed body */
    struct time_function time;                    /* factor on `value` as a function of time */
    char *time_file;                              /* CSV file of the factor; NULL: given in the scene */
    char time_column[NAME_MAX_LENGTH];            /* column of the file; "": the only one beside the time */
    uint64_t time_contents;                       /* hash of the file; 0: not read */
    bool time_unit;         /* the column has the unit of the value, and `value` is only the direction */
    struct profile profile; /* BODY_FORCE: factor on value */
    bool by_mass;           /* BODY_FORCE: gravity; value is an acceleration [m/s^2] */
    int face;               /* TRACTION, ABSORBING, VELOCITY: axis of the normal of the face */
    int side;               /* +1: face at the upper end of that axis, -1: lower end; VELOCITY: 0, no face */
    real depth;             /* VELOCITY: depth of the driven layer of particles behind the face [m] */
    real section; /* with a face: cross-section in 1D [m^2], thickness in 2D [m], 1 in 3D; 0: the area of a particle is
                     its volume divided by the spacing */
    int axis;     /* MIRROR: axis of the plane's normal */
    real at;      /* MIRROR: position of the plane [m] */
    bool hold_tangential; /* MIRROR: displacement odd in all components, not only the normal one */
};

/* Returns true if a formula of boundary b contains the time t. */
static inline bool boundary_formula_depends_on_time(const struct boundary *b)
{
    bool in_time = false;
    for (int d = 0; d < DIM_MAX; d++) in_time |= b->formula[d].in_time;
    return in_time;
}

/* Returns the time [s] for which the formulas of boundary b are evaluated at time t: b->frozen_at in static problems,
 * else t, but at most b->end, after which formulas keep their values. */
static inline real boundary_time_at_which_formulas_are_evaluated(const struct boundary *b, real t)
{
    return b->frozen ? b->frozen_at : b->end > 0 ? real_min(t, b->end) : t;
}

/* Returns true if boundary b applies forces: a traction, a body force or a pressure. */
static inline bool boundary_applies_force(const struct boundary *b)
{
    return b->kind == BOUNDARY_TRACTION || b->kind == BOUNDARY_BODY_FORCE || b->kind == BOUNDARY_PRESSURE;
}

/* Returns true if boundary b is a support at rest: prescribes zero velocity or displacement. dim: of the space. */
static inline bool boundary_is_support_at_rest(const struct boundary *b, int dim)
{
    return b->kind == BOUNDARY_VELOCITY && !b->rotates && dot(b->value, b->value, dim) == 0;
}

/* Returns true if boundary b is a mirror that also prevents motion along its plane. In 1D (dim = 1) there is no such
 * motion, and false is returned. */
static inline bool boundary_is_mirror_without_tangential_motion(const struct boundary *b, int dim)
{
    return b->kind == BOUNDARY_MIRROR && b->hold_tangential && dim > 1;
}

/* Returns the components of motion that boundary b prescribes, as bits (bit d: component d): those of a prescribed
 * motion, the one normal to a mirror, all `dim` of a clamped mirror; 0 for other kinds. A mirror that is not clamped
 * constrains only nodes of grids and meshes in its plane, no particles. */
uint8_t boundary_prescribed_component_mask(const struct boundary *b, int dim);

/* ---- particles that a boundary selects --------------------------------------------------------------------------- */

/* Distance up to which a particle outside a region counts as inside, so that particles on its border do [spacings]. */
#define LOADS_TOLERANCE ON_SURFACE

/* Sets selected[i] = 1 for the particles i < p->n in the region and body of boundary b, 0 for all others. spacing:
 * lattice spacing, to which the tolerance of the region refers [m]. Returns false if none is selected. */
bool boundary_select_particles_in_region(const struct boundary *b, const struct particles *p, real spacing,
                                         uint8_t *selected);

/* Areas by which the tractions on an exposed face are multiplied to obtain forces on particles (loads_columns.c). In
 * each column of particles normal to the face, the outermost particle has the area of the column, all others 0. If
 * tangential tractions are extrapolated to the face, their area is 3/2 of that on the outermost particle and -1/2 on
 * the next one. */
struct exposed_face {
    real *normal, *along; /* [particles] area for the normal component, and for the tangential ones [m^2] */
};

/* Computes the areas of the outermost particles at the face of boundary b, among those with selected[i] = 1, into f.
 * selected: [p->n]; spacing: lattice spacing [m]; extrapolate_traction: true to extrapolate tangential tractions to the
 * face from the first two particles of each line normal to it, false to apply them to the first one. Free:
 * exposed_face_free. */
void exposed_face_compute_particle_areas(struct exposed_face *f, const struct boundary *b, const struct particles *p,
                                         const uint8_t *selected, real spacing, bool extrapolate_traction);

/* Frees both arrays of areas in f. */
void exposed_face_free(struct exposed_face *f);

/* Sets in_layer[i] = 1 for the selected particles in the layer of depth b->depth behind the face of boundary b, and
 * leaves other entries unchanged. On each line of particles normal to the face the layer ends at the first gap.
 * selected, in_layer: [p->n]; spacing: lattice spacing [m]. */
void boundary_face_flag_particles_within_depth(const struct boundary *b, const struct particles *p,
                                               const uint8_t *selected, real spacing, uint8_t *in_layer);

/* Function that boundary_face_visit_surface_particles calls for each free end of a line of particles normal to a face.
 * particle: index of the particle at that end; area: cross-section of the line [m^2]; context: data of the caller. */
typedef void face_particle_fn(void *context, int32_t particle, real area);

/* Calls visit(context, particle, area) for every selected particle at a free end, towards the face of boundary b, of a
 * line of particles normal to it; also at walls of holes. selected: [p->n]; spacing: lattice spacing [m]. */
void boundary_face_visit_surface_particles(const struct boundary *b, const struct particles *p, const uint8_t *selected,
                                           real spacing, face_particle_fn *visit, void *context);

/* ---- prescribed motion (loads_driving.c) ------------------------------------------------------------------------- */

/* Displacements that a boundary of kind VELOCITY prescribes at a (pseudo-)time t >= 0, from reference positions. For
 * `displacement` its value, for a velocity its integral from 0, for a rotation the rotation by the accumulated angle;
 * static formulas are evaluated at `frozen_at`. Made once for a load and time, then evaluated at many positions. Not
 * for a velocity by a formula of t, whose integral has no closed form
 * (boundary_check_velocity_has_closed_form_integral). */
struct prescribed_displacement {
    const struct boundary *boundary;
    int dim;
    real t, factor;                 /* time [s]; factor on value and formula at t: [1], for a velocity [s] */
    real turned[DIM_MAX * DIM_MAX]; /* rotates: rotation matrix at t, row major */
};

/* Returns the displacements that boundary b prescribes at time t [s], prepared for evaluation at many positions by
 * prescribed_displacement_component_at_position: evaluates the function of time and the rotation once. dim: dimension;
 * b: kept, borrowed.
 */
struct prescribed_displacement boundary_prescribed_displacement_at_time(const struct boundary *b, int dim, real t);

/* Returns component `component` of the prescribed displacement [m] at the reference position X (dim components [m]).
 * The boundary must prescribe this component. */
real prescribed_displacement_component_at_position(const struct prescribed_displacement *prescribed, const real *X,
                                                   int component);

/* Returns REFUSED, with a message, if boundary b prescribes a velocity whose integral over time has no closed form (a
 * formula of t), so that its displacements are unknown; else OK. */
status boundary_check_velocity_has_closed_form_integral(const struct boundary *b);

/* Motion that a boundary of kind VELOCITY prescribes in a time step from t - dt/2 to t + dt/2 (loads_driving.c). */
struct prescribed_motion {
    const struct boundary *boundary;
    int dim;
    real t, dt, factor;                      /* time, step [s], value of the function of time at t */
    struct prescribed_displacement from, to; /* displaces, rotates: displacements at the ends of the step */
};

/* Returns the motion that boundary b prescribes in the step of size dt from t - dt/2 to t + dt/2 [s], prepared for
 * evaluation at many positions by prescribed_velocity_component_at_position. dim: dimension of the body; b: kept by
 * reference. */
struct prescribed_motion boundary_prescribed_motion_in_step(const struct boundary *b, int dim, real t, real dt);

/* Returns component `component` of the velocity [m/s] prescribed by `motion` at X (dim components [m]); for a
 * prescribed displacement its change in the step divided by dt. at_present_position: true if X is the position of the
 * material at the start of the step, false if X is its reference position. */
real prescribed_velocity_component_at_position(const struct prescribed_motion *motion, const real *X, int component,
                                               bool at_present_position);

/* Returns true if the motion that boundary b prescribes differs between positions: it rotates or depends on X. */
static inline bool boundary_motion_varies_in_space(const struct boundary *b)
{
    return b->rotates || b->formula[0].in_space || b->formula[1].in_space || b->formula[2].in_space;
}

#endif
