/* Declares the animation of a run in its HTML report: the selected output frames, the sets of particles that frames
 * have in common, the fields and their ranges. animation_select_content_within_byte_budget limits its size. */
#ifndef CLEAVE_REPORT_FILM
#define CLEAVE_REPORT_FILM

#include "page.h"
#include "plot/plot.h"

/* Limits of the animation in an HTML report. FILM_FIELDS_MOST: largest number of fields. Particles in a cubic cell of
 * level L, with 2^L particles along an edge, are shown as one. FILM_LEVELS: largest level of cells without damaged
 * particles; FILM_LEVELS_DAMAGED: with damaged ones; FILM_LEVELS_ALL: with particles in any state. */
enum { FILM_FIELDS_MOST = 24, FILM_LEVELS = 3, FILM_LEVELS_DAMAGED = 2, FILM_LEVELS_ALL = 15 };

/* Worst state of one particle in all output frames of an HTML report. FILM_INTACT: neither damaged nor yielding;
 * FILM_DAMAGED: damage of at most CRACK_DAMAGE, or yielding; FILM_CRACKED: more damage, shown as part of a crack. */
enum film_state { FILM_INTACT, FILM_DAMAGED, FILM_CRACKED };

/* One field of the particles (a quantity such as damage) as the HTML report stores it, with 8 bits per particle in each
 * frame, 16 bits for fragments. */
struct animation_field {
    const struct plot_field *of;
    bool extra;         /* left out first where the budget is short */
    bool fixed;         /* the same in all frames: stored with the particle set */
    bool used;          /* the field differs between particles or frames */
    double least, most; /* smallest and largest value */
    double low, high;   /* values at the ends of the stored range */
    float *sample;      /* [samples] values, for the quantiles */
    int64_t samples;
};

/* Set of the particles that consecutive output frames of a run have in common, divided into groups. A group is one
 * particle, or the particles of a square or cubic cell, which the HTML report shows as one particle. Arrays are
 * owned. */
struct animation_particle_set {
    int64_t n;                /* number of particles */
    real *X[DIM_MAX];         /* [n] reference positions [m] */
    float *size;              /* [n] spacing of each particle [m]; NULL: that of the film */
    uint8_t *material, *body; /* [n] index of the material, of the body */
    uint8_t *state;           /* [n] enum film_state: the worst of all frames */
    uint32_t *history;        /* [n] hash of kind and fragment in all frames */
    uint8_t *level;           /* [n] the cell of a merged particle has 2^level particles along an edge; 0: not merged */
    double corner[DIM_MAX];   /* lower corner of the box of all particles, where cells begin [m] */
    int64_t groups;           /* number of groups */
    int32_t *first, *member;  /* particles of group g: member[first[g]] .. member[first[g + 1] - 1] */
};

/* One output frame (state of the run at one time) that was read for an HTML report. used: the report shows this
 * frame. */
struct animation_frame {
    struct listed_frame listed; /* file and time of the frame */
    int64_t step;               /* number of the time step or load step */
    int set;                    /* index of its particle set */
    bool used;
};

/* Animation of one run in its HTML report: selected output frames, the sets of particles that frames have in common,
 * and the fields. Filled by animation_read_frames_of_run, released by animation_free. */
struct run_animation {
    const char *folder;        /* folder of the run; borrowed */
    const struct scene *scene; /* scene of the run, for its rigid bodies; borrowed; NULL: not known */
    int dim;
    double spacing;                     /* smallest distance of particles [m] */
    int listed;                         /* number of frames of the run */
    struct animation_frame *frame;      /* [frames] */
    int frames, used;                   /* number of frames that were read; number of these that are shown */
    struct animation_particle_set *set; /* [sets] */
    int sets;
    struct animation_field field[FILM_FIELDS_MOST]; /* [fields] fields that the page can show */
    int fields;
    double reach[DIM_MAX]; /* largest displacement along each axis [m] */
    /* largest level of cells of intact particles; of cells with damaged ones; level of the cells into which all
     * particles are merged, also those of cracks and of cells that the body fills partly */
    int levels, levels_damaged, levels_all;
    bool lacks_extra; /* extra fields are left out, so that the page does not become too large */
};

/* Reads at most about sixty output frames (states) of the run in `folder` into f. Finds the sets of particles that
 * consecutive frames have in common, the largest displacements and the ranges of the fields. scene: contents of the
 * input file of the run, kept by reference; NULL if it is not known. Returns FAILED if a frame cannot be read. Release
 * `animation` with animation_free. */
