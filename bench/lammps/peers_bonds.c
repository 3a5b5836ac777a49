/* Starts LAMMPS and reads how long it took; bond_style bpm/peri, through `cleave export lammps --style bpm`. */
#define _GNU_SOURCE /* posix_spawn_file_actions_addchdir_np */
#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench/common/bench.h"
#include "export/export.h"
#include "output/output_files.h"
#include "peers.h"

extern char **environ;

/* Starts lmp with the arguments argv in the folder `folder`, with its standard output in the file `out`, and waits for
 * its end. Returns FAILED if it cannot be started or exits with another status than 0. */
static status lmp_run(char *const *argv, const char *folder, const char *out)
{
    pid_t child;
    int ended;
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    posix_spawn_file_actions_addchdir_np(&actions, folder);
    const int fault = posix_spawnp(&child, "lmp", &actions, NULL, argv, environ);
    posix_spawn_file_actions_destroy(&actions);
    if (fault) return status_set(FAILED, "bench peers: cannot start lmp: %s", strerror(fault));
    while (waitpid(child, &ended, 0) < 0)
        if (errno != EINTR) return status_set(FAILED, "bench: %s", strerror(errno));
    if (WIFEXITED(ended) && WEXITSTATUS(ended) == 0) return OK;
    return status_set(FAILED, "bench peers: lmp has failed");
}

bool peer_has_bond_style(void)
{
    char *argv[] = {"lmp", "-h", NULL}, line[512];
    if (lmp_run(argv, ".", PEERS_FOLDER "/styles.txt") != OK) return false;
    FILE *f = fopen(PEERS_FOLDER "/styles.txt", "r");
    bool found = false;
    while (f && !found && fgets(line, sizeof line, f)) found = strstr(line, "bpm/peri") != NULL;
    if (f) fclose(f);
    return found;
}

double peer_bond_style_speed_ratio(bool state_based) { return state_based ? 5.4 : 3.6; }

status peer_run_lammps(const char *folder, const char *input_name, const char *log_name)
{
    char *argv[] = {"lmp", "-in", (char *)input_name, "-log", (char *)log_name, "-screen", "none", NULL};
    return lmp_run(argv, folder, "/dev/null");
}

status peer_read_seconds_per_step(const char *log_path, int step_count, double *seconds)
{
    char line[512];
    FILE *f = fopen(log_path, "r");
    bool known = false;
    while (f && fgets(line, sizeof line, f)) {
        long found;
        double spent;
        const char *of = strstr(line, "Loop time of ");
        const char *number = of ? strstr(of, " for ") : NULL;
        if (number && sscanf(of, "Loop time of %lf", &spent) == 1 && sscanf(number, " for %ld steps", &found) == 1 &&
            found == step_count)
            *seconds = spent / step_count, known = true;
    }
    if (f) fclose(f);
    return known ? OK : status_set(FAILED, "bench peers: the log of lmp does not tell how long it took");
}

status peer_export_and_time_scene(const char *scene_text, int step_count, double *seconds)
{
    const char *scene = PEERS_FOLDER "/bonds.yaml", *folder = PEERS_FOLDER "/bonds";
    TRY(file_write_whole(scene, scene_text, strlen(scene_text)));
    TRY(export_lammps(&(struct export_request){
        .scene = scene, .folder = folder, .bond_style = true, .allow_different = true, .overwrite = true}));
    TRY(peer_run_lammps(folder, "in.lammps", "log.lammps"));
    return peer_read_seconds_per_step(PEERS_FOLDER "/bonds/log.lammps", step_count, seconds);
}
