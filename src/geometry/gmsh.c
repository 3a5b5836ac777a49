/* Reads Gmsh .msh files, formats 2.2 and 4.1, text or binary (Gmsh reference manual, "File formats"). Physical groups
 * become sets with the group's name, or its number if it has none. */
#define _GNU_SOURCE /* memmem */
#include <ctype.h>
#include <stdio.h>
#include <strings.h>

#include "base/memory.h"
#include "gmsh_parts.h"

/* ---- physical names and entities ------------------------------------------------------------------------------- */

/* Reads a text in double quotes from the file into text[capacity]; longer texts are cut off. Returns REFUSED if the
 * text does not begin with a quote, or does not end with one on the same line. */
static status quoted_next(struct geometry_file *file, char *text, size_t capacity)
{
    size_t n = 0;
    if (!geometry_file_skip_blanks(file) || file->text[file->at] != '"')
        return geometry_file_report_fault(file, "the name of this group is not in quotes; write it in quotes");
    for (file->at++; file->at < file->length && file->text[file->at] != '"' && file->text[file->at] != '\n'; file->at++)
        if (n + 1 < capacity) text[n++] = file->text[file->at];
    text[n] = '\0';
    if (file->at >= file->length || file->text[file->at] != '"')
        return geometry_file_report_fault(file, "a name has no closing quote");
    file->at++;
    return OK;
}

/* Reads the section of the names of physical groups into g->name. Returns REFUSED if it is malformed, or there are more
 * than ELEMENT_SETS_MAX names. */
static status names_read(struct gmsh *g)
{
    int64_t n;
    TRY(geometry_file_read_integer(g->s, "number of names", &n));
    TRY(geometry_file_check_count_fits_size(g->s, "names", n, 4));
    g->announced = n, g->items = "names";
    if (n > ELEMENT_SETS_MAX)
        return geometry_file_report_fault(g->s, "the mesh has more than %d physical groups; remove some",
                                          ELEMENT_SETS_MAX);
    GROW("gmsh.names", g->name, n);
    for (g->names = 0; g->names < n; g->names++) {
        struct group_name *name = &g->name[g->names];
        TRY(geometry_file_read_integer(g->s, "dimension of a group", &name->dim));
        TRY(geometry_file_read_integer(g->s, "tag of a group", &name->tag));
        TRY(quoted_next(g->s, name->text, sizeof name->text));
    }
    return OK;
}

/* Records in g that an entity of the file belongs to the physical group with the tag `group`. entity: number of the
 * entity, as returned by entity_key. */
static void entity_group_add(struct gmsh *g, int64_t entity, int64_t group)
{
    GROW("gmsh.entities", g->entity, g->links + 1);
    GROW("gmsh.entities", g->group, g->links + 1);
    g->entity[g->links] = entity, g->group[g->links++] = group;
}

/* Reads an entity of dimension dim from the file g: its tag, bounding box (for a point its position), physical groups
 * and, except for points, bounding entities. Stores only the groups. Returns REFUSED if it is malformed. */
static status entity_read(struct gmsh *g, int64_t dim)
{
    int64_t tag, groups, group, bounds;
    real box;
    TRY(geometry_file_read_int32(g->s, "tag of an entity", &tag));
    for (int k = 0; k < (dim == 0 ? 3 : 6); k++) TRY(geometry_file_read_real(g->s, "coordinate", &box));
    TRY(geometry_file_read_int64(g->s, "number of groups", &groups));
    TRY(geometry_file_check_count_fits_size(g->s, "groups", groups, 2));
    for (int64_t k = 0; k < groups; k++) {
        TRY(geometry_file_read_int32(g->s, "tag of a group", &group));
        entity_group_add(g, gmsh_entity_key_from_dimension_and_tag(dim, tag), group < 0 ? -group : group);
    }
    if (dim == 0) return OK;
    TRY(geometry_file_read_int64(g->s, "number of bounding entities", &bounds));
    TRY(geometry_file_check_count_fits_size(g->s, "bounding entities", bounds, 2));
    for (int64_t k = 0; k < bounds; k++) TRY(geometry_file_read_int32(g->s, "tag of an entity", &tag));
    return OK;
}

/* Reads the section of entities (format 4.1), and creates g->of_entity, the map to their physical groups. Returns
 * REFUSED if it is malformed. */
static status entities_read(struct gmsh *g)
{
    int64_t n[1 + DIM_MAX];
    g->announced = 0, g->items = "entities";
    for (int d = 0; d <= DIM_MAX; d++) TRY(geometry_file_read_int64(g->s, "number of entities", &n[d]));
    for (int d = 0; d <= DIM_MAX; d++) {
        TRY(geometry_file_check_count_fits_size(g->s, "entities", n[d], 8));
        g->announced += n[d];
        for (int64_t k = 0; k < n[d]; k++) TRY(entity_read(g, d));
    }
    label_map_free(&g->of_entity);
    label_map_make(&g->of_entity, g->entity, 0, g->links);
    return OK;
}
/* ---- sections ------------------------------------------------------------------------------------------------- */

/* Reports that the file of g has the format `version` of Gmsh, which is not read. Returns REFUSED. */
static status format_refuse(const struct gmsh *g, const char *version)
{
    return geometry_file_report_fault(
        g->s, "Gmsh's file format %s is not supported; save the mesh as 4.1 (gmsh -save -format msh41) or 2.2",
        version);
}

