/* Room `scene` (folders include/scene and src/scene): reads and checks the input file of a run, and creates its
 * particles. It uses materials, regions and loads, and defines the settings of the parts of a run (requests.h). These
 * parts, the engine, commands and benches call it.
 *
 * struct scene contains all input of a run, checked and in SI units. Only scene_yaml.c uses libyaml (info.c reads its
 * version). */
#ifndef CLEAVE_SCENE
#define CLEAVE_SCENE

#include <stdio.h>

#include "bonds/bonds.h"
#include "kernels/kernels.h"
#include "loads/loads.h"
#include "data/material.h"
#include "data/region.h"
#include "particle_list.h"
#include "requests.h"

/* Method of a scene: peridynamics, material point method, material points that convert to peridynamic particles where
 * the body breaks, or AUTO, which only scene files contain: pilot runs replace it by one of the others
 * (scene_read.h). */
enum method { METHOD_PD, METHOD_MPM, METHOD_ADAPTIVE, METHOD_AUTO };
enum { FILL_AUTO, FILL_ALL, FILL_NEEDED }; /* mpm.fill: which particles are created */
enum { LEVELS_AUTO = 5 };                  /* mpm.levels: auto */
enum { FRAMES_MOST = 100000 };             /* largest number of frames of a run */

/* Configuration to which the grid of a body is fixed. CURRENT: material points map to a background grid in every step;
 * REFERENCE: a mesh of the undeformed body; AUTO: the program chooses. */
enum grid_frame { FRAME_CURRENT, FRAME_REFERENCE, FRAME_AUTO };

/* Peridynamic model: bond-based, ordinary state-based, state-based with rotations of the particles. */
enum model { MODEL_BOND, MODEL_OSPD, MODEL_MOSPD };

/* How a run is solved. EXPLICIT: time steps; RELAXATION, CG: one static equilibrium by dynamic relaxation or conjugate
 * gradients; STATIC: load steps, in which bonds may break. */
enum solver_kind { SOLVER_EXPLICIT, SOLVER_RELAXATION, SOLVER_CG, SOLVER_STATIC };

/* A region of a body that consists of another material than the rest of the body. */
struct scene_part {
    struct region region;
    int material; /* index into scene.material */
};

/* A body of the scene, deformable or rigid: its shape, materials and motion. */
struct scene_body {
    char name[NAME_MAX_LENGTH];
    int material; /* index into scene.material */
    int parts;
    struct scene_part *part;        /* [parts] regions of other materials; later ones overrule earlier ones */
    struct region shape;            /* region that is filled with a lattice of particles, unless `file` is given */
    char *file;                     /* path of a file with a list of particles (.csv, .h5); NULL: none */
    uint64_t contents;              /* hash of the contents of `file`; 0: not read */
    struct particle_list_form form; /* units and columns of `file` as the scene gives them */
    char *columns;                  /* text of the scene that names the columns of `file`; NULL: not given */
    struct particle_list_head list; /* columns that were found in `file` */
    char place[PLACE_LENGTH];       /* location in the scene file of `file`, else of the body, for messages */
    real velocity[DIM_MAX];         /* initial velocity [m/s] */
    int joined;                     /* lowest index of the bodies that interfaces join to this body, itself included */
    bool rigid;                     /* rigid body without particles */
    real mass, ramp;                /* rigid: mass of a free body [kg]; time until a driven body has full speed [s] */
    real force[DIM_MAX];            /* rigid: constant force on a free body [N] */
    enum grid_frame frame;          /* default: mpm.frame; AUTO only where the scene allows the reference frame */
    const char *frame_reason;       /* reason why AUTO became CURRENT; NULL: the frame was not AUTO, or still is */
};

/* Interface between two bodies that touch: whether bonds join them, and how strong these bonds are. */
struct scene_interface {
    int body[2];              /* indices into scene.body */
    bool joined;              /* bonds across the interface join the bodies */
    real energy_release_rate; /* of the bonds across the interface [J/m^2]; 0: that of the weaker material */
    real critical_stretch;    /* of these bonds, computed from energy_release_rate [1]; 0: that of the materials */
};

/* A region with a name in the scene; solids that refer to the name receive a copy of the region. */
struct named_region {
    char name[NAME_MAX_LENGTH];
    struct region region;
};

