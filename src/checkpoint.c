/* floor 4: checkpoints: two whole files that guard the run against kills, full disks and damaged bytes.
 *
 * File: an HDF5 file with /Cleave (attribute `version`, dataset `scene`) and /state (one list of bytes per archive
 * entry), then 24 bytes: magic, number of bytes before, hash of all bytes before. HDF5 opens it as if they were not
 * there; it never sees a file whose hash is wrong. */
#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "memory.h"
#include "output.h"
#include "output_files.h"
#include "output_hdf5.h"

enum { CHECKPOINT_VERSION = 9, BLOCK = 1 << 20 };
static const char newest_name[] = "checkpoint.h5", previous_name[] = "checkpoint.previous.h5",
                  damaged_name[] = "checkpoint.damaged.h5";

/* ---- the footer ------------------------------------------------------------------------------------ */

struct footer { char magic[8]; uint64_t length, hash; };
_Static_assert(sizeof(struct footer) == 24, "the footer has no gaps");
static const char footer_magic[8] = {'C', 'L', 'E', 'A', 'V', 'E', 'O', 'K'};

/* Four lanes, because each step of one waits for its multiplication. */
enum { LANES_OF_HASH = 4, STRIDE = LANES_OF_HASH * 8 };
struct hash { uint64_t lane[LANES_OF_HASH], length; };

/* One step: after Fowler, Noll and Vo, on words instead of bytes, with a shift because a product carries only
 * upwards. Invertible in `lane` and in `word`: any change of one word changes the lane for good. */
static inline uint64_t hash_step(uint64_t lane, uint64_t word)
{
    lane = (lane ^ word) * UINT64_C(0x9E3779B97F4A7C15);
    return lane ^ lane >> 32;
}

static void hash_start(struct hash *h)
{
    for (int k = 0; k < LANES_OF_HASH; k++) h->lane[k] = UINT64_C(0xCBF29CE484222325) + (uint64_t)k;
    h->length = 0;
}

static void hash_strides(struct hash *h, const unsigned char *bytes, size_t strides)
{
    uint64_t a = h->lane[0], b = h->lane[1], c = h->lane[2], d = h->lane[3], word[LANES_OF_HASH];
    for (size_t k = 0; k < strides; k++) {
        memcpy(word, bytes + k * STRIDE, sizeof word);
        a = hash_step(a, word[0]);
        b = hash_step(b, word[1]);
        c = hash_step(c, word[2]);
        d = hash_step(d, word[3]);
    }
    h->lane[0] = a, h->lane[1] = b, h->lane[2] = c, h->lane[3] = d;
}

/* Adds bytes; only the last call may be with other than a multiple of STRIDE. */
static void hash_add(struct hash *h, const unsigned char *bytes, size_t length)
{
    unsigned char rest[STRIDE] = {0};
    size_t whole = length / STRIDE;
    hash_strides(h, bytes, whole);
    h->length += length;
    if (length == whole * STRIDE) return;
    memcpy(rest, bytes + whole * STRIDE, length - whole * STRIDE);
    hash_strides(h, rest, 1);
}

static uint64_t hash_value(const struct hash *h)
{
    uint64_t value = h->length;
    for (int k = 0; k < LANES_OF_HASH; k++) value = hash_step(value, h->lane[k]);
    return value;
}

/* Hash of the first `length` bytes of an open file; returns 0 or an errno. */
static int hash_file(int fd, uint64_t length, uint64_t *value)
{
    struct hash h;
    int fault = 0;
    unsigned char *block = NEW("checkpoint.block", BLOCK, unsigned char);
    hash_start(&h);
    for (uint64_t at = 0; at < length && !fault;) {
        size_t want = length - at < BLOCK ? (size_t)(length - at) : BLOCK, have = 0;
        while (have < want && !fault) {
            ssize_t done = pread(fd, block + have, want - have, (off_t)(at + have));
            if (done > 0) have += (size_t)done;
            else if (done == 0) fault = EIO;
            else if (errno != EINTR) fault = errno;
        }
        hash_add(&h, block, have);
        at += have;
    }
    memory_free(block);
    *value = hash_value(&h);
    return fault;
}

