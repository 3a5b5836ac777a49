/* Comparison of the texts of scenes, as scene.yaml in the folder of a run has them. */
#ifndef CLEAVE_SCENE_TEXT
#define CLEAVE_SCENE_TEXT

#include "base/base.h"

/* Returns true if the scene texts a and b describe the same scene. Files of particle lists are compared by their
 * checksums, not by their paths. */
bool scene_texts_describe_same_scene(const char *a, const char *b);

/* Returns true if the file `path` contains the text of the same scene as scene_text, apart from the paths of files with
 * equal contents. Returns false also if the file cannot be read. */
bool scene_file_describes_same_scene(const char *path, const char *scene_text);

/* Returns true if `text` begins as every scene.yaml that Cleave writes does: with the quoted name of the scene. */
bool scene_text_is_from_cleave(const char *text);

/* Returns REFUSED with a message about the first line in which the scenes `former_text`, of the run in the folder, and
 * `present_text` differ. The message begins with the path of the key in this line. */
status scene_texts_report_first_different_line(const char *folder, const char *former_text, const char *present_text);

#endif
