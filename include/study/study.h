/* Room `study` (folders include/study and src/study): runs many variants of a scene, which differ in some of its keys,
 * as separate processes, and collects their results in a table. It uses scenes and the files of runs, but not the
 * engine; commands and benches call it. */
#ifndef CLEAVE_STUDY
#define CLEAVE_STUDY

#include <signal.h>

#include "output/output_lock.h"
#include "scene/scene.h"

/* CASE_NAME_ROOM: capacity of the name of a run [byte]; CASES_MOST: largest number of runs of a study; UNIT_ROOM,
 * HEADER_ROOM: capacity of a unit and of the header line of history.csv [byte]. */
enum { CASE_NAME_ROOM = 200, CASES_MOST = 100000, UNIT_ROOM = 16, HEADER_ROOM = 8192 };

/* A key of the scene and the values that the key has in the runs of a study. key, value[values]: owned texts, as they
 * follow the option `-s`. */
struct varied_key {
    char *key, **value;
    int values;
};

/* State of a run of a study. CASE_DONE_BEFORE: an earlier study left its results in the folder; CASE_STOPPED: stopped
 * before its end; CASE_SAME: its scene equals that of another run, whose results are used. */
enum case_state { CASE_WAITING, CASE_RUNNING, CASE_DONE, CASE_DONE_BEFORE, CASE_FAILED, CASE_STOPPED, CASE_SAME };

#define STUDY_SCENE "study.yaml" /* file in the folder of a study: its scene without the varied keys */

/* One run of a study: its overrides of the scene, and its state. */
struct study_case {
    char name[CASE_NAME_ROOM];       /* name of its subfolder of the study's folder */
    struct scene_override *override; /* [overrides] owned, including the strings */
    int overrides;
    enum case_state state;
    int same;                 /* index of the equal run if state is CASE_SAME */
    int process, slot, ended; /* process id and slot while it runs; exit status afterwards */
    double seconds;           /* duration of the run in this study [s] */
};

/* A study, i.e. runs of one scene with different overrides of keys, with its folder. Release with study_free. */
struct study {
    const char *scene; /* path of the scene; borrowed */
    char folder[4096]; /* folder of the study; runs are subfolders */
    char *text;        /* text of the scene without the varied keys, by which the folder is recognised; NULL: unknown */
    const char *options; /* text of study_options_compose_from_arguments; NULL: unknown; borrowed */
    struct folder_lock lock;
    struct study_case *at; /* [n] runs */
    int n;
    int *slot, slots; /* hash table of the names of the runs: index of the run + 1; 0: empty slot */
};

/* ---- values (study_values.c) ------------------------------------------------------------------------------------- */

/* Reads a key and its values from a text `KEY=VALUE,...` and stores them in *k. Values are separated by commas outside
 * brackets and quotes. A value of the form FROM:TO:STEP, with at most one unit, stands for equidistant numbers that
 * include both ends. Returns REFUSED, with the reason, if the text is malformed. Release k with varied_key_free. */
status varied_key_parse_name_and_values(struct varied_key *k, const char *text);

/* Frees the texts of the key and of the values in *k, which varied_key_parse_name_and_values has allocated. */
void varied_key_free(struct varied_key *k);

/* Returns the number at the beginning of the text `value`; NAN if there is none. Stores in *unit a pointer to the rest
 * of the text after the number and the following spaces, or to the whole text if there is no number. */
double value_text_split_number_and_unit(const char *value, const char **unit);

/* ---- cases (study.c) --------------------------------------------------------------------------------------------- */

/* Initialises a study without runs and creates no folder. scene: path of the scene file, kept by reference; folder:
 * folder of the study, NULL for results/NAME_KIND with the name of the scene and KIND = study_kind. Returns REFUSED if
 * the name of the folder is empty or too long, FAILED or REFUSED if the scene cannot be read. Release s with
 * study_free. */
