/* Files that a command reads as its input: scenes, lists of particles, tables, meshes, images. All of them are opened
 * or registered here, so that no command waits at a pipe or overwrites its input. */
#ifndef CLEAVE_INPUT
#define CLEAVE_INPUT

#include <stdio.h>

#include "base.h"

/* Opens the regular file `path` for reading and registers it as an input of this command. The caller closes *file.
 * expected_content: what the file should be, for the message; NULL: left out. Returns REFUSED, with the message `PATH:
 * cause; give EXPECTED_CONTENT`, and *file = NULL, if the file cannot be opened or is a folder, pipe, socket or device,
 * except for a pipe that is already open (/dev/stdin, /dev/fd/N). */
status input_file_open(FILE **file, const char *path, const char *expected_content);

/* Registers the file at `path`, which a library opens, as an input of this command. A missing file is ignored. */
void input_file_register_as_read(const char *path);

/* Returns true if `path` is a file that this command has read as an input, also through a link or a second name. */
bool input_file_was_read(const char *path);

#endif
