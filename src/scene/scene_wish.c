/* Reads what a scene with `method: auto` requires of its pilot runs: the key `accuracy`, the keys that restrict the
 * choice, and the scene itself with a provisional method and spacing. */
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "scene/scene_read.h"
#include "scene/spacings.h"
#include "scene_internal.h"
#include "scene_remedies.h"

#define WITHIN_USUAL 0.01  /* default of accuracy.within [1] */
#define BUDGET_USUAL 300.0 /* default of accuracy.budget [s] */

/* ---- the key accuracy -------------------------------------------------------------------------------------------- */

/* Reads the name of a number of summary.json, such as crack.start_time, from node `of` into figure[capacity]. Returns
 * REFUSED, with a message, for texts that cannot be such a name. */
static status figure_read(struct reader *r, const struct yaml_node *of, char *figure, size_t capacity)
{
    if (of->kind != NODE_SCALAR || !*of->text || strlen(of->text) >= capacity || strpbrk(of->text, " ,/"))
        return fault_report_at_node(
            r, of, "%s is not a figure of summary.json; join its names by points, such as crack.start_time",
            node_value_to_text_for_message(r, of));
    snprintf(figure, capacity, "%s", of->text);
    return OK;
}

/* Reads the key `accuracy`, a number or a mapping {of, within, budget}, into figure, within and budget of w; missing
 * entries get defaults. root: YAML tree of the input file (scene). Returns REFUSED, with a message, for invalid
 * entries. */
static status accuracy_read(struct reader *r, const struct yaml_node *root, struct pilot_requirements *w)
{
    const struct yaml_node *n = tree_find_node_by_path(root, "accuracy");
    w->within = WITHIN_USUAL, w->budget = BUDGET_USUAL, w->figure[0] = '\0';
    if (!n) return OK;
    if (n->kind != NODE_MAP) return read_number(r, key_find("accuracy", "within"), n, &w->within);
    TRY(check_mapping_keys_known_and_unique(r, n, "accuracy"));
    const struct yaml_node *of = yaml_node_find(n, "of"), *within = yaml_node_find(n, "within"),
                           *budget = yaml_node_find(n, "budget");
    if (of) TRY(figure_read(r, of, w->figure, sizeof w->figure));
    if (within) TRY(read_number(r, key_find("accuracy", "within"), within, &w->within));
    return budget ? read_number(r, key_find("accuracy", "budget"), budget, &w->budget) : OK;
}

/* ---- the scene with a provisional method ------------------------------------------------------------------------- */

/* A method with which a scene with `method: auto` is read at first. soft_states: true if bonds that soften have a
 * state-based model. */
struct provisional_method {
    const char *method;
    bool soft_states;
};

/* Reads the scene in text[length], which has `method: auto`, into s with the method `with` instead. Pilot runs choose
 * method, solver, model and spacing later; here they get provisional values that do not contradict the other keys of
 * the scene. spacing: used if the input file (scene) has none [m]. Returns REFUSED, with a message and s freed, if the
 * scene is invalid. */
static status provisional_read(struct reader *r, const char *text, size_t length, struct scene *s,
                               const struct provisional_method *with, real spacing)
{
    static const char *const dropped[] = {"accuracy", "pd.surface"};
    struct reader own = *r;
    struct yaml_node *root;
    char number[32];
    own.scene = s;
    status read = scene_text_parse_with_includes_and_overrides(&own, text, length, &root);
    for (size_t k = 0; k < COUNT_OF(dropped) && read == OK; k++)
        if (tree_find_node_by_path(root, dropped[k])) read = tree_apply_override(&own, root, dropped[k], "");
    const struct yaml_node *space = read == OK ? tree_find_node_by_path(root, "space") : NULL;
    const bool line = space && strcmp(space->text, "line") == 0,
               soft = read == OK && scene_has_material_with_key(root, "tensile_strength"),
               bonds =
                   read == OK && ((soft && !with->soft_states) || scene_has_material_with_key(root, "yield_stress") ||
                                  scene_has_material_with_key(root, "viscosity"));
    if (read == OK && !tree_find_node_by_path(root, "particles.spacing"))
        read =
            tree_apply_override(&own, root, "particles.spacing", number_write_shortest_exact_decimal(number, spacing));
    if (read == OK) read = tree_apply_override(&own, root, "method", with->method);
    if (read == OK) read = tree_apply_override(&own, root, "solver", "explicit");
    if (read == OK && !line && !bonds) read = tree_apply_override(&own, root, "model", "mospd");
    if (read == OK) read = scene_read_values_from_yaml_tree(&own, root);
    r->arena = own.arena;
    if (read != OK) scene_free(s);
    return read;
}

