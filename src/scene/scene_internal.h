/* Declares what the files scene*.c share: the tree of nodes with their line and column, the table of keys, and the
 * reader. */
#ifndef CLEAVE_SCENE_INTERNAL
#define CLEAVE_SCENE_INTERNAL

#include <string.h>

#include "base/edit_distance.h"
#include "data/expression.h"
#include "scene/scene.h"
#include "scene/units.h"
#include "scene/words.h"

/* Entry of a chain of named regions that are being read: the region `region`, and the region `outer` that refers to it
 * (NULL: none). Following `outer` shows whether a region contains itself. */
struct naming {
    const struct yaml_node *region;
    const struct naming *outer;
};

/* ---- nodes: YAML without types, every value is text until a key gives it a type (scene_nodes.c, scene_yaml.c) ---- */

/* Kinds of nodes: a single value, a list of nodes, a mapping of keys to nodes. */
enum node_kind { NODE_SCALAR, NODE_LIST, NODE_MAP };

/* A node of the YAML tree of an input file: a value, list or mapping with its location. Nodes and texts are in memory
 * of the reader (struct reader), which arena_free releases as a whole. */
struct yaml_node {
    enum node_kind kind;
    int line, column; /* location of the key, or of an item without a key; from 1 */
    int origin; /* where it was given: index of an override of the command line; -1: the scene file; -2, -3, ..: an
                   included file */
    int n;      /* number of entries of a list or map */
    char *key;  /* key of the node; NULL for the root and for items of a list */
    char *text; /* text of a scalar, without quotes; else "" */
    /* node that contains this node; first and last entry of a list or map; next entry of the parent; NULL: none */
    struct yaml_node *parent, *first, *last, *next;
};

struct arena_block;
struct variable;
struct key;

/* ORIGIN_INCLUDED: value of yaml_node.origin for nodes from the first included file. INCLUDED_MOST: largest number of
 * included files. */
enum { ORIGIN_INCLUDED = -2, INCLUDED_MOST = 64 };

/* Reader of one input file: its text tree, overrides of the command line, included files and variables, and the scene
 * (struct scene) that it fills. It exists only while the file is read. */
struct reader {
    const char *name;                      /* name of the scene file, for messages */
    const struct scene_override *override; /* [overrides] values of the command line that replace those of the file */
    int overrides;
    struct scene *scene;                 /* the scene that is being filled */
    const struct yaml_node *root;        /* tree of the scene */
    int dim;                             /* dimensions of points: dim of the scene, or 2 in an extrusion */
    bool bounded;                        /* solids being read belong to a body: no infinite bounds */
    bool cutting;                        /* these solids are cut out of the body: infinite bounds are allowed */
    int solids;                          /* number of solids read so far */
    int grey_materials;                  /* number of images whose `materials` are not yet parts of a body */
    bool files;                          /* check that particle lists exist */
    const char *included[INCLUDED_MOST]; /* [includes] names of the included files */
    int includes;
    struct variable *variable;        /* [variables] variables of the scene, in the arena */
    int variables, variables_open;    /* number of variables; number of those being evaluated */
    struct arena_block *arena;        /* memory of the nodes and texts of this reading */
    const struct yaml_node *regions;  /* mapping of the named regions; NULL: none */
    const struct yaml_node *sections; /* mapping of the named plane sections of extrusions; NULL: none */
    const struct naming *naming;      /* innermost named region that is being read; NULL: none */
    /* receives the largest spacing at which all strengths are valid (spacing_search_reduce_upper_bound_if_active) [m];
     * NULL: strengths that do not suit the spacing are refused */
    real *spacing_most;
};

/* Returns `byte_count` bytes of zeros in memory of the reader r, which arena_free releases as a whole. */
void *arena_allocate_zeroed(struct reader *r, size_t byte_count);

/* Returns a copy of the first `length` bytes of `text` with a final 0, in memory of the reader r that arena_free
 * releases. */
