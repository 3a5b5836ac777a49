/* Room `plot` (folder of include/ and src/): pictures and comparisons of finished or running runs, made from their
 * files alone, and pictures of input files before they run. Commands call it.
 *
 * This header declares what the files of `cleave plot` share with each other and with `cleave compare`. */
#ifndef CLEAVE_PLOT
#define CLEAVE_PLOT

#include "data/region.h"
#include "output/history.h"
#include "output/output.h"
#include "output/output_files.h"
#include "plot/colours.h"
#include "plot/gnuplot.h"
#include "rigid/rigid_surface.h"
#include "scene/scene.h"

/* ---- requests ---------------------------------------------------------------------------------------------------- */

/* Number of panels (one frame each) of a picture: PANELS by default, PANELS_MAX at most. */
enum { PANELS = 6, PANELS_MAX = 24 };

/* Directions of a view of a solid: right-handed unit vectors to the right, upwards and towards the viewer. */
struct camera {
    double right[3], up[3], towards[3];
};

/* Directions of the view of a solid from outside that is used by default, an isometric view. */
extern const struct camera camera_isometric;

/* Returns the directions (right, up, towards the viewer) of a view along the coordinate axis `axis`, 0 .. 2 for x, y,
 * z. side: +1 if the viewer is on the side of larger coordinates, -1 if on the other side. */
struct camera camera_along_axis(int axis, int side);

struct plot_field;

/* Selection of the particles of a frame (state at one time) that a picture shows: in 3D a slice or a view from outside,
 * in 2D all particles. */
struct projection {
    bool outside;                   /* outside view; else a slice */
    struct camera camera;           /* direction of the outside view */
    int normal;                     /* normal axis of the slice; -1: the thinnest direction of the body */
    bool placed;                    /* `layer` is set */
    double layer;                   /* coordinate of the slice along its normal [m]; default: the slice with the
                                     * largest sum of damage */
    const struct plot_field *field; /* field to be drawn; NULL: only damage, kind and fragment */
    const float *value;             /* [n] values of the field in the current frame */
    bool in_steps;                  /* the frames are those of load steps */
    double magnify;                 /* factor on displacements in the picture; 0: 1 */
    const struct scene *scene;      /* scene as run, for its pre-cracks and rigid bodies; NULL: unknown; borrowed */
};

/* Returns true if the run of `projection` computes a single static equilibrium; the times of its frames are then times
 * of the loads, not of a motion. Returns false if the scene of the run is unknown. */
bool projection_shows_single_equilibrium_run(const struct projection *projection);

/* Writes to `text` the words by which pictures describe the state in a frame, and returns true: `equilibrium` or, at t
 * = 0, `without loads` if the run computes a single static equilibrium (`equilibrium` is true), else `load step 3` if
 * it makes load steps (`has_load_steps` is true). Returns false and writes "" for a run in time. t: time of the loads
 * [s]; step: number of the load step. */
bool frame_compose_label_if_static(char text[NAME_MAX_LENGTH], bool has_load_steps, bool equilibrium, double t,
                                   int64_t step);

/* Options of `cleave plot`. */
struct plot_request {
    const char *folder;      /* folder of the run */
    const char *pictures;    /* folder of the standard pictures; set by run_draw_standard_pictures */
    int panels;              /* number of frames to show, evenly spread; 0: a default, or all frames of a film */
    bool every;              /* show all frames; standard pictures: one file per frame */
    int times;               /* number of entries of `time`; 0: no times were requested */
    double time[PANELS_MAX]; /* [times] show the frames nearest to these times instead [s]; INFINITY: the last frame */
    bool bare[PANELS_MAX];   /* [times] the time was given without unit: in load steps it is the number of a step */
    const char *field;       /* name of the field; NULL: draw the standard pictures */
    struct projection projection; /* slice or view of a 3D body, and magnification of displacements */
    enum picture_format format;   /* file format of the pictures */
    const char *out;              /* output file, or folder of standard pictures; NULL: DIR/pictures */
    bool overwrite;               /* replace `out` even if Cleave did not draw it */
    const char *title;            /* title in place of the usual one; NULL: the usual one */
    const char *range[2];    /* lowest and highest value of the colour scale, as text with unit; NULL: by the values */
    bool cropped;            /* `crop` is set */
    double crop[2][2];       /* lower and upper end of the picture along its two axes [m] */
    enum colour_table table; /* colours of fields */
    int fps;                 /* frames per second of a film */
    bool quiet;              /* pictures of scenes: do not print what was drawn */
};

