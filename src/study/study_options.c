/* Stores the options with which a study was made in its folder, so that its page can print the command. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/memory_stream.h"
#include "output/output_files.h"
#include "study_internal.h"

/* Returns true if `word` is one of list[], which ends with NULL. */
static bool word_listed(const char *word, const char *const *list)
{
    for (; *list; list++)
        if (strcmp(word, *list) == 0) return true;
    return false;
}

/* Returns a copy of `text` in one line: line breaks are written as \n, and backslashes as \\. The caller releases it
 * with memory_free. */
static char *line_from_text(const char *text)
{
    char *line = NEW("study.options", 2 * (int64_t)strlen(text) + 1, char), *to = line;
    for (; *text; text++) {
        if (*text == '\\' || *text == '\n') *to++ = '\\';
        *to++ = *text == '\n' ? 'n' : *text;
    }
    *to = '\0';
    return line;
}

/* Replaces `line`, a text whose line breaks are written as \n and whose backslashes are written as \\, by the original
 * text, in place. */
static void line_to_text(char *line)
{
    char *to = line;
    for (const char *from = line; *from; from++) {
        const bool escaped = *from == '\\' && from[1];
        if (escaped) from++;
        *to++ = escaped && *from == 'n' ? '\n' : *from;
    }
    *to = '\0';
}

char *study_options_compose_from_arguments(int argc, char *const *argv, const char *scene)
{
    static const char *const silent[] = {"-q", "--overwrite", "--list", "--collect", NULL};
    static const char *const taking[] = {"-s",       "-j",     "-t",    "--of",     "--runs", "--levels",
                                         "--budget", "--size", "--dpi", "--format", NULL};
    char *text = NULL;
    size_t length = 0;
    int printed = 0;
    FILE *to = memory_stream_open(&text, &length);
    for (int k = 1; to && k < argc; k++) {
        if (argv[k] == scene || word_listed(argv[k], silent)) continue;
        if (strcmp(argv[k], "-o") == 0 && k++) continue;
        const int words = word_listed(argv[k], taking) && k + 1 < argc ? 2 : 1;
        for (int w = 0; w < words; w++) {
            if (printed++) putc(' ', to);
            study_print_word_quoted_for_shell(to, argv[k + w]);
        }
        k += words - 1;
    }
    char *line = to && fclose(to) == 0 ? line_from_text(text) : NULL;
    free(text);
    return line;
}

char *study_options_read(const char *folder)
{
    char *text;
    size_t length;
    const struct path path = path_join(folder, STUDY_SCENE);
    if (!path_is_file(path.text) || file_read_whole(path.text, &text, &length) != OK) return NULL;
    char *line = strstr(text, STUDY_OPTIONS_MARK), *end = strchr(text, '\n');
    const bool second = line && end && line == end + 1;
    if (second) {
        line += strlen(STUDY_OPTIONS_MARK);
        line[strcspn(line, "\n")] = '\0';
        memmove(text, line, strlen(line) + 1);
        line_to_text(text);
        return text;
    }
    memory_free(text);
    return NULL;
}
