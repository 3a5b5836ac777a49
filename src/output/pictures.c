/* Names of pictures: the one table of them. */
#include "output/pictures.h"

#include <stdio.h>
#include <string.h>

static const char *const picture_name[DRAWN_KINDS] = {
    [DRAWN_DAMAGE] = "damage", [DRAWN_KIND] = "kind",     [DRAWN_LAST] = "last", [DRAWN_PROFILES] = "profiles",
    [DRAWN_CRACK] = "crack",   [DRAWN_ENERGY] = "energy", [DRAWN_SIF] = "sif",   [DRAWN_PATH] = "path",
    [DRAWN_FRAGMENTS] = "fragments",
};

struct path pictures_folder(const char *dir) { return path_join(dir, "pictures"); }

/* `number` "" or _000012. */
static struct path picture_place(const char *dir, enum picture which, const char *number)
{
    char name[PATH_NAME_ROOM];
    const struct path folder = pictures_folder(dir);
    snprintf(name, sizeof name, "%s%s.png", picture_name[which], number);
    return folder.text[0] ? path_join(folder.text, name) : folder;
}

struct path picture_path(const char *dir, enum picture which) { return picture_place(dir, which, ""); }

struct path picture_path_of_frame(const char *dir, enum picture which, int number)
{
    char text[16];
    snprintf(text, sizeof text, "_%06d", number);
    return picture_place(dir, which, text);
}

bool is_picture(const char *name, const char *end)
{
    for (int k = 0; k < DRAWN_KINDS; k++) {
        const size_t length = strlen(picture_name[k]);
        if (strncmp(name, picture_name[k], length) != 0) continue;
        const char *rest = name + length;
        if (*rest == '_') rest += 1 + strspn(rest + 1, "0123456789");
        if (strncmp(rest, ".png", 4) == 0 && strcmp(rest + 4, end) == 0) return true;
    }
    return false;
}
