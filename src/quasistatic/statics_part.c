/* Load steps, as a part of a run. */
#include "statics_internal.h"
#include "run/part.h"

static void statics_free_all(struct run *e) { statics_free(e), led_free(&e->statics->led); }

const struct part part_statics = {PART(statics, statics), .free = statics_free_all, .columns = statics_columns,
                                  .record = statics_record};