/* What is wrong with an open checkpoint, NULL if it is whole. */
static const char *footer_fault(int fd)
{
    struct stat s;
    struct footer end;
    uint64_t hash;
    if (fstat(fd, &s) != 0 || !S_ISREG(s.st_mode)) return "is no regular file";
    if (s.st_size == 0) return "is empty";
    if (s.st_size <= (off_t)sizeof end) return "is cut short";
    uint64_t length = (uint64_t)s.st_size - sizeof end;
    if (pread(fd, &end, sizeof end, (off_t)length) != (ssize_t)sizeof end) return "cannot be read";
    if (memcmp(end.magic, footer_magic, sizeof end.magic) != 0) return "is cut short or damaged (no end mark)";
    if (end.length != length) return "is damaged (its length is not the one it was written with)";
    if (hash_file(fd, length, &hash) != 0) return "cannot be read";
    return hash == end.hash ? NULL : "is damaged (its bytes are not those that were written)";
}

static const char *checkpoint_fault(const char *path)
{
    if (!path_exists(path)) return "is missing";
    /* Non-blocking, or a FIFO of this name would hang the program. */
    int fd = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (fd < 0) return errno == EACCES ? "may not be read" : "cannot be opened";
    const char *fault = footer_fault(fd);
    close(fd);
    return fault;
}

/* ---- archive entries ------------------------------------------------------------------------------- */

/* Entries are flat: '/' becomes '.', so that one entry's name may begin with another's. */
static void entry_path(char *path, size_t room, const char *name)
{
    int length = snprintf(path, room, "/state/%s", name);
    assert(length > 0 && (size_t)length < room);
    (void)length;
    for (char *c = path + strlen("/state/"); *c; c++) *c = *c == '/' ? '.' : *c;
}

/* A fault of the file itself is kept in struct hdf, and told by whoever opened it. */
static status entry_save(struct archive *a, const char *name, void *data, size_t size)
{
    struct hdf *f = a->file;
    char path[PATH_NAME_ROOM];
    entry_path(path, sizeof path, name);
    hdf_rows(f, path, HDF_U8, (int64_t)size, 1, data);
    return f->failed ? FAILED : OK;
}

static status entry_restore(struct archive *a, const char *name, void *data, size_t size)
{
    struct hdf *f = a->file;
    char path[PATH_NAME_ROOM];
    entry_path(path, sizeof path, name);
    int64_t stored = hdf_count(f, path);
    if (stored != (int64_t)size)
        return status_set(FAILED, "the checkpoint's entry %s has %lld bytes where this program needs %zu", name,
                          (long long)stored, size);
    hdf_read_rows(f, path, HDF_U8, stored, data);
    return f->failed ? status_set(FAILED, "the checkpoint's entry %s cannot be read", name) : OK;
}

static int64_t entry_size(struct archive *a, const char *name)
{
    char path[PATH_NAME_ROOM];
    entry_path(path, sizeof path, name);
    return hdf_count(a->file, path);
}

static struct archive archive_of(struct hdf *f, bool saving)
{
    return (struct archive){
        .saving = saving, .exchange = saving ? entry_save : entry_restore, .stored_size = entry_size, .file = f};
}

/* ---- writing --------------------------------------------------------------------------------------- */

/* Writes PATH.tmp but for its footer. */
static status state_write(struct output *o, const char *path, const char *scene_text, archive_all_fn *archive_all,
                          void *context)
{
    static const int32_t version = CHECKPOINT_VERSION;
    struct hdf f;
    hdf_create(&f, path_aside(path).text, false);
    hdf_group(&f, "/Cleave");
    hdf_mark_one(&f, "/Cleave", "version", HDF_I32, &version);
    hdf_rows(&f, "/Cleave/scene", HDF_U8, (int64_t)strlen(scene_text), 1, scene_text);
    hdf_group(&f, "/state");
    struct archive a = archive_of(&f, true);
    status s = f.failed ? FAILED : archive_all(context, &a);
    if (!f.failed) hdf_close(&f);
    if (!f.failed && s == OK) return OK;
    o->broken = f.failed;
    file_discard(path);
    return f.failed ? file_fault(path, f.cause) : s;
}

