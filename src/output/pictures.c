/* File names of the pictures that `cleave plot` draws. */
#include "output/pictures.h"

#include <stdio.h>
#include <string.h>

/* File names of the standard pictures, without extension. */
static const char *const picture_name[DRAWN_KINDS] = {
    [DRAWN_DAMAGE] = "damage",     [DRAWN_KIND] = "kind",     [DRAWN_LAST] = "last",
    [DRAWN_PROFILES] = "profiles", [DRAWN_CRACK] = "crack",   [DRAWN_ENERGY] = "energy",
    [DRAWN_SIF] = "sif",           [DRAWN_PATH] = "path",     [DRAWN_FRAGMENTS] = "fragments",
    [DRAWN_SURFACE] = "surface",   [DRAWN_CRACKS] = "cracks", [DRAWN_LOAD] = "load_displacement",
    [DRAWN_R_CURVE] = "r_curve",
};
static const char field_prefix[] = "field_";

struct path pictures_folder(const char *run_folder) { return path_join(run_folder, "pictures"); }

/* Composes the path of a picture in a folder of pictures. of: base name of the picture; number: "" or the number of its
 * frame as "_000012"; ending: extension without the point. The path is empty if it is too long. */
static struct path picture_place(const char *folder, const char *of, const char *number, const char *ending)
{
    char name[PATH_NAME_ROOM];
    snprintf(name, sizeof name, "%s%s.%s", of, number, ending);
    return *folder ? path_join(folder, name) : (struct path){{0}};
}

struct path picture_path(const char *folder, enum picture kind, const char *ending)
{
    return picture_place(folder, picture_name[kind], "", ending);
}

struct path picture_path_of_frame(const char *folder, enum picture kind, int frame_number)
{
    char text[16];
    snprintf(text, sizeof text, "_%06d", frame_number);
    return picture_place(folder, picture_name[kind], text, "png");
}

struct path picture_path_of_field(const char *folder, const char *field, const char *ending)
{
    return picture_place(folder, field_prefix, field, ending);
}

/* Returns true if `rest`, a file name behind its base name, is the extension of a picture, such as .png, followed by
 * `end`. */
static bool ends_as_picture(const char *rest, const char *end)
{
    static const char *const ending[] = {".png", ".svg", ".pdf", ".mp4", ".gif"};
    for (size_t k = 0; k < COUNT_OF(ending); k++)
        if (strncmp(rest, ending[k], 4) == 0 && strcmp(rest + 4, end) == 0) return true;
    return false;
}

bool file_name_is_of_picture(const char *name, const char *ending)
{
    if (strncmp(name, field_prefix, sizeof field_prefix - 1) == 0)
        return ends_as_picture(name + strspn(name, "abcdefghijklmnopqrstuvwxyz_0123456789"), ending);
    for (int k = 0; k < DRAWN_KINDS; k++) {
        const size_t length = strlen(picture_name[k]);
        if (strncmp(name, picture_name[k], length) != 0) continue;
        const char *rest = name + length;
        if (*rest == '_') rest += 1 + strspn(rest + 1, "0123456789");
        if (ends_as_picture(rest, ending)) return true;
    }
    return false;
}
