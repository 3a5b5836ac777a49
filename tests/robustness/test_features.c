/* Checks that the small scenes run under sanitizers (small_scenes.txt) contain every key and every word of scenes, and
 * that all other commands and their options are in small_commands.txt. A key or command added to the tables fails here
 * until a small scene or command has it. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "base/memory.h"
#include "scene/scene_read.h"
#include "src/app/commands.h"
#include "src/scene/scene_internal.h"

enum { SCENES_MOST = 400, SETTINGS_MOST = 24, LINE_MOST = 2000, WORDS_MOST = 40, KEYS_MOST = 2000 };

/* seen[k][0]: key k of the table occurs in a scene; seen[k][1 + w]: its word w occurs. */
static bool seen[KEYS_MOST][1 + WORDS_MOST];
static bool here[KEYS_MOST]; /* key k occurs in the current scene */

/* ---- the list ---------------------------------------------------------------------------------------------------- */

/* One line of small_scenes.txt. setting[n]: overrides, beginning with those of the scene from which it is derived. */
struct small_scene {
    char name[64], file[256];
    int n;
    struct scene_override setting[SETTINGS_MOST];
};

/* A scene that is called in small_commands.txt only, since the trial runs of its automatic settings would take minutes
 * under a sanitizer. */
static const struct small_scene auto_scene = {.name = "auto", .file = "tests/robustness/scenes/auto.yaml"};

/* Removes blanks at both ends of `text` and returns its new beginning. */
static char *trimmed(char *text)
{
    while (*text == ' ') text++;
    for (size_t n = strlen(text); n > 0 && strchr(" \n", text[n - 1]); n--) text[n - 1] = '\0';
    return text;
}

/* Reads small_scenes.txt into list[SCENES_MOST] and returns the number of scenes. The texts of the settings are never
 * freed. */
static int list_read(struct small_scene *list)
{
    FILE *f = fopen("tests/robustness/small_scenes.txt", "r");
    char line[LINE_MOST];
    int n = 0;
    assert_non_null(f);
    while (fgets(line, sizeof line, f)) {
        if (*line == '#') continue;
        char *rest = line, *name = trimmed(strsep(&rest, "|")), *file = strsep(&rest, "|");
        if (!file || !rest || n == SCENES_MOST) fail_msg("small_scenes.txt: %s: three parts are expected", name);
        struct small_scene *s = &list[n];
        *s = (struct small_scene){.n = 0};
        file = trimmed(file);
        for (int k = 0; k < n; k++)
            if (strcmp(list[k].name, file) == 0) *s = list[k];
        if (!s->file[0]) snprintf(s->file, sizeof s->file, "%s", file);
        snprintf(s->name, sizeof s->name, "%s", name);
        for (char *setting; (setting = strsep(&rest, ";"));) {
            setting = strdup(trimmed(setting));
            char *value = strchr(setting, '=');
            if (!*setting) continue;
            if (!value || s->n == SETTINGS_MOST) fail_msg("small_scenes.txt: %s: %s is not KEY=VALUE", name, setting);
            *value = '\0';
            s->setting[s->n++] = (struct scene_override){setting, value + 1};
        }
        n++;
    }
    fclose(f);
    return n;
}

/* ---- content of a scene ------------------------------------------------------------------------------------------ */

/* Returns the words of key k that must occur in a scene, as a|b|c; "" if there are none. */
static const char *words_of(const struct key *k)
{
    if (k->type == KEY_FLAG) return "true|false";
    if (k->type == KEY_CHOICE || k->type == KEY_SET || k->type == KEY_REAL) return k->words ? k->words : "";
    const bool plain = k->type == KEY_HAND && k->words && strchr(k->words, '|') && !strchr(k->words, ' ');
    return plain ? k->words : "";
}

static void word_seen(const struct key *k, const char *word)
{
    const char *words = words_of(k);
    const int w = word_index_in_list(words, word);
    if (w >= 0 && *words) seen[k - keys][1 + w] = true;
    for (int all = 0; k->type == KEY_SET && strcmp(word, "all") == 0 && all < WORDS_MOST; all++)
        seen[k - keys][1 + all] = true;
}