char *arena_copy_text(struct reader *r, const char *text, size_t length);

/* Releases the nodes and texts that arena_allocate_zeroed and arena_copy_text have allocated for the reader r, all at
 * once. */
void arena_free(struct reader *r);

/* Parses the YAML text text[length] to a tree of nodes in memory of the reader r and stores its root in *root; NULL if
 * the text contains no value. origin_index: index of the file or override from which the text is (see struct
 * yaml_node). Returns REFUSED, with a message, for invalid YAML, FAILED if there is no memory. */
status tree_parse_yaml(struct reader *r, const char *text, size_t length, int origin_index, struct yaml_node **root);

/* Appends the node `child` to the entries of the list or mapping `parent`, without a copy. */
void yaml_node_append(struct yaml_node *parent, struct yaml_node *child);

/* Returns the entry of the mapping `map` with the key `key`, a node of the tree; NULL if there is none, or if `map` is
 * NULL or no mapping. */
struct yaml_node *yaml_node_find(const struct yaml_node *map, const char *key);

/* Removes `child`, which must be one of the entries of the list or mapping `parent`, from these entries. The node is
 * not released: its memory belongs to the reader (arena_free). */
void yaml_node_remove(struct yaml_node *parent, struct yaml_node *child);

/* Reads the input files that the tree `root` includes and adds their keys to the tree; keys that the tree has itself
 * keep their values. r: reader of the input file. Returns REFUSED, with a message, for an invalid list of files or an
 * invalid file. */
status tree_merge_included_files(struct reader *r, struct yaml_node *root);

/* Returns true if the value of the key at `path` ("" for the whole input file) is a mapping that is merged key by key
 * with that of an included file. Other values, such as solids, replace the included value as a whole. */
bool key_is_mapping_merged_with_included_file(const char *path);

/* Applies r->override, all overrides of the command line that the reader r has, to the tree `root` of the input file.
 * Returns REFUSED, with a message, for an invalid one. */
status tree_apply_all_overrides(struct reader *r, struct yaml_node *root);

/* Replaces keys of earlier versions of Cleave in the tree `root` by their present names, and notes them in r->scene (r:
 * reader of the input file) for a warning. Returns REFUSED, with a message, if both names of a key are given, and for
 * keys that no longer exist. */
status tree_rename_old_keys(struct reader *r, struct yaml_node *root);

/* Returns the present name of the key `path` of an override. If `path` is a name of an earlier version of Cleave, notes
 * this in r->scene (r: reader of the input file) for a warning; otherwise returns `path` itself. */
const char *override_key_get_current_name(struct reader *r, const char *path);

/* Returns the present name of a key that had the name `former_path` in an earlier version of Cleave; NULL if there was
 * no such key. */
const char *former_key_get_current_name(const char *former_path);

/* Returns the name of the file from which a node was read; for an override it is the input file. origin_index: index of
 * the file or override, from the node (struct yaml_node). r: reader of the input file. */
const char *origin_file_name(const struct reader *r, int origin_index);

/* Returns the number of characters of the folder at the beginning of `path`, with its final slash; 0 if there is no
 * folder. */
int path_folder_length(const char *path);

/* Reads the whole file `path` into an allocated array *bytes of *length bytes, which the caller releases with
 * memory_free. Returns REFUSED, with a message, if it cannot be read. */
status file_read_bytes(const char *path, char **bytes, size_t *length);

/* Sets the key `key` in the tree `root` to `value`, in the manner of an override of the command line. An empty value
 * removes the key. r: reader of the input file. Returns REFUSED, with a message, for a malformed key, and if a key to
 * be removed is absent. */
status tree_apply_override(struct reader *r, struct yaml_node *root, const char *key, const char *value);

/* Returns the node at `path` (names of keys from the root on, joined by dots, without indices of lists); NULL if the
 * tree has no such node. */
const struct yaml_node *tree_find_node_by_path(const struct yaml_node *root, const char *path);

