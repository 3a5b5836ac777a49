/* Plans the pilot runs (short runs that choose method and spacing): lists the applicable methods, and prints what
 * `cleave check` says about the runs. */
#include <math.h>
#include <string.h>

#include "pilot_parts.h"
#include "scene/spacings.h"

/* ---- methods ----------------------------------------------------------------------------------------------------- */

/* Returns true if bond-based peridynamics is applicable to the scene s: the Poisson's ratios of all materials are that
 * of this model, or the scene is 1D. */
static bool bonds_fit(const struct scene *s)
{
    bool fit = true;
    for (int m = 0; m < s->materials; m++)
        fit &= s->dim == 1 || fabs(s->material[m].poisson - bond_based_poisson_ratio(s->space)) < 1e-6;
    return fit;
}

static bool needs_bonds(const struct scene *s)
{
    return scene_can_have_cracks(s) || s->has_pd_region || scene_has_probe_of_broken_bonds(s);
}

static void candidate_add(struct pilot_search *p, const char *name, const char *method, const char *model)
{
    if (model && p->wish.model[0] && strcmp(p->wish.model, model) != 0) return;
    p->at[p->n++] = (struct pilot_candidate){.name = name, .method = method, .model = model};
}

/* Returns true if bonds of the scene s may break or if it prescribes growing cracks. */
static bool may_crack(const struct scene *s) { return scene_bonds_can_break(s) || s->growths > 0; }

/* Lists in p->at the methods that are applicable to the scene: material points unless bonds are required, peridynamics
 * with bonds or with state-based neighbourhoods, and adaptive runs if bonds can break or the input file (scene) has a
 * peridynamic region. */
static void candidates_find(struct pilot_search *p)
{
    const struct scene *s = &p->wish.provisional;
    const bool asked_bond = !strcmp(p->wish.model, "bond"), bond = asked_bond || bonds_fit(s);
    const bool breaks = may_crack(s), zones = s->has_pd_region;
    /* At equilibrium material points converge slowly, while bonds have conjugate gradients. */
    if (!needs_bonds(s) && !p->wish.at_rest) candidate_add(p, "points", "mpm", NULL);
    if (!zones) candidate_add(p, bond ? "bonds" : "states", "pd", bond ? "bond" : "ospd");
    if (!zones && !strcmp(p->wish.model, "mospd")) candidate_add(p, "rotations", "pd", "mospd");
    if ((breaks || zones) && !p->wish.at_rest)
        candidate_add(p, bond ? "adaptive bonds" : "adaptive states", "adaptive", bond ? "bond" : "mospd");
}

/* Returns true if the boundary condition b moves or loads particles; false if it only keeps them at rest. dim:
 * dimension of the space. */
static bool boundary_acts(const struct boundary *b, int dim)
{
    bool acts = b->rotates || b->time_unit;
    for (int d = 0; d < dim; d++) acts |= b->formula[d].n > 0 || b->value[d] != 0;
    return acts && b->kind != BOUNDARY_MIRROR && b->kind != BOUNDARY_ABSORBING;
}

/* Returns true if something moves or loads the bodies of the scene s: loads, driven supports, gravity, initial states,
 * growing cracks, or bodies with a velocity or force. */
static bool scene_acts(const struct scene *s)
{
    bool acts = s->initials > 0 || s->growths > 0;
    for (int b = 0; b < s->boundaries; b++) acts |= boundary_acts(&s->boundary[b], s->dim);
    for (int d = 0; d < s->dim; d++) acts |= s->gravity[d] != 0;
    for (int b = 0; b < s->bodies + s->rigids; b++)
        for (int d = 0; d < s->dim; d++) acts |= s->body[b].velocity[d] != 0 || s->body[b].force[d] != 0;
    return acts;
}

/* ---- the plan ---------------------------------------------------------------------------------------------------- */

