/* Adds warnings about suspicious input before a run starts, by measurements of its particles, bonds and grid. */
#include <math.h>

#include "engine_internal.h"
#include "run/part.h"
#include "grid/grid_part.h"
#include "mesh/mesh_part.h"
#include "output/output.h"
#include "data/extent.h"

/* Names of couplings in scene files, for messages. */
static const char *const coupling_name[] = {
    [COUPLING_PM] = "pm", [COUPLING_PG] = "pg", [COUPLING_PMG] = "pmg", [COUPLING_PGG] = "pgg"};

/* Returns true if a boundary condition or an initial state of scene s makes a body rotate. */
static bool spins(const struct scene *s)
{
    bool any = false;
    for (int b = 0; b < s->boundaries; b++) any |= s->boundary[b].rotates;
    for (int k = 0; k < s->initials; k++)
        for (int a = 0; a < s->dim; a++)
            for (int b = 0; b < a; b++) {
                const real *gradient = s->initial[k].velocity_gradient;
                any |= gradient[a * s->dim + b] != gradient[b * s->dim + a];
            }
    return any;
}

/* Adds a warning to *to if bodies of the dynamic scene s rotate on the grid and velocities are transferred by FLIP,
 * which does not conserve their angular momentum. grid: no warning is added if its points rotate in groups, which
 * conserves angular momentum. The results in the warning were measured with a plate that rotates freely, with edges at
 * 30 m/s and cells of two spacings. */
static void warn_of_spin(const struct scene *s, const struct grid_method *grid, struct warnings *to)
{
    if (scene_is_dynamic(s) && s->transfer == TRANSFER_FLIP && spins(s) && grid->turning.groups == 0)
        warnings_add_if_new(to,
                            "mpm.transfer: flip loses angular momentum of rotating bodies with this coupling (a plate "
                            "of 20 x 10 points: 28 %% in half a turn, with apic 0.002 %%); set mpm.transfer: apic");
}

/* Adds warnings to *to about pre-cracks in scenes without bonds, which have no effect there, and about coupling methods
 * that differ from their published definition or do not derive from an energy. kind: coupling method. */
static void warn_of_coupling(const struct scene *s, enum coupling kind, struct warnings *to)
{
    if (s->method == METHOD_MPM && s->cracks > 0)
        warnings_add_if_new(to, "method: mpm ignores the key cracks: points on both sides of a crack share the nodes "
                                "of the grid, so the body stays whole; set method: pd or adaptive");
    if ((kind == COUPLING_PM || kind == COUPLING_PMG) && s->shape != SHAPE_LINEAR)
        warnings_add_if_new(to, "coupling: pm and pmg are defined with mpm.shape: linear only, and act as pg and pgg "
                                "with another shape; set mpm.shape: linear, or coupling: pg or pgg");
    if (coupling_moves_pd_particles_by_grid(kind) && !scene_silences_warning(s, ACCEPT_COUPLING))
        warnings_add_if_new(
            to,
            "coupling: %s, as published, has forces that do not derive from an energy, so a long run may gain energy; "
            "watch energy.balance_error, or set coupling: partial stress; if this is intended, add accept: [coupling]",
            coupling_name[kind]);
}

/* Adds warnings to *to about quadratic and cubic shape functions of scene s if a boundary prescribes the motion of
 * points on a grid, and about cells with fewer than 1.5 points along an edge. on_grid: true if the shape functions of
 * material points are those of a regular grid at their present positions, false if those of a mesh at their reference
 * positions. */
static void warn_of_cells(const struct scene *s, bool on_grid, struct warnings *to)
{
    bool driven = false;
    for (int b = 0; b < s->boundaries; b++) driven |= s->boundary[b].kind == BOUNDARY_VELOCITY;
    if (driven && on_grid && (s->shape == SHAPE_QUADRATIC || s->shape == SHAPE_CUBIC))
        warnings_add_if_new(
            to,
            "mpm.shape: %s makes stress beside fixed and driven particles up to a third too large, and displacements "
            "there 2 to 3 %%; hold the face by a boundary `mirror`, or set mpm.shape: linear or gimp",
            s->shape == SHAPE_CUBIC ? "cubic" : "quadratic");
    if (s->method != METHOD_PD && s->cell < 1.5 && !scene_silences_warning(s, ACCEPT_CELL))
        warnings_add_if_new(
            to,
            "mpm.cell: %.3g puts one point into a cell, so a wave that crosses from material points to bonds leaves an "
            "oscillation of 0.8 %% of its amplitude; set mpm.cell: 2; if this is intended, add accept: [cell]",
            s->cell);
}