/* Parses the input file text[length], merges the files that it includes, applies overrides, and stores the tree in
 * *root, in memory of the reader r. Returns REFUSED, with a message, if the text is malformed or a file is missing. */
status scene_text_parse_with_includes_and_overrides(struct reader *r, const char *text, size_t length,
                                                    struct yaml_node **root);

/* Reads all keys of the tree `root` of an input file into r->scene (r: reader of the file) and checks them. Returns
 * REFUSED, with a message, if one is invalid. */
status scene_read_values_from_yaml_tree(struct reader *r, const struct yaml_node *root);

struct pilot_requirements;
/* Reads what an input file with `method: auto` requires of its pilot runs (short runs by which the method is chosen)
 * into *requirements, which the caller has set to zero. r, root: reader and tree of the input file; text[length]: its
 * text. Returns REFUSED, with a message, for an invalid file. */
status auto_method_pilot_run_requirements_read(struct reader *r, const struct yaml_node *root, const char *text,
                                               size_t length, struct pilot_requirements *requirements);

/* ---- numbers and units (scene_numbers.c, scene_units.c) ---------------------------------------------------------- */

/* Writes the number `value` into `text` with the fewest digits from which the same value, bit for bit, is read again.
 * Returns `text`. */
const char *number_write_shortest_exact_decimal(char text[32], real value);

/* A number with its unit, which is given by exponents of m, kg and s. */
struct quantity {
    real value;   /* [SI] */
    int twice[3]; /* twice the exponents of m, kg, s */
    bool bare;    /* the value has no unit in the text: it is taken as SI in every key */
};

/* Reads `text` of the form `number [/ number] [unit]`, with any unit, into *q (value in SI units, and exponents of m,
 * kg and s). Returns false if the text has another form. */
bool quantity_parse(struct quantity *q, const char *text);

/* Reads the number at the beginning of `text` into *q and, if read_unit is true, the unit that follows. Returns the
 * number of characters that were read. On failure returns 0 and stores a description of the fault in *fault_text. */
size_t quantity_read_at_start_of_text(struct quantity *q, const char *text, bool read_unit, const char **fault_text);

/* Sets *q to 1 in the unit whose symbol is at the beginning of `text`. Returns the length of the symbol; 0 if there is
 * none. */
size_t quantity_read_unit_symbol(struct quantity *q, const char *text);

/* Removes kelvin from the text of a unit of temperature or specific heat, such as kJ/(kg K) or kJ/kg/K, which becomes
 * kJ/kg. Writes the shortened text to shortened[capacity] and returns it. Returns `text` itself if there is no kelvin,
 * or if `kind_of_unit` is another kind of unit. (Kelvin is no symbol of its own, since variables may be called K.) */
const char *unit_text_remove_kelvin(const char *text, enum unit kind_of_unit, char *shortened, size_t capacity);

/* Returns true if q has a unit of the kind `kind_of_unit` or no unit. Otherwise returns false and writes the fault to
 * message[capacity], as the rest of a sentence that begins with the text of the value. */
bool quantity_unit_is_of_kind_or_absent(const struct quantity *q, enum unit kind_of_unit, char *message,
                                        size_t capacity);

/* Returns true if `value` [SI] is finite and inside the bounds of `kind_of_unit`. Otherwise returns false and writes
 * the fault to message[capacity], as the rest of a sentence that begins with the text of the value. */
bool value_is_in_unit_bounds(real value, enum unit kind_of_unit, char *message, size_t capacity);

/* Describes a unit for messages, as `a length`, or as `in m^2 s^-1` if its kind has no name, in text[capacity].
 * doubled_exponents: exponents of m, kg and s in the unit, multiplied by 2, so that those of square roots are whole
 * numbers. */
void unit_exponents_describe_kind_of_unit(const int doubled_exponents[3], char *text, size_t capacity);

/* Writes a unit in the form in which input files give it, such as ` m^2 s^-1`, to text[capacity]. doubled_exponents:
 * exponents of m, kg and s in the unit, multiplied by 2, so that those of square roots are whole numbers. */
