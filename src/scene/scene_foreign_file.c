/* Recognises input files of other programs that are given to Cleave in place of a scene. */
#include <ctype.h>
#include <string.h>

#include "scene_internal.h"

/* Files of other programs that are given to Cleave in place of a scene. begins: beginning of the first line that is
 * neither empty nor a comment, alternatives separated by |; text: the message. */
static const struct {
    const char *begins, *text;
} foreign_files[] = {
    {"*",
     "this is an input file of Abaqus or LS-DYNA, not a scene; write a scene (`cleave new NAME`), which can use the "
     "mesh of the file as a shape, body: {mesh: {file: part.inp, unit: mm}}"},
    {"$MeshFormat", "this is a mesh of Gmsh, not a scene; write a scene (`cleave new NAME`) with it as a shape, body: "
                    "{mesh: {file: part.msh, unit: mm}}"},
    {"solid ", "this is an STL file, not a scene; write a scene (`cleave new NAME`) with it as a shape, body: {stl: "
               "{file: part.stl, unit: mm}}"},
    {"units |atom_style |dimension |boundary |newton |processors |lattice |package |variable |log |clear|echo |region ",
     "this is an input script of LAMMPS, not a scene; write a scene (`cleave new NAME`); `cleave help lammps` compares "
     "the two"},
};

/* Returns true if line[length] begins with one of the alternatives in `begins`, a text a|b|c. */
static bool line_begins_with_any(const char *line, size_t length, const char *begins)
{
    for (const char *c = begins; *c; c += strcspn(c, "|"), c += *c == '|') {
        const size_t n = strcspn(c, "|");
        if (n <= length && strncmp(line, c, n) == 0) return true;
    }
    return false;
}

status other_program_file_refuse(struct reader *r, const char *text, size_t length)
{
    int number = 1;
    const char *end = text + length, *line = text;
    for (const char *next; line < end; line = next, number++) {
        const char *stop = memchr(line, '\n', (size_t)(end - line));
        next = stop ? stop + 1 : end;
        if (!strchr("#\r\n", *line)) break;
    }
    const size_t left = (size_t)(end - line);
    const char *stop = left > 0 ? memchr(line, '\n', left) : NULL;
    const size_t line_length = stop ? (size_t)(stop - line) : left;
    if (line_length == 0 || (isalpha((unsigned char)*line) && memchr(line, ':', line_length))) return OK; /* a key */
    for (size_t k = 0; k < COUNT_OF(foreign_files); k++)
        if (line_begins_with_any(line, line_length, foreign_files[k].begins))
            return fault_report_at_location(r, -1, number, 1, "%s", foreign_files[k].text);
    return OK;
}
