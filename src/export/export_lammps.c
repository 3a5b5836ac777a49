/* Exports a scene to LAMMPS: reads it, with bonds everywhere and with the fixed rules of LAMMPS; creates its particles
 * and bonds; writes the files. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/memory.h"
#include "export_parts.h"
#include "output/folder_guard.h"
#include "output/output_files.h"
#include "output/output_lock.h"
#include "scene/scene_read.h"

/* ---- the scene --------------------------------------------------------------------------------------------------- */

/* Reads the scene to be exported to *s, with three kinds of changes to its keys: the overrides of the user
 * (r->override), method: pd so that bonds fill the whole body, and the settings `with`, by which the scene agrees with
 * LAMMPS. Release s with scene_free. Returns REFUSED or FAILED, with a message, if the scene cannot be read. */
static status scene_make(struct scene *s, const struct export_request *r, const struct lammps_settings *with)
{
    struct scene_override *all = NEW("export.overrides", r->overrides + 1 + with->n, struct scene_override);
    int n = 0;
    for (int k = 0; k < r->overrides; k++) all[n++] = r->override[k];
    all[n++] = (struct scene_override){"method", "pd"};
    for (int k = 0; k < with->n; k++) all[n++] = (struct scene_override){with->of[k].key, with->of[k].value};
    const status read = scene_read(s, r->scene, all, n);
    memory_free(all);
    return read;
}

/* Refuses the export of scene s with a message that lists all keys that the export would have to change, `settings`,
 * and their new values. If there are no such keys, the message states the difference in results that no key removes.
 * Returns REFUSED. */
static status settings_refuse(const struct lammps_settings *settings, const struct scene *s)
{
    char list[1024] = "";
    size_t length = 0;
    for (int k = 0; k < settings->n && length < sizeof list; k++)
        length += (size_t)snprintf(list + length, sizeof list - length, " -s %s=%s", settings->of[k].key,
                                   settings->of[k].value);
    if (settings->n == 0)
        return status_set(REFUSED,
                          "%s: results will differ from LAMMPS once bonds break: LAMMPS (peri/lps) keeps broken bonds "
                          "in the weighted volume of a particle; set model: bond, or add --allow-different",
                          printable_name(s->path).text);
    return status_set(REFUSED,
                      "%s: LAMMPS has the same result only with%s; set these keys in the scene, or add "
                      "--allow-different, which sets them for the export",
                      printable_name(s->path).text, list);
}

static status scene_to_export(struct scene *s, struct lammps_settings *settings, const struct export_request *r)
{
    const struct lammps_settings none = {0};
    TRY(scene_read(s, r->scene, r->override, r->overrides));
    TRY(lammps_list_input_changes_for_equal_results(settings, s, r->bond_style));
    scene_free(s);
    TRY(scene_make(s, r, &none));
    TRY(lammps_list_input_changes_for_equal_results(settings, s, r->bond_style));
    if (settings->n == 0 && !lammps_keeps_weighted_volume_after_bonds_break(s)) return OK;
    if (!r->allow_different) return settings_refuse(settings, s);
    struct lammps_settings left;
    scene_free(s);
    TRY(scene_make(s, r, settings));
    TRY(lammps_list_input_changes_for_equal_results(&left, s, r->bond_style));
    if (left.n > 0) return settings_refuse(&left, s);
    return OK;
}

/* ---- files ------------------------------------------------------------------------------------------------------- */

/* Writes to the stream `to` what of scene s the script leaves out: the number of probes, and of regions with frames
 * (outputs) of their own. Writes nothing if there are none. */
static void left_out_write(FILE *to, const struct scene *s)
{
    if (s->probes == 0 && s->n_series == 0) return;
    fputs("left out: ", to);
    if (s->probes > 0) fprintf(to, "%d probe%s", s->probes, s->probes == 1 ? "" : "s");
    if (s->n_series > 0)
        fprintf(to, "%sframes of %d region%s", s->probes > 0 ? ", " : "", s->n_series, s->n_series == 1 ? "" : "s");
    fputs("; plate.dump has positions, velocities and damage\n", to);
}