void unit_exponents_write_as_text(const int doubled_exponents[3], char *text, size_t capacity);

/* ---- expressions (scene_expression.c) ---------------------------------------------------------------------------- */

/* Arguments that an expression may contain besides numbers and variables of the scene: x, y, z; t. */
enum { EXPRESS_SPACE = 1, EXPRESS_TIME = 2 };

/* Reads an expression in the unit of key k from node n, such as `12 MPa*exp(-(t/3us)^2)`, into *expression. A plain
 * number is allowed, too. allowed_variables: variables that are allowed in it, a sum of EXPRESS_*. Release `expression`
 * with expression_free. r: reader of the input file. Returns REFUSED, with a message of one line that states the
 * position of the fault in the text. */
status read_expression(struct reader *r, const struct key *k, const struct yaml_node *n, unsigned allowed_variables,
                       struct expression *expression);

/* Evaluates the expression `text`, which must not contain x, y, z or t, and stores its value and unit in *quantity. r:
 * reader of the input file. On failure returns false and writes the fault to message[capacity], as the rest of a
 * sentence that begins with `text`. */
bool quantity_evaluate_expression_text(struct reader *r, const char *text, struct quantity *quantity, char *message,
                                       size_t capacity);

/* Returns true if messages about `text` should call it an expression, not a number: it contains operators or brackets,
 * or begins with a name. r: reader of the input file. */
bool text_looks_like_expression(const struct reader *r, const char *text);

/* Returns true if `text` is x, y, z or t alone, the variables of formulas: a coordinate or the time. */
bool text_is_formula_variable(const char *text);

/* ---- variables (scene_number.c) ---------------------------------------------------------------------------------- */

/* Evaluates the variables of the input file with the tree `root` and stores them in its reader r. Returns REFUSED, with
 * a message, for an invalid variable, and for one that an override sets but no value uses. */
status read_and_evaluate_variables(struct reader *r, const struct yaml_node *root);

/* Returns the value of the variable `name`. r: reader of the input file. Returns NULL, and writes the fault to
 * message[capacity], if there is none of this name or it cannot be evaluated. */
const struct quantity *variable_get_value_by_name(struct reader *r, const char *name, char *message, size_t capacity);

/* Reads a number of an input file from `text` into *value [SI]. It may be a number with a unit, or an expression of
 * variables. kind_of_unit: expected kind of unit; allow_infinity: true if inf is allowed. r: reader of the input file.
 * On failure returns false and writes the fault to message[capacity], as the rest of a sentence that begins with
 * `text`. */
bool number_evaluate_text(struct reader *r, real *value, const char *text, enum unit kind_of_unit, bool allow_infinity,
                          char *message, size_t capacity);

/* Replaces the message message[capacity] about the invalid value `text` of key k by a more helpful one, if `text` is a
 * length although the value of the key is a number of spacings: the new message states the length in spacings. The
 * spacing of the input file must have been read. r: reader of the input file. */
void message_suggest_length_as_number_of_spacings(struct reader *r, const struct key *k, const char *text,
                                                  char *message, size_t capacity);

/* Returns the unit that is meant by the name `unknown_name` of an unknown unit, as text for a message, such as `us?`
 * for usec. Returns NULL for other names. */
const char *unknown_unit_name_suggest_known_unit(const char *unknown_name);

/* Returns the meaning of the word `word`, such as "a unit", for messages, if it is reserved in expressions and thus
 * cannot name a variable. Returns NULL for other words. */
const char *reserved_expression_word_get_meaning(const char *word);

/* ---- the table of keys (scene_keys.c) ---------------------------------------------------------------------------- */

