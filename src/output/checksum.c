/* Computes hashes of files, and writes and checks the footer by which damaged files are recognised. */
#include "output/checksum.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "output/output_files.h"

enum { BLOCK = 1 << 14 }; /* size of a read [byte]: fits the stack of any thread; a multiple of STRIDE */

/* ---- the hash ---------------------------------------------------------------------------------------------------- */

/* LANES_OF_HASH: number of lanes of the hash, which are computed independently, because each step of a lane must wait
 * for the multiplication of the previous step. STRIDE: number of bytes that are added to all lanes at once, 8 to
 * each. */
enum { LANES_OF_HASH = 4, STRIDE = LANES_OF_HASH * 8 };
/* Intermediate state of the hash of a file: its lanes, and the number of bytes that have been added. */
struct hash {
    uint64_t lane[LANES_OF_HASH], length;
};

/* Returns `lane`, one of the lanes of the hash, after `word` has been mixed into it: the hash of Fowler, Noll and Vo
 * (FNV-1a) on 64-bit words instead of bytes, with an additional shift because a product carries only to higher bits. It
 * is invertible in `lane` and in `word`: a change of one word changes the lane in all later steps. */
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

/* Adds `strides` blocks of STRIDE bytes each to the hash h. A block consists of 64-bit words, one for each lane of the
 * hash: word k is added to lane k. */
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

/* Adds bytes[length] to the hash h. If `length` is no multiple of STRIDE, the last block is filled up with zeros. */
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

uint64_t bytes_hash(uint64_t previous_hash, const void *bytes, size_t length)
{
    struct hash h;
    hash_start(&h);
    hash_add(&h, (const unsigned char *)&previous_hash, sizeof previous_hash);
    hash_add(&h, bytes, length);
    return hash_value(&h);
}

/* Computes *value, the hash of the first `length` bytes of the open file fd. Returns 0, or an errno if the file
 * cannot be read. */
static int hash_file(int fd, uint64_t length, uint64_t *value)
{
    struct hash h;
    int fault = 0;
    unsigned char block[BLOCK];
    hash_start(&h);
    for (uint64_t at = 0; at < length && !fault;) {
        size_t want = length - at < BLOCK ? (size_t)(length - at) : BLOCK, have = 0;
        while (have < want && !fault) {
            ssize_t done = pread(fd, block + have, want - have, (off_t)(at + have));
            if (done > 0)
                have += (size_t)done;
            else if (done == 0)
                fault = EIO;
            else if (errno != EINTR)
                fault = errno;
        }
        hash_add(&h, block, have);
        at += have;
    }
    *value = hash_value(&h);
    return fault;
}

/* ---- the footer -------------------------------------------------------------------------------------------------- */

/* Last bytes of every file that Cleave can check: a constant that identifies such files, the length of the file before
 * the footer [byte], and the hash of these bytes. */
struct footer {
    char magic[8];
    uint64_t length, hash;
};
_Static_assert(sizeof(struct footer) == FOOTER_BYTES, "the footer has no gaps");
static const char footer_magic[8] = {'C', 'L', 'E', 'A', 'V', 'E', 'O', 'K'};

static const char unread[] = "cannot be read";

bool file_has_checksum_footer(const char *path)
{
    struct stat s;
    struct footer end;
    const int fd = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (fd < 0) return false;
    const bool has = fstat(fd, &s) == 0 && S_ISREG(s.st_mode) && s.st_size > (off_t)sizeof end &&
                     pread(fd, &end, sizeof end, s.st_size - (off_t)sizeof end) == (ssize_t)sizeof end &&
                     memcmp(end.magic, footer_magic, sizeof end.magic) == 0;
    close(fd);
    return has;
}

/* Checks length and hash of the open file fd against its footer. Returns NULL if the file is complete and unchanged,
 * else a phrase for a message, such as "is empty". */
static const char *open_fault(int fd)
{
    struct stat s;
    struct footer end;
    uint64_t hash;
    if (fstat(fd, &s) != 0 || !S_ISREG(s.st_mode)) return "is not a regular file";
    if (s.st_size == 0) return "is empty";
    if (s.st_size <= (off_t)sizeof end) return "is cut short";
    uint64_t length = (uint64_t)s.st_size - sizeof end;
    if (pread(fd, &end, sizeof end, (off_t)length) != (ssize_t)sizeof end) return unread;
    if (memcmp(end.magic, footer_magic, sizeof end.magic) != 0) return "is cut short or damaged (no end mark)";
    if (end.length != length) return "is damaged (its length has changed since it was written)";
    if (hash_file(fd, length, &hash) != 0) return unread;
    return hash == end.hash ? NULL : "is damaged (its bytes have changed since it was written)";
}

const char *file_describe_damage(const char *path)
{
    if (!path_exists(path)) return "is missing";
    /* Open without blocking: a FIFO of this name would otherwise stop the program. */
    const int fd = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (fd < 0) return errno == ENOENT ? "is a link to a missing file" : unread;
    const char *fault = open_fault(fd);
    close(fd);
    return fault;
}

const char *file_describe_damage_ignoring_read_errors(const char *path)
{
    const char *fault = file_describe_damage(path);
    return fault == unread ? NULL : fault;
}

status file_append_checksum_footer(const char *path)
{
    struct stat s;
    struct footer end = {{0}, 0, 0};
    const int fd = open(path_of_temporary_file(path).text, O_RDONLY | O_CLOEXEC);
    int fault = fd < 0 || fstat(fd, &s) != 0 ? errno : 0;
    memcpy(end.magic, footer_magic, sizeof end.magic);
    if (!fault) fault = hash_file(fd, end.length = (uint64_t)s.st_size, &end.hash);
    if (fd >= 0) close(fd);
    if (!fault) return file_append_and_sync(path, &end, sizeof end);
    file_discard_temporary(path);
    return file_report_write_failure(path, fault);
}

status file_contents_hash(const char *path, uint64_t *hash)
{
    struct stat s;
    const int fd = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    int fault = fd < 0 || fstat(fd, &s) != 0 ? errno : 0;
    if (!fault && !S_ISREG(s.st_mode)) fault = EINVAL;
    if (!fault) fault = hash_file(fd, (uint64_t)s.st_size, hash);
    if (fd >= 0) close(fd);
    if (!fault) return OK;
    return status_set(REFUSED, "%s: %s", path, fault == EINVAL ? "is not a regular file" : strerror(fault));
}
