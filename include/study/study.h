/* Room `study`: runs many variants of a scene, which differ in some of its keys, as separate processes, and collects
 * their results in a table. It uses scenes and the files of runs, but not the engine; commands and benches call it. */
#ifndef CLEAVE_STUDY
#define CLEAVE_STUDY

#include <signal.h>

#include "output/output_lock.h"
#include "scene/scene.h"

enum { CASE_NAME_ROOM = 200, CASES_MOST = 100000, UNIT_ROOM = 16, HEADER_ROOM = 8192 };

/* A key of the scene and the values that it takes in a study, as text after `-s`. */
struct varied_key {
    char *key, **value;
    int values;
};

/* State of a run. CASE_SAME: its scene equals that of another run, whose results are used. */
enum case_state { CASE_WAITING, CASE_RUNNING, CASE_DONE, CASE_DONE_BEFORE, CASE_FAILED, CASE_STOPPED, CASE_SAME };

#define STUDY_SCENE "study.yaml" /* file in the folder of a study: its scene without the varied keys */

/* One run of a study. */
struct study_case {
    char name[CASE_NAME_ROOM];       /* name of its subfolder of the study's folder */
    struct scene_override *override; /* [overrides] owned, including the strings */
    int overrides;
    enum case_state state;
    int same;                 /* index of the equal run if state is CASE_SAME */
    int process, slot, ended; /* process id and slot while it runs; exit status afterwards */
    double seconds;           /* duration of the run in this study [s] */
};

/* A study: its runs and its folder. */
struct study {
    const char *scene; /* path of the scene; borrowed */
    char folder[4096]; /* folder of the study; runs are subfolders */
    char *text;        /* text of the scene without the varied keys, by which the folder is recognised; NULL: unknown */
    struct folder_lock lock;
    struct study_case *at; /* [n] runs */
    int n;
    int *slot, slots; /* hash table of the names of the runs: index of the run + 1; 0: empty slot */
};

/* ---- values (study_values.c) ------------------------------------------------------------------------------------- */

/* Parses `KEY=VALUE,...`. Values are separated by commas outside brackets and quotes. `from:to:step` stands for
 * equidistant numbers including both ends, with at most one unit. REFUSED, with the reason, if the text is malformed.
 * Release with varied_key_free. */
status varied_key_read(struct varied_key *k, const char *text);

/* Releases the memory of k. */
void varied_key_free(struct varied_key *k);

/* Returns the number at the start of a value; NAN if there is none. unit: receives the text that follows the number. */
double value_number(const char *value, const char **unit);

/* ---- cases (study.c) --------------------------------------------------------------------------------------------- */

/* Initialises a study of the scene with path `scene`. folder: NULL for results/NAME_KIND, NAME the name of the scene.
 * Creates no folder. FAILED or REFUSED if the scene cannot be read. Release with study_free. */
status study_make(struct study *s, const char *scene, const char *folder, const char *kind);

/* Initialises a study as study_make does, for a scene without the varied keys; keys with a single value override the
 * scene. */
status study_make_of(struct study *s, const char *scene, const char *folder, const char *kind,
                     const struct varied_key *key, int keys);

/* Writes the default folder of a study of a scene, results/NAME_KIND. to: capacity `room` [byte]. */
void study_folder_default(char *to, size_t room, const struct scene *scene, const char *kind);

/* Checks that the folder holds no study of another scene. REFUSED if it does. text: text of the scene. */
status study_folder_fits(const char *folder, const char *text);

/* Marks the folder as that of a study: writes STUDY_SCENE without a scene unless the file exists. REFUSED if the folder
 * holds files that Cleave did not write, or if its subfolder `logs` or `pictures` is a link. */
status study_folder_claim(const char *folder);

/* Checks a folder as study_folder_claim does, but writes nothing. */
status study_folder_guard(const char *folder);

/* Returns true if the folder is that of a finished study of the scene with this text. */
bool study_scene_same(const char *folder, const char *text);

/* Writes STUDY_SCENE: a first line by which Cleave recognises the file, then the text of the scene. */
status study_scene_put(const char *folder, const char *text);

/* Releases the memory of s. */
void study_free(struct study *s);

/* Adds a run with copies of override[overrides]. name: wanted name of its folder; made unique and restricted to
 * characters that every file system accepts. A name that is too long or taken becomes case-HASH, with a hash of the
 * overrides that is independent of their order. Returns the run, which the study owns. */
struct study_case *study_add(struct study *s, const char *name, const struct scene_override *override, int overrides);