/* Adds warnings to *to about keys for coarse mesh cells and for slits (pre-cracks as gaps in the mesh) that have no
 * effect in the scene s. frame: reference frame of the run, with the mesh of the undeformed body. */
static void warn_of_idle_keys(const struct scene *s, const struct lagrangian_mesh *frame, struct warnings *to)
{
    const char *why = s->method == METHOD_PD    ? "method pd has no cells"
                      : !scene_is_dynamic(s)    ? "a static solver cannot use coarse cells"
                      : frame->mesh.points == 0 ? "no material points are in the reference frame"
                                                : NULL;
    const char *all = scene_reason_all_particles_must_be_created(s);
    if (s->levels != LEVELS_AUTO && s->levels > 0 && why)
        warnings_add_if_new(to, "mpm.levels: %d has no effect, because %s; set mpm.levels: auto or 0", s->levels, why);
    if (s->fill == FILL_NEEDED && (why || all || frame->levels.n == 0))
        warnings_add_if_new(
            to, "mpm.fill: needed has no effect (all particles are made), because %s; set mpm.fill: auto or all",
            why   ? why
            : all ? all
                  : "there are no coarse cells");
    if (s->conversion.notch == NOTCH_SLIT && s->cracks > 0 && s->method != METHOD_ADAPTIVE)
        warnings_add_if_new(to, "conversion.notch: slit has no effect with method: %s%s; set conversion.notch: auto",
                            s->method == METHOD_PD ? "pd" : "mpm",
                            s->method == METHOD_PD ? ", in which pre-cracks are cut bonds" : "");
}

/* Adds warnings to *to about materials of scene s whose points convert at a stress above the one at which bonds break.
 * tables: stresses of conversion of the materials. */
static void warn_of_materials(const struct scene *s, const struct material_tables *tables, struct warnings *to)
{
    for (int m = 0; m < s->materials; m++) {
        const struct material *a = &s->material[m];
        if (isfinite(tables->elastic[m].trigger) && tables->elastic[m].trigger_mean > a->young * a->onset_stretch)
            warnings_add_if_new(
                to,
                "material %s: material points become peridynamic at a stress of %.4g Pa, above the %.4g Pa (E %s) at "
                "which bonds %s, so points may exceed %s stretch before they convert; use a lower conversion.stress",
                a->name, tables->elastic[m].trigger_mean, a->young * a->onset_stretch,
                material_has_softening_bonds(a) ? "s_0" : "s_c",
                material_has_softening_bonds(a) ? "begin to soften" : "break",
                material_has_softening_bonds(a) ? "this" : "the critical");
    }
}

/* Returns true if `region` contains a particle of `part`. Also returns true if the run has cells whose particles are
 * not created (hollow cells of `frame`), because these cells may be in the region. */
static bool region_is_met(const struct lagrangian_mesh *frame, const struct particles *part,
                          const struct region *region)
{
    bool any = frame->hollow.absent != NULL;
    for (int64_t i = 0; i < part->n && !any; i++) {
        real X[DIM_MAX];
        particle_reference_position(part, i, X);
        any = region_contains(region, X, part->dim, 0);
    }
    return any;
}

/* Adds warnings to *to about SIF probes of scene s if a material yields: stress-intensity factors have no meaning
 * there. */
static void warn_of_probes(const struct scene *s, struct warnings *to)
{
    bool yields = false;
    for (int m = 0; m < s->materials; m++) yields |= material_yields(&s->material[m]);
    for (int k = 0; k < s->probes && yields; k++)
        if (s->probe[k].kind == PROBE_SIF)
            warnings_add_if_new(
                to,
                "probe %s: K_I, K_II and J are those of an elastic body and wrong while the material yields within the "
                "ring; use a smaller ring (outer), and distrust values with a large contour_spread",
                s->probe[k].name);
}

/* Adds a warning to *to for each body of scene s that is read from a particle list, if columns of the list are not
 * read, or if a default replaces a missing column of volumes or missing names of columns. */
