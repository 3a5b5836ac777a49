/* Declares the state of the reader of an Abaqus input deck (.inp file), and functions for its sets. A set of a part has
 * the name Part.Set and, once the part has an instance, Instance.Set; sets outside parts have their own name alone. */
#ifndef CLEAVE_ABAQUS_DECK
#define CLEAVE_ABAQUS_DECK

#include "abaqus_lines.h"
#include "elements.h"

/* A range of nodes and elements whose labels are unique: one part of the deck, or all that is outside parts. */
struct abaqus_label_scope {
    char name[FIELD], instance[FIELD];            /* name of the part; name of its instance */
    int64_t node, element, node_end, element_end; /* indices of the first and one past the last in the mesh */
    int set, set_end;                             /* the same of its sets */
    struct label_map node_of, element_of;         /* indices of labels, once the scope has ended */
    bool placed;                                  /* has an instance */
};

/* State of the reader of an Abaqus input deck, while it is read. s: text that is read; m: mesh under construction;
 * scope: [scopes] parts of the deck, entry 0 for all that is outside parts. */
struct abaqus_input_deck {
    struct geometry_file *s;
    struct element_mesh *m;
    struct abaqus_keyword key; /* the keyword read last */
    int scopes, now;           /* number of scopes, current scope; scope 0 is outside parts */
    struct abaqus_label_scope *scope;
    int64_t generated; /* members added by GENERATE or from other sets */
    int64_t length;    /* of the deck with the files that it includes so far [byte] */
    int depth;         /* number of files that are being read, each included by the one before */
    bool in_step;      /* between *STEP and *END STEP, whose loads are not read */
};

/* Finds or creates the set whose name is the value of the parameter `name` of the current keyword, and stores its index
 * in *set; -1 if the parameter is missing. The set belongs to the current part of the input deck d or, outside of
 * parts, to the whole deck. of_nodes: true for a set of nodes, false for a set of elements. Returns REFUSED, with a
 * message, if there are too many sets. */
status abaqus_find_or_create_set_named_by_parameter(struct abaqus_input_deck *d, const char *name, bool of_nodes,
                                                    int *set);

/* Returns the index of the part of deck d called `name` or, if `instance` is true, of the part of which an instance is
 * called `name`. Returns -1 if there is none. */
int abaqus_find_part_by_own_or_instance_name(const struct abaqus_input_deck *d, const char *name, bool instance);

/* Replaces labels by indices in the sets of the mesh of the input deck d: the labels added since the last call, which
 * belong to `scope`. (A scope is a part of the deck, or what is outside parts.) Removes labels that the scope does not
 * contain. */
void abaqus_replace_set_labels_by_indices(struct abaqus_input_deck *d, const struct abaqus_label_scope *scope);

/* Reads the set of *NSET or *ELSET in deck d: labels, names of other sets, or ranges. of_nodes: true for *NSET. Returns
 * REFUSED, with a message, for malformed lines, a set without name, an unknown set or an unknown instance. */
status abaqus_read_set(struct abaqus_input_deck *d, bool of_nodes);

/* Renames each set of `part`, a part of the Abaqus input deck d, from Set to Instance.Set, with the name of the
 * instance of the part. */
void abaqus_prefix_set_names_with_instance(struct abaqus_input_deck *d, const struct abaqus_label_scope *part);

#endif