/* Reads the scene in text[length], which has `method: auto`, into s with a provisional method: the first of three that
 * the input file (scene) allows. Tries method adaptive, which is refused for joined bodies; then method pd, which is
 * refused for some Poisson's ratios; then method pd with softening bonds of a state-based model. spacing: used if the
 * scene has none [m]. Returns REFUSED, with a message and s freed, if all are refused. */
static status provisional_read_any(struct reader *r, const char *text, size_t length, struct scene *s, real spacing)
{
    static const struct provisional_method with[] = {{"adaptive", false}, {"pd", false}, {"pd", true}};
    status read = REFUSED;
    for (size_t k = 0; k < COUNT_OF(with) && read == REFUSED; k++)
        read = provisional_read(r, text, length, s, &with[k], spacing);
    return read;
}

/* Reads the scene in text[length], which has `method: auto`, into s with a provisional method. If the input file
 * (scene) has no spacing (`given` is false), reads it with 1 m, computes from it a coarse spacing that resolves all its
 * lengths, and reads it again with that. *most: receives the largest spacing at which bonds can have the tensile
 * strengths of all materials [m]; INFINITY without strengths or if the scene has a spacing. Returns REFUSED, with a
 * message, if the scene is invalid. */
static status provisional_scene(struct reader *r, const char *text, size_t length, struct scene *s, bool given,
                                real *most)
{
    *most = INFINITY;
    r->spacing_most = given ? NULL : most;
    const status first = provisional_read_any(r, text, length, s, 1);
    r->spacing_most = NULL;
    TRY(first);
    real spacing = given ? 0 : spacing_that_resolves_all_lengths(s);
    if (spacing > *most) spacing = spacing_that_fits_box_edges(s, *most, true);
    if (spacing > 0) {
        scene_free(s);
        TRY(provisional_read_any(r, text, length, s, spacing));
    }
    if (!*s->name) snprintf(s->name, sizeof s->name, "%s", r->scene->name);
    s->path = NEW("scene path", strlen(r->name) + 1, char);
    strcpy(s->path, r->name);
    return OK;
}

/* ---- all --------------------------------------------------------------------------------------------------------- */

/* Reads into *requirements what a scene with `method: auto` requires of its pilot runs (runs that choose method and
 * spacing). root: YAML tree of the input file (scene); text[length]: its text. Returns REFUSED, with a message, for an
 * invalid scene, and for one with load steps. */
status auto_method_pilot_run_requirements_read(struct reader *r, const struct yaml_node *root, const char *text,
                                               size_t length, struct pilot_requirements *requirements)
{
    const struct yaml_node *model = tree_find_node_by_path(root, "model"),
                           *solver = tree_find_node_by_path(root, "solver");
    const bool given = tree_find_node_by_path(root, "particles.spacing");
    if (tree_find_node_by_path(root, "steps"))
        return fault_report_at_node(
            r, tree_find_node_by_path(root, "method"),
            "the method auto cannot be combined with load steps (steps); set method: pd or adaptive");
    TRY(accuracy_read(r, root, requirements));
    TRY(provisional_scene(r, text, length, &requirements->provisional, given, &requirements->spacing_most));
    if (given) requirements->spacing = requirements->provisional.spacing;
    if (model) snprintf(requirements->model, sizeof requirements->model, "%s", model->text);
    requirements->at_rest = solver && strcmp(solver->text, "explicit") != 0;
    requirements->has_accuracy = tree_find_node_by_path(root, "accuracy") != NULL;
    requirements->wanted = true;
    return OK;
}
