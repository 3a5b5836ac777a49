/* Room `scene`: what a user asks for, read and checked, and the particles that follow from it. It knows materials,
 * regions and loads, and what it asks of the parts of a run (requests.h); the parts, the engine, commands and benches
 * call it.
 *
 * A scene: everything a run needs, as read and checked, in SI units. Only scene_yaml.c uses libyaml (info.c reads
 * its version). */
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

/* FRAME_AUTO is a request that reading a scene resolves. METHOD_AUTO is a word of scene files alone: pilot runs replace
 * it (scene_read.h). SOLVER_STATIC is that of load steps. */
enum method { METHOD_PD, METHOD_MPM, METHOD_ADAPTIVE, METHOD_AUTO };
enum { FILL_AUTO, FILL_ALL, FILL_NEEDED }; /* mpm.fill */
enum { LEVELS_AUTO = 5 };                  /* mpm.levels: auto */
enum { FRAMES_MOST = 100000 };             /* of a run */
enum grid_frame { FRAME_CURRENT, FRAME_REFERENCE, FRAME_AUTO };
enum model { MODEL_BOND, MODEL_OSPD, MODEL_MOSPD };

enum solver_kind { SOLVER_EXPLICIT, SOLVER_RELAXATION, SOLVER_CG, SOLVER_STATIC };

/* Part of a body that is of another material. */
struct scene_part {
    struct region region;
    int material; /* index into scene.material */
};

struct scene_body {
    char name[NAME_MAX_LENGTH];
    int material; /* index into scene.material */
    int parts;
    struct scene_part *part;        /* later ones overwrite earlier ones, and `material` */
    struct region shape;            /* filled with a lattice ... */
    char *file;                     /* ... or a particle list (.csv, .h5), as to be opened; or NULL */
    uint64_t contents;              /* hash of that file; 0: not read */
    struct particle_list_head list; /* its columns */
    char place[PLACE_LENGTH];       /* in the scene, of its list if it has one */
    real velocity[DIM_MAX];         /* [m/s] */
    int joined;                     /* lowest number of the bodies that are one with it by interfaces */
    bool rigid;                     /* no particles: it has a shape that keeps its form ... */
    real mass, ramp;                /* ... flies with a mass [kg]; or is driven, fully from `ramp` on [s] */
    real force[DIM_MAX];            /* on one that flies [N] */
    enum grid_frame frame; /* mpm.frame unless it has its own; AUTO only where the scene allows the reference frame */
    const char *frame_reason; /* why AUTO became CURRENT; NULL: it did not */
};

/* What lies between two bodies. */
struct scene_interface {
    int body[2];
    bool joined;
    real energy_release_rate; /* 0: that of the weaker material [J/m^2] */
    real critical_stretch;    /* of it; 0: none [1] */
};

/* A region that the scene calls by name; where it is called it stands as a copy. */
struct named_region {
    char name[NAME_MAX_LENGTH];
    struct region region;
};

/* Initial state of the particles in a region; later entries overwrite earlier ones. */
struct scene_initial {
    char place[PLACE_LENGTH]; /* in the scene */
    struct region region;
    int body; /* -1: any */
    bool sets_velocity, sets_strain;
    real velocity[DIM_MAX];                        /* 1 beside a formula [m/s] */
    struct expression formula[DIM_MAX];            /* of a component of it in X; none: velocity */
    real velocity_gradient[DIM_MAX * DIM_MAX];     /* v += G (X - centre), row major dim x dim [1/s] */
    real displacement_gradient[DIM_MAX * DIM_MAX]; /* x = X + H (X - centre), stress = C : sym H [1] */
    real centre[DIM_MAX];                          /* [m] */
    bool sets_pulse;                               /* a plane longitudinal wave, added to what is there */
    struct wave_pulse pulse;
};

/* Frames of a region at a rate of their own. */
struct scene_series {
    char name[NAME_MAX_LENGTH];
    struct region region;
    real every;      /* time from frame to frame [s] */
    unsigned fields; /* bits of FRAME_FIELD_WORDS; 0: those of the scene */
};

