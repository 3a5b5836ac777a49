/* Sets up a run from its input file: materials, particles, loads, bonds, contact, grid, probes and time step. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "engine_internal.h"
#include "quasistatic/load_steps.h"
#include "base/memory.h"
#include "coupling/coupling_part.h"
#include "grid/grid_part.h"
#include "fracture/fracture_part.h"
#include "probes/probes_part.h"
#include "rigid/rigid_part.h"
#include "loads/mirrors.h"
#include "mesh/mesh_part.h"
#include "step/report.h"
#include "contact/contact.h"
#include "scene/fill.h"
#include "scene/scene_softening.h"
#include "output/output.h"
#include "run/make.h"
#include "step/step.h"
#include "probes/diagnostics.h"
#include "step/checks.h"

static bool has_peridynamics(const struct scene *s) { return s->method != METHOD_MPM; }

/* ---- materials --------------------------------------------------------------------------------------------------- */

/* Computes the critical stretch of bonds for each pair of materials of scene s, from the fracture energy of the weaker
 * material or of an interface between bodies. Allocates the table tables->pair_stretch [materials][materials], to which
 * source->limit then refers. If the problem is a single equilibrium, in which no bond breaks, source->limit becomes
 * bond_limit_never instead. */
static void make_limits(const struct scene *s, struct material_tables *tables, struct bond_source *source)
{
    tables->pair_stretch = NEW("engine.pair_stretch", s->materials * s->materials, real);
    for (int a = 0; a < s->materials; a++)
        for (int b = 0; b < s->materials; b++)
            tables->pair_stretch[a * s->materials + b] =
                scene_critical_stretch_between_materials(s, &s->material[a], &s->material[b]);
    for (int k = 0; k < s->interfaces; k++) {
        const struct scene_interface *face = &s->interface[k];
        const int a = s->body[face->body[0]].material, b = s->body[face->body[1]].material;
        if (!(face->critical_stretch > 0)) continue;
        tables->pair_stretch[a * s->materials + b] = face->critical_stretch;
        tables->pair_stretch[b * s->materials + a] = face->critical_stretch;
    }
    source->limit = (struct bond_limit){
        .critical_stretch = tables->pair_stretch, .materials = s->materials, .last_force = s->last_force};
    if (scene_is_single_equilibrium(s)) source->limit = bond_limit_never; /* no bond breaks in a static solution */
}

/* Sets the softening law of bonds for each pair of materials of scene s: in tables->pair_softening
 * [materials][materials], which is allocated, and in source->limit, which refers to it. A bond between two materials
 * softens like that material which begins to soften at the smaller stretch. Does nothing if no material softens. */
static void make_softening(const struct scene *s, struct material_tables *tables, struct bond_source *source)
{
    bool any = false;
    for (int m = 0; m < s->materials; m++) any |= material_has_softening_bonds(&s->material[m]);
    if (!any) return;
    tables->pair_softening = NEW("engine.pair_softening", s->materials * s->materials, struct softening_pair);
    for (int a = 0; a < s->materials; a++) {
        if (material_has_softening_bonds(&s->material[a]))
            tables->curve = softening_curve_of_law(s->material[a].softening);
        for (int b = 0; b < s->materials; b++) {
            const struct material *m = &s->material[a], *n = &s->material[b];
            const struct material *first = m->onset_stretch <= n->onset_stretch ? m : n;
            tables->pair_softening[a * s->materials + b] = (struct softening_pair){
                real_min(first->onset_stretch, tables->pair_stretch[a * s->materials + b]),
                first->scatter.given && first->scatter.of == SCATTER_STRENGTH, material_has_strength_surface(first),
                first->rate.points > 0 ? &first->rate : NULL};
        }
    }
    source->limit.softening = tables->pair_softening, source->limit.curve = &tables->curve;
}

/* Computes two properties of bonds for each pair of materials of scene s: the yield stretch s_y = sigma_y/E, and the
 * hardening H_b/k_e = H/E (hardening modulus of a bond divided by its elastic stiffness). sigma_y, E and H are yield
 * stress, Young's modulus and plastic modulus of that material of the pair which yields first. A bar of one material
 * then has the uniaxial stress-strain curve of that material. The tables [materials][materials] are allocated in
 * *tables; *source refers to them. Does nothing if no material yields. */
