/* Tests checkpoints: restored state, and the effects of damaged bytes, of a kill while writing, and of a full disk. */
#include <errno.h>
#include <fcntl.h>
#include <omp.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/memory.h"
#include "output/output.h"
#include "output/output_files.h"
#include "output/output_hdf5.h"
#include "tests/robustness/trees.h"

static const char scene_text[] = "name: toy\nspace: plane stress\n";

/* ---- helpers ----------------------------------------------------------------------------------------------------- */

/* Opens the output o in `folder`, whose previous contents it removes. */
static void open_fresh(struct output *o, const char *folder)
{
    remove_tree(folder);
    assert_int_equal(output_open(o, folder, scene_text, OUTPUT_OVERWRITE, false), OK);
}

static void assert_message(const char *part)
{
    if (!strstr(status_message(), part)) fail_msg("message \"%s\" lacks \"%s\"", status_message(), part);
}

/* State of a test object: a step counter, an array whose length must be known before it is read, and an empty array. */
struct toy {
    struct output *out;
    int64_t step, n;
    real *value;
    int calls;
};

static status toy_archive(void *context, struct archive *a)
{
    struct toy *toy = context;
    toy->calls++;
    ARCHIVE_VALUE(a, "toy/step", toy->step);
    ARCHIVE_VALUE(a, "toy", toy->n); /* a prefix of the other names: no conflict */
    if (!a->saving) {
        int64_t size = a->stored_size(a, "toy/value");
        if (size != toy->n * (int64_t)sizeof(real))
            return status_set(FAILED, "toy/value has %lld bytes", (long long)size);
        toy->value = memory_resize("toy.value", toy->value, 0, toy->n, sizeof(real));
    }
    TRY(a->exchange(a, "toy/value", toy->value, (size_t)toy->n * sizeof(real)));
    TRY(a->exchange(a, "toy/nothing", toy->value, 0));
    assert_int_equal(a->stored_size(a, "toy/absent"), -1);
    return output_save_or_load(toy->out, a);
}

static struct toy toy_make(struct output *o, int64_t step, int64_t n)
{
    struct toy toy = {.out = o, .step = step, .n = n, .value = NEW("toy.value", n, real)};
    for (int64_t i = 0; i < n; i++) toy.value[i] = (real)(i * step);
    return toy;
}

static void toy_check(const struct toy *toy, int64_t step, int64_t n)
{
    assert_int_equal(toy->step, step);
    assert_int_equal(toy->n, n);
    for (int64_t i = 0; i < n; i++) assert_true(toy->value[i] == (real)(i * step));
}

/* Writes a checkpoint of the test object with n numbers to the output o at the step `step`. Returns the status of the
 * write. */
static status write_step(struct output *o, int64_t step, int64_t n)
{
    struct toy toy = toy_make(o, step, n);
    status s = checkpoint_write(o, scene_text, toy_archive, &toy);
    memory_free(toy.value);
    return s;
}

/* Restores the checkpoint of the output o into a new object with n numbers, and asserts that its state is that of step
 * `step`. */
static void assert_resumes_at(const struct output *o, int64_t step, int64_t n)
{
    struct output other = {0};
    struct toy toy = {.out = &other};
    assert_int_equal(checkpoint_read(o, scene_text, toy_archive, &toy), OK);
    toy_check(&toy, step, n);
    memory_free(toy.value);
    output_close(&other);
}

/* Asserts that no checkpoint of the output o is accepted, and that no byte of one reaches the state. */
static void assert_not_restored(const struct output *o)
{
    struct output other = {0};
    struct toy toy = {.out = &other};
    assert_int_equal(checkpoint_read(o, scene_text, toy_archive, &toy), FAILED);
    assert_int_equal(toy.calls, 0);
    output_close(&other);
}

static int64_t file_size(const char *path)
{
    struct stat s;
    assert_int_equal(stat(path, &s), 0);
    return s.st_size;
}

