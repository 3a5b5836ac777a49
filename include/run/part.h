/* Declares struct part, which describes one part of a run (contact, probes and others) by functions for the run as a
 * whole: state, output, warnings. The engine calls them in a loop over a table of all parts (engine/parts.c). Time
 * steps call the functions of a part directly by name (step.c). */
#ifndef CLEAVE_PART
#define CLEAVE_PART

#include <stddef.h>

#include "output/column.h"
#include "output/json.h"
#include "run/run.h"

/* Description of a part of a run, such as contact or probes: the functions that the engine calls for each part in turn.
 * Any of them may be NULL. */
struct part {
    const char *name;
    size_t at, size;               /* offset in struct run of the pointer to the part; size of the part [byte] */
    void (*free)(struct run *run); /* releases the arrays of the part, not the part */
    /* Saves or restores what steps have changed; what follows from the scene is rebuilt before. */
    status (*state)(struct run *run, struct archive *a);
    /* describes its columns of history.csv; column NULL: counts only; returns the number */
    int (*columns)(const struct run *run, struct column *column);
    void (*record)(struct run *run, real *value); /* writes their values at the time of a sample */
    /* warns of settings that are allowed but probably not intended */
    void (*warn)(const struct run *run, struct warnings *to);
    void (*summary)(const struct run *run, struct json *json); /* writes its results to summary.json */
};

/* Initialises the members `name`, `at` (offset) and `size` of a struct part, in an initialiser. member: member of
 * struct run that points to the part; type: name of the structure of the part, without `struct`. */
#define PART(member, type) .name = #member, .at = offsetof(struct run, member), .size = sizeof(struct type)

#endif
