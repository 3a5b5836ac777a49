/* The measured cost-accuracy table, read by `method: auto`: error and time of runs of problems with known solutions.
 * `cleave bench accuracy` writes it (results/bench/cost_accuracy.csv); its copy bench/accuracy/cost_accuracy.csv is
 * part of the program. One run per line; `keys`: scene keys that make the method, key=value;key=value, beside spacing,
 * horizon and step. */
#ifndef CLEAVE_COST_ACCURACY
#define CLEAVE_COST_ACCURACY

#include "base/base.h"

#define TABLE_HEADER "problem,case,method,resolution,horizon,step,error,seconds,particles,steps,keys"

enum { TABLE_WORD = 40, TABLE_KEYS = 160 };

struct cost_point {
    char problem[TABLE_WORD], at[TABLE_WORD], method[TABLE_WORD]; /* at: its case */
    real resolution;                     /* in the unit of the problem */
    real horizon;                        /* [spacings]; 0: no bonds */
    real step;                           /* share of the critical step */
    real error, seconds;                 /* [1]; of the step loop on one thread [s] */
    real particles, steps;
    char keys[TABLE_KEYS];
};
struct cost_accuracy { int n; struct cost_point *point; };

/* Reads the table from a file; `path` NULL: the table of the program. REFUSED with file and line in the message. */
status cost_accuracy_read(struct cost_accuracy *c, const char *path);
/* Reads the table from text; `name`: its name in messages. */
status cost_accuracy_read_text(struct cost_accuracy *c, const char *text, const char *name);
void cost_accuracy_free(struct cost_accuracy *c);

/* Value of a key in `keys`, copied into text; false: it is not there. */
bool cost_accuracy_key(const struct cost_point *p, const char *key, char *text, size_t room);
/* True if the key has this value. */
bool cost_point_has(const struct cost_point *p, const char *key, const char *value);

#endif
