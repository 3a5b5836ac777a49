/* Target of fuzz.h: checkpoint files of arbitrary bytes with a footer that matches them. A run must refuse such a file
 * in one line, or continue from it for some steps. */
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "output/checksum.h"
#include "engine/engine.h"
#include "fuzz.h"
#include "base/memory.h"
#include "output/output_files.h"
#include "step/report.h"
#include "scene/scene_read.h"

enum { STEPS = 3 };
static const char text[] =
    "space: plane stress\nthickness: 1 mm\nduration: 4 us\nmaterial: {young: 190 GPa, density: 7800, "
    "energy_release_rate: 100}\n"
    "body: {box: {from: [0, 0], to: [8 mm, 6 mm]}}\nparticles: {spacing: 1 mm}\ntime: {step: 0.2 us}\n"
    "cracks: [{from: [0, 3 mm], to: [4 mm, 3 mm]}]\n"
    "boundary: [{name: pull, velocity: [free, 10], region: {box: {from: [0, 5 mm], to: [8 mm, 6 mm]}}}]\n"
    "output: {frames: 1, samples: 20, checkpoint: 0}\nprobes: [tip, break, reaction: {boundary: pull}]\n";
static struct scene scene;
static struct output out;

/* Sets up *run from the scene of this file, with output to the folder fuzz_run. Release it with run_free_memory. */
static void begin(struct run *run)
{
    if (!scene.text && scene_read_text(&scene, text, strlen(text), "fuzz", NULL, 0) != OK)
        fuzz_fail("the scene", status_message());
    *run = (struct run){0};
    if (run_set_up_from_scene(run, &scene, &out) != OK) fuzz_fail("the engine", status_message());
    run->report->quiet = true;
    if (!out.folder && output_open(&out, "fuzz_run", scene.text, OUTPUT_OVERWRITE, false) != OK)
        fuzz_fail("the folder", status_message());
}

uint8_t *fuzz_checkpoint_seed(size_t *n)
{
    struct run e;
    char *bytes = NULL;
    begin(&e);
    if (run_advance_to_end_time(&e) != OK || file_read_whole("fuzz_run/checkpoint.previous.h5", &bytes, n) != OK)
        fuzz_fail("the run", status_message());
    run_free_memory(&e);
    uint8_t *seed = malloc(*n);
    if (seed) memcpy(seed, bytes, *n -= FOOTER_BYTES);
    memory_free(bytes);
    return seed;
}

/* Writes bytes[n] with a matching checksum footer to fuzz_run/checkpoint.h5 and removes the previous checkpoint. */
static void put_checkpoint(const uint8_t *bytes, size_t n)
{
    static const char path[] = "fuzz_run/checkpoint.h5";
    unlink("fuzz_run/checkpoint.previous.h5");
    const int fd = open(path_of_temporary_file(path).text, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (fd < 0 || write(fd, bytes, n) != (ssize_t)n) fuzz_fail("cannot write", "");
    close(fd);
    if (file_append_checksum_footer(path) != OK || file_replace_by_temporary(path) != OK)
        fuzz_fail("cannot write", status_message());
}

void fuzz_checkpoint(const uint8_t *bytes, size_t n)
{
    struct run e;
    begin(&e);
    put_checkpoint(bytes, n);
    status_set(OK, "%s", "");
    status s = checkpoint_read(&out, scene.text, run_load_checkpoint, &e);
    if (s == OK) {
        e.report->out = NULL;
        if (e.clock.steps > e.clock.step && e.clock.step >= 0)
            e.clock.steps = e.clock.step + STEPS < e.clock.steps ? e.clock.step + STEPS : e.clock.steps;
        s = run_advance_to_end_time(&e);
    }
    if (s != OK && (!status_message()[0] || strchr(status_message(), '\n')))
        fuzz_fail("refused without a line", status_message());
    run_free_memory(&e);
}