static void warn_of_lists(const struct scene *s, struct warnings *to)
{
    for (int b = 0; b < s->bodies; b++)
        if (s->body[b].list.note[0]) warnings_add_if_new(to, "%.200s: %s", s->body[b].file, s->body[b].list.note);
}

/* Adds a warning to *to if plastic strain or temperature is requested for frames (outputs of all particles) although no
 * material yields or is heated. Adds none if all fields are requested. asked: requested fields (bits ASK_...); p, b:
 * particles and bonds, which have plastic arrays if a material yields. */
static void warn_of_fields(unsigned asked, const struct particles *p, const struct bonds *b, struct warnings *to)
{
    enum {
        ASK_PLASTIC_STRAIN = 1 << 4,
        ASK_TEMPERATURE = 1 << 21,
        ASK_OTHERS = ASK_LEVEL | ASK_STRAIN | ASK_PLASTIC_WORK
    };
    if ((asked & ASK_OTHERS) == ASK_OTHERS) return;
    if (asked & ASK_TEMPERATURE && !p->temperature)
        warnings_add_if_new(to, "output.fields: no material has a specific_heat, so frames will have no temperature; "
                                "give one, or remove the field temperature");
    if (asked & ASK_PLASTIC_STRAIN && !p->plastic_strain && !b->plastic_path)
        warnings_add_if_new(to, "output.fields: no material has a yield_stress, so frames will have no plastic_strain; "
                                "give one, or remove this field");
}

/* Adds warnings to *to about regions of scene s with frames (outputs of particles) of their own that contain no
 * particle of p. frame: mesh of the run; if it has hollow cells, whose particles are not created, no region is
 * reported. */
static void warn_of_regions(const struct scene *s, const struct lagrangian_mesh *frame, const struct particles *p,
                            struct warnings *to)
{
    for (int k = 0; k < s->n_series; k++)
        if (!region_is_met(frame, p, &s->series[k].region))
            warnings_add_if_new(to,
                                "output.regions: %s contains no particle, so its frames will be empty; check its "
                                "coordinates and their unit (m if none is written)",
                                s->series[k].name);
}

/* Adds a warning to *to for each boundary of scene s with prescribed motion that contains no particle. l: loads, one
 * for each boundary; p: particles. */
static void warn_of_boundaries(const struct scene *s, const struct loads *l, const struct particles *p,
                               struct warnings *to)
{
    for (int b = 0; b < l->n; b++)
        if (l->load[b].n == 0 && s->boundary[b].kind == BOUNDARY_VELOCITY)
            warnings_add_if_new(
                to, "boundary %s contains no particle%s (%s); check its region and the unit (m if none is written)",
                s->boundary[b].name, s->method == METHOD_PD ? "" : " and acts on grid nodes in its region only",
                particles_describe_bounding_box(p).text);
}

/* Adds a warning to *to if the time step of `clock` is above the critical time step, with which the run of scene s is
 * unstable if it is dynamic. */
static void warn_of_step(const struct scene *s, const struct run_clock *clock, struct warnings *to)
{
    if (!scene_is_dynamic(s) || !(clock->dt > clock->dt_critical)) return;
    warnings_add_if_new(to,
                        "the time step is too large: time.step is %.4g s, %.3g times the critical %.4g s, so the run "
                        "will be unstable; remove time.step, or set it to at most %.3g s",
                        clock->dt, clock->dt / clock->dt_critical, clock->dt_critical, 0.8 * clock->dt_critical);
}

#define HORIZON_LEAST 1.45 /* [spacings] below it a particle of a lattice has no diagonal neighbours, at sqrt(2) */

/* Adds a warning to *to if the horizon of scene s is below HORIZON_LEAST, so that a particle has bonds only to its
 * neighbours along the axes of the lattice; in 1D if it is one spacing, so that round-off decides whether a particle
 * has bonds. Adds none for method mpm. */
static void warn_of_horizon(const struct scene *s, struct warnings *to)
{
    if (s->method == METHOD_MPM || s->horizon >= (s->dim > 1 ? HORIZON_LEAST : 1.005)) return;
    if (s->dim == 1)
        warnings_add_if_new(to,
                            "particles.horizon: %.3g puts the neighbours in a bar exactly at the horizon, where "
                            "round-off decides; set 1.015 for one neighbour on each side, or 3.015",
                            s->horizon);
    else
        warnings_add_if_new(to,
                            "particles.horizon: %.3g gives each particle bonds along the axes of the lattice only "
                            "(%d), so the body has no shear stiffness and cracks follow the axes; set 3.015",
                            s->horizon, 2 * s->dim);
}

