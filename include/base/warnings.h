/* What a run has to say that is no error: a list of lines, each said once, in the order in which they came. */
#ifndef CLEAVE_WARNINGS
#define CLEAVE_WARNINGS

#include <stdio.h>

#include "archive.h"
#include "base.h"

struct warnings {
    int n;
    bool silent; /* a run on trial: warnings are stored and not printed while it runs */
    char **text;
};

/* One more, unless it is there. True: it is new. */
bool warnings_add(struct warnings *w, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Adds those of another list from number `first` on. */
void warnings_join(struct warnings *w, const struct warnings *from, int first);
/* From the `first` on, a line each: `warning: text`. */
void warnings_print(const struct warnings *w, int first, FILE *out);
/* Adds a warning of a running run and, if it is new and the list is not silent, prints it on standard error. */
void warnings_say(struct warnings *w, const char *text);
/* Prints the warnings from number `first` on, on standard error, unless the list is silent. */
void warnings_print_new(const struct warnings *w, int first);
/* Those read back join those that are there. */
status warnings_archive(struct warnings *w, struct archive *a);
void warnings_free(struct warnings *w);

#endif