static void readme_write(FILE *to, const struct lammps_export *x)
{
    const char *style = x->bond_style ? "bond_style bpm/peri" : x->s->model == MODEL_BOND ? "peri/pmb" : "peri/lps";
    const long long steps = (long long)lammps_comparison_step_count(x);
    fprintf(to,
            "%s for LAMMPS (%s), exported by Cleave %s\n\n    lmp -in in.lammps                       # or: mpirun -np "
            "16 lmp -in in.lammps\n    cleave compare RESULTS_OF_CLEAVE .      # displacement, velocity, damage; and "
            "the check of %lld steps\n\nin.lammps   the commands; their last lines are a test for a machine without "
            "Cleave\nplate.data  particles%s\nscene.yaml  the scene as exported: `cleave run scene.yaml` is the same "
            "run in Cleave\ncheck.csv   positions of the particles in Cleave after %lld steps; their damage, the share "
            "of broken bonds among those\n            intact at the start (as in LAMMPS), and their damage `start` by "
            "pre-cracks; total: start + (1 - start) damage\n\n",
            x->s->name, style, CLEAVE_VERSION, steps, x->bond_style ? " and bonds" : "", steps);
    lammps_write_run_time_estimate(to, x);
    left_out_write(to, x->s);
    fprintf(to, "\nThe method is `pd`: the whole body has bonds, also where `adaptive` would take material points.\n");
    for (int k = 0; k < x->settings.n; k++)
        fprintf(to, "%s%s: %s   %s\n",
                k ? "" : "\nThe results differ from those of the scene as it was, by LAMMPS' rules:\n",
                x->settings.of[k].key, x->settings.of[k].value, x->settings.of[k].effect);
    if (lammps_keeps_weighted_volume_after_bonds_break(x->s))
        fputs("\nThe results differ once bonds break: neighbourhoods of LAMMPS keep the weight of their broken bonds, "
              "those "
              "of Cleave\ndo not. check.csv agrees to round-off only until the first bond breaks.\n",
              to);
    if (x->bond_style)
        fputs("\nbond_style bpm/peri was written by its documentation (LAMMPS of 2 September 2026) and has not been "
              "run by Cleave's\ntests. Compare with check.csv before you rely on it. There is no contact: see the "
              "comment at pair_style.\n",
              to);
    else if (x->s->contact_between != CONTACT_NONE)
        fputs("\nFragments that touch repel each other, by the same rule in both programs.\n", to);
    fputs("\nBonds compressed below 0.7 of their length repel in Cleave, but not in LAMMPS. One rank and "
          "several\ndiffer in the last digits. Frames of Cleave have velocities half a step older than those of "
          "LAMMPS, and\ndamage without the bonds that break at their positions.\n",
          to);
}

/* A file of an export and the function that writes it. */
struct export_file {
    const char *name;
    status (*write)(FILE *to, struct lammps_export *x, const struct lammps_types *t);
};

static status put_data(FILE *to, struct lammps_export *x, const struct lammps_types *t)
{
    return lammps_data_write(to, x, t), OK;
}

static status put_readme(FILE *to, struct lammps_export *x, const struct lammps_types *t)
{
    (void)t;
    return readme_write(to, x), OK;
}

static status put_scene_text(FILE *to, struct lammps_export *x, const struct lammps_types *t)
{
    (void)t;
    return fputs(x->s->text, to), OK;
}

static status put_check(FILE *to, struct lammps_export *x, const struct lammps_types *t)
{
    (void)t;
    return lammps_run_and_write_comparison_positions(to, x);
}

static status put_script(FILE *to, struct lammps_export *x, const struct lammps_types *t)
{
    return lammps_script_write(to, x, t), OK;
}

/* Files of an export in the order of writing. check.csv is written late because it makes time steps, which change the
 * particles. The script is the last, so that a folder with the script is complete. */
static const struct export_file files[] = {{"plate.data", put_data},
                                           {"README.txt", put_readme},
                                           {"scene.yaml", put_scene_text},
                                           {"check.csv", put_check},
                                           {"in.lammps", put_script}};

/* Writes the file f of the export x under its temporary name and synchronises it with the disk. t: particle types of
 * LAMMPS. Returns FAILED, with the temporary file removed, if it cannot be written completely, or the status of
 * f->write. */
static status file_export(const struct export_file *f, struct lammps_export *x, const struct lammps_types *t)
{
    const struct path path = path_join(x->request->folder, f->name),
                      aside = file_register_temporary_and_return_path(path.text);
    unlink(aside.text); /* a link of this name is not followed */
    FILE *to = fopen(aside.text, "wx");
    if (!to) return file_report_write_failure(path.text, errno);
    status s = f->write(to, x, t);
    const bool whole = !ferror(to);
    const bool closed = fclose(to) == 0;
    if (s == OK && !(whole && closed)) s = file_report_write_failure(path.text, errno);
    if (s == OK) s = file_append_and_sync(path.text, NULL, 0);
    if (s != OK) file_discard_temporary(path.text);
    return s;
}

/* ---- the folder -------------------------------------------------------------------------------------------------- */

#define SIGN_OF_EXPORT ", exported by Cleave " /* in the first line of in.lammps */

/* Returns true if the file `path` is a script in.lammps that Cleave has exported, by its first line; false if it cannot
 * be read. scene_text: not used; it belongs to the type of function that struct folder_kind requires. */
static bool is_script_of_export(const char *path, const char *scene_text)
{
    (void)scene_text;
    char *text;
    size_t length;
    if (file_read_whole(path, &text, &length) != OK) return false;
    text[strcspn(text, "\n")] = '\0';
    const bool is = strstr(text, SIGN_OF_EXPORT) != NULL;
    memory_free(text);
    return is;
}

