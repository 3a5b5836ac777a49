/* Implements `cleave export`: writes an input file as input of LAMMPS, or an input file or run as Exodus II file. */
#include <stdlib.h>
#include <string.h>

#include "arguments.h"
#include "base/memory.h"
#include "base/team.h"
#include "commands.h"
#include "export/export.h"
#include "output/output_files.h"
#include "plot/plot.h"

static const char usage[] = "export " EXPORT_WORDS;

/* Programs and formats to which input files are exported. write: the function that writes the files. */
static const struct target {
    const char *name;
    status (*write)(const struct export_request *);
} targets[] = {{"lammps", export_lammps}, {"exodus", export_exodus}};

/* Reads the options that only `cleave export` has to r, and removes them from the words argv[*argc], so that the
 * remaining words can be read as those of `cleave run`. Returns REFUSED, with a message, if --style has an unknown
 * value, or if --resume or -q is given. */
static status export_words(struct export_request *r, int *argc, char **argv)
{
    int kept = 1;
    r->allow_different = arguments_remove_option(argc, argv, "--allow-different");
    r->overwrite = arguments_remove_option(argc, argv, "--overwrite");
    for (int k = 2; k < *argc; k++) {
        const bool style = !strcmp(argv[k], "--style");
        if (style && k + 1 < *argc && (!strcmp(argv[k + 1], "peri") || !strcmp(argv[k + 1], "bpm")))
            r->bond_style = !strcmp(argv[++k], "bpm");
        else if (style)
            return status_set(
                REFUSED, "--style: give peri (pair_style peri) or bpm (bond_style bpm/peri); usage: cleave %s", usage);
        else if (!strcmp(argv[k], "--resume") || !strcmp(argv[k], "-q"))
            return status_set(REFUSED, "unknown option %s; usage: cleave %s", argv[k], usage);
        else
            argv[kept++] = argv[k];
    }
    *argc = kept;
    return OK;
}

/* Checks that `scene`, a file or folder, is not the folder of a study, which has a list of its runs in place of an
 * input file. Returns OK, or REFUSED with a message. */
static status check_not_study(const char *scene)
{
    const bool study = folder_contains_study_table(scene) || run_folder_has_file(scene, "study.yaml");
    if (!study || run_folder_has_file(scene, "scene.yaml")) return OK;
    return status_set(REFUSED, "%s contains a study; export one of its runs, which are folders inside it",
                      printable_name(scene).text);
}

status command_export_main(int argc, char **argv)
{
    struct export_request request = {0};
    struct run_arguments a;
    const struct target *target = NULL;
    for (size_t k = 0; k < COUNT_OF(targets) && argc > 1; k++)
        if (strcmp(argv[1], targets[k].name) == 0) target = &targets[k];
    if (!target && argc > 1 && strcmp(argv[1], "perilab") == 0)
        return status_set(REFUSED,
                          "export: input files of PeriLab are not written, because their keys change from version "
                          "to version; use exodus for a mesh that PeriLab reads; usage: cleave %s",
                          usage);
    if (!target) return status_set(REFUSED, "export: give lammps or exodus; usage: cleave %s", usage);
    const bool lammps = target->write == export_lammps;
    TRY(export_words(&request, &argc, argv));
    if (!lammps && (request.bond_style || request.allow_different))
        return status_set(
            REFUSED, "export: --style and --allow-different are for lammps only; remove them; usage: cleave %s", usage);
    TRY(arguments_read(&a, argc, argv, usage));
    threads_set_count_and_bind_to_cores(a.threads);
    request.scene = a.scene, request.folder = a.folder;
    request.override = a.override, request.overrides = a.overrides;
    status result = a.folder ? check_not_study(a.scene)
                             : status_set(REFUSED, "export: the option -o is missing; usage: cleave %s", usage);
    if (result == OK) result = target->write(&request);
    arguments_free(&a);
    return result;
}
