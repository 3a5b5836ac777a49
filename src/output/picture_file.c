/* Marks finished pictures as drawn by Cleave and checks that they are complete. The mark is near the end of a file, at
 * a position that viewers ignore. */
#define _GNU_SOURCE /* memmem */
#include "output/picture_file.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "output/output_files.h"

enum { END_LENGTH = 64, END_SLACK = 3 }; /* bytes in which the mark is sought; largest number of line feeds after it */

#define BYTES(text) text, sizeof text - 1

/* Describes one format of pictures: the bytes at the end of a complete file, and the mark by which Cleave recognises
 * its own pictures. The mark is a chunk, comment, box or extension that the format provides for such data. */
static const struct picture_end {
    const char *end; /* last bytes of a whole file; "": a sequence of boxes up to the length of the file */
    size_t end_length;
    const char *mark;
    size_t mark_length;
    bool before; /* the mark precedes the end, else it follows */
} ends[PICTURE_FORMATS] = {
    [PICTURE_PNG] = {BYTES("\0\0\0\0IEND\xAE\x42\x60\x82"), BYTES("\0\0\0\x0FtEXtSoftware\0cleave\x02\xEE\x55\xA2"),
                     true},
    [PICTURE_SVG] = {BYTES("</svg>"), BYTES("<!-- drawn by cleave -->\n"), false},
    [PICTURE_PDF] = {BYTES("%%EOF"), BYTES("% drawn by cleave\n"), false},
    [PICTURE_MP4] = {BYTES(""),
                     BYTES("\0\0\0\x17"
                           "freedrawn by cleave"),
                     false},
    [PICTURE_GIF] = {BYTES(";"),
                     BYTES("!\xFE\x0F"
                           "drawn by cleave\0"),
                     true},
};

/* Reads the last bytes of an open file fd of `length` bytes, at most `capacity`, to to[]. Returns their number; 0 on a
 * fault. */
static size_t read_end(int fd, int64_t length, char *to, size_t capacity)
{
    const size_t wanted = length < (int64_t)capacity ? (size_t)length : capacity;
    const ssize_t have = pread(fd, to, wanted, (off_t)(length - (int64_t)wanted));
    return have < 0 ? 0 : (size_t)have;
}

/* Returns true if the lengths of the boxes of a film (MP4) add up to `length`, the length of the open file fd
 * [byte]. */
static bool boxes_are_whole(int fd, int64_t length)
{
    int64_t at = 0;
    while (at < length) {
        unsigned char head[16];
        if (pread(fd, head, sizeof head, (off_t)at) < 8) return false;
        int64_t size = 0;
        for (int k = 0; k < 4; k++) size = size << 8 | head[k];
        if (size == 1)
            for (int k = 8; k < 16; k++) size = size << 8 | head[k];
        if (size < 8 || size > length - at) return false;
        at += size;
    }
    return length > 0;
}

/* Returns the offset at which the end of the open picture fd of `length` bytes begins, the last bytes that its format e
 * requires [byte]. For a format made of boxes it is the length of the file. Returns -1 if the file is incomplete. */
static int64_t find_end(int fd, int64_t length, const struct picture_end *e)
{
    char last[END_LENGTH];
    if (e->end_length == 0) return boxes_are_whole(fd, length) ? length : -1;
    const size_t have = read_end(fd, length, last, e->end_length + END_SLACK);
    size_t own = have;
    while (own > 0 && last[own - 1] == '\n') own--;
    if (own < e->end_length || memcmp(last + own - e->end_length, e->end, e->end_length) != 0) return -1;
    return length - (int64_t)(have - own + e->end_length);
}

/* Writes the mark of Cleave into the complete picture fd of format e, and synchronises the file with the disk. Returns
 * 0, the errno of a failure, or -1 if the picture is incomplete. */
static int mark_and_sync(int fd, const struct picture_end *e)
{
    char bytes[2 * END_LENGTH];
    struct stat s;
    if (fstat(fd, &s) != 0) return errno;
    const int64_t end = find_end(fd, s.st_size, e), at = e->before ? end : s.st_size;
    if (end < 0) return -1;
    size_t length = e->mark_length;
    memcpy(bytes, e->mark, length);
    if (e->before) memcpy(bytes + length, e->end, e->end_length), length += e->end_length;
    const ssize_t done = pwrite(fd, bytes, length, (off_t)at);
    if (done != (ssize_t)length) return done < 0 ? errno : ENOSPC;
    return fsync(fd) != 0 ? errno : 0;
}

status picture_complete_and_rename_temporary(const char *path, enum picture_format format)
{
    const int fd = open(path_of_temporary_file(path).text, O_RDWR | O_CLOEXEC | O_NOFOLLOW);
    int fault = fd < 0 ? errno : mark_and_sync(fd, &ends[format]);
    if (fd >= 0 && close(fd) != 0 && !fault) fault = errno;
    if (!fault) return file_replace_by_temporary(path);
    file_discard_temporary(path);
    if (fault > 0) return file_report_write_failure(path, fault);
    return status_set(
        FAILED,
        "cannot write %s: the picture is incomplete, perhaps because the disk is full; free space or choose another -o",
        path);
}

bool picture_file_is_from_cleave(const char *path)
{
    char last[END_LENGTH];
    struct stat s;
    bool ours = false;
    const int fd = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (fd < 0) return false;
    const size_t have = fstat(fd, &s) == 0 && S_ISREG(s.st_mode) ? read_end(fd, s.st_size, last, sizeof last) : 0;
    close(fd);
    for (int k = 0; k < PICTURE_FORMATS; k++) ours |= memmem(last, have, ends[k].mark, ends[k].mark_length) != NULL;
    return ours;
}

status picture_check_replaceable(const char *path)
{
    TRY(file_check_replaceable(path));
    if (!path_exists(path) || picture_file_is_from_cleave(path)) return OK;
    return status_set(REFUSED, "%s exists and was not drawn by cleave; move or remove it", path);
}
