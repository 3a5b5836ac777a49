/* Warnings of a run: a list of lines, each included once, in the order of their first occurrence. */
#ifndef CLEAVE_WARNINGS
#define CLEAVE_WARNINGS

#include <stdio.h>

#include "archive.h"
#include "base.h"

/* A list of `n` different warnings, text[k] (k from 0) in the order of their first occurrence. The list owns the
 * texts. */
struct warnings {
    int n;
    bool silent; /* pilot run (a short run before the real one): warnings are stored, but not printed */
    char **text;
    /* Writes to place[PLACE_LENGTH] the location in the scene file of the key with which the warning `text` begins; ""
     * if unknown. The printed line ends with this location; `text` does not contain it. scene: the member below, not
     * owned. */
    void (*locate)(const void *scene, const char *text, char *place);
    const void *scene;
};

/* Appends a warning, composed from `format` as by printf, with `?` in place of control characters, to the list w unless
 * the list contains it already. Returns true if it was appended. */
bool warnings_add_if_new(struct warnings *w, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Appends the warnings of the list `source_list`, from number `first_warning` on, to the list w, except those that w
 * contains already. */
void warnings_append_missing_from_list(struct warnings *w, const struct warnings *source_list, int first_warning);

/* Prints the warnings of the list w, from number `first_warning` (from 0) on, to `out`, each as one line `warning:
 * text`. The line ends with the location in the input file, in brackets, if w->locate is set and finds the location. */
void warnings_print(const struct warnings *w, int first_warning, FILE *out);

/* Appends the warning `text` to the list w while a run is in progress. Prints it on standard error if the list did not
 * contain it yet and is not silent. */
void warnings_add_and_print(struct warnings *w, const char *text);

/* Prints the warnings of the list w, from number `first_warning` on, on standard error, unless the list is silent. */
void warnings_print_to_stderr(const struct warnings *w, int first_warning);

/* Saves the warnings of the list w to the archive `a` if a->saving, else appends those stored in `a` to w. Returns
 * FAILED if the archive cannot be read or written or its entries are inconsistent. */
status warnings_save_or_load(struct warnings *w, struct archive *a);

/* Releases all texts of the list w. */
void warnings_free(struct warnings *w);

#endif
