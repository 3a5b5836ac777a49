/* Declarations shared by the files of src/engine: set-up of a run, its replacement by a run with other particles, and
 * warnings. */
#ifndef CLEAVE_ENGINE_INTERNAL
#define CLEAVE_ENGINE_INTERNAL

#include "data/hollow.h"
#include "engine/engine.h"
#include "fracture/tips.h"

/* Allocates the parts of a run (contact, cracks, mesh, probes and others), sets all of them to zero, and stores
 * pointers to them in *e. */
void run_components_allocate(struct run *run);

/* Releases all parts of the run (contact, cracks, mesh, probes and others) and what they own. Parts that were not
 * created are skipped. */
void run_components_free(struct run *run);

/* A run that is to be replaced by a run of the same scene with other particles, and the map between the particles of
 * both. */
struct predecessor {
    struct run *run;
    int32_t *now; /* [particles and mirror images of `run`] their indices in the new run; -1: not in the new run */
};

/* Creates the run of scene s (the input file) without the particles of the cells listed in `omitted_cells`: cells
 * inside a body that coarse (larger) cells replace. output: output of the run. predecessor: NULL, or a run from which
 * particles, bonds and time are transferred. In the latter case the caller sets all other state that time steps have
 * changed, and the coarsening levels of the mesh cells. Returns REFUSED (invalid input) or FAILED (for example too many
 * nodes), with a message, if the scene cannot be set up. */
status run_create_and_transfer_from_predecessor(struct run *run, const struct scene *s, struct output *output,
                                                struct cells_without_particles omitted_cells,
                                                struct predecessor *predecessor);

/* Replaces run by a run with the same state, in which the particles are those that the levels of the mesh cells
 * require. cell_level: level of each mesh cell (0: finest; the edge doubles with each level, and coarse cells inside a
 * body have no particles). Returns FAILED if the new run cannot be made, or if the output of results that is in
 * progress fails. */
status run_replace_particles_for_coarsening_levels(struct run *run, const uint8_t *cell_level);

/* Transfers the particles of predecessor->run, a run of the same scene with other particles, to the run, which is
 * being created, and stores the new indices of these particles in predecessor->now. The mirror images (copies beyond
 * planes of symmetry) of the new particles must exist. */
void run_transfer_particles_from_predecessor(struct run *run, struct predecessor *predecessor);

/* Transfers the broken bonds of predecessor->run to the run, which is being created. Releases the bonds and particles
 * of predecessor->run. run_transfer_particles_from_predecessor must have been called before. */
void run_transfer_broken_bonds_from_predecessor(struct run *run, const struct predecessor *predecessor);

/* Saves the state of loads and of all parts of the run (contact, cracks, mesh, probes and others) to the archive a if
 * a->saving is true, else restores it from a. Each part saves only the state that a->scope selects: all, or what a
 * trial equilibrium changes, for example. Returns FAILED if an entry is missing or has another size. */
status run_components_save_or_load_state(struct run *run, struct archive *a);

/* Adds warnings to *warnings about bodies of scene s (the input file) in which particles of p have no neighbours within
 * the horizon. b: bonds; cells: neighbour search over reference positions. */
void run_warn_of_isolated_particles(const struct scene *s, const struct cells *cells, const struct bonds *b,
                                    const struct particles *p, struct warnings *warnings);

/* Returns true if the bounding box of crack c, extended by `margin` [m] on every side, overlaps the box with the
 * corners box_low[dim] and box_high[dim] [m]. */
bool crack_overlaps_box(const struct crack *c, const real *box_low, const real *box_high, int dim, real margin);

/* Adds warnings to *warnings about pre-cracks of scene s (the input file) that are outside of all bodies, cut no bond
 * or cannot grow, and about probes of cracks where no bond can break. p, b, loads: particles, bonds and loads; cells:
 * neighbour search over reference positions; longest_bond: length of the longest bonds [m]; wave_speed: speed of the
 * fastest wave in any material [m/s]. */
void run_warn_of_ineffective_precracks(const struct scene *s, const struct particles *p, const struct cells *cells,
                                       const struct bonds *b, const struct loads *loads, real longest_bond,
                                       real wave_speed, struct warnings *warnings);

/* Adds a warning to *warnings if waves from the loads on particles of p do not travel to the nearest crack tip within
 * the duration of scene s (the input file). tips: crack tips at the start; wave_speed: speed of the fastest wave in any
 * material [m/s]. */
void run_warn_if_waves_do_not_reach_crack_tips(const struct scene *s, const struct particles *p,
                                               const struct loads *loads, const struct crack_tips *tips,
                                               real wave_speed, struct warnings *warnings);

/* Adds a warning to *warnings if all loads of scene s (the input file) are tractions that press the pre-cracks shut. p:
 * particles. */
void run_warn_of_precracks_pressed_shut_by_loads(const struct scene *s, const struct particles *p,
                                                 struct warnings *warnings);

/* Returns a new array [p->n] with the components of motion that supports in `loads` prescribe for each particle, as
 * bits (bit d for component d). The caller releases the array with memory_free. */
uint8_t *loads_find_prescribed_motion_components(const struct loads *loads, const struct particles *p);

/* Adds warnings to *warnings about values that look like mistakes of units, unless the key `accept` of the input file
 * silences them. s: scene (the input file); p, loads: particles and loads; clock: time step and number of steps;
 * wave_speed: speed of the fastest wave in any material [m/s]. */
void run_warn_of_mistaken_units(const struct scene *s, const struct particles *p, const struct loads *loads,
                                const struct run_clock *clock, real wave_speed, struct warnings *warnings);

