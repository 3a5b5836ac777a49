/* Collects the warnings in the summaries of the runs of a study. */
#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "output/output_files.h"
#include "output/summary_read.h"
#include "study/study.h"

/* WARNING_ROOM: capacity of the text of a warning [byte]. KINDS_MOST: largest number of kinds of warnings that are
 * counted. */
enum { WARNING_ROOM = 1024, KINDS_MOST = 64 };

/* A kind of warning: texts that differ only in their numbers, because runs with different spacings print different
 * numbers. text: the first of these texts. */
struct warning_kind {
    char text[WARNING_ROOM];
    int runs, last; /* number of runs that have it; index of the last one */
    bool differs;   /* the numbers of later texts differ from those of the first */
};

/* Returns true if the texts a and b of two warnings are equal or differ only in their numbers. */
static bool is_alike(const char *a, const char *b)
{
    static const char number[] = "0123456789.+-e";
    while (*a && *b) {
        const bool numbers = isdigit((unsigned char)*a) && isdigit((unsigned char)*b);
        if (!numbers && *a != *b) return false;
        a += numbers ? strspn(a, number) : 1;
        b += numbers ? strspn(b, number) : 1;
    }
    return *a == *b;
}

/* Counts the warning `text` of run number `run` in the list kind[*kinds]. Warnings that differ only in numbers are of
 * one kind, which counts once per run. A new kind is appended; it is ignored if there are already KINDS_MOST. */
static void warning_book(struct warning_kind *kind, int *kinds, const char *text, int run)
{
    int k = 0;
    while (k < *kinds && !is_alike(kind[k].text, text)) k++;
    if (k == KINDS_MOST) return;
    if (k == *kinds) {
        kind[(*kinds)++] = (struct warning_kind){.last = -1};
        snprintf(kind[k].text, sizeof kind[k].text, "%s", text);
    }
    kind[k].differs = kind[k].differs || strcmp(kind[k].text, text) != 0;
    kind[k].runs += kind[k].last != run;
    kind[k].last = run;
}

void study_print_warnings(const struct study *s, FILE *out)
{
    struct warning_kind *kind = NEW("study.warnings", KINDS_MOST, struct warning_kind);
    int kinds = 0, runs = 0;
    for (int k = 0; k < s->n; k++) {
        const struct path folder = study_case_folder(s, &s->at[k]);
        char key[32] = "warnings.0", text[WARNING_ROOM];
        if (s->at[k].state == CASE_SAME || !path_is_file(path_join(folder.text, "summary.json").text)) continue;
        runs++;
        for (int w = 0; summary_read_string(folder.text, key, text, sizeof text) == OK; w++) {
            warning_book(kind, &kinds, text, k);
            snprintf(key, sizeof key, "warnings.%d", w + 1);
        }
    }
    for (int k = 0; k < kinds; k++) {
        text_replace_control_characters(kind[k].text);
        fprintf(out, "warning: in %d of %d runs%s: %s\n", kind[k].runs, runs,
                kind[k].differs ? " (numbers of the first of them)" : "", kind[k].text);
    }
    memory_free(kind);
}