static void make_yields(const struct scene *s, struct material_tables *tables, struct bond_source *source)
{
    bool any = false;
    for (int m = 0; m < s->materials; m++) any = any || material_yields(&s->material[m]);
    if (!any) return;
    tables->pair_yield = NEW("engine.pair_yield", s->materials * s->materials, real);
    tables->pair_hardening = NEW("engine.pair_hardening", s->materials * s->materials, real);
    for (int a = 0; a < s->materials; a++)
        for (int b = 0; b < s->materials; b++) {
            const struct material *m = &s->material[a], *n = &s->material[b];
            const real first = material_yields(m) ? m->yield_stress / m->young : INFINITY;
            const real second = material_yields(n) ? n->yield_stress / n->young : INFINITY;
            const struct material *soft = second < first ? n : m;
            tables->pair_yield[a * s->materials + b] = real_min(first, second);
            tables->pair_hardening[a * s->materials + b] =
                material_yields(soft) ? soft->yield_hardening / soft->young : 0;
        }
    source->yield = (struct bond_yield){tables->pair_yield, tables->pair_hardening, s->materials};
}

/* Computes the moduli of state-based models for each material of scene s (A and B of kernels/pd/state_laws.h) in
 * tables->modulus, which is allocated, and sets the options of these models in *source. Does nothing for bond-based
 * models. */
static void make_states(const struct scene *s, struct material_tables *tables, struct bond_source *source)
{
    if (s->model == MODEL_BOND) return;
    tables->modulus = NEW("engine.modulus", s->materials, struct state_modulus);
    for (int k = 0; k < s->materials; k++)
        tables->modulus[k] = state_based_moduli_of_material(&s->material[k], s->space, s->model == MODEL_MOSPD);
    source->modulus = tables->modulus;
    source->local = !s->bulk, source->rotates = s->model == MODEL_MOSPD;
}

/* Returns the principal stress [Pa] at which material points of material m convert to peridynamic particles: the key
 * conversion.stress times the factor conversion.alpha of the scene. By default conversion.stress is the uniaxial stress
 * at the stretch at which bonds break or, if they soften, begin to soften; with a larger stress, points may exceed the
 * strain at which bonds break. Returns INFINITY if points do not convert by stress. */
static real conversion_trigger(const struct scene *s, const struct material *m)
{
    if (s->method != METHOD_ADAPTIVE || !(s->conversion.criteria & CONVERT_ON_STRESS)) return INFINITY;
    real most = isnan(s->conversion.stress) ? material_uniaxial_stress(m, m->onset_stretch) : s->conversion.stress;
    return s->conversion.alpha * most;
}

/* Creates tables->elastic[materials], the elastic constants of the materials of scene s for the kernels, and the tables
 * of stretches at which bonds between two materials break, soften and yield, to which *source then refers. */
static void make_materials(const struct scene *s, struct material_tables *tables, struct bond_source *source)
{
    tables->elastic = NEW("engine.elastic", s->materials, struct elastic);
    for (int m = 0; m < s->materials; m++) {
        const struct material *given = &s->material[m];
        tables->wave_speed = real_max(tables->wave_speed, given->wave_speed);
        tables->elastic[m] = (struct elastic){.c11 = given->c11,
                                              .c12 = given->c12,
                                              .shear = given->shear,
                                              .space = s->space,
                                              .poisson = given->poisson,
                                              .law = given->law.given ? &given->law : NULL,
                                              .mode = scene_has_load_steps(s) ? LAW_LOAD_STEP : LAW_EXPLICIT,
                                              .mean_dilatation = material_uses_mean_dilatation(given, s->space),
                                              .trigger = conversion_trigger(s, given),
                                              .trigger_mean = conversion_trigger(s, given),
                                              .failure = s->conversion.alpha * given->surface.g0};
        if (isfinite(tables->elastic[m].trigger)) tables->elastic[m].surface = given->surface;
    }
    make_limits(s, tables, source);
    make_softening(s, tables, source);
    make_yields(s, tables, source);
    make_states(s, tables, source);
}

/* ---- peridynamics ------------------------------------------------------------------------------------------------ */

/* Lists the planes of symmetry of scene s for the bonds, and creates the mirror images of pre-cracks, which cut bonds
 * across these planes. Both are owned by *tables; *source refers to them. loads: state on which side of each plane the
 * body is. Without peridynamic particles only the planes are listed. */