/* Adds warnings to *warnings about supports of scene s (the input file) whose prescribed speed is so high that bonds
 * break between the particles that the support drives and their neighbours. p, loads: particles and loads. */
void run_warn_of_supports_moving_too_fast(const struct scene *s, const struct loads *loads, const struct particles *p,
                                          struct warnings *warnings);

/* Adds a warning to *warnings if a particle of p starts faster than `wave_speed` [m/s], the speed of the fastest wave
 * in any material. */
void run_warn_of_particles_faster_than_waves(const struct particles *p, real wave_speed, struct warnings *warnings);

/* Adds warnings to *warnings about supports in three cases: a support of scene s (the input file) prescribes the motion
 * of all particles of p; two supports prescribe different motions of the same particles; a load acts on particles whose
 * motion a support prescribes. p, loads: particles and loads. */
void run_warn_of_conflicting_supports(const struct scene *s, const struct loads *loads, const struct particles *p,
                                      struct warnings *warnings);

/* Adds a warning to *warnings for each support of scene s (the input file) at an end face of a body that lies within a
 * grid cell instead of on a row of nodes, where cells have an edge of two particle spacings. The body is then computed
 * too long or too short; the warning states by how much. p, loads: particles and loads; grid: any grid of the run,
 * whose members `anchor` and `h` give the positions of all nodes. */
void run_warn_of_supports_between_grid_nodes(const struct scene *s, const struct loads *loads,
                                             const struct particles *p, const struct grid *grid,
                                             struct warnings *warnings);

/* Adds warnings to *warnings about bodies of scene s (the input file) only a few particles (of p) thick, whose
 * stiffness the correction of bonds near faces (key `pd.surface: moments`) cannot correct. weights: factors on the
 * stiffness of bonds near faces; the function also warns if the solver that computes these weights has not converged.
 */
void run_warn_of_bodies_too_thin_to_correct_faces(const struct scene *s, const struct particles *p,
                                                  const struct surface_correction *weights, struct warnings *warnings);

/* Computes the bounding box of those particles of p that are in body number `body_number` of scene s (the input file)
 * or in a body that an interface joins to this body, and stores the corners of the box in box_low[dim] and
 * box_high[dim] [m]. Returns true, or false if there are no such particles. */
bool joined_bodies_compute_bounding_box(const struct scene *s, const struct particles *p, int body_number,
                                        real *box_low, real *box_high);

/* Returns the number of particles of scene s (the input file) in a row along axis `axis` between the coordinates `low`
 * and `high` [m], including mirror images beyond planes of symmetry. */
real scene_particle_count_along_axis_with_mirrors(const struct scene *s, real low, real high, int axis);

/* Adds warnings to *warnings about room temperatures of the materials of scene s (the input file) that seem to be in
 * degrees Celsius and, if particles p have temperatures, about materials that start at different ones, or flow without
 * being heated. */
void run_warn_of_suspicious_temperatures(const struct scene *s, const struct particles *p, struct warnings *warnings);

/* Warns of materials of scene s (the input file) whose strength surface (failure criterion in stress) averages strains
 * over more than half of the shortest side of a body: the mean of bending strains is then near 0, and the computed
 * strength too high. p: particles of the run. Adds the warnings to *warnings. */
void run_warn_of_strength_averaging_over_thin_bodies(const struct scene *s, const struct particles *p,
                                                     struct warnings *warnings);

/* Adds warnings to *warnings about solids in the shapes of the bodies of scene s (the input file) that add nothing to
 * the body or remove nothing from it. */
void run_warn_of_solids_without_effect_on_bodies(const struct scene *s, struct warnings *warnings);

/* Adds warnings to *warnings about surfaces of scene s (the input file), read from files, whose closed shells overlap
 * or are inside one another, so that a part of the body is enclosed twice. */
void run_warn_of_overlapping_closed_surface_files(const struct scene *s, struct warnings *warnings);

/* Adds a warning to *warnings about each body of scene s (the input file) that moves in one direction from the start
 * and comes into contact with no other body, rigid bodies included, within the duration. This is judged by the bounding
 * boxes of the bodies, moved with the extreme initial velocities of their particles in p: boxes within one spacing
 * count as contact. Adds none if forces, gravity, prescribed motion or planes of symmetry may change the motion, or if
 * a box is not known. */
void run_warn_of_bodies_that_never_meet(const struct scene *s, const struct particles *p, struct warnings *warnings);

/* Adds a warning to *warnings about each pair of bodies of scene s (the input file) that overlap at the start. p:
 * particles. */
void run_warn_of_overlapping_bodies(const struct scene *s, const struct particles *p, struct warnings *warnings);

/* Adds warnings to *warnings about planes of symmetry of scene s (the input file) with a gap between plane and bodies,
 * and about parts of bodies with materials of their own, initial states or a pd.region that contain no particle of p.
 * horizon: length of the longest bonds [m]. */
void run_warn_of_gaps_at_mirrors_and_empty_regions(const struct scene *s, const struct particles *p, real horizon,
                                                   struct warnings *warnings);

/* Adds warnings to *warnings about times of output frames in scene s (the input file) that are beyond the end of the
 * run. */
void run_warn_of_frames_after_end_of_run(const struct scene *s, struct warnings *warnings);

/* Checks whether the run of scene s (the input file) fits the memory that the process may use. p: particles;
 * bond_source: inputs of the bonds (horizon, materials, cracks, mirrors). Returns OK if the run fits, else REFUSED,
 * with a message that contains the estimated size. */
status run_check_memory_suffices(const struct scene *s, const struct particles *p,
                                 const struct bond_source *bond_source);

#endif
