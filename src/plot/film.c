/* Films by ffmpeg, which is started without a shell. */
#include "plot/film.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "output/output_files.h"

enum { NOT_FOUND = 127, FILM_WORDS = 24 };
static const char *const FRAMES_PER_SECOND = "8";

/* Child process: nothing on its streams but its complaints. */
static _Noreturn void become_ffmpeg(char *const *word)
{
    const int nothing = open("/dev/null", O_RDWR);
    dup2(nothing, STDIN_FILENO);
    dup2(nothing, STDOUT_FILENO);
    dup2(nothing, STDERR_FILENO);
    execvp("ffmpeg", word);
    _exit(NOT_FOUND);
}

/* Exit status of ffmpeg with these words; -1: it cannot be started, or a signal has ended it. */
static int ffmpeg_ends(char *const *word)
{
    int ended = 0;
    const pid_t process = fork();
    if (process == 0) become_ffmpeg(word);
    if (process < 0 || waitpid(process, &ended, 0) < 0) return -1;
    return WIFEXITED(ended) ? WEXITSTATUS(ended) : -1;
}

status film_possible(void)
{
    char *word[] = {"ffmpeg", "-version", NULL};
    return ffmpeg_ends(word) == 0 ? OK
                                  : status_set(REFUSED, "plot: films are made by ffmpeg, which is missing: install the "
                                                        "package ffmpeg, or take --format png");
}

/* Joins the pictures: of a film that plays everywhere (H.264, even sizes), or of a GIF by a palette of its own. */
static status join_pictures(struct sheet sheet, const char *pattern)
{
    const struct path aside = path_aside(sheet.path);
    char *mp4[] = {"ffmpeg", "-y", "-framerate", (char *)FRAMES_PER_SECOND, "-i", (char *)pattern, "-vf",
                   "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white", "-c:v", "libx264", "-pix_fmt", "yuv420p", "-bitexact",
                   "-f", "mp4", (char *)aside.text, NULL};
    char *gif[] = {"ffmpeg", "-y", "-framerate", (char *)FRAMES_PER_SECOND, "-i", (char *)pattern, "-vf",
                   "split[a][b];[a]palettegen[p];[b][p]paletteuse", "-bitexact", "-f", "gif", (char *)aside.text, NULL};
    const int ended = ffmpeg_ends(sheet.format == PICTURE_GIF ? gif : mp4);
    if (ended == 0 && rename(aside.text, sheet.path) == 0) return OK;
    remove(aside.text);
    return ended == 0 ? status_set(FAILED, "%s: %s", sheet.path, strerror(errno))
                      : status_set(FAILED, "%s: ffmpeg made no film of the pictures (status %d)", sheet.path, ended);
}

static void picture_of_film(char *path, size_t room, const char *folder, int k)
{
    snprintf(path, room, "%s/%06d.png", folder, k);
}

status film_draw(struct sheet sheet, const char *title, enum map map, const struct view *view,
                 const struct cloud *cloud, int clouds)
{
    char folder[PATH_ROOM], picture[PATH_ROOM + 32], pattern[PATH_ROOM + 32];
    if (snprintf(folder, sizeof folder, "%s.frames.XXXXXX", sheet.path) >= (int)sizeof folder)
        return status_set(FAILED, "%s: the name is too long", sheet.path);
    if (!mkdtemp(folder)) return status_set(FAILED, "%s: %s", folder, strerror(errno));
    snprintf(pattern, sizeof pattern, "%s/%%06d.png", folder);
    status s = strchr(folder, '%') ? status_set(REFUSED, "%s: ffmpeg takes no name with %%", sheet.path) : OK;
    for (int k = 0; s == OK && k < clouds; k++) {
        picture_of_film(picture, sizeof picture, folder, k);
        s = maps_draw((struct sheet){picture, PICTURE_PNG}, title, map, view, &cloud[k], 1);
    }
    if (s == OK) s = join_pictures(sheet, pattern);
    for (int k = 0; k < clouds; k++) {
        picture_of_film(picture, sizeof picture, folder, k);
        remove(picture);
    }
    rmdir(folder);
    return s;
}