/* Types of keys, which determine how a value is read, written and checked. */
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
    KEY_SERIES, /* the types up to here are read and written by the table alone */
    KEY_MAP,    /* mapping whose keys are read into the struct of this key      */
    KEY_PART,   /* mapping, read by a function                                  */
    KEY_LIST,   /* list of mappings, read by a function                         */
    KEY_HAND,   /* any other value, read by a function; `words`: its form       */
    KEY_GROUP   /* not a key: heads the keys of solids                          */
};

/* Allowed range of the value of a key, from `least` to `most`. open: `least` itself is excluded; given: the key has a
 * range. */
struct range {
    real least, most;
    bool open, given;
};

/* A row of the table of keys: a key that input files may contain, its type, unit and range, and where its value is
 * stored. */
struct key {
    const char *path; /* keys from the top of the scene, joined by dots */
    enum key_type type;
    enum unit unit;
    size_t place, size;   /* 1 + offset of the value in the structure of its group [byte], 0: not stored; size [byte] */
    struct range range;   /* allowed values of a number, or number of entries of a list */
    const char *fallback; /* default as text; "required"; "-": none; "(..)": description of a default that code sets */
    const char *help;     /* meaning, for `cleave help`; NULL: the key is no row of the table of keys */
    /* CHOICE: a|b|c in the order of the enum; REAL: word allowed; NAME: any text is one; HAND: form */
    const char *words;
    const char *low; /* message for a value below the range; NULL: the usual message */
    size_t has;      /* 1 + offset of the bool that is set if the key is given [byte]; 0: none */
    real word_value; /* REAL: value that the word in `words` stands for */
    bool infinite;   /* inf is allowed */
    bool of_process; /* limits the process, not the computation: the echo omits the key */
};
extern const struct key keys[];
extern const int keys_count;

/* Returns the last part of the path of key k, behind the last dot, as a pointer into the path. */
const char *key_get_last_name_of_path(const struct key *k);

/* Writes the meaning, type, range and default of key k to text[capacity]. */
void key_describe_meaning_and_type(const struct key *k, char *text, size_t capacity);

/* Returns true if k is the key `path`, or a key below it. Every key is below "". */
bool key_is_at_or_below_path(const struct key *k, const char *path);

/* Writes the type, SI unit, range or allowed words, and default of key k to text[capacity], in one line. */
void key_describe_type(const struct key *k, char *text, size_t capacity);

/* Returns true if key k is directly below the key `group_path` ("" for the top of an input file). */
bool key_is_directly_below(const struct key *k, const char *group_path);

/* Returns the path of the group in which the table has the keys of an item of list k: material for `materials`,
 * bodies.parts for `parts`, else the path of the list. */
const char *key_get_group_path_of_list_items(const struct key *k);

/* Writes an example of a value of key k for messages to text[capacity], such as [{from: [0.5 mm, 0]}]. dim: number of
 * components of points. subkey_to_show: name of a key below k that the example is to show, if k is a mapping or a list
 * of mappings; for NULL or any other name, the example shows a required key. */
void key_write_example(const struct key *k, int dim, const char *subkey_to_show, char *text, size_t capacity);

/* Writes an example of a vector of dim numbers, a value of key k, for messages to text[capacity], such as [0.5 mm, 0].
 * The components after the first are 0, or equal to the first if k has a range. first_number: text of the first
 * component; NULL for an example of a number of key k. */
void key_write_example_vector(const struct key *k, int dim, const char *first_number, char *text, size_t capacity);

/* Returns the key whose last part is `name_in_group` directly below the key `group_path` ("" for the top of an input
 * file); NULL if there is none. */
const struct key *key_find(const char *group_path, const char *name_in_group);

/* Returns the key directly below the key `group_path` ("" for the top of an input file) whose last part has the
 * smallest edit distance to `name_in_group`. */
const struct key *key_find_most_similar(const char *group_path, const char *name_in_group);

/* Returns a key whose last part is `key_name`, in any group; one at the top of an input file if there is one. Returns
 * NULL if there is none. Stores the number of keys with this last part in *matching_key_count. */
const struct key *key_find_in_any_group(const char *key_name, int *matching_key_count);

