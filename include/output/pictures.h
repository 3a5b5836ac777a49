/* Names of the pictures of `cleave plot`, for the code that draws them and the code that removes those of an older
 * run. */
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

/* Returns DIR/pictures, the folder of pictures of the run in `dir`. */
struct path pictures_folder(const char *dir);

/* Returns DIR/pictures/NAME.ENDING; empty if `dir` is too long. ending: "png", "svg" and so on. */
struct path picture_path(const char *dir, enum picture which, const char *ending);

/* Returns the path of the picture of one frame, DIR/pictures/NAME_000012.png; empty if `dir` is too long. number:
 * number of the frame. */
struct path picture_path_of_frame(const char *dir, enum picture which, int number);

/* Returns the path of the picture of a field, DIR/pictures/field_NAME.ENDING; empty if `dir` is too long. */
struct path picture_path_of_field(const char *dir, const char *field, const char *ending);

/* Returns true if `name` is that of a picture or film, NAME.png or NAME_000012.png, followed by `end`. */
bool is_picture(const char *name, const char *end);

#endif
