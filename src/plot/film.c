/* Makes films from pictures with ffmpeg. ffmpeg is started without a shell and reads the pictures from a pipe, so that
 * no folder of single pictures remains and no file name is interpreted as a pattern or an address. */
#include "plot/film.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/interrupt_cleanup.h"
#include "base/memory.h"
#include "output/output_files.h"
#include "output/picture_file.h"

/* NOT_FOUND: exit status of a child process whose program does not exist; FILM_WORDS: largest number of arguments of
 * ffmpeg. */
enum { NOT_FOUND = 127, FILM_WORDS = 24 };
static const int FRAMES_PER_SECOND = 8;

/* A running process of ffmpeg that reads pictures and writes a film. */
struct ffmpeg {
    int to, process;  /* standard input of ffmpeg, -1: closed; process id */
    FILE *complaints; /* standard error of ffmpeg */
};

/* Replaces the child process by ffmpeg with the arguments word[]. from: descriptor that becomes its standard input, -1
 * for none; complaints: descriptor of the file for its output and errors, -1 to discard them. Does not return. */
static _Noreturn void become_ffmpeg(char *const *word, int from, int complaints)
{
    const int nothing = open("/dev/null", O_RDWR);
    child_process_set_group_and_unblock_signals();
    signal(SIGPIPE, SIG_DFL);
    dup2(from < 0 ? nothing : from, STDIN_FILENO);
    dup2(complaints < 0 ? nothing : complaints, STDOUT_FILENO);
    dup2(complaints < 0 ? nothing : complaints, STDERR_FILENO);
    execvp("ffmpeg", word);
    _exit(NOT_FOUND);
}

status video_check_encoder_is_installed(void)
{
    char *word[] = {"ffmpeg", "-version", NULL};
    int ended = 0;
    const pid_t process = fork();
    if (process == 0) become_ffmpeg(word, -1, -1);
    const bool there = process > 0 && waitpid(process, &ended, 0) == process && WIFEXITED(ended) && !WEXITSTATUS(ended);
    return there ? OK
                 : status_set(REFUSED, "plot: films are made by ffmpeg, which is missing; install the package ffmpeg, "
                                       "or use --format png");
}

/* Creates a pipe and stores its descriptors in ends[2]. They are closed in programs that are started later. Returns
 * false and sets errno if the pipe cannot be created. */
static bool pipe_make(int *ends)
{
    if (pipe(ends) != 0) return false;
    for (int k = 0; k < 2; k++) fcntl(ends[k], F_SETFD, FD_CLOEXEC);
    return true;
}

/* Starts ffmpeg as the process *f, which writes the film with path and format `sheet` under a temporary name. The film
 * is in H.264 with even numbers of pixels, which most players require, or a GIF with a palette of its own. fps: frames
 * per second; 0: the default. Returns FAILED, with a message, if ffmpeg cannot be started. */
static status ffmpeg_start(struct ffmpeg *f, struct output_picture sheet, int fps)
{
    struct path to;
    char rate[16];
    const struct path aside = path_of_temporary_file(sheet.path);
    const bool gif = sheet.format == PICTURE_GIF;
    int ends[2];
    snprintf(rate, sizeof rate, "%d", fps ? fps : FRAMES_PER_SECOND);
    snprintf(to.text, sizeof to.text, "file:%.*s", (int)sizeof to.text - 6, aside.text);
    char *filter = gif ? "split[a][b];[a]palettegen[p];[b][p]paletteuse" : "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white";
    char *word[FILM_WORDS] = {"ffmpeg",     "-y",         "-nostdin", "-loglevel", "error", "-f",
                              "image2pipe", "-framerate", rate,       "-c:v",      "png",   "-i",
                              "pipe:0",     "-vf",        filter,     "-bitexact", "-f",    gif ? "gif" : "mp4",
                              to.text,      NULL};
    char *h264[] = {"-c:v", "libx264", "-pix_fmt", "yuv420p", "-f", "mp4", to.text, NULL};
    if (!gif) memcpy(word + 16, h264, sizeof h264);
    *f = (struct ffmpeg){.to = -1, .complaints = tmpfile()};
    if (!pipe_make(ends))
        return status_set(FAILED, "%s: cannot send frames to ffmpeg: %s", sheet.path, strerror(errno));
    interrupt_signals_block(true);
    f->process = (int)fork();
    if (f->process == 0) become_ffmpeg(word, ends[0], f->complaints ? fileno(f->complaints) : -1);
    const int cause = errno;
    if (f->process > 0) interrupt_cleanup_register(LEAVING_FILM, aside.text, f->process);
    interrupt_signals_block(false);
    close(ends[0]);
    f->to = ends[1];
    if (f->process < 0) return status_set(FAILED, "%s: ffmpeg cannot be started: %s", sheet.path, strerror(cause));
    return OK;
}

