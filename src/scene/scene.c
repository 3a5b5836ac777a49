/* floor 4: reads a scene: file to nodes, overrides over them, nodes to struct scene by the table of keys. */
#include "scene_internal.h"

#include <ctype.h>
#include <errno.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"

enum { FILE_LONGEST = 16 * 1024 * 1024 };    /* [byte]; 1e5 events take far less */

/* The file's name without folder and ending, in the letters a name may have. */
static void name_from_path(char name[NAME_MAX_LENGTH], const char *path)
{
    const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path, *dot = strrchr(base, '.');
    size_t length = dot && dot != base ? (size_t)(dot - base) : strlen(base);
    if (length >= NAME_MAX_LENGTH) length = NAME_MAX_LENGTH - 1;
    for (size_t k = 0; k < length; k++) {
        bool fine = isalnum((unsigned char)base[k]) || (base[k] == '-' && k > 0) || base[k] == '_';
        name[k] = fine ? base[k] : '_';
    }
    if (length == 0) strcpy(name, "scene");
}

/* Everything else hangs on the number of dimensions. */
static status read_space(struct reader *r, const struct node *root)
{
    const struct key *k = key_find("", "space");
    const struct node *space = node_find(root, "space");
    if (!space) return fault_missing(r, root, k);
    TRY(read_key(r, k, space, r->scene));
    r->dim = r->scene->dim = space_dim(r->scene->space);
    return OK;
}

status scene_from_tree(struct reader *r, const struct node *root)
{
    struct scene *s = r->scene;
    TRY(expect(r, root, NODE_MAP, "a mapping of keys to values, as a scene is"));
    TRY(check_keys(r, root, ""));
    TRY(read_space(r, root));
    s->conversion.criteria = CONVERT_ON_CUT | CONVERT_ON_STRESS;
    TRY(read_group(r, root, root, "", s));
    TRY(check_scene(r, root));
    TRY(read_materials(r, root));
    resolve_safety(r, root);
    TRY(read_bodies(r, root));
    resolve_frames(s);
    TRY(check_size(r, root));
    TRY(read_cracks(r, root));
    TRY(read_initials(r, root));
    TRY(read_boundaries(r, root));
    TRY(read_probes(r, root));
    TRY(read_growths(r, root));
    return check_solver(r, root);
}

status scene_tree(struct reader *r, const char *text, size_t length, struct node **root)
{
    TRY(tree_read(r, text, length, -1, root));
    if (!*root) return fault_mark(r, -1, 1, 1, "empty; a scene begins with keys such as space and duration");
    return tree_override(r, *root);
}

static status read_all(struct reader *r, const char *text, size_t length)
{
    struct scene *s = r->scene;
    struct node *root;
    TRY(scene_tree(r, text, length, &root));
    TRY(auto_resolve(r, root, text, length));
    TRY(scene_from_tree(r, root));
    s->text = scene_echo(s);
    return s->text ? OK : status_set(FAILED, "%s: no memory to write it out", r->name);
}

static status read_scene(struct reader *r, const char *text, size_t length)
{
    struct scene *s = r->scene;
    *s = (struct scene){0};
    locale_t c = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (!c) return status_set(FAILED, "%s: no memory to read it", r->name);
    locale_t old = uselocale(c);         /* a point is the decimal sign, wherever the user lives */
    s->path = NEW("scene path", strlen(r->name) + 1, char);
    strcpy(s->path, r->name);
    name_from_path(s->name, r->name);
    status result = read_all(r, text, length);
    uselocale(old);
    freelocale(c);
    arena_free(r);
    if (result != OK) scene_free(s);
    return result;
}

status scene_read_text(struct scene *s, const char *text, size_t length, const char *name,
                       const struct scene_override *override, int overrides)
{
    struct reader r = {.name = name, .override = override, .overrides = overrides, .scene = s};
    return read_scene(&r, text, length);
}

/* The file's bytes; freed with memory_free. */
static status file_bytes(const char *path, char **bytes, size_t *length)
{
    FILE *in = fopen(path, "rb");
    if (!in) return status_set(REFUSED, "%s: %s; a scene file is expected", path, strerror(errno));
    size_t room = 65536, used = 0, got;
    char *text = NEW("scene file", room, char);
    while ((got = fread(text + used, 1, room - used, in)) > 0 && used <= FILE_LONGEST) {
        used += got;
        if (used < room) continue;
        text = memory_resize("scene file", text, (int64_t)room, (int64_t)(2 * room), 1);
        room *= 2;
    }
    int error = ferror(in) ? errno : 0;
    fclose(in);
    *bytes = text;
    *length = used;
    if (error == 0 && used <= FILE_LONGEST) return OK;
    memory_free(text);
    if (error) return status_set(REFUSED, "%s: %s; a scene file is expected", path, strerror(error));
    return status_set(REFUSED, "%s: longer than 16 MiB; long data belong into a particle list", path);
}

status scene_read(struct scene *s, const char *path, const struct scene_override *override, int overrides)
{
    char *text = NULL;
    size_t length = 0;
    struct reader r = {.name = path, .override = override, .overrides = overrides, .scene = s, .files = true};
    *s = (struct scene){0};
    TRY(file_bytes(path, &text, &length));
    status result = read_scene(&r, text, length);
    memory_free(text);
    return result;
}

void scene_free(struct scene *s)
{
    for (int k = 0; k < s->bodies; k++) {
        region_free(&s->body[k].shape);
        memory_free(s->body[k].file);
    }
    for (int k = 0; k < s->cracks; k++) memory_free(s->crack[k].corner);
    for (int k = 0; k < s->initials; k++) region_free(&s->initial[k].region);
    for (int k = 0; k < s->boundaries; k++) {
        region_free(&s->boundary[k].region);
        memory_free(s->boundary[k].time.t);
        memory_free(s->boundary[k].time.value);
    }
    for (int k = 0; k < s->probes; k++) {
        region_free(&s->probe[k].region);
        memory_free(s->probe[k].contours.value);
    }
    region_free(&s->pd_region);
    memory_free(s->material);
    memory_free(s->body);
    memory_free(s->crack);
    memory_free(s->initial);
    memory_free(s->boundary);
    memory_free(s->probe);
    memory_free(s->growth);
    memory_free(s->times.value);
    memory_free(s->path);
    memory_free(s->text);
    *s = (struct scene){0};
}
