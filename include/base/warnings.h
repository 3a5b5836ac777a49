/* Warnings of a run: a list of lines, each included once, in the order of their first occurrence. */
#ifndef CLEAVE_WARNINGS
#define CLEAVE_WARNINGS

#include <stdio.h>

#include "archive.h"
#include "base.h"

/* The list; texts are owned. */
struct warnings {
    int n;
    bool silent; /* pilot run: warnings are stored, but not printed while it runs */
    char **text;
};

/* Adds a warning, unless it is already in the list. Returns true if it is new. */
bool warnings_add(struct warnings *w, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Adds the warnings of another list from number `first` on. */
void warnings_append_from(struct warnings *w, const struct warnings *from, int first);

/* Prints the warnings from number `first` on, one line each: `warning: text`. */
void warnings_print(const struct warnings *w, int first, FILE *out);

/* Adds a warning of a running run and, if it is new and the list is not silent, prints it on standard error. */
void warnings_add_and_print(struct warnings *w, const char *text);

/* Prints the warnings from number `first` on, on standard error, unless the list is silent. */
void warnings_print_new(const struct warnings *w, int first);

/* Saves or restores the warnings; restored ones are added to the list. */
status warnings_archive(struct warnings *w, struct archive *a);

/* Releases all texts. */
void warnings_free(struct warnings *w);

#endif
