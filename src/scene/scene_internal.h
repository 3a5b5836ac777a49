/* Shared by the files scene*.c: the tree of nodes with their line and column, the table of keys, and the reader. */
#ifndef CLEAVE_SCENE_INTERNAL
#define CLEAVE_SCENE_INTERNAL

#include "base/edit_distance.h"
#include "data/expression.h"
#include "scene/scene.h"
#include "scene/units.h"

/* A region that is being read by its name, and the one that asked for it. */
struct naming {
    const struct node *region;
    const struct naming *outer;
};

/* ---- nodes: YAML without types, every value is text until a key gives it a type (scene_yaml.c) ------------------- */

enum node_kind { NODE_SCALAR, NODE_LIST, NODE_MAP };

struct node {
    enum node_kind kind;
    int line, column; /* of the key, or of an item without a key; from 1 */
    int origin;       /* number of the override it came from; -1: the file; -2, -3, ..: one that it
                         includes */
    int n;            /* entries of a list or map */
    char *key;        /* NULL: the root or an item of a list */
    char *text;       /* of a scalar, without quotes; else "" */
    struct node *parent, *first, *last, *next;
};

struct arena_block;
struct variable;
struct key;

enum { ORIGIN_INCLUDED = -2, INCLUDED_MOST = 64 };

struct reader {
    const char *name; /* of the file, for messages */
    const struct scene_override *override;
    int overrides;
    struct scene *scene; /* being filled */
    int dim;
    bool bounded;                        /* solids being read belong to a body: no infinite bounds */
    bool cutting;                        /* ... and take something away from it: they may be infinite */
    int solids;                          /* number of those read */
    int grey_materials;                  /* images whose `materials` have not become parts of a body yet */
    bool files;                          /* check that particle lists exist */
    const char *included[INCLUDED_MOST]; /* names of the files that it includes */
    int includes;
    struct variable *variable;     /* of the scene, in the arena */
    int variables, variables_open; /* how many; how many are being evaluated */
    struct arena_block *arena;     /* nodes and texts of this reading */
    const struct node *regions;    /* by name; NULL: none */
    const struct node *sections;   /* likewise, of the plane, which extrusions in space call */
    const struct naming *naming;   /* names of regions within whose reading this one is; NULL: none */
};

/* Memory that lasts until arena_free, zeroed. */
void *arena_new(struct reader *r, size_t size);
char *arena_text(struct reader *r, const char *text, size_t length);
void arena_free(struct reader *r);

/* Text to nodes. `origin` as in struct node. *root is NULL if the text holds no value. */
status tree_read(struct reader *r, const char *text, size_t length, int origin, struct node **root);
void node_append(struct node *parent, struct node *child);
struct node *node_find(const struct node *map, const char *key);
void node_remove(struct node *parent, struct node *child);
/* Reads the files that the tree includes, and lays it over them (scene_include.c). */
status tree_include(struct reader *r, struct node *root);
/* Is the value of this key, or the whole scene (""), a mapping of keys that each have a meaning of their own? Others,
 * such as solids, are words with what belongs to them, and are replaced as a whole. */
bool group_is_merged(const char *path);
/* Lays the overrides over the tree (scene_override.c). */
status tree_override(struct reader *r, struct node *root);
/* Gives keys of an earlier version their name of now, in the tree or in the path of an override (scene_renamed.c); the
 * scene keeps a note of them. REFUSED where both names are given, and for keys that no longer exist. */
status tree_rename(struct reader *r, struct node *root);
const char *path_renamed(struct reader *r, const char *path);
/* The present name of a key of an earlier version; NULL: it is none. */
const char *path_now(const char *path);
/* The file that a node came from; that of the scene for an override. How much of a path is its folder (scene_files.c).
 */
