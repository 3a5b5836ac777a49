/* Room `study`: many runs of one scene, which differ by some of its keys, as processes of their own; what comes out of
 * them as one table. It knows scenes and the files of runs, but no engine; commands and benches call it. */
#ifndef CLEAVE_STUDY
#define CLEAVE_STUDY

#include <signal.h>

#include "output/output_lock.h"
#include "scene/scene.h"

enum { CASE_NAME_ROOM = 200, CASES_MOST = 100000, UNIT_ROOM = 16, HEADER_ROOM = 8192 };

/* A key of the scene with the values that it takes, as they stand behind `-s`. */
struct varied_key {
    char *key, **value;
    int values;
};

/* CASE_SAME: the scene of another run, which stands for both. */
enum case_state { CASE_WAITING, CASE_RUNNING, CASE_DONE, CASE_DONE_BEFORE, CASE_FAILED, CASE_STOPPED, CASE_SAME };

#define STUDY_SCENE "study.yaml" /* in the folder of a study: its scene, without what varies */

/* One run of a study. */
struct study_case {
    char name[CASE_NAME_ROOM];       /* of its folder below that of the study */
    struct scene_override *override; /* owned, with their strings */
    int overrides;
    enum case_state state;
    int same;                 /* of CASE_SAME: the number of the other run */
    int process, slot, ended; /* while it runs; its exit status */
    double seconds;           /* that it took, of this study [s] */
};

struct study {
    const char *scene; /* path of the scene; borrowed */
    char folder[4096]; /* the runs are folders in it */
    char *text;        /* the scene without what varies, which its folder is kept for; NULL: not known */
    struct folder_lock lock;
    struct study_case *at;
    int n;
    int *slot, slots; /* the runs by the hashes of their names: number + 1, 0: none */
};

/* ---- values (study_values.c) ------------------------------------------------------------------------------------- */

/* Reads `KEY=VALUE,...`: values between commas that no bracket or quote holds; `from:to:step`, numbers with at most one
 * unit, is a row of them, both ends included. REFUSED with what is wrong. */
status varied_key_read(struct varied_key *k, const char *text);
void varied_key_free(struct varied_key *k);
/* The number that a value begins with and what follows it, its unit; NAN: none. */
double value_number(const char *value, const char **unit);

/* ---- cases (study.c) --------------------------------------------------------------------------------------------- */

/* Takes folder NULL as results/NAME_KIND, NAME the scene's. Makes no folder yet. */
status study_make(struct study *s, const char *scene, const char *folder, const char *kind);
/* The same, for a study of the scene without the keys that vary; those with one value are laid over it. */
status study_make_of(struct study *s, const char *scene, const char *folder, const char *kind,
                     const struct varied_key *key, int keys);
/* The folder that a study of a scene has if the user names none. */
void study_folder_default(char *to, size_t room, const struct scene *scene, const char *kind);
/* REFUSED if the folder holds a study of another scene. */
status study_folder_fits(const char *folder, const char *text);
/* Takes the folder for a study: writes STUDY_SCENE without a scene unless the folder has one. REFUSED if the folder
 * holds files of others, or `logs` or `pictures` in it is a link. */
status study_folder_claim(const char *folder);
/* REFUSED as study_folder_claim; writes nothing. */
status study_folder_guard(const char *folder);
/* Returns true if the folder is that of a finished study of this scene. */
bool study_scene_same(const char *folder, const char *text);
/* Writes STUDY_SCENE: a first line by which Cleave recognises it, then the scene. */
status study_scene_put(const char *folder, const char *text);
void study_free(struct study *s);
/* Adds a run; copies its overrides. The name is made unique and harmless to file systems: one that is too long or
 * taken becomes case-HASH of the overrides, whatever their order. */