/* Checks that the folder of the request r may be written to. Returns OK, or REFUSED, with a message, in three cases:
 * the folder contains files that belong to no export; it contains an older export, and --overwrite is not given; or a
 * file to be replaced is an input of this export. */
static status export_guard(const struct export_request *r)
{
    static const struct folder_kind kind = {.what = "export", .sign = "in.lammps", .is_sign = is_script_of_export};
    bool there;
    TRY(folder_check_writable(&kind, r->folder, NULL, &there));
    if (there && !r->overwrite)
        return status_set(REFUSED, "%s contains an export; choose another -o, or replace it with --overwrite",
                          r->folder);
    for (size_t k = 0; k < COUNT_OF(files); k++) TRY(file_check_replaceable(path_join(r->folder, files[k].name).text));
    return OK;
}

/* Writes the files of the export x into its folder, which the caller has locked. All are first written under temporary
 * names, so that an older export stays complete if one fails. Then the older script is removed and the new files are
 * renamed, the script last, because a folder without a script is not recognised as an export. t: particle types of
 * LAMMPS. Returns FAILED, with the temporary files removed, if a file cannot be written; REFUSED if the folder may not
 * be written to. */
static status files_write_locked(struct lammps_export *x, const struct lammps_types *t)
{
    const char *folder = x->request->folder;
    size_t written = 0, published = 0;
    status s = export_guard(x->request);
    for (; s == OK && written < COUNT_OF(files); written++) s = file_export(&files[written], x, t);
    if (s == OK) unlink(path_join(folder, "in.lammps").text);
    for (; s == OK && published < COUNT_OF(files); published++)
        s = file_replace_by_temporary(path_join(folder, files[published].name).text);
    for (; s != OK && published < written; published++)
        file_discard_temporary(path_join(folder, files[published].name).text);
    return s;
}

static status files_write(struct lammps_export *x, const struct lammps_types *t)
{
    struct folder_lock lock;
    TRY(folder_create_with_parents(x->request->folder));
    TRY(folder_lock(&lock, x->request->folder));
    const status s = files_write_locked(x, t);
    folder_unlock(&lock, x->request->folder);
    return s;
}

/* ---- the export -------------------------------------------------------------------------------------------------- */

/* Prints to standard output how to start LAMMPS on the export x, whether its style has been tested, the number of bonds
 * that the export cuts, the estimated cost, and how the results differ from the scene. t: particle types of LAMMPS. */
static void export_print(const struct lammps_export *x, const struct lammps_types *t)
{
    printf("%s: run LAMMPS in this folder with: lmp -in in.lammps\n", printable_name(x->request->folder).text);
    if (x->bond_style)
        puts("bond_style bpm/peri has not been tested with a LAMMPS of that style; compare with check.csv before you "
             "rely on it");
    if (x->cut > 0) printf("%lld bonds are cut by pre-cracks", (long long)x->cut);
    if (x->cut > 0 && t->pairs > 0)
        printf(": LAMMPS excludes %lld pairs among %d types of particles", (long long)t->pairs, t->n);
    if (x->cut > 0) puts("");
    lammps_write_run_time_estimate(stdout, x);
    left_out_write(stdout, x->s);
    for (int k = 0; k < x->settings.n; k++)
        printf("differs from the scene: %s: %s\n", x->settings.of[k].key, x->settings.of[k].value);
    if (lammps_keeps_weighted_volume_after_bonds_break(x->s))
        puts("differs from Cleave once bonds break: peri/lps keeps broken bonds in the weighted volume of a particle");
}

static status export_write(struct lammps_export *x)
{
    struct lammps_types t = {0};
    const struct family *f = &x->e->source.family;
    const bool ramp = f->volume == VOLUME_CUT_RAMP;
    x->cutoff = ramp ? f->horizon : f->cutoff;
    x->lattice = ramp ? f->spacing : 1e-8 * f->spacing; /* a ramp so narrow that no neighbour is on it */
    TRY(lammps_find_loads_of_particles(x));
    status s = lammps_types_assign_to_particles(&t, x);
    if (s == OK) s = files_write(x, &t);
    if (s == OK) export_print(x, &t);
    lammps_types_free(&t);
    memory_free(x->loads);
    return s;
}

status export_lammps(const struct export_request *request)
{
    struct scene s = {0};
    struct run *run = NEW("export.engine", 1, struct run);
    struct lammps_export *x = NEW("export", 1, struct lammps_export);
    x->s = &s, x->e = run, x->request = request, x->bond_style = request->bond_style;
    status result = scene_to_export(&s, &x->settings, request);
    if (result == OK) result = export_guard(request);
    if (result == OK) result = run_set_up_from_scene(run, &s, NULL);
    if (result == OK) result = export_write(x);
    run_free_memory(run);
    scene_free(&s);
    memory_free(x);
    memory_free(run);
    return result;
}