/* Draws all standard pictures of the run in r->folder and prints their names. Returns FAILED if a picture cannot be
 * drawn; REFUSED if one would replace a file that Cleave did not draw, or if no frame is near a requested time. */
status run_draw_standard_pictures(const struct plot_request *r);

/* Draws a picture or film of the field r->field of a run, and prints its file name and the range of the colours.
 * Returns REFUSED if the run has no such field or frames, or if a file that Cleave did not draw would be replaced;
 * FAILED if drawing fails. */
status field_draw_picture_or_video(const struct plot_request *r);

/* ---- runs -------------------------------------------------------------------------------------------------------- */

/* Returns true if `folder`, the folder of a run, holds a file called `name`. */
bool run_folder_has_file(const char *folder, const char *name);

/* Returns true if `folder` is that of a sweep or a convergence study, which is recognised by its table. */
bool folder_contains_study_table(const char *folder);

/* Reads the frame (stored state of the particles at one time) with the number `frame_number` in the folder of a run
 * into *f. Returns FAILED, with no memory to release, if the file cannot be read or is damaged. Release f with
 * frame_free. */
status run_read_frame(struct output_frame *f, const char *folder, int frame_number);

/* All frames (states at one time) of a run, and those selected for a picture. */
struct run_frames {
    int listed;
    struct listed_frame *list; /* [listed] */
    int shown;
    struct listed_frame *show; /* [shown] frames of the panels */
};

/* Lists all frames (stored states at one time) of the run in r->folder, and selects those that the request r demands by
 * number or time. Stores both lists in *f. Returns REFUSED if a requested time is outside the range of the frames,
 * FAILED if there is no readable list of frames. Release f with run_frames_free. */
status run_frames_list_and_select(struct run_frames *f, const struct plot_request *r);

/* Frees the lists of frames in *f, which run_frames_list_and_select has allocated. */
void run_frames_free(struct run_frames *f);

/* Reads all selected frames (stored states at one time) of a run. folder: folder of the run. Stores an allocated array
 * of frames->shown frames in *f, which is released with frames_free. Returns FAILED, with no memory to release, if a
 * frame cannot be read. */
status frames_read_selected(struct output_frame **f, const char *folder, const struct run_frames *frames);

/* Frees the frames frames[frame_count] and the array itself, which frames_read_selected has allocated. */
void frames_free(struct output_frame *frames, int frame_count);

/* Creates the folder for pictures, `path`, unless it exists. Returns REFUSED if a symbolic link has this name. Also
 * returns REFUSED if the folder contains a file with the name of a picture that Cleave did not draw, unless `overwrite`
 * is true. Returns FAILED if the folder cannot be created. */
status pictures_folder_create(const char *path, bool overwrite);

/* Determines the path of a picture from `option_argument`, the argument of the option -o, and stores it in *path.
 * `option_argument` is a file, or a folder (which exists or ends in /) in which the file `name` is created. Missing
 * folders are created. Returns REFUSED if the name is empty or too long, or if the file exists, Cleave did not draw it,
 * and `overwrite` is false. */
status picture_choose_path_by_output_option(struct path *path, const char *option_argument, const char *name,
                                            bool overwrite);

/* Prints that the picture `path` is not drawn, with the reason `reason`, and removes an older picture of that name if
 * Cleave drew it. Returns FAILED if standard output cannot be written. */
status picture_report_not_drawn_and_remove_old(const char *path, const char *reason);

/* Capacity of the title of a picture, with its terminator [byte]. */
enum { TITLE_LENGTH = 256 };

struct plotted_particles;
struct view;

/* Composes the title of a picture in title[TITLE_LENGTH] (a longer one is cut): `NAME, METHOD: QUANTITY`, with name and
 * method of the run in r->folder, and QUANTITY = quantity, what the picture shows; unknown parts are left out. If
 * r->title is given, it is the title. plotted: particles of the picture, or NULL; if given, the position of a slice and
 * a factor on displacements are appended to the title. view: rectangle of the picture, which determines the unit of the
 * position; NULL if `plotted` is. */
