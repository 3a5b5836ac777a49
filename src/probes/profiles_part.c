/* Writes the CSV files of LINE and EXACT probes with every output frame, checks them at a restart, and removes them
 * before a new run. */
#include <stdio.h>
#include <unistd.h>

#include "run/say.h"
#include "output/output_files.h"
#include "probes/probes_part.h"

/* First characters of profile files, by which existing files are recognised: [0] of a LINE probe, [1] of an EXACT
 * probe. */
static const char *const profile_begin[] = {"s [m],", "x [m],"};

/* Writes the profile `text` of `length` bytes to file `name` in the folder with the path `folder`. Does not
 * overwrite a file that is no profile. Returns FAILED or REFUSED, with a message, if the file is not written. */
static status profiles_put(void *folder, const char *name, const char *text, size_t length)
{
    const struct path path = path_join(folder, name);
    TRY(file_check_has_known_beginning(path.text, profile_begin, COUNT_OF(profile_begin)));
    return file_write_whole_unsynced(path.text, text, length);
}

status profiles_write_csv_files(const struct probes *probes, const struct output *out, const struct observed_run *o)
{
    if (probes_count_profiles(probes) == 0) return OK;
    TRY(probes_write_profiles(probes, o, profiles_put, out->folder, out->series[0].frames - 1));
    return file_sync_parent_folder(path_join(out->folder, "history.csv").text);
}

void profiles_warn_of_missing_files(const struct probes *probes, const struct output *out,
                                    struct warnings *warning_list)
{
    char text[PATH_NAME_ROOM + 120], name[PROFILE_NAME], first[PROFILE_NAME] = "";
    int64_t lost = 0;
    for (int frame = 0; frame < out->series[0].frames; frame++)
        for (int k = 0; probes_compose_profile_file_name(probes, k, frame, name); k++) {
            if (path_is_file(path_join(out->folder, name).text)) continue;
            if (lost++ == 0) snprintf(first, sizeof first, "%s", name);
        }
    if (lost == 0) return;
    const char *more = "";
    char others[48];
    if (lost > 1) snprintf(others, sizeof others, ", and %lld more profiles are", (long long)lost - 1), more = others;
    snprintf(text, sizeof text, "%s is missing%s; run the scene again to write it", first, more);
    warnings_add_and_print(warning_list, text);
}

/* Removes the profile at `path`; leaves a file unchanged that is no profile. Returns false if there is no such file
 * or it cannot be removed. */
static bool profile_remove(const char *path)
{
    if (!path_exists(path)) return false;
    return file_check_has_known_beginning(path, profile_begin, COUNT_OF(profile_begin)) != OK || unlink(path) == 0;
}

void profiles_remove_files_of_earlier_run(const struct probes *probes, const struct output *out)
{
    char name[PROFILE_NAME];
    for (int k = 0; probes_compose_profile_file_name(probes, k, 0, name); k++)
        for (int frame = 0; probes_compose_profile_file_name(probes, k, frame, name); frame++)
            if (!profile_remove(path_join(out->folder, name).text)) break;
}