/* ---- words of other programs (scene_foreign.c) ------------------------------------------------------------------- */

/* Writes advice for `foreign_word`, a word of another program that is no key of `group` ("" for the top of an input
 * file) to text[capacity]: the equivalent key, or a note that Cleave has none. Returns false, and writes nothing, for
 * unknown words. */
bool other_program_keyword_write_advice(const char *foreign_word, const char *group, char *text, size_t capacity);

/* Returns advice, a static text, about the invalid value `foreign_value` of the key at `key_path`, if it is a word of
 * another program; else NULL. */
const char *other_program_value_get_advice(const char *key_path, const char *foreign_value);

/* Returns REFUSED, with a message, if text[length], the file of the reader r, is the input of Abaqus, LS-DYNA or
 * LAMMPS, a mesh of Gmsh or an STL file; OK if it may be an input file. Defined in scene_foreign_file.c. */
status other_program_file_refuse(struct reader *r, const char *text, size_t length);

/* Returns the keys that are equivalent to `foreign_word`, a word of another program, separated by spaces ("" if there
 * are none); NULL for unknown words. */
const char *other_program_keyword_get_equivalent_keys(const char *foreign_word);

/* ---- messages (scene_faults.c), forms (scene_expect.c, scene_unknown.c) and values (scene_value.c) --------------- */

/* Sets a message about node `at`, composed as by printf from `format`, and returns REFUSED. The message begins with
 * `file:line:column: key: `, or with `-s key=value: key: ` if an override gave the node. r: reader of the input file.
 */