static void make_mirrors(const struct scene *s, const struct loads *loads, struct material_tables *tables,
                         struct bond_source *source)
{
    const real tolerance = LOADS_TOLERANCE * s->spacing;
    tables->mirror_axis = NEW("engine.mirror_axis", s->boundaries, int);
    for (int b = 0; b < s->boundaries; b++)
        tables->mirror_axis[b] =
            boundary_is_mirror_without_tangential_motion(&s->boundary[b], s->dim) ? -1 : s->boundary[b].axis;
    source->mirror_axis = tables->mirror_axis;
    tables->mirror = NEW("engine.mirror", s->boundaries, struct mirror_plane);
    for (int b = 0; b < s->boundaries; b++)
        if (s->boundary[b].kind == BOUNDARY_MIRROR &&
            !boundary_is_mirror_without_tangential_motion(&s->boundary[b], s->dim))
            tables->mirror[source->mirrors++] =
                (struct mirror_plane){s->boundary[b].axis, loads->load[b].outside, s->boundary[b].at};
    source->mirror = tables->mirror;
    if (!has_peridynamics(s)) return;
    source->given = s->crack, source->givens = s->cracks;
    cracks_make_mirror_images(&tables->cracks, s->crack, s->cracks, source->mirror, source->mirrors,
                              source->family.cutoff, tolerance);
    source->crack = tables->cracks.crack, source->cracks = tables->cracks.n, source->crack_of = tables->cracks.of;
}

/* Converts the initial peridynamic particles and creates the bonds of the run. before: run from which broken bonds are
 * transferred, or NULL. Returns REFUSED or FAILED, with a message, if surface weights or pre-cracks cannot be made. */
static status make_bonds(struct run *run, struct predecessor *before)
{
    const struct scene *s = run->scene;
    make_mirrors(run->scene, &run->loads, &run->tables, &run->source);
    run->source.image = run->loads.image;
    if (material_tables_list_bodies_with_possible_voids(&run->tables, s, &run->loads)) {
        voids_mark_particles_beside_voids(&run->tables.voids, &run->part, &run->cells, run->loads.image,
                                          scene_interaction_distance_across_voids(s, run->source.family.cutoff));
        run->source.voids = &run->tables.voids;
    }
    run->source.room = bonds_neighbour_count_upper_bound(&run->source);
    if (s->surface == SURFACE_VOLUME && has_peridynamics(s)) {
        run->tables.neighbour_volume = NEW("engine.neighbour_volume", run->part.n_all, real);
        bonds_compute_family_volumes(run->tables.neighbour_volume, &run->part, &run->source);
        run->source.neighbour_volume = run->tables.neighbour_volume;
    }
    if (s->surface == SURFACE_MOMENTS && has_peridynamics(s))
        TRY(surface_correction_compute_bond_weight_factors(&run->tables.surface, &run->source, &run->part, &run->loads,
                                                           s));
    if (s->method == METHOD_ADAPTIVE) TRY(precracks_apply_as_slits_or_cut_bonds(run));
    if (before)
        run_transfer_particles_from_predecessor(
            run, before); /* after precracks_apply_as_slits_or_cut_bonds, which makes slits from initial particles */
    bonds_make(&run->bonds, NULL, &run->part, &run->source);
    if (before) run_transfer_broken_bonds_from_predecessor(run, before);
    run->coupling->conversion.first_time = NAN;
    run->coupling->conversion.start = run->coupling->conversion.peak = run->part.n_of[KIND_PD];
    run->coupling->conversion.peak_bonds = run->bonds.n;
    return OK;
}

#define DAMPING_SHARE_MOST (1.0 / 16) /* largest share that is stable, see interface_zone.h */

/* Returns the share of damping in a step [1]: the fraction of the relative velocity across the interface between
 * peridynamic particles and material points that is removed, at most DAMPING_SHARE_MOST. s: scene, with the strength of
 * the damping; c: wave speed [m/s]; dt: time step [s]; h: spacing of the grid [m]. */
static real interface_damping_share(const struct scene *s, real c, real dt, real h)
{
    return real_min(s->interface_damping * c * dt / h, DAMPING_SHARE_MOST);
}