/* Initial state of the particles in a region; a later entry overwrites earlier ones. */
struct scene_initial {
    char place[PLACE_LENGTH]; /* location in the scene file, for messages */
    struct region region;
    int body; /* index of the body whose particles are set; -1: all bodies */
    /* velocity, its formula and its gradient are set; displacement_gradient is set */
    bool sets_velocity, sets_strain;
    real velocity[DIM_MAX];                        /* [m/s]; 1 for a component given by a formula */
    struct expression formula[DIM_MAX];            /* factor on a velocity component, of the position; may be empty */
    real velocity_gradient[DIM_MAX * DIM_MAX];     /* G in v += G (X - centre), row major dim x dim [1/s] */
    real displacement_gradient[DIM_MAX * DIM_MAX]; /* H in x = X + H (X - centre), stress = C : sym H [1] */
    real centre[DIM_MAX];                          /* reference position at which both gradients act as 0 [m] */
    bool sets_pulse;                               /* `pulse` is added to the state */
    struct wave_pulse pulse;                       /* plane longitudinal wave */
};

/* A series of frames (files with the state at one time) of the particles in a region, written at a time interval of its
 * own. */
struct scene_series {
    char name[NAME_MAX_LENGTH];
    struct region region;
    real every;      /* time between frames [s] */
    unsigned fields; /* bit set of the fields in the order of FRAME_FIELD_WORDS; 0: those of the scene's frames */
};

/* Quantity that is prescribed in each load step and determines its loads. LOAD: the pseudo-time; ENERGY: the energy of
 * the crack increment; OPENING: the distance of two points. */
enum steps_control { CONTROL_LOAD, CONTROL_ENERGY, CONTROL_OPENING };

/* Continuation of a run with load steps after unstable crack growth. EQUILIBRIUM: the next equilibrium; EXPLICIT:
 * explicit integration in time. */
enum steps_then { THEN_EQUILIBRIUM, THEN_EXPLICIT };

/* Criterion of the crack path: bonds with the largest ratio of stretch to critical stretch, or the largest hoop stress.
 */
enum steps_path { PATH_AUTO, PATH_BONDS, PATH_HOOP };

/* Settings of the load steps of a scene with `solver: static` (load_steps.c). */
struct scene_steps {
    int number; /* number of steps: with control load equal parts of the duration, else the largest number */
    enum steps_control control;
    enum steps_path path;
    real energy;                              /* energy of the bonds of a crack increment [J];
                                                 0: it follows from toughness and spacing */
    real from[DIM_MAX], to[DIM_MAX], opening; /* points whose distance is the opening; its growth in all steps [m] */
    bool has_from, has_to;                    /* the scene gives `from`, `to` */
    enum steps_then then;
    int breaks;  /* path BONDS: largest number of pairs of bonds that break between two equilibria */
    real within; /* of these only bonds whose ratio of stretch to critical stretch is at least 1 - within times the
                    largest ratio break [1] */
};

/* A key of a scene and the location at which it is given, as text: `file:line:column`, or the override of the command
 * line. */
struct key_place {
    char key[104], place[408];
};

/* The input of a run, in SI units: what the scene file and the options of the command line give, with defaults for all
 * other keys. All arrays and texts are owned unless const; the count above an array is its length. */
struct scene {
    char *path;                  /* path of the scene file, as given on the command line */
    int64_t key_places;          /* number of keys whose location is known */
    struct key_place *key_place; /* [key_places] */
    char name[NAME_MAX_LENGTH];  /* default: file name without folder and extension */
    enum space space;
    int dim;               /* 1, 2 or 3, follows from `space` */
    real thickness;        /* 2D: thickness of the body [m]; 1 in 3D */
    real section;          /* 1D: cross-section A [m^2]; key `section`, default 1 */
    real duration;         /* simulated time; range of the pseudo-time of load steps [s] */
    real gravity[DIM_MAX]; /* acceleration of particles and of free rigid bodies [m/s^2] */
    real damping;          /* damping force of a particle divided by its momentum [1/s] */
    enum method method;
    enum model model;
    enum solver_kind solver; /* how the run is solved: in time, or for static equilibrium (solver.h) */
    real solver_tolerance; /* static: largest norm of the residual divided by that of applied forces or reactions [1] */
    int solver_steps;      /* static: largest number of iterations */
    struct scene_steps steps; /* load steps, of solver static */

    int materials, unused_materials; /* number of materials of which bodies consist; number of all others */
    struct material *material;       /* [materials + unused_materials], the unused ones last */
    int *material_number;    /* [materials + unused_materials] position of each material in the scene file, from 0 */
    int bodies;              /* number of deformable bodies */
    struct scene_body *body; /* [bodies + rigids] deformable bodies, then rigid bodies */
    int rigids;              /* number of rigid bodies */
    int interfaces;
    struct scene_interface *interface; /* [interfaces] */