void picture_compose_title(char *title, const struct plot_request *r, const char *quantity,
                           const struct plotted_particles *plotted, const struct view *view);

/* Unit for display, with its name. factor: SI value divided by displayed value. */
struct unit {
    double factor;
    char name[32];
};

/* SI prefixes with their factors, the largest first: those of all units in pictures and on report pages. */
enum { UNIT_PREFIXES = 17 };
extern const struct unit unit_prefix[UNIT_PREFIXES];

/* Returns the unit with the SI prefix in which the value `largest_value` (in SI units) has one to three digits before
 * the decimal point. unit_name: unit without prefix; unit_with_si_prefix_for_largest_value(2e-5, "s") is microseconds.
 * A value below the least prefix, which is round-off, has the unit without prefix. */
struct unit unit_with_si_prefix_for_largest_value(double largest_value, const char *unit_name);

/* Returns a unit of length suitable for values up to `largest_length` [m]: millimetres between 0.5 mm and 1 m,
 * kilometres from 1 km on, else metres with an SI prefix. */
struct unit unit_for_length(double largest_length);

/* Returns a unit of area suitable for values up to `largest_area` [m^2]: square millimetres between 0.01 mm^2 and
 * 100,000 mm^2, else the square of nanometres, micrometres, metres or kilometres. */
struct unit unit_for_area(double largest_area);

/* Returns a unit for values up to `largest_value` (in SI units). If `unit_name` is a unit that takes prefixes (s, m,
 * m^2, m/s, N, N/m, J, Pa, W, J/m², J/m³, Pa√m), it has the prefix with which `largest_value` has one to three
 * digits before the decimal point; else it is the unit itself. unit_name: unit without prefix, as in pictures or as in
 * files: J/m^2 becomes J/m², Pa m^(1/2) becomes Pa√m, degree becomes °. */
struct unit unit_with_si_prefix_if_unit_allows_it(const char *unit_name, double largest_value);

/* ---- fields ------------------------------------------------------------------------------------------------------ */

/* Range of the colours of a field: from zero; symmetric about zero; from the least value; or one colour for each of a
 * few named values. */
enum field_scale { FROM_ZERO, BOTH_SIGNS, FROM_LEAST, CATEGORY };

/* A scalar field that can be drawn: one component of a field stored in frames or derived from such a field, or the
 * magnitude of a vector field. */
struct plot_field {
    const char *name, *stored; /* name of this field; name of the field in the file from which it is computed */
    int component;             /* index of the component; -1: magnitude */
    const char *unit;          /* SI unit of the values */
    enum field_scale scale;    /* kind of colour scale */
};

/* Finds the field called `name` in the table of fields that can be drawn, and stores a pointer to its entry in *field.
 * dim: dimension of the run. Returns REFUSED, with the most similar name in the message, if there is no field of this
 * name, or if it has no meaning in this dimension. */
status plot_field_find_by_name(const struct plot_field **field, const char *name, int dim);

/* Writes the name of a field as in pictures, for example `stress xx`, to text[capacity], cut to capacity - 1 bytes. */
void plot_field_write_label(char *text, size_t capacity, const struct plot_field *field);

/* Reads the values of the field `field` at the particles of the frame f (state at one time) from the file `path`, from
 * which f was read. Stores an allocated array of f->n values in *value, which the caller releases with memory_free.
 * Returns FAILED if the frame lacks the field. */
status plot_field_read(float **value, const struct plot_field *field, const struct output_frame *f, const char *path);

/* Chooses the field of a run that is drawn if the user names none, and stores it in *field. It is damage if bonds have
 * broken up to the last selected frame. Otherwise it is the first one of plastic strain, von Mises stress and speed
 * that is not 0 everywhere in that frame, or damage if all of them are. folder: folder of the run; frames: selected
 * frames. Returns FAILED if a frame cannot be read. */
status plot_field_choose_default(const struct plot_field **field, const char *folder, const struct run_frames *frames);

/* ---- maps -------------------------------------------------------------------------------------------------------- */