status animation_read_frames_of_run(struct run_animation *animation, const char *folder, const struct scene *scene);

/* Selects in the animation the output frames, the fields and the groups of particles (each shown as one particle) that
 * the page (the HTML report of a run) shows, such that they take at most `byte_budget` bytes on the page. */
void animation_select_content_within_byte_budget(struct run_animation *animation, int64_t byte_budget);

/* Writes the selected output frames of a run and their fields, the animation, to `page` as the entry `film` of the JSON
 * text of the page (the HTML report of the run). Returns FAILED if a frame cannot be read again. */
status animation_write_to_page(struct html_page *page, const struct run_animation *animation);

/* Releases the lists and values of *animation, which animation_read_frames_of_run has allocated. */
void animation_free(struct run_animation *animation);

/* Divides the particles of the set `particle_set` (particles that several output frames have in common) into groups,
 * each of which the page (the HTML report) shows as one particle. Particles of one material and body that fill a cubic
 * cell become one group. The cell has up to 2^animation->levels particles along an edge if none of them is damaged or
 * has yielded in any frame and all have the same kind and fragment in every frame, and up to
 * 2^animation->levels_damaged if none is part of a crack. If animation->levels_all is above 0, all particles in a cell
 * of this level become one group, whether they fill the cell or not. Each other particle is a group. */
void animation_particle_set_merge_into_groups(struct animation_particle_set *particle_set,
                                              const struct run_animation *animation);

/* Returns the edge [m] with which the page draws group number `group` of the set `particle_set`: the spacing of a
 * single particle or, for a group of merged particles, the edge of their cubic cell. */
double animation_group_drawn_edge_length(const struct animation_particle_set *particle_set,
                                         const struct run_animation *animation, int64_t group);

/* Returns the coordinate along `axis` [m] of the centre of group number `group` of the set `particle_set` in the
 * reference state: the mean of its particles, or the centre of a cell that they fill partly. */
double animation_group_centre_coordinate(const struct animation_particle_set *particle_set,
                                         const struct run_animation *animation, int64_t group, int axis);

/* Fills the table animation->field with the fields (quantities stored for each particle) that a run in animation->dim
 * dimensions may have, and sets animation->fields, their number. */
void animation_list_possible_fields(struct run_animation *animation);

/* Updates the ranges and the sampled values of all fields of the animation, the output frames of a run that a report
 * shows, from one of these frames, `frame`, which was read from the file `path`. */
void animation_update_field_ranges_from_frame(struct run_animation *animation, const struct output_frame *frame,
                                              const char *path);

/* Chooses for each field of the animation, the output frames of a run that a report shows, the range of values that its
 * stored numbers of 8 or 16 bits represent. Sets `used` to false for fields with the same value in all frames at all
 * particles. */
void animation_choose_stored_field_ranges(struct run_animation *animation);

/* Returns the number of bytes that the page (HTML report) stores in each output frame of the run, the animation, for
 * one group (particles that are shown as one): the sum over all fields that are shown and change with time. */
int animation_bytes_per_group_and_frame(const struct run_animation *animation);

/* Returns true if the field `field` (a quantity of the particles) of the run `animation` is written to the page (HTML
 * report): its values differ between particles or frames, and it is not left out to save space. */
bool animation_field_is_shown(const struct run_animation *animation, const struct animation_field *field);

/* Writes the values of one field in the output frame `frame` to the page p (HTML report) as an array with one value for
 * each group of `particle_set` (particles that are shown as one): the mean over the particles of the group. path:
 * file from which the frame was read. */
void animation_write_field_values_of_frame(struct html_page *p, const struct animation_field *field,
                                           const struct animation_particle_set *particle_set,
                                           const struct output_frame *frame, const char *path);

/* Writes the surfaces of the rigid bodies of the run `animation` to the page p (HTML report) as the entry `rigid`: line
 * segments in 2D, quadrilaterals in 3D. */
void animation_write_rigid_body_surfaces(struct html_page *p, const struct run_animation *animation);

/* Writes the positions and rotations of the rigid bodies in frame number `frame_number` of the run to the page p (HTML
 * report) as the entry `rigid` of that frame: for each body animation->dim coordinates [m], the displacement of the
 * nearest particle of `frame`, with which the page moves the rigid body if displacements are magnified, and the
 * rotation matrix [dim][dim] by rows. Writes nothing if the run has no file of rigid bodies for this frame. */
void animation_write_rigid_body_motion_of_frame(struct html_page *p, const struct run_animation *animation,
                                                const struct output_frame *frame, int frame_number);

#endif