    int regions;
    struct named_region *named; /* [regions] */
    struct shape_file *shapes;  /* list of files from which solids are read (shape_file.h) */

    /* distance of lattice particles [m]; reach of bonds [spacings]; coordinates are shifted at random by at most half
     * of this [spacings] */
    real spacing, horizon, irregularity;
    uint64_t seed; /* of the random numbers of irregularity and strength */

    /* rules of bonds: volume of a neighbour at the edge of the horizon, stiffness of bonds, bonds near faces, weights
     * by direction, weight by length; the default has been replaced by a rule in all of them (bonds/family.h) */
    enum volume_rule volume;
    enum calibration calibration;
    enum surface_rule surface;
    enum shell_rule shells;
    enum influence influence;
    bool bulk;                  /* state-based models: weights are normalised by the sum over a full neighbourhood */
    enum last_force last_force; /* force of a bond in the step in which it breaks */
    enum contact_between contact_between;   /* particles between which contact forces act */
    enum contact_form contact_form;         /* contact of faces, or of pairs of particles */
    enum contact_distance contact_distance; /* rule for the contact distance of pairs */
    bool contact_convert;                   /* adaptive: material points near another body become peridynamic */
    real contact_friction;                  /* coefficient of Coulomb friction [1] */
    real contact_stiffness;                 /* factor on the stiffness of contact [1] */
    bool has_pd_region;                     /* the scene gives pd_region */
    struct region pd_region;                /* region that is peridynamic from the start (adaptive) */

    real cell;                    /* distance of grid nodes [spacings] */
    enum shape shape;             /* shape functions of the grid */
    enum transfer transfer;       /* how velocities are transferred from the grid to material points */
    bool has_shape, has_transfer; /* the scene as written to `text` has the key */
    enum grid_frame frame;        /* frame of the grid; default of the bodies */
    bool small_strain;            /* the mesh of the reference frame computes small strains, else finite ones */
    int levels;                   /* levels of coarse cells in the reference frame; LEVELS_AUTO: chosen by cost */
    int fill;                     /* which particles are created: FILL_AUTO, FILL_ALL or FILL_NEEDED */
    bool lattice_constants;       /* elastic constants of the grid are those of the lattice of bonds */
    bool has_grid_origin;         /* the scene gives grid_origin */
    real grid_origin[DIM_MAX];    /* position of a grid node [m] */

    enum coupling coupling;        /* how peridynamic particles and material points interact */
    real interface_damping;        /* damping rate in the interface zone (interface_zone.h) [wave speed/cell edge] */
    bool has_interface_damping;    /* the scene as written to `text` has the key */
    const char *current_frame_key; /* reason why keys of the scene require the current frame; NULL: none */
    struct conversion_rule conversion; /* when material points convert, and back */

    int cracks;
    struct crack *crack; /* [cracks] pre-cracks: those of the scene file, then those of files of meshes */
    int cracks_given;    /* number of pre-cracks of the scene file */
    int growths;
    struct growth_rule *growth; /* [growths] cracks with prescribed or SIF-controlled growth */
    int initials;
    struct scene_initial *initial; /* [initials] */
    int boundaries;
    struct boundary *boundary; /* [boundaries] */
    int probes;
    struct probe_request *probe; /* [probes] */

    real time_step;           /* [s]; 0: automatic */
    bool active_set;          /* regions still at rest are skipped (active_set.h) */
    real safety;              /* factor on the critical time step, if it is automatic [1] */
    int frames;               /* number of frames after the one at t = 0 */
    bool has_frames;          /* the scene gives the number of frames */
    struct number_list times; /* times of these frames, ascending [s]; empty: evenly spaced */
    real every;               /* time between frames [s]; 0: not given */
    unsigned fields;          /* bit set of the requested fields of frames, in the order of FRAME_FIELD_WORDS */
    int n_series;
    struct scene_series *series; /* [n_series] frames of parts of the body */
    int samples;                 /* number of samples of history.csv after the one at t = 0 */
    real wall;                   /* wall-clock time after which a process ends with a checkpoint [s]; INFINITY: none */
    real checkpoint_interval;    /* wall-clock time between checkpoints [s]; NAN: chosen by their cost */
    bool compress;               /* frames are compressed with gzip */
    real speed_window;           /* time over which the crack-tip speed is averaged [s] */

