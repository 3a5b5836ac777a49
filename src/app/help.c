/* Implements `cleave help`: finds the page and prints it. */
#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "base/edit_distance.h"
#include "commands.h"
#include "output/output_files.h"
#include "scene/scene.h"
#include "scene/words.h"

/* Words that a user may ask about although they are neither keys nor values of keys, and the answer to each:
 * where the manual or the program treats the word. words: words with one answer, separated by |. */
static const struct {
    const char *words, *answer;
} topics[] = {
    {"adaptive|coupling|conversion|convert", "inputs/choosing.md; the key `method`; `cleave help conversion`"},
    {"bond|bonds|bond_based|ospd|mospd|peridynamics|peridynamic|state_based|ordinary_state_based|nosb",
     "inputs/choosing.md and inputs/elasticity.md; the keys `model` and `pd`; the equations: `cleave help theory`"},
    {"mpm|material_point|material_points|material_point_method",
     "inputs/choosing.md; the keys `method` and `mpm`; the equations: `cleave help theory`"},
    {"model|method|choosing|choice|accuracy", "inputs/choosing.md"},
    {"result|results|figures|summary|frame|frames|output|csv|hdf|paraview", "inputs/results.md; `cleave help run`"},
    {"fragment|fragments|fragmentation|pieces",
     "fragments.csv and `fragments` of summary.json, in inputs/studies.md; a scene: inputs/ring_fragments.yaml"},
    {"impact|projectile|collision|bodies_meet|spall", "inputs/contact.md; `cleave new NAME impact` writes a scene"},
    {"branch|branching|crack_branching", "a scene: inputs/glass_branching.yaml; the probe `tip` follows a crack tip"},
    {"crack|crack_growth|crack_propagation|propagation|growth|fracture_mechanics",
     "inputs/materials.md and the keys `cracks` and `growth`; under slowly growing loads: inputs/slow.md"},
    {"static|load_steps|quasi_static|slow|equilibrium",
     "inputs/slow.md; the keys `solver` and `steps`; `cleave new NAME slow` writes a scene"},
    {"wave|waves|bar|pulse", "`cleave new NAME bar` writes a scene; inputs/bar_step.yaml, inputs/bar_pulse.yaml"},
    {"resume|restart|continue|checkpoint|checkpoints|interrupt|stop",
     "`cleave run SCENE --resume` continues from the newest checkpoint; `cleave run --help`, inputs/running.md"},
    {"threads|install|running|memory|performance", "inputs/running.md"},
    {"python|post_processing|postprocessing|h5py", "inputs/python.md"},
    {"visualise|visualize|visualisation|visualization|view|picture|pictures|film|movie",
     "inputs/pictures.md; `cleave plot --help`; ParaView opens frames.hdf.series of a run"},
    {"example|examples|sample|samples|tutorial|tutorials|start|begin|getting_started|introduction",
     "`cleave new` lists kinds of scenes to begin with; inputs/README.md, the manual, lists the scenes of inputs/"},
    {"manual|documentation|docs|doc|readme", "inputs/README.md, the manual; `cleave help scene` lists all keys"},
    {"load|loads|support|supports|boundary_condition|boundary_conditions", "inputs/loads.md; the key `boundary`"},
    {"body|bodies|solid|solids|shape|geometry", "inputs/bodies.md; from files: inputs/files.md"},
    {"mesh|image|images|stl|surface", "inputs/files.md"},
    {"gmsh|msh|abaqus|inp|ansys|ls_dyna|lsdyna|nastran|cad|exodus|cubit",
     "inputs/files.md: meshes of Gmsh and Abaqus as shapes of bodies, Exodus II files as lists of particles; `cleave "
     "export --help`"},
    {"particle_list|lists", "inputs/lists.md"},
    {"material|materials|plasticity", "inputs/materials.md"},
    {"study|studies|parameter_study|convergence|error_bar|error_bars|uncertainty",
     "inputs/studies.md; `cleave sweep --help`, `cleave converge --help`"},
    {"lammps", "inputs/lammps.md; `cleave export --help`"},
    {"references|reference|literature|papers|citation|cite", "inputs/references.md"},
    {"scenes|yaml", "inputs/scenes.md; `cleave help scene` lists all keys"},
};

/* Returns from the table `topics` the text that says where the manual treats `word` or which command does; NULL if no
 * topic of the table has this word. */
static const char *topic_answer(const char *word)
{
    for (size_t k = 0; k < COUNT_OF(topics); k++)
        if (word_index_in_list(topics[k].words, word) >= 0) return topics[k].answer;
    return NULL;
}

/* Prints the answer to `word`. If the answer names a file in the folder `inputs`, and the present folder has no such
 * folder, also prints the path of `inputs`. */