status study_initialise(struct study *s, const char *scene, const char *folder, const char *study_kind);

/* Initialises a study without runs, whose keys key[keys] vary between runs, and creates no folder. A key with a single
 * value overrides the scene in all runs. Stores the text of the scene without the varied keys in s->text. scene: path
 * of the scene file, kept by reference; folder: folder of the study, NULL for results/NAME_KIND with the name of the
 * scene and KIND = study_kind. Returns REFUSED if the name of the folder is empty or too long, FAILED or REFUSED if the
 * scene cannot be read. Release s with study_free. */
status study_initialise_with_varied_keys(struct study *s, const char *scene, const char *folder, const char *study_kind,
                                         const struct varied_key *key, int keys);

/* Writes the path of the default folder of a study of a scene, results/NAME_KIND with the name of the scene and KIND =
 * study_kind, to folder[capacity], cut to capacity - 1 bytes. */
void study_compose_default_folder(char *folder, size_t capacity, const struct scene *scene, const char *study_kind);

/* Checks that `folder` may be used for a study of the scene with the text `scene_text`. Returns REFUSED if it contains
 * a study of another scene, or files that Cleave did not write. */
status study_folder_check_is_usable_for_scene(const char *folder, const char *scene_text);

/* Makes `folder` recognisable as the folder of a study: writes the file STUDY_SCENE (study.yaml) with its first line
 * only, the text of the scene to follow later. Does nothing if `folder` is already that of a study. Returns REFUSED if
 * the folder contains files that Cleave did not write, or if its subfolder `logs` or `pictures` is a symbolic link;
 * FAILED if the file cannot be written. */
status study_folder_mark_as_study(const char *folder);

/* Checks that `folder` may be used for a study, without writing anything. Returns REFUSED if it contains files that
 * Cleave did not write, or if its subfolder `logs` or `pictures` is a symbolic link. */
status study_folder_check_is_usable(const char *folder);

/* Returns true if `folder` contains the file STUDY_SCENE (study.yaml) of a study of the scene with the text
 * `scene_text`. */
bool study_folder_contains_study_of_scene(const char *folder, const char *scene_text);

/* Writes the file STUDY_SCENE (study.yaml) to `folder`: a first line by which Cleave recognises the file, a line with
 * the options of the study, then `scene_text`, the text of the scene. options: options in the form of
 * study_options_compose_from_arguments; if NULL, their line is left out. Returns FAILED if the file cannot be
 * written. */
status study_write_scene_and_options(const char *folder, const char *scene_text, const char *options);

/* Reads the reason for which the run called `run` of the study in `folder` has failed, the last line of its log, into
 * line[capacity], cut to capacity - 1 bytes. Stores "it gave no reason" if there is no such line. */
void study_read_reason_of_failure(char *line, size_t capacity, const char *folder, const char *run);

/* Composes the options of the command of a study as words for a shell, from argv[argc], the words after the name of the
 * command. Leaves out the scene, and options that change no result: -o, -q, --overwrite, --list, --collect. scene: the
 * word of argv that names the scene. Returns an allocated text, which the caller releases with memory_free. */
char *study_options_compose_from_arguments(int argc, char *const *argv, const char *scene);

/* Returns the options with which the study in `folder` was made, as words for a shell, or NULL if they are unknown. The
 * caller releases the text with memory_free. */
char *study_options_read(const char *folder);

/* Prints `word` to `out` as a word of a shell command, in quotes if it contains characters that a shell interprets. */
void study_print_word_quoted_for_shell(FILE *out, const char *word);

/* Frees the runs, texts and name table of the study *s and unlocks its folder. The files in the folder remain. */
void study_free(struct study *s);

/* Adds a run to the study s, with copies of override[overrides], its overrides of keys of the scene. name: desired name
 * of its folder, which is restricted to characters that every file system accepts. If it is too long or already taken,
 * the name case-HASH is used, with a hash of the overrides that does not depend on their order. Returns the run, which
 * belongs to the study; the pointer is valid until the next call. */