    unsigned accept;   /* bits of enum accept: warnings that the scene silences */
    bool has_accept;   /* the scene has the key `accept` */
    char renamed[400]; /* keys that the scene gives by an earlier name; "": none */
    char *text;        /* the scene as run, in YAML: every key with its value or default */
};

/* A key of the scene and the value that replaces it, from the option `-s key=value` of the command line. The caller
 * that creates the override owns both texts. */
struct scene_override {
    const char *key, *value;
};

/* Returns true if the run of the scene s integrates in time, false if it solves one equilibrium or load steps. */
static inline bool scene_is_dynamic(const struct scene *s) { return s->solver == SOLVER_EXPLICIT; }

/* Returns the index, from 0, of the interval that contains the time t [s], if the duration of scene s is divided into
 * `interval_count` equal intervals. Costly checks of a run are made once per interval. */
static inline int scene_duration_interval_index_at_time(const struct scene *s, real t, int interval_count)
{
    return (int)(interval_count * t / s->duration * (1 + 1e-9));
}

/* Returns true if the run of the scene s solves a single static equilibrium, without load steps. */
static inline bool scene_is_single_equilibrium(const struct scene *s)
{
    return s->solver == SOLVER_RELAXATION || s->solver == SOLVER_CG;
}

/* Returns true if a run of the scene s solves a sequence of load steps (solver: static). */
static inline bool scene_has_load_steps(const struct scene *s) { return s->solver == SOLVER_STATIC; }

/* Returns true if a rigid body of the scene s has a velocity, from the start or prescribed. */
static inline bool scene_has_moving_rigid_body(const struct scene *s)
{
    bool moves = false;
    for (int k = s->bodies; k < s->bodies + s->rigids; k++)
        moves |= dot(s->body[k].velocity, s->body[k].velocity, DIM_MAX) > 0;
    return moves;
}

/* Returns true if bonds can break in the scene s: at least one material or interface has a finite critical stretch. */
static inline bool scene_bonds_can_break(const struct scene *s)
{
    bool breaks = false;
    for (int m = 0; m < s->materials; m++) breaks |= isfinite(s->material[m].critical_stretch);
    for (int k = 0; k < s->interfaces; k++) breaks |= s->interface[k].critical_stretch > 0;
    return breaks;
}

/* Returns true if at least one material of the scene s has bulk viscosity. */
static inline bool scene_any_material_has_bulk_viscosity(const struct scene *s)
{
    bool viscous = false;
    for (int m = 0; m < s->materials; m++) viscous |= material_has_viscosity(&s->material[m]);
    return viscous;
}

/* Returns true if at least one material of the scene s has a random strength, which differs between particles. */
static inline bool scene_has_random_strength(const struct scene *s)
{
    bool scatters = false;
    for (int m = 0; m < s->materials; m++) scatters |= s->material[m].scatter.given;
    return scatters;
}

/* Returns true if the scene s has a probe that evaluates broken bonds (kinds TIP, BREAK, SPALL, GROWTH). */
static inline bool scene_has_probe_of_broken_bonds(const struct scene *s)
{
    static const bool watches[PROBES] = {
        [PROBE_TIP] = true, [PROBE_BREAK] = true, [PROBE_SPALL] = true, [PROBE_GROWTH] = true};
    bool any = false;
    for (int k = 0; k < s->probes; k++) any |= watches[s->probe[k].kind];
    return any;
}

/* Returns true if the scene s silences the warning `warning` by its key `accept`. */
static inline bool scene_silences_warning(const struct scene *s, enum accept warning)
{
    return s->accept >> warning & 1;
}

/* Returns true if new surfaces can form in scene s: by pre-cracks, growing cracks, or bonds that break. */
static inline bool scene_can_have_cracks(const struct scene *s)
{
    return s->cracks > 0 || s->growths > 0 || scene_bonds_can_break(s);
}

/* Returns true if bodies of the scene s can come into contact: there are rigid bodies, or several deformable bodies
 * that interfaces do not join to a single one. */
static inline bool scene_bodies_can_come_into_contact(const struct scene *s)
{
    bool several = s->rigids > 0;
    for (int b = 0; b < s->bodies; b++) several |= s->body[b].joined > 0;
    return several;
}

/* Returns the factor by which the length (1D), area (2D) or volume (3D) of a region of scene s is multiplied to obtain
 * its volume: the cross-section in 1D [m^2], the thickness in 2D [m], 1 in 3D. */
static inline real scene_cross_section_or_thickness(const struct scene *s)
{
    return s->space == SPACE_LINE ? s->section : s->space == SPACE_SOLID ? 1 : s->thickness;
}