/* A rigid body as a picture of one frame shows it: its shape at the start and its placement in the frame. */
struct plotted_rigid_body {
    const struct region *shape;       /* at t = 0; borrowed from the scene */
    struct rigid_placement at;        /* position and rotation in the frame */
    bool bounded;                     /* the body is finite */
    real low[DIM_MAX], high[DIM_MAX]; /* box at t = 0: of the body, or around the particles if the body is unbounded [m]
                                       */
};

/* A plane of symmetry, beyond which a picture shows nothing of a particle: normal to the axis 0 .. 2 for x y z, at the
 * coordinate `at` [m]. */
struct shown_mirror {
    int axis;
    double at;
};
enum { MIRRORS_SHOWN_MOST = 6 }; /* largest number of planes of symmetry that a picture regards */

/* Particles of one frame that are drawn: all particles in 2D; in 3D a slice, or all in an outside view. Arrays are
 * owned and have n entries unless noted. */
struct plotted_particles {
    int64_t n;                 /* number of particles that are drawn */
    double *position[DIM_MAX]; /* current position along the axes of the map [m]; position[2], towards the viewer, is
                                * NULL for a flat map */
    double *reference[2];      /* reference position along the axes of the map [m]; NULL: unknown */
    float *damage;             /* share of broken bonds [1] */
    uint8_t *kind;             /* enum kind: material point or peridynamic */
    int32_t *fragment;         /* index of the fragment of each particle; NULL: unknown */
    int32_t fragments;         /* number of fragments of all particles of the frame */
    float *value;              /* values of the field in SI units; NULL: none */
    struct colour *colour;     /* colour of each particle for every map; NULL: determined by the map */
    int axis[2], normal;       /* axes of the map, 0 .. 2 for x y z; normal of the slice, -1: no slice */
    struct camera camera;      /* directions of an outside view */
    double layer;              /* coordinate of the slice along its normal [m] */
    double t;                  /* time [s] */
    bool in_steps;             /* the frame is that of a load step */
    bool equilibrium;          /* the run computes one static equilibrium, for the loads at the time t */
    int64_t step;              /* number of the time step or load step */
    double spacing;            /* spacing of the particles [m] */
    double magnify;            /* factor on the displacements in `position` and `gradient` */
    double tall;               /* half height of a particle of a 1D bar [m]; 0: particles are as high as wide */
    float *size;               /* size of the particles and of the material points of coarse cells [m]; NULL: spacing
                                * everywhere */
    bool aligned;              /* nearest neighbours lie along the axes at reference positions */
    float *gradient;       /* [n][9] deformation gradient F of each particle, rows along x, y, z [1]; NULL: no visible
                            * deformation */
    uint8_t *apart;        /* [n] bits of the sides on which a crack or another body begins, as of
                            * deformation_gradients_fit_to_displacements; NULL: no visible deformation */
    double from[2], to[2]; /* bounding box of the reference positions [m] */
    int mirrors;           /* number of planes of symmetry */
    struct shown_mirror mirror[MIRRORS_SHOWN_MOST];
    int dim, rigids;                  /* of the rigid bodies: dimension, number */
    struct plotted_rigid_body *rigid; /* [rigids] */
};

/* Copies those particles of the frame f (state at one time) that a picture shows into *plotted: in 2D all, in 3D those
 * selected by `projection`, a slice or a view from outside; NULL for the slice with the largest damage. Release
 * `plotted` with plotted_particles_free. */
void plotted_particles_select_from_frame(struct plotted_particles *plotted, const struct output_frame *f,
                                         const struct projection *projection);

/* Reads a frame (state at one time) of the run in `folder` and copies those particles that a picture shows into
 * *plotted, with the values of projection->field if it is set. projection: slice of a body in three dimensions, or view
 * of it from outside. Returns FAILED, with no memory to release, if the frame cannot be read or lacks the field.
 * Release `plotted` with plotted_particles_free. */
status plotted_particles_read(struct plotted_particles *plotted, const char *folder, const struct listed_frame *frame,
                              const struct projection *projection);

/* Returns true if n particles appear to be on a lattice along the axes: for 90 % of a sample the nearest neighbour is
 * within 8 degrees of an axis. X[dim][n]: reference positions along the axes [m]. */