static void tables_free(struct material_tables *t)
{
    memory_free(t->pair_stretch), memory_free(t->pair_softening), memory_free(t->pair_yield),
        memory_free(t->pair_hardening);
    memory_free(t->elastic), memory_free(t->modulus), memory_free(t->impedance);
    memory_free(t->mirror_axis), memory_free(t->mirror), crack_list_free(&t->cracks);
    voids_free(&t->voids), memory_free(t->void_mirror);
    memory_free(t->neighbour_volume), surface_correction_free(&t->surface);
}

/* ---- all --------------------------------------------------------------------------------------------------------- */

/* Returns the set of optional arrays of particles that a material with the flow law `law` requires, as a sum of WITH_*;
 * 0 for an elastic material. */
static int law_arrays(const struct law *law)
{
    if (!law->given) return 0;
    return WITH_PLASTIC | (law->kinematic.modulus > 0 ? WITH_BACK_STRESS : 0) |
           (flow_law_plastic_work_heats_material(law) ? WITH_TEMPERATURE : 0);
}

/* Returns the set of optional arrays of particles that scene s requires, as a sum of WITH_*. */
static int optional_arrays(const struct scene *s)
{
    int optional = (s->transfer == TRANSFER_APIC ? WITH_GRADIENT : 0) | (s->shape == SHAPE_CPGIMP ? WITH_STRETCH : 0);
    const int meshed = scene_has_load_steps(s) || scene_has_yielding_total_lagrangian_mpm_body(s)
                           ? WITH_PLASTIC_CORRECTION | WITH_MESH_STRESS
                           : 0;
    for (int m = 0; m < s->materials; m++)
        if (s->material[m].law.given) optional |= meshed | law_arrays(&s->material[m].law);
    if (optional & WITH_PLASTIC && s->space == SPACE_PLANE_STRAIN) optional |= WITH_OUT_OF_PLANE;
    if (s->method == METHOD_ADAPTIVE && s->conversion.reverts) optional |= WITH_REVERSION;
    if (s->method != METHOD_MPM && scene_has_random_strength(s)) optional |= WITH_STRENGTH;
    if (s->method == METHOD_ADAPTIVE && s->model != MODEL_BOND)
        optional |= WITH_ENDS | (s->model == MODEL_MOSPD ? WITH_ROTATIONS : 0);
    return optional;
}

/* Returns the force law of bonds in the peridynamic model of scene s. source: states whether bonds yield or soften; if
 * both, they yield. */
static enum pd_model law_of(const struct scene *s, const struct bond_source *source)
{
    if (s->model == MODEL_OSPD) return PD_OSPD;
    if (s->model == MODEL_MOSPD) return PD_MOSPD;
    return source->yield.stretch ? PD_BOND_PLASTIC : source->limit.softening ? PD_BOND_SOFT : PD_BOND;
}

/* Computes the critical time step and the time step of the run, or copies both from the run `before`, which the run
 * replaces. before: NULL if there is none. Returns REFUSED, with a message, if no time step is possible. */
static status make_time(struct run *run, const struct predecessor *before)
{
    if (!before) return scene_prepend_location_to_error_message(run->scene, run_choose_time_step_and_step_count(run));
    run->clock = before->run->clock;
    run->source.limit.dt = before->run->source.limit.dt;
    run->source.core = run->bonds.core = before->run->source.core;
    return OK;
}

/* Initialises contact c with the contact law of scene s. Bodies have no contact in a single equilibrium or without
 * peridynamic particles. source, rigid: data of bonds and rigid bodies, kept by reference; they must outlive c. Release
 * c with contact_free. */
static void make_contact(struct contact *c, const struct scene *s, const struct bond_source *source,
                         struct rigid_set *rigid)
{
    const struct contact_law law = {
        .form = s->contact_form, .distance = s->contact_distance, .friction = s->contact_friction};
    contact_make(c, !scene_is_single_equilibrium(s) && has_peridynamics(s) ? s->contact_between : CONTACT_NONE, law,
                 s->contact_stiffness, source, rigid->shape, rigid->body, s->rigids);
}

/* Creates the materials, kernels and particles of the run. Returns REFUSED, with a message, if there is not enough
 * memory or a body cannot be filled with particles. */