/* Inverts the byte at offset `at` of the file `path`; a second call restores it. */
static void flip(const char *path, int64_t at)
{
    unsigned char byte;
    int fd = open(path, O_RDWR);
    assert_true(fd >= 0);
    assert_int_equal(pread(fd, &byte, 1, at), 1);
    byte ^= (unsigned char)(1u << at % 8);
    assert_int_equal(pwrite(fd, &byte, 1, at), 1);
    close(fd);
}

/* ---- restored data ----------------------------------------------------------------------------------------------- */

/* Checks that a checkpoint restores the state of a run and of its output, and that none is found before the first
 * one. */
static void state_comes_back(void **state)
{
    (void)state;
    struct output o, back = {0};
    open_fresh(&o, "state");
    assert_false(checkpoint_exists("state"));
    assert_not_restored(&o);
    o.series[0].frames = 3, o.history_bytes = 1234;
    o.series[0].entry = NEW("frames", 3, struct frame_entry);
    o.series[0].entry[2] = (struct frame_entry){.time = 0.1, .rows = 99, .fields = 7, .particles = 1};
    o.series[0].particles.number = 1, o.series[0].particles.content = -123;
    struct toy toy = toy_make(&o, 5, 1000), other = {.out = &back};
    assert_int_equal(checkpoint_write(&o, scene_text, toy_archive, &toy), OK);
    assert_true(checkpoint_exists("state"));
    assert_int_equal(checkpoint_read(&o, scene_text, toy_archive, &other), OK);
    toy_check(&other, 5, 1000);
    assert_int_equal(back.series[0].frames, 3);
    assert_memory_equal(back.series[0].entry, o.series[0].entry, 3 * sizeof(struct frame_entry));
    assert_int_equal(back.series[0].particles.number, 1);
    assert_int_equal(back.series[0].particles.content, -123);
    assert_int_equal(back.history_bytes, 1234);
    memory_free(toy.value);
    memory_free(other.value);
    output_close(&back);
    output_close(&o);
}

/* Checks that HDF5 opens a checkpoint although a checksum footer follows its data. */
static void hdf5_ignores_the_footer(void **state)
{
    (void)state;
    struct output o;
    struct hdf f;
    int64_t step = 0;
    open_fresh(&o, "footer");
    assert_int_equal(write_step(&o, 5, 10), OK);
    hdf_open_for_reading(&f, "footer/checkpoint.h5");
    hdf_read_rows(&f, "/state/toy.step", HDF_U8, sizeof step, &step);
    assert_false(f.failed);
    assert_int_equal(step, 5);
    hdf_close(&f);
    output_close(&o);
}

/* ---- damage ------------------------------------------------------------------------------------------------------ */

/* Checks that a checkpoint with one changed byte is refused, for 4000 offsets and each of the last 100. */
static void every_flip_is_found(void **state)
{
    (void)state;
    static const char path[] = "flip/checkpoint.h5";
    struct output o;
    open_fresh(&o, "flip");
    assert_int_equal(write_step(&o, 5, 500), OK);
    int64_t size = file_size(path), stride = size / 4000 + 1;
    for (int64_t at = 0; at < size; at += at < size - 100 ? stride : 1) {
        flip(path, at);
        assert_not_restored(&o);
        flip(path, at);
    }
    assert_resumes_at(&o, 5, 500);
    output_close(&o);
}

static void every_truncation_is_found(void **state)
{
    (void)state;
    static const char path[] = "short/checkpoint.h5";
    struct output o;
    open_fresh(&o, "short");
    assert_int_equal(write_step(&o, 5, 500), OK);
    for (int64_t size = file_size(path) - 1; size >= 0; size -= size > 100 ? 37 : 1) {
        assert_int_equal(truncate(path, size), 0);
        assert_not_restored(&o);
    }
    output_close(&o);
}

/* Restores step `step` of the output o with standard error redirected to a file. Returns the contents of this file, to
 * be freed. n: as in assert_resumes_at. */