bool particles_are_on_lattice(double *const *X, int dim, int64_t n);

/* Computes the deformation gradients F of all particles of the frame f (state at one time), as fits to the
 * displacements of neighbours that no crack separates. spacing: of the particles [m]; displacement_factor: factor on
 * displacements; scene: for its pre-cracks, NULL if they are not known. Returns an allocated array [f->n][9] with F by
 * rows along x, y, z [1], which the caller releases with memory_free, or NULL if no deformation is visible.
 * separated_sides[f->n]: receives for each particle the bits 1 << (2 a + b) of the sides where its lattice neighbour is
 * drawn apart from it, across a crack or in another body; a: axis, b: 0 towards larger coordinates, 1 towards smaller
 * ones.
 */
float *deformation_gradients_fit_to_displacements(const struct output_frame *f, double spacing,
                                                  double displacement_factor, const struct scene *scene,
                                                  uint8_t *separated_sides);

/* Computes the inverse of the 3 x 3 matrix `matrix` and returns true. Returns false, with undefined `inverse`, if the
 * determinant is 0 or not a number. */
bool matrix_invert_3x3(const double matrix[3][3], double inverse[3][3]);

/* Frees the arrays of *plotted, the drawn particles of a frame, which plotted_particles_read or
 * plotted_particles_select_from_frame has allocated. */
void plotted_particles_free(struct plotted_particles *plotted);

/* Completes the slice *projection through a body in three dimensions from the particles of the frame f (state at one
 * time): sets its normal and its position along the normal, each if it is not set; a given position is moved to the
 * nearest layer of the lattice of particles. A position that is not set is that of the layer with the most damage, or,
 * in an undamaged body, with the largest value of projection->field, if this is a continuous field. path: file of the
 * frame, from which the field is read. Does nothing for views from outside and in lower dimensions. Returns REFUSED if
 * no particle is within one spacing of the given position, FAILED if the field cannot be read. */
status projection_choose_slice_normal_and_position(struct projection *projection, const struct output_frame *f,
                                                   const char *path);

/* Returns the particle spacing [m] of the frame f (state at one time): the smallest one if the frame stores spacings,
 * else the median distance of nearest neighbours in the reference positions of a sample of particles; 0 if it is
 * unknown. */
double frame_particle_spacing(const struct output_frame *f);

/* Returns an allocated array with the size [m] of each particle of the frame f, whose particles come from lists, by the
 * distances of its neighbours. Returns NULL if the sizes do not differ (the list is not graded), if the frame stores
 * spacings, or for a bar. spacing: median spacing [m]. */
float *frame_estimate_particle_sizes_if_graded(const struct output_frame *f, double spacing);

/* Quantity that the colours of a map (picture of particles) show: damage, kind or fragment of the particles, a field,
 * named values such as bodies, or cracks (particles with damage above CRACK_DAMAGE). */
enum map { MAP_DAMAGE, MAP_KIND, MAP_FRAGMENT, MAP_FIELD, MAP_CATEGORY, MAP_CRACKS };

/* Returns the kind of map (MAP_...) that shows the field `field`, e.g. MAP_DAMAGE for the damage. */
enum map colour_map_kind_for_field(const struct plot_field *field);

/* Computes the displacement of the particle that is nearest to a rigid body into displacement[f->dim] [m]; 0 if there
 * are no particles. Pictures with displacements N times as large move the body by N - 1 times this vector, so that its
 * distance from the particle, in contact or not, is the true one. shape: of the body at the start; placement: its
 * placement in the frame f. */
void rigid_body_displacement_of_nearest_particle(const struct region *shape, const struct rigid_placement *placement,
                                                 const struct output_frame *f, real *displacement);

/* Adds the rigid bodies of the scene s to `plotted`, the particles of frame number `frame_number` that a picture shows.
 * Their positions and rotations are those that the run in `folder` has stored for this frame. In a picture with
 * magnified displacements (plotted->magnify), each body is moved along by the added displacement of the particle
 * nearest to it. Adds none, without a message, if s is NULL, in one dimension, or if the file with the positions is
 * missing or cannot be read. f: the frame; s: kept by reference, must outlive c. */