const char *file_of(const struct reader *r, int origin);
int folder_length(const char *path);
/* The bytes of a scene's file; freed with memory_free. */
status file_bytes(const char *path, char **bytes, size_t *length);
/* Applies one more override, as from the command line. An empty value removes the key; REFUSED if it is not there. */
status tree_set(struct reader *r, struct node *root, const char *key, const char *value);
/* The node at a path of keys without lists; NULL: the scene does not give it. */
const struct node *tree_at(const struct node *root, const char *path);
/* scene_tree: the tree of nodes from the text and the overrides. scene_from_tree: r->scene from this tree (scene.c). */
status scene_tree(struct reader *r, const char *text, size_t length, struct node **root);
status scene_from_tree(struct reader *r, const struct node *root);
/* Reads what a scene with `method: auto` requires of pilot runs, its tree and its text given (scene_wish.c). w is
 * zeroed by the caller. */
struct pilot_wish;
status wish_read(struct reader *r, const struct node *root, const char *text, size_t length, struct pilot_wish *w);

/* ---- numbers and units (scene_units.c) --------------------------------------------------------------------------- */

/* The shortest text that reads back to identical bits. */
const char *number_text(char text[32], real value);

/* A number [SI] with twice the powers of m, kg, s; bare: made of numbers without units, which are SI in every key. */
struct quantity {
    real value;
    int twice[3];
    bool bare;
};
/* Reads what number_read does, in any unit; false: it is nothing of the kind. */
bool number_quantity(struct quantity *q, const char *text);
/* Length of the number that a text begins with, and (with_unit) of the unit behind it; 0 with what is *wrong. */
size_t quantity_read(struct quantity *q, const char *text, bool with_unit, const char **wrong);
/* Length of the symbol of a unit that a text begins with, which is 1 of it. */
size_t quantity_unit(struct quantity *q, const char *text);
/* False with the rest of a sentence in `what`, as number_read: it is not what a key of this unit expects; its value is
 * not finite or out of bounds. */
bool quantity_fits(const struct quantity *q, enum unit unit, char *what, size_t room);
bool quantity_bounded(real value, enum unit unit, char *what, size_t room);
/* `a length`, or `in m^2 s^-1` where that has no name; and as a unit that reads back. */
void quantity_name(const int twice[3], char *text, size_t room);
void unit_text(const int twice[3], char *text, size_t room);

/* ---- expressions (scene_expression.c) ---------------------------------------------------------------------------- */

/* What an expression may contain besides numbers and variables of the scene. */
enum { EXPRESS_SPACE = 1, EXPRESS_TIME = 2 };
/* Reads an expression with the unit of k, of x, y, z and t as `of` allows: `12 MPa*exp(-(t/3us)^2)`. A number is one,
 * too. REFUSED in one line with the place in it. Freed with expression_free; its text is what the echo writes. */
status read_expression(struct reader *r, const struct key *k, const struct node *n, unsigned of, struct expression *e);
/* The value of an expression without x, y, z, t, with its unit. False with a complaint as number_read. */
bool quantity_of_text(struct reader *r, const char *text, struct quantity *q, char *what, size_t room);
/* Does a complaint about this text speak of an expression, not of a number? */
bool looks_like_expression(const struct reader *r, const char *text);

/* ---- variables (scene_number.c) ---------------------------------------------------------------------------------- */

/* Evaluates the variables of a scene. REFUSED for those that are wrong, or that an override sets and nothing contains.
 */
status read_variables(struct reader *r, const struct node *root);
/* The variable of this name; NULL with a complaint, if there is none, or what it depends on is wrong. */
const struct quantity *variable_value(struct reader *r, const char *name, char *what, size_t room);
/* A number of a scene: a plain one as number_read, or an expression of variables. False with a complaint. */
bool number_of_text(struct reader *r, real *value, const char *text, enum unit unit, bool infinite, char *what,
                    size_t room);
/* True for words that mean something in expressions, and cannot be variables: `is`, completed. */
const char *reserved_word(const char *name);

/* ---- the table of keys (scene_keys.c) ---------------------------------------------------------------------------- */

enum key_type {
    KEY_REAL,
    KEY_INT,
    KEY_SEED,
    KEY_FLAG,
    KEY_CHOICE,
    KEY_NAME,
    KEY_POINT,
    KEY_MATRIX,
    KEY_REGION,
    KEY_BODY,
    KEY_MATERIAL,
    KEY_SET,
    KEY_SERIES, /* read and written by the table alone                       */
    KEY_MAP,    /* its keys are read into the same struct                    */
    KEY_PART,
    KEY_LIST, /* a mapping, a list of mappings: read by a function         */
    KEY_HAND, /* any other value, read by a function; `words`: its form */
    KEY_GROUP /* not a key: heads the keys of solids                       */
};