static void group_walk(const struct yaml_node *n, const char *group);

/* Returns the path of the group of the table to which the keys below key k belong. */
static const char *group_below(const struct key *k)
{
    if (k->type == KEY_REGION || (k->words && strncmp(k->words, "solid", 5) == 0)) return "solid";
    if (strcmp(k->path, "materials") == 0) return "material";
    return strcmp(k->path, "parts") == 0 ? "bodies.parts" : k->path;
}

static void key_walk(const struct key *k, const struct yaml_node *n)
{
    seen[k - keys][0] = here[k - keys] = true;
    if (n->kind == NODE_SCALAR) word_seen(k, n->text);
    for (const struct yaml_node *item = n->first; item; item = item->next)
        if (n->kind == NODE_LIST && item->kind == NODE_SCALAR) word_seen(k, item->text);
    const struct key *form = key_find(k->path, "form"); /* exact: step bar */
    if (form && n->kind == NODE_SCALAR) word_seen(form, n->text), seen[form - keys][0] = true;
    if (k->words && strncmp(k->words, "mapping of names to solids", 26) == 0)
        for (const struct yaml_node *named = n->first; named; named = named->next) group_walk(named, "solid");
    else
        group_walk(n, group_below(k));
}

/* Records all keys of the group `group` in the tree below the node n. A word in place of a mapping is a key of the
 * group, such as the kind of a probe. */
static void group_walk(const struct yaml_node *n, const char *group)
{
    if (n->kind == NODE_LIST)
        for (const struct yaml_node *item = n->first; item; item = item->next) group_walk(item, group);
    else if (n->kind == NODE_SCALAR) {
        const struct key *kind = key_find(group, n->text);
        if (kind && kind->type == KEY_PART) seen[kind - keys][0] = here[kind - keys] = true;
    } else
        for (const struct yaml_node *child = n->first; child; child = child->next) {
            const struct key *k = key_find(group, child->key);
            if (k) key_walk(k, child);
        }
}

/* Returns true if the group of key k occurs in the current scene or always applies, so that key k has its default if it
 * is missing. */
static bool group_is_here(const struct key *k)
{
    char group[64];
    snprintf(group, sizeof group, "%s", k->path);
    char *dot = strrchr(group, '.');
    if (!dot) return true;
    *dot = '\0';
    for (int g = 0; g < keys_count; g++)
        if (strcmp(keys[g].path, group) == 0) return here[g] || (keys[g].type == KEY_MAP && !strchr(group, '.'));
    return false;
}

/* Records the keys of the scene `small`, after its includes and settings, and the words of the defaults of its missing
 * keys. */
static void scene_note(const struct small_scene *small)
{
    char *text = NULL;
    size_t length = 0;
    struct yaml_node *root = NULL, *plain = NULL;
    struct scene s = {0};
    struct reader r = {
        .name = small->file, .override = small->setting, .overrides = small->n, .scene = &s, .files = true};
    memset(here, 0, sizeof here);
    if (file_read_bytes(small->file, &text, &length) != OK || tree_parse_yaml(&r, text, length, -1, &plain) != OK ||
        scene_text_parse_with_includes_and_overrides(&r, text, length, &root) != OK)
        fail_msg("%s: %s", small->name, status_message());
    const struct key *include = key_find("", "include");
    if (yaml_node_find(plain, "include")) seen[include - keys][0] = true;
    group_walk(root, "");
    for (int k = 0; k < keys_count; k++)
        if (!here[k] && group_is_here(&keys[k])) word_seen(&keys[k], keys[k].fallback);
    memory_free(text);
    arena_free(&r);
}

/* ---- tests ------------------------------------------------------------------------------------------------------- */

/* Number of features without a small scene or command, which complain() has printed. */
static int complaints;