void plotted_particles_add_rigid_bodies(struct plotted_particles *plotted, const struct output_frame *f,
                                        const struct scene *s, const char *folder, int frame_number);

/* Adds the rigid bodies of the scene s, whose placements are placement[s->rigids], to the particles c. low, high: box
 * around the particles in the reference state, to which unbounded bodies are cut [s->dim, m]. s: kept by reference. */
void plotted_particles_add_placed_rigid_bodies(struct plotted_particles *plotted, const struct scene *s,
                                               const struct rigid_placement *placement, const real *low,
                                               const real *high);

/* Number of named values, such as materials or bodies, with different colours (colour_of_material_or_body). */
enum { CATEGORIES_MOST = 9 };

/* A named value, such as a material or a body, and its colour in pictures. */
struct category {
    struct colour colour;
    char name[NAME_MAX_LENGTH];
};

/* The named values, such as bodies or materials, that occur in a picture. of: [n] the values that are listed; more:
 * number of further values, which have no entry. */
struct categories {
    int n, more;
    struct category of[CATEGORIES_MOST];
};

/* Lists the named values (bodies, materials and so on) of a field that occur in frame_particles[frame_count], the
 * particles of several frames, and stores them in *k. folder: folder of the run, from whose scene the names of bodies
 * and materials are read. */
void categories_list_values_present_in_frames(struct categories *categories, const struct plot_field *field,
                                              const char *folder, const struct plotted_particles *frame_particles,
                                              int frame_count);

/* Returns the colour of one value of a field whose values have names, such as bodies or materials. category_value: the
 * value, which is the index of the body or material. */
struct colour category_colour(const struct plot_field *field, float category_value);

/* View of a map: the rectangle of the body that is shown, the range of the colours, and further options. */
struct view {
    double from[2], to[2];               /* lower left and upper right corner of the rectangle [m] */
    double bottom, top;                  /* damage at both ends of the colour scale [1] */
    const struct plot_field *field;      /* field that MAP_FIELD shows; borrowed */
    double low, high;                    /* values of the field at both ends of the colour scale [its unit] */
    int64_t beyond[2];                   /* largest number of particles of a frame below `low`, above `high` */
    enum colour_table table;             /* colours of damage, cracks and MAP_FIELD */
    const struct categories *categories; /* named values of MAP_CATEGORY; borrowed */
    int64_t outside;                     /* largest number of particles of a frame outside the rectangle */
    int notches;                         /* number of pre-cracks that are drawn */
    const struct crack *
        notch; /* [notches] pre-cracks of a plane scene, whose faces are lines in maps of damage and fields; borrowed */
};

/* Particles with at least this damage (broken share of their bonds) are drawn as cracks in MAP_CRACKS. A plane through
 * a particle that cuts all bonds across it causes the damage 1/2. */
#define CRACK_DAMAGE 0.35

/* Returns a view whose rectangle shows all of frame_particles[frame_count], the particles of several frames: the
 * bounding box of the body with a margin. A few particles that are far from all others may be outside. */
struct view view_make_around_particles(const struct plotted_particles *frame_particles, int frame_count);

/* Sets the field that the view v shows, and the values at the ends of its colour scale. These follow from the kind of
 * scale of the field (field->scale) and its values in frame_particles[frame_count]. Extreme values of a few particles
 * are ignored. */
void view_set_field_and_colour_range(struct view *v, const struct plot_field *field,
                                     const struct plotted_particles *frame_particles, int frame_count);

/* Makes the view *v of frame_particles[frame_count], the particles of each frame, for the request r: its rectangle, the
 * limits and the table of its colour scale, and the pre-cracks of a plane scene. Returns REFUSED if a limit is not a
 * number with a unit of the field, or the lower limit is not below the upper; FAILED if there are no positions. */
status view_make_for_request(struct view *v, const struct plot_request *r,
                             const struct plotted_particles *frame_particles, int frame_count);

/* Returns the colour of particle number i of `plotted` in a map of the quantity `map`. v: view, with the values at the
 * ends of the colour scale. */
struct colour plotted_particle_colour(const struct view *v, const struct plotted_particles *plotted, int64_t i,
                                      enum map map);