/* Load steps of solver static (load_steps.c). */
enum steps_control { CONTROL_LOAD, CONTROL_ENERGY, CONTROL_OPENING };
enum steps_then { THEN_EQUILIBRIUM, THEN_EXPLICIT };
enum steps_path { PATH_AUTO, PATH_BONDS, PATH_HOOP };
struct scene_steps {
    int number;                 /* of steps: of the duration, or at the most */
    enum steps_control control; /* what a step goes by: pseudo-time, energy released, an opening */
    enum steps_path path;       /* what leads a crack: its most overloaded bonds, or its largest hoop stress */
    real energy;                /* of the bonds of an advance; 0: by toughness and spacing [J] */
    real from[DIM_MAX], to[DIM_MAX], opening; /* places whose distance is the opening, and how far it grows [m] */
    bool has_from, has_to;
    enum steps_then then; /* what follows an advance that another one follows at once */
    int breaks;           /* most pairs of bonds that break between two equilibria */
    real within;          /* those that break are overloaded like the first, up to this share [1] */
};

struct scene {
    char *path;                 /* file it came from, as given on the command line */
    char name[NAME_MAX_LENGTH]; /* default: the file's name without folder and ending */
    enum space space;
    int dim;
    real thickness;        /* 2D [m]; 1 in 3D */
    real section;          /* 1D: cross-section A [m^2]; key `section`, default 1 */
    real duration;         /* [s] */
    real gravity[DIM_MAX]; /* of particles and of rigid bodies that fly [m/s^2] */
    real damping;          /* of particles: force over momentum [1/s] */
    enum method method;
    enum model model;
    enum solver_kind solver;  /* other than explicit: static equilibrium (solver.h) */
    real solver_tolerance;    /* relative residual [1] */
    int solver_steps;         /* at the most */
    struct scene_steps steps; /* of solver static */

    int materials;
    struct material *material;
    int bodies;
    struct scene_body *body; /* deformable ones; behind them `rigids` rigid ones */
    int rigids;
    int interfaces;
    struct scene_interface *interface;

    int regions;
    struct named_region *named;
    struct shape_file *shapes; /* files that solids are made of (shape_file.h) */

    real spacing, horizon, irregularity; /* [m], in spacings, [1] */
    uint64_t seed;

    enum volume_rule volume;
    enum calibration calibration;
    enum surface_rule surface; /* resolved: never "auto" here */
    enum shell_rule shells;
    enum influence influence;   /* resolved */
    bool bulk;                  /* state-based: normalised as full families are */
    enum last_force last_force; /* of a bond in the step in which it breaks */
    enum contact_between contact_between;
    enum contact_form contact_form;
    enum contact_distance contact_distance;
    bool contact_convert;
    real contact_friction;  /* coefficient [1] */
    real contact_stiffness; /* in units of that of a cell [1] */
    bool has_pd_region;
    struct region pd_region; /* peridynamic from the start (adaptive) */

    real cell; /* grid node distance, in spacings */
    enum shape shape;
    enum transfer transfer;
    bool has_shape, has_transfer; /* to be written out: given, or the choice of frame does not depend on it */
    enum grid_frame frame;        /* of the grid, of bodies that do not say theirs */
    bool small_strain;            /* of a mesh in the reference frame */
    int levels;                   /* of its coarse cells; LEVELS_AUTO: as many as pay */
    int fill;                     /* which particles are made: FILL_AUTO .. */
    bool lattice_constants;       /* its elastic constants are those of the bonds' lattice */
    bool has_grid_origin;
    real grid_origin[DIM_MAX]; /* a node of the grid [m] */

    enum coupling coupling;
    real interface_damping;        /* of the interface zone (interface_zone.h), in c/h */
    bool has_interface_damping;    /* as has_shape */
    const char *current_frame_key; /* what the scene says that has a meaning in the current frame only; NULL: nothing */
    struct conversion_rule conversion;

    int cracks;
    struct crack *crack;
    int cracks_given; /* of these, which the file names; behind them slits of meshes */
    int growths;
    struct growth_rule *growth; /* cracks with prescribed or SIF-controlled growth */
    int initials;
    struct scene_initial *initial;
    int boundaries;
    struct boundary *boundary;
    int probes;
    struct probe_request *probe;

    real time_step;           /* [s]; 0: automatic */
    bool active_set;          /* what nothing has reached is skipped (active_set.h) */
    real safety;              /* of the automatic step */
    int frames;               /* frames after the one at t = 0 */
    bool has_frames;          /* the scene says how many */
    struct number_list times; /* of these frames, ascending [s]; none: evenly spread */
    real every;               /* time from frame to frame [s]; 0: not given */
    unsigned fields;          /* that they are asked for: bits of FRAME_FIELD_WORDS */
    int n_series;
    struct scene_series *series;
    int samples;              /* samples of history.csv after the one at t = 0 */
    real wall;                /* wall clock after which a process ends with a checkpoint; INFINITY [s] */
    real checkpoint_interval; /* wall clock between checkpoints [s] */
    bool compress;            /* gzip the frames */
    real speed_window;        /* of the crack tip's speed [s] */