static void print_answer(const char *word, const char *answer)
{
    char folder[4096];
    printf("%s: %s\n", word, answer);
    if (strstr(answer, "inputs/") && !path_is_file("inputs/README.md") &&
        inputs_folder_find_path(folder, sizeof folder))
        printf("inputs/ is %s\n", folder);
}

/* Prints where the manual treats `word`, if the table `topics` has the word, and the description of the key of input
 * files with this name, if there is one. Returns REFUSED if the word is neither a topic nor a key. */
static status help_topic(const char *word)
{
    const char *answer = topic_answer(word);
    if (answer) print_answer(word, answer);
    if (answer && scene_help_can_explain_word(word)) putchar('\n');
    return answer && !scene_help_can_explain_word(word) ? OK : scene_print_help_on_keys(stdout, word);
}

/* Prints the page of all keys of input files, preceded by the line with which an editor finds the schema of input
 * files. Returns OK. */
static status help_scene(void)
{
    char schema[4096];
    if (json_schema_find_file_path(schema, sizeof schema))
        printf("# yaml-language-server: $schema=%s\n"
               "As the first line of a scene, this lets editors complete keys and underline mistakes.\n\n",
               schema);
    return scene_print_help_on_keys(stdout, NULL);
}

/* Returns REFUSED, with the most similar name in the message, if `word` is probably a misspelling of a help page
 * (argument of `cleave help`) or of a command (word_is_probable_misspelling_of). Returns OK otherwise, and for a word
 * that is a key of input files or a topic of help. */
static status help_misspelt(const char *word)
{
    static const char *const pages[] = {"scene", "units", "expression", "run", "theory", "trust"};
    const char *nearest = pages[0];
    if (scene_help_can_explain_word(word) || topic_answer(word)) return OK;
    for (size_t k = 0; k < COUNT_OF(pages); k++)
        if (edit_distance(word, pages[k]) < edit_distance(word, nearest)) nearest = pages[k];
    for (int k = 0; k < commands_count; k++)
        if (edit_distance(word, commands[k].name) < edit_distance(word, nearest)) nearest = commands[k].name;
    if (!word_is_probable_misspelling_of(word, nearest)) return OK;
    return status_set(REFUSED, "%.40s: this is neither a page nor a key; did you mean %s?", word, nearest);
}

/* Joins the words argv[1..argc-1] after `help` by underscores, as in names of keys: fracture energy becomes
 * fracture_energy, and so does fracture-energy. Stores the text in joined[capacity] and returns it, or NULL if there
 * are no words. */
static const char *help_word(int argc, char **argv, char *joined, size_t capacity)
{
    size_t used = 0;
    for (int k = 1; k < argc && used < capacity; k++)
        used += (size_t)snprintf(joined + used, capacity - used, "%s%s", k > 1 ? "_" : "", argv[k]);
    for (char *c = joined; argc > 1 && *joined != '-' && *c; c++)
        if (*c == '-') *c = '_';
    return argc > 1 ? joined : NULL;
}

/* Converts `word` in place to small letters if only that form is a topic of help or a key of input files, as
 * Johnson_Cook to johnson_cook. */
static void help_word_to_small_letters(char *word)
{
    char small[256];
    snprintf(small, sizeof small, "%s", word);
    for (char *c = small; *c; c++) *c = (char)tolower((unsigned char)*c);
    if (scene_help_can_explain_word(word) || topic_answer(word)) return;
    if (scene_help_can_explain_word(small) || topic_answer(small)) strcpy(word, small);
}

status command_help_main(int argc, char **argv)
{
    char joined[256];
    const bool completion = argc > 1 && !strcmp(argv[1], "--completion");
    const char *word = completion ? argv[1] : help_word(argc, argv, joined, sizeof joined);
    if (word == joined) help_word_to_small_letters(joined);
    if (!word || !strcmp(word, "scene") || !strcmp(word, "all") || !strcmp(word, "--all")) return help_scene();
    if (!strcmp(word, "--completion")) return completion_print_shell_script(stdout, argc == 3 ? argv[2] : "");
    if (!strcmp(word, "--schema")) return scene_print_json_schema(stdout);
    if (!strcmp(word, "--manual")) return manual_print(stdout);
    if (!strcmp(word, "--reference")) return scene_print_key_reference_as_markdown(stdout), OK;
    if (!strcmp(word, "units")) return scene_print_allowed_units(stdout), OK;
    if (!strcmp(word, "expression") || !strcmp(word, "expressions")) return scene_print_expression_syntax(stdout), OK;
    if (!strcmp(word, "run")) return help_print_run_options_files_and_exit_codes(stdout);
    if (!strcmp(word, "trust")) return help_print_guarantees_and_their_tests(stdout);
    if (!strcmp(word, "theory")) return help_print_theory(stdout);
    for (int k = 0; k < commands_count; k++)
        if (!strcmp(word, commands[k].name)) return usage_print_of_command(stdout, &commands[k]), OK;
    TRY(help_misspelt(word));
    return help_topic(word);
}