static char *said_by_resume(const struct output *o, int64_t step, int64_t n)
{
    char *text;
    size_t length;
    int kept = dup(2), fd = open("said", O_CREAT | O_TRUNC | O_WRONLY, 0666);
    assert_true(kept >= 0 && fd >= 0 && dup2(fd, 2) == 2);
    assert_resumes_at(o, step, n);
    fflush(stderr);
    dup2(kept, 2);
    close(kept);
    close(fd);
    assert_int_equal(file_read_whole("said", &text, &length), OK);
    return text;
}

static void older_checkpoint_stands_in(void **state)
{
    (void)state;
    struct output o;
    open_fresh(&o, "older");
    assert_int_equal(write_step(&o, 5, 100), OK);
    assert_int_equal(write_step(&o, 6, 100), OK);
    flip("older/checkpoint.h5", 3000);
    char *said = said_by_resume(&o, 5, 100);
    assert_non_null(strstr(said, "older/checkpoint.h5 is damaged"));
    assert_non_null(strstr(said, "resuming from checkpoint.previous.h5"));
    memory_free(said);
    /* The damaged file is renamed, so that the next checkpoint does not replace the valid older one. */
    assert_int_equal(write_step(&o, 7, 100), OK);
    unlink("older/checkpoint.h5"); /* as after a kill between the two renames */
    said = said_by_resume(&o, 5, 100);
    assert_non_null(strstr(said, "older/checkpoint.h5 is missing"));
    memory_free(said);
    output_close(&o);
}

static void strange_files_are_refused(void **state)
{
    (void)state;
    static const char path[] = "strange/checkpoint.h5";
    struct output o;
    open_fresh(&o, "strange");
    assert_int_equal(file_write_whole(path, "", 0), OK);
    assert_not_restored(&o);
    assert_message("the file checkpoint.h5 is empty, and the previous one, checkpoint.previous.h5, is missing");
    unlink(path);
    assert_int_equal(mkdir(path, 0777), 0);
    assert_not_restored(&o);
    assert_message("checkpoint.h5 is not a regular file");
    rmdir(path);
    assert_int_equal(mkfifo(path, 0666), 0);
    assert_not_restored(&o);
    assert_message("checkpoint.h5 is not a regular file");
    output_close(&o);
}

static void other_scenes_are_refused(void **state)
{
    (void)state;
    struct output o, other = {0};
    struct toy toy = {.out = &other};
    open_fresh(&o, "scene");
    assert_int_equal(write_step(&o, 5, 100), OK);
    assert_int_equal(checkpoint_read(&o, "name: other\n", toy_archive, &toy), FAILED);
    assert_message("belongs to another scene");
    assert_int_equal(toy.calls, 0);
    output_close(&o);
}

/* Saves the state in a valid file with a correct footer but a format version of the future. */
static status future_archive(void *context, struct archive *a)
{
    int32_t version = 1000;
    struct hdf *hdf = a->file;
    (void)context;
    if (H5Adelete_by_name(hdf->file, "/Cleave", "version", H5P_DEFAULT) < 0) return FAILED;
    hdf_write_scalar_attribute(hdf, "/Cleave", "version", HDF_I32, &version);
    return OK;
}

static void future_formats_are_refused(void **state)
{
    (void)state;
    struct output o;
    open_fresh(&o, "future");
    assert_int_equal(checkpoint_write(&o, scene_text, future_archive, NULL), OK);
    assert_not_restored(&o);
    assert_message("has format 1000, but this program reads only format 20");
    output_close(&o);
}

static status limits_archive(void *context, struct archive *a)
{
    int64_t step = 8;
    (void)context;
    ARCHIVE_VALUE(a, "toy/step", step);
    return status_set(FAILED, "the toy is broken");
}

