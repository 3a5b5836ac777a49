/* Implements `cleave new`: writes a commented scene as a template, of one of the kinds in inputs/new/. */
#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "base/edit_distance.h"
#include "commands.h"

/* Templates of input files by kind: name and description of the kind, and text of the template. */
static const struct kind {
    const char *name, *meaning, *text;
} kinds[] = {
#include "new_scenes.h"
};

/* The surface that the kind stl reads, with this file name. */
static const char part[] =
#include "new_part.h"
    ;
static const char part_file[] = "stl.stl";

/* Longest path of a new input file, without its ending [byte]. */
enum { PATH_LONGEST = 1000 };

static status kinds_print(void)
{
    printf("cleave new NAME [KIND] writes NAME.yaml, a scene of one of these kinds:\n");
    for (const struct kind *k = kinds; k < kinds + COUNT_OF(kinds); k++) printf("  %-10s %s\n", k->name, k->meaning);
    return OK;
}

/* Finds the kind of scene called `name` and stores a pointer to it, which is static, in *found. Returns REFUSED if no
 * kind has this name; the message contains the most similar name if it is similar enough to be a misspelling. */
static status kind_find(const char *name, const struct kind **found)
{
    const struct kind *nearest = kinds;
    for (*found = kinds; *found < kinds + COUNT_OF(kinds); ++*found) {
        if (!strcmp((*found)->name, name)) return OK;
        if (edit_distance((*found)->name, name) < edit_distance(nearest->name, name)) nearest = *found;
    }
    const bool similar = word_is_probable_misspelling_of(name, nearest->name);
    return status_set(REFUSED, "there is no kind %.40s; %s%s%s`cleave new` lists all kinds", name,
                      similar ? "did you mean " : "", similar ? nearest->name : "", similar ? "? " : "");
}

/* Checks the path of a new scene. *name: receives the first letter of the file name in `path`; *length: receives the
 * length of `path` without the ending .yaml. Returns REFUSED, with a message, unless the file name without this ending
 * is valid as the name of a run. */
static status check_path(const char *path, int *length, const char **name)
{
    const char *slash = strrchr(path, '/');
    *name = slash ? slash + 1 : path;
    *length = (int)strlen(path);
    if (*length > 5 && !strcmp(path + *length - 5, ".yaml")) *length -= 5;
    const int letters = *length - (int)(*name - path);
    bool fine = letters > 0 && letters < NAME_MAX_LENGTH && **name != '-' && *length < PATH_LONGEST;
    for (int k = 0; k < letters; k++) fine &= isalnum((unsigned char)(*name)[k]) || strchr("_-", (*name)[k]);
    if (fine) return OK;
    return status_set(REFUSED, "%s is not a valid name of a scene; use letters, digits, _ and -",
                      printable_name(path).text);
}

static void scene_write(FILE *out, const struct kind *k, const char *path, const char *name)
{
    char schema[4096];
    if (json_schema_find_file_path(schema, sizeof schema)) fprintf(out, "# yaml-language-server: $schema=%s\n", schema);
    fprintf(out,
            "# %s\n#\n"
            "# cleave check %s    says what it costs, and whether it is sound\n"
            "# cleave run %s      runs it\n"
            "# cleave plot results/%.*s    draws it\n"
            "# cleave help KEY    says what a key is for; cleave help lists all\n",
            k->meaning, path, path, (int)strcspn(name, "."), name);
    const char *file = strstr(k->text, part_file);
    const int before = file ? (int)(file - k->text) : 0;
    if (file)
        fprintf(out, "%.*s%.*s.stl%s", before, k->text, (int)strcspn(name, "."), name, file + strlen(part_file));
    else
        fputs(k->text, out);
}

/* Creates the file `path` and opens it for writing, as *out. Returns REFUSED, with a message, if the file exists or
 * cannot be created. */
static status file_open(FILE **out, const char *path)
{
    *out = fopen(path, "wx");
    if (*out) return OK;
    if (errno == EEXIST)
        return status_set(REFUSED, "the file %s exists and is not replaced; choose another name", path);
    return status_set(REFUSED, "%s: %s; choose a folder that can be written", path, strerror(errno));
}

static status file_close(FILE *out, const char *path)
{
    const bool whole = !ferror(out);
    if (fclose(out) == 0 && whole) return OK;
    remove(path);
    return status_set(FAILED, "%s: cannot be written", path);
}

/* File name of the surface that belongs to an input file: NAME.stl for NAME.yaml, returned by value. */
struct part_name {
    char text[PATH_LONGEST + 8];
};
static struct part_name part_path(const char *path)
{
    struct part_name file;
    snprintf(file.text, sizeof file.text, "%.*s.stl", (int)strlen(path) - 5, path);
    return file;
}

/* Writes the surface NAME.stl that belongs to the input file at `path`. Does nothing and returns OK if input files of
 * the kind k read no surface. Returns REFUSED if the file exists, FAILED if it cannot be written, with a message. */
static status part_write(const struct kind *k, const char *path)
{
    FILE *out;
    if (!strstr(k->text, part_file)) return OK;
    TRY(file_open(&out, part_path(path).text));
    fputs(part, out);
    return file_close(out, part_path(path).text);
}

void command_new_print_names_of_scene_kinds(FILE *out)
{
    for (size_t k = 0; k < COUNT_OF(kinds); k++) fprintf(out, "%s%s", k ? " " : "", kinds[k].name);
}

status command_new_main(int argc, char **argv)
{
    char path[PATH_LONGEST + 8];
    const struct kind *kind;
    const char *name;
    FILE *out;
    int length;
    if (argc > 3) return status_set(REFUSED, "usage: cleave new NAME [KIND]");
    if (argc == 1) return kinds_print();
    TRY(check_path(argv[1], &length, &name));
    snprintf(path, sizeof path, "%.*s", length, argv[1]);
    name = path + (name - argv[1]);
    const bool named = argc == 2 && kind_find(name, &kind) == OK; /* cleave new bar */
    if (!named) TRY(kind_find(argc == 3 ? argv[2] : "crack", &kind));
    strcat(path, ".yaml");
    TRY(file_open(&out, path));
    status written = part_write(kind, path);
    const bool parted = written == OK && strstr(kind->text, part_file);
    if (written == OK)
        scene_write(out, kind, path, name), written = file_close(out, path);
    else
        fclose(out), remove(path);
    if (written != OK && parted) remove(part_path(path).text);
    TRY(written);
    printf("%s: %s\ncleave run %s runs it\n", path, kind->meaning, path);
    return OK;
}