/* Adds a run for every combination of the values of key[keys]; the last key varies fastest. REFUSED if there are more
 * than CASES_MOST. */
status study_cross(struct study *s, const struct varied_key *key, int keys);

/* Reads the scene of every run; REFUSED if one is invalid. Marks runs with equal scenes, runs that are already done
 * and, if `collect` is true, runs that have failed, which a study would run again. */
status study_check(struct study *s, bool collect);

/* Prints how many runs have the same scene as another one; prints nothing if there are none. */
void study_print_same(const struct study *s, FILE *out);

/* Returns the value of a key in the overrides of a run; "" if it has no override for the key. */
const char *study_value(const struct study_case *c, const char *key);

/* Closes a file of open_memstream and writes its `*length` bytes as FOLDER/name; frees *text. to: NULL if
 * open_memstream failed; then FAILED. */
status study_put(const struct study *s, const char *name, FILE *to, char **text, const size_t *length);

/* Returns the run whose results are used for run c: c itself unless its state is CASE_SAME. */
const struct study_case *study_representative(const struct study *s, const struct study_case *c);

/* Returns the folder with the results of run c. */
struct path study_folder(const struct study *s, const struct study_case *c);

/* ---- runs (study_run.c) ------------------------------------------------------------------------------------------ */

/* Options of studies. */
struct study_options {
    int jobs, threads;                 /* parallel runs; threads of each run; 0: determined from the number of cores */
    bool overwrite, quiet;             /* replace older runs; print nothing */
    double until;                      /* time on team_clock at which no run is started and running ones are stopped;
                                        * 0: never [s] */
    const volatile sig_atomic_t *stop; /* set by a signal handler: running runs stop with a checkpoint and no run is
                                        * started */
};

/* Locks the folder of the study for this process. REFUSED if the folder does not exist, is that of a run, is used by
 * another process or, without `overwrite`, holds a study of another scene. */
status study_take(struct study *s, bool overwrite);

/* Creates and locks the folder and starts all waiting runs. A failed run is recorded in its state, with a line on
 * standard error, and the study continues. REFUSED as study_take; INTERRUPTED by how.stop. */
status study_run(struct study *s, struct study_options how);

/* Prints a shell command that runs one case, valid in any current folder, with quotes where the shell requires them. */
void study_print_command(const struct study *s, const struct study_case *c, struct study_options how, FILE *out);

/* ---- results (study_table.c, study_draw.c) ----------------------------------------------------------------------- */

/* All numbers in the summaries of the runs: value[figure][case]; NAN if the run has no such figure. */
struct study_table {
    char **figure;
    double **value;
    int figures, cases;
};

/* Reads the summaries of all finished runs. FAILED if one cannot be read. Release with study_table_free. */
status study_table_read(struct study_table *t, const struct study *s);

/* Releases the memory of t. */
void study_table_free(struct study_table *t);

/* Returns the index of a figure in the table, or -1. */
int study_figure(const struct study_table *t, const char *name);

/* Checks that runs of the scene can have a figure of this name (figure_names.c). REFUSED, with the most similar name,
 * if not. */
status figure_name_check(const struct scene *s, const char *name);

/* Returns true if a figure describes the computation or the discretisation instead of the body. */
bool study_figure_is_technical(const char *name);

/* Reads the header of the history.csv of a run, from which study_unit takes units. header: capacity `room` [byte]; ""
 * if there is none. */
void study_header_read(char *header, size_t room, const struct study *s);

/* Determines the SI unit of a figure. unit: capacity `room` [byte]; "" if it has none or it is unknown. header: from
 * study_header_read. */
void study_unit(char *unit, size_t room, const char *header, const char *figure);

/* Prints each distinct warning of the runs: the number of runs that have it and the text of the first. */
void study_print_warnings(const struct study *s, FILE *out);

/* Writes FOLDER/sweep.csv with a line for each run: name, state, values of the varied keys, figures. */
status study_write_table(const struct study_table *t, const struct study *s, const struct varied_key *key, int keys);

/* Checks that the table and the pictures of the study may be written. REFUSED if the folder is that of a study, and one
 * of these files exists and Cleave did not write it. Other folders are checked by study_take. */
status study_output_guard(const struct study *s, const struct varied_key *key, int keys);

/* Draws FOLDER/pictures/KEY.png for each varied key, and map.png for two. */
status study_draw(const struct study_table *t, const struct study *s, const struct varied_key *key, int keys);

#endif