/* Returns the colour at `position` in 0 .. 1 on the colour scale of a map of the kind `map`. v: view, whose field and
 * table determine the scale if `map` is MAP_FIELD. */
struct colour view_colour_at_scale_position(const struct view *v, enum map map, double position);

/* Paints the particles of `plotted`, seen in the rectangle of `view`, into the image pixel[height * width], rows from
 * bottom to top. map: quantity that the colours show. Each particle covers a square, or a disc if the lattice is
 * rotated, which deforms with the body. Each pixel shows the particle nearest to it. Pixels without a particle are
 * white and transparent. For plane bodies and slices; image_paint_particles_as_cubes paints views from outside. */
void image_paint_particles_in_plane(struct colour *pixel, int width, int height, const struct view *view,
                                    const struct plotted_particles *plotted, enum map map);

/* Paints the particles of `plotted`, as seen from outside by a camera, into the image pixel[height * width], rows from
 * bottom to top. map: quantity that the colours show; view: visible rectangle and range of the colours. Each particle
 * is drawn as a cube that deforms with the body. Each pixel shows the cube nearest to the viewer. In MAP_CRACKS the
 * body is painted in a faded colour, and the cubes of particles with damage of at least CRACK_DAMAGE are painted over
 * it. */
void image_paint_particles_as_cubes(struct colour *pixel, int width, int height, const struct view *view,
                                    const struct plotted_particles *plotted, enum map map);

/* Paints the faces of the pre-cracks v->notch into the image pixel[height * width] (rows from bottom to top) of a map
 * of a plane body, as lines that move with the adjacent particles of c. v: rectangle of the image; map: quantity that
 * the colours show. Paints nothing unless `map` is MAP_DAMAGE or MAP_FIELD. */
void image_paint_precrack_faces(struct colour *pixel, int width, int height, const struct view *v,
                                const struct plotted_particles *plotted, enum map map);

/* Returns the colour in which rigid bodies are drawn in a map of the kind `map`; it is faded in MAP_CRACKS, where the
 * deformable bodies are faded, too. */
struct colour rigid_body_colour(enum map map);

/* Extends the rectangle of the view v so that it shows the rigid bodies (their boxes) in the frames
 * frame_particles[frame_count], the particles at several times. Each side moves by at most 0.3 times the longer side of
 * the original rectangle; parts of a body farther away remain outside. Bodies that are not in the section are left out.
 */
void view_extend_to_rigid_bodies(struct view *v, const struct plotted_particles *frame_particles, int frame_count);

/* Returns true if at least one rigid body of `plotted` is visible in the rectangle of v. In views from outside every
 * rigid body counts as visible. In plane bodies and slices the rectangle is tested at 300 x 300 points. */
bool view_shows_any_rigid_body(const struct view *v, const struct plotted_particles *plotted);

/* Paints the rigid bodies of `plotted`, seen in the rectangle of v, into the image pixel[height * width] of a plane
 * body or a slice. In front of a slice they hide the particles, in a plane body they are behind the particles. */
void image_paint_rigid_bodies_in_plane(struct colour *pixel, int width, int height, const struct view *v,
                                       const struct plotted_particles *plotted);

/* Paints the rigid bodies of `plotted`, as seen from outside by a camera, into the image pixel[height * width], rows
 * from bottom to top. A pixel is painted where a body is nearer to the viewer than the depth stored in depth[height *
 * width] [m], which is then updated. v: visible rectangle; map: quantity that the colours show. */
void image_paint_rigid_bodies_with_depth_test(struct colour *pixel, float *depth, int width, int height,
                                              const struct view *v, const struct plotted_particles *plotted,
                                              enum map map);

/* Output file of a picture: its path and its format. */
struct output_picture {
    const char *path;
    enum picture_format format;
};

/* Draws one picture in the file output.path of the format output.format. It has a panel for each of the frames
 * frame_particles[frame_count] (the particles at one time), a common colour scale or key (legend), and the heading
 * `title`. map: quantity that the colours show; view: common rectangle and range of the colours. Returns FAILED if
 * gnuplot fails. */
status picture_draw_panels_of_frames(struct output_picture output, const char *title, enum map map,
                                     const struct view *view, const struct plotted_particles *frame_particles,
                                     int frame_count);

#endif
