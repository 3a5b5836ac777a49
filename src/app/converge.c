/* Implements `cleave converge`: prints each result of an input file with its error bar. */
#include <stdio.h>
#include <string.h>

#include "arguments.h"
#include "base/memory.h"
#include "commands.h"
#include "scene/scene_read.h"
#include "study/convergence_study.h"
#include "scene/units.h"

static const char usage[] = "converge " CONVERGE_WORDS;

/* RUNS_USUAL: default of the number of runs at each spacing. LEVELS_USUAL: default of the number of spacings. */
enum { RUNS_USUAL = 5, LEVELS_USUAL = 3 };
#define BUDGET_USUAL 600.0 /* default of --budget [s] */

/* Arguments of `cleave converge`. */
struct converge_arguments {
    struct convergence_request wish;
    struct varied_key *key; /* [keys] overrides (-s), each with one value */
    const char **wanted;    /* [wanteds] names of requested results */
    int keys, wanteds;
    struct picture_size size;                      /* size and format of pictures */
    char folder[NAME_MAX_LENGTH + CASE_NAME_ROOM]; /* name of the folder without -o */
};

/* ---- the command line -------------------------------------------------------------------------------------------- */

/* Reads the time that the study may take from `text`, the value of --budget, such as "10 min", into request->budget
 * [s]. Also sets request->finer, so that finer spacings use this time. Returns REFUSED unless it is a positive time. */
static status budget_read(struct convergence_request *request, const char *text)
{
    char what[256];
    real value;
    if (number_parse_with_unit(&value, text, UNIT_TIME, false, what, sizeof what) && value > 0) {
        request->budget = value;
        request->finer = true;
        return OK;
    }
    return status_set(REFUSED, "--budget %s: give a time, such as 10 min", text);
}

static status converge_override(struct converge_arguments *a, const char *text)
{
    struct varied_key *k = &a->key[a->keys];
    TRY(varied_key_parse_name_and_values(k, text));
    a->keys++;
    if (k->values > 1) return status_set(REFUSED, "-s %s: give one value; to vary a key use cleave sweep", k->key);
    return OK;
}

static status converge_option(struct converge_arguments *a, const char *word, const char *value)
{
    struct convergence_request *request = &a->wish;
    if (!strcmp(word, "-o"))
        request->folder = value;
    else if (!strcmp(word, "-s"))
        return converge_override(a, value);
    else if (!strcmp(word, "-j"))
        return option_read_count(&request->options.jobs, word, value, 1, THREADS_MOST);
    else if (!strcmp(word, "-t"))
        return option_read_count(&request->options.threads, word, value, 1, THREADS_MOST);
    else if (!strcmp(word, "--runs"))
        return option_read_count(&request->runs, word, value, 1, RUNS_MOST);
    else if (!strcmp(word, "--levels"))
        return option_read_count(&request->levels, word, value, LEVELS_LEAST, LEVELS_MOST);
    else if (!strcmp(word, "--budget"))
        return budget_read(request, value);
    else if (option_is_size_dpi_or_format(word))
        return option_read_size_dpi_or_format(&a->size, word, value, usage);
    else
        a->wanted[a->wanteds++] = value;
    return OK;
}

static status converge_words(struct converge_arguments *a, int argc, char **argv)
{
    static const char *const taking[] = {"-o", "-s", "-j", "-t", "--runs", "--levels", "--budget", "--of"};
    for (int k = 1; k < argc; k++) {
        const char *word = argv[k];
        bool takes = option_is_size_dpi_or_format(word);
        for (size_t t = 0; t < COUNT_OF(taking); t++) takes |= !strcmp(word, taking[t]);
        if (takes) TRY(option_check_has_value(word, k + 1 < argc, usage));
        if (takes)
            TRY(converge_option(a, word, argv[++k]));
        else if (!strcmp(word, "--horizon"))
            a->wish.fixed_horizon = true;
        else if (!strcmp(word, "--overwrite"))
            a->wish.options.overwrite = true;
        else if (!strcmp(word, "-q"))
            a->wish.options.quiet = true;
        else if (word[0] == '-' && word[1])
            return status_set(REFUSED, "unknown option %s; usage: cleave %s", word, usage);
        else if (a->wish.scene)
            return arguments_refuse_second_scene(a->wish.scene, word);
        else
            a->wish.scene = word;
    }
    return a->wish.scene ? OK : status_set(REFUSED, "no scene is given; usage: cleave %s", usage);
}

/* ---- the command ------------------------------------------------------------------------------------------------- */

/* Determines the folder of the study from the arguments a, by default one named after the scene, and checks that it can
 * be used. Returns REFUSED if it contains files that do not belong to a study or, without --overwrite, the study of
 * another scene. */
static status converge_place(struct converge_arguments *a)
{
    struct convergence_request *request = &a->wish;
    struct scene scene;
    TRY(scene_read(&scene, request->scene, request->override, request->overrides));
    study_compose_default_folder(a->folder, sizeof a->folder, &scene, "converge");
    if (!request->folder) request->folder = a->folder;
    const status fits =
        request->options.overwrite ? OK : study_folder_check_is_usable_for_scene(request->folder, scene.text);
    scene_free(&scene);
    return fits == OK ? convergence_study_check_output_files_replaceable(request->folder) : fits;
}

static status converge_all(struct converge_arguments *a)
{
    struct convergence_study s;
    struct scalar_result_study *figure = NULL;
    int figures = 0;
    TRY(converge_place(a));
    struct convergence_request wish = a->wish;
    wish.wanted = a->wanted, wish.wanteds = a->wanteds;
    TRY(convergence_study_run(&s, &wish));
    study_print_warnings(&s.study, stderr);
    status done = scalar_results_determine_convergence(&s, a->wanted, a->wanteds, &figure, &figures);
    if (done == OK) done = scalar_results_write(&s, figure, figures);
    if (done == OK) scalar_results_print(&s, figure, figures);
    if (done == OK) done = scalar_results_draw_over_spacing(&s, figure, figures);
    memory_free(figure);
    convergence_study_free(&s);
    return done;
}

status command_converge_main(int argc, char **argv)
{
    struct converge_arguments a = {.key = NEW("converge.keys", argc, struct varied_key),
                                   .wanted = NEW("converge.wanted", argc, const char *),
                                   .size.dpi = PICTURE_DPI,
                                   .wish = {.runs = RUNS_USUAL,
                                            .levels = LEVELS_USUAL,
                                            .budget = BUDGET_USUAL,
                                            .options.stop = stop_signals_install_handlers()}};
    status done = converge_words(&a, argc, argv);
    picture_size_set_process_wide(a.size);
    struct scene_override *override = NEW("converge.overrides", argc, struct scene_override);
    for (int k = 0; k < a.keys; k++) override[k] = (struct scene_override){a.key[k].key, a.key[k].value[0]};
    a.wish.override = override;
    a.wish.overrides = a.keys;
    char *words = done == OK ? study_options_compose_from_arguments(argc, argv, a.wish.scene) : NULL;
    a.wish.words = words;
    if (done == OK) done = converge_all(&a);
    memory_free(words);
    for (int k = 0; k < a.keys; k++) varied_key_free(&a.key[k]);
    memory_free(override);
    memory_free(a.wanted);
    memory_free(a.key);
    return done;
}