status fault_report_at_node(const struct reader *r, const struct yaml_node *at, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Sets a message, composed as by printf from `format`, and returns REFUSED. The message begins with `file:line:column:
 * `, or with the text of the override. origin: file or override (see struct yaml_node); line, column: location in the
 * file. r: reader of the input file. */
status fault_report_at_location(const struct reader *r, int origin, int line, int column, const char *format, ...)
    __attribute__((format(printf, 5, 6)));

/* Writes a location to text[capacity]: file, line and column, or the text of the override that gives it. origin_index:
 * file or override (see struct yaml_node). r: reader of the input file. */
void location_write_text(const struct reader *r, int origin_index, int line, int column, char *text, size_t capacity);

/* Stores in r->scene (r: reader of the input file) where each key was given, for keys up to two levels below `root`, so
 * that later messages (scene_prepend_location_to_error_message) can state the location. */
void scene_store_key_locations(const struct reader *r, const struct yaml_node *root);

/* Writes the text with which messages about node `node` begin, its location and key, to text[capacity]. It is for
 * messages that are composed after the input file has been read. r: reader of the input file. */
void location_write_text_of_node(const struct reader *r, const struct yaml_node *node, char *text, size_t capacity);

/* Returns REFUSED with the message that the required key k is missing in `map`. r: reader of the input file. */
status fault_report_missing_key(struct reader *r, const struct yaml_node *map, const struct key *k);

/* Returns REFUSED with the message that the keys of the nodes `one` and `other` exclude each other. The message gives
 * the location of the key that was set last: by an override, else in the input file. r: reader of the input file. */
status fault_report_exclusive_keys(const struct reader *r, const struct yaml_node *one, const struct yaml_node *other);

/* Returns REFUSED, with a message, if an entry of the mapping `map` before its entry n has the key of n. r: reader of
 * the input file. */
status check_key_given_once(const struct reader *r, const struct yaml_node *map, const struct yaml_node *n);

/* Returns the value of node n as one short, printable line for messages. The text is static or in memory of the reader
 * r, which arena_free releases. */
const char *node_value_to_text_for_message(struct reader *r, const struct yaml_node *n);

/* Returns `text` as one short, printable line for messages, in memory of the reader r that arena_free releases. */
const char *text_to_printable_line_for_message(struct reader *r, const char *text);

/* Returns the list of words `words`, of the form a|b|c, as the text `a, b or c` for a message, in memory of the reader
 * r that arena_free releases. */
const char *allowed_words_join_for_message(struct reader *r, const char *words);

/* Returns REFUSED, with a message, if a key of the mapping `mapping` is unknown in the group `group_path` or occurs
 * twice; else OK. r: reader of the input file. */
status check_mapping_keys_known_and_unique(struct reader *r, const struct yaml_node *mapping, const char *group_path);

/* Returns REFUSED if keys of the input file with the reader r and the tree `root` are not in the table of keys, with a
 * message of one line for each of the first ten of them; else OK. Does not check names that the user chooses, such as
 * those of variables. */
status check_all_keys_known(const struct reader *r, const struct yaml_node *root);

/* Returns REFUSED, with a message that has an example, if node n is no mapping; else OK. group_path: path of its keys
 * in the table. r: reader of the input file. */
status check_node_is_mapping(struct reader *r, const struct yaml_node *n, const char *group_path);

/* Returns REFUSED if node n is not of the kind `kind`, with a message of the form "... is not allowed here; ADVICE";
 * else OK. advice: what to give instead, such as "give a list". r: reader of the input file. */
status check_node_kind(struct reader *r, const struct yaml_node *n, enum node_kind kind, const char *advice);

/* Reads all keys of the group `group_path` that need no function of their own into the structure `group_values`.
 * mapping: mapping with the keys, or NULL to store the defaults only; location_node: node at whose location missing
 * keys are reported. r: reader of the input file. Returns REFUSED, with a message, for a missing key or an invalid
 * value. */
status read_keys_of_group(struct reader *r, const struct yaml_node *location_node, const struct yaml_node *mapping,
                          const char *group_path, void *group_values);

/* Reads the value of key k from node n into `group_values`, the structure of its group, as the table of keys describes
 * it. r: reader of the input file. Returns REFUSED, with a message, for an invalid value. */
status read_value_of_key(struct reader *r, const struct key *k, const struct yaml_node *n, void *group_values);

/* Reads a number in the unit and range of key k from node n into *value [SI]. r: reader of the input file. Returns
 * REFUSED, with a message, for an invalid value. */
status read_number(struct reader *r, const struct key *k, const struct yaml_node *n, real *value);

/* Reads a point or vector in the unit and range of key k from node n into point[r->dim] [SI]. r: reader of the input
 * file. Returns REFUSED, with a message, for an invalid value. */
status read_point_or_vector(struct reader *r, const struct key *k, const struct yaml_node *n, real *point);

/* Returns, as words for messages, the space whose dimensions points must have where the reader r is at present: that of
 * the input file, such as `space plane stress`, or `the plane of extrude` inside the section of an extruded solid. */
const char *reader_get_expected_point_space_as_text(const struct reader *r);

/* Returns REFUSED, with a message that has an example of a value of key k, if node n is no list; else OK. r: reader of
 * the input file. */
status check_node_is_list(struct reader *r, const struct key *k, const struct yaml_node *n);

/* Returns REFUSED, with a message, if node n is no list, or if the number of its items is outside the range of key k.
 * r: reader of the input file. */
status check_node_is_list_of_valid_length(struct reader *r, const struct key *k, const struct yaml_node *n);

/* Reads a file name from node name_node: searches the folder of the input file, then the current folder. Stores the
 * path in *path and a hash of the contents of the file in *contents_hash. r: reader of the input file. The caller
 * releases *path with memory_free. file_kind: kind of file, for messages. If r->files is false, copies the name without
 * opening the file. Returns REFUSED, with a message, if the file cannot be read. */
status read_input_file_path(struct reader *r, const struct yaml_node *name_node, const char *file_kind, char **path,
                            uint64_t *contents_hash);

/* Words by which an input file names the values of enum space, in the order of that enum. */
extern const char *const space_names[];
/* Words by which an input file names the values of enum probe_kind, in the order of that enum. */
extern const char *const probe_names[PROBES];

#endif