/* Hash of PATH.tmp, ready to be put behind it. */
static status footer_make(struct footer *end, const char *path)
{
    struct stat s;
    int fd = open(path_aside(path).text, O_RDONLY | O_CLOEXEC), fault = fd < 0 || fstat(fd, &s) != 0 ? errno : 0;
    memcpy(end->magic, footer_magic, sizeof end->magic);
    if (!fault) fault = hash_file(fd, end->length = (uint64_t)s.st_size, &end->hash);
    if (fd >= 0) close(fd);
    if (!fault) return OK;
    file_discard(path);
    return file_fault(path, fault);
}

/* A checkpoint counts on the samples before it: they must be on the disk first. */
static status history_sync(const struct output *o)
{
    if (!o->history || (fflush(o->history) == 0 && fsync(fileno(o->history)) == 0)) return OK;
    return file_fault(path_join(o->folder, "history.csv").text, errno);
}

status checkpoint_write(struct output *o, const char *scene_text, archive_all_fn *archive_all, void *context)
{
    struct path newest = path_join(o->folder, newest_name), previous = path_join(o->folder, previous_name);
    struct footer end = {{0}, 0, 0};
    TRY(output_wait(o));                 /* it counts on the frames before it, and HDF5 serves one thread at a time */
    if (o->broken) return FAILED;
    TRY(history_sync(o));
    TRY(state_write(o, newest.text, scene_text, archive_all, context));
    TRY(footer_make(&end, newest.text));
    /* Whole and on the disk before the older one gives up its name; a kill between the two renames leaves that
     * one as checkpoint.previous.h5. */
    TRY(file_seal(newest.text, &end, sizeof end));
    if (path_exists(newest.text) && rename(newest.text, previous.text) != 0) {
        int cause = errno;
        file_discard(newest.text);
        return file_fault(previous.text, cause);
    }
    return file_publish(newest.text);
}

/* ---- reading --------------------------------------------------------------------------------------- */

/* Does the open checkpoint hold this scene? */
static bool same_scene(struct hdf *f, const char *scene_text)
{
    int64_t length = hdf_count(f, "/Cleave/scene");
    if (length < 0 || (size_t)length != strlen(scene_text)) return false;
    char *stored = NEW("checkpoint.scene", length + 1, char);
    hdf_read_rows(f, "/Cleave/scene", HDF_U8, length, stored);
    bool same = !f->failed && memcmp(stored, scene_text, (size_t)length) == 0;
    memory_free(stored);
    return same;
}

static status state_read(const char *path, const char *scene_text, archive_all_fn *archive_all, void *context)
{
    struct hdf f;
    int32_t version = 0;
    hdf_open(&f, path);
    if (!f.failed) hdf_read_mark(&f, "/Cleave", "version", HDF_I32, &version);
    struct archive a = archive_of(&f, false);
    status s;
    if (f.failed) s = status_set(FAILED, "cannot resume: %s is no checkpoint of this program", path);
    else if (version != CHECKPOINT_VERSION)
        s = status_set(FAILED, "cannot resume: %s has format %d, this program reads format %d", path, (int)version,
                       CHECKPOINT_VERSION);
    else if (!same_scene(&f, scene_text))
        s = status_set(FAILED, "cannot resume: %s belongs to another scene; choose another -o", path);
    else s = archive_all(context, &a);
    hdf_close(&f);
    return s;
}

status checkpoint_read(const struct output *o, const char *scene_text, archive_all_fn *archive_all, void *context)
{
    struct path newest = path_join(o->folder, newest_name), previous = path_join(o->folder, previous_name);
    const char *fault = checkpoint_fault(newest.text);
    if (!fault) return state_read(newest.text, scene_text, archive_all, context);
    const char *older_fault = checkpoint_fault(previous.text);
    if (older_fault)
        return status_set(FAILED, "cannot resume: in %s %s %s and %s %s", o->folder, newest_name, fault, previous_name,
                          older_fault);
    fprintf(stderr, "%s %s: resuming from %s\n", newest.text, fault, previous_name);
    TRY(state_read(previous.text, scene_text, archive_all, context));
    /* Out of the way, or the next checkpoint would rename it over the whole one. */
    if (path_exists(newest.text) && rename(newest.text, path_join(o->folder, damaged_name).text) != 0)
        return file_fault(newest.text, errno);
    return OK;
}

bool checkpoint_exists(const char *folder)
{
    return path_exists(path_join(folder, newest_name).text) || path_exists(path_join(folder, previous_name).text);
}