/* Returns the index, in b->part, of the last part of the body b (region with a material of its own) that contains the
 * position X (s->dim components [m]); -1 if no part contains it. */
int scene_body_part_index_at_position(const struct scene *s, const struct scene_body *b, const real *X);

/* Returns the index of the material at the position X (dim components [m]) in body b of scene s: that of the last part
 * of the body that contains X, or `default_material` if no part does. */
int scene_material_index_at_position(const struct scene *s, const struct scene_body *b, const real *X,
                                     int default_material);

/* Returns true if particles of body b can consist of the material with the index `material`: it is the material of the
 * body or of one of its parts, or the particle list of the body has a column of materials. */
bool scene_body_can_have_material(const struct scene_body *b, int material);

/* Returns the material with the number `number` in the scene file (0 .. s->materials + s->unused_materials - 1), by
 * which files of a run name it; NULL if there is none. */
const struct material *scene_find_material_by_number(const struct scene *s, int number);

/* Releases the members of the scene *s, which was read by a function of scene_read.h. */
void scene_free(struct scene *s);

/* Adds a location in the file of the scene s to the beginning of the stored message of a refusal (status_message),
 * unless it begins with one. It is the location of the body, boundary, key or group of keys with which the message
 * begins, else the path of the scene file. Does nothing unless `result` is REFUSED. Returns `result`. */
status scene_prepend_location_to_error_message(const struct scene *s, status result);

/* Finds the key, group of keys or named item with which the warning `text` begins, and writes its location in the scene
 * file, as `file:line:column` or `-s key=value`, to location[PLACE_LENGTH]; "" if the warning begins with none. scene:
 * a struct scene. Callback of struct warnings. */
void scene_find_file_location_of_warning(const void *scene, const char *text, char *location);

/* Returns the reason why shape functions of the body with the index `body` cannot be evaluated at the reference
 * positions of its material points (frame `reference`), with the method, solver, coupling and materials of the scene s.
 * Returns NULL if they can. The text is static. */
const char *scene_reason_total_lagrangian_mpm_unsupported(const struct scene *s, int body);

/* Returns true if, with method mpm and explicit time steps, a body of scene s yields whose shape functions are
 * evaluated at the reference positions of its material points (frame `reference`). */
bool scene_has_yielding_total_lagrangian_mpm_body(const struct scene *s);

/* Returns the reason why `mpm.frame: auto` does not choose the frame `reference` for the body of s with the index
 * `body`, that is, the evaluation of shape functions at reference positions. Returns NULL if it does. The text is
 * static. */
const char *scene_reason_auto_rejects_total_lagrangian_mpm(const struct scene *s, int body);

/* Returns the reason why messages must not recommend the key `mpm.frame: reference` (shape functions evaluated at
 * reference positions) as a remedy: the reason why `mpm.frame: auto` does not choose it, for the first body of scene s
 * for which there is such a reason. Returns NULL if there is none for any body. The text is static. */
const char *scene_reason_not_to_advise_total_lagrangian_mpm(const struct scene *s);

/* Prints the table of keys of scenes to `out`. key: NULL for all keys, a prefix for the keys below it, or one key.
 * Returns REFUSED for an unknown key, with the most similar key in the message. */
status scene_print_help_on_keys(FILE *out, const char *key);

/* Returns true if `cleave help` can explain the word `key`: it is the name or the last part of the name of a key of
 * scenes, a prefix of keys, a value of a key, a former name of a key, or a word of another program. */
bool scene_help_can_explain_word(const char *key);

/* Prints the units that numbers in scenes may have to `out`. */
void scene_print_allowed_units(FILE *out);

/* Prints a JSON schema of scene files to `out`, for editors. Returns FAILED if that is not possible. */
status scene_print_json_schema(FILE *out);

/* Prints the functions, operators and variables that expressions in scenes may contain to `out`. */
void scene_print_expression_syntax(FILE *out);

/* Writes the keys of scenes to `out` in troff, for the manual page. */
void scene_print_keys_for_manual_page(FILE *out);

/* Writes to `out` the names of all keys that the option `-s` can set, one per line, for completion by a shell. Items of
 * lists have the index 0 in these names. */
void scene_print_override_keys(FILE *out);

/* Writes the reference of all keys to `out` as Markdown: first a table of the keys at the top of a scene without keys
 * below them, then a table for each key with keys below it. */
void scene_print_key_reference_as_markdown(FILE *out);

#endif
