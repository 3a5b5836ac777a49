/* Declarations shared by the files of src/engine. */
#ifndef CLEAVE_ENGINE_INTERNAL
#define CLEAVE_ENGINE_INTERNAL

#include "data/hollow.h"
#include "engine/engine.h"

/* Allocates the parts of a run (contact, cracks, mesh, probes and others), all zero, and stores them in *e. */
void run_parts_make(struct run *e);

/* Releases all parts of a run and what they own. Parts that were not created are skipped. */
void run_parts_free(struct run *e);

/* A run that is replaced by a run of the same scene with other particles. */
struct predecessor {
    struct run *run;
    int32_t *now; /* [particles and images of `run`] their indices in the new run; -1: not in the new run */
};

/* Creates the state of a run as engine_make does, without the particles of the cells listed in `hollow` (cells inside a
 * body that coarse cells replace). predecessor: if not NULL, particles, bonds and time are transferred from this run;
 * the caller sets all other state that its time steps have changed, and the refinement levels of cells. Returns as
 * engine_make does. */
status engine_make_from_predecessor(struct run *e, const struct scene *s, struct output *out,
                                    struct cells_without_particles hollow, struct predecessor *predecessor);

/* Replaces a run by one whose particles are those that the given refinement levels of mesh cells require, with the
 * state of the present run. level: refinement level of each mesh cell. Returns FAILED if this fails or a frame in
 * progress cannot be written. */
status engine_replace_particles(struct run *e, const uint8_t *level);

/* Transfers the particles of predecessor->run to a run that is being created, and stores the new indices of these
 * particles in predecessor->now. Call it when the mirror images of the new particles exist. */
void engine_transfer_particles(struct run *e, struct predecessor *predecessor);

/* Transfers the broken bonds of predecessor->run to a run that is being created, and frees the bonds and particles of
 * predecessor->run. Call it after engine_transfer_particles. */
void engine_transfer_bonds(struct run *e, const struct predecessor *predecessor);

/* Saves the state of loads and of all parts of a run to the archive if a->saving is set, else restores it from the
 * archive. Each part saves only state that a->scope includes. Returns FAILED if an entry is missing or has another
 * size. */
status parts_save_or_load(struct run *e, struct archive *a);

/* Adds warnings to *to about bodies with particles that have no neighbours within the horizon. cells: search over
 * reference positions. */
void engine_warn_of_isolated_particles(const struct scene *s, const struct cells *cells, const struct bonds *b,
                                       const struct particles *p, struct warnings *to);

/* Returns true if the bounding box of a crack overlaps the box low..high [dim, m], extended by `reach` [m] on every
 * side. */
bool crack_overlaps_box(const struct crack *c, const real *low, const real *high, int dim, real reach);

/* Adds warnings to *to about pre-cracks that are outside of all bodies or cut no bond, and about probes of cracks where
 * no bond can break. reach: length of the longest bonds [m]. */
void engine_warn_of_useless_cracks(const struct scene *s, const struct particles *p, const struct bonds *b, real reach,
                                   struct warnings *to);

/* Adds warnings to *to about values that look like mistakes of units, unless the key `accept` of the scene excepts
 * them. clock: time step and number of steps; wave_speed: speed of the fastest wave in any material [m/s]. */
void engine_warn_of_mistaken_units(const struct scene *s, const struct particles *p, const struct loads *loads,
                                   const struct run_clock *clock, real wave_speed, struct warnings *to);

/* Adds warnings to *to about supports whose prescribed speed is so high that the bonds next to the particles that they
 * drive break. */
void engine_warn_of_fast_supports(const struct scene *s, const struct loads *loads, const struct particles *p,
                                  struct warnings *to);

/* Adds a warning to *to if a particle starts faster than wave_speed, the speed of the fastest wave in any material
 * [m/s]. */
void engine_warn_of_fast_start(const struct particles *p, real wave_speed, struct warnings *to);

/* Adds warnings to *to about supports that hold all particles, and about pairs of supports that prescribe different
 * motions of the same particles. */
void engine_warn_of_conflicting_supports(const struct scene *s, const struct loads *loads, const struct particles *p,
                                         struct warnings *to);

/* Adds warnings to *to about bodies of a few rows of particles, whose stiffness pd.surface: moments cannot correct, and
 * about weights of bonds near faces whose solver has given up. w: these weights. */
void engine_warn_of_uncorrected_faces(const struct scene *s, const struct particles *p, const struct surface_weights *w,
                                      struct warnings *to);

/* Computes the box of the particles of body b and of all that are joined to it [m]. Returns false if there are none. */
bool engine_joined_bodies_box(const struct scene *s, const struct particles *p, int b, real *low, real *high);

/* Returns the number of particles along an axis between the positions low and high [m], including their images beyond
 * planes of symmetry. */
real engine_count_particles_across(const struct scene *s, real low, real high, int axis);

/* Adds warnings to *to about solids of the shape of a body that add nothing to it or remove nothing from it. */
void engine_warn_of_useless_solids(const struct scene *s, struct warnings *to);

/* Adds warnings to *to about bodies that move at the start and meet no other body within the duration. */
void engine_warn_of_missed_encounters(const struct scene *s, const struct particles *p, struct warnings *to);

/* Adds a warning to *to about each pair of bodies that overlap at the start. */
void engine_warn_of_overlaps(const struct scene *s, const struct particles *p, struct warnings *to);

/* Adds warnings to *to about planes of symmetry that no body touches, and about initial states whose region holds no
 * particle. */
void engine_warn_of_idle_places(const struct scene *s, const struct particles *p, struct warnings *to);

/* Adds warnings to *to about times of frames beyond the end of the run. */
void engine_warn_of_late_frames(const struct scene *s, struct warnings *to);

/* Returns REFUSED, with a message that contains the estimate, if the memory of the machine is smaller than that of the
 * run. */
status engine_check_memory(const struct scene *s, const struct particles *p, const struct bond_source *source);

#endif