struct range {
    real least, most;
    bool open, given;
}; /* open: least itself is outside */

struct key {
    const char *path;
    enum key_type type;
    enum unit unit;
    size_t place, size; /* 1 + offset in its group's struct and bytes; 0: no place */
    struct range range;
    const char *fallback; /* as text; "required"; "-": none; "(..)": explained, set by code */
    const char *help;
    /* CHOICE: a|b|c in the order of the enum; REAL: word allowed; NAME: any text is one; HAND: form */
    const char *words;
    const char *low; /* complaint about a value below the range */
    size_t has;      /* 1 + offset of the bool that is set if the key is given */
    real word_value; /* REAL: value of the word */
    bool infinite;   /* inf is allowed */
    bool of_process; /* limits a process, not what it computes: no part of the echo */
};
extern const struct key keys[];
extern const int keys_count;

const char *key_leaf(const struct key *k);
/* What a key is for, its type, range and default (scene_help.c). */
void key_description(const struct key *k, char *text, size_t room);
/* Writes type, SI unit, range or words, and default of k to text[room], in one line. */
void key_facts(const struct key *k, char *text, size_t room);
/* True if k is directly below `group` ("" for the top). */
bool key_in(const struct key *k, const char *group);
const struct key *key_find(const char *group, const char *leaf);
const struct key *key_nearest(const char *group, const char *leaf);

/* ---- words of other programs (scene_foreign.c) ------------------------------------------------------------------- */

/* Writes what takes the place of a word that is no key of `group` ("" for the top): a key, or what Cleave does not do.
 * Returns false, and writes nothing, for words that are not known. */
bool foreign_text(const char *word, const char *group, char *text, size_t room);

/* Returns the keys that concern such a word, separated by spaces, perhaps none; NULL for words that are not known. */
const char *foreign_paths(const char *word);

/* ---- values (scene_value.c) -------------------------------------------------------------------------------------- */