static status make_particles(struct run *run)
{
    const struct scene *s = run->scene;
    run->optional = optional_arrays(s);
    make_materials(s, &run->tables, &run->source);
    run->source.family = scene_make_complete_lattice_family(s);
    run->source.material = s->material, run->source.materials = s->materials;
    kernels_choose(&run->kernels, s->dim, law_of(s, &run->source), s->shape, s->transfer);
    TRY(scene_prepend_location_to_error_message(
        s, cells_without_particles_predict_from_scene(&run->frame->hollow, s, &run->source)));
    if (!run->frame->hollow.absent)
        TRY(scene_prepend_location_to_error_message(s, run_check_memory_suffices(s, &run->part, &run->source)));
    TRY(bodies_fill_with_particles(&run->part, s, &run->frame->hollow, run->optional));
    conversion_stresses_set_by_weakest_particles(run->tables.elastic, &run->part);
    return scene_prepend_location_to_error_message(
        s, run_check_memory_suffices(s, &run->part, &run->source)); /* with the actual number of particles */
}

/* Creates crack tips, crack growth, static solver, diagnostics and probes of the run. Returns REFUSED, with a message,
 * if the scene does not allow the growth of a crack by stress-intensity factors, the static solver or a probe as it is
 * specified. */
static status make_probes(struct run *run)
{
    const struct scene *s = run->scene;
    run->probing->strain_stress = particles_largest_stress_component(&run->part);
    tips_make_at_precrack_ends(&run->fracture->tips, &run->part, &run->cells, s->crack, s->cracks, s->spacing,
                               s->speed_window);
    if (run->coupling->notches.lost)
        tips_ignore_particles_damaged_by_precracks(&run->fracture->tips, run->coupling->notches.lost);
    TRY(scene_prepend_location_to_error_message(s, sif_growth_check_direction_is_determinable(run)));
    run->fracture->growth = NEW("engine.growth", s->growths, struct growing_crack);
    run->fracture->growths = s->growths;
    for (int k = 0; k < s->growths; k++) growing_crack_make(&run->fracture->growth[k], &s->growth[k]);
    if (scene_is_single_equilibrium(s))
        TRY(scene_prepend_location_to_error_message(s, run_make_single_equilibrium_solver(run)));
    diagnostics_initialise(run->diagnostics);
    run->diagnostics->mass = run->mass;
    scene_list_initial_wave_pulses(run->scene, run->probing);
    struct observed_run o = observed_run_make_read_only_view(run);
    return scene_prepend_location_to_error_message(s, probes_make(&run->probing->probes, s->probe, s->probes, &o));
}

/* Creates loads, bonds, rigid bodies, contact, coupling and mesh of the run, and computes the time step. Call it after
 * make_particles. before: run that the run replaces, or NULL. Returns REFUSED or FAILED, with a message, if one of them
 * is impossible in the scene. */
static status make_forces(struct run *run, struct predecessor *before)
{
    const struct scene *s = run->scene;
    TRY(scene_prepend_location_to_error_message(
        s, bodies_choose_lagrangian_mesh_or_background_grid(run->frame, run->grid, &run->part, s)));
    if (!scene_is_dynamic(s)) run->boundary = NEW("engine.boundary", s->boundaries, struct boundary);
    if (scene_is_single_equilibrium(s))
        static_boundaries_make_from_dynamic(run->boundary, s->boundary, s->boundaries, s->duration, 1);
    else if (run->boundary)
        array_copy(run->boundary, s->boundary, s->boundaries, sizeof *run->boundary);
    TRY(scene_prepend_location_to_error_message(
        s, loads_make_from_boundaries(&run->loads, run->boundary ? run->boundary : s->boundary, s->boundaries,
                                      &run->part, s->spacing, run->source.family.cutoff, run->optional)));
    if (has_peridynamics(s))
        TRY(scene_prepend_location_to_error_message(
            s, loads_check_distance_between_mirrors(&run->loads, run->source.family.cutoff)));
    run->tables.impedance = absorbing_boundary_impedances(s, &run->source);
    const struct impedance *z = run->tables.impedance;
    if (z)
        absorbing_dashpots_make(&run->loads, &run->part,
                                (const struct impedance *const[MOVERS]){z, z + s->materials, z + 2 * s->materials});
    cells_make_for_neighbour_search(&run->cells, &run->part, run->source.family.cutoff * (1 + 1e-9));
    run->source.cells = &run->cells;
    TRY(make_bonds(run, before));
    TRY(rigids_make(run->rigid, s));
    TRY(rigids_check_no_overlap_at_start(run->rigid, s, &run->part));
    TRY(scene_prepend_location_to_error_message(
        s, joined_bodies_check_within_bond_reach(s, &run->part, &run->cells, run->source.family.cutoff)));
    TRY(scene_prepend_location_to_error_message(s, load_steps_check_scene_is_supported(run)));
    make_contact(run->contact, s, &run->source, run->rigid);
    coupling_set_up_pd_mpm_method_and_interface(run);
    TRY(scene_prepend_location_to_error_message(s, coupling_build_total_lagrangian_mesh(run, before != NULL)));
    TRY(prescribed_motion_check_is_admissible(&run->loads, &run->part, s, before == NULL));
    bonded_mpm_points_update_cell_strain(&run->coupling->partial, run->frame, &run->part, s->material);
    stability_store_largest_initial_speed(run->stability, &run->part);
    return make_time(run, before);
}