struct study_case *study_add_case(struct study *s, const char *name, const struct scene_override *override,
                                  int overrides);

/* => */
status study_add_cases_of_all_value_combinations(struct study *s, const struct varied_key *key, int keys);

/* Reads the scene of every run of the study s and sets the states of the runs before any of them is started: CASE_SAME
 * if an earlier run of s has an equal scene, whose results are then used; CASE_DONE_BEFORE if the folder of the run
 * holds its results already; CASE_FAILED if the folder holds a failed run and `keep_failed` is true. If `keep_failed`
 * is false, failed runs will be executed again. Returns REFUSED if the scene of a run is invalid. */
status study_find_completed_failed_and_equal_cases(struct study *s, bool keep_failed);

/* Prints to `out` how many runs of the study s have the same scene as another run (CASE_SAME). Prints nothing if there
 * are none. */
void study_print_count_of_duplicate_scenes(const struct study *s, FILE *out);

/* Returns the value of the key called `key` among the overrides of the run c, "" if the run does not override that key.
 * The text belongs to the run. */
const char *study_case_value_of_key(const struct study_case *c, const char *key);

/* Closes the memory stream `stream` (open_memstream) and writes its contents, *length bytes of *text, to the file
 * `name` in the folder of the study s; then releases *text. stream: NULL if it could not be opened. Returns FAILED if
 * `stream` is NULL or the file cannot be written. */
status study_write_memory_stream_to_file(const struct study *s, const char *name, FILE *stream, char **text,
                                         const size_t *length);

/* Returns the run of study s whose results are used for the run c: a run with an equal scene if the state of c is
 * CASE_SAME, else c itself. */
const struct study_case *study_case_whose_results_are_used(const struct study *s, const struct study_case *c);

/* Returns the path of the folder with the results of the run c of study s; if the state of c is CASE_SAME, it is the
 * folder of the run with an equal scene. */
struct path study_case_folder(const struct study *s, const struct study_case *c);

/* ---- runs (study_run.c) ------------------------------------------------------------------------------------------ */

/* Options by which the runs of a study are executed. */
struct study_options {
    int jobs, threads;     /* parallel runs; threads of each run; 0: determined from the number of cores */
    bool overwrite, quiet; /* replace older runs; print nothing */
    double until;          /* time on wall_clock_seconds at which no run is started and running ones are stopped;
                            * 0: never [s] */
    const volatile sig_atomic_t *stop; /* set by a signal handler: running runs stop with a checkpoint and no run is
                                        * started */
};

/* Locks the folder of the study s for this process and writes the file STUDY_SCENE (study.yaml), by which the folder is
 * recognised. Returns REFUSED if the folder does not exist, is that of a single run, contains files that Cleave did not
 * write, or is in use by another process. Also returns REFUSED if it contains a study of another scene, unless
 * `overwrite` is true. */
status study_lock_folder(struct study *s, bool overwrite);

/* Creates and locks the folder of the study s and executes all runs whose state is CASE_WAITING, each as a separate
 * process. options: number of parallel runs and other options. If a run fails, its state becomes CASE_FAILED, a line
 * appears on standard error, and the study continues. Returns REFUSED if the folder cannot be used (see
 * study_lock_folder), FAILED if a process cannot be started, INTERRUPTED if *options.stop is set. */
status study_execute_waiting_runs(struct study *s, struct study_options options);

/* Prints to `out` the shell command that executes run c alone. It is valid in any current folder, with quotes where the
 * shell requires them. options: of the study s. */
void study_print_command_of_case(const struct study *s, const struct study_case *c, struct study_options options,
                                 FILE *out);

/* ---- results (study_table.c, study_draw.c) ----------------------------------------------------------------------- */

