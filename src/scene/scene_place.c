/* Finds the locations of the keys of a scene in its file, for refusals after it has been read. */
#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "scene_internal.h"

/* ---- the list of places --------------------------------------------------------------------------------------------
 */

/* Returns the number of nodes below `node`, at most `depth` levels below. */
static int64_t nodes_count(const struct yaml_node *node, int depth)
{
    int64_t n = 0;
    for (const struct yaml_node *c = node->first; c && depth > 0; c = c->next) n += 1 + nodes_count(c, depth - 1);
    return n;
}

/* Appends the locations of all nodes at most `depth` levels below `node` to s->key_place, the list of locations of the
 * scene, where memory for them must be allocated. path: path of `node`, "" for the root. */
static void places_add(const struct reader *r, const struct yaml_node *node, const char *path, int depth)
{
    struct scene *s = r->scene;
    int at = 0;
    for (const struct yaml_node *c = node->first; c && depth > 0; c = c->next, at++) {
        struct key_place *k = &s->key_place[s->key_places++];
        if (c->key)
            snprintf(k->key, sizeof k->key, "%.50s%s%.50s", path, *path ? "." : "", c->key);
        else
            snprintf(k->key, sizeof k->key, "%.50s[%d]", path, at);
        location_write_text(r, c->origin, c->line, c->column, k->place, sizeof k->place);
        places_add(r, c, k->key, depth - 1);
    }
}

void scene_store_key_locations(const struct reader *r, const struct yaml_node *root)
{
    enum { DEPTH = 2 }; /* mpm.frame, interfaces[0] */
    r->scene->key_place = NEW("scene.places", nodes_count(root, DEPTH), struct key_place);
    r->scene->key_places = 0;
    places_add(r, root, "", DEPTH);
}

/* ---- the place of a refusal ----------------------------------------------------------------------------------------
 */

/* Returns true if `text`, a message, begins with the words `kind` (which ends in a blank) and `name`, followed by a
 * colon or a blank. */
static bool begins_with(const char *text, const char *kind, const char *name)
{
    const size_t first = strlen(kind), second = strlen(name);
    if (strncmp(text, kind, first) != 0 || strncmp(text + first, name, second) != 0) return false;
    return text[first + second] == ':' || text[first + second] == ' ';
}

/* Writes to place[PLACE_LENGTH] the location, followed by a colon, of the key with which the message `text` begins, or
 * else of the group that contains this key. Writes nothing if the scene s has neither. */
static void place_of_key(const struct scene *s, const char *text, char *place)
{
    char key[100] = "";
    for (size_t k = 0; k + 1 < sizeof key && (isalnum((unsigned char)text[k]) || strchr("._[]", text[k])) && text[k];
         k++)
        key[k] = text[k], key[k + 1] = 0;
    while (*key) {
        for (int64_t k = 0; k < s->key_places; k++)
            if (strcmp(s->key_place[k].key, key) == 0) {
                snprintf(place, PLACE_LENGTH, "%.400s: ", s->key_place[k].place);
                return;
            }
        char *dot = strrchr(key, '.'), *bracket = strrchr(key, '[');
        if (!dot && !bracket) return;
        *(dot ? dot : bracket) = 0;
    }
}

/* Writes to place[PLACE_LENGTH] the location, followed by a colon, of item number `item` (from 0) of the list `list` of
 * the scene s, such as probes. Writes nothing if the location is unknown. */
static void place_of_item(const struct scene *s, const char *list, int item, char *place)
{
    char key[100];
    snprintf(key, sizeof key, "%s[%d]", list, item);
    place_of_key(s, key, place);
}

/* Writes to place[PLACE_LENGTH] the location, followed by a colon, of the boundary, body, material, probe or growth
 * rule with whose name, or the crack with whose number, the message `text` begins. s: scene. Writes nothing if there is
 * none. */
static void place_of_name(const struct scene *s, const char *text, char *place)
{
    int crack;
    for (int b = 0; b < s->boundaries && !*place; b++)
        if (begins_with(text, "boundary ", s->boundary[b].name))
            snprintf(place, PLACE_LENGTH, "%s", s->boundary[b].place);
    for (int b = 0; b < s->bodies + s->rigids && !*place; b++)
        if (begins_with(text, "body ", s->body[b].name) || begins_with(text, "bodies ", s->body[b].name) ||
            begins_with(text, "rigid body ", s->body[b].name))
            snprintf(place, PLACE_LENGTH, "%s", s->body[b].place);
    for (int m = 0; m < s->materials && !*place; m++)
        if (begins_with(text, "material ", s->material[m].name)) {
            place_of_item(s, "materials", m, place);
            if (!*place) place_of_key(s, "material", place);
        }
    for (int k = 0; k < s->probes && !*place; k++)
        if (begins_with(text, "probe ", s->probe[k].name)) place_of_item(s, "probes", k, place);
    for (int k = 0; k < s->growths && !*place; k++)
        if (begins_with(text, "growth ", s->growth[k].name)) place_of_item(s, "growth", k, place);
    if (!*place && sscanf(text, "crack %d", &crack) == 1 && crack > 0) place_of_item(s, "cracks", crack - 1, place);
}

void scene_find_file_location_of_warning(const void *scene, const char *text, char *location)
{
    *location = 0;
    place_of_name(scene, text, location);
    if (!*location && text[strcspn(text, ": ")] == ':') place_of_key(scene, text, location);
    char *end = strstr(location, ": "); /* the name of the key, which the message has */
    if (end) *end = 0;
}

status scene_prepend_location_to_error_message(const struct scene *s, status result)
{
    char place[PLACE_LENGTH] = "";
    if (result != REFUSED) return result;
    place_of_name(s, status_message(), place);
    if (!*place) place_of_key(s, status_message(), place);
    if (!*place) snprintf(place, sizeof place, "%.500s: ", s->path);
    return status_message_prepend_location(place, result);
}