static void fault_of_a_module_loses_nothing(void **state)
{
    (void)state;
    struct output o;
    open_fresh(&o, "module");
    assert_int_equal(write_step(&o, 5, 100), OK);
    assert_int_equal(checkpoint_write(&o, scene_text, limits_archive, NULL), FAILED);
    assert_message("the toy is broken");
    assert_false(path_exists("module/checkpoint.h5.cleave.tmp"));
    assert_resumes_at(&o, 5, 100);
    assert_int_equal(write_step(&o, 6, 100), OK);
    assert_resumes_at(&o, 6, 100);
    output_close(&o);
}

/* ---- a full disk ------------------------------------------------------------------------------------------------- */

/* Checks in a child process that every write to the output o fails without a crash. frame_first: true to write a frame
 * before the checkpoint. Returns the number of the first violated expectation, or 0. */
static int write_to_full_disk(struct output *o, bool frame_first)
{
    struct particles p;
    struct rlimit limit = {.rlim_cur = 20000, .rlim_max = RLIM_INFINITY};
    omp_set_num_threads(1); /* the thread team exists only in the parent */
    particles_make(&p, 2, 5000, 0);
    for (int64_t i = 0; i < p.n; i++) p.id[i] = (int32_t)i;
    if (setrlimit(RLIMIT_FSIZE, &limit) != 0) return 1;
    const char *expected = "cannot write full/checkpoint.h5: File too large; free space or choose another -o";
    status s;
    if (frame_first) {
        expected = "cannot write full/frames/particles_000000.h5: File too large; free space or choose another -o";
        s = output_write_frame(o, &p, 0, 0, scene_text);
    } else
        s = write_step(o, 7, 5000);
    if (s != FAILED) return 2;
    if (strcmp(status_message(), expected) != 0) return 3;
    /* HDF5 is not called again, and the first message is kept. */
    if (output_write_frame(o, &p, 0, 0, scene_text) != FAILED || write_step(o, 7, 1) != FAILED) return 4;
    if (strcmp(status_message(), expected) != 0) return 5;
    if (path_exists("full/checkpoint.h5.cleave.tmp") || path_exists("full/frames/particles_000000.h5.cleave.tmp"))
        return 6;
    particles_free(&p);
    return 0;
}

static void full_disk_loses_nothing(void **state)
{
    (void)state;
    struct output o;
    open_fresh(&o, "full");
    assert_int_equal(write_step(&o, 5, 100), OK);
    assert_int_equal(write_step(&o, 6, 100), OK);
    for (int frame_first = 0; frame_first < 2; frame_first++) {
        int ended = 0;
        fflush(NULL);
        pid_t child = fork();
        if (child == 0) exit(write_to_full_disk(&o, frame_first)); /* exit: HDF5's handlers must not crash */
        assert_true(child > 0);
        assert_int_equal(waitpid(child, &ended, 0), child);
        assert_true(WIFEXITED(ended));
        assert_int_equal(WEXITSTATUS(ended), 0);
    }
    assert_resumes_at(&o, 6, 100);
    assert_false(path_exists("full/frames/000000.hdf"));
    unlink("full/checkpoint.h5");
    char *said = said_by_resume(&o, 5, 100);
    memory_free(said);
    output_close(&o);
}

static int start(void **state)
{
    (void)state;
    output_install_signal_handling_for_file_writes();
    return 0;
}

int main(int argc, char **argv)
{
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(state_comes_back),
        cmocka_unit_test(hdf5_ignores_the_footer),
        cmocka_unit_test(every_flip_is_found),
        cmocka_unit_test(every_truncation_is_found),
        cmocka_unit_test(older_checkpoint_stands_in),
        cmocka_unit_test(strange_files_are_refused),
        cmocka_unit_test(other_scenes_are_refused),
        cmocka_unit_test(future_formats_are_refused),
        cmocka_unit_test(fault_of_a_module_loses_nothing),
        cmocka_unit_test(full_disk_loses_nothing),
    };
    (void)argc;
    if (!enter_folder_beside(argv[0], "test_checkpoint.files")) return 1;
    int failed = cmocka_run_group_tests(tests, start, NULL);
    if (failed == 0 && chdir("..") == 0) remove_tree("test_checkpoint.files");
    return failed;
}
