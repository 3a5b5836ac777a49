/* Names of the pictures of `cleave plot`, for what draws them and for what removes those of an older run. */
#ifndef CLEAVE_PICTURES
#define CLEAVE_PICTURES

#include "output_files.h"

enum picture {
    DRAWN_DAMAGE,
    DRAWN_KIND,
    DRAWN_LAST,
    DRAWN_PROFILES,
    DRAWN_CRACK,
    DRAWN_ENERGY,
    DRAWN_SIF,
    DRAWN_PATH,
    DRAWN_LOAD,
    DRAWN_R_CURVE,
    DRAWN_FRAGMENTS,
    DRAWN_SURFACE,
    DRAWN_CRACKS,
    DRAWN_KINDS
};

/* DIR/pictures, and NAME.png or NAME_000012.png in it, `dir` the folder of a run; empty where `dir` is too long. Other
 * formats have other endings. */
struct path pictures_folder(const char *dir);
struct path picture_path(const char *dir, enum picture which, const char *ending);
struct path picture_path_of_frame(const char *dir, enum picture which, int number);
/* Of a field: field_NAME. */
struct path picture_path_of_field(const char *dir, const char *field, const char *ending);

/* True for the name of a picture or film, NAME.png or NAME_000012.png, followed by `end`. */
bool is_picture(const char *name, const char *end);

#endif
