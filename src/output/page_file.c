/* Recognises and removes the HTML pages that `cleave report` writes into results folders. */
#include "output/page_file.h"

#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "output/output_files.h"

bool report_page_is_from_cleave(const char *path)
{
    char begin[sizeof PAGE_BEGINNING - 1];
    struct stat s;
    const int fd = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (fd < 0) return false;
    const bool whole = fstat(fd, &s) == 0 && S_ISREG(s.st_mode) && read(fd, begin, sizeof begin) == sizeof begin;
    close(fd);
    return whole && memcmp(begin, PAGE_BEGINNING, sizeof begin) == 0;
}

void report_page_remove_from_folder(const char *folder)
{
    const struct path page = path_join(folder, PAGE_NAME);
    if (report_page_is_from_cleave(page.text)) unlink(page.text);
}
