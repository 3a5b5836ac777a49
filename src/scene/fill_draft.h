/* Collects particles from lattices (fill.c) and from lists (fill_list.c), and sets their initial states
 * (fill_initial.c). */
#ifndef CLEAVE_FILL_DRAFT
#define CLEAVE_FILL_DRAFT

#include "data/hollow.h"
#include "scene/scene.h"

/* List of the particles that are to be created, in the order of the bodies of the input file; their number is not known
 * in advance. Arrays have n entries and grow with the list. */
struct new_particles {
    const struct scene *scene;
    const struct cells_without_particles *hollow; /* cells whose particles are not created; NULL: none */
    int64_t n, room;                              /* number of particles; number for which the arrays have memory */
    int64_t skipped;                              /* number of particles that are not created */
    real low[DIM_MAX], high[DIM_MAX];             /* bounding box of the skipped particles [m] */
    real *X[DIM_MAX], *volume;                    /* position [m]; volume [m^3] */
    real *v[DIM_MAX], *mass;                      /* velocity [m/s] and mass [kg] in a list of particles; NAN: those of
                                                     the body and its material */
    uint8_t *material, *body;                     /* index of the material, of the body */
    int32_t *id;                                  /* index in the order in which the scene makes the particles */
};

/* Appends a particle at the position `position` (dim coordinates [m]) to `created`, the list of particles to be
 * created. volume: volume of the particle [m^3]; material_number, body_number: indices of its material and its body in
 * the input file. Returns REFUSED, with a message, if there would be more than PARTICLES_MAX particles. */
status new_particles_append_particle(struct new_particles *created, const real *position, real volume,
                                     int material_number, int body_number);

/* Always returns REFUSED, with the message that a body of the input file created->scene has no particles. body: index
 * of the body. from_particle_list: true if its particles were to come from a list; otherwise the message gives the
 * extents of the body's shape. */
status new_particles_report_empty_body(const struct new_particles *created, int body, bool from_particle_list);

/* Always returns REFUSED, with a message that names the body with the index `body_number` in the input file
 * created->scene and ends with the text `reason`. */
status new_particles_report_body_fault(const struct new_particles *created, int body_number, const char *reason);

/* Appends the particles of the body with the index `body_number` from its particle list file to `created`, the list of
 * particles to be created. Returns REFUSED, with a message, if the file cannot be read or is invalid. */
status new_particles_append_body_from_file(struct new_particles *created, int body_number);

/* Returns REFUSED, with a message, if an initial state of scene s (the input file) turns a body inside out; else OK. */
status initial_states_check_no_body_inverts(const struct scene *s);

/* Applies the initial states (velocities, strains, wave pulses) of scene s, the input file, to the particles p; in a
 * static problem all velocities are 0. spacing: distance of particles [m]. */
void initial_states_apply_to_particles(struct particles *p, const struct scene *s, real spacing);

#endif