    unsigned accept;   /* bits of ACCEPT_WORDS: unlikely figures that are meant */
    bool has_accept;   /* given */
    char renamed[400]; /* keys given by an earlier name; "" : none */
    char *text;        /* the scene as run: every key, defaults written out, YAML */
};

struct scene_override {
    const char *key, *value;
}; /* of `-s key=value` */

/* Does a run move in time? Else: one equilibrium, or load steps. */
static inline bool scene_moves(const struct scene *s) { return s->solver == SOLVER_EXPLICIT; }
static inline bool scene_at_rest(const struct scene *s)
{
    return s->solver == SOLVER_RELAXATION || s->solver == SOLVER_CG;
}
static inline bool scene_in_steps(const struct scene *s) { return s->solver == SOLVER_STATIC; }

/* Has a material, or an interface, a limit of its bonds? */
static inline bool scene_bonds_break(const struct scene *s)
{
    bool breaks = false;
    for (int m = 0; m < s->materials; m++) breaks |= isfinite(s->material[m].critical_stretch);
    for (int k = 0; k < s->interfaces; k++) breaks |= s->interface[k].critical_stretch > 0;
    return breaks;
}

/* Has a material bulk viscosity? */
static inline bool scene_viscous(const struct scene *s)
{
    bool viscous = false;
    for (int m = 0; m < s->materials; m++) viscous |= material_viscous(&s->material[m]);
    return viscous;
}

/* Does the strength of a material scatter from place to place? */
static inline bool scene_scatters(const struct scene *s)
{
    bool scatters = false;
    for (int m = 0; m < s->materials; m++) scatters |= s->material[m].scatter.given;
    return scatters;
}

/* Does a probe look at bonds that break? */
static inline bool scene_watches_bonds(const struct scene *s)
{
    static const bool watches[PROBES] = {
        [PROBE_TIP] = true, [PROBE_BREAK] = true, [PROBE_SPALL] = true, [PROBE_GROWTH] = true};
    bool any = false;
    for (int k = 0; k < s->probes; k++) any |= watches[s->probe[k].kind];
    return any;
}

/* Can faces come about: by cracks of the scene, their growth, bonds that break? */
static inline bool scene_cracks(const struct scene *s)
{
    return s->cracks > 0 || s->growths > 0 || scene_bonds_break(s);
}

/* Are there several bodies, those that are joined counted as one, or rigid ones? */
static inline bool scene_bodies_meet(const struct scene *s)
{
    bool several = s->rigids > 0;
    for (int b = 0; b < s->bodies; b++) several |= s->body[b].joined > 0;
    return several;
}

/* What a length (line), an area (plane) or a volume (solid) is multiplied with to be a volume: [m^2], [m], [1]. */
static inline real scene_section(const struct scene *s)
{
    return s->space == SPACE_LINE ? s->section : s->space == SPACE_SOLID ? 1 : s->thickness;
}

/* Material of the particle of a body at X [m], which the body or its list says is of `material`. */
int scene_material_at(const struct scene *s, const struct scene_body *b, const real *X, int material);
/* Can a particle of the body be of this material? */
bool scene_body_has(const struct scene_body *b, int material);

/* Frees what a scene holds; a scene is read by scene_read.h. */
void scene_free(struct scene *s);

/* Why a body cannot be in the reference frame whatever it does, and why `mpm.frame: auto` would not put it there of
 * its own; NULL: it can, it would. */
const char *scene_frame_unsupported(const struct scene *s, int body);
const char *scene_frame_not_default(const struct scene *s, int body);

/* Prints the table of keys: all of them (key NULL), those below a prefix, or one; REFUSED names the nearest key. */
status scene_help(FILE *out, const char *key);
/* Is it a key, or what several begin with? */
bool scene_has_key(const char *key);

/* Prints the units that numbers may carry. */
void scene_help_units(FILE *out);
/* Prints a JSON schema of scenes, for editors. */
status scene_schema(FILE *out);
/* Prints what expressions are made of. */
void scene_help_expressions(FILE *out);
/* Writes the keys for the manual page (troff); and, one a line, those that `-s` sets, 0 for the number of an item. */
void scene_manual_keys(FILE *out);
void scene_override_keys(FILE *out);

/* Writes the reference of all keys as a page of Markdown (inputs/keys.md): a table for each key of the scene that has
 * keys of its own, after one for those that have none. */
void scene_reference(FILE *out);

#endif
