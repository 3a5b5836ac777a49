/* Fills a scene from its tree of nodes: first the overrides, then struct scene by the table of keys. */
#include "scene/shape_file.h"
#include "scene_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"

/* Reads the key `space` of the scene into r->scene and sets r->dim. It is read before all other keys, because their
 * meaning depends on the number of dimensions. root: YAML tree of the input file (scene). Returns REFUSED, with a
 * message, if the key is missing or invalid. */
static status read_space(struct reader *r, const struct yaml_node *root)
{
    const struct key *k = key_find("", "space");
    const struct yaml_node *space = yaml_node_find(root, "space");
    if (!space) return fault_report_missing_key(r, root, k);
    TRY(read_value_of_key(r, k, space, r->scene));
    r->dim = r->scene->dim = space_dim(r->scene->space);
    return OK;
}

status scene_read_values_from_yaml_tree(struct reader *r, const struct yaml_node *root)
{
    struct scene *s = r->scene;
    TRY(check_node_kind(r, root, NODE_MAP, "give a scene, which is a mapping of keys to values"));
    r->root = root;
    TRY(check_all_keys_known(r, root));
    TRY(read_space(r, root));
    TRY(read_regions(r, root));
    s->conversion.criteria = CONVERT_ON_BREAK | CONVERT_ON_STRESS;
    TRY(read_keys_of_group(r, root, root, "", s));
    TRY(check_key_combinations_and_set_defaults(r, root));
    TRY(read_materials(r, root));
    TRY(read_bodies(r, root));
    scene_exclude_unused_materials(r->scene);
    TRY(read_interfaces(r, root));
    resolve_default_time_step_safety_factor(r, root);
    detect_lattices_and_resolve_surface_correction(r, root);
    scene_resolve_auto_shape_function_configuration(s);
    TRY(check_particle_count_fits_indices(r, root));
    TRY(read_cracks(r, root));
    TRY(read_initial_states(r, root));
    TRY(read_boundaries(r, root));
    TRY(check_friction_is_supported(r, root));
    TRY(check_no_absorbing_boundary_if_static(r, root));
    TRY(check_loads_are_supported(r, root));
    TRY(check_boundaries_apply_to_all_joined_bodies(r, root));
    TRY(read_probes(r, root));
    TRY(read_regions_of_output_frames(r, root));
    TRY(read_crack_growths(r, root));
    TRY(resolve_default_contact_bodies(r, root));
    return check_keys_supported_by_static_solver(r, root);
}

status scene_text_parse_with_includes_and_overrides(struct reader *r, const char *text, size_t length,
                                                    struct yaml_node **root)
{
    TRY(other_program_file_refuse(r, text, length));
    TRY(tree_parse_yaml(r, text, length, -1, root));
    if (!*root)
        return fault_report_at_location(r, -1, 1, 1, "the scene is empty; begin with keys such as space and duration");
    TRY(tree_rename_old_keys(r, *root));
    TRY(tree_merge_included_files(r, *root));
    TRY(tree_apply_all_overrides(r, *root));
    TRY(tree_rename_old_keys(r, *root)); /* values of overrides may be mappings */
    return read_and_evaluate_variables(r, *root);
}

void scene_free(struct scene *s)
{
    for (int k = 0; k < s->bodies + s->rigids; k++) {
        region_free(&s->body[k].shape);
        for (int part = 0; part < s->body[k].parts; part++) region_free(&s->body[k].part[part].region);
        memory_free(s->body[k].part);
        memory_free(s->body[k].file);
        memory_free(s->body[k].columns);
    }
    for (int k = 0; k < s->cracks; k++) memory_free(s->crack[k].corner);
    for (int k = 0; k < s->initials; k++) {
        region_free(&s->initial[k].region);
        for (int d = 0; d < DIM_MAX; d++) expression_free(&s->initial[k].formula[d]);
    }
    for (int k = 0; k < s->boundaries; k++) {
        region_free(&s->boundary[k].region);
        memory_free(s->boundary[k].time.t);
        memory_free(s->boundary[k].time.value);
        memory_free(s->boundary[k].time_file);
        for (int d = 0; d < DIM_MAX; d++) expression_free(&s->boundary[k].formula[d]);
    }
    for (int k = 0; k < s->probes; k++) {
        region_free(&s->probe[k].region);
        memory_free(s->probe[k].contours.value);
    }
    for (int k = 0; k < s->n_series; k++) region_free(&s->series[k].region);
    memory_free(s->series);
    region_free(&s->pd_region);
    shape_files_free(s->shapes);
    for (int k = 0; k < s->regions; k++) region_free(&s->named[k].region);
    memory_free(s->named);
    memory_free(s->material);
    memory_free(s->material_number);
    memory_free(s->body);
    memory_free(s->interface);
    memory_free(s->crack);
    memory_free(s->initial);
    memory_free(s->boundary);
    memory_free(s->probe);
    memory_free(s->growth);
    memory_free(s->times.value);
    memory_free(s->path);
    memory_free(s->key_place);
    memory_free(s->text);
    *s = (struct scene){0};
}