#define STIFFNESS_APART 0.05 /* relative error of a bulk modulus that is worth a warning; vmpd has 0.02 */

/* Adds a warning to *to if bonds of the neighbourhood f, by their calibration, make the first material of scene s
 * stiffer or softer than specified by more than the relative error STIFFNESS_APART of the bulk modulus. Adds none for
 * state-based models and the calibration on the lattice, which are exact. */
static void warn_of_stiffness(const struct scene *s, const struct family *f, struct warnings *to)
{
    real c11, c12;
    const struct material *m = &s->material[0];
    if (s->method == METHOD_MPM || s->model != MODEL_BOND || f->calibration == CALIBRATION_LATTICE) return;
    family_compute_cubic_elastic_constants(f, m, &c11, &c12);
    const int others = s->dim - 1;
    const real ratio = (c11 + others * c12) / (m->c11 + others * m->c12);
    if (fabs(ratio - 1) > STIFFNESS_APART)
        warnings_add_if_new(to,
                            "pd.calibration: %s gives bonds of this influence function and horizon %.2f times the bulk "
                            "modulus of the material; set pd.calibration: lattice, which is exact",
                            f->calibration == CALIBRATION_CONTINUUM ? "continuum" : "vmpd", ratio);
}

void run_warn_of_suspicious_input(struct run *run)
{
    const struct scene *s = run->scene;
    struct warnings *to = &run->warnings;
    if (s->renamed[0])
        warnings_add_if_new(to,
                            "the scene uses earlier names of keys (%s), which this version still accepts with the same "
                            "meaning; write the new names",
                            s->renamed);
    warn_of_step(s, &run->clock, to);
    warn_of_horizon(s, to);
    warn_of_stiffness(s, &run->source.family, to);
    warn_of_coupling(s, run->coupling_kind, to);
    warn_of_cells(s, run->part.n_free > 0, to);
    if (run->part.n_free > 0) warn_of_spin(s, run->grid, to);
    warn_of_idle_keys(s, run->frame, to);
    warn_of_materials(s, &run->tables, to);
    warn_of_lists(s, to);
    warn_of_probes(s, to);
    run_warn_of_mistaken_units(s, &run->part, &run->loads, &run->clock, run->tables.wave_speed, to);
    run_warn_of_suspicious_temperatures(s, &run->part, to);
    run_warn_of_strength_averaging_over_thin_bodies(s, &run->part, to);
    run_warn_of_isolated_particles(s, &run->cells, &run->bonds, &run->part, to);
    run_warn_of_supports_moving_too_fast(s, &run->loads, &run->part, to);
    run_warn_of_particles_faster_than_waves(&run->part, run->tables.wave_speed, to);
    run_warn_of_conflicting_supports(s, &run->loads, &run->part, to);
    if (run->grid->field)
        run_warn_of_supports_between_grid_nodes(s, &run->loads, &run->part, &run->grid->field[0].grid, to);
    run_warn_of_solids_without_effect_on_bodies(s, to);
    run_warn_of_overlapping_closed_surface_files(s, to);
    run_warn_of_bodies_too_thin_to_correct_faces(s, &run->part, &run->tables.surface, to);
    run_warn_of_bodies_that_never_meet(s, &run->part, to);
    run_warn_of_overlapping_bodies(s, &run->part, to);
    run_warn_of_gaps_at_mirrors_and_empty_regions(s, &run->part, run->source.family.horizon, to);
    run_warn_of_frames_after_end_of_run(s, to);
    warn_of_fields(s->fields, &run->part, &run->bonds, to);
    warn_of_regions(s, run->frame, &run->part, to);
    warn_of_boundaries(s, &run->loads, &run->part, to);
    run_warn_of_ineffective_precracks(s, &run->part, &run->cells, &run->bonds, &run->loads, run->source.family.cutoff,
                                      run->tables.wave_speed, to);
    for (const struct part *const *p = run->parts; *p; p++)
        if ((*p)->warn) (*p)->warn(run, to);
}
