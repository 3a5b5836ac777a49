/* Implements `cleave sweep`: runs every combination of the values of some keys, or lists the commands for these
 * runs. */
#include <stdio.h>
#include <string.h>

#include "arguments.h"
#include "base/memory.h"
#include "commands.h"
#include "study/study.h"

static const char usage[] = "sweep " SWEEP_WORDS;

enum { FIGURES_MOST = 6 }; /* largest number of results (panels) of a picture */

/* Arguments of `cleave sweep`. */
struct sweep_arguments {
    const char *scene, *folder; /* path of the scene file; folder of the study, NULL: default */
    struct varied_key *key;     /* [keys] varied keys with their values */
    int keys;
    struct study_options options;
    bool list, collect;           /* only list the runs; only collect the results of finished runs */
    const char *of[FIGURES_MOST]; /* [asked] names of the results that pictures show */
    int asked;
    struct picture_size size; /* size and format of pictures */
    char *words;              /* text of study_options_compose_from_arguments */
};

/* ---- the command line -------------------------------------------------------------------------------------------- */

/* Reads `text`, KEY=VALUES, the text of an option -s, which gives a scene key with the values that the sweep tries, and
 * appends it to a->key. Returns REFUSED, with a message, if the key is given twice or the text is invalid. */
static status key_add(struct sweep_arguments *a, const char *text)
{
    TRY(varied_key_parse_name_and_values(&a->key[a->keys], text));
    const char *key = a->key[a->keys++].key;
    for (int k = 0; k + 1 < a->keys; k++)
        if (strcmp(a->key[k].key, key) == 0)
            return status_set(
                REFUSED, "-s %s: the key is given twice; give all its values in one list, separated by commas", key);
    return OK;
}

/* Appends the name of a result, the value of an option --of, to the list a->of. name: NULL if the option has no value.
 * Returns REFUSED if name is NULL or the list already has FIGURES_MOST results. */
static status drawn_figure_add(struct sweep_arguments *a, const char *name)
{
    TRY(option_check_has_value("--of", name != NULL, usage));
    if (a->asked == FIGURES_MOST)
        return status_set(REFUSED, "sweep: --of is given too often; give at most %d figures", FIGURES_MOST);
    a->of[a->asked++] = name;
    return OK;
}

static status sweep_words(struct sweep_arguments *a, int argc, char **argv)
{
    for (int k = 1; k < argc; k++) {
        const char *word = argv[k];
        const bool takes = word[0] == '-' && word[1] && strchr("osjt", word[1]) && !word[2];
        if (takes) TRY(option_check_has_value(word, k + 1 < argc, usage));
        if (!strcmp(word, "-o"))
            a->folder = argv[++k];
        else if (!strcmp(word, "-s"))
            TRY(key_add(a, argv[++k]));
        else if (!strcmp(word, "-j"))
            TRY(option_read_count(&a->options.jobs, word, argv[++k], 1, THREADS_MOST));
        else if (!strcmp(word, "-t"))
            TRY(option_read_count(&a->options.threads, word, argv[++k], 1, THREADS_MOST));
        else if (!strcmp(word, "--of"))
            TRY(drawn_figure_add(a, k + 1 < argc ? argv[++k] : NULL));
        else if (option_is_size_dpi_or_format(word))
            TRY(option_read_size_dpi_or_format(&a->size, word, k + 1 < argc ? argv[++k] : NULL, usage));
        else if (!strcmp(word, "--list"))
            a->list = true;
        else if (!strcmp(word, "--collect"))
            a->collect = true;
        else if (!strcmp(word, "--overwrite"))
            a->options.overwrite = true;
        else if (!strcmp(word, "-q"))
            a->options.quiet = true;
        else if (word[0] == '-' && word[1])
            return status_set(REFUSED, "unknown option %s; usage: cleave %s", word, usage);
        else if (a->scene)
            return arguments_refuse_second_scene(a->scene, word);
        else
            a->scene = word;
    }
    if (!a->scene) return status_set(REFUSED, "no scene is given; usage: cleave %s", usage);
    if (a->list && a->collect)
        return status_set(REFUSED,
                          "--list runs nothing, and --collect only reads finished runs; remove one of the two");
    if (a->keys == 0)
        return status_set(REFUSED,
                          "no key has several values, so all runs would be the same; give a key several values, such "
                          "as -s KEY=1,2; usage: cleave %s",
                          usage);
    return OK;
}

/* ---- what is printed --------------------------------------------------------------------------------------------- */

/* Returns the number of runs of study s that are in the given state. */
static int cases_in(const struct study *s, enum case_state state)
{
    int n = 0;
    for (int k = 0; k < s->n; k++) n += s->at[k].state == state;
    return n;
}

