/* Compares the texts of two input files (scenes), and reports the first line in which they differ. */
#define _GNU_SOURCE /* memmem */
#include "output/scene_text.h"

#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "output/output_files.h"

/* Finds the part of a line of scene.yaml that is compared to decide whether two scenes are equal. Returns a pointer to
 * its first character and stores its length in *length. It is the whole line. In a line with the hash of a file it is
 * the hash alone, since the path of the file may differ. */
static const char *line_meaning(const char *line, size_t *length)
{
    static const char mark[] = "  # contents ";
    *length = strcspn(line, "\n");
    const char *contents = memmem(line, *length, mark, sizeof mark - 1);
    if (contents) *length -= (size_t)(contents - line);
    return contents ? contents : line;
}

/* Compares two scenes, texts of scene.yaml that begin at *a and *b, line by line. Returns the number, from 1, of the
 * first line in which they differ, and sets *a and *b to the beginning of this line. Returns 0 if the scenes are
 * equal. */
static int scene_difference(const char **a, const char **b)
{
    for (int line = 1; **a || **b; line++) {
        size_t la, lb;
        const char *x = line_meaning(*a, &la), *y = line_meaning(*b, &lb);
        if (la != lb || memcmp(x, y, la) != 0) return line;
        *a += strcspn(*a, "\n"), *b += strcspn(*b, "\n");
        if (**a != **b) return line;
        if (**a) ++*a, ++*b;
    }
    return 0;
}

bool scene_texts_describe_same_scene(const char *a, const char *b) { return scene_difference(&a, &b) == 0; }

bool scene_text_is_from_cleave(const char *text) { return strncmp(text, "name: \"", 7) == 0; }

bool scene_file_describes_same_scene(const char *path, const char *scene_text)
{
    char *text;
    size_t length;
    if (!path_is_file(path) || file_read_whole(path, &text, &length) != OK) return false;
    const bool same = length == strlen(text) && scene_texts_describe_same_scene(text, scene_text);
    memory_free(text);
    return same;
}

/* Writes to path[capacity] the path of the key in the line of a scene.yaml that begins at `line`, down to the second
 * level of nesting: `thickness`, `mpm.cell`, `boundary[1]`. text: beginning of the file. */
static void key_path_of_line(const char *text, const char *line, char *path, size_t capacity)
{
    const char *top = text, *below = NULL;
    int item = -1;
    for (const char *c = text; c <= line && *c; c += strcspn(c, "\n"), c += *c == '\n') {
        if (*c != ' ')
            top = c, below = NULL, item = -1;
        else if (strncmp(c, "  - ", 4) == 0)
            item++;
        else if (c[1] == ' ' && c[2] != ' ')
            below = c + 2;
    }
    const int length = (int)strcspn(top, ":\n");
    if (item >= 0)
        snprintf(path, capacity, "%.*s[%d]", length, top, item);
    else
        snprintf(path, capacity, "%.*s%s%.*s", length, top, below ? "." : "", below ? (int)strcspn(below, ":\n") : 0,
                 below ? below : "");
}

status scene_texts_report_first_different_line(const char *folder, const char *former_text, const char *present_text)
{
    enum { SHOWN = 200 };
    static const char remedy[] = "repeat its options -s, or choose another -o or --overwrite";
    const char *a = former_text, *b = present_text;
    char key[100];
    size_t own;
    scene_difference(&a, &b);
    key_path_of_line(*b ? present_text : former_text, *b ? b : a, key, sizeof key);
    a += strspn(a, " -"), b += strspn(b, " -");
    const int la = (int)strcspn(a, "\n"), lb = (int)strcspn(b, "\n"), path = (int)(line_meaning(b, &own) - b);
    if (path > 0 && path < SHOWN && strncmp(a, b, (size_t)path) == 0)
        return status_set(REFUSED, "%s: %s contains the run of another scene: %.*s has changed; %s", key, folder, path,
                          b, remedy);
    const bool lasts = strncmp(a, "duration:", strlen("duration:")) == 0;
    return status_set(REFUSED, "%s: %s contains the run of another scene, with `%.*s` in place of `%.*s`%s; %s", key,
                      folder, la < SHOWN ? la : SHOWN, a, lb < SHOWN ? lb : SHOWN, b,
                      lasts ? ": a run cannot change its duration" : "", remedy);
}