static void complain(const char *what, const char *word)
{
    fprintf(stderr, "no small scene or command has %s%s%s\n", what, *word ? ": " : "", word);
    complaints++;
}

static void every_small_scene_is_accepted(void **state)
{
    static struct small_scene list[SCENES_MOST];
    (void)state;
    const int n = list_read(list);
    int refused = 0;
    for (int k = 0; k < n; k++) {
        struct scene s;
        const status read = scene_read(&s, list[k].file, list[k].setting, list[k].n);
        if (read == OK)
            scene_free(&s);
        else
            fprintf(stderr, "%s: %s\n", list[k].name, status_message()), refused++;
        for (int j = 0; j < k; j++) assert_string_not_equal(list[j].name, list[k].name);
    }
    assert_true(n > 100);
    assert_int_equal(refused, 0);
}

static void every_key_and_word_stands_in_a_small_scene(void **state)
{
    static struct small_scene list[SCENES_MOST];
    (void)state;
    complaints = 0;
    assert_true(keys_count <= KEYS_MOST);
    for (int k = 0, n = list_read(list); k < n; k++) scene_note(&list[k]);
    scene_note(&auto_scene);
    for (int k = 0; k < keys_count; k++) {
        if (keys[k].type == KEY_GROUP || keys[k].type == KEY_NAME) continue;
        if (!seen[k][0]) complain(keys[k].path, "");
        int w = 0;
        for (const char *c = words_of(&keys[k]); *c; w++) {
            char word[64];
            const size_t length = strcspn(c, "|");
            assert_true(w < WORDS_MOST);
            snprintf(word, sizeof word, "%.*s", (int)length, c);
            if (!seen[k][1 + w]) complain(keys[k].path, word);
            c += length + (c[length] == '|');
        }
    }
    assert_int_equal(complaints, 0);
}

/* Stores the options in the usage text of the command c in option[], each as " -o ", and returns their number. */
static int options_of(const struct command *c, char option[WORDS_MOST][32])
{
    char copy[LINE_MOST];
    int n = 0;
    snprintf(copy, sizeof copy, "%s", c->words);
    for (char *word, *rest = copy; (word = strsep(&rest, " []|,"));) {
        if (*word != '-') continue;
        assert_true(n < WORDS_MOST);
        snprintf(option[n++], sizeof *option, " %s ", word);
    }
    return n;
}

/* Returns true if a line of small_commands.txt calls the command c with the option `option` (" -o "; "" for any
 * call). */
static bool is_called(const struct command *c, const char *option)
{
    FILE *f = fopen("tests/robustness/small_commands.txt", "r");
    char line[LINE_MOST], name[64];
    bool found = false;
    assert_non_null(f);
    while (fgets(line, sizeof line, f) && !found) {
        line[strcspn(line, "\n")] = ' ';
        found = *line != '#' && sscanf(line, "%*d %63s", name) == 1 && !strcmp(name, c->name) && strstr(line, option);
    }
    fclose(f);
    return found;
}

/* Checks that small_commands.txt calls every command and every option of its usage, except options of benches, which
 * take minutes. */
static void every_command_and_option_is_called(void **state)
{
    (void)state;
    complaints = 0;
    for (const struct command *c = commands; c < commands + commands_count; c++) {
        char option[WORDS_MOST][32];
        const int n = strcmp(c->name, "bench") == 0 ? 0 : options_of(c, option);
        if (!is_called(c, "")) complain(c->name, "");
        for (int k = 0; k < n; k++)
            if (!is_called(c, option[k])) complain(c->name, option[k]);
    }
    char scene[sizeof auto_scene.file + 2];
    const struct command *check;
    snprintf(scene, sizeof scene, " %s ", auto_scene.file);
    assert_int_equal(command_find_by_name("check", &check), OK);
    if (!is_called(check, scene)) complain("check", auto_scene.file);
    assert_int_equal(complaints, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_small_scene_is_accepted),
        cmocka_unit_test(every_key_and_word_stands_in_a_small_scene),
        cmocka_unit_test(every_command_and_option_is_called),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
