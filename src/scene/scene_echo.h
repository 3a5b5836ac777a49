/* What the files scene_echo*.c share: where the scene as run is written to, and values in the form of their keys. */
#ifndef CLEAVE_SCENE_ECHO
#define CLEAVE_SCENE_ECHO

#include <stdio.h>

#include "scene_internal.h"

struct writer {
    FILE *out;
    const struct scene *scene;
    int dim; /* of points: that of the scene, or 2 in an extrusion */
    int indent;
    bool dash; /* the next line begins an item of a list */
};

/* A key, and an item of a list before its first key. */
void begin(struct writer *w, const char *key);
void begin_item(struct writer *w);
void write_real(struct writer *w, real value);
void write_quoted(struct writer *w, const char *text);
void write_list(struct writer *w, const real *value, int n);
/* Writes the value of key k at `place` in the form of its type. */
void write_value(struct writer *w, const struct key *k, const void *place);
/* Value of a key in its group's struct; all keys of a group; a mapping of them below a key. */
const void *scene_echo_place_of(const struct key *k, const void *base);
void write_group(struct writer *w, const char *group, const void *base);
void write_part(struct writer *w, const char *key, const char *group, const void *base);
/* A file by its absolute path, so that the echo runs from any folder, and the checksum of its contents. */
void write_file_name(struct writer *w, const char *key, const char *file, uint64_t contents);
void write_boundaries(struct writer *w); /* scene_echo_loads.c */
/* A vector of numbers and formulas. */
void write_formulas(struct writer *w, const char *key, const real *value, const struct expression *formula);

/* A region as a list of solids, and those that have names (scene_echo_solids.c). */
void write_region(struct writer *w, const struct region *region);
void write_regions(struct writer *w);
/* A solid from a file: `stl: {..}` (scene_echo_shapes.c). */
void write_shape_file(struct writer *w, const struct solid *s);

#endif