/* REFUSED with `file:line:column: key: ...` or `-s key=value: key: ...`. */
status fault(const struct reader *r, const struct node *at, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
status fault_mark(const struct reader *r, int origin, int line, int column, const char *format, ...)
    __attribute__((format(printf, 5, 6)));
/* The text with which fault begins a message, for messages made after the reading. */
void fault_place(const struct reader *r, const struct node *at, char *text, size_t room);
status fault_missing(struct reader *r, const struct node *map, const struct key *k);
/* REFUSED for two keys that exclude each other; the message is placed at the key of an override before that of the
 * file. */
status fault_both(const struct reader *r, const struct node *a, const struct node *b);
/* The value in the form of messages: one line, short, printable. */
const char *shown(struct reader *r, const struct node *n);
const char *shown_text(struct reader *r, const char *text);
/* A choice's words as `a, b or c`. */
const char *word_list(struct reader *r, const char *words);
/* Position of text in a|b|c, -1 if it is not there. */
int word_index(const char *words, const char *text);

/* REFUSED for keys of `map` that are unknown in `group` or given twice. */
status check_keys(struct reader *r, const struct node *map, const char *group);
/* REFUSED if n is not of this kind; `what` completes the sentence "... is not ". */
status expect(struct reader *r, const struct node *n, enum node_kind kind, const char *what);
/* Reads all keys of a group that the table alone can read into the struct `base`. `map` NULL: defaults only; missing
 * keys are reported at `where`. */
status read_group(struct reader *r, const struct node *where, const struct node *map, const char *group, void *base);
status read_key(struct reader *r, const struct key *k, const struct node *n, void *base);
status read_number(struct reader *r, const struct key *k, const struct node *n, real *value);
status read_point(struct reader *r, const struct key *k, const struct node *n, real *point);
/* Where points being read lie, in words. */
const char *space_shown(const struct reader *r);

/* REFUSED if n is not a list with as many items as the range of k allows. */
status expect_list(struct reader *r, const struct key *k, const struct node *n);

/* Path of a file, sought in the folder of the scene, then in the current folder, and the checksum of its contents;
 * `what` it is. A reader without `files` takes the name as it stands, unseen (scene_files.c). */
status read_path(struct reader *r, const struct node *n, const char *what, char **path, uint64_t *contents);

/* ---- parts (scene_solids.c, scene_parts.c, scene_loads.c) -------------------------------------------------------- */

status read_region(struct reader *r, const struct node *n, struct region *region);
/* The regions of the scene that have names; read_region reads those that its solids call. */
status read_regions(struct reader *r, const struct node *root);
/* Moves, turns and repeats a solid by the keys of `n` beside its own (scene_motions.c). */
/* Solids from files (scene_shapes.c), and the parts of a body that `materials` of the images of its shape are. */
status read_stl(struct reader *r, const struct node *n, struct solid *s);
status read_mesh(struct reader *r, const struct node *n, struct solid *s);
status read_image(struct reader *r, const struct node *n, struct solid *s);
status read_grey_parts(struct reader *r, const struct node *shape, struct scene_body *b);
bool is_motion(const struct node *n);
status read_motions(struct reader *r, const struct node *n, struct solid *s);
status read_materials(struct reader *r, const struct node *root);
status read_bodies(struct reader *r, const struct node *root);
/* `list`: of key k, NULL: not given (scene_body_parts.c). */
status read_body_parts(struct reader *r, const struct node *list, const struct key *k, struct scene_body *b);
status read_cracks(struct reader *r, const struct node *root);
status read_growths(struct reader *r, const struct node *root);
status read_initials(struct reader *r, const struct node *root);
/* The function of time of a boundary; n NULL or `constant`: 1 (scene_time.c). */
status read_time(struct reader *r, const struct node *n, struct boundary *b);
/* Reads the axis of a rotation, `n` the mapping with it: z in the plane (scene_loads.c). */
status read_axis_of(struct reader *r, const struct node *n, const char *group, real *axis);
/* Reads the components of a vector, value [dim]: numbers, or formulas of x, y, z and what else is in `of`, beside which
 * the value is 1 (scene_loads.c). */
status read_formulas(struct reader *r, const struct key *k, const struct node *n, unsigned of, real *value,
                     struct expression *formula);
status read_boundaries(struct reader *r, const struct node *root);
status read_probes(struct reader *r, const struct node *root);
status read_frame_regions(struct reader *r, const struct node *root);
/* Conditions on several keys without lists, and defaults (scene_check.c). check_size and check_solver: the same for the
 * number of particles of the bodies, and for the static solvers, after these are read. */
status check_scene(struct reader *r, const struct node *root);
/* Default share of the critical step, by whether bonds may break; after the materials are read. */
void resolve_safety(struct reader *r, const struct node *root);
status resolve_contact(struct reader *r, const struct node *root); /* what meets, where the scene does not say */
status check_size(struct reader *r, const struct node *root);
status read_interfaces(struct reader *r, const struct node *root);
status check_joined(struct reader *r, const struct node *root);
/* Critical stretch of a material with an energy release rate, in this scene. */
real scene_critical_stretch(const struct scene *s, const struct material *m);
status check_friction(struct reader *r, const struct node *root);
status check_absorbing(struct reader *r, const struct node *root);
status check_bearing(struct reader *r, const struct node *root);
/* Resolves frames left at auto; after the bodies are read. */
void resolve_frames(struct scene *s);
/* Surfaces of bodies again once they are known: those of lists need not be lattices. */
void resolve_lists(struct reader *r, const struct node *root);
status check_solver(struct reader *r, const struct node *root);
/* scene_steps.c: conditions on load steps; REFUSED for keys of them in other scenes. */
status check_load_steps(struct reader *r, const struct node *root);
status check_steps_given(struct reader *r, const struct node *root);

/* The words of enum space and enum probe_kind. */
extern const char *const space_names[];
extern const char *const probe_names[PROBES];

/* The scene as run (scene_echo.c); freed with memory_free. NULL: no memory. */
char *scene_echo(const struct scene *s);

#endif