/* All numbers in the summaries of the runs of a study. figure: [figures] their names; value: [figures][cases] value of
 * a result in a run, NAN if the run has no such result. */
struct study_table {
    char **figure;
    double **value;
    int figures, cases;
};

/* Reads all numbers from the summaries of the finished runs of the study s into *t. Returns FAILED if a summary cannot
 * be read. Release t with study_table_free. */
status study_table_read(struct study_table *t, const struct study *s);

/* Frees the names and values in the table *t, which study_table_read has allocated. */
void study_table_free(struct study_table *t);

/* Returns the index in t->figure of the result (number in summary.json) called `name`, or -1 if there is none. */
int study_table_index_of_result(const struct study_table *t, const char *name);

/* Checks that runs of the scene s can have a result (a number in summary.json) called `name`. Returns REFUSED if they
 * cannot, with the most similar name in the message. */
status result_name_check_is_known(const struct scene *s, const char *name);

/* Checks before the runs of the study s that each result (number in summary.json) name[names] can be in the summary of
 * at least one run. Returns REFUSED if not, with the most similar name in the message, or if a scene is invalid. */
status study_check_result_names(const struct study *s, const char *const *name, int names);

/* Returns true if the result (number in summary.json) called `name` describes the computation or the discretisation
 * (run time, number of particles) instead of the body. */
bool result_describes_computation_instead_of_body(const char *name);

/* Reads the header line of history.csv of the first run of the study s that has such a file into header[capacity]; ""
 * if there is none. study_determine_unit_of_result takes units from it. */
void study_read_history_header(char *header, size_t capacity, const struct study *s);

/* Determines the SI unit of the result (a number in summary.json) called `result_name` and writes it to unit[capacity];
 * "" if the result has no unit or it is unknown. header: header line of history.csv, as study_read_history_header
 * returns it. */
void study_determine_unit_of_result(char *unit, size_t capacity, const char *header, const char *result_name);

/* Prints each kind of warning of the runs of the study s to `out`: the number of runs that have it, and the text of the
 * first one. Warnings that differ only in numbers are of one kind. */
void study_print_warnings(const struct study *s, FILE *out);

/* Writes the table sweep.csv to the folder of the study s, one line for each run: name, state, values of the keys
 * key[keys], and the results in t. Returns FAILED if the file cannot be written. */
status study_write_table(const struct study_table *t, const struct study *s, const struct varied_key *key, int keys);

/* Checks that the table sweep.csv and the pictures of the study s may be written, one picture for each of the keys
 * key[keys]. Returns REFUSED if the folder is that of a study and contains one of these files although Cleave did not
 * write it. Returns OK for any other folder, since study_lock_folder refuses it. */
status study_check_output_files_replaceable(const struct study *s, const struct varied_key *key, int keys);

/* Prints to `out`, if the only varied key of the study s is a random seed, a line for each result (number in
 * summary.json): its mean, standard deviation, and half of the 95 % interval of the mean over the runs. Prints nothing
 * for other studies. t: table of the results; key[keys]: varied keys of the study and their values; result[results]:
 * names of the results; if results is 0, those that study_draw_results_over_keys draws. Returns REFUSED if there is no
 * such result. */
status study_print_means_over_seeds(FILE *out, const struct study_table *t, const struct study *s,
                                    const struct varied_key *key, int keys, const char *const *result, int results);

/* Draws results of a study (numbers in summary.json) against the values of each of its varied keys, as pictures/KEY.png
 * in the folder of the study s, and over two keys as pictures/map.png. t: table of the results; key[keys]: keys of the
 * study and their values; result[results]: names of the results, up to six; if results is 0, the first ones that differ
 * between runs are drawn. Returns REFUSED if there is no such result, FAILED if a picture cannot be drawn. */
status study_draw_results_over_keys(const struct study_table *t, const struct study *s, const struct varied_key *key,
                                    int keys, const char *const *result, int results);

#endif
