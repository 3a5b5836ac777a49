/* Bookkeeping of the parts of a run. What a part does in a step is called by name (step.c); what each of them has to
 * do for a run as a whole stands in a row here, and the engine's table of parts (engine/parts.c) goes through the rows.
 */
#ifndef CLEAVE_PART
#define CLEAVE_PART

#include <stddef.h>

#include "output/column.h"
#include "output/json.h"
#include "run/run.h"

/* Any function may be NULL. */
struct part {
    const char *name;
    size_t at, size;               /* of its pointer in struct run; of what that points to [byte] */
    void (*free)(struct run *run); /* what it owns, but not itself */
    /* saves or restores what steps have changed; what follows from the scene is made anew before */
    status (*state)(struct run *run, struct archive *a);
    int (*columns)(const struct run *run, struct column *column); /* of history.csv; column NULL: only how many */
    void (*record)(struct run *run, real *value);                 /* their values, at the time of a sample */
    void (*warn)(const struct run *run, struct warnings *to);     /* of what is allowed but probably not meant */
    void (*summary)(const struct run *run, struct json *json);    /* its figures in summary.json */
};

/* Place and size of a part: the member of struct run, and the type that it points to. */
#define PART(member, type) .name = #member, .at = offsetof(struct run, member), .size = sizeof(struct type)

#endif