/* Writes the file with the path `picture` into the input of the process f. Returns FAILED, with a message, if the file
 * cannot be read, and FAILED with an empty message if ffmpeg has stopped reading, since the message of ffmpeg states
 * the cause. */
static status ffmpeg_feed(struct ffmpeg *f, const char *picture)
{
    char *bytes;
    size_t length, sent = 0;
    TRY(file_read_whole(picture, &bytes, &length));
    while (sent < length) {
        const ssize_t done = write(f->to, bytes + sent, length - sent);
        if (done < 0 && errno == EINTR) continue;
        if (done <= 0) break;
        sent += (size_t)done;
    }
    memory_free(bytes);
    return sent == length ? OK : status_set(FAILED, "%s", "");
}

/* Closes the input of the process f, waits until it ends, and renames the film from its temporary name to sheet.path,
 * its path. fed: status of writing the pictures into ffmpeg. Returns `fed` if it is not OK, and FAILED with the message
 * of ffmpeg if there is no film. Removes an incomplete film. */
static status ffmpeg_end(struct ffmpeg *f, struct output_picture sheet, status fed)
{
    char reason[256];
    int ended = 0;
    if (f->to >= 0) close(f->to);
    if (f->process > 0) waitpid((pid_t)f->process, &ended, 0);
    const bool made = f->process > 0 && WIFEXITED(ended) && WEXITSTATUS(ended) == 0;
    if (fed == OK && made)
        fed = picture_complete_and_rename_temporary(sheet.path, sheet.format);
    else if (f->process > 0 && f->complaints && (fed == OK || !status_message()[0])) {
        program_error_output_read_last_line(f->complaints, reason, sizeof reason);
        fed = status_set(FAILED, "%s: ffmpeg made no film: %s", sheet.path, reason);
    }
    if (fed != OK) file_discard_temporary(sheet.path);
    interrupt_cleanup_register(LEAVING_FILM, NULL, 0);
    if (f->complaints) fclose(f->complaints);
    return fed;
}

status video_draw_and_encode_frames(struct output_picture output, int fps, const char *title, enum map map,
                                    const struct view *view, const struct plotted_particles *frame_particles,
                                    int frame_count)
{
    struct ffmpeg f;
    struct path picture;
    const int length = snprintf(picture.text, sizeof picture.text, "%s" ASIDE_ENDING ".png", output.path);
    if (length >= (int)(sizeof picture.text - sizeof ASIDE_ENDING))
        return status_set(FAILED, "%s: the name is too long; choose a shorter one", output.path);
    TRY(file_check_replaceable(output.path));
    unlink(path_of_temporary_file(output.path).text); /* a link of this name is not followed */
    status s = ffmpeg_start(&f, output, fps);
    for (int k = 0; s == OK && k < frame_count; k++) {
        interrupt_cleanup_register(LEAVING_FRAME, picture.text, 0);
        s = picture_draw_panels_of_frames((struct output_picture){picture.text, PICTURE_PNG}, title, map, view,
                                          &frame_particles[k], 1);
        if (s == OK) s = ffmpeg_feed(&f, picture.text);
        unlink(picture.text);
        interrupt_cleanup_register(LEAVING_FRAME, NULL, 0);
    }
    return ffmpeg_end(&f, output, s);
}
