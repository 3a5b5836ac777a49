/* Names of the pictures of `cleave plot`, for the code that draws them and the code that removes those of an older
 * run. */
#ifndef CLEAVE_PICTURES
#define CLEAVE_PICTURES

#include "output_files.h"

/* The standard pictures of a run; DRAWN_KINDS: number of them. */
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

/* Returns the path DIR/pictures of the folder for pictures of the run in the folder `run_folder`; an empty path if it
 * would be too long. */
struct path pictures_folder(const char *run_folder);

/* Returns the path NAME.ENDING of a picture in `folder`, a folder of pictures; an empty path if it would be too long.
 * kind: kind of picture, which determines NAME; ending: "png", "svg" and so on. */
struct path picture_path(const char *folder, enum picture kind, const char *ending);

/* Returns the path NAME_000012.png of the picture of the frame (stored state) with number `frame_number`, here 12, in
 * `folder`, a folder of pictures; an empty path if it would be too long. kind: kind of picture, which determines
 * NAME. */
struct path picture_path_of_frame(const char *folder, enum picture kind, int frame_number);

/* Returns the path field_NAME.ENDING of a picture of the field called NAME = field in `folder`, a folder of pictures;
 * an empty path if it would be too long. ending: "png", "svg" and so on. */
struct path picture_path_of_field(const char *folder, const char *field, const char *ending);

/* Returns true if `name` is the file name of a picture or film that Cleave draws, such as NAME.png or NAME_000012.png,
 * followed by the text `ending` ("": nothing). */
bool file_name_is_of_picture(const char *name, const char *ending);

#endif