status run_create_and_transfer_from_predecessor(struct run *run, const struct scene *s, struct output *output,
                                                struct cells_without_particles omitted_cells,
                                                struct predecessor *predecessor)
{
    memset(run, 0, sizeof *run);
    run_components_allocate(run);
    run->save = run_save_or_load_state;
    run->scene = s;
    run->warnings.locate = scene_find_file_location_of_warning, run->warnings.scene = s;
    run->report->out = output;
    run->report->began = wall_clock_seconds();
    run->frame->hollow = omitted_cells;
    TRY(make_particles(run));
    TRY(scene_prepend_location_to_error_message(s, reversion_check_scene_allows_return_to_mpm(run->scene)));
    TRY(make_forces(run, predecessor));
    for (int64_t i = 0; i < run->part.n; i++) run->mass += run->part.mass[i];
    run->mass += (real)(run->part.n_body - run->part.n) * run->part.mass[0];
    if (!predecessor) TRY(scene_prepend_location_to_error_message(s, mesh_levels_make_coarse_cells(run, false)));
    run->coupling->damping_share =
        interface_damping_share(s, run->tables.wave_speed, run->clock.dt, run->grid->field[0].grid.h);
    run->coupling->approaches = s->method == METHOD_ADAPTIVE && s->contact_between != CONTACT_NONE &&
                                s->contact_convert && scene_first_body_of_joined_group(s, 1) + s->rigids >= 0 &&
                                !coupling_moves_all_particles_by_one_grid(s->coupling);
    run->grid->transfer = (struct transfer_data){.order = &run->grid->field[0].order,
                                                 .partial = &run->coupling->partial,
                                                 .elastic = run->tables.elastic,
                                                 .half_width = grid_shape_function_reach_beyond_cell(s),
                                                 .dt = run->clock.dt,
                                                 .dt_velocity = run->clock.dt,
                                                 .laws = run->part.plastic_work != NULL};
    for (int m = 0; m < s->materials; m++)
        run->grid->transfer.mean_dilatation |= run->tables.elastic[m].mean_dilatation;
    if (run->grid->transfer.mean_dilatation)
        run->grid->transfer.dilatation = NEW("engine.dilatation", run->part.n, real);
    corotating_groups_make_for_flip_transfer(run->grid, &run->part, &run->loads, run->scene, run->coupling_kind);
    return make_probes(run);
}

status run_set_up_from_scene(struct run *run, const struct scene *s, struct output *output)
{
    struct cells_without_particles hollow = {0};
    for (;;) {
        TRY(run_create_and_transfer_from_predecessor(run, s, output, hollow, NULL));
        if (!run->frame->lacks) return OK;
        hollow = run->frame->hollow;
        run->frame->hollow = (struct cells_without_particles){0};
        run_free_memory(run);
    }
}

void run_free_memory(struct run *run)
{
    if (run->report && run->report->out)
        (void)output_wait_until_frame_is_written(run->report->out); /* the writer of frames still reads the particles */
    run_components_free(run);
    bonds_free(&run->bonds);
    cells_free(&run->cells);
    loads_free(&run->loads);
    particles_free(&run->part);
    memory_free(run->boundary);
    tables_free(&run->tables);
    warnings_free(&run->warnings);
    memset(run, 0, sizeof *run);
}