/* Lists the methods that are applicable to the scene in search->at. Returns REFUSED, with a message, if there is none,
 * or if pilot runs are not possible: particles from a list, no length to choose a spacing from, an unknown result,
 * nothing that moves or loads the bodies. */
status pilot_runs_list_applicable_methods(struct pilot_search *search)
{
    const struct scene *s = &search->wish.provisional;
    for (int b = 0; b < s->bodies; b++)
        if (s->body[b].file)
            return status_set(REFUSED,
                              "%s: method: auto varies the spacing, but a body of this scene comes from a particle "
                              "list, whose spacing is fixed; give a method and particles.spacing",
                              search->scene);
    if (!(search->wish.spacing > 0) && !(spacing_that_resolves_all_lengths(s) > 0))
        return status_set(REFUSED,
                          "%s: the scene has no length from which pilot runs could choose a spacing; give method and "
                          "particles.spacing",
                          search->scene);
    if (!scene_acts(s))
        return status_set(REFUSED,
                          "%s: method: auto compares results, but nothing moves or loads the bodies: add a boundary "
                          "with a value, gravity, initial or velocity",
                          search->scene);
    if (search->wish.figure[0]) TRY(result_name_check_is_known(s, search->wish.figure));
    candidates_find(search);
    return search->n > 0
               ? OK
               : status_set(REFUSED,
                            "%s: no method of the pilot runs can be combined with the model, solver and pd.region "
                            "of the scene; give a method and particles.spacing",
                            search->scene);
}

const char *pilot_runs_get_requested_result_name(const struct pilot_search *search)
{
    if (search->wish.figure[0]) return search->wish.figure;
    if (search->wish.provisional.probes > 0) return "the first result of its probes that is not zero";
    if (may_crack(&search->wish.provisional) && !search->wish.at_rest)
        return "crack.start_time, or the largest of its energies if nothing breaks";
    return "the largest of its energies";
}

status pilot_runs_print_plan(const struct pilot_requirements *requirements, const char *scene, FILE *out)
{
    struct pilot_search p = {.scene = scene, .wish = *requirements};
    TRY(pilot_runs_list_applicable_methods(&p));
    const double spacing = 1e3 * requirements->provisional.spacing;
    fprintf(out, "%s can be read\n", printable_name(scene).text);
    fprintf(out, "auto           cleave run chooses method and spacing by pilot runs; check can read the scene.yaml "
                 "that the run writes\n");
    fprintf(out, "auto           pilot runs estimate the error of %s; %.3g %% is allowed\n",
            pilot_runs_get_requested_result_name(&p), 100 * requirements->within);
    fprintf(out, "auto           pilot runs vary the method (");
    for (int k = 0; k < p.n; k++) fprintf(out, "%s%s", k > 0 ? ", " : "", p.at[k].name);
    if (requirements->spacing > 0)
        fprintf(out, "), the spacing (%.4g mm as given, and coarser)", spacing);
    else
        fprintf(out, "), the spacing (it starts at %.4g mm; coarser and finer ones are run as well", spacing);
    if (isfinite(requirements->spacing_most))
        fprintf(out, ", at most %.4g mm is chosen, by tensile_strength", 1e3 * requirements->spacing_most);
    if (!(requirements->spacing > 0)) fprintf(out, ")");
    fprintf(out, "%s\n", requirements->at_rest ? "" : " and the time step (0.9 to 1.1 of its own)");
    if (requirements->at_rest)
        fprintf(out, "auto           the solver of this scene finds one equilibrium, in which no bond breaks; for a "
                     "crack that grows under rising loads use method: pd or adaptive with solver: static\n");
    fprintf(out,
            "auto           pilot runs take at most %.4g s (accuracy.budget), of which %.4g s are for the first %d "
            "runs of each method; the run that is chosen takes at most %.4g s\n",
            requirements->budget, PILOT_FIRST_SHARE * requirements->budget, PILOT_RUNS_FIRST * PILOT_LEVELS_FIRST,
            PILOT_LONGEST * requirements->budget);
    return OK;
}
