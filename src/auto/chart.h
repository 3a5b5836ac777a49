/* floor 4: the measured speed-accuracy chart, as `method: auto` reads it: error and time of runs of problems with known
 * solutions. `cleave bench accuracy` writes it (results/bench/chart.csv); src/auto/chart.csv, its copy, is part of the program.
 * One run a line; `keys`: scene keys that make the method, key=value;key=value, beside spacing, horizon and step. */
#ifndef CLEAVE_CHART_H
#define CLEAVE_CHART_H

#include "base/base.h"

#define CHART_HEADER "problem,case,method,resolution,horizon,step,error,seconds,particles,steps,keys"

enum { CHART_WORD = 40, CHART_KEYS = 160 };

struct chart_point {
    char problem[CHART_WORD], at[CHART_WORD], method[CHART_WORD];        /* at: its case                            */
    real resolution;                     /* as the problem counts                                                   */
    real horizon;                        /* [spacings]; 0: it has no bonds                                          */
    real step;                           /* share of the critical step                                              */
    real error, seconds;                 /* [1]; in the loop, on one thread                                         */
    real particles, steps;
    char keys[CHART_KEYS];
};
struct chart { int n; struct chart_point *point; };

/* `path` NULL: the chart of the program. REFUSED with a line that names file and line. */
status chart_read(struct chart *c, const char *path);
/* The same from text; `name` stands in messages. */
status chart_read_text(struct chart *c, const char *text, const char *name);
void chart_free(struct chart *c);

/* Value of a key in `keys`, copied into text; false: it is not there. */
bool chart_key(const struct chart_point *p, const char *key, char *text, size_t room);
/* Is that its value? */
bool chart_says(const struct chart_point *p, const char *key, const char *value);

#endif