/* Reads the header of the file of g. Returns REFUSED unless the version is 2.2 or 4.1 and, in binary files, numbers
 * have the byte order and sizes of this machine. */
static status format_read(struct gmsh *g)
{
    char version[16];
    int64_t bytes, size, one;
    geometry_file_read_word(g->s, version, sizeof version);
    g->old = strcmp(version, "2.2") == 0 || strcmp(version, "2") == 0;
    if (!g->old && strcmp(version, "4.1") != 0) return format_refuse(g, version);
    TRY(geometry_file_read_integer(g->s, "kind of file", &bytes));
    TRY(geometry_file_read_integer(g->s, "size of numbers", &size));
    if (size != 8)
        return geometry_file_report_fault(
            g->s, "numbers have %lld bytes each, but need 8 (double precision); save the mesh with 8", (long long)size);
    g->bytes = bytes != 0;
    if (!g->bytes) return OK;
    geometry_file_skip_to_next_line(g->s);
    g->s->binary = true;
    TRY(geometry_file_read_int32(g->s, "the number 1", &one));
    g->s->binary = false;
    if (one == 1) return OK;
    return geometry_file_report_fault(
        g->s, "the file has the byte order of another kind of processor; save it as text (ASCII)");
}

/* Skips the rest of the section `name` of the file, such as $Nodes: advances to the line after its last one, such as
 * $EndNodes, or to the end of the file. */
static void section_skip(struct geometry_file *file, const char *name)
{
    char end[48];
    const int length = snprintf(end, sizeof end, "$End%s", name + 1);
    const char *found = memmem(file->text + file->at, (size_t)(file->length - file->at), end, (size_t)length);
    file->at = found ? found - file->text + length : file->length;
}

/* Advances over the last line of the section `name` of the file g, such as $EndNodes of $Nodes. Returns REFUSED, with a
 * message, if the next line is another one, because the section has more entries than its first line announces. */
static status section_end(struct gmsh *g, const char *name)
{
    char end[48], word[sizeof end];
    snprintf(end, sizeof end, "$End%s", name + 1);
    geometry_file_skip_blanks(g->s);
    geometry_file_read_word(g->s, word, sizeof word);
    if (strcmp(word, end) == 0) return OK;
    return geometry_file_report_fault(
        g->s,
        "%s gives %lld %s, but more follow in place of %s, so the count is wrong or the file "
        "damaged; save the mesh again",
        name, (long long)g->announced, g->items, end);
}

/* Reads the section `name` of the file g, such as $Nodes, or skips it if it is not needed. Returns REFUSED if it is
 * malformed. */
static status section_read(struct gmsh *g, const char *name)
{
    static const struct section {
        const char *name;
        status (*old)(struct gmsh *), (*new)(struct gmsh *);
    } sections[] = {{"$PhysicalNames", names_read, names_read},
                    {"$Nodes", gmsh22_read_nodes, gmsh41_read_nodes},
                    {"$Elements", gmsh22_read_elements, gmsh41_read_elements},
                    {"$Entities", NULL, entities_read}};
    if (strcmp(name, "$PartitionedEntities") == 0)
        return geometry_file_report_fault(g->s,
                                          "the mesh has partitions, which are not supported; save it without them");
    if (strcmp(name, "$Nodes") == 0 && g->node.entry)
        return geometry_file_report_fault(g->s, "the mesh has a second section of nodes; remove one of the two");
    for (size_t k = 0; k < COUNT_OF(sections); k++) {
        if (strcmp(name, sections[k].name) != 0 || (g->old && !sections[k].old)) continue;
        if (!g->old && g->bytes && k > 0) geometry_file_skip_to_next_line(g->s);
        g->s->binary = !g->old && g->bytes && k > 0; /* names are text also in binary files */
        const status s = (g->old ? sections[k].old : sections[k].new)(g);
        g->s->binary = false;
        return s == OK ? section_end(g, name) : s;
    }
    section_skip(g->s, name);
    return OK;
}

/* Reads all sections of the file g. Returns REFUSED if one is malformed, or if there are no nodes or elements. */
static status sections_read(struct gmsh *g)
{
    char name[40];
    geometry_file_read_word(g->s, name, sizeof name);
    if (strcmp(name, "$NOD") == 0) return format_refuse(g, "1");
    if (strcmp(name, "$MeshFormat") != 0)
        return geometry_file_report_fault(
            g->s, "the file does not begin with $MeshFormat, so it is not a mesh of Gmsh; save it with Gmsh");
    TRY(format_read(g));
    section_skip(g->s, name);
    while (geometry_file_skip_blanks(g->s)) {
        geometry_file_read_word(g->s, name, sizeof name);
        if (name[0] != '$')
            return geometry_file_report_fault(
                g->s, "%.30s is not the beginning of a section, such as $Nodes; save the mesh again", name);
        TRY(section_read(g, name));
    }
    if (!g->node.entry) return geometry_file_report_fault(g->s, "ends without $Nodes");
    return g->m->elements > 0 ? OK : geometry_file_report_fault(g->s, "ends without $Elements");
}

status gmsh_read(struct element_mesh *m, struct geometry_file *file)
{
    struct gmsh g = {.s = file, .m = m, .last_set = -1};
    const status result = sections_read(&g);
    label_map_free(&g.node);
    label_map_free(&g.of_entity);
    memory_free(g.name);
    memory_free(g.entity);
    memory_free(g.group);
    return result;
}
