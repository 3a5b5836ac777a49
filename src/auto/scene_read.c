/* Reads a scene: file to nodes, `method: auto` resolved, nodes to struct scene, the scene as run written out. */
#include "auto/scene_read.h"

#include <ctype.h>
#include <locale.h>
#include <stdio.h>
#include <string.h>

#include "auto.h"
#include "base/memory.h"
#include "src/scene/scene_internal.h"

/* Name of a scene from its path: the file name without folder and ending; characters that a name may not have become
 * _. */
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

/* Text to tree, choices of method auto, tree to scene, and the echo of the scene. */
static status scene_read_all(struct reader *r, const char *text, size_t length, struct pilot_wish *pilot)
{
    struct scene *s = r->scene;
    struct node *root;
    TRY(scene_tree(r, text, length, &root));
    TRY(auto_resolve(r, root, text, length, pilot));
    TRY(scene_from_tree(r, root));
    s->text = scene_echo(s);
    return s->text ? OK : status_set(FAILED, "%s: no memory to write it out", r->name);
}

/* Reads a scene from text in the C locale. Frees the nodes, and the scene on failure. `pilot` as in auto_resolve. */
static status read_scene(struct reader *r, const char *text, size_t length, struct pilot_wish *pilot)
{
    struct scene *s = r->scene;
    *s = (struct scene){0};
    locale_t c = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (!c) return status_set(FAILED, "%s: no memory to read it", r->name);
    locale_t old = uselocale(c);         /* the decimal sign is a point in every locale */
    s->path = NEW("scene path", strlen(r->name) + 1, char);
    strcpy(s->path, r->name);
    name_from_path(s->name, r->name);
    status result = scene_read_all(r, text, length, pilot);
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
    return read_scene(&r, text, length, NULL);
}

/* scene_read, and `pilot` as in auto_resolve. */
static status scene_file_read(struct scene *s, const char *path, const struct scene_override *override, int overrides,
                        struct pilot_wish *pilot)
{
    char *text = NULL;
    size_t length = 0;
    struct reader r = {.name = path, .override = override, .overrides = overrides, .scene = s, .files = true};
    *s = (struct scene){0};
    TRY(file_bytes(path, &text, &length));
    status result = read_scene(&r, text, length, pilot);
    memory_free(text);
    return result;
}

status scene_read(struct scene *s, const char *path, const struct scene_override *override, int overrides)
{
    return scene_file_read(s, path, override, overrides, NULL);
}

status scene_read_or_wish(struct scene *s, struct pilot_wish *w, const char *path,
                          const struct scene_override *override, int overrides)
{
    *w = (struct pilot_wish){0};
    const status read = scene_file_read(s, path, override, overrides, w);
    return w->wanted ? OK : read;
}