static void sweep_print(const struct study *s)
{
    const int done = cases_in(s, CASE_DONE), before = cases_in(s, CASE_DONE_BEFORE), failed = cases_in(s, CASE_FAILED);
    const int runs = s->n - cases_in(s, CASE_SAME);
    printf("%d runs: %d done", runs, done + before);
    if (before > 0) printf(" (%d of them by an earlier sweep)", before);
    if (failed > 0) printf(", %d failed: see %s/logs", failed, printable_name(s->folder).text);
    if (done + before + failed < runs) printf(", %d not run yet", runs - done - before - failed);
    printf("; table: %s/sweep.csv", printable_name(s->folder).text);
    printf("\n");
}

/* ---- the command ------------------------------------------------------------------------------------------------- */

/* Reads the results of all finished runs of study s, writes its table sweep.csv and draws its pictures. If only the
 * random seed varies, also prints the means of the results over the seeds. a: arguments of the sweep, with its keys.
 * Returns the first status that is not OK, else OK. */
static status sweep_collect(const struct study *s, const struct sweep_arguments *a)
{
    struct study_table table;
    TRY(study_table_read(&table, s));
    status done = study_write_table(&table, s, a->key, a->keys);
    if (done == OK && table.figures > 0)
        done = study_draw_results_over_keys(&table, s, a->key, a->keys, a->of, a->asked);
    if (done == OK) done = study_print_means_over_seeds(stdout, &table, s, a->key, a->keys, a->of, a->asked);
    study_table_free(&table);
    return done;
}

/* Prints the commands of all runs of the study s, one per line, without duplicates. a: arguments of the sweep. Returns
 * REFUSED if the folder of the study contains files that belong to no study or, without --overwrite, the study of
 * another scene. */
static status sweep_list(const struct study *s, const struct sweep_arguments *a)
{
    TRY(a->options.overwrite ? study_folder_check_is_usable(s->folder)
                             : study_folder_check_is_usable_for_scene(s->folder, s->text));
    for (int k = 0; k < s->n; k++)
        if (s->at[k].state != CASE_SAME) study_print_command_of_case(s, &s->at[k], a->options, stdout);
    return OK;
}

static status sweep_all(struct study *s, struct sweep_arguments *a)
{
    TRY(study_initialise_with_varied_keys(s, a->scene, a->folder, "sweep", a->key, a->keys));
    s->options = a->words;
    TRY(study_add_cases_of_all_value_combinations(s, a->key, a->keys));
    TRY(study_find_completed_failed_and_equal_cases(s, a->collect));
    TRY(study_check_result_names(s, a->of, a->asked));
    study_print_count_of_duplicate_scenes(s, stderr);
    if (a->list) return sweep_list(s, a);
    TRY(study_check_output_files_replaceable(s, a->key, a->keys));
    status ran = OK;
    if (a->collect)
        TRY(study_lock_folder(s, a->options.overwrite));
    else
        ran = study_execute_waiting_runs(s, a->options);
    if (ran != OK && ran != INTERRUPTED) return ran;
    char message[256];
    snprintf(message, sizeof message, "%s", status_message());
    const status collected = sweep_collect(s, a);
    if (ran == INTERRUPTED) return status_set(INTERRUPTED, "%s", message);
    TRY(collected);
    study_print_warnings(s, stderr);
    sweep_print(s);
    const int failed = cases_in(s, CASE_FAILED), stopped = cases_in(s, CASE_STOPPED);
    if (failed == 0 && stopped > 0)
        return status_set(INTERRUPTED, "%d of %d runs have stopped early; the same command continues them", stopped,
                          s->n - cases_in(s, CASE_SAME));
    return failed > 0
               ? status_set(FAILED, "%d of %d runs have failed; their messages are in the folder logs of the study",
                            failed, s->n - cases_in(s, CASE_SAME))
               : OK;
}

status command_sweep_main(int argc, char **argv)
{
    struct sweep_arguments a = {.key = NEW("sweep.keys", argc, struct varied_key),
                                .size.dpi = PICTURE_DPI,
                                .options.stop = stop_signals_install_handlers()};
    struct study s = {.lock.fd = -1};
    status done = sweep_words(&a, argc, argv);
    picture_size_set_process_wide(a.size);
    if (done == OK) {
        a.words = study_options_compose_from_arguments(argc, argv, a.scene);
        done = sweep_all(&s, &a);
    }
    study_free(&s);
    memory_free(a.words);
    for (int k = 0; k < a.keys; k++) varied_key_free(&a.key[k]);
    memory_free(a.key);
    return done;
}