struct study_case *study_add(struct study *s, const char *name, const struct scene_override *override, int overrides);
/* Adds a run for every combination of the keys' values, the last key's change first. REFUSED if they are too many. */
status study_cross(struct study *s, const struct varied_key *key, int keys);
/* Reads every scene, REFUSED if one is not sound; marks the runs that are the same as others, that are done already
 * and, with `collect`, those that have failed, which a study would run again. */
status study_check(struct study *s, bool collect);
/* How many runs are the same as others, in a line; nothing if there are none. */
void study_print_same(const struct study *s, FILE *out);
/* The value of a key in a run; "": it has none of its own. */
const char *study_value(const struct study_case *c, const char *key);
/* Closes a file of open_memstream (NULL: no memory) and writes its bytes, which are freed, as FOLDER/name. */
status study_put(const struct study *s, const char *name, FILE *to, char **text, const size_t *length);
/* The run that stands for a run: itself unless it is the same as another one. */
const struct study_case *study_representative(const struct study *s, const struct study_case *c);
/* Folder of the run that stands for a run. */
struct path study_folder(const struct study *s, const struct study_case *c);

/* ---- runs (study_run.c) ------------------------------------------------------------------------------------------ */

struct study_options {
    int jobs, threads; /* runs at once, threads of each; 0: as the cores allow */
    bool overwrite, quiet;
    double until;                      /* on team_clock: none starts after, those that run are stopped; 0: never */
    const volatile sig_atomic_t *stop; /* set by a signal: those that run end with checkpoints, none starts */
};

/* Takes the folder of the study for this process. REFUSED if there is none, if it is a run's, while another study is in
 * it; without `overwrite`, if it holds a study of another scene. */
status study_take(struct study *s, bool overwrite);
/* Makes and takes the folder, and runs what waits. Runs that fail are booked in their states, with a line on standard
 * error. REFUSED as study_take, INTERRUPTED where it was stopped. */
status study_run(struct study *s, struct study_options how);
/* Prints the line of the command that runs a case by itself, wherever it is given, with the words that a shell must not
 * touch in quotes. */
void study_print_command(const struct study *s, const struct study_case *c, struct study_options how, FILE *out);

/* ---- what comes out (study_table.c, study_draw.c) ---------------------------------------------------------------- */

/* All numbers of the runs' summaries: value[figure][case]; NAN: it has none. */
struct study_table {
    char **figure;
    double **value;
    int figures, cases;
};

/* Reads the summaries of all runs that are done. FAILED if one cannot be read. */
status study_table_read(struct study_table *t, const struct study *s);
void study_table_free(struct study_table *t);
/* Index of a figure; -1: there is none. */
int study_figure(const struct study_table *t, const char *name);
/* REFUSED with the nearest name if no run of this scene can have a figure of this name (figure_names.c). */
status figure_name_check(const struct scene *s, const char *name);
/* Is a figure about the computer or about how the body was divided, not about the body? */
bool study_figure_is_technical(const char *name);

/* The first line of the history of a run, from which study_unit takes units; "": there is none. */
void study_header_read(char *header, size_t room, const struct study *s);
/* SI unit of a figure; "": it has none, or it is not known. */
void study_unit(char *unit, size_t room, const char *header, const char *figure);
/* Prints a line for each warning: how many runs have it, and the text of the first. */
void study_print_warnings(const struct study *s, FILE *out);
/* Writes FOLDER/sweep.csv: a line for each run: its name, its state, the values of the keys that vary, its figures. */
status study_write_table(const struct study_table *t, const struct study *s, const struct varied_key *key, int keys);
/* REFUSED if the folder is that of a study and the table or a picture that the study of these keys leaves there is a
 * file of others. Other folders are refused by study_take. */
status study_output_guard(const struct study *s, const struct varied_key *key, int keys);
/* Draws FOLDER/pictures/KEY.png for each key that varies, and map.png where two do. */
status study_draw(const struct study_table *t, const struct study *s, const struct varied_key *key, int keys);

#endif
