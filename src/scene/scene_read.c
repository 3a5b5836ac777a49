/* Reads a scene: from the file to a tree of nodes, and from the tree to struct scene. Also writes the text of the scene
 * as run. */
#include "scene/scene_read.h"

#include <ctype.h>
#include <locale.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "scene_parts.h"

/* Derives the name of a scene from its path, into `name`: the file name without folder and extension, with _ for
 * characters that a name cannot have, truncated to NAME_MAX_LENGTH - 1 characters. */
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

/* Returns the YAML node of `method: auto` in the tree `root`; NULL if the input file (scene) has another method. */
static const struct yaml_node *auto_method(const struct yaml_node *root)
{
    const struct yaml_node *method = root->kind == NODE_MAP ? yaml_node_find(root, "method") : NULL;
    return method && method->kind == NODE_SCALAR && strcmp(method->text, "auto") == 0 ? method : NULL;
}

/* Parses an input file (scene) in a text of `length` bytes, fills r->scene and writes the scene as run to s->text. With
 * `method: auto` fills only *wish, the requirements of the pilot runs (short runs that choose method and spacing).
 * Returns REFUSED, with a message, for an invalid scene, and for `method: auto` if wish is NULL. */
static status scene_read_all(struct reader *r, const char *text, size_t length, struct pilot_requirements *wish)
{
    struct scene *s = r->scene;
    struct yaml_node *root;
    TRY(scene_text_parse_with_includes_and_overrides(r, text, length, &root));
    const struct yaml_node *method = auto_method(root);
    if (method && wish) return auto_method_pilot_run_requirements_read(r, root, text, length, wish);
    if (method)
        return fault_report_at_node(
            r, method,
            "the method auto works in `cleave run` only, which makes pilot runs; give a method and "
            "particles.spacing, or use the scene.yaml that such a run writes");
    scene_store_key_locations(r, root);
    TRY(scene_read_values_from_yaml_tree(r, root));
    s->text = scene_to_yaml(s);
    return s->text
               ? OK
               : status_set(
                     FAILED,
                     "%s: out of memory, so the scene with all its defaults is not written; free memory and try again",
                     r->name);
}

/* Reads an input file (scene) from a text of `length` bytes into r->scene, in the C locale. With `method: auto` stores
 * only the requirements of the pilot runs (short runs that choose method and spacing) in *wish, and frees the scene.
 * Returns REFUSED, with a message and the scene freed, for an invalid scene, and for `method: auto` if wish is NULL;
 * FAILED if memory is exhausted. */
static status read_scene(struct reader *r, const char *text, size_t length, struct pilot_requirements *wish)
{
    struct scene *s = r->scene;
    *s = (struct scene){0};
    locale_t c = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (!c) return status_set(FAILED, "%s: out of memory while the scene is read; free memory and try again", r->name);
    locale_t old = uselocale(c); /* the decimal sign is then a point in every locale */
    s->path = NEW("scene path", strlen(r->name) + 1, char);
    strcpy(s->path, r->name);
    name_from_path(s->name, r->name);
    status result = scene_read_all(r, text, length, wish);
    uselocale(old);
    freelocale(c);
    arena_free(r);
    if (result != OK || (wish && wish->wanted)) scene_free(s);
    return result;
}

status scene_read_text(struct scene *s, const char *text, size_t length, const char *name,
                       const struct scene_override *override, int overrides)
{
    struct reader r = {.name = name, .override = override, .overrides = overrides, .scene = s};
    return read_scene(&r, text, length, NULL);
}

/* Reads an input file (scene) from the file `path` into s. override[overrides]: values given on the command line. With
 * `method: auto` stores only the requirements of the pilot runs (short runs that choose method and spacing) in *wish.
 * Returns REFUSED, with a message, for an invalid scene, and for `method: auto` if wish is NULL. */
static status scene_file_read(struct scene *s, const char *path, const struct scene_override *override, int overrides,
                              struct pilot_requirements *wish)
{
    char *text = NULL;
    size_t length = 0;
    struct reader r = {.name = path, .override = override, .overrides = overrides, .scene = s, .files = true};
    *s = (struct scene){0};
    TRY(file_read_bytes(path, &text, &length));
    status result = read_scene(&r, text, length, wish);
    memory_free(text);
    return result;
}

status scene_read(struct scene *s, const char *path, const struct scene_override *override, int overrides)
{
    return scene_file_read(s, path, override, overrides, NULL);
}

status scene_read_unless_pilot_runs_are_needed(struct scene *s, struct pilot_requirements *requirements,
                                               const char *path, const struct scene_override *override, int overrides)
{
    *requirements = (struct pilot_requirements){0};
    return scene_file_read(s, path, override, overrides, requirements);
}
