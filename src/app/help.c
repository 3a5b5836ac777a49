/* Implements `cleave help`: finds the page and prints it. */
#include <stdio.h>
#include <string.h>

#include "base/edit_distance.h"
#include "commands.h"
#include "scene/scene.h"

/* Prints the page of all keys, after the line with which an editor finds the schema. */
static status help_scene(void)
{
    char schema[4096];
    if (schema_path(schema, sizeof schema))
        printf("# yaml-language-server: $schema=%s\n"
               "As the first line of a scene, this lets editors complete keys and underline mistakes.\n\n",
               schema);
    return scene_print_help(stdout, NULL);
}

/* Returns REFUSED if a word is not a key but is within two letters of the name of a page or command; the message
 * contains that name. Returns OK otherwise. */
static status help_misspelt(const char *word)
{
    static const char *const pages[] = {"scene", "units", "expression", "run", "theory", "trust"};
    const char *nearest = pages[0];
    if (scene_has_key(word)) return OK;
    for (size_t k = 0; k < COUNT_OF(pages); k++)
        if (edit_distance(word, pages[k]) < edit_distance(word, nearest)) nearest = pages[k];
    for (int k = 0; k < commands_count; k++)
        if (edit_distance(word, commands[k].name) < edit_distance(word, nearest)) nearest = commands[k].name;
    if (edit_distance(word, nearest) > 2) return OK;
    return status_set(REFUSED, "%.40s: neither a page nor a key; the nearest is %s", word, nearest);
}

/* Joins the words after `help` by underscores into joined[room], as in names of keys: fracture energy becomes
 * fracture_energy. Returns joined, or NULL if there are no words. */
static const char *help_word(int argc, char **argv, char *joined, size_t room)
{
    size_t used = 0;
    for (int k = 1; k < argc && used < room; k++)
        used += (size_t)snprintf(joined + used, room - used, "%s%s", k > 1 ? "_" : "", argv[k]);
    return argc > 1 ? joined : NULL;
}

status command_help(int argc, char **argv)
{
    char joined[256];
    const bool completion = argc > 1 && !strcmp(argv[1], "--completion");
    const char *word = completion ? argv[1] : help_word(argc, argv, joined, sizeof joined);
    if (!word || !strcmp(word, "scene")) return help_scene();
    if (!strcmp(word, "--completion")) return completion_print(stdout, argc == 3 ? argv[2] : "");
    if (!strcmp(word, "--schema")) return scene_print_schema(stdout);
    if (!strcmp(word, "--manual")) return manual_print(stdout);
    if (!strcmp(word, "--reference")) return scene_print_reference(stdout), OK;
    if (!strcmp(word, "units")) return scene_print_units(stdout), OK;
    if (!strcmp(word, "expression") || !strcmp(word, "expressions")) return scene_print_expressions(stdout), OK;
    if (!strcmp(word, "run")) return manual_run_print(stdout);
    if (!strcmp(word, "trust")) return trust_print(stdout);
    if (!strcmp(word, "theory")) return theory_print(stdout);
    for (int k = 0; k < commands_count; k++)
        if (!strcmp(word, commands[k].name)) return usage_print_of(stdout, &commands[k]), OK;
    TRY(help_misspelt(word));
    return scene_print_help(stdout, word);
}
